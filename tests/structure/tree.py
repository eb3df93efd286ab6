"""The files of the project and what they include; shared by the checks of this folder."""

import pathlib
import re
from typing import Iterator, NamedTuple

FOLDERS = ("runtime", "nodes", "pbs", "jit", "bench", "tests", "examples")
CODE = {".h", ".hpp", ".cpp", ".c", ".inc"}
WRITTEN = CODE - {".inc"} | {".py", ".cmake", ".sh"}  # Tables that a program made are .inc.

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)


class Include(NamedTuple):
    file: str  # From the root: "jit/graph/graph.cpp".
    line: int
    quoted: bool
    name: str  # As written between the quotes or brackets.

    def where(self) -> str:
        return f"{self.file}:{self.line}"


def files(root: pathlib.Path, suffixes: set[str]) -> Iterator[str]:
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.is_file() and (path.suffix in suffixes or path.name in suffixes):
                yield path.relative_to(root).as_posix()


def includes(root: pathlib.Path) -> Iterator[Include]:
    for file in files(root, CODE):
        text = (root / file).read_text(encoding="utf-8")
        for match in INCLUDE.finditer(text):
            line = text.count("\n", 0, match.start()) + 1
            yield Include(file, line, match[1] == '"', match[2])


def inside(name: str, folder: str) -> bool:
    return name == folder or name.startswith(folder + "/")
