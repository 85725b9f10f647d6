"""Gait (b): the paper's own recipe, section IV.

"The trajectory for the hip is taken as a sine function and the step length is a fraction of the human step
length"; joint trajectories by inverse kinematics, and "a high order polynomial regression" on Theta. Over the
share s in [0, 1] of a step, from the stance foot, with (x*, z*) the hip and L the step length at x*:

    hip    x = x* - L (1 - s),                               z = z* + A sin(pi s)
    swing  x = -L + 2 L (c s + (1 - c) (1 - cos(pi s)) / 2), z = H sin(pi s)
    torso  q5 = q5* - B sin(2 pi s)

The pose of x* gives L, x*, z* and q5*. The free parameters (A, H, c, B) follow from the ratios of hip,
swing-foot and torso rates at x*; the speed does not. The constraint is not hybrid-invariant: the impact
is not smooth, as section VII says.

`design_recipe_gait` gives the gait with the periodic orbit of its zero dynamics, as if the impact were smooth;
`validation.gaits.design_recipe_orbit` replaces that orbit by the one of the closed loop.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.core.types import Array
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.curves import Polynomial
from biped_adrc.gait.gait import Gait, onto_section
from biped_adrc.gait.published import X_STAR
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped

HUMAN_STEP = 0.70
"""[m], step length of adults at comfortable speed, about 0.70 m for men and 0.64 m for women (Scientific
Reports 11, 2021, s41598-021-91633-1, Table 1). Only the fraction depends on it: L comes from x*."""
SAMPLES = 401
"""Number of points over a step at which inverse kinematics is solved for the regression."""


@dataclass(frozen=True)
class RecipeParameters:
    """Free parameters of the recipe of section IV, and the degree of the regression."""

    step_fraction: float
    """L / HUMAN_STEP, from the pose of x*."""
    hip_amplitude: float
    """A [m], from the direction of the hip velocity at x*."""
    clearance: float
    """H [m], from the direction of the swing-foot velocity at x*."""
    evenness: float
    """c: 1 moves the swing foot evenly, 0 starts and stops it, from its forward speed at x*."""
    torso_amplitude: float
    """B [rad], from the rate of the torso at x*."""
    degree: int = 8
    """Degree of the polynomials of the regression."""


def fit_to_x_star(biped: Biped) -> RecipeParameters:
    """Fit the parameters to the pose of x* and the ratios of its hip, swing-foot and torso rates.

    With the hip moving evenly, x' = L s', so z'/x' = -pi A / L at the hip, at the swing foot x2'/x' = 2 c and
    z2'/x' = -pi H / L, and q5'/x' = -2 pi B / L.
    """
    q = onto_section(biped, X_STAR[: biped.n])
    v = np.array(X_STAR[biped.n :])
    L = float(biped.swing_foot(q)[0])
    hip, foot = biped.hip_velocity(q, v), biped.swing_foot_velocity(q, v)
    return RecipeParameters(
        step_fraction=L / HUMAN_STEP,
        hip_amplitude=float(-hip[1] / hip[0]) * L / np.pi,
        clearance=float(-foot[1] / hip[0]) * L / np.pi,
        evenness=float(foot[0] / hip[0]) / 2.0,
        torso_amplitude=float(-v[-1] / hip[0]) * L / (2.0 * np.pi),
    )


def inverse_kinematics(leg: Array, length: float) -> tuple[float, float]:
    """Absolute thigh angle and knee angle (backwards, < 0) [rad] for the vector `leg`
    from hip to foot (2,) [m].

    length [m]: of thigh and of shin. A link of angle a points along (-sin a, cos a).
    """
    reach = float(np.hypot(*leg))
    knee = -2.0 * float(np.arccos(reach / (2.0 * length)))
    thigh = float(np.arctan2(-leg[0], leg[1])) - 0.5 * knee
    return thigh % (2.0 * np.pi), knee


def joint_trajectories(biped: Biped, p: RecipeParameters, s: Array) -> Array:
    """Configurations q (K, 5) [rad] at the shares s (K,) of a step, by inverse kinematics of both legs."""
    pose = onto_section(biped, X_STAR[: biped.n])
    x_hip, z_hip = biped.hip(pose)
    length = 0.5 * float(np.linalg.norm(biped.hip(np.zeros(biped.n))))
    L = p.step_fraction * HUMAN_STEP
    rows = []
    for share in s:
        lift = np.sin(np.pi * share)
        hip = np.array([x_hip - L * (1.0 - share), z_hip + p.hip_amplitude * lift])
        eased = 0.5 * (1.0 - np.cos(np.pi * share))
        along = p.evenness * share + (1.0 - p.evenness) * eased
        foot = np.array([-L + 2.0 * L * along, p.clearance * lift])
        stance, stance_knee = inverse_kinematics(-hip, length)
        swing, swing_knee = inverse_kinematics(foot - hip, length)
        torso = pose[4] - p.torso_amplitude * np.sin(2.0 * np.pi * share)
        rows.append([stance - torso, swing - torso, stance_knee, swing_knee, torso])
    return np.array(rows)


def regress(theta: Array, joints: Array, degree: int) -> tuple[Polynomial, float]:
    """Fit polynomials of s to joint angles over the phase; also returns the largest residual [rad].

    theta: phases (K,) [rad]. joints: angles (K, p) [rad]. The polynomials pass exactly through both ends,

        h(s) = h(0) + (h(1) - h(0)) s + s (1 - s) sum_k b_k s^k

    and b_k is least squares, so that the poses at impact are kept.
    """
    s = (theta - theta[0]) / (theta[-1] - theta[0])
    basis = (s * (1.0 - s))[:, np.newaxis] * s[:, np.newaxis] ** np.arange(degree - 1)
    straight = joints[0] + np.outer(s, joints[-1] - joints[0])
    b = np.linalg.lstsq(basis, joints - straight, rcond=None)[0].T
    a = np.zeros((joints.shape[1], degree + 1))
    a[:, 0], a[:, 1] = joints[0], joints[-1] - joints[0]
    a[:, 1:-1] += b
    a[:, 2:] -= b
    return Polynomial(a), float(np.max(np.abs(straight + basis @ b.T - joints)))


def recipe_constraint(biped: Biped, p: RecipeParameters) -> tuple[VirtualConstraint, float]:
    """The virtual constraint of the recipe and the largest residual of its regression [rad]."""
    q = joint_trajectories(biped, p, np.linspace(0.0, 1.0, SAMPLES))
    theta = q @ biped.phase
    curve, residual = regress(theta, q[:, : biped.p], p.degree)
    return VirtualConstraint(curve, biped.phase, float(theta[0]), float(theta[-1])), residual


def design_recipe_gait(biped: Biped) -> Gait:
    """Gait (b) with the pre-impact state of its zero dynamics, as if the impact were smooth.

    Raises GaitError when there is no periodic orbit.
    """
    p = fit_to_x_star(biped)
    constraint, residual = recipe_constraint(biped, p)
    provenance = {
        "method": "section IV: hip sine, inverse kinematics, polynomial regression on Theta",
        "source": "pose of x*, section VI; free parameters from the ratios of its rates",
        "step length [m]": f"{p.step_fraction * HUMAN_STEP:.6f}, {p.step_fraction:.4f} of {HUMAN_STEP} m",
        "hip amplitude [m]": f"{p.hip_amplitude:.6f}",
        "clearance [m]": f"{p.clearance:.6f}",
        "evenness of the swing foot": f"{p.evenness:.6f}",
        "torso amplitude [rad]": f"{p.torso_amplitude:.6f}",
        "degree": str(p.degree),
        "regression residual [rad]": f"{residual:.2e}",
        "command": "python -m validation.gaits",
    }
    return Gait.of_cycle("recipe", ZeroDynamics.of(biped, constraint), provenance)
