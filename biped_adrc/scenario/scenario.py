"""A scenario: one walk in plain values, what a study varies, a command is given, a run stores and walks again.

Every value has a unit and a range, and is refused by name outside of it. Nothing is random but by `seed`.
"""

from __future__ import annotations

import hashlib
import json
import math
import re
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from pydantic import ConfigDict, field_validator, model_validator
from pydantic.dataclasses import dataclass

from biped_adrc.scenario.push import Push, parse_push
from biped_adrc.scenario.registry import find, spelled
from biped_adrc.scenario.values import clear, value

HARDWARE: dict[str, dict[str, Any]] = {
    "none": {},
    "ideal": {"period": 1e-3},
    "rabbit": {
        "period": 1.5e-3,
        "counts": 8192.0,
        "velocity": "differences",
        "torque_limit": 150.0,
        "friction": True,
    },
}
"""Continuous time; exact at 1 kHz; and sampling, encoders, torque and friction published for RABBIT
(Chevallereau et al., IEEE Control Systems Magazine 2003; Westervelt, Buche, Grizzle, IJRR 2004), whose rotors
are in the preset 'identified'."""
MOST_SEED = 2**63 - 1
"""What a file of results can hold."""
CHOICES: dict[str, tuple[str, ...]] = {
    "reset": ("none", "relabel", "measured", "model"),
    "hardware": tuple(HARDWARE),
    "velocity": ("measured", "differences", "gyro"),
    "method": ("rk4", "exponential", "feedback", "adaptive", "stiff"),
    "engine": ("pinocchio", "compiled"),
}
"""By field."""
NAMED = {"controller": "controller", "observer": "observer", "push": "disturbance"}
"""Fields that name a thing of the registry, and its kind."""
FREE = ("adaptive", "stiff")
"""Methods that choose their own steps."""


