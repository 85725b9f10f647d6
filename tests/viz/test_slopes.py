"""Walks on slopes and over steps down: links against Pinocchio, feet and ground against closed forms."""

from __future__ import annotations

import base64
import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
import umsgpack
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.cli import app
from biped_adrc.control.reference_reset import ReferenceReset
from biped_adrc.errors import InputError, SimulationError
from biped_adrc.gait.constraint import continued
from biped_adrc.ground import StepDown
from biped_adrc.paper.figures import draw
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.run import passive_walk
from biped_adrc.scenario.stored import load_walk
from biped_adrc.viz.from_the_side.moving_parts import Motion
from biped_adrc.viz.from_the_side.moving_picture import write_moving_picture
from biped_adrc.viz.from_the_side.side_view import SideView
from biped_adrc.viz.from_the_side.stick_figures import strip
from biped_adrc.viz.meshcat.frames import pose
from biped_adrc.viz.meshcat.objects import joint_path
from biped_adrc.viz.meshcat.view import Look, animation_html
from biped_adrc.viz.placement import WalkScene, link_placements
from biped_adrc.viz.plots import friction_cone
from biped_adrc.viz.style import new_figure

from .browser import chromium, console, seek, world
from .pinocchio_view import floating

METHOD = ba.RK4(2e-3)
ALPHA = math.pi / 8
NAMES = ("compass", "wheel", "slope", "down")
DROPS = {2: 0.015, 3: 0.01}
"""[m] by single support, of the walk over steps down."""


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


@pytest.mark.parametrize("name", NAMES)
def test_links_are_where_pinocchio_puts_them(walks: dict[str, Walk], name: str) -> None:
    """And the stance foot stays where the swing foot came down, on the ground, from first to last."""
    walk, foothold = walks[name], np.zeros(2)
    scene, biped = WalkScene.of(walk), walk.walker.plant
    assert len(scene.footholds) == len(walk.trajectory.arcs) >= 4
    for i, arc in enumerate(walk.trajectory.arcs):
        stance, swing = feet(walk, i)
        for t in np.linspace(arc.t[0], np.nextafter(arc.t[-1], 0.0), 7):
            values = scene.joints(float(t))
            theirs = floating(biped, values)
            for link, placement in link_placements(biped.tree, values).items():
                np.testing.assert_allclose(placement, theirs[link], atol=1e-12, err_msg=link)
            np.testing.assert_allclose(theirs[stance][[0, 2], 3], foothold, atol=1e-9)
            assert theirs[stance][2, 3] == pytest.approx(ground(walk, i, foothold[0]), abs=1e-9)
        foothold = theirs[swing][[0, 2], 3]
    assert foothold[0] > 1.0
    assert foothold[1] < -0.02


def test_no_drawn_joint_jumps_at_impact(walks: dict[str, Walk]) -> None:
    for name in ("compass", "slope", "down"):
        scene = WalkScene.of(walks[name])
        for event in walks[name].trajectory.events("foot_strike")[:-1]:
            before, after = scene.joints(event.t - 1e-9), scene.joints(event.t + 1e-9)
            assert max(abs(before[joint] - after[joint]) for joint in before) < 1e-6


def test_the_spokes_of_a_wheel_pass_on_to_one_another(walks: dict[str, Walk]) -> None:
    """Eight lines of 1 m at equal angles, in the same places before and after an impact."""
    view = SideView(WalkScene.of(walks["wheel"]))
    for event in walks["wheel"].trajectory.events("foot_strike")[:-1]:
        before, after = (view.segments(event.t + d) for d in (-1e-9, 1e-9))
        assert before.shape == (8, 2, 2)
        hub, rim = before[:, 0], before[:, 1]
        np.testing.assert_allclose(np.hypot(*(rim - hub).T), 1.0, atol=1e-9)
        apart = np.hypot(*(rim - np.roll(rim, 1, axis=0)).T)
        np.testing.assert_allclose(apart, 2.0 * math.sin(ALPHA), atol=1e-9)
        nearest = np.linalg.norm(rim[:, np.newaxis] - after[:, 1], axis=2).min(axis=1)
        assert np.max(nearest) < 1e-6


