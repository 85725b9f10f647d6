"""The request for a gait: speed, step length, slope, objective, and the limits that its step must keep.

`GaitRequest` is checked when it is made, before anything is computed. It also has its `stages`, easier requests
whose gaits are the first guesses of the optimisation, and the name of its gait. `StepLimits` may leave friction
and torque to the robot's record; `StepLimits.of` fills them in as `RobotLimits`. Used by
`analysis.gait_design`, by the command line and by the modules of this folder.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import Annotated

from biped_adrc.core.checks import Checked, NonNegativeFloat, PositiveFloat, Range, each
from biped_adrc.core.errors import GaitError
from biped_adrc.core.shown import Shown
from biped_adrc.gait.curves import ControlledCurve, curve_kind
from biped_adrc.model.biped import Biped
from biped_adrc.model.robots.urdf import FREELY

FrictionFloat = Annotated[float, Range("a number above 0, or infinity", lambda x: x > 0.0)]
LOW_FIRST = each("low < high [rad] by joint", lambda ends: ends[0] < ends[1])
"""Check of ranges: each has its lower end first."""


class Objective(Enum):
    """The cost that is minimised; the values are the names on the command line."""

    TORQUE = "torque"
    """int u'u dt / L [N^2 m s] (Westervelt, Grizzle, Koditschek 2003)."""
    TRANSPORT = "transport"
    """int sum |u_i q_i'| dt / (m g L), the cost of transport."""
    PEAK = "peak"
    """max |u_i| [N m]."""

    @classmethod
    def _missing_(cls, value: object) -> Objective:
        # Enum calls this for a value that is none of its own
        raise GaitError(f"objective '{value}' is unknown; choose one of {[o.value for o in cls]}")


@dataclass(frozen=True)
class StepLimits(Checked, Shown):
    """Limits of one step; None takes the robot's own from its record (`robot.toml`).

    - friction [1]: largest |F_T| / F_N in single support. impulse_friction [1]: largest |F_T| / F_N of the
      impulse; infinite for no limit.
    - torque [N m]: limit of every motor.
    - normal_force [1]: least F_N, as a share of the weight.
    - clearance [1]: least height of the swing foot in mid-step, as a share of the leg; None: it may scuff at
      first, as a leg without knees does.
    - lift_off [m/s]: least speed of the old foot out of the ground after impact, and of the swing foot into it
      before.
    - ranges [rad]: of joints, (low, high) by name of the coordinate, besides those of the record and the URDF.
    - multiplier [1]: largest delta^2 of the zero dynamics; the orbit is stable below 1.
    - slowest [1]: least |Theta'| in the step, as a share of that before impact: a walk that nearly stops is
      easily stopped.
    - reserve [1]: share of friction, torque, rates and of a quarter radian (or half the range) at either end of
      the ranges that is kept back at the nodes, for the phases between them.
    - rough [m]: H of the rough ground that the gait bears with ReferenceReset: each foothold is higher or lower
      by up to H than the one before.

    Raises InputError for a limit that is negative, zero where it divides, or a range without extent.

    >>> limits = ba.StepLimits(friction=0.5, torque=100.0, clearance=0.03)
    >>> limits.torque
    100.0
    """

    friction: FrictionFloat | None = None
    impulse_friction: FrictionFloat | None = None
    torque: PositiveFloat | None = None
    normal_force: NonNegativeFloat = 0.1
    clearance: NonNegativeFloat | None = 0.02
    lift_off: NonNegativeFloat = 0.02
    ranges: Annotated[Mapping[str, tuple[float, float]], LOW_FIRST] = field(default_factory=dict)
    multiplier: NonNegativeFloat = 0.95
    slowest: NonNegativeFloat = 0.15
    reserve: NonNegativeFloat = 0.02
    rough: NonNegativeFloat = 0.0

    def of(self, biped: Biped) -> RobotLimits:
        """These limits with the robot's own in place of None, with the ranges of its record for joints that
        `ranges` does not name, and cut to the ranges and rates that its URDF states for the joints of both
        legs.

        Raises GaitError for a joint that the robot does not have.
        """
        d = biped.description
        unknown = set(self.ranges) - set(d.joints)
        if unknown:
            raise GaitError(
                f"ranges are given for {sorted(unknown)}, robot '{d.name}' has the joints {list(d.joints)}"
            )
        mu = d.friction_coefficient if self.friction is None else self.friction
        own = {"friction": mu, "impulse_friction": mu, "torque": d.peak_torque}
        # a clearance of None is a value: no clearance is required
        values = {name: x for name, x in vars(self).items() if x is not None or name == "clearance"}
        ranges, rates = {**d.ranges, **self.ranges}, dict[str, float]()
        # a coordinate is the angle of a joint of one leg, and in the next step of its twin in the other leg, so
        # both of its URDF joints (`sides`) limit it; FREELY is the range from -inf to inf
        for joint, *sides in zip(d.actuated, *biped.motor_joints, strict=True):
            own_range = ranges.get(joint, FREELY)
            lows, highs = zip(own_range, *(side.range for side in sides), strict=True)
            if (ends := (max(lows), min(highs))) != FREELY:
                ranges[joint] = ends
            if (rate := min(side.speed for side in sides)) < math.inf:
                rates[joint] = rate
        return RobotLimits(**{**own, **values, "ranges": ranges, "rates": rates})


