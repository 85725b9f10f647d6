"""Sessions on disk, and walked again from there.

session.save("me.npz")          a run, as `ba.load_walk` reads it, with the ghost and the record inside
session.save("me.toml")         a scenario with its inputs (`session_file`)
ba.replay_session("me.npz")     the same again, and whether it is the same bit for bit
"""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from biped_adrc.errors import BipedError, InputError
from biped_adrc.files import output_path
from biped_adrc.hybrid import storage
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.live.hand_table import from_table, to_table
from biped_adrc.live.record import SessionRecord
from biped_adrc.live.session_file import Ended, read_session, write_session
from biped_adrc.live.stored import always, walks_of
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.registry import read_from_a_file
from biped_adrc.scenario.stored import load_ghost, load_walk, save_walk
from biped_adrc.shown import Shown

RECORD, HAND = "session", "hand"
"""Names in a run of the record, among the settings, and of the hand's table."""
SUFFIXES = (".npz", ".toml")
"""Kinds of files of a session."""


def save_session(
    record: SessionRecord, path: Path | str, *more: Path | str, going: Callable[[], bool] = always
) -> Path:
    """Walk a session again, and write it to `path` and to each of `more`; the path.

    A name that ends in .npz is a run, in .toml a scenario with its inputs. going: asked before each sample
    whether to go on. Raises InputError, and OutputError, also where it is given up.
    """
    paths = [output_path(each, SUFFIXES, default=True) for each in (path, *more)]
    walks = walks_of(record, going)
    for each in paths:
        save_walked(record, walks, each)
    return paths[0]


def save_walked(record: SessionRecord, walks: tuple[Walk, ...], path: Path | str) -> Path:
    """As `save_session`, with the walks of the record at hand; the path."""
    path = output_path(path, SUFFIXES, default=True)
    if path.suffix.lower() == ".toml":
        write_session(path, record, [Ended.of(walk.trajectory) for walk in walks])
        return path
    walk, *ghost = walks
    beside = {HAND: np.array(to_table(record.hands))}
    return save_walk(walk, path, {RECORD: record.plain()}, ghost[0] if ghost else None, beside)


@dataclass(frozen=True)
class Replayed(Shown):
    """A session that was walked again."""

    record: SessionRecord
    walk: Walk
    """As it was walked now."""
    ghost: Walk | None
    """The other walk; None without one."""
    gap: float | None
    """Largest difference of the states to the file [rad, rad/s]; infinite where there are other nodes.

    A scenario file has the states at the end alone, and whether all are the same; None where it has none.
    """

    @property
    def same(self) -> bool:
        """Whether times and states of both walks are those of the file, bit for bit."""
        return self.gap == 0.0

    @property
    def walks(self) -> tuple[Walk, ...]:
        """The walk, and its ghost where there is one."""
        return (self.walk,) if self.ghost is None else (self.walk, self.ghost)

    def save(self, path: Path | str) -> Path:
        """Write it as `Session.save` does: .npz or .toml. Raises InputError and OutputError."""
        return save_walked(self.record, self.walks, path)


def replay_session(path: Path | str) -> Replayed:
    """Walk a stored session again, from what was done in it, and compare it with the file.

    path: .npz or .toml that a session wrote. Bits are those of the file on a processor of the same kind, with
    the same version of the package. A class of one's own that a run names has to be imported or registered
    before; one that a scenario file names is imported. Raises InputError for a file that is none, or that
    cannot be walked.
    """
    as_text = isinstance(path, str | Path) and Path(path).suffix.lower() == ".toml"
    with nullcontext() if as_text else read_from_a_file():
        record, gap_to = _of_text(Path(path)) if as_text else _of_run(path)
        try:
            walk, *ghost = walks_of(record)
        except BipedError as error:
            raise InputError(f"session '{path}': {error}") from error
    found = tuple(x.trajectory for x in (walk, *ghost))
    return Replayed(record, walk, ghost[0] if ghost else None, gap_to(found))


Gap = Callable[[tuple[Trajectory, ...]], float | None]
"""How far runs are from those of a file."""


def _of_text(path: Path) -> tuple[SessionRecord, Gap]:
    """The record in a scenario file, and the comparison with its ends."""
    record, ended = read_session(path)
    if len(ended) not in (0, walks := 1 if record.ghost is None else 2):
        raise InputError(
            f"session file '{path}' has {len(ended)} tables [[ended]], expected {walks}"
        )

    def gap(runs: tuple[Trajectory, ...]) -> float | None:
        pairs = zip(ended, map(Ended.of, runs), strict=False)
        return max((one.gap(other) for one, other in pairs), default=None)

    return record, gap


def _of_run(path: Path | str) -> tuple[SessionRecord, Gap]:
    """The record in a run, and the comparison with its states."""
    stored = [load_walk(path)]
    plain: Any = stored[0].trajectory.settings.get(RECORD)
    if not isinstance(plain, dict):
        raise InputError(f"'{path}' is a run and no session; take a file that Session.save wrote")
    with storage.reading_run(path):
        record = SessionRecord.of(plain, from_table(str(storage.load_beside(path)[HAND])))
    ghost = load_ghost(path)
    if (ghost is None) != (record.ghost is None):
        raise InputError(
            f"run '{path}' has a ghost in the record or in the states alone; take a copy"
        )
    stored += [] if ghost is None else [ghost]

    def gap(runs: tuple[Trajectory, ...]) -> float:
        pairs = zip((x.trajectory for x in stored), runs, strict=True)
        return max(difference(one, other) for one, other in pairs)

    return record, gap


def difference(one: Trajectory, other: Trajectory) -> float:
    """Largest difference of the states of two runs; infinite for other times or another number of them."""
    t, s = (np.concatenate([arc.t for arc in run.arcs]) for run in (one, other))
    x, y = (np.concatenate([arc.x for arc in run.arcs]) for run in (one, other))
    if x.shape != y.shape or not np.array_equal(t, s):
        return math.inf
    return float(np.max(np.abs(x - y)))
