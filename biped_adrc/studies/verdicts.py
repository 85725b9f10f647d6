"""From the outcomes of the reproduction to its checks and tables; nothing here is typed in."""

from __future__ import annotations

from typing import Any

import numpy as np

from biped_adrc.gait.published import X_STAR
from biped_adrc.scenario.build import Scene
from biped_adrc.scenario.outcome import Outcome
from biped_adrc.studies.checks import Check, at_least, at_most, below
from biped_adrc.studies.convergence import (
    MULTIPLIER_ROUND_OFF,
    convergence_check,
    observed_order,
)
from biped_adrc.studies.plan import BOTH, Headline, Plan, RecipeResult
from biped_adrc.studies.poincare import PoincareResult
from biped_adrc.types import Array

Results = dict[str, Any]


def distance(outcome: Outcome) -> float:
    """max |x- - x*| at the last impact; infinite when the robot fell before."""
    if not outcome.walked:
        return float("inf")
    return float(np.max(np.abs(outcome.x_minus[-1][: len(X_STAR)] - X_STAR)))


def consistency_checks(plan: Plan, r: Results) -> list[Check]:
    """Gait (a) closes on the published x* under both controllers in every preset."""
    found = []
    for preset in plan.presets:
        for c in BOTH:
            o: Outcome = r[f"nominal {preset} {c}"]
            name = f"gait (a), {preset}, {c}: distance to x* after {o.impacts} impacts"
            found.append(at_most(name, "consistency", distance(o), 5e-4))
    return found


def certificate_checks(plan: Plan, r: Results) -> list[Check]:
    """Nominal walking within dry friction and RABBIT's torque."""
    found = []
    for preset in plan.presets:
        for c in BOTH:
            all_steps = r[f"nominal {preset} {c}"].certificates
            # NumPy's, since max and min pass over a NaN; without a step nothing holds
            friction = float(np.max([s.friction for s in all_steps] or [np.inf]))
            torque = float(np.max([s.peak_torque for s in all_steps] or [np.inf]))
            normal = float(np.min([s.least_normal_force for s in all_steps] or [-np.inf]))
            name = f"gait (a), {preset}, {c}"
            found += [
                at_most(f"{name}: friction needed", "consistency", friction, 0.6),
                at_most(f"{name}: peak torque [N m]", "consistency", torque, 150.0),
                at_least(f"{name}: least normal force [N]", "consistency", normal, 0.0),
            ]
    return found


def multiplier_checks(r: Results) -> list[Check]:
    """The multiplier of the walking cycle is delta^2; everything is inside the unit circle."""
    npd: PoincareResult = r["multipliers NPD"]
    sizes = np.abs(npd.orbit.multipliers)
    found = [
        at_most(
            "NPD: largest multiplier against delta^2 of the zero dynamics",
            "law",
            abs(sizes[0] - npd.delta_squared),
            1e-5,
        ),
        below("NPD: the other eight multipliers", "reproduced", sizes[1], 1e-3),
    ]
    for name, what in (
        ("multipliers ADRC", "ADRC: largest of {} multipliers, observer states included"),
        (
            "multipliers ADRC measured",
            "ADRC, reset 'measured' (xi^ remembered): largest of {} multipliers",
        ),
    ):
        if name in r:
            z = np.abs(r[name].orbit.multipliers)
            found.append(below(what.format(len(z)), "reproduced", float(z[0]), 1.0))
    return found


def push_checks(r: Results) -> list[Check]:
    """Figures 4 and 5: both walk on, and ADRC tracks a hundred times better."""
    npd, adrc = (r[f"headline {c}"].outcome for c in BOTH)
    sine = {c: r[f"sine {c}"] for c in BOTH}
    found = []
    for name, pair in (("the push", (npd, adrc)), ("the 5 Hz sine", (sine["NPD"], sine["ADRC"]))):
        found += [made_check(name, o) for o in pair]
        ratio = pair[1].peak_error / pair[0].peak_error
        found.append(at_most(f"{name}: peak error of ADRC over NPD's", "reproduced", ratio, 0.01))
    found += [made_check("the push at 1 kHz", r[f"1 kHz {c}"]) for c in BOTH]
    for kind in ("masses", "masses and inertias"):
        name, heavy = f"heavier plant ({kind})", {c: r[f"heavier, {kind} {c}"] for c in BOTH}
        found += [made_check(name, o) for o in heavy.values()]
        ratio = heavy["ADRC"].peak_error / heavy["NPD"].peak_error
        found.append(below(f"{name}: peak error of ADRC over NPD's", "reproduced", ratio, 1.0))
    torso = {c: r[f"torso {c}"] for c in BOTH}
    found += [made_check("push on the unactuated torso", o) for o in torso.values()]
    name = "push on the unactuated torso: step periods of ADRC and NPD differ, share of a period"
    gap = period_gap(*(torso[c].durations for c in BOTH))
    return [*found, at_most(name, "reproduced", gap, 0.01)]


