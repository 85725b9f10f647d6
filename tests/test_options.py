"""Every option of every command against the argument that it becomes: in process, nothing is computed.

A row of `OPTIONS` has the words on the command line, the function that has to get them, where in its arguments
they have to be, and the value. The same place has to hold another value without the words.
"""

from __future__ import annotations

import importlib
import math
from collections.abc import Callable
from functools import reduce
from inspect import signature
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import typer.main

import biped_adrc as ba
from biped_adrc.cli import app
from biped_adrc.cli.observer import _confirm, _print_walks
from biped_adrc.cli.sweep import _print_statuses
from biped_adrc.control.tracking import TABLE_II
from biped_adrc.hybrid.status import Status
from biped_adrc.observers.gpi import TABLE_I, GPIObserver
from biped_adrc.resources import data_folder
from biped_adrc.studies.observer_check import CheckedWalk, DelayCheck

TOP = typer.main.get_command(app)


class Reached(BaseException):
    """Ends a command where the function that is looked at has been called; no command catches it."""


class Anything:
    """Stands for what a function would have made: every attribute, call and item is such a thing again."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return Anything()

    def __call__(self, *_: object, **__: object) -> Anything:
        return Anything()

    def __iter__(self) -> Any:
        return iter(())

    def __str__(self) -> str:
        return "anything"

    def __fspath__(self) -> str:
        return "anything.json"

    def save(self, path: Path) -> None:
        """As a gait is saved."""


SAVE = "a gait that was made is saved"
RETURNS = {"scenario.stored:load_walks": {"walk": Anything()}}
"""What stubs give that do not give just anything."""


def owner_of(place: str) -> tuple[Any, str]:
    """The module or class, and the name in it, of "module:name" below biped_adrc."""
    if place == SAVE:
        return Anything, "save"
    module, _, path = place.partition(":")
    *inner, name = path.split(".")
    return reduce(getattr, inner, importlib.import_module(f"biped_adrc.{module}")), name


def received(words: list[str], place: str, stubs: tuple[str, ...]) -> SimpleNamespace:
    """The arguments, by name, with which a command line calls the function at `place`."""
    found: dict[str, Any] = {}
    with pytest.MonkeyPatch.context() as patch:
        for stub in stubs:
            returned = RETURNS.get(stub, Anything())
            patch.setattr(*owner_of(stub), lambda *_, value=returned, **__: value)
        owner, name = owner_of(place)
        of = signature(getattr(owner, name))

        def spy(*arguments: object, **named: object) -> None:
            bound = of.bind(*arguments, **named)
            bound.apply_defaults()
            found.update(bound.arguments)
            raise Reached

        patch.setattr(owner, name, spy)
        with pytest.raises(Reached):
            TOP.main(words, standalone_mode=False)
    return SimpleNamespace(**found)


class Row:
    """words: of the option. of: where its value has to be. value: what it has to be there."""

    def __init__(
        self, words: str | list[str], of: Callable[[Any], object], value: object, at: str = ""
    ) -> None:
        self.words = words.split() if isinstance(words, str) else words
        self.of, self.value, self.at = of, value, at


class Command:
    """A command with its usual words, the function that it calls, stubs, and a row for each parameter.

    others: for places other than `at`, the words and stubs that lead there.
    """

    def __init__(
        self,
        words: str,
        at: str,
        rows: dict[str, Row],
        stubs: str = "",
        others: dict[str, tuple[str, str]] | None = None,
    ) -> None:
        self.at, self.rows = at, rows
        self.words, self.stubs = words.split(), tuple(stubs.split())
        self.others = {k: (a.split(), tuple(b.split())) for k, (a, b) in (others or {}).items()}


def scenario_field(name: str) -> Callable[[Any], object]:
    return lambda a: getattr(a.s, name)


def same(name: str) -> Callable[[Any], object]:
    return lambda a: reduce(getattr, name.split("."), a)


OUT_GAIT = Row("-o own.json", same("out"), Path("own.json"), "cli.gait:_save")
ROBOT_ROWS = {
    "robot": Row("--robot compass", lambda a: a.biped.description.name, "compass"),
    "preset": Row("--preset tac2003", same("biped.preset"), "tac2003"),
}
HINTS = {
    "file": Row("", same("path"), Path("own.urdf")),
    "feet": Row("--feet a,b", same("hints.feet"), ("a", "b")),
    "actuated": Row("--actuated c,d", same("hints.actuated"), ("c", "d")),
    "hip": Row("--hip e", same("hints.hip"), "e"),
    "torque": Row("--torque 33", same("hints.torque"), 33.0),
    "friction": Row("--friction 0.33", same("hints.friction_coefficient"), 0.33),
    "armature": Row("--armature 0.25", same("hints.armature"), 0.25),
    "gravity": Row("--gravity 1.62", same("hints.gravity"), 1.62),
    "tip": Row("--tip 0,0,0.5", same("hints.tip"), (0.0, 0.0, 0.5)),
}
SIMULATE = {
    "scenario": Row("--scenario best.toml", scenario_field("K_d"), 33.0),
    "controller": Row("--controller npd", scenario_field("controller"), "NPD"),
    "gait": Row("--gait recipe", scenario_field("gait"), "recipe"),
    "robot": Row("--robot compass", scenario_field("robot"), "compass"),
    "preset": Row("--preset tac2003", scenario_field("preset"), "tac2003"),
    "impacts": Row("--impacts 7", scenario_field("impacts"), 7),
    "seed": Row("--seed 5", scenario_field("seed"), 5),
    "hardware": Row("--hardware rabbit", scenario_field("hardware"), "rabbit"),
    "period": Row("--period 0.002", scenario_field("period"), 0.002),
    "torque_limit": Row("--torque-limit 80", scenario_field("torque_limit"), 80.0),
    "K_p": Row("--K-p 900", scenario_field("K_p"), 900.0),
    "K_d": Row("--K-d 33", scenario_field("K_d"), 33.0),
    "observer": Row(
        "--observer high-gain --bandwidth 300", scenario_field("observer"), "high gain"
    ),
    "poles": Row("--poles=-1,-2,-3", scenario_field("poles"), (-1.0, -2.0, -3.0)),
    "bandwidth": Row("--bandwidth 333", scenario_field("bandwidth"), 333.0),
    "order": Row("--bandwidth 333 --order 2", scenario_field("order"), 2),
    "reset": Row("--reset measured", scenario_field("reset"), "measured"),
    "friction": Row("--friction", scenario_field("friction"), True),
    "slope": Row("--slope 0.02", scenario_field("slope"), 0.02),
    "plant": Row("--plant mujoco", scenario_field("plant"), "mujoco"),
    "ground_friction": Row(
        "--plant mujoco --ground-friction 0.7", scenario_field("ground_friction"), 0.7
    ),
    "time_constant": Row(
        "--plant mujoco --time-constant 0.004", scenario_field("time_constant"), 0.004
    ),
    "method": Row("--method stiff", scenario_field("method"), "stiff"),
    "engine": Row("--engine pinocchio", scenario_field("engine"), "pinocchio"),
    "friction_limit": Row("--friction-limit 0.4", same("limits.friction"), 0.4),
    "force_window": Row("--force-window 0.01", same("limits.window"), 0.01),
    "h": Row("--step 0.0003", scenario_field("h"), 0.0003),
    "push": Row(
        "--push q1=5@3:0.1-0.2", lambda a: [p.text() for p in a.s.pushes], ["q1=5@3:0.1-0.2"]
    ),
    "sets": Row(["--set", "max_step_time=900 ms"], scenario_field("max_step_time"), 0.9),
    "as_printed": Row("--as-printed", scenario_field("solve_theta"), False),
    "end_illegal": Row("--end-illegal", same("end_illegal"), True),
    "out": Row("-o own.csv", same("out"), Path("own.csv")),
    "log": Row("--period 0.002 --log own", same("log"), Path("own.csv")),
}
REPLAY = {
    **{
        name: Row(
            SIMULATE[name].words,
            lambda a, name=name: getattr(a.scenario, name),
            SIMULATE[name].value,
        )
        for name in (
            *("controller", "gait", "robot", "preset", "period", "torque_limit", "K_p"),
            *("K_d", "observer", "poles", "bandwidth", "order", "reset"),
        )
    },
    "scenario": Row("--scenario best.toml", same("scenario.K_d"), 33.0),
    "log": Row("", same("log"), Path("own.csv")),
    "sets": Row("--set K_p=900", same("scenario.K_p"), 900.0),
    "window": Row("--window 0.03", same("window"), 0.03),
    "filter_time": Row("--filter-time 0.004", same("filter_time"), 0.004),
    "out": Row("-o there", same("path"), Path("there/replay.svg"), "viz.style:write_figure"),
}
POINCARE = {
    "scenario": Row("--scenario best.toml", scenario_field("K_d"), 33.0),
    "robot": Row("--robot compass", scenario_field("robot"), "compass"),
    "preset": Row("--preset tac2003", scenario_field("preset"), "tac2003"),
    "gait": Row("--gait recipe", scenario_field("gait"), "recipe"),
    "controller": Row("--controller adrc", scenario_field("controller"), "ADRC"),
    "slope": Row("--slope 0.03", same("slope"), 0.03),
    "sets": Row("--set K_p=900", scenario_field("K_p"), 900.0),
    "observer_states": Row("--no-observer-states", same("observer_states"), False),
    "samples": Row(
        "--samples 7", same("samples"), 7, "studies.cycle_stability:cycle_stability"
    ),
}  # fmt: skip
STATE = ",".join(str(0.1 * k) for k in range(10))
DESIGN = {
    "speed": Row("--speed 0.75", same("speed"), 0.75),
    "step": Row("--step 0.45", same("step"), 0.45),
    "through": Row(
        f"--through {STATE}",
        lambda a: a.through and ",".join(f"{x:.1f}" for part in a.through for x in part),
        ",".join(f"{0.1 * k:.1f}" for k in range(10)),
    ),
    "robot": Row("--robot three_link", lambda a: a.robot.description.name, "three_link"),
    "preset": Row("--preset tac2003", same("robot.preset"), "tac2003"),
    "slope": Row("--slope 0.04", same("slope"), 0.04),
    "minimise": Row("--minimise peak", same("objective"), "peak"),
    "curve": Row("--curve bspline", same("curve"), "bspline"),
    "degree": Row("--degree 8", same("degree"), 8),
    "nodes": Row("--nodes 30", same("nodes"), 30),
    "torque": Row("--torque 77", same("limits.torque"), 77.0),
    "friction": Row("--friction 0.44", same("limits.friction"), 0.44),
    "impulse_friction": Row("--impulse-friction 0.55", same("limits.impulse_friction"), 0.55),
    "clearance": Row("--clearance 0.03", same("limits.clearance"), 0.03),
    "out": Row("-o own.json", same("path"), Path("own.json"), SAVE),
}
LIBRARY = {
    "speeds": Row("--speeds 0.5,0.6", same("speed"), 0.5),
    "robot": Row("--robot three_link", lambda a: a.robot.description.name, "three_link"),
    "preset": Row("--preset tac2003", same("robot.preset"), "tac2003"),
    "minimise": Row("--minimise peak", same("objective"), "peak"),
    "out": Row("-o own", lambda a: a.path.parent, Path("own"), SAVE),
}


def poles_of(a: Any) -> list[int]:
    """Real parts of the observer's poles [rad/s], in order."""
    return sorted(round(pole.real) for pole in a.observer.poles)


