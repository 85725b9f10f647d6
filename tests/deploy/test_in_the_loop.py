"""The exported controller as a process of its own: in lock step, by the clock on the wall, and how it ends."""

import signal
import socket
import struct
import subprocess
from dataclasses import dataclass, field, replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.cli.loop import _print
from biped_adrc.control.base import Controller
from biped_adrc.deploy import loaded as loading
from biped_adrc.deploy import remote
from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.datagram import INIT, STEP, STOP, TOUCHDOWN, Answer, answer_of, measurement
from biped_adrc.deploy.in_the_loop import same_motion
from biped_adrc.deploy.loaded import FLAGS, NOT_MEASURED, OK
from biped_adrc.deploy.process import HOST, built, controller_process, started
from biped_adrc.deploy.remote import LockStep, RealTime
from biped_adrc.deploy.source import source_of
from biped_adrc.errors import InputError, SimulationError
from biped_adrc.scenario.build import build
from tests.deploy.robot import PUSH, ROBOT

PERIOD = 1.5e-3
ON_ROBOT = {**ROBOT, "pushes": PUSH, "impacts": 1}
WALKS = {plant: ba.Scenario("LESO", plant=plant, **ON_ROBOT) for plant in ("rigid", "mujoco")}
QUICK = (*FLAGS, "-O0")
STRICT = (*QUICK, "-fsanitize=address,undefined", "-fno-sanitize-recover=all")


@pytest.fixture(scope="module")
def loaded():
    """The exported controller, called in this process."""
    return ba.Loaded(source_of(Computer(build(WALKS["rigid"]))), flags=QUICK)


@pytest.fixture(scope="module")
def program(loaded, tmp_path_factory):
    """The program of loop.c, under sanitizers."""
    return str(built(loaded.source, tmp_path_factory.mktemp("loop"), STRICT))


@pytest.fixture
def process(program, loaded):
    """A running process."""
    with started([program, "0", "60"], loaded.source.n) as process:
        yield process


@pytest.fixture(scope="module")
def offline(loaded):
    """The walk without a process, by plant."""
    made = {}

    def walk(plant):
        if plant not in made:
            exported = ba.ExportedController(loaded)
            made[plant] = ba.walk_scenario(WALKS[plant], controller=exported)
        return made[plant]

    return walk


@pytest.mark.parametrize("plant", WALKS)
def test_a_walk_in_lock_step_is_the_walk_offline(process, offline, plant):
    walk = ba.walk_scenario(WALKS[plant], controller=LockStep(process))
    assert len(walk.trajectory.arcs) == 1
    assert walk.trajectory.status.ok
    assert same_motion(walk, offline(plant))
    assert process.number > 250


def test_motions_are_the_same_where_no_bit_of_time_state_and_torque_differs(offline):
    walk = offline("rigid")
    (arc,) = walk.trajectory.arcs

    def with_arc(**changed):
        return replace(walk, trajectory=replace(walk.trajectory, arcs=(replace(arc, **changed),)))

    n, p = 2 * walk.walker.plant.n, walk.walker.plant.p
    for place in (0, n - 1, -p, -1):
        other = arc.x.copy()
        other[7, place] = np.nextafter(other[7, place], 9.0)
        assert not same_motion(walk, with_arc(x=other))
    other = arc.x.copy()
    other[:, n] += 1.0  # of the controller, which is elsewhere
    assert same_motion(walk, with_arc(x=other))
    assert not same_motion(walk, with_arc(t=arc.t + 1e-15))
    fell = replace(walk, trajectory=replace(walk.trajectory, status=ba.Status.FELL))
    assert not same_motion(walk, fell)


@dataclass(frozen=True)
class Held(Controller):
    """The exported controller, whose torque of the instant before goes on at some instants [s]."""

    inner: ba.ExportedController
    missed: frozenset[float]

    def initial_state(self, m):
        return np.concatenate((self.inner.initial_state(m), np.zeros(len(m.q_b))))

    def correct(self, s, m):
        p = len(m.q_b)
        inner = self.inner.correct(s[:-p], m)
        u = s[-p:] if m.t in self.missed else self.inner.output(inner, m)
        return np.concatenate((inner, u))

    def output(self, s, m):
        return s[len(s) - len(m.q_b) :]

    def jump(self, s, after, swap):
        p = len(swap)
        return np.concatenate((self.inner.jump(s[:-p], after, swap), s[-p:][swap]))


