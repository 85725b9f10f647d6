"""One run of the paper's kind, described by plain values, and what it leaves.

A `Run` can be sent to another process, stored as JSON, and carried out again.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from typing import Any

import numpy as np

from biped_adrc.analysis.certificate import Certificate
from biped_adrc.analysis.legality import Legality
from biped_adrc.analysis.quadrature import integrate
from biped_adrc.control.adrc import ADRCController
from biped_adrc.control.base import Controller
from biped_adrc.control.npd import NPDController
from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.disturbances.base import Sum
from biped_adrc.engine.choice import COMPILED, PINOCCHIO, check_engine
from biped_adrc.errors import InputError, check_count
from biped_adrc.gait.constraint import continued
from biped_adrc.gait.gait import Gait, load_gait
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4, Adaptive, OneStepMethod, Stiff
from biped_adrc.hybrid.simulator import Progress
from biped_adrc.hybrid.storage import load
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.observers.base import ResetPolicy
from biped_adrc.observers.gpi import TABLE_I, GPIObserver
from biped_adrc.studies.push import Push
from biped_adrc.studies.recording import Recording
from biped_adrc.studies.walk import (
    FINE_STEP,
    Part,
    Walk,
    default_parts,
    refined,
    walk_in_parts,
    watched,
)
from biped_adrc.timing import ContinuousTime, SampledTime
from biped_adrc.types import Array
from biped_adrc.walker import FOOT_STRIKE, Mode, Walker

CONTROLLERS = ("NPD", "ADRC")
METHODS: dict[str, Any] = {
    "rk4": RK4,
    "exponential": Exponential,
    "feedback": partial(Exponential, feedback=True),
    "adaptive": Adaptive,
    "stiff": Stiff,
}


@dataclass(frozen=True)
class Run:
    """A walk. SI units; `period` None is continuous time, otherwise the sampling period [s].

    mass, inertia: factors of the plant's bodies while the model stays nominal. first_step: number of the
    first single support, so that a push in the 19th can be studied without walking there. engine: "pinocchio"
    or "compiled". continued: the constraint goes on smoothly past its ends.
    h: step of the method [s]; fine: its step where a push switches and in the single support after; without
    either they are those of `ba.walk`. tolerance: of the methods that choose their steps.
    """

    controller: str = "ADRC"
    robot: str = "rabbit"
    preset: str = "identified"
    gait: str = "published"
    pushes: tuple[Push, ...] = ()
    mass: dict[str, float] = field(default_factory=dict)
    inertia: dict[str, float] = field(default_factory=dict)
    period: float | None = None
    torque_limit: float | None = None
    friction: bool = False
    impacts: int = 25
    first_step: int = 1
    K_p: float = TABLE_II.K_p  # type: ignore[assignment]
    K_d: float = TABLE_II.K_d  # type: ignore[assignment]
    poles: tuple[float, ...] = TABLE_I
    bandwidth: float | None = None
    order: int = 1
    continued: bool = False
    solve_theta: bool = True
    reset: str = "model"
    method: str | None = None
    h: float | None = None
    fine: float | None = None
    tolerance: float = 1e-9
    engine: str = PINOCCHIO

    def record(self) -> dict[str, Any]:
        """The resolved settings as plain values."""
        return asdict(self)

    def biped(self) -> Biped:
        """The nominal robot."""
        return Biped.load(self.robot, self.preset, self.friction)

    def gait_of(self, biped: Biped) -> Gait:
        """The gait, continued if asked for."""
        found = load_gait(self.gait, biped)
        return replace(found, constraint=continued(found.constraint)) if self.continued else found

    def build(self, biped: Biped, gait: Gait) -> Walker:
        """The walker of this run. Raises InputError naming what does not fit."""
        plant = biped
        if self.mass or self.inertia:
            plant = biped.with_errors(mass=self.mass, inertia=self.inertia)
        parts = [push.disturbance(biped) for push in self.pushes]
        return Walker(
            plant,
            self.law(gait.constraint),
            Sum(tuple(parts)) if parts else None,
            ContinuousTime() if self.period is None else SampledTime(self.period),
            model=biped if plant is not biped else None,
            torque_limit=self.torque_limit,
            slope=gait.slope,
        )

    def law(self, reference: Reference) -> Controller:
        """The controller by name."""
        gains = Gains(self.K_p, self.K_d)
        if self.controller == "NPD":
            return NPDController(reference, gains, self.solve_theta)
        if self.controller == "ADRC":
            if self.bandwidth is None:
                observer = GPIObserver.from_poles(self.poles)
            else:
                observer = GPIObserver.from_bandwidth(self.bandwidth, self.order)
            policy = ResetPolicy.named(self.reset)
            return ADRCController(reference, observer, gains, self.solve_theta, policy)
        raise InputError(
            f"controller '{self.controller}' is unknown; choose one of {list(CONTROLLERS)}"
        )

    def one_step_method(self, h: float | None = None) -> OneStepMethod:
        """The method asked for with step h [s], or the run's own; by default exponential for ADRC in continuous
        time, RK4 otherwise."""
        stiff = self.controller == "ADRC" and self.period is None
        name = self.method or ("exponential" if stiff else "rk4")
        if name not in METHODS:
            raise InputError(f"method '{name}' is unknown; choose one of {sorted(METHODS)}")
        h = self.h if h is None else h
        if name in ("adaptive", "stiff") and (h or self.fine) is not None:
            raise InputError(
                f"method '{name}' chooses its own step; leave out h = {h or self.fine:g} s"
            )
        if name in ("adaptive", "stiff"):
            chosen: OneStepMethod = METHODS[name](self.tolerance, self.tolerance)
            return chosen
        method: OneStepMethod = METHODS[name]() if h is None else METHODS[name](h)
        return method

    def parts(self, walker: Walker) -> tuple[Part, ...]:
        """How the walk is integrated: with `fine` where a push switches, with h elsewhere."""
        if self.fine is not None:
            fine = self.one_step_method(self.fine)
            return refined(walker, self.impacts, self.first_step, self.one_step_method(), fine)
        if self.h is None and self.method is None:
            return default_parts(walker, self.impacts, self.first_step, self.engine)
        return (Part(self.impacts, self.one_step_method()),)

    def halved(self) -> Run:
        """The same run with every step half as long.

        A method that chooses its steps gets a hundredth of the tolerance, and is the explicit one.
        """
        if self.method in ("adaptive", "stiff"):
            return replace(self, method="adaptive", tolerance=1e-2 * self.tolerance)
        usual = self.one_step_method()
        assert isinstance(usual, RK4 | Exponential)
        fine = self.fine
        if fine is None and self.h is None and self.method is None and self.engine == COMPILED:
            fine = FINE_STEP if isinstance(usual, Exponential) else None
        return replace(self, h=0.5 * usual.h, fine=None if fine is None else 0.5 * fine)


@dataclass(frozen=True)
class Outcome:
    """What a run leaves; small enough to come back from another process."""

    run: Run
    status: str
    message: str
    impacts: int
    x_minus: Array
    """(impacts, states) before each impact."""
    durations: Array
    """(impacts,) of the single supports [s]."""
    peak_error: float
    """max |q_b - q_d| [rad], inside the steps of the method too."""
    rms_error: float
    """Root of the mean over time and joints of (q_b - q_d)^2 [rad]."""
    peak_torque: float
    """[N m]."""
    certificates: tuple[Certificate, ...]
    legality: Legality
    """What ground and motors would have had to give, within the limits of the robot's record."""
    method: str
    engine: str
    """What ran."""
    half: Outcome | None = None
    """The same run with every step half as long; its own half is None."""

    @property
    def walked(self) -> bool:
        """Whether all impacts asked for were made."""
        return self.status == "COMPLETED"


