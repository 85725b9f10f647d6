"""From a scenario to a walker: robot and model errors, controller, hardware, pushes, ground and start.

    RobotAndGait.of(s)   nominal robot, and gait (or the cycle of a robot without motors)
    build(s)             the `Walker`: plant, controller, disturbance, timing, sensors, motors, ground
    scene.start(s)       (q, v) at which the walk begins

The controller always has the nominal robot as its model; the plant, the robot that walks, differs from it where
the scenario asks for model errors. A `scene` is a `RobotAndGait`; `drawn(s, what)` is a seed for one random
thing of the scenario. The registry (`core.registry`) finds a class by kind and name, such as "controller" and
"ADRC"; `takes` are the parameters of its constructor, `own` of a record those values that only it knows, and
`named_part` calls it with those values known here, and own ones, that it takes. q, v (n,) [rad, rad/s] are
coordinates and rates, the first p of them of joints with motors. Called by `walk`, by studies, and by worker
processes, which receive the scenario alone.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any, Self, cast

import numpy as np

from biped_adrc.closed_loop.protocols import SteppingPlant
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.base import Controller, Passive
from biped_adrc.core.errors import InputError
from biped_adrc.core.part import Memory, constant
from biped_adrc.core.registry import construct, find, part_of_user, takes
from biped_adrc.core.timing import ContinuousTime, SampledTime
from biped_adrc.core.types import Array, frozen
from biped_adrc.disturbances.base import Disturbance, Sum, Windowed
from biped_adrc.disturbances.force import OnLink
from biped_adrc.engine.on_plant import fastest_loop
from biped_adrc.gait.constraint import continued
from biped_adrc.gait.gait import Gait, load_gait
from biped_adrc.gait.published import PassiveCycle, passive_cycle
from biped_adrc.hardware.motors import Motors
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hardware.sensors import Sensors
from biped_adrc.hardware.touchdown import Touchdown
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import Limits, SoftGround, Steps, Stones, stepped, uneven_ground
from biped_adrc.model.model_errors import ModelErrors, impact_error
from biped_adrc.scenario.controllers import controller
from biped_adrc.scenario.push import RANDOM, Push
from biped_adrc.scenario.records import Misfit, all_taken, named_part
from biped_adrc.scenario.scenario import Scenario, drawn

RIGID = "rigid"
"""Name of a walker's own plant: the stance foot is pinned, impacts are plastic and take no time."""
# makers of clocks and motors: walks of a study share equal ones, so that they are compared by identity
_clock, _motors = lru_cache(maxsize=64)(SampledTime), lru_cache(maxsize=64)(Motors)


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
    laws: Memory = field(default_factory=Memory, repr=False)
    """Controllers that were made already, by the values of the scenario that decide them."""
    plants: Memory = field(default_factory=Memory, repr=False)
    """Robots with model errors that were made already: the candidates of a search walk the same ones."""

    @classmethod
    def of(cls, s: Scenario) -> Self:
        """Robot and gait of a scenario, from files or from the user's own classes.

        Raises InputError for a robot or a gait that there is not, GaitError for a gait that does not fit or,
        unless the scenario allows that, was made for another robot.
        """
        robot, friction, name = s.robot, s.hardware.friction, s.gait.name
        values = {"preset": robot.preset, "friction": friction}
        # part_of_user is None for a name that is no class of the user's: then a file of this package has it
        biped = part_of_user("robot", robot.name, values, Biped)
        biped = biped or Biped.load(robot.name, robot.preset, friction)
        if biped.p == 0:
            return cls(biped, cycle=passive_cycle(biped))
        gait = part_of_user("gait", name, {"biped": biped}, Gait)
        # True loads a gait that was made for another robot too; `check_robot` refuses it below, for gaits from
        # files and from the user's classes alike
        gait = load_gait(name, biped, True) if gait is None else gait.check(biped)
        gait = gait if s.gait.other_robot else gait.check_robot(biped)
        if s.gait.continued:  # the curve of the gait goes on smoothly past both ends
            gait = replace(gait, constraint=continued(gait.constraint))
        return cls(biped, gait)

    @cached_property
    def on_orbit(self) -> tuple[Array, Array]:
        """(q, v), each (n,) [rad, rad/s], just after the impact of the gait's orbit, read-only.

        Raises InputError for a robot without motors.
        """
        return frozen(self.walked.start(self.biped))

    def start(self, s: Scenario) -> tuple[Array, Array]:
        """(q, v), each (n,) [rad, rad/s], just after the impact of the gait's orbit, with a scenario's offsets.

        A robot without motors starts after the impact of its cycle on this ground's slope, which Newton's
        method finds. Else offsets are added in this order: random ones of every coordinate, the rates scaled by
        `speed`, those of single coordinates. Raises InputError for a coordinate that the robot does not have.
        """
        if self.cycle is not None:
            from biped_adrc.analysis.stability import cycle_start

            return cycle_start(self.biped, self.slope(s))
        (q, v), x, factor = (y.copy() for y in self.on_orbit), s.start, 1.0 + s.start.speed
        if x.spread or x.rate_spread or x.speed_spread:
            random = np.random.default_rng(drawn(s, "start"))
            q += x.spread * random.standard_normal(len(q))
            v += x.rate_spread * random.standard_normal(len(v))
            factor += x.speed_spread * random.standard_normal()
        v *= factor
        for name, added in x.own.items():
            place = int(name[1:]) - 1  # "q5" or "v5" is entry 4
            if not 0 <= place < len(q):
                raise InputError(f"start.{name}: '{s.robot.name}' has coordinates 1 to {len(q)}")
            (q if name[0] == "q" else v)[place] += added
        return q, v

    def slope(self, s: Scenario) -> float:
        """The slope of a scenario's ground [rad], positive downhill: its own, or where it says none that of the
        gait or cycle.
        """
        own = s.ground.slope
        return (self.cycle or self.walked).slope if own is None else own

    def controller(self, s: Scenario, stones: tuple[float, ...] = ()) -> Controller:
        """The controller of a scenario; walks of equal records share it, where nothing in it can change.

        stones: lengths [m] of the walking steps that lead from stone to stone; () without stones.
        """
        # all that the controller depends on beside robot and gait
        key = s.controller.model_dump_json(), s.hardware.torque_limit, stones
        law = self.laws.get(key) or controller(s, self.walked, self.biped, stones)
        if constant(law):  # one of the user's classes may change, and is made anew for each walk
            self.laws.keep(key, law)
        return law

    @property
    def walked(self) -> Gait:
        """The gait of a robot with motors. Raises InputError for a robot without motors, which has none."""
        if self.gait is None:
            raise InputError(f"robot '{self.biped.description.name}' has 0 motors, so no gait")
        return self.gait


