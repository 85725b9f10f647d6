"""The one table: every claim of the paper, and every law and consistency that its reproduction is held against.

`claims` are the statements of the paper from the abstract to its last section, each judged over all its
scenarios; of `checks` every scenario is a check of its own, whose kinds (`verdict.KINDS`) say what a broken one
means:

    law           the program is wrong: physics or numerics
    consistency   a gait does not do what it was designed for
    reproduced    the paper's statement does not hold for this robot

A claim is a table of claims.toml: its words, and by name the scenarios, the metric and the values for its texts
(functions of `paper.metrics` and `paper.values`). Limits, and the choices under which claims are tried, are in
admissible.toml, which was written before the runs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from types import ModuleType
from typing import Any

import numpy as np

from biped_adrc.core.verdict import Check, at_least, at_most, below, between
from biped_adrc.paper import metrics as m
from biped_adrc.paper import values as v
from biped_adrc.paper.physical_laws import work_identity
from biped_adrc.paper.runs import Results
from biped_adrc.paper.scenarios import CONTROLLERS, KINDS, declared
from biped_adrc.paper.verdict import (
    AGREE,
    Claim,
    Limit,
    Row,
    claim_checks,
    largest_gap,
    observed_order,
    row_of,
    texts,
)


def limit(text: str) -> Limit:
    """The limit "<= 0.01", "in 0.9 1.1", or "<= ratio" by its name in admissible.toml."""
    sign, *words = text.split()
    bounds = [_number(word) for word in words]
    if sign == "in":
        return partial(between, low=bounds[0], high=bounds[1])
    return partial({"<=": at_most, ">=": at_least, "<": below}[sign], limit=bounds[0])


def _number(text: str) -> float:
    """A number, or a limit by its name in admissible.toml."""
    return float(declared()["limits"].get(text, text))


def _function(room: ModuleType, text: str) -> Callable[..., Any]:
    """A function by its name, with the words behind it as its first arguments."""
    name, *words = text.split()
    return partial(getattr(room, name), *words)


def claims() -> Iterator[Claim]:
    """The claims of the paper, in the order of the report; those that no run can decide have no scenarios."""
    for name, said in texts().items():
        if name in ("preface", "words", "notes"):
            continue
        functions = {"scenarios": m, "measure": m, "variant": m, "values": v}
        result: dict[str, Any] = {
            "metric" if key == "measure" else key: _function(room, said[key])
            for key, room in functions.items()
            if key in said
        }
        if "round_off" in said:
            result["round_off"] = _number(said["round_off"])
        bound = limit(said.get("limit", "<= 0"))
        yield Claim(name, said["where"], said["claim"], limit=bound, **result)


def rows(r: Results) -> list[Row]:
    """Every claim of the paper with what became of it."""
    return [row_of(of, r) for of in claims()]


# -- laws, consistencies and results that every run is held against --------------------------------
def checks(r: Results, of_claims: list[Row]) -> list[Check]:
    """All checks of a reproduction, those of its claims included."""
    return [
        *_of_designed(r),
        *_of_results(r),
        *_of_steps(r),
        *_of_laws(r),
        *claim_checks(of_claims),
    ]


def _checks(kind: str, statement: str, bound: str, values: Mapping[str, float]) -> Iterator[Check]:
    """A statement of which every scenario, by its name, is a check."""
    for name, value in values.items():
        yield limit(bound)(f"{name}: {statement}" if name else statement, kind, value)


def _of_designed(r: Results) -> Iterator[Check]:
    """Gait (a) comes back to x*, within dry friction and RABBIT's motors, in every preset."""
    for statement, metric, bound in (
        ("distance to x* at the last impact", m.distance, "<= 5e-4"),
        ("friction needed", partial(m.worst, "friction", 1.0), "<= 0.6"),
        ("peak torque [N m]", partial(m.worst, "peak_torque", 1.0), "<= 150"),
        ("least normal force [N]", partial(m.worst, "least_normal_force", -1.0), ">= 0"),
    ):
        result = {name: metric(o) for name, o in r.on_gait("a").items()}
        yield from _checks("consistency", statement, bound, result)


