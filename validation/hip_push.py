"""How large a constant rearward force on the hip stops the walk, with and without a controller from step to
step.

Tracking cannot reject a force that enters the unactuated row: Westervelt, Grizzle, Canudas de Wit (IEEE CDC
2003) report that 3 N stop a gait of 0.50 m/s under any inner loop, and that a PI from step to step recovers
it. Here the smallest force, a multiple of `resolution`, with which the simulated walk does not make all its
steps is searched under NPD and ADRC, alone and inside the PI of `control.stride` with the gains of its triple
pole. Beside it stands the force that quadratures of `analysis.forced_steps` predict without a simulation.

The search starts from the prediction, and both sides of what it returns were simulated; that more force is
never better is assumed. Walks start on the orbit of their gait; the force (-force, 0) acts from the first
instant on. Run by `docs/write_hip_force.py`; `validation.rabbit` takes single cases of it.

The prediction follows the zero dynamics from step to step under the force, up to the number of steps asked for.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.forced_steps import stopping_force
from biped_adrc.analysis.legality import Legality, outcome_of
from biped_adrc.analysis.stride_gain import STANCE_KNEE, DirectionMerit, direction_merits
from biped_adrc.campaign.pool import Task, TaskProgress, run_tasks
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.control.base import Controller
from biped_adrc.control.stride import StridePI
from biped_adrc.errors import InputError, SimulationError
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid.status import Status
from biped_adrc.model.biped import Biped
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.registry import find
from biped_adrc.scenario.run import walk_scenario
from biped_adrc.scenario.scenario import Scenario


class Parts(NamedTuple):
    """What walks."""

    biped: Biped
    """RABBIT in the preset of the case."""
    gait: Gait
    """Its stored gait."""
    law: Controller
    """The controller, the PI around it included."""


@dataclass(frozen=True)
class HipCase:
    """One walker to be pushed.

    Raises InputError for what no scenario takes, or a resolution that is not positive.
    """

    tracking: str
    """Name of the inner controller."""
    stride: bool
    """Whether the PI from step to step goes around it."""
    preset: str = "identified-bare"
    """Of RABBIT."""
    gait: str = "v0.5"
    """Name of a stored gait."""
    direction: tuple[float, ...] = STANCE_KNEE
    """(p,) in which the PI moves the gait's curve."""
    limit: float = 0.5
    """Bound of the PI on |beta| [rad]."""
    steps: int = 25
    """Steps asked for."""
    resolution: float = 0.1
    """Forces tried are multiples of it [N]."""
    h: float = 1e-3
    """Integration step [s]: of RK4 under NPD, of the exponential method under ADRC."""

    def __post_init__(self) -> None:
        self.scenario(0.0)
        find("controller", self.tracking)
        if not (math.isfinite(self.resolution) and self.resolution > 0):
            raise InputError(f"the resolution is {self.resolution} N, expected a positive number")

    @property
    def name(self) -> str:
        """Of the controller, for a reader."""
        return f"{self.tracking} with PI" if self.stride else self.tracking

    def scenario(self, force: float) -> Scenario:
        """The walk from the gait's orbit under a rearward force [N], which acts from its first instant on."""
        around = {"inner": self.tracking, "direction": self.direction, "limit": self.limit}
        return Scenario(
            controller="stride PI" if self.stride else self.tracking,
            own=around if self.stride else {},
            preset=self.preset,
            gait=self.gait,
            impacts=self.steps,
            h=self.h,
            push="hip force",
            pushed_step=1,
            force=force,
            direction=math.pi,
        )

    def parts(self) -> Parts:
        """Robot, gait and controller; the gains of the PI are those of the triple pole."""
        scene = RobotAndGait.of(self.scenario(0.0))
        walker = build(self.scenario(0.0), scene)
        return Parts(scene.biped, scene.walked, walker.controller)

    def walk(self, force: float) -> Walk:
        """The simulated walk under this force [N]."""
        return walk_scenario(self.scenario(force))

    def predicted(self) -> float:
        """The force [N] that stops it according to the quadratures on the zero dynamics, without a
        simulation.
        """
        biped, gait, law = self.parts()
        stride = law if isinstance(law, StridePI) else None
        return stopping_force(gait, biped, self.steps, stride)


