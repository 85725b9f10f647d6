"""Gains of the PI controller that corrects the walking speed once in each step, from the zero dynamics.

In walking step k the joints follow the curves h + beta_k b(s) times a direction (p,) in place of h.

    beta_k         correction that the PI chooses for the step [rad]; K_P, K_I are its gains on the error of v
    b(s)           bump over the step, s from 0 to 1
    sigma          angular momentum about the stance foot [kg m^2/s], sigma- before and sigma+ after an impact
    delta          sigma+ / sigma- at impact
    z_k            sigma-^2 before the impact that begins step k [kg^2 m^4/s^2]
    v_k            speed L / T_k [m/s], from the step length L and the time T_k of the step
    W              work of gravity on sigma^2 / 2 along a step

With exact tracking z_k, v_k and beta_k, as deviations from the periodic gait, obey

    z_(k+1) = a z_k + b beta_k,   v_k = c z_k + d beta_k,
    a = delta^2,  b = 2 dW/dbeta,  c = dv/dz,  d = dv/dbeta

W, delta and T are the quadratures of the zero dynamics, differenced in beta and z. With the PI of
`control.stride` the poles of the loop are the roots of

    lambda (lambda - 1) (lambda - a) + (K_P (lambda - 1) + K_I lambda) (d (lambda - a) + c b) = 0.

At lambda = -mu, mu = (c b - d a) / d, the gains drop out, so a triple pole r, the quickest there
is, has

    (r + mu)^3 = mu (mu + 1) (mu + a),   K_P = r^3 / (d mu),   K_P + K_I = (1 + a - 3 r) / d.

`stride_pi` makes the controller of `control.stride` with these gains; nothing is tuned by hand.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from biped_adrc.control.base import Controller
from biped_adrc.control.stride import TORSO_LEAN, StrideGains, StridePI
from biped_adrc.core.errors import GaitError, InputError
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, ComplexArray
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.curves import Polynomial
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped

BUMP = 64.0 * np.array([0.0, 0.0, 0.0, 1.0, -3.0, 3.0, -1.0])
"""Coefficients (7,) of b(s) = 64 s^3 (1 - s)^3 in powers of s: zero with two derivatives at both ends."""
_DIFFERENCE = 1e-3
"""Half width of the central differences: in beta [rad], and relative in z."""


@dataclass(frozen=True)
class StrideResponse(Shown):
    """Linear map from step to step of the speed of one gait, with the correction beta along one direction."""

    a: float
    """delta^2, multiplier of the walking cycle, dimensionless."""
    b: float
    """dz/dbeta of the next z [kg^2 m^4/s^2 per rad]."""
    c: float
    """dv/dz [m/s per kg^2 m^4/s^2]."""
    d: float
    """dv/dbeta [m/s per rad]."""

    @property
    def static_gain(self) -> float:
        """Change of speed per beta that stays constant, dv/dbeta [m/s per rad], once the walk has settled."""
        return self.d + self.c * self.b / (1.0 - self.a)

    def poles(self, gains: StrideGains) -> ComplexArray:
        """The three poles of the loop with these gains (3,), dimensionless, the largest magnitude first."""
        # the module's factors, highest power of lambda first: lambda - a, d (lambda - a) + c b, and in `law`
        # K_P (lambda - 1) + K_I lambda
        walk, plant = [1.0, -self.a], [self.d, self.c * self.b - self.d * self.a]
        law = [gains.K_P + gains.K_I, -gains.K_P]
        equation = np.polyadd(np.polymul([1.0, -1.0, 0.0], walk), np.polymul(law, plant))
        roots = np.roots(equation).astype(complex)
        return roots[np.argsort(-np.abs(roots))]

    def gains(self, limit: float = 0.3) -> StrideGains:
        """K_P and K_I that give the triple pole; limit: bound on |beta| [rad].

        Raises InputError where the pole is not inside the unit circle.
        """
        zero = self.c * self.b - self.d * self.a  # d mu of the module
        mu = zero / self.d if self.d else math.inf
        r = float(np.cbrt(mu * (mu + 1.0) * (mu + self.a))) - mu
        if not abs(r) < 1.0 or zero == 0.0:
            raise InputError(
                f"the stride's loop would have a triple pole at {r:.3g}, expected one inside the unit circle; "
                "choose another direction of the correction"
            )
        # beside K_P the module has K_P + K_I, of which K_P is subtracted
        K_P = r**3 / zero
        return StrideGains(K_P, (1.0 + self.a - 3.0 * r) / self.d - K_P, limit)


def stride_pi(
    inner: Controller,
    gait: Gait,
    biped: Biped,
    direction: Sequence[float] = TORSO_LEAN,
    limit: float = 0.3,
) -> StridePI:
    """Wrap a controller in the PI from step to step, with the gains of the triple pole.

    inner: the controller. direction (p,): by which each joint bends per beta, dimensionless. limit: bound on
    |beta| [rad]. Raises InputError for a direction of the wrong length or a pole that is not inside the unit
    circle, GaitError where the zero dynamics have no stable cycle.
    """
    along = tuple(float(d) for d in direction)
    gains = stride_response(gait, biped, along).gains(limit)
    return StridePI.on_gait(inner, gait, biped, gains, direction=along)


def bumped(h: VirtualConstraint, shift: Array) -> VirtualConstraint:
    """The constraint h + shift b(s) as a polynomial; shift (p,) [rad]: beta times the direction."""
    # curves in powers of s, (p, number of powers), filled up with zeros to the longer of the two
    a = h.curve.power_coefficients
    # BUMP (7,): coefficients of b(s) in powers of s
    wide = np.zeros((a.shape[0], max(a.shape[1], len(BUMP))))
    wide[:, : a.shape[1]] = a
    wide[:, : len(BUMP)] += np.outer(shift, BUMP)
    return VirtualConstraint(Polynomial(wide), h.phase, h.theta_plus, h.theta_minus)


def stride_response(
    gait: Gait, biped: Biped, direction: tuple[float, ...] = TORSO_LEAN
) -> StrideResponse:
    """Linearise the map from step to step of a gait whose constraint is hybrid invariant, or
    made so by ReferenceReset.

    gait: the one whose speed is corrected. biped: its robot. direction (p,) [1]: by which each joint bends per
    beta. Raises InputError for a direction of the wrong length, GaitError where the zero dynamics have no
    stable cycle.

    >>> response = ba.stride_response(gait, biped)
    >>> print(f"{response.static_gain:.2f} (m/s)/rad")
    -0.70 (m/s)/rad
    """
    # shift (p,): beta = _DIFFERENCE [rad] times the direction
    h, shift = gait.constraint, _DIFFERENCE * np.array(direction, dtype=float)
    if len(shift) != biped.p:
        raise InputError(f"the direction is {direction}, expected {biped.p} numbers, one per motor")
    L = gait.step_length(biped)
    zero, more, less = (ZeroDynamics.of(biped, bumped(h, k * shift)) for k in (0.0, 1.0, -1.0))
    delta, sigma = zero.delta, zero.sigma_minus

    def speed(zd: ZeroDynamics, scale: float = 1.0) -> float:
        # L / T of a step along zd that follows an impact with z = scale sigma-^2, sigma- that of the cycle; it
        # begins with sigma+ = delta sigma-
        return L / zd.orbit(delta * sigma * math.sqrt(scale)).period

    if not delta**2 < 1.0:
        raise GaitError(f"delta^2 is {delta**2:.4g}: the walk does not settle, expected below 1")
    # z differs by the share w of sigma-^2, beta by w
    w = 2.0 * _DIFFERENCE
    return StrideResponse(
        a=delta**2,
        b=2.0 * (more.work - less.work) / w,
        c=(speed(zero, 1.0 + _DIFFERENCE) - speed(zero, 1.0 - _DIFFERENCE)) / (w * sigma**2),
        d=(speed(more) - speed(less)) / w,
    )
