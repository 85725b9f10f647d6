"""A scenario: one walk as nested records of plain values.

    s = ba.Scenario("ADRC", hardware="rabbit", pushes="q1,q2=30@3:0.1-0.3", run={"impacts": 8})
    s = ba.Scenario({"name": "LESO", "observer": {"bandwidth": "160 rad/s"}}, robot="rabbit")
    walk = ba.walk_scenario(s)

It is what a study varies, what a command line names, what a stored walk carries, and what a worker process
receives. `scenario.records` reads and checks the values; `build` makes the walker. Everything random is drawn
from `run.seed`, one stream per purpose (`drawn`), so that the same scenario gives the same walk in any process.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from typing import Any, ClassVar, Literal, Self

import numpy as np
from pydantic import ConfigDict, field_validator, model_validator

from biped_adrc.resources import packaged
from biped_adrc.scenario.push import Push, parse_push
from biped_adrc.scenario.records import (
    Described,
    Misfit,
    Record,
    described_in,
    field,
    flat,
    merged,
    names_of,
    nested,
    plain,
    read,
)
from biped_adrc.scenario.registry import find

PROFILES: dict[str, dict[str, Any]] = packaged("biped_adrc.scenario", "hardware.toml")
"""Values that `hardware.profile` fills in: none, continuous time; ideal, exact measurements at 1 kHz; rabbit,
sampling, encoders, torque and friction published for RABBIT (Chevallereau et al., IEEE Control Systems Magazine
2003; Westervelt, Buche, Grizzle, IJRR 2004), whose rotors are in the preset 'identified'."""
MOST_SEED = 2**63 - 1
"""Largest seed: the largest integer that a file of results can hold."""
FREE = ("adaptive", "stiff")
"""Integration methods that choose their own step."""
Own = ConfigDict(extra="allow")


class RobotRecord(Record):
    """Which robot walks."""

    name: str = field(
        "By name ('biped-adrc robot list'), the path of a robot.toml, or module:Class.",
        "rabbit",
        kind="robot",
    )
    preset: str | None = field("Of its parameters; its record's default if not given.", None)


class GaitRecord(Record):
    """Which gait is the reference."""

    name: str = field(
        "published (through x*), recipe (section IV), v0.4 to v1.1 (by speed), a .json file, or module:Class.",
        "published",
        kind="gait",
    )
    continued: bool = field("The constraint goes on smoothly past its ends.", False)
    other_robot: bool = field("Walk a gait that was made for another robot or preset.", False)


class ObserverRecord(Record):
    """The observer of the controller; its further parameters by name."""

    model_config = Own
    name: str | None = field(
        "Of the registry, or module:Class; by default the controller's own.", None, kind="observer"
    )
    bandwidth: float | None = field(
        "All poles at minus this; by default the controller's own.", None, "rad/s", gt=0, le=1e6
    )
    order: int | None = field("m of the observer.", None, ge=0, le=12)
    poles: tuple[float, ...] | None = field(
        "m + 2 poles, comma separated; by default the controller's own.", None, "rad/s"
    )
    reset: Literal["none", "relabel", "measured", "model"] = field(
        "At impact nothing, legs swapped, states from the measurement, or from the nominal model.",
        "model",
    )

    @model_validator(mode="after")
    def _once(self) -> Self:
        """Raise Misfit for two ways to say where the poles are."""
        for name in ("bandwidth", "order"):
            if self.poles is not None and getattr(self, name) is not None:
                raise Misfit(name, "is given beside poles, which say it; leave one of them out")
        return self


class ContactRecord(Record):
    """What the controller does while contact settles after touchdown; further parameters by name."""

    model_config = Own
    name: str | None = field(
        "A policy of the registry ('hold'), or module:Class.", None, kind="contact"
    )
    window: float | None = field(
        "Time after touchdown that it takes; by default the policy's own.", None, "s", ge=0, le=1.0
    )


class ControllerRecord(Record):
    """The controller; its further parameters by name."""

    model_config = Own
    name: str = field("Of the registry, or module:Class.", "ADRC", kind="controller")
    K_p: float | None = field(
        "Proportional gain; by default the controller's own.", None, "1/s^2", gt=0
    )
    K_d: float | None = field(
        "Derivative gain; by default the controller's own.", None, "1/s", gt=0
    )
    solve_theta: bool = field("Solve the loop through Theta''; if not, as printed.", True)
    observer: ObserverRecord = field("", ObserverRecord())
    contact: ContactRecord = field("", ContactRecord())
    prediction: float = field(
        "The controller gets the state so much ahead, by its model and the torques on their way.",
        0.0,
        "s",
        ge=0,
        le=0.1,
    )
    feedforward: float = field(
        "Share of the record's joint friction added to the torque, at the reference's rates.",
        0.0,
        ge=0,
        le=2,
    )
    inner: ControllerRecord | None = field("The controller inside an outer loop.", None)


class EncoderRecord(Record):
    """Encoders and rates."""

    SHORT = ""
    counts: float | None = field("Per revolution; by default exact.", None, ge=1)
    noise: float = field("Standard deviation of the joints' angles.", 0.0, "rad", ge=0, le=1.0)
    pitch_noise: float = field("That of the unactuated pitch.", 0.0, "rad", ge=0, le=1.0)
    rate_noise: float = field("That of measured rates.", 0.0, "rad/s", ge=0, le=100.0)
    velocity: Literal["measured", "differences", "gyro"] = field(
        "Rates: exact, from differences of angles, or so but for the pitch's.", "measured"
    )
    filter_time: float = field("Low-pass of the differences.", 0.0, "s", ge=0, le=1.0)


class PartRecord(Record):
    """A part by name, with its parameters."""

    model_config = Own
    name: str | None = field("", None)


class SensorRecord(PartRecord):
    """One more sensor behind the encoders, with its parameters."""

    name: str | None = field("Of the registry, or module:Class.", None, kind="sensor")


class TouchdownRecord(PartRecord):
    """How the controller notices touchdowns, with parameters."""

    name: str | None = field(
        "Of the registry ('told', 'force', 'kinematics'), or module:Class; by default at once.",
        None,
        kind="touchdown",
    )


class HardwareRecord(Record):
    """Sampling, sensors, motors and joint friction."""

    SHORT = "profile"
    profile: str = field("Fills in what is not given: none, ideal (1 kHz) or rabbit.", "none")
    period: float | None = field(
        "Sampling period of the controller; by default continuous time.", None, "s", ge=1e-5, le=0.1
    )
    delay: float = field("From a tick to the torque's effect.", 0.0, "s", ge=0, le=1.0)
    delay_known: bool = field("Whether the observer knows the delay.", False)
    encoders: EncoderRecord = field("", EncoderRecord())
    sensor: SensorRecord = field("", SensorRecord())
    touchdown: TouchdownRecord = field("", TouchdownRecord())
    torque_limit: float | None = field("Of every motor.", None, "N m", gt=0)
    rate_limit: float | None = field("Of every motor's torque.", None, "N m/s", gt=0)
    lag: float = field("Time constant of the motors.", 0.0, "s", ge=0, le=1.0)
    friction: bool = field("Joint friction of the robot's record in the plant.", False)

    @classmethod
    def filled(cls, values: dict[str, Any]) -> dict[str, Any]:
        """Values of the profile where none are given."""
        profile = PROFILES.get(str(values.get("profile")), {})
        return {
            **values,
            **merged(profile, {name: values[name] for name in profile if name in values}),
        }

    @field_validator("profile")
    @classmethod
    def _there(cls, profile: str) -> str:
        if profile not in PROFILES:
            raise ValueError(f"found '{profile}', expected one of {list(PROFILES)}")
        return profile

    @model_validator(mode="after")
    def _sampled(self) -> Self:
        """Raise Misfit for a value that would do nothing in continuous time."""
        idle = flat(Record.record(self)).keys() - {"torque_limit", "friction", "profile"}
        if self.period is None and idle:
            raise Misfit(
                min(idle), "does nothing in continuous time; give hardware.period too, as '1 ms'"
            )
        return self

    def record(self, usual: Record | None = None) -> dict[str, Any]:
        if self.profile == "none":
            return super().record()
        return {"profile": self.profile, **super().record(HardwareRecord(profile=self.profile))}


class GroundRecord(Record):
    """The ground, or the engine that walks on it, with its further parameters by name."""

    model_config = Own
    SHORT = "plant"
    plant: str = field(
        "What walks: rigid (pinned foot, plastic impact), mujoco (soft ground), or module:Class.",
        "rigid",
        kind="plant",
    )
    friction: float = field("Of soft ground.", 0.6, gt=0, le=10)
    time_constant: float = field(
        "Of soft ground: how fast a foot in it is driven out.", 2e-3, "s", ge=1e-5, le=1.0
    )
    damping_ratio: float = field("Of soft ground.", 1.0, gt=0, le=100)
    plant_step: float | None = field(
        "Step of its engine; by default a tenth of the time constant, at most 0.2 ms.",
        None,
        "s",
        ge=1e-6,
        le=0.01,
    )
    slope: float = field("Downhill, beside the gait's own.", 0.0, "rad", ge=-0.5, le=0.5)
    drop: float = field("The ground falls by this in one step.", 0.0, "m", ge=-0.2, le=0.2)
    drop_step: int = field("Single support in which it falls.", 3, ge=1, le=100000)
    rms: float = field("Unevenness, drawn.", 0.0, "m", ge=0, le=0.1)

    @field_validator("plant")
    @classmethod
    def _there(cls, plant: str) -> str:
        find("plant", plant)
        return plant


class ErrorRecord(Record):
    """How the plant differs from the model that the controller has."""

    SHORT = ""
    mass: dict[str, float] = field("Factors of the plant's bodies, by body.", {})
    inertia: dict[str, float] = field("The same of inertias.", {})
    mass_width: float = field("Half-width of relative errors drawn for bodies.", 0.0, ge=0, lt=1)
    com_width: float = field("The same for centres of mass.", 0.0, ge=0, lt=1)
    inertia_width: float = field("The same for inertias.", 0.0, ge=0, lt=1)
    friction_width: float = field("The same for friction.", 0.0, ge=0, lt=1)
    trunk_load: float = field("Relative error of the torso's mass, not drawn.", 0.0, gt=-1, le=10)
    impact_width: float = field(
        "Half-width of relative errors of rates after impact.", 0.0, ge=0, lt=1
    )


class StartRecord(Record):
    """What is added to the start: q1.. [rad] and v1.. [rad/s] by name, and what is drawn."""

    model_config = Own
    __pydantic_extra__: dict[str, float]
    SHORT = ""
    _COORDINATE: ClassVar[re.Pattern[str]] = re.compile("[qv][1-9][0-9]*", re.ASCII)
    speed: float = field("Relative change of all rates.", 0.0, gt=-1, le=2)
    speed_spread: float = field("Standard deviation of it, drawn.", 0.0, ge=0, le=1)
    spread: float = field("Standard deviation added to all angles.", 0.0, "rad", ge=0, le=1)
    rate_spread: float = field("The same for rates.", 0.0, "rad/s", ge=0, le=10)

    @classmethod
    def own_value(cls, name: str) -> Described:
        if not cls._COORDINATE.fullmatch(name):
            raise Misfit(name, "expected speed, spread, or a coordinate such as q5 or v5")
        return Described(name, (float,), "rad" if name[0] == "q" else "rad/s", default=0.0)


class LimitRecord(Record):
    """What ground and motors can give, for a feasible walk."""

    SHORT = ""
    friction: float | None = field(
        "Friction of the ground; by default the robot's record.", None, gt=0, le=1
    )
    window: float = field("Over which the ground's force is averaged.", 5e-3, "s", gt=0, le=0.1)


class RunRecord(Record):
    """How far, from which seed, and by which numerics."""

    SHORT = ""
    impacts: int = field("To walk (12.5 steps of the paper are 25).", 25, ge=1, le=10000)
    first_step: int = field("Number of the first single support.", 1, ge=1, le=100000)
    seed: int = field("Of all that is drawn.", 0, ge=0, le=MOST_SEED)
    method: Literal["rk4", "exponential", "adaptive", "stiff"] | None = field(
        "Of integration; by default what fits the walker.", None
    )
    h: float | None = field(
        "Step of rk4 and exponential; by default 1 ms or what fits.", None, "s", ge=1e-6, le=0.1
    )
    fine: float | None = field(
        "The step where a push switches and in the single support after.",
        None,
        "s",
        ge=1e-6,
        le=0.1,
    )
    tolerance: float = field("Of adaptive and stiff.", 1e-9, gt=0, le=1)
    engine: Literal["compiled", "pinocchio"] = field(
        "compiled where it can run, or pinocchio, which it is checked against.", "compiled"
    )
    max_step_time: float = field("A longer single support ends as stalled.", 2.0, "s", gt=0, le=100)
    runaway_speed: float = field(
        "Rates beyond this multiple of the URDF's limits end a walk as run away.",
        20.0,
        gt=0,
        le=1e9,
    )
    runaway_torque: float = field(
        "The same of the peak torque in the robot's record.", 1000.0, gt=0, le=1e9
    )

    @model_validator(mode="after")
    def _own_step(self) -> Self:
        if self.method in FREE and (step := self.h or self.fine) is not None:
            raise Misfit(
                "h", f"is {step:g} s, and method '{self.method}' chooses its own; leave it out"
            )
        return self


class Scenario(Record):
    """One walk in plain values, in records by what they are of; see the module.

    A record may be given as a mapping, or as a text for its name. Lengths are in m, angles in rad, times in s,
    torques in N m, or text with a unit. `replace` changes some values and keeps the others.

    Raises InputError for an unknown name, a value out of its range, and one that cannot have an effect.
    """

    SHORT = "controller"
    controller: ControllerRecord = field("", ControllerRecord())
    robot: RobotRecord = field("", RobotRecord())
    gait: GaitRecord = field("", GaitRecord())
    hardware: HardwareRecord = field("", HardwareRecord())
    pushes: tuple[Push, ...] = field("", ())
    errors: ErrorRecord = field("", ErrorRecord())
    ground: GroundRecord = field("", GroundRecord())
    start: StartRecord = field("", StartRecord.model_construct())
    limits: LimitRecord = field("", LimitRecord())
    run: RunRecord = field("", RunRecord())

    def __init__(self, controller: object = None, **values: object) -> None:
        named = {} if controller is None else {"controller": controller}
        super().__init__(**nested({**named, **values}))

    @field_validator("pushes", mode="before")
    @classmethod
    def _parsed(cls, x: Any) -> Any:
        """Pushes from their texts, from one record, and from records by number."""
        if isinstance(x, str):
            x = re.split(r"\s+(?=[^\s@=]+=)", x.strip())
        elif isinstance(x, Mapping):
            numbered = all(name.isdigit() for name in x)
            x = [x[name] for name in sorted(x, key=int)] if numbered else [x]
        elif isinstance(x, Push):
            x = [x]
        if not isinstance(x, list | tuple):
            raise ValueError(f"found {x!r}, expected pushes in a list")
        return tuple(parse_push(y) if isinstance(y, str) else y for y in x)

    @model_validator(mode="after")
    def _acting(self) -> Self:
        """Raise Misfit for a push that cannot act, and for parts of the controller that need sampled time."""
        first, last = self.run.first_step, self.run.first_step + self.run.impacts - 1
        for i, push in enumerate(self.pushes):
            late = push.step > last
            if late or (push.step < first and push.shape != "step" and not push.over_impacts):
                walked = f"the walk has the single supports {first} to {last}"
                raise Misfit(f"pushes.{i}.step", f"is {push.step}, and {walked}: it cannot act")
        law = self.controller
        for name, given in (("contact", law.contact.name), ("prediction", law.prediction)):
            if given and self.hardware.period is None:
                raise Misfit(f"controller.{name}", "needs sampled time; give hardware.period too")
        if self.hardware.delay_known and law.prediction > 0.0:
            raise Misfit("hardware.delay_known", "counts the delay twice beside a prediction")
        return self

    @property
    def key(self) -> str:
        """A name for this scenario in stores of results: a hash of its record, equal for equal values."""
        text = json.dumps(self.record(), sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:32]


def scenario_of(record: Mapping[str, object]) -> Scenario:
    """The scenario of values by dotted name, or nested. Raises InputError."""
    return Scenario(**{str(name): x for name, x in record.items()})


def value_of(name: str, x: object) -> Any:
    """A value as the scenario takes it, also from text with a unit.

    Raises InputError for an unknown name and a value out of its range.
    """
    what = field_of(name)
    try:
        found = read(what, plain(x))
        what.check(found)
    except ValueError as error:
        raise Misfit(name, str(error)) from None
    return found


def names() -> list[str]:
    """Dotted names of all values; "0" in a name stands for the number of a push."""
    return names_of(Scenario)


def field_of(name: str) -> Described:
    """Type, unit, range, default and text of a value by its dotted name.

    Raises InputError with the nearest names.
    """
    return described_in(Scenario, name)


DRAWN = (
    *("start", "onset", "joints", "noise", "sensors", "model", "impact", "ground", "sensor"),
    "touchdown",
)
"""What is random in a walk. The place in this list selects the stream, so new names go to its end.

start: offsets of coordinates and speed. onset: time of a push. joints: factors of a push on random joints.
noise: a push that is noise. sensors: noise of encoders. model: errors of masses, centres, inertias and
friction. impact: error of the impact map. ground: heights of uneven ground. sensor: noise of the one that is
named by `sensor`, apart from that of the encoders. touchdown: which ones are missed.
"""


def drawn(s: Scenario, what: str, item: int = 0) -> int:
    """A 63-bit seed for one purpose of `DRAWN`, from the scenario's seed; item: number of a push.

    The streams are independent: a scenario with one random thing more keeps the draws of all others, so that
    two scenarios differ by what was changed and not by luck.
    """
    key = (DRAWN.index(what), item) if item else (DRAWN.index(what),)
    words = np.random.SeedSequence(s.run.seed, spawn_key=key).generate_state(1, np.uint64)
    return int(words[0] >> np.uint64(1))
