"""The comparison of controllers as a command: walked, stored run by run, and written as figures, page, summary.

`bench.comparison` decides what is walked and what follows from it; this module provides how: `Stored` walks
trials through the same store as a sweep, so that a comparison that is killed goes on where it was. Rows are
looked up by the hash of the trial's record.

Written to the folder `out`: comparison.sqlite (all runs), comparison.html, summary.json, one SVG per figure.
Called by the command `compare`; the pages come from `viz.pages`.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from biped_adrc.bench.build import engines_of, scene_of
from biped_adrc.bench.cell import IMPULSE, number
from biped_adrc.bench.comparison import Comparison, check, compare, nominal_trial
from biped_adrc.bench.conditions import BASE, CONDITIONS, conditions_on
from biped_adrc.bench.parameters import trial
from biped_adrc.bench.run import run_trials
from biped_adrc.bench.settings import TUNED, Settings
from biped_adrc.campaign.chunk import Point, Record, Row, key_of, text_of
from biped_adrc.campaign.execute import LARGEST_CHUNK, Progress, run_study
from biped_adrc.campaign.store import About, Store, open_store
from biped_adrc.campaign.workers import Crew, Workers, workers_of
from biped_adrc.files import check_folder, plain, write_text
from biped_adrc.robots.limits import Limits
from biped_adrc.scenario.build import RIGID
from biped_adrc.scenario.registry import find, is_own, source_hash
from biped_adrc.versions import numerical_versions
from biped_adrc.viz.comparison_text import NEEDS, REASONS
from biped_adrc.viz.pages import captions, comparison_html
from biped_adrc.viz.plots.comparison_figure import feasible_figure, measure_figure
from biped_adrc.viz.style import render

RESULTS = "comparison.sqlite"
"""Name of the file with all runs, in the folder of the comparison."""
TITLES = {
    "rms_error": "rms tracking error [rad]",
    "peak_error": "largest tracking error [rad]",
    "rms_torque": "torque, root mean square [N m]",
    "cost_of_transport": "cost of transport",
}
"""Measures that have a figure of their own, with the text of its axis."""


@dataclass
class Stored:
    """A function from trials to rows, which walks what the store does not have yet and takes the
    rest from it.
    """

    store: Store
    """The open file of results."""
    crew: Crew
    """Who walks; they stay from one call to the next."""
    progress: Callable[[Progress], None] | None
    """Called now and then; None for nobody."""
    shared: Record = field(default_factory=dict)
    """Values that all trials get besides."""
    walks: int = 0
    """Trials asked for so far, walked now or found in the store."""

    def __call__(self, records: Sequence[Record]) -> list[Row]:
        """The row of each trial, in order."""
        points = [_point({**self.shared, **record}) for record in records]
        keys = [key_of(text_of(point.record)) for point in points]
        run_study(
            run_trials,
            points,
            self.store,
            self.crew,
            chunk=max(1, min(LARGEST_CHUNK, len(points) // 16)),
            total=len(points),
            progress=self.progress,
            first=self.walks,
        )
        self.walks += len(points)
        rows = self.store.rows(keys)
        return [rows[key] for key in keys]


def _point(record: Record) -> Point:
    """The record of a trial, and the values by which a reader finds it in the file."""
    told = ("controller", "order", "seed", "push", "on", "onset", "amplitude")
    return Point(trial(record).record(), {k: record[k] for k in told if k in record})


def run_comparison(
    out: Path,
    command: str,
    controllers: Sequence[str] | None = None,
    conditions: Sequence[str] | None = None,
    seeds: int = 20,
    workers: Workers | Executor | int | None = None,
    progress: Callable[[Progress], None] | None = None,
    plant: str = RIGID,
    settings: Settings = TUNED,
) -> dict[str, Any]:
    """Walk everything that is not in `out` yet and write figures, page and summary; returns the summary.

    command: as typed, for the page. controllers, conditions: all of the settings where None. seeds: per
    controller and condition. plant: of the registry, on which all walk; "wrong impact"
    is a condition of the rigid one alone. Raises InputError for unknown names or a file of another comparison,
    OutputError.
    """
    controllers = list(settings.contestants if controllers is None else controllers)
    every = conditions_on(plant, settings.alike)
    conditions = list(every if conditions is None else conditions)
    check(controllers, conditions, seeds, settings)
    shared = {} if plant == RIGID else {"ground.plant": plant}
    asked = {
        "settings": settings.name,
        "controllers": controllers,
        "conditions": {name: dict(CONDITIONS[name].values) for name in conditions},
        "base": {**BASE, **settings.values, **shared},
        "seeds": seeds,
    }
    about = About(
        "comparison", key_of(text_of(asked)), asked, _versions(settings, controllers, plant)
    )
    check_folder(out)
    with (
        Crew(workers_of(workers)) as crew,
        open_store(out / RESULTS, about) as store,
    ):
        carry = Stored(store, crew, progress, shared)
        found = compare(carry, controllers, conditions, seeds, settings)
    return write(found, out, command, carry.walks, shared)


def _versions(settings: Settings, contestants: Sequence[str], plant: str) -> dict[str, str]:
    """All that decides the numbers, the classes of the user and the plant's engine included."""
    own = dict.fromkeys(x for x in map(settings.controller, contestants) if is_own(x))
    sources = {f"source {x}": source_hash(find("controller", x).load()) for x in own}
    return {**numerical_versions(), **sources, **engines_of((plant,))}


