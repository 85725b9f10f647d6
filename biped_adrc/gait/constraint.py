"""The virtual holonomic constraint of the paper's section IV: q_d = h(Theta(q)).

    Theta = c q,   s = (Theta - Theta+) / (Theta- - Theta+)
    q_d   = h(Theta)
    q_d'  = h' Theta'
    q_d'' = h'' Theta'^2 + h' c q''

q (n,) are the coordinates, of which the p = n - 1 actuated ones follow q_d; c is the row of the phase Theta.
Theta+ is the phase just after impact, Theta- just before the next one; ' on h is d/dTheta.

Outside [Theta+, Theta-] the curve goes on as the polynomial it is, and soon grows steeply. A *continued*
constraint goes on smoothly instead: at a signed distance y past an end with h_0, h_0', h_0'' there,

    h = h_0 + h_0' y + h_0'' (l |y| - l^2 (1 - exp(-|y| / l)))

Two derivatives agree at the ends, and the curvature fades out over l = fade |Theta- - Theta+|.

A *corrected* constraint has a correction added to it:

    q_d   = h(Theta) + c(Theta)
    q_d'  = (h' + c') Theta'
    q_d'' = (h'' + c'') Theta'^2 + (h' + c') c_q q''

Theta = c_q q as in h; ' on h and c is d/dTheta. Corrections of corrections add up.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import GaitError
from biped_adrc.core.part import derived
from biped_adrc.core.types import Array, read_only
from biped_adrc.gait.curves import Curve
from biped_adrc.gait.reference import Reference, ReferencePoint

FADE = 0.01
"""Share of the phase range over which the curvature of a continued constraint fades out past an end."""


@dataclass(frozen=True)
class VirtualConstraint(Reference):
    """h over the phase Theta = c q from theta_plus to theta_minus [rad].

    Raises GaitError for a phase row that is not finite, a range without extent, or a fade that is not positive.

    >>> q_d, slope, curvature = gait.constraint.h(gait.constraint.theta_plus)
    >>> q_d.shape
    (4,)
    """

    SUCH_AS = "gait.constraint"  # an example of such an object, for error messages

    curve: Curve
    """h over s in [0, 1], p rows."""
    phase: Array
    """Row c (n,) of Theta = c q, dimensionless."""
    theta_plus: float
    """Theta just after impact, s = 0 [rad]."""
    theta_minus: float
    """Theta just before the next impact, s = 1 [rad]."""
    fade: float | None = None
    """Share of the range [1] over which the curvature fades out past the ends; None: the curve just goes on."""

    def __repr__(self) -> str:
        ends = f"Theta from {self.theta_plus:.4g} to {self.theta_minus:.4g} rad"
        beyond = "" if self.fade is None else ", continued"
        return f"VirtualConstraint({self.curve!r}, {ends}{beyond})"

    def __post_init__(self) -> None:
        """Check the fields, and keep the phase as a read-only array."""
        c = read_only(self.phase)
        span = self.theta_minus - self.theta_plus
        # for None a number that passes the check
        fade = FADE if self.fade is None else self.fade
        if not (np.all(np.isfinite([*c, span])) and span != 0.0 and 0.0 < fade < np.inf):
            raise GaitError(
                f"phase row {c} from {self.theta_plus} to {self.theta_minus} rad, fade {self.fade}; expected "
                "finite numbers, two different ends, and a positive fade or None"
            )
        object.__setattr__(self, "phase", c)

    @derived
    def rate(self) -> float:
        """ds/dTheta = 1 / (Theta- - Theta+) [1/rad]."""
        return float(1.0 / (self.theta_minus - self.theta_plus))

    def h(self, theta: float) -> tuple[Array, Array, Array]:
        """h [rad], dh/dTheta and d2h/dTheta2 at theta [rad], each (p,). theta may lie outside of the range:
        there the polynomial goes on if `fade` is None, else the module's continuation by `fade`.
        """
        s = self.rate * (theta - self.theta_plus)
        # np.minimum and np.maximum, since symbols run through this method too
        inside = s if self.fade is None else np.minimum(np.maximum(s, 0.0), 1.0)
        h, dh, ddh = self.curve(inside)
        if self.fade is not None:
            h, dh, ddh = past_end(s - inside, self.fade, h, dh, ddh)
        return h, self.rate * dh, self.rate * self.rate * ddh

    def __call__(self, t: float, q: Array, v: Array) -> ReferencePoint:
        """The reference at q (n,) [rad], v (n,) [rad/s], by the chain rule; the time is not used.

        H = h' c (p, n) multiplies q''; drift = h'' Theta'^2 (p,) is the rest of q_d''.
        """
        theta, dtheta = float(self.phase.dot(q)), float(self.phase.dot(v))
        h, dh, ddh = self.h(theta)
        return ReferencePoint(h, dh * dtheta, dtheta**2 * ddh, dh[:, np.newaxis] * self.phase)


def past_end(y: float, fade: float, h: Array, dh: Array, ddh: Array) -> tuple[Array, Array, Array]:
    """The module's continuation of h past an end: h, dh/ds, d2h/ds2, each (p,) [rad].

    y [1]: signed distance past that end, in the normalised phase s: below 0 before s = 0, above 0 after s = 1,
    0 inside, where all stays as it is. fade [1]: l, in s. h, dh, ddh (p,) [rad]: h, dh/ds, d2h/ds2 at that end.
    """
    left = np.exp(-abs(y) / fade)  # share of the curvature that is left at y
    h = h + y * dh + (fade * abs(y) - fade * fade * (1.0 - left)) * ddh
    return h, dh + np.sign(y) * fade * (1.0 - left) * ddh, left * ddh


def continued(h: VirtualConstraint) -> VirtualConstraint:
    """The same constraint, continued smoothly past Theta+ and Theta-.

    A step that ends late, after a push or on a step down, runs past Theta-, where the polynomial itself would
    soon command angles out of reach. Raises InputError for an argument that is no constraint.
    """
    check_part(h, "what is to go on", VirtualConstraint)
    return replace(h, fade=FADE)  # 1 % of the range of Theta


Correction = Callable[[float], tuple[Array, Array, Array]]
"""A function of Theta [rad] that returns c, dc/dTheta, d2c/dTheta2, each (p,)."""


@dataclass(frozen=True)
class CorrectedConstraint(Reference):
    """The reference h(Theta) + c(Theta): a constraint (`base`, which may be a corrected one) with a correction
    over the same phase.
    """

    base: VirtualConstraint | CorrectedConstraint
    correction: Correction

    @property
    def constraint(self) -> VirtualConstraint:
        """The constraint h alone, without any correction."""
        return self.base if isinstance(self.base, VirtualConstraint) else self.base.constraint

    def __call__(self, t: float, q: Array, v: Array) -> ReferencePoint:
        """The reference at q (n,) [rad], v (n,) [rad/s]: that of `base` plus the correction's terms, by the
        chain rule.
        """
        # r: q_d, q_d', drift and H of `base`; phase: the row c_q
        r, phase = self.base(t, q, v), self.constraint.phase
        rate = float(phase @ v)
        c, dc, ddc = self.correction(float(phase @ q))
        drift, H = r.drift + ddc * rate**2, r.H + dc[:, np.newaxis] * phase
        return ReferencePoint(r.q_d + c, r.dq_d + dc * rate, drift, H)
