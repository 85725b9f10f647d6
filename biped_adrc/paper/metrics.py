"""The scenarios on which claims are tried, from the results of a reproduction, and the metrics of claims.

claims.toml and checks.toml name these functions: one that takes `Runs` (all results) returns scenarios by name,
the others compute a metric of one of them; words behind the name of a function in the file are its first
arguments. A metric is `AtTwoSteps`, its value at the integration step used and at half of it, or a float, which
counts as the same at both. Where NaN may occur NumPy's max and min are used, since Python's ignore NaN, and a
limit would then count as kept by a number that does not exist.

    NPD, ADRC        the controllers: PD with decoupling of the inertia, and ADRC with an observer (Table I)
    x*               the paper's fixed point: (q, q') [rad, rad/s] just before an impact of its periodic walk
    gait (a), (b)    that through x*, and that by the recipe of section IV
    cycle            a periodic walk: fixed point of the return map from impact to impact; its multipliers are
                     the eigenvalues of the map's derivative, delta^2 the largest one in closed form
    Theta            phase of the gait [rad]; Theta' is its rate. (20) is the paper's law of ADRC
    Outcome          the numbers of one walk; a walk is asked for a number of impacts, and makes all of them
                     (`walked`) unless it falls or stops; `half` is the same walk at half the integration step
    Certificate      what a finished walking step has asked of ground and motors (forces, torques, work)
    member           a combination of the choices that the paper leaves open; its walks have a push on joints.
                     In a `MemberOutcome` they are in `walked`, by controller, each a `MemberWalk`: the figures
                     of merit from the pushed step on
    headline run     a walk of 25 impacts with the push that the user's plan has
    preset           a set of masses and inertias of the robot RABBIT
"""

import itertools
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Self

import numpy as np

from biped_adrc.analysis.feasibility import COUNTED
from biped_adrc.analysis.half_step import PEAK_RESOLUTION, AtTwoSteps
from biped_adrc.analysis.return_map import PeriodicOrbit
from biped_adrc.control.tracking import TABLE_II
from biped_adrc.core.types import Array
from biped_adrc.gait.published import PUBLISHED_MULTIPLIERS, X_STAR
from biped_adrc.paper.poincare import PoincareResult
from biped_adrc.paper.pushes import LOST, MemberOutcome, PushCell
from biped_adrc.paper.runs import Runs, SlowStart
from biped_adrc.paper.scenarios import CONTROLLERS, HEAVIER, declared
from biped_adrc.scenario.recording import Outcome

Pair = tuple[Outcome, Outcome]
"""A walk under NPD and under ADRC."""
RMS_RESOLUTION = 2e-10
"""Root mean squares this near count as equal [rad]; undisturbed walks change by 1.3e-10 at most."""


class Extremes(tuple[float, ...]):
    """Numbers of which a text names the smallest and the largest: "{peaks:.2g}" becomes "0.011 to 0.034"."""

    @classmethod
    def of(cls, figures: Iterable[AtTwoSteps]) -> Self:
        """The values at half of the integration step, the more accurate ones."""
        return cls(f.at_half for f in figures)

    def __format__(self, form: str) -> str:
        """Text of the smallest and the largest value, each by the format `form`, ".3g" if empty; one number
        where both give the same text, "none" without a number. It also says how many values are NaN.
        """
        known = [v for v in self if not math.isnan(v)]
        if not known:
            return "none"
        low, high = (f"{v:{form or '.3g'}}" for v in (min(known), max(known)))
        text = low if low == high else f"{low} to {high}"
        unknown = len(self) - len(known)
        return f"{text} ({unknown} are no numbers)" if unknown else text


