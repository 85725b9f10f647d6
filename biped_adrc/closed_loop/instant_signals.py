"""All signals of a closed loop at one instant, read off its state.

Compiled code is made from the same functions, run on symbols, so that both engines report the same quantities
(`analysis.signals`). In all of them t [s] is the time, x (nx,) the state of plant, controller and hardware, and
mode the single support, its number and the time at which it began. Symbols:

    q, v = q'     coordinates (n,) [rad], rates; q_b and v_b are the first p, those of the joints with motors
    q_d           reference of q_b (p,) [rad]
    u, zeta       torque of the motors (p,) [N m]; disturbance, a generalised force (n,) [N m]
    kappa, xi     q_b'' = kappa u + xi: input gain (p, p) [1/(kg m^2)], total disturbance (p,) [rad/s^2]
    xi~           generalised force that the nominal model (the controller's) does not know (n,) [N m]
    ^, m v_com    an estimate by the controller's observer; momentum of the whole robot (2,) [N s]
"""

from collections.abc import Callable
from functools import cache
from typing import Annotated, Any, NamedTuple, Self, get_type_hints

import numpy as np

from biped_adrc.closed_loop.protocols import Loop, Mode
from biped_adrc.closed_loop.semantics import estimated, instant, parts, xi_unknown
from biped_adrc.control.base import Measurement
from biped_adrc.core.tree import Layout
from biped_adrc.core.types import Array
from biped_adrc.gait.reference import ReferencePoint
from biped_adrc.model.reduction import disturbance_parts

Tracked = Callable[[Any, Measurement], ReferencePoint]
"""reference(s, m) -> the point of a reference at the measurement m; s is the controller's state, from which an
outer loop takes the reference that is in force."""


class InstantSignals(NamedTuple):
    """All signals at one instant, or at N instants with N rows each; n coordinates, p motors."""

    a: Array
    """q'' of the plant (n,) [rad/s^2]."""
    q_d: Array
    """Reference of the joints (p,) [rad]."""
    dq_d: Array
    """Its rate (p,) [rad/s]."""
    u: Array
    """Torque applied (p,) [N m]."""
    zeta: Array
    """Disturbance (n,) [N m]."""
    xi: Array
    """Total disturbance q_b'' - kappa u (p,) [rad/s^2], from the plant's own q''."""
    xi_estimate: Array
    """The observer's estimate xi^ of xi (p,) [rad/s^2]; NaN without an observer."""
    xi_external: Array
    """The part of xi that the nominal model does not know (p,) [rad/s^2]: a matched part, which motors could
    cancel, and an unmatched one, which comes from the unactuated coordinates."""
    xi_matched: Array
    """The matched part, kappa xi~_b (p,) [rad/s^2], xi~_b (p,) [N m] being the unknown force on the joints."""
    xi_nominal: Array
    """The part of xi that the nominal model knows, (14) of the paper with xi~ = 0 (p,) [rad/s^2]."""
    zeta_estimate: Array
    """The disturbance torque that explains the estimate, kappa^-1 (xi^ - xi_nominal) (p,) [N m]."""
    ground_reaction: Array
    """m (p_com'' - g) (2,) [N], tangential and normal: the force of the ground plus the resultant force from
    outside, which `analysis.signals` subtracts."""
    momentum: Array
    """m v_com of the plant (2,) [N s]."""
    kinetic: Array
    """Kinetic energy [J]."""
    potential: Array
    """Potential energy [J], zero with the COM at the height of the present stance foot."""
    swing_foot: Array
    """Place (x, z) of the swing foot relative to the stance foot (2,) [m]."""
    hip: Array
    """Place (x, z) of the hip relative to the stance foot (2,) [m]."""


