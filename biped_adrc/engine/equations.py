"""The equations of a walker on symbols, one straight-line function each, from the laws' own lines.

    flow    (t, step, t_start, x, zeta) -> x'            (10); between ticks the torque is held
    tick    (t, step, t_start, x, zeta, outside) -> x, q''   sensors, controller, motors and meter at a tick
    strike  (t, step, x) -> x+                           (7), (8), relabelling, and the controller's jump
    watch   (q) -> clearance, x of the swing foot, height of the hip

`outside`, for the meter: forces [N], impulse since the last tick [N s], drop of the ground [m]. flow, tick and
strike add, after x, the least pivot of the matrices that the controller inverts.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.control.base import ControllerLaws, Measurement
from biped_adrc.engine import mechanics
from biped_adrc.engine.kernels.layout import OUTSIDE
from biped_adrc.engine.mechanics import Structure
from biped_adrc.engine.symbols import (
    Tracer,
    Vector,
    column,
    floats,
    maximum,
    minimum,
    run,
    solve_positive,
    tanh,
)
from biped_adrc.hardware.held import (
    Held,
    HeldParameters,
    HeldSizes,
    after_impact,
    motor_torque,
    read,
    written,
)
from biped_adrc.hardware.meter import Hit, metered
from biped_adrc.hardware.motors import acting, limited, mean_torque, sent
from biped_adrc.hardware.sensors import sense
from biped_adrc.model import planar
from biped_adrc.model.biped import STICTION_SPEED
from biped_adrc.model.planar import PlantArrays
from biped_adrc.model.reduction import Reduction, reduce, unknown_force
from biped_adrc.split import SplitLaws
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
    def sampled(self) -> bool:
        """Whether torques are held between ticks."""
        return self.held is not None

    @property
    def nx(self) -> int:
        """Numbers in a state."""
        return 2 * self.robot.n + self.size + (0 if self.held is None else self.held.total)


class Function(NamedTuple):
    """`void f(double* K, double* inp, double* out)` as CasADi's columns."""

    K: Any
    inp: Any
    out: Any


class At(NamedTuple):
    """What a function is given at one instant."""

    inp: Vector
    trace: Tracer
    m: Measurement
    s: Any
    held: Held | None
    """In sampled time."""
    zeta: Any
    outside: Any
    """For the meter, in `tick` alone."""

    @property
    def u(self) -> Any:
        """The torque on the joints, in sampled time."""
        assert self.held is not None
        return motor_torque(self.held.line)


def count(example: Any) -> int:
    """Length of the vector of numbers: one more than there are, so that it is never empty."""
    return 1 + sum(1 for _ in floats(example))


