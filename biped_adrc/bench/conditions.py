"""Under what controllers are compared: named disturbances, model errors, sensors; numbers in comparison.toml.

Each condition is a set of values of a trial, put on top of a common base: a controller sampled at 1 kHz with
exact sensors and RABBIT's torque limit of 150 N m, and a start a little off the gait's speed. What is random
in a condition is drawn from the trial's seed and is the same for all controllers.

Where settings are as published, controllers with an observer are walked once more with all observer poles at
the geometric mean of Table I: what then still differs between two of them is not a difference of bandwidth.

Pure data and functions on it; `bench.settings` makes the trials of it, `bench.largest_push` those with pushes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from biped_adrc.campaign.chunk import Record
from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.resources import packaged
from biped_adrc.scenario.build import RIGID
from biped_adrc.scenario.registry import find
from biped_adrc.scenario.scenario import OF_RIGID
from biped_adrc.types import PlainRecord


class ComparisonCondition(NamedTuple):
    """One condition: `words` for a reader, and `values` of a scenario in SI units, on top of `BASE`.

    place: whose tuned settings controllers have there; None where none were tuned.
    """

    words: str
    values: Record
    place: str | None = None


SAID: PlainRecord = packaged("biped_adrc.bench", "comparison.toml")
"""The tables of comparison.toml: base, conditions, push, directions, phases, and texts of the page."""
BASE: Record = SAID["base"]
"""Values that all trials of a comparison share."""
CONDITIONS = {
    name: ComparisonCondition(
        said["words"],
        {k: x for k, x in said.items() if k not in ("words", "place")},
        said.get("place"),
    )
    for name, said in SAID["conditions"].items()
}
"""Conditions by name, in the order of the tables."""
PUSH: Record = {k: x for k, x in SAID["push"].items() if k != "place"}
"""Values of all trials of the search for the largest push."""
PUSH_PLACE: str = SAID["push"]["place"]
"""Whose tuned settings controllers have in that search."""

BANDWIDTH = math.exp(sum(math.log(abs(p)) for p in TABLE_I) / len(TABLE_I))
"""Geometric mean of the observer poles of Table I [rad/s]."""
OWN: dict[str, float] = {
    **dict.fromkeys(("ADRC", "ADRC output"), BANDWIDTH),
    **{name: float(find("controller", name).defaults["bandwidth"]) for name in ("LESO", "DOB")},
}
"""The bandwidth [rad/s] of each controller that has an observer, at its own settings.

With the poles of Table I it is their geometric mean. LESO's is what walks with encoders at 1 kHz allow.
"""
ORDER = dict.fromkeys(("ADRC", "ADRC output"), len(TABLE_I) - 2)
"""m, the number of extended states, of the GPI observers: a bandwidth alone would not say it."""


def conditions_on(plant: str, alike: bool = False) -> tuple[str, ...]:
    """Those of the conditions that walks on a plant can have; alike: for which settings were tuned, too."""
    alone = set() if plant == RIGID else set(OF_RIGID)
    return tuple(
        name
        for name, known in CONDITIONS.items()
        if not alone & known.values.keys() and (known.place or not alike)
    )


def walked_again(controllers: Sequence[str]) -> list[str]:
    """Those of the controllers that have an observer, and so a bandwidth to be made equal."""
    return [c for c in controllers if c in OWN]


def equal_values(controller: str) -> dict[str, float]:
    """Values that put all observer poles of this controller at `BANDWIDTH` [rad/s]."""
    order: dict[str, float] = {"order": ORDER[controller]} if controller in ORDER else {}
    return {"bandwidth": BANDWIDTH, **order}
