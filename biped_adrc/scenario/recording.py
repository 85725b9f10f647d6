"""A finished walk: trajectory, walker and gait, with signals, plots, animation, certificates and files at hand.

The simulation stores states only. Everything else (references, torques, estimates, forces) is computed from
them by the pure functions of the closed loop when it is first asked for, so a walk has all signals without
having recorded any; those of a stored walk are in its file.

`walk`, `walk_scenario` and `stored.load_walk` return a `Walk`; the command line, notebooks, studies and the
reproduction of the paper read it.

    walk.signals         arrays over time: q, v, u, errors, estimates, ground reaction
    walk.certificates    per step: friction, torque, clearance, energy
    walk.soft_steps      per step on soft ground: slip, flight, double support, penetration
    walk.feasibility     could ground and motors have carried it? until_infeasible cuts it where not
    walk.touchdowns      when the controller noticed each touchdown, if it has to notice them itself
    walk.remarks         sentences on what was not as it was asked for
    walk.rounding()      does rounding decide its numbers?
    walk.plot, animate   figures and pictures
    walk.save, export    .npz to read it again, .mat for MATLAB

A node is an instant whose state is stored, an arc the motion of one single support. A walk is cut if only its
beginning is kept (`until_infeasible`). q (n,) [rad] are coordinates, v = q' their rates, q_b the p coordinates
that have motors, q_d the reference of q_b [rad], u (p,) [N m] the motors' torques; F_T and F_N [N] are the
force of the ground along it and out of it.
"""

from __future__ import annotations

import json
import tempfile
import webbrowser
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import ArrayLike

from biped_adrc.analysis.certificate import Certificate, after_last_impact, certificates, supports
from biped_adrc.analysis.feasibility import Feasibility, until_infeasible
from biped_adrc.analysis.ground_force import Nodes
from biped_adrc.analysis.signals import PLACE, Signals, recorded, signals
from biped_adrc.analysis.soft_steps import SoftStep, recorded_steps, slip_times
from biped_adrc.analysis.statistics import rms
from biped_adrc.analysis.touchdowns import Detections, touchdowns
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Walker
from biped_adrc.control.outer_loop import own_reference
from biped_adrc.core.errors import InputError, optional
from biped_adrc.core.files import joint_columns, write_csv
from biped_adrc.core.shown import Frozen, Shown
from biped_adrc.core.types import Array
from biped_adrc.core.versions import versions
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.reference import TimeReference
from biped_adrc.hybrid import storage
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.ground import Limits, ground_axes
from biped_adrc.scenario.edges import remarks
from biped_adrc.scenario.integration import WalkPart, rounding
from biped_adrc.scenario.plain_parts import Writer
from biped_adrc.scenario.scenario import Scenario

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

_OF_JOINTS = {
    "q": "q{} [rad]",
    "v": "v{} [rad/s]",
    "u": "u{} [N m]",
    "q_d": "q_d{} [rad]",
    "dq_d": "v_d{} [rad/s]",
    "error": "error{} [rad]",
}
"""Signals that have several columns in the table of a walk, and the names of these columns by number."""


@dataclass(frozen=True)
class Outcome(Frozen):
    """The numbers that are kept of a scenario's walk: small enough to be sent back by a worker process.

    A walk itself holds megabytes of states; the reproduction of the paper compares outcomes.
    """

    run: Scenario
    """The scenario that was walked."""
    status: str
    """Name of the trajectory's status, "COMPLETED" for a walk of all impacts asked for."""
    impacts: int
    """Number of impacts made."""
    x_minus: Array
    """States just before each impact (impacts, states): q [rad], q' [rad/s], then the controller's states."""
    durations: Array
    """Durations of the finished single supports (impacts,) [s]."""
    peak_error: float
    """max |q_b - q_d| [rad] up to a fall, also between the nodes of the method; 0 where no joint is driven."""
    rms_error: float
    """Root of the mean over time and joints of (q_b - q_d)^2 [rad] up to a fall; 0 where no joint is driven."""
    peak_torque: float
    """max |u_i| [N m]; 0 without motors."""
    certificates: tuple[Certificate, ...]
    """What each finished walking step would have asked of ground and motors."""
    feasibility: Feasibility
    """Whether ground and motors could have carried the walk, within the limits of the robot's record."""
    method: str
    """Integration method, with its integration step [s]."""
    engine: str
    """The engine that ran, "compiled" or "pinocchio"; "unknown" for a run that does not say."""
    half: Outcome | None = None
    """The same run with every integration step half as long: the difference of the two estimates the error of
    integration in every number here, since halving the step makes RK4's error 16 times smaller. Its own half is
    None."""

    @property
    def walked(self) -> bool:
        """True where all impacts asked for were made."""
        return self.status == "COMPLETED"


