"""Claims about the gait and its stability: sections I, II, IV, V and VII.

One function per claim: it makes cases of the evidence, and the values of the claim's text. Called by
`claims.table`; cases are judged in `claims.tally`, texts are in claims.toml.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

import numpy as np

from biped_adrc.analysis.feasibility import but_for_the_impact
from biped_adrc.gait.published import PUBLISHED_MULTIPLIERS, X_STAR
from biped_adrc.paper.claims.admissible import convergence, declared, in_all
from biped_adrc.paper.claims.evidence import (
    GaitCycle,
    Needs,
    Start,
    fastest_decay,
    longest_step,
    noise_spectrum,
)
from biped_adrc.paper.claims.tally import (
    CONTRADICTED,
    DEPENDS,
    NOT_TESTABLE,
    AtTwoSteps,
    ClaimCase,
    Tally,
    above_limit,
    below_limit,
    fewer,
)
from biped_adrc.paper.claims.words import Claim, Extremes, limited, row, told

PRINTED_SPEED = float(X_STAR[5] + 0.5 * X_STAR[7] + X_STAR[9])
"""Theta' of x* [rad/s], with Theta = q5 + q1 + q3 / 2."""


def gait_claims(
    cycles: Sequence[GaitCycle], needs: Sequence[Needs], starts: Sequence[Start], distance: float
) -> list[Claim]:
    """All rows of this module; distance: of the undisturbed walks on gait (a) from x* [rad, rad/s]."""
    return [
        told("fixed_point", values={"distance": distance}),
        stable([c for c in cycles if c.gait == "published"]),
        recipe_stable([c for c in cycles if c.gait == "recipe"]),
        recipe_speed([c for c in cycles if c.gait == "recipe" and c.controller == "NPD"]),
        recipe_needs([n for n in needs if n.gait == "recipe"]),
        pinned_at_impact(needs),
        not_smooth(needs),
        not_optimal(needs),
        global_stability(starts),
        printed_multipliers([c.period for c in cycles]),
    ]


def stable(cycles: Sequence[GaitCycle], name: str = "stable", of_preset: int = 4) -> Claim:
    """The largest multiplier of a cycle is below 1, for gait (a); under another name the same row for gait (b).

    of_preset: cycles declared per preset. Near 1 the bound of convergence is the declared accuracy of
    multipliers.
    """
    bound = (convergence()[0], declared()["limits"]["multiplier"])
    return limited(
        name,
        ((c.name, c.multiplier) for c in cycles),
        math.nextafter(1.0, 0.0),
        in_all(of_preset),
        bound,
        multipliers=Extremes.of(c.multiplier for c in cycles),
    )


recipe_stable = partial(stable, name="recipe_stable", of_preset=2)
"""Gait (b) is stable."""


def recipe_speed(cycles: Sequence[GaitCycle]) -> Claim:
    """The recipe predicts Theta' of x*, the one number of x* that does not enter it."""
    limit = declared()["limits"]["speed"]
    shown = ", ".join(
        f"{c.rate.at_half:.4f} ({100.0 * (c.rate.at_half / PRINTED_SPEED - 1.0):+.1f} %) {c.preset}"
        for c in cycles
    )
    return row(
        "recipe_speed",
        _speeds(cycles, limit),
        speed=PRINTED_SPEED,
        rates=shown,
        percent=100.0 * limit,
        hangs_on=_hangs_on(cycles),
    )


def _speeds(cycles: Sequence[GaitCycle], limit: float) -> Tally:
    """Cases that hold where Theta' is within the share `limit` of the printed one."""
    off = [AtTwoSteps(*(abs(v / PRINTED_SPEED - 1.0) for v in c.rate)) for c in cycles]
    cases = [below_limit(c.name, f, limit) for c, f in zip(cycles, off, strict=True)]
    return Tally(tuple(cases), in_all(1))


def _hangs_on(cycles: Sequence[GaitCycle]) -> str:
    """What a stricter limit would have changed, in words: the whole percentage below the largest deviation."""
    apart = [abs(c.rate.at_half / PRINTED_SPEED - 1.0) for c in cycles]
    worst = float(np.max(apart or [math.nan]))
    if math.isnan(worst):
        return ""
    lower = math.floor(100.0 * worst)
    word = _speeds(cycles, 0.01 * lower).word
    return f"The largest deviation is {100.0 * worst:.1f} %: a limit of {lower} % would make it '{word}'. "


def recipe_needs(needs: Sequence[Needs]) -> Claim:
    """Could a robot walk gait (b)? Its friction, normal force and torque against the limits of ground and
    motors.
    """
    cases = [
        ClaimCase(n.name, n.friction, but_for_the_impact(n.infeasible), _doubtful(n)) for n in needs
    ]
    shown = (
        f"{n.preset}: friction {_two(n.friction)} in the mean over 5 ms and "
        f"{_two(n.friction_at_an_instant)} at an instant, {n.torque.at_half:.0f} N m"
        for n in needs
    )
    return row("recipe_needs", Tally(tuple(cases), in_all(1)), needs="; ".join(shown))


