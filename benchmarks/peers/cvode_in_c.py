"""CVODE's own library called without Python between solver and right-hand side.

scikit-sundae brings SUNDIALS as shared libraries. They are called here through ctypes, with the compiled flow
behind a C callback, and the settings of `solvers.cvode`: BDF, dense differences for the Jacobian.
"""

from __future__ import annotations

import ctypes
import importlib.util
from ctypes import byref, c_double, c_int, c_long, c_void_p
from pathlib import Path
from typing import Any

import numba
import numpy as np
from llvmlite import binding
from numba import types
from solvers import ATOL, RTOL, SolverFailed

from biped_adrc.engine.kernels.call import call
from biped_adrc.engine.program import Program
from biped_adrc.types import Array

BDF, NORMAL = 2, 1
LIBRARIES = ("core", "nvecserial", "sunmatrixdense", "sunlinsoldense", "cvode")
POINTERS = ("N_VMake_Serial", "SUNDenseMatrix", "SUNLinSol_Dense", "CVodeCreate")
"""What they hand back."""
_DATA = types.ExternalFunction("N_VGetArrayPointer", types.CPointer(types.float64)(types.voidptr))


def _functions() -> dict[str, Any]:
    """The libraries by name. Raises ModuleNotFoundError where scikit-sundae or its libraries are not."""
    spec = importlib.util.find_spec("sksundae")
    if spec is None or spec.origin is None:
        raise ModuleNotFoundError("sksundae")
    folder = Path(spec.origin).parents[1] / "scikit_sundae.libs"
    found = {}
    for name in LIBRARIES:
        paths = sorted(folder.glob(f"libsundials_{name}-*.so*"))
        if not paths:
            raise ModuleNotFoundError(f"no libsundials_{name} in '{folder}'")
        found[name] = ctypes.CDLL(str(paths[0]), mode=ctypes.RTLD_GLOBAL)
    return found


def _callback(program: Program) -> Any:
    """int rhs(t, y, y', data) on the compiled flow, in the first single support and without a push."""
    address, nx, n = program.address("flow"), program.nx, program.make.robot.n
    K = np.frombuffer(program.K)

    @numba.cfunc(types.int32(types.float64, types.voidptr, types.voidptr, types.voidptr))
    def rhs(t, y, dy, data):  # type: ignore[no-untyped-def]
        work = numba.carray(data, (4 + 2 * nx + n,), np.float64)
        x, dx = numba.carray(_DATA(y), nx), numba.carray(_DATA(dy), nx)
        inp, out = work[: 3 + nx + n], work[3 + nx + n :]
        inp[0] = t
        inp[3 : 3 + nx] = x
        call(address, K, inp, out)
        dx[:] = out[:nx]
        return 0

    return rhs


class CVODEInC:
    """One walker's flow; call it with (x, times) for the states, `evaluations` are of the last call."""

    def __init__(self, program: Program) -> None:
        lib = _functions()
        for name in POINTERS:
            self._of(lib, name).restype = c_void_p
        lib["core"].N_VGetArrayPointer.restype = c_void_p
        at = ctypes.cast(lib["core"].N_VGetArrayPointer, c_void_p).value
        binding.add_symbol("N_VGetArrayPointer", at)
        self.lib, self.program, self.rhs = lib, program, _callback(program)
        self.evaluations = 0
        self.context = c_void_p()
        lib["core"].SUNContext_Create(0, byref(self.context))
        self.x = np.zeros(program.nx)
        self.work = np.zeros(4 + 2 * program.nx + program.make.robot.n)
        self.work[1] = 1.0
        self._made()

    def _of(self, lib: dict[str, Any], name: str) -> Any:
        return next(getattr(part, name) for part in lib.values() if hasattr(part, name))

    def _call(self, name: str, *arguments: Any) -> Any:
        return self._of(self.lib, name)(*arguments)

    def _checked(self, name: str, *arguments: Any) -> None:
        flag = self._call(name, *arguments)
        if flag < 0:
            raise SolverFailed(f"{name} returned {flag}")

    def _made(self) -> None:
        nx, context = self.program.nx, self.context
        self.y = c_void_p(
            self._call("N_VMake_Serial", c_int(nx), c_void_p(self.x.ctypes.data), context)
        )
        self.memory = memory = c_void_p(self._call("CVodeCreate", BDF, context))
        rhs = ctypes.cast(self.rhs.ctypes, c_void_p)
        self._checked("CVodeInit", memory, rhs, c_double(0.0), self.y)
        self._checked("CVodeSStolerances", memory, c_double(RTOL), c_double(ATOL))
        self._checked("CVodeSetUserData", memory, c_void_p(self.work.ctypes.data))
        A = c_void_p(self._call("SUNDenseMatrix", c_int(nx), c_int(nx), context))
        solver = c_void_p(self._call("SUNLinSol_Dense", self.y, A, context))
        self._checked("CVodeSetLinearSolver", memory, solver, A)
        self._checked("CVodeSetMaxNumSteps", memory, c_long(100_000))

    def __call__(self, x: Array, times: Array) -> Array:
        self.x[:] = x
        self._checked("CVodeReInit", self.memory, c_double(times[0]), self.y)
        states, t, count = [x.copy()], c_double(), c_long()
        for end in times[1:].tolist():
            self._checked("CVode", self.memory, c_double(end), self.y, byref(t), NORMAL)
            states.append(self.x.copy())
        self._checked("CVodeGetNumRhsEvals", self.memory, byref(count))
        self.evaluations = count.value
        return np.array(states)
