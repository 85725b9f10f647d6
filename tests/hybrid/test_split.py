"""The coordinates of the exponential method: inverses, their derivatives against the flow, order, accuracy."""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.exponential_form import loop_matrix
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.errors import InputError
from biped_adrc.gait.reference import TimeReference
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.observers.gpi import TABLE_I

SLOW = ba.GPIObserver.from_poles([0.05 * pole for pole in TABLE_I])
GAINS = ba.Gains([4e3, 5e3, 6e3, 7e3], [40.0, 50.0, 60.0, 70.0])
PUSH = ba.TorquePulse([30.0] * 4 + [0.0], step=1, start=0.02, stop=0.3)
ON_THE_TORSO = ba.TorquePulse([30.0, -20.0, 10.0, 5.0, 25.0], step=1, start=0.0, stop=0.3)
BOTH = pytest.mark.parametrize("feedback", [False, True], ids=["observer", "feedback"])


def heavier(biped):
    factors = {"torso": 1.2, "thigh": 1.15}
    return biped.with_errors(mass=factors, inertia=factors)


WALKERS = {
    "nominal": lambda b, c: ba.Walker(b, ba.ADRCController(c)),
    "m = 0": lambda b, c: ba.Walker(b, ba.ADRCController(c, ba.GPIObserver.from_bandwidth(300, 0))),
    "a gain for each joint": lambda b, c: ba.Walker(b, ba.ADRCController(c, SLOW, GAINS)),
    "as printed": lambda b, c: ba.Walker(b, ba.ADRCController(c, solve_theta=False)),
    "disturbed": lambda b, c: ba.Walker(
        heavier(b), ba.ADRCController(c), ON_THE_TORSO, model=b, torque_limit=40.0
    ),
}


def split_of(walker, feedback):
    return Exponential(feedback=feedback).split(walker, ba.Mode())


def states(walker, gait, count=4):
    """States about the start of a step, the observer's with errors in all its rows."""
    random = np.random.default_rng(7)
    q, v = gait.start(walker.plant)
    for _ in range(count):
        x = walker.initial_state(q + 0.05 * random.normal(size=5), v + 0.5 * random.normal(size=5))
        yield x * (1.0 + 0.01 * random.normal(size=len(x)))


def close(one, other, relative):
    return np.max(np.abs(one - other)) <= relative * np.max(np.abs(other))


@BOTH
@pytest.mark.parametrize("name", list(WALKERS))
def test_to_and_back_are_inverse(biped, gait, name, feedback):
    walker = WALKERS[name](biped, gait.constraint)
    split = split_of(walker, feedback)
    for x in states(walker, gait):
        w, E = split.to(x)
        assert E.shape == (len(split.A), 4)
        assert close(split.back(w, E), x, 1e-13)
        for one, other in zip(split.to(split.back(w, E)), (w, E), strict=True):
            assert close(one, other, 1e-12)


@BOTH
@pytest.mark.parametrize("name", list(WALKERS))
def test_linear_part_and_remainder_are_the_derivative_along_the_flow(biped, gait, name, feedback):
    """(w, E)' by differences of `to` along x', row by row."""
    walker = WALKERS[name](biped, gait.constraint)
    split = split_of(walker, feedback)
    for x in states(walker, gait):
        dx, d = walker.flow(0.1, x, ba.Mode()), 1e-6
        after, before = split.to(x + d * dx), split.to(x - d * dx)
        dw, dE = ((a - b) / (2.0 * d) for a, b in zip(after, before, strict=True))
        w, E = split.to(x)
        N_w, N_E = split.remainder(0.1, w, E)
        assert np.allclose(N_w, dw, rtol=1e-6, atol=1e-6)
        for found, row in zip(split.A @ E + N_E, dE, strict=True):
            assert close(found, row, 1e-5)
        if feedback:
            _, same, slope = split.node(0.1, w, E)
            assert close(same, x, 1e-13)
            assert close(slope, dx, 1e-10)


def test_the_linear_part_is_the_law_where_the_model_is_right(biped, gait):
    """On the constraint, with the observer's error in e_1 alone: eps'' = K_p e_1, whatever the state."""
    walker = WALKERS["nominal"](biped, gait.constraint)
    split, form = split_of(walker, True), walker.split_form(feedback=True)
    x = walker.initial_state(*gait.start(biped))
    w, E = split.to(x)
    e = 1e-3 * np.arange(1.0, 5.0)
    at_rest, moved = E.copy(), E.copy()
    moved[2] += e
    change = split.A @ (moved - at_rest)
    assert change[1] == pytest.approx(form.scale * 5000.0 * e)
    a = [walker.instant(0.0, split.back(w, F), ba.Mode()).a for F in (at_rest, moved)]
    r = gait.constraint(0.0, x[:5], x[5:10])
    true = (a[1] - a[0])[:4] - r.H @ (a[1] - a[0])
    assert true == pytest.approx(5000.0 * e, rel=1e-9)


