"""Walks under control at 1 kHz: compiled, in plain Python, on Pinocchio, on MuJoCo's ground, and for learners.

Run: python benchmarks/sampled_walks.py [OUT] [--quick]

RABBIT, 25 impacts from the gait's start, one RK4 step per tick. A row keeps the strikes alone, as walks of a
batch do, or every node. Error: largest difference of an angle or rate before impacts to the same walk at a
fifth of its step [rad, rad/s]. "Plain Python" branches on a number, so it is called once per tick. Gymnasium's
walks get small random torques beside those of ADRC.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from importlib.util import find_spec

import numpy as np
from report import Run, Table, arguments, rounds
from walks import TICK, Setting, load, ready, setting

import biped_adrc as ba
from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.control.base import Measurement
from biped_adrc.core.types import Array
from biped_adrc.engine.batch import BatchWalk
from biped_adrc.engine.on_plant import CompiledLoop
from biped_adrc.extras.mujoco.plant import MuJoCoPlant
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.hybrid.simulator import RunOptions

FINER = 5
ENVIRONMENT = "biped_adrc.extras.gym:biped_adrc/Walk-v0"
STRONGEST = 1e5  # [N m]
SAMPLES, MANY = 2000, 64  # of a learner's walks, as one run; of them in a vector


@dataclass(frozen=True)
class ByHand(ba.Controller):
    """u = kappa^-1 (q_d'' + K_p e + K_d e' - xi): a first idea, with a branch that keeps it in Python."""

    constraint: ba.VirtualConstraint

    def output(self, s: Array, m: Measurement) -> Array:
        r, terms = self.constraint(m.t, m.q, m.v), m.terms
        a = r.drift + 5e3 * (r.q_d - m.q_b) + 100.0 * (r.dq_d - m.v_b)
        u: Array = terms.kappa_inverse @ (a - terms.xi)
        return u if u[0] < STRONGEST else np.zeros_like(u)


Method = RK4 | Exponential


def rigid() -> Iterator[tuple[str, Setting, Method]]:
    """Compiled walks; the first is what all others are compared with."""
    yield "ADRC", setting(), RK4(TICK)
    yield "ADRC, pushed", setting(push=True), RK4(TICK)
    yield (
        "ADRC, m = 1",
        setting(**{"controller.observer": {"order": 1, "bandwidth": 160.0}}),
        RK4(TICK),
    )
    yield "NPD", setting("NPD"), RK4(TICK)
    yield (
        "ADRC in continuous time, ETD-RK4 0.5 ms",
        setting(**{"hardware.period": None}),
        Exponential(5e-4),
    )


def compiled(table: Table, quick: bool) -> None:
    """Walks of a batch, and one with all nodes."""
    cases = {name: (found, method) for name, found, method in rigid()}
    runs: dict[str, Callable[[], BatchWalk]] = {
        name: ready(found.case(method)) for name, (found, method) in cases.items()
    }
    kept = partial(nodes, cases["ADRC"][0], "compiled", 25)
    walks = {name: run() for name, run in runs.items()}
    seconds = rounds({**runs, "kept": kept}, 3 if quick else 15)
    for name, (found, method) in cases.items():
        finer = replace(method, h=method.h / FINER)
        error = difference(walks[name].x_minus, ready(found.case(finer))().x_minus)
        table.add(name, seconds[name], walks[name].t_end, error=error)
    table.add("ADRC, every node kept", seconds["kept"], kept().t_end)


def difference(a: Array, b: Array) -> float | None:
    """Largest, of (q, q') before impacts; None for walks of other lengths."""
    return float(np.max(np.abs(a - b)[:, :10])) if len(a) == len(b) else None


def nodes(found: Setting, engine: str, impacts: int) -> ba.Trajectory:
    """A walk with all its nodes."""
    return ba.walk(found.walker, found.gait, impacts, RK4(TICK), engine=engine).trajectory


def in_python(table: Table, quick: bool) -> None:
    """A controller that is not compiled on the compiled plant, and both engines without machine code."""
    found, impacts = setting("NPD"), 1 if quick else 5
    by_hand = found.under(ByHand(found.gait.constraint))
    cases = {
        "plain Python on the compiled plant": (by_hand, "compiled"),
        "plain Python on Pinocchio": (by_hand, "pinocchio"),
        "NPD on Pinocchio": (found, "pinocchio"),
    }
    runs = {name: partial(nodes, *case, impacts) for name, case in cases.items()}
    walks = {name: run() for name, run in runs.items()}
    seconds = rounds(runs, 1 if quick else 3)
    compiled = nodes(found, "compiled", impacts).before(FOOT_STRIKE)
    for name, walk in walks.items():
        same = cases[name][0] is found
        error = difference(walk.before(FOOT_STRIKE), compiled) if same else None
        note = "error: to the compiled walk" if same else None
        table.add(name, seconds[name], walk.t_end, error=error, note=note)


def on_soft_ground(table: Table, quick: bool) -> None:
    """ADRC in MuJoCo at 0.2 ms, its loop compiled and in Python."""
    found, impacts = setting(), 2 if quick else 6
    biped, gait = ba.Biped.load("rabbit"), found.gait
    names = {
        "MuJoCo with contact, RK4 0.2 ms": (CompiledLoop, "rk4"),
        "MuJoCo with contact, leapfrog 0.2 ms": (CompiledLoop, "leapfrog"),
        "MuJoCo with contact, RK4 0.2 ms, loop in Python": (SteppingLoop, "rk4"),
    }
    if not find_spec("mujoco"):
        table.missing("MuJoCo with contact")
        return
    runs = {}
    for name, (kind, integrator) in names.items():
        plant = MuJoCoPlant(biped, integrator=integrator)
        law = ba.ADRCController(gait.constraint)
        loop = kind(plant, law, None, ba.SampledTime(TICK), biped, 150.0)
        options = RunOptions(0.8 * impacts, stop_after=(FOOT_STRIKE, impacts))
        runs[name] = partial(loop.run, loop.initial_state(*gait.start(biped)), options)
    walks = {name: run() for name, run in runs.items()}
    seconds = rounds(runs, 1 if quick else 5)
    for name, walk in walks.items():
        table.add(name, seconds[name], walk.t_end, note="another ground: no error")


def learners(table: Table, quick: bool) -> None:
    """One environment of Gymnasium, and a vector of many."""
    if not find_spec("gymnasium"):
        table.missing("Gymnasium")
        return
    import gymnasium

    observer = {"bandwidth": 160.0, "order": 1}
    values = {"action": "added", "controller": {"observer": observer}}
    env = gymnasium.make(ENVIRONMENT, **values)
    envs = gymnasium.make_vec(ENVIRONMENT, num_envs=MANY, **values)
    actions = np.random.default_rng(0).uniform(-0.02, 0.02, (SAMPLES, MANY, 4))

    def one() -> None:
        env.reset(seed=0)
        for k in range(SAMPLES):
            env.step(actions[k, 0])

    def many() -> None:
        envs.reset(seed=0)
        for action in actions:
            envs.step(action)

    runs: dict[str, Run] = {"Gymnasium, one": one, f"Gymnasium, a vector of {MANY}": many}
    env.reset(seed=0)
    envs.reset(seed=0)
    envs.step(actions[0])
    seconds = rounds(runs, 1 if quick else 9)
    for name, walks in zip(runs, (1, MANY), strict=True):
        table.add(name, seconds[name], SAMPLES * TICK * walks)


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    table = Table("Sampled walks", "simulated s", load(), ("mujoco-core", "gymnasium", "pin"))
    for part in (compiled, in_python, on_soft_ground, learners):
        part(table, asked.quick)
    table.finish(asked.out)


if __name__ == "__main__":
    main()
