#!/usr/bin/env python3
"""Puts every closure that should keep all light, and every shading model, into a white world, and
tabulates what comes back: the mean weight of what `sample` draws, for one viewer after another.

    PYTHONPATH=build/python bench/furnace.py --out bench/results/furnace.md
"""

import argparse
import pathlib
import sys
from typing import NamedTuple

import nacre
import numpy

import furnace_films
import report

ACCURACIES = ("fast", "standard", "precise")
ALPHAS = ((0.05, 0.05), (0.2, 0.2), (0.5, 0.5), (1, 1), (0.5, 0.25), (1, 0.1), (0.05, 0.6))
OUTSIDE = (0, 30, 60, 75, 85, 88, 89, 89.9)  # Degrees between viewer and normal.
INSIDE = (180, 150, 130, 120, 110, 100, 95, 91)
AZIMUTHS = (0, 45, 90)  # To the tangent; where facets are anisotropic.
SAMPLES = 1 << 16
MORE_SAMPLES = 1 << 20  # Where few samples carry much: diffuse lobes at grazing, light that leaves.

DOCUMENT = """<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">
{nodes}
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S" />
  </surfacematerial>
</materialx>
"""
SURFACE = """
  <surface name="S" type="surfaceshader">
    <input name="bsdf" type="BSDF" nodename="lobe" />
  </surface>"""


def node(category: str, *inputs: str, name: str = "lobe", kind: str = "BSDF") -> str:
    """Inputs as "type name value"; a value "@NAME" is another node."""
    lines = [f'  <{category} name="{name}" type="{kind}">']
    for each in inputs:
        of_type, key, value = each.split(" ", 2)
        what = f'nodename="{value[1:]}"' if value.startswith("@") else f'value="{value}"'
        lines.append(f'    <input name="{key}" type="{of_type}" {what} />')
    return "\n".join([*lines, f"  </{category}>"])


ROUGH = "vector2 roughness {x}, {y}"


def dielectric(index: float, mode: str, *more: str, name: str = "lobe") -> str:
    return node("dielectric_bsdf", f"float ior {index}", f"string scatter_mode {mode}", ROUGH,
                *more, name=name)


def over_white(top: str) -> str:
    """What lies over white paper, which has no gloss."""
    paper = node("oren_nayar_diffuse_bsdf", "color3 color 1, 1, 1", name="paper")
    return "\n".join([top, paper, node("layer", "BSDF top @top", "BSDF base @paper")])


class Case(NamedTuple):
    name: str
    nodes: str  # {x} and {y} stand for the roughness along the tangent and across, if it has one.
    has_inside: bool = False
    samples: int = SAMPLES


WHITE_METAL = ("color3 ior 0, 0, 0", "color3 extinction 1, 1, 1")
SCHLICK = ("color3 color0 0.04, 0.04, 0.04", "color3 color90 1, 1, 1", "string scatter_mode RT")
FILM = ("float thinfilm_thickness 450", "float thinfilm_ior 1.35")

PRESERVING = [
    Case("oren_nayar_diffuse_bsdf, roughness 1, compensated",
         node("oren_nayar_diffuse_bsdf", "color3 color 1, 1, 1", "float roughness 1",
              "boolean energy_compensation true"), samples=MORE_SAMPLES),
    Case("translucent_bsdf", node("translucent_bsdf", "color3 color 1, 1, 1")),
    Case("subsurface_bsdf", node("subsurface_bsdf", "color3 color 1, 1, 1")),
    Case("conductor_bsdf, white", node("conductor_bsdf", *WHITE_METAL, ROUGH)),
    Case("conductorbrdf, white, Beckmann",
         node("conductorbrdf", "color3 reflectivity 1, 1, 1", "string distribution beckmann",
              ROUGH)),
    *(Case(f"dielectric_bsdf RT, ior {index}", dielectric(index, "RT"), True)
      for index in (1.1, 1.5, 2.5)),
    Case("dielectric_bsdf RT, ior 1.5, film", dielectric(1.5, "RT", *FILM), True),
    *(Case(f"dielectric_bsdf T, ior {index}", dielectric(index, "T"), True, MORE_SAMPLES)
      for index in (1.1, 1.5, 2.5)),
    *(Case(f"dielectric_bsdf R over T, ior {index}",
           "\n".join([dielectric(index, "R", name="top"), dielectric(index, "T", name="below"),
                      node("layer", "BSDF top @top", "BSDF base @below")]), True, MORE_SAMPLES)
      for index in (1.1, 1.5, 2.5)),
    Case("generalized_schlick_bsdf RT", node("generalized_schlick_bsdf", *SCHLICK, ROUGH), True),
    Case("dielectric_bsdf R over white", over_white(dielectric(1.5, "R", name="top"))),
    Case("dielectric_bsdf R with a film over white",
         over_white(dielectric(1.5, "R", *FILM, name="top"))),
    *(Case(f"sheen_bsdf over white, {mode}, roughness {roughness}",
           over_white(node("sheen_bsdf", "color3 color 1, 1, 1", f"float roughness {roughness}",
                           f"string mode {mode}", name="top")))
      for mode in ("conty_kulla", "zeltner") for roughness in (0.3, 1)),
    Case("chiang_hair_bsdf, nothing absorbed",
         node("chiang_hair_bsdf", "vector3 absorption_coefficient 0, 0, 0")),
]

