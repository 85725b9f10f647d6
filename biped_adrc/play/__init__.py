"""A walk under one's own hand: moved on sample by sample, pushed and changed on the way, and repeated.

`ba.play` is the function `page.play`, and this folder has the same name: Python puts the folder in its place
once something in it is imported. So the folder can be called, and does what the function does.
"""

import sys
from types import ModuleType


class _Callable(ModuleType):
    """This folder as a function."""

    def __call__(self, *given: object, **named: object) -> str:
        """As `page.play`."""
        from biped_adrc.play.page import play

        return play(*given, **named)  # type: ignore[arg-type]


sys.modules[__name__].__class__ = _Callable
