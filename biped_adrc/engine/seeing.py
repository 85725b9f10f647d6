"""The signals of a compiled run, node by node in compiled code, in the order of `analysis.signals.Signals`."""

from __future__ import annotations

from typing import Any

import numpy as np

from biped_adrc.engine.compiled_biped import pointer_call
from biped_adrc.engine.equations import Make
from biped_adrc.engine.fingerprint import hash_of, law_text, skeleton, versions_text
from biped_adrc.engine.ir import module_text
from biped_adrc.engine.kernels.layout import OUTSIDE
from biped_adrc.engine.machine import Machine, Text, machine
from biped_adrc.engine.observe import Observation, Seen, Watched, shapes
from biped_adrc.engine.program import HARDWARE, NotCompiled, Program
from biped_adrc.engine.symbols import Untraceable, floats
from biped_adrc.errors import ModelError
from biped_adrc.gait.constraint import VirtualConstraint, virtual_constraint
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.types import Array
from biped_adrc.walker import Mode, Walker


def see(walker: Walker, trajectory: Trajectory, reference: Reference) -> list[Array] | None:
    """Columns of all signals; None where a part has no compiled form."""
    if type(reference) is not VirtualConstraint:
        return None
    n, nx = walker.plant.n, trajectory.arcs[0].x.shape[1]
    try:
        program = Program.of(walker, walker.controller_size(nx))
        watched = Watched(
            program.numbers, reference.parameters, np.array(walker.plant.phase, dtype=float)
        )
        code = _code(program.make, watched)
    except (NotCompiled, Untraceable, ModelError):
        return None
    K = np.array([*floats(watched), 0.0])
    foot, columns = np.zeros(2), []
    for arc in trajectory.arcs:
        columns.append(_arc(walker, arc, code, K, foot))
        if arc.event is not None and arc.event.x_plus is not None:
            foot = foot + walker.plant.swing_foot(arc.event.x_minus[:n])
    return [np.concatenate(parts) for parts in zip(*columns, strict=True)]


def _arc(walker: Walker, arc: Arc, code: Machine, K: Array, foot: Array) -> list[Array]:
    """The columns of one arc."""
    n, p, count, mode = walker.plant.n, walker.plant.p, len(arc.t), arc.mode
    zeta = _external(walker, arc, mode)
    ones, unused = np.ones((count, 1)), np.zeros((count, OUTSIDE))
    inp = np.hstack(
        (arc.seen[:, np.newaxis], mode.step * ones, mode.start * ones, arc.x, zeta, unused)
    )
    sizes = shapes(n, p)
    out = np.empty((count, sum(sizes)))
    pointer_call(code, "observe", K, inp, out)
    parts = np.split(out, np.cumsum(sizes)[:-1], axis=1)
    s = Seen(
        *(
            part[:, 0] if name in SINGLE else part
            for name, part in zip(Seen._fields, parts, strict=True)
        )
    )
    q, v = arc.x[:, :n], arc.x[:, n : 2 * n]
    reaction = s.ground_reaction - _resultants(walker, arc, mode)
    return [
        arc.t,
        np.full(count, mode.step),
        q,
        v,
        s.a,
        s.theta,
        s.dtheta,
        s.q_d,
        s.dq_d,
        q[:, :p] - s.q_d,
        s.u,
        zeta,
        s.xi,
        s.xi_estimate,
        s.xi_matched + s.xi_unmatched,
        s.xi_matched,
        s.xi_nominal,
        s.zeta_estimate,
        reaction,
        s.kinetic,
        s.potential + walker.plant.weight * float(foot[1]),
        s.swing_foot,
        s.hip,
        np.full(count, foot[0]),
        np.full(count, foot[1]),
    ]


SINGLE = ("theta", "dtheta", "kinetic", "potential")


def _external(walker: Walker, arc: Arc, mode: Mode) -> Array:
    n = walker.plant.n
    if walker.disturbance is None:
        return np.zeros((len(arc.t), n))
    rows = [
        walker.disturbance.torque(float(t), mode.step, mode.start, x[:n], x[n : 2 * n])
        for t, x in zip(arc.seen, arc.x, strict=True)
    ]
    return np.array(rows)


def _resultants(walker: Walker, arc: Arc, mode: Mode) -> Any:
    if walker.disturbance is None or not walker.disturbance.pulls:
        return 0.0
    return np.array(
        [walker.disturbance.resultant(float(t), mode.step, mode.start) for t in arc.seen]
    )


_CODES: dict[str, Machine] = {}


def _code(make: Make, watched: Watched) -> Machine:
    laws = "\n".join(law_text(law) for law in (*make.laws[1:], *HARDWARE, virtual_constraint))
    key = hash_of(
        *("observe", skeleton(make.robot), laws, make.size, make.held),
        *(skeleton(watched), versions_text()),
    )
    if key not in _CODES:
        observe = Observation.of(make, watched).observe
        _CODES[key] = machine(key, ["observe"], lambda: Text(module_text({"observe": observe()})))
    return _CODES[key]
