#!/usr/bin/env python3
"""usage: check.py INCLUDE... FOLDER [renew]

Compares the binary interface that the headers in INCLUDE declare with the last version's, which is
beside this file: functions, structures and constants may be added, and members at the end of a
structure; what there was stays as it was. FOLDER is for what is made on the way. With `renew` it is
written anew: for a version that breaks it on purpose, or to add what has been added.
"""

import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).parent
INTERFACE = HERE / "nacre.abi"
CONSTANTS = HERE / "constants.txt"
STRUCTURES = HERE / "structures.txt"
# "NACRE_API nacre_status nacre_run(const nacre_binding* binding, ...);", maybe over several lines.
FUNCTION = re.compile(r"^NACRE_API\b(.*?);", re.MULTILINE | re.DOTALL)
COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
STRUCTURE = re.compile(r"^typedef struct (\w+) \{(.*?)^\}", re.MULTILINE | re.DOTALL)
NAME = re.compile(r"\b(NACRE_[A-Z0-9_]+)\b(?!\()")


def headers(includes: list[pathlib.Path]) -> list[pathlib.Path]:
    return sorted(file for include in includes for file in (include / "nacre").glob("*.h"))


def run(*command: str | pathlib.Path) -> subprocess.CompletedProcess:
    return subprocess.run([str(part) for part in command], capture_output=True, text=True,
                          check=False)


def compiled(source: pathlib.Path, includes: list[pathlib.Path], *flags: str) -> pathlib.Path:
    result = source.with_suffix(".out")
    done = run("gcc", "-g", "-Wno-unused-parameter", *flags, *[f"-I{i}" for i in includes], "-o",
               result, source)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return result


def interface(includes: list[pathlib.Path], folder: pathlib.Path) -> pathlib.Path:
    """A library of that interface without anything behind it, as libabigail describes it."""
    source = folder / "interface.c"
    texts = [COMMENT.sub("", header.read_text(encoding="utf-8")) for header in headers(includes)]
    functions = [match for text in texts for match in FUNCTION.findall(text)]
    source.write_text("".join(f"#include <nacre/{header.name}>\n" for header in headers(includes))
                      + "#include <stdlib.h>\n" + "".join(f"NACRE_API {one.strip()} {{ abort(); }}\n" for one in functions),
                      encoding="utf-8")
    described = folder / "interface.abi"
    library = compiled(source, includes, "-shared", "-fPIC")
    done = run("abidw", "--no-corpus-path", "--no-comp-dir-path", "--no-show-locs", "--short-locs",
               library, "--out-file", described)
    if done.returncode != 0:
        sys.exit(done.stdout + done.stderr)
    return described


def constants(includes: list[pathlib.Path], folder: pathlib.Path) -> pathlib.Path:
    """Names and values of the enumerators."""
    names = set()
    for header in headers(includes):
        text = COMMENT.sub("", header.read_text(encoding="utf-8"))
        for body in re.findall(r"\benum\b[^{;]*\{(.*?)\}", text, re.DOTALL):
            names.update(NAME.findall(body))
    source = folder / "constants.c"
    source.write_text("#include <nacre/nacre.h>\n#include <stdio.h>\nint main(void) {\n"
                      + "".join(f'  printf("{name} %d\\n", (int){name});\n'
                                for name in sorted(names)) + "  return 0;\n}\n", encoding="utf-8")
    listed = folder / "constants.txt"
    listed.write_text(run(compiled(source, includes)).stdout, encoding="utf-8")
    return listed


def structures(includes: list[pathlib.Path], folder: pathlib.Path) -> pathlib.Path:
    """Each structure in a line: its name and members."""
    lines = []
    for header in headers(includes):
        text = COMMENT.sub("", header.read_text(encoding="utf-8"))
        lines += [f"{name}: {' '.join(body.split())}" for name, body in STRUCTURE.findall(text)]
    listed = folder / "structures.txt"
    listed.write_text("".join(f"{line}\n" for line in sorted(lines)), encoding="utf-8")
    return listed


def grown(old: pathlib.Path, new: pathlib.Path) -> list[str]:
    """Structures that begin with their size and have more members at their end, and no other
    change. (libabigail's own word for that, has_data_member_inserted_at, lets other changes pass.)"""
    before = dict(line.split(": ", 1) for line in old.read_text(encoding="utf-8").splitlines())
    names = []
    for line in new.read_text(encoding="utf-8").splitlines():
        name, members = line.split(": ", 1)
        was = before.get(name, "")
        if was.startswith("size_t size;") and members != was and members.startswith(was):
            names.append(name)
    return names


def changes(old: pathlib.Path, new: pathlib.Path) -> list[str]:
    """Constants that are gone or have another value. NACRE_ENTRY_COUNT counts."""
    values = dict(line.split() for line in new.read_text(encoding="utf-8").splitlines())
    return [f"{line} is {values.get(line.split()[0], 'gone')} now"
            for line in old.read_text(encoding="utf-8").splitlines()
            if line.split()[0] != "NACRE_ENTRY_COUNT"
            and values.get(line.split()[0]) != line.split()[1]]


def main() -> int:
    arguments = sys.argv[1:]
    is_renewal = arguments[-1] == "renew"
    *includes, folder = [pathlib.Path(a) for a in (arguments[:-1] if is_renewal else arguments)]
    folder.mkdir(parents=True, exist_ok=True)
    described, listed = interface(includes, folder), constants(includes, folder)
    laid_out = structures(includes, folder)
    if is_renewal:
        for made, kept in ((described, INTERFACE), (listed, CONSTANTS), (laid_out, STRUCTURES)):
            shutil.copyfile(made, kept)
        return 0
    may_grow = folder / "suppressions"
    may_grow.write_text("".join(f"[suppress_type]\n  name = {name}\n"
                                for name in grown(STRUCTURES, laid_out)), encoding="utf-8")
    done = run("abidiff", "--suppressions", may_grow, "--no-added-syms", INTERFACE, described)
    faults = changes(CONSTANTS, listed)
    for fault in faults:
        print(fault)
    print(done.stdout + done.stderr)
    # Bits: 1 and 2 errors, 4 a change, 8 one that breaks.
    return 1 if faults or done.returncode != 0 else 0


if __name__ == "__main__":
    sys.exit(main())
