"""What a plant that moves by itself has to give, and the checks of what it gives.

    row = (q, q', own)                          the whole state, own what else the plant needs to go on
    advance(t, row, u, load, until) -> Moved

`closed_loop.stepping.SteppingLoop` drives such a plant, for instance MuJoCo or Drake behind a class
of the user's. `started` and `advanced` call the plant and check once what it gives. What breaks
this contract is an InputError that names the plant's class, what was found and what was expected.
Values that are not finite pass: the loop ends the run with NOT_FINITE, as for any plant.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np

from biped_adrc.core.checks import returned
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array, Indices, read_only
from biped_adrc.hybrid.status import Status
from biped_adrc.model.ground import StepDown, StepUp

ROUND_OFF = 1e-9
"""Largest difference [s] between a plant's own clock and the time that it was to reach."""


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


class Moved(NamedTuple):
    """Where a plant came to."""

    t: float
    """`until`, or the time of the contacts [s]."""
    row: Array
    """State (2 n + k,) there, just before the contacts."""
    contacts: tuple[Contact, ...] = ()
    """All at that time. They are one event: names joined by +, impulses added. Where some of them end the run,
    only those count: a fall with a touchdown is a fall."""
    after: Array | None = None
    """State (2 n + k,) just after a touchdown."""


class Feet(NamedTuple):
    """Both feet at one time, the stance foot first; (x, z) of each."""

    force: Array
    """Of the ground on the feet (2, 2) [N]."""
    place: Array
    """Of the foot points (2, 2) [m]."""
    speed: Array
    """Of the points that touch the ground, or would (2, 2) [m/s]."""


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

    def start(self, t: float, q: Array, v: Array) -> Array:
        """The row at t [s] in q (n,) [rad], v (n,) [rad/s], at rest inside (solver state, contacts)."""

    def advance(self, t: float, row: Array, u: Array, load: Load | None, until: float) -> Moved:
        """On from a row at t [s] to `until` [s] or to the next contact, with u (p,) [N m] and a load held;
        None for no load.

        Where it cannot go on it raises `hybrid.integrators.StepFailed`, which ends the run with
        that status.
        """


@runtime_checkable
class OnFeet(Protocol):
    """A plant that can say what its feet do."""

    def footing(self, row: Array, u: Array, load: Load) -> Feet:
        """In a row under u (p,) [N m] and what acts from outside."""


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


def started(plant: SteppingPlant, t: float, q: Array, v: Array, own: int | None) -> Array:
    """The row that `plant.start` gives at t [s] for q (n,) [rad], v (n,) [rad/s], checked.

    own: how many numbers of its own are expected; None accepts any. Raises InputError where the
    plant starts elsewhere.
    """
    found = plant.start(t, read_only(q), read_only(v))
    shape = None if own is None else (2 * len(q) + own,)
    row = returned(found, shape, plant, "start", finite=False).copy()
    if not np.array_equal(row[: 2 * len(q)], (*q, *v)):
        raise InputError(
            f"{type(plant).__name__}.start gives {row}, expected a row that begins with the q = {q}, v = {v} "
            "that it was given"
        )
    return row


def advanced(
    plant: SteppingPlant, t: float, row: Array, u: Array, load: Load | None, until: float
) -> Moved:
    """What `plant.advance` gives, its row checked and copied, its time `until` [s] without round-off.

    Raises InputError for what breaks the contract.
    """
    moved = plant.advance(t, row, u, load, until)
    if type(moved) is not Moved or type(moved.contacts) is not tuple:
        raise InputError(
            f"{type(plant).__name__}.advance gives {moved!r:.60}, expected a Moved(t, row, contacts, after)"
        )
    end, found, contacts, after = moved
    if not (at_end := abs(end - until) <= ROUND_OFF) and not (contacts and t < end < until):
        here = f"a contact at {end} s, expected after {t} s, not after {until} s"
        here = here if contacts else f"{end} s without a contact, expected {until} s"
        raise InputError(f"{type(plant).__name__}.advance came to {here}")
    found = returned(found, row.shape, plant, "advance", finite=False).copy()
    found.setflags(write=False)
    return Moved(until if at_end else end, found, contacts, after)
