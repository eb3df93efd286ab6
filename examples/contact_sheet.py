#!/usr/bin/env python3
"""Puts pictures on one labelled sheet.

usage: contact_sheet.py OUT.png PICTURE.png... [--columns N] [--size PIXELS]

Labels are the files' names without folder and extension.
"""

import argparse
import math
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.image
import matplotlib.pyplot


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out")
    parser.add_argument("pictures", nargs="+")
    parser.add_argument("--columns", type=int, default=4)
    parser.add_argument("--size", type=int, default=256, help="pixels a picture")
    arguments = parser.parse_args()

    columns = min(arguments.columns, len(arguments.pictures))
    rows = math.ceil(len(arguments.pictures) / columns)
    inches = arguments.size / 100
    figure, axes = matplotlib.pyplot.subplots(
        rows, columns, squeeze=False, dpi=100, figsize=(columns * inches, rows * inches * 1.1)
    )
    for axis in axes.flat:
        axis.axis("off")
    for axis, name in zip(axes.flat, arguments.pictures):
        axis.imshow(matplotlib.image.imread(name), interpolation="antialiased", cmap="gray", vmin=0, vmax=1)
        axis.set_title(pathlib.Path(name).stem, fontsize=max(5, arguments.size / 32), pad=2)
    figure.subplots_adjust(left=0, right=1, bottom=0, top=1 - 0.08 / rows, wspace=0.02, hspace=0.1)
    figure.savefig(arguments.out)


if __name__ == "__main__":
    main()
