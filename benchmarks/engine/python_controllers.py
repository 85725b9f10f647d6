"""Controllers of one page in plain Python at 1 kHz on the compiled plant: simulated seconds per second.

Run: python benchmarks/engine/python_controllers.py [OUT] [--quick]

Walks of 25 impacts, one RK4 step per tick, every node kept, all checks on. Each controller has its reference
either in a field, where it is given the same one in machine code, or behind a function of its own, where
NumPy evaluates it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from cases import TICK, load, paper, with_controller
from report import Table, arguments, rounds

import biped_adrc as ba
from biped_adrc.control.base import Measurement
from biped_adrc.types import Array

METHOD = ba.RK4(TICK)
Where = Callable[[float, Array, Array], Any]


@dataclass(frozen=True)
class PD(ba.Controller):
    """u = kappa^-1 (K_p e + K_d e')."""

    h: Where

    def output(self, s: Array, m: Measurement) -> Array:
        r = self.h(m.t, m.q, m.v)
        u: Array = m.terms.kappa_inverse @ (5e3 * (r.q_d - m.q_b) + 140.0 * (r.dq_d - m.v_b))
        return u


@dataclass(frozen=True)
class NPD(ba.Controller):
    """u = kappa^-1 (q_d'' + K_p e + K_d e' - xi), without the loop through Theta''."""

    h: Where

    def output(self, s: Array, m: Measurement) -> Array:
        r = self.h(m.t, m.q, m.v)
        a = r.drift + 5e3 * (r.q_d - m.q_b) + 100.0 * (r.dq_d - m.v_b)
        u: Array = m.terms.kappa_inverse @ (a - m.terms.xi)
        return u


@dataclass(frozen=True)
class ADRC(ba.Controller):
    """u = kappa^-1 (q_d'' + K_p e + K_d e' - z_3) with a linear observer z (3 p,) in Euler's steps."""

    h: Where
    bandwidth: float = 300.0

    def initial_state(self, m: Measurement) -> Array:
        return np.concatenate((m.q_b, m.v_b, m.terms.xi))

    def output(self, s: Array, m: Measurement) -> Array:
        r, xi = self.h(m.t, m.q, m.v), s[8:]
        a = r.drift + 5e3 * (r.q_d - m.q_b) + 100.0 * (r.dq_d - m.v_b)
        u: Array = m.terms.kappa_inverse @ (a - xi)
        return u

    def predict(self, s: Array, m: Measurement, u: Array) -> Array:
        w, p = self.bandwidth, len(u)
        e = m.q_b - s[:p]
        z1 = s[:p] + TICK * (s[p : 2 * p] + 3.0 * w * e)
        z2 = s[p : 2 * p] + TICK * (s[2 * p :] + m.terms.kappa @ u + 3.0 * w * w * e)
        return np.concatenate((z1, z2, s[2 * p :] + TICK * w**3 * e))

    def jump(self, s: Array, after: Measurement, swap: Array) -> Array:
        return np.concatenate((after.q_b, after.v_b, s[2 * len(swap) :][swap]))


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    table = Table("Python controllers", "simulated s", f"25 impacts, 1 kHz; {load()}")
    setting = paper("NPD", TICK, push=False)
    h = setting.gait.constraint
    for kind in (PD, NPD, ADRC):
        found = {}
        for how, reference in (
            ("in a field", h),
            ("behind a function", lambda t, q, v: h(t, q, v)),
        ):
            made = with_controller(setting, kind(reference))
            found[how] = made.walk(METHOD, "compiled"), partial(made.walk, METHOD, "compiled")
        times = rounds({how: run for how, (_, run) in found.items()}, 3 if asked.quick else 15)
        for how, (run, _) in found.items():
            table.add(
                f"{kind.__name__}, reference {how}",
                per_wall_s=run.t_end / times[how].wall,
                per_CPU_s=run.t_end / times[how].cpu,
                us_per_tick=1e6 * TICK * times[how].cpu / run.t_end,
                note=f"{run.status.name}, {len(run.arcs)} impacts",
            )
    table.finish(asked.out)


if __name__ == "__main__":
    main()
