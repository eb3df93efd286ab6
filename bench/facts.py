#!/usr/bin/env python3
"""What is left out of kernels because of what values may be: of MaterialX's sample materials.

    PYTHONPATH=build/python bench/facts.py --materials MATERIALX/resources/Materials \\
        --out bench/results/facts.md [--before OLD_BUILD/python]

Operations and time of the kernel that does all of a point (SHADE), by what is known: nothing; what
ranges of its values follow from constants and clamps; and facts, of points (unit vectors that are
seen from the front, the unit square) or of live parameters (each is what the document says).
`--before` is a package of before there were ranges.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy

import report

UNIT = ("N", "Ng", "No", "T", "To", "B", "Bo", "wo", "wi")
FACTS = {f"dot({name},{name})": (0.999, 1.001) for name in UNIT} | {
    "uv0": (0, 1), "uv1": (0, 1), "color0": (0, 1), "u": (0, 1), "P": (-1, 1), "Po": (-1, 1),
    "dot(N,wo)": (0.01, 1.001), "dot(Ng,wo)": (0.01, 1.001)}
COUNT = 2048
WAYS = ("frozen", "frozen with facts", "live", "live with facts")


def points() -> dict[str, numpy.ndarray]:
    random = numpy.random.default_rng(3)

    def directions(least):
        z = least + (1 - least) * random.random(COUNT)
        turn = 2 * numpy.pi * random.random(COUNT)
        across = numpy.sqrt(1 - z * z)
        return numpy.stack([across * numpy.cos(turn), across * numpy.sin(turn), z], 1)

    arrays = {"wo": directions(0.02), "wi": directions(-1), "u": random.random((COUNT, 3)),
              "P": 2 * random.random((COUNT, 3)) - 1, "uv0": random.random((COUNT, 2)),
              "uv1": random.random((COUNT, 2)), "color0": random.random((COUNT, 4))}
    for name, axis in {"N": (0, 0, 1), "T": (1, 0, 0), "B": (0, 1, 0)}.items():
        arrays[name] = numpy.tile(axis, (COUNT, 1))
    arrays |= {name: arrays[name[0]] for name in ("Ng", "No", "To", "Bo", "Po")}
    # As columns: a number of all points lies together, which is how hosts have them.
    return {name: numpy.asfortranarray(array, numpy.float32) for name, array in arrays.items()}


class Way:
    """A material's kernel, made and bound."""

    def __init__(self, nacre, system, document, material, way, images):
        options = dict(entries=[nacre.Entry.SHADE], no_footprints=True, missing_images_pass=True,
                       files_anywhere=True, search_paths=[images])
        if way.startswith("live"):
            options["live"] = ["*"]
        if way.endswith("facts"):
            options["facts"] = FACTS
        if way == "live with facts":
            values = system.compile_material(document, material, **options).parameters
            options["facts"] = FACTS | {
                name if len(numbers) == 1 else f"{name}.{'xyzw'[i]}": (number, number)
                for name in values if not name.startswith(("object_to", "world_to"))
                for numbers in [numpy.atleast_1d(values[name])] if len(numbers) <= 4
                for i, number in enumerate(map(float, numbers))}
        self.shader = system.compile_material(document, material, **options)
        self.entry = nacre.Entry.SHADE
        arrays = points()
        for channel in self.shader.inputs(self.entry):
            group = channel.name.rsplit(".", 1)[0]
            if group not in arrays and channel.name not in arrays:
                arrays[channel.name] = numpy.zeros(COUNT, numpy.float32)
        self.binding = self.shader.bind(arrays, entries=[self.entry])
        self.nanoseconds()

    def nanoseconds(self) -> float:
        calls = 8
        start = time.perf_counter()
        for _ in range(calls):
            self.binding.run(self.entry, COUNT)
        return 1e9 * (time.perf_counter() - start) / (calls * COUNT)


def serve(materials: pathlib.Path, images: str) -> None:
    """Times what it is asked for, a line each, for the process that compares."""
    import warnings

    import nacre
    warnings.simplefilter("ignore")
    system = nacre.System()
    for line in sys.stdin:
        file, material, ways, rounds = json.loads(line)
        document = nacre.Document(str(materials / file))
        made = [Way(nacre, system, document, material, way, images) for way in ways]
        times = [min(way.nanoseconds() for _ in range(rounds)) for way in made]
        outside = sum(way.shader.points_outside_facts for way in made
                      if hasattr(way.shader, "points_outside_facts"))
        print(json.dumps({"times": times, "outside": outside}), flush=True)


