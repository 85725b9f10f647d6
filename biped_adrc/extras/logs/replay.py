"""Replay of a log: the controller of a scenario, with its observer, gets the measurements of a robot's log.

Results are its signals, a table by single support, files and a figure. Numbers such as (7) are equations of the
paper.

    result = replay("log.csv", Scenario({"name": "LESO", "observer": {"bandwidth": 160.0}}))
    result.signals     xi^, its parts, residuals and torques over time
    result.rows        their rms and extreme values in each single support
    result.plot()      the signals as a figure

Of the scenario these values are used: robot, gait, controller, observer, period, torque limit, filter_time.
Pushes, errors of the model and ground are ignored, as the log was measured on the real robot.

    q_b, u                  angles (p,) [rad] of the actuated joints, and their torques (p,) [N m]
    kappa                   input matrix (p, p) of the nominal model [1/(kg m^2)]: q_b'' = xi + kappa u
    xi, xi^                 total disturbance (p,) [rad/s^2], and its estimate by the observer
    xi_nominal              the part of xi that the nominal model explains (14) [rad/s^2]
    y = q_b, y^ = x1^       measured angles, and the observer's estimate of them [rad]
    s, m                    the controller's state, observer included; a measurement, with the model's terms

At row k, with measurement m_k, the steps are those of every sample instant (`closed_loop.semantics.tick`), but
the log's torque u_k [N m] acts in place of the controller's own:

    a touchdown:   s <- jump(s, m+), m+ with the angles of row k and the rates just after the nominal impact (7)
    y_k - y^_k     the observer's error [rad], before s is corrected by row k
    s <- correct(s, m_k),   xi^_k = estimate(s),   output(s, m_k) is the torque that it would have commanded
    s <- predict(s, m_k, u_k)                      u_k is the torque that acted

xi^ - xi_nominal [rad/s^2] is the part of the estimate that the nominal model does not explain; kappa^-1 times
it is a torque on the joints [N m]. Less than `window` [s] after a touchdown it counts as contact, at other
times as error of the model and torques from outside.

Rates that the log does not have are differences of its angles behind the low-pass of `hardware.sensors`; at a
touchdown the nominal impact (7) resets them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.base import Measurement
from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import InputError, check_positive
from biped_adrc.core.files import joint_columns, write_csv
from biped_adrc.core.shown import Frozen, Shown, columns
from biped_adrc.core.types import Array, Flags
from biped_adrc.extras.logs.log_file import check_reading, read_log
from biped_adrc.extras.logs.robot_log import RobotLog
from biped_adrc.hardware.sensors import Sensors
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.scenario import Scenario

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class ReplaySignals(Frozen):
    """Signals of a replay: K rows as in the log, n coordinates, p joints, named by stance and swing leg.

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
    """(K, n) [rad/s], from the log or, where it has none, from differences of its angles."""
    u: Array
    """(K, p) [N m], from the log."""
    torque: Array
    """(K, p) torque of the replayed controller, within the torque limit [N m]."""
    residual: Array
    """(K, p) q_b - x1^ [rad], measured minus estimated joint angles, before the correction by this row; 0 for
    observers that estimate no angles."""
    xi_estimate: Array
    """(K, p) xi^ [rad/s^2] after the correction by this row."""
    xi_nominal: Array
    """(K, p) xi of the nominal model (14) [rad/s^2]."""
    zeta_estimate: Array
    """(K, p) kappa^-1 (xi^ - xi_nominal): the joint torque beyond the nominal model [N m]."""
    in_contact: Array
    """(K,), 1 within the window after a touchdown, else 0."""

    @property
    def xi_contact(self) -> Array:
        """(K, p) xi^ - xi_nominal [rad/s^2] within the window after a touchdown, else 0."""
        return (self.xi_estimate - self.xi_nominal) * self.in_contact[:, np.newaxis]

    @property
    def xi_model_error(self) -> Array:
        """(K, p) xi^ - xi_nominal [rad/s^2] outside of the window after a touchdown, in it 0.

        Besides errors of the model it has the torques from outside.
        """
        return self.xi_estimate - self.xi_nominal - self.xi_contact


