"""Return map, regression, certificates, checks and the map of pushes.

The return map P goes from just before one impact to just before the next, in coordinates s of the section where
the swing foot is on the ground. (q_minus, v_minus) is the state of a gait before its impact; NPD is the paper's
feedback linearisation with PD, ADRC has an observer besides. `return_map` is P under NPD;
`refused(error, text, call, ...)`: the call has to raise this error with this text.
"""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis import gait_design, signals, variational
from biped_adrc.analysis.return_map import after_impact, newton_step
from biped_adrc.analysis.stability import Cycle, StabilityTable, nominal_step
from biped_adrc.analysis.statistics import rms
from biped_adrc.analysis.stride_gain import BUMP, bumped
from biped_adrc.analysis.tick_derivative import tick_derivative
from biped_adrc.analysis.touchdowns import touchdowns
from biped_adrc.core.errors import GaitError, InputError, SimulationError, SingularError
from biped_adrc.core.tree import Layout
from biped_adrc.gait.design.optimise import Optimum
from biped_adrc.gait.design.request import GaitRequest, StepLimits
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.gait.zero_orbits import ZeroOrbits
from biped_adrc.hardware.touchdown import FaultyTouchdown
from biped_adrc.paper.poincare import regress_multipliers
from biped_adrc.scenario.cycle import cycle_of, gait_map
from biped_adrc.scenario.scenario import Scenario


@pytest.fixture(scope="module")
def return_map(biped, gait):
    return ba.ReturnMap(ba.Walker(biped, ba.NPDController(gait.constraint)), ba.RK4(1e-3))


def test_a_map_without_a_return_raises_with_the_status(return_map, gait):
    """With 5 % of the gait's rates the robot does not come over its stance foot: P has no value, and the
    error says how the run ended."""
    x = np.concatenate((gait.q_minus, 0.05 * gait.v_minus))
    with pytest.raises(
        SimulationError, match=r"no return to the section: (FELL|STALLED|SINGULAR|RAN_AWAY)"
    ):
        return_map(return_map.project(x))


def test_regression_finds_a_linear_map_and_warns_when_it_cannot():
    """Seven points x, Phi x, Phi^2 x, ... give back the eigenvalues of a 3 x 3 matrix Phi; points on one line
    have rank 1, which leaves two eigenvalues open."""
    random = np.random.default_rng(0)
    Phi = np.diag([0.9, -0.5, 0.2])
    x = [random.normal(size=3)]
    for _ in range(6):
        x.append(Phi @ x[-1])
    good = regress_multipliers(np.array(x), np.zeros(3))
    assert good.magnitudes == pytest.approx([0.9, 0.5, 0.2], abs=1e-8)
    assert good.warning == ""
    line = np.outer(0.7 ** np.arange(8), np.ones(3))
    poor = regress_multipliers(line, np.zeros(3))
    assert poor.rank == 1
    assert "no multipliers" in poor.warning


def test_certificate_says_what_dry_ground_would_not_bear(biped, gait):
    """On a cycle the motors do the work that the impact loses; each number beyond its limit gives one
    sentence. The walk needs 108 N m and a friction of 0.45, 0.52 at impact: limits of 50 N m and 0.1 are
    broken."""
    made = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 2)
    c = made.certificates[-1]
    assert c.joint_work == pytest.approx(c.energy_lost, rel=1e-4)
    assert c.violations() == ()
    assert replace(c, old_foot_velocity=0.0).violations() == (
        "the old stance foot does not lift off",
    )
    assert made.certified(ba.Limits(friction=0.1))[-1].violations() == (
        f"friction {c.mean_friction:.3g} > 0.1 over 5 ms",
        f"the impulse at impact asks for friction {c.impulse_ratio:.3f} > 0.1",
    )
    slippery, weak = (
        made.certified(ba.Limits(**x))[-1] for x in ({"friction": 0.1}, {"torque": 50.0})
    )
    assert slippery.violations(but=("friction", "impulse")) == ()
    assert "torque" in weak.violations()[0]
    # the step of x*, and the signals of one of its two steps
    assert c.step_length == pytest.approx(0.3124, abs=1e-4)
    assert [set(made.signals.of_step(k).step) for k in (1, 2)] == [{1}, {2}]


