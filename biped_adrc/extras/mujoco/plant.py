"""A biped on soft ground in MuJoCo, as a plant that integrates itself (`closed_loop.protocols`).

Its state is row = (q, q', own), with q and q' of stance and swing leg as on the rigid plant, and

    own[0]      time of the last touchdown [s]
    own[1:5]    base (x, z) [m], and its velocity [m/s]
    own[5]      number of the single support             } only on ground with steps
    own[6:8]    levels under stance and swing foot [m]   } up and down
    own[-p:]    torques u_m of the motors [N m]            only of motors with lag

At a touchdown the row is relabelled as on the rigid plant: stance and swing leg exchange their names. The legs
of the robot are alike, so MuJoCo's first leg then stands again; a model error of one link follows the leg that
stands, on both plants. A touchdown is a sample instant at which the swing foot, ahead of the stance foot,
carries more than `touchdown_force`.

Between sample instants and switching times of a push MuJoCo integrates alone, under constant torque and the
external load that acts in the middle of this time. A load has generalised forces zeta of the coordinates q with
the stance foot fixed, and their resultant F (2,) [N]. In MuJoCo, where the base floats, the load's generalised
forces f are

    f_base = F,   f_q = zeta - J^T F,   J = d(base)/dq (2, n) with the stance foot fixed

The row alone decides what follows, since MuJoCo's warm starts are off.

On steps of the ground each foot has a plane of its own. The plane of the stance foot rests. That of the swing
foot has the height of this foot's last foothold, until a sample instant at which the foot is ahead of the
stance foot and above its next foothold; from then on it has that height. So a plane only moves under a foot in
the air and gives no kick; a foot that does not clear a step up lands on the lower level from which it came.
"""

import math
import warnings
from copy import copy
from dataclasses import dataclass, field, replace
from functools import cached_property
from threading import get_ident
from typing import Annotated, Self

import numpy as np

from biped_adrc.closed_loop.protocols import Contact, Feet, Load, Moved
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.core.checks import Checked, NonNegativeFloat, PositiveFloat, PositiveInt, one_of
from biped_adrc.core.errors import InputError
from biped_adrc.core.shown import Shown
from biped_adrc.core.timing import check_ends
from biped_adrc.core.types import Array, Indices, MuJoCoModel, relabelled
from biped_adrc.extras.mujoco.engine import INTEGRATORS, MuJoCoEngine
from biped_adrc.extras.mujoco.robot import PLANES, floating_mjcf, model_of, mujoco
from biped_adrc.hybrid.status import Status
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import GroundSteps, Slope, SoftGround, drop_of, ground_axes

TOUCHING = 1e-6
"""Depth of the stance foot in the ground at the start [m]: round-off does not decide whether it touches."""
DEEPEST = 1e-4
"""Largest depth of the swing foot in the ground at the start [m]."""


