"""The estimation error that an impact leaves in an observer, by its linear error dynamics.

    e' = A^ e   (19) of the paper,   e(0+) = true states after impact - estimates after the reset

The true states are q_b [rad], the angles of the p joints with motors, q_b', the total disturbance xi (p,)
[rad/s^2] of q_b'' = kappa u + xi (13), with u (p,) [N m] the torques, and derivatives of xi in time. e_1, e_2,
e_3 (p,) are the errors of the first three, A^ is the observer's matrix, and 0+ the instant just after the
impact.

At an impact velocities and xi jump; each `ResetPolicy` sets the estimates in another way. The gait walks its
periodic orbit, and just before impact the estimates have no error. The torque that the error costs is

    u - u* = kappa^-1 (K_p e_1 + K_d e_2 + e_3)

its deviation from the torque u* of exact estimates; K_p and K_d are the feedback's gains. kappa is constant,
its value just after impact. The model is linear and includes neither the torque limit nor a fall.
`ObserverReport` shows one row per reset policy.
"""

from typing import NamedTuple

import numpy as np
from numpy.polynomial import Chebyshev
from scipy.linalg import expm

from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.core.types import Array, Indices
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.observers.base import ResetPolicy
from biped_adrc.observers.gpi import GPIObserver

DEGREE = 20
"""Degree of the polynomial in time that approximates xi along the orbit."""
DERIVATIVES = 3
"""Number of derivatives of xi taken from it; higher ones, too rough, are zero before and after impact."""
INSTANTS, LONG = 400, 8.0
"""Number of instants after t = 0 at which the response is computed, and the last of them in time constants of
the slowest pole."""


class ImpactPeak(NamedTuple):
    """Largest absolute values over joints and time after one impact."""

    position: float
    """e_1 [rad]."""
    velocity: float
    """e_2 [rad/s]."""
    disturbance: float
    """e_3 [rad/s^2]."""
    torque: float
    """u - u* [N m]."""


class ImpactStates(NamedTuple):
    """True states of the observer's chain at an impact in physical units: q_b [rad], q_b' [rad/s], xi
    [rad/s^2], xi', ...; one row per state, one column per joint; order = m + 2 rows.
    """

    before: Array
    """True states of the chain just before impact (order, p)."""
    after: Array
    """True states just after impact, in the coordinates of the next step (order, p)."""
    swap: Indices
    """Relabelling (p,): joint i after impact has entry swap[i] of (x, -x), x (p,) of the joints before it."""
    inertia: Array
    """kappa^-1 (p, p) just after impact [kg m^2]."""


def orbit_impact(biped: Biped, gait: Gait, order: int) -> ImpactStates:
    """True states of the observer's chain just before and after the impact of the gait's periodic orbit.

    order: states per joint of the observer, m + 2: q_b, q_b', and m for xi and its derivatives. Raises
    GaitError where the gait has no periodic orbit.
    """
    zero = ZeroDynamics.of(biped, gait.constraint)
    orbit = zero.cycle
    xi = np.array([biped.reduction(q, v).xi for q, v in zip(orbit.q, orbit.v, strict=True)])
    # dt = dTheta / Theta'; `cumulative` integrates over Theta from the start of the step to each node
    t = zero.cumulative @ (1.0 / (orbit.v @ gait.constraint.phase))  # of the nodes [s]
    # polynomials in time, one per joint; of their derivatives only DERIVATIVES are smooth enough to be used
    # DEGREE, of the polynomials in time
    fits = [Chebyshev.fit(t, column, DEGREE, domain=[0.0, orbit.period]) for column in xi.T]

    def chain(time: float, q: Array, v: Array) -> Array:
        """States (order, p) at a time [s] of the orbit: q_b, q_b', xi, its derivatives by the fits, then
        zeros."""
        rows = [q[: biped.p], v[: biped.p], biped.reduction(q, v).xi]
        rows += [np.array([fit.deriv(j)(time) for fit in fits]) for j in range(1, DERIVATIVES + 1)]
        return np.array([*rows, *[np.zeros(biped.p)] * order][:order])

    start = gait.start(biped)
    before, after = chain(orbit.period, gait.q_minus, gait.v_minus), chain(0.0, *start)
    return ImpactStates(before, after, biped.swap, biped.reduction(*start).kappa_inverse)


def impact_peak(
    observer: GPIObserver, impact: ImpactStates, policy: ResetPolicy, gains: Gains = TABLE_II
) -> ImpactPeak:
    """Peaks of the estimation errors and of the torque deviation after an impact, from the response to e(0+).

    Over LONG time constants of the slowest pole, in scaled states, by a matrix exponential at each instant.
    gains: K_p [1/s^2] and K_d [1/s] of the torque. For m = 0 the observer has no estimate of xi, and e_3 counts
    as 0.
    """
    w, k, (y, dy, *xi) = observer.scale, observer.order, impact.after
    # state i, counted from 0, is scaled by w^i
    units = w ** np.arange(k)[:, np.newaxis]
    before, after = impact.before / units, impact.after / units
    # the model's xi for the reset policy MODEL; for m = 0 the chain has none
    xi_0 = xi[0] if xi else np.zeros_like(y)
    # E (k, p): e(0+) in scaled states, true states minus estimates, which are the true states before the impact
    E = after - observer.reset(before, policy, impact.swap, y, dy, xi_0)
    A = observer.error_system().A
    rates = np.abs(np.real(observer.poles))
    # INSTANTS times from 1 % of the fastest time constant to LONG time constants of the slowest pole
    later = np.geomspace(0.01 / rates.max(), LONG / rates.min(), INSTANTS)
    values = np.array([expm(A * t) @ E for t in (0.0, *later)])
    e_1, e_2 = values[:, 0], values[:, 1] * w
    e_3 = values[:, 2] * w**2 if k > 2 else np.zeros_like(e_1)
    # a: acceleration that the errors cost; impact.inertia is kappa^-1, which makes it a torque. The order is
    # that of ImpactPeak
    a = gains.K_p * e_1 + gains.K_d * e_2 + e_3
    peaks = (float(np.max(np.abs(x))) for x in (e_1, e_2, e_3, a @ impact.inertia.T))
    return ImpactPeak(*peaks)