OBSERVER = {
    "poles": Row("--poles=-4,-5,-6", poles_of, [-6, -5, -4]),
    "bandwidth": Row("--bandwidth 99", poles_of, [-99] * 3),
    "order": Row("--bandwidth 99 --order 3", lambda a: len(a.observer.poles), 5),
    "k_p": Row("--K-p 900", same("gains.K_p"), 900.0),
    "k_d": Row("--K-d 33", same("gains.K_d"), 33.0),
    "period": Row("--period 0.002", same("period"), 0.002),
    "counts": Row("--counts 1000", same("counts"), 1000.0),
    "delay": Row("--delay 0.001", same("delay"), 0.001),
    "known": Row("--known", same("known"), True),
    "robot": Row("--robot three_link", lambda a: a.biped.description.name, "three_link", "gait.gait:load_gait"),
    "preset": Row("--preset tac2003", same("robot.preset"), "tac2003"),
    "gait": Row("--gait v0.8", same("gait.name"), "v0.8"),
    "confirm": Row(
        "--confirm --known --delay 0.001 --counts 99 --period 0.002",
        same("clock"), (0.002, 99.0, 0.001, True), "cli.observer:_confirm",
    ),
    "out": Row("-o own.png", same("path"), Path("own.png"), "viz.style:write_figure"),
}  # fmt: skip
REPRODUCE = {
    "out": Row("--out own", same("out"), Path("own")),
    "preset": Row("--preset tac2003", same("plan.preset"), "tac2003"),
    "push": Row(
        "--push q1=5@3:0.1-0.2", lambda a: [p.text() for p in a.plan.pushes], ["q1=5@3:0.1-0.2"]
    ),
    "full": Row("--full", same("plan.full"), True),
    "quick": Row("--quick", same("plan.quick"), True),
    "workers": Row("--workers 3", same("workers"), 3),
}
CREW = {
    "workers": Row("--workers 3", same("workers.number"), 3),
    "threads": Row("--threads", lambda a: type(a.workers).__name__, "Threads"),
    "scheduler": Row(
        "--scheduler tcp://x:1", lambda a: getattr(a.workers, "address", None), "tcp://x:1"
    ),
    "other_versions": Row("--other-versions", same("other_versions"), True),
}
BENCH = "bench.benchmark_run:run_benchmark"
COMPARE = {
    **CREW,
    "controller": Row("", same("controller"), "my:Mine", BENCH),
    "bench": Row("", same("name"), "walkbench-1", BENCH),
    "out": Row("-o own", same("out"), Path("own")),
    "controllers": Row("--controllers NPD,PD", same("controllers"), ("NPD", "PD")),
    "conditions": Row("--conditions nothing", same("conditions"), ("nothing",)),
    "seeds": Row("--seeds 4", same("seeds"), 4),
    "pushes": Row("--no-pushes", same("pushes"), False),
    "plant": Row("--plant mujoco", same("plant"), "mujoco"),
    "settings": Row("--settings as-published", same("settings.name"), "as-published"),
}
BENCHED = {BENCH: ("compare --bench walkbench-1 my:Mine", "")}
SWEEP_FILE = """
[study]
name = "own"
[grid]
bandwidth = [100, 200]
period = [0.001, 0.002]
"""
TUNED_FILE = """
study = { name = "own", budget = 4, generation = 2, seed = 0 }
variables = { bandwidth = { from = 100, to = 200 } }
objectives = [{ column = "rms_error" }]
training = { seeds = [0] }
selection = { seeds = [1] }
test = { seeds = [2] }
"""
TUNE = {
    **CREW,
    "study": Row("", same("study.name"), "own"),
    "out": Row("", same("out"), Path("folder")),
    "dry_run": Row("--dry-run", same("study.name"), "own", "tuning.tune:rehearse"),
}
TO_C = {
    "scenario": Row("", same("scenario.K_d"), 33.0),
    "out": Row("", same("folder"), Path("folder")),
    "sets": Row("--set K_p=3", same("scenario.K_p"), 3.0),
    "prefix": Row("--prefix leg", same("prefix"), "leg"),
    "real": Row("--real float32", same("real"), "float32"),
    "fmu": Row("--fmu", same("fmu"), True),
}
LOOP = {
    "scenario": Row("", same("scenario.K_d"), 33.0),
    "plant": Row("--plant mujoco", same("scenario.plant"), "mujoco"),
    "impacts": Row("--impacts 3", same("scenario.impacts"), 3),
    "sets": Row("--set K_p=3", same("scenario.K_p"), 3.0),
    "real_time": Row("--real-time", same("real_time"), True),
    "deadline": Row("--deadline 0.0002", same("deadline"), 2e-4),
    "real": Row("--real float32", same("real"), "float32"),
    "port": Row("--port 5005", same("port"), 5005),
}
SWEEP = {
    **CREW,
    "study": Row("", same("study.name"), "own"),
    "out": Row("", same("out"), Path("folder")),
    "export": Row("--export csv", same("path"), Path("folder/results.csv"), "bench.export:export"),
    "plot": Row(
        "--plot bandwidth,period:rms_error",
        lambda a: (a.maps.x, a.maps.y, a.maps.value),
        ("bandwidth", "period", "rms_error"),
        "bench.export:write_map",
    ),
    "dry_run": Row("--dry-run", same("study.name"), "own", "bench.study:rehearse"),
    "no_run": Row("--no-run", same("out"), Path("folder"), "bench.sweep:load_sweep"),
}
ANIMATE = {
    "run": Row("", same("paths"), [Path("run.npz")], "scenario.stored:load_walks"),
    "ghost": Row(
        "--ghost b.npz",
        same("paths"),
        [Path("run.npz"), Path("b.npz")],
        "scenario.stored:load_walks",
    ),
    "out": Row("-o own.gif", same("path"), Path("own.gif")),
    "view": Row("--view perspective", same("clip.view"), "perspective"),
    "start": Row("--from 0.5", same("clip.start"), 0.5),
    "stop": Row("--to 1.5", same("clip.stop"), 1.5),
    "fps": Row("--fps 30", same("clip.fps"), 30.0),
    "apart": Row("--apart", same("clip.apart"), True),
    "magnify": Row("--magnify 50", same("clip.magnify"), 50.0),
    "slower": Row("--slower 4", same("clip.slower"), 4.0),
}
PLAY = {
    **{
        name: Row(
            SIMULATE[name].words,
            lambda a, name=name: getattr(a.scenario, name),
            SIMULATE[name].value,
        )
        for name in (
            *("controller", "gait", "preset", "seed", "hardware", "period", "torque_limit"),
            *("K_p", "K_d", "observer", "poles", "bandwidth", "order", "reset", "friction"),
            "slope",
        )
    },
    "robot": Row("--robot three_link", same("scenario.robot"), "three_link"),
    "scenario": Row("best.toml", same("scenario.K_d"), 33.0),
    "sets": Row(["--set", "max_step_time=900 ms"], same("scenario.max_step_time"), 0.9),
    "ghost": Row("--ghost npd", lambda a: next(iter(a.others)), "npd"),
    "out": Row("", same("path"), Path("own.html")),
}
PLOT = {
    "run": Row("", same("paths"), [Path("run.npz")], "scenario.stored:load_walks"),
    "beside": Row(
        "--with b.npz",
        same("paths"),
        [Path("run.npz"), Path("b.npz")],
        "scenario.stored:load_walks",
    ),
    "figure": Row("--figure torques", same("name"), "torques"),
    "out": Row("-o own.svg", same("path"), Path("own.svg"), "viz.style:write_figure"),
}
EXPORT = {
    **ROBOT_ROWS,
    "gait": Row("", same("gait.name"), "v0.8"),
    "out": Row("", same("path"), Path("a.mat")),
    "robot": Row("--robot three_link", lambda a: a.biped.description.name, "three_link", "gait.gait:load_gait"),
    "convention": Row("--convention frost", same("convention"), "frost"),
}  # fmt: skip
IMPORT = {
    **ROBOT_ROWS,
    "file": Row("", same("gait"), Path("own.mat")),
    "convention": Row("--convention frost", same("convention"), "frost"),
    "name": Row("--name coefficients=R.alpha", same("names"), {"coefficients": "R.alpha"}),
    "slopes": Row("--no-slopes", same("slopes"), False),
    "degree": Row("--degree 8", same("degree"), 8),
    "slope": Row("--slope 0.04", same("slope"), 0.04),
    "out": OUT_GAIT,
}
ZERO = {
    "gait": Row("v0.8", same("gait"), "v0.8", "gait.gait:load_gait"),
    "robot": Row("--robot three_link", lambda a: a.biped.description.name, "three_link", "gait.gait:load_gait"),
    "preset": Row("--preset tac2003", same("biped.preset"), "tac2003"),
    "friction": Row("--friction 0.44", same("limits.friction"), 0.44),
    "torque": Row("--torque 77", same("limits.torque"), 77.0),
    "slope": Row("--slope 0.04", same("limits.slope"), 0.04),
    "plot": Row("--plot own.png", same("path"), Path("own.png"), "viz.style:write_figure"),
}  # fmt: skip
SHOW = {
    "gait": Row("v0.8", same("gait"), "v0.8"),
    **ROBOT_ROWS,
}
PAPER = {"preset": Row("--preset tac2003", same("biped.preset"), "tac2003"), "out": OUT_GAIT}
DERIVE = "robot_import.import_robot:derive"
DESIGNED = "studies.gait_design:design_gait"
PUBLISHED = "gait.published:design_published_gait"
RECIPE = "studies.gait_design:design_recipe_orbit"
LOAD = "scenario.stored:load_walks"
FIGURE = "viz.plots.observer_figure:observer_figure"
ZERO_FIGURE = "viz.plots.zero_dynamics:zero_dynamics_figure"
REPORT = "observer_design.observer_report:observer_report cli.observer:_print_report"
BESIDE_SWEEP = (
    "bench.export:export",
    "bench.export:write_map",
    "bench.study:rehearse",
    "bench.sweep:load_sweep",
)