def test_the_compass_stands_on_legs_of_one_metre(walks: dict[str, Walk]) -> None:
    view = SideView(WalkScene.of(walks["compass"]))
    for t in np.linspace(0.0, walks["compass"].trajectory.t_end - 1e-9, 9):
        assert sorted(view.roles(float(t))) == ["stance", "swing"]
        segments = view.segments(float(t))
        np.testing.assert_allclose(np.hypot(*(segments[:, 1] - segments[:, 0]).T), 1.0)
        foothold = view.scene.foothold(view.scene.arc_at(float(t)))
        stance = segments[view.roles(float(t)).index("stance")]
        assert np.min(np.hypot(*(stance - foothold).T)) < 1e-9


@pytest.mark.parametrize("name", NAMES)
def test_the_ground_passes_through_all_footholds(walks: dict[str, Walk], name: str) -> None:
    scene, slope = WalkScene.of(walks[name]), walks[name].walker.slope
    for i, x in enumerate(scene.footholds):
        z = scene.heights[i]
        assert scene.surface.height(float(x)) == pytest.approx(z, abs=1e-9)
        assert scene.level(float(x)) == pytest.approx(z, abs=1e-12)
    corners = scene.surface.line(-1.0, 5.0)
    rises = np.diff(corners, axis=0)
    np.testing.assert_allclose(rises[::2, 1], -math.tan(slope) * rises[::2, 0], atol=1e-12)
    np.testing.assert_allclose(rises[1::2, 0], 0.0)
    expected = list(DROPS.values()) if name == "down" else []
    np.testing.assert_allclose(-rises[1::2, 1], expected, atol=1e-12)
    ends = np.array([tile.ends for tile in scene.surface.tiles(-2, 10)])
    np.testing.assert_array_equal(ends[1:, 0, 0], ends[:-1, 1, 0])
    assert (ends[0, 0, 0], ends[-1, 1, 0]) == (-1.0, 5.0)


def test_the_ground_is_drawn_over_a_step_up() -> None:
    """5 mm up in the second single support, 15 mm down in the third."""
    biped = ba.Biped.load("rabbit", "identified-bare")
    gait = ba.load_gait("published", biped)
    law = ReferenceReset(ba.NPDController(continued(gait.constraint)))
    walker = ba.Walker(biped, law, ground_steps=(ba.StepUp(2, 0.005), StepDown(3, 0.015)))
    scene = WalkScene.of(ba.walk(walker, gait, 4, METHOD))
    drawn = [scene.surface.height(float(x)) for x in scene.footholds]
    np.testing.assert_allclose(drawn, scene.heights, atol=1e-9)
    np.testing.assert_allclose(scene.heights[:4], [0.0, 0.0, 0.005, -0.01], atol=1e-9)


def test_a_torque_is_drawn_with_the_power_it_has() -> None:
    """zeta' q' in drawn coordinates, in a step in which the hip counts from the other leg."""
    walk = passive_walk("compass", 2)
    zeta = np.array([3.0, -2.0])
    pushed = ba.Walker(
        walk.walker.plant,
        ba.Passive(),
        ba.TorquePulse(zeta, step=2, start=0.1, stop=0.3),
        slope=walk.walker.slope,
    )
    scene = WalkScene.of(type(walk)(pushed, None, walk.trajectory))
    arc = walk.trajectory.arcs[1]
    t = float(arc.t[0]) + 0.2
    shown, v = pose(scene, 1, t), arc(t)[2:]
    moving = [j.name for j in walk.walker.plant.tree.joints if j.type != "fixed"]
    rates = [shown.rates[moving.index(j)] for j in walk.walker.plant.description.joints]
    assert shown.loads[2:] @ rates == pytest.approx(zeta @ v, rel=1e-6)
    assert abs(zeta @ v) > 0.5


# -- pages and pictures ----------------------------------------------------------------------------
def commands(page: str) -> dict[str, dict[str, dict]]:
    """The last objects and matrices by path."""
    text = re.search(r'<script type="application/json" id="scene">(.*?)</script>', page, re.DOTALL)
    found: dict[str, dict[str, dict]] = {"set_object": {}, "set_transform": {}, "set_property": {}}
    for command in json.loads(text.group(1))["commands"]:
        c = umsgpack.unpackb(base64.b64decode(command))
        found[c["type"]][c["path"]] = c
    return found


