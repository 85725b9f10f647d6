"""The gait of 0.50 m/s under a constant rearward force at the hip: what stops it, and what the PI recovers.

No controller appears in the prediction, which is a quadrature on the zero dynamics; the walks are simulated.
"""

from __future__ import annotations

from biped_adrc.studies.hip_case import HipCase, PushedWalk
from biped_adrc.studies.verification.row import Measure, Row

SOURCE = "Westervelt, Grizzle, Canudas de Wit 2003, another gait"
PREDICTED = "quadrature on the zero dynamics"
BESIDE = 0.05
"""How far below and above the predicted force the walks are, share of it."""


def published_force_rows() -> tuple[Row, ...]:
    """The force that stops the gait, beside the published 3 N, in every preset."""
    return tuple(
        Row(
            f"RABBIT {preset}, v0.5",
            "rearward force that stops it, by quadrature [N]",
            3.0,
            HipCase("NPD", stride=False, preset=preset).predicted(),
            None,
            SOURCE,
        )
        for preset in ("identified", "identified-bare", "tac2003")
    )


def hip_rows(tracking: str, steps: int = 25) -> tuple[Row, ...]:
    """Just below the predicted force the walk goes on, just above it stops; with the PI it keeps its speed."""
    case = HipCase(tracking, stride=False, steps=steps)
    force, name = case.predicted(), f"RABBIT identified-bare, v0.5, {tracking}"
    below, above = (1.0 - BESIDE) * force, (1.0 + BESIDE) * force
    walked, stopped = PushedWalk.of(case, below), PushedWalk.of(case, above)
    held = PushedWalk.of(HipCase(tracking, stride=True, steps=steps), above)
    made = f"steps of {steps}"
    return (
        Row(name, f"{made} at {below:.2f} N", steps, len(walked.speeds), 0.0, PREDICTED),
        Row(
            name,
            f"walks on at {above:.2f} N (1 or 0)",
            0.0,
            float(stopped.walks),
            0.0,
            PREDICTED,
            Measure.ABSOLUTE,
            f"it stops after {len(stopped.speeds)}",
        ),
        Row(
            f"{name} with PI",
            f"speed at {above:.2f} N, mean of the last five steps [m/s]",
            0.5,
            held.speed() or 0.0,
            1e-3,
            "the speed the PI is asked for",
        ),
    )