def build(s: Scenario, scene: RobotAndGait | None = None) -> Walker:
    """The walker of a scenario: plant, controller, hardware, pushes and ground.

    The plant is the nominal robot with the scenario's model errors, the controller's model always the nominal
    one. Sensors, motors and ground steps are None or empty where the scenario has none.

    scene: robot and gait of the scenario; None: they are loaded. Raises InputError for what does not fit
    together.
    """
    scene = RobotAndGait.of(s) if scene is None else scene
    biped, name = scene.biped, s.controller.name
    if (name == "passive") != (biped.p == 0):
        raise InputError(
            f"'{name}' does not fit robot '{s.robot.name}' with {biped.p} motors; 'passive' is for 0 motors"
        )
    if scene.cycle is not None:
        return _passive(s, scene, scene.cycle)
    gait = scene.walked
    key = s.errors.model_dump_json(), drawn(s, "model")
    plant = scene.plants.found(key, lambda: plant_of(s, biped))
    width, h = s.errors.impact_width, s.hardware
    # relative errors (n,) [1] of the rates after impact; () without an error of the impact map
    gain = impact_error(drawn(s, "impact"), width, biped.n).tolist() if width else ()
    course = stones(s)
    # a clock restarts at impact only if the controller knows the impact at once, without a detector
    period, restart = h.period, h.touchdown.name is None
    return Walker(
        plant,
        scene.controller(s, course.lengths if course else ()),
        disturbances(s, biped, gait.period, plant),
        _clock(period, restart, h.delay, h.delay_known) if period is not None else ContinuousTime(),
        model=None if plant is biped else biped,
        torque_limit=h.torque_limit,
        max_step_time=s.run.max_step_time,
        slope=scene.slope(s),
        ground_steps=_ground(s),
        sensors=sensors(s),
        motors=_motors(h.rate_limit, h.lag) if h.rate_limit or h.lag else None,
        touchdown=_touchdown(s, gait),
        impact_gain=tuple(gain),
        stones=course,
        runaway_speed=s.run.runaway_speed,
        runaway_torque=s.run.runaway_torque,
    )


