"""A gait in one angle convention as plain arrays, the form in which gaits are exchanged.

    y(s) = H0 q'(s),   s = (theta - theta+) / (theta- - theta+),   theta = c' q'

q' are the angles and theta the phase in that convention; ' is no derivative here. y has one row of
`coefficients` for each output: the usual outputs of the convention, all of its coordinates, or H0 q' with the
record's own H0. Curves are linear in their coefficients and their basis adds up to 1, so A h(s) + b has the
coefficients A alpha_k + b, and s is the same under every affine map of the phase. With y and the phase

    q'(s) = [H0; c']^-1 [y(s); theta+ + s (theta- - theta+)]

every coordinate is a curve. H0 and c' are the record's fields `outputs` and `phase`; alpha_k are coefficients,
and A, b those of the convention's map q = A q' + b. `coordinates` converts a record to the paper's coordinates,
`record_of` converts a gait to another convention; both keep kind and degree of the curves.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from biped_adrc.core.errors import GaitError
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, read_only
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.conventions import OWN, Convention, layout_of
from biped_adrc.gait.curves import Bezier, Curve, curve_kind
from biped_adrc.gait.gait import CLOSES, Gait, onto_section
from biped_adrc.gait.outputs import all_coordinates
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import ground_axes

_TURN = 2.0 * np.pi
NEAR = 5e-3
"""Largest distance of a swing foot from its ground that an import takes away [m]."""


@dataclass(frozen=True)
class GaitFile(Shown):
    """A gait of a robot with n coordinates in one angle convention.

        record = GaitFile("frost", alpha, theta_plus=-0.25, theta_minus=0.25, name="from FROST")
        gait = ba.import_gait(record, biped)

    Only convention, coefficients and the range of the phase are needed; everything else has a default or
    follows from the robot when the record is imported. Raises GaitError that names the entry.
    """

    ENTRIES: ClassVar = {
        "coefficients": (2, "rad"),
        "theta_plus": (0, "rad"),
        "theta_minus": (0, "rad"),
        "phase": (1, "1"),
        "outputs": (2, "1"),
        "q_minus": (1, "rad"),
        "v_minus": (1, "rad/s"),
        "period": (0, "s"),
        "slope": (0, "rad"),
    }
    """Name of each numeric entry -> number of its dimensions, and unit."""
    REQUIRED: ClassVar = ("coefficients", "theta_plus", "theta_minus")
    """Names of the entries without a default."""

    convention: str
    """Name of the angle convention, of `conventions.CONVENTIONS`; "own" for the robot's own coordinates."""
    coefficients: Array
    """Coefficients of the curves (rows, M + 1) [rad], one row per output or per coordinate."""
    theta_plus: float
    """Phase just after impact [rad]."""
    theta_minus: float
    """Phase just before the next impact [rad]."""
    phase: Array | None = None
    """Row c' (n,) of the phase; the convention's own row when None."""
    outputs: Array | None = None
    """Output matrix H0 (rows, n); the convention's own outputs, or all coordinates, when None."""
    curve: str = "bezier"
    """Kind of the curves, "bezier" or "polynomial"."""
    q_minus: Array | None = None
    """Angles (n,) just before impact [rad], in this convention; from the zero dynamics when None."""
    v_minus: Array | None = None
    """Rates (n,) just before impact [rad/s]; given together with q_minus."""
    period: float | None = None
    """Duration of a step [s]; from the zero dynamics when None."""
    slope: float = 0.0
    """Slope of the ground [rad], positive downhill."""
    name: str = "imported"
    robot: str = ""
    preset: str = ""
    provenance: Mapping[str, object] = field(default_factory=dict)
    """Origin of the gait, free text by name."""

    def __post_init__(self) -> None:
        """Check the numbers of each entry in ENTRIES, which states the number of its dimensions, and keep them
        read-only. An entry in REQUIRED may not be None.
        """
        for key, (dimensions, _) in self.ENTRIES.items():
            value = getattr(self, key)
            if value is not None or key in self.REQUIRED:
                object.__setattr__(self, key, self._numbers(key, value, dimensions))

    def _numbers(self, key: str, value: object, dimensions: int) -> Array | float:
        """The value of an entry as a read-only array with this number of dimensions, or as a float for 0.

        Raises GaitError that names the entry.
        """
        try:
            a = np.asarray(value)
        except ValueError:  # rows of different lengths
            a = np.array(None)
        # "fiu": floats, integers, unsigned integers
        if a.dtype.kind not in "fiu" or a.ndim != dimensions or not np.all(np.isfinite(a)):
            kind = ("one number", "one row of numbers", "rows of numbers")[dimensions]
            raise self.error(f"{key} is {value}, expected {kind}, all finite")
        return read_only(a) if dimensions else float(a)

    def error(self, text: str) -> GaitError:
        """A GaitError whose text begins with the gait and its convention."""
        return GaitError(f"gait '{self.name}' in convention '{self.convention}': {text}")


