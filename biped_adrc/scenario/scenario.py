"""A scenario: one walk in plain values, what a study varies, a command is given, a run stores and walks again.

Every value has a unit and a range, and is refused by name outside of it. Nothing is random but by `seed`.
"""

from __future__ import annotations

import hashlib
import json
import math
import re
from collections.abc import Mapping
from dataclasses import asdict, field
from typing import Any

import numpy as np
from pydantic import ConfigDict, field_validator, model_validator
from pydantic.dataclasses import dataclass

from biped_adrc.resources import packaged
from biped_adrc.scenario.push import Push, parse_push
from biped_adrc.scenario.registry import find, portable, spelled
from biped_adrc.scenario.values import clear, described
from biped_adrc.shown import Shown

HARDWARE: dict[str, dict[str, Any]] = packaged("biped_adrc.scenario", "hardware.toml")
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
OF_PUSH = ("on", "direction", "onset", "duration", "frequency")
"""Values of the push named by `push`."""
OF_SAMPLING = (
    *("delay", "delay_known", "counts", "noise", "pitch_noise", "rate_noise"),
    *("velocity", "filter_time", "rate_limit", "lag"),
)
"""Values that are there in sampled time only."""
FREE = ("adaptive", "stiff")
"""Methods that choose their own steps."""


@clear(lambda values: HARDWARE.get(str(values.get("hardware", "none")), {}))
@dataclass(frozen=True, config=ConfigDict(extra="forbid", allow_inf_nan=False))
@described("scenario.toml")
class Scenario(Shown):
    """One walk. `hardware` fills in what is not given of sampling, sensors and motors.

    Raises InputError for an unknown name, a value out of its range, and one that would do nothing.
    """

    # who walks, how far
    controller: str = "ADRC"
    robot: str = "rabbit"
    preset: str | None = None
    gait: str = "published"
    impacts: int = 25
    first_step: int = 1
    continued: bool = False
    seed: int = 0
    # controller
    K_p: float | None = None
    K_d: float | None = None
    observer: str | None = None
    poles: tuple[float, ...] | None = None
    bandwidth: float | None = None
    order: int | None = None
    reset: str = "model"
    solve_theta: bool = True
    own: dict[str, Any] = field(default_factory=dict)
    # sampling, sensors, motors
    hardware: str = "none"
    period: float | None = None
    delay: float = 0.0
    delay_known: bool = False
    counts: float | None = None
    noise: float = 0.0
    pitch_noise: float = 0.0
    rate_noise: float = 0.0
    velocity: str = "measured"
    filter_time: float = 0.0
    torque_limit: float | None = None
    rate_limit: float | None = None
    lag: float = 0.0
    friction: bool = False
    # pushes
    pushes: tuple[Push, ...] = ()
    push: str = "none"
    on: str = "q1,q2,q3,q4"
    amplitude: float = 0.0
    force: float = 0.0
    direction: float = 0.0
    pushed_step: int = 3
    onset: float | None = None
    duration: float = 0.2
    frequency: float = 5.0
    # the plant is not the model
    mass: dict[str, float] = field(default_factory=dict)
    inertia: dict[str, float] = field(default_factory=dict)
    mass_error: float = 0.0
    com_error: float = 0.0
    inertia_error: float = 0.0
    friction_error: float = 0.0
    trunk_load: float = 0.0
    impact_error: float = 0.0
    # ground
    slope: float = 0.0
    ground_step: float = 0.0
    ground_rms: float = 0.0
    # start
    start: dict[str, float] = field(default_factory=dict)
    start_speed: float = 0.0
    start_speed_spread: float = 0.0
    start_spread: float = 0.0
    start_rate_spread: float = 0.0
    # what ground and motors can give
    friction_limit: float | None = None
    force_window: float = 5e-3
    # numerics
    method: str | None = None
    h: float | None = None
    fine: float | None = None
    tolerance: float = 1e-9
    engine: str = "compiled"
    max_step_time: float = 2.0

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
            raise ValueError(f"found {given!r}, expected numbers separated by commas") from None

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
            **{f"{name} without a push": not pushed and self._given(name) for name in OF_PUSH},
            **{
                f"{name} without a period": self.period is None and self._given(name)
                for name in OF_SAMPLING
            },
            "friction_error without friction": self.friction_error > 0.0 and not self.friction,
            "filter_time with rates that are measured": self.filter_time > 0.0
            and self.velocity == "measured",
            "rate_noise with rates from differences": self.rate_noise > 0.0
            and self.velocity == "differences",
            f"pushed_step = {self.pushed_step} of {last} steps": self.pushed_step > last
            and (pushed or self.ground_step != 0.0),
            f"pushed_step = {self.pushed_step} before first_step = {self.first_step}": (
                self.pushed_step < self.first_step
                and (self.push == "pulse" or self.ground_step != 0.0)
            ),
            "poles and an order": self.poles is not None and self.order is not None,
            "poles and a bandwidth": self.poles is not None and self.bandwidth is not None,
            "a tolerance without the method adaptive or stiff": self.tolerance != 1e-9
            and self.method not in FREE,
        }

    def _given(self, name: str) -> bool:
        return bool(getattr(self, name) != DEFAULTS[name])

    def record(self) -> dict[str, Any]:
        """The values that differ from the defaults and from what `hardware` fills in, by name, plain.

        What was registered in this process is written as module:Class, by which any other finds it.
        """
        usual = {**DEFAULTS, **HARDWARE[self.hardware]}
        found = {name: x for name, x in sorted(asdict(self).items()) if x != usual[name]}
        if self.pushes:
            found["pushes"] = [_told(push) for push in found["pushes"]]
        for name, kind in {**NAMED, "robot": "robot", "gait": "gait"}.items():
            if name in found:
                found[name] = portable(kind, found[name])
        return found | ({} if self.poles is None else {"poles": list(self.poles)})

    @property
    def key(self) -> str:
        """A name for this scenario: two with the same values have the same."""
        text = json.dumps(self.record(), sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:32]


DRAWN = ("start", "onset", "joints", "noise", "sensors", "model", "impact", "ground")
"""By its place here and the scenario's seed."""


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


def drawn(s: Scenario, what: str) -> int:
    """A seed for one of the things in `DRAWN`: one more of them changes none of the others."""
    sequence = np.random.SeedSequence(s.seed, spawn_key=(DRAWN.index(what),))
    words = sequence.generate_state(1, np.uint64)
    return int(words[0] >> np.uint64(1))
