"""The runs of the reproduction: every simulation on which a claim, check, table or figure of it rests.

A `Plan` says what was asked for (preset, pushes, quick or full); `tasks` turns it into independent tasks for
`campaign.pool`, each of a function here or in a neighbouring module. The first word of a task's name is its
kind, by which `paper.results` sorts what comes back. Integration steps are chosen so that halving them changes
no figure of merit by more than 1 % (`paper.convergence`); stiffer situations have shorter ones.

Kinds of tasks, and how many there are in a full plan:

    headline (2)      the pushed walks of figures 4 to 6, kept whole
    engines (2)       the pushed step on both engines
    multipliers (3)   walking cycles under NPD and ADRC
    claims (7)        the evidence for the claims (`paper.claims.evidence`)
    model (3)         laws of the model at random states
    numerics (1)      orders of the methods
    return map (1)    samples of Theta' before one impact and the next
    recipe (6)        gait (b)
    map (60)          parts of the map of pushes
    others            walks of `base_runs`
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypedDict

from biped_adrc.analysis.signals import Signals
from biped_adrc.campaign.pool import Task
from biped_adrc.checks import Check
from biped_adrc.engine.run import COMPILED, PINOCCHIO
from biped_adrc.errors import BipedError, InputError
from biped_adrc.gait.gait import load_gait
from biped_adrc.gait.published import X_STAR
from biped_adrc.gait.recipe import impact_smoothness
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.paper.claims.tasks import claim_tasks
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.paper.physical_laws import model_laws, numerics_laws, walk_laws
from biped_adrc.paper.push_map import PATTERNS, push_map, pushes
from biped_adrc.scenario.build import RobotAndGait
from biped_adrc.scenario.outcome import Outcome
from biped_adrc.scenario.push import Push
from biped_adrc.scenario.run import execute, execute_twice, halved, walk_scenario
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.studies.cycle_stability import poincare_twice, return_map_samples

MOTORS = "q1,q2,q3,q4"
"""The actuated joints."""
PAPER_PUSH = Push(joints=MOTORS, torque=30.0, step=19, onset=0.1, duration=0.2)
"""The push of figures 4 to 6: 30 N m on all joints for 0.2 s in step 19. The paper prints no amplitude."""
SINE = Push(
    shape="sine",
    joints=MOTORS,
    torque=40.0,
    step=19,
    onset=0.05,
    duration=0.25,
    frequency=5.0,
    across_impacts=False,
)
"""A disturbance of 5 Hz on all joints [N m]."""
TORSO = Push(joints="q5", torque=20.0, step=19, onset=0.1, duration=0.2)
"""A push on the torso, which no motor drives [N m]."""
HEAVIER = {"torso": 1.2, "thigh": 1.15}
"""Factors on the links' masses (and inertias) of the plant alone, not of the controller's model."""
POLICIES = ("none", "relabel", "measured", "model")
"""What the observer's states become at an impact."""
MAP_ONSETS = tuple(round(0.05 * k, 2) for k in range(8))
"""Onsets of the map of pushes [s] after an impact; a single support takes about 0.4 s."""
MAP_AMPLITUDES = (30.0, 60.0, 90.0, 120.0, 150.0)
"""Amplitudes of the map of pushes [N m], up to what RABBIT's motors give."""
STEPS = {"NPD": (5e-4, 1e-4), "ADRC": (5e-5, 2.5e-5)}
"""Integration steps of RK4 [s]: of the whole walk, and of the single supports where a push switches and
the one after.
"""
RESET_STEP = 2.5e-5
"""Step [s] for what follows an impact that the observer does not expect; the averaged forces need it."""
DIVERGING_STEP = 5e-5
"""The same for the walk that diverges 1.2 ms after the impact, of which only the ending is compared [s]."""
ENGINES_STEP = 1e-3
"""Step at which the two engines are compared over the pushed step [s]."""
RISE = 0.01
"""Time in which the headline push rises and falls [s], in the runs beside those with vertical edges."""


@dataclass(frozen=True)
class Plan:
    """What to reproduce. Raises InputError for `full` and `quick` together."""

    preset: str = "identified"
    """Of RABBIT, for the headline runs."""
    pushes: tuple[Push, ...] = (PAPER_PUSH,)
    """In place of the paper's push."""
    full: bool = False
    """The map of pushes too, which takes minutes."""
    quick: bool = False
    """A first look, without what `left_out` names."""

    def __post_init__(self) -> None:
        if self.full and self.quick:
            raise InputError("'full' and 'quick' exclude one another; choose one of them")

    @property
    def presets(self) -> tuple[str, ...]:
        """The presets whose gaits are walked."""
        return (self.preset,) if self.quick else ("identified", "identified-bare", "tac2003")

    @property
    def left_out(self) -> tuple[str, ...]:
        """What this plan does not compute, in words."""
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
    """A pushed run with all that is drawn of it."""

    outcome: Outcome
    """Its figures of merit, with those at half of the step in `half`."""
    trajectory: Trajectory
    """All its nodes."""
    signals: Signals
    """Errors, torques, forces and energies at the nodes."""


