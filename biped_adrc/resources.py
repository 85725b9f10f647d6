"""Where the robots (`urdf/`) and gaits (`gaits/`) lie: in the wheel, or beside the package in a checkout."""

from __future__ import annotations

from pathlib import Path

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