def saved(words: str, stub: str) -> dict[str, tuple[str, str]]:
    """The way of a command to the function that saves its gait."""
    return {"cli.gait:_save": (words, stub)}


def ground(name: str) -> Callable[[Any], object]:
    """A value of the ground that the robot stands on."""
    return lambda a: getattr(a.plant.ground, name)


def stiffness(a: Any) -> tuple[float, float]:
    """Time constant of the ground, and the step of the engine, which follows it."""
    return a.plant.ground.time_constant, a.plant.h


MJCF = {
    "robot": Row("", lambda a: a.plant.biped.description.name, "three_link"),
    "mjcf": Row("", same("path"), Path("a.xml")),
    "preset": Row("--preset tac2003", lambda a: a.plant.biped.preset, "tac2003", "soft.mjcf:mjcf"),
    "joint_friction": Row("--joint-friction", lambda a: a.plant.biped.friction, True),
    "friction": Row("--friction 0.3", ground("friction"), 0.3),
    "time_constant": Row("--time-constant 0.001", stiffness, (1e-3, 1e-4)),
    "foot_radius": Row("--foot-radius 0.002", ground("foot_radius"), 2e-3),
    "slope": Row("--slope 0.05", lambda a: a.plant.slope, 0.05),
    "gait": Row("--gait v0.7", lambda a: a.gait and a.gait.name, "v0.7", "soft.mjcf:mjcf"),
}  # fmt: skip
COMMANDS = {
    "simulate": Command("simulate", "cli.walk:_walk", SIMULATE),
    "replay": Command(
        "replay own.csv", "logs.replay:replay", REPLAY,
        others={"viz.style:write_figure": ("replay own.csv", "logs.replay:replay cli.replay:write_text")},
    ),
    "poincare": Command(
        "poincare",
        "studies.cycle_stability:cycle_of",
        POINCARE,
        others={
            "studies.cycle_stability:cycle_stability": ("poincare", "studies.cycle_stability:cycle_of")
        },
    ),
    "gait design": Command("gait design", DESIGNED, DESIGN, others={SAVE: ("gait design", DESIGNED)}),
    "gait library": Command("gait library", DESIGNED, LIBRARY, others={SAVE: ("gait library", DESIGNED)}),
    "gait published": Command("gait published", PUBLISHED, PAPER, others=saved("gait published", PUBLISHED)),
    "gait recipe": Command("gait recipe", RECIPE, PAPER, others=saved("gait recipe", RECIPE)),
    "gait show": Command("gait show", "gait.gait:load_gait", SHOW),
    "gait export": Command("gait export v0.8 -o a.mat", "gait.exchange.importing:export_gait", EXPORT),
    "gait import": Command(
        "gait import own.mat", "gait.exchange.importing:import_gait", IMPORT,
        others={"cli.gait:_save": ("gait import own.mat", "gait.exchange.importing:import_gait")},
    ),
    "gait zero": Command(
        "gait zero", "analysis.zero_report:zero_report", ZERO,
        others={"viz.style:write_figure": ("gait zero", f"analysis.zero_report:zero_report {ZERO_FIGURE}")},
    ),
    "robot check": Command("robot check own.urdf", DERIVE, HINTS),
    "robot new": Command("robot new own.urdf -o folder", DERIVE, HINTS),
    "robot export": Command(
        "robot export three_link --mjcf a.xml", "soft.mjcf:write_mjcf", MJCF,
        others={"soft.mjcf:mjcf": ("robot export rabbit --mjcf a.xml", "")},
    ),
    "robot show": Command("robot show rabbit", "model.biped:Biped.load", {}),
    "observer": Command(
        "observer", "observer_design.observer_report:observer_report", OBSERVER,
        others={
            "cli.observer:_confirm": ("observer", REPORT),
            "viz.style:write_figure": ("observer", f"{REPORT} {FIGURE}"),
        },
    ),
    "reproduce": Command("reproduce", "paper.reproduction:reproduce", REPRODUCE),
    "compare": Command("compare", "bench.compare_study:run_comparison", COMPARE, "", BENCHED),
    "sweep": Command(
        "sweep own.toml -o folder", "bench.sweep:sweep", SWEEP,
        others=dict.fromkeys(BESIDE_SWEEP, ("sweep own.toml -o folder", "bench.sweep:sweep")),
    ),
    "tune": Command(
        "tune tuned.toml -o folder", "tuning.tune:tune", TUNE,
        others={"tuning.tune:rehearse": ("tune tuned.toml -o folder", "tuning.tune:tune")},
    ),
    "export": Command("export best.toml -o folder", "deploy.export:export_c", TO_C),
    "loop": Command("loop best.toml", "deploy.in_the_loop:in_the_loop", LOOP),
    "animate": Command(
        "animate run.npz", "viz.export:export", ANIMATE, LOAD,
        {LOAD: ("animate run.npz", "")},
    ),
    "play": Command("play -o own.html", "live.page:play", PLAY),
    "plot": Command(
        "plot run.npz", "paper.figures:draw", PLOT, LOAD,
        {LOAD: ("plot run.npz", ""), "viz.style:write_figure": ("plot run.npz", f"{LOAD} paper.figures:draw")},
    ),
}  # fmt: skip
ROWS = [(name, option) for name, command in COMMANDS.items() for option in command.rows]


