"""Runs on disk: one npz of plain arrays with the settings as JSON inside.

For arc i, the flow between two events, the npz holds its nodes (stored instants) t{i}, x{i}, dx{i}, its
discrete state mode{i}, further signals read{i}_NAME at the nodes and, at an event, the states before and after
it, x_minus{i} and x_plus{i}; `meta` is the JSON text with status, settings and the events' names and times.

Nothing is pickled, so reading a file of somebody else's runs no code. Files are written whole or
not at all. `scenario.stored` adds arrays beside the trajectory, such as the parameters of the walker and its
signals.
"""

import io
import json
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import InputError
from biped_adrc.core.files import output_path, reading, write_bytes
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Arc, Event, Trajectory

Stored = NDArray[Any]
"""An array of a file, of numbers or text."""

_FORMAT = "biped_adrc run 2"
"""Version of the layout; a file of another one is refused."""
BESIDE = "beside."
"""Prefix of the names of arrays that are not part of the trajectory."""


def save(
    trajectory: Trajectory,
    path: Path | str,
    settings: Mapping[str, object] | None = None,
    beside_it: Mapping[str, ArrayLike] | None = None,
) -> Path:
    """Write a run to `path`, and return the path; a name without .npz at its end, such as 'push_0.1', gets it.

    Modes are stored as tuples of numbers.

    - trajectory: states (K, nx) and what else its arcs hold, in full precision.
    - settings: stored together with those of the trajectory; of two with the same name these count.
    - beside_it: further arrays by name, such as the run's signals; `load_beside` returns them.

    Raises InputError for another suffix than .npz or settings that JSON cannot hold, and OutputError
    where the file cannot be written.
    """
    path = output_path(path, (".npz",), default=True)
    events = [arc.event for arc in trajectory.arcs]
    meta = {
        "format": _FORMAT,
        "status": trajectory.status.name,
        "detail": trajectory.detail,
        "settings": {**trajectory.settings, **(settings or {})},
        # null for an arc that ended without an event
        "events": [a and {"guard": a.guard, "t": a.t} for a in events],
    }
    try:
        text = json.dumps(meta, indent=2)
    except (TypeError, ValueError) as error:
        why = f"{error}; expected settings of numbers, text, lists and mappings"
        raise InputError(f"run '{path}': {why}") from error
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
    np.savez(buffer, **arrays)
    write_bytes(path, buffer.getvalue())
    return path


def load(path: Path | str, mode: Callable[..., object] = lambda *numbers: numbers) -> Trajectory:
    """Read the run in `path` (.npz).

    mode: function that makes an arc's discrete state from its stored numbers; by default a tuple of them.
    Raises InputError for a file that is missing, damaged or of another format.
    """
    check_part(path, "the file of a run", str, Path)
    # every exception inside `reading` becomes an InputError that names the file
    with reading("run", path, InputError):
        content = Path(path).read_bytes()
        if not content.startswith(b"PK"):  # a .npz file is a zip archive
            raise InputError("it is no run, expected a .npz file that 'simulate -o' has written")
        with np.load(io.BytesIO(content), allow_pickle=False) as data:
            meta = json.loads(str(data["meta"]))
            if meta["format"] != _FORMAT:
                raise InputError(f"it has format '{meta['format']}', expected '{_FORMAT}'")
            arcs = tuple(_arc(data, i, event, mode) for i, event in enumerate(meta["events"]))
            _check(arcs)
            if not arcs or f"t{len(arcs)}" in data:  # arrays of an arc more than `meta` has
                raise ValueError(f"there are events of {len(arcs)} arcs")
        settings = dict(meta["settings"])
        # both may be missing; where they are there, they are printed, so they have to be texts
        if not all(isinstance(settings.get(name, ""), str) for name in ("method", "engine")):
            raise ValueError("its method or engine is not text")
        return Trajectory(arcs, Status[meta["status"]], str(meta["detail"]), settings)


def load_beside(path: Path | str) -> dict[str, Stored]:
    """Read the arrays that `save` stored as `beside_it`, by name; path: a file that `load` can read.

    Raises InputError for a file that cannot be read.
    """
    with reading("run", path, InputError), np.load(Path(path), allow_pickle=False) as data:
        names = [name for name in data.files if name.startswith(BESIDE)]
        return {name.removeprefix(BESIDE): data[name] for name in names}


def _arc(
    data: Mapping[str, Stored], i: int, event: Mapping[str, Any] | None, mode: Callable[..., object]
) -> Arc:
    """Arc i of the arrays in a file; event: its event in the JSON, None for none; mode: function that makes the
    arc's discrete state from its stored numbers.
    """
    result = None
    if event is not None:
        plus = data.get(f"x_plus{i}")
        result = Event(event["guard"], float(event["t"]), data[f"x_minus{i}"], plus)
    numbers = np.atleast_1d(data[f"mode{i}"]).tolist()
    mark = f"read{i}_"
    read = {name.removeprefix(mark): data[name] for name in data if name.startswith(mark)}
    return Arc(mode(*numbers), data[f"t{i}"], data[f"x{i}"], data[f"dx{i}"], result, read)


def _check(arcs: Sequence[Arc]) -> None:
    """Raise ValueError for arrays that form no arcs: no nodes, shapes that do not fit together, numbers that
    are no finite floats, times that go back or do not end at the event.
    """
    end = -math.inf
    for i, arc in enumerate(arcs):
        t, x, read = arc.t, arc.x, arc.read.values()
        ends = [] if arc.event is None else [arc.event.x_minus, arc.event.x_plus]
        states = [state for state in ends if state is not None]
        # `or -1`: an arc without nodes fails too
        rows = t.ndim == 1 and x.ndim == 2 and {len(x), *map(len, read)} == {len(t) or -1}
        widths = arc.dx.shape == x.shape and all(state.shape == x.shape[1:] for state in states)
        floats = all(values.dtype.kind == "f" for values in (t, x, arc.dx, *read, *states))
        if not (rows and widths and floats):
            raise ValueError(
                f"arc {i} has {t.shape} times, states {x.shape} and others that do not fit"
            )
        # not of `read`: a signal may be NaN, such as the estimate of xi where there is no observer
        if not all(np.isfinite(values).all() for values in (t, x, arc.dx, *states)):
            raise ValueError(f"arc {i} has NaN or infinity")
        if t[0] < end or np.any(np.diff(t) < 0.0) or (arc.event and arc.event.t != t[-1]):
            raise ValueError(f"the times of arc {i} do not ascend to its event")
        end = t[-1]
