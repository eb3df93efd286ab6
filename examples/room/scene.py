#!/usr/bin/env python3
"""Writes a closed room as a glTF scene: a floor, walls, a window, a lamp and a vase.

usage: scene.py OUT.gltf

Names of materials: "cobbles", "plaster", "frame", "sky" of the pane, "lamp", "clay". The floor is one
quadrilateral that goes on below the walls; room.mtlx moves it up into cobbles. A unit is a metre.
"""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from gltf_scene import Scene, arc, quad, revolve  # noqa: E402: the folder above is found by then.

MATERIALS = ("cobbles", "plaster", "frame", "sky", "lamp", "clay")
WIDTH, HEIGHT, DEPTH = 3.6, 2.6, 4.6
SILL, LINTEL, NEAR, FAR = 0.95, 2.15, 0.2, -1.2  # Of the window, in the wall on the left.


def box(low, high):
    """Positions, normals, triangles and uv of a box."""
    positions, normals, triangles, uv = [], [], [], []
    for axis in range(3):
        u, v = ([0.0] * 3 for _ in range(2))
        for edge, along in ((u, (axis + 1) % 3), (v, (axis + 2) % 3)):
            edge[along] = high[along] - low[along]
        top = [high[k] if k == axis else low[k] for k in range(3)]
        for p, n, t, w in (quad(low, v, u), quad(top, u, v)):
            triangles += [[len(positions) + i for i in each] for each in t]
            positions, normals, uv = positions + p, normals + n, uv + w
    return positions, normals, triangles, uv


def vase():
    """Up along the outside, over the lip and down the inside."""
    foot = [(0.0, 0.0), (0.13, 0.0), (0.13, 0.0)]
    flare = [(0.13 + 0.11 * t * (2 - t), 0.22 * t) for t in (i / 12 for i in range(1, 13))]
    belly = arc((0.0, 0.22), 0.24, 0, 52, 14)[1:]
    # The neck goes on where the belly ends, in its direction.
    neck = arc((0.34 * math.cos(math.radians(52)), 0.22 + 0.34 * math.sin(math.radians(52))), 0.1, 232, 140, 14)[1:]
    r, y = neck[-1]
    lip = arc((r - 0.01, y), 0.01, 0, 180, 8)[1:]
    inside = [(r - 0.02, y) for r, y in reversed(neck[:-1])]
    return foot + flare + belly + neck + lip + inside + arc((0.0, 0.22), 0.22, 48, -60, 14) + [(0.0, 0.03)]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n")[2])
    scene = Scene("examples/room/scene.py", MATERIALS)

    def add(name, material, shape, **properties):
        positions, normals, triangles, *uv = shape
        mesh = scene.mesh(positions, normals, triangles, MATERIALS.index(material), *uv)
        scene.node(name=name, mesh=mesh, **properties)

    x, z, below = WIDTH / 2, DEPTH / 2, 0.2
    up = [0.0, HEIGHT + below, 0.0]
    add("floor", "cobbles", quad([-x - below, 0, z + below], [WIDTH + 2 * below, 0, 0], [0, 0, -DEPTH - 2 * below]))
    add("ceiling", "plaster", quad([-x, HEIGHT, -z], [WIDTH, 0, 0], [0, 0, DEPTH]))
    add("back", "plaster", quad([-x, -below, -z], [WIDTH, 0, 0], up))
    add("front", "plaster", quad([x, -below, z], [-WIDTH, 0, 0], up))
    add("right", "plaster", quad([x, -below, -z], [0, 0, DEPTH], up))
    # Around the window, and its reveal.
    wide = NEAR - FAR
    add("left_below", "plaster", quad([-x, -below, z], [0, 0, -DEPTH], [0, SILL + below, 0]))
    add("left_above", "plaster", quad([-x, LINTEL, z], [0, 0, -DEPTH], [0, HEIGHT - LINTEL, 0]))
    add("left_near", "plaster", quad([-x, SILL, z], [0, 0, NEAR - z], [0, LINTEL - SILL, 0]))
    add("left_far", "plaster", quad([-x, SILL, FAR], [0, 0, -z - FAR], [0, LINTEL - SILL, 0]))
    deep = 0.18
    add("sill", "plaster", quad([-x - deep, SILL, NEAR], [deep, 0, 0], [0, 0, -wide]))
    add("lintel", "plaster", quad([-x - deep, LINTEL, FAR], [deep, 0, 0], [0, 0, wide]))
    add("reveal_near", "plaster", quad([-x, SILL, NEAR], [-deep, 0, 0], [0, LINTEL - SILL, 0]))
    add("reveal_far", "plaster", quad([-x - deep, SILL, FAR], [deep, 0, 0], [0, LINTEL - SILL, 0]))
    add("pane", "sky", quad([-x - deep, SILL, NEAR], [0, 0, -wide], [0, LINTEL - SILL, 0]))
    middle, bar = (NEAR + FAR) / 2, 0.02
    add("mullion", "frame", box([-x - 0.16, SILL, middle - bar], [-x - 0.12, LINTEL, middle + bar]))
    add("transom", "frame", box([-x - 0.16, 1.6, FAR], [-x - 0.12, 1.6 + 2 * bar, NEAR]))

    # The lamp shines down along the wall at the back.
    add("lamp", "lamp", quad([0.65, 2.1, -z + 0.32], [0.06, 0, 0], [0, 0, 0.06]))
    add("shade", "frame", box([0.64, 2.11, -z + 0.31], [0.72, 2.22, -z + 0.39]))
    add("arm", "frame", box([0.67, 2.16, -z], [0.69, 2.18, -z + 0.31]))

    add("vase", "clay", revolve(vase(), 96), translation=[0.15, 0.055, -0.9], scale=[1.35, 1.35, 1.35])
    scene.look_at([1.25, 1.35, 2.0], [-0.25, 0.98, -1.0], yfov=1.0)
    scene.write(sys.argv[1])


if __name__ == "__main__":
    main()
