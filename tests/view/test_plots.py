"""Figures: what they show, that they repeat.

Fixtures: pushed, walks of RABBIT under NPD and ADRC with a push in step 2; fallen, a walk that a push throws
backwards. drawn_lines(axes) are the data of the named lines, without NaN.
"""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from biped_adrc.analysis.loops.gang import GANG_UNITS, Gang
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.adrc import ADRCController
from biped_adrc.control.npd import NPDController
from biped_adrc.core.errors import InputError, WalkWarning
from biped_adrc.disturbances.waves import TorquePulse
from biped_adrc.gait.gait import load_gait
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.hybrid.status import Status
from biped_adrc.model.biped import Biped
from biped_adrc.model.robot_import.import_robot import biped_from_urdf
from biped_adrc.model.robots.urdf import Visual
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.stored import load_walk
from biped_adrc.scenario.walk import walk as walk_of
from biped_adrc.view.from_the_side import side_view
from biped_adrc.view.from_the_side.check_figure import check_figure
from biped_adrc.view.from_the_side.side_view import bones
from biped_adrc.view.meshcat import objects
from biped_adrc.view.plots import figures, over_time, zero_dynamics
from biped_adrc.view.plots.figures import NAMES, draw, gang_figure
from biped_adrc.view.plots.study import map_figure, path_figure
from biped_adrc.view.style import render


@pytest.fixture(scope="module")
def pushed(biped: Biped) -> dict[str, Walk]:
    """Both controllers, pushed on every joint in step 2."""
    gait = load_gait("published", biped)
    push = TorquePulse([30.0, 20.0, -10.0, 5.0, 0.0], step=2, start=0.1, stop=0.3)
    laws = {
        "NPD": (NPDController(gait.constraint), RK4(2e-3)),
        "ADRC": (ADRCController(gait.constraint), Exponential(1e-3)),
    }
    with pytest.warns(WalkWarning, match="beside the edges of the push"):
        return {c: walk_of(Walker(biped, law, push), gait, 3, m) for c, (law, m) in laws.items()}


@pytest.fixture(scope="module")
def fallen(biped: Biped) -> Walk:
    """NPD under a push on the hips that throws it: it falls backwards, off the start of the curve."""
    gait = load_gait("v0.8", biped)
    push = TorquePulse([-150.0, -150.0, 0.0, 0.0, 0.0], step=4, start=0.3, stop=0.5)
    walker = Walker(biped, NPDController(gait.constraint), push, torque_limit=150.0)
    return walk_of(walker, gait, 9)


def test_a_fall_has_no_error_where_the_curve_has_ended(fallen: Walk, tmp_path: Path) -> None:
    """Thrown backwards in its last step, the robot passes the start of the gait's curve, behind which q_d means
    nothing (more than 100 rad off). From there on the error is NaN; the largest error is that before, also from
    a file.
    """
    s, h = fallen.signals, fallen.gait.constraint
    assert fallen.trajectory.status is Status.FELL
    off = s.theta > h.theta_plus  # the phase falls from theta_plus to theta_minus
    last = s.step == s.step[-1]
    behind = last & (s.t > s.t[last & ~off][-1])
    distance = np.abs(s.q[:, :4] - s.q_d)
    assert np.max(distance[behind]) > 100.0
    assert np.array_equal(np.isnan(s.error).any(axis=1), behind)
    assert s.peak_error == pytest.approx(np.max(distance[~behind]), rel=1e-3)
    assert s.peak_error < 0.5
    stored = load_walk(fallen.save(tmp_path / "fell.npz"))
    assert stored.signals.peak_error == s.peak_error


def test_the_panels_of_a_fall_show_what_a_robot_can_do(fallen: Walk) -> None:
    """No drawn angle is beyond a whole turn and no error above 0.5 rad: references of 100 rad, behind the start
    of the curve, would leave nothing else to be seen in the panels.
    """
    angles, knees, _, errors = fallen.plot().axes
    for axes in (angles, knees):
        assert max(np.max(np.abs(finite(x))) for x in axes.get_lines()) < 2.0 * np.pi
    assert errors.get_ylabel() == "tracking error [mrad]"
    sizes = over_time.error_sizes(axes_of_my_own(), {"NPD": fallen.signals})
    assert np.max(drawn_lines(sizes)["NPD"]) < 0.5


