"""Objects of the scene in Meshcat: robots from their URDF, ground, footprints, traces, arrows, cameras.

Meshcat's scene is a tree of nodes with paths; an object hangs at a node and moves with it. The tree
here mirrors that of the URDF, a node for each joint. The player, player.js in the page, moves, scales, fills in
and colours at run time what is drawn here once: a link by one joint value, so links stay together between
frames. Every `add_` function draws below its argument `node`; `MemoryWindow` stands in for Meshcat's window and
collects the commands that draw; `view` writes them into the page.
Lengths are in [m]. y points away from the camera; a placement is a homogeneous transform (4, 4).

The feet are points in the model and balls in the URDF: the ground is drawn one radius below the footholds, the
places where stance feet stand. A rimless wheel has spokes in place of legs. q are the robot's coordinates.
"""

import base64
import itertools
import math
import random
import re
import uuid
import warnings
from collections import defaultdict
from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
import umsgpack  # type: ignore[import-untyped]

from biped_adrc.core.types import Array
from biped_adrc.model.biped import Biped
from biped_adrc.model.robots.urdf import Joint, Tree, Visual
from biped_adrc.view.colours import bent_arrow
from biped_adrc.view.placement import TILE, WalkScene, joint_transform, placed, spokes, turn

with warnings.catch_warnings():
    # meshcat 0.3.2 imports a deprecated module of pyzmq for the server that is not used here
    warnings.simplefilter("ignore", DeprecationWarning)
    import meshcat
    import meshcat.geometry as shapes

_UUID = re.compile(rb"[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}")
DARK = (0.1, 0.1, 0.1)
"""Colour (red, green, blue) of footprints and of the hip's trace."""
_Colour = str | tuple[float, float, float] | tuple[float, float, float, float]
"""Red, green, blue in 0..1, perhaps with opacity, or "#RRGGBB"."""
VIEW = 2.0
"""Height [m] of the picture from the side."""
HEAD = 0.09
"""Length [m] of the head of an arrow."""


SceneNode: TypeAlias = meshcat.Visualizer
"""A node of Meshcat's tree; `node[path]` is one below it."""


def paint(rgb: _Colour, opacity: float = 1.0) -> object:
    """Meshcat's material of one colour and opacity (0 to 1); an opacity in `rgb` itself does not count."""
    return shapes.MeshLambertMaterial(color=colour(rgb), opacity=opacity)


def colour(rgb: _Colour) -> int:
    """Convert a colour to Meshcat's whole number 0xRRGGBB; an opacity in it is left out."""
    if isinstance(rgb, str):
        return int(rgb[1:], 16)
    return int.from_bytes(round(255 * c) for c in rgb[:3])


# -- robot -----------------------------------------------------------------------------------------
def joint_path(tree: Tree, joint: Joint) -> str:
    """Path of a joint's node below that of its robot: the names of all joints from the base to it."""
    above = [j.name for j in tree.path_to_root(joint.parent)]
    return "/".join([*reversed(above), joint.name])


def add_robot(node: SceneNode, biped: Biped, opacity: float) -> None:
    """Draw a robot: a node for each joint, at joint value 0, with the shapes of its child link below it.

    opacity: 0 to 1, times that of each shape. The player moves the joints. The shapes of a wheel are drawn once
    for every spoke; one at the joint's own origin, the hub, once.
    """
    tree = biped.tree
    for joint in tree.joints:
        here = node[joint_path(tree, joint)]
        here.set_transform(joint_transform(joint, 0.0))
        for k, visual in enumerate(tree.links[joint.child].visuals):
            # spokes: rotations of the drawn spoke to each one, for legs the identity alone
            for i, R in enumerate(spokes(biped) if any(visual.origin) else [np.eye(3)]):
                # the first has the name that `visual_links` returns, by which the player finds it
                part = here[f"visual_{k}" if i == 0 else f"visual_{k}_spoke_{i}"]
                part.set_object(_shape(visual), paint(visual.rgba, opacity * visual.rgba[3]))
                # UPRIGHT: turns Meshcat's cylinders, along y, to z as in the URDF
                upright = UPRIGHT if visual.shape == "cylinder" else np.eye(3)
                part.set_transform(placed(R=R) @ placed(visual.origin, upright))


def _shape(visual: Visual) -> object:
    """Convert a primitive of the URDF to Meshcat's shape; Meshcat's cylinders are along y, not z."""
    if visual.shape == "box":
        return shapes.Box(list(visual.size))
    if visual.shape == "sphere":
        return shapes.Sphere(visual.size[0])
    return shapes.Cylinder(visual.size[1], visual.size[0])