# -- a walk at the integration step used and at half of it -------------------------------------------
def compared(o: Outcome) -> tuple[tuple[float, float], ...]:
    """The figures of merit of a walk that are compared at two integration steps: pairs (value, resolution),
    both in the unit of the value; two values agree when they differ by at most the resolution.

    Numbers that would not converge are replaced by 0: forces that are infinite, as where no single support is
    long enough for a mean, and the friction where F_N <= 0, as the ratio F_T / F_N has its pole at F_N = 0. F_T
    and F_N are the force of the ground along it and out of it. A resolution of 0 asks for 1 % alone.
    """
    # f: extremes over the walk; last: work and energy of the last finished walking step
    f, last = o.feasibility, o.certificates[-1] if o.certificates else None
    forces = (f.mean_normal_force, f.mean_friction, f.impulse_ratio) if f.supports else (0.0,) * 3
    normal, friction, impulse = (0.0 if x == math.inf else x for x in forces)
    return (
        (o.peak_error, PEAK_RESOLUTION),
        (o.rms_error, RMS_RESOLUTION),
        (o.peak_torque, 0.0),
        (float(np.max(o.durations, initial=0.0)), 0.0),
        (float(np.min(o.durations, initial=math.inf)), 0.0),
        (last.joint_work if last else 0.0, 1e-6),  # [J]
        (last.energy_lost if last else 0.0, 1e-6),  # [J]
        (normal, 0.0),
        (friction if normal > 0.0 else 0.0, 0.0),
        (impulse, 0.0),
    )


def largest_gap(o: Outcome) -> float:
    """The largest relative change [1] of a figure of merit from o to o.half, which has half the integration
    steps.

    Infinite where the two runs end differently; "feasible" and "not feasible" are different endings. A run that
    falls before its last impact has no figures of merit: only its ending has to be the same.
    """
    assert o.half is not None
    one, half = ((x.status, x.impacts, x.feasibility.outcome) for x in (o, o.half))
    if one != half:
        return math.inf
    # near: the difference below which two values count as equal
    pairs = zip(compared(o), compared(o.half), strict=True)
    return max(AtTwoSteps(x, y).gap(near) for (x, near), (y, _) in pairs) if o.walked else 0.0


def order_of_error(o: Outcome) -> float:
    """Observed order k [1] in which the peak tracking error e converges with the integration step h; NaN if two
    of the errors are equal.

    k = log2 (|e(h) - e(h/2)| / |e(h/2) - e(h/4)|), from the outcomes o, o.half and o.half.half of the same walk
    """
    assert o.half is not None
    assert o.half.half is not None
    first, second, third = (x.peak_error for x in (o, o.half, o.half.half))
    if first == second or second == third:
        return math.nan
    return math.log2(abs(first - second) / abs(second - third))


# -- metrics of claims, and their scenarios ------------------------------------------------------------
def at_two(of: Callable[..., float], *found: Any) -> AtTwoSteps:
    """The number `of(*found)`, found: outcomes of walks at the integration step used; and the same number of
    the outcomes in their fields `half`, which are those at half of the step.
    """
    return AtTwoSteps(of(*found), of(*(x.half for x in found)))


def share_of_impacts(o: Outcome) -> AtTwoSteps:
    """Share [1] of the impacts asked for that the walk makes."""
    return at_two(lambda x: x.impacts / x.run.run.impacts, o)  # made over asked for


def distance(o: Outcome) -> float:
    """max |x- - x*| over q [rad] and q' [rad/s] at the last impact, with x* of the paper's section VI; infinite
    where the walk does not make all impacts. The controller's states behind (q, q') do not count.
    """
    if not o.walked:
        return math.inf
    # X_STAR (10,): x* as printed
    return float(np.max(np.abs(o.x_minus[-1][: len(X_STAR)] - X_STAR)))


def error(pair: Pair) -> AtTwoSteps:
    """Ratio [1] of the peak error under ADRC to that under NPD; infinite unless both walks make all impacts."""

    def of_peaks(npd: Outcome, adrc: Outcome) -> float:
        return peak_ratio((npd, adrc)) if npd.walked and adrc.walked else math.inf

    # at_two: the ratio of these outcomes, and of those at half the integration step
    return at_two(of_peaks, *pair)


def largest(name: str, o: Outcome) -> float:
    """The largest value of the field `name` of `Certificate` over all finished walking steps, in its unit;
    infinite without a step, so that no limit counts as kept.
    """
    return float(np.max([getattr(s, name) for s in o.certificates] or [math.inf]))


def least(name: str, o: Outcome) -> float:
    """The least value of the field `name` of `Certificate` over all finished walking steps, in its unit; minus
    infinity without a step, so that no limit counts as kept.
    """
    return float(np.min([getattr(s, name) for s in o.certificates] or [-math.inf]))