@pytest.mark.parametrize("name", NAMES)
def test_footprints_lie_on_the_tiles_of_the_page(walks: dict[str, Walk], name: str) -> None:
    """The corners of every box: the balls of the feet touch the tops."""
    scene = WalkScene.of(walks[name])
    c = commands(animation_html({name: walks[name]}, Look(fps=20.0)))
    depth, normal = 0.02, np.array([math.sin(scene.walker.slope), math.cos(scene.walker.slope)])
    tops = []
    for path, made in c["set_object"].items():
        if "/ground/" in path and "<object>" not in path.split("/ground/")[1]:
            box = made["object"]["geometries"][0]
            M = np.array(c["set_transform"][path]["matrix"]).reshape(4, 4).T
            corners = [(s * box["width"] / 2, 0.0, box["depth"] / 2, 1.0) for s in (-1.0, 1.0)]
            tops.append([(M @ corner)[[0, 2]] for corner in corners])
    for i in range(len(scene.footholds)):
        point = np.array(scene.foothold(i))
        (a, b) = next((a, b) for a, b in tops if a[0] <= point[0] < b[0])
        along = (b - a) / np.hypot(*(b - a))
        assert along @ normal == pytest.approx(0.0, abs=1e-9)
        assert (point - a) @ normal == pytest.approx(depth, abs=1e-9)
        M = np.array(c["set_transform"][f"/meshcat/robots/{name}/footprints/{i}"]["matrix"])
        plate = M.reshape(4, 4).T
        np.testing.assert_allclose(plate[[0, 2], 3], point - depth * normal, atol=1e-9)


def test_walks_on_different_grounds_have_a_ground_each(walks: dict[str, Walk]) -> None:
    def widths(names: tuple[str, ...]) -> set[float]:
        made = commands(animation_html({n: walks[n] for n in names}, Look(fps=5.0)))["set_object"]
        boxes = [o["object"]["geometries"][0] for path, o in made.items() if "/ground/" in path]
        return {round(box["height"], 9) for box in boxes}

    assert widths(("slope",)) == {1.0}
    assert widths(("slope", "down")) == {0.7}


def test_the_page_in_the_browser(walks: dict[str, Walk], tmp_path: Path) -> None:
    """Links against Pinocchio; the camera goes down with the ground below the hip, as steep as it is."""
    walk = walks["compass"]
    scene, biped, fall = WalkScene.of(walk), walk.walker.plant, math.tan(walk.walker.slope)
    walk.animate(tmp_path / "walk.html")
    with chromium() as browser:
        browser.get((tmp_path / "walk.html").as_uri())
        for t in np.linspace(0.0, 0.999 * walk.trajectory.t_end, 6):
            seek(browser, float(t))
            expected = floating(biped, scene.joints(float(t)))
            for joint in biped.tree.joints:
                drawn = world(browser, f"meshcat/robots/Passive/{joint_path(biped.tree, joint)}")
                np.testing.assert_allclose(drawn, expected[joint.child], atol=1e-5)
            x, y = browser.execute_script(
                "const c = viewer.camera.position; return [c.x, c.y - scene.views.side.position[1]]"
            )
            assert x == pytest.approx(expected["hip"][0, 3], abs=1e-5)
            assert y == pytest.approx(-fall * x, abs=1e-6)
        assert console(browser) == []


def test_strip_and_gif(walks: dict[str, Walk], tmp_path: Path) -> None:
    scene = WalkScene.of(walks["down"])
    axes = strip(
        new_figure(6.0, 4.0).subplots(), walks["down"], 0.0, walks["down"].trajectory.t_end
    )
    prints = next(line for line in axes.get_lines() if line.get_marker() == "^")
    np.testing.assert_array_equal(prints.get_ydata(), scene.heights)
    assert axes.get_ylim()[0] < scene.heights.min()
    wheel = strip(new_figure(6.0, 4.0).subplots(), walks["wheel"], 0.0, 0.5)
    assert "wheel" in wheel.get_legend_handles_labels()[1]
    assert wheel.get_xlim()[0] < -1.0
    for name in NAMES:
        motion = Motion(fps=10.0, width=200)
        write_moving_picture(tmp_path / f"{name}.gif", {name: walks[name]}, stop=0.2, motion=motion)
    with pytest.raises(InputError, match="without motors has no reference"):
        write_moving_picture(
            tmp_path / "x.gif", {"wheel": walks["wheel"]}, motion=Motion(apart=True)
        )