def replayed(walker: Walker, log: RobotLog, filter_time: float, window: float) -> ReplaySignals:
    """Replay a log through the walker's controller, whose sample instants are the log's rows.

    filter_time [s]: time constant of the low-pass of rates from differences. window [s]: time after a touchdown
    that counts as contact. Raises NotFiniteError for a controller or an observer that diverges on the log.
    """
    # law: the controller; calls: its methods for sample instants, with checks; estimate gives None without an
    # observer; after: the measurement just after a touchdown, None at other rows
    law, calls, rows = walker.law, walker.calls, []
    s = np.zeros(0)
    for k, (m, after) in enumerate(measurements(walker, log, filter_time)):
        if k == 0:
            s = law.initial_state(m)
        elif after is not None:
            s = calls.jump(s, after, walker.plant.swap)
        # expected: position x1^ and disturbance xi^ of the observer before the correction by this row
        expected = calls.estimate(s, m)
        s = calls.correct(s, m)
        u = walker.saturate(calls.output(s, m))
        # terms: kappa and xi of the nominal model; xi: the estimate xi^
        result, terms = calls.estimate(s, m), m.terms
        xi = np.full(len(terms.xi), np.nan) if result is None else result.disturbance
        beyond = terms.kappa_inverse @ (xi - terms.xi)
        residual = m.q_b - expected.position if expected is not None else np.full(len(xi), np.nan)
        rows.append((m.t_step, m.v, u, residual, xi, terms.xi, beyond))
        s = calls.predict(s, m, log.u[k])
    arrays = (np.array(x) for x in zip(*rows, strict=True))
    t_step, v, torque, residual, xi, nominal, beyond = arrays
    # t_step of the first single support counts from the first row, where there was no touchdown
    in_contact = (log.step > log.step[0]) & (t_step < window)
    inputs = log.t, log.step, t_step, log.q, v, log.u
    return ReplaySignals(*inputs, torque, residual, xi, nominal, beyond, in_contact.astype(float))


def measurements(
    walker: Walker, log: RobotLog, filter_time: float
) -> Iterator[tuple[Measurement, Measurement | None]]:
    """Iterate over the rows of a log: the controller's measurement, and at a touchdown also the one with which
    its state jumps, else None.

    filter_time [s]: time constant of the low-pass of rates that the log does not have.
    """
    # w: state of the sensors, which compute the missing rates; at the start they are the first difference
    n, p, period = walker.plant.n, walker.plant.p, log.period
    sensors = Sensors(velocity="differences", filter_time=filter_time).sampled(n, p, period)
    # 1 for each rate that has to be computed
    sensors = replace(sensors, differences=(~log.has_rate).astype(int))
    q, v = log.q, log.rates
    start = np.where(log.has_rate, v[0], (q[1] - q[0]) / (log.t[1] - log.t[0]))
    w, mode = sensors.start(q[0], start), Mode(int(log.step[0]), float(log.t[0]))
    for i, t in enumerate(log.t.tolist()):
        after = None
        if log.step[i] != mode.step:
            mode = Mode(int(log.step[i]), t)
            # expected: rates just after the nominal impact from the row before, which the sensors still hold;
            # they count where the log has no rates. after: the measurement with them
            expected = walker.nominal.impact(*sensors.reading(w, q[i], v[i])).v
            w = sensors.impact(w, q[i], v[i], expected)
            after = walker.measure(t, *sensors.reading(w, q[i], v[i]), mode)
        w = sensors.sense(w, q[i], v[i])
        yield walker.measure(t, *sensors.reading(w, q[i], v[i]), mode), after


