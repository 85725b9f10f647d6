"""Import and export of gaits: `import_gait` and `export_gait`, the two functions a user calls.

An import reads a file or takes a `GaitRecord`, converts it to the paper's coordinates, checks that it closes
(`closure`), completes what is missing (state before impact, period) from the zero dynamics, and ends with the
same `Gait.check` that stored gaits pass. Robots with a URDF of the user's own are refused: the conventions
describe the angles of the packaged robots only.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from biped_adrc.errors import GaitError
from biped_adrc.gait.conventions import CONVENTIONS, OWN, of_the_paper, own_convention
from biped_adrc.gait.conventions import convention as known_convention
from biped_adrc.gait.exchange.closure import check
from biped_adrc.gait.exchange.convert import record_of, state_to_paper
from biped_adrc.gait.exchange.files import read_record, write_record
from biped_adrc.gait.exchange.record import GaitRecord
from biped_adrc.gait.exchange.samples import Samples, gait_of_samples
from biped_adrc.gait.gait import Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.model.robots.robot_toml import robot_names
from biped_adrc.parts import check_part


def import_gait(
    gait: GaitRecord | Samples | Path | str,
    biped: Biped,
    convention: str | None = None,
    names: Mapping[str, str] | None = None,
    slopes: bool = True,
    degree: int = 6,
    slope: float = 0.0,
) -> Gait:
    """A gait from arrays, or from a .json, .mat or .csv file, in any angle convention.

    convention: of a file that does not say its own; "own" for the coordinates of the robot's record as they
    are, which a robot has whose legs and phase are not laid out as the paper's. names: the file's names of its
    entries where they are not ours, such as {"coefficients": "alpha"}, or "R.alpha" in a struct.
    slopes: also ask that the slopes close through the impact of this robot; False accepts constraints that are
    not hybrid-invariant. Without q_minus, v_minus or period these come from the zero dynamics.

    To `Samples` of a step over time (t, q, and perhaps v) curves of this degree are fitted; slope [rad]: of the
    ground that they are of.

        gait = ba.import_gait("ames.mat", biped, convention="frost", names={"coefficients": "alpha"})

    The gait is named by the record ("imported" where it has no name) and can be walked and saved as any other.

    Raises GaitError that names the joint, what was found, what was expected, the likely cause and what to
    try; InputError for a file that cannot be read.
    """
    check_part(biped, "biped", Biped)
    record, source = gait, "arrays"
    if not isinstance(gait, GaitRecord | Samples):
        check_part(gait, "gait", GaitRecord, Samples, str, Path)
        source = Path(gait).name
        layout = own_convention(biped)
        asked = layout if convention == OWN or not of_the_paper(biped) else None
        record = read_record(gait, convention, names, asked)
    if isinstance(record, Samples):
        return _of_samples(record, biped, convention, (degree, slope), source)
    assert isinstance(record, GaitRecord)
    _check_angles(record.convention, biped)
    if record.convention == OWN and record.own is None:
        record = replace(record, own=own_convention(biped))
    along = check(record, biped, slopes)
    constraint = along.constraint
    state = state_to_paper(record, along.turns)
    period = record.period
    if state is None or period is None:
        own = Gait.of_cycle(record.name, ZeroDynamics.of(biped, constraint), {})
        period = own.period
        state = (own.q_minus, own.v_minus) if state is None else state
    provenance: dict[str, object] = dict(record.provenance) or {
        "method": f"imported from convention '{record.convention}'",
        "source": source,
    }
    if along.turns.any():
        provenance["whole turns added to q"] = ", ".join(f"{k:g}" for k in along.turns)
    robot, preset = record.robot or biped.description.name, record.preset or biped.preset
    return Gait(
        record.name, robot, preset, constraint, *state, period, provenance, record.slope
    ).check(biped)


def _of_samples(
    samples: Samples, biped: Biped, name: str | None, fit: tuple[int, float], source: str
) -> Gait:
    """The gait of samples; they are in the robot's own coordinates where no convention is named."""
    if name is None or name == OWN:
        layout = own_convention(biped)
    else:
        _check_angles(name, biped)
        layout = known_convention(name, knees=biped.n == 5)
    title = "samples" if source == "arrays" else Path(source).stem
    return gait_of_samples(samples, biped, layout, *fit, name=title, source=source)


def export_gait(
    gait: Gait, path: Path | str, convention: str = "paper", biped: Biped | None = None
) -> None:
    """Write a gait as .json or .mat (plain arrays, a `units` struct) in any convention.

    biped: its robot, for the convention "own". `import_gait` gives it back. Raises InputError for another
    suffix or convention, GaitError for a robot that the convention does not fit, and OutputError.
    """
    check_part(gait, "gait", Gait)
    if biped is not None:
        _check_angles(convention, biped)
    elif convention == OWN or (gait.robot and gait.robot not in robot_names()):
        raise GaitError(
            f"the gait is of robot '{gait.robot}' and convention '{convention}' is asked for; give "
            "its robot too: "
            "export_gait(gait, path, 'own', biped) writes the coordinates of the robot's record as they are"
        )
    own = own_convention(biped) if biped is not None and convention == OWN else None
    write_record(record_of(gait, convention, own), path)


def _check_angles(name: str, biped: Biped) -> None:
    """Raises GaitError for a convention of other legs or another phase than the robot's."""
    if name == OWN or of_the_paper(biped) or name not in CONVENTIONS:
        return
    d = biped.description
    raise GaitError(
        f"robot '{d.name}' has the coordinates {list(d.joints)} and the phase {list(d.phase)}, which "
        "are not laid out "
        f"as convention '{name}' has them; take convention 'own', the coordinates of its record as they are"
    )