class Worker:
    def __init__(self, package: str, materials: pathlib.Path, images: str):
        self.process = subprocess.Popen(
            [sys.executable, __file__, "--materials", str(materials), "--serve", images], text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            env=dict(os.environ, PYTHONPATH=package))

    def ask(self, *request) -> dict:
        self.process.stdin.write(json.dumps(request) + "\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())


def operations(tool: str, file: pathlib.Path, images: str, way: str) -> dict[str, tuple[int, int]]:
    """By material: of all its kernels, before and after what cannot happen is left out."""
    command = [tool, "inspect", str(file), "--json", "--quiet", "--missing-images", "default",
               "--allow-outside", "--search-path", images, "--backend", "interpreter"]
    if way.startswith("live"):
        command.append("--live")
    if way.endswith("facts"):
        command += [f"--fact={name}={low},{high}" for name, (low, high) in FACTS.items()]
    found = json.loads(subprocess.run(command, capture_output=True, text=True).stdout or "[]")
    counts = {}
    for each in found:
        if "material" not in each:
            continue
        total = [sum(stage["instructions"] for stage in each["stages"]
                     if stage["stage"].endswith(": " + name)) for name in ("expand_math", "decide")]
        counts[each["material"]] = tuple(total)
    return counts


def median(values) -> str:
    return f"{statistics.median(values):.2f}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--materials", type=pathlib.Path, required=True)
    parser.add_argument("--nacre", default="build/bin/nacre")
    parser.add_argument("--before", help="the Python package of another build, without ranges")
    parser.add_argument("--rounds", type=int, default=12)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--serve", help=argparse.SUPPRESS)
    asked = parser.parse_args()
    if asked.serve:
        return serve(asked.materials, asked.serve)
    with tempfile.TemporaryDirectory() as images:
        # The documents name images as "resources/Images/..." from MaterialX's own root.
        os.symlink(asked.materials.resolve().parent, pathlib.Path(images) / "resources")
        write(asked, images)


def write(asked, images: str) -> None:
    workers = {"now": Worker(os.environ.get("PYTHONPATH", ""), asked.materials, images)}
    if asked.before:
        workers["before"] = Worker(asked.before, asked.materials, images)
    rows = []
    for file in sorted(asked.materials.rglob("*.mtlx")):
        name = str(file.relative_to(asked.materials))
        counts = {way: operations(asked.nacre, file, images, way)
                  for way in ("frozen", "frozen with facts", "live")}
        for material, (written, ranges) in counts["frozen"].items():
            row = {"name": f"{file.stem}: {material}", "written": written, "ranges": ranges,
                   "facts": counts["frozen with facts"][material][1],
                   "live written": counts["live"][material][0],
                   "live ranges": counts["live"][material][1]}
            for which, worker in workers.items():
                ways = WAYS if which == "now" else WAYS[::2]
                answer = worker.ask(name, material, ways, asked.rounds)
                assert answer["outside"] == 0, row["name"]
                row |= {f"{which} {way}": each for way, each in zip(ways, answer["times"])}
            rows.append(row)
            print(row["name"], file=sys.stderr, flush=True)
    text = table(rows)
    if asked.out:
        asked.out.write_text(text)
    else:
        print(text)


def table(rows: list[dict]) -> str:
    has_before = "before frozen" in rows[0]

    def share(numerator: str, denominator: str) -> str:
        return median(row[numerator] / row[denominator] for row in rows if row[denominator] > 0)

    def total(name: str) -> int:
        return sum(row[name] for row in rows)

    lines = [
        "# What cannot happen, and is left out", "",
        f"{report.cpu_model()}; {len(rows)} materials of MaterialX's samples, `standard`. "
        "Operations of all kernels together (those of `nacre inspect`): as written, without what "
        "ranges of values exclude, and without what facts exclude besides. Nanoseconds a point of "
        f"the kernel that does all at once, {COUNT} points a call, one thread"
        + (", beside what it took before there were ranges, by another build in turns with this "
           "one" if has_before else "") + ". Facts: vectors are units, points are seen from the "
        "front and have uv in the unit square; with live parameters, each is what the document "
        "says. All gave the same bits (`CorpusFacts`), and no point was outside.", "",
        f"Frozen: {total('written')} operations, {total('ranges')} with ranges, {total('facts')} "
        f"with facts; time with facts, of that without: {share('now frozen with facts', 'now frozen')} "
        "in the median" + (f"; with ranges, of before: {share('now frozen', 'before frozen')}"
                           if has_before else "") + ".", "",
        f"Live: {total('live written')} operations, {total('live ranges')} with ranges; time with "
        f"facts, of that without: {share('now live with facts', 'now live')} in the median"
        + (f"; with ranges, of before: {share('now live', 'before live')}" if has_before else "")
        + ".", ""]
    columns = {"operations": "written", "ranges": "ranges", "facts": "facts"}
    if has_before:
        columns["ns before"] = "before frozen"
    columns |= {"ns": "now frozen", "with facts": "now frozen with facts"}
    if has_before:
        columns["live, ns before"] = "before live"
    columns |= {"live, ns": "now live", "live with facts": "now live with facts"}
    cells = [[row["name"]] + [str(row[key]) if isinstance(row[key], int) else f"{row[key]:.3g}"
                              for key in columns.values()] for row in rows]
    return "\n".join(lines) + "\n" + report.table(["material", *columns], cells)


if __name__ == "__main__":
    main()
