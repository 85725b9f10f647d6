"""The task of a learner, and N walks of it that are moved together, sample by sample: observations, rewards,
ends.

A sample goes from one sample instant of the controller to the next, or to an impact. A task is a scenario, the
meaning of the action, the end of a walk, and the reward.

    reward of a sample = alive + tracking / (1 + |e|^2 / e_1^2) - effort |u|^2 / u_1^2

with the true error e = q_b - h(Theta) [rad] of the joints q_b from the gait h at the phase Theta, and the
torque u [N m] that acts, both at the end of the sample, e_1 = 0.1 rad, and u_1^2 = |u|^2 of all motors at their
limit. The sample in which the walk falls has the reward 0. No reward is negative, as effort is at most alive:
to walk on pays more than to fall, and to track well most.

    observation  (q, q', e, e', u, Theta)       n + n + p + p + p + 1 numbers

q, q' are those that the walk's own controller would measure at this sample instant: by the scenario's sensors
and, where touchdowns are detected, named by the leg that the detector takes for the stance leg. The error e, e'
and Theta follow from them; u [N m] is the torque that has acted. The reward uses the true e and u.

`env.WalkEnv` has one walk, `env.WalkVectorEnv` N; both use a `Stage`, around a `Stepper` that moves the walks,
so that a walk among many is the same as alone, bit for bit.
"""

from dataclasses import dataclass, fields
from typing import Annotated, Any, NamedTuple, Self

import numpy as np

from biped_adrc.closed_loop.instant_signals import Tracked
from biped_adrc.closed_loop.protocols import Loop, Mode
from biped_adrc.closed_loop.semantics import labelled, noticed, parts
from biped_adrc.closed_loop.system import RUNAWAY_RATE
from biped_adrc.control.base import Passive
from biped_adrc.core.checks import Checked, NonNegativeFloat, PositiveFloat, one_of
from biped_adrc.core.errors import InputError
from biped_adrc.core.files import packaged
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, Flags
from biped_adrc.engine.kernels.compiled_run import STATUS
from biped_adrc.hardware.sample_hold import motor_torque
from biped_adrc.model.ground import KnownLimits
from biped_adrc.scenario.build import RIGID, RobotAndGait, limits
from biped_adrc.scenario.dotted import flat, merged, tables
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.stepper import Stepper

_TABLES = packaged("biped_adrc.extras.gym", "conditions.toml")
BASE: dict[str, object] = flat(_TABLES["base"])
"""Values that all conditions share."""
CONDITIONS: dict[str, dict[str, object]] = {
    name: flat({k: x for k, x in table.items() if k != "words"})
    for name, table in _TABLES["conditions"].items()
}
"""Name of a condition -> fields of the scenario, on top of `BASE`."""
OF_RIGID = "errors.impact_width"
"""A field of the scenario that only walks on the rigid plant can have; so can conditions with it."""
TORQUES, ADDED = "torques", "added"
"""Meaning of an action: all of the torque, or an addition to the torque of the scenario's controller."""
_NEAR = 0.1
"""e_1 of the reward [rad]."""
FALLEN_FROM = 1e-9
"""Tolerance of the time limit of a walk [s]: a sample that ends less than this before the limit is the last."""


