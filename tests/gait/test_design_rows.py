"""The rows of a gait's programme and of its audit, each on numbers that violate it, by Pinocchio's model.

The programme is the nonlinear one that IPOPT solves; the audit is the judgement of a gait that is finished.
Fixtures: robot and its stored gait v0.8; orbit, the periodic step of this gait at the programme's nodes;
limits; unknowns, (the gait as unknowns of the programme, sign of Theta'); rows(name), for each constraint of
this name its numbers at the gait, and its lower and upper bound.
"""

from __future__ import annotations

from dataclasses import replace

import casadi as ca
import numpy as np
import pytest

from biped_adrc.gait.design.nlp import LATE, transcribe
from biped_adrc.gait.design.optimise import _bounds, audit
from biped_adrc.gait.design.request import GaitRequest, RobotLimits, StepLimits
from biped_adrc.gait.design.step import Unknowns, at_gait, stacked
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
def unknowns(robot, gait, orbit) -> tuple[Unknowns, float]:
    """The gait as unknowns of the programme, and the sign of Theta'."""
    c = gait.constraint
    rate = float(c.phase @ gait.v_minus)
    dq, rates = gait.v_minus / rate, np.abs(orbit.v @ c.phase)
    numbers = at_gait(robot, c, gait.q_minus, dq, abs(rate), rates, 0.5)
    return numbers, float(np.sign(rate))


@pytest.fixture(scope="module")
def rows(robot, limits, unknowns):
    """For a name, the numbers of all rows that have it, with their bounds."""
    numbers, direction = unknowns
    programme, _ = transcribe(robot, ASKED, limits, direction)
    x = stacked(numbers)

    def of(name: str) -> list[tuple[np.ndarray, float, float]]:
        found = [row for row in programme.rows if row.name == name]
        values = ca.Function("rows", [programme.x], [row.value for row in found])(x)
        values = values if isinstance(values, tuple | list) else (values,)
        return [(v.full().ravel(), r.low, r.high) for v, r in zip(values, found, strict=True)]

    return of


def test_the_gait_is_a_solution_of_the_equations(rows):
    """At a stored gait, with all numbers by Pinocchio, each equation of the CasADi programme (both bounds 0) is
    satisfied: a wrong row would leave a residual.
    """
    for name in ("the zero dynamics", "periodicity", "the impact", "the slope after impact"):
        ((value, low, high),) = rows(name)
        assert (low, high) == (0.0, 0.0)
        assert np.max(np.abs(value)) < 1e-9, name


def test_limits_are_of_pinocchio_s_numbers_with_their_reserve(robot, gait, rows, orbit):
    """Each inequality has Pinocchio's number as its value, and as its bound the limit less a reserve of 10 %.
    Limits: friction 0.5 (0.45 is left) and 0.4 of the impulse (0.36), 100 N m, delta^2 at most 0.7, and ranges
    of the knees, of which 0.1 x 0.25 rad are kept back at either end. 0.5 is the unknown peak torque as a share
    of its limit: torques lie between -0.5 and 0.5 of it.
    """
    F_T, F_N = orbit.ground_reaction.T / robot.weight
    leg = float(np.linalg.norm(robot.hip(np.zeros(robot.n))))
    # impulses are divided by m sqrt(g leg)
    scale = robot.mass * np.sqrt(robot.description.gravity * leg)
    P_T, P_N = robot.impact(gait.q_minus, gait.v_minus).impulse / scale
    share, index = orbit.u.ravel() / 100.0, robot.description.joint_index
    q = np.vstack((orbit.q, gait.start(robot)[0], gait.q_minus))  # the ends come last
    delta2, inf = ZeroDynamics.of(robot, gait.constraint).delta ** 2, np.inf
    expected = {
        "friction": [(0.45 * F_N - F_T, 0.0, inf), (0.45 * F_N + F_T, 0.0, inf)],
        "the impulse cone": [(0.36 * P_N - P_T, 0.0, inf), (0.36 * P_N + P_T, 0.0, inf)],
        "the torque limit": [(share - 0.5, -inf, 0.0), (share + 0.5, 0.0, inf)],
        "stability, delta^2 below 1": [(delta2, -inf, 0.7)],
    }
    for joint, (low, high) in KNEES.items():
        expected[f"the range of {joint}"] = [(q[:, index(joint)], low + 0.025, high - 0.025)]
    for name, goals in expected.items():
        for (value, *ends), (goal, *least_most) in zip(rows(name), goals, strict=True):
            # the rows at both ends of the step come last; where `goal` has none they are not compared
            np.testing.assert_allclose(
                value[: np.size(goal)], np.ravel(goal), 1e-9, 1e-9, err_msg=name
            )
            assert ends == pytest.approx(least_most), name


