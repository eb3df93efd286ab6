#!/usr/bin/env python3
"""usage: check_pkg_config.py LIBDIR SOURCE.c FOLDER ARGUMENTS...

Builds a C host with what pkg-config says, and runs it: status 0 and an answer.
"""

import os
import pathlib
import subprocess
import sys


def main() -> int:
    libdir, source, folder, *arguments = sys.argv[1:]
    environment = os.environ | {"PKG_CONFIG_PATH": f"{libdir}/pkgconfig"}
    flags = subprocess.run(["pkg-config", "--cflags", "--libs", "nacre"], env=environment,
                           capture_output=True, text=True, check=True).stdout.split()
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    host = pathlib.Path(folder) / "host"
    subprocess.run(["gcc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", source, "-o",
                    host, *flags, f"-Wl,-rpath,{libdir}"], check=True)
    answer = subprocess.run([host, *arguments], capture_output=True, text=True, check=True).stdout
    print(answer)
    return 0 if answer.startswith("(0.000, 0.000):") else 1


if __name__ == "__main__":
    sys.exit(main())
