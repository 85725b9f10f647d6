"""What a reproduction comes to, in sentences whose every number is taken from its runs."""

from __future__ import annotations

import numpy as np

from biped_adrc.analysis.legality import OUTCOMES
from biped_adrc.scenario.outcome import Outcome
from biped_adrc.studies.plan import BOTH, RISE, Plan
from biped_adrc.studies.push_map import Cell, certain, counts
from biped_adrc.studies.results import Results
from biped_adrc.studies.verdicts import distance


def findings(plan: Plan, r: Results) -> list[str]:
    """The main findings, one sentence or two each."""
    return [
        _push(plan, r),
        _heavier(r),
        _fixed_point(plan, r),
        _recipe(plan, r),
        _stability(r),
        *(_map(r.cells) if r.cells else []),
        _torso(r),
    ]


def _push(plan: Plan, r: Results) -> str:
    npd, adrc = (r.heads[c].outcome for c in BOTH)
    slow = r.pair("rising push")
    pushes = "; ".join(push.in_words() for push in plan.pushes)
    return (
        f"Under the push ({pushes}) NPD makes {npd.impacts} and ADRC {adrc.impacts} of "
        f"{npd.run.impacts} impacts; {_carried(npd, adrc)}. The largest tracking error is "
        f"{npd.peak_error:.3g} rad under NPD and {adrc.peak_error:.3g} rad under ADRC; "
        f"where the push rises and falls in {1e3 * RISE:g} ms {slow[0].peak_error:.3g} and "
        f"{slow[1].peak_error:.3g} rad."
    )


def _carried(npd: Outcome, adrc: Outcome) -> str:
    """Whether ground and motors could have carried both."""
    words = [o.legality.outcome for o in (npd, adrc)]
    if words[0] == words[1]:
        return f"of either walk: {OUTCOMES[words[0]]}"
    return f"of NPD's walk: {OUTCOMES[words[0]]}; of ADRC's: {OUTCOMES[words[1]]}"


def _heavier(r: Results) -> str:
    pairs = (r.pair(f"heavier, {kind}") for kind in ("masses", "masses and inertias"))
    masses, both = (adrc.peak_error / npd.peak_error for npd, adrc in pairs)
    return (
        f"With a plant heavier than the model ADRC's largest error is {masses:.2f} (masses) and "
        f"{both:.2f} (masses and inertias) of NPD's; the unmatched part of the change enters the "
        "reference itself."
    )


def _fixed_point(plan: Plan, r: Results) -> str:
    walks = [o for _, o in r.nominal(plan)]
    gap = float(np.max([distance(o) for o in walks]))
    return (
        f"After {walks[0].run.impacts} undisturbed impacts the gait designed through the published x* "
        f"is at most {gap:.1e} from it, under both controllers, in: {', '.join(plan.presets)}."
    )


def _recipe(plan: Plan, r: Results) -> str:
    found = list(r.recipes(plan))
    stable = [f for f in found if f.closes and f.record.get("stable")]
    text = (
        f"The recipe of section IV walks in a stable cycle in {len(stable)} of {len(found)} cases"
    )
    if not stable:
        return f"{text}."
    gap = max(float(np.max(np.abs(f.record["distance_to_x_star"]))) for f in stable)
    torques = [f.record["peak_torque"] for f in stable]
    return (
        f"{text}, no component of its state more than {gap:.2g} (rad, rad/s) from x*; its torque peaks "
        f"between {np.min(torques):.0f} and {np.max(torques):.0f} N m, where RABBIT's motors give 150."
    )


def _stability(r: Results) -> str:
    npd = r.multipliers["NPD"]
    text = (
        f"The largest multiplier is {abs(npd.orbit.multipliers[0]):.6f}; the closed form of the zero "
        f"dynamics says {npd.delta_squared:.6f}."
    )
    if "ADRC" in r.multipliers:
        z = np.abs(r.multipliers["ADRC"].orbit.multipliers)
        text += f" Under ADRC the largest of {len(z)}, observer states included, is {z[0]:.4f}."
    return f"{text} The printed ones come from a regression that such data do not determine."


def _map(cells: list[Cell]) -> list[str]:
    parts = []
    for name, found in counts(certain(cells)).items():
        total = sum(found["NPD"].values())
        npd, adrc = found["NPD"], found["ADRC"]
        parts.append(
            f"of {total} pushes that are not marginal NPD falls in {npd['fell']} and walks on legally in "
            f"{npd['legal']}, "
            f"ADRC falls in {adrc['fell']} and walks on legally in {adrc['legal']} ({name})"
        )
    return ["The map of pushes: " + "; ".join(parts) + "."]


def _torso(r: Results) -> str:
    npd, adrc = r.pair("torso")
    short = [f"{o.run.controller} makes no step" for o in (npd, adrc) if len(o.durations) == 0]
    if short:
        return f"Under a push on the unactuated torso {' and '.join(short)}."
    usual = float(npd.durations[0])
    slow = [float(o.durations[np.argmax(np.abs(o.durations - usual))]) for o in (npd, adrc)]
    return (
        f"A push on the unactuated torso changes the speed: the step that changes most lasts "
        f"{slow[0]:.4f} s under NPD and {slow[1]:.4f} s under ADRC instead of {usual:.4f} s."
    )
