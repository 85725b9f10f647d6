"""The command: help, exit codes, one clear message for bad input, files that survive an interruption."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest

import biped_adrc as ba
from biped_adrc.cli import app
from biped_adrc.errors import GaitError, InputError
from biped_adrc.gait.bspline import BSpline
from biped_adrc.gait.curves import ControlledCurve, curve_kind
from biped_adrc.scenario.push import Push, parse_push
from biped_adrc.scenario.registry import names


@pytest.fixture
def command(preloaded, tmp_path):
    """The command in a fork, which is as a fresh process (test_documents.py); its folder is the test's."""
    script = Path(sys.executable).with_name("biped-adrc")
    assert script.is_file(), f"{script} is missing: install the package"
    return lambda *words: preloaded.run(script, list(words), tmp_path, strict=False, timeout=120)


def test_help_of_a_fresh_interpreter():
    done = subprocess.run(
        [sys.executable, "-m", "biped_adrc.cli", "--help"],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0
    assert "Usage" in done.stdout


@pytest.mark.parametrize(
    "arguments",
    [
        ["--help"],
        *[[name, "--help"] for name in ("reproduce", "simulate", "poincare", "animate", "gait")],
    ],
)
def test_help(arguments, command):
    done = command(*arguments)
    assert done.code == 0
    assert "Usage" in done.stdout


def test_walk_store_and_animate(tmp_path, command):
    run, page = tmp_path / "run.npz", tmp_path / "walk.html"
    done = command(
        "simulate", "--controller", "npd", "--impacts", "2", "--push", "q1,q2=10@1:0.1-0.2",
        "-o", str(run),
    )  # fmt: skip
    assert done.code == 0, done.stderr
    assert "COMPLETED" in done.stdout
    assert "least and largest mean over 5 ms;" in done.stdout
    settings = json.loads(run.with_suffix(".json").read_text())["settings"]
    assert settings["scenario"]["pushes"][0]["torque"] == {"q1": 10.0, "q2": 10.0}
    assert "pin" in settings["versions"]
    done = command("animate", str(run), "-o", str(page))
    assert done.code == 0, done.stderr
    assert page.stat().st_size > 100_000


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["simulate", "--preset", "foo"], 3, "no preset 'foo'"),
        (["simulate", "--gait", "foo"], 3, "no gait 'foo'"),
        (["simulate", "--poles=-1,2"], 3, "pole 2 rad/s is not stable"),
        (["simulate", "--poles=-1,x"], 3, "expected numbers"),
        (["simulate", "--push", "q1=5"], 3, "expected JOINTS=TORQUE@STEP"),
        (["simulate", "--push", "q7=5@1:0-1"], 3, "no joint 'q7'"),
        (["simulate", "--period", "-1"], 3, "period: found -1.0"),
        (["simulate", "--step", "0"], 3, "h: found 0.0"),
        (["simulate", "--impacts", "0"], 3, "impacts: found 0"),
        (["simulate", "--torque-limit", "5", "--impacts", "4"], 4, ""),
        (["animate", "nowhere.npz"], 3, "not found"),
        (["simulate", "--colour", "red"], 2, "No such option"),
        (["reproduce", "--preset", "foo"], 3, "no preset 'foo'"),
        (["poincare", "--controller", "pid"], 3, "controller 'pid' is unknown"),
        (["poincare", "--robot", "compass", "--controller", "adrc"], 3, "with 0 motors"),
        (["poincare", "--robot", "compass", "--samples", "2"], 3, "expected 0 or at least 3"),
        (["poincare", "--robot", "compass", "--slope", "0.6"], 4, "no return to the section"),
    ],
)
def test_exit_codes(arguments, code, message, command):
    done = command(*arguments)
    assert done.code == code, (done.stdout, done.stderr)
    assert message in done.stderr
    assert "Traceback" not in done.stderr


def test_multipliers_of_a_robot_without_motors(command):
    done = command("poincare", "--robot", "compass", "--samples", "5")
    assert done.code == 0, done.stderr
    table = {line[:29].strip(): line[29:].split() for line in done.stdout.splitlines()}
    assert table["variational equation"] == table["central differences"]
    assert [float(x) for x in table["variational equation"]] == pytest.approx(
        [0.5799523, 0.5799523, 0.1315726], abs=1e-7
    )
    assert "Trust the variational equation: the cycle is stable" in done.stdout


def test_a_folder_that_cannot_be_written_is_refused_before_the_first_run(tmp_path, command):
    (tmp_path / "file").write_text("")
    begin = time.monotonic()
    done = command("reproduce", "--out", str(tmp_path / "file" / "out"))
    assert done.code == 5
    assert "cannot write" in done.stderr
    assert time.monotonic() - begin < 60


def test_interruption_leaves_no_process_and_no_half_file(tmp_path, started):
    process = started(sys.executable, "-m", "biped_adrc.cli", "reproduce", "--out", str(tmp_path))
    assert at_work(process.pid, within=120.0)
    os.killpg(process.pid, signal.SIGINT)
    _, stderr = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "interrupted" in stderr
    assert "Traceback" not in stderr
    assert gone(process.pid, within=30.0)
    assert not [path for path in tmp_path.iterdir() if path.name.startswith(".")]


