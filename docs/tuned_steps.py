"""How far the numbers of docs/tuned.md move when every step of integration is half as long."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from tuned_entries import Entry, Walks, key_of, walks_of
from tuned_text import MRAD, name, number

from biped_adrc.types import Array


class Moved(NamedTuple):
    """A setting's walks with the steps of the contest and with half of them, under one condition."""

    entry: Entry
    usual: Walks
    halved: Walks

    @property
    def medians(self) -> tuple[float, float]:
        """The median errors [rad], of both."""
        return _median(self.usual.rms_error), _median(self.halved.rms_error)

    @property
    def change(self) -> float:
        """Of the median error, as a share; infinite where one of both medians is that of walks not legal."""
        a, b = self.medians
        if not np.isfinite([a, b]).all():
            return 0.0 if a == b else np.inf
        return abs(b / a - 1.0)


def moved(summary: Mapping[str, Any], found: Sequence[Entry]) -> list[Moved]:
    """The settings that were walked with half steps."""
    by_key = {key_of(e._asdict()): e for e in found}
    out = []
    for told in summary["beside"].get("halved", []):
        e = by_key.get(key_of(told))
        if e is not None:
            first = Walks(*(x[:1] for x in e.tuned))
            out.append(Moved(e, first, walks_of(told["walks"])))
    return out


def step_sentences(summary: Mapping[str, Any], found: Sequence[Entry]) -> list[str]:
    """For each place how far medians and the number of legal walks move with half the steps."""
    asked, lines = moved(summary, found), []
    for place in dict.fromkeys(x.entry.place for x in asked):
        here = [x for x in asked if x.entry.place == place]
        most = max(here, key=lambda x: x.change)
        a, b = (number(MRAD * x) for x in most.medians)
        shifts = [_shift(x) for x in here]
        lines.append(
            f"{place}: of {len(here)} settings the median error moves most for {name(most.entry)} at gait "
            f"{most.entry.gait}, from {a} to {b} mrad; in the middle of them by "
            f"{100.0 * np.median([x.change for x in here]):.2g} %. Legal walks of a setting change by at most "
            f"{max(shifts, key=abs):+d} of {here[0].usual.legal.size}, those of all settings by "
            f"{sum(shifts):+d} of {sum(x.usual.legal.size for x in here)}."
        )
    return lines


def _shift(x: Moved) -> int:
    """How many more walks are legal with half the steps."""
    return int(x.halved.legal.sum() - x.usual.legal.sum())


def _median(x: Array) -> float:
    return float(np.median(x))
