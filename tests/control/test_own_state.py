"""A controller of one's own with a NamedTuple as its state, beside one with the same numbers in a row.

`WithNames` is NPD with an integral e of the error that waits for the first large error; `InARow` is the same
law with its state as an array. `walked` walks two steps under a push.
"""

import re
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.around import Hold
from biped_adrc.core.errors import InputError
from biped_adrc.extras.export.computer import Computer
from biped_adrc.extras.export.source import source_of
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.observers.base import Estimate
from biped_adrc.observers.bounded import BoundedObserver
from tests.export.test_agreement import TOLERANCE, difference

K_I, LEAST = 1e5, 1e-4
CLOCKS = {"continuous": ba.ContinuousTime(), "sampled": ba.SampledTime(1e-3)}


class Exchanged(NamedTuple):
    """The names of `Integral` in another order."""

    waits: float
    e: np.ndarray


class Integral(NamedTuple):
    """State of `WithNames`."""

    e: np.ndarray  # integral of the tracking error (p,) [rad s]
    waits: float  # 1 while no integral is taken: before the first large error


@dataclass(frozen=True)
class WithNames(ba.Controller):
    """(28) with an integral of the error, which begins with the first error beyond LEAST."""

    reference: ba.VirtualConstraint
    period: float = 0.0

    def error(self, m):
        return m.q_b - self.reference(m.t, m.q, m.v).q_d

    def output(self, s, m):
        r = self.reference(m.t, m.q, m.v)
        f = ba.feedback(ba.TABLE_II, r, m.q_b, m.v_b) - K_I * s.e
        return m.terms.kappa_inverse @ (ba.solved_acceleration(r, m.terms, f) - m.terms.xi)

    def initial_state(self, m):
        return Integral(np.zeros(len(m.q_b)), 1.0)

    def flow(self, s, m, u):
        return Integral((1.0 - s.waits) * self.error(m), 0.0)

    def correct(self, s, m):
        small = np.sum(self.error(m) ** 2) < LEAST**2
        return s._replace(waits=np.where(small, s.waits, 0.0))

    def predict(self, s, m, u):
        return s._replace(e=s.e + self.period * (1.0 - s.waits) * self.error(m))

    def sampled(self, period):
        return replace(self, period=period)

    def jump(self, s, after, swap):
        return Integral(s.e[swap], 0.0)


@dataclass(frozen=True)
class InARow(WithNames):
    """The same law with the state (e, waits) (p + 1,)."""

    def tree(self, s):
        return Integral(s[:-1], s[-1])

    def output(self, s, m):
        return super().output(self.tree(s), m)

    def initial_state(self, m):
        return np.concatenate((np.zeros(len(m.q_b)), np.ones(1)))

    def flow(self, s, m, u):
        d = super().flow(self.tree(s), m, u)
        return np.append(d.e, d.waits)

    def correct(self, s, m):
        d = super().correct(self.tree(s), m)
        return np.append(d.e, d.waits)

    def predict(self, s, m, u):
        d = super().predict(self.tree(s), m, u)
        return np.append(d.e, d.waits)

    def jump(self, s, after, swap):
        d = super().jump(self.tree(s), after, swap)
        return np.append(d.e, d.waits)


def walked(biped, gait, law, clock, engine):
    push = ba.TorqueStep([10.0, 0.0, -5.0, 5.0, 0.0], start=0.05)
    walker = ba.Walker(biped, law(gait.constraint), push, timing=CLOCKS[clock])
    return ba.walk(walker, gait, 2, ba.RK4(4e-3), engine=engine)


