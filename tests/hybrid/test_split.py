"""The coordinates of the exponential method: inverses, their derivatives against the flow, order, accuracy.

A walker's `split` takes its state x to (w, E), with E' = A E + N_E linear up to a remainder, and w' = N_w; E
are the observer's errors of each joint. WALKERS are ADRC with observers, gains and plants of several kinds;
`states` are random states near the start of a step; `close` compares with the largest number.
"""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.engine.run import simulate_by
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.observers.gpi import TABLE_I

SLOW = ba.GPIObserver.from_poles([0.05 * pole for pole in TABLE_I])
GAINS = ba.Gains([4e3, 5e3, 6e3, 7e3], [40.0, 50.0, 60.0, 70.0])
PUSH = ba.TorquePulse([30.0] * 4 + [0.0], step=1, start=0.02, stop=0.3)
ON_THE_TORSO = ba.TorquePulse([30.0, -20.0, 10.0, 5.0, 25.0], step=1, start=0.0, stop=0.3)


def heavier(biped):
    errors = {"torso": 0.2, "thigh": 0.15}
    return ba.ModelErrors(mass=errors, inertia=errors).apply(biped)


WALKERS = {
    "nominal": lambda b, c: ba.Walker(b, ba.ADRCController(c)),
    "m = 0": lambda b, c: ba.Walker(b, ba.ADRCController(c, ba.GPIObserver.from_bandwidth(300, 0))),
    "a gain for each joint": lambda b, c: ba.Walker(b, ba.ADRCController(c, SLOW, GAINS)),
    "as printed": lambda b, c: ba.Walker(b, ba.ADRCController(c, solve_theta=False)),
    "disturbed": lambda b, c: ba.Walker(
        heavier(b), ba.ADRCController(c), ON_THE_TORSO, model=b, torque_limit=40.0
    ),
}


def states(walker, gait, count=4):
    """States near the start of a walking step, in which all rows of the observer have errors."""
    random = np.random.default_rng(7)
    q, v = gait.start(walker.plant)
    for _ in range(count):
        x = walker.initial_state(q + 0.05 * random.normal(size=5), v + 0.5 * random.normal(size=5))
        yield x * (1.0 + 0.01 * random.normal(size=len(x)))


def close(one, other, relative):
    return np.max(np.abs(one - other)) <= relative * np.max(np.abs(other))


@pytest.mark.parametrize("name", list(WALKERS))
def test_to_and_back_are_inverse(biped, gait, name):
    """`back` undoes `to` at random states, up to round-off; E has a column for each of the four joints."""
    walker = WALKERS[name](biped, gait.constraint)
    split = walker.split(ba.Mode())
    for x in states(walker, gait):
        w, E = split.to(x)
        assert E.shape == (len(split.A), 4)
        assert close(split.back(w, E), x, 1e-13)
        for one, other in zip(split.to(split.back(w, E)), (w, E), strict=True):
            assert close(one, other, 1e-12)


@pytest.mark.parametrize("name", list(WALKERS))
def test_linear_part_and_remainder_are_the_derivative_along_the_flow(biped, gait, name):
    """(N_w, A E + N_E) is (w, E)' by differences of `to` along the walker's flow x', row by row; `back`, which
    is linear, makes x' of it.
    """
    walker = WALKERS[name](biped, gait.constraint)
    split = walker.split(ba.Mode())
    for x in states(walker, gait):
        dx, d = walker.flow(0.1, x, ba.Mode()), 1e-6
        after, before = split.to(x + d * dx), split.to(x - d * dx)
        dw, dE = ((a - b) / (2.0 * d) for a, b in zip(after, before, strict=True))
        w, E = split.to(x)
        N_w, N_E = split.remainder(0.1, w, E)
        assert np.allclose(N_w, dw, rtol=1e-6, atol=1e-6)
        for found, row in zip(split.A @ E + N_E, dE, strict=True):
            assert close(found, row, 1e-5)
        assert close(split.back(N_w, split.A @ E + N_E), dx, 1e-10)


def impact(walker, gait, h, engine="pinocchio"):
    """The first impact of a walk by the exponential method with steps of h [s]."""
    x0 = walker.initial_state(*gait.start(walker.nominal))
    run = simulate_by(engine, walker, x0, ba.Mode(), Exponential(h), t_end=2.0, impacts=1)
    (event,) = run.events(FOOT_STRIKE)
    return event


@pytest.mark.parametrize(
    ("plant", "push", "limit"),
    [(lambda b: b, None, None), (heavier, PUSH, 150.0)],
    ids=["undisturbed", "heavier, push and torque limit"],
)
def test_one_step_of_walking_at_table_one(biped, gait, plant, push, limit):
    """With steps of 0.5 ms (q, q') at the first impact is within 1e-4 of that with 0.1 ms, by the compiled
    engine, and 1 us in time. The foot is on the ground there, and the reset is the walker's impact.
    """
    adrc = ba.ADRCController(gait.constraint)
    walker = ba.Walker(plant(biped), adrc, push, model=biped, torque_limit=limit)
    exact, found = impact(walker, gait, 1e-4, "compiled"), impact(walker, gait, 5e-4)
    assert np.max(np.abs(found.x_minus - exact.x_minus)[:10]) < 1e-4
    assert abs(found.t - exact.t) < 1e-6
    assert abs(walker.clearance(found.x_minus[:5], 1)) < 1e-12
    x_plus, _ = walker.strike(found.t, found.x_minus, ba.Mode())
    assert np.array_equal(found.x_plus, x_plus)
