"""A plant that moves by itself: a ball on a rail with a wall at q = 0, in Euler's steps of its own.

    m q'' = u + zeta - m g,   q'+ = -e q'- at the wall

Its `advance` moves it to the next sample instant or contact and tells so by a `Moved`. `loop()` is the ball
with e = 0.5 under `Told`, a PD to q = 0.3 with a tick of 5 ms and a model of half the mass too much;
`run(loop())` lets it fall from 0.4 m for 0.5 s. A contact ends a "single support" of it, as a touchdown does.
In x: q, q', the controller's (ticks, jumps, time of the last tick), bounces, torque. `telling(change)` is a
ball whose `Moved` is changed by a function, `at_contact(field=...)` one that changes it at contacts alone.
"""

import re
from dataclasses import dataclass, replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop import semantics
from biped_adrc.closed_loop.other_plant import stepping_loop, with_readings
from biped_adrc.closed_loop.protocols import Contact, Moved
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.core.errors import InputError, RaisedError
from biped_adrc.engine.on_plant import CompiledLoop
from biped_adrc.gait.reference import TimeReference
from biped_adrc.hardware.motors import Motors
from biped_adrc.hardware.sensors import Sensors
from biped_adrc.hybrid import storage
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.model.reduction import reduce

MASS, GRAVITY, DT = 2.0, 9.81, 1e-4
TICK = ba.SampledTime(5e-3)


@dataclass(frozen=True)
class Ball:
    """The ball, with own = (number of bounces,); a bounce later than `sticks_at` [s] ends the run."""

    restitution: float = 0.5
    sticks_at: float = np.inf
    n = p = 1
    swap = np.zeros(1, dtype=int)

    def start(self, t, q, v):
        return np.concatenate((q, v, np.zeros(1)))

    def advance(self, t, row, u, load, until):
        q, v, bounces = row.tolist()
        a = (u[0] + (0.0 if load is None else load.zeta[0])) / MASS - GRAVITY
        steps = max(1, round((until - t) / DT))
        dt = (until - t) / steps
        for k in range(1, steps + 1):
            v += a * dt
            q += v * dt
            if q <= 0.0 and v < 0.0:
                at, here = t + k * dt, np.array([q, v, bounces])
                if at > self.sticks_at:
                    return Moved(at, here, (Contact("stuck", ends=ba.Status.FELL),))
                impulse = np.array([0.0, -MASS * (1.0 + self.restitution) * v])
                after = np.array([q, -self.restitution * v, bounces + 1.0])
                return Moved(at, here, (Contact("wall", impulse),), after)
        return Moved(until, np.array([q, v, bounces]))


@dataclass(frozen=True)
class Model:
    """What the controller knows: half the mass too much, no wall."""

    n = p = 1

    def reduction(self, q, v):
        return reduce(np.array([[1.5 * MASS]]), np.array([1.5 * MASS * GRAVITY]), 1)

    def acceleration(self, q, v, force):
        return force / (1.5 * MASS) - GRAVITY


@dataclass(frozen=True)
class Told(ba.Controller):
    """PD to q = 0.3, with a state (ticks, jumps, time of the last tick)."""

    def initial_state(self, m):
        return np.array([0.0, 0.0, -1.0])

    def output(self, s, m):
        return -40.0 * (m.q - 0.3) - 4.0 * m.v

    def predict(self, s, m, u):
        return np.array([s[0] + 1.0, s[1], m.t])

    def jump(self, s, after, swap):
        assert after.t_step == 0.0
        return np.array([s[0], s[1] + 1.0, s[2]])


def loop(controller=None, plant=None, **more):
    return SteppingLoop(
        plant or Ball(), controller or Told(), **{"model": Model(), "timing": TICK, **more}
    )


def run(system, t_end=0.5, q=0.4, **more):
    x0 = system.initial_state(np.array([q]), np.zeros(1))
    return system.run(x0, RunOptions(t_end, **more))


