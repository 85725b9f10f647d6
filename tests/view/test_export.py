"""Moving pictures and strips: where they draw the robot, how long they last, that they repeat; notebooks.

The fixture walks has two walks of RABBIT, under NPD and ADRC; fallen(walk, status) is one as if it had ended
so. A Clip is the part that is shown: start and stop [s], frames per second.
"""

from __future__ import annotations

import base64
import html
import io
import re
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from biped_adrc.core.errors import InputError
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Event
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.recording import Walk
from biped_adrc.view.export import export
from biped_adrc.view.from_the_side.moving_picture import (
    encoded,
    moving_figure,
    strip,
    write_moving_picture,
)
from biped_adrc.view.from_the_side.side_view import SideView
from biped_adrc.view.meshcat.view import animation_html
from biped_adrc.view.placement import Clip, WalkScene, ending
from biped_adrc.view.style import new_figure
from tests.commands import command


def test_lines_are_the_limbs(biped: Biped, walks: dict[str, Walk]) -> None:
    """Lengths are those of RABBIT's limbs, 0.4 m, and torso, 0.63 m; ends are those of the biped's own
    kinematics.
    """
    view = SideView(WalkScene.of(walks["NPD"]))
    for t in np.linspace(0.0, walks["NPD"].trajectory.t_end - 1e-9, 7):
        segments = view.segments(float(t))
        lengths = np.hypot(*(segments[:, 1] - segments[:, 0]).T)
        np.testing.assert_allclose(sorted(lengths), [0.4, 0.4, 0.4, 0.4, 0.63], rtol=0.0, atol=1e-9)
        hip, foot = np.split(view.points(float(t)), 2)
        ends = segments.reshape(-1, 2)
        for point in (hip, foot, [view.scene.footholds[view.scene.arc_at(float(t))], 0.0]):
            assert np.min(np.hypot(*(ends - point).T)) < 1e-9
        assert sorted(view.roles(float(t))) == ["", "stance", "stance", "swing", "swing"]


def test_walks_apart_stand_in_panels_of_their_own_with_their_names_and_clocks(walks):
    """There are two panels of half the width, each 1.5 m wide around the hip of its own walk."""
    figure, show = moving_figure(walks, "2 times slower", apart=True)
    show(0.1)
    # left edge and width, as shares of the figure
    assert [axes.get_position().bounds[::2] for axes in figure.axes] == [(0.0, 0.5), (0.5, 0.5)]
    texts = [axes.texts[-1].get_text() for axes in figure.axes]
    assert texts == [f"{name}\nt = 0.10 s, step 1, 2 times slower" for name in walks]
    hips = [np.mean(axes.get_xlim()) for axes in figure.axes]
    assert np.allclose(
        hips,
        # at 0 s, less than 0.1 m behind
        [w.walker.plant.hip(w.trajectory.arcs[0].x[0, :5])[0] for w in walks.values()],
        atol=0.1,
    )
    assert all(np.isclose(np.ptp(axes.get_xlim()), 1.5) for axes in figure.axes)


@pytest.mark.parametrize("apart", [True, False])
def test_the_robots_of_a_moving_picture_are_where_the_walks_are_at_that_time(walks, apart):
    """At 0.1 and at 0.4 s, in panels of their own or over one another, the limbs of each walk are drawn."""
    figure, show = moving_figure(walks, "", apart)
    for t in (0.1, 0.4):
        show(t)
        for k, walk in enumerate(walks.values()):
            drawn = [x for x in figure.axes[k if apart else 0].collections if len(x.get_paths())]
            ends = np.concatenate([path.vertices for x in drawn for path in x.get_paths()])
            limbs = SideView(WalkScene.of(walk)).segments(t).reshape(-1, 1, 2)
            assert np.all(np.min(np.linalg.norm(limbs - ends, axis=2), axis=1) < 1e-9)


