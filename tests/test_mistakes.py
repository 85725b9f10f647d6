"""Mistakes that users make: each is one sentence that names it, with the exit code of its kind.

`PYTHON` has calls by mistake, each with words of its sentence; `COMMANDS` has command lines. Exit codes: 2
for an unknown option, 3 for a wrong value, 4 for a simulation that fails, 5 for a file that cannot be
written.
"""

from __future__ import annotations

import json
import os
import shlex
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.cli import app
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.control.base import body_of
from biped_adrc.control.npid import NPIDController
from biped_adrc.control.super_twisting import SuperTwistingController
from biped_adrc.disturbances.recorded import RecordedTorque
from biped_adrc.gait.conventions import layout_of
from biped_adrc.gait.exchange.samples import read_csv
from biped_adrc.gait.gait import onto_section
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hybrid.storage import save
from biped_adrc.observers.high_gain import HighGainObserver
from biped_adrc.scenario.cycle import cycle_of

PYTHON = {
    "a number as text": (
        lambda r: ba.walk(ba.Walker(r.biped, ba.NPDController(r.h)), r.gait, impacts="4"),
        "asks for 4 impacts ('4' is a str), expected a whole number",
    ),
    "a step as text": (lambda r: ba.RK4("1e-3"), "h of RK4 is '1e-3' (a str), expected a number"),
    "a torque too few": (lambda r: r.walk(push=ba.TorquePulse([30.0] * 4)), "expected 5"),
    "gains of five joints": (
        lambda r: r.walk(ba.NPDController(r.h, ba.Gains([1.0] * 5, [1.0] * 5))),
        "K_p has 5 numbers",
    ),
    "a gait of another robot": (
        lambda r: ba.walk(ba.Walker(ba.Biped.load("three_link"), ba.NPDController(r.h)), r.gait, 1),
        "'three_link'",
    ),
    "a gait in place of its constraint": (lambda r: ba.NPDController(r.gait), "gait.constraint"),
    "a class in place of a controller": (
        lambda r: ba.Walker(r.biped, ba.NPDController),
        "is the class NPDController",
    ),
    "arguments in another order": (
        lambda r: ba.walk(r.gait, ba.Walker(r.biped, ba.NPDController(r.h))),
        "expected a Walker",
    ),
    "a list of pushes": (
        lambda r: ba.Walker(r.biped, ba.Passive(), [ba.TorquePulse([1.0] * 5)]),
        "(a list)",
    ),
    "a bandwidth as the observer": (lambda r: ba.ADRCController(r.h, 500.0), "from_bandwidth"),
    "degrees as the start": (
        lambda r: r.walk(start=tuple(map(np.degrees, r.gait.start(r.biped)))),
        "np.radians",
    ),
    "a start of another length": (
        lambda r: r.walk(start=(np.zeros(5), np.zeros(4))),
        "expected 5 finite numbers",
    ),
    "a URDF as the robot": (lambda r: ba.Biped.load("x.urdf"), "biped_from_urdf"),
    "a period in words": (lambda r: ba.SampledTime("1ms"), "'1ms'"),
    "a number as the timing": (
        lambda r: ba.Walker(r.biped, ba.NPDController(r.h), timing=1e-3),
        "SampledTime(1e-3)",
    ),
    "a clock slower than a fall": (lambda r: ba.SampledTime(1000.0), "at most"),
    "half an impact": (lambda r: r.walk(impacts=2.5), "whole number"),
    "a method in words": (lambda r: r.walk(method="RK4"), "RK4(1e-3)"),
    "one number for errors of masses": (lambda r: ba.ModelErrors(mass=0.2), "{'torso': 0.2}"),
    "a scenario as a walker": (lambda r: ba.walk(ba.Scenario("NPD")), "expected a Walker"),
    "a gait for a passive cycle": (
        lambda r: cycle_of(ba.Scenario("passive", robot="compass", gait="v0.8")),
        "no motors",
    ),
    "poles as text": (lambda r: ba.GPIObserver.from_poles("ab"), "expected a sequence of numbers"),
    "too many poles": (lambda r: ba.GPIObserver.from_bandwidth(50.0, 19), "has 21 poles and a"),
    "a polynomial that is unstable": (
        lambda r: HighGainObserver.from_epsilon(2e-3, (-1.0, 1.0, 1.0)),
        "must have negative real parts; try those of (s + 1)^3",
    ),
    "a torque step with a stop": (lambda r: ba.TorqueStep([1.0] * 5, stop=1.0), "has no stop"),
    "a recording before its start": (
        lambda r: RecordedTorque([0.0, 1.0], np.zeros((2, 5)), 1, -1.0),
        "begins at -1 s, expected a time from 0 on",
    ),
    "a law of ticks in continuous time": (
        lambda r: ba.Walker(r.biped, NPIDController(r.h).sampled(1e-3)),
        "NPIDController has no form but one in sampled time only",
    ),
    "another law of ticks": (
        lambda r: ba.Walker(r.biped, SuperTwistingController(r.h).sampled(1e-3)),
        "SuperTwistingController has no form but one in sampled time only",
    ),
    "sensors in continuous time": (
        lambda r: ba.Walker(r.biped, ba.NPDController(r.h), sensors=ba.Sensors()),
        "sensors and motors work in sampled time, found ContinuousTime",
    ),
    "a reference of five coordinates on three": (
        lambda r: ba.Walker(ba.Biped.load("three_link"), ba.NPDController(r.h)).initial_state(
            np.zeros(3), np.zeros(3)
        ),
        "VirtualConstraint of NPDController cannot be evaluated at the 3 coordinates",
    ),
    "a measurement without body terms": (
        lambda r: body_of(SimpleNamespace(body=None)),
        "the measurement has no body terms",
    ),
    "a convention of five angles for two": (
        lambda r: layout_of("tac2003", ba.Biped.load("compass")),
        "take convention 'own'",
    ),
    "a step that is too slow": (
        lambda r: ba.ZeroDynamics.of(r.biped, r.h).orbit(0.1),
        "the step does not reach its end: sigma^2 falls to -",
    ),
    "a ground that no foot reaches": (
        lambda r: onto_section(r.biped, [np.pi, 0.0, 0.0, 0.0, 0.0]),
        "no configuration near this one reaches it",
    ),
    "a plant of its own in continuous time": (
        lambda r: SteppingLoop(r.biped, ba.NPDController(r.h), model=r.biped),
        "is controlled at ticks, found ContinuousTime",
    ),
    "a plant that does not move by itself": (
        lambda r: SteppingLoop(r.biped, ba.NPDController(r.h), None, ba.SampledTime(1e-3), r.biped),
        "expected a plant that moves by itself, with n, p, swap",
    ),
    "a sensor without a reading": (lambda r: Sensor().reading((), 0, 0), "has no reading(w, q, v)"),
    "a sensor on no computer": (lambda r: Sensor().on_computer(None), "write on_computer(before)"),
    "settings that JSON has not": (
        lambda r: save(r.walk().trajectory, "x.npz", {"a": object()}),
        "expected settings of numbers, text, lists and mappings",
    ),
}
LONG = "n" * 300
URDF = Path(__file__).parents[1] / "urdf" / "rabbit" / "floating.urdf"
STUDY = """
name = "a"
[base]
controller.name = "NPD"
run.impacts = 1
[grid]
controller.K_p = [5000.0]
"""

