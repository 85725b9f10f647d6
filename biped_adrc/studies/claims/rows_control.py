"""Claims about the controller and its observer: section III, model uncertainty, what is not matched."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from biped_adrc.control.tracking import TABLE_II
from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.studies.claims.admissible import convergence, declared, in_all
from biped_adrc.studies.claims.evidence import Jumps, Pair
from biped_adrc.studies.claims.orders import Order
from biped_adrc.studies.claims.walks import MemberOutcome, quotient
from biped_adrc.studies.claims.words import (
    BY_CONSTRUCTION,
    CONTRADICTED,
    DEPENDS,
    NOT_TESTABLE,
    Case,
    Claim,
    Figure,
    Tally,
    below_limit,
    changes,
    fewer,
    judged,
    span,
)


def control_claims(
    unmatched: Sequence[Pair],
    uncertainty: Sequence[Pair],
    recipe: Sequence[MemberOutcome],
    jumps: Sequence[Jumps],
    orders: Sequence[Order],
    numerics: Mapping[str, float],
) -> list[Claim]:
    """All rows of this module; numerics: the figures of the laws, of a held joint."""
    fatal = f"{declared()['unmatched']['fatal']:g} N m"
    return [
        unmatched_rejection([p for p in unmatched if fatal not in p.name]),
        not_at_risk([p for p in unmatched if fatal in p.name]),
        *model_uncertainty(uncertainty),
        independent_of_the_gait(recipe),
        high_gains(orders),
        smooth_disturbance(jumps),
        hurwitz(),
        decoupled(),
        tends_to_zero(numerics),
    ]


def _ratios(pairs: Sequence[Pair], what: str) -> list[Figure]:
    return [quotient(getattr(p, what)["ADRC"], getattr(p, what)["NPD"]) for p in pairs]


def _cases(pairs: Sequence[Pair], over: Sequence[Figure], limit: float) -> list[Case]:
    """A case holds where both controllers make all impacts and the ratio is at most `limit`."""
    return [
        below_limit(p.name, f, limit, convergence())
        if all(p.made.values())
        else Case(p.name, f, False, not p.same)
        for p, f in zip(pairs, over, strict=True)
    ]


def unmatched_rejection(pairs: Sequence[Pair]) -> Claim:
    """A torque on the torso: what it does to the time of a step."""
    limit = declared()["limits"]["ratio"]
    over = _ratios(pairs, "delay")
    cases = _cases(pairs, over, limit)
    count = in_all(len(declared()["unmatched"]["amplitudes"]))
    slow = span([1e3 * p.delay["ADRC"].at_half for p in pairs], ".0f")
    return judged(
        "The control strategy effectively rejects external disturbances that no motor can cancel",
        "abstract; I; VI",
        Tally(tuple(cases), count),
        f"20 N m on the torso for 0.2 s change a step by {slow} ms under ADRC, "
        f"{span([f.at_half for f in over])} of NPD's change; tracking error "
        f"{span([f.at_half for f in _ratios(pairs, 'peak')], '.2f')} of NPD's",
        f"holds where both make all steps and the change of a step's time is at most {limit:g} of "
        "NPD's. Such a torque enters the zero dynamics, which neither controller sees; the paper does "
        "not name what it pushes but 'the joints'",
    )


def not_at_risk(pairs: Sequence[Pair]) -> Claim:
    """A disturbance that stops ADRC in every preset."""
    firm = [p for p in pairs if p.same]
    stopped = [p.name for p in firm if not p.made["ADRC"]]
    both = [p.name for p in firm if not any(p.made.values())]
    word = NOT_TESTABLE
    if stopped:
        word = CONTRADICTED if len(stopped) == len(pairs) else DEPENDS
    return Claim(
        "Under ADRC 'the stability of the cycle limit is not under risk'",
        "VI",
        word,
        f"ADRC does not make all steps in {len(stopped)} of {len(pairs)} (NPD neither in {len(both)}): "
        f"{'; '.join(stopped) or 'none'}",
        "said of a push on the joints it follows from the rows above. Said of external disturbances it "
        "needs a counterexample, and this torque was chosen to be one: it stands for no usual "
        "disturbance. The torso's row of (12) has no motor, so a torque there that takes the speed "
        "away stops the walk whatever tracks the joints",
        share=f"{len(stopped)} of {len(pairs)} walks stop{fewer(len(pairs), in_all(1))}",
        marginal=len(pairs) - len(firm),
    )


def model_uncertainty(pairs: Sequence[Pair]) -> list[Claim]:
    """A heavier plant: what ADRC removes of NPD's error, and whether it helps at all."""
    limit = declared()["limits"]["ratio"]
    over = _ratios(pairs, "peak")
    count = in_all(len(declared()["uncertainty"]) - 1)  # all but its number of impacts
    ratios = span([f.at_half for f in over], ".2f")
    number = f"heavier plant: ADRC's largest error is {ratios} of NPD's"
    return [
        judged(
            "The control strategy overcomes the model uncertainties as it does external disturbances",
            "I; III",
            Tally(tuple(_cases(pairs, over, limit)), count),
            number,
            f"held to the same limit as a push, {limit:g}. ADRC reduces the error and does not remove "
            "it: the nominal Theta'' in the reference does not know the unmatched part of the change",
        ),
        judged(
            "Under model uncertainties ADRC tracks better than NPD",
            "III; VII",
            Tally(tuple(_cases(pairs, over, 1.0)), count),
            number,
            "holds where both make all steps and the ratio is at most one",
            asserted=True,
        ),
    ]


