"""What a plant that moves by itself has to give, and the checks of what it gives.

    advance(state, u, outside, until) -> state, contacts, nodes

`closed_loop.stepping.SteppingLoop` drives such a plant, for instance MuJoCo or Drake behind a class
of the user's. `started` and `advanced` call the plant and check once what it gives. What breaks
this contract is an InputError that names the plant's class, what was found and what was expected;
an exception of the plant's own is a SimulationError. Values that are not finite pass: the loop ends
the run with NOT_FINITE, as for any plant.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np

from biped_adrc.errors import BipedError, InputError, SimulationError
from biped_adrc.hybrid.integrators import StepFailed
from biped_adrc.hybrid.status import Status
from biped_adrc.model.ground import StepDown, StepUp
from biped_adrc.types import Array, Indices, read_only

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
    fits = swap.dtype.kind == "i" and swap.shape == (plant.p,)
    if not fits or not np.array_equal(
        np.sort(swap - plant.p * (swap >= plant.p)), np.arange(plant.p)
    ):
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
    found = _called(who, plant.start, t, read_only(q), read_only(v))
    state = _state(who, found, len(q), own)
    if state.t != t or not np.array_equal(state[1:3], (q, v)):
        raise InputError(
            f"{who} gives t = {state.t} s, q = {state.q}, v = {state.v}, expected those that it was given: "
            f"t = {t} s, q = {q}, v = {v}"
        )
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
    who, (t, *arrays) = f"{type(plant).__name__}.advance", state
    given = PlantState(t, *(read_only(numbers) for numbers in arrays)), read_only(u)
    found = _called(who, plant.advance, *given, outside, until)
    if not isinstance(found, Advanced):
        raise InputError(f"{who} gives {found!r:.60}, expected an Advanced(state, contacts, nodes)")
    sizes = len(state.q), len(state.own)
    nodes = [
        _state(f"{who}: nodes[{k}]", node, *sizes)
        for k, node in enumerate(_tuple(f"{who}: nodes", found.nodes))
    ]
    contacts = [
        _contact(f"{who}: contacts[{k}]", contact)
        for k, contact in enumerate(_tuple(f"{who}: contacts", found.contacts))
    ]
    after = _state(f"{who}: state", found.state, *sizes)
    return _in_time(who, state.t, until, Advanced(after, tuple(contacts), tuple(nodes)))


def _called(who: str, method: Callable[..., object], *given: object) -> object:
    """method(*given); what it raises of its own becomes a SimulationError that names it."""
    try:
        return method(*given)
    except (BipedError, StepFailed):
        raise
    except Exception as error:
        raise SimulationError(
            f"{who} raised {type(error).__name__}: {error}; a plant that cannot go on raises "
            "biped_adrc.hybrid.integrators.StepFailed"
        ) from error


def _numbers(what: str, found: object, shape: tuple[int, ...]) -> Array:
    """A copy in float64 of the expected shape. Raises InputError."""
    try:
        numbers = np.array(found, dtype=float)
    except (TypeError, ValueError):
        numbers = None
    if numbers is None or numbers.shape != shape:
        raise InputError(f"{what} is {found!r:.60}, expected numbers in an array of shape {shape}")
    return numbers


def _tuple(what: str, found: object) -> tuple[object, ...]:
    """`found`, if it is a tuple. Raises InputError."""
    if type(found) is not tuple:
        raise InputError(f"{what} is {found!r:.60}, expected a tuple")
    return found


def _state(what: str, found: object, n: int, own: int | None) -> PlantState:
    """`found` as a PlantState of n coordinates with float64 copies. Raises InputError."""
    if not isinstance(found, PlantState):
        raise InputError(f"{what} is {found!r:.60}, expected a PlantState(t, q, v, own)")
    return PlantState(
        float(_numbers(f"{what}.t", found.t, ())),
        _numbers(f"{what}.q", found.q, (n,)),
        _numbers(f"{what}.v", found.v, (n,)),
        _numbers(f"{what}.own", found.own, (np.size(found.own) if own is None else own,)),
    )


def _contact(what: str, found: object) -> Contact:
    """`found` as a Contact with a float64 impulse (2,) [N s]. Raises InputError."""
    if not isinstance(found, Contact) or not isinstance(found.name, str):
        raise InputError(f"{what} is {found!r:.60}, expected a Contact(name, impulse, ends)")
    if found.ends is not None and (not isinstance(found.ends, Status) or found.ends.ok):
        raise InputError(
            f"{what}.ends is {found.ends!r:.60}, expected None, or a Status that says why the run ends, as "
            "Status.FELL"
        )
    return found._replace(impulse=_numbers(f"{what}.impulse", found.impulse, (2,)))


def _in_time(who: str, begin: float, until: float, moved: Advanced) -> Advanced:
    """`moved` with its last two times equal, and `until` where they are that but for round-off."""
    _check_times(who, begin, until, moved)
    *before, last = moved.nodes
    if not moved.contacts and not all(map(_same, last[1:], moved.state[1:])):
        raise InputError(
            f"{who}: nodes[-1] is {last}, expected the same as state, {moved.state}, without a contact"
        )
    end = until if abs(moved.state.t - until) <= ROUND_OFF else moved.state.t
    passed = *(node for node in before if node.t < end), last._replace(t=end)
    return Advanced(moved.state._replace(t=end), moved.contacts, passed)


def _check_times(who: str, begin: float, until: float, moved: Advanced) -> None:
    """Raise InputError for a clock that is elsewhere, or that went backwards on the way there."""
    end, earlier = moved.state.t, begin
    if not moved.contacts and not abs(end - until) <= ROUND_OFF:
        raise InputError(f"{who} came to {end} s without a contact, expected {until} s")
    if not begin < end <= until + ROUND_OFF:
        raise InputError(
            f"{who} came to a contact at {end} s, expected one after {begin} s, where it began, and not "
            f"after {until} s"
        )
    for k, node in enumerate(moved.nodes):
        if not node.t > earlier:
            raise InputError(f"{who}: nodes[{k}] is at {node.t} s, expected later than {earlier} s")
        earlier = node.t
    if not moved.nodes or abs(earlier - end) > ROUND_OFF:
        found = f"the last node is at {earlier} s" if moved.nodes else "there are no nodes"
        raise InputError(f"{who}: {found}, expected the last at {end} s, the time of state")


def _same(a: Array, b: Array) -> bool:
    """Whether two arrays are equal; NaN equals NaN here, since such values pass to the loop."""
    return np.array_equal(a, b, equal_nan=True)
