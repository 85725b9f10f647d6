"""Walk the observers that docs/guide/observer.md says RABBIT allows, and write what they do to a 5 Hz torque
there.

Run: python docs/write_observer_walks.py

Errors are held against NPD's with the same seed; the numbers are medians over these pairs with bootstrap
intervals of 95 %. About a minute.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from write_comparison import put
from write_results import table

from biped_adrc.files import write_text
from biped_adrc.studies.bench.cell import is_legal, is_made
from biped_adrc.studies.bench.run import run_trial
from biped_adrc.studies.bench.statistics import paired_ratio
from biped_adrc.studies.bench.trial import Trial

GUIDE = Path(__file__).resolve().parent / "guide" / "observer.md"
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


def walked(sensors: str, **controller: Any) -> list[Mapping[str, Any]]:
    """A row for each seed."""
    values = {**SENSORS[sensors], **SINE, **controller}
    return [run_trial(Trial(**values, seed=seed).record()) for seed in range(SEEDS)]


def ratio(rows: list[Mapping[str, Any]], usual: list[Mapping[str, Any]]) -> str:
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


def part() -> str:
    """The table."""
    usual = {name: walked(name, controller="NPD") for name in SENSORS}
    lines = [
        [
            str(m),
            f"{w:.0f}",
            *(ratio(walked(n, controller="ADRC", bandwidth=w, order=m), usual[n]) for n in SENSORS),
        ]
        for m, w in OBSERVERS.items()
    ]
    legal = ", ".join(
        f"{sum(is_legal(row) for row in rows)} with {name}" for name, rows in usual.items()
    )
    return "\n\n".join(
        [
            table(["m", "bandwidth [rad/s]", *SENSORS], lines),
            f"By `python docs/write_observer_walks.py`: {SEEDS} seeds, medians, intervals of 95 %. Of NPD's "
            f"own {SEEDS} walks are legal: {legal}.",
        ]
    )


def main() -> None:
    """Walk, write."""
    write_text(GUIDE, put(GUIDE.read_text(encoding="utf-8"), part(), (BEGIN, END)))


if __name__ == "__main__":
    main()
