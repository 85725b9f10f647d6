"""The equations of a walker on symbols, one straight-line function each, from the laws' own lines.

    flow    (t, step, t_start, x, zeta) -> x'            (10); between ticks the torque is held
    tick    (t, step, t_start, x, zeta, outside) -> x, q''   sensors, controller, motors and meter at a tick
    strike  (t, step, x) -> x+                           (7), (8), relabelling, and the controller's jump
    watch   (t, t_start, drop, q) -> what the guards look at, x of the swing foot

`outside`, for the meter: forces [N], impulse since the last tick [N s], drop of the ground [m]. flow, tick and
strike add, after x, the least pivot of the matrices that the controller inverts.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.closed_loop import exponential_form as split
from biped_adrc.closed_loop import semantics
from biped_adrc.closed_loop.exponential_form import SplitLaws
from biped_adrc.closed_loop.semantics import Mode
from biped_adrc.control.base import ControllerLaws, Measurement
from biped_adrc.engine.kernels.layout import OUTSIDE
from biped_adrc.engine.mechanics import PlanarRobot, Structure
from biped_adrc.engine.symbols import (
    Tracer,
    Vector,
    column,
    floats,
    maximum,
    minimum,
    run,
)
from biped_adrc.errors import InputError
from biped_adrc.hardware.meter import Outside
from biped_adrc.hardware.sample_hold import HeldParameters, HeldSizes
from biped_adrc.model.planar import PlantArrays
from biped_adrc.types import Array


class Numbers(NamedTuple):
    """All that is given at run time, in the order of the vector K."""

    plant: PlantArrays
    model: PlantArrays | None
    """Of the controller, None where it is the plant."""
    k: Any
    """Parameters of the controller's laws."""
    torque_limit: float
    """[N m], infinite without."""
    tan_slope: float
    lowest_hip: float
    """[m]"""
    longest: float
    """Single support [s]."""
    friction: tuple[Array, Array] | tuple[()]
    """Viscous [N m s] and static [N m] of the coordinates, empty without."""
    held: HeldParameters | tuple[()] = ()
    """Of what is held between ticks, empty in continuous time."""
    impact_gain: Any = ()
    """(n,) of v+, empty without."""
    split: Any = ()
    """Parameters of the split's laws, empty without."""


class Make(NamedTuple):
    """What the equations are made of, besides numbers."""

    robot: Structure
    laws: ControllerLaws
    size: int
    """Of the controller's state."""
    held: HeldSizes | None
    """What is held between ticks, None in continuous time."""
    split: SplitLaws | None = None
    """Coordinates of the exponential method."""
    gained: bool = False
    """With an error of the impact map."""

    @property
    def nx(self) -> int:
        """Numbers in a state."""
        return 2 * self.robot.n + self.size + (0 if self.held is None else self.held.total)


class Function(NamedTuple):
    """`void f(double* K, double* inp, double* out)` as CasADi's columns."""

    K: Any
    inp: Any
    out: Any


def laws_on(trace: Tracer, laws: ControllerLaws, k: Any, p: int, size: int) -> ControllerLaws:
    """The laws for symbols, without their parameters k; one that is not there leaves the state as it is.

    Raises InputError for one that gives another number than p torques or `size` numbers of the state.
    """

    def said(name: str) -> Any:
        law, expected = getattr(laws, name), {"output": p, "estimate": None}.get(name, size)

        def called(*arguments: Any) -> Any:
            found = run(trace, law, k, *arguments)
            if expected is not None and np.shape(found) != (expected,):
                raise InputError(
                    f"law {name} gives an array of shape {np.shape(found)}, expected ({expected},)"
                )
            return found

        return called if law is not None else lambda s, *rest: s

    made = laws._replace(**{name: said(name) for name in LAWS})
    return made if laws.estimate is not None else made._replace(estimate=lambda s, m: None)


LAWS = ("output", "flow", "jump", "correct", "predict", "estimate")


class SymbolicLoop(NamedTuple):
    """A `semantics.Loop` of one make; zeta (n,) and `given` (OUTSIDE,) are symbols too."""

    plant: PlanarRobot
    nominal: PlanarRobot
    exact: bool
    law: Any
    held: HeldParameters | None
    swap: Any
    gain: Any
    limit: Any
    zeta: Any
    given: Any

    def measure(self, t: Any, q: Any, v: Any, mode: Mode) -> Measurement:
        return semantics.measurement(self, t, q, v, mode, body=True)

    def saturate(self, u: Any) -> Any:
        return np.array([minimum(maximum(x, -self.limit), self.limit) for x in u], dtype=object)

    def external(self, t: Any, q: Any, v: Any, mode: Mode) -> Any:
        return self.zeta

    def outside(self, t: Any, mode: Mode) -> Outside:
        return Outside(self.given[:2], self.given[2:4], self.given[4])


class At(NamedTuple):
    """The symbols of one instant, and the loop that they are given to."""

    inp: Vector
    trace: Tracer
    loop: SymbolicLoop
    t: Any
    x: Any
    mode: Mode

    def does(self, function: Callable[..., Any], *more: Any) -> Any:
        """A function of `semantics` here."""
        return self.trace(function)(self.loop, self.t, self.x, self.mode, *more)


