"""Videos: decoded again they are the frames, for as long as asked; without the library a sentence."""

from __future__ import annotations

import io
from fractions import Fraction
from pathlib import Path

import av
import numpy as np
import pytest

from biped_adrc.errors import InputError
from biped_adrc.scenario.recording import Walk
from biped_adrc.types import Array
from biped_adrc.view.export import Clip, check_suffix, export
from biped_adrc.view.from_the_side import mp4


def decoded(data: bytes) -> tuple[Array, Fraction]:
    """Frames (K, height, width, 3) and how long they last [s]."""
    with av.open(io.BytesIO(data)) as file:
        video = file.streams.video[0]
        frames = [frame.to_ndarray(format="rgb24") for frame in file.decode(video)]
        assert video.duration is not None
        return np.array(frames), video.duration * video.time_base


def test_a_walk_is_the_same_picture_as_video_and_as_gif(
    walks: dict[str, Walk], tmp_path: Path
) -> None:
    from PIL import Image

    clip = Clip(0.1, 0.3, fps=20.0, slower=2.0)
    for name in ("w.gif", "w.MP4"):
        export(tmp_path / name, walks, clip)
    found, seconds = decoded((tmp_path / "w.MP4").read_bytes())
    with Image.open(tmp_path / "w.gif") as image:
        assert len(found) == image.n_frames == 8
        assert seconds == Fraction(8, 20)
        for k, frame in enumerate(found):
            image.seek(k)
            drawn = np.asarray(image.convert("RGB"), dtype=int)
            assert np.mean(np.abs(frame[: drawn.shape[0], : drawn.shape[1]] - drawn)) < 6.0


def test_without_the_library_nothing_is_begun(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mp4, "find_spec", lambda name: None)
    with pytest.raises(InputError, match=r"pip install 'biped-adrc\[video\]'"):
        check_suffix(Path("walk.mp4"))
    assert check_suffix(Path("walk.GIF")) == ".gif"
