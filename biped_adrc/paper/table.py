"""The one table: every claim of the paper, and every law and consistency that its reproduction is held against.

`claims` are the statements of the paper from the abstract to its last section, each judged over all its
scenarios; of `checks` every scenario is a check of its own, whose kinds (`checks.KINDS`) say what a broken one
means:

    law           the program is wrong: physics or numerics
    consistency   a gait does not do what it was designed for
    reproduced    the paper's statement does not hold for this robot

What claims mean to a reader is in claims.toml. Their limits, and the choices under which they are tried, are in
admissible.toml, which was written before the runs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np

from biped_adrc.analysis.feasibility import COUNTED
from biped_adrc.checks import Check, at_least, at_most, below, between
from biped_adrc.paper import metrics as m
from biped_adrc.paper import values as v
from biped_adrc.paper.convergence import AGREE, MULTIPLIER_ROUND_OFF, largest_gap, observed_order
from biped_adrc.paper.members import MemberOutcome, limits_broken
from biped_adrc.paper.physical_laws import MODEL_LAWS, work_identity
from biped_adrc.paper.results import Results
from biped_adrc.paper.scenarios import CONTROLLERS, KINDS, declared
from biped_adrc.paper.verdict import Claim, Limit, Row, claim_checks, row_of, texts
from biped_adrc.scenario.outcome import Outcome


def le(limit: float) -> Limit:
    """At most `limit`."""
    return partial(at_most, limit=limit)


def ge(limit: float) -> Limit:
    """At least `limit`."""
    return partial(at_least, limit=limit)


def lt(limit: float) -> Limit:
    """Less than `limit`."""
    return partial(below, limit=limit)


def claim(name: str, scenarios: Any, metric: Any, limit: Limit, **more: Any) -> Claim:
    """A claim with its place and statement from claims.toml."""
    said = texts()[name]
    return Claim(name, said["where"], said["claim"], scenarios, metric, limit, **more)


def theta_of(name: str, o: MemberOutcome) -> str:
    """The choice of Theta'' of a member, the one cause of what is left under ADRC."""
    return {"solved": "Theta'' solved", "printed": "(20) as printed"}[o.member.theta]


def claims() -> Iterator[Claim]:
    """The claims of the paper, in the order of the report."""
    yield from _of_the_push()
    yield from _of_the_controller()
    yield from _of_the_gait()
    for name in ("lumped", "smooth_references", "same_gains", "curves", "earlier_approaches"):
        yield _undecided(name)


def _undecided(name: str, **more: Any) -> Claim:
    """A claim that no run can decide; its word is in claims.toml."""
    return claim(name, lambda r: {}, math.nan, le(0.0), **more)


def _of_the_push() -> Iterator[Claim]:
    """Figures 4, 5 and 6: the push on the joints."""
    limit = declared()["limits"]
    of = {"scenarios": m.members, "values": v.of_members}
    yield claim(
        "long_walk",
        lambda r: {c: r.headline[c].outcome for c in CONTROLLERS},
        partial(m.at_two, m.share_made),
        ge(1.0),
        values=v.of_headline,
    )
    yield claim("rejection", metric=m.deviation, limit=le(limit["ratio"]), **of)
    yield claim("tracking", metric=m.error_ratio, limit=le(limit["ratio"]), variant=theta_of, **of)
    deviation = ge(limit["deviation"])
    yield claim("deviates", metric=lambda o: o.walked["NPD"].deviation, limit=deviation, **of)
    yield claim("walks_on", metric=m.longest, limit=lt(math.inf), **of)
    yield claim(
        "unaffected",
        metric=lambda o: o.walked["ADRC"].rate,
        limit=le(limit["cycle"]),
        round_off=declared()["steps"]["round_off_rate"],
        **of,
    )
    yield claim("feasible", metric=lambda o: o.walked["ADRC"].broken, limit=le(0.0), **of)
    yield claim(
        "critical_phase",
        m.lost_by_npd,
        lambda cell: float(cell.adrc.outcome in COUNTED),
        ge(1.0),
        variant=lambda _, cell: cell.setting,
        values=v.of_map,
    )


def _of_the_controller() -> Iterator[Claim]:
    """Section III: the controller and its observer, model uncertainty, what is not matched."""
    limit = declared()["limits"]
    ratio = le(limit["ratio"])
    of_torso, of_heavier = {"values": v.of_torso}, {"values": v.of_heavier}
    late, error = partial(m.adrc_over_npd, m.delay), partial(m.adrc_over_npd, m.peak)
    yield claim("unmatched_rejection", m.usual_torso, late, ratio, **of_torso)
    yield claim(
        "not_at_risk",
        m.torso,
        lambda pair: m.at_two(m.share_made, pair[1]),
        ge(1.0),
        variant=lambda name, _: name.partition(" on")[0],
        **of_torso,
    )
    yield claim("model_uncertainty", m.heavier, error, ratio, **of_heavier)
    yield claim("less_error", m.heavier, error, le(1.0), **of_heavier)
    yield claim("independent_of_the_gait", m.on_recipe, m.deviation, ratio, values=v.of_recipe_push)
    yield claim("high_gains", m.gains, lambda pair: pair[0] / pair[1], lt(1.0), values=v.of_orders)
    yield claim(
        "smooth_disturbance",
        lambda r: r.jumps,
        lambda x: x["xi at impact"],
        le(limit["jump"]),
        values=v.of_jumps,
    )
    yield _undecided("hurwitz", values=v.of_poles)
    yield _undecided("decoupled")
    yield claim("tends_to_zero", m.held_joint, lambda x: x, ratio, values=v.of_held)


def _of_the_gait() -> Iterator[Claim]:
    """Sections I, II, IV, V and VII: the gait and its stability."""
    limit = declared()["limits"]
    of_cycles = {
        "metric": m.largest_multiplier,
        "limit": lt(1.0),
        "values": v.of_cycles,
        "round_off": limit["multiplier"],
    }
    on_b = partial(m.undisturbed, "b")
    least = m.longest_step(m.LEAST_PRINTED)
    yield _undecided("fixed_point", values=v.of_poles)
    yield claim("stable", partial(m.cycles, "a"), **of_cycles)
    yield claim("recipe_stable", partial(m.cycles, "b"), **of_cycles)
    yield claim("recipe_speed", m.npd_cycles, m.speed_error, le(limit["speed"]), values=v.of_speed)
    yield claim("recipe_needs", on_b, partial(m.at_two, broken), le(0.0), values=v.of_needs)
    impulse = partial(m.at_two, partial(m.last, "impulse_ratio"))
    both, friction = partial(m.undisturbed, "ab"), le(limit["friction"])
    yield claim("pinned_at_impact", both, impulse, friction, values=v.of_needs)
    yield claim(
        "not_smooth",
        lambda r: r.jumps,
        lambda x: x["recipe"],
        ge(limit["smooth"]),
        values=v.of_jumps,
    )
    yield claim("not_optimal", m.both_gaits, m.cost_ratio, ge(1.0), values=v.of_needs)
    yield claim("global_stability", m.below_least, m.reached, ge(1.0), values=v.of_starts)
    yield claim(
        "printed_multipliers",
        lambda r: r.jumps,
        lambda x: x["period"] / least,
        le(1.0),
        values=v.of_printed,
    )


def broken(o: Outcome) -> float:
    """How many limits of ground and motors a walk breaks, as `runs.limits_broken`."""
    return limits_broken(o.feasibility)


def rows(r: Results) -> list[Row]:
    """Every claim of the paper with what became of it."""
    return [row_of(of, r) for of in claims()]


# -- laws, consistencies and results that every run is held against --------------------------------
def checks(r: Results, of_claims: list[Row]) -> list[Check]:
    """All checks of a reproduction, those of its claims included."""
    every = (*_of_designed(), *_of_results(), *_of_steps(), *_of_laws(r))
    return [check for of in every for check in of.checks(r)] + claim_checks(of_claims)


def _check(kind: str, statement: str, scenarios: Any, metric: Any, limit: Limit) -> Claim:
    """A statement of which every scenario is a check."""
    return Claim("", kind, statement, scenarios, metric, limit, kind)


def _of_designed() -> Iterator[Claim]:
    """Gait (a) comes back to x*, within dry friction and RABBIT's motors, in every preset."""
    check, on_a = partial(_check, "consistency"), partial(Results.on_gait, gait="a")
    yield check("distance to x* at the last impact", on_a, m.distance, le(5e-4))
    yield check("friction needed", on_a, partial(m.worst, "friction", 1.0), le(0.6))
    yield check("peak torque [N m]", on_a, partial(m.worst, "peak_torque", 1.0), le(150.0))
    normal = partial(m.worst, "least_normal_force", -1.0)
    yield check("least normal force [N]", on_a, normal, ge(0.0))


