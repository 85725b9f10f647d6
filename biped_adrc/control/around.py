"""What goes around any controller: a controller whose laws are made of those of the one inside.

A leaf says in `around` how. It names no class of controllers, so that every one that compiles still does.
`across_contact` has the policies for the time after a touchdown, `friction_feedforward` and `predicted` what
serves all the time.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, NamedTuple, Self

from biped_adrc.control.base import Controller, ControllerLaws, Measurement, controller_laws
from biped_adrc.errors import InputError
from biped_adrc.types import Array


class AroundParameters(NamedTuple):
    """Of the controller inside, and of what is around it."""

    inner: Any
    own: Any


@dataclass(frozen=True)
class Around(Controller):
    """Base of what is around `inner`: a leaf says how its laws are made of those inside."""

    inner: Controller

    @abstractmethod
    def around(self, inner: ControllerLaws) -> ControllerLaws:
        """The laws, without parameters, around those of `inner`.

        Their k is an `AroundParameters`. Cached by `inner`, so that equal laws share their machine code.
        """

    def taken(self, inner: ControllerLaws) -> ControllerLaws:
        """The laws of `inner`, without parameters, in the form in which `around` takes them."""
        return inner

    @property
    def own(self) -> Any:
        """The leaf's own numbers, `AroundParameters.own`."""
        return ()

    @property
    def needs_body(self) -> bool:  # type: ignore[override]
        """As the controller inside."""
        return self.inner.needs_body

    @property
    def laws(self) -> ControllerLaws:
        inner = controller_laws(self.inner)
        k = AroundParameters(inner.parameters, self.own)
        return self.around(self.taken(inner.functions))._replace(
            parameters=k, obstacle=inner.obstacle
        )

    def sampled(self, period: float) -> Self:
        return replace(self, inner=self.inner.sampled(period))


@lru_cache(maxsize=64)
def passed_on(inner: ControllerLaws) -> ControllerLaws:
    """The laws inside for the parameters of a leaf around them, with the same state."""

    def inside(law: Callable[..., Any]) -> Callable[..., Any]:
        def passed(k: AroundParameters, *given: object) -> Any:
            return law(k.inner, *given)

        return passed

    def blind(k: AroundParameters, m: Measurement, a: Array) -> AroundParameters:
        assert inner.blind is not None
        return k._replace(inner=inner.blind(k.inner, m, a))

    given = {name: law for name, law in inner._asdict().items() if callable(law)}
    passed: dict[str, Any] = {name: inside(law) for name, law in given.items()}
    return inner._replace(**passed | ({} if inner.blind is None else {"blind": blind}))


def nothing(k: object, m: Measurement) -> Array:
    """The state (0,) of a controller without one."""
    return m.q[:0]


def unchanged(k: object, s: Array, *given: object) -> Array:
    """The state s (size,) as it is."""
    return s


def not_sampled(k: object, s: Array, *given: object) -> Array:
    """Raises InputError: the controller inside is still that of continuous time."""
    raise InputError(
        "what acts at ticks is around a controller of continuous time; call sampled(period)"
    )


def filled(laws: ControllerLaws) -> ControllerLaws:
    """The laws in sampled time, with one that changes nothing in place of each that is missing."""
    at_ticks = unchanged if laws.flow is None else not_sampled
    usual: dict[str, Any] = {
        "initial_state": nothing,
        "jump": unchanged,
        "correct": at_ticks,
        "predict": at_ticks,
    }
    missing = {name: law for name, law in usual.items() if getattr(laws, name) is None}
    return laws._replace(**missing, flow=None)


class TickLaws(NamedTuple):
    """The laws of `filled` that act at ticks; signatures are those of `ControllerLaws`."""

    initial_state: Callable[..., Array]
    jump: Callable[..., Array]
    correct: Callable[..., Array]
    predict: Callable[..., Array]


def tick_laws(laws: ControllerLaws) -> TickLaws:
    """Those of a controller that has them all, as what `filled` returns."""
    start, jump, correct, predict = laws.initial_state, laws.jump, laws.correct, laws.predict
    assert start is not None
    assert jump is not None
    assert correct is not None
    assert predict is not None
    return TickLaws(start, jump, correct, predict)
