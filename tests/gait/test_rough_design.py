"""Gaits designed for rough ground: the programme's map against `rough_ground`, and the gaits against walks."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.stride_map import StrideMap
from biped_adrc.control.reference_reset import ReferenceReset
from biped_adrc.core.errors import GaitError
from biped_adrc.gait.constraint import continued
from biped_adrc.gait.design.request import GaitRequest, StepLimits
from biped_adrc.gait.design.rough import MIDDLE, RoughSteps
from biped_adrc.gait.design.step import SymbolicStep, at_gait, stacked
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.ground import stepped

H = 0.05  # [m]


@pytest.fixture(scope="module")
def design(biped) -> ba.DesignedGait:
    return ba.design_gait(biped, 0.8, 0.5, limits=StepLimits(rough=H))


def test_the_programme_has_the_map_of_rough_ground(biped) -> None:
    """y*, delta^2 and the foot over 10 mm either way, by CasADi against NumPy on phases. 1e-4 of y*(0): Gauss
    nodes across the end of the curve, where its curvature fades."""
    gait, heights = ba.load_gait("v0.6", biped), np.array([-0.01, 0.0, 0.01])
    c, request = gait.constraint, GaitRequest(0.6, nodes=48, limits=StepLimits(rough=0.01))
    orbit, rate = ZeroDynamics.of(biped, c, 48).cycle, float(c.phase @ gait.v_minus)
    rates = np.abs(orbit.v @ c.phase)
    x = at_gait(biped, c, gait.q_minus, gait.v_minus / rate, abs(rate), rates, 0.5)
    expected = StrideMap.of(biped, continued(c), MIDDLE, heights=heights)
    x = x._replace(rough=np.array([0.01, *expected.landing[[2, 0]]]))
    step = SymbolicStep(biped, request, request.limits.of(biped), -1.0)
    rough = RoughSteps(step)
    (up, down), symbols = (at for _, at in rough.over.values()), [ca.vec(part) for part in step.x]
    numbers = [rough.level, up.steady, down.steady, up.delta2, down.delta2, up.foot, down.foot]
    f = ca.Function("map", [ca.vertcat(*symbols)], [ca.vertcat(*numbers)])
    y, d2 = expected.steady, expected.delta2
    result = np.array(f(stacked(x))).ravel()
    np.testing.assert_allclose(result[:3] / y[1], y[[1, 2, 0]] / y[1], rtol=1e-5, atol=1e-4)
    np.testing.assert_allclose(result[3:], [d2[2], d2[0], 0.01, -0.01], rtol=1e-5)


def test_the_middle_is_the_share_of_the_usual_reset() -> None:
    assert ReferenceReset.share == MIDDLE


def test_a_rough_gait_walks_the_worst_stairs_and_random_ground(biped, design) -> None:
    """`rough_ground` says at least H, and walks over stairs and random heights of 0.97 H are feasible, in which
    nothing of the map is used. The gait without rough ground falls on some of them."""
    assert design.rough.reach().height >= H
    level = ba.design_gait(biped, 0.8, 0.5).gait
    random = np.random.default_rng(1).uniform(-1.0, 1.0, (2, 20))
    stairs = np.ones(20), -np.ones(20), (-1.0) ** np.arange(20)

    def feasible(gait, shares) -> bool:
        law = ReferenceReset(ba.NPDController(continued(gait.constraint)))
        walker = ba.Walker(biped, law, ground_steps=stepped(-0.97 * H * np.asarray(shares)))
        return ba.walk(walker, gait, impacts=20).feasibility.outcome == "feasible"

    assert all(feasible(design.gait, shares) for shares in (*stairs, *random))
    assert not all(feasible(level, shares) for shares in stairs)


def test_a_rough_gait_says_what_it_costs(biped, design) -> None:
    """The gait without rough ground has the same speed, as asked, and less torque."""
    value, speed = design.level
    assert value < design.objective
    assert speed == pytest.approx(0.8, rel=1e-4)
    assert f"without rough ground  {value:.6g} N^2 m s" in design.text()
    assert design.gait.name == "v0.8-s0.5-rough0.05"


def test_a_height_that_no_gait_bears_is_refused_with_the_largest_and_its_limit(biped) -> None:
    """The height found is one that a design then reaches."""
    with pytest.raises(GaitError, match="where the limit 'friction' stops it") as e:
        ba.design_gait(biped, 1.1, 0.4, limits=StepLimits(rough=0.06))
    found = 1e-3 * float(str(e.value).split("found is ")[1].split(" mm")[0])
    assert 0.0 < found < 0.06
    less = ba.design_gait(biped, 1.1, 0.4, limits=StepLimits(rough=0.9 * found))
    assert less.rough.reach().height >= 0.9 * found


def test_rough_ground_has_no_slope_and_asks_for_a_clearance(biped) -> None:
    with pytest.raises(GaitError, match="expected rough ground without a slope"):
        ba.design_gait(biped, 0.6, slope=0.03, limits=StepLimits(rough=0.01))
    with pytest.raises(GaitError, match="expected a clearance on rough ground"):
        ba.design_gait(biped, 0.6, limits=StepLimits(rough=0.01, clearance=None))
