"""Runs on disk: one npz of plain arrays with the settings as JSON inside, and the same JSON beside it.

Nothing is pickled. Files are written whole or not at all.
"""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from biped_adrc.errors import InputError, OutputError
from biped_adrc.files import output_path, write_bytes, write_text
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Arc, Event, Trajectory

FORMAT = "biped_adrc run 1"
BESIDE = "beside."
"""Before the names of arrays that are no part of the trajectory."""


def run_files(path: Path | str) -> tuple[Path, Path]:
    """The .npz of a run and the .json beside it; .npz is put behind a name without a kind, such as 'push_0.1'.

    Raises InputError for a name of another kind.
    """
    path = output_path(path, (".npz",), default=True)
    return path, path.with_suffix(".json")


def check_beside(path: Path) -> None:
    """Raises OutputError where the .json of a run would take the place of something else, such as a gait."""
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        ours = isinstance(record, dict) and record.get("format") == FORMAT
    except FileNotFoundError:
        return
    except (OSError, ValueError):
        ours = False
    if not ours:
        raise OutputError(
            f"a run has its settings beside it, and '{path}' is there and is not of a run; choose another name"
        )


def save(
    trajectory: Trajectory,
    path: Path | str,
    settings: dict[str, Any] | None = None,
    beside_it: Mapping[str, Any] | None = None,
) -> Path:
    """Write `path` (.npz) and the same name with .json; returns it. Modes are stored as tuples of numbers.

    beside_it: arrays by name that `load_beside` gives back, such as the walker's record. Raises InputError for
    a name of another kind or settings that JSON has not, and OutputError when the files cannot be written or
    the .json would take the place of something else.
    """
    path, beside = run_files(path)
    check_beside(beside)
    meta = {
        "format": FORMAT,
        "status": trajectory.status.name,
        "detail": trajectory.detail,
        "settings": {**trajectory.settings, **(settings or {})},
        "events": [
            None if a.event is None else {"guard": a.event.guard, "t": a.event.t}
            for a in trajectory.arcs
        ],
    }
    try:
        text = json.dumps(meta, indent=2)
    except (TypeError, ValueError) as error:
        raise InputError(
            f"run '{path}': {error}; expected settings of numbers, text, lists and mappings"
        ) from error
    arrays: dict[str, Any] = {"meta": np.array(text)}
    arrays |= {f"{BESIDE}{name}": np.asarray(x) for name, x in (beside_it or {}).items()}
    for i, arc in enumerate(trajectory.arcs):
        arrays |= {f"t{i}": arc.t, f"x{i}": arc.x, f"dx{i}": arc.dx}
        arrays |= {f"read{i}_{name}": rows for name, rows in arc.read.items()}
        arrays[f"mode{i}"] = np.array(arc.mode, dtype=float)
        if arc.event is not None:
            arrays[f"x_minus{i}"] = arc.event.x_minus
            if arc.event.x_plus is not None:
                arrays[f"x_plus{i}"] = arc.event.x_plus
    buffer = io.BytesIO()
    np.savez_compressed(buffer, **arrays)
    write_bytes(path, buffer.getvalue())
    write_text(beside, text + "\n")
    return path


def load(path: Path | str, mode: Callable[..., Any] = lambda *numbers: numbers) -> Trajectory:
    """The run in `path` (.npz); `mode` makes a mode from its stored numbers.

    Raises InputError for a file that is missing, damaged or of another format.
    """
    path = Path(path)
    if not path.is_file():
        raise InputError(f"run '{path}' not found")
    try:
        with np.load(io.BytesIO(path.read_bytes()), allow_pickle=False) as data:
            meta = json.loads(str(data["meta"]))
            if meta["format"] != FORMAT:
                raise InputError(f"run '{path}' has format '{meta['format']}', expected '{FORMAT}'")
            arcs = tuple(_arc(data, i, event, mode) for i, event in enumerate(meta["events"]))
    except (KeyError, ValueError, OSError, EOFError, TypeError, zipfile.BadZipFile) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"run '{path}' cannot be read: {error}") from error
    return Trajectory(arcs, Status[meta["status"]], meta["detail"], meta["settings"])


def load_beside(path: Path | str) -> dict[str, Any]:
    """The arrays beside the trajectory in a file that `load` has read."""
    with np.load(Path(path), allow_pickle=False) as data:
        names = [name for name in data.files if name.startswith(BESIDE)]
        return {name.removeprefix(BESIDE): data[name] for name in names}


def _arc(data: Any, i: int, event: dict[str, Any] | None, mode: Callable[..., Any]) -> Arc:
    found = None
    if event is not None:
        plus = data.get(f"x_plus{i}")
        found = Event(event["guard"], float(event["t"]), data[f"x_minus{i}"], plus)
    numbers = np.atleast_1d(data[f"mode{i}"]).tolist()
    mark = f"read{i}_"
    read = {name.removeprefix(mark): data[name] for name in data if name.startswith(mark)}
    return Arc(mode(*numbers), data[f"t{i}"], data[f"x{i}"], data[f"dx{i}"], found, read)
