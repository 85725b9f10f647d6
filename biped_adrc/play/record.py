"""What was done in a session, in plain values: enough to do it again, bit for bit.

    scenario, ghost     the walks as they began
    changes             (sample, walk, values): other values of a scenario from that sample on
    hands               (sample, Hand): what acts from that sample on
    samples             how many there were

Samples are counted from 0 over the whole session; one is a step of the clock of the walk that leads.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from biped_adrc.errors import InputError
from biped_adrc.play.hand import Hand
from biped_adrc.scenario.scenario import Scenario

VERSION = 1
"""Of the layout of a record."""


class Change(NamedTuple):
    """Other values of a scenario."""

    sample: int
    """From which on."""
    walk: int
    """0 for the walk, 1 for its ghost."""
    values: dict[str, Any]
    """By name."""


class HandRow(NamedTuple):
    """What the hand does from a sample on."""

    sample: int
    hand: Hand | None
    """None: nothing."""


@dataclass(frozen=True)
class SessionRecord:
    """A session in plain values; see the module."""

    scenario: Scenario
    ghost: Scenario | None = None
    changes: tuple[Change, ...] = ()
    hands: tuple[HandRow, ...] = ()
    samples: int = 0

    def plain(self) -> dict[str, object]:
        """As JSON has it."""
        return {
            "version": VERSION,
            "scenario": told(self.scenario),
            "ghost": None if self.ghost is None else told(self.ghost),
            "changes": [[*change] for change in self.changes],
            "hands": [[x.sample, None if x.hand is None else [*x.hand]] for x in self.hands],
            "samples": self.samples,
        }

    @classmethod
    def of(cls, plain: Mapping[str, Any]) -> SessionRecord:
        """From what JSON had. Raises InputError for what is no record of a session."""
        try:
            if plain["version"] != VERSION:
                raise InputError(
                    f"the session is of layout {plain['version']!r:.20}, expected {VERSION}"
                )
            ghost = plain["ghost"]
            return cls(
                Scenario(**plain["scenario"]),
                None if ghost is None else Scenario(**ghost),
                tuple(Change(int(k), int(walk), dict(x)) for k, walk, x in plain["changes"]),
                tuple(HandRow(int(k), None if x is None else _hand(*x)) for k, x in plain["hands"]),
                int(plain["samples"]),
            )
        except (KeyError, TypeError, ValueError, AttributeError) as error:
            raise InputError(
                f"the record of the session is damaged ({error!r:.80}); take a file that a session wrote"
            ) from error


def _hand(torque: Any, link: Any, at: Any, force: Any) -> Hand:
    """A hand from lists of numbers."""
    return Hand(tuple(map(float, torque)), str(link), _pair(at), _pair(force))


def _pair(given: Any) -> tuple[float, float]:
    x, z = given
    return float(x), float(z)


def told(s: Scenario) -> dict[str, Any]:
    """The values of a scenario that differ from the defaults, and whose they are."""
    return {"controller": s.controller} | s.record()
