#!/usr/bin/env python3
"""Whole shading calls beside Mitsuba 3: evaluation, density and a sample of each point.

usage: PYTHONPATH=build/python mitsuba_closures.py OUT.md [--install FOLDER] [--rounds N]

Mitsuba's fused `eval_pdf_sample` in its LLVM variant, time of the kernel without tracing, against
begin + evaluate + sample, or the one kernel `shade`, each in the batch that suits it best; one
thread, the two by turns. Ours compensates for what facets lose to several scatterings and Mitsuba's
does not: "without" leaves that out. Mitsuba's parameters stay open: "named" has those open that the
document gives, "live" all of ours, which are those of lobes that Mitsuba leaves out as well;
"fitted" is either with fit_parameters.
Where the models are the same the densities are compared before anything is timed.
"""

import argparse
import importlib
import pathlib
import re
import statistics
import subprocess
import sys
import time

import nacre
import numpy

MITSUBA = ("mitsuba==3.9.1", "drjit==1.5.0")
Entry = nacre.Entry
LOBES = [Entry.BEGIN, Entry.EVALUATE, Entry.SAMPLE]


def surface(category, **inputs):
    kinds = {int: "integer", float: "float", str: "string", bool: "boolean"}
    lines = []
    for name, value in inputs.items():
        if isinstance(value, tuple):
            kind, text = {2: "vector2", 3: "color3"}[len(value)], ", ".join(map(str, value))
        else:
            kind, text = kinds[type(value)], str(value).lower() if value is True else str(value)
        lines.append(f'<input name="{name}" type="{kind}" value="{text}"/>')
    is_bsdf = category.endswith("_bsdf")
    shader = "b" if not is_bsdf else "s"
    return f"""<materialx version="1.39">
      <{category} name="b" type="{'BSDF' if is_bsdf else 'surfaceshader'}">{''.join(lines)}
      </{category}>
      {'<surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>'
       if is_bsdf else ''}
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="{shader}"/></surfacematerial>
      </materialx>"""


COLOR = (0.8, 0.4, 0.2)
# A row: name, Mitsuba's BSDF, ours, whether the densities are the same.
GOLD = {"eta": (0.143, 0.375, 1.442), "k": (3.983, 2.386, 1.603)}


def rows():
    def rgb(value):
        return {"type": "rgb", "value": list(value)}

    principled = {"type": "principled", "base_color": rgb(COLOR), "roughness": 0.3}
    rich = principled | {"metallic": 0.3, "sheen": 0.5, "sheen_tint": 0.5, "clearcoat": 0.5,
                         "clearcoat_gloss": 0.9}
    return [
        ("metal, roughness .3",
         {"type": "roughconductor", "distribution": "ggx", "alpha": 0.3, "eta": rgb(GOLD["eta"]),
          "k": rgb(GOLD["k"])},
         surface("conductor_bsdf", ior=GOLD["eta"], extinction=GOLD["k"], roughness=(0.3, 0.3)),
         False),
        ("rough glass, .2",
         {"type": "roughdielectric", "distribution": "ggx", "alpha": 0.2, "int_ior": 1.5,
          "ext_ior": 1.0},
         surface("dielectric_bsdf", ior=1.5, roughness=(0.2, 0.2), scatter_mode="RT"), True),
        ("diffuse", {"type": "diffuse", "reflectance": rgb(COLOR)},
         surface("oren_nayar_diffuse_bsdf", color=COLOR), True),
        ("principled, plain; standard_surface", principled,
         surface("standard_surface", base=1.0, base_color=COLOR, specular_roughness=0.3), False),
        ("principled, plain; disney_principled", principled,
         surface("disney_principled", baseColor=COLOR, roughness=0.3), False),
        ("principled, metal, sheen, coat; standard_surface of five lobes", rich,
         surface("standard_surface", base=1.0, base_color=COLOR, specular_roughness=0.3,
                 metalness=0.3, sheen=0.5, coat=0.5, coat_roughness=0.1), False),
        ("principled, metal, sheen, coat; disney_principled", rich,
         surface("disney_principled", baseColor=COLOR, roughness=0.3, metallic=0.3, sheen=0.5,
                 sheenTint=0.5, clearcoat=0.5, clearcoatGloss=0.9), False),
        ("principled, spec_trans .5; disney_principled", principled | {"spec_trans": 0.5},
         surface("disney_principled", baseColor=COLOR, roughness=0.3, specTrans=0.5), False),
        ("principledthin, spec_trans .5; standard_surface, thin",
         {"type": "principledthin", "base_color": rgb(COLOR), "roughness": 0.3, "spec_trans": 0.5,
          "eta": 1.5},
         surface("standard_surface", base=1.0, base_color=COLOR, specular_roughness=0.3,
                 transmission=0.5, thin_walled=True), False),
    ]


