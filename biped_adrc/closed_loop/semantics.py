"""What a closed loop does: its flow, its tick, its impact, and what can be read off it at one instant.

    q'' = f(q, q') + D_s^-1 (B_s u + zeta)        between impacts   (10)
    (q, q')+ = R Delta(q-, q'-)                   at foot strike    (10)

State x = (q, q', s) in continuous time, (q, q', s, held) in sampled time, with `held` of `hardware.held`. The
controller's terms come from the nominal model, the motion from the plant.

These functions are the only place where this is said. They run on NumPy's arrays for `Walker` and `ArmSystem`,
and on symbols for compiled code; nothing here may branch on a number that is not an int of the structure.
"""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol

import numpy as np

from biped_adrc.control.base import Measurement
from biped_adrc.hardware.meter import Hit, Outside, loads, metered
from biped_adrc.hardware.motors import Line, acting, limited, mean_torque, sent
from biped_adrc.hardware.sample_hold import (
    Held,
    HeldParameters,
    after_impact,
    lagged,
    motor_torque,
    read,
    written,
)
from biped_adrc.hardware.sensors import sense
from biped_adrc.linear import solve_positive
from biped_adrc.model.reduction import BodyTerms, Reduction, unknown_force
from biped_adrc.types import Array


class Mode(NamedTuple):
    """Single support `step` (from 1) that began at `start` [s]."""

    step: int = 1
    start: float = 0.0


class Plant(Protocol):
    """What moves: n coordinates, the first p of them with motors. Angles q, rates v and forces are (n,)."""

    @property
    def n(self) -> int: ...
    @property
    def p(self) -> int: ...
    def reduction(self, q: Array, v: Array) -> Reduction:
        """The terms of (11)-(15)."""

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        """q'' (n,) under the generalised force B_s u + zeta, friction included."""


class WalkingPlant(Plant, Protocol):
    """A plant that stands on the ground with one foot and strikes it with the other."""

    def body_terms(self, q: Array, v: Array) -> BodyTerms:
        """G, C' q', and the force of the ground as F_a q'' + F_0."""

    def impact(self, q: Array, v: Array) -> Any:
        """With q and v (n,) after the impact (7) and relabelling (8), and the ground's impulse (2,) [N s]."""

    def momentum(self, q: Array, v: Array) -> Array:
        """m v_com (2,) [N s]."""

    def ground_reaction(self, q: Array, v: Array, a: Array) -> Array:
        """Of the ground on the stance foot (2,) [N], without forces from outside."""

    def swing_foot(self, q: Array) -> Array:
        """(x, z) from the stance foot [m]."""

    def hip(self, q: Array) -> Array:
        """(x, z) from the stance foot [m]."""


class Loop(Protocol):
    """The parts of a closed loop, and what acts on it from outside."""

    @property
    def plant(self) -> Any:
        """A `Plant`; a `WalkingPlant` where there are impacts or a meter."""

    @property
    def nominal(self) -> Any:
        """The controller's model: a plant too, or the plant itself."""

    @property
    def exact(self) -> bool:
        """Whether the nominal model is the plant, without friction that it does not know."""

    @property
    def law(self) -> Any:
        """The controller in its time base, with the methods of `control.base.Controller`."""

    @property
    def held(self) -> HeldParameters | None:
        """Of what is held between ticks; None in continuous time."""

    @property
    def swap(self) -> Any:
        """Relabelling of the actuated joints (p,), dtype int."""

    @property
    def gain(self) -> Array:
        """Errors of the impact map: v+ = (1 + gain) v+, (n,) or empty for none."""

    def measure(self, t: float, q: Array, v: Array, mode: Mode) -> Measurement:
        """What the controller is given: `measurement`."""

    def saturate(self, u: Array) -> Array:
        """u (p,) [N m] within the torque limit."""

    def external(self, t: float, q: Array, v: Array, mode: Mode) -> Array:
        """zeta (n,) [N m]."""

    def outside(self, t: float, mode: Mode) -> Outside:
        """Force from outside at a tick and since the last one, and how far the ground drops; for the meter."""


