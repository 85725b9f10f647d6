"""The observers of a comparison once more, all with the same bandwidth.

In the table each controller runs at its author's or its example's settings. Here all poles of every observer
lie at the geometric mean of Table I, so that what is left between two of them is not bandwidth.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.studies.bench.catalogue import DOB_BANDWIDTH, LESO_BANDWIDTH
from biped_adrc.studies.bench.conditions import record

BANDWIDTH = math.exp(sum(math.log(abs(p)) for p in TABLE_I) / len(TABLE_I))
"""Geometric mean of the poles of Table I [rad/s]."""
OWN = {"ADRC": BANDWIDTH, "LESO": LESO_BANDWIDTH, "DOB": DOB_BANDWIDTH}
"""The controllers, and the bandwidth of their own settings [rad/s]: of Table I the geometric mean."""
ORDER = {"ADRC": len(TABLE_I) - 2}
"""m of the observer, where the trial has to say it with a bandwidth."""
CONDITIONS = ("push on joints", "sine on joints", "delay")

NOT_ALIKE = (
    "The settings are not tuned alike: each controller runs at its author's or its example's settings, and "
    f"none filters its rates. The poles of Table I (ADRC) have the geometric mean {BANDWIDTH:.0f} rad/s, those "
    f"of LESO are at {LESO_BANDWIDTH:.0f} rad/s, those of DOB at {DOB_BANDWIDTH:.0f} rad/s; PD and CLF-QP have "
    "gains of their own. A difference between two rows is one between two settings; which law is the better "
    "one is not decided here."
)


def walked_again(controllers: Sequence[str], conditions: Sequence[str]) -> list[tuple[str, str]]:
    """Controller and condition of what is walked again: of those asked, with two observers at least."""
    who = [c for c in controllers if c in OWN]
    if len(who) < 2:
        return []
    return [(c, d) for c in who for d in conditions if d in CONDITIONS]


def equal_record(condition: str, controller: str, seed: int) -> dict[str, Any]:
    """The values of one trial."""
    found = record(condition, controller, seed) | {"bandwidth": BANDWIDTH}
    return found | ({"order": ORDER[controller]} if controller in ORDER else {})
