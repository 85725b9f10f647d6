"""Gaits between angle conventions, exactly: curves under affine maps of the angles and of the phase.

Curves are linear in their coefficients and Bernstein polynomials sum to 1, so A h(s) + b has the coefficients
A alpha_k + b (Bezier), or A a_k with b added to a_0 (polynomial). s is the same under every affine map of the
phase, so only the range theta+, theta- is converted. With y = H0 q' and theta = c' q' (Westervelt, Grizzle,
Koditschek, IEEE TAC 48(1), 2003)

    q'(s) = [H0; c']^-1 [y(s); theta+ + s (theta- - theta+)]

and the last row is a curve too, so every coordinate is.

`coordinates` brings a record into the paper's coordinates (called by `closure.check`), `record_of` takes a gait
to another convention (called by `importing.export_gait`). Both keep kind and degree of the curves.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.conventions import OWN, AngleMap, Convention, convention
from biped_adrc.gait.curves import Curve
from biped_adrc.gait.exchange.record import GaitRecord
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.outputs import all_coordinates
from biped_adrc.types import Array

_TURN = 2.0 * np.pi
_PARALLEL = 1e-12
"""Largest relative difference of two phase rows that count as parallel."""


class Coordinates(NamedTuple):
    """All n coordinates of this paper along a step, and the phase they belong to."""

    curve: Curve
    """q(s), (n, M + 1) coefficients [rad]."""
    phase: Array
    """c (n,), Theta = c q."""
    theta_plus: float
    """Theta at s = 0, after impact [rad]."""
    theta_minus: float
    """Theta at s = 1, before the next impact [rad]."""
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
    turned = type(curve)(A @ curve.coefficients)
    return type(curve)(turned.shifted(b))


def coordinates(record: GaitRecord) -> Coordinates:
    """All coordinates of this paper along the step of a record.

    Reverses the curve where the record says so, completes the coordinates by the phase, maps the angles, scales
    the phase to the paper's own row where it is parallel to it, and adds whole turns. Raises GaitError when the
    rows do not determine the coordinates.
    """
    layout = record.layout
    c = layout.phase if record.phase is None else record.phase
    curve = record.curve_of_rows
    if record.reverse:
        curve = curve.reversed()
    if not record.of_all_coordinates:
        outputs = layout.outputs if record.outputs is None else record.outputs
        curve = all_coordinates(curve, outputs, c, (record.theta_plus, record.theta_minus))
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


def whole_turns(middle: Array) -> Array:
    """Whole turns (n,) to add to q in the middle of a step (n,) [rad].

    Then hips lie in (0, 2 pi), knees and torso in (-pi, pi). Angles that differ by whole turns are the same
    pose, but not the same phase c q.
    """
    centre = np.zeros(len(middle))
    centre[:2] = np.pi
    return np.asarray(-np.round((middle - centre) / _TURN) + 0.0)


def state_to_paper(record: GaitRecord, turns: Array) -> tuple[Array, Array] | None:
    """(q-, q'-) of the record in this paper's coordinates, each (n,) [rad, rad/s]; None when it has none.

    turns: (n,), those that `coordinates` added to the curve.
    """
    if record.q_minus is None or record.v_minus is None:
        return None
    to_paper = record.layout.to_paper
    q = to_paper.angles(record.q_minus) + _TURN * turns
    return q, to_paper.rates(record.v_minus)


def record_of(gait: Gait, to: str = "paper", own: Convention | None = None) -> GaitRecord:
    """The gait as a record in another convention, with that convention's outputs and sense of the phase.

    own: of the robot, for the convention "own", in which the coordinates are left as they are. Raises
    InputError for a convention that there is not.
    """
    constraint = gait.constraint
    n = len(constraint.phase)
    other = convention(to, knees=n == 5) if own is None else own
    kind = type(constraint.curve).__name__.lower()
    ends = constraint.theta_plus, constraint.theta_minus
    ours = convention("paper", knees=n == 5) if own is None else own
    curve = all_coordinates(constraint.curve, ours.outputs, constraint.phase, ends)
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
