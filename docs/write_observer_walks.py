"""Walk the observers that docs/guide/observer.md says RABBIT allows, and write what they do to a 5 Hz torque
there.

Run: python docs/write_observer_walks.py

Errors are held against NPD's with the same seed; the numbers are medians over these pairs with bootstrap
intervals of 95 %. What they are made of is kept in docs/comparison/observer_walks.json. About a minute.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from write_comparison import put
from write_results import table

from biped_adrc.analysis.statistics import paired_ratio
from biped_adrc.bench.cell import is_legal, is_made
from biped_adrc.bench.run import run_trial
from biped_adrc.files import write_text

DOCS = Path(__file__).resolve().parent
GUIDE, STORED = DOCS / "guide" / "observer.md", DOCS / "comparison" / "observer_walks.json"
BEGIN, END = "<!-- observer walks: begin -->", "<!-- observer walks: end -->"
SEEDS = 20
SINE = {
    "impacts": 12,
    "start_speed_spread": 0.02,
    "push": "sine",
    "on": "q1,q2,q3,q4",
    "amplitude": 20.0,
    "frequency": 5.0,
    "pushed_step": 1,
    "onset": 0.0,
    "duration": 60.0,
}
OBSERVERS = {1: 160.0, 2: 99.0, 3: 71.0, 5: 31.0, 7: 20.0}
"""m and bandwidth [rad/s] of the guide's table."""
SENSORS: Mapping[str, Mapping[str, Any]] = {
    "exact angles and rates": {"period": 1.5e-3, "torque_limit": 150.0},
    "8192 counts": {"hardware": "rabbit"},
    "8192 counts, rates filtered for 5 ms": {"hardware": "rabbit", "filter_time": 5e-3},
}


KEPT = ("survived", "legal", "rms_error")
"""Columns of a walk."""

Walks = Mapping[str, Mapping[str, Sequence[Mapping[str, Any]]]]
"""Of a controller (NPD, or m as text) with sensors: a row of `KEPT` for each seed."""


def walked(sensors: str, **controller: Any) -> list[Mapping[str, Any]]:
    """A row for each seed."""
    values = {**SENSORS[sensors], **SINE, **controller}
    rows = [run_trial({**values, "seed": seed}) for seed in range(SEEDS)]
    return [{name: row[name] for name in KEPT} for row in rows]


def walks() -> Walks:
    """All of them."""
    asked: dict[str, dict[str, Any]] = {"NPD": {"controller": "NPD"}}
    asked |= {
        str(m): {"controller": "ADRC", "bandwidth": w, "order": m} for m, w in OBSERVERS.items()
    }
    return {name: {n: walked(n, **values) for n in SENSORS} for name, values in asked.items()}


def ratio(rows: Sequence[Mapping[str, Any]], usual: Sequence[Mapping[str, Any]]) -> str:
    """Of rms errors in pairs that both make all steps, and how many of the walks are legal."""
    pairs = [(a, b) for a, b in zip(rows, usual, strict=True) if is_made(a) and is_made(b)]
    found = paired_ratio(
        [a["rms_error"] for a, _ in pairs], [b["rms_error"] for _, b in pairs], 1.0
    )
    if found is None:
        return "no pairs"
    value, low, high = found.value
    legal = sum(is_legal(row) for row in rows)
    return f"{value:.2f} ({low:.2f} to {high:.2f}), {found.pairs} pairs, {legal} legal"


def part(found: Walks) -> str:
    """The table."""
    usual = found["NPD"]
    lines = [
        [str(m), f"{w:.0f}", *(ratio(found[str(m)][n], usual[n]) for n in SENSORS)]
        for m, w in OBSERVERS.items()
    ]
    legal = ", ".join(
        f"{sum(is_legal(row) for row in rows)} with {name}" for name, rows in usual.items()
    )
    return "\n\n".join(
        [
            table(["m", "bandwidth [rad/s]", *SENSORS], lines),
            f"By `python docs/write_observer_walks.py`: {SEEDS} seeds, medians over pairs that both make all "
            f"steps, legally or not, intervals of 95 %. Of NPD's own {SEEDS} walks are legal: {legal}.",
        ]
    )


def read(path: Path = STORED) -> Walks:
    """The walks in the file."""
    found: Walks = json.loads(path.read_text(encoding="utf-8"))
    return found


def compact(found: Walks) -> str:
    """The walks as `read` reads them, a line for each controller and sensors."""
    parts = (
        f"{json.dumps(name)}: {{\n"
        + ",\n".join(
            f" {json.dumps(n)}: {json.dumps(rows, separators=(',', ':'))}"
            for n, rows in by_sensors.items()
        )
        + "\n}"
        for name, by_sensors in found.items()
    )
    return "{\n" + ",\n".join(parts) + "\n}\n"


def main() -> None:
    """Walk, write."""
    found = walks()
    write_text(STORED, compact(found))
    write_text(GUIDE, put(GUIDE.read_text(encoding="utf-8"), part(found), (BEGIN, END)))


if __name__ == "__main__":
    main()
