"""A policy across contact: the disturbance stays as the reset left it, positions and rates go on.

    xi^ <- xi^ as before the tick,   x1^, x2^ as the observer says         for t_step < T

and so the derivatives of xi^. What the forces of a contact that settles do to the joints is then no
disturbance: the observer follows them with its gains of position and rate alone. Which of its states are xi^
the observer says itself, by its law `freeze`; `momentum_dob` freezes its force r.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from biped_adrc.control.across_contact import ContactWindow
from biped_adrc.control.around import AroundParameters, passed_on
from biped_adrc.control.base import ControllerLaws, Measurement, controller_laws
from biped_adrc.errors import InputError
from biped_adrc.types import Array


@lru_cache(maxsize=64)
def freezing(inner: ControllerLaws) -> ControllerLaws:
    """The laws of `Freeze` around these."""
    freeze, correct_inside, predict_inside = inner.freeze, inner.correct, inner.predict
    assert freeze is not None
    assert correct_inside is not None
    assert predict_inside is not None

    def correct(k: AroundParameters, s: Array, m: Measurement) -> Array:
        new = correct_inside(k.inner, s, m)
        return np.where(m.t_step < k.own.until, freeze(k.inner, s, new), new)

    def predict(k: AroundParameters, s: Array, m: Measurement, u: Array) -> Array:
        new = predict_inside(k.inner, s, m, u)
        return np.where(m.t_step < k.own.until, freeze(k.inner, s, new), new)

    return passed_on(inner)._replace(correct=correct, predict=predict)


@dataclass(frozen=True)
class Freeze(ContactWindow):
    """xi^ of `inner` stays as it is for `window` seconds after touchdown.

    Raises InputError for a controller without an observer that says which of its states are xi^.
    """

    def __post_init__(self) -> None:
        super().__post_init__()
        if controller_laws(self.inner).freeze is None:
            raise InputError(
                f"{type(self.inner).__name__} has no disturbance that could be frozen; expected a controller "
                "with an observer whose laws have `freeze`, such as ADRCController"
            )

    def around(self, inner: ControllerLaws) -> ControllerLaws:
        return freezing(inner)
