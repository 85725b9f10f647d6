"""The pinned chain, for peers: its URDF, its coordinates, and the proof that a peer has the same robot.

A peer's joint angles are q_peer = T q_s with T square and constant, so f_peer = T^-T f and
q'' = T^-1 a_peer.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from biped_adrc.errors import ModelError
from biped_adrc.model.biped import Biped
from biped_adrc.robots.urdf import Inertial, Joint, Link, Tree, Vector
from biped_adrc.types import Array

SAME = 1e-8
"""Largest relative difference of a peer's q'' to the package's, dimensionless."""

Simulate = Callable[[Array, Array, float], Array]
"""(q_s, q_s', T) -> q_s after T [s] of free motion."""


class Chain(ABC):
    """One peer's model of the robot pinned at its stance foot."""

    def __init__(self, biped: Biped) -> None:
        self.biped = biped

    @abstractmethod
    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """q'' (n,) [rad/s^2] under the generalised force (n,) [N m], in the package's coordinates."""

    @abstractmethod
    def methods(self) -> Mapping[str, Simulate]:
        """What is timed, by name."""

    def difference(self, samples: int = 100) -> float:
        """Largest |q'' - q''_package| / |q''_package| over random states and forces."""
        random, n = np.random.default_rng(5), self.biped.n
        worst = 0.0
        for _ in range(samples):
            q, v = random.uniform(-np.pi, np.pi, n), random.normal(size=n)
            force = random.normal(scale=50.0, size=n)
            ours = self.biped.acceleration(q, v, force)
            gap = np.linalg.norm(self.acceleration(q, v, force) - ours)
            worst = max(worst, float(gap / np.linalg.norm(ours)))
        return worst

    def check(self) -> float:
        """The difference. Raises ModelError when the peer simulates another robot."""
        worst = self.difference()
        if not worst <= SAME:
            raise ModelError(
                f"{type(self).__name__}: q'' differs from the package's by {worst:.1e} relative, expected "
                f"{SAME:g}; look at axes, armature and gravity"
            )
        return worst


@dataclass(frozen=True)
class Coordinates:
    """The package's coordinates q_s and those of a peer whose joints come in another order."""

    biped: Biped
    joints: Sequence[str]

    @cached_property
    def T(self) -> Array:
        """(n, n), q_peer = T q_s."""
        names = list(self.biped.pinned.model.names)[1:]
        T: Array = self.biped.pinned.T[[names.index(joint) for joint in self.joints]]
        return T

    @cached_property
    def inverse(self) -> Array:
        """T^-1."""
        inverse: Array = np.linalg.inv(self.T)
        return inverse

    def force(self, force: Array) -> Array:
        """T^-T f."""
        return self.inverse.T @ force


def welded(tree: Tree) -> Tree:
    """The same robot with fixed joints taken out, so that no peer pays for links that do not move.

    Raises ModelError where both links of a fixed joint have a mass.
    """
    for joint in tree.joints:
        if joint.type == "fixed":
            return welded(_without(tree, joint))
    return tree


def _without(tree: Tree, weld: Joint) -> Tree:
    one, other = tree.links[weld.parent], tree.links[weld.child]
    if one.inertial is not None and other.inertial is not None:
        raise ModelError(
            f"URDF '{tree.source}', joint '{weld.name}': both '{one.name}' and '{other.name}' have a mass; "
            "expected one of them to be a frame"
        )
    body = one.inertial or _moved(other.inertial, weld.origin)
    links = {name: link for name, link in tree.links.items() if name != other.name}
    links[one.name] = Link(one.name, body, ())
    joints = [
        replace(j, parent=one.name, origin=_sum(j.origin, weld.origin))
        if j.parent == other.name
        else j
        for j in tree.joints
        if j is not weld
    ]
    return replace(tree, links=links, joints=tuple(joints))


def _moved(body: Inertial | None, by: Vector) -> Inertial | None:
    return None if body is None else replace(body, com=_sum(body.com, by))


def _sum(a: Vector, b: Vector) -> Vector:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def rotors(biped: Biped) -> dict[str, float]:
    """Reflected rotor inertia by joint [kg m^2]."""
    return dict.fromkeys(biped.description.actuated, biped.armature)
