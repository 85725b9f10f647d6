"""Prediction over a known delay: of a linear plant the loop is that without delay, when its torque acts.

`Predicted` gives the controller inside the state by the model at the time t + delay at which its torque will
act. T is the period of the ticks. `run(law, delay, q, v)` steps a plant of two joints with constant kappa and
xi (q'' = kappa u + xi), and returns rows (q, v, u); its reference is `Swinging`.
"""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import biped_adrc as ba
from biped_adrc.control.around import Hold
from biped_adrc.control.base import Measurement
from biped_adrc.control.delayed import Predicted, QueueState
from biped_adrc.control.friction_feedforward import FrictionFeedforward
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.core.errors import InputError
from biped_adrc.gait.reference import ReferencePoint
from biped_adrc.hardware.motors import whole_and_part
from biped_adrc.model.reduction import reduce
from biped_adrc.scenario.build import build

T = 1e-3
SLOW = ba.GPIObserver.from_bandwidth(200.0)
TERMS = reduce(np.array([[2.0, 0.3], [0.3, 1.5]]), np.array([4.0, -3.0]), 2)
"""Of a plant with two motors whose q'' = kappa u + xi does not depend on its state."""


class Swinging(ba.Reference):
    """Two angles as a function of time."""

    def __call__(self, t, q, v):
        w, one = 7.0, np.array([0.2, -0.1])
        s, c = np.sin(w * t), np.cos(w * t)
        return ReferencePoint(one * s, w * one * c, -w * w * one * s, np.zeros((2, 2)))


def looked(t, q, v):
    return Measurement(t, 1, t, q, v, TERMS, None, lambda q, v: looked(t, q, v))


def moved(q, v, u, h):
    a = TERMS.kappa @ u + TERMS.xi
    return q + h * v + 0.5 * h * h * a, v + h * a


def run(law, delay, q, v, t0=0.0, ticks=60):
    """(q, v, u) (ticks, 6) at the sample instants t0 + k T of the plant whose torque acts `delay` later."""
    j, f = whole_and_part(delay, T)
    sent, rows = [np.zeros(2)] * (j + 1), []
    s = law.initial_state(looked(t0, q, v))
    for k in range(ticks):
        m = looked(t0 + k * T, q, v)
        s = law.correct(s, m)
        u = law.output(s, m)
        s = law.predict(s, m, u)
        rows.append(np.concatenate((q, v, u)))
        sent.append(u)
        q, v = moved(q, v, sent[-2 - j], f * T) if f > 0.0 else (q, v)
        q, v = moved(q, v, sent[-1 - j], (1.0 - f) * T)
    return np.array(rows)


@pytest.mark.parametrize("delay", [T, 1.6 * T])
@pytest.mark.parametrize(
    "make", [ba.NPDController, lambda h: ba.ADRCController(h, SLOW)], ids=["NPD", "ADRC"]
)
def test_the_torque_of_a_delayed_loop_is_that_of_the_loop_without_delay_from_where_it_acts(
    make, delay
):
    """On a plant with constant kappa and xi the predicted loop gives the torques of the loop without delay that
    starts at time d = delay, from the q and v that no torque can change any more. Without prediction (`hidden`)
    it does not. 1.6 T is no whole number of ticks.
    """
    q, v = np.array([0.1, -0.2]), np.array([0.5, 1.0])
    inner = make(Swinging()).sampled(T)
    late = run(Predicted(make(Swinging()), delay).sampled(T), delay, q, v)
    free = run(inner, 0.0, *moved(q, v, np.zeros(2), delay), t0=delay)
    np.testing.assert_allclose(late[:, 4:], free[:, 4:], rtol=1e-9, atol=1e-9)
    hidden = run(inner, delay, q, v)
    assert np.max(np.abs(hidden[:, 4:] - free[:, 4:])) > 1.0


def test_on_the_robot_the_error_of_the_predicted_rates_goes_with_the_square_of_the_delay(
    biped, gait
):
    """Half the delay misses a quarter of the rates and an eighth of the angles: the torque is held, and the
    change of the rest of q'' is what is missed. Exact: SciPy's solution of the robot's equations.
    """
    q, v = gait.start(biped)
    walker = ba.Walker(biped, ba.Passive())
    u, missed = np.array([30.0, -20.0, 10.0, 5.0]), []

    def flow(t, x):
        return np.concatenate((x[5:], biped.acceleration(x[:5], x[5:], np.append(u, 0.0))))

    for d in (8e-3, 4e-3, 2e-3):
        m = walker.measure(0.0, q, v, ba.Mode())
        law = Predicted(ba.Passive(), d, period=1e-3)
        # the torques of the ticks that the delay has, all the same
        found = law.ahead(np.tile(u, (round(d / 1e-3), 1)), m)
        exact = {"rtol": 1e-10, "atol": 1e-12}
        x = solve_ivp(flow, (0.0, d), np.concatenate((q, v)), **exact).y[:, -1]
        missed.append([np.max(np.abs(found.v - x[5:])), np.max(np.abs(found.q - x[:5]))])
        np.testing.assert_array_equal(found.terms.D, biped.reduction(found.q, found.v).D)
        assert found.t == d
    for one, two in pairwise(missed):
        assert one[0] / two[0] == pytest.approx(4.0, rel=0.1)
        assert one[1] / two[1] == pytest.approx(8.0, rel=0.1)


