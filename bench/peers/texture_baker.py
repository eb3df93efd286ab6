#!/usr/bin/env python3
"""Bakes documents by `nacre bake` and by MaterialX's TextureBaker, in turns, and writes a table.

    bench/peers/texture_baker.py --materials MATERIALX/resources/Materials/Examples/StandardSurface \\
        --tool build/bin/nacre --out bench/results/bake.md

TextureBaker comes from PyPI, into a folder of its own (--venv), and renders by Mesa's llvmpipe on a
display of Xvfb's (Debian: xvfb, libgl1-mesa-dri). Where one of these is missing the script says so
and ends: there is no table without the peer.
"""

import argparse
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from typing import NamedTuple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import report  # noqa: E402  It lies above.

MATERIALX = "materialx==1.39.4"
DOCUMENTS = {"marble": "standard_surface_marble_solid.mtlx",
             "brick": "standard_surface_brick_procedural.mtlx",
             "wood": "standard_surface_wood_tiled.mtlx"}
LEAST_RATIO = 4.0  # Against the peer.
MOST_OF_SHADING = 1.5  # Against shading and writing raw bytes.


class Process(NamedTuple):
    seconds: float
    cpu: float  # Of user and system.
    status: int
    said: str
    complained: str


class Ours(NamedTuple):
    seconds: float  # Of the whole process.
    cpu: float
    baking: float  # Of its maps: without starting, reading and compiling.
    shading: float  # Processor time by the number of threads.
    raw_bytes: int
    maps: int
    bytes: int


def skip(why: str) -> None:
    raise SystemExit(f"not measured: {why}")


def baker_of(venv: pathlib.Path) -> pathlib.Path:
    """MaterialX's script, installed if it is not there."""
    script = venv / "bin" / "baketextures"
    if not script.is_file():
        made = subprocess.run([sys.executable, "-m", "venv", venv], capture_output=True, text=True)
        if made.returncode == 0:
            made = subprocess.run([venv / "bin" / "pip", "install", "--quiet", MATERIALX],
                                  capture_output=True, text=True)
        if made.returncode != 0 or not script.is_file():
            skip(f"{MATERIALX} could not be installed: {made.stderr.strip()}")
    return script


def run(command: list, environment: dict | None = None) -> Process:
    with tempfile.TemporaryFile("w+") as said, tempfile.TemporaryFile("w+") as complained:
        start = time.perf_counter()
        process = subprocess.Popen(command, stdout=said, stderr=complained, env=environment)
        _, status, used = os.wait4(process.pid, 0)
        seconds = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        complained.seek(0)
        return Process(seconds, used.ru_utime + used.ru_stime, process.returncode, said.read(),
                       complained.read())


def folder_size(folder: pathlib.Path) -> int:
    return sum(file.stat().st_size for file in folder.iterdir() if file.suffix == ".png")


def run_peer(script: pathlib.Path, document: pathlib.Path, size: int, display: str,
             folder: pathlib.Path) -> tuple[float, float, int, int]:
    environment = os.environ | {"DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1"}
    done = run([script, "--width", str(size), "--height", str(size), document,
                folder / "out.mtlx"], environment)
    maps = sum(1 for file in folder.iterdir() if file.suffix == ".png")
    if done.status != 0 or maps == 0:
        skip(f"TextureBaker failed: {(done.complained or done.said).strip()[-500:]}")
    return done.seconds, done.cpu, maps, folder_size(folder)


def run_ours(tool: pathlib.Path, document: pathlib.Path, size: int, form: str,
             folder: pathlib.Path) -> Ours:
    done = run([tool, "bake", document, "--document", folder / "out.mtlx", "--format", form,
                "--size", str(size), "--allow-outside", "--clip", "--json"])
    if done.status != 0:
        raise SystemExit(f"nacre bake failed: {done.complained}")
    files = json.loads(done.said)["files"]
    raw = sum(f["width"] * f["height"] * len(f["channels"]) * f["bits"] // 8 for f in files)
    threads = os.cpu_count() or 1
    return Ours(done.seconds, done.cpu, sum(f["seconds"] for f in files),
                sum(f["shading_cpu_seconds"] for f in files) / threads, raw, len(files),
                sum(f["bytes"] for f in files))


def write_raw(count: int, folder: pathlib.Path) -> float:
    """Seconds to write so many bytes to the disk; not all alike, made before."""
    piece = os.urandom(1 << 20)
    start = time.perf_counter()
    with open(folder / "raw", "wb", buffering=0) as file:
        for _ in range(0, count, len(piece)):
            file.write(piece)
        os.fsync(file.fileno())
    return time.perf_counter() - start


def start_display() -> tuple[subprocess.Popen, str]:
    if shutil.which("Xvfb") is None:
        skip("there is no Xvfb (Debian: xvfb)")
    reader, writer = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writer), "-screen", "0", "640x480x24"],
                              pass_fds=[writer], stderr=subprocess.DEVNULL)
    os.close(writer)
    with os.fdopen(reader) as said:
        number = said.readline().strip()
    if not number:
        skip("Xvfb did not start")
    return server, f":{number}"


