"""Figures: what they show, that they repeat."""

from __future__ import annotations

import io
import re
from dataclasses import fields, replace
from itertools import pairwise

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.adrc import ADRCController
from biped_adrc.control.npd import NPDController
from biped_adrc.disturbances.pulse import TorquePulse
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import load_gait
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.model.biped import Biped
from biped_adrc.paper.figures import NAMES, draw, push_window
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.walk import walk as walk_of
from biped_adrc.viz import plots
from biped_adrc.viz.from_the_side.robot_figure import robot_figure
from biped_adrc.viz.plots.figures import (
    comparison_figure,
    multiplier_figure,
    phase_figure,
    return_map_figure,
    tracking_figure,
)
from biped_adrc.viz.plots.over_time import angle_unit
from biped_adrc.viz.style import render, style

NUMBER = rb"-?\d+\.?\d*"


def labels(figure) -> list[tuple[str, str]]:
    return [(axes.get_xlabel(), axes.get_ylabel()) for axes in figure.axes]


def test_tracking_figure(walks: dict[str, Walk]) -> None:
    s = walks["NPD"].signals
    figure = tracking_figure(s, "NPD", (0.5, 0.6), 150.0)
    whole, around, begins, ends = (
        figure.axes[a:b] for a, b in ((0, 5), (5, 10), (10, 13), (13, 16))
    )
    assert [len(axes.get_lines()) for axes in around] == [4, 4, 5, 6, 4]
    units = [axes.get_ylabel() for axes in whole]
    assert units[:4] == ["angle [rad]", "angle [rad]", r"push $\zeta$ [N m]", "torque [N m]"]
    assert re.fullmatch(r"tracking error \[(n|µ|m|)rad\]", units[4])
    for column in (begins, ends):
        assert [axes.get_ylabel() for axes in column] == units[2:]
        assert column[-1].get_xlabel() == "after the edge [ms]"
    assert begins[0].get_xlim() == pytest.approx((0.499, 0.506))
    assert ends[0].get_xlim() == pytest.approx((0.599, 0.606))
    assert whole[-1].get_xlabel() == "time [s]"
    t, q = figure.axes[0].get_lines()[0].get_data()
    assert np.isnan(q).sum() == 2  # the line breaks at both impacts inside
    np.testing.assert_array_equal(q[~np.isnan(q)], s.q[:, 0])
    assert around[0].get_xlim()[0] == pytest.approx(0.2)
    assert len(t) == len(s.t) + 2
    for column in (whole, around, begins, ends):  # one below the other, none on another
        heights = [axes.get_position() for axes in column]
        assert all(a.y0 > b.y1 for a, b in pairwise(heights))
    assert len(tracking_figure(s, "no push").axes) == 4


def test_phase_figure(walks: dict[str, Walk]) -> None:
    figure = phase_figure({name: walk.signals for name, walk in walks.items()})
    assert labels(figure)[0] == (r"$\Theta$ [rad]", r"$\dot\Theta$ [rad/s]")
    for axes, walk in zip(figure.axes, walks.values(), strict=True):
        s = walk.signals
        theta, rate = axes.get_lines()[0].get_data()
        np.testing.assert_array_equal(theta[~np.isnan(theta)], s.theta)
        np.testing.assert_array_equal(rate[~np.isnan(rate)], s.dtheta)
        assert len(axes.get_lines()) == 1 + 2 + 1  # the walk, two impacts, the start


def test_multiplier_and_return_map_figures() -> None:
    z = np.array([0.1j, 0.69, -1e-5])
    figure = multiplier_figure({"NPD": z, "ADRC": z[:2]}, published=[0.5, 0.2])
    circle, sizes = figure.axes
    assert [len(axes.get_lines()) for axes in figure.axes] == [3, 4]
    np.testing.assert_allclose(sizes.get_lines()[1].get_ydata(), [0.69, 0.1, 1e-5])
    assert circle.get_aspect() == 1.0
    before = np.linspace(-1.3, -1.2, 5)
    axes = return_map_figure(before, -1.25 + 0.7 * (before + 1.25)).axes[0]
    text = plots.magnitudes(axes_of_my_own(), {"A": [0.5, 0.0, 0.0]}).get_legend().get_texts()
    assert [t.get_text() for t in text] == ["unit circle", "A, 2 more are 0"]
    diagonal, drawn, first, second, settled = axes.get_lines()
    np.testing.assert_array_equal(diagonal.get_xdata(), diagonal.get_ydata())
    np.testing.assert_array_equal(drawn.get_xdata(), before)
    for stairs in (first, second):
        # the multiplier is 0.7: after 12 steps a distance of 0.05 rad/s is 0.7^12 of it
        assert abs(stairs.get_xdata()[-1] + 1.25) == pytest.approx(0.05 * 0.7**12)
        corners = np.diff(np.column_stack(stairs.get_data()), axis=0)
        assert np.all(np.min(np.abs(corners), axis=1) == 0.0)  # straight up or straight across
    assert settled.get_xdata()[0] == pytest.approx(-1.25, abs=1e-3)
    assert "[rad/s]" in axes.get_xlabel()
    with pytest.raises(InputError, match="finite samples"):
        return_map_figure(before[:1], before[:1])


