"""Whether a robot read from a file can be computed with: planar joints, and well-conditioned numbers.

Masses and inertias are checked one by one where the file is read (`robots.urdf`). What is left is
how they go together: joint axes that leave the plane, a mass beside another 1e20 times as large,
lengths whose squares overflow. So D_s, Omega and the impact are evaluated at a few random states.
`Biped.check` calls both functions whenever a robot is loaded or changed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from biped_adrc.errors import ModelError, SingularError
from biped_adrc.model.robots.robot_toml import RobotDescription
from biped_adrc.model.robots.symmetry import text_of
from biped_adrc.model.robots.urdf import Tree, Vector
from biped_adrc.types import Array

if TYPE_CHECKING:
    from biped_adrc.model.biped import Biped

STATES, SEED = 4, 5
ACCURACY = 1e-6
"""Largest relative round-off in D_s^-1 (eps times the condition number), dimensionless. Feet with 1e-7
of the hip's mass still reach 1e-8.
"""
_ALONG = 1e-6  # how far an axis may be from y, x or z, dimensionless


def check_planar(tree: Tree, d: RobotDescription) -> None:
    """Check that joints turn about y and that the base slides along x and z.

    Raises ModelError that names the joint, its axis and the expected one.
    """
    wanted: list[tuple[str, str, Vector]] = [
        (d.base[0], "prismatic", (1.0, 0.0, 0.0)),
        (d.base[1], "prismatic", (0.0, 0.0, 1.0)),
        *((name, "revolute", (0.0, 1.0, 0.0)) for name in d.joints),
    ]
    joints = {joint.name: joint for joint in tree.joints}
    for name, kind, axis in wanted:
        if name not in joints:
            raise ModelError(
                f"URDF '{tree.source}': there is no joint '{name}', which the record of robot '{d.name}' "
                f"names; it has {list(joints)}"
            )
        joint = joints[name]
        along = sum(a * b for a, b in zip(joint.axis, axis, strict=True))
        if kind == "revolute":
            along = abs(along)
        if joint.type != kind or not abs(along - 1.0) <= _ALONG:
            raise ModelError(
                f"URDF '{tree.source}', joint '{name}': {joint.type} along {text_of(joint.axis)}, expected "
                f"{kind} along {text_of(axis)}: a planar robot moves in x and z"
            )


def check_numbers(biped: Biped) -> None:
    """Check at random states that D_s is positive definite and well conditioned, and that Omega and
    the impact are finite. Raises ModelError that says what to look for in the URDF.
    """
    random, n = np.random.default_rng(SEED), biped.n
    where = f"URDF '{biped.tree.source}', robot '{biped.description.name}'"
    for _ in range(STATES):
        q, v = random.uniform(-np.pi, np.pi, n), random.normal(0.0, 3.0, n)
        with np.errstate(all="ignore"):
            D, Omega = biped.inertia(q), biped.bias(q, v)
            _check_definite(D, where)
            try:
                impact = biped.impact(q, v)
            except SingularError as error:
                raise ModelError(
                    f"{where}: {error}; look for a foot that no joint moves, and for masses and lengths that "
                    "are far apart"
                ) from error
            found = {"Omega": Omega, "the impact": np.concatenate(impact)}
        for name, value in found.items():
            if not np.all(np.isfinite(value)):
                raise ModelError(
                    f"{where}: {name} is not finite at random angles; look for masses or lengths that are "
                    "too large"
                )


def _check_definite(D: Array, where: str) -> None:
    """Raise ModelError unless D (n, n) is positive definite with a condition number that doubles can hold."""
    finite = bool(np.all(np.isfinite(D)))
    least, most = np.linalg.eigvalsh(D)[[0, -1]] if finite else (np.nan, np.nan)
    if not most * np.finfo(float).eps <= ACCURACY * least:
        raise ModelError(
            f"{where}: D_s has eigenvalues from {least:.2g} to {most:.2g} kg m^2, expected positive ones with "
            "a ratio that double precision can hold; look for a body that nothing moves, and for masses, "
            "inertias and lengths that are far apart"
        )
