#!/usr/bin/env python3
"""Measures what it takes to load Nacre, before the first line of work, and to go on from there.

    bench/startup.py --host build/bench/startup/startup_host --tool build/bin/nacre --out startup.md
"""

import argparse
import os
import pathlib
import statistics
import struct
import subprocess
import tempfile
import time
from typing import NamedTuple

import report

ROOT = pathlib.Path(__file__).resolve().parent.parent
MARBLE = ROOT / "examples" / "documents" / "marble.mtlx"

IMAGE = """<?xml version="1.0"?>
<materialx version="1.39">
  <nodegraph name="NG_image">
    <image name="image1" type="color3">
      <input name="file" type="filename" value="black.tga" />
    </image>
    <output name="out" type="color3" nodename="image1" />
  </nodegraph>
</materialx>
"""

COLORS = """ocio_profile_version: 2
roles: {scene_linear: linear, default: linear, aces_interchange: linear}
file_rules: [!<Rule> {name: Default, colorspace: default}]
displays: {sRGB: [!<View> {name: Raw, colorspace: linear}]}
colorspaces:
  - !<ColorSpace> {name: linear}
"""


class Run(NamedTuple):
    cpu: float  # Milliseconds, of user and system.
    wall: float
    megabytes: float  # The most that were resident at once.


def run(command: list) -> tuple[Run, str]:
    start = time.perf_counter()
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        said = process.stdout.read()
        _, status, used = os.wait4(process.pid, 0)
        wall = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"{command} ended with {process.returncode}")
    cpu = used.ru_utime + used.ru_stime
    return Run(1e3 * cpu, 1e3 * wall, used.ru_maxrss * 1024 / 1e6), said


def linked(program: pathlib.Path) -> int:
    """Libraries that the loader brings in, the loader among them."""
    listing = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    return sum("/" in line for line in listing.splitlines())


def row(what: str, command: list, repetitions: int, libraries: int | None = None) -> list[str]:
    runs = [run(command) for _ in range(repetitions + 1)][1:]  # The first one reads from the disk.
    median = Run(*(statistics.median(figures) for figures in zip(*(each for each, _ in runs))))
    count = libraries if libraries is not None else int(runs[0][1])
    return [what, str(count), *(report.number(figure) for figure in median)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--host", type=pathlib.Path, required=True)
    parser.add_argument("--tool", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--repetitions", type=int, default=21)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "image.mtlx").write_text(IMAGE, encoding="utf-8")
        (folder / "config.ocio").write_text(COLORS, encoding="utf-8")
        header = struct.pack("<3B5B4H2B", 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 2, 2, 8, 0)
        (folder / "black.tga").write_bytes(header + bytes(4))
        host = arguments.host
        programs = [
            ("a host: nacre_version()", [host, "version"], None),
            ("a host: a system", [host, "system"], None),
            ("a host: a texture of no image", [host, "texture", MARBLE, "NG_marble/base_color"],
             None),
            ("a host: a texture of an image", [host, "texture", folder / "image.mtlx",
                                               "NG_image/out"], None),
            ("a host: a system with a configuration", [host, "colors", folder / "config.ocio"],
             None),
        ]
        if arguments.tool is not None:
            count = linked(arguments.tool)
            programs += [("nacre --version", [arguments.tool, "--version"], count),
                         ("nacre check", [arguments.tool, "check", MARBLE], count)]
        rows = [row(what, command, arguments.repetitions, count)
                for what, command, count in programs]
    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    arguments.out.write_text(
        f"# Starting\n\n{report.cpu_model()}, {os.cpu_count()} CPUs; run "
        f"{time.strftime('%Y-%m-%d')}. Whole processes, from nothing to their end: medians of "
        f"{arguments.repetitions} runs, CPU time of user and system.\n\n"
        + report.table(["what", "shared libraries", "CPU ms", "ms", "MB"], rows), encoding="utf-8")
    print(arguments.out.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