def held(plant, loaded, missed, **more):
    """The walk offline with the torque held at some instants [s]."""
    controller = Held(ba.ExportedController(loaded), frozenset(missed.tolist()))
    scenario = ba.Scenario(**{**WALKS[plant].record(), **more})
    return ba.walk_scenario(scenario, controller=controller)


def test_a_walk_in_real_time_is_the_one_with_the_torque_held_where_answers_are_missed(
    process, loaded
):
    controller = RealTime(process, deadline=PERIOD)
    walk = ba.walk_scenario(WALKS["rigid"], controller=controller)
    times = controller.times
    assert same_motion(walk, held("rigid", loaded, times.missed))
    np.testing.assert_allclose(times.t, PERIOD * np.arange(len(times.t)), rtol=0, atol=1e-12)
    assert np.all(times.sent >= 0.0)
    assert np.all(times.trip[~np.isnan(times.trip)] <= PERIOD)
    assert set(times.overrun) <= set(times.t)


@dataclass
class Double:
    """A controller elsewhere with a clock of its own: late at some steps, and the plant slow after others."""

    loaded: ba.Loaded
    late: dict[int, float]
    slow: dict[int, float]
    clock: float = 0.0
    number: int = 0
    steps: int = 0
    busy: float = 0.0
    under_way: list[tuple[float, Answer]] = field(default_factory=list)
    sent: list[tuple[int, float]] = field(default_factory=list)

    def send(self, kind, t, q, v):
        self.number += 1
        self.sent.append((kind, self.clock - t))
        m, u, after = self.loaded.measured(t, q, v), np.zeros(4), 1e-4
        if kind == INIT:
            flag, self.x = self.loaded.init(m)
        elif kind == TOUCHDOWN:
            flag = self.loaded.touchdown(self.x, m)
        else:
            self.steps += 1
            flag, u = self.loaded.step(self.x, m)
            after = self.late.get(self.steps, after)
        self.under_way.append((self.clock + after, Answer(kind, self.number, flag, 1, 0, u)))
        return self.number

    def receive(self, until):
        if not self.under_way or self.under_way[0][0] > until:
            self.clock = max(self.clock, until)
            return None
        at, answer = self.under_way.pop(0)
        self.clock = max(self.clock, at)
        if answer.number == self.number and answer.kind == STEP:
            self.busy = self.slow.get(self.steps, 0.0)
        return answer

    def now(self):
        at, self.clock, self.busy = self.clock, self.clock + self.busy, 0.0
        return at

    def pause(self, until):
        self.clock = max(self.clock, until)


def test_of_a_late_controller_the_misses_are_known_and_the_last_torque_goes_on(loaded):
    late = {1: 1.1e-3, 40: 1.2e-3, 41: 2.9e-3, 200: 1.4e-3, 279: 1.3e-3}
    double = Double(loaded, late, {})
    controller = RealTime(double, deadline=1e-3)
    two = ba.Scenario(**{**WALKS["rigid"].record(), "impacts": 2})
    walk = ba.walk_scenario(two, controller=controller)
    times, at = controller.times, np.array(sorted((*late, 42))) - 1  # 42 comes behind 41
    assert times.missed.tolist() == times.t[at].tolist()
    assert times.missed[-1] == walk.trajectory.arcs[1].t[0]  # and left is right from there on
    assert times.without_result == 0
    others = np.delete(np.arange(len(times.t)), at)
    np.testing.assert_allclose(times.trip[others], 1e-4, rtol=0, atol=1e-12)
    np.testing.assert_allclose(times.sent, 0.0, rtol=0, atol=1e-12)
    np.testing.assert_allclose(times.reached[2:39], 1e-4 - PERIOD, rtol=0, atol=1e-12)
    assert len(times.overrun) == 0
    assert same_motion(walk, held("rigid", loaded, times.missed, impacts=2))
    assert not same_motion(walk, held("rigid", loaded, times.missed[1:], impacts=2))
    kinds, starts = zip(*double.sent, strict=True)
    assert sorted(kinds)[-2:] == [TOUCHDOWN, TOUCHDOWN]
    np.testing.assert_allclose(starts[1:], starts[1], rtol=0, atol=1e-12)


