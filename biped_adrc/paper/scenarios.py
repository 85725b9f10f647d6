"""Every walk of the reproduction as a scenario, by name; what the paper leaves open is in admissible.toml.

The paper prints no push amplitude, no masses and no start of the observer. A claim that was tried at one choice
could be an accident of it, and at choices picked afterwards it would prove nothing. admissible.toml declares
levels of seven choices, and takes 36 of their 648 combinations (`Member`), an orthogonal array of strength 2:
any two choices meet in all pairs of levels equally often, so that no effect hides behind another one.

    plan             what a user asks of the reproduction: presets, the push of the headline runs, and whether
                     it is full (the whole map of many pushes) or quick (a first look)
    headline runs    walks of 25 impacts with the push of the plan, one under each controller
    NPD, ADRC        the controllers: PD with decoupling of the inertia, and ADRC with an observer
    preset           a set of masses and inertias of the robot RABBIT, whose motors are at q1 to q4
    x*               the paper's fixed point: (q, q') just before an impact of its periodic walk
    gait (a), (b)    that through x*, and that by the recipe of section IV; without a word on it, gait (a)
    Theta''          second derivative of the gait's phase, a term of the paper's law (20): "solved" from the
                     dynamics, or left out as (20) is "printed"
    xi, xi^          total disturbance of the joints [rad/s^2], and the observer's estimate of it
    values           of a function: values of a scenario by their dotted names, which replace its own

Integration steps are such that halving them changes no figure of merit by more than 1 % (`paper.metrics`).
"""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

from biped_adrc.core.errors import InputError
from biped_adrc.core.files import packaged
from biped_adrc.engine.run import PINOCCHIO
from biped_adrc.scenario.push import Push
from biped_adrc.scenario.scenario import Scenario

CONTROLLERS = ("NPD", "ADRC")
"""The two that the paper compares, in the order of every pair: PD with inertia decoupling, and ADRC."""
SOLVED, RESET = "controller.solve_theta", "controller.observer.reset"
"""Names in a scenario of two choices: Theta'' in (20), and what becomes of the observer at an impact."""
EIGHT = {"impacts": 8}
"""Values of `run` for a walk of eight impacts, which are four steps in the paper's count."""
GAITS = ("published", "recipe")
"""Gait (a), through x*, and gait (b), by the recipe of section IV."""
MOTORS = ("q1", "q2", "q3", "q4")
"""The actuated joints."""


def declared() -> dict[str, Any]:
    """The tables of admissible.toml, by name."""
    return packaged("biped_adrc.paper", "admissible.toml")


PAPER_PUSH, SINE = (Push(**declared()["pushes"][name]) for name in ("paper", "sine"))
"""The push of figures 4 to 6, and a sine."""
HEAVIER: dict[str, dict[str, Any]] = declared()["heavier"]
"""Plants that are heavier than the model, by name: values of `errors` of a scenario."""
_STEPS = {"NPD": (5e-4, 1e-4), "ADRC": (5e-5, 2.5e-5)}
"""Steps of RK4 [s]: for the whole walk, and for single supports with the edge of a push and the next ones."""
LOOSE = 2e-4
"""Integration step of the exponential method under ADRC [s], for walks of which no spike of the tracking error
below 1e-5 rad has to be resolved."""
COARSE = 1e-3
"""Integration step [s] of walks of which only endings and durations of walking steps are used."""


@dataclass(frozen=True)
class Plan:
    """The parts of the paper that a reproduction computes. Raises InputError for `full` with `quick`."""

    preset: str = "identified"
    """Preset of RABBIT for the headline runs."""
    pushes: tuple[Push, ...] = (PAPER_PUSH,)
    """The pushes of the headline runs."""
    full: bool = False
    """The whole map of pushes, which takes minutes."""
    quick: bool = False
    """A first look, without what `left_out` names."""

    def __post_init__(self) -> None:
        if self.full and self.quick:
            raise InputError("'full' and 'quick' exclude one another; choose one of them")

    @property
    def presets(self) -> tuple[str, ...]:
        """The presets in which walks are made: all three, or the headline's alone in a quick plan."""
        return (self.preset,) if self.quick else ("identified", "identified-bare", "tac2003")

    @property
    def left_out(self) -> tuple[str, ...]:
        """Texts from claims.toml on the parts that this plan does not compute; none for a full plan."""
        if self.full:
            return ()
        kind = "quick" if self.quick else "usual"
        words = packaged("biped_adrc.paper", "claims.toml")["left_out"][kind]
        return tuple(x.format(preset=self.preset) for x in words)


