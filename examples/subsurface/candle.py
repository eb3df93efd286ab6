#!/usr/bin/env python3
"""Writes a candle that has burnt down within its rim, with its flame, as a glTF scene.

usage: candle.py OUT.gltf

Names of materials: "wax", "wick", "flame". The flame stands in the hollow, so that what is seen of the
candle's outside is light that went through the wall. A unit is ten centimetres.
"""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from gltf_scene import Scene, arc, revolve  # noqa: E402: the folder above is found by then.

FLAME = 0.1  # Its greatest distance from the axis.


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n")[2])
    scene = Scene("examples/subsurface/candle.py", ("wax", "wick", "flame"))
    candle = [(0.0, 0.0), *arc((0.38, 0.02), 0.02, -90, 0, 5)]
    candle += [(0.4, 0.02 + 0.96 * i / 12) for i in range(1, 13)]
    candle += [*arc((0.355, 0.98), 0.045, 0, 180, 16)[1:]]
    candle += [(0.31, 0.98 - 0.25 * i / 5) for i in range(1, 6)]
    candle += [*arc((0.23, 0.73), 0.08, 0, -90, 8)[1:], (0.0, 0.65)]
    wick = [(0.0, 0.6), (0.018, 0.6), (0.015, 0.76), (0.008, 0.775), (0.0, 0.777)]
    flame = [(0.0, 0.78)]
    flame += [(FLAME * math.sin(math.pi * t) * (1.25 - t) / 0.75, 0.78 + 0.34 * t) for t in (i / 24 for i in range(1, 24))]
    flame += [(0.0, 1.12)]
    for material, (name, profile) in enumerate((("candle", candle), ("wick", wick), ("flame", flame))):
        scene.node(name=name, mesh=scene.mesh(*revolve(profile, 96), material))
    scene.look_at([0.9, 1.75, 2.3], [0.0, 0.52, 0.0], yfov=0.52)
    scene.write(sys.argv[1])


if __name__ == "__main__":
    main()