@pytest.mark.parametrize(("objective", "low"), [("torque", 0.9), ("peak", 0.0)])
def test_the_peak_keeps_the_reserve(robot, limits, unknowns, objective, low):
    """The last unknown is the peak torque over its limit: at most 0.9 by the reserve of 0.1, and fixed there
    unless it is to be minimised (objective "peak").
    """
    numbers, direction = unknowns
    asked = replace(ASKED, objective=type(ASKED.objective)(objective))
    _, symbols = transcribe(robot, asked, limits, direction)
    least, most = _bounds(symbols, numbers, asked, limits)
    assert (least[-1], most[-1]) == (low, 0.9)


def test_a_clearance_of_zero_keeps_the_foot_up_in_the_whole_step(robot, unknowns):
    """Rows that keep the foot up are counted. Any clearance, also 0, has them in the whole step; None has them
    in the second half alone (LATE), since legs without knees scuff at first.
    """
    counts = []
    for clearance in (None, 0.0, 0.02):
        kept = StepLimits(clearance=clearance).of(robot)
        rows = transcribe(robot, ASKED, kept, unknowns[1])[0].rows
        counts += [row.value.numel() for row in rows if row.name in (LATE, "foot clearance")]
    assert counts[1] == counts[2] > counts[0]


# -- the audit -------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("limits", "word"),
    [
        ({}, ""),
        ({"torque": 39.0}, "the torque limit by"),
        # without a number of its own impulse_friction would be 0.2 too
        ({"friction": 0.2, "impulse_friction": 0.6}, "friction by"),
        ({"impulse_friction": 0.2}, "the impulse cone by"),
        ({"multiplier": 0.5}, "stability, delta^2 below 1 by"),
        ({"clearance": 0.2}, "foot clearance by"),
        ({"lift_off": 9.0}, "the swing foot coming down by"),
        ({"slowest": 1.0}, "the slowest rate by"),
        ({"normal_force": 0.9}, "the normal force by"),
        ({"ranges": {"left_knee": (-0.3, 0.0)}}, "the range of left_knee by"),
        ({"ranges": {"right_knee": (-2.0, -1.2)}}, "the range of right_knee by"),
    ],
)
def test_the_audit_names_the_limit_that_a_gait_misses(robot, gait, orbit, limits, word):
    """The gait v0.8 keeps the usual limits ({}), and misses each of the others, which are too strict for it;
    word: how the text on that limit begins.
    """
    asked = replace(ASKED, limits=StepLimits(**limits))
    missed = audit(robot, gait, orbit, asked)
    assert any(text.startswith(word) for text in missed) if word else missed == []


def test_a_clearance_that_is_not_asked_for_is_not_what_has_to_give(robot, limits, unknowns):
    """`missed` has an entry for each limit of the programme: with a clearance for "foot clearance", without one
    for the foot above the ground in the second half of the step, and never for both.
    """
    numbers, direction = unknowns
    for clearance in (0.02, None):
        programme, _ = transcribe(robot, ASKED, replace(limits, clearance=clearance), direction)
        names = [
            text.split(" by ")[0] for text in programme.in_words(programme.missed(stacked(numbers)))
        ]
        assert ("foot clearance" in names) == (clearance is not None)
        assert ("the swing foot above the ground after 50% of the step" in names) == (
            clearance is None
        )


@pytest.mark.parametrize(("share", "count"), [(0.0, 0), (0.4e-4, 0), (1.1e-4, 1), (-1.1e-4, 1)])
def test_the_audit_asks_for_speed_and_step(robot, gait, orbit, share, count):
    """A gait may miss speed (relative) and step length (over the leg of 0.8 m) by 0.5e-4: shares of 0 and
    0.4e-4 are accepted, 1.1e-4 to either side gives one remark.
    """
    step = float(robot.swing_foot(gait.q_minus)[0])
    speed = step / orbit.period
    for asked in ((speed * (1.0 + share), None), (None, step + 0.8 * share)):
        assert len(audit(robot, gait, orbit, GaitRequest(*asked, nodes=NODES))) == count
