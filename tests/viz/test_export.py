"""Moving pictures and strips: where they draw the robot, how long they last, that they repeat."""

from __future__ import annotations

import io
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from PIL import Image
from typer.testing import CliRunner

from biped_adrc.cli import app
from biped_adrc.errors import InputError
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.trajectory import Event
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.recording import Walk
from biped_adrc.viz.export import Clip, export
from biped_adrc.viz.from_the_side import gif
from biped_adrc.viz.from_the_side.moving_parts import Motion, arrow, cut, ring, wrapped
from biped_adrc.viz.from_the_side.moving_picture import _times, write_moving_picture
from biped_adrc.viz.from_the_side.side_view import Deviation, SideView
from biped_adrc.viz.from_the_side.stick_figures import strip, write_strip
from biped_adrc.viz.placement import WalkScene, ending
from biped_adrc.viz.style import new_figure, style


def test_lines_are_the_limbs(biped: Biped, walks: dict[str, Walk]) -> None:
    """Lengths against RABBIT's 0.4 m limbs and 0.63 m torso; ends against the biped's own kinematics."""
    view = SideView(WalkScene.of(walks["NPD"]))
    for t in np.linspace(0.0, walks["NPD"].trajectory.t_end - 1e-9, 7):
        segments = view.segments(float(t))
        lengths = np.hypot(*(segments[:, 1] - segments[:, 0]).T)
        np.testing.assert_allclose(sorted(lengths), [0.4, 0.4, 0.4, 0.4, 0.63], atol=1e-9)
        hip, foot = np.split(view.points(float(t)), 2)
        ends = segments.reshape(-1, 2)
        for point in (hip, foot, [view.scene.footholds[view.scene.arc_at(float(t))], 0.0]):
            assert np.min(np.hypot(*(ends - point).T)) < 1e-9
        assert sorted(view.roles(float(t))) == ["", "stance", "stance", "swing", "swing"]


def test_the_stance_leg_is_the_one_on_the_ground(walks: dict[str, Walk]) -> None:
    view = SideView(WalkScene.of(walks["ADRC"]))
    for i, arc in enumerate(walks["ADRC"].trajectory.arcs):
        t = float(0.5 * (arc.t[0] + arc.t[-1]))
        foot = np.array([view.scene.footholds[i], 0.0])
        near = [
            role
            for role, ends in zip(view.roles(t), view.segments(t), strict=True)
            if np.min(np.hypot(*(ends - foot).T)) < 1e-9
        ]
        assert near == ["stance"]


def test_strip(walks: dict[str, Walk]) -> None:
    with style():
        axes = new_figure(6.0, 4.0).subplots()
        assert strip(axes, walks["NPD"], poses=9) is axes
    drawn = [c for c in axes.collections if isinstance(c, LineCollection)]
    assert len(drawn) == 9 * 3
    names = axes.get_legend_handles_labels()[1]
    assert sorted(names) == ["footprint", "stance leg", "swing leg", "torso"]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x [m]", "z [m]")
    assert axes.get_aspect() == 1.0
    footholds = WalkScene.of(walks["NPD"]).footholds
    prints = next(line for line in axes.get_lines() if line.get_marker() == "^")
    np.testing.assert_array_equal(prints.get_xdata(), footholds[-2:])
    with pytest.raises(InputError, match="at least 2"):
        strip(axes, walks["NPD"], poses=1)
    with pytest.raises(InputError, match="lasts from"):
        strip(axes, walks["NPD"], 0.0, 99.0)


@pytest.mark.parametrize("suffix", ["png", "svg"])
def test_strips_repeat_byte_for_byte(walks: dict[str, Walk], tmp_path: Path, suffix: str) -> None:
    for k in (1, 2):
        write_strip(tmp_path / f"{k}.{suffix}", walks["ADRC"])
    first = (tmp_path / f"1.{suffix}").read_bytes()
    assert first == (tmp_path / f"2.{suffix}").read_bytes()
    if suffix == "png":
        grey = np.asarray(Image.open(io.BytesIO(first)).convert("L"))
        assert 0.01 < np.mean(grey < 200) < 0.5


