"""ETD-RK4, the exponential Runge-Kutta method, for a flow whose stiff part is linear.

In the coordinates y = (w, E) of `system.Split`, E' = A E + N_E(t, w, E) and w' = N_w(t, w, E). E (k, c) is the
stiff part, w the rest. A is integrated exactly through the phi-functions; w sees the classical RK4 (Cox,
Matthews, J. Comput. Phys. 176, 2002, eqs (26)-(29)):

    a = e^(hA/2) E + h/2 phi1(hA/2) N(E)
    b = e^(hA/2) E + h/2 phi1(hA/2) N(a)
    c = e^(hA/2) a + h/2 phi1(hA/2) (2 N(b) - N(E))
    E1 = e^(hA) E + h [(phi1 - 3 phi2 + 4 phi3) N(E) + 2 (phi2 - 2 phi3) (N(a) + N(b))
                       + (4 phi3 - phi2) N(c)]

    phi_0 = e^z,   phi_(j+1)(z) = (phi_j(z) - 1/j!) / z

Here h [s] is the step, N(..) the remainder N_E at a stage; phi1 to phi3 without an argument are those of hA.

`hybrid.march` takes the steps. A break (sample instant or switching time of an input) or an event rarely falls
on a multiple of h, so the matrices are made for h and its halvings: by their series for steps so short that
|hA| < 1/2, and doubled from there,

    phi_0(2z) = phi_0^2                    phi_1(2z) = (phi_0 phi_1 + phi_1) / 2
    phi_2(2z) = (phi_0 phi_2 + phi_1 + phi_2) / 4
    phi_3(2z) = (phi_0 phi_3 + phi_1 / 2 + phi_2 + phi_3) / 8

by plain sums and not by BLAS, whose order of summation differs from machine to machine.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from biped_adrc.core.checks import Checked, PositiveFloat
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array, frozen
from biped_adrc.hybrid.constants import MATRICES
from biped_adrc.hybrid.integrators import OneStepMethod

Phi = tuple[Array, Array, Array, Array]
"""phi_0 to phi_3, each (k, k)."""
TERMS = 24
"""Terms of the series; |z|^24 / 24! < 1e-30 for |z| < 1/2."""
LEVELS, STABLE = 13, 0.1
"""The shortest sub-step is h 2^-(levels - 1), with at least LEVELS levels, and no longer than STABLE over the
fastest pole. One step of RK4 goes the rest of the way to a break or an event, and is stable at that length."""


def matrices(half: Phi, phi: Phi, h: float) -> tuple[Array, ...]:
    """The six matrices (k, k) of a step of length h [s]; half, phi: phi_0 to phi_3 of hA/2 and of hA.

    In the order of `constants`: e^(hA/2) [1], h/2 phi1(hA/2) [s], e^(hA) [1], and the weights [s] of N(E), of
    N(a) + N(b) and of N(c) in E1.
    """
    p0, p1, p2, p3 = phi
    first, middle = h * (p1 - 3.0 * p2 + 4.0 * p3), h * (2.0 * p2 - 4.0 * p3)
    return half[0], 0.5 * h * half[1], p0, first, middle, h * (4.0 * p3 - p2)


@dataclass(frozen=True)
class Exponential(Checked, OneStepMethod):
    """ETD-RK4 with a fixed step, in the coordinates of the system's `split`; for continuous time.

    h [s]: length of the step. Raises InputError, when a run begins, for a system without such coordinates.

    >>> walker = ba.Walker(biped, ba.ADRCController(gait.constraint))
    >>> ba.walk(walker, gait, impacts=1, method=ba.Exponential(5e-4)).impacts
    1
    """

    h: PositiveFloat = 5e-4

    @property
    def label(self) -> str:
        return f"ETD-RK4, h = {self.h:g} s"


def no_coordinates() -> InputError:
    """The error that a run by this method raises for a system whose `split` is None."""
    return InputError(
        "the exponential method needs a controller in continuous time whose observer is linear "
        "in its error and measures the true q_b; use RK4 or Adaptive instead"
    )


def _times(A: Array, B: Array) -> Array:
    """A B, both (k, k), by plain sums."""
    return np.einsum("ij,jk->ik", A, B)


def _series(Z: Array) -> Phi:
    """phi_0 to phi_3 of a matrix Z (k, k) with |Z| < 1/2, each by TERMS terms of its series.

    phi_j(Z) is the sum of Z^i / (i + j)!, evaluated by Horner's rule.
    """
    one = np.eye(len(Z))

    def phi(j: int) -> Array:
        total = one / math.factorial(TERMS + j)
        for i in reversed(range(TERMS)):
            total = one / math.factorial(i + j) + _times(Z, total)
        return total

    return phi(0), phi(1), phi(2), phi(3)


def _doubled(phi: Phi) -> Phi:
    """phi_0 to phi_3 of 2z from those of z, each (k, k), by the equations of the module."""
    p0, p1, p2, p3 = phi
    return (
        _times(p0, p0),
        0.5 * (_times(p0, p1) + p1),
        0.25 * (_times(p0, p2) + p1 + p2),
        0.125 * (_times(p0, p3) + 0.5 * p1 + p2 + p3),
    )


def phi_levels(h: float, A: Array) -> Array:
    """The six `matrices` of a step (e^(hA), weights of N, ..) for the steps h 2^-level [s], level = 0, 1, ..

    A (k, k) [1/s]. Returns a read-only array (levels, 6, k, k): so many levels that RK4, which goes on from the
    shortest step, is stable.
    """
    return _phi_levels(h, np.asarray(A, dtype=float).tobytes())


@lru_cache(maxsize=64)
def _phi_levels(h: float, data: bytes) -> Array:
    """The six `matrices` of a step for the steps h 2^-level [s], (levels, 6, k, k). data: the bytes of A (k, k)
    [1/s], by which the results can be cached.

    It goes from the shortest step up, as each level needs the phi-functions of half its step. `short` is the
    first level with |A| h 2^-level <= 1/2, from which on the series holds; longer steps are doubled.
    """
    k = math.isqrt(len(data) // 8)
    A = np.frombuffer(data).reshape(k, k)
    # fastest: largest |pole| [1/s]; size: |hA|, by its largest sum of a row
    fastest = float(np.max(np.abs(np.linalg.eigvals(A)), initial=0.0))
    # at least LEVELS, and the shortest step at most STABLE / fastest: RK4 is stable at that length, and goes
    # the rest of the way to a break or an event
    levels = max(LEVELS, 1 + math.ceil(math.log2(max(fastest * h / STABLE, 1.0))))
    size = float(np.max(np.sum(np.abs(A), axis=1), initial=0.0)) * h
    short = max(0, math.ceil(math.log2(2.0 * size))) if size > 0.0 else 0
    # half of the shortest step: half and phi are the phi-functions of half a step and of the step
    phi = _series(A * (h * 0.5 ** max(short, levels)))
    table = np.zeros((levels, MATRICES, k, k))
    for level in reversed(range(max(short, levels))):
        half, phi = phi, _doubled(phi) if level < short else _series(A * (h * 0.5**level))
        if level < levels:
            table[level] = matrices(half, phi, h * 0.5**level)
    return frozen(table)