def test_torques_on_their_way_are_relabelled_at_an_impact_and_move_up_at_a_tick(biped, gait):
    """A delay of 2.5 ticks has three torques U (3, 4) on their way, the oldest first; `output` is that of the
    controller inside at the state predicted with them.
    """
    law = Predicted(MomentumDOBController(gait.constraint), 2.5 * T)
    walker = ba.Walker(biped, law, timing=ba.SampledTime(T))
    law = walker.law
    m = walker.measure(0.0, *gait.start(biped), ba.Mode())
    U, u = np.arange(12.0).reshape(3, 4), np.array([9.0, 8.0, 7.0, 6.0])
    s = QueueState(law.inner.initial_state(m), U)
    swap = np.array([1, 0, 3, 2])
    assert np.array_equal(law.jump(s, m, swap).U, U[:, swap])
    assert np.array_equal(law.correct(s, m).U, U)
    assert np.array_equal(law.predict(s, m, u).U, [*U[1:], u])
    by_hand = law.inner.output(s.inner, law.ahead(U, m))
    assert np.array_equal(law.output(s, m), by_hand)


@pytest.mark.parametrize("share", [0.4, 2.6])
def test_the_clock_of_a_walker_has_the_torques_on_their_way_that_are_predicted_with(
    biped, gait, share
):
    """What the controller is shown at a tick is the walk d later, but for the change of q'' in that time: the
    rates miss by 2 % of their change. share: d / T.
    """
    d, (q, v) = share * T, gait.start(biped)
    law, clock = Predicted(ba.NPDController(gait.constraint), d), ba.SampledTime(T, delay=d)
    walker = ba.Walker(biped, law, timing=clock)
    start = walker.initial_state(q, 1.02 * v)
    arc = ba.simulate(walker, start, ba.Mode(), ba.RK4(T / 5), t_end=0.03).arcs[0]
    count, worst, least = len(walker.law.weights[0]), 0.0, np.inf
    # all k T + d are within the run of 30 ticks
    for k in range(5, 25):
        before, later = (np.searchsorted(arc.t, x - 1e-9) for x in (k * T, k * T + d))
        x, m = arc.x[before], walker.measure(k * T, *np.split(arc.x[before, :10], 2), ba.Mode())
        # behind q and v stands the law's state, the torques that are on their way
        found = walker.law.ahead(x[10 : 10 + 4 * count].reshape(count, 4), m)
        worst = max(worst, np.max(np.abs(found.v - arc.x[later, 5:10])))
        least = min(least, np.max(np.abs(m.v - arc.x[later, 5:10])))
    assert worst < 0.02 * least


def test_wrong_delays_and_clocks_are_refused(gait):
    """Refused are a negative and an infinite delay; one longer than a walker's clock takes; continuous time; a
    delay that the observer knows too and that would count twice; a scenario without sampled time.
    """
    inner = ba.NPDController(gait.constraint)
    for wrong in (
        lambda: Predicted(inner, -1e-3),
        lambda: Predicted(inner, np.inf),
        lambda: Predicted(inner, 0.2).sampled(T),
        lambda: Predicted(inner, T).continuous(),
        lambda: ba.Scenario(
            {"name": "NPD", "prediction": T},
            hardware={"period": T, "delay": T, "delay_known": True},
        ),
        lambda: ba.walk_scenario(ba.Scenario({"name": "NPD", "prediction": T})),
    ):
        with pytest.raises(InputError):
            wrong()


def test_no_prediction_is_the_controller_itself_and_both_leaves_go_around_the_policies():
    """In a scenario feedforward is outermost, then prediction, then a policy of contact (`Hold`); with a
    prediction of 0 s there is no wrapper.
    """
    s = ba.Scenario(
        {"name": "LESO", "contact": {"name": "hold"}, "prediction": T, "feedforward": 0.5},
        hardware="rabbit",
    )
    outer = build(s).controller
    assert (type(outer), outer.share) == (FrictionFeedforward, 0.5)
    assert (type(outer.inner), outer.inner.prediction) == (Predicted, T)
    assert type(outer.inner.inner) is Hold
    none = ba.Scenario({"name": "NPD", "prediction": 0.0}, hardware={"period": T})
    assert type(build(none).controller) is ba.NPDController