def test_gif(walks: dict[str, Walk], tmp_path: Path) -> None:
    for name in ("a.gif", "b.gif"):
        write_moving_picture(
            tmp_path / name, walks, start=0.1, stop=0.5, motion=Motion(fps=20.0, width=300)
        )
    assert (tmp_path / "a.gif").read_bytes() == (tmp_path / "b.gif").read_bytes()
    with Image.open(tmp_path / "a.gif") as image:
        assert image.n_frames == 8
        assert image.size[0] == 300
        assert image.info["duration"] == 50
        assert image.info["loop"] == 0
        frames = []
        for k in range(image.n_frames):
            image.seek(k)
            frames.append(np.asarray(image.convert("L"), dtype=float))
    for before, after in pairwise(frames):
        assert np.mean(np.abs(before - after) > 20) > 2e-3
    assert all(0.01 < np.mean(frame < 200) < 0.6 for frame in frames)


def test_arrows_grow_with_the_force() -> None:
    """The head is 9 cm long and 7 cm wide, and of the same shape where the arrow is shorter than that."""
    for length, share in ((0.02, 2 / 9), (0.3, 1.0)):
        outline = arrow(np.zeros(2), np.array([0.0, length]))
        assert outline[:, 1].max() == pytest.approx(length)
        right, tip, left = outline[2:5]
        np.testing.assert_allclose(tip - 0.5 * (left + right), [0.0, 0.09 * share], atol=1e-12)
        np.testing.assert_allclose(right - left, [0.07 * share, 0.0], atol=1e-12)
    small, large = ring(np.zeros(2), 0.1), ring(np.zeros(2), 0.3)
    np.testing.assert_allclose(3.0 * small, large)
    np.testing.assert_allclose(ring(np.zeros(2), -0.1), small * [-1.0, 1.0])


def test_export_goes_by_the_suffix(walks: dict[str, Walk], tmp_path: Path) -> None:
    clip = Clip(0.1, 0.2, fps=10.0)
    starts = {"html": b"<!DOCTYPE html>", "gif": b"GIF89a", "png": b"\x89PNG", "svg": b"<?xml"}
    for suffix, start in starts.items():
        export(tmp_path / f"walk.{suffix}", walks, clip)
        assert (tmp_path / f"walk.{suffix}").read_bytes().startswith(start)
    with pytest.raises(InputError, match=r"expected \.html"):
        export(tmp_path / "walk.avi", walks)
    with pytest.raises(InputError, match="at least one"):
        export(tmp_path / "walk.gif", {})
    with pytest.raises(InputError, match=r"expected 0\.1 to 50"):
        export(tmp_path / "walk.gif", walks, Clip(fps=100.0))
    with pytest.raises(InputError, match="walks last"):
        export(tmp_path / "walk.gif", walks, Clip(start=0.5, stop=0.1))
    with pytest.raises(InputError, match="to draw solid"):
        write_moving_picture(tmp_path / "walk.gif", walks, solid="LQR")
    with pytest.raises(InputError, match=r"ends in \.gif or \.mp4"):
        write_moving_picture(tmp_path / "walk.png", walks)
    with pytest.raises(InputError, match="no moving picture"):
        export(tmp_path / "walk.html", walks, Clip(apart=True))
    for name in ("walk.gif", "walk.png"):
        with pytest.raises(InputError, match="'perspective' is of a page"):
            export(tmp_path / name, walks, Clip(view="perspective"))


@pytest.mark.parametrize("fps", [0.1, 3.0, 29.97, 30.0, 35.0, 40.0, 45.0, 50.0])
def test_a_gif_goes_at_the_pace_that_is_asked_for(fps: float) -> None:
    """Its frames are shown for whole hundredths of a second, which differ where they have to."""
    frames = [np.full((20, 60, 3), 255, dtype=np.uint8) for _ in range(40)]
    for k, frame in enumerate(frames):
        frame[5:15, k : k + 15] = 0
    with Image.open(io.BytesIO(gif.encoded(frames, fps, 2.0))) as image:
        durations = []
        for k in range(image.n_frames):
            image.seek(k)
            durations.append(image.info["duration"])
    ends = np.cumsum(durations) - [*[0] * 39, 2000]
    assert np.max(np.abs(ends - 1000.0 * np.arange(1, 41) / fps)) <= 5.0 + 1e-9


@pytest.mark.parametrize(
    ("stop", "count"), [(0.1 + 1e-7, 2), (0.12, 2), (0.2, 2), (0.25, 3), (0.3, 4)]
)
def test_no_frame_is_behind_the_part_that_is_shown(
    walks: dict[str, Walk], stop: float, count: int
) -> None:
    times = _times(walks, 0.1, stop, Motion(fps=20.0))
    assert len(times) == count
    assert times[0] == 0.1
    assert times[-1] <= stop


