"""Which of the three kinds of `moving.Moving` moves a walker on."""

from __future__ import annotations

import numpy as np

from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.engine.compiled_walker import CompiledWalker
from biped_adrc.engine.program import NotCompiled
from biped_adrc.engine.simulate import compiled_plant
from biped_adrc.engine.ticks import TicksWithHardware, flowing
from biped_adrc.errors import InputError
from biped_adrc.hybrid.integrators import OneStepMethod
from biped_adrc.live.in_code import MovingCode, MovingPython, on_the_plan, own_plan
from biped_adrc.live.in_plant import MovingPlant
from biped_adrc.live.moving import Moving
from biped_adrc.timing import SampledTime


def moving_of(
    walker: Walker, method: OneStepMethod, loop: SteppingLoop | None, t_first: float = 0.0
) -> Moving:
    """What moves a walker on, on the rigid plant by a method, or in a loop around another plant.

    Raises InputError for a walker in continuous time, and for what has no compiled form on the rigid plant:
    a disturbance or a method in plain Python.
    """
    if not isinstance(walker.timing, SampledTime):
        raise InputError(
            "a live walk is controlled at sample instants, and this one acts at every instant; give a period, "
            "as hardware = 'ideal' or period = 0.001 in a scenario"
        )
    if loop is not None:
        return MovingPlant(walker, t_first, loop)
    pushed = on_the_plan(walker)
    try:
        still = np.zeros(walker.plant.n)
        size = walker.controller_size(walker.initial_state(still, still))
        try:
            made = CompiledWalker.of(pushed, method, size, t_first)
        except NotCompiled:
            fast, _ = compiled_plant(pushed)
            held = own_plan(CompiledWalker.held(fast, method))
            assert fast.held is not None
            places = flowing(fast.held.sizes, 2 * walker.plant.n + size + walker.behind)
            return MovingPython(fast, t_first, TicksWithHardware(fast, held, places))
    except NotCompiled as reason:
        raise InputError(f"a live walk is moved in machine code, and {reason}") from reason
    return MovingCode(walker, t_first, own_plan(made))
