"""The rows of a gait's programme and of its audit, each on numbers that violate it, by Pinocchio's model."""

from __future__ import annotations

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest

from biped_adrc.gait.design.nlp import transcribe
from biped_adrc.gait.design.optimise import (
    Audited,
    _bounds,
    audited,
    missed_limits,
    missed_wishes,
)
from biped_adrc.gait.design.request import GaitRequest, RobotLimits, StepLimits
from biped_adrc.gait.gait import Gait, load_gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped

NODES = 16
KNEES = {"left_knee": (-0.9, -0.2), "right_knee": (-1.1, -0.3)}
ASKED = GaitRequest(0.8, degree=6, nodes=NODES)


@pytest.fixture(scope="module")
def robot() -> Biped:
    return Biped.load("rabbit", "tac2003")


@pytest.fixture(scope="module")
def gait(robot) -> Gait:
    return load_gait("v0.8", robot)


@pytest.fixture(scope="module")
def orbit(robot, gait):
    """The periodic step at the programme's nodes, by Pinocchio."""
    return ZeroDynamics.of(robot, gait.constraint, NODES).cycle


@pytest.fixture(scope="module")
def limits(robot) -> RobotLimits:
    own = StepLimits(0.5, 0.4, 100.0, ranges=KNEES, reserve=0.1, multiplier=0.7)
    return own.of(robot)


@pytest.fixture(scope="module")
def unknowns(robot, gait, orbit):
    """The gait as unknowns of the programme, and the sign of Theta'."""
    rate = float(gait.constraint.phase @ gait.v_minus)
    dq = gait.v_minus / rate
    hit = robot.impact(gait.q_minus, dq)
    c = gait.constraint
    numbers = {
        "q": gait.q_minus,
        "slope": dq[: robot.p],
        "alpha": c.curve.coefficients,
        "theta": np.array([c.theta_plus, c.theta_minus]),
        "after": hit.v_e,
        "impulse": hit.impulse,
        "rate": np.array([abs(rate)]),
        "rates": np.abs(orbit.v @ c.phase),
        "peak": np.array([0.5]),
    }
    return numbers, float(np.sign(rate))


@pytest.fixture(scope="module")
def rows(robot, limits, unknowns):
    """For a name, the numbers of all rows that have it, with their bounds."""
    numbers, direction = unknowns
    programme, symbols = transcribe(robot, ASKED, limits, direction)
    x = np.concatenate([np.ravel(numbers[name], order="F") for name in symbols._fields])

    def of(name: str) -> list[tuple[np.ndarray, float, float]]:
        found = [row for row in programme.rows if row.name == name]
        values = ca.Function("rows", [programme.x], [row.value for row in found])(x)
        values = values if isinstance(values, tuple | list) else (values,)
        return [(v.full().ravel(), r.low, r.high) for v, r in zip(values, found, strict=True)]

    return of


def test_the_gait_is_a_solution_of_the_equations(rows):
    for name in ("the zero dynamics", "periodicity", "the impact", "the slope after impact"):
        ((value, low, high),) = rows(name)
        assert (low, high) == (0.0, 0.0)
        assert np.max(np.abs(value)) < 1e-9, name


def test_friction_is_limited_on_both_sides_with_its_reserve(robot, rows, orbit):
    weight = robot.weight
    F_T, F_N = orbit.ground_reaction.T / weight
    found = rows("friction")
    assert [(low, high) for _, low, high in found] == [(0.0, np.inf)] * 2
    mu = 0.9 * 0.5  # ten per cent are kept back
    for (value, _, _), sign in zip(found, (-1.0, 1.0), strict=True):
        np.testing.assert_allclose(value[:NODES], mu * F_N + sign * F_T, atol=1e-9)


def test_the_impulse_is_limited_on_both_sides_with_its_reserve(robot, gait, rows):
    P_T, P_N = robot.impact(gait.q_minus, gait.v_minus).impulse
    leg = float(np.linalg.norm(robot.hip(np.zeros(robot.n))))
    scale = robot.mass * np.sqrt(robot.description.gravity * leg)
    found = rows("the impulse cone")
    for (value, low, high), sign in zip(found, (-1.0, 1.0), strict=True):
        assert (low, high) == (0.0, np.inf)
        assert value == pytest.approx((0.9 * 0.4 * P_N + sign * P_T) / scale, rel=1e-9)


