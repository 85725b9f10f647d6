"""The package's compiled engine on the pinned chain: a walker without torque over a ground far below."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from chain import Chain, Simulate

from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.passive import Passive
from biped_adrc.engine.compiled_biped import CompiledBiped
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.kernels import layout
from biped_adrc.engine.kernels.load import kernels
from biped_adrc.ground import StepDown
from biped_adrc.hybrid.integrators import RK4, Adaptive, OneStepMethod
from biped_adrc.model.biped import Biped
from biped_adrc.types import Array

FAR = 1e3  # [m], [s] or hip heights: no guard fires
METHODS: dict[str, OneStepMethod] = {
    "RK4 1 ms": RK4(1e-3),
    "DOP853, rtol 1e-6": Adaptive(1e-6, 1e-6),
}


class CompiledChain(Chain):
    """The engine's loop as walks run in it, with its guards watched all the while."""

    def __init__(self, biped: Biped) -> None:
        super().__init__(biped)
        self.code = CompiledBiped.of(biped)
        self.walker = Walker(
            biped, Passive(), fall_height=-FAR, max_step_time=FAR, ground_steps=(StepDown(1, FAR),)
        )

    def acceleration(self, q: Array, v: Array, force: Array) -> Array:
        return self.code.acceleration(q, v, force)

    def methods(self) -> Mapping[str, Simulate]:
        return {name: self._simulate(method) for name, method in METHODS.items()}

    def _simulate(self, method: OneStepMethod) -> Simulate:
        compiled = CompiledWalker.of(self.walker, method, 0)
        plan, none, n = compiled.plan, np.zeros((0, 1 + 4 * self.biped.n)), self.biped.n

        def simulate(q: Array, v: Array, duration: float) -> Array:
            s = plan.start(np.concatenate((q, v)), 0.0, 1, 0.0, duration)
            kernels().stride(plan.P, plan.F, compiled.K, plan.work(), s, 0, none)
            return s[layout.HEAD : layout.HEAD + n].copy()

        return simulate