_WINDOW = 0.02
"""Time after a touchdown that counts as contact [s]; on MuJoCo's ground of 2 ms forces have settled by then."""
_COLUMNS = {
    "torque": "u asked {} [N m]",
    "u": "u {} [N m]",
    "residual": "residual {} [rad]",
    "xi_estimate": "xi estimate {} [rad/s^2]",
    "xi_nominal": "xi nominal {} [rad/s^2]",
    "xi_model_error": "xi model error {} [rad/s^2]",
    "xi_contact": "xi contact {} [rad/s^2]",
    "zeta_estimate": "zeta estimate {} [N m]",
}
"""Signal -> heading in the table of `Replay.to_csv`, with a column for each joint."""


class ReplayRow(NamedTuple):
    """Numbers of one single support; each is that of the joint for which it is largest. Numbers from estimates
    are NaN without an observer.
    """

    step: int
    """Number of the single support."""
    samples: int
    """Number of rows of the log."""
    beyond: float
    """rms of the estimated torque beyond the nominal model outside the window of contact [N m]."""
    contact: float
    """Largest such torque within that window [N m]; 0 without one."""
    residual: float
    """rms of q_b - x1^ [rad]."""
    apart: float
    """rms of the torque of the replayed controller minus that of the log [N m]."""
    most_apart: float
    """Largest |difference| of these torques [N m]."""


_NUMBERS = "beyond model [N m]", "in contact [N m]", "residual [rad]", "u apart [N m]", "peak [N m]"
HEADER = ("step", "samples", *_NUMBERS)
"""Names of the columns of a `ReplayRow`."""


@dataclass(frozen=True)
class Replay(Shown):
    """The result of `replay`: the signals of a controller and its observer on the measurements of a log."""

    scenario: Scenario
    log: RobotLog
    """The log as it was replayed, resampled where that was necessary."""
    signals: ReplaySignals
    window: float
    """Time after a touchdown that counts as contact [s]."""

    @property
    def remarks(self) -> tuple[str, ...]:
        """Sentences on columns that were converted or ignored, on a log that does not fit the model, and on
        resampling.
        """
        return self.log.remarks

    @cached_property
    def rows(self) -> tuple[ReplayRow, ...]:
        """Rows of the replay's table, a `ReplayRow` for each single support."""
        x = self.signals
        return tuple(_row(x, x.step == step) for step in np.unique(x.step))

    def text(self) -> str:
        """The rows as a table of text."""
        return "\n".join(columns([HEADER, *(cells(row) for row in self.rows)]))

    def plot(self) -> Figure:
        """Draw the replayed log over time in three panels, a line for each joint; lines break at touchdowns.

        Panels: the joint torque beyond the nominal model, kappa^-1 (xi^ - xi_nominal) [N m]; the residual
        q_b - x1^ [mrad]; the torque of the controller over the one in the log [N m]. The window of contact
        after each touchdown is shaded.
        """
        from biped_adrc.view.plots.over_time import curves, finished, line, say_no_observer
        from biped_adrc.view.style import GREY, new_figure

        x = self.signals
        look: Any = {"color": GREY, "alpha": 0.2, "lw": 0.0, "label": "contact"}
        with new_figure(8.0, 7.0, self.scenario.controller.name) as figure:
            beyond, residual, torque = figure.subplots(3, 1, sharex=True)
            for k, u in enumerate(x.u.T):
                line(torque, x, u, k, "_" if k else "in the log", color=GREY, lw=0.8, ls=":")
            for axes, values, symbol, unit in (
                (beyond, x.zeta_estimate, r"\hat\zeta", "beyond the model [N m]"),
                (residual, 1e3 * x.residual, "q", "residual [mrad]"),
                (torque, x.torque, "u", "torque asked for [N m]"),
            ):
                if np.isnan(values).all():
                    say_no_observer(axes)
                else:
                    curves(axes, x, values, symbol)
                # over the height of the panel, 0 to 1, at the times of the walk
                across = axes.get_xaxis_transform()
                axes.fill_between(x.t, 0.0, 1.0, x.in_contact > 0.5, transform=across, **look)
                finished(axes, unit)
                axes.label_outer()
            return figure

    def to_csv(self, path: Path | str) -> Path:
        """Write the signals as a table (.csv), a row for each sample; returns the path.

        Raises InputError for another suffix, and OutputError.
        """
        x = self.signals
        # _COLUMNS: signal -> heading, with a column for each joint
        table = {"t [s]": x.t, "step": x.step.astype(int), "in contact": x.in_contact.astype(int)}
        return write_csv(table | joint_columns(x, _COLUMNS), path)