@dataclass(frozen=True)
class LearnerTask(Checked, Shown):
    """A scenario, the meaning of its action, the time limit and the weights of the reward.

    Raises InputError for an action that does not exist, a time or weight out of range, and fields of the
    scenario that would have no effect.
    """

    scenario: Scenario
    """The scenario; its seed is replaced by that of each walk."""
    action: Annotated[str, one_of((TORQUES, ADDED))] = TORQUES
    """ "torques": the action is the whole torque; "added": it is added to that of the scenario's controller."""
    seconds: PositiveFloat = 10.0
    """Longest walk [s]."""
    alive: NonNegativeFloat = 1.0
    """Reward of a sample that does not end the walk [1]."""
    tracking: NonNegativeFloat = 1.0
    """Reward of a sample without tracking error [1]."""
    effort: NonNegativeFloat = 0.1
    """Cost of a sample with all motors at their limit [1], at most `alive`."""

    def __post_init__(self) -> None:
        """Raise InputError for values that do not fit together; see the class."""
        if self.effort > self.alive:
            raise InputError(
                f"effort = {self.effort} is above alive = {self.alive}: to fall would pay"
            )
        # mine: values of the controller that the scenario sets
        mine = flat({"controller": self.scenario.controller.record()})
        # TORQUES: the action is all of the torque
        if self.action == TORQUES and mine:
            raise InputError(
                f"{', '.join(mine)} would do nothing where the action is all of the torque; leave it out, or "
                "take action = 'added'"
            )

    @classmethod
    def of(cls, scenario: Scenario | None, condition: str | None, **values: Any) -> Self:
        """Make the task of a scenario, or of a condition by name, "nothing" if both are None.

        A condition has the fields of `BASE` and of its own in conditions.toml. values: further fields of task
        and scenario, by name. Raises InputError for a condition that this plant does not have, for a scenario
        and a condition together, and for values that a scenario does not take.
        """
        # how: fields of the task; record: those of the scenario; tables: nested tables of dotted names; merged:
        # such tables, overridden by others
        if scenario is not None and condition is not None:
            raise InputError("a scenario and a condition were given, expected one of them")
        how = {f.name: values.pop(f.name) for f in fields(cls) if f.name in values}
        record = tables(values)
        if scenario is not None:
            return cls(scenario.replace(record), **how)
        ground = record.get("ground", RIGID)
        plant = ground if isinstance(ground, str) else ground.get("plant", RIGID)
        # there: the conditions that a walk on this plant can have; those that set OF_RIGID need the rigid one
        there = [name for name, x in CONDITIONS.items() if plant == RIGID or OF_RIGID not in x]
        name = condition or "nothing"
        if name not in there:
            raise InputError(
                f"there is no condition {name!r} on plant '{plant}', expected one of {there}"
            )
        return cls(Scenario(**merged(tables({**BASE, **CONDITIONS[name]}), record)), **how)

    def limits(self, scene: RobotAndGait) -> KnownLimits:
        """Limits of ground and motors on the robot of `scene`; the torque limit is the scenario's if lower."""
        known = limits(self.scenario).of(scene.biped.description)
        limit = self.scenario.hardware.torque_limit
        return known if limit is None else known._replace(torque=min(limit, known.torque))


TURNS = 4.0 * np.pi
"""Largest angle of an observation [rad], two turns."""
_NAMES = np.array(["walks", *(x.name.lower().replace("_", " ") for x in STATUS[1:])], dtype=object)
"""Text of each status, by its code."""


