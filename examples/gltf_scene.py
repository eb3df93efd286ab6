"""What the scripts beside this folder's scenes write glTF 2.0 files with: one file, no others beside it."""

import base64
import json
import math
import struct


class Scene:
    """What goes into the file. Arrays of positions, normals and uv have a row for each vertex."""

    def __init__(self, generator, materials):
        self.data = b""
        self.gltf = {
            "asset": {"version": "2.0", "generator": generator},
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [],
            "meshes": [],
            "materials": [{"name": name} for name in materials],
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

    def mesh(self, positions, normals, triangles, material, uv=None):
        """The index of a mesh; `material`: index of its name."""
        attributes = {"POSITION": self.accessor(positions, "VEC3"), "NORMAL": self.accessor(normals, "VEC3")}
        if uv is not None:
            attributes["TEXCOORD_0"] = self.accessor(uv, "VEC2")
        corners = self.accessor([[i] for t in triangles for i in t], "SCALAR", 5125)
        primitive = {"attributes": attributes, "indices": corners, "material": material}
        self.gltf["meshes"].append({"primitives": [primitive]})
        return len(self.gltf["meshes"]) - 1

    def node(self, **properties):
        self.gltf["nodes"].append(properties)
        self.gltf["scenes"][0]["nodes"].append(len(self.gltf["nodes"]) - 1)
        return len(self.gltf["nodes"]) - 1

    def camera(self, position, rotation, yfov):
        """Looks along -z, +y up, before it is turned. Angles in radians."""
        self.gltf["cameras"] = [{"type": "perspective", "perspective": {"yfov": yfov, "znear": 0.1}}]
        self.node(name="camera", camera=0, translation=position, rotation=rotation)

    def look_at(self, position, target, yfov):
        """A camera that has the target in the middle and +y up."""
        way = [b - a for a, b in zip(position, target)]
        yaw = math.atan2(-way[0], -way[2]) / 2
        pitch = math.atan2(way[1], math.hypot(way[0], way[2])) / 2
        rotation = [math.cos(yaw) * math.sin(pitch), math.sin(yaw) * math.cos(pitch),
                    -math.sin(yaw) * math.sin(pitch), math.cos(yaw) * math.cos(pitch)]
        self.camera(position, rotation, yfov)

    def animate(self, node, path, times, values):
        animation = self.gltf.setdefault("animations", [{"channels": [], "samplers": []}])[0]
        kind = "VEC4" if path == "rotation" else "VEC3"
        sampler = {"input": self.accessor([[t] for t in times], "SCALAR"), "output": self.accessor(values, kind)}
        animation["samplers"].append(sampler)
        target = {"node": node, "path": path}
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1, "target": target})

    def write(self, path, extensions=()):
        if extensions:
            self.gltf["extensionsUsed"] = list(extensions)
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


def quad(corner, edge_u, edge_v):
    """Positions, normals, triangles and uv of a parallelogram that faces edge_u x edge_v."""
    (a, b, c), (d, e, f) = edge_u, edge_v
    normal = [b * f - c * e, c * d - a * f, a * e - b * d]
    size = math.sqrt(sum(x * x for x in normal))
    uv = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
    corners = [[x + u * y + v * z for x, y, z in zip(corner, edge_u, edge_v)] for u, v in uv]
    return corners, [[x / size for x in normal]] * 4, [[0, 1, 2], [0, 2, 3]], uv


def revolve(profile, steps):
    """Positions, normals and triangles of a solid of revolution about y. The profile, of (distance from
    the axis, height), goes up along its outside, from axis to axis; a point that is there twice is an
    edge, elsewhere the solid is smooth."""
    begins = [i for i in range(1, len(profile)) if profile[i] == profile[i - 1]]
    positions, normals, triangles = [], [], []
    for begin, end in zip([0, *begins], [*begins, len(profile)]):
        piece = profile[begin:end]
        first = len(positions)
        for i, (r, y) in enumerate(piece):
            (r0, y0), (r1, y1) = piece[max(i - 1, 0)], piece[min(i + 1, len(piece) - 1)]
            out, up = (y1 - y0, r0 - r1) if r > 0 else (0.0, 1.0 if r1 < r0 else -1.0)
            size = math.hypot(out, up)
            for k in range(steps):
                c, s = math.cos(2 * math.pi * k / steps), -math.sin(2 * math.pi * k / steps)
                positions.append([r * c, y, r * s])
                normals.append([out / size * c, up / size, out / size * s])
        for i in range(len(piece) - 1):
            for k in range(steps):
                n = (k + 1) % steps
                a, b = first + i * steps, first + (i + 1) * steps
                triangles += [[a + k, a + n, b + k]] if piece[i][0] > 0 else []
                triangles += [[a + n, b + n, b + k]] if piece[i + 1][0] > 0 else []
    return positions, normals, triangles


def arc(centre, radius, begin, end, count):
    """Points of a profile, between two angles in degrees."""
    angles = [math.radians(begin + (end - begin) * i / (count - 1)) for i in range(count)]
    return [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in angles]


def quaternion(axis, angle):
    return [math.sin(angle / 2) * x for x in axis] + [math.cos(angle / 2)]