class Instant(NamedTuple):
    """What acts at one state."""

    measurement: Measurement
    s: Array
    u: Array
    """Torque applied (p,) [N m]."""
    zeta: Array
    """External torque (n,) [N m]."""
    force: Array
    """B_s u + zeta (n,) [N m]."""
    a: Array
    """q'' (n,) [rad/s^2]."""


def parts(loop: Loop, x: Array) -> tuple[Array, Array, Array, Array]:
    """q, v, s of x, and the tail that is held between ticks."""
    n, k = loop.plant.n, loop.held
    end = len(x) if k is None else len(x) - k.sizes.total
    return x[:n], x[n : 2 * n], x[2 * n : end], x[end:]


def measurement(loop: Loop, t: float, q: Array, v: Array, mode: Mode, body: bool) -> Measurement:
    """What the controller is given at (t, q, v), with the terms of a body if it needs them."""
    terms = loop.nominal.body_terms(q, v) if body else None
    return Measurement(t, mode.step, t - mode.start, q, v, loop.nominal.reduction(q, v), terms)


def applied(u: Array, zeta: Array) -> Array:
    """The generalised force B_s u + zeta (n,) [N m]."""
    force = zeta.copy()
    force[: len(u)] = force[: len(u)] + u
    return force


def torque_held(k: HeldParameters, tail: Array) -> Array:
    """The torque on the joints (p,) [N m] between ticks."""
    return motor_torque(read(k.sizes, tail).line)


def acceleration(loop: Loop, terms: Reduction, q: Array, v: Array, force: Array) -> Array:
    """q'' of the plant (n,); where it is the nominal model, D_s and Omega are in `terms` already."""
    if loop.exact:
        return solve_positive(terms.D, force - terms.Omega, "D_s")
    return loop.plant.acceleration(q, v, force)


def instant(loop: Loop, t: float, x: Array, mode: Mode) -> Instant:
    """Measurement, torque, force and acceleration at (t, x)."""
    q, v, s, tail = parts(loop, x)
    m, k = loop.measure(t, q, v, mode), loop.held
    u = torque_held(k, tail) if k is not None else loop.saturate(loop.law.output(s, m))
    zeta = loop.external(t, q, v, mode)
    force = applied(u, zeta)
    return Instant(m, s, u, zeta, force, acceleration(loop, m.terms, q, v, force))


def flow(loop: Loop, t: float, x: Array, mode: Mode) -> Array:
    """x' between events; between ticks the controller rests and the torque is held."""
    k = loop.held
    if k is None:
        i = instant(loop, t, x, mode)
        return np.concatenate((i.measurement.v, i.a, loop.law.flow(i.s, i.measurement, i.u)))
    q, v, s, tail = parts(loop, x)
    u = torque_held(k, tail)
    a = loop.plant.acceleration(q, v, applied(u, loop.external(t, q, v, mode)))
    return np.concatenate((v, a, np.zeros(len(s)), lagged(k, tail)))


def tick(loop: Loop, t: float, x: Array, mode: Mode) -> Array:
    """x after a tick of the control clock: sensors, controller, motors, meter."""
    (q, v, s, tail), k = parts(loop, x), loop.held
    assert k is not None
    h, n = read(k.sizes, tail), k.sizes.n
    w = sense(k.sensors, h.w, q, v) if k.sizes.sensors > 0 else h.w
    seen = (w[:n], w[n : 2 * n]) if k.sizes.sensors > 0 else (q, v)
    m = loop.measure(t, *seen, mode)
    (s, line), g = decided(loop, k, s, m, h.line), h.g
    if k.sizes.meter > 0:
        terms = loop.nominal.reduction(q, v) if k.sizes.sensors > 0 else m.terms
        g = measured_by_meter(loop, t, g, q, v, line, terms, mode)
    return np.concatenate((q, v, s, written(Held(w, g, line, h.own))))


def asked(loop: Loop, s: Array, m: Measurement) -> tuple[Array, Array]:
    """The controller's state corrected by a measurement, and the torque (p,) [N m] that it asks for."""
    s = loop.law.correct(s, m)
    return s, loop.saturate(loop.law.output(s, m))


