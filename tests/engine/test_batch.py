"""Batches: each run by itself, in order, the same whatever runs beside it.

A `Case` is a walker with its start and end; `simulate_many(cases, threads)` walks them in threads. `plain` is a
case of NPD for two impacts, `mixed` ten cases of all kinds: robots, methods, clocks, starts, and ends such as a
fall or NaN.
"""

import gc
import threading
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode
from biped_adrc.control.base import Controller
from biped_adrc.core.errors import InputError, NotFiniteError, SimulationError, SingularError
from biped_adrc.engine.batch import Case, Preparation, simulate_many
from biped_adrc.engine.run import simulate_by
from biped_adrc.gait.published import passive_cycle

from .test_run import Rooted

simulate = partial(simulate_by, "compiled")

FALL = ba.TorqueStep((0.0, 0.0, 0.0, 0.0, 60.0), 1, 0.1)


@dataclass(frozen=True)
class Raising(Controller):
    """In Python, as it branches; raises after 0.1 s, or where `at_once` in its first instant."""

    npd: ba.NPDController
    error: type | None = None
    at_once: bool = False

    def output(self, s, m):
        if (self.at_once or m.t > 0.1) and self.error is not None:
            raise self.error("what the controller says")
        return self.npd.output(s, m)


@pytest.fixture(scope="module")
def npd(gait):
    return ba.NPDController(gait.constraint)


@pytest.fixture(scope="module")
def plain(biped, gait, npd):
    q, v = gait.start(biped)
    return Case(ba.Walker(biped, npd), q, v, ba.RK4(2e-3), 2)


def test_a_case_takes_a_gait_or_a_state(plain, gait):
    """A gait gives its own start (q, v); with neither there is no start."""
    of_gait = Case(plain.walker, gait=gait, method=plain.method, impacts=2)
    assert np.array_equal(of_gait.q, plain.q)
    assert np.array_equal(of_gait.v, plain.v)
    with pytest.raises(InputError, match="gait of a case without q and v is None, expected a Gait"):
        Case(plain.walker, method=plain.method)


def test_a_case_of_a_gait_walks_on_the_slope_of_the_gait(plain, gait):
    """As `walk` does; a walker with a slope of its own keeps it."""
    downhill = replace(gait, slope=0.01)
    assert Case(plain.walker, gait=downhill, method=plain.method).walker.slope == 0.01
    level = replace(plain.walker, slope=0.0)
    assert Case(level, gait=downhill, method=plain.method).walker.slope == 0.0


@pytest.fixture(scope="module")
def mixed(biped, gait, npd, plain):
    """Robots, methods, time bases, starts and ends of all kinds."""
    walker = plain.walker
    adrc = ba.ADRCController(gait.constraint, ba.GPIObserver.from_bandwidth(300.0))
    heavy = ba.ModelErrors(mass={"torso": 0.05}).apply(biped)
    ticks = ba.SampledTime(1e-3)
    compass = ba.Biped.load("compass")
    cycle = passive_cycle(compass)
    passive = ba.Walker(compass, ba.Passive(), slope=cycle.slope)
    made = {
        "plain": plain,
        "late": replace(plain, mode=Mode(3, 0.7)),
        "falls": replace(plain, walker=replace(walker, disturbance=FALL, torque_limit=150.0)),
        "sampled": replace(plain, walker=replace(walker, controller=adrc, timing=ticks)),
        "nan": replace(plain, walker=replace(walker, controller=Rooted(npd))),
        "exponential": replace(
            plain, walker=ba.Walker(heavy, adrc, model=biped), method=ba.Exponential(1e-3)
        ),
        "python": replace(plain, walker=replace(walker, controller=Raising(npd)), impacts=1),
        "stalls": replace(plain, walker=replace(walker, max_step_time=0.3)),
        "passive": Case(passive, cycle.q_plus, cycle.v_plus, ba.RK4(1e-3), 2),
        "pushed": replace(
            plain, walker=replace(walker, disturbance=ba.HipForce(biped, (-1.0, 0.0))), impacts=1
        ),
    }
    return made


def same(one, other):
    assert (one.status, one.detail, one.engine) == (other.status, other.detail, other.engine)
    assert (one.t_end, one.t_start) == (other.t_end, other.t_start)
    for name in ("times", "x_minus", "final_state", "durations"):
        assert np.array_equal(getattr(one, name), getattr(other, name)), name


def test_the_number_of_threads_changes_no_bit(mixed):
    """Each case stands twice in the batch: one thread and three give the same, and so do both places. `same`
    compares status, times, states and ends exactly.
    """
    cases = [*mixed.values(), *mixed.values()]
    alone = list(simulate_many(cases, threads=1))
    assert len(alone) == len(cases)
    for one, other in zip(alone, simulate_many(cases, threads=3), strict=True):
        same(one, other)
    for first, again in zip(alone, alone[len(mixed) :], strict=False):
        same(first, again)


