"""What a walker did, with its signals, pictures and certificates at hand."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np

from biped_adrc.analysis.certificate import Certificate, certificates, supports
from biped_adrc.analysis.legality import Legality
from biped_adrc.analysis.signals import Signals, signals
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.limits import Limits
from biped_adrc.studies.edges import edge_remarks, step_remarks
from biped_adrc.walker import FOOT_STRIKE, Walker

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Recording(ABC):
    """A walker and its trajectory; what they were asked for is said by those who implement it."""

    walker: Walker
    trajectory: Trajectory

    @property
    @abstractmethod
    def reference(self) -> Reference:
        """What the actuated joints were to follow."""

    @property
    @abstractmethod
    def note(self) -> str:
        """One line that says what this is a walk of."""

    @cached_property
    def signals(self) -> Signals:
        """References, errors, torques, estimates and forces over time."""
        return signals(self.walker, self.trajectory, self.reference)

    @cached_property
    def certificates(self) -> tuple[Certificate, ...]:
        """What each step would have asked of a real robot on dry ground."""
        return self.certified()

    def certified(self, limits: Limits | None = None) -> tuple[Certificate, ...]:
        """The certificates within other limits, or with the force averaged over another window."""
        return certificates(self.walker, self.trajectory, self.signals, limits)

    @cached_property
    def legality(self) -> Legality:
        """Whether ground and motors could have carried this walk, within the limits of the robot's record."""
        return self.legal_within(Limits())

    def legal_within(self, limits: Limits) -> Legality:
        """`legality` within other limits."""
        finished = self.certificates if limits == Limits() else self.certified(limits)
        rest = replace(self.trajectory, arcs=self.trajectory.arcs[len(finished) :])
        return Legality(
            self.trajectory.status,
            (*finished, *supports(self.walker, rest, self.signals, limits)),
            float(np.max([c.impulse_ratio for c in finished], initial=0.0)),
            limits.of(self.walker.plant.description),
        )

    @property
    def remarks(self) -> tuple[str, ...]:
        """What to know before using its numbers: a push that an impact cut off, too long a step at an edge."""
        walker, trajectory = self.walker, self.trajectory
        return (*edge_remarks(walker, trajectory), *step_remarks(walker, trajectory))

    @property
    def controller_name(self) -> str:
        """Name of the controller's class without "Controller"."""
        return type(self.walker.controller).__name__.removesuffix("Controller")

    def plot(self, title: str = "", push: tuple[float, float] | None = None) -> Figure:
        """References against joint angles, and torques, as figures 4 and 5; push is marked [s].

        Of a robot without motors: angles, energies and the phase portrait.
        """
        from biped_adrc.viz.figures import passive_figure, tracking_figure

        if self.walker.plant.p == 0:
            return passive_figure(self.signals, title, push)
        return tracking_figure(self.signals, title, push, self.walker.torque_limit)

    def animate(self, path: Path | str, view: str = "side") -> None:
        """Write the walk by the suffix of `path`: an offline page (.html), a picture (.gif) or a strip (.png).

        view: "side" (orthographic) or "perspective", of the page. Raises InputError and OutputError.
        """
        from biped_adrc.viz.export import Clip, export

        export(Path(path), {self.controller_name: self}, Clip(view=view))

    def export(self, path: Path | str) -> None:
        """Write all signals for MATLAB (.mat), one array per name. Raises InputError and OutputError."""
        from biped_adrc.gait.exchange.runs import export_run

        export_run(vars(self.signals), path, note=self.note)

    def _repr_html_(self) -> str:
        """What a notebook shows: status and remarks, the animation and the figure of `plot`."""
        from biped_adrc.viz.meshcat import animation_html
        from biped_adrc.viz.notebook import inline

        impacts = len(self.trajectory.events(FOOT_STRIKE))
        status = self.trajectory.status
        summary = f"{self.controller_name}: {impacts} impacts. {status.name}: {status.value}"
        summary = " ".join((summary, *(f"Note: {remark}." for remark in self.remarks)))
        return inline(summary, animation_html({self.controller_name: self}), [self.plot()])


class Recorder(Protocol):
    """Makes a recording of a trajectory."""

    def __call__(self, trajectory: Trajectory) -> Recording: ...


@dataclass(frozen=True)
class RecordingViewer:
    """Draws trajectories as the recordings that `record` makes of them."""

    record: Recorder

    def animate(self, trajectory: Trajectory, path: Path | str) -> None:
        """As `Recording.animate`."""
        self.record(trajectory).animate(path)

    def plot(self, trajectory: Trajectory) -> Figure:
        """As `Recording.plot`."""
        return self.record(trajectory).plot()

    def html(self, trajectory: Trajectory) -> str:
        """As a recording in a notebook."""
        return self.record(trajectory)._repr_html_()