def decided(
    loop: Loop, k: HeldParameters, s: Array, m: Measurement, line: Line
) -> tuple[Array, Line]:
    """The controller's state and the line of torques after it has acted on a measurement."""
    s, u = asked(loop, s, m)
    if k.sizes.rate > 0:
        u = limited(k.motors, line, u)
    line = sent(k.motors, line, u)
    return loop.law.predict(s, m, acting(k.motors, line) if k.sizes.known > 0 else u), line


def measured_by_meter(
    loop: Loop, t: float, g: Array, q: Array, v: Array, line: Line, terms: Reduction, mode: Mode
) -> Array:
    """The meter's state g after a tick at which `line` is sent; terms of the nominal model at (q, v)."""
    k = loop.held
    assert k is not None
    u, zeta = motor_torque(line), loop.external(t, q, v, mode)
    a = acceleration(loop, terms, q, v, applied(u, zeta))
    asked = loads(loop.plant, loop.outside(t, mode), q, v, a)
    xi = unknown(loop, terms, a, u, zeta)
    given = (q, v, u, mean_torque(k.motors, line), xi, terms, t, mode.step, t - mode.start, asked)
    return metered(k.meter, g, *given)


def release(loop: Loop, x: Array) -> Array:
    """x once the torque that waited for a part of the period acts."""
    p, x = loop.plant.p, x.copy()
    x[-p:] = x[-2 * p : -p]
    return x


def unknown(loop: Loop, terms: Reduction, a: Array, u: Array, zeta: Array) -> Array:
    """xi~ of (11) (n,) [N m]: zeta, and with a plant that is not the model all that is wrong with it."""
    return zeta if loop.exact else unknown_force(terms, a, u)


def struck(loop: Loop, t: float, x: Array, after: Mode) -> Array:
    """x+ after impact, relabelling and the controller's jump; `after` is the single support that begins."""
    q, v = parts(loop, x)[:2]
    impact = loop.plant.impact(q, v)
    v_plus = impact.v * (1.0 + loop.gain) if len(loop.gain) > 0 else impact.v
    return landed(loop, t, x, impact.q, v_plus, impact.impulse, after)


def landed(
    loop: Loop, t: float, x: Array, q_plus: Array, v_plus: Array, impulse: Array, after: Mode
) -> Array:
    """x+ after an impact at x that left the plant in (q+, q'+): what is held, and the controller's jump.

    impulse: of the ground (2,) [N s], for the meter.
    """
    (q, v, s, tail), k = parts(loop, x), loop.held
    seen = q_plus, v_plus
    if k is not None:
        h, n, expected, hit = read(k.sizes, tail), k.sizes.n, v_plus, None
        if k.sizes.sensors > 0:
            expected = loop.nominal.impact(h.w[:n], h.w[n : 2 * n]).v
        if k.sizes.meter > 0:
            hit = Hit(t, after.step - 1.0, loop.plant.momentum(q, v), impulse)
        h = after_impact(k, h, loop.swap, q, q_plus, v_plus, expected, hit)
        if k.sizes.sensors > 0:
            seen = h.w[:n], h.w[n : 2 * n]
        tail = written(h)
    s = loop.law.jump(s, loop.measure(t, *seen, after), loop.swap)
    return np.concatenate((q_plus, v_plus, s, tail))


def clearance(tan_slope: float, drop: float, foot: Array) -> Any:
    """Height of the swing foot (x, z) above the ground, along the vertical [m]; 0 at touchdown.

    The ground is a slope through the stance foot, and `drop` [m] lower where this single support ends.
    """
    return foot[1] + tan_slope * foot[0] + drop


def hip_margin(lowest: float, hip: Array) -> Any:
    """Height of the hip (x, z) above the lowest that is no fall [m]."""
    return hip[1] - lowest


def time_left(longest: float, start: float, t: float) -> Any:
    """Of the longest single support, for one that began at `start` [s]."""
    return start + longest - t
