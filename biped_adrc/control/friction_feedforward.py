"""Friction feedforward around any controller: the nominal joint friction at the rates of the reference.

    u = u_i + F,   F = share (viscous q_d' + static tanh(q_d' / w))

u_i is what the controller inside asks for, q_d' the rates of a reference at the measured (Theta, Theta'), and w
the width of the plant's own smoothed sign, `model.biped.STICTION_SPEED`. Rates that are measured would carry
the steps of encoders through static friction, which changes its sign with them; those of the reference are
smooth, and with a small tracking error they are the same.

The controller inside is told u - F, where u is the torque that acts. So it lives in a world with F taken off
the friction: after a saturation too, and its observer finds what is left,

    q_b'' = xi + kappa u = (xi + kappa F) + kappa (u - F)

Told u, its xi^ would contain all of the friction, which would then be compensated twice. `estimate` gives xi.
share = 1 is the friction of the robot's record, 0 the controller inside, bit for bit.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.control.around import Around, AroundParameters, passed_on
from biped_adrc.control.base import Controller, ControllerLaws, Measurement
from biped_adrc.errors import InputError
from biped_adrc.gait.reference import Reference, ReferencePoint
from biped_adrc.model.biped import STICTION_SPEED, Biped
from biped_adrc.observers.base import Estimate
from biped_adrc.types import Array


class FrictionParameters(NamedTuple):
    """h: the reference. viscous (p,) [N m s/rad], static (p,) [N m]: times the share."""

    h: Reference
    viscous: Array
    static: Array


def friction(k: FrictionParameters, r: ReferencePoint) -> Array:
    """F (p,) [N m] at the rates of the reference's point r."""
    return k.viscous * r.dq_d + k.static * np.tanh(r.dq_d / STICTION_SPEED)


@lru_cache(maxsize=64)
def feeding(inner: ControllerLaws) -> ControllerLaws:
    """The laws of `FrictionFeedforward` around these."""

    def fed(k: AroundParameters, m: Measurement) -> Array:
        return friction(k.own, k.own.h(m.t, m.q, m.v))

    def output(k: AroundParameters, s: Array, m: Measurement) -> Array:
        return inner.output(k.inner, s, m) + fed(k, m)

    def less(law: Callable[..., Array]) -> Callable[..., Array]:
        def told(k: AroundParameters, s: Array, m: Measurement, u: Array) -> Array:
            return law(k.inner, s, m, u - fed(k, m))

        return told

    def estimate(k: AroundParameters, s: Array, m: Measurement) -> Estimate | None:
        assert inner.estimate is not None
        x = inner.estimate(k.inner, s, m)
        if x is None:
            return None
        return x._replace(disturbance=x.disturbance - m.terms.kappa @ fed(k, m))

    laws: dict[str, Any] = {"output": output}
    for name, law in (("flow", inner.flow), ("predict", inner.predict)):
        if law is not None:
            laws[name] = less(law)
    if inner.estimate is not None:
        laws["estimate"] = estimate
    return passed_on(inner)._replace(**laws)


@dataclass(frozen=True)
class FrictionFeedforward(Around):
    """The module's F beside the torque of `inner`.

    path: the reference whose rates are taken; corrections of an outer loop are not in them. viscous
    [N m s/rad], static [N m]: one number for each motor. Raises InputError for numbers that are not finite.
    """

    path: Reference
    viscous: tuple[float, ...]
    static: tuple[float, ...]
    share: float = 1.0

    def __post_init__(self) -> None:
        for x in (*self.viscous, *self.static, self.share):
            if not (math.isfinite(x) and x >= 0.0):
                raise InputError(
                    f"friction feedforward has viscous = {self.viscous}, static = {self.static}, share = "
                    f"{self.share}, expected finite numbers, none of them below 0"
                )

    @property
    def own(self) -> FrictionParameters:
        viscous, static = np.array(self.viscous, dtype=float), np.array(self.static, dtype=float)
        return FrictionParameters(self.path, self.share * viscous, self.share * static)

    def around(self, inner: ControllerLaws) -> ControllerLaws:
        return feeding(inner)


def friction_feedforward(
    inner: Controller, reference: Reference, biped: Biped, feedforward: float
) -> Controller:
    """`FrictionFeedforward` of the joint friction in the robot's record, with the share `feedforward`.

    It does not matter whether the robot was loaded with friction. Raises InputError for a record without.
    """
    viscous, static = (x[: biped.p] for x in biped.friction_coefficients)
    if not (np.any(viscous) or np.any(static)):
        raise InputError(
            f"feedforward = {feedforward} of the joint friction of robot '{biped.description.name}', whose "
            "record has none; expected a table [friction] in its robot.toml, or feedforward = 0"
        )
    return FrictionFeedforward(
        inner, reference, tuple(viscous.tolist()), tuple(static.tolist()), feedforward
    )