def independent_of_the_gait(outcomes: Sequence[MemberOutcome]) -> Claim:
    """The push on gait (b), whose impacts leave an error of their own."""
    limit = declared()["limits"]["ratio"]
    cases = [below_limit(o.member.name, o.rejection, limit, convergence()) for o in outcomes]
    count = in_all(1)
    deviations = span([o.rejection.at_half for o in outcomes], ".2g")
    peaks = span([o.tracking.at_half for o in outcomes], ".2f")
    return judged(
        "The gait of section IV 'permits to analyze the performance of the tracking controls "
        "independently'",
        "IV",
        Tally(tuple(cases), count),
        f"on gait (b) the deviation made by the push is {deviations} of NPD's under ADRC, the largest "
        f"error {peaks}",
        f"holds where the deviation is at most {limit:g} of NPD's, as on gait (a). Not of the largest "
        "error: that is left by the impact, which leaves the constraint of gait (b) under either "
        "controller",
        asserted=True,
    )


def high_gains(orders: Sequence[Order]) -> Claim:
    """Section III.A: more extended states avoid high gains."""
    by_name = {o.name: o for o in orders}
    table = by_name["Table I"]
    cases, shown = [], []
    for name in ("equal bandwidth", "equal delay margin"):
        one = by_name[f"m = 1, {name}"]
        for what, a, b in (
            ("largest gain of (17)", table.largest_gain, one.largest_gain),
            ("gain from measurement to acceleration", table.noise_gain, one.noise_gain),
        ):
            cases.append(Case(f"{what}, {name}", Figure(a, a), a < b))
            shown.append(f"{what} {a:.1e} against {b:.1e} ({name})")
    errors = ", ".join(f"{o.name} {o.pushed.at_half:.1e}" for o in orders)
    tally = Tally(tuple(cases))
    return Claim(
        "More extended states permit 'to avoid the deployment of high gains in the observer'",
        "III.A",
        tally.word,
        f"m = 7 (Table I) against m = 1: {'; '.join(shown)}",
        f"delay margin {1e6 * table.delay_margin:.0f} us for Table I, "
        f"{1e3 * by_name['m = 1, equal bandwidth'].delay_margin:.2f} ms for m = 1 of equal bandwidth, "
        f"which needs {by_name['m = 1, equal delay margin'].bandwidth:.0f} rad/s to be as fragile. What "
        f"m = 7 buys is a smaller error: under the push {errors} rad; at 5 Hz {table.slow:.1e} against "
        f"{by_name['m = 1, equal delay margin'].slow:.1e} s^2 at equal delay margin",
        tally.share,
        f"closed forms; errors under the push, {changes([o.pushed for o in orders])}",
    )