def cells(row: ReplayRow) -> tuple[str, ...]:
    """Texts of a row for the columns of HEADER; a dash for NaN, where there is no observer."""
    numbers = ("-" if np.isnan(x) else f"{x:.3g}" for x in row[2:])
    return (f"{row.step}", f"{row.samples}", *numbers)


def replay(
    log: RobotLog | Path | str,
    scenario: Scenario,
    window: float = _WINDOW,
    filter_time: float | None = None,
) -> Replay:
    """Replay a log, or the CSV file of one, through the controller of a scenario.

    log: itself, or the path of its file. scenario: with the controller and its period. The period is that of
    the scenario, or the log's where the scenario has none; a log with another period, or an uneven one, is
    resampled, and the remarks say so. window [s]: time after a touchdown that counts as contact.
    filter_time [s]: time constant of the low-pass of rates that the log does not have; the scenario's if None.
    Raises InputError for a log or a scenario that cannot be used, and for a log that fits the model better with
    other signs, units or legs (`check_reading`).

    >>> from biped_adrc.extras.logs.robot_log import logged
    >>> walk = ba.walk_scenario(ba.Scenario("NPD", hardware="ideal", run={"impacts": 2}))
    >>> replay = ba.replay(logged(walk), ba.Scenario({"name": "DOB", "observer": {"bandwidth": 200.0}}))
    >>> replay.signals.zeta_estimate.shape[1]
    4
    """
    check_part(log, "the log", RobotLog, Path, str)
    check_part(scenario, "what is to see the log", Scenario)
    check_positive(window, f"the window of contact is {window} s")
    filter_time = scenario.hardware.encoders.filter_time if filter_time is None else filter_time
    scene = RobotAndGait.of(scenario)
    scene.walked  # noqa: B018  # a robot without motors is refused
    result = log if isinstance(log, RobotLog) else read_log(log, scene.biped)
    has, wants = (result.q.shape[1], result.u.shape[1]), (scene.biped.n, scene.biped.p)
    if has != wants:
        raise InputError(
            f"the log has {has[0]} angles and {has[1]} torques, expected {wants[0]} and {wants[1]} of robot "
            f"'{scenario.robot.name}'"
        )
    result = replace(result, remarks=(*result.remarks, *check_reading(result, scene.biped)))
    period = scenario.hardware.period or result.period
    if not result.even(period):
        result = result.resampled(period)
    scenario = scenario.replace(hardware={"period": period})
    walker = build(scenario, scene)
    with np.errstate(over="ignore", invalid="ignore"):  # what overflows is refused
        signals = replayed(walker, result, filter_time, window)
    return Replay(scenario, result, signals, window)


def _row(x: ReplaySignals, rows: Flags) -> ReplayRow:
    """The `ReplayRow` of the single support whose samples are `rows` (K,), a mask."""
    contact = rows & (x.in_contact > 0.5)
    outside, apart = x.zeta_estimate[rows & ~contact], (x.torque - x.u)[rows]
    # number of the single support, of its samples; torque beyond the model, rms outside contact and largest in
    # it; rms of the residual; rms and largest difference of the controller's torque from that of the log
    return ReplayRow(
        int(x.step[rows][0]),
        int(np.count_nonzero(rows)),
        _rms(outside),
        float(np.max(np.abs(x.zeta_estimate[contact]), initial=0.0)),
        _rms(x.residual[rows]),
        _rms(apart),
        float(np.max(np.abs(apart))),
    )


def _rms(x: Array) -> float:
    """Root mean square over the rows of x (K, p), of the column where it is largest; 0 without rows."""
    return float(np.max(np.sqrt(np.mean(x**2, axis=0)))) if len(x) else 0.0
