"""Parts of the photograph's own: plain Python, as a user writes it, and laws that compile."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

import biped_adrc as ba
from biped_adrc.disturbances.base import Windowed
from biped_adrc.observers.chain import ChainObserver


# -- controllers -----------------------------------------------------------------------------------
@dataclass(frozen=True)
class OwnPD(ba.Controller):
    """u = K_p e + K_d e' + Omega: the controller of the README."""

    reference: Any
    K_p: float = 2500.0
    K_d: float = 120.0

    def output(self, s: Any, m: Any) -> Any:
        r, p = self.reference(m.t, m.q, m.v), len(m.q_b)
        return self.K_p * (r.q_d - m.q_b) + self.K_d * (r.dq_d - m.v_b) + m.terms.Omega[:p]


@dataclass(frozen=True)
class OwnContinuous(OwnPD):
    """With an integral of the error, in continuous time only."""

    K_i: float = 800.0

    def initial_state(self, m: Any) -> Any:
        return np.zeros(len(m.q_b))

    def output(self, s: Any, m: Any) -> Any:
        return super().output(s, m) + self.K_i * s

    def flow(self, s: Any, m: Any, u: Any) -> Any:
        return self.reference(m.t, m.q, m.v).q_d - m.q_b

    def jump(self, s: Any, after: Any, swap: Any) -> Any:
        return 0.5 * s[swap]


@dataclass(frozen=True)
class OwnIntegral(OwnContinuous):
    """The same with a discrete form."""

    def sampled(self, period: float) -> OwnTicks:
        return OwnTicks(self.reference, self.K_p, self.K_d, self.K_i, period)


@dataclass(frozen=True)
class OwnTicks(OwnPD):
    """The discrete form: an integral by rectangles, and the last angles."""

    K_i: float = 800.0
    period: float = 1e-3

    def initial_state(self, m: Any) -> Any:
        return np.concatenate((np.zeros(len(m.q_b)), m.q_b))

    def correct(self, s: Any, m: Any) -> Any:
        return np.concatenate((s[: len(m.q_b)], 0.2 * s[len(m.q_b) :] + 0.8 * m.q_b))

    def output(self, s: Any, m: Any) -> Any:
        p = len(m.q_b)
        return super().output(s, m) + self.K_i * s[:p] + 5.0 * (s[p:] - m.q_b)

    def predict(self, s: Any, m: Any, u: Any) -> Any:
        p, r = len(m.q_b), self.reference(m.t, m.q, m.v)
        return np.concatenate((s[:p] + self.period * (r.q_d - m.q_b) - 1e-9 * u, s[p:]))

    def jump(self, s: Any, after: Any, swap: Any) -> Any:
        p = len(swap)
        return np.concatenate((s[:p][swap], after.q_b))


@dataclass(frozen=True)
class OwnRaises(OwnPD):
    """With a mistake that shows after 0.1 s."""

    def output(self, s: Any, m: Any) -> Any:
        if m.t_step > 0.1:
            raise ValueError("a mistake of its own")
        return super().output(s, m)


@dataclass(frozen=True)
class OwnLaws(ba.Controller):
    """As `OwnPD` with a soft spring."""

    reference: Any
    K_p: float = 2500.0
    K_d: float = 120.0

    def output(self, s: Any, m: Any) -> Any:
        r, p = self.reference(m.t, m.q, m.v), m.terms.kappa.shape[0]
        soft = np.tanh(r.q_d - m.q[:p])
        return self.K_p * soft + self.K_d * (r.dq_d - m.v[:p]) + m.terms.Omega[:p]


# -- observers -------------------------------------------------------------------------------------
def fal(e: Any, a: float, d: float) -> Any:
    """|e|^a sign(e), linear within |e| <= d."""
    return np.where(np.abs(e) <= d, e / d ** (1.0 - a), np.sign(e) * np.abs(e) ** a)


