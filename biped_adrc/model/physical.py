"""Checks of a robot read from a file: planar joints, and well-conditioned numbers.

Masses and inertias are checked one by one where the file is read (`model.robots.urdf`). Here they are checked
together: joint axes that leave the plane, a mass beside another 1e20 times as large, lengths whose squares
overflow. So D_s, Omega and the impact are evaluated at a few random states. `Biped.check` calls both functions
whenever a robot is loaded or changed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from biped_adrc.core.errors import ModelError, SingularError
from biped_adrc.model.robots.robot_toml import RobotDescription
from biped_adrc.model.robots.urdf import Tree, Vector, text_of

if TYPE_CHECKING:
    from biped_adrc.model.biped import Biped

STATES, SEED = 4, 5
ACCURACY = 1e-6
"""Largest relative round-off in D_s^-1, eps times its condition [1]; feet of 1e-7 of the hip's mass
have 1e-8.
"""
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
            text = (
                f"{joint.type} along {text_of(joint.axis)}"
                if joint
                else f"missing in {list(joints)}"
            )
            raise ModelError(
                f"URDF '{tree.source}': joint '{name}' of the record of robot '{d.name}' is {text}, expected "
                f"{kind} along {text_of(axis)}: a planar robot moves in x and z"
            )


def check_numbers(biped: Biped) -> None:
    """Check at random states that D_s is positive definite and well conditioned, and
    Omega and the impact finite.

    Raises ModelError with what to look for in the URDF.
    """
    random, n = np.random.default_rng(SEED), biped.n
    where = f"URDF '{biped.tree.source}', robot '{biped.description.name}'"
    for _ in range(STATES):
        q, v = random.uniform(-np.pi, np.pi, n), random.normal(0.0, 3.0, n)
        with np.errstate(all="ignore"):
            D, Omega = biped.inertia(q), biped.bias(q, v)
            least, most = np.linalg.eigvalsh(D)[[0, -1]] if np.all(np.isfinite(D)) else (-1.0, 0.0)
            if not most * np.finfo(float).eps <= ACCURACY * least:
                raise ModelError(
                    f"{where}: D_s has eigenvalues from {least:.2g} to {most:.2g} kg m^2, expected positive "
                    "ones with a ratio that double precision can hold; look for a body that nothing moves, and "
                    "for masses, inertias and lengths that are far apart"
                )
            try:
                finite = bool(np.all(np.isfinite(np.concatenate((Omega, *biped.impact(q, v))))))
            except SingularError:
                finite = False
        if not finite:
            raise ModelError(
                f"{where}: Omega or the impact (7) is not finite at random angles; look for a foot that no "
                "joint moves, and for masses and lengths that are too large or far apart"
            )
