"""Cost of the parts of a step: dynamics, impact, one right-hand side, one control tick, whole walks.

Run: python benchmarks/step_timing.py [--json FILE]

Microseconds are medians of repeated batches on this machine; judge by the ratios of one run.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import biped_adrc as ba
from biped_adrc.studies.walk import default_method


def microseconds(function: Callable[[], object], batch: int = 400, repeats: int = 7) -> float:
    """Median time of one call [us]."""
    function()
    times = []
    for _ in range(repeats):
        begin = time.perf_counter()
        for _ in range(batch):
            function()
        times.append((time.perf_counter() - begin) / batch)
    return 1e6 * statistics.median(times)


def main() -> None:
    """Print the table, and write it as JSON when asked."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", type=Path, help="also write the numbers here")
    parser.add_argument("--impacts", type=int, default=4, help="length of the timed walks")
    arguments = parser.parse_args()

    biped = ba.Biped.load("rabbit")
    gait = ba.load_gait("published", biped)
    q, v = gait.start(biped)
    laws = {"NPD": ba.NPDController(gait.constraint), "ADRC": ba.ADRCController(gait.constraint)}
    rows: dict[str, float] = {
        "D_s [us]": microseconds(lambda: biped.inertia(q)),
        "Omega [us]": microseconds(lambda: biped.bias(q, v)),
        "split (11)-(15) [us]": microseconds(lambda: biped.reduction(q, v)),
        "forward dynamics [us]": microseconds(lambda: biped.acceleration(q, v, v)),
        "impact [us]": microseconds(lambda: biped.impact(gait.q_minus, gait.v_minus)),
    }
    for name, law in laws.items():
        walker = ba.Walker(biped, law)
        x, mode = walker.initial_state(q, v), ba.Mode()
        rows[f"right-hand side, {name} [us]"] = microseconds(
            lambda w=walker, x=x, m=mode: w.flow(0.0, x, m)
        )
        ticking = ba.Walker(biped, law, timing=ba.SampledTime(1e-3))
        tick, held = ticking.clocks()[0].update, ticking.initial_state(q, v)
        rows[f"control tick, {name} [us]"] = microseconds(
            lambda f=tick, x=held, m=mode: f(0.0, x, m)
        )
        for label, w in (("continuous", walker), ("1 kHz", ticking)):
            begin = time.perf_counter()
            walk = ba.walk(w, gait, arguments.impacts)
            wall = time.perf_counter() - begin
            method = default_method(w).label
            rows[f"wall s per simulated s, {name}, {label}, {method}"] = (
                wall / walk.trajectory.t_end
            )
    for label, value in rows.items():
        print(f"{label:<66s} {value:10.3f}")
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
