"""A walk as a table: one row for each stored node, one column for each number, with its unit in the name.

    t [s], step, event, q1 [rad] .. qN, v1 [rad/s] .., u1 [N m] .. up, q_d1 [rad] .. qp, v_d1 [rad/s] ..,
    error1 [rad] .., F_T [N], F_N [N]

event names the impact or the end that a node lies just before, and is empty elsewhere; an impact repeats its
time, before and after it.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from biped_adrc.analysis.signals import Signals
from biped_adrc.core.errors import optional
from biped_adrc.core.files import output_path, replacing
from biped_adrc.core.types import Array
from biped_adrc.hybrid.trajectory import Trajectory

if TYPE_CHECKING:
    import pandas

EVENT = "event"
NUMBERED = {
    "q": ("q", "rad"),
    "v": ("v", "rad/s"),
    "u": ("u", "N m"),
    "q_d": ("q_d", "rad"),
    "dq_d": ("v_d", "rad/s"),
    "error": ("error", "rad"),
}
"""Signals with a column for each joint: name in the table, and unit."""


def columns_of(s: Signals, trajectory: Trajectory) -> dict[str, Any]:
    """Names with units, and columns (K,): floats, `step` of int, `event` of text."""
    columns: dict[str, Any] = {"t [s]": s.t, "step": s.step.astype(int), EVENT: _events(trajectory)}
    for signal, (name, unit) in NUMBERED.items():
        rows: Array = getattr(s, signal)
        columns |= {f"{name}{i + 1} [{unit}]": rows[:, i] for i in range(rows.shape[1])}
    forces = {f"F_{axis} [N]": s.ground_reaction[:, i] for i, axis in enumerate("TN")}
    return columns | forces


def _events(trajectory: Trajectory) -> list[str]:
    """Of each node, the event that ends its arc there; empty elsewhere."""
    result = list[str]()
    for arc in trajectory.arcs:
        result += [""] * (len(arc.t) - 1) + ["" if arc.event is None else arc.event.guard]
    return result


def write_csv(columns: Mapping[str, Any], path: Path | str) -> Path:
    """Write columns under their names; floats come back to the last bit. Raises InputError and "
    "OutputError."""
    target = output_path(path, (".csv",), default=True)
    plain = [column if isinstance(column, list) else column.tolist() for column in columns.values()]
    with replacing(target) as temporary, open(temporary, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*plain, strict=True))
    return target


def data_frame(columns: Mapping[str, Any], note: str) -> pandas.DataFrame:
    """As a pandas DataFrame, the note in its `attrs`. Raises InputError where pandas is not installed."""
    need = "a table of a walk needs pandas, which is not installed"
    with optional("study", need, ", or write a file with walk.to_csv(path)"):
        import pandas
    frame = pandas.DataFrame(dict(columns))
    frame.attrs["note"] = note
    return frame
