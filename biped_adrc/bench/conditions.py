"""Under what controllers are compared: named disturbances, model errors, sensors; numbers in comparison.toml.

Each condition is a set of values of a trial, put on top of a common base: a controller sampled at 1 kHz with
exact sensors and RABBIT's torque limit of 150 N m, and a start a little off the gait's speed. What is random
in a condition is drawn from the trial's seed and is the same for all controllers.

Pure data and functions on it; `bench.settings` makes the trials of it.
"""

from __future__ import annotations

from typing import NamedTuple

from biped_adrc.campaign.chunk import Record
from biped_adrc.resources import packaged
from biped_adrc.scenario.build import RIGID
from biped_adrc.scenario.dotted import flat
from biped_adrc.types import PlainRecord


class ComparisonCondition(NamedTuple):
    """One condition: `words` for a reader, and `values` of a scenario in SI units, on top of `BASE`.

    place: whose tuned settings controllers have there; None where none were tuned.
    """

    words: str
    values: Record
    place: str | None = None


SAID: PlainRecord = packaged("biped_adrc.bench", "comparison.toml")
"""The tables of comparison.toml: base, conditions and texts of the page."""
BASE: Record = flat(SAID["base"])
"""Values that all trials of a comparison share."""
CONDITIONS = {
    name: ComparisonCondition(
        said["words"],
        flat({k: x for k, x in said.items() if k not in ("words", "place")}),
        said.get("place"),
    )
    for name, said in SAID["conditions"].items()
}
"""Conditions by name, in the order of the tables."""


def conditions_on(plant: str, alike: bool = False) -> tuple[str, ...]:
    """Those of the conditions that walks on a plant can have; alike: for which settings were tuned, too."""
    alone = set() if plant == RIGID else {"errors.impact_width"}
    return tuple(
        name
        for name, known in CONDITIONS.items()
        if not alone & known.values.keys() and (known.place or not alike)
    )
