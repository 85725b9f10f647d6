"""What a user's code is handed cannot be written to, and what it gives back is checked, in both engines."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.walker import Mode
from biped_adrc.engine.simulate import detail_of
from biped_adrc.errors import InputError
from biped_adrc.hardware.sensing import Sensor, SensorLaws
from biped_adrc.hybrid import simulator
from biped_adrc.observers.base import Estimate
from biped_adrc.types import Array

ENGINES = ("pinocchio", "compiled")
TIMINGS = {"ticks": ba.SampledTime(1e-3), "continuous": ba.ContinuousTime()}
WRITES = "writes into an array that it was handed"


@dataclass(frozen=True)
class NPD(ba.Controller):
    """NPD in plain Python; `meddle` is called with (s, m) before each torque."""

    reference: ba.Reference
    meddle: Callable[[Array, ba.Measurement], object]

    def initial_state(self, m):
        return np.zeros(2)

    def flow(self, s, m, u):
        return np.zeros(2)

    def sampled(self, period):
        return self

    def correct(self, s, m):
        return s + 0.0

    def predict(self, s, m, u):
        return s + 0.0

    def output(self, s, m):
        self.meddle(s, m)
        r = self.reference(m.t, m.q, m.v)
        a = r.drift - 50.0 * (m.v_b - r.dq_d) - 5000.0 * (m.q_b - r.q_d)
        return m.terms.kappa_inverse @ (a - m.terms.xi)


@dataclass(frozen=True)
class Late:
    """Calls what it holds from the time `after` [s] on, so that the first try at the start does not find it."""

    does: Callable[..., object]
    after: float

    def __call__(self, s, m):
        if m.t >= self.after:
            self.does(s, m)


def damped(s, m):
    v = m.v_b
    v *= 0.999


def overwritten(s, m):
    m.q[:] = 0.0


def heavier(s, m):
    np.multiply(m.terms.D, 2.0, out=m.terms.D)


def wound_up(s, m):
    s += 1.0


@pytest.mark.parametrize("after", [0.0, 0.01])
@pytest.mark.parametrize("does", [damped, overwritten, heavier, wound_up])
@pytest.mark.parametrize("timing", TIMINGS)
@pytest.mark.parametrize("engine", ENGINES)
def test_a_controller_that_writes_into_what_it_is_given(engine, timing, does, after, biped, gait):
    controller = NPD(gait.constraint, Late(does, after))
    walker = ba.Walker(biped, controller, timing=TIMINGS[timing])
    with pytest.raises(InputError, match=WRITES) as caught:
        ba.walk(walker, gait, 1, engine=engine)
    assert does.__name__ in str(caught.value)
    assert "test_handed_out.py" in str(caught.value)


class Numbers(NamedTuple):
    """Parameters of the laws below."""

    K: Array


def doubles_its_gain(k, s, m):
    k.K[:] = 2.0 * k.K
    return k.K * m.q[:4]


def moves_the_state(k, s, m):
    q = m.q
    q[0] = 0.0
    return k.K * q[:4]


@dataclass(frozen=True)
class Lawful(ba.Controller):
    """A controller of one law, which writes into its arguments."""

    law: Callable[..., Array]
    K: Array = field(default_factory=lambda: np.ones(4))

    @property
    def laws(self):
        return ba.ControllerLaws(Numbers(self.K), self.law)


@pytest.mark.parametrize("law", [doubles_its_gain, moves_the_state])
@pytest.mark.parametrize("engine", ENGINES)
def test_a_law_that_writes_into_its_arguments(engine, law, biped, gait):
    controller = Lawful(law)
    with pytest.raises(InputError, match=WRITES):
        ba.walk(ba.Walker(biped, controller), gait, 1, engine=engine)
    controller.K[0] = 3.0  # the user's own array stays the user's


def ends_at_ten_ms(k, s, m):
    return k.K * np.sqrt(0.0105 - m.t) * m.q[:4]


@pytest.mark.parametrize("timing", TIMINGS)
@pytest.mark.parametrize("engine", ENGINES)
def test_a_law_without_numbers_is_named_in_compiled_code_too(engine, timing, biped, gait):
    walker = ba.Walker(biped, Lawful(ends_at_ten_ms), timing=TIMINGS[timing])
    run = ba.walk(walker, gait, 1, engine=engine).trajectory
    assert run.settings["engine"] == engine
    assert run.status.name == "NOT_FINITE"
    assert "Lawful.output returned [nan nan nan nan]" in run.detail
    assert 0.01 <= run.t_end < 0.0115


def divides(k, s, m):
    return k.K * (1.0 / (0.001 - m.t))


def test_a_law_that_only_python_refuses_is_named_by_its_error(biped, gait):
    """The run is one that machine code, where 1 / 0 is infinite, might have left."""
    walker = ba.Walker(biped, Lawful(divides), timing=TIMINGS["ticks"])
    x, options = walker.initial_state(*gait.start(biped)), simulator.RunOptions(1e-3)
    run = simulator.run(walker, x, Mode(), ba.RK4(5e-4), options)
    lost = replace(run, status=ba.Status.NOT_FINITE, detail="after t = 0.001 s")
    found = detail_of(walker, ba.RK4(5e-4), lost)
    assert found == "after t = 0.001 s: ZeroDivisionError: float division by zero"


@dataclass(frozen=True)
class Relabels(NPD):
    """Writes into the relabelling that it is handed at an impact."""

    def jump(self, s, after, swap):
        swap[:] = swap[::-1]
        return s


@dataclass(frozen=True)
class Pushes(ba.Disturbance):
    """A disturbance that writes into the plant's rates, by a method."""

    def torque(self, t, step, t_start, q, v):
        v *= 0.5
        return np.zeros(5)