def test_eigenvalues_are_those_of_feedback_and_observer():
    """A is block triangular, and with poles of the observer slow the two sets are apart."""
    observer = ba.GPIObserver.from_poles([-3.0, -4.0, -5.0])
    found = np.sort_complex(np.linalg.eigvals(loop_matrix(observer.error_system(), 5000.0, 50.0)))
    expected = np.sort_complex(np.concatenate((np.roots([1, 50, 5000]), [-3.0, -4.0, -5.0])))
    assert np.allclose(found, expected, rtol=1e-7)


def errors_after(walker, gait, dv, steps, feedback):
    """Largest error of (q, q') after 0.08 s, against an explicit method of order 8 on x itself."""
    q, v = gait.start(walker.plant)
    x0 = walker.initial_state(q, v + dv)

    def end(method):
        return simulate(walker, x0, ba.Mode(), method, t_end=0.08).final_state[:10]

    exact = end(ba.Adaptive(1e-13, 1e-13))
    return np.array([np.max(np.abs(end(Exponential(h, feedback)) - exact)) for h in steps])


@pytest.mark.parametrize("gains", [ba.Gains(), GAINS], ids=["one gain", "one per joint"])
def test_order_with_the_feedback_in_the_linear_part(biped, gait, gains):
    """Table I times 0.02, off the orbit."""
    dv = np.array([0.3, -0.4, 0.5, -0.2, 0.1])
    observer = ba.GPIObserver.from_poles([0.02 * pole for pole in TABLE_I])
    walker = ba.Walker(biped, ba.ADRCController(gait.constraint, observer, gains))
    steps = np.array([2e-3, 1e-3, 5e-4])
    errors = errors_after(walker, gait, dv, steps, True)
    order = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert order == pytest.approx(4.0, abs=0.5)


def impact(walker, gait, h, feedback):
    x0 = walker.initial_state(*gait.start(walker.nominal))
    method, stop = Exponential(h, feedback), (FOOT_STRIKE, 1)
    run = simulate(walker, x0, ba.Mode(), method, t_end=2.0, stop_after=stop)
    (event,) = run.events(FOOT_STRIKE)
    return event


@pytest.mark.parametrize(
    ("plant", "push", "limit", "bound"),
    [
        (lambda b: b, None, None, 2e-6),
        (heavier, PUSH, 150.0, 3e-5),
    ],
    ids=["undisturbed", "heavier, push and torque limit"],
)
def test_one_step_of_walking_at_table_one(biped, gait, plant, push, limit, bound):
    """(q, q') at the first impact, against steps of 0.1 ms."""
    adrc = ba.ADRCController(gait.constraint)
    walker = ba.Walker(plant(biped), adrc, push, model=biped, torque_limit=limit)
    exact = impact(walker, gait, 1e-4, True)
    for h in (5e-4, 1e-3):
        found = impact(walker, gait, h, True)
        assert np.max(np.abs(found.x_minus - exact.x_minus)[:10]) < bound
        assert abs(found.t - exact.t) < 1e-6
        assert abs(walker.clearance(found.x_minus[:5], 1)) < 1e-12
        x_plus, _ = walker.strike(found.t, found.x_minus, ba.Mode())
        assert np.array_equal(found.x_plus, x_plus)
    coarse = impact(walker, gait, 5e-4, False)
    assert np.max(np.abs(coarse.x_minus - exact.x_minus)[:10]) < 1e-4


REFUSED = {
    "has none; use RK4, Adaptive or Stiff": lambda b, c: ba.Walker(b, ba.NPDController(c)),
    "acts at ticks": lambda b, c: ba.Walker(b, ba.ADRCController(c), timing=ba.SampledTime(1e-3)),
    "tracks a TimeReference": lambda b, c: ba.Walker(
        b, ba.ADRCController(TimeReference(lambda t: (np.zeros(4),) * 3))
    ),
}


@pytest.mark.parametrize("reason", list(REFUSED))
def test_a_walker_without_the_coordinates_is_refused_with_the_reason(biped, gait, reason):
    walker = REFUSED[reason](biped, gait.constraint)
    with pytest.raises(InputError, match=reason):
        ba.walk(walker, gait, 1, Exponential(1e-3, feedback=True))
