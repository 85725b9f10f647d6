"""MuJoCo on the pinned chain, and on the robot with feet on the ground.

The steps run in MuJoCo's own loop (`mj_step` with nstep), constraints and contacts are switched off for
the chain. On the ground the contact is MuJoCo's soft one, so that motion is another system's.
"""

from __future__ import annotations

from collections.abc import Mapping

import mujoco
import numpy as np
from chain import Chain, Coordinates, Simulate

from biped_adrc.model.biped import Biped
from biped_adrc.soft.ground import SoftGround
from biped_adrc.soft.mujoco_robot import floating_model, pinned_model
from biped_adrc.types import Array

H = 1e-3  # [s]
METHODS = {
    "Euler 1 ms": mujoco.mjtIntegrator.mjINT_EULER,
    "implicitfast 1 ms": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
    "RK4 1 ms": mujoco.mjtIntegrator.mjINT_RK4,
}


class MuJoCoChain(Chain):
    """The package's own MuJoCo model of the pinned robot."""

    def __init__(self, biped: Biped) -> None:
        super().__init__(biped)
        self.model = pinned_model(biped, H)
        self.data = mujoco.MjData(self.model)
        joints = [self.model.joint(j).name for j in range(self.model.njnt)]
        self.coordinates = Coordinates(biped, joints)

    def place(self, q: Array, v: Array) -> None:
        """The data at rest but for (q, v)."""
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[:], self.data.qvel[:] = self.coordinates.T @ q, self.coordinates.T @ v

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        self.place(q, v)
        self.data.qfrc_applied[:] = self.coordinates.force(force)
        mujoco.mj_forward(self.model, self.data)
        return self.coordinates.inverse @ self.data.qacc

    def methods(self) -> Mapping[str, Simulate]:
        return {name: self._simulate(integrator) for name, integrator in METHODS.items()}

    def _simulate(self, integrator: int) -> Simulate:
        def simulate(q: Array, v: Array, duration: float) -> Array:
            self.model.opt.integrator = integrator
            self.place(q, v)
            mujoco.mj_step(self.model, self.data, nstep=round(duration / H))
            return self.coordinates.inverse @ self.data.qpos

        return simulate


def on_the_ground(biped: Biped) -> Mapping[str, Simulate]:
    """The floating robot with spheres for feet over a plane; only its cost is of interest."""
    model = floating_model(biped, SoftGround(time_constant=10 * H), 0.0, H)
    data = mujoco.MjData(model)

    def simulate(q: Array, v: Array, duration: float) -> Array:
        mujoco.mj_resetData(model, data)
        hip, speed = biped.hip(q), biped.hip_velocity(q, v)
        names = [*biped.description.base, *biped.description.joints]
        for name, x, dx in zip(names, (*hip, *q), (*speed, *v), strict=True):
            data.joint(name).qpos, data.joint(name).qvel = x, dx
        mujoco.mj_step(model, data, nstep=round(duration / H))
        return np.array([data.joint(name).qpos[0] for name in biped.description.joints])

    return {"with contact, 1 ms": simulate}
