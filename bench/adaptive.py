#!/usr/bin/env python3
"""Samples that `nacre bake --samples auto` takes beside those of a fixed grid of the same error.

    bench/adaptive.py --tool build/bin/nacre --out bench/results/adaptive.md FILE.mtlx ...

Every map of the documents' materials is baked with many samples, which is taken for right; by
--samples auto for a texel error; and with 1, 4, 16, ... samples everywhere. The error is the root
of the mean square over the texels, of the channel that is worst, relative to values above 1. The
fixed grid of the error that auto has is read off between two grids, log against log. Beside it:
texels that are off by more than was asked.
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

GRIDS = (1, 4, 16, 64, 256)
LEAST_GAIN = 3.0


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


def wrong(found: numpy.ndarray, right: numpy.ndarray, error: float) -> float:
    """The share of texels."""
    off = numpy.abs(found - right) / numpy.maximum(1.0, numpy.abs(right))
    return float(numpy.mean(numpy.max(off, axis=1) > error))


def rms(found: numpy.ndarray, right: numpy.ndarray) -> float:
    off = (found - right) / numpy.maximum(1.0, numpy.abs(right))
    return float(numpy.max(numpy.sqrt(numpy.mean(off * off, axis=0))))


def samples_for(error: float, grids: list) -> float:
    """Of a fixed grid that has such an error; infinite where none of these does."""
    for (few, high), (many, low) in zip(grids, grids[1:]):
        if error > high:
            return few
        if low <= error:
            if low <= 0.0 or high <= low:
                return many
            step = math.log(high / max(error, low)) / math.log(high / low)
            return few * (many / few) ** step
    return math.inf


def rows_of(arguments: argparse.Namespace, document: pathlib.Path) -> list:
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        folders = {kind: folder / kind for kind in ("right", "auto", *map(str, GRIDS))}
        for each in folders.values():
            each.mkdir()
        maps = bake(arguments.tool, document, arguments.size, str(arguments.right), folders["right"])
        found = bake(arguments.tool, document, arguments.size, "auto", folders["auto"],
                     ("--texel-error", repr(arguments.error)))
        for grid in GRIDS:
            bake(arguments.tool, document, arguments.size, str(grid), folders[str(grid)])
        rows = []
        for map_name in maps:
            right = texels(folders["right"] / map_name)
            auto = texels(folders["auto"] / map_name)
            error = rms(auto, right)
            fixed = {n: texels(folders[str(n)] / map_name) for n in GRIDS}
            grids = [(n, rms(fixed[n], right)) for n in GRIDS]
            taken = found[map_name]["samples_per_texel"]
            needed = samples_for(error, grids)
            gain = min(needed, GRIDS[-1]) / taken  # At least.
            errors = ", ".join(f"{each:.2g}" for _, each in grids)
            share = 100 * wrong(auto, right, arguments.error)
            rows.append([document.stem, map_name.removesuffix(".exr"), f"{taken:.1f}",
                         f"{error:.2g}", f"{share:.2g}", errors,
                         f"{needed:.0f}" if needed < math.inf else f"> {GRIDS[-1]}",
                         f"{gain:.1f}" if needed < math.inf else f"> {gain:.1f}",
                         "yes" if gain >= LEAST_GAIN else "**no**"])
            print(rows[-1], flush=True)
        return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("documents", type=pathlib.Path, nargs="+")
    parser.add_argument("--tool", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--size", type=int, default=512)
    parser.add_argument("--right", type=int, default=1024, help="samples that are taken for right")
    parser.add_argument("--error", type=float, default=1 / 510)
    arguments = parser.parse_args()
    rows = [row for document in arguments.documents for row in rows_of(arguments, document)]
    head = ["document", "map", "samples of auto", "error", "texels above, %",
            "error of grids of " + ", ".join(map(str, GRIDS)), "grid as good", "gain",
            f"≥ {LEAST_GAIN:g}"]
    arguments.out.write_text(
        f"# Samples where they are needed\n\nRun {time.strftime('%Y-%m-%d')}, {arguments.size}², by "
        f"bench/adaptive.py. `--samples auto --texel-error {arguments.error:.3g}` beside as many "
        f"samples everywhere, against {arguments.right} samples. Error: the root of the mean square over "
        "texels. The grid as good has that of auto, between two of those measured.\n\n"
        + report.table(head, rows), encoding="utf-8")
    print(arguments.out.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
