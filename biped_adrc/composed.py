"""Base of controllers, observers and references: parts that are written as laws.

A law is a pure function of arrays whose first argument k holds the numbers (gains, poles,
amplitudes). A part gives all its laws and k together as one NamedTuple, its property `laws`. From
it both engines work:

    Python       the methods of the base class call the laws with k filled in (`Composed._law`)
    compiled     `engine` traces the laws into machine code; k stays data, so new gains compile
    nothing

A class that gives `laws` therefore writes no methods. A class that writes methods in place of laws
is allowed: its walks run in Python, and `_obstacle` is the sentence that tells the user why.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import cached_property, partial
from typing import Any, ClassVar

from biped_adrc.parts import Checked
from biped_adrc.shown import Shown
from biped_adrc.types import frozen


def written_over(part: object, given: str, methods: frozenset[str]) -> str:
    """Name of a method that a subclass writes anew below the class that defines `given`; empty for none.

    A subclass that overrides `output` and inherits `laws` would run its own method in Python and
    its parent's law when compiled. Such a part must not be compiled, and this finds it: the classes
    of `part` are searched from the most derived one to the one that defines `given`, the first
    alphabetically of a class is returned.
    """
    for cls in type(part).__mro__:
        if given in vars(cls):
            break
        if written := methods.intersection(vars(cls)):
            return min(written)
    return ""


class Composed(Checked, Shown, ABC):
    """Base class of what has laws. A subclass states its kind, the methods its laws replace, and `laws`."""

    _kind: ClassVar[str]
    """What it is, in a word for messages, such as "controller"."""
    _methods: ClassVar[frozenset[str]]
    """Names of the methods that call the laws; one of them written anew by a subclass is an obstacle."""

    @property
    @abstractmethod
    def laws(self) -> Any:
        """A NamedTuple with the field `parameters` and a field for each law; None for a part without laws."""

    @cached_property
    def _laws(self) -> Any:
        """`laws`, made once for each object: a walk calls them at every stage of every time step.

        Their parameters are read-only, since a law that writes into its numbers would change the next call.
        """
        return frozen(self.laws)

    def _law(self, name: str) -> Callable[..., Any] | None:
        """The law of this name with its parameters k filled in; None where there is none of that name."""
        law = getattr(self._laws, name, None)
        return None if law is None else partial(law, self._laws.parameters)

    @property
    def _obstacle(self) -> str:
        """Why the laws do not say all that this part does, as a sentence; empty where they do.

        Either there are no laws, or a subclass writes a method over those it inherits (see
        `written_over`).
        """
        name = f"{self._kind} {type(self).__name__}"
        if self._laws is None:
            return f"{name} has no laws of arrays"
        written = written_over(self, "laws", self._methods)
        return f"{name} writes {written} over the laws that it inherits" if written else ""

    def __getstate__(self) -> dict[str, object]:
        """What is pickled for a worker process: all fields but the cached laws, which are made again there."""
        return {name: value for name, value in vars(self).items() if name != "_laws"}
