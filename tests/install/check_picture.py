#!/usr/bin/env python3
"""usage: check_picture.py PICTURE.ppm

Fails unless it is a whole picture with light and shadow in it.
"""

import pathlib
import sys


def main() -> int:
    kind, size, _, pixels = pathlib.Path(sys.argv[1]).read_bytes().split(b"\n", 3)
    width, height = (int(number) for number in size.split())
    values = sorted(pixels)
    dark, bright = (values[int(share * (len(values) - 1))] for share in (0.02, 0.98))
    print(f"{width} x {height}, from {dark} to {bright}")
    return 0 if kind == b"P6" and len(pixels) == 3 * width * height and dark < 60 < 180 < bright else 1


if __name__ == "__main__":
    sys.exit(main())