@pytest.mark.parametrize("clock", CLOCKS)
@pytest.mark.parametrize("engine", ["compiled", "pinocchio"])
def test_names_change_no_bit_of_a_walk(biped, gait, engine, clock):
    """Both laws do the same operations, so the walks are equal bit for bit, in each engine and clock; at the
    end the integral has been at work.
    """
    one, other = (walked(biped, gait, law, clock, engine) for law in (WithNames, InARow))
    assert one.trajectory.settings["engine"] == other.trajectory.settings["engine"] == engine
    for x, y in zip(one.trajectory.arcs, other.trajectory.arcs, strict=True):
        assert np.array_equal(x.x, y.x)
    s = one.walker.split_state(one.trajectory.final_state)[2]
    assert isinstance(s, Integral)
    assert s.waits == 0.0
    assert np.max(np.abs(s.e)) > 1e-5


class ObserverStill(ba.GPIObserver):
    """An observer that writes another flow than the one whose error dynamics it inherits."""

    def flow(self, z, y, input):
        return 0.0 * z


class LawStill(ba.ADRCController):
    """The same in the law."""

    def flow(self, s, m, u):
        return 0.0 * s


class Biased(ba.ADRCController):
    """A law with another input of the observer."""

    def observer_input(self, m, u):
        return super().observer_input(m, u) + 100.0


def test_what_is_inherited_does_not_stand_for_what_is_written_again(gait):
    """The exponential method and the discrete form took the inherited observer in its place, silently."""
    h, plain, still = gait.constraint, ba.GPIObserver.from_bandwidth(300.0), ObserverStill(3, 300.0)
    assert ba.ADRCController(h, plain).error_system() is not None
    bounded = BoundedObserver(still, 50.0)
    for law in (
        LawStill(h, plain),
        Biased(h, plain),
        *(ba.ADRCController(h, o) for o in (still, bounded)),
    ):
        assert law.error_system() is None
    with pytest.raises(
        InputError, match=r"ObserverStill writes another flow; write sampled\(period\)"
    ):
        ba.ADRCController(h, still).at_ticks(1e-3)


@dataclass(frozen=True)
class Still(WithNames):
    """The same law, which does not write what moves its state."""

    flow, correct, predict, jump = (
        getattr(ba.Controller, name) for name in ("flow", "correct", "predict", "jump")
    )

    def initial_state(self, m):
        return Integral(np.full(len(m.q_b), 1e-4), 1.0)


@pytest.mark.parametrize("clock", CLOCKS)
@pytest.mark.parametrize("engine", ["compiled", "pinocchio"])
@pytest.mark.filterwarnings("ignore:Still has a state and no jump")
def test_a_state_that_nothing_moves_stays(biped, gait, engine, clock):
    """In continuous time s' was s itself, so that it grew as exp(t)."""
    walk = walked(biped, gait, Still, clock, engine)
    s = walk.walker.split_state(walk.trajectory.final_state)[2]
    assert np.all(s.e == 1e-4)
    assert s.waits == 1.0


def test_a_stored_walk_names_its_states(biped, gait, tmp_path):
    """The names are in the order of the state's vector: q, v, the controller's state s, and the torque u that
    is held between sample instants.
    """
    walk = ba.load_walk(walked(biped, gait, WithNames, "sampled", "compiled").save(tmp_path / "x"))
    names = walk.trajectory.settings["states"]
    assert len(names) == len(walk.trajectory.final_state)
    assert names[8:15] == ["v[3]", "v[4]", *(f"s.e[{i}]" for i in range(4)), "s.waits"]
    assert names[15:] == [f"tail.line.u[{i}]" for i in range(4)]


def test_the_exported_c_walks_as_python(biped, gait):
    """The walks, over a touchdown, are compared by their largest `difference`; TOLERANCE is what tests/export
    allow: the last place of an angle times the gains.
    """
    walker = walked(biped, gait, WithNames, "sampled", "compiled").walker
    assert difference(walker, source_of(Computer(walker))) < TOLERANCE


