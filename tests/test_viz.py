"""Figures, the walk in Meshcat, and the report: what they show, that they stand alone, that they repeat."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Mapping

import matplotlib as mpl
import numpy as np
import pinocchio as pin
import pytest
import umsgpack

from biped_adrc.analysis.signals import Signals, signals
from biped_adrc.control.adrc import ADRCController
from biped_adrc.control.npd import NPDController
from biped_adrc.errors import InputError, OutputError
from biped_adrc.gait.gait import load_gait
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.viz.meshcat import animation_html, frame_times, visual_transform, write_animation
from biped_adrc.viz.placement import Walk, joint_values, link_placements
from biped_adrc.viz.plots import (
    multiplier_figure,
    phase_figure,
    push_map_figure,
    return_map_figure,
    tracking_figure,
)
from biped_adrc.viz.report import report_html, write_report
from biped_adrc.viz.robot_figure import direction, robot_figure
from biped_adrc.viz.style import render
from biped_adrc.walker import Mode, Walker

FPS = 60.0


@pytest.fixture(scope="module")
def biped() -> Biped:
    return Biped.load("rabbit")


@pytest.fixture(scope="module")
def runs(biped: Biped) -> dict[str, tuple[Trajectory, Signals]]:
    gait = load_gait("published", biped)
    q, v = gait.start(biped)
    found = {}
    for name, controller, method in (
        ("NPD", NPDController(gait.constraint), RK4(2e-3)),
        ("ADRC", ADRCController(gait.constraint), Exponential(2e-3)),
    ):
        walker = Walker(biped, controller)
        start = walker.initial_state(q, v)
        run = simulate(walker, start, Mode(), method, t_end=3.0, stop_after=("foot_strike", 3))
        found[name] = run, signals(walker, run, gait.constraint)
    return found


@pytest.fixture(scope="module")
def walks(runs: dict[str, tuple[Trajectory, Signals]]) -> dict[str, Trajectory]:
    return {name: run for name, (run, _) in runs.items()}


@pytest.fixture(scope="module")
def page(biped: Biped, walks: dict[str, Trajectory]) -> str:
    return animation_html(biped, walks, fps=FPS)


def floating(biped: Biped, values: Mapping[str, float]) -> dict[str, np.ndarray]:
    """Placements (4, 4) of the links by Pinocchio."""
    model = biped.floating.model
    data = model.createData()
    x = np.zeros(model.nq)
    for name, value in values.items():
        x[model.joints[model.getJointId(name)].idx_q] = value
    pin.framesForwardKinematics(model, data, x)
    return {n: data.oMf[model.getFrameId(n)].homogeneous.copy() for n in biped.tree.links}


# -- kinematics ------------------------------------------------------------------------------------
@pytest.mark.parametrize("step", [1, 2, 7])
def test_links_are_where_pinocchio_puts_them(biped: Biped, step: int) -> None:
    rng = np.random.default_rng(step)
    for _ in range(20):
        q, foothold = rng.uniform(-3.0, 3.0, biped.n), float(rng.uniform(-5.0, 5.0))
        values = joint_values(biped, q, step, foothold)
        ours, theirs = link_placements(biped.tree, values), floating(biped, values)
        for link, placement in theirs.items():
            np.testing.assert_allclose(ours[link], placement, atol=1e-12, err_msg=link)
        stance, swing = ("left", "right") if step % 2 else ("right", "left")
        origin = np.array([foothold, 0.0])
        p_2, hip = biped.swing_foot(q), biped.hip(q)
        np.testing.assert_allclose(ours[f"{stance}_foot"][[0, 2], 3], origin, atol=1e-12)
        np.testing.assert_allclose(ours[f"{swing}_foot"][[0, 2], 3], origin + p_2, atol=1e-12)
        np.testing.assert_allclose(ours["torso"][[0, 2], 3], origin + hip, atol=1e-12)
        thigh = ours[f"{stance}_thigh"][[0, 2], 2]
        np.testing.assert_allclose(thigh, direction(q[4] + q[0]), atol=1e-12)


def test_no_drawn_joint_jumps_at_impact(biped: Biped, walks: dict[str, Trajectory]) -> None:
    walk = Walk.of(biped, walks["NPD"])
    assert len(walk.footholds) == 3
    assert np.all(np.diff(walk.footholds) > 0.2)
    for event in walks["NPD"].events("foot_strike")[:-1]:
        before, after = walk.joints(event.t - 1e-9), walk.joints(event.t + 1e-9)
        assert max(abs(before[name] - after[name]) for name in before) < 1e-6


def test_a_pose_is_held_outside_the_run(biped: Biped, walks: dict[str, Trajectory]) -> None:
    walk = Walk.of(biped, walks["ADRC"])
    assert walk.joints(99.0) == walk.joints(walks["ADRC"].t_end)
    assert walk.joints(-1.0) == walk.joints(0.0)


# -- meshcat ---------------------------------------------------------------------------------------
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
    biped: Biped, walks: dict[str, Trajectory], page: str, robot: str
) -> None:
    tracks = played(scene(page)[1], robot)
    walk = Walk.of(biped, walks[robot])
    times = frame_times({n: Walk.of(biped, w) for n, w in walks.items()}, FPS)
    joints = {joint.name: joint for joint in biped.tree.joints}
    assert set(tracks) == {n for n, j in joints.items() if j.type != "fixed"}
    ends = [arc.t[-1] for arc in walks[robot].arcs]
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


def test_the_page_repeats_byte_for_byte(
    biped: Biped, walks: dict[str, Trajectory], page: str
) -> None:
    assert animation_html(biped, walks, fps=FPS) == page


def test_names_and_marks_are_escaped(biped: Biped, walks: dict[str, Trajectory]) -> None:
    bad = "</script><b>&"
    text = animation_html(biped, {bad: walks["NPD"]}, marks=[(0.1, 0.3, bad)], fps=30.0)
    assert "<b>" not in text.split("</style>")[1].split("<script>")[0]
    assert scene(text)[0]["marks"] == [[0.1, 0.3, bad]]


def test_animation_refuses_bad_input(biped: Biped, walks: dict[str, Trajectory], tmp_path) -> None:
    with pytest.raises(InputError, match="at least one"):
        animation_html(biped, {})
    with pytest.raises(InputError, match="choose one of"):
        animation_html(biped, walks, solid="LQR")
    with pytest.raises(InputError, match="fps"):
        animation_html(biped, walks, fps=0.0)
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError):
        write_animation(tmp_path / "file" / "walk.html", biped, walks, fps=10.0)
    write_animation(tmp_path / "walk.html", biped, walks, fps=10.0)
    assert [f.name for f in tmp_path.glob("*.html")] == ["walk.html"]


# -- figures ---------------------------------------------------------------------------------------
def labels(figure) -> list[tuple[str, str]]:
    return [(axes.get_xlabel(), axes.get_ylabel()) for axes in figure.axes]


def test_tracking_figure(runs: dict[str, tuple[Trajectory, Signals]]) -> None:
    s = runs["NPD"][1]
    figure = tracking_figure(s, "NPD", (0.5, 0.6), 150.0)
    assert len(figure.axes) == 8
    assert [len(axes.get_lines()) for axes in figure.axes[1::2]] == [4, 4, 6, 4]
    units = [y for _, y in labels(figure)][::2]
    assert units[:3] == ["angle [rad]", "angle [rad]", "torque [N m]"]
    assert re.fullmatch(r"tracking error \[(n|µ|m|)rad\]", units[3])
    assert figure.axes[-1].get_xlabel() == "time [s]"
    t, q = figure.axes[0].get_lines()[0].get_data()
    assert np.isnan(q).sum() == 2  # the line breaks at both impacts inside
    np.testing.assert_array_equal(q[~np.isnan(q)], s.q[:, 0])
    assert figure.axes[1].get_xlim()[0] == pytest.approx(0.2)
    assert len(t) == len(s.t) + 2
    assert len(tracking_figure(s, "no push").axes) == 4


def test_phase_figure(runs: dict[str, tuple[Trajectory, Signals]]) -> None:
    figure = phase_figure({name: s for name, (_, s) in runs.items()})
    assert labels(figure)[0] == (r"$\Theta$ [rad]", r"$\dot\Theta$ [rad/s]")
    for axes, (_, s) in zip(figure.axes, runs.values(), strict=True):
        theta, rate = axes.get_lines()[0].get_data()
        np.testing.assert_array_equal(theta[~np.isnan(theta)], s.theta)
        np.testing.assert_array_equal(rate[~np.isnan(rate)], s.dtheta)
        assert len(axes.get_lines()) == 1 + 2 + 1  # the walk, two impacts, the start


def test_multiplier_and_return_map_figures() -> None:
    z = np.array([0.1j, 0.69, -1e-5])
    figure = multiplier_figure({"NPD": z, "ADRC": z[:2]}, published=[0.5, 0.2])
    circle, sizes = figure.axes
    assert [len(axes.get_lines()) for axes in figure.axes] == [3, 4]
    np.testing.assert_allclose(sizes.get_lines()[1].get_ydata(), [0.69, 0.1, 1e-5])
    assert circle.get_aspect() == 1.0
    before = np.linspace(-1.3, -1.2, 5)
    axes = return_map_figure(before, -1.25 + 0.7 * (before + 1.25)).axes[0]
    assert axes.get_lines()[2].get_xdata()[0] == pytest.approx(-1.25)
    assert "[rad/s]" in axes.get_xlabel()


def test_push_map_figure() -> None:
    rows = [
        {
            "onset_ms": o,
            "amplitude": a,
            "pattern": "all +",
            "torque_limit": limit,
            "npd": n,
            "adrc": d,
        }
        for limit in (None, 150.0)
        for o, a, n, d in (
            (0.0, 30.0, True, True),
            (100.0, 30.0, False, True),
            (0.0, 60.0, False, False),
        )
    ]
    figure = push_map_figure(rows)
    assert len(figure.axes) == 2
    assert [len(axes.patches) for axes in figure.axes] == [3, 3]
    assert [patch.get_hatch() for patch in figure.axes[0].patches] == ["", "///", "xxx"]
    assert "unlimited" in figure.axes[0].get_title(loc="left")
    assert "NPD falls 2, ADRC 1 of 3" in figure.axes[1].get_title(loc="left")
    assert figure.axes[0].get_xlabel().endswith("[ms]")
    assert figure.axes[0].get_ylabel().endswith("[N m]")
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert texts == ["both walk", "only NPD falls", "only ADRC falls", "both fall"]
    with pytest.raises(InputError, match="no cells"):
        push_map_figure([])


@pytest.mark.parametrize("pose", ["default", "x*"])
def test_robot_figure_marks_everything_and_labels_stay_apart(biped: Biped, pose: str) -> None:
    gait = load_gait("published", biped)
    figure = robot_figure(biped, None if pose == "default" else gait.q_minus)
    axes = figure.axes[0]
    texts = [text for text in axes.texts if text.get_text()]
    marks = {"$q_1$", "$q_2$", "$q_3$", "$q_4$", "$q_5$", r"$\Theta$", "$p_2$", "$p_e$"}
    assert {text.get_text() for text in texts} == marks
    assert len(axes.patches) >= sum(len(link.visuals) for link in biped.tree.links.values())
    render(figure, "png", dpi=50)
    boxes = [text.get_window_extent() for text in texts]
    assert not [(a, b) for i, a in enumerate(boxes) for b in boxes[:i] if a.overlaps(b)]


def test_figures_repeat_byte_for_byte_and_leave_matplotlib_alone(biped: Biped) -> None:
    settings = dict(mpl.rcParams)
    for kind, start in (("svg", b"<?xml"), ("png", b"\x89PNG")):
        first, second = (render(robot_figure(biped), kind, dpi=40) for _ in range(2))
        assert first == second
        assert first.startswith(start)
    assert dict(mpl.rcParams) == settings
    with pytest.raises(InputError, match="expected 'png' or 'svg'"):
        render(robot_figure(biped), "bmp")


# -- report ----------------------------------------------------------------------------------------
SUMMARY = {
    "preset": "identified",
    "command": "biped-adrc reproduce --out <dir>",
    "versions": {"python": "3.11"},
    "figures_of_merit": [
        {
            "name": "a<b>",
            "published": "1 & 2",
            "measured": "3",
            "verdict": "reproduced",
            "note": '"',
        },
        {"name": "c", "published": "1", "measured": "2", "verdict": "not reproduced", "note": ""},
    ],
    "checks": [
        {"name": "energy", "kind": "law", "value": 1.23456e-12, "limit": "<= 1e-9", "holds": True},
        {"name": "x<y", "kind": "reproduced", "value": "inf", "limit": "<= 1", "holds": False},
    ],
    "tables": {
        "T <1>": {"columns": ["<col>", "v"], "rows": [["<script>alert(1)</script>", [0.5, None]]]}
    },
    "notes": ["<i>note</i>"],
}


def test_report_escapes_and_stands_alone(biped: Biped, tmp_path) -> None:
    svg = render(robot_figure(biped), "svg").decode()
    picture = tmp_path / "p.png"
    picture.write_bytes(render(robot_figure(biped), "png", dpi=30))
    text = report_html(SUMMARY, {"figure1": svg, "<other>": picture})
    assert text == report_html(SUMMARY, {"figure1": svg, "<other>": picture})
    for raw in ("<b>&", "a<b>", "<script", "<col>", "<i>", "x<y", "<dir>", "<other>"):
        assert raw not in text
    assert "&lt;script&gt;alert(1)" in text
    assert not re.search(r"https?:", text)
    assert set(re.findall(r'href="([^"]*)"', text)) == {"walk.html"}
    assert re.findall(r'src="([^;]*;base64),', text) == [
        "data:image/svg+xml;base64",
        "data:image/png;base64",
    ]
    assert text.count("<h1>") == 1
    assert text.count("<th scope") >= 12
    assert text.count("<section>") == text.count("</section>")


def test_report_states_the_verdicts(tmp_path) -> None:
    write_report(tmp_path / "report.html", SUMMARY, {}, animation=None)
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "1 of 2 checks hold" in text
    assert "✗ does not hold" in text
    assert "✓ reproduced" in text
    assert "✗ not reproduced" in text
    assert "1.235e-12" in text
    assert "0.5, –" in text
    assert "href" not in text
    with pytest.raises(InputError, match="neither PNG nor SVG"):
        report_html(SUMMARY, {"f": "a drawing"})
