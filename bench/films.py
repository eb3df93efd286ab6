#!/usr/bin/env python3
"""Draws the colours of thin films, thickness by thickness, beside what Airy's formula says wavelength
by wavelength, and tabulates how far apart they are.

    PYTHONPATH=build/python bench/films.py --out bench/results
"""

import argparse
import pathlib

import nacre
import numpy

import report
from airy import WAVELENGTHS, airy, colours, displayed, gaussians, observer

ACCURACIES = ("precise", "standard", "fast")
ANGLES = (0, 45, 80)  # Degrees between viewer and normal.
THICKNESSES = numpy.linspace(0.0, 1200.0, 601)  # In nm.
BARE_BELOW = 30.0  # In nm: thinner films fade into the bare interface (pbs/thin_film.h).
FILM_INDEX = 1.35

DOCUMENT = """<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">
  <texcoord name="place" type="vector2" />
  <extract name="along" type="float">
    <input name="in" type="vector2" nodename="place" />
    <input name="index" type="integer" value="0" />
  </extract>
  <{category} name="lobe" type="BSDF">
    {inputs}
    <input name="roughness" type="vector2" value="0, 0" />
    <input name="thinfilm_thickness" type="float" nodename="along" />
    <input name="thinfilm_ior" type="float" value="{film}" />
  </{category}>
  <surface name="S" type="surfaceshader">
    <input name="bsdf" type="BSDF" nodename="lobe" />
  </surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S" />
  </surfacematerial>
</materialx>
"""

# Name, node, inputs, index of the substrate. The metal has one index at all wavelengths, for Airy's
# formula takes it by wavelength and a lobe by channel.
SUBSTRATES = (
    ("glass, 1.5", "dielectric_bsdf",
     '<input name="ior" type="float" value="1.5" />', 1.5),
    ("metal, 2.9 + 3.1i", "conductor_bsdf",
     '<input name="ior" type="color3" value="2.9, 2.9, 2.9" />'
     '<input name="extinction" type="color3" value="3.1, 3.1, 3.1" />', 2.9 + 3.1j),
    ("metal, 0.2 + 3.4i", "conductor_bsdf",
     '<input name="ior" type="color3" value="0.2, 0.2, 0.2" />'
     '<input name="extinction" type="color3" value="3.4, 3.4, 3.4" />', 0.2 + 3.4j),
)


def of_kernel(system: nacre.System, category: str, inputs: str, angle: float,
              accuracy: str) -> numpy.ndarray:
    """Albedo of the smooth lobe: its reflectance."""
    text = DOCUMENT.format(category=category, inputs=inputs, film=FILM_INDEX)
    shader = system.compile_material(nacre.Document.parse(text), "M", no_footprints=True,
                                     entries=[nacre.Entry.BEGIN, nacre.Entry.ALBEDO],
                                     accuracy=accuracy)
    theta = numpy.radians(angle)
    count = len(THICKNESSES)
    wo = numpy.tile(numpy.float32([numpy.sin(theta), 0.0, numpy.cos(theta)]), (count, 1))
    uv = numpy.zeros((count, 2), "float32")
    uv[:, 0] = THICKNESSES
    points = nacre.surface_points((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), wo, T=(1.0, 0.0, 0.0), uv0=uv)
    found = shader.run(points, nacre.Entry.ALBEDO)
    return found["albedo"].astype("float64")


def draw(strips: list[tuple[str, list]], file: pathlib.Path) -> None:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, plots = pyplot.subplots(len(strips), 1, figsize=(9, 1.25 * len(strips)), dpi=110,
                                    sharex=True)
    for axes, (title, rows) in zip(plots, strips, strict=True):
        picture = numpy.stack([rgb for _, rgb in rows])
        axes.imshow(displayed(picture), aspect="auto", interpolation="nearest",
                    extent=(THICKNESSES[0], THICKNESSES[-1], len(rows), 0))
        axes.set_yticks([k + 0.5 for k in range(len(rows))], [name for name, _ in rows],
                        fontsize=6)
        axes.set_title(title, fontsize=7, pad=2)
    plots[-1].set_xlabel("thickness, nm")
    figure.tight_layout()
    figure.savefig(file)
    pyplot.close(figure)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    system = nacre.System()
    there = THICKNESSES >= BARE_BELOW
    rows, strips = [], []
    for name, category, inputs, substrate in SUBSTRATES:
        for angle in ANGLES:
            reflected = airy(numpy.cos(numpy.radians(angle)), THICKNESSES, FILM_INDEX, substrate)
            seen = colours(reflected, observer())
            own = colours(reflected, gaussians())
            strip = [("observer", seen)]
            cells = []
            for accuracy in ACCURACIES:
                rgb = of_kernel(system, category, inputs, angle, accuracy)
                strip.append((accuracy, rgb))
                for reference in (own, seen):
                    cells.append(f"{numpy.abs(rgb - reference)[there].max():.4f}")
            rows.append([name, f"{angle}°", *cells, f"{numpy.abs(own - seen)[there].max():.4f}"])
            strips.append((f"{name}, {angle}°", strip))
    arguments.out.mkdir(parents=True, exist_ok=True)
    draw(strips, arguments.out / "films.png")
    head = ["substrate", "angle"]
    for accuracy in ACCURACIES:
        head += [f"{accuracy}, Gaussians", f"{accuracy}, observer"]
    page = f"""# Thin films

The reflectance of a smooth surface under a film of index {FILM_INDEX} and {BARE_BELOW:g} to
{THICKNESSES[-1]:g} nm (nacre {nacre.__version__}) beside Airy's formula at {len(WAVELENGTHS)}
wavelengths: the largest difference of a channel, with the Gaussian sensitivities that the kernels
have too, and with the CIE 1931 observer; and how far these two are from each other. Channels are of
the CIE's primaries, with white 1, and cut to [0, 1]. By `bench/films.py`, which draws `films.png`.

{report.table(head + ["Gaussians, observer"], rows)}"""
    (arguments.out / "films.md").write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