def headline(run: Scenario) -> tuple[Headline, list[Check]]:
    """A run that is kept whole, and the checks of its physical laws.

    Its figures of merit are computed at half of its steps too, and at a quarter for the single supports from
    the push on, from which the order of convergence follows.
    """
    full = walk_scenario(run)
    laws = walk_laws(f"{run.controller.name}, {run.robot.preset}", full)
    half = halved(run)
    quarter = execute(from_push(halved(half), 2))
    found = replace(full.outcome, half=replace(execute(half), half=quarter))
    return Headline(found, full.trajectory, full.signals), laws


def from_push(run: Scenario, impacts: int) -> Scenario:
    """The run from its first push on, for some impacts, with the pushes that act then."""
    first = min(push.step for push in run.pushes)
    acting = tuple(push for push in run.pushes if push.step < first + impacts)
    return run.replace(pushes=acting, run={"first_step": first, "impacts": impacts})


def engines(run: Scenario) -> Outcome:
    """The pushed step on Pinocchio's dynamics at `ENGINES_STEP`, with the same on the compiled engine in
    `half`.

    `half` is used as the place for the second run, though its step is the same.
    """
    one = from_push(run, 1).replace(run={"engine": PINOCCHIO, "h": ENGINES_STEP})
    one = one.replace(run={"method": None, "fine": None})
    return replace(execute(one), half=execute(one.replace(run={"engine": COMPILED})))


def base_runs(plan: Plan) -> dict[str, Scenario]:
    """The walks that need no function of their own, by name; names end in the controller.

    Undisturbed in every preset; the push with slow edges; a sine; a push on the torso; sampled control at 1
    kHz; a plant that is heavier than the controller's model. Where a run starts later than in step 1, it starts
    on the orbit.
    """
    runs: dict[str, Scenario] = {}
    for c in CONTROLLERS:
        run = stepped(Scenario(c, robot={"preset": plan.preset}))
        for preset in plan.presets:
            runs[f"nominal {preset} {c}"] = run.replace(robot={"preset": preset})
        rising = tuple(push.replace(rise=RISE) for push in plan.pushes)
        runs[f"rising push {c}"] = from_push(run.replace(pushes=rising), 2)
        runs[f"sine {c}"] = run.replace(pushes=(SINE,), run={"first_step": 17, "impacts": 9})
        runs[f"torso {c}"] = run.replace(pushes=(TORSO,), run={"first_step": 17, "impacts": 9})
        runs[f"1 kHz {c}"] = Scenario(
            c,
            robot={"preset": plan.preset},
            pushes=plan.pushes,
            hardware={"period": 1e-3},
            run={"h": 1e-3},
        )
        heavier = run.replace(errors={"mass": HEAVIER}, run={"impacts": 8, "fine": None})
        runs[f"heavier, masses {c}"] = heavier
        runs[f"heavier, masses and inertias {c}"] = heavier.replace(errors={"inertia": HEAVIER})
    if not plan.quick:
        runs |= literal_runs(plan)
    return {name: run.replace(run={"engine": COMPILED}) for name, run in runs.items()}


def stepped(run: Scenario) -> Scenario:
    """The run with the steps of the reproduction."""
    h, fine = STEPS[run.controller.name]
    return run.replace(run={"method": "rk4", "h": h, "fine": fine})


def pushed_run(plan: Plan, controller: str) -> Scenario:
    """The headline run of a controller: the paper's gait under the plan's pushes."""
    run = Scenario(
        controller, robot={"preset": plan.preset}, pushes=plan.pushes, run={"engine": COMPILED}
    )
    return stepped(run)


def literal_runs(plan: Plan) -> dict[str, Scenario]:
    """(20) as printed, where Theta'' is not solved for; and every policy for the observer's states at an
    impact.

    The policies are run with and without RABBIT's torque limit: an observer that does not expect the impact
    asks for torques that no motor gives.
    """
    runs = {}
    for c in CONTROLLERS:
        printed = stepped(
            Scenario(
                {"name": c, "solve_theta": False}, robot={"preset": plan.preset}, run={"impacts": 8}
            )
        )
        runs[f"as printed {c}"] = printed
    for policy in POLICIES:
        for limit in (None, 150.0):
            name = f"reset {policy}, {'unlimited' if limit is None else '150 N m'}"
            run = Scenario(
                {"observer": {"reset": policy}},
                robot={"preset": plan.preset},
                hardware={"torque_limit": limit},
                run={"impacts": 2},
            )
            diverges = policy == "none" and limit is None
            h = DIVERGING_STEP if diverges else RESET_STEP
            runs[name] = run.replace(run={"method": "exponential", "h": h})
    return runs


