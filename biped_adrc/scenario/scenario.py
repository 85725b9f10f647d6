"""A scenario: one walk in plain values, with defaults, units and ranges.

It is what a study varies, what the options of the command line are made from, what a stored walk carries, and
what a worker process receives. Text, unit and range of each value are in `scenario.toml`; types and defaults
are the fields of `Scenario`. A value out of its range, a name that is unknown, and a value that would have no
effect (a push direction without a push) are refused by name when the scenario is made, before anything is
simulated.

Everything random is drawn from `seed`, one stream per purpose (`drawn`), so that the same scenario gives the
same walk in any process. `build` makes the walker; the hash `Scenario.key` names a scenario in stores of
results.
"""

from __future__ import annotations

import hashlib
import json
import math
import re
from collections.abc import Iterable, Mapping
from copy import deepcopy
from dataclasses import asdict, field
from typing import Any

import numpy as np
from pydantic import ConfigDict, ValidationInfo, field_validator, model_validator
from pydantic.dataclasses import dataclass
from pydantic.fields import FieldInfo

from biped_adrc.resources import packaged
from biped_adrc.scenario.push import Push, parse_push
from biped_adrc.scenario.registry import find, portable, spelled
from biped_adrc.scenario.values import clear, described, units_of
from biped_adrc.shown import Shown

HARDWARE: dict[str, dict[str, object]] = packaged("biped_adrc.scenario", "hardware.toml")
"""Values that `hardware` fills in, by its name: none, continuous time; ideal, exact measurements at 1 kHz;
rabbit, sampling, encoders, torque and friction published for RABBIT (Chevallereau et al., IEEE Control Systems
Magazine 2003; Westervelt, Buche, Grizzle, IJRR 2004), whose rotors are in the preset 'identified'."""
MOST_SEED = 2**63 - 1
"""Largest seed: the largest integer that a file of results can hold."""
CHOICES: dict[str, tuple[str, ...]] = {
    "reset": ("none", "relabel", "measured", "model"),
    "hardware": tuple(HARDWARE),
    "velocity": ("measured", "differences", "gyro"),
    "method": ("rk4", "exponential", "adaptive", "stiff"),
    "engine": ("pinocchio", "compiled"),
}
"""Values that a field may have, by field.

reset: what becomes of the observer at impact. none: nothing. relabel: the states of the legs swap. measured: as
relabel, with angles and rates from the measurement. model: as at the start, xi^ from the nominal model.

velocity: where rates come from in sampled time. measured: exactly, with noise. differences: of encoder angles.
gyro: differences, but for the rate of the pitch.

method: of integration. rk4: fixed step. exponential: ETD-RK4 with the observer's linear part solved exactly.
adaptive: explicit with step control. stiff: Radau IIA of order 5, implicit. Both run in Python, by SciPy.

engine: compiled runs machine code made from the methods; pinocchio runs the methods in Python, with
Pinocchio's model.
"""
NAMED = {
    "controller": "controller",
    "observer": "observer",
    "contact": "contact",
    "sensor": "sensor",
    "touchdown": "touchdown",
    "push": "disturbance",
    "plant": "plant",
}
"""Fields whose value is a name of the registry, and its kind there."""
OF_PUSH = ("on", "direction", "onset", "duration", "frequency")
"""Fields that describe the push named by `push`, without which they have no effect."""
OF_PLANT = ("ground_friction", "time_constant", "damping_ratio", "plant_step")
"""Fields of a plant other than the rigid one."""
OF_RIGID = ("method", "h", "fine", "impact_error")
"""Fields that have an effect on the rigid plant alone."""
OF_SAMPLING = (
    *("delay", "delay_known", "counts", "noise", "pitch_noise", "rate_noise"),
    *("velocity", "filter_time", "sensor", "rate_limit", "lag", "contact"),
    *("touchdown", "prediction"),
)
"""Fields that have an effect in sampled time only."""
FREE = ("adaptive", "stiff")
"""Integration methods that choose their own step."""