@dataclass(frozen=True)
class FullOutcome(Walk):
    """A walk and the run that it was asked for by."""

    run: Run

    @cached_property
    def outcome(self) -> Outcome:
        """What is left of it for another process."""
        return _outcome(self.run, self)


def execute(run: Run) -> Outcome:
    """Carry out a run."""
    return execute_fully(run).outcome


def execute_twice(run: Run) -> Outcome:
    """Carry out a run, and the same with every step half as long, which is in `Outcome.half`."""
    return replace(execute(run), half=execute(run.halved()))


def execute_fully(run: Run, progress: Progress | None = None) -> FullOutcome:
    """Carry out a run from the impact of the gait's periodic orbit, and keep the trajectory."""
    check_engine(run.engine)
    check_count(run.impacts, f"the run asks for {run.impacts} impacts")
    biped = run.biped()
    gait = run.gait_of(biped)
    walker = run.build(biped, gait)
    made = walk_in_parts(
        walker,
        gait,
        run.parts(walker),
        first_step=run.first_step,
        progress=progress,
        engine=run.engine,
    )
    return FullOutcome(made.walker, gait, made.trajectory, run)


def _outcome(run: Run, made: Walk) -> Outcome:
    trajectory, s = made.trajectory, made.signals
    events = trajectory.events(FOOT_STRIKE)
    times = np.array([0.0, *(event.t for event in events)])
    squares = np.mean(s.error**2, axis=1)
    duration = s.t[-1] - s.t[0]
    mean = integrate(s.t, squares) / duration if duration > 0 else float(squares[0])
    return Outcome(
        run,
        trajectory.status.name,
        f"{trajectory.status.value} {trajectory.detail}".strip(),
        len(events),
        trajectory.before(FOOT_STRIKE),
        np.diff(times),
        s.peak_error,
        float(np.sqrt(max(mean, 0.0))),
        float(np.max(np.abs(s.u))),
        made.certificates,
        made.legality,
        str(trajectory.settings["method"]),
        str(trajectory.settings["engine"]),
    )