COMMANDS = [
    ("simulate --preset foo", 3, "no preset 'foo'"),
    ("simulate --gait foo", 3, "no gait 'foo'"),
    ("simulate --set controller.observer.poles=-1,2", 3, "pole 2 rad/s is not stable"),
    ("simulate --push q1=5", 3, "JOINTS=TORQUE@STEP"),
    ("simulate --push q7=5@1:0-1", 3, "no joint 'q7'"),
    ("simulate --period -1", 3, "period"),
    ("simulate --impacts 0", 3, "impacts"),
    ("simulate --colour red", 2, "No such option"),
    ("simulate -o out.txt", 3, ".npz"),
    ("simulate --torque-limit 5 --impacts 4", 4, ""),
    ("animate nowhere.npz", 3, "not found"),
    ("poincare --controller pid", 3, "'pid': unknown name"),
    ("poincare --robot compass --set ground.slope=0.5", 4, "no return to the section"),
    (f"simulate --gait {LONG}", 3, "no gait"),
    (f"simulate --gait {LONG}.json", 3, "too long"),
    (f"simulate -o {LONG}", 5, "too long"),
    ("simulate -o 'a\nb.npz'", 3, "control characters"),
    ("simulate -o pipe.npz", 5, "not a regular file"),
    (f"study study.toml -o {LONG}", 5, "too long"),
    ("study study.toml -o afile", 3, "is a file"),
    ("study study.toml -o afile/below", 3, "is a file"),
    ("study /dev/full -o out", 3, "not a regular file"),
    ("study pipe.toml -o out", 3, "not a regular file"),
    ("reproduce --out afile", 3, "is a file"),
    (f"gait design --speeds 0.5 -o {LONG}", 5, "too long"),
    ("gait import zero.json", 3, "no name of a file"),
    ("gait import pipe.json", 3, "not a regular file"),
    ("gait import pipe.mat", 3, "not a regular file"),
    ("gait show --robot pipe.toml", 3, "not a regular file"),
    ("animate pipe.npz -o a.gif", 3, "not a regular file"),
    ("replay pipe.csv", 3, "not a regular file"),
    ("robot check nonexistent", 3, "not found"),
    ("robot check pipe.urdf", 3, "not a regular file"),
    (f"robot new URDF -o {LONG}", 5, "too long"),
    ("simulate --log own.csv", 3, "--log needs sample instants; give a --period"),
    ("simulate --set x", 3, "--set is 'x', expected NAME=VALUE"),
    ("simulate --set run.h=1 --set run.h=2", 3, "'run.h' is given twice, as --set run.h=2 too"),
    ("gait show published --set x=1", 3, "--set x: unknown name; choose from ['friction'"),
    ("gait show published --set friction=a", 3, "--set friction: found 'a', should be"),
    ("gait design --steps 0.3", 3, "--steps is given without --speeds"),
    ("gait design --speeds 0.3 --step 1", 3, "--speeds is given beside a --speed or a --step"),
    ("reproduce --push q9=5@1:0-1", 3, "no joint 'q9'"),
    ("robot new URDF -o afile", 3, "is a file"),
]
"""Command line, exit code, words of the sentence."""
TABLES = {
    "t,q1\n0,1\n\n1,x\n": "line 4, column 'q1'",
    "t,q1\n0,1\n\n1,nan\n": "line 4, column 'q1'",
    "t,q1\n0,1\n1\n": "line 3",
}


