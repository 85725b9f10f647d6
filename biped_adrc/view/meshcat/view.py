"""Walks in Meshcat as one offline HTML file: the viewer, the robots, their motion and the controls.

Meshcat draws three-dimensional scenes in a browser. `animation_html` lays the walks out along the ground,
samples them (`Frames`), draws the objects (`objects`), and writes all of it as JSON into the page; the page's
program player.js plays it. One walk is solid and followed by the camera, the others are ghosts: translucent,
each a little farther from the camera.

The player draws a walk at any time by cubic Hermite interpolation between samples. They are at the times of the
frames, at both ends of every single support, at the switching times of pushes, and on soft ground at the times
at which the other foot touches or leaves it, or a foot begins or ends to slip. Between them the error of the
drawn angles is 1e-5 rad at most. A node is one of Meshcat's tree of objects (`objects`), a foothold the place
of a stance foot. An arc is the motion of one single support; its state x begins with the n coordinates q and
their n rates.
"""

import base64
import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Self

import numpy as np

from biped_adrc.core.types import Array
from biped_adrc.hybrid.trajectory import Arc
from biped_adrc.model.biped import Biped
from biped_adrc.view import colours, placement
from biped_adrc.view.from_the_side.side_view import SideView
from biped_adrc.view.meshcat import objects as draw
from biped_adrc.view.pages import with_viewer
from biped_adrc.view.placement import Clip, Drawable, WalkScene, ending, exchanged, joint_values

LANE = 0.4
"""Distance [m] of each ghost from the walk before it, away from the camera: equal planes would flicker."""
_FPS = 60.0
"""Frames per second of a page."""
TRACE_POINTS = 20_000
"""Room for points of the traces of a walk that is not sampled beforehand, but runs in the page."""
TALL = 1.6
"""Height [m] of the highest robot that the cameras show from where they are for RABBIT."""
Marks = Sequence[tuple[float, float, str]]
"""(start, stop, text) of what is shown beside the clock, times in [s]."""
EPSILON = 1e-6
"""Half the interval [s] of the central difference by which the rates of the joints, the base among them, are
computed."""


class Pose(NamedTuple):
    """Everything that is drawn of a walk at one time."""

    joints: Array
    """(J,) values of the moving joints, in the order of the URDF [rad], [m]."""
    rates: Array
    """(J,) rates of these joints [rad/s], [m/s]."""
    loads: Array
    """(2 + n,): force of the ground on the stance foot along x and z [N], and the external torque on the drawn
    joints of q1..qn [N m]."""
    points: Array
    """(4,): x and z of the hip and of the swing foot in the world [m]."""
    contact: Array
    """(5,): x, z of the stance foot [m], force on the other foot along x, z [N], and 1 where a foot slips."""


class Frames(NamedTuple):
    """A walk in K samples, one in each row; at an impact there are two, before and after it."""

    t: Array
    """Times (K,) [s]."""
    arc: Array
    """(K,) index of the single support, from 0."""
    poses: Pose
    """The poses at these times, as arrays with K rows: (K, J), (K, J), (K, 2 + n), (K, 4), (K, 5)."""

    @classmethod
    def of(cls, scene: WalkScene, fps: float) -> Self:
        """Sample a walk `fps` [1/s] times per second, and at the other times that the head of this module
        names. Raises InputError for too many frames.
        """
        placement.check_frames((scene.trajectory.t_end - scene.trajectory.t_start) * fps)
        # _nodes: the times [s] at which one single support is sampled
        of_arcs = [_nodes(scene, arc, fps).tolist() for arc in scene.trajectory.arcs]
        at = [(i, t) for i, times in enumerate(of_arcs) for t in times]
        arcs, times = map(np.array, zip(*at, strict=True))
        poses = zip(*(pose(scene, i, t) for i, t in at), strict=True)
        return cls(times, arcs, Pose(*map(np.array, poses)))


def animation_html(
    walks: Mapping[str, Drawable], clip: Clip | None = None, marks: Marks = ()
) -> str:
    """Text of a page that shows the walks overlaid, without server or network; equal walks give equal text.

    walks: name -> walk, one or more; the last is drawn opaque and followed by the camera, the others are
    translucent. clip: frames per second and camera are taken of it, the defaults if None. marks: texts beside
    the clock, with their times. Raises InputError for too many frames.
    """
    clip = Clip() if clip is None else clip
    # the solid walk, the last one, comes first
    scenes = {name: WalkScene.of(walks[name]) for name in [*walks][-1:] + [*walks][:-1]}
    frames = {name: Frames.of(scene, clip.fps or _FPS) for name, scene in scenes.items()}
    settings = scene_settings(scenes, clip, frames, marks)
    title, style = " and ".join(walks), "player.css"
    return with_viewer("player", settings, title=title, captions=captions(scenes), style=style)


