"""The derivative of a sample instant ("tick"): how the state after a tick changes with the state before it.

    x+ = tick(t, x),   J = d x+ / d x                 x = (q, q', s, held)

s is the controller's state, `held` what is kept from tick to tick: readings of the sensors, and torques held or
on their way. `tick` is `closed_loop.semantics.tick`, traced as for machine code (`engine.equations`) and
differentiated by CasADi, so that J is exact for every controller that compiles. The expression is made once for
a structure, the classes and sizes of a walker's parts without the values of its floats, and evaluated in about
0.1 ms. A controller that does not compile has central differences in its place.
"""

from collections.abc import Callable, Hashable
from functools import partial

import casadi as ca
import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.errors import InputError, ModelError, NotFiniteError
from biped_adrc.core.tree import Layout
from biped_adrc.core.types import Array
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.numbers import numbers_of
from biped_adrc.engine.program import Program

_DIFFERENCE = 1e-6
"""Half width of the central differences [rad, rad/s, ..]."""


Ticked = Callable[[float, Array, Mode], tuple[Array, Array]]
"""(t [s], x (nx,), mode) -> x after the tick, and J (nx, nx)."""


def tick_derivative(walker: Walker, layout: Layout, exact: bool = False) -> Ticked:
    """Make the function (t, x, mode) -> x+, J of a walker in sampled time: its tick with the derivative.

    layout: of the walker's state x (nx,), as `Walker.layout_of` gives it. exact: refuse a controller that does
    not compile. Raises InputError for that, and for a walker in continuous time; the returned function raises
    NotFiniteError where x+ or J is not finite.
    """
    if walker.held is None:
        raise InputError(
            "the derivative of a tick was asked for, found a walker in continuous time; give "
            "timing=SampledTime(period)"
        )
    # the tick of the walk itself on symbols: a formula of its own would be a second text of every observer
    try:
        program, nx = Program(layout, numbers_of(walker)), layout.size
        function, K = _function(program), program.K
    except (NotCompiled, ModelError) as error:
        if exact:
            name = type(walker.controller).__name__
            raise InputError(
                f"the loop of {name} was asked for, which runs in Python, as it branches on numbers or calls a "
                "solver; expected a law that compiles, whose derivative is exact"
            ) from error
        return partial(_differenced, walker)
    # arrays that are written anew for each call; `columns` is J transposed, since CasADi stores by columns
    inputs = K, np.zeros(function.size1_in(1))
    after, columns = np.zeros(nx), np.zeros((nx, nx))
    # CasADi reads and writes the arrays by address, so `ticked` keeps the buffer; its matrices are column by
    # column
    buffer, evaluate = function.buffer()
    for i, array in enumerate(inputs):
        buffer.set_arg(i, array.data)  # type: ignore[call-arg]
    for i, array in enumerate((after, columns)):
        buffer.set_res(i, array.data)  # type: ignore[call-arg]

    def ticked(t: float, x: Array, mode: Mode, _: object = buffer) -> tuple[Array, Array]:
        # copies, since the next call writes to the same arrays
        inputs[1][: 3 + len(x)] = t, mode.step, mode.start, *x
        evaluate()
        return _finite(after.copy(), columns.T.copy())

    return ticked


_FUNCTIONS: dict[Hashable, ca.Function] = {}
"""Made in this process, by the key of their structure; a function is a value, so this is no state."""


def _function(program: Program) -> ca.Function:
    """CasADi's function (K, inp) -> (x+, J), K the walker's numbers, inp = (t, step, t_start, x, ..), of which
    the numbers behind x do not count here.

    It depends on the structure of the program alone, since the values of its numbers are the input K.
    """
    # key: the structure; out[:nx] is x+; 3: t, step and t_start stand before x; cse: common subexpressions
    key, nx = program.key, program.nx
    if key not in _FUNCTIONS:
        tick = program.equations.tick()
        after = ca.densify(tick.out[:nx])
        J = ca.densify(ca.jacobian(after, tick.inp)[:, 3 : 3 + nx])
        _FUNCTIONS[key] = ca.Function("tick", [tick.K, tick.inp], [after, J], {"cse": True})
    return _FUNCTIONS[key]


def _differenced(walker: Walker, t: float, x: Array, mode: Mode) -> tuple[Array, Array]:
    """x+ (nx,) of the tick in Python from x (nx,) at t [s], and J (nx, nx) by central differences.

    mode: number and start [s] of the single support. Raises NotFiniteError where a result is not finite.
    """
    # _DIFFERENCE: half width of the differences
    d, tick = _DIFFERENCE, partial(walker.tick, t)
    columns = [(tick(x + d * e, mode) - tick(x - d * e, mode)) / (2.0 * d) for e in np.eye(len(x))]
    return _finite(tick(x, mode), np.array(columns).T)


def _finite(after: Array, J: Array) -> tuple[Array, Array]:
    """Check that x+ and J are finite, and return them. Raises NotFiniteError."""
    if not (np.all(np.isfinite(after)) and np.all(np.isfinite(J))):
        raise NotFiniteError("the derivative of a tick is not finite at this state of the gait")
    return after, J