def at_work(process, within):
    """Whether each of its workers has computed for a second before so many have passed."""
    deadline = time.monotonic() + within
    while time.monotonic() < deadline:
        workers = [
            p for p in psutil.Process(process).children(recursive=True) if p.ppid() != process
        ]
        if len(workers) >= 2 and all(sum(p.cpu_times()[:2]) > 1.0 for p in workers):
            return True
        time.sleep(0.1)
    return False


def gone(group, within):
    """Whether the last process of a group has ended within so many seconds."""
    deadline = time.monotonic() + within
    while time.monotonic() < deadline:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.1)
    return False


def test_pushes_from_text():
    assert parse_push("q1,q2=30@19:0.1-0.3") == Push({"q1": 30.0, "q2": 30.0}, 19, 0.1, 0.3)
    assert parse_push("q1=5,q5=-2.5@3:0-0.2:sine=4") == Push(
        {"q1": 5.0, "q5": -2.5}, 3, 0.0, 0.2, "sine", 4.0
    )
    assert parse_push("torso_pitch=1@2:0.1-").kind == "step"
    for bad in ("", "q1@1:0-1", "q1=x@1:0-1", "q1,q2@1:0-1", "q1=1@0.5:0-1"):
        with pytest.raises(InputError, match="push"):
            parse_push(bad)


def inside(*arguments):
    """The command in this process."""
    from typer.testing import CliRunner

    return CliRunner().invoke(app, list(arguments))


def test_simulate_says_what_ground_and_motors_had_to_give():
    common = ("simulate", "--engine", "compiled", "--controller", "npd", "--impacts", "2")
    legal = inside(*common)
    assert legal.exit_code == 0
    assert "it made all steps legally" in legal.output
    assert "0.519" in legal.output  # the impulse's friction
    assert "outside the friction cone for 0 % of the time" in " ".join(legal.output.split())
    strict = inside(*common, "--friction-limit", "0.3", "--force-window", "0.01")
    assert strict.exit_code == 0
    assert "not all of them legally" in strict.output
    assert "over 10 ms" in strict.output
    ended = inside(*common, "--friction-limit", "0.3", "--end-illegal")
    assert ended.exit_code == 4
    assert "ILLEGAL" in ended.output
    assert "it ended otherwise" in ended.output
    for option, value in (
        ("--friction-limit", "0"),
        ("--friction-limit", "2"),
        ("--force-window", "-1"),
    ):
        assert isinstance(inside(*common, option, value).exception, InputError)


def test_a_gait_is_designed_of_the_curve_that_is_named(tmp_path):
    """Again by the command that it has in its provenance, which was no command before."""
    common, out = ("gait", "design", "--speed", "0.7", "--nodes", "12"), tmp_path / "local.json"
    done = inside(*common, "--curve", "bspline", "-o", str(out))
    assert done.exit_code == 0
    gait = ba.load_gait(out, ba.Biped.load("rabbit"))
    assert isinstance(gait.constraint.curve, BSpline)
    assert "--curve bspline" in gait.provenance["command"]
    between = [x for x in names("curve") if issubclass(curve_kind(x), ControlledCurve)]
    wrong = inside(*common, "--curve", "polynomial").exception
    assert isinstance(wrong, GaitError)
    assert f"choose one of {between}" in str(wrong)
    shown = " ".join(inside("gait", "design", "--help").output.replace("│", " ").split())
    assert f"of the registry: {' or '.join(between)}." in shown


def test_poincare_says_what_the_nominal_step_needs():
    done = inside("poincare", "--robot", "compass", "--samples", "0")
    assert done.exit_code == 0
    assert "friction at impact 0.246" in done.output
    for words in ("at an instant F_N is", "outside the friction cone for", "scuffs by"):
        assert words in done.output
    assert "not legal: the swing foot scuffs" in done.output


INTERRUPTED = """
import os, signal, sys
class AtImport:
    def find_spec(self, name, *_):
        if name == "biped_adrc.cli.walk":
            os.kill(os.getpid(), signal.SIGINT)
sys.argv = ["/usr/bin/biped-adrc"]
sys.meta_path.insert(0, AtImport())
import biped_adrc.cli
"""


def test_ctrl_c_while_the_command_is_imported():
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED], capture_output=True, text=True, check=False, timeout=60
    )
    assert (done.returncode, done.stderr) == (130, "interrupted; nothing was begun\n")


LOST = """
import signal, time
import biped_adrc.cli as cli
class Gone:
    def __del__(self):
        signal.raise_signal(signal.SIGINT)  # no exception leaves this function
def app(**_):
    Gone()
    time.sleep(10.0)
cli.app = app
cli.main()
"""


def test_ctrl_c_inside_a_callback_of_the_interpreter_is_not_lost(tmp_path, preloaded):
    (tmp_path / "lost.py").write_text(LOST)
    done = preloaded.run(tmp_path / "lost.py", [], tmp_path, strict=False)
    assert (done.code, done.stderr) == (130, "interrupted; what was already written is complete\n")
