"""The controller of a scenario: its class is looked up, and made of what its constructor takes by name.

reference, gait, biped and outputs (y = q_b - h) come from the gait; gains from K_p and K_d; observer from the
observer's name, poles, bandwidth, order; reset, solve_theta and torque_limit are the scenario's. All else is in
`Scenario.own`. A class that takes `inner` goes around another controller, own value `inner`, and has its values
from `own` alone.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace
from typing import Any

import numpy as np

from biped_adrc.control.base import Controller
from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.outputs import LinearOutputs
from biped_adrc.model.biped import Biped
from biped_adrc.observers.base import Observer, ResetPolicy
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.scenario.registry import construct, find, lacking, spelled, takes
from biped_adrc.scenario.scenario import DEFAULTS, FIELDS, Scenario
from biped_adrc.scenario.values import unknown

GAINS = ("K_p", "K_d")
OF_OBSERVER = ("observer", "poles", "bandwidth", "order")
OF_CONTROLLER = (*GAINS, *OF_OBSERVER, "reset", "solve_theta")
"""Values of a scenario that a controller takes, or that do nothing."""
CONTEXT = ("reference", "gait", "biped", "outputs")
"""What the gait and the robot give."""
BY_ITSELF = (*CONTEXT, *OF_CONTROLLER, "gains", "torque_limit")
"""What a constructor has from the scenario, never from own values; an outer loop has `CONTEXT` alone."""
SOURCES = {name: name for name in FIELDS} | {
    "reference": "gait",
    "outputs": "gait",
    "biped": "robot",
    "gains": "K_p and K_d",
    "step": "pushed_step",
    "start": "onset",
    "stop": "duration",
    "bandwidth": "bandwidth, of noise frequency,",
}
"""By the name that a constructor has, the value of the scenario that it comes from."""
MAKER = "from_"
"""How the methods begin that make an observer, beside its constructor."""


@dataclass
class Maker:
    """Makes the controller; `used` gathers values of the scenario that something takes, `mine` own values."""

    s: Scenario
    gait: Gait
    biped: Biped
    used: set[str] = field(default_factory=set)
    mine: set[str] = field(default_factory=set)
    known: set[str] = field(default_factory=set)

    def made(self, name: str) -> Controller:
        """The controller by name. Raises InputError for what is missing, does not fit, or does nothing."""
        entry, what = find("controller", name), f"controller '{name}'"
        make = entry.load()
        outer = "inner" in takes(make)
        values = self._context() | (
            {"inner": self._inner(what, name)} if outer else self._taken(what, make, entry.defaults)
        )
        mine = self._own((*CONTEXT, "inner") if outer else BY_ITSELF)
        made: Controller = construct(what, make, values | mine, Controller)
        self._seen(make, (), (*mine, "inner") if outer else mine)
        return made

    def _own(self, given: Container[str]) -> dict[str, Any]:
        """Own values, but for those that are given by themselves."""
        return {name: x for name, x in self.s.own.items() if name not in given}

    def _seen(self, make: Callable[..., Any], offered: Iterable[str], mine: Iterable[str]) -> None:
        accepted = set(takes(make))
        self.known |= accepted
        self.used |= set(offered) & accepted
        self.mine |= set(mine) & accepted

    def _context(self) -> dict[str, Any]:
        """What the gait and the robot give."""
        h, rows = self.gait.constraint, np.eye(self.biped.n)[: self.biped.p]
        outputs = LinearOutputs(rows, h)
        return {"biped": self.biped, "gait": self.gait, "reference": h, "outputs": outputs}

    def _inner(self, what: str, name: str) -> Controller:
        inner = self.s.own.get("inner", Scenario.controller)
        if not isinstance(inner, str) or spelled("controller", inner) == name:
            raise InputError(
                f"{what} goes around an inner controller, found {inner!r}, expected a name"
            )
        return self.made(spelled("controller", inner))

    def _taken(
        self, what: str, make: Callable[..., Any], defaults: Mapping[str, Any]
    ) -> dict[str, Any]:
        """The scenario's values that a constructor takes, with the entry's where the scenario has none."""
        given = {name: getattr(self.s, name) for name in OF_CONTROLLER}
        if self.s.poles is None:  # which stand in place of a bandwidth and its order
            given |= {name: x for name, x in defaults.items() if given[name] is None}
        told = {name: x for name, x in given.items() if x is not None}
        found = {
            **told,
            "torque_limit": self.s.torque_limit,
            "reset": ResetPolicy.named(self.s.reset),
        }
        found.pop("observer", None)
        accepted = takes(make)
        self._seen(make, OF_CONTROLLER, ())
        if "gains" in accepted and (gains := {name: told[name] for name in GAINS if name in told}):
            usual = accepted["gains"].default
            found["gains"] = replace(usual if isinstance(usual, Gains) else TABLE_II, **gains)
            self.used |= set(GAINS)
        if "observer" in accepted and (observer := self._observer(what, make, told)):
            found["observer"] = observer
        return found

    def _observer(
        self, what: str, make: Callable[..., Any], told: Mapping[str, Any]
    ) -> Observer | None:
        """By the way that takes most of what there is; None where the controller's own default holds."""
        usual = _default(make)
        kind = type(usual) if self.s.observer is None else find("observer", self.s.observer).load()
        makers = [*(getattr(kind, name) for name in _ways(kind)), kind]
        offered = {name: told[name] for name in ("poles", "bandwidth", "order") if name in told}
        mine = self._own(BY_ITSELF)
        offered |= mine | ({"m": told["order"]} if "order" in told else {})
        asked = any(set(offered) & set(takes(way)) for way in makers)
        if self.s.observer is None and not asked:
            return usual if "observer" in lacking(make, ()) else None
        fitting = [way for way in makers if not lacking(way, offered)] or makers[:1]
        best = max(fitting, key=lambda way: len(set(offered) & set(takes(way))))
        self._seen(best, offered, mine)
        self.used |= {"order"} if "m" in takes(best) else set()
        return construct(f"the observer of {what}", best, offered, Observer)


def _ways(kind: Any) -> list[str]:
    """Names of the methods `from_...` of a class and those above it, in the order they are written."""
    classes = getattr(kind, "__mro__", ())
    return list(dict.fromkeys(x for cls in classes for x in vars(cls) if x.startswith(MAKER)))


def _default(make: Callable[..., Any]) -> Observer:
    """The observer that a controller has by itself; of Table I where it has none."""
    of_class = {f.name: f.default_factory for f in fields(make)} if is_dataclass(make) else {}
    factory = of_class.get("observer")
    usual = factory() if callable(factory) else takes(make)["observer"].default
    return usual if isinstance(usual, Observer) else GPIObserver.from_poles()


def controller(s: Scenario, gait: Gait, biped: Biped, others: set[str] | None = None) -> Controller:
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
    known = sorted(maker.known - {*BY_ITSELF, "m"})
    for name in s.own:
        if name not in maker.mine and name not in (others or ()):
            found = (
                f"it comes by itself from {SOURCES[name]} of the scenario; give that, not an own value"
                if name in SOURCES
                else unknown(name, known, FIELDS)
            )
            raise InputError(f"own value '{name}' of controller '{s.controller}': {found}")
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
