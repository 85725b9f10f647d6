"""Frames as a GIF: small, shown by every page and slide, 64 colours and at most 50 frames a second."""

from __future__ import annotations

import io
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from PIL import Image, ImageColor

from biped_adrc.core.types import Array
from biped_adrc.view.colours import REACTION, TORQUE
from biped_adrc.view.from_the_side import moving_parts as draw
from biped_adrc.view.from_the_side.side_by_side import LINES


def encoded(frames: Sequence[Array], fps: float, rest: float) -> bytes:
    """Frames (height, width, 3) as a GIF with one palette for all, so that colours do not flicker from frame
    to frame.

    The palette is made from every eighth frame and from bands of the colours in use, so that even a
    colour of few pixels has a place in it. fps [1/s]; rest [s]: how much longer the last frame is
    shown.
    """
    images = [Image.fromarray(frame) for frame in frames]
    some = [np.asarray(image)[::3] for image in images[:: max(1, len(images) // 8)]]
    width = some[0].shape[1]
    marked = (
        *draw.COLOURS.values(),
        REACTION,
        TORQUE,
        *LINES,
        "black",
        "white",
    )
    swatches = [ImageColor.getrgb(c) for c in marked]
    band = [np.full((len(some[0]) // 4, width, 3), rgb, dtype=np.uint8) for rgb in swatches]
    palette = Image.fromarray(np.concatenate([*some, *band])).quantize(64)
    reduced = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    buffer = io.BytesIO()
    # [ms], in hundredths of a second
    ends = [10 * round(100.0 * k / fps) for k in range(len(images) + 1)]
    durations = [end - begin for begin, end in pairwise(ends)]
    durations[-1] += round(1000.0 * rest)
    reduced[0].save(
        buffer,
        format="GIF",
        save_all=True,
        append_images=reduced[1:],
        duration=durations,
        loop=0,
        optimize=False,
    )
    return buffer.getvalue()