@dataclass(frozen=True)
class PushedWalk:
    """What one force did, and what the finished steps needed; None where there is no finished step."""

    force: float
    """Rearward [N]."""
    status: Status
    """How the simulation ended."""
    speeds: tuple[float, ...]
    """L / T of every finished step [m/s]."""
    legality: Legality | None
    """Of the finished steps, within the limits of the robot's record."""
    clearance: float | None
    """Least height of the swing foot inside a step [m]."""

    @classmethod
    def of(cls, case: HipCase, force: float) -> PushedWalk:
        """Simulate the case under this force [N].

        The last step, in which the robot fell, is left out of speeds and legality: it says nothing of walking.
        """
        made = case.walk(force)
        count = len(made.trajectory.events(FOOT_STRIKE))
        arcs = tuple(arc for arc in made.trajectory.arcs if arc.mode.step <= count)
        finished = replace(made, trajectory=replace(made.trajectory, arcs=arcs))
        steps = finished.certificates if arcs else ()
        return cls(
            force,
            made.trajectory.status,
            tuple(step.step_length / step.duration for step in steps),
            finished.legality if arcs else None,
            min((step.clearance for step in steps), default=None),
        )

    @property
    def walks(self) -> bool:
        """Whether all steps were made."""
        return self.status.ok

    @property
    def outcome(self) -> str:
        """One of the words in `analysis.legality.OUTCOMES`."""
        return outcome_of(self.status, False) if self.legality is None else self.legality.outcome

    def speed(self, last: int = 5) -> float | None:
        """Mean of the last steps [m/s]; None without one."""
        return float(np.mean(self.speeds[-last:])) if self.speeds else None


MOST = 1000
"""Multiples of the resolution after which a search gives up."""


@dataclass(frozen=True)
class HipLimit:
    """The smallest force that stops a case."""

    case: HipCase
    """Who walks."""
    predicted: float
    """The force by quadrature [N]."""
    below: PushedWalk
    """The walk one resolution below."""
    stops: PushedWalk
    """The walk at the force that stops it."""


def first_failure(walks: Callable[[int], bool], guess: int) -> int:
    """The smallest k >= 1 with walks(k) False, assuming that it stays False above; bracketed outwards from
    `guess`.

    walks(0) is asked too. Raises SimulationError when it is False, or when walks(MOST) is True.
    """
    low, high, stride = max(guess - 1, 0), min(max(guess, 1), MOST), 1
    while not walks(low):
        if low == 0:
            raise SimulationError(
                "the walk does not make its steps without a force; check its gait"
            )
        low, high, stride = max(low - stride, 0), low, 2 * stride
    while walks(high):
        if high == MOST:
            raise SimulationError(
                f"the walk makes its steps under {MOST} times the resolution; ask for a coarser one"
            )
        low, high, stride = high, min(high + stride, MOST), 2 * stride
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if walks(middle) else (low, middle)
    return high


def hip_limit(case: HipCase) -> HipLimit:
    """The smallest force that stops a case, as a multiple of its resolution.

    The search starts at the prediction, so that two or three walks are enough where that is right; each force
    is simulated once. Raises SimulationError as `first_failure`.
    """
    known: dict[int, PushedWalk] = {}

    def walks(k: int) -> bool:
        if k not in known:
            known[k] = PushedWalk.of(case, k * case.resolution)
        return known[k].walks

    predicted = case.predicted()
    k = first_failure(walks, int(np.ceil(predicted / case.resolution)))
    return HipLimit(case, predicted, known[k - 1], known[k])