def parameters_of_commands() -> dict[str, dict[str, Any]]:
    """The parameters of every command, by the command's words and by name."""
    found = {}

    def look(group: Any, words: tuple[str, ...]) -> None:
        for name, command in group.commands.items():
            if hasattr(command, "commands"):
                look(command, (*words, name))
            else:
                found[" ".join((*words, name))] = {p.name: p for p in command.params}

    look(TOP, ())
    return found


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with the studies of `sweep` and `tune`, and a file of a scenario."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "own.toml").write_text(SWEEP_FILE)
    (tmp_path / "tuned.toml").write_text(TUNED_FILE)
    (tmp_path / "best.toml").write_text("K_d = 33.0\n")
    return tmp_path


@pytest.mark.parametrize(("name", "option"), ROWS)
def test_an_option_is_the_argument_it_says(name, option, folder):
    command = COMMANDS[name]
    row = command.rows[option]
    at = row.at or command.at
    words, stubs = command.words, command.stubs
    if at in command.others:
        words, stubs = command.others[at]
    assert row.of(received([*words, *row.words], at, stubs)) == row.value
    if row.words:
        try:
            without = row.of(received(words, at, stubs))
        except pytest.fail.Exception:  # without the option this function is not called
            return
        assert without != row.value, "the row cannot fail"


