"""The plant alone, in every peer: RABBIT pinned at its stance foot, falling freely without torque.

Run: python benchmarks/plant.py [OUT] [--quick]

One motion for all, from the gait's start for one second, restarted; no impact and no ground. Each peer's
q'' is compared to the package's at random states first. Error: largest difference of an angle at the end to
DOP853 at 1e-12 on the package's q'' [rad].

A second table has many robots side by side, in one thread, from states beside each other. A third one has
Pinocchio's own calls against the number of joints: RABBIT, then robots of example-robot-
data. A free base counts as one joint with six velocities; the cost is that of `aba`.
"""

from __future__ import annotations

import importlib
import sysconfig
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
from peers.chains import Chain
from peers.many_chains import moves
from report import Run, Table, arguments, repeated, rounds
from scipy.integrate import solve_ivp

import biped_adrc as ba
from biped_adrc.core.types import Array

DURATION = 1.0  # [s] of each restart
PEERS = {
    "biped_adrc": ("chains", "CompiledChain"),
    "MuJoCo": ("mujoco_chain", "MuJoCoChain"),
    "Drake": ("drake_chain", "DrakeChain"),
    "CasADi": ("casadi_models", "CasADiChain"),
    "Pinocchio": ("chains", "PinocchioChain"),
}
ROBOTS = {
    "double pendulum": ("double_pendulum_description/urdf/double_pendulum.urdf", False),
    "UR5": ("ur_description/urdf/ur5_robot.urdf", False),
    "Panda": ("panda_description/urdf/panda.urdf", False),
    "ANYmal B": ("anymal_b_simple_description/robots/anymal.urdf", True),
    "TALOS reduced": ("talos_data/robots/talos_reduced.urdf", True),
    "TALOS": ("talos_data/robots/talos_full_v2.urdf", True),
}
"""URDF below the data's folder, and whether its base is free."""
MANY = 200  # robots side by side
CALLS = 1000  # of one function of Pinocchio, as one run


def reference(biped: ba.Biped, q: Array, v: Array) -> Array:
    """q after DURATION."""
    n, zero = biped.n, np.zeros(biped.n)

    def f(t: float, x: Array) -> Array:
        return np.concatenate((x[n:], biped.acceleration(x[:n], x[n:], zero)))

    start = np.concatenate((q, v))
    found = solve_ivp(f, (0.0, DURATION), start, method="DOP853", rtol=1e-12, atol=1e-13)
    end: Array = found.y[:n, -1]
    return end


def motion(biped: ba.Biped, count: int) -> Table:
    """One second in every peer. Raises ModelError for a peer with another robot."""
    q, v = ba.load_gait("published", biped).start(biped)
    packages = ("mujoco-core", "drake", "casadi", "pin")
    table = Table("Plant alone", "simulated s", biped.preset, packages)
    chains: dict[str, Chain | None] = {}
    for peer, (module, name) in PEERS.items():
        try:
            chains[peer] = getattr(importlib.import_module(f"peers.{module}"), name)(biped)
        except ModuleNotFoundError:
            chains[peer] = None
    apart = {peer: chain.check() for peer, chain in chains.items() if chain}
    runs = {
        (peer, name): partial(run, q, v, DURATION)
        for peer, chain in chains.items()
        for name, run in (chain.methods() if chain else {}).items()
    }
    truth = reference(biped, q, v)
    errors = {key: float(np.max(np.abs(run() - truth))) for key, run in runs.items()}
    seconds = rounds({", ".join(key): run for key, run in runs.items()}, count)
    for peer, chain in chains.items():
        if chain is None:
            table.missing(peer)
        for key in (key for key in runs if key[0] == peer):
            name = ", ".join(key)
            table.add(
                name, seconds[name], DURATION, error=errors[key], acceleration_off_by=apart[peer]
            )
    return table


