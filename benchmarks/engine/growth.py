"""How the cost of a compiled walk grows with its steps and with the order of the observer.

Run: python benchmarks/engine/growth.py [OUT] [--quick]

ADRC without a push. Steps: one walk of 25 to 10 000 impacts at 1 kHz, its strikes kept. Order: 25 impacts under
an observer with m + 2 poles at -500 rad/s, at 1 kHz and in continuous time by the exponential method at 0.5 ms.
"""

from __future__ import annotations

from cases import TICK, load, paper, ready, with_observer
from report import Table, arguments, rounds

from biped_adrc.engine.batch import run_case
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4

STEPS = (25, 100, 400, 1600, 10_000)
BANDWIDTH = 500.0  # [rad/s]
ORDERS = range(13)
TIME = {"1 kHz": (TICK, RK4(TICK)), "continuous": (None, Exponential(5e-4))}


def steps(quick: bool) -> Table:
    """Against the number of impacts."""
    table = Table("Growth with steps", "simulated s", f"ADRC at 1 kHz; {load()}")
    setting = paper(period=TICK, push=False)
    for impacts in STEPS[:-1] if quick else STEPS:
        run = ready(setting.case(RK4(TICK), impacts))
        walk = run()
        seconds = rounds({"": run}, 1 if impacts > 1000 else 5)[""]
        table.add(
            f"{impacts} impacts",
            impacts_made=walk.impacts,
            wall_s=seconds.wall,
            ms_per_impact=1e3 * seconds.cpu / walk.impacts,
            per_wall_s=walk.t_end / seconds.wall,
            per_CPU_s=walk.t_end / seconds.cpu,
        )
    return table


def orders(quick: bool) -> Table:
    """Against m; the ratio is of CPU time to m = 0."""
    note = f"m + 2 poles at -{BANDWIDTH:g} rad/s; {load()}"
    table = Table("Growth with observer order", "simulated s per CPU s", note)
    cases = {
        (m, name): with_observer(m, BANDWIDTH, period).case(method)
        for m in (ORDERS[::4] if quick else ORDERS)
        for name, (period, method) in TIME.items()
    }
    runs = {f"{m}, {name}": ready(case) for (m, name), case in cases.items()}
    ends = {key: run_case(case)() for key, case in cases.items()}
    seconds = rounds(runs, 3 if quick else 9)
    for m in dict.fromkeys(m for m, _ in cases):
        row: dict[str, float | int] = {}
        for name in TIME:
            cpu = seconds[f"{m}, {name}"].cpu
            row[name] = ends[m, name].t_end / cpu
            row[f"{name}, cost to m = 0"] = cpu / seconds[f"0, {name}"].cpu
        made = min(ends[m, name].impacts for name in TIME)
        table.add(f"m = {m}", states=10 + 4 * (m + 2), impacts=made, **row)
    return table


def main() -> None:
    """Print both tables, and write them when asked."""
    asked = arguments(__doc__).parse_args()
    for table in (steps(asked.quick), orders(asked.quick)):
        table.finish(asked.out)


if __name__ == "__main__":
    main()