# Name, nodes, the one that has the film, the viewer's side.
UNDER_FILMS = [
    ("dielectric_bsdf R over white", over_white(dielectric(1.5, "R", *FILM, name="top")), "top", 1),
    ("dielectric_bsdf RT, from outside", dielectric(1.5, "RT", *FILM), "lobe", 1),
    ("dielectric_bsdf RT, from inside", dielectric(1.5, "RT", *FILM), "lobe", -1),
]

WHITE = "color3 base_color 1, 1, 1"
MODELS = [
    Case("burley_diffuse_bsdf, roughness 1",
         node("burley_diffuse_bsdf", "color3 color 1, 1, 1", "float roughness 1") + SURFACE,
         samples=MORE_SAMPLES),
    Case("oren_nayar_diffuse_bsdf, roughness 1",
         node("oren_nayar_diffuse_bsdf", "color3 color 1, 1, 1", "float roughness 1") + SURFACE,
         samples=MORE_SAMPLES),
    *(Case(f"{category}{', ' if inputs else ''}{', '.join(i.split(' ', 1)[1] for i in inputs)}",
           node(category, white, *inputs, name="S", kind="surfaceshader"),
           samples=MORE_SAMPLES if category == "disney_principled" else SAMPLES)
      for category, white, *inputs in (
          ("standard_surface", WHITE, "float base 1"),
          ("standard_surface", WHITE, "float base 1", "float specular_roughness 1"),
          ("standard_surface", WHITE, "float base 1", "float metalness 1"),
          ("standard_surface", WHITE, "float base 1", "float coat 1"),
          ("standard_surface", WHITE, "float base 1", "float sheen 1"),
          ("standard_surface", WHITE, "float transmission 1"),
          ("open_pbr_surface", WHITE),
          ("open_pbr_surface", WHITE, "float base_metalness 1"),
          ("open_pbr_surface", WHITE, "float coat_weight 1"),
          ("open_pbr_surface", WHITE, "float fuzz_weight 1"),
          ("open_pbr_surface", WHITE, "float transmission_weight 1"),
          ("gltf_pbr", WHITE),
          ("gltf_pbr", WHITE, "float metallic 0", "float clearcoat 1"),
          ("gltf_pbr", WHITE, "float metallic 0", "color3 sheen_color 1, 1, 1",
           "float sheen_roughness 0.3"),
          ("UsdPreviewSurface", "color3 diffuseColor 1, 1, 1"),
          ("UsdPreviewSurface", "color3 diffuseColor 1, 1, 1", "float clearcoat 1"),
          ("disney_principled", "color3 baseColor 1, 1, 1", "float roughness 1"),
          ("disney_principled", "color3 baseColor 1, 1, 1", "float sheen 1"),
      )),
]


def view(angle: float, azimuth: float) -> dict:
    """A point at the origin, its normal along z, and a viewer."""
    theta, phi = numpy.radians(angle), numpy.radians(azimuth)
    wo = (numpy.sin(theta) * numpy.cos(phi), numpy.sin(theta) * numpy.sin(phi), numpy.cos(theta))
    return nacre.surface_points((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), tuple(map(float, wo)),
                                T=(1.0, 0.0, 0.0))


def roberts(count: int) -> numpy.ndarray:
    """Roberts' sequence in three dimensions: powers of the root of x^4 = x + 1."""
    steps = numpy.array([0.8191725133961645, 0.6710436067037893, 0.5497004779019703])
    return numpy.float32((0.5 + numpy.arange(count)[:, None] * steps) % 1.0)


