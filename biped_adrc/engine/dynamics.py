"""D_s and Omega of a planar robot in compiled code, checked against Pinocchio before they are used."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from biped_adrc.engine.generate import dynamics_source
from biped_adrc.engine.plant import PlantArrays, plant_arrays
from biped_adrc.engine.store import forget, load_source
from biped_adrc.errors import ModelError
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import EXACT, PlanarTree
from biped_adrc.types import Array

HEADER = '''"""Generated from a Pinocchio model; rewritten when it is changed."""

import math

from numba import njit


@njit(cache=True, nogil=True, error_model="numpy")
'''
SAMPLES = 50
Fill = Callable[[PlantArrays, Array, Array, Array, Array], None]


@dataclass(frozen=True)
class CompiledDynamics:
    """`fill(K, q, v, D, Omega)` of one structure with the arrays K of one robot."""

    fill: Fill
    arrays: PlantArrays

    @classmethod
    def of(cls, biped: Biped) -> CompiledDynamics:
        """Generate, compile or take from the disk, and check.

        Raises ModelError for a robot that is no planar tree, or where the code differs from Pinocchio by more
        than 1e-11 relative.
        """
        tree = PlanarTree.of(biped)
        source = HEADER + dynamics_source(tree)
        K = plant_arrays(biped, tree)
        module = load_source(source)
        try:
            return cls(module.dynamics, K).check(biped)
        except ModelError:
            raise
        except Exception:  # numba does not say what it raises for machine code that is damaged
            forget(module)
            return cls(load_source(source).dynamics, K).check(biped)

    def inertia_and_bias(self, q: Array, v: Array) -> tuple[Array, Array]:
        """D_s (n, n) [kg m^2] and Omega (n,) [N m]."""
        n = len(self.arrays.rotor)
        D, Omega = np.empty((n, n)), np.empty(n)
        self.fill(self.arrays, q, v, D, Omega)
        return D, Omega

    def check(self, biped: Biped, samples: int = SAMPLES) -> CompiledDynamics:
        """Itself, when it agrees with Pinocchio at random states. Raises ModelError."""
        random = np.random.default_rng(3)
        for _ in range(samples):
            q, v = random.uniform(-np.pi, np.pi, biped.n), random.normal(0.0, 3.0, biped.n)
            ours, theirs = self.inertia_and_bias(q, v), (biped.inertia(q), biped.bias(q, v))
            for name, one, other in zip(("D_s", "Omega"), ours, theirs, strict=True):
                gap = float(np.max(np.abs(one - other)) / np.max(np.abs(other)))
                if not gap <= EXACT:
                    raise ModelError(
                        f"robot '{biped.description.name}': {name} of the compiled code differs from "
                        f"Pinocchio's by {gap:.1e} relative, expected {EXACT:g}; use engine='pinocchio'"
                    )
        return self