UPRIGHT = turn((1.0, 0.0, 0.0), 0.5 * math.pi)
"""(3, 3): turns y, the axis of Meshcat's cylinders, to z, that of the URDF's."""


def visual_links(tree: Tree) -> list[tuple[str, str]]:
    """(path below the robot's node, name of the link) of every primitive; a wheel has those of one
    spoke, as its URDF draws one alone."""
    return [
        (f"{joint_path(tree, joint)}/visual_{k}", joint.child)
        for joint in tree.joints
        for k in range(len(tree.links[joint.child].visuals))
    ]


def sole(biped: Biped) -> float:
    """Radius [m] of the ball that the URDF draws as a foot; 0 for a foot without one."""
    foot = biped.tree.links[biped.description.stance_foot]
    return max((v.size[0] for v in foot.visuals if v.shape == "sphere"), default=0.0)


# -- what surrounds it -----------------------------------------------------------------------------
def add_footprints(node: SceneNode, scene: WalkScene, depth: float, opacity: float) -> None:
    """Draw a flat plate under every stance foot; the name of its node is the index of the foothold.

    depth [m]: of the plates below the footholds. opacity: 0 to 1.
    """
    for k in range(len(scene.footholds)):
        plate = node[f"{k}"]
        plate.set_object(shapes.Box([0.06, 0.1, 0.004]), paint(DARK, opacity))
        plate.set_transform(under(scene.foothold(k), scene.walker.ground_slope, depth))


def under(point: Sequence[float], slope: float, depth: float, side: float = 0.0) -> Array:
    """Placement (4, 4) of an object that lies along the ground, `depth` [m] below a point (x, z) [m] of it,
    measured perpendicular to the ground.

    slope [rad]: of the ground, positive downhill. side [m]: y of the object.
    """
    R = turn((0.0, 1.0, 0.0), slope)
    return placed(np.array([point[0], side, point[1]]) - depth * R[:, 2], R)


def add_trace(node: SceneNode, points: int, rgb: _Colour, opacity: float) -> None:
    """Add an empty line of this colour and opacity (0 to 1) for as many points; the player fills it in."""
    # both ends of each segment between two points; at least one segment
    room = np.zeros((3, 2 * max(points - 1, 1)), dtype=np.float32)
    material = shapes.LineBasicMaterial(color=colour(rgb), opacity=opacity)
    node.set_object(shapes.LineSegments(shapes.PointsGeometry(room), material))


def add_arrow(node: SceneNode, rgb: _Colour, opacity: float) -> None:
    """Draw an arrow along z: a shaft of length 1 m and a head of length `HEAD`, both from z = 0. The player
    turns it, scales the shaft and moves the head to its end.
    """
    shaft, head = node["shaft"]["body"], node["head"]["body"]
    # height and radius [m]; `placed` lifts each by half its height, as the origin of a cylinder is its middle
    shaft.set_object(shapes.Cylinder(1.0, 0.012), paint(rgb, opacity))
    # UPRIGHT: turns Meshcat's cylinders, along y, to z
    shaft.set_transform(placed((0.0, 0.0, 0.5), UPRIGHT))
    head.set_object(shapes.Cylinder(HEAD, radiusTop=0.0, radiusBottom=0.035), paint(rgb, opacity))
    head.set_transform(placed((0.0, 0.0, 0.5 * HEAD), UPRIGHT))


def add_ring(node: SceneNode, origin: Sequence[float], rgb: _Colour, opacity: float) -> None:
    """Draw a bent arrow of radius 1 m about `origin` (3,) [m] in the x-z plane, counter-clockwise as q.

    The player scales its node `turn` by the torque; a negative torque mirrors it.
    """
    node.set_transform(placed(origin))
    # 63 points: outer rim, head of three points, inner rim backwards
    outline = bent_arrow(1.0)
    # the rim in triangles, point k of its outer side beside last - k of its inner; and the head, a triangle
    last, n = len(outline) - 1, len(outline) // 2 - 1
    k = np.arange(n - 1)
    rim = np.column_stack((last - k, last - k - 1, k, last - k - 1, k + 1, k)).reshape(-1, 3)
    # vertices (x, 0, z), and triangles as indices of these
    mesh = np.insert(outline, 1, 0.0, axis=1), np.vstack((rim, (n + 2, n, n + 1)))
    node["turn"]["body"].set_object(shapes.TriangularMeshGeometry(*mesh), paint(rgb, opacity))


