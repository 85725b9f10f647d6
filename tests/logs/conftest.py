"""Walks whose logs are replayed, made once."""

from __future__ import annotations

from functools import cache

import pytest

import biped_adrc as ba
from biped_adrc.extras.logs.robot_log import logged

PULSE = "q1,q2=20@2:0.1-0.3"
"""20 N m on both hips, in the second single support."""


@cache
def walk_of(**values):
    """A walk of three steps under the pulse."""
    values = {"controller.name": "NPD", "run.impacts": 3, "pushes": PULSE, **values}
    return ba.walk_scenario(ba.Scenario(**values))


@pytest.fixture(scope="session")
def walked():
    """The function `walk_of`: the walk of these values of a scenario, simulated once."""
    return walk_of


@pytest.fixture(scope="session")
def log(walked):
    """The log of a walk with exact angles and rates, at 1 kHz."""
    return logged(walked(hardware="ideal"))
