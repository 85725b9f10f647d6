"""Walks of the claims, reduced to a few numbers, each at the integration step used and at half of it.

What a push does is separated from what the controller does anyway: the error of the pushed step is compared
with that of the same step without a push. Peaks are taken of an interpolant, since the largest error lies
between two nodes. Walks start on the orbit of their gait at the pushed step.

Runs the members of `claims.admissible`; also the parts that `claims.evidence` and `claims.orders` use.

For each member and controller these are simulated: the pushed step at h and h/2, the same without a push
(shared by all pushes on that walk), and four impacts at the longer step for what comes later, at that step and
at half.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from biped_adrc.analysis.feasibility import verdict_of
from biped_adrc.analysis.quadrature import largest
from biped_adrc.analysis.signals import Signals, signals
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.engine.run import simulate_by
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.paper.claims.admissible import Member, declared, step_of
from biped_adrc.paper.claims.tally import AtTwoSteps
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.recording import watched
from biped_adrc.scenario.run import method_of
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.types import Array


class MemberWalk(NamedTuple):
    """What is kept of a walk from the pushed step on."""

    status: str
    """How it ended."""
    impacts: int
    """Impacts made."""
    asked: int
    """Impacts asked for."""
    peak: AtTwoSteps
    """max |q_b - q_d| in the pushed step, between the nodes too [rad]."""
    deviation: AtTwoSteps
    """The same of the error less that of the walk without a push, from the onset on [rad]."""
    rate: AtTwoSteps
    """Theta' at the end of the pushed step less that of the walk without a push [rad/s]."""
    period: AtTwoSteps
    """Of the pushed step [s]."""
    infeasible: Mapping[str, str]
    """What ground or motors could not have given, by the names in `REASONS`, with the step."""
    same: bool = True
    """Whether the walk ends alike at half of the step, feasibility included."""

    @property
    def made(self) -> bool:
        """Whether all steps asked for were made."""
        return self.status == "COMPLETED" and self.impacts == self.asked


@dataclass(frozen=True)
class MemberOutcome:
    """A member of the set under both controllers."""

    member: Member
    """The choices."""
    walked: dict[str, MemberWalk]
    """By controller."""

    @property
    def tracking(self) -> AtTwoSteps:
        """Peak error of ADRC over that of NPD."""
        return quotient(self.walked["ADRC"].peak, self.walked["NPD"].peak)

    @property
    def rejection(self) -> AtTwoSteps:
        """Deviation that the push makes under ADRC over that under NPD."""
        return quotient(self.walked["ADRC"].deviation, self.walked["NPD"].deviation)


def quotient(one: AtTwoSteps, other: AtTwoSteps) -> AtTwoSteps:
    """One over the other at either step; infinite over zero."""
    return AtTwoSteps(*(a / b if b else float("inf") for a, b in zip(one, other, strict=True)))


class Prepared(NamedTuple):
    """A run whose walker is built, to be simulated with different integration steps."""

    run: Scenario
    """Its values."""
    gait: Gait
    """On which it starts."""
    walker: Walker
    """Robot, controller, pushes."""
    x0: Array
    """State after the impact before the first step."""

    def simulate(self, h: float, impacts: int) -> Trajectory:
        """The trajectory with this integration step h [s] and number of impacts."""
        mode = Mode(self.run.run.first_step)
        return simulate_by(
            self.run.run.engine,
            self.walker,
            self.x0,
            mode,
            method_of(self.run.replace(run={"h": h}), self.walker),
            t_end=impacts * self.walker.max_step_time,
            impacts=impacts,
        )


@lru_cache(maxsize=16)
def nominal(preset: str | None, gait: str) -> tuple[Biped, Gait]:
    """RABBIT in a preset and one of its gaits, shared and read-only."""
    scene = RobotAndGait.of(Scenario(robot={"preset": preset}, gait=gait))
    biped, found = scene.biped, scene.walked
    for shared in (found.q_minus, found.v_minus):
        shared.flags.writeable = False
    return biped, found


