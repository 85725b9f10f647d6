"""The command: help, exit codes, one clear message for bad input, files that survive an interruption.

`command(*words)` is what a command prints, and raises what it raises; `ended(*words)` are its exit code and
text.
"""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc import cli
from biped_adrc.cli import app
from biped_adrc.cli.gait import _numbers
from biped_adrc.cli.robot import _names
from biped_adrc.core.errors import InputError, ModelError, SimulationError
from biped_adrc.core.verdict import at_most
from biped_adrc.extras.export.computer import Computer
from biped_adrc.gait.curves import BSpline
from biped_adrc.model.robot_import.import_robot import Derived
from biped_adrc.scenario.push import Push, parse_push

from .commands import command


def test_the_command_in_a_fresh_interpreter(tmp_path):
    """Most tests call the command in their own process; this one starts the installed script, which has to
    walk and to print no warning."""
    script = Path(sys.executable).with_name("biped-adrc")
    assert script.is_file(), f"{script} is missing: install the package"
    line = [script, "simulate", "--controller", "npd", "--impacts", "1"]
    done = subprocess.run(line, capture_output=True, text=True, timeout=120, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert "COMPLETED" in done.stdout


def test_multipliers_of_a_robot_without_motors():
    """The rimless wheel: two independent methods print the same multiplier, to seven digits the cos(pi/4)^2 of
    its closed form."""
    printed = command("poincare", "--robot", "rimless_wheel")
    # the first 29 letters of a line are the name of the method
    table = {line[:29].strip(): line[29:].split() for line in printed.splitlines()}
    assert table["variational equation"] == table["central differences"]
    assert [float(x) for x in table["variational equation"]] == pytest.approx([0.5], abs=1e-7)
    assert "Trust the variational equation: the cycle is stable" in printed


def test_pushes_from_text():
    """JOINTS=TORQUE@STEP:FROM-TO becomes a push: q1 and q2, 30 N m, single support 19, from 0.1 to 0.3 s; no
    end means a step. Whatever does not follow the grammar is refused."""
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
    """A B-spline takes the place of the polynomial, from option to file; 12 nodes keep the search short. The
    legs have no knees, so no clearance of the swing foot is asked for.
    """
    out = tmp_path / "local.json"
    command(
        *["gait", "design", "--robot", "three_link", "--speed", "0.7", "--set", "nodes=12"],
        *["--set", "limits.clearance=none", "--set", "curve=bspline", "-o", out],
    )
    gait = ba.load_gait(out, ba.Biped.load("three_link"))
    assert isinstance(gait.constraint.curve, BSpline)
    assert gait.provenance["curves"].startswith("bspline, degree 6")


def test_the_observer_is_that_of_the_controller(tmp_path):
    """`observer` reports on the observer of the controller that is named (LESO, a linear one with m = 1), and
    has the gang of six for it and for NPD, which has none. In continuous time the first has no loop, which a
    sentence says; the second is refused."""
    said = command("observer", "--set", "controller.name=LESO")
    assert "m = 1 at 500 rad/s" in said
    assert "Gang of six" in said
    npd = ["observer", "--set", "controller.name=NPD"]
    said = command(*npd, "-o", str(tmp_path / "six.svg"))
    assert "m = 1" not in said
    assert all(name in said for name in ("|S|", "|P S|", "|u/r|", "disk margin", "ripple"))
    assert (tmp_path / "six.svg").exists()
    always = ["--set", "hardware=ideal", "--set", "hardware.period=none"]
    assert "no loop of the walker: the sampled loop" in command("observer", *always)
    with pytest.raises(InputError, match="the sampled loop of a walker was asked for"):
        command(*npd, *always)
    assert "The controller samples with this period [s]." in " ".join(
        command("observer", "-h").split()
    )


def test_the_state_before_the_impact_has_names_and_units():
    """The fixed point x- of the return map is printed joint by joint, angles and then rates."""
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
    """`INTERRUPTED` registers a controller that raises SIGINT at 0.05 s, inside the walk: exit code 130, no
    traceback, and neither the result nor a temporary file beside the script."""
    script = tmp_path / "interrupted.py"
    script.write_text(INTERRUPTED)
    # Pinocchio's engine calls the controller's Python in each step
    words = ["simulate", "--controller", "interrupting", "--engine", "pinocchio", "-o", "run"]
    line = [sys.executable, str(script), *words]
    done = subprocess.run(line, capture_output=True, text=True, timeout=120, cwd=tmp_path)
    assert done.returncode == 130, done.stderr
    assert "interrupted" in done.stderr
    assert "Traceback" not in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == [script.name]


def test_the_shortest_step_has_a_half_and_its_walk_is_stored(tmp_path):
    """1e-6 s is the shortest step allowed; the comparison at half of it has to run all the same. 5 ms of
    walking keep the test short."""
    words = ["simulate", "--controller", "NPD", "--impacts", "1", "--set", "run.h=1e-6"]
    words += ["--set", "run.max_step_time=5e-3", "-o", tmp_path / "run.npz"]
    done = CliRunner().invoke(app, [str(word) for word in words], catch_exceptions=False)
    assert "at half the step" in done.output
    assert ba.load_walk(tmp_path / "run.npz").trajectory.t_end == pytest.approx(5e-3)


def test_a_walk_is_stored_before_it_is_made_again(tmp_path, monkeypatch):
    """The second walk, at half the step for comparison, fails here; the first one is in the file already."""

    def half(s, walker):
        raise InputError("no half")

    monkeypatch.setattr("biped_adrc.scenario.walk.halved", half)
    words = ["simulate", "--controller", "NPD", "--impacts", "1", "-o", str(tmp_path / "run.npz")]
    with pytest.raises(InputError, match="no half"):
        CliRunner().invoke(app, words, catch_exceptions=False)
    assert ba.load_walk(tmp_path / "run.npz").impacts == 1


def test_simulate_says_where_rounding_decides(tmp_path):
    """These values, found by a search, make an encoder count flip with the last digit, so that neighbours
    1e-12 apart walk differently; a smooth walk has no such note."""
    values = {"counts": 50000, "velocity": "differences"}
    sets = [f"hardware.encoders.{k}={x}" for k, x in values.items()]
    sets += ["run.seed=368", "hardware.period=0.0011633571256965862"]
    sets += ["hardware.touchdown=force", "errors.mass_width=0.17140917491665197"]
    words = [word for x in sets for word in ("--set", x)]
    printed = command("simulate", "--controller", "reference reset", "--impacts", "3", *words)
    assert "note: rounding decides digits of this walk: from a start 1e-12 aside" in printed
    assert "rounding" not in command("simulate", "--controller", "NPD", "--impacts", "1")


def ended(*words):
    """Exit code and text of a command that ends by itself."""
    done = CliRunner().invoke(app, [str(word) for word in words], catch_exceptions=False)
    return done.exit_code, " ".join(done.output.split())


# -- what is printed, whole ------------------------------------------------------------------------
WALK = """\
time length torque at scuffs step [s] [m] [N m] F_N [N] friction impact [mm] breaks
1 0.4163 0.3123 108.5 222.1 0.446 0.518 0 impulse
2 0.4164 0.3123 107.6 222.1 0.446 0.518 0 impulse
F_N and friction: least and largest mean over 5 ms
COMPLETED: the run reached the number of events or the time asked for
2 impacts, largest tracking error 1.286e-04 rad (1.286e-04 at half the step),
peak torque 108.5 N m, RK4, h = 0.001 s
it made all steps, feasible but for the impact: step 1: the impulse at impact asks
for friction 0.518 > 0.5
the old stance foot does not lift off after steps [1, 2]
engine compiled"""


def test_a_walk_is_printed_step_by_step(monkeypatch):
    """`stuck`: a foot that does not lift off, and a limit of friction of 0.5, which the impulse (0.518)
    breaks, so that the notes are printed too. `WALK` is the whole text."""
    certified = ba.Walk.certified
    stuck = lambda w, k: tuple(replace(c, old_foot_velocity=0.0) for c in certified(w, k))  # noqa: E731
    monkeypatch.setattr(ba.Walk, "certified", stuck)
    words = "--impacts", 2, "--period", 0.001, "--set", "limits.friction=0.5"
    # U+2500: the horizontal lines of the table
    text = ended("simulate", "--controller", "NPD", *words)[1].replace("\u2500", "")
    assert " ".join(WALK.split()) in " ".join(text.split())


def test_a_table_of_gaits_and_a_version():
    """A row of the table has: speed 0.7502 m/s, step 0.3124 m, period 0.4164 s, slope 0."""
    assert "│ published │ 0.7502 │ 0.3124 │ 0.4164 │ 0 │" in ended("gait", "show")[1]
    assert ended("--version") == (0, f"biped-adrc {ba.__version__}")


# -- how commands end ------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("error", "code", "text"),
    [
        (InputError("odd"), 3, "error: odd"),
        (SimulationError("odd"), 4, "error: odd"),
        (SystemExit(2), 2, ""),
        (SystemExit("odd"), 1, ""),
        (SystemExit(None), 0, ""),
        (KeyboardInterrupt(), 130, "interrupted; what was already written is complete"),
        (None, 0, ""),
    ],
)
def test_errors_become_exit_codes(monkeypatch, capsys, error, code, text):
    """`_run` gives the code of the error's kind and prints one line, without a traceback; SystemExit is a
    number, a text (1) or None (0), as Python has it; Ctrl-C is 130."""

    def command(standalone_mode):
        if error is not None:
            raise error

    monkeypatch.setattr(cli, "app", command)
    assert cli._run() == code
    assert capsys.readouterr().err.strip() == text