def axes_of_my_own() -> Axes:
    return Figure().subplots()


def finite(line) -> np.ndarray:
    y = np.asarray(line.get_ydata(), dtype=float)
    return y[~np.isnan(y)]


def drawn_lines(axes: Axes) -> dict[str, np.ndarray]:
    """Data of the named lines."""
    return {x.get_label(): finite(x) for x in axes.get_lines() if x.get_label()[0] != "_"}


def test_plots_draw_the_signals_on_axes_of_ones_own(pushed: dict[str, Walk]) -> None:
    """Lines are the signals themselves, by name and unit: angles and references, torques with the limit, errors
    in the unit of the label, energies with the least potential at 0, and the phase portrait.
    """
    s = pushed["ADRC"].signals
    axes = axes_of_my_own()
    assert over_time.joint_tracking(axes, s, [0, 2]) is axes
    assert set(drawn_lines(axes)) == {"$q_1$ stance hip", "$q_3$ stance knee", "references"}
    references = [line for line in axes.get_lines() if line.get_color() == "black"]
    for i, line in zip((0, 2), references, strict=True):  # with a gap, NaN, at each impact
        drawn = np.asarray(line.get_ydata(), dtype=float)
        np.testing.assert_array_equal(drawn[np.isfinite(drawn)], s.q_d[:, i])
    np.testing.assert_array_equal(drawn_lines(axes)["$q_3$ stance knee"], s.q[:, 2])
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time [s]", "angle [rad]")

    axes = over_time.torques(axes_of_my_own(), s, limit=150.0, push=(0.5, 0.7))
    assert set(drawn_lines(axes)) == {"$u_1$", "$u_2$", "$u_3$", "$u_4$", "limit 150 N m"}
    np.testing.assert_array_equal(drawn_lines(axes)["$u_4$"], s.u[:, 3])
    assert axes.get_ylabel() == "torque [N m]"
    assert "push" in axes.get_legend_handles_labels()[1]

    axes = over_time.tracking_errors(axes_of_my_own(), s)
    # [16:-1]: what is behind "tracking error ["
    unit = {"rad": 1.0, "mrad": 1e3, "µrad": 1e6, "nrad": 1e9}[axes.get_ylabel()[16:-1]]
    np.testing.assert_allclose(drawn_lines(axes)["$q_2$"], unit * s.error[:, 1])

    axes = over_time.energy(axes_of_my_own(), s)
    lines = drawn_lines(axes)
    np.testing.assert_allclose(lines["kinetic"] + lines["potential"], lines["total"])
    assert lines["potential"].min() == 0.0
    assert axes.get_ylabel() == "energy [J]"

    axes = over_time.phase_portrait(axes_of_my_own(), s)
    np.testing.assert_array_equal(drawn_lines(axes)["walk"], s.dtheta)


def test_the_friction_cone_has_its_slope(pushed: dict[str, Walk]) -> None:
    """The edge of the cone is |F_T| = 0.5 F_N, as line and as area; the course is the ground reaction."""
    s = pushed["NPD"].signals
    axes = over_time.friction_cone(axes_of_my_own(), s, mu=0.5)
    edge = next(x for x in axes.get_lines() if x.get_label() == "cone, $\\mu$ = 0.5")
    (x0, x1), (y0, y1) = edge.get_data()
    assert (x1 - x0) / (y1 - y0) == pytest.approx(0.5)
    np.testing.assert_array_equal(drawn_lines(axes)["ground reaction"], s.ground_reaction[:, 1])
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("$F_T$ [N]", "$F_N$ [N]")
    for x, z in axes.patches[0].get_xy()[1:3]:  # the two corners beside the tip
        assert abs(x) / z == pytest.approx(0.5)
    with pytest.raises(InputError, match="positive"):
        over_time.friction_cone(axes, s, mu=0.0)
    axes = over_time.ground_reaction(axes_of_my_own(), s)
    np.testing.assert_array_equal(drawn_lines(axes)["$F_T$"], s.ground_reaction[:, 0])


