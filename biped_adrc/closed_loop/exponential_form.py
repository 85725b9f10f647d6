"""Coordinates x -> (w, E) of a walker in which what is stiff is linear, for the exponential method.

    E' = A E + N_E,   w' = N_w          E (k, p): one column per actuated joint

An observer with poles far to the left makes x' = f(x) stiff: an explicit method would need steps
far below 1 ms. In these coordinates the stiff part is the constant matrix A, which
`hybrid.integrators` integrates exactly; the remainder N is slow. There are two forms. With the
observer in A, e = S (q_b, q_b') - Z is its error, S the scaling by which it has velocities
multiplied (`scale`):

    w = (q, q', rest),   E = e,   N_E = scale xi_total in row 1,   xi_total = q_b'' - kappa u

With the feedback in A too, around a virtual constraint, for n = p + 1 and phase Theta = c q:

    w = (Theta, r(Theta) q', rest),   E = (eps, scale eps', e),   eps = q_b - h(Theta)
    q_b = h + eps,   q_N = (Theta - c_b q_b) / c_N,   q_b' = h' Theta' + eps',   likewise q_N'
    eps'' = -K_d (eps' - e2) - K_p (eps - e1) + e3 + N

N_E has scale N in row 1 and scale xi_total in row 3. N is the true eps'' without the linear part,
so that torque limits, a wrong model and forces from outside are in it; without them it is xi_total
and what the law misses of q_d''. `rest` is what follows the observer in the controller's state.

r(Theta) (n,) is any row for which r dq/dTheta on the constraint is not zero. With r = c the
coordinate is Theta', but its derivative has the fast parts of q_b'' in it: RK4 sums them wrongly,
and at 1 ms the time of impact is off by 1e-5 to 1e-4 s. D_N q', with the row D_N of the plant's D_s
that belongs to q_N, is the angular momentum about the stance foot, in whose derivative no motor
acts. So r is D_N on the constraint, a polynomial fitted once: fast parts of the size of eps are
left, and what the fit misses costs accuracy alone.

`Walker.split` hands their methods to the Python method, `engine.equations` traces them for the compiled one.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from biped_adrc.closed_loop.protocols import Loop, Mode
from biped_adrc.closed_loop.semantics import Instant, instant
from biped_adrc.control.base import Controller
from biped_adrc.errors import InputError
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.curves import Curve, Polynomial
from biped_adrc.hybrid.system import Split
from biped_adrc.observers.base import ErrorSystem
from biped_adrc.types import Array

DEGREE = 8
"""Degree of the polynomial r [1]."""
MARGIN = 0.05
"""Share of the phase range by which the fit of r goes past both ends."""


@dataclass(frozen=True)
class ErrorForm:
    """The form with the observer alone in A."""

    n: int
    """Coordinates."""
    p: int
    """Actuated joints."""
    order: int
    """Observer states per joint."""
    scale: float
    """Factor of velocities in the observer's scaled states [s]."""
    A: Array
    """Linear part (k, k) [1/s], the same for every joint."""
    rows: ClassVar[tuple[int, ...]] = (1,)
    """Rows of E that N_E enters; it is zero in all others."""

    def to(self, x: Array) -> tuple[Array, Array]:
        """w (2 n + rest,) and E (order, p) of x: the observer's state is replaced by its error."""
        n, p, end = self.n, self.p, 2 * self.n + self.order * self.p
        z = x[2 * n : end]
        e = np.concatenate((x[:p] - z[:p], self.scale * x[n : n + p] - z[p : 2 * p], -z[2 * p :]))
        return np.concatenate((x[: 2 * n], x[end:])), e.reshape(self.order, p)

    def back(self, w: Array, E: Array) -> Array:
        """x (nx,), linear in w (2 n + rest,) and E (order, p)."""
        n, p = self.n, self.p
        z = (w[:p] - E[0], self.scale * w[n : n + p] - E[1], -E[2:].ravel())
        return np.concatenate((w[: 2 * n], *z, w[2 * n :]))

    def remainder(
        self, w: Array, E: Array, a: Array, kappa_u: Array, ds: Array
    ) -> tuple[Array, Array]:
        """N_w (2 n + rest,), and the forced rows of N_E: scale xi_total (1, p).

        a = q'' (n,) [rad/s^2], kappa_u (p,) [rad/s^2], ds the derivative of the rest.
        """
        forced = self.scale * (a[: self.p] - kappa_u)
        return np.concatenate((w[self.n : 2 * self.n], a, ds)), forced.reshape(1, -1)

    def spread(self, forced: Array) -> Array:
        """N_E (k, p) from its forced rows (r, p), zero elsewhere."""
        N = np.zeros((len(self.A), forced.shape[1]))
        for row, values in zip(self.rows, forced, strict=True):
            N[row] = values
        return N


