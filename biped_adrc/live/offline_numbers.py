"""The walks of an offline page in numbers, as viz/play/offline_walk.js reads them (`live.offline`).

The closed form of a point of a link has numbers that are affine in the place on the link; those at (0, 0) and
their slopes along x and z are told, for each link that is drawn.
"""

from __future__ import annotations

import base64
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from biped_adrc.closed_loop.instant_signals import signals_at
from biped_adrc.disturbances.link import LinkParameters
from biped_adrc.engine.kernels import layout
from biped_adrc.engine.kernels.run_plan import STATUS
from biped_adrc.engine.symbols import floats
from biped_adrc.engine.web_walker import WebWalker, web_walkers
from biped_adrc.errors import InputError
from biped_adrc.live.frame import limits_of
from biped_adrc.live.hand import LinkPoints, Spring
from biped_adrc.live.in_code import MovingCode
from biped_adrc.live.live_walk import LiveWalk
from biped_adrc.live.page import drawn_links
from biped_adrc.model.biped import Biped
from biped_adrc.robots.symmetry import twins
from biped_adrc.types import Array
from biped_adrc.viz.placement import exchanged, joint_values

SAME = 1e-9
"""Largest distance [m] between two points that are taken for one."""
PLACES = (
    *("TIME", "STEP", "START", "END", "FIRED", "EVERY", "ARC", "HEAD", "ROWS"),
    "FOOT_STRIKE",
)
"""Names of `engine.kernels.layout` that the script has."""


def numbers(walks: Mapping[str, LiveWalk]) -> dict[str, Any]:
    """What offline.js reads of the walks; vectors in base64. Raises InputError.

    walks       by name: plan, parameters, start, and where the hand is in F
    code        the module, with the names of the functions in the order of their numbers
    links       A; by name re, im (3, n) [m] at the link's (0, 0) and their slopes along x and z, and turn
    joints      what each drawn joint is: a coordinate, or -1, -2 for x and z of the trunk
    exchanged   whether the legs are drawn with exchanged names, in odd and even single supports; R
    places, codes, status, signals: numbers of the kernels, by name
    """
    moving = [in_code(name, live) for name, live in walks.items()]
    first = next(iter(walks.values()))
    made = web_walkers([one.made for one in moving], first.scene.walked.constraint)
    found = map(walk_numbers, walks.values(), moving, made.walkers)
    plant = first.moving.walker.plant
    feet = plant.description.stance_foot, plant.description.swing_foot
    return {
        "code": packed(made.code),
        "functions": made.functions,
        "walks": dict(zip(walks, found, strict=True)),
        "n": plant.n,
        "links": link_numbers(plant, [link for _, link in drawn_links(plant)]),
        "twins": twins(plant.tree, feet),
        "trunk": trunk_of(plant),
        "joints": joint_places(plant),
        "exchanged": [exchanged(plant, step) for step in (1, 2)],
        "R": plant.R.tolist(),
        "spring": {name: Spring._field_defaults[name] for name in ("stiffness", "damping", "most")},
        "places": {name: getattr(layout, name) for name in PLACES},
        "struck": layout.STRUCK,
        "status": [(x.name.lower().replace("_", " "), x.value.split(";")[0]) for x in STATUS],
        "signals": signal_places(first),
    }


def packed(data: bytes | Array) -> str:
    """Bytes or a vector in base64."""
    return base64.b64encode(data if isinstance(data, bytes) else data.tobytes()).decode("ascii")


def in_code(name: str, live: LiveWalk) -> MovingCode:
    """What moves a walk. Raises InputError for one that a page cannot move."""
    moving = live.moving
    if not isinstance(moving, MovingCode):
        raise InputError(
            f"the walk '{name}' does not run in machine code as a whole (plant '{live.scenario.plant}', "
            f"controller '{live.scenario.controller}'); an offline page takes the rigid plant and "
            "controllers with laws"
        )
    if moving.walker.disturbance is not None or moving.walker.ground_steps:
        raise InputError(f"the walk '{name}' has a push or ground steps of its own; leave them out")
    return moving


