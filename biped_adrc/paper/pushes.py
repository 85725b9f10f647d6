"""Pushes on the joints under the paper's controllers, NPD (PD with decoupling of the inertia) and ADRC.

A member is one combination of the choices that the paper leaves open, such as amplitude and onset of the push
(`scenarios.Member`); all members were fixed in a file before any run. What a push does is separated from what
the controller does anyway: the error of the pushed step is compared with that of the same walking step without
a push (`Track.away_from`). The walk starts on the orbit of its gait at the pushed step; peaks are taken of an
interpolant, since the largest error lies between two stored instants ("nodes"). Each number is computed at two
integration steps, the one used and half of it: a share of 1 or 0.5 says at which.

Symbols: q_b the p joints with motors, q_d their references [rad], error = q_b - q_d; Theta the phase of the
gait, Theta' its rate [rad/s]; xi the total disturbance of the joints, xi^ its estimate [rad/s^2].

The map of pushes answers the question of the paper's section VI: in which phase of the step does a push make
which controller fall? It is over onset, amplitude and joint pattern, with and without a torque limit
(`scenarios.MapPush`). Every walk is made at two integration steps; if the two end differently the cell is
marginal, and no verdict on the paper rests on it. The outcomes of a walk:

    feasible    makes all steps within friction, torque limits and without scuffing
    but_impact  the same but for the impact, whose impulse asks for more friction
    pulled      makes all steps; the mean normal force was negative, a real foot would have left the ground
    infeasible  makes all steps, and breaks another limit
    fell        the robot fell
    ended       ended otherwise, such as a step that takes too long
    marginal    another word or status at half of the integration step
"""

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any, NamedTuple, Self

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from biped_adrc.analysis.certificate import IMPULSE
from biped_adrc.analysis.feasibility import Feasibility
from biped_adrc.analysis.half_step import AtTwoSteps
from biped_adrc.analysis.signals import largest
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode
from biped_adrc.core.types import Array
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.paper.scenarios import COARSE, CONTROLLERS, MapPush, Member, by_rk4
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.integration import WalkPart, methods_of, runs_in_parts
from biped_adrc.scenario.recording import Outcome, Walk
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.walk import execute_twice


class Track(NamedTuple):
    """One single support: the tracking error over time, and Theta' before the impact that ends it."""

    t: Array
    """(K,) from the start of the step [s]."""
    error: Array
    """(K, p) [rad]."""
    derror: Array
    """(K, p), its derivative in time [rad/s]."""
    rate: float
    """Theta' before the impact [rad/s], NaN when there is no impact."""

    @property
    def peak(self) -> float:
        """Largest |error|, between the nodes too [rad]."""
        return largest(self.t, self.error, self.derror)

    def away_from(self, usual: Self, onset: float) -> float:
        """max |error - error of `usual`| [rad] from the onset [s] on, while both walking steps last; NaN if
        they have no common time, or the error of `usual` is not finite.

        `usual` is the same step without a push. Its error is smooth, so a cubic Hermite interpolant between its
        stored instants gives it at the times of this one.
        """
        counted = (self.t >= onset) & (self.t <= usual.t[-1])
        t, first = np.unique(usual.t, return_index=True)  # the interpolant takes no time twice
        if not np.any(counted) or not np.all(np.isfinite(usual.error)):
            return float("nan")
        there = CubicHermiteSpline(t, usual.error[first], usual.derror[first])
        # `largest`: the peak of a curve with these values and derivatives; there(at, 1) is the derivative
        at = self.t[counted]
        return largest(at, self.error[counted] - there(at), self.derror[counted] - there(at, 1))


def track(walk: Walk) -> Track:
    """The `Track` of the first single support of a walk: tracking error (K, p) [rad] and its derivative over
    time, and the rate, Theta' [rad/s] before the impact that ends it, NaN unless it ends so.
    """
    # states over the first single support, and the event that ended it
    arc = walk.trajectory.arcs[0]
    s = walk.signals.of_step(arc.mode.step)
    ended = arc.event is not None and arc.event.guard == FOOT_STRIKE
    p, rate = s.error.shape[1], float(s.dtheta[-1]) if ended else float("nan")
    return Track(s.t - s.t[0], s.error, s.v[:, :p] - s.dq_d, rate)