def verdict(met: bool) -> str:
    return "yes" if met else "**no**"


def measure(arguments: argparse.Namespace, script: pathlib.Path, display: str) -> str:
    rows, parts, floats = [], [], []
    for name, file in DOCUMENTS.items():
        document = arguments.materials / file
        if not document.is_file():
            skip(f"there is no {document}")
        peers, ours, raws, exrs = [], [], [], []
        for _ in range(arguments.repetitions):
            with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as two, \
                    tempfile.TemporaryDirectory() as three:
                peers.append(run_peer(script, document, arguments.size, display,
                                      pathlib.Path(one)))
                ours.append(run_ours(arguments.tool, document, arguments.size, "png",
                                     pathlib.Path(two)))
                raws.append(write_raw(ours[-1].raw_bytes, pathlib.Path(two)))
                exrs.append(run_ours(arguments.tool, document, arguments.size, "exr",
                                     pathlib.Path(three)))
            print(f"{name}: TextureBaker {peers[-1][0]:.2f} s, nacre {ours[-1].seconds:.2f} s",
                  flush=True)
        peer, peer_cpu = (statistics.median(each[i] for each in peers) for i in (0, 1))
        mine = Ours(*(statistics.median(figures) for figures in zip(*ours)))
        float_mine = Ours(*(statistics.median(figures) for figures in zip(*exrs)))
        raw = statistics.median(raws)
        least = mine.shading + raw
        rows.append([name, report.number(peer), report.number(peer_cpu),
                     f"{peers[0][2]}, {peers[0][3] / 1e6:.1f}", report.number(mine.seconds),
                     report.number(mine.cpu), f"{ours[0].maps}, {mine.bytes / 1e6:.1f}",
                     f"{peer / mine.seconds:.1f}", verdict(peer / mine.seconds >= LEAST_RATIO)])
        parts.append([name, report.number(mine.baking), report.number(mine.shading), report.number(raw),
                     f"{mine.baking / least:.2f}", verdict(mine.baking / least <= MOST_OF_SHADING)])
        floats.append([name, report.number(float_mine.seconds), report.number(float_mine.baking),
                       report.number(float_mine.shading), f"{float_mine.raw_bytes / 1e6:.0f}",
                       f"{float_mine.bytes / 1e6:.0f}"])
    head = ["document", "TextureBaker, s", "CPU s", "maps, MB", "nacre bake, s", "CPU s",
            "maps, MB", "ratio", f"≥ {LEAST_RATIO:g}"]
    return (report.table(head, rows)
            + "\nOf ours the maps alone, without starting, reading and compiling; shading alone "
            "(processor time divided by the number of CPUs, images read meanwhile among it); and "
            "what it takes to write the maps' raw bytes to the disk:\n\n"
            + report.table(["document", "maps, s", "shading, s", "raw bytes, s",
                            "maps / (shading + raw)", f"≤ {MOST_OF_SHADING:g}"], parts)
            + "\n32-bit EXR, which TextureBaker does not write:\n\n"
            + report.table(["document", "nacre bake, s", "maps alone, s", "shading, s", "raw MB",
                            "MB"], floats))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--materials", type=pathlib.Path, required=True,
                        help="MaterialX's folder of StandardSurface examples")
    parser.add_argument("--tool", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--venv", type=pathlib.Path,
                        default=pathlib.Path(tempfile.gettempdir()) / "nacre-bench-materialx")
    parser.add_argument("--size", type=int, default=4096)
    parser.add_argument("--repetitions", type=int, default=5)
    arguments = parser.parse_args()
    script = baker_of(arguments.venv)
    server, display = start_display()
    try:
        tables = measure(arguments, script, display)
    finally:
        server.terminate()
        server.wait()
    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    arguments.out.write_text(
        f"# Baking\n\n{report.cpu_model()}, {os.cpu_count()} CPUs; run {time.strftime('%Y-%m-%d')}, "
        f"{arguments.size}², by bench/peers/texture_baker.py. The materials of MaterialX's examples "
        f"as documents with textures, 8-bit PNG: by TextureBaker ({MATERIALX} from PyPI) on Mesa's "
        "llvmpipe and by `nacre bake --document`. Whole processes, from nothing to their end, in "
        f"turns; medians of {arguments.repetitions}. The load of the machine was "
        f"{os.getloadavg()[2]:.1f} over the last 15 minutes.\n\n" + tables, encoding="utf-8")
    print(arguments.out.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
