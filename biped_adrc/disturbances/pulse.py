"""A torque over a window, with vertical edges or edges of finite slope.

    zeta = amplitude (r(t - start) - r(t - stop)),   r(s) = s / rise between 0 and 1

Its integral is amplitude (stop - start) whatever the rise; without a rise r is the unit step. The pushes of the
paper have vertical edges. An observer of a disturbance that changes slowly is judged more fairly by edges that
take some milliseconds, as a push of a hand does.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from biped_adrc.disturbances.base import Windowed
from biped_adrc.errors import InputError
from biped_adrc.part import derived
from biped_adrc.types import Array


@dataclass(frozen=True)
class TorquePulse(Windowed):
    """The push of the paper: amplitude (n,) [N m] over [start, stop) [s] of one step.

    rise [s]: the torque grows from `start` to start + rise and falls from `stop` to stop + rise, in straight
    lines; 0 for vertical edges. Raises InputError for a rise that is negative or not finite.
    """

    rise: float = field(default=0.0, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (math.isfinite(self.rise) and self.rise >= 0):
            raise InputError(f"pulse rise is {self.rise} s, expected a finite number >= 0")

    @derived
    def width(self) -> float:
        """[s] from edge to edge."""
        return float(self.stop) - float(self.start)

    @derived
    def end(self) -> float:
        """When the falling edge has come to zero [s], counted as `start`."""
        return float(self.stop) + float(self.rise)

    def torque(self, t: float, step: int, t_start: float, q: Array, v: Array) -> Array:
        """The module's equation.

        Both forms, with edges and with a rise, are computed and one is taken: machine code has no branch here.
        """
        s = t - self.onset(t_start)
        sloping = self.rise > 0.0
        rise = np.where(sloping, self.rise, 1.0)
        up, down = np.minimum(s / rise, 1.0), np.clip((s - self.width) / rise, 0.0, 1.0)
        return np.where(sloping, up - down, 1.0) * self.amplitude

    @property
    def switches(self) -> tuple[tuple[int, float], ...]:
        """The four corners, two where the edges are vertical.

        With a rise the torque has corners and no jumps; integrators stop there too, since rises are short.
        """
        step = self.step or 0
        rises = (0.0, float(self.rise)) if self.rise > 0 else (0.0,)
        corners = (end + rise for end in (float(self.start), float(self.stop)) for rise in rises)
        return tuple((step, s) for s in corners if math.isfinite(s))
