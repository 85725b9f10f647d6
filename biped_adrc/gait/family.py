"""A family of gaits: one smooth map from (speed, step length) to a virtual constraint, and what its steps do.

    (alpha, Theta-) = polynomials in (v, L),   h = Bezier of alpha at s = (Theta - Theta+) / (Theta- - Theta+)

    v       speed [m/s]
    L       step length [m]
    h       angles (p,) [rad] of the joints with motors; alpha: its coefficients (p, M + 1)
    Theta   phase c q [rad], Theta+ at the start of the step, Theta- just before the impact at its end

The gait at one (v, L) is a *member* of the family. The map is fitted to a library of designed gaits
(`analysis.family_design`). It gives Theta+ of the periodic walk too, but a step that follows one of another
length begins in another posture: in the s of such a step Theta+ is the phase at which it really began.

In each step the controller `control.footstep` decides on which member the step ends; the *decision* falls where
Theta has gone the share DECISION = 0.35 of its way. y = sigma^2 at the decision goes from step to step by

    y_next = delta^2 (y + 2 W + 2 r J) + 2 W' + 2 r J',   W = int -G_N I dTheta,   J = int I dTheta

    sigma   I Theta', the angular momentum about the stance foot [kg m^2/s]; I: inertia [kg m^2]
    G_N     gravity's torque on the unactuated row, that of the coordinate without a motor [N m]
    r       constant torque from outside on that row [N m]
    delta   sigma just after the impact over sigma just before it [1]
    W, J    integrals from the decision to the impact; W', J' from the impact to the next decision

`StepMap` has delta^2, 2 W, J, 2 W', J' as polynomials too, y at the decision of the periodic walks, and the
slowest and the fastest member on which a step may end.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import product
from pathlib import Path
from typing import Any, Self

import numpy as np
from scipy.optimize import linprog

from biped_adrc.core.errors import GaitError
from biped_adrc.core.files import output_path, plain, reading, write_json
from biped_adrc.core.part import SETUP, Part, setup
from biped_adrc.core.types import Array, freeze, read_only
from biped_adrc.gait.constraint import FADE, VirtualConstraint, past_end
from biped_adrc.gait.curves import Bezier, bernstein_to_power
from biped_adrc.gait.gait import stored_file
from biped_adrc.model.biped import Biped

_FORMAT = "biped_adrc family 4"
"""First entry of a family's file."""
DECISION = 0.35
"""Share of a walking step, in Theta, at which `control.footstep` decides on which member the step ends."""


@dataclass(frozen=True)
class PolynomialMap(Part):
    """y(x) = sum_k c_k prod_i z_i^e_ki with z = (x - centre) / scale; x (d,), y (m,)."""

    powers: tuple[tuple[int, ...], ...]
    """Exponents e (K, d) of the K monomials."""
    coefficients: Array
    """c (K, m), in the units of y."""
    centre: Array
    """Middle of the range of x (d,), in its units."""
    scale: Array
    """Half width of the range of x (d,), in its units."""

    def __post_init__(self) -> None:
        freeze(self, "coefficients", "centre", "scale")

    def __call__(self, x: Array) -> Array:
        """y (m,) at x (d,)."""
        z = (x - self.centre) / self.scale
        terms = []
        for exponents in self.powers:
            term = 1.0
            for z_i, e in zip(z, exponents, strict=True):
                term = term * z_i**e if e else term  # z^0 = 1 is left out of the product
            terms.append(term)
        return np.array(terms) @ self.coefficients

    @classmethod
    def fit(cls, x: Array, y: Array, degree: int) -> Self:
        """The least-squares fit to N points x (N, d), y (N, m), with all monomials up to a total degree."""
        monomials, A = cls._monomials(x, degree)
        return replace(monomials, coefficients=read_only(np.linalg.lstsq(A, y, rcond=None)[0]))

    @classmethod
    def above(cls, x: Array, y: Array, degree: int) -> Self:
        """The polynomials of least sum over N points x (N, d) that are nowhere below y (N, m) there."""
        monomials, A = cls._monomials(x, degree)
        c = [linprog(A.sum(axis=0), -A, -column, bounds=(None, None)).x for column in y.T]
        return replace(monomials, coefficients=np.transpose(c))

    @classmethod
    def _monomials(cls, x: Array, degree: int) -> tuple[Self, Array]:
        """All K monomials up to a total degree over the range of N points x (N, d), and their values (N, K)."""
        low, high = x.min(axis=0), x.max(axis=0)
        powers = tuple(e for e in product(range(degree + 1), repeat=x.shape[1]) if sum(e) <= degree)
        # coefficients I give the values of the monomials themselves
        result = cls(powers, np.eye(len(powers)), 0.5 * (low + high), 0.5 * (high - low))
        return result, np.array([result(row) for row in x])


