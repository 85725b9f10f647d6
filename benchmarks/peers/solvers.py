"""Solvers of the closed loop x' = f(t, x) on the package's machine code: SciPy's, and CVODE.

CVODE is called by scikit-sundae with Python between solver and right-hand side, and its own library through
ctypes without: the compiled flow stands behind a C callback, with the same settings (BDF, dense differences for
the Jacobian). scikit-sundae brings SUNDIALS as shared libraries.
"""

from __future__ import annotations

import ctypes
import importlib.util
from collections.abc import Callable
from ctypes import byref, c_double, c_int, c_long, c_void_p
from pathlib import Path
from typing import Any

import numba
import numpy as np
from llvmlite import binding
from numba import types
from scipy.integrate import solve_ivp

from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.errors import BipedError
from biped_adrc.core.types import Array
from biped_adrc.engine.kernels.call import call, intrinsic
from biped_adrc.engine.numbers import numbers_of
from biped_adrc.engine.program import Program

RTOL, ATOL, MOST_STEPS = 1e-6, 1e-9, 100_000
BDF, NORMAL = 2, 1
LIBRARIES = ("core", "nvecserial", "sunmatrixdense", "sunlinsoldense", "cvode")
POINTERS = ("N_VMake_Serial", "SUNDenseMatrix", "SUNLinSol_Dense", "CVodeCreate")
"""Functions that return one."""
_DATA = types.ExternalFunction("N_VGetArrayPointer", types.CPointer(types.float64)(types.voidptr))

Flow = Callable[[float, Array], Array]
Solve = Callable[[Flow, Array, Array], Array]
"""(f, x, times) -> X (len(times), nx) with times[0] the start."""


def program_of(walker: Walker) -> Program:
    """The machine code of a walker in continuous time."""
    return Program(walker.layout_of(np.zeros(2 * walker.plant.n)), numbers_of(walker))


def right_hand_side(walker: Walker, program: Program) -> Flow:
    """f(t, x) -> x' by machine code, called from Python in the first single support."""
    nx, n = program.nx, walker.plant.n
    function = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 3)(program.address("flow"))
    inp, out = np.zeros(3 + nx + n), np.zeros(nx + 1)
    inp[1] = 1.0
    at = (program.K.ctypes.data, inp.ctypes.data, out.ctypes.data)
    state = inp[3 : 3 + nx]

    def f(t: float, x: Array, code: Program = program) -> Array:
        inp[0], state[:] = t, x
        function(*at)
        return out[:nx].copy()

    return f


def scipy_solver(method: str, rtol: float = RTOL, atol: float = ATOL) -> Solve:
    """`solve_ivp` with one of its methods."""

    def solve(f: Flow, x: Array, times: Array) -> Array:
        span = (times[0], times[-1])
        found = solve_ivp(f, span, x, method=method, t_eval=times, rtol=rtol, atol=atol)
        if not found.success:
            raise BipedError(f"SciPy's {method}: {found.message}")
        states: Array = found.y.T
        return states

    return solve


def cvode() -> Solve:
    """CVODE's BDF of scikit-sundae. Raises ModuleNotFoundError without it."""
    from sksundae.cvode import CVODE

    def solve(f: Flow, x: Array, times: Array) -> Array:
        def into(t: float, y: Array, dy: Array) -> None:
            dy[:] = f(t, y)

        solver = CVODE(into, method="BDF", rtol=RTOL, atol=ATOL, max_num_steps=MOST_STEPS)
        found = solver.solve(times, x)
        if not found.success:
            raise BipedError(f"CVODE: {found.message}")
        states: Array = found.y
        return states

    return solve


def _libraries() -> list[Any]:
    """Those of SUNDIALS. Raises ModuleNotFoundError where scikit-sundae or its libraries are missing."""
    spec = importlib.util.find_spec("sksundae")
    if spec is None or spec.origin is None:
        raise ModuleNotFoundError("sksundae")
    folder = Path(spec.origin).parents[1] / "scikit_sundae.libs"
    found = []
    for name in LIBRARIES:
        paths = sorted(folder.glob(f"libsundials_{name}-*.so*"))
        if not paths:
            raise ModuleNotFoundError(f"no libsundials_{name} in '{folder}'")
        found.append(ctypes.CDLL(str(paths[0]), mode=ctypes.RTLD_GLOBAL))
    return found


