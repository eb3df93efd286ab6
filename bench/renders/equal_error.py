#!/usr/bin/env python3
"""Renders beside Mitsuba 3 and Blender's Cycles: the CPU time that the same error takes.

usage: equal_error.py OUT.md NACRE [--install FOLDER] [--peers mitsuba cycles] [--size N] [--spp N]
                      [--runs N] [--keep FOLDER] [--only NAME] [--option=--x ...]

The same triangles, camera and light (scene.py). NACRE is the program. The time is that by which a picture
takes longer than one of a single sample: what each needs before its first ray is left out. The error is
what pictures of several seeds differ by: their variance over the squared mean, a pixel; so a bias would
not count as one, and the means are compared first. Efficiency: of ours over theirs, error times CPU time
the other way round; each the median of its runs, by turns.
"""

import argparse
import importlib
import importlib.util
import pathlib
import statistics
import subprocess
import sys

import numpy
import scene


def ensure(package, folder):
    """A peer, and its package, from PyPI where there is none."""
    peer = importlib.import_module(f"{package}_peer")
    module = peer.PACKAGES[0].split("=")[0]
    if folder is not None:
        sys.path.insert(0, str(folder))
    found = importlib.util.find_spec(module)
    if found is None or found.origin is None:  # A folder of that name is no package.
        command = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", "--quiet",
                   "--target", str(folder), "--no-deps", *peer.PACKAGES]
        if folder is None or subprocess.run(command, check=False).returncode != 0:
            sys.exit(f"there is no {module}, and it cannot be had: --install FOLDER, and PyPI")
        importlib.invalidate_caches()
    return peer


class Worker:
    """A renderer in a process of its own, for Mitsuba and Blender bring libraries that do not go together."""

    def __init__(self, name, subject, folder, asked):
        folder.mkdir(parents=True, exist_ok=True)
        command = [sys.executable, pathlib.Path(__file__).resolve(), asked.out, asked.nacre, "--serve", name,
                   "--only", subject, "--keep", folder, "--size", str(asked.size), "--spp", str(asked.spp),
                   *(f"--option={each}" for each in asked.option)]
        if asked.install is not None:
            command += ["--install", asked.install]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.spp, self.pictures, self.times = asked.spp, [], []

    def ask(self, seed, spp):
        self.process.stdin.write(f"{seed} {spp}\n")
        self.process.stdin.flush()
        for line in self.process.stdout:
            if line.startswith("done "):
                _, seconds, file = line.split(" ", 2)
                return numpy.load(file.strip()), float(seconds)
        sys.exit(f"a renderer ended with {self.process.wait()}")

    def render(self, seed):
        _, start = self.ask(seed, 1)
        picture, spent = self.ask(seed, self.spp)
        self.pictures.append(picture)
        self.times.append((spent - start) * self.spp / (self.spp - 1))

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def serve(name, subject, asked):
    """Answers lines of a seed and samples with the time and a picture's file."""
    peer = ensure(name, asked.install).Peer(subject, asked.keep, asked)
    for line in sys.stdin:
        seed, spp = map(int, line.split())
        picture, seconds = peer.run(seed, spp)
        numpy.save(asked.keep / name, numpy.float64(picture))
        print(f"done {seconds} {asked.keep / name}.npy", flush=True)


def error(pictures):
    """The variance of a picture over the squared mean, the mean over the pixels."""
    pictures = numpy.array(pictures)
    mean = pictures.mean(axis=0)
    return (pictures.var(axis=0, ddof=1).mean(axis=-1) / (mean.mean(axis=-1) ** 2 + 1e-4)).mean()


def compare(subject, asked):
    """A row of the table, and the efficiencies by peer."""
    folder = asked.keep / subject.replace(", ", "_").replace(" ", "_")
    workers = {name: Worker(name, subject, folder / name, asked) for name in ("nacre", *asked.peers)}
    for seed in range(asked.runs):
        order = list(workers.values())
        for worker in order if seed % 2 == 0 else reversed(order):
            worker.render(seed)
    cells, efficiencies = [subject], {}
    paths = asked.size ** 2 * asked.spp
    figures = {name: (error(w.pictures), statistics.median(w.times) / paths * 1e9, numpy.mean(w.pictures))
               for name, w in workers.items()}
    for worker in workers.values():
        worker.close()
    noise, time, mean = figures["nacre"]
    cells += [f"{time:.0f}", f"{noise:.2e}"]
    for name in asked.peers:
        their_noise, their_time, their_mean = figures[name]
        apart = mean / their_mean - 1
        if name == "mitsuba" and abs(apart) > scene.SUBJECTS[subject]:
            sys.exit(f"{subject}: the mean is {mean:.5f} here and {their_mean:.5f} in Mitsuba: no same picture")
        efficiencies[name] = their_noise * their_time / (noise * time)
        cells += [f"{100 * apart:+.1f} %", f"{their_time:.0f}", f"{their_noise:.2e}", f"**{efficiencies[name]:.2f}**"]
    return "| " + " | ".join(cells) + " |", efficiencies


TITLES = {"mitsuba": "Mitsuba", "cycles": "Cycles"}


def table_head(peers):
    heads = ["ball", "ns", "error"]
    for name in peers:
        heads += [f"mean, over {TITLES[name]}", f"{TITLES[name]}, ns", "error", "efficiency"]
    return "| " + " | ".join(heads) + " |\n| --- |" + " ---: |" * (len(heads) - 1)


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("nacre", type=lambda name: pathlib.Path(name).resolve())
    parser.add_argument("--install", type=pathlib.Path, help="where peers go that are not there")
    parser.add_argument("--peers", nargs="+", choices=TITLES, default=list(TITLES))
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--keep", type=lambda name: pathlib.Path(name).resolve(),
                        default=pathlib.Path("out/equal_error").resolve())
    parser.add_argument("--only", default="", help="of subjects' names")
    parser.add_argument("--option", action="append", default=[], help="for nacre render, as --option=--x")
    parser.add_argument("--serve", help=argparse.SUPPRESS)
    return parser.parse_args()


def main():
    asked = parse()
    if asked.serve:
        return serve(asked.serve, asked.only, asked)
    for name in ("nacre", *asked.peers):
        ensure(name, asked.install)
    lines = [f"""# The same error in less time

A ball on a floor under an image of a sky with a sun, {asked.size} by {asked.size} pixels, {asked.spp} samples each,
{scene.DEPTH} scatterings, {asked.runs} seeds, by `bench/renders/equal_error.py`: `nacre render` beside Mitsuba
(`llvm_ad_rgb`, `path`, `multijitter`) and Blender's Cycles on the CPU. CPU time of a path in ns, but for what each needs
before its first ray; error: the variance over the squared mean, the mean over the pixels; efficiency: how much less time
we take for the same error. Metal is that of one scattering between facets everywhere; plastic is a layer over a base
here, and what each has for it there.

{table_head(asked.peers)}"""]
    found = {name: [] for name in asked.peers}
    for subject in scene.SUBJECTS:
        if asked.only not in subject:
            continue
        row, efficiencies = compare(subject, asked)
        print(row, flush=True)
        lines.append(row)
        for name, value in efficiencies.items():
            found[name].append(value)
    medians = ", ".join(f"{statistics.median(values):.2f} beside {TITLES[name]}" for name, values in found.items())
    lines.append(f"\nMedian of the efficiencies: {medians}.")
    asked.out.parent.mkdir(parents=True, exist_ok=True)
    asked.out.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return None


if __name__ == "__main__":
    main()
