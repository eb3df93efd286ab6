#!/usr/bin/env python3
"""What asking for an error gains: `nacre tune` on the documents of the examples, tabulated and drawn.

    bench/trade.py --nacre build/bin/nacre --out bench/results
"""

import argparse
import json
import math
import pathlib
import subprocess
import sys
import time

import report

ROOT = pathlib.Path(__file__).resolve().parent.parent
DOCUMENTS = sorted(ROOT.glob("examples/documents/*.mtlx")) + [
    ROOT / "examples/brushed/disc.mtlx", ROOT / "examples/films/films.mtlx",
    ROOT / "bench/documents/materials.mtlx", ROOT / "bench/documents/fractal.mtlx"]
BUDGETS = (1e-3, 1e-2, 5e-2)


def tune(nacre: str, document: pathlib.Path, max_error: float) -> dict[str, dict]:
    """By "document: subject"."""
    done = subprocess.run([nacre, "tune", document, "--max-error", str(max_error), "--json"],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        print(f"{document.name}, {max_error}: {done.stderr.strip()}", file=sys.stderr)
    found = json.loads(done.stdout or "[]")
    return {f"{document.stem}: {each.get('material') or each.get('output')}": each
            for each in found}


def gain(found: dict) -> float:
    """Times as fast as standard."""
    return found["standard"]["nanoseconds"] / found["chosen"]["nanoseconds"]


def share(found: dict | None) -> str:
    """Of the time that standard takes."""
    return "–" if found is None else f"{1 / gain(found):.2f}"


def seen(found: dict | None, which: str) -> str:
    return "–" if found is None else f"{float(found['chosen']['unseen_error'][which]):.1e}"


def median(values: list[float]) -> float:
    values = sorted(values)
    middle = len(values) // 2
    return values[middle] if len(values) % 2 else 0.5 * (values[middle - 1] + values[middle])


def draw(tuned: dict[str, dict], file: pathlib.Path) -> None:
    """The fronts of all subjects, times beside standard's."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(8, 5), dpi=110)
    for found in tuned.values():
        of_standard = found["standard"]["nanoseconds"]
        points = [(each["nanoseconds"] / of_standard, max(float(each["error"]["p999"]), 1e-7))
                  for each in found["front"]]
        axes.plot(*zip(*points), marker="o", markersize=3, linewidth=0.8, alpha=0.6, color="#1f4e8c")
    for budget in BUDGETS:
        axes.axhline(budget, color="#d98e2b", linewidth=0.8)
    axes.axvline(1, color="#9aa5b1", linewidth=0.8)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("time, of what standard takes")
    axes.set_ylabel("error that one number of a thousand exceeds")
    axes.set_title("A line a material or output: the cheapest kernels of each error")
    axes.grid(alpha=0.3)
    figure.savefig(file, bbox_inches="tight")
    pyplot.close(figure)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--nacre", default=str(ROOT / "build/bin/nacre"))
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    tuned: dict[float, dict[str, dict]] = {budget: {} for budget in BUDGETS}
    longest = 0.0
    for document in DOCUMENTS:
        for budget in BUDGETS:
            start = time.monotonic()
            found = tune(arguments.nacre, document, budget)
            if found:
                longest = max(longest, (time.monotonic() - start) / len(found))
            tuned[budget] |= found
    names = list(dict.fromkeys(name for found in tuned.values() for name in found))
    rows = []
    for name in names:
        each = [tuned[budget].get(name) for budget in BUDGETS]
        standard = next(found for found in each if found)["standard"]
        rows.append([name, report.number(standard["nanoseconds"]),
                     f"{float(standard['error']['p999']):.1e}"]
                    + [text for found in each for text in (share(found), seen(found, "p999"),
                                                           seen(found, "maximum"))])
    gains = [f"{median([gain(found) for found in of_budget.values()]):.2f}"
             for of_budget in tuned.values()]
    kept = all(float(f["chosen"]["unseen_error"]["p999"]) <= budget
               and float(f["chosen"]["unseen_error"]["maximum"]) <= 3 * budget
               for budget, found in tuned.items() for f in found.values())
    text = (
        "# What asking for an error gains\n\n"
        f"{report.cpu_model()}. `nacre tune` on the examples: time of a point beside standard's "
        "(begin, sample, evaluate, emission, opacity; W of the machine), and the error of what was "
        "chosen at points that it was not chosen by: what one number of a thousand exceeds, and the "
        "largest. Errors are relative, with a floor of a hundredth of the largest number, against "
        "double precision with everything exact.\n\n"
        f"Median gain for {', '.join(f'{b:g}' for b in BUDGETS)}: {', '.join(gains)} ×. Every choice "
        f"keeps its error at the unseen points: {'yes' if kept else '**no**'}. The longest took "
        f"{math.ceil(10 * longest) / 10} s a subject.\n\n"
        + report.table(["subject", "standard, ns", "its error"]
                       + [title for b in BUDGETS
                          for title in (f"{b:g}: time", "unseen p99.9", "unseen maximum")], rows)
        + "\n![A line a material or output](trade.png)\n")
    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / "trade.md").write_text(text)
    draw(tuned[BUDGETS[0]], arguments.out / "trade.png")


if __name__ == "__main__":
    main()
