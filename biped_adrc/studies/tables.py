"""The tables of a reproduction, and what it comes to in sentences, every number taken from its runs."""

from __future__ import annotations

from typing import Any

import numpy as np

from biped_adrc.analysis.legality import OUTCOMES
from biped_adrc.control.tracking import TABLE_II
from biped_adrc.gait.published import PUBLISHED_MULTIPLIERS
from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.scenario.outcome import Outcome
from biped_adrc.studies.pair import CONTROLLERS
from biped_adrc.studies.plan import BOTH, POLICIES, RISE, Plan
from biped_adrc.studies.push_map import WORDS, Cell, certain, counts
from biped_adrc.studies.results import Results
from biped_adrc.studies.verdicts import distance

PRINTED_TABLE_I = (-180, -324, -583, -1050, -1890, -3401, -6122, -11020, -19836)
"""As the paper prints them, with its thousands separators ("-11.020", "-19.836") read as such."""


def tables(plan: Plan, r: Results) -> dict[str, Any]:
    """What is reported beside the checks."""
    found = {
        "Table I: observer eigenvalues [rad/s]": {
            "columns": ["paper, rounded", "here, 180 x 1.8^k"],
            "rows": [
                [printed, pole] for printed, pole in zip(PRINTED_TABLE_I, TABLE_I, strict=True)
            ],
        },
        "Table II: controller constants": {
            "columns": ["constant", "paper", "here"],
            "rows": [["K_p [1/s^2]", 5000, TABLE_II.K_p], ["K_d [1/s]", 50, TABLE_II.K_d]],
        },
        "Runs": _runs(r),
        "Stability: multipliers": _multipliers(r),
        "Gait (b), the paper's recipe": _recipe(plan, r),
        "Numerics": {
            "columns": ["figure", "value"],
            "rows": [[k, v] for k, v in r.figures.items()],
        },
    }
    if not plan.quick:
        found["Literal equation and resets at impact"] = _literal(r)
        found["Map of pushes"] = _map(r.cells)
    return found


def _row(o: Outcome) -> list[Any]:
    steps = o.certificates
    return [
        o.run.controller,
        o.run.preset,
        o.status,
        o.legality.outcome,
        o.impacts,
        o.peak_error,
        None if o.half is None else o.half.peak_error,
        o.rms_error,
        o.peak_torque,
        float(np.median([s.duration for s in steps])) if steps else None,
        o.legality.mean_friction,
        o.legality.mean_normal_force,
        float(np.max([s.impulse_ratio for s in steps])) if steps else None,
        o.method,
        o.engine,
    ]


def _runs(r: Results) -> dict[str, Any]:
    columns = ["run", "controller", "preset", "status", "outcome", "impacts", "peak error [rad]"]
    columns += ["at half the step [rad]", "rms error [rad]", "peak torque [N m]", "median step [s]"]
    columns += ["mean friction", "mean F_N [N]", "impulse ratio", "method", "engine"]
    named = {k: o for k, o in r.runs.items() if not k.startswith("reset")}
    heads = {f"push {c}": r.heads[c].outcome for c in BOTH}
    rows = [[name, *_row(o)] for name, o in {**heads, **named}.items()]
    return {"columns": columns, "rows": rows}


def _multipliers(r: Results) -> dict[str, Any]:
    rows: list[list[Any]] = []
    for name in ("NPD", "ADRC", "ADRC measured"):
        if name in r.multipliers:
            multipliers = r.multipliers[name].orbit.multipliers
            measured = name.endswith("measured")
            of = name.replace(" measured", ", reset 'measured'")
            remark = "the observer's xi^ and its derivatives live on through the impact"
            shown = np.abs(multipliers)[:10].tolist()
            said = f"central differences, {of}, {len(multipliers)} coordinates"
            rows.append([said, shown, remark if measured else ""])
    rows.append(["delta^2 of the zero dynamics", [r.multipliers["NPD"].delta_squared], ""])
    for c, found in r.regressions.items():
        test = found.regression
        rows.append(
            [f"regression (27) on the pushed walk, {c}", test.magnitudes.tolist(), test.warning]
        )
    rows.append(
        ["printed in the paper", list(PUBLISHED_MULTIPLIERS), "from a regression: no target"]
    )
    return {"columns": ["method", "magnitudes", "remark"], "rows": rows}


def _recipe(plan: Plan, r: Results) -> dict[str, Any]:
    columns = ["preset", "controller", "closes", "stable", "largest multipliers", "impacts"]
    columns += ["peak error [rad]", "peak torque [N m]", "friction needed", "impulse ratio"]
    columns += ["violations", "rate jump at impact [rad/s]", "x- minus x*", "remark"]
    rows = [
        [
            x.preset,
            x.controller,
            x.closes,
            x.record.get("stable"),
            x.record.get("multipliers", [])[:3],
            x.record.get("impacts"),
            x.record.get("peak_error"),
            x.record.get("peak_torque"),
            x.record.get("certificate", {}).get("friction"),
            x.record.get("certificate", {}).get("impulse_ratio"),
            "; ".join(x.record.get("violations", [])),
            x.record.get("impact_rate_jump"),
            x.record.get("distance_to_x_star"),
            x.reason,
        ]
        for x in r.recipes(plan)
    ]
    return {"columns": columns, "rows": rows}


def _literal(r: Results) -> dict[str, Any]:
    columns = ["variant", "status", "impacts", "peak error [rad]", "at half the step [rad]"]
    columns += ["peak torque [N m]", "median step [s]", "distance to x*"]
    names = [f"as printed {c}" for c in BOTH]
    names += [f"reset {p}, {limit}" for p in POLICIES for limit in ("unlimited", "150 N m")]
    rows = []
    for name in names:
        o = r.runs[name]
        period = float(np.median(o.durations)) if len(o.durations) else None
        half = None if o.half is None else o.half.peak_error
        figures = [o.peak_error, half] if o.walked else [None, None]
        torque = o.peak_torque if o.walked else None
        rows.append([name, o.status, o.impacts, *figures, torque, period, distance(o)])
    return {"columns": columns, "rows": rows}


def _map(cells: list[Any]) -> dict[str, Any]:
    found = counts(cells)
    rows = [
        [name, c, *(found[name][c][word] for word in WORDS)] for name in found for c in CONTROLLERS
    ]
    return {"columns": ["preset, torque limit", "controller", *WORDS], "rows": rows}


def findings(plan: Plan, r: Results) -> list[str]:
    """The main findings, one sentence or two each."""
    return [
        _push(plan, r),
        _heavier(r),
        _fixed_point(plan, r),
        _recipe_said(plan, r),
        _stability(r),
        *(_map_said(r.cells) if r.cells else []),
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


def _recipe_said(plan: Plan, r: Results) -> str:
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


def _map_said(cells: list[Cell]) -> list[str]:
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
