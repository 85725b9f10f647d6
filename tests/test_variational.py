"""Derivatives of the dynamics, the variational equation, and the table of methods.

The return map P goes from just before one impact to just before the next; its derivative dP/ds comes from the
variational equation, and independently from central differences (`difference`, `directional`). Its
eigenvalues are the multipliers; delta^2 is the largest of them in closed form, from the zero dynamics of a
hybrid-invariant gait. `npd(biped)` walks on the published gait; `close` compares to a relative 1e-6.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.stability import (
    RELATIVE,
    StabilityTable,
    central_multipliers,
    invariance_gap,
    noise_of_differences,
    stability_table,
)
from biped_adrc.analysis.variational import (
    differentiate_step,
    flow_derivative,
    periodic_orbit,
    torque_derivative,
)
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.derivatives import acceleration_derivatives, impact_derivatives
from biped_adrc.scenario.cycle import cycle_of

EXACT = ba.Adaptive(1e-10, 1e-10)
FIRST = ba.Mode()


def difference(f, x, d=1e-4):
    """df/dx (k, len(x)) by differences of fourth order."""
    columns = [
        (8 * (f(x + d * e) - f(x - d * e)) - (f(x + 2 * d * e) - f(x - 2 * d * e))) / (12 * d)
        for e in np.eye(len(x))
    ]
    return np.array(columns).T


def close(found, expected, rel=1e-6):
    assert found.shape == expected.shape
    assert np.max(np.abs(found - expected)) <= rel * np.max(np.abs(expected))


def states(biped, count=4, size=0.3):
    """Random states about the gait's own, and forces [N m]."""
    rng = np.random.default_rng(5)
    gait = ba.load_gait("published", biped)
    for _ in range(count):
        q, v = gait.q_minus + size * rng.normal(size=5), 2.0 * rng.normal(size=5)
        yield q, v, 50.0 * rng.normal(size=5)


def npd(biped, **changes):
    gait = ba.load_gait("published", biped)
    return replace(ba.Walker(biped, ba.NPDController(gait.constraint)), **changes)


def pre_impact(biped):
    gait = ba.load_gait("published", biped)
    return np.concatenate((gait.q_minus, gait.v_minus))


# -- derivatives of the model ------------------------------------------------------------------------
@pytest.mark.parametrize("friction", [False, True])
def test_derivatives_of_the_acceleration(biped, friction):
    """The derivatives by angles, rates and force are compared with differences of fourth order at random
    states, with and without joint friction.
    """
    biped = replace(biped, friction=friction)

    def check(q, v, force):
        found = acceleration_derivatives(biped, q, v, biped.acceleration(q, v, force))
        close(found.dq, difference(lambda x: biped.acceleration(x, v, force), q))
        close(found.dv, difference(lambda x: biped.acceleration(q, x, force), v))
        close(found.dforce, np.linalg.inv(biped.inertia(q)))

    for state in states(biped):
        check(*state)


@pytest.mark.parametrize("name", ["rabbit", "three_link", "compass", "simplest", "rimless_wheel"])
def test_derivative_of_the_impact_map(name):
    """D Delta against differences, also where relabelling is no permutation, and where there is one coordinate
    only. The new rates are linear in the old ones, so that their derivative times these gives them back."""
    for preset in ba.Biped.load(name).description.presets if name == "rabbit" else [None]:
        biped = ba.Biped.load(name, preset)
        rng = np.random.default_rng(7)
        n = biped.n

        def strike(x, biped=biped, n=n):
            impact = biped.impact(x[:n], x[n:])
            return np.concatenate((impact.q, impact.v))

        for _ in range(4):
            x = rng.normal(size=2 * n)
            found = impact_derivatives(biped, x[:n], x[n:])
            close(found, difference(strike, x, 5e-3))  # wide: feet of 1e-7 of the hip's mass
            np.testing.assert_allclose(found[n:, n:] @ x[n:], strike(x)[n:], rtol=0.0, atol=1e-8)


# -- derivatives of the closed loop ------------------------------------------------------------------


class Halved(ba.NPDController):
    """A subclass may say anything: its torque is differenced."""

    def output(self, s, m):
        return 0.5 * super().output(s, m)


def loops(biped):
    c = ba.load_gait("published", biped).constraint
    per_joint = ba.Gains(np.array([4e3, 5e3, 6e3, 7e3]), np.array([40.0, 50.0, 60.0, 70.0]))
    heavy = replace(ba.ModelErrors(mass={"torso": 0.2}).apply(biped), friction=True)
    return {
        "NPD": npd(biped),
        "NPD as printed": npd(biped, controller=ba.NPDController(c, solve_theta=False)),
        "NPD, gains per joint": npd(biped, controller=ba.NPDController(c, per_joint)),
        "NPD, heavier plant with friction": npd(heavy, model=biped),
        "NPD, limited": npd(biped, torque_limit=500.0),
        "passive": npd(biped, controller=ba.Passive()),
        "half of NPD": npd(biped, controller=Halved(c)),
    }


