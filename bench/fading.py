#!/usr/bin/env python3
"""What noise that fades with the extent of points (CompileOptions::fade_noise) gains, and how near
it is to what a pixel sees: fractals of eight octaves by how many of their cells a square covers,
and a plain of them to the horizon.

    PYTHONPATH=build/python bench/fading.py --out bench/results
"""

import argparse
import pathlib
import statistics
import time

import nacre
import numpy

import report

POINTS = 4096
ROUNDS = 200
STEPS = 64  # Of the averages, along either side of a square.
WIDTHS = (0.0, 1 / 256, 1 / 64, 1 / 16, 1 / 4, 1.0, 4.0)
OCTAVES = 8
KINDS = (("fractal2d, float", "fractal2d", "float", "uv0", 2),
         ("fractal3d, float", "fractal3d", "float", "Po", 3),
         ("fractal3d, color3", "fractal3d", "color3", "Po", 3))

DOCUMENT = """<?xml version="1.0"?>
<materialx version="1.39">
  <{node} name="noise" type="{type}">
    <input name="octaves" type="integer" value="{octaves}" />
  </{node}>
  <output name="out" type="{type}" nodename="noise" />
</materialx>
"""


class Noise:
    def __init__(self, system: nacre.System, node: str, type_: str, fades: bool):
        document = nacre.Document.parse(DOCUMENT.format(node=node, type=type_, octaves=OCTAVES))
        self.is_color = type_ == "color3"
        self.shader = system.compile_outputs(document, ["out"], fade_noise=fades)

    def at(self, group: str, places, dx=None, dy=None) -> numpy.ndarray:
        points = {group: numpy.ascontiguousarray(places, "float32")}
        for axis, change in (("dx", dx), ("dy", dy)):
            points[f"d{group}{axis}"] = numpy.ascontiguousarray(
                numpy.zeros_like(places) if change is None else change, "float32")
        return self.shader.run(points)["out"].reshape(len(places), -1).astype(float)

    def call(self, group: str, places, dx, dy):
        """Of points that lie in memory as kernels like them, without what Python takes."""
        arrays = {group: columns(places), f"d{group}dx": columns(dx), f"d{group}dy": columns(dy)}
        out = columns(numpy.zeros((len(places), 3))) if self.is_color else numpy.zeros(len(places), "f4")
        binding = self.shader.bind(arrays | {"out": out})
        return lambda count=len(places): binding.run(nacre.Entry.OUTPUTS, count)


def columns(rows) -> numpy.ndarray:
    """The same numbers, each component behind the one before it."""
    return numpy.ascontiguousarray(numpy.transpose(rows), "float32").T


def squares(dimensions: int, width: float):
    """Middles, and both axes of squares of any direction."""
    random = numpy.random.default_rng(3)
    x, y = random.normal(size=(2, POINTS, dimensions))
    x /= numpy.linalg.norm(x, axis=1, keepdims=True)
    y -= x * (x * y).sum(1, keepdims=True)
    y /= numpy.linalg.norm(y, axis=1, keepdims=True)
    return random.uniform(-50, 50, (POINTS, dimensions)), width * x, width * y