APART = {"robot show": {"robot", "preset"}, "robot new": {"out"}}
"""Parameters that tests of their own look at, below."""


def test_every_option_of_every_command_has_a_row():
    found = parameters_of_commands()
    told = {name: set(command.rows) | APART.get(name, set()) for name, command in COMMANDS.items()}
    assert {**told, "robot list": set()} == {name: set(p) for name, p in found.items()}
    for name, option in ROWS:
        words, p = COMMANDS[name].rows[option].words, found[name][option]
        flags = {*p.opts, *p.secondary_opts}
        if words and p.param_type_name == "option":
            assert flags & {word.partition("=")[0] for word in words}, (name, option)


def test_a_robot_is_shown_in_the_preset_that_is_named(capsys):
    TOP.main(["robot", "show", "rabbit", "--preset", "tac2003"], standalone_mode=False)
    assert "rabbit, preset tac2003" in capsys.readouterr().out


def test_a_robot_is_written_where_it_is_asked_for(folder, monkeypatch):
    written = []
    made = SimpleNamespace(broken=(), write=written.append)
    monkeypatch.setattr(*owner_of(DERIVE), lambda *_: made)
    monkeypatch.setattr(*owner_of("cli.robot:_explain"), lambda *_: None)
    TOP.main(["robot", "new", "own.urdf", "-o", "there"], standalone_mode=False)
    assert written == [Path("there")]


