"""Sessions as walks: each walk made again from the record.

    walk, ghost = walks_of(record)

A session in which no value was changed is a walk like any other, with what the hand did as a disturbance
(`disturbances.hand`). Where values were changed it is several stretches, each with a walker of its own. Joined
they keep (q, q') and all signals, but not the states of controllers, which differ in number.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, fields, replace

import numpy as np

from biped_adrc.analysis.signals import Signals
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.disturbances.hand import RecordedHand
from biped_adrc.engine.run import COMPILED, COMPILED_PLANT
from biped_adrc.errors import BipedError, InputError, OutputError
from biped_adrc.hybrid.simulator import FlownArc
from biped_adrc.hybrid.trajectory import Arc, Event, Trajectory
from biped_adrc.live.hand import Hand, check_hand
from biped_adrc.live.hand_table import HandRow
from biped_adrc.live.in_code import MovingCode
from biped_adrc.live.live_walk import LiveWalk
from biped_adrc.live.record import SessionRecord
from biped_adrc.live.session import WALK, Session
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.build import build, soft_loop
from biped_adrc.scenario.recording import Walk, watched
from biped_adrc.scenario.run import method_of
from biped_adrc.soft.walking import as_walked
from biped_adrc.types import Array


@dataclass(frozen=True)
class Stretch:
    """What was walked with one scenario."""

    live: LiveWalk
    """As it began."""
    arcs: list[FlownArc] = field(default_factory=list)
    hands: list[tuple[float, Hand | None]] = field(default_factory=list)
    """What the hand did from these times [s] on."""

    def add(self, hand: Hand | None, flown: Sequence[FlownArc]) -> None:
        """Samples under one hand."""
        if not flown:
            return
        if not self.hands or self.hands[-1][1] != hand:
            self.hands.append((float(flown[0].arc.t[0]), hand))
        self.arcs.extend(flown)


def always() -> bool:
    """Nobody gives it up."""
    return True


def walks_of(record: SessionRecord, going: Callable[[], bool] = always) -> tuple[Walk, ...]:
    """The walk of a session, and that of its ghost.

    going: asked before each sample whether to go on. Raises InputError for a session without a sample, and
    OutputError where it is given up.
    """
    if record.samples < 1:
        raise InputError("nothing has been walked in this session; let it go on for a sample first")
    session = Session.of(record.scenario, record.ghost)
    check_robot(record.hands, session)
    stretches = [[Stretch(live)] for live in session.walking]
    changes, hands = deque(record.changes), dict(record.hands)
    for k in range(record.samples):
        if not going():
            raise OutputError("the session is not saved: it was given up")
        while changes and changes[0].sample == k:
            change = changes.popleft()
            with at_sample(k):
                session.change(change.walk, **change.values)
            stretches[change.walk].append(Stretch(session.walking[change.walk]))
        if k in hands:
            session.hold(hands[k])
        if not session.walks:  # on another processor a walk may end before
            break
        for mine, flown in zip(stretches, session.sample(), strict=True):
            mine[-1].add(session.hand, flown)
    return tuple(joined([walk_of(x) for x in mine if x.arcs]) for mine in stretches)


def check_robot(hands: Sequence[HandRow], session: Session) -> None:
    """Raise InputError, with the sample, for a hand on another robot than the one that walks."""
    moving = session.walking[WALK].moving
    for sample, hand in hands:
        if hand is not None:
            with at_sample(sample):
                check_hand(hand, moving.walker.plant.n)
                moving.points.of(hand.link, hand.at)


@contextmanager
def at_sample(k: int) -> Iterator[None]:
    """While something of a record is done: an error becomes an InputError that names the sample."""
    try:
        yield
    except BipedError as error:
        raise InputError(f"at sample {k} of the session: {error}") from error


def walk_of(stretch: Stretch) -> Walk:
    """A stretch as a walk of its own, with the hand among its disturbances."""
    live = stretch.live
    s, scene, last = live.scenario, live.scene, stretch.arcs[-1]
    walker = build(s, scene)
    label = method_of(s, walker).label
    engine = COMPILED if isinstance(live.moving, MovingCode) else COMPILED_PLANT
    run = Trajectory(
        together(stretch.arcs), last.status, last.detail, {"method": label, "engine": engine}
    )
    if any(hand is not None for _, hand in stretch.hands):
        hand = recorded_hand(walker.plant, stretch.hands)
        both: Disturbance = hand if walker.disturbance is None else walker.disturbance + hand
        walker = replace(walker, disturbance=both)
    if (loop := soft_loop(s, walker)) is not None:
        run = as_walked(loop, replace(run, settings={"method": "steps of the plant's own"}))
    return watched(walker, scene.gait, run, s)


def recorded_hand(plant: Biped, hands: Sequence[tuple[float, Hand | None]]) -> RecordedHand:
    """What a hand did from these times [s] on, as a disturbance."""
    rest = Hand((0.0,) * plant.n, plant.description.trunk)
    times, rows = zip(*((t, hand or rest) for t, hand in hands), strict=True)
    torques, links, points, forces = zip(*rows, strict=True)
    t, tau, F, at = (np.array(x, dtype=float) for x in (times, torques, forces, points))
    return RecordedHand(plant, t, tau, F, links, at)


def together(flown: Sequence[FlownArc]) -> tuple[Arc, ...]:
    """Samples as arcs, one for each single support."""
    arcs, mine = list[Arc](), list[Arc]()
    for k, sample in enumerate(flown):
        mine.append(sample.arc)
        if sample.arc.event is not None or k == len(flown) - 1:
            arcs.append(merged(mine))
            mine = []
    return tuple(arcs)


def merged(arcs: Sequence[Arc]) -> Arc:
    """Pieces of one single support, one after the other."""
    first, last = arcs[0], arcs[-1]
    t, x, dx = (np.concatenate([getattr(a, name) for a in arcs]) for name in ("t", "x", "dx"))
    shared = set.intersection(*(set(a.read) for a in arcs))
    read = {
        name: np.concatenate([a.read[name] for a in arcs]) for name in first.read if name in shared
    }
    return Arc(first.mode, t, x, dx, last.event, read)


def joined(stretches: Sequence[Walk]) -> Walk:
    """Stretches as one walk of (q, q') with the signals of each; a single one as it is."""
    last = stretches[-1]
    if len(stretches) == 1:
        return last
    n = last.walker.plant.n
    arcs = list[Arc]()
    for arc in (arc for walk in stretches for arc in walk.trajectory.arcs):
        short = replace(
            arc, x=arc.x[:, : 2 * n], dx=arc.dx[:, : 2 * n], event=_short(arc, n), read={}
        )
        if arcs and arcs[-1].event is None:
            arcs[-1] = merged((arcs[-1], short))
        else:
            arcs.append(short)
    names = [walk.controller_name for walk in stretches]
    said = (
        f"values were changed on the way: {' -> '.join(names)}; states of controllers are not in it"
    )
    soft = [x.trajectory.settings["plant"] for x in stretches if x.soft]
    settings = last.trajectory.settings | ({"plant": soft[-1]} if soft else {})
    run = replace(last.trajectory, arcs=tuple(arcs), settings=settings)
    walk = watched(last.walker, last.gait, run)
    return replace(walk, recorded=signals_of(stretches), said=(said,))


def _short(arc: Arc, n: int) -> Event | None:
    """The event of an arc with (q, q') alone."""
    event = arc.event
    if event is None:
        return None
    plus = None if event.x_plus is None else event.x_plus[: 2 * n]
    return replace(event, x_minus=event.x_minus[: 2 * n], x_plus=plus)


def signals_of(stretches: Sequence[Walk]) -> Signals:
    """The signals of stretches one after the other, footholds counted from the first."""
    foot, parts = np.zeros(2), list[Signals]()
    for walk in stretches:
        s, plant = walk.signals, walk.walker.plant
        moved = {
            "foothold": s.foothold + foot[0],
            "foothold_height": s.foothold_height + foot[1],
            "potential": s.potential + plant.weight * foot[1],
        }
        parts.append(replace(s, **moved))
        foot = foot + _advance(walk, s)
    values = {f.name: np.concatenate([getattr(s, f.name) for s in parts]) for f in fields(Signals)}
    return Signals(**values)


def _advance(walk: Walk, s: Signals) -> Array:
    """How far the stance foot has come in a walk (x, z) (2,) [m], the impact at its end included."""
    event = walk.trajectory.arcs[-1].event
    foot: Array = np.array([s.foothold[-1] - s.foothold[0], s.foothold_height[-1]])
    if event is None or event.x_plus is None:
        return foot
    return foot + walk.walker.plant.swing_foot(event.x_minus[: walk.walker.plant.n])