def signals_at(loop: Loop, t: float, x: Array, mode: Mode, reference: Tracked) -> InstantSignals:
    """The signals at t [s] in the state x (nx,), as numbers or symbols. reference(s, m) gives q_d and dq_d,
    usually of the reference that the controller tracks; a run may also be compared with another one."""
    i = instant(loop, t, x, mode)
    # terms: of the nominal model; they have kappa, its inverse, and xi with xi~ = 0
    m, plant, terms, p = i.measurement, loop.plant, i.measurement.terms, loop.plant.p
    # the tail of x, behind the controller's state, says by which names of the legs the controller estimates
    r, result = reference(i.s, m), estimated(loop, i.s, parts(loop, x).tail, m, mode)
    xi_estimate = np.full(p, np.nan) if result is None else result
    matched, unmatched = disturbance_parts(terms, xi_unknown(loop, terms, i.a, i.u, i.zeta))
    return InstantSignals(
        a=i.a,
        q_d=r.q_d,
        dq_d=r.dq_d,
        u=i.u,
        zeta=i.zeta,
        xi=i.a[:p] - terms.kappa @ i.u,
        xi_estimate=xi_estimate,
        xi_external=matched + unmatched,
        xi_matched=matched,
        xi_nominal=terms.xi,
        zeta_estimate=terms.kappa_inverse @ (xi_estimate - terms.xi),
        ground_reaction=plant.ground_reaction(m.q, m.v, i.a),
        momentum=plant.momentum(m.q, m.v),
        kinetic=plant.kinetic_energy(m.q, m.v),
        potential=plant.potential_energy(m.q),
        swing_foot=plant.swing_foot(m.q),
        hip=plant.hip(m.q),
    )


def controller_inputs(
    loop: Loop, t: float, x: Array, mode: Mode, reference: Tracked | None
) -> tuple[Array, ...]:
    """What a controller needs at the sample instant t [s] in the state x (nx,), for sensors that are exact: q
    and v (n,), the nominal model's terms there (arrays of a `Reduction`), and the reference's point (arrays of
    a `ReferencePoint`), which is left out for reference None."""
    q, v, s, _ = parts(loop, x)
    m = loop.measure(t, q, v, mode)
    return (q, v, *m.terms, *(reference(s, m) if reference else ()))


class StepReading(NamedTuple):
    """The signals of the closed loop at one instant that verdicts and studies read.

    To add a signal, add a line here, with its size ("p", "n", a number, or () for a single number), and a line
    in `of`.
    """

    error: Annotated[Array, "p"]
    """Tracking error q_b - q_d of the joints (p,) [rad]."""
    u: Annotated[Array, "p"]
    """Torque applied (p,) [N m]."""
    q: Annotated[Array, "n"]
    """Coordinates (n,) [rad], those of the joints first."""
    v_b: Annotated[Array, "p"]
    """Their rates (p,) [rad/s]."""
    momentum: Annotated[Array, 2]
    """m v_com of the plant (2,) [N s]."""
    swing_foot: Annotated[Array, 2]
    """Place (x, z) of the swing foot relative to the stance foot (2,) [m]."""

    @classmethod
    def of(cls, q: Array, v: Array, s: Any) -> Self:
        """Take them from q (n,) [rad], v (n,) [rad/s] and the other signals s at one instant, or at K nodes
        with a leading axis of K; s: an `InstantSignals`, or an `analysis.signals.Signals`.
        """
        p = s.u.shape[-1]
        return cls(
            error=q[..., :p] - s.q_d,
            u=s.u,
            q=q,
            v_b=v[..., :p],
            momentum=s.momentum,
            swing_foot=s.swing_foot,
        )


class NodeRow(NamedTuple):
    """Numbers that a compiled walk keeps at one node, a stored instant; at K nodes with a leading axis of K."""

    t: Array
    """Time [s]."""
    step: Array
    """Number of the single support."""
    outside: Array
    """Resultant force from outside on the robot as a whole (2,) [N]."""
    reading: StepReading
    """Signals of the closed loop."""


@cache
def node_layout(n: int, p: int) -> Layout:
    """The layout of a `NodeRow` as one vector, for n coordinates, p of them with a motor."""
    # include_extras: the annotations with the size, "p", "n", a number or () for a single number
    hints = get_type_hints(StepReading, include_extras=True)
    sizes = (hints[name].__metadata__[0] for name in StepReading._fields)
    reading = StepReading(*(np.zeros({"p": p, "n": n}.get(size, size)) for size in sizes))
    return Layout.of(NodeRow(np.zeros(()), np.zeros(()), np.zeros(2), reading))


def step_reading(loop: Loop, t: float, x: Array, mode: Mode, reference: Tracked) -> StepReading:
    """The `StepReading` at t [s] in the state x (nx,), with the error to reference(s, m)."""
    q, v = parts(loop, x)[:2]
    return StepReading.of(q, v, signals_at(loop, t, x, mode, reference))
