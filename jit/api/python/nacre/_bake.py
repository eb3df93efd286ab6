"""Textures in memory."""

from collections.abc import Iterable, Mapping
from typing import Any, Unpack

import numpy

from ._core import Entry
from ._document import Document
from ._options import CompileOptions
from ._points import plane_points, texture_sets
from ._system import System, default_system


def bake(document: Document, outputs: Iterable[str] | None = None, *,
         size: int | tuple[int, int] = 1024, values: Mapping[str, Any] | None = None,
         system: System | None = None, **options: Unpack[CompileOptions]) -> dict[str, Any]:
    """Pictures of graph outputs, by name: NumPy arrays (height, width) or (height, width,
    components), float32, or int32 for integers and booleans. The first row is the uppermost.

    outputs  some of document.outputs; None: all
    size     of the pictures, or (width, height)
    values   of parameters that the option `live` names, and of time and frame

    Shades the plane of `nacre bake` (see plane_points) in the working space, without files: what
    encodings, colour spaces and tiles of files need, `bake_files` does.
    """
    width, height = (size, size) if isinstance(size, int) else size
    names = list(document.outputs if outputs is None else outputs)
    shader = (system or default_system()).compile_outputs(document, names, **options)
    plane = plane_points(width, height)
    plane |= texture_sets(plane, [each.name for each in shader.inputs(Entry.OUTPUTS)])
    results = shader.run(plane, count=width * height, instance=shader.instance(values))
    return {name: numpy.reshape(results[name], (height, width, *results[name].shape[1:]))
            for name in names}
