#!/usr/bin/env python3
"""Writes a drink as an OBJ file: a glass, what is in it, ice, a straw and a mat of cork.

usage: scene.py OUT.obj

Each is modelled by itself and runs into what it touches: the drink ends within the wall of the
glass, and the ice and the straw are where the drink is as well. Which of them is there says the
property dielectric_priority in drink.mtlx. A unit is ten centimetres.
"""

import math
import random
import sys

STEPS = 96  # Around an axis.


def arc(centre, radius, begin, end, count):
    """Points of a profile (distance from the axis, height), between two angles in degrees."""
    angles = [math.radians(begin + (end - begin) * i / (count - 1)) for i in range(count)]
    return [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in angles]


class Writer:
    def __init__(self, file):
        self.file = file
        self.count = 0

    def mesh(self, name, points, faces):
        print(f"o {name}\nusemtl {name}", file=self.file)
        for x, y, z in points:
            print(f"v {x:.6f} {y:.6f} {z:.6f}", file=self.file)
        for face in faces:
            print("f", *(self.count + 1 + i for i in face), file=self.file)
        self.count += len(points)

    def lathe(self, name, profile, steps=STEPS, place=lambda p: p):
        """A solid of revolution: the profile goes up along its outside, from axis to axis."""
        inner = profile[1:-1]
        turns = [2 * math.pi * k / steps for k in range(steps)]
        points = [(r * math.cos(t), y, -r * math.sin(t)) for r, y in inner for t in turns]
        points += [(0.0, profile[0][1], 0.0), (0.0, profile[-1][1], 0.0)]
        first, last = len(points) - 2, len(points) - 1
        faces = []
        for k in range(steps):
            n = (k + 1) % steps
            faces.append((first, n, k))
            for i in range(len(inner) - 1):
                a, b = i * steps, (i + 1) * steps
                faces.append((a + k, a + n, b + n, b + k))
            top = (len(inner) - 1) * steps
            faces.append((top + k, top + n, last))
        self.mesh(name, [place(p) for p in points], faces)

    def ice(self, places, half, steps=14):
        """Cubes with round edges: unit balls of the norm whose power is 5. Each is put down by a map."""
        grid = [2 * i / steps - 1 for i in range(steps + 1)]
        points, faces = [], []
        for place in places:
            index = {}

            def corner(c):
                key = tuple(round(x * steps) for x in c)
                if key not in index:
                    index[key] = len(points)
                    norm = sum(abs(x) ** 5 for x in c) ** 0.2
                    points.append(place([half * x / norm for x in c]))
                return index[key]

            for axis in range(3):
                for side in (-1.0, 1.0):
                    for a0, a1 in zip(grid, grid[1:]):
                        for b0, b1 in zip(grid, grid[1:]):
                            face = []
                            for a, b in ((a0, b0), (a1, b0), (a1, b1), (a0, b1)):
                                c = [side, a, b]
                                face.append(corner([c[(k - axis) % 3] for k in range(3)]))
                            faces.append(face if side > 0 else face[::-1])
        self.mesh("ice", points, faces)


def turned(angles, origin):
    """A map that turns about x, y and z, and moves to the origin."""

    def place(p):
        x, y, z = p
        for axis, degrees in enumerate(angles):
            c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
            if axis == 0:
                y, z = c * y - s * z, s * y + c * z
            elif axis == 1:
                x, z = c * x + s * z, -s * x + c * z
            else:
                x, y = c * x - s * y, s * x + c * y
        return (x + origin[0], y + origin[1], z + origin[2])

    return place


def tumbler():
    """Out along the foot, up the outside, over the rim and down the inside."""
    outside = [(0.0, 0.0), (0.15, 0.0)] + arc((0.30, 0.03), 0.03, -90, 0, 8)
    rim = arc((0.405, 1.0), 0.015, 0, 180, 13)
    inside = arc((0.255, 0.135), 0.045, 0, -90, 8) + [(0.12, 0.09), (0.0, 0.09)]
    straight = [(0.33 + 0.09 * i / 8, 0.03 + 0.97 * i / 8) for i in range(1, 8)]
    back = [(0.39 - 0.09 * i / 8, 1.0 - 0.865 * i / 8) for i in range(1, 8)]
    return outside + straight + rim + back + inside


def main():
    with open(sys.argv[1], "w", encoding="ascii") as file:
        out = Writer(file)
        out.lathe("glass", tumbler())
        # Half of the wall, and of the foot, is the drink's as well.
        wall = [(0.315 + 0.09 * (y - 0.135) / 0.865, y) for y in (0.1 + 0.62 * i / 8 for i in range(9))]
        out.lathe("drink", [(0.0, 0.05), (0.25, 0.05)] + arc((0.27, 0.09), 0.04, -90, 0, 5)
                  + wall + [(0.3735, 0.727), (0.36, 0.722), (0.34, 0.72), (0.17, 0.72), (0.0, 0.72)])
        out.ice([turned((12, 30, 8), (-0.13, 0.66, 0.06)), turned((-20, 65, 25), (0.15, 0.64, 0.12)),
                 turned((35, 10, -15), (0.04, 0.60, -0.17)), turned((50, 40, 30), (0.02, 0.40, 0.05))],
                0.12)
        straw = turned((-8, 0, -17), (-0.03, 0.68, -0.05))
        out.lathe("straw", [(0.0, -0.58), (0.029, -0.58)] + [(0.03, -0.579 + 0.13 * i) for i in range(10)]
                  + [(0.029, 0.592), (0.0, 0.592)], 32, straw)
        out.lathe("mat", [(0.0, -0.03), (0.2, -0.03)] + arc((0.45, -0.016), 0.014, -90, 90, 7)
                  + [(0.2, -0.002), (0.0, -0.002)])


if __name__ == "__main__":
    main()