def last(name: str, o: Outcome) -> float:
    """The field `name` of the `Certificate` of the last finished walking step; NaN without a step."""
    return float(getattr(o.certificates[-1], name)) if o.certificates else math.nan


def last_at_two(name: str, o: Outcome) -> AtTwoSteps:
    """The field `name` of the `Certificate` of the last finished walking step, at the integration step used and
    at half of it.
    """
    return at_two(lambda x: last(name, x), o)


def of_orbit(of: Callable[[PeriodicOrbit], float], found: PoincareResult | str) -> AtTwoSteps:
    """The number `of(orbit)` of a walking cycle, its orbit computed at both integration steps; NaN where
    `found` is a text, which says why no cycle was found.
    """
    if isinstance(found, str):
        return AtTwoSteps(math.nan, math.nan)
    return AtTwoSteps(of(found.orbit), of(found.half))


def largest_multiplier(found: PoincareResult | str) -> AtTwoSteps:
    """The largest |multiplier| [1] of a cycle, stored first; NaN for a text, the reason why there is none."""
    return of_orbit(lambda orbit: float(abs(orbit.multipliers[0])), found)


def second_multiplier(found: PoincareResult) -> float:
    """The second largest |multiplier| [1] of a cycle, under NPD the largest of the tracking error."""
    return float(np.sort(np.abs(found.orbit.multipliers))[-2])


def off_delta_squared(found: PoincareResult) -> float:
    """||largest multiplier| - delta^2| [1]; delta^2 is its closed form, from the zero dynamics of the gait."""
    return float(abs(abs(found.orbit.multipliers[0]) - found.delta_squared))


def multiplier_change(found: PoincareResult | str) -> float:
    """Largest change [1] of a multiplier's magnitude when the integration step is halved; infinite for a text,
    which says why no cycle was found.
    """
    return math.inf if isinstance(found, str) else found.gap


def phase_rate(x_minus: Array) -> float:
    """Theta' [rad/s] of RABBIT's state (q1..q5, q1'..q5', ...) before an impact: Theta = q5 + q1 + q3 / 2."""
    return float(x_minus[5] + 0.5 * x_minus[7] + x_minus[9])


LEAST_PRINTED = min(PUBLISHED_MULTIPLIERS)
"""The least of the multipliers that section VI prints."""


def speed_error(found: PoincareResult | str) -> AtTwoSteps:
    """|Theta' / Theta'* - 1|: relative difference of Theta' before an impact from that of the paper's x*; NaN
    where no cycle was found.
    """
    printed = phase_rate(X_STAR)
    return of_orbit(lambda orbit: abs(phase_rate(orbit.x_minus) / printed - 1.0), found)


def walked(controller: str, name: str, o: MemberOutcome) -> AtTwoSteps:
    """The field `name` of the `MemberWalk` of a member under one controller, in its unit."""
    return getattr(o.walked[controller], name)


def ratio(name: str, o: MemberOutcome) -> AtTwoSteps:
    """The field `name` of the `MemberWalk` of a member under ADRC over that under NPD [1].

    Of "deviation", the tracking error that the push adds, each is against the same walking step without the
    push; of "peak" both contain the error that is there without a push too.
    """
    return walked("ADRC", name, o).over(walked("NPD", name, o))


def longest(o: MemberOutcome) -> AtTwoSteps:
    """Duration [s] of the longest walking step of both controllers' walks; infinite if one of the walks does
    not make all steps.
    """
    # zip: the values of both at the integration step used, then those at half of it
    return AtTwoSteps(*map(max, zip(*(w.longest for w in o.walked.values()), strict=True)))


def reached(start: SlowStart) -> AtTwoSteps:
    """Share [1] of the impacts asked for that are made, under the controller that makes more of them."""
    # zip: the shares of both at the integration step used, then those at half of it
    return AtTwoSteps(*map(max, zip(*map(share_of_impacts, start.outcomes.values()), strict=True)))


def longest_step(multiplier: float) -> float:
    """Time [s] in which a tracking error, which decays like exp(-K_d t / 2), falls to the share `multiplier`: a
    longer walking step would have a smaller multiplier of the tracking error. K_d [1/s] is that of Table II.
    """
    # max: K_d may be one number, or one for each joint
    return float(-2.0 * np.log(multiplier) / float(np.max(TABLE_II.K_d)))


