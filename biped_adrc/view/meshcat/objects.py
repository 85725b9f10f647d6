"""Objects of the scene in Meshcat: robots from their URDF, ground, footprints, traces, arrows, cameras.

Meshcat's scene is a tree of nodes with paths; an object hangs at a node and moves with it. The tree
here mirrors that of the URDF, a node for each joint, so the player moves a link by one joint value
and links stay together between frames. Every `add_` function draws below the node it is given;
`MemoryWindow` collects the commands that come of it, and `view` writes them into the page.

The feet are points in the model and balls in the URDF: the ground is drawn one radius below the
footholds.
"""

from __future__ import annotations

import base64
import itertools
import math
import random
import re
import uuid
import warnings
from collections.abc import Iterator, Sequence
from typing import Protocol

import numpy as np
import umsgpack  # type: ignore[import-untyped]
from numpy.typing import NDArray

from biped_adrc.core.types import Array
from biped_adrc.model.biped import Biped
from biped_adrc.model.robots.urdf import Joint, Tree, Visual
from biped_adrc.view.placement import TILE, WalkScene, joint_transform, legs, spokes, turn

with warnings.catch_warnings():
    # meshcat 0.3.2 imports a deprecated module of pyzmq for the server that is not used here
    warnings.simplefilter("ignore", DeprecationWarning)
    import meshcat
    import meshcat.geometry as shapes

_UUID = re.compile(rb"[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}")
DARK = (0.1, 0.1, 0.1)
"""Red, green, blue of footprints and of the hip's trace."""
Colour = str | tuple[float, float, float] | tuple[float, float, float, float]
"""Red, green, blue in 0..1, perhaps with opacity, or "#RRGGBB"."""
VIEW = 2.0
"""Height [m] of the picture from the side."""
HEAD = 0.09
"""Length [m] of the head of an arrow."""


class SceneNode(Protocol):
    """A node of Meshcat's tree; `node[path]` is one below it. meshcat has no types of its own."""

    def __getitem__(self, path: str) -> SceneNode: ...
    def set_object(self, geometry: object, material: object = ...) -> None: ...
    def set_transform(self, matrix: Array) -> None: ...
    def set_property(self, key: str, value: object) -> None: ...


class MeshcatCommand(Protocol):
    """A command that meshcat sends to a viewer; `lower` gives it as plain values."""

    def lower(self) -> dict[str, object]: ...


def shift(origin: Sequence[float]) -> Array:
    """Placement (4, 4) of a translation by `origin` (3,) [m]."""
    M = np.eye(4)
    M[:3, 3] = origin
    return M


def rotation(R: Array) -> Array:
    """Placement (4, 4) of a rotation by R (3, 3)."""
    M = np.eye(4)
    M[:3, :3] = R
    return M


def paint(rgb: Colour, opacity: float = 1.0) -> object:
    """A material of one colour, for Meshcat."""
    return shapes.MeshLambertMaterial(color=colour(rgb), opacity=opacity)


def colour(rgb: Colour) -> int:
    """The colour as Meshcat has it, 0xRRGGBB."""
    red, green, blue = (
        (round(255 * c) for c in rgb[:3]) if isinstance(rgb, tuple) else bytes.fromhex(rgb[1:])
    )
    return red << 16 | green << 8 | blue


# -- robot -----------------------------------------------------------------------------------------
def joint_path(tree: Tree, joint: Joint) -> str:
    """Path of a joint's node below that of its robot: the names of all joints from the base to it."""
    above = [j.name for j in tree.path_to_root(joint.parent)]
    return "/".join([*reversed(above), joint.name])


def add_robot(node: SceneNode, biped: Biped, opacity: float) -> None:
    """Draw a robot: a node for each joint, at joint value 0, with the primitives of its child below it.

    The player moves the joints. The primitives of a wheel are drawn once for every spoke; one at
    the joint's own origin, the hub, once.
    """
    tree = biped.tree
    for joint in tree.joints:
        here = node[joint_path(tree, joint)]
        here.set_transform(joint_transform(joint, 0.0))
        for k, visual in enumerate(tree.links[joint.child].visuals):
            for i, R in enumerate(spokes(biped) if any(visual.origin) else [np.eye(3)]):
                part = here[f"visual_{k}" if i == 0 else f"visual_{k}_spoke_{i}"]
                part.set_object(_shape(visual), paint(visual.rgba, opacity * visual.rgba[3]))
                part.set_transform(rotation(R) @ visual_transform(visual))


def _shape(visual: Visual) -> object:
    """A primitive of the URDF as a shape of Meshcat's."""
    if visual.shape == "box":
        return shapes.Box(list(visual.size))
    if visual.shape == "sphere":
        return shapes.Sphere(visual.size[0])
    return shapes.Cylinder(visual.size[1], visual.size[0])