def test_ticks_come_at_exact_times_and_the_torque_is_held():
    """A repeated time in the first arc is a tick: they are at multiples of 5 ms, the torque is constant in
    between, and after each it is the PD's for the state there."""
    walked = run(loop())
    assert walked.status is ba.Status.COMPLETED
    (arc,) = walked.arcs if len(walked.arcs) == 1 else walked.arcs[:1]
    jumps = arc.t[1:][np.diff(arc.t) == 0.0]
    assert np.array_equal(jumps, np.arange(1, len(jumps) + 1) * TICK.period)
    u = arc.read["u"][:, 0]
    between = np.diff(arc.t) > 0.0
    assert np.array_equal(u[1:][between], u[:-1][between])
    asked = -40.0 * (arc.x[:, 0] - 0.3) - 4.0 * arc.x[:, 1]
    starts = np.concatenate(([True], ~between))
    assert np.array_equal(u[starts], asked[starts])
    assert np.array_equal(arc.x[:, -1], u)


def test_a_contact_is_reported_and_passed_on():
    """At each bounce the rate is -0.5 times that before, the controller jumps once, and a single support
    ends."""
    walked = run(loop(), t_end=2.0, stop_after=("wall", 3))
    assert walked.status is ba.Status.COMPLETED
    assert [arc.mode.step for arc in walked.arcs] == [1, 2, 3]
    for k, event in enumerate(walked.events("wall"), start=1):
        assert event.x_minus[0] <= 0.0
        assert event.x_plus[1] == -0.5 * event.x_minus[1]
        jumps, bounces = event.x_plus[3], event.x_plus[5]
        assert (jumps, bounces) == (k, k)
        assert event.x_minus[5] == k - 1
    for before, after in zip(walked.arcs, walked.arcs[1:], strict=False):
        assert after.t[0] == before.event.t == after.mode.start
        assert np.array_equal(after.x[0][:2], before.event.x_plus[:2])


def test_the_clock_may_run_on_over_contacts():
    """With restart=False ticks stay at multiples of the period over bounces; x[4] is the time of the last
    tick, -1 before the first."""
    walked = run(loop(timing=replace(TICK, restart=False)), t_end=1.0, stop_after=("wall", 2))
    for arc in walked.arcs:
        ticks = arc.x[:, 4][arc.x[:, 4] >= 0.0] / TICK.period
        assert np.max(np.abs(ticks - np.round(ticks))) < 1e-9


def test_the_plant_may_end_the_run():
    """The ball's first bounce sticks: a contact with a status (FELL) ends the run, with no state after it."""
    walked = run(loop(plant=Ball(sticks_at=0.0)), t_end=2.0)
    assert walked.status is ba.Status.FELL
    assert walked.arcs[-1].event.guard == "stuck"
    assert walked.arcs[-1].event.x_plus is None


def xi_of(system, t, x):
    """The observer's estimate of xi at (t, x)."""
    q, v, s, tail = semantics.parts(system, x)
    return semantics.estimated(system, s, tail, system.measure(t, q, v, ba.Mode()), ba.Mode())


def test_what_acted_is_recorded_and_stored(tmp_path):
    """zeta at the nodes is the push; the observer finds xi of a ball lighter than the model within 10 %."""
    push = ba.TorqueSine((3.0,), frequency=2.0)
    reference = TimeReference(lambda t: (np.full(1, 0.5), np.zeros(1), np.zeros(1)))
    adrc = ba.ADRCController(reference, ba.GPIObserver.from_bandwidth(60.0), ba.Gains(80.0, 15.0))
    system = loop(adrc, disturbance=push, torque_limit=60.0)
    walked = run(system, t_end=1.5)
    (arc,) = walked.arcs
    zeta = [push.torque(t, 1, 0.0, np.zeros(1), np.zeros(1)) for t in arc.t]
    assert np.array_equal(arc.read["zeta"], np.array(zeta))
    late = arc.t > 1.0
    a = (arc.read["u"] + arc.read["zeta"]) / MASS - GRAVITY
    xi = a - arc.read["u"] / (1.5 * MASS)
    found = np.array([xi_of(system, t, x) for t, x in zip(arc.t, arc.x, strict=True)])
    assert np.max(np.abs(found - xi)[late]) < 0.1 * np.max(np.abs(xi))
    assert abs(arc.x[-1, 0] - 0.5) < 0.02
    storage.save(walked, tmp_path / "run.npz")
    again = storage.load(tmp_path / "run.npz", ba.Mode).arcs[0]
    assert {name: rows.shape for name, rows in again.read.items()} == {
        name: rows.shape for name, rows in arc.read.items()
    }
    assert np.array_equal(again.read["zeta"], arc.read["zeta"])