@pytest.fixture(scope="module")
def pushed(biped: Biped) -> dict[str, Walk]:
    """Both controllers, pushed on every joint in step 2."""
    gait = load_gait("published", biped)
    push = TorquePulse([30.0, 20.0, -10.0, 5.0, 0.0], step=2, start=0.1, stop=0.3)
    laws = {
        "NPD": (NPDController(gait.constraint), RK4(2e-3)),
        "ADRC": (ADRCController(gait.constraint), Exponential(1e-3)),
    }
    return {c: walk_of(Walker(biped, law, push), gait, 3, m) for c, (law, m) in laws.items()}


def axes_of_my_own() -> Axes:
    return Figure().subplots()


def finite(line) -> np.ndarray:
    y = np.asarray(line.get_ydata(), dtype=float)
    return y[~np.isnan(y)]


def drawn_lines(axes: Axes) -> dict[str, np.ndarray]:
    """Data of the named lines."""
    return {x.get_label(): finite(x) for x in axes.get_lines() if x.get_label()[0] != "_"}


def test_plots_draw_the_signals_on_axes_of_ones_own(pushed: dict[str, Walk]) -> None:
    s = pushed["ADRC"].signals
    axes = axes_of_my_own()
    assert plots.joint_tracking(axes, s, [0, 2]) is axes
    assert set(drawn_lines(axes)) == {"$q_1$ stance hip", "$q_3$ stance knee", "references"}
    np.testing.assert_array_equal(drawn_lines(axes)["$q_3$ stance knee"], s.q[:, 2])
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time [s]", "angle [rad]")
    with pytest.raises(InputError, match="from 0 to 3"):
        plots.joint_tracking(axes, s, [4])

    axes = plots.torques(axes_of_my_own(), s, limit=150.0, push=(0.5, 0.7))
    assert set(drawn_lines(axes)) == {"$u_1$", "$u_2$", "$u_3$", "$u_4$", "limit 150 N m"}
    np.testing.assert_array_equal(drawn_lines(axes)["$u_4$"], s.u[:, 3])
    assert axes.get_ylabel() == "torque [N m]"
    assert "push" in axes.get_legend_handles_labels()[1]

    axes = plots.tracking_errors(axes_of_my_own(), s)
    unit = {"rad": 1.0, "mrad": 1e3, "µrad": 1e6, "nrad": 1e9}[axes.get_ylabel()[16:-1]]
    np.testing.assert_allclose(drawn_lines(axes)["$q_2$"], unit * s.error[:, 1])

    axes = plots.energy(axes_of_my_own(), s)
    lines = drawn_lines(axes)
    np.testing.assert_allclose(lines["kinetic"] + lines["potential"], lines["total"])
    assert lines["potential"].min() == 0.0
    assert axes.get_ylabel() == "energy [J]"

    axes = plots.phase_portrait(axes_of_my_own(), s)
    np.testing.assert_array_equal(drawn_lines(axes)["walk"], s.dtheta)


def test_the_estimate_is_drawn_against_what_it_estimates(pushed: dict[str, Walk]) -> None:
    s = pushed["ADRC"].signals
    axes = plots.total_disturbance(axes_of_my_own(), s, 1)
    lines = drawn_lines(axes)
    np.testing.assert_array_equal(lines[r"$\xi_2$"], s.xi[:, 1])
    np.testing.assert_array_equal(lines[r"$\hat{\xi}_2$"], s.xi_estimate[:, 1])
    assert axes.get_ylabel() == r"$\xi_2$ [rad/s²]"
    for i, torque in enumerate((30.0, 20.0, -10.0, 5.0)):
        axes = plots.matched_disturbance(axes_of_my_own(), s, i)
        lines = drawn_lines(axes)
        true, seen = lines[f"$\\zeta_{i + 1}$"], lines[f"$\\hat{{\\zeta}}_{i + 1}$"]
        assert set(np.unique(true)) == {min(0.0, torque), max(0.0, torque)}
        # 50 ms after its start the observer has the torque to 1 %
        late = (s.step == 2) & (s.t > s.t[true != 0.0][0] + 0.05) & (true != 0.0)
        assert late.sum() > 20
        np.testing.assert_allclose(seen[late], torque, rtol=0.01)
        assert axes.get_ylabel() == f"$\\zeta_{i + 1}$ [N m]"


