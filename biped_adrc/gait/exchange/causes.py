"""For samples of a step that a robot's dynamics do not give: which one change of the robot would explain them.

From angles over time alone, gravity and a scale of all lengths cannot be told apart (q(t) depends on g / L), so
the candidates are gravity, the length of the legs with their masses as they are, and masses and inertias of one
body. For each candidate the factor k is solved for with which the step lasts as long as the samples do. Then
the candidates are compared by what k leaves: the largest distance of the samples q(t) from the orbit of that
robot [rad]. A *cause* is one such change of the robot, with its k. A convention (`layout` in arguments) says
which angles the coordinates are, with order, zeros and signs.
"""

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import partial

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import newton

from biped_adrc.core.errors import BipedError
from biped_adrc.gait.conventions import Convention
from biped_adrc.gait.exchange.samples import Samples, fit, poses
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.model.robots.urdf import vector

EXPLAINS = 5e-3
"""Largest distance of samples from the orbit of the robot that explains them [rad]."""
_WIDE = math.log(10.0)
"""Largest logarithm of a factor that is tried."""
CLEARLY = 3.0
"""A cause is named beside the best one if its distance is at most so many times as large."""


def explained(samples: Samples, biped: Biped, layout: Convention, degree: int, slope: float) -> str:
    """The end of an error message, from "; " on, that names the causes: each of these changes of the robot
    alone would explain samples that its dynamics do not give; or that says that there is none.

    samples: in the convention `layout`. degree: of the curves that are fitted. slope [rad]: of the ground,
    positive downhill. Raises InputError and GaitError where already the poses do not fit the robot.
    """
    # in the robot's coordinates; [1] are remarks
    s = poses(samples, biped, layout, degree, slope)[0]

    def orbit(make: Callable[[float], Biped], k: float) -> ZeroDynamics:
        """The zero dynamics of the robot make(k), the one that factor k changes, on the curves (of this degree)
        that are fitted to the samples s for it.
        """
        return ZeroDynamics.of(make(k), fit(s, make(k), degree))

    def late(log_k: float, make: Callable[[float], Biped]) -> float:
        """log(period of the robot make(k) / duration of the samples s), k = exp(log_k); 0 at the factor k that
        is searched.
        """
        k = math.exp(min(max(log_k, -_WIDE), _WIDE))  # factors from 1/10 to 10
        return math.log(orbit(make, k).cycle.period / float(s.t[-1] - s.t[0]))

    # makes: name of a change -> the robot by its factor k; found: name -> distance [rad] and k
    d, found = biped.description, dict[str, tuple[float, float]]()
    makes: dict[str, Callable[[float], Biped]] = {
        "gravity (or one over all lengths)": lambda k: replace(
            biped, description=replace(d, gravity=k * d.gravity)
        ),
        "the length of the legs": lambda k: with_legs(biped, k),
    } | {f"masses and inertias of {x}": partial(_heavier, biped, x) for x in d.links}
    for name, make in makes.items():
        with suppress(BipedError, RuntimeError):  # no factor gives the duration
            # secant method on log k, from factors of 1 and exp(0.05); over log k the logarithm of the period is
            # a straight line with gravity, which makes it fast
            k = math.exp(newton(late, 0.0, x1=0.05, tol=1e-6, args=(make,)))
            found[name] = _distance(s, orbit(make, k)), k
    best = min((gap for gap, _ in found.values()), default=math.inf)
    if best > EXPLAINS:
        return "; no other gravity, length of the legs or mass of one body alone explains them"
    # CLEARLY: also those that fit not much worse than the best one
    causes = [f"{x} times {k:.4g}" for x, (gap, k) in found.items() if gap <= CLEARLY * best]
    return f"; they would fit with {' or '.join(causes)}"


def with_legs(biped: Biped, k: float) -> Biped:
    """The robot with legs k times as long, and the COMs of their links k times as far out along them; masses
    and inertias stay.
    """
    tree, d = biped.tree, biped.description
    legs = {j.child for foot in d.feet for j in tree.path_below(foot, d.trunk) or ()}
    com = {link: k for link in legs if tree.links[link].inertial is not None}
    # com: factor of the place of the COM by link; a link without masses has none
    # the origin of a joint lies in the frame of its parent link, so the hips, on the trunk, stay
    joints = tuple(
        replace(j, origin=vector(k * np.array(j.origin))) if j.parent in legs else j
        for j in tree.joints
    )
    return replace(biped, tree=replace(biped.scaled({"com": com}), joints=joints))


def _heavier(biped: Biped, body: str, k: float) -> Biped:
    """The robot with k times the masses and inertias of a body."""
    return replace(biped, tree=biped.scaled({"mass": {body: k}, "inertia": {body: k}}))


def _distance(s: Samples, zero: ZeroDynamics) -> float:
    """Largest distance of the samples from the periodic orbit of `zero` at equal times [rad], over all joints.

    Both begin at the time of the first sample. Nodes of the orbit outside of the samples' time are left out.
    """
    # time of each node: the integral of 1 / Theta' over Theta
    times = s.t[0] + zero.cumulative @ (1.0 / (zero.cycle.v @ zero.constraint.phase))
    inside = (times > s.t[0]) & (times < s.t[-1])
    return float(np.max(np.abs(CubicSpline(s.t, s.q)(times) - zero.cycle.q)[inside]))