def period_gap(pair: Pair) -> float:
    """Largest difference of the durations of walking steps under NPD and ADRC, over the duration of an
    undisturbed step [1]; infinite if the two make different numbers of steps. The first two steps are
    undisturbed: the push on the torso acts in the third one.
    """
    npd, adrc = (o.durations for o in pair)
    if len(npd) != len(adrc) or len(npd) == 0:
        return math.inf
    return float(np.max(np.abs(npd - adrc)) / np.median(npd[:2]))


def peak_ratio(pair: Pair) -> float:
    """Ratio [1] of the peak tracking error under ADRC to that under NPD."""
    return pair[1].peak_error / pair[0].peak_error


def change(i: str, j: str, figures: Sequence[float]) -> float:
    """|figures[i] / figures[j] - 1| [1]; figures: the numbers of `physical_laws.numerics_laws` in their order.
    i and j are indices from 0, as text, since they are words of checks.toml.
    """
    return abs(figures[int(i)] / figures[int(j)] - 1.0)


def figure(i: str, figures: Sequence[float]) -> float:
    """|figures[i]|, of the numbers of `physical_laws.numerics_laws` in their order; i: an index, as text."""
    return abs(figures[int(i)])


def adrc_counts(cell: PushCell) -> float:
    """1 if under this push of the map the walk under ADRC makes all steps and is feasible, or would be but for
    the impulses at impact; else 0.
    """
    # COUNTED: feasible, or feasible but for the impulses at impact
    return float(cell.adrc.feasibility.outcome in COUNTED)


def quotient(pair: tuple[float, float]) -> float:
    """The first over the second, of a pair of gains in the same unit [1]."""
    return pair[0] / pair[1]


def periods(found: Mapping[str, float]) -> float:
    """Period of the gait divided by the time in which a tracking error decays, like exp(-K_d t / 2), to the
    least multiplier that the paper prints (`longest_step`) [1]. Above 1 it decays in one walking step to less
    than that multiplier, which then cannot be one of the tracking error. found: {"period": [s], ..}, of
    `runs.jumps`.
    """
    return found["period"] / longest_step(LEAST_PRINTED)


# -- what of a scenario a verdict may depend on ----- ------------------------------------------------
def theta_of(o: MemberOutcome) -> str:
    """How Theta'' enters (20) in this member, in words: verdicts may depend on it, since (20) as printed leaves
    an error under ADRC without any push.
    """
    return {"solved": "Theta'' solved", "printed": "(20) as printed"}[o.member.theta]


# -- scenarios -------------------------------------------------------------------------------------
def headline(r: Runs) -> dict[str, Outcome]:
    """The headline runs by controller: walks of 25 impacts with the push of the user's plan."""
    return dict(zip(CONTROLLERS, r.pair("push"), strict=True))


def adrc_push(r: Runs) -> dict[str, Outcome]:
    """The headline run under ADRC alone, a walk of 25 impacts with the push of the user's plan."""
    return {"ADRC": r.pair("push")[1]}  # of (NPD, ADRC)


def walks(r: Runs) -> dict[str, Outcome]:
    """The walks in which both controllers are compared (pushed, sampled, with a heavier plant), by "controller,
    name of the walk".
    """
    every = r.pairs("").items()  # those whose names begin with "": all
    return {f"{c}, {n}": o for n, pair in every for c, o in zip(CONTROLLERS, pair, strict=True)}


def all_cycles(r: Runs) -> dict[str, PoincareResult | str]:
    """The walking cycles whose multipliers are all computed, of gait (a), and the cycles of gait (b), by name;
    a text says why there is no cycle.
    """
    every = {f"multipliers {name}": x for name, x in r.multipliers.items()}
    return every | r.named("cycles", "(b)")


def laws_of_walks(r: Runs) -> dict[str, Mapping[str, float]]:
    """Law -> violation, as `physical_laws.walk_laws` returns it for a headline run, by controller."""
    return {c: x.laws for c, x in r.headline.items()}


def laws_of_models(r: Runs) -> dict[str, float]:
    """Largest relative violation [1] of each law of the model in each preset, by "preset: law"."""
    laws = next(iter(r.model.values()))
    return {f"{preset}: {law}": x[law] for law in laws for preset, x in r.model.items()}


