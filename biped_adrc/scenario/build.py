"""From a scenario to a walker: robot and model errors, controller, hardware, pushes, ground and start.

    RobotAndGait.of(s)   nominal robot, and gait (or the cycle of a robot without motors)
    build(s)             the `Walker`: plant, controller, disturbance, timing, sensors, motors, ground
    start(s, scene)      (q, v) at which the walk begins

The controller always has the nominal robot as its model; the plant differs from it where the scenario asks for
model errors. Called by `run`, by studies, and by worker processes, which receive the scenario alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeVar

import numpy as np

from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.stepping_plant import SteppingPlant
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.passive import Passive
from biped_adrc.errors import InputError
from biped_adrc.gait.constraint import continued
from biped_adrc.gait.gait import Gait, load_gait
from biped_adrc.gait.published import PassiveCycle, passive_cycle
from biped_adrc.ground import StepDown, StepUp, uneven_ground
from biped_adrc.hardware.motors import Motors
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hardware.sensors import Sensors
from biped_adrc.hardware.touchdown import Touchdown
from biped_adrc.model.biped import Biped
from biped_adrc.model.model_errors import ModelErrors, impact_error
from biped_adrc.robots.limits import Limits
from biped_adrc.scenario.controllers import controller
from biped_adrc.scenario.disturbances import disturbances, taken
from biped_adrc.scenario.registry import construct, find, own, takes
from biped_adrc.scenario.scenario import Scenario, drawn
from biped_adrc.soft.ground import SoftGround
from biped_adrc.soft.walking import stepping_loop
from biped_adrc.timing import ContinuousTime, SampledTime
from biped_adrc.types import Array, frozen

_T = TypeVar("_T")
WALKED = ("robot", "preset", "controller", "impacts", "slope", "friction_limit", "force_window")
RIGID = "rigid"
"""Name of the plant that is the walker's own."""
LONGEST_PLANT_STEP = 2e-4
"""Default step of an engine with soft ground, where the ground is soft enough [s]."""
RESOLVED = 0.1
"""Of the ground's time constant: the longest step that resolves contact."""
OF_GROUND = ("friction", "time_constant", "damping_ratio")
"""What soft ground takes from the scenario's fields."""
OF_WALKER = (
    *("biped", "slope", "h", "ground", "lag", "ground_steps", "first_step"),
    *("max_step_time", "fall_height", *OF_GROUND),
)
"""What a plant takes from the walker and the scenario's fields, and never from own values."""
WITHOUT_MOTORS = (*WALKED, "method", "h", "tolerance", "engine", "runaway_speed")
"""Fields of a scenario that have an effect for a robot without motors."""


@dataclass(frozen=True, eq=False)
class RobotAndGait:
    """The nominal robot of a scenario, and the gait that it walks or, without motors, its known cycle.

    Loading both takes longer than making a walker; studies of many walks of one robot make this once and hand
    it to `build` and `start`. It is equal to itself alone, so that what is made of it may be kept under it.
    """

    biped: Biped
    gait: Gait | None = None
    """None for a robot without motors."""
    cycle: PassiveCycle | None = None
    """None for a robot with motors."""

    @classmethod
    def of(cls, s: Scenario) -> RobotAndGait:
        """Robot and gait of a scenario, from files or from the user's own classes.

        Raises InputError for a robot or a gait that there is not, GaitError for a gait that does not fit.
        """
        made = own("robot", s.robot)
        values = {"preset": s.preset, "friction": s.friction}
        biped = (
            Biped.load(s.robot, s.preset, s.friction)
            if made is None
            else construct(f"robot '{s.robot}'", made, values, Biped)
        )
        if biped.p == 0:
            return cls(biped, cycle=passive_cycle(biped))
        found = own("gait", s.gait)
        gait = (
            load_gait(s.gait, biped)
            if found is None
            else construct(f"gait '{s.gait}'", found, {"biped": biped}, Gait).check(biped)
        )
        if s.continued:
            gait = replace(gait, constraint=continued(gait.constraint))
        return cls(biped, gait)

    @cached_property
    def on_orbit(self) -> tuple[Array, Array]:
        """(q, v), each (n,) [rad, rad/s], just after the impact of the gait's orbit, read-only.

        Raises InputError for a robot without motors.
        """
        return frozen(self.walked.start(self.biped))

    @property
    def walked(self) -> Gait:
        """The gait, where there has to be one. Raises InputError for a robot without motors."""
        if self.gait is None:
            raise InputError(
                f"robot '{self.biped.description.name}' has 0 motors and walks no gait; choose one with motors"
            )
        return self.gait