def foot_down(biped: Biped, q: Array, slope: float) -> tuple[Array, dict[str, str]]:
    """The least change (n,) of the actuated joints of q- = q (n,) [rad] that puts the swing foot onto the
    ground, and a remark for the provenance.

    The change is zero, without a remark, for a foot that is nearer to the ground than CLOSES, which counts as
    on it, or further away than NEAR: rounded digits do not explain that, and `Gait.check` then refuses the
    gait. slope [rad]: of the ground, positive downhill.
    """
    # [1]: unit vector out of the ground
    height = float(ground_axes(slope)[1] @ biped.swing_foot(q))
    if not CLOSES < abs(height) <= NEAR:
        return np.zeros(len(q)), {}
    said = f"it ended {1e3 * height:.3g} mm above it"
    return onto_section(biped, q, slope) - q, {"swing foot put onto the ground": said}


def onto_ground(
    along: VirtualConstraint, biped: Biped, slope: float
) -> tuple[VirtualConstraint, dict[str, str]]:
    """Move the end of a step, and so its start after relabelling, until the swing foot is on ground of `slope`
    [rad], as `foot_down` does; returns the curves and a remark for the provenance. along: the curves (n rows)
    of all coordinates.

    dq/dTheta at the end stays; at the start it changes as dq/dTheta after the impact does, so that a
    hybrid-invariant gait stays one. Only Bezier curves are moved.
    """
    # d: dq/ds at the end; dq: change of q there, first: of q at the start
    q, d, _ = along.curve(1.0)
    dq, remark = foot_down(biped, q, slope)
    if not remark or not isinstance(along.curve, Bezier):
        return along, {}
    a, c, first = along.curve.coefficients, along.phase, biped.R @ dq
    plus, minus = float(along.theta_plus + c @ first), float(along.theta_minus + c @ dq)
    spans = along.theta_minus - along.theta_plus, minus - plus
    hits = biped.impact(q, d).v, biped.impact(q + dq, d).v
    # dq/ds at the start, before and after the move: the rates after impact over Theta', times the span
    before, after = (span * v / (c @ v) for span, v in zip(spans, hits, strict=True))
    # change of dq/ds at the end, where dq/dTheta stays and the span changes
    last = (spans[1] / spans[0] - 1.0) * d
    # the change of the curves is a Bezier curve itself, with these ends and slopes
    curve = Bezier(a + Bezier.between(first, after - before, last, dq, a.shape[1] - 1))
    return VirtualConstraint(curve, c, plus, minus), remark


def mapped(curve: Curve, A: Array, b: Array) -> Curve:
    """The curve A h(s) + b, of the same kind and degree as h = `curve`; A (rows, p), b (rows,) [rad]."""
    # the ramp from 1 to 1 is the constant 1
    return type(curve)(A @ curve.coefficients + np.outer(b, curve.ramp(curve.degree, 1.0, 1.0)))


def coordinates(record: GaitFile, layout: Convention) -> tuple[VirtualConstraint, Array]:
    """Convert a record to curves (n rows) of all the paper's coordinates over their phase, the one without a
    motor last, and the whole turns (n,) that were added so that hips lie near pi and the others near 0.

    layout: the record's convention. The coordinates are completed by the phase, the angles are mapped, and the
    phase is scaled to the paper's own row where it is parallel to it; in the robot's own coordinates no turns
    are added. Raises GaitError when the rows do not determine the coordinates.
    """
    # c: row of the phase in the record's own coordinates q'
    c = layout.phase if record.phase is None else record.phase
    to_paper = layout.to_paper
    curve = mapped(_of_all(record, layout, c), to_paper.A, to_paper.b)
    # theta = c' q' = (c' A^-1) q - c' A^-1 b
    row = c @ to_paper.inverse.A
    ends = np.array([record.theta_plus, record.theta_minus]) + float(row @ to_paper.b)
    # row = k paper_phase where they are parallel but for round-off; k < 0 for a phase that grows where the
    # paper's falls
    k = float(row @ layout.paper_phase) / float(layout.paper_phase @ layout.paper_phase)
    if np.max(np.abs(row - k * layout.paper_phase)) <= 1e-12 * np.max(np.abs(row)):
        row, ends = layout.paper_phase, ends / k
    # by the pose in the middle of the step, s = 0.5
    turns = np.zeros(layout.n) if layout.name == OWN else whole_turns(curve(0.5)[0])
    curve = mapped(curve, np.eye(layout.n), _TURN * turns)
    ends = ends + row @ (_TURN * turns)
    return VirtualConstraint(curve, row, float(ends[0]), float(ends[1])), turns


