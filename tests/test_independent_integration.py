"""The error under the push that `reproduce` prints, by an integration that shares nothing with its methods.

SciPy's LSODA integrates the Python right-hand side at a relative tolerance of 1e-12, from the state stored just
before the push to just after the peak, piece by piece between the edges of the push. Its orders go up to 12 and
it is implicit where the fastest pole of Table I, 19836 rad/s, would have an explicit method make tiny steps.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import LSODA

from biped_adrc.closed_loop.walker import Mode
from biped_adrc.paper.scenarios import CONTROLLERS, Plan, pushed_run
from biped_adrc.scenario.run import walk_scenario

WITHIN = 0.005
"""Relative difference of two peaks that are the same."""
AROUND = 2e-3
"""[s] Before the push and after the peak that is integrated."""


def peak_error(walker, constraint, mode, t, x, t_end):
    """max |q_b - h(Theta)| from x at t to t_end [s], on the dense output of every step."""
    p, n, most = walker.plant.p, walker.plant.n, 0.0
    edges = [s for s in walker.switching_times(mode) if t < s < t_end]
    for end in [*edges, t_end]:
        before = np.nextafter(end, -np.inf)

        def flow(s, y, before=before):
            return walker.flow(min(s, before), y, mode)

        solver = LSODA(flow, t, x, end, rtol=1e-12, atol=1e-12)
        while solver.status == "running":
            solver.step()
            dense = solver.dense_output()
            for s in np.linspace(solver.t_old, solver.t, 4):
                y = dense(s)
                q_d = constraint.h(float(constraint.phase @ y[:n]))[0]
                most = max(most, float(np.max(np.abs(y[:p] - q_d))))
        assert solver.status == "finished"
        t, x = end, solver.y
    return most


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_the_peak_under_the_push(controller):
    run = pushed_run(Plan(), controller)
    push = run.pushes[0]
    walk = walk_scenario(run.replace(run={"first_step": push.step, "impacts": 1}))
    arc, signals = walk.trajectory.arcs[0], walk.signals
    peak_at = signals.t[np.argmax(np.max(np.abs(signals.error), axis=1))]
    first = np.searchsorted(arc.t, arc.t[0] + push.onset - AROUND)
    t_end = min(peak_at + AROUND, float(arc.t[-1]))
    mode, constraint = Mode(*arc.mode), walk.gait.constraint
    found = peak_error(walk.walker, constraint, mode, float(arc.t[first]), arc.x[first], t_end)
    assert found == pytest.approx(walk.outcome.peak_error, rel=WITHIN)
