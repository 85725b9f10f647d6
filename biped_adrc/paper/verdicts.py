"""From the results of the reproduction to its checks: what has to hold, with the value and the limit.

Each function takes the `Results` of all runs and returns checks (`checks.Check`) of one kind: physical law,
consistency with what the gait was designed for, or a result of the paper that could have failed to reproduce.
Values are computed from the runs, none is typed in. Where NaN may occur NumPy's max and min are used, since
Python's pass over it and a check would hold without a number.

Called by `paper.reproduction`, which writes the checks to the summary and sets the exit code.

Kinds of checks (`checks.KINDS`) and what a broken one means:

    law           the program is wrong: physics or numerics
    consistency   a gait does not do what it was designed for
    reproduced    the paper's statement does not hold for this robot
"""

from __future__ import annotations

import numpy as np

from biped_adrc.checks import Check, at_least, at_most, below
from biped_adrc.gait.published import X_STAR
from biped_adrc.paper.convergence import MULTIPLIER_ROUND_OFF, convergence_check, observed_order
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.paper.plan import Plan
from biped_adrc.paper.results import Results
from biped_adrc.scenario.build import RobotAndGait
from biped_adrc.scenario.outcome import Outcome
from biped_adrc.types import Array


def distance(outcome: Outcome) -> float:
    """max |x- - x*| [rad, rad/s] at the last impact, over angles and rates; infinite when the robot fell
    before.
    """
    if not outcome.walked:
        return float("inf")
    return float(np.max(np.abs(outcome.x_minus[-1][: len(X_STAR)] - X_STAR)))


def consistency_checks(plan: Plan, r: Results) -> list[Check]:
    """Gait (a) returns to the published x* under both controllers in every preset, as it was designed to do."""
    walks = {f"{_gait(name, 'a')}: distance to x*": o for name, o in r.nominal(plan)}
    return [
        at_most(f"{name} after {o.impacts} impacts", "consistency", distance(o), 5e-4)
        for name, o in walks.items()
    ]


def _gait(name: str, gait: str) -> str:
    """ "gait (a), preset, controller", from "preset controller", as checks name a walk."""
    return f"gait ({gait}), {', '.join(name.split())}"


def certificate_checks(plan: Plan, r: Results) -> list[Check]:
    """Undisturbed walking on gait (a) stays within dry friction and RABBIT's motors, in every preset.

    Friction |F_T| / F_N at most 0.6, torque at most 150 N m, normal force F_N never negative, each the worst
    over all steps. Without a finished step the values are infinite, so that nothing holds.
    """
    found = []
    for of, o in r.nominal(plan):
        # NumPy's, since max and min pass over a NaN; without a step nothing holds
        friction = float(np.max([s.friction for s in o.certificates] or [np.inf]))
        torque = float(np.max([s.peak_torque for s in o.certificates] or [np.inf]))
        normal = float(np.min([s.least_normal_force for s in o.certificates] or [-np.inf]))
        name = _gait(of, "a")
        found += [
            at_most(f"{name}: friction needed", "consistency", friction, 0.6),
            at_most(f"{name}: peak torque [N m]", "consistency", torque, 150.0),
            at_least(f"{name}: least normal force [N]", "consistency", normal, 0.0),
        ]
    return found


def multiplier_checks(r: Results) -> list[Check]:
    """The multipliers of the walking cycle, against the closed form and the unit circle.

    NPD: the largest equals delta^2 of the zero dynamics (within the accuracy of finite differences), all others
    are practically zero, since the tracking error has decayed. ADRC: all are below 1, the observer's states
    being coordinates of the return map too.
    """
    npd = r.multipliers["NPD"]
    sizes = np.abs(npd.orbit.multipliers)
    closed = "NPD: largest multiplier against delta^2 of the zero dynamics"
    found = [
        at_most(closed, "law", abs(sizes[0] - npd.delta_squared), 1e-5),
        below("NPD: the other eight multipliers", "reproduced", sizes[1], 1e-3),
    ]
    for name, what in (
        ("ADRC", "ADRC: largest of {} multipliers, observer states included"),
        ("ADRC measured", "ADRC, reset 'measured' (xi^ remembered): largest of {} multipliers"),
    ):
        if name in r.multipliers:
            z = np.abs(r.multipliers[name].orbit.multipliers)
            found.append(below(what.format(len(z)), "reproduced", float(z[0]), 1.0))
    return found