@lru_cache(maxsize=8)
def scene_in(preset: str | None, gait: str) -> RobotAndGait:
    """The robot RABBIT in a preset (a set of masses; a scenario of the reproduction always names one) and one
    of its gaits, read once for many walks."""
    # a scenario needs a controller; which one has no effect on robot and gait
    return RobotAndGait.of(by_rk4("NPD", str(preset), gait=gait))


def in_two(run: Scenario, zero: bool, share: float) -> list[Walk]:
    """Walk the first single support of a run with the integration step share * run.h, and the others, of which
    only the ending matters, with share * COARSE; returns the walk of either part, one if it ends in the first.

    share [1]: 1 or 0.5. zero: whether the observer starts at xi^ = 0 instead of the model's xi.
    """
    scene = scene_in(run.robot.preset, run.gait.name)
    walker, n, gait = build(run, scene), scene.biped.n, scene.walked
    impacts, h = run.run.impacts, run.run.h
    assert h is not None
    mode, adrc = Mode(run.run.first_step), run.controller.name == "ADRC"
    x = walker.initial_state(*gait.start(scene.biped), mode)
    if zero and adrc:
        # the state is q, q' (n each), x1^, x2^ (p each), then x3^ = xi^ and its derivatives, scaled
        x[2 * n + 2 * scene.biped.p :] = 0.0
    later = Exponential(share * COARSE) if adrc else RK4(share * COARSE)
    # [0]: the integration method; [1] would be a finer step where a push switches, as this one is already
    first = methods_of(run.run.replace({"h": share * h}), walker)[0]
    parts = [WalkPart(1, first), WalkPart(impacts - 1, later)]
    # the first part alone for one impact
    runs = runs_in_parts(walker, x, mode, parts[: 1 + (impacts > 1)])
    return [Walk(walker, gait, moved) for moved in runs]


@lru_cache(maxsize=64)
def usual_track(usual: Member, controller: str, share: float) -> Track:
    """The `Track` of the pushed step of a member without its push, computed once for all pushes on it.

    share: of the integration step, 1 or 0.5.
    """
    # start: of the observer, "zero" (xi^ = 0) or "model"; [0]: the walk's first part is its first single
    # support
    return track(in_two(usual.run(controller, pushed=False), usual.start == "zero", share)[0])


class MemberWalk(NamedTuple):
    """The figures of merit of a walk, from the pushed step on."""

    peak: AtTwoSteps
    """max |q_b - q_d| in the pushed step, between the nodes too [rad]."""
    deviation: AtTwoSteps
    """max |error - error of the same step without a push| from the onset of the push on [rad]."""
    rate: AtTwoSteps
    """Difference of Theta' at the end of the pushed step to that of the same step without a push [rad/s];
    infinite without an impact."""
    longest: AtTwoSteps
    """Duration of the longest walking step [s]; infinite if not all steps are made."""
    broken: AtTwoSteps
    """Number of limits of ground and motors that the walk breaks, the impulse at impact aside."""
    infeasible: Mapping[str, str]
    """Sentences on what ground or motors could not have given, by the names in `REASONS`, at the integration
    step used."""


class MemberOutcome(NamedTuple):
    """The walks of a member under both controllers."""

    member: Member
    """The combination of choices."""
    walked: dict[str, MemberWalk]
    """By controller."""


def limits_broken(f: Feasibility) -> float:
    """How many limits of ground and motors a walk breaks, the friction of the impulse at impact not counted;
    infinite where not all steps were made.
    """
    # reasons: a sentence by name of each limit that is broken; IMPULSE is the name of that at impact
    return float(len(set(f.reasons) - {IMPULSE})) if f.status.ok else math.inf


def member_walk(member: Member, controller: str, **values: Any) -> MemberWalk:
    """Walk a member under a controller at both integration steps; values: others of its scenario, by name."""
    # why: of the walk at the integration step used; that at half of it is dropped
    (numbers, why), (at_half, _) = (_at(member, controller, x, values) for x in (1.0, 0.5))
    return MemberWalk._make((*map(AtTwoSteps, numbers, at_half), why))