def import_mitsuba(folder):
    if folder is not None:
        sys.path.insert(0, str(folder))
    try:
        import mitsuba
    except ImportError:
        command = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", "--quiet",
                   "--target", str(folder), "--no-deps", *MITSUBA]
        if folder is None or subprocess.run(command, check=False).returncode != 0:
            sys.exit("there is no Mitsuba, and it cannot be had: --install FOLDER, and PyPI")
        importlib.invalidate_caches()
        import mitsuba
    mitsuba.set_variant("llvm_ad_rgb")
    return mitsuba


def directions(count, random):
    """wo above, wi above."""
    def one():
        z = 0.05 + 0.95 * random.random(count, dtype=numpy.float32)
        phi = 2 * numpy.pi * random.random(count, dtype=numpy.float32)
        r = numpy.sqrt(1 - z * z)
        return numpy.stack([r * numpy.cos(phi), r * numpy.sin(phi), z], 1).astype(numpy.float32)

    return one(), one()


class Theirs:
    """A BSDF, for points whose numbers lie in arrays."""

    def __init__(self, mitsuba, description, count):
        import drjit

        self.dr, self.mi, self.count = drjit, mitsuba, count
        self.bsdf = mitsuba.load_dict(description)
        random = numpy.random.default_rng(7)
        viewer, other = directions(count, random)
        u = random.random((3, count), dtype=numpy.float32)
        self.viewer, self.other = mitsuba.Vector3f(*viewer.T), mitsuba.Vector3f(*other.T)
        self.normal = mitsuba.Vector3f(*numpy.tile(numpy.float32([[0], [0], [1]]), count))
        self.sample1, self.sample2 = mitsuba.Float(u[0]), mitsuba.Point2f(u[1], u[2])
        drjit.make_opaque(self.viewer, self.other, self.normal, self.sample1, self.sample2)

    def call(self):
        """Of directions in the world, as a renderer has them, and to such."""
        frame = self.mi.Frame3f(self.normal)
        interaction = self.dr.zeros(self.mi.SurfaceInteraction3f, self.count)
        interaction.sh_frame = frame
        interaction.wi = frame.to_local(self.viewer)
        value, pdf, sample, weight = self.bsdf.eval_pdf_sample(
            self.mi.BSDFContext(), interaction, frame.to_local(self.other), self.sample1,
            self.sample2)
        self.dr.eval(value, pdf, frame.to_world(sample.wo), sample.pdf, weight)
        return value, pdf

    def nanoseconds(self):
        with self.dr.scoped_set_flag(self.dr.JitFlag.KernelHistory, True):
            self.dr.kernel_history_clear()
            self.call()
            self.dr.sync_thread()
            history = self.dr.kernel_history([self.dr.KernelType.JIT])
        return 1e6 * sum(kernel["execution_time"] for kernel in history) / self.count


