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

WAVELENGTHS = numpy.arange(300.5, 900.0, 1.0)  # In nm.


def gaussians() -> numpy.ndarray:
    """Sensitivities x, y, z per nm: Belcour and Barla, "A Practical Extension to Microfacet Theory
    for the Modeling of Varying Iridescence", SIGGRAPH 2017: Gaussians in wave number, by the
    amplitude, mean and half variance of their transforms."""
    number = 1e9 / WAVELENGTHS

    def curve(amplitude: float, mean: float, half_variance: float) -> numpy.ndarray:
        return amplitude * numpy.exp(-(number - mean) ** 2 / (4.0 * half_variance))

    return numpy.stack([
        curve(5.4856e-13, 1.6810e6, 4.3278e9) + curve(9.7470e-14, 2.2399e6, 4.5282e9),
        curve(4.4201e-13, 1.7953e6, 9.3046e9),
        curve(5.2481e-13, 2.2084e6, 6.6121e9)]) * number / WAVELENGTHS


def observer() -> numpy.ndarray:
    """The CIE 1931 observer as fitted by Wyman, Sloan and Shirley, "Simple Analytic Approximations
    to the CIE XYZ Color Matching Functions", JCGT 2(2), 2013."""
    def lobe(mean: float, below: float, above: float) -> numpy.ndarray:
        offset = WAVELENGTHS - mean
        return numpy.exp(-0.5 * (offset * numpy.where(offset < 0.0, below, above)) ** 2)

    return numpy.stack([
        0.362 * lobe(442.0, 0.0624, 0.0374) + 1.056 * lobe(599.8, 0.0264, 0.0323)
        - 0.065 * lobe(501.1, 0.0490, 0.0382),
        0.821 * lobe(568.8, 0.0213, 0.0247) + 0.286 * lobe(530.9, 0.0613, 0.0322),
        1.217 * lobe(437.0, 0.0845, 0.0278) + 0.681 * lobe(459.0, 0.0385, 0.0725)])


# CIE 1931 primaries, equal-energy white: what thin_film.h works in.
RGB_OF_XYZ = numpy.array([[2.3706743, -0.9000405, -0.4706338],
                          [-0.5138850, 1.4253036, 0.0885814],
                          [0.0052982, -0.0146949, 1.0093968]])


def airy(angle: float, substrate: complex) -> numpy.ndarray:
    """Unpolarised reflectance by thickness and wavelength: Born and Wolf, "Principles of Optics"
    (7th ed.), 1.6.4."""
    cosine = numpy.cos(numpy.radians(angle))
    sine2 = 1.0 - cosine * cosine
    in_film = numpy.sqrt(1.0 - sine2 / FILM_INDEX ** 2)
    behind = numpy.sqrt(1.0 - sine2 / complex(substrate) ** 2)
    phase = 4.0 * numpy.pi * FILM_INDEX * in_film * THICKNESSES[:, None] / WAVELENGTHS
    turn = numpy.exp(1j * phase)

    def s(n1, c1, n2, c2):
        return (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2)

    def p(n1, c1, n2, c2):
        return (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2)

    total = 0.0
    for amplitude in (s, p):
        front = amplitude(1.0, cosine, FILM_INDEX, in_film)
        back = amplitude(FILM_INDEX, in_film, substrate, behind)
        total = total + 0.5 * numpy.abs((front + back * turn) / (1.0 + front * back * turn)) ** 2
    return total


def colours(reflected: numpy.ndarray, sensitivity: numpy.ndarray) -> numpy.ndarray:
    xyz = reflected @ sensitivity.T / sensitivity.sum(axis=1)
    return numpy.clip(xyz @ RGB_OF_XYZ.T, 0.0, 1.0)


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
        seen = numpy.where(picture <= 0.0031308, 12.92 * picture,
                           1.055 * numpy.maximum(picture, 1e-9) ** (1 / 2.4) - 0.055)
        axes.imshow(seen, aspect="auto", interpolation="nearest",
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
            reflected = airy(angle, substrate)
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
