"""A session: a walk that is moved on by hand, with a ghost beside it, and a record of all that was done.

    session = ba.Session(ba.Scenario("ADRC", hardware="ideal"))
    session.advance(1.0)                           # one second
    session.push({"q1": 30.0}, seconds=0.2)        # a torque of 30 N m on q1
    session.change(controller="NPD")               # from the next sample on
    session.advance(0.5)
    session.back()                                 # to where the last single support began
    session.save("me.npz")                         # a run, with the record inside
    session.save("me.toml")                        # the scenario with its inputs, to read

Inputs change at sample instants alone. Saved is the walk that is there: what was taken back is not in it.

The ghost is another walk with a scenario of its own. It is moved on as far as the walk, by its own samples,
under the same forces and torques; where the walk has ended, the ghost leads.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple, Self

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.hybrid.simulator import FlownArc
from biped_adrc.live.hand import Hand, Spring, check_hand, check_point
from biped_adrc.live.hand_table import HandRow
from biped_adrc.live.live_walk import OF_CONTROLLER, LiveWalk, check_changing, revised
from biped_adrc.live.record import Change, SessionRecord
from biped_adrc.parts import check_part
from biped_adrc.robots.symmetry import twins
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.scenario import DEFAULTS, HARDWARE, Scenario
from biped_adrc.types import Array

WALK, GHOST = 0, 1
"""The walks of a session."""
FARTHEST = 1e6
"""Largest distance of the anchor of a spring from the origin [m]: more than a session walks."""


class Mark(NamedTuple):
    """A session at one sample, to go back to."""

    samples: int
    walking: tuple[LiveWalk, ...]
    hand: Hand | None
    changes: int
    """How many there were."""
    hands: int
    """How many rows of the hand there were."""
    last: HandRow | None
    """The last of these rows."""


class Session:
    """A walk under one's own hand. Raises InputError for a scenario that cannot walk live.

    scenario: in sampled time, such as hardware = "ideal". ghost: values by which the ghost differs, such as
    {"controller": "NPD"}; None for no ghost.
    """

    def __init__(self, scenario: Scenario, ghost: Mapping[str, object] | None = None):
        check_part(scenario, "what is to walk live", Scenario)
        if not isinstance(ghost, Mapping | None):
            raise InputError(
                f'the ghost is {ghost!r:.60}, expected values by name, such as {{"controller": "NPD"}}'
            )
        self._begin(scenario, None if ghost is None else revised(scenario, ghost))

    @classmethod
    def of(cls, scenario: Scenario, ghost: Scenario | None) -> Self:
        """A session of two scenarios."""
        made = cls.__new__(cls)
        made._begin(scenario, ghost)
        return made

    def _begin(self, scenario: Scenario, ghost: Scenario | None) -> None:
        """At the first sample, with nothing done yet. Where a walk cannot begin, all is as it was."""
        self.walking = [LiveWalk.begun(s) for s in (scenario, ghost) if s is not None]
        self.given = scenario, ghost
        self.samples, self.changes, self.hands = 0, list[Change](), list[HandRow]()
        self.hand: Hand | None = None
        self.marks = [self._mark()]
        self.spring: Spring | None = None
        self.ends = math.inf

    def __repr__(self) -> str:
        names = " and ".join(live.scenario.controller for live in self.walking)
        return f"Session({names}, {self.samples} samples, {self.t:.4g} s)"

    # -- where it is -------------------------------------------------------------------------------
    @property
    def record(self) -> SessionRecord:
        """What was done so far."""
        return SessionRecord(*self.given, tuple(self.changes), tuple(self.hands), self.samples)

    @property
    def leader(self) -> LiveWalk:
        """The walk that counts the samples: the first that has not ended, or the walk itself."""
        return next((live for live in self.walking if live.walks), self.walking[WALK])

    @property
    def t(self) -> float:
        """Time [s]."""
        return self.leader.now.t

    @property
    def walks(self) -> bool:
        """Whether any of the walks goes on."""
        return any(live.walks for live in self.walking)

    # -- moving on ---------------------------------------------------------------------------------
    def sample(self) -> list[list[FlownArc]]:
        """One sample on; the nodes of each walk. Nothing where all walks have ended."""
        nodes: list[list[FlownArc]] = [[] for _ in self.walking]
        if not self.walks:
            return nodes
        self._act()
        first = self.walking.index(self.leader)
        self._sampled(first, nodes)
        until = self.walking[first].now.t
        for k, live in enumerate(self.walking):
            while k != first and live.walks and live.now.t < until:
                live = self._sampled(k, nodes)
        self.samples += 1
        return nodes

    def _sampled(self, k: int, nodes: list[list[FlownArc]]) -> LiveWalk:
        """Walk k one sample on, under the hand that acts now."""
        before = self.walking[k]
        after, flown = before.sampled(self.hand)
        self.walking[k] = after
        nodes[k].append(flown)
        if flown.outcome is not None and k == WALK:
            self._touched_down()
        return after

    def _touched_down(self) -> None:
        """The links have changed their names: the spring stays at the same metal."""
        plant = self.walking[WALK].moving.walker.plant
        if self.spring is not None:
            d = plant.description
            other = twins(plant.tree, (d.stance_foot, d.swing_foot))
            self.spring = self.spring._replace(link=other.get(self.spring.link, self.spring.link))

    def advance(self, seconds: float) -> bool:
        """On by so many seconds of the walk's time; whether it still walks."""
        if not (math.isfinite(seconds) and seconds >= 0.0):
            raise InputError(f"the session is to go on for {seconds} s, expected 0 s or more")
        until = self.t + seconds - 1e-9  # a sample instant there is enough
        while self.walks and self.t < until:
            self.sample()
        return self.walks

    def _act(self) -> None:
        """The hand for the coming sample: what has run out is let go, and a spring is looked at anew."""
        hand = self.hand
        if self.walking[WALK].now.mode.step != self.marks[-1].walking[WALK].now.mode.step:
            self.marks.append(self._mark())
        if self.samples >= self.ends:
            hand, self.ends = None, math.inf
        if self.spring is not None:
            hand = self._pulled(self.spring) if self.walking[WALK].walks else None
        self.hold(hand)

    def _mark(self) -> Mark:
        """Where the session is, to go back to."""
        rows = len(self.hands)
        last = self.hands[-1] if rows else None
        return Mark(self.samples, (*self.walking,), self.hand, len(self.changes), rows, last)

    def hold(self, hand: Hand | None) -> None:
        """What acts from the coming sample on, as it is; noted where it is something else than before."""
        if hand is not None and hand.idle:
            hand = None
        if hand == self.hand:
            return
        self.hand = hand
        if self.hands and self.hands[-1].sample == self.samples:
            self.hands.pop()
        self.hands.append(HandRow(self.samples, hand))

    # -- the hand ----------------------------------------------------------------------------------
    def push(
        self,
        torque: Mapping[str, float] | None = None,
        force: tuple[float, float] = (0.0, 0.0),
        link: str | None = None,
        at: tuple[float, float] = (0.0, 0.0),
        seconds: float = 0.2,
    ) -> None:
        """Torques [N m] by coordinate, and a force (F_x, F_z) [N] at a point (x, z) [m] of a link, for so long.

        From the coming sample on, in place of what the hand did before. link: the trunk without. seconds are
        made whole samples of the leading walk's clock; infinite until `let_go`. Raises InputError and
        ModelError for what is no push of this robot.
        """
        moving = self.walking[WALK].moving
        plant = moving.walker.plant
        if not seconds > 0.0:
            raise InputError(f"the push lasts {seconds} s, expected a positive time")
        torques = np.zeros(plant.n)
        for joint, value in (torque or {}).items():
            torques[plant.description.joint_index(joint)] += value
        x, z = force
        trunk = plant.description.trunk
        hand = Hand(tuple(torques.tolist()), link or trunk, at, (float(x), float(z)))
        check_hand(hand, plant.n)
        moving.points.of(hand.link, hand.at)
        self.let_go()
        self.hold(hand)
        lasting = seconds / self.leader.moving.timing.period
        self.ends = self.samples + (max(1, round(lasting)) if lasting < 1e9 else math.inf)

    def pull(self, link: str, at: tuple[float, float], anchor: tuple[float, float]) -> None:
        """Pull a point (x, z) [m] of a link by a `hand.Spring` to the anchor (x, z) [m] in the world.

        Until `let_go`; called again it moves the anchor. The ghost gets the force that the walk gets. Raises
        InputError and ModelError.
        """
        check_point(at)
        if not math.hypot(*anchor) <= FARTHEST:
            raise InputError(
                f"the anchor of the spring is at {anchor} m, expected two numbers within {FARTHEST:g} m"
            )
        self.walking[WALK].moving.points.of(link, at)
        self.spring, self.ends = Spring(link, at, anchor), math.inf

    def let_go(self) -> None:
        """Nothing acts from the coming sample on."""
        self.spring, self.ends = None, math.inf
        self.hold(None)

    def _pulled(self, spring: Spring) -> Hand:
        """The hand of a spring where the walk is now."""
        live = self.walking[WALK]
        p, rate = live.moving.points.place(spring.link, spring.at, live.q, live.v)
        force = spring.force(p + live.foot, rate)
        return Hand((0.0,) * len(live.q), spring.link, spring.at, force)

    def pulled(self) -> tuple[Array, Array] | None:
        """Where the spring is at the robot (2,) [m] in the world, and its force (2,) [N]; None without one."""
        if self.spring is None:
            return None
        live, hand = self.walking[WALK], self._pulled(self.spring)
        p, _ = live.moving.points.place(hand.link, hand.at, live.q, live.v)
        return p + live.foot, np.array(hand.force)

    # -- other values, and other times -------------------------------------------------------------
    def change(self, walk: int = WALK, /, **values: object) -> None:
        """Other values of a walk's scenario from the coming sample on, by name; see `live.live_walk`.

        walk: 0, or 1 for the ghost. Raises InputError for values that are none, or cannot change; then all
        is as it was.
        """
        if walk not in range(len(self.walking)):
            raise InputError(
                f"walk {walk} is changed, and there are {len(self.walking)}, from 0 on"
            )
        self._put(walk, self.walking[walk].changed(values))

    def _put(self, walk: int, after: LiveWalk) -> None:
        """A walk with other values from the coming sample on; noted where they are other ones."""
        before = self.walking[walk]
        if after is before:
            return
        self.walking[walk] = after
        values = differing(before.scenario, after.scenario)
        self.changes.append(Change(self.samples, walk, values))

    def back(self) -> None:
        """To where the present single support of the walk began, or the one before if it has just begun.

        What was done since is forgotten, but the scenarios stay as they are now. The hand lets go. Raises
        InputError where they cannot walk on from there; then all is as it was.
        """
        before = [k for k, mark in enumerate(self.marks) if mark.samples < self.samples]
        last = before[-1] if before else 0
        mark = self.marks[last]
        now = [
            live.changed(differing(live.scenario, other.scenario))
            for live, other in zip(mark.walking, self.walking, strict=True)
        ]
        del self.marks[last + 1 :]
        self.samples, self.walking, self.hand = mark.samples, [*mark.walking], mark.hand
        del self.changes[mark.changes :], self.hands[mark.hands :]
        if mark.last is not None:  # a row of the same sample may have taken its place
            self.hands[-1] = mark.last
        self.let_go()
        for k, live in enumerate(now):
            self._put(k, live)

    def reset(self, /, **values: object) -> None:
        """To the start, with the scenarios as they are now; the record begins anew.

        values: other ones of the walk's scenario, by name. Raises InputError for values that are none, or
        cannot change, and where the walks cannot begin there; then all is as it was.
        """
        check_changing(values)
        scenario, *ghost = [live.scenario for live in self.walking]
        self._begin(revised(scenario, values), ghost[0] if ghost else None)

    # -- what is kept of it ------------------------------------------------------------------------
    def walk(self, which: int = WALK) -> Walk:
        """What was walked so far, as one walk: made again from the record, bit for bit."""
        from biped_adrc.live.stored import walks_of

        return walks_of(self.record)[which]

    def save(self, path: Path | str) -> Path:
        """Write the walk with its ghost and the record (.npz), or the scenario with its inputs (.toml).

        Returns the path. `ba.replay_session` and `biped-adrc simulate` walk both again; `ba.load_walk`,
        `plot` and `animate` read the .npz as any run. Raises InputError and OutputError.
        """
        from biped_adrc.live.repeated import save_session

        return save_session(self.record, path)


def differing(before: Scenario, after: Scenario) -> dict[str, Any]:
    """The values that a scenario has and the one before had not, by name, as JSON has them.

    With another controller those of its observer too, which would be forgotten otherwise (`live_walk.revised`).
    """
    usual = {**DEFAULTS, **HARDWARE[after.hardware]}
    names = {x for x in DEFAULTS if getattr(before, x) != getattr(after, x)}
    if "controller" in names:
        names |= set(OF_CONTROLLER)
    record = after.record()
    return {x: record.get(x, usual[x]) for x in sorted(names)}