@dataclass(frozen=True)
class HipPush:
    """The limits of all cases, what the PI makes of the forces that stop tracking alone, and its directions."""

    limits: tuple[HipLimit, ...]
    """Of all cases."""
    kept: tuple[tuple[HipCase, PushedWalk], ...]
    """With the PI, at the force that stops the same tracking alone, and `above` more."""
    directions: dict[str, tuple[DirectionMerit, ...]]
    """By preset: how well each direction of the PI regulates the speed."""

    def limit(self, preset: str, tracking: str, stride: bool) -> HipLimit:
        """One of `limits`. Raises InputError where it was not studied."""
        for found in self.limits:
            c = found.case
            if (c.preset, c.tracking, c.stride) == (preset, tracking, stride):
                return found
        raise InputError(f"{tracking}, {preset}, was not studied; choose a case of `limits`")

    def text(self) -> str:
        """Three tables for a reader: limits, walks with the PI, directions."""
        stops = (
            f"{_named(x.case)} {x.stops.force:12.1f} {x.predicted:14.2f} {_shown(x.below.speed()):>18}"
            for x in self.limits
        )
        kept = (
            f"{_named(case)} {w.force:12.1f}  {w.outcome:<10} {_shown(w.speed()):>12} "
            f"{_shown(w.legality.peak_torque if w.legality else None, 1):>11}"
            for case, w in self.kept
        )
        merits = (
            f"{preset:<17} {d.name:<14} {d.static_gain:18.3f} {d.merit:25.5f}"
            for preset, found in self.directions.items()
            for d in found
        )
        tables = {
            "controller     stops at [N]  by quadrature  speed below [m/s]": stops,
            "controller        force [N]  outcome     speed [m/s]  peak [N m]": kept,
            "direction      gain [m/s per rad]  per torque [m/s per N m]": merits,
        }
        texts = (["preset            " + head, *rows] for head, rows in tables.items())
        return "\n\n".join(map("\n".join, texts))


def _named(case: HipCase) -> str:
    """Preset and controller in columns."""
    return f"{case.preset:<17} {case.name:<14}"


def _shown(x: float | None, digits: int = 4) -> str:
    """The number with so many decimals, "-" for none."""
    return "-" if x is None else f"{x:.{digits}f}"


def hip_push(
    presets: Sequence[str] = ("identified", "identified-bare", "tac2003"),
    base: HipCase | None = None,
    above: float = 1.0,
    workers: int = 2,
    progress: TaskProgress | None = None,
) -> HipPush:
    """The study, in `workers` processes.

    base: gait, direction and numbers of all cases; above: more force on the PI than stops the tracking alone
    [N]. Raises InputError, GaitError or SimulationError as its parts do.
    """
    if not presets:
        raise InputError(
            "no preset of RABBIT was given, expected at least one, such as 'identified'"
        )
    base = HipCase("NPD", False) if base is None else base
    every = itertools.product(presets, CONTROLLERS, (False, True))
    cases = [replace(base, preset=p, tracking=law, stride=stride) for p, law, stride in every]
    tasks = [Task(f"{c.preset}, {c.name}", hip_limit, (c,)) for c in cases]
    limits = [found.value for found in run_tasks(tasks, workers, progress)]
    alone = [x for x in limits if not x.case.stride]
    forces = [(x.case, x.stops.force + more) for x in alone for more in (0.0, above)]
    kept = [(replace(case, stride=True), force) for case, force in forces]
    pushed = [Task(f"{c.preset}, {c.name}, {F:g} N", PushedWalk.of, (c, F)) for c, F in kept]
    walks = [found.value for found in run_tasks(pushed, workers, progress)]
    pairs = tuple((c, w) for (c, _), w in zip(kept, walks, strict=True))
    parts = {preset: replace(base, preset=preset).parts() for preset in presets}
    merits = {preset: direction_merits(one.gait, one.biped) for preset, one in parts.items()}
    return HipPush(tuple(limits), pairs, merits)