@dataclass(frozen=True)
class MuJoCoPlant(Checked, Shown):
    """A biped with motors on soft ground; a `SteppingPlant`.

    - h [s]: MuJoCo's integration step. slope [rad]: of the ground, positive downhill.
    - touchdown_force [N], ahead [m]: the vertical force that the swing foot has to carry at a touchdown, and
      its least distance in front of the stance foot. flight_height [m]: the run ends as INFEASIBLE where the
      stance foot is higher above the ground.
    - integrator: "rk4", or "leapfrog" in a quarter of the computing time (`engine`).
    - lag [s]: time constant tau of the motors, tau u_m' = u - u_m; 0 for none.
    - ground_steps: steps up and down of the ground. first_step: number of the first single support, from 1.
    - fall_height [1]: the run ends as a fall where the hip is lower than this share of its height at q = 0.
      max_step_time [s]: it ends as STALLED where a single support lasts longer.

    Raises InputError where MuJoCo is missing or a value is out of range. Warns of an h above a tenth of the
    ground's time constant.
    """

    biped: Biped
    ground: SoftGround = SoftGround()  # noqa: RUF009
    slope: Slope = 0.0
    h: PositiveFloat = 2e-4
    touchdown_force: PositiveFloat = 50.0
    ahead: PositiveFloat = 0.1
    flight_height: PositiveFloat = 0.02
    fall_height: float = 0.35
    max_step_time: float = 2.0
    integrator: Annotated[str, one_of(INTEGRATORS)] = "rk4"
    lag: NonNegativeFloat = 0.0
    ground_steps: GroundSteps = ()
    first_step: PositiveInt = 1
    model: MuJoCoModel = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Check the fields and make MuJoCo's model; see the class."""
        # infinite: bounds on rates and torques are not the plant's but the control loop's
        check_ends(self.max_step_time, self.fall_height, math.inf, math.inf)
        if self.biped.p == 0:
            raise InputError(
                f"robot '{self.biped.description.name}' has no motors; expected one with motors at its joints"
            )
        if self.h > 0.1 * self.ground.time_constant * (1.0 + 1e-9):
            warnings.warn(
                f"the engine's step is {self.h:g} s, more than a tenth of the ground's time constant, "
                f"{self.ground.time_constant:g} s: contact is not resolved",
                stacklevel=3,
            )
        # two planes: on steps up and down each foot has its own
        planes = PLANES if self.ground_steps else PLANES[:1]
        model = model_of(floating_mjcf(self.biped, self.ground, self.slope, self.h, planes))
        model.opt.integrator = getattr(mujoco().mjtIntegrator, INTEGRATORS[self.integrator])
        object.__setattr__(self, "model", model)

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
        """Relabelling (p,) of the motors at a touchdown, for `types.relabelled`."""
        return self.biped.swap

    @property
    def foot_mass(self) -> float:
        """Effective mass of a foot that MuJoCo's spring and damper act on [kg].

        An estimate that MuJoCo makes once, at zero angles, as a mean over three directions (the inverse of
        `body_invweight0`); it is not the mass that moves with the foot in the posture of a touchdown.
        """
        foot = self.model.body(self.biped.description.feet[0]).id
        return 1.0 / float(self.model.body_invweight0[foot, 0])

    @property
    def stiffness(self) -> tuple[float, float]:
        """Stiffness of the ground under a resting foot [N/m]: at the surface, and from a depth of 1 mm on."""
        return self.ground.stiffness(self.foot_mass)

    @cached_property
    def out(self) -> tuple[float, float]:
        """Unit vector (x, z) out of the ground."""
        x, z = ground_axes(self.slope)[1].tolist()  # [0] is the one along the ground
        return x, z

    @cached_property
    def lowest_hip(self) -> float:
        """Height of the hip above the ground [m] below which the run ends as a fall."""
        return self.fall_height * float(np.linalg.norm(self.biped.hip(np.zeros(self.n))))

    @property
    def engine(self) -> MuJoCoEngine:
        """MuJoCo's model and data for this plant, made once in every thread: two threads in the same data would
        crash the process.
        """
        engines: dict[int, MuJoCoEngine] = vars(self).setdefault("_engines", {})
        if get_ident() not in engines:
            numbers = self.h, self.integrator, self.lag
            engines[get_ident()] = MuJoCoEngine(self.biped, copy(self.model), *numbers)
        return engines[get_ident()]

    def lagging(self, lag: float) -> Self:
        """The same plant with motors of this lag [s]."""
        return replace(self, lag=lag)

    def on_steps(self, steps: GroundSteps, first_step: int) -> Self:
        """The same plant on steps of the ground, from single support `first_step` on."""
        return replace(self, ground_steps=steps, first_step=first_step)

    def levels(self, own: Array) -> Array:
        """Heights (.., 2) [m] of the ground under stance and swing foot, from the numbers own (.., k); zero on
        ground without steps.
        """
        return own[..., 6:8] if self.ground_steps else np.zeros((*own.shape[:-1], 2))

    def motor_torque(self, own: Array, u: Array) -> Array:
        """Torque on the joints (.., p) [N m] while u (.., p) is commanded: u itself, or u_m of motors with lag,
        which is in own (.., k).
        """
        return own[..., -self.p :] if self.lag > 0.0 else u

    def __getstate__(self) -> dict[str, object]:
        """The fields for pickle, without MuJoCo's data, which is made again where it is needed."""
        return {name: value for name, value in vars(self).items() if name != "_engines"}

    # -- the contract ------------------------------------------------------------------------------
    @staticmethod
    def engine_version() -> str:
        """Version of MuJoCo, on which the digits of a run depend."""
        return str(mujoco().__version__)

    def start(self, t: float, q: Array, v: Array) -> Array:
        """The row (2 n + k,) at t [s] in q (n,) [rad], v (n,) [rad/s], the stance foot at rest at the origin.

        The foot is put TOUCHING deep into the ground, and motors with lag begin without torque.

        Raises InputError for a swing foot that is more than DEEPEST inside the ground.
        """
        # place and velocity (x, z) of the base that follow from the angles, with the stance foot at the origin
        f = self.biped.floating
        base, speed = f.configuration(q)[f.base], (f.velocity_map(q)[:, : self.n] @ v)[f.base]
        depth = -float(np.dot(self.out, self.biped.swing_foot(q)))
        if depth > DEEPEST:
            raise InputError(
                f"the swing foot starts {1e3 * depth:.3g} mm inside the ground, expected at most "
                f"{1e3 * DEEPEST:g} mm; start from a state after an impact on this slope, {self.slope:g} rad"
            )
        steps = [float(self.first_step), 0.0, 0.0] if self.ground_steps else []
        place = base - TOUCHING * np.array(self.out)
        lagging = np.zeros(self.p if self.lag > 0.0 else 0)
        return np.concatenate((q, v, (t, *place, *speed, *steps, *lagging)))

    def advance(self, t: float, row: Array, u: Array, load: Load | None, until: float) -> Moved:
        """Move the plant from its state `row` (2 n + k,) at t [s] to `until` [s], with u (p,) [N m] commanded.

        load: constant forces from outside, None for none. Returns `until` and the row there; contacts at
        `until` are a touchdown, with the relabelled row after it, or an end of the run; it looks for them at
        `until` alone.
        """
        engine = self.engine
        after = engine.moved(t, row, u, load, until)
        # points: places of stance foot, swing foot and hip. own is a view, through which `look_ahead`, which
        # moves the plane of the swing foot, changes `after`
        own, points = after[2 * self.n :], engine.points()
        result = self.contacts(until, own, points)
        if self.ground_steps and not result:
            self.look_ahead(own, points)
        # a contact without an end of the run is a touchdown
        lands = result and result[0].ends is None
        return Moved(until, after, result, self.landed(until, after) if lands else None)

    def look_ahead(self, own: Array, points: list[list[float]]) -> None:
        """Move the swing foot's plane to the level of its next foothold, once the foot is ahead of the stance
        foot and above that level.

        own (k,): of it own[7], the level under the swing foot, is changed in place. points (3, 3) [m]:
        places of stance foot, swing foot and hip.
        """
        (x, z), (stance, swing, _) = self.out, points
        # height of the next foothold: the stance foot's level less the drop after this single support, own[5]
        foothold = own[6] - drop_of(self.ground_steps, int(own[5]))
        if swing[0] > stance[0] and x * swing[0] + z * (swing[2] - foothold) > 0.0:
            own[7] = foothold

    def footing(self, row: Array, u: Array, load: Load) -> Feet:
        """Forces, places and velocities of both feet, stance foot first, in a row (2 n + k,) under the
        commanded torque u (p,) [N m] and a load.
        """
        self.engine.place(row)
        self.engine.push(self.motor_torque(row[2 * self.n :], u), row[: self.n], load)
        # up: from the point that touches to the foot's centre. This point moves at v + omega x (-up)
        mj, up = mujoco(), self.ground.foot_radius * np.array(self.out)
        model, data, force = self.engine.model, self.engine.data, self.forces()
        place, speed = np.zeros((2, 2)), np.zeros((2, 2))
        for i, name in enumerate(self.biped.description.feet):
            # `xpos` of the foot's frame: the centre of its sphere
            moves, body = np.zeros(6), data.body(name)
            # moves: angular velocity, then velocity, in the axes of the world
            mj.mj_objectVelocity(model, data, mj.mjtObj.mjOBJ_XBODY, body.id, moves, 0)
            spin, centre = moves[1], moves[[3, 5]]
            place[i] = body.xpos[[0, 2]]
            speed[i] = centre - spin * np.array([up[1], -up[0]])
        return Feet(force, place, speed, self.levels(row[2 * self.n :]))

    def landed(self, t: float, row: Array) -> Array:
        """The row just after a touchdown at t [s], for the row just before it: coordinates, motors and levels
        of the ground are relabelled, and no velocity jumps.
        """
        n = self.n
        own = row[2 * n :].copy()
        own[0] = t
        if self.lag > 0.0:
            own[-self.p :] = relabelled(own[-self.p :], self.swap)
        if self.ground_steps:
            # next single support; the levels of the two feet exchange
            own[5:8] = own[5] + 1.0, own[7], own[6]
        return np.concatenate((self.biped.relabel(row[:n]), self.biped.R @ row[n : 2 * n], own))

    # -- what ends a single support ----------------------------------------------------------------
    def contacts(self, t: float, own: Array, points: list[list[float]]) -> tuple[Contact, ...]:
        """Find what ends the single support at t [s]: a fall, a stance foot in the air, a single support that
        lasts too long, or a touchdown; empty where nothing does.

        own (k,): the plant's numbers there. points [m]: places (x, y, z) of stance foot, swing foot and hip. A
        foot above the ground carries nothing, so forces are computed only where the swing foot is in the
        ground.
        """
        (x, z), (stance, swing, hip) = self.out, points
        # below, ahead: levels of the ground under stance and swing foot; x p_x + z p_z is the height of a point
        # p over ground of the slope, for the unit vector (x, z) out of it
        below, ahead = self.levels(own).tolist() if self.ground_steps else (0.0, 0.0)
        if x * hip[0] + z * (hip[2] - below) < self.lowest_hip:
            return (Contact("hip_too_low", ends=Status.FELL),)
        if x * stance[0] + z * (stance[2] - below) > self.flight_height:
            return (Contact("stance_foot_in_the_air", ends=Status.INFEASIBLE),)
        if t - own[0] > self.max_step_time:
            return (Contact("step_too_long", ends=Status.STALLED),)
        # TOUCHING, so that round-off does not decide
        if x * swing[0] + z * (swing[2] - ahead) > TOUCHING or swing[0] - stance[0] <= self.ahead:
            return ()
        force = self.forces()[1]  # (x, z) on the swing foot
        if force[1] <= self.touchdown_force:
            return ()
        # soft contact has no impulse at one instant: that of one integration step stands for it
        return (Contact(FOOT_STRIKE, force * self.engine.options.timestep),)

    def forces(self) -> Array:
        """Forces (x, z) of the ground on stance and swing foot (2, 2) [N] in MuJoCo's present state."""
        mj, result, wrench = mujoco(), np.zeros((2, 2)), np.zeros(6)
        model, data = self.engine.model, self.engine.data
        mj.mj_forward(model, data)  # MuJoCo's step leaves the forces of the state before it
        for k in range(data.ncon):
            mj.mj_contactForce(model, data, k, wrench)
            contact = data.contact[k]
            # from the axes of the contact to those of the world; it acts on the pair's second shape, the foot
            force = contact.frame.reshape(3, 3).T @ wrench[:3]
            result[self.feet.index(contact.geom2)] += force[[0, 2]]
        return result

    @cached_property
    def feet(self) -> list[int]:
        """MuJoCo's indices of the spheres of stance and swing foot."""
        return [self.model.geom(name).id for name in self.biped.description.feet]