def test_derivative_of_the_flow(biped):
    """A = df/dx is compared with differences of the whole closed loop, for every kind of law. Joints at the
    torque limit of 500 N m, which some states reach, have no derivative of the torque; the others do.
    """
    saturated = 0
    for name, walker in loops(biped).items():
        # random states may ask for torques at which a walk would end
        walker = replace(walker, runaway_torque=math.inf)
        for q, v, _ in states(biped, 3, size=0.1):
            x = np.concatenate((q, v))
            i = walker.instant(0.0, x, FIRST)
            du = torque_derivative(walker)(i)
            A = flow_derivative(walker, i, du)
            close(A, difference(lambda y, w=walker: w.flow(0.0, y, FIRST), x, 2e-4), 1e-7)
            if name == "NPD, limited":
                cut = np.abs(i.u) >= 500.0
                saturated += int(np.sum(cut))
                assert np.all(du[cut] == 0.0)
                assert np.all(np.any(du[~cut] != 0.0, axis=1))
    assert saturated > 0


# -- a single support --------------------------------------------------------------------------------


# -- multipliers -------------------------------------------------------------------------------------


def test_order_of_convergence(biped):
    """With RK4 the largest multiplier converges to delta^2, and dP/ds to that of a method with steps controlled
    to 1e-11: halving the step divides the errors by 16, order 4 (3.6 to 4.6)."""
    walker, x = npd(biped), pre_impact(biped)
    delta2 = ZeroDynamics.of(biped, walker.controller.reference).delta ** 2
    exact = ba.ReturnMap(walker, ba.Adaptive(1e-11, 1e-11))
    limit = differentiate_step(exact, exact.project(x)).jacobian
    by_value, by_matrix = [], []
    for h in (8e-3, 4e-3, 2e-3):
        P = ba.ReturnMap(walker, ba.RK4(h))
        step = differentiate_step(P, P.project(x))
        by_value.append(abs(step.multipliers[0] - delta2))
        by_matrix.append(np.max(np.abs(step.jacobian - limit)))
    for errors in (by_value, by_matrix):
        orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
        assert np.all((orders > 3.6) & (orders < 4.6)), orders


def directional(P, s, w, d):
    return (P(s + d * w) - P(s - d * w)) / (2.0 * d)


def test_the_derivative_under_a_saturated_torque_is_that_by_differences(biped):
    """The torque is saturated for a part of the step; the flow stays continuous there, so that nothing jumps.

    Differences have to be narrow here: wide ones move the corner over the stages of the method. The last line
    shows that the limit matters: without it the derivative is another one.
    """
    walker = npd(biped, torque_limit=95.0)
    P = ba.ReturnMap(walker, ba.RK4(1e-3))
    s = P.project(pre_impact(biped))
    w = np.random.default_rng(3).normal(size=9)
    expected = directional(P, s, w, 1e-7)
    limited = differentiate_step(P, s).jacobian @ w
    close(limited, expected, 5e-6)
    free = differentiate_step(replace(P, walker=npd(biped)), s).jacobian @ w
    assert np.max(np.abs(free - expected)) > 1e-4 * np.max(np.abs(expected))


# -- the table of methods ----------------------------------------------------------------------------
@pytest.fixture(scope="module")
def published(biped):
    """Return map, step and central differences of the published gait."""
    P = ba.ReturnMap(npd(biped), ba.RK4(1e-3))
    return P, periodic_orbit(P, pre_impact(biped))[1]


def test_table_of_the_published_gait(published, biped, gait):
    """Both methods agree, the variational equation is trusted, and the largest multiplier is delta^2 =
    0.694390 of the zero dynamics, as the impact keeps this gait's constraint (gap below 1e-9)."""
    P, step = published
    table = stability_table(P, step)
    assert table.trusted is table.variational
    assert table.agree
    assert table.stable
    assert table.verdict.count("agrees within") == 1
    assert table.verdict.endswith("the cycle is stable, the largest |lambda| is 0.694390.")
    assert invariance_gap(biped, gait.constraint) < 1e-9
    delta2 = ZeroDynamics.of(biped, gait.constraint).delta ** 2
    assert table.trusted[0] == pytest.approx(delta2, rel=1e-6)
    lines = table.text(3).splitlines()
    assert len(lines) == 3
    assert lines[0].split()[2] == f"{step.multipliers[0].real:.6e}"


