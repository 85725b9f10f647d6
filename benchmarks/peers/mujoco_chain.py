"""MuJoCo on the pinned chain, in its own loop (`mj_step` with nstep), without constraints and contacts."""

from __future__ import annotations

from collections.abc import Mapping

import mujoco
from peers.chains import Chain, Coordinates, H, Simulate

from biped_adrc.core.types import Array
from biped_adrc.extras.mujoco.robot import model_of, pinned_mjcf
from biped_adrc.model.biped import Biped

METHODS = {
    "RK4 1 ms": mujoco.mjtIntegrator.mjINT_RK4,
    "Euler 1 ms": mujoco.mjtIntegrator.mjINT_EULER,
    "implicitfast 1 ms": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
}


class MuJoCoChain(Chain):
    """The package's own MuJoCo model of the pinned robot."""

    def __init__(self, biped: Biped) -> None:
        super().__init__(biped)
        self.model = model_of(pinned_mjcf(biped, H))
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
