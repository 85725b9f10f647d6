"""What a scenario draws: each thing has a generator of its own, so that one more changes none of the others."""

from __future__ import annotations

import numpy as np

from biped_adrc.scenario.scenario import Scenario

DRAWN = ("start", "onset", "joints", "noise", "sensors", "model", "impact", "ground")
"""By its place here and the scenario's seed."""


def drawn(s: Scenario, what: str) -> int:
    """A seed for one of the things in `DRAWN`."""
    sequence = np.random.SeedSequence(s.seed, spawn_key=(DRAWN.index(what),))
    words = sequence.generate_state(1, np.uint64)
    return int(words[0] >> np.uint64(1))