def test_without_an_observer_the_plot_says_so(pushed: dict[str, Walk]) -> None:
    for plot in (plots.total_disturbance, plots.matched_disturbance):
        axes = plot(axes_of_my_own(), pushed["NPD"].signals)
        assert [text.get_text() for text in axes.texts] == ["no observer: nothing is estimated"]
        assert len(drawn_lines(axes)) == 1


def test_the_friction_cone_has_its_slope(pushed: dict[str, Walk]) -> None:
    s = pushed["NPD"].signals
    axes = plots.friction_cone(axes_of_my_own(), s, mu=0.5)
    edge = next(x for x in axes.get_lines() if x.get_label() == "cone, $\\mu$ = 0.5")
    (x0, x1), (y0, y1) = edge.get_data()
    assert (x1 - x0) / (y1 - y0) == pytest.approx(0.5)
    np.testing.assert_array_equal(drawn_lines(axes)["ground reaction"], s.ground_reaction[:, 1])
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("$F_T$ [N]", "$F_N$ [N]")
    with pytest.raises(InputError, match="positive"):
        plots.friction_cone(axes, s, mu=0.0)
    axes = plots.ground_reaction(axes_of_my_own(), s)
    np.testing.assert_array_equal(drawn_lines(axes)["$F_T$"], s.ground_reaction[:, 0])


@pytest.mark.parametrize(
    ("largest", "unit", "factor"),
    [(0.7, "rad", 1.0), (7.5e-3, "mrad", 1e3), (1.1e-6, "µrad", 1e6), (4e-10, "nrad", 1e9)],
)
def test_units_of_angles(largest: float, unit: str, factor: float) -> None:
    assert angle_unit(np.array([0.1 * largest, -largest])) == (unit, factor)


def test_the_size_of_a_sine_is_its_amplitude_and_that_over_the_root_of_two(
    pushed: dict[str, Walk],
) -> None:
    t = np.linspace(0.0, 1.0, 1001)
    error = 0.02 * np.sin(2 * np.pi * 5 * t)
    sine = replace(pushed["NPD"].signals, t=t, error=np.column_stack((error, -error, error, error)))
    axes = plots.error_sizes(axes_of_my_own(), {"NPD": sine})
    np.testing.assert_allclose(
        axes.get_lines()[0].get_ydata(), [0.02, 0.02 / np.sqrt(2)], rtol=1e-4
    )
    assert [text.get_text() for text in axes.texts] == ["2.0e-02", "1.4e-02"]


def test_both_edges_of_a_push_are_shown_with_all_that_happens_there(
    pushed: dict[str, Walk],
) -> None:
    """A spike of 0.2 ms after the edge, put into the torque, is in the drawn line and within the limits."""
    s = pushed["ADRC"].signals
    window = push_window(s)
    assert window is not None
    t0 = float(s.t[s.step == 2][0])
    np.testing.assert_allclose(window, (t0 + 0.1, t0 + 0.3), atol=1e-9)
    fine = np.sort(np.concatenate([s.t, *(edge + np.arange(-50, 300) * 2e-5 for edge in window)]))
    signals = {}
    for f in fields(s):
        column = getattr(s, f.name)
        columns = column.reshape(len(s.t), -1).T
        made = np.column_stack([np.interp(fine, s.t, c) for c in columns])
        signals[f.name] = made.reshape(len(fine), *column.shape[1:])
    signals["step"] = np.searchsorted(s.t[1:][np.diff(s.step) > 0], fine, side="left") + 1
    for k, edge in enumerate(window):
        signals["u"][:, k] += 100.0 * np.exp(-(((fine - edge - 5e-4) / 1e-4) ** 2))
    figure = tracking_figure(replace(s, **signals), "spikes", window)
    for k, axes in ((0, figure.axes[11]), (1, figure.axes[14])):
        assert axes.get_ylabel() == "torque [N m]"
        t, u = axes.get_lines()[k].get_data()
        top = np.nanargmax(u)
        assert t[top] == pytest.approx(window[k] + 5e-4, abs=3e-5)
        assert u[top] == signals["u"][:, k][np.abs(fine - window[k] - 5e-4) < 1e-3].max()
        assert axes.get_xlim() == pytest.approx((window[k] - 1e-3, window[k] + 6e-3))
        assert axes.get_ylim()[0] < u[top] < axes.get_ylim()[1]


