"""Zero dynamics in closed form against simulations that know nothing of them, and the rimless wheel.

zeta = sigma^2 / 2, with sigma the angular momentum about the stance foot just before an impact, describes a
step; zeta_star is the fixed point of its map from step to step, rho. V_zero is the potential of the zero
dynamics over the phase Theta, and delta = sigma+ / sigma- at the impact. Fixtures: bare and published, RABBIT
without rotors and its published gait; orbits, their zero dynamics. wheel(slope) is the rimless wheel with its
constraint.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from scipy.special import ellipkinc

import biped_adrc as ba
from biped_adrc.analysis.certificate import certificates
from biped_adrc.analysis.zero_report import zero_report
from biped_adrc.core.errors import GaitError, InputError
from biped_adrc.gait.curves import Polynomial
from biped_adrc.gait.zero_domain import DomainLimits, domain
from biped_adrc.gait.zero_orbits import ZeroOrbits
from biped_adrc.model.ground import KnownLimits

ALPHA, GRAVITY = math.pi / 8, 9.81
METHOD = ba.RK4(1e-3)


def orbits_of(biped, constraint):
    return ZeroOrbits.of(ba.ZeroDynamics.of(biped, constraint))


@pytest.fixture(scope="module")
def orbits(bare, published):
    return orbits_of(bare, published.constraint)


def walk_from(orbits, gait, zeta, impacts, method=METHOD, **options):
    """The full model under NPD, from the impact with zeta on."""
    b = orbits.zero.biped
    after = b.impact(*orbits.zero.end_state(orbits.sigma(zeta)))
    walker = ba.Walker(b, ba.NPDController(gait.constraint), **options)
    return ba.walk(walker, gait, impacts, method, start=(after.q, after.v))


# -- the full model --------------------------------------------------------------------------------
@pytest.fixture(scope="module")
def fast_walk(orbits, published):
    return walk_from(orbits, published, 1.8 * orbits.zeta_star, 5)


def test_the_map_from_step_to_step_is_that_of_the_simulated_walk(orbits, bare, fast_walk):
    """zeta = sigma^2 / 2, with sigma the angular momentum about the stance foot before an impact. From 1.8
    times the fixed point on, zeta, duration and energy of each step of the full five-link simulation are those
    of the map in closed form.
    """
    zeta = orbits.iterate(1.8 * orbits.zeta_star, 5)
    x = fast_walk.trajectory.before("foot_strike")
    sigma = np.array([bare.angular_momentum(x_k[:5], x_k[5:10]) for x_k in x])
    np.testing.assert_allclose(0.5 * sigma**2, zeta[1:], rtol=1e-6)
    assert np.all(sigma * orbits.sigma(1.0) > 0)
    for before, after, x_k, certificate in zip(
        zeta[:-1], zeta[1:], x, fast_walk.certificates, strict=True
    ):
        assert certificate.duration == pytest.approx(orbits.period(before), rel=1e-6)
        energy = bare.kinetic_energy(x_k[:5], x_k[5:10])
        assert energy == pytest.approx(orbits.kinetic_energy(after), rel=1e-6)


def test_single_support_conserves_zeta_and_potential(orbits, bare, published, fast_walk):
    """sigma^2 / 2 + V_zero(Theta) is constant in a simulated single support, while sigma^2 / 2 itself varies by
    more than a fifth of it.
    """
    arc = fast_walk.trajectory.arcs[0]
    theta = arc.x[:, :5] @ published.constraint.phase
    sigma = np.array([bare.angular_momentum(x[:5], x[5:10]) for x in arc.x])
    constant = 0.5 * sigma**2 + orbits.potential(theta)
    np.testing.assert_allclose(constant, constant[0], rtol=1e-8)
    assert np.ptp(0.5 * sigma**2) > 0.2 * constant[0]


def test_walks_from_inside_the_domain_and_stalls_outside(orbits, published):
    """`lowest` is the zeta at which a step just comes over the top of V_zero: 0.2 % above it the simulated
    robot walks, with the duration computed, and 0.2 % below it stalls. So near the top a step is long, hence 6
    s.
    """
    for share, walks in ((1.002, True), (0.998, False)):
        zeta = share * orbits.lowest
        run = walk_from(orbits, published, zeta, 1, ba.RK4(2e-3), max_step_time=6.0)
        assert run.trajectory.status.ok is walks
        if walks:
            assert run.certificates[0].duration == pytest.approx(orbits.period(zeta), rel=1e-5)


@pytest.mark.parametrize("limits", [DomainLimits(friction=0.5), DomainLimits(torque=90.0)])
def test_the_upper_end_is_where_the_simulated_step_needs_the_limit(orbits, published, limits):
    """A simulated step from a zeta 0.5 % below the upper end keeps the limit, one 0.5 % above violates it. Only
    the limit in question is tight (the other is 99 or 1 kN m), and forces are not averaged: a window of 1e-6 s.
    """
    within = KnownLimits(limits.friction or 99.0, limits.torque or 1e3, 1e-6)
    upper = domain(orbits, limits).upper
    assert upper.cause == ("friction" if limits.friction else "torque")
    for share, keeps in ((0.995, True), (1.005, False)):
        run = walk_from(orbits, published, share * upper.zeta, 1)
        step = certificates(run.walker, run.trajectory, run.signals, within)[0]
        found = step.violations(but=("impulse",))
        assert (found == ()) is keeps, found


@pytest.mark.parametrize("share", [0.45, 2.1])
def test_friction_of_a_step_decides_whether_it_is_in_the_domain(any_biped, share):
    """|F_T| / F_N needed is taken along one step, a slow or a fast one (share of zeta*): with 2 % more friction
    this zeta is in the domain, with 2 % less it is not. Two presets brake most in fast steps, so that F_T of
    both signs matters.
    """
    constraint = ba.load_gait("published", any_biped).constraint
    orbits = orbits_of(any_biped, constraint)
    zeta = share * orbits.zeta_star
    dense = ba.ZeroDynamics.of(any_biped, constraint, nodes=160)
    step = dense.orbit(orbits.delta * orbits.sigma(zeta))  # begins after the impact
    F_T, F_N = step.ground_reaction.T
    needed = float(np.max(np.abs(F_T) / F_N))
    assert domain(orbits, DomainLimits(friction=1.02 * needed)).holds(zeta)
    assert not domain(orbits, DomainLimits(friction=0.98 * needed)).holds(zeta)


def test_the_fixed_point_is_the_published_state(any_biped):
    """zeta* = -V_zero(Theta-) / (1 - delta^2) has the sigma of the gait's state before impact, which was
    published before there was a curve; rho(zeta*) = zeta*.
    """
    gait = ba.load_gait("published", any_biped)
    orbits = orbits_of(any_biped, gait.constraint)
    sigma = any_biped.angular_momentum(gait.q_minus, gait.v_minus)
    assert orbits.sigma(orbits.zeta_star) == pytest.approx(sigma, rel=1e-9)
    assert orbits.rho(0.5 * sigma**2) == pytest.approx(0.5 * sigma**2, rel=1e-9)
    assert orbits.speed(orbits.zeta_star) == pytest.approx(
        any_biped.swing_foot(gait.q_minus)[0] / gait.period, rel=1e-9
    )


# -- the rimless wheel: everything in closed form ----------------------------------------------------
def wheel(slope):
    curve = Polynomial(np.zeros((0, 2)))
    middle = math.pi - slope
    biped = ba.Biped.load("rimless_wheel")
    return biped, ba.VirtualConstraint(curve, biped.phase, middle + ALPHA, middle - ALPHA)


@pytest.mark.parametrize("slope", [0.08, 0.2])
def test_the_rimless_wheel_has_its_closed_forms(slope):
    """The wheel is McGeer's of 1990, with unit mass and spokes: an inverted pendulum between impacts that take
    1 - cos^2 2 alpha.
    """
    orbits = orbits_of(*wheel(slope))
    d2 = math.cos(2 * ALPHA) ** 2
    fall = 2.0 * GRAVITY * math.sin(ALPHA) * math.sin(slope)
    rise = GRAVITY * (1.0 - math.cos(ALPHA - slope))
    for found, expected in (
        (orbits.delta**2, d2),
        (orbits.v_end, -fall),
        (orbits.v_max, rise),
        (orbits.zeta_star, fall / (1.0 - d2)),
        (orbits.lowest, rise / d2),
        (orbits.step_length, 2.0 * math.sin(ALPHA)),
    ):
        assert found == pytest.approx(expected, rel=1e-10)
    assert orbits.theta_max == pytest.approx(math.pi, abs=1e-10)
    for zeta in (1.01 * orbits.lowest, orbits.zeta_star):
        # rate^2 = 2 (top + g (1 - cos x)), x from the vertical
        top = d2 * zeta - rise
        m = -2.0 * GRAVITY / top
        time = sum(ellipkinc(0.5 * x, m) for x in (ALPHA - slope, ALPHA + slope))
        assert orbits.period(zeta) == pytest.approx(time * math.sqrt(2.0 / top), rel=1e-8)
    assert orbits.speed(orbits.lowest) == 0.0


def test_the_lower_end_of_a_curve_that_only_falls_is_a_start_from_rest():
    """A wheel that starts beyond the vertical has no V_max to pass: it walks from rest, zeta = 0, in a finite
    time, that of the simulation.
    """
    biped, constraint = wheel(0.2)
    constraint = dataclasses.replace(constraint, theta_plus=math.pi - 0.1)
    orbits = orbits_of(biped, constraint)
    assert orbits.lowest == 0.0
    walker = ba.Walker(biped, ba.Passive(), slope=0.2, max_step_time=10.0)
    x = walker.initial_state(np.array([constraint.theta_plus]), np.zeros(1))
    once = ("foot_strike", 1)
    run = ba.simulate(walker, x, ba.Mode(), ba.RK4(1e-3), t_end=10.0, stop_after=once)
    assert orbits.step_length / orbits.speed(0.0) == pytest.approx(run.t_end, rel=1e-7)


def test_a_spoke_pushes_along_itself():
    """The hub flies off when rate^2 > g cos x, x the angle of the spoke (1 m) from the vertical: first at the
    end. The friction asked for is tan(alpha), always, with 2 alpha the angle between spokes.
    """
    slope = 0.2
    orbits = orbits_of(*wheel(slope))
    upper = domain(orbits, DomainLimits(slope=slope)).upper
    assert upper.cause == "lift-off"
    assert upper.theta == pytest.approx(math.pi - slope - ALPHA)
    assert orbits.rho(upper.zeta) == pytest.approx(
        0.5 * GRAVITY * math.cos(slope + ALPHA), rel=1e-8
    )
    rough = domain(orbits, DomainLimits(friction=0.42, slope=slope))  # tan(alpha) = 0.4142
    assert not rough.empty
    assert rough.upper.zeta == pytest.approx(upper.zeta, rel=1e-8)
    assert domain(orbits, DomainLimits(friction=0.41, slope=slope)).empty


def test_multiplier_of_the_wheel_is_delta_squared():
    """The return map of the simulated wheel, started 2 % too fast, has its fixed point at zeta*, and delta^2 of
    the closed form as its multiplier.
    """
    biped, constraint = wheel(0.12)
    orbits = orbits_of(biped, constraint)
    walker = ba.Walker(biped, ba.Passive(), slope=0.12, max_step_time=10.0)
    q, v = orbits.zero.end_state(orbits.sigma(orbits.zeta_star))
    # pitch: where the search for the wheel's angle begins, upright
    found = ba.ReturnMap(walker, ba.Adaptive(), pitch=math.pi).fixed_point(np.append(q, 1.02 * v))
    assert found.multipliers[0].real == pytest.approx(orbits.delta**2, rel=1e-6)
    assert found.x_minus == pytest.approx(np.append(q, v), rel=1e-8)


# -- when there is no orbit ----------------------------------------------------------------------------
def test_zero_dynamics_without_a_fixed_point_name_the_condition(bare, published, orbits):
    """Each condition is broken alone: a slope too small to pass the top (V_max), one uphill, an impact that
    gives energy (delta 1.1), curves on which I(Theta) changes its sign, so that Theta is no phase, and a zeta
    from which a step is not completed.
    """
    with pytest.raises(GaitError, match="V_max"):
        _ = orbits_of(*wheel(0.05)).zeta_star
    with pytest.raises(GaitError, match="expected below 0"):
        _ = orbits_of(*wheel(-0.05)).zeta_star
    with pytest.raises(GaitError, match="expected below 1"):
        _ = dataclasses.replace(orbits, delta=1.1).zeta_star
    # delta = 1: the impact takes nothing, so zeta* is at infinity
    assert dataclasses.replace(orbits, delta=1.0).existence == math.inf
    c = published.constraint
    steep = np.zeros((4, 2))
    # joints stay at their first angles, but the swing hip turns by 4 rad
    steep[:, 0], steep[1] = c.h(c.theta_plus)[0], [3.0, 4.0]
    bent = ba.VirtualConstraint(Polynomial(steep), c.phase, c.theta_plus, c.theta_minus)
    with pytest.raises(GaitError, match="sign"):
        orbits_of(bare, bent)
    # the last one is so near the top that the duration cannot be computed to 1e-6 of it
    for zeta in (0.9 * orbits.lowest, float("nan"), orbits.lowest * (1.0 + 1e-15)):
        with pytest.raises(GaitError):
            orbits.period(zeta)
    for wrong in ({"friction": -1.0}, {"slope": 1.6}):
        with pytest.raises(InputError):
            DomainLimits(**wrong)


REPORT = """\
robot rabbit, parameters identified-bare; slope 0 rad
Theta           3.339776 to 2.925973 rad
I(Theta)        15.2358 to 20.9823 kg m^2
delta^2         0.694390, the multiplier of the cycle: stable
V_zero(Theta-)  -75.6054 kg^2 m^4/s^2
V_max           57.9014 kg^2 m^4/s^2 at Theta = 3.1589 rad
existence       -113.8852 kg^2 m^4/s^2 < 0: a periodic orbit exists
zeta*           247.3920 kg^2 m^4/s^2, sigma- = -22.24374 kg m^2/s
orbit           period 0.429119 s, speed 0.7279 m/s
                16.399 J before impact, step 0.3124 m
