"""One message to the pages: where the robots are, what acts on them, and the signals since the last message.

    {"t", "paused", "rate", "reached", "limits", "walks": [...], "hand": {...} or null, "felt"}

Each walk has its pose, `rows` of signals of at most ROWS samples, evenly spread, the last of them that of the
pose, and `worst` of all samples since the last message, null where there is none: least normal force, largest
friction and torque, and whether a foot slipped, null on the rigid plant. `felt` says whether a hand acted in
the last sample. Numbers that are not finite are null, as JSON has none. Poses are those of the drawn robot
(`viz.placement`), whose legs do not change their names at a touchdown as those of the model do.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from biped_adrc.ground import ground_axes
from biped_adrc.live.driver import Driver, Sample
from biped_adrc.live.hand import Hand
from biped_adrc.live.live_walk import LiveWalk
from biped_adrc.live.reading import Reading, carried, reading
from biped_adrc.live.session import WALK, Session
from biped_adrc.robots.robot_toml import RobotDescription
from biped_adrc.robots.symmetry import twins
from biped_adrc.scenario.build import limits
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.types import Array
from biped_adrc.viz.placement import exchanged, joint_values

ROWS = 3
"""Samples of a walk in one message: at sixty messages a second more than a plot has pixels."""


def frame(driver: Driver) -> dict[str, object]:
    """What is to be drawn of a session now."""
    session, walks = driver.session, []
    plant = session.walking[WALK].moving.walker.plant
    for live, made in zip(session.walking, driver.made, strict=True):
        seen = [reading(live, *sample) for sample in spread(made, ROWS)]
        last = (seen[-1], made[-1].hand) if seen else (None, None)
        told = {
            "rows": [row(live, one) for one in seen],
            "worst": worst(live, made),
            "ending": ending(live),
        }
        walks.append(pose(live, *last) | told)
    felt = driver.made[WALK]
    return {
        "t": session.t,
        "paused": driver.paused,
        "rate": driver.rate,
        "reached": driver.reached,
        "limits": limits_of(session.walking[WALK].scenario, plant.description),
        "walks": walks,
        "hand": acting(session),
        "felt": bool(felt) and felt[-1].hand is not None,
    }


def limits_of(s: Scenario, description: RobotDescription) -> dict[str, float]:
    """Friction |F_T| / F_N that the ground gives, of soft ground its own, and torque [N m] of the motors."""
    known = limits(s).of(description)
    return {
        "friction": known.friction if s.plant == "rigid" else s.ground_friction,
        "torque": known.torque if s.torque_limit is None else s.torque_limit,
    }


def pose(live: LiveWalk, seen: Reading | None, hand: Hand | None) -> dict[str, object]:
    """As scene.js takes it, of one robot: angles, forces, points; see `viz.meshcat.frames.Pose`.

    support: number of the single support, stance leg (0 or 1), its place (x, z) [m], and the slope [rad] there.
    """
    plant, step, q = live.moving.walker.plant, live.now.mode.step, live.q
    values = joint_values(plant, q, step, *live.foot.tolist())
    joints = [values[joint.name] for joint in plant.tree.joints if joint.type != "fixed"]
    points = np.concatenate((plant.hip(q), plant.swing_foot(q))) + np.tile(live.foot, 2)
    ground, other, zeta = (np.zeros(2), np.zeros(2), np.zeros(plant.n))
    if seen is not None:
        ground, other, zeta = seen.ground, seen.other, torques(live, seen, hand)
    other_leg = exchanged(plant, step)
    drawn = plant.R.T @ zeta if other_leg else zeta
    x, z = live.foot.tolist()
    slope = live.moving.walker.slope
    return {
        "joints": joints,
        "loads": numbers((*ground, *drawn)),
        "points": points.tolist(),
        "contact": numbers((x, z, *other, 0.0)),
        "support": {"number": step, "stance": int(other_leg), "x": x, "z": z, "slope": slope},
    }


def torques(live: LiveWalk, seen: Reading, hand: Hand | None) -> Array:
    """Torques from outside (n,) [N m] but for those of the force of the hand, which has an arrow of its own."""
    if hand is None:
        return seen.zeta
    force = hand._replace(torque=(0.0,) * len(seen.zeta))
    return seen.zeta - live.moving.points.load(force, seen.q).zeta


def spread(made: Sequence[Sample], most: int) -> list[Sample]:
    """At most so many of them, evenly spread, the last one among them."""
    count = min(most, len(made))
    return [made[round((k + 1) * len(made) / count) - 1] for k in range(count)]


def row(live: LiveWalk, seen: Reading) -> dict[str, object]:
    """What the page plots, of one sample."""
    along, out = pressing(live, seen.ground)
    return {
        "t": seen.t,
        "error": numbers(seen.error),
        "xi": numbers(seen.xi),
        "xi_estimate": numbers(seen.xi_estimate),
        "u": numbers(seen.u),
        "friction": numbers((friction(along, out),))[0],
    }


def pressing(live: LiveWalk, ground: Array) -> tuple[float, float]:
    """(F_T, F_N) [N], along and out of the walk's slope, of a force (F_x, F_z) (2,) [N] of the ground."""
    along, out = ground_axes(live.moving.walker.slope)
    return float(ground @ along), float(ground @ out)