def test_a_slow_plant_is_counted_apart_and_catches_up(loaded, offline):
    controller = RealTime(Double(loaded, {}, {10: 2.4 * PERIOD}), deadline=1e-3)
    walk = ba.walk_scenario(WALKS["rigid"], controller=controller)
    times, answered = controller.times, 1e-4
    behind = 2.4 * PERIOD + answered - PERIOD * np.array([1.0, 2.0]) + answered * np.array([0, 1])
    assert times.overrun.tolist() == times.t[10:12].tolist()
    np.testing.assert_allclose(times.reached[10:12], behind, rtol=0, atol=1e-9)
    np.testing.assert_allclose(times.sent[10:12], behind, rtol=0, atol=1e-9)
    assert len(times.missed) == 0
    assert same_motion(walk, offline("rigid"))


def exchange(process, data):
    """The next answer after some bytes."""
    process.line.send(data)
    return answer_of(process.line.recv(1000))


def test_datagrams_that_are_none_are_ignored_and_counted(process, loaded):
    n = loaded.source.n
    q, v = np.linspace(0.1, 0.5, n), np.zeros(n)
    process.line.settimeout(10.0)
    before = exchange(process, measurement(STEP, 7, 0.0, q, v))
    assert (before.number, before.flag, before.u.tolist()) == (7, NOT_MEASURED, [0.0] * 4)
    good, later = measurement(INIT, 8, 0.0, q, v), measurement(INIT, 100, 0.0, q, v)
    for bad in (
        b"",
        later[:-1],
        later + b"\0",
        b"X" + later[1:],
        later[:4] + b"\2" + later[5:],  # version
        later[:6] + b"\5" + later[7:],  # kind
        later[:6] + b"\0" + later[7:],
        later[:12] + b"\1" + later[13:],  # size
        measurement(INIT, 7, 0.0, q, v),  # a second copy
        measurement(INIT, 2**32 + 6, 0.0, q, v),  # overtaken
    ):
        process.line.send(bad)
    begun = exchange(process, good)
    assert (begun.number, begun.flag) == (8, OK)
    step = exchange(process, measurement(STEP, 9, 0.0, q, v))
    assert (step.kind, step.number, step.flag, step.support, step.ignored) == (STEP, 9, OK, 1, 10)
    assert np.max(np.abs(step.u)) > 1.0
    nan = exchange(process, measurement(STEP, 10, np.nan, q, v))
    assert (nan.flag, nan.u.tolist()) == (NOT_MEASURED, step.u.tolist())
    after = exchange(process, measurement(TOUCHDOWN, 11, PERIOD, q, v))
    assert (after.flag, after.support) == (OK, 2)
    swapped = [step.u[i] for i in build(WALKS["rigid"]).swap]
    assert after.u.tolist() == swapped
    for number in (2**31, 2**32 - 1, 2**32 + 1):  # counted modulo 2**32
        answer = exchange(process, measurement(STEP, number, PERIOD, q, v))
        assert (answer.number, answer.flag) == (number % 2**32, OK)
    stop = exchange(process, measurement(STOP, 2, 0.0, q, v))
    assert (stop.kind, stop.u.tolist()) == (STOP, [0.0] * 4)
    assert process.running.wait(10.0) == 0


@dataclass(frozen=True)
class Interrupted(Controller):
    """A controller at whose 20th sample instant something happens."""

    inner: LockStep
    happens: object

    def initial_state(self, m):
        return self.inner.initial_state(m)

    def correct(self, s, m):
        if self.inner.channel.number == 20:
            self.happens()
        return self.inner.correct(s, m)

    def output(self, s, m):
        return self.inner.output(s, m)


def kill(running, patch):
    running.kill()


def stop(running, patch):
    running.send_signal(signal.SIGSTOP)
    patch.setattr(remote, "PATIENCE", 0.05)


def interrupt(running, patch):
    raise KeyboardInterrupt


@pytest.mark.parametrize(
    ("happens", "error", "words"),
    [
        (kill, SimulationError, "has ended.*exit code -9"),
        (stop, SimulationError, "not answered for 0.05 s"),
        (interrupt, KeyboardInterrupt, "^$"),
    ],
)
def test_whatever_happens_no_process_stays(program, loaded, monkeypatch, happens, error, words):
    with pytest.raises(error, match=words), started([program], loaded.source.n) as process:  # noqa: PT012
        controller = Interrupted(LockStep(process), lambda: happens(process.running, monkeypatch))
        ba.walk_scenario(WALKS["rigid"], controller=controller)
    assert process.running.poll() is not None
    assert process.line.fileno() == -1