@pytest.fixture(scope="module")
def right(biped, gait):
    """A robot, its gait, and a walk of one step of which a part is replaced."""

    def walk(controller=None, push=None, impacts=1, **more):
        controller = controller or ba.NPDController(gait.constraint)
        return ba.walk(ba.Walker(biped, controller, push), gait, impacts, **more)

    return SimpleNamespace(biped=biped, gait=gait, h=gait.constraint, walk=walk)


@pytest.mark.parametrize("mistake", PYTHON)
def test_a_mistake_in_python_is_one_sentence(mistake, right):
    """`do` makes the mistake on a robot and gait that are right otherwise: an error of the package, on one
    line, that has the words."""
    do, word = PYTHON[mistake]
    with pytest.raises(ba.BipedError) as caught:
        do(right)
    assert word in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("engine", ["compiled", "pinocchio"])
def test_a_run_that_runs_away_names_its_step(engine, right):
    """RK4 with a step of 1 s is unstable here: the detail says which method and step it was."""
    walker = ba.Walker(right.biped, ba.NPDController(right.h))
    run = ba.walk(walker, right.gait, 1, method=ba.RK4(1.0), engine=engine).trajectory
    assert run.status is ba.Status.RAN_AWAY
    assert run.detail.endswith("(RK4, h = 1 s)")


