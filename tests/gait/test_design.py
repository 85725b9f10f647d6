"""Designed gaits, held against laws that their design does not use.

Fixtures: level, RABBIT's gait of 0.8 m/s and steps of 0.4 m on level ground; downhill, its gait of 0.7 m/s down
a slope of 0.06 rad.
"""

from __future__ import annotations

import re
import shutil
import signal
from dataclasses import replace
from threading import Timer, get_ident
from types import SimpleNamespace

import casadi as ca
import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.gait_design import DesignedGait, certify, design_gait
from biped_adrc.core.errors import GaitError, InputError
from biped_adrc.core.files import data_folder
from biped_adrc.gait.design import optimise as optimisation
from biped_adrc.gait.design.optimise import Optimum, audit, optimise
from biped_adrc.gait.design.request import GaitRequest, StepLimits
from biped_adrc.gait.gait import Gait, load_gait, onto_section
from biped_adrc.gait.published import X_STAR
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.build import build
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.walk import walk_scenario


def speed_of(gait: Gait, biped: Biped) -> float:
    """Along the ground [m/s]."""
    return float(np.hypot(*biped.swing_foot(gait.q_minus)) / gait.period)


FEW = 12
"""Nodes at which limits are kept, half as many as usual; that they are kept between them is certified."""
SPEEDS = tuple(round(0.4 + 0.1 * k, 1) for k in range(8))


@pytest.fixture(scope="module")
def level() -> DesignedGait:
    return design_gait("rabbit", 0.8, 0.4, preset="tac2003", nodes=FEW)


@pytest.fixture(scope="module")
def downhill() -> DesignedGait:
    return design_gait("rabbit", 0.7, preset="identified-bare", slope=0.06, nodes=FEW)


def test_a_design_says_its_numbers_and_one_that_falls_is_refused(level: DesignedGait) -> None:
    """The text has the step length that was asked for, 0.4 m. A gait is proved by a simulated walk: with a
    fifth of its rates before impact the robot falls, and `certify` refuses it.
    """
    assert "step length          0.400000 m" in level.text()
    still = replace(level.gait, v_minus=0.2 * level.gait.v_minus)
    biped = Biped.load("rabbit", preset="tac2003")
    with pytest.raises(GaitError, match="does not walk"):
        # zeros: objective, iterations and seconds, which are not looked at
        certify(biped, level.request, Optimum(still, 0.0, 0, 0.0))


# -- gaits on level ground and downhill ----------------------------------------------------------------
@pytest.mark.parametrize(
    ("name", "preset", "speed", "slope"),
    [("level", "tac2003", 0.8, 0.0), ("downhill", "identified-bare", 0.7, 0.06)],
)
def test_speed_slope_energy_and_limits(name, preset, speed, slope, request) -> None:
    """Each design keeps laws that the optimiser does not use: the work of motors and gravity over a step (z < 0
    downhill) is the kinetic energy that the impact takes. It has the slope and the speed asked for, the
    simulated walk ends on the orbit (`gap`), and the orbit is stable (`multiplier`, at most 0.95 by the usual
    limits).
    """
    found, biped = request.getfixturevalue(name), Biped.load("rabbit", preset)
    gait = found.gait
    x, z = biped.swing_foot(gait.q_minus)
    assert z / x == pytest.approx(-np.tan(slope), abs=1e-9)
    assert speed_of(gait, biped) == pytest.approx(speed, abs=1e-6)
    impact = biped.impact(gait.q_minus, gait.v_minus)
    lost = biped.kinetic_energy(gait.q_minus, gait.v_minus)
    lost -= biped.kinetic_energy(impact.q, impact.v)
    o = ZeroDynamics.of(biped, gait.constraint, 80).cycle  # 80 nodes of quadrature
    work = float(np.sum(o.u * o.v[:, : biped.p], axis=1) @ o.time_weights)
    assert work - biped.weight * z == pytest.approx(lost, rel=1e-8)
    assert found.gap < 1e-7
    assert 0.0 < found.multiplier < 0.95
    assert found.certificate.violations() == ()