def still(s, m):
    """Does nothing."""


@pytest.mark.parametrize("engine", ENGINES)
def test_other_parts_that_write(engine, biped, gait):
    sampled = TIMINGS["ticks"]
    relabels = ba.Walker(biped, Relabels(gait.constraint, still), timing=sampled)
    with pytest.raises(InputError, match=r"swap\[::-1\].*" + WRITES):
        ba.walk(relabels, gait, 1, engine=engine)
    pushed = ba.Walker(biped, ba.NPDController(gait.constraint), Pushes())
    with pytest.raises(InputError, match=r"v \*= 0\.5.*" + WRITES):
        ba.walk(pushed, gait, 1, engine=engine)


def test_a_value_error_of_ones_own_stays_what_it_is(biped, gait):
    def broken(s, m):
        raise ValueError("mine")

    with pytest.raises(ValueError, match=r"^mine$"):
        ba.Walker(biped, NPD(gait.constraint, broken)).initial_state(*gait.start(biped))


def test_what_is_stored_cannot_be_written_to(biped, gait):
    walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 1)
    arc = walk.trajectory.arcs[0]
    c = gait.constraint
    gains = ba.Gains([5000.0] * 4, 50.0)
    kept = [arc.t, arc.x, arc.dx, arc.event.x_minus, arc.event.x_plus, gait.q_minus, gait.v_minus]
    kept += [c.phase, c.curve.coefficients, c.parameters.curve.stacked, gains.K_p]
    kept += [biped.B, biped.phase, biped.R, biped.relabelling, *biped.friction_coefficients]
    told = ba.Scenario("NPD", impacts=1, period=1e-3, touchdown="told")
    found = ba.walk_scenario(told)
    kept += [*vars(found.signals).values(), found.outcome.x_minus, found.outcome.durations]
    kept += [found.touchdowns.t, found.touchdowns.late, found.touchdowns.false]
    assert not any(array.flags.writeable for array in kept)
    walk.trajectory.final_state[0] = 0.0  # a copy


def test_an_array_that_is_handed_in_stays_its_owners(biped, gait):
    q, v = (np.array(x) for x in gait.start(biped))
    walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    x = walker.initial_state(q, v)
    walker.flow(0.0, x, ba.Mode())
    walker.measure(0.0, q, v, ba.Mode())
    assert all(array.flags.writeable for array in (x, q, v))


