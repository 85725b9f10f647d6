"""Columns of a candidate that need no walk: numbers of its linear loop, in some 40 ms.

A candidate that misses a limit on such a column is not walked. The numbers are those of the candidate's
scenario without seed and condition, and on soft ground those of the rigid plant, which is linearised.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from functools import lru_cache

from biped_adrc.analysis.loops.specification import Specification
from biped_adrc.core.errors import BipedError
from biped_adrc.scenario.cycle import specification_of
from biped_adrc.scenario.scenario import GroundRecord
from biped_adrc.studies.build import scene_of
from biped_adrc.studies.parameters import Values, scenario_of

WITHOUT_WALK = ("stable", "delay_margin", "disk_margin", "ripple")
"""Such columns: numbers of a `Specification`."""


@lru_cache(maxsize=128)
def _specification(text: str) -> Specification:
    """Of the values of a scenario as JSON, kept for its columns before and after its walks.

    Raises InputError.
    """
    s = scenario_of(json.loads(text))
    g = s.ground
    s = s.replace(ground=GroundRecord(slope=g.slope, drop=g.drop, drop_step=g.drop_step, rms=g.rms))
    return specification_of(s, scene_of(s))


def numbers_without_walk(columns: Iterable[str], values: Values) -> dict[str, float | None]:
    """Those of the columns that need no walk, for a candidate with these values of a scenario.

    None where there is no finite number, or where the values do not fit together.
    """
    computed = [name for name in columns if name in WITHOUT_WALK]
    text = json.dumps(values, sort_keys=True)
    try:
        result = {name: float(getattr(_specification(text), name)) for name in computed}
    except BipedError:
        return dict.fromkeys(computed)
    return {name: x if math.isfinite(x) else None for name, x in result.items()}