def visual_transform(visual: Visual) -> Array:
    """Placement (4, 4) of a primitive in its link; a URDF cylinder lies along z, Meshcat's along y."""
    return shift(visual.origin) @ (UPRIGHT if visual.shape == "cylinder" else np.eye(4))


UPRIGHT = np.array(
    [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
)
"""(4, 4): turns y, the axis of Meshcat's cylinders, to z."""


def leg_visuals(biped: Biped) -> list[list[str]]:
    """Paths below the robot of the parts of the leg that is stance leg in odd steps, and of the other.

    The player gives them their colours, which change over at impact.
    """
    drawn = visual_links(biped.tree)
    return [[path for path, link in drawn if link in leg] for leg in legs(biped)]


def visual_links(tree: Tree) -> list[tuple[str, str]]:
    """(path below the robot, link) of every primitive."""
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
def add_footprints(node: SceneNode, scene: WalkScene, depth: float, opacity: float) -> list[str]:
    """Draw a flat plate under every stance foot; returns the names of their nodes, in order."""
    for k in range(len(scene.footholds)):
        plate = node[f"{k}"]
        plate.set_object(shapes.Box([0.06, 0.1, 0.004]), paint(DARK, opacity))
        plate.set_transform(under(scene.foothold(k), scene.walker.slope, depth))
    return [f"{k}" for k in range(len(scene.footholds))]


def under(point: Sequence[float], slope: float, depth: float, side: float = 0.0) -> Array:
    """Placement (4, 4) of what lies along the ground, `depth` [m] below the point (x, z) of its surface.

    slope [rad], positive downhill; side [m], away from the camera.
    """
    R = turn((0.0, 1.0, 0.0), slope)
    return shift((point[0], side, point[1])) @ rotation(R) @ shift((0.0, 0.0, -depth))


def add_trace(node: SceneNode, points: int, rgb: Colour, opacity: float) -> None:
    """Make room for a line of `points` points; the player fills it."""
    room = np.zeros((3, 2 * max(points - 1, 1)), dtype=np.float32)
    material = shapes.LineBasicMaterial(color=colour(rgb), opacity=opacity)
    node.set_object(shapes.LineSegments(shapes.PointsGeometry(room), material))


def add_arrow(node: SceneNode, rgb: Colour, opacity: float) -> None:
    """Draw an arrow along z: a shaft of length 1 m and a head of length `HEAD`, to be scaled by the player."""
    shaft, head = node["shaft"]["body"], node["head"]["body"]
    shaft.set_object(shapes.Cylinder(1.0, 0.012), paint(rgb, opacity))
    shaft.set_transform(shift((0.0, 0.0, 0.5)) @ UPRIGHT)
    head.set_object(shapes.Cylinder(HEAD, radiusTop=0.0, radiusBottom=0.035), paint(rgb, opacity))
    head.set_transform(shift((0.0, 0.0, 0.5 * HEAD)) @ UPRIGHT)


def add_ring(node: SceneNode, origin: Sequence[float], rgb: Colour, opacity: float) -> None:
    """Draw a bent arrow of radius 1 m about `origin` (3,) [m] in the x-z plane, counter-clockwise as q.

    The player scales its node `turn` by the torque; a negative one turns it round.
    """
    node.set_transform(shift(origin))
    vertices, faces = ring_mesh()
    node["turn"]["body"].set_object(
        shapes.TriangularMeshGeometry(vertices, faces), paint(rgb, opacity)
    )


def ring_mesh(width: float = 0.12, segments: int = 40) -> tuple[Array, NDArray[np.int_]]:
    """Vertices (V, 3) and faces (F, 3) of a flat bent arrow over 300 degrees, its head at the end."""
    angle = np.linspace(math.radians(-60.0), math.radians(200.0), segments)
    rim = np.column_stack((np.cos(angle), np.zeros(segments), np.sin(angle)))
    vertices = np.vstack(((1.0 - width) * rim, (1.0 + width) * rim))
    k = np.arange(segments - 1)
    faces = np.vstack(
        (
            np.column_stack((k, k + 1, k + segments)),
            np.column_stack((k + 1, k + 1 + segments, k + segments)),
        )
    )
    end, tip = angle[-1], math.radians(240.0)
    head = [
        [r * math.cos(a), 0.0, r * math.sin(a)]
        for r, a in ((1.0 - 2.5 * width, end), (1.0 + 2.5 * width, end), (1.0, tip))
    ]
    faces = np.vstack((faces, [[len(vertices), len(vertices) + 1, len(vertices) + 2]]))
    return np.vstack((vertices, head)), faces


def add_ground(node: SceneNode, scenes: Sequence[WalkScene], depth: float, lane: float) -> None:
    """Draw light and dark tiles, from two before to three behind the walks, `depth` [m] below their footholds.

    Walks on the same ground share it; on different grounds each has its own, as wide as its lane
    [m].
    """
    x = np.concatenate([scene.footholds for scene in scenes])
    low, high = math.floor(x.min() / TILE) - 2, math.ceil(x.max() / TILE) + 3
    lines = {scene.surface.line(low * TILE, high * TILE).tobytes() for scene in scenes}
    shared, last = len(lines) == 1, len(scenes) - 1
    names = itertools.count()
    for k, scene in enumerate(scenes[:1] if shared else scenes):
        near = -0.5 if k == 0 else (k - 0.5) * lane
        far = last * lane + 0.5 if shared or k == last else (k + 0.5) * lane
        _add_strip(node, names, scene, (low, high), depth, (near, far))


def _add_strip(
    node: SceneNode,
    names: Iterator[int],
    scene: WalkScene,
    reach: tuple[int, int],
    depth: float,
    sides: tuple[float, float],
) -> None:
    """Draw the tiles of one ground, thick enough to reach the lower ground beside the highest step.

    names: numbers for the nodes. reach: first and last tile. sides [m]: near and far edge, from the
    first walk's plane.
    """
    near, far = sides
    thick = 0.03 + float(np.max(np.abs(scene.surface.drops), initial=0.0))
    for tile in scene.surface.tiles(*reach):
        grey = 0.78 if tile.even else 0.62
        size = [float(np.hypot(*(tile.ends[1] - tile.ends[0]))), far - near, thick]
        slab = node[f"{next(names)}"]
        slab.set_object(shapes.Box(size), paint((grey, grey, grey)))
        middle = tile.ends.mean(axis=0)
        slab.set_transform(
            under(middle, scene.surface.slope, depth + 0.5 * thick, 0.5 * (near + far))
        )


def set_stage(viewer: SceneNode) -> None:
    """White background, no axes, no grid."""
    for name in ("/Axes", "/Grid"):
        viewer[name].set_property("visible", False)
    for name in ("top_color", "bottom_color"):
        viewer["/Background"].set_property(name, [1.0, 1.0, 1.0])


def set_camera(viewer: SceneNode, kind: str, scale: float = 1.0) -> tuple[list[float], list[float]]:
    """Place a camera at the robot's right side ("side", x to the right, z up) or before it ("perspective").

    Returns its position and its target [m], in the camera's own frame, which has y up and z towards
    the robot's right. scale: how much larger than for RABBIT.
    """
    node = viewer[f"/Cameras/{kind}/rotated"]
    node.set_transform(UPRIGHT)
    if kind == "side":
        half = 0.5 * VIEW * scale
        node.set_object(shapes.OrthographicCamera(-half, half, half, -half, near=0.1, far=100.0))
        return [0.0, 0.7 * scale, 8.0], [0.0, 0.7 * scale, 0.0]
    node.set_object(shapes.PerspectiveCamera(fov=40.0, near=0.05, far=100.0))
    position, target = [1.7, 1.3, 2.6], [0.1, 0.6, 0.0]
    return [scale * c for c in position], [scale * c for c in target]


class MemoryWindow:
    """Takes the place of meshcat's window: keeps the commands, opens no port and starts no process.

    seed: of the names of objects, see `send`. packed: the commands in base64. viewer: the root of
    the tree.
    """

    def __init__(self, seed: str = "scene") -> None:
        self.packed: list[str] = []
        """The commands in base64."""
        self.viewer: SceneNode = meshcat.Visualizer(window=self)
        """Meshcat's tree of nodes."""
        self._names: dict[bytes, bytes] = {}
        self._source = random.Random(seed)

    def send(self, command: MeshcatCommand) -> None:
        """Keep a command of meshcat, packed as its viewer expects it.

        Meshcat names objects by clock and host (uuid1). Here names come from a seeded source in the
        order of their first use, so that the same walk gives the same bytes on any machine at any
        time.
        """
        packed = _UUID.sub(lambda found: self._named(found[0]), umsgpack.packb(command.lower()))
        self.packed.append(base64.b64encode(packed).decode("ascii"))

    def _named(self, name: bytes) -> bytes:
        """The name that stands for this one of meshcat's."""
        if name not in self._names:
            number = uuid.UUID(int=self._source.getrandbits(128), version=4)
            self._names[name] = str(number).encode()
        return self._names[name]