def replay(run: Run, trajectory: Trajectory) -> Walk:
    """The walk of a stored or sent trajectory: its walker is built again from the run."""
    biped = run.biped()
    gait = run.gait_of(biped)
    return watched(run.build(biped, gait), gait, trajectory)


def load_walk(path: Path | str) -> Recording:
    """The walk in a run file (.npz) written by `simulate` or `reproduce`. Raises InputError."""
    from biped_adrc.studies.passive_walk import replayed

    trajectory = load(path, lambda step, start: Mode(int(step), start))
    if "passive" in trajectory.settings:
        return replayed(trajectory)
    record = trajectory.settings.get("run")
    if record is None:
        raise InputError(
            f"run '{path}' does not say which robot, gait and controller it is of; runs written by "
            "'biped-adrc simulate' and 'reproduce' do"
        )
    return replay(from_record(record), trajectory)


def load_walks(paths: Sequence[Path]) -> dict[str, Recording]:
    """The walks in run files, named by controller and, where that is not enough, by file."""
    found = [(path, load_walk(path)) for path in paths]
    names = [walk.controller_name for _, walk in found]
    if len(set(names)) < len(names):
        names = [f"{walk.controller_name} ({path.stem})" for path, walk in found]
    if len(set(names)) < len(names):
        names = [f"{name} {k}" for k, name in enumerate(names, start=1)]
    return dict(zip(names, (walk for _, walk in found), strict=True))


def from_record(record: dict[str, Any]) -> Run:
    """The run that `Run.record` came from. Raises InputError for keys that do not belong there."""
    values = {key: value for key, value in record.items() if key != "store_every"}
    try:
        values["pushes"] = tuple(Push(**push) for push in values.get("pushes", ()))
        values["poles"] = tuple(values.get("poles", TABLE_I))
        return Run(**values)
    except TypeError as error:
        raise InputError(f"these settings do not describe a run: {error}") from error
