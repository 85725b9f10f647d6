"""`closed_loop.instant_signals.signals_at` in compiled code, at every node of a run.

Signals are not stored with a run but computed again from the states, at tens of thousands of nodes.
`analysis.signals` does that with `Equations.reading`, and in Python where a part has no compiled form.
The disturbance zeta is an input, since it may run in Python.
"""

from __future__ import annotations

from math import prod

import numpy as np

from biped_adrc.closed_loop.instant_signals import InstantSignals, signals_at
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.outer_loop import OuterLoop, tracked_point
from biped_adrc.core.errors import ModelError
from biped_adrc.core.types import Array
from biped_adrc.engine.compiled_biped import Call, parts_of, pushes, zeta_rows
from biped_adrc.engine.kernels.record import OUTSIDE
from biped_adrc.engine.program import Program
from biped_adrc.engine.run import COMPILED
from biped_adrc.engine.symbols import NotCompiled
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid.trajectory import Arc, Trajectory


def compiled_readings(
    walker: Walker, trajectory: Trajectory, reference: Reference | OuterLoop
) -> InstantSignals | None:
    """All signals at all N nodes of a run, N rows of each; None where a part has no compiled form.

    reference: the curve that is looked at, which need not be the one the controller tracked. Nodes
    at jumps are read just before them (`Arc.seen`), where the disturbance has its limit from the
    left.
    """
    nx = trajectory.arcs[0].x.shape[1]
    try:
        program = Program.of(walker, walker.controller_size(nx), curve=reference)
        if trajectory.settings.get("engine") != COMPILED:
            _ = program.machine  # NotCompiled where the controller runs in Python
        code, K = program.reading(signals_at), program.K
    except (NotCompiled, ModelError):
        return None
    first = trajectory.arcs[0]
    example = signals_at(
        walker, first.t[0], first.x[0], first.mode, lambda s, m: tracked_point(reference, s, m)
    )
    shapes = tuple(np.shape(part) for part in example)
    call = Call(code, "reading", K, 0, sum(map(prod, shapes)))
    out = np.vstack([call.rows(_inputs(walker, arc)) for arc in trajectory.arcs])
    return InstantSignals(*parts_of(out, shapes))


def _inputs(walker: Walker, arc: Arc) -> Array:
    """Inputs (K, ..) of the compiled reading at the K nodes of an arc; forces on the feet are zero."""
    n, t, x, mode = walker.plant.n, arc.seen, arc.x, arc.mode
    q, v, ones = x[:, :n], x[:, n : 2 * n], np.ones((len(t), 1))
    try:
        zeta = zeta_rows(pushes(walker.disturbance, n), t, x, mode, n)
    except NotCompiled:
        zeta = np.array([walker.external(*at, mode) for at in zip(t.tolist(), q, v, strict=True)])
    head = (t[:, np.newaxis], mode.step * ones, mode.start * ones)
    return np.hstack((*head, x, zeta, np.zeros((len(t), OUTSIDE))))
