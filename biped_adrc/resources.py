"""Data: robots (`urdf/`) and gaits (`gaits/`), in the wheel or beside the package in a checkout, and tables."""

from __future__ import annotations

import tomllib
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

_PACKAGE = Path(__file__).resolve().parent


def data_folder(kind: str) -> Path:
    """Folder `kind` ("urdf" or "gaits").

    Raises FileNotFoundError when neither the wheel nor the checkout has it.
    """
    for candidate in (_PACKAGE / "_data" / kind, _PACKAGE.parent / kind):
        if candidate.is_dir():
            return candidate
    raise FileNotFoundError(
        f"the data folder '{kind}' is neither in the installed package nor beside it; "
        "reinstall with 'pip install .'"
    )


@cache
def packaged(package: str, name: str) -> dict[str, Any]:
    """The tables of a TOML file that lies in a package."""
    return tomllib.loads(files(package).joinpath(name).read_text("utf-8"))
