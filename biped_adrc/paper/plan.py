"""The runs of the reproduction, by name: what each of the paper's claims is tested on."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from biped_adrc.analysis.signals import Signals
from biped_adrc.campaign.pool import Task
from biped_adrc.engine.run import COMPILED, PINOCCHIO
from biped_adrc.errors import BipedError, InputError
from biped_adrc.gait.gait import load_gait
from biped_adrc.gait.published import X_STAR
from biped_adrc.gait.recipe import impact_smoothness
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.paper.claims.admissible import method
from biped_adrc.paper.claims.evidence import claim_tasks
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.paper.physical_laws import model_laws, numerics_laws, walk_laws
from biped_adrc.paper.push_map import PATTERNS, push_map, pushes
from biped_adrc.scenario.build import RobotAndGait
from biped_adrc.scenario.outcome import Outcome
from biped_adrc.scenario.push import Push
from biped_adrc.scenario.run import execute, execute_twice, halved, walk_scenario
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.studies.cycle_stability import poincare_twice, return_map_samples

BOTH = CONTROLLERS
MOTORS = ("q1", "q2", "q3", "q4")
PAPER_PUSH = Push(dict.fromkeys(MOTORS, 30.0), step=19, start=0.1, stop=0.3)
SINE = Push(dict.fromkeys(MOTORS, 40.0), 19, 0.05, 0.3, kind="sine", frequency=5.0)
TORSO = Push({"q5": 20.0}, step=19, start=0.1, stop=0.3)
HEAVIER = {"torso": 1.2, "thigh": 1.15}
POLICIES = ("none", "relabel", "measured", "model")
MAP_ONSETS = tuple(round(0.05 * k, 2) for k in range(8))
"""[s]; a single support takes about 0.4 s."""
MAP_AMPLITUDES = (30.0, 60.0, 90.0, 120.0, 150.0)
"""[N m], up to what RABBIT's motors give."""
STEPS = {"NPD": (5e-4, 1e-4), "ADRC": (1.25e-4, 5e-5)}
"""[s], of every run, and where a push switches and in the single support after; halved, no figure of merit
changes by more than 1 % or its resolution (`studies.convergence`)."""
RESET_STEP = 2.5e-5
"""[s], for what follows an impact that the observer does not expect; the mean forces ask for it."""
DIVERGING_STEP = 5e-5
"""[s], the same for the walk that diverges 1.2 ms after the impact, of which only the ending is compared."""
ENGINES_STEP = 1e-3
"""[s], at which the two engines are compared over the pushed step."""
RISE = 0.01
"""[s] in which the paper's push rises and falls, beside its vertical edges."""


@dataclass(frozen=True)
class Plan:
    """What to reproduce. `pushes` replace the paper's push.

    full: the map of pushes too, which takes minutes. quick: a first look, without what `left_out` names.
    """

    preset: str = "identified"
    pushes: tuple[Push, ...] = (PAPER_PUSH,)
    full: bool = False
    quick: bool = False

    def __post_init__(self) -> None:
        if self.full and self.quick:
            raise InputError("'full' and 'quick' exclude one another; choose one of them")

    @property
    def presets(self) -> tuple[str, ...]:
        """The presets whose gaits are walked."""
        return (self.preset,) if self.quick else ("identified", "identified-bare", "tac2003")

    @property
    def left_out(self) -> tuple[str, ...]:
        """What a quick run does without."""
        if self.full:
            return ()
        if not self.quick:
            return ("the map of pushes (--full)",)
        return (
            "the map of pushes",
            "the multipliers of ADRC, its observer's states included",
            f"presets other than {self.preset}",
            "(20) as printed",
            "the observer's resets at impact compared",
        )


@dataclass(frozen=True)
class Headline:
    """A headline run with all that is drawn."""

    outcome: Outcome
    trajectory: Trajectory
    signals: Signals


def headline(run: Scenario) -> tuple[Headline, list[Any]]:
    """A run that is kept whole, and its laws.

    Its figures are there at half of its steps too, and at a quarter for the single supports from the push on.
    """
    full = walk_scenario(run)
    laws = walk_laws(f"{run.controller}, {run.preset}", full)
    half = halved(run)
    quarter = execute(replace(halved(half), first_step=run.pushes[0].step, impacts=2))
    found = replace(full.outcome, half=replace(execute(half), half=quarter))
    return Headline(found, full.trajectory, full.signals), laws


def engines(run: Scenario) -> Outcome:
    """The pushed step of a run with Pinocchio's dynamics at `ENGINES_STEP`, and compiled in `half`."""
    pushed = run.pushes[0].step
    one = replace(run, first_step=pushed, impacts=1, h=ENGINES_STEP, fine=None, engine=PINOCCHIO)
    return replace(execute(one), half=execute(replace(one, engine=COMPILED)))


def base_runs(plan: Plan) -> dict[str, Scenario]:
    """Runs by name; each returns an Outcome. Names end in the controller."""
    runs: dict[str, Scenario] = {}
    for c in BOTH:
        run = stepped(Scenario(c, preset=plan.preset))
        for preset in plan.presets:
            runs[f"nominal {preset} {c}"] = replace(run, preset=preset)
        rising = tuple(replace(push, rise=RISE) for push in plan.pushes)
        first = min(push.step for push in plan.pushes)
        runs[f"rising push {c}"] = replace(run, pushes=rising, first_step=first, impacts=2)
        runs[f"sine {c}"] = replace(run, pushes=(SINE,), first_step=17, impacts=9)
        runs[f"torso {c}"] = replace(run, pushes=(TORSO,), first_step=17, impacts=9)
        runs[f"1 kHz {c}"] = Scenario(
            c, preset=plan.preset, pushes=plan.pushes, period=1e-3, h=1e-3
        )
        heavier = replace(run, mass=HEAVIER, impacts=8, fine=None)
        runs[f"heavier, masses {c}"] = heavier
        runs[f"heavier, masses and inertias {c}"] = replace(heavier, inertia=HEAVIER)
    if not plan.quick:
        runs |= literal_runs(plan)
    return {name: replace(run, engine=COMPILED) for name, run in runs.items()}