def test_a_plant_without_feet_has_no_readings_of_them():
    """The ball has no method `footing`, by which a plant says forces and places of its feet: asked for, it is
    missing by name."""
    with pytest.raises(
        InputError, match=r"Ball does not say what its feet do, .* footing\(row, u, load\)"
    ):
        with_readings(loop(), run(loop()))


def test_sensors_and_motors_lie_in_between():
    """The plant is driven through the same sensors and motors as a robot: torques change by at most 400 N m/s
    times the period, and do so 0.4 of a period after a sample instant, which is the delay."""
    hardware = {"sensors": Sensors(counts=2000), "motors": Motors(rate_limit=400.0)}
    system = loop(timing=replace(TICK, delay=0.4 * TICK.period), **hardware)
    walked = run(system, t_end=0.3)
    arc = walked.arcs[0]
    changes = np.abs(np.diff(arc.read["u"][:, 0]))
    assert 0.0 < np.max(changes) <= 400.0 * TICK.period + 1e-12
    moments = arc.t[1:][changes > 0.0] / TICK.period
    assert np.max(np.abs(moments - np.floor(moments) - 0.4)) < 1e-6


def test_a_run_goes_on_where_another_ended():
    """The final state holds all that a run needs: 0.1 s and 0.1 s more from there are 0.2 s in one go, but
    for the rounding of times."""
    system = loop()
    whole = run(system, t_end=0.2)
    half = run(system, t_end=0.1)
    rest = system.run(half.final_state, RunOptions(0.2, t0=0.1), half.arcs[-1].mode)
    assert np.allclose(rest.final_state, whole.final_state, rtol=1e-12, atol=1e-12)


def test_plants_that_break_the_contract_are_refused():
    """Continuous time and a motor's lag are no matter of such a plant; an index beyond its joints, a stop
    half way without a contact and a start elsewhere are mistakes of the class, which is named."""
    with pytest.raises(InputError, match=r"^Ball, as a plant .* is controlled at ticks"):
        loop(timing=ba.ContinuousTime())
    with pytest.raises(InputError, match="put the lag into the plant"):
        loop(motors=Motors(lag=1e-3))

    with pytest.raises(
        InputError, match=r"OneTooFar\.swap is array\(\[2\]\), expected an array of int"
    ):
        loop(plant=type("OneTooFar", (Ball,), {"swap": np.array([2])})())

    class Lazy(Ball):
        def advance(self, t, row, u, load, until):
            return super().advance(t, row, u, load, 0.5 * (t + until))

    with pytest.raises(InputError, match=r"Lazy\.advance came to 0.0025 s without a contact"):
        run(loop(plant=Lazy()))

    class Elsewhere(Ball):
        def start(self, t, q, v):
            return super().start(t, q + 1.0, v)

    with pytest.raises(InputError, match=r"Elsewhere\.start gives .* expected a row that begins"):
        run(loop(plant=Elsewhere()))


def at_contact(**change):
    """A function that changes fields of a `Moved` with contacts; each new value is a function of the old
    `Moved`."""

    def told(moved):
        if not moved.contacts:
            return moved
        return moved._replace(**{name: made(moved) for name, made in change.items()})

    return told


def contact(**change):
    return at_contact(contacts=lambda moved: (moved.contacts[0]._replace(**change),))


def telling(change):
    """A ball whose `advance` returns change(moved) in place of its `Moved`."""

    class Liar(Ball):
        def advance(self, *given):
            return change(super().advance(*given))

    return Liar()


LIES = {
    "nothing": (lambda moved: None, "gives None, expected a Moved"),
    "no time": (
        lambda moved: moved._replace(t=np.nan),
        "came to nan s without a contact, expected 0.005 s",
    ),
    "a row of another size": (
        lambda moved: moved._replace(row=moved.row[:2]),
        r".* returned an array of shape \(2,\), expected \(3,\)",
    ),
    "a row of text": (lambda moved: moved._replace(row="here"), " .* returned 'here'"),
    "contact beyond": (
        at_contact(t=lambda moved: moved.t + 1.0),
        "contact at 1.30.* s, .* not after 0.31 s",
    ),
    "contact with nothing after": (at_contact(after=lambda moved: None), "returned None"),
    "contacts one": (
        at_contact(contacts=lambda moved: moved.contacts[0]),
        "gives Moved.*, expected a Moved",
    ),
}


