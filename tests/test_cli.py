"""The command: help, exit codes, one clear message for bad input, files that survive an interruption."""

import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.cli import app
from biped_adrc.core.errors import InputError
from biped_adrc.gait.curves import BSpline
from biped_adrc.scenario.push import Push, parse_push

from .commands import command


def test_the_command_in_a_fresh_interpreter(tmp_path):
    script = Path(sys.executable).with_name("biped-adrc")
    assert script.is_file(), f"{script} is missing: install the package"
    line = [script, "simulate", "--controller", "npd", "--impacts", "1"]
    done = subprocess.run(line, capture_output=True, text=True, timeout=120, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert "COMPLETED" in done.stdout


def test_multipliers_of_a_robot_without_motors():
    printed = command("poincare", "--robot", "compass")
    table = {line[:29].strip(): line[29:].split() for line in printed.splitlines()}
    assert table["variational equation"] == table["central differences"]
    assert [float(x) for x in table["variational equation"]] == pytest.approx(
        [0.5799523, 0.5799523, 0.1315726], abs=1e-7
    )
    assert "Trust the variational equation: the cycle is stable" in printed


def test_pushes_from_text():
    push = parse_push("q1,q2=30@19:0.1-0.3")
    assert push == Push(joints="q1,q2", torque=30.0, step=19, onset=0.1, duration=0.2)
    assert push.stop(0.1) == 0.3
    sine = parse_push("q1=5,q5=-2.5 Nm@3:0 ms-0.2:sine=4")
    assert (sine.factors, sine.frequency, sine.over_impacts) == (
        {"q1": 5.0, "q5": -2.5},
        4.0,
        False,
    )
    assert parse_push("q1=5@3:50 ms-0.2:rise=10 ms").rise == 0.01
    assert parse_push("torso_pitch=1@2:0.1-").shape == "step"
    for bad in ("", "q1@1:0-1", "q1=x@1:0-1", "q1,q2@1:0-1", "q1=1@0.5:0-1", "q1=1@1:0.2-0.1"):
        with pytest.raises(InputError, match="push"):
            parse_push(bad)


def test_a_gait_is_designed_of_the_curve_that_is_named(tmp_path):
    out = tmp_path / "local.json"
    command(
        *["gait", "design", "--speed", "0.7", "--set", "nodes=12", "--set", "curve=bspline", "-o"],
        out,
    )
    gait = ba.load_gait(out, ba.Biped.load("rabbit"))
    assert isinstance(gait.constraint.curve, BSpline)
    assert gait.provenance["curves"].startswith("bspline, degree 6")


def test_the_observer_is_that_of_the_controller():
    assert "m = 1 at 500 rad/s" in command("observer", "--set", "controller.name=LESO")
    with pytest.raises(InputError, match="the observer of 'NPD' is None, expected a GPIObserver"):
        command("observer", "--set", "controller.name=NPD")
    assert "The controller samples with this period [s]." in " ".join(
        command("observer", "-h").split()
    )


def test_the_state_before_the_impact_has_names_and_units():
    said = " ".join(command("poincare").split())
    assert "x-: q1 = 3.247231, q2 = " in said
    assert "v5 = -0.170000 [rad/s]" in said


INTERRUPTED = """
import signal
import biped_adrc as ba
from biped_adrc.cli import main

class Interrupting(ba.NPDController):
    def output(self, s, m):
        if m.t > 0.05:
            signal.raise_signal(signal.SIGINT)
        return super().output(s, m)

ba.register("controller", "interrupting", Interrupting)
main()
"""


def test_ctrl_c_in_a_walk_leaves_no_file(tmp_path):
    script = tmp_path / "interrupted.py"
    script.write_text(INTERRUPTED)
    words = ["simulate", "--controller", "interrupting", "--engine", "pinocchio", "-o", "run"]
    line = [sys.executable, str(script), *words]
    done = subprocess.run(line, capture_output=True, text=True, timeout=120, cwd=tmp_path)
    assert done.returncode == 130, done.stderr
    assert "interrupted" in done.stderr
    assert "Traceback" not in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == [script.name]


def test_the_shortest_step_has_a_half_and_its_walk_is_stored(tmp_path):
    words = ["simulate", "--controller", "NPD", "--impacts", "1", "--set", "run.h=1e-6"]
    words += ["--set", "run.max_step_time=5e-3", "-o", tmp_path / "run.npz"]
    done = CliRunner().invoke(app, [str(word) for word in words], catch_exceptions=False)
    assert "at half the step" in done.output
    assert ba.load_walk(tmp_path / "run.npz").trajectory.t_end == pytest.approx(5e-3)


def test_a_walk_is_stored_before_it_is_made_again(tmp_path, monkeypatch):
    def half(s, walker):
        raise InputError("no half")

    monkeypatch.setattr("biped_adrc.scenario.walk.halved", half)
    words = ["simulate", "--controller", "NPD", "--impacts", "1", "-o", str(tmp_path / "run.npz")]
    with pytest.raises(InputError, match="no half"):
        CliRunner().invoke(app, words, catch_exceptions=False)
    assert ba.load_walk(tmp_path / "run.npz").impacts == 1


def test_simulate_says_where_rounding_decides(tmp_path):
    values = {"counts": 50000, "velocity": "differences"}
    sets = [f"hardware.encoders.{k}={x}" for k, x in values.items()]
    sets += ["run.seed=368", "hardware.period=0.0011633571256965862"]
    sets += ["hardware.touchdown=force", "errors.mass_width=0.17140917491665197"]
    words = [word for x in sets for word in ("--set", x)]
    printed = command("simulate", "--controller", "reference reset", "--impacts", "3", *words)
    assert "note: rounding decides digits of this walk: from a start 1e-12 aside" in printed
    assert "rounding" not in command("simulate", "--controller", "NPD", "--impacts", "1")
