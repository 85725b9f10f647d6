"""Runs and closed forms for all claims beside the push on the joints.

    cycles          multipliers and speed of the walking cycle of both gaits under both controllers
    needs           friction, torque and cost of both gaits, undisturbed
    unmatched       pushes on the torso, which no motor drives
    uncertainty     a plant heavier than the model
    pushed_recipe   a push on gait (b)
    basin           starts just below and above the least speed that reaches the next impact
    jumps           how far the total disturbance is from smooth

Each function takes a preset and returns records whose numbers are at the step used and at half of it. The runs
are declared in admissible.toml. `claims.tasks` joins them to the `Evidence`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.feasibility import verdict_of
from biped_adrc.analysis.regression import regress_multipliers
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.control.tracking import TABLE_II
from biped_adrc.engine.run import COMPILED
from biped_adrc.errors import BipedError
from biped_adrc.gait.recipe import impact_smoothness
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.paper.claims.admissible import Member, declared, step_of
from biped_adrc.paper.claims.tally import AtTwoSteps
from biped_adrc.paper.claims.walks import (
    MemberOutcome,
    nominal,
    prepared,
    tracks,
    tried,
)
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.scenario.push import Push
from biped_adrc.scenario.recording import watched
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.studies.cycle_stability import poincare
from biped_adrc.types import Array, relabelled

GAITS = ("published", "recipe")
"""Gait (a), through x*, and gait (b), by the recipe of section IV."""
TEN = 10
"""Numbers in the state of the paper's robot: five angles, five rates."""


class GaitCycle(NamedTuple):
    """The walking cycle of a gait under a controller; NaN where none was found."""

    name: str
    """For a reader."""
    preset: str
    """Of RABBIT."""
    gait: str
    """One of `GAITS`."""
    controller: str
    """NPD or ADRC."""
    theta: str
    """Theta'' in (20): "solved" or "printed"."""
    multiplier: AtTwoSteps
    """Largest |lambda| by central differences of the return map."""
    rate: AtTwoSteps
    """Theta' before the impact [rad/s]."""
    period: float
    """Of a step of the stored gait [s]."""


def cycles(preset: str) -> tuple[GaitCycle, ...]:
    """Walking cycles of a preset: both gaits under both controllers, and gait (a) with Theta'' as printed.

    The claims on stability rest on their largest multiplier, that on the recipe's speed on Theta'.
    """
    found = [_cycle(preset, gait, c, "solved") for gait in GAITS for c in CONTROLLERS]
    return (*found, *(_cycle(preset, "published", c, "printed") for c in CONTROLLERS))


def _cycle(preset: str, gait: str, controller: str, theta: str) -> GaitCycle:
    """One cycle at both integration steps; a search that fails gives NaN, so that the case does not hold.

    The return map is that of (q, q') alone: the observer's states are no coordinates of it.
    """
    h = declared()["steps"]["plain"]
    run = Scenario(
        {"name": controller, "solve_theta": theta == "solved"}, robot={"preset": preset}, gait=gait
    )
    run = run.replace(run={"engine": COMPILED})
    biped, of = nominal(preset, gait)

    def at(step: float) -> tuple[float, float]:
        try:
            orbit = poincare(run.replace(run={"h": step}), with_states=False).orbit
        except BipedError:
            return float("nan"), float("nan")
        rate = biped.phase @ orbit.x_minus[biped.n : 2 * biped.n]
        return float(abs(orbit.multipliers[0])), float(rate)

    made, rates = zip(at(h), at(0.5 * h), strict=True)
    name = f"gait ({'a' if gait == 'published' else 'b'}), {preset}, {controller}, Theta'' {theta}"
    return GaitCycle(
        name, preset, gait, controller, theta, AtTwoSteps(*made), AtTwoSteps(*rates), of.period
    )


class Needs(NamedTuple):
    """What a gait needs from ground and motors over its cycle, undisturbed."""

    name: str
    """For a reader."""
    preset: str
    """Of RABBIT."""
    gait: str
    """One of `GAITS`."""
    friction: AtTwoSteps
    """Largest |F_T| / F_N of the force averaged over the window of `Limits`."""
    friction_at_an_instant: AtTwoSteps
    """Largest |F_T| / F_N of the force itself."""
    impulse_ratio: AtTwoSteps
    """|F_T| / F_N of the impulse at impact."""
    torque: AtTwoSteps
    """Largest torque [N m]."""
    cost: AtTwoSteps
    """Cost of transport, without unit."""
    work: AtTwoSteps
    """Net joint work per step length [J/m]."""
    rate_jump: float
    """Largest difference of a joint's rate from its reference after the impact [rad/s]; 0 for an invariant
    gait.
    """
    infeasible: Mapping[str, str]
    """Which limits of ground and motors it breaks, in words, by the names in `REASONS`."""
    normal: AtTwoSteps
    """Least F_N averaged over the window [N]."""
    same: bool = True
    """Whether it is feasible at both steps, or at neither."""


