"""What a learner is given at a sample instant, read off the closed loop; the same lines in Python and compiled.

    observation  (q, q', e, e', u, Theta)       n + n + p + p + p + 1 numbers

q, q' are what the walk's own controller would be given at this sample instant: behind the scenario's sensors,
and, where touchdowns have to be noticed, in the labels that it believes in. e = q_b - h(Theta), e' and Theta
follow from them; u [N m] is the torque that has acted. The reward goes by the true e and u.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from biped_adrc.closed_loop.protocols import Loop, Mode
from biped_adrc.closed_loop.semantics import labelled, noticed, parts
from biped_adrc.control.base import Measurement
from biped_adrc.core.types import Array
from biped_adrc.gait.reference import ReferencePoint
from biped_adrc.hardware.sample_hold import motor_torque, read


class LearnerView(NamedTuple):
    """At one sample instant; n coordinates, p motors."""

    q: Array
    """Angles as measured (n,) [rad]."""
    v: Array
    """Rates as measured (n,) [rad/s]."""
    e: Array
    """q_b - q_d of what is measured (p,) [rad]."""
    de: Array
    """Its rate (p,) [rad/s]."""
    u: Array
    """Torque that has acted (p,) [N m]."""
    at: Array
    """Time [s], and number of the single support, (2,)."""
    squares: Array
    """|q_b - q_d|^2 of the true state [rad^2], and |u|^2 [N^2 m^2], (2,)."""


def learner_view(
    loop: Loop,
    t: float,
    x: Array,
    mode: Mode,
    reference: Callable[[Array, Measurement], ReferencePoint],
) -> LearnerView:
    """What a learner is given in x (nx,) at a sample instant at t [s], before the controller has acted.

    reference(s, m): the point of the reference at a measurement, s the controller's state.
    """
    (q, v, s, tail), k, p = parts(loop, x), loop.held, loop.plant.p
    assert k is not None
    h = read(k.sizes, tail)
    true = loop.measure(t, q, v, mode)
    if k.touchdown is not None:
        state, _, _, b = noticed(loop, t, s, tail, q, v, mode)
        line = labelled(loop, b, h.line)
    else:
        q_seen, v_seen = k.reading(k.sense(h.w, q, v), q, v)
        state, line = true._replace(q=q_seen, v=v_seen), h.line
    r, e, u = reference(s, state), q[:p] - reference(s, true).q_d, motor_torque(h.line)
    return LearnerView(
        q=state.q,
        v=state.v,
        e=state.q[:p] - r.q_d,
        de=state.v[:p] - r.dq_d,
        u=motor_torque(line),
        at=np.array([t, mode.step]),
        squares=np.array([e @ e, u @ u]),
    )
