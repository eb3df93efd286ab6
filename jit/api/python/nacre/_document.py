"""MaterialX documents."""

import os
from collections.abc import Iterable
from typing import Protocol

from . import _core


class FileResolver(Protocol):
    """A function that says where a file is which the document `named_by` names: its path; its
    contents, as in an archive; None: it is looked for as usual. Any thread may call it. Where it
    raises, there is no such file, and the Error of that says why."""

    def __call__(self, name: str, named_by: str, is_image: bool,
                 /) -> str | os.PathLike[str] | bytes | None: ...


class Document(_core.Document):
    """A MaterialX document, read from a file.

    Includes are looked for in the including file's own folder, then in `search_paths`;
    `includes_anywhere` lets them lie outside of these; `resolver` may find them before that.
    Error for what cannot be read.
    """

    def __init__(self, file: str | os.PathLike[str], *,
                 search_paths: Iterable[str | os.PathLike[str]] = (),
                 includes_anywhere: bool = False,
                 resolver: FileResolver | None = None) -> None:
        super().__init__(os.fspath(file), [os.fspath(each) for each in search_paths],
                         includes_anywhere, resolver)

    @classmethod
    def parse(cls, text: str, name: str = "document.mtlx", *,
              search_paths: Iterable[str | os.PathLike[str]] = (),
              includes_anywhere: bool = False,
              resolver: FileResolver | None = None) -> "Document":
        """Of text in memory; the folder of `name` is where includes and images are looked for."""
        made = cls.__new__(cls)
        _core.Document.__init__(made, text, name, [os.fspath(each) for each in search_paths],
                                includes_anywhere, resolver)
        return made

    def __repr__(self) -> str:
        return (f"<nacre.Document of {len(self.materials)} materials and "
                f"{len(self.outputs)} outputs>")
