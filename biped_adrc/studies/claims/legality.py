"""What a claim asks of the ground and the motors: the one place where that is looked up."""

from __future__ import annotations

from collections.abc import Sequence

from biped_adrc.analysis.certificate import Support


def illegal(supports: Sequence[Support]) -> tuple[str, ...]:
    """Why a robot could not have made these steps, within the limits of its record; empty when it could.

    By the force of the ground in the mean over the window; the impulse at impact is judged apart.
    """
    return tuple(f"step {s.step}: {why}" for s in supports for why in s.illegal().values())
