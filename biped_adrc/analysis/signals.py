"""All signals of a walk: references, errors, torques, estimates, energies, contact forces.

A trajectory stores states only. Controllers have no hidden state, so every other signal is computed
again from the stored states, at the stored nodes, by the same closed loop (`closed_loop.system`)
that made them; compiled where the walk was. Plots, metrics, certificates and exports read
`Signals`.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from biped_adrc.analysis.quadrature import largest
from biped_adrc.analysis.recorded_signals import PLACE, as_recorded, footholds, recorded
from biped_adrc.closed_loop.instant_signals import InstantSignals, signals_at
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.base import Measurement
from biped_adrc.control.outer_loop import OuterLoop, reference_in_force
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, freeze
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.hybrid.trajectory import Trajectory

LONG = 2000
"""Number of nodes from which on compiling is faster than NumPy."""


@dataclass(frozen=True)
class Signals(Shown):
    """All signals of a walk; rows are the K stored nodes. Impacts and sample instants repeat their
    time, with the values before and after.
    """

    t: Array
    """(K,) [s]."""
    step: Array
    """Number of the single support (K,), from 1."""
    q: Array
    """(K, n) [rad]."""
    v: Array
    """(K, n) [rad/s]."""
    a: Array
    """(K, n) [rad/s^2]."""
    theta: Array
    """(K,) Theta [rad]."""
    dtheta: Array
    """(K,) Theta' [rad/s]."""
    q_d: Array
    """References of the actuated joints (K, p) [rad]."""
    dq_d: Array
    """Their rates (K, p) [rad/s]."""
    error: Array
    """(K, p) q_b - q_d [rad]."""
    u: Array
    """(K, p) torque applied [N m]."""
    zeta: Array
    """(K, n) external torque [N m]."""
    xi: Array
    """(K, p) total disturbance q_b'' - kappa u of the nominal model [rad/s^2]."""
    xi_estimate: Array
    """(K, p) estimate of xi [rad/s^2]; NaN without an observer."""
    xi_external: Array
    """(K, p) the part of xi that the nominal model does not know, matched and unmatched: what zeta makes, and
    errors of the model, friction among them [rad/s^2]. It is xi - xi_nominal."""
    xi_matched: Array
    """(K, p) kappa xi~_b, the matched part of it, with xi~ of (11): what a motor could cancel [rad/s^2]."""
    xi_nominal: Array
    """(K, p) (14) without xi~: the part of xi that the nominal model knows [rad/s^2]."""
    zeta_estimate: Array
    """(K, p) kappa^-1 (xi^ - xi_nominal): the joint torque the estimate amounts to beyond the nominal
    model [N m]; NaN without an observer."""
    ground_reaction: Array
    """(K, 2), (F_T, F_N) [N], horizontal and vertical on any ground."""
    outside: Array
    """(K, 2), force from outside on the robot as a whole [N], along x and z."""
    momentum: Array
    """(K, 2), m v_com of the plant [N s], along x and z."""
    kinetic: Array
    """(K,) [J]."""
    potential: Array
    """(K,) [J], zero at the height of the first stance foot."""
    swing_foot: Array
    """(K, 2) from the stance foot [m]."""
    hip: Array
    """(K, 2) from the stance foot [m]."""
    foothold: Array
    """(K,) x of the stance foot in the world [m]."""
    foothold_height: Array
    """(K,) z of the stance foot in the world [m]."""

    def __post_init__(self) -> None:
        freeze(self, *(f.name for f in fields(self)))

    def __repr__(self) -> str:
        ends = f"{self.t[0]:.4g} to {self.t[-1]:.4g} s"
        return f"Signals({len(self.t)} nodes, {ends}, n = {self.q.shape[1]}, p = {self.u.shape[1]})"

    @property
    def xi_unmatched(self) -> Array:
        """(K, p) the rest of `xi_external`: it enters through the unactuated row of (12) [rad/s^2]."""
        return self.xi_external - self.xi_matched

    @property
    def peak_error(self) -> float:
        """max |q_b - q_d| [rad], also between the nodes."""
        return largest(self.t, self.error, self.v[:, : self.error.shape[1]] - self.dq_d)

    def of_step(self, step: int) -> Signals:
        """The rows of one single support."""
        rows = slice(*np.searchsorted(self.step, (step, step + 1)))
        return Signals(**{f.name: getattr(self, f.name)[rows] for f in fields(self)})


def signals(walker: Walker, trajectory: Trajectory, reference: Reference) -> Signals:
    """The signals of a walk; `reference` gives q_d (usually the controller's own).

    Where outer loops correct the reference, q_d is the corrected one, in NumPy. For any other compiled
    run, and for a long one, they are computed in compiled code where that is possible.
    """
    many = sum(len(arc.t) for arc in trajectory.arcs) >= LONG
    compiled = trajectory.settings.get("engine") == "compiled"
    if (compiled or many) and not isinstance(walker.law, OuterLoop):
        from biped_adrc.engine.compiled_signals import compiled_readings

        result = compiled_readings(walker, trajectory, reference)
        if result is not None:
            return signals_of(walker, trajectory, result)
    return signals_of(walker, trajectory, readings(walker, trajectory, reference))


def readings(walker: Walker, trajectory: Trajectory, reference: Reference) -> InstantSignals:
    """What is read off the closed loop at all nodes of a walk, in NumPy; arrays (K, ...)."""

    def tracked(s: Array, m: Measurement) -> ReferencePoint:
        law = walker.law
        r = reference_in_force(law, s) if isinstance(law, OuterLoop) else reference
        return r(m.t, m.q, m.v)

    rows = [
        signals_at(walker, float(t), x, arc.mode, tracked)
        for arc in trajectory.arcs
        for t, x in zip(arc.seen, arc.x, strict=True)
    ]
    return InstantSignals(*(np.array(column) for column in zip(*rows, strict=True)))


def signals_of(walker: Walker, trajectory: Trajectory, r: InstantSignals) -> Signals:
    """The signals from the readings at the nodes: adds what follows from the states and the footholds."""
    arcs, n, p = trajectory.arcs, walker.plant.n, walker.plant.p
    r = as_recorded(walker, trajectory, r)
    x = np.vstack([arc.x for arc in arcs])
    q, v = x[:, :n], x[:, n : 2 * n]
    foot = recorded(trajectory, PLACE)
    if foot is None:
        foot = np.repeat(footholds(walker, trajectory), [len(arc.t) for arc in arcs], axis=0)
    outside = np.zeros((len(x), 2))
    if walker.disturbance is not None and walker.disturbance.pulls:
        outside = np.array([walker.resultant(float(t), arc.mode) for arc in arcs for t in arc.seen])
    return Signals(
        t=np.concatenate([arc.t for arc in arcs]),
        step=np.concatenate([np.full(len(arc.t), arc.mode.step) for arc in arcs]),
        q=q,
        v=v,
        theta=q @ walker.plant.phase,
        dtheta=v @ walker.plant.phase,
        error=q[:, :p] - r.q_d,
        foothold=foot[:, 0],
        foothold_height=foot[:, 1],
        **{
            **r._asdict(),
            "ground_reaction": r.ground_reaction - outside,
            "outside": outside,
            "potential": r.potential + walker.plant.weight * foot[:, 1],
        },
    )