def add_ground(node: SceneNode, scenes: Sequence[WalkScene], depth: float, lane: float) -> None:
    """Draw light and dark tiles, from two before to three behind the walks, `depth` [m] below their footholds.

    Walk k is at y = k lane, lane in [m]; each has its own ground, which reaches half way to its neighbours, and
    0.5 m beyond the first and the last walk.
    """
    x = np.concatenate([scene.footholds for scene in scenes])
    low, high = math.floor(x.min() / TILE) - 2, math.ceil(x.max() / TILE) + 3
    last, names = len(scenes) - 1, itertools.count()
    for k, scene in enumerate(scenes):
        near = -0.5 if k == 0 else (k - 0.5) * lane
        far = last * lane + 0.5 if k == last else (k + 0.5) * lane
        # thick enough to reach the lower ground beside the highest step
        thick = 0.03 + float(np.max(np.abs(scene.surface.drops), initial=0.0))
        # tiles: of each one x and z of both ends (2, 2) [m], and whether it is a light one
        for ends, light in scene.surface.tiles(low, high):
            grey = 0.78 if light else 0.62
            size = [float(np.hypot(*(ends[1] - ends[0]))), far - near, thick]
            slab, middle = node[f"{next(names)}"], ends.mean(axis=0)
            slab.set_object(shapes.Box(size), paint((grey, grey, grey)))
            below, side = depth + 0.5 * thick, 0.5 * (near + far)
            slab.set_transform(under(middle, scene.surface.slope, below, side))


def set_stage(viewer: SceneNode) -> None:
    """Set a white background, and hide Meshcat's axes and grid."""
    for name in ("/Axes", "/Grid"):
        viewer[name].set_property("visible", False)
    for name in ("top_color", "bottom_color"):
        viewer["/Background"].set_property(name, [1.0, 1.0, 1.0])


def camera(kind: str, scale: float) -> dict[str, object]:
    """Commands, position and target [m] of a camera, for player.js.

    kind: "side", at the robot's right side with x to the right and z up, or "perspective", before it. scale
    [1]: how much larger the robot is than RABBIT, for which the lengths here are. Position and target, the
    point looked at, are in the camera's own frame: x forwards, y up, z towards the robot's right.
    """
    window = MemoryWindow(kind)
    node = window.viewer[f"/Cameras/{kind}/rotated"]
    # UPRIGHT: turns y to z; VIEW: height of the picture [m]
    node.set_transform(placed(R=UPRIGHT))
    if kind == "side":
        # all is multiplied by `scale` below, the distance of 8 m is not: it has no effect on a parallel view
        half, position, target = 0.5 * VIEW * scale, [0.0, 0.7, 8.0 / scale], [0.0, 0.7, 0.0]
        node.set_object(shapes.OrthographicCamera(-half, half, half, -half, near=0.1, far=100.0))
    else:
        position, target = [1.7, 1.3, 2.6], [0.1, 0.6, 0.0]
        node.set_object(shapes.PerspectiveCamera(fov=40.0, near=0.05, far=100.0))
    position, target = ([scale * c for c in place] for place in (position, target))
    return {"commands": window.packed, "position": position, "target": target}


class MemoryWindow:
    """A stand-in for Meshcat's window that keeps the commands; it opens no port and starts no process.

    seed: the names of objects are drawn from it, see `send`.
    """

    def __init__(self, seed: str = "scene") -> None:
        self.packed: list[str] = []
        """The commands in base64."""
        self.viewer = meshcat.Visualizer(window=self)
        """Meshcat's tree of nodes."""
        source = random.Random(seed)
        # a name of Meshcat's -> the one from the seeded source that replaces it at every use
        self._names = defaultdict[bytes, bytes](
            lambda: str(uuid.UUID(int=source.getrandbits(128), version=4)).encode()
        )

    def send(self, command: Any) -> None:
        """Store a command of Meshcat, packed as its viewer expects it; `lower` is the command's own method that
        makes it a dictionary. Meshcat calls this for whatever is done to a node.

        Meshcat names objects by clock and host (uuid1). Here names come from a seeded source in the order of
        their first use, of the same length, so that the same walk gives the same bytes on any machine.
        """
        packed = _UUID.sub(lambda found: self._names[found[0]], umsgpack.packb(command.lower()))
        self.packed.append(base64.b64encode(packed).decode("ascii"))