def test_controllers_side_by_side(pushed: dict[str, Walk]) -> None:
    signals = {name: found.signals for name, found in pushed.items()}
    figure = comparison_figure(signals, (0.5, 0.7))
    pushes, over_time, sizes, torque = (figure.axes[k] for k in (0, 1, 6, 7))
    assert drawn_lines(pushes)[r"$\zeta_3$"].min() == -10.0
    assert over_time.get_yscale() == sizes.get_yscale() == "log"
    for i, (name, s) in enumerate(signals.items()):
        peak = np.max(np.abs(s.error))
        assert drawn_lines(over_time)[name].max() == peak
        assert sizes.get_lines()[i].get_ydata()[0] == peak
        bars = torque.containers[i]
        np.testing.assert_array_equal([b.get_height() for b in bars], np.max(np.abs(s.u), axis=0))
    assert [a.get_ylabel() for a in figure.axes] == [
        *[r"push $\zeta$ [N m]", "largest tracking error [rad]"] * 3,
        "tracking error [rad]",
        "peak torque [N m]",
    ]


@pytest.mark.parametrize("name", NAMES)
def test_every_figure_has_labels_with_units_and_apart_in_grey(
    pushed: dict[str, Walk], name: str
) -> None:
    figure = draw(name, pushed)
    for axes in figure.axes:
        assert re.search(r"\[.+\]", axes.get_ylabel())
        shared = axes.get_subplotspec().is_last_row()
        assert not shared or re.search(r"\[.+\]", axes.get_xlabel())
        looks = []
        for x in axes.get_lines():
            if x.get_label()[0] != "_" and len(x.get_xdata()) > 2:
                grey = round(float(np.dot(to_rgb(x.get_color()), (0.299, 0.587, 0.114))), 1)
                dash = x._unscaled_dash_pattern
                looks.append((grey, str(dash), x.get_linewidth(), x.get_marker()))
        assert len(set(looks)) == len(looks)
    assert len(render(figure, "svg")) < 4_000_000


def test_unknown_figures_are_refused(pushed: dict[str, Walk]) -> None:
    with pytest.raises(InputError, match="choose one of"):
        draw("pie", pushed)
    with pytest.raises(InputError, match="at least one"):
        draw("energy", {})


@pytest.mark.parametrize("pose", ["default", "x*"])
def test_robot_figure_marks_everything_and_labels_stay_apart(biped: Biped, pose: str) -> None:
    gait = load_gait("published", biped)
    figure = robot_figure(biped, None if pose == "default" else gait.q_minus)
    axes = figure.axes[0]
    texts = [text for text in axes.texts if text.get_text()]
    marks = {"$q_1$", "$q_2$", "$q_3$", "$q_4$", "$q_5$", r"$\Theta$", "$p_2$", "$p_e$"}
    assert {text.get_text() for text in texts} == marks
    assert len(axes.patches) >= sum(len(link.visuals) for link in biped.tree.links.values())
    render(figure, "png", dpi=50)
    boxes = [text.get_window_extent() for text in texts]
    assert not [(a, b) for i, a in enumerate(boxes) for b in boxes[:i] if a.overlaps(b)]


def test_figures_repeat_byte_for_byte_and_leave_matplotlib_alone(biped: Biped) -> None:
    settings = dict(mpl.rcParams)
    for kind, start in (("svg", b"<?xml"), ("png", b"\x89PNG")):
        first, second = (render(robot_figure(biped), kind, dpi=40) for _ in range(2))
        assert first == second
        assert first.startswith(start)
    assert dict(mpl.rcParams) == settings
    with pytest.raises(InputError, match="expected 'png' or 'svg'"):
        render(robot_figure(biped), "bmp")


def test_paths_keep_hundredths_and_nothing_else_changes() -> None:
    figure = Figure(figsize=(4.0, 4.0))
    figure.add_axes((0.0, 0.0, 1.0, 1.0)).plot([0.123456, 0.5, 0.9], [0.1, 0.777777, 0.3])
    whole = io.BytesIO()
    with style():
        figure.savefig(whole, format="svg", metadata={"Date": None})
    long, short = (
        [float(n) for path in re.findall(rb'\bd="([^"]*)"', svg) for n in re.findall(NUMBER, path)]
        for svg in (whole.getvalue(), render(figure, "svg"))
    )
    assert max(abs(a - b) for a, b in zip(long, short, strict=True)) <= 0.005 + 1e-9
    assert any(a != b for a, b in zip(long, short, strict=True))
    rest = [re.sub(rb'\bd="[^"]*"', b"", svg) for svg in (whole.getvalue(), render(figure, "svg"))]
    assert rest[0] == rest[1]


@pytest.mark.parametrize("mu", [0.3, 0.6])
def test_the_cone_is_filled_between_its_edges(pushed: dict[str, Walk], mu: float) -> None:
    axes = plots.friction_cone(axes_of_my_own(), pushed["NPD"].signals, mu=mu)
    corners = axes.patches[0].get_xy()
    for x, z in corners[1:3]:
        assert abs(x) / z == pytest.approx(mu)
