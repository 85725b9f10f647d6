"""A walker as machine code: its functions, the vector K of its numbers, and the plan of its runs.

A plan is the memory of a run that has not begun; the march is the compiled loop that moves a run through time.
A reading is a function that reads arrays off the closed loop at one instant, for signals and verdicts; the
curve is the reference (desired joint angles) from which it takes tracking errors.

One compilation serves every robot, gain and gait of the same structure, which has no floats in it
(`engine.structure`). So a program is made in microseconds where its functions are in memory, in milliseconds
where they are on disk; only for a new structure is anything traced and compiled.

In a `CompiledWalker` three things come together: the program (flow, tick, impact, ..), the matrices of the
method (`hybrid.exponential`), and the terms of the disturbance, which are compiled by themselves so that
another disturbance does not recompile the walker. What cannot be compiled raises `NotCompiled` with the reason;
in sampled time the march then calls its sample instants and impacts in Python (`engine.ticks`), and the plant
moves in machine code between them.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np

from biped_adrc.closed_loop.walker import LEAST_STEP, Walker
from biped_adrc.control.base import Passive
from biped_adrc.control.outer_loop import OuterLoop
from biped_adrc.core.part import once
from biped_adrc.core.tree import Layout
from biped_adrc.core.types import Array
from biped_adrc.disturbances.base import NO_PUSH, Disturbance
from biped_adrc.engine.generated import generated, with_casadi
from biped_adrc.engine.kernels.compiled_run import CompiledRun, plan
from biped_adrc.engine.kernels.record import FUNCTIONS, PART
from biped_adrc.engine.machine import Code
from biped_adrc.engine.not_compiled import NotCompiled, located
from biped_adrc.engine.numbers import Reading, WalkerNumbers, numbers_of
from biped_adrc.engine.structure import alike, floats, floats_inside, structure
from biped_adrc.gait.reference import Reference
from biped_adrc.hybrid import constants
from biped_adrc.hybrid.exponential import Exponential, no_coordinates, phi_levels
from biped_adrc.hybrid.integrators import RK4, OneStepMethod

if TYPE_CHECKING:
    from biped_adrc.engine.equations import Equations, SymbolicFunction

COMPILED = "compiled"
"""Name of the engine in settings and records."""


@dataclass(frozen=True)
class Program:
    """A walker's functions in machine code, by name, and the vector K of numbers with which they are called.

    Made at once; code is looked up or compiled when it is first used, and then NotCompiled is raised for a part
    that cannot be compiled.
    """

    layout: Layout
    """Layout of a state x."""
    numbers: WalkerNumbers
    """The walker's numbers by name; as a vector they are K."""

    @cached_property
    def equations(self) -> Equations:
        """The functions on symbols; the import here, where something is traced, brings CasADi in."""
        from biped_adrc.engine.equations import Equations

        return Equations(self.layout, self.numbers)

    @property
    def nx(self) -> int:
        """Numbers in a state."""
        return self.layout.size

    @property
    def names(self) -> list[str]:
        """Names of the functions that this walker needs, each a method of `Equations`: `tick` in sampled time,
        the last three for the exponential method.
        """
        # a plant that moves by itself: sample instants are all that is compiled
        if self.numbers.moves:
            return ["tick"]
        split = [] if self.numbers.split is None else ["to", "back", "remainder"]
        return ["flow", "impact", "events", *(["tick"] if self.numbers.held else []), *split]

    @cached_property
    def K(self) -> Array:
        """The floats of `numbers` as a vector; its last entry is unused, so that it is never empty.

        Raises NotCompiled for NaN: the walk then runs in Python, which names the part with the NaN.
        """
        K = np.array([*floats(self.numbers), 0.0])
        if np.any(np.isnan(K)):
            name = type(self.numbers.controller).__name__
            raise NotCompiled(f"a parameter of {name} or of what is around it is NaN")
        return K

    @cached_property
    def first(self) -> int:
        """Index in K of the controller's first number; K has the numbers in the order of the fields, those of
        plant and model before."""
        return len(floats(self.numbers[: self.numbers._fields.index("controller")]))

    @cached_property
    def key(self) -> Hashable:
        """The structure that decides all code of the program except that of readings, which alone use the
        curve."""
        return self.layout, structure(self.numbers._replace(curve=None))

    @cached_property
    def machine(self) -> Code:
        """The program's functions `names` in memory, compiled together at the first use.

        Raises NotCompiled for a method that cannot be traced or an operation without machine code.
        """
        return generated(self.key, {name: partial(self._traced, name) for name in self.names})

    def reading(self, read: Reading, lanes: int = 1) -> Code:
        """Machine code of `read`, with the address "reading"; its inputs are those of `tick`, its output all
        arrays that `read` returns. lanes: number of walks that it serves in one call. Raises NotCompiled for a
        curve without a compiled form.
        """
        key = read, self.key, structure(self.numbers.curve)
        return generated(key, {"reading": lambda: self.equations.view(read)}, lanes=lanes)

    def _traced(self, name: str) -> SymbolicFunction:
        """The function `name` on symbols; an error names the place in the user's code."""
        with located(name):
            return getattr(self.equations, name)()

    def address(self, name: str) -> int:
        """Address of a compiled function, a name of `kernels.record.FUNCTIONS`; 0 for one that this walker does
        not need, which no kernel calls then.
        """
        # `matvec` is not the walker's: its code depends on the shapes (k, k) and (k, p) alone
        split, code = self.numbers.split, self.machine
        if name == "matvec" and split is not None:
            sizes = len(split.A), self.numbers.plant.p
            traced = partial(with_casadi, "equations", "matvec_function", *sizes)
            code = generated(sizes, {name: traced}, optimised=True)
        return code.addresses.get(name, 0)


