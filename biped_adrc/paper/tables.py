"""The tables of a reproduction, and its main findings in sentences, every number taken from the runs.

The wording of the findings is in findings.toml, with the values in braces; a function here computes the values
of each sentence. Called by `paper.reproduction`; the report (`viz.pages`) renders both.

Cells are numbers, texts, lists or None; how they are rounded is decided by the report.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from biped_adrc.analysis.feasibility import OUTCOMES
from biped_adrc.control.tracking import TABLE_II
from biped_adrc.gait.published import PUBLISHED_MULTIPLIERS
from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.paper.plan import POLICIES, RISE, Plan
from biped_adrc.paper.push_map import WORDS, PushCell, certain, counts
from biped_adrc.paper.results import Results
from biped_adrc.paper.verdicts import distance
from biped_adrc.resources import packaged
from biped_adrc.scenario.outcome import Outcome

PRINTED_TABLE_I = (-180, -324, -583, -1050, -1890, -3401, -6122, -11020, -19836)
"""Table I as the paper prints it [rad/s]; its "-11.020" and "-19.836" have thousands separators."""

Table = dict[str, Sequence[object]]
"""`columns`: names; `rows`: one list of as many cells for each row."""


def tables(plan: Plan, r: Results) -> dict[str, Table]:
    """All tables by title; a quick run has no literal equation and no map."""
    here = "here, 180 x 1.8^k"
    poles = zip(PRINTED_TABLE_I, TABLE_I, strict=True)
    constants = {"K_p [1/s^2]": (5000, TABLE_II.K_p), "K_d [1/s]": (50, TABLE_II.K_d)}
    found = {
        "Table I: observer eigenvalues [rad/s]": table(
            {"paper, rounded": printed, here: pole} for printed, pole in poles
        ),
        "Table II: controller constants": table(
            {"constant": k, "paper": printed, "here": x} for k, (printed, x) in constants.items()
        ),
        "Runs": _runs(r),
        "Stability: multipliers": _multipliers(r),
        "Gait (b), the paper's recipe": _recipe(plan, r),
        "Numerics": table({"figure": k, "value": v} for k, v in r.figures.items()),
    }
    if not plan.quick:
        found["Literal equation and resets at impact"] = _literal(r)
        found["Map of pushes"] = _map(r.cells)
    return found


def table(rows: Iterable[dict[str, object]]) -> Table:
    """A table of rows that are given by column name, at least one, all with the same columns."""
    rows = list(rows)
    return {"columns": list(rows[0]), "rows": [list(row.values()) for row in rows]}


def _runs(r: Results) -> Table:
    """Every walk but those of the reset policies: how it ended, errors, torques, forces."""
    named = {k: o for k, o in r.runs.items() if not k.startswith("reset")}
    heads = {f"push {c}": r.heads[c].outcome for c in CONTROLLERS}
    return table(_run(name, o) for name, o in {**heads, **named}.items())


def _run(name: str, o: Outcome) -> dict[str, object]:
    """The row of one walk."""
    steps = o.certificates
    return {
        "run": name,
        "controller": o.run.controller.name,
        "preset": o.run.robot.preset,
        "status": o.status,
        "outcome": o.feasibility.outcome,
        "impacts": o.impacts,
        "peak error [rad]": o.peak_error,
        "at half the step [rad]": None if o.half is None else o.half.peak_error,
        "rms error [rad]": o.rms_error,
        "peak torque [N m]": o.peak_torque,
        "median step [s]": float(np.median([s.duration for s in steps])) if steps else None,
        "mean friction": o.feasibility.mean_friction,
        "mean F_N [N]": o.feasibility.mean_normal_force,
        "impulse ratio": float(np.max([s.impulse_ratio for s in steps])) if steps else None,
        "method": o.method,
        "engine": o.engine,
    }


def _multipliers(r: Results) -> Table:
    """Multipliers by method: central differences, delta^2 of the zero dynamics, the regression
    (27), the paper.
    """
    found: dict[str, tuple[list[float], str]] = {}
    for name in ("NPD", "ADRC", "ADRC measured"):
        if name in r.multipliers:
            z = np.abs(r.multipliers[name].orbit.multipliers)
            of = name.replace(" measured", ", reset 'measured'")
            remembers = "the observer's xi^ and its derivatives live on through the impact"
            remark = remembers if name.endswith("measured") else ""
            said = f"central differences, {of}, {len(z)} coordinates"
            found[said] = z[:10].tolist(), remark
    found["delta^2 of the zero dynamics"] = [r.multipliers["NPD"].delta_squared], ""
    for c, test in r.regressions.items():
        said = f"regression (27) on the pushed walk, {c}"
        found[said] = test.magnitudes.tolist(), test.warning
    found["printed in the paper"] = list(PUBLISHED_MULTIPLIERS), "from a regression: no target"
    return table(
        {"method": said, "magnitudes": z, "remark": remark} for said, (z, remark) in found.items()
    )


def _recipe(plan: Plan, r: Results) -> Table:
    """Gait (b) by preset and controller: whether it closes, its multipliers, and what it asks of ground and
    motors.

    Numbers that a gait which fails does not have are empty.
    """
    return table(
        {
            "preset": x.preset,
            "controller": x.controller,
            "closes": x.closes,
            "stable": x.record.get("stable"),
            "largest multipliers": x.record.get("multipliers", [])[:3],
            "impacts": x.record.get("impacts"),
            "peak error [rad]": x.record.get("peak_error"),
            "peak torque [N m]": x.record.get("peak_torque"),
            "friction needed": x.record.get("certificate", {}).get("friction"),
            "impulse ratio": x.record.get("certificate", {}).get("impulse_ratio"),
            "violations": "; ".join(x.record.get("violations", [])),
            "rate jump at impact [rad/s]": x.record.get("impact_rate_jump"),
            "x- minus x*": x.record.get("distance_to_x_star"),
            "remark": x.reason,
        }
        for x in r.recipes(plan)
    )


def _literal(r: Results) -> Table:
    """Walks with (20) as printed, and the observer's reset policies with and without a torque limit.

    A walk that ended early has no peak error or torque in the table: they would be those of a fall.
    """
    names = [f"as printed {c}" for c in CONTROLLERS]
    names += [f"reset {p}, {limit}" for p in POLICIES for limit in ("unlimited", "150 N m")]
    return table(
        {
            "variant": name,
            "status": o.status,
            "impacts": o.impacts,
            "peak error [rad]": o.peak_error if o.walked else None,
            "at half the step [rad]": o.half.peak_error if o.walked and o.half else None,
            "peak torque [N m]": o.peak_torque if o.walked else None,
            "median step [s]": float(np.median(o.durations)) if len(o.durations) else None,
            "distance to x*": distance(o),
        }
        for name, o in ((name, r.runs[name]) for name in names)
    )


def _map(cells: list[PushCell]) -> Table:
    """How many pushes of the map ended how, by preset, torque limit and controller."""
    found = counts(cells)
    rows = [
        [name, c, *(found[name][c][word] for word in WORDS)] for name in found for c in CONTROLLERS
    ]
    return {"columns": ["preset, torque limit", "controller", *WORDS], "rows": rows}


# -- in sentences ----------------------------------------------------------------------------------
def findings(plan: Plan, r: Results) -> list[str]:
    """The main findings, one sentence or two each."""
    named = [_push(plan, r), _heavier(r), _fixed_point(plan, r), _stable_recipes(plan, r)]
    maps = [_pushes(r.cells)] if r.cells else []
    return [*named, _stability(r), *maps, _torso(r)]


def notes() -> list[str]:
    """What a reader has to know of the setup."""
    return [" ".join(text.split()) for text in _texts()["notes"].values()]


def _texts() -> dict[str, Any]:
    """The tables of findings.toml."""
    return packaged("biped_adrc.paper", "findings.toml")


def _said(of: str, /, **values: object) -> str:
    """A text of findings.toml on one line with these values in it."""
    return str(" ".join(_texts()[of].split()).format(**values))


def _push(plan: Plan, r: Results) -> str:
    """How both controllers walk under the headline push, with vertical and with slow edges.

    The feasibility of both walks is said once where it is the same.
    """
    npd, adrc = (r.heads[c].outcome for c in CONTROLLERS)
    words = {c: OUTCOMES[r.heads[c].outcome.feasibility.outcome] for c in CONTROLLERS}
    kind = "carried_alike" if words["NPD"] == words["ADRC"] else "carried_apart"
    return _said(
        "push",
        npd=npd,
        adrc=adrc,
        slow=r.pair("rising push"),
        rise=1e3 * RISE,
        pushes="; ".join(push.in_words() for push in plan.pushes),
        carried=_said(kind, npd=words["NPD"], adrc=words["ADRC"]),
    )


def _heavier(r: Results) -> str:
    """The ratio of the errors with a plant heavier than the model."""
    pairs = (r.pair(f"heavier, {kind}") for kind in ("masses", "masses and inertias"))
    masses, both = (adrc.peak_error / npd.peak_error for npd, adrc in pairs)
    return _said("heavier", masses=masses, both=both)


def _fixed_point(plan: Plan, r: Results) -> str:
    """How near gait (a) comes to x* in all presets."""
    walks = [o for _, o in r.nominal(plan)]
    gap = float(np.max([distance(o) for o in walks]))
    impacts, presets = walks[0].run.run.impacts, ", ".join(plan.presets)
    return _said("fixed_point", impacts=impacts, gap=gap, presets=presets)


def _stable_recipes(plan: Plan, r: Results) -> str:
    """In how many cases gait (b) walks in a stable cycle, how far from x*, with what torque."""
    found = list(r.recipes(plan))
    stable = [f for f in found if f.closes and f.record.get("stable")]
    text = _said("recipe", stable=len(stable), count=len(found))
    if not stable:
        return f"{text}."
    gap = max(float(np.max(np.abs(f.record["distance_to_x_star"]))) for f in stable)
    torques = [f.record["peak_torque"] for f in stable]
    least, most = np.min(torques), np.max(torques)
    return _said("recipe_stable", text=text, gap=gap, least=least, most=most)


def _stability(r: Results) -> str:
    """The largest multiplier beside delta^2, and that of ADRC with its observer."""
    npd, text = r.multipliers["NPD"], ""
    if "ADRC" in r.multipliers:
        z = np.abs(r.multipliers["ADRC"].orbit.multipliers)
        text = " " + _said("stability_of_ADRC", count=len(z), largest=z[0])
    largest = abs(npd.orbit.multipliers[0])
    return _said("stability", largest=largest, delta_squared=npd.delta_squared, adrc=text)


def _pushes(cells: list[PushCell]) -> str:
    """The map of pushes in numbers, marginal cells left out."""
    parts = (
        _said("map", total=sum(x["NPD"].values()), npd=x["NPD"], adrc=x["ADRC"], name=name)
        for name, x in counts(certain(cells)).items()
    )
    return f"The map of pushes: {'; '.join(parts)}."


def _torso(r: Results) -> str:
    """How the step time changes when the unactuated torso is pushed.

    Of each walk the step that differs most from the first one is named; where a walk makes no step, that is
    said.
    """
    walks = r.pair("torso")
    short = [f"{o.run.controller.name} makes no step" for o in walks if len(o.durations) == 0]
    if short:
        return _said("torso_stopped", who=" and ".join(short))
    usual = float(walks[0].durations[0])
    slow = [float(o.durations[np.argmax(np.abs(o.durations - usual))]) for o in walks]
    return _said("torso", slow=slow, usual=usual)