@clear(lambda values: HARDWARE.get(str(values.get("hardware", "none")), {}))
@dataclass(frozen=True, config=ConfigDict(extra="forbid", allow_inf_nan=False))
@described("scenario.toml")
class Scenario(Shown):
    """One walk in plain values; see `scenario.toml` for the text, unit and range of each field.

    Fields come in groups: who walks and how far; the controller and its observer; sampling, sensors and motors;
    pushes; errors of the model (the plant is not the robot that the controller knows); ground; start; what
    ground and motors can give; numerics. Lengths are in m, angles in rad, times in s, torques in N m.

        s = ba.Scenario("ADRC", hardware="rabbit", pushes="q1,q2=30@3:0.1-0.3", impacts=8)
        walk = ba.walk_scenario(s)

    `hardware` fills in what is not given of sampling, sensors and motors; a value that is given wins. What a
    controller, observer or push takes beside the fields goes into `own` by name. With dataclasses.replace a
    study varies one field and keeps the others.

    Raises InputError for an unknown name, a value out of its range, and one that would have no effect.
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
    contact: str | None = None
    contact_window: float | None = None
    prediction: float = 0.0
    feedforward: float = 0.0
    solve_theta: bool = True
    own: dict[str, object] = field(default_factory=dict)
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
    sensor: str | None = None
    touchdown: str | None = None
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
    plant: str = "rigid"
    ground_friction: float = 0.6
    time_constant: float = 2e-3
    damping_ratio: float = 1.0
    plant_step: float | None = None
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
    runaway_speed: float = 20.0
    runaway_torque: float = 1000.0

    @field_validator("pushes", mode="before")
    @classmethod
    def _parsed(cls, given: str | Iterable[object]) -> tuple[object, ...]:
        """Pushes from their texts, which a command line separates by spaces."""
        texts = given.split() if isinstance(given, str) else given
        return tuple(parse_push(x) if isinstance(x, str) else x for x in texts)

    @field_validator("poles", mode="before")
    @classmethod
    def _numbers(cls, given: object) -> object:
        """Poles from their text, which a command line separates by commas."""
        if not isinstance(given, str):
            return given
        try:
            return tuple(float(word) for word in given.split(","))
        except ValueError:
            raise ValueError(f"found {given!r}, expected numbers separated by commas") from None

    @field_validator("start")
    @classmethod
    def _coordinates(cls, start: dict[str, float]) -> dict[str, float]:
        """Additions to the start, sorted and without zeros, so that equal scenarios have equal keys."""
        wrong = [key for key in start if not re.fullmatch("[qv][1-9][0-9]*", key, re.ASCII)]
        if wrong:
            raise ValueError(f"start names {wrong}, expected coordinates such as 'q5' or 'v5'")
        return {key: x for key, x in sorted(start.items()) if x != 0.0}

    @field_validator(*CHOICES)
    @classmethod
    def _chosen(cls, given: str | None, info: ValidationInfo) -> str | None:
        """A value of CHOICES. Raises ValueError with those that there are."""
        choices = CHOICES[str(info.field_name)]
        if given is not None and given not in choices:
            raise ValueError(f"found '{given}', expected one of {list(choices)}")
        return given

    @field_validator(*NAMED)
    @classmethod
    def _spelled(cls, name: str | None, info: ValidationInfo) -> str | None:
        """The name as the registry spells it, whatever its capitals.

        A controller or an observer is looked up only when the walker is built: the user's module may not be at
        hand where a scenario is merely read.
        """
        if name is None or name == "none":
            return name
        if info.field_name in ("push", "plant"):
            find(NAMED[info.field_name], name)
        return spelled(NAMED[str(info.field_name)], name)

    @model_validator(mode="after")
    def _effective(self) -> Scenario:
        """Raise ValueError for a value that would have no effect, or a step given to a method that chooses its
        own.
        """
        found = [what for what, is_so in self._idle().items() if is_so]
        if found:
            raise ValueError(f"{'; '.join(found)}: this would do nothing, leave one of them out")
        if self.method in FREE and (step := self.h or self.fine) is not None:
            raise ValueError(
                f"method '{self.method}' chooses its own step; leave out h = {step:g} s"
            )
        return self

    def _idle(self) -> dict[str, bool]:
        """For each combination of values in which one has no effect, in words: whether it is the case here."""
        pushed, last = self.push != "none", self.first_step + self.impacts - 1
        rigid, on = self.plant == "rigid", f"with the plant '{self.plant}'"
        groups = (
            (not pushed, "without a push", OF_PUSH),
            (self.period is None, "without a period", OF_SAMPLING),
            (rigid, "with the plant 'rigid'", OF_PLANT),
            (not rigid, on, OF_RIGID),
        )
        return {
            "amplitude or force without a push": not pushed and self.amplitude + self.force > 0.0,
            **{
                f"{name} {why}": lacks and self.given(name)
                for lacks, why, of in groups
                for name in of
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
            "fine with a touchdown": self.touchdown is not None and self.fine is not None,
            "a contact_window without contact": self.contact is None
            and self.contact_window is not None,
            "delay_known with a prediction, which tells the observer of the delay": self.delay_known
            and self.prediction > 0.0,
            "poles and an order": self.poles is not None and self.order is not None,
            "poles and a bandwidth": self.poles is not None and self.bandwidth is not None,
            "a tolerance without the method adaptive or stiff": self.tolerance != 1e-9
            and self.method not in FREE,
        }

    def given(self, name: str) -> bool:
        """True where a field differs from its default."""
        return bool(getattr(self, name) != DEFAULTS[name])

    def record(self) -> dict[str, Any]:
        """The values that differ from the defaults and from what `hardware` fills in, by name, as JSON has
        them.

        `Scenario(**record)` gives the scenario back. What was registered in this process is written as
        module:Class, by which any other process finds it.
        """
        usual = {**DEFAULTS, **HARDWARE[self.hardware]}
        given = ((name, getattr(self, name)) for name in sorted(FIELDS))
        found = {name: deepcopy(x) for name, x in given if x != usual[name]}
        if self.pushes:
            found["pushes"] = [_told(asdict(push)) for push in found["pushes"]]
        for name, kind in {**NAMED, "robot": "robot", "gait": "gait"}.items():
            if name in found:
                found[name] = portable(kind, found[name])
        return found | ({} if self.poles is None else {"poles": list(self.poles)})

    @property
    def key(self) -> str:
        """A name for this scenario in stores of results: a hash of its record, equal for equal values."""
        text = json.dumps(self.record(), sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:32]


DRAWN = (
    *("start", "onset", "joints", "noise", "sensors", "model", "impact", "ground", "sensor"),
    "touchdown",
)
"""What is random in a walk. The place in this list selects the stream, so new names go to its end.