def _of_all(record: GaitFile, layout: Convention, c: Array) -> Curve:
    """The curve of all n coordinates of a record's convention, with coefficients (n, M + 1) [rad].

    c (n,): row of the phase, which gives the coordinate that the outputs leave open. Raises GaitError for
    entries whose shapes do not fit each other.
    """
    n, outputs, a = layout.n, record.outputs, record.coefficients
    if outputs is None and len(a) == 1 and a.size % len(layout.outputs) == 0:
        a = a.reshape(len(layout.outputs), -1, order="F")  # column below column, as FROST has them
    rows = len(a)
    # without a matrix H0: as many rows as coordinates are the coordinates themselves
    if outputs is None:
        outputs = np.eye(n) if rows == n else layout.outputs
    # half: only one of q_minus and v_minus is there
    half = (record.q_minus is None) != (record.v_minus is None)
    shapes = {x.shape for x in (c, record.q_minus, record.v_minus) if x is not None}
    if half or outputs.shape != (rows, n) or shapes != {(n,)}:
        raise record.error(
            f"{rows} rows of coefficients and outputs of shape {outputs.shape}, expected {len(layout.outputs)} "
            f"rows or one per coordinate, which are {', '.join(layout.coordinates)}; phase, q_minus and "
            f"v_minus have {n} numbers each, the last two are both given or both left out"
        )
    curve = curve_kind(record.curve)(a)
    plus, minus = record.theta_plus, record.theta_minus
    if rows != n or record.outputs is not None:
        return all_coordinates(curve, outputs, c, (plus, minus))
    # curves of all coordinates leave nothing open, so their phase has to be the straight line of the range
    gap = max(abs(curve(s)[0] @ c - plus - s * (minus - plus)) for s in np.linspace(0.0, 1.0, 21))
    if gap > CLOSES:
        raise record.error(
            f"the phase c q(s) of the curves is {gap:.3g} rad from a straight line from theta_plus to "
            f"theta_minus, expected at most {CLOSES:g}; they run over time or over another phase than the row c"
        )
    return curve


def whole_turns(middle: Array) -> Array:
    """Whole turns (n,) to add to q, from q in the middle of a step (n,) [rad].

    Then hips lie in (0, 2 pi), knees and torso in (-pi, pi). Angles that differ by whole turns are the same
    pose, but not the same phase c q.
    """
    centre = np.zeros(len(middle))
    centre[:2] = np.pi  # the hips: a leg that hangs down has the angle pi
    return np.asarray(-np.round((middle - centre) / _TURN) + 0.0)  # + 0.0 makes -0.0 to 0.0


def record_of(gait: Gait, biped: Biped, to: str = "paper") -> GaitFile:
    """Convert the gait of a robot to a record in the convention `to`, with the outputs and the sense of the
    phase of that convention.

    Raises GaitError for an unknown convention, or one that does not fit the robot.
    """
    constraint, other = gait.constraint, layout_of(to, biped)
    ends = constraint.theta_plus, constraint.theta_minus
    # curves of all n coordinates: those of the p joints, and the last one from the phase
    curve = all_coordinates(constraint.curve, np.eye(biped.p, biped.n), constraint.phase, ends)
    # back: q' = A^-1 (q - b); `other.outputs` is H0, whose rows give the outputs
    back = other.to_paper.inverse
    # Theta = c q = c A q' + c b
    plus, minus = other.sense * (np.array(ends) - constraint.phase @ other.to_paper.b)
    return GaitFile(
        to,
        other.outputs @ mapped(curve, back.A, back.b).coefficients,
        float(plus),
        float(minus),
        phase=other.sense * (constraint.phase @ other.to_paper.A) + 0.0,  # no -0.0
        curve=type(constraint.curve).__name__.lower(),
        q_minus=back.angles(gait.q_minus),
        v_minus=back.rates(gait.v_minus),
        period=gait.period,
        slope=gait.slope,
        name=gait.name,
        robot=gait.robot,
        preset=gait.preset,
        provenance=gait.provenance,
    )
