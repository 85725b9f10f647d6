"""The plant alone, in every peer: RABBIT pinned at its stance foot, falling freely without torque.

Run: python benchmarks/peers/plant.py [OUT] [--quick]

One motion for all, from the gait's start for one second, restarted; no impact, no ground, but in the rows
that say contact. Each peer's q'' is compared to the package's at random states first. Error: largest
difference of an angle at the end to DOP853 at 1e-12 on the package's q''.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Mapping
from functools import partial
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from chain import Chain, Simulate
from report import Table, arguments, rounds

import biped_adrc as ba
from biped_adrc.types import Array

DURATION = 1.0  # [s] of each restart
PEERS = {
    "biped_adrc, compiled": ("compiled_chain", "CompiledChain"),
    "MuJoCo": ("mujoco_chain", "MuJoCoChain"),
    "Drake": ("drake_chain", "DrakeChain"),
    "CasADi": ("casadi_chain", "CasADiChain"),
    "Pinocchio": ("pinocchio_chain", "PinocchioChain"),
}
PACKAGES = ("mujoco-core", "drake", "casadi", "pin")


def reference(biped: ba.Biped, q: Array, v: Array) -> Array:
    """q after DURATION."""
    n, zero = biped.n, np.zeros(biped.n)

    def f(t: float, x: Array) -> Array:
        return np.concatenate((x[n:], biped.acceleration(x[:n], x[n:], zero)))

    found = solve_ivp(
        f, (0.0, DURATION), np.concatenate((q, v)), method="DOP853", rtol=1e-12, atol=1e-13
    )
    end: Array = found.y[:n, -1]
    return end


def chains(biped: ba.Biped, table: Table) -> dict[str, Chain]:
    """The peers that are installed; the others are rows already. Raises ModelError for another robot."""
    found = {}
    for peer, (module, name) in PEERS.items():
        try:
            found[peer] = getattr(importlib.import_module(module), name)(biped)
        except ModuleNotFoundError:
            table.missing(peer)
    return found


def contacts(biped: ba.Biped, found: Mapping[str, Chain]) -> Mapping[str, Simulate]:
    """Rows with contact, of peers that have one."""
    if "MuJoCo" not in found:
        return {}
    return importlib.import_module("mujoco_chain").on_the_ground(biped)


def main() -> None:
    """Check, time, print, and write when asked."""
    asked = arguments(__doc__).parse_args()
    biped = ba.Biped.load("rabbit")
    q, v = ba.load_gait("published", biped).start(biped)
    note = f"{biped.preset}; {DURATION:g} s from the gait's start, medians over restarts"
    table = Table("Plant alone", "simulated s", note, PACKAGES)
    found = chains(biped, table)
    same = {peer: chain.check() for peer, chain in found.items()}
    simulations = {
        (peer, method): run
        for peer, chain in found.items()
        for method, run in chain.methods().items()
    }
    touching = {("MuJoCo", method): run for method, run in contacts(biped, found).items()}
    truth = reference(biped, q, v)
    ends = {key: run(q, v, DURATION) for key, run in (simulations | touching).items()}
    runs = {
        ", ".join(key): partial(run, q, v, DURATION)
        for key, run in (simulations | touching).items()
    }
    seconds = rounds(runs, 3 if asked.quick else 25)
    for key in ends:
        name, alone = ", ".join(key), key in simulations
        table.add(
            name,
            per_wall_s=DURATION / seconds[name].wall,
            per_CPU_s=DURATION / seconds[name].cpu,
            error_of_q=float(np.max(np.abs(ends[key] - truth))) if alone else None,
            acceleration_differs_by=same[key[0]] if alone else None,
            note="" if alone else "feet on the ground: another system",
        )
    table.finish(asked.out)


if __name__ == "__main__":
    main()
