"""One walk of a session: its scenario as it is now, what moves it, and where it is.

A scenario may be changed while it walks: another controller, observer, gain, sensor or plant begins at the
next sample instant, in the same (q, q') and the same single support. It begins as a walk begins after an
impact: controller and sensors in their `initial_state` at what is measured there, and the clock of sample
instants anew. The torque that acts goes on until the controller's first one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.errors import InputError
from biped_adrc.hybrid.simulator import FlownArc
from biped_adrc.hybrid.status import Status
from biped_adrc.live.hand import Hand
from biped_adrc.live.movers import moving_of
from biped_adrc.live.moving import Moving, Now
from biped_adrc.scenario.build import RobotAndGait, build, soft_loop, start
from biped_adrc.scenario.run import method_of
from biped_adrc.scenario.scenario import DEFAULTS, Scenario
from biped_adrc.types import Array

FIXED = (
    *("robot", "preset", "gait", "continued", "impacts", "first_step", "seed"),
    *("start", "start_speed", "start_speed_spread", "start_spread", "start_rate_spread"),
)
"""Fields of a scenario that say who walks and where it begins: they cannot change on the way."""
OF_CONTROLLER = ("observer", "poles", "bandwidth", "order", "reset")
"""Fields that go back to their defaults with another controller, unless they are given with it."""


@dataclass(frozen=True)
class LiveWalk:
    """A walk at one sample instant."""

    scenario: Scenario
    """As it is now."""
    scene: RobotAndGait
    moving: Moving
    now: Now
    """Where it is, or where it was when it ended."""
    status: Status = Status.COMPLETED
    """COMPLETED while it goes on."""
    detail: str = ""
    """What is known beyond the status."""
    foot: Array = field(default_factory=lambda: np.zeros(2))
    """Place (x, z) (2,) [m] of the stance foot in the world."""

    @classmethod
    def begun(cls, s: Scenario) -> LiveWalk:
        """A scenario just after the impact with which it begins. Raises InputError."""
        scene = RobotAndGait.of(s)
        scene.walked  # noqa: B018  # a robot without motors is refused
        moving = moved_by(s, scene)
        return cls(s, scene, moving, moving.start(*start(s, scene), Mode(s.first_step), 0.0))

    @property
    def walks(self) -> bool:
        """Whether it goes on."""
        return self.status is Status.COMPLETED

    @property
    def q(self) -> Array:
        """Angles (n,) [rad]."""
        return self.now.x[: self.moving.walker.plant.n]

    @property
    def v(self) -> Array:
        """Rates (n,) [rad/s]."""
        n = self.moving.walker.plant.n
        return self.now.x[n : 2 * n]

    def sampled(self, hand: Hand | None) -> tuple[LiveWalk, FlownArc]:
        """One sample on, with its nodes. Of a walk that has ended there is none."""
        flown, now = self.moving.moved(self.now, hand)
        last = self.now._replace(t=float(flown.arc.t[-1]), x=flown.arc.x[-1])
        if now is None:
            return replace(self, now=last, status=flown.status, detail=flown.detail), flown
        if flown.outcome is None:
            return replace(self, now=now), flown
        stride = self.moving.walker.plant.swing_foot(last.x[: len(self.q)])
        return replace(self, now=now, foot=self.foot + stride), flown

    def changed(self, values: Mapping[str, object]) -> LiveWalk:
        """With other values of its scenario, by name, from this sample instant on.

        Raises InputError for values that are none, or that cannot change while it walks.
        """
        check_changing(values)
        s, moving = revised(self.scenario, values), self.moving
        if s == self.scenario:
            return self
        t, mode = self.now.t, self.now.mode
        new = moved_by(s, self.scene, t)
        if not self.walks:
            return replace(self, scenario=s, moving=new)
        own = moving.own(self.now) if s.plant == self.scenario.plant else None
        now = new.start(self.q, self.v, mode, t, moving.torque(self.now), own)
        return replace(self, scenario=s, moving=new, now=now)


def check_changing(values: Mapping[str, object]) -> None:
    """Raise InputError for values, by name, that say who walks and where it begins."""
    if fixed := [name for name in values if name in FIXED]:
        raise InputError(
            f"{', '.join(fixed)} cannot change while it walks; begin a new session with that"
        )


def moved_by(s: Scenario, scene: RobotAndGait, t_first: float = 0.0) -> Moving:
    """What moves a scenario on from t_first [s]. Raises InputError."""
    if s.fine is not None:
        raise InputError(f"a live walk has steps of one length; leave out fine = {s.fine:g} s")
    walker = build(s, scene)
    return moving_of(walker, method_of(s, walker), soft_loop(s, walker), t_first)


def revised(s: Scenario, values: Mapping[str, object]) -> Scenario:
    """A scenario with other values by name; another controller comes without the observer of the one before.

    Raises InputError for values that it does not take.
    """
    if values.get("controller", s.controller) != s.controller:
        values = {name: DEFAULTS[name] for name in OF_CONTROLLER} | dict(values)
    try:
        return replace(s, **values)  # type: ignore[arg-type]
    except TypeError as error:
        raise InputError(f"{error}; expected fields of a scenario, such as bandwidth") from error