@dataclass(frozen=True)
class FeedbackForm(ErrorForm):
    """The form with the feedback in A too; n = p + 1."""

    h: VirtualConstraint
    """The virtual constraint q_b = h(Theta)."""
    r: Curve
    """The row r over the phase of h, as a curve of n components [kg m^2]."""
    rows: ClassVar[tuple[int, ...]] = (1, 3)

    def momentum_row(self, theta: float) -> tuple[Array, Array]:
        """r and dr/dTheta at theta [rad], each (n,)."""
        r, dr, _ = self.r(self.h.rate * (theta - self.h.theta_plus))
        return r, self.h.rate * dr

    def to(self, x: Array) -> tuple[Array, Array]:
        """w (2 + rest,) and E (order + 2, p) of x."""
        n, p, end = self.n, self.p, 2 * self.n + self.order * self.p
        q, v, z = x[:n], x[n : 2 * n], x[2 * n : end]
        c = self.h.phase.reshape(1, -1)
        theta, dtheta = c @ q, c @ v
        h, dh, _ = self.h.h(theta[0])
        r, _ = self.momentum_row(theta[0])
        eps = (q[:p] - h, self.scale * (v[:p] - dh * dtheta))
        e = (q[:p] - z[:p], self.scale * v[:p] - z[p : 2 * p], -z[2 * p :])
        E = np.concatenate((*eps, *e)).reshape(self.order + 2, p)
        return np.concatenate((theta, r.reshape(1, -1) @ v, x[end:])), E

    def back(self, w: Array, E: Array) -> Array:
        """x (nx,) of w (2 + rest,) and E (order + 2, p); not linear, since h is not."""
        h, _, _ = self.h.h(w[0])
        q, v = self._with_unactuated(w[0], h + E[0]), self.velocity(w, E)
        z = (q[: self.p] - E[2], self.scale * v[: self.p] - E[3], -E[4:].ravel())
        return np.concatenate((q, v, *z, w[2:]))

    def velocity(self, w: Array, E: Array) -> Array:
        """q' (n,) [rad/s] of (w, E): Theta' is the one for which r q' = w[1], then q_b' = h' Theta' + eps'."""
        _, dh, _ = self.h.h(w[0])
        r, _ = self.momentum_row(w[0])
        along = self._with_unactuated(1.0, dh)
        aside = self._with_unactuated(0.0, E[1] / self.scale)
        return along * ((w[1] - r @ aside) / (r @ along)) + aside

    def _with_unactuated(self, theta: float, q_b: Array) -> Array:
        """(q_b, q_N) (n,) whose phase c q is theta; serves angles, rates and displacements alike."""
        c = self.h.phase
        return np.concatenate((q_b, (theta - c[: self.p] @ q_b) / c[self.p :]))

    def remainder(
        self, w: Array, E: Array, a: Array, kappa_u: Array, ds: Array
    ) -> tuple[Array, Array]:
        """N_w (2 + rest,), and the forced rows of N_E: scale N and scale xi_total (2, p)."""
        v, c, a_b = self.velocity(w, E), self.h.phase.reshape(1, -1), a[: self.p]
        _, dh, ddh = self.h.h(w[0])
        r, dr = self.momentum_row(w[0])
        dtheta = c @ v
        eps = self.scale * (a_b - ddh * (dtheta * dtheta) - dh * (c @ a)) - self.A[1] @ E
        forced = np.concatenate((eps, self.scale * (a_b - kappa_u))).reshape(2, -1)
        dy = r.reshape(1, -1) @ a + (dr @ v) * dtheta
        return np.concatenate((dtheta, dy, ds)), forced


def loop_matrix(error: ErrorSystem, K_p: float, K_d: float) -> Array:
    """A (order + 2, order + 2) [1/s] of (eps, scale eps', e) for gains K_p [1/s^2], K_d [1/s].

    xi^ is what the observer adds to x2^' beside injection and input, so e3 enters with the
    coefficients that it has in e2'.
    """
    order, scale = error.A.shape[0], error.velocity_scale
    A = np.zeros((order + 2, order + 2))
    A[2:, 2:] = error.A
    A[0, 1] = 1.0 / scale
    A[1, :4] = -scale * K_p, -K_d, scale * K_p, K_d
    A[1, 4:] = error.A[1, 2:]
    return A


# -- of a controller -----------------------------------------------------------------------------
def error_form(law: Controller, n: int, p: int) -> ErrorForm | None:
    """The form with the observer in the linear part; None for a controller without a linear observer."""
    error = law.error_system()
    if error is None:
        return None
    return ErrorForm(n, p, error.A.shape[0], float(error.velocity_scale), error.A)