def test_torque_is_limited_on_both_sides(rows, orbit):
    above, below = rows("the torque limit")
    share = orbit.u.ravel() / 100.0
    np.testing.assert_allclose(above[0][: share.size], share - 0.5, atol=1e-9)
    np.testing.assert_allclose(below[0][: share.size], share + 0.5, atol=1e-9)
    assert (above[1:], below[1:]) == ((-np.inf, 0.0), (0.0, np.inf))


@pytest.mark.parametrize(("objective", "low"), [("torque", 0.9), ("peak", 0.0)])
def test_the_peak_keeps_the_reserve(robot, limits, unknowns, objective, low):
    numbers, direction = unknowns
    asked = replace(ASKED, objective=type(ASKED.objective)(objective))
    _, symbols = transcribe(robot, asked, limits, direction)
    least, most = _bounds(symbols, numbers, asked, limits)
    assert (least[-1], most[-1]) == (low, 0.9)


def test_stability_is_asked_for(robot, gait, rows):
    ((value, low, high),) = rows("stability, delta^2 below 1")
    zero = ZeroDynamics.of(robot, gait.constraint)
    assert value == pytest.approx(zero.delta**2, rel=1e-9)
    assert (low, high) == (-np.inf, 0.7)


def test_each_knee_has_its_own_range_and_reserve(robot, gait, rows, orbit):
    q = np.vstack((orbit.q, gait.start(robot)[0], gait.q_minus))  # the ends come last
    for joint, (low, high) in KNEES.items():
        ((value, least, most),) = rows(f"the range of {joint}")
        np.testing.assert_allclose(value, q[:, robot.description.joint_index(joint)], atol=1e-9)
        assert (least, most) == pytest.approx((low + 0.1 * 0.25, high - 0.1 * 0.25))


# -- the audit -------------------------------------------------------------------------------------
@pytest.fixture(scope="module")
def calm(robot, gait) -> Audited:
    """The audit of a gait whose numbers are then replaced by those of no gait."""
    return audited(robot, gait, NODES)


def missed(robot: Biped, gait: Gait, a: Audited, **own) -> list[str]:
    """What the audit names, without numbers."""
    limits = StepLimits(**{"friction": 0.6, "torque": 150.0, **own}).of(robot)
    return [text.partition(" is ")[0] for text in missed_limits(robot, gait, limits, a)]


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_the_audit_sees_torque_and_friction_of_either_sign(robot, gait, calm, sign):
    assert missed(robot, gait, calm) == []
    for place in (0, 3):
        u = np.zeros_like(calm.orbit.u)
        u[5, place] = sign * 151.0
        hard = calm._replace(orbit=replace(calm.orbit, u=u))
        assert missed(robot, gait, hard) == ["torque left"]
    F_T = calm.F_T.copy()
    F_T[7] = sign * 0.61 * calm.F_N[7]
    assert missed(robot, gait, calm._replace(F_T=F_T)) == ["friction left"]


@pytest.mark.parametrize("joint", ["left_knee", "right_knee"])
@pytest.mark.parametrize(("angle", "word"), [(-2.3, "above its least"), (0.0, "below its largest")])
def test_the_audit_sees_both_knees(robot, gait, calm, joint, angle, word):
    q = calm.orbit.q.copy()
    q[4, robot.description.joint_index(joint)] = angle
    bent = calm._replace(orbit=replace(calm.orbit, q=q))
    assert missed(robot, gait, bent) == [f"{joint} {word}"]


def test_the_audit_asks_for_stability(robot, gait, calm):
    assert missed(robot, gait, calm._replace(delta2=0.94)) == []
    assert missed(robot, gait, calm._replace(delta2=0.96)) == ["stability left, limit - delta^2"]


@pytest.mark.parametrize(("share", "count"), [(0.9e-4, 0), (1.1e-4, 1), (-1.1e-4, 1), (np.nan, 1)])
def test_speed_and_step_are_those_asked_for(calm, share, count):
    speed, step = calm.length / calm.orbit.period, calm.length
    assert missed_wishes(GaitRequest(speed, step), calm) == ()
    longer = calm._replace(length=step * (1.0 + share))
    assert len(missed_wishes(GaitRequest(speed), longer)) == count
    assert len(missed_wishes(GaitRequest(None, step), longer)) == count
