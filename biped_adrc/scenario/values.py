"""Fields of a record in plain values: their text, unit and range, and what is said of a wrong one."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from difflib import get_close_matches
from functools import wraps
from typing import Any, TypeVar

from pydantic import Field, ValidationError

from biped_adrc.errors import InputError
from biped_adrc.resources import packaged

_T = TypeVar("_T")


def described(name: str) -> Callable[[type[_T]], type[_T]]:
    """A class whose fields have the texts, units and ranges that a TOML file beside this module has."""

    def decorate(cls: type[_T]) -> type[_T]:
        for field, told in packaged("biped_adrc.scenario", name).items():
            limits = {key: x for key, x in told.items() if key not in ("text", "unit")}
            default = getattr(cls, field)
            if isinstance(default, bool | int | float) or limits:
                limits["strict"] = True
            factory = getattr(default, "default_factory", None)
            given = {"default": default} if factory is None else {"default_factory": factory}
            extra = {"unit": told.get("unit", "1")}
            made = Field(**given, description=told["text"], json_schema_extra=extra, **limits)
            setattr(cls, field, made)
        return cls

    return decorate


def clear(
    filled: Callable[[Mapping[str, Any]], Mapping[str, Any]] = lambda values: {},
) -> Callable[[type[_T]], type[_T]]:
    """A class of pydantic's that raises InputError; `filled` gives values for what is not given."""

    def decorate(cls: type[_T]) -> type[_T]:
        made: Callable[..., None] = cls.__init__

        @wraps(made)
        def init(self: _T, *given: Any, **values: Any) -> None:
            try:
                made(self, *given, **{**filled(values), **values})
            except ValidationError as error:
                known = cls.__pydantic_fields__  # type: ignore[attr-defined]
                raise InputError(reason(error, known)) from error

        cls.__init__ = init  # type: ignore[method-assign, assignment]
        return cls

    return decorate


def reason(error: Exception, known: Iterable[str] = ()) -> str:
    """What an error says; of a validator's the first thing that is wrong, without ornaments."""
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
    """What is said of a name that there is not; `near_by` are others that may have been meant."""
    near = get_close_matches(name, [*known, *near_by], 3, 0.6)
    hint = f"did you mean {' or '.join(map(repr, near))}?" if near else f"choose from {list(known)}"
    return f"unknown parameter; {hint}" if known else "unknown parameter; leave it out"
