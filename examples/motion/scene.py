#!/usr/bin/env python3
"""Writes a small animated glTF scene: three balls over a floor with a ring of posts.

usage: scene.py OUT.gltf

Within a second "rolling" rolls three units to the right, "spinning" turns twice about its
own axis, and "standing" stands. The posts are one mesh with EXT_mesh_gpu_instancing. Names of
materials: "chequer", "post", "floor".
"""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from gltf_scene import Scene, ball, quaternion  # noqa: E402: the folder above is found by then.


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n")[2])
    scene = Scene("examples/motion/scene.py", ("chequer", "post", "floor"))
    sphere = scene.mesh(*ball(0.6, 48), material=0)
    rolling = scene.node(name="rolling", mesh=sphere, translation=[-1.5, 0.6, 0.9])
    spinning = scene.node(name="spinning", mesh=sphere, translation=[0.4, 0.6, -0.9])
    scene.node(name="standing", mesh=sphere, translation=[2.1, 0.6, -0.3])

    quarters = [k / 8 for k in range(9)]
    # A ball of radius 0.6 that goes three units turns by three over 0.6 radians.
    scene.animate(rolling, "translation", [0.0, 1.0], [[-1.5, 0.6, 0.9], [1.5, 0.6, 0.9]])
    scene.animate(rolling, "rotation", quarters, [quaternion([0, 0, 1], -3 / 0.6 * t) for t in quarters])
    axis = [0.0, math.cos(0.5), math.sin(0.5)]
    scene.animate(spinning, "rotation", quarters, [quaternion(axis, 4 * math.pi * t) for t in quarters])

    post = scene.mesh(*ball(1.0, 12), material=1)
    angles = [2 * math.pi * k / 24 for k in range(24)]
    attributes = {
        "TRANSLATION": scene.accessor([[3.0 * math.cos(a), 0.25, 2.2 * math.sin(a)] for a in angles], "VEC3"),
        "ROTATION": scene.accessor([quaternion([0, 1, 0], -a) for a in angles], "VEC4"),
        "SCALE": scene.accessor([[0.08, 0.25 + 0.1 * math.sin(3 * a), 0.16] for a in angles], "VEC3"),
    }
    scene.node(name="posts", mesh=post, extensions={"EXT_mesh_gpu_instancing": {"attributes": attributes}})

    corners = [[x, 0.0, z] for x, z in ((-9, 9), (9, 9), (9, -9), (-9, -9))]
    floor = scene.mesh(corners, [[0.0, 1.0, 0.0]] * 4, [[0, 1, 2], [0, 2, 3]], material=2)
    scene.node(name="floor", mesh=floor)
    scene.camera([0.0, 3.2, 8.5], quaternion([1, 0, 0], -0.32), yfov=0.62)
    scene.write(sys.argv[1], extensions=["EXT_mesh_gpu_instancing"])


if __name__ == "__main__":
    main()
