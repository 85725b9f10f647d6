"""The pushes of a scenario made into disturbances: on joints, on a link or on the hip."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from biped_adrc.disturbances.base import Disturbance, Sum
from biped_adrc.disturbances.link import OnLink
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import Gait
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.registry import construct, find, takes
from biped_adrc.scenario.scenario import DEFAULTS, Scenario, drawn
from biped_adrc.types import Array

BY_ITSELF = {
    "step",
    "start",
    "stop",
    "frequency",
    "bandwidth",
    "seed",
    "force",
    "amplitude",
    "biped",
}
"""What a disturbance has from the scenario, never from own values."""


def disturbances(s: Scenario, biped: Biped, gait: Gait, plant: Biped) -> Disturbance | None:
    """All pushes, on joints, on a link or on the hip; None without."""
    one = push(s, biped, gait, plant)
    parts = [*(push.disturbance(biped) for push in s.pushes), *((one,) if one else ())]
    if one is not None and len(parts) == 1:
        return one
    return Sum(tuple(parts)) if parts else None


def push(s: Scenario, biped: Biped, gait: Gait, plant: Biped) -> Disturbance | None:
    """The one of the values `push`, `on`, `amplitude` and so on."""
    if s.push == "none":
        return None
    along = np.array((math.cos(s.direction), math.sin(s.direction), 0.0))
    kind, _, link = s.on.partition(" ")
    values = {**s.own, **window(s, gait), "force": tuple((s.force * along)[:2].tolist())}
    on_link, accepted = kind == "link", takes(find("disturbance", s.push).load())
    forced = on_link or "force" in accepted
    idle = {"direction": not forced, "frequency": not {"frequency", "bandwidth"} & set(accepted)}
    if given := [name for name in idle if idle[name] and getattr(s, name) != DEFAULTS[name]]:
        raise InputError(
            f"the push '{s.push}' on '{s.on}' takes no {given[0]}: this would do nothing, leave it out"
        )
    if forced and s.amplitude > 0.0:
        raise InputError(
            f"the push '{s.push}' on '{s.on}' is a force [N], and an amplitude is given"
        )
    if s.force > 0.0 and not forced:
        raise InputError(
            f"the push on '{s.on}' is a torque [N m], and a force is given; write on = 'link NAME'"
        )
    if on_link:
        return disturbance(s.push, plant, s.force * along, values, link)
    return disturbance(s.push, plant, s.amplitude * pattern(s, biped), values)


def window(s: Scenario, gait: Gait) -> dict[str, Any]:
    """When a push acts: within its step, or `over_steps` from the time at which the gait would be there."""
    begin = s.onset
    if begin is None:
        last = max(gait.period - s.duration, 0.0)
        begin = float(np.random.default_rng(drawn(s, "onset")).uniform(0.0, last))
    over = find("disturbance", s.push).over_steps
    late = (s.pushed_step - s.first_step) * gait.period if over else 0.0
    return {
        "step": None if over else s.pushed_step,
        "start": late + begin,
        "stop": late + (begin + s.duration),
        "frequency": s.frequency,
        "bandwidth": s.frequency,
        "seed": drawn(s, "noise"),
    }


def pattern(s: Scenario, biped: Biped) -> Array:
    """Factors (n,) of the amplitude on the joints."""
    factors = np.zeros(biped.n)
    if s.on == "random joints":
        random = np.random.default_rng(drawn(s, "joints"))
        factors[: biped.p] = random.uniform(-1.0, 1.0, biped.p)
        return factors
    for name in s.on.split(","):
        joint = name.strip()
        sign = -1.0 if joint.startswith("-") else 1.0
        factors[biped.description.joint_index(joint.lstrip("+-"))] += sign
    if not factors.any():
        raise InputError(f"the torques of the push on '{s.on}' cancel; leave one of them out")
    return factors


def on_joints(
    kind: str, biped: Biped, torque: Mapping[str, float], values: Mapping[str, Any]
) -> Disturbance:
    """A disturbance with a torque [N m] by joint. Raises InputError, also for a joint that there is not."""
    amplitude = np.zeros(biped.n)
    for joint, value in torque.items():
        amplitude[biped.description.joint_index(joint)] += value
    return disturbance(kind, biped, amplitude, values)


def disturbance(
    kind: str, biped: Biped, amplitude: Array, values: Mapping[str, Any], link: str = ""
) -> Disturbance:
    """A disturbance of the registry, or of one's own, made from those of the values that it takes.

    amplitude: (n,) [N m] on the coordinates, or (3,) of a force on `link`. Raises InputError.
    """
    entry = find("disturbance", kind)
    make = entry.load()
    values = {**values, "amplitude": amplitude, "biped": biped, **entry.defaults}
    if values.get("rise") and "rise" not in takes(make):
        raise InputError(f"a push of kind '{kind}' has no rise; only a pulse has one")
    made = construct(f"disturbance '{kind}'", make, values, Disturbance)
    return OnLink(biped, link, made) if link else made


def taken(s: Scenario) -> set[str]:
    """Names that the push takes among own values; what the scenario says of a push is none of them."""
    if s.push == "none":
        return set()
    return set(takes(find("disturbance", s.push).load())) - BY_ITSELF
