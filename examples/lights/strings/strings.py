#!/usr/bin/env python3
"""usage: strings.py OUT.obj [BULBS]

Writes a yard at night: a floor, a wall, and some balls under strings of small bulbs (default: 360)
that hang between posts. Each bulb is an octahedron that shines; strings.mtlx has their colours.
"""

import math
import sys

COLOURS = ("amber", "white", "red", "green", "blue")
STRINGS = 9
SAG = 0.7
BULB = 0.035


class Obj:
    """Text of an OBJ file, object by object; vertices count on."""

    def __init__(self):
        self.lines = []
        self.vertices = 0

    def add(self, name, vertices, faces):
        self.lines.append(f"o {name}")
        self.lines += [f"v {x:.5g} {y:.5g} {z:.5g}" for x, y, z in vertices]
        self.lines += ["f " + " ".join(str(self.vertices + i + 1) for i in face) for face in faces]
        self.vertices += len(vertices)


def octahedrons(centres, radius):
    vertices, faces = [], []
    for x, y, z in centres:
        first = len(vertices)
        for axis in range(3):
            for sign in (1, -1):
                at = [x, y, z]
                at[axis] += sign * radius
                vertices.append(tuple(at))
        for a in (0, 1):
            for b in (2, 3):
                for c in (4, 5):
                    corner = (a, b, c) if (a + b + c) % 2 == 0 else (a, c, b)
                    faces.append(tuple(first + i for i in corner))
    return vertices, faces


def ball(centre, radius, steps=32):
    vertices, faces = [], []
    for i in range(steps // 2 + 1):
        for k in range(steps):
            down, around = 2 * math.pi * i / steps, 2 * math.pi * k / steps
            unit = (math.sin(down) * math.sin(around), math.cos(down),
                    math.sin(down) * math.cos(around))
            vertices.append(tuple(c + radius * u for c, u in zip(centre, unit)))
    for i in range(steps // 2):
        for k in range(steps):
            a, b = i * steps + k, i * steps + (k + 1) % steps
            if i > 0:  # At the poles one of two has no area.
                faces.append((a, b + steps, b))
            if i < steps // 2 - 1:
                faces.append((a, a + steps, b + steps))
    return vertices, faces


def bulbs_of(string, count):
    """Along a sagging string over the yard; the posts stand in a zigzag."""
    left = (-4.5, 3.2 + 0.3 * (string % 2), 3.5 - 8 * string / STRINGS)
    right = (4.5, 3.4 - 0.3 * (string % 2), 3.1 - 8 * (string + 0.7) / STRINGS)
    for i in range(count):
        t = (i + 0.5) / count
        x, y, z = (a + t * (b - a) for a, b in zip(left, right))
        yield x, y - 4 * SAG * t * (1 - t), z


def main() -> int:
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    count = int(sys.argv[2]) if len(sys.argv) == 3 else 360
    obj = Obj()
    obj.add("floor", [(-6, 0, 5), (6, 0, 5), (6, 0, -6), (-6, 0, -6)], [(0, 1, 2, 3)])
    obj.add("wall", [(-6, 0, -6), (6, 0, -6), (6, 4.5, -6), (-6, 4.5, -6)], [(0, 1, 2, 3)])
    for number, (x, radius, z) in enumerate([(-2.6, 0.9, -2.5), (0.4, 0.6, 0.2), (2.7, 1.1, -2.2)]):
        obj.add(f"ball{number}", *ball((x, radius, z), radius))
    places = [place for s in range(STRINGS)
              for place in bulbs_of(s, count * (s + 1) // STRINGS - count * s // STRINGS)]
    for number, colour in enumerate(COLOURS):
        obj.add(colour, *octahedrons(places[number::len(COLOURS)], BULB))
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write("\n".join(obj.lines) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
