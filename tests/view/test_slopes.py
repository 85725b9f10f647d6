"""Walks on slopes and over steps down: links against Pinocchio, feet and ground against closed forms.

The fixture walks has four, by NAMES: a passive compass and a rimless wheel on their slopes, RABBIT on 0.02 rad,
and RABBIT down two steps (DROPS). WalkScene.of(walk) is what is drawn of a walk: footholds, heights, joint
values over time.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from matplotlib.figure import Figure

import biped_adrc as ba
from biped_adrc.analysis.signals import FORCE, PLACE
from biped_adrc.control.reference_reset import ReferenceReset
from biped_adrc.core.errors import InputError, SimulationError
from biped_adrc.gait.constraint import continued
from biped_adrc.model.ground import StepDown
from biped_adrc.scenario.recording import Walk
from biped_adrc.view.from_the_side import moving_parts
from biped_adrc.view.from_the_side.moving_parts import DrawnWalk
from biped_adrc.view.from_the_side.side_view import SideView
from biped_adrc.view.placement import WalkScene, contact_changes, link_placements, loads_at

from .pinocchio_view import floating

pytestmark = [
    pytest.mark.filterwarnings("ignore:gait 'published' was made for a slope"),
    pytest.mark.filterwarnings("ignore:the start has the swing foot 6.25 mm below"),
]
METHOD = ba.RK4(2e-3)
ALPHA = math.pi / 8
NAMES = ("compass", "wheel", "slope", "down")
DROPS = {2: 0.015, 3: 0.01}
"""Heights [m] of the steps down, by the number of the single support that ends on the lower ground."""


def passive_walk(robot: str, impacts: int, slope: float | None = None) -> Walk:
    """A walk of a robot without motors on the slope [rad]; None: that of its stored cycle."""
    run = {"impacts": impacts}
    return ba.walk_scenario(ba.Scenario("passive", robot=robot, ground={"slope": slope}, run=run))


@pytest.fixture(scope="module")
def walks() -> dict[str, Walk]:
    """Passive ones, RABBIT on 0.02 rad, and RABBIT down two steps."""
    biped = ba.Biped.load("rabbit", "identified-bare")
    gait = ba.load_gait("published", biped)
    law = ba.NPDController(continued(gait.constraint))
    steps = tuple(StepDown(step, height) for step, height in DROPS.items())
    down = ba.Walker(biped, ReferenceReset(law), ground_steps=steps)
    return {
        "compass": passive_walk("compass", 4),
        "wheel": passive_walk("rimless_wheel", 5),
        "slope": ba.walk(ba.Walker(biped, law, slope=0.02), gait, 4, METHOD),
        "down": ba.walk(down, gait, 5, METHOD),
    }


def feet(walk: Walk, i: int) -> tuple[str, str]:
    """Links of the stance and the swing foot in arc i: a wheel is drawn on the same spoke in every step."""
    d = walk.walker.plant.description
    one, other = d.stance_foot, d.swing_foot
    return (one, other) if i % 2 == 0 or d.name == "rimless_wheel" else (other, one)


def ground(walk: Walk, i: int, x: float) -> float:
    """z of the ground that single support i + 1 starts on, at x [m]."""
    fallen = sum(height for step, height in DROPS.items() if step <= i)
    return -math.tan(walk.walker.slope) * x - (fallen if walk.walker.ground_steps else 0.0)


def test_the_angles_of_a_passive_walk_are_drawn(walks: dict[str, Walk]) -> None:
    """A robot without motors has a plot too: the lines of its first panel are its angles."""
    walk = walks["compass"]
    lines = walk.plot().axes[0].lines
    for line, q in zip(lines, walk.signals.q.T, strict=False):
        y = line.get_ydata()
        np.testing.assert_array_equal(y[np.isfinite(y)], q)


def test_on_soft_ground_the_foot_is_drawn_where_it_slips() -> None:
    """With friction 0.55 the feet slip in both steps: place of the stance foot, hip and forces of the ground on
    both feet are those recorded in the middle of each step, and the drawing marks contact that changes.
    """
    ground = {"plant": "mujoco", "friction": 0.55}
    walk = ba.walk_scenario(ba.Scenario("NPD", hardware="ideal", ground=ground, run={"impacts": 2}))
    scene, at = WalkScene.of(walk), 0
    for i, (arc, step) in enumerate(zip(walk.trajectory.arcs, walk.soft_steps, strict=True)):
        t = float(arc.t[len(arc.t) // 2])
        k = int(np.flatnonzero(arc.t == t)[-1])  # after the sample instant
        place = arc.read[PLACE][k, :2]
        assert scene.foot(i, t) == tuple(place)
        hip = walk.walker.plant.hip(arc.x[k][:5]) + place
        np.testing.assert_allclose(scene.points(i, t, arc.x[k][:5])[:2], hip)
        loads = loads_at(scene, t)
        np.testing.assert_array_equal(loads.other, arc.read[FORCE][k, 2:])
        np.testing.assert_array_equal(loads.ground_reaction, walk.signals.ground_reaction[at + k])
        assert bool(len(contact_changes(scene, arc))) is (max(step.slip) > 0.0)
        at += len(arc.t)
    assert [max(step.slip) > 0.0 for step in walk.soft_steps] == [True, True]


def test_an_arrow_is_as_long_as_its_force_until_it_is_cut(walks: dict[str, Walk]) -> None:
    """The arrow has 0.4 m for the robot's weight, and at most 1.2 m; a cut arrow has words with the true force,
    and a force that is not finite has no arrow.
    """
    view = SideView(WalkScene.of(walks["slope"]))
    drawn = DrawnWalk(Figure().subplots(), view, 1.0, 1)  # opaque, in the first layer
    weight = walks["slope"].walker.plant.weight
    for force, arrow, words in (
        ([0.0, weight], [0.0, 0.4], ""),
        ([3.0 * weight, 0.0], [1.2, 0.0], ""),
        ([0.0, -4.0 * weight], [0.0, -1.2], f"{4.0 * weight:.3g} N, arrow cut"),
        ([np.inf, 0.0], [0.0, 0.0], "no finite force, arrow cut"),
    ):
        # arrow 0, of the stance foot, from the origin
        vector, said = drawn._arrow(0, np.zeros(2), np.array(force))
        np.testing.assert_allclose(vector, arrow, rtol=0.0, atol=1e-12)
        assert said == words
        assert drawn.arrows[0].get_visible() is any(arrow)


def test_stones_are_drawn_where_the_next_foot_has_to_land() -> None:
    """Each stone lies one wanted step length ahead of the foothold, on the ground there, and is as wide as the
    tolerance to either side.
    """
    s = ba.Scenario({"name": "footstep", "inner": "NPD"}, hardware="ideal")
    walk = ba.walk_scenario(s.replace({"ground.stones": [0.4, 0.3], "run.impacts": 2}))
    scene, axes = WalkScene.of(walk), Figure().subplots()
    moving_parts.ground(axes, [SideView(scene)])
    half, stones = walk.walker.stones.tolerance, axes.lines[1:]  # [0]: the ground
    for line, x, L in zip(stones, scene.footholds, (0.4, 0.3), strict=True):
        np.testing.assert_allclose(line.get_xdata(), [x + L - half, x + L + half])
        np.testing.assert_allclose(line.get_ydata(), scene.level(x + L))


@pytest.mark.parametrize("name", NAMES)
def test_links_are_where_pinocchio_puts_them(walks: dict[str, Walk], name: str) -> None:
    """Each link is drawn where Pinocchio puts it, and the stance foot stays where the swing foot came down, on
    the ground, from the first step to the last.

    At the end the robot is more than 1 m on, and more than 20 mm lower.
    """
    walk, foothold = walks[name], np.zeros(2)
    scene, biped = WalkScene.of(walk), walk.walker.plant
    assert len(scene.footholds) == len(walk.trajectory.arcs) >= 4
    for i, arc in enumerate(walk.trajectory.arcs):
        stance, swing = feet(walk, i)
        for t in np.linspace(arc.t[0], np.nextafter(arc.t[-1], 0.0), 7):
            values = scene.joints(float(t))
            theirs = floating(biped, values)
            for link, placement in link_placements(biped.tree, values).items():
                np.testing.assert_allclose(
                    placement, theirs[link], rtol=0.0, atol=1e-12, err_msg=link
                )
            np.testing.assert_allclose(theirs[stance][[0, 2], 3], foothold, rtol=0.0, atol=1e-9)
            assert theirs[stance][2, 3] == pytest.approx(ground(walk, i, foothold[0]), abs=1e-9)
        foothold = theirs[swing][[0, 2], 3]
    assert foothold[0] > 1.0
    assert foothold[1] < -0.02


def test_the_spokes_of_a_wheel_pass_on_to_one_another(walks: dict[str, Walk]) -> None:
    """There are eight lines of 1 m at equal angles, in the same places before and after an impact."""
    view = SideView(WalkScene.of(walks["wheel"]))
    # after the last event nothing is drawn any more
    for event in walks["wheel"].trajectory.events("foot_strike")[:-1]:
        before, after = (view.segments(event.t + d) for d in (-1e-9, 1e-9))
        assert before.shape == (8, 2, 2)
        hub, rim = before[:, 0], before[:, 1]
        np.testing.assert_allclose(np.hypot(*(rim - hub).T), 1.0, rtol=0.0, atol=1e-9)
        apart = np.hypot(*(rim - np.roll(rim, 1, axis=0)).T)
        # ALPHA: half the angle between two spokes
        np.testing.assert_allclose(apart, 2.0 * math.sin(ALPHA), rtol=0.0, atol=1e-9)
        nearest = np.linalg.norm(rim[:, np.newaxis] - after[:, 1], axis=2).min(axis=1)
        assert np.max(nearest) < 1e-6


@pytest.mark.parametrize("name", NAMES)
def test_the_ground_passes_through_all_footholds(walks: dict[str, Walk], name: str) -> None:
    """The drawn surface has the height of each foothold; between the steps down it has the walk's slope, at
    them it falls by DROPS, and its tiles join without a gap.
    """
    scene, slope = WalkScene.of(walks[name]), walks[name].walker.slope
    for i, x in enumerate(scene.footholds):
        z = scene.heights[i]
        assert scene.surface.height(float(x)) == pytest.approx(z, abs=1e-9)
        assert scene.level(float(x)) == pytest.approx(z, abs=1e-12)
    corners = scene.surface.line(-1.0, 5.0)
    rises = np.diff(corners, axis=0)  # in turn along the ground and down a step
    np.testing.assert_allclose(
        rises[::2, 1], -math.tan(slope) * rises[::2, 0], rtol=0.0, atol=1e-12
    )
    np.testing.assert_allclose(rises[1::2, 0], 0.0)
    expected = list(DROPS.values()) if name == "down" else []
    np.testing.assert_allclose(-rises[1::2, 1], expected, rtol=0.0, atol=1e-12)
    ends = np.array([ends for ends, _ in scene.surface.tiles(-2, 10)])  # of 0.5 m each
    np.testing.assert_array_equal(ends[1:, 0, 0], ends[:-1, 1, 0])
    assert (ends[0, 0, 0], ends[-1, 1, 0]) == (-1.0, 5.0)


# -- passive walks ---------------------------------------------------------------------------------
@pytest.mark.parametrize("name", ["compass", "wheel"])
def test_energy_of_a_passive_walk(walks: dict[str, Walk], name: str) -> None:
    """The energy is constant in single support. An impact leaves the potential energy and takes some kinetic
    energy.

    Each takes as much as its certificate says, and no less than 0.5 J.
    """
    walk = walks[name]
    s = walk.signals
    total = s.kinetic + s.potential
    starts = np.flatnonzero(np.diff(s.step)) + 1
    for rows in np.split(np.arange(len(s.t)), starts):
        np.testing.assert_allclose(total[rows], total[rows[0]], rtol=0.0, atol=1e-6)
    np.testing.assert_allclose(s.potential[starts], s.potential[starts - 1], rtol=0.0, atol=1e-9)
    # the walk ends just before its last impact
    lost = [c.energy_lost for c in walk.certificates[:-1]]
    np.testing.assert_allclose(total[starts - 1] - total[starts], lost, rtol=0.0, atol=1e-9)
    assert min(lost) > 0.5


def test_a_passive_walk_needs_a_robot_without_motors_and_a_slope_downwards() -> None:
    """RABBIT has motors; and where the ground rises by 0.1 rad (slope -0.1) the compass does not come to a next
    step.
    """
    with pytest.raises(InputError, match="'passive' does not fit robot 'rabbit' with 4 motors"):
        ba.walk_scenario(ba.Scenario("passive"))
    with pytest.raises(SimulationError, match="no return"):
        passive_walk("compass", 10, slope=-0.1)