def _of_results() -> Iterator[Claim]:
    """What figures 4 and 5 show, also of a sine, a heavier plant, sampled control and a push on the torso.

    That push enters the unactuated row, which neither controller can cancel: both change their steps alike.
    """
    check = partial(_check, "reproduced")
    heavy = tuple(f"heavier, {kind}" for kind in KINDS)
    walks = ("push", "sine", "1 kHz", *heavy, "torso")

    def pairs(names: tuple[str, ...], r: Results) -> dict[str, Any]:
        return {name: (*r.pair(name), 0.0) for name in names}

    def single(r: Results) -> dict[str, Any]:
        return {f"{c}, {n}": o for n in walks for c, o in zip(CONTROLLERS, r.pair(n), strict=True)}

    def error(pair: m.Pair) -> float:
        return pair[1].peak_error / pair[0].peak_error

    yield check("share of the impacts made", single, m.share_made, ge(1.0))
    ratio = "peak error of ADRC over NPD's"
    yield check(ratio, partial(pairs, ("push", "sine")), error, le(0.01))
    yield check(ratio, partial(pairs, heavy), error, lt(1.0))
    apart = "step periods of ADRC and NPD differ, share of a period"
    yield check(apart, partial(pairs, ("torso",)), m.period_gap, le(0.01))
    second = lambda r: {"NPD": np.sort(np.abs(r.multipliers["NPD"].orbit.multipliers))[-2]}  # noqa: E731
    yield check("the other eight multipliers", second, float, lt(1e-3))
    yield check(
        "largest multiplier, observer states included",
        lambda r: {name: x for name, x in r.multipliers.items() if name != "NPD"},
        lambda x: abs(x.orbit.multipliers[0]),
        lt(1.0),
    )
    largest = "largest multiplier of its cycle"
    yield check(largest, partial(m.cycles, "b"), lambda x: m.largest_multiplier(x).value, lt(1.0))