impact          asks for |F_T| / F_N = 0.856, at any speed
domain          83.3845 (V_max at Theta = 3.1589 rad) < zeta < 530.3929 (friction at Theta = 3.1010 rad) \
kg^2 m^4/s^2
speeds in it    0.0000 to 1.1249 m/s, of the first step
energies in it  5.527 to 35.159 J before impact
settled         to 0.1% of zeta* after 18 steps from the lower end, 20 from the upper"""


# -- report, picture, command ----------------------------------------------------------------------------
def test_report_says_what_does_not_hold(bare, published):
    """The text for the published gait is REPORT. Then what does not hold: friction 0.01 leaves no speed, a
    torque limit of 60 N m is exceeded, the recipe is not hybrid invariant. Another slope is refused.
    """
    good = zero_report(bare, published.constraint, DomainLimits(0.6, 150.0))
    assert good.walkable
    assert good.text() == REPORT
    o, star = good.orbits, good.zeta_star
    # steps from k zeta* until zeta is within 1e-3 zeta* of zeta*; `iterate` agrees
    assert [o.steps_to(k * star, 1e-3) for k in (1.0009, 1.0011, 2.0)] == [0, 1, 19]
    assert (
        abs(o.iterate(2.0 * star, 19)[-1] / star - 1.0)
        <= 1e-3
        < o.iterate(2.0 * star, 18)[-1] / star - 1.0
    )
    empty = zero_report(bare, published.constraint, DomainLimits(0.01, 150.0)).text().splitlines()
    kept = "F_N > 0, friction 0.01, torque 150 N m"
    assert empty[-2:] == [
        f"domain          empty: no speed keeps {kept} all along the step",
        f"the periodic orbit does not keep {kept}: zeta* is outside of the domain",
    ]
    # neither friction nor torque has a limit
    bold = zero_report(bare, published.constraint, DomainLimits(None, None)).text()
    assert "< 601.8947 (lift-off at Theta = 3.1037 rad)" in bold.replace("zeta ", "")
    weak = zero_report(bare, published.constraint, DomainLimits(torque=60.0))
    assert "does not keep" in weak.text()
    recipe = ba.load_gait("recipe", bare)
    assert "the impact leaves the constraint" in zero_report(bare, recipe.constraint).text()
    with pytest.raises(GaitError, match=r"above the ground of slope 0\.1 rad"):
        zero_report(bare, published.constraint, DomainLimits(slope=0.1))