start: offsets of coordinates and speed. onset: time of the push. joints: factors of a push on random joints.
noise: the push that is noise. sensors: noise of measurements. model: errors of masses, centres, inertias and
friction. impact: error of the impact map. ground: heights of uneven ground. sensor: noise of the one that is
named by `sensor`, apart from that of the encoders. touchdown: which ones are missed.
"""


FIELDS: Mapping[str, FieldInfo] = Scenario.__pydantic_fields__  # type: ignore[attr-defined]
"""Fields of a scenario by name, with description and range."""
DEFAULTS: dict[str, Any] = {
    name: x.get_default(call_default_factory=True) for name, x in FIELDS.items()
}
"""Default of each field."""
UNITS = {name: units_of("scenario.toml")[name] for name in FIELDS}
"""Unit of each field, "1" where it has none."""


def _told(push: dict[str, float]) -> dict[str, float]:
    """A push without an infinite stop (a step that lasts for good), which JSON cannot hold."""
    return {name: x for name, x in push.items() if not (name == "stop" and math.isinf(x))}


def drawn(s: Scenario, what: str) -> int:
    """A 63-bit seed for one purpose of `DRAWN`, from the scenario's seed.

    The streams are independent: a scenario with one random thing more keeps the draws of all others, so that
    two scenarios differ by what was changed and not by luck.
    """
    sequence = np.random.SeedSequence(s.seed, spawn_key=(DRAWN.index(what),))
    words = sequence.generate_state(1, np.uint64)
    return int(words[0] >> np.uint64(1))