def build(s: Scenario, scene: RobotAndGait | None = None) -> Walker:
    """The walker of a scenario.

    The plant is the nominal robot with the scenario's model errors, the controller's model always the nominal
    one; the ground's slope is the gait's plus the scenario's. Sensors, motors and ground steps are None
    or empty where the scenario has none.

    scene: robot and gait where they are at hand. Raises InputError for what does not fit together.
    """
    scene = RobotAndGait.of(s) if scene is None else scene
    if scene.cycle is not None:
        return _passive(s, scene.biped, scene.cycle)
    biped, gait = scene.biped, scene.walked
    if s.controller == "passive":
        raise InputError(
            f"controller 'passive' does not fit robot '{s.robot}' with {biped.p} motors; choose another one, "
            "such as 'NPD'"
        )
    plant = plant_of(s, biped)
    gain = impact_error(drawn(s, "impact"), s.impact_error, biped.n if s.impact_error else 0)
    return Walker(
        plant,
        controller(s, gait, biped, taken(s) | taken_by_hardware(s) | taken_by_plant(s)),
        disturbances(s, biped, gait, plant),
        ContinuousTime()
        if s.period is None
        else SampledTime(s.period, s.touchdown is None, s.delay, s.delay_known),
        model=None if plant is biped else biped,
        torque_limit=s.torque_limit,
        max_step_time=s.max_step_time,
        slope=gait.slope + s.slope,
        ground_steps=ground(s),
        sensors=sensors(s),
        motors=Motors(s.rate_limit, s.lag) if s.rate_limit or s.lag else None,
        touchdown=touchdown(s, gait),
        impact_gain=tuple(gain.tolist()),
        runaway_speed=s.runaway_speed,
        runaway_torque=s.runaway_torque,
    )


def _passive(s: Scenario, biped: Biped, known: PassiveCycle) -> Walker:
    """The walker of a robot without motors, on the slope of its known cycle plus the scenario's [rad].

    Raises InputError for another controller than 'passive', and for values that have no effect without motors.
    """
    if s.controller != "passive":
        raise InputError(
            f"controller '{s.controller}' does not fit robot '{s.robot}' with 0 motors; choose 'passive'"
        )
    idle = [name for name in s.record() if name not in WITHOUT_MOTORS]
    if idle:
        raise InputError(
            f"robot '{s.robot}' has no motors, so it takes no {', '.join(idle)}; leave that out, or take a "
            "robot with motors ('biped-adrc robot list')"
        )
    return Walker(
        biped,
        Passive(),
        slope=known.slope + s.slope,
        max_step_time=known.max_step_time,
        runaway_speed=s.runaway_speed,
    )


def limits(s: Scenario) -> Limits:
    """Limits of ground and motors within which the walk is feasible; the torque limit is the robot's own."""
    return Limits(s.friction_limit, None, s.force_window)


def start(s: Scenario, scene: RobotAndGait) -> tuple[Array, Array]:
    """(q, v), each (n,) [rad, rad/s], just after the impact of the gait's orbit, with the scenario's offsets.

    First random offsets of every coordinate, then the rates scaled by start_speed, then the values of
    `Scenario.start`. Raises InputError for a coordinate that the robot does not have.
    """
    q, v = scene.on_orbit
    random = np.random.default_rng(drawn(s, "start"))
    q = q + s.start_spread * random.standard_normal(len(q))
    v = v + s.start_rate_spread * random.standard_normal(len(v))
    v = v * (1.0 + s.start_speed + s.start_speed_spread * random.standard_normal())
    for name, added in s.start.items():
        place = int(name[1:]) - 1
        if not 0 <= place < len(q):
            raise InputError(
                f"start names '{name}', but robot '{s.robot}' has the coordinates 1 to {len(q)}"
            )
        (q if name[0] == "q" else v)[place] += added
    return q, v


def plant_of(s: Scenario, biped: Biped) -> Biped:
    """The robot that walks: the nominal one with the scenario's model errors, itself where there are none.

    In this order: factors of mass and inertia by link, a load on the trunk, and errors that are drawn with the
    widths mass_error, com_error, inertia_error and friction_error. That it is the same object where there are
    none tells `build` that plant and model agree.
    """
    plant = biped
    if s.mass or s.inertia:
        plant = plant.with_errors(mass=s.mass, inertia=s.inertia)
    if s.trunk_load != 0.0:
        plant = ModelErrors(mass={biped.description.trunk: s.trunk_load}).apply(plant)
    widths = (s.mass_error, s.com_error, s.inertia_error, s.friction_error)
    if any(widths):
        plant = ModelErrors.drawn(plant, drawn(s, "model"), *widths).apply(plant)
    return plant


def sensors(s: Scenario) -> Sensor | None:
    """The sensors of a scenario: encoders, then the one that is named; None where all is measured exactly."""
    encoders = _encoders(s)
    if s.sensor is None:
        return encoders
    named = _named("sensor", s, {}, Sensor)
    return named if encoders is None else encoders + named