def _passive(s: Scenario, scene: RobotAndGait, known: PassiveCycle) -> Walker:
    """The walker of a robot without motors, whose longest single support is that of its `known` cycle.

    Raises InputError for values that have no effect without motors.
    """
    # beginnings of the names of values that have an effect here
    effective = ("robot", "controller.name", "run", "limits", "ground.slope")
    for name in s.dotted():
        if not name.startswith(effective):
            raise InputError(f"robot '{s.robot.name}' has no motors, so no {name}; leave it out")
    time = s.run.max_step_time if "run.max_step_time" in s.dotted() else known.max_step_time
    slope, speed = scene.slope(s), s.run.runaway_speed
    return Walker(scene.biped, Passive(), slope=slope, max_step_time=time, runaway_speed=speed)


def limits(s: Scenario) -> Limits:
    """Limits of ground and motors within which the walk is feasible: friction, torque, and the time over which
    the force of the ground is averaged. None, as for the torque, takes the value of the robot's record.
    """
    return Limits(s.limits.friction, None, s.limits.window)


def plant_of(s: Scenario, biped: Biped) -> Biped:
    """The robot that walks (the plant): `biped`, the nominal robot, with the scenario's model errors.

    They apply in this order: errors of mass and inertia by body, a load on the trunk, friction, and errors that
    are drawn with the widths mass_width, com_width, inertia_width and friction_width. Without errors the object
    `biped` itself is returned, by which `build` knows that plant and model agree.
    """
    plant, wrong = biped, s.errors
    if wrong.mass or wrong.inertia:
        plant = ModelErrors(wrong.mass, inertia=wrong.inertia).apply(plant)
    if wrong.trunk_load != 0.0:
        plant = ModelErrors(mass={biped.description.trunk: wrong.trunk_load}).apply(plant)
    if wrong.friction != 0.0:
        plant = ModelErrors.of_friction(plant, wrong.friction).apply(plant)
    widths = (wrong.mass_width, wrong.com_width, wrong.inertia_width, wrong.friction_width)
    if any(widths):
        plant = ModelErrors.drawn(plant, drawn(s, "model"), *widths).apply(plant)
    return plant


def sensors(s: Scenario) -> Sensor | None:
    """The sensors of a scenario: encoders, then the sensor that `hardware.sensor` names; None where all is
    measured exactly.
    """
    e, more, encoders = s.hardware.encoders, s.hardware.sensor, None
    if e.record():
        # None: the angle of the pitch has the resolution of the joints
        noise = (e.noise, e.pitch_noise, e.rate_noise)
        rates, noisy = (e.velocity, e.filter_time), drawn(s, "sensors")
        encoders = Sensors(e.counts, None, *noise, *rates, noisy, e.angle_filter)
    if more.name is None:
        return encoders
    # named_part constructs the class of this name with those of seed and `own` that it takes
    seed = {"seed": drawn(s, "sensor")}
    sensor = named_part("sensor", more.name, seed, more.own, Sensor, "hardware.sensor")
    return sensor if encoders is None else encoders + sensor


def _touchdown(s: Scenario, gait: Gait) -> Touchdown | None:
    """The detector by which the controller of a scenario notices touchdowns; None if it knows them at once.

    The detector assumes the gait's slope, since the controller does not know that of the ground.
    """
    t = s.hardware.touchdown
    if t.name is None:
        return None
    known = {"slope": gait.slope, "seed": drawn(s, "touchdown")}
    return named_part("touchdown", t.name, known, t.own, Touchdown, "hardware.touchdown")  # type: ignore[type-abstract]


