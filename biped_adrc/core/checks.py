"""Checks of a user's arguments and classes, with a sentence that says what was expected.

A dataclass calls `check_fields`, which checks each field against its own annotation, its range included
(`Range`); a function calls `check_part` for one argument. Both raise InputError.

A *part* is a dataclass such as a controller, an observer or a reference (`core.part`). A class or function is
a *user's* where its file is neither of this package nor of an installed library. `what` begins a message and
names the value, such as "the gain".
"""

import math
import sysconfig
import traceback
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import fields, is_dataclass
from functools import wraps
from inspect import unwrap
from numbers import Integral, Real
from pathlib import Path
from types import CodeType, NoneType, UnionType
from typing import Annotated, Any, NamedTuple, Union, get_args, get_origin, get_type_hints
from weakref import WeakKeyDictionary

import numpy as np

from biped_adrc.core.errors import BipedError, InputError, NotFiniteError, RaisedError
from biped_adrc.core.shown import ByValue
from biped_adrc.core.types import Array, T


class Range(NamedTuple):
    """A range of values: `holds` accepts a value in it, `words` name it in a message."""

    words: str
    holds: Callable[[Any], bool]

    def has(self, value: object) -> bool:
        """Whether a value is in the range; a value of a type that `holds` cannot test is not."""
        try:
            return bool(self.holds(value))
        except (TypeError, ValueError, AttributeError, IndexError):
            return False


def one_of(words: Collection[str]) -> Range:
    """Range of a text that has to be one of these words."""
    return Range(f"one of {list(words)}", lambda x: x in words)


def each(words: str, holds: Callable[[Any], bool], count: int | None = None) -> Range:
    """Range of a row, or of a mapping of names to values, in which holds(value) is true for each value.

    words: its name in a message. count: how many values there have to be; None for any number.
    """

    def has(x: Any) -> bool:
        row = x.values() if isinstance(x, Mapping) else x
        return count in (None, len(row)) and all(map(holds, row))

    return Range(words, has)


def _whole(x: Any, least: int) -> bool:
    """Whether x is a whole number (not True or False), at least `least`."""
    return isinstance(x, Integral) and not isinstance(x, bool) and int(x) >= least


FiniteFloat = Annotated[float, Range("a finite number", math.isfinite)]
_POSITIVE = Range("a positive number", lambda x: 0.0 < x < math.inf)
_NOT_BELOW = Range("zero or a positive number", lambda x: 0.0 <= x < math.inf)
PositiveFloat = Annotated[float, _POSITIVE]
NonNegativeFloat = Annotated[float, _NOT_BELOW]
PositiveInt = Annotated[int, Range("a whole number, at least 1", lambda x: _whole(x, 1))]
NonNegativeInt = Annotated[int, Range("a whole number >= 0", lambda x: _whole(x, 0))]
_ROW = tuple[float, ...]
PositiveFloats = Annotated[_ROW, each("positive numbers", _POSITIVE.holds)]
NonNegativeFloats = Annotated[_ROW, each("finite numbers, none below 0", _NOT_BELOW.holds)]
TwoFloats = Annotated[tuple[float, float], each("two finite numbers", math.isfinite, 2)]


IN_WORDS: dict[Any, str] = {
    float: "a number",
    Integral: "a whole number",
    bool: "true or false",
    str: "a text",
    Mapping: "a Mapping, such as {'torso': 0.2}",
}
"""A type of Python's that can be checked -> its name in a sentence."""


def check_part(value: object, what: str, *kinds: type) -> None:
    """Raise InputError, beginning with `what`, unless `value` is an instance of one of the classes `kinds`.

    The class NoneType among them allows None; for float every real number will do. The message ends with an
    example, the text SUCH_AS of the first class that has one.
    """
    # an array without axes is a number too
    no_axes = getattr(value, "ndim", None) == 0 and hasattr(value, "dtype")
    if isinstance(value, kinds) or (float in kinds and (isinstance(value, Real) or no_axes)):
        return
    named = [kind for kind in kinds if kind is not NoneType]
    # _a: name of a class with its article, such as "a Gait"; _shown: short text of a value
    words = " or ".join(IN_WORDS.get(kind) or _a(kind) for kind in named)
    examples = [vars(kind)["SUCH_AS"] for kind in named if "SUCH_AS" in vars(kind)]
    such_as = f", such as {examples[0]}" if examples else ""
    raise InputError(f"{what} is {_shown(value)}, expected {words}{such_as}")