def test_the_size_of_a_sine_is_its_amplitude_and_that_over_the_root_of_two(
    pushed: dict[str, Walk],
) -> None:
    """Bars of largest error and rms, for an error that is 0.02 rad times a sine of 5 Hz in each joint."""
    t = np.linspace(0.0, 1.0, 1001)
    error = 0.02 * np.sin(2 * np.pi * 5 * t)
    sine = replace(pushed["NPD"].signals, t=t, error=np.column_stack((error, -error, error, error)))
    axes = over_time.error_sizes(axes_of_my_own(), {"NPD": sine})
    np.testing.assert_allclose(
        axes.get_lines()[0].get_ydata(), [0.02, 0.02 / np.sqrt(2)], rtol=1e-4
    )
    assert [text.get_text() for text in axes.texts] == ["2.0e-02", "1.4e-02"]


@pytest.mark.parametrize("name", NAMES)
def test_every_figure_has_labels_with_units(pushed: dict[str, Walk], name: str) -> None:
    """Each axis has a label with [unit], but for axes that share a label with their neighbour, and for those
    over names of joints or controllers. As SVG it has less than 4 MB.
    """
    figure = draw(name, pushed)
    for axes in figure.axes:
        place = axes.get_subplotspec()
        same = place.colspan.start >= 2 and name in ("tracking", "disturbance", "comparison")
        assert same or re.search(r"\[.+\]", axes.get_ylabel())
        shared = place.is_last_row() and not axes.get_xticklabels()[0].get_text().isalpha()
        assert (
            not shared
            or "$" in axes.get_xticklabels()[0].get_text()
            or re.search(r"\[.+\]", axes.get_xlabel())
        )
    assert len(render(figure, "svg")) < 4_000_000


LIMB = """<link name="{0}"><inertial><origin xyz="{1}"/><mass value="4"/>
<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>"""
HIP = """<joint name="{0}_hip" type="continuous"><parent link="trunk"/><child link="{0}"/>
<axis xyz="0 1 0"/><limit effort="40" velocity="9"/></joint>"""


@pytest.mark.parametrize(("com", "end"), [("0 0 0.3", (0.0, 0.3)), ("0.1 0 0.3", (0.1, 0.3))])
def test_a_robot_without_shapes_has_a_torso_and_rods(com: str, end, tmp_path: Path) -> None:
    """com: centre of mass of the trunk, in its frame at the hip; without a shape the trunk is a line from the
    hip to `end`, which is there. A leg without shapes is a ball and a rod.
    """
    # LIMB and HIP: texts of a link, by name and centre of mass, and of its joint
    legs = "".join(LIMB.format(x, "0 0 -0.4") + HIP.format(x) for x in ("left_leg", "right_leg"))
    path = tmp_path / "points.urdf"
    path.write_text(f'<robot name="points">{LIMB.format("trunk", com)}{legs}</robot>')
    robot = biped_from_urdf(path, feet=("left_leg", "right_leg"), tip=(0.0, 0.0, -0.8))
    (torso,) = (x for x in bones(robot) if x.link == "trunk")
    assert not torso.leg
    np.testing.assert_allclose(torso.ends[:, ::2], [(0.0, 0.0), end], rtol=0.0, atol=1e-12)
    assert [v.shape for v in robot.tree.links["left_leg"].visuals] == ["sphere", "cylinder"]


