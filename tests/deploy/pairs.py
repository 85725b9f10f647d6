"""A walker for every thing of the registry that a robot's computer runs, from the rows of the suite of leaves.

A thing that is new in the registry has a row there, or that suite fails. So it is exported, or refused, here.
"""

from functools import cache
from itertools import cycle
from typing import NamedTuple

import numpy as np

import biped_adrc as ba
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.deploy.apart import Apart, apart, python_calls
from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.loaded import UNOPTIMISED, Loaded
from biped_adrc.deploy.rounding import Rounding, proof
from biped_adrc.deploy.source import source_of
from biped_adrc.errors import InputError
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.observers.momentum import MomentumChain
from tests.control.conforms import PERIOD, gait, heavy, robot
from tests.control.test_conformance import ROWS, UNNAMED, made

KINDS = ("controller", "contact", "around", "observer", "sensor", "touchdown")
"""Kinds of the registry of which the computer has a part, or which decide how it is called."""
PUSH = [40.0, -30.0, 20.0, 10.0, 5.0]
"""Torques of a push [N m], which bring the motors to their limit."""
ENCODERS = ba.Sensors(1e5, filter_time=1e-3)
HARDWARE = {
    "ideal": {},
    "encoders": {"sensors": ENCODERS, "torque_limit": 150.0},
    "known delay": {
        "timing": ba.SampledTime(PERIOD, delay=1.95 * PERIOD, delay_known=True),
        "motors": ba.Motors(rate_limit=3e4),
        "torque_limit": 80.0,
    },
    "touchdown noticed": {
        "timing": ba.SampledTime(PERIOD, restart=False),
        "sensors": ENCODERS,
        "touchdown": ba.ByKinematics(after=0.01),
        "torque_limit": 150.0,
    },
}
"""Fields of a walker, by what the robot has."""


class Pair(NamedTuple):
    """A thing of the registry, and hardware."""

    kind: str
    name: str
    thing: object
    hardware: str

    @property
    def fields(self):
        """Fields of a walker that has both."""
        thing, laws = self.thing, {"controller": ba.NPDController(gait().constraint)}
        if self.kind in ("controller", "contact", "around"):
            laws = {"controller": thing}
        elif self.kind == "observer":
            around = (
                MomentumDOBController if isinstance(thing, MomentumChain) else ba.ADRCController
            )
            laws = {"controller": around(gait().constraint, thing)}
        elif self.kind == "reference":
            laws = {"controller": ba.NPDController(thing)}
        elif self.kind == "sensor":
            laws["sensors"] = thing
        elif self.kind == "touchdown":
            laws |= {"touchdown": thing, "timing": ba.SampledTime(PERIOD, restart=False)}
        return {"timing": ba.SampledTime(PERIOD)} | HARDWARE[self.hardware] | laws

    @property
    def walker(self):
        """On a plant that is not the model, pushed over the touchdown."""
        push = ba.TorquePulse(PUSH, step=1, start=0.01, stop=0.3)
        return ba.Walker(heavy(), model=robot(), disturbance=push, **self.fields)


def things():
    """Kind, name and thing: what the registry has of these kinds, and references, which it does not name."""
    for kind in KINDS:
        for name in ROWS[kind]:
            for thing in made(kind, name):
                yield kind, name, thing
    for name, row in UNNAMED.items():
        for thing in row(gait().constraint):
            if isinstance(thing, ba.Reference):
                yield "reference", name, thing


def pairs():
    """Every controller on all hardware, every other thing on one kind of it in turn."""
    given, each, other = list(things()), list(HARDWARE), cycle(HARDWARE)
    return [
        Pair(*thing, hardware)
        for thing in given
        for hardware in (each if thing[0] == "controller" else [next(other)])
    ]


def some_pairs():
    """The first thing of every name, and all hardware in turn."""
    first = {thing[:2]: thing for thing in reversed(list(things()))}
    return [Pair(*first[x], h) for x, h in zip(reversed(first), cycle(HARDWARE), strict=False)]


@cache
def before_touchdown(so_long):
    """(q, v), each (n,), so long [s] before the touchdown of the gait's orbit."""
    walker = ba.Walker(robot(), ba.NPDController(gait().constraint))
    arc = ba.walk(walker, gait(), 1).trajectory.arcs[0]
    x = arc.x[np.searchsorted(arc.t, arc.t[-1] - so_long)]
    return x[:5].copy(), x[5:10].copy()


class Proved(NamedTuple):
    """What was found of a pair."""

    refused: str
    """Why there is no C; empty where there is."""
    rounding: Rounding | None = None
    """Call by call."""
    apart: Apart | None = None
    """The walk."""
    kinds: frozenset[str] = frozenset()
    """Of calls in it."""


def short_walk(pair):
    """(q, v) shortly before a touchdown, and until when its walk goes on after that."""
    before = 0.11 if pair.kind == "touchdown" else 0.03
    return before_touchdown(before), RunOptions(before + 0.02)


def proved(pair, begin, options, every=1):
    """A pair exported, and compared with Python, by each or some of its calls and as a walk."""
    try:
        computer = Computer(pair.walker)
        loaded = Loaded(source_of(computer), flags=UNOPTIMISED)
    except InputError as reason:
        return Proved(str(reason))
    found = apart(computer, loaded, begin, options)
    calls = python_calls(computer, found.run)
    kinds = frozenset(call.kind for call in calls)
    return Proved("", proof(computer, loaded, calls, every), found, kinds)
