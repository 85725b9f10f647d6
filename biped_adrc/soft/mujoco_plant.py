"""A biped on soft ground in MuJoCo, as a plant that moves by itself.

    own = (time of the last touchdown, base (x, z), its velocity)

The legs are alike, so at a touchdown the state is relabelled as on the rigid plant, and the same leg of the
model stands again; an error of one link follows the leg that stands, here as there. A touchdown is where
the swing foot, ahead of the stance foot, carries more than `touchdown_force` at a sample instant. From one
to the next, and at the edges of a push, the engine steps alone, with the torque held and what acts from
outside taken in the middle. Forces zeta of the coordinates with the stance foot held become, where the base
floats,

    f_base = F,   f_q = zeta - J' F,   J = d(base)/dq with the stance foot held

F (2,) their resultant. A state alone decides what comes next: there are no warm starts.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np

from biped_adrc.closed_loop.stepping_plant import Advanced, Contact, Load, PlantState
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.errors import InputError, check_positive
from biped_adrc.ground import check_slope, ground_axes
from biped_adrc.hybrid.integrators import StepFailed
from biped_adrc.hybrid.status import Status
from biped_adrc.model.biped import Biped
from biped_adrc.parts import Checked
from biped_adrc.shown import Shown
from biped_adrc.soft.ground import SoftGround
from biped_adrc.soft.mujoco_robot import floating_model, mujoco
from biped_adrc.timing import check_ends
from biped_adrc.types import Array, Indices, MuJoCoData, MuJoCoModel

TOUCHING = 1e-6
"""How deep the stance foot is in the ground at the start [m]: no last bit decides whether it touches."""
DEEPEST = 1e-4
"""How deep the swing foot may be in the ground at the start [m]."""


class Own(NamedTuple):
    """What the plant keeps beside (q, q')."""

    since: float
    """Time of the last touchdown [s]."""
    base: Array
    """Place of the trunk (x, z) (2,) [m]."""
    speed: Array
    """Its velocity (2,) [m/s]."""

    @classmethod
    def of(cls, own: Array) -> Own:
        return cls(own[0], own[1:3], own[3:5])

    def numbers(self) -> Array:
        """(5,)."""
        return np.array([self.since, *self.base, *self.speed])


@dataclass(frozen=True)
class MuJoCoPlant(Checked, Shown):
    """A biped with motors on soft ground; a `SteppingPlant`.

    - h [s]: step of the engine. slope [rad]: of the ground, positive downhill.
    - touchdown_force [N], ahead [m]: what the swing foot has to carry, and how far in front it has to
      be. flight_height [m]: the run ends as illegal where the stance foot is higher above the ground.
    - fall_height [1], max_step_time [s]: ends of a run, as of a `Walker`.

    Raises InputError where MuJoCo is missing, or a value is none; ModelError for a robot whose motors no
    impact exchanges one by one. Warns of a step of the engine above a tenth of the ground's time constant.
    """

    biped: Biped
    ground: SoftGround = SoftGround()  # noqa: RUF009
    slope: float = 0.0
    h: float = 2e-4
    touchdown_force: float = 50.0
    ahead: float = 0.1
    flight_height: float = 0.02
    fall_height: float = 0.35
    max_step_time: float = 2.0
    model: MuJoCoModel = field(init=False, repr=False, compare=False)
    data: MuJoCoData = field(init=False, repr=False, compare=False)
    """The engine's work space; what it holds is set anew at each call."""

    def __post_init__(self) -> None:
        for name in ("h", "touchdown_force", "ahead", "flight_height"):
            check_positive(getattr(self, name), f"{name} of the plant is {getattr(self, name)}")
        check_slope(self.slope)
        check_ends(self.max_step_time, self.fall_height, math.inf, math.inf)
        if self.biped.p == 0:
            raise InputError(
                f"robot '{self.biped.description.name}' has no motors; expected one with motors at its joints"
            )
        self.biped.check_motors()
        if self.h > 0.1 * self.ground.time_constant * (1.0 + 1e-9):
            warnings.warn(
                f"the engine's step is {self.h:g} s, more than a tenth of the ground's time constant, "
                f"{self.ground.time_constant:g} s: contact is not resolved",
                stacklevel=3,
            )
        model = floating_model(self.biped, self.ground, self.slope, self.h)
        object.__setattr__(self, "model", model)
        object.__setattr__(self, "data", mujoco().MjData(model))

    @property
    def n(self) -> int:
        """Number of coordinates."""
        return self.biped.n

    @property
    def p(self) -> int:
        """Number of motors."""
        return self.biped.p

    @property
    def swap(self) -> Indices:
        """Relabelling of the motors at a touchdown (p,), dtype int."""
        return self.biped.relabelling[: self.p]

    @cached_property
    def out(self) -> Array:
        """Unit vector (x, z) (2,) out of the ground."""
        return ground_axes(self.slope)[1]

    @cached_property
    def lowest_hip(self) -> float:
        """Height of the hip above the ground [m] below which the run ends as a fall."""
        return self.fall_height * float(np.linalg.norm(self.biped.hip(np.zeros(self.n))))

    @cached_property
    def angles(self) -> Indices:
        """Places of q in MuJoCo's positions (n,)."""
        return self._places(self.biped.description.joints)

    @cached_property
    def base(self) -> Indices:
        """Places of the base's (x, z) in MuJoCo's positions (2,)."""
        return self._places(self.biped.description.base)

    def _places(self, joints: tuple[str, ...]) -> Indices:
        return np.array([self.model.joint(name).dofadr[0] for name in joints])

    # -- the contract ------------------------------------------------------------------------------
    def start(self, t: float, q: Array, v: Array) -> PlantState:
        """At t [s] in q (n,) [rad], v (n,) [rad/s], the stance foot at rest at the origin."""
        f = self.biped.floating
        base, speed = f.configuration(q)[f.base], (f.velocity_map(q)[:, : self.n] @ v)[f.base]
        depth = -float(self.out @ self.biped.swing_foot(q))
        if depth > DEEPEST:
            raise InputError(
                f"the swing foot starts {1e3 * depth:.3g} mm inside the ground, expected at most "
                f"{1e3 * DEEPEST:g} mm; start from a state after an impact on this slope, {self.slope:g} rad"
            )
        return PlantState(t, q, v, Own(t, base - TOUCHING * self.out, speed).numbers())

    def advance(
        self,
        state: PlantState,
        u: Array,
        outside: Callable[[float, Array, Array], Load],
        until: float,
    ) -> Advanced:
        """On to `until` [s] under u (p,) [N m]; a touchdown and a fall are looked for there."""
        own, mj, data = Own.of(state.own), mujoco(), self.data
        steps = max(1, math.ceil((until - state.t) / self.h - 1e-6))
        self.model.opt.timestep = (until - state.t) / steps
        self._place(state.q, state.v, own)
        middle = 0.5 * (state.t + until)
        self._push(u, state.q, outside(middle, state.q, state.v))
        mj.mj_step(self.model, data, steps)
        mj.mj_forward(self.model, data)  # forces of this state, not of the last stage of a step
        if np.any(data.warning.number):
            raise StepFailed(f"MuJoCo lost the motion before t = {until:.6g} s: not finite or huge")
        moved = self._read(until, own)
        contacts = self.contacts(moved, Own.of(moved.own))
        after = self._relabelled(moved) if contacts and contacts[0].ends is None else moved
        return Advanced(after, contacts, (moved,))

    # -- between the package's coordinates and MuJoCo's --------------------------------------------
    def _place(self, q: Array, v: Array, own: Own) -> None:
        """The engine at rest inside, at q (n,) [rad], v (n,) [rad/s]."""
        data = self.data
        mujoco().mj_resetData(self.model, data)
        data.qpos[self.angles], data.qvel[self.angles] = q, v
        data.qpos[self.base], data.qvel[self.base] = own.base, own.speed

    def _push(self, u: Array, q: Array, load: Load) -> None:
        """The engine with u (p,) [N m] at its motors and a load from outside."""
        f, data = self.biped.floating, self.data
        J = f.velocity_map(q)[f.base, : self.n]
        data.ctrl[:] = u
        data.qfrc_applied[self.angles] = load.zeta - J.T @ load.force
        data.qfrc_applied[self.base] = load.force

    def _read(self, t: float, own: Own) -> PlantState:
        """What the engine has come to at t [s]."""
        data = self.data
        base, speed = data.qpos[self.base], data.qvel[self.base]
        now = own._replace(base=base, speed=speed).numbers()
        return PlantState(t, data.qpos[self.angles].copy(), data.qvel[self.angles].copy(), now)

    def _relabelled(self, state: PlantState) -> PlantState:
        """The same motion after a touchdown, in the coordinates of the next single support."""
        own = Own.of(state.own)._replace(since=state.t).numbers()
        q, v = self.biped.relabel(state.q), self.biped.R @ state.v
        return PlantState(state.t, q, v, own)

    # -- what ends a single support ----------------------------------------------------------------
    def contacts(self, state: PlantState, own: Own) -> tuple[Contact, ...]:
        """What ends the run (a fall, a stance foot in the air, a step too long), else a touchdown; or none."""
        f = self.biped.floating
        foot = self.out @ (own.base - f.configuration(state.q)[f.base])
        hip = foot + self.out @ self.biped.hip(state.q)
        if hip < self.lowest_hip:
            return (Contact("hip_too_low", ends=Status.FELL),)
        if foot > self.flight_height:
            return (Contact("stance_foot_in_the_air", ends=Status.ILLEGAL),)
        if state.t - own.since > self.max_step_time:
            return (Contact("step_too_long", ends=Status.STALLED),)
        force = self.forces()[1]
        if force[1] <= self.touchdown_force or self.biped.swing_foot(state.q)[0] <= self.ahead:
            return ()
        return (Contact(FOOT_STRIKE, force * self.model.opt.timestep),)

    def forces(self) -> Array:
        """Forces of the ground (x, z) (2, 2) [N] on the two feet now, in the order of the robot's record."""
        mj, found, wrench = mujoco(), np.zeros((2, 2)), np.zeros(6)
        for k in range(self.data.ncon):
            mj.mj_contactForce(self.model, self.data, k, wrench)
            contact = self.data.contact[k]
            force = contact.frame.reshape(3, 3).T @ wrench[:3]
            found[self.feet.index(contact.geom2)] += force[[0, 2]]
        return found

    @cached_property
    def feet(self) -> list[int]:
        """MuJoCo's numbers of the feet."""
        return [self.model.geom(name).id for name in self.biped.description.feet]
