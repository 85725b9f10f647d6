"""Section VI's other claim as a map: in which phase of the step does a push make which controller fall?

Pushes of 0.2 s in the 19th single support, over onset, amplitude and joint pattern, with and without a torque
limit (`scenarios.MapPush`). Every walk is made at two integration steps. A cell in which they end differently
is marginal, and no claim rests on it. What a walk can be:

    feasible    makes all steps within friction, torque limits and without scuffing
    but_impact  the same but for the impact, whose impulse asks for more friction
    pulled      makes all steps; the mean normal force was negative, a real foot would have left the ground
    infeasible  makes all steps, and breaks another limit
    fell        the robot fell
    ended       ended otherwise, such as a step that takes too long
    marginal    another word or status at half of the integration step
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import NamedTuple

from biped_adrc.paper.scenarios import CONTROLLERS, MapPush
from biped_adrc.scenario.recording import Outcome
from biped_adrc.scenario.walk import execute_twice

WORDS = ("feasible", "but_impact", "infeasible", "pulled", "fell", "ended", "marginal")
"""What a walk of the map can be, and the columns of its table."""
LOST = ("fell", "ended")
"""Outcomes of a walk that did not make its steps."""


@dataclass(frozen=True)
class Fate:
    """What became of one walk."""

    outcome: str
    """One of the words in `OUTCOMES`."""
    status: str
    """How the simulation ended."""
    mean_normal_force: float | None
    """The least F_N averaged over 5 ms [N]; where it is negative the ground would have had to pull."""
    mean_friction: float | None
    """The largest |F_T| / F_N of such an average; None where the ground never pushed."""
    impulse_ratio: float | None
    """The largest |F_T| / F_N of the impacts."""
    reasons: tuple[str, ...] = ()
    """Why the walk is not feasible, by the names of `Feasibility.reasons`."""
    marginal: bool = False
    """Whether its word or its status is another at half of the step."""

    @classmethod
    def of(cls, o: Outcome) -> Fate:
        """Of a run computed at two steps; marginal where word or status differ between them."""
        f = o.feasibility
        result = (f.mean_normal_force, f.mean_friction, f.impulse_ratio)
        normal, friction, impulse = (x if math.isfinite(x) else None for x in result)
        used = cls(f.outcome, o.status, normal, friction, impulse, tuple(f.reasons))
        half = used if o.half is None else cls.of(o.half)
        return replace(used, marginal=(used.word, used.status) != (half.word, half.status))

    @property
    def word(self) -> str:
        """As in the map: "marginal", or "pulled" for a walk that needed a ground that pulls, or the outcome."""
        if self.marginal:
            return "marginal"
        pulls = self.mean_normal_force is not None and self.mean_normal_force <= 0.0
        return "pulled" if self.outcome == "infeasible" and pulls else self.outcome


class PushCell(NamedTuple):
    """One push and what each controller made of it."""

    push: MapPush
    npd: Fate
    adrc: Fate

    @property
    def setting(self) -> str:
        """Preset and torque limit, for a reader."""
        limit = self.push.torque_limit
        return f"{self.push.preset}, {'unlimited' if limit is None else f'{limit:g} N m'}"

    @property
    def certain(self) -> bool:
        """Whether it is marginal under neither controller."""
        return not (self.npd.marginal or self.adrc.marginal)

    def row(self) -> dict[str, object]:
        """In plain values, for the figure and the summary."""
        return {
            **asdict(self.push),
            "npd": asdict(self.npd),
            "adrc": asdict(self.adrc),
            "onset_ms": 1e3 * self.push.onset,
            "npd_word": self.npd.word,
            "adrc_word": self.adrc.word,
        }


def push_map(pushes: Sequence[MapPush]) -> list[PushCell]:
    """Both controllers under every push, each at two steps."""
    return [
        PushCell(push, *(Fate.of(execute_twice(push.run(c))) for c in CONTROLLERS))
        for push in pushes
    ]
