"""Fields of records in plain values: text, unit and range from a TOML file, and clear errors for wrong values.

pydantic checks types and ranges; its messages are written for programmers. `described` gives a dataclass the
texts and ranges of a TOML table, `clear` makes it raise InputError with one sentence (`reason`), and `unknown`
suggests the name that was probably meant. Used by `Scenario`, `Push` and the study files of `bench`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from difflib import get_close_matches
from functools import wraps
from typing import TypeVar

from pydantic import Field, ValidationError

from biped_adrc.errors import InputError
from biped_adrc.resources import packaged

_T = TypeVar("_T")


def described(name: str) -> Callable[[type[_T]], type[_T]]:
    """Decorator: gives the fields of a class the texts and ranges of a TOML file beside this module.

    Fields with a number or a range are strict: the text "3" is no number. Keys of a field in the file are
    `text`, `unit`, and the limits of pydantic's Field (ge, gt, le, lt). It goes below pydantic's `dataclass`,
    which reads the defaults that are set here.
    """

    def decorate(cls: type[_T]) -> type[_T]:
        for field, told in packaged("biped_adrc.scenario", name).items():
            limits = {key: x for key, x in told.items() if key not in ("text", "unit")}
            default = getattr(cls, field)
            if isinstance(default, bool | int | float) or limits:
                limits["strict"] = True
            factory = getattr(default, "default_factory", None)
            given = {"default": default} if factory is None else {"default_factory": factory}
            setattr(cls, field, Field(**given, description=told["text"], **limits))
        return cls

    return decorate


def units_of(name: str) -> dict[str, str]:
    """Unit of each field in a TOML file beside this module, "1" where none is given."""
    told = packaged("biped_adrc.scenario", name)
    return {field: str(entry.get("unit", "1")) for field, entry in told.items()}


def clear(
    filled: Callable[[Mapping[str, object]], Mapping[str, object]] = lambda values: {},
) -> Callable[[type[_T]], type[_T]]:
    """Decorator: makes a pydantic dataclass raise InputError with one clear sentence.

    filled: from the values that are given, values for those that are not. It goes above pydantic's `dataclass`,
    whose constructor it replaces.
    """

    def decorate(cls: type[_T]) -> type[_T]:
        made: Callable[..., None] = cls.__init__

        @wraps(made)
        def init(self: _T, *given: object, **values: object) -> None:
            try:
                made(self, *given, **{**filled(values), **values})
            except ValidationError as error:
                known = cls.__pydantic_fields__  # type: ignore[attr-defined]
                raise InputError(reason(error, known)) from error

        cls.__init__ = init  # type: ignore[method-assign, assignment]
        return cls

    return decorate


def reason(error: Exception, known: Iterable[str] = ()) -> str:
    """The text of an error; of a pydantic error the first thing that is wrong, as "name: found, expected".

    known: names that there are, from which a misspelt one is suggested.
    """
    if not isinstance(error, ValidationError):
        return str(error)
    found = error.errors()[0]
    name = "".join(f"{part}: " for part in found["loc"])
    if found["type"] == "unexpected_keyword_argument":
        return f"{name}{unknown(str(found['loc'][-1]), known if len(found['loc']) == 1 else ())}"
    text = found["msg"].removeprefix("Value error, ")
    if not (found["loc"] and text.startswith("Input should")):
        return f"{name}{text}"
    return f"{name}found {found['input']!r}, {text.replace('Input should', 'should')}"


def unknown(name: str, known: Iterable[str], near_by: Iterable[str] = ()) -> str:
    """The message for a name that does not exist: the nearest names of `known` and `near_by`, or all known
    ones.
    """
    near = get_close_matches(name, [*known, *near_by], 3, 0.6)
    hint = f"did you mean {' or '.join(map(repr, near))}?" if near else f"choose from {list(known)}"
    return f"unknown parameter; {hint}" if known else "unknown parameter; leave it out"
