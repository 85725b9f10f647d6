"""A scenario: one walk as nested records of plain values.

    s = ba.Scenario("ADRC", hardware="rabbit", pushes="q1,q2=30@3:0.1-0.3", run={"impacts": 8})
    s = ba.Scenario({"name": "LESO", "observer": {"bandwidth": "160 rad/s"}}, robot="rabbit")
    walk = ba.walk_scenario(s)

It is what a study varies, what a command line names, what a stored walk carries, and what a worker process
receives. `scenario.records` reads and checks the values; `build` makes the walker. Everything random is drawn
from `run.seed`, one stream per purpose (`drawn`), so that the same scenario gives the same walk in any process.

A record is a table of values, each field with its default, unit and range in `field(..)` and its help text
below it. kind: the field is the name of a part of this kind, such as a controller, in the registry
(`core.registry`), which finds its class. SHORT: the field that a text alone sets; "" for none. APART: pairs of
values of which at most one may differ from its default. An open record also keeps values that it does not
declare, for a class of the user's. A step of the ground is a place where it falls or rises; stones are places
on which the feet have to land, one for each single support.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar, Literal, Self

import numpy as np
from pydantic import field_validator, model_validator

from biped_adrc.core.errors import InputError
from biped_adrc.core.files import one_line, reading, toml_key, toml_value, write_text
from biped_adrc.scenario.dotted import flat, tables
from biped_adrc.scenario.hardware import HardwareRecord
from biped_adrc.scenario.push import Push, parse_push
from biped_adrc.scenario.records import Described, Misfit, OpenRecord, Record, by_default, field

MOST_SEED = 2**63 - 1
"""Largest seed: the largest integer that a file of results can hold."""
LONGEST_PLANT_STEP = 2e-4
"""Longest default integration step of an engine with soft ground [s]."""
_RESOLVED = 0.1
"""Default integration step of such an engine as a share of the ground's time constant, so that it resolves
contact."""
_Values = Any
"""A record as a mapping of its values, or as the text that stands for it; pydantic checks which."""


class RobotRecord(Record):
    """Which robot walks."""

    name: str = field("rabbit", kind="robot")
    """The robot has a name of 'biped-adrc robot list', or is the path of a robot.toml, or module:Class."""
    preset: str | None = field(None)
    """The parameters are this preset of the robot; by default its record says which."""


class GaitRecord(Record):
    """Which gait is the reference."""

    name: str = field("published", kind="gait")
    """The gait is published (through x*), recipe (section IV), v0.4 to v1.1, a .json file or module:Class."""
    continued: bool = field(False)
    """The constraint goes on smoothly past its ends."""
    other_robot: bool = field(False)
    """The gait may be one that was made for another robot or preset."""


class ObserverRecord(OpenRecord):
    """The observer of the controller; its further parameters by name."""

    APART = (("bandwidth", "poles"), ("order", "poles"))
    name: str | None = field(None, kind="observer")
    """The observer is one of the registry, or module:Class; by default the controller's own."""
    bandwidth: float | None = field(None, "rad/s", gt=0, le=1e6)
    """All poles lie at minus this; by default they are the controller's own."""
    order: int | None = field(None, ge=0, le=12)
    """The observer has so many extended states, m."""
    poles: tuple[float, ...] | None = field(None, "rad/s")
    """The observer has these m + 2 poles, comma separated; by default the controller's own."""
    reset: Literal["none", "relabel", "measured", "model"] = field("model")
    """An impact changes nothing, swaps the legs, or resets the states by measurement or by nominal model."""


class ContactRecord(OpenRecord):
    """What the controller does while contact settles after touchdown; further parameters by name."""

    name: str | None = field(None, kind="contact")
    """The policy is one of the registry ('hold'), or module:Class."""
    window: float | None = field(None, "s", ge=0, le=1.0)
    """The policy acts for so long after touchdown; by default as long as it says itself."""

    @model_validator(mode="after")
    def _named(self) -> Self:
        """Raise Misfit for a window without a policy."""
        if self.window is not None and self.name is None:
            raise Misfit("window", "is that of a policy; give its name too")
        return self


class ControllerRecord(OpenRecord):
    """The controller; its further parameters by name."""

    name: str = field("ADRC", kind="controller")
    """The controller is one of the registry, or module:Class."""
    K_p: float | None = field(None, "1/s^2", gt=0)
    """The proportional gain is this, PD's in N m/rad; by default the controller's own."""
    K_d: float | None = field(None, "1/s", gt=0)
    """The derivative gain is this, PD's in N m s/rad; by default the controller's own."""
    solve_theta: bool = field(True)
    """The loop through Theta'' is solved; if not, the law is as printed."""
    observer: ObserverRecord = field(ObserverRecord.model_construct())
    contact: ContactRecord = field(ContactRecord.model_construct())
    prediction: float = field(0.0, "s", ge=0, le=0.1)
    """The controller gets the state so much ahead, by its model and the torques on their way."""
    feedforward: float = field(0.0, "1", ge=0, le=2)
    """The torque compensates this share of the record's joint friction, at the reference's rates."""
    inner: ControllerRecord | None = field(None)
    """An outer loop has this controller inside."""


