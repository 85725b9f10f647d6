"""Figures of merit: their peaks between nodes, their steps, and what a made-up pair of outcomes comes to.

A node is an instant at which a walk is stored. "Steps" are integration steps: a number that halving them
changes by more than 1 % (AGREE) says something of the method and not of the robot. An outcome has the same walk
at half the step in `half`.
"""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import LSODA

import biped_adrc as ba
from biped_adrc.analysis.half_step import AGREE, error_text
from biped_adrc.analysis.signals import integrate, largest
from biped_adrc.closed_loop.walker import Mode
from biped_adrc.engine.program import COMPILED
from biped_adrc.paper.metrics import largest_gap, order_of_error
from biped_adrc.paper.scenarios import CONTROLLERS, Plan, pushed_run
from biped_adrc.scenario.build import build
from biped_adrc.scenario.integration import FINE_STEP, WalkPart, in_parts, refined
from biped_adrc.scenario.walk import execute_twice, halved, step_options, walk_scenario

from .made_up_results import outcome


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_peak_of_a_cubic_lies_between_its_nodes(sign):
    """From 1 to 3 the cubic with 5 and slopes 4, -4 at its ends has 5 + 2 (4 + 4) / 8 = 7 in the middle; no
    cubic may go through both values of the jump at 1. sign -1: the peak is that of |y|."""
    t = np.array([0.0, 1.0, 1.0, 3.0])  # a jump at 1
    y = sign * np.array([0.0, 2.0, 5.0, 5.0])
    dy = sign * np.array([3.0, 3.0, 4.0, -4.0])
    assert largest(t, y[:, None], dy[:, None]) == pytest.approx(5.0 + 2.0, abs=1e-12)


def test_the_peak_between_nodes_is_of_more_than_third_order():
    """The peak of sin(t), which is 1, on ever finer nodes: halving their distance leaves less than an eighth of
    the error, unless that was below 1e-6. In the end it is, and the maximum over nodes alone is not.
    """
    gaps = []
    for count in (11, 21, 41):
        t = np.linspace(0.1, 2.9, count)
        gaps.append(abs(largest(t, np.sin(t)[:, None], np.cos(t)[:, None]) - 1.0))
    nodes = np.max(np.sin(np.linspace(0.1, 2.9, 10)))
    assert gaps[1] < gaps[0] / 8.0 or gaps[0] < 1e-6
    assert gaps[2] < 1e-6 < 1.0 - nodes


def test_the_peak_and_the_integral_of_a_signal_with_nan_are_infinite():
    """Infinite breaks every upper limit; a maximum that skips the NaN would keep it."""
    t, y = np.linspace(0.0, 1.0, 5), np.array([0.0, 1.0, np.nan, 1.0, 0.0])
    assert largest(t, y[:, None], y[:, None]) == math.inf
    assert integrate(t, y) == math.inf


def walked(**values):
    """The outcome of a made-up walk of two steps, with these values."""
    return outcome("ADRC", 1e-3, **{"impacts": 2, "asked": 2, "half": False} | values)


@pytest.mark.parametrize(
    ("half", "holds"),
    [
        ({}, True),
        ({"peak_error": 1.009e-3}, True),
        ({"peak_error": 1.012e-3}, False),
        ({"peak_error": math.nan}, False),
        ({"peak_torque": 102.0}, False),
        ({"durations": np.array([0.4, 0.41])}, False),
        ({"status": "FELL"}, False),
        ({"impacts": 1}, False),
    ],
)
def test_two_steps_have_to_agree(half, holds):
    """`half`: what is different at half the step. Within 1 % holds (the peak error is 1e-3 rad, the torque
    100 N m, a step 0.4 s); more, no number or another ending does not."""
    o = replace(walked(), half=walked(**half))
    assert (largest_gap(o) <= AGREE) is holds