def check_fields(part: Any) -> None:
    """Raise InputError for a field of a dataclass that does not fit its annotation.

    The value has to be an instance of an annotated type, where all of these are classes of this package,
    numbers, texts, mappings or None; and in the `Range` of the annotation, if that has one.
    """
    cls: Any = type(part)
    # of each field: the types that it may have, whether these can be tested, and its Range or None
    for name, kinds, typed, range in _expected(cls):
        value, what = getattr(part, name), f"{name} of {cls.__name__}"
        if typed:
            check_part(value, what, *kinds)
        if range is not None and not ((value is None and NoneType in kinds) or range.has(value)):
            or_none = " or None" if NoneType in kinds else ""
            raise InputError(f"{what} is {value!r}, expected {range.words}{or_none}")


class Checked(ByValue):
    """Base of dataclasses whose fields are checked against their annotations when an object is made.

    A subclass that writes `__post_init__` need not call that of this class: the check comes before its own.
    """

    def __init_subclass__(cls, **kwargs: Any) -> None:
        """Put the check before the `__post_init__` of a subclass that writes one."""
        super().__init_subclass__(**kwargs)
        own = vars(cls).get("__post_init__")
        if own is not None:

            @wraps(own)
            def after(self: Any) -> None:
                check_fields(self)
                own(self)

            cls.__post_init__ = after  # type: ignore[method-assign]

    def __post_init__(self) -> None:
        """Check the fields. Raises InputError for a field that does not fit its annotation."""
        check_fields(self)


def numbers(values: object, what: str) -> Array:
    """Copy `values` as an array of floats of any shape. Raises InputError, beginning
    with `what`, for other values.
    """
    try:
        return np.array(values, dtype=float)
    except (TypeError, ValueError):
        raise InputError(f"{what} is {_shown(values)}, expected numbers in equal rows") from None


FLOAT = np.dtype(float)


def returned(
    found: object,
    shape: tuple[int, ...] | None,
    part: object,
    method: str,
    finite: bool = True,
    field: bool = False,
) -> Array:
    """Check the result `found` of a method of a user's class; returns it as an array of floats.

    part: object of that class. shape: the expected one; None: any row of numbers. finite: whether NaN and
    infinity are refused. field: whether `method` is not a method, but the name of one of several arrays that
    the class returned together. It is called at every sample instant, so an array that is right already costs
    less than a microsecond. Raises InputError that names the class for None, complex numbers, text, objects and
    another shape, and, where `finite`, NotFiniteError.
    """
    # always true for the shape None
    if type(found) is not np.ndarray or found.dtype != FLOAT or found.shape != shape:
        found = _numbers_returned(found, shape, part, method, field)
    if finite and not all(map(math.isfinite, found.ravel().tolist())):
        shown = " ".join(str(found).split())
        raise NotFiniteError(f"{_sentence(part, method, field)} {shown}, expected finite numbers")
    return found


def _sentence(part: object, method: str, field: bool) -> str:
    """Beginning of a sentence about a result: "X.output (own.py:12) returned"; with `field`, where `method` is
    not a method, but the name of an array that class X returned with others: "X gives q_d =".
    """
    if field:
        return f"{spoken(part)} gives {method} ="
    return f"{spoken(part)}.{method}{line_of(part, method)} returned"


def line_of(part: object, method: str) -> str:
    """Text such as " (own.py:12)" with the line where a user's class writes a method; empty
    for a class of this package, unless a part inside it is a user's and writes the method.
    """
    # an observer has `reset` where the controller around it has `jump`
    for name in (method, "reset") if method == "jump" else (method,):
        written: Any = getattr(type(part), name, None)
        # the user's own function, below the checks that decorators put around it
        code = getattr(unwrap(written), "__code__", None)
        if code is not None and is_users(code.co_filename):
            return f" ({Path(code.co_filename).name}:{code.co_firstlineno})"
    return next(filter(None, (line_of(x, method) for x in _inside(part))), "")


def _inside(part: object) -> list[Any]:
    """The parts in the fields `inner`, `observer` and `parts` of a part."""
    fields = [getattr(part, name, None) for name in ("inner", "observer", "parts")]
    each = [x for field in fields for x in (field if isinstance(field, tuple) else (field,))]
    return [x for x in each if isinstance(x, Checked)]


