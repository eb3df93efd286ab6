"""What the checks of this folder give to a host: a document with an image, a configuration."""

import pathlib
import struct

IMAGE_DOCUMENT = """<?xml version="1.0"?>
<materialx version="1.39">
  <nodegraph name="NG_image">
    <image name="image1" type="color3">
      <input name="file" type="filename" value="grey.tga" />
    </image>
    <output name="out" type="color3" nodename="image1" />
  </nodegraph>
</materialx>
"""

COLORS = """ocio_profile_version: 2
roles: {scene_linear: linear, default: linear, aces_interchange: linear}
file_rules: [!<Rule> {name: Default, colorspace: default}]
displays: {sRGB: [!<View> {name: Raw, colorspace: linear}]}
colorspaces:
  - !<ColorSpace> {name: linear}
"""


def write(folder: pathlib.Path) -> tuple[pathlib.Path, pathlib.Path]:
    """The document, whose output is NG_image/out, and the configuration."""
    document, config = folder / "image.mtlx", folder / "config.ocio"
    document.write_text(IMAGE_DOCUMENT, encoding="utf-8")
    config.write_text(COLORS, encoding="utf-8")
    # Two by two pixels of 8 bits, black.
    header = struct.pack("<3B5B4H2B", 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 2, 2, 8, 0)
    (folder / "grey.tga").write_bytes(header + bytes(4))
    return document, config


def write_jpeg(file: pathlib.Path) -> None:
    """Eight by eight pixels of grey: one block, whose only code is the empty one (ITU-T T.81)."""
    def segment(marker: int, data: bytes) -> bytes:
        return struct.pack(">2BH", 0xff, marker, len(data) + 2) + data

    one_code = bytes([1] + 15 * [0] + [0])  # One code of one bit, 0, that means 0.
    file.write_bytes(b"\xff\xd8" + segment(0xdb, bytes([0] + 64 * [1]))
                     + segment(0xc0, struct.pack(">BHHB3B", 8, 8, 8, 1, 1, 0x11, 0))
                     + segment(0xc4, b"\x00" + one_code) + segment(0xc4, b"\x10" + one_code)
                     + segment(0xda, bytes([1, 1, 0, 0, 63, 0])) + b"\x3f\xff\xd9")