def walk_numbers(live: LiveWalk, moving: MovingCode, walker: WebWalker) -> dict[str, Any]:
    """Of one walk: vectors, sizes, clock, start, and the places of the hand in F."""
    return {
        **{name: packed(getattr(walker, name)) for name in ("P", "F", "K")},
        "observe": walker.observe,
        "width": walker.width,
        "s": packed(live.now.s),
        "period": moving.timing.period,
        "restart": moving.timing.restart,
        "slope": moving.walker.slope,
        "limits": limits_of(live.scenario, moving.walker.plant.description),
        "hand": hand_places(moving),
    }


def hand_places(moving: MovingCode) -> dict[str, Any]:
    """Where in F torque (n,) and force (2,) of the hand are, and re, im and turn of its point begin."""
    own, n = moving.numbers, moving.walker.plant.n
    point, at = own.points.of(own.rest.link, own.rest.at), own.at
    torque = marked(lambda c: own.torque._replace(amplitude=np.full(n, c)))
    force = marked(
        lambda c: LinkParameters(point, own.force.wave._replace(amplitude=np.array([c, c, 0.0])))
    )

    def begins(name: str) -> int:
        vectors = (point._replace(**{name: np.full(n, c)}) for c in (0.0, 1.0))
        zero, one = (LinkParameters(given, own.force.wave) for given in vectors)
        return at[1] + marked(lambda c: one if c else zero)[0]

    return {
        "torque": [at[0] + k for k in torque],
        "force": [at[1] + k for k in force],
        **{name: begins(name) for name in ("re", "im", "turn")},
    }


def marked(make: Callable[[float], object]) -> list[int]:
    """The places in a vector of numbers that a value goes to."""
    zero, other = (np.array(floats(make(c))) for c in (0.0, 1.0))
    places: list[int] = np.flatnonzero(zero != other).tolist()
    return places


def link_numbers(plant: Biped, links: list[str]) -> dict[str, Any]:
    """A, and the closed form of the points of each link."""
    points = LinkPoints(plant).of
    told: dict[str, Any] = {}
    for link in dict.fromkeys(links):
        corner, *others = (points(link, at) for at in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)))
        told[link] = {
            name: [getattr(corner, name).tolist()]
            + [(getattr(other, name) - getattr(corner, name)).tolist() for other in others]
            for name in ("re", "im")
        } | {"turn": corner.turn.tolist()}
    return {"A": points(links[0], (0.0, 0.0)).A.tolist(), "of": told}


def trunk_of(plant: Biped) -> str:
    """The trunk, whose origin is where the drawn robot's base is. Raises InputError where it is elsewhere."""
    q = np.random.default_rng(0).standard_normal(plant.n)
    values, trunk = joint_values(plant, q), plant.description.trunk
    p, _ = LinkPoints(plant).place(trunk, (0.0, 0.0), q, np.zeros(plant.n))
    base = np.array([values[name] for name in plant.description.base])
    if np.max(np.abs(p - base)) > SAME:
        raise InputError(
            f"robot '{plant.description.name}' is drawn from a base that is not the origin of its trunk "
            f"'{trunk}'; an offline page expects that"
        )
    return trunk


def joint_places(plant: Biped) -> list[int]:
    """What each drawn joint is: the place of its coordinate, or -1 and -2 for the base."""
    d = plant.description
    places = {name: k for k, name in enumerate(d.joints)} | {d.base[0]: -1, d.base[1]: -2}
    return [places[joint.name] for joint in plant.tree.joints if joint.type != "fixed"]


def signal_places(live: LiveWalk) -> dict[str, tuple[int, int]]:
    """Where each signal begins and ends in what `observe` says."""
    walker, now, constraint = live.moving.walker, live.now, live.scene.walked.constraint
    found = signals_at(walker, now.t, now.x, now.mode, lambda s, m: constraint(m.t, m.q, m.v))
    ends = np.cumsum([np.size(part) for part in found]).tolist()
    return dict(zip(found._fields, zip([0, *ends[:-1]], ends, strict=True), strict=True))