def test_another_state_than_at_the_start_is_refused_by_method(biped, gait):
    """`predict` that returns an array for a named state is refused at once; `jump` with two numbers of four
    ends the walk at the impact. Both say which method it was.
    """

    def walked_by(**methods):
        law = type("WithNames", (WithNames,), methods)(gait.constraint)
        return ba.walk(ba.Walker(biped, law, timing=CLOCKS["sampled"]), gait, 2)

    with pytest.raises(
        InputError, match=r"WithNames\.predict .* returned a ndarray, expected a Integral"
    ):
        walked_by(predict=lambda self, s, m, u: s.e)
    walk = walked_by(jump=lambda self, s, m, swap: Integral(s.e[:2], 0.0))
    assert walk.trajectory.status is ba.Status.RAISED
    assert "WithNames.jump" in walk.trajectory.detail
    assert "(2,)" in walk.trajectory.detail


@dataclass(frozen=True)
class Exchanging(WithNames):
    """After an impact the state has its names in another order, and as many numbers as before."""

    def jump(self, s, after, swap):
        return Exchanged(0.0, s.e[swap])


@pytest.mark.parametrize("clock", CLOCKS)
@pytest.mark.parametrize("engine", ["compiled", "pinocchio"])
def test_another_state_after_an_impact_is_refused_by_both_engines(biped, gait, engine, clock):
    """Machine code would take its numbers in the order of the start; the walk ends with class, method and
    line.
    """
    walker = ba.Walker(biped, Exchanging(gait.constraint), timing=CLOCKS[clock])
    run = ba.walk(walker, gait, 1, ba.RK4(4e-3), engine=engine).trajectory
    assert run.status is ba.Status.RAISED
    said = r"Exchanging.jump \(test_own_state.py:\d+\) returned a Exchanged, expected a Integral"
    assert re.search(said, run.detail)


class Pair(NamedTuple):
    """State of a part with methods that return other states."""

    x: float
    y: np.ndarray


class Sensing(Sensor):
    """Exact sensors with a state."""

    def start(self, q, v):
        return Pair(0.0, v)

    def reading(self, w, q, v):
        return q, v


class Detecting(ba.Touchdown):
    """A detector that notices nothing."""

    def start(self):
        return Pair(0.0, np.zeros(2))

    def notice(self, d, look):
        return d, 0.0


def of_plain_tuple(**methods):
    """`WithNames` with a plain tuple of two as its state."""
    names = {
        "initial_state": lambda self, m: (np.zeros(4), 1.0),
        "output": lambda self, s, m: WithNames.output(self, Integral(*s[:2]), m),
        "correct": lambda self, s, m: s,
        "predict": lambda self, s, m, u: s,
        "jump": lambda self, s, after, swap: s,
    }
    return type("Plain", (WithNames,), names | methods)


def longer(self, s, *more):
    return (*s, 1.0)


def exchanged(self, s, *more):
    return Exchanged(s.waits, s.e)


def of_sensors(**methods):
    return {"sensors": type("Own", (Sensing,), methods)()}


def of_detector(**methods):
    detector = type("Own", (Detecting,), methods)()
    return {"touchdown": detector, "timing": ba.SampledTime(1e-3, restart=False)}


def shorter_later(self, s, m):
    return s if m.t < 0.2 else s._replace(e=s.e[:2])


def exchanged_later(self, d, look):
    return (d if look.t < 0.2 else Exchanged(*d)), 0.0


