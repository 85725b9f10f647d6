"""Versions that decide the numbers of a run: Python, packages, and this package's own source.

A report lists versions for the reader (`versions`), and a store of results refuses to mix runs of different
versions (`numerical_versions`, `differences`). A version number alone is not enough for that, as a checkout is
edited between releases: the source is hashed.
"""

import hashlib
import platform
from collections.abc import Iterable, Mapping
from contextlib import suppress
from functools import lru_cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from biped_adrc import __version__

_SHOWN = ("biped-adrc", "pin", "numpy", "scipy", "meshcat", "matplotlib")
"""Packages that a report lists."""
SOURCE = "source of biped-adrc"
"""Name under which the hash of this package's source stands among the versions."""


def packages(names: Iterable[str]) -> dict[str, str]:
    """Installed version of each package by name; "none" for one that is not installed.

    That of this package is its `__version__`.
    """
    result = dict.fromkeys(names, "none")
    for name in result:
        with suppress(PackageNotFoundError):
            result[name] = __version__ if name == "biped-adrc" else version(name)
    return result


def differences(found: Mapping[str, object], expected: Mapping[str, object]) -> str:
    """Text of the entries that differ, those of `found`, such as in a store, as "there" and those of `expected`
    as "here"; empty if there are none.
    """
    names = sorted({*found, *expected})
    pairs = [(name, found.get(name), expected.get(name)) for name in names]
    return "; ".join(f"{name} {a} there, {b} here" for name, a, b in pairs if a != b)


def versions() -> dict[str, str]:
    """Versions for the reader of a report: Python, platform, and the packages `_SHOWN`."""
    result = {"python": platform.python_version(), "platform": platform.platform()}
    return result | packages(_SHOWN)


@lru_cache(maxsize=1)
def numerical_versions() -> Mapping[str, str]:
    """All versions on which the digits of a run depend, with a hash of the source of this package.

    Two runs with equal values of this mapping, on any machine of the same architecture, are comparable.
    Computed once for each process.
    """
    source = source_hash(Path(__file__).parents[1])[:12]
    result = {"python": platform.python_version(), "machine": platform.machine(), SOURCE: source}
    # those packages of `_SHOWN` that do not only draw, and more
    return result | packages((*_SHOWN[:4], "casadi", "llvmlite", "qpsolvers", "daqp"))


def source_hash(root: Path) -> str:
    """SHA-256 in hexadecimal digits over names and contents of Python and LLVM files below `root`, sorted."""
    digest = hashlib.sha256()
    for path in sorted((*root.rglob("*.py"), *root.rglob("*.ll"))):
        digest.update(str(path.relative_to(root)).encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()
