"""Errors of a model: masses, COMs, inertias and friction of the plant that differ from the nominal ones.

    m -> (1 + e_m) m     d -> (1 + e_d) d     J -> (1 + e_J) J     b -> (1 + e_f) b     F_c -> (1 + e_f) F_c

m is the mass, d the distance of the COM from the origin of the link's frame, J the inertia about the COM, b and
F_c the viscous and the static friction. The errors e are relative, chosen by hand or drawn from +-width,
uniform, with a seed, for studies of robustness. Both legs of a biped get the same errors, because relabelling
at impact needs equal legs; so errors go by body rather than by link: the body "thigh" is the links of both
thighs. Twins are a joint and its counterpart in the other leg. `ModelErrors.apply` makes the plant; the
controller keeps the robot without errors as nominal model.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from math import inf, isfinite
from typing import Annotated, Self

import numpy as np

from biped_adrc.core.checks import Checked, each
from biped_adrc.core.errors import ModelError
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array
from biped_adrc.model.biped import Biped

# ranges of fields {name: error}: finite errors; those that leave more than nothing; those that leave 0 or more
FINITE = each("finite numbers by name", isfinite)
ABOVE = each("finite numbers above -1 by name, such as {'torso': 0.2}", lambda e: -1.0 < e < inf)
NOT_BELOW = each("finite numbers, none below -1, by name", lambda e: -1.0 <= e < inf)


@dataclass(frozen=True)
class ModelErrors(Checked, Shown):
    """Relative errors of a model, dimensionless: 0.1 is ten per cent more.

    Raises InputError for an error that is not finite, or that leaves no mass or inertia, or negative friction.

    >>> errors = ba.ModelErrors(mass={"torso": 0.2})
    >>> round(errors.apply(biped).mass / biped.mass, 3)
    1.075
    """

    mass: Annotated[Mapping[str, float], ABOVE] = field(default_factory=dict)
    """Errors of the mass [1], by body or link; the inertia about the COM is not scaled with it."""
    com: Annotated[Mapping[str, float], FINITE] = field(default_factory=dict)
    """Errors of the distance of the COM from the link's origin [1], by body or link."""
    inertia: Annotated[Mapping[str, float], ABOVE] = field(default_factory=dict)
    """Errors of the inertia about the COM [1], by body or link."""
    friction: Annotated[Mapping[str, float], NOT_BELOW] = field(default_factory=dict)
    """Errors of viscous and static friction alike [1], by joint."""

    @classmethod
    def drawn(
        cls,
        biped: Biped,
        seed: int,
        mass: float = 0.1,
        com: float = 0.1,
        inertia: float = 0.1,
        friction: float = 0.3,
    ) -> Self:
        """Draw errors of every body, each uniform from -width to width, by a seed.

        mass, com, inertia, friction: the widths, dimensionless. Twin joints of both legs get one error. Errors
        of friction are drawn if the robot was loaded with friction, for the joints that have some. The errors
        depend on the seed and on the bodies, in their order. Raises InputError for widths with which a mass or
        an inertia may vanish.
        """
        random = np.random.default_rng(seed)
        bodies = tuple(biped.description.links)
        errors = (random.uniform(-width, width, len(bodies)) for width in (mass, com, inertia))
        m, d, J = (dict(zip(bodies, e.tolist(), strict=True)) for e in errors)
        pairs = list(_rubbing(biped))  # joints with friction; twins together
        drawn = random.uniform(-friction, friction, len(pairs)).tolist()
        by_pair = zip(pairs, drawn, strict=True)
        return cls(m, d, J, {joint: e for pair, e in by_pair for joint in pair})

    @classmethod
    def of_friction(cls, biped: Biped, error: float) -> Self:
        """The same relative error [1] of friction in all joints with friction. Where there is none, `apply` of
        the result raises ModelError.
        """
        # _rubbing: the joints with friction, twins as a pair
        joints = [joint for pair in _rubbing(biped) for joint in pair]
        # no joint has the name "its joints": `apply` refuses it, in a sentence that contains it
        return cls(friction=dict.fromkeys(joints or ["its joints"], error))

    def apply(self, biped: Biped) -> Biped:
        """A copy of `biped` with these errors, the plant. Raises ModelError for an unknown body or joint, for a
        joint without friction, twin joints that have not the same error, or legs that become unequal.
        """
        # errors, factors: of bodies by name, for each of these three
        errors = {"mass": self.mass, "com": self.com, "inertia": self.inertia}
        factors = {k: {x: 1.0 + e for x, e in of.items()} for k, of in errors.items()}
        tree, d = biped.scaled(factors), biped.description
        # pairs: the joints with friction, twins together, a joint without a twin alone
        pairs = list(_rubbing(biped))
        unlike = [pair for pair in pairs if len({self.friction.get(name) for name in pair}) > 1]
        if unlike or set(self.friction) - {name for pair in pairs for name in pair}:
            raise ModelError(
                f"robot '{d.name}': errors of friction in {list(self.friction)}, expected them in joints with "
                f"friction, and the same one for both joints of a pair: {pairs}. A robot has friction where it "
                "is loaded with friction=True"
            )
        viscous, static = (
            {name: (1.0 + self.friction.get(name, 0.0)) * x for name, x in coefficients.items()}
            for coefficients in (d.viscous, d.static)
        )
        d = replace(d, viscous=viscous, static=static)
        return replace(biped, tree=tree, description=d).check()


def impact_error(seed: int, spread: float, n: int) -> Array:
    """Relative errors e (n,) [1] of the rates after impact, each uniform from -spread to spread, by a seed.

    The plant's impact then leaves (1 + e) q'+, entry by entry, in place of the rates q'+ [rad/s] of the plastic
    impact.
    """
    return np.random.default_rng(seed).uniform(-spread, spread, n)


def _rubbing(biped: Biped) -> Iterator[tuple[str, ...]]:
    """Iterate over the joints with friction: (joint, its twin in the other leg), or (joint,) where the twin is
    the joint itself or has no friction; nothing where the robot was loaded without friction.
    """
    joints, d = biped.description.joints, biped.description
    rubs = [biped.friction and bool(d.viscous.get(x) or d.static.get(x)) for x in joints]
    for i, joint in enumerate(joints):
        twin = int(np.argmax(np.abs(biped.R[i])))  # of a knee the other knee, of a spine itself
        # the first of two twins yields the pair, the second nothing
        if rubs[i] and (twin >= i or not rubs[twin]):
            yield (joint, joints[twin]) if twin > i and rubs[twin] else (joint,)
