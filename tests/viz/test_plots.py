"""Figures: what they show, that they repeat."""

from __future__ import annotations

import re

import matplotlib as mpl
import numpy as np
import pytest

from biped_adrc.errors import InputError
from biped_adrc.gait.gait import load_gait
from biped_adrc.model.biped import Biped
from biped_adrc.studies.walk import Walk
from biped_adrc.viz.plots import (
    multiplier_figure,
    phase_figure,
    push_map_figure,
    return_map_figure,
    tracking_figure,
)
from biped_adrc.viz.robot_figure import robot_figure
from biped_adrc.viz.style import render


def labels(figure) -> list[tuple[str, str]]:
    return [(axes.get_xlabel(), axes.get_ylabel()) for axes in figure.axes]


def test_tracking_figure(walks: dict[str, Walk]) -> None:
    s = walks["NPD"].signals
    figure = tracking_figure(s, "NPD", (0.5, 0.6), 150.0)
    assert len(figure.axes) == 8
    assert [len(axes.get_lines()) for axes in figure.axes[1::2]] == [4, 4, 6, 4]
    units = [y for _, y in labels(figure)][::2]
    assert units[:3] == ["angle [rad]", "angle [rad]", "torque [N m]"]
    assert re.fullmatch(r"tracking error \[(n|µ|m|)rad\]", units[3])
    assert figure.axes[-1].get_xlabel() == "time [s]"
    t, q = figure.axes[0].get_lines()[0].get_data()
    assert np.isnan(q).sum() == 2  # the line breaks at both impacts inside
    np.testing.assert_array_equal(q[~np.isnan(q)], s.q[:, 0])
    assert figure.axes[1].get_xlim()[0] == pytest.approx(0.2)
    assert len(t) == len(s.t) + 2
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
    assert axes.get_lines()[2].get_xdata()[0] == pytest.approx(-1.25)
    assert "[rad/s]" in axes.get_xlabel()


def test_push_map_figure() -> None:
    rows = [
        {
            "onset_ms": o,
            "amplitude": a,
            "pattern": "all +",
            "torque_limit": limit,
            "npd": n,
            "adrc": d,
        }
        for limit in (None, 150.0)
        for o, a, n, d in (
            (0.0, 30.0, True, True),
            (100.0, 30.0, False, True),
            (0.0, 60.0, False, False),
        )
    ]
    figure = push_map_figure(rows)
    assert len(figure.axes) == 2
    assert [len(axes.patches) for axes in figure.axes] == [3, 3]
    assert [patch.get_hatch() for patch in figure.axes[0].patches] == ["", "///", "xxx"]
    assert "unlimited" in figure.axes[0].get_title(loc="left")
    assert "NPD falls 2, ADRC 1 of 3" in figure.axes[1].get_title(loc="left")
    assert figure.axes[0].get_xlabel().endswith("[ms]")
    assert figure.axes[0].get_ylabel().endswith("[N m]")
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert texts == ["both walk", "only NPD falls", "only ADRC falls", "both fall"]
    with pytest.raises(InputError, match="no cells"):
        push_map_figure([])


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
