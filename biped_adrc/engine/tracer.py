"""Copies of laws that run on symbols in place of numbers, which is how the compiler gets their expressions.

A law is a method of a controller, reference, disturbance or other part (a dataclass of `core.part`), written
for NumPy arrays. `Tracer` copies its function and every function that this one calls; in the copies the names
of NumPy's, math's and `core.linear`'s functions lead to twins, functions that do the same on symbols. The twin
of a class is a subclass whose methods are such copies; the twin of a part is an object of that subclass.
`apply` calls a copy and says in which function an error arose. A symbol is a `Scalar` of `engine.symbols`.
"""

import abc
import dis
import functools
import inspect
import math
import random as stdlib_random
import sys
import types
from collections.abc import Callable, Mapping
from dataclasses import is_dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from biped_adrc.core import checks, linear
from biped_adrc.core.part import Part, content, derived, is_part, with_content
from biped_adrc.core.types import T, frozen, of_kind
from biped_adrc.engine import symbols
from biped_adrc.engine.not_compiled import Located, NotCompiled, located
from biped_adrc.engine.structure import HIDDEN, is_library
from biped_adrc.engine.symbols import Scalar, elementwise, maximum, minimum


def _filled(value: float) -> Callable[..., NDArray[np.object_]]:
    """A function like np.zeros (value 0) or np.ones (value 1) that makes an object array, which a law may fill
    with symbols; an array with dtype=int stays one of whole numbers.
    """
    # `Float` stands for `float` in copies; to NumPy it is a class without a dtype, so the dtype is object
    return lambda shape, dtype=Float, **_: np.full(shape, value, dtype=dtype)


ENGINE = "biped_adrc.engine"
"""Package whose functions and classes are not copied: they work on symbols as they are."""
NO_METHODS = (ENGINE, "biped_adrc.core.checks", "biped_adrc.core.shown")
"""Modules whose classes are not copied, since no law calls their methods on symbols."""
OF_NUMBERS = (np, np.linalg, math)
"""Libraries of which the tracer replaces some functions; all other functions of libraries stay."""
COPIED = "__on_symbols__"
"""Name under which the globals of a copy hold its tracer, by which a copy is recognised."""


class _OfFloat(type):
    # a law that asks isinstance(x, float) means "is it a number", and a symbol stands for one
    def __instancecheck__(cls, x: object) -> bool:
        return isinstance(x, float | Scalar)


class Float(metaclass=_OfFloat):
    """A stand-in for `float` in copies: Float(x) leaves a number or symbol x as it is and reads a text such as
    "inf"; an array with this dtype can hold symbols.
    """

    def __new__(cls, x: Any = 0.0) -> Any:
        return float(x) if isinstance(x, str) else x


class Unchangeable(list[Any]):
    """A stand-in for a list of the user's that refuses changes, since machine code could not keep them."""

    def _refuse(self, *_: object, **__: object) -> Any:
        raise NotCompiled("the law changes a list")

    append = extend = insert = pop = remove = clear = reverse = sort = _refuse
    __setitem__ = __delitem__ = __iadd__ = __imul__ = _refuse


BUILTINS: Mapping[str, Any] = {"float": Float, "abs": np.abs, "min": minimum, "max": maximum}
"""Stand-ins for functions of Python, by name: their own would turn a symbol into a float or compare symbols."""