def _doubtful(n: Needs) -> bool:
    """Whether the integration step decides what makes the gait feasible or not."""
    figures = (n.friction, n.normal, n.torque)
    return not (n.same and all(f.converged(*convergence()) for f in figures))


def _two(f: AtTwoSteps) -> str:
    """A number, at both integration steps where they differ."""
    if f.converged(*convergence()):
        return f"{f.at_half:.2f}"
    return f"{f.value:.2f} (not converged, {f.at_half:.2f} at half the step)"


def pinned_at_impact(needs: Sequence[Needs]) -> Claim:
    """The hypothesis of (6): the new foot does not slip at impact, as far as friction of the ground allows."""
    limit = declared()["limits"]["friction"]
    found = [(n.name, n.impulse_ratio) for n in needs]
    ratios = Extremes.of(n.impulse_ratio for n in needs)
    return limited("pinned_at_impact", found, limit, in_all(2), ratios=ratios)


def not_smooth(needs: Sequence[Needs]) -> Claim:
    """Section VII: the generated trajectory is not smooth at the impact."""
    limit = declared()["limits"]["smooth"]
    recipes = [n for n in needs if n.gait == "recipe"]
    cases = [
        ClaimCase(n.name, AtTwoSteps(n.rate_jump, n.rate_jump), n.rate_jump > limit)
        for n in recipes
    ]
    return row(
        "not_smooth",
        Tally(tuple(cases), in_all(1)),
        jumps=Extremes(n.rate_jump for n in recipes),
        invariant=max((n.rate_jump for n in needs if n.gait == "published"), default=math.nan),
    )


def not_optimal(needs: Sequence[Needs]) -> Claim:
    """Section VII: the generated gait is not optimal in energy. Gait (a) with a lower cost of transport shows
    it.
    """
    pairs = [
        (b, a)
        for b in needs
        for a in needs
        if b.preset == a.preset and (b.gait, a.gait) == ("recipe", "published")
    ]
    cases = [
        above_limit(
            b.preset, AtTwoSteps(*(x / y for x, y in zip(b.cost, a.cost, strict=True))), 1.0
        )
        for b, a in pairs
    ]
    costs = (f"{b.preset} {b.cost.at_half:.3f} against {a.cost.at_half:.3f}" for b, a in pairs)
    return row("not_optimal", Tally(tuple(cases), in_all(1)), costs="; ".join(costs))


def global_stability(starts: Sequence[Start]) -> Claim:
    """Section I promises a test of global stability. Starts below the least speed do not reach the next impact.

    That is a counterexample under any controller of the joints; a start just above it has to walk on, or the
    least speed would not be the boundary.
    """
    below = [s for s in starts if s.factor < 1.0]
    fails = [s for s in below if s.same and not any(s.impacts.values())]
    above = [s for s in starts if s.factor > 1.0]
    passed = [s for s in above if s.same and all(v == s.asked for v in s.impacts.values())]
    word = NOT_TESTABLE
    if fails and passed:
        every = len(fails) == len(below) and len(passed) == len(above)
        word = CONTRADICTED if every else DEPENDS
    values = {
        "failing": Extremes(s.least * s.factor for s in fails),
        "passing": Extremes(s.least * s.factor for s in passed),
        "least": Extremes(s.least for s in starts),
        "fails": len(fails),
        "below": len(below),
        "passed": len(passed),
        "above": len(above),
    }
    return told(
        "global_stability",
        word,
        values,
        share=f"{len(fails)} of {len(below)} starts below fail, {len(passed)} of {len(above)} above walk on"
        f"{fewer(len(starts), in_all(len(declared()['basin']['factors'])))}",
        convergence="impacts made are the same at half the step",
        marginal=sum(not s.same for s in starts),
    )


def printed_multipliers(periods: Sequence[float]) -> Claim:
    """The ten multipliers of section VI: can they be those of the walk?

    A tracking error decays like exp(-K_d T / 2) in a step of T seconds. The least printed multiplier would need
    a shorter step than the gait has; what the same regression makes of noise is told beside it.
    """
    period, least = min(periods, default=math.nan), min(PUBLISHED_MULTIPLIERS)
    values = {
        "published": ", ".join(f"{v:g}" for v in PUBLISHED_MULTIPLIERS),
        "decay": fastest_decay(0.4),
        "least": least,
        "longest": 1e3 * longest_step(least),
        "period": 1e3 * period,
        "noise": ", ".join(f"{v:.2f}" for v in noise_spectrum()),
    }
    word = CONTRADICTED if longest_step(least) < period else NOT_TESTABLE
    return told("printed_multipliers", word, values)