class GroundRecord(OpenRecord):
    """The ground, or the engine that walks on it, with its further parameters by name."""

    SHORT = "plant"
    APART = (("stone_range", "stones"),)
    plant: str = field("rigid", kind="plant")
    """The plant is rigid (pinned foot, plastic impact), mujoco (soft ground), or module:Class."""
    friction: float = field(0.6, "1", gt=0, le=10)
    """Soft ground has this coefficient of friction."""
    time_constant: float = field(2e-3, "s", ge=1e-5, le=1.0)
    """Soft ground drives a foot out with this time constant."""
    damping_ratio: float = field(1.0, "1", gt=0, le=100)
    """Soft ground drives a foot out with this damping ratio."""
    plant_step: float | None = field(None, "s", ge=1e-6, le=0.01)
    """The engine of soft ground takes this step; by default a tenth of the time constant, at most 0.2 ms."""
    slope: float | None = field(None, "rad", ge=-0.5, le=0.5)
    """The ground falls at this angle, downhill; by default that for which the gait was made."""
    drop: float = field(0.0, "m", ge=-0.2, le=0.2)
    """The ground falls by this in one step."""
    drop_step: int = field(3, ge=1, le=100000)
    """The ground falls in this single support."""
    rms: float = field(0.0, "m", ge=0, le=0.1)
    """The unevenness of the ground, drawn, has this root mean square."""
    step_height: float = field(0.0, "m", ge=0, le=0.1)
    """Each single support ends on ground up to so much higher or lower, drawn."""
    stones: tuple[float, ...] | None = field(None, "m")
    """The steps to the stones have these lengths."""
    stone_range: tuple[float, ...] | None = field(None, "m")
    """All lengths are drawn between these two, the least and the largest, in place of stones."""
    stone_tolerance: float = field(0.025, "m", gt=0, le=1)
    """A foot still lands on a stone at this distance from its middle."""

    @property
    def engine_step(self) -> float:
        """Integration step [s] of the engine of a plant with soft ground; by default short enough for its
        contact.
        """
        # at most 0.2 ms, and a tenth of the ground's time constant
        usual = min(LONGEST_PLANT_STEP, _RESOLVED * self.time_constant)
        return usual if self.plant_step is None else self.plant_step

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        """Raise Misfit unless stone_range, if any, is two lengths, the least above 0 and first, and for values
        of soft ground where it is rigid.
        """
        soft = {"friction", "time_constant", "damping_ratio", "plant_step"} & self.record().keys()
        if soft and self.plant == "rigid":
            raise Misfit(min(soft), "is of soft ground; give ground.plant too")
        ends = self.stone_range
        if ends is not None and not (len(ends) == 2 and 0.0 < ends[0] <= ends[1]):
            raise Misfit("stone_range", f"is {ends}, expected the least and the largest length [m]")
        return self


class ErrorRecord(Record):
    """How the plant differs from the model that the controller has."""

    SHORT = ""
    mass: dict[str, float] = field({}, "1")
    """The plant's masses have these relative errors, by body: 0.2 is 20 % more."""
    inertia: dict[str, float] = field({}, "1")
    """The plant's inertias about the COM have these relative errors, by body."""
    mass_width: float = field(0.0, "1", ge=0, lt=1)
    """All masses have relative errors, drawn, of this half-width."""
    com_width: float = field(0.0, "1", ge=0, lt=1)
    """All centres of mass have relative errors, drawn, of this half-width."""
    inertia_width: float = field(0.0, "1", ge=0, lt=1)
    """All inertias have relative errors, drawn, of this half-width."""
    friction_width: float = field(0.0, "1", ge=0, lt=1)
    """The friction of all joints has relative errors, drawn, of this half-width."""
    trunk_load: float = field(0.0, "1", gt=-1, le=10)
    """The torso's mass has this relative error, not drawn."""
    friction: float = field(0.0, "1", ge=-1, le=10)
    """The friction of all joints has this relative error, not drawn."""
    impact_width: float = field(0.0, "1", ge=0, lt=1)
    """The rates after impact have relative errors, drawn, of this half-width."""


