"""Walks for the claims: what is kept of them is a handful of numbers, at a step and at half of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from biped_adrc.analysis.quadrature import largest
from biped_adrc.analysis.signals import Signals, signals
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode, Walker
from biped_adrc.engine.run import simulate_by
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid.trajectory import Arc, Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.paper.claims.admissible import Member, declared
from biped_adrc.paper.claims.tally import Figure
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.recording import watched
from biped_adrc.scenario.run import method_of
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.types import Array


class Walked(NamedTuple):
    """What is left of a walk from the pushed step on."""

    status: str
    impacts: int
    asked: int
    peak: Figure
    """max |q_b - q_d| in the pushed step, between the nodes too [rad]."""
    deviation: Figure
    """The same of the error less that of the walk without a push, from the onset on [rad]."""
    rate: Figure
    """Theta' at the end of the pushed step less that of the walk without a push [rad/s]."""
    period: Figure
    """Of the pushed step [s]."""
    illegal: tuple[str, ...]
    """What the ground or the motors could not have given, by step."""
    same: bool = True
    """Whether the walk ends alike, and is legal or not alike, at half of the step."""

    @property
    def made(self) -> bool:
        """Whether all steps asked for were made."""
        return self.status == "COMPLETED" and self.impacts == self.asked


@dataclass(frozen=True)
class MemberOutcome:
    """A member of the set under both controllers."""

    member: Member
    walked: dict[str, Walked]

    @property
    def tracking(self) -> Figure:
        """Peak error of ADRC over NPD's."""
        return quotient(self.walked["ADRC"].peak, self.walked["NPD"].peak)

    @property
    def rejection(self) -> Figure:
        """Deviation that the push makes under ADRC over that under NPD."""
        return quotient(self.walked["ADRC"].deviation, self.walked["NPD"].deviation)


def quotient(one: Figure, other: Figure) -> Figure:
    """One over the other at either step; infinite over zero."""
    return Figure(*(a / b if b else float("inf") for a, b in zip(one, other, strict=True)))


class Prepared(NamedTuple):
    """A run, ready to be integrated with one step or another."""

    run: Scenario
    gait: Gait
    walker: Walker
    x0: Array

    def simulate(self, h: float, impacts: int) -> Trajectory:
        """From the gait's orbit on."""
        mode = Mode(self.run.first_step)
        return simulate_by(
            self.run.engine,
            self.walker,
            self.x0,
            mode,
            method_of(replace(self.run, h=h), self.walker),
            t_end=impacts * self.walker.max_step_time,
            impacts=impacts,
        )


@lru_cache(maxsize=16)
def nominal(preset: str | None, gait: str) -> tuple[Biped, Gait]:
    """RABBIT in a preset and one of its gaits."""
    scene = RobotAndGait.of(Scenario(preset=preset, gait=gait))
    biped, found = scene.biped, scene.walked
    for shared in (found.q_minus, found.v_minus):
        shared.flags.writeable = False
    return biped, found


def prepared(run: Scenario, zero: bool = False, speed: float = 1.0) -> Prepared:
    """At the impact of the gait's orbit; with `zero` the observer starts at xi^ = 0.

    speed: factor on the rates after impact, which leaves the gait's orbit along its constraint.
    """
    biped, gait = nominal(run.preset, run.gait)
    walker = build(run, RobotAndGait(biped, gait))
    q, v = gait.start(biped)
    x = walker.initial_state(q, speed * v, Mode(run.first_step))
    if zero and run.controller == "ADRC":
        x[2 * biped.n + 2 * biped.p :] = 0.0  # x3^ and its derivatives in the scaled chain
    return Prepared(run, gait, walker, x)


class Track(NamedTuple):
    """The error over time in a single support, and Theta' before the impact that ends it."""

    t: Array
    error: Array
    """(K, p) [rad]."""
    derror: Array
    """(K, p) its derivative in time [rad/s]."""
    rate: float
    """[rad/s], NaN when there is no impact."""
    period: float
    """[s], NaN when there is no impact."""

    @property
    def peak(self) -> float:
        """Between the nodes too [rad]."""
        return largest(self.t, self.error, self.derror)

    def away_from(self, usual: Track, onset: float) -> float:
        """max |error - that of `usual`| from the onset on, while both last [rad].

        `usual` is smooth: cubics between its nodes. NaN when there is nothing to compare.
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
    struck = arc.event is not None and arc.event.guard == FOOT_STRIKE
    rate, period = (s.dtheta[-1], s.t[-1] - s.t[0]) if struck else (np.nan, np.nan)
    p = s.error.shape[1]
    return Track(s.t - s.t[0], s.error, s.v[:, :p] - s.dq_d, float(rate), float(period))


@lru_cache(maxsize=64)
def _undisturbed(
    preset: str, controller: str, gait: str, start: str, theta: str, h: float
) -> Track:
    """The same walk without a push, its error at nodes for cubics between them."""
    plain = Member(preset, 0.0, 0.0, ("q1",), 0.0, start, theta).run(controller, h)
    made = prepared(replace(plain, pushes=(), gait=gait), start == "zero")
    found = tracks(made, made.simulate(h, 1))[0]
    for shared in (found.t, found.error, found.derror):
        shared.flags.writeable = False
    return found


def walked(run: Scenario, start: str = "model") -> Walked:
    """The pushed step with run.h and half of it, and all impacts with the step for what comes later."""
    steps = declared()["steps"]
    made = prepared(run, start == "zero")
    assert run.h is not None
    onset = min(push.start for push in run.pushes)
    theta = "solved" if run.solve_theta else "printed"
    of = (run.preset, run.controller, run.gait, start, theta)
    pushed = [tracks(made, made.simulate(share * run.h, 1))[0] for share in (1.0, 0.5)]
    usual = [_undisturbed(*of, share * run.h) for share in (1.0, 0.5)]
    both = list(zip(pushed, usual, strict=True))
    first, second = (_ending(made, share * steps["later"]) for share in (1.0, 0.5))
    return Walked(
        *first[:2],
        run.impacts,
        Figure(*(one.peak for one in pushed)),
        Figure(*(one.away_from(other, onset) for one, other in both)),
        Figure(*(one.rate - other.rate for one, other in both)),
        Figure(*(one.period for one in pushed)),
        first.illegal,
        first[:2] == second[:2] and bool(first.illegal) == bool(second.illegal),
    )


class Ending(NamedTuple):
    """How a walk ends."""

    status: str
    impacts: int
    illegal: tuple[str, ...]


def _ending(made: Prepared, h: float) -> Ending:
    """Of all impacts of a run, with steps of h."""
    walk = made.simulate(h, made.run.impacts)
    why: tuple[str, ...] = ("not finite",)
    if all(bool(np.all(np.isfinite(arc.x))) for arc in walk.arcs):
        why = tuple(watched(made.walker, made.gait, walk).legality.reasons.values())
    return Ending(walk.status.name, len(walk.events(FOOT_STRIKE)), why)


def tried(member: Member) -> MemberOutcome:
    """Carry a member out under both controllers."""
    steps = declared()["steps"]
    runs = {c: member.run(c, steps[c], steps["impacts"]) for c in CONTROLLERS}
    return MemberOutcome(member, {c: walked(run, member.start) for c, run in runs.items()})


def tried_all(members: tuple[Member, ...]) -> tuple[MemberOutcome, ...]:
    """Carry out a part of the set."""
    return tuple(tried(member) for member in members)
