#!/usr/bin/env python3
"""Renders scenes with and without each technique of `nacre render`: the picture, the time, the noise
and the bias, as results/techniques.md and techniques.png.

    bench/techniques.py --nacre build/bin/nacre --out bench/results

Needs numpy, matplotlib and OpenEXR from PyPI. The bias of a technique is the difference of two means
of many samples; the gain is what time it saves for the same noise, where there is no bias.
"""

import argparse
import pathlib
import resource
import subprocess
import sys
import tempfile

import matplotlib.image
import numpy
import OpenEXR

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "examples"))

from ball_scene import DEPTH, write  # noqa: E402: examples is found by then.

SIZE, SPP, SEEDS, MANY = 128, 32, 6, 512
DIFFUSE = '<oren_nayar_diffuse_bsdf name="{name}" type="BSDF"><input name="color" type="color3" value="{0}, {0}, {0}"/></oren_nayar_diffuse_bsdf>'
METAL = '<conductor_bsdf name="{name}" type="BSDF"><input name="roughness" type="vector2" value="{0}, {0}"/></conductor_bsdf>'
GLASS = '<dielectric_bsdf name="{name}" type="BSDF"><input name="scatter_mode" type="string" value="RT"/><input name="roughness" type="vector2" value="{0}, {0}"/></dielectric_bsdf>'

# Title; ball, floor; options without and with; whether the mean stays.
CASES = (
    ("caustics left out, metal", (METAL, 0.05), (DIFFUSE, 0.5), [], ["--no-caustics"], False),
    ("caustics left out, glass", (GLASS, 0.0), (DIFFUSE, 0.5), [], ["--no-caustics"], False),
    ("roughness clamped along the path", (METAL, 0.01), (METAL, 0.3), [], ["--clamp-roughness"], False),
    ("roulette by throughput against none", (DIFFUSE, 0.8), (DIFFUSE, 0.5), ["--roulette", "none"],
     ["--roulette-depth", "1"], True),
    ("roulette by equation 1 against none", (DIFFUSE, 0.8), (DIFFUSE, 0.5), ["--roulette", "none"],
     ["--roulette", "event", "--roulette-depth", "1"], True),
    ("roulette by equation 1 against none, glass", (GLASS, 0.0), (DIFFUSE, 0.5), ["--roulette", "none"],
     ["--roulette", "event", "--roulette-depth", "1"], True),
    ("one of reflection and refraction against both, six times", (GLASS, 0.0), (DIFFUSE, 0.5),
     ["--split", "6"], [], True),
    ("indirect light at most 10", (METAL, 0.05), (DIFFUSE, 0.5), [], ["--clamp-indirect", "10"], False),
    ("indirect light at most 1", (METAL, 0.05), (DIFFUSE, 0.5), [], ["--clamp-indirect", "1"], False),
)


