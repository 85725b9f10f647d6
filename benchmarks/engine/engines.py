"""The Python engine on Pinocchio and the compiled one on the paper's run, at equal method and step.

Run: python benchmarks/engine/engines.py [OUT] [--quick]

25 impacts with the push, every node kept by both, once; simulated seconds per second of CPU time. States are
(q, q') and the observer's, before every impact.
"""

from __future__ import annotations

import time
from collections.abc import Sequence

import numpy as np
from cases import Setting, load, paper
from report import Table, arguments

from biped_adrc.closed_loop.walker import FOOT_STRIKE
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4, Adaptive, OneStepMethod

IN_PYTHON = {
    "ADRC": (Exponential(1e-3, feedback=True),),
    "NPD": (RK4(1e-3), Adaptive()),
}
"""One method for each is enough for a quick look; a walk of the Python engine takes 10 to 40 s."""


def python_rows(
    setting: Setting, name: str, methods: Sequence[OneStepMethod], table: Table
) -> None:
    """The Python engine on Pinocchio at equal method and step, once; CPU time."""
    for method in methods:
        begin = time.process_time()
        theirs = setting.walk(method, "pinocchio")
        between = time.process_time()
        ours = setting.walk(method, "compiled")
        cpu = between - begin, time.process_time() - between
        a, b = (run.before(FOOT_STRIKE) for run in (ours, theirs))
        made = len(a), len(b)
        a, b = a[: min(made)], b[: min(made)]
        table.add(
            f"{name}, {method.label}",
            Python=theirs.t_end / cpu[0],
            compiled=ours.t_end / cpu[1],
            ratio=cpu[0] / cpu[1],
            states_at_impacts_differ_by=float(np.max(np.abs(a - b))),
            angles_differ_by=float(np.max(np.abs(a - b)[:, : setting.walker.plant.n])),
            note=f"impacts: {made[0]} and {made[1]}",
        )


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    table = Table("Engines", "simulated s per CPU s", load(), ("pin",))
    for name, methods in IN_PYTHON.items():
        setting = paper(name)
        for method in methods:
            setting.walk(method, "compiled")  # compiles what is not there
        python_rows(setting, name, methods[:1] if asked.quick else methods, table)
    table.finish(asked.out)


if __name__ == "__main__":
    main()
