#!/usr/bin/env python3
"""Turns the results of one run of the benchmarks into Markdown tables and plots.

    bench/report.py build/bench-results --out bench/results
"""

import argparse
import pathlib
import platform
import sys

import plots
import results

PEERS = ("chain", "fractal", "conductor")
FILTERS = ("closest", "bilinear", "trilinear", "anisotropic")
WIDTHS = (1, 4, 8, 16)


def table(head: list[str], rows: list[list[str]]) -> str:
    align = ["---"] + ["---:"] * (len(head) - 1)
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, align, *rows]) + "\n"


def number(x: float | None) -> str:
    if x is None:
        return "–"
    return f"{x:.3g}" if x < 100 else f"{x:.0f}"


def cell(figure: results.Figure | None) -> str:
    if figure is None:
        return "–"
    noise = f" ±{100 * figure.noise:.0f}%" if figure.noise >= 0.03 else ""
    return number(figure.median) + noise


def ratio(a: results.Figure | None, b: results.Figure | None) -> float | None:
    return a.median / b.median if a and b else None


def cpu_model() -> str:
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor()


def machine(run: results.Run) -> str:
    context = run.context
    return (f"{cpu_model()} (LLVM: {context.get('cpu')}), {context['num_cpus']} CPUs, "
            f"{platform.system()}; peers by {context.get('peer_compiler', '?')}; "
            f"run {context['run']}. One thread, 4096 points a batch, ns a point unless said "
            "otherwise; medians, with the median absolute deviation where it is 3 % or more.\n")


def acceptance(run: results.Run) -> str:
    rows = []

    def row(what: str, target: float | None, value: float | None, unit: str = "×",
            below: bool = False) -> None:
        if value is None:
            rows.append([what, "–", "not measured", ""])
            return
        met = target is None or (value <= target if below else value >= target)
        goal = "report" if target is None else f"{'≤' if below else '≥'} {target:g} {unit}"
        rows.append([what, goal, f"{number(value)} {unit}",
                     "" if target is None else "yes" if met else "**no**"])

    for name in PEERS:
        subject = f"peers/{name}"
        best = run.best_jit(subject)
        if best is None:
            continue
        lanes, figure = best
        row(f"{name}: JIT (W = {lanes}) against xsimd by hand", 0.9,
            ratio(run.get(f"{subject}/xsimd"), figure))
        row(f"{name}: W = {lanes} against W = 1", 8 if name == "chain" else 6,
            ratio(run.get(f"{subject}/jit_w1/standard"), figure))
        row(f"{name}: JIT against interpreter", 3,
            ratio(run.get(f"{subject}/interpreter/standard"), figure))
    for name in FILTERS:
        for pattern, target in (("coherent", 8), ("random", 5)):
            subject = f"textures/{name}/{pattern}"
            best = run.best_jit(subject)
            row(f"texture, {name}, {pattern}: against OpenImageIO", target,
                ratio(run.get(f"{subject}/oiio"), best[1] if best else None))
    for entry in ("begin", "sample", "evaluate"):
        subject = "materials/standard_surface"
        row(f"standard_surface {entry}: folded against live parameters", None,
            ratio(run.get(f"{subject}/live/{entry}/jit_w16/standard"),
                  run.get(f"{subject}/frozen/{entry}/jit_w16/standard")))
    load = [run.get(f"latency/{stage}") for stage in ("library_load", "document_load")]
    row("library and document load", 15,
        sum(f.median for f in load) / 1e6 if all(load) else None, "ms", True)
    for stage, target in (("interpreter_first_batch", 10), ("cold_compile", 150),
                          ("cache_hit", 2)):
        for case in ("folded", "live"):
            figure = run.get(f"latency/{stage}/{case}")
            row(f"standard_surface, {stage.replace('_', ' ')}, {case}", target,
                figure.median / 1e6 if figure else None, "ms", True)
    call = run.get("python/twice/1/bound")
    row("Python: a bound call for one point", 3, call.median / 1e3 if call else None, "µs", True)
    whole = run.get("python/twice/65536/bound")
    row("Python: memory that a bound call of 65,536 points takes", 1,
        whole.counters["bytes"] / 1024 if whole else None, "KiB", True)
    return table(["what", "target", "measured", "met"], rows)


def variants(run: results.Run, top: str, columns: list[tuple[str, str]]) -> str:
    rows = [[name] + [cell(run.get(f"{top}/{name}/{variant}")) for _, variant in columns]
            for name in run.below(top)]
    return table([top.removesuffix("s")] + [title for title, _ in columns], rows)


WIDE = [(f"W = {w}", f"jit_w{w}/standard") for w in WIDTHS]
MODES = [("precise", "jit_w16/precise"), ("fast", "jit_w16/fast")]
SLOW = [("interpreter", "interpreter/standard")]