def test_samples_of_the_return_map_are_those_of_the_zero_dynamics(biped, gait):
    """P of the whole robot against the map rho of the zero dynamics, a quadrature without a simulation. zeta
    is half the square of the angular momentum before an impact: with rates f times those of the gait it is
    f^2 zeta*, and the rate of Theta, the phase, goes with sqrt(zeta)."""
    orbits = ZeroOrbits.of(ZeroDynamics.of(biped, gait.constraint))
    f = np.array([0.95, 1.05])
    rate = biped.phase @ gait.v_minus
    zeta = np.array([orbits.rho(k**2 * orbits.zeta_star) for k in f])
    P = gait_map(Scenario("NPD"), observer_states=False).P
    starts = (np.concatenate((gait.q_minus, k * gait.v_minus)) for k in f)
    after = [biped.phase @ P.lift(P(P.project(x)))[biped.n : 2 * biped.n] for x in starts]
    np.testing.assert_allclose(after, rate * np.sqrt(zeta / orbits.zeta_star), rtol=1e-7)


def test_a_cycle_without_the_observer_s_states_has_a_multiplier_for_each_coordinate_of_the_section():
    """RABBIT has n = 5 angles, of which the foot on the ground leaves n - 1, and n rates: 2 n - 1 = 9,
    whatever the observer keeps."""
    result = ba.cycle_stability(cycle_of(Scenario("ADRC"), observer_states=False))
    assert len(result.orbit.multipliers) == 9
    assert result.table.stable


# -- what is refused -------------------------------------------------------------------------------
def refused(error, text, call, *arguments, **named):
    with pytest.raises(error, match=text):
        call(*arguments, **named)


def test_return_maps_that_cannot_be_made_are_refused(return_map, gait, biped, monkeypatch):
    """Each line breaks one thing that a return map or Newton's search for P(s) = s needs, and has to get the
    sentence on it."""
    P, w = return_map, return_map.walker
    x = np.concatenate((gait.q_minus, gait.v_minus))
    s, behind, no_return = P.project(x), np.append(biped.relabel(x[:5]), x[5:]), "never returns"
    # a controller that notices touchdowns counts them, and noise is another one at each step: no state returns
    notices = replace(w, timing=ba.SampledTime(1e-3, restart=False), touchdown=FaultyTouchdown())
    refused(InputError, no_return, replace, P, walker=notices)
    noisy = replace(w, timing=ba.SampledTime(1e-3), sensors=ba.Sensors(noise=1e-3))
    refused(InputError, no_return, replace, P, walker=noisy)
    # where the foot's height does not change with the torso angle, so that Newton's step is infinite
    up = math.atan2(*biped.swing_foot(np.append(x[:4], 0.0)))
    refused(SimulationError, "no torso angle puts the swing foot", replace(P, pitch=up).lift, s)
    # the legs exchanged: the swing foot is behind the stance foot
    refused(SimulationError, "not an impact", after_impact, w, 0.0, behind, ba.Mode())
    # a walking step lasts 0.4 s
    short = Cycle(replace(P, walker=replace(w, max_step_time=0.01)), x)
    orbit = SimpleNamespace(x_minus=x)
    refused(SimulationError, "of the cycle ended before: STALLED", nominal_step, short, orbit)
    refused(SingularError, "1 - dP/ds, by which", newton_step, np.eye(2), np.ones(2))
    # a map that always lands 2 beside s has no fixed point; a tolerance of 0 is never reached. One iteration
    # is enough here, and the sentence names the usual 12
    wrong = SimpleNamespace(image=s + 2.0, jacobian=np.zeros((9, 9)))
    monkeypatch.setattr(variational, "differentiate_step", lambda P, s: wrong)
    monkeypatch.setattr(variational, "MOST_ITERATIONS", 1)
    ended = r"in 12 iterations: residual .*, expected below 0"
    refused(SimulationError, ended, variational.periodic_orbit, P, x, 0.0)
    refused(SimulationError, ended, P.fixed_point, x, 0.0)


