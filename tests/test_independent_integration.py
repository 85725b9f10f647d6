"""The errors that `reproduce` prints, by an integration that shares nothing with its methods.

From the state stored before the pushed step SciPy's LSODA integrates the Python right-hand side over that
step, at a relative tolerance of 1e-12, piece by piece between the edges of the push. Its orders go up to 12 and
it is implicit where the fastest pole of Table I, 19836 rad/s, would have an explicit method make tiny steps.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import LSODA

from biped_adrc.closed_loop.walker import Mode
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.paper.plan import Plan, headline, pushed_run
from biped_adrc.scenario.build import RobotAndGait, build

WITHIN = 0.005
"""Relative difference of two peaks that are the same."""


def peak_error(walker, constraint, x, mode, t_end):
    """max |q_b - h(Theta)| from x at the start of `mode` to t_end [s], on the dense output of every step."""
    p, n, most, t = walker.plant.p, walker.plant.n, 0.0, mode.start
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
@pytest.mark.parametrize("preset", ["identified", "identified-bare", "tac2003"])
def test_the_peak_under_the_push(preset, controller):
    run = pushed_run(Plan(preset), controller)
    found, _ = headline(run)
    step = run.pushes[0].step
    arc = next(arc for arc in found.trajectory.arcs if arc.mode.step == step)
    scene = RobotAndGait.of(run)
    walker, gait = build(run, scene), scene.walked
    mode = Mode(*arc.mode)
    peak = peak_error(walker, gait.constraint, arc.x[0], mode, float(arc.t[-1]))
    assert peak == pytest.approx(found.outcome.peak_error, rel=WITHIN)
