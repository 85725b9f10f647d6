"""A walk as a file; the suffix of its name says what kind.

    .html          an offline page with the animation in Meshcat's viewer (`meshcat.view`)
    .gif           a moving picture from the side (`from_the_side.moving_picture`)
    .png, .svg     a strip of stick figures (`from_the_side.stick_figures`)

`biped-adrc animate` and `Walk.animate` call `export` with a `Clip` of what is to be shown; each of
the three takes of it what it can use, and options that it has no use for are refused.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from biped_adrc.core.errors import InputError
from biped_adrc.core.files import write_text
from biped_adrc.view.from_the_side.moving_parts import Motion
from biped_adrc.view.from_the_side.moving_picture import write_moving_picture
from biped_adrc.view.from_the_side.stick_figures import write_strip
from biped_adrc.view.meshcat.view import Look, animation_html
from biped_adrc.view.placement import Recorded

GIF = ".gif"
SUFFIXES = (".html", GIF, ".png", ".svg")
"""Kinds of files a walk can be drawn to."""


def check_suffix(path: Path) -> str:
    """The suffix of `path` in small letters. Raises InputError for one that is not in `SUFFIXES`.

    Called before a walk is computed or loaded, so that a wrong name costs no time.
    """
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise InputError(
            f"cannot write a walk to '{path}': the name ends in '{suffix}', expected .html (a page with "
            "the animation), .gif (a moving picture) or .png or .svg (a strip of stick figures)"
        )
    return suffix


@dataclass(frozen=True)
class Clip:
    """What part of the walks is shown, and how; None leaves the choice to the kind of file.

    start, stop [s]: the part shown in a moving picture or a strip; None: the whole walk, or its
    last two steps for a strip.
    fps [1/s]: frames per second; None: 60 for a page and 25 for a moving picture.
    view: camera of a page, "side" or "perspective"; all else is from the side.
    apart: moving picture with the walks side by side and their errors below, instead of over one
    another.
    slower [1]: how many times slower than the walk a moving picture plays.
    """

    start: float | None = None
    stop: float | None = None
    fps: float | None = None
    view: str = "side"
    apart: bool = False
    slower: float = 1.0

    @property
    def moving(self) -> bool:
        """Whether something is asked for that only a moving picture has: apart or slower."""
        return self.apart or self.slower != 1.0

    def look(self) -> Look:
        """The settings of a page."""
        return Look(fps=60.0 if self.fps is None else self.fps, view=self.view)

    def motion(self) -> Motion:
        """The settings of a moving picture. Raises InputError for values that do not fit."""
        fps = 25.0 if self.fps is None else self.fps
        width = 800 if self.apart else 600
        return Motion(self.apart, self.slower, fps, width)


def export(path: Path, walks: Mapping[str, Recorded], clip: Clip | None = None) -> None:
    """Write the walks to `path`, as its suffix says; a strip shows the last of them.

    walks: name -> walk; the names are shown. clip: what is shown, the defaults if None. Raises
    InputError for a suffix, a part or an option that does not fit, and OutputError.
    """
    clip = Clip() if clip is None else clip
    suffix = check_suffix(path)
    if not walks:
        raise InputError("there is no walk to draw; expected at least one")
    if suffix != GIF and clip.moving:
        raise InputError(
            f"'{path}' is no moving picture, and apart and slower are of one; write a .gif"
        )
    if suffix != ".html" and clip.view != "side":
        raise InputError(f"'{path}' is seen from the side; view '{clip.view}' is of a page (.html)")
    if suffix == ".html":
        write_text(path, animation_html(walks, clip.look()))
    elif suffix == GIF:
        write_moving_picture(path, walks, start=clip.start, stop=clip.stop, motion=clip.motion())
    else:
        write_strip(path, list(walks.values())[-1], clip.start, clip.stop)
