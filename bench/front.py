#!/usr/bin/env python3
"""The README's first figure: ns of a whole shading call against its error, ours by accuracy and by
what is left out, and Mitsuba's beside them.

    PYTHONPATH=build/python bench/front.py --install FOLDER --out bench/results

Errors are those that one number of a thousand exceeds, of f and of the density at 65,536 points:
shares of a number, or of a hundredth of the largest of its channel where that is more. Ours are
against the same document in double precision with everything exact, so what is left out counts.
Mitsuba's are against its own formulas, which have single scattering, in double precision.
"""

import argparse
import pathlib
import sys

import numpy

import report

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "peers"))
import mitsuba_closures as closures  # noqa: E402  It lies there.

POINTS = 65536
FLOOR = 0.01
# Name of the way, options.
WAYS = (("precise", {"accuracy": "precise"}),
        ("standard", {}),
        ("fast", {"accuracy": "fast"}),
        ("fast, single scattering", {"accuracy": "fast", "compensation": "nothing"}))


# -- Mitsuba's formulas, of unit directions above the surface ------------------------------------

def dot(a, b):
    return (a * b).sum(axis=1)


def ggx(alpha, wo, wi):
    """Cosine between viewer and half-way vector, D, and masking of either direction."""
    half = wo + wi
    half /= numpy.linalg.norm(half, axis=1, keepdims=True)
    across = (half[:, 0] ** 2 + half[:, 1] ** 2) / alpha ** 2
    density = 1 / (numpy.pi * alpha ** 2 * (across + half[:, 2] ** 2) ** 2)

    def masking(w):
        return 2 / (1 + numpy.sqrt(1 + alpha ** 2 * (1 - w[:, 2] ** 2) / w[:, 2] ** 2))

    return dot(wo, half), density, masking(wo), masking(wi)


def conductor(wo, wi):
    cosine, density, seen, lit = ggx(0.3, wo, wi)
    channels = []
    for n, k in zip(closures.GOLD["eta"], closures.GOLD["k"], strict=True):
        index = n + 1j * k
        inside = numpy.sqrt(index ** 2 - (1 - cosine ** 2))
        s = (cosine - inside) / (cosine + inside)
        p = (index ** 2 * cosine - inside) / (index ** 2 * cosine + inside)
        channels.append(0.5 * (abs(s) ** 2 + abs(p) ** 2) * density * seen * lit / (4 * wo[:, 2]))
    return numpy.stack(channels, axis=1), density * seen / (4 * wo[:, 2])


def dielectric(wo, wi):
    cosine, density, seen, lit = ggx(0.2, wo, wi)
    inside = numpy.sqrt(1 - (1 - cosine ** 2) / 1.5 ** 2)
    s = (cosine - 1.5 * inside) / (cosine + 1.5 * inside)
    p = (1.5 * cosine - inside) / (1.5 * cosine + inside)
    reflected = 0.5 * (s ** 2 + p ** 2)
    f = reflected * density * seen * lit / (4 * wo[:, 2])
    return numpy.tile(f[:, None], (1, 3)), reflected * density * seen / (4 * wo[:, 2])


def diffuse(_, wi):
    pdf = wi[:, 2] / numpy.pi
    return pdf[:, None] * numpy.float64(closures.COLOR), pdf


FORMULAS = {"metal, roughness .3": conductor, "rough glass, .2": dielectric, "diffuse": diffuse}


# -- What is measured ---------------------------------------------------------------------------

def error(found, right) -> float:
    """Of f and pdf."""
    shares = []
    for one, other in zip(found, right, strict=True):
        one, other = (numpy.reshape(each, (POINTS, -1)).astype(float) for each in (one, other))
        size = numpy.maximum(abs(other), FLOOR * abs(other).max(axis=0))
        shares.append((abs(one - other) / size).ravel())
    return float(numpy.quantile(numpy.concatenate(shares), 0.999))


def values(document, **options):
    """f and pdf of ours, of the directions that Mitsuba is asked for too."""
    ours = closures.Ours(document, POINTS, [closures.Entry.BEGIN, closures.Entry.EVALUATE], **options)
    ours.call(POINTS)
    return numpy.array(ours.arrays["f"]), numpy.array(ours.arrays["pdf"])


