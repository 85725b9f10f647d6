"""The command: help, exit codes, one clear message for bad input, files that survive an interruption."""

import subprocess
import sys
from pathlib import Path

import pytest

import biped_adrc as ba
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
    assert "Sampling period of the controller [s]." in " ".join(command("observer", "-h").split())


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
