"""What is commanded while both feet may carry: does it change a walk on soft ground?

    python benchmarks/soft/double_support.py

For each controller and policy of `control.double_support`: the largest error within 60 ms of a touchdown and
outside of that [mrad], and the longest double support of a step [ms].
"""

from __future__ import annotations

from collections.abc import Iterator

from rows import markdown

from biped_adrc.bench.run import run_trial

CONTROLLERS = {
    "NPD": {"controller": "NPD"},
    "m = 1, `hold`": {"controller": "LESO", "contact": "hold"},
    "m = 1": {"controller": "LESO"},
}
POLICIES = ("ramp torque", "last torque", "damping")
WINDOWS = (5e-3, 15e-3)
GROUNDS = (2e-3, 10e-3)
"""Time constants [s]."""
USUAL = {
    "plant": "mujoco",
    "period": 1e-3,
    "torque_limit": 150.0,
    "ground_friction": 0.8,
    "impacts": 5,
}
MEASURED = ("touchdown_error", "settled_error", "double_support")
"""Columns of a row."""


def cells(given: dict[str, object]) -> list[str]:
    """What is printed of one walk on each ground."""
    found = [run_trial({**USUAL, **given, "time_constant": T}) for T in GROUNDS]
    return [
        f"{1e3 * float(row[name] or 0.0):.3g}" if row["survived"] else "lost"
        for row in found
        for name in MEASURED
    ]


def table() -> Iterator[list[str]]:
    """The rows of the table."""
    for name, controller in CONTROLLERS.items():
        yield [name, "as it is", *cells(controller)]
        for policy in POLICIES:
            for T in WINDOWS:
                given = {**controller, "double_support": policy, "double_support_window": T}
                yield ["", f"`{policy}`, {1e3 * T:g} ms", *cells(given)]


if __name__ == "__main__":
    names = ("touchdown", "settled", "both [ms]")
    heads = [f"{name}, {1e3 * T:g} ms" for T in GROUNDS for name in names]
    print(markdown(["controller", "policy", *heads], table()))