def side_by_side(biped: ba.Biped, count: int) -> Table:
    """Many robots for half a second in one thread. Error: largest difference of an angle to the first row."""
    q, v = ba.load_gait("published", biped).start(biped)
    random, duration = np.random.default_rng(3), 0.5
    states = np.concatenate((q, v)) + random.normal(0.0, 1e-2, (MANY, 2 * biped.n))
    peers = dict(moves(biped))
    ends = {name: move(states, duration) for name, move in peers.items() if move}
    runs = {name: partial(move, states, duration) for name, move in peers.items() if move}
    table = Table("Plants side by side", "simulated s", f"{MANY} robots", ("mujoco-core", "jax"))
    seconds, first = rounds(runs, count), next(iter(ends.values()))
    for name, move in peers.items():
        if move is None:
            table.missing(name)
        else:
            error = float(np.max(np.abs(ends[name] - first)))
            table.add(name, seconds[name], MANY * duration, error=error)
    return table


def models(biped: ba.Biped) -> Iterator[tuple[str, Any]]:
    """Names and models; None for a robot that is not installed."""
    yield "RABBIT, pinned", biped.pinned.model
    yield "RABBIT, planar base", biped.floating.model
    folder = data_folder()
    for name, (path, free) in ROBOTS.items():
        urdf = None if folder is None else folder / path
        if urdf is None or not urdf.is_file():
            yield name, None
        elif free:
            yield name, pin.buildModelFromUrdf(str(urdf), pin.JointModelFreeFlyer())
        else:
            yield name, pin.buildModelFromUrdf(str(urdf))


def data_folder() -> Path | None:
    """Where example-robot-data lies: below the prefix that its wheel shares with Pinocchio's."""
    here = (Path(sysconfig.get_path(key)) for key in ("platlib", "purelib"))
    places = [path / "cmeel.prefix" for path in here] + list(Path(pin.__file__).parents)
    found = (place / "share" / "example-robot-data" / "robots" for place in places)
    return next((folder for folder in found if folder.is_dir()), None)


def calls(model: Any) -> dict[str, Run]:
    """CALLS calls each, at one random configuration."""
    pin.seed(1)
    data, random = model.createData(), np.random.default_rng(1)
    v, a, tau = random.normal(size=(3, model.nv))
    bound = np.full(model.nq, np.pi)
    q = pin.randomConfiguration(model, -bound, bound)
    functions = {
        "aba": partial(pin.aba, model, data, q, v, tau),
        "crba": partial(pin.crba, model, data, q),
        "rnea": partial(pin.rnea, model, data, q, v, a),
    }
    return {name: repeated(function, CALLS) for name, function in functions.items()}


def pinocchio_calls(biped: ba.Biped, count: int) -> Table:
    """Against the number of joints."""
    table = Table("Pinocchio calls", "call of aba", packages=("pin", "example-robot-data"))
    found = dict(models(biped))
    runs = {
        f"{name} {call}": run
        for name, model in found.items()
        if model is not None
        for call, run in calls(model).items()
    }
    seconds = rounds(runs, count)
    for name, model in found.items():
        if model is None:
            table.missing(name)
            continue
        aba, crba, rnea = (seconds[f"{name} {call}"] for call in ("aba", "crba", "rnea"))
        more = {"crba_per_aba": crba.CPU / aba.CPU, "rnea_per_aba": rnea.CPU / aba.CPU}
        table.add(
            name, aba, CALLS, **more, note=f"{model.njoints - 1} joints, {model.nv} velocities"
        )
    return table


def main() -> None:
    """Print the tables, and write them when asked."""
    asked = arguments(__doc__).parse_args()
    biped = ba.Biped.load("rabbit")
    motion(biped, 3 if asked.quick else 25).finish(asked.out)
    side_by_side(biped, 3 if asked.quick else 15).finish(asked.out)
    pinocchio_calls(biped, 3 if asked.quick else 15).finish(asked.out)


if __name__ == "__main__":
    main()
