"""The map of pushes on soft ground: NPD beside ADRC of low order, held after touchdown.

    python benchmarks/soft/push_map.py

Printed is a table, and how many walks are what; below it the same map on the rigid plant.
"""

from __future__ import annotations

from collections.abc import Sequence

from rows import markdown

from biped_adrc.paper.push_map import PushCell, counts, push_map, pushes
from biped_adrc.scenario.scenario import Scenario

LIMIT = 150.0
"""[N m]"""
USUAL = {"period": 1e-3, "contact": "hold", "friction_limit": 0.8, "max_step_time": 1.0}
PLANTS = {"soft": {"plant": "mujoco", "ground_friction": 0.8}, "rigid": {}}
CONTROLLERS = ("NPD", "LESO")
"""Around NPD, which has no observer, `hold` does nothing."""
ONSETS = (0.0, 0.1, 0.2, 0.3)
"""[s]"""
AMPLITUDES = (30.0, 60.0, 90.0, 120.0, 150.0)
"""[N m]"""


def found(plant: dict[str, object]) -> list[PushCell]:
    """The cells on a plant."""
    tried = pushes(ONSETS, AMPLITUDES, ("all +",), (LIMIT,))
    return push_map(Scenario(**USUAL, **plant), tried, controllers=CONTROLLERS)


def table(cells: Sequence[PushCell]) -> str:
    """A row for each amplitude, a column for each onset: NPD / ADRC."""
    words = {(c.amplitude, c.onset): f"{c.npd.word} / {c.adrc.word}" for c in cells}
    rows = [[f"{a:g}", *(words[a, onset] for onset in ONSETS)] for a in AMPLITUDES]
    return markdown(["push [N m]", *(f"{1e3 * onset:g} ms" for onset in ONSETS)], rows)


if __name__ == "__main__":
    for name, plant in PLANTS.items():
        cells = found(plant)
        print(f"{name}\n\n{table(cells)}\n\n{counts(cells)}\n", flush=True)