def test_a_step_length_is_met_and_the_impulse_limited(level: DesignedGait) -> None:
    """A step of 0.4 m was asked for; |F_T| / F_N of the impulse stays below the robot's friction of 0.6."""
    foot = Biped.load("rabbit", "tac2003").swing_foot(level.gait.q_minus)
    assert foot == pytest.approx([0.4, 0.0], abs=1e-9)
    assert level.certificate.impulse_ratio <= 0.6


def test_a_gait_on_a_slope_is_read_back(downhill: DesignedGait, tmp_path) -> None:
    """The gait's slope of 0.06 rad is in its file too, and q- comes back to the last bit."""
    downhill.gait.save(tmp_path / "downhill.json")
    again = load_gait(tmp_path / "downhill.json", Biped.load("rabbit", "identified-bare"))
    assert again.slope == 0.06
    np.testing.assert_array_equal(again.q_minus, downhill.gait.q_minus)


def test_the_slope_of_a_scenario_is_that_of_the_ground(downhill: DesignedGait, tmp_path) -> None:
    """A scenario without a slope takes the gait's, 0.06 rad. Another one, 0.05 rad, is walked on with a remark,
    while touchdowns are still detected by the gait's slope. A robot without a gait walks on the slope of the
    scenario.
    """
    downhill.gait.save(path := tmp_path / "downhill.json")
    robot = {"robot": {"name": "rabbit", "preset": "identified-bare"}, "gait": str(path)}
    s = Scenario("NPD", run={"impacts": 1, "h": 2e-3}, **robot)
    assert walk_scenario(s).walker.slope == 0.06
    assert walk_scenario(s).remarks == ()
    s = s.replace(
        {"ground.slope": 0.05, "hardware.period": 1e-3, "hardware.touchdown": "kinematics"}
    )
    walk = walk_scenario(s)
    assert (walk.walker.slope, walk.walker.touchdown.slope) == (0.05, 0.06)
    assert "a slope of 0.06 rad, and the ground has 0.05 rad" in walk.remarks[0]
    wheel = Scenario("passive", robot="rimless_wheel", ground={"slope": 0.15})
    assert build(wheel).slope == 0.15


def test_other_objectives_do_better_at_what_they_are_for(level: DesignedGait) -> None:
    """Peak torque and cost of transport are more than 10 % less than those of `level`, which has the least
    squared torque. The objective is computed on the exact orbit and the certificate from a simulated step,
    hence 5 % and 3 %.
    """
    peak = design_gait("rabbit", 0.8, 0.4, preset="tac2003", objective="peak", nodes=FEW)
    assert peak.certificate.peak_torque < 0.9 * level.certificate.peak_torque
    assert peak.objective == pytest.approx(peak.certificate.peak_torque, rel=0.05)
    frugal = design_gait("rabbit", 0.8, 0.4, preset="tac2003", objective="transport", nodes=FEW)
    assert frugal.objective == pytest.approx(frugal.certificate.cost_of_transport, rel=0.03)
    assert frugal.certificate.cost_of_transport < 0.9 * level.certificate.cost_of_transport