class Tracer:
    """Makes copies of functions that run on symbols. All copies solve linear equations by one `solver`, so that
    `solver.least` is the smallest |pivot| of all of them.
    """

    def __init__(self) -> None:
        """Make the table of replacements for functions of NumPy, math and `linear`."""
        # Hidden: stands for what has no symbols, and raises NotCompiled where a law uses it
        self.solver, random = symbols.SymbolicSolver(), symbols.Hidden("random numbers")
        # TWINS: NumPy's name of a function of one number -> CasADi's; here -> the function of one symbol
        scalars = {name: symbols.function_of(x) for name, x in symbols.TWINS.items()}
        # arrays have dtype object, since no other array can hold symbols
        numpy = {
            **{name: elementwise(function) for name, function in scalars.items()},
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
            "where": symbols.wheres,
            "nan_to_num": symbols.Hidden("nan_to_num"),  # it finds no NaN among symbols
            "float64": Float,
            "random": random,
        }
        # math says asin where NumPy says arcsin
        scalars |= {name.replace("arc", "a"): function for name, function in scalars.items()}
        # pairs: a function that a law may call, and what the law's copy calls in its place
        pairs = [
            *((getattr(np, name), twin) for name, twin in numpy.items()),
            *((getattr(math, name), f) for name, f in scalars.items() if hasattr(math, name)),
            (np.linalg.solve, self.solver),
            (linear.solve, self.solver),
            (linear.solve_positive, symbols.solve_positive),
            # symbols have no values that could be checked, so checks return what they get
            (checks.returned, lambda found, *_, **__: found),
            (checks.point_returned, lambda found, *_: found),
            (checks.check_part, lambda *_: None),
            (np.random.default_rng, random),
            (stdlib_random, random),
        ]
        # by identity, since a law may have imported np.sin under any name; `old` is kept so that no other
        # object can get its id
        self._substitutes = {id(old): (old, new) for old, new in pairs}
        # the copies and twins made so far, by the function or the class from which each was made
        self._copies: dict[types.FunctionType, Any] = {}
        self._twins: dict[type, type] = {}

    def __call__(self, f: Any) -> Any:
        """Copy a function f, and every function that it names, for symbols.

        What is no function of Python, functions of the engine, and those that a copy defines inside itself
        (their globals are the copy's) are returned unchanged. A copy shares the code object of f and has its
        own globals and closure, in which names are replaced; the hidden `__class__` of a method that says
        `super()` is there the twin of the class. A copy is remembered before its names are replaced, so that
        copying ends where functions call each other.
        """
        if not isinstance(f, types.FunctionType) or str(f.__module__).startswith(ENGINE):
            return f
        if f.__globals__.get(COPIED) is self:
            return f  # a copy of this tracer already
        if f not in self._copies:
            # The code object stays, its globals are others: in the copy `np` names the twin. Patching NumPy
            # itself would reach other threads, and the original goes on working on arrays. BUILTINS: stand-ins
            # for Python's float, abs, min and max; COPIED: the name by which the line above knows a copy.
            scope = {**BUILTINS, **f.__globals__, COPIED: self}
            cells = tuple(types.CellType(c.cell_contents) for c in f.__closure__ or ())
            copy: Any = types.FunctionType(f.__code__, scope, f.__name__, f.__defaults__, cells)
            copy.__kwdefaults__ = f.__kwdefaults__
            # a `try` of the user's may swallow the NotCompiled of a branch on a symbol, and what its `except`
            # does would be compiled; so a call of the copy raises
            if checks.is_users(f.__code__.co_filename) and catches(f.__code__):
                copy = _refused(f.__code__)
            self._copies[f] = copy
            for name in names_of(f.__code__):
                if name in scope:
                    scope[name] = self.on_symbols(scope[name])
            for name, cell in zip(f.__code__.co_freevars, cells, strict=True):
                twin = self.twin if name == "__class__" else self.on_symbols
                cell.cell_contents = twin(cell.cell_contents)
        return self._copies[f]

    def on_symbols(self, value: Any) -> Any:
        """The form for symbols of a value that a function names or takes as an argument.

        A function gives its twin or copy, a class or part its twin, with the parts inside it; a module one
        whose functions are copies. Tuples, lists and dictionaries are searched, and cannot be changed then, nor
        can arrays. A robot or a random generator gives a `Hidden`. Numbers, symbols and all else stay.
        """
        if id(value) in self._substitutes:
            return self._substitutes[id(value)][1]
        if isinstance(value, tuple | list):  # a list that the law changes would be a memory
            inside = [self.on_symbols(part) for part in value]
            return Unchangeable(inside) if type(value) is list else of_kind(type(value), inside)
        # HIDDEN: classes of what is neither number nor structure
        if isinstance(value, HIDDEN):
            return symbols.Hidden(f"a {type(value).__name__}")
        if type(value) is dict:
            return types.MappingProxyType({k: self.on_symbols(x) for k, x in value.items()})
        if isinstance(value, np.ndarray):
            return frozen(value.view())
        if isinstance(value, type) and is_dataclass(value) and value not in HIDDEN:
            return self.twin(value)
        # OF_NUMBERS: NumPy, its linalg and math; any other library stays as it is
        if isinstance(value, types.ModuleType) and (value in OF_NUMBERS or not is_library(value)):
            return _Named(self, value)
        # what is left is a part, or a function or other value, which __call__ copies or returns as it is
        of_engine = type(value).__module__.startswith(ENGINE)
        if of_engine or not (isinstance(value, Part) or is_part(value)):
            return self(value)
        # a law of the package may say so itself: a line inside it would tell its user nothing
        why = getattr(value, "in_python", "")
        # attributes without a dataclass: nobody can say which of them are numbers of the law
        if not is_part(value) and vars(value):
            why = "it is no dataclass; write @dataclass(frozen=True) above it"
        if why:
            raise Located(f"{type(value).__name__} cannot be compiled: {why}")
        fields = content(value) if is_part(value) else {}
        fields = {name: self.on_symbols(x) for name, x in fields.items()}
        return with_content(value, fields, self.twin(type(value)))

    def twin(self, cls: type) -> type:
        """A subclass of cls whose methods run on symbols, `super()` and properties included. Classes of Python
        itself, and of the modules in NO_METHODS, whose methods need no copies, are returned as they are.
        """
        # a class that a user makes by type(name, bases, {}) may have the module "abc", but is not found there
        home = sys.modules.get(cls.__module__)
        known = cls.__module__ in ("builtins", "abc", "typing") and hasattr(home, cls.__name__)
        if known or cls.__module__.startswith(NO_METHODS):
            return cls
        if cls not in self._twins:
            # a subclass, so that isinstance(twin, Controller) holds; twins of the bases come first, or super()
            # in a method would reach the methods for numbers
            twins = map(self.twin, cls.__bases__)
            bases = (twin for twin in twins if twin not in cls.__bases__)
            subclass = types.new_class(cls.__name__, (*bases, cls))
            subclass.__module__, subclass.__qualname__ = cls.__module__, cls.__qualname__
            # noted before its methods are copied, since these may name the class
            self._twins[cls] = self._twins[subclass] = subclass
            # all other special methods stay those of cls; `_abc_..` is Python's record of abstract methods
            for name, value in vars(cls).items():
                if name == "__call__" or not name.startswith(("__", "_abc_")):
                    setattr(subclass, name, self._member(value))
            # Python has noted the abstract methods when it made the class, before these were set
            abc.update_abstractmethods(subclass)
        return self._twins[cls]

    def _member(self, value: Any) -> Any:
        """The form for symbols of one member of a class: a method or property; any other value as it is.

        A cached property is computed anew on symbols, except a `derived` one, whose value is content of a part.
        """
        if isinstance(value, types.FunctionType):
            return self(inspect.unwrap(value))  # without decorators such as `once`
        if isinstance(value, property):
            return property(self._member(value.fget))
        if isinstance(value, functools.cached_property) and not isinstance(value, derived):
            return property(self._member(value.func))
        if isinstance(value, staticmethod):
            return staticmethod(self(value.__func__))
        return value


