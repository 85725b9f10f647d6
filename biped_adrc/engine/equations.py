"""The equations of a walker on symbols, one straight-line function each, traced from the parts' own methods.

    flow      (t, step, t_start, x, zeta) -> x'               (10); in sampled time the torque is held
    tick      (t, step, t_start, x, zeta, force) -> x, q''    sensors, controller, motors
    impact    (t, step, x) -> x+                              (7), (8), relabelling, controller's jump
    events    (t, t_start, drop, q) -> event functions, x of the swing foot
    reading   (t, step, t_start, x, ..) -> what is read off the loop, such as `closed_loop.instant_signals`
    push      (t, step, t_start, q, v) -> zeta, force         of the disturbance, with numbers of its own
    to, back, remainder                                       x -> y, y -> x, y -> N: the exponential method in
                                                              y = (w, E), E' = A E + N_E stiff, w' = N_w

t [s] is the time, step the number of the single support, t_start [s] its start, x (nx,) the state, and drop [m]
how much lower the ground is where the single support ends. `force` (2,) [N], from outside on the robot as a
whole, changes what a foot carries. zeta (n,) [N m] is an input, so that another disturbance does not compile
the walker again.
flow, tick, impact and remainder add, after their result, the least pivot, the smallest |pivot| of the matrices
that the controller inverts: 0 where one is singular, infinite where it inverts none. flow, tick and remainder
have -1 in its place where a torque is beyond the walker's bound.

The functions of `closed_loop.semantics` run on a `SymbolicLoop`, so their lines become generated code. The
structure of `WalkerNumbers` decides the code; their floats are the vector K at run time. `engine.program` asks
for these functions and compiles them; the loops in `engine.kernels` call them by address. A tick is a sample
instant. Numbers such as (10) are equations of the paper.
"""

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from operator import methodcaller
from typing import Any, NamedTuple

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from biped_adrc.closed_loop import semantics
from biped_adrc.closed_loop.protocols import ControlLaw, FootForces, Mode
from biped_adrc.closed_loop.walker import ErrorForm, remainder
from biped_adrc.control.base import Measurement
from biped_adrc.control.outer_loop import tracked_point
from biped_adrc.core.tree import Layout, chosen
from biped_adrc.core.types import Array, T
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.engine.kernels.record import OUTSIDE
from biped_adrc.engine.not_compiled import Located, NotCompiled
from biped_adrc.engine.numbers import NONE, Reading, WalkerNumbers
from biped_adrc.engine.symbols import Scalar, Vector, column, maximum, minimum, symbols_of, where
from biped_adrc.engine.tracer import Tracer, apply
from biped_adrc.hardware.sample_hold import HeldParts, Tail
from biped_adrc.model.planar_robot import PlanarRobot


