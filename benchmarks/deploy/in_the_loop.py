"""The table of docs/guide/robot.md on real time: an exported controller as a process of its own, at 1 kHz.

Run: chrt -f 50 python benchmarks/deploy/in_the_loop.py

Each row is a walk of RABBIT with its hardware by the clock on the wall, on the machine at hand.
"""

from __future__ import annotations

from rounding import PAGE, filled

import biped_adrc as ba
from biped_adrc.deploy.tick_times import spread

ROBOT = {"hardware": "rabbit", "period": 1e-3, "impacts": 10}
CASES = {
    "NPD": ba.Scenario("NPD", **ROBOT),
    "LESO, 100 rad/s": ba.Scenario("LESO", bandwidth=100.0, contact="hold", **ROBOT),
}
"""Rows of the table, on each plant."""
PLANTS = ("rigid", "mujoco")
HEADER = (
    "controller",
    "plant",
    "lock step",
    "sample instants",
    "missed",
    "reached late by the plant",
    "measured after its due: median, 99.9 %, worst [us]",
    "answered after that [us]",
)


def main() -> None:
    """Make all rows and write them into the page."""
    rows = [row(name, scenario, plant) for name, scenario in CASES.items() for plant in PLANTS]
    PAGE.write_text(filled(PAGE.read_text(), "in the loop", HEADER, rows, "in_the_loop"))


def row(name: str, scenario: ba.Scenario, plant: str) -> list[str]:
    """The cells of a controller on a plant."""
    found = ba.in_the_loop(ba.Scenario(**{**scenario.record(), "plant": plant}), real_time=True)
    times = found.times
    print(name, plant, found.walks, times.text(), flush=True)
    answered = times.trip[times.trip == times.trip]
    spreads = [", ".join(f"{1e6 * x:.0f}" for x in spread(y)) for y in (times.sent, answered)]
    counts = [str(len(x)) for x in (times.t, times.missed, times.overrun)]
    return [name, plant, "the same" if found.same_in_lock_step else "differs", *counts, *spreads]


if __name__ == "__main__":
    main()