# -- what comes back -------------------------------------------------------------------------------
BAD = {
    "complex": (lambda u: u + 1j, r"expected \(4,\), real numbers"),
    "text": (lambda u: [f"{x}" for x in u], r"expected \(4,\), real numbers"),
    "None": (lambda u: None, r"None, expected \(4,\).*return"),
    "objects": (lambda u: u.astype(object), r"expected \(4,\), real numbers"),
    "too many": (lambda u: np.append(u, 0.0), r"shape \(5,\), expected \(4,\)"),
    "ragged": (lambda u: [u, 1.0], r"expected \(4,\), real numbers"),
}


@dataclass(frozen=True)
class Gives(NPD):
    """A torque of another kind from the time `after` [s] on."""

    bad: Callable[[Array], object] = field(default=lambda u: u)
    after: float = 0.0

    def output(self, s, m):
        u = super().output(s, m)
        return u if m.t < self.after else self.bad(u)


@pytest.mark.parametrize("after", [0.0, 0.01])
@pytest.mark.parametrize("case", BAD)
@pytest.mark.parametrize("timing", TIMINGS)
@pytest.mark.parametrize("engine", ENGINES)
def test_a_torque_that_is_none(engine, timing, case, after, biped, gait):
    bad, said = BAD[case]
    walker = ba.Walker(biped, Gives(gait.constraint, still, bad, after), timing=TIMINGS[timing])
    with pytest.raises(InputError, match=rf"^Gives\.output returned .*{said}"):
        ba.walk(walker, gait, 1, engine=engine)


@pytest.mark.parametrize("timing", TIMINGS)
@pytest.mark.parametrize("engine", ENGINES)
def test_numbers_of_other_kinds_are_numbers(engine, timing, biped, gait):
    walker = ba.Walker(biped, NPD(gait.constraint, still), timing=TIMINGS[timing])
    as_list = replace(walker, controller=Gives(gait.constraint, still, lambda u: list(u)))
    ends = [ba.walk(w, gait, 1, engine=engine).trajectory.final_state for w in (walker, as_list)]
    assert np.array_equal(*ends)


@dataclass(frozen=True)
class Remembers(NPD):
    """A state of another kind from its method `name`."""

    name: str = ""
    bad: object = None

    def _or_bad(self, name, found):
        return self.bad if name == self.name else found

    def initial_state(self, m):
        return self._or_bad("initial_state", np.zeros(2))

    def flow(self, s, m, u):
        return self._or_bad("flow", np.zeros(2))

    def correct(self, s, m):
        return self._or_bad("correct", s)

    def predict(self, s, m, u):
        return self._or_bad("predict", s)

    def jump(self, s, after, swap):
        return self._or_bad("jump", s)


NO_STATES = [np.zeros(2) * 1j, None, "a", np.zeros(2, object), np.zeros(3)]
METHODS = ("initial_state", "flow", "correct", "predict", "jump")


@pytest.mark.parametrize(
    ("name", "bad"),
    # at the start any number of numbers is a state
    [(name, bad) for name in METHODS for bad in NO_STATES[: 4 if name == "initial_state" else 5]],
)
@pytest.mark.parametrize("engine", ENGINES)
def test_a_state_that_is_none(engine, name, bad, biped, gait):
    timing = TIMINGS["ticks" if name in ("correct", "predict") else "continuous"]
    controller = Remembers(gait.constraint, still, name, bad)
    mode = ba.Stiff(1e-2) if name == "jump" else ba.RK4(1e-3)
    with pytest.raises(InputError, match=rf"^Remembers\.{name} returned .*expected"):
        ba.walk(ba.Walker(biped, controller, timing=timing), gait, 1, engine=engine, method=mode)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_state_that_is_not_finite_ends_the_walk_with_its_name(engine, biped, gait):
    controller = Remembers(gait.constraint, still, "predict", np.array([0.0, np.nan]))
    walker = ba.Walker(biped, controller, timing=TIMINGS["ticks"])
    run = ba.walk(walker, gait, 1, engine=engine).trajectory
    assert run.status.name == "NOT_FINITE"
    assert run.detail == "Remembers.predict returned [ 0. nan]"
    assert all(np.all(np.isfinite(arc.x)) for arc in run.arcs)


