"""Records of a scenario's hardware: sampling, sensors, motors and joint friction.

A record is a table of plain values that is checked when it is made (`scenario.records`): each field has its
default, unit and range in `field(..)`, and its help text below it. SHORT is the field that a text alone sets:
hardware="rabbit" is hardware={"profile": "rabbit"}; "" is for none. An open record also keeps values that it
does not declare, for a class of the user's.
"""

from collections.abc import Mapping
from typing import Any, Literal, Self

from pydantic import model_validator

from biped_adrc.core.files import packaged
from biped_adrc.scenario.dotted import flat, merged
from biped_adrc.scenario.records import Misfit, OpenRecord, Record, field

PROFILES: dict[str, dict[str, Any]] = packaged("biped_adrc.scenario", "hardware.toml")
"""Values that `hardware.profile` fills in: none, continuous time; ideal, exact measurements at 1 kHz; rabbit,
sampling, encoders, torque and friction published for RABBIT (Chevallereau et al., IEEE Control Systems Magazine
2003; Westervelt, Buche, Grizzle, IJRR 2004), whose rotors are in the preset 'identified'."""


class EncoderRecord(Record):
    """How joint angles, the pitch and their rates are measured."""

    SHORT = ""
    counts: float | None = field(None, "1", ge=1)
    """The encoders of the joints have so many counts per revolution; by default they are exact."""
    noise: float = field(0.0, "rad", ge=0, le=1.0)
    """The joints' angles have noise of this standard deviation."""
    pitch_noise: float = field(0.0, "rad", ge=0, le=1.0)
    """The unactuated pitch has noise of this standard deviation."""
    rate_noise: float = field(0.0, "rad/s", ge=0, le=100.0)
    """Measured rates have noise of this standard deviation."""
    velocity: Literal["measured", "differences", "gyro"] = field("measured")
    """Rates are exact, or differences of angles, or so but for the pitch's, which a gyro measures."""
    filter_time: float = field(0.0, "s", ge=0, le=1.0)
    """The low-pass of the differences has this time constant."""
    angle_filter: float = field(0.0, "s", ge=0, le=1.0)
    """A low-pass with this time constant acts on the joints' angles."""

    @model_validator(mode="after")
    def _filtered(self) -> Self:
        """Raise Misfit for a low-pass of differences where rates are measured."""
        if self.filter_time and self.velocity == "measured":
            raise Misfit("filter_time", 'acts on velocity = "differences" or "gyro" only')
        return self


class SensorRecord(OpenRecord):
    """One more sensor behind the encoders, with its parameters."""

    name: str | None = field(None, kind="sensor")
    """One more sensor is behind the encoders, of the registry, or module:Class."""


class TouchdownRecord(OpenRecord):
    """How the controller notices touchdowns, with parameters."""

    name: str | None = field(None, kind="touchdown")
    """The detector is 'faulty', 'force', 'kinematics' or module:Class; by default it is never late."""


class HardwareRecord(Record):
    """Sampling, sensors, motors and joint friction."""

    SHORT = "profile"
    profile: Literal["none", "ideal", "rabbit"] = field("none")
    """The profile fills in what is left out: none, ideal (1 kHz) or rabbit."""
    period: float | None = field(None, "s", ge=1e-5, le=0.1)
    """The controller samples with this period; by default it works in continuous time."""
    delay: float = field(0.0, "s", ge=0, le=1.0)
    """The torque acts so long after its tick."""
    delay_known: bool = field(False)
    """The observer knows the delay."""
    encoders: EncoderRecord = field(EncoderRecord.model_construct())
    sensor: SensorRecord = field(SensorRecord.model_construct())
    touchdown: TouchdownRecord = field(TouchdownRecord.model_construct())
    torque_limit: float | None = field(None, "N m", gt=0)
    """Every motor has this torque at most."""
    rate_limit: float | None = field(None, "N m/s", gt=0)
    """Every motor's torque changes by this at most."""
    lag: float = field(0.0, "s", ge=0, le=1.0)
    """The motors follow with this time constant."""
    friction: bool = field(False)
    """The plant has the joint friction of the robot's record."""

    @model_validator(mode="before")
    @classmethod
    def _opened(cls, values: Any) -> Any:
        """Make a mapping of a profile's name, and fill in the profile's values for those that `values` leaves
        out; other values stay. pydantic calls it before it checks any of them.
        """
        values = super()._opened(values)  # type: ignore[operator]
        if not isinstance(values, Mapping):
            return values
        # PROFILES: name of a profile -> values that it fills in
        profile = PROFILES.get(str(values.get("profile")), {})
        # where both have a table, such as encoders, the profile's entries that `values` lacks are filled in too
        own = {name: values[name] for name in profile if name in values}
        return {**values, **merged(profile, own)}

    @model_validator(mode="after")
    def _sampled(self) -> Self:
        """Raise Misfit for a value that would do nothing in continuous time, that is without a period: all but
        the torque limit and the plant's friction. pydantic calls it when all fields are set.
        """
        # Record.record also has the values that the profile filled in, the `record` of this class does not
        if self.period is not None:
            return self
        idle = flat(Record.record(self)).keys() - {"torque_limit", "friction", "profile"}
        if idle:
            raise Misfit(min(idle), "does nothing in continuous time; give hardware.period too")
        return self

    def record(self, usual: Record | None = None) -> dict[str, Any]:
        """Nested plain values that differ from those of the profile, and the profile's name unless it is
        "none". `usual`, by which other records are compared, does not count: the values of the profile are the
        defaults here.
        """
        if self.profile == "none":
            return super().record()
        return {"profile": self.profile, **super().record(HardwareRecord(profile=self.profile))}
