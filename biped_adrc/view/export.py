"""A walk as a file; the suffix of its name says what kind.

    .html          an offline page with the animation in Meshcat's viewer (`meshcat.view`)
    .gif           a moving picture from the side (`from_the_side.moving_picture`)
    .png, .svg     a strip of stick figures (`from_the_side.moving_picture`)

`biped-adrc animate` and `Walk.animate` call `export` with a `Clip`: the part of the walk and how it is shown.
Options of a clip that the kind of file has no use for are refused.
"""

from collections.abc import Mapping
from pathlib import Path

from biped_adrc.core.errors import InputError
from biped_adrc.core.files import output_path, write_text
from biped_adrc.view.from_the_side.moving_picture import write_moving_picture, write_strip
from biped_adrc.view.meshcat.view import animation_html
from biped_adrc.view.placement import Clip, Drawable

SUFFIXES = (".html", ".gif", ".png", ".svg")
"""Kinds of files a walk can be drawn to."""


def export(path: Path, walks: Mapping[str, Drawable], clip: Clip | None = None) -> None:
    """Write the walks to the file `path`, in the kind that its suffix says; a strip shows only the last walk.

    walks: name -> walk, one or more; page and moving picture show the names. clip: the part shown and how, the
    defaults if None. Raises InputError for a suffix, a part or an option that does not fit, and OutputError
    where the file cannot be written.
    """
    clip = Clip() if clip is None else clip
    suffix = output_path(path, SUFFIXES).suffix.lower()
    # whether the clip has options that only a moving picture, or only a page takes
    of_gif, of_page = clip.apart or clip.slower != 1.0, clip.view != "side"
    if (of_gif and suffix != ".gif") or (of_page and suffix != ".html"):
        raise InputError(
            f"'{path}' has apart, slower or view; apart and slower are of a .gif, and view of a .html"
        )
    if suffix == ".html":
        write_text(path, animation_html(walks, clip))
    elif suffix == ".gif":
        write_moving_picture(path, walks, clip)
    else:
        write_strip(path, list(walks.values())[-1], clip)