@pytest.mark.parametrize(
    ("half", "word"),
    [
        ((1.001e-3, "COMPLETED", 2), "rad (1.001e-03 at half the step)"),
        (
            (2e-3, "COMPLETED", 2),
            "the integration step decides its digits; shorten it, as --set x=1",
        ),
        ((1e-3, "FELL", 1), "ends as FELL after 1 impacts: shorten the step, as --set x=1"),
    ],
)
def test_an_error_is_printed_with_what_the_step_does_to_it(half, word):
    """A walk has an error of 1e-3 rad; in brackets behind it stands what half the step gives. `half`: (error
    [rad], status, impacts) there. 0.1 % apart it is the other error alone, a factor of 2 or another ending has
    a hint (`word`)."""
    text = error_text("--set x=1", (1e-3, "COMPLETED", 2), half)
    assert text.startswith("1.000e-03 rad (")
    assert word in text


@pytest.mark.parametrize(
    ("asked", "options"),
    [
        ({}, "--set run.h=0.00025 --set run.fine=2.5e-05"),
        ({"controller": "NPD"}, "--set run.h=0.0005"),
        ({"run.method": "adaptive", "run.tolerance": 1e-6}, "--set run.tolerance=1e-08"),
        ({"hardware": "ideal", "ground": "mujoco"}, "--set ground.plant_step=0.0001"),
    ],
)
def test_the_hint_names_the_values_that_shorten_the_step_of_this_walk(asked, options):
    """The steps are named and halved that the scenario `asked` for, or has by default: of the rigid plant with
    the one around a push, of the adaptive method its tolerance, of soft ground the plant's own."""
    s = ba.Scenario().replace(asked)
    each = [
        SimpleNamespace(scenario=x) for x in (s, halved(s, build(s)))
    ]  # of a walk no more is used
    assert step_options(*each) == options


@pytest.mark.parametrize("limit", [1.0, 0.0, -0.1])
@pytest.mark.parametrize("order", [-1.0, 1.0, 3.0])
def test_the_observed_order_is_that_of_the_error(limit, order):
    """Three peak errors limit + (h / h_0)^order at h = h_0 / 2, / 4, / 8 give back the order, whatever the
    limit is; a negative order diverges."""
    one, half, quarter = (walked(peak_error=limit + 2.0 ** (-order * k)) for k in (1, 2, 3))
    o = replace(one, half=replace(half, half=quarter))
    assert order_of_error(o) == pytest.approx(order)


def test_fine_steps_go_where_a_push_switches(biped, gait):
    """The push switches in single support 3 of 6, and what it leaves lasts into the next: (impacts, step [s])
    of the three parts of the walk. Without a push one part is enough."""
    push = ba.TorquePulse([1.0] * 5, step=3, start=0.1, stop=0.3)
    walker = ba.Walker(biped, ba.ADRCController(gait.constraint), push)
    parts = refined(walker, 6, 1, ba.RK4(1e-3), 1e-4)
    assert [(p.impacts, p.method.h) for p in parts] == [(2, 1e-3), (2, 1e-4), (2, 1e-3)]
    assert refined(replace(walker, disturbance=None), 6, 1, ba.RK4(1e-3), 1e-4) == (
        WalkPart(6, ba.RK4(1e-3)),
    )


def test_a_walk_in_parts_is_the_walk(biped, gait):
    """Cut after 1 and 3 of 4 impacts and joined, bit by bit the same as the walk in one piece."""
    push = ba.TorquePulse([5.0] * 5, step=2, start=0.1, stop=0.3)
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), push)
    whole = ba.walk(walker, gait, 4, ba.RK4(1e-3), engine="compiled").trajectory
    parts = tuple(WalkPart(n, ba.RK4(1e-3)) for n in (1, 2, 1))
    joined = in_parts(walker, gait.start(biped), Mode(1), parts, "compiled")
    assert [arc.mode for arc in joined.arcs] == [arc.mode for arc in whole.arcs]
    for one, other in zip(joined.arcs, whole.arcs, strict=True):
        assert np.array_equal(one.x, other.x)
        assert np.array_equal(one.t, other.t)
    assert "(steps 2 to 3)" in joined.settings["method"]