def _encoders(s: Scenario) -> Sensors | None:
    """Encoders with their noise; None where angles and rates are measured exactly.

    Exact means: no encoder counts, rates that are measured, and no noise. Noise has its own stream of random
    numbers.
    """
    exact = s.counts is None and s.velocity == "measured"
    if exact and s.noise == s.pitch_noise == s.rate_noise == 0.0:
        return None
    noise = (s.noise, s.pitch_noise, s.rate_noise)
    return Sensors(s.counts, None, *noise, s.velocity, s.filter_time, drawn(s, "sensors"))


def touchdown(s: Scenario, gait: Gait) -> Touchdown | None:
    """How the controller of a scenario is told of touchdowns; None for at once.

    The slope that it takes is the gait's: what the scenario adds it does not know.
    """
    if s.touchdown is None:
        return None
    return _named("touchdown", s, {"slope": gait.slope}, Touchdown)  # type: ignore[type-abstract]


def _named(kind: str, s: Scenario, known: Mapping[str, object], base: type[_T]) -> _T:
    """The sensor or touchdown that a scenario names, of its own values and of what is known here.

    The kind before the name of an own value says that it is this part's: sensor_noise, where noise is the
    encoders', and touchdown_delay, where delay is the clock's. What has it goes before what has not.
    """
    name, prefix = getattr(s, kind), f"{kind}_"
    entry = find(kind, name)
    mine = {x.removeprefix(prefix): y for x, y in s.own.items() if x.startswith(prefix)}
    given = {**known, **s.own, **mine, "seed": drawn(s, kind), **entry.defaults}
    return construct(f"{kind} '{name}'", entry.load(), given, base)


def taken_by_hardware(s: Scenario) -> set[str]:
    """Names of own values that sensor and touchdown take, with and without their prefix."""
    taken = set[str]()
    for kind, name in (("sensor", s.sensor), ("touchdown", s.touchdown)):
        if name is not None:
            names = set(takes(find(kind, name).load())) - {"seed"}
            taken |= names | {f"{kind}_{each}" for each in names}
    return taken


def plant_step(s: Scenario) -> float:
    """Step of the engine of another plant than the rigid one [s]; by default contact is resolved."""
    if s.plant_step is not None:
        return s.plant_step
    return min(LONGEST_PLANT_STEP, RESOLVED * s.time_constant)


def plant_around(name: str, walker: Walker, given: Mapping[str, object]) -> SteppingPlant:
    """A plant of the registry for a walker's robot on its slope. given: more values by name.

    Raises InputError for one that there is not, or that cannot be made.
    """
    values = {
        "biped": walker.plant,
        "slope": walker.slope,
        "max_step_time": walker.max_step_time,
        "fall_height": walker.fall_height,
    }
    what, entry = f"plant '{name}'", find("plant", name)
    return construct(what, entry.load(), {**given, **values}, SteppingPlant)  # type: ignore[type-abstract]


def soft_loop(s: Scenario, walker: Walker) -> SteppingLoop | None:
    """The walker's controller around the plant of a scenario; None for the rigid one.

    The plant is made with those of the walker's and the scenario's values that its constructor takes. Raises
    InputError for one that cannot be made.
    """
    if s.plant == RIGID:
        return None
    numbers = (s.ground_friction, s.time_constant, s.damping_ratio)
    given = s.own | dict(zip(OF_GROUND, numbers, strict=True))
    ground = construct(f"the ground of plant '{s.plant}'", SoftGround, given, SoftGround)
    plant = plant_around(s.plant, walker, s.own | {"ground": ground, "h": plant_step(s)})
    return stepping_loop(walker, plant, s.engine, s.first_step)


def taken_by_plant(s: Scenario) -> set[str]:
    """Names of own values that the plant or its ground takes."""
    if s.plant == RIGID:
        return set()
    return {*takes(find("plant", s.plant).load()), *takes(SoftGround)} - set(OF_WALKER)


def ground(s: Scenario) -> tuple[StepDown | StepUp, ...]:
    """Changes of the ground's height: uneven ground, and a step down (or up) at `pushed_step`; () if level.

    `ground_rms`: random heights [m], drawn for all steps of the walk. `ground_step`: depth [m], negative for a
    step up.
    """
    steps: tuple[StepDown | StepUp, ...] = ()
    if s.ground_rms > 0.0:
        last = s.first_step + s.impacts - 1
        steps = uneven_ground(drawn(s, "ground"), s.ground_rms, last)
    if s.ground_step > 0.0:
        steps = (*steps, StepDown(s.pushed_step, s.ground_step))
    elif s.ground_step < 0.0:
        steps = (*steps, StepUp(s.pushed_step, -s.ground_step))
    return steps