@pytest.mark.parametrize("name", LIES)
def test_what_a_plant_tells_is_checked(name):
    """Each of `LIES` is a ball whose `Moved` is wrong in one thing. At the start of the run it is refused, at
    a contact, which comes later, the run ends as RAISED."""
    change, said = LIES[name]
    expected = rf"(?s)Liar\.advance.*{said}"
    if "contact" not in name:  # wrong from the start on
        with pytest.raises(InputError, match=expected):
            run(loop(plant=telling(change)))
        return
    ended = run(loop(plant=telling(change)))
    assert ended.status is ba.Status.RAISED
    assert re.search(expected, ended.detail)


def spoilt(moved):
    return moved._replace(row=moved.row * np.nan) if moved.t > 0.0251 else moved


@pytest.mark.parametrize(
    ("change", "last"),
    [
        (spoilt, 0.025),
        (contact(impulse=np.full(2, np.nan)), 0.3088),
    ],
)
def test_values_that_are_not_finite_end_the_run_and_are_not_kept(change, last):
    """A state of NaN after 25 ms, or an impulse of NaN at the first bounce (0.3088 s): the run ends at the
    last good instant, `last`."""
    walked = run(loop(plant=telling(change)))
    assert walked.status is ba.Status.NOT_FINITE
    assert walked.t_end == pytest.approx(last)
    (arc,) = walked.arcs
    assert np.all(np.isfinite(arc.x))
    assert np.all(np.isfinite(arc.dx))


def test_contacts_at_one_moment_are_one_event():
    """Wall, floor and wall again are touched at once: one event with both names, and the run ends as with a
    single contact, where the controller's jumps are a number of the state.
    """

    def both(moved):
        left = moved.contacts[0]
        return left, left._replace(name="floor"), left

    walked = run(loop(plant=telling(at_contact(contacts=both))))
    assert [event.guard for event in walked.events()] == ["wall+floor"]
    once = run(loop())
    assert np.array_equal(walked.final_state, once.final_state)


@pytest.mark.parametrize(
    "written",
    [
        "row",
        "u",
        "zeta",
    ],
)
def test_a_plant_cannot_write_into_what_it_is_given(written):
    """A plant that wrote into its row, torque or load would change the loop's state; the arrays are read-only
    and the method is named."""

    class Writing(Ball):
        def advance(self, t, row, u, load, until):
            given = {"u": u, "row": row, "zeta": load.zeta}
            given[written][:] = 99.0
            return super().advance(t, row, u, load, until)

    with pytest.raises(
        RaisedError, match=r"Writing\.advance .* writes into an array that it was handed"
    ):
        run(loop(plant=Writing(), disturbance=ba.TorqueSine((3.0,), frequency=2.0)))


@pytest.mark.parametrize("timing", [TICK, replace(TICK, delay=2e-3)])
def test_a_plant_and_a_model_of_ones_own_are_the_same_in_a_compiled_loop(timing):
    """`CompiledLoop` has no code for this model and calls Python for it: bit by bit the same run, and it says
    why. A delay of 2 ms is a part of the period."""
    system = loop(timing=timing)
    compiled = CompiledLoop(Ball(), Told(), None, timing, Model())
    python, found = (run(s, t_end=2.0, stop_after=("wall", 3)) for s in (system, compiled))
    assert "the model is a Model" in found.settings["why"]
    assert found.status is python.status
    for one, other in zip(python.arcs, found.arcs, strict=True):
        np.testing.assert_array_equal(other.x, one.x)
        np.testing.assert_array_equal(other.read["u"], one.read["u"])


class Legs(Ball):
    """A plant of one's own with RABBIT's numbers of coordinates and motors, and no lag."""

    n, p = 5, 4
    swap = np.arange(4)


def test_a_plant_without_a_lag_fits_motors_without_one(biped, gait):
    """Its lag is 0 s: a walker whose motors have none takes it, one with 5 ms is refused with both numbers."""
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=TICK)
    assert stepping_loop(walker, Legs()).plant == Legs()
    late = replace(walker, motors=Motors(lag=5e-3))
    with pytest.raises(InputError, match=r"Legs has lag 0\.0 and the walker 0\.005"):
        stepping_loop(late, Legs())
