#!/usr/bin/env python3
"""Renders the rods of examples/films beside what Airy's formula says pixel by pixel, wavelength by
wavelength, with their difference.

    bench/films_rendered.py --nacre build/bin/nacre --out bench/results
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

import numpy

from airy import airy, colours, displayed, gaussians, observer

EXAMPLE = pathlib.Path(__file__).resolve().parents[1] / "examples/films"
sys.path.insert(0, str(EXAMPLE))

from scene import DISTANCE, HALF, HALF_WIDTH, RADIUS, ROWS  # noqa: E402: examples/films is found by then.

WIDTH = HEIGHT = 288  # Pixels.
THICKEST, FILM_INDEX = 1200.0, 2.2  # As films.mtlx has them.
SUBSTRATES = (2.9 + 3.1j, 1.5)
BARE_BELOW = 30.0  # In nm: thinner films fade into the bare interface (pbs/thin_film.h).
GRAZING = 0.15  # Cosine: closer to the rim reflectance goes to 1 within a pixel.
THICKNESSES = numpy.linspace(0.0, THICKEST, 1201)
COSINES = numpy.linspace(0.0, 1.0, 257)
SUBPIXELS = 4
SHOWN_TIMES = 8  # The difference is.


def rendered(nacre: str, accuracy: str) -> numpy.ndarray:
    import matplotlib.image

    with tempfile.TemporaryDirectory() as folder:
        scene, picture = f"{folder}/films.gltf", f"{folder}/films.png"
        subprocess.run([sys.executable, EXAMPLE / "scene.py", scene], check=True)
        subprocess.run([nacre, "render", EXAMPLE / "films.mtlx", "--scene", scene, "--out", picture,
                        "--accuracy", accuracy, "--environment-scale", "0", "--white", "0",
                        "--size", str(WIDTH), "--spp", "64"], check=True)
        return matplotlib.image.imread(picture)[..., :3].astype("float64")


def seen() -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
    """Of the middles of subpixels: the rod (-1: none), position along it, cosine to the viewer."""
    rows, columns = HEIGHT * SUBPIXELS, WIDTH * SUBPIXELS
    y, x = numpy.meshgrid((numpy.arange(rows) + 0.5) / rows, (numpy.arange(columns) + 0.5) / columns,
                          indexing="ij")
    slope_x = (2.0 * x - 1.0) * HALF_WIDTH / DISTANCE
    slope_y = (1.0 - 2.0 * y) * HALF_WIDTH / DISTANCE
    rod = numpy.full(x.shape, -1)
    along, cosine = numpy.zeros(x.shape), numpy.zeros(x.shape)
    for number, height in enumerate(ROWS):
        # (0, 0, DISTANCE) + t (slope_x, slope_y, -1) meets y' = height + RADIUS sin, z = RADIUS cos.
        a = slope_y ** 2 + 1.0
        b = -slope_y * height - DISTANCE
        c = height ** 2 + DISTANCE ** 2 - RADIUS ** 2
        root = b * b - a * c
        t = (-b - numpy.sqrt(numpy.maximum(root, 0.0))) / a
        place = slope_x * t
        meets = (root > 0.0) & (numpy.abs(place) < HALF)
        up, towards = (slope_y * t - height) / RADIUS, (DISTANCE - t) / RADIUS
        facing = (towards - slope_y * up) / numpy.sqrt(1.0 + slope_x ** 2 + slope_y ** 2)
        rod[meets], along[meets], cosine[meets] = number, place[meets], facing[meets]
    return rod, along, cosine


def spectral(sensitivity: numpy.ndarray) -> numpy.ndarray:
    """The picture in linear light."""
    rod, along, cosine = seen()
    picture = numpy.ones((*rod.shape, 3))
    for number, substrate in enumerate(SUBSTRATES):
        table = numpy.stack([colours(airy(each, THICKNESSES, FILM_INDEX, substrate), sensitivity)
                             for each in COSINES])
        here = rod == number
        i = (numpy.clip(cosine[here], 0.0, 1.0) * (len(COSINES) - 1))
        j = (along[here] / HALF + 1.0) / 2.0 * (len(THICKNESSES) - 1)
        low_i = numpy.minimum(i.astype(int), len(COSINES) - 2)
        low_j = numpy.minimum(j.astype(int), len(THICKNESSES) - 2)
        part_i, part_j = (i - low_i)[:, None], (j - low_j)[:, None]
        picture[here] = ((1 - part_i) * ((1 - part_j) * table[low_i, low_j] + part_j * table[low_i, low_j + 1])
                         + part_i * ((1 - part_j) * table[low_i + 1, low_j]
                                     + part_j * table[low_i + 1, low_j + 1]))
    return picture.reshape(HEIGHT, SUBPIXELS, WIDTH, SUBPIXELS, 3).mean(axis=(1, 3))


def compared() -> numpy.ndarray:
    """Pixels that lie in one rod, not in its rim and not where films fade."""
    rod, along, cosine = seen()
    nanometres = (along / HALF + 1.0) / 2.0 * THICKEST
    inside = (rod >= 0) & (cosine > GRAZING) & (nanometres > BARE_BELOW)
    return inside.reshape(HEIGHT, SUBPIXELS, WIDTH, SUBPIXELS).all(axis=(1, 3))


def draw(rows: list[tuple[str, numpy.ndarray]], file: pathlib.Path) -> None:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, plots = pyplot.subplots(2, 2, figsize=(7, 7.2), dpi=100)
    for axes, (title, picture) in zip(plots.flat, rows, strict=True):
        axes.imshow(numpy.clip(picture, 0.0, 1.0), interpolation="nearest",
                    extent=(0.0, THICKEST, HEIGHT, 0))
        axes.set_aspect("auto")
        axes.set_yticks([])
        axes.tick_params(labelsize=6)
        axes.set_title(title, fontsize=8, pad=3)
    figure.supxlabel("thickness, nm; above a metal of 2.9 + 3.1i, below glass of 1.5; from the middle of a "
                     "rod to its rim the angle goes from 0° to 90°", fontsize=7)
    figure.tight_layout()
    figure.savefig(file)
    pyplot.close(figure)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--nacre", required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    by_observer, by_gaussians = spectral(observer()), spectral(gaussians())
    picture = {accuracy: rendered(arguments.nacre, accuracy) for accuracy in ("standard", "precise")}
    where = compared()
    for accuracy, each in picture.items():
        for name, reference in (("observer", by_observer), ("Gaussians", by_gaussians)):
            far = numpy.abs(each - displayed(reference))[where]
            print(f"{accuracy}, {name}: at most {far.max():.4f}, in the mean {far.mean():.5f} of the display's range")
    standard, reference = picture["standard"], displayed(by_observer)
    arguments.out.mkdir(parents=True, exist_ok=True)
    draw([("nacre render, standard", standard), ("nacre render, precise", picture["precise"]),
          ("Airy's formula, CIE 1931 observer", reference),
          (f"{SHOWN_TIMES} times what standard and Airy differ", SHOWN_TIMES * numpy.abs(standard - reference))],
         arguments.out / "films_rendered.png")


if __name__ == "__main__":
    main()