WRONG_PARTS = {
    "Own.impact (L) returned a Exchanged, expected a Pair": of_sensors(
        impact=lambda self, w, *more: Exchanged(*w)
    ),
    "Own.reading (L) returned a ndarray, expected a tuple of 2": of_sensors(
        reading=lambda self, w, q, v: q
    ),
    "Own.reading (L) returned an array of shape (4,), expected (5,)": of_sensors(
        reading=lambda self, w, q, v: (q, v) if w.x < 100.0 else (q[1:], v),
        sense=lambda self, w, q, v: w._replace(x=w.x + 1.0),
    ),
    "Own.touchdown (L) returned a Exchanged, expected a Pair": of_detector(
        touchdown=lambda self, d, *more: Exchanged(*d)
    ),
    "Own.notice (L) returned a Exchanged, expected a Pair": of_detector(notice=exchanged_later),
    "Own.notice (L) returned a ndarray, expected a tuple of 2": of_detector(
        notice=lambda self, d, look: d.y
    ),
}
FIRST = next(iter(WRONG_PARTS))
WRONG_LAWS = {
    "Plain.predict (L) returned a tuple of 3, expected a tuple of 2": of_plain_tuple(
        predict=longer
    ),
    "Plain.jump (L) returned a tuple of 3, expected a tuple of 2": of_plain_tuple(jump=longer),
    "Own.correct (L) returned an array of shape (2,), expected (4,)": lambda h: Hold(
        type("Own", (WithNames,), {"correct": lambda self, s, m: s._replace(e=s.e[:2])})(h)
    ),
    "a state is ['s.e[0]', 's.e[1]', 's.e[2]', 's.e[3]', 's.waits'] or ['s.e[0]', 's.e[1]'": (
        lambda h: Hold(type("Own", (WithNames,), {"correct": shorter_later})(h))
    ),
    "Own.predict (L) returned a Exchanged, expected a Integral": lambda h: Hold(
        type("Own", (WithNames,), {"predict": exchanged})(h)
    ),
    "Hold (Own).jump (L) returned a Exchanged, expected a Integral": lambda h: Hold(
        type("Own", (WithNames,), {"jump": exchanged})(h)
    ),
}


def reset_short(self, z, *more):
    return z[1:]


def estimate_short(self, z):
    return Estimate(z[0], z[1][:3], z[2])


def sentence(walker, gait, engine):
    """The sentence about a walk of one step, with L in place of file and line."""
    try:  # a jump, and what begins later, end the walk; all others let it not begin
        text = ba.walk(walker, gait, 1, engine=engine).trajectory.detail
    except InputError as error:
        text = str(error)
    return re.sub(r"\(test_own_state.py:\d+\)", "(L)", text)


@pytest.mark.parametrize("engine", ["compiled", "pinocchio"])
def test_a_state_that_no_longer_fits_is_refused_wherever_it_comes_from(biped, gait, engine):
    """Each sentence names the user's method with its line, also inside a wrapper or below a controller of the
    package.
    """
    h, ticks = gait.constraint, {"timing": CLOCKS["sampled"]}
    for said, parts in WRONG_PARTS.items():
        walker = ba.Walker(biped, ba.NPDController(h), **(ticks | parts))
        assert sentence(walker, gait, engine).startswith(said)
    for said, law in WRONG_LAWS.items():
        assert sentence(ba.Walker(biped, law(h), **ticks), gait, engine).startswith(said)
    # of two sensors the one that is wrong is named
    sensors = Sensing() + WRONG_PARTS[FIRST]["sensors"]
    walker = ba.Walker(biped, ba.NPDController(h), sensors=sensors, **ticks)
    assert sentence(walker, gait, engine).startswith(FIRST)
    for said, method in (
        ("ADRCController (Own).jump (L) returned an array of shape (2, 4)", reset_short),
        ("Own.estimate (L) returned an array of shape (3,), expected (4,)", estimate_short),
    ):
        observer = type("Own", (ba.GPIObserver,), {method.__name__.partition("_")[0]: method})
        law = ba.ADRCController(h, observer.from_bandwidth(300.0, 1))
        assert sentence(ba.Walker(biped, law), gait, engine).startswith(said)


def test_a_list_in_a_state_is_an_array(biped, gait):
    """`predict` may return a list where the state had an array: the walk is that of the array."""

    def listed(self, s, m, u):
        d = WithNames.predict(self, s, m, u)
        return d._replace(e=list(d.e))

    law = type("Own", (WithNames,), {"predict": listed})
    one, other = (walked(biped, gait, x, "sampled", "pinocchio") for x in (law, WithNames))
    assert np.array_equal(one.trajectory.final_state, other.trajectory.final_state)
