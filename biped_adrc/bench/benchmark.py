"""walkbench: the comparison frozen, so that numbers of different authors can be set beside each other.

A benchmark is one file of this package, walkbench-1.json, and never changes: base values, conditions, seeds,
metrics, the tuned settings of the reference controllers and all their walks. The hash of the file is in every
result. What another comparison would ask gets another name.

    walks of a controller    conditions x seeds, each a list of the metrics, None where there is no number
    cell                     of a condition: shares with Wilson's interval, medians over legal walks with
                             bootstrap intervals, and the median with walks that are not legal as infinite

`bench.benchmark_run` walks a controller under it; `bench.benchmark_result` writes and reads what is published.
The file is made once, by `python benchmarks/walkbench.py`.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.analysis.statistics import Interval, mcnemar, over_seeds, paired_ratio
from biped_adrc.bench.cell import Cell, is_legal
from biped_adrc.bench.findings import MARGIN
from biped_adrc.campaign.chunk import Record, Row
from biped_adrc.errors import InputError
from biped_adrc.files import plain
from biped_adrc.types import PlainRecord

BENCHMARKS = ("walkbench-1",)
"""Names of the benchmarks of this package."""
METRICS = ("survived", "legal", "rms_error", "peak_error", "rms_torque", "cost_of_transport")
"""What a benchmark that is frozen now keeps of a walk: columns of a row."""
DIGITS = 6
"""Significant digits of a number that is kept."""
REFERENCE = "NPD"
"""The reference controller that is walked anew with every result, and that others are held against."""

BenchWalks = Mapping[str, Sequence[Sequence[float | None]]]
"""By condition the walks of one controller, each the values of the metrics, in the order of the seeds."""


class Benchmark(NamedTuple):
    """A frozen comparison."""

    name: str
    """By which it is asked for."""
    hash: str
    """SHA-256 of its file."""
    base: Record
    """Values of all walks, the gait included."""
    conditions: Mapping[str, Mapping[str, Any]]
    """By name: `words`, `place` (whose settings controllers have there) and `values`."""
    seeds: tuple[int, ...]
    """Of every controller and condition."""
    metrics: tuple[str, ...]
    """Columns of a walk; the first two are `survived` and `legal`."""
    free: tuple[str, ...]
    """Values of a scenario that a controller may choose; parameters of its own besides."""
    contestants: Mapping[str, Record]
    """Reference controllers: values everywhere."""
    places: Mapping[str, Mapping[str, Record]]
    """Their tuned values by place."""
    versions: Mapping[str, str]
    """With which the reference was walked."""
    walks: Mapping[str, BenchWalks]
    """Of the reference controllers."""

    def record(self, condition: str, values: Record, seed: int) -> dict[str, object]:
        """The trial of a controller with these values under a condition."""
        return {**self.base, **self.conditions[condition]["values"], **values, "seed": seed}

    def reference(self, name: str, place: str) -> Record:
        """The values of a reference controller at a place."""
        return {**self.contestants[name], **self.places.get(place, {}).get(name, {})}

    def kept(self, row: Row) -> list[float | None]:
        """What is kept of the row of a walk."""
        return [_short(row[name]) for name in self.metrics]

    def places_asked(self) -> list[str]:
        """The places that conditions name, in their order."""
        return list(dict.fromkeys(x["place"] for x in self.conditions.values()))


@cache
def load_benchmark(name: str) -> Benchmark:
    """A benchmark of this package by its name. Raises InputError for another name."""
    if name not in BENCHMARKS:
        raise InputError(f"there is no benchmark '{name}', expected one of {list(BENCHMARKS)}")
    return benchmark_of(name, files("biped_adrc.bench").joinpath(f"{name}.json").read_bytes())


def benchmark_of(name: str, data: bytes) -> Benchmark:
    """A benchmark from the bytes of its file."""
    told = json.loads(data)
    told["seeds"], told["metrics"] = tuple(told["seeds"]), tuple(told["metrics"])
    return Benchmark(name, hashlib.sha256(data).hexdigest(), **told | {"free": tuple(told["free"])})


def _short(x: object) -> float | None:
    """A number to so many digits; None for what is none."""
    if isinstance(x, int):
        return x
    return float(f"{x:.{DIGITS}g}") if isinstance(x, float) and math.isfinite(x) else None


def cells(bench: Benchmark, walks: BenchWalks) -> dict[str, PlainRecord]:
    """The cell of each condition in plain values."""
    return {name: _cell(bench, name, rows) for name, rows in walks.items()}


def _cell(bench: Benchmark, condition: str, rows: Sequence[Sequence[float | None]]) -> PlainRecord:
    walked = _named(bench, rows)
    cell = Cell("", condition, tuple(walked))
    at = bench.metrics.index("rms_error")
    ranked = [
        row[at] if is_legal(w) and row[at] is not None else math.inf
        for row, w in zip(rows, walked, strict=True)
    ]
    found: dict[str, Interval | None] = {
        "legal": cell.legal,
        "survived": cell.survived,
        **cell.medians(dict.fromkeys(bench.metrics[2:], "")),
        "ranked_rms_error": over_seeds(np.array([ranked]), lambda sets: np.median(sets, axis=1)),
    }
    told = {name: None if x is None else plain(list(x)) for name, x in found.items()}
    return {"walks": len(rows), **told}


def held_against(bench: Benchmark, walks: BenchWalks, usual: BenchWalks) -> dict[str, PlainRecord]:
    """Each condition's walks beside the reference's with the same seeds.

    rms_error: median ratio with its interval and p-value, over pairs that are both legal, None without any;
    legal: p-value of McNemar's test.
    """
    found: dict[str, PlainRecord] = {}
    for name, rows in walks.items():
        pairs = list(zip(_named(bench, rows), _named(bench, usual[name]), strict=False))
        both = [(a["rms_error"], b["rms_error"]) for a, b in pairs if is_legal(a) and is_legal(b)]
        known = [(a, b) for a, b in both if a and b]
        ratio = paired_ratio([a for a, _ in known], [b for _, b in known], MARGIN)
        legal = mcnemar([is_legal(a) for a, _ in pairs], [is_legal(b) for _, b in pairs])
        told = ratio and {"pairs": ratio.pairs, "value": list(ratio.value), "p": ratio.p}
        found[name] = {"rms_error": told, "legal": legal}
    return found


def _named(bench: Benchmark, rows: Sequence[Sequence[float | None]]) -> list[dict[str, Any]]:
    """Walks as rows by name."""
    return [dict(zip(bench.metrics, row, strict=True)) for row in rows]