def test_words_stay_in_the_picture() -> None:
    said = (
        "NPD ran away at 1.16 s: after t = 1.16139 s: torque [-95487.76286198 -30512.1 8.1 9.5] N m"
    )
    figure = new_figure(3.0, 2.0)
    text = figure.text(0.0, 0.5, wrapped(said, 300.0), fontsize=11)
    canvas = FigureCanvasAgg(figure)
    figure.set_dpi(100)
    assert text.get_window_extent(canvas.get_renderer()).width <= 300.0
    assert wrapped(said, 300.0).replace("\n", " ") == said


@pytest.mark.parametrize("factor", [0.0, 1.0, 30.0])
def test_a_magnified_posture_is_the_reference_and_so_many_times_the_error(
    biped: Biped, walks: dict[str, Walk], factor: float
) -> None:
    walk, names = walks["ADRC"], biped.description.joints
    bent = SideView(WalkScene.of(walk), Deviation.of(walk, factor))
    for arc in walk.trajectory.arcs[:2]:
        k = len(arc.t) // 3
        t, q = float(arc.t[k]), arc.x[k, :5]
        m = walk.walker.measure(t, q, arc.x[k, 5:10], arc.mode)
        q_d = walk.reference(m.t, m.q, m.v).q_d
        drawn = np.append(q_d + factor * (q[:4] - q_d), q[4])
        if arc.mode.step == 2:
            drawn = biped.relabel(drawn)
        values = bent.scene.joints(t, bent.deviation.change(t, arc.mode.step))
        np.testing.assert_allclose([values[name] for name in names], drawn, atol=1e-9)
        if factor == 1.0:
            plain = SideView(WalkScene.of(walk))
            np.testing.assert_allclose(bent.segments(t), plain.segments(t), atol=1e-12)
        # the stance foot stays on the ground
        foot = np.array(bent.scene.foothold(arc.mode.step - 1))
        assert np.min(np.hypot(*(bent.segments(t).reshape(-1, 2) - foot).T)) < 1e-9


def test_a_deviation_at_an_impact_is_that_of_the_step_asked_for(walks: dict[str, Walk]) -> None:
    s, t = walks["ADRC"].signals, float(walks["ADRC"].trajectory.arcs[0].t[-1])
    deviation = Deviation.of(walks["ADRC"], 2.0)
    before, after = s.error[s.step == 1][-1], s.error[s.step == 2][0]
    assert not np.allclose(before, after, rtol=0.1, atol=0.0)
    for step, error in ((1, before), (2, after)):
        np.testing.assert_allclose(deviation.error(t, step), error, rtol=1e-9)
        np.testing.assert_allclose(deviation.change(t, step), error, rtol=1e-9)


def test_walks_side_by_side(walks: dict[str, Walk], tmp_path: Path) -> None:
    motion = Motion(apart=True, magnify=30.0, slower=2.0, fps=10.0, width=400)
    for name in ("a.gif", "b.gif"):
        write_moving_picture(tmp_path / name, walks, start=0.2, stop=0.4, motion=motion)
    assert (tmp_path / "a.gif").read_bytes() == (tmp_path / "b.gif").read_bytes()
    with Image.open(tmp_path / "a.gif") as image:
        assert image.n_frames == 4  # 0.2 s, 10 frames a second, two times slower
        grey = np.asarray(image.convert("L"), dtype=float)
    left, right = grey[:, :200], grey[:, 200:]
    for half in (left, right):
        assert 0.01 < np.mean(half[78:-150] < 200) < 0.5
    for options, text in (
        ({"magnify": 30.0}, "add 'apart'"),
        ({"apart": True, "magnify": -1.0}, "not negative"),
        ({"slower": 0.0}, "slower is 0, expected 0.001"),
        ({"slower": 1e7}, "slower is 1e"),
        ({"fps": 1e-300}, "fps is 1e-300, expected 0.1"),
        ({"fps": float("nan")}, "fps is nan"),
    ):
        with pytest.raises(InputError, match=text):
            write_moving_picture(tmp_path / "c.gif", walks, motion=Motion(**options))


