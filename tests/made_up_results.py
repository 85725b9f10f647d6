"""Results of a reproduction that nobody walked, with which every check and every asserted claim holds."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np

from biped_adrc.analysis.certificate import Certificate
from biped_adrc.analysis.feasibility import Feasibility
from biped_adrc.analysis.half_step import AtTwoSteps
from biped_adrc.gait.published import X_STAR
from biped_adrc.hybrid.status import Status
from biped_adrc.model.ground import KnownLimits
from biped_adrc.paper.pushes import MemberOutcome, MemberWalk, PushCell
from biped_adrc.paper.runs import Order, Runs, SlowStart
from biped_adrc.paper.scenarios import (
    CONTROLLERS,
    MapPush,
    Plan,
    base_runs,
    claim_runs,
    cycle_runs,
    members,
    on_the_recipe,
)
from biped_adrc.scenario.recording import Outcome
from biped_adrc.scenario.scenario import Scenario

PLAN = Plan(quick=True)
SUPPORT = {
    "step": 1,
    "duration": 0.4,
    "scuffing": 0.0,
    "riser": 0.0,
    "slip": 0.0,
    "missed_stone": 0.0,
}
SUPPORT |= {"rate_share": 0.0, "beyond_range": 0.0, "joints": {}}
FORCES = {"least_normal_force": 200.0, "friction": 0.4, "impulse_ratio": 0.5, "peak_torque": 100.0}
MEANS = {"mean_normal_force": 200.0, "mean_friction": 0.4}
# friction, torque [N m] and window [s]
LIMITS = {"limits": KnownLimits(0.6, 150.0, 5e-3)}
STEP = {"step_length": 0.3, "old_foot_velocity": 0.1, "clearance": 0.01, "cost_of_transport": 0.3}
ENERGY = {"joint_work": 10.0, "energy_lost": 10.0}
CERTIFICATE = Certificate(**SUPPORT, **FORCES, **MEANS, **LIMITS, **STEP, **ENERGY)
FEASIBILITY = Feasibility(Status.COMPLETED, (CERTIFICATE,), 1)


def figure(value, change=1e-3):
    return AtTwoSteps(value * (1.0 + change), value)


def outcome(controller, peak=1e-2, impacts=9, asked=9, half=True, **more):
    """A walk, by default with the same at half the step."""
    status = "COMPLETED" if impacts == asked else "FELL"
    x, times = np.tile(X_STAR, (impacts, 1)), np.full(impacts, 0.4)
    kept = (peak, peak, 100.0, (CERTIFICATE,), FEASIBILITY, "rk4", "compiled")
    made = Outcome(Scenario(controller, run={"impacts": asked}), status, impacts, x, times, *kept)
    found = replace(made, **more)
    return replace(found, half=found) if half else found


def walk(error, *, made=True, rate=1e-9, change=1e-3):
    """A member of the set under one controller."""
    f, longest = figure(error, change), figure(0.4 if made else np.inf)
    return MemberWalk(f, f, figure(rate), longest, AtTwoSteps(0.0, 0.0), {})


def member(npd=None, adrc=None, of=None):
    walked = {"NPD": npd or walk(1e-2, rate=1e-3), "ADRC": adrc or walk(1e-6)}
    return MemberOutcome(of or members()[0], walked)


def cell(npd, adrc, doubtful=False, onset=0.1):
    # of 90 N m with the same sign on all motors, without a torque limit
    push, one = MapPush("identified", onset, 90.0, "all +", None), ended(adrc)
    other = replace(one, half=replace(one, status="STALLED")) if doubtful else one
    return PushCell(push, ended(npd), other)


def ended(word):
    """A walk of the map that is called so, "pulled" by the ground's force."""
    status = {"fell": "FELL", "ended": "STALLED"}.get(word, "COMPLETED")
    odd = {"infeasible": ("mean_friction", 0.9), "pulled": ("mean_normal_force", -1.0)}
    odd["but_impact"] = ("impulse_ratio", 0.9)
    support = replace(CERTIFICATE, **dict([odd[word]] if word in odd else []))
    f = replace(FEASIBILITY, status=Status[status], supports=(support,))
    return outcome("NPD", feasibility=f, status=status)


def cycle(*sizes, change=0.0):
    """A walking cycle with these multipliers, which the step changes by so much."""
    orbit, half = (
        SimpleNamespace(multipliers=np.array(sizes) + moved, x_minus=X_STAR, stable=sizes[0] < 1.0)
        for moved in (0.0, change)
    )
    return SimpleNamespace(orbit=orbit, half=half, delta_squared=0.694, record=dict, gap=change)


def head(controller, peak=None, **more):
    peak = peak or {"NPD": 1e-2, "ADRC": 1e-5}[controller]
    quarter = outcome(controller, peak * 1.0001, half=False)
    half = replace(outcome(controller, peak * 1.0002, half=False), half=quarter)
    found = replace(outcome(controller, peak * 1.0004, half=False, **more), half=half)
    laws = {"height": 0.0, "energy": 0.0}
    return SimpleNamespace(outcome=found, laws=laws, trajectory=None)


def results(**odd):
    """Everything holds, but for the entries given as {kind: {name: value}}."""
    runs = {}
    for name in {**base_runs(PLAN), **claim_runs(PLAN)}:
        c = name.rpartition(" ")[2]
        runs[name] = outcome(c, {"NPD": 1e-2, "ADRC": 1e-5}[c])
    more = {name: runs.pop(name) for name in claim_runs(PLAN)}
    # two gains, bandwidth [rad/s], delay margin [s], error per disturbance at 5 Hz, peak error under a push
    order = Order(1.0, 1.0, 500.0, 1e-3, 1e-6, figure(1e-4))
    walked = {c: outcome(c, impacts=0) for c in CONTROLLERS}
    made = {
        "headline": {c: head(c) for c in CONTROLLERS},
        "engines": dict.fromkeys(CONTROLLERS, 1e-14),
        "runs": runs,
        "claim_runs": more,
        "members": {"identified": [member(of=m) for m in members("identified")]},
        "pushed_recipe": {"identified": [member(of=on_the_recipe("identified"))]},
        "starts": {
            "identified": [
                SlowStart(0.58, 0.97, walked),
                SlowStart(0.58, 1.03, {c: outcome(c) for c in CONTROLLERS}),
            ]
        },
        "jumps": {
            "identified": {
                "xi_at_impact": 20.0,
                "xi_at_an_edge": 30.0,
                "published": 1e-14,
                "recipe": 2.0,
                "period": 0.4,
            }
        },
        "orders": {
            "identified": {
                "Table I": order._replace(largest_gain=2.0, noise_gain=0.5),
                "equal bandwidth": order,
                "equal delay margin": order,
            }
        },
        "model": {"identified": dict.fromkeys(("law of D_s", "law of the impact"), 1e-15)},
        "map": {"": [cell("feasible", "feasible")]},
        "cycles": {name: cycle(0.7) for name in cycle_runs(PLAN)},
        "multipliers": {"NPD": cycle(0.694, 1e-5), "ADRC": cycle(0.694)},
        "numerics": {
            "": dict(zip("abcdefgh", (2e-5, 2e-5, 2e-5, 1e-5, 1.0, 4.0, 3.0, 1e-6), strict=True))
        },
    }
    return Runs(PLAN, **{kind: {**found, **odd.get(kind, {})} for kind, found in made.items()})
