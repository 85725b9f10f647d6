"""The walk in Meshcat: what the page holds, that it stands alone, that it repeats."""

from __future__ import annotations

import base64
import json
import re

import numpy as np
import pinocchio as pin
import pytest
import umsgpack

from biped_adrc.errors import InputError, OutputError
from biped_adrc.model.biped import Biped
from biped_adrc.studies.walk import Walk
from biped_adrc.viz.meshcat import animation_html, frame_times, visual_transform, write_animation
from biped_adrc.viz.placement import Scene

from .pinocchio_view import floating

FPS = 60.0


@pytest.fixture(scope="module")
def page(walks: dict[str, Walk]) -> str:
    return animation_html(walks, fps=FPS)


def scene(text: str) -> tuple[dict[str, object], list[dict]]:
    """The settings of the page and its commands."""
    found = re.search(r'<script type="application/json" id="scene">(.*?)</script>', text, re.DOTALL)
    settings = json.loads(found.group(1))
    commands = [umsgpack.unpackb(base64.b64decode(c)) for c in settings["commands"]]
    return settings, commands


def played(commands: list[dict], robot: str) -> dict[str, list[list[float]]]:
    """Keys of the moving joints of one robot, by joint."""
    animation = next(c for c in commands if c["type"] == "set_animation")
    tracks = {}
    for item in animation["animations"]:
        where = item["path"].split("/")
        assert item["clip"]["fps"] == FPS
        if where[3] == robot:
            keys = item["clip"]["tracks"][0]["keys"]
            assert [key["time"] for key in keys] == list(range(len(keys)))
            tracks[where[-1]] = [key["value"] for key in keys]
    return tracks


@pytest.mark.parametrize("robot", ["NPD", "ADRC"])
def test_the_animation_plays_the_walk(
    biped: Biped, walks: dict[str, Walk], page: str, robot: str
) -> None:
    tracks = played(scene(page)[1], robot)
    walk = Scene.of(walks[robot])
    times = frame_times({n: Scene.of(w) for n, w in walks.items()}, FPS)
    joints = {joint.name: joint for joint in biped.tree.joints}
    assert set(tracks) == {n for n, j in joints.items() if j.type != "fixed"}
    ends = [arc.t[-1] for arc in walks[robot].trajectory.arcs]
    for k, t in enumerate(times):
        values = {}
        for name, keys in tracks.items():
            if joints[name].type == "prismatic":
                values[name] = float(np.array(keys[k]) @ np.array(joints[name].axis))
            else:
                quaternion = pin.Quaternion(np.array(keys[k]))
                values[name] = float(pin.log3(quaternion.matrix()) @ np.array(joints[name].axis))
        at = floating(biped, values)
        i = min(int(np.searchsorted(ends, t, side="right")), len(ends) - 1)
        foot = ("left", "right")[i % 2]
        footprint = np.array([walk.footholds[i], 0.0, 0.0])
        assert np.max(np.abs(at[f"{foot}_foot"][:3, 3] - footprint)) < 1e-4
        lowest = min(at[f"{side}_foot"][2, 3] for side in ("left", "right"))
        assert lowest > -1e-4


def test_primitives_are_those_of_the_urdf(biped: Biped, page: str) -> None:
    commands = scene(page)[1]
    objects = {c["path"]: c["object"] for c in commands if c["type"] == "set_object"}
    matrices = {c["path"]: c["matrix"] for c in commands if c["type"] == "set_transform"}
    visuals = [v for link in biped.tree.links.values() for v in link.visuals]
    drawn = [path for path in objects if "/robots/ADRC/" in path and "visual" in path]
    assert len(drawn) == len(visuals)
    assert len([p for p in objects if "/robots/NPD/" in p and "visual" in p]) == len(visuals)
    thigh = next(p for p in drawn if p.endswith("left_hip/visual_0"))
    cylinder = objects[thigh]["geometries"][0]
    assert (cylinder["type"], cylinder["height"]) == ("CylinderGeometry", 0.4)
    placement = np.array(matrices[thigh]).reshape(4, 4).T
    np.testing.assert_allclose(placement[:3, 1], [0.0, 0.0, 1.0])  # meshcat's axis on the URDF's z
    assert np.linalg.det(placement) == pytest.approx(1.0)
    np.testing.assert_allclose(
        placement, visual_transform(biped.tree.links["left_thigh"].visuals[0])
    )
    assert objects[thigh]["materials"][0]["opacity"] == 1.0
    ghost = thigh.replace("ADRC", "NPD")
    assert 0.0 < objects[ghost]["materials"][0]["opacity"] < 1.0
    assert objects[thigh]["materials"][0]["color"] == 0x0073B2  # rgb 0.00 0.45 0.70 of the URDF


def test_the_page_stands_alone(page: str) -> None:
    assert len(page.encode()) < 4_000_000
    assert "default-src 'none'" in page
    assert not re.search(r"""(src|href)\s*=\s*["']?\s*(https?:)?//""", page)
    outside = set(re.findall(r"https?://[\w./-]+", page))
    assert outside <= {"http://www.w3.org/1999/xhtml"}  # a namespace, never loaded
    settings, commands = scene(page)
    types = [command["type"] for command in commands]
    assert types.count("set_animation") == 1
    assert settings["follow"][:3] == ["meshcat", "robots", "ADRC"]


def test_the_page_repeats_byte_for_byte(biped: Biped, walks: dict[str, Walk], page: str) -> None:
    assert animation_html(walks, fps=FPS) == page


def test_names_and_marks_are_escaped(biped: Biped, walks: dict[str, Walk]) -> None:
    bad = "</script><b>&"
    text = animation_html({bad: walks["NPD"]}, marks=[(0.1, 0.3, bad)], fps=30.0)
    assert "<b>" not in text.split("</style>")[1].split("<script>")[0]
    assert scene(text)[0]["marks"] == [[0.1, 0.3, bad]]


def test_animation_refuses_bad_input(biped: Biped, walks: dict[str, Walk], tmp_path) -> None:
    with pytest.raises(InputError, match="at least one"):
        animation_html({})
    with pytest.raises(InputError, match="choose one of"):
        animation_html(walks, solid="LQR")
    with pytest.raises(InputError, match="fps"):
        animation_html(walks, fps=0.0)
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError):
        write_animation(tmp_path / "file" / "walk.html", walks, fps=10.0)
    write_animation(tmp_path / "walk.html", walks, fps=10.0)
    assert [f.name for f in tmp_path.glob("*.html")] == ["walk.html"]
