"""Return map, regression, certificates, checks and the map of pushes."""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.quadrature import integrate
from biped_adrc.core.errors import InputError, SimulationError
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.paper.poincare import regress_multipliers
from biped_adrc.scenario.push import Push
from biped_adrc.scenario.run import execute
from biped_adrc.scenario.scenario import Scenario


@pytest.fixture(scope="module")
def return_map(biped, gait):
    return ba.ReturnMap(ba.Walker(biped, ba.NPDController(gait.constraint)), ba.RK4(1e-3))


def test_largest_multiplier_is_delta_squared(return_map, biped, gait):
    """Two routes that share no code: differences of the simulated map, and one quadrature."""
    orbit = return_map.fixed_point(np.concatenate((gait.q_minus, gait.v_minus)))
    delta2 = ZeroDynamics.of(biped, gait.constraint).delta ** 2
    sizes = np.abs(orbit.multipliers)
    assert abs(sizes[0] - delta2) < 1e-5
    assert np.all(sizes[1:] < 1e-3)
    assert orbit.stable
    assert orbit.x_minus[:5] == pytest.approx(gait.q_minus, abs=1e-7)


def test_section_coordinates_come_back(return_map, gait):
    x = np.concatenate((gait.q_minus, gait.v_minus))
    s = return_map.project(x)
    assert s.shape == (9,)
    assert return_map.lift(s) == pytest.approx(x, abs=1e-12)


def test_adrc_counts_its_observer(biped, gait):
    walker = ba.Walker(biped, ba.ADRCController(gait.constraint))
    x = walker.initial_state(gait.q_minus, gait.v_minus)
    whole = ba.ReturnMap(walker, ba.Exponential(1e-3))
    plant = ba.ReturnMap(walker, ba.Exponential(1e-3), controller_states=False)
    assert whole.project(x).shape == (45,)
    assert plant.project(x).shape == (9,)
    image = whole(whole.project(x))
    assert image[:9] == pytest.approx(plant(plant.project(x)), abs=1e-12)


def test_a_map_without_a_return_raises_with_the_status(return_map, gait):
    x = np.concatenate((gait.q_minus, 0.05 * gait.v_minus))
    with pytest.raises(
        SimulationError, match=r"no return to the section: (FELL|STALLED|SINGULAR|RAN_AWAY)"
    ):
        return_map(return_map.project(x))


def test_regression_finds_a_linear_map_and_warns_when_it_cannot():
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
    with pytest.raises(InputError, match="k >= 3"):
        regress_multipliers(np.zeros((2, 3)), np.zeros(3))


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
    assert c.step_length == pytest.approx(0.3124, abs=1e-4)
    assert len(made.signals.of_step(2).t) < len(made.signals.t)


def test_runs_are_records_and_come_back():
    run = Scenario(
        "NPD",
        pushes=(Push(torque={"torso_pitch": 5.0}, step=2, onset=0.1),),
        hardware={"period": 1e-3},
        run={"impacts": 2},
    )
    assert Scenario(**run.record()) == run
    with pytest.raises(InputError, match="colour: unknown name"):
        Scenario(colour="red")
    outcome = execute(run)
    assert outcome.walked
    assert outcome.x_minus.shape[0] == 2
    assert outcome.run is run


def test_power_balance_over_a_pushed_step(biped, gait):
    """Energy gained is the work of motors and push; the push begins and ends inside the step."""
    push = ba.TorquePulse([30.0] * 4 + [-10.0], step=1, start=0.1, stop=0.3)
    made = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint), push), gait, 1)
    s = made.signals
    power = np.sum(s.u * s.v[:, :4], axis=1) + np.sum(s.zeta * s.v, axis=1)
    gained = s.kinetic[-1] + s.potential[-1] - s.kinetic[0] - s.potential[0]
    assert integrate(s.t, power) == pytest.approx(gained, abs=1e-5 * s.kinetic[0])
    assert abs(integrate(s.t, np.sum(s.zeta * s.v, axis=1))) > 1.0
