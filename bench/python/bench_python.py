#!/usr/bin/env python3
"""Calls of a bound kernel from Python, and what binding and convenience cost beside it; writes
what a Google Benchmark program writes, for bench/run.py and bench/report.py.

    PYTHONPATH=build/python bench/python/bench_python.py --benchmark_out=bench_python.json
"""

import argparse
import datetime
import json
import os
import pathlib
import platform
import time
import tracemalloc
from typing import Any, Callable

import nacre
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
SECONDS = 0.05  # Of one repetition.
REPETITIONS = 9
COUNTS = (1, 65536)

# As in calls.cpp: document, output, what it reads of a point, numbers of each.
CASES = {
    "twice": (ROOT / "bench/documents/twice.mtlx", "out", "uv0", 2, 2),
    "marble": (ROOT / "examples/documents/marble.mtlx", "NG_marble/base_color", "Po", 3, 3),
}


def seconds_of(call: Callable[[], Any], calls: int) -> float:
    start = time.perf_counter()
    for _ in range(calls):
        call()
    return time.perf_counter() - start


def measured(name: str, call: Callable[[], Any], **counters: float) -> list[dict[str, Any]]:
    """Rows of one benchmark: nanoseconds a call, the loop around it included."""
    calls = 1
    while seconds_of(call, calls) < SECONDS / 2:
        calls *= 2
    return [{"name": name, "run_name": name, "run_type": "iteration", "iterations": calls,
             "real_time": 1e9 * seconds_of(call, calls) / calls, "time_unit": "ns", **counters}
            for _ in range(REPETITIONS)]


def bytes_allocated(call: Callable[[], Any]) -> int:
    """The most that Python and NumPy had at once, of what a call took."""
    call()
    tracemalloc.start()
    call()
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return most


def shader_of(system: nacre.System, case: str, engine: str) -> nacre.Shader:
    document, output, *_ = CASES[case]
    return system.compile_outputs(nacre.Document(document), [output], engine=engine,
                                  no_footprints=True)


def rows_of(system: nacre.System, case: str, count: int) -> list[dict[str, Any]]:
    _, output, channel, inputs, outputs = CASES[case]
    numbers = numpy.arange(inputs * count) * 37 % 1024 / 1024
    arrays = {channel: numpy.float32(numbers).reshape(count, inputs),
              output: numpy.zeros((count, outputs), "float32")}
    shader = shader_of(system, case, "jit")
    binding = shader.bind(arrays)
    binding.run(nacre.Entry.OUTPUTS)
    name = f"python/{case}/{count}"
    expected = shader_of(system, case, "interpreter").run({channel: arrays[channel]})[output]
    if not numpy.array_equal(arrays[output], expected):
        return [{"name": name, "run_name": name, "run_type": "iteration", "error_occurred": True,
                 "error_message": "not what is interpreted"}]
    run, entry = binding.run, nacre.Entry.OUTPUTS
    bytes_of_call = bytes_allocated(lambda: run(entry, count))
    return [*measured(f"{name}/bound", lambda: run(entry, count), bytes=bytes_of_call),
            *measured(f"{name}/bind", lambda: shader.bind(arrays)),
            *measured(f"{name}/run", lambda: shader.run(arrays))]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--benchmark_out", type=pathlib.Path, required=True)
    arguments, _ = parser.parse_known_args()
    system = nacre.System()
    rows = [row for case in CASES for count in COUNTS for row in rows_of(system, case, count)]
    context = {"date": datetime.datetime.now().isoformat(), "host_name": platform.node(),
               "run": os.environ.get("NACRE_BENCH_RUN", "none"),
               "python": platform.python_version(), "numpy": numpy.__version__}
    arguments.benchmark_out.write_text(json.dumps({"context": context, "benchmarks": rows}))


if __name__ == "__main__":
    main()
