"""The controller of a scenario: its class is looked up, and made of what its constructor takes by name.

reference, gait, biped and outputs (y = q_b - h) come from the gait; gains from K_p and K_d; observer from the
observer's name, poles, bandwidth, order; reset, solve_theta and torque_limit are the scenario's. All else is in
`Scenario.own`. A class that takes `inner` goes around another controller, own value `inner`, and has its values
from `own` alone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace
from inspect import Parameter
from typing import Any

import numpy as np

from biped_adrc.control.base import Controller
from biped_adrc.control.tracking import TABLE_II
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.outputs import LinearOutputs
from biped_adrc.model.biped import Biped
from biped_adrc.observers.base import Observer, ResetPolicy
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.scenario.construct import construct, lacking, takes
from biped_adrc.scenario.registry import find
from biped_adrc.scenario.scenario import DEFAULTS, Scenario
from biped_adrc.scenario.values import unknown

GAINS = ("K_p", "K_d")
OF_OBSERVER = ("observer", "poles", "bandwidth", "order")
OF_CONTROLLER = (*GAINS, *OF_OBSERVER, "reset", "solve_theta")
"""Values of a scenario that a controller takes, or that do nothing."""
MAKERS = ("from_poles", "from_bandwidth", "from_epsilon")
"""Of an observer, beside its constructor."""


@dataclass
class Maker:
    """Makes the controller; `used` and `known` gather the names that something takes."""

    s: Scenario
    gait: Gait | None
    biped: Biped
    used: set[str] = field(default_factory=set)
    known: set[str] = field(default_factory=set)

    def made(self, name: str) -> Controller:
        """The controller by name. Raises InputError for what is missing, does not fit, or does nothing."""
        entry = find("controller", name)
        make, what = entry.load(), f"controller '{name}'"
        own, accepted = self.s.own, takes(make)
        values = self._context(accepted)
        if "inner" in accepted:
            inner = own.get("inner", Scenario.controller)
            if not isinstance(inner, str) or inner == name:
                raise InputError(
                    f"{what} goes around an inner controller, found inner = {inner!r}, expected a name"
                )
            values["inner"] = self.made(inner)
        else:
            values |= self._taken(what, accepted, entry.defaults)
        self.known |= set(accepted)
        mine = {key: x for key, x in own.items() if key in accepted and key != "inner"}
        self.used |= {*mine, *(("inner",) if "inner" in accepted else ())}
        made: Controller = construct(what, make, values | mine, Controller)
        return made

    def _context(self, accepted: Mapping[str, Parameter]) -> dict[str, Any]:
        """What the gait and the robot give."""
        found: dict[str, Any] = {"biped": self.biped}
        if self.gait is not None:
            found |= {"gait": self.gait, "reference": self.gait.constraint}
            if "outputs" in accepted:
                found["outputs"] = LinearOutputs(
                    np.eye(self.biped.n)[: self.biped.p], self.gait.constraint
                )
        return found

    def _taken(
        self, what: str, accepted: Mapping[str, Parameter], defaults: Mapping[str, Any]
    ) -> dict[str, Any]:
        """The scenario's values that a constructor takes, with the entry's where the scenario has none."""
        given = {name: getattr(self.s, name) for name in OF_CONTROLLER}
        given |= {name: x for name, x in defaults.items() if self._open(name)}
        told = {name: x for name, x in given.items() if x is not None}
        found = {name: x for name, x in told.items() if name in accepted}
        if "torque_limit" in accepted:
            found["torque_limit"] = self.s.torque_limit
        if "reset" in accepted:
            found["reset"] = ResetPolicy.named(self.s.reset)
        if "gains" in accepted and (gains := {name: told[name] for name in GAINS if name in told}):
            usual = accepted["gains"].default
            found["gains"] = replace(usual if is_dataclass(usual) else TABLE_II, **gains)  # type: ignore[type-var]
            self.used |= set(GAINS)
        if "observer" in accepted:
            self.used.add("observer")
            found.pop("observer", None)
            if (observer := self._observer(what, accepted["observer"], told)) is not None:
                found["observer"] = observer
        self.used |= set(found)
        return found

    def _open(self, name: str) -> bool:
        """Whether the scenario leaves it to the entry; poles stand in place of a bandwidth and its order."""
        s = self.s
        return getattr(s, name) is None and not (s.poles is not None and name in OF_OBSERVER)

    def _observer(self, what: str, taken: Parameter, told: Mapping[str, Any]) -> Observer | None:
        """None where the controller's own default holds."""
        usual = _default_class(taken, find("controller", self.s.controller).load())
        kind = usual if self.s.observer is None else find("observer", self.s.observer).load()
        makers = [make for name in MAKERS if (make := getattr(kind, name, None))]
        makers = makers if kind.__init__ is object.__init__ else [*makers, kind]
        offered = {name: told[name] for name in ("poles", "bandwidth", "order") if name in told}
        offered |= {"m": told["order"]} if "order" in told else {}
        offered |= self.s.own
        asked = any(
            name in accepted for make in makers for accepted in [takes(make)] for name in offered
        )
        if self.s.observer is None and not asked and taken.default is not Parameter.empty:
            return None
        return _first(f"the observer of {what}", makers, offered, self)


def _first(
    what: str, makers: list[Callable[..., Any]], offered: Mapping[str, Any], maker: Maker
) -> Observer:
    """By the first of the ways that has all it needs, and takes something of what is offered where any does."""
    fitting = [make for make in makers if not lacking(make, offered)] or makers[:1]
    best = max(fitting, key=lambda make: len(set(offered) & set(takes(make))))
    maker.known |= set(takes(best))
    maker.used |= set(offered) & set(takes(best)) | ({"order"} if "m" in takes(best) else set())
    made: Observer = construct(what, best, offered, Observer)
    return made


def _default_class(taken: Parameter, controller: Callable[..., Any]) -> type[Any]:
    """Of the observer that a controller has by itself."""
    if is_dataclass(controller):
        for f in fields(controller):
            if f.name == taken.name and callable(f.default_factory):
                return type(f.default_factory())
    usual = taken.default
    return type(usual) if isinstance(usual, Observer) else GPIObserver


def controller(
    s: Scenario, gait: Gait | None, biped: Biped, others: set[str] | None = None
) -> Controller:
    """The controller of a scenario. `others`: own values that something else takes.

    Raises InputError for a class that is not there or lacks something, an own value that nothing takes, and a
    value of the scenario that would do nothing.
    """
    maker = Maker(s, gait, biped)
    made = maker.made(s.controller)
    if type(made).output is Controller.output and made.laws is None:
        raise InputError(
            f"controller '{s.controller}' has neither a method output(s, m) nor laws; write one of them"
        )
    known = maker.known - {"reference", "gait", "biped", "outputs", "gains", "m"}
    for name in s.own:
        if name not in maker.used and name not in (others or ()):
            raise InputError(
                f"own value '{name}' of controller '{s.controller}': {unknown(name, sorted(known))}"
            )
    idle = [
        name
        for name in OF_CONTROLLER
        if getattr(s, name) != DEFAULTS[name] and name not in maker.used
    ]
    if idle:
        raise InputError(
            f"controller '{s.controller}' takes no {', '.join(idle)}: this would do nothing, leave it out"
        )
    return made