def test_the_default_of_adrc_resolves_the_spike_after_a_push(biped, gait):
    """The tracking error after an edge of the push is a spike of 1 to 2 ms, too short for steps of 1 ms: by
    default they are FINE_STEP (0.05 ms). The peak is that with five times finer steps."""
    push = ba.TorquePulse([30.0] * 4 + [0.0], step=1, start=0.1, stop=0.3)
    walker = ba.Walker(biped, ba.ADRCController(gait.constraint), push)
    walk = ba.walk(walker, gait, 1, engine="compiled")
    assert f"h = {FINE_STEP:g} s" in walk.trajectory.settings["method"]
    fine = ba.walk(walker, gait, 1, ba.Exponential(1e-5), engine="compiled")
    assert walk.signals.peak_error == pytest.approx(fine.signals.peak_error, rel=0.01)


@pytest.mark.parametrize("controller", CONTROLLERS)
def test_the_headline_does_not_depend_on_its_step(controller):
    """The pushed step 19 of the headline walk and the one after: halving the integration step changes no
    figure of merit by more than 1 %."""
    run = pushed_run(Plan(), controller).replace(run={"first_step": 19, "impacts": 2})
    assert run.run.engine == COMPILED
    assert largest_gap(execute_twice(run)) <= AGREE


def test_energy_is_balanced_in_the_pushed_step():
    """Energy gained minus the work of motors and push in single support 19 [J]: no force is left out and none
    counted twice."""
    from biped_adrc.paper.physical_laws import walk_laws

    run = pushed_run(Plan(), "ADRC").replace(run={"first_step": 19, "impacts": 1})
    assert walk_laws(walk_scenario(run))["energy"] <= 1e-4


def test_thinning_keeps_ends_and_both_sides_of_jumps(biped, gait):
    """From nodes 0.1 ms apart those 1 ms apart are kept, about a tenth; a repeated time is a jump, and both
    edges of the push stay. Peak error and work hardly change."""
    push = ba.TorquePulse([5.0] * 5, step=1, start=0.1, stop=0.3)
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), push)
    walk = ba.walk(walker, gait, 2, ba.RK4(1e-4), engine="compiled")
    thin = tuple(arc.thinned(1e-3) for arc in walk.trajectory.arcs)
    for one, other in zip(thin, walk.trajectory.arcs, strict=True):
        assert len(one.t) < 0.12 * len(other.t)
        assert (one.t[0], one.t[-1]) == (other.t[0], other.t[-1])
        assert set(one.t) <= set(other.t)
    assert np.sum(np.diff(thin[0].t) == 0.0) == 2  # the edges of the push
    fewer = replace(walk, trajectory=replace(walk.trajectory, arcs=thin))
    assert fewer.signals.peak_error == pytest.approx(walk.signals.peak_error, rel=1e-3)
    assert fewer.certificates[0].joint_work == pytest.approx(
        walk.certificates[0].joint_work, rel=1e-6
    )


# -- an integration that shares nothing -------------------------------------------------------------
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

        solver = LSODA(flow, t, x, end, rtol=1e-9, atol=1e-9)
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
    """SciPy's LSODA integrates the Python right-hand side at a relative tolerance of 1e-9, from the state
    stored just before the push to just after the peak, piece by piece between the edges of the push. Its orders
    go up to 12 and it is implicit where the fastest pole of Table I, 19836 rad/s, would have an explicit method
    make tiny steps.
    """
    run = pushed_run(Plan(), controller)
    push = run.pushes[0]
    walk = walk_scenario(run.replace(run={"first_step": push.step, "impacts": 1}))
    arc, signals = walk.trajectory.arcs[0], walk.signals
    peak_at = signals.t[np.argmax(np.max(np.abs(signals.error), axis=1))]
    # AROUND: 2 ms before the push and after the peak
    first = np.searchsorted(arc.t, arc.t[0] + push.onset - AROUND)
    t_end = min(peak_at + AROUND, float(arc.t[-1]))
    mode, constraint = Mode(*arc.mode), walk.gait.constraint
    found = peak_error(walk.walker, constraint, mode, float(arc.t[first]), arc.x[first], t_end)
    assert found == pytest.approx(walk.outcome.peak_error, rel=WITHIN)  # 0.5 %
