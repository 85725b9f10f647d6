"""Replay of a log through the controller of a scenario: its signals, their table by
single support, files and figure.

    found = replay("log.csv", Scenario({"name": "LESO", "observer": {"bandwidth": 160.0}}))
    found.signals     xi^, its parts, residuals and torques over time
    found.rows        their extremes in each single support
    found.plot()      the same as a figure

Of the scenario robot, gait, controller, observer, period and torque limit matter here, and filter_time;
pushes, errors of the model and ground are ignored, as the log was measured on the real robot.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import InputError, check_positive
from biped_adrc.core.files import joint_columns, write_csv
from biped_adrc.core.shown import Shown, columns
from biped_adrc.core.types import Array
from biped_adrc.extras.logs.log_file import read_log
from biped_adrc.extras.logs.replay_signals import ReplaySignals, replayed
from biped_adrc.extras.logs.robot_log import RobotLog
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.scenario import Scenario

if TYPE_CHECKING:
    from matplotlib.figure import Figure

WINDOW = 0.02
"""Time after a touchdown that counts as contact [s]; on MuJoCo's ground of 2 ms forces have settled by then."""
COLUMNS = {
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
    """Numbers of one single support, each of the joint where it is largest; NaN without an observer."""

    step: int
    """Number of the single support."""
    samples: int
    """Rows of the log."""
    beyond: float
    """rms of the estimated torque beyond the nominal model outside the window of contact [N m]."""
    contact: float
    """Largest such torque within that window [N m]; 0 without one."""
    residual: float
    """rms of q_b - x1^ [rad]."""
    apart: float
    """rms of the controller's torque minus the log's [N m]."""
    most_apart: float
    """Largest difference of the controller's torque and the log's [N m]."""


HEADER = (
    "step",
    "samples",
    "beyond model [N m]",
    "in contact [N m]",
    "residual [rad]",
    "u apart [N m]",
    "peak [N m]",
)
"""Names of the columns of a `ReplayRow`."""


@dataclass(frozen=True)
class Replay(Shown):
    """The signals of a controller and its observer that were given the measurements of a log."""

    scenario: Scenario
    log: RobotLog
    """The log as it was replayed, resampled where that was necessary."""
    signals: ReplaySignals
    window: float
    """Time after a touchdown that counts as contact [s]."""

    @property
    def remarks(self) -> tuple[str, ...]:
        """Sentences on columns that were converted or ignored, and on resampling."""
        return self.log.remarks

    @cached_property
    def rows(self) -> tuple[ReplayRow, ...]:
        """Rows of the replay's table, one for each single support: torques, residual and
        estimate, see `ReplayRow`.
        """
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
        from biped_adrc.view.plots.over_time import broken, curves, finished, without_observer
        from biped_adrc.view.style import GREY, new_figure

        x = self.signals
        with new_figure(8.0, 7.0, self.scenario.controller.name) as figure:
            beyond, residual, torque = figure.subplots(3, 1, sharex=True)
            for k, u in enumerate(x.u.T):
                name = "in the log" if k == 0 else "_"
                torque.plot(broken(x, x.t), broken(x, u), color=GREY, lw=0.8, ls=":", label=name)
            for axes, values, symbol, unit in (
                (beyond, x.zeta_estimate, r"\hat\zeta", "beyond the model [N m]"),
                (residual, 1e3 * x.residual, "q", "residual [mrad]"),
                (torque, x.torque, "u", "torque asked for [N m]"),
            ):
                if np.isnan(values).all():
                    without_observer(axes)
                else:
                    curves(axes, x, values, symbol)
                look: Any = {
                    "transform": axes.get_xaxis_transform(),
                    "color": GREY,
                    "alpha": 0.2,
                    "lw": 0.0,
                }
                axes.fill_between(x.t, 0.0, 1.0, x.in_contact > 0.5, label="contact", **look)
                finished(axes, unit)
            for axes in (beyond, residual):
                axes.set_xlabel("")
            return figure

    def to_csv(self, path: Path | str) -> Path:
        """Write the signals as a table (.csv), a row for each sample; returns the path. Raises
        InputError and OutputError.
        """
        x = self.signals
        table = {"t [s]": x.t, "step": x.step.astype(int), "in contact": x.in_contact.astype(int)}
        return write_csv(table | joint_columns(x, COLUMNS), path)


def cells(row: ReplayRow) -> tuple[str, ...]:
    """Texts of a row, in the columns of HEADER; a dash where there is no observer."""
    numbers = ("-" if np.isnan(x) else f"{x:.3g}" for x in row[2:])
    return (f"{row.step}", f"{row.samples}", *numbers)


def replay(
    log: RobotLog | Path | str,
    scenario: Scenario,
    window: float = WINDOW,
    filter_time: float | None = None,
) -> Replay:
    """Replay a log, or the CSV file of one, through the controller of a scenario.

    The period is that of the scenario, or the log's where the scenario has none; a log with another period, or
    an uneven one, is resampled, and the remarks say so. window [s]: time after a touchdown that counts as
    contact. filter_time [s]: of rates that the log does not have; the scenario's if None. Raises InputError
    for a log or a scenario that cannot be used.

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
    if scene.biped.p == 0:
        raise InputError(
            f"robot '{scenario.robot.name}' has no motors and no controller, expected one with motors"
        )
    result = log if isinstance(log, RobotLog) else read_log(log, scene.biped)
    has, wants = (result.q.shape[1], result.u.shape[1]), (scene.biped.n, scene.biped.p)
    if has != wants:
        raise InputError(
            f"the log has {has[0]} angles and {has[1]} torques, expected {wants[0]} and {wants[1]} of robot "
            f"'{scenario.robot.name}'"
        )
    period = scenario.hardware.period or result.period
    if not result.even(period):
        result = result.resampled(period)
    scenario = scenario.replace(hardware={"period": period})
    walker = build(scenario, scene)
    with np.errstate(over="ignore", invalid="ignore"):  # what overflows is refused
        signals = replayed(walker, result, filter_time, window)
    return Replay(scenario, result, signals, window)


def _row(x: ReplaySignals, rows: NDArray[np.bool_]) -> ReplayRow:
    """Numbers of the single support whose samples are `rows` (K,)."""
    contact = rows & (x.in_contact > 0.5)
    outside, apart = x.zeta_estimate[rows & ~contact], (x.torque - x.u)[rows]
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
