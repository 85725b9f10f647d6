"""Replay logs with a known torque through several observers, for docs/guide/replay.md: a figure and a table.

Run: python docs/write_replay.py

Each log is of one walk under NPD, so no observer has had a part in it. The numbers are kept in
docs/replay/summary.json, those that the figure shows in docs/replay/recovered.json. Half a minute.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from write_comparison import put
from write_results import table

from biped_adrc.files import write_bytes, write_text
from biped_adrc.logs.log_of_walk import logged
from biped_adrc.logs.replay import replay
from biped_adrc.logs.replay_signals import ReplaySignals
from biped_adrc.scenario.run import walk_scenario
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.types import Array
from biped_adrc.viz.figure_numbers import as_text, numbers_of
from biped_adrc.viz.style import DASHES, GREY, PALETTE, label, new_figure, render, style

DOCS = Path(__file__).resolve().parent
GUIDE, FOLDER = DOCS / "guide" / "replay.md", DOCS / "replay"
BEGIN, END = "<!-- replayed: begin -->", "<!-- replayed: end -->"
STEP, ON, OFF, TORQUE = 3, 0.1, 0.3, 20.0
"""The push: single support, from and to [s] after its touchdown, and torque [N m] on both hips."""
FROM = 0.09
"""Errors count from here on [s] after the touchdown, where the slowest observer has forgotten the contact."""
WALK = {
    "controller": "NPD",
    "period": 1e-3,
    "torque_limit": 150.0,
    "impacts": STEP,
    "pushes": f"q1,q2={TORQUE:g}@{STEP}:{ON:g}-{OFF:g}",
}
COUNTED = {"counts": 8192.0, "velocity": "differences", "filter_time": 5e-3}
LOGS: Mapping[str, Mapping[str, Any]] = {
    "rigid": {},
    "rigid, 8192 counts": COUNTED,
    "MuJoCo": {"plant": "mujoco"},
    "MuJoCo, 8192 counts, 1 ms late": {"plant": "mujoco", **COUNTED, "delay": 1e-3},
}
"""What is logged: the plant, and between it and the controller encoders and a hidden delay."""
OBSERVERS: Mapping[str, Mapping[str, Any]] = {
    "m = 1, 160 rad/s": {"controller": "LESO", "bandwidth": 160.0},
    "m = 2, 99 rad/s": {"controller": "ADRC", "bandwidth": 99.0, "order": 2},
    "m = 3, 71 rad/s": {"controller": "ADRC", "bandwidth": 71.0, "order": 3},
    "m = 1 told xi, 160 rad/s": {"controller": "ADRC assisted", "bandwidth": 160.0},
    "Kalman, m = 1, 160 rad/s": {
        "controller": "ADRC",
        "observer": "Kalman",
        "order": 1,
        "own": {"drift": 28.7, "measurement": 7e-6},
    },
    "momentum, 100 rad/s": {"controller": "DOB", "bandwidth": 100.0},
    "Table I, m = 7": {"controller": "ADRC"},
}
"""Those of the table of docs/guide/observer.md that RABBIT allows, others as fast, and the paper's."""
SHOWN = ("m = 1, 160 rad/s", "m = 3, 71 rad/s", "m = 1 told xi, 160 rad/s", "momentum, 100 rad/s")
"""In the figure."""

Found = Mapping[str, Mapping[str, ReplaySignals]]
"""Signals by log and observer."""


def found() -> Found:
    """All replays."""
    logs = {name: logged(walk_scenario(Scenario(**WALK, **more))) for name, more in LOGS.items()}
    return {
        name: {o: replay(log, Scenario(**values)).signals for o, values in OBSERVERS.items()}
        for name, log in logs.items()
    }


def truth(x: ReplaySignals) -> Array:
    """zeta (K, p) [N m] that acted in each row."""
    on = (x.step == STEP) & (x.t_step > ON - 1e-9) & (x.t_step < OFF - 1e-9)
    return np.where(on[:, np.newaxis], [TORQUE, TORQUE, 0.0, 0.0], 0.0)


def missed(x: ReplaySignals) -> float:
    """rms of estimate less truth [N m] of the joint where it is largest, over the pushed single support."""
    rows = (x.step == STEP) & (x.t_step > FROM)
    return float(np.max(np.sqrt(np.mean((x.zeta_estimate - truth(x))[rows] ** 2, axis=0))))


def level(x: ReplaySignals) -> float:
    """Mean estimate [N m] of the first joint in the second half of the push."""
    rows = (x.step == STEP) & (x.t_step > 0.5 * (ON + OFF)) & (x.t_step < OFF)
    return float(np.mean(x.zeta_estimate[rows, 0]))


def summary(signals: Found) -> dict[str, Any]:
    """Error and level of each observer on each log [N m]."""
    return {
        o: {name: [missed(by[o]), level(by[o])] for name, by in signals.items()} for o in OBSERVERS
    }


def part(numbers: Mapping[str, Mapping[str, Any]]) -> str:
    """The table, and how it was made."""
    rows = [
        [o, *(f"{by[name][0]:.3g} ({by[name][1]:.3g})" for name in LOGS)]
        for o, by in numbers.items()
    ]
    return "\n\n".join(
        [
            table(["observer", *LOGS], rows),
            f"By `python docs/write_replay.py`: rms error of the estimated torque [N m] in the pushed single "
            f"support, from {1e3 * FROM:g} ms after its touchdown on, of the joint where it is largest; in "
            f"brackets the mean estimate on q1 in the second half of the push of {TORQUE:g} N m.",
        ]
    )


def read(path: Path = FOLDER / "summary.json") -> dict[str, Any]:
    """The numbers in the file."""
    numbers: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return numbers


def recovered(signals: Found) -> Figure:
    """The estimate on q1 over time since the touchdown, a panel for each log; in grey the torque that acted."""
    with style():
        figure = new_figure(8.0, 5.6)
        panels = figure.subplots(2, 2, sharex=True, sharey=True)
        for axes, (name, by_observer) in zip(panels.flat, signals.items(), strict=True):
            _draw(axes, by_observer)
            label(axes, "", "", name)
        for axes in panels[1]:
            axes.set_xlabel("time since touchdown [ms]")
        for axes in panels[:, 0]:
            axes.set_ylabel(r"$\hat\zeta_1$ [N m]")
        panels[0, 0].set_ylim(-30.0, 50.0)
        lines = panels[0, 0].get_legend_handles_labels()
        figure.legend(*lines, loc="outside lower center", ncols=3)
        return figure


def _draw(axes: Axes, by_observer: Mapping[str, ReplaySignals]) -> None:
    """The lines of one panel."""
    x = by_observer[SHOWN[0]]
    rows = x.step == STEP
    axes.plot(1e3 * x.t_step[rows], truth(x)[rows, 0], color=GREY, lw=2.4, alpha=0.6, label="acted")
    for k, o in enumerate(SHOWN):
        y = by_observer[o].zeta_estimate[rows, 0]
        axes.plot(1e3 * x.t_step[rows], y, color=PALETTE[k], ls=DASHES[k], lw=1.1, label=o)


def main() -> None:
    """Walk, replay, draw, write."""
    signals = found()
    figure, numbers = recovered(signals), summary(signals)
    write_bytes(FOLDER / "recovered.svg", render(figure, "svg"))
    write_text(FOLDER / "recovered.json", as_text(numbers_of(figure)))
    write_text(FOLDER / "summary.json", json.dumps(numbers, indent=1) + "\n")
    write_text(GUIDE, put(GUIDE.read_text(encoding="utf-8"), part(numbers), (BEGIN, END)))


if __name__ == "__main__":
    main()
