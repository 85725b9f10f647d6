"""Making a thing of the registry, or of the user's own, from values by their names."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping
from inspect import Parameter, signature
from typing import Any

from biped_adrc.errors import BipedError, InputError

_VARIADIC = (Parameter.VAR_POSITIONAL, Parameter.VAR_KEYWORD)


def takes(make: Callable[..., Any]) -> Mapping[str, Parameter]:
    """The parameters of a class or function that may be given by name."""
    found = signature(make).parameters
    return {name: p for name, p in found.items() if p.kind not in _VARIADIC}


def lacking(make: Callable[..., Any], values: Container[str]) -> list[str]:
    """Parameters without a default that are not among the values."""
    wanted = (p for p in takes(make).values() if p.default is Parameter.empty)
    return [p.name for p in wanted if p.name not in values]


def construct(
    what: str, make: Callable[..., Any], values: Mapping[str, Any], kind: type[Any]
) -> Any:
    """make(**values) with those of the values that it takes, a `kind`. Raises InputError, of `what`."""
    missing = lacking(make, values)
    if missing:
        raise InputError(
            f"{what} needs {', '.join(missing)}; give --set {missing[0]}=VALUE, `own.{missing[0]} = VALUE` "
            f"in a study, or Scenario(own={{'{missing[0]}': VALUE}}); given by themselves are {sorted(values)}"
        )
    try:
        made = make(**{name: x for name, x in values.items() if name in takes(make)})
    except BipedError:
        raise
    except Exception as error:  # whatever a class of the user's may raise
        raise InputError(f"{what} could not be made: {type(error).__name__}: {error}") from error
    if not isinstance(made, kind):
        raise InputError(
            f"{what} made a {type(made).__name__}, expected one of class {kind.__name__}"
        )
    return made