def prepared(run: Scenario, zero: bool = False, speed: float = 1.0) -> Prepared:
    """The run at the impact of its gait's orbit, ready to be simulated.

    zero: the observer starts at xi^ = 0 instead of the model's xi. speed: factor on the rates after impact,
    which keeps the state on the constraint and takes it off the orbit.
    """
    biped, gait = nominal(run.robot.preset, run.gait.name)
    walker = build(run, RobotAndGait(biped, gait))
    q, v = gait.start(biped)
    x = walker.initial_state(q, speed * v, Mode(run.run.first_step))
    if zero and run.controller.name == "ADRC":
        x[2 * biped.n + 2 * biped.p :] = 0.0  # x3^ and its derivatives in the scaled chain
    return Prepared(run, gait, walker, x)


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
    period: float
    """Of the step [s], NaN when there is no impact."""

    @property
    def peak(self) -> float:
        """Largest |error|, between the nodes too [rad]."""
        return largest(self.t, self.error, self.derror)

    def away_from(self, usual: Track, onset: float) -> float:
        """max |error - that of `usual`| [rad] from the onset [s] on, while both steps last.

        `usual` has no push and is smooth: cubic Hermite interpolants between its nodes. NaN without a common
        time.
        """
        seen = (self.t >= onset) & (self.t <= usual.t[-1])
        t, first = np.unique(usual.t, return_index=True)
        if not np.any(seen) or not np.all(np.isfinite(usual.error)):
            return float("nan")
        there = CubicHermiteSpline(t, usual.error[first], usual.derror[first])
        at = self.t[seen]
        return largest(at, self.error[seen] - there(at), self.derror[seen] - there(at, 1))


def tracks(made: Prepared, walk: Trajectory) -> tuple[Track, ...]:
    """Every single support of a walk."""
    s = signals(made.walker, walk, made.gait.constraint)
    return tuple(_track(s.of_step(arc.mode.step), arc) for arc in walk.arcs)


def _track(s: Signals, arc: Arc) -> Track:
    """One single support, from its signals."""
    struck = arc.event is not None and arc.event.guard == FOOT_STRIKE
    rate, period = (s.dtheta[-1], s.t[-1] - s.t[0]) if struck else (np.nan, np.nan)
    p = s.error.shape[1]
    return Track(s.t - s.t[0], s.error, s.v[:, :p] - s.dq_d, float(rate), float(period))


@lru_cache(maxsize=64)
def _undisturbed(
    preset: str, controller: str, gait: str, start: str, theta: str, h: float
) -> Track:
    """The same walk without a push, computed once for all pushes on it; h [s]."""
    plain = Member(preset, 0.0, 0.0, ("q1",), 0.0, start, theta).run(controller, h)
    made = prepared(plain.replace(pushes=(), gait=gait), start == "zero")
    found = tracks(made, made.simulate(h, 1))[0]
    for shared in (found.t, found.error, found.derror):
        shared.flags.writeable = False
    return found


def walked(run: Scenario, start: str = "model") -> MemberWalk:
    """A run under the push, reduced to numbers.

    The pushed step with run.h and half of it, since its error is a spike of milliseconds; then all impacts
    with the longer step declared for what comes later, of which only ending and feasibility are kept.
    """
    made = prepared(run, start == "zero")
    assert run.run.h is not None
    onset = min(push.onset or 0.0 for push in run.pushes)
    theta = "solved" if run.controller.solve_theta else "printed"
    of = (run.robot.preset, run.controller.name, run.gait.name, start, theta)
    pushed = [tracks(made, made.simulate(share * run.run.h, 1))[0] for share in (1.0, 0.5)]
    usual = [_undisturbed(*of, share * run.run.h) for share in (1.0, 0.5)]
    both = list(zip(pushed, usual, strict=True))
    first, second = (
        _ending(made, share * step_of(run.controller.name, "later")) for share in (1.0, 0.5)
    )
    return MemberWalk(
        *first[:2],
        run.run.impacts,
        AtTwoSteps(*(one.peak for one in pushed)),
        AtTwoSteps(*(one.away_from(other, onset) for one, other in both)),
        AtTwoSteps(*(one.rate - other.rate for one, other in both)),
        AtTwoSteps(*(one.period for one in pushed)),
        first.infeasible,
        first[:2] == second[:2] and verdict_of(first.infeasible) == verdict_of(second.infeasible),
    )


class Ending(NamedTuple):
    """How a walk ends: status, impacts made, and what makes it infeasible."""

    status: str
    impacts: int
    infeasible: Mapping[str, str]


def _ending(made: Prepared, h: float) -> Ending:
    """Of all impacts of a run, with integration steps of h [s]."""
    walk = made.simulate(h, made.run.run.impacts)
    why = {"normal_force": "not finite"}
    if all(bool(np.all(np.isfinite(arc.x))) for arc in walk.arcs):
        why = watched(made.walker, made.gait, walk).feasibility.reasons
    return Ending(walk.status.name, len(walk.events(FOOT_STRIKE)), why)


def tried(member: Member) -> MemberOutcome:
    """Carry a member out under both controllers, each with the integration step declared for it."""
    steps = declared()["steps"]
    runs = {c: member.run(c, steps[c], steps["impacts"]) for c in CONTROLLERS}
    return MemberOutcome(member, {c: walked(run, member.start) for c, run in runs.items()})