class Stage:
    """N walks of one task. Raises InputError for a task that cannot be walked.

    count: N. drawn: whether to follow the places of the stance feet, for pictures. Attributes:

    - first: index in a row of `view` of (t, step), which stand behind (q, q', e, e', u).
    - highest, lowest (first + 1,): bounds of an observation. cost: effort / u_1^2 [1/(N m)^2].
    - needs (N, 4), over the finished single supports of each walk: 1 where all are feasible, else 0; largest
      |F_T| / F_N and least F_N [N] of the ground force's mean over a window; largest torque [N m].
    - feet (N, 2): places (x, z) of the stance feet [m], and steps (N,) their single supports, if `drawn`.
    """

    def __init__(self, task: LearnerTask, count: int, drawn: bool = False):
        """Build the stepper, and the bounds of an observation; see the class."""
        self.task, self.limits = task, task.limits(RobotAndGait.of(task.scenario))
        values: dict[str, object] = {"hardware.torque_limit": self.limits.torque}
        if task.action == TORQUES:
            # a controller without torque, to which the action is added
            values["controller"] = f"{Passive.__module__}:{Passive.__name__}"
        self.stepper = Stepper(task.scenario.replace(values), count, limits(task.scenario))
        self.scene = self.stepper.scene
        self.plant, self.phase = self.scene.biped, self.scene.walked.constraint.phase
        n, p = self.plant.n, self.plant.p
        self.first = 2 * n + 3 * p
        self.cost = task.effort / (p * self.limits.torque**2)
        # a run ends as RAN_AWAY above the rate v, so no observation can be higher; RUNAWAY_RATE [rad/s]: the
        # rate of which `runaway_speed` is a multiple
        v = np.full(n, task.scenario.run.runaway_speed * RUNAWAY_RATE)
        # bounds of q (TURNS), q', e and e'; e is a difference of two angles
        measured = np.full(n, TURNS), v, np.full(p, 2.0 * TURNS), 2.0 * v[:p]
        self.highest = np.concatenate((*measured, np.full(p, self.limits.torque), [2.0 * TURNS]))
        # 4: feasible, friction, normal force and torque, see the class
        self.lowest, self.needs = -self.highest, np.zeros((count, 4))
        self.seeds, self._seen = np.zeros(count, dtype=np.int64), np.zeros(0)
        self.drawn, self.feet, self.steps = drawn, np.zeros((count, 2)), np.zeros(count)
        # a task that cannot be walked raises here; with the code -1 no walk goes on until `begin` is called for
        # it
        self.begin(0, self.task.scenario.run.seed)
        self.stepper.walks.codes[:] = -1

    def begin(self, i: int, seed: int) -> None:
        """Begin walk i anew with this seed of its scenario, with the stance foot at the origin."""
        # an empty `_seen` lets `view` be computed anew
        self.stepper.reset(i, seed)
        self.seeds[i], self._seen = seed, np.zeros(0)
        # neutral, as each single support can only make them worse
        self.needs[i] = 1.0, 0.0, np.inf, 0.0
        self.feet[i], self.steps[i] = 0.0, 0.0

    def move(self, actions: Array) -> None:
        """Walk one sample of all walks that have not fallen, under actions (N, p), shares of the torque limit
        [1].
        """
        # the last two inputs are a force from outside, which stays zero
        np.multiply(actions, self.limits.torque, out=self.stepper.walks.inputs[:, :-2])
        self.stepper.move()
        self._seen = np.zeros(0)  # so that `view` is computed anew
        for i, support in self.stepper.over:  # single supports that have ended in this sample
            feasible, friction, normal, torque = self.needs[i]
            self.needs[i] = (
                feasible * (not support.infeasible()),
                max(friction, support.mean_friction),
                min(normal, support.mean_normal_force),
                max(torque, support.peak_torque),
            )

    # -- where they are ----------------------------------------------------------------------------
    @property
    def view(self) -> Array:
        """The numbers of `LearnerView` of each walk, one after the other in N rows, computed once per sample.

        At a touchdown the place of the new stance foot follows: the old one is now the swing foot, whose place
        relative to the new one is known.
        """
        if not self._seen.size:  # not yet computed for this sample
            self._seen = self.stepper.read(learner_view)
            step = self._seen[:, self.first + 1]
            if self.drawn and (changed := self.steps != step).any():
                # steps is 0 for a walk that has just begun, whose foot is at the origin
                for i in np.flatnonzero(changed & (self.steps > 0.0)):
                    self.feet[i] -= self.plant.swing_foot(self._seen[i, : self.plant.n])
                self.steps = step.copy()
        return self._seen

    def observations(self) -> Array:
        """Observations (N, first + 1) = (q, q', e, e', u, Theta) of each walk, limited to their bounds."""
        view = self.view
        result = view[:, : self.first + 1].copy()
        # Theta = phase' q replaces the time, the last column that was copied
        result[:, -1] = np.vecdot(view[:, : self.plant.n], self.phase)
        return np.minimum(np.maximum(result, self.lowest, out=result), self.highest, out=result)

    def rewards(self) -> Array:
        """Rewards (N,) [1] of the last sample; 0 for a walk that has fallen."""
        # `paid`, the last two columns of the view: 1 / (1 + |e|^2 / e_1^2), and |u|^2
        close, u = self.view[:, self.first + 2 :].T
        paid = self.task.alive + self.task.tracking * close - self.cost * u
        return np.where(self.stepper.walks.codes == 0, paid, 0.0)

    def ended(self) -> tuple[Flags, Flags]:
        """Whether each walk has fallen or diverged (N,), and whether it has reached its time or number of
        impacts without that (N,).
        """
        run, view = self.task.scenario.run, self.view
        fallen = self.stepper.walks.codes != 0
        # FALLEN_FROM is for the round-off of times
        late = view[:, self.first] >= self.task.seconds - FALLEN_FROM
        late |= view[:, self.first + 1] >= run.first_step + run.impacts
        return fallen, late > fallen  # of truth values: late and not fallen

    def infos(self) -> dict[str, Any]:
        """Further numbers of each walk by name, (N,) each: time t [s], number of the single support, seed,
        `needs` (feasible, friction [1], normal_force [N], peak_torque [N m]), and text of the status.
        """
        at, rows = self.view[:, self.first :], self.needs.T.copy()
        # _NAMES: text of each status, by its code
        return {
            "t": at[:, 0].copy(),
            "step": at[:, 1].astype(np.int64),
            "seed": self.seeds.copy(),
            "feasible": rows[0] > 0.0,
            "friction": rows[1],
            "normal_force": rows[2],
            "peak_torque": rows[3],
            "status": _NAMES[self.stepper.walks.codes],
        }