def _numbers_returned(
    found: object, shape: tuple[int, ...] | None, part: object, method: str, field: bool
) -> Array:
    """Convert the result `found` of a user's class to an array of floats of this shape (None: of one axis), or
    raise InputError that names the class of `part` and its method.

    field: whether `method` is not a method, but the name of one of several arrays that the class returned.
    """
    try:
        array = np.asarray(found)
    except ValueError:  # rows of different lengths; an array of objects is refused below
        array = np.empty(0, dtype=object)
    sentence = _sentence(part, method, field)
    expected = "a row of real numbers" if shape is None else f"{shape}, real numbers"
    # neither floats, whole numbers, nor the 1 or 0 of a comparison
    if array.dtype.kind not in "fiub":
        forgot = "; is a return statement missing?" if found is None and not field else ""
        shown = f"{found.dtype} numbers" if isinstance(found, np.ndarray) else _shown(found)
        raise InputError(f"{sentence} {shown}, expected {expected}{forgot}")
    if array.ndim != 1 if shape is None else array.shape != shape:
        # "X gives q_d of shape ..", or "X.output returned an array of shape .."
        sentence = sentence.removesuffix(" =") if field else f"{sentence} an array"
        raise InputError(f"{sentence} of shape {array.shape}, expected {expected}")
    return array.astype(float)


def point_returned(found: object, kind: Any, part: object, n: int, p: int | None = None) -> Any:
    """Check the result of `__call__` of a reference or of outputs: a NamedTuple `kind`, whose arrays are (p,)
    but for one matrix (p, n), with n the number of coordinates.

    kind: `ReferencePoint`, with matrix H, or `OutputPoint`, with matrix J. part: the object that was called. p:
    number of rows; None takes it from the matrix. Returns the tuple with arrays of floats. Raises InputError
    and NotFiniteError with the name of the field.
    """
    if not isinstance(found, kind):
        # _shown: short text of a value; _a: name of a class with its article
        fields = ", ".join(kind._fields)
        raise InputError(f"{spoken(part)} gives {_shown(found)}, expected {_a(kind)}({fields})")
    matrix = "J" if "J" in kind._fields else "H"
    if p is None:
        # a matrix written as a list has no shape: then the length of the first array counts
        shape = getattr(getattr(found, matrix), "shape", ())
        p = shape[0] if shape else np.size(found[0])
    shapes = [(p, n) if name == matrix else (p,) for name in kind._fields]
    each = zip(found, shapes, kind._fields, strict=True)
    return kind(*(returned(x, shape, part, name, field=True) for x, shape, name in each))


def called_checked(cls: Any, kind: type) -> None:
    """Wrap the method `__call__`(t, q, v) of a class of references or outputs, so that its result is checked.
    A class that inherits the method is left alone: that of its base is wrapped already.

    kind: the NamedTuple that it has to return, `ReferencePoint` or `OutputPoint`.
    """
    own = vars(cls).get("__call__")
    if own is not None:

        @wraps(own)
        def call(self: Any, t: float, q: Array, v: Array) -> Any:
            return point_returned(own(self, t, q, v), kind, self, len(q))

        cls.__call__ = call


def spoken(part: object) -> str:
    """Names of the classes of a part and of the parts in its fields `inner`, `observer` and `parts`, such as
    "Delayed (ADRCController (MyObserver))".
    """
    names = [spoken(x) for x in _inside(part)]
    return type(part).__name__ + (f" ({', '.join(names)})" if names else "")


@contextmanager
def handing_out() -> Iterator[None]:
    """Context in which methods of a user's class are called: an exception in them is raised as a RaisedError.

    Its text gives class, method, file and line of the user's code. A BipedError, and an exception that did not
    come from the user's code, pass unchanged.
    """
    try:
        yield
    except BipedError:
        raise
    except Exception as error:
        if not (text := sentence_of(error)):  # empty: the user's code was not running
            raise
        raise RaisedError(text) from error


def calls_of(error: Exception) -> list[tuple[CodeType, traceback.FrameSummary]]:
    """Code and line of each call that an exception has passed, the innermost last."""
    codes = (frame.f_code for frame, _ in traceback.walk_tb(error.__traceback__))
    return list(zip(codes, traceback.extract_tb(error.__traceback__), strict=True))