def plant_around(name: str, walker: Walker, options: Mapping[str, object]) -> SteppingPlant:
    """A plant of the registry, by its name, for a walker's robot on its slope, with its ends of a run
    (`max_step_time`, `fall_height`). options: more values for the plant's constructor, by name.

    Raises InputError for an unknown plant, or one that cannot be made.
    """
    own = {x: getattr(walker, x) for x in ("max_step_time", "fall_height")}
    # the constructor takes what it names; {}: no values of a record; "ground": dotted name of it, for messages
    values = {**options, **own, "biped": walker.plant, "slope": walker.ground_slope}
    return named_part("plant", name, values, {}, SteppingPlant, "ground")  # type: ignore[type-abstract]


def soft_loop(s: Scenario, walker: Walker) -> SteppingLoop | None:
    """The closed loop of the walker's controller and a plant that moves by itself between sample instants, such
    as MuJoCo's; None where the scenario has the rigid plant.

    The plant takes by name values of the walker and of the record of the ground. Raises InputError for one that
    cannot be made.
    """
    g = s.ground
    if g.plant == RIGID:
        return None

    make = find("plant", g.plant).load()
    # a value of the user's that neither the plant nor its ground takes is an error
    all_taken("ground", g.own, {**takes(make), **takes(SoftGround)})
    # `construct` calls a class with those values that it takes; h: integration step of the plant
    # beside the user's own those values of the record that SoftGround takes
    options = g.own | {x: getattr(g, x) for x in ("friction", "time_constant", "damping_ratio")}
    ground = construct(f"the ground of plant '{g.plant}'", SoftGround, options, SoftGround)
    plant = plant_around(g.plant, walker, g.own | {"ground": ground, "h": g.engine_step})
    return fastest_loop(walker, plant, s.run.engine, s.run.first_step)


def _ground(s: Scenario) -> Steps:
    """Changes of the ground's height by the values of the scenario's `ground`; () if level.

    They add up: heights drawn with the root mean square `rms` [m] and up to `step_height` [m] for each walking
    step, and one step of the ground in single support `drop_step`, down by `drop` [m] (up if negative).
    """
    # last: number of the last single support; the heights are drawn from the first on, whatever `first_step` is
    g, last = s.ground, s.run.first_step + s.run.impacts - 1
    if not (g.rms or g.step_height or g.drop):
        return ()
    seed = drawn(s, "ground")  # of both; where rms or step_height is 0, nothing comes of it
    each = np.random.default_rng(seed).uniform(-g.step_height, g.step_height, last)
    steps = uneven_ground(seed, g.rms, last) + stepped(each)
    return steps + stepped(np.array([g.drop]), g.drop_step)


def stones(s: Scenario) -> Stones | None:
    """The stones of a scenario, stated or drawn; None without stones. A stone is a place on which the foot has
    to land: stone k ends single support k, whose length [m] is that of the walking step to it.

    Lengths are drawn for each single support from 1 to the last one, and one more, since a controller looks at
    the next stone.
    """
    g = s.ground
    if g.stones is not None:
        return Stones(g.stones, g.stone_tolerance)
    if g.stone_range is None:
        return None
    count = s.run.first_step + s.run.impacts  # the last one has the number count - 1
    random = np.random.default_rng(drawn(s, "stones"))
    lengths = random.uniform(g.stone_range[0], g.stone_range[1], count)
    return Stones(tuple(lengths.tolist()), g.stone_tolerance)


# -- pushes ----------------------------------------------------------------------------------------
def disturbances(s: Scenario, biped: Biped, period: float, plant: Biped) -> Disturbance | None:
    """The sum of all pushes of a scenario as a disturbance; None without any.

    biped: the nominal robot, by which joints are known. period: duration of the gait's step [s]. plant: the
    robot that walks, for forces on its links. Raises InputError for a push that does not fit.
    """
    parts = tuple(disturbance(s, i, biped, period, plant) for i in range(len(s.pushes)))
    return Sum(parts) if len(parts) > 1 else parts[0] if parts else None


