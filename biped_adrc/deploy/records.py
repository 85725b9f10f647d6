"""What passed between robot and computer in a walk, call by call.

    calls = recorded(walk.walker, walk.trajectory)
    made = fed(loaded, calls)                  # the same measurements through the exported controller

The measurements are those that the computer was given, in the labels that it believed in. Beside
them is what the simulated controller made of them: its state, and the torque that was sent.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from biped_adrc.closed_loop.noticing import turned
from biped_adrc.closed_loop.semantics import parts
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.deploy.functions import sent_last
from biped_adrc.deploy.loaded import Loaded
from biped_adrc.hardware.motors import relabelled
from biped_adrc.hardware.sample_hold import as_seen, read
from biped_adrc.hardware.touchdown import Belief, belief_of
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.timing import SampledTime
from biped_adrc.types import Array

NONE = np.zeros(0)


class RecordedCall(NamedTuple):
    """One call of the computer, and what it made of it."""

    kind: str
    """init, step or touchdown."""
    t: float
    """[s]"""
    q: Array
    """(n,) [rad]"""
    v: Array
    """(n,) [rad/s]"""
    s: Array
    """State of the controller after it; empty after init."""
    u: Array
    """Torque that was sent (p,) [N m]; empty but for step."""


def recorded(walker: Walker, run: Trajectory) -> list[RecordedCall]:
    """The calls of a walk in sampled time whose trajectory has every node of its method."""
    return list(_calls(walker, run))


def _calls(walker: Walker, run: Trajectory) -> Iterator[RecordedCall]:
    """As `recorded`."""
    begin, n = float(run.arcs[0].t[0]), walker.plant.n
    x, step, landed = run.arcs[0].x[0], run.arcs[0].mode.step, None
    yield RecordedCall("init", begin, x[:n], x[n : 2 * n], NONE, NONE)
    for arc in run.arcs:
        if landed is not None:
            yield _call(walker, "touchdown", float(arc.t[0]), landed)
        for t, x in _ticks(walker, arc, begin):
            if walker.touchdown is not None and _belief(walker, x).step != step:
                step = _belief(walker, x).step
                yield _call(walker, "touchdown", t, x)
            yield _call(walker, "step", t, x)
        told = walker.touchdown is not None or arc.event is None
        landed = None if told else arc.event.x_plus  # type: ignore[union-attr]


def _ticks(walker: Walker, arc: Arc, begin: float) -> Iterator[tuple[float, Array]]:
    """Times [s] and states (nx,) after the sample instants of an arc of a run that began at `begin` [s]."""
    assert isinstance(walker.timing, SampledTime)
    first = float(arc.t[0]) if walker.timing.restart else begin
    last = {t: i for i, t in enumerate(arc.t.tolist())}
    k = 0
    while (t := first + k * walker.timing.period) <= arc.t[-1]:
        if t in last:
            yield t, arc.x[last[t]]
        k += 1


def _call(walker: Walker, kind: str, t: float, x: Array) -> RecordedCall:
    """A call at t [s] that left the walker in x (nx,), in the labels that the controller believes in."""
    (q, v, s, tail), k = parts(walker, x), walker.held
    assert k is not None
    h = read(k.sizes, tail)
    line, other = h.line, 0.0 if k.sizes.told == 0 else belief_of(h.b).other
    seen = as_seen(k, h.w, *turned(walker, other, q, v))
    u = sent_last(relabelled(line, walker.swap) if other > 0.5 else line)
    return RecordedCall(kind, t, *seen, s, u if kind == "step" else NONE)


def _belief(walker: Walker, x: Array) -> Belief:
    """What the controller of a walker in x (nx,) takes for its single support."""
    k = walker.held
    assert k is not None
    return belief_of(read(k.sizes, parts(walker, x)[3]).b)


class Made(NamedTuple):
    """What an exported controller made of calls."""

    flags: list[int]
    """What each function returned."""
    s: Array
    """States of the controller after the calls (K, size)."""
    u: Array
    """Torques of the calls of step (K, p) [N m], NaN for others."""


def fed(loaded: Loaded, calls: Sequence[RecordedCall]) -> Made:
    """The calls through an exported controller, whose own state goes on from call to call."""
    x, flags, states = np.zeros((), loaded.state), [], []
    torques = np.full((len(calls), loaded.source.p), np.nan)
    for i, call in enumerate(calls):
        m = loaded.measured(call.t, call.q, call.v)
        if call.kind == "init":
            flag, x = loaded.init(m)
        elif call.kind == "touchdown":
            flag = loaded.touchdown(x, m)
        else:
            flag, torques[i] = loaded.step(x, m)
        flags.append(flag)
        states.append(x["s"].copy() if "s" in (loaded.state.names or ()) else NONE)
    return Made(flags, np.array(states, dtype=float), torques)
