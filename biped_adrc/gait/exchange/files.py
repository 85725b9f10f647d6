"""Records of gaits on disk, JSON or MATLAB files with a `units` struct, and runs as MATLAB files.

The names are those of `docs/notation.md` and of the stored gaits; a stored gait of this package is such a
record in this paper's convention.

MATLAB files are of version 5, read by MATLAB and Octave: plain arrays, text, and the struct. A
run is columns over time. Every array has a unit in the struct `units`, which is written last, so
that a truncated file is detected.

This module checks that the entries exist; `record.GaitRecord` checks shapes and numbers,
`importing` whether it is a gait.

A gait file of another program needs three entries, and one more unless the caller states the convention:

    coefficients             (rows, M + 1) [rad], one row per output or coordinate
    theta_plus, theta_minus  range of the phase [rad]
    convention               a name of `conventions.CONVENTIONS`

All other fields of `GaitRecord` may be added under their names. `names` maps them where the file has others.
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

from biped_adrc.core.errors import GaitError, InputError
from biped_adrc.core.files import output_path, plain, read_json, reading, write_bytes, write_text
from biped_adrc.core.types import Array
from biped_adrc.gait.conventions import OWN
from biped_adrc.gait.exchange.record import ENTRIES, REQUIRED, GaitRecord
from biped_adrc.gait.exchange.samples import Samples, read_csv
from biped_adrc.gait.gait import FORMAT as STORED


def write_mat(path: Path | str, entries: Mapping[str, object], units: Mapping[str, str]) -> None:
    """Write numbers, arrays and text under their names as a .mat file; arrays (K,) become columns (K, 1).

    units: of each array, "1" where it has none. Raises OutputError.
    """
    buffer = io.BytesIO()
    savemat(buffer, {**entries, "units": dict(units)}, oned_as="column")
    write_bytes(Path(path), buffer.getvalue())


def read_mat(path: Path | str) -> dict[str, Any]:
    """Read the variables of a .mat file; arrays without their dimensions of length 1, structs as dicts.

    Raises InputError for a file that is missing, damaged, or of version 7.3 (HDF5),
    which MATLAB writes with -v7.3.
    """
    path = Path(path)
    with reading("MATLAB file", path, InputError):
        result = loadmat(io.BytesIO(path.read_bytes()), simplify_cells=True)
    return {name: _text(value) for name, value in result.items() if not name.startswith("__")}


def _text(value: object) -> object:
    """The value; an array of characters, as MATLAB stores text, as str."""
    if isinstance(value, np.ndarray) and value.dtype.kind == "U":
        return "".join(value.ravel().tolist())
    return value


FORMAT = "biped_adrc exchanged gait 1"
"""Entry `format` of a gait file written here; files of other programs need none."""
_KEYS = tuple(f.name for f in fields(GaitRecord))


def write_record(record: GaitRecord, path: Path | str) -> None:
    """Write a record as .json or .mat: the fields of `GaitRecord` by name, a `format`, and the units.

    Fields that are None are left out; provenance is text of JSON in a .mat file. Raises InputError for another
    suffix, and OutputError where the file cannot be written.
    """
    path = output_path(path, (".json", ".mat"))
    entries = {key: x for key, x in vars(record).items() if x is not None}
    units = {key: unit for key, (_, unit) in ENTRIES.items()}
    if path.suffix.lower() == ".mat":
        for key, x in entries.items():
            entries[key] = np.atleast_2d(x) if isinstance(x, np.ndarray) else x  # rows stay rows
        entries["provenance"] = json.dumps(dict(record.provenance))
        units = {key: unit for key, unit in units.items() if key in entries}
        write_mat(path, {"format": FORMAT, **entries}, units)
    else:
        text = json.dumps({"format": FORMAT, **plain(entries), "units": units}, indent=1)
        write_text(path, text + "\n")


def read_record(
    path: Path | str,
    convention: str | None = None,
    names: Mapping[str, str] | None = None,
    usual: str | None = None,
) -> GaitRecord | Samples:
    """Read the record in a .json or .mat file, or the samples of a step where it has t
    and q and no coefficients.

    convention: where the file does not state its own; usual: where neither does. names: the file's names of
    its entries where they differ from ours, such as {"coefficients": "alpha"}; entries of a struct are
    "struct.entry". A stored gait is in the robot's own coordinates. A .csv has samples. Raises InputError and
    GaitError that name the file.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix == ".csv":
        return read_csv(path)
    if suffix not in (".json", ".mat"):
        raise InputError(
            f"gait file '{path}' ends in '{path.suffix}', expected .json, .mat or .csv"
        )
    result = read_mat(path) if suffix == ".mat" else read_json(path, "gait file")
    with reading("gait file", path, GaitError):
        entries = _flat(result)
        cut_off = result.get("format") == FORMAT and "units" not in result
        absent = ["units, so it is cut off"] if cut_off else []
        absent += [theirs for theirs in (names or {}).values() if theirs not in entries]
        entries |= {ours: entries.get(theirs) for ours, theirs in (names or {}).items()}
        samples = "coefficients" not in entries and {"t", "q"} <= set(entries)
        absent += [key for key in REQUIRED if not samples and key not in entries]
        if absent:
            raise GaitError(
                f"the entries {absent} are missing; the file has {sorted(_flat(result))}. Say what they are "
                'called there with names={"coefficients": "..."}, or --name coefficients=...'
            )
        if samples:
            return Samples(entries["t"], entries["q"], entries.get("v"))
        own = entries.get("convention")
        convention_ = own or convention or (OWN if result.get("format") == STORED else usual)
        if convention_ is None or (own and convention not in (None, own)):
            raise GaitError(
                f"the file says convention '{own}', and '{convention}' is given; expected one of the two to be "
                "a name: add an entry 'convention', or give convention=..."
            )
        record = {key: entries[key] for key in _KEYS if key in entries}
        for key in ("coefficients", "outputs"):
            if isinstance(record.get(key), np.ndarray):
                record[key] = np.atleast_2d(record[key])  # one row, squeezed by loadmat
        provenance = record.get("provenance", {})
        if isinstance(provenance, str):
            provenance = json.loads(provenance)
        return GaitRecord(
            **{**record, "convention": str(convention_), "provenance": dict(provenance)}
        )


def _flat(found: Mapping[str, Any], above: str = "") -> dict[str, Any]:
    """Entries of a file by name, those of structs as "struct.entry"."""
    flat = dict[str, Any]()
    for name, x in found.items():
        flat[above + name] = x
        if isinstance(x, Mapping) and name not in ("units", "provenance"):
            flat |= _flat(x, f"{above}{name}.")
    return flat


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
"""Name of a column of `biped_adrc.analysis.signals.Signals` -> its unit."""


def export_run(columns: Mapping[str, Array], path: Path | str, note: str = "") -> None:
    """Write signals (K,) or (K, ...), as `vars(walk.signals)`, as a .mat file in this paper's convention.

    note: free text. Raises InputError for another suffix, and OutputError.
    """
    about = {"format": RUN_FORMAT, "convention": "paper", "note": note}
    arrays = {name: np.asarray(column, dtype=float) for name, column in columns.items()}
    units = {name: RUN_UNITS[name] for name in columns}
    write_mat(output_path(path, (".mat",)), {**about, **arrays}, units)
