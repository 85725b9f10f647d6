"""From records of gaits to gaits of this package, and back: `import_gait`, `export_gait`."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from biped_adrc.errors import GaitError
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.conventions import CONVENTIONS
from biped_adrc.gait.exchange.closure import check
from biped_adrc.gait.exchange.convert import record_of, state_to_paper
from biped_adrc.gait.exchange.files import read_record, write_record
from biped_adrc.gait.exchange.record import GaitRecord
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.parts import check_part
from biped_adrc.robots.robot_toml import robot_names


def import_constraint(record: GaitRecord) -> VirtualConstraint:
    """The virtual constraint of a record that closes, without a robot. Raises GaitError."""
    return check(record).constraint


def import_gait(
    gait: GaitRecord | Path | str,
    biped: Biped,
    convention: str | None = None,
    names: Mapping[str, str] | None = None,
    slopes: bool = True,
) -> Gait:
    """A gait from arrays, or from a .json or .mat file in any angle convention.

    convention: of a file that does not say its own. names: the file's names of its entries where they are
    not ours, such as {"coefficients": "alpha"}. slopes: also ask that the slopes close through the impact of
    this robot; False accepts constraints that are not hybrid-invariant. Without q_minus, v_minus or period
    these come from the zero dynamics.

    Raises GaitError that names the joint, what was found, what was expected, the likely cause and what to
    try; InputError for a file that cannot be read.
    """
    _check_angles(biped.description.name)
    record = gait if isinstance(gait, GaitRecord) else read_record(gait, convention, names)
    along = check(record, biped, slopes)
    constraint = along.constraint
    state = state_to_paper(record, along.turns)
    period = record.period
    if state is None or period is None:
        own = Gait.of_cycle(record.name, ZeroDynamics.of(biped, constraint), {})
        period = own.period
        state = (own.q_minus, own.v_minus) if state is None else state
    provenance = dict(record.provenance) or {
        "method": f"imported from convention '{record.convention}'",
        "source": "arrays" if isinstance(gait, GaitRecord) else Path(gait).name,
    }
    if along.turns.any():
        provenance["whole turns added to q"] = ", ".join(f"{k:g}" for k in along.turns)
    robot, preset = record.robot or biped.description.name, record.preset or biped.preset
    return Gait(
        record.name, robot, preset, constraint, *state, period, provenance, record.slope
    ).check(biped)


def export_gait(gait: Gait, path: Path | str, convention: str = "paper") -> None:
    """Write a gait as .json or .mat (plain arrays, a `units` struct) in any convention.

    `import_gait` gives it back. Raises InputError for another suffix or convention, and OutputError.
    """
    check_part(gait, "gait", Gait)
    _check_angles(gait.robot)
    write_record(record_of(gait, convention), path)


def _check_angles(robot: str) -> None:
    """Raises GaitError for a robot whose angles are its own, so that no convention says what they are."""
    if robot and robot not in robot_names():
        raise GaitError(
            f"the angles of robot '{robot}' are those of its own URDF, which are in none of the conventions "
            f"{list(CONVENTIONS)}: its gaits are stored and loaded as they are, by Gait.save and load_gait"
        )
