"""A walker, a one-step method and a disturbance, made ready for the compiled loops.

Three things come together here: the program of the walker (`engine.program`: flow, tick, strike,
..), the matrices of the method (`hybrid.exponential`), and the terms of the
disturbance, which are compiled by themselves so that another disturbance does not recompile the
walker. The result is a `RunPlan`, which the kernels take.

The methods `torque` and `resultant` of a term become functions `void f(double* K, double* inp,
double* out)`: K its numbers, inp (t, step, t_start, q, v), out zeta (n,) [N m] or the force (2,)
[N]. Its method `acts` is evaluated first: where it is not above 0, out is zero and the rest is not
computed, since most pushes act for a small part of a walk.

What cannot be compiled raises `NotCompiled` with the reason; `engine.simulate` then runs in Python
on the compiled plant.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from operator import methodcaller
from typing import TypeVar

import numpy as np

from biped_adrc.closed_loop.exponential_form import ErrorForm
from biped_adrc.closed_loop.walker import LEAST_STEP, Walker
from biped_adrc.control.passive import Passive
from biped_adrc.disturbances.base import Disturbance
from biped_adrc.engine.equations import SymbolicFunction, count
from biped_adrc.engine.ir import in_memory, module_text
from biped_adrc.engine.kernels.record import PART
from biped_adrc.engine.kernels.run_plan import Functions, Push, RunPlan, plan
from biped_adrc.engine.machine import LoadedCode, ModuleText
from biped_adrc.engine.program import NotCompiled, Program
from biped_adrc.engine.structure import structure
from biped_adrc.engine.symbols import Untraceable, Vector, column, floats
from biped_adrc.engine.tracer import Tracer, run
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid import constants
from biped_adrc.hybrid.exponential import Exponential, no_coordinates, phi_levels
from biped_adrc.hybrid.integrators import RK4, OneStepMethod
from biped_adrc.timing import LONGEST_PERIOD, SampledTime
from biped_adrc.types import Array

T = TypeVar("T", bound=OneStepMethod)


@dataclass(frozen=True)
class CompiledWalker:
    """A walker that the compiled loops can run."""

    walker: Walker
    """As it was given, or the held plant alone."""
    program: Program
    """Keeps the code in memory and holds the parameters."""
    plan: RunPlan
    """Sizes, addresses and settings of the run, as vectors."""

    @classmethod
    def of(
        cls,
        walker: Walker,
        method: OneStepMethod,
        size: int,
        t_first: float = 0.0,
        reference: Reference | None = None,
    ) -> CompiledWalker:
        """For a controller with `size` states and a run that begins at t_first [s].

        reference: for functions that read signals (`compiled_signals`); its numbers stand behind the walker's.
        Compiles the walker's functions where they are not in memory or on disk, and makes the plan.
        Raises NotCompiled where a part or the method cannot be compiled, InputError for a
        method without the coordinates that it needs.
        """
        split, fields, tables = _method(walker, method)
        program = Program.of(walker, size, split)
        time = walker.timing
        if isinstance(time, SampledTime):
            assert walker.held is not None
            part = walker.held.motors.fraction * time.period if walker.held.sizes.waiting else 0.0
            fields |= {"period": time.period, "restart": int(time.restart), "t_first": t_first}
            fields["part"] = part
        return cls(walker, program, _plan(program, walker, fields, tables, reference))

    @classmethod
    def held(cls, walker: Walker, method: OneStepMethod) -> CompiledWalker:
        """The plant alone under a torque that is held; x = (q, q', u), with lagging motors (q, q', u_m, u).

        For controllers that run in Python (`engine.ticks`). A period longer than any run takes the
        place of the clock. Raises as `of`.
        """
        bare = replace(
            walker,
            controller=Passive(),
            timing=SampledTime(LONGEST_PERIOD),
            sensors=None,
            touchdown=None,
            motors=None if walker.motors is None else replace(walker.motors, rate_limit=None),
        )
        split, fields, tables = _method(bare, method)
        program = Program.of(bare, 0, split)
        return cls(bare, program, _plan(program, bare, fields, tables))


def _plan(
    program: Program,
    walker: Walker,
    fields: Mapping[str, float],
    tables: Mapping[str, Array],
    reference: Reference | None = None,
) -> RunPlan:
    """The plan of a run, with fields and tables of method and clock.

    Of a held state only q and v flow, so the step methods may skip the rest; with lagging motors
    all of it does.
    """
    n, p, nx, bounds = walker.plant.n, walker.plant.p, program.make.nx, walker.bounds
    split, relaxing = program.numbers.split, walker.relaxing()
    k = 0 if split is None else len(split.A)
    flows = walker.held is None or relaxing  # the torque of the motors, then all does
    tables = {
        **tables,
        "K": np.array([*program.K[:-1], *floats(reference), 0.0]),
        "drops": np.array([(d.step, d.drop) for d in walker.ground_steps]).reshape(-1, 2),
    }
    if len(bounds.fastest):
        tables["fastest"] = bounds.fastest
    fields = {
        **fields,
        "n": n,
        "nx": nx,
        "p": p,
        "n_slow": nx - k * p,
        "k": k,
        "moving": nx if flows else 2 * n,
        "least_step": LEAST_STEP,
        "farthest": bounds.farthest,
    }
    if relaxing is not None:
        fields |= {"lags": nx + relaxing.at.start, "lag_speed": relaxing.speed}
    functions = Functions(*(program.address(name) for name in Functions._fields))
    return plan(functions, _push(walker.disturbance, n), tables, fields)


def _method(
    walker: Walker, method: OneStepMethod
) -> tuple[ErrorForm | None, dict[str, float], dict[str, Array]]:
    """The coordinates that a method needs, if any; its fields and tables of a run.

    Raises NotCompiled for all but RK4 and Exponential, and for a class of the user's own that steps otherwise;
    InputError for coordinates that the walker does not have.
    """
    if isinstance(method, RK4):
        return None, {"kind": constants.RK4, "h": method.h}, {}
    if not isinstance(method, Exponential):
        raise NotCompiled(
            f"method {type(method).__name__} has no compiled form, as RK4 and Exponential have; the run goes "
            "on in Python on the compiled plant"
        )
    split = walker.split_form()
    if split is None:
        raise no_coordinates()
    fields = {"kind": constants.ETD, "h": method.h}
    return split, fields, {"phi": phi_levels(method.h, split.A)}


def _push(disturbance: Disturbance | None, n: int) -> Push:
    """The terms of a disturbance as addresses and numbers; none without a disturbance.

    Raises NotCompiled, with the reason, where one has no machine code.
    """
    if disturbance is None:
        return Push()
    parts, K = list[tuple[int, int, int]](), list[float]()
    for term in disturbance.terms:
        code = term_code(term, n).addresses
        parts.append((code["torque"], len(K), code.get("resultant", 0)))
        K += [*floats(term), 0.0]
    table = np.array(parts, dtype=np.int64).reshape(-1, PART)
    return Push(table, np.array(K), np.array(disturbance.switches).reshape(-1, 2))


GUARDED = """
define void @{name}(ptr %K, ptr %inp, ptr %out) nounwind {{
  %flag = alloca double
  call void @acts(ptr %K, ptr %inp, ptr %flag)
  %a = load double, ptr %flag
  %acts = fcmp ogt double %a, 0.0
  br i1 %acts, label %act, label %rest
act:
  call void @{name}_acting(ptr %K, ptr %inp, ptr %out)
  ret void
rest:
  call void @llvm.memset.p0.i64(ptr %out, i8 0, i64 {bytes}, i1 false)
  ret void
}}
"""
"""A function that looks at `acts` first."""


def term_code(term: Disturbance, n: int) -> LoadedCode:
    """Machine code with the functions `torque` and, where the class writes it, `resultant`, for n coordinates.

    Raises NotCompiled for a term that cannot be traced, with the reason.
    """
    try:
        if _writes(term, "switching_times"):
            raise Untraceable(f"{type(term).__name__} writes switching_times in place of switches")
        key = "disturbance", n, structure(term)
        return in_memory(key, list(_sizes(term, n)), lambda: ModuleText(term_text(term, n)))
    except Untraceable as error:
        raise NotCompiled(f"{error}; the run goes on in Python on the compiled plant") from error


def term_text(term: Disturbance, n: int) -> str:
    """What `term_code` is made from, in LLVM's language.

    A class that writes `acts` gets three functions: `acts`, the function proper, and one that calls it only
    where the first is above 0. Raises Untraceable.
    """
    sizes = _sizes(term, n)
    if not _writes(term, "acts"):
        return module_text({name: _function(term, n, name, size) for name, size in sizes.items()})
    functions = {"acts": _function(term, n, "acts", 1)}
    functions |= {f"{name}_acting": _function(term, n, name, sizes[name]) for name in sizes}
    guarded = [GUARDED.format(name=name, bytes=8 * size) for name, size in sizes.items()]
    clear = "declare void @llvm.memset.p0.i64(ptr, i8, i64, i1)"
    return "\n".join([module_text(functions), clear, *guarded])


def _writes(term: Disturbance, name: str) -> bool:
    return getattr(type(term), name) is not getattr(Disturbance, name)


def _sizes(term: Disturbance, n: int) -> dict[str, int]:
    """The functions of a term, and how many numbers each gives."""
    return {"torque": n, "resultant": 2} if term.pulls else {"torque": n}


def _function(term: Disturbance, n: int, name: str, size: int) -> SymbolicFunction:
    """A method of a term on symbols. Raises Untraceable, also where it gives other than `size` numbers."""
    K, inp = Vector("K", count(term)), Vector("inp", 3 + 2 * n)
    k, at = K.like(term), (inp.take(), inp.take(), inp.take(), inp.take(n), inp.take(n))
    method = methodcaller(name, *(at if name == "torque" else at[:3]))
    try:
        out = column(run(Tracer(), method, k))
    except TypeError:  # no numbers
        out = column()
    if out.numel() != size:
        raise Untraceable(f"{type(term).__name__}.{name} gives no {size} numbers")
    return SymbolicFunction(K.symbol, inp.symbol, out)
