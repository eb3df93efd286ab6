#!/usr/bin/env python3
"""Writes a disc of metal that was turned on a lathe, with a knob, under two lamps, as a glTF scene.

usage: scene.py OUT.gltf

Names of materials: "steel", "knob", "lamp". The disc's axis is the y axis of its own space, which its
brushing goes around (disc.mtlx); it has no uv, and needs none.
"""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from gltf_scene import Scene, arc, quad, revolve  # noqa: E402: the folder above is found by then.


def lamp(direction, distance, size):
    """Positions, normals and triangles of a square over the disc that faces its middle."""
    length = math.sqrt(sum(x * x for x in direction))
    d = [x / length for x in direction]
    level = math.hypot(d[0], d[2])
    u = [size * d[2] / level, 0.0, -size * d[0] / level]
    v = [d[2] * u[1] - d[1] * u[2], d[0] * u[2] - d[2] * u[0], d[1] * u[0] - d[0] * u[1]]
    corner = [distance * x - (a + b) / 2 for x, a, b in zip(d, u, v)]
    # v x u is towards the middle.
    return quad(corner, v, u)[:3]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n")[2])
    scene = Scene("examples/brushed/scene.py", ("steel", "knob", "lamp"))
    edge = arc((0.98, 0.06), 0.02, 0, 90, 6)
    disc = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), *edge, edge[-1], (0.0, 0.08)]
    knob = [(0.07, 0.08), *arc((0.1, 0.17), 0.04, -60, 90, 12), (0.0, 0.21)]
    for name, material, shape in (
        ("disc", 0, revolve(disc, 192)),
        ("knob", 1, revolve(knob, 64)),
        ("lamp", 2, lamp((-0.75, 1.0, -0.7), 5.0, 1.1)),
        ("other_lamp", 2, lamp((0.95, 1.0, -0.1), 5.0, 0.8)),
    ):
        scene.node(name=name, mesh=scene.mesh(*shape, material))
    scene.look_at([0.0, 2.6, 2.7], [0.0, 0.02, 0.03], yfov=0.64)
    scene.write(sys.argv[1])


if __name__ == "__main__":
    main()