def disturbance(s: Scenario, i: int, biped: Biped, period: float, plant: Biped) -> Disturbance:
    """Push number i of a scenario, from 0, as a disturbance.

    biped: the nominal robot, by which joints are known. period: duration of the gait's step [s]. plant: the
    robot that walks, for forces on its links. Raises InputError for a value that its shape does not take, and
    for a push outside of the walk.
    """
    push = s.pushes[i]
    # (F_x, F_z, M) [N, N, N m] on a link, with x forwards and z up; no moment
    along = push.force * np.array((math.cos(push.direction), math.sin(push.direction), 0.0))
    # the parameters of the class of this shape in time; one with `force` is a force by itself, without a link
    accepted = takes(find("disturbance", push.shape).load())
    forced = push.link is not None or "force" in accepted
    # values of the push without an effect: name -> why, False where it has one
    idle = {
        "force": not forced and "is a torque; name the link on which a force acts",
        "torque": "amplitude" not in accepted and "takes no torque",
        "rise": "rise" not in accepted and "has no edges; only a pulse has a rise",
        **dict.fromkeys(
            ("step", "onset", "duration", "across_impacts"),
            "steps" in accepted and "acts all the time; give steps = [first, last]",
        ),
    }
    for name, why in idle.items():
        if why and name in push.record():
            raise Misfit(f"pushes.{i}.{name}", f"the push '{push.shape}' {why}")
    known = {
        **window(s, i, period),
        "seed": drawn(s, "noise", i) if "seed" in accepted else None,
        "rise": push.rise,
        "force": tuple(along[:2].tolist()),
        "amplitude": _torques(s, i, biped) if push.link is None else along,
        "biped": plant,
    }
    # fields: names that the message on an unknown value may propose, beside the parameters of the class
    place, fields = f"pushes.{i}", Push.model_fields
    result = named_part("disturbance", push.shape, known, push.own, Disturbance, place, fields)  # type: ignore[type-abstract]
    first, last = s.run.first_step, s.run.first_step + s.run.impacts - 1
    # of pushes from before the first single support only a step of the torque, which stays, or a push that
    # goes on over impacts may act
    early = push.step < first and push.shape != "step" and not push.over_impacts
    if "step" in accepted and (early or push.step > last):
        raise Misfit(f"pushes.{i}.step", f"is {push.step}, the walk has {first} to {last}")
    return result if push.link is None else OnLink(plant, push.link, cast(Windowed, result))


def window(s: Scenario, i: int, period: float) -> dict[str, Any]:
    """The arguments of push i that say when it acts: step (number of its single support), start and stop [s],
    frequency and bandwidth [Hz], by name.

    A push counts from the start of its single support and ends with it at the latest. One that goes on over
    impacts has step None and counts from the start of the walk: its single support is taken to begin when the
    gait, of this period [s], would begin it. An onset that the scenario does not state is drawn so that the
    push fits into the period.
    """
    push = s.pushes[i]
    begin = push.onset
    if begin is None:
        last = max(period - push.duration, 0.0)
        begin = float(np.random.default_rng(drawn(s, "onset", i)).uniform(0.0, last))
    over = push.over_impacts
    # time [s] at which the gait would begin this single support, from the start of the walk
    late = (push.step - s.run.first_step) * period if over else 0.0
    return {
        "step": None if over else push.step,
        "start": late + begin,
        "stop": late + push.stop(begin),
        # a sine takes the frequency, noise the same number as its bandwidth
        "frequency": push.frequency,
        "bandwidth": push.frequency,
    }


def _torques(s: Scenario, i: int, biped: Biped) -> Array:
    """Torques (n,) [N m] of push i on the coordinates; for joints "random" its torque on all joints with
    motors, times factors in -1 .. 1 that are drawn.

    Raises InputError for an unknown joint.
    """
    push, zeta = s.pushes[i], np.zeros(biped.n)
    if push.joints == RANDOM and not isinstance(push.torque, dict):
        random = np.random.default_rng(drawn(s, "joints", i))
        zeta[: biped.p] = push.torque * random.uniform(-1.0, 1.0, biped.p)
        return zeta
    for joint, torque in push.factors.items():  # name of the joint -> torque [N m], with its sign
        zeta[biped.description.joint_index(joint)] += torque
    return zeta
