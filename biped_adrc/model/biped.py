"""The planar biped in the paper's coordinates q_s = (q_b, q_N): single support and impact.

    D_s(q) q'' + C(q, q') q' + G_s(q) = B_s u + delta + zeta         (1) of the paper

q_b (p,) are the actuated joints (for RABBIT: stance hip, swing hip, stance knee, swing knee), q_N is the
absolute pitch of the torso. Angles are counter-clockwise positive with x to the right and z up; a link of
absolute angle a points along (-sin a, cos a).

    D_s             inertia matrix (n, n) [kg m^2] of the robot pinned at its stance foot
    C, G_s, Omega   Coriolis matrix (n, n) [N m s], torques of gravity (n,) [N m], Omega = C q' + G_s
    u, B_s          torques of the motors (p,) [N m], and the constant matrix (n, p) by which they act
    delta, zeta     error of the model, and external generalised force, each (n,) [N m]
    kappa, xi       (1) solved for the joints with motors: q_b'' = kappa u + xi, see `reduction`
    R, r            relabelling of the legs at an impact, q+ = R q- + r, from just before to just after it

`Biped` joins a robot's record (`model.robots.robot_toml`), its URDF tree and two Pinocchio models made from
that tree: `pinned` at the stance foot for single support, `floating` for the impact. The rest of the package
takes the numbers of a robot from this class. Use it for the plant and for the controller's nominal model alike;
they are two objects when the model is wrong. Pinocchio counts the angles of the pinned tree from the ground, so
the methods below pass T q, with the constant matrix T (n, n) of `pinned`, and map forces back by its transpose
(k.T.T in the code, where k is `pinned`). A prime is a time derivative.

At an impact the legs exchange their roles. The coordinates are named by role, so both q and v are relabelled:
the coordinate of the stance hip gets the angle of the former swing hip, and so on. Two joints that change over
are twins. A body of the record, such as "thigh", is a link or both links that are twins.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NoReturn, Self

import numpy as np
import pinocchio as pin

from biped_adrc.core.errors import ModelError, SingularError
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, Indices, frozen, read_only
from biped_adrc.model.contact import FloatingDynamics, Impact
from biped_adrc.model.pinned import PinnedDynamics, finite_angles, reroot
from biped_adrc.model.reduction import BodyTerms, Reduction, reduce
from biped_adrc.model.robots.robot_toml import RobotDescription, Rotors, load_description
from biped_adrc.model.robots.urdf import Inertial, Joint, Tree, absolute_angles, relabelling, unlike

STICTION_SPEED = 0.05
"""Width [rad/s] of the smoothed sign tanh(v / STICTION_SPEED) of static friction."""


@dataclass(frozen=True)
class Biped(Shown):
    """A robot with one set of parameters. Make it with `Biped.load`.

    Methods take q (n,) [rad], v = q' (n,) [rad/s] and a = q'' (n,) [rad/s^2] in the order of
    `description.joints`. They raise InputError for another shape and NotFiniteError for NaN or infinity, which
    `_angles` tests.
    Pinocchio's work data inside is overwritten by every call: use one Biped per thread.

    >>> biped = ba.Biped.load("rabbit")
    >>> biped.inertia(np.zeros(5)).shape, round(biped.mass, 1)
    ((5, 5), 32.0)
    """

    SUCH_AS = "Biped.load('rabbit')"  # the example in messages that expect a Biped

    description: RobotDescription
    """The record robot.toml: names of joints and feet, limits, phase, presets."""
    tree: Tree
    """Links and joints as in the URDF, with the masses of the preset, rooted at the planar base."""
    preset: str
    """Name of the parameter set."""
    armature: Rotors
    """Rotor inertia of every motor, or of each one, reflected to its joint [kg m^2]."""
    friction: bool = False
    """Whether `acceleration` includes the joint friction of the record."""

    # says to `core.part.once` that nothing in a Biped changes, so results of it may be kept
    _constant = True

    def __repr__(self) -> str:
        name, parts = self.description.name, f"n = {self.n}, p = {self.p}, {self.mass:.4g} kg"
        return f"Biped('{name}', preset '{self.preset}': {parts}{', friction' if self.friction else ''})"

    @classmethod
    def load(
        cls, robot: str | Path = "rabbit", preset: str | None = None, friction: bool = False
    ) -> Self:
        """Load a robot by name or by the path of its robot.toml, with a parameter preset (None: its default).

        friction: add the record's viscous and static joint friction to the dynamics. Raises ModelError for an
        unknown robot or preset, or a URDF that is not physical.
        """
        description = load_description(robot)
        record = description.preset(preset)
        tree = description.tree(record.name)
        return cls(description, tree, record.name, record.armature, friction).check()

    def check(self) -> Self:
        """Return this robot after both models are built and checked; raises ModelError for wrong numbers,
        unequal legs or motors without a twin.

        Relabelling at impact is right only for equal legs. Tested at one state, with numbers of no meaning:
        when the legs exchange their roles, neither the kinetic energy about the COM may change, nor the COM's
        height above one and the same foot.
        """
        self.description.check_planar(self.tree)
        check_numbers(self)
        q, v = 0.3 * np.arange(1.0, self.n + 1.0), np.cos(np.arange(float(self.n)))
        x, w = self.relabel(q), self.R @ v
        total = [self.kinetic_energy(a, b) for a, b in ((q, v), (x, w))]
        # p^2 / (2 m) is the energy of the COM's own motion; it differs, as another foot is at rest
        moved = [0.5 * np.sum(self.momentum(a, b) ** 2) / self.mass for a, b in ((q, v), (x, w))]
        about, round_off = np.subtract(total, moved), 1e-13 * max(total)
        # heights [m] of the COM above the stance foot, which after the exchange is the former swing foot
        before, after = (self.potential_energy(y) / self.weight for y in (q, x))
        same = math.isclose(before - self.swing_foot(q)[1], after, rel_tol=1e-9, abs_tol=1e-9)
        if not (math.isclose(*about, rel_tol=1e-9, abs_tol=round_off) and same):
            raise ModelError(
                f"'{self.tree.source}': the legs differ in mass or length, as in the links "
                f"{[(*x, f'{gap:.3g}') for x, gap in unlike(self.tree, self.description.feet).items()]} "
                "(largest relative difference), or in a link fixed to one leg; they change over at impact, so "
                "make them equal"
            )
        _ = self.swap  # raises for motors that have no twin
        return self

    # -- sizes and names -----------------------------------------------------------------------
    @cached_property
    def n(self) -> int:
        """Number of coordinates N: joints with a motor, joints without one, and the pitch, in this order."""
        return len(self.description.joints)

    @cached_property
    def p(self) -> int:
        """Number of motors; the first p coordinates are the actuated ones."""
        return len(self.description.actuated)

    @cached_property
    def motor_joints(self) -> tuple[tuple[Joint, ...], tuple[Joint, ...]]:
        """The joints of the URDF with the angles q_1, ..., q_p: entry k % 2 of the pair in single support k,
        from 1, so [1] in odd ones and [0] in even ones.

        In even ones the legs have changed over, and q_i is the angle of the twin in the other leg; where
        `swap` changes the sign, the joint is mirrored: its axis and its range are those of the negative angle.
        """
        joints = {joint.name: joint for joint in self.tree.joints}
        own = [joints[name] for name in self.description.actuated]
        both = [*own, *(joint.mirrored for joint in own)]
        return tuple(both[k] for k in self.swap), tuple(own)

    @cached_property
    def B(self) -> Array:
        """Input matrix B_s = [I; 0] (n, p) of (1), dimensionless."""
        return read_only(np.eye(self.n)[:, : self.p])

    @cached_property
    def phase(self) -> Array:
        """Row c (n,) of the phase variable Theta = c q [rad], by which a gait is timed; c is dimensionless."""
        return read_only(self.description.phase)

    @cached_property
    def R(self) -> Array:
        """Matrix R (n, n), dimensionless, of q+ = R q- + r and v+ = R v-, which exchanges the legs at impact;
        for r see `relabel`.

        Raises ModelError where no linear map exchanges the legs.
        """
        return read_only(relabelling(self.tree, self.description.joints, self.description.feet))

    def relabel(self, q: Array) -> Array:
        """Relabel the configuration q (n,) [rad] for the next single support: R q + r (n,) [rad].

        r is `description.offset`, 0 but for robots with spokes, such as a rimless wheel.
        """
        return self.R @ q + self.description.offset

    @cached_property
    def swap(self) -> Indices:
        """Relabelling of the motors at an impact (p,), ints: new joint i is entry swap[i] of (q_b, -q_b).

        States of controllers and observers, and torques, are relabelled by it (`types.relabelled`). A motor
        between the legs changes its sign. Raises ModelError where a row of R for a motor is no single 1 or -1
        among the motors, or has an offset.
        """
        p, moved, offset = self.p, self.R[: self.p], np.array(self.description.offset)
        # a 1 in column j of (R, -R) says that the new angle is +q_j, or -q_(j - p) for j >= p
        ones = np.concatenate((moved[:, :p], -moved[:, :p]), axis=1) == 1.0
        fits = ones.any(axis=1) & (np.count_nonzero(moved, axis=1) == 1) & (offset[:p] == 0.0)
        if not fits.all():
            bad = [self.description.actuated[i] for i in np.flatnonzero(~fits)]
            raise ModelError(
                f"robot '{self.description.name}': the angles of the motors {bad} are combined with others as "
                "the legs change over, and a controller is relabelled by exchanging motors. Expected a motor "
                "for either leg, as between torso and thighs, or one between the legs; give the robot other "
                "joints, or no motors (--actuated '')"
            )
        return frozen(np.nonzero(ones)[1])  # the column of the only 1 in each row

    # -- the two Pinocchio models ----------------------------------------------------------------
    @cached_property
    def pinned_tree(self) -> Tree:
        """The tree turned round: it hangs from the stance foot, which a joint pins to the ground."""
        return reroot(self.tree, self.description.stance_foot, self.description.trunk)

    @cached_property
    def pinned(self) -> PinnedDynamics:
        """Dynamics (1), from the model pinned at the stance foot.

        Raises ModelError unless the trunk, the link that the floating base carries, hangs on the joint of the
        record's pitch.
        """
        d, pitch = self.description, self.tree.joint_above(self.description.trunk)
        if pitch is None or pitch.name != d.unactuated:
            raise ModelError(
                f"'{self.tree.source}': link '{d.trunk}' hangs on "
                f"'{pitch.name if pitch else 'nothing'}', expected '{d.unactuated}'"
            )
        # row (n,): the absolute angle of the stance foot's link is its product with q
        chain = absolute_angles(self.tree, d.joints, [d.stance_foot])[0]
        return PinnedDynamics(self.pinned_tree, d, chain, self.armature)

    @cached_property
    def floating(self) -> FloatingDynamics:
        """Unpinned dynamics (2) and impact (7), from the model with a planar base."""
        return FloatingDynamics(self.tree, self.description, self.armature)

    # -- single support (1), (11)-(15) -----------------------------------------------------------
    def inertia(self, q: Array) -> Array:
        """Inertia matrix D_s(q) (n, n) [kg m^2], with the rotors' inertia."""
        k = self.pinned
        return k.T.T @ pin.crba(k.model, k.data, k.T @ self._angles(q)) @ k.T

    def bias(self, q: Array, v: Array) -> Array:
        """Coriolis and gravity terms Omega(q, q') = C q' + G_s (n,) [N m] of (11)."""
        k, x, w = self.pinned, self._angles(q), self._angles(v)
        return k.T.T @ pin.nonLinearEffects(k.model, k.data, k.T @ x, k.T @ w)

    def gravity(self, q: Array) -> Array:
        """Torques of gravity G_s(q) = dV/dq (n,) [N m]."""
        k = self.pinned
        return k.T.T @ pin.computeGeneralizedGravity(k.model, k.data, k.T @ self._angles(q))

    def coriolis(self, q: Array, v: Array) -> Array:
        """Coriolis matrix C(q, q') (n, n) [N m s], that one for which dD_s/dt - 2 C is skew-symmetric."""
        k, x, w = self.pinned, self._angles(q), self._angles(v)
        return k.T.T @ pin.computeCoriolisMatrix(k.model, k.data, k.T @ x, k.T @ w) @ k.T

    def reduction(self, q: Array, v: Array) -> Reduction:
        """The model of the joints q_b, q_b'' = kappa u + xi, at (q, q') (n,) [rad, rad/s], by (11)-(15): q_N''
        is eliminated. `Reduction` has its terms.
        """
        return reduce(self.inertia(q), self.bias(q, v), self.p)

    def body_terms(self, q: Array, v: Array) -> BodyTerms:
        """Terms at (q, q') for controllers that shape the momentum D_s q' or bound the force of the ground.

        Gravity G and C^T q' (n,) [N m], that force as F_a q'' + F_0 (2,) [N], the Jacobian J_2 (2, n) [m] of
        the swing foot, the mass [kg]: see `BodyTerms`.
        """
        q, v = self._angles(q), self._angles(v)
        F_0 = self.ground_reaction(q, v, np.zeros(self.n))
        F_a, J_2 = self.pinned.mass_jacobian(q), self.pinned.jacobian(q, self.pinned.swing)
        return BodyTerms(self.gravity(q), self.coriolis(q, v).T @ v, F_a, F_0, J_2, self.mass)

    def friction_torque(self, v: Array) -> Array:
        """Joint friction (n,) [N m]: -viscous v - static tanh(v / STICTION_SPEED), at rates v (n,) [rad/s].

        Zero if the robot was loaded without friction.
        """
        if not self.friction:
            return np.zeros(self.n)
        viscous, static = self.friction_coefficients
        return -viscous * v - static * np.tanh(v / STICTION_SPEED)

    def friction_derivative(self, v: Array) -> Array:
        """d/dv of the joint friction -viscous v - static tanh(v / STICTION_SPEED) (n, n) [N m s/rad] at rates v
        (n,) [rad/s]: diagonal. Zero if the robot was loaded without friction.
        """
        if not self.friction:
            return np.zeros((self.n, self.n))
        viscous, static = self.friction_coefficients
        smooth = 1.0 - np.tanh(v / STICTION_SPEED) ** 2
        return np.diag(-viscous - static * smooth / STICTION_SPEED)

    @cached_property
    def friction_coefficients(self) -> tuple[Array, Array]:
        """Viscous [N m s/rad] and static [N m] friction, each (n,), as in the record."""
        d = self.description
        viscous = read_only([d.viscous.get(name, 0.0) for name in d.joints])
        return viscous, read_only([d.static.get(name, 0.0) for name in d.joints])

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """q'' (n,) [rad/s^2] under the generalised force B_s u + delta + zeta (n,) [N m].

        It is computed by the articulated body algorithm; joint friction is added where `friction` is set. With
        T q the coordinates of the pinned tree, the tree's torques are T^-T force, and q'' = T^-1 a_tree, with
        T^-1 in k.inverse.
        """
        if self.friction:
            force = force + self.friction_torque(v)
        k, x, w = self.pinned, self._angles(q), self._angles(v)
        return k.inverse @ pin.aba(k.model, k.data, k.T @ x, k.T @ w, k.inverse.T @ force)

    def kinetic_energy(self, q: Array, v: Array) -> float:
        """Kinetic energy q'^T D_s q' / 2 [J] with the stance foot at rest, with the rotors' inertia."""
        return 0.5 * float(v @ self.inertia(q) @ v)

    def potential_energy(self, q: Array) -> float:
        """Potential energy V(q) [J], zero at the height of the stance foot."""
        k = self.pinned
        return float(pin.computePotentialEnergy(k.model, k.data, k.T @ self._angles(q)))

    def angular_momentum(self, q: Array, v: Array) -> float:
        """Angular momentum sigma [kg m^2/s] about the stance foot, counter-clockwise: the last row of D_s q'.

        sigma' = -dV/dq_N (potential energy V) while zeta has no component at q_N, since no motor acts there.
        """
        return float(self.inertia(q)[-1] @ v)

    # -- kinematics ------------------------------------------------------------------------------
    def swing_foot(self, q: Array) -> Array:
        """Position p_2 = (x, z) of the swing foot from the stance foot (2,) [m]."""
        return self.pinned.position(self._angles(q), self.pinned.swing)

    def swing_foot_jacobian(self, q: Array) -> Array:
        """Jacobian dp_2/dq_s (2, n) [m] of the swing foot's position p_2."""
        return self.pinned.jacobian(self._angles(q), self.pinned.swing)

    def swing_foot_velocity(self, q: Array, v: Array) -> Array:
        """Velocity (x, z) of the swing foot (2,) [m/s], the stance foot at rest."""
        return self.swing_foot_jacobian(q) @ self._angles(v)

    def hip(self, q: Array) -> Array:
        """Position (x, z) of the hip from the stance foot (2,) [m]."""
        return self.pinned.position(self._angles(q), self.pinned.hip)

    def hip_velocity(self, q: Array, v: Array) -> Array:
        """Velocity (x, z) of the hip (2,) [m/s], the stance foot at rest."""
        return self.pinned.jacobian(self._angles(q), self.pinned.hip) @ self._angles(v)

    @cached_property
    def mass(self) -> float:
        """Total mass [kg]."""
        return float(pin.computeTotalMass(self.pinned.model))

    @property
    def weight(self) -> float:
        """Weight of the robot [N], its mass times gravity."""
        return self.mass * self.description.gravity

    # -- contact (2)-(9) -------------------------------------------------------------------------
    def ground_reaction(self, q: Array, v: Array, a: Array) -> Array:
        """Force of the ground on the stance foot (F_T, F_N) (2,) [N], along x and z, in single support.

        Newton's law for the COM with q'' = a (n,): F = m (p_com'' - g), g = (0, -gravity). Torques in joints
        and pure moments on a link do not enter. External forces on links do: subtract their resultant from F,
        as `analysis.signals` does.
        """
        # [2]: of position, velocity and acceleration of the COM the acceleration
        acceleration = self.pinned.centre_of_mass(self._angles(q), v, a)[2]
        return self.mass * (acceleration + np.array([0.0, self.description.gravity]))

    def momentum(self, q: Array, v: Array) -> Array:
        """Linear momentum m p_com' (x, z) (2,) [N s] in single support at (q, q')."""
        # [1]: of position, velocity and acceleration the velocity, for which any acceleration will do, as 0 v
        return self.mass * self.pinned.centre_of_mass(self._angles(q), self._angles(v), 0.0 * v)[1]

    def extended_inertia(self, q: Array) -> Array:
        """Inertia matrix D_e(q) (n + 2, n + 2) [kg m^2, kg m, kg] of the unpinned model (2), in the coordinates
        q_e = (q_s, p_e) with the stance foot at p_e (2,) [m].
        """
        return self.floating.extended(self._angles(q))[0]  # of (D_e, E_2)

    def E_2(self, q: Array) -> Array:
        """Jacobian E_2 = dp_2/dq_e (2, n + 2) [m, 1] of the swing foot p_2, (4); q_e = (q_s, p_e)."""
        return self.floating.extended(self._angles(q))[1]  # of (D_e, E_2)

    def impact(self, q: Array, v: Array) -> Impact:
        """The plastic impact of the swing foot at (q-, q'-) (n,) [rad, rad/s], by (7): the velocities just
        after it (8), the impulse of the ground (9), and the relabelled state.

        Raises SingularError where (7) is singular.
        """
        q, v = self._angles(q), self._angles(v)
        return self.floating.impact(q, v, self.R, np.array(self.description.offset))

    # -- variations ------------------------------------------------------------------------------
    def scaled(self, factors: Mapping[str, Mapping[str, float]]) -> Tree:
        """The tree with some "mass", "com" or "inertia" multiplied by factors[one of these][body or link] [1].

        Raises ModelError for an unknown body, or one without mass.
        """
        # the body parameters that change, by link; a link may be scaled more than once
        d, inertials = self.description, dict[str, Inertial]()
        # a link may be named too; the name of a body comes first
        bodies = {**d.links, **{link: (link,) for link in self.tree.links if link not in d.links}}
        for kind, by_body in factors.items():
            for body, factor in by_body.items():
                if body not in bodies:
                    raise ModelError(f"robot '{d.name}' has no body '{body}'; it has {[*bodies]}")
                for link in bodies[body]:
                    old = inertials.get(link) or self.tree.links[link].inertial
                    if old is None:
                        raise ModelError(f"link '{link}' has no mass, so its {kind} has no error")
                    inertials[link] = old.scaled(kind, factor)
        return self.tree.with_inertials(inertials)

    @property
    def with_errors(self) -> NoReturn:
        """A method of earlier versions; reading it raises AttributeError, which says what takes its place."""
        raise AttributeError(
            "'Biped' has no attribute 'with_errors'; ba.ModelErrors(mass={'torso': 0.2}).apply(biped) is a "
            "torso of 20 % more"
        )

    def _angles(self, q: Array) -> Array:
        """q (n,) itself [rad] or [rad/s], after a check of its shape and that it is finite."""
        return finite_angles(q, (self.n,))


