"""How far walks by an exported controller and by Python come apart: the proof in closed loop.

    e_k = sum over calls i < k of Phi(k, i) delta_i      states of two walks at node k, to first order
    max_k |e_k|  <=  10 max_k |a_k|                      for each of q_1 .. q_n, v_1 .. v_n

delta_i is what the exported controller makes of call i beside Python: rounding. Phi carries it on, through
the robot, its impacts and the controller's own state. a_k is the amplification: the same sum for delta_i by
one unit in the last place (ulp) of all that call i is given. It is the largest of some walks in Python that
begin one ulp aside and in which every call is given such inputs. Both sums have the same Phi, so what
`deploy.rounding` proves of one call, that it differs by no more than some ulps of its inputs would do, is
proved of a walk.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.base import Controller, Measurement
from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.loaded import ExportedController, Loaded
from biped_adrc.deploy.records import NONE, RecordedCall, recorded
from biped_adrc.deploy.rounding import Given, PythonComputer, by_one_ulp, nudged
from biped_adrc.engine.simulate import run_compiled
from biped_adrc.errors import InputError
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.types import Array

STEP = 5e-4
"""Of the method in all walks [s]."""
TIMES = 10.0
"""Most that an exported controller may differ by, in what one ulp of its inputs does."""


@dataclass(frozen=True)
class PythonController(Controller):
    """What the exported controller computes, in Python: the mirror of `ExportedController`.

    Its state s is (start, last, step, x_c, u). With a seed every call is given inputs that are wrong by
    one ulp, up or down at random by the seed and the time of the call.
    """

    python: PythonComputer
    seed: int | None = None

    def initial_state(self, m: Measurement) -> Array:
        return self._called("init", m, Mode(1, m.t), m.t, NONE, np.zeros(self._p))

    def correct(self, s: Array, m: Measurement) -> Array:
        start, last, step, x, u = self._parts(s)
        return self._called("step", m, Mode(step, start), last, x, u)

    def output(self, s: Array, m: Measurement) -> Array:
        return s[len(s) - self._p :]

    def jump(self, s: Array, after: Measurement, swap: Array) -> Array:
        _, last, step, x, u = self._parts(s)
        return self._called("touchdown", after, Mode(step + 1, after.t), last, x, u[swap])

    def continuous(self) -> Controller:
        raise InputError("it acts at sample instants; give timing=SampledTime(period)")

    @property
    def _p(self) -> int:
        return self.python.computer.held.sizes.p

    def _parts(self, s: Array) -> tuple[float, float, int, Array, Array]:
        """start, last [s], number of the single support, x_c, and the torque sent last (p,) [N m]."""
        end = len(s) - self._p
        return s[0], s[1], round(s[2]), s[3:end], s[end:]

    def _called(
        self, kind: str, m: Measurement, mode: Mode, last: float, x: Array, u: Array
    ) -> Array:
        """s after a call; the torque is u (p,) [N m] unless the call makes one."""
        given = Given(RecordedCall(kind, m.t, m.q, m.v, NONE, NONE), mode, last, x)
        if self.seed is not None:
            bits = int(np.float64(m.t).view(np.uint64))
            given = nudged(given, np.random.default_rng((self.seed, bits, len(kind))))
        made = self.python(given)
        last = last if kind == "touchdown" else m.t
        sent = made.u if kind == "step" else u
        return np.concatenate(((mode.start, last, mode.step), made.x, sent))


class Apart(NamedTuple):
    """Walks by an exported controller and by Python, from one start."""

    same_end: bool
    """Whether their statuses and impacts are the same."""
    difference: float
    """Largest of any angle [rad] or rate [rad/s]."""
    amplification: float
    """The same by one ulp of all inputs of every call."""
    worst: float
    """Largest ratio of both, over the angles and rates."""
    run: Trajectory
    """The walk by Python."""

    @property
    def proved(self) -> bool:
        """Whether the walk is the same but for rounding."""
        return self.same_end and self.worst <= TIMES


def apart(
    computer: Computer,
    loaded: Loaded,
    begin: tuple[Array, Array],
    options: RunOptions,
    walks: int = 3,
) -> Apart:
    """How far walks come apart from (q, v), each (n,).

    walks: in Python with ulps, at least 1. Of one alone the random ulps may cancel. A walk that Python
    loses, as its torque runs away, is lost by the exported controller with the same status.
    """
    python, walker = PythonComputer(computer), computer.walker
    base = walk(walker, PythonController(python), begin, options)
    exported = walk(walker, ExportedController(loaded), begin, options)
    off, by_ulp = _largest(base, exported, walker), np.zeros(2 * walker.plant.n)
    for seed in range(walks):
        random = np.random.default_rng(seed)
        aside = by_one_ulp(begin[0], random), by_one_ulp(begin[1], random)
        run = walk(walker, PythonController(python, seed), aside, options)
        by_ulp = np.maximum(by_ulp, _largest(base, run, walker))
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(off > 0.0, off / by_ulp, 0.0)
    return Apart(
        exported.status is base.status and len(exported.arcs) == len(base.arcs),
        float(np.max(off)),
        float(np.max(by_ulp)),
        float(np.max(ratio)),
        base,
    )


def python_calls(computer: Computer, run: Trajectory) -> list[RecordedCall]:
    """The calls of a walk by Python, in which every call goes on from the state of the one before."""
    walker = replace(computer.walker, controller=PythonController(PythonComputer(computer)))
    return [call._replace(s=NONE) for call in recorded(walker, run)]


def walk(
    walker: Walker, controller: Controller, begin: tuple[Array, Array], options: RunOptions
) -> Trajectory:
    """The walk of a walker with another controller, from (q, v), each (n,), at options.t0 [s]."""
    w, mode = replace(walker, controller=controller), Mode(1, options.t0)
    return run_compiled(w, w.initial_state(*begin, mode), mode, RK4(STEP), options)


def _largest(one: Trajectory, other: Trajectory, walker: Walker) -> Array:
    """Largest difference (2 n,) of each angle and rate, node by node of each single support."""
    n = 2 * walker.plant.n
    rows = [np.zeros((1, n))]
    for a, b in zip(one.arcs, other.arcs, strict=False):
        k = min(len(a.t), len(b.t))
        rows.append(np.abs(a.x[:k, :n] - b.x[:k, :n]))
    return np.max(np.concatenate(rows), axis=0)
