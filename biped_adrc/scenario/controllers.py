"""Make the controller that a scenario names: find its class, and give its constructor the arguments it takes.

Where each argument comes from, by its name:

    reference, gait, biped, outputs (y = q_b - h)   from gait and robot
    gains                                           from K_p and K_d
    observer                                        from the observer's name, poles, bandwidth and order
    reset, solve_theta, torque_limit                the scenario's values of these names
    inner, window                                   of a policy across contact: the controller, contact_window
    inner, and the entry's name                     of an entry `[around]` of the registry: the controller, and
                                                    the scenario's number of that name
    everything else                                 from `Scenario.own`

"Own values" are those in `Scenario.own`: what a controller or observer takes beside the scenario's fields. An
outer loop is a controller whose constructor takes `inner`, another controller. The own value `inner` names
that, and the outer loop has gait and robot, and all its other arguments from own values. The maker notes which
values were taken: one that nothing takes is an error, since the user expected an effect from it. `build.build`
calls `controller`.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace

import numpy as np

from biped_adrc.control.across_contact import AcrossContact
from biped_adrc.control.base import Controller
from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.outputs import LinearOutputs
from biped_adrc.model.biped import Biped
from biped_adrc.observers.base import Observer, ResetPolicy
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.scenario.registry import REGISTRY, construct, find, lacking, spelled, takes
from biped_adrc.scenario.scenario import DEFAULTS, FIELDS, NAMED, Scenario
from biped_adrc.scenario.values import unknown

GAINS = ("K_p", "K_d")
"""Fields of a scenario from which `gains` are made."""
OF_OBSERVER = ("observer", "poles", "bandwidth", "order")
"""Fields of a scenario from which `observer` is made."""
OF_CONTROLLER = (*GAINS, *OF_OBSERVER, "reset", "solve_theta")
"""Fields of a scenario that are for the controller alone; a value that it does not take is an error."""
OF_CONTACT = ("inner", "window")
"""Arguments of a policy across contact that are the controller, and `contact_window`."""
CONTEXT = ("reference", "gait", "biped", "outputs")
"""Names of the arguments that are made of gait and robot."""
BY_ITSELF = (*CONTEXT, *OF_CONTROLLER, "gains", "torque_limit")
"""Arguments that never come from own values, but from the scenario's fields or from gait and robot. For an
outer loop these are only `CONTEXT`, and `inner`, which is named by an own value.
"""
SOURCES = {name: name for name in FIELDS} | {
    "reference": "gait",
    "outputs": "gait",
    "biped": "robot",
    "gains": "K_p and K_d",
    "window": "contact_window",
    "step": "pushed_step",
    "start": "onset",
    "stop": "duration",
    "bandwidth": "bandwidth, of noise frequency,",
}
"""For an argument of a constructor, the field of the scenario that it comes from, for messages."""
MAKER = "from_"
"""An observer is made by its constructor, or by a class method whose name begins with this."""


@dataclass
class ControllerMaker:
    """Makes the controller of a scenario, its inner ones and its observer, and notes which values are taken."""

    s: Scenario
    gait: Gait
    biped: Biped
    """The model that the controller has of the robot."""
    used: set[str] = field(default_factory=set)
    """Names of the scenario's fields that some constructor took."""
    mine: set[str] = field(default_factory=set)
    """Names of own values that some constructor took."""
    known: set[str] = field(default_factory=set)
    """Names of all arguments of the constructors called so far, for messages."""

    def made(self, name: str) -> Controller:
        """Make the controller of this name. Raises InputError for what is missing or does not fit."""
        entry, what = find("controller", name), f"controller '{name}'"
        make = entry.load()
        outer = "inner" in takes(make)
        values = self._context() | (
            {"inner": self._inner(what, name)} if outer else self._taken(what, make, entry.defaults)
        )
        mine = self._own((*CONTEXT, "inner") if outer else BY_ITSELF)
        made = construct(what, make, values | mine, Controller)
        self._seen(make, (), (*mine, "inner") if outer else mine)
        # an outer loop goes around the policies: its state does not begin anew at a touchdown
        if not outer:
            made = self._across_contact(made)
            for name in REGISTRY["around"]:
                made = self._around(name, made)
        return made

    def _around(self, name: str, inner: Controller) -> Controller:
        """What has the scenario's number of this name, around a controller; itself where that is 0."""
        number = getattr(self.s, name)
        if number == 0.0:
            return inner
        make, own = find("around", name).load(), self._own((*CONTEXT, "inner", name))
        self._seen(make, (), own)
        given = {**self._context(), **own, "inner": inner, name: number}
        return construct(f"{name} = {number:g}", make, given, Controller)

    def _across_contact(self, inner: Controller) -> Controller:
        """The policy across contact of the scenario, around a controller; itself where there is none."""
        name, window = self.s.contact, self.s.contact_window
        if name is None:
            return inner
        make, own = find("contact", name).load(), self._own((*CONTEXT, *OF_CONTACT))
        given = {**self._context(), "inner": inner, **own}
        if window is not None:
            given["window"] = window
            self.used |= {"contact_window"} if "window" in takes(make) else set()
        self._seen(make, (), own)
        what = f"contact '{name}'"
        return construct(what, make, given, AcrossContact)

    def _own(self, given: Container[str]) -> dict[str, object]:
        """Own values by name, without those whose names are in `given`."""
        return {name: x for name, x in self.s.own.items() if name not in given}

    def _seen(
        self, make: Callable[..., object], offered: Iterable[str], mine: Iterable[str]
    ) -> None:
        """Note which of these fields (`offered`) and own values (`mine`) the constructor `make` takes."""
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
        """Make the inner controller of the outer loop `name`: own value `inner`, or the scenario's default.

        what: the outer loop in words, for messages. Raises InputError where `inner` is no name, or `name`
        itself.
        """
        inner = self.s.own.get("inner", Scenario.controller)
        if not isinstance(inner, str) or spelled("controller", inner) == name:
            raise InputError(
                f"{what} goes around an inner controller, found {inner!r}, expected a name"
            )
        return self.made(spelled("controller", inner))

    def _taken(
        self, what: str, make: Callable[..., object], defaults: Mapping[str, object]
    ) -> dict[str, object]:
        """Arguments by name for the constructor `make`: the scenario's values, gains and observer made of them.

        A gain that is given, K_p or K_d, replaces that one of the constructor's default gains. defaults: values
        of the registry's entry, taken where the scenario has none; but not with poles, which already say what
        bandwidth and order would. what: the controller in words, for messages.
        """
        given = {name: getattr(self.s, name) for name in OF_CONTROLLER}
        if self.s.poles is None:  # which stand in place of a bandwidth and its order
            given |= {name: x for name, x in defaults.items() if given[name] is None}
        told = {name: x for name, x in given.items() if x is not None}
        reset = ResetPolicy.named(self.s.reset)
        found = {**told, "torque_limit": self.s.torque_limit, "reset": reset}
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
        """Make the observer for the controller `make`; None where nothing is given and its own default holds.

        told: values that are given, such as poles, or a bandwidth and an order. Ways to make it are the
        constructor and the class methods `from_...` of its class. Of those ways for which no argument is
        missing, the one that takes the most values is called. what: the controller in words, for messages.
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
        return construct(f"the observer of {what}", best, offered, Observer)  # type: ignore[type-abstract]


def _takers(name: str) -> str:
    """Which things of the registry, not chosen in the scenario, take an own value of this name; "" for none."""
    found = []
    for chosen_by in ("observer", "sensor", "touchdown", "push"):
        for known, entry in REGISTRY[NAMED[chosen_by]].items():
            make = entry.load()
            if any(name in takes(way) for way in (make, *(getattr(make, x) for x in _ways(make)))):
                found.append(f"{chosen_by} = '{known}'")
    return f"; {' or '.join(found)} takes it, and is not chosen here" if found else ""


def _ways(kind: object) -> list[str]:
    """Names of the methods `from_...` of a class and its base classes, in the order they are written."""
    classes = getattr(kind, "__mro__", ())
    return list(dict.fromkeys(x for cls in classes for x in vars(cls) if x.startswith(MAKER)))


def _default(make: Callable[..., object]) -> Observer:
    """The default observer of a controller's constructor; the GPI observer of Table I where it has none."""
    of_class = {f.name: f.default_factory for f in fields(make)} if is_dataclass(make) else {}
    factory = of_class.get("observer")
    usual = factory() if callable(factory) else takes(make)["observer"].default
    return usual if isinstance(usual, Observer) else GPIObserver.from_poles()