def on_torso(torque: float) -> Push:
    """A push on the torso, which no motor drives, with this torque [N m] for 0.2 s in single support 19
    (a table of admissible.toml)."""
    return Push(torque=torque, **declared()["torso"]["push"])


def scenario(controller: str, preset: str, **values: Any) -> Scenario:
    """A scenario of RABBIT in a preset under a controller; all scenarios of the reproduction are made here."""
    return Scenario(controller, **{"robot.preset": preset, **values})


def pushed_steps(run: Scenario) -> set[int]:
    """Numbers, from 1, of the single supports in which a push acts, and of those after them."""
    return {push.step + k for push in run.pushes for k in (0, 1)}


def by_rk4(controller: str, preset: str, **values: Any) -> Scenario:
    """A walk with RK4, at the integration step that its controller needs away from pushes: 0.5 ms under NPD,
    0.05 ms under ADRC. values: replace these.
    """
    h = _STEPS[controller][0]  # [1] is the fine one around pushes
    return scenario(controller, preset, **{"run.method": "rk4", "run.h": h, **values})


def loose(controller: str, preset: str, h: float = LOOSE, **values: Any) -> Scenario:
    """A walk that may be integrated less finely, as no spike of the tracking error below 1e-5 rad has to be
    resolved: under ADRC by the exponential method with an integration step of h [s]; under NPD, on which h has
    no effect, by RK4 at 0.5 ms.
    """
    if controller == "ADRC":
        values |= {"run.method": "exponential", "run.h": h}
    return by_rk4(controller, preset, **values)


def pushed_run(plan: Plan, controller: str) -> Scenario:
    """The headline run of a controller: gait (a) under the plan's pushes, integrated finely around them."""
    # of the single supports in which a push switches, and of those after them
    fine = _STEPS[controller][1]  # [0] is the usual one
    return by_rk4(controller, plan.preset, pushes=plan.pushes, run={"fine": fine})


def engine_runs(plan: Plan, controller: str) -> tuple[Scenario, Scenario]:
    """The pushed single support of the headline run on Pinocchio's dynamics, and on the compiled engine, at the
    same integration step.
    """
    # a walk that begins in the pushed single support begins on the orbit of its gait
    first, h = plan.pushes[0].step, declared()["walks"]["engines_step"]
    run = {"first_step": first, "impacts": 1, "h": h}
    one = scenario(controller, plan.preset, pushes=plan.pushes, run=run)
    return one.replace({"run.engine": PINOCCHIO}), one


def base_runs(plan: Plan) -> dict[str, Scenario]:
    """The walks that are checked at half of their integration step, by name; the controller ends the name.

    Undisturbed walks in every preset on both gaits; the push with slow edges; a sine; a push on the torso;
    sampled control at 1 kHz; a plant that is heavier than the model; (20) as printed, and every policy for the
    observer at an impact. A walk that begins in a later single support than the first, to be shorter, begins on
    the orbit too.
    """
    # EIGHT: walks of eight impacts and not of 25; SOLVED: whether Theta'' is solved for, and not left out
    runs: dict[str, Scenario] = {}
    # pushes with edges of 10 ms in place of vertical ones
    rising = tuple(push.replace(rise=declared()["walks"]["rise"]) for push in plan.pushes)
    first = min(push.step for push in plan.pushes)
    for c in CONTROLLERS:
        # [1]: the integration step [s] around the edges of a push
        p, fine = plan.preset, _STEPS[c][1]
        for preset in plan.presets:
            runs[f"nominal {preset} {c}"] = by_rk4(c, preset)
            runs[f"gait (b) {preset} {c}"] = loose(c, preset, gait="recipe", run=EIGHT)
        rises = {"first_step": first, "impacts": 2, "fine": fine}
        runs[f"rising push {c}"] = by_rk4(c, p, pushes=rising, run=rises)
        late = {"first_step": declared()["torso"]["first_step"], "impacts": 9}
        runs[f"sine {c}"] = by_rk4(c, p, pushes=(SINE,), run={**late, "fine": fine})
        runs[f"torso {c}"] = loose(c, p, pushes=(on_torso(20.0),), run=late)
        sampled: dict[str, Any] = {"hardware.period": 1e-3, "run.h": 1e-3}
        runs[f"1 kHz {c}"] = scenario(c, p, pushes=plan.pushes, **sampled)
        # HEAVIER: by name the errors of a plant that is heavier than the model
        for kind, factors in HEAVIER.items():
            runs[f"heavier, {kind} {c}"] = loose(c, p, run=EIGHT, errors=factors)
        if not plan.quick:
            runs[f"as printed {c}"] = loose(c, p, run=EIGHT, **{SOLVED: False})
    return runs | ({} if plan.quick else reset_runs(plan.preset))