def test_a_gif_has_the_frames_of_the_clip_and_equal_bytes_twice(
    walks: dict[str, Walk], tmp_path: Path
) -> None:
    """0.4 s at 20 frames per second are 8 frames of 50 ms, in an endless loop.

    The robot moves: more than 0.2 % of the pixels change by more than 20 of 255. It covers 1 to 60 % of them.
    """
    for name in ("a.gif", "b.gif"):
        write_moving_picture(tmp_path / name, walks, Clip(0.1, 0.5, fps=20.0))
    assert (tmp_path / "a.gif").read_bytes() == (tmp_path / "b.gif").read_bytes()
    with Image.open(tmp_path / "a.gif") as image:
        assert image.n_frames == 8
        assert image.size[0] == 600  # width [px]
        assert image.info["duration"] == 50
        assert image.info["loop"] == 0
        frames = []
        for k in range(image.n_frames):
            image.seek(k)
            frames.append(np.asarray(image.convert("L"), dtype=float))
    for before, after in pairwise(frames):
        assert np.mean(np.abs(before - after) > 20) > 2e-3
    assert all(0.01 < np.mean(frame < 200) < 0.6 for frame in frames)


def test_the_suffix_says_what_is_written_and_what_a_clip_may_ask_for(
    walks: dict[str, Walk], tmp_path: Path
) -> None:
    """The first bytes of each file are those of its format. An unknown suffix, and clips that a format cannot
    have (100 frames per second in a GIF, an end before the start, walks apart on a page), are refused.
    """
    clip = Clip(0.1, 0.2, fps=10.0)
    starts = {"html": b"<!DOCTYPE html>", "gif": b"GIF89a", "png": b"\x89PNG", "svg": b"<?xml"}
    for suffix, start in starts.items():
        export(tmp_path / f"walk.{suffix}", walks, clip)
        assert (tmp_path / f"walk.{suffix}").read_bytes().startswith(start)
    for name, wrong in (
        ("walk.avi", clip),
        ("walk.gif", Clip(fps=100.0)),
        ("walk.gif", Clip(start=0.5, stop=0.1)),
        ("walk.html", Clip(apart=True)),
        ("walk.png", Clip(view="perspective")),  # pictures are from the side
    ):
        with pytest.raises(InputError):
            export(tmp_path / name, walks, wrong)
    with pytest.raises(InputError, match="positive"):
        Clip(slower=0.0)


@pytest.mark.parametrize("fps", [0.1, 29.97, 45.0])
def test_a_gif_goes_at_the_pace_that_is_asked_for(fps: float) -> None:
    """A GIF counts in hundredths of a second: each frame ends within 5 ms of k / fps, as durations differ where
    they have to. The last of the 40 frames is shown 2 s longer.
    """
    frames = [np.full((20, 60, 3), 255, dtype=np.uint8) for _ in range(40)]
    for k, frame in enumerate(frames):
        frame[5:15, k : k + 15] = 0  # a bar that moves, since equal frames would be joined
    with Image.open(io.BytesIO(encoded(frames, fps, 2.0))) as image:
        durations = []
        for k in range(image.n_frames):
            image.seek(k)
            durations.append(image.info["duration"])
    ends = np.cumsum(durations) - [*[0] * 39, 2000]
    assert np.max(np.abs(ends - 1000.0 * np.arange(1, 41) / fps)) <= 5.0 + 1e-9


def fallen(walk: Walk, status: Status, guard: str | None = None) -> Walk:
    """The walk as if it had ended with this status, by this guard."""
    *before, last = walk.trajectory.arcs
    if guard is not None:
        last = replace(last, event=Event(guard, float(last.t[-1]), last.x[-1], None))
    return replace(
        walk, trajectory=replace(walk.trajectory, arcs=(*before, last), status=status, detail="")
    )