def stepped(run: Scenario) -> Scenario:
    """With the steps of the reproduction; ADRC with its feedback in the linear part of the method."""
    h, fine = STEPS[run.controller]
    return replace(run, method=method(run.controller), h=h, fine=fine)


def pushed_run(plan: Plan, controller: str) -> Scenario:
    """A headline run: the paper's, with its push."""
    run = Scenario(controller, preset=plan.preset, pushes=plan.pushes, engine=COMPILED)
    return stepped(run)


def literal_runs(plan: Plan) -> dict[str, Scenario]:
    """(20) as printed, and every reset policy with and without RABBIT's torque limit."""
    runs = {}
    for c in BOTH:
        printed = stepped(Scenario(c, preset=plan.preset, solve_theta=False, impacts=8))
        runs[f"as printed {c}"] = printed
    for policy in POLICIES:
        for limit in (None, 150.0):
            name = f"reset {policy}, {'unlimited' if limit is None else '150 N m'}"
            run = Scenario(preset=plan.preset, reset=policy, torque_limit=limit, impacts=2)
            diverges = policy == "none" and limit is None
            h = DIVERGING_STEP if diverges else RESET_STEP
            runs[name] = replace(run, method="exponential", h=h)
    return runs


@dataclass(frozen=True)
class RecipeResult:
    """What became of gait (b) in one preset under one controller."""

    preset: str
    controller: str
    closes: bool
    reason: str
    record: dict[str, Any]
    outcome: Outcome | None = None
    """Of the walk, at two steps."""


def recipe_result(preset: str, controller: str) -> RecipeResult:
    """Walk gait (b) and look for its fixed point, at two steps; whatever comes out is reported."""
    run = replace(stepped(Scenario(controller, preset=preset, gait="recipe", impacts=8)), fine=None)
    run = replace(run, engine=COMPILED)
    biped = RobotAndGait.of(run).biped
    record: dict[str, Any] = {}
    found = None
    try:
        gait = load_gait("recipe", biped)
        found = execute_twice(run)
        names = ("status", "impacts", "peak_error", "peak_torque")
        record = {name: getattr(found, name) for name in names}
        record["impact_rate_jump"] = impact_smoothness(gait, biped).tolist()
        if found.certificates:
            last = found.certificates[-1]
            record |= {"certificate": last.record(), "violations": list(last.violations())}
        cycle = poincare_twice(replace(run, h=1e-3))
        orbit, x_minus = cycle.orbit, cycle.orbit.x_minus[: 2 * biped.n]
        record |= {
            "x_minus": x_minus.tolist(),
            "distance_to_x_star": (x_minus - X_STAR).tolist(),
            "multipliers": abs(orbit.multipliers).tolist(),
            "multipliers_change": cycle.gap,
            "stable": orbit.stable,
        }
    except BipedError as error:
        return RecipeResult(preset, controller, False, str(error), record, found)
    return RecipeResult(preset, controller, True, "", record, found)


def tasks(plan: Plan) -> dict[str, Task]:
    """Everything to compute, by name, the longest first; each in its own process."""
    adrc, npd = Scenario("ADRC", preset=plan.preset), Scenario("NPD", preset=plan.preset)
    pushed = {c: pushed_run(plan, c) for c in BOTH}
    out: dict[str, Task] = {}
    for c in reversed(BOTH):
        out[f"headline {c}"] = Task(f"{c} under the push", headline, (pushed[c],))
        out[f"engines {c}"] = Task(f"{c}: the two engines", engines, (pushed[c],))
    if not plan.quick:
        remembering = replace(adrc, reset="measured")
        out["multipliers ADRC"] = Task("multipliers ADRC", poincare_twice, (adrc,))
        out["multipliers ADRC measured"] = Task(
            "multipliers ADRC, reset measured", poincare_twice, (remembering,)
        )
    out |= {
        "multipliers NPD": Task("multipliers NPD", poincare_twice, (npd,)),
        "numerics": Task("orders and (23)", numerics_laws, (plan.preset,)),
        "return map": Task("return map", return_map_samples, (npd,)),
    }
    out |= claim_tasks(plan.presets)
    for preset in plan.presets:
        out[f"model {preset}"] = Task(f"laws of the model, {preset}", model_laws, (preset,))
        for c in BOTH:
            name = f"recipe {preset} {c}"
            out[name] = Task(f"gait (b), {preset}, {c}", recipe_result, (preset, c))
    for name, run in base_runs(plan).items():
        out[name] = Task(name, execute_twice, (run,))
    if plan.full:
        out |= map_tasks(plan)
    return out


def map_tasks(plan: Plan) -> dict[str, Task]:
    """The map of pushes: a task for every preset, torque limit [N m] and joint pattern."""
    return {
        f"map {preset}, {limit}, {pattern}": Task(
            f"map of pushes, {preset}, {pattern}",
            push_map,
            (Scenario(preset=preset), pushes(MAP_ONSETS, MAP_AMPLITUDES, (pattern,), (limit,))),
        )
        for preset in plan.presets
        for limit in (None, 150.0)
        for pattern in PATTERNS
    }
