"""Coordinates x -> (w, E) of a walker in which what is stiff is linear, for the exponential method.

    E' = A E + N_E,   w' = N_w          E (k, p): one column per actuated joint

An observer with poles far to the left makes x' = f(x) stiff: an explicit method would need steps
far below 1 ms. In these coordinates the stiff part is the constant matrix A, which
`hybrid.exponential` integrates exactly; the remainder N is slow. e = S (q_b, q_b') - Z is the observer's
error, S the scaling by which it has velocities multiplied (`scale`):

    w = (q, q', rest),   E = e,   N_E = scale xi_total in row 1,   xi_total = q_b'' - kappa u

N_E is zero in all other rows. xi_total does not depend on u itself; torque limits, a wrong model and forces
from outside are in it. `rest` is what follows the observer in the controller's state.

`Walker.split` hands the methods to the Python method, `engine.equations` traces them for the compiled one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from biped_adrc.closed_loop.protocols import Loop, Mode
from biped_adrc.closed_loop.semantics import instant
from biped_adrc.core.types import Array
from biped_adrc.hybrid.system import Split


@dataclass(frozen=True)
class ErrorForm:
    """The coordinates of a robot under a controller with a linear observer."""

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
    loop: Loop, form: ErrorForm, t: float, w: Array, E: Array, mode: Mode
) -> tuple[Array, Array]:
    """N_w, and row 1 of N_E (p,), of the closed loop at (t, w, E), t in [s]."""
    i = instant(loop, t, form.back(w, E), mode)
    rest, u = len(i.s) > form.order * form.p, loop.bounded(i.u)
    ds = loop.calls.flow(i.s, i.measurement, u) if rest else i.s
    xi_total = i.a[: form.p] - i.measurement.terms.kappa @ i.u
    dw = np.concatenate((w[form.n : 2 * form.n], i.a, ds[form.order * form.p :]))
    return dw, form.scale * xi_total


def split_of(loop: Loop, form: ErrorForm, mode: Mode) -> Split:
    """The closed loop in these coordinates, as the Python integrator takes it."""

    def on_all_rows(t: float, w: Array, E: Array) -> tuple[Array, Array]:
        N_w, forced = remainder(loop, form, t, w, E, mode)
        N_E = np.zeros((len(form.A), form.p))
        N_E[1] = forced
        return N_w, N_E

    return Split(form.to, form.back, form.A, on_all_rows)
