"""An exported controller against Python, call by call over walks, and what its folder is like."""

import ctypes
import os
import re
import shutil
import subprocess
from dataclasses import replace

import casadi as ca
import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.deploy import loaded as loading
from biped_adrc.deploy.apart import TIMES, apart, walk
from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.export import export_c
from biped_adrc.deploy.loaded import FLAGS, NOT_MEASURED, OK, UNOPTIMISED, Loaded
from biped_adrc.deploy.records import fed, recorded
from biped_adrc.deploy.ripple import ripple
from biped_adrc.deploy.rounding import proof
from biped_adrc.deploy.source import source_of
from biped_adrc.engine.c_text import in_double
from biped_adrc.errors import InputError, OutputError
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.hybrid.status import Status
from biped_adrc.scenario.build import RobotAndGait, build, start
from tests.deploy.robot import PUSH, ROBOT

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
            flags = FLAGS if name == "on a robot" else UNOPTIMISED
            loaded = Loaded(source_of(computer), flags=flags)
            made[name] = computer, loaded, recorded(walk.walker, walk.trajectory)
        return made[name]

    return case


@pytest.mark.parametrize(
    ("name", "real"), [*((name, "float64") for name in CASES), ("on a robot", "float32")]
)
def test_a_call_differs_from_python_by_what_ulps_of_its_inputs_do(cases, name, real):
    computer, loaded, calls = cases(name)
    assert {"init", "step", "touchdown"} == {call.kind for call in calls}
    found = proof(computer, replace(loaded, real=real), calls, every=7)
    assert found.worst <= TIMES
    assert found.torque > 90.0


def test_the_last_torque_is_on_its_way_and_the_limits_are_kept(cases):
    computer, loaded, calls = cases("on a robot")
    made, slower = fed(loaded, calls), fed(replace(loaded, flags=UNOPTIMISED), calls)
    assert loaded.flags != UNOPTIMISED
    np.testing.assert_array_equal(made.u, slower.u)
    steps = [i for i, call in enumerate(calls) if call.kind == "step"]
    assert not any(made.flags)
    assert np.max(np.abs(made.u[steps])) == computer.walker.torque_limit
    change = np.diff([made.u[i] for i in steps if calls[i].t < 0.3], axis=0)
    assert np.max(np.abs(change)) == pytest.approx(3e4 * 1.5e-3, rel=1e-12)


def beside_python(name, loaded, computer, impacts):
    """How far walks of a case, by Python and by what is loaded, come apart."""
    begin = start(CASES[name], RobotAndGait.of(CASES[name]))
    options = RunOptions(2.0, stop_after=("foot_strike", impacts))
    return apart(computer, loaded, begin, options)


@pytest.mark.parametrize("name", ["Table I", "on a robot"])
def test_a_walk_by_the_exported_controller_is_the_same_walk(cases, name):
    computer, loaded, _ = cases(name)
    found = beside_python(name, loaded, computer, 2)
    assert len(found.run.arcs) == 2
    assert found.proved, found


@pytest.mark.parametrize("number", ["rotor[2]", "curve.stacked[4, 4]", "K_d[0]"])
def test_a_walk_shows_a_constant_that_is_wrong_by_1e_9(cases, number):
    computer, loaded, _ = cases("NPD")
    files = dict(loaded.source.files)
    line = next(x for x in files["controller.c"].splitlines() if f"{number} */" in x)
    value = re.search(r"-?[0-9.e-]+[0-9]", line)[0]
    files["controller.c"] = files["controller.c"].replace(
        line, line.replace(value, repr(float(value) * (1.0 + 1e-9)), 1)
    )
    wrong = replace(loaded, source=replace(loaded.source, files=files), flags=UNOPTIMISED)
    found = beside_python("NPD", wrong, computer, 1)
    assert found.same_end
    assert found.worst > 30.0 * TIMES


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


def test_no_difference_is_taken_over_a_sample_that_is_not_measured(cases):
    _, loaded, calls = cases("on a robot")
    rates = {}
    for bad in (range(40, 43), range(0)):
        x, made = loaded.init(loaded.measured(*calls[0][1:4]))[1], []
        for i, call in enumerate(calls[1:60]):
            flag, _ = loaded.step(x, loaded.measured(np.nan if i in bad else call.t, *call[2:4]))
            assert flag == (NOT_MEASURED if i in bad else OK)
            made.append(x["rate"].copy())
        rates[len(bad)] = np.array(made)
    assert np.array_equal(rates[3][43], rates[3][39])
    off = np.max(np.abs(rates[3] - rates[0]), axis=1)
    assert np.all(np.diff(off[43:]) < 0.0)