def made_check(name: str, o: Outcome) -> Check:
    """Every impact asked for is made."""
    label = f"{name}, {o.run.controller}: impacts made of {o.run.impacts}"
    return at_least(label, "reproduced", o.impacts, o.run.impacts)


def period_gap(one: Array, other: Array) -> float:
    """Largest difference of the times of steps, over a usual one of `one`; infinite without as many steps."""
    if len(one) != len(other) or len(one) == 0:
        return float("inf")
    return float(np.max(np.abs(one - other))) / float(np.median(one[:2]))


def engine_checks(r: Results) -> list[Check]:
    """The two engines over the pushed step, at equal method and step: the state before the next impact."""
    checks = []
    for c in BOTH:
        one: Outcome = r[f"engines {c}"]
        other = one.half
        assert other is not None
        same = one.x_minus.shape == other.x_minus.shape and len(one.x_minus) > 0
        n = Scene.of(one.run).biped.n
        gap = np.abs(one.x_minus - other.x_minus)[:, : 2 * n] if same else np.array([np.inf])
        name = f"{c} over the pushed step: compiled against Pinocchio, (q, q') at the impact [rad, rad/s]"
        checks.append(at_most(name, "law", float(np.max(gap)), 1e-6))
    return checks


def run_twice(r: Results) -> dict[str, Outcome]:
    """Every outcome that was computed at two steps, by name."""
    found = {f"push {c}": headline_of(r, c).outcome for c in BOTH}
    found |= {
        name: value
        for name, value in r.items()
        if isinstance(value, Outcome) and not name.startswith("engines")
    }
    for value in r.values():
        if isinstance(value, RecipeResult) and value.outcome is not None:
            found[f"gait (b) {value.preset} {value.controller}"] = value.outcome
    return {name: o for name, o in found.items() if o.half is not None}


def convergence_checks(r: Results) -> list[Check]:
    """No figure of merit moves when every step is halved; the headline's peak at a third step has an order."""
    found = [convergence_check(name, o) for name, o in run_twice(r).items()]
    head = headline_of(r, "ADRC").outcome
    order = observed_order(head, lambda o: o.peak_error)
    name = "order in the step of ADRC's largest error under the push, from three steps"
    found.append(at_least(name, "law", order, 1.0))
    for name in sorted(r):
        if isinstance(r[name], PoincareResult):
            text = f"{name}: {CHANGE}"
            found.append(at_most(text, "law", r[name].gap, MULTIPLIER_ROUND_OFF))
        if isinstance(r[name], RecipeResult) and r[name].closes:
            gap = r[name].record["multipliers_change"]
            text = f"gait (b), {r[name].preset}, {r[name].controller}: {CHANGE}"
            found.append(at_most(text, "law", gap, MULTIPLIER_ROUND_OFF))
    return found


CHANGE = (
    "largest change of a multiplier when the step is halved, against the round-off of finite differences, "
    "below which a multiplier is not told from zero"
)


def recipe_checks(plan: Plan, r: Results) -> list[Check]:
    """Gait (b) closes in a stable cycle; its certificates are reported, not asserted."""
    found = []
    for preset in plan.presets:
        for c in BOTH:
            result: RecipeResult = r[f"recipe {preset} {c}"]
            largest = result.record["multipliers"][0] if result.closes else float("inf")
            name = f"gait (b), {preset}, {c}: largest multiplier of its cycle"
            found.append(below(name, "reproduced", largest, 1.0))
    return found


def recipe_notes(r: Results, plan: Plan) -> list[str]:
    """Plain sentences on gait (b)."""
    notes = []
    for preset in plan.presets:
        for c in BOTH:
            found: RecipeResult = r[f"recipe {preset} {c}"]
            if found.closes:
                gap = float(np.max(np.abs(found.record["distance_to_x_star"])))
                notes.append(
                    f"Gait (b), {preset}, {c}: closes, {'stable' if found.record['stable'] else 'unstable'}, "
                    f"farthest component from x* {gap:.3g}."
                )
            else:
                notes.append(f"Gait (b), {preset}, {c}: no cycle found: {found.reason}")
    return notes


def headline_of(r: Results, controller: str) -> Headline:
    """The pushed run of a controller."""
    found: Headline = r[f"headline {controller}"]
    return found