def push_code(term: Disturbance, n: int) -> Code:
    """Machine code with the function `push` of a disturbance's term: its torque on n coordinates, and its
    force.

    Terms are compiled by themselves, so that other pushes do not compile the walker again. Raises NotCompiled
    for one that cannot be traced, with the reason.
    """
    # compiled loops get the table `switches`, and could not call a `switching_times` of the user's
    if type(term).switching_times is not Disturbance.switching_times:
        raise NotCompiled(f"{type(term).__name__} writes switching_times in place of switches")
    traced = partial(with_casadi, "equations", "push_function", term, n)
    return generated(("push", n, structure(term)), {"push": traced})


def at_rest(layout: Layout) -> Layout:
    """The layout of a state x for a walker whose sample instants run in Python; its size is the same.

    Machine code then reads q, q' and the torques on their way (`line`) alone. The states of controller, sensors
    and detector of touchdowns, whatever their classes are, become plain rows of numbers that it carries along.
    """
    # the tail has four parts: own, belief of the detector, sensors, line. Here the numbers of the first three
    # are one row, `own`. Layout(None, (k,), k) is that of a row of k numbers
    q, v, s, tail = layout.parts
    line, none = tail.parts[-1], Layout.of(None)
    own = tail.size - line.size
    tail = tail._replace(parts=(Layout(None, (own,), own), none, none, line))
    return layout._replace(parts=(q, v, Layout(None, (s.size,), s.size), tail))


@dataclass(frozen=True)
class CompiledWalker:
    """A walker that the compiled loops can run."""

    walker: Walker
    """The walker that was compiled."""
    program: Program
    """Its functions, and the vector K of its numbers."""
    plan: CompiledRun
    """A run that has not begun: sizes, addresses, tables and settings; each run starts in a copy of it."""
    still: _Still
    """What of it does not depend on the disturbance."""

    @classmethod
    def of(
        cls,
        walker: Walker,
        method: OneStepMethod,
        layout: Layout,
        t_first: float = 0.0,
        reference: Reference | None = None,
        in_python: bool = False,
        loaded: bool = True,
    ) -> Self:
        """Make the tables of a run that begins at t_first [s], for states of this layout
        (`ClosedLoop.layout_of`).

        reference: the curve from which readings of the program take errors; None for a program without
        readings. in_python: whether sample instants and impacts are those of `engine.ticks`, in sampled time,
        so that the controller is not compiled. loaded: whether functions are in memory, so that the walker can
        run here; else 1 stands for each address. Traces or compiles what is neither in memory nor on disk.
        Raises NotCompiled where a part or the method cannot be compiled, InputError for an exponential method
        where the walker has no coordinates for it.
        """
        # all that does not depend on the disturbance, remembered from earlier calls
        still = _still(walker.undisturbed, method, layout, reference, in_python, loaded)
        return cls._under(walker, still, t_first, loaded)

    @classmethod
    def _under(cls, walker: Walker, still: _Still, t_first: float, loaded: bool = True) -> Self:
        """Add the walker's disturbance to what is `still`; see `of`."""
        push, n = walker.disturbance or NO_PUSH, walker.plant.n
        numbers = [floats(x) for x in push.terms]
        texts = [push_code(x, n) for x in push.terms]
        codes = [x.addresses["push"] if loaded else 1 for x in texts]
        # of each term PART numbers, the address of its code and how many numbers it has; `view` keeps the
        # bits of these whole numbers in a table of floats
        parts = [*zip(codes, map(len, numbers), strict=True)]
        # switches: rows (step, s), instants s [s] after the start of a single support at which it is not smooth
        tables = {
            "switches": np.array(push.switches, dtype=float).reshape(-1, 2),
            "push": np.array([*chain(*numbers)]),
            "parts": np.array(parts, dtype=np.int64).reshape(-1, PART).view(float),
        }
        run = still.plan(tables)
        # pulled: whether a force from outside may act, besides torques
        run["t_first"], run["pulled"] = t_first, push.pulls
        return cls(walker, still.program, run, still)

    @cached_property
    def terms(self) -> tuple[Disturbance, ...]:
        """The terms of its disturbance."""
        return (self.walker.disturbance or NO_PUSH).terms

    def like(self, walker: Walker) -> Self | None:
        """The compiled form of a walker that differs from this one in its disturbance and in numbers of its
        controller alone; None where `of` has to look: its controller has another structure or NaN, or other
        numbers than its own depend on it.
        """
        if walker.controller is self.walker.controller:
            return self._under(walker, self.still, self.plan["t_first"])
        program, law = self.program, walker.law
        old, numbers = program.numbers, program.numbers._replace(controller=law)
        own, K = np.array(floats_inside(law)), program.K.copy()
        # an outer loop decides what the curve is, and gains the coordinates of an exponential method
        entangled = isinstance(law, OuterLoop) or old.split is not None
        if entangled or not alike(law, old.controller) or np.any(np.isnan(own)):
            return None
        K[program.first : program.first + len(own)] = own
        other = replace(program, numbers=numbers)
        vars(other)["key"] = program.key  # computed already, and equal for laws that are alike
        still = self.still._replace(program=other, tables={**self.still.tables, "K": K})
        return self._under(walker, still, self.plan["t_first"])