def friction(tangent: float, normal: float) -> float:
    """|F_T| / F_N of a force of the ground; infinite where that does not press on the foot."""
    return math.inf if normal <= 0.0 else abs(tangent) / normal


def worst(live: LiveWalk, made: Sequence[Sample]) -> dict[str, object] | None:
    """Least F_N [N], largest |F_T| / F_N and torque [N m], and slip, of all these samples; None without one."""
    if not made:
        return None
    found = [carried(live, *sample) for sample in made]
    forces = [pressing(live, one.ground) for one in found]
    extremes = (
        min(normal for _, normal in forces),
        max(friction(*force) for force in forces),
        max(float(np.max(np.abs(one.u))) for one in found),
    )
    slips = None if found[-1].slips is None else any(one.slips for one in found)
    normal, used, torque = numbers(extremes)
    return {"normal": normal, "friction": used, "torque": torque, "slips": slips}


def ending(live: LiveWalk) -> str:
    """How a walk ended, such as "fell at 3.42 s: the robot fell", with what is known besides; else empty."""
    if live.walks:
        return ""
    word, reason = live.status.name.lower().replace("_", " "), live.status.value.split(";")[0]
    return f"{word} at {live.now.t:.2f} s: {reason}{f' ({live.detail})' if live.detail else ''}"


def acting(session: Session) -> dict[str, object] | None:
    """Where the hand holds the robot, its force [N], and the spring's other end; null for no force."""
    live = session.walking[WALK]
    if not live.walks:
        return None
    if session.spring is not None and (pulled := session.pulled()) is not None:
        p, force = pulled
        return {"at": p.tolist(), "force": force.tolist(), "anchor": [*session.spring.anchor]}
    hand = session.hand
    if hand is None or not any(hand.force):
        return None
    p, _ = live.moving.points.place(hand.link, hand.at, live.q, live.v)
    return {"at": (p + live.foot).tolist(), "force": [*hand.force], "anchor": None}


def named(live: LiveWalk, link: str) -> str:
    """The model's name, in the present single support, of a link of the drawn robot."""
    plant = live.moving.walker.plant
    if not exchanged(plant, live.now.mode.step):
        return link
    d = plant.description
    return twins(plant.tree, (d.stance_foot, d.swing_foot)).get(link, link)


def numbers(row: Iterable[float]) -> list[float | None]:
    """As JSON has them: null for one that is not finite."""
    return [float(x) if math.isfinite(x) else None for x in row]