def count(example: Any) -> int:
    """Length of the vector of numbers: one more than there are, so that it is never empty."""
    return 1 + sum(1 for _ in floats(example))


@dataclass(frozen=True)
class Equations:
    """The functions of one make; K is CasADi's column of the symbols in `numbers`."""

    make: Make
    K: Any
    numbers: Numbers

    @classmethod
    def of(cls, make: Make, example: Numbers) -> Equations:
        """With symbols for the floats of an example."""
        K = Vector("K", count(example))
        return cls(make, K.symbol, K.like(example))

    @staticmethod
    def names(make: Make) -> list[str]:
        """Of the functions that this make has."""
        split = [] if make.split is None else ["to", "back", "remainder"]
        return ["flow", "strike", "watch", *(["tick"] if make.held is not None else []), *split]

    def loop(self, trace: Tracer, zeta: Any = None, given: Any = None) -> SymbolicLoop:
        """The closed loop."""
        K, make = self.numbers, self.make
        model = K.plant if K.model is None else K.model
        return SymbolicLoop(
            plant=PlanarRobot.of(make.robot, K.plant, K.friction),
            nominal=PlanarRobot.of(make.robot, model),
            exact=K.model is None and not K.friction,
            law=laws_on(trace, make.laws, K.k, make.robot.p, make.size),
            held=K.held or None,
            swap=make.robot.swap,
            gain=K.impact_gain,
            limit=K.torque_limit,
            zeta=zeta,
            given=given,
        )

    def at(self) -> At:
        """The symbols (t, step, t_start, x, zeta, outside)."""
        n, trace = self.make.robot.n, Tracer()
        inp = Vector("inp", 3 + self.make.nx + n + OUTSIDE)
        t, mode, x = inp.take(), Mode(inp.take(), inp.take()), inp.take(self.make.nx)
        return At(inp, trace, self.loop(trace, inp.take(n), inp.take(OUTSIDE)), t, x, mode)

    def made(self, inp: Vector, *parts: Any) -> Function:
        """The function of these inputs."""
        return Function(self.K, inp.symbol, column(*parts))

    def flow(self) -> Function:
        """x' between events."""
        at = self.at()
        return self.made(at.inp, at.does(semantics.flow), at.trace.solver.least)

    def tick(self) -> Function:
        """x after the controller has acted, and q'' there."""
        at, n = self.at(), self.make.robot.n
        x = at.does(semantics.tick)
        a = at._replace(x=x).does(semantics.flow)[n : 2 * n]
        return self.made(at.inp, x, at.trace.solver.least, a)

    def strike(self) -> Function:
        """x after impact, relabelling and the controller's jump; `step` is the one that begins."""
        inp, trace = Vector("inp", 2 + self.make.nx), Tracer()
        t, step, x = inp.take(), inp.take(), inp.take(self.make.nx)
        x = trace(semantics.struck)(self.loop(trace), t, x, Mode(step, t))
        return self.made(inp, x, trace.solver.least)

    def watch(self) -> Function:
        """What the guards look at."""
        K, plant = self.numbers, self.loop(Tracer()).plant
        inp = Vector("inp", 3 + plant.n)
        t, start, drop, q = inp.take(), inp.take(), inp.take(), inp.take(plant.n)
        foot = plant.swing_foot(q)
        clearance = semantics.clearance(K.tan_slope, drop, foot)
        hip = semantics.hip_margin(K.lowest_hip, plant.hip(q))
        return self.made(inp, clearance, hip, semantics.time_left(K.longest, start, t), foot[0])

    def _split(self, trace: Tracer) -> SplitLaws:
        """The split's laws, for symbols."""
        laws = self.make.split
        assert laws is not None
        traced = {name: trace(getattr(laws, name)) for name in ("to", "back", "remainder")}
        return laws._replace(parameters=self.numbers.split, **traced)

    def _coordinates(self, y: Any) -> tuple[Any, Any]:
        """w and E of y."""
        assert self.make.split is not None
        p = self.make.robot.p
        stiff = len(self.make.split.A) * p
        return y[: len(y) - stiff], y[len(y) - stiff :].reshape(-1, p)

    def to(self) -> Function:
        """y = (w, E) of x."""
        inp, trace = Vector("inp", self.make.nx), Tracer()
        return self.made(inp, *self._split(trace).to(self.numbers.split, inp.take(self.make.nx)))

    def back(self) -> Function:
        """x of y = (w, E)."""
        inp, trace = Vector("inp", self.make.nx), Tracer()
        w, E = self._coordinates(inp.take(self.make.nx))
        return self.made(inp, self._split(trace).back(self.numbers.split, w, E))

    def remainder(self) -> Function:
        """N_w, and N_E in its forced rows, at y = (w, E) in place of x."""
        at = self.at()
        w, E = self._coordinates(at.x)
        N = at.trace(split.remainder)(at.loop, self._split(at.trace), at.t, w, E, at.mode)
        return self.made(at.inp, *N, at.trace.solver.least)
