"""Replays a log through a controller and its observer, sample by sample.

At row k, with measurement m_k, in the order of `closed_loop.semantics.tick`; the log's torque u_k [N m] acts in
place of the controller's own:

    a touchdown:   s <- jump(s, m+), m+ with the angles of row k and the rates just after the nominal impact (7)
    y_k - y^_k     the observer's error [rad], before its state s is corrected by row k
    s <- correct(s, m_k),   xi^_k = estimate(s),   output(s, m_k) is what it would have asked for
    s <- predict(s, m_k, u_k)                      u_k is what acted

xi^ - xi_nominal [rad/s^2] is the part of the estimate that the nominal model does not explain; kappa^-1 times
it is a torque on the joints [N m]. Less than `window` [s] after a touchdown it counts as contact, at other
times as error of the model and torques from outside.

Rates that the log does not have are differences of its angles behind the low-pass of `hardware.sensors`; at a
touchdown the nominal impact (7) resets them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.base import Measurement
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, freeze
from biped_adrc.extras.logs.robot_log import RobotLog
from biped_adrc.hardware.sensors import Sensors


@dataclass(frozen=True)
class ReplaySignals(Shown):
    """Signals of a replay: K rows as in the log, n coordinates, p joints, in the
    labels of stance and swing leg.

    Without an observer the signals that come from estimates are NaN.
    """

    t: Array
    """(K,) [s]."""
    step: Array
    """Number of the single support (K,)."""
    t_step: Array
    """Time since the touchdown (K,) [s]; in the first single support since the first row."""
    q: Array
    """(K, n) [rad], from the log."""
    v: Array
    """(K, n) [rad/s], from the log or from differences."""
    u: Array
    """(K, p) [N m], from the log."""
    torque: Array
    """(K, p) torque of the replayed controller, within the torque limit [N m]."""
    residual: Array
    """(K, p) q_b - x1^ [rad] before the correction by the sample; 0 for observers without angles."""
    xi_estimate: Array
    """(K, p) xi^ [rad/s^2] after the correction by the sample."""
    xi_nominal: Array
    """(K, p) xi of the nominal model (14) [rad/s^2]."""
    zeta_estimate: Array
    """(K, p) kappa^-1 (xi^ - xi_nominal): the joint torque beyond the nominal model [N m]."""
    in_contact: Array
    """(K,), 1 within the window after a touchdown, else 0."""

    def __post_init__(self) -> None:
        freeze(self, *(f.name for f in fields(self)))

    @property
    def xi_contact(self) -> Array:
        """(K, p) the part of xi^ - xi_nominal within the window after a touchdown [rad/s^2]."""
        return (self.xi_estimate - self.xi_nominal) * self.in_contact[:, np.newaxis]

    @property
    def xi_model_error(self) -> Array:
        """(K, p) the part of xi^ - xi_nominal outside the window [rad/s^2], torques from outside among it."""
        return self.xi_estimate - self.xi_nominal - self.xi_contact


def replayed(walker: Walker, log: RobotLog, filter_time: float, window: float) -> ReplaySignals:
    """Replay a log through the walker's controller, whose sample instants are the log's rows.

    filter_time [s]: of the low-pass of rates from differences. window [s]: time after a touchdown that counts
    as contact. Raises NotFiniteError for a controller or an observer that diverges on the log.
    """
    law, calls, rows = walker.law, walker.calls, []
    s = np.zeros(0)
    for k, (m, after) in enumerate(measurements(walker, log, filter_time)):
        if k == 0:
            s = law.initial_state(m)
        elif after is not None:
            s = calls.jump(s, after, walker.swap)
        expected = calls.estimate(s, m)
        s = calls.correct(s, m)
        u = walker.saturate(calls.output(s, m))
        result, terms = calls.estimate(s, m), m.terms
        xi = np.full(len(terms.xi), np.nan) if result is None else result.disturbance
        beyond = terms.kappa_inverse @ (xi - terms.xi)
        residual = m.q_b - expected.position if expected is not None else np.full(len(xi), np.nan)
        rows.append((m.t_step, m.v, u, residual, xi, terms.xi, beyond))
        s = calls.predict(s, m, log.u[k])
    t_step, v, torque, residual, xi, nominal, beyond = (
        np.array(x) for x in zip(*rows, strict=True)
    )
    late = (log.step > log.step[0]) & (t_step < window)
    inputs = log.t, log.step, t_step, log.q, v, log.u
    return ReplaySignals(*inputs, torque, residual, xi, nominal, beyond, late.astype(float))


def measurements(
    walker: Walker, log: RobotLog, filter_time: float
) -> Iterator[tuple[Measurement, Measurement | None]]:
    """Iterate over the controller's measurements, one for each row; at a touchdown also
    the one its state jumps to.

    At all other rows the second is None.
    """
    n, p, period = walker.plant.n, walker.plant.p, log.period
    sensors = Sensors(velocity="differences", filter_time=filter_time).sampled(n, p, period)
    sensors = replace(sensors, differences=(~log.has_rate).astype(int))
    q, v = log.q, log.rates
    start = np.where(log.has_rate, v[0], (q[1] - q[0]) / (log.t[1] - log.t[0]))
    w, mode = sensors.start(q[0], start), Mode(int(log.step[0]), float(log.t[0]))
    for i, t in enumerate(log.t.tolist()):
        after = None
        if log.step[i] != mode.step:
            mode = Mode(int(log.step[i]), t)
            expected = walker.nominal.impact(*sensors.reading(w, q[i], v[i])).v
            w = sensors.impact(w, q[i], v[i], expected)
            after = walker.measure(t, *sensors.reading(w, q[i], v[i]), mode)
        w = sensors.sense(w, q[i], v[i])
        yield walker.measure(t, *sensors.reading(w, q[i], v[i]), mode), after
