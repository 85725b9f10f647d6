"""The first violation of a walk: of hand-made single supports in which it is known, and of a walk cut there."""

from dataclasses import fields, replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.feasibility import first_violation
from biped_adrc.analysis.signals import Signals
from biped_adrc.robots.limits import KnownLimits

KNOWN = KnownLimits(0.6, 150.0, 5e-3)
LATER = {"torque": 0.0, "scuffs": 0.0, "F_N": 3.75e-3, "friction": 3.6e-3}
"""[s] until the mean over 5 ms is outside the cone; torque and depth count at once."""


def step(**begins):
    """A single support of 0.4 s at 300 N in which each violation begins at its time [s]."""
    t = np.linspace(0.0, 0.4, 4001)

    def since(name, before, after):
        return np.where(t >= begins.get(name, np.inf), after, before)

    columns = {f.name: np.zeros((len(t), 4)) for f in fields(Signals)}
    columns |= {"t": t, "step": np.ones(len(t), dtype=int)}
    columns["ground_reaction"] = np.column_stack(
        (since("friction", 0.0, -250.0), since("F_N", 300.0, -100.0))
    )
    columns["u"][:, 2] = since("torque", 149.0, -151.0)
    columns["swing_foot"] = np.column_stack((np.full(len(t), 0.3), since("scuffs", 0.05, -0.002)))
    return Signals(**columns)


@pytest.fixture(scope="module")
def walker(biped, gait):
    return ba.Walker(biped, ba.NPDController(gait.constraint))


@pytest.mark.parametrize("first", LATER)
@pytest.mark.parametrize("second", [None, *LATER])
def test_the_earliest_of_all_is_told(walker, first, second):
    begins = {first: 0.1} if second is None else {second: 0.2, first: 0.1}
    found = first_violation(walker, step(**begins), KNOWN)
    assert found.t == pytest.approx(0.1 + LATER[first], abs=2e-4)
    assert first in found.what


def test_none_is_none_and_a_number_that_is_none_is_one(walker):
    feasible = step()
    assert first_violation(walker, feasible, KNOWN) is None
    u = feasible.u.copy()
    u[7, 1] = np.nan
    assert first_violation(walker, replace(feasible, u=u), KNOWN).t == feasible.t[7]


def test_the_end_of_a_step_counts_unless_the_foot_comes_down_there(walker):
    late = step(scuffs=0.395)
    assert first_violation(walker, late, KNOWN) is None
    assert first_violation(walker, late, KNOWN, finished=False).t == pytest.approx(0.395)


def test_a_walk_is_cut_at_the_node_of_its_first_violation(walker, gait):
    """A push in the second step asks for more than any torque of the first."""
    push = ba.TorquePulse([120.0, 0.0, 0.0, 0.0, 0.0], step=2, start=0.1, stop=0.2)
    walk = ba.walk(replace(walker, disturbance=push), gait, 2)
    s, most = walk.signals, np.max(np.abs(walk.signals.u), axis=1)
    limit = 0.5 * (np.max(most[s.step == 1]) + np.max(most[s.step == 2]))
    assert limit > 1.02 * np.max(most[s.step == 1])
    whole, cut = walk.trajectory, walk.until_infeasible(ba.Limits(torque=limit)).trajectory
    assert cut.status is ba.Status.INFEASIBLE
    assert cut.t_end == s.t[np.argmax(most > limit)]
    assert len(cut.arcs) == 2
    assert cut.arcs[1].event is None
    for one, other in zip(cut.arcs, whole.arcs, strict=True):
        np.testing.assert_array_equal(one.x, other.x[: len(one.t)])
    assert len(cut.arcs[0].t) == len(whole.arcs[0].t)
    assert "torque" in cut.detail
