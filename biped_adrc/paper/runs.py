"""The work of the reproduction: what a worker computes, tasks of a plan by kind and name, and their results.

The walks are those of `paper.scenarios`; most are made at two integration steps. A node is an instant at which
a state is stored; of a walk with very many nodes only those are kept that a figure of merit needs. Tasks have
names such as "multipliers/ADRC" or "cycles/gait (b), tac2003, NPD": the kind, which is a field of `Runs`, and
the key in that field.

    plan             what to compute: presets (sets of masses of the robot RABBIT), pushes, parts left out
    headline run     a walk of 25 impacts with the push of the plan, one under each controller
    NPD, ADRC        the controllers: PD with decoupling of the inertia, and ADRC with an observer (Table I)
    gait (a), (b)    that through the paper's fixed point x*, and that by the recipe of section IV
    Outcome          the numbers of one walk; `half` is the same walk at half of the integration step
    member           one combination of the choices that the paper leaves open
    cycle            a periodic walk: fixed point of the return map from impact to impact; its multipliers are
                     the eigenvalues of the map's derivative
    q_b, q_d         angles of the p joints with motors and their references [rad]
    xi, kappa        total disturbance of the joints [rad/s^2] and input gain: q_b'' = kappa u + xi for the
                     motors' torques u; the observer has m states for xi and its derivatives
    Theta            phase of the gait [rad]
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple, Self

import numpy as np
from scipy.optimize import brentq

from biped_adrc.analysis.half_step import AtTwoSteps
from biped_adrc.analysis.observer.loop import ObserverLoop
from biped_adrc.core.errors import BipedError
from biped_adrc.core.processes import Task
from biped_adrc.core.types import relabelled
from biped_adrc.gait.zero_dynamics import ZeroDynamics, impact_jump
from biped_adrc.gait.zero_orbits import ZeroOrbits
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.paper import scenarios
from biped_adrc.paper.physical_laws import model_laws, numerics_laws, walk_laws
from biped_adrc.paper.poincare import PoincareResult, poincare
from biped_adrc.paper.pushes import MemberOutcome, PushCell, member_outcomes, member_walk, push_map
from biped_adrc.scenario.build import RobotAndGait
from biped_adrc.scenario.recording import Outcome, Walk
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.walk import execute_twice, halved, walk_scenario

BOTH = ("push", "sine", "1 kHz", *(f"heavier, {kind}" for kind in scenarios.HEAVIER), "torso")
"""Names of the walks in which NPD and ADRC are compared: pushed, sampled, with a plant heavier than the
model."""
PRELOADED = ("biped_adrc.paper.runs", "biped_adrc.paper.reproduction", "biped_adrc.engine.batch")
"""Modules that the processes of a reproduction share."""
NODE_DISTANCE = 5e-4
"""Distance of the nodes that are kept of a walk with short steps [s]; without pushes no signal is faster."""


def sparse(walk: Walk, apart: float = NODE_DISTANCE) -> Walk:
    """The walk without the nodes that no figure of merit needs: those kept are at least `apart` [s] apart; in a
    single support in which a push acts and in the one after all are kept.
    """
    run = walk.scenario
    assert run is not None
    pushed = scenarios.pushed_steps(run)
    arcs = (a if a.mode.step in pushed else a.thinned(apart) for a in walk.trajectory.arcs)
    return Walk(walk.walker, walk.gait, replace(walk.trajectory, arcs=tuple(arcs)), run)


def twice(run: Scenario) -> Outcome:
    """The outcome of a walk, with that at half of its integration steps in `half`; both from sparse nodes if
    the walk has very many.
    """
    h = run.run.h
    # None is the default step, which is long: very many nodes are those at most 1e-4 s apart. With a reset at
    # impact that is not by the model the observer has a fast transient after it, for which all nodes are needed
    if h is None or h > 0.2 * NODE_DISTANCE or run.controller.observer.reset != "model":
        return execute_twice(run)
    # `halved` is the scenario with half the integration step, which may be a default that the walker decides
    walk = sparse(walk_scenario(run))
    half = sparse(walk_scenario(halved(run, walk.walker)), 0.5 * NODE_DISTANCE)
    return replace(walk.outcome, half=half.outcome)


class Headline(NamedTuple):
    """A pushed run with its trajectory, from which the figures are drawn."""

    outcome: Outcome
    """Its figures of merit, with those at half of the integration step in `half`, and at a quarter in
    `half.half`."""
    trajectory: Trajectory
    """Its states over time, at the nodes that `sparse` keeps."""
    laws: Mapping[str, float]
    """Violations of physical laws in it, by name (`physical_laws.walk_laws`)."""


def _headline(run: Scenario) -> Headline:
    """Make the headline run of this scenario (25 impacts with a push) at its integration step, at half and at a
    quarter of it; at a quarter only the two single supports from the push on, since only the peak error in them
    is used: so few nodes need no thinning.
    """
    walk = sparse(walk_scenario(run))
    # `halved` is the scenario with half the integration step, which may be a default that the walker decides;
    # late: the values of a walk that begins in the pushed single support, there too on the orbit of its gait
    half, late = halved(run, walk.walker), {"first_step": run.pushes[0].step, "impacts": 2}
    # the half of the half
    quarter = walk_scenario(halved(half, walk.walker).replace(run=late)).outcome
    # with half the integration step nodes are kept at half the distance, so that the outcomes differ as those
    # of all nodes would; walk_laws: violated laws of physics
    at_half = replace(sparse(walk_scenario(half), 0.5 * NODE_DISTANCE).outcome, half=quarter)
    return Headline(replace(walk.outcome, half=at_half), walk.trajectory, walk_laws(walk))


def engines(one: Scenario, other: Scenario) -> float:
    """Largest difference of (q, q') before the impacts of two runs [rad, rad/s], such as on two engines,
    compiled code and Pinocchio; infinite if they have different numbers of impacts, or none.
    """
    a, b = (walk_scenario(run).outcome.x_minus for run in (one, other))
    n = RobotAndGait.of(one).biped.n
    if a.shape != b.shape or len(a) == 0:
        return math.inf
    return float(np.max(np.abs(a - b)[:, : 2 * n]))


# -- cycles, starts and closed forms ---------------------------------------------------------------
def cycle(run: Scenario, with_states: bool) -> PoincareResult | str:
    """A walking cycle at two integration steps, or the reason, in words, why none is found.

    with_states: whether the observer's states belong to the state of the return map; without them the observer
    starts anew after each impact.
    """
    try:
        return poincare(run, with_states)
    except BipedError as error:
        return str(error)


class SlowStart(NamedTuple):
    """A walk that starts on the constraint with a chosen speed after the impact."""

    least: float
    """Least speed after the impact with which the next impact is reached, as a share of the gait's, by one
    quadrature of the zero dynamics [1]."""
    factor: float
    """Speed of this start, as a share of the least [1]."""
    outcomes: dict[str, Outcome]
    """By controller."""


def starts(preset: str) -> list[SlowStart]:
    """Walks of both controllers from just below and just above the least speed that reaches the next impact.

    No controller of the joints helps a start below it, which matters for the paper's word "global stability".
    """
    least, result = least_speed(preset), []
    for k in scenarios.declared()["basin"]["factors"]:
        runs = {c: scenarios.starting(c, preset, k * least) for c in scenarios.CONTROLLERS}
        result.append(SlowStart(least, k, {c: execute_twice(run) for c, run in runs.items()}))
    return result


def least_speed(preset: str) -> float:
    """Least speed after an impact, as a share [1] of the gait's, with which sigma^2 stays positive up to the
    next impact.

    sigma is the angular momentum about the stance foot; after the impact it has to exceed sqrt(2 V_max), where
    V_max is the largest potential in the step of the zero dynamics, the motion with the joints on the gait.
    """
    # the scenario says robot and gait alone here: controller and speed have no effect
    scene = RobotAndGait.of(scenarios.starting("NPD", preset, 1.0))
    orbits = ZeroOrbits.of(ZeroDynamics.of(scene.biped, scene.walked.constraint))
    sigma = scene.biped.angular_momentum(*scene.walked.start(scene.biped))
    return math.sqrt(2.0 * orbits.v_max) / abs(sigma)


def jumps(preset: str) -> dict[str, float]:
    """Largest jumps of signals over the joints, by name.

    "xi_at_impact" and "xi_at_an_edge" [rad/s^2]: of xi of (13), the total disturbance, on gait (a), at an
    impact and when a push of 30 N m on all joints switches on. "published" and "recipe", gaits (a) and (b)
    [rad/s]: of q_b' - q_d' at an impact, 0 for a hybrid-invariant gait. "period" [s] is no jump: the duration
    of a step on gait (a), which a claim on the printed multipliers needs of each preset too.
    """
    # scenarios that say robot and gait, of which no walk is made: the controller has no effect
    walks = {gait: scenarios.loose("NPD", preset, gait=gait) for gait in scenarios.GAITS}
    scenes = {name: RobotAndGait.of(run) for name, run in walks.items()}
    biped, gait = scenes["published"].biped, scenes["published"].walked
    before = biped.reduction(gait.q_minus, gait.v_minus)
    after = biped.reduction(*gait.start(biped))
    # xi before the impact in the order that the joints have after it
    # a torque on the joints enters xi as kappa times it
    xi, edge = after.xi - relabelled(before.xi, biped.swap), after.kappa @ np.full(biped.p, 30.0)
    gaits = {name: of.walked for name, of in scenes.items()}
    # [1]: the jump of the rates; [0] would be that of the angles
    rates = {k: impact_jump(biped, g.constraint, g.q_minus, g.v_minus)[1] for k, g in gaits.items()}
    result = {"xi_at_impact": xi, "xi_at_an_edge": edge, **rates}
    return {name: float(np.max(np.abs(x))) for name, x in result.items()} | {"period": gait.period}


class Order(NamedTuple):
    """Numbers by which observers of different order m are compared."""

    largest_gain: float
    """max |l_k| of the observer (17), each in its own unit [1/s^k]."""
    noise_gain: float
    """Largest gain over all frequencies from an error of the measured angle to the commanded acceleration
    [1/s^2]."""
    bandwidth: float
    """Geometric mean of the poles [rad/s]."""
    delay_margin: float
    """Largest delay in the loop with which it is stable [s]."""
    slow: float
    """Amplitude of the tracking error at 5 Hz per unit of disturbance [s^2]."""
    pushed: AtTwoSteps
    """Peak error under a push of 30 N m on all joints [rad]."""


def orders(preset: str) -> dict[str, Order]:
    """The observer of Table I (m = 7), and two with one extended state (m = 1): of the same bandwidth, and of
    the same delay margin.
    """
    # by default the poles of Table I; `scale` is their geometric mean
    table = GPIObserver.from_poles()
    margin = ObserverLoop(table).delay_margin().delay
    named = {
        "Table I": table,
        "equal bandwidth": GPIObserver.from_bandwidth(table.scale, 1),
        "equal delay margin": GPIObserver.from_bandwidth(bandwidth_with(margin, 1), 1),
    }
    return {name: _order(preset, o) for name, o in named.items()}


def bandwidth_with(margin: float, m: int) -> float:
    """The bandwidth w [rad/s] of an observer with m + 2 poles at -w whose loop has the delay margin `margin`
    [s].
    """

    # log of the delay margin at the bandwidth exp(log_w) over the wanted one: zero at the result
    def excess(log_w: float) -> float:
        result = ObserverLoop(GPIObserver.from_bandwidth(np.exp(log_w), m)).delay_margin().delay
        return float(np.log(result / margin))

    # it lies between 10 and 1e6 rad/s
    return float(np.exp(brentq(excess, np.log(10.0), np.log(1e6))))


def _order(preset: str, observer: GPIObserver) -> Order:
    """The numbers of one observer, from closed forms of its loop, and from a walk on gait (a) with a push on
    all joints, of 30 N m.
    """
    # w: frequencies [rad/s]
    loop, w = ObserverLoop(observer), np.geomspace(1.0, 1e7, 2000)
    poles = tuple(float(np.real(pole)) for pole in observer.poles)  # all are real
    # `on_the_recipe` is a member with this push on gait (b)
    member = scenarios.on_the_recipe(preset)._replace(gait="published")
    return Order(
        float(np.max(np.abs(observer.gains))),
        float(np.max(np.abs(loop.noise(w)))),
        observer.scale,
        loop.delay_margin().delay,
        float(np.abs(loop.tracking_error(np.array([10.0 * np.pi])))[0]),  # 5 Hz
        member_walk(member, "ADRC", **{"controller.observer.poles": poles}).peak,
    )


# -- tasks -----------------------------------------------------------------------------------------
def tasks(plan: scenarios.Plan) -> dict[str, Task[object]]:
    """Everything to compute, by "kind/name", about the longest first so that no core waits at the end."""
    result: dict[str, Task[object]] = {}

    def add(kind: str, name: str, function: Any, *arguments: object) -> None:
        result[f"{kind}/{name}"] = Task(f"{kind} {name}", function, arguments)

    for preset in plan.presets:
        add("members", preset, member_outcomes, scenarios.members(preset))
    for c in reversed(scenarios.CONTROLLERS):  # ADRC takes longer, so it is first
        add("headline", c, _headline, scenarios.pushed_run(plan, c))
        add("engines", c, engines, *scenarios.engine_runs(plan, c))
    add("numerics", plan.preset, numerics_laws, plan.preset)
    for name, run in scenarios.base_runs(plan).items():
        add("runs", name, twice, run)
    for preset in plan.presets:
        add("pushed recipe", preset, member_outcomes, (scenarios.on_the_recipe(preset),))
        add("starts", preset, starts, preset)
        add("jumps", preset, jumps, preset)
        add("model", preset, model_laws, preset)
    for k, part in enumerate(scenarios.map_pushes(plan)):
        add("map", f"{part[0].preset}, part {k}", push_map, part)
    for name, run in scenarios.claim_runs(plan).items():
        add("claim runs", name, twice, run)
    for name, (run, with_states) in scenarios.cycle_runs(plan).items():
        add("cycles", name, cycle, run, with_states)
    for name, run in scenarios.multiplier_runs(plan).items():
        add("multipliers", name, poincare, run)
    add("orders", plan.presets[0], orders, plan.presets[0])
    return result


@dataclass(frozen=True)
class Runs:
    """The results of a reproduction: for each kind of task a dictionary by name."""

    plan: scenarios.Plan
    """The plan that was carried out."""
    headline: Mapping[str, Headline] = field(default_factory=dict)
    """The pushed walks, by controller."""
    runs: Mapping[str, Outcome] = field(default_factory=dict)
    """Walks at two steps, by the names of `scenarios.base_runs`."""
    claim_runs: Mapping[str, Outcome] = field(default_factory=dict)
    """Walks at two steps that only claims need, by the names of `scenarios.claim_runs`."""
    members: Mapping[str, list[MemberOutcome]] = field(default_factory=dict)
    """The push on the joints at all declared choices, by preset."""
    pushed_recipe: Mapping[str, list[MemberOutcome]] = field(default_factory=dict)
    """A push on gait (b), by preset."""
    engines: Mapping[str, float] = field(default_factory=dict)
    """Difference of the engines over the pushed step [rad, rad/s], by controller."""
    multipliers: Mapping[str, PoincareResult] = field(default_factory=dict)
    """Walking cycles with all multipliers, by controller (and reset policy)."""
    cycles: Mapping[str, PoincareResult | str] = field(default_factory=dict)
    """Walking cycles by gait, preset, controller and Theta'', or why there is none."""
    starts: Mapping[str, list[SlowStart]] = field(default_factory=dict)
    """Walks around the least speed, by preset."""
    jumps: Mapping[str, dict[str, float]] = field(default_factory=dict)
    """Jumps of signals, by preset; see `jumps`."""
    orders: Mapping[str, dict[str, Order]] = field(default_factory=dict)
    """Observers of different order, by preset."""
    model: Mapping[str, dict[str, float]] = field(default_factory=dict)
    """Violations of the laws of the model, by preset."""
    map: Mapping[str, list[PushCell]] = field(default_factory=dict)
    """Parts of the map of pushes."""
    numerics: Mapping[str, dict[str, float]] = field(default_factory=dict)
    """Figures of the numerical methods, one entry."""

    @classmethod
    def of(cls, plan: scenarios.Plan, values: Mapping[str, Any]) -> Self:
        """Sort what the tasks of a plan returned into the fields; values: by the names of `tasks`."""
        kinds: dict[str, dict[str, Any]] = {}
        for of, value in values.items():
            kind, _, name = of.partition("/")
            # the kind "claim runs" is the field claim_runs
            kinds.setdefault(kind.replace(" ", "_"), {})[name] = value
        return cls(plan, **kinds)

    @property
    def cells(self) -> list[PushCell]:
        """The pushes of the map with their walks, of all its parts."""
        return [cell for part in self.map.values() for cell in part]

    @property
    def figures(self) -> dict[str, float]:
        """Numbers for the accuracy of the methods, by name with unit, in the order of `numerics_laws`."""
        return {name: x for result in self.numerics.values() for name, x in result.items()}

    def pair(self, name: str) -> tuple[Outcome, Outcome]:
        """The outcomes of a walk under NPD and under ADRC. name: as in `base_runs` or `claim_runs`, without the
        controller at its end; "push" for the headline runs.
        """
        every = {**self.run_twice, **self.claim_runs}
        npd, adrc = (every[f"{name} {c}"] for c in scenarios.CONTROLLERS)
        return npd, adrc

    def pairs(self, *words: str) -> dict[str, tuple[Outcome, Outcome]]:
        """The outcomes (NPD, ADRC) of the walks in `BOTH`, in which the controllers are compared, whose names
        begin with one of these words.
        """
        return {name: self.pair(name) for name in BOTH if name.startswith(words)}

    def named(self, kind: str, *words: str) -> dict[str, Any]:
        """The results in the field `kind` with all of these words in their names, by name."""
        results = getattr(self, kind).items()
        return {name: x for name, x in results if all(word in name for word in words)}

    def on_gait(self, gait: str) -> dict[str, Outcome]:
        """The undisturbed walks on gait "a" or "b", by "gait (.), preset, controller"."""
        # the words with which the names of these walks begin in `scenarios.base_runs`
        word = {"a": "nominal", "b": "gait (b)"}[gait]
        return {
            f"gait ({gait}), {preset}, {c}": self.runs[f"{word} {preset} {c}"]
            for preset in self.plan.presets
            for c in scenarios.CONTROLLERS
        }

    @property
    def run_twice(self) -> dict[str, Outcome]:
        """Every walk that is checked at two integration steps, headline runs included, by name."""
        return {f"push {c}": head.outcome for c, head in self.headline.items()} | dict(self.runs)
