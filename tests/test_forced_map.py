"""The forced return map x+ = A x + B w, y = C x + D w against walks, the map without inputs, and other norms.

w = (h, F, mu): height of the ground [m], force on the hip [N], error of masses. `walkers` has loops with and
without states of the controller, in continuous and in sampled time; `cycle` finds the orbit of one, and its
forced map. delta^2, the multiplier of the walk on the constraint, is from the zero dynamics.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import control
import numpy as np
import pytest
from scipy.signal import ss2tf

import biped_adrc as ba
from biped_adrc.analysis.forced_map import ForcedMap, forced, forced_map
from biped_adrc.analysis.return_map import ReturnMap, after_impact
from biped_adrc.analysis.variational import differentiate_step, section_tangent
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.core.errors import InputError, SimulationError
from biped_adrc.engine.run import simulate_by
from biped_adrc.model.ground import stepped

BIPED = ba.Biped.load("rabbit")
SAMPLED = ba.SampledTime(1e-3)
H, F, MU = range(3)
ZETA, MIDDLE, T = range(3)


@cache
def gait(name="v0.8"):
    return ba.load_gait(name, BIPED)


def walkers(name="v0.8"):
    """Loops by a short name, with the number of states of the controller in ascending order."""
    h = gait(name).constraint
    npd, adrc = ba.NPDController(h), ba.ADRCController(h, ba.GPIObserver.from_bandwidth(200.0, 1))
    return {
        "NPD": ba.Walker(BIPED, npd),
        "reset": ba.Walker(BIPED, ba.ReferenceReset(npd)),
        "sampled ADRC": ba.Walker(BIPED, adrc, timing=SAMPLED),
        "sampled reset": ba.Walker(BIPED, ba.ReferenceReset(adrc), timing=SAMPLED),
    }


@cache
def cycle(loop, name="v0.8"):
    """The return map of a loop, its orbit, and its forced map."""
    walker = walkers(name)[loop]
    P = ReturnMap(walker, ba.RK4(1e-3))
    orbit = P.fixed_point(walker.initial_state(gait(name).q_minus, gait(name).v_minus))
    return P, orbit, forced_map(P, orbit, gait(name).constraint)


def zeta(x):
    return 0.5 * BIPED.angular_momentum(x[:5], x[5:10]) ** 2


# -- walks -----------------------------------------------------------------------------------------
def walk_over(loop, heights):
    """States before the impacts (6, nx) and durations (6,) [s] of a walk from the orbit over heights [m]."""
    P, orbit, _ = cycle(loop)
    # the walk begins with the impact of single support 1
    walker = replace(P.walker, ground_steps=stepped(-heights, 2))
    start = after_impact(walker, 0.0, orbit.x_minus, ba.Mode())
    run = simulate_by("compiled", walker, *start, P.method, impacts=len(heights), t_end=10.0)
    times = [event.t for event in run.events(FOOT_STRIKE)]
    return run.before(FOOT_STRIKE), np.diff([0.0, *times])


@pytest.mark.parametrize("loop", ["NPD", "reset", "sampled ADRC", "sampled reset"])
def test_the_map_predicts_a_walk_over_small_heights(loop):
    """Six steps of the ground of 1e-5 m: state, zeta and duration of walks are those of the linear map, to 1e-3
    of the largest change. Half of the difference of the walks over h and -h has no terms of second order."""
    _, _, m = cycle(loop)
    heights = 1e-5 * np.array([1.0, -1.0, 0.5, 1.0, -0.7, 0.3])
    (up, T_up), (down, T_down) = (walk_over(loop, sign * heights) for sign in (1.0, -1.0))
    x, states, outputs = np.zeros(len(m.A)), [], []
    for h in heights:
        outputs.append(m.C @ x + m.D[:, H] * h)
        x = m.A @ x + m.B[:, H] * h
        states.append(x)
    at_rest = zeta(cycle(loop)[1].x_minus)
    zetas = [zeta(one) - zeta(other) for one, other in zip(up, down, strict=True)]
    for found, expected in (
        ((up - down) / 2, np.array(states)),
        (np.array(zetas) / 2 / at_rest, np.array(outputs)[:, ZETA]),
        ((T_up - T_down) / 2, np.array(outputs)[:, T]),
    ):
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-3 * np.max(np.abs(expected)))


@pytest.mark.parametrize("w", [(0.0, 1e-3, 0.0), (0.0, 0.0, 1e-5)])
@pytest.mark.parametrize("loop", ["NPD", "sampled reset"])
def test_a_constant_force_and_a_wrong_mass_shift_the_fixed_point(loop, w):
    """The fixed point of the walker under the input moves by (1 - A)^-1 B w, and zeta by the static gain, to
    1e-3: Newton finds the fixed point of another walker. The inputs are so small that no touchdown crosses a
    sample instant, behind which the held numbers are others."""
    P, orbit, m = cycle(loop)
    w = np.array(w)
    moved = replace(P, walker=forced(P.walker, w)).fixed_point(orbit.x_minus).x_minus
    expected = np.linalg.solve(np.eye(len(m.A)) - m.A, m.B @ w)
    atol = 1e-3 * np.max(np.abs(expected))
    np.testing.assert_allclose(moved - orbit.x_minus, expected, rtol=0, atol=atol)
    change = zeta(moved) / zeta(orbit.x_minus) - 1.0
    assert change == pytest.approx((m.static @ w)[ZETA], rel=1e-3)


def test_the_mass_of_the_torso_alone():
    """An error of the masses of all bodies is the sum of those of torso, thighs and shins, to first order."""
    P, orbit, m = cycle("NPD")
    each = [forced_map(P, orbit, gait().constraint, (body,)) for body in BIPED.description.links]
    total = sum(one.static[:, MU] for one in each)
    np.testing.assert_allclose(total, m.static[:, MU], rtol=1e-6)


# -- the map without inputs ------------------------------------------------------------------------
def test_A_is_the_jacobian_of_the_return_map():
    """A on the section is dP/ds of the variational equation, which has no differences, to 1e-6. Steps of
    0.5 ms, since the error of RK4 is another one in Phi than in a difference: 1e-5 at 1 ms."""
    P, orbit, _ = cycle("NPD")
    P = replace(P, method=ba.RK4(5e-4))
    orbit = P.fixed_point(orbit.x_minus)
    step = differentiate_step(P, P.project(orbit.x_minus))
    A = forced_map(P, orbit, gait().constraint).A
    found = np.delete(A @ section_tangent(P.walker, orbit.x_minus), P.walker.plant.n - 1, axis=0)
    np.testing.assert_allclose(found, step.jacobian, rtol=0, atol=1e-6 * np.max(np.abs(found)))


@pytest.mark.parametrize("loop", ["NPD", "reset", "sampled ADRC", "sampled reset"])
def test_the_multipliers_agree(loop):
    """The largest multiplier is that of the return map; differences of 1e-5 leave 1e-6."""
    _, orbit, m = cycle(loop)
    assert m.multipliers[0] == pytest.approx(orbit.multipliers[0], rel=1e-6)


def test_in_the_middle_of_the_step_a_step_of_the_ground_decays_by_delta_squared():
    """Behind the reset the joints follow the constraint, so that zeta in the middle obeys a scalar map: its
    impulse response is geometric, and rms, peak and static gain are one number."""
    _, _, m = cycle("reset")
    delta = ba.ZeroDynamics.of(BIPED, gait().constraint).delta
    first, second = (m.C @ np.linalg.matrix_power(m.A, k) @ m.B for k in (0, 1))
    assert second[MIDDLE, H] / first[MIDDLE, H] == pytest.approx(delta**2, rel=1e-5)
    assert abs(m.D[MIDDLE, H]) < 1e-6 * abs(first[MIDDLE, H])  # the landing is later
    np.testing.assert_allclose(m.gains()[:, MIDDLE, H], abs(m.static[MIDDLE, H]), rtol=1e-5)


@pytest.mark.parametrize(("name", "gain"), [("v0.5", 2.73), ("v0.6", 2.11), ("v0.8", 1.65)])
def test_of_alternating_heights_zeta_before_landing_amplifies_most(name, gain):
    """The H-infinity norm from h to zeta- [% per mm] is at omega = pi; the digits are those of an earlier
    computation by another program."""
    _, _, m = cycle("reset", name)
    found = 0.1 * m.gains()[1, ZETA, H]
    assert found == pytest.approx(0.1 * abs(m.response(np.array([np.pi]))[0, ZETA, H]), rel=1e-9)
    assert found == pytest.approx(gain, abs=0.006)


# -- norms -----------------------------------------------------------------------------------------
def made_up(n, radius=0.9):
    rng = np.random.default_rng(n)
    A = rng.normal(size=(n, n))
    A *= radius / np.max(np.abs(np.linalg.eigvals(A)))
    return ForcedMap(A, *(rng.normal(size=s) for s in ((n, 3), (3, n), (3, 3))))


@pytest.mark.parametrize("n", [1, 4, 7])
def test_static_and_peak_gain_are_those_of_python_control(n):
    """The peak gain is the sum of |impulse response|, the static gain the response at omega = 0."""
    m = made_up(n)
    static, _, peak = m.gains()
    loop = control.ss(m.A, m.B, m.C, m.D, True)
    _, y = control.impulse_response(loop, T=500)
    np.testing.assert_allclose(peak, np.sum(np.abs(y), axis=2), rtol=1e-9)
    np.testing.assert_allclose(static, np.abs(control.dcgain(loop)), rtol=1e-9)


@pytest.mark.parametrize("n", [1, 4, 7])
def test_no_frequency_exceeds_the_h_infinity_norm(n):
    """g is the norm of G = b / a when g^2 a(z) a(1/z) - b(z) b(1/z) has zeros on the unit circle for a slightly
    smaller g, and none for a slightly larger one."""
    m = made_up(n)
    for i, j in np.ndindex(3, 3):
        b, a = ss2tf(m.A, m.B, m.C[[i]], m.D[[i]], input=j)
        g = m.gains()[1, i, j]
        below, above = (
            np.abs(
                np.abs(
                    np.roots((f * g) ** 2 * np.polymul(a, a[::-1]) - np.polymul(b[0], b[0][::-1]))
                )
                - 1.0
            )
            for f in (1.0 - 1e-5, 1.0 + 1e-5)
        )
        assert np.min(below) < 1e-7
        assert np.min(above) > 1e-4


def test_gains_of_a_cycle_that_is_not_stable_are_infinite():
    static, *others = made_up(4, 1.1).gains()
    assert np.all(np.isfinite(static))
    assert np.all(np.isinf(others))


# -- how good it is, and what it refuses -----------------------------------------------------------
@pytest.mark.parametrize(
    ("loop", "share"), [("NPD", 1e-5), ("reset", 1e-5), ("sampled ADRC", 1e-4)]
)
def test_the_gains_have_converged(loop, share):
    """Gains by two extrapolations differ by less than `share`; the table has a line for each pair."""
    _, _, m = cycle(loop)
    assert m.wider is not None
    np.testing.assert_allclose(m.gains(), m.wider.gains(), rtol=share)
    assert len(m.text().splitlines()) == 10
    assert "zeta-   h" in m.text()


@pytest.mark.parametrize(
    "changes",
    [
        {"timing": ba.SampledTime(1e-3), "sensors": ba.Sensors(counts=10000)},
        {"timing": ba.SampledTime(1e-3, restart=False)},
    ],
)
def test_a_stride_without_a_derivative_is_refused(changes):
    P, orbit, _ = cycle("NPD")
    with pytest.raises(InputError, match="has no derivative"):
        forced_map(replace(P, walker=replace(P.walker, **changes)), orbit, gait().constraint)


def test_what_does_not_fit_the_walker_is_refused():
    P, orbit, _ = cycle("NPD")
    far = replace(orbit, x_minus=1.001 * orbit.x_minus)
    with pytest.raises(SimulationError, match="misses itself"):
        forced_map(P, far, gait().constraint)
    h = gait().constraint
    beyond = replace(h, theta_plus=h.theta_plus + 2.0, theta_minus=h.theta_minus + 2.0)
    with pytest.raises(InputError, match="does not reach the middle"):
        forced_map(P, orbit, beyond)
    with pytest.raises(InputError, match="no machine code"):
        forced_map(replace(P, method=ba.Adaptive(1e-8, 1e-8)), orbit, gait().constraint)