def measure(mitsuba, name, description, document, rounds):
    """(way, ns, error), Mitsuba's last."""
    theirs = closures.Theirs(mitsuba, description, POINTS)
    value, pdf = theirs.call()
    wo, wi = (numpy.array(w, dtype=float).T for w in (theirs.viewer, theirs.other))
    of_theirs = error((numpy.array(value).T, numpy.array(pdf)), FORMULAS[name](wo, wi))
    exact = values(document, engine="reference", accuracy="precise")
    errors = [error(values(document, **options), exact) for _, options in WAYS]
    candidates = [(way, closures.Ours(document, count, entries, **options))
                  for way, options in WAYS for entries in (closures.LOBES, [closures.Entry.SHADE])
                  for count in closures.COUNTS_OF_OURS]
    peers = [closures.Theirs(mitsuba, description, count) for count in closures.COUNTS_OF_THEIRS]
    times = closures.best([*peers, *(ours for _, ours in candidates)], rounds)
    of_ways = [(way, min(t for (other, _), t in zip(candidates, times[len(peers):], strict=True)
                         if other == way), errors[k]) for k, (way, _) in enumerate(WAYS)]
    return [*of_ways, ("Mitsuba", min(times[:len(peers)]), of_theirs)]


def draw(measured, file: pathlib.Path) -> None:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(8, 4.2), dpi=110)
    markers = dict(zip([way for way, _ in WAYS], "sov^", strict=True)) | {"Mitsuba": "*"}
    for (name, rows), colour in zip(measured, ("#b5651d", "#1f4e8c", "#3a7d44"), strict=True):
        ours = sorted((ns, each) for way, ns, each in rows if way != "Mitsuba")
        axes.plot(*zip(*ours, strict=True), color=colour, linewidth=0.8, alpha=0.6)
        for way, ns, each in rows:
            axes.plot(ns, each, markers[way], color=colour, markersize=11 if way == "Mitsuba" else 6,
                      markerfacecolor=colour if way == "Mitsuba" else "white")
        axes.annotate(name, ours[0], textcoords="offset points", xytext=(0, 8), fontsize=8, ha="center",
                      color=colour)
    for way, marker in markers.items():
        axes.plot([], [], marker, color="#444444", label=way,
                  markerfacecolor="#444444" if way == "Mitsuba" else "white")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(3e-8, 2)
    axes.set_xticks([1, 2, 5, 10, 20], ["1", "2", "5", "10", "20"])
    axes.minorticks_off()
    axes.set_xlabel("ns a point: evaluate, density and a sample, one thread")
    axes.set_ylabel("error that one of a thousand exceeds")
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
    figure.savefig(file, bbox_inches="tight")
    pyplot.close(figure)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--install", type=pathlib.Path, help="folder for Mitsuba, from PyPI")
    parser.add_argument("--rounds", type=int, default=30)
    arguments = parser.parse_args()
    mitsuba = closures.import_mitsuba(arguments.install)
    import drjit

    drjit.set_thread_count(0)  # Of workers: the calling thread does all.
    measured = [(name, measure(mitsuba, name, description, document, arguments.rounds))
                for name, description, document, _ in closures.rows() if name in FORMULAS]
    lines = [[name, way, report.number(ns), f"{each:.1e}"] for name, rows in measured
             for way, ns, each in rows]
    draw(measured, arguments.out / "front.png")
    about = " ".join(__doc__.split("\n\n")[2].split())
    (arguments.out / "front.md").write_text(
        f"# Speed against error\n\n{report.cpu_model()}. ns a point of a whole shading call, the least "
        f"of {arguments.rounds} rounds by turns (as in [mitsuba.md](mitsuba.md)). {about} By "
        f"`bench/front.py`.\n\n{report.table(['closure', 'way', 'ns', 'error'], lines)}\n"
        "![Errors and times](front.png)\n", encoding="utf-8")


if __name__ == "__main__":
    main()
