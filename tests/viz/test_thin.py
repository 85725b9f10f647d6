"""Thinned lines keep what can be seen."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

from biped_adrc.viz.thin import thin, thinned

WIDTH = 1.0 / 600
SPIKE, JUMP = 180.5 * WIDTH, 300.5 * WIDTH
"""In the middle of a column, so that they are not its ends."""


def spiked(count: int) -> tuple[np.ndarray, np.ndarray]:
    """A sine with a spike 0.1 ms wide, a jump and a gap at t = 0.75."""
    t = np.sort(np.concatenate((np.linspace(0.0, 1.0, count), [JUMP, JUMP, SPIKE])))
    y = np.sin(2.0 * np.pi * 3.0 * t) + 5.0 * np.exp(-(((t - SPIKE) / 1e-4) ** 2))
    second = np.flatnonzero(t == JUMP)[-1]
    y[second:] -= 2.0
    y[np.searchsorted(t, 0.75)] = np.nan
    return t, y


def test_extremes_ends_jumps_and_gaps_survive() -> None:
    t, y = spiked(100_000)
    kept = thinned(t, y, WIDTH)
    assert len(kept) < 600 * 6
    assert np.all(np.diff(kept) > 0)
    assert (np.nanmin(y[kept]), np.nanmax(y[kept])) == (np.nanmin(y), np.nanmax(y))
    assert (kept[0], kept[-1]) == (0, len(t) - 1)
    assert np.isnan(y[kept]).sum() == 1
    before, after = (y[np.flatnonzero(t == JUMP)[k]] for k in (0, -1))
    at_jump = y[kept][t[kept] == JUMP]
    assert before in at_jump
    assert after in at_jump
    # in every column that has points the drawn line spans what the whole one spans
    for column in range(0, 600, 7):
        whole = y[np.floor(t / WIDTH) == column]
        drawn = y[kept][np.floor(t[kept] / WIDTH) == column]
        assert np.nanmax(drawn) == np.nanmax(whole)
        assert np.nanmin(drawn) == np.nanmin(whole)


def test_sparse_lines_are_left_alone() -> None:
    t, y = spiked(400)
    np.testing.assert_array_equal(thinned(t, y, WIDTH), np.arange(len(t)))


def test_a_curve_keeps_its_turning_points() -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 50_001)
    x, y = np.cos(angle), np.sin(angle)
    kept = thinned(x, y, 2.0 / 600)
    assert len(kept) < 10_000
    for whole, drawn in ((x, x[kept]), (y, y[kept])):
        assert (drawn.min(), drawn.max()) == (whole.min(), whole.max())


def drawn(count: int, zoom: bool = False) -> Figure:
    figure = Figure()
    axes = figure.subplots()
    axes.plot(*spiked(count), label="error")
    axes.bar([0, 1], [3.0, 4.0], label="torque")
    axes.set(
        xlabel="t [s]", ylabel="e [rad]", xlim=(SPIKE - 1e-4, SPIKE + 1e-4) if zoom else (0.0, 1.0)
    )
    return figure


def test_limits_stay_and_a_zoom_keeps_what_it_shows() -> None:
    figure = drawn(100_000)
    limits = drawn(100_000).axes[0].get_ylim()
    assert thin(figure).axes[0].get_ylim() == limits
    t, y = thin(drawn(100_000, zoom=True)).axes[0].get_lines()[0].get_data()
    assert len(t) <= 23  # 21 nodes are in the window, and one before and after it
    assert t[0] < SPIKE - 1e-4
    assert y.max() == pytest.approx(5.0 + np.sin(6 * np.pi * SPIKE))


def test_lines_outside_and_values_that_are_not_finite() -> None:
    figure = Figure()
    axes = figure.subplots()
    t = np.linspace(0.0, 1.0, 5000)
    axes.plot(t, t, label="outside")
    axes.plot(t, np.full(len(t), np.nan), label="none")
    axes.plot(t, np.where(t > 1.5, np.inf, t), label="inside")
    axes.set_xlim(2.0, 3.0)
    thin(figure)
    assert len(axes.get_lines()[0].get_xdata()) == 0
    y = np.where(t < 0.5, t, np.inf)
    kept = thinned(t, y, WIDTH)
    assert y[kept][-1] == np.inf
    assert len(kept) < 3000
