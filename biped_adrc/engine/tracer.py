"""Copies of laws that run on symbols: NumPy, math and the linear solves are replaced by their twins.

`Tracer` copies a law and every function that it reaches; `run` calls the copy and says in which function an
error arose. The symbols themselves are in `engine.symbols`.
"""

from __future__ import annotations

import math
import traceback
import types
from collections.abc import Callable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from biped_adrc import linear
from biped_adrc.engine import symbols
from biped_adrc.engine.symbols import (
    Solver,
    T,
    Untraceable,
    elementwise,
    function_of,
    maximum,
    minimum,
    rebuilt,
    solve_positive,
    where,
)

FUNCTIONS = {
    **{name: name for name in ("sin", "cos", "tan", "sqrt", "exp", "log", "sinh", "cosh", "tanh")},
    **{f"arc{name}": f"a{name}" for name in ("sin", "cos", "tan")},
    "fabs": "fabs",
    "floor": "floor",
    "sign": "sign",
}
"""Functions of one number that can be traced: NumPy's names and CasADi's."""


class _Substitute:
    """A module some of whose functions are replaced; every other name is the module's own."""

    def __init__(self, module: types.ModuleType, replaced: Mapping[str, object]):
        self._module = module
        self.__dict__.update(replaced)

    def __getattr__(self, name: str) -> object:
        return getattr(self._module, name)


def _filled(value: float) -> Callable[..., NDArray[np.object_]]:
    """A function like np.zeros or np.ones that makes object arrays, whose entries may become Scalars."""
    return lambda shape, *_, **__: np.full(shape, value, dtype=object)


BUILTINS: Mapping[str, Callable[..., object]] = {
    "float": lambda x: x,
    "abs": np.abs,
    "min": minimum,
    "max": maximum,
}
"""What laws find under these names in place of Python's: no float(), and no choice by a number."""


class Tracer:
    """Copies of laws that run on symbols, with one solver for all, so that `solver.least` covers them all."""

    def __init__(self) -> None:
        """The replacements, by identity of what laws name: NumPy, math, and the two functions of `linear`."""
        self.solver = Solver()
        functions = {name: elementwise(function_of(theirs)) for name, theirs in FUNCTIONS.items()}
        numpy = {
            **functions,
            "zeros": _filled(0.0),
            "ones": _filled(1.0),
            "empty": _filled(0.0),
            "full": lambda shape, value, *_: np.full(shape, value, dtype=object),
            "eye": lambda n, *rest, **more: np.eye(n, *rest, **more).astype(object),
            "zeros_like": lambda a, *_, **__: np.full(np.shape(a), 0.0, dtype=object),
            "diag": lambda a: np.diag(np.asarray(a, dtype=object)),
            "minimum": elementwise(minimum),
            "maximum": elementwise(maximum),
            "clip": elementwise(lambda x, low, high: minimum(maximum(x, low), high)),
            "where": elementwise(where),
            "abs": np.abs,
            "float64": lambda x: x,
            "linalg": _Substitute(np.linalg, {"solve": self.solver}),
        }
        scalars = {name: function_of(theirs) for name, theirs in FUNCTIONS.items()}
        scalars |= {f"a{name}": function_of(f"a{name}") for name in ("sin", "cos", "tan")}
        self._substitutes: list[tuple[object, object]] = [
            (np, _Substitute(np, numpy)),
            (math, _Substitute(math, scalars)),
            (linear.solve, self.solver),
            (linear.solve_positive, solve_positive),
        ]
        self._copies: dict[types.FunctionType, Any] = {}

    def __call__(self, law: T) -> T:
        """The law for symbols, with every function that it reaches; what is no Python function
        stays as it is.

        A copy shares the code object and has its own globals and closure, in which names are
        replaced. Copies are remembered before their names are replaced, so laws that call each
        other end.
        """
        if not isinstance(law, types.FunctionType):
            return law
        if law not in self._copies:
            scope = {**BUILTINS, **law.__globals__}
            cells = [types.CellType(c.cell_contents) for c in law.__closure__ or ()]
            copy = types.FunctionType(
                law.__code__, scope, law.__name__, law.__defaults__, tuple(cells) or None
            )
            copy.__kwdefaults__ = law.__kwdefaults__
            self._copies[law] = copy
            for name in names_of(law.__code__):
                if name in scope:
                    scope[name] = self._substitute(scope[name])
            for cell in cells:
                cell.cell_contents = self._substitute(cell.cell_contents)
        return self._copies[law]

    def _substitute(self, value: object) -> object:
        """The twin of a value that a law names: of a module, a solver, a law, or a tuple of such."""
        for old, new in self._substitutes:
            if value is old:
                return new
        if isinstance(value, tuple | list):
            return rebuilt(value, [self._substitute(part) for part in value])
        return self(value)


def run(trace: Tracer, law: Callable[..., T], *arguments: object) -> T:
    """What a law gives on symbols, at these arguments.

    Raises Untraceable that names the last function of the user's or this package's in which the
    error arose, since the error itself comes from inside NumPy or CasADi.
    """
    try:
        return trace(law)(*arguments)
    except Exception as error:  # whatever NumPy says of an object that is no float
        frames = [frame.f_code for frame, _ in traceback.walk_tb(error.__traceback__)]
        own = [code for code in frames if not code.co_filename.startswith(LIBRARIES)]
        where = own[-1] if own else law.__code__
        place = f"{Path(where.co_filename).stem}.{where.co_qualname}".replace(".<locals>", "")
        reason = f"law '{place}' cannot be compiled: {error}"
        raise Untraceable(reason) from error


LIBRARIES = (
    __file__,
    symbols.__file__,
    str(Path(np.__file__).parent),
    str(Path(ca.__file__).parent),
)
"""Folders of the functions that laws call and that are no laws themselves; errors there are put
down to the law.
"""


@lru_cache(maxsize=1024)
def names_of(code: types.CodeType) -> frozenset[str]:
    """The global names and attributes that a piece of code, and code defined inside it, looks up."""
    inner = (names_of(x) for x in code.co_consts if isinstance(x, types.CodeType))
    return frozenset(code.co_names).union(*inner)