class RecipeRecord(TypedDict, total=False):
    """Numbers of gait (b); what a walk that fails early does not have is absent."""

    status: str
    """How eight steps ended."""
    impacts: int
    """Steps made."""
    peak_error: float
    """Largest tracking error [rad]."""
    peak_torque: float
    """[N m]."""
    impact_rate_jump: list[float]
    """By joint: rate after the impact less that of the reference [rad/s]; zero for an invariant gait."""
    certificate: dict[str, float]
    """Of the last step, by name."""
    violations: list[str]
    """Limits of ground and motors that the last step breaks."""
    distance_to_x_star: list[float]
    """x- of the cycle less x*, by component [rad, rad/s]."""
    multipliers: list[float]
    """|lambda|, the largest first."""
    multipliers_change: float
    """Their largest change at half of the step."""
    stable: bool
    """Whether all are below 1."""


@dataclass(frozen=True)
class RecipeResult:
    """What became of gait (b) in one preset under one controller."""

    preset: str
    controller: str
    closes: bool
    """Whether a walking cycle was found."""
    reason: str
    """Why not, in words."""
    record: RecipeRecord
    """The numbers found until then."""
    outcome: Outcome | None = None
    """Of the walk, at two steps; None where it could not be walked."""


def recipe_result(preset: str, controller: str) -> RecipeResult:
    """Walk gait (b) and search its cycle, at two integration steps; whatever comes out is reported.

    A gait that falls, or for which no cycle is found, is a result too: it gives `closes` False, the reason, and
    the numbers found until then, and raises nothing.
    """
    run = stepped(
        Scenario(controller, robot={"preset": preset}, gait="recipe", run={"impacts": 8})
    ).replace(run={"fine": None})
    run = run.replace(run={"engine": COMPILED})
    biped = RobotAndGait.of(run).biped
    record: RecipeRecord = {}
    found = None
    try:
        gait = load_gait("recipe", biped)
        found = execute_twice(run)
        record = {
            "status": found.status,
            "impacts": found.impacts,
            "peak_error": found.peak_error,
            "peak_torque": found.peak_torque,
            "impact_rate_jump": impact_smoothness(gait, biped).tolist(),
        }
        if found.certificates:
            last = found.certificates[-1]
            record |= {"certificate": last.record(), "violations": list(last.violations())}
        cycle = poincare_twice(run.replace(run={"method": None, "h": 1e-3}))
        orbit, n = cycle.orbit, biped.n
        record |= {
            "distance_to_x_star": (orbit.x_minus[: 2 * n] - X_STAR).tolist(),
            "multipliers": abs(orbit.multipliers).tolist(),
            "multipliers_change": cycle.gap,
            "stable": orbit.stable,
        }
    except BipedError as error:
        return RecipeResult(preset, controller, False, str(error), record, found)
    return RecipeResult(preset, controller, True, "", record, found)


def tasks(plan: Plan) -> dict[str, Task[object]]:
    """Everything to compute, by name, the longest first so that no core waits at the end.

    A quick plan leaves out the multipliers of ADRC, which take one walk per coordinate, and the reset policies.
    """
    adrc, npd = (
        Scenario("ADRC", robot={"preset": plan.preset}),
        Scenario("NPD", robot={"preset": plan.preset}),
    )
    pushed = {c: pushed_run(plan, c) for c in CONTROLLERS}
    out: dict[str, Task[object]] = {}
    for c in reversed(CONTROLLERS):
        out[f"headline {c}"] = Task(f"{c} under the push", headline, (pushed[c],))
        out[f"engines {c}"] = Task(f"{c}: the two engines", engines, (pushed[c],))
    if not plan.quick:
        remembering = adrc.replace(controller={"observer": {"reset": "measured"}})
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
        for c in CONTROLLERS:
            name = f"recipe {preset} {c}"
            out[name] = Task(f"gait (b), {preset}, {c}", recipe_result, (preset, c))
    for name, run in base_runs(plan).items():
        out[name] = Task(name, execute_twice, (run,))
    if plan.full:
        out |= map_tasks(plan)
    return out


def map_tasks(plan: Plan) -> dict[str, Task[object]]:
    """The map of pushes: a task for every preset, torque limit [N m] and joint pattern."""
    return {
        f"map {preset}, {limit}, {pattern}": Task(
            f"map of pushes, {preset}, {pattern}",
            push_map,
            (
                Scenario(robot={"preset": preset}),
                pushes(MAP_ONSETS, MAP_AMPLITUDES, (pattern,), (limit,)),
            ),
        )
        for preset in plan.presets
        for limit in (None, 150.0)
        for pattern in PATTERNS
    }