@intrinsic
def floats_at(typingctx, address):  # type: ignore[no-untyped-def]
    """Pointer to the float64 at an address."""
    signature = types.CPointer(types.float64)(types.int64)

    def codegen(context, builder, signature, x):  # type: ignore[no-untyped-def]
        return builder.inttoptr(x[0], context.get_value_type(signature.return_type))

    return signature, codegen


def _callback(program: Program) -> Any:
    """int rhs(t, y, y', data) on the compiled flow, in the first single support and without a push."""
    address, nx, n = program.address("flow"), program.nx, program.numbers.plant.n
    K = program.K.ctypes.data

    @numba.cfunc(types.int32(types.float64, types.voidptr, types.voidptr, types.voidptr))
    def rhs(t, y, dy, data):  # type: ignore[no-untyped-def]
        work = numba.carray(data, (4 + 2 * nx + n,), np.float64)
        x, dx = numba.carray(_DATA(y), nx), numba.carray(_DATA(dy), nx)
        inp, out = work[: 3 + nx + n], work[3 + nx + n :]
        inp[0] = t
        inp[3 : 3 + nx] = x
        call(address, floats_at(K), floats_at(inp.ctypes.data), floats_at(out.ctypes.data))
        dx[:] = out[:nx]
        return 0

    return rhs


class CVODEInC:
    """CVODE on one walker's flow; call it with (x, times) for the states."""

    def __init__(self, program: Program, rtol: float = RTOL) -> None:
        self.tolerances = c_double(rtol), c_double(1e-3 * rtol)
        self.libraries = _libraries()
        for name in POINTERS:
            self._function(name).restype = c_void_p
        at = ctypes.cast(self._function("N_VGetArrayPointer"), c_void_p).value
        binding.add_symbol("N_VGetArrayPointer", at)
        self.program, self.rhs, self.context = program, _callback(program), c_void_p()
        self._call("SUNContext_Create", 0, byref(self.context))
        nx = program.nx
        self.x, self.work = np.zeros(nx), np.zeros(4 + 2 * nx + program.numbers.plant.n)
        self.work[1] = 1.0
        self._prepare(nx)

    def _function(self, name: str) -> Any:
        return next(getattr(one, name) for one in self.libraries if hasattr(one, name))

    def _call(self, name: str, *arguments: Any) -> Any:
        return self._function(name)(*arguments)

    def _checked(self, name: str, *arguments: Any) -> None:
        flag = self._call(name, *arguments)
        if flag < 0:
            raise BipedError(f"{name} returned {flag}")

    def _prepare(self, nx: int) -> None:
        """The solver in memory, with its settings."""
        data = c_void_p(self.x.ctypes.data)
        self.y = c_void_p(self._call("N_VMake_Serial", c_int(nx), data, self.context))
        self.memory = memory = c_void_p(self._call("CVodeCreate", BDF, self.context))
        rhs = ctypes.cast(self.rhs.ctypes, c_void_p)
        self._checked("CVodeInit", memory, rhs, c_double(0.0), self.y)
        self._checked("CVodeSStolerances", memory, *self.tolerances)
        self._checked("CVodeSetUserData", memory, c_void_p(self.work.ctypes.data))
        A = c_void_p(self._call("SUNDenseMatrix", c_int(nx), c_int(nx), self.context))
        solver = c_void_p(self._call("SUNLinSol_Dense", self.y, A, self.context))
        self._checked("CVodeSetLinearSolver", memory, solver, A)
        self._checked("CVodeSetMaxNumSteps", memory, c_long(MOST_STEPS))

    def __call__(self, x: Array, times: Array) -> Array:
        self.x[:] = x
        self._checked("CVodeReInit", self.memory, c_double(times[0]), self.y)
        states, t = [x.copy()], c_double()
        for end in times[1:].tolist():
            self._checked("CVode", self.memory, c_double(end), self.y, byref(t), NORMAL)
            states.append(self.x.copy())
        return np.array(states)