def reset_runs(preset: str) -> dict[str, Scenario]:
    """Every policy for the observer's states at an impact, with and without RABBIT's torque limit.

    An observer that does not expect the impact asks for torques that no motor gives.
    """
    runs, k = {}, declared()["walks"]
    # the walk without reset and torque limit, which diverges 1.2 ms after the impact, has a step of its own
    for policy, limit in itertools.product(k["resets"], (None, 150.0)):
        h = k["diverging_step" if policy == "none" and limit is None else "reset_step"]
        name = f"reset {policy}, {'unlimited' if limit is None else '150 N m'}"
        values: dict[str, Any] = {RESET: policy, "hardware.torque_limit": limit, "run.impacts": 2}
        runs[name] = loose("ADRC", preset, h, **values)
    return runs


def claim_runs(plan: Plan) -> dict[str, Scenario]:
    """Walks of the claims alone: pushes on the torso by amplitude, and the heavier plant in other presets."""
    runs, step = {}, declared()["push"]["step"]
    for preset, c in itertools.product(plan.presets, CONTROLLERS):
        for torque in declared()["torso"]["amplitudes"]:
            late = {"first_step": step, "impacts": 4}
            # only endings and durations of these are used: their integration step, also NPD's, is COARSE,
            # longer than that of `loose`, by which small errors need not be resolved either
            run = loose(c, preset, pushes=(on_torso(torque),), run=late).replace({"run.h": COARSE})
            runs[f"{torque:g} N m on the torso, {preset} {c}"] = run
        # in the plan's own preset the heavier plant is in `base_runs`
        for kind, factors in HEAVIER.items() if preset != plan.preset else ():
            runs[f"heavier, {kind}, {preset} {c}"] = loose(c, preset, run=EIGHT, errors=factors)
    return runs


def cycle_runs(plan: Plan) -> dict[str, tuple[Scenario, bool]]:
    """The scenarios whose cycles (periodic walks) are looked for, by name, each with whether the observer's
    states are coordinates of the return map.

    Gait (b) with them; gait (a) without them, with Theta'' in (20) solved for and as printed.
    """
    result = {}
    for preset, c in itertools.product(plan.presets, CONTROLLERS):
        result[f"gait (b), {preset}, {c}"] = (scenario(c, preset, gait="recipe"), True)
        for theta in declared()["factors"]["theta"]:  # "solved", "printed"
            run = scenario(c, preset, **{SOLVED: theta == "solved"})
            result[f"gait (a), {preset}, {c}, Theta'' {theta}"] = (run, False)
    return result


def multiplier_runs(plan: Plan) -> dict[str, Scenario]:
    """The periodic walks of which all multipliers (eigenvalues of the return map's derivative) are computed, by
    controller; "ADRC measured" resets the observer's states at impact by the measurement, not by the model.
    """
    npd, adrc = (scenario(c, plan.preset) for c in CONTROLLERS)
    if plan.quick:
        return {"NPD": npd}
    return {"NPD": npd, "ADRC": adrc, "ADRC measured": adrc.replace({RESET: "measured"})}


def starting(controller: str, preset: str, speed: float) -> Scenario:
    """A walk of three impacts that starts after an impact of gait (a) with `speed` [1] times its rates."""
    # in a scenario `speed` is the share that is added to the rates; loose: with the long integration step
    # COARSE, 1 ms, since only endings and durations of steps are read
    return loose(controller, preset, COARSE, start={"speed": speed - 1.0}, run={"impacts": 3})


class Member(NamedTuple):
    """One combination of the choices that the paper leaves open."""

    preset: str
    """Preset of RABBIT."""
    amplitude: float
    """Torque of the push [N m]."""
    onset: float
    """Time from the impact to the push [s]."""
    joints: tuple[str, ...]
    """Joints on which the push acts."""
    rise: float
    """Time in which the push rises and falls [s]."""
    start: str
    """How the observer starts: "model" (xi^ from the model) or "zero"."""
    theta: str
    """Theta'' in (20): "solved" from the dynamics, or as "printed"."""
    gait: str = "published"
    """One of `GAITS`."""

    @property
    def name(self) -> str:
        """Name of the member for a reader."""
        gait = "" if self.gait == "published" else f"gait '{self.gait}', "
        return (
            f"{gait}{self.preset}, {self.amplitude:g} N m on {'+'.join(self.joints)} from "
            f"{self.onset:g} s, rise {1e3 * self.rise:g} ms, xi^ {self.start}, Theta'' {self.theta}"
        )

    def run(self, controller: str, pushed: bool = True, **values: Any) -> Scenario:
        """The walk from the pushed single support on, or this one alone without the push (pushed = False).

        Its integration step run.h is that of the pushed single support. Where the observer starts from zero,
        its estimate of xi is kept at impacts, since the model is not to help it. values: of the scenario, which
        replace these.
        """
        # k: single support and duration of the push; steps: integration steps and number of impacts
        k, steps, joints = declared()["push"], declared()["steps"], ",".join(self.joints)
        push = Push(joints=joints, torque=self.amplitude, onset=self.onset, rise=self.rise, **k)
        zero = self.start == "zero" and controller == "ADRC"
        usual: dict[str, Any] = {
            "gait": self.gait,
            "pushes": (push,) if pushed else (),
            "run.first_step": push.step,
            "run.impacts": steps["impacts"] if pushed else 1,
            # SOLVED, RESET: names of the values for Theta'' in (20), and for the observer at an impact
            SOLVED: self.theta == "solved",
            RESET: "measured" if zero else "model",
            "run.h": steps[controller],
        }
        return by_rk4(controller, self.preset, **usual | values)


