"""What was done in a session, in plain values: enough to do it again, bit for bit.

    scenario, ghost     the walks as they began
    changes             (sample, walk, values): other values of a scenario from that sample on
    hands               (sample, Hand): what acts from that sample on
    samples             how many there were

Samples are counted from 0 over the whole session; one is a step of the clock of the walk that leads. A run has
the record as JSON, with the hand as a table beside it (`hand_table`); `session_file` writes it for people.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

from biped_adrc.errors import InputError
from biped_adrc.live.hand import check_hand
from biped_adrc.live.hand_table import HandRow
from biped_adrc.scenario.scenario import Scenario

VERSION = 1
"""Of the layout of a record."""
MOST_SAMPLES = 10**7
"""More samples than a session has, almost three hours at 1 kHz: such a number is a damaged one."""


class Change(NamedTuple):
    """Other values of a scenario."""

    sample: int
    """From which on."""
    walk: int
    """0 for the walk, 1 for its ghost."""
    values: dict[str, Any]
    """By name."""


@dataclass(frozen=True)
class SessionRecord:
    """A session in plain values; see the module. Raises InputError for samples that go back or past the end."""

    scenario: Scenario
    ghost: Scenario | None = None
    changes: tuple[Change, ...] = ()
    hands: tuple[HandRow, ...] = ()
    samples: int = 0

    def __post_init__(self) -> None:
        if not 0 <= self.samples <= MOST_SAMPLES:
            raise InputError(f"there are {self.samples} samples, expected 0 to {MOST_SAMPLES}")
        _check_samples("change", [x.sample for x in self.changes], self.samples, 0)
        _check_samples("row of the hand", [x.sample for x in self.hands], self.samples, 1)
        walks = 1 if self.ghost is None else 2
        for change in self.changes:
            if change.walk not in range(walks):
                raise InputError(
                    f"walk {change.walk} is changed at sample {change.sample}, and there are {walks}, from 0 on"
                )
        for row in self.hands:
            if row.hand is not None:
                _check_row(row)

    def plain(self) -> dict[str, object]:
        """As JSON has it; the hand is not in it."""
        return {
            "version": VERSION,
            "samples": self.samples,
            "scenario": told(self.scenario),
            "ghost": None if self.ghost is None else told(self.ghost),
            "changes": [[*change] for change in self.changes],
        }

    @classmethod
    def of(cls, plain: Mapping[str, Any], hands: tuple[HandRow, ...]) -> SessionRecord:
        """From what JSON had, and the rows of the hand. Raises InputError for what is no record."""
        try:
            check_version(plain["version"])
            ghost = plain["ghost"]
            return cls(
                Scenario(**plain["scenario"]),
                None if ghost is None else Scenario(**ghost),
                tuple(Change(whole(k), whole(walk), dict(x)) for k, walk, x in plain["changes"]),
                hands,
                whole(plain["samples"]),
            )
        except (KeyError, TypeError, ValueError, AttributeError) as error:
            raise InputError(
                f"the record of the session is damaged ({error!r:.80}); take a file that a session wrote"
            ) from error


def _check_samples(what: str, samples: Sequence[int], last: int, apart: int) -> None:
    """Raise InputError for samples that are not `apart` from one to the next, or not within 0 and the last."""
    for one, other in pairwise(samples):
        if other < one + apart:
            raise InputError(
                f"a {what} at sample {other} comes after one at sample {one}; expected samples that go on"
            )
    for sample in samples:
        if not 0 <= sample <= last:
            raise InputError(f"a {what} is at sample {sample}, and the session has {last} samples")


def _check_row(row: HandRow) -> None:
    """Raise InputError, with the sample, for a hand that is none; of which robot it is is seen later."""
    assert row.hand is not None
    try:
        check_hand(row.hand, len(row.hand.torque))
    except InputError as error:
        raise InputError(f"at sample {row.sample}: {error}") from error


def check_version(found: object) -> None:
    """Raise InputError for a session of another layout."""
    if found != VERSION:
        raise InputError(
            f"the session is of layout {found!r:.20}, expected {VERSION}; take the version of biped-adrc "
            "that wrote it"
        )


def whole(x: object) -> int:
    """A whole number. Raises ValueError for anything else."""
    if isinstance(x, bool) or not isinstance(x, int):
        raise ValueError(f"found {x!r:.30}, expected a whole number")
    return x


def told(s: Scenario) -> dict[str, Any]:
    """The values of a scenario that differ from the defaults, and whose they are."""
    return {"controller": s.controller} | s.record()
