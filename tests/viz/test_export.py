"""Moving pictures and strips: where they draw the robot, how long they last, that they repeat."""

from __future__ import annotations

import io
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from PIL import Image

from biped_adrc.errors import InputError
from biped_adrc.model.biped import Biped
from biped_adrc.studies.walk import Walk
from biped_adrc.viz.export import Clip, export
from biped_adrc.viz.gif import arrow, ring, write_gif
from biped_adrc.viz.placement import Scene
from biped_adrc.viz.side_view import SideView
from biped_adrc.viz.stick import strip, write_strip
from biped_adrc.viz.style import new_figure, style


def test_lines_are_the_limbs(biped: Biped, walks: dict[str, Walk]) -> None:
    """Lengths against RABBIT's 0.4 m limbs and 0.63 m torso; ends against the biped's own kinematics."""
    view = SideView(Scene.of(walks["NPD"]))
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
    view = SideView(Scene.of(walks["ADRC"]))
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
    footholds = Scene.of(walks["NPD"]).footholds
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
        write_gif(tmp_path / name, walks, start=0.1, stop=0.5, fps=20.0, width=300)
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
    for length in (0.02, 0.3):
        outline = arrow(np.zeros(2), np.array([0.0, length]))
        assert outline[:, 1].max() == pytest.approx(length)
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
        export(tmp_path / "walk.mp4", walks)
    with pytest.raises(InputError, match="at least one"):
        export(tmp_path / "walk.gif", {})
    with pytest.raises(InputError, match="at most 50"):
        export(tmp_path / "walk.gif", walks, Clip(fps=100.0))
    with pytest.raises(InputError, match="walks last"):
        export(tmp_path / "walk.gif", walks, Clip(start=0.5, stop=0.1))
    with pytest.raises(InputError, match="to draw solid"):
        write_gif(tmp_path / "walk.gif", walks, solid="LQR")