def fallen(walk: Walk, status: Status, guard: str | None = None) -> Walk:
    """The walk as if it had ended so."""
    *before, last = walk.trajectory.arcs
    if guard is not None:
        last = replace(last, event=Event(guard, float(last.t[-1]), last.x[-1], None))
    return replace(
        walk, trajectory=replace(walk.trajectory, arcs=(*before, last), status=status, detail="")
    )


def test_an_ending_says_how_when_and_why(walks: dict[str, Walk]) -> None:
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


@pytest.mark.parametrize("apart", [False, True])
def test_the_last_frame_of_a_walk_that_fell_differs_and_stays(
    walks: dict[str, Walk], tmp_path: Path, apart: bool
) -> None:
    end = walks["NPD"].trajectory.t_end
    frames, durations = {}, {}
    for status in (Status.COMPLETED, Status.FELL):
        walk, path = fallen(walks["NPD"], status, "hip_too_low"), tmp_path / f"{status.name}.gif"
        write_moving_picture(
            path, {"NPD": walk}, start=end - 0.2, motion=Motion(apart=apart, fps=10.0)
        )
        with Image.open(path) as image:
            frames[status] = image.n_frames
            image.seek(image.n_frames - 1)
            durations[status] = image.info["duration"]
    assert frames[Status.FELL] == frames[Status.COMPLETED] + 1
    assert (durations[Status.COMPLETED], durations[Status.FELL]) == (100, 2100)


def test_a_strip_says_how_a_walk_ended(walks: dict[str, Walk]) -> None:
    with style():
        axes = new_figure(6.0, 4.0).subplots()
        strip(axes, fallen(walks["NPD"], Status.STALLED, "step_too_long"))
    assert "stalled at" in axes.get_title(loc="left")
    with style():
        axes = new_figure(6.0, 4.0).subplots()
        strip(axes, walks["NPD"], 0.0, 1.2, poses=13)
    assert axes.get_title(loc="left") == "a pose every 100 ms"
    with style():
        axes = new_figure(6.0, 4.0).subplots()
        strip(axes, fallen(walks["NPD"], Status.STALLED, "step_too_long"), 0.1, 0.4)
    assert "stalled" not in axes.get_title(loc="left")


def test_an_arrow_never_leaves_the_picture() -> None:
    start, x, z = np.array([0.2, 0.0]), (-1.0, 1.0), (-0.12, 1.6)
    short = np.array([0.1, 0.4])
    assert cut(start, short, x, z) is short
    for force in ([3e9, 1e9], [-50.0, 1.0], [0.0, -3.0], [1e-3, 1e150]):
        tip = start + cut(start, np.array(force), x, z)
        assert x[0] < tip[0] < x[1]
        assert z[0] < tip[1] < z[1]
        cosine = np.dot(tip - start, force) / np.linalg.norm(tip - start) / np.linalg.norm(force)
        assert cosine == pytest.approx(1.0)
    np.testing.assert_array_equal(cut(start, np.array([np.nan, np.inf]), x, z), [0.0, 0.0])


def test_every_option_of_the_command_reaches_the_picture(
    walks: dict[str, Walk], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = []
    monkeypatch.setattr("biped_adrc.scenario.stored.load_walks", lambda paths: walks)
    monkeypatch.setattr("biped_adrc.viz.export.export", lambda *given: asked.append(given))
    words = "--from 0.1 --to 0.3 --fps 20 --view perspective --apart --magnify 30 --slower 5"
    command = ["animate", "a.npz", "--ghost", "b.npz", "-o", str(tmp_path / "w.gif")]
    done = CliRunner().invoke(app, [*command, *words.split()])
    assert done.exit_code == 0, done.output
    clip = Clip(0.1, 0.3, 20.0, "perspective", True, 30.0, 5.0)
    assert asked == [(tmp_path / "w.gif", walks, clip)]
    assert list(asked[0][1]) == [*list(walks)[1:], next(iter(walks))], "the first one is solid"
    assert clip.motion() == Motion(True, 30.0, 5.0, 20.0, 800)


def test_a_strip_says_how_far_apart_its_poses_are(walks: dict[str, Walk]) -> None:
    axes = new_figure(8.0, 3.0).subplots()
    strip(axes, walks["NPD"], 0.1, 0.5, poses=5)
    assert "a pose every 100 ms" in axes.get_title(loc="left") + axes.get_title()