def needs(preset: str) -> tuple[Needs, ...]:
    """Of both gaits under NPD."""
    return tuple(_needs(preset, gait) for gait in GAITS)


def _needs(preset: str, gait: str) -> Needs:
    """What the second step of an undisturbed walk needs, at both integration steps."""
    h = declared()["steps"]["needs"]
    run = Scenario("NPD", robot={"preset": preset}, gait=gait, run={"engine": COMPILED})
    made = prepared(run)
    walks = (made.simulate(step, 2) for step in (h, 0.5 * h))
    steps = [watched(made.walker, made.gait, walk).certificates[-1] for walk in walks]
    why, at_half = (one.infeasible() for one in steps)
    biped = nominal(preset, gait)[0]

    def figure(name: str) -> AtTwoSteps:
        return AtTwoSteps(*(float(getattr(one, name)) for one in steps))

    return Needs(
        f"gait ({'a' if gait == 'published' else 'b'}), {preset}",
        preset,
        gait,
        figure("mean_friction"),
        figure("friction"),
        figure("impulse_ratio"),
        figure("peak_torque"),
        figure("cost_of_transport"),
        AtTwoSteps(*(one.joint_work / one.step_length for one in steps)),
        float(np.max(np.abs(impact_smoothness(made.gait, biped)))),
        at_half,
        figure("mean_normal_force"),
        verdict_of(why) == verdict_of(at_half),
    )


class Pair(NamedTuple):
    """Two walks that differ in the controller alone."""

    name: str
    """For a reader."""
    peak: dict[str, AtTwoSteps]
    """By controller: max |q_b - q_d| over all steps [rad], between the nodes too."""
    delay: dict[str, AtTwoSteps]
    """By controller: largest change of a step's time against that of the gait [s]; NaN where a step
    never ends.
    """
    made: dict[str, bool]
    """By controller: whether all impacts were made at both integration steps."""
    same: bool = True
    """Whether both walks make as many impacts at half of the step."""


def _pair(name: str, runs: dict[str, Scenario]) -> Pair:
    """Two walks under both controllers at both integration steps, reduced to errors, delays and impacts."""
    peak, delay = {}, {}
    made: dict[str, bool] = {}
    same = True
    for c, run in runs.items():
        ready, h = prepared(run), step_of(c, "plain")
        walks = [ready.simulate(step, run.run.impacts) for step in (h, 0.5 * h)]
        found = [tracks(ready, walk) for walk in walks]
        # NumPy's, since max passes over the NaN of a step that never ends
        peak[c] = AtTwoSteps(*(float(np.max([t.peak for t in at])) for at in found))
        late = ([abs(t.period - ready.gait.period) for t in at] for at in found)
        delay[c] = AtTwoSteps(*(float(np.max(at)) for at in late))
        impacts = [len(walk.events(FOOT_STRIKE)) for walk in walks]
        made[c], same = min(impacts) == run.run.impacts, same and impacts[0] == impacts[1]
    return Pair(name, peak, delay, made, same)


def _both(run: Scenario) -> dict[str, Scenario]:
    """The run under NPD and under ADRC, on the compiled engine."""
    return {
        c: run.replace(controller=c, run={"method": "rk4", "engine": COMPILED}) for c in CONTROLLERS
    }


def unmatched(preset: str) -> tuple[Pair, ...]:
    """Pushes on the torso for 0.2 s by amplitude; the last one is chosen large enough to stop a walk.

    No controller of the joints can cancel them: they change Theta'' itself, and with it the time of the step.
    """
    k, step = declared()["unmatched"], declared()["push"]["step"]
    found = []
    for torque in (*k["amplitudes"], k["fatal"]):
        push = Push(joints="q5", torque=torque, step=step, onset=0.1, duration=0.2)
        runs = _both(
            Scenario(
                robot={"preset": preset}, pushes=(push,), run={"first_step": step, "impacts": 4}
            )
        )
        found.append(_pair(f"{preset}, {torque:g} N m on the torso", runs))
    return tuple(found)


def uncertainty(preset: str) -> tuple[Pair, ...]:
    """A plant heavier than the controller's model: in its masses, and in masses and inertias."""
    k = dict(declared()["uncertainty"])
    impacts = k.pop("impacts")
    return tuple(
        _pair(
            f"{preset}, heavier {kind}",
            _both(Scenario(robot={"preset": preset}, run={"impacts": impacts}, errors=factors)),
        )
        for kind, factors in k.items()
    )


def pushed_recipe(preset: str) -> tuple[MemberOutcome, ...]:
    """Gait (b) under a push on the joints."""
    k = declared()["disturbed_recipe"]
    joints, usual = tuple(declared()["factors"]["joints"][0]), ("model", "solved", "recipe")
    return (tried(Member(preset, k["amplitude"], k["onset"], joints, 0.0, *usual)),)


