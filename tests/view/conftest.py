from __future__ import annotations

import pytest

from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.adrc import ADRCController
from biped_adrc.control.npd import NPDController
from biped_adrc.gait.gait import load_gait
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.walk import walk


@pytest.fixture(scope="package")
def walks(biped: Biped) -> dict[str, Walk]:
    """Three single supports under NPD and under ADRC, without a push."""
    gait = load_gait("published", biped)
    npd, adrc = NPDController(gait.constraint), ADRCController(gait.constraint)
    return {
        "NPD": walk(Walker(biped, npd), gait, 3, RK4(2e-3)),
        "ADRC": walk(Walker(biped, adrc), gait, 3, Exponential(2e-3)),
    }
