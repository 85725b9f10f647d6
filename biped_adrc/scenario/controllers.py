"""Make the controller of a scenario: its class is found by name, and takes what its constructor names.

    reference, gait, biped, outputs (y = q_b - h)   of gait and robot
    gains                                           of K_p and K_d
    observer                                        of the record `observer`
    reset, solve_theta, torque_limit, stones        the scenario's values of these names
    inner                                           of an outer loop: the controller of the record `inner`
    everything else                                 the record's own values

On the left are names of parameters, on the right where their values come from. A record is a checked table of
plain values; `own` are those of its values that it does not declare, for a class of the user's. `takes` are the
parameters of a constructor, `lacking` those that have neither a default nor a value here. Observers are made by
their poles [rad/s], or by a bandwidth [rad/s] and an order, the number of extended states.

Wrappers go around the controller: the policy of the record `contact` (what the controller does while the
contact settles after a touchdown), and those of the registry's kind "around" for which the controller's record
has a number, such as a prediction [s]. A value that nothing takes is an error, since the user expected an
effect.
"""

from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np

from biped_adrc.control.around import AcrossContact
from biped_adrc.control.base import Controller
from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.core.errors import unknown
from biped_adrc.core.registry import REGISTRY, construct, find, lacking, takes
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.outputs import LinearOutputs
from biped_adrc.model.biped import Biped
from biped_adrc.observers.base import Observer, ResetPolicy
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.scenario.records import Misfit, named_part
from biped_adrc.scenario.scenario import ControllerRecord, ObserverRecord, Scenario

Arguments = dict[str, Any]
"""Arguments of a constructor by name."""
_WRAPPERS = ("contact", "prediction", "feedforward")
"""Values of a controller's record that wrap the controller."""
_AROUND = (*_WRAPPERS, "inner", "name")
"""Values of a controller's record that its constructor does not take."""
CONTEXT = ("biped", "gait", "reference", "outputs", "torque_limit", "stones", "gains", "inner")
"""Arguments of constructors that come from elsewhere in a scenario."""
GAINS = ("K_p", "K_d")
"""Values of a controller's record that change its gains."""
WRITE_ELSEWHERE = {"reset": "observer.reset", "period": "hardware.period", "like": ""}
"""Arguments of constructors that a controller's own record does not set, and what to write instead."""
OF_POLES = ("poles", "bandwidth", "order")
"""Values of the observer's record that say where its poles are."""


def controller(s: Scenario, gait: Gait, biped: Biped, stones: tuple[float, ...] = ()) -> Controller:
    """The controller of a scenario on this gait, with the robot `biped` as its model.

    stones: lengths [m] of the walking steps that lead from stone to stone, for a controller that places feet.

    Raises InputError for a class that is not there or lacks something, and a value that nothing takes.
    """
    # q_b = rows q, the angles of the joints with motors
    h, rows = gait.constraint, np.eye(biped.n)[: biped.p]
    known: Arguments = {
        "biped": biped,
        "gait": gait,
        "reference": h,
        "outputs": LinearOutputs(rows, h),
        "torque_limit": s.hardware.torque_limit,
        "stones": stones,
    }
    return _controller("controller", s.controller, known)


def _controller(place: str, c: ControllerRecord, known: Arguments) -> Controller:
    """The controller of a record c, with its wrappers; place: dotted name of the record, for messages.

    known: arguments that the scenario has for every constructor, which takes those that it names. A constructor
    that takes `inner` makes an outer loop, around the controller of the record `inner` (without one the default
    controller, ADRC). Wrappers go around the controller inside an outer loop and not around the loop, whose
    state would begin anew at each touchdown. Raises Misfit for a value of the record that nothing takes.
    """
    entry, what = find("controller", c.name), f"controller '{c.name}'"
    make = entry.load()  # the class, or a function, of this name
    accepted = takes(make)
    outer = "inner" in accepted
    if c.inner is not None and not outer:
        raise Misfit(f"{place}.inner", f"{what} is no outer loop, and takes none")
    if outer:
        inner = _controller(f"{place}.inner", c.inner or ControllerRecord(), known)
        values, used = {**c.own, "inner": inner}, set(accepted)
    else:
        values, used = _values(what, make, c, entry.defaults)
    # construct calls `make` with those of these values that are its parameters
    law = construct(what, make, {**known, **values}, Controller, place)
    # an error for a value of the record that neither the constructor took, nor its gains and observer, nor a
    # wrapper takes; `unknown` makes the sentence, with the nearest of the names that it could have been
    for at in c.dotted():
        head = at.partition(".")[0]
        if at in WRITE_ELSEWHERE and at in accepted:
            where = WRITE_ELSEWHERE[at] or "K_p, K_d and K_i"
            raise Misfit(f"{place}.{at}", f"is not set here; write {where}")
        if outer and head in _WRAPPERS:
            raise Misfit(f"{place}.{at}", f"{what} is an outer loop; write {place}.inner.{at}")
        # _AROUND: values that wrappers take; CONTEXT: arguments that the record does not have
        if head not in _AROUND and at not in used:
            others = [*accepted, *(GAINS if "gains" in accepted else ())]
            others = [x for x in others if x not in (*CONTEXT, *WRITE_ELSEWHERE)]
            whose = f"'{c.name}'"
            if head == "observer":  # an observer has values of its own
                others = [x for x in used if x.startswith("observer.") and x[9:] not in accepted]
                whose = f"the observer '{c.observer.name or 'by default'}' of {whose}"
            text = unknown(at, others).replace("unknown name", f"{whose} does not take it")
            raise Misfit(f"{place}.{at}", text)
    return law if outer else _around(place, c, law, known)


