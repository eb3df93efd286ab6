#!/usr/bin/env python3
"""Writes an urn with grooves and a rim, laid out in uv, on a plinth, as a glTF scene.

usage: urn.py OUT.gltf

Names of materials: "bronze", "stone". u of the urn runs around, v from its foot to the bottom of its inside.
"""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from gltf_scene import Scene, arc, revolve  # noqa: E402: the folder above is found by then.

STEPS = 128


def laid_out(profile):
    """Positions, normals, triangles and uv of a smooth solid of revolution, with a seam in its uv."""
    positions, normals, uv, triangles = [], [], [], []
    along = [0.0]
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        along.append(along[-1] + math.hypot(r1 - r0, y1 - y0))
    for i, (r, y) in enumerate(profile):
        (r0, y0), (r1, y1) = profile[max(i - 1, 0)], profile[min(i + 1, len(profile) - 1)]
        out, up = y1 - y0, r0 - r1
        size = math.hypot(out, up)
        for k in range(STEPS + 1):
            angle = 2 * math.pi * (k % STEPS) / STEPS
            c, s = math.cos(angle), -math.sin(angle)
            positions.append([r * c, y, r * s])
            normals.append([out / size * c, up / size, out / size * s])
            uv.append([k / STEPS, 1 - along[i] / along[-1]])  # glTF: v runs down.
    for i in range(len(profile) - 1):
        for k in range(STEPS):
            a, b = i * (STEPS + 1) + k, (i + 1) * (STEPS + 1) + k
            triangles += [[a, a + 1, b], [a + 1, b + 1, b]]
    return positions, normals, triangles, uv


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n")[2])
    scene = Scene("examples/worn/urn.py", ("bronze", "stone"))
    body = []
    for i in range(241):
        t = i / 240
        swell = 0.3 + 0.28 * math.sin(math.pi * (0.12 + 0.78 * t)) ** 2
        groove = 0.035 * max(0.0, math.sin(14 * math.pi * t)) ** 2 if 0.2 < t < 0.8 else 0.0
        body.append((swell - groove, 0.06 + 1.1 * t))
    r, y = body[-1]
    profile = [*arc((0.36, 0.03), 0.03, -90, 60, 10), *body, *arc((r - 0.01, y + 0.04), 0.045, -40, 180, 20)]
    inside = [(profile[-1][0] + 0.02 * math.sin(math.pi * t), y - 0.7 * t) for t in (j / 40 for j in range(41))]
    positions, normals, triangles, uv = laid_out(profile + inside)
    scene.node(name="urn", mesh=scene.mesh(positions, normals, triangles, 0, uv))
    plinth = [(0.0, -0.2), (0.7, -0.2), (0.7, -0.2), (0.7, 0.0), (0.7, 0.0), (0.0, 0.0)]
    scene.node(name="plinth", mesh=scene.mesh(*revolve(plinth, 128), 1))
    scene.look_at([1.2, 2.0, 2.8], [0.0, 0.5, 0.0], yfov=0.55)
    scene.write(sys.argv[1])


if __name__ == "__main__":
    main()
