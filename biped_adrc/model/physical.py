"""Checks of a robot read from a file: planar joints, well-conditioned numbers, and laws of mechanics.

Masses and inertias are checked one by one where the file is read (`model.robots.urdf`). Here they are checked
together: joint axes that leave the plane, a mass beside another 1e20 times as large, lengths whose squares
overflow. So D_s, Omega and the impact are evaluated at a few random states. `Biped.check` calls
`check_planar` and `check_numbers` whenever a robot is loaded or changed.

An import has many ways to be subtly wrong: a sense, an offset, an inertia in the wrong frame. These
laws hold for every planar biped, so they need no reference values. They are checked at random states q (n,)
[rad], q' (n,) [rad/s]; - and + stand for just before and just after an impact:

    D_s = Z^T M Z,  Omega = Z^T (nle + M dZ/dt q')    pinned = floating, constrained at the stance foot
    E_2 q_e+' = 0,  H+ = H-,  T+ <= T-                the plastic impact
    Theta' = -1 rad/s                                 while the robot topples forwards at 1 rad/s

    D_s, Omega    inertia matrix [kg m^2], Coriolis and gravity terms [N m] of the pinned model
    M, nle        the same of Pinocchio's floating model, which has n + 2 velocities
    Z             (n + 2, n), from q' to these velocities with the stance foot at rest
    q_e           (q, p_e), with the stance foot p_e (2,) [m]
    E_2           (2, n + 2), Jacobian of the swing foot p_2 by q_e
    H             angular momentum about p_2 [kg m^2/s], from masses, COM velocities and spins of the bodies
                  (`contact.LinkMotion`)
    T             kinetic energy [J]
    Theta         phase of the gait [rad], c q with the row c of `Biped.phase`

Also checked are the places of hip and swing foot, and at an impact the angular momentum of the old leg about
its joints and the linear momentum. That D_s is well conditioned and that the legs are alike is checked for
every robot, by `Biped.check`. `import_robot.derive` runs these laws; `biped_from_urdf` refuses a robot
for which one is broken. The reproduction of the paper holds its robot against them too.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
import pinocchio as pin

from biped_adrc.core.errors import ModelError, SingularError
from biped_adrc.core.types import Array
from biped_adrc.core.verdict import Check, at_most
from biped_adrc.model.contact import Impact, LinkMotion
from biped_adrc.model.pinned import XZ, frame_index
from biped_adrc.model.robots.robot_toml import RobotDescription
from biped_adrc.model.robots.urdf import Tree, Vector, text_of

if TYPE_CHECKING:
    from biped_adrc.model.biped import Biped

STATES, SEED = 4, 5
ACCURACY = 1e-6
"""Largest relative round-off in D_s^-1, eps times its condition [1]; feet of 1e-7 of the hip's mass have
1e-8."""
_ALONG = 1e-6  # how far an axis may be from y, x or z, dimensionless


def check_planar(tree: Tree, d: RobotDescription) -> None:
    """Check that joints turn about y and that the base slides along x and z.

    Raises ModelError that names the joint, its axis and the expected one.
    """
    x, y, z = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    axes: dict[str, Vector] = {d.base[0]: x, d.base[1]: z, **dict.fromkeys(d.joints, y)}
    joints = {joint.name: joint for joint in tree.joints}
    for name, axis in axes.items():
        kind = "revolute" if axis == y else "prismatic"
        joint = joints.get(name)
        along = 0.0 if joint is None else float(np.dot(joint.axis, axis))
        off = 1.0 - (abs(along) if kind == "revolute" else along)
        if joint is None or joint.type != kind or not abs(off) <= _ALONG:
            text = f"missing in {list(joints)}"
            if joint is not None:
                text = f"{joint.type} along {text_of(joint.axis)}"
            raise ModelError(
                f"'{tree.source}': joint '{name}' of the record of robot '{d.name}' is {text}, expected "
                f"{kind} along {text_of(axis)}: a planar robot moves in x and z"
            )


def check_numbers(biped: Biped) -> None:
    """Check at random states that D_s is positive definite and well conditioned, and
    Omega and the impact finite.

    Raises ModelError with what to look for in the URDF.
    """
    random, n = np.random.default_rng(SEED), biped.n
    where = f"'{biped.tree.source}', robot '{biped.description.name}'"
    for _ in range(STATES):
        q, v = random.uniform(-np.pi, np.pi, n), random.normal(0.0, 3.0, n)
        with np.errstate(all="ignore"):
            D, Omega = biped.inertia(q), biped.bias(q, v)
            least, most = np.linalg.eigvalsh(D)[[0, -1]] if np.all(np.isfinite(D)) else (-1.0, 0.0)
            fits = most * np.finfo(float).eps <= ACCURACY * least
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


LIMIT = 1e-9
"""Largest relative gap of a law; double precision leaves about 1e-12."""


def checks(biped: Biped) -> tuple[Check, ...]:
    """Check the laws at `STATES` random states drawn with `SEED`, one `Check` per law.
    A NaN counts as violated.
    """
    laws = largest_gaps(biped, 20, 0)
    return tuple(at_most(law, "law", gap, LIMIT) for law, gap in laws.items())


def largest_gaps(biped: Biped, states: int, seed: int) -> dict[str, float]:
    """Largest relative gap of each law over `states` random states: angles in +-pi, rates of 3 rad/s."""
    random, laws = np.random.default_rng(seed), dict[str, float]()
    for _ in range(states):
        q, v = random.uniform(-np.pi, np.pi, biped.n), random.normal(0.0, 3.0, biped.n)
        for law, gap in (*_single_support(biped, q, v), *_impact(biped, q, v)):
            # np.maximum keeps a nan
            laws[law] = float(np.maximum(laws.get(law, 0.0), gap))
    return laws


def _gap(found: Array, expected: Array) -> float:
    """Largest difference of two arrays relative to the largest entry of the expected one."""
    return float(np.max(np.abs(found - expected)) / np.max(np.abs(expected)))


def _single_support(b: Biped, q: Array, v: Array) -> Iterator[tuple[str, float]]:
    """Check the laws of single support at q, v (n,) [rad, rad/s]; yields the sentence of
    each and its relative gap.

    They are D_s and Omega, the places of hip and foot, and the direction of the phase.
    """
    D, Omega = b.floating.projected(q, v)
    yield "D_s of the pinned model is the floating one's, constrained", _gap(b.inertia(q), D)
    yield "Omega of the pinned model is the floating one's, constrained", _gap(b.bias(q, v), Omega)
    f = b.floating
    pin.framesForwardKinematics(f.model, f.data, f.configuration(q))
    frames = (frame_index(f.model, name) for name in (b.description.hip, b.description.swing_foot))
    places = np.array([f.data.oMf[frame].translation[XZ] for frame in frames])
    gap = _gap(np.array((b.hip(q), b.swing_foot(q))), places)
    yield "hip and swing foot are where the floating model has them", gap
    topple = np.zeros(b.n)
    topple[-1] = 1.0
    x, z = b.hip(q)
    forwards = np.sign(b.hip_velocity(q, topple) @ np.array([z, -x]))
    yield "Theta falls as the robot topples forwards", abs(float(forwards * b.phase[-1]) + 1.0)


def _impact(b: Biped, q: Array, v: Array) -> Iterator[tuple[str, float]]:
    """Check the laws of the plastic impact at q, v (n,) [rad, rad/s]; yields the sentence of
    each and its relative gap.

    Changes of momenta are divided by the momentum of the whole robot at the same kinetic energy.
    """
    hit, reach = b.impact(q, v), max(np.linalg.norm(b.swing_foot(q)), np.linalg.norm(b.hip(q)))
    before, after = b.kinetic_energy(q, v), b.kinetic_energy(hit.q, hit.v)
    foot = b.E_2(q) @ hit.v_e
    yield "impact: the new stance foot is at rest", float(np.max(np.abs(foot)) / np.linalg.norm(v))
    yield "impact: kinetic energy does not grow", float(np.maximum(0.0, after / before - 1.0))
    momentum = np.sqrt(2.0 * before * b.mass)
    whole, leg, linear = impact_momenta(b, q, v, hit) / (momentum * np.array([reach, reach, 1.0]))
    yield "impact: angular momentum about the new foot is kept", float(whole)
    yield "impact: angular momentum of the old leg about its joints is kept", float(leg)
    yield "impact: momentum, pinned at the new foot, is the floating one's", float(linear)


def impact_momenta(b: Biped, q: Array, v: Array, hit: Impact) -> Array:
    """Changes of conserved quantities in an impact (3,), in [kg m^2/s, kg m^2/s, kg
    m/s]; zero up to round-off.

    q, v: (n,) before the impact [rad, rad/s]; hit: its result. The angular momentum of all links about the new
    foot, since the only impulse acts there; that of the old leg about its hip and its knee, since ideal joints
    transmit no impulsive torque; and the linear momentum, computed once before the relabelling and once pinned
    at the new foot after it.
    """
    before = LinkMotion(b.floating, q, np.append(v, [0.0, 0.0]))
    after, foot = LinkMotion(b.floating, q, hit.v_e), b.swing_foot(q)
    whole = abs(after.about(foot) - before.about(foot))
    leg = [abs(after.outboard(j) - before.outboard(j)) for j in before.old_leg()]
    linear = b.momentum(hit.q, hit.v) - after.momentum().linear[XZ]
    return np.array([whole, np.max(leg, initial=0.0), np.max(np.abs(linear))])