def test_walks_that_confirm_have_the_clock_that_was_asked_for(monkeypatch):
    called = []
    for place in ("cli.observer:_print_walks", "studies.observer_check:check_delay"):
        monkeypatch.setattr(*owner_of(place), lambda *_: None)
    monkeypatch.setattr(
        *owner_of("studies.observer_check:check_encoders"), lambda *_, **named: called.append(named)
    )
    biped = ba.Biped.load("rabbit")
    gait = ba.load_gait("published", biped)
    _confirm(biped, gait, GPIObserver.from_poles(TABLE_I), TABLE_II, (0.002, 99.0, 0.001, True))
    shared = {"period": 0.002, "delay": 0.001, "known": True}
    assert called == [{**shared, "counts": None}, {**shared, "counts": 99.0}]


def test_a_benchmark_gets_what_is_not_frozen():
    line = "compare my:Mine --bench walkbench-1 -o own --settings mine.toml --seeds 3 --threads"
    found = received(line.split(), BENCH, ())
    assert (found.out, found.settings, found.seeds) == (Path("own"), Path("mine.toml"), 3)
    assert type(found.workers).__name__ == "Threads"


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("compare --bench walkbench-1", "needs the controller"),
        ("compare my:Mine", "goes with --bench; without it give --controllers my:Mine"),
        ("compare my:Mine --bench walkbench-1 --no-pushes --plant mujoco", "--no-pushes, --plant"),
        ("compare my:Mine --bench walkbench-1 --controllers NPD", "leave out --controllers"),
        ("compare my:Mine --bench walkbench-1 --conditions delay", "leave out --conditions"),
    ],
)
def test_a_benchmark_has_its_own_conditions_and_controllers(line, message):
    with pytest.raises(ba.BipedError, match=message):
        TOP.main(line.split(), standalone_mode=False)


