"""The pushes of a scenario as one disturbance: torques on joints, forces on a link or at the hip, added up."""

from __future__ import annotations

import math
from typing import Any, cast

import numpy as np

from biped_adrc.core.types import Array
from biped_adrc.disturbances.base import Disturbance, Sum, Windowed
from biped_adrc.disturbances.force import OnLink
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.push import RANDOM, Push
from biped_adrc.scenario.records import Misfit, all_taken
from biped_adrc.scenario.registry import construct, find, takes
from biped_adrc.scenario.scenario import Scenario, drawn


def disturbances(s: Scenario, biped: Biped, period: float, plant: Biped) -> Disturbance | None:
    """The sum of all pushes of a scenario; None without any.

    biped: the nominal robot, for its joints. period [s]: of the gait. plant: the robot that walks, for forces
    on its links. Raises InputError for a push that does not fit.
    """
    parts = tuple(disturbance(s, i, biped, period, plant) for i in range(len(s.pushes)))
    return Sum(parts) if len(parts) > 1 else parts[0] if parts else None


def disturbance(s: Scenario, i: int, biped: Biped, period: float, plant: Biped) -> Disturbance:
    """Push number i. Raises InputError for a value that its shape does not take."""
    push = s.pushes[i]
    entry, what = find("disturbance", push.shape), f"disturbance '{push.shape}'"
    make = entry.load()
    accepted = takes(make)
    along = push.force * np.array((math.cos(push.direction), math.sin(push.direction), 0.0))
    on_link = push.link is not None
    amplitude = along if on_link else torques(s, i, biped)
    _check_taken(i, push, set(accepted))
    values: dict[str, Any] = {**push.own, **window(s, i, period), "rise": push.rise}
    values |= {"force": tuple(along[:2].tolist()), "amplitude": amplitude, "biped": plant}
    values |= entry.defaults
    made = construct(what, make, values, Disturbance, f"pushes.{i}")  # type: ignore[type-abstract]
    return made if push.link is None else OnLink(plant, push.link, cast(Windowed, made))


def _check_taken(i: int, push: Push, accepted: set[str]) -> None:
    """Raise Misfit for a value that has no effect on this shape."""
    forced = push.link is not None or "force" in accepted
    idle = {
        "force": not forced and "is a torque; name the link on which a force acts",
        "torque": "amplitude" not in accepted and "takes no torque",
        "rise": "rise" not in accepted and "has no edges; only a pulse has a rise",
    }
    for name, why in idle.items():
        if why and getattr(push, name):
            raise Misfit(f"pushes.{i}.{name}", f"the push '{push.shape}' {why}")
    all_taken(f"pushes.{i}", push.own, {*accepted, *Push.model_fields})


def window(s: Scenario, i: int, period: float) -> dict[str, Any]:
    """When push i acts: step number, start and stop [s], frequency [Hz] and the seed of noise.

    A push counts from the start of its single support and ends with it at the latest; one that goes on over
    impacts counts from the time at which the gait, of this period [s], would begin that single support. An
    onset that is not given is drawn so that the push fits into the period.
    """
    push = s.pushes[i]
    begin = push.onset
    if begin is None:
        last = max(period - push.duration, 0.0)
        begin = float(np.random.default_rng(drawn(s, "onset", i)).uniform(0.0, last))
    over = push.over_impacts
    late = (push.step - s.run.first_step) * period if over else 0.0
    return {
        "step": None if over else push.step,
        "start": late + begin,
        "stop": late + push.stop(begin),
        "frequency": push.frequency,
        "bandwidth": push.frequency,
        "seed": drawn(s, "noise", i),
    }


def torques(s: Scenario, i: int, biped: Biped) -> Array:
    """Torques (n,) [N m] of push i on the coordinates.

    Raises InputError for a joint that there is not.
    """
    push, zeta = s.pushes[i], np.zeros(biped.n)
    if push.joints == RANDOM and not isinstance(push.torque, dict):
        random = np.random.default_rng(drawn(s, "joints", i))
        zeta[: biped.p] = push.torque * random.uniform(-1.0, 1.0, biped.p)
        return zeta
    for joint, torque in push.factors.items():
        zeta[biped.description.joint_index(joint)] += torque
    return zeta
