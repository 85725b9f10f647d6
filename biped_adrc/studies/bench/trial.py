"""A trial: one walk of the bench in plain values, what a study varies, stores and runs again.

Every value has a unit and a range, and is refused by name outside of it. Nothing here is random but by `seed`.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator, model_validator

HARDWARE: dict[str, dict[str, Any]] = {
    "ideal": {},
    "rabbit": {
        "period": 1.5e-3,
        "counts": 8192.0,
        "velocity": "differences",
        "torque_limit": 150.0,
        "friction": True,
    },
}
"""Sampling, encoders, torque and friction published for RABBIT (Chevallereau et al., IEEE Control Systems
Magazine 2003; Westervelt, Buche, Grizzle, IJRR 2004); its rotors are in the preset 'identified'."""


MOST_SEED = 2**63 - 1
"""What a file of results can hold."""


def value(default: Any, text: str, unit: str = "1", **limits: float) -> Any:
    """A field with its description, unit and range."""
    return Field(default, description=text, json_schema_extra={"unit": unit}, **limits)  # type: ignore[call-overload]


class Trial(BaseModel):
    """One walk. `hardware` fills in what is not given of sampling, sensors and motors."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    # who walks, how far
    robot: str = value("rabbit", "Robot by name.")
    preset: str | None = value(None, "Parameters of the robot; its record's default if not given.")
    gait: str = value("published", "Stored gait by name.")
    impacts: int = value(25, "Foot strikes to walk.", ge=1, le=10_000)
    seed: int = value(0, "Of all that is drawn in this trial.", ge=0, le=MOST_SEED)
    # controller
    controller: str = value("ADRC", "Controller by its name in the bench.")
    K_p: float | None = value(
        None, "Proportional gain; the controller's own without.", "1/s^2", gt=0
    )
    K_d: float | None = value(None, "Derivative gain; the controller's own without.", "1/s", gt=0)
    bandwidth: float | None = value(
        None,
        "All observer poles at minus this; the controller's own without.",
        "rad/s",
        gt=0,
        le=1e6,
    )
    order: int | None = value(None, "m of the observer, with a bandwidth.", ge=0, le=12)
    reset: Literal["none", "relabel", "measured", "model"] = value("model", "Observer at impact.")
    # sampling, sensors, motors
    hardware: Literal["ideal", "rabbit"] = value(
        "ideal", "Where the values of this part come from."
    )
    period: float = value(1e-3, "Sampling period.", "s", ge=1e-5, le=0.1)
    delay: float = value(0.0, "From a tick to the torque's effect.", "s", ge=0, le=1.0)
    delay_known: bool = value(False, "Whether the observer knows the delay.")
    counts: float | None = value(None, "Encoder counts per revolution; exact without.", "1", ge=1)
    noise: float = value(0.0, "Standard deviation of the joints' angles.", "rad", ge=0, le=1.0)
    pitch_noise: float = value(0.0, "That of the unactuated pitch.", "rad", ge=0, le=1.0)
    rate_noise: float = value(0.0, "That of rates that are measured.", "rad/s", ge=0, le=100.0)
    velocity: Literal["measured", "differences", "gyro"] = value(
        "measured", "Rates: exact, from differences of angles, or so but for the pitch's."
    )
    filter_time: float = value(0.0, "Low-pass of the differences.", "s", ge=0, le=1.0)
    torque_limit: float | None = value(None, "Of every motor.", "N m", gt=0)
    rate_limit: float | None = value(None, "Of every motor's torque.", "N m/s", gt=0)
    lag: float = value(0.0, "Time constant of the motors.", "s", ge=0, le=1.0)
    friction: bool = value(False, "Joint friction of the robot's record in the plant.")
    # push
    push: Literal["none", "pulse", "step", "sine", "noise"] = value("none", "Its shape in time.")
    on: str = value(
        "q1,q2,q3,q4", "Joints such as 'q1,-q3', 'random joints', or 'link NAME' for the force."
    )
    amplitude: float = value(0.0, "Torque on each joint.", "N m", ge=0, le=1e5)
    force: float = value(0.0, "Force on a link.", "N", ge=0, le=1e5)
    direction: float = value(0.0, "Of a force, from forwards to up.", "rad", ge=-7, le=7)
    pushed_step: int = value(3, "Single support in which it begins.", ge=1, le=100_000)
    onset: float | None = value(
        None, "In that step; drawn without, to end with it.", "s", ge=0, le=2
    )
    duration: float = value(0.2, "Of a pulse, a sine or noise.", "s", gt=0, le=100.0)
    frequency: float = value(5.0, "Of a sine; the highest of noise.", "Hz", gt=0, le=1000.0)
    # the plant is not the model
    mass_error: float = value(
        0.0, "Half-width of relative errors drawn for bodies.", "1", ge=0, lt=1
    )
    com_error: float = value(0.0, "The same for centres of mass.", "1", ge=0, lt=1)
    inertia_error: float = value(0.0, "The same for inertias.", "1", ge=0, lt=1)
    friction_error: float = value(0.0, "The same for friction.", "1", ge=0, lt=1)
    trunk_load: float = value(
        0.0, "Relative error of the torso's mass, not drawn.", "1", gt=-1, le=10
    )
    impact_error: float = value(
        0.0, "Half-width of relative errors of rates after impact.", "1", ge=0, lt=1
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
    start_speed: float = value(0.0, "Relative change of all rates.", "1", gt=-1, le=2)
    start_speed_spread: float = value(0.0, "Standard deviation of it, drawn.", "1", ge=0, le=1)
    start_spread: float = value(0.0, "Standard deviation added to all angles.", "rad", ge=0, le=1)
    start_rate_spread: float = value(0.0, "The same for rates.", "rad/s", ge=0, le=10)
    # what ground and motors can give
    friction_limit: float | None = value(
        None,
        "Friction of the ground for a legal walk; the robot's record without.",
        "1",
        gt=0,
        le=1,
    )
    force_window: float = value(
        5e-3, "Over which the force of the ground is averaged for that.", "s", gt=0, le=0.1
    )
    # numerics
    h: float = value(1e-3, "Longest step of RK4 between ticks.", "s", ge=1e-6, le=5e-3)
    max_step_time: float = value(2.0, "A longer single support ends as stalled.", "s", gt=0, le=100)

    @model_validator(mode="before")
    @classmethod
    def _filled(cls, given: Any) -> Any:
        if isinstance(given, Mapping):
            return {**HARDWARE.get(str(given.get("hardware", "ideal")), {}), **given}
        return given

    @field_validator("start")
    @classmethod
    def _coordinates(cls, start: dict[str, float]) -> dict[str, float]:
        wrong = [key for key in start if not re.fullmatch("[qv][1-9][0-9]*", key, re.ASCII)]
        if wrong:
            raise ValueError(f"start names {wrong}, expected coordinates such as 'q5' or 'v5'")
        return {key: x for key, x in sorted(start.items()) if x != 0.0}

    @model_validator(mode="after")
    def _effective(self) -> Trial:
        """Raise ValueError for a value that would do nothing."""
        pushed = self.push != "none"
        idle = {
            "amplitude or force without a push": not pushed and self.amplitude + self.force > 0.0,
            "friction_error without friction": self.friction_error > 0.0 and not self.friction,
            "filter_time with rates that are measured": self.filter_time > 0.0
            and self.velocity == "measured",
            "rate_noise with rates from differences": self.rate_noise > 0.0
            and self.velocity == "differences",
            f"pushed_step = {self.pushed_step} of {self.impacts} steps": self.pushed_step
            > self.impacts
            and (pushed or self.ground_step != 0.0),
        }
        found = [what for what, is_so in idle.items() if is_so]
        if found:
            raise ValueError(f"{'; '.join(found)}: this would do nothing, leave one of them out")
        return self

    def record(self) -> dict[str, Any]:
        """The values that differ from the defaults and from what `hardware` fills in, by name."""
        usual = {**_defaults(), **HARDWARE[self.hardware]}
        return {name: x for name, x in sorted(self.model_dump().items()) if x != usual[name]}

    @property
    def key(self) -> str:
        """A name for this trial: two with the same values have the same."""
        text = json.dumps(self.record(), sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:32]


def reason(error: Exception) -> str:
    """What an error says; of a trial's own the first thing that is wrong, without the validator's ornaments."""
    if not isinstance(error, ValidationError):
        return str(error)
    found = error.errors()[0]
    name = "".join(f"{part}: " for part in found["loc"])
    return f"{name}{found['msg'].removeprefix('Value error, ')}"


def _defaults() -> dict[str, Any]:
    return {name: info.get_default() for name, info in Trial.model_fields.items()}


UNITS: dict[str, str] = {
    name: str((info.json_schema_extra or {}).get("unit", "1"))  # type: ignore[union-attr]
    for name, info in Trial.model_fields.items()
}
"""By field."""
