"""The walk in Meshcat: what the page holds, that it stands alone, that it repeats.

The fixture walks has two walks of RABBIT, under NPD and ADRC, and page is the HTML of both. scene(page) are its
settings and commands, data(robot) the arrays that the player gets, a row per node: joints, loads (ground
reaction, then a push on each joint), points (hip, swing foot).
"""

from __future__ import annotations

import base64
import json
import re

import numpy as np
import pytest
import umsgpack

from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.npd import NPDController
from biped_adrc.core.errors import InputError
from biped_adrc.disturbances.waves import TorquePulse
from biped_adrc.gait.gait import load_gait
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.walk import walk as walk_of
from biped_adrc.view.meshcat.view import animation_html
from biped_adrc.view.placement import Clip, WalkScene

from .pinocchio_view import floating

FPS = 60.0


@pytest.fixture(scope="module")
def page(walks: dict[str, Walk]) -> str:
    return animation_html(walks, Clip(fps=FPS))


def scene(text: str) -> tuple[dict[str, object], list[dict]]:
    """The settings of the page and its commands."""
    found = re.search(r'<script type="application/json" id="scene">(.*?)</script>', text, re.DOTALL)
    settings = json.loads(found.group(1))
    commands = [umsgpack.unpackb(base64.b64decode(c)) for c in settings["commands"]]
    return settings, commands


def data(walk: dict) -> dict[str, np.ndarray]:
    """The arrays the player is given, a row per node."""
    t = np.frombuffer(base64.b64decode(walk["data"]["t"]), dtype=np.float64)
    flat = {
        name: np.frombuffer(base64.b64decode(walk["data"][name]), dtype=np.float32)
        for name in ("arc", "joints", "rates", "loads", "points", "contact")
    }
    return {"t": t, **{name: values.reshape(len(t), -1) for name, values in flat.items()}}


def robot_of(settings: dict, name: str) -> dict:
    return next(walk for walk in settings["walks"] if walk["name"] == name)


def placed(biped: Biped, walk: dict, values: np.ndarray) -> dict[str, np.ndarray]:
    """Placements by Pinocchio of the joint values the player is given."""
    names = [joint["path"].split("/")[-1] for joint in walk["joints"]]
    return floating(biped, dict(zip(names, map(float, values), strict=True)))


def test_the_animation_plays_the_walk(biped: Biped, walks: dict[str, Walk], page: str) -> None:
    """The joint values in the page are placed by Pinocchio: in each arc the stance foot stands on its foothold,
    no foot is below the ground by more than 0.1 mm, and hip and swing foot are the points that are drawn. The
    feet take turns, left first. Numbers are of single precision, hence 1e-5.
    """
    found = robot_of(scene(page)[0], "ADRC")
    d, walk = data(found), WalkScene.of(walks["ADRC"])
    moving = {j.name for j in biped.tree.joints if j.type != "fixed"}
    assert {joint["path"].split("/")[-1] for joint in found["joints"]} == moving
    arcs = walks["ADRC"].trajectory.arcs
    assert d["t"][0] == arcs[0].t[0]
    assert d["t"][-1] == arcs[-1].t[-1]
    assert np.max(np.diff(d["t"])) <= 1.0 / FPS + 1e-12
    for k, i in enumerate(d["arc"][:, 0].astype(int)):
        at = placed(biped, found, d["joints"][k])
        foot = ("left", "right")[i % 2]
        footprint = np.array([walk.footholds[i], 0.0, 0.0])
        assert np.max(np.abs(at[f"{foot}_foot"][:3, 3] - footprint)) < 1e-5
        lowest = min(at[f"{side}_foot"][2, 3] for side in ("left", "right"))
        assert lowest > -1e-4
        np.testing.assert_allclose(d["points"][k][:2], at["torso"][[0, 2], 3], rtol=0.0, atol=1e-5)
        swing = ("right", "left")[i % 2]
        np.testing.assert_allclose(
            d["points"][k][2:], at[f"{swing}_foot"][[0, 2], 3], rtol=0.0, atol=1e-5
        )


def test_arrows_are_the_loads(walks: dict[str, Walk], page: str) -> None:
    """The ground reaction of the page at its nodes, against that of the walk's signals, interpolated in each
    arc: to 2 %, as both have other nodes. Without a push all other loads are 0.
    """
    walk = walks["NPD"]
    d = data(robot_of(scene(page)[0], "NPD"))
    s = walk.signals
    for arc in range(len(walk.trajectory.arcs)):
        mine, theirs = d["arc"][:, 0] == arc, s.step == arc + 1
        for column in (0, 1):
            expected = np.interp(d["t"][mine], s.t[theirs], s.ground_reaction[theirs][:, column])
            np.testing.assert_allclose(d["loads"][mine][:, column], expected, rtol=0.02, atol=2.0)
    assert not d["loads"][:, 2:].any()  # nobody pushed


def test_a_push_is_drawn_on_the_joint_that_is_pushed(biped: Biped) -> None:
    """The page's loads have the push of step 2 from 0.1 to 0.2 s on its joints, and zero at all other times."""
    gait = load_gait("published", biped)
    push = TorquePulse([30.0, 0.0, -20.0, 0.0, 5.0], step=2, start=0.1, stop=0.2)
    made = walk_of(Walker(biped, NPDController(gait.constraint), push), gait, 2, RK4(2e-3))
    d = data(scene(animation_html({"NPD": made}, Clip(fps=FPS)))[0]["walks"][0])
    zeta, begin = d["loads"][:, 2:], made.trajectory.arcs[1].t[0]
    inside = (d["t"] >= begin + 0.1) & (d["t"] < begin + 0.2)
    assert inside.sum() >= 6  # 0.1 s at 60 frames per second
    # in step 2 the stance leg is the right one: hips and knees are drawn the other way round
    expected = np.tile([0.0, 30.0, 0.0, -20.0, 5.0], (inside.sum(), 1))
    np.testing.assert_array_equal(zeta[inside], expected)
    assert not zeta[~inside].any()


def test_the_page_stands_alone(page: str) -> None:
    """A page of less than 4 MB, which may load nothing (default-src 'none') and has no address but the name of
    a namespace, which is never loaded.
    """
    assert len(page.encode()) < 4_000_000
    assert "default-src 'none'" in page
    assert not re.search(r"""(src|href)\s*=\s*["']?\s*(https?:)?//""", page)
    outside = set(re.findall(r"https?://[\w./-]+", page))
    assert outside <= {"http://www.w3.org/1999/xhtml"}  # a namespace, never loaded
    settings, _ = scene(page)
    assert settings["walks"][0]["name"] == "ADRC"  # the last walk is drawn in front


def test_names_and_marks_are_escaped(biped: Biped, walks: dict[str, Walk]) -> None:
    """A name that would end the script and begin markup is text in the page; the mark comes back unchanged."""
    bad = "</script><b>&"
    text = animation_html({bad: walks["NPD"]}, Clip(fps=30.0), [(0.1, 0.3, bad)])
    # between the styles and the first script
    assert "<b>" not in text.split("</style>")[1].split("<script>")[0]
    assert scene(text)[0]["marks"] == [[0.1, 0.3, bad]]


def test_frame_rates_and_views_that_there_are_not_are_refused(walks: dict[str, Walk]) -> None:
    for values in ({"fps": 0.0}, {"view": "top"}, {"fps": 1e7}):
        with pytest.raises(InputError):
            animation_html(walks, Clip(**values))
