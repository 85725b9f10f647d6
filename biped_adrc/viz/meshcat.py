"""Walks in Meshcat: one offline HTML file with the viewer, the robots, the animation and its controls.

The scene mirrors the tree of the URDF, a node per joint, so links stay together between frames. The feet are
points in the model and balls in the URDF: the ground is drawn one radius below z = 0.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from biped_adrc.errors import InputError
from biped_adrc.files import write_text
from biped_adrc.model.biped import Biped
from biped_adrc.model.urdf import Joint, Tree, Visual
from biped_adrc.types import Array
from biped_adrc.viz.meshcat_page import MemoryWindow, page
from biped_adrc.viz.placement import Recorded, Scene, joint_transform

with warnings.catch_warnings():
    # meshcat 0.3.2 imports a deprecated module of pyzmq for the server that is not used here
    warnings.simplefilter("ignore", DeprecationWarning)
    import meshcat
    import meshcat.geometry as shapes

GHOST = 0.35
"""Opacity of a ghost."""
LANE = 0.4
"""[m], by which each ghost walks farther from the camera: faces in one plane flicker."""
TILE = 0.5
"""[m], length of a tile of the ground."""
VIEW = 2.0
"""[m], height of the picture."""

Marks = Sequence[tuple[float, float, str]]


def write_animation(
    path: Path,
    walks: Mapping[str, Recorded],
    solid: str | None = None,
    marks: Marks = (),
    fps: float = 60.0,
) -> None:
    """Write the walks, overlaid, as one HTML file that needs no server and no network.

    solid: name of the walk drawn opaque and followed by the camera, the last one if not given; the others
    are translucent. marks: (start, stop, text) [s], shown beside the clock. fps [1/s]: frames sampled
    from the trajectories. Raises InputError and OutputError.
    """
    write_text(path, animation_html(walks, solid, marks, fps))


def animation_html(
    walks: Mapping[str, Recorded],
    solid: str | None = None,
    marks: Marks = (),
    fps: float = 60.0,
) -> str:
    """The text of the file of `write_animation`; the same walks give the same text."""
    names, solid = _names(walks, solid)
    if not (math.isfinite(fps) and fps > 0):
        raise InputError(f"fps is {fps} frames per second, expected a positive number")
    laid_out = {name: Scene.of(walks[name]) for name in names}
    window = MemoryWindow()
    viewer = meshcat.Visualizer(window=window)
    for lane, name in enumerate(names):
        opacity, biped = 1.0 if name == solid else GHOST, laid_out[name].biped
        robot = viewer[f"robots/{node_name(name)}"]
        robot.set_transform(_shift((0.0, LANE * lane, 0.0)))
        _add_robot(robot, biped.tree, opacity)
        _add_footprints(robot["footprints"], laid_out[name].footholds, _sole(biped), opacity)
    leader = laid_out[solid].biped
    low, high = _range(laid_out.values())
    _add_ground(viewer["ground"], low, high, _sole(leader), LANE * (len(names) - 1))
    _set_stage(viewer)
    window.pack(_animation(laid_out, fps))
    base_x = next(j for j in leader.tree.joints if j.name == leader.description.base[0])
    follow = f"/meshcat/robots/{node_name(solid)}/{_path(leader.tree, base_x)}"
    return page(
        window, " and ".join(walks), _caption(names, solid), follow, [list(m) for m in marks]
    )


def _names(walks: Mapping[str, Recorded], solid: str | None) -> tuple[list[str], str]:
    """The solid walk first, then the ghosts."""
    if not walks:
        raise InputError("there is no walk to animate; expected at least one")
    solid = list(walks)[-1] if solid is None else solid
    if solid not in walks:
        raise InputError(f"there is no walk '{solid}' to draw solid; choose one of {list(walks)}")
    return [solid, *(name for name in walks if name != solid)], solid


def node_name(name: str) -> str:
    """A name as it may stand in a path of the scene."""
    return "".join(c if c.isalnum() else "_" for c in name)


def _caption(names: list[str], solid: str) -> str:
    ghosts = ", ".join(name for name in names if name != solid)
    if not ghosts:
        return f"{solid}."
    return (
        f"{solid}: solid. {ghosts}: translucent, {LANE:g} m farther away; drag to see them apart."
    )


def _path(tree: Tree, joint: Joint) -> str:
    """Path of a joint's node below its robot."""
    above = [j.name for j in tree.path_to_root(joint.parent)]
    return "/".join([*reversed(above), joint.name])


def _shift(origin: Sequence[float]) -> Array:
    M = np.eye(4)
    M[:3, 3] = origin
    return M


# -- objects ---------------------------------------------------------------------------------------
def _add_robot(robot: Any, tree: Tree, opacity: float) -> None:
    """A node per joint at its zero, the primitives of its child below it."""
    for joint in tree.joints:
        node = robot[_path(tree, joint)]
        node.set_transform(joint_transform(joint, 0.0))
        for k, visual in enumerate(tree.links[joint.child].visuals):
            part = node[f"visual_{k}"]
            part.set_object(_shape(visual), _paint(visual.rgba, opacity))
            part.set_transform(visual_transform(visual))


