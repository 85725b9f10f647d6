"""The scenario of a walker that was made by hand, where a scenario can say all of it.

A session is a scenario and what was done, so a walker has to be one. What a scenario says is put down, built
again and compared with the walker, value by value.
"""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.tracking import Gains
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import Gait
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.parts import check_part
from biped_adrc.resources import packaged
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.walker_record import PartRecord, Writer, home_of
from biped_adrc.timing import SampledTime

PLAIN = ("torque_limit", "slope", "max_step_time", "runaway_speed", "runaway_torque")
"""Fields of a walker that a scenario has by the same name."""


def scenario_of(walker: Walker, gait: Gait) -> Scenario:
    """The scenario from which `scenario.build` makes this walker, on a stored gait.

    Raises InputError that names the parts of a walker that no scenario says.
    """
    check_part(walker, "what is to walk live", Walker)
    check_part(gait, "the gait of the walker", Gait)
    timing, controller = walker.timing, walker.controller
    if not isinstance(timing, SampledTime):
        raise InputError(
            "a live walk is controlled at sample instants; give the walker a timing, such as "
            "SampledTime(1e-3)"
        )
    plant = walker.plant
    values: dict[str, Any] = {name: getattr(walker, name) for name in PLAIN}
    values |= {"robot": plant.description.name, "preset": plant.preset, "gait": gait.name}
    values |= {name: getattr(timing, name) for name in ("period", "delay", "delay_known")}
    s = Scenario(controller=controller_name(controller), **values, **controller_values(controller))
    scene = RobotAndGait.of(s)
    made = build(s, scene)
    differs = [
        f.name for f in fields(Walker) if not same(*(getattr(w, f.name) for w in (walker, made)))
    ]
    if not same(gait.constraint, None if scene.gait is None else scene.gait.constraint):
        differs.append("gait")
    if differs:
        raise InputError(
            f"a scenario does not say all of this walker: {', '.join(differs)}; give a Scenario, which names "
            "parts of your own as module:Class"
        )
    return s


def controller_name(controller: object) -> str:
    """The first name of the registry for a controller's class, or module:Class."""
    home = home_of(type(controller))
    known = packaged("biped_adrc.scenario", "registry.toml")["controller"]
    return next((name for name, entry in known.items() if entry["home"] == home), home)


def controller_values(controller: object) -> dict[str, Any]:
    """What a scenario says of gains and observer of a controller, by name."""
    gains, observer = (getattr(controller, name, None) for name in ("gains", "observer"))
    found: dict[str, Any] = {}
    if isinstance(gains, Gains):
        found |= {"K_p": gains.K_p, "K_d": gains.K_d}
    if isinstance(observer, GPIObserver):
        found["poles"] = tuple(pole.real for pole in map(complex, observer.poles))
    if (reset := getattr(controller, "reset", None)) is not None:
        found["reset"] = reset.name.lower()
    if (solved := getattr(controller, "solve_theta", None)) is not None:
        found["solve_theta"] = solved
    return found


def same(one: object, other: object) -> bool:
    """Whether two parts have the same classes and values."""
    return written(one) == written(other)


def written(part: object) -> tuple[object, list[PartRecord]]:
    """A part as plain values."""
    writer = Writer()
    return writer.plain(part), writer.records
