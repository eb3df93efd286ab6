#!/usr/bin/env python3
"""Runs benchmark programs, one after another, into one folder of JSON files.

    bench/run.py --out build/bench-results build/bench/peers/bench_peers ...

All files carry the name of the run, so that bench/report.py can refuse to mix runs.
Comparisons repeat and interleave their benchmarks: noise that lasts hits all of them.
"""

import argparse
import os
import pathlib
import subprocess
import sys
import time
import uuid

COMPARED = ("--benchmark_repetitions=9", "--benchmark_enable_random_interleaving=true",
            "--benchmark_min_time=0.05")
SURVEYED = ("--benchmark_repetitions=3", "--benchmark_min_time=0.01")
FLAGS = {
    "bench_growth": ("--benchmark_repetitions=3", "--benchmark_min_time=0.01"),
    "bench_latency": ("--benchmark_repetitions=5", "--benchmark_min_time=0.2"),
    "bench_peers": COMPARED,
    "bench_textures": COMPARED,
}


def run(program: pathlib.Path, out: pathlib.Path, name: str) -> bool:
    flags = FLAGS.get(program.name, SURVEYED)
    start = time.monotonic()
    interpreter = [sys.executable] if program.suffix == ".py" else []
    done = subprocess.run(
        [*interpreter, program, *flags, f"--benchmark_out={out / program.stem}.json",
         "--benchmark_out_format=json"],
        env=os.environ | {"NACRE_BENCH_RUN": name}, stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE, text=True)
    print(f"{program.name}: {time.monotonic() - start:.0f} s", flush=True)
    if done.returncode != 0:
        print(done.stderr, file=sys.stderr)
    return done.returncode == 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("programs", type=pathlib.Path, nargs="+")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    for old in arguments.out.glob("*.json"):
        old.unlink()
    name = time.strftime("%Y-%m-%d ") + uuid.uuid4().hex[:8]
    results = [run(program.resolve(), arguments.out, name) for program in arguments.programs]
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