def write(
    found: Comparison, out: Path, command: str, walks: int, shared: Record | None = None
) -> dict[str, Any]:
    """Draw and write what was found to `out`; returns what summary.json holds. Raises OutputError.

    walks: how many trials it took, for the page. shared: values of all trials besides `BASE`.
    """
    settings = found.settings
    summary = {
        "command": command,
        "walks": walks,
        "seeds": found.seeds,
        "set": plain(settings),
        "settings": settings.said(found.controllers, found.conditions),
        "nominal": nominal(found.nominal, settings),
        "controllers": {name: settings.described(name) for name in found.controllers},
        "conditions": {name: CONDITIONS[name].words for name in found.conditions},
        "places": {name: CONDITIONS[name].place for name in found.conditions},
        "cells": [cell.row() for cell in found.cells],
        "base": {**BASE, **settings.values, **(shared or {})},
        "versions": dict(numerical_versions()),
    }
    texts = {name: svg.decode("utf-8") for name, svg in draw(summary).items()}
    for name, svg in texts.items():
        write_text(out / f"{name}.svg", svg)
    write_text(out / "comparison.html", comparison_html(summary, texts))
    write_text(out / "summary.json", json.dumps(summary, indent=1) + "\n")
    return summary


def nominal(row: Row, settings: Settings = TUNED) -> dict[str, object]:
    """What the gait itself needs of ground and motors, undisturbed, beside the robot's limits, in plain values.

    `broken`: which limits it breaks, in words. A gait that is not feasible by itself makes no walk feasible.
    """
    needs = {name: number(row, name) for name in NEEDS}
    reasons = {**REASONS, IMPULSE: "impulse at impact"}
    broken = [words for name, words in reasons.items() if row.get(name) == 1]
    return {
        "trial": dict(nominal_trial(settings)),
        "status": str(row["status"]),
        "outcome": row["outcome"],
        "needs": needs,
        "limits": dict(
            Limits().of(scene_of(trial(nominal_trial(settings))).biped.description)._asdict()
        ),
        "broken": broken,
    }


def draw(summary: Mapping[str, Any]) -> dict[str, bytes]:
    """The figures as SVG, by name."""
    return {name: render(figure, "svg") for name, figure in figures(summary).items()}


def figures(summary: Mapping[str, Any]) -> dict[str, Figure]:
    """The figures by name, in the order of the page; drawn from the summary alone, which a reader has too."""
    cells = summary["cells"]
    drawn = {"feasible": feasible_figure(cells)}
    drawn |= {name: measure_figure(cells, name, title) for name, title in TITLES.items()}
    return {name: drawn[name] for name in captions("comparison")}
