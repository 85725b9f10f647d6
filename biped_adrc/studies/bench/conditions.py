"""What walks are disturbed with in a comparison: named values of a trial, on top of a base.

The base is a sampled controller with exact sensors and RABBIT's 150 N m; every walk starts a little off the
gait's speed, by its seed. What is random in a condition is drawn anew for every seed, and is the same for all
controllers. Each controller runs at its author's or its example's settings, and those with an observer once
more with all poles at the geometric mean of Table I, so that what is left between two of them is not bandwidth.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.scenario.registry import find


@dataclass(frozen=True)
class Condition:
    """words: for a reader. values: of a scenario."""

    words: str
    values: Mapping[str, Any]


BASE: Mapping[str, Any] = {
    "impacts": 25,
    "period": 1e-3,
    "torque_limit": 150.0,
    "start_speed_spread": 0.02,
}
JOINTS = "q1,q2,q3,q4"
AFTERWARDS = 3
"""Single support in which pulses come."""

COMPARED = ("PD", "NPD", "ADRC", "ADRC output", "LESO", "DOB", "CLF-QP")
"""Controllers, in the order of the tables."""
CONDITIONS: dict[str, Condition] = {
    "nothing": Condition(
        "a start 2 % (rms) faster or slower than the gait, as everywhere below", {}
    ),
    "push on joints": Condition(
        "up to 100 N m on each joint for 0.2 s in step 3, signs and onset drawn",
        {"push": "pulse", "on": "random joints", "amplitude": 100.0, "pushed_step": AFTERWARDS},
    ),
    "sine on joints": Condition(
        "20 N m at 5 Hz on q1 to q4, all the way",
        {
            "push": "sine",
            "on": JOINTS,
            "amplitude": 20.0,
            "pushed_step": 1,
            "onset": 0.0,
            "duration": 60.0,
        },
    ),
    "noise on joints": Condition(
        "15 N m (rms) up to 15 Hz on q1 to q4, all the way",
        {
            "push": "noise",
            "on": JOINTS,
            "amplitude": 15.0,
            "pushed_step": 1,
            "onset": 0.0,
            "duration": 60.0,
            "frequency": 15.0,
        },
    ),
    "push on the torso": Condition(
        "30 N m on the unactuated torso for 0.2 s in step 3, onset drawn: unmatched",
        {"push": "pulse", "on": "q5", "amplitude": 30.0, "pushed_step": AFTERWARDS},
    ),
    "pull at the torso": Condition(
        "3 N backwards on the torso for good from step 3: unmatched",
        {
            "push": "step",
            "on": "link torso",
            "force": 3.0,
            "direction": math.pi,
            "pushed_step": AFTERWARDS,
            "onset": 0.0,
        },
    ),
    "wrong model": Condition(
        "masses and inertias off by up to 20 %, centres of mass by 10 %",
        {"mass_error": 0.2, "inertia_error": 0.2, "com_error": 0.1},
    ),
    "wrong impact": Condition(
        "every rate after an impact off by up to 5 %", {"impact_error": 0.05}
    ),
    "uneven ground": Condition("footholds 3 mm (rms) up and down", {"ground_rms": 3e-3}),
    "delay": Condition("torques act 2 ms late, unknown to the controller", {"delay": 2e-3}),
    "encoders": Condition(
        "8192 counts per revolution, rates from differences, every 1 ms",
        {"counts": 8192.0, "velocity": "differences"},
    ),
    "RABBIT": Condition(
        "the robot's own: every 1.5 ms, 8192 counts, joint friction that no model has",
        {"hardware": "rabbit", "period": 1.5e-3},
    ),
}
"""By name, in the order of the table."""


def record(
    condition: str, controller: str, seed: int, base: Mapping[str, Any] = BASE
) -> dict[str, Any]:
    """The values of one trial."""
    values = CONDITIONS[condition].values
    return {**base, **values, "controller": controller, "seed": seed}


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
