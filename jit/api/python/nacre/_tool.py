"""The `nacre` program: what it writes and says, for Python.

It comes with the package. NACRE_TOOL names another one; in a build tree it is the one of the
build. Its keywords are its options (`nacre bake --help`), with _ for -: True for a flag, a list
for what may be repeated. Lines that it says are warnings and errors as the library's own.
"""

import json
import os
import pathlib
import re
import subprocess
import sys
from collections.abc import Iterable
from typing import Any

from ._errors import Diagnostic, Error, Severity, say

Path = str | os.PathLike[str]

# As runtime/diagnostic.cpp writes them.
_LINE = re.compile(r"(?:(?P<file>.*?)(?::(?P<line>\d+))?(?::(?P<column>\d+))?: )?"
                   r"(?P<severity>error|warning|note): (?P<message>.*?)"
                   r"(?:; expected (?P<expected>.*?))?(?:[;,] found (?P<found>.*?))?"
                   r"(?:; (?P<hint>did you mean .*?\?|it differs only in case from .*?))?"
                   r" \[(?P<code>[a-z0-9-]+)\](?: \((?P<path>.*)\))?")


def bake_files(file: Path, *, out: Path, output: Iterable[str] = (), size: Any = None,
               **options: Any) -> list[pathlib.Path]:
    """`nacre bake`: textures of graph outputs, in a folder. The files that were written.

    output   graph outputs; none: all
    size     texels: N, or (width, height)
    options  format="exr", udim="1001,1002", material="Gold", document="baked.mtlx", ...
    """
    if options.get("json"):
        raise TypeError("bake_files gives the files, and `nacre bake --json` what is in them")
    done = _run("bake", file, out=out, output=list(output), size=_size(size), **options)
    return [pathlib.Path(line) for line in done.splitlines()]


def render(file: Path, *, out: Path, material: str | None = None, scene: Path | None = None,
           size: Any = None, spp: int | None = None, **options: Any) -> pathlib.Path:
    """`nacre render`: a picture of a material, or of a scene that a document's looks dress. The
    file that was written.

    out      .exr or .png
    scene    glTF or OBJ; None: the built-in one
    size     pixels: N, or (width, height)
    spp      samples a pixel
    options  environment="sky.exr", exposure=1, ground=True, ...
    """
    _run("render", file, out=out, material=material, scene=scene, size=_size(size), spp=spp,
         **options)
    return pathlib.Path(out)


def inspect(file: Path, *, material: str | None = None, output: Iterable[str] = (),
            **options: Any) -> list[dict[str, Any]]:
    """`nacre inspect --json`: what the kernels of each material and output need, hold and leave
    out, and how they were made.

    material, output  one of them; none: all of the document
    options           cost=True, dump=["llvm"], live=True, ...
    """
    said: list[dict[str, Any]] = json.loads(
        _run("inspect", file, material=material, output=list(output), json=True, **options))
    return said


def check_lobes(file: Path, *, lobe: Iterable[str] = (), **options: Any) -> list[dict[str, Any]]:
    """`nacre check --lobes --json`: what leaves of the light from several views of each material,
    and which laws of closures hold. Error where one is broken, with a diagnostic for each.

    lobe     nodes whose output is a BSDF, each tried alone, at the ends of its inputs and between;
             none: materials, as they are
    options  samples=100_000, sets=16, most_energy=1.1, ...
    """
    what = {"lobe": list(lobe)} if lobe else {"lobes": True}
    said: list[dict[str, Any]] = json.loads(_run("check", file, json=True, **what, **options))
    return said


def tune(file: Path, *, material: Iterable[str] = (), output: Iterable[str] = (),
         max_error: float = 0.01, profile: Path | None = None,
         **options: Any) -> list[dict[str, Any]]:
    """`nacre tune --json`: of each material and output the front of error against cost, and the
    cheapest kernels that keep an error, "chosen".

    material, output  some of them; none: all of the document
    profile           where to write what was chosen, for the option `profile` of
                      System.compile_material and compile_outputs, of render, bake_files and inspect
    options           metric="absolute", floor=0.1, no_times=True, ...
    """
    said: list[dict[str, Any]] = json.loads(
        _run("tune", file, material=list(material), output=list(output), max_error=max_error,
             profile=profile, json=True, **options))
    return said


def main() -> None:
    """The command `nacre` of an installed package."""
    program = _program()
    os.execv(program, [str(program), *sys.argv[1:]])


def _program() -> pathlib.Path:
    named = os.environ.get("NACRE_TOOL")
    program = pathlib.Path(named) if named else pathlib.Path(__file__).parent / "bin" / "nacre"
    if program.is_file():
        return program
    raise FileNotFoundError(f"there is no nacre program at {program}; this build of the package "
                            "has none, and NACRE_TOOL may name one")


def _run(command: str, file: Path, **options: Any) -> str:
    """What the program prints. Error where it ends with problems."""
    arguments = [str(_program()), command, os.fspath(file)]
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        if value is True:
            arguments.append(flag)
        elif isinstance(value, (list, tuple)):
            arguments += [text for each in value for text in (flag, str(each))]
        elif value is not None and value is not False:
            arguments += [flag, str(value)]
    done = subprocess.run(arguments, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          errors="replace", check=False)
    said = [_diagnostic(line) for line in done.stderr.splitlines() if line.strip()]
    if done.returncode == 2:  # Of its usage: an option that there is not.
        raise TypeError("\n".join(map(str, said)))
    if done.returncode != 0:
        raise Error(said, text="\n".join(map(str, said)) or
                    f"nacre {command} ended with status {done.returncode}")
    for each in said:
        say(each)
    return done.stdout


def _diagnostic(line: str) -> Diagnostic:
    if line.startswith("{"):  # With --json.
        one = json.loads(line)
        return Diagnostic(Severity[one.pop("severity").upper()], **one)
    found = _LINE.fullmatch(line)
    if found is None:
        return Diagnostic(Severity.WARNING, "unknown", message=line, text=line)
    group = {name: text or "" for name, text in found.groupdict().items()}
    return Diagnostic(Severity[group["severity"].upper()], group["code"], group["file"],
                      int(group["line"] or 0), int(group["column"] or 0), group["path"],
                      group["message"], group["expected"], group["found"], line,
                      group["hint"])


def _size(size: Any) -> str | None:
    if size is None or isinstance(size, int):
        return None if size is None else str(size)
    width, height = size
    return f"{width}x{height}"
