"""MuJoCo's model and data for one floating biped, and the places of the package's numbers in them.

    row = (q, q', own),   own = (time of the last touchdown, base (x, z), its velocity, rest)

A row is the whole state of a `plant.MuJoCoPlant`. rest has, on ground with steps up and down, the number of the
single support and the heights [m] of the ground under stance and swing foot; then, for motors with lag, their
torques u_m (p,). `moved` copies a row into MuJoCo, takes integration steps there and reads the result.
Integrators, for the acceleration a:

    rk4         v, q by the classical method, four evaluations of the forces in a step
    leapfrog    q <- q + h v / 2;  N times (v <- v + h a(q, v), q <- q + h v);  q <- q - h v / 2

The middle of leapfrog is MuJoCo's Euler method, whose positions are off by a h T / 2 after a time T. Between
the two half steps forces of position are taken in the middle of each step, which is of second order; forces
that depend on v, as the Coriolis terms, at its beginning, which is of first.

Torques of motors with lag, tau u_m' = u - u_m, do not depend on the motion: each step of the
engine is given their exact mean over it, so that the impulse is exact, the angles are of second
order in h, and no lag is too short.
"""

import math
from collections.abc import Callable

import numpy as np

from biped_adrc.closed_loop.protocols import Load
from biped_adrc.core.types import Array, Indices, MuJoCoData, MuJoCoModel
from biped_adrc.extras.mujoco.robot import PLANES, mujoco
from biped_adrc.hybrid.integrators import StepFailed
from biped_adrc.model.biped import Biped

INTEGRATORS = {"rk4": "mjINT_RK4", "leapfrog": "mjINT_EULER"}
"""Name of an integrator -> MuJoCo's method that it uses."""


Move = Callable[[MuJoCoModel, MuJoCoData, int], None]
"""A function that advances MuJoCo's data by a number of integration steps."""


def leapfrog(model: MuJoCoModel, data: MuJoCoData, steps: int, move: Move | None = None) -> None:
    """Advance a model, whose method is MuJoCo's Euler, by this many steps of leapfrog (see the module).

    move: function that takes the steps in place of MuJoCo's mj_step; None for that.
    """
    # q and v are MuJoCo's own arrays, which change in place
    half, q, v = 0.5 * model.opt.timestep, data.qpos, data.qvel
    q += half * v
    (mujoco().mj_step if move is None else move)(model, data, steps)
    q -= half * v


