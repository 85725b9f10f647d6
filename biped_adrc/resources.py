"""Data that comes with the package: robots (`urdf/`), gaits (`gaits/`), and tables in TOML files.

In a checkout the data folders lie beside the package; in an installed wheel they are copied to
`_data` inside it. Texts, options, columns and registries are TOML files in the folder of the module
that uses them.
"""

from __future__ import annotations

import tomllib
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

_PACKAGE = Path(__file__).resolve().parent


def data_folder(kind: str) -> Path:
    """The folder of this kind of data, "urdf" or "gaits".

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
    """The content of the TOML file `name` in the folder of `package`, such as "biped_adrc.view"; read once.

    The dict is shared by all callers and must not be changed.
    """
    return tomllib.loads(files(package).joinpath(name).read_text("utf-8"))
