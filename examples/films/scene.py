#!/usr/bin/env python3
"""Writes two rods side by side in a white surround, as a glTF scene.

usage: scene.py OUT.gltf

Names of materials: "metal", "glass", "surround". Along each rod, y of its own space goes from -1.5 to
1.5; across it, it is seen from straight ahead to grazing. The camera is far away: the angle hangs on
the place across a rod, and hardly on that along it.
"""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from gltf_scene import Scene, ball, quaternion, revolve  # noqa: E402: the folder above is found by then.

RADIUS, HALF = 0.7, 1.5  # Of a rod; half of its length.
ROWS = (0.76, -0.76)  # Heights of the axes.
DISTANCE, HALF_WIDTH = 60.0, 1.5  # Of the camera from the axes; what a square picture shows there.


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n")[2])
    scene = Scene("examples/films/scene.py", ("metal", "glass", "surround"))
    profile = [(RADIUS, HALF * (2 * i / 8 - 1)) for i in range(9)]
    shape = revolve(profile, 1024)
    for material, (name, height) in enumerate(zip(("metal", "glass"), ROWS)):
        rod = scene.mesh(*shape, material)
        scene.node(name=name, mesh=rod, translation=[0.0, height, 0.0],
                   rotation=quaternion([0.0, 0.0, 1.0], -math.pi / 2))
    positions, normals, triangles = ball(2 * DISTANCE, 8)
    scene.node(name="surround", mesh=scene.mesh(positions, normals, triangles, 2))
    scene.look_at([0.0, 0.0, DISTANCE], [0.0, 0.0, 0.0], yfov=2 * math.atan(HALF_WIDTH / DISTANCE))
    scene.write(sys.argv[1])


if __name__ == "__main__":
    main()