@clear(lambda values: HARDWARE.get(str(values.get("hardware", "none")), {}))
@dataclass(frozen=True, config=ConfigDict(extra="forbid", allow_inf_nan=False))
class Scenario:
    """One walk. `hardware` fills in what is not given of sampling, sensors and motors.

    Raises InputError for an unknown name, a value out of its range, and one that would do nothing.
    """

    # who walks, how far
    controller: str = value("ADRC", "Controller of the registry, or module:Class.")
    robot: str = value(
        "rabbit", "Robot by name ('biped-adrc robot list'), or the path of a robot.toml."
    )
    preset: str | None = value(None, "Parameters of the robot; its record's default if not given.")
    gait: str = value(
        "published",
        "published (through x*), recipe (section IV), v0.4 to v1.1 (by speed), or a .json file.",
    )
    impacts: int = value(25, "Impacts to walk (12.5 steps of the paper are 25).", ge=1, le=10_000)
    first_step: int = value(1, "Number of the first single support.", ge=1, le=100_000)
    continued: bool = value(False, "The constraint goes on smoothly past its ends.")
    seed: int = value(0, "Of all that is drawn.", ge=0, le=MOST_SEED)
    # controller
    K_p: float | None = value(
        None, "Proportional gain; the controller's own without.", "1/s^2", gt=0
    )
    K_d: float | None = value(None, "Derivative gain; the controller's own without.", "1/s", gt=0)
    observer: str | None = value(
        None, "Observer of the registry, or module:Class; the controller's own without."
    )
    poles: tuple[float, ...] | None = value(
        None, "m + 2 observer poles, comma separated; the controller's own without.", "rad/s"
    )
    bandwidth: float | None = value(
        None,
        "All observer poles at minus this; the controller's own without.",
        "rad/s",
        gt=0,
        le=1e6,
    )
    order: int | None = value(None, "m of the observer, with a bandwidth.", ge=0, le=12)
    reset: str = value("model", "Observer at impact: none, relabel, measured or model.")
    solve_theta: bool = value(True, "Solve the loop through Theta''; as printed without.")
    own: dict[str, Any] = value(
        {}, "What a controller, observer or disturbance takes beside these, by name."
    )
    # sampling, sensors, motors
    hardware: str = value(
        "none", "Where the values of this part come from: none, ideal (1 kHz) or rabbit."
    )
    period: float | None = value(
        None, "Sampling period of the controller; continuous without.", "s", ge=1e-5, le=0.1
    )
    delay: float = value(0.0, "From a tick to the torque's effect.", "s", ge=0, le=1.0)
    delay_known: bool = value(False, "Whether the observer knows the delay.")
    counts: float | None = value(None, "Encoder counts per revolution; exact without.", ge=1)
    noise: float = value(0.0, "Standard deviation of the joints' angles.", "rad", ge=0, le=1.0)
    pitch_noise: float = value(0.0, "That of the unactuated pitch.", "rad", ge=0, le=1.0)
    rate_noise: float = value(0.0, "That of rates that are measured.", "rad/s", ge=0, le=100.0)
    velocity: str = value(
        "measured", "Rates: exact, from differences of angles, or so but for the pitch's."
    )
    filter_time: float = value(0.0, "Low-pass of the differences.", "s", ge=0, le=1.0)
    torque_limit: float | None = value(None, "Of every motor.", "N m", gt=0)
    rate_limit: float | None = value(None, "Of every motor's torque.", "N m/s", gt=0)
    lag: float = value(0.0, "Time constant of the motors.", "s", ge=0, le=1.0)
    friction: bool = value(False, "Joint friction of the robot's record in the plant.")
    # pushes
    pushes: tuple[Push, ...] = value(
        (), "JOINTS=TORQUE@STEP:START-STOP, one after the other.", "N m"
    )
    push: str = value(
        "none", "One more, by its shape in time: pulse, step, sine, noise, or module:Class."
    )
    on: str = value(
        "q1,q2,q3,q4", "Joints such as 'q1,-q3', 'random joints', or 'link NAME' for the force."
    )
    amplitude: float = value(0.0, "Torque on each joint.", "N m", ge=0, le=1e5)
    force: float = value(0.0, "Force on a link, or on the hip.", "N", ge=0, le=1e5)
    direction: float = value(0.0, "Of a force, from forwards to up.", "rad", ge=-7, le=7)
    pushed_step: int = value(3, "Single support in which it begins.", ge=1, le=100_000)
    onset: float | None = value(
        None, "In that step; drawn without, to end with it.", "s", ge=0, le=2
    )
    duration: float = value(0.2, "Of a pulse, a sine or noise.", "s", gt=0, le=100.0)
    frequency: float = value(5.0, "Of a sine; the highest of noise.", "Hz", gt=0, le=1000.0)
    # the plant is not the model
    mass: dict[str, float] = value({}, "Factors of the plant's bodies, by body.")
    inertia: dict[str, float] = value({}, "The same of inertias.")
    mass_error: float = value(0.0, "Half-width of relative errors drawn for bodies.", ge=0, lt=1)
    com_error: float = value(0.0, "The same for centres of mass.", ge=0, lt=1)
    inertia_error: float = value(0.0, "The same for inertias.", ge=0, lt=1)
    friction_error: float = value(0.0, "The same for friction.", ge=0, lt=1)
    trunk_load: float = value(0.0, "Relative error of the torso's mass, not drawn.", gt=-1, le=10)
    impact_error: float = value(
        0.0, "Half-width of relative errors of rates after impact.", ge=0, lt=1
    )
    # ground
    slope: float = value(0.0, "Downhill, beside the gait's own.", "rad", ge=-0.5, le=0.5)
    ground_step: float = value(
        0.0, "The ground falls by this in the pushed step.", "m", ge=-0.2, le=0.2
    )
    ground_rms: float = value(0.0, "Unevenness, drawn.", "m", ge=0, le=0.1)
    # start
    start: dict[str, float] = value(
        {}, "Added to the start, by coordinate: q1.. [rad], v1.. [rad/s]."
    )
    start_speed: float = value(0.0, "Relative change of all rates.", gt=-1, le=2)
    start_speed_spread: float = value(0.0, "Standard deviation of it, drawn.", ge=0, le=1)
    start_spread: float = value(0.0, "Standard deviation added to all angles.", "rad", ge=0, le=1)
    start_rate_spread: float = value(0.0, "The same for rates.", "rad/s", ge=0, le=10)
    # what ground and motors can give
    friction_limit: float | None = value(
        None, "Friction of the ground for a legal walk; the robot's record without.", gt=0, le=1
    )
    force_window: float = value(
        5e-3, "Over which the force of the ground is averaged for that.", "s", gt=0, le=0.1
    )
    # numerics
    method: str | None = value(
        None, "rk4, exponential, feedback, adaptive or stiff; what fits the walker without."
    )
    h: float | None = value(
        None,
        "Step of rk4, exponential and feedback; 1 ms or what fits without.",
        "s",
        ge=1e-6,
        le=0.1,
    )
    fine: float | None = value(
        None,
        "The step where a push switches and in the single support after.",
        "s",
        ge=1e-6,
        le=0.1,
    )
    tolerance: float = value(1e-9, "Of adaptive and stiff.", gt=0, le=1)
    engine: str = value(
        "compiled", "compiled where it can run, or pinocchio, which it is checked against."
    )
    max_step_time: float = value(2.0, "A longer single support ends as stalled.", "s", gt=0, le=100)

    @field_validator("pushes", mode="before")
    @classmethod
    def _parsed(cls, given: Any) -> Any:
        texts = given.split() if isinstance(given, str) else given
        return tuple(parse_push(x) if isinstance(x, str) else x for x in texts)

    @field_validator("poles", mode="before")
    @classmethod
    def _numbers(cls, given: Any) -> Any:
        if not isinstance(given, str):
            return given
        try:
            return tuple(float(word) for word in given.split(","))
        except ValueError:
            raise ValueError("expected numbers separated by commas") from None

    @field_validator("start")
    @classmethod
    def _coordinates(cls, start: dict[str, float]) -> dict[str, float]:
        wrong = [key for key in start if not re.fullmatch("[qv][1-9][0-9]*", key, re.ASCII)]
        if wrong:
            raise ValueError(f"start names {wrong}, expected coordinates such as 'q5' or 'v5'")
        return {key: x for key, x in sorted(start.items()) if x != 0.0}

    @field_validator(*CHOICES)
    @classmethod
    def _chosen(cls, given: str | None, info: Any) -> str | None:
        choices = CHOICES[info.field_name]
        if given is not None and given not in choices:
            raise ValueError(f"found '{given}', expected one of {list(choices)}")
        return given

    @field_validator(*NAMED)
    @classmethod
    def _spelled(cls, name: str | None, info: Any) -> str | None:
        """As the registry spells it; whether there is a controller or an observer is seen when it is made."""
        if name is None or name == "none":
            return name
        if info.field_name == "push":
            find("disturbance", name)
        return spelled(NAMED[info.field_name], name)

    @model_validator(mode="after")
    def _effective(self) -> Scenario:
        """Raise ValueError for a value that would do nothing."""
        found = [what for what, is_so in self._idle().items() if is_so]
        if found:
            raise ValueError(f"{'; '.join(found)}: this would do nothing, leave one of them out")
        if self.method in FREE and (step := self.h or self.fine) is not None:
            raise ValueError(
                f"method '{self.method}' chooses its own step; leave out h = {step:g} s"
            )
        return self

    def _idle(self) -> dict[str, bool]:
        pushed, last = self.push != "none", self.first_step + self.impacts - 1
        return {
            "amplitude or force without a push": not pushed and self.amplitude + self.force > 0.0,
            "friction_error without friction": self.friction_error > 0.0 and not self.friction,
            "filter_time with rates that are measured": self.filter_time > 0.0
            and self.velocity == "measured",
            "rate_noise with rates from differences": self.rate_noise > 0.0
            and self.velocity == "differences",
            f"pushed_step = {self.pushed_step} of {last} steps": self.pushed_step > last
            and (pushed or self.ground_step != 0.0),
            "poles and a bandwidth": self.poles is not None and self.bandwidth is not None,
            "a tolerance without the method adaptive or stiff": self.tolerance != 1e-9
            and self.method not in FREE,
        }

    def record(self) -> dict[str, Any]:
        """The values that differ from the defaults and from what `hardware` fills in, by name, plain."""
        usual = {**DEFAULTS, **HARDWARE[self.hardware]}
        found = {name: x for name, x in sorted(asdict(self).items()) if x != usual[name]}
        if self.pushes:
            found["pushes"] = [_told(push) for push in found["pushes"]]
        return found | ({} if self.poles is None else {"poles": list(self.poles)})

    @property
    def key(self) -> str:
        """A name for this scenario: two with the same values have the same."""
        text = json.dumps(self.record(), sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:32]


FIELDS: Mapping[str, Any] = Scenario.__pydantic_fields__  # type: ignore[attr-defined]
"""By name, with description, unit and range."""
DEFAULTS: dict[str, Any] = {
    name: x.get_default(call_default_factory=True) for name, x in FIELDS.items()
}
UNITS: dict[str, str] = {name: str(x.json_schema_extra["unit"]) for name, x in FIELDS.items()}
"""By field."""


def _told(push: dict[str, Any]) -> dict[str, Any]:
    """Without what is not finite, the stop of a step for good, which no file of plain values has."""
    return {name: x for name, x in push.items() if not (name == "stop" and math.isinf(x))}
