"""A study: a scenario varied over cases, conditions, grids, draws and seeds, or searched, on all cores.

The room can be called, since `ba.study` is both its name and that of what it does: see `carry.study`.
"""

import sys
from types import ModuleType
from typing import Any


class _Room(ModuleType):
    def __call__(self, *given: Any, **more: Any) -> Any:
        from biped_adrc.study.carry import study

        return study(*given, **more)


sys.modules[__name__].__class__ = _Room
