"""Frames as a video (H.264 in an .mp4), as slides and players take it; written by PyAV, the extra `video`."""

from __future__ import annotations

import io
from collections.abc import Sequence
from fractions import Fraction
from importlib.util import find_spec

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.types import Array

QUALITY = {"crf": "18", "threads": "1"}
"""Of the encoder x264: no loss that is seen, and the same bytes on any number of cores."""
FINEST = 1000
"""The period of a frame is a fraction [s] with a numerator up to this."""


def check_library() -> None:
    """Raises InputError where PyAV is not installed."""
    if find_spec("av") is None:
        raise InputError(
            "a video (.mp4) needs PyAV, which is not installed; pip install 'biped-adrc[video]', or "
            "write a .gif"
        )


def encoded(frames: Sequence[Array], fps: float, rest: float) -> bytes:
    """Frames (height, width, 3) as a video; sides with an odd number of pixels get one more, as H.264 asks.

    fps [1/s]; rest [s]: how much longer the last frame is shown.
    """
    import av

    rate, buffer = 1 / Fraction(1 / fps).limit_denominator(FINEST), io.BytesIO()
    even = [(0, side % 2) for side in frames[0].shape[:2]]
    with av.open(buffer, "w", format="mp4") as file:
        stream = file.add_stream("libx264", rate=rate, options=QUALITY)
        stream.height, stream.width = (
            n + more for n, (_, more) in zip(frames[0].shape, even, strict=False)
        )
        stream.pix_fmt = "yuv420p"
        for frame in (*frames, *[frames[-1]] * round(rest * fps)):
            pixels = np.pad(frame, (*even, (0, 0)), mode="edge")
            file.mux(stream.encode(av.VideoFrame.from_ndarray(pixels, format="rgb24")))
        file.mux(stream.encode())
    return buffer.getvalue()
