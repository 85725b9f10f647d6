"""A walk as a file, by its suffix: an offline page, a moving picture, or a strip of stick figures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from biped_adrc.errors import InputError
from biped_adrc.files import write_text
from biped_adrc.viz.from_the_side.gif import write_gif
from biped_adrc.viz.from_the_side.moving_parts import Motion
from biped_adrc.viz.from_the_side.stick_figures import write_strip
from biped_adrc.viz.meshcat.view import Look, animation_html
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


@dataclass(frozen=True)
class Clip:
    """What part of the walks is shown, and how.

    start, stop [s]: of a moving picture or a strip; the whole walk, or its last two steps for a strip, if None.
    fps [1/s]: 60 for a page and 25 for a moving picture if None. view: "side" or "perspective", of a page.
    apart, magnify, slower: of a moving picture, see `Motion`.
    """

    start: float | None = None
    stop: float | None = None
    fps: float | None = None
    view: str = "side"
    apart: bool = False
    magnify: float | None = None
    slower: float = 1.0

    @property
    def moving(self) -> bool:
        """Whether something is asked for that only a moving picture has."""
        return self.apart or self.magnify is not None or self.slower != 1.0

    def look(self) -> Look:
        """Of a page, or live."""
        return Look(fps=60.0 if self.fps is None else self.fps, view=self.view)

    def motion(self) -> Motion:
        """Of a moving picture. Raises InputError."""
        fps = 25.0 if self.fps is None else self.fps
        width = 800 if self.apart else 600
        return Motion(self.apart, self.magnify, self.slower, fps, width)


def export(path: Path, walks: Mapping[str, Recorded], clip: Clip | None = None) -> None:
    """Write the walks to `path`; a strip shows the last of them. Raises InputError and OutputError."""
    clip = Clip() if clip is None else clip
    suffix = check_suffix(path)
    if not walks:
        raise InputError("there is no walk to draw; expected at least one")
    if suffix != ".gif" and clip.moving:
        raise InputError(
            f"'{path}' is no moving picture, and apart, magnify and slower are of one; write a .gif"
        )
    if suffix == ".html":
        write_text(path, animation_html(walks, clip.look()))
    elif suffix == ".gif":
        write_gif(path, walks, start=clip.start, stop=clip.stop, motion=clip.motion())
    else:
        write_strip(path, list(walks.values())[-1], clip.start, clip.stop)
