"""Thinned lines keep what can be seen; the numbers of a figure do not depend on thinning."""

from __future__ import annotations

import json

import numpy as np
import pytest
from matplotlib.figure import Figure

from biped_adrc.viz.figure_numbers import as_text, differences, numbers_of
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


def drawn(count: int, zoom: bool = False) -> Figure:
    figure = Figure()
    axes = figure.subplots()
    axes.plot(*spiked(count), label="error")
    axes.bar([0, 1], [3.0, 4.0], label="torque")
    axes.set(
        xlabel="t [s]", ylabel="e [rad]", xlim=(SPIKE - 1e-4, SPIKE + 1e-4) if zoom else (0.0, 1.0)
    )
    return figure


@pytest.mark.parametrize("zoom", [False, True])
def test_numbers_depend_neither_on_thinning_nor_on_nodes(zoom: bool) -> None:
    numbers = numbers_of(drawn(200_000, zoom))
    assert differences(numbers, numbers_of(thin(drawn(200_000, zoom))), 1e-4) == []
    assert differences(numbers, numbers_of(thin(drawn(100_000, zoom)))) == []
    panel = numbers["panels"][0]
    assert panel["bars"] == {"torque": [3.0, 4.0]}
    assert panel["lines"]["error"]["y"][1] == pytest.approx(
        5.0 + np.sin(6 * np.pi * SPIKE), rel=1e-4
    )
    assert json.loads(as_text(numbers)) == numbers


def test_differences_name_what_differs() -> None:
    old = numbers_of(drawn(1000))
    new = json.loads(as_text(old))
    assert differences(old, new) == []
    line = new["panels"][0]["lines"]["error"]
    top = line["y"][1]
    line["y"][1] = 1.009 * top
    assert differences(old, new) == []
    line["y"][1] = 1.02 * top
    (found,) = differences(old, new)
    assert found.startswith("panels 1, lines, error, y 2: ")
    assert f"{top:g} in the file, {1.02 * top:g} now" in found
    assert differences({"a": "x [s]"}, {"a": "x [ms]"}) == ["a: 'x [s]' in the file, 'x [ms]' now"]
