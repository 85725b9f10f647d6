"""Section VI's other claim as a map: in which phase of the step does a push throw which controller?

Pushes of 0.2 s in the 19th single support, over onset, amplitude and joint pattern, with unlimited torque and
with RABBIT's 150 N m. The walk starts on the periodic orbit at that step, and has to make three more impacts.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

from biped_adrc.engine.batch import Case, simulate_many
from biped_adrc.gait.gait import load_gait
from biped_adrc.studies.push import Push
from biped_adrc.studies.runs import CONTROLLERS, Run
from biped_adrc.walker import Mode

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
"""Joint patterns, to be multiplied by the amplitude [N m]."""

IMPACTS = 4
PUSHED_STEP = 19
DURATION = 0.2
"""[s]."""
MAP_STEP = 2e-3
"""[s]: whether a walker falls does not need the accuracy of the headline runs."""


@dataclass(frozen=True)
class Cell:
    """One push and what each controller made of it; status by controller."""

    preset: str
    onset: float
    """[s] in the step."""
    amplitude: float
    """[N m]."""
    pattern: str
    torque_limit: float | None
    """[N m], None for unlimited."""
    npd: str
    adrc: str

    @property
    def verdict(self) -> str:
        """Who walked on."""
        names = {
            (True, True): "both walk",
            (False, True): "only NPD falls",
            (True, False): "only ADRC falls",
            (False, False): "both fall",
        }
        return names[self.npd == "COMPLETED", self.adrc == "COMPLETED"]

    def row(self) -> dict[str, Any]:
        """As plain values, for the figure and the summary."""
        return {
            **asdict(self),
            "onset_ms": 1e3 * self.onset,
            "npd": self.npd == "COMPLETED",
            "adrc": self.adrc == "COMPLETED",
            "npd_status": self.npd,
            "adrc_status": self.adrc,
            "verdict": self.verdict,
        }


@dataclass(frozen=True)
class Tried:
    """A push by its onset [s], amplitude [N m], joint pattern and torque limit [N m], None for unlimited."""

    onset: float
    amplitude: float
    pattern: str
    torque_limit: float | None

    def run(self, base: Run, controller: str) -> Run:
        """The walk under it."""
        factors = PATTERNS[self.pattern].items()
        torque = {joint: self.amplitude * factor for joint, factor in factors}
        push = Push(torque, step=PUSHED_STEP, start=self.onset, stop=self.onset + DURATION)
        limit = self.torque_limit
        return replace(base, controller=controller, pushes=(push,), torque_limit=limit, h=MAP_STEP)


def push_map(base: Run, tried: Sequence[Tried], threads: int | None = None) -> list[Cell]:
    """Both controllers under every push, on the compiled engine, in parallel threads."""
    biped = base.biped()
    gait = load_gait(base.gait, biped)
    q, v = gait.start(biped)

    def cases() -> Iterator[Case]:
        for push in tried:
            for controller in CONTROLLERS:
                run = push.run(base, controller)
                walker, method = run.build(biped, gait), run.one_step_method()
                yield Case(walker, q, v, method, IMPACTS, Mode(PUSHED_STEP))

    status = (walked.status.name for walked in simulate_many(cases(), threads))
    return [
        Cell(base.preset, p.onset, p.amplitude, p.pattern, p.torque_limit, npd, adrc)
        for p, npd, adrc in zip(tried, status, status, strict=True)
    ]


def pushes(
    onsets: Sequence[float],
    amplitudes: Sequence[float],
    patterns: Sequence[str],
    limits: Sequence[float | None],
) -> list[Tried]:
    """All of them, the limits slowest and the onsets fastest."""
    return [
        Tried(onset, amplitude, pattern, limit)
        for limit in limits
        for pattern in patterns
        for amplitude in amplitudes
        for onset in onsets
    ]