def average(noise: Noise, group: str, middles, dx, dy) -> numpy.ndarray:
    total = 0
    for k in range(STEPS * STEPS):
        s, t = (k % STEPS + 0.5) / STEPS - 0.5, (k // STEPS + 0.5) / STEPS - 0.5
        total = total + noise.at(group, middles + s * dx + t * dy)
    return total / STEPS ** 2


def nanoseconds(calls) -> list[float]:
    """Of a call, less one for no points: each by turns with the others."""
    times = [[] for _ in calls]
    for _ in range(ROUNDS):
        for k, call in enumerate(calls):
            start = time.perf_counter_ns()
            call()
            middle = time.perf_counter_ns()
            call(0)
            times[k].append(2 * middle - start - time.perf_counter_ns())
    return [statistics.median(each) for each in times]


def off(found: numpy.ndarray, right: numpy.ndarray) -> float:
    return float(numpy.sqrt(((found - right) ** 2).mean()))


def rows(system: nacre.System) -> list[str]:
    made = []
    for title, node, type_, group, dimensions in KINDS:
        plain, fading = (Noise(system, node, type_, fades) for fades in (False, True))
        for width in WIDTHS:
            middles, dx, dy = squares(dimensions, width)
            right = average(plain, group, middles, dx, dy) if width > 0 else plain.at(group, middles)
            time_plain, time_fading = (each / POINTS for each in nanoseconds(
                [noise.call(group, middles, dx, dy) for noise in (plain, fading)]))
            made.append(
                f"| {title} | {width:.3g} | {time_plain:.2f} | {time_fading:.2f} "
                f"| {time_plain / time_fading:.2f} | {off(plain.at(group, middles), right):.3f} "
                f"| {off(fading.at(group, middles, dx, dy), right):.3f} |")
            print(made[-1], flush=True)
    return made


# -- The plain ---------------------------------------------------------------------------------

SIZE = (192, 512)  # Rows and columns.
SAMPLES = 16       # Of what is taken for right, along either side of a pixel.


def ground(row, column):
    """Where a ray through (row, column) meets the plain, seen from 1 above it."""
    down = 0.5 * (row + 0.5) / SIZE[0] + 1e-3
    across = (column + 0.5 - SIZE[1] / 2) / SIZE[0]
    return numpy.stack([across / down, 1 / down, numpy.zeros_like(down)], axis=-1) * 1.5


def plain_of(system: nacre.System) -> tuple[numpy.ndarray, list[str]]:
    plain, fading = (Noise(system, "fractal3d", "float", fades) for fades in (False, True))
    row, column = (each.ravel().astype(float) for each in numpy.mgrid[0:SIZE[0], 0:SIZE[1]])
    places = ground(row, column)
    dx, dy = ground(row, column + 1) - places, ground(row + 1, column) - places
    right = 0
    for k in range(SAMPLES ** 2):
        s, t = (k % SAMPLES + 0.5) / SAMPLES - 0.5, (k // SAMPLES + 0.5) / SAMPLES - 0.5
        right = right + plain.at("Po", ground(row + s, column + t))
    right /= SAMPLES ** 2
    pictures = [plain.at("Po", places, dx, dy), fading.at("Po", places, dx, dy), right]
    times = nanoseconds([noise.call("Po", places, dx, dy) for noise in (plain, fading)])
    table = [f"| {name} | {each / len(places):.2f} | {off(picture, right):.3f} |" for name, each, picture in
             zip(("all octaves", "faded"), times, pictures, strict=False)]
    return numpy.vstack([each.reshape(SIZE) for each in pictures]), table


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    system = nacre.System()
    table = "\n".join(rows(system))
    picture, plain = plain_of(system)
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.image
    matplotlib.image.imsave(arguments.out / "fading.png", picture, cmap="gray", vmin=-1.2, vmax=1.2)
    (arguments.out / "fading.md").write_text(f"""# Noise that fades

{report.cpu_model()}. `CompileOptions::fade_noise` beside all octaves: fractals of {OCTAVES} octaves at points
that are squares of any direction, so many cells of the first octave wide; ns a point, and the root of the
mean squared difference from the average over the square ({STEPS} by {STEPS} points of it). The noise has a
deviation of .3 or so. By `bench/fading.py`.

| noise | width | all octaves, ns | faded, ns | gain | all octaves, off | faded, off |
| --- | ---: | ---: | ---: | ---: | ---: | ---: |
{table}

A plain to the horizon, `fractal3d`, one sample a pixel: all octaves, faded, and the average of
{SAMPLES ** 2} samples a pixel that both are compared with.

| plain | ns | off |
| --- | ---: | ---: |
{chr(10).join(plain)}

![All octaves, faded, and as it is](fading.png)
""", encoding="utf-8")


if __name__ == "__main__":
    main()