class LearnerView(NamedTuple):
    """Numbers of a walk at one sample instant from which observation and reward follow; n coordinates, p
    motors.
    """

    q: Array
    """Angles (n,) as measured [rad]."""
    v: Array
    """Rates (n,) as measured [rad/s]."""
    e: Array
    """Error q_b - q_d (p,) of the measured joints q_b from the gait's reference q_d [rad]."""
    de: Array
    """Its rate (p,) [rad/s]."""
    u: Array
    """Torque (p,) that has acted until this instant [N m]."""
    at: Array
    """Time [s], and number of the single support, (2,)."""
    paid: Array
    """1 / (1 + |e|^2 / e_1^2) of the true state [1], and |u|^2 [N^2 m^2], (2,)."""


def learner_view(loop: Loop, t: float, x: Array, mode: Mode, reference: Tracked) -> LearnerView:
    """Compute the `LearnerView` of a state x (nx,) at a sample instant t [s], before the controller has acted.

    The same lines run in Python and compiled. reference(s, m): the point (q_d, dq_d) of the gait at a
    measurement m, s the controller's state. Where touchdowns are detected, `noticed` decides what is measured,
    and the torques u are named by the legs as the detector takes them.
    """
    (q, v, s, tail), k, p = parts(loop, x), loop.held, loop.plant.p
    assert k is not None
    true = loop.measure(t, q, v, mode)
    if k.touchdown is not None:
        # state: the measurement; b: what the detector believes about the legs and the single support; line: the
        # torques on their way to the motors, by the detector's names of the legs
        state, _, _, b = noticed(loop, k, t, s, tail, q, v, mode)
        line = labelled(loop, b, tail.line)
    else:
        q_seen, v_seen = k.reading(k.sense(tail.sensors, q, v), q, v)
        state, line = true._replace(q=q_seen, v=v_seen), tail.line
    # motor_torque: of the torques in a line the one that acts; e, u: the true ones
    r, e, u = reference(s, state), q[:p] - reference(s, true).q_d, motor_torque(tail.line)
    # at: time and single support; paid: the reward's 1 / (1 + |e|^2 / e_1^2), e_1 = _NEAR, and |u|^2
    return LearnerView(
        q=state.q,
        v=state.v,
        e=state.q[:p] - r.q_d,
        de=state.v[:p] - r.dq_d,
        u=motor_torque(line),
        at=np.array([t, mode.step]),
        paid=np.array([1.0 / (1.0 + e @ e / _NEAR**2), u @ u]),
    )
