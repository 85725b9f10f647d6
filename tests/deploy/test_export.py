"""An exported controller against Python, call by call over walks, and what its folder is like."""

import os
import shutil
import subprocess
from dataclasses import replace

import casadi as ca
import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.deploy import loaded as loading
from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.export import export_c
from biped_adrc.deploy.loaded import FLAGS, NO_RESULT, NOT_MEASURED, OK, Loaded
from biped_adrc.deploy.records import fed, recorded
from biped_adrc.deploy.ripple import ripple
from biped_adrc.deploy.rounding import proof
from biped_adrc.deploy.source import source_of
from biped_adrc.engine.c_text import in_double
from biped_adrc.engine.simulate import run_compiled
from biped_adrc.errors import InputError, OutputError
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.scenario.build import RobotAndGait, build, start

PUSH = "q1,q2=20@1:0.1-0.3"
ROBOT = {  # all that a robot's computer has: encoders, filter, delay, limits, a policy at contact
    "hardware": "rabbit",
    "counts": 1e5,
    "filter_time": 1e-3,
    "delay": 2e-3,
    "delay_known": True,
    "rate_limit": 3e4,
    "bandwidth": 100.0,
    "contact": "hold",
    "contact_window": 0.015,
}
CASES = {
    "NPD": ba.Scenario("NPD", hardware="ideal", impacts=2, pushes=PUSH),
    "Table I": ba.Scenario("ADRC", hardware="ideal", impacts=2, pushes=PUSH),
    "on a robot": ba.Scenario("LESO", impacts=2, pushes=PUSH, **ROBOT),
    "touchdown noticed": ba.Scenario(
        "DOB", hardware="rabbit", counts=1e6, impacts=2, touchdown="kinematics"
    ),
}


@pytest.fixture(scope="module")
def cases():
    """Computer, exported controller and recorded calls, by name; made when asked for."""
    made = {}

    def case(name):
        if name not in made:
            walk = ba.walk_scenario(CASES[name])
            computer = Computer(walk.walker)
            loaded = Loaded(source_of(computer))
            made[name] = computer, loaded, recorded(walk.walker, walk.trajectory)
        return made[name]

    return case


@pytest.mark.parametrize("name", CASES)
def test_a_call_differs_from_python_by_what_ulps_of_its_inputs_do(cases, name):
    computer, loaded, calls = cases(name)
    assert {"init", "step", "touchdown"} == {call.kind for call in calls}
    found = proof(computer, loaded, calls, every=7)
    assert found.worst <= 10.0
    assert found.torque > 90.0


def test_the_last_torque_is_on_its_way_and_the_limits_are_kept(cases):
    computer, loaded, calls = cases("on a robot")
    made = fed(loaded, calls)
    steps = [i for i, call in enumerate(calls) if call.kind == "step"]
    assert not any(made.flags)
    assert np.max(np.abs(made.u[steps])) == computer.walker.torque_limit
    change = np.diff([made.u[i] for i in steps if calls[i].t < 0.3], axis=0)
    assert np.max(np.abs(change)) == pytest.approx(3e4 * 1.5e-3, rel=1e-12)


@pytest.mark.parametrize("name", ["NPD", "on a robot"])
def test_a_walk_by_the_exported_controller_is_the_same_walk(cases, name):
    computer, loaded, _ = cases(name)
    scenario, walker = CASES[name], computer.walker
    begin = start(scenario, RobotAndGait.of(scenario))
    runs = []
    for controller in (walker.controller, ba.ExportedController(loaded)):
        w = replace(walker, controller=controller)
        options = RunOptions(2.0, stop_after=("foot_strike", 2))
        runs.append(run_compiled(w, w.initial_state(*begin), ba.Mode(), ba.RK4(5e-4), options))
    one, other = runs
    assert one.status is other.status
    assert len(one.arcs) == len(other.arcs) == 2
    n = 2 * walker.plant.n
    for a, b in zip(one.arcs, other.arcs, strict=True):
        # an ulp of q is 1e-10 N m here (see proof), and the walk carries errors of the rates of 1e-12 rad/s
        np.testing.assert_allclose(a.x[-1][:n], b.x[-1][:n], rtol=0, atol=1e-10)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_measured_leaves_the_state_and_the_torque_and_then_none(cases, bad):
    _, loaded, calls = cases("NPD")
    for entry in ("t", "q", "v"):
        _, x = loaded.init(loaded.measured(*calls[0][1:4]))
        good = loaded.measured(*calls[1][1:4])
        flag, u = loaded.step(x, good)
        assert flag == OK
        broken = good.copy()
        broken[entry] = bad
        for _ in range(5):
            flag, held = loaded.step(x, broken)
            assert (flag, held.tolist()) == (NOT_MEASURED, u.tolist())
        assert loaded.touchdown(x, broken) == NOT_MEASURED
        assert x["step"] == 1
        assert not np.any(loaded.step(x, broken)[1])
        assert loaded.init(broken)[0] == NOT_MEASURED
        assert loaded.step(x, good)[0] == OK


def test_a_result_beyond_all_torques_and_numbers_of_any_size_are_safe(cases):
    _, loaded, calls = cases("NPD")
    _, x = loaded.init(loaded.measured(*calls[0][1:4]))
    flag, u = loaded.step(x, loaded.measured(*calls[1][1:4]))
    random = np.random.default_rng(0)
    seen = set()
    for _ in range(200):
        m = loaded.measured(0.1, *(random.choice([1e-310, 5e-324, 1e308, -1e200, 0.3], (2, 5))))
        flag, now = loaded.step(x, m)
        seen.add(flag)
        assert np.all(np.isfinite(now))
        assert flag == OK or now.tolist() in (u.tolist(), [0.0] * 4)
        u = now
    assert seen >= {NO_RESULT}


