"""The controller of a scenario: its class is looked up, and called with what its constructor takes by name.

    reference, gait, biped, outputs (y = q_b - h)   from gait and robot
    gains                                           from K_p and K_d
    observer                                        from the observer's name, poles, bandwidth and order
    reset, solve_theta, torque_limit                the scenario's values of these names
    everything else                                 from `Scenario.own`

A class that takes `inner` goes around another controller, named by the own value `inner`, and has its other
values from `own` alone. The maker notes which values were taken: one that nothing takes is an error, since the
user expected an effect from it. `build.build` calls `controller`.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace

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
"""Fields of a scenario from which `gains` are made."""
OF_OBSERVER = ("observer", "poles", "bandwidth", "order")
"""Fields of a scenario from which `observer` is made."""
OF_CONTROLLER = (*GAINS, *OF_OBSERVER, "reset", "solve_theta")
"""Fields of a scenario that either the controller takes, or that have no effect."""
CONTEXT = ("reference", "gait", "biped", "outputs")
"""Arguments that gait and robot give."""
BY_ITSELF = (*CONTEXT, *OF_CONTROLLER, "gains", "torque_limit")
"""Arguments that come from the scenario's fields, never from own values; an outer loop has `CONTEXT` alone."""
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
"""For an argument of a constructor, the field of the scenario that it comes from, for messages."""
MAKER = "from_"
"""How the names of the class methods begin that make an observer, besides its constructor."""


@dataclass
class ControllerMaker:
    """Makes the controller of a scenario, its inner ones and its observer, and notes which values are taken."""

    s: Scenario
    gait: Gait
    biped: Biped
    """The model that the controller has of the robot."""
    used: set[str] = field(default_factory=set)
    """Fields of the scenario that something took."""
    mine: set[str] = field(default_factory=set)
    """Own values that something took."""
    known: set[str] = field(default_factory=set)
    """All arguments that the constructors have."""

    def made(self, name: str) -> Controller:
        """The controller of this name. Raises InputError for what is missing or does not fit."""
        entry, what = find("controller", name), f"controller '{name}'"
        make = entry.load()
        outer = "inner" in takes(make)
        values = self._context() | (
            {"inner": self._inner(what, name)} if outer else self._taken(what, make, entry.defaults)
        )
        mine = self._own((*CONTEXT, "inner") if outer else BY_ITSELF)
        made = construct(what, make, values | mine, Controller)
        self._seen(make, (), (*mine, "inner") if outer else mine)
        return made

    def _own(self, given: Container[str]) -> dict[str, object]:
        """Own values of the scenario, without the names in `given`."""
        return {name: x for name, x in self.s.own.items() if name not in given}

    def _seen(
        self, make: Callable[..., object], offered: Iterable[str], mine: Iterable[str]
    ) -> None:
        """Note which of the offered fields and own values a constructor takes."""
        accepted = set(takes(make))
        self.known |= accepted
        self.used |= set(offered) & accepted
        self.mine |= set(mine) & accepted

    def _context(self) -> dict[str, object]:
        """Robot, gait, reference h(Theta) and outputs y = q_b - h(Theta), by the names of `CONTEXT`."""
        h, rows = self.gait.constraint, np.eye(self.biped.n)[: self.biped.p]
        outputs = LinearOutputs(rows, h)
        return {"biped": self.biped, "gait": self.gait, "reference": h, "outputs": outputs}

    def _inner(self, what: str, name: str) -> Controller:
        """The controller inside of `name`: own value `inner`, by default the default controller."""
        inner = self.s.own.get("inner", Scenario.controller)
        if not isinstance(inner, str) or spelled("controller", inner) == name:
            raise InputError(
                f"{what} goes around an inner controller, found {inner!r}, expected a name"
            )
        return self.made(spelled("controller", inner))

    def _taken(
        self, what: str, make: Callable[..., object], defaults: Mapping[str, object]
    ) -> dict[str, object]:
        """The scenario's values for a constructor, gains and observer made of theirs.

        Gains that are given replace those of the constructor's default, one by one. Poles stand in place of a
        bandwidth and an order, so the entry's defaults of these are then left out.

        defaults: those of the registry's entry, which hold where the scenario has none.
        """
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
        self, what: str, make: Callable[..., object], told: Mapping[str, object]
    ) -> Observer | None:
        """The observer, made by the constructor or the class method of `MAKERS` that takes most of what is
        given.

        told: values of the scenario that are given, such as poles, or a bandwidth and an order. Among the ways
        that lack nothing the one that takes most is called, so that no value is dropped that another way would
        take. None where nothing is given and the controller's own default holds.
        """
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


def _ways(kind: object) -> list[str]:
    """Names of the methods `from_...` of a class and those above it, in the order they are written."""
    classes = getattr(kind, "__mro__", ())
    return list(dict.fromkeys(x for cls in classes for x in vars(cls) if x.startswith(MAKER)))


def _default(make: Callable[..., object]) -> Observer:
    """The default observer of a controller's constructor; the GPI observer of Table I where it has none."""
    of_class = {f.name: f.default_factory for f in fields(make)} if is_dataclass(make) else {}
    factory = of_class.get("observer")
    usual = factory() if callable(factory) else takes(make)["observer"].default
    return usual if isinstance(usual, Observer) else GPIObserver.from_poles()


def controller(s: Scenario, gait: Gait, biped: Biped, others: set[str] | None = None) -> Controller:
    """The controller of a scenario on this gait, for the model `biped`. others: own values that the push takes.

    Raises InputError for a class that is not there or lacks something, an own value that nothing takes, and a
    value of the scenario that would have no effect.
    """
    maker = ControllerMaker(s, gait, biped)
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