def test_the_gait_through_x_star_is_that_of_the_other_optimiser() -> None:
    """The stored gait through x* was found by Gauss-Newton on weighted residuals, without a limit on the
    impulse. The design finds the same state and the same integral of u^2 per metre, to 1e-3: the minimum is
    flat there, so that the curves themselves may differ.
    """
    biped = Biped.load("rabbit", "identified")
    q, v = onto_section(biped, X_STAR[:5]), np.array(X_STAR[5:])
    stored = load_gait("published", biped)
    any_impulse = StepLimits(impulse_friction=float("inf"))
    found = design_gait(biped, through=(q, v), limits=any_impulse)
    np.testing.assert_allclose(found.gait.q_minus, stored.q_minus, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(found.gait.v_minus, stored.v_minus, rtol=0.0, atol=1e-6)
    zero = ZeroDynamics.of(biped, stored.constraint)
    o = zero.orbit(zero.sigma_minus * zero.delta)
    length = float(biped.swing_foot(stored.q_minus)[0])
    squares = float(np.sum(o.u**2, axis=1) @ o.time_weights) / length
    assert found.objective == pytest.approx(squares, rel=1e-3)


def test_legs_without_knees_walk_when_scuffing_is_allowed() -> None:
    """A leg without a knee cannot be lifted in mid-step. Without a clearance (None) there is a gait
    nevertheless: the simulated walk returns to it (`gap`), at the speed asked for.
    """
    found = design_gait("three_link", 0.9, 0.6, limits=StepLimits(clearance=None))
    assert found.gap < 1e-6
    assert found.speed == pytest.approx(0.9, abs=1e-5)


@pytest.mark.parametrize(
    ("clearance", "text"),
    [
        (-3.5e-5, "-0.035 mm at the least, between"),
        (-4e-8, "0 mm at the"),
        (0.0123, "12.3 mm at the"),
    ],
)
def test_a_clearance_that_is_printed_as_zero_has_no_sign(level, clearance, text) -> None:
    """A foot that is 35 um below the ground in mid-step is printed so; 0.04 um [m] is no height at all."""
    made_up = replace(level, certificate=replace(level.certificate, clearance=clearance))
    assert re.search(rf"foot clearance +{text}", made_up.text())


def test_a_gait_turns_no_faster_than_the_urdf_states_of_either_leg(tmp_path) -> None:
    """The hips turn at up to 3.51 and 3.10 rad/s without a limit. One of them states 2.5; it binds both, as the
    legs change roles at each impact.
    """
    folder = tmp_path / "own"
    shutil.copytree(data_folder("urdf") / "three_link", folder)
    text = (folder / "floating.urdf").read_text()
    # 1000 rad/s in the package's file states no limit
    at = text.index("velocity=", text.index('name="right_hip"'))
    (folder / "floating.urdf").write_text(text[:at] + text[at:].replace("1000", "2.5", 1))
    slow = Biped.load(folder / "robot.toml")
    found = design_gait(slow, 0.9, 0.6, limits=StepLimits(clearance=None))
    walk = ba.walk(ba.Walker(slow, ba.NPDController(found.gait.constraint)), found.gait, 2)
    # the hips come near the limit, so it binds, and do not pass it
    assert 2.3 < np.max(np.abs(walk.signals.v[:, :2])) < 2.5
    assert not {"rate", "range"} & set(walk.feasibility.reasons)
    assert [joint.speed for joint in slow.motor_joints[1]] == [np.inf, 2.5]


# -- the stored library ----------------------------------------------------------------------------
@pytest.mark.parametrize("preset", ["identified", "identified-bare", "tac2003"])
def test_stored_gaits_have_their_speed_and_keep_the_limits(preset: str) -> None:
    """Each stored gait has the speed of its name, violates no limit of its design (`audit`) at 120 nodes, more
    than it was designed with, and v- is that of the periodic orbit of the zero dynamics.
    """
    biped = Biped.load("rabbit", preset)
    for speed in SPEEDS:
        gait = load_gait(f"v{speed:g}", biped)
        assert speed_of(gait, biped) == pytest.approx(speed, abs=1e-5)
        zero = ZeroDynamics.of(biped, gait.constraint, 120)
        assert audit(biped, gait, zero.cycle, GaitRequest(speed)) == []
        assert zero.end_state(zero.sigma_minus)[1] == pytest.approx(gait.v_minus, abs=1e-9)


# -- bad input -------------------------------------------------------------------------------------
def test_a_design_without_solution_names_the_limit_that_has_to_give() -> None:
    """8 N m per motor are too few for 0.9 m/s with steps of 0.6 m, and the message names this limit."""
    weak = StepLimits(torque=8.0, clearance=None)
    with pytest.raises(GaitError, match=r"would have to give: .*torque limit"):
        design_gait("three_link", 0.9, 0.6, limits=weak, degree=4, nodes=8)


def test_without_a_clearance_none_is_said_to_be_in_the_way() -> None:
    """2.5 m/s with steps of 0.3 m has no gait. Where no clearance was asked for, the foot has to be above the
    ground in the second half of the step alone; the message names that, and no clearance.
    """
    with pytest.raises(
        GaitError, match="swing foot above the ground after 50% of the step"
    ) as caught:
        design_gait("rabbit", 2.5, 0.3, limits=StepLimits(clearance=None), degree=4, nodes=8)
    assert "clearance" not in str(caught.value)


@pytest.mark.parametrize(
    ("asked", "word"),
    [
        ({}, "speed"),
        ({"robot": "compass", "speed": 0.5}, "0 motors"),
        ({"speed": float("nan")}, "speed"),
        ({"speed": 1.0, "degree": 3}, "degree"),
        ({"speed": 1.0, "slope": 2.0}, "slope"),
        ({"speed": 0.5, "step": 1.9}, "steps of more than"),
        ({"speed": 1e9}, "faster"),
        ({"speed": 0.5, "objective": "speed"}, "objective"),
        ({"speed": 0.5, "limits": StepLimits(ranges={"ankle": (0.0, 1.0)})}, "ankle"),
        # no step: both feet are in one place, and the robot is at rest
        ({"through": (np.zeros(5), np.zeros(5))}, "ground|sign"),
        ({"through": (np.zeros(5), np.zeros(4))}, "pass through has 9 numbers, expected 10"),
    ],
)
def test_requests_without_a_gait(asked: dict, word: str) -> None:
    """asked: arguments for which there can be no gait, such as a robot without motors (compass); word: what the
    message has to name.
    """
    with pytest.raises(InputError, match=word):
        design_gait(**asked)


def test_ctrl_c_ends_ipopt(monkeypatch) -> None:
    """SIGINT, sent 0.02 s after the solver was made, arrives while IPOPT iterates: KeyboardInterrupt is raised
    and no gait returned. CasADi's nlpsol is replaced only to start that timer.
    """
    request, me = GaitRequest(0.9, 0.6, limits=StepLimits(clearance=None)), get_ident()

    def interrupted(*arguments, nlpsol=ca.nlpsol):
        solver = nlpsol(*arguments)
        Timer(0.02, signal.pthread_kill, (me, signal.SIGINT)).start()
        return solver

    monkeypatch.setattr(ca, "nlpsol", interrupted)
    with pytest.raises(KeyboardInterrupt):
        optimise(Biped.load("three_link"), request)


def test_a_design_that_ends_without_a_gait_says_how(monkeypatch) -> None:
    """Two failures that real requests hardly give are made by replaced functions: IPOPT stops though the
    relaxed problem violates no limit; and a solution at 8 nodes, and at twice as many, has no exact gait.
    """
    biped, request = Biped.load("three_link"), GaitRequest(0.9, 0.6, nodes=8)
    failed = SimpleNamespace(solved=False, status="S", iterations=1)
    monkeypatch.setattr(optimisation.nlp, "solve_nlp", lambda *_: failed)
    monkeypatch.setattr(
        optimisation.nlp, "relaxed", lambda programme, words, x0, bounds, status: x0
    )
    with pytest.raises(GaitError, match="IPOPT stopped with S, though its limits can be met"):
        optimise(biped, request)

    nodes = []

    def no_orbit(biped, finer, x):
        nodes.append(finer.nodes)
        raise GaitError("odd")

    monkeypatch.setattr(optimisation, "_solution", lambda *_: (None, 1))
    monkeypatch.setattr(optimisation, "exact_gait", no_orbit)
    with pytest.raises(
        GaitError, match="its limits at 16 nodes and not between them: odd; give more"
    ):
        optimise(biped, request)
    assert nodes == [8, 16]  # a gait's provenance has those of its own solution
