#!/usr/bin/env python3
"""Writes a small animated glTF scene: three balls over a floor with a ring of posts.

usage: scene.py OUT.gltf

Within a second "rolling" rolls three units to the right, "spinning" turns twice about its
own axis, and "standing" stands. The posts are one mesh with EXT_mesh_gpu_instancing. Names of
materials: "chequer", "post", "floor".
"""

import base64
import json
import math
import struct
import sys


class Scene:
    def __init__(self):
        self.data = b""
        self.gltf = {
            "asset": {"version": "2.0", "generator": "examples/motion/scene.py"},
            "extensionsUsed": ["EXT_mesh_gpu_instancing"],
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [],
            "meshes": [],
            "materials": [{"name": name} for name in ("chequer", "post", "floor")],
            "cameras": [{"type": "perspective", "perspective": {"yfov": 0.62, "znear": 0.1}}],
            "animations": [{"channels": [], "samplers": []}],
            "accessors": [],
            "bufferViews": [],
        }

    def accessor(self, rows, kind, component=5126):
        """The index of an accessor of these rows, of floats or (5125) 32-bit indices."""
        flat = [x for row in rows for x in row]
        data = struct.pack(f"<{len(flat)}{'f' if component == 5126 else 'I'}", *flat)
        self.gltf["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        entry = {"bufferView": len(self.gltf["bufferViews"]) - 1, "componentType": component}
        entry |= {"count": len(rows), "type": kind}
        if kind in ("SCALAR", "VEC3") and component == 5126:
            entry["min"] = [min(column) for column in zip(*rows)]
            entry["max"] = [max(column) for column in zip(*rows)]
        self.gltf["accessors"].append(entry)
        return len(self.gltf["accessors"]) - 1

    def mesh(self, positions, normals, triangles, material):
        attributes = {"POSITION": self.accessor(positions, "VEC3"), "NORMAL": self.accessor(normals, "VEC3")}
        corners = self.accessor([[i] for t in triangles for i in t], "SCALAR", 5125)
        primitive = {"attributes": attributes, "indices": corners, "material": material}
        self.gltf["meshes"].append({"primitives": [primitive]})
        return len(self.gltf["meshes"]) - 1

    def node(self, **properties):
        self.gltf["nodes"].append(properties)
        self.gltf["scenes"][0]["nodes"].append(len(self.gltf["nodes"]) - 1)
        return len(self.gltf["nodes"]) - 1

    def animate(self, node, path, times, values):
        animation = self.gltf["animations"][0]
        kind = "VEC4" if path == "rotation" else "VEC3"
        sampler = {"input": self.accessor([[t] for t in times], "SCALAR"), "output": self.accessor(values, kind)}
        animation["samplers"].append(sampler)
        target = {"node": node, "path": path}
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1, "target": target})

    def write(self, path):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        self.gltf["buffers"] = [{"byteLength": len(self.data), "uri": uri}]
        with open(path, "w", encoding="utf-8") as file:
            json.dump(self.gltf, file)


def ball(radius, steps):
    """Positions, normals and triangles of a sphere about the origin, poles on y."""
    normals, triangles = [], []
    for i in range(steps + 1):
        for j in range(2 * steps + 1):
            height, around = math.pi * i / steps, math.pi * j / steps
            ring = math.sin(height)
            normals.append([ring * math.cos(around), math.cos(height), ring * math.sin(around)])
    row = 2 * steps + 1
    for i in range(steps):
        for j in range(2 * steps):
            a, b = i * row + j, (i + 1) * row + j
            triangles += [[a, a + 1, b]] if i > 0 else []
            triangles += [[a + 1, b + 1, b]] if i + 1 < steps else []
    return [[radius * x for x in n] for n in normals], normals, triangles


def quaternion(axis, angle):
    return [math.sin(angle / 2) * x for x in axis] + [math.cos(angle / 2)]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n")[2])
    scene = Scene()
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
    scene.node(name="camera", camera=0, translation=[0.0, 3.2, 8.5], rotation=quaternion([1, 0, 0], -0.32))
    scene.write(sys.argv[1])


if __name__ == "__main__":
    main()