@pytest.mark.parametrize(
    ("timing", "method"),
    [
        (ba.ContinuousTime(), ba.RK4(1e-3)),
        (ba.SampledTime(1e-3), ba.RK4(1e-3)),
        (ba.ContinuousTime(), ba.Exponential(1e-3)),
    ],
)
def test_a_case_prepared_from_one_like_it_is_that_prepared_alone(biped, gait, timing, method):
    """Cases that differ in gains, poles and pushes alone take all else from the case before; nothing is taken
    where a number changes the code, the plant, the start or the matrices of the exponential method.
    """
    law = ba.ADRCController(gait.constraint, observer=ba.GPIObserver.from_bandwidth(160.0, 1))
    walker = ba.Walker(biped, law, ba.TorquePulse((9.0, 0, 0, 0, 0), 1, 0.1, 0.2), timing)
    case = Case(walker, gait=gait, method=method, impacts=2, curve=gait.constraint)
    pushed = ba.TorquePulse((0.0, -7.0, 0, 0, 0), 2, 0.1, 0.2) + ba.HipForce(biped, (5.0, 0.0))
    slow = ba.GPIObserver.from_bandwidth(120.0, 1)
    same_code = {
        "gains": replace(law, gains=ba.Gains(4000.0, 60.0)),
        "observer": replace(law, observer=slow),
    }
    taken = [replace(walker, controller=x) for x in same_code.values()]
    other = replace(law, gains=ba.Gains((5000.0, 4000.0, 5000.0, 5000.0), 50.0))
    looked = [
        replace(walker, controller=other),  # gains by joint are other code
        replace(walker, controller=replace(law, observer=ba.GPIObserver.from_bandwidth(160.0, 2))),
        replace(walker, plant=ba.ModelErrors(mass={"torso": 0.1}).apply(biped), model=biped),
        replace(walker, ground_steps=(ba.StepDown(1, 0.002),)),
    ]
    exponential = isinstance(method, ba.Exponential)
    for w in (replace(walker, disturbance=pushed), *taken, *looked):
        prepare = Preparation()
        prepare(case)
        first, like = prepare.last, replace(case, walker=w)
        same(prepare(like)(), Preparation()(like)())
        from_first = w.disturbance is pushed or (w in taken and not exponential)
        assert (prepare.last is first) == from_first, w
    turned = replace(case, v=0.99 * case.v)
    same(prepare(turned)(), Preparation()(turned)())


def test_every_run_of_a_batch_is_the_single_run(mixed):
    """Times, states before impacts and ends are those of `simulate_by`, bit for bit, whatever ends the run; of
    runs that are compiled also the last state.
    """
    for case, walked in zip(mixed.values(), simulate_many(mixed.values()), strict=True):
        walker, mode = case.walker, case.mode
        x0 = walker.initial_state(case.q, case.v, mode)
        run = simulate(
            walker,
            x0,
            mode,
            case.method,
            t_end=case.options.t_end,
            t0=mode.start,
            impacts=case.impacts,
        )
        events = run.events(FOOT_STRIKE)
        assert walked.status is run.status
        assert walked.engine == run.settings["engine"]
        assert walked.impacts == len(events)
        assert np.array_equal(walked.times, [event.t for event in events])
        for found, event in zip(walked.x_minus, events, strict=True):
            assert np.array_equal(found, event.x_minus)
        if walked.engine == "compiled":
            assert np.array_equal(walked.final_state, run.final_state)
        assert walked.t_end == run.t_end
        assert walked.t_start == mode.start


def test_a_start_without_numbers_ends_its_own_run(plain):
    """Rates of NaN end the second of three runs; the others are completed."""
    walked = list(simulate_many([plain, replace(plain, v=plain.v * np.nan), plain]))
    assert [w.status.name for w in walked] == ["COMPLETED", "NOT_FINITE", "COMPLETED"]
    assert "expected finite" in walked[1].detail
    assert walked[1].impacts == 0


@pytest.mark.parametrize("at_once", [False, True])
def test_a_controller_that_raises_ends_its_own_run(plain, npd, at_once):
    """It raises in Python, after 0.1 s or in the first instant (at_once): each kind of error gives its status,
    and the runs between, of the same batch, are completed.
    """
    ends = {
        NotFiniteError: ba.Status.NOT_FINITE,
        SingularError: ba.Status.SINGULAR,
        ZeroDivisionError: ba.Status.RAISED,
        SimulationError: ba.Status.RAISED,
    }
    cases = [plain]
    for error in ends:
        controller = Raising(npd, error, at_once)
        walker = replace(plain.walker, controller=controller, timing=ba.SampledTime(1e-3))
        cases += [replace(plain, walker=walker), plain]
    walked = list(simulate_many(cases, threads=2))
    assert [w.status for w in walked[1::2]] == [*ends.values()]
    assert all("what the controller says" in w.detail for w in walked[1::2])
    # the third of the errors, ZeroDivisionError, is no error of the package, so its place is named
    assert walked[5].detail.startswith("Raising.output (test_batch.py:")
    assert walked[5].detail.endswith("raised ZeroDivisionError: what the controller says")
    assert all(w.status is ba.Status.COMPLETED for w in walked[::2])


def test_a_case_that_does_not_fit_is_an_error(plain):
    """It does not end its own run alone, as a fall does, but raises for the whole batch: the exponential method
    without an observer, no impacts, a period of 1e-12 s, no threads. An empty batch is no error.
    """
    wrong = replace(plain, method=ba.Exponential())
    with pytest.raises(InputError, match="exponential method needs"):
        list(simulate_many([plain, wrong, plain]))
    with pytest.raises(InputError, match="impacts"):
        replace(plain, impacts=0)
    with pytest.raises(InputError, match="period"):
        ba.SampledTime(1e-12)
    with pytest.raises(InputError, match="0 threads"):
        simulate_many([plain], threads=0)
    assert list(simulate_many([])) == []


def test_an_abandoned_batch_leaves_no_thread(plain):
    """After two of 100 walks the iterator is deleted: its threads end."""
    before = {*threading.enumerate()}
    walks = simulate_many((replace(plain, impacts=3) for _ in range(100)), threads=3)
    assert len(list(islice(walks, 2))) == 2
    assert {*threading.enumerate()} - before
    del walks
    gc.collect()
    assert not {*threading.enumerate()} - before