def push_checks(r: Results) -> list[Check]:
    """What figures 4 and 5 show: both controllers walk on, and ADRC's largest error is at most 1 % of NPD's.

    The same for a sine of 5 Hz; a heavier plant has to be tracked better; sampled at 1 kHz both walk on. A push
    on the torso enters the unactuated row, which neither controller can cancel: both change their step times
    alike.
    """
    npd, adrc = (r.heads[c].outcome for c in CONTROLLERS)
    found = []
    for name, pair in (("the push", (npd, adrc)), ("the 5 Hz sine", r.pair("sine"))):
        found += [*_made(name, pair), at_most(*_ratio(name, pair), 0.01)]
    found += _made("the push at 1 kHz", r.pair("1 kHz"))
    for kind in ("masses", "masses and inertias"):
        name, heavy = f"heavier plant ({kind})", r.pair(f"heavier, {kind}")
        found += [*_made(name, heavy), below(*_ratio(name, heavy), 1.0)]
    torso = r.pair("torso")
    found += _made("push on the unactuated torso", torso)
    name = "push on the unactuated torso: step periods of ADRC and NPD differ, share of a period"
    gap = period_gap(*(o.durations for o in torso))
    return [*found, at_most(name, "reproduced", gap, 0.01)]


def _ratio(name: str, pair: tuple[Outcome, Outcome]) -> tuple[str, str, float]:
    """Name, kind and value of a check on the peak error of ADRC over that of NPD."""
    ratio = pair[1].peak_error / pair[0].peak_error
    return f"{name}: peak error of ADRC over NPD's", "reproduced", ratio


def _made(name: str, pair: tuple[Outcome, Outcome]) -> list[Check]:
    """The checks that both walks make all impacts asked for."""
    label = f"{name}, {{}}: impacts made of {{}}"
    return [
        at_least(
            label.format(r.controller.name, r.run.impacts), "reproduced", o.impacts, r.run.impacts
        )
        for o in pair
        for r in [o.run]
    ]


def period_gap(one: Array, other: Array) -> float:
    """Largest difference of step times between two walks, relative to a usual step of the first.

    one, other: (K,) step times [s]. Infinite where the numbers of steps differ.
    """
    if len(one) != len(other) or len(one) == 0:
        return float("inf")
    return float(np.max(np.abs(one - other))) / float(np.median(one[:2]))


def engine_checks(r: Results) -> list[Check]:
    """Both engines integrate the pushed step alike: (q, q') before the next impact [rad, rad/s].

    At equal method and step. The right-hand sides come from different sources (Pinocchio, and generated code),
    so that an error in one of them shows here.
    """
    checks = []
    for c in CONTROLLERS:
        one = r.engines[c]
        other = one.half
        assert other is not None
        same = one.x_minus.shape == other.x_minus.shape and len(one.x_minus) > 0
        n = RobotAndGait.of(one.run).biped.n
        gap = np.abs(one.x_minus - other.x_minus)[:, : 2 * n] if same else np.array([np.inf])
        name = f"{c} over the pushed step: compiled against Pinocchio, (q, q') at the impact [rad, rad/s]"
        checks.append(at_most(name, "law", float(np.max(gap)), 1e-6))
    return checks


def convergence_checks(r: Results) -> list[Check]:
    """No figure of merit and no multiplier depends on the integration step.

    Every run that was made at two steps; the order of the headline's peak error from three steps; every
    multiplier against the round-off of finite differences.
    """
    order = observed_order(r.heads["ADRC"].outcome, lambda o: o.peak_error)
    name = "order in the step of ADRC's largest error under the push, from three steps"
    gaps = {f"multipliers {c}": r.multipliers[c].gap for c in sorted(r.multipliers)}
    for of, found in sorted(r.recipe.items()):
        if found.closes:
            gaps[_gait(of, "b")] = found.record["multipliers_change"]
    return [
        *(convergence_check(name, o) for name, o in r.run_twice.items()),
        at_least(name, "law", order, 1.0),
        *(at_most(f"{of}: {CHANGE}", "law", g, MULTIPLIER_ROUND_OFF) for of, g in gaps.items()),
    ]


CHANGE = (
    "largest change of a multiplier when the step is halved, against the round-off of finite differences, "
    "below which a multiplier is not told from zero"
)


def recipe_checks(plan: Plan, r: Results) -> list[Check]:
    """Gait (b), designed by the recipe of section IV, has a stable walking cycle."""
    return [
        below(
            f"gait (b), {x.preset}, {x.controller}: largest multiplier of its cycle",
            "reproduced",
            x.record["multipliers"][0] if x.closes else float("inf"),
            1.0,
        )
        for x in r.recipes(plan)
    ]


def recipe_notes(r: Results, plan: Plan) -> list[str]:
    """A sentence on gait (b) for each preset and controller: whether it closes, and how far from x*."""
    notes = []
    for x in r.recipes(plan):
        said = f"no cycle found: {x.reason}"
        if x.closes:
            gap = float(np.max(np.abs(x.record["distance_to_x_star"])))
            word = "stable" if x.record["stable"] else "unstable"
            said = f"closes, {word}, farthest component from x* {gap:.3g}."
        notes.append(f"Gait (b), {x.preset}, {x.controller}: {said}")
    return notes