def members(preset: str | None = None) -> tuple[Member, ...]:
    """The combinations that admissible.toml declares, of all presets if None, always in the same order."""
    factors, fraction = declared()["factors"], declared()["fraction"]
    result = []
    # i, j choose the levels of choices with three of them, k, m those of choices with two: `_levels` gives the
    # number of the level of each choice by name, `factors` has the levels themselves
    for i, j, k, m in itertools.product(*map(range, (3, 3, 2, 2))):
        at = _levels(fraction["three_levels"], i, j, 3) | _levels(fraction["two_levels"], k, m, 2)
        chosen = {name: factors[name][level] for name, level in at.items()}
        result.append(Member(**(chosen | {"joints": tuple(chosen["joints"])})))
    return tuple(m for m in result if preset in (None, m.preset))


def _levels(rule: dict[str, list[int]], i: int, j: int, count: int) -> dict[str, int]:
    """Level of each choice at (i, j), by its name: a i + b j modulo `count`, the number of levels. With the (a,
    b) of `rule` any two choices meet in all pairs of levels equally often.
    """
    return {name: (a * i + b * j) % count for name, (a, b) in rule.items()}


def on_the_recipe(preset: str) -> Member:
    """Gait (b) under a push of 30 N m on all joints, 0.12 s after the impact, with vertical edges."""
    # 0.0: rise of the push [s]; "model": the observer starts with xi of the model; "solved": Theta'' in (20)
    return Member(preset, 30.0, 0.12, MOTORS, 0.0, "model", "solved", "recipe")


class MapPush(NamedTuple):
    """One push of the map."""

    preset: str
    """Preset of RABBIT."""
    onset: float
    """Time from the impact to the push [s]."""
    amplitude: float
    """Largest torque of the push [N m]."""
    pattern: str
    """Name of its factors by joint, in admissible.toml."""
    torque_limit: float | None
    """Limit of every motor [N m]; None for no limit."""

    def run(self, controller: str) -> Scenario:
        """The walk: four impacts from single support 19 on, in which the push acts for 0.2 s. The reference is
        continued past the ends of its range of Theta, so that a fall is the robot's and not due to a
        polynomial, which grows steeply there.
        """
        # patterns: factor 1, -1 or 0 of each motor; single support 19 is in the 10th of the paper's steps
        signs = zip(MOTORS, declared()["map"]["patterns"][self.pattern], strict=True)
        torque = {joint: self.amplitude * sign for joint, sign in signs if sign}
        push = Push(torque=torque, step=19, onset=self.onset, duration=0.2)
        run = {"first_step": 19, "impacts": 4, "h": 1e-3}
        more: dict[str, Any] = {"hardware.torque_limit": self.torque_limit, "gait.continued": True}
        return scenario(controller, self.preset, pushes=(push,), run=run, **more)


def map_pushes(plan: Plan) -> Iterator[list[MapPush]]:
    """Iterate over the pushes of the map in parts, each a task: one for each preset, torque limit [N m] and
    pattern of signs.

    A plan that is not full has only pushes at 0.3 s with 150 N m, under a torque limit of 150 N m, and one part
    for all patterns.
    """
    limits = (None, 150.0) if plan.full else (150.0,)
    k, patterns = declared()["map"], [*declared()["map"]["patterns"]]
    onsets, amplitudes = (k["onsets"], k["amplitudes"]) if plan.full else ((0.3,), (150.0,))
    parts = [[of] for of in patterns] if plan.full else [patterns]
    for preset, limit, part in itertools.product(plan.presets, limits, parts):
        every = itertools.product(part, amplitudes, onsets)
        yield [MapPush(preset, onset, amplitude, of, limit) for of, amplitude, onset in every]
