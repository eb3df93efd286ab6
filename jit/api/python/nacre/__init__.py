"""MaterialX node graphs as native kernels over arrays of shading points.

    import nacre

    system = nacre.System()
    document = nacre.Document("marble.mtlx")
    shader = system.compile_outputs(document, ["NG_marble/base_color"], no_footprints=True)
    color = shader.run({"P": points, "Po": points})["NG_marble/base_color"]  # float32 (count, 3)

Arrays are whatever has the buffer protocol or DLPack: NumPy's, and other libraries' on the CPU.
None is copied. `Shader.run` makes arrays for results; `Shader.bind` binds arrays once, for calls
that cost about a microsecond:

    binding = shader.bind({"P": points, "Po": points, "NG_marble/base_color": color})
    binding.run(nacre.Entry.OUTPUTS)

What cannot be had is an `Error` that carries the diagnostics; warnings are Python's, of category
`DiagnosticWarning`; notes go to the logger "nacre". Other threads run while documents are read,
shaders are compiled and points are shaded. An object that is being changed (an instance's values)
is used by one thread at a time.

`bake` gives arrays; `bake_files`, `render`, `inspect`, `tune` and `check_lobes` run the `nacre`
program, which comes with the package.
"""

from ._bake import bake
from ._core import Binding, Entry, Stop, data_library
from ._core import version as __version__
from ._document import Document, FileResolver
from ._errors import Diagnostic, DiagnosticWarning, Error, Severity
from ._options import CompileOptions, LobeKind, SampleFlag, Transport
from ._parameters import Instance, Parameters, Ui
from ._points import plane_points, surface_points
from ._shader import Channel, Fact, Lobe, Shader, ShaderError, of_instance, of_place
from ._system import System, default_system
from ._tool import bake_files, check_lobes, inspect, render, tune

__all__ = [
    "Binding", "Channel", "CompileOptions", "Diagnostic", "DiagnosticWarning", "Document", "Entry",
    "Error", "Fact", "FileResolver", "Instance", "Lobe", "LobeKind", "Parameters", "SampleFlag", "Severity",
    "Shader", "ShaderError", "Stop", "System", "Transport", "Ui", "bake", "bake_files", "check_lobes", "data_library", "default_system",
    "inspect", "of_instance", "of_place", "plane_points", "render", "surface_points", "tune",
]
