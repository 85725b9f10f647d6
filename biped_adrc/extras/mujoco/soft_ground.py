"""Soft ground, in the terms of MuJoCo's contact model.

    a_ref = -b r' - k r,   b = 2 / (d T),   k = d(r) / (d^2 T^2 zeta^2)

is the acceleration that a foot at depth r is driven to: T is `time_constant`, zeta `damping_ratio` (solref),
d(r) the impedance, which rises from the first to the second value of `impedance`, d (solimp). Spring and
damper act on an effective mass m of the foot, so that a stiffness in N/m follows from the robot and cannot be
prescribed. A foot that rests at depth r under the force F has

    F / r = m (d(r) / d)^2 / ((1 - d(r)) T^2 zeta^2)

since the solver leaves the share 1 - d(r) of a_ref at rest. Friction carries up to mu F_N; below that a foot
creeps, the less the larger `impratio`.

MuJoCo documentation, "Modeling: Solver parameters".
"""

from __future__ import annotations

from dataclasses import dataclass

from biped_adrc.core.checks import Checked, PositiveFloat, numbers
from biped_adrc.core.errors import InputError
from biped_adrc.core.shown import Shown


@dataclass(frozen=True)
class SoftGround(Checked, Shown):
    """Soft ground under point feet. Raises InputError for values that no ground has."""

    friction: PositiveFloat = 0.6
    """mu [1]."""
    time_constant: PositiveFloat = 2e-3
    """T [s]; MuJoCo takes two of its steps for any that is shorter."""
    damping_ratio: PositiveFloat = 1.0
    """zeta [1]."""
    impedance: tuple[float, float] = (0.95, 0.99)
    """d(r) at the surface and from 1 mm on [1]; 1 would leave no slack at all."""
    impratio: PositiveFloat = 20.0
    """Impedance of friction over that of the normal force [1]."""
    foot_radius: PositiveFloat = 1e-3
    """Radius of the feet [m]; a foot rolls on by the radius times the angle that its leg turns."""

    def __post_init__(self) -> None:
        result = numbers(self.impedance, "the impedance of the ground")
        if result.shape != (2,) or not 0.0 < result[0] <= result[1] < 1.0:
            raise InputError(
                f"the impedance of the ground is {self.impedance}, expected 0 < first <= second < 1"
            )
        object.__setattr__(self, "impedance", tuple(result.tolist()))  # a list could be changed

    def stiffness(self, mass: float) -> tuple[float, float]:
        """F / r [N/m] under a foot that rests: at the surface, and where d(r) = d, from 1 mm on.

        mass [kg]: its effective mass m, as `MuJoCoPlant.foot_mass`.
        """
        d = self.impedance[1]
        full = mass / (self.time_constant * self.damping_ratio) ** 2
        at_surface, deep = (full * (at / d) ** 2 / (1.0 - at) for at in self.impedance)
        return at_surface, deep