def controller(s: Scenario, gait: Gait, biped: Biped, others: set[str] | None = None) -> Controller:
    """Make the controller of a scenario on this gait, which knows the robot as the model `biped`.

    others: names of own values that push, plant or hardware take, and so the controller need not.
    Raises InputError for a class that is not there or lacks something, an own value that nothing takes, and a
    value of the scenario that would have no effect.
    """
    maker = ControllerMaker(s, gait, biped)
    made = maker.made(s.controller)
    if type(made).output is Controller.output:
        raise InputError(f"controller '{s.controller}' has no method output(s, m); write it")
    known = sorted(maker.known - {*BY_ITSELF, "m", "window"})
    for name in s.own:
        if name not in maker.mine and name not in (others or ()):
            found = (
                f"it comes by itself from {SOURCES[name]} of the scenario; give that, not an own value"
                if name in SOURCES
                else unknown(name, known, FIELDS) + _takers(name)
            )
            raise InputError(f"own value '{name}' of controller '{s.controller}': {found}")
    idle = [
        name
        for name in (*OF_CONTROLLER, "contact_window")
        if getattr(s, name) != DEFAULTS[name] and name not in maker.used
    ]
    if idle:
        raise InputError(
            f"controller '{s.controller}' takes no {', '.join(idle)}: this would do nothing, leave it out"
        )
    return made