def functions(run: results.Run) -> str:
    columns = [(f"{mode}, W = {w}", f"jit_w{w}/{mode}") for mode in ("precise", "standard", "fast")
               for w in (1, 16)]
    return variants(run, "functions", columns + SLOW)


def materials(run: results.Run) -> str:
    text = variants(run, "materials", WIDE + MODES + SLOW)
    rows = []
    for name in run.below("materials"):
        figure = run.get(f"materials/{name}/jit_w16/standard")
        if figure and name.endswith("/evaluate"):
            rows.append([name.removesuffix("/evaluate"), number(figure.counters["state_bytes"])])
    return text + "\n" + table(["material", "state, bytes a point"], rows)


def latency(run: results.Run) -> str:
    names = sorted(name for name in run.figures if name.startswith("latency/"))
    stages = []
    for stage in ("read", "graph", "record", "slice", "derive", "contract", "expand_math", "run",
                  "emit", "optimize", "codegen", "link", "cache", "begin", "sample", "evaluate",
                  "kernel", "node"):
        if any(f"{stage}_ms" in run.figures[name].counters for name in names):
            stages.append(stage)
    rows = []
    for name in names:
        figure = run.figures[name]
        rows.append([name.removeprefix("latency/"), number(figure.median / 1e6)] +
                    [number(figure.counters.get(f"{stage}_ms")) for stage in stages])
    return ("Milliseconds: the whole, then by stage, then by kernel.\n\n"
            + table(["what", "all"] + stages, rows))


def nodes(run: results.Run) -> str:
    columns = [("W = 1", "jit_w1/standard"), ("W = 16", "jit_w16/standard")] + SLOW
    rows = []
    for name in run.below("nodes"):
        figures = [run.get(f"nodes/{name}/{variant}") for _, variant in columns]
        counters = figures[1].counters if figures[1] else {}
        rows.append([name] + [cell(figure) for figure in figures] +
                    [number(counters.get(key)) for key in ("ulps_99", "ulps_most")])
    return ("Time, and how far the results at W = 16 are from double precision, in units of the "
            "last place: 99 % of them, and the worst (where a difference cancels, or at an edge of "
            "a step, that may be far).\n\n"
            + table(["node"] + [title for title, _ in columns] +
                    ["ulp, 99 %", "ulp, worst"], rows))


def growth(run: results.Run) -> str:
    rows = []
    sizes = sorted({int(name.split("/")[1]) for name in run.figures if name.startswith("growth/")})
    for size in sizes:
        slow = run.get(f"growth/{size}/interpreter")
        fast = run.get(f"growth/{size}/jit")
        if slow is None or fast is None:
            continue
        operations = fast.counters["operations"]
        rows.append([str(size), f"{operations:.0f}", number(slow.counters["read_ms"]),
                     number(slow.counters["graph_ms"]), number(slow.counters["kernel_ms"]),
                     number(slow.counters["run_ms"]), number(slow.median / 1e6),
                     number(fast.median / 1e6), number(1e-3 * fast.median / operations),
                     number(slow.counters["memory_mb"]), number(fast.counters["memory_mb"])])
    return ("A graph of sines, powers, noises and arithmetic, from its text to the results of the "
            "first 4096 points: milliseconds by stage of the interpreter, of the whole with each "
            "engine, microseconds an operation with machine code, and megabytes.\n\n"
            + table(["nodes", "operations", "read", "graph", "kernel", "run", "interpreter", "JIT",
                     "JIT, µs an operation", "interpreter, MB", "JIT, MB"], rows))


