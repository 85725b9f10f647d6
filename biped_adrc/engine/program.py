"""A walker as machine code: addresses of its functions, and the vector K of its numbers.

One compilation serves every robot, gain and gait of the same structure, which has no floats in it
(`engine.structure`). So a program is made in microseconds where its functions are in
memory, in milliseconds where they are on disk; only for a new structure is anything traced and
compiled.
"""

from __future__ import annotations

import math
from collections.abc import Hashable
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.walker import ErrorForm, Walker
from biped_adrc.control.base import Passive
from biped_adrc.control.outer_loop import OuterLoop, tracked_by
from biped_adrc.core.errors import ModelError
from biped_adrc.core.types import Array
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.engine import equations
from biped_adrc.engine.equations import Equations, Reading, SymbolicFunction, WalkerNumbers
from biped_adrc.engine.ir import generated
from biped_adrc.engine.machine import LoadedCode
from biped_adrc.engine.structure import structure
from biped_adrc.engine.symbols import NotCompiled, floats
from biped_adrc.engine.tracer import located
from biped_adrc.gait.reference import Reference
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar_robot import PlanarRobot, robot_of

COMPILED = "compiled"
"""Name of the engine in settings and records."""


@dataclass(frozen=True)
class Program:
    """Functions by name, and the numbers they are called with."""

    size: int
    """Numbers in the controller's state."""
    numbers: WalkerNumbers
    """The numbers by name."""

    @classmethod
    def of(
        cls,
        walker: Walker,
        size: int,
        split: ErrorForm | None = None,
        curve: Reference | OuterLoop | None = None,
        plant_alone: bool = False,
    ) -> Program:
        """The program of a walker whose controller has `size` states.

        split: coordinates of the exponential method. curve: what readings refer to. plant_alone: without
        controller, sensors and touchdown detector, for sample instants in Python. Takes the controller in its
        time base, the data of plant and model, and puts all floats into K in the order of `WalkerNumbers`.
        Raises NotCompiled for a part whose content cannot be compared, or ModelError for a robot that is no
        planar tree.
        """
        numbers = numbers_of(walker)._replace(
            split=split, curve=None if curve is None else tracked_by(walker.law, curve)
        )
        if plant_alone:
            held = walker.held._replace(sensors=None, touchdown=None) if walker.held else ()
            numbers = numbers._replace(controller=Passive(), held=held)
        return cls(size, numbers)

    @classmethod
    def of_loop(cls, loop: SteppingLoop, size: int) -> Program:
        """The program of sample instants around another plant. Raises NotCompiled also for a model that is no
        planar tree.
        """
        if not isinstance(loop.model, Biped):
            raise NotCompiled(f"the model is a {type(loop.model).__name__}, expected a Biped")
        try:
            return cls(size, controller_numbers(robot_of(loop.model), loop)._replace(moves=True))
        except ModelError as reason:
            raise NotCompiled(str(reason)) from reason

    @cached_property
    def K(self) -> Array:
        """The numbers as a vector; its last entry is unused, so that it is never empty."""
        K = np.array([*floats(self.numbers), 0.0])
        if np.any(np.isnan(K)):
            raise NotCompiled(
                f"a parameter of {type(self.numbers.controller).__name__} or of what is around it is NaN, of "
                "which generated code would make 0 where it is multiplied by 0"
            )
        return K

    @cached_property
    def key(self) -> Hashable:
        """What decides the code, but that of readings."""
        return self.size, structure(self.numbers._replace(curve=None))

    @property
    def nx(self) -> int:
        """Numbers in a state."""
        return self.numbers.nx(self.size)

    @cached_property
    def machine(self) -> LoadedCode:
        """Its functions in memory, compiled when they are asked for.

        Raises NotCompiled for a method that cannot be traced or an operation without machine code.
        """
        names = Equations.names(self.numbers)
        return generated(self.key, {name: partial(self._traced, name) for name in names})

    def reading(self, read: Reading) -> LoadedCode:
        """The function "reading" of `read`. Raises NotCompiled for a curve without a compiled form."""
        key = read, self.key, structure(self.numbers.curve)
        return generated(
            key, {"reading": lambda: Equations.of(self.size, self.numbers).reading(read)}
        )

    def _traced(self, name: str) -> SymbolicFunction:
        with located(name):
            function: SymbolicFunction = getattr(Equations.of(self.size, self.numbers), name)()
            return function

    def address(self, name: str) -> int:
        """Address of a compiled function; 0 if this walker does not need it, which no kernel calls."""
        split, code = self.numbers.split, self.machine
        if name == "matvec" and split is not None:
            sizes = len(split.A), self.numbers.plant.p
            code = generated(sizes, {name: partial(equations.matvec, *sizes)}, vectors=True)
        return code.addresses.get(name, 0)


def numbers_of(walker: Walker) -> WalkerNumbers:
    """All numbers of a walker by name, as K lists them; what a walker has not is empty and takes no place.

    Raises ModelError for a robot that is no planar tree.
    """
    return controller_numbers(robot_of(walker.plant), walker)._replace(
        model=None if walker.model is None else robot_of(walker.model),
        tan_slope=math.tan(walker.slope),
        lowest_hip=float(walker.lowest_hip),
        longest=float(walker.max_step_time),
        impact_gain=walker.gain,
    )


def controller_numbers(robot: PlanarRobot, loop: Walker | SteppingLoop) -> WalkerNumbers:
    """The numbers of a controller in sampled time with its model; of plant and ground there are none."""
    limit = math.inf if loop.torque_limit is None else float(loop.torque_limit)
    strongest, held = float(loop.bounds.strongest), loop.held or ()
    return WalkerNumbers(robot, None, loop.law, limit, strongest=strongest, held=held)


def push_code(term: Disturbance, n: int) -> LoadedCode:
    """Machine code with the function `push` of a term of a disturbance of n coordinates.

    Terms are compiled by themselves, so that other pushes do not compile the walker again. Raises NotCompiled
    for one that cannot be traced, with the reason.
    """
    if type(term).switching_times is not Disturbance.switching_times:
        raise NotCompiled(f"{type(term).__name__} writes switching_times in place of switches")
    return generated(("push", n, structure(term)), {"push": partial(equations.push, term, n)})