def test_a_gait_without_a_name_has_its_own(folder):
    found = received(["gait", "design"], SAVE, (DESIGNED,))
    assert found.path == Path("anything.json")


def test_a_gait_of_another_preset_is_said_to_be(capsys):
    for preset, said in (("identified", False), ("tac2003", True), ("identified-bare", True)):
        path = str(data_folder("gaits") / "rabbit" / "v0.8-identified.json")
        TOP.main(["gait", "show", path, "--preset", preset], standalone_mode=False)
        assert ("below with rabbit" in capsys.readouterr().out) is said


def test_maps_have_a_panel_for_the_third_name(folder):
    text = SWEEP_FILE + 'controller = ["ADRC", "ADRC output"]\n'
    (folder / "own.toml").write_text(text)
    for words, panel in (("bandwidth,period", None), ("bandwidth,period,controller", "controller")):
        line = ["sweep", "own.toml", "-o", "folder", "--plot", words]
        found = received(line, "bench.export:write_map", ("bench.sweep:sweep",))
        assert (found.maps.x, found.maps.y, found.maps.panel) == ("bandwidth", "period", panel)


def test_why_there_was_no_walk_is_printed(folder, capsys):
    done = SimpleNamespace(
        path="here", statuses=lambda: {"REFUSED": 2}, no_walks=lambda: {"REFUSED": "no gait"}
    )
    _print_statuses(done)
    assert capsys.readouterr().out.splitlines() == [
        "here: 2 REFUSED",
        "one that is REFUSED: no gait",
    ]


def test_margins_are_printed_in_microseconds_and_per_cent(capsys):
    walked = CheckedWalk("o", "c", Status.COMPLETED, np.ones(4))
    fell = CheckedWalk("o", "c", Status.FELL, np.ones(4))
    check = DelayCheck("o", True, 2e-4, walked, fell, 2.1e-4, 3e-9, fell)
    _print_walks([check], [])
    told = capsys.readouterr().out
    assert "delay known: linear margin 200 us, confirmed; the robot's own 210 us (+5 %)" in told
    _print_walks([check._replace(known=False, above=walked, robot_margin=math.nan)], [])
    told = capsys.readouterr().out
    assert "delay hidden: linear margin 200 us, NOT confirmed; the robot's own far from it" in told
