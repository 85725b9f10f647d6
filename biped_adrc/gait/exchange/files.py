"""Records of gaits on disk, JSON or MATLAB files with a `units` struct, and runs as MATLAB files.

The names are those of `docs/notation.md` and of the stored gaits; a stored gait of this package is such a
record in this paper's convention.

MATLAB files are of version 5, read by MATLAB and Octave: plain arrays, text, and the struct. A run is columns
over time. Every array has a unit in the struct `units`, which is written last, so that a file cut off is
noticed.

Entries are checked here for what only a file can get wrong (missing keys, text in place of numbers);
`record.GaitRecord` checks shapes and numbers, `closure` whether it is a gait.

A gait file of another program needs three entries, and one more unless the caller states the convention:

    coefficients             (rows, M + 1) [rad], one row per output or coordinate
    theta_plus, theta_minus  range of the phase [rad]
    convention               a name of `conventions.CONVENTIONS`

All other fields of `GaitRecord` may be added under their names. What is called differently is mapped by
`names`.
"""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import loadmat, savemat

from biped_adrc.errors import GaitError, InputError
from biped_adrc.files import output_path, read_json, reading, write_bytes, write_text
from biped_adrc.gait.conventions import OWN, Convention
from biped_adrc.gait.exchange.record import GaitRecord
from biped_adrc.gait.exchange.samples import Samples, read_csv
from biped_adrc.gait.gait import FORMAT as STORED
from biped_adrc.types import Array


def write_mat(path: Path | str, entries: Mapping[str, object], units: Mapping[str, str]) -> None:
    """Write numbers, arrays and text under their names as a .mat file; arrays (K,) become columns (K, 1).

    units: of each array, "1" where it has none. Raises OutputError.
    """
    buffer = io.BytesIO()
    savemat(buffer, {**entries, "units": dict(units)}, oned_as="column")
    write_bytes(Path(path), buffer.getvalue())


def read_mat(path: Path | str) -> dict[str, Any]:
    """The variables of a .mat file; arrays without their dimensions of length 1, structs as dicts.

    Raises InputError for a file that is missing, damaged or of version 7.3.
    """
    path = Path(path)
    with reading("MATLAB file", path, InputError):
        data = path.read_bytes()
    try:
        found = loadmat(io.BytesIO(data), simplify_cells=True)
    except NotImplementedError as error:
        raise InputError(
            f"MATLAB file '{path}' is of version 7.3 (HDF5), expected 5 or 7; save it again in MATLAB with "
            "save(file, '-v7', ...)"
        ) from error
    except Exception as error:  # a damaged file makes scipy raise errors of many kinds
        raise InputError(f"MATLAB file '{path}' cannot be read: {error}") from error
    return {name: _text(value) for name, value in found.items() if not name.startswith("__")}


def _text(value: object) -> object:
    """The value, or str for text, which MATLAB keeps as an array of characters."""
    if isinstance(value, np.ndarray) and value.dtype.kind == "U":
        return "".join(value.ravel().tolist())
    return value


FORMAT = "biped_adrc exchanged gait 1"
"""Entry `format` of a gait file written here; files of other programs need none."""
UNITS = {  # of the entries of a gait file, written into it
    "coefficients": "rad",
    "theta_plus": "rad",
    "theta_minus": "rad",
    "phase": "1",
    "outputs": "1",
    "reverse": "1",
    "q_minus": "rad",
    "v_minus": "rad/s",
    "period": "s",
    "slope": "rad",
}
_KEYS = tuple(f.name for f in fields(GaitRecord) if f.name != "own")
_SAMPLES = ("t", "q", "v")
_REQUIRED = ("coefficients", "theta_plus", "theta_minus")
_TEXT = ("convention", "curve", "name", "robot", "preset")


def write_record(record: GaitRecord, path: Path | str) -> None:
    """Write a record as .json or .mat: the fields of `GaitRecord` by name, a `format`, and the units.

    What is None is left out; provenance is text of JSON in a .mat file. Raises InputError for another suffix,
    and OutputError.
    """
    path = output_path(path, (".json", ".mat"))
    entries = {key: getattr(record, key) for key in _KEYS if getattr(record, key) is not None}
    entries["provenance"] = json.dumps(dict(record.provenance))
    if path.suffix.lower() == ".mat":
        entries["reverse"] = float(record.reverse)
        for key in ("phase", "q_minus", "v_minus"):
            if key in entries:
                entries[key] = entries[key][np.newaxis, :]  # a row
        units = {key: unit for key, unit in UNITS.items() if key in entries}
        write_mat(path, {"format": FORMAT, **entries}, units)
    else:
        plain = {k: v.tolist() if isinstance(v, np.ndarray) else v for k, v in entries.items()}
        plain["provenance"] = dict(record.provenance)
        text = json.dumps({"format": FORMAT, **plain, "units": UNITS}, indent=1)
        write_text(path, text + "\n")


def read_record(
    path: Path | str,
    convention: str | None = None,
    names: Mapping[str, str] | None = None,
    own: Convention | None = None,
) -> GaitRecord | Samples:
    """The record in a .json or .mat file, or the samples of a step where it has t and q and no coefficients.

    convention: where the file does not say its own. names: the file's names of its entries where they are not
    ours, such as {"coefficients": "alpha"}; entries of a struct are "struct.entry", and where one struct has
    all that is needed it is looked into. own: of the robot, for the convention "own"; where the gait is one
    that this package has stored, too. A .csv has samples. Raises InputError and GaitError that name the file.
    """
    path = Path(path)
    if path.suffix.lower() == ".csv":
        return Samples(**read_csv(path))
    if path.suffix.lower() == ".mat":
        found = read_mat(path)
    elif path.suffix.lower() == ".json":
        found = read_json(path, "gait file")
        if not isinstance(found, dict):
            kind = type(found).__name__
            raise InputError(f"gait file '{path}' holds a {kind}, expected an object")
    else:
        raise InputError(
            f"gait file '{path}' ends in '{path.suffix}', expected .json, .mat or .csv"
        )
    if found.get("format") == FORMAT and "units" not in found:
        raise InputError(f"gait file '{path}' ends before its units: it is cut off; copy it again")
    with reading("gait file", path, GaitError):
        entries = _ours(found, names or {})
        if "coefficients" not in entries and {"t", "q"} <= set(entries):
            return Samples(*(entries.get(key) for key in _SAMPLES))  # type: ignore[arg-type]
        return _record(entries, convention, own)