class Renders:
    def __init__(self, nacre, folder, ball, floor):
        self.nacre, self.folder = nacre, folder
        folder.mkdir()
        document = folder / "ball.mtlx"
        document.write_text('<materialx version="1.39">' + ball[0].format(ball[1], name="ball_bsdf") + """
          <surface name="ball_surface" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="ball_bsdf"/></surface>
          <surfacematerial name="ball" type="material">
            <input name="surfaceshader" type="surfaceshader" nodename="ball_surface"/></surfacematerial>
          </materialx>""", encoding="utf-8")
        file, _ = write(folder, document, "ball")
        text = file.read_text(encoding="utf-8")
        begin, end = text.index("<oren_nayar_diffuse_bsdf"), text.index("</oren_nayar_diffuse_bsdf>")
        file.write_text(text[:begin] + floor[0].format(floor[1], name="floor_bsdf")
                        + text[end + len("</oren_nayar_diffuse_bsdf>"):], encoding="utf-8")

    def picture(self, options, spp, seed):
        """(SIZE, SIZE, 3) floats, and seconds of CPU."""
        out = self.folder / "out.exr"
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([self.nacre, "render", self.folder / "scene.mtlx", "--scene",
                        self.folder / "scene.gltf", "--environment", self.folder / "sky.tga", "--max-depth",
                        str(DEPTH), "--size", str(SIZE), "--spp", str(spp), "--seed", str(seed), "--out", out,
                        "-q", *options], check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        with OpenEXR.File(str(out), separate_channels=True) as file:
            channels = file.channels()
            pixels = numpy.stack([channels[c].pixels for c in "RGB"], axis=-1)
        return pixels.astype(float), after.ru_utime - before.ru_utime


def noise(pictures):
    """Relative squared error of one picture, as several differ."""
    return (pictures.var(axis=0, ddof=1) / (pictures.mean(axis=0) ** 2 + 0.01)).mean()


def shown(picture):
    return numpy.clip(picture / (1 + picture), 0, 1) ** (1 / 2.2)


def compare(nacre, folder, case):
    title, ball, floor, without, with_, keeps_mean = case
    renders = Renders(nacre, folder, ball, floor)
    of, seconds, long = [], [], []
    renders.picture(without, 1, 0), renders.picture(with_, 1, 0)  # Compiled, and kept.
    for options in (without, with_):
        made = [renders.picture(options, SPP, seed) for seed in range(SEEDS)]
        of.append(numpy.stack([pixels for pixels, _ in made]))
        seconds.append(min(time for _, time in made))
        long.append(renders.picture(options, MANY, 99)[0])
    errors = [noise(each) for each in of]
    means = [each.mean(axis=(1, 2, 3)) for each in of]
    z = (means[1].mean() - means[0].mean()) / numpy.sqrt(sum(m.var(ddof=1) / SEEDS for m in means))
    bias = long[1].mean() / long[0].mean() - 1
    gain = errors[0] * seconds[0] / (errors[1] * seconds[1])
    difference = ((long[1] - long[0]) ** 2 / (long[0] ** 2 + 0.01)).mean()
    row = (f"| {title} | {seconds[0]:.2f} | {seconds[1]:.2f} | {errors[0]:.2e} | {errors[1]:.2e} | {gain:.2f} "
           f"| {100 * bias:+.2f} % | {z:+.1f} | {difference:.1e} |")
    if keeps_mean and abs(z) > 4:
        raise SystemExit(f"{title}: the mean is another, z = {z:.1f}")
    return row, numpy.hstack([shown(of[0][0]), shown(of[1][0]), numpy.clip(0.5 + (long[1] - long[0]), 0, 1)])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--nacre", required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    rows, strips = [], []
    with tempfile.TemporaryDirectory() as folder:
        for number, case in enumerate(CASES):
            row, strip = compare(arguments.nacre, pathlib.Path(folder) / str(number), case)
            print(row, flush=True)
            rows.append(row)
            strips.append(strip)
    (arguments.out / "techniques.md").write_text(f"""# Ways to less noise

What A. Langlands, *Physically Based Shader Design in Arnold* (2014), section 6, does, as `nacre render` has it: a ball
on a floor under a square lamp and an even sky, {SIZE} by {SIZE} pixels, {SPP} samples a pixel, {SEEDS} seeds, by
`bench/techniques.py`. Without the technique | with it: seconds of CPU of a picture (the least; reading, and kernels
from the cache, are part of it), noise (relative squared error of a picture, as the seeds differ), and what both
together gain: time without over time with it, at the same noise. Bias: difference of the means of pictures of {MANY}
samples; `z`: of those of {SPP} samples, in standard deviations. Change: relative squared difference of the pictures of
{MANY} samples, pixel by pixel, their noise with it.

| technique | s | s with | noise | noise with | gain | bias | z | change |
| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |
{chr(10).join(rows)}

Roulette, and the choice of one way where there are two, change no mean: `z` is within 4, else the program ends. The
others are another picture; what they gain in noise is worth that or is not. Below, for each row: without, with it, and
the difference of the pictures of {MANY} samples around grey.

![Without, with, difference](techniques.png)
""", encoding="utf-8")
    matplotlib.image.imsave(arguments.out / "techniques.png", numpy.vstack(strips))


if __name__ == "__main__":
    main()
