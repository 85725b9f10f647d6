"""Section VI's other claim as a map: in which phase of the step does a push make which controller fall?

Pushes of 0.2 s in the 19th single support, over onset, amplitude and joint pattern, with and without a torque
limit. The walk starts on the periodic orbit at that step and has to make three more impacts. The reference is
continued smoothly past the phase range of the gait, so that a fall is a fall of the robot and no artefact of a
polynomial outside of its range.

Every walk is computed at two integration steps. A cell in which they end differently is marginal, and no claim
rests on it. Tasks of `paper.plan`; read by `paper.tables`, the claims, and `viz.plots.push_map`.

What a walk can be:

    feasible    makes all steps within friction, torque limits and without scuffing
    but_impact  the same but for the impact, whose impulse asks for more friction
    pulled      makes all steps; the mean normal force was negative, a real foot would have left the ground
    infeasible  makes all steps, and breaks another limit
    fell        the robot fell
    ended       ended otherwise, such as a step that takes too long
    marginal    another word or status at half of the integration step
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace

from biped_adrc.engine.run import COMPILED
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.scenario.outcome import Outcome
from biped_adrc.scenario.push import Push
from biped_adrc.scenario.run import execute_twice
from biped_adrc.scenario.scenario import Scenario

PATTERNS: dict[str, dict[str, float]] = {
    "all +": {"q1": 1.0, "q2": 1.0, "q3": 1.0, "q4": 1.0},
    "all -": {"q1": -1.0, "q2": -1.0, "q3": -1.0, "q4": -1.0},
    "hips +": {"q1": 1.0, "q2": 1.0},
    "hips -": {"q1": -1.0, "q2": -1.0},
    "hips apart": {"q1": 1.0, "q2": -1.0},
    "hips together": {"q1": -1.0, "q2": 1.0},
    "stance knee +": {"q3": 1.0},
    "stance knee -": {"q3": -1.0},
    "swing knee +": {"q4": 1.0},
    "swing knee -": {"q4": -1.0},
}
"""Factors by joint, to be multiplied by the amplitude [N m]."""

IMPACTS = 4
"""Impacts asked for, from the pushed step on."""
PUSHED_STEP = 19
"""Number of the single support in which the push acts."""
DURATION = 0.2
"""Of a push [s]."""
MAP_STEP = 1e-3
"""Integration step [s]; each walk is repeated at half of it."""


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
        assert o.half is not None
        used, half = cls._at(o), cls._at(o.half)
        same = (used.word, used.status) == (half.word, half.status)
        return replace(used, marginal=not same)

    @classmethod
    def _at(cls, o: Outcome) -> Fate:
        found = o.feasibility
        normal, friction, impulse = (
            x if math.isfinite(x) else None
            for x in (found.mean_normal_force, found.mean_friction, found.impulse_ratio)
        )
        return cls(found.outcome, o.status, normal, friction, impulse, tuple(found.reasons))

    @property
    def word(self) -> str:
        """As in the map: "marginal", or "pulled" for a walk that needed a ground that pulls, or the outcome."""
        if self.marginal:
            return "marginal"
        pulls = self.mean_normal_force is not None and self.mean_normal_force <= 0.0
        return "pulled" if self.outcome == "infeasible" and pulls else self.outcome


@dataclass(frozen=True)
class PushCell:
    """One push and what each controller made of it."""

    preset: str
    """Of RABBIT."""
    onset: float
    """In the step [s]."""
    amplitude: float
    """[N m]."""
    pattern: str
    """One of `PATTERNS`."""
    torque_limit: float | None
    """[N m], None for unlimited."""
    npd: Fate
    adrc: Fate

    def row(self) -> dict[str, object]:
        """In plain values, for the figure and the summary."""
        return {
            **asdict(self),
            "onset_ms": 1e3 * self.onset,
            "npd_word": self.npd.word,
            "adrc_word": self.adrc.word,
        }


@dataclass(frozen=True)
class Tried:
    """One push to be tried."""

    onset: float
    """In the step [s]."""
    amplitude: float
    """[N m]."""
    pattern: str
    """One of `PATTERNS`."""
    torque_limit: float | None
    """[N m], None for unlimited."""

    def run(self, base: Scenario, controller: str) -> Scenario:
        """The walk of `base` under this push and this controller."""
        factors = PATTERNS[self.pattern].items()
        torque = {joint: self.amplitude * factor for joint, factor in factors}
        push = Push(torque=torque, step=PUSHED_STEP, onset=self.onset, duration=DURATION)
        return base.replace(
            controller=controller,
            pushes=(push,),
            hardware={"torque_limit": self.torque_limit},
            gait={"continued": True},
            run={
                "first_step": PUSHED_STEP,
                "impacts": IMPACTS,
                "h": MAP_STEP,
                "engine": COMPILED,
            },
        )


def push_map(base: Scenario, tried: Sequence[Tried]) -> list[PushCell]:
    """Both controllers under every push, each at two steps; base: the robot."""
    cells: list[PushCell] = []
    for found in tried:
        npd, adrc = (Fate.of(execute_twice(found.run(base, c))) for c in CONTROLLERS)
        place = (found.onset, found.amplitude, found.pattern, found.torque_limit)
        cells.append(PushCell(str(base.robot.preset), *place, npd, adrc))
    return cells


def pushes(
    onsets: Sequence[float],
    amplitudes: Sequence[float],
    patterns: Sequence[str],
    limits: Sequence[float | None],
) -> list[Tried]:
    """All combinations, the limits slowest and the onsets fastest. onsets [s], amplitudes [N m],
    limits [N m].
    """
    every = itertools.product(limits, patterns, amplitudes, onsets)
    return [Tried(onset, amplitude, of, limit) for limit, of, amplitude, onset in every]


WORDS = ("feasible", "but_impact", "infeasible", "pulled", "fell", "ended", "marginal")
"""What a walk of the map can be, and the columns of its table."""


def counts(cells: Sequence[PushCell]) -> dict[str, dict[str, dict[str, int]]]:
    """How many walks are what, by setting, controller and word: the table of the map."""
    found: dict[str, dict[str, dict[str, int]]] = {}
    for cell in cells:
        limit = "unlimited" if cell.torque_limit is None else f"{cell.torque_limit:g} N m"
        new = {c: dict.fromkeys(WORDS, 0) for c in CONTROLLERS}
        here = found.setdefault(f"{cell.preset}, {limit}", new)
        for c, fate in zip(CONTROLLERS, (cell.npd, cell.adrc), strict=True):
            here[c][fate.word] += 1
    return found


def certain(cells: Sequence[PushCell]) -> list[PushCell]:
    """The cells that are not marginal under either controller."""
    return [c for c in cells if not (c.npd.marginal or c.adrc.marginal)]