@dataclass(frozen=True)
class Walk(Shown):
    """A finished walk: the walker, the gait it was to follow, the trajectory, and the scenario that asked for
    it.

    >>> walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, impacts=2)
    >>> walk.impacts, walk.signals.u.shape[1]
    (2, 4)
    """

    walker: Walker
    """The walker, with plant, controller and all the rest."""
    gait: Gait | None
    """The gait it was to follow; None for a robot without motors, and for a walk from a state alone."""
    trajectory: Trajectory
    """States over time, impacts, and the status with which the walk ended."""
    scenario: Scenario | None = None
    """The scenario that asked for it; None for a walker made in Python."""
    recorded: Signals | None = None
    """Signals from the file of a stored walk."""
    stored_remarks: tuple[str, ...] = ()
    """Remarks that came with it, as from a file."""
    parts: tuple[WalkPart, ...] = ()
    """The integration methods of its parts, on the rigid plant; empty for a walk from a file, or one that is
    cut."""

    def __repr__(self) -> str:
        run = self.trajectory
        duration = f"{run.t_end - run.t_start:.4g} s"
        first, *more = self.remarks or ("",)
        remark = first and f"; {first}" + (f" (and {len(more)} more in remarks)" if more else "")
        return f"Walk({self.note}: {self.impacts_text} in {duration}, {run.status.name}{remark})"

    @property
    def note(self) -> str:
        """One line on what walked: controller, gait, robot and preset; without motors robot and slope [rad]."""
        plant, gait = self.walker.plant, self.gait
        robot = f"{plant.description.name} {plant.preset}"
        if plant.p == 0:
            return f"{robot} without motors, slope {self.walker.ground_slope:g} rad"
        begun = "from a state" if gait is None else f"on gait '{gait.name}'"
        return f"{self.controller_name} {begun}, {robot}"

    @cached_property
    def signals(self) -> Signals:
        """References, errors, torques, estimates and forces over time, computed at the first call and kept.

        Errors are from the gait's curve, or without a gait from the controller's own reference.
        """
        if self.recorded is not None:
            return self.recorded
        # a robot without motors has no gait and no reference: it gets one of no joints, of arrays (0,)
        curve = own_reference(self.walker.controller) if self.gait is None else self.gait.constraint
        no_joints = TimeReference(lambda t: (np.zeros(0), np.zeros(0), np.zeros(0)))
        return signals(self.walker, self.trajectory, no_joints if curve is None else curve)

    @cached_property
    def certificates(self) -> tuple[Certificate, ...]:
        """A certificate of each finished walking step: friction, torque, clearance and energy that it needs of
        ground and motors; empty on soft ground.
        """
        return self.certified()

    @property
    def impacts(self) -> int:
        """How many impacts were made."""
        return len(self.trajectory.events(FOOT_STRIKE))

    @property
    def impacts_text(self) -> str:
        """The number of impacts in words: "1 impact"."""
        return f"{self.impacts} impact{'' if self.impacts == 1 else 's'}"

    @property
    def peak_torque(self) -> float:
        """max |u_i| [N m]; 0 without motors."""
        return float(np.max(np.abs(self.signals.u), initial=0.0))

    @property
    def soft(self) -> bool:
        """Whether the walk ran on a plant of its own such as MuJoCo's, with soft contact, in which a double
        support takes time; only such a run records a "plant".
        """
        return "plant" in self.trajectory.settings

    @cached_property
    def soft_steps(self) -> tuple[SoftStep, ...]:
        """Slip, flight, double support and penetration of each single support, read at the sample instants.

        Empty for a walk on the rigid plant, and on one that does not say what its feet do.
        """
        ground = self._soft_ground()
        return () if ground is None else recorded_steps(self.trajectory, *ground)

    def _soft_ground(self) -> tuple[float, tuple[Array, Array]] | None:
        """Friction [1] of the soft ground, and its axes: unit vectors (x, z) along it and out of it, each (2,).
        None for a run that did not record what its feet do on such ground.
        """
        run = self.trajectory
        ground = run.settings.get("plant", {}).get("ground")
        # PLACE: name under which a plant records the places of the feet
        if ground is None or recorded(run, PLACE) is None:
            return None
        return ground["friction"], ground_axes(self.walker.ground_slope)

    def certified(self, limits: Limits | None = None) -> tuple[Certificate, ...]:
        """The certificates for other limits; None: those of the robot's record.

        A walk on soft ground has none: what an impact in no time would need does not apply there.
        """
        if self.soft:
            return ()
        return certificates(self.walker, self.trajectory, self.signals, limits)

    @cached_property
    def feasibility(self) -> Feasibility:
        """Whether ground and motors could have carried this walk within the limits of the robot's record."""
        return self.feasible_within(Limits())

    def feasible_within(self, limits: Limits) -> Feasibility:
        """Judge the walk as `feasibility` does, within other limits, whose None are the values of the robot's
        record; the unfinished last walking step counts too.
        """
        # k: the limits as numbers; after: momentum after the last impact [N s], if the walk ends with one
        run, slips, k = self.trajectory, None, limits.of(self.walker.plant.description)
        impacts, after = self.impacts, after_last_impact(self.walker, run)
        # a plant that does not say what its feet did has no soft steps: no slip is known, and 0 stands for it.
        # slips: the larger slip of both feet [m] in each single support, judged in place of friction
        if self.soft:
            slips = [max(step.slip) for step in self.soft_steps] or [0.0] * len(run.arcs)
        judged = supports(self.walker, Nodes.of(self.signals), k, impacts, after, slips)
        return Feasibility(run.status, judged, impacts)

    @cached_property
    def touchdowns(self) -> Detections:
        """When the controller noticed each touchdown. Raises InputError for a walker without a detector, whose
        controller knows each touchdown at once.
        """
        return touchdowns(self.walker, self.trajectory)

    @cached_property
    def outcome(self) -> Outcome:
        """The numbers of a scenario's walk that a worker process sends back.

        The mean of squared errors is over time, by quadrature between nodes. Raises InputError for a walk that
        is not of a scenario.
        """
        if self.scenario is None:
            raise InputError("an outcome is of a scenario's walk; take signals, or walk_scenario")
        # before_fall: without the nodes of a fall, in which no tracking error is defined
        run, s = self.trajectory, self.signals.before_fall
        # the walk of a scenario begins at t = 0; run.before: the states just before the impacts
        times = np.array([0.0, *(event.t for event in run.events(FOOT_STRIKE))])
        return Outcome(
            self.scenario,
            run.status.name,
            self.impacts,
            run.before(FOOT_STRIKE),
            np.diff(times),
            s.peak_error,
            rms(s.t, s.error),
            self.peak_torque,
            self.certificates,
            self.feasibility,
            str(run.settings["method"]),
            str(run.settings.get("engine", "unknown")),
        )

    def until_infeasible(self, limits: Limits | None = None) -> Self:
        """The walk up to the first instant at which ground or motors could not have carried it.

        Its status is then INFEASIBLE and its detail says which limit, when, and by how much; without such an
        instant it is the walk itself. limits None: those of the robot's record.
        """
        # ground: (friction, its two axes), None on the rigid plant
        run, ground = self.trajectory, self._soft_ground()
        # on soft ground the time [s] in each single support at which a foot has slipped too far
        slipped = None if ground is None else slip_times(run, *ground)
        cut = until_infeasible(self.walker, run, self.signals, limits, slipped)
        if cut is run:
            return self
        # signals that came from a file are cut to these nodes; others are computed anew
        count = sum(len(arc.t) for arc in cut.arcs)
        kept = {name: x[:count] for name, x in vars(self.signals).items()}
        # recorded is None unless the signals came from a file; a cut walk has no parts to be walked again
        return replace(self, trajectory=cut, recorded=self.recorded and Signals(**kept), parts=())

    @cached_property
    def remarks(self) -> tuple[str, ...]:
        """Sentences to know before using its numbers, those of `edges.remarks`, each once; of a stored walk
        those of its file. `ba.walk` raises a Python warning for each.
        """
        if self.recorded is not None:
            return self.stored_remarks
        return tuple(dict.fromkeys(remarks(self.walker, self.gait, self.trajectory)))

    def rounding(self) -> float:
        """Largest difference of angles [rad] and times [s], at impacts and the end, to the same walk from a
        start that is 1e-12 off: above 1e-7 rounding decides its numbers. Raises InputError without `parts`.
        """
        return rounding(self.walker, self.trajectory, self.parts)

    @property
    def controller_name(self) -> str:
        """Name of the controller in the scenario; of a walk without scenario or gait that of the controller's
        class, without its module and without "Controller" at its end.
        """
        if self.scenario is not None and self.gait is not None:
            return self.scenario.controller.name.rpartition(":")[2]
        law = self.walker.controller
        # in a walk from a file a stand-in for a class of the user's has the name of that class in `home`
        name: str = getattr(law, "home", type(law).__name__)
        return name.rpartition(":")[2].removesuffix("Controller")

    def plot(self, title: str = "", push: tuple[float, float] | None = None) -> Figure:
        """References against joint angles, and torques, as figures 4 and 5 of the paper; for a robot without
        motors angles, energies and the phase portrait. push: (begin, end) [s] that is marked.
        """
        from biped_adrc.view.plots.figures import walk_figure

        return walk_figure(self, title, push)

    def animate(self, path: Path | str, view: str = "side") -> None:
        """Write the walk by the suffix of `path`: an offline page (.html), a picture (.gif) or a strip (.png).

        view: "side" (orthographic) or "perspective", of the page. Raises InputError and OutputError.
        """
        from biped_adrc.view.export import export
        from biped_adrc.view.placement import Clip

        export(Path(path), {self.controller_name: self}, Clip(view=view))

    def show(self) -> None:
        """Open the animation in the browser: a page in the temporary folder, with no server behind it."""
        path = Path(tempfile.mkdtemp(prefix="biped-adrc-")) / "walk.html"
        self.animate(path)
        if not webbrowser.open(path.as_uri()):
            print(f"no browser could be opened here: open {path} in one")

    def save(self, path: Path | str, settings: Mapping[str, object] | None = None) -> Path:
        """Write the run (.npz) with robot, gait, controller and torques inside; `load_walk` reads it anywhere.

        settings: more plain values for the file, beside versions, remarks and scenario. Returns the path, with
        .npz at its end. Raises InputError and OutputError.
        """
        writer = Writer()
        # number of the walker's record in `writer.records`; and the gait as a value, None for none
        walker, gait = writer.part(self.walker), writer.plain(self.gait)
        record = {"parts": writer.records, "walker": walker, "gait": gait}
        about: dict[str, object] = {"versions": versions(), "remarks": list(self.remarks)}
        # a name for each number of x
        about["states"] = list(self.walker.layout_of(self.trajectory.arcs[0].x[0]).names())
        if self.scenario is not None:
            about["scenario"] = self.scenario.record()
        arrays: dict[str, ArrayLike] = {"walker": json.dumps(record)}
        arrays |= {f"signal.{k}": x for k, x in vars(self.signals).items()}
        return storage.save(self.trajectory, path, {**about, **(settings or {})}, arrays)

    def _columns(self) -> dict[str, Any]:
        """Columns (K,) of the table of `to_csv`, for K nodes, by name with unit; `step` is the number of the
        single support.
        """
        s, events = self.signals, list[str]()
        # of each arc only the last node lies before an event
        for arc in self.trajectory.arcs:
            events += [""] * (len(arc.t) - 1) + ["" if arc.event is None else arc.event.guard]
        columns = {"t [s]": s.t, "step": s.step.astype(int), "event": events}
        along_and_out = np.array(ground_axes(self.walker.ground_slope)) @ s.ground_reaction.T
        forces = dict(zip(("F_T [N]", "F_N [N]"), along_and_out, strict=True))
        # _OF_JOINTS: the signals with a column for each joint or coordinate
        return columns | joint_columns(s, _OF_JOINTS) | forces

    def to_csv(self, path: Path | str) -> Path:
        """Write a table (.csv) with a row for each node; returns its path. Raises InputError and OutputError.

            t [s], step, event, q1 [rad] .. qN, v1 [rad/s] .., u1 [N m] .. up, q_d1 [rad] .. qp,
            v_d1 [rad/s] .., error1 [rad] .., F_T [N], F_N [N]

        event names the impact or the end that a node lies just before, and is empty elsewhere; an impact
        repeats its time, before and after it.
        """
        return write_csv(self._columns(), path)

    def to_pandas(self) -> pandas.DataFrame:
        """The table of `to_csv` as a DataFrame. Raises InputError without pandas, of the extra `study`."""
        with optional("study", "pandas is not installed", ", or use walk.to_csv(path)"):
            import pandas
        frame = pandas.DataFrame(self._columns())
        frame.attrs["note"] = self.note
        return frame

    def export(self, path: Path | str) -> None:
        """Write the table of `to_csv` (.csv), or all signals for MATLAB (.mat), one array per name.

        Raises InputError and OutputError.
        """
        if Path(path).suffix.lower() == ".csv":
            self.to_csv(path)
            return
        from biped_adrc.gait.exchange.importing import export_run

        export_run(vars(self.signals), path, note=self.note)

    def _repr_html_(self) -> str:
        """What a notebook shows: status and remarks, the animation and the figure of `plot`."""
        from biped_adrc.view.meshcat.view import animation_html
        from biped_adrc.view.pages import inline

        status = self.trajectory.status
        summary = f"{self.controller_name}: {self.impacts_text}. {status.name}: {status.value}"
        summary = " ".join((summary, *(f"Note: {remark}." for remark in self.remarks)))
        return inline(summary, animation_html({self.controller_name: self}), [self.plot()])