class SymbolicLoop(NamedTuple):
    """A `protocols.Loop` of symbols; zeta (n,) [N m] and `force` (2,) [N] are inputs."""

    plant: PlanarRobot
    """The robot that moves, on symbols."""
    nominal: PlanarRobot
    """The controller's model, on symbols; the plant's own where no other model is given."""
    numbers: WalkerNumbers
    """All numbers of the walker, on symbols."""
    trace: Tracer
    """Makes copies of functions for symbols, and keeps the pivots."""
    calls: ControlLaw
    """The controller's methods in its time base."""
    held: HeldParts | None
    """Parameters of what is held between sample instants, None in continuous time."""
    layout: Layout
    """Layout of a state x."""
    torques: list[Scalar]
    """All torques computed so far; none may be beyond `numbers.strongest`."""
    zeta: Array
    """Disturbance (n,) [N m]."""
    force: Array
    """Force from outside on the robot as a whole (2,) [N]; on the two feet for a plant that moves by itself."""

    @property
    def exact(self) -> bool:
        """Whether the controller's model is the plant; joint friction is in no model of a controller."""
        return self.numbers.model is None and not self.plant.friction

    def layout_of(self, x: Array) -> Layout:
        """The layout of a state x, the same for all of them."""
        return self.layout

    def measure(self, t: float, q: Array, v: Array, mode: Mode) -> Measurement:
        """The measurement at q (n,) [rad], v (n,) [rad/s], always with the `BodyTerms`: terms that no method
        uses leave no code.
        """
        return semantics.measurement(self, t, q, v, mode, body=True)

    def saturate(self, u: Array) -> Array:
        """u (p,) [N m] within the limit, which may be infinite."""
        limit = self.numbers.torque_limit
        return np.array([minimum(maximum(x, -limit), limit) for x in u], dtype=object)

    def jumped(self, fires: float, s: Any, m: Measurement) -> Any:
        """s after the controller's jump to the measurement m where `fires` is 1, else s as it is.

        fires: 1 at a tick at which the controller notices a touchdown, else 0.
        """
        return self.trace(chosen)(fires, self.calls.jump(s, m, self.plant.swap), s)

    def checked(self, part: Any, method: str, before: Any, after: Any) -> Any:
        """The state `after` that a method of a part returned, of the layout of the state `before`."""
        return _alike(before, after, f"{type(part).__name__}.{method}")

    def foot_forces(self, t: float, q: Array, v: Array, tail: Tail, mode: Mode) -> FootForces:
        """Vertical forces of the ground on stance and swing foot [N]: inputs where the plant moves by
        itself."""
        if self.numbers.moves:
            return self.force[0], self.force[1]
        return semantics.on_stance_foot(self, self.force, t, q, v, tail, mode)

    def bounded(self, u: Array) -> Array:
        """Return u (p,) [N m] unchanged, and remember it for `lost`, which tests all torques."""
        self.torques.extend(u)
        return u

    @property
    def lost(self) -> Scalar:
        """The number that each function returns behind its result: the least pivot, or -1 where a torque is
        beyond the bound.
        """
        least = self.trace.solver.least
        if not self.torques:
            return least
        # an infinite torque, or one of a singular matrix, is no such case: it ends the run by another status
        # (comparisons of symbols are 1 or 0, so their product means "and")
        u = functools.reduce(maximum, map(abs, self.torques))
        return where((u > self.numbers.strongest) * (u < math.inf) * (least > 0.0), -1.0, least)

    def external(self, t: float, q: Array, v: Array, mode: Mode) -> Array:
        """The symbols of zeta (n,) [N m], which are inputs, so that time and state do not matter here."""
        return self.zeta


class SymbolicInstant(NamedTuple):
    """The symbols of one instant, and the loop whose functions get them."""

    inp: Vector
    """All inputs of the generated function, as one vector."""
    loop: SymbolicLoop
    """The loop, with zeta and `force` from the same inputs."""
    t: float
    """Time [s]."""
    x: Array
    """State (nx,)."""
    mode: Mode
    """Number of the single support and its start [s]."""

    def does(self, function: Callable[..., T], *more: object) -> T:
        """The result of function(loop, t, x, mode, *more) on the symbols of this instant; a function of
        `semantics`, or one with the same first arguments.
        """
        return self.loop.trace(function)(self.loop, self.t, self.x, self.mode, *more)


class SymbolicFunction(NamedTuple):
    """A function `void f(double* K, double* inp, double* out)` before it is compiled, as CasADi's columns."""

    K: ca.SX
    """Symbols of the parameters."""
    inp: ca.SX
    """Symbols of the inputs."""
    out: ca.SX
    """Expressions of the outputs."""
    acts: ca.SX | None = None
    """Expression of K and inp: where it is not above 0, out is zero. None: out is always computed."""


def _alike(before: Any, after: Any, what: str) -> Any:
    """The state `after` on symbols. Raises NotCompiled for another layout than that of the state `before`, on
    which the walk runs in Python, which names the line. what: the method that returned it.
    """
    if Layout.of(after) != Layout.of(before):
        raise Located(f"{what} gives a state of another class or shape than at the start")
    return after


def _jumped(jump: Callable[..., Any], law: type, s: Any, *more: object) -> Any:
    """The result of a controller's jump on symbols, which alone is not tried at the start of a run."""
    return _alike(s, jump(s, *more), f"{law.__name__}.jump")