@dataclass(frozen=True)
class StepMap(Part):
    """The module's map of y = sigma^2 from decision to decision."""

    to_impact: PolynomialMap
    """(v at the start, v at the end, L of the step before, L) -> 2 W [kg^2 m^4/s^2], J [kg m^2]."""
    to_decision: PolynomialMap
    """(v, L of the step before, L, L of the next step) -> delta^2 of the impact, 2 W' [kg^2 m^4/s^2],
    J' [kg m^2], and dq_b/dTheta (p,) [rad/rad] just after the impact."""
    of_cycle: PolynomialMap
    """(mean speed [m/s], L) of a periodic walk -> y at its decision; the fit of the curves moves the mean speed
    of the member v by some per cent from v."""
    ends: PolynomialMap
    """(v, L) -> least and largest speed [m/s] of the member on which a step of length L may end that begins on
    the member v: beyond them the foot would slip, or a motor be too weak."""

    def next_square(self, y: float, begin: Array, end: Array, ahead: float, r: float) -> float:
        """y [kg^2 m^4/s^2] at the next step's decision, from y at this step's decision.

        begin: (speed of the member on which this step begins [m/s], length of the step before [m]). end: (speed
        of the member on which it ends, its length). ahead: length of the next step [m]. r: constant torque from
        outside on the unactuated row [N m].
        """
        # the two maps want their arguments in the order of the texts below the fields
        twice_W, J = self.to_impact(np.array((begin[0], end[0], begin[1], end[1])))
        after = self.to_decision(np.array((end[0], begin[1], end[1], ahead)))
        delta2, twice_W_next, J_next = after[0], after[1], after[2]
        return delta2 * (y + twice_W + 2.0 * r * J) + twice_W_next + 2.0 * r * J_next

    def cycle_square(self, v: float, L: float, r: float = 0.0) -> float:
        """y [kg^2 m^4/s^2] at the decision in the periodic walk of the member (v [m/s], L [m]) under the torque
        r [N m]: the fixed point of `next_square`.
        """
        mu = np.array((v, L))
        # next_square is y -> delta^2 y + next_square(0), whose fixed point is next_square(0) / (1 - delta^2)
        return self.next_square(0.0, mu, mu, L, r) / (1.0 - self.delta_squared(v, L))

    def delta_squared(self, v: float, L: float) -> float:
        """delta^2 [1] of the impact in the periodic walk of the member (v [m/s], L [m])."""
        # in a periodic walk the steps before and after have the same length
        return self.to_decision(np.array((v, L, L, L)))[0]


