"""Walks moved on by one sample: those of their scenarios, alone or side by side, pushed from outside.

A Stepper holds walks and moves each on to its next sample instant; `why` says why machine code does not move
them, and is empty where it does. moved(stepper, samples, **inputs) moves so many samples under the same inputs;
largest(a, b) is the largest difference of two arrays.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.instant_signals import signals_at
from biped_adrc.core.errors import InputError

NPD = ba.Scenario("NPD", hardware={"period": 1e-3}, run={"impacts": 2})
TOUCHDOWN = NPD.replace(
    hardware={"profile": "rabbit", "touchdown": {"name": "faulty"}, "delay": 0.0015}
)
IN_PYTHON = NPD.replace(controller="CLF-QP", run={"impacts": 1})
WAITING = NPD.replace(ground="mujoco", hardware={"delay": 0.0004}, run={"impacts": 1})
OTHERS = (NPD.replace(controller="LESO"), None), (NPD, ba.Limits())
U = np.array([4.0, -3.0, 2.0, 5.0])


@dataclass(frozen=True)
class InPython(ba.Disturbance):
    """A push that has no machine code."""

    def torque(self, t, step, t_start, q, v):
        return np.array([0.0, 3.0, 0.0, 0.0, 0.0]) if v[0] > 0.0 else np.zeros(5)


def moved(stepper, samples, **inputs):
    """The samples of so many sample instants, under the same inputs at each and of all walks."""
    rows = {name: np.tile(x, (len(stepper.walkers), 1)) for name, x in inputs.items()}
    return [stepper.step(**rows) for _ in range(samples)]


def largest(a, b):
    """The largest difference between entries of two arrays."""
    return float(np.max(np.abs(a - b)))


@pytest.mark.parametrize("name", ["NPD", "TOUCHDOWN", "IN_PYTHON"])
def test_a_walk_is_that_of_its_scenario_at_every_sample(name):
    """A Stepper moves a walk by one sample at a time; at each sample instant its state is that of the whole
    simulated walk, and its single supports are judged alike. name: NPD in machine code; TOUCHDOWN, noticed
    late, with a delay; IN_PYTHON, a controller without machine code, for which `why` has the reason.
    """
    s = globals()[name]
    walk, stepper = ba.walk_scenario(s), ba.Stepper(s, within=ba.Limits())
    sample, count, over = stepper.reset(), 0, []
    assert bool(stepper.why) is (name == "IN_PYTHON")
    for arc in walk.trajectory.arcs:
        while sample.step[0] == arc.mode.step and sample.t[0] < arc.t[-1]:
            row = int(np.searchsorted(arc.t, sample.t[0]))
            assert arc.t[row] == sample.t[0]
            size = None if row else 10  # an arc begins after its sample instant
            assert largest(arc.x[row][:size], sample.x[0, :size]) < 1e-12
            sample, count = stepper.step(), count + 1
            over += stepper.over
    assert count > 300
    judged = walk.feasible_within(ba.Limits()).supports
    assert [i for i, _ in over] == [0] * walk.impacts
    for (_, ours), theirs in zip(over, judged, strict=False):
        for number in (
            "step",
            "duration",
            "mean_friction",
            "scuffing",
            "peak_torque",
            "impulse_ratio",
        ):
            assert getattr(ours, number) == pytest.approx(getattr(theirs, number), rel=1e-9), number
    assert sample.status[0] is ba.Status.COMPLETED


def test_a_single_support_on_soft_ground_is_judged_as_in_the_whole_walk():
    """On MuJoCo's ground the single support that a Stepper judges has the numbers of the simulated walk. Both
    end after 0.06 s, as stalled.
    """
    s = WAITING.replace(run={"max_step_time": 0.06})
    stepper = ba.Stepper(s, within=ba.Limits())
    stepper.reset()
    while not stepper.over:
        stepper.step()
    ((_, ours),) = stepper.over
    theirs = ba.walk_scenario(s).feasible_within(ba.Limits()).supports[0]
    for number in ("duration", "mean_friction", "scuffing", "peak_torque", "impulse_ratio"):
        assert getattr(ours, number) == pytest.approx(getattr(theirs, number), rel=1e-9), number


@pytest.mark.parametrize("restart", [True, False])
@pytest.mark.parametrize("in_python", [False, True], ids=["compiled", "Python"])
def test_the_clock_starts_again_at_an_impact_or_goes_on(biped, gait, restart, in_python):
    """Sample instants are t0 + k T: with `restart` t0 is the time of the last impact, else 0. The impact is at
    no multiple of T = 7 ms, by more than 1 % of T, so that both clocks differ.
    """
    T, push = 7e-3, InPython() if in_python else None
    timing = ba.SampledTime(T, restart=restart)
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), push, timing=timing)
    strike = ba.walk(walker, gait, 1).trajectory.events()[0].t
    stepper = ba.Stepper(walker)
    stepper.reset(start=gait.start(biped))
    assert bool(stepper.why) is in_python
    samples = [stepper.step() for _ in range(70)]
    t = np.array([sample.t[0] for sample in samples])
    after = np.array([sample.step[0] for sample in samples]) == 2
    assert 5 < np.count_nonzero(after) < 65
    assert abs((strike / T + 0.5) % 1.0 - 0.5) > 0.01
    count = np.arange(1, 71) * T
    assert t[~after] == pytest.approx(count[~after], abs=1e-12)
    expected = strike + count[: np.count_nonzero(after)] - T if restart else count[after]
    assert t[after] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("s", [NPD, IN_PYTHON, WAITING], ids=["NPD", "CLF-QP", "MuJoCo"])
def test_save_and_restore_repeat_exactly(s):
    """A saved walk, restored in its own place and in another one, goes on to the same states to the last bit;
    40 samples of 1 ms in all.
    """
    stepper = ba.Stepper(s, 2)
    stepper.reset(seed=3)
    moved(stepper, 20, torque=U)
    state = stepper.save(0)
    first = moved(stepper, 20, force=[5.0, -3.0])
    stepper.restore(0, state)
    stepper.restore(1, state)
    for one, other in zip(first, moved(stepper, 20, force=[5.0, -3.0]), strict=True):
        assert np.array_equal(one.x[0], other.x[0])
        assert np.array_equal(other.x[0], other.x[1])
    assert other.t[0] == other.t[1] == pytest.approx(0.04)


def test_many_walks_are_single_ones_bit_for_bit():
    """Walk i of many with the seed 5 is a single one with the seed 5 + i, under the same random torques and
    forces. 450 samples pass the first impact, and different masses make the walks differ.
    """
    s, rng = NPD.replace(errors={"mass_width": 0.05}), np.random.default_rng(0)
    many, single = ba.Stepper(s, 3), [ba.Stepper(s) for _ in range(3)]
    rows = [many.reset(seed=5)] + [one.reset(seed=5 + i) for i, one in enumerate(single)]
    for _ in range(450):
        for i, alone in enumerate(rows[1:]):
            assert all(np.array_equal(x[i], y[0]) for x, y in zip(rows[0], alone, strict=True))
        u, F = rng.normal(0.0, 3.0, (3, 4)), rng.normal(0.0, 5.0, (3, 2))
        rows = [many.step(u, F)]
        rows += [one.step(u[i : i + 1], F[i : i + 1]) for i, one in enumerate(single)]
    assert rows[0].step.max() == 2
    assert largest(rows[0].x[0], rows[0].x[1]) > 1e-3


PUSHES = {
    "torque": (ba.TorquePulse([*U, 0.0], start=0.01, stop=0.05), {"torque": U}),
    "force": (
        lambda plant: ba.OnLink(
            plant,
            plant.description.trunk,
            ba.TorquePulse([20.0, -30.0, 0.0], start=0.01, stop=0.05),
        ),
        {"force": [20.0, -30.0]},
    ),
}


@pytest.mark.parametrize("in_python", [False, True], ids=["compiled", "Python"])
@pytest.mark.parametrize("name", PUSHES)
def test_an_input_is_the_same_push_as_a_disturbance(biped, gait, name, in_python):
    """A torque, or a force on the trunk, as an input of samples 10 to 49 (1 ms) moves the walk as a pulse from
    0.01 to 0.05 s does, in machine code and, beside a disturbance that has none, in Python.
    """
    push, inputs = PUSHES[name]
    push = push(biped) if callable(push) else push
    law = ba.NPDController(gait.constraint)
    alone = ba.Walker(biped, law, timing=ba.SampledTime(1e-3))
    if in_python:
        alone = replace(alone, disturbance=InPython())
    pushed = replace(alone, disturbance=push if not in_python else InPython() + push)
    arc = ba.walk(pushed, gait, 1).trajectory.arcs[0]
    stepper = ba.Stepper(alone)
    stepper.reset(start=gait.start(biped))
    assert bool(stepper.why) is in_python
    for k in range(80):
        sample = moved(stepper, 1, **(inputs if 10 <= k < 50 else {}))[0]
        row = int(np.searchsorted(arc.t, sample.t[0] - 1e-9))
        assert largest(arc.x[row, :10], sample.x[0, :10]) < 1e-9


@pytest.mark.parametrize(
    "s", [WAITING, WAITING.replace(hardware={"delay": 0.0})], ids=["waiting", "at once"]
)
def test_inputs_act_on_a_plant_that_moves_by_itself(s):
    """On MuJoCo's ground, compiled sample instants and Python's read the same inputs, whether torques wait for
    a delay (0.4 ms) or act at once; with inputs the robot moves otherwise than without.
    """
    walks = [ba.Stepper(s), ba.Stepper(s.replace(run={"engine": "pinocchio"}))]
    rest = ba.Stepper(s)
    rest.reset()
    still = moved(rest, 12)[-1]
    for inputs in ({"torque": U}, {"force": [40.0, 0.0]}):
        ends = []
        for stepper in walks:
            stepper.reset()
            ends.append(moved(stepper, 12, **inputs)[-1].x[0])
        assert largest(ends[0][:10], ends[1][:10]) < 1e-9
        assert largest(ends[0][:10], still.x[0, :10]) > 1e-4


def test_signals_are_read_where_the_walks_are():
    """Read by a Stepper, signals are the same by machine code and, for a method that chooses its steps, by
    Python. The two walks are pushed with U and -U, so that a mix-up of walks would show in their torques.
    """
    found = []
    for s in (NPD, NPD.replace(run={"method": "adaptive"})):
        stepper = ba.Stepper(s, 2)
        stepper.reset()
        for _ in range(5):
            stepper.step([U, -U])
        found.append(stepper.read(signals_at))
    assert np.allclose(*found, rtol=1e-6, atol=1e-6, equal_nan=True)
    assert largest(found[0][0, 13:17], found[0][1, 13:17]) > 1.0  # 13 to 16: torques


def test_a_walk_that_has_ended_stays_where_it_is():
    """Pulled back by 400 N it ends before 0.9 s, the time of the samples; a reset begins it again."""
    stepper = ba.Stepper(NPD)
    stepper.reset()
    rows = moved(stepper, 900, force=[-400.0, 0.0])
    assert rows[-1].status[0] is ba.Status.RAN_AWAY
    assert rows[-1].t[0] == rows[-2].t[0] < 0.9
    # COMPLETED is also the status of a walk that goes on
    assert stepper.reset(0).status[0] is ba.Status.COMPLETED


def test_a_stepper_is_refused_what_it_cannot_step(biped, gait):
    """Continuous time, a finer integration at impacts, a step before the start, inputs of a wrong kind, and the
    saved state of a walk of another kind.
    """
    with pytest.raises(InputError, match=r"give hardware\.period"):
        ba.Stepper(ba.Scenario("NPD"))
    with pytest.raises(InputError, match="fine"):
        ba.Stepper(NPD.replace(run={"h": 1e-3, "fine": 1e-4}))
    stepper = ba.Stepper(NPD, 2)
    with pytest.raises(InputError, match="call reset"):
        stepper.step()
    assert stepper.reset(1).status[0] is None  # walk 1 has begun, walk 0 not
    stepper.reset()
    for inputs in ({"torque": np.zeros(5)}, {"force": [[np.nan, 0.0]] * 2}):
        with pytest.raises(InputError, match=r"expected \(2, .\)|finite"):
            stepper.step(**inputs)
    walk, others = stepper.save(0), [ba.Stepper(s, 1, x) for s, x in OTHERS]
    for other, why in zip(
        others, ("14 states, expected 26", "saved without `within`"), strict=True
    ):
        with pytest.raises(InputError, match="call reset"):
            other.save()
        with pytest.raises(InputError, match="no gait to refer to, or no walk"):
            other.read(signals_at)
        other.reset()
        with pytest.raises(InputError, match=why):
            other.restore(0, walk)
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=ba.SampledTime(1e-3))
    with pytest.raises(InputError, match="start"):
        ba.Stepper(walker).reset()
    with pytest.raises(ValueError, match="read-only"):
        stepper.sample.x[0, 0] = 1.0
