"""Runs as MATLAB files: columns over time with the names of `docs/notation.md`, and their units."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.files import output_path
from biped_adrc.gait.exchange.matfile import read_mat, write_mat
from biped_adrc.types import Array

FORMAT = "biped_adrc exchanged run 1"
UNITS = {
    "t": "s",
    "step": "1",
    "q": "rad",
    "v": "rad/s",
    "a": "rad/s^2",
    "theta": "rad",
    "dtheta": "rad/s",
    "q_d": "rad",
    "dq_d": "rad/s",
    "error": "rad",
    "u": "N m",
    "zeta": "N m",
    "xi": "rad/s^2",
    "xi_estimate": "rad/s^2",
    "xi_external": "rad/s^2",
    "xi_matched": "rad/s^2",
    "xi_nominal": "rad/s^2",
    "zeta_estimate": "N m",
    "ground_reaction": "N",
    "kinetic": "J",
    "potential": "J",
    "swing_foot": "m",
    "hip": "m",
    "foothold": "m",
    "foothold_height": "m",
}
"""Units of the columns `biped_adrc.analysis.signals.Signals` has."""


def export_run(
    columns: Mapping[str, Array],
    path: Path | str,
    units: Mapping[str, str] | None = None,
    note: str = "",
) -> None:
    """Write columns (K,) or (K, ...) over the same K nodes as a .mat file, such as `vars(walk.signals)`.

    units: of columns that are not of this package. Angles are in this paper's convention. Raises InputError
    for a column without a unit or of another length, and OutputError.
    """
    path = output_path(path, (".mat",))
    known = {**UNITS, **(units or {})}
    arrays = {name: np.asarray(column, dtype=float) for name, column in columns.items()}
    lengths = {name: a.shape[0] if a.ndim else 0 for name, a in arrays.items()}
    if "t" not in arrays or len(set(lengths.values())) != 1:
        raise InputError(
            f"columns have lengths {lengths}; expected 't' and one length for all of them"
        )
    unknown = [name for name in arrays if name not in known]
    if unknown:
        raise InputError(f"columns {unknown} have no unit; give units={{name: unit}} for them")
    about = {"format": FORMAT, "convention": "paper", "note": note}
    write_mat(path, {**about, **arrays}, {name: known[name] for name in arrays})


def read_run(path: Path | str) -> dict[str, Array]:
    """The columns of a file `export_run` wrote, each (K,) or (K, ...). Raises InputError."""
    found = read_mat(path)
    if found.get("format") != FORMAT:
        raise InputError(
            f"run '{path}' has format '{found.get('format')}', expected '{FORMAT}'; write it with export_run"
        )
    if "units" not in found:
        raise InputError(f"run '{path}' ends before its units: it is cut off; copy it again")
    return {name: np.asarray(found[name], dtype=float) for name in found["units"]}
