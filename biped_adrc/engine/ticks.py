"""Sample instants and impacts in Python, of a walker that otherwise moves in machine code.

The march, the compiled loop over time, calls them by address, as it calls compiled functions f(K, inp, out).
Where nothing but the torque is held between sample instants (no sensors, motors, delay or detector of
touchdowns), one call of machine code computes what a controller gets at a sample instant: the nominal model's
terms, and the point of the controller's reference there, which the reference then returns when it is called.

In the state x = (q, q', s, tail) s is the controller's state, and the tail has the numbers of sensors and
motors, the torque last.
"""

import ctypes
import math
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import lru_cache, partial

import numpy as np

from biped_adrc.closed_loop import semantics
from biped_adrc.closed_loop.instant_signals import controller_inputs
from biped_adrc.closed_loop.semantics import State
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.control.outer_loop import tracked_point
from biped_adrc.core.tree import Layout, flatten
from biped_adrc.core.types import Array, frozen
from biped_adrc.engine.calls import FUNCTION, CompiledReference
from biped_adrc.engine.program import CompiledWalker, Program
from biped_adrc.gait.reference import ReferencePoint
from biped_adrc.model.reduction import Reduction

BLOCK, TERMS = 256, len(Reduction._fields)
"""Number of sample instants whose inputs share one array; number of arrays in the model's terms."""


@lru_cache(maxsize=64)
def _numbers_at(address: int, size: int) -> Array:
    """The numbers (size,) in memory at an address, as a view; remembered, since a run has few addresses."""
    return np.ctypeslib.as_array((ctypes.c_double * size).from_address(address))