@pytest.mark.parametrize("name", ["NPD", "on a robot"])
def test_an_initial_state_that_is_none_is_zero_and_gives_no_torque(cases, name):
    _, loaded, calls = cases(name)
    m = loaded.measured(np.nan, calls[0].q, calls[0].v)
    x = np.frombuffer(bytearray(b"\xff" * loaded.state.itemsize), loaded.state)[0:1].reshape(())
    at = (ctypes.c_void_p(a.ctypes.data) for a in (x, m))
    assert loaded.functions["init"](*at) == NOT_MEASURED
    left = {field: x[field].tolist() for field in loaded.state.names if np.any(x[field] != 0)}
    assert left == {"step": 1, "without": 5}
    assert not np.any(loaded.step(x, m)[1])


def test_a_walk_that_runs_away_ends_as_that_of_python():
    scenario = ba.Scenario("NPD", period=1e-3, delay=2e-2, impacts=1)
    computer = Computer(build(scenario))
    loaded = Loaded(source_of(computer), flags=UNOPTIMISED)
    found = apart(computer, loaded, start(scenario, RobotAndGait.of(scenario)), RunOptions(1.0))
    assert found.run.status is Status.RAN_AWAY
    assert found.proved, found
    here = ba.walk_scenario(scenario).trajectory
    there = ba.walk_scenario(scenario, controller=ba.ExportedController(loaded)).trajectory
    assert (there.status, there.t_end) == (here.status, here.t_end)


@pytest.mark.parametrize("flag", loading.ERRORS)
def test_every_flag_ends_a_walk_with_the_status_of_its_name(cases, flag):
    computer, loaded, _ = cases("NPD")
    name = {NOT_MEASURED: "NOT_FINITE", 2: "NOT_FINITE", 3: "SINGULAR", 4: "RAN_AWAY"}[flag]
    begin = start(CASES["NPD"], RobotAndGait.of(CASES["NPD"]))

    class Failing(ba.ExportedController):
        def correct(self, s, m):
            return super()._kept(flag if m.t > 2.5e-3 else OK, self._state(s), self.output(s, m))

    run = walk(computer.walker, Failing(loaded), begin, RunOptions(1.0))
    assert run.status is Status[name]
    assert run.t_end == pytest.approx(3e-3)


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
    with pytest.raises(OutputError, match="other than it would be written"):
        export_c(CASES["touchdown noticed"], tmp_path / "new")
    assert {x.name: x.read_bytes() for x in (tmp_path / "new").iterdir()} == before
    (tmp_path / "new" / "main.c").write_text("changed by hand")
    with pytest.raises(OutputError, match=r"main\.c"):
        export_c(CASES["NPD"], tmp_path / "new")
    assert (tmp_path / "new" / "main.c").read_text() == "changed by hand"
    (tmp_path / "new" / "main.c").unlink()
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


COMPILERS = {"gcc": ["-std=c99"], "g++": ["-x", "c++"], "clang": ["-std=c99"]}
REQUIRED = os.environ.get("REQUIRED_COMPILERS", "").split()
"""They have to be there in CI; elsewhere those are asked that are."""


@pytest.mark.parametrize("program", [x for x in COMPILERS if x in REQUIRED or shutil.which(x)])
@pytest.mark.parametrize("real", ["double", "float"])
def test_no_compiler_warns(tmp_path, program, real):
    export_c(CASES["on a robot"], tmp_path / "c", prefix="leg")
    strict = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", f"-DLEG_REAL={real}"]
    command = [program, *COMPILERS[program], *strict, "-c", "-o", os.devnull]
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


def test_in_the_program_a_touchdown_that_is_not_measured_waits(tmp_path, cases):
    _, loaded, calls = cases("on a robot")
    for name, text in loaded.source.files.items():
        (tmp_path / name).write_text(text)
    loading.compiled(tmp_path, ["main.c", "controller.c"], tmp_path / "main", UNOPTIMISED)
    at = next(i for i, call in enumerate(calls) if call.kind == "touchdown")
    first, bad, good = calls[0], calls[at]._replace(t=np.nan), calls[at + 2]
    x = loaded.init(loaded.measured(*first[1:4]))[1]
    made = [loaded.step(x, loaded.measured(*call[1:4])) for call in (first, bad)]
    assert loaded.touchdown(x, loaded.measured(*good[1:4])) == OK
    made.append(loaded.step(x, loaded.measured(*good[1:4])))
    rows = [(0, first), (1, bad), (0, good)]
    lines = [" ".join(map(repr, map(float, (c.t, *c.q, *c.v)))) for _, c in rows]
    told = "\n".join(f"{landed} {line}" for (landed, _), line in zip(rows, lines, strict=True))
    done = subprocess.run(
        [tmp_path / "main"], input=told, capture_output=True, text=True, check=True
    )
    printed = [list(map(float, line.split())) for line in done.stdout.splitlines()]
    assert printed == [[flag, *u.tolist()] for flag, u in made]


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
    begin = start(scenario, RobotAndGait.of(scenario))
    found = ripple(build(scenario), begin, impacts=1, flags=UNOPTIMISED)
    assert 0.5 < found.single / found.predicted_single < 2.0
    assert 0.5 < found.double / found.predicted_double < 2.0
    assert least <= found.single / found.torque < most
    assert found.same_status
