"""Versions of what the numbers depend on, for records."""

from __future__ import annotations

import platform
from importlib.metadata import version

PACKAGES = ("biped-adrc", "pin", "numpy", "scipy", "meshcat", "matplotlib")


def versions() -> dict[str, str]:
    """Of Python, the platform and what the numbers depend on."""
    found = {"python": platform.python_version(), "platform": platform.platform()}
    return found | {package: version(package) for package in PACKAGES}