def smooth_disturbance(jumps: Sequence[Jumps]) -> Claim:
    """Section I on the total disturbances."""
    limit = declared()["limits"]["jump"]
    rough = [j for j in jumps if j.at_impact > limit]
    word = NOT_TESTABLE
    if rough:
        word = CONTRADICTED if len(rough) == len(jumps) else DEPENDS
    return Claim(
        "The total disturbances 'are smooth in all of its arguments', and d^m xi / dt^m is about zero",
        "I; III.A",
        word,
        f"xi jumps by {span([j.at_impact for j in jumps], '.0f')} rad/s^2 at every impact, by "
        f"{span([j.at_edge for j in jumps], '.0f')} at an edge of 30 N m",
        f"against it: a jump at impact above {limit:g} rad/s^2 in every preset. An assumption of the "
        "observer, not met where it matters: the error of ADRC is the spike of about 1 ms at such a "
        "jump. ADRC tracks all the same, with the reset of the observer at impact that the paper does "
        "not mention",
        share=f"{len(rough)} of {len(jumps)} presets jump{fewer(len(jumps), in_all(1))}",
    )


def hurwitz() -> Claim:
    """Section III.A on (19)."""
    return Claim(
        "The observer is asymptotically stable: the matrix of (19) is Hurwitz",
        "III.A; Table I",
        BY_CONSTRUCTION,
        f"poles from {-max(TABLE_I):.0f} to {-min(TABLE_I):.0f} rad/s"
        if max(TABLE_I) < 0
        else "unstable poles",
        "the poles are chosen; (18) as printed has a term kappa u too many",
    )


def decoupled() -> Claim:
    """Section III.A on the MIMO system."""
    return Claim(
        "The multivariable system can be treated as decoupled, joint by joint",
        "III.A",
        BY_CONSTRUCTION,
        "u = kappa^-1 (...) in (20)",
        "exact while kappa of the model is that of the robot; with another plant the rest is part of "
        "the total disturbance, whose cost is the row on model uncertainties",
    )


def tends_to_zero(numerics: Mapping[str, float]) -> Claim:
    """(23) under a disturbance that goes on."""
    simulated, half, corrected, printed = (
        numerics.get(name, math.nan)
        for name in (
            "tracking error per unit disturbance on a held joint, simulated [s^2]",
            "the same at half the step [s^2]",
            "the same by (23) corrected [s^2]",
            "the same by (23) as printed [s^2]",
        )
    )
    amplitude, share = Figure(simulated, half), convergence()[0]
    seen = simulated > 0.0 and abs(simulated - corrected) <= 0.01 * corrected
    firm = amplitude.converged(share, 0.0)
    said = f"{changes([amplitude])}, with Table I times 0.05, to stand clear of round-off"
    return Claim(
        "(23) 'shows that the tracking error tend asymptotically to zero'",
        "III.B",
        CONTRADICTED if seen and firm else NOT_TESTABLE,
        f"under a lasting sine of 5 Hz on a held joint the error keeps an amplitude of {simulated:.3g} "
        f"s^2 per unit of disturbance; (23) corrected gives {corrected:.3g}, as printed {printed:.3g}",
        "the implication is by construction, (23) being a stable filter with K_p = "
        f"{float(TABLE_II.K_p):g}, K_d = {float(TABLE_II.K_d):g}; its first condition, an estimation "
        "error that tends to zero, is met by disturbances that are polynomials of order m - 1 and by "
        "no other. The printed l_(m+1) lacks its factor K_d",
        convergence=said,
        marginal=int(not firm),
    )
