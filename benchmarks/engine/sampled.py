"""Control at 1 kHz: compiled, in plain Python on the compiled plant, and the plant by itself beside MuJoCo.

Run: python benchmarks/engine/sampled.py [OUT] [--quick]

Walks of 25 impacts, one RK4 step per tick. "Strikes only" is a walk of a batch, "nodes kept" is
`biped_adrc.walk`. A plain controller has methods
alone, and no laws.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from cases import TICK, Setting, load, paper, ready, with_controller
from report import Table, arguments, rounds

import biped_adrc as ba
from biped_adrc.control.base import Measurement
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.observers.base import Estimate
from biped_adrc.types import Array

METHOD = RK4(TICK)


@dataclass(frozen=True)
class Plain(ba.Controller):
    """Another controller's methods without its laws."""

    inner: ba.Controller

    def output(self, s: Array, m: Measurement) -> Array:
        return self.inner.output(s, m)

    def initial_state(self, m: Measurement) -> Array:
        return self.inner.initial_state(m)

    def correct(self, s: Array, m: Measurement) -> Array:
        return self.inner.correct(s, m)

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        return self.inner.predict(s, m, u)

    def jump(self, s: Array, after: Measurement, swap: Array) -> Array:
        return self.inner.jump(s, after, swap)

    def estimate(self, s: Array, m: Measurement) -> Estimate | None:
        return self.inner.estimate(s, m)


@dataclass(frozen=True)
class ByHand(ba.Controller):
    """u = kappa^-1 (q_d'' + K_p e + K_d e' - xi): a first idea, in one line."""

    constraint: ba.VirtualConstraint

    def output(self, s: Array, m: Measurement) -> Array:
        r, terms = self.constraint(m.t, m.q, m.v), m.terms
        a = r.drift + 5e3 * (r.q_d - m.q_b) + 100.0 * (r.dq_d - m.v_b)
        u: Array = terms.kappa_inverse @ (a - terms.xi)
        return u


def walks(table: Table, quick: bool) -> None:
    """Compiled and plain walks."""
    settings = {
        f"{name}{', push' if push else ''}": paper(name, TICK, push)
        for name in ("NPD", "ADRC")
        for push in (False, True)
    }
    bare = {name: ready(s.case(METHOD)) for name, s in settings.items()}
    kept = {f"{name}, kept": partial(s.walk, METHOD, "compiled") for name, s in settings.items()}
    seconds = rounds(bare | kept, 3 if quick else 15)
    for name, setting in settings.items():
        t_end = setting.walk(METHOD, "compiled").t_end
        times = seconds[name], seconds[f"{name}, kept"]
        table.add(
            f"{name}, compiled",
            strikes_only_per_wall_s=t_end / times[0].wall,
            strikes_only_per_CPU_s=t_end / times[0].cpu,
            nodes_kept_per_CPU_s=t_end / times[1].cpu,
        )
    adrc, npd = (settings[name].walker.controller for name in ("ADRC", "NPD"))
    plain = {
        "ADRC": Plain(adrc.sampled(TICK)),
        "NPD": Plain(npd),
        "computed torque": ByHand(npd.reference),
    }
    for name, controller in plain.items():
        setting = with_controller(settings["NPD"], controller)
        for engine in ("compiled", "pinocchio"):
            plain_row(f"{name}, plain Python", setting, engine, table, 1 if quick else 3)


def plain_row(name: str, setting: Setting, engine: str, table: Table, count: int) -> None:
    """A controller without laws."""
    run = setting.walk(METHOD, engine)
    seconds = rounds({name: partial(setting.walk, METHOD, engine)}, count)[name]
    table.add(
        f"{name}, {run.settings['engine']}",
        nodes_kept_per_wall_s=run.t_end / seconds.wall,
        nodes_kept_per_CPU_s=run.t_end / seconds.cpu,
        note=f"{len(run.arcs)} impacts",
    )


def plants(table: Table, quick: bool) -> None:
    """One second of free motion, as in benchmarks/peers/plant.py, which has more peers."""
    import plant as peers

    biped = ba.Biped.load("rabbit")
    q, v = ba.load_gait("published", biped).start(biped)
    found = {
        peer: chain
        for peer, chain in peers.chains(biped, table).items()
        if peer in ("biped_adrc, compiled", "MuJoCo")
    }
    truth = peers.reference(biped, q, v)
    runs = {
        f"{peer}, {method}": partial(run, q, v, peers.DURATION)
        for peer, chain in found.items()
        for method, run in chain.methods().items()
    }
    for chain in found.values():
        chain.check()
    seconds = rounds(runs, 5 if quick else 51)
    for name, run in runs.items():
        table.add(
            f"plant alone: {name}",
            strikes_only_per_wall_s=peers.DURATION / seconds[name].wall,
            strikes_only_per_CPU_s=peers.DURATION / seconds[name].cpu,
            error_of_q=float(np.max(np.abs(run() - truth))),
        )


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    note = f"25 impacts, RK4 with steps of 1 ms; {load()}"
    table = Table("Sampled control at 1 kHz", "simulated s", note, ("mujoco", "pin"))
    walks(table, asked.quick)
    plants(table, asked.quick)
    table.finish(asked.out)


if __name__ == "__main__":
    main()
