#!/usr/bin/env python3
"""usage: check_headers.py PREFIX FOLDER

Compiles each public header of the installed package alone, the C ones as C99 and all as C++17, by GCC
and by Clang, all warnings being errors; and all of them together as C++20. Folders of a host that
have files of the same names as ours come before on the include path: FOLDER gets them.
"""

import pathlib
import subprocess
import sys

C = [("gcc", "c99"), ("clang-19", "c99")]
CXX = [("g++", "c++17"), ("clang++-19", "c++17")]
TOGETHER = [("g++", "c++20"), ("clang++-19", "c++20")]
FLAGS = ["-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Werror"]
HOSTILE = ["runtime/value.h", "runtime/kernel.h", "jit/document/read.h", "record.h", "version.h",
           "nacre.h", "record.hpp", "value.h"]


def main() -> int:
    prefix, folder = (pathlib.Path(argument) for argument in sys.argv[1:])
    for name in HOSTILE:
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("#error a header of the host\n", encoding="utf-8")
    include = prefix / "include"
    folder_of_ours = include / "nacre"
    headers = sorted(str(header.relative_to(folder_of_ours)) for header in folder_of_ours.rglob("*.h*"))
    faults = 0

    def compile_some(some: list, compiler: str, standard: str) -> None:
        nonlocal faults
        language = "c" if standard.startswith("c9") else "c++"
        text = "".join(f"#include <nacre/{header}>\n" for header in some) + "int unused;\n"
        done = subprocess.run(
            [compiler, f"-std={standard}", *FLAGS, f"-I{folder}", f"-I{include}", "-x", language, "-"],
            input=text, capture_output=True, text=True, check=False)
        if done.returncode != 0 or done.stderr:
            faults += 1
            print(f"{', '.join(some)} by {compiler} as {standard}:\n{done.stderr}")

    for header in headers:
        for each in (C if header.endswith(".h") else []) + CXX:
            compile_some([header], *each)
    for each in TOGETHER:
        compile_some(headers, *each)
    print(f"{len(headers)} headers, {faults} faults")
    return 1 if faults or not headers else 0


if __name__ == "__main__":
    sys.exit(main())
