"""Small image files, written by hand so that they can also be written wrongly."""

import struct
import zlib


def exr(width, height, claimed=None, shown=None):
    """Uncompressed float R, G, B scanlines; `claimed`: the size the header gives instead;
    `shown`: the size of the picture that they are the corner of."""
    claims = claimed or (width, height)
    shows = shown or claims

    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(data)) + data

    window = struct.pack("<iiii", 0, 0, claims[0] - 1, claims[1] - 1)
    channels = b"".join(c + b"\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1) for c in (b"B", b"G", b"R"))
    head = struct.pack("<ii", 20000630, 2)
    head += attribute(b"channels", b"chlist", channels + b"\0")
    head += attribute(b"compression", b"compression", b"\0")
    head += attribute(b"dataWindow", b"box2i", window)
    head += attribute(b"displayWindow", b"box2i", struct.pack("<iiii", 0, 0, shows[0] - 1, shows[1] - 1))
    head += attribute(b"lineOrder", b"lineOrder", b"\0")
    head += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
    head += attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0))
    head += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0"
    line = struct.pack("<f", 0.5) * (3 * width)
    first = len(head) + 8 * height
    offsets = b"".join(struct.pack("<q", first + y * (8 + len(line))) for y in range(height))
    return head + offsets + b"".join(struct.pack("<ii", y, len(line)) + line for y in range(height))


def bmp(width, height, claimed=None, bits=24, packing=0):
    """Plain rows; `claimed`: the size the header gives instead."""
    claims = claimed or (width, height)
    head = struct.pack("<IiiHHIIiiII", 40, *claims, 1, bits, packing, 0, 0, 0, 0, 0)
    palette = bytes(range(256)) * 4 if bits <= 8 else b""
    at = 14 + len(head) + len(palette)
    row = (width * bits + 31) // 32 * 4
    return b"BM" + struct.pack("<IHHI", 0, 0, 0, at) + head + palette + b"\x80" * (row * height)


def gif(width, height, data=b"L\x01"):
    """One image of those codes, of black and white."""
    table = bytes(3) + b"\xff" * 3
    blocks = b"".join(bytes([len(data[at:at + 255])]) + data[at:at + 255] for at in range(0, len(data), 255))
    return (b"GIF89a" + struct.pack("<HHBBB", width, height, 0x80, 0, 0) + table +
            b"," + struct.pack("<HHHHB", 0, 0, width, height, 0) + b"\x02" + blocks + b"\0;")


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def packed_png(width, height):
    """Black, in as few bytes as can be."""
    pack = zlib.compressobj(9)
    row = b"\0" * (width + 1)
    data = b"".join(pack.compress(row) for _ in range(height)) + pack.flush()
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", data) + chunk(b"IEND", b""))


def png(width, height):
    # Not to be compressed much: the file should be long enough to be cut.
    noise = bytes((x * x * 7919 + x // 251) & 255 for x in range(3 * width))
    rows = b"".join(b"\0" + noise[y % width:] + noise[:y % width] for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows, 0)) + chunk(b"IEND", b""))


def hdr(width, height):
    head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + b"-Y %d +X %d\n" % (height, width)
    return head + b"\x80\x80\x80\x81" * (width * height)


def tiff(width, height, claimed=None):
    """One uncompressed strip of 8-bit R, G, B; `claimed`: the size the header gives instead."""
    claims = claimed or (width, height)
    pixels = b"\x80" * (3 * width * height)
    entries = [(256, 4, 1, claims[0]), (257, 4, 1, claims[1]), (258, 3, 3, 0), (259, 3, 1, 1), (262, 3, 1, 2),
               (273, 4, 1, 0), (277, 3, 1, 3), (278, 4, 1, height), (279, 4, 1, len(pixels)), (284, 3, 1, 1)]
    directory = 8
    bits = directory + 2 + 12 * len(entries) + 4
    entries[2] = (258, 3, 3, bits)
    entries[5] = (273, 4, 1, bits + 6)
    table = b"".join(struct.pack("<HHII", *entry) for entry in entries)
    return (b"II*\0" + struct.pack("<I", directory) + struct.pack("<H", len(entries)) + table +
            struct.pack("<I", 0) + struct.pack("<HHH", 8, 8, 8) + pixels)
