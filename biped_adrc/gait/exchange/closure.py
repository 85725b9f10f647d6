"""Does a gait from another program close, and if not, in which angle convention would it?

A periodic gait closes: the end of a step, relabelled, is the start of the next one, q(0) = R q(1) for every
coordinate. With a robot, also dq/dTheta after the impact is the slope at s = 0 (the constraint is
hybrid-invariant). The usual mistakes when gaits are exchanged (degrees, a sign, an order of joints, another
convention) all break closure, so this check finds them without knowing which one was made.

Each check returns a `Misfit` or None, in the order of `first_misfit`: the first failure is reported, since
later ones mostly follow from it. The error names the joint, what was found, what was expected, the likely cause
and what to try; if the same numbers close in another convention, it says which. Called by `importing`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from biped_adrc.errors import GaitError
from biped_adrc.gait.conventions import CONVENTIONS, OWN, convention
from biped_adrc.gait.exchange.convert import Coordinates, coordinates, state_to_paper
from biped_adrc.gait.exchange.record import GaitRecord
from biped_adrc.gait.gait import CLOSES
from biped_adrc.model.biped import Biped
from biped_adrc.types import Array


def check(record: GaitRecord, biped: Biped | None = None, slopes: bool = True) -> Coordinates:
    """The gait in this paper's coordinates, once it is known to close. Raises GaitError.

    biped: checks its feet too (they are on the ground at both ends) and, with `slopes`, its impact.
    slopes=False accepts constraints that are not hybrid-invariant, such as those of the recipe of section IV.
    """
    try:
        along = coordinates(record)
    except GaitError as error:
        raise record.error(f"{error}{_hint(record, biped)}") from error
    misfit = first_misfit(record, along, biped, slopes)
    if misfit is not None:
        raise _error(record, misfit, biped)
    return along


def closing_conventions(record: GaitRecord, biped: Biped | None = None) -> tuple[str, ...]:
    """Names of the conventions in which the same numbers would be a gait that closes, slopes aside."""
    closing = []
    for name in CONVENTIONS:
        try:
            other = replace(record, convention=name)
            if first_misfit(other, coordinates(other), biped, slopes=False) is None:
                closing.append(name)
        except GaitError:
            continue  # another number of joints, or a phase that says nothing there
    return tuple(closing)


def _error(record: GaitRecord, m: Misfit, biped: Biped | None) -> GaitError:
    """The error for a misfit, with another convention as the likely cause where that would close."""
    text = f"{m.where}: found {m.found}, expected {m.expected}. Likely cause: "
    hint = _hint(record, biped) if m.geometric else ""
    if hint:
        return record.error(f"{text}the angles are in another convention{hint}. If not: {m.cause}")
    none = f" (it closes in none of the conventions {list(CONVENTIONS)})" if m.geometric else ""
    return record.error(f"{text}{m.cause}{none}")


def _hint(record: GaitRecord, biped: Biped | None) -> str:
    """End of a message: the other conventions in which the gait would close; empty where none would."""
    others = [name for name in closing_conventions(record, biped) if name != record.convention]
    if not others:
        return ""
    names = " or ".join(f"'{name}'" for name in others)
    return f'; it would close in {names}. Try convention="{others[0]}"'


SLOPES = 1e-2
"""[rad/rad]: largest jump of dq/dTheta through the impact in a gait whose slopes close."""
RATES = 1e-2
"""[rad/s]: largest gap between the stored rates before impact and those of the curve."""
LARGEST = 4.0 * np.pi
"""[rad]: angles above this are taken for degrees."""
_JOINTS = {  # names of the paper's coordinates for messages, by their number
    5: ("stance hip q1", "swing hip q2", "stance knee q3", "swing knee q4", "torso q5"),
    3: ("stance hip q1", "swing hip q2", "torso q3"),
}


def _joints(record: GaitRecord) -> tuple[str, ...]:
    """Names of the coordinates, for a reader."""
    layout = record.layout
    return layout.coordinates if layout.name == OWN else _JOINTS[layout.n]


class Misfit(NamedTuple):
    """One thing that is wrong with a gait, in words for an error message."""

    where: str
    """The joint, foot or entry."""
    found: str
    """The number found, with its unit."""
    expected: str
    """The number expected, with its tolerance."""
    cause: str
    """The likely cause, and what to try."""
    geometric: bool = True
    """Whether another angle convention can be the cure."""


def first_misfit(
    record: GaitRecord, along: Coordinates, biped: Biped | None, slopes: bool
) -> Misfit | None:
    """The first check that fails, or None. Without a robot only those that need none."""
    return next(filter(None, _checks(record, along, biped, slopes)), None)


def _checks(
    record: GaitRecord, along: Coordinates, biped: Biped | None, slopes: bool
) -> Iterator[Misfit | None]:
    """The results of all checks in their order, each computed when it is asked for."""
    if biped is not None:
        yield _fits(along, biped)
    yield _radians(record)
    yield _direction(along)
    yield _phase_of_rows(record, along)
    yield _closure(record, along)
    yield _state(record, along)
    if biped is not None:
        yield _feet(along, biped, record.slope)
        if slopes:
            yield _slopes(record, along, biped)


def _radians(record: GaitRecord) -> Misfit | None:
    """The rows are angles in radians: none above LARGEST at the start, middle and end of the step.

    Two turns are more than any joint of a walker makes, while a hip near half a turn is 180 in degrees.
    """
    values = np.array([record.curve_of_rows(s)[0] for s in (0.0, 0.5, 1.0)])
    largest = np.max(np.abs(values), axis=0)
    row = int(np.argmax(largest))
    if largest[row] <= LARGEST:
        return None
    return Misfit(
        f"row {row + 1} of the coefficients",
        f"an angle of {largest[row]:.5g}",
        f"radians, at most {LARGEST:.4g}",
        "the angles are degrees; give radians, for the coefficients, theta_plus, theta_minus, q_minus and "
        "v_minus",
        geometric=False,
    )


def _fits(along: Coordinates, biped: Biped) -> Misfit | None:
    """The gait has as many joints and coordinates as the robot; otherwise no other check would make sense."""
    n = len(along.phase)
    if (n - 1, n) == (biped.p, biped.n):
        return None
    return Misfit(
        "joints",
        f"a gait of {n - 1} actuated joints and {n} coordinates",
        f"{biped.p} and {biped.n} of robot '{biped.description.name}'",
        "the gait is another robot's; load the robot it was made for",
        geometric=False,
    )


def _direction(along: Coordinates) -> Misfit | None:
    """The paper's phase falls while the robot walks to +x.

    A phase that is not parallel to the paper's row may run either way, so it is not checked.
    """
    if not along.virtual_leg or along.theta_plus > along.theta_minus:
        return None
    return Misfit(
        "phase range",
        f"Theta from {along.theta_plus:.6g} after impact to {along.theta_minus:.6g} rad before the next",
        "Theta that falls (theta_plus > theta_minus in this paper's coordinates)",
        "theta_plus and theta_minus are exchanged, or the phase row has the other sign; exchange them, or "
        "set reverse when the first coefficients belong to the end of the step",
    )


def _phase_of_rows(record: GaitRecord, along: Coordinates) -> Misfit | None:
    """c q(s) runs linearly from theta+ to theta- within CLOSES [rad].

    With one row per coordinate the phase is given twice, by the curves and by its range; with outputs it is
    not, and there is nothing to compare. Curves fitted over time fail here.
    """
    if not record.of_all_coordinates:
        return None
    span = along.theta_minus - along.theta_plus
    s = np.linspace(0.0, 1.0, 21)
    gaps = [along.phase @ along.curve(x)[0] - (along.theta_plus + x * span) for x in s]
    worst = int(np.argmax(np.abs(gaps)))
    if abs(gaps[worst]) <= CLOSES:
        return None
    theta = along.theta_plus + s[worst] * span
    return Misfit(
        f"phase at s = {s[worst]:.2f}",
        f"c q(s) = {theta + gaps[worst]:.6g} rad",
        f"theta+ + s (theta- - theta+) = {theta:.6g} rad within {CLOSES:g}",
        "the curves run over time or over another phase than the row c; give the phase row they were made "
        "with, or curves fitted over it",
    )


def _closure(record: GaitRecord, along: Coordinates) -> Misfit | None:
    """q(0) = R q(1) within CLOSES [rad]: the end of the step, relabelled, is its start.

    Both are poses of double support. The joint with the largest gap is the one that is reported.
    """
    n, layout = len(along.phase), record.layout
    R = layout.relabelling if layout.name == OWN else convention("paper", n == 5).relabelling
    begin, end = along.curve(0.0)[0], R.angles(along.curve(1.0)[0])
    joint = int(np.argmax(np.abs(begin - end)))
    if abs(begin[joint] - end[joint]) <= CLOSES:
        return None
    return Misfit(
        f"{_joints(record)[joint]} across the impact",
        f"{begin[joint]:.6g} rad at the start of the step",
        f"{end[joint]:.6g} rad, the end of the step with the legs changed over, within {CLOSES:g} "
        "(this paper's coordinates)",
        "a coefficient of this joint is damaged, the order or sign of the joints differs, or the phase "
        "range is another gait's or a time; compare the first and the last coefficients of both legs",
    )


def _state(record: GaitRecord, along: Coordinates) -> Misfit | None:
    """The state before impact, where the record has one, lies on the end of the curve.

    q- = q(1) within CLOSES [rad], and q'- = dq/ds(1) s' within RATES [rad/s], with s' from the state's own
    Theta'.
    """
    state = state_to_paper(record, along.turns)
    if state is None:
        return None
    q, v = state
    h, dh, _ = along.curve(1.0)
    rate = float(along.phase @ v) / (along.theta_minus - along.theta_plus)
    names = _joints(record)
    for what, unit, tolerance, found, expected in (
        ("q_minus", "rad", CLOSES, q, h),
        ("v_minus", "rad/s", RATES, v, dh * rate),
    ):
        joint = int(np.argmax(np.abs(found - expected)))
        if abs(found[joint] - expected[joint]) > tolerance:
            return Misfit(
                f"{what} of the {names[joint]}",
                f"{found[joint]:.6g} {unit}",
                f"{expected[joint]:.6g} {unit} of the curve's end, within {tolerance:g}",
                "the state belongs to another gait or to another instant; leave q_minus and v_minus out to "
                "have them computed",
            )
    return None


def _feet(along: Coordinates, biped: Biped, slope: float) -> Misfit | None:
    """The swing foot starts and ends on ground of `slope` [rad] within CLOSES [m], and ends ahead of the stance
    foot.

    This needs the robot's link lengths, and fails for a gait that was made for other ones.
    """
    for s, when in ((0.0, "start"), (1.0, "end")):
        x, z = biped.swing_foot(along.curve(s)[0])
        height = float(z + math.tan(slope) * x)
        if not abs(height) <= CLOSES:
            return Misfit(
                f"swing foot at the {when} of the step",
                f"{height:.4g} m above the ground",
                f"0 within {CLOSES:g} m",
                "thigh and shin of the gait's robot have other lengths, or the phase range is another gait's "
                "or a time, or it walks on another slope; load the robot it was made for, or give the range of "
                "the phase [rad] and the slope",
            )
    ahead = float(biped.swing_foot(along.curve(1.0)[0])[0])
    if ahead > 0.0:
        return None
    return Misfit(
        "swing foot at the end of the step",
        f"{ahead:.4g} m from the stance foot",
        "ahead of it, x > 0",
        "the gait walks to -x: change the sign of all angles, or set reverse",
    )


def _slopes(record: GaitRecord, along: Coordinates, biped: Biped) -> Misfit | None:
    """dq/dTheta after the impact is the slope at the start, within SLOPES: the constraint is hybrid-invariant.

    The impact is linear in the rates, so the direction dq/dTheta after it does not depend on the speed. It
    depends on the masses, which makes this the one check that tells robots of equal link lengths apart.
    """
    span = along.theta_minus - along.theta_plus
    end, start = along.curve(1.0), along.curve(0.0)
    rate = np.sign(span) * end[1] / span
    impact = biped.impact(end[0], np.asarray(rate))
    after: Array = impact.v / float(along.phase @ impact.v)
    before = start[1] / span
    joint = int(np.argmax(np.abs(after - before)))
    if abs(after[joint] - before[joint]) <= SLOPES:
        return None
    made_for = f"{record.robot or '?'}, preset {record.preset or '?'}"
    here = f"{biped.description.name}, preset {biped.preset}"
    return Misfit(
        f"slope of the {_joints(record)[joint]} through the impact",
        f"{before[joint]:.5g} rad/rad at the start of the step",
        f"{after[joint]:.5g} rad/rad, that after the impact at its end, within {SLOPES:g}",
        f"the masses differ (gait for {made_for}; robot {here}), or the constraint is not hybrid-invariant; "
        "load the robot with the gait's preset, or accept the jump with slopes=False",
        geometric=False,
    )