def _flat(found: Mapping[str, Any], above: str = "") -> dict[str, Any]:
    """Entries of structs as "struct.entry", beside what is not in one."""
    flat = dict[str, Any]()
    for name, x in found.items():
        flat[above + name] = x
        if isinstance(x, Mapping) and name not in ("units", "provenance"):
            flat |= _flat(x, f"{above}{name}.")
    return flat


def _inside(found: Mapping[str, Any]) -> Mapping[str, Any]:
    """The one struct that has all that is required, where the file itself has not; else nothing."""
    for required in (_REQUIRED, ("t", "q")):
        if set(required) <= set(found):
            return {}
        structs = [x for x in _flat(found).values() if isinstance(x, Mapping)]
        having = [x for x in structs if set(required) <= set(x)]
        if len(having) == 1:
            return having[0]
    return {}


def _ours(found: Mapping[str, object], names: Mapping[str, str]) -> dict[str, object]:
    """The entries by the names of `GaitRecord` or `Samples`. Raises GaitError for names that are not there."""
    known = (*_KEYS, *_SAMPLES)
    unknown = [ours for ours in names if ours not in known]
    if unknown:
        raise GaitError(f"names gives {unknown}, expected names of {list(known)}")
    flat = _flat(found)
    absent = [theirs for theirs in names.values() if theirs not in flat]
    if absent:
        raise GaitError(f"there are no entries {absent}; the file has {sorted(flat)}")
    given = {ours: flat[theirs] for ours, theirs in names.items()}
    return {**_inside(found), **found, **given}


def _record(
    found: Mapping[str, object], convention: str | None, robot: Convention | None
) -> GaitRecord:
    """The record of the entries of a file, under our names.

    Raises GaitError for missing entries, a convention that is not stated or stated twice, and wrong types.
    """
    missing = [key for key in _REQUIRED if key not in found]
    if missing:
        raise GaitError(
            f"the entries {missing} are missing; the file has {sorted(_flat(found))}. Say what they are "
            'called there with names={"coefficients": "..."}, or --name coefficients=...'
        )
    stored = OWN if robot is not None else "paper"
    own = stored if found.get("format") == STORED else found.get("convention")
    if own is None and convention is None and robot is not None:
        convention = OWN
    if own is None and convention is None:
        raise GaitError(
            "the file does not say its angle convention; add an entry 'convention' or give convention=..."
        )
    if own is not None and convention is not None and str(own) != convention:
        raise GaitError(
            f"convention is '{convention}', but the file says '{own}'; leave one of them out"
        )
    given: dict[str, Any] = {key: found[key] for key in _KEYS if key in found}
    for key in _TEXT:
        if not isinstance(given.get(key, ""), str):
            raise GaitError(f"{key} is {given[key]!r}, expected text")
    given["convention"] = str(own) if own is not None else convention
    reverse = given.get("reverse", False)
    if reverse not in (0, 1):
        raise GaitError(f"reverse is {reverse!r}, expected true or false, or 1 or 0")
    given["reverse"] = bool(reverse)
    given["provenance"] = _provenance(given.get("provenance", {}))
    for key in ("coefficients", "outputs"):
        if isinstance(given.get(key), np.ndarray):
            given[key] = np.atleast_2d(given[key])  # one row, squeezed by loadmat
    return GaitRecord(**given, own=robot if given["convention"] == OWN else None)


def _provenance(value: object) -> dict[str, object]:
    """Provenance by name, from a mapping, text of JSON (in .mat files), or any other text as its source."""
    if isinstance(value, str):
        try:
            value = json.loads(value)
        except json.JSONDecodeError:
            value = {"source": value}
    if not isinstance(value, Mapping):
        raise GaitError(f"provenance is a {type(value).__name__}, expected text or a mapping")
    return dict(value)


RUN_FORMAT = "biped_adrc exchanged run 1"
"""Entry `format` of a walk as a .mat file."""
RUN_UNITS = {
    name: unit
    for unit, names in {
        "s": "t",
        "1": "step",
        "m": "swing_foot hip foothold foothold_height",
        "rad": "q theta q_d error",
        "rad/s": "v dtheta dq_d",
        "rad/s^2": "a xi xi_estimate xi_external xi_matched xi_nominal",
        "N": "ground_reaction outside",
        "N s": "momentum",
        "N m": "u zeta zeta_estimate",
        "J": "kinetic potential",
    }.items()
    for name in names.split()
}
"""Units of the columns `biped_adrc.analysis.signals.Signals` has."""


def export_run(columns: Mapping[str, Array], path: Path | str, note: str = "") -> None:
    """Write signals (K,) or (K, ...), as `vars(walk.signals)`, as a .mat file in this paper's convention.

    note: free text. Raises InputError for another suffix, and OutputError.
    """
    about = {"format": RUN_FORMAT, "convention": "paper", "note": note}
    arrays = {name: np.asarray(column, dtype=float) for name, column in columns.items()}
    units = {name: RUN_UNITS[name] for name in columns}
    write_mat(output_path(path, (".mat",)), {**about, **arrays}, units)
