"""Versions of what the numbers depend on: Python, packages, and the source of this one, edited or not."""

from __future__ import annotations

import hashlib
import platform
from collections.abc import Iterable, Mapping
from functools import lru_cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from biped_adrc import __version__

SHOWN = ("biped-adrc", "pin", "numpy", "scipy", "meshcat", "matplotlib")
NUMERICAL = (
    "biped-adrc",
    "pin",
    "numpy",
    "scipy",
    "casadi",
    "numba",
    "llvmlite",
    "qpsolvers",
    "daqp",
)
SOURCE = "source of biped-adrc"
NEVER_TRACED = (
    "analysis",
    "bench",
    "campaign",
    "cli",
    "observer_design",
    "paper",
    "scenario",
    "studies",
    "viz",
)
"""Rooms above the engine: code that is made can reach nothing in them but laws that it is given."""


def packages(names: Iterable[str]) -> dict[str, str]:
    """The version of each package, "none" for one that is not there; this one's is its `__version__`."""
    found = {}
    for name in names:
        try:
            found[name] = __version__ if name == "biped-adrc" else version(name)
        except PackageNotFoundError:
            found[name] = "none"
    return found


def differences(found: Mapping[str, str], expected: Mapping[str, str]) -> str:
    """Which versions differ, in words; empty when none does."""
    names = sorted({*found, *expected})
    pairs = [(name, found.get(name), expected.get(name)) for name in names]
    return "; ".join(f"{name} {a} there, {b} here" for name, a, b in pairs if a != b)


def versions() -> dict[str, str]:
    """For records: of Python, the platform and what the numbers depend on."""
    found = {"python": platform.python_version(), "platform": platform.platform()}
    return found | packages(SHOWN)


@lru_cache(maxsize=1)
def numerical_versions() -> Mapping[str, str]:
    """Of all that decides the numbers of a run, with a hash of this package's own lines."""
    source = source_text(Path(__file__).parent)[:12]
    found = {"python": platform.python_version(), "machine": platform.machine(), SOURCE: source}
    return found | packages(NUMERICAL)


def source_text(root: Path, without: tuple[str, ...] = ()) -> str:
    """A hash of every module below `root`, but for those of the folders `without`."""
    digest = hashlib.sha256()
    for path in sorted(root.rglob("*.py")):
        name = path.relative_to(root)
        if name.parts[0] not in without:
            digest.update(str(name).encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()
