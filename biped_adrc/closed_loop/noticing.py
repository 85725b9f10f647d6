"""A closed loop whose controller has to notice touchdowns: what it believes, and when that changes.

    touchdown at the plant     other <- 1 - other               controller, sensors and motors are told nothing
    tick                       (q, q')_b = (R q + r, R q') where other, else (q, q')
                               sense, notice; where it fires: other <- 1 - other, step + 1, start <- t, jump
                               torque of the law in these labels, then back in the plant's

b = (other, step, start, d) of `hardware.touchdown`. Part of `closed_loop.semantics`; as there nothing branches
on a real number, since both engines run these lines.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from biped_adrc.closed_loop.protocols import Loop, Mode
from biped_adrc.control.base import Measurement
from biped_adrc.core.types import Array, relabelled
from biped_adrc.hardware.motors import Line
from biped_adrc.hardware.sample_hold import HeldParts, read
from biped_adrc.hardware.touchdown import Belief, Look, belief_of, numbers_of


def noticed(
    loop: Loop, t: float, s: Array, tail: Array, q: Array, v: Array, mode: Mode
) -> tuple[Measurement, Array, Array, Array]:
    """What a controller is given at a sample instant t [s], in the labels that it believes in, and s, w, b.

    It senses q (n,) [rad], v (n,) [rad/s] in its labels. Where a touchdown is noticed these turn, a rate that
    the sensors derive from differences is relabelled, and the controller jumps; a new belief begins.
    """
    k = loop.held
    assert k is not None
    assert k.touchdown is not None
    h = read(k.sizes, tail)
    old, force = belief_of(h.b), 0.0
    q_b, v_b = turned(loop, old.other, q, v)
    if k.touchdown.needs_force:
        force = chosen(old.other, *loop.foot_forces(t, q, v, tail, mode))
    w = k.sense(h.w, q_b, v_b)
    q_seen, v_seen = k.reading(w, q_b, v_b)
    look = Look(
        t,
        t - old.start,
        loop.nominal.swing_foot(q_seen),
        force,
        old.other,
        mode.step,
        t - mode.start,
    )
    d, fires = k.touchdown.notice(old.d, look)
    other = old.other + fires * (1.0 - 2.0 * old.other)
    step: Any = old.step + fires
    start = chosen(fires, t, old.start)
    q_b, v_b = turned(loop, other, q, v)
    if k.sensors is not None:
        w = chosen(fires, k.sensors.impact(w, q_b, v_b, loop.nominal.R @ v_seen), w)
    m = loop.measure(t, *k.reading(w, q_b, v_b), mode._replace(step=step, start=start))
    return m, loop.jumped(fires, s, m), w, numbers_of(Belief(other, step, start, d))


def turned(loop: Loop, other: float, q: Array, v: Array) -> tuple[Array, Array]:
    """q (n,) [rad], v (n,) [rad/s] with the labels of the other foot where `other` is 1, else as they are."""
    model = loop.nominal
    return chosen(other, model.relabel(q), q), chosen(other, model.R @ v, v)


def chosen(which: float, one: Any, other: Any) -> Any:
    """`one`, a number or an array, where `which` is 1, `other` where it is 0."""
    return np.where(which > 0.5, one, other)


def labelled(loop: Loop, b: Array, line: Line) -> Line:
    """Torques of the plant's joints in the labels of a belief b, and back: the same exchange of the legs."""
    pairs = zip(line.relabelled(loop.swap), line, strict=True)
    return Line(*(chosen(belief_of(b).other, *pair) for pair in pairs))


def estimated(loop: Loop, s: Array, tail: Array, m: Measurement, mode: Mode) -> Array | None:
    """The observer's estimate of xi (p,) [rad/s^2] for the plant's joints, m the measurement in their labels.

    None without an observer.
    """
    k = loop.held
    if k is None or k.touchdown is None:
        estimate = loop.calls.estimate(s, m)
        return None if estimate is None else estimate.disturbance
    b = belief_of(read(k.sizes, tail).b)
    believed = mode._replace(step=b.step, start=b.start)
    seen = loop.measure(m.t, *turned(loop, b.other, m.q, m.v), believed)
    estimate = loop.calls.estimate(s, seen)
    if estimate is None:
        return None
    xi: Array = estimate.disturbance
    return chosen(b.other, relabelled(xi, loop.swap), xi)


def unnoticed(k: HeldParts, b: Array, t: float) -> Array:
    """A belief b after a true touchdown at t [s] of which the controller knows nothing."""
    assert k.touchdown is not None
    old = belief_of(b)
    other = 1.0 - old.other
    return numbers_of(old._replace(other=other, d=k.touchdown.touchdown(old.d, other, t)))