def _around(place: str, c: ControllerRecord, law: Controller, known: Arguments) -> Controller:
    """Wrap the controller `law` in the policy that the record `contact` of c names (what it does while contact
    settles), then in the registry's wrappers of the kind "around" for which c has a number other than 0, such
    as `prediction` [s].

    place: dotted name of the record c, for messages. known: arguments that the scenario has for every
    constructor, which takes those that it names.
    """
    contact = c.contact
    if contact.name is not None:
        own = contact.own | ({} if contact.window is None else {"window": contact.window})
        inside = {**known, "inner": law}
        law = named_part("contact", contact.name, inside, own, AcrossContact, f"{place}.contact")
    for name in REGISTRY["around"]:  # each wrapper takes the controller as `inner`
        if number := getattr(c, name):
            inside = {**known, "inner": law, name: number}
            law = named_part("around", name, inside, {}, Controller, place)
    return law


def _values(
    what: str, make: Callable[..., object], c: ControllerRecord, defaults: Mapping[str, Any]
) -> tuple[Arguments, set[str]]:
    """Arguments for the constructor `make` from a record c, and the dotted names of the values that were used,
    counted from that record, such as "observer.poles".

    A gain K_p or K_d in the record replaces that one of the constructor's default gains (without default those
    of Table II of the paper). what: the controller, for messages. defaults: the registry's values for what the
    record leaves out; they are not used beside poles, which already say what bandwidth and order would.
    """
    accepted, o = takes(make), c.observer
    # OF_POLES: poles, bandwidth and order of an observer
    settings = {name: x for name in OF_POLES if (x := getattr(o, name)) is not None}
    if o.poles is None:
        settings = {**defaults, **settings}
    gains = {name: x for name in GAINS if (x := getattr(c, name)) is not None}
    # a constructor may take poles and gains by their own names too, or inside `observer` and `gains` below
    values = {**c.own, **settings, **gains, "solve_theta": c.solve_theta}
    values["reset"] = ResetPolicy(o.reset)
    used = {*accepted, *(f"observer.{name}" for name in accepted)}
    if "gains" in accepted and gains:
        usual = accepted["gains"].default
        values["gains"] = replace(usual if isinstance(usual, Gains) else TABLE_II, **gains)
        used |= set(gains)
    if "observer" in accepted:
        observer, taken = _observer(what, make, o, settings)
        values |= {"observer": observer} if observer else {}
        used |= {f"observer.{name}" for name in taken}
    return values, used


def _observer(
    what: str, make: Callable[..., object], o: ObserverRecord, settings: Arguments
) -> tuple[Observer | None, set[str]]:
    """The observer for a controller, and the names of the values that it took; None if the controller's default
    observer is used.

    what, make: the controller in words, and its constructor. o: the record of the observer. settings: poles,
    bandwidth and order. An observer can be made by its constructor and by the `MAKERS` of its class (names of
    class methods, such as "from_poles"). Of those for which no argument is missing, the one that takes the most
    values is called. Observers name the order m.
    """
    usual = _default(make)  # the controller's default observer
    # ways: functions that make an observer of the class `kind`: makers first, then the class itself
    kind = type(usual) if o.name is None else find("observer", o.name).load()
    ways = [*(getattr(kind, name) for name in getattr(kind, "MAKERS", ())), kind]
    offered = {**settings, **o.own} | ({"m": settings["order"]} if "order" in settings else {})
    if o.name is None and not any(set(offered) & set(takes(way)) for way in ways):
        # nothing was asked for: None, unless the controller cannot be made without an observer
        return (usual if "observer" in lacking(make, ()) else None), set()
    # where an argument is missing for each of them, the first one is called, and says what it lacks
    fitting = [way for way in ways if not lacking(way, offered)] or ways[:1]
    best = max(fitting, key=lambda way: len(set(offered) & set(takes(way))))
    # the record's name was used to find the class
    taken = {"name", *takes(best)} | ({"order"} if "m" in takes(best) else set())
    law = construct(f"the observer of {what}", best, offered, Observer, "controller.observer")  # type: ignore[type-abstract]
    return law, taken


def _default(make: Callable[..., object]) -> Observer:
    """The default observer of a controller's constructor; the GPI observer of Table I where it has none."""
    # a default is a function without arguments of a dataclass's field, or the default of a parameter
    of_class = {f.name: f.default_factory for f in fields(make)} if is_dataclass(make) else {}
    factory = of_class.get("observer")
    usual = factory() if callable(factory) else takes(make)["observer"].default
    return usual if isinstance(usual, Observer) else GPIObserver.from_poles()
