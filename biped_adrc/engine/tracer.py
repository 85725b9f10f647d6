"""Copies of laws that run on symbols: NumPy, math and the linear solves are replaced by their twins.

`Tracer` copies a law and every function that it reaches; `run` calls the copy and says in which function an
error arose. The symbols themselves are in `engine.symbols`.
"""

from __future__ import annotations

import abc
import functools
import inspect
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

from biped_adrc import linear, parts
from biped_adrc.engine import symbols
from biped_adrc.engine.symbols import (
    HIDDEN,
    Hidden,
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
from biped_adrc.part import content, derived, is_part, with_content

OWN_BASES = ("biped_adrc.parts", "biped_adrc.shown")
"""Modules of bases that have no methods for laws."""
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
            (parts.returned, lambda found, *_, **__: found),
            (parts.point_returned, lambda found, *_: found),
            (parts.check_part, lambda *_: None),
        ]
        self._copies: dict[types.FunctionType, Any] = {}
        self._twins: dict[type, type] = {}

    def __call__(self, law: T) -> T:
        """The law for symbols, with every function that it reaches; what is no Python function
        stays as it is.

        A copy shares the code object and has its own globals and closure, in which names are
        replaced. Copies are remembered before their names are replaced, so laws that call each
        other end.
        """
        return self._copy(law, {}) if isinstance(law, types.FunctionType) else law

    def _copy(self, law: Any, classes: Mapping[type, type]) -> Any:
        """The copy of a function; classes: twins of classes whose methods say `super()`."""
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
                found = cell.cell_contents
                twin = classes.get(found) if isinstance(found, type) else None
                cell.cell_contents = self._substitute(found) if twin is None else twin
        return self._copies[law]

    def _substitute(self, value: object) -> object:
        """The twin of a value that a law names: of a module, a solver, a law, or a tuple of such."""
        for old, new in self._substitutes:
            if value is old:
                return new
        if isinstance(value, tuple | list):
            return rebuilt(value, [self._substitute(part) for part in value])
        if isinstance(value, HIDDEN):
            return Hidden(f"a {type(value).__name__}")
        return self.on_symbols(value) if is_part(value) else self(value)

    def on_symbols(self, part: T) -> T:
        """A part, and the parts in it, with methods for symbols; its content stays as it is."""
        values = {name: self._substitute(x) for name, x in content(part).items()}
        return with_content(part, values, self.twin(type(part)))

    def twin(self, cls: type) -> type:
        """A subclass of cls whose methods run on symbols, `super()` and properties included."""
        if cls.__module__ in ("builtins", "abc", "typing") or cls.__module__.startswith(OWN_BASES):
            return cls
        if cls not in self._twins:
            bases = [self.twin(base) for base in cls.__bases__]
            twins = [
                twin for twin, base in zip(bases, cls.__bases__, strict=True) if twin is not base
            ]
            made = types.new_class(cls.__name__, (*twins, cls))
            made.__module__, made.__qualname__ = cls.__module__, cls.__qualname__
            self._twins[cls] = made
            for name, value in vars(cls).items():
                if name == "__call__" or not name.startswith(("__", "_abc_")):
                    setattr(made, name, self._member(value, cls, made))
            abc.update_abstractmethods(made)
        return self._twins[cls]

    def _member(self, value: Any, cls: type, twin: type) -> Any:
        """What stands in the twin for a method, property or other member of a class."""
        if isinstance(value, types.FunctionType):
            return self._copy(inspect.unwrap(value), {cls: twin})
        if isinstance(value, property):
            return property(self._member(value.fget, cls, twin))
        if isinstance(value, functools.cached_property) and not isinstance(value, derived):
            return property(self._member(value.func, cls, twin))
        if isinstance(value, staticmethod):
            return staticmethod(self(value.__func__))
        return value


def run(trace: Tracer, law: Callable[..., T], *arguments: object) -> T:
    """What a law gives on symbols, at these arguments.

    Raises Untraceable that names the last function of the user's or this package's in which the
    error arose, since the error itself comes from inside NumPy or CasADi.
    """
    try:
        return trace(law)(*map(trace._substitute, arguments))
    except Exception as error:  # whatever NumPy says of an object that is no float
        raise Untraceable(f"{_place(error, law)} cannot be compiled: {error}") from error


def _place(error: Exception, law: Any) -> str:
    """The last line of the user's or this package's at which an error arose: PD.output (own.py:12, `if x > 0:`)."""
    frames = traceback.extract_tb(error.__traceback__)
    codes = [frame.f_code for frame, _ in traceback.walk_tb(error.__traceback__)]
    own = [
        pair
        for pair in zip(codes, frames, strict=True)
        if not pair[1].filename.startswith(LIBRARIES)
    ]
    if not own:
        return str(getattr(law, "__qualname__", law))
    code, frame = own[-1]
    name = code.co_qualname.replace(".<locals>", "")
    return f"{name} ({Path(frame.filename).name}:{frame.lineno}, `{frame.line}`)"


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
