"""What a constraint that goes on smoothly past its ends costs: time, and the order of a step that ends late.

Run: python benchmarks/engine/continued.py [OUT] [--quick]

Time: 25 impacts, compiled, as a ratio to the constraint as it is, whose polynomial leaves its range. Order: RK4
over a step that ends 4 mm lower, 3 % of the phase range past Theta-; (q, q') before impact against h = 2e-6 s.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from statistics import median

import numpy as np
from cases import load
from report import Table, arguments

import biped_adrc as ba
from biped_adrc.engine.batch import Case, run_case
from biped_adrc.types import Array

STEPS = (2e-3, 1e-3, 5e-4, 2.5e-4)
"""[s]"""


def before_impact(walker: ba.Walker, gait: ba.Gait, h: float) -> Array:
    """(q, q') at the end of a step."""
    walk = ba.walk(walker, gait, 1, ba.RK4(h), engine="compiled")
    return walk.trajectory.before("foot_strike")[-1][: 2 * walker.plant.n]


def ready(law: ba.Controller, biped: ba.Biped, gait: ba.Gait) -> Callable[[], object]:
    """A walk of 25 impacts, compiled before."""
    stiff = isinstance(law, ba.ADRCController)
    method = ba.Exponential(1e-3, feedback=True) if stiff else ba.RK4(1e-3)
    case = Case(ba.Walker(biped, law), *gait.start(biped), method)
    run_case(case)()
    return lambda: run_case(case)()


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    table = Table("Continued constraints", "errors in rad and rad/s", load(), ())
    biped = ba.Biped.load("rabbit")
    gait = ba.load_gait("published", biped)
    laws = {"as it is": gait.constraint, "continued": ba.continued(gait.constraint)}
    runs = {
        (name, made.__name__): ready(made(h), biped, gait)
        for name, h in laws.items()
        for made in (ba.NPDController, ba.ADRCController)
    }
    seconds: dict[tuple[str, str], list[float]] = {key: [] for key in runs}
    for _ in range(3 if asked.quick else 15):
        for key, run in runs.items():
            begin = time.process_time()
            run()
            seconds[key].append(time.process_time() - begin)
    for name, h in laws.items():
        lower = (ba.StepDown(1, 0.004),)
        walker = ba.Walker(biped, ba.NPDController(h), ground_steps=lower)
        truth = before_impact(walker, gait, 2e-6)
        gaps = [float(np.max(np.abs(before_impact(walker, gait, s) - truth))) for s in STEPS]
        table.add(
            name,
            **{
                f"{made}_per_as_it_is": median(seconds[name, made])
                / median(seconds["as it is", made])
                for made in ("NPDController", "ADRCController")
            },
            error_at_1_ms=gaps[1],
            order=float(np.polyfit(np.log(STEPS), np.log(gaps), 1)[0]),
        )
    table.finish(asked.out)


if __name__ == "__main__":
    main()
