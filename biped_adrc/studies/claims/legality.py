"""What a claim asks of the ground and the motors: the one place where that is looked up."""

from __future__ import annotations

from collections.abc import Sequence

from biped_adrc.analysis.certificate import Certificate


def illegal(certificates: Sequence[Certificate]) -> tuple[str, ...]:
    """Why a robot on dry ground could not have made these steps; empty when it could.

    The impulse at impact is judged apart.
    """
    return tuple(f"step {c.step}: {why}" for c in certificates for why in c.violations())