def check_numbers(biped: Biped) -> None:
    """Check at 4 random states that D_s is positive definite and well conditioned, Omega and the impact finite.

    Masses and lengths are checked one by one where a file is read; this finds those that do not fit together,
    such as a mass beside another that is 1e20 times as large. Well conditioned: the largest eigenvalue times
    the machine epsilon, the relative round-off in D_s^-1, is at most 1e-6 times the least; a robot whose feet
    have 1e-7 of the hip's mass has 1e-8. Raises ModelError with what to look for in the URDF.
    """
    random, n = np.random.default_rng(5), biped.n
    where = f"'{biped.tree.source}', robot '{biped.description.name}'"
    for _ in range(4):
        q, v = random.uniform(-np.pi, np.pi, n), random.normal(0.0, 3.0, n)
        with np.errstate(all="ignore"):
            D, Omega = biped.inertia(q), biped.bias(q, v)
            # least, most = (-1, 0) fails the test below
            least, most = np.linalg.eigvalsh(D)[[0, -1]] if np.all(np.isfinite(D)) else (-1.0, 0.0)
            fits = most * np.finfo(float).eps <= 1e-6 * least
            try:
                fits = fits and np.all(np.isfinite(np.concatenate((Omega, *biped.impact(q, v)))))
            except SingularError:
                fits = False
        if not fits:
            raise ModelError(
                f"{where}: D_s has eigenvalues from {least:.2g} to {most:.2g} kg m^2, expected positive ones "
                "with a ratio that double precision can hold, and Omega and the impact (7) finite; look for a "
                "body that nothing moves, a foot that no joint moves, and for masses, inertias and lengths "
                "that are too large or far apart"
            )