@dataclass(frozen=True)
class Equations:
    """The functions of walkers of one structure; each of the methods below traces one of them.

    `at()` makes the symbols of the inputs: `inp`, all of them as one column; `does(f)`, what a function f of
    `semantics` gives for them; and their `loop`, whose `lost` is the least pivot. `function(inp, ..)` makes a
    compiled function of the inputs and of expressions as outputs.
    """

    layout: Layout
    """Layout of a state x."""
    numbers: WalkerNumbers
    """The walker's numbers by name; their structure decides the code."""

    @cached_property
    def symbols(self) -> tuple[ca.SX, WalkerNumbers]:
        """CasADi's column K of symbols for the floats of `numbers`, and `numbers` with them in place of
        floats."""
        return symbols_of(self.numbers)

    @property
    def nx(self) -> int:
        """Numbers in a state."""
        return self.layout.size

    def loop(self, zeta: Array = NONE, force: Array = NONE) -> SymbolicLoop:
        """The closed loop on symbols, with zeta (n,) [N m] and the force from outside (2,) [N].

        It has a new tracer, so that pivots and torques are those of one generated function.
        """
        # K: the walker's numbers as symbols. `sparse` has a plain 0 for terms that the robot does not have
        (_, K), trace = self.symbols, Tracer()
        plant, model = (trace.on_symbols(x.sparse) for x in (K.plant, K.model or K.plant))
        law, held = trace.on_symbols(K.controller), trace.on_symbols(K.held) if K.held else None
        # the controller's methods, each to be copied for symbols where it is called
        calls = ControlLaw(*(partial(apply, trace, getattr(law, x)) for x in ControlLaw._fields))
        calls = calls._replace(jump=partial(_jumped, calls.jump, type(self.numbers.controller)))
        # []: no torque is computed yet
        return SymbolicLoop(plant, model, K, trace, calls, held, self.layout, [], zeta, force)

    def at(self) -> SymbolicInstant:
        """Make the symbols of the inputs (t, step, t_start, x, zeta, force), in this order, and a loop for
        them."""
        n = self.numbers.plant.n
        # OUTSIDE: the two numbers of `force`
        inp = Vector("inp", 3 + self.nx + n + OUTSIDE)
        t, mode, x = inp.take(), Mode(inp.take(), inp.take()), inp.take(self.nx)
        return SymbolicInstant(inp, self.loop(inp.take(n), inp.take(OUTSIDE)), t, x, mode)

    def function(self, inp: Vector, *parts: ArrayLike | Scalar) -> SymbolicFunction:
        """The function of the inputs `inp` whose outputs are these expressions, one after the other."""
        return SymbolicFunction(self.symbols[0], inp.symbol, column(*parts))

    def flow(self) -> SymbolicFunction:
        """x' (nx,) between events, and the least pivot."""
        at = self.at()
        return self.function(at.inp, at.does(semantics.flow), at.loop.lost)

    def tick(self) -> SymbolicFunction:
        """x (nx,) after a sample instant, the least pivot, and q'' (n,) [rad/s^2] under the new torque.

        Without q'' for a plant that moves by itself, such as MuJoCo's, which has its own.
        """
        at, n = self.at(), self.numbers.plant.n
        x = at.does(semantics.tick)
        if self.numbers.moves:
            return self.function(at.inp, x, at.loop.lost)
        a = at._replace(x=x).does(semantics.flow)[n : 2 * n]  # x' = (q', q'', ..)
        return self.function(at.inp, x, at.loop.lost, a)

    def view(self, read: Reading) -> SymbolicFunction:
        """The function whose result is all that `read` returns, its arrays joined into one column.

        Errors are taken from the reference `numbers.curve`; without one, `read` gets None as reference.
        """
        at, curve = self.at(), self.symbols[1].curve
        tracked = None if curve is None else partial(apply, at.loop.trace, tracked_point, curve)
        return self.function(at.inp, *at.does(read, tracked))

    def impact(self) -> SymbolicFunction:
        """x+ (nx,) after impact, relabelling and the controller's jump; `step` is the single
        support that begins.
        """
        # Mode(step, t), since that single support begins now
        inp, loop = Vector("inp", 2 + self.nx), self.loop()
        t, step, x = inp.take(), inp.take(), inp.take(self.nx)
        # `strike`: impact map, relabelling of the legs and the controller's jump
        x = loop.trace(semantics.strike)(loop, t, x, Mode(step, t), loop.numbers.impact_gain)
        # lost: the least pivot, or -1 where a torque is beyond the bound
        return self.function(inp, x, loop.lost)

    def events(self) -> SymbolicFunction:
        """The three event functions: clearance of the swing foot [m], height of the hip over its limit [m],
        time left for the single support [s]; then x of the swing foot from the stance foot [m].
        """
        K, plant = self.symbols[1], self.loop().plant
        inp = Vector("inp", 3 + plant.n)
        t, start, drop, q = inp.take(), inp.take(), inp.take(), inp.take(plant.n)
        foot = plant.swing_foot(q)
        clearance = semantics.clearance(K.tan_slope, drop, foot)
        hip = semantics.hip_margin(K.lowest_hip, plant.hip(q))
        return self.function(inp, clearance, hip, semantics.time_left(K.longest, start, t), foot[0])

    def _split(self, trace: Tracer) -> ErrorForm:
        """The change of coordinates x -> (w, E) of the exponential method, as an object on symbols."""
        # symbols: (the vector K, the numbers with K's symbols in place of floats)
        return trace.on_symbols(self.symbols[1].split)

    def _coordinates(self, y: Array) -> tuple[Array, Array]:
        """w and E (k, p) of the vector y = (w, E), in which E is stored row by row."""
        assert self.numbers.split is not None
        p = self.numbers.plant.p
        stiff = len(self.numbers.split.A) * p
        return y[: len(y) - stiff], y[len(y) - stiff :].reshape(-1, p)

    def to(self) -> SymbolicFunction:
        """y = (w, E) of x (nx,)."""
        inp = Vector("inp", self.nx)
        return self.function(inp, *self._split(Tracer()).to(inp.take(self.nx)))

    def back(self) -> SymbolicFunction:
        """x (nx,) of y = (w, E)."""
        inp = Vector("inp", self.nx)
        w, E = self._coordinates(inp.take(self.nx))
        return self.function(inp, self._split(Tracer()).back(w, E))

    def remainder(self) -> SymbolicFunction:
        """The function (t, step, t_start, y, zeta, force) -> N_w, row 1 (from 0) of N_E (k, p), least pivot.

        It has y = (w, E) in place of x. The other rows of N_E are zero.
        """
        at = self.at()
        w, E = self._coordinates(at.x)
        form = self._split(at.loop.trace)  # the change of coordinates x -> (w, E), on symbols
        # the function `closed_loop.walker.remainder`, copied for symbols
        N = at.loop.trace(remainder)(at.loop, form, at.t, w, E, at.mode)
        return self.function(at.inp, *N, at.loop.lost)


