"""Options of commands against the argument that they become: in process, nothing is computed.

A row of `COMMANDS` has the words on the command line, the function that has to get them, where in its
arguments they have to be, and the value. The same place has to hold another value without the words.
`received(words, place)` are the arguments with which the command line calls that function.
"""

from __future__ import annotations

import importlib
import shlex
from collections.abc import Callable
from inspect import signature
from operator import attrgetter
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple
from unittest.mock import patch

import pytest
import typer.main

from biped_adrc.cli import app

TOP = typer.main.get_command(app)


class Reached(BaseException):
    """Ends a command where the function that is looked at has been called; no command catches it."""


def received(words: list[str], place: str) -> SimpleNamespace:
    """The arguments, by name, with which a command line calls the function "module:name" below biped_adrc."""
    module, _, name = place.partition(":")
    owner = importlib.import_module(f"biped_adrc.{module}")
    of = signature(getattr(owner, name))
    with patch.object(owner, name, side_effect=Reached) as spy, pytest.raises(Reached):
        TOP.main(words, standalone_mode=False)
    bound = of.bind(*spy.call_args.args, **spy.call_args.kwargs)
    bound.apply_defaults()
    return SimpleNamespace(**bound.arguments)


class Row(NamedTuple):
    """words: of the option. of: where its value has to be. value: what it has to be there."""

    words: str
    of: Callable[[Any], object]
    value: object


class Command(NamedTuple):
    """A command with its usual words, the function that it calls, and a row for each option."""

    words: str
    at: str
    rows: dict[str, Row]


ROBOT_ROWS = {
    "robot": Row("--robot compass", attrgetter("biped.description.name"), "compass"),
    "preset": Row("--preset tac2003", attrgetter("biped.preset"), "tac2003"),
}
SIMULATE = {
    "scenario": Row("--scenario best.toml", attrgetter("s.controller.K_d"), 33.0),
    "controller": Row("--controller npd", attrgetter("s.controller.name"), "NPD"),
    "gait": Row("--gait recipe", attrgetter("s.gait.name"), "recipe"),
    "impacts": Row("--impacts 5", attrgetter("s.run.impacts"), 5),
    "period": Row("--period '2 ms'", attrgetter("s.hardware.period"), 0.002),
    "torque_limit": Row("--torque-limit 80Nm", attrgetter("s.hardware.torque_limit"), 80.0),
    "plant": Row("--plant mujoco", attrgetter("s.ground.plant"), "mujoco"),
    "engine": Row("--engine pinocchio", attrgetter("s.run.engine"), "pinocchio"),
    "push": Row(
        "--push q1=5@3:0.1-0.2",
        lambda a: [p.in_words() for p in a.s.pushes],
        ["5 N m on q1 from 0.1 to 0.2 s in single support 3"],
    ),
    "sets": Row("--set 'run.max_step_time=900 ms'", attrgetter("s.run.max_step_time"), 0.9),
    "a record's name": Row("--set hardware=rabbit", attrgetter("s.hardware.profile"), "rabbit"),
    "poles": Row(
        "--set controller.observer.poles=-1,-2,-3",
        attrgetter("s.controller.observer.poles"),
        (-1.0, -2.0, -3.0),
    ),
    "limits": Row("--set limits.friction=0.4", attrgetter("limits.friction"), 0.4),
    "own": Row("--set controller.own=[1,2]", attrgetter("s.controller.own"), {"own": (1, 2)}),
    "end_infeasible": Row("--end-infeasible", attrgetter("end_infeasible"), True),
    "out": Row("-o own.csv", attrgetter("out"), Path("own.csv")),
    "log": Row("--period 0.002 --log own", attrgetter("log"), Path("own.csv")),
}
POINCARE = {
    "slope": Row("--set ground.slope=0.03", attrgetter("s.ground.slope"), 0.03),
    "observer_states": Row("--no-observer-states", attrgetter("observer_states"), False),
}  # fmt: skip
DESIGN = {
    "speed": Row("--speed 0.75", attrgetter("request.speed"), 0.75),
    "curve": Row("--speed 0.5 --set curve=bspline", attrgetter("request.curve"), "bspline"),
    "torque": Row("--speed 0.5 --set limits.torque=77", attrgetter("request.limits.torque"), 77.0),
}


def poles_of(a: Any) -> list[int]:
    """Real parts of the observer's poles [rad/s], in order."""
    return sorted(round(pole.real) for pole in a.observer.poles)


OBSERVER = {
    "bandwidth": Row("--bandwidth 99", poles_of, [-99] * 3),
    "order": Row("--bandwidth 99 --order 3", lambda a: len(a.observer.poles), 5),
    "known": Row("--set hardware.delay_known=true", attrgetter("known"), True),
}  # fmt: skip
STUDY_FILE = """
name = "own"
[grid]
controller.observer.bandwidth = [100, 200]
hardware.period = [0.001, 0.002]
"""
IMPORT = {
    **ROBOT_ROWS,
    "file": Row("", attrgetter("gait"), Path("own.mat")),
    "name": Row("--name coefficients=R.alpha", attrgetter("names"), {"coefficients": "R.alpha"}),
    "slopes": Row("--no-slopes", attrgetter("slopes"), False),
}
ZERO = {
    "friction": Row("--set friction=0.44", attrgetter("limits.friction"), 0.44),
    "slope": Row("--set slope=0.04", attrgetter("limits.slope"), 0.04),
}  # fmt: skip


STUDY = {
    "workers": Row("--workers 3", attrgetter("workers"), 3),
}
COMMANDS = {
    "simulate": Command("simulate", "cli.walk:_walk", SIMULATE),
    "poincare": Command("poincare", "scenario.cycle:cycle_of", POINCARE),
    "gait design": Command("gait design --step 0.4", "gait.design.optimise:optimise", DESIGN),
    "gait import": Command("gait import own.mat", "gait.exchange.importing:import_gait", IMPORT),
    "gait show": Command("gait show published", "analysis.zero_report:zero_report", ZERO),
    "observer": Command("observer", "analysis.observer.report:observer_report", OBSERVER),
    "study": Command("study own.toml -o folder", "studies.carry:study", STUDY),
}
ROWS = [(name, option) for name, command in COMMANDS.items() for option in command.rows]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with a study and a scenario."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "own.toml").write_text(STUDY_FILE)
    (tmp_path / "best.toml").write_text("controller.K_d = 33.0\n")
    return tmp_path


@pytest.mark.parametrize(("name", "option"), ROWS)
def test_an_option_on_the_command_line_arrives_as_its_argument(name, option, folder):
    """With the option's words the function gets the row's value, and without them another one.

    The second half keeps the row from passing when the option does nothing.
    """
    command = COMMANDS[name]
    row, words = command.rows[option], command.words.split()
    with_option = received([*words, *shlex.split(row.words)], command.at)
    assert row.of(with_option) == row.value
    if row.words:
        without = received(words, command.at)
        assert row.of(without) != row.value, "the value is the default: give the row another one"