EQUATION = np.array([0.7, 0.5 + 0.1j, 0.5 - 0.1j, 1e-3])
LARGEST, LEAST = np.eye(4)[[0, 3]]
NOISE = {"noise": np.array([1e-9, 1e-9, 1e-9, 2e-6])}


@pytest.mark.parametrize(
    ("agree", "other", "more"),
    [
        (True, EQUATION + 6e-7 * LARGEST - 9e-8 * LEAST, {}),
        (False, EQUATION + 8e-7 * LARGEST, {}),  # 1e-6 relative
        (False, EQUATION + 2e-7 * LEAST, {}),  # 1e-7 absolute
        (True, EQUATION + 1e-6 * LEAST, NOISE),
        (False, EQUATION + 3e-6 * LEAST, NOISE),
        (False, EQUATION + 1e-6 * LARGEST, NOISE),  # the noise of another multiplier
        (True, EQUATION[[0, 2, 1, 3]], {}),
        (False, np.abs(EQUATION), {}),  # the pair made real
        (True, 5 * EQUATION, {"doubt": "too short"}),
        (False, 5 * EQUATION, {}),
    ],
)
def test_methods_agree_within_tolerance_or_noise_in_any_order(agree, other, more):
    """`other`: multipliers by differences, `EQUATION` [0.7, a pair, 1e-3] those of the variational equation, of
    which LARGEST and LEAST move the first and the last.
    They agree within 1e-6 relative or 1e-7 absolute, or their own noise (`NOISE`: 2e-6 of the least, 1e-9 of
    the others), in any order; one in doubt is not compared."""
    table = StabilityTable(other, EQUATION, **more)
    assert table.agree == agree
    assert ("agrees within" in table.verdict) == (agree and not table.doubt)
    assert ("disagrees" in table.verdict) == (not agree)


@pytest.mark.parametrize("residual", [1e-2, math.nan])
def test_an_equation_that_misses_the_flow_hands_the_trust_over(published, residual):
    """The residual says how well Phi maps the flow along the orbit, at most 1e-5: at 1e-2 or NaN the central
    differences are trusted instead, and stability is theirs."""
    P, step = published
    table = stability_table(P, replace(step, flow_residual=residual))
    assert table.trusted is table.central
    assert table.verdict.startswith("Variational equation: not to be trusted, its Phi misses")
    # 1.7 times the largest, 0.69, is above 1
    assert not replace(table, central=1.7 * table.central).stable


def test_recipe_gait_without_invariance(biped):
    """The impact leaves this gait's constraint, so delta^2 is no multiplier; the largest one is shown by P
    itself, moved along its eigenvector w by 1e-5."""
    gait = ba.load_gait("recipe", biped)
    assert invariance_gap(biped, gait.constraint) > 0.1
    walker = npd(biped, controller=ba.NPDController(gait.constraint))
    P = ba.ReturnMap(walker, ba.RK4(1e-3))
    orbit, step = periodic_orbit(P, np.concatenate((gait.q_minus, gait.v_minus)))
    assert orbit.stable
    values, vectors = np.linalg.eig(step.jacobian)
    first = np.argmax(np.abs(values))
    w = vectors[:, first].real
    close(directional(P, step.s, w, 1e-5), values[first].real * w, 1e-5)
    delta2 = ZeroDynamics.of(biped, gait.constraint).delta ** 2
    assert abs(delta2 - values[first].real) > 10.0 * RELATIVE  # the tolerance of the table, 1e-6


# -- the noise of differences ----------------------------------------------------------------------
def test_differences_are_within_their_noise_and_their_noise_is_small():
    """The multipliers of gait v0.8 are 1e-7, with sensitivities of a hundred. The bound of the error of
    differences of width d has to hold, to fall with the integration step h, and, where d is so small that the
    error shows, to be less than 200 times that error."""
    cycle = cycle_of(ba.Scenario("NPD", gait="v0.8"))
    bounds = {}
    for h, widths in ((1e-3, [1e-4]), (5e-4, [1e-4, 1e-7])):
        P = replace(cycle.P, method=ba.RK4(h))
        orbit, step = periodic_orbit(P, cycle.guess)
        for d in widths:
            wide, s = replace(P, difference=d), P.project(orbit.x_minus)
            sizes = np.abs(central_multipliers(wide, s)), np.abs(step.multipliers)
            wrong, noise = np.max(np.abs(sizes[0] - sizes[1])), noise_of_differences(wide, step)
            assert wrong <= np.max(noise)
            bounds[h, d] = wrong, np.max(noise)
    assert bounds[5e-4, 1e-4][1] < min(5e-6, 0.1 * bounds[1e-3, 1e-4][1])
    wrong, bound = bounds[5e-4, 1e-7]
    assert wrong > 1e-7
    assert bound < 200.0 * wrong
