"""MaterialX documents."""

import os
from collections.abc import Iterable

from . import _core


class Document(_core.Document):
    """A MaterialX document, read from a file.

    Includes are looked for in the including file's own folder, then in `search_paths`;
    `includes_anywhere` lets them lie outside of these. Error for what cannot be read.
    """

    def __init__(self, file: str | os.PathLike[str], *,
                 search_paths: Iterable[str | os.PathLike[str]] = (),
                 includes_anywhere: bool = False) -> None:
        super().__init__(os.fspath(file), [os.fspath(each) for each in search_paths],
                         includes_anywhere)

    @classmethod
    def parse(cls, text: str, name: str = "document.mtlx", *,
              search_paths: Iterable[str | os.PathLike[str]] = (),
              includes_anywhere: bool = False) -> "Document":
        """Of text in memory; the folder of `name` is where includes and images are looked for."""
        made = cls.__new__(cls)
        _core.Document.__init__(made, text, name, [os.fspath(each) for each in search_paths],
                                includes_anywhere)
        return made

    def __repr__(self) -> str:
        return (f"<nacre.Document of {len(self.materials)} materials and "
                f"{len(self.outputs)} outputs>")