def test_derivatives_that_cannot_be_made_are_refused(return_map, gait, biped):
    """The variational equation needs a smooth flow without states of a controller; the derivative of a tick
    needs sample instants; delays of touchdowns need a detector, a stride's direction a number per motor."""
    P, w = return_map, return_map.walker
    x = np.concatenate((gait.q_minus, gait.v_minus))
    smooth, system = "needs continuous time and no disturbance", variational.VariationalSystem
    refused(InputError, smooth, system, replace(w, timing=ba.SampledTime(1e-3)))
    refused(InputError, smooth, system, replace(w, disturbance=ba.TorquePulse([1.0] * 5)))
    refused(InputError, "found a walker in continuous time", tick_derivative, w, Layout.of(x))
    states = replace(w, controller=ba.ADRCController(gait.constraint))
    own, s = replace(P, walker=states), replace(P, walker=states).project(x)
    full = np.append(s, np.zeros(states.layout_of(x).size - 10))
    refused(InputError, "has states of its own, the va", variational.differentiate_step, own, full)
    run = SimpleNamespace(events=lambda guard: ())
    refused(InputError, "knows touchdowns at once", touchdowns, w, run)
    refused(InputError, r"\(1.0,\), expected 4 numbers", ba.stride_response, gait, biped, (1.0,))


def test_the_word_on_multipliers_is_that_of_the_method_that_is_trusted():
    """The multipliers z by central differences alone, then beside those of the variational equation, which is
    trusted: 3e-6 relative are 3 tolerances of 1e-6, unless the noise of the differences is larger."""
    z = np.array([0.5 + 0.6j, 0.5 - 0.6j, 0.1])
    last = "the largest |lambda| is 0.781025."
    alone = StabilityTable(z)  # the largest |z| is sqrt(0.61)
    assert alone.verdict == f"Trust the central differences: the cycle is stable, {last}"
    assert (alone.agree, alone.gap(), alone.stable) == (True, 0.0, True)
    assert not StabilityTable(np.array([1.0 + 0.0j])).stable
    both = StabilityTable(z * (1.0 + 3e-6), z)
    assert both.gap() == pytest.approx(3.0, rel=1e-5)
    assert both.verdict == (
        "Central differences: disagrees, 3 times the tolerance of 1e-06 relative or 1e-07 absolute or what "
        "root finder and step leave open, at most 0.0e+00. Trust the "
        f"variational equation: the cycle is stable, {last}"
    )
    noisy = replace(both, noise=np.array([0.0, 4e-6, 0.0]) + 1e-5)
    assert (
        "agrees within 1e-06 relative or 1e-07 absolute or what root finder and step leave open, at "
        in (noisy.verdict)
    )
    # text(2): with the two largest
    assert alone.text(2).startswith("central differences          7.810250e-01 7.810250e-01\nTrust")


# -- numbers with closed forms ---------------------------------------------------------------------
def test_integrals_and_means_of_signals():
    """Integrals are compared with the primitives of a cubic, for which the rule is exact on uneven nodes; a
    repeated time is a jump, at which the integral is split. The rms of (t, 2 t) is that of all entries.
    """
    t = np.array([0.0, 0.1, 0.4, 0.5, 1.0])
    cubic = t**3 - 2.0 * t**2 + 3.0
    assert signals.integrate(t, cubic) == pytest.approx(0.25 - 2.0 / 3.0 + 3.0, abs=1e-14)
    twice = np.append(t, 1.0 + t), np.append(cubic, 2.0 * cubic)  # a jump between two pieces
    assert signals.integrate(*twice) == pytest.approx(3.0 * (0.25 - 2.0 / 3.0 + 3.0), abs=1e-13)
    assert signals.integrate(t[:3], t[:3]) == pytest.approx(0.08)  # trapezoids below four nodes
    assert rms(t, np.column_stack((t, 2.0 * t))) == pytest.approx(math.sqrt(2.5 / 3.0))
    assert rms(t[:1], np.array([[3.0, 4.0]])) == pytest.approx(math.sqrt(12.5))


