"""The gait designer on RABBIT: what its gaits cost, how good they are, and whether they pass their
certificate.

Run: python benchmarks/gait_design.py [OUT] [--quick]

Every design starts cold and is timed once, without its certificate. The objective is int u'u dt / L of the
periodic step [N^2 m s]. Error: of the objective, relative to the design with twice the nodes. The gait
through x* stands beside the stored one, 'published', that goes through it too.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from report import Table, arguments, spent
from walks import load

import biped_adrc as ba
from biped_adrc.analysis.gait_design import certify
from biped_adrc.gait.design.optimise import optimise
from biped_adrc.gait.design.request import GaitRequest, StepLimits
from biped_adrc.gait.published import X_STAR
from biped_adrc.gait.zero_dynamics import ZeroDynamics

PRESETS = ("identified", "tac2003")
SPEEDS = (0.8, 0.4, 0.6, 1.0)  # [m/s]
NODES = 80  # of the quadrature that scores a finished gait


def torque_squared(biped: ba.Biped, gait: ba.Gait) -> float:
    """int u'u dt / L of the periodic step [N^2 m s]."""
    zero = ZeroDynamics.of(biped, gait.constraint, NODES)
    orbit = zero.orbit(zero.sigma_minus * zero.delta)
    length = float(biped.swing_foot(gait.q_minus)[0])
    return float(orbit.time_weights @ np.sum(orbit.u**2, axis=1)) / length


def add(table: Table, name: str, biped: ba.Biped, request: GaitRequest) -> float:
    """The row of a request; its objective."""
    found = []
    seconds = spent(lambda: found.append(optimise(biped, request)))
    fine = optimise(biped, replace(request, nodes=2 * request.nodes))
    objective, finer = (torque_squared(biped, one.gait) for one in (found[0], fine))
    try:
        certify(biped, request, found[0])
        note = "certificate passed"
    except ba.GaitError as error:
        note = str(error)
    error, iterations = abs(objective / finer - 1.0), found[0].iterations
    table.add(name, seconds, iterations=iterations, objective=objective, error=error, note=note)
    return objective


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    table = Table("Gait design", "design", load(), ("casadi",))
    bipeds = {preset: ba.Biped.load("rabbit", preset) for preset in PRESETS}
    if asked.quick:
        add(
            table,
            f"{PRESETS[0]}, {SPEEDS[0]:g} m/s",
            bipeds[PRESETS[0]],
            GaitRequest(SPEEDS[0], nodes=12),
        )
    else:
        optimise(bipeds[PRESETS[0]], GaitRequest(SPEEDS[0]))  # whatever is loaded once
        for preset in PRESETS:
            for speed in SPEEDS:
                add(table, f"{preset}, {speed:g} m/s", bipeds[preset], GaitRequest(speed))
        request = GaitRequest(through=tuple(X_STAR), limits=StepLimits(impulse_friction=math.inf))
        for preset, biped in bipeds.items():
            objective = add(table, f"{preset}, through x*", biped, request)
            stored = torque_squared(biped, ba.load_gait("published", biped))
            table.rows[-1]["note"] += f"; {objective / stored:.3f} of the stored gait's objective"
    table.finish(asked.out)


if __name__ == "__main__":
    main()