@dataclass(frozen=True)
class GaitFamily(Part):
    """Gaits of one robot by mu = (speed [m/s], step length [m]) between `low` and `high`.

    p motors, n = p + 1 coordinates; alpha (p, M + 1) are the Bezier coefficients of h. `member` and `check`
    raise GaitError for a mu out of this range; `curve` and `h` do not check it.
    """

    name: str
    robot: str
    preset: str
    """Robot and preset that it was made for."""
    curves: PolynomialMap
    """mu -> Bezier coefficients alpha (p, M + 1) in one row, Theta+ of the periodic gait, Theta- [rad]."""
    steps: StepMap
    """sigma^2 from decision to decision."""
    phase: Array
    """c (n,) of Theta = c q."""
    low: Array
    """Least (speed, step length) (2,)."""
    high: Array
    """Largest (speed, step length) (2,)."""
    members: tuple[tuple[float, ...], ...] = setup(())
    """For each designed gait to which the family is fitted: speed [m/s], step length [m], friction that it
    needs [1], peak torque [N m], least F_N [N]."""
    provenance: Mapping[str, object] = field(default_factory=dict, metadata=SETUP)

    def __post_init__(self) -> None:
        for name in ("phase", "low", "high"):  # lists, where a file was read
            object.__setattr__(self, name, read_only(getattr(self, name)))

    def curve(self, mu: Array) -> tuple[Array, float, float]:
        """alpha (p, M + 1) [rad], Theta+ and Theta- [rad] of the member mu, in its periodic gait."""
        y = self.curves(mu)  # alpha in one row, Theta+, Theta-
        return y[:-2].reshape(len(self.phase) - 1, -1), y[-2], y[-1]

    def h(self, mu: Array, plus: float, theta: float) -> tuple[Array, Array, Array]:
        """h [rad], dh/dTheta, d2h/dTheta2, each (p,), at theta [rad], in a step along the member mu that began
        at Theta = plus [rad] and ends at the member's Theta-; past both ends as in `constraint.continued`.
        """
        alpha, _, minus = self.curve(mu)
        a, rate = alpha @ bernstein_to_power(alpha.shape[1] - 1), 1.0 / (minus - plus)
        k, s = np.arange(a.shape[1]), rate * (theta - plus)
        x = np.minimum(np.maximum(s, 0.0), 1.0)
        # h = sum_k a_k x^k and its derivatives; x is s, kept in [0, 1]
        dh, ddh = a[:, 1:] @ (k[1:] * x ** k[:-1]), a[:, 2:] @ (k[2:] * k[1:-1] * x ** k[:-2])
        # s - x is the way past an end; FADE: the curvature fades out over 1 % of the range of Theta
        h, dh, ddh = past_end(s - x, FADE, a @ x**k, dh, ddh)
        return h, rate * dh, rate * rate * ddh

    def member(self, speed: float, step: float) -> VirtualConstraint:
        """The constraint of a speed [m/s] and a step length [m]. Raises GaitError outside of the range."""
        self.check(speed, step)
        alpha, plus, minus = self.curve(np.array((speed, step)))
        return VirtualConstraint(Bezier(alpha), self.phase, float(plus), float(minus))

    def check(self, speed: float, step: float) -> None:
        """Raise GaitError, with the nearest member, for a speed [m/s] or step length [m] out of range."""
        mu = np.array((speed, step))
        near = np.minimum(np.maximum(mu, self.low), self.high)
        if not np.all(np.abs(mu - near) <= 1e-9):  # round-off is no error
            raise GaitError(
                f"family '{self.name}' has no member of {speed:g} m/s with a step of {step:g} m; the nearest "
                f"has {near[0]:g} m/s and {near[1]:g} m"
            )

    def save(self, path: Path | str) -> None:
        """Write the JSON file. Raises InputError for a name that does not end in .json, and OutputError."""
        write_json({"format": _FORMAT, **plain(self)}, output_path(path, (".json",)))


def load_family(family: str | Path, biped: Biped) -> GaitFamily:
    """A stored family by name for this robot and preset, or by the path of its .json file.

    Raises GaitError for one that is not there, is damaged, or was made for another robot.
    """
    robot, preset = biped.description.name, biped.preset
    path = stored_file("family", family, biped, "families")
    with reading("family file", path, GaitError):
        result = _from_record(json.loads(path.read_text(encoding="utf-8")))
    if (result.robot, result.preset) != (robot, preset):
        raise GaitError(
            f"family '{result.name}' was made for robot '{result.robot}', preset '{result.preset}', and "
            f"this is '{robot}', '{preset}'"
        )
    return result


def _from_record(record: dict[str, Any]) -> GaitFamily:
    """The family from the content of its file; the dict `record` is changed on the way. Raises GaitError for
    another format, and KeyError or TypeError for damaged entries.
    """
    if record.pop("format") != _FORMAT:
        raise GaitError(f"it is no family, whose format is '{_FORMAT}'")

    def polynomial(x: Mapping[str, Any]) -> PolynomialMap:
        arrays = (np.array(x[name], dtype=float) for name in ("coefficients", "centre", "scale"))
        return PolynomialMap(tuple(map(tuple, x["powers"])), *arrays)

    record["curves"] = polynomial(record["curves"])
    record["steps"] = StepMap(**{name: polynomial(x) for name, x in record["steps"].items()})
    record["members"] = tuple(map(tuple, record["members"]))
    return GaitFamily(**record)
