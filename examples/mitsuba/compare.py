#!/usr/bin/env python3
"""Renders documents in Mitsuba by nacre_bsdf and by `nacre render`, and says how far apart they are.

usage: PYTHONPATH=build/python compare.py OUT [--size 128] [--spp 64] [--runs 8] [DOCUMENT...]

The same triangles, camera and light (ball.py); pictures of several seeds each, so that their noise
is known. `z` is the difference of the means over its standard deviation: within 3 or so they are
the same. Pixels have relative squared errors, beside those that noise alone has; below, the time of
a path in Mitsuba beside its own `principled`, eager and as Mitsuba does it by itself.
OUT/compare.png: Mitsuba, nacre render, and ten times their difference around grey.
"""

import argparse
import contextlib
import pathlib
import time

import mitsuba as mi
import numpy

mi.set_variant("llvm_ad_rgb")

import ball  # noqa: E402: asks for a variant, and finds the folder above.
import nacre  # noqa: E402
import nacre_mitsuba  # noqa: E402
from ball_scene import write  # noqa: E402

DOCUMENTS = pathlib.Path(__file__).resolve().parents[1] / "documents"
NAMES = ("brass", "plastic", "glass", "car_paint", "velvet")


def pictures(document, folder, size, spp, runs):
    """(runs, size, size, 3) of Mitsuba and of `nacre render`."""
    folder.mkdir(parents=True, exist_ok=True)
    material = nacre.Document(document).materials[0]
    scene = ball.load({"type": "nacre_bsdf", "filename": str(document), "material": material}, size)
    with nacre_mitsuba.eager():
        theirs = [numpy.array(mi.render(scene, spp=spp, seed=seed)) for seed in range(runs)]
    file, options = write(folder, document, material)
    ours = [numpy.array(mi.Bitmap(str(nacre.render(file, out=folder / "nacre.exr", size=size, spp=spp,
                                                   seed=seed, **options))))[..., :3]
            for seed in range(runs)]
    return numpy.float64(theirs), numpy.float64(ours)


def agreement(a, b, pixels=slice(None)):
    """Means of two stacks of pictures over some pixels, their difference in standard deviations,
    and relative squared errors of the stacks' means: what is there, and what noise makes."""
    a, b = (each.reshape(len(each), -1, 3)[:, pixels] for each in (a, b))
    means = [each.mean(axis=(1, 2)) for each in (a, b)]
    deviation = numpy.sqrt(sum(each.var(ddof=1) / len(each) for each in means))
    floor = numpy.mean(b, axis=0) ** 2 + 0.01
    error = ((a.mean(0) - b.mean(0)) ** 2 / floor).mean()
    noise = sum((each.var(axis=0, ddof=1) / len(each) / floor).mean() for each in (a, b))
    return means[0].mean(), means[1].mean(), (means[0].mean() - means[1].mean()) / deviation, error, noise


def of_ball(size):
    """Places of pixels that see the ball."""
    scene = ball.load({"type": "diffuse"}, size)
    scene_of_ball = mi.load_dict({"type": "scene", "ball": ball.mesh("ball", {"type": "diffuse"}),
                                  "sensor": scene.sensors()[0],
                                  "integrator": {"type": "depth"}})
    return numpy.ravel(numpy.array(mi.render(scene_of_ball, spp=16)).max(axis=-1) > 0)


def seconds(bsdf, size, spp, is_eager):
    """A picture's time, the better of two after a first one."""
    scene = ball.load(bsdf, size)
    taken = []
    with nacre_mitsuba.eager() if is_eager else contextlib.nullcontext():
        for seed in range(3):
            begin = time.perf_counter()
            numpy.array(mi.render(scene, spp=spp, seed=seed))
            taken.append(time.perf_counter() - begin)
    return min(taken[1:])


def encoded(picture):
    return numpy.clip(1 - numpy.exp(-1.5 * picture), 0, 1) ** (1 / 2.2)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("documents", nargs="*", type=pathlib.Path)
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--runs", type=int, default=8)
    asked = parser.parse_intermixed_args()
    documents = asked.documents or [DOCUMENTS / f"{name}.mtlx" for name in NAMES]
    ball_pixels = of_ball(asked.size)
    rows = []
    print("| document | pixels | Mitsuba | nacre render | difference | z | relMSE | of noise |\n"
          "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for document in documents:
        theirs, ours = pictures(document, asked.out / document.stem, asked.size, asked.spp, asked.runs)
        for what, pixels in (("all", slice(None)), ("ball", ball_pixels)):
            a, b, z, error, noise = agreement(theirs, ours, pixels)
            print(f"| {document.stem} | {what} | {a:.5f} | {b:.5f} | {100 * (a / b - 1):+.3f} % | {z:+.1f}"
                  f" | {error:.2e} | {noise:.2e} |", flush=True)
        a, b = theirs.mean(axis=0), ours.mean(axis=0)
        rows.append(numpy.hstack([encoded(a), encoded(b), numpy.clip(0.5 + 10 * (a - b), 0, 1)]))
    mi.Bitmap(numpy.uint8(255 * numpy.vstack(rows) + 0.5)).write(str(asked.out / "compare.png"))
    paths = asked.size ** 2 * asked.spp
    print("\n| BSDF of the ball | ns a path |\n| --- | ---: |")
    principled = {"type": "principled", "roughness": 0.3, "clearcoat": 1.0, "specular": 0.5}
    timed = [("principled, as Mitsuba does it", principled, False), ("principled, eager", principled, True)]
    timed += [(f"nacre_bsdf, {each.stem}", {"type": "nacre_bsdf", "filename": str(each)}, True)
              for each in documents]
    for name, bsdf, is_eager in timed:
        print(f"| {name} | {1e9 * seconds(bsdf, asked.size, asked.spp, is_eager) / paths:.0f} |")


if __name__ == "__main__":
    main()
