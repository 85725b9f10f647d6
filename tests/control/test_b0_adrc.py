"""ADRC without a model, and every ADRC by its bandwidths."""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.adrc import AssistedADRCController
from biped_adrc.control.b0_adrc import B0ADRCController
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.control.output_adrc import OutputADRCController
from biped_adrc.control.tracking import output_matrix
from biped_adrc.core.errors import InputError
from biped_adrc.extras.export.computer import Computer
from biped_adrc.extras.export.source import source_of
from biped_adrc.gait.reference import ZeroReference
from biped_adrc.model.reduction import Reduction

from .off_orbit import off_orbit

GAINS = ba.Gains(900.0, 60.0)
SLOW = ba.GPIObserver.from_bandwidth(20.0, 1)


def uncoupled(kappa, q, v):
    """The measurement of joints alone, each with q'' = kappa u."""
    b, p = np.array(kappa), len(kappa)
    none = np.zeros(p)
    terms = Reduction(
        np.diag(1 / b), none, np.diag(b), none, np.diag(1 / b), np.zeros((0, p)), np.zeros(0)
    )
    return ba.Measurement(0.0, 1, 0.0, np.array(q), np.array(v), terms)


def measured_on(biped, q, v):
    """The measurement of RABBIT at (q, v)."""
    return ba.Measurement(0.0, 1, 0.0, q, v, biped.reduction(q, v))


def test_without_coupling_it_is_the_output_form():
    """Torque and flow are equal where L = diag b_0, in any state of the observer."""
    b, random = (0.4, 1.7), np.random.default_rng(1)
    h, z, u = ZeroReference(2), random.normal(size=(3, 2)), random.normal(size=2)
    m = uncoupled(b, *random.normal(size=(2, 2)))
    one, other = B0ADRCController(h, SLOW, GAINS, b_0=b), OutputADRCController(h, SLOW, GAINS)
    np.testing.assert_allclose(one.output(z, m), other.output(z, m), rtol=1e-12)
    np.testing.assert_allclose(one.flow(z, m, u), other.flow(z, m, u), rtol=1e-12)


def test_with_the_f_of_the_robot_its_torque_is_that_of_the_output_form(biped, gait):
    """f = xi_y + (L - b_0) u holds on RABBIT, coupled: then both torques are equal, and xi is the model's."""
    q, v = off_orbit(gait, biped)
    m, law = measured_on(biped, q, v), B0ADRCController(gait.constraint)
    other = OutputADRCController(gait.constraint, gains=law.gains)
    r, exact = law.point(m), other.measured_output(m)
    u = other.torque(r, exact, m)
    L = output_matrix(r, m.terms) @ m.terms.kappa
    x = exact._replace(disturbance=exact.disturbance + (L - np.diag(law.b_0)) @ u)
    np.testing.assert_allclose(law.torque(r, x, m), u, rtol=1e-9)
    np.testing.assert_allclose(law.joint_estimate(x, m).disturbance, m.terms.xi, rtol=1e-9)


def test_no_term_of_the_model_is_used(biped, gait):
    """With NaN in place of every term of the model torque, start, flow and jump are the same."""
    q, v = off_orbit(gait, biped)
    m, law = measured_on(biped, q, v), B0ADRCController(gait.constraint)
    blind = m._replace(terms=Reduction(*(np.full_like(x, np.nan) for x in m.terms)))
    s, u = law.initial_state(m), np.ones(4)
    for call in (
        law.initial_state,
        lambda m: law.output(s, m),
        lambda m: law.flow(s, m, u),
        lambda m: law.jump(s, m, np.array([1, 0, 3, 2])),
    ):
        np.testing.assert_array_equal(call(blind), call(m))


def test_the_exported_c_has_no_model(biped, gait):
    """No sine and no inertia is in the text; both are in that of ADRC."""
    laws = B0ADRCController(gait.constraint), ba.ADRCController(gait.constraint, SLOW)
    walkers = (ba.Walker(biped, law, timing=ba.SampledTime(1e-3)) for law in laws)
    b0, adrc = (source_of(Computer(walker)).files["controller.c"] for walker in walkers)
    for word in ("inertia", "sin"):
        assert word not in b0
        assert word in adrc


@pytest.mark.parametrize(
    "law", [ba.ADRCController, AssistedADRCController, OutputADRCController, B0ADRCController]
)
@pytest.mark.parametrize("m", [1, 3])
def test_a_joint_has_the_poles_of_the_two_bandwidths(law, m):
    """det(s 1 - A) = (s + omega_c)^2 (s + omega_o)^(m + 2), A of the joint q'' = b u with its controller."""
    b, omega_c, omega_o = 0.7, 3.0, 8.0
    own = {"b_0": b} if law is B0ADRCController else {}
    made = law.from_bandwidth(ZeroReference(1), omega_c, omega_o, m, **own)

    def rate(x):
        at, z = uncoupled([b], x[:1], x[1:2]), x[2:, np.newaxis]
        u = made.output(z, at)
        return np.concatenate((x[1:2], b * u, made.flow(z, at, u)[:, 0]))

    A = np.array([rate(e) for e in np.eye(m + 4)]).T  # the loop is linear: a column for each unit
    for s in (1.0, -2.0 + 5.0j, 20.0j):
        expected = (s + omega_c) ** 2 * (s + omega_o) ** (m + 2)
        assert np.linalg.det(s * np.eye(m + 4) - A) == pytest.approx(expected, rel=1e-9)


def test_the_momentum_observer_has_one_pole_less(gait):
    """Its chain has one integrator between force and momentum: m + 1 poles at -omega_o."""
    made = MomentumDOBController.from_bandwidth(gait.constraint, 30.0, 200.0, 2, solve_theta=False)
    assert made.observer.poles == (-200.0,) * 3
    assert (made.gains.K_p, made.gains.K_d, made.solve_theta) == (900.0, 60.0, False)


@pytest.mark.parametrize("b_0", [-0.5, 0.0, [0.5, 0.6, -0.8, 0.9], [[0.5]], np.nan, "fast"])
def test_b_0_that_is_not_positive_is_refused(gait, b_0):
    """The sentence names b_0, what it is, and what was found."""
    with pytest.raises(
        InputError, match=r"b_0, the acceleration of a joint per torque .* expected"
    ):
        B0ADRCController(gait.constraint, b_0=b_0)


def test_a_wrong_number_of_b_0_is_refused(biped, gait):
    """RABBIT has four motors."""
    law = B0ADRCController(gait.constraint, b_0=[0.5, 0.6, 0.8])
    with pytest.raises(InputError, match="b_0 has 3 numbers, expected 1 or 4: one for each joint"):
        ba.walk(ba.Walker(biped, law), gait, 1)


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ((0.0, 200.0), "omega_c is 0"),
        ((30.0, -1.0), "bandwidth is -1"),
        ((3.0, 9.0, 1.5), "m is 1.5"),
    ],
)
def test_bandwidths_out_of_range_are_refused(gait, given, named):
    """One sentence, which names the number."""
    with pytest.raises(InputError, match=named):
        B0ADRCController.from_bandwidth(gait.constraint, *given)


@pytest.mark.parametrize("name", ["v0.5", "v0.8"])
def test_it_walks_on_rabbits_hardware(name):
    """Encoders, friction and the torque limit of RABBIT; the error stays within 0.03 rad."""
    given = {"gait.name": name, "hardware.profile": "rabbit", "run.impacts": 6}
    walk = ba.walk_scenario(ba.Scenario("ADRC b0", **given))
    assert walk.feasibility.outcome == "feasible"
    assert walk.signals.peak_error < 0.03