class Ours:
    """A material's kernels, bound to arrays. `entries`: what one point takes."""

    def __init__(self, document, count, entries, **options):
        self.count = count
        self.shader = nacre.default_system().compile_material(
            nacre.Document.parse(document), "M", no_footprints=True, entries=entries, **options)
        self.entries = [entry for entry in entries if self.shader.has(entry)]
        random = numpy.random.default_rng(7)
        wo, wi = directions(count, random)
        axes = (numpy.float32(axis) for axis in ((0, 0, 1), (1, 0, 0), (0, 1, 0), (0, 0, 0)))
        up, right, away, none = (numpy.tile(axis, (count, 1)) for axis in axes)
        u = random.random((3, count), dtype=numpy.float32).T
        state = numpy.zeros((count, max(1, self.shader.state_count)))
        self.arrays = columns(count, {
            "wo": wo, "wi": wi, "N": up, "T": right, "B": away, "P": none, "u": u, "f": none,
            "weight": none, "next.wi": none, "next.weight": none, "wi_of_sample": none,
            "pdf": none[:, :1], "next.pdf": none[:, :1], "state": state})
        self.arrays |= {name: self.arrays[name[0]] for name in ("No", "Ng", "To", "Bo", "Po")}
        for name in ("pdf", "next.pdf"):
            self.arrays[name] = self.arrays[name][:, 0]
        for name in ("lobe", "flags"):
            self.arrays[name] = numpy.zeros(count, numpy.int32)
        if self.shader.state_count == 0:
            del self.arrays["state"]
        unknown = {"wi_of_sample"} | ({name for name in self.arrays if name.startswith("next")}
                                      if Entry.SHADE not in entries else {"weight"})
        given = {name: array for name, array in self.arrays.items() if name not in unknown}
        # `sample` stores its direction under the name that `evaluate` reads.
        self.bindings = [(entry, self.shader.bind(
            given | ({"wi": self.arrays["wi_of_sample"]} if entry == Entry.SAMPLE else {}),
            entries=[entry])) for entry in self.entries]

    def call(self, count):
        for entry, binding in self.bindings:
            binding.run(entry, count)

    def nanoseconds(self):
        """Without what Python takes to call it for no points: Mitsuba's are without Python too."""
        calls = max(1, 2**18 // self.count)
        seconds = []
        for count in (self.count, 0):
            start = time.perf_counter()
            for _ in range(calls):
                self.call(count)
            seconds.append(time.perf_counter() - start)
        return 1e9 * (seconds[0] - seconds[1]) / (calls * self.count)


def columns(count, arrays):
    """The same numbers, each component behind the one before it in one block of memory, and no two
    of them a page apart."""
    held = numpy.zeros((sum(array.shape[1] for array in arrays.values()), count + 80),
                       numpy.float32)[:, :count]
    made = {}
    for name, array in arrays.items():
        rows, held = held[:array.shape[1]], held[array.shape[1]:]
        rows[:] = array.T
        made[name] = rows.T
    return made


def agree(mitsuba, description, document):
    """How far the densities of the two are apart, relative to the largest. (Values are not the
    same, for Mitsuba multiplies masking by shadowing; nor are the densities of metals, for ours
    come of the half of the facets that reflect upwards: pbs/microfacet.h.)"""
    theirs = Theirs(mitsuba, description, 4096)
    _, pdf = theirs.call()
    pdf = numpy.array(pdf)
    ours = Ours(document, 4096, LOBES, compensation="nothing")
    for entry, binding in ours.bindings[:-1]:
        binding.run(entry, 4096)  # Without `sample`, which stores a pdf too.
    return numpy.abs(ours.arrays["pdf"] - pdf).max() / pdf.max()


def best(candidates, rounds):
    """The least time of each, for whatever else the machine does adds to it; all take turns."""
    times = [[] for _ in candidates]
    for candidate in candidates:
        candidate.nanoseconds()
    for _ in range(rounds):
        for candidate, list_of in zip(candidates, times):
            list_of.append(candidate.nanoseconds())
    return [min(each) for each in times]


COUNTS_OF_OURS, COUNTS_OF_THEIRS = (1024, 4096), (16384, 65536)
WAYS = {
    "standard": {},
    "fast": {"accuracy": "fast"},
    "without": {"compensation": "nothing"},
    "named": {},
    "named, fitted": {"fit_parameters": True},
    "live": {"live": ["*"]},
    "live, fitted": {"live": ["*"], "fit_parameters": True},
}


def measure(mitsuba, description, document, rounds):
    """Nanoseconds of a point: Mitsuba's, and for each way the least of ours."""
    numbers = re.findall(r'<input name="(\w+)" type="(?:float|vector2|color3)"', document)
    named = {"live": [f"b/{name}" for name in numbers]}
    ways = [(way, Ours(document, count, entries, **options, **(named if "named" in way else {})))
            for way, options in WAYS.items() for entries in (LOBES, [Entry.SHADE])
            for count in COUNTS_OF_OURS]
    theirs = [Theirs(mitsuba, description, count) for count in COUNTS_OF_THEIRS]
    times = best([*theirs, *(ours for _, ours in ways)], rounds)
    least = {"mitsuba": min(times[:len(theirs)])}
    for (way, ours), nanoseconds in zip(ways, times[len(theirs):]):
        fused = ours.bindings[0][0] == Entry.SHADE
        if way not in least or nanoseconds < least[way][0]:
            least[way] = (nanoseconds, fused)
    return least


def price_of_new_values(document):
    """Microseconds that a call of `shade` takes more where it meets a value for the first time, with
    fit_parameters."""
    ours = Ours(document, 64, [Entry.SHADE], live=["*"], fit_parameters=True)
    entry, binding = ours.bindings[0]
    instance = ours.shader.instance()
    name = next(name for name in ours.shader.parameters if name.endswith("specular_roughness"))

    def seconds(change):
        values = []
        for k in range(500):
            if change:
                instance[name] = 0.2 + 0.001 * k
            start = time.perf_counter()
            binding.run(entry, 64, instance=instance)
            values.append(time.perf_counter() - start)
        return statistics.median(values)

    seconds(True)
    return 1e6 * (seconds(True) - seconds(False))


def table(measured):
    lines = [
        "# Whole shading calls, beside Mitsuba",
        "",
        f"Mitsuba 3.9.1 (LLVM), its fused `eval_pdf_sample`, against begin + evaluate + sample, or "
        f"`shade` (marked *) where that is less; one thread, ns a point without what Python takes to "
        f"call either, and Mitsuba's time over ours. Ours brings back what facets lose to several "
        f"scatterings, but in the column \"without\", which leaves that out as Mitsuba does. Mitsuba's "
        f"parameters are open: \"named\" has open what our document gives, \"live\" all that the model has, "
        f"those of lobes that Mitsuba's kernel leaves out as well, and \"fitted\" is either with "
        f"`fit_parameters`. `bench/peers/mitsuba_closures.py` "
        f"measures it.",
        "",
        "| closure | Mitsuba | " + " | ".join(f"{way} | ratio" for way in WAYS) + " |",
        "| --- | ---: | " + " | ".join("---: | ---:" for _ in WAYS) + " |"]
    for name, least in measured:
        cells = []
        for way in WAYS:
            nanoseconds, fused = least[way]
            cells += [f"{nanoseconds:.3g}{'*' if fused else ''}",
                      f"{least['mitsuba'] / nanoseconds:.2f}"]
        lines.append(f"| {name} | {least['mitsuba']:.3g} | " + " | ".join(cells) + " |")
    medians = [statistics.median(least["mitsuba"] / least[way][0] for _, least in measured)
               for way in WAYS]
    lines += ["", "Medians of the ratios: " + ", ".join(
        f"{way} {ratio:.2f}" for way, ratio in zip(WAYS, medians)) + "."]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--install", type=pathlib.Path, help="folder for Mitsuba, from PyPI")
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--only", default="", help="rows whose name has this")
    arguments = parser.parse_args()
    mitsuba = import_mitsuba(arguments.install)
    import drjit

    drjit.set_thread_count(0)  # Of workers: the calling thread does all.
    measured = []
    for name, description, document, is_same in rows():
        if arguments.only not in name:
            continue
        if is_same:
            error = agree(mitsuba, description, document)
            if not error < 1e-3:
                sys.exit(f"{name}: the two are {error:.2g} apart")
        measured.append((name, measure(mitsuba, description, document, arguments.rounds)))
        print(table(measured[-1:]).splitlines()[-3], flush=True)
    rich = next(row[2] for row in rows() if "five lobes" in row[0])
    price = (f"A call of the live `standard_surface`'s `shade` that meets new values takes "
             f"{price_of_new_values(rich):.0f} microseconds more where they are fitted.")
    arguments.out.write_text(f"{table(measured)}\n{price}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