def _packed(frames: Frames) -> dict[str, str]:
    """Encode the samples in base64: times as float64, the rest as float32, which is finer than a pixel."""
    others = {"arc": frames.arc, **frames.poses._asdict()}
    packed = {"t": frames.t} | {name: x.astype(np.float32) for name, x in others.items()}
    return {name: base64.b64encode(x.tobytes()).decode("ascii") for name, x in packed.items()}


# -- scene -----------------------------------------------------------------------------------------
def scene_settings(
    scenes: Mapping[str, WalkScene],
    clip: Clip,
    frames: Mapping[str, Frames] | None = None,
    marks: Marks = (),
) -> dict[str, Any]:
    """The settings that scene.js and player.js read: Meshcat's commands and, by walk, the paths of what moves.

    scenes: name -> walk, the solid one first. frames: name -> samples of the walk; None for a page in which the
    walk is simulated while it is shown (`play`).

        walks       for each walk the entry of `_add_walk`, its name, its end [s], how it ended, its samples
        follow      the node, of the first walk, that the camera follows
        marks       (start, stop, text); fps [1/s]; start, end [s] of the slider
        view        the camera at the start; views: commands, position and target [m] of each
        commands    Meshcat's commands that build the scene
    """
    window = draw.MemoryWindow()
    viewer = window.viewer
    described = []
    for lane, (name, scene) in enumerate(scenes.items()):
        opacity, sampled = (1.0 if lane == 0 else placement.GHOST), (frames or {}).get(name)
        # the traces of hip and swing foot get a point at each sample
        room = TRACE_POINTS if sampled is None else len(sampled.t)
        robot, path = viewer[f"robots/{lane}"], f"meshcat/robots/{lane}"
        # LANE: distance of a ghost from the walk before it [m]; TALL: highest robot that fits [m]
        robot.set_transform(placement.placed((0.0, LANE * lane, 0.0)))
        over = {"name": name, "end": scene.trajectory.t_end, "ending": ending(scene.trajectory)}
        data = {} if sampled is None else {"data": _packed(sampled)}
        described.append(over | _add_walk(robot, path, scene, opacity, room) | data)
    solid = next(iter(scenes.values()))
    draw.add_ground(viewer["ground"], list(scenes.values()), draw.sole(solid.biped), LANE)
    draw.set_stage(viewer)
    tree, base = solid.biped.tree, solid.biped.description.base[0]
    base_x = next(joint for joint in tree.joints if joint.name == base)  # moves along x alone
    scale = max(1.0, SideView(solid).height / TALL)
    return {
        "walks": described,
        "follow": f"meshcat/robots/0/{draw.joint_path(tree, base_x)}",
        "marks": [list(mark) for mark in marks],
        "fps": clip.fps or _FPS,
        "start": min(scene.trajectory.t_start for scene in scenes.values()),
        "end": max(scene.trajectory.t_end for scene in scenes.values()),
        "view": clip.view,
        "views": {kind: draw.camera(kind, scale) for kind in placement.VIEWS},
        "commands": window.packed,
    }


def _add_walk(
    robot: draw.SceneNode, path: str, scene: WalkScene, opacity: float, room: int
) -> dict[str, object]:
    """Draw one walk below the node `robot`; returns its entry for player.js, with the paths of its parts.

    path: of the node `robot`. opacity: 0 to 1. room: number of points that each trace has room for.

        joints        path, type, axis and origin [m] of each moving joint, in the order of the samples
        legs          paths of the parts of the leg that carries odd steps, and of the other; they get the
                      colours of stance and swing leg, 0xRRGGBB, which are exchanged at impact
        rings, arrows, traces, footprints    paths of these; arrows of stance foot and other foot
        supports      number, stance leg (0 or 1) and foothold x, z [m] of each single support
        fall          tan(slope); ground: its height over the footholds [m], negative
        head          length of an arrow's head [m]
        metres_per_newton, longest, metres_per_newton_metre    scales of arrow and rings
    """
    # depth: radius of the ball that is drawn as a foot, by which the ground lies below the footholds
    biped, depth = scene.biped, draw.sole(scene.biped)
    tree = biped.tree
    drawn = [(f"{path}/{part}", link) for part, link in draw.visual_links(tree)]
    draw.add_robot(robot, biped, opacity)
    draw.add_footprints(robot["footprints"], scene, depth, opacity)
    draw.add_trace(robot["hip_trace"], room, draw.DARK, opacity)
    draw.add_trace(robot["foot_trace"], room, colours.SWING, opacity)
    for arrow in ("ground_reaction", "other_reaction"):
        draw.add_arrow(robot[arrow], colours.REACTION, opacity)
    rings = [_add_ring(robot, biped, name, opacity) for name in biped.description.joints]
    return {
        "joints": [
            {
                "path": f"{path}/{draw.joint_path(tree, joint)}",
                "type": joint.type,
                "axis": list(joint.axis),
                "origin": list(joint.origin),
            }
            for joint in tree.joints
            if joint.type != "fixed"
        ],
        "legs": [[part for part, link in drawn if link in leg] for leg in placement.legs(biped)],
        "colours": [draw.colour(colours.STANCE), draw.colour(colours.SWING)],
        "rings": [f"{path}/{ring}/turn" for ring in rings],
        "arrows": [f"{path}/ground_reaction", f"{path}/other_reaction"],
        "traces": [f"{path}/hip_trace", f"{path}/foot_trace"],
        "footprints": [f"{path}/footprints/{k}" for k in range(len(scene.footholds))],
        "supports": [
            {
                "number": arc.mode.step,
                "stance": int(exchanged(biped, arc.mode.step)),
                "x": scene.foothold(i)[0],
                "z": scene.foothold(i)[1],
            }
            for i, arc in enumerate(scene.trajectory.arcs)
        ],
        "fall": math.tan(scene.walker.ground_slope),
        "ground": -depth,
        "head": draw.HEAD,
        "metres_per_newton": colours.WEIGHT_LENGTH / biped.weight,
        "longest": colours.LONGEST_ARROW,
        "metres_per_newton_metre": colours.METRES_PER_NEWTON_METRE,
    }