class MuJoCoEngine:
    """A model of MuJoCo with its data, whose arrays are looked up once. Not to be shared between threads.

    h [s]: longest integration step. integrator: one of INTEGRATORS; the model must have its method. lag [s]:
    time constant tau of the motors, 0 for none. positions, rates: for each entry of MuJoCo's qpos and qvel its
    index in a row.
    """

    def __init__(self, biped: Biped, model: MuJoCoModel, h: float, integrator: str, lag: float):
        """Make the data and look up the indices; arguments as in the class."""
        self.biped, self.model, self.h, self.lag = biped, model, h, lag
        self.data = data = mujoco().MjData(model)
        self.step = leapfrog if integrator == "leapfrog" else mujoco().mj_step
        self.kinematics = mujoco().mj_kinematics
        self.options, self.warnings = model.opt, data.warning.number
        self.qpos, self.qvel = data.qpos, data.qvel
        self.ctrl, self.applied = data.ctrl, data.qfrc_applied
        d, n = biped.description, biped.n
        self.angles, self.base = self._places(d.joints), self._places(d.base)
        # own begins at 2 n with the time of the touchdown; the base and its velocity follow
        # order: the coordinates (q, base) as MuJoCo has them in qpos and qvel, in the order of the model's
        # joints
        order = np.argsort(np.concatenate((self.angles, self.base)))
        self.positions = np.array([*range(n), 2 * n + 1, 2 * n + 2])[order]
        self.rates = np.array([*range(n, 2 * n), 2 * n + 3, 2 * n + 4])[order]
        planes = [k for k in range(model.ngeom) if model.geom(k).name in PLANES]
        self.planes = planes if len(planes) > 1 else []
        """Indices of the planes that move, one for each foot; empty on ground without steps."""
        # turn = sin(slope / 2), of the plane's quaternion, so that 1 - 2 turn^2 = cos(slope)
        turn, radius = model.geom_quat[planes[0], 2], model.geom(d.feet[0]).size[0]
        self.depth = -radius * (1.0 - 2.0 * turn**2)
        """Height of a plane at level 0 [m]; the model's value may be that of an earlier run."""
        self.points_at = [data.xpos[model.body(name).id] for name in (*d.feet, d.hip)]

    def _places(self, joints: tuple[str, ...]) -> Indices:
        """Indices of these joints in qpos and qvel; the same, since each joint has one coordinate."""
        return np.array([self.model.joint(name).dofadr[0] for name in joints])

    def place(self, row: Array) -> None:
        """Copy positions and rates of a row, and the heights of the ground under both feet, into MuJoCo."""
        # `take` into an array with mode="clip" is by far the fastest way to copy
        row.take(self.positions, out=self.qpos, mode="clip")
        row.take(self.rates, out=self.qvel, mode="clip")
        self.warnings[:] = 0  # so that only warnings of the next steps count
        if self.planes:
            # own[6:8], the heights of the ground, in the row (q, q', own); depth: of a plane below the ground,
            # by the radius of the feet
            first = 2 * self.biped.n + 6
            self.model.geom_pos[self.planes, 2] = self.depth + row[first : first + 2]

    def push(self, u: Array, q: Array, load: Load | None) -> None:
        """Set the motors' torques u (p,) [N m] and MuJoCo's generalised forces of an external load, None for
        none.

        q (n,) [rad]: angles, at which the load is converted from a pinned to a floating base, as in `plant`.
        """
        self.ctrl[:] = u
        self.applied[:] = 0.0
        if load is None:
            return
        self.applied[self.angles] = load.zeta
        if any(load.force.tolist()):
            # J (2, n): the base's velocity from q' with the stance foot fixed
            f = self.biped.floating
            J = f.velocity_map(q)[f.base, : self.biped.n]
            self.applied[self.angles] -= J.T @ load.force
            self.applied[self.base] = load.force

    def moved(self, t: float, row: Array, u: Array, load: Load | None, until: float) -> Array:
        """Integrate from a row at t [s] to the row at `until` [s], with the commanded torque u (p,) [N m] and
        the load constant.

        Of own only base, its velocity and u_m change. Raises StepFailed where MuJoCo warns of a state that is
        not finite or huge.
        """
        steps = max(1, math.ceil((until - t) / self.h - 1e-6))  # 1e-6: round-off adds no step
        self.options.timestep = (until - t) / steps
        self.place(row)
        self.push(u, row[: self.biped.n], load)
        if self.lag > 0.0:
            row = np.concatenate((row[: -len(u)], self.followed(u, row[-len(u) :], steps)))
        else:
            self.step(self.model, self.data, steps)
        # MuJoCo counts warnings; after a reset the data serve the next run
        if any(self.warnings.tolist()):
            mujoco().mj_resetData(self.model, self.data)
            raise StepFailed(f"MuJoCo lost the motion before t = {until:.6g} s: not finite or huge")
        return self.read(row)

    def followed(self, u: Array, u_m: Array, steps: int) -> Array:
        """Take this many integration steps with lagging motors, whose torque starts at u_m (p,) and follows the
        command u (p,) [N m].

        Returns their torque (p,) [N m] at the end. In each step MuJoCo gets the exact mean of the torque over
        the step.
        """
        ratio = self.options.timestep / self.lag
        # of the distance u_m - u: the share left after a step, and its mean over the step
        left, mean = math.exp(-ratio), -math.expm1(-ratio) / ratio
        step, missing = mujoco().mj_step, u_m - u

        def move(model: MuJoCoModel, data: MuJoCoData, steps: int) -> None:
            for k in range(steps):
                self.ctrl[:] = u + (mean * left**k) * missing
                step(model, data)

        if self.step is leapfrog:
            leapfrog(self.model, self.data, steps, move)
        else:
            move(self.model, self.data, steps)
        self.ctrl[:] = u_m = u + left**steps * missing
        return u_m

    def read(self, row: Array) -> Array:
        """A copy of the row with MuJoCo's positions and rates."""
        row = row.copy()
        row[self.positions], row[self.rates] = self.qpos, self.qvel
        return row

    def points(self) -> list[list[float]]:
        """Places (x, y, z) [m] of both feet, in the order of the robot's record, and of
        the hip, as plain numbers.
        """
        self.kinematics(self.model, self.data)
        return [place.tolist() for place in self.points_at]
