"""What rounding does to a controller: the proof of an exported one, call by call.

    difference      exported controller - Python, from the same state at the same measurement
    amplification   what one unit in the last place (ulp) of all that a call is given does in Python

An exported controller is right where it differs from Python by no more than some ulps of its inputs
would. Python runs the laws with Pinocchio's model, so nothing of the generated code is its own judge.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from biped_adrc.closed_loop import semantics
from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.functions import sent_last
from biped_adrc.deploy.layout import fields_of
from biped_adrc.deploy.loaded import OK, Loaded, Record
from biped_adrc.deploy.records import NONE, RecordedCall
from biped_adrc.errors import InputError, SimulationError
from biped_adrc.hardware.sample_hold import read
from biped_adrc.types import Array


class Given(NamedTuple):
    """A call, and the state in which it finds the computer."""

    call: RecordedCall
    mode: Mode
    """Single support of the call: of a touchdown, the one that begins."""
    last: float
    """Time of the sample instant before [s]."""
    x: Array
    """x_c before it, empty at init."""


class Result(NamedTuple):
    """What a call makes."""

    x: Array
    """x_c after it."""
    u: Array
    """Torque (p,) [N m], empty but for step."""


@dataclass(frozen=True)
class Rounding:
    """Largest numbers over the calls of a walk."""

    calls: int
    torque: float
    """Largest torque [N m]."""
    difference: float
    """Of the torque, exported - Python [N m]."""
    amplification: float
    """Of the torque, by one ulp of all inputs [N m]."""
    worst: float
    """Largest ratio of both, over the torque and every number of the state."""


class PythonComputer:
    """The functions of a computer in Python."""

    def __init__(self, computer: Computer):
        self.computer, self.walker = computer, computer.alone
        self.n = computer.walker.plant.n

    def __call__(self, given: Given) -> Result:
        """What a call makes."""
        call = given.call
        if call.kind == "init":
            x = self.walker.initial_state(call.q, call.v, given.mode)
            return Result(x[2 * self.n :], NONE)
        before = np.concatenate((call.q, call.v, given.x))
        if call.kind == "touchdown":
            q, v, none = call.q, call.v, np.zeros(2)
            x = semantics.landed(self.walker, call.t, before, q, v, none, given.mode)
            return Result(x[2 * self.n :], NONE)
        time, k = self.walker.timing, self.walker.held
        assert k is not None
        late = k.motors.fraction * time.period if k.sizes.waiting else np.inf  # type: ignore[union-attr]
        if call.t - given.last >= late - 1e-9:
            before = semantics.release(self.walker, before)
        x = self.walker.tick(call.t, before, given.mode)
        return Result(
            x[2 * self.n :], sent_last(read(k.sizes, semantics.parts(self.walker, x)[3]).line)
        )


def in_python(computer: Computer, calls: Sequence[RecordedCall]) -> list[tuple[Given, Result]]:
    """All calls in Python, each from the controller's state s that the walk had there.

    Without the last one where it loses the walk; what then becomes of it, `deploy.apart` compares.
    """
    python, made = PythonComputer(computer), list[tuple[Given, Result]]()
    x, last, mode = NONE, calls[0].t, Mode(1, calls[0].t)
    for call in calls:
        if call.kind == "touchdown":
            mode = Mode(mode.step + 1, call.t)
        given = Given(call, mode, last, x)
        try:
            made.append((given, python(given)))
        except SimulationError:
            if call is calls[-1]:
                break
            raise
        x = made[-1][1].x.copy()
        x[: len(call.s)] = call.s
        last = call.t if call.kind != "touchdown" else last
    return made


def by_one_ulp(x: Array, random: np.random.Generator, real: str = "float64") -> Array:
    """Every number of x (K,) up or down by one ulp of "float64" or "float32"."""
    ulp = np.spacing(np.abs(x).astype(real)).astype(float)
    return x + random.choice((-1.0, 1.0), len(x)) * ulp


def nudged(given: Given, random: np.random.Generator, real: str = "float64") -> Given:
    """The same call with every angle, rate and number of the state up or down by one ulp of a type."""
    call, x = given.call, by_one_ulp(given.x, random, real)
    q, v = by_one_ulp(call.q, random, real), by_one_ulp(call.v, random, real)
    return given._replace(call=call._replace(q=q, v=v), x=x)


def in_c(computer: Computer, loaded: Loaded, given: Given) -> Result:
    """What the exported controller makes of a call. Raises InputError where it has no result."""
    call, names = given.call, set(loaded.state.names or ())
    m, u = loaded.measured(call.t, call.q, call.v), NONE
    size = len(given.x) - computer.held.sizes.total
    x = _struct(computer, loaded, given, size, names)
    if call.kind == "init":
        flag, x = loaded.init(m)
        size = x["s"].size if "s" in names else 0
    elif call.kind == "touchdown":
        flag = loaded.touchdown(x, m)
    else:
        flag, u = loaded.step(x, m)
    if flag != OK:
        raise InputError(f"{call.kind} at t = {call.t:g} s returned {flag}, expected {OK}")
    fields = fields_of(computer, size)
    parts = [x[f.name] if f.name in names else np.full(f.size, np.nan) for f in fields]
    return Result(np.concatenate(parts).astype(float), u.astype(float))


def _struct(computer: Computer, loaded: Loaded, given: Given, size: int, names: set[str]) -> Record:
    """The struct of C for a call."""
    x, at = np.zeros((), loaded.state), 0
    landing = given.call.kind == "touchdown"
    x["step"], x["start"], x["last"] = given.mode.step - landing, given.mode.start, given.last
    if len(given.x):
        for field in fields_of(computer, size):
            if field.name in names:
                x[field.name] = given.x[at : at + field.size]
            at += field.size
    return x


def proof(
    computer: Computer, loaded: Loaded, calls: Sequence[RecordedCall], every: int = 1, seed: int = 0
) -> Rounding:
    """The exported controller beside Python over the calls of a walk; ulps are those of its type.

    every: which of the calls of step are looked at; those of init and touchdown are always.
    """
    random, python = np.random.default_rng(seed), PythonComputer(computer)
    p, torque = computer.held.sizes.p, 0.0
    off = np.zeros(p + len(in_python(computer, calls[:1])[0][1].x))
    moved = off.copy()
    for i, (given, found) in enumerate(in_python(computer, calls)):
        if given.call.kind == "step" and i % every > 1:
            continue
        here = in_c(computer, loaded, given)
        shaken = python(nudged(given, random, loaded.real))
        off = np.fmax(off, np.abs(_row(here, p) - _row(found, p)))  # NaN: no place in the struct
        moved = np.fmax(moved, np.abs(_row(shaken, p) - _row(found, p)))
        torque = float(np.max(np.abs(found.u), initial=torque))
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(off > 0.0, off / moved, 0.0)
    most = float(np.max(off[:p])), float(np.max(moved[:p]))
    return Rounding(len(calls), torque, *most, float(np.max(ratio)))


def _row(found: Result, p: int) -> Array:
    """Torque, NaN where there is none, and state in one row."""
    return np.concatenate((found.u if len(found.u) else np.full(p, np.nan), found.x))
