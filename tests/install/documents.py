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