def _of_steps() -> Iterator[Claim]:
    """No figure of merit and no multiplier depends on the integration step, nor on the engine."""
    check = partial(_check, "law")
    yield check(
        "largest change of error, torque, period, energy or force when every step is halved",
        lambda r: r.run_twice,
        largest_gap,
        le(AGREE),
    )
    yield check(
        "order in the step of its largest error under the push, from three steps",
        lambda r: {"ADRC": r.headline["ADRC"].outcome},
        lambda o: observed_order(o, lambda x: x.peak_error),
        ge(1.0),
    )
    yield check(
        "largest change of a multiplier when the step is halved, against the round-off of finite differences, "
        "below which a multiplier is not told from zero",
        lambda r: (
            {f"multipliers {name}": x for name, x in r.multipliers.items()} | m.cycles("b", r)
        ),
        lambda x: math.inf if isinstance(x, str) else x.gap,
        le(MULTIPLIER_ROUND_OFF),
    )
    yield check(
        "compiled against Pinocchio over the pushed step, (q, q') at the impact [rad, rad/s]",
        lambda r: r.engines,
        float,
        le(1e-6),
    )


def _of_laws(r: Results) -> Iterator[Claim]:
    """Physics and orders of convergence, of which none was used to derive the model or to choose a method."""
    check = partial(_check, "law")
    yield check(
        "largest multiplier against delta^2 of the zero dynamics",
        lambda r: {"NPD": r.multipliers["NPD"]},
        lambda x: abs(abs(x.orbit.multipliers[0]) - x.delta_squared),
        le(1e-5),
    )
    laws = {c: head.laws for c, head in r.headline.items()}
    height = "height of the swing foot at located impacts [m]"
    yield check(height, lambda _: laws, lambda x: x["height"], le(1e-10))
    balance = "energy gained against work done over the pushed step [J]"
    yield check(balance, lambda _: laws, lambda x: x["energy"], le(1e-4))
    for name in MODEL_LAWS:
        yield check(name, lambda r: r.model, lambda x, name=name: x[name], le(1e-12))
    work = "joint work against energy lost at impact, relative"
    yield check(work, partial(Results.on_gait, gait="a"), work_identity, le(1e-4))
    simulated, half, corrected, _, sampled, etd, *_ = r.figures.values()
    for statement, value, limit in (
        ("held joint: error, change when the step is halved", half / simulated - 1.0, le(0.01)),
        ("held joint: error against (23) corrected", simulated / corrected - 1.0, le(1e-3)),
        (
            "order of continuous against sampled control in the period",
            sampled,
            partial(between, low=0.9, high=1.1),
        ),
        (
            "order of the exponential method, Table I times 0.05",
            etd,
            partial(between, low=3.7, high=4.3),
        ),
    ):
        yield check(statement, lambda _, value=value: {"": abs(value)}, float, limit)
