"""What a plant that moves by itself has to give, and the checks of what it gives.

    advance(state, u, outside, until) -> state, contacts, nodes

`closed_loop.stepping.SteppingLoop` drives such a plant, for instance MuJoCo or Drake behind a class
of the user's. `started` and `advanced` call the plant and check once what it gives. What breaks
this contract is an InputError that names the plant's class, what was found and what was expected.
Values that are not finite pass: the loop ends the run with NOT_FINITE, as for any plant.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np

from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array, Indices, frozen, read_only
from biped_adrc.hybrid.status import Status
from biped_adrc.model.ground import StepDown, StepUp

ROUND_OFF = 1e-9
"""Largest difference [s] between a plant's own clock and the time that it was to reach."""


class PlantState(NamedTuple):
    """The whole state of such a plant at one time."""

    t: float
    """[s]"""
    q: Array
    """Angles (n,) [rad]."""
    v: Array
    """Rates (n,) [rad/s]."""
    own: Array
    """What else the plant needs to go on, numbers of its own (k,)."""


class Load(NamedTuple):
    """What acts from outside at one time."""

    zeta: Array
    """Generalised force (n,) [N m] of the coordinates q, with the stance foot held."""
    force: Array
    """Resultant (x, z) (2,) [N], which a base that floats feels too."""


class Contact(NamedTuple):
    """A touchdown, which ends a single support; or, with a status, what ends the run, such as a fall."""

    name: str
    """Name of the event in the trajectory."""
    impulse: Array = np.zeros(2)
    """Of the ground (2,) [N s]."""
    ends: Status | None = None
    """Status with which the run ends; None for a touchdown."""


class Advanced(NamedTuple):
    """What a plant gives back: where it is, at `until` or just after the contacts, and how it came there.

    Every state has arrays of its own: those in one buffer that is written over would all be the last.
    """

    state: PlantState
    """At `until`, or just after the contacts."""
    contacts: tuple[Contact, ...]
    """All at the time of `state`, later than where `advance` began. They are one event: names joined by +,
    impulses added. Where some of them end the run, only those count: a fall with a touchdown is a fall."""
    nodes: tuple[PlantState, ...]
    """The states passed, at least one, without that where `advance` began, at increasing times. The last is
    the state just before the contacts, at the same time as `state`; without contacts it equals `state`."""


@runtime_checkable
class SteppingPlant(Protocol):
    """n coordinates, the first p of them with motors. Arrays that it is given are read-only."""

    @property
    def n(self) -> int:
        """Number of coordinates."""

    @property
    def p(self) -> int:
        """Number of motors."""

    @property
    def swap(self) -> Indices:
        """Relabelling of the motors at a touchdown (p,), for `types.relabelled`; `arange(p)` for none."""

    def start(self, t: float, q: Array, v: Array) -> PlantState:
        """The plant at t [s] in q (n,) [rad], v (n,) [rad/s], at rest inside (solver state, contacts)."""

    def advance(
        self,
        state: PlantState,
        u: Array,
        outside: Callable[[float, Array, Array], Load],
        until: float,
    ) -> Advanced:
        """On to `until` [s] or to the next contact, under u (p,) [N m] and outside(t, q, v).

        Where it cannot go on it raises `hybrid.integrators.StepFailed`, which ends the run with
        that status.
        """


@runtime_checkable
class StridingPlant(SteppingPlant, Protocol):
    """One whose word is taken: what `stride` and `landed` give is not checked, so that a sample instant costs
    microseconds. Its state is one row (q, q', own) (2 n + k,).
    """

    def stride(
        self, t: float, row: Array, u: Array, load: Load | None, until: float
    ) -> tuple[Array, tuple[Contact, ...]]:
        """The row at `until` [s] from one at t [s], under u (p,) [N m] and a load held, and the contacts
        there; before what these change.
        """

    def landed(self, state: PlantState, contacts: tuple[Contact, ...]) -> PlantState:
        """The state after these contacts."""


@runtime_checkable
class LaggingPlant(SteppingPlant, Protocol):
    """One whose motors may have a lag, so that its torque is not the one that is asked of them."""

    @property
    def lag(self) -> float:
        """Time constant [s]; 0 for none."""

    def lagging(self, lag: float) -> SteppingPlant:
        """The same plant with this lag [s]."""

    def motor_torque(self, own: Array, u: Array) -> Array:
        """Torque on the joints (.., p) [N m] where u (.., p) is asked of the motors, in states with `own`."""