@pytest.fixture
def here(tmp_path, monkeypatch, gait):
    """A folder with a file, a study, a gait whose name has a zero byte, and pipes that nobody writes to."""
    monkeypatch.chdir(tmp_path)
    Path("afile").write_text("kept")
    Path("study.toml").write_text(STUDY)
    gait.save("zero.json")
    record = json.loads(Path("zero.json").read_text())
    Path("zero.json").write_text(json.dumps(record | {"name": "a\0b"}))
    for kind in ("npz", "toml", "json", "mat", "csv", "urdf"):
        os.mkfifo(f"pipe.{kind}")


@pytest.mark.parametrize(("line", "code", "words"), COMMANDS, ids=[x[0][:40] for x in COMMANDS])
def test_a_mistake_on_the_command_line_is_one_sentence_with_its_exit_code(here, line, code, words):
    """`here` is a folder with files and pipes that a command must not wait for. Nothing is written and the
    file "afile" is kept."""
    before = sorted(os.listdir())
    done = CliRunner().invoke(app, shlex.split(line.replace("URDF", str(URDF))))
    error = done.exception
    sentence = isinstance(error, ba.BipedError)
    # an unknown option, and a walk that fails, end the command without an error of the package
    assert sentence or code in (2, 4), done.output
    assert (error.exit_code if sentence else done.exit_code) == code
    assert words in (str(error) if sentence else done.output)
    assert sorted(os.listdir()) == before
    assert Path("afile").read_text() == "kept"


@pytest.mark.parametrize("text", TABLES)
def test_a_mistake_in_a_table_names_its_line(text, biped, tmp_path):
    """No number, NaN, and a row that is too short, with empty lines counted: line 4 is that of an editor. The
    same table as recorded torques and as samples of a gait."""
    file = tmp_path / "table.csv"
    file.write_text(text)
    for read in (lambda: RecordedTorque.read(file, biped), lambda: read_csv(file)):
        with pytest.raises(ba.BipedError) as caught:
            read()
        assert TABLES[text] in str(caught.value)


def test_a_file_of_ten_thousand_brackets_is_refused(tmp_path):
    """10000 nested lists end TOML's reader by Python's limit of recursion, which must not reach the user as a
    traceback."""
    file = tmp_path / "deep.toml"
    file.write_text(f"x = {10_000 * '['}")
    with pytest.raises(ba.BipedError, match=r"deep\.toml' is nested too deeply"):
        ba.study(file, tmp_path / "out")


def test_a_public_name_that_is_not_there_has_a_nearest_one():
    """ba.PDController does not exist."""
    with pytest.raises(AttributeError, match="did you mean 'NPDController'"):
        _ = ba.PDController


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("__version__ = '0.4.3'", "version 0.4.3"),
        ("raise ImportError('libboost.so.9: cannot open shared object file')", "libboost.so.9"),
    ],
)
def test_another_pinocchio_in_front_is_named_with_its_path(tmp_path, text, word):
    """PyPI has another package "pinocchio" (0.4.3), and a broken installation fails to load: a stand-in in
    front on the path has to be named, in one line."""
    other = tmp_path / "pinocchio" / "__init__.py"
    other.parent.mkdir()
    other.write_text(text)
    command = [sys.executable, "-m", "biped_adrc", "robot", "list"]
    env = {**os.environ, "PYTHONPATH": str(tmp_path)}
    run = subprocess.run(command, env=env, capture_output=True, text=True, check=False)
    assert run.returncode == 3
    assert run.stderr.startswith("error: ")
    assert run.stderr.count("\n") == 1
    assert str(other) in run.stderr
    assert word in run.stderr
