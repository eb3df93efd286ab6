"""Films drawn by chance in a white world: how far what keeps all light is from keeping it."""

import nacre
import numpy

FILMS = 500
ANGLES = (0, 30, 60, 75, 80, 85, 88, 89.5)
VARIED = ("ior", "roughness", "thinfilm_thickness", "thinfilm_ior")


def films():
    """Roughness, index, thickness in nm and index of the film, and the viewer's angle, of each."""
    random = numpy.random.default_rng(2)
    for _ in range(FILMS):
        yield (float(numpy.exp(random.uniform(numpy.log(0.02), 0.0))), random.uniform(1.1, 2.5),
               random.uniform(20.0, 1500.0), random.uniform(1.1, 2.5), random.choice(ANGLES))


def lights(system: nacre.System, document: str, node: str, side: int, accuracy: str,
           u) -> numpy.ndarray:
    """What comes back of each channel under each film, which is that of a node of the document."""
    slots = [f"{node}/{name}" for name in VARIED]
    shader = system.compile_material(
        nacre.Document.parse(document), "M", no_footprints=True, accuracy=accuracy, live=slots,
        varying=slots, entries=[nacre.Entry.BEGIN, nacre.Entry.SAMPLE])
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


def rows(system: nacre.System, cases, accuracies, u, say) -> list:
    """Of each case (name, document, node with the film, the viewer's side) by accuracy the least
    and the most, and what a hundredth is beyond."""
    table = []
    for name, document, node, side in cases:
        cells = [name]
        for accuracy in accuracies:
            say(f"{name}, films, {accuracy}")
            found = lights(system, document, node, side, accuracy, u)
            off = numpy.quantile(numpy.abs(found - 1.0).max(axis=1), 0.99)
            cells += [found.min(), found.max(), off]
        table.append(cells)
    return table
