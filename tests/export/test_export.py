"""An exported controller: what its functions do without a measurement, its program, its folder.

The C has three functions: init, step (at a sample instant; it returns a flag and the torque u) and touchdown.
`recorded(name)` gives the exported controller of a scenario, "NPD" (every 1 ms) or "on a robot" (encoders,
delay and detected touchdowns, every 1.5 ms), compiled and loaded, and all calls of it in a walk:
`calls[i][1:4]` are t, q and v.
"""

import errno
import os
import re
import shutil
import subprocess
from dataclasses import dataclass, replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import InputError, OutputError
from biped_adrc.core.tree import flatten
from biped_adrc.extras.export import export
from biped_adrc.extras.export import loaded as loading
from biped_adrc.extras.export.computer import Computer, Landing, Noticed
from biped_adrc.extras.export.export import export_c
from biped_adrc.extras.export.loaded import NOT_MEASURED, OK, ExportedController, Loaded, build_c
from biped_adrc.extras.export.source import source_of
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hybrid.status import Status
from biped_adrc.scenario.build import build
from tests.export.calls import SCENARIOS, recorded

NPD, ON_A_ROBOT = SCENARIOS.values()
SANITIZERS = ("-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_measured_leaves_the_state_and_the_torque_and_then_none(bad):
    """bad: in place of the time, an angle or a rate. The last torque is held for five samples without a
    measurement, and is zero from the sixth on; a touchdown then counts no step, and a good sample is taken
    again.
    """
    loaded, calls = recorded("NPD")
    # [1:4] of a call: its t, q and v
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


def test_no_difference_is_taken_over_a_sample_that_is_not_measured():
    """Samples 40 to 42 are lost: the rate of 39 stays until 43; what it is off from a walk without loss then
    decays, by the low-pass of the encoders.
    """
    loaded, calls = recorded("on a robot")
    rates = {}
    for bad in (range(40, 43), range(0)):
        x, made = loaded.init(loaded.measured(*calls[0][1:4]))[1], []
        for i, call in enumerate(calls[1:60]):
            flag, _ = loaded.step(x, loaded.measured(np.nan if i in bad else call.t, *call[2:4]))
            assert flag == (NOT_MEASURED if i in bad else OK)
            made.append(x["rate"].copy())
        rates[len(bad)] = np.array(made)  # by the number of lost samples, 3 or 0
    assert np.array_equal(rates[3][43], rates[3][39])
    off = np.max(np.abs(rates[3] - rates[0]), axis=1)
    assert np.all(np.diff(off[43:]) < 0.0)


def test_a_walk_that_runs_away_ends_as_that_of_python():
    """A delay of 20 ms makes the torque grow without limit; the C ends the walk at the same instant with the
    same status.
    """
    scenario = ba.Scenario("NPD", hardware={"period": 1e-3, "delay": 2e-2}, run={"impacts": 1})
    controller = ExportedController(source_of(Computer(build(scenario))))
    here = ba.walk_scenario(scenario).trajectory
    there = ba.walk_scenario(scenario, controller=controller).trajectory
    assert here.status is Status.RAN_AWAY
    assert (there.status, there.t_end) == (here.status, here.t_end)


def test_an_exported_controller_acts_at_sample_instants(biped, gait):
    """A walker is in continuous time by default, which the C cannot serve."""
    controller = ExportedController(recorded("NPD")[0].source)
    with pytest.raises(InputError, match=r"acts at sample instants; give timing=SampledTime"):
        ba.walk(ba.Walker(biped, controller), gait, 1)


@pytest.mark.parametrize("flag", loading.ERRORS)
def test_every_flag_ends_a_walk_with_the_status_of_its_name(flag):
    """The C returns the flag at the tick of 3 ms; no measurement (1) and no number (2) both end the walk as
    NOT_FINITE.
    """
    name = {NOT_MEASURED: "NOT_FINITE", 2: "NOT_FINITE", 3: "SINGULAR", 4: "RAN_AWAY"}[flag]

    class Failing(ExportedController):
        def correct(self, s, m):
            return super()._kept(flag if m.t > 2.5e-3 else OK, self._state(s), self.output(s, m))

    run = ba.walk_scenario(NPD, controller=Failing(recorded("NPD")[0].source)).trajectory
    assert run.status is Status[name]
    assert run.t_end == pytest.approx(3e-3)


def test_a_noticed_touchdown_is_seen_in_the_old_labels_with_the_offset_of_the_angles():
    """`impact` gets q+ = R q- + r, reads it as q- = R q+ + r first, and then relabels: R R = 1 and R r = -r. On
    a made-up robot, since no robot of the package has an r.
    """
    R, r = np.array([[0, 1, 0], [1, 0, 0], [0, 0, 1]]), np.array([0.3, -0.3, 0.0])
    inner = ba.Sensors(filter_time=2e-3)
    # three coordinates, two motors, 1 ms
    around = Noticed(inner, R, r).sampled(3, 2, 1e-3)
    sampled = inner.sampled(3, 2, 1e-3)
    q, v = np.array([0.1, -0.4, 0.7]), np.array([1.0, 2.0, -3.0])
    w = sampled.sense(sampled.start(q, v), q + 1e-3 * v, v)
    old = q + 2e-3 * v
    before = sampled.sense(w, old, v)
    wanted = sampled.impact(before, R @ old + r, R @ v, R @ sampled.reading(before, old, v)[1])
    # zeros: rates by the model, which it does not use; 1.0 below: the next sample is this measurement again
    found = around.impact(Landing(w, 0.0), R @ old + r, R @ v, np.zeros(3))
    np.testing.assert_allclose(flatten(found), flatten(Landing(wanted, 1.0)), rtol=1e-12)
    with pytest.raises(InputError, match="do not exchange in pairs"):
        Noticed(inner, R, np.abs(r))  # R r = r


def test_header_and_readme_say_what_the_caller_has_to_do():
    """Period, gait, where rates come from, the delay and the touchdown: each by the scenario's own hardware."""
    files = [recorded(name)[0].source.files for name in SCENARIOS]
    npd, robot = (" ".join(x["controller.h"].split()) for x in files)
    assert "every 1 ms: laws, gait" in npd
    assert "v are their rates. */" in npd
    assert "every 1.5 ms: laws, gait" in robot
    assert "It knows that torques act 2 ms late. How a touchdown is noticed is left to the" in robot
    of_rates = "Rates are differences of angles, filtered, and begin anew at a touchdown."
    assert (of_rates in npd, of_rates in robot) == (False, True)
    assert "v are their rates; init reads all of them, zero at rest; step reads none. */" in robot
    assert all("u are then u[1], u[0], u[3], u[2]." in x["README.md"] for x in files)


@dataclass(frozen=True)
class Share(ba.NPDController):
    """NPD's torque times a number that nothing checks."""

    share: float = 1.0

    def output(self, s, m):
        return self.share * super().output(s, m)


class Other(Sensor):
    """A sensor with another part on the computer."""

    def on_computer(self, period):
        return self


class Own(Sensor):
    """A sensor of the user's own."""

    def reading(self, w, q, v):
        return q, v


def test_a_scenario_without_c_is_refused_with_the_reason(tmp_path):
    """Continuous time, a solver that has no C, sensors that do not say what of them is software or say
    something else than encoders, NaN in a number; then prefixes of names that are none in C or clash with
    others, and an unknown type of number. No file is written.
    """
    walker = build(ba.Scenario("NPD", hardware="ideal"))
    share = Share(walker.controller.reference, share=np.nan)
    for scenario, word in [
        (ba.Scenario("NPD"), "ContinuousTime"),
        (
            ba.Scenario("CLF-QP", hardware="ideal"),
            "cannot be compiled: it solves a quadratic program",
        ),
        (ba.Scenario("output NPD", hardware="ideal"), "cannot be compiled: it asks LAPACK"),
        (replace(walker, sensors=Own()), "sensor Own does not say"),
        (replace(walker, sensors=Other()), "the sensors are Other, expected Sensors or None"),
        (replace(walker, controller=share), r"parameter .*share of the scenario is NaN"),
    ]:
        with pytest.raises(InputError, match=word):
            export_c(scenario, tmp_path / "out")
    # no name in C; the name of a file of the export; a name of POSIX with _OK behind it
    wrong = [("prefix", "2nd", "prefix"), ("prefix", "main", "main.c"), ("prefix", "x", "X_OK")]
    for name, value, word in [*wrong, ("real", "half", "float64")]:
        with pytest.raises(InputError, match=word):
            export_c(walker, tmp_path / "out", **{name: value})
    assert not (tmp_path / "out").exists()


def test_a_folder_with_other_files_is_left_alone(tmp_path):
    """To write the same export again is allowed; another export, a file changed by hand, a link and a file of
    the user's are refused by name, and stay.
    """
    new = tmp_path / "new"
    export_c(NPD, new, fmu=True)
    before = {x.name: x.read_bytes() for x in new.iterdir()}
    subprocess.run(["make", "-s", "-C", new], check=True)
    subprocess.run(["make", "-s", "-C", new, "float"], check=True)
    export_c(NPD, new)  # what make has built is no file of somebody else
    assert {x.name: x.read_bytes() for x in new.iterdir() if x.name != "main"} == before
    # another scenario into the same folder
    with pytest.raises(OutputError, match="other than it would be written"):
        export_c(ON_A_ROBOT, new)
    (new / "main.c").write_text("changed by hand")
    with pytest.raises(OutputError, match=r"main\.c"):
        export_c(NPD, new)
    assert (new / "main.c").read_text() == "changed by hand"
    (new / "main.c").unlink()
    (new / "main.c").symlink_to("nowhere")
    with pytest.raises(OutputError, match=r"main\.c"):
        export_c(NPD, new)
    (new / "main.c").unlink()
    (new / "mine.txt").write_text("mine")
    with pytest.raises(OutputError, match=r"mine\.txt"):
        export_c(NPD, new)
    # places where no folder can be made
    for name, word in [("new/mine.txt", "Not a directory"), (300 * "a", "too long")]:
        with pytest.raises(OutputError, match=word):
            export_c(NPD, tmp_path / name)


@pytest.mark.parametrize(("name", "grows"), [("ADRC", True), ("NPD", False)])
def test_the_growth_is_that_of_two_controllers_beside_one_motion(name, grows, gait, biped):
    """Two states of a controller on the same motion, each with its own torque, part at the rate `growth`, which
    is an eigenvalue of the linear map from tick to tick.

    Those of ADRC part exponentially, measured over 399 periods of 1 ms; a PD law has no state that could grow.
    """
    computer = Computer(build(ba.Scenario(name, hardware={"period": 1e-3})))
    law, (q, v) = computer.alone.law, gait.start(biped)
    m = computer.alone.measure(0.0, q, v, ba.Mode())
    states, apart = [law.initial_state(m), law.initial_state(m)], []
    states[1] = states[1] + 1e-3
    for _ in range(600):
        corrected = [law.correct(s, m) for s in states]
        states = [law.predict(s, m, law.output(s, m)) for s in corrected]
        apart.append(np.linalg.norm(states[1] - states[0]))
    found = computer.growth(q, v)
    assert (found > 50.0) == grows
    if grows:
        assert found == pytest.approx(np.log(apart[-1] / apart[200]) / 0.399, rel=0.05)


def test_without_a_compiler_or_room_to_compile_the_c_is_written_and_it_is_said(
    tmp_path, monkeypatch
):
    """Monkeypatches stand for a full disk, a machine without a name in FMI, and a computer without a C
    compiler; text that does not compile is refused with the compiler's words.
    """

    def full(*_, **__):
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(loading.tempfile, "TemporaryDirectory", full)
        with pytest.raises(OutputError, match=r"No space left on device.*TMPDIR"):
            export_c(NPD, tmp_path / "new", fmu=True)
    assert (tmp_path / "new" / "controller.c").exists()
    source = export_c(NPD, tmp_path / "new")
    assert repr(source).startswith("Source(controller.h, controller.c, main.c, Makefile, README.md")
    with (
        pytest.raises(InputError, match=r"does not compile a\.c: a\.c:1:"),
        build_c({"a.c": "int"}, ["a.c"]),
    ):
        pass
    with monkeypatch.context() as patch:
        patch.setattr(export.platform, "machine", lambda: "abacus")
        assert re.fullmatch("FMI 2.0 has no name for .* on abacus", export.without_binary())
    monkeypatch.setattr(loading.shutil, "which", lambda name: None)
    assert "there is no C compiler" in loading.tried(source)
    with pytest.raises(InputError, match="there is no C compiler"):
        Loaded(source).functions  # noqa: B018


COMPILERS = {"gcc": ["-std=c99"], "g++": ["-x", "c++"], "clang": ["-std=c99"]}
REQUIRED = os.environ.get("REQUIRED_COMPILERS", "").split()
"""They have to be there in CI; elsewhere those are asked that are."""


@pytest.fixture(scope="module")
def legs(tmp_path_factory):
    """A folder with an export whose names begin with `leg` in place of the default."""
    folder = tmp_path_factory.mktemp("legs") / "c"
    export_c(ON_A_ROBOT, folder, prefix="leg")
    return folder


@pytest.mark.parametrize("program", [x for x in COMPILERS if x in REQUIRED or shutil.which(x)])
@pytest.mark.parametrize("real", ["double", "float"])
def test_no_compiler_warns(legs, program, real):
    """C99 and C++, in double and float, with all warnings as errors; `leg` is another prefix of the names than
    the default.
    """
    strict = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", f"-DLEG_REAL={real}"]
    command = [program, *COMPILERS[program], *strict, "-c", "-o", os.devnull]
    for name in ("leg.c", "main.c"):
        subprocess.run([*command, str(legs / name)], check=True)


@pytest.fixture(scope="module")
def program():
    """The example's program of a robot's controller, under sanitizers."""
    files = recorded("on a robot")[0].source.files
    with build_c(files, ["main.c", "controller.c"], *SANITIZERS) as (path, said):
        assert not said
        yield path


def printed(program, lines):
    """The exit code of a program, and the numbers that it prints for lines."""
    done = subprocess.run([program], input="\n".join(lines), capture_output=True, text=True)
    return done.returncode, [list(map(float, line.split())) for line in done.stdout.splitlines()]


def line_of(landed, call):
    return " ".join(map(repr, [landed, call.t, *call.q.tolist(), *call.v.tolist()]))


def test_the_program_prints_the_torques_bit_for_bit(program):
    """`program` reads lines "landed t q v", where landed = 1 follows a touchdown, and prints "flag u" of
    `step`: the torques of the recorded walk. An empty line is skipped; at a time of NaN the torque is held.
    """
    _, calls = recorded("on a robot")
    lines, wanted, landed = [], [], 0
    for call in calls:
        if call.kind == "step":
            lines.append(line_of(landed, call))
            wanted.append([OK, *call.u.tolist()])
        landed = int(call.kind == "touchdown")
    code, made = printed(program, [*lines, "", line_of(0, calls[-1]._replace(t=np.nan))])
    assert (code, made) == (0, [*wanted, [NOT_MEASURED, *wanted[-1][1:]]])


@pytest.mark.parametrize("bad", ["one", "0 0.1", "{} 1", "{} x", "0 nan"])
def test_the_program_ends_at_a_line_that_is_no_sample(program, bad):
    """bad: no number, too few, one too many or a word too many ({} is the good line), too few with a NaN.
    Nothing is printed for it or for what follows, and the exit code is 9.
    """
    good = line_of(0, recorded("on a robot")[1][0])
    code, made = printed(program, [good, bad.format(good), good])
    assert (code, len(made)) == (9, 1)