class StartRecord(OpenRecord):
    """What is added to the start: q1.. [rad] and v1.. [rad/s] by name, and what is drawn."""

    __pydantic_extra__: dict[str, float]
    SHORT = ""
    speed: float = field(0.0, "1", gt=-1, le=2)
    """All rates change by this share."""
    speed_spread: float = field(0.0, "1", ge=0, le=1)
    """All rates change by a share that is drawn, with this standard deviation."""
    spread: float = field(0.0, "rad", ge=0, le=1)
    """All angles have errors that are drawn, with this standard deviation."""
    rate_spread: float = field(0.0, "rad/s", ge=0, le=10)
    """All rates have errors that are drawn, with this standard deviation."""

    @classmethod
    def own_value(cls, name: str) -> Described:
        """The description of a coordinate's offset, q1.. or v1... Raises Misfit for another name."""
        if not re.fullmatch("[qv][1-9][0-9]*", name):
            raise Misfit(name, "expected speed, spread, or a coordinate such as q5 or v5")
        return Described(name, (float,), default=0.0, unit="rad" if name[0] == "q" else "rad/s")


class LimitRecord(Record):
    """What ground and motors can give, for a feasible walk."""

    SHORT = ""
    friction: float | None = field(None, "1", gt=0, le=1)
    """The ground has this coefficient of friction; by default that of the robot's record."""
    window: float = field(5e-3, "s", gt=0, le=0.1)
    """The ground's force is averaged over this time."""


class RunRecord(Record):
    """How far, from which seed, and by which numerics."""

    SHORT = ""
    impacts: int = field(25, ge=1, le=10000)
    """The walk ends after so many impacts (12.5 steps of the paper are 25)."""
    first_step: int = field(1, ge=1, le=100000)
    """The first single support has this number."""
    seed: int = field(0, ge=0, le=MOST_SEED)
    """All that is drawn comes from this seed."""
    method: Literal["rk4", "exponential", "adaptive"] | None = field(None)
    """The equations are integrated by this method; by default by what fits the walker."""
    h: float | None = field(None, "s", ge=1e-6, le=0.1)
    """The methods rk4 and exponential take this step; by default 1 ms or what fits."""
    fine: float | None = field(None, "s", ge=1e-6, le=0.1)
    """The step is this where a push switches and in the single support after."""
    tolerance: float = field(1e-9, "1", gt=0, le=1)
    """The method adaptive has this tolerance."""
    engine: Literal["compiled", "pinocchio"] = field("compiled")
    """The engine is compiled, where it can run, or pinocchio, which it is checked against."""
    max_step_time: float = field(2.0, "s", gt=0, le=100)
    """A longer single support ends as stalled."""
    runaway_speed: float = field(20.0, "1", gt=0, le=1e9)
    """Rates beyond this multiple of 50 rad/s end a walk as run away."""
    runaway_torque: float = field(1000.0, "1", gt=0, le=1e9)
    """Torques beyond this multiple of the peak torque in the robot's record end a walk as run away."""

    @model_validator(mode="after")
    def _own_step(self) -> Self:
        """Raise Misfit for an integration step beside the method "adaptive", which chooses its own."""
        if self.method == "adaptive" and (step := self.h or self.fine) is not None:
            raise Misfit("h", f"is {step:g} s, and 'adaptive' chooses its own; leave it out")
        return self


_USUAL = by_default(ControllerRecord)
"""The controller of a scenario that names none."""


