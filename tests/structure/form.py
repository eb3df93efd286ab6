"""Size of files and order of lists."""

import pathlib
import re

import tree

MOST_LINES = 500

# Calls of CMake whose arguments are a list in alphabetical order, and how many come first.
SORTED_CALLS = {"nacre_bench": 1, "nacre_library": 1, "nacre_module": 1, "nacre_test": 1}
KEYWORDS = {"CONCURRENT", "FULL"}

# Folders of tests that are of more than one folder of the project.
TESTS_OF_MANY = {"pbs/battery"}


def length(root: pathlib.Path) -> list[str]:
    """One unit is one small file."""
    faults = []
    for file in tree.files(root, tree.WRITTEN | {"CMakeLists.txt"}):
        lines = (root / file).read_text(encoding="utf-8").count("\n")
        if lines > MOST_LINES:
            faults.append(f"{file}: {lines} lines, at most {MOST_LINES}; split it by unit")
    return faults


def out_of_order(items: list[str]) -> str | None:
    """The first item that stands behind a greater one, and that one; or nothing."""
    for before, after in zip(items, items[1:]):
        if after < before:
            return f'"{after}" comes after "{before}"'
        if after == before:
            return f'"{after}" is there twice'
    return None


def cmake_lists(root: pathlib.Path) -> list[str]:
    """Sources, headers and test folders are listed alphabetically."""
    faults = []
    for file in tree.files(root, {"CMakeLists.txt"}):
        text = re.sub(r"#.*", "", (root / file).read_text(encoding="utf-8"))
        lists = []
        for call in re.finditer(r"^\s*(\w+)\(([^)]*)\)", text, re.MULTILINE):
            if call[1] in SORTED_CALLS:
                items = [i for i in call[2].split() if i not in KEYWORDS]
                lists.append((f"{call[1]}()", items[SORTED_CALLS[call[1]]:]))
        if tree.inside(file, "tests"):
            lists.append(("add_subdirectory()", re.findall(r"^\s*add_subdirectory\((\S+)\)", text,
                                                           re.MULTILINE)))
        faults += [f"{file}: {name}: {fault}" for name, items in lists
                   if (fault := out_of_order(items))]
    return faults


def marked_lists(root: pathlib.Path) -> list[str]:
    """Lines between "keep-sorted start" and "keep-sorted end" are in order."""
    faults = []
    for file in tree.files(root, tree.CODE | {".cmake", "CMakeLists.txt"}):
        block = None
        for number, line in enumerate((root / file).read_text(encoding="utf-8").split("\n"), 1):
            if "keep-sorted start" in line:
                block = []
            elif "keep-sorted end" in line and block is not None:
                if fault := out_of_order(block):
                    faults.append(f"{file}:{number}: {fault}")
                block = None
            elif block is not None and line.strip():
                block.append(line.strip())
        if block is not None:
            faults.append(f'{file}: "keep-sorted start" has no end')
    return faults


def packages(root: pathlib.Path) -> list[str]:
    """The lists of Debian packages are in order."""
    faults = []
    for path in sorted(root.glob(".packages*.txt")):
        lines = path.read_text(encoding="utf-8").split("\n")
        fault = out_of_order([line for line in lines if line and not line.startswith("#")])
        if fault:
            faults.append(f"{path.name}: {fault}")
    return faults


def mirror(root: pathlib.Path) -> list[str]:
    """The tests of a folder stand in tests/ under the folder's own name."""
    faults = []
    for file in tree.files(root / "tests", tree.CODE):
        folder = pathlib.PurePosixPath(file).parent
        while folder.name == "independent":  # What tests compare with.
            folder = folder.parent
        if folder.as_posix() not in TESTS_OF_MANY and not (root / folder).is_dir():
            faults.append(f"tests/{file}: there is no {folder}/ that this could be a test of")
    return faults


def temporary(root: pathlib.Path) -> list[str]:
    """A test's files lie in a folder of its own (tests/support/temporary_folder.h): under a
    fixed name, tests that run at once take each other's away."""
    faults = []
    for file in tree.files(root / "tests", tree.CODE):
        text = (root / "tests" / file).read_text(encoding="utf-8")
        for number, line in enumerate(text.split("\n"), 1):
            if "TempDir()" in line:
                faults.append(f"tests/{file}:{number}: {line.strip()}")
    return faults


CHECKS = (length, cmake_lists, marked_lists, mirror, packages, temporary)
