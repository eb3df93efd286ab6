#!/usr/bin/env python3
"""Samples that `nacre bake --samples auto` takes beside those of a fixed grid that is as good.

    bench/adaptive.py --tool build/bin/nacre --out bench/results/adaptive.md FILE.mtlx ...

Every map of the documents' materials is baked with many samples, which is taken for right; by
--samples auto for some errors of a texel; and with 1, 4, 16, ... samples everywhere. A texel is
above an error by its worst channel, relative to values above 1. The grid as good leaves as few
texels above, read off between two of those measured, log against log. A bake has one number of
samples: the grid of a document is that of the map that needs most, and the grid of all documents
that of the document. `The least` is what choosing among the grids could take at best: if each texel
had the fewest of their samples from which on it is below the error.
"""

import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import report  # noqa: E402  It lies beside.

GRIDS = (1, 4, 16, 64, 256, 1024)


def bake(tool: pathlib.Path, document: pathlib.Path, size: int, samples: str, folder: pathlib.Path,
         more: tuple = ()) -> dict:
    """What the tool says of each map, by its name."""
    command = [tool, "bake", document, "--document", folder / "out.mtlx", "--format", "exr",
               "--size", str(size), "--samples", samples, "--allow-outside", "--json", *more]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"nacre bake failed: {done.stderr}")
    return {pathlib.Path(file["file"]).name: file for file in json.loads(done.stdout)["files"]}


def texels(file: pathlib.Path) -> numpy.ndarray:
    """Through OpenImageIO's program, "Pixel (x, y): 0.1 0.2 0.3" a line; texel by channel."""
    said = subprocess.run(["oiiotool", "--dumpdata", file], check=True, capture_output=True,
                          text=True)
    lines = (line.partition("): ") for line in said.stdout.splitlines())
    return numpy.array([[float(number) for number in numbers.split()]
                        for place, _, numbers in lines if place.lstrip().startswith("Pixel (")])


def off(found: numpy.ndarray, right: numpy.ndarray) -> numpy.ndarray:
    """By how much each texel is."""
    return numpy.max(numpy.abs(found - right) / numpy.maximum(1.0, numpy.abs(right)), axis=1)


def grid_as_good(share: float, shares: list) -> float:
    """Samples of a grid that leaves so many texels above; infinite where none of these does."""
    for grid, (few, high) in enumerate(shares):
        if high > share:
            continue
        if grid == 0:
            return few
        before, higher = shares[grid - 1]
        step = math.log(higher / share) / math.log(higher / high)
        return before * (few / before) ** step
    return math.inf


def least(errors: dict, error: float) -> float:
    """Samples a texel, if each had the fewest that will do."""
    needed = numpy.full(len(errors[GRIDS[0]]), 2.0 * GRIDS[-1])
    is_below = numpy.ones(len(needed), dtype=bool)
    for grid in reversed(GRIDS):
        is_below &= errors[grid] <= error
        needed[is_below] = grid
    return float(numpy.mean(needed))


class Map:
    """What was found of one map for one error."""

    def __init__(self, name: str, taken: float, auto: numpy.ndarray, grids: dict, error: float):
        one = 1.0 / len(auto)  # No share is told from less than one texel.
        self.name, self.taken = name, taken
        self.share = max(one, float(numpy.mean(auto > error)))
        self.shares = [(n, max(one, float(numpy.mean(grids[n] > error)))) for n in GRIDS]
        self.grid = grid_as_good(self.share, self.shares)
        self.least = least(grids, error)

    def cells(self) -> list:
        return [f"{self.taken:.1f}", f"{100 * self.share:.2g}",
                ", ".join(f"{100 * share:.2g}" for _, share in self.shares), *gain(self)]


def gain(found) -> list:
    """The grid as good, how many times auto's samples that is, and the least."""
    some = min(found.grid, GRIDS[-1])  # At least.
    more = "> " if found.grid == math.inf else ""
    return [f"{more}{some:.0f}", f"{more}{some / found.taken:.1f}", f"{found.least:.1f}"]


class Together:
    """Maps of a document, or documents, that one grid is for."""

    def __init__(self, parts: list):
        self.taken = sum(part.taken for part in parts) / len(parts)
        self.grid = max(part.grid for part in parts)
        self.least = sum(part.least for part in parts) / len(parts)


def maps_of(arguments: argparse.Namespace, document: pathlib.Path) -> dict:
    """Of each error what was found of each map."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def baked(kind: str, samples: str, more: tuple = ()) -> tuple:
            (folder / kind).mkdir()
            said = bake(arguments.tool, document, arguments.size, samples, folder / kind, more)
            return said, {each: texels(folder / kind / each) for each in said}

        _, right = baked("right", str(arguments.right))
        grids = {n: baked(str(n), str(n))[1] for n in GRIDS}
        found = {}
        for error in arguments.errors:
            said, auto = baked(f"auto{error}", "auto", ("--texel-error", repr(error)))
            found[error] = [Map(each.removesuffix(".exr"), said[each]["samples_per_texel"],
                                off(auto[each], right[each]),
                                {n: off(grids[n][each], right[each]) for n in GRIDS}, error)
                            for each in said]
        return found


def rows_of(documents: dict) -> list:
    """By document its maps, then all of them; last all documents."""
    rows, all_of_them = [], []
    for name, maps in documents.items():
        rows += [[name, each.name, *each.cells()] for each in maps]
        together = Together(maps)
        all_of_them.append(together)
        if len(maps) > 1:
            rows.append([name, "**all maps**", f"{together.taken:.1f}", "", "", *gain(together)])
    together = Together(all_of_them)
    rows.append(["**all documents**", "", f"{together.taken:.1f}", "", "", *gain(together)])
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("documents", type=pathlib.Path, nargs="+")
    parser.add_argument("--tool", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--right", type=int, default=4096, help="samples that are taken for right")
    parser.add_argument("--errors", type=float, nargs="+", default=[1 / 510, 5e-4])
    arguments = parser.parse_args()
    found = {}
    for document in arguments.documents:
        found[document.stem] = maps_of(arguments, document)
        print(document.stem, flush=True)
    head = ["document", "map", "samples of auto", "texels above, %",
            "of grids of " + ", ".join(map(str, GRIDS)), "grid as good", "over auto", "the least"]
    text = (f"# Samples where they are needed\n\nRun {time.strftime('%Y-%m-%d')}, "
            f"{arguments.size}², by bench/adaptive.py, which says what the columns are. `--samples "
            f"auto` beside as many samples everywhere, against {arguments.right} samples.\n")
    for error in arguments.errors:
        rows = rows_of({name: maps[error] for name, maps in found.items()})
        text += f"\n## `--texel-error {error:.3g}`\n\n" + report.table(head, rows)
    arguments.out.write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