@pytest.mark.parametrize("name", ["rabbit", "compass", "three_link"])
def test_a_checked_robot_is_drawn_with_its_joints_masses_and_feet(name):
    """Arrows turn counter-clockwise for an axis along -y and clockwise for +y, by the sign of the area within
    their rim. Texts name all joints, masses and feet, and the title has the phase row.
    """
    biped = Biped.load(name)
    for axis in (-1.0, 1.0):
        tree = replace(
            biped.tree,
            joints=tuple(
                replace(j, axis=(0.0, axis, 0.0)) if j.type == "revolute" else j
                for j in biped.tree.joints
            ),
        )
        (axes,) = check_figure(replace(biped, tree=tree)).axes
        arrows = [patch.get_xy() for patch in axes.patches]
        assert len(arrows) == biped.n
        for xy in arrows:
            x, z = (xy - xy.mean(axis=0)).T[:, :30]  # the outer rim
            assert np.sign(np.sum(x[:-1] * z[1:] - x[1:] * z[:-1])) == -axis
    texts = {text.get_text() for text in axes.texts}
    assert {"stance foot", "swing foot", "hip"} < texts
    # the title ends with "= +1 q1 +0.5 q3", factors and angles in turn
    written = axes.get_title("left").partition("= ")[2]
    row = {int(q[1:]) - 1: float(c) for c, q in zip(*[iter(written.split())] * 2, strict=True)}
    phase = [row.get(i, 0.0) for i in range(biped.n)]
    np.testing.assert_allclose(phase, biped.phase, rtol=0.0, atol=1e-6)
    for i, joint in enumerate(biped.description.joints):
        assert f"q{i + 1} {joint}" in texts
    heavy = [link for link in biped.tree.links.values() if link.inertial]
    assert {f"{link.name} {link.inertial.mass:.4g} kg" for link in heavy} < texts


def test_five_controllers_have_five_colours_in_the_bars(pushed: dict[str, Walk]) -> None:
    """There are four hatches; the fifth is the first again."""
    walks = {f"{i}": pushed["NPD"].signals for i in range(5)}
    bars = over_time.torque_sizes(Figure().subplots(), walks).containers
    colours = {tuple(part[0].get_facecolor()) for part in bars}
    assert len(bars) == len(colours) == 5
    assert bars[4][0].get_hatch() == bars[0][0].get_hatch()


def test_lines_of_two_points_are_not_data_that_a_panel_is_fitted_to() -> None:
    """A mark at 50 (axhline, two points) would squash the data from 0 to 1, which fill their panel but for
    margins of 6 %.
    """
    axes = Figure().subplots()
    axes.plot([0.0, 1.0, 2.0], [0.0, 1.0, 0.5])
    axes.axhline(50.0)
    figures._limits([axes], 0.0, 2.0)
    assert axes.get_ylim() == pytest.approx((-0.06, 1.06))
    assert axes.get_xlim() == (0.0, 2.0)


def test_a_map_has_a_panel_for_each_case_and_no_more() -> None:
    """Five panels stand in rows of four, with labels at the outermost ones alone. A cell has the mean of its
    finite numbers as text: k and k + 2 at (1, 3). The cell (2, none) has an infinite one, and two cells have
    none: these three have no text.
    """
    x, y = [1.0, 1.0, 2.0], [3.0, 3.0, "none"]
    panels = {f"case {k}": (x, y, np.array([k, k + 2.0, np.inf])) for k in range(5)}
    figure = map_figure(panels, ("x [1]", "y [1]"), "error", log=False)
    shown = [axes.get_title(loc="left") for axes in figure.axes if axes.axison]
    assert shown == [*panels, ""]  # and the colour bar
    texts = [[t.get_text() for t in axes.texts] for axes in figure.axes[:5]]
    assert texts == [[f"{k + 1.0:.2g}", "", "", ""] for k in range(5)]
    labels = [(a.get_xlabel(), a.get_ylabel()) for a in figure.axes[:5]]
    assert labels == [("", "y [1]"), *[("x [1]", "")] * 3, ("x [1]", "y [1]")]