class Start(NamedTuple):
    """A walk that starts with a chosen speed after the impact."""

    name: str
    """For a reader."""
    least: float
    """The speed that just reaches the next impact, relative to the gait's, from one quadrature of the zero
    dynamics.
    """
    factor: float
    """Speed of this start relative to the least."""
    impacts: dict[str, int]
    """By controller: impacts made."""
    asked: int
    """Impacts asked for."""
    same: bool = True
    """Whether as many impacts are made at half of the step."""


def basin(preset: str) -> tuple[Start, ...]:
    """Starts on the constraint just below and just above the least speed that reaches the next impact.

    The least speed comes from the zero dynamics in closed form; the walks show whether it is the boundary. It
    matters for the paper's promise of global stability: no controller of the joints helps a start below it.
    """
    k = declared()["basin"]
    runs = _both(Scenario(robot={"preset": preset}))
    least = least_speed(runs["NPD"])
    found = []
    for factor in k["factors"]:
        made, half = (
            {
                c: _strikes(run, factor * least, share * step_of(c, "plain"), k["impacts"])
                for c, run in runs.items()
            }
            for share in (1.0, 0.5)
        )
        name = f"{preset}, {factor * least:.3f} of the gait's speed after impact"
        found.append(Start(name, least, factor, made, k["impacts"], made == half))
    return tuple(found)


def _strikes(run: Scenario, speed: float, h: float, impacts: int) -> int:
    """Impacts made from a start with `speed` times the gait's rates; h [s]."""
    return len(prepared(run, speed=speed).simulate(h, impacts).events(FOOT_STRIKE))


def least_speed(run: Scenario) -> float:
    """Share of the gait's speed after impact with which sigma^2 stays positive up to the next impact.

    sigma is the angular momentum about the stance foot. On the zero dynamics sigma^2(Theta) is its initial
    value plus a function of Theta, whose minimum (of a parabola through three nodes) decides whether the robot
    passes mid-stance.
    """
    biped, gait = nominal(run.robot.preset, run.gait.name)
    zero = ZeroDynamics.of(biped, gait.constraint, nodes=120)
    sigma = biped.angular_momentum(*gait.start(biped))
    gained = zero.sigma_squared(0.0)
    k = min(max(int(np.argmin(gained)), 1), len(gained) - 2)
    near = np.polyfit(zero.theta[k - 1 : k + 2] - zero.theta[k], gained[k - 1 : k + 2], 2)
    lowest = float(near[2] - near[1] ** 2 / (4.0 * near[0]))  # of the parabola through three nodes
    return float(np.sqrt(max(-lowest, 0.0)) / abs(sigma))


class Jumps(NamedTuple):
    """Jumps of the total disturbance xi of (13), largest over the joints [rad/s^2].

    Both are differences of closed forms at one state, so that there is no step to halve.
    """

    name: str
    """The preset."""
    at_impact: float
    """Between the states before and after the impact of gait (a)."""
    at_edge: float
    """At the edge of a push of 30 N m on all joints."""


def jumps(preset: str) -> tuple[Jumps, ...]:
    """How far xi, the total disturbance of (13), is from smooth on gait (a).

    The observer models xi as a polynomial in time; at an impact and at the edge of a push it is none.
    """
    run = Scenario("NPD", robot={"preset": preset})
    biped, gait = nominal(run.robot.preset, run.gait.name)
    before = biped.reduction(gait.q_minus, gait.v_minus)
    after = biped.reduction(*gait.start(biped))
    edge = after.kappa @ np.full(biped.p, 30.0)
    jump = float(np.max(np.abs(after.xi - relabelled(before.xi, biped.swap))))
    return (Jumps(preset, jump, float(np.max(np.abs(edge)))),)


def fastest_decay(period: float) -> float:
    """What is left of a tracking error after a step under Table II: exp(-K_d T / 2). period T [s]."""
    return float(np.exp(-0.5 * float(np.max(TABLE_II.K_d)) * period))


def longest_step(multiplier: float) -> float:
    """Period [s] in which a tracking error under Table II decays to `multiplier`; the inverse of
    `fastest_decay`.
    """
    return float(-2.0 * np.log(multiplier) / float(np.max(TABLE_II.K_d)))


def noise_spectrum() -> Array:
    """What the regression (26), (27) makes of noise: medians of the sorted |lambda|, (10,), of random numbers.

    The states at impacts are replaced by independent normal numbers, which have no dynamics at all: a spectrum
    that the regression gives for them says nothing of a walk.
    """
    k = declared()["noise"]
    random = np.random.default_rng(k["seed"])
    found = [
        regress_multipliers(random.normal(size=(k["impacts"], TEN)), np.zeros(TEN)).magnitudes
        for _ in range(k["draws"])
    ]
    return np.median(found, axis=0)
