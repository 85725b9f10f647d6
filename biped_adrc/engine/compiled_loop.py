"""A `SteppingLoop` with its sample instants in machine code; it is given, and runs, as a `SteppingLoop`.

What ran is in the settings of the trajectory:

    engine    "compiled"; "compiled model" where the controller runs in Python, with the reason as "why"

A controller that cannot be compiled still gets the model's terms and its references from machine code. A plant
that does not stride (`closed_loop.stepping_plant.StridingPlant`), and motors that wait for a fraction of a
period, are run by `hybrid.simulator` as always, around compiled sample instants.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, fields, replace
from threading import get_ident
from typing import NamedTuple

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.stepping_plant import StridingPlant
from biped_adrc.engine.compiled_biped import CompiledBiped
from biped_adrc.engine.compiled_push import CompiledPush, PythonPush
from biped_adrc.engine.compiled_tick import CompiledTick
from biped_adrc.engine.controller_inputs import compiled_references
from biped_adrc.engine.program import NotCompiled
from biped_adrc.engine.run import COMPILED
from biped_adrc.engine.strides import Strides
from biped_adrc.errors import ModelError
from biped_adrc.hybrid import simulator
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.hybrid.system import HybridSystem
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.model.biped import Biped
from biped_adrc.types import Array

COMPILED_MODEL = "compiled model"
"""Name of the engine where the controller runs in Python on a compiled model."""


class Compiled(NamedTuple):
    """What there is of a loop in machine code."""

    loop: SteppingLoop
    """For what runs in Python."""
    tick: CompiledTick | None
    """Its sample instants; None where a part of it cannot be compiled."""
    why: str
    """The reason then."""


@dataclass(frozen=True)
class CompiledLoop(SteppingLoop):
    """As `SteppingLoop`, which says what its fields are: the same walk to round-off, much faster."""

    def run(self, x0: Array, options: RunOptions, mode: Mode | None = None) -> Trajectory:
        """As `SteppingLoop.run`, from x0 (nx,)."""
        began = Mode() if mode is None else mode
        x0 = self.checked_start(x0, options, began)
        made = self.compiled(self.controller_size(x0))
        system = self.system(self.controller_size(x0), options.t0)
        run = simulator.run(system, x0, began, None, options)
        settings = (
            {"engine": COMPILED} if made.tick else {"engine": COMPILED_MODEL, "why": made.why}
        )
        return replace(run, settings={**run.settings, **settings})

    def tick(self, t: float, x: Array, mode: Mode) -> Array:
        """x (nx,) after the sample instant at t [s]."""
        tick = self.compiled(self.controller_size(x)).tick
        found = None if tick is None else tick(t, x, mode)
        return super().tick(t, x, mode) if found is None else found[: len(x)]

    def __getstate__(self) -> dict[str, object]:
        return {name: x for name, x in super().__getstate__().items() if name != "_made"}

    def compiled(self, size: int) -> Compiled:
        """The loop for a controller with `size` states, made once in each thread, for its work space."""
        made: dict[tuple[int, int], Compiled] = vars(self).setdefault("_made", {})
        key = size, get_ident()
        if key not in made:
            made[key] = self._made_for(size)
        return made[key]

    def _made_for(self, size: int) -> Compiled:
        """As `compiled`."""
        parts = SteppingLoop(**{f.name: getattr(self, f.name) for f in fields(self)})
        try:
            return Compiled(parts, CompiledTick(parts, size), "")
        except NotCompiled as reason:
            return Compiled(on_compiled_model(parts), None, str(reason))

    def system(self, size: int, t_first: float) -> HybridSystem:
        """What the simulator runs from t_first [s] on, for a controller with `size` states."""
        made = self.compiled(size)
        assert self.held is not None
        if not isinstance(self.plant, StridingPlant) or self.held.sizes.waiting:
            return self if made.tick else made.loop
        return Strides(made.loop, self.plant, made.tick, _push(made.loop), t_first)


def on_compiled_model(loop: SteppingLoop) -> SteppingLoop:
    """The loop with the terms of its model and the references of its controller in machine code, where they
    have any.
    """
    controller = compiled_references(loop.controller, loop.plant.n, [])
    model = loop.model
    if isinstance(model, Biped):
        with suppress(ModelError):  # of a robot that is no planar tree
            model = CompiledBiped.of(model)
    return replace(loop, model=model, controller=controller)


def _push(loop: SteppingLoop) -> PythonPush | CompiledPush:
    """What acts from outside, in machine code where it can be compiled."""
    try:
        return (
            PythonPush(loop) if loop.disturbance is None else CompiledPush(loop, loop.disturbance)
        )
    except NotCompiled:
        return PythonPush(loop)