def masked(make: Make, numbers: Numbers) -> Numbers:
    """The numbers without those that are zero by make."""
    model = numbers.model
    return numbers._replace(
        plant=mechanics.without_zeros(make.robot, numbers.plant),
        model=None if model is None else mechanics.without_zeros(make.robot, model),
    )


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
        return cls(make, K.symbol, masked(make, K.like(example)))

    @property
    def nx(self) -> int:
        """Numbers in a state."""
        return self.make.nx

    def functions(self) -> dict[str, Callable[[], Function]]:
        """By name, those that this make has."""
        found = {"flow": self.flow, "strike": self.strike, "watch": self.watch}
        if self.make.sampled:
            found |= {"tick": self.tick}
        if self.make.split is not None:
            found |= {"to": self.to, "back": self.back, "remainder": self.remainder}
        return found

    def terms(self, trace: Tracer, q: Any, v: Any) -> Reduction:
        """The nominal model's."""
        robot, numbers = self.make.robot, self.numbers
        K = numbers.plant if numbers.model is None else numbers.model
        terms: Reduction = trace(reduce)(*planar.inertia_and_bias(robot, K, q, v), robot.p)
        return terms

    def measured(
        self, trace: Tracer, t: Any, step: Any, t_step: Any, q: Any, v: Any
    ) -> Measurement:
        """What the controller is given at (q, v)."""
        robot, numbers = self.make.robot, self.numbers
        K = numbers.plant if numbers.model is None else numbers.model
        body = mechanics.body_terms(robot, K, q, v)
        return Measurement(t, step, t_step, q, v, self.terms(trace, q, v), body)

    def acceleration(self, terms: Reduction | None, q: Any, v: Any, force: Any) -> Any:
        """q'' of the plant, with the nominal model's D and Omega where they are its own."""
        robot, numbers = self.make.robot, self.numbers
        if numbers.model is None and terms is not None:
            D, Omega = terms.D, terms.Omega
        else:
            D, Omega = planar.inertia_and_bias(robot, numbers.plant, q, v)
        return solve_positive(D, self.with_friction(force, v) - Omega, "D_s")

    def with_friction(self, force: Any, v: Any) -> Any:
        """A generalised force with that of the joints' friction."""
        if not self.numbers.friction:
            return force
        viscous, static = self.numbers.friction
        return force - viscous * v - static * tanh(v / STICTION_SPEED)

    def at(self, back: Callable[[Any], Any] = lambda x: x) -> At:
        """The symbols of an instant; `back` makes x of what is given in its place."""
        robot, size = self.make.robot, self.make.size
        inp = Vector("inp", 3 + self.nx + robot.n + OUTSIDE)
        t, step, start = inp.take(), inp.take(), inp.take()
        x, n = back(inp.take(self.nx)), robot.n
        q, v, s = x[:n], x[n : 2 * n], x[2 * n : 2 * n + size]
        held = None if self.make.held is None else read(self.make.held, x[2 * n + size :])
        trace = Tracer()
        m = self.measured(trace, t, step, t - start, q, v)
        return At(inp, trace, m, s, held, inp.take(n), inp.take(OUTSIDE))

    def saturated(self, u: Any) -> Any:
        """u within the torque limit."""
        limit = self.numbers.torque_limit
        return np.array([minimum(maximum(x, -limit), limit) for x in u], dtype=object)

    def force(self, u: Any, zeta: Any) -> Any:
        """B_s u + zeta."""
        force = zeta.copy()
        force[: self.make.robot.p] = force[: self.make.robot.p] + u
        return force

    def law(self, at: At, name: str, s: Any, *rest: Any) -> Any:
        """What a law of the controller says at an instant, for a state s."""
        return self.said(at.trace, name, self.numbers.k, s, at.m, *rest)

    def said(self, trace: Tracer, name: str, *arguments: Any) -> Any:
        """The law on symbols. Raises Untraceable, with the law's name."""
        return run(trace, getattr(self.make.laws, name), *arguments)

    def flow(self) -> Function:
        """x' between events."""
        at = self.at()
        m, make = at.m, self.make
        if make.sampled:
            a = self.acceleration(m.terms, m.q, m.v, self.force(at.u, at.zeta))
            still = np.full(self.nx - 2 * len(m.v), 0.0, dtype=object)
            return self.given(at, m.v, a, self.lagged(at, still))
        u = self.saturated(self.law(at, "output", at.s))
        a = self.acceleration(m.terms, m.q, m.v, self.force(u, at.zeta))
        ds = self.law(at, "flow", at.s, u) if make.size else at.s
        return self.given(at, m.v, a, ds)

    def lagged(self, at: At, still: Any) -> Any:
        """The slope of what is held, in which the motors' torque flows."""
        sizes, held = self.make.held, at.held
        if sizes is not None and held is not None and sizes.lag:
            begin = len(still) - sizes.p * (sizes.waiting + 2)
            speed = self.numbers.held.motors.speed  # type: ignore[union-attr]
            still[begin : begin + sizes.p] = speed * (held.line.u - held.line.u_m)
        return still

    def tick(self) -> Function:
        """x after the controller has acted, and q''; without a discrete law its state stays."""
        at, laws, k = self.at(), self.make.laws, self.numbers.held
        true, held = at.m, at.held
        assert held is not None
        assert isinstance(k, HeldParameters)
        w = at.trace(sense)(k.sensors, held.w, true.q, true.v) if k.sizes.sensors else held.w
        if k.sizes.sensors:
            n = k.sizes.n
            seen = self.measured(at.trace, true.t, true.step, true.t_step, w[:n], w[n : 2 * n])
            at = at._replace(m=seen)
        s = self.law(at, "correct", at.s) if laws.correct is not None else at.s
        u = self.saturated(self.law(at, "output", s))
        if k.sizes.rate:
            u = at.trace(limited)(k.motors, held.line, u)
        line = sent(k.motors, held.line, u)
        fed = acting(k.motors, line) if k.sizes.known else u
        s = self.law(at, "predict", s, fed) if laws.predict is not None else s
        u, g = motor_torque(line), held.g
        a = self.acceleration(true.terms, true.q, true.v, self.force(u, at.zeta))
        if k.sizes.meter:
            g = self.metered(at, true, u, mean_torque(k.motors, line), a)
        out = column(true.q, true.v, s, written(Held(w, g, line)), at.trace.solver.least, a)
        return Function(self.K, at.inp.symbol, out)

    def metered(self, at: At, true: Measurement, u: Any, mean: Any, a: Any) -> Any:
        """The meter's state after a tick."""
        k, q, v = self.numbers.held, true.q, true.v
        assert isinstance(k, HeldParameters)
        assert at.held is not None
        loads = mechanics.loads(self.make.robot, self.numbers.plant, q, v, a, at.outside)
        given = (q, v, u, mean, self.unknown(true.terms, a, u, at.zeta), true.terms)
        return at.trace(metered)(k.meter, at.held.g, *given, true.t, true.step, true.t_step, loads)

    def unknown(self, terms: Reduction, a: Any, u: Any, zeta: Any) -> Any:
        """xi~ of (11), as `Walker.unknown`."""
        known = self.numbers.model is None and not self.numbers.friction
        return zeta if known else unknown_force(terms, a, u)

    def strike(self) -> Function:
        """x after impact, relabelling and the controller's jump."""
        robot, make = self.make.robot, self.make
        inp = Vector("inp", 2 + self.nx)
        t, step = inp.take(), inp.take()
        q, v, s = inp.take(robot.n), inp.take(robot.n), inp.take(make.size)
        tail = inp.take(self.nx - 2 * robot.n - make.size)
        plant, q_minus = self.numbers.plant, q
        momentum = mechanics.momentum(robot, plant, q, v)
        q, v, impulse = mechanics.impact(robot, plant, q, v)
        if self.make.gained:
            v = v * (1.0 + self.numbers.impact_gain)
        trace, seen = Tracer(), (q, v)
        if make.held is not None:
            hit = Hit(t, step - 1.0, momentum, impulse)
            tail, seen = self.held_after(trace, tail, q_minus, q, v, hit)
        if make.laws.jump is not None:
            after = self.measured(trace, t, step, 0.0 * t, *seen)
            s = self.said(trace, "jump", self.numbers.k, s, after, robot.swap)
        out = column(q, v, s, tail, trace.solver.least)
        return Function(self.K, inp.symbol, out)

    def held_after(
        self, trace: Tracer, tail: Any, q_minus: Any, q: Any, v: Any, hit: Hit
    ) -> tuple[Any, tuple[Any, Any]]:
        """What is held after an impact to (q, v), and what the controller sees of (q, v) there."""
        k, robot = self.numbers.held, self.make.robot
        assert isinstance(k, HeldParameters)
        held, n, expected = read(k.sizes, tail), k.sizes.n, v
        if k.sizes.sensors:
            K = self.numbers.plant if self.numbers.model is None else self.numbers.model
            _, expected, _ = mechanics.impact(robot, K, held.w[:n], held.w[n : 2 * n])
        held = trace(after_impact)(k, held, robot.swap, q_minus, q, v, expected, hit)
        seen = (held.w[:n], held.w[n : 2 * n]) if k.sizes.sensors else (q, v)
        return written(held), seen

    def _coordinates(self, y: Any) -> tuple[Any, Any]:
        """w and E of y."""
        split, p = self.make.split, self.make.robot.p
        assert split is not None
        stiff = len(split.A) * p
        return y[: len(y) - stiff], y[len(y) - stiff :].reshape(-1, p)

    def _x(self, y: Any) -> Any:
        """x of y."""
        assert self.make.split is not None
        return Tracer()(self.make.split.back)(self.numbers.split, *self._coordinates(y))

    def to(self) -> Function:
        """y = (w, E) of x."""
        assert self.make.split is not None
        inp = Vector("inp", self.nx)
        y = Tracer()(self.make.split.to)(self.numbers.split, inp.take(self.nx))
        return Function(self.K, inp.symbol, column(*y))

    def back(self) -> Function:
        """x of y = (w, E)."""
        inp = Vector("inp", self.nx)
        return Function(self.K, inp.symbol, column(self._x(inp.take(self.nx))))

    def remainder(self) -> Function:
        """N_w, and N_E in its forced rows."""
        split, k, given = self.make.split, self.numbers.split, []
        assert split is not None

        def back(y: Any) -> Any:
            given.append(y)
            return self._x(y)

        at = self.at(back)
        m, observed = at.m, k.order * k.p
        u = self.saturated(self.law(at, "output", at.s))
        a = self.acceleration(m.terms, m.q, m.v, self.force(u, at.zeta))
        ds = at.s[observed:]
        if len(ds):
            ds = self.law(at, "flow", at.s, u)[observed:]
        w, E = self._coordinates(given[0])
        N = at.trace(split.remainder)(k, w, E, a, m.terms.kappa @ u, ds)
        return self.given(at, *N)

    def watch(self) -> Function:
        """What the guards look at."""
        robot, plant = self.make.robot, self.numbers.plant
        inp = Vector("inp", robot.n)
        t = planar.turned(robot, inp.take(robot.n))
        x, z = planar.point(t, plant.foot_re, plant.foot_im)
        _, hip = planar.point(t, plant.hip_re, plant.hip_im)
        return Function(self.K, inp.symbol, column(z + self.numbers.tan_slope * x, x, hip))

    def given(self, at: At, *parts: Any) -> Function:
        """The parts, and the least pivot."""
        out = column(*parts, at.trace.solver.least)
        return Function(self.K, at.inp.symbol, out)
