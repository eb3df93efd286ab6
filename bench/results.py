"""Reads the JSON files of one run of the benchmarks."""

import json
import pathlib
import statistics
from typing import NamedTuple


class Figure(NamedTuple):
    """Nanoseconds a point (or, for latency, a call): median, and median absolute deviation."""
    median: float
    mad: float
    counters: dict[str, float]

    @property
    def noise(self) -> float:
        return self.mad / self.median if self.median else 0.0


KNOWN = {"name", "run_name", "run_type", "repetitions", "repetition_index", "threads",
         "iterations", "real_time", "cpu_time", "time_unit", "items_per_second", "family_index",
         "per_family_instance_index"}
UNIT = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}


class Run:
    """All benchmarks by name, "peers/chain/jit_w16/standard", and what they ran on."""

    def __init__(self, folder: pathlib.Path):
        self.figures: dict[str, Figure] = {}
        self.errors: dict[str, str] = {}
        self.context: dict[str, str] = {}
        files = sorted(folder.glob("bench_*.json"))
        if not files:
            raise SystemExit(f"no results in {folder}")
        runs = {}
        for file in files:
            data = json.loads(file.read_text(encoding="utf-8"))
            runs.setdefault((data["context"].get("run", "none"), data["context"]["host_name"]),
                            []).append(file.name)
            self.context |= data["context"]
            self._add(data["benchmarks"])
        if len(runs) > 1 or any(run == "none" for run, _ in runs):
            raise SystemExit(f"these are not of one run of bench/run.py: {runs}")

    def _add(self, rows: list[dict]) -> None:
        samples: dict[str, list[dict]] = {}
        for row in rows:
            if row.get("error_occurred"):
                self.errors[row["run_name"]] = row["error_message"]
            elif row["run_type"] == "iteration":
                samples.setdefault(row["run_name"].removesuffix("/real_time"), []).append(row)
        for name, repeated in samples.items():
            times = [time_of(row) for row in repeated]
            median = statistics.median(times)
            mad = statistics.median(abs(t - median) for t in times)
            counters = {k: statistics.median(row[k] for row in repeated)
                        for k in repeated[0] if k not in KNOWN}
            self.figures[name] = Figure(median, mad, counters)

    def get(self, name: str) -> Figure | None:
        return self.figures.get(name)

    def below(self, prefix: str) -> list[str]:
        """What comes between "<prefix>/" and the variant. Interleaved ones come by chance."""
        start = prefix + "/"
        found = {}
        for name in self.figures:
            if name.startswith(start):
                found["/".join(cut(name)[0].split("/")[1:])] = None
        return sorted(found) if prefix in ("peers", "textures") else list(found)

    def best_jit(self, name: str, accuracy: str = "standard") -> tuple[int, Figure] | None:
        """The fastest width."""
        found = [(lanes, figure) for lanes in (1, 4, 8, 16)
                 if (figure := self.get(f"{name}/jit_w{lanes}/{accuracy}"))]
        return min(found, key=lambda each: each[1].median) if found else None


def time_of(row: dict) -> float:
    if "items_per_second" in row:
        return 1e9 / row["items_per_second"]
    return row["real_time"] * UNIT[row["time_unit"]]


def cut(name: str) -> tuple[str, str]:
    """Subject and variant: "peers/chain", "jit_w16/standard"."""
    parts = name.split("/")
    count = 2 if parts[-1] in ("standard", "precise", "fast") else 1
    return "/".join(parts[:-count]), "/".join(parts[-count:])