class _Named:
    """A stand-in for a module (NumPy, math, the user's, this package's) whose members are those for symbols."""

    def __init__(self, trace: Tracer, module: types.ModuleType):
        self._trace, self._module = trace, module

    def __getattr__(self, name: str) -> object:
        return self._trace.on_symbols(getattr(self._module, name))


def apply(trace: Tracer, f: Callable[..., T], *arguments: object) -> T:
    """The result of f, copied by `trace`, at these arguments: numbers, symbols and parts of them.

    Raises Located that names the last function of the user's or this package's in which the error
    arose, since the error itself comes from inside NumPy or CasADi.
    """
    with located(f):
        return trace(f)(*map(trace.on_symbols, arguments))


def catches(code: types.CodeType) -> bool:
    """Whether a piece of code has a `try`, and not only `with`."""
    # Python compiles both into PUSH_EXC_INFO, and each `with` into a WITH_EXCEPT_START besides
    names = [x.opname for x in dis.get_instructions(code)]
    return names.count("PUSH_EXC_INFO") > names.count("WITH_EXCEPT_START")


def _refused(code: types.CodeType) -> Any:
    """A stand-in for a function with this code, which has a `try`: a call of it raises Located."""
    name, file = code.co_qualname.replace(".<locals>", ""), Path(code.co_filename).name

    def refuse(*_: object, **__: object) -> Any:
        place = f"{name} ({file}:{code.co_firstlineno})"
        raise Located(f"{place} cannot be compiled: it catches exceptions")

    return refuse


@lru_cache(maxsize=1024)
def names_of(code: types.CodeType) -> frozenset[str]:
    """The global names and attributes that a piece of code, and code defined inside it, looks up."""
    inner = (names_of(x) for x in code.co_consts if isinstance(x, types.CodeType))
    return frozenset(code.co_names).union(*inner)
