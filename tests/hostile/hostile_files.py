"""Images and scenes that crashed the program or took all memory, and variants of them."""

import base64
import json
import os
import struct

import images


def file(name, data):
    def build(folder):
        path = folder / name
        path.write_bytes(data() if callable(data) else data)
        return path
    return build


def pipe(name):
    """Nobody writes to it: who opens it waits."""
    def build(folder):
        os.mkfifo(folder / name)
        return folder / name
    return build


def dds(width, height, depth, caps2, data=1 << 18):
    head = struct.pack("<4s7I", b"DDS ", 124, 0x80100F, height, width, 4 * width, depth, 1) + bytes(44)
    head += struct.pack("<8I", 32, 0x41, 0, 32, 0xFF, 0xFF00, 0xFF0000, 0xFF000000)
    return head + struct.pack("<5I", 0x1008, caps2, 0, 0, 0) + bytes(range(256)) * (data // 256)


def psd(width, height, channels=3):
    return (b"8BPS" + struct.pack(">H6xHIIHH", 1, channels, height, width, 8, 3) + bytes(12) + b"\0\1" + bytes(64))


def big_png(side):
    import zlib

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = zlib.compressobj(9)
    data = b"".join(rows.compress(bytes(1 + 4 * side)) for _ in range(side)) + rows.flush()
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 6, 0, 0, 0)) +
            chunk(b"IDAT", data) + chunk(b"IEND", b""))


def big_tiff(width, height):
    """Claims that size, compressed strips of which there is nearly nothing."""
    small = bytearray(images.tiff(8, 4))
    struct.pack_into("<I", small, 8 + 2 + 8, width)
    struct.pack_into("<I", small, 8 + 2 + 12 + 8, height)
    struct.pack_into("<I", small, 8 + 2 + 12 * 7 + 8, height)
    return bytes(small)


def wide_exr(display):
    """Data of 8 by 4 in a display window of that size."""
    data = images.exr(8, 4)
    at = data.index(b"displayWindow\0box2i\0") + len(b"displayWindow\0box2i\0") + 4
    return data[:at] + struct.pack("<4i", 0, 0, display - 1, display - 1) + data[at + 16:]


IMAGES = [
    file("vol.dds", dds(64, 64, 256, 0x200000)),
    file("cube.dds", dds(64, 64, 1, 0xFE00)),
    file("vol2.dds", dds(4, 4, 65535, 0x200000, 1024)),
    file("large.dds", dds(65535, 65535, 1, 0)),
    file("zero.dds", dds(0, 0, 0, 0x200000)),
    file("gif.gif", images.gif(0xFFFF, 0xFFFF)),
    file("small.gif", images.gif(1, 1)),
    file("empty.gif", images.gif(0, 0)),
    file("cut.gif", images.gif(100, 100)[:20]),
    file("gif_as.png", images.gif(30000, 3)),
    file("screen.gif", images.gif(16384, 16384)),
    file("codes.gif", lambda: images.gif(12000, 12000, bytes(4 << 20))),
    file("blocks.gif", lambda: images.gif(1, 1)[:19] + b"\x21\xfe" + b"\x01\x01" * (30 << 20)),
    file("small.bmp", images.bmp(3, 3)),
    file("wide.bmp", images.bmp(3, 3, (2**31 - 1, 1))),
    file("high.bmp", images.bmp(3, 3, (1, -2**31))),
    file("square.bmp", images.bmp(3, 3, (16384, 16384), 32)),
    file("runs.bmp", lambda: images.bmp(1000, 1000, (16384, 16384), 8, 1)),
    file("cut.bmp", images.bmp(64, 64)[:-1]),
    file("tiny.psd", psd(1, 1)),
    file("wide.psd", psd(30000, 30000)),
    file("channels.psd", psd(16, 16, 56)),
    file("none.psd", psd(0, 0, 0)),
    file("cut.psd", psd(64, 64)[:30]),
    file("big.tif", lambda: big_tiff(60000, 60000)),
    file("wide.tif", lambda: big_tiff(2**31 - 1, 1)),
    file("high.tif", lambda: big_tiff(1, 2**31 - 1)),
    file("square.tif", lambda: big_tiff(16384, 16384)),
    file("cut.tif", lambda: images.tiff(64, 64)[:200]),
    file("full.exr", lambda: wide_exr(16384)),
    file("fuller.exr", lambda: wide_exr(2**31 - 1)),
    file("large.exr", lambda: images.exr(8, 8, (16384, 16384))),
    file("negative.exr", lambda: images.exr(8, 8, (-5, 8))),
    file("cut.exr", lambda: images.exr(64, 64)[:500]),
    file("bomb.png", lambda: big_png(12000)),
    file("bomb16k.png", lambda: big_png(16384)),
    file("cut.png", lambda: images.png(64, 64)[:100]),
    file("wide.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2147483647\n\x80\x80\x80\x81"),
    file("high.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n"),
    pipe("pipe.png"),
    pipe("pipe.exr"),
]