def matvec_function(k: int, p: int) -> SymbolicFunction:
    """The function M E of E (k, p), for a matrix M (k, k) of the exponential method, which is its argument
    K."""
    M, E = Vector("M", k * k), Vector("E", k * p)
    return SymbolicFunction(M.symbol, E.symbol, column(M.take(k, k) @ E.take(k, p)))


def method_function(part: Any, method: str, inputs: Layout) -> SymbolicFunction:
    """The method of a part as a function of arguments that have the layout `inputs`, joined to one vector; the
    method gives an array or a tuple of arrays. Raises NotCompiled for one that cannot be traced.
    """
    # symbols: the part with symbols in place of its numbers
    (K, symbols), inp = symbols_of(part), Vector("inp", inputs.size)
    # `sparse` of a robot: terms that this robot does not have are a plain 0 and vanish from the code
    symbols = symbols.sparse if isinstance(symbols, PlanarRobot) else symbols
    out = apply(Tracer(), methodcaller(method, *inputs.tree(inp.take(inputs.size))), symbols)
    return SymbolicFunction(K, inp.symbol, column(*(out if isinstance(out, tuple) else (out,))))


def push_function(term: Disturbance, n: int) -> SymbolicFunction:
    """The function (t, step, t_start, q, v) -> zeta (n,) [N m] and force from outside (2,) [N] of one term of a
    disturbance.

    Where `term.acts` is not above 0 the code computes nothing and gives zeros, since most pushes act for a
    small part of a walk. Raises NotCompiled for a term that cannot be traced or returns other shapes.
    """
    (K, symbols), inp, trace = symbols_of(term), Vector("inp", 3 + 2 * n), Tracer()
    when, state = (inp.take(), inp.take(), inp.take()), (inp.take(n), inp.take(n))
    zeta = apply(trace, methodcaller("torque", *when, *state), symbols)
    force = apply(trace, methodcaller("resultant", *when), symbols)
    if (np.shape(zeta), np.shape(force)) != ((n,), (2,)):
        raise NotCompiled(f"{type(term).__name__} gives no ({n},) torque or no (2,) resultant")
    acts = None  # a term whose class does not write `acts` is always computed
    if type(term).acts is not Disturbance.acts:
        acts = column(apply(trace, methodcaller("acts", *when), symbols))
    return SymbolicFunction(K, inp.symbol, column(zeta, force), acts)