def feedback_form(
    law: Controller, n: int, p: int, inertia: Callable[[Array], Array]
) -> FeedbackForm:
    """The form with the feedback in the linear part too.

    inertia: D_s(q) (n, n) [kg m^2] of the plant, to take r from; other rows would do, with less
    accuracy. Of gains that differ from joint to joint A has the mean; the remainder takes up the
    rest. Raises InputError, with the reason, for a controller without such coordinates.
    """
    name, error = type(law).__name__, law.error_system()
    if error is None:
        raise InputError(
            f"feedback=True puts the error of a linear observer into the linear part, and {name} has none; "
            "use RK4, Adaptive or Stiff, or ADRCController with a GPIObserver"
        )
    if error.feedback is None:
        raise _refused(f"{name} does not say what its feedback is (`ErrorSystem.feedback`)")
    h = error.feedback.reference
    if not isinstance(h, VirtualConstraint):
        raise _refused(
            f"{name} tracks a {type(h).__name__}, expected a VirtualConstraint such as gait.constraint, "
            "not corrected"
        )
    if n != p + 1:
        raise _refused(f"the robot has {n} coordinates and {p} motors, expected one motor less")
    if h.phase[p] == 0.0:
        raise _refused(f"the phase row {h.phase} has no part of the unactuated coordinate")
    A = loop_matrix(error, float(np.mean(error.feedback.K_p)), float(np.mean(error.feedback.K_d)))
    order, scale = error.A.shape[0], float(error.velocity_scale)
    return FeedbackForm(n, p, order, scale, A, h, _momentum_row(h, inertia))


def _momentum_row(h: VirtualConstraint, inertia: Callable[[Array], Array]) -> Curve:
    """D_N on the constraint over its phase s, fitted at Chebyshev's nodes of [-MARGIN, 1 + MARGIN].

    The margin keeps the polynomial good where a disturbed step runs past the nominal phase.
    """
    nodes = np.cos(np.pi * (np.arange(DEGREE + 1) + 0.5) / (DEGREE + 1))
    s = 0.5 + (0.5 + MARGIN) * nodes
    rows = []
    for theta in h.theta_plus + s * (h.theta_minus - h.theta_plus):
        q_b, c = h.h(float(theta))[0], h.phase
        q = np.append(q_b, (theta - c[:-1] @ q_b) / c[-1])
        rows.append(inertia(q)[-1])
    powers = s[:, np.newaxis] ** np.arange(DEGREE + 1)
    return Polynomial(np.linalg.solve(powers, np.array(rows)).T)


def _refused(reason: str) -> InputError:
    """The error for a controller without these coordinates; reason: what is missing."""
    return InputError(
        f"feedback=True needs coordinates (Theta, q_b - h(Theta)), and there are none: {reason}; use "
        "Exponential(h), which has the observer alone in its linear part"
    )


# -- of a closed loop ----------------------------------------------------------------------------
def remainder(
    loop: Loop, form: ErrorForm, t: float, w: Array, E: Array, mode: Mode
) -> tuple[Array, Array]:
    """N_w, and N_E in its forced rows (r, p), of the closed loop at (t, w, E), t in [s]."""
    i = instant(loop, t, form.back(w, E), mode)
    rest, u = len(i.s) > form.order * form.p, loop.bounded(i.u)
    ds = loop.calls.flow(i.s, i.measurement, u) if rest else i.s
    return forcing(form, w, E, i, ds)


def forcing(form: ErrorForm, w: Array, E: Array, i: Instant, ds: Array) -> tuple[Array, Array]:
    """As `remainder`, for what acts at the instant i and s' = ds: N_w, and N_E in its forced rows (r, p)."""
    kappa_u = i.measurement.terms.kappa @ i.u
    return form.remainder(w, E, i.a, kappa_u, ds[form.order * form.p :])


def split_of(loop: Loop, form: ErrorForm, mode: Mode) -> Split:
    """The closed loop in these coordinates, as the Python integrator takes it.

    `node` gives remainder, x and x' from a single evaluation of the dynamics.
    """

    def on_all_rows(t: float, w: Array, E: Array) -> tuple[Array, Array]:
        N_w, forced = remainder(loop, form, t, w, E, mode)
        return N_w, form.spread(forced)

    def node(t: float, w: Array, E: Array) -> tuple[tuple[Array, Array], Array, Array]:
        x = form.back(w, E)
        i = instant(loop, t, x, mode)
        ds = loop.calls.flow(i.s, i.measurement, loop.bounded(i.u))
        N_w, forced = forcing(form, w, E, i, ds)
        return (N_w, form.spread(forced)), x, np.concatenate((i.measurement.v, i.a, ds))

    return Split(form.to, form.back, form.A, on_all_rows, node)