def numerics(r: Runs) -> dict[str, Sequence[float]]:
    """One scenario with no name: the numbers of `physical_laws.numerics_laws`, all together in their order,
    as the metrics `figure` and `change` take them by index.
    """
    return {"": tuple(r.figures.values())}


def pushed(kind: str, r: Runs) -> dict[str, MemberOutcome]:
    """The walks of all members, by name. kind: the field of `Runs` with them, "members" for all declared
    choices, or "pushed_recipe" for the push on gait (b).
    """
    return {o.member.name: o for part in getattr(r, kind).values() for o in part}


def heavier(r: Runs) -> dict[str, Pair]:
    """The walks (NPD, ADRC) with a plant heavier than the controller's model, by preset and kind of change."""
    result = {}
    # HEAVIER: by name the errors of a plant that is heavier than the model
    for preset, kind in itertools.product(r.plan.presets, HEAVIER):
        # the walks in the plan's own preset have its name left out
        name = f"heavier, {kind}" + ("" if preset == r.plan.preset else f", {preset}")
        result[f"{preset}, heavier {kind}"] = r.pair(name)
    return result


def torso(r: Runs) -> dict[str, Pair]:
    """The walks (NPD, ADRC) with a push on the torso, by "torque on the torso, preset"."""
    every = itertools.product(declared()["torso"]["amplitudes"], r.plan.presets)
    names = (f"{torque:g} N m on the torso, {preset}" for torque, preset in every)
    return {name: r.pair(name) for name in names}


def lost_by_npd(r: Runs) -> dict[str, PushCell]:
    """The pushes of the map under which NPD does not make all steps, by preset, torque limit and push; without
    those under which a walk ends in another way at half of the integration step.
    """
    # LOST: the outcomes of walks that fell or ended before their last impact
    cells = [c for c in r.cells if c.certain and c.npd.feasibility.outcome in LOST]
    return {
        f"{c.setting}, {c.push.amplitude:g} N m, {c.push.pattern}, from {c.push.onset:g} s": c
        for c in cells
    }


def undisturbed(gaits: str, r: Runs) -> dict[str, Outcome]:
    """The undisturbed walks under NPD, by "gait (a), preset"; gaits: "a", "b", or "ab" for both."""
    every = {name: o for gait in gaits for name, o in r.on_gait(gait).items()}
    return {name.removesuffix(", NPD"): o for name, o in every.items() if name.endswith("NPD")}


def both_gaits(r: Runs) -> dict[str, tuple[Outcome, Outcome]]:
    """The undisturbed walks under NPD on (gait (b), gait (a)), in this order, by preset."""
    b, a = (undisturbed(gait, r).values() for gait in "ba")
    return dict(zip(r.plan.presets, zip(b, a, strict=True), strict=True))


def cost_ratio(pair: tuple[Outcome, Outcome]) -> AtTwoSteps:
    """Cost of transport of the first walk over that of the second [1], each in its last walking step."""
    one, other = (last_at_two("cost_of_transport", o) for o in pair)
    return one.over(other)


def below_least(r: Runs) -> dict[str, SlowStart]:
    """The starts with less than the least speed that reaches the next impact, by preset and by their speed
    after the impact as a share of the gait's. factor: speed over the least one.
    """
    return {
        f"{preset}, {s.factor * s.least:.3f} of the gait's speed": s
        for preset, result in r.starts.items()
        for s in result
        if s.factor < 1.0
    }


def gains(r: Runs) -> dict[str, tuple[float, float]]:
    """Gains of two observers, by name: (that of Table I, that of one with m = 1 of the same bandwidth or the
    same delay margin). m is the number of states for the disturbance and its derivatives, 7 in Table I.

    "gain of (17)": the largest |l_k| [1/s^k] by which the observer (17) corrects a state. "gain from
    measurement": the largest over all frequencies from an error of the angle to the commanded acceleration
    [1/s^2].
    """
    result: dict[str, tuple[float, float]] = {}
    for orders in r.orders.values():
        for name in ("equal bandwidth", "equal delay margin"):
            a, b = orders["Table I"], orders[name]
            result[f"gain of (17) at {name}"] = (a.largest_gain, b.largest_gain)
            result[f"gain from measurement at {name}"] = (a.noise_gain, b.noise_gain)
    return result
