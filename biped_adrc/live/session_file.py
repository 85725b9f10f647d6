"""A session as a scenario file with its inputs (.toml), to read and to change by hand.

    controller = "ADRC"                 the scenario, as in every scenario file (`bench.scenario_file`)
    hardware = "ideal"

    [ghost]                             that of the ghost, where there is one
    controller = "NPD"

    [session]
    version = 1
    samples = 812                       how many there are, from 0 on
    changes = [
        { sample = 500, walk = 0, values = { bandwidth = 300.0 } },
    ]
    hand = '''                          as `hand_table` has it
    ..
    '''

    [[ended]]                           each walk, as it was at its end
    t = 0.812
    x = [..]
    sha256 = ".."                       of all its times and states

Floats are read back to the same bits. Without `ended` the session is walked, and compared with nothing.
"""

from __future__ import annotations

import hashlib
import json
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.bench.parameters import TABLES, nested
from biped_adrc.bench.scenario_file import read_values, scenario_lines
from biped_adrc.errors import InputError
from biped_adrc.files import reading, toml_value, write_text
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.live.hand_table import from_table, to_table
from biped_adrc.live.record import VERSION, Change, SessionRecord, check_version, whole
from biped_adrc.scenario.scenario import Scenario

HEAD = (
    "# What was done in a session, sample by sample; 'biped-adrc simulate' with this file repeats it.",
    "",
)
PARTS = {"version", "samples", "changes", "hand"}
"""Names in the table `session`."""


class Ended(NamedTuple):
    """A walk as it was at its end, to compare another with."""

    t: float
    """[s]"""
    x: tuple[float, ...]
    """State: (q, q') [rad, rad/s], and what the walk has behind."""
    sha256: str
    """Of all times and states."""

    @classmethod
    def of(cls, run: Trajectory) -> Ended:
        """That of a run."""
        digest, last = hashlib.sha256(), run.arcs[-1]
        for rows in (rows for arc in run.arcs for rows in (arc.t, arc.x)):
            digest.update((rows + 0.0).astype("<f8").tobytes())  # -0.0 is 0.0
        return cls(float(last.t[-1]), tuple(last.x[-1].tolist()), digest.hexdigest())

    def gap(self, other: Ended) -> float:
        """0 where all times and states are the same; else the largest difference of the states at the end,
        infinite where the ends are of other times or the walks differ before alone.
        """
        if self.sha256 == other.sha256:
            return 0.0
        if self.t != other.t or len(self.x) != len(other.x):
            return float("inf")
        return float(np.max(np.abs(np.subtract(self.x, other.x)))) or float("inf")


def write_session(path: Path, record: SessionRecord, ended: Sequence[Ended]) -> None:
    """Write a session as a scenario with its inputs.

    Raises InputError for a value that has no text in such a file, as None among a controller's own, and
    OutputError.
    """
    text = to_text(record, ended)
    again, _ = from_text(text)
    if json.dumps(again.plain()) != json.dumps(record.plain()):
        raise InputError(
            f"the values of this session are not read back from '{path}' as they are; save it as a run (.npz)"
        )
    write_text(path, text)


def to_text(record: SessionRecord, ended: Sequence[Ended]) -> str:
    """A session as TOML; see the module."""
    lines = [*HEAD, *scenario_lines(record.scenario)]
    if record.ghost is not None:
        lines += ["", "[ghost]", *scenario_lines(record.ghost)]
    lines += ["", "[session]", f"version = {VERSION}", f"samples = {record.samples}"]
    if record.changes:
        lines += ["changes = [", *(f"    {toml_value(x._asdict())}," for x in record.changes), "]"]
    if table := to_table(record.hands):
        lines.append(f"hand = {toml_value(table)}" if "'''" in table else f"hand = '''\n{table}'''")
    for end in ended:
        lines += [
            "",
            "[[ended]]",
            *(f"{name} = {toml_value(x)}" for name, x in end._asdict().items()),
        ]
    return "\n".join(lines) + "\n"


def read_session(path: Path) -> tuple[SessionRecord, tuple[Ended, ...]]:
    """What `write_session` wrote; no `Ended` where the file has none. Raises InputError."""
    with reading("session file", path, InputError):
        return from_text(path.read_text(encoding="utf-8"))


def from_text(text: str) -> tuple[SessionRecord, tuple[Ended, ...]]:
    """The inverse of `to_text`. Raises InputError; for what else a damaged file raises see `files.reading`."""
    tables = tomllib.loads(text)
    given = tables.pop("session", None)
    if not isinstance(given, dict):
        raise InputError(
            "it has no table [session]; a scenario is walked by 'biped-adrc simulate --scenario FILE'"
        )
    if more := sorted(set(given) - PARTS):
        raise InputError(f"[session] has {more}, expected {sorted(PARTS)}")
    check_version(given["version"])
    ghost, ended = tables.pop("ghost", None), tables.pop("ended", ())
    record = SessionRecord(
        _scenario(tables, "scenario"),
        None if ghost is None else _scenario(ghost, "ghost"),
        tuple(map(_change, given.get("changes", ()))),
        from_table(given.get("hand", "")),
        whole(given["samples"]),
    )
    return record, tuple(map(_ended, ended))


def _scenario(values: Mapping[str, object], what: str) -> Scenario:
    """A scenario of values by name."""
    return Scenario(**nested(read_values(values, what)))


def _change(given: Mapping[str, Any]) -> Change:
    """One change."""
    sample, walk, values = whole(given["sample"]), whole(given["walk"]), dict(given["values"])
    read = nested(read_values(values, f"change at sample {sample}"))
    empty: dict[str, Any] = {name: {} for name in TABLES if values.get(name) == {}}
    return Change(sample, walk, read | empty)


def _ended(given: Mapping[str, Any]) -> Ended:
    """How a walk ended."""
    return Ended(float(given["t"]), tuple(map(float, given["x"])), str(given["sha256"]))
