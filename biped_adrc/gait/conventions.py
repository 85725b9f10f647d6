"""Angle conventions of a planar biped with a torso and two legs, as affine maps to that of the paper.

    q = A q' + b,   v = A v',   tau' = A^T tau

q' are the coordinates of another convention, in its own order, v' their rates and tau' the torques on them; '
is no derivative here. q = (stance hip, swing hip, stance knee, swing knee, torso), v and tau are the paper's:
absolute angles counter-clockwise positive with x to the right and z up, a link of absolute angle a pointing
along (-sin a, cos a) away from the hip. Power is the same in both: tau' v' = tau v. A walker without knees has
the same conventions without the coordinates of the shins.

Where a convention names the legs by side, left and right (FROST), the right one is the stance leg here; for a
step on the left leg the coordinates of the two legs have to be exchanged as well.

The conventions are data, in `conventions.toml` beside this module. `exchange` uses them to bring gaits of other
groups into the paper's coordinates and back; inside the package all angles are the paper's.

Entries of a convention in the file, for a robot with knees (five coordinates):

    coordinates          names, in the convention's order
    A, half_turns        q = A q' + b with b = pi half_turns
    knees, outputs       places of the knees, and of the coordinates that are a gait's usual outputs, from 0
    sense                +1 if the phase falls in a walk to +x, -1 if it grows
    source               publication or program
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from biped_adrc.core.errors import GaitError
from biped_adrc.core.files import packaged
from biped_adrc.core.types import Array, read_only
from biped_adrc.model.biped import Biped

_KNEES = (2, 3)  # places of the knees among the paper's coordinates
_PHASE = (1.0, 0.0, 0.5, 0.0, 1.0)  # Theta = q5 + q1 + q3 / 2


@dataclass(frozen=True)
class AngleMap:
    """The affine map q = A q' + b of angles."""

    A: Array
    """(n, n), invertible [rad/rad]."""
    b: Array
    """(n,) [rad]."""

    def __post_init__(self) -> None:
        for name in ("A", "b"):
            object.__setattr__(self, name, read_only(getattr(self, name)))

    def angles(self, q: Array) -> Array:
        """A q + b [rad] of angles q (n,) [rad], or of each row of q (K, n)."""
        return self.rates(q) + self.b

    def rates(self, v: Array) -> Array:
        """A v of rates v (n,) [rad/s] or accelerations, or of each row of v (K, n)."""
        return v @ self.A.T  # A v, row by row

    @cached_property
    def inverse(self) -> AngleMap:
        """The inverse map, q' = A^-1 (q - b)."""
        inverse: Array = np.asarray(np.linalg.inv(self.A), dtype=np.float64)
        return AngleMap(inverse, -inverse @ self.b)


@dataclass(frozen=True)
class Convention:
    """One angle convention of a planar biped with n coordinates, in its own order."""

    name: str
    coordinates: tuple[str, ...]
    """Names of the coordinates, in the convention's order."""
    to_paper: AngleMap
    """q of the paper from q' of this convention."""
    outputs: Array
    """H0 (rows, n): the rows of a gait's curve are the outputs H0 q', unless the gait says otherwise."""
    sense: float
    """+1 if its phase falls while the robot walks to +x, as the paper's Theta, -1 if it grows."""
    paper_phase: Array
    """Row (n,) of the paper's phase, Theta = paper_phase q."""

    @property
    def n(self) -> int:
        """Number of coordinates."""
        return len(self.coordinates)

    @cached_property
    def phase(self) -> Array:
        """Row c' (n,) of this convention's own phase: c' q' = sense (Theta - paper_phase b) [rad]."""
        return self.sense * self.paper_phase @ self.to_paper.A + 0.0  # + 0.0 makes -0.0 to 0.0


OWN = "own"
"""Name of the convention of a robot's own coordinates, whatever they are."""


def of_the_paper(biped: Biped) -> bool:
    """Whether phase and relabelling (exchange of the legs' coordinates at impact) of a robot are the paper's,
    with knees (n = 5) or without (n = 3)."""
    if biped.n not in (3, 5):
        return False
    # without knees, the coordinates 2 and 3 of the paper are left out
    paper = [i for i in range(5) if biped.n == 5 or i not in _KNEES]
    # the paper's relabelling exchanges the hips and the knees, its phase is Theta = q5 + q1 + q3 / 2
    R = np.eye(5)[[1, 0, 3, 2, 4]][np.ix_(paper, paper)]
    same = np.array_equal(biped.R, R) and np.array_equal(biped.phase, np.array(_PHASE)[paper])
    # relabelling is q+ = R q- + r: of q- = 0 it gives r, which is zero in the paper
    return bool(same and not np.any(biped.relabel(np.zeros(biped.n))))


def layout_of(name: str, biped: Biped) -> Convention:
    """The convention of this name for a robot; the name "own" means the robot's coordinates as they are:
    `to_paper` is the identity, the outputs are its p actuated joints, and the phase is that of its record
    (robot.toml), with its sign (`sense` 1).

    Raises GaitError for an unknown name, or a robot with other coordinates or another phase.
    """
    n, p, d = biped.n, biped.p, biped.description
    if name == OWN:
        same = AngleMap(np.eye(n), np.zeros(n))
        # name, coordinates, map to the paper's angles, outputs, sense, row of the phase
        return Convention(OWN, d.joints, same, np.eye(p, n), 1.0, np.array(d.phase))
    result = convention(name, knees=n == 5)
    if not of_the_paper(biped):
        raise GaitError(
            f"robot '{d.name}' has the coordinates {list(d.joints)} and the phase {list(d.phase)}, which are "
            f"not laid out as convention '{name}' has them; take convention 'own', the coordinates of its "
            "record"
        )
    return result


def convention(name: str, knees: bool = True) -> Convention:
    """The convention of this name from the file, for a walker with knees (5 coordinates) or without (3).

    Raises GaitError with the known names.
    """
    if name not in CONVENTIONS:
        raise GaitError(f"there is no angle convention '{name}'; choose one of {list(CONVENTIONS)}")
    d = _definitions[name]
    # places of the coordinates that this walker has: in the paper's order, and in the convention's own
    paper = [i for i in range(5) if knees or i not in _KNEES]
    own = [i for i in range(5) if knees or i not in d["knees"]]
    rows = [r for r in d["outputs"] if r in own]  # places of the outputs among its coordinates
    A, b = np.array(d["A"])[np.ix_(paper, own)], np.pi * np.array(d["half_turns"])[paper]
    H0, coordinates = np.eye(5)[np.ix_(rows, own)], tuple(d["coordinates"][i] for i in own)
    c = np.array(_PHASE)[paper]  # row of the paper's phase Theta = q5 + q1 + q3 / 2
    return Convention(name, coordinates, AngleMap(A, b), H0, d["sense"], c)


_definitions = packaged("biped_adrc.gait", "conventions.toml")

CONVENTIONS: tuple[str, ...] = tuple(_definitions)
"""Names for `convention`."""
