"""Claims about the push on the joints: figures 4, 5 and 6, rejection, and what it asks of the ground.

One function per claim: it makes a case of each admissible choice (`claims.admissible`), and the values of the
claim's text. Called by `claims.table`; cases are judged in `claims.tally`, texts are in claims.toml.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from biped_adrc.analysis.certificate import IMPULSE
from biped_adrc.analysis.feasibility import COUNTED, but_for_the_impact
from biped_adrc.paper.claims import admissible
from biped_adrc.paper.claims.admissible import convergence, declared
from biped_adrc.paper.claims.tally import NOT_TESTABLE, AtTwoSteps, ClaimCase, Tally, above_limit
from biped_adrc.paper.claims.walks import MemberOutcome, MemberWalk
from biped_adrc.paper.claims.words import Claim, Extremes, limited, row, told
from biped_adrc.paper.push_map import PushCell, certain

Members = Sequence[MemberOutcome]
"""The push at all admissible choices."""


def push_claims(members: Members, cells: Sequence[PushCell] = ()) -> list[Claim]:
    """All rows of this module but `long_walk`; cells: of the map of pushes, where it was made."""
    rules = (rejection, tracking, deviates, walks_on, unaffected, feasible)
    return [*(rule(members) for rule in rules), critical_phase(members, cells)]


def long_walk(made: Mapping[str, tuple[int, int]]) -> Claim:
    """The headline runs make all impacts; made: impacts made and asked for, by controller."""
    cases = [ClaimCase(c, AtTwoSteps(m, m), m >= asked) for c, (m, asked) in made.items()]
    counted = ", ".join(f"{c} {m} of {asked}" for c, (m, asked) in made.items())
    return row("long_walk", Tally(tuple(cases)), made=counted)


def _tally(cases: Sequence[ClaimCase]) -> Tally:
    """The tally of one case per admissible choice."""
    return Tally(tuple(cases), len(admissible.members()))


def rejection(members: Members) -> Claim:
    """What the push adds to the error under ADRC over what it adds under NPD, at most the declared ratio.

    The error of the walk without a push is subtracted first, so that errors of other origin do not count.
    """
    limit = declared()["limits"]["ratio"]
    return limited(
        "rejection",
        ((o.member.name, o.rejection) for o in members),
        limit,
        len(admissible.members()),
        npd=Extremes.of(o.walked["NPD"].deviation for o in members),
        adrc=Extremes.of(o.walked["ADRC"].deviation for o in members),
        ratios=Extremes.of(o.rejection for o in members),
    )


def tracking(members: Members) -> Claim:
    """The same ratio of the peak error itself, whatever causes it; also apart by the choice of Theta''."""
    limit = declared()["limits"]["ratio"]
    by_theta = {
        theta: Extremes.of(o.walked["ADRC"].peak for o in members if o.member.theta == theta)
        for theta in declared()["factors"]["theta"]
    }
    return limited(
        "tracking",
        ((o.member.name, o.tracking) for o in members),
        limit,
        len(admissible.members()),
        ratios=Extremes.of(o.tracking for o in members),
        **by_theta,
    )


def deviates(members: Members) -> Claim:
    """Figure 4: the push affects NPD, by a deviation that is at least the declared limit [rad]."""
    limit, found = declared()["limits"]["deviation"], [o.walked["NPD"].deviation for o in members]
    cases = [above_limit(o.member.name, f, limit) for o, f in zip(members, found, strict=True)]
    return row("deviates", _tally(cases), deviations=Extremes.of(found))


def walks_on(members: Members) -> Claim:
    """Both controllers make all steps under the push; the period of the pushed step shows convergence."""
    cases = []
    for o in members:
        each, period = o.walked.values(), o.walked["ADRC"].period
        made, doubtful = all(w.made for w in each), any(map(_doubtful, each))
        cases.append(ClaimCase(o.member.name, period, made, doubtful))
    npd, adrc = (sum(o.walked[c].made for o in members) for c in ("NPD", "ADRC"))
    steps = declared()["steps"]["impacts"]
    return row("walks_on", _tally(cases), steps=steps, npd=npd, adrc=adrc, count=len(members))


def _doubtful(w: MemberWalk) -> bool:
    """Whether the integration step decides how a walk ends, or how long its pushed step takes."""
    return not w.same or (w.made and not w.period.converged(*convergence()))


def unaffected(members: Members) -> Claim:
    """Figure 6: the cycle in (Theta, Theta') under ADRC is not affected by the push.

    By the change of Theta' at the end of the pushed step [rad/s]; infinite where there is no impact, since that
    cycle is lost.
    """
    steps, limit = declared()["steps"], declared()["limits"]["cycle"]
    # infinite where there is no impact: that cycle is lost
    rates = [np.abs(o.walked["ADRC"].rate) for o in members]
    size = [AtTwoSteps(*np.where(np.isnan(rate), np.inf, rate).tolist()) for rate in rates]
    bound = (steps["convergence"], steps["round_off_rate"])
    return limited(
        "unaffected",
        zip((o.member.name for o in members), size, strict=True),
        limit,
        len(admissible.members()),
        bound,
        adrc=max((f.at_half for f in size), default=math.nan),
        npd=Extremes(abs(o.walked["NPD"].rate.at_half) for o in members),
    )


def feasible(members: Members) -> Claim:
    """Ground and motors can give what ADRC's walks need: the support leg stays where it is without glue.

    A walk that is feasible but for the impact counts, and is counted apart.
    """
    walked = [(o.member.name, o.walked["ADRC"]) for o in members]
    held = [w.made and but_for_the_impact(w.infeasible) for _, w in walked]
    cases = [
        ClaimCase(name, w.period, holds, not w.same)
        for (name, w), holds in zip(walked, held, strict=True)
    ]
    why = sorted({x for _, w in walked for name, x in w.infeasible.items() if name != IMPULSE})
    apart = sum(h and bool(w.infeasible) for h, (_, w) in zip(held, walked, strict=True))
    said = {"why": "; ".join(why) or "nothing", "apart": apart, "count": len(walked)}
    return row("feasible", _tally(cases), **said)


def critical_phase(members: Members, cells: Sequence[PushCell] = ()) -> Claim:
    """A push in a critical phase makes NPD fall and not ADRC: over the map of pushes, where there is one.

    Without the map over the admissible choices; if NPD falls in none of them, nothing is said.
    """
    if cells:
        return _critical_phase_of_the_map(cells)
    lost = [o for o in members if not o.walked["NPD"].made]
    cases = []
    for o in lost:
        npd, adrc = o.walked["NPD"], o.walked["ADRC"]
        cases.append(ClaimCase(o.member.name, npd.peak, adrc.made, not (npd.same and adrc.same)))
    tally = Tally(tuple(cases))
    counted = {"lost": len(lost), "count": len(members), "held": tally.held}
    if not cases:
        return told("no_critical_phase", NOT_TESTABLE, counted)
    return row("critical_phase", tally, **counted)


def _critical_phase_of_the_map(cells: Sequence[PushCell]) -> Claim:
    """Where NPD makes no further steps ADRC has to, the impact aside; marginal cells are left out."""
    known = certain(cells)
    lost = [c for c in known if c.npd.outcome in LOST]
    cases = [
        ClaimCase(_name(c), AtTwoSteps(c.amplitude, c.amplitude), c.adrc.outcome in COUNTED)
        for c in lost
    ]
    return row(
        "critical_phase_of_the_map",
        Tally(tuple(cases)),
        lost=len(lost),
        known=len(known),
        on=sum(c.adrc.outcome not in LOST for c in lost),
        feasible=sum(c.adrc.outcome == "feasible" for c in lost),
        apart=sum(c.adrc.outcome == "but_impact" for c in lost),
        alone=sum(c.adrc.outcome in LOST and c.npd.outcome not in LOST for c in known),
        doubtful=len(cells) - len(known),
    )


LOST = ("fell", "ended")
"""Outcomes of a walk that did not make its steps."""


def _name(c: PushCell) -> str:
    """A cell of the map, for a reader."""
    limit = "unlimited" if c.torque_limit is None else f"{c.torque_limit:g} N m"
    return f"{c.preset}, {c.amplitude:g} N m, {c.pattern}, from {c.onset:g} s, motors {limit}"