def test_an_ending_says_how_when_and_why(walks: dict[str, Walk]) -> None:
    """The reason is the event that ended the walk, or the detail of its status, or the status itself; each
    status that is no success has words.
    """
    walk = walks["NPD"]
    at = f"at {walk.trajectory.t_end:.2f} s"
    assert ending(walk.trajectory) == ""
    fell = fallen(walk, Status.FELL, "hip_too_low").trajectory
    assert ending(fell) == f"fell {at}: hip too low"
    singular = fallen(walk, Status.SINGULAR).trajectory
    assert ending(replace(singular, detail="D_s")) == f"singular {at}: D_s"
    for status in Status:
        if not status.ok:
            words = ending(fallen(walk, status).trajectory)
            assert words.startswith(status.name.lower().replace("_", " "))
            assert "nan" not in words


def test_a_walk_that_fell_has_one_frame_more_which_stays_for_two_seconds(
    walks: dict[str, Walk], tmp_path: Path
) -> None:
    """The last 0.2 s at 10 frames per second, of the walk as it is and as if it had fallen: the end itself is a
    frame more, for 2 s and its own 0.1 s.
    """
    end = walks["NPD"].trajectory.t_end
    frames, durations = {}, {}
    for status in (Status.COMPLETED, Status.FELL):
        walk, path = fallen(walks["NPD"], status, "hip_too_low"), tmp_path / f"{status.name}.gif"
        write_moving_picture(path, {"NPD": walk}, Clip(end - 0.2, fps=10.0))
        with Image.open(path) as image:
            frames[status] = image.n_frames
            image.seek(image.n_frames - 1)
            durations[status] = image.info["duration"]
    assert frames[Status.FELL] == frames[Status.COMPLETED] + 1
    assert (durations[Status.COMPLETED], durations[Status.FELL]) == (100, 2100)


def test_a_strip_says_how_a_walk_ended(walks: dict[str, Walk]) -> None:
    """The title of the strip names the end, but where the strip stops before it (0.4 s); a walk that went well
    has the time between its poses.
    """
    with new_figure(6.0, 4.0) as figure:
        axes = figure.subplots()
        strip(axes, fallen(walks["NPD"], Status.STALLED, "step_too_long"), Clip())
    assert "stalled at" in axes.get_title(loc="left")
    with new_figure(6.0, 4.0) as figure:
        axes = figure.subplots()
        strip(axes, walks["NPD"], Clip(0.0, 1.2))
    assert axes.get_title(loc="left") == "a pose every 100 ms"
    with new_figure(6.0, 4.0) as figure:
        axes = figure.subplots()
        strip(axes, fallen(walks["NPD"], Status.STALLED, "step_too_long"), Clip(0.1, 0.4))
    assert "stalled" not in axes.get_title(loc="left")


def test_the_run_is_drawn_solid_and_its_ghost_behind(
    walks: dict[str, Walk], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is drawn last lies in front. `export` is replaced by a list of what it would draw: the ghost
    (runs[1]) is first, and the run is last.
    """
    drawn: list[str] = []
    monkeypatch.setattr(
        "biped_adrc.view.export.export", lambda path, walks, clip: drawn.extend(walks)
    )
    runs = [str(walk.save(tmp_path / f"{name}.npz")) for name, walk in walks.items()]
    command("animate", runs[0], "--ghost", runs[1], "-o", tmp_path / "a.html")
    assert drawn == [*walks][::-1]


# -- notebooks --------------------------------------------------------------------------------------
def test_a_walk_shows_its_animation_and_its_figures(walks: dict[str, Walk]) -> None:
    """What a notebook shows of a walk: a sentence, the page in a frame of its own, from which it can run
    scripts and nothing else, and one PNG.
    """
    shown = walks["ADRC"]._repr_html_()
    frame = re.search(r'<iframe[^>]*sandbox="allow-scripts"[^>]*srcdoc="([^"]*)"', shown)
    assert frame is not None
    assert html.unescape(frame.group(1)) == animation_html({"ADRC": walks["ADRC"]})
    pictures = re.findall(r'src="data:image/png;base64,([^"]*)"', shown)
    assert [base64.b64decode(p)[:4] for p in pictures] == [b"\x89PNG"]
    assert shown.startswith("<p>ADRC: 3 impacts. COMPLETED")
