"""A walker, a one-step method and a disturbance, ready for the compiled loops."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from biped_adrc.control.passive import Passive
from biped_adrc.disturbances.base import Disturbance, DisturbanceLaw, terms
from biped_adrc.engine.fingerprint import skeleton
from biped_adrc.engine.kernels import methods
from biped_adrc.engine.kernels.plan import Plan, plan
from biped_adrc.engine.kernels.tables import (
    Clock,
    Code,
    Method,
    Push,
    Scene,
    Sizes,
    continuous_time,
    no_push,
)
from biped_adrc.engine.native import NativeLaw, flatten, native_law
from biped_adrc.engine.program import NotCompiled, Program
from biped_adrc.errors import InputError
from biped_adrc.hybrid.exponential import Exponential, no_coordinates
from biped_adrc.hybrid.integrators import RK4, Adaptive, OneStepMethod
from biped_adrc.split import SplitLaws
from biped_adrc.timing import SampledTime
from biped_adrc.types import Array
from biped_adrc.walker import LEAST_STEP, Walker


@dataclass(frozen=True)
class CompiledWalker:
    """`plan` and `K` are what the loops take; `program` keeps the code they call in memory."""

    walker: Walker
    program: Program
    plan: Plan

    @property
    def K(self) -> Array:
        """The numbers."""
        return self.program.K

    @classmethod
    def of(
        cls, walker: Walker, method: OneStepMethod, size: int, t_first: float = 0.0
    ) -> CompiledWalker:
        """For a controller with `size` states and a run that begins at t_first [s].

        Raises NotCompiled where a part has no laws or the method no compiled form, InputError for a method
        without the coordinates that it needs.
        """
        split, made = _method(walker, method)
        program = Program.of(walker, size, split)
        time = walker.timing
        clock = continuous_time()
        if isinstance(time, SampledTime):
            assert walker.held is not None
            part = walker.held.motors.fraction * time.period if walker.held.sizes.waiting else 0.0
            clock = Clock(time.period, int(time.restart), t_first, part)
        return cls(walker, program, _plan(walker, program, split, clock, made))

    @classmethod
    def held(cls, walker: Walker, method: OneStepMethod) -> CompiledWalker:
        """The plant alone under a torque that is held; x = (q, q', u), with lag (q, q', u_m, u). As `of`."""
        bare = replace(
            walker,
            controller=Passive(),
            timing=SampledTime(1.0),
            sensors=None,
            meter=None,
            motors=None if walker.motors is None else replace(walker.motors, rate_limit=None),
        )
        split, made = _method(bare, method)
        program = Program.of(bare, 0, split)
        return cls(bare, program, _plan(bare, program, split, continuous_time(), made))


def _plan(
    walker: Walker, program: Program, split: SplitLaws | None, clock: Clock, method: Method
) -> Plan:
    n, p, nx = walker.plant.n, walker.plant.p, program.nx
    stiff = 0 if split is None else len(split.A)
    drops = np.array([(d.step, d.drop) for d in walker.ground_steps]).reshape(-1, 2)
    return plan(
        Code(*(program.address(name) for name in Code._fields)),
        Sizes(n, nx, p, nx - stiff * p, stiff, _moving(walker, nx)),
        Scene(walker.lowest_hip, walker.max_step_time, LEAST_STEP, drops),
        _push(walker.disturbance, n),
        clock,
        method,
    )


def _moving(walker: Walker, nx: int) -> int:
    """How many of the first states flow: all of them where the torque of the motors does."""
    flows = walker.held is None or walker.held.sizes.lag
    return nx if flows else 2 * walker.plant.n


_MATRICES: dict[tuple[Any, ...], Method] = {}
"""Of the exponential method, by its step and linear part; made once, by one thread."""


def _method(walker: Walker, method: OneStepMethod) -> tuple[SplitLaws | None, Method]:
    if type(method) is RK4:
        return None, methods.rk4(method.h)
    if type(method) is Adaptive:
        return None, methods.dop853(method.rtol, method.atol, method.max_step)
    if type(method) is not Exponential:
        raise NotCompiled(
            f"method {type(method).__name__} has no compiled form; the run goes on in Python on the compiled "
            "plant. Compiled are RK4, Adaptive and Exponential"
        )
    split = walker.split_laws(method.feedback)
    if split is None:
        raise no_coordinates()
    key = method.h, split.A.tobytes(), split.rows
    if key not in _MATRICES:
        while len(_MATRICES) >= 64:
            _MATRICES.pop(next(iter(_MATRICES)))
        _MATRICES[key] = methods.etd(method.h, split.A, np.array(split.rows, dtype=np.int64))
    return split, _MATRICES[key]


_NATIVE: dict[tuple[Any, ...], NativeLaw] = {}


def _push(disturbance: Disturbance | None, n: int) -> Push:
    if disturbance is None:
        return no_push()
    laws = disturbance.laws
    if laws is None:
        raise NotCompiled(
            f"disturbance {type(disturbance).__name__} has no laws of arrays; the run goes on in Python on "
            "the compiled plant"
        )
    for part in terms(disturbance):
        forces = type(part).resultant is not Disturbance.resultant
        if forces and all(law.resultant is None for law in part.laws or ()):
            raise NotCompiled(
                f"disturbance {type(part).__name__} has a resultant and no law of it; give "
                "DisturbanceLaw(..., resultant=...), or the run goes on in Python on the compiled plant"
            )
    numbers = [flatten(law.parameters) for law in laws]
    return Push(
        np.array([_address(law, n) for law in laws], dtype=np.int64),
        np.concatenate([np.zeros(0), *numbers]),
        np.cumsum([0, *(len(k) for k in numbers)]),
        np.array([switch for law in laws for switch in law.switches]).reshape(-1, 2),
        tuple(_resultant(law, n) for law in laws),
    )


def _address(law: DisturbanceLaw, n: int) -> int:
    return _native(law.torque, law.parameters, n, n)


def _resultant(law: DisturbanceLaw, n: int) -> int:
    return 0 if law.resultant is None else _native(law.resultant, law.parameters, n, 2)


def _native(law: Callable[..., Array], parameters: Any, n: int, size: int) -> int:
    key = law, skeleton(parameters), n
    if key not in _NATIVE:
        q = np.zeros(n)
        try:
            _NATIVE[key] = native_law(law, (parameters, 0.0, 1, 0.0, q, q), size)
        except InputError as reason:
            raise NotCompiled(str(reason)) from reason
    return _NATIVE[key].address