def hosts(run: results.Run) -> str:
    entries = ("begin", "sample", "evaluate", "albedo")
    rows = []
    for case in ("columns/all", "columns/a_page_apart", "columns/half", "columns/half_in_any_order",
                 "columns/half_of_state", "structures/all", "structures/half", "instances/all"):
        rows.append([case] + [cell(run.get(f"hosts/{entry}/{case}")) for entry in entries])
    ways = [[name.replace("_", " "), cell(run.get(f"hosts/point/{name}"))]
            for name in ("begin", "begin_with", "begin_and_aovs", "apart",
                         "begin_sample_evaluate", "shade")]
    calls = [[what, cell(run.get(f"hosts/call/{name}"))]
             for name, what in (("wide", "a binding, code of all lanes"),
                                ("single", "a binding, code for single points"),
                                ("code", "the code for single points itself"),
                                ("empty", "a binding, no point"),
                                ("empty_of_instance", "the same with an instance"),
                                ("empty_code", "the code itself, no point"))]
    made = run.get("hosts/instance")
    topologies = [[live, number(figure.counters["compile_cpu_s"]), cell(figure),
                   number(figure.counters["instance_bytes"])]
                  for live, figure in ((live, run.get(f"hosts/topologies/{live}/iterations:1"))
                                       for live in ("few", "all")) if figure]
    return ("What a host pays for the way it keeps its points: standard_surface with every number "
            "live, time for each point that is shaded. Half of the points are picked by a list, "
            "at random, and their state is kept by place in the list, but in the row half_of_state; "
            "instances differ in colour and roughness from point to point. Columns are 16,704 bytes "
            "from each other; in the row a_page_apart 16,384, as where a system allocates each: those "
            "meet in the same sets of the caches.\n\n"
            + table(["points"] + list(entries), rows)
            + f"\nAn instance, made and given a colour: {cell(made)} ns. A call for one point "
            "(evaluate):\n\n"
            + table(["call", "ns"], calls) + "\n"
            "More of a point, of a standard_surface whose colour, emission and presence are one "
            "fractal noise of six octaves: begin alone; with albedo, emission and opacity; with "
            "normal, roughness and base colour too; those three by kernels of their own after it; "
            "begin, sample and evaluate one after another; and all at once.\n\n"
            + table(["asked", "ns"], ways)
            + "\nTwenty topologies of standard_surface compiled for a path tracer (begin, sample, "
            "evaluate), and fifty instances of each, with a roughness of their own: processor "
            "seconds of all compiles, nanoseconds and bytes of an instance, with few parameters "
            "live and with all.\n\n"
            + table(["live", "compiles, s", "instance, ns", "instance, bytes"], topologies))


def python(run: results.Run) -> str:
    rows = []
    for name, what in (("twice", "uv times two"), ("marble", "marble, a fractal noise")):
        for count in (1, 65536):
            figures = {way: run.get(f"python/{name}/{count}/{way}")
                       for way in ("c", "bound", "bind", "run")}
            if figures["c"] is None or figures["bound"] is None:
                continue
            extra = figures["bound"].median - figures["c"].median
            rows.append([what, f"{count:,}"] +
                        [f"{figure.median / 1e3:,.2f}" if figure else "–"
                         for figure in figures.values()] +
                        [number(extra), number(extra / count),
                         number(figures["bound"].counters["bytes"])])
    return ("Calls of the Python module, microseconds each, beside the same call from C++: of a "
            "binding, `Binding.run`; to bind the arrays again, `Shader.bind`; and both at once, "
            "`Shader.run`. What Python adds to a bound call is in nanoseconds, of the call and of "
            "each point (less than none is noise); memory in bytes is the most that the call had.\n\n"
            + table(["output", "points", "C++", "Binding.run", "Shader.bind", "Shader.run",
                     "added, ns", "added, ns a point", "bytes"], rows))


PAGES = {
    "acceptance": ("The figures the project promises", acceptance),
    "closures": ("Lobes", lambda run: variants(run, "closures", WIDE + MODES + SLOW)),
    "functions": ("Transcendental functions", functions),
    "growth": ("Growth", growth),
    "hosts": ("What hosts pay", hosts),
    "latency": ("Latency", latency),
    "materials": ("Shading models", materials),
    "nodes": ("Nodes", nodes),
    "peers": ("Kernels against the same formula by hand",
              lambda run: variants(run, "peers", WIDE + MODES + SLOW + [("xsimd", "xsimd")])),
    "python": ("Calls from Python", python),
    "textures": ("Texture look-ups, RGBA8, 2048²",
                 lambda run: variants(run, "textures", WIDE + SLOW + [("OpenImageIO", "oiio")])),
}


def untimed(run: results.Run) -> list[tuple[str, str]]:
    """Kernels whose results were wrong, and what could not be made, with the reason."""
    return [(name, message) for name, message in run.errors.items() if message != "nothing to do"]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=pathlib.Path)
    wanted = parser.add_mutually_exclusive_group(required=True)
    wanted.add_argument("--out", type=pathlib.Path)
    wanted.add_argument("--verify", action="store_true",
                        help="write nothing; exit status 1 where something was not timed")
    arguments = parser.parse_args()
    run = results.Run(arguments.results)
    if arguments.verify:
        sys.exit("\n".join(f"not timed: {name}: {message}" for name, message in untimed(run)) or 0)
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name, (title, write) in PAGES.items():
        page = f"# {title}\n\n{machine(run)}\n{write(run)}"
        (arguments.out / f"{name}.md").write_text(page, encoding="utf-8")
    print(acceptance(run))
    for name, message in untimed(run):
        print(f"not timed: {name}: {message}")
    try:
        plots.draw(run, arguments.out)
    except ImportError as error:
        sys.exit(f"no plots: {error} for {sys.executable} (Debian: python3-matplotlib)")


if __name__ == "__main__":
    main()
