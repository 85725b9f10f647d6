"""The pushes of a scenario made into one disturbance: torques on joints, forces on a link or at the hip.

A scenario has two ways to push: `pushes`, a list of `Push` with their own windows (the paper's), and the single
push of the fields `push`, `on`, `amplitude`, `force`, ..., whose kind is a name of the registry and whose onset
may be drawn (studies). `build.build` calls `disturbances`; disturbances of several pushes are added up.

Where the single push acts is the text `Scenario.on`:

    q1,-q2          these coordinates, the second one with the other sign (a torque)
    random joints   all driven joints, with factors drawn from -1 to 1 (a torque)
    link torso      the origin of a link, along `direction` (a force)

A disturbance class that takes `force` is given (F_x, F_z) [N] as well, whatever `on` says.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import cast

import numpy as np

from biped_adrc.disturbances.base import Disturbance, Sum, Windowed
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
"""Arguments of a disturbance that come from the scenario's fields, never from own values."""


def disturbances(s: Scenario, biped: Biped, gait: Gait, plant: Biped) -> Disturbance | None:
    """The sum of all pushes of a scenario; None without any.

    biped: the nominal robot, for its joints. plant: the robot that walks, for forces on its links. Raises
    InputError for a push that does not fit.
    """
    one = push(s, biped, gait, plant)
    parts = [*(push.disturbance(biped) for push in s.pushes), *((one,) if one else ())]
    if one is not None and len(parts) == 1:
        return one
    return Sum(tuple(parts)) if parts else None


def push(s: Scenario, biped: Biped, gait: Gait, plant: Biped) -> Disturbance | None:
    """The disturbance of the fields `push`, `on`, `amplitude`, `force` and so on; None for push = "none".

    On joints it is a torque of `amplitude` [N m], on a link or at the hip a force of `force` [N] along
    `direction` [rad]. Raises InputError for a value that would have no effect, or a force where a torque is
    meant.
    """
    if s.push == "none":
        return None
    along = np.array((math.cos(s.direction), math.sin(s.direction), 0.0))
    kind, _, link = s.on.partition(" ")
    values = {**s.own, **window(s, gait), "force": tuple((s.force * along)[:2].tolist())}
    on_link, accepted = kind == "link", takes(find("disturbance", s.push).load())
    forced = on_link or "force" in accepted
    shaped = on_link or "amplitude" in accepted
    idle = {
        "direction": not forced,
        "amplitude": not (forced or shaped),
        "on": not (forced or shaped),
        "duration": "stop" not in accepted,
        "frequency": not {"frequency", "bandwidth"} & set(accepted),
    }
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


def window(s: Scenario, gait: Gait) -> dict[str, object]:
    """When a push acts: step number, start and stop [s], frequency [Hz] and the seed of noise.

    A pulse counts from the start of its single support and ends with it at the latest; kinds that go on over
    impacts (`Entry.over_steps`) count from the time at which the nominal gait would begin `pushed_step`. An
    onset that is not given is drawn so that the push fits into the gait's period.
    """
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
    """Factors (n,) by which the amplitude [N m] acts on the coordinates, from `Scenario.on`.

    "q1,-q2": plus and minus one on these; "random joints": drawn from -1 to 1 on all driven joints. Raises
    InputError for a joint that there is not, and for torques that cancel.
    """
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
    kind: str, biped: Biped, torque: Mapping[str, float], values: Mapping[str, object]
) -> Disturbance:
    """A disturbance of a kind of the registry with a torque [N m] by joint.

    values: its other arguments by name. Raises InputError, also for a joint that there is not.
    """
    amplitude = np.zeros(biped.n)
    for joint, value in torque.items():
        amplitude[biped.description.joint_index(joint)] += value
    return disturbance(kind, biped, amplitude, values)


def disturbance(
    kind: str, biped: Biped, amplitude: Array, values: Mapping[str, object], link: str = ""
) -> Disturbance:
    """A disturbance of the registry, or of the user's own, made from those of the values that it takes.

    amplitude: (n,) [N m] on the coordinates, or (3,) [N] of a force on `link`. Raises InputError.
    """
    entry = find("disturbance", kind)
    make = entry.load()
    values = {**values, "amplitude": amplitude, "biped": biped, **entry.defaults}
    if values.get("rise") and "rise" not in takes(make):
        raise InputError(f"a push of kind '{kind}' has no rise; only a pulse has one")
    made = construct(f"disturbance '{kind}'", make, values, Disturbance)  # type: ignore[type-abstract]
    return OnLink(biped, link, cast(Windowed, made)) if link else made


def taken(s: Scenario) -> set[str]:
    """Names of own values that the push takes; arguments that come from the scenario's fields are not among
    them.
    """
    if s.push == "none":
        return set()
    return set(takes(find("disturbance", s.push).load())) - BY_ITSELF