# -- passive walks ---------------------------------------------------------------------------------
@pytest.mark.parametrize("name", ["compass", "wheel"])
def test_energy_of_a_passive_walk(walks: dict[str, Walk], name: str) -> None:
    """Constant in single support; impacts leave the potential energy and take the kinetic energy lost."""
    walk = walks[name]
    s = walk.signals
    total = s.kinetic + s.potential
    starts = np.flatnonzero(np.diff(s.step)) + 1
    for rows in np.split(np.arange(len(s.t)), starts):
        np.testing.assert_allclose(total[rows], total[rows[0]], atol=1e-6)
    np.testing.assert_allclose(s.potential[starts], s.potential[starts - 1], atol=1e-9)
    lost = [c.energy_lost for c in walk.certificates[:-1]]
    np.testing.assert_allclose(total[starts - 1] - total[starts], lost, atol=1e-9)
    assert min(lost) > 0.5


def test_a_wheel_needs_the_friction_of_its_spoke_angle(walks: dict[str, Walk]) -> None:
    """With all mass at the hub the ground pushes along the spoke: |F_T| / F_N ends at tan(alpha)."""
    walk = walks["wheel"]
    axes = friction_cone(new_figure(4.0, 4.0).subplots(), walk.signals, slope=walk.walker.slope)
    line = next(a for a in axes.get_lines() if a.get_label() == "ground reaction")
    F_T, F_N = np.array(line.get_data())
    assert np.nanmax(np.abs(F_T) / F_N) == pytest.approx(math.tan(ALPHA), abs=1e-6)
    assert np.nanmin(F_T / F_N) == pytest.approx(-math.tan(ALPHA), abs=1e-6)


def test_a_passive_walk_is_its_cycle_on_other_slopes_too() -> None:
    walk = passive_walk("rimless_wheel", 4, slope=0.1)
    x = walk.trajectory.before("foot_strike")
    np.testing.assert_allclose(x, x[:1].repeat(4, axis=0), atol=1e-8)
    # just before impact the speed is that after it over cos(2 alpha)
    after = math.sqrt(4.0 * 9.81 * math.sin(ALPHA) * math.sin(0.1)) / math.tan(2.0 * ALPHA)
    assert -x[0, 1] == pytest.approx(after / math.cos(2.0 * ALPHA), rel=1e-7)


def test_a_passive_walk_shows_itself(walks: dict[str, Walk], tmp_path: Path) -> None:
    walk = walks["compass"]
    assert walk.signals.u.shape == (len(walk.signals.t), 0)
    cell = walk._repr_html_()
    assert cell.startswith("<p>Passive: 4 impacts. COMPLETED")
    assert walk.trajectory._repr_html_() == cell
    shown = {axes.get_ylabel() for axes in walk.trajectory.plot().axes}
    assert shown == {"angle [rad]", "energy [J]", r"$\dot\Theta$ [rad/s]"}
    walk.export(tmp_path / "walk.mat")
    walk.save(tmp_path / "walk.npz")
    again = load_walk(tmp_path / "walk.npz")
    np.testing.assert_array_equal(again.signals.potential, walk.signals.potential)
    assert again.note == walk.note
    for name in ("tracking", "ground", "energy", "phase"):
        assert draw(name, {"Passive": walk}).axes
    for name in ("disturbance", "comparison"):
        with pytest.raises(InputError, match="without"):
            draw(name, {"Passive": walk})


def test_passive_walks_that_cannot_be() -> None:
    with pytest.raises(InputError, match="4 motors"):
        passive_walk("rabbit")
    with pytest.raises(InputError, match="at least 1"):
        passive_walk("compass", 0)
    with pytest.raises(SimulationError, match="no return"):
        passive_walk("compass", slope=-0.1)


def test_simulate_walks_a_robot_without_motors(tmp_path: Path) -> None:
    run = CliRunner().invoke(
        app,
        ["simulate", "--robot", "rimless_wheel", "--impacts", "2", "-o", str(tmp_path / "a.npz")],
    )
    assert run.exit_code == 0, run.output
    assert "0.0916" in run.output  # 2 l sin(alpha) sin(0.12)
    assert load_walk(tmp_path / "a.npz").walker.slope == 0.12
    wrong = CliRunner().invoke(app, ["simulate", "--robot", "compass", "--torque-limit", "9"])
    assert isinstance(wrong.exception, InputError)
    assert "torque_limit" in str(wrong.exception)
