"""What a study knows of a scenario: its values by dotted name, as a study file has them and as they are read.

hardware.period               "1.5 ms"    0.0015    [s]
controller.observer.order     1           1
hardware.torque_limit         "none"      None      no limit
start.v5                      0.1         0.1       [rad/s]
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from biped_adrc.scenario.scenario import Scenario

Values = Mapping[str, Any]
"""Values of a scenario by dotted name, in SI units."""
Record = Mapping[str, object]
"""The values of one walk as JSON has them: what a worker receives."""

REFUSED, RAISED, CRASHED = "REFUSED", "RAISED", "CRASHED"
"""Statuses that are no result of a walk: its values do not fit together, its function raised, its worker
died."""
NO_WALK = (REFUSED, RAISED, CRASHED)
"""All of them; such rows count neither as a success nor as a fall."""
SEED, PLANT = "run.seed", "ground.plant"
"""Names of values that a study treats apart."""
SUFFIXES = {"robot.name": ".toml", "gait.name": ".json"}
"""By value, the suffix of a file in place of a registered name."""


def scenario_of(values: Record) -> Scenario:
    """The scenario of values by name; where they say nothing of sampling, it is sampled at 1 kHz, ideally.

    A row counts at sample instants, so each walk needs some. Raises InputError for values that do not fit
    together.
    """
    return Scenario(**{"hardware.profile": "ideal", **values})
