"""Claims about the controller and its observer: section III, uncertainty of the model, unmatched disturbances.

One function per claim: it makes cases of the evidence, and the values of the claim's text. Called by
`claims.table`; cases are judged in `claims.tally`, texts are in claims.toml.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from biped_adrc.control.tracking import TABLE_II
from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.paper.claims.admissible import convergence, declared, in_all
from biped_adrc.paper.claims.evidence import Jumps, Pair
from biped_adrc.paper.claims.orders import Order
from biped_adrc.paper.claims.tally import (
    CONTRADICTED,
    NOT_TESTABLE,
    AtTwoSteps,
    ClaimCase,
    Tally,
    against,
    below_limit,
    changes,
    fewer,
)
from biped_adrc.paper.claims.walks import MemberOutcome, quotient
from biped_adrc.paper.claims.words import Claim, Extremes, limited, row, told
from biped_adrc.paper.physical_laws import HELD


def control_claims(
    unmatched: Sequence[Pair],
    uncertainty: Sequence[Pair],
    recipe: Sequence[MemberOutcome],
    jumps: Sequence[Jumps],
    orders: Sequence[Order],
    numerics: Mapping[str, float],
) -> list[Claim]:
    """All rows of this module; numerics: figures of the held joint by name."""
    fatal = f"{declared()['unmatched']['fatal']:g} N m"
    return [
        unmatched_rejection([p for p in unmatched if fatal not in p.name]),
        not_at_risk([p for p in unmatched if fatal in p.name]),
        *model_uncertainty(uncertainty),
        independent_of_the_gait(recipe),
        high_gains(orders),
        smooth_disturbance(jumps),
        hurwitz(),
        told("decoupled"),
        tends_to_zero(numerics),
    ]


def _ratios(pairs: Sequence[Pair], what: str) -> list[AtTwoSteps]:
    """Of each pair, ADRC's value of `what` over NPD's."""
    return [quotient(getattr(p, what)["ADRC"], getattr(p, what)["NPD"]) for p in pairs]


def _tally(pairs: Sequence[Pair], over: Sequence[AtTwoSteps], limit: float, declared: int) -> Tally:
    """Cases that hold where both controllers make all impacts and the ratio is at most `limit`."""
    cases = (
        below_limit(p.name, f, limit)
        if all(p.made.values())
        else ClaimCase(p.name, f, False, not p.same)
        for p, f in zip(pairs, over, strict=True)
    )
    return Tally(tuple(cases), in_all(declared))


def unmatched_rejection(pairs: Sequence[Pair]) -> Claim:
    """A torque on the torso: by how much the time of a step changes under ADRC, over NPD.

    A ratio near 1 means that the observer does not help against it.
    """
    limit, over = declared()["limits"]["ratio"], _ratios(pairs, "delay")
    return row(
        "unmatched_rejection",
        _tally(pairs, over, limit, len(declared()["unmatched"]["amplitudes"])),
        slow=Extremes(1e3 * p.delay["ADRC"].at_half for p in pairs),
        ratios=Extremes.of(over),
        peaks=Extremes.of(_ratios(pairs, "peak")),
    )


def not_at_risk(pairs: Sequence[Pair]) -> Claim:
    """ "The stability of the limit cycle is not at risk": every disturbance that stops ADRC speaks
    against it.
    """
    firm = [p for p in pairs if p.same]
    stopped = [p.name for p in firm if not p.made["ADRC"]]
    values = {
        "stopped": len(stopped),
        "count": len(pairs),
        "both": sum(not any(p.made.values()) for p in firm),
        "names": "; ".join(stopped) or "none",
    }
    share = f"{len(stopped)} of {len(pairs)} walks stop{fewer(len(pairs), in_all(1))}"
    word, doubtful = against(len(stopped), len(pairs)), len(pairs) - len(firm)
    return told("not_at_risk", word, values, share=share, marginal=doubtful)


def model_uncertainty(pairs: Sequence[Pair]) -> list[Claim]:
    """A heavier plant: the peak error of ADRC over that of NPD.

    Two rows on the same cases: at most the declared ratio (the claim), and below 1 at all.
    """
    over = _ratios(pairs, "peak")
    count = len(declared()["uncertainty"]) - 1  # all but its number of impacts
    limits = {"model_uncertainty": declared()["limits"]["ratio"], "less_error": 1.0}
    return [
        row(name, _tally(pairs, over, limit, count), ratios=Extremes.of(over))
        for name, limit in limits.items()
    ]


def independent_of_the_gait(outcomes: Sequence[MemberOutcome]) -> Claim:
    """The push on gait (b), whose impacts leave a tracking error of their own, judged as
    `rows_push.rejection`.
    """
    limit = declared()["limits"]["ratio"]
    return limited(
        "independent_of_the_gait",
        ((o.member.name, o.rejection) for o in outcomes),
        limit,
        in_all(1),
        deviations=Extremes.of(o.rejection for o in outcomes),
        peaks=Extremes.of(o.tracking for o in outcomes),
    )


def high_gains(orders: Sequence[Order]) -> Claim:
    """Section III.A: more extended states avoid high gains.

    Table I against m = 1, at equal bandwidth and at equal delay margin: largest gain of (17), and gain from the
    measurement to the acceleration. A case holds where Table I has the smaller one.
    """
    by_name = {o.name: o for o in orders}
    table, equal = by_name["Table I"], by_name["m = 1, equal delay margin"]
    cases, shown = [], []
    for name in ("equal bandwidth", "equal delay margin"):
        one = by_name[f"m = 1, {name}"]
        for what, a, b in (
            ("largest gain of (17)", table.largest_gain, one.largest_gain),
            ("gain from measurement to acceleration", table.noise_gain, one.noise_gain),
        ):
            cases.append(ClaimCase(f"{what}, {name}", AtTwoSteps(a, a), a < b))
            shown.append(f"{what} {a:.1e} against {b:.1e} ({name})")
    tally = Tally(tuple(cases))
    values = {
        "gains": "; ".join(shown),
        "margin": 1e6 * table.delay_margin,
        "bandwidth_margin": 1e3 * by_name["m = 1, equal bandwidth"].delay_margin,
        "bandwidth": equal.bandwidth,
        "errors": ", ".join(f"{o.name} {o.pushed.at_half:.1e}" for o in orders),
        "slow": table.slow,
        "other": equal.slow,
    }
    said = f"closed forms; errors under the push, {changes([o.pushed for o in orders])}"
    return told("high_gains", tally.word, values, share=tally.share, convergence=said)


def smooth_disturbance(jumps: Sequence[Jumps]) -> Claim:
    """Section I: the total disturbance is smooth. Every preset in which it jumps at impact speaks
    against it.
    """
    rough = sum(j.at_impact > declared()["limits"]["jump"] for j in jumps)
    values = {
        "impacts": Extremes(j.at_impact for j in jumps),
        "edges": Extremes(j.at_edge for j in jumps),
    }
    share = f"{rough} of {len(jumps)} presets jump{fewer(len(jumps), in_all(1))}"
    return told("smooth_disturbance", against(rough, len(jumps)), values, share=share)


def hurwitz() -> Claim:
    """Section III.A: the characteristic polynomial (19) is Hurwitz."""
    slow, fast = max(TABLE_I), min(TABLE_I)
    poles = f"poles from {-slow:.0f} to {-fast:.0f} rad/s" if slow < 0 else "unstable poles"
    return told("hurwitz", values={"poles": poles})


def tends_to_zero(numerics: Mapping[str, float]) -> Claim:
    """(23): the tracking error tends to zero.

    Under a disturbance that goes on, a sine on one held joint, it keeps an amplitude. The claim is contradicted
    where the simulated one is that of (23) corrected, within 1 %, and does not depend on the step.
    """
    simulated, half, corrected, printed = (numerics.get(name, math.nan) for name in HELD)
    amplitude, share = AtTwoSteps(simulated, half), convergence()[0]
    seen = simulated > 0.0 and abs(simulated - corrected) <= 0.01 * corrected
    firm = amplitude.converged(share, 0.0)
    return told(
        "tends_to_zero",
        CONTRADICTED if seen and firm else NOT_TESTABLE,
        {"simulated": simulated, "corrected": corrected, "printed": printed, "gains": TABLE_II},
        convergence=f"{changes([amplitude])}, with Table I times 0.05, to stand clear of round-off",
        marginal=int(not firm),
    )
