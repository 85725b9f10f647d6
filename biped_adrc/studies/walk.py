"""One walk from a gait's periodic orbit, with its signals, pictures and certificates at hand."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

from biped_adrc.analysis.legality import until_illegal
from biped_adrc.engine.choice import PINOCCHIO, simulate_by
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4, OneStepMethod
from biped_adrc.hybrid.simulator import Progress
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.limits import Limits
from biped_adrc.studies.recording import Recording, RecordingViewer
from biped_adrc.types import Array
from biped_adrc.walker import Mode, Walker


@dataclass(frozen=True)
class Walk(Recording):
    """A walker, the gait it was asked to follow, and what it did."""

    walker: Walker
    gait: Gait
    trajectory: Trajectory

    @property
    def reference(self) -> Reference:
        """The gait's constraint."""
        return self.gait.constraint

    @property
    def note(self) -> str:
        """Controller, gait, robot and preset."""
        gait = self.gait
        return f"{self.controller_name} on gait '{gait.name}', {gait.robot} {gait.preset}"

    def until_illegal(self, limits: Limits | None = None) -> Self:
        """The walk up to the first instant at which ground or motors could not have carried it.

        Its status is then ILLEGAL and its detail says which limit, when, and by how much. None: the limits
        of the robot's record.
        """
        cut = until_illegal(self.walker, self.trajectory, self.signals, limits)
        return self if cut is self.trajectory else replace(self, trajectory=cut)


def watched(walker: Walker, gait: Gait, trajectory: Trajectory) -> Walk:
    """The walk whose trajectory can draw itself."""
    viewer = RecordingViewer(lambda bare: Walk(walker, gait, bare))
    return Walk(walker, gait, replace(trajectory, viewer=viewer))


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
    engine: str = PINOCCHIO,
    legal: Limits | None = None,
) -> Walk:
    """Walk from (q+, q'+) after the impact of the gait's orbit, or from `start`, for some impacts.

    engine: "pinocchio" or "compiled"; the trajectory's settings say what ran. A fall is a status of the
    trajectory. legal: the walk ends, with the status ILLEGAL, where it would leave these limits; without, they
    are looked up in `Walk.legality` alone. Raises InputError for parts that do not fit together.
    """
    mode = Mode(first_step)
    q, v = gait.start(walker.nominal) if start is None else start
    trajectory = simulate_by(
        engine,
        walker,
        walker.initial_state(q, v, mode),
        mode,
        default_method(walker) if method is None else method,
        t_end=impacts * walker.max_step_time,
        impacts=impacts,
        store_every=store_every,
        progress=progress,
    )
    made = watched(walker, gait, trajectory)
    return made if legal is None else made.until_illegal(legal)