def _add_ring(robot: draw.SceneNode, biped: Biped, name: str, opacity: float) -> str:
    """Draw the ring that shows the external torque on joint `name`; returns its path below `robot`.

    The ring of the unactuated torso is at its centre of mass: at its joint it would cover those of the hips.
    """
    joint = next(joint for joint in biped.tree.joints if joint.name == name)
    inertial = biped.tree.links[joint.child].inertial
    path = f"{draw.joint_path(biped.tree, joint)}/torque"
    motors = biped.description.actuated
    origin = (0.0, 0.0, 0.0) if name in motors or inertial is None else inertial.com
    draw.add_ring(robot[path], origin, colours.TORQUE, opacity)
    return path


def captions(scenes: Mapping[str, WalkScene]) -> list[tuple[str, str]]:
    """The legend of a page as pairs (colour "#rrggbb", text); the colour is empty for plain text. scenes: the
    solid walk first.
    """
    solid, *ghosts = scenes
    biped = scenes[solid].biped
    # what an arrow, and the radius of a ring, of 0.1 m mean
    newtons = 0.1 * biped.weight / colours.WEIGHT_LENGTH
    torque = 0.1 / colours.METRES_PER_NEWTON_METRE
    walking = [(colours.STANCE.lower(), "stance leg"), (colours.SWING.lower(), "swing leg")]
    others = f"{solid}: solid. {', '.join(ghosts)}: translucent, {LANE:g} m farther away."
    return [
        ("", others if ghosts else f"{solid}."),
        *([] if placement.is_wheel(biped) else walking),
        (colours.REACTION.lower(), f"ground reaction, 0.1 m = {newtons:.0f} N"),
        (colours.TORQUE.lower(), f"torque from outside, radius 0.1 m = {torque:.0f} N m"),
    ]


def pose(scene: WalkScene, i: int, t: float) -> Pose:
    """Pose of the robot in arc i (from 0) at t [s].

    At the end of the arc it is that before the impact: the arc after it has a pose of its own for that time.
    """
    arc, biped, foothold = scene.trajectory.arcs[i], scene.biped, scene.foot(i, t)
    n, step = biped.n, arc.mode.step
    x = arc(t, "left" if t == arc.t[-1] else "right")  # the side of a jump of the state at t
    q, v = x[:n], x[n : 2 * n]
    moving = [joint.name for joint in biped.tree.joints if joint.type != "fixed"]
    # values of the joints at t, and EPSILON [s] later and earlier
    near = (q + s * EPSILON * v for s in (0.0, 1.0, -1.0))
    at, later, earlier = (joint_values(biped, angles, step, *foothold) for angles in near)
    rates = [(later[name] - earlier[name]) / (2.0 * EPSILON) for name in moving]
    # at the end of the arc its own loads, not those after the impact
    acting = placement.loads_at(scene, min(t, math.nextafter(float(arc.t[-1]), -math.inf)))
    values, forces = [at[name] for name in moving], (acting.ground_reaction, acting.zeta)
    contact = np.array([*foothold, *acting.other, acting.slips])
    points = scene.points(i, t, q)
    return Pose(np.array(values), np.array(rates), np.concatenate(forces), points, contact)


def _nodes(scene: WalkScene, arc: Arc, fps: float) -> Array:
    """Times (K,) [s] at which one single support is sampled: frames, both ends, switching times of pushes,
    changes of contact.
    """
    start, end = float(arc.t[0]), float(arc.t[-1])
    first = scene.trajectory.t_start
    # the frames of the whole walk are equally spaced from its start on
    frames = first + np.arange(math.ceil((start - first) * fps), (end - first) * fps) / fps
    # switching times may be outside of the arc
    edges = *scene.walker.switching_times(arc.mode), *placement.contact_changes(scene, arc)
    inside = [t for t in (*frames, *edges) if start < t < end]
    return np.unique([start, *inside, end])