class _Still(NamedTuple):
    """What a walker without its disturbance needs to run: walkers that differ in their disturbance alone share
    it."""

    program: Program
    label: str
    """Name and step of the method of integration, for records."""
    tables: dict[str, Array]
    """Vectors of `kernels.record.Run` by name, without those of the disturbance."""
    fields: dict[str, float]
    """Fields of `kernels.record.Run` by name."""
    plans: dict[tuple[int, ...], CompiledRun]
    """Plans so far, by the sizes of the disturbance's tables, which decide where everything lies in memory."""

    def plan(self, tables: dict[str, Array]) -> CompiledRun:
        """A plan of a run with these tables of a disturbance, by name: a copy of one of equal sizes, filled
        in."""
        sizes = tuple(len(table) for table in tables.values())
        if sizes not in self.plans:
            self.plans[sizes] = plan({**self.tables, **tables}, self.fields)
        # K too: walkers that are alike have their plans in common
        return self.plans[sizes].filled({"K": self.tables["K"], **tables})


@once
def _still(
    walker: Walker,
    method: OneStepMethod,
    layout: Layout,
    reference: Reference | None,
    in_python: bool,
    loaded: bool,
) -> _Still:
    """Compute what `CompiledWalker.of` needs of a walker without its disturbance, remembered for the next call.

    method: of integration. layout: of a state. reference: from which readings take errors, None for none.
    in_python: whether sample instants and impacts run in Python. loaded: whether functions are in memory.
    """
    if not isinstance(method, RK4 | Exponential):
        name = type(method).__name__
        raise NotCompiled(f"method {name} has no compiled form, as RK4 and Exponential have")
    etd = isinstance(method, Exponential)
    split = walker.split_form() if etd else None
    if etd and split is None:
        raise no_coordinates()
    numbers = numbers_of(walker, split, reference)
    # `Passive` has no numbers: the march calls Python where the controller acts, so its numbers are not in K
    if in_python:
        held = walker.held._replace(sensors=None, touchdown=None) if walker.held else ()
        numbers, layout = numbers._replace(controller=Passive(), held=held), at_rest(layout)
    program = Program(layout, numbers)
    n, p, nx, bounds = walker.plant.n, walker.plant.p, program.nx, walker.bounds
    relaxing = walker.relaxing()
    k = 0 if split is None else len(split.A)
    # in sampled time only q and q' flow, and so do torques of lagging motors; all of x is integrated too where
    # sample instants are in Python, since then no machine code gives q'' there
    flows = walker.held is None or relaxing or in_python
    tables = {
        "K": program.K,
        "fastest": bounds.fastest,
        "drops": np.array([(d.step, d.drop) for d in walker.ground_steps]).reshape(-1, 2),
        "phi": np.zeros(0) if split is None else phi_levels(method.h, split.A),
    }
    # what is left out is 0: no clock, no lag
    fields = dict[str, float]()
    if walker.held is not None:
        T = walker.clock.period
        part = walker.held.motors.fraction * T  # what the delay has beyond whole periods [s]
        fields |= {"period": T, "restart": walker.clock.restart, "part": part}
    fields |= {"kind": constants.ETD if etd else constants.RK4, "h": method.h}
    # coordinates, numbers in x, motors, rows of the stiff part E (k, p), and how many numbers of x flow
    fields |= {"n": n, "nx": nx, "p": p, "k": k, "moving": nx if flows else 2 * n}
    # LEAST_STEP: a shorter contact of the foot is no touchdown
    fields |= {"least_step": LEAST_STEP, "farthest": bounds.farthest}
    if relaxing is not None:
        # `at` counts from the end of x, so its start is negative; lags: index of the first lagging torque
        fields |= {"lags": nx + relaxing.at.start, "lag_speed": relaxing.speed}
    has = program.address if loaded else program.machine.names.count
    fields |= {name: has(name) for name in FUNCTIONS}
    return _Still(program, method.label, tables, fields, {})  # {}: no plan has been made yet
