"""What is written as laws: a NamedTuple of parameters k and of pure functions whose first argument is k.

A class that gives `laws` needs no methods: those of its base call the laws. A class that writes methods needs
no laws, and then runs in Python only.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import cached_property, partial
from typing import Any, ClassVar

from biped_adrc.parts import check_fields
from biped_adrc.shown import Shown


def written_over(part: Any, given: str, methods: frozenset[str]) -> str:
    """The first of `methods` that a class below that with `given` writes anew; empty for none."""
    for cls in type(part).__mro__:
        if given in vars(cls):
            break
        if written := methods.intersection(vars(cls)):
            return min(written)
    return ""


class Composed(Shown, ABC):
    """Base of what has laws: controllers, observers, references, disturbances."""

    _kind: ClassVar[str]
    """What it is, in a word."""
    _methods: ClassVar[frozenset[str]]
    """Names of the methods that its laws stand for."""

    def __post_init__(self) -> None:
        """Raises InputError for a field that is not what its annotation says."""
        check_fields(self)

    @property
    @abstractmethod
    def laws(self) -> Any:
        """A NamedTuple with `parameters` and functions; None without."""

    @cached_property
    def _laws(self) -> Any:
        return self.laws

    def _law(self, name: str) -> Callable[..., Any] | None:
        """The law of this name with its parameters filled in; None without."""
        law = getattr(self._laws, name, None)
        return None if law is None else partial(law, self._laws.parameters)

    @property
    def _obstacle(self) -> str:
        """Why laws do not say all that it does: there are none, or a subclass writes a method over them."""
        name = f"{self._kind} {type(self).__name__}"
        if self._laws is None:
            return f"{name} has no laws of arrays"
        written = written_over(self, "laws", self._methods)
        return f"{name} writes {written} over the laws that it inherits" if written else ""

    def __getstate__(self) -> dict[str, Any]:
        """Without what is made again where it is needed."""
        return {name: value for name, value in vars(self).items() if name != "_laws"}