def _at(
    member: Member, controller: str, share: float, values: Mapping[str, Any]
) -> tuple[tuple[float, ...], Mapping[str, str]]:
    """The numbers of a `MemberWalk` in the order of its fields (peak, deviation, rate, longest, broken), at the
    share (1 or 0.5) of the integration step, and its `infeasible`. values: of the scenario, by name.
    """
    run = member.run(controller, **values)
    # without the push its values have no effect: equal ones let `usual_track` compute each such step once
    usual = member._replace(amplitude=0.0, onset=0.0, joints=("q1",), rise=0.0)
    # "zero": the observer starts with xi^ = 0
    walks = in_two(run, member.start == "zero", share)
    one, other = track(walks[0]), usual_track(usual, controller, share)
    # `walks` are the pushed step and the later ones; complete: all impacts asked for were made
    complete = sum(len(walk.trajectory.events(FOOT_STRIKE)) for walk in walks) == run.run.impacts
    # the sentence of the first walk replaces that of the second
    why = {k: x for walk in reversed(walks) for k, x in walk.feasibility.reasons.items()}
    broken = longest = math.inf
    if complete:
        broken = max(limits_broken(walk.feasibility) for walk in walks)
        longest = max(arc.t[-1] - arc.t[0] for walk in walks for arc in walk.trajectory.arcs)
    gap = abs(one.rate - other.rate)
    rate = math.inf if np.isnan(gap) else gap
    return (one.peak, one.away_from(other, member.onset), rate, longest, broken), why


def member_outcomes(chosen: tuple[Member, ...]) -> list[MemberOutcome]:
    """Walk all of these members under both controllers."""
    return [MemberOutcome(m, {c: member_walk(m, c) for c in CONTROLLERS}) for m in chosen]


# -- the map of pushes ------------------------------------------------------------------------------
OUTCOME_WORDS = ("feasible", "but_impact", "infeasible", "pulled", "fell", "ended", "marginal")
"""Outcomes of a walk of the map, as the head of this module says them; the columns of its table."""
FORCES = ("mean_normal_force", "mean_friction", "impulse_ratio")
"""Fields of `Feasibility` that the summary has for each walk of the map [N, 1, 1]."""
LOST = ("fell", "ended")
"""Outcomes of a walk that did not make its steps."""


def word_of(o: Outcome) -> str:
    """The outcome of a walk of the map, one of `OUTCOME_WORDS`; "marginal" if it ends in another way at half of
    the integration step. An outcome without a `half`, the walk at half the step, cannot be marginal.
    """
    one, half = ((_at_step(x), x.status) for x in (o, o.half or o))
    return one[0] if one == half else "marginal"


def _at_step(o: Outcome) -> str:
    """The outcome of a walk at one integration step; "pulled" in place of "infeasible" where the mean force of
    the ground would have had to pull.
    """
    f = o.feasibility
    # the least mean normal force of the walk [N]; an infinite one is none
    pulls = f.outcome == "infeasible" and -math.inf < f.mean_normal_force <= 0.0
    return "pulled" if pulls else f.outcome


class PushCell(NamedTuple):
    """One push of the map, and the walk under it of each controller, with that at half the step in `half`."""

    push: MapPush
    npd: Outcome
    adrc: Outcome

    @property
    def setting(self) -> str:
        """Text of preset and torque limit, such as "identified, 150 N m"."""
        limit = self.push.torque_limit
        return f"{self.push.preset}, {'unlimited' if limit is None else f'{limit:g} N m'}"

    @property
    def certain(self) -> bool:
        """Whether each controller's walk ends in the same way at half of the integration step."""
        return "marginal" not in map(word_of, (self.npd, self.adrc))

    def row(self) -> dict[str, object]:
        """The push and its walks as plain values, for the figure and the summary.

        The fields of the push, and onset_ms; npd and adrc: outcome, status, reasons and `FORCES` of each walk
        at the integration step used, None for a force that is not finite; npd_word, adrc_word: `word_of`.
        """
        result = self.push._asdict() | {"onset_ms": 1e3 * self.push.onset}
        for name, o in (("npd", self.npd), ("adrc", self.adrc)):
            f = o.feasibility
            numbers = {x: getattr(f, x) for x in FORCES}
            forces = {name: x if math.isfinite(x) else None for name, x in numbers.items()}
            said = {"outcome": f.outcome, "status": o.status, "reasons": list(f.reasons)}
            result |= {name: said | forces, f"{name}_word": word_of(o)}
        return result


def push_map(pushes: Sequence[MapPush]) -> list[PushCell]:
    """Walk both controllers under every push, each at two integration steps."""
    return [PushCell(x, *(execute_twice(x.run(c)) for c in CONTROLLERS)) for x in pushes]
