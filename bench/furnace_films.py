"""Films drawn by chance in a white world: how far what keeps all light is from keeping it."""

import nacre
import numpy

FILMS = 500
SAMPLES = 1 << 16
ANGLES = (0, 30, 60, 75, 80, 85, 88, 89.5)
ACCURACIES = ("fast", "standard", "precise")
VARIED = ("ior", "roughness", "thinfilm_thickness", "thinfilm_ior")

DIELECTRIC = """
  <dielectric_bsdf name="film" type="BSDF">
    <input name="roughness" type="vector2" value="0.3, 0.3" />
    <input name="thinfilm_thickness" type="float" value="300" />
    <input name="scatter_mode" type="string" value="{mode}" />
  </dielectric_bsdf>"""
OVER_WHITE = """
  <oren_nayar_diffuse_bsdf name="paper" type="BSDF">
    <input name="color" type="color3" value="1, 1, 1" />
  </oren_nayar_diffuse_bsdf>
  <layer name="lobe" type="BSDF">
    <input name="top" type="BSDF" nodename="film" />
    <input name="base" type="BSDF" nodename="paper" />
  </layer>"""
DOCUMENT = """<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">{nodes}
  <surface name="S" type="surfaceshader">
    <input name="bsdf" type="BSDF" nodename="{lobe}" />
  </surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S" />
  </surfacematerial>
</materialx>
"""
# Name, nodes, which of them scatters, the viewer's side.
CASES = (("dielectric_bsdf R over white", DIELECTRIC.format(mode="R") + OVER_WHITE, "lobe", 1),
         ("dielectric_bsdf RT, from outside", DIELECTRIC.format(mode="RT"), "film", 1),
         ("dielectric_bsdf RT, from inside", DIELECTRIC.format(mode="RT"), "film", -1))


def films():
    """Roughness, index, thickness in nm and index of the film, and the viewer's angle, of each."""
    random = numpy.random.default_rng(2)
    for _ in range(FILMS):
        yield (float(numpy.exp(random.uniform(numpy.log(0.02), 0.0))), random.uniform(1.1, 2.5),
               random.uniform(20.0, 1500.0), random.uniform(1.1, 2.5), random.choice(ANGLES))


def lights(system: nacre.System, nodes: str, lobe: str, side: int, accuracy: str, u) -> numpy.ndarray:
    """What comes back of each channel under each film."""
    slots = [f"film/{name}" for name in VARIED]
    shader = system.compile_material(
        nacre.Document.parse(DOCUMENT.format(nodes=nodes, lobe=lobe)), "M", no_footprints=True,
        accuracy=accuracy, live=slots, varying=slots,
        entries=[nacre.Entry.BEGIN, nacre.Entry.SAMPLE])
    found = []
    for alpha, index, thickness, film_index, angle in films():
        theta = numpy.radians(angle)
        point = nacre.surface_points(
            (0.0, 0.0, 0.0), (0.0, 0.0, 1.0),
            (float(numpy.sin(theta)), 0.0, side * float(numpy.cos(theta))), T=(1.0, 0.0, 0.0))
        point |= dict(zip(slots, (index, (alpha, alpha), thickness, film_index)))
        drawn = shader.run(point | {"u": u}, nacre.Entry.SAMPLE)
        found.append(drawn["weight"].astype("float64").mean(axis=0))
    return numpy.array(found)


def rows(system: nacre.System, u, say) -> list:
    """Of each closure and accuracy the least and the most, and what a hundredth is beyond."""
    table = []
    for name, nodes, lobe, side in CASES:
        cells = [name]
        for accuracy in ACCURACIES:
            say(f"{name}, films, {accuracy}")
            found = lights(system, nodes, lobe, side, accuracy, u)
            off = numpy.quantile(numpy.abs(found - 1.0).max(axis=1), 0.99)
            cells += [found.min(), found.max(), off]
        table.append(cells)
    return table