def test_accelerations_skip_differences_over_no_time():
    """q'' at a node is the difference over the last interval that is longer than round-off, or the next at the
    start. `rows`: for each time the row of dx = (q', q'') whose q'', 2 row + 1, has to be found."""
    dx = np.arange(12.0).reshape(6, 2)
    for t, rows in (
        ([0.0, 1.0, 2.0, 3.0, 4.0, 5.0], [0, 1, 2, 3, 4, 5]),
        ([0.0, 1.0, 1.0, 2.0, 3.0, 4.0], [0, 1, 2, 3, 4, 5]),
        ([0.0, 1.0, 1.0 + 1e-10, 2.0, 3.0, 4.0], [0, 0, 0, 3, 4, 5]),
        ([0.0, 1e-10, 1.0, 2.0, 3.0, 4.0], [2, 2, 2, 3, 4, 5]),
        ([0.0, 1e-10, 2e-10, 3e-10, 4e-10, 5e-10], [0, 1, 2, 3, 4, 5]),
    ):
        arc = SimpleNamespace(t=np.array(t), dx=dx)
        assert signals.accelerations(arc, 1)[:, 0].tolist() == (2.0 * np.array(rows) + 1.0).tolist()


def test_the_bump_of_a_stride_is_64_s3_1_s_3(gait):
    """The bump b(s) that bends a gait's curve is zero with two derivatives at both ends and 1 in the middle,
    where `bumped` has to move the joints by the whole shift."""
    h, s = gait.constraint, np.array([0.0, 0.25, 0.5, 1.0])
    assert np.polyval(BUMP[::-1], s) == pytest.approx(64.0 * (s * (1.0 - s)) ** 3, abs=1e-12)
    shift, middle = np.array([0.1, 0.0, -0.2, 0.0]), 0.5 * (h.theta_plus + h.theta_minus)
    assert bumped(h, shift).h(middle)[0] - h.h(middle)[0] == pytest.approx(shift, abs=1e-9)


# -- a designed gait -------------------------------------------------------------------------------
def test_a_gait_is_certified_by_its_walk(biped, gait, monkeypatch):
    """A design is accepted only if its simulated walk keeps the limits and comes back: a limit of 1 N m, or
    rates that are off by 2e-6 rad/s where 1e-6 is allowed, refuse it."""
    walk = gait_design.simulate_by  # not with step control, which no compiled walk has
    quick = lambda *x, **more: walk(*x[:4], ba.RK4(1e-3), **more)  # noqa: E731
    monkeypatch.setattr(gait_design, "simulate_by", quick)
    request, found = GaitRequest(0.75), Optimum(gait, 1.25, 7, 0.5)
    design = gait_design.certify(biped, request, found)
    assert (design.iterations, design.seconds, design.objective) == (7, 0.5, 1.25)
    lines = design.text().splitlines()
    assert lines[:2] == ["speed                0.750198 m/s", "step length          0.312372 m"]
    assert lines[3] == "least torque         1.25 N^2 m s"
    weak = replace(request, limits=StepLimits(torque=1.0))
    with pytest.raises(GaitError, match=r"not pass its certificate: .* has the torque .* N m > 1$"):
        gait_design.certify(biped, weak, found)
    off = replace(found, gait=replace(gait, v_minus=gait.v_minus + 2e-6))
    with pytest.raises(GaitError, match=r"is left by 5\.0e-06 .* after 2 steps, expected 1e-06"):
        gait_design.certify(biped, request, off)