def _shape(visual: Visual) -> Any:
    if visual.shape == "box":
        return shapes.Box(list(visual.size))
    if visual.shape == "sphere":
        return shapes.Sphere(visual.size[0])
    return shapes.Cylinder(visual.size[1], visual.size[0])


def visual_transform(visual: Visual) -> Array:
    """Placement (4, 4) of a primitive in its link; a URDF cylinder lies along z, Meshcat's along y."""
    M = _shift(visual.origin)
    if visual.shape == "cylinder":
        M[:3, :3] = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    return M


def _paint(rgba: Sequence[float], opacity: float) -> Any:
    red, green, blue = (round(255 * c) for c in rgba[:3])
    colour = (red << 16) + (green << 8) + blue
    return shapes.MeshLambertMaterial(color=colour, opacity=opacity * rgba[3])


def _sole(biped: Biped) -> float:
    """Radius of the ball of a foot [m]; 0 for a foot without one."""
    foot = biped.tree.links[biped.description.stance_foot]
    return max((v.size[0] for v in foot.visuals if v.shape == "sphere"), default=0.0)


def _add_footprints(node: Any, footholds: Array, sole: float, opacity: float) -> None:
    """A flat plate under every stance foot."""
    for k, x in enumerate(footholds):
        plate = node[f"{k}"]
        plate.set_object(shapes.Box([0.06, 0.1, 0.004]), _paint((0.1, 0.1, 0.1, 1.0), opacity))
        plate.set_transform(_shift((float(x), 0.0, -sole)))


def _range(walks: Any) -> tuple[int, int]:
    """First and last tile of the ground, two before and three behind the walks."""
    footholds = np.concatenate([walk.footholds for walk in walks])
    low, high = footholds.min() / TILE, footholds.max() / TILE
    return math.floor(low) - 2, math.ceil(high) + 3


def _add_ground(node: Any, low: int, high: int, sole: float, depth: float) -> None:
    """Light and dark tiles of TILE [m]; the top is at z = -sole."""
    for k in range(low, high):
        grey = 0.78 if k % 2 == 0 else 0.62
        tile = node[f"{k - low}"]
        tile.set_object(shapes.Box([TILE, 1.0 + depth, 0.03]), _paint((grey, grey, grey, 1.0), 1.0))
        tile.set_transform(_shift(((k + 0.5) * TILE, 0.5 * depth, -sole - 0.015)))


def _set_stage(viewer: Any) -> None:
    """White background and an orthographic camera at the robot's right side: x to the right, z up."""
    for name in ("/Axes", "/Grid"):
        viewer[name].set_property("visible", False)
    for name in ("top_color", "bottom_color"):
        viewer["/Background"].set_property(name, [1.0, 1.0, 1.0])
    half = 0.5 * VIEW
    camera = shapes.OrthographicCamera(-half, half, half, -half, near=0.1, far=100.0)
    viewer["/Cameras/default/rotated"].set_object(camera)
    # the camera's own frame has y up and z towards the robot's right
    viewer["/Cameras/default/rotated/<object>"].set_property("position", [0.0, 0.7, 8.0])


# -- motion ----------------------------------------------------------------------------------------
def frame_times(walks: Mapping[str, Scene], fps: float) -> Array:
    """Times of the frames (K,) [s], every 1/fps to the end of the longest walk."""
    start = min(walk.trajectory.t_start for walk in walks.values())
    end = max(walk.trajectory.t_end for walk in walks.values())
    return start + np.arange(math.ceil((end - start) * fps) + 1) / fps


def _animation(walks: Mapping[str, Scene], fps: float) -> dict[str, Any]:
    """Meshcat's command: a clip per moving joint; a walk that has ended stays in its last pose."""
    times = frame_times(walks, fps)
    clips = []
    for name, walk in walks.items():
        tree = walk.biped.tree
        frames = [walk.joints(float(t)) for t in times]
        for joint in tree.joints:
            if joint.type == "fixed":
                continue
            values = np.array([frame[joint.name] for frame in frames])
            clip = {"fps": fps, "name": "default", "tracks": [_track(joint, values)]}
            path = f"/meshcat/robots/{node_name(name)}/{_path(tree, joint)}"
            clips.append({"path": path, "clip": clip})
    options = {"play": True, "repetitions": math.inf}
    return {"type": "set_animation", "animations": clips, "options": options, "path": ""}


def _track(joint: Joint, values: Array) -> dict[str, Any]:
    """Keys of one joint, their time counted in frames: quaternion (x, y, z, w), or position [m]."""
    axis = np.array(joint.axis)
    if joint.type == "revolute":
        name, kind = ".quaternion", "quaternion"
        keys = np.column_stack((np.sin(values / 2)[:, None] * axis, np.cos(values / 2)))
    else:
        name, kind = ".position", "vector3"
        keys = np.array(joint.origin) + values[:, None] * axis
    rows = [{"time": k, "value": row} for k, row in enumerate(keys.tolist())]
    return {"name": name, "type": kind, "keys": rows}