def _of_results(r: Results) -> Iterator[Check]:
    """What figures 4 and 5 show, also of a sine, a heavier plant, sampled control and a push on the torso.

    That push enters the unactuated row, which neither controller can cancel: both change their steps alike.
    """
    check = partial(_checks, "reproduced")
    heavy = tuple(f"heavier, {kind}" for kind in KINDS)
    pairs = {name: r.pair(name) for name in ("push", "sine", "1 kHz", *heavy, "torso")}
    errors = {name: adrc.peak_error / npd.peak_error for name, (npd, adrc) in pairs.items()}
    shares = {
        f"{c}, {name}": m.share_made(o)
        for name, pair in pairs.items()
        for c, o in zip(CONTROLLERS, pair, strict=True)
    }
    yield from check("share of the impacts made", ">= 1", shares)
    ratio = "peak error of ADRC over NPD's"
    yield from check(ratio, "<= 0.01", {name: errors[name] for name in ("push", "sine")})
    yield from check(ratio, "< 1", {name: errors[name] for name in heavy})
    apart = "step periods of ADRC and NPD differ, share of a period"
    yield from check(apart, "<= 0.01", {"torso": m.period_gap(pairs["torso"])})
    sizes = {name: np.abs(x.orbit.multipliers) for name, x in r.multipliers.items()}
    npd = sizes.pop("NPD")
    yield from check("the other eight multipliers", "< 1e-3", {"NPD": float(np.sort(npd)[-2])})
    statement = "largest multiplier, observer states included"
    yield from check(statement, "< 1", {name: float(z[0]) for name, z in sizes.items()})
    largest = {name: m.largest_multiplier(x).value for name, x in m.cycles("b", r).items()}
    yield from check("largest multiplier of its cycle", "< 1", largest)


def _of_steps(r: Results) -> Iterator[Check]:
    """No figure of merit and no multiplier depends on the integration step, nor on the engine."""
    check, adrc = partial(_checks, "law"), r.headline["ADRC"].outcome
    yield from check(
        "largest change of error, torque, period, energy or force when every step is halved",
        f"<= {AGREE}",
        {name: largest_gap(o) for name, o in r.run_twice.items()},
    )
    yield from check(
        "order in the step of its largest error under the push, from three steps",
        ">= 1",
        {"ADRC": observed_order(adrc, lambda o: o.peak_error)},
    )
    cycles = {f"multipliers {name}": x for name, x in r.multipliers.items()} | m.cycles("b", r)
    yield from check(
        "largest change of a multiplier when the step is halved, against the round-off of finite differences, "
        "below which a multiplier is not told from zero",
        "<= multiplier",
        {name: math.inf if isinstance(x, str) else x.gap for name, x in cycles.items()},
    )
    yield from check(
        "compiled against Pinocchio over the pushed step, (q, q') at the impact [rad, rad/s]",
        "<= 1e-6",
        r.engines,
    )


def _of_laws(r: Results) -> Iterator[Check]:
    """Physics and orders of convergence, of which none was used to derive the model or to choose a method."""
    check, npd = partial(_checks, "law"), r.multipliers["NPD"]
    apart = abs(abs(npd.orbit.multipliers[0]) - npd.delta_squared)
    yield from check(
        "largest multiplier against delta^2 of the zero dynamics", "<= 1e-5", {"NPD": apart}
    )
    for statement, key, bound in (
        ("height of the swing foot at located impacts [m]", "height", "<= 1e-10"),
        ("energy gained against work done over the pushed step [J]", "energy", "<= 1e-4"),
    ):
        yield from check(statement, bound, {c: x.laws[key] for c, x in r.headline.items()})
    for law in next(iter(r.model.values())):
        yield from check(law, "<= 1e-12", {preset: x[law] for preset, x in r.model.items()})
    work = {name: work_identity(o) for name, o in r.on_gait("a").items()}
    yield from check("joint work against energy lost at impact, relative", "<= 1e-4", work)
    simulated, half, corrected, _, sampled, etd, *_ = r.figures.values()
    for statement, value, bound in (
        ("held joint: error, change when the step is halved", half / simulated - 1.0, "<= 0.01"),
        ("held joint: error against (23) corrected", simulated / corrected - 1.0, "<= 1e-3"),
        ("order of continuous against sampled control in the period", sampled, "in 0.9 1.1"),
        ("order of the exponential method, Table I times 0.05", etd, "in 3.7 4.3"),
    ):
        yield from check(statement, bound, {"": abs(value)})
