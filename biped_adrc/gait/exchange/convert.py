"""Gaits between angle conventions, exactly: curves under affine maps of the angles and of the phase.

Curves are linear in their coefficients and Bernstein polynomials sum to 1, so A h(s) + b has the coefficients
A alpha_k + b (Bezier), or A a_k with b added to a_0 (polynomial). s is the same under every affine map of the
phase, so only the range theta+, theta- is converted. With y = H0 q' and theta = c' q' (Westervelt, Grizzle,
Koditschek, IEEE TAC 48(1), 2003)

    q'(s) = [H0; c']^-1 [y(s); theta+ + s (theta- - theta+)]

and the last row is a curve too, so every coordinate is.
"""

from __future__ import annotations

from math import comb
from typing import NamedTuple

import numpy as np

from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.conventions import OWN, AngleMap, Convention, convention
from biped_adrc.gait.curves import Bezier, Curve, ramp
from biped_adrc.gait.exchange.record import GaitRecord
from biped_adrc.gait.gait import Gait
from biped_adrc.types import Array

_TURN = 2.0 * np.pi
_PARALLEL = 1e-12  # relative, of two phase rows


class Coordinates(NamedTuple):
    """All n coordinates of this paper along a step, and the phase they belong to."""

    curve: Curve
    """q(s), (n, M + 1) coefficients [rad]."""
    phase: Array
    """c (n,), Theta = c q."""
    theta_plus: float
    theta_minus: float
    virtual_leg: bool
    """Whether c is this paper's own row."""
    turns: Array
    """(n,) whole turns that were added so that hips lie near pi and the others near 0."""

    @property
    def constraint(self) -> VirtualConstraint:
        """The virtual constraint of the actuated coordinates, all but the last."""
        curve = type(self.curve)(self.curve.coefficients[:-1])
        return VirtualConstraint(curve, self.phase, self.theta_plus, self.theta_minus)


def mapped(curve: Curve, A: Array, b: Array) -> Curve:
    """The curve A h(s) + b, of the same kind and degree; A (rows, p), b (rows,) [rad]."""
    a = A @ curve.coefficients
    if isinstance(curve, Bezier):
        a = a + b[:, np.newaxis]
    else:
        a[:, 0] += b
    return type(curve)(a)


def reversed_curve(curve: Curve) -> Curve:
    """The curve h(1 - s), of the same kind and degree."""
    a = curve.coefficients
    if isinstance(curve, Bezier):
        return Bezier(a[:, ::-1])
    degree = curve.degree
    T = [
        [comb(k, j) * (-1.0) ** j if j <= k else 0.0 for j in range(degree + 1)]
        for k in range(degree + 1)
    ]
    return type(curve)(a @ np.array(T))


def coordinates(record: GaitRecord) -> Coordinates:
    """All coordinates of this paper along the step. Raises GaitError when the rows do not determine "
    "them."""
    layout = record.layout
    c = layout.phase if record.phase is None else record.phase
    curve = record.curve_of_rows
    if record.reverse:
        curve = reversed_curve(curve)
    if not record.of_all_coordinates:
        curve = _completed(record, curve, c)
    to_paper = layout.to_paper
    curve = mapped(curve, to_paper.A, to_paper.b)
    # theta = c' q' = (c' A^-1) q - c' A^-1 b
    row = c @ to_paper.inverse.A
    offset = float(row @ to_paper.b)
    ends = np.array([record.theta_plus + offset, record.theta_minus + offset])
    k = float(row @ layout.paper_phase) / float(layout.paper_phase @ layout.paper_phase)
    same = bool(np.max(np.abs(row - k * layout.paper_phase)) <= _PARALLEL * np.max(np.abs(row)))
    if same:
        row, ends = layout.paper_phase, ends / k
    own = layout.name == OWN
    turns = np.zeros(layout.n) if own else whole_turns(curve(0.5)[0])
    curve = mapped(curve, np.eye(len(turns)), _TURN * turns)
    ends = ends + row @ (_TURN * turns)
    return Coordinates(curve, row, float(ends[0]), float(ends[1]), same and not own, turns)


def _completed(record: GaitRecord, curve: Curve, c: Array) -> Curve:
    """q'(s) from the outputs and the phase."""
    layout = record.layout
    outputs = layout.outputs if record.outputs is None else record.outputs
    H = np.vstack((outputs, c))
    if H.shape[0] != H.shape[1] or np.linalg.matrix_rank(H) < len(H):
        raise record.error(
            f"the outputs and the phase row {np.round(c, 6).tolist()} do not determine all "
            f"{layout.n} coordinates ({', '.join(layout.coordinates)}): {H.shape[0]} rows of rank "
            f"{np.linalg.matrix_rank(H)}, expected {layout.n} independent ones; give a phase that moves "
            "with the coordinate that has no row, or one row per coordinate"
        )
    phase = ramp(type(curve), curve.degree, record.theta_plus, record.theta_minus)
    q: Array = np.asarray(
        np.linalg.solve(H, np.vstack((curve.coefficients, phase))), dtype=np.float64
    )
    return type(curve)(q)


def whole_turns(middle: Array) -> Array:
    """Turns (n,) to add so that hips in the middle of a step lie in (0, 2 pi), knees and torso in "
    "(-pi, pi)."""
    centre = np.zeros(len(middle))
    centre[:2] = np.pi
    return np.asarray(-np.round((middle - centre) / _TURN) + 0.0)


def state_to_paper(record: GaitRecord, turns: Array) -> tuple[Array, Array] | None:
    """(q-, q'-) of the record in this paper's coordinates, each (n,), or None when it has none."""
    if record.q_minus is None or record.v_minus is None:
        return None
    to_paper = record.layout.to_paper
    q = to_paper.angles(record.q_minus) + _TURN * turns
    return q, to_paper.rates(record.v_minus)


def record_of(gait: Gait, to: str = "paper", own: Convention | None = None) -> GaitRecord:
    """The gait in the words of another convention, with that convention's outputs and sense of the phase.

    own: of the robot, for the convention "own", in which the coordinates are left as they are.
    """
    constraint = gait.constraint
    n = len(constraint.phase)
    other = convention(to, knees=n == 5) if own is None else own
    kind = type(constraint.curve).__name__.lower()
    ends = constraint.theta_plus, constraint.theta_minus
    coefficients = constraint.curve.coefficients
    full = GaitRecord(
        "paper" if own is None else OWN,
        coefficients,
        *ends,
        constraint.phase,
        curve=kind,
        name=gait.name,
        own=own,
    )
    curve = _completed(full, constraint.curve, constraint.phase)
    back: AngleMap = other.to_paper.inverse
    rows = mapped(curve, back.A, back.b)
    # Theta = c q = c A q' + c b
    row = constraint.phase @ other.to_paper.A
    plus, minus = other.sense * (np.array(ends) - constraint.phase @ other.to_paper.b)
    return GaitRecord(
        to,
        other.outputs @ rows.coefficients,
        float(plus),
        float(minus),
        phase=other.sense * row + 0.0,
        curve=kind,
        q_minus=back.angles(gait.q_minus),
        v_minus=back.rates(gait.v_minus),
        period=gait.period,
        slope=gait.slope,
        name=gait.name,
        robot=gait.robot,
        preset=gait.preset,
        provenance=gait.provenance,
        own=own,
    )
