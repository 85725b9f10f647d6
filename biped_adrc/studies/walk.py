"""One walk from a gait's periodic orbit, with its signals, pictures and certificates at hand."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from biped_adrc.analysis.certificate import Certificate, certificates
from biped_adrc.analysis.signals import Signals, signals
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4, OneStepMethod
from biped_adrc.hybrid.simulator import Progress, simulate
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.types import Array
from biped_adrc.walker import FOOT_STRIKE, Mode, Walker

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Walk:
    """A walker, the gait it was asked to follow, and what it did."""

    walker: Walker
    gait: Gait
    trajectory: Trajectory

    @cached_property
    def signals(self) -> Signals:
        """References, errors, torques, estimates and forces over time."""
        return signals(self.walker, self.trajectory, self.gait.constraint)

    @cached_property
    def certificates(self) -> tuple[Certificate, ...]:
        """What each step would have asked of a real robot on dry ground."""
        return certificates(self.walker, self.trajectory, self.signals)

    @property
    def controller_name(self) -> str:
        """Name of the controller's class without "Controller"."""
        return type(self.walker.controller).__name__.removesuffix("Controller")

    def plot(self, title: str = "", push: tuple[float, float] | None = None) -> Figure:
        """References against joint angles, and torques, as figures 4 and 5; push is marked [s]."""
        from biped_adrc.viz.figures import tracking_figure

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

        note = f"{self.controller_name} on gait '{self.gait.name}', {self.gait.robot} {self.gait.preset}"
        export_run(vars(self.signals), path, note=note)

    def _repr_html_(self) -> str:
        """What a notebook shows: the animation, and references and torques."""
        from biped_adrc.viz.meshcat import animation_html
        from biped_adrc.viz.notebook import inline

        impacts = len(self.trajectory.events(FOOT_STRIKE))
        status = self.trajectory.status
        summary = f"{self.controller_name}: {impacts} impacts. {status.name}: {status.value}"
        return inline(summary, animation_html({self.controller_name: self}), [self.plot()])


@dataclass(frozen=True)
class WalkViewer:
    """Draws trajectories of one walker that was asked to follow one gait."""

    walker: Walker
    gait: Gait

    def animate(self, trajectory: Trajectory, path: Path | str) -> None:
        """As `Walk.animate`."""
        self._walk(trajectory).animate(path)

    def plot(self, trajectory: Trajectory) -> Figure:
        """As `Walk.plot`."""
        return self._walk(trajectory).plot()

    def html(self, trajectory: Trajectory) -> str:
        """As a walk in a notebook."""
        return self._walk(trajectory)._repr_html_()

    def _walk(self, trajectory: Trajectory) -> Walk:
        return Walk(self.walker, self.gait, trajectory)


def watched(walker: Walker, gait: Gait, trajectory: Trajectory) -> Walk:
    """The walk whose trajectory can draw itself."""
    return Walk(walker, gait, replace(trajectory, viewer=WalkViewer(walker, gait)))


def default_method(walker: Walker) -> OneStepMethod:
    """The exponential method where the walker has a linear stiff part, RK4 at 1 ms elsewhere."""
    return RK4() if walker.split(Mode()) is None else Exponential()


def walk(
    walker: Walker,
    gait: Gait,
    impacts: int = 25,
    method: OneStepMethod | None = None,
    *,
    start: tuple[Array, Array] | None = None,
    first_step: int = 1,
    store_every: int = 1,
    progress: Progress | None = None,
) -> Walk:
    """Walk from (q+, q'+) after the impact of the gait's orbit, or from `start`, for some impacts.

    A fall is a status of the trajectory. Raises InputError for parts that do not fit together.
    """
    mode = Mode(first_step)
    q, v = gait.start(walker.nominal) if start is None else start
    trajectory = simulate(
        walker,
        walker.initial_state(q, v, mode),
        mode,
        default_method(walker) if method is None else method,
        t_end=impacts * walker.max_step_time,
        stop_after=(FOOT_STRIKE, impacts),
        store_every=store_every,
        progress=progress,
    )
    return watched(walker, gait, trajectory)
