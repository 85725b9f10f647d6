"""What walks are disturbed with in a comparison: named values of a trial, on top of a base.

The base is a sampled controller with exact sensors and RABBIT's 150 N m; every walk starts a little off the
gait's speed, by its seed. What is random in a condition is drawn anew for every seed, and is the same for all
controllers. Each controller runs at its author's or its example's settings, and those with an observer once
more with all poles at the geometric mean of Table I, so that what is left between two of them is not bandwidth.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.resources import packaged
from biped_adrc.scenario.registry import find


class Condition(NamedTuple):
    """words: for a reader. values: of a scenario."""

    words: str
    values: Mapping[str, Any]


SAID: Mapping[str, Any] = packaged("biped_adrc.bench", "comparison.toml")
"""The file comparison.toml."""
BASE: Mapping[str, Any] = SAID["base"]
COMPARED = ("PD", "NPD", "ADRC", "ADRC output", "LESO", "DOB", "CLF-QP")
"""Controllers, in the order of the tables."""
CONDITIONS = {
    name: Condition(said["words"], {k: x for k, x in said.items() if k != "words"})
    for name, said in SAID["conditions"].items()
}
"""By name, in the order of the table."""

BANDWIDTH = math.exp(sum(math.log(abs(p)) for p in TABLE_I) / len(TABLE_I))
"""Geometric mean of the poles of Table I [rad/s]."""
OWN = {
    **dict.fromkeys(("ADRC", "ADRC output"), BANDWIDTH),
    **{name: float(find("controller", name).defaults["bandwidth"]) for name in ("LESO", "DOB")},
}
"""The controllers with an observer, and the bandwidth of their own settings [rad/s]: of Table I the geometric
mean; LESO's walks with encoders at 1 kHz."""
ORDER = dict.fromkeys(("ADRC", "ADRC output"), len(TABLE_I) - 2)
"""m of the observer, where the trial has to say it with a bandwidth."""
NOT_ALIKE: str = SAID["texts"]["settings"].format(**OWN)


def record(condition: str, controller: str, seed: int) -> dict[str, Any]:
    """The values of one trial."""
    return {**BASE, **CONDITIONS[condition].values, "controller": controller, "seed": seed}


def walked_again(controllers: Sequence[str]) -> list[str]:
    """Those of the controllers that have an observer."""
    return [c for c in controllers if c in OWN]


def equal_values(controller: str) -> dict[str, Any]:
    """Of a trial, beside what it has."""
    order = {"order": ORDER[controller]} if controller in ORDER else {}
    return {"bandwidth": BANDWIDTH, **order}


def equal_record(condition: str, controller: str, seed: int) -> dict[str, Any]:
    """The values of one trial at equal bandwidth."""
    return record(condition, controller, seed) | equal_values(controller)
