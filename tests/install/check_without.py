#!/usr/bin/env python3
"""usage: check_without.py SOURCE FOLDER DATA_LIBRARY HOST.c

Builds and installs Nacre without OpenImageIO and OpenColorIO, in FOLDER, and sees that it shades,
and what it says to who gives it an image or a configuration.
"""

import os
import pathlib
import subprocess
import sys

import documents

SOURCE, FOLDER, DATA, HOST = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
PREFIX = FOLDER / "prefix"


def build() -> None:
    # Without these, what is not looked for cannot be found.
    hidden = [f"-DNACRE_{name}=/nonesuch" for name in
              ("OIIO_INCLUDE", "OIIO_LIBRARY", "OIIO_UTIL_LIBRARY", "OCIO_INCLUDE", "OCIO_LIBRARY")]
    subprocess.run(["cmake", "-S", SOURCE, "-B", FOLDER / "build", "-G", "Ninja",
                    "-DCMAKE_BUILD_TYPE=Release", "-DNACRE_WITH_OPENIMAGEIO=OFF",
                    "-DNACRE_WITH_OPENCOLORIO=OFF", "-DNACRE_WERROR=ON", "-DNACRE_BUILD_TESTS=OFF",
                    "-DNACRE_BUILD_BENCH=OFF", "-DNACRE_BUILD_PYTHON=OFF",
                    f"-DNACRE_MATERIALX_LIBRARIES={DATA}", *hidden], check=True)
    subprocess.run(["cmake", "--build", FOLDER / "build"], check=True)
    subprocess.run(["cmake", "--install", FOLDER / "build", "--prefix", PREFIX], check=True,
                   stdout=subprocess.DEVNULL)


def build_host() -> pathlib.Path:
    package = next(PREFIX.rglob("nacre.pc")).parent
    environment = os.environ | {"PKG_CONFIG_PATH": str(package)}
    flags = subprocess.run(["pkg-config", "--cflags", "--libs", "nacre"], env=environment,
                           capture_output=True, text=True, check=True).stdout.split()
    host = FOLDER / "host"
    subprocess.run(["gcc", "-std=c99", HOST, "-o", host, *flags,
                    f"-Wl,-rpath,{package.parent}"], check=True)
    return host


def main() -> int:
    FOLDER.mkdir(parents=True, exist_ok=True)
    build()
    host, tool = build_host(), PREFIX / "bin" / "nacre"
    document, config = documents.write(FOLDER)
    marble = SOURCE / "examples" / "documents" / "marble.mtlx"
    graph = "NG_marble/base_color"
    bake = ["--output", graph, "--size", "8", "--out", FOLDER / "out"]
    wanted = (
        ([tool, "--version"], 0, ""),
        ([tool, "check", marble], 0, ""),
        ([tool, "check", document], 1, "this build of Nacre reads no images but JPEG"),
        ([tool, "bake", marble, *bake], 0, ""),
        ([tool, "bake", marble, *bake, "--format", "tx"], 1, "this build of Nacre writes no .tx"),
        ([host, "outputs", marble, graph], 0, ""),
        ([host, "outputs", document, "NG_image/out"], 1, "[no-image-reader]"),
        ([host, "colors", config], 1, "[no-color-reader]"),
    )
    faults = 0
    for command, status, said in wanted:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != status or said not in done.stderr:
            faults += 1
            print(f"{command}: status {done.returncode}, not {status} with '{said}':\n{done.stderr}")
    modules = [*PREFIX.rglob("nacre_*.so"), *PREFIX.rglob("*.imageio.so")]
    if modules:
        print(f"installed all the same: {modules}")
    return 1 if faults or modules else 0


if __name__ == "__main__":
    sys.exit(main())