@dataclass(frozen=True)
class Wind(ba.Disturbance):
    """A torque of another kind from 0.01 s on."""

    bad: object

    def torque(self, t, step, t_start, q, v):
        return np.zeros(5) if t < 0.01 else self.bad


def windy(k, t, step, t_start, q, v):
    return 1j * q


@dataclass(frozen=True)
class Lawless(ba.Disturbance):
    """The same by a law."""

    @property
    def laws(self):
        return (ba.DisturbanceLaw((), windy),)


@pytest.mark.parametrize("bad", [np.zeros(4), 1j * np.ones(5), None, "a"])
@pytest.mark.parametrize("engine", ENGINES)
def test_a_disturbance_that_is_none(engine, bad, biped, gait):
    for controller in (ba.NPDController(gait.constraint), NPD(gait.constraint, still)):
        for timing in TIMINGS.values():
            walker = ba.Walker(biped, controller, Wind(bad), timing)
            with pytest.raises(InputError, match=r"^Wind\.torque returned .*expected \(5,\)"):
                ba.walk(walker, gait, 1, engine=engine)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_law_of_a_disturbance_that_is_none(engine, biped, gait):
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), Lawless())
    with pytest.raises(InputError, match=r"^Lawless\.torque returned .*expected \(5,\)"):
        ba.walk(walker, gait, 1, engine=engine)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_disturbance_that_is_not_finite_ends_the_walk_with_its_name(engine, biped, gait):
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), Wind(np.full(5, np.nan)))
    run = ba.walk(walker, gait, 1, engine=engine).trajectory
    assert run.status.name == "NOT_FINITE"
    assert run.detail == "Wind.torque returned [nan nan nan nan nan]"


@dataclass(frozen=True)
class Watching(ba.Observer):
    """An observer written as methods, one of which gives something else."""

    name: str
    bad: object

    def _or_bad(self, name, found):
        return self.bad if name == self.name else found

    @property
    def order(self):
        return 3

    def initial_state(self, y, dy, xi):
        return self._or_bad("initial_state", np.concatenate((y, dy, xi)))

    def estimate(self, z):
        return self._or_bad("estimate", Estimate(z[:4], z[4:8], z[8:]))

    def reset(self, z, policy, swap, y, dy, xi):
        return self._or_bad("reset", z)

    def flow(self, z, y, input):
        return self._or_bad("flow", 0.0 * z)


NO_ESTIMATES = [None, "a", 1j * np.ones(12), np.zeros(11)]


@pytest.mark.parametrize(
    ("name", "bad"),
    [("initial_state", bad) for bad in NO_ESTIMATES[:3]]
    + [(name, bad) for name in ("flow", "estimate") for bad in NO_ESTIMATES],
)
@pytest.mark.parametrize("engine", ENGINES)
def test_an_observer_that_gives_something_else(engine, name, bad, biped, gait):
    walker = ba.Walker(biped, ba.ADRCController(gait.constraint, Watching(name, bad)))
    with pytest.raises(InputError, match=rf"Watching\.{name} returned"):
        ba.walk(walker, gait, 1, engine=engine)


def forgets(k, Z, y, input):
    """Returns nothing."""


@dataclass(frozen=True)
class Forgetful(ba.GPIObserver):
    """An observer whose law has no return."""

    @property
    def laws(self):
        return super().laws._replace(flow=forgets)


def test_a_law_of_an_observer_without_return_is_said_with_its_name(biped, gait):
    observer = Forgetful(**vars(ba.GPIObserver.from_bandwidth(500.0)))
    walker = ba.Walker(biped, ba.ADRCController(gait.constraint, observer))
    with pytest.raises(InputError, match=r"^ADRCController \(Forgetful\)\.flow returned"):
        walker.initial_state(*gait.start(biped))


