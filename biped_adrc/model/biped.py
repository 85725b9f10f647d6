"""The planar biped in the paper's coordinates q_s = (q_b, q_N): single support and impact.

    D_s(q) q'' + C(q, q') q' + G_s(q) = B_s u + delta + zeta         (1)

q_b are the actuated joints (stance hip, swing hip, stance knee, swing knee), q_N the absolute pitch of
the torso. Angles are counter-clockwise positive with x to the right and z up; a link of absolute
angle a points along (-sin a, cos a).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from types import NoneType

import numpy as np
from numpy.typing import NDArray

from biped_adrc.errors import ModelError
from biped_adrc.model.contact import FloatingDynamics, Impact
from biped_adrc.model.physical import check_numbers, check_planar
from biped_adrc.model.pinned import PinnedDynamics, finite_angles, reroot
from biped_adrc.model.reduction import BodyTerms, Reduction, reduce
from biped_adrc.parts import check_part
from biped_adrc.robots.robot_toml import RobotDescription, load_description
from biped_adrc.robots.symmetry import absolute_angles, relabelling
from biped_adrc.robots.urdf import Inertial, Tree
from biped_adrc.shown import Shown
from biped_adrc.types import Array

STICTION_SPEED = 0.05  # [rad/s], width of the smoothed sign of static friction


@dataclass(frozen=True)
class Biped(Shown):
    """A robot with one set of parameters. Make it with `Biped.load`.

    Pinocchio's work data inside is overwritten by every call: use one Biped per thread.
    """

    description: RobotDescription
    tree: Tree
    preset: str
    armature: float
    friction: bool = False

    def __repr__(self) -> str:
        name, parts = self.description.name, f"n = {self.n}, p = {self.p}, {self.mass:.4g} kg"
        return f"Biped('{name}', preset '{self.preset}': {parts}{', friction' if self.friction else ''})"

    @classmethod
    def load(
        cls, robot: str | Path = "rabbit", preset: str | None = None, friction: bool = False
    ) -> Biped:
        """A robot by name (or the path of its robot.toml) with a parameter preset.

        friction: add the record's viscous and static joint friction to the dynamics.
        Raises ModelError for an unknown robot or preset, or a URDF that is not physical.
        """
        description = load_description(robot)
        record = description.preset(preset)
        biped = cls(
            description, description.tree(record.name), record.name, record.armature, friction
        )
        biped.check()
        return biped

    def check(self) -> None:
        """Build both models now; check that they can be computed with and that the two legs are alike.

        The kinetic energy with the base at rest must not change when the legs swap roles. Raises ModelError.
        """
        check_planar(self.tree, self.description)
        check_numbers(self)
        n, R = self.n, self.R
        q, v = 0.3 * np.arange(1.0, n + 1.0), np.cos(np.arange(float(n)))
        one, other = (self.floating.inertia_on_fixed_base(x) for x in (q, self.relabel(q)))
        lengths = [float(np.linalg.norm(self.swing_foot(x))) for x in (q, self.relabel(q))]
        w = R @ v
        alike = math.isclose(v @ one @ v, w @ other @ w, rel_tol=1e-9)
        if not (alike and math.isclose(*lengths, rel_tol=1e-9)):
            raise ModelError(
                f"robot '{self.description.name}': the legs differ in mass or length; relabelling at "
                "impact needs equal legs"
            )

    # -- sizes and names -----------------------------------------------------------------------
    @cached_property
    def n(self) -> int:
        """Number of coordinates N."""
        return len(self.description.joints)

    @cached_property
    def p(self) -> int:
        """Number of motors."""
        return len(self.description.actuated)

    @cached_property
    def B(self) -> Array:
        """B_s = [I; 0] (n, p)."""
        return np.eye(self.n)[:, : self.p]

    @cached_property
    def phase(self) -> Array:
        """Row c (n,) of Theta = c q."""
        return np.array(self.description.phase)

    @cached_property
    def R(self) -> Array:
        """(n, n): q+ = R q- + r exchanges the legs at impact, as `relabel` does. Raises ModelError."""
        return relabelling(self.tree, self.description.joints, self.description.feet)

    def relabel(self, q: Array) -> Array:
        """q (n,) in the coordinates of the next single support [rad]."""
        return self.R @ q + self._offset

    @cached_property
    def _offset(self) -> Array:
        return np.array(self.description.offset)

    @cached_property
    def relabelling(self) -> NDArray[np.int_]:
        """R as a permutation (n,): q_new = q[R], dtype int. Raises ModelError where it is none."""
        rows, columns = np.nonzero(self.R)
        ones = np.array_equal(rows, np.arange(self.n)) and np.all(self.R[rows, columns] == 1.0)
        if not ones or self._offset.any():
            raise ModelError(
                f"robot '{self.description.name}': relabelling combines coordinates or adds to them, it is "
                "no permutation; use Biped.R and Biped.relabel"
            )
        return np.asarray(columns)

    # -- the two Pinocchio models ----------------------------------------------------------------
    @cached_property
    def pinned_tree(self) -> Tree:
        """The tree rooted at the stance foot."""
        return reroot(self.tree, self.description.stance_foot, self.description.trunk)

    @cached_property
    def pinned(self) -> PinnedDynamics:
        """Single-support dynamics from the pinned model."""
        chain = self._stance_chain()
        return PinnedDynamics(self.pinned_tree, self.description, chain, self.armature)

    @cached_property
    def floating(self) -> FloatingDynamics:
        """Unpinned dynamics from the floating model."""
        return FloatingDynamics(self.tree, self.description, self.armature)

    def _stance_chain(self) -> Array:
        """Row (n,): absolute angle of the stance foot's link as a sum of coordinates."""
        pitch = self.tree.joint_above(self.description.trunk)
        if pitch is None or pitch.name != self.description.unactuated:
            raise ModelError(
                f"URDF '{self.tree.source}': link '{self.description.trunk}' hangs on "
                f"'{pitch.name if pitch else 'nothing'}', expected '{self.description.unactuated}'"
            )
        foot = self.description.stance_foot
        return absolute_angles(self.tree, self.description.joints, [foot])[0]

    # -- single support (1), (11)-(15) -----------------------------------------------------------
    def inertia(self, q: Array) -> Array:
        """D_s(q) (n, n) [kg m^2]."""
        return self.pinned.inertia(self._angles(q))

    def bias(self, q: Array, v: Array) -> Array:
        """Omega(q, q') = C q' + G_s (n,) [N m] of (11)."""
        return self.pinned.bias(self._angles(q), self._angles(v))

    def gravity(self, q: Array) -> Array:
        """G_s(q) = dV/dq (n,) [N m]."""
        return self.pinned.gravity(self._angles(q))

    def coriolis(self, q: Array, v: Array) -> Array:
        """C(q, q') (n, n) [N m s]; D_s' - 2 C is skew-symmetric."""
        return self.pinned.coriolis(self._angles(q), self._angles(v))

    def reduction(self, q: Array, v: Array) -> Reduction:
        """The split (11)-(15) at (q, q'): D, Omega, kappa, xi, and the unactuated rows."""
        D, Omega = self.pinned.inertia_and_bias(self._angles(q), self._angles(v))
        return reduce(D, Omega, self.p)

    def body_terms(self, q: Array, v: Array) -> BodyTerms:
        """G, C' q', and the force of the ground as F_a q'' + F_0."""
        q, v = self._angles(q), self._angles(v)
        F_0 = self.ground_reaction(q, v, np.zeros(self.n))
        turning = self.pinned.coriolis(q, v).T @ v
        return BodyTerms(self.pinned.gravity(q), turning, self.pinned.mass_jacobian(q), F_0)

    def friction_torque(self, v: Array) -> Array:
        """Joint friction (n,) [N m]: -viscous v - static tanh(v / STICTION_SPEED); zero if off."""
        if not self.friction:
            return np.zeros(self.n)
        viscous, static = self.friction_coefficients
        return -viscous * v - static * np.tanh(v / STICTION_SPEED)

    @cached_property
    def friction_coefficients(self) -> tuple[Array, Array]:
        """Viscous [N m s/rad] and static [N m], each (n,), as in the record."""
        d = self.description
        viscous = np.array([d.viscous.get(name, 0.0) for name in d.joints])
        return viscous, np.array([d.static.get(name, 0.0) for name in d.joints])

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """q'' (n,) [rad/s^2] under the generalised force B_s u + delta + zeta (n,) [N m], by ABA."""
        if self.friction:
            force = force + self.friction_torque(v)
        return self.pinned.acceleration(self._angles(q), self._angles(v), force)

    def kinetic_energy(self, q: Array, v: Array) -> float:
        """q'^T D_s q' / 2 [J], rotors included."""
        return 0.5 * float(v @ self.inertia(q) @ v)

    def potential_energy(self, q: Array) -> float:
        """V(q) [J], zero at the height of the stance foot."""
        return self.pinned.potential_energy(self._angles(q))

    def angular_momentum(self, q: Array, v: Array) -> float:
        """sigma [kg m^2/s]: the row of q_N of D_s q'. sigma' = -dV/dq_N when q_N is not disturbed."""
        return float(self.inertia(q)[-1] @ v)

    # -- kinematics ------------------------------------------------------------------------------
    def swing_foot(self, q: Array) -> Array:
        """p_2 = (x, z) from the stance foot [m]."""
        return self.pinned.position(self._angles(q), self.pinned.swing)

    def swing_foot_jacobian(self, q: Array) -> Array:
        """dp_2/dq_s (2, n) [m]."""
        return self.pinned.jacobian(self._angles(q), self.pinned.swing)

    def swing_foot_velocity(self, q: Array, v: Array) -> Array:
        """(x, z) [m/s]."""
        return self.swing_foot_jacobian(q) @ self._angles(v)

    def hip(self, q: Array) -> Array:
        """(x, z) of the hip from the stance foot [m]."""
        return self.pinned.position(self._angles(q), self.pinned.hip)

    def hip_velocity(self, q: Array, v: Array) -> Array:
        """(x, z) [m/s]."""
        return self.pinned.jacobian(self._angles(q), self.pinned.hip) @ self._angles(v)

    @cached_property
    def mass(self) -> float:
        """Total mass [kg]."""
        return self.pinned.mass

    @property
    def weight(self) -> float:
        """Mass times gravity [N]."""
        return self.mass * self.description.gravity

    # -- contact (2)-(9) -------------------------------------------------------------------------
    def ground_reaction(self, q: Array, v: Array, a: Array) -> Array:
        """Force of the ground on the stance foot (F_T, F_N) [N] in single support at (q, q', q'').

        Newton's law for the COM: F = m (p_com'' - g). Joint torques and pure moments on a link do not
        enter; forces on links from outside would.
        """
        acceleration = self.pinned.centre_of_mass(self._angles(q), v, a)[2]
        return self.mass * (acceleration + np.array([0.0, self.description.gravity]))

    def momentum(self, q: Array, v: Array) -> Array:
        """Linear momentum m p_com' (x, z) [N s] in single support at (q, q')."""
        return self.mass * self.pinned.centre_of_mass(self._angles(q), self._angles(v))[1]

    def extended_inertia(self, q: Array) -> Array:
        """D_e(q) (n + 2, n + 2) of (2)."""
        return self.floating.extended_inertia(self._angles(q))

    def E_2(self, q: Array) -> Array:
        """dp_2/dq_e (2, n + 2) of (4)."""
        return self.floating.swing_jacobian(self._angles(q))

    def impact(self, q: Array, v: Array) -> Impact:
        """Delta (8) and Sigma (9) at (q-, q'-), and the relabelled state after it."""
        return self.floating.impact(self._angles(q), self._angles(v), self.R, self._offset)

    # -- variations ------------------------------------------------------------------------------
    def with_errors(
        self,
        mass: Mapping[str, float] | None = None,
        inertia: Mapping[str, float] | None = None,
        friction: bool | None = None,
    ) -> Biped:
        """The robot with masses and inertias multiplied, by class or link name: `delta` of (1).

        `mass` alone leaves the inertias about the COM as they are. Raises ModelError for an unknown
        body or a factor that is not positive.
        """
        check_part(mass, "mass", Mapping, NoneType)
        check_part(inertia, "inertia", Mapping, NoneType)
        factors = {"mass": mass or {}, "inertia": inertia or {}}
        for kind, by_body in factors.items():
            for body, factor in by_body.items():
                if not (math.isfinite(factor) and factor > 0):
                    raise ModelError(f"{kind} factor of '{body}' is {factor}, expected > 0")
        friction = self.friction if friction is None else friction
        return replace(self, tree=self.scaled(factors), friction=friction)

    def scaled(self, factors: Mapping[str, Mapping[str, float]]) -> Tree:
        """The tree with "mass", "com" or "inertia" multiplied: by kind, then by class or link name.

        Raises ModelError for an unknown body, or one without mass.
        """
        inertials: dict[str, Inertial] = {}
        for kind, by_body in factors.items():
            for body, factor in by_body.items():
                for link in self._links(body):
                    old = inertials.get(link) or self.tree.links[link].inertial
                    if old is None:
                        raise ModelError(f"link '{link}' has no mass, so its {kind} has no error")
                    inertials[link] = old.scaled(kind, factor)
        return self.tree.with_inertials(inertials)

    def _links(self, body: str) -> tuple[str, ...]:
        if body in self.description.links:
            return self.description.links[body]
        if body in self.tree.links:
            return (body,)
        known = [*self.description.links, *self.tree.links]
        raise ModelError(f"robot '{self.description.name}' has no body '{body}'; it has {known}")

    def _angles(self, q: Array) -> Array:
        return finite_angles(q, (self.n,))
