"""The walks of a page, compiled with a hand, in the numbers that view/play/machine.js reads.

The hand is two parts of the disturbance, a torque on the coordinates and a force on a link. The page writes
their numbers into the block of the run (`engine.kernels.record`) before each sample.

The closed form of a point of a link has numbers that are affine in the place on the link; those at (0, 0) and
their slopes along x and z are given, for each link that is drawn.
"""

from __future__ import annotations

import base64
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Self, cast

import numpy as np

from biped_adrc.closed_loop.instant_signals import signals_at
from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.disturbances.base import Sum
from biped_adrc.disturbances.link import OnLink
from biped_adrc.disturbances.waves import TorqueStep
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.kernels.record import PLACES, Ints
from biped_adrc.engine.kernels.run_plan import STATUS
from biped_adrc.engine.symbols import NotCompiled, paths
from biped_adrc.engine.webassembly import WebWalker, web_walkers
from biped_adrc.errors import InputError
from biped_adrc.hybrid.constants import STRUCK
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import link_point, point, turned
from biped_adrc.model.robots.symmetry import twins
from biped_adrc.scenario.build import RIGID, RobotAndGait, build, limits, start
from biped_adrc.scenario.run import method_of
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.timing import SampledTime
from biped_adrc.types import Array
from biped_adrc.view.meshcat.objects import visual_links
from biped_adrc.view.placement import exchanged, joint_values

MOST = {"force": 300.0, "torque": 200.0}
"""Largest force [N] of a hand, about the weight of RABBIT, and largest torque on one coordinate [N m]."""
SPRING = {"stiffness": 1500.0, "damping": 40.0}
"""F = k (anchor - p) - d p', at most MOST: k [N/m], d [N s/m].

A force that is held for a period T acts T / 2 late, which takes k T / 2 from the damping: 2 % at 1 kHz.
"""
SAME = 1e-9
"""Largest distance [m] between two points that are taken for one."""


@dataclass(frozen=True)
class PageWalk:
    """A walk of a page, as it begins at 0 s."""

    scenario: Scenario
    scene: RobotAndGait
    walker: Walker
    """Without the hand."""
    made: CompiledWalker
    """With the hand, which is its whole disturbance."""
    x: Array
    """State (nx,)."""

    @classmethod
    def of(cls, name: str, s: Scenario) -> Self:
        """Raises InputError, with the name, for a scenario that a page cannot walk."""
        plant, fine = s.ground.plant, s.run.fine
        if plant != RIGID:
            raise InputError(f"the walk '{name}' is on plant '{plant}'; a page takes '{RIGID}'")
        if fine is not None:
            raise InputError(
                f"the walk '{name}' has run.fine = {fine:g} s; leave it out: a page takes steps of one length"
            )
        scene = RobotAndGait.of(s)
        scene.walked  # noqa: B018  # a robot without motors is refused
        walker = build(s, scene)
        if not isinstance(walker.timing, SampledTime):
            raise InputError(
                f"the walk '{name}' is controlled at every instant, and that of a page at sample instants; "
                "give a period, as hardware = 'ideal' or hardware.period = '1 ms'"
            )
        if walker.disturbance is not None or walker.ground_steps:
            raise InputError(
                f"the walk '{name}' has a push or ground steps of its own; leave them out"
            )
        x = walker.initial_state(*start(s, scene), Mode(s.run.first_step))
        size, method = walker.controller_size(x), method_of(s, walker)
        try:
            reference = scene.walked.constraint
            made = CompiledWalker.of(with_hand(walker), method, size, 0.0, reference)
        except NotCompiled as reason:
            raise InputError(
                f"the walk '{name}' does not run in machine code as a whole: {reason}"
            ) from reason
        return cls(s, scene, walker, made, x)

    @property
    def mode(self) -> Mode:
        """Its first single support."""
        return Mode(self.scenario.run.first_step)


def with_hand(walker: Walker) -> Walker:
    """The walker with a torque and a force as its disturbance, both zero."""
    force = OnLink(walker.plant, walker.plant.description.trunk, TorqueStep(np.zeros(3)))
    return replace(walker, disturbance=Sum() + TorqueStep(np.zeros(walker.plant.n)) + force)


