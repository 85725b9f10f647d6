"""Columns of a candidate that need no walk: numbers of its linear loop, in some 40 ms.

A limit on such a column is asked before any walk: a candidate that misses it is never walked. A function is
given the candidate's scenario, without seed and without the values of a condition, and returns the number, or
None where this scenario has none, which ranks worst. A new column is one line of `WITHOUT_WALK`.

On soft ground the numbers are those of the rigid plant, whose equations are linearised: they are those of the
time between touchdowns, and know nothing of contact that settles.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable
from functools import lru_cache

from biped_adrc.bench.build import scene_of
from biped_adrc.bench.parameters import trial
from biped_adrc.errors import BipedError
from biped_adrc.observer_design.specification import Specification
from biped_adrc.scenario.scenario import GroundRecord, Scenario
from biped_adrc.scenario.specified import specification_of
from biped_adrc.tuning.variables import Values

Linear = Callable[[Scenario], float | None]
"""What a column without a walk is computed by."""


@lru_cache(maxsize=1)
def _specification(text: str) -> Specification:
    """Of a scenario as text, kept for its other columns. Raises InputError as `specification_of`."""
    s = on_rigid_ground(Scenario(**json.loads(text)))
    return specification_of(s, scene_of(s))


def on_rigid_ground(s: Scenario) -> Scenario:
    """The scenario with the rigid plant in place of another one."""
    return s.replace(ground=GroundRecord(slope=s.ground.slope))


def _number(name: str) -> Linear:
    return lambda s: float(getattr(_specification(json.dumps(s.record())), name))


WITHOUT_WALK: dict[str, Linear] = {
    name: _number(name) for name in ("stable", "delay_margin", "disk_margin", "ripple")
}
"""The function of each such column, by the column's name."""


def numbers_without_walk(columns: Iterable[str], values: Values) -> dict[str, float | None]:
    """Those of the columns that need no walk, for a candidate with these values of a scenario.

    None where there is no finite number, or where the values do not fit together.
    """
    asked = [name for name in columns if name in WITHOUT_WALK]
    if not asked:
        return {}
    try:
        s = trial(values)
        found = {name: WITHOUT_WALK[name](s) for name in asked}
    except BipedError:
        return dict.fromkeys(asked)
    return {k: x if x is not None and math.isfinite(x) else None for k, x in found.items()}
