"""The observers of a comparison once more, all with the same bandwidth.

In the table each controller runs at its author's or its example's settings. Here all poles of every observer
lie at the geometric mean of Table I, so that what is left between two of them is not bandwidth.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.scenario.registry import find
from biped_adrc.studies.bench.conditions import record

LESO_BANDWIDTH, DOB_BANDWIDTH = (
    float(find("controller", name).defaults["bandwidth"]) for name in ("LESO", "DOB")
)
"""Of their own settings [rad/s]; LESO's walks with encoders at 1 kHz."""
BANDWIDTH = math.exp(sum(math.log(abs(p)) for p in TABLE_I) / len(TABLE_I))
"""Geometric mean of the poles of Table I [rad/s]."""
OWN = {
    "ADRC": BANDWIDTH,
    "ADRC output": BANDWIDTH,
    "LESO": LESO_BANDWIDTH,
    "DOB": DOB_BANDWIDTH,
}
"""The controllers, and the bandwidth of their own settings [rad/s]: of Table I the geometric mean."""
ORDER = dict.fromkeys(("ADRC", "ADRC output"), len(TABLE_I) - 2)
"""m of the observer, where the trial has to say it with a bandwidth."""

NOT_ALIKE = (
    "The settings are not tuned alike: each controller runs at its author's or its example's settings, and "
    "none filters its rates. The poles of Table I (both forms of ADRC) have the geometric mean "
    f"{BANDWIDTH:.0f} rad/s, those of LESO are at {LESO_BANDWIDTH:.0f} rad/s, those of DOB at "
    f"{DOB_BANDWIDTH:.0f} rad/s; PD and CLF-QP have gains of their own. A difference between two rows is one "
    "between two settings; which law is the better one is not decided here."
)


def walked_again(controllers: Sequence[str]) -> list[str]:
    """Those of the controllers that have an observer."""
    return [c for c in controllers if c in OWN]


def equal_values(controller: str) -> dict[str, Any]:
    """Of a trial, beside what it has."""
    order = {"order": ORDER[controller]} if controller in ORDER else {}
    return {"bandwidth": BANDWIDTH, **order}


def equal_record(condition: str, controller: str, seed: int) -> dict[str, Any]:
    """The values of one trial."""
    return record(condition, controller, seed) | equal_values(controller)