@runtime_checkable
class UnevenPlant(SteppingPlant, Protocol):
    """One whose ground may have steps, counted in single supports."""

    @property
    def ground_steps(self) -> tuple[StepDown | StepUp, ...]:
        """Where the ground falls or rises."""

    def on_steps(self, steps: tuple[StepDown | StepUp, ...], first_step: int) -> SteppingPlant:
        """The same plant on these steps; its first single support is number `first_step`."""


def state_of(t: float, row: Array, n: int) -> PlantState:
    """A row (q, q', own) (2 n + k,) at t [s] in parts."""
    return PlantState(t, row[:n], row[n : 2 * n], row[2 * n :])


def motor_torque(plant: SteppingPlant, own: Array, u: Array) -> Array:
    """As `LaggingPlant.motor_torque`; u (.., p) [N m] itself where the plant knows of no lag."""
    return plant.motor_torque(own, u) if isinstance(plant, LaggingPlant) else u


def lag_of(plant: SteppingPlant) -> float:
    """Time constant of the plant's motors [s]; 0 for one that knows of none."""
    return plant.lag if isinstance(plant, LaggingPlant) else 0.0


def check_swap(plant: SteppingPlant) -> None:
    """Raise InputError for a relabelling that is none of p motors."""
    swap = np.asarray(plant.swap)
    if swap.dtype.kind != "i" or sorted(swap - plant.p * (swap >= plant.p)) != [*range(plant.p)]:
        raise InputError(
            f"{type(plant).__name__}.swap is {plant.swap!r}, expected an array of int with each of the numbers "
            f"0 to {plant.p - 1} once, plus {plant.p} where an angle changes its sign"
        )


def started(plant: SteppingPlant, t: float, q: Array, v: Array, own: int | None) -> PlantState:
    """What `plant.start` gives at t [s] for q (n,) [rad], v (n,) [rad/s], checked.

    own: how many numbers of its own are expected; None accepts any. Raises InputError where the
    plant starts elsewhere.
    """
    who = f"{type(plant).__name__}.start"
    state = _state(who, plant.start(t, read_only(q), read_only(v)), len(q), own)
    if state.t != t or not np.array_equal(state[1:3], (q, v)):
        raise InputError(f"{who} gives {state}, expected the t = {t} s, q = {q}, v = {v} given")
    return state


def advanced(
    plant: SteppingPlant,
    state: PlantState,
    u: Array,
    outside: Callable[[float, Array, Array], Load],
    until: float,
) -> Advanced:
    """What `plant.advance` gives under u (p,) [N m], checked, its last times at `until` [s] without
    round-off.

    Raises InputError for what breaks the contract.
    """
    who, sizes = f"{type(plant).__name__}.advance", (len(state.q), len(state.own))
    result = plant.advance(frozen(state), frozen(u), outside, until)
    if not (isinstance(result, Advanced) and type(result.contacts) is tuple and result.nodes):
        raise InputError(
            f"{who} gives {result!r:.60}, expected an Advanced(state, contacts, nodes)"
        )
    nodes = [_state(f"{who}: nodes[{k}]", node, *sizes) for k, node in enumerate(result.nodes)]
    after = _state(f"{who}: state", result.state, *sizes)
    if not result.contacts and not abs(after.t - until) <= ROUND_OFF:
        raise InputError(f"{who} came to {after.t} s without a contact, expected {until} s")
    if not state.t < after.t <= until + ROUND_OFF:
        raise InputError(
            f"{who} came to a contact at {after.t} s, expected after {state.t} s, not after {until} s"
        )
    times = [node.t for node in nodes]
    if not np.all(np.diff(times, prepend=state.t) > 0.0) or abs(times[-1] - after.t) > ROUND_OFF:
        raise InputError(
            f"{who} has nodes at {times} s, expected increasing times after {state.t} s, the last at "
            f"{after.t} s, the time of state"
        )
    end = until if abs(after.t - until) <= ROUND_OFF else after.t
    passed = *(node for node in nodes[:-1] if node.t < end), nodes[-1]._replace(t=end)
    return Advanced(after._replace(t=end), result.contacts, passed)


def _state(what: str, found: Any, n: int, own: int | None) -> PlantState:
    """`found` as a PlantState of n coordinates with float64 copies. Raises InputError."""
    try:
        state = PlantState(float(found[0]), *(np.array(x, dtype=float) for x in found[1:]))
        fits = state.q.shape == state.v.shape == (n,) and own in (None, len(state.own))
    except (TypeError, ValueError, LookupError):
        fits = False
    if not fits:
        raise InputError(
            f"{what} is {found!r:.60}, expected a PlantState(t, q, v, own) of {n} coordinates"
        )
    return state