def test_a_process_that_ends_with_a_datagram_unread_is_noticed(process):
    process.running.send_signal(signal.SIGSTOP)
    process.send(STEP, 0.0, np.zeros(5), np.zeros(5))
    process.running.kill()
    with pytest.raises(SimulationError, match=r"has ended.*exit code -9"):
        process.receive(process.now() + 10.0)


def test_an_answer_in_another_layout_is_none():
    good = struct.pack("<4sHHIIIIQ2d", b"BADR", 1, STEP, 7, 48, OK, 3, 5, 1.5, -2.0)
    answer = answer_of(good)
    assert answer[:-1] == (STEP, 7, OK, 3, 5)
    assert answer.u.tolist() == [1.5, -2.0]
    for bad in (b"", good[:-1], good[:-8], good + bytes(8), b"X" + good[1:], good[:4] + good[5:]):
        assert answer_of(bad) is None


def test_it_ends_when_told_by_a_signal_or_by_silence_or_without_its_parent(program, tmp_path):
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    asked = [subprocess.Popen([program], **pipes) for _ in range(2)]
    silent = subprocess.Popen([program, "0", "1"], **pipes)
    for running, number in zip(asked, (signal.SIGTERM, signal.SIGINT), strict=True):
        running.stdout.readline()
        running.send_signal(number)
        assert running.communicate(timeout=20.0)[1] == ""
        assert running.returncode == 0
    orphan = f"mkfifo port; {program} 0 600 > port & read x < port"
    done = subprocess.run(
        ["sh", "-c", orphan], cwd=tmp_path, stderr=subprocess.PIPE, text=True, timeout=20.0
    )
    assert done.stderr == ""  # and it has been closed, by the child of a parent that is gone
    assert "no datagram for 1 s" in silent.communicate(timeout=20.0)[1]
    for words in (["x"], ["65536"], ["-1"], ["0", "0"], ["0", "1", "2"], [""]):
        wrong = subprocess.run([program, *words], stderr=subprocess.PIPE, text=True)
        assert wrong.returncode == 2
        assert "usage" in wrong.stderr


def test_a_port_that_is_taken_is_said(program, loaded):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind((HOST, 0))
        port = other.getsockname()[1]
        with (
            pytest.raises(InputError, match=rf"listen on {HOST}: no socket: .*in use"),
            started([program, str(port)], loaded.source.n),
        ):
            pass


def test_a_walk_goes_on_from_where_the_process_is_alone(process, loaded):
    walker, controller = build(WALKS["rigid"]), LockStep(process)
    still = np.zeros(5)
    m = walker.measure(0.0, still, still, ba.Mode())
    first = controller.correct(controller.initial_state(m), m)
    second = controller.correct(first, m)
    with pytest.raises(InputError, match="cannot go back"):
        controller.correct(first, m)
    assert controller.correct(second, m)[0] == process.number


def test_a_scenario_in_the_loop_with_touchdowns_to_be_noticed(capsys):
    found = ba.in_the_loop(
        ba.Scenario("DOB", hardware="rabbit", counts=1e6, impacts=2, touchdown="kinematics"),
        real_time=True,
    )
    assert found.same_in_lock_step
    assert len(found.lock_step.trajectory.arcs) == 2
    _print(found)
    said = capsys.readouterr().out
    assert "lock step: the same walk as in this process, bit for bit" in said
    assert f"{len(found.times.t)} sample instants: {len(found.times.missed)} answers" in said
    if len(found.times.missed) == 0:
        assert same_motion(found.offline, found.real_time)


def test_what_cannot_be_in_the_loop_is_said(monkeypatch, loaded):
    scenario = ba.Scenario("NPD", hardware="ideal")
    for wrong in (0.0, 2e-3, float("nan")):
        with pytest.raises(InputError, match=r"at most the period of 0\.001 s"):
            ba.in_the_loop(scenario, deadline=wrong)
    monkeypatch.setattr(loading.shutil, "which", lambda name: None)
    with (
        pytest.raises(InputError, match="there is no C compiler"),
        controller_process(loaded.source),
    ):
        pass