@dataclass(frozen=True)
class RobotLimits(StepLimits):
    """StepLimits of one robot: friction coefficients and torque [N m] are numbers, never None."""

    rates: Mapping[str, float] = field(default_factory=dict)
    """Largest |q_i'| [rad/s] by name of the coordinate."""

    # as in StepLimits, but never None
    friction: FrictionFloat
    impulse_friction: FrictionFloat
    torque: PositiveFloat

    def in_words(self) -> str:
        """The limits in one line, for the provenance."""
        return ", ".join(f"{name} {x}" for name, x in vars(self).items())


@dataclass(frozen=True)
class GaitRequest(Checked, Shown):
    """The request for a gait: speed, step length or both (one left out is free), or a state to pass through.

    Raises GaitError for a request that contradicts itself, InputError for a value out of range.
    """

    speed: PositiveFloat | None = None
    """Average speed along the ground [m/s]."""
    step: PositiveFloat | None = None
    """Distance between the feet [m]."""
    slope: Annotated[float, Range("below 0.5 rad either way", lambda x: abs(x) < 0.5)] = 0.0
    """Slope of the ground [rad], positive downhill."""
    objective: Objective = Objective.TORQUE
    degree: Annotated[int, Range("a degree from 4 to 12", lambda x: x in range(4, 13))] = 6
    """Degree of the curves: one less than their coefficients."""
    # more than 100 are accepted too, as `optimise` tries twice as many where limits are violated between them
    nodes: Annotated[int, Range("8 to 100 nodes", lambda x: x in range(8, 201))] = 24
    """Number of Gauss nodes at which the limits are kept; twice as many where that is not enough."""
    limits: StepLimits = StepLimits()
    through: Annotated[tuple[float, ...], each("finite numbers", math.isfinite)] | None = None
    """Pre-impact state (q-, q'-) (2 n,) through which the orbit has to pass, in place of speed and step."""
    curve: str = "bezier"
    """Kind of the curves by name, one that lies between its ends."""

    @property
    def kind(self) -> type[ControlledCurve]:
        """The class of the curves that `curve` names."""
        return curve_kind(self.curve)  # type: ignore[return-value]

    def __post_init__(self) -> None:
        # targets (speed, step length or both) or a state, not both; and a curve between its outer coefficients
        targets, rough = self.speed is not None or self.step is not None, self.limits.rough
        for fits, expected in (
            (targets != bool(self.through), "a speed, a step length or both, or a state"),
            (issubclass(self.kind, ControlledCurve), "a curve with ends, such as bezier"),
            (not (self.slope and rough), "rough ground without a slope"),
            (self.limits.clearance is not None or not rough, "a clearance on rough ground"),
        ):
            if not fits:
                raise GaitError(f"no gait can be designed for {self!r}: expected {expected}")

    def stages(self) -> tuple[GaitRequest, ...]:
        """Requests from an easy one to this one; the solution of each is the first guess for the next.

        They are least torque on level ground, least torque on the slope, and this one; equal ones are left out,
        and a state to pass through has only this one.
        """
        if self.through is not None:
            return (self,)
        sloped = replace(self, objective=Objective.TORQUE)
        before = [] if self.slope == 0.0 else [replace(sloped, slope=0.0)]
        return (*before, *([] if sloped == self else [sloped]), self)

    def in_words(self) -> str:
        """The request in words, for messages and the provenance, such as "0.8 m/s, a slope of 0.05 rad"."""
        state = ["the given pre-impact state"] if self.through else []
        forms = "{:g} m/s", "a step of {:g} m", "a slope of {:g} rad", "rough ground of {:g} m"
        return ", ".join(state + self._said(*forms))

    def name(self) -> str:
        """Name of the gait, such as "v0.8-s0.5", which is also that of its file."""
        forms = "v{:g}", "s{:g}", "slope{:g}", "rough{:g}"
        return "through" if self.through else "-".join(self._said(*forms))

    def _said(self, *forms: str) -> list[str]:
        """Texts of speed, step length, slope and rough ground, each by its format in `forms`; a number that is
        free, and a slope or height of zero, are left out.
        """
        numbers = zip(forms, (self.speed, self.step, self.slope, self.limits.rough), strict=True)
        return [form.format(x) for form, x in numbers if x]