def numbers(walks: Mapping[str, PageWalk]) -> dict[str, Any]:
    """What machine.js reads of the walks; vectors in base64. Raises InputError.

    walks       by name: the block as it begins, its pointers, and where the hand is in it
    code        the module, with the names of the functions in the order of their numbers
    links       A; by name re, im (3, n) [m] at the link's (0, 0) and their slopes along x and z, and turn
    joints      what each drawn joint is: a coordinate, or -1, -2 for x and z of the trunk
    exchanged   whether the legs are drawn with exchanged names, in odd and even single supports; R
    places, status, signals: numbers of the kernels, by name, and struck
    """
    first = next(iter(walks.values()))
    web = web_walkers([walk.made for walk in walks.values()], first.scene.walked.constraint)
    found = map(walk_numbers, walks.values(), web.walkers)
    plant = first.walker.plant
    feet = plant.description.stance_foot, plant.description.swing_foot
    return {
        "code": packed(web.code),
        "functions": web.functions,
        "walks": dict(zip(walks, found, strict=True)),
        "n": plant.n,
        "links": link_numbers(plant, [link for _, link in visual_links(plant.tree)]),
        "twins": twins(plant.tree, feet),
        "trunk": trunk_of(plant),
        "joints": joint_places(plant),
        "exchanged": [exchanged(plant, step) for step in (1, 2)],
        "R": plant.R.tolist(),
        "spring": SPRING,
        "places": PLACES,
        "struck": STRUCK,
        "status": [(x.name.lower().replace("_", " "), x.value.split(";")[0]) for x in STATUS],
        "signals": signal_places(first),
    }


def packed(data: bytes | Ints) -> str:
    """Bytes or a vector in base64."""
    return base64.b64encode(data if isinstance(data, bytes) else data.tobytes()).decode("ascii")


def walk_numbers(walk: PageWalk, web: WebWalker) -> dict[str, Any]:
    """Of one walk: its block, clock, limits of ground and motors, places of the hand."""
    timing, s = cast(SampledTime, walk.walker.timing), walk.scenario
    known, limit = limits(s).of(walk.walker.plant.description), s.hardware.torque_limit
    return {
        "cells": packed(web.plan.start(walk.x, 0.0, *walk.mode, 0.0).block),
        "pointers": web.plan.pointers.tolist(),
        "nx": web.plan.nx,
        "observe": web.observe,
        "period": timing.period,
        "restart": timing.restart,
        "slope": walk.walker.slope,
        "limits": {
            "friction": known.friction,
            "torque": known.torque if limit is None else limit,
        },
        "hand": hand_places(walk.made),
    }


def hand_places(made: CompiledWalker) -> dict[str, Any]:
    """Cells where torque (n,) and force (2,) of the hand are, and re, im and turn of its point begin."""
    n, hand = made.walker.plant.n, made.walker.disturbance
    assert hand is not None

    def places(term: int, name: str, size: int) -> list[int]:
        first = made.plan.term(term) + list(paths(hand.terms[term])).index(f"{name}[0]")
        return list(range(first, first + size))

    return {
        "torque": places(0, "amplitude", n),
        "force": places(1, "wave.amplitude", 2),
        **{name: places(1, f"point.{name}", 1)[0] for name in ("re", "im", "turn")},
    }


def link_numbers(plant: Biped, links: list[str]) -> dict[str, Any]:
    """A, and the closed form of the points of each link."""
    found: dict[str, Any] = {}
    for link in dict.fromkeys(links):
        corner, *others = (
            link_point(plant, link, at) for at in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))
        )
        found[link] = {
            name: [getattr(corner, name).tolist()]
            + [(getattr(other, name) - getattr(corner, name)).tolist() for other in others]
            for name in ("re", "im")
        } | {"turn": corner.turn.tolist()}
    return {"A": link_point(plant, links[0]).A.tolist(), "of": found}


def trunk_of(plant: Biped) -> str:
    """The trunk, whose origin is where the drawn robot's base is. Raises InputError where it is elsewhere."""
    q = np.random.default_rng(0).standard_normal(plant.n)
    values, trunk = joint_values(plant, q), plant.description.trunk
    k = link_point(plant, trunk)
    base = np.array([values[name] for name in plant.description.base])
    if np.max(np.abs(point(turned(k, q), k.re, k.im) - base)) > SAME:
        raise InputError(
            f"robot '{plant.description.name}' is drawn from a base that is not the origin of its trunk "
            f"'{trunk}'; a page expects that"
        )
    return trunk


def joint_places(plant: Biped) -> list[int]:
    """What each drawn joint is: the place of its coordinate, or -1 and -2 for the base."""
    d = plant.description
    places = {name: k for k, name in enumerate(d.joints)} | {d.base[0]: -1, d.base[1]: -2}
    return [places[joint.name] for joint in plant.tree.joints if joint.type != "fixed"]


def signal_places(walk: PageWalk) -> dict[str, tuple[int, int]]:
    """Where each signal begins and ends in what `observe` says."""
    h = walk.scene.walked.constraint
    found = signals_at(walk.walker, 0.0, walk.x, walk.mode, lambda s, m: h(m.t, m.q, m.v))
    ends = np.cumsum([np.size(part) for part in found]).tolist()
    return dict(zip(found._fields, zip([0, *ends[:-1]], ends, strict=True), strict=True))