def test_a_law_that_does_not_hold_ends_check_and_new(biped, monkeypatch, tmp_path):
    """A made-up law with the value 1 and the limit 0.1: `robot check` prints it and ends with 1, `robot new`
    refuses to write the robot."""
    law = at_most("energy [J]", "law", 1.0, 0.1)
    derived = Derived(biped, (), (law,), {})
    monkeypatch.setattr("biped_adrc.cli.robot._derived", lambda *_: derived)
    code, text = ended("robot", "check", "x.urdf", "--plot", tmp_path / "x.svg")
    # twice: among the checks, and as the error
    assert (code, text.count("energy [J]: 1.0e+00 is not <= 0.1")) == (1, 2)
    with pytest.raises(ModelError, match=r"floating.urdf': energy \[J\]: 1.0e\+00 is not <= 0.1$"):
        command("robot", "new", "x.urdf", "-o", tmp_path / "new")


def test_a_study_that_is_interrupted_says_where_it_goes_on(monkeypatch, tmp_path):
    """A folder that is not there yet means that nothing was begun. Before the message is printed further
    signals are ignored, so that a second Ctrl-C does not cut it off."""
    (tmp_path / "study.toml").write_text("name = 'a'\n[grid]\ncontroller.K_p = [5000.0]\n")
    ignored = []

    def interrupt(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(ba, "study", interrupt)
    monkeypatch.setattr("biped_adrc.cli.study.signal.signal", lambda *x: ignored.append(x[0].name))
    for out, begun in (
        (tmp_path / "new", "nothing was begun in"),
        (tmp_path, "what is finished is in"),
    ):
        code, text = ended("study", tmp_path / "study.toml", "-o", out)
        assert (code, begun in text) == (130, True)
    assert ignored == ["SIGINT", "SIGTERM"] * 2


def test_remarks_are_printed(monkeypatch, tmp_path):
    """Stand-ins give `replay`, `simulate` and `export` something to remark: an odd column, a controller that
    raised, a controller unstable by itself (growth above 10 /s, here 10.6, is printed as 11; 10.0 is not)."""
    monkeypatch.setattr(ba, "replay", lambda *_: SimpleNamespace(rows=(), remarks=("odd",)))
    assert "note: odd" in ended("replay", "x.csv")[1]
    raised = SimpleNamespace(status=ba.Status.RAISED, t_end=0.25, detail="odd")
    monkeypatch.setattr(ba, "walk_scenario", lambda *_: SimpleNamespace(trajectory=raised))
    with pytest.raises(ba.BipedError, match=r", after 0\.25 s:\nodd$"):
        command("simulate")
    source = SimpleNamespace(
        written={"step": SimpleNamespace(operations=5, doubles=2)},
        files=("p.c",),
        numbers=3,
        prefix="p",
        fields=(SimpleNamespace(name="z", size=4),),
    )
    monkeypatch.setattr(ba, "export_c", lambda *_: source)
    monkeypatch.setattr("biped_adrc.extras.export.loaded.tried", lambda _: "tried")
    (tmp_path / "s.toml").write_text("controller.name = 'NPD'\nhardware.period = 1e-3\n")
    for growth, more in ((10.0, ""), (10.6, " by itself this controller is unstable (11 /s): ")):
        monkeypatch.setattr(Computer, "growth", lambda *_, growth=growth: growth)
        text = ended("export", tmp_path / "s.toml", "-o", "c", "--fmu")[1]
        head = "step: 5 operations, 2 of them in double always; 3 constants; state z 4 tried p.fmu, for co-"
        assert text.startswith(head)
        assert text.partition("written to c: p.c, p.fmu")[2].startswith(more)
        assert (len(text.partition("p.c, p.fmu")[2]) > 0) is (growth > 10.0)


def test_numbers_and_names_of_options():
    """FIRST:LAST:STEP includes LAST only where a step hits it; a range that runs backwards, or has a step of
    0 or none, is refused. Names are split at commas; no option is None, an empty one no names."""
    for text, numbers in (
        ("0.4,0.5", (0.4, 0.5)),
        ("0.4:0.6:0.1", (0.4, 0.5, 0.6)),
        ("0.4:0.69:0.1", (0.4, 0.5, 0.6)),
        ("0.3:0.3:0.1", (0.3,)),
    ):
        assert _numbers(text) == numbers
    for text in ("0.4:0.3:0.1", "0.4:0.6:0", "0.4:0.6", "a"):
        with pytest.raises(InputError, match=f"found '{text}', expected numbers as"):
            _numbers(text)
    assert (_names(None), _names(" a,, b "), _names("")) == (None, ("a", "b"), ())