@pytest.mark.parametrize(("less", "best"), [(True, [np.inf, 4, 4, 2]), (False, [-np.inf, 4, 4, 4])])
def test_the_path_of_a_search_is_the_best_so_far_that_keeps_its_limits(less, best) -> None:
    """path: (number, objective, whether limits are kept). Lines: dots of candidates that keep them, crosses of
    the others, and the best so far among the first; less: whether less is better. "$" in a name is no formula.
    """
    path = [(0, 1.0, False), (1, 4.0, True), (2, np.inf, False), (3, 2.0, True)]
    figure = path_figure({"a": path, "$b": path[:2]}, "error [1]", less)
    found = [line.get_xydata().tolist() for line in figure.axes[0].lines[:3]]
    assert found == [[[1, 4], [3, 2]], [[0, 1]], [list(x) for x in enumerate(best)]]
    assert [t.get_text() for t in figure.legends[0].get_texts()] == ["a", r"\$b"]
    assert path_figure({"a": path}, "error [1]", less).legends == []


def test_what_cannot_be_drawn_is_refused() -> None:
    with pytest.raises(InputError, match="asked for as 'pdf', expected 'png' or 'svg'"):
        render(Figure(), "pdf")


def test_a_box_is_the_line_along_its_longest_edge() -> None:
    """A box at (1, 2, 3) with edges 0.1, 0.6, 0.2 [m] is a line along y, a cylinder along z, a ball none."""
    box = Visual("box", (0.1, 0.6, 0.2), (1.0, 2.0, 3.0), (0.0, 0.0, 0.0, 1.0))
    np.testing.assert_allclose(side_view._axis(box), [[1.0, 1.7, 3.0], [1.0, 2.3, 3.0]])
    rod = replace(box, shape="cylinder", size=(0.1, 0.6))
    np.testing.assert_allclose(side_view._axis(rod), [[1.0, 2.0, 2.7], [1.0, 2.0, 3.3]])
    assert side_view._axis(replace(box, shape="sphere", size=(0.1,))) is None
    shape = objects._shape(box).lower({})
    assert [shape[k] for k in ("width", "height", "depth")] == [0.1, 0.6, 0.2]


def test_zero_dynamics_are_drawn_over_the_domain_or_up_to_the_orbit() -> None:
    """The axis shows the domain of zeta, up to WIDE times the orbit where the domain has no end; if it is
    empty, from the lowest zeta, here 7, to the orbit, here 20.
    """

    # ends of the axis for a domain from low to high
    def drawn(low: float, high: float) -> tuple[float, float]:
        class Domain(tuple[SimpleNamespace, SimpleNamespace]):
            empty = low > high

        ends = Domain((SimpleNamespace(zeta=low), SimpleNamespace(zeta=high)))
        report = SimpleNamespace(domain=ends, orbits=SimpleNamespace(lowest=7.0), zeta_star=20.0)
        title = zero_dynamics._title(report) if ends.empty else ""  # type: ignore[arg-type]
        assert title == ("no speed keeps the limits" if ends.empty else "")
        return zero_dynamics._shown(report)  # type: ignore[arg-type]

    assert drawn(10.0, 30.0) == (10.0, 30.0)
    assert drawn(10.0, np.inf) == (10.0, zero_dynamics.WIDE * 20.0)
    assert drawn(30.0, 10.0) == (7.0, 20.0)


def test_the_gang_of_six_has_a_panel_with_a_curve_for_each() -> None:
    """Half the sampling frequency is a vertical line in all panels, the level 1 a horizontal one in those of S,
    T and y/r, which have no unit.
    """
    w = np.geomspace(1.0, 1e3, 200)
    gang = Gang(w, dict.fromkeys(GANG_UNITS, 1.0 + w), 1e-3)
    panels = gang_figure(gang, "loop").axes
    assert [len(x.get_lines()) for x in panels] == [3, 3, 2, 2, 3, 2]
    assert all(len(x.get_lines()[0].get_xdata()) == 200 for x in panels)
    assert panels[2].get_ylabel() == "|P S| [rad/(N m)]"
    assert panels[0].get_ylabel() == "|S|"