def test_an_initial_state_that_is_none_gives_no_torque(cases):
    _, loaded, calls = cases("NPD")
    m = loaded.measured(np.nan, calls[0].q, calls[0].v)
    flag, x = loaded.init(m)
    assert flag == NOT_MEASURED
    assert not np.any(loaded.step(x, m)[1])


class Own(Sensor):
    """A sensor of the user's own."""

    def laws(self, n, p, period):
        return ba.Sensors().laws(n, p, period)

    def start(self, k, q, v):
        return ba.Sensors().start(k, q, v)


def test_what_stands_in_the_way_is_named(tmp_path):
    walker = build(ba.Scenario("NPD", hardware="ideal"))
    for scenario, word in [
        (ba.Scenario("NPD"), "ContinuousTime"),
        (ba.Scenario("CLF-QP", hardware="ideal"), "CLFQPController has no laws"),
        (replace(walker, sensors=Own()), "sensor Own does not say"),
    ]:
        with pytest.raises(InputError, match=word):
            export_c(scenario, tmp_path / "out")
    for wrong, word in [({"prefix": "2nd"}, "prefix"), ({"real": "half"}, "float64")]:
        with pytest.raises(InputError, match=word):
            export_c(walker, tmp_path / "out", **wrong)
    assert not (tmp_path / "out").exists()


def test_a_folder_with_other_files_is_left_alone(tmp_path):
    export_c(CASES["NPD"], tmp_path / "new")
    before = {x.name: x.read_bytes() for x in (tmp_path / "new").iterdir()}
    export_c(CASES["NPD"], tmp_path / "new")
    assert {x.name: x.read_bytes() for x in (tmp_path / "new").iterdir()} == before
    (tmp_path / "new" / "mine.txt").write_text("mine")
    with pytest.raises(OutputError, match=r"mine\.txt"):
        export_c(CASES["NPD"], tmp_path / "new")
    with pytest.raises(OutputError, match="is a file"):
        export_c(CASES["NPD"], tmp_path / "new" / "mine.txt")


def test_without_a_compiler_it_is_said(cases, monkeypatch):
    _, loaded, _ = cases("NPD")
    monkeypatch.setattr(loading.shutil, "which", lambda name: None)
    assert "there is no C compiler" in loading.tried(loaded.source)
    with pytest.raises(InputError, match="there is no C compiler"):
        Loaded(loaded.source).functions  # noqa: B018


COMPILERS = ["gcc -std=c99", "g++ -x c++", *(["clang -std=c99"] if shutil.which("clang") else [])]
"""The first two are wherever packages are built; the third is asked where it is."""


@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize("real", ["double", "float"])
def test_no_compiler_warns(tmp_path, compiler, real):
    program, *flags = compiler.split()
    export_c(CASES["on a robot"], tmp_path / "c", prefix="leg")
    strict = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", f"-DLEG_REAL={real}"]
    command = [program, *flags, *strict, "-c", "-o", os.devnull]
    for name in ("leg.c", "main.c", "loop.c"):
        subprocess.run([*command, str(tmp_path / "c" / name)], check=True)


def test_the_program_under_sanitizers_prints_the_torques(tmp_path, cases):
    _, loaded, calls = cases("on a robot")
    for name, text in loaded.source.files.items():
        (tmp_path / name).write_text(text)
    flags = (*FLAGS, "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    loading.compiled(tmp_path, ["main.c", "controller.c"], tmp_path / "main", flags)
    lines, landed = [], 0
    for call in calls:
        if call.kind == "step":
            lines.append(" ".join(map(repr, [landed, call.t, *call.q.tolist(), *call.v.tolist()])))
        landed = int(call.kind == "touchdown")
    lines.append(lines[-1].replace(repr(calls[-1].t), "nan", 1))
    done = subprocess.run(
        [tmp_path / "main"], input="\n".join(lines), capture_output=True, text=True, check=True
    )
    printed = np.array([line.split() for line in done.stdout.splitlines()], dtype=float)
    assert len(printed) == len(lines)
    assert printed[:-1, 0].tolist() == [OK] * (len(lines) - 1)
    assert printed[-1, 0] == NOT_MEASURED
    before = [call.u for call in calls[:200] if call.kind == "step"]
    np.testing.assert_allclose(printed[: len(before), 1:], before, rtol=1e-9, atol=1e-9)


def test_differences_of_angles_and_what_they_are_made_of_stay_in_double():
    q, v, k = ca.SX.sym("q", 2), ca.SX.sym("v"), ca.SX.sym("K", 2)
    phase = k[0] * q[0]
    f = ca.Function("f", [k, ca.vertcat(q, v)], [ca.vertcat(q[1] - ca.sin(phase), v - phase)])
    wide = in_double(f, [True, True, False])
    codes = sorted(f.instruction_id(i) for i in wide)
    assert codes == sorted([ca.OP_MUL, ca.OP_SIN, ca.OP_SUB])


@pytest.mark.parametrize(
    ("controller", "least", "most"), [("ADRC", 0.1, 1.0), ("ADRC output", 0.0, 1e-4)]
)
def test_random_roundings_foretell_what_floats_do_to_a_walk(controller, least, most):
    scenario = ba.Scenario(controller, hardware="ideal", impacts=1)
    found = ripple(build(scenario), start(scenario, RobotAndGait.of(scenario)), impacts=1)
    assert 0.5 < found.single / found.predicted_single < 2.0
    assert 0.5 < found.double / found.predicted_double < 2.0
    assert least <= found.single / found.torque < most
    assert found.same_status