class Scenario(Record):
    """One walk in plain values, in records by what they are of.

    Each record is itself, a mapping of its values, or a text for its name; the fields say its values. Lengths
    are in m, angles in rad, times in s, torques in N m, or texts with a unit. `replace` changes some values
    and keeps the others.

    controller: the law, with observer and gains. robot: the one that walks. gait: the reference. hardware: its
    sampling, sensors and motors. pushes: the torques and forces that disturb it, records or texts. errors: how
    the plant differs from the controller's model. ground: the ground, or another plant. start: what is added
    to the start. limits: what ground and motors can give. run: length, seed and numerics. dotted: single values
    by dotted names, such as **{"run.seed": 3}, which count before those of a record.

    Raises InputError for an unknown name, a value out of its range, and for most that cannot have an effect.

    >>> scenario = ba.Scenario("ADRC", gait="v0.8", hardware={"period": "1 ms"})
    >>> scenario.replace({"run.impacts": 10}).run.impacts
    10
    """

    SUCH_AS: ClassVar[str] = "Scenario('NPD'); a Walker walks with walk(walker, gait)"

    SHORT = "controller"
    APART = (("hardware.delay_known", "controller.prediction"),)
    controller: ControllerRecord = field(_USUAL)
    robot: RobotRecord = field(by_default(RobotRecord))
    gait: GaitRecord = field(by_default(GaitRecord))
    hardware: HardwareRecord = field(by_default(HardwareRecord))
    pushes: tuple[Push, ...] = field(())
    errors: ErrorRecord = field(by_default(ErrorRecord))
    ground: GroundRecord = field(by_default(GroundRecord))
    start: StartRecord = field(by_default(StartRecord))
    limits: LimitRecord = field(by_default(LimitRecord))
    run: RunRecord = field(by_default(RunRecord))

    def __init__(
        self,
        controller: ControllerRecord | _Values = _USUAL,
        *,
        robot: RobotRecord | _Values = by_default(RobotRecord),
        gait: GaitRecord | _Values = by_default(GaitRecord),
        hardware: HardwareRecord | _Values = by_default(HardwareRecord),
        pushes: Push | _Values | Sequence[Push | _Values] = (),
        errors: ErrorRecord | _Values = by_default(ErrorRecord),
        ground: GroundRecord | _Values = by_default(GroundRecord),
        start: StartRecord | _Values = by_default(StartRecord),
        limits: LimitRecord | _Values = by_default(LimitRecord),
        run: RunRecord | _Values = by_default(RunRecord),
        **dotted: Any,
    ) -> None:
        """Join the records of the call and, over them, the values by dotted names; see the class.

        A record that is the very object of its default was left out, and is not stated again.
        """
        # vars(): the arguments by name
        here, fields = vars(), type(self).model_fields.items()
        records = {name: here[name] for name, x in fields if here[name] is not x.default}
        super().__init__(**tables(records | dotted))

    @field_validator("pushes", mode="before")
    @classmethod
    def _parsed(cls, x: Any) -> Any:
        """A tuple of pushes, of texts of a command line ("q1=30@3:0.1-0.3 q5=20@4:0.1-"), of one push, of a
        table by number {"0": ..}, or of a list; anything else is returned as it is, and pydantic refuses it.
        """
        # several pushes in one text: one begins behind a blank that JOINTS= follows
        if isinstance(x, str):
            x = re.split(r"\s+(?=[^\s@=]+=)", x.strip())
        elif isinstance(x, Mapping):
            numbered = all(name.isdigit() for name in x)
            x = [x[name] for name in sorted(x, key=int)] if numbered else [x]
        elif isinstance(x, Push):
            x = [x]
        # tables in it become pushes when pydantic reads the field
        many = isinstance(x, list | tuple)
        return tuple(parse_push(y) if isinstance(y, str) else y for y in x) if many else x


def read_scenario(path: Path) -> Scenario:
    """The scenario of a TOML file, such as the following. Raises InputError with the file and the name of the
    value.

        controller.name = "LESO"
        controller.observer.bandwidth = "160 rad/s"
        pushes = [{ joints = "q1", torque = "30 N m", step = 2, onset = "0.1 s" }]
    """
    with reading("scenario file", path, InputError):
        return Scenario(**tomllib.loads(path.read_text(encoding="utf-8")))


def write_scenario(path: Path, s: Scenario, comment: str) -> None:
    """Write a TOML file that `read_scenario` reads: names of controller and robot, and the values that differ
    from the defaults. comment: text for the line at the top. Raises OutputError.
    """
    write_text(path, "\n".join([f"# {one_line(comment)}", *scenario_lines(s), ""]))


def scenario_lines(s: Scenario) -> list[str]:
    """Lines of TOML: the names of controller and robot, then the values that differ from the defaults."""
    record = {"controller.name": s.controller.name, "robot.name": s.robot.name}
    others = s.record()
    pushes = {"pushes": others.pop("pushes")} if s.pushes else {}
    values = record | flat(others) | pushes
    keys = {name: ".".join(map(toml_key, name.split("."))) for name in values}
    return [f"{keys[name]} = {toml_value(x)}" for name, x in values.items()]


DRAWN = (
    *("start", "onset", "joints", "noise", "sensors", "model", "impact", "ground", "sensor"),
    *("touchdown", "stones"),
)
"""What is random in a walk. The place in this list selects the stream of random numbers, so a new name goes to
the end."""


def drawn(s: Scenario, what: str, item: int = 0) -> int:
    """A 63-bit seed for one purpose of `DRAWN`, from the scenario's seed; item: number of a push, from 0.

    The streams are independent: a scenario with one random thing more keeps the draws of all others, so that
    two scenarios differ by what was changed and not by luck.

    start: offsets of coordinates and speed. onset: time of a push. joints: factors of a push on random joints.
    noise: a push that is noise. sensors: noise of encoders. model: errors of masses, centres, inertias and
    friction. impact: error of the impact map. ground: heights of uneven ground. sensor: noise of the sensor
    that `hardware.sensor` names, apart from that of the encoders. touchdown: which touchdowns are missed.
    stones: lengths of the steps to the stones.
    """
    # push 0 has the key without a number
    key = (DRAWN.index(what), item) if item else (DRAWN.index(what),)
    words = np.random.SeedSequence(s.run.seed, spawn_key=key).generate_state(1, np.uint64)
    return int(words[0] >> np.uint64(1))  # 63 bits, as files hold signed integers of 64