@dataclass(frozen=True)
class OwnObserver(ChainObserver):
    """Han's nonlinear extended state observer, as methods alone."""

    m: int = 1
    scale: float = 1.0
    w: float = 60.0
    d: float = 1e-3

    def flow(self, z: Any, y: Any, input: Any) -> Any:
        z1, z2, z3 = z.reshape(3, -1)
        e, w = y - z1, self.w
        first, second = z2 + 3.0 * w * e, z3 + 3.0 * w**2 * fal(e, 0.5, self.d) + input
        return np.concatenate((first, second, w**3 * fal(e, 0.25, self.d)))

    def sampled(self, period: float) -> OwnSampledObserver:
        return OwnSampledObserver(w=self.w, d=self.d, period=period)


@dataclass(frozen=True)
class OwnSampledObserver(OwnObserver):
    """The same by Euler's rule, a small gain for each tick."""

    period: float = 1e-3

    def correct(self, z: Any, y: Any) -> Any:
        Z, T = z.reshape(3, -1).copy(), self.period
        e, gain = y - Z[0], 1.0 - math.exp(-3.0 * self.w * T)
        Z[0] += gain * e
        Z[1] += gain * self.w * e
        Z[2] += gain * self.w**2 * e / 3.0
        return Z.ravel()

    def predict(self, z: Any, input: Any) -> Any:
        Z, T = z.reshape(3, -1), self.period
        return np.concatenate((Z[0] + T * Z[1], Z[1] + T * (Z[2] + input), Z[2]))


@dataclass(frozen=True)
class OwnLawObserver(ChainObserver):
    """An observer that is none of the package's, whose injection is soft."""

    m: int = 1
    scale: float = 1.0
    w: float = 200.0

    def flow(self, z: Any, y: Any, input: Any) -> Any:
        Z = z.reshape(3, -1)
        e = np.tanh(50.0 * (y - Z[0])) / 50.0
        dZ = np.zeros(Z.shape)
        dZ[0] = Z[1] + 3.0 * self.w * e
        dZ[1] = Z[2] + 3.0 * self.w**2 * e + input
        dZ[2] = self.w**3 * e
        return dZ.ravel()


# -- disturbances and references -------------------------------------------------------------------
@dataclass(frozen=True)
class OwnPush(ba.Disturbance):
    """A torque that decays, and a drag, as a method alone."""

    amplitude: Any
    rate: float

    def torque(self, t: float, step: int, t_start: float, q: Any, v: Any) -> Any:
        return self.amplitude * math.exp(-self.rate * t) - 0.2 * v


@dataclass(frozen=True)
class OwnLawPush(ba.Disturbance):
    """The same from the start of each single support."""

    amplitude: Any
    rate: float

    def torque(self, t: float, step: int, t_start: float, q: Any, v: Any) -> Any:
        return self.amplitude * math.exp(-self.rate * (t - t_start)) - 0.2 * v


@dataclass(frozen=True)
class OwnWave(Windowed):
    """A triangle in its window, for a link, as a method alone."""

    def torque(self, t: float, step: int, t_start: float, q: Any, v: Any) -> Any:
        origin = 0.0 if self.step is None else t_start
        share = (t - origin - self.start) / (self.stop - self.start)
        inside = 0.0 <= share < 1.0 and self.step in (None, step)
        return np.array(self.amplitude) * ((1.0 - abs(2.0 * share - 1.0)) if inside else 0.0)


@dataclass(frozen=True)
class OwnReference(ba.Reference):
    """A virtual constraint that breathes with time."""

    base: Any

    def __call__(self, t: float, q: Any, v: Any) -> Any:
        r, b = self.base(t, q, v), 2e-3
        return r._replace(
            q_d=r.q_d + b * math.sin(9.0 * t),
            dq_d=r.dq_d + 9.0 * b * math.cos(9.0 * t),
            drift=r.drift - 81.0 * b * math.sin(9.0 * t),
        )


@dataclass(frozen=True)
class Still:
    """The angles of one moment, as a function of time."""

    q: Any

    def __call__(self, t: float) -> Any:
        zero = np.zeros(len(self.q))
        return self.q, zero, zero


@dataclass(frozen=True)
class CurvedOutput:
    """y(q) of q_b - h(Theta) with a bend, for outputs given as a function."""

    constraint: Any
    p: int

    def __call__(self, q: Any) -> Any:
        y = q[: self.p] - self.constraint.h(float(self.constraint.phase @ q))[0]
        return y + 0.1 * y * y