class Furnace:
    """A material in a white world."""

    def __init__(self, system: nacre.System, nodes: str, samples: int, **options):
        text = DOCUMENT.format(nodes=nodes)
        self.shader = system.compile_material(
            nacre.Document.parse(text), "M", no_footprints=True,
            entries=[nacre.Entry.BEGIN, nacre.Entry.SAMPLE], **options)
        self.u = roberts(samples)

    def light(self, angle: float, azimuth: float) -> float:
        """What comes back of the brightest channel."""
        drawn = self.shader.run(view(angle, azimuth) | {"u": self.u}, nacre.Entry.SAMPLE)
        return float(drawn["weight"].astype("float64").mean(axis=0).max())

    def range(self, angles: tuple, azimuths: tuple) -> tuple[float, float]:
        lights = [self.light(angle, azimuth) for angle in angles for azimuth in azimuths]
        return min(lights), max(lights)


def share(light: float) -> str:
    return f"{light:.3f}".lstrip("0") or "0"


def both(lights: tuple[float, float]) -> str:
    return f"{share(lights[0])} to {share(lights[1])}"


def preserving_rows(system: nacre.System, say) -> tuple[list, list]:
    """By roughness at standard; and by accuracy, of all roughnesses together."""
    by_alpha, by_accuracy = [], []
    for case in PRESERVING:
        say(case.name)
        angles = OUTSIDE + (INSIDE if case.has_inside else ())
        nodes = case.nodes + SURFACE
        alphas = ALPHAS if "{x}" in nodes else ((0, 0),)
        ranges = {}
        for accuracy in ACCURACIES:
            ranges[accuracy] = []
            for x, y in alphas:
                furnace = Furnace(system, nodes.format(x=x, y=y), case.samples, accuracy=accuracy)
                ranges[accuracy].append(furnace.range(angles, (45,) if x == y else AZIMUTHS))
        cells = [both(each) for each in ranges["standard"]]
        by_alpha.append([case.name, *(cells if len(cells) > 1 else cells * len(ALPHAS))])
        by_accuracy.append([case.name] + [
            both((min(low for low, _ in ranges[a]), max(high for _, high in ranges[a])))
            for a in ACCURACIES])
    return by_alpha, by_accuracy


def model_rows(system: nacre.System, say) -> list:
    rows = []
    for case in MODELS:
        say(case.name)
        usual = Furnace(system, case.nodes, case.samples).range(OUTSIDE, (45,))
        kept = Furnace(system, case.nodes, case.samples, energy_conserving=True).range(OUTSIDE, (45,))
        rows.append([case.name, both(usual), share(kept[1])])
    return rows


def film_rows(system: nacre.System, say) -> list:
    cases = [(name, DOCUMENT.format(nodes=(nodes + SURFACE).format(x=0.3, y=0.3)), node_of_film, side)
             for name, nodes, node_of_film, side in UNDER_FILMS]
    rows = furnace_films.rows(system, cases, ACCURACIES, roberts(SAMPLES), say)
    return [[name, *(f"{both((low, high))}, {share(off)}"
                     for low, high, off in zip(cells[::3], cells[1::3], cells[2::3]))]
            for name, *cells in rows]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()

    def say(what: str) -> None:
        if sys.stderr.isatty():
            print(f"\r{what:70}", end="", file=sys.stderr, flush=True)

    system = nacre.System()
    by_alpha, by_accuracy = preserving_rows(system, say)
    of_films = film_rows(system, say)
    models = model_rows(system, say)
    angles = ", ".join(map(str, OUTSIDE))
    inside = ", ".join(map(str, INSIDE))
    page = f"""# White furnace

What comes back of a uniform white world, as a share: the mean weight of {SAMPLES:,} directions that
`sample` draws ({MORE_SAMPLES:,} of diffuse models and of transmission apart; nacre {nacre.__version__}), for viewers at {angles}° to the normal; of what has an
inside also at {inside}°; of anisotropic facets at azimuths of {", ".join(map(str, AZIMUTHS))}°. The
least and the most of all viewers. By `bench/furnace.py`.

## What keeps all light

At `standard`, by the roughness alpha along the tangent and across:

{report.table(["closure", *(f"{x}, {y}" if x != y else str(x) for x, y in ALPHAS)], by_alpha)}
Of all those roughnesses together, by accuracy:

{report.table(["closure", *ACCURACIES], by_accuracy)}
## Films

Each of {furnace_films.FILMS} drawn by chance, seen from one of {", ".join(map(str, furnace_films.ANGLES))}°: 20 to 1,500 nm, indices of film and
interface 1.1 to 2.5, alpha .02 to 1. The least and the most of any channel, and what one film of a hundred is further
off than, by accuracy:

{report.table(["closure", *ACCURACIES], of_films)}
## White materials

Models that lose light by what they are, or gain it; and the most with `energy_conserving`:

{report.table(["material", "light", "energy conserving, at most"], models)}"""
    arguments.out.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
