"""Errors with the exit codes of the command, and checks of input that many modules share.

Every error raised on purpose derives from `BipedError`; the command prints its text as one line and ends with
its `exit_code`, without a traceback. Each class also derives from the builtin error that a Python user would
catch, such as ValueError. A message says what was asked, what was found, what was expected and what to try.

A function here that begins with `check_` returns nothing and raises. Its argument `what` is the first half of
the sentence, which names the value and says what was found; the function adds what was expected.
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from difflib import get_close_matches
from numbers import Integral
from typing import Any


class BipedError(Exception):
    """Base of every error this package raises on purpose.

    >>> try:
    ...     ba.Gains(K_p=-1.0)
    ... except ba.BipedError as error:
    ...     print(error)
    gain K_p is -1.0, expected positive numbers, one per joint, at most 1e+15
    """

    exit_code = 3
    """Exit code of the command that ends with this error; 3 for bad input."""


class InputError(BipedError, ValueError):
    """A value given by the user cannot be used (exit code 3)."""


class NotFiniteError(InputError):
    """A state, torque or parameter is NaN or infinite (exit code 3)."""


class RaisedError(InputError):
    """A class of the user's raised an exception; the text says where (exit code 3)."""


class ModelError(InputError):
    """A URDF, robot, joint, frame or parameter preset is missing or not physical (exit code 3)."""


class GaitError(InputError):
    """A gait or curve is missing, malformed, or does not close (exit code 3)."""


class ReachError(GaitError):
    """A stepping stone asks for a step length that no gait of a family has (exit code 3)."""


class SingularError(BipedError, ArithmeticError):
    """A matrix that a control law must invert is singular at this state (exit code 4)."""

    exit_code = 4


class SimulationError(BipedError, RuntimeError):
    """A run ended before its goal, such as the return to a Poincare section (exit code 4)."""

    exit_code = 4


class RanAwayError(SimulationError):
    """A motion or a torque is far beyond the robot's limits (exit code 4)."""


class OutputError(BipedError, OSError):
    """A result cannot be written (exit code 5)."""

    exit_code = 5


class WalkWarning(UserWarning):
    """A remark on a walk that `walk` made: something was not as asked for, or a number is not what it seems.

    >>> import warnings
    >>> push = ba.TorquePulse([30.0, 30.0, 0.0, 0.0, 0.0], step=9, start=0.1, stop=0.3)
    >>> with warnings.catch_warnings(action="ignore", category=ba.WalkWarning):
    ...     walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint), push), gait, impacts=2)
    >>> print(*walk.remarks)
    the push from 0.1 to 0.3 s in single support 9 did not act: the walk has no single support 9
    """


@contextmanager
def optional(extra: str, need: str, instead: str = "") -> Iterator[None]:
    """Context in which an optional library is imported. Raises InputError that says how to install it.

    extra: name for `pip install 'biped-adrc[extra]'`. need: how the message begins, such as "MuJoCo is not
    installed". instead: how it ends, such as what works without the library.
    """
    try:
        yield
    except ImportError:
        raise InputError(f"{need}; pip install 'biped-adrc[{extra}]'{instead}") from None


def check_whole(value: object, what: str, least: int = 0) -> None:
    """Raise InputError unless `value` is a whole number, at least `least`; NumPy's
    integers count, True does not.

    what: how the message begins, with the value found.
    """
    if isinstance(value, bool) or not isinstance(value, Integral) or int(value) < least:
        raise InputError(f"{what}{_if_text(value)}, expected a whole number, at least {least}")


def check_count(count: object, what: str) -> None:
    """Raise InputError unless `count` is a whole number, at least 1.

    what: how the message begins, with the value found.
    """
    check_whole(count, what, 1)


def check_positive(value: float, what: str, hint: str = "") -> None:
    """Raise InputError unless `value` is a finite number above 0: NaN, infinity and text are refused too.

    what: how the message begins, with the value found. hint: how it ends, such as what to use
    instead.
    """
    try:
        fits = math.isfinite(value) and value > 0
    except TypeError:  # no number
        fits = False
    if not fits:
        # _if_text: a remark where the value is a text, such as '4'
        raise InputError(f"{what}{_if_text(value)}, expected a positive number{hint}")


def _if_text(value: object) -> str:
    """A remark on a value that is a text, since '4' is printed as 4 is; empty for other values."""
    return f" ({value!r} is a str)" if isinstance(value, str) else ""


MANY = 20
"""Most names that a message lists; where there are more, it lists their records alone."""


def unknown(name: str, known: Iterable[str]) -> str:
    """The sentence for a name that does not exist: it proposes up to three of the `known` names, or all.

    Names may be dotted, record.value. Those with the same last part are proposed; where there are none, similar
    ones, and if the record before the dot is known, only those in it.
    """
    known, (record, dot, last) = list(known), name.rpartition(".")
    beside = [whole for whole in known if dot and whole.startswith(record + dot)]
    # part of a dotted name -> the names that end with it
    ends: dict[str, list[str]] = {}
    for whole in known:
        parts = whole.split(".")
        for k in range(len(parts)):  # for a.b.c the records a.b and a may be meant too
            ends.setdefault(parts[k], []).append(".".join(parts[: k + 1]))
    # at most two names with a similar last part; 0.8: least similarity of a whole name, 1 for the same text
    alike = [ends[end][0] for end in get_close_matches(last, ends, 2)]
    near = ends.get(last) or [*get_close_matches(name, known, 2, 0.8), *alike]
    if last not in ends and beside:
        known, near = beside, [x for x in near if x in beside]
    near = list(dict.fromkeys(near))[:3]
    if near:
        return f"unknown name; did you mean {' or '.join(map(repr, near))}?"
    # MANY: with more names only those of the records are listed
    if len(known) > MANY:
        known = list(dict.fromkeys(whole.partition(".")[0] for whole in known))
    return f"unknown name; choose from {known}" if known else "unknown name; leave it out"


def complaint(error: Mapping[str, Any]) -> str:
    """Text of an entry of pydantic's `ValidationError.errors()`: what was found and what was expected."""
    # a user writes a list into a file, and knows no tuple
    text: str = error["msg"].removeprefix("Value error, ").replace("tuple", "list")
    if text.startswith("Input should"):
        return f"found {error['input']!r}, {text.replace('Input should', 'should')}"
    return text


LABELS = ("float", "constrained-float", "int", "bool", "str")
"""Types of a union, which pydantic puts into the place of an error; they are no names of values."""


def dotted_place(error: Mapping[str, Any]) -> str:
    """The dotted name, record.value, of the value that an entry of pydantic's `errors()` is about."""
    parts = map(str, error["loc"])  # also labels of pydantic's, such as "list[float]"
    # LABELS: types of a union, which pydantic puts into the place
    return ".".join(part for part in parts if part not in LABELS and "[" not in part)


def problem(error: Mapping[str, Any]) -> str:
    """An entry of pydantic's `errors()` in words: its place, what was found and what was expected."""
    place = dotted_place(error)
    if error["type"] == "missing":
        return f"the key '{place}' is missing"
    return ": ".join(filter(None, (place, complaint(error))))
