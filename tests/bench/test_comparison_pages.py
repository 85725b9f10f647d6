"""What a comparison shows: figures and page, read back from what they draw."""

import math
import sys

import numpy as np
import pytest

from biped_adrc.bench.cell import IMPULSE, MEASURES, NEEDS, REASONS
from biped_adrc.bench.compare_study import figures, write
from biped_adrc.bench.comparison import compare
from biped_adrc.bench.run import COLUMNS
from biped_adrc.bench.settings import AS_PUBLISHED
from biped_adrc.cli.app import command
from biped_adrc.viz.comparison_text import interval
from biped_adrc.viz.pages import comparison_html
from biped_adrc.viz.plots.comparison_figure import feasible_figure, measure_figure
from biped_adrc.viz.plots.sweep_maps import Maps, cut, sweep_map_figure


def row(r):
    """ADRC tracks ten times closer; with encoders no walk is feasible."""
    feasible = "counts" not in r
    error = {"NPD": 1e-2, "DOB": 5e-3, "ADRC": 1e-3}[r["controller"]]
    known = dict.fromkeys(COLUMNS) | dict.fromkeys((*MEASURES, *NEEDS), 1.0)
    known |= dict.fromkeys((*REASONS, IMPULSE), 0) | {"detail": ""}
    return known | {
        "status": "COMPLETED",
        "survived": 1,
        "feasible": int(feasible),
        "outcome": "feasible" if feasible else "infeasible",
        "bad_friction": int(not feasible),
        "peak_error": error,
        "rms_error": error,
    }


@pytest.fixture(scope="module")
def summary(tmp_path_factory):
    found = compare(
        lambda records: [row(dict(r)) for r in records],
        ("NPD", "ADRC", "DOB"),
        ("nothing", "push on joints", "encoders"),
        20,
        settings=AS_PUBLISHED,
    )
    return write(found, tmp_path_factory.mktemp("compare"), "biped-adrc compare", 1)


def test_the_figure_shows_feasible_walks_large_and_all_others_small(summary):
    (axes,) = feasible_figure(summary["cells"]).axes
    at = (1, 2)  # ADRC with encoders
    texts = {
        t.get_text(): t.get_fontsize()
        for t in axes.texts
        if abs(t.get_position()[0] - at[0]) < 0.1 and abs(t.get_position()[1] - at[1]) < 0.5
    }
    assert texts["0 %"] > 1.5 * texts["but impact: 0 %, all steps: 100 %"]
    assert "0 to 16" in texts


def test_marks_are_hollow_where_no_walk_is_feasible(summary):
    (axes,) = measure_figure(summary["cells"], "peak_error", "error").axes
    marks = [c.lines[0] for c in axes.containers]
    filled = [m for m in marks if m.get_markerfacecolor() != "white"]
    hollow = [m for m in marks if m.get_markerfacecolor() == "white"]
    assert [len(m.get_xdata()) for m in filled] == [2, 2, 2]
    assert [len(m.get_xdata()) for m in hollow] == [1, 1, 1]
    assert np.all(np.concatenate([m.get_ydata() for m in hollow]) > 1.5)


def test_legends_name_each_controller_once(summary):
    for name, figure in figures(summary).items():
        shown = [text.get_text() for legend in figure.legends for text in legend.get_texts()]
        assert shown == ([] if name == "feasible" else ["NPD", "ADRC", "DOB"])


def test_the_page_says_first_that_settings_are_not_alike(summary):
    html = comparison_html(summary, {})
    texts = ("not tuned alike", "The gait itself", "impulse beyond the cone")
    order = [html.index(text) for text in texts]
    assert order == sorted(order)


def test_the_command_is_text_on_the_page(summary):
    html = comparison_html(summary | {"command": "biped-adrc compare -o '<b>&'"}, {})
    assert "biped-adrc compare -o &#39;&lt;b&gt;&amp;&#39;" in html
    assert "'<b>&'" not in html


@pytest.mark.parametrize(
    ("value", "label", "limits"),
    [
        ("survived", "share of walks that make all steps", (0.0, 1.0)),
        ("feasible", "share of walks that are feasible", (0.0, 1.0)),
        ("peak_error", "mean of peak_error", (0.0, 0.5)),
    ],
)
def test_maps_say_which_share_they_show(value, label, limits):
    x = np.array([1.0, 2.0, 1.0, 2.0])
    shown = np.array([0.0, 0.5, 0.5, 0.5])
    figure = sweep_map_figure({"x": x, "y": x, value: shown}, Maps("x", "y", None, value))
    bar = figure.axes[-1]
    assert bar.get_ylabel() == label
    assert bar.get_ylim() == pytest.approx(
        (limits[0], limits[1]) if value in ("survived", "feasible") else (0.25, 0.5)
    )


def test_levels_have_as_few_digits_as_tell_them_apart():
    """Within 1 %: a tick such as 534.7 says more than a map can show."""
    assert cut(np.geomspace(100.0, 2000.0, 6), True).texts == [
        "100",
        "182",
        "331",
        "603",
        "1100",
        "2000",
    ]
    assert cut(np.array([1e-3, 1.5e-3, 2e-3]), False).texts == ["0.001", "0.0015", "0.002"]
    assert cut(np.array([0.1, 0.1001]), False).texts == ["0.1", "0.1001"]
    assert cut(np.array([-0.17453, 0.0, math.nan]), False).texts == ["-0.175", "0", "none"]


def test_the_command_can_be_typed_again(monkeypatch):
    """With the quotes that a condition of several words needs."""
    given = ["biped-adrc", "compare", "--conditions", "push on joints,delay"]
    monkeypatch.setattr(sys, "argv", given)
    assert command() == "biped-adrc compare --conditions 'push on joints,delay'"


def test_intervals_are_written_without_powers_where_they_need_none():
    assert interval([184.0, 171.0, 1234.0]) == "180 (170 to 1200)"
    assert interval([1.26e-4, 0.0, -2e-5]) == "0.00013 (0 to -2e-05)"
    assert interval([0.9166, 0.646, 1.0], 3, 100.0) == "91.7 (64.6 to 100)"
    assert interval(None) == "–"
