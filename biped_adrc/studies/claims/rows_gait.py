"""Claims about the gait and its stability: sections I, II, IV, V and VII."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from biped_adrc.gait.published import PUBLISHED_MULTIPLIERS, X_STAR
from biped_adrc.studies.claims.admissible import convergence, declared, in_all
from biped_adrc.studies.claims.evidence import (
    Cycle,
    Needs,
    Start,
    fastest_decay,
    longest_step,
    noise_spectrum,
)
from biped_adrc.studies.claims.words import (
    BY_CONSTRUCTION,
    CONTRADICTED,
    DEPENDS,
    NOT_TESTABLE,
    Case,
    Claim,
    Figure,
    Tally,
    above_limit,
    below_limit,
    fewer,
    judged,
    span,
)

PRINTED_SPEED = float(X_STAR[5] + 0.5 * X_STAR[7] + X_STAR[9])
"""Theta' of x* [rad/s], Theta = q5 + q1 + q3 / 2."""


def gait_claims(
    cycles: Sequence[Cycle], needs: Sequence[Needs], starts: Sequence[Start], distance: float
) -> list[Claim]:
    """All rows of this module; distance: of the undisturbed walks on gait (a) from x*."""
    return [
        fixed_point(distance),
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


def fixed_point(distance: float) -> Claim:
    """x* of section VI."""
    return Claim(
        "The walk has the fixed point x* in the Poincaré map",
        "VI",
        BY_CONSTRUCTION,
        f"farthest from x* after the undisturbed walks: {distance:.1e} (rad, rad/s)",
        "gait (a) was designed to pass through x*, since the polynomials are not printed; that "
        "RABBIT's geometry puts the foot of x* on the ground could have failed, and does not",
    )


def _largest(cycles: Sequence[Cycle], declared_cycles: int) -> Tally:
    below_one, round_off = math.nextafter(1.0, 0.0), declared()["limits"]["multiplier"]
    bound = (convergence()[0], round_off)
    cases = tuple(below_limit(c.name, c.multiplier, below_one, bound) for c in cycles)
    return Tally(cases, declared_cycles)


def stable(cycles: Sequence[Cycle]) -> Claim:
    """Gait (a), by central differences."""
    return judged(
        "The walk is asymptotically stable: all |lambda| are less than one",
        "abstract; VI; VII",
        _largest(cycles, in_all(4)),
        f"largest multiplier of gait (a) {span([c.multiplier.at_half for c in cycles], '.4f')}",
        "central differences of the return map, not the regression (27). The largest is delta^2 of the "
        "impact at x*, which RABBIT's parameters give; the others are tracking errors and decay by the "
        "gains of Table II",
        asserted=True,
    )


def recipe_stable(cycles: Sequence[Cycle]) -> Claim:
    """Gait (b)."""
    return judged(
        "The gait of section IV is 'a successful virtual holonomic constraint to achieve a stable gait'",
        "IV; VII",
        _largest(cycles, in_all(2)),
        f"largest multiplier of gait (b) {span([c.multiplier.at_half for c in cycles], '.4f')}",
        "the recipe, with its free parameters from ratios of rates at x*, closes in a stable cycle on "
        "a foot that cannot slip; what it asks of ground and motors is the next row but one",
        asserted=True,
    )


def recipe_speed(cycles: Sequence[Cycle]) -> Claim:
    """The one number of x* that the recipe predicts."""
    limit = declared()["limits"]["speed"]
    tally, worst = _speeds(cycles, limit), _farthest(cycles)
    shown = ", ".join(
        f"{c.rate.at_half:.4f} ({100.0 * (c.rate.at_half / PRINTED_SPEED - 1.0):+.1f} %) {c.preset}"
        for c in cycles
    )
    return judged(
        f"The gait of section IV walks at the speed of x*, Theta' = {PRINTED_SPEED:.3f} rad/s before impact",
        "IV; VI",
        tally,
        f"{shown} rad/s",
        f"holds within {100.0 * limit:g} %. {_hangs_on(cycles, worst)}The only number of x* that the "
        "recipe predicts: pose and ratios of rates were used to fit it",
        asserted=True,
    )


def _speeds(cycles: Sequence[Cycle], limit: float) -> Tally:
    off = [Figure(*(abs(v / PRINTED_SPEED - 1.0) for v in c.rate)) for c in cycles]
    cases = [below_limit(c.name, f, limit, convergence()) for c, f in zip(cycles, off, strict=True)]
    return Tally(tuple(cases), in_all(1))


def _farthest(cycles: Sequence[Cycle]) -> float:
    """Largest deviation from the printed speed, as a share; NaN without a cycle."""
    return float(np.max([abs(c.rate.at_half / PRINTED_SPEED - 1.0) for c in cycles] or [math.nan]))


def _hangs_on(cycles: Sequence[Cycle], worst: float) -> str:
    """What another limit, the whole percentage below the largest deviation, would have made of it."""
    if math.isnan(worst):
        return ""
    lower = math.floor(100.0 * worst)
    word = _speeds(cycles, 0.01 * lower).word
    return f"The largest deviation is {100.0 * worst:.1f} %: a limit of {lower} % would make it '{word}'. "


def recipe_needs(needs: Sequence[Needs]) -> Claim:
    """Whether a robot could walk gait (b)."""
    cases = [Case(n.name, n.friction, not n.illegal, _doubtful(n)) for n in needs]
    shown = "; ".join(
        f"{n.preset}: friction {_two(n.friction)} in the mean over 5 ms and "
        f"{_two(n.friction_at_an_instant)} at an instant, {n.torque.at_half:.0f} N m"
        for n in needs
    )
    return judged(
        "The gait of section IV can be walked by the robot of section II (pinned foot, its motors)",
        "II; IV; VII",
        Tally(tuple(cases), in_all(1)),
        shown,
        "undisturbed; RABBIT's motors give 150 N m, dry ground a friction of 0.6. The paper prints "
        "neither torque nor ground force as a limit, so this is what its stability costs",
    )


def _doubtful(n: Needs) -> bool:
    """Whether the step decides what makes it legal or not."""
    figures = (n.friction, n.normal, n.torque)
    return not (n.same and all(f.converged(*convergence()) for f in figures))


def _two(f: Figure) -> str:
    """A number, at both steps where they differ."""
    if f.converged(*convergence()):
        return f"{f.at_half:.2f}"
    return f"{f.value:.2f} (not converged, {f.at_half:.2f} at half the step)"


def pinned_at_impact(needs: Sequence[Needs]) -> Claim:
    """The hypothesis of (6)."""
    limit = declared()["limits"]["friction"]
    cases = [below_limit(n.name, n.impulse_ratio, limit, convergence()) for n in needs]
    return judged(
        "At impact 'there exist no rebounds or slips in the stance foot'",
        "II",
        Tally(tuple(cases), in_all(2)),
        f"impulse ratio {span([n.impulse_ratio.at_half for n in needs], '.2f')}",
        f"holds where the impulse lies inside the cone of a friction of {limit:g}, at each gait's own "
        "impact; a hypothesis of the paper's, which its x* does not always meet",
    )


def not_smooth(needs: Sequence[Needs]) -> Claim:
    """Section VII on the impact of the generated trajectory."""
    limit = declared()["limits"]["smooth"]
    recipes = [n for n in needs if n.gait == "recipe"]
    cases = [Case(n.name, Figure(n.rate_jump, n.rate_jump), n.rate_jump > limit) for n in recipes]
    invariant = max((n.rate_jump for n in needs if n.gait == "published"), default=float("nan"))
    return judged(
        "The generated trajectory is not 'smooth enough in the impact'",
        "VII",
        Tally(tuple(cases), in_all(1)),
        f"rates after impact jump by {span([n.rate_jump for n in recipes], '.2g')} rad/s against gait "
        f"(b); by {invariant:.0e} against gait (a)",
        "gait (b) does not take the impact into account; gait (a), through the same x*, does: x* does "
        "not exclude a smooth one",
        asserted=True,
    )


def not_optimal(needs: Sequence[Needs]) -> Claim:
    """Section VII on energy."""
    pairs = [
        (b, a)
        for b in needs
        for a in needs
        if b.preset == a.preset and (b.gait, a.gait) == ("recipe", "published")
    ]
    cases = []
    for b, a in pairs:
        over = Figure(*(x / y for x, y in zip(b.cost, a.cost, strict=True)))
        cases.append(above_limit(b.preset, over, 1.0, convergence()))
    shown = "; ".join(
        f"{b.preset} {b.cost.at_half:.3f} against {a.cost.at_half:.3f}" for b, a in pairs
    )
    return judged(
        "The trajectory generation 'did not provide an optimal trajectory reference to minimize energy'",
        "VII",
        Tally(tuple(cases), in_all(1)),
        f"cost of transport of gait (b) against (a): {shown}",
        "holds where a gait through the same x* needs less; gait (a) was designed for torque, not for "
        "energy",
    )


def global_stability(starts: Sequence[Start]) -> Claim:
    """Section I promises a test of it."""
    below = [s for s in starts if s.factor < 1.0]
    fails = [s for s in below if s.same and not any(s.impacts.values())]
    above = [s for s in starts if s.factor > 1.0]
    passed = [s for s in above if s.same and all(v == s.asked for v in s.impacts.values())]
    word = NOT_TESTABLE
    if fails and passed:
        every = len(fails) == len(below) and len(passed) == len(above)
        word = CONTRADICTED if every else DEPENDS
    return Claim(
        "'Global stability is tested by Poincaré's return map'",
        "I",
        word,
        f"no step from {span([s.least * s.factor for s in fails], '.3f')} of the gait's speed after "
        f"impact, under either controller; from {span([s.least * s.factor for s in passed], '.3f')} all "
        "steps",
        "multipliers speak of a neighbourhood. The least speed, "
        f"{span([s.least for s in starts], '.3f')} of the gait's, follows from one quadrature of the "
        f"zero dynamics and {len(fails)} of {len(below)} starts 3 % below it fail, {len(passed)} of "
        f"{len(above)} above it walk on",
        f"{len(fails)} of {len(below)} starts below fail, {len(passed)} of {len(above)} above walk on"
        f"{fewer(len(starts), in_all(len(declared()['basin']['factors'])))}",
        "impacts made are the same at half the step",
        marginal=sum(not s.same for s in starts),
    )


def printed_multipliers(periods: Sequence[float]) -> Claim:
    """The ten numbers of section VI."""
    least = min(periods, default=float("nan"))
    return Claim(
        "|lambda(Phi)| = " + ", ".join(f"{v:g}" for v in PUBLISHED_MULTIPLIERS),
        "VI",
        CONTRADICTED if longest_step(min(PUBLISHED_MULTIPLIERS)) < least else NOT_TESTABLE,
        f"a tracking error decays to {fastest_decay(0.4):.1e} in 0.4 s under Table II; "
        f"{min(PUBLISHED_MULTIPLIERS):g} needs steps shorter than "
        f"{1e3 * longest_step(min(PUBLISHED_MULTIPLIERS)):.0f} ms, those here take {1e3 * least:.0f} ms "
        "or more",
        "one multiplier is of the cycle, the other eight of the section are tracking errors that decay "
        "like exp(-25 t). They come from a regression of ten states on a section of nine dimensions; "
        "on numbers that are noise alone the same regression gives, in the median, "
        + ", ".join(f"{v:.2f}" for v in noise_spectrum()),
    )
