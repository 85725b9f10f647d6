"""Return map, regression, certificates, checks and the map of pushes."""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import SimulationError
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.gait.zero_orbits import ZeroOrbits
from biped_adrc.paper.poincare import regress_multipliers
from biped_adrc.scenario.cycle import cycle_of, gait_map
from biped_adrc.scenario.scenario import Scenario


@pytest.fixture(scope="module")
def return_map(biped, gait):
    return ba.ReturnMap(ba.Walker(biped, ba.NPDController(gait.constraint)), ba.RK4(1e-3))


def test_a_map_without_a_return_raises_with_the_status(return_map, gait):
    x = np.concatenate((gait.q_minus, 0.05 * gait.v_minus))
    with pytest.raises(
        SimulationError, match=r"no return to the section: (FELL|STALLED|SINGULAR|RAN_AWAY)"
    ):
        return_map(return_map.project(x))


def test_regression_finds_a_linear_map_and_warns_when_it_cannot():
    """Seven random points give the multipliers of a 3 x 3 map; points on one line leave two of them open."""
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
    made = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 2)
    c = made.certificates[-1]
    assert c.joint_work == pytest.approx(c.energy_lost, rel=1e-4)
    assert c.violations() == ()
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
    assert len(made.signals.of_step(2).t) < len(made.signals.t)


def test_samples_of_the_return_map_are_those_of_the_zero_dynamics(biped, gait):
    """With its rates f times those of the gait a walker has f^2 zeta*, and rates go with sqrt(zeta)."""
    orbits = ZeroOrbits.of(ZeroDynamics.of(biped, gait.constraint))
    f = np.array([0.95, 1.05])
    rate = biped.phase @ gait.v_minus
    zeta = np.array([orbits.rho(k**2 * orbits.zeta_star) for k in f])
    P = gait_map(Scenario("NPD"), observer_states=False).P
    starts = (np.concatenate((gait.q_minus, k * gait.v_minus)) for k in f)
    after = [biped.phase @ P.lift(P(P.project(x)))[biped.n : 2 * biped.n] for x in starts]
    np.testing.assert_allclose(after, rate * np.sqrt(zeta / orbits.zeta_star), rtol=1e-7)


def test_a_cycle_without_the_observer_s_states_has_a_multiplier_for_each_coordinate_of_the_section():
    """n angles on the ground and n rates: 2 n - 1 = 9, whatever the observer keeps."""
    result = ba.cycle_stability(cycle_of(Scenario("ADRC"), observer_states=False))
    assert len(result.orbit.multipliers) == 9
    assert result.table.stable
