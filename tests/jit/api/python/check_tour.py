#!/usr/bin/env python3
"""usage: check_tour.py FOLDER

The pictures of examples/python/tour.py show something: each is there, and neither of one colour
nor black at its middle, where the sphere is.
"""

import pathlib
import sys

import matplotlib.image
import numpy

folder = pathlib.Path(sys.argv[1])
for name in "marble", "lobe", "sphere":
    pixels = matplotlib.image.imread(folder / f"{name}.png")[..., :3]
    assert pixels.std() > 0.02, f"{name}.png is of one colour"
    assert numpy.isfinite(pixels).all(), name
sphere = matplotlib.image.imread(folder / "sphere.png")[..., :3]
height, width = sphere.shape[:2]
middle = sphere[height // 2 - 2 : height // 2 + 2, width // 2 - 2 : width // 2 + 2]
assert middle.mean() > 0.05, "the sphere is black"