def sentence_of(error: Exception) -> str:
    """Sentence on an exception in a user's code: "PD.output (own.py:12, `x = 1 / 0`) raised ..."; empty for
    one in which no line of the user's was running.
    """
    own = [call for call in calls_of(error) if is_users(call[1].filename)]
    if not own:
        return ""
    code, line = own[-1]  # the innermost call
    name = code.co_qualname.rpartition("<locals>.")[2]
    where = f"{name} ({Path(line.filename).name}:{line.lineno}, `{line.line}`)"
    # the arrays that a user's method is handed are read-only
    if isinstance(error, ValueError) and "read-only" in str(error):
        what = "writes into an array that it was handed and that others read"
        return f"{where} {what}; write into a copy, such as v = m.v_b.copy()"
    return f"{where} raised {type(error).__name__}: {error}"


LIBRARIES = tuple(sysconfig.get_paths()[kind] for kind in ("stdlib", "purelib", "platlib"))
"""Folders of Python and of installed packages."""
PACKAGE = str(Path(__file__).parents[1])
"""Folder of this package."""


def is_users(file: str) -> bool:
    """Whether a Python file is the user's: not of a library, nor of this package."""
    return not file.startswith((PACKAGE, *LIBRARIES, "<frozen"))


def per_class(make: Callable[[type], T]) -> Callable[[type], T]:
    """Decorator: make(cls) is computed once for each class, and forgotten with it; the engine makes many."""
    known = WeakKeyDictionary[type, T]()

    @wraps(make)
    def found(cls: type) -> T:
        if cls not in known:
            known[cls] = make(cls)
        return known[cls]

    return found


def hints_of(cls: type) -> dict[str, Any]:
    """Field -> annotation of a class, with all names in them resolved; empty where one cannot be."""
    try:
        return get_type_hints(cls, include_extras=True)
    except (NameError, TypeError, AttributeError, SyntaxError):
        return {}


@per_class
def _expected(cls: Any) -> tuple[tuple[str, tuple[type, ...], bool, Range | None], ...]:
    """The fields of a class to check: (name, allowed types, whether these are checked, range or None) of each.

    Left out are fields whose annotation cannot be read, and those where neither types nor a range are checked.
    """
    hints = hints_of(cls)
    names = [f.name for f in fields(cls)] if is_dataclass(cls) else []
    allowed = ((name, *_allowed(hints[name])) for name in names if name in hints)
    result = ((name, kinds, all(map(_looked_at, kinds)), range) for name, kinds, range in allowed)
    # x[2]: whether the types can be tested; x[3]: the range
    return tuple(x for x in result if x[2] or x[3] is not None)


def members(hint: Any) -> tuple[Any, ...]:
    """The types of a union `A | B`; a type that is none is alone."""
    return get_args(hint) if get_origin(hint) in (Union, UnionType) else (hint,)


def _allowed(hint: Any) -> tuple[tuple[Any, ...], Range | None]:
    """The types that an annotation allows, and its range, None where it has none."""
    # Annotated[float, Range(..)] | None: its members, of which one may carry a Range as metadata
    each = members(hint)
    ranges = [x.__metadata__[0] for x in each if get_origin(x) is Annotated]
    kinds = tuple(x.__origin__ if get_origin(x) is Annotated else x for x in each)
    if ranges and int in kinds:  # NumPy's whole numbers count too; the range itself refuses True
        kinds = (Integral, *(x for x in kinds if x is not int))
    return kinds, ranges[0] if ranges else None


def _looked_at(kind: Any) -> bool:
    """Whether a type can be checked: a class of this package but no protocol, a key of `IN_WORDS`
    (float, Integral, str, Mapping), or None.
    """
    own = isinstance(kind, type) and kind.__module__.startswith("biped_adrc.")
    return (own and not getattr(kind, "_is_protocol", False)) or kind in (*IN_WORDS, NoneType)


def _shown(value: Any) -> str:
    """Short text of a value and its type, for a message; of a class, that no object was made of it."""
    if isinstance(value, type):
        return f"the class {value.__name__}, not made as {value.__name__}(...)"
    text = repr(value)
    name = type(value).__name__
    # a long text, or one that already begins with its class, as Gait(...): the class alone
    if value is None or len(text) > 60 or text.startswith(name):
        return "None" if value is None else _a(type(value))
    return f"{text} ({_a(type(value))})"


def _a(kind: type) -> str:
    """Name of a class with its article: "an NPDController", "a Gait"."""
    name = kind.__name__
    # NLMRSFH: capitals that are spelled out begin with a vowel, as N in NPD
    vowel = name[0] in "AEIOaeio" or (name[0] in "NLMRSFH" and name[:2].isupper())
    return f"{'an' if vowel else 'a'} {name}"