@dataclass(frozen=True)
class Blind(Sensor):
    """A sensor of which one law gives something else."""

    name: str
    bad: object

    def start(self, k, q, v):
        return self.bad if self.name == "start" else np.zeros(1)

    def laws(self, n, p, period):
        seen, bad = self.name == "seen", self.bad

        def sense(k, w, q, v):
            return self.bad if self.name == "sense" else w

        return SensorLaws(
            (),
            1,
            sense,
            lambda k, w, q, v, v_model: w,
            lambda k, w, q, v: (bad, v) if seen else (q, v),
        )


@pytest.mark.parametrize("bad", [None, 1j * np.ones(5), "a", np.zeros(4)])
@pytest.mark.parametrize("name", ["start", "sense", "seen"])
@pytest.mark.parametrize("engine", ENGINES)
def test_a_sensor_that_shows_something_else(engine, name, bad, biped, gait):
    walker = ba.Walker(
        biped, NPD(gait.constraint, still), timing=TIMINGS["ticks"], sensors=Blind(name, bad)
    )
    with pytest.raises(InputError, match=re.escape(f"Blind.{name} returned")):
        ba.walk(walker, gait, 1, engine=engine)


def complex_first(point):
    return point._replace(**{point._fields[0]: point[0] + 1j})


def none_for_a_point(point):
    return None


def one_number_for_all(point):
    return point._replace(drift=0.0)


def short_rows(point):
    return point._replace(**{point._fields[1]: np.zeros(3)})


def no_numbers(point):
    return point._replace(drift=np.full(4, np.nan))


POINTS = {
    complex_first: (r"gives (y|q_d) = complex128 numbers, expected \(4,\), real numbers"),
    none_for_a_point: r"gives None, expected an? (Output|Reference)Point\(",
    one_number_for_all: r"gives drift of shape \(\), expected \(4,\)",
    short_rows: r"gives dq?(y|_d) of shape \(3,\), expected \(4,\)",
    no_numbers: r"gives drift = \[nan nan nan nan\]",
}


def own_point(base: type, right: Callable[..., object], bad: Callable[..., object], after: float):
    """An object of a class Own below `base`, which gives something else from the time `after` [s] on."""

    def call(self, t, q, v):
        return bad(right(t, q, v)) if t >= after else right(t, q, v)

    return type("Own", (base,), {"__call__": call, "laws": None})()


@pytest.mark.parametrize("after", [0.0, 0.004])
@pytest.mark.parametrize("bad", POINTS)
@pytest.mark.parametrize("kind", ["outputs", "reference"])
def test_outputs_and_references_that_give_something_else(kind, bad, after, biped, gait):
    h = gait.constraint
    if kind == "outputs":
        right = ba.LinearOutputs(np.eye(4, 5), h)
        controller = ba.OutputNPDController(own_point(ba.Outputs, right, bad, after))
    else:
        controller = ba.NPDController(own_point(ba.Reference, h, bad, after))
    walker = ba.Walker(biped, controller)
    if bad is no_numbers and after:
        run = ba.walk(walker, gait, 1).trajectory
        assert run.status.name == "NOT_FINITE"
        assert re.match(f"Own {POINTS[bad]}", run.detail)
        return
    with pytest.raises(InputError, match=f"^Own {POINTS[bad]}"):
        ba.walk(walker, gait, 1)


def test_a_reference_that_writes_is_told_where_at_the_start_too(biped, gait):
    def written(t, q, v):
        q[0] = 0.0
        return gait.constraint(t, q, v)

    controller = ba.NPDController(own_point(ba.Reference, written, written, 1.0))
    with pytest.raises(InputError, match=WRITES):
        ba.walk(ba.Walker(biped, controller), gait, 1)


@pytest.mark.parametrize(
    "function", [lambda q: None, lambda q: q[:4] * 1j, lambda q: "abcd", lambda q: q[:4] * np.nan]
)
def test_a_function_of_outputs_that_gives_something_else(function):
    with pytest.raises(InputError, match=r"^FunctionOutputs\.function returned"):
        ba.FunctionOutputs(function)(0.0, np.zeros(5), np.zeros(5))
