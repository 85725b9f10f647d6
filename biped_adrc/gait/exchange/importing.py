"""Import and export of gaits: `import_gait` and `export_gait`, the two functions a user calls.

An import reads a file or takes a `GaitRecord`, converts it to the paper's coordinates, completes missing
entries (state before impact, period) from the zero dynamics, and passes the `Gait.check` of stored gaits: the
end of the step, relabelled, is the start of the next one. Degrees, a sign, an order of joints, another
convention: all violate it, so each such mistake is detected. Where the same numbers would be a gait in another
convention, the error names it. `check_slopes` checks hybrid invariance besides.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np

from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import GaitError
from biped_adrc.gait.conventions import CONVENTIONS, OWN, layout_of, of_the_paper
from biped_adrc.gait.exchange.files import read_record, write_record
from biped_adrc.gait.exchange.record import SLOPES, GaitRecord, coordinates, record_of
from biped_adrc.gait.exchange.samples import Samples, gait_of_samples
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics, impact_jump
from biped_adrc.model.biped import Biped

RATES = 1e-2
"""Largest difference of the stored rates before impact and those of the curve [rad/s]."""


def import_gait(
    gait: GaitRecord | Samples | Path | str,
    biped: Biped,
    convention: str | None = None,
    names: Mapping[str, str] | None = None,
    slopes: bool = True,
    degree: int = 6,
    slope: float = 0.0,
) -> Gait:
    """Import a gait from arrays, or from a .json, .mat or .csv file, in any angle convention.

    convention: of a file that does not state its own; "own" for the coordinates of the robot's record as they
    are, needed for a robot whose legs and phase differ from the paper's. names: the file's names of its
    entries where they differ from ours, such as {"coefficients": "alpha"}, or "R.alpha" in a struct. slopes:
    also check that the slopes close through the impact of this robot; False accepts constraints that are not
    hybrid-invariant. Without q_minus, v_minus or period these come from the zero dynamics.

    To `Samples` of a step over time (t, q, and perhaps v) curves of this degree are fitted;
    slope [rad]: of their ground.

    The gait is named by the record ("imported" where it has no name) and can be walked and saved as any other.

    Raises GaitError that names the joint, what was found, what was expected and what to try; InputError
    for a file that cannot be read.

    >>> ba.export_gait(gait, folder / "walk.mat", "frost")
    >>> again = ba.import_gait(folder / "walk.mat", biped)
    >>> round(again.period - gait.period, 12)
    0.0
    """
    check_part(biped, "biped", Biped)
    check_part(gait, "gait", GaitRecord, Samples, str, Path)
    source = "arrays"
    if isinstance(gait, str | Path):
        source = Path(gait).name
        gait = read_record(gait, convention, names, None if of_the_paper(biped) else OWN)
    if isinstance(gait, Samples):
        layout = layout_of(convention or OWN, biped)
        title = "samples" if source == "arrays" else Path(source).stem
        return gait_of_samples(gait, biped, layout, degree, slope, title, source)
    try:
        result = _gait_of(gait, biped, source)
    except GaitError as error:
        others = [name for name in closing_conventions(gait, biped) if name != gait.convention]
        hint = f'; it would close in {others}, try convention="{others[0]}"' if others else ""
        raise GaitError(f"{error}{hint}") from error
    if slopes:
        check_slopes(result, biped)
    return result


def closing_conventions(record: GaitRecord, biped: Biped) -> tuple[str, ...]:
    """Names of the conventions in which the same numbers would be a gait that closes,
    without a check of slopes.
    """
    closing = []
    for name in CONVENTIONS:
        with suppress(GaitError):  # another number of joints, or a phase that says nothing there
            _gait_of(replace(record, convention=name), biped, "")
            closing.append(name)
    return tuple(closing)


def _gait_of(record: GaitRecord, biped: Biped, source: str) -> Gait:
    """The gait of a record, completed by the zero dynamics and checked. Raises GaitError."""
    layout = layout_of(record.convention, biped)
    along = coordinates(record, layout)
    constraint, span = along.constraint, along.theta_minus - along.theta_plus
    q, dq, _ = along.curve(1.0)
    provenance = dict(record.provenance) or {
        "method": f"imported from convention '{record.convention}'",
        "source": source,
    }
    if along.turns.any():
        provenance["whole turns added to q"] = ", ".join(f"{k:g}" for k in along.turns)
    robot, preset = record.robot or biped.description.name, record.preset or biped.preset
    names = record.name, robot, preset
    # of |Theta'| = 1 rad/s: what the curve alone says of the state before impact
    gait = Gait(*names, constraint, q, dq / abs(span), 1.0, provenance, record.slope).check(biped)
    if record.q_minus is not None and record.v_minus is not None:
        to_paper = layout.to_paper
        q, v = (
            to_paper.angles(record.q_minus) + 2.0 * np.pi * along.turns,
            to_paper.rates(record.v_minus),
        )
        gap = np.abs(v - dq * float(along.phase @ v) / span)
        joint = int(np.argmax(gap))
        if not gap[joint] <= RATES:
            raise GaitError(
                f"gait '{record.name}': v_minus of {biped.description.joints[joint]} is {gap[joint]:.3g} rad/s "
                f"from the curve's end, expected at most {RATES:g}; leave q_minus and v_minus out to have them "
                "computed"
            )
        gait = replace(gait, q_minus=q, v_minus=v)
    if record.q_minus is None or record.period is None:
        orbit = Gait.of_cycle(record.name, ZeroDynamics.of(biped, constraint), {})
        gait = replace(gait, period=orbit.period)
        if record.q_minus is None:
            gait = replace(gait, q_minus=orbit.q_minus, v_minus=orbit.v_minus)
    return replace(gait, period=record.period or gait.period).check(biped)


def check_slopes(gait: Gait, biped: Biped) -> None:
    """Raise GaitError unless the gait is hybrid-invariant: dq/dTheta after the impact
    is the slope at the start.

    It depends on the masses, so this is the one check that tells robots of equal link lengths apart.
    """
    _, jump = impact_jump(biped, gait.constraint, gait.q_minus, gait.v_minus)
    jump = np.abs(jump / (gait.constraint.phase @ gait.start(biped)[1]))
    joint = int(np.argmax(jump))
    if not jump[joint] <= SLOPES:
        raise GaitError(
            f"gait '{gait.name}': the slope of {biped.description.joints[joint]} jumps by {jump[joint]:.4g} "
            f"rad/rad through the impact, expected at most {SLOPES:g}: the masses differ (gait for "
            f"{gait.robot}, preset {gait.preset}; robot {biped.description.name}, preset {biped.preset}), or "
            "the constraint is not hybrid-invariant; load the robot it was made for, or accept the jump with "
            "slopes=False"
        )


def export_gait(
    gait: Gait, path: Path | str, convention: str = "paper", biped: Biped | None = None
) -> None:
    """Write a gait as .json or .mat (plain arrays, a `units` struct) in any convention,
    for `import_gait` or MATLAB.

    biped: its robot, needed where that is not one of the package. Raises InputError for another suffix,
    convention or robot, and OutputError where the file cannot be written.

    >>> ba.export_gait(gait, folder / "gait.mat", "frost")
    >>> ba.import_gait(folder / "gait.mat", biped).name
    'v0.8'
    """
    check_part(gait, "gait", Gait)
    biped = Biped.load(gait.robot, gait.preset) if biped is None else biped
    write_record(record_of(gait, biped, convention), path)
