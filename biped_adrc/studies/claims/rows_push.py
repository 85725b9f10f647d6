"""Claims about the push on the joints: figures 4, 5 and 6, rejection, and what it asks of the ground."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from biped_adrc.studies.claims import admissible
from biped_adrc.studies.claims.admissible import convergence, declared
from biped_adrc.studies.claims.walks import MemberOutcome, Walked
from biped_adrc.studies.claims.words import (
    NOT_TESTABLE,
    Case,
    Claim,
    Figure,
    Tally,
    above_limit,
    below_limit,
    judged,
    span,
)
from biped_adrc.studies.push_map import Cell, certain

Members = Sequence[MemberOutcome]


def push_claims(members: Members, cells: Sequence[Cell] = ()) -> list[Claim]:
    """All rows of this module; cells: of the map of pushes, where it was made."""
    return [
        rejection(members),
        tracking(members),
        deviates(members),
        walks_on(members),
        unaffected(members),
        legal(members),
        critical_phase(members, cells),
    ]


def long_walk(made: Mapping[str, tuple[int, int]]) -> Claim:
    """The headline runs: impacts made and asked for, by controller."""
    cases = [Case(c, Figure(m, m), m >= asked) for c, (m, asked) in made.items()]
    return judged(
        "Each controller walks 12.5 steps (25 impacts) with the push in the 10th",
        "VI",
        Tally(tuple(cases)),
        ", ".join(f"{c} {m} of {asked}" for c, (m, asked) in made.items()),
        "one push, one preset: the settings of this run",
        asserted=True,
    )


def _tally(cases: Sequence[Case]) -> Tally:
    return Tally(tuple(cases), len(admissible.members()))


def rejection(members: Members) -> Claim:
    """What the push adds to the error under ADRC, over what it adds under NPD."""
    limit = declared()["limits"]["ratio"]
    cases = [below_limit(o.member.name, o.rejection, limit, convergence()) for o in members]
    npd, adrc = ([o.walked[c].deviation.at_half for o in members] for c in ("NPD", "ADRC"))
    ratios = span([o.rejection.at_half for o in members], ".2g")
    return judged(
        "The control strategy effectively rejects the external disturbances, torques on the joints",
        "abstract; VI; VII",
        _tally(cases),
        f"deviation made by the push: NPD {span(npd, '.2g')} rad, ADRC {span(adrc, '.2g')} rad, ratio "
        f"{ratios}",
        f"holds where the ratio is at most {limit:g}; torques on the joints are matched, a motor could "
        "cancel them. Unmatched ones and model errors are rows of their own",
        asserted=True,
    )


def tracking(members: Members) -> Claim:
    """The peak of the error itself, whatever makes it."""
    limit = declared()["limits"]["ratio"]
    cases = [below_limit(o.member.name, o.tracking, limit, convergence()) for o in members]
    by_theta = {
        theta: span(
            [o.walked["ADRC"].peak.at_half for o in members if o.member.theta == theta], ".2g"
        )
        for theta in declared()["factors"]["theta"]
    }
    return judged(
        "Figure 5: ADRC walks 'without deviation of the tracking reference'",
        "VI",
        _tally(cases),
        f"largest error of ADRC: {by_theta['solved']} rad with Theta'' solved, {by_theta['printed']} "
        f"rad with (20) as printed; over NPD's {span([o.tracking.at_half for o in members], '.2g')}",
        f"holds where ADRC's largest error is at most {limit:g} of NPD's. It hangs on the treatment of "
        "Theta'' alone: (20) as printed leaves h' Theta'' out, and the joints lag their references "
        "with or without a push",
    )


def deviates(members: Members) -> Claim:
    """NPD under the push."""
    limit = declared()["limits"]["deviation"]
    cases = [
        above_limit(o.member.name, o.walked["NPD"].deviation, limit, convergence()) for o in members
    ]
    values = span([o.walked["NPD"].deviation.at_half for o in members], ".2g")
    return judged(
        "Figure 4: the push affects the performance of NPD",
        "VI",
        _tally(cases),
        f"deviation made by the push {values} rad",
        f"holds from {limit:g} rad on; the figure's scale is not in the text",
        asserted=True,
    )


def walks_on(members: Members) -> Claim:
    """Both controllers make the steps."""
    cases = [
        Case(
            o.member.name,
            o.walked["ADRC"].period,
            all(w.made for w in o.walked.values()),
            any(_doubtful(w) for w in o.walked.values()),
        )
        for o in members
    ]
    made = {c: sum(o.walked[c].made for o in members) for c in ("NPD", "ADRC")}
    return judged(
        "Both controllers keep walking under the push ('the system has the capacity to keep the "
        "stability')",
        "VI",
        _tally(cases),
        f"all {declared()['steps']['impacts']} steps from the pushed one on: NPD in {made['NPD']}, ADRC "
        f"in {made['ADRC']} of {len(members)}",
        "counted on a foot that cannot slip or be pulled off the ground, as in the paper; 25 impacts "
        "are walked by the headline runs",
        asserted=True,
    )


def _doubtful(w: Walked) -> bool:
    """Whether the step decides how a walk ends, or how long its pushed step takes; a fall has no such time."""
    return not w.same or (w.made and not w.period.converged(*convergence()))


def unaffected(members: Members) -> Claim:
    """Figure 6: the cycle in (Theta, Theta') under ADRC."""
    steps, limit = declared()["steps"], declared()["limits"]["cycle"]
    size = [Figure(*(_size(v) for v in o.walked["ADRC"].rate)) for o in members]
    bound = (steps["convergence"], steps["round_off_rate"])
    cases = [
        below_limit(o.member.name, f, limit, bound) for o, f in zip(members, size, strict=True)
    ]
    npd = span([abs(o.walked["NPD"].rate.at_half) for o in members], ".1e")
    return judged(
        "Figure 6: the limit cycle of ADRC 'has not been affected by the external disturbances'",
        "VI",
        _tally(cases),
        "change of Theta' at the impact after the push: ADRC at most "
        f"{max((f.at_half for f in size), default=math.nan):.1e} rad/s, NPD {npd} rad/s",
        f"holds up to {limit:g} rad/s. A torque on the joints does not enter the row of the torso, so a "
        "walk that stays on its constraint keeps its cycle",
        asserted=True,
    )


def _size(rate: float) -> float:
    """Infinite where there is no impact: that cycle is lost."""
    return math.inf if math.isnan(rate) else abs(rate)


def legal(members: Members) -> Claim:
    """Whether ground and motors could have given it."""
    cases = []
    for o in members:
        adrc = o.walked["ADRC"]
        holds = adrc.made and not reasons(o)
        cases.append(Case(o.member.name, adrc.period, holds, not adrc.same))
    why = sorted({reason for o in members for reason in reasons(o)})
    return judged(
        "Under the push ADRC walks within the model of section II: the support leg stays pinned",
        "II; VI",
        _tally(cases),
        f"against it: {'; '.join(why) if why else 'nothing'}",
        "the paper looks neither at the ground's force nor at the motors' limits; the impulse at "
        "impact is a row of its own",
    )


def reasons(o: MemberOutcome) -> tuple[str, ...]:
    """Why the ground or the motors could not have carried ADRC's walk."""
    return o.walked["ADRC"].illegal


CRITICAL = (
    "NPD 'does not have the ability to guarantee the stability' when pushed in a critical phase"
)


def critical_phase(members: Members, cells: Sequence[Cell] = ()) -> Claim:
    """Pushes in which NPD is lost, of the map where there is one; without any nothing is said about it."""
    if cells:
        return _critical_phase_of_the_map(cells)
    lost = [o for o in members if not o.walked["NPD"].made]
    cases = [
        Case(
            o.member.name,
            o.walked["NPD"].peak,
            o.walked["ADRC"].made,
            not all(w.same for w in o.walked.values()),
        )
        for o in lost
    ]
    tally = Tally(tuple(cases))
    number = f"NPD is lost in {len(lost)} of {len(members)}, ADRC then walks on in {tally.held}"
    if not cases:
        return Claim(
            CRITICAL,
            "VI",
            NOT_TESTABLE,
            number,
            "neither the phase nor the push is printed, and no push of the set throws either "
            "controller; stronger ones are on the page docs/critical_phase.md and in a run with --full",
        )
    return judged(CRITICAL, "VI", tally, number, "over the members in which NPD is lost")


def _critical_phase_of_the_map(cells: Sequence[Cell]) -> Claim:
    """Where NPD makes no further steps ADRC has to, with what ground and motors give."""
    known = certain(cells)
    lost = [c for c in known if c.npd.outcome in LOST]
    cases = [
        Case(_name(c), Figure(c.amplitude, c.amplitude), c.adrc.outcome == "legal") for c in lost
    ]
    on = sum(c.adrc.outcome not in LOST for c in lost)
    other = sum(c.adrc.outcome in LOST and c.npd.outcome not in LOST for c in known)
    return judged(
        CRITICAL,
        "VI",
        Tally(tuple(cases)),
        f"NPD is lost in {len(lost)} of {len(known)} pushes of the map, ADRC then walks on in {on}, "
        f"legally in {sum(case.holds for case in cases)}; ADRC alone is lost in {other}",
        "neither the phase nor the push is printed: over the pushes of the map in which NPD is lost; "
        "holds where ADRC then makes all steps within what ground and motors give. Pushes that end "
        f"differently at half the step, {len(cells) - len(known)}, are left out; the map is on the page "
        "docs/critical_phase.md",
    )


LOST = ("fell", "ended")


def _name(c: Cell) -> str:
    limit = "unlimited" if c.torque_limit is None else f"{c.torque_limit:g} N m"
    return f"{c.preset}, {c.amplitude:g} N m, {c.pattern}, from {c.onset:g} s, motors {limit}"
