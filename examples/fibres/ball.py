#!/usr/bin/env python3
"""Writes a ball of hair as a HAIR file (Yuksel, http://www.cemyuksel.com/research/hairmodels).

usage: ball.py FILE [--strands N]

Strands grow out of a sphere of radius 0.55, bend under their weight and curl in clumps; numpy alone
decides how, with a fixed seed, so that the file is always the same.
"""

import argparse
import struct

import numpy as np

PIECES = 24


def strands(count: int) -> np.ndarray:
    """Points, count by PIECES + 1 by 3."""
    random = np.random.default_rng(7)
    # Roots on a spiral: evenly over the sphere.
    k = np.arange(count) + 0.5
    z = 1.0 - 2.0 * k / count
    azimuth = np.pi * (1.0 + np.sqrt(5.0)) * k
    ring = np.sqrt(1.0 - z * z)
    out = np.stack([ring * np.cos(azimuth), z, ring * np.sin(azimuth)], axis=1)
    clumps = random.normal(size=(160, 3))
    clumps /= np.linalg.norm(clumps, axis=1, keepdims=True)
    clump = np.argmax(out @ clumps.T, axis=1)
    curl = random.uniform(0.0, 2.0 * np.pi, len(clumps))[clump] + random.normal(0, 0.25, count)
    length = 0.42 * random.uniform(0.75, 1.1, count)
    points = np.empty((count, PIECES + 1, 3))
    points[:, 0] = 0.55 * out
    way = out.copy()
    across = np.cross(out, [0.31, 0.9, 0.29])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    other = np.cross(out, across)
    for i in range(PIECES):
        t = (i + 1) / PIECES
        towards = clumps[clump] - out
        turn = curl + 9.0 * t
        swirl = np.cos(turn)[:, None] * across + np.sin(turn)[:, None] * other
        way = way + 0.10 * towards + np.array([0.0, -0.075, 0.0]) + 0.22 * t * swirl
        way += random.normal(0.0, 0.02, way.shape)
        way /= np.linalg.norm(way, axis=1, keepdims=True)
        step = points[:, i] + (length / PIECES)[:, None] * way
        # Not through the ball.
        radius = np.linalg.norm(step, axis=1, keepdims=True)
        points[:, i + 1] = step * np.maximum(1.0, 0.56 / radius)
    return points + np.array([0.0, 1.0, 0.0])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file")
    parser.add_argument("--strands", type=int, default=30000)
    arguments = parser.parse_args()
    points = strands(arguments.strands)
    total = points.shape[0] * points.shape[1]
    # Finer towards the tips.
    thickness = np.tile(np.linspace(0.0042, 0.0012, PIECES + 1), arguments.strands)
    points_bit, thickness_bit = 2, 4
    header = struct.pack("<4s4I5f", b"HAIR", arguments.strands, total, points_bit | thickness_bit,
                         PIECES, 0.0, 0.0, 1.0, 1.0, 1.0)
    with open(arguments.file, "wb") as file:
        file.write(header.ljust(128, b"\0"))
        file.write(points.astype("<f4").tobytes())
        file.write(thickness.astype("<f4").tobytes())


if __name__ == "__main__":
    main()
