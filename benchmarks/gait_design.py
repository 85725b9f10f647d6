"""The gait designer on RABBIT: cost and quality of its gaits, and the same problem by plain shooting.

Run: python benchmarks/gait_design.py [FOLDER] [--limit SECONDS]

Prints tables in Markdown, and writes the numbers to FOLDER/gait_design.json. Every design starts cold. Seconds
are wall time of one run on this machine, without loading the robot; judge by the ratios of one run. The ratio
of a shooting that was stopped is a lower bound, and its row shows the simulation that missed the rows least.
"""

from __future__ import annotations

import argparse
import json
import math
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from plain_shooting import shoot

import biped_adrc as ba
from biped_adrc.files import write_text
from biped_adrc.gait.design.optimise import optimise
from biped_adrc.gait.design.request import GaitRequest, StepLimits
from biped_adrc.gait.published import X_STAR
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.studies.gait_design import certify

PRESETS = ("identified", "tac2003")
SPEEDS = (0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1)  # [m/s]
SHOT_PRESET, SHOT_SPEEDS = "identified", (0.5, 0.8)  # [m/s]
NODES = 80  # of the quadrature that scores a finished gait

Row = dict[str, Any]


def designed(biped: ba.Biped, request: GaitRequest) -> Row:
    """Design and certificate of one request, timed apart; what stood in the way where there is none."""
    row: Row = {"preset": biped.preset, "speed [m/s]": request.speed}
    begin, cpu = time.perf_counter(), time.process_time()
    try:
        optimum = optimise(biped, request)
        between = time.perf_counter()
        row |= {"design [s]": between - begin, "design, CPU [s]": time.process_time() - cpu}
        found = certify(biped, request, optimum)
    except ba.GaitError as error:
        row.setdefault("design [s]", time.perf_counter() - begin)
        return row | {"certificate": str(error)}
    c = found.certificate
    return row | {
        "certify [s]": time.perf_counter() - between,
        "iterations": found.iterations,
        "step [m]": c.step_length,
        "peak torque [N m]": c.peak_torque,
        "friction": c.friction,
        "friction, impulse": c.impulse_ratio,
        "delta^2": found.multiplier,
        "objective [N^2 m s]": torque_squared(biped, found.gait),
        "certificate": "passed",
    }


def torque_squared(biped: ba.Biped, gait: ba.Gait) -> float:
    """int u'u dt / L of the periodic step [N^2 m s]."""
    zero = ZeroDynamics.of(biped, gait.constraint, NODES)
    orbit = zero.orbit(zero.sigma_minus * zero.delta)
    length = float(biped.swing_foot(gait.q_minus)[0])
    return float(orbit.time_weights @ np.sum(orbit.u**2, axis=1)) / length


def against_published(biped: ba.Biped) -> Row:
    """The gait through x*, beside the stored one that goes through it too."""
    published = ba.load_gait("published", biped)
    request = GaitRequest(through=tuple(X_STAR), limits=StepLimits(impulse_friction=math.inf))
    stored = torque_squared(biped, published)
    row = designed(biped, request) | {"published [N^2 m s]": stored}
    if "objective [N^2 m s]" in row:
        row["saved"] = 1.0 - row["objective [N^2 m s]"] / stored
    return row


def against_shooting(biped: ba.Biped, speed: float, limit: float, design: Row) -> Row:
    """The same problem by plain shooting, beside the row of the designer."""
    begin, cpu = time.perf_counter(), time.process_time()
    found = shoot(biped, speed, limit)
    wall, used = time.perf_counter() - begin, time.process_time() - cpu
    row = {
        "preset": biped.preset,
        "speed [m/s]": speed,
        "shooting [s]": wall,
        "shooting, CPU [s]": used,
        "iterations": found.iterations,
        "simulations": found.simulations,
        "objective [N^2 m s]": found.shot.objective,
        "rows missed by": found.shot.violation,
        "end": found.message or "converged",
        "designer [s]": design["design [s]"],
        "ratio": wall / design["design [s]"],
    }
    if "objective [N^2 m s]" in design:
        row["designer [N^2 m s]"] = design["objective [N^2 m s]"]
        row["ratio, CPU"] = used / design["design, CPU [s]"]
    return row


def table(title: str, rows: Sequence[Row]) -> None:
    """Print rows as a table in Markdown."""
    keys = list(dict.fromkeys(key for row in rows for key in row))
    lines = [keys, *([cell(row.get(key)) for key in keys] for row in rows)]
    widths = [max(len(line[j]) for line in lines) for j in range(len(keys))]
    lines.insert(1, ["-" * width for width in widths])
    print(f"\n{title}\n")
    for line in lines:
        print("| " + " | ".join(text.ljust(w) for text, w in zip(line, widths, strict=True)) + " |")


def cell(value: Any) -> str:
    """Four figures of a number."""
    return "" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)


def main() -> None:
    """Print the tables, and write the JSON when a folder is given."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", help="also write the numbers here")
    parser.add_argument("--limit", type=float, default=120.0, help="of each shooting [s]")
    asked = parser.parse_args()
    if not asked.limit > 0.0:
        parser.error(f"the limit is {asked.limit:g} s, expected more than 0 s")

    bipeds = {preset: ba.Biped.load("rabbit", preset) for preset in PRESETS}
    designs = [designed(b, GaitRequest(v)) for b in bipeds.values() for v in SPEEDS]
    table("Least torque at a speed, cold start", designs)
    published = [against_published(b) for b in bipeds.values()]
    table("Through x*, against the stored gait 'published'", published)
    by_speed = {row["speed [m/s]"]: row for row in designs if row["preset"] == SHOT_PRESET}
    shots = [
        against_shooting(bipeds[SHOT_PRESET], v, asked.limit, by_speed[v]) for v in SHOT_SPEEDS
    ]
    table("Plain shooting, the same problem and start", shots)
    if asked.folder:
        record = {"designs": designs, "through x*": published, "shooting": shots}
        write_text(asked.folder / "gait_design.json", json.dumps(record, indent=1) + "\n")


if __name__ == "__main__":
    main()
