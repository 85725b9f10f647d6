"""MATLAB files (version 5, read by MATLAB and Octave): plain arrays, text, and a `units` struct."""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import loadmat, savemat

from biped_adrc.errors import InputError
from biped_adrc.files import write_bytes

LONGEST_NAME = 31
"""Letters of a variable's name in a .mat file."""


def write_mat(path: Path | str, entries: Mapping[str, Any], units: Mapping[str, str]) -> None:
    """Write numbers, arrays and text under their names; rows of one dimension become columns.

    Raises InputError for a name MATLAB cannot have or an entry without a unit, and OutputError.
    """
    for name, value in entries.items():
        if not (name.isidentifier() and name.isascii() and not name.startswith("_")) or (
            len(name) > LONGEST_NAME
        ):
            raise InputError(
                f"'{name}' cannot be a variable of a .mat file; expected a letter, then letters, digits and "
                f"underscores, at most {LONGEST_NAME}"
            )
        if not isinstance(value, str) and name not in units:
            raise InputError(
                f"'{name}' has no unit; give one for each array, '1' where there is none"
            )
    buffer = io.BytesIO()
    savemat(buffer, {**entries, "units": dict(units)}, oned_as="column")
    write_bytes(Path(path), buffer.getvalue())


def read_mat(path: Path | str) -> dict[str, Any]:
    """The variables of a .mat file; arrays without their dimensions of length 1, structs as dicts.

    Raises InputError for a file that is missing, damaged or of version 7.3.
    """
    path = Path(path)
    if not path.is_file():
        raise InputError(f"MATLAB file '{path}' not found")
    try:
        found = loadmat(io.BytesIO(path.read_bytes()), simplify_cells=True)
    except NotImplementedError as error:
        raise InputError(
            f"MATLAB file '{path}' is of version 7.3 (HDF5), expected 5 or 7; save it again in MATLAB with "
            "save(file, '-v7', ...)"
        ) from error
    except Exception as error:  # a damaged file makes scipy raise errors of many kinds
        raise InputError(f"MATLAB file '{path}' cannot be read: {error}") from error
    return {name: _text(value) for name, value in found.items() if not name.startswith("__")}


def _text(value: Any) -> Any:
    """Text that MATLAB keeps as an array of characters, as str."""
    if isinstance(value, np.ndarray) and value.dtype.kind == "U":
        return "".join(value.ravel().tolist())
    return value
