"""Control loops around a plant that another program simulates: each sample instant is one compiled call.

    sample (t, step, t_start, x, F_stance, F_swing) -> x after the sample instant, least pivot

t [s] is the time of the sample instant, step the number of the single support, t_start [s] its start, and x
(nx,) the state of the loop: q [rad], v [rad/s], states of controller and sensors, and the queue of torques
[N m], of which the oldest one acts until the next instant (`closed_loop.stepping`). F_stance and F_swing [N]
are the vertical forces of the ground on the two feet, for a touchdown detector that needs them. zeta (n,) [N m]
is the disturbance, the generalised torque from outside on the n coordinates of the plant. The least pivot is
the smallest |pivot| of the matrices that the controller inverts: 0 for a singular one, below 0 for a torque
beyond the bound of the loop. In these cases, and where x is not finite, Python computes the instant again and
says what is wrong.

Measurement, model, controller, limits and queue of torques are those of `closed_loop.semantics`, traced as for
a walker (`engine.equations`). A controller that cannot be compiled still gets the terms of its model and its
references from machine code. The settings of the trajectory say what ran: "compiled", or "compiled model",
where the controller runs in Python, with the reason as "why".
"""

import math
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Self

import numpy as np

from biped_adrc.closed_loop import other_plant
from biped_adrc.closed_loop.protocols import Load, SteppingPlant
from biped_adrc.closed_loop.semantics import parts
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.core.errors import ModelError
from biped_adrc.core.types import Array, frozen
from biped_adrc.engine.calls import Call, compiled_biped, compiled_references, pushes, zeta_rows
from biped_adrc.engine.kernels.record import OUTSIDE
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.numbers import controller_numbers
from biped_adrc.engine.program import COMPILED, Program
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar_robot import robot_of


def fastest_loop(
    walker: Walker, plant: SteppingPlant, engine: str = COMPILED, first_step: int = 1
) -> SteppingLoop:
    """Make the loop of `other_plant.stepping_loop`: the controller, sensors and clock of a walker around a
    plant that moves by itself.

    engine: "compiled" for sample instants in machine code, as far as their parts have it; any other runs in
    Python. first_step: number of the first single support.
    """
    kind = CompiledLoop if engine == COMPILED else SteppingLoop
    return other_plant.stepping_loop(walker, plant, first_step, kind)


@dataclass(frozen=True)
class CompiledLoop(SteppingLoop):
    """A `SteppingLoop` in machine code: its walk is the same to round-off, and much faster.

    `prepared` fills in the two fields below at the start of each run; all others are those of `SteppingLoop`.
    """

    program: Program | None = None
    """Program of its sample instants; None where a part of it cannot be compiled."""
    pushes: list[Call] | None = None
    """Terms of its disturbance in machine code; None where Python computes them."""

    def prepared(self, x: Array) -> tuple[Self, dict[str, str]]:
        """A copy of the loop for one run from x (nx,), with work space of its own, and the trajectory's
        settings "engine" and "why".

        Where its sample instants cannot be compiled, the controller still gets the terms of its model and its
        references in machine code, where they have any.
        """
        values, engine = dict[str, Any](), {"engine": COMPILED}
        with suppress(NotCompiled):
            values["pushes"] = pushes(self.disturbance, self.plant.n)
        try:
            if not isinstance(self.model, Biped):
                raise NotCompiled(f"the model is a {type(self.model).__name__}, expected a Biped")
            # moves: the plant moves by itself, so `tick` is the only function
            numbers = controller_numbers(robot_of(self.model), self)._replace(moves=True)
            values["program"] = Program(self.layout_of(x), numbers)
            _ = values["program"].machine  # compiles, or raises NotCompiled
        except (NotCompiled, ModelError) as reason:
            # the controller runs in Python, on a compiled model
            engine = {"engine": "compiled model", "why": f"{reason}; it runs in Python, slower"}
            values["program"] = None
            # []: gets the references that were compiled, of which nobody asks here
            values["controller"] = compiled_references(self.controller, self.plant.n, [])
            if isinstance(self.model, Biped):
                with suppress(ModelError):  # of a robot that is no planar tree
                    values["model"] = compiled_biped(self.model)
        return replace(self, **values), engine

    @cached_property
    def sample(self) -> Call:
        """The function `sample` of the module, with memory for its inputs; its name in the program is
        `tick`."""
        assert self.program is not None
        code, nx = self.program.machine, self.program.nx
        # numbers of inputs (t, step, t_start, x, zeta, OUTSIDE forces) and of outputs
        return Call(code, "tick", self.program.K, 3 + nx + self.plant.n + OUTSIDE, nx + 1)

    def tick(self, t: float, x: Array, mode: Mode) -> Array:
        """x (nx,) after the sample instant at t [s]. Where that is not finite or the least pivot not above 0,
        Python repeats the sample instant, for its error.
        """
        if self.program is None:
            return super().tick(t, x, mode)
        inp = self.sample.inp
        inp[0], inp[1], inp[2] = t, mode.step, mode.start
        # behind x n numbers stay 0: the place of zeta, which the plant alone feels; then the OUTSIDE forces
        inp[3 : 3 + len(x)] = x
        if self.touchdown is not None and self.touchdown.needs_force:
            q, v, _, tail = parts(self, x)
            inp[-OUTSIDE:] = self.foot_forces(t, q, v, tail, mode)
        out = self.sample()
        after = out[:-1]  # behind it the least pivot, infinite where nothing is solved
        # the sum of squares is finite only if every number is: the cheapest test of all
        if out[-1] > 0.0 and math.isfinite(after.dot(after)):
            return after
        return super().tick(t, x, mode)

    def load(self, t: float, row: Array, mode: Mode) -> Load:
        """The forces from outside on the plant in the state `row` = (q, q', ..) at t [s], by machine code;
        where they are not finite, Python computes them again, for its error.
        """
        if self.pushes is None:
            return super().load(t, row, mode)
        n = self.plant.n
        result = np.zeros(n + 2)  # zeta (n,) [N m], then the resultant force (2,) [N]
        for term in self.pushes:
            inp = term.inp
            inp[0], inp[1], inp[2], inp[3:] = t, mode.step, mode.start, row[: 2 * n]
            result += term()
        if not math.isfinite(result.dot(result)):  # finite only if every number is
            return super().load(t, row, mode)
        return frozen(Load(result[:n], result[n:]))

    @cached_property
    def pushed_in_python(self) -> bool:
        """Whether Python computes zeta at each node during the run: there is a disturbance without machine
        code."""
        return self.disturbance is not None and self.pushes is None

    def zetas(self, t: Array, rows: Array, mode: Mode) -> Array:
        """The disturbance zeta (K, n) [N m] at K times t (K,) [s] of one single support, for a disturbance in
        machine code or none; rows (K, ..): the plant's states there, which begin with q and q'.
        """
        if self.pushes is None:  # no disturbance, since one in Python is computed during the run
            return super().zetas(t, rows, mode)
        return zeta_rows(self.pushes, t, rows, mode, self.plant.n)