class PythonTicks:
    """The functions `tick` and `impact` of a compiled run (`kernels.record.Run`), computed by a walker's own
    methods.

    `tick` writes no q'' behind its result. An exception of a method is kept as `error` and the result is NaN,
    by which the march ends as NOT_FINITE; the caller of the march then raises or reports `error`.
    """

    def __init__(
        self, compiled: CompiledWalker, walker: Walker, references: Sequence[CompiledReference]
    ):
        """compiled: into its plan the addresses of the two functions are written. walker: its methods are
        called; references: those of its controller that are in machine code, which `run.compiled_plant` gives.
        """
        self.walker, self.nx = walker, compiled.program.nx
        self.error: BaseException | None = None
        # ideal: nothing but the torque (p,) is held
        tail = compiled.program.layout.parts[State._fields.index("tail")]
        ideal = walker.sensors is None and walker.motors is None and tail.size == walker.plant.p
        # only the first reference is known beforehand; any other is computed when it is called
        tick = self._measured(compiled.program, references[:1]) if ideal else self._tick
        # kept here, since ctypes frees a function that Python no longer names
        self.functions = [FUNCTION(partial(self._called, f)) for f in (tick, self._impact)]
        for name, function in zip(("tick", "impact"), self.functions, strict=True):
            compiled.plan[name] = ctypes.cast(function, ctypes.c_void_p).value or 0

    @contextmanager
    def interrupted(self) -> Iterator[None]:
        """Context in which Ctrl-C just before a method is kept as `error` too; ctypes alone would only print
        it.

        Python raises KeyboardInterrupt in its main thread alone, so other threads keep their hook.
        """
        before = sys.unraisablehook

        def keep(lost: "sys.UnraisableHookArgs") -> None:
            if isinstance(lost.exc_value, KeyboardInterrupt):
                self.error = lost.exc_value
            else:
                before(lost)

        main = threading.current_thread() is threading.main_thread()
        sys.unraisablehook = keep if main else sys.unraisablehook
        try:
            yield
        finally:
            sys.unraisablehook = before if main else sys.unraisablehook

    def _called(self, method: Callable[[int, Array], None], K: int, inp: int, out: int) -> None:
        """Write what a method computes from the numbers at the address `inp` to the address `out`, and behind
        it 1 for the least pivot, which means "not singular"; all NaN where it raises. K is not used.
        """
        result = _numbers_at(out, self.nx + 1)
        try:
            method(inp, result)
            result[-1] = 1.0
        except BaseException as error:  # goes on where the march was called
            self.error, result[:] = error, math.nan

    def _tick(self, inp: int, result: Array) -> None:
        """Write x (nx,) after the sample instant to `result` but for its last number, the least pivot, which
        `_called` writes; from (t, step, t_start, x) at the address `inp`."""
        t, step, start, *x = _numbers_at(inp, 3 + self.nx).tolist()
        result[:-1] = self.walker.tick(t, np.array(x), Mode(int(step), start))

    def _impact(self, inp: int, result: Array) -> None:
        """Write x+ (nx,) after the impact to `result`, from (t, step, x) at the address `inp`; step is that of
        the single support that begins.
        """
        # `impact` takes the mode that ends; it does not read when that began
        t, step, *x = _numbers_at(inp, 2 + self.nx).tolist()
        result[:-1] = self.walker.impact(t, np.array(x), Mode(int(step) - 1))[0]

    def _measured(
        self, program: Program, references: Sequence[CompiledReference]
    ) -> Callable[[int, Array], None]:
        """Make the function that replaces `_tick` for a walker that holds the torque alone between sample
        instants.

        Machine code computes the controller's inputs: the nominal model's terms, and the point of the only
        reference in `references`, which may also be empty.
        """
        walker, nx, n = self.walker, self.nx, self.walker.plant.n
        s_layout = walker.layout_of(np.zeros(nx)).parts[State._fields.index("s")]
        # curve: the reference whose point machine code computes along with the model's terms
        curve = references[0].reference if references else None
        program = replace(program, numbers=program.numbers._replace(curve=curve))
        tracked = None if curve is None else partial(tracked_point, curve)
        example = controller_inputs(walker, 0.0, np.zeros(nx), Mode(), tracked)
        self.code, self.K = program.reading(controller_inputs), program.K
        function = FUNCTION(self.code.addresses["reading"])
        rows = input_rows(Layout.of(example))
        # body: whether the controller reads the terms of the whole robot; end: where the torque begins in x
        body, end, K = walker.law.needs_body, nx - walker.plant.p, self.K.ctypes.data

        def tick(inp: int, result: Array) -> None:
            # row: address to which machine code writes; q, v, parts: read-only arrays on that memory
            row, (q, v, *parts) = next(rows)
            function(K, inp, row)
            numbers = _numbers_at(inp, 3 + nx)
            (t, step, start), x = numbers[:3].tolist(), numbers[3:]
            # TERMS: number of arrays in the model's terms
            mode, terms = Mode(int(step), start), Reduction._make(parts[:TERMS])
            # the controller evaluates its reference at these q and v, and gets this point without a second call
            # (`known`: its arguments, which are compared by identity, and the point)
            for r in references:
                r.known = t, q, v, ReferencePoint._make(parts[TERMS:])
            m = semantics.measurement(walker, t, q, v, mode, body, terms)
            # as `semantics.tick` without sensors, motors and delay: the last p numbers of x are the torque
            s, u = semantics.command(walker, s_layout.tree(frozen(x[2 * n : end].copy())), m)
            s = walker.calls.predict(s, m, u)
            result[: 2 * n], result[2 * n : end], result[end:nx] = x[: 2 * n], flatten(s), u

        return tick


def input_rows(layout: Layout) -> Iterator[tuple[int, tuple[Array, ...]]]:
    """Yield memory for what machine code computes at each sample instant: an address, and read-only arrays of
    this layout that begin there, one after the other.

    No memory is given out twice, since a controller may keep its inputs. Blocks of rows are allocated at once.
    """
    while True:
        # BLOCK sample instants share one array
        block = np.zeros((BLOCK, layout.size))
        block.setflags(write=False)
        parts = zip(*layout.tree(block), strict=True)
        starts = block.ctypes.data + block.strides[0] * np.arange(BLOCK)
        yield from zip(starts.tolist(), parts, strict=True)
