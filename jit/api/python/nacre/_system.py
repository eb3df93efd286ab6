"""What documents share, and compiling them."""

import functools
import os
from collections.abc import Iterable
from typing import Unpack

from . import _core
from ._document import Document, FileResolver
from ._errors import Diagnostic
from ._options import CompileOptions, core_options
from ._shader import Shader


class System(_core.System):
    """The data library, textures and the compiler, for any number of documents and threads.

    libraries        files or folders of nodedefs: the MaterialX data library, then node packs;
                     none: the one that came with the package (`data_library()`)
    ocio_config      an OpenColorIO configuration, for its colour spaces
    cache            folder where compiled kernels are kept between runs
    compile_threads  0: one a core
    compile_apart    in processes of their own, so that a fault of the compiler's costs a kernel
                     its speed and not this process its life
    texture_memory   bytes of texels in memory; 0: 2 GiB
    resolver         finds images, see FileResolver; for includes see Document
    """

    def __init__(self, *, libraries: Iterable[str | os.PathLike[str]] = (),
                 ocio_config: str | os.PathLike[str] = "", cache: str | os.PathLike[str] = "",
                 compile_threads: int = 0, compile_apart: bool = False,
                 texture_memory: int = 0, resolver: FileResolver | None = None) -> None:
        super().__init__([os.fspath(each) for each in libraries], os.fspath(ocio_config),
                         os.fspath(cache), compile_threads, compile_apart, texture_memory, resolver)

    def compile_material(self, document: Document, material: str,
                         **options: Unpack[CompileOptions]) -> Shader:
        """Kernels for what can be asked of a material: one of Document.materials."""
        return Shader(self, document, material, core_options(options))

    def compile_variants(self, document: Document, material: str,
                         variants: Iterable[CompileOptions]) -> list[Shader]:
        """Several of one material, for rays that ask different things of it: as compile_material
        of each with its options, a dict, to the bit; but the graph is built once, and the kernels
        are made side by side.

            camera, shadow = system.compile_variants(document, "M", [{}, {"entries": [Entry.SHADOW]}])
        """
        made = self._compile_variants(document, material, [core_options(each) for each in variants])
        return [Shader(each) for each in made]

    def compile_outputs(self, document: Document, outputs: Iterable[str],
                        **options: Unpack[CompileOptions]) -> Shader:
        """One kernel for outputs of graphs: some of Document.outputs."""
        if isinstance(outputs, str):
            raise TypeError(f"outputs takes a list of names, not the text {outputs!r}")
        return Shader(self, document, list(outputs), core_options(options))

    def check(self, document: Document, **options: Unpack[CompileOptions]) -> list[Diagnostic]:
        """All that is wrong with a document: one without errors compiles."""
        return self._check(document, core_options(options))


@functools.cache
def default_system() -> System:
    """The one that functions of the package take where none is given; made when it is needed."""
    return System()
