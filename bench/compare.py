#!/usr/bin/env python3
"""Compares two builds on the benchmarks that both have: is anything slower than it was?

    bench/compare.py OLD_BUILD NEW_BUILD [--only closures nodes] [--filter REGEX] [--rounds 7]

The builds take turns, in the other order each round, so that noise that lasts hits both. A row's
figure is the quickest of its rounds: what disturbs can only add. Rows that look slower than
--limit are measured again, alone and as often, before they are called so; with any left the exit
status is 1. One thread; of no use on a machine that does other work.
"""

import argparse
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

# Those of latency and growth compile: their noise is beyond what is looked for here.
PROGRAMS = ("functions", "nodes", "closures", "materials", "peers", "hosts", "textures")
TIMES = dict[str, float]


def program_of(build: pathlib.Path, name: str) -> pathlib.Path:
    return build / "bench" / name / f"bench_{name}"


def measure(program: pathlib.Path, names: str) -> TIMES:
    """Nanoseconds a point of each benchmark that `names`, a regular expression, finds."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder, "out.json")
        done = subprocess.run(
            [program.resolve(), f"--benchmark_filter={names}", "--benchmark_min_time=0.01",
             f"--benchmark_out={out}", "--benchmark_out_format=json"],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{program} failed with {done.returncode}:\n{done.stderr}")
        rows = json.loads(out.read_text(encoding="utf-8"))["benchmarks"] if out.exists() else []
    return {row["run_name"]: 1e9 / row["items_per_second"] for row in rows
            if not row.get("error_occurred") and row.get("items_per_second")}


def keep_quickest(best: TIMES, times: TIMES) -> None:
    for name, time in times.items():
        best[name] = min(time, best.get(name, time))


def take_turns(programs: tuple[pathlib.Path, pathlib.Path], names: str, rounds: int,
               best: tuple[TIMES, TIMES]) -> None:
    for turn in range(rounds):
        for which in ((0, 1), (1, 0))[turn % 2]:
            keep_quickest(best[which], measure(programs[which], names))


def ratios(best: tuple[TIMES, TIMES]) -> dict[str, float]:
    old, new = best
    return {name: new[name] / old[name] for name in sorted(old.keys() & new.keys())}


def compare(programs: tuple[pathlib.Path, pathlib.Path], names: str, rounds: int,
            limit: float) -> tuple[TIMES, TIMES]:
    best: tuple[TIMES, TIMES] = ({}, {})
    take_turns(programs, names, rounds, best)
    again = [name for name, ratio in ratios(best).items() if ratio > limit]
    if again:
        exactly = "^(" + "|".join(re.escape(name) for name in again) + ")$"
        take_turns(programs, exactly, 2 * rounds, best)
    return best


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old", type=pathlib.Path)
    parser.add_argument("new", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", choices=PROGRAMS, default=PROGRAMS, metavar="PROGRAM")
    parser.add_argument("--filter", default=".", help="a regular expression for rows")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--limit", type=float, default=1.03, help="slower than this is said")
    arguments = parser.parse_args()

    slower = False
    for name in arguments.only:
        programs = (program_of(arguments.old, name), program_of(arguments.new, name))
        missing = [str(program) for program in programs if not program.exists()]
        if missing:
            raise SystemExit(f"not built: {', '.join(missing)}")
        best = compare(programs, arguments.filter, arguments.rounds, arguments.limit)
        found = ratios(best)
        if not found:
            print(f"{name}: no row that both builds have")
            continue
        worse = {row: ratio for row, ratio in found.items() if ratio > arguments.limit}
        print(f"{name}: {len(found)} rows, new over old: median "
              f"{statistics.median(found.values()):.3f}, least {min(found.values()):.3f}, most "
              f"{max(found.values()):.3f}; {len(worse)} above {arguments.limit:g}", flush=True)
        for row, ratio in sorted(worse.items(), key=lambda item: -item[1]):
            print(f"  {ratio:.3f}  {row}: {best[0][row]:.3g} -> {best[1][row]:.3g} ns")
        for which, rows in (("old", best[0].keys() - best[1].keys()),
                            ("new", best[1].keys() - best[0].keys())):
            if rows:
                print(f"  only {which}: {len(rows)}, {min(rows)} and so on")
        slower = slower or bool(worse)
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main())
