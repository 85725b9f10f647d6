"""The error that a touchdown leaves and the error that a push causes, kept apart.

    settling   t - start of the single support <= SETTLING
    pushed     t - last time at which zeta != 0 <= AFTER, and not settling

Contact that takes time moves the joints at every touchdown, whatever the controller. The largest error of a
step is then often this transient, and hides what a push has done.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.signals import Signals
from biped_adrc.core.timing import SAME_INSTANT
from biped_adrc.core.types import Array

SETTLING = 0.06
"""How long after a touchdown an error is the transient of contact [s]."""
AFTER = 0.05
"""How long after its end a push counts as the cause of an error [s]."""


class ContactErrors(NamedTuple):
    """Largest absolute errors and root mean squares over the joints [rad]; None of nothing."""

    touchdown_error: float | None
    """While contact settles, from the second single support on."""
    pushed_error: float | None
    """From the onset of a push to `AFTER` its end, where contact has settled."""
    settled_error: float | None
    """Where contact has settled."""
    settled_rms: float | None
    """Over time, where contact has settled."""


def contact_errors(x: Signals) -> ContactErrors:
    """The errors of a walk, at its nodes."""
    since = x.t - starts(x)
    settling = since <= SETTLING + SAME_INSTANT
    acted = np.maximum.accumulate(np.where(np.any(x.zeta != 0.0, axis=1), x.t, -np.inf))
    pushed = x.t - acted <= AFTER + SAME_INSTANT
    lasts = np.append(np.diff(x.t) > 0.0, False)
    settled = x.error[lasts & ~settling]
    return ContactErrors(
        _largest(x.error[settling & (x.step > x.step[0])]),
        _largest(x.error[pushed & ~settling]),
        _largest(x.error[~settling]),
        math.sqrt(float(np.mean(settled**2))) if settled.size else None,
    )


def starts(x: Signals) -> Array:
    """Start of the single support of each node (K,) [s]."""
    _, first, places = np.unique(x.step, return_index=True, return_inverse=True)
    begins: Array = x.t[first][places]
    return begins


def _largest(error: Array) -> float | None:
    return float(np.max(np.abs(error))) if error.size else None
