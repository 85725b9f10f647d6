"""A walk as a file, by its suffix: an offline page, a moving picture, or a strip of stick figures."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from biped_adrc.errors import InputError
from biped_adrc.viz.placement import Recorded

SUFFIXES = (".html", ".gif", ".png", ".svg")


def check_suffix(path: Path) -> str:
    """The suffix of `path` in small letters. Raises InputError for one that is not in `SUFFIXES`."""
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise InputError(
            f"cannot write a walk to '{path}': the name ends in '{suffix}', expected .html (a page with "
            "the animation), .gif (a moving picture) or .png or .svg (a strip of stick figures)"
        )
    return suffix


def export(path: Path, walks: Mapping[str, Recorded], view: str = "side") -> None:
    """Write the walks to `path`; a strip shows the last of them. Raises InputError and OutputError."""
    from biped_adrc.viz.meshcat import write_animation

    suffix = check_suffix(path)
    if suffix == ".html":
        write_animation(path, walks, view=view)