def scene(node=None, camera=None, names="n", count=1, mutate=None):
    floats = struct.pack("<12f", 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0)
    data = floats + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    gltf = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": names, **(node or {})}],
        "meshes": [{"name": names, "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}] * count}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64," +
                     base64.b64encode(data).decode()}]}
    if camera is not None:
        gltf["nodes"].append({"camera": 0, **camera})
        gltf["nodes"][0]["children"] = [1]
        gltf["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]
    if mutate:
        mutate(gltf)
    return lambda: json.dumps(gltf).encode()


def deep(levels):
    """A chain of nodes with long names: paths that grow quadratically."""
    def mutate(gltf):
        mesh = gltf["nodes"][0]
        gltf["nodes"] = [{"name": "n" * 4000, "children": [i + 1]} for i in range(levels)] + [mesh]
    return mutate


def fan(levels):
    """Each node has the next ten times."""
    def mutate(gltf):
        mesh = gltf["nodes"][0]
        gltf["nodes"] = [{"name": "n", "children": [i + 1] * 10} for i in range(levels)] + [mesh]
    return mutate


SCENES = [
    file("far.gltf", scene(camera={"translation": [1e38, 1e38, 1e38]})),
    file("farther.gltf", scene(camera={"translation": [3.4e38, -3.4e38, 3.4e38]})),
    file("scaled.gltf", scene(node={"scale": [1e38, 1e38, 1e38]}, camera={"scale": [0, 0, 0]})),
    file("turned.gltf", scene(camera={"rotation": [0, 0, 0, 0]})),
    file("away.gltf", scene(node={"translation": [1e30, 0, 0]})),
    file("matrix.gltf", scene(camera={"matrix": [1e300] * 16})),
    file("names.gltf", scene(names="n" * 500_000, count=6_000)),
    file("name.gltf", scene(names="n" * 5_000_000, count=200)),
    file("many.gltf", scene(count=20_000)),
    file("deep.gltf", scene(mutate=deep(250))),
    file("deeper.gltf", scene(mutate=deep(5000))),
    file("fan.gltf", scene(mutate=fan(12))),
    file("nothing.gltf", b"{}"),
    file("brackets.gltf", b"[" * 1_000_000),
    file("far.obj", b"v 1e38 0 0\nv 1e38 1e38 0\nv -1e38 0 3e38\nf 1 2 3\n"),
    file("inf.obj", b"v inf 0 0\nv 0 nan 0\nv 0 0 1\nf 1 2 3\n"),
    file("fan.obj", lambda: b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf" + b" 1 2 3" * 1_000_000 + b"\n"),
    file("names.obj", lambda: b"v 0 0 0\nv 1 0 0\nv 0 1 0\n" + b"".join(
        b"o " + b"n" * 2000 + b"%d\nf 1 2 3\n" % i for i in range(10_000))),
    pipe("pipe.gltf"),
    pipe("pipe.obj"),
]
