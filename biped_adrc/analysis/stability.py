"""Whether a walking cycle is stable: its multipliers by two methods side by side, and which to trust.

P is the return map from just before one impact to just before the next, s (k,) [rad, rad/s] its point. The
multipliers of a cycle, P(s) = s, are the eigenvalues lambda of dP/ds; it is stable if all |lambda| < 1.

    variational             eigenvalues of dP/ds by the variational equation, no differences
    central differences     eigenvalues of dP/ds by differences of the return map at two widths d and d / 2,
                            extrapolated: (4 J(d/2) - J(d)) / 3 is dP/ds up to d^4 and round-off / d

Both find dP/ds in independent ways, so their agreement is evidence. A method that doubts its own result
says why (`MethodRow.doubt`). Two sets of multipliers are compared in pairs, one from each set. Of all ways to
make pairs that one is taken whose sum of distances is least; distances are divided by the tolerance.
`studies.cycle_stability` makes the table.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
from scipy.linalg import eig
from scipy.optimize import linear_sum_assignment

from biped_adrc.analysis.return_map import ReturnMap, sorted_eigenvalues
from biped_adrc.analysis.variational import StepDerivative
from biped_adrc.columns import columns
from biped_adrc.errors import InputError
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.hybrid.constants import XRTOL, XTOL
from biped_adrc.model.biped import Biped
from biped_adrc.shown import Shown
from biped_adrc.types import Array, ComplexArray


class StabilityMethod(Enum):
    """How multipliers were found; the values are the names in the table."""

    VARIATIONAL = "variational equation"
    CENTRAL = "central differences"


RELATIVE, ABSOLUTE = 1e-6, 1e-7
"""Two multipliers agree within the first of the larger one, or within the second."""
FLOW = 1e-5
"""The largest `StepDerivative.flow_residual` with which the variational equation is trusted."""
INVARIANCE = 1e-6
"""The largest `invariance_gap` with which a constraint counts as hybrid invariant [rad, rad/s]."""
CYCLE = 1e-8
"""The largest |P(s) - s| of a step whose eigenvalues count as multipliers [rad, rad/s]."""


@dataclass(frozen=True)
class MethodRow(Shown):
    """Multipliers by one method."""

    method: StabilityMethod
    """How they were found."""
    multipliers: ComplexArray
    """(k,), the largest magnitude first."""
    uncertainty: float = 0.0
    """Error of each multiplier by the method's own estimate; 0 where it has none. Of central differences:
    the largest change by the extrapolation.
    """
    noise: Array | None = None
    """Bound (k,) of the numerical error, for each multiplier of the variational equation in their order; of
    central differences only, see `noise_of_differences`.
    """
    doubt: str = ""
    """Why the method is not to be trusted; empty when it is."""

    @property
    def magnitudes(self) -> Array:
        """|lambda| (k,), the largest first."""
        return np.abs(self.multipliers)


@dataclass(frozen=True)
class StabilityTable(Shown):
    """One row per method; `verdict` says whether they agree and which to trust.

    Raises InputError for multipliers that are not finite.
    """

    rows: tuple[MethodRow, ...]

    def __post_init__(self) -> None:
        for row in self.rows:
            if not (len(row.multipliers) and np.all(np.isfinite(row.multipliers))):
                raise InputError(
                    f"{row.method.value}: found multipliers {row.multipliers}, expected finite numbers"
                )

    @property
    def trusted(self) -> MethodRow:
        """The variational equation, or central differences where that is in doubt.

        Raises InputError when no row is left.
        """
        for method in (StabilityMethod.VARIATIONAL, StabilityMethod.CENTRAL):
            for row in self.rows:
                if row.method is method and not row.doubt:
                    return row
        doubts = "; ".join(f"{r.method.value}: {r.doubt}" for r in self.rows)
        raise InputError(f"no method gives the multipliers without a doubt ({doubts})")

    @property
    def stable(self) -> bool:
        """Whether all trusted multipliers are inside the unit circle."""
        return bool(np.max(self.trusted.magnitudes) < 1.0)

    @property
    def agree(self) -> bool:
        """Whether every other method without a doubt agrees with the trusted one."""
        trusted = self.trusted
        others = (row for row in self.rows if row is not trusted and not row.doubt)
        return all(self.gap(row) <= 1.0 for row in others)

    def gap(self, row: MethodRow) -> float:
        """Largest distance of a row to the trusted one in units of the tolerance; at most 1 when they agree.

        Infinite for a row that has not as many multipliers as the trusted one.
        """
        ratio = _distances(row.multipliers, self.trusted.multipliers, row.noise)
        if ratio.shape[0] != ratio.shape[1]:
            return float("inf")
        return _farthest(ratio)

    @property
    def verdict(self) -> str:
        """One sentence for each other row, then which row to trust. Raises InputError as `trusted` does."""
        trusted = self.trusted
        said = [self._sentence(row) for row in self.rows if row is not trusted]
        name, end = trusted.method.value, "stable" if self.stable else "not stable"
        largest = np.max(trusted.magnitudes)
        said.append(f"Trust the {name}: the cycle is {end}, the largest |lambda| is {largest:.6f}.")
        return " ".join(said)

    def _sentence(self, row: MethodRow) -> str:
        """What one row says relative to the trusted one."""
        name = row.method.value[:1].upper() + row.method.value[1:]
        if row.doubt:
            return f"{name}: not to be trusted, {row.doubt}."
        gap = self.gap(row)
        within = f"{RELATIVE:g} relative or {ABSOLUTE:g} absolute"
        if row.noise is not None and np.isfinite(gap):
            plain = _farthest(_distances(row.multipliers, self.trusted.multipliers))
            if plain > 1.0 or gap > 1.0:
                within += (
                    f" or what root finder and step leave open, at most {np.max(row.noise):.1e}"
                )
        if gap <= 1.0:
            return f"{name}: agrees within {within}."
        if not np.isfinite(gap):
            return (
                f"{name}: has {len(row.multipliers)} multipliers, the {self.trusted.method.value} "
                f"{len(self.trusted.multipliers)}; they are not of the same map."
            )
        why = self._limit(row)
        return f"{name}: disagrees, {gap:.3g} times the tolerance of {within}{why}."

    def _limit(self, row: MethodRow) -> str:
        """Why a row disagrees with the trusted one, as the end of a sentence; empty where nothing is known."""
        if row.method is not StabilityMethod.CENTRAL or row.uncertainty == 0.0:
            return ""
        distance = _farthest(np.abs(row.multipliers[:, np.newaxis] - self.trusted.multipliers))
        if distance <= 2.0 * row.uncertainty:
            return (
                f"; they differ by {distance:.1e}, and the extrapolation changes them by "
                f"{row.uncertainty:.1e}: the differences are the limit"
            )
        return (
            f"; they differ by {distance:.1e}, which is more than the {row.uncertainty:.1e} that the "
            "extrapolation changes: one of the two is wrong, or the step of the method is too long"
        )

    def text(self, count: int = 9) -> str:
        """The table as lines of text, the `count` largest |lambda| of each row, and the verdict."""
        rows = [
            (row.method.value, " ".join(f"{m:.6e}" for m in row.magnitudes[:count]))
            for row in self.rows
        ]
        return "\n".join([*columns(rows, 28, gap=1), self.verdict])


def _distances(one: ComplexArray, other: ComplexArray, noise: Array | None = None) -> Array:
    """Distance of every multiplier of one set to every one of the other; at most 1 where they agree.

    one (k,), other (l,) -> (k, l): |one_i - other_j| divided by the largest of the absolute tolerance, the
    relative one, and noise (l,), what errors of computing may do to each of `other`.
    """
    a, b = one[:, np.newaxis], other[np.newaxis]
    allowed = np.maximum(ABSOLUTE, RELATIVE * np.maximum(np.abs(a), np.abs(b)))
    if noise is not None:
        allowed = np.maximum(allowed, noise)
    return np.abs(a - b) / allowed


def _farthest(cost: Array) -> float:
    """The largest cost of a pair when rows and columns of `cost` (k, k) are paired at least total cost."""
    return float(np.max(cost[linear_sum_assignment(cost)]))


# -- rows ------------------------------------------------------------------------------------------
def variational_row(step: StepDerivative) -> MethodRow:
    """The row of the variational equation.

    Doubted when Phi f(0) is not f-, the flow before the next impact, see `StepDerivative.flow_residual`.
    """
    doubt = ""
    if not step.flow_residual <= FLOW:
        doubt = (
            f"its Phi carries the flow along to {step.flow_residual:.1e} only, expected "
            f"{FLOW:g}: take a shorter step, or look whether the flow depends on time"
        )
    return MethodRow(StabilityMethod.VARIATIONAL, step.multipliers, doubt=doubt)


def noise_of_differences(P: ReturnMap, step: StepDerivative) -> Array:
    """Bound (k,) of |delta lambda_i|, by which differences and variational equation may differ numerically.

    Two errors, with f- = d(q, q')/dt just before impact, in the coordinates of s. The root finder may be wrong
    by tau [s] in the time t of the impact, so an image P(s) by f- tau; column j of (4 J(d/2) - J(d)) / 3 is
    then wrong by f- eta_j, |eta_j| <= 3 tau / d. And dP/ds has the part f- dt/ds, in which differences see f-
    with the relative error r = `StepDerivative.flow_residual` of the integration method. To first order, with
    left and right eigenvectors y_i, x_i, |.| entry by entry for vectors, and |.|_1 the sum of absolute values,

        |y_i x_i| |delta lambda_i| <= |y_i f-| (3 tau / d |x_i|_1 + r |dt/ds| |x_i|)
    """
    values, left, right = eig(step.jacobian, left=True, right=True)
    y, size = left.conj().T, np.abs(right)
    late = 3.0 * (XTOL + XRTOL * step.duration) / P.difference * np.sum(size, axis=0)
    late += step.flow_residual * np.abs(step.earlier) @ size
    noise: Array = np.abs(y @ step.end_flow) * late / np.abs(np.sum(left.conj() * right, axis=0))
    return noise[np.argsort(-np.abs(values))]


def central_row(P: ReturnMap, s: Array, step: StepDerivative | None = None) -> MethodRow:
    """The row of central differences at s (k,) [rad, rad/s], extrapolated from d = P.difference and d / 2.

    Its uncertainty is the distance to the multipliers of J(d/2) alone: it shows the error d^2 and round-off.
    step: the derivative at s; without it there is no noise.
    """
    wide, narrow = P.jacobian(s), replace(P, difference=0.5 * P.difference).jacobian(s)
    best, half = sorted_eigenvalues((4.0 * narrow - wide) / 3.0), sorted_eigenvalues(narrow)
    changes = _farthest(np.abs(best[:, np.newaxis] - half))
    noise = None if step is None else noise_of_differences(P, step)
    return MethodRow(StabilityMethod.CENTRAL, best, changes, noise)


def invariance_gap(biped: Biped, constraint: VirtualConstraint) -> float:
    """How far the state after impact is from the constraint q_b = h(Theta); zero for a hybrid invariant one.

    The larger of max |q_b+ - h(Theta+)| [rad] and max |q_b'+ - h' Theta'+| [rad/s], after an impact at the end
    of the constraint with |Theta'-| = 1 rad/s.
    """
    zero = ZeroDynamics.of(biped, constraint)
    q, v = zero.end_state(1.0)
    c, p = constraint.phase, biped.p
    after = biped.impact(q, v / abs(float(c @ v)))
    h, slope, _ = constraint.h(float(c @ after.q))
    position = np.max(np.abs(after.q[:p] - h))
    velocity = np.max(np.abs(after.v[:p] - slope * float(c @ after.v)))
    return float(max(position, velocity))


def stability_table(
    P: ReturnMap,
    step: StepDerivative,
) -> StabilityTable:
    """The table at the fixed point of `step`, as `variational.periodic_orbit` finds it.

    Central differences of P cost 4 steps of walking per coordinate. Raises InputError when |P(s) - s| of the
    step is above `CYCLE`: its eigenvalues are then no multipliers.
    """
    gap = float(np.max(np.abs(step.image - step.s)))
    if gap > CYCLE:
        raise InputError(
            f"P(s) - s is {gap:.3g} at this step, expected a fixed point within {CYCLE:g}; find it "
            "with variational.periodic_orbit"
        )
    return StabilityTable((variational_row(step), central_row(P, step.s, step)))
