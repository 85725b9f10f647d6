"""Import and export of gaits: `import_gait` and `export_gait`, the two functions a user calls.

An import reads a file or takes a `GaitFile`, converts it to the paper's coordinates, completes missing
entries (state before impact, period) from the zero dynamics, and passes the `Gait.check` of stored gaits: the
end of the step, relabelled (with the coordinates of both legs exchanged), is the start of the next one.
Degrees, a sign, an order of joints, another convention: all violate it, so each such mistake is detected. Where
the same numbers would be a gait in another convention, the error names it. `check_slopes` checks hybrid
invariance besides.

On disk a gait is a record: a JSON or MATLAB file with the fields of `GaitFile` by name, whose names are those
of `docs/notation.md`. A gait that this package stored is read too, in the robot's own coordinates. `export_run`
writes a walk ("run") as a MATLAB file with a column for each signal, over time.

MATLAB files are of version 5, read by MATLAB and Octave. Every array has a unit in the struct `units`, which is
written last, so that a file that was cut off is detected.

`read_record` checks that the entries exist, `record.GaitFile` shapes and numbers, and `import_gait`
whether it is a gait.

A gait file of another program needs three entries, and one more unless the caller states the convention:

    coefficients             (rows, M + 1) [rad], one row per output or coordinate
    theta_plus, theta_minus  range of the phase [rad]
    convention               a name of `conventions.CONVENTIONS`

All other fields of `GaitFile` may be added under their names. Where the file has other names, the argument
`names` of `import_gait` gives them.
"""

import io
import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import loadmat, savemat

from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import GaitError, InputError
from biped_adrc.core.files import output_path, plain, read_json, reading, write_bytes, write_json
from biped_adrc.core.types import Array
from biped_adrc.gait.conventions import CONVENTIONS, OWN, layout_of, of_the_paper
from biped_adrc.gait.exchange.entries import all_entries, entry, frost_steps
from biped_adrc.gait.exchange.record import GaitFile, coordinates, foot_down, onto_ground, record_of
from biped_adrc.gait.exchange.samples import Samples, explained, gait_of_samples, read_csv
from biped_adrc.gait.gait import FORMAT, Gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics, impact_jump
from biped_adrc.model.biped import Biped


def write_mat(path: Path | str, entries: Mapping[str, object], units: Mapping[str, str]) -> None:
    """Write numbers, arrays and text under their names as a .mat file (version 5); arrays (K,) become columns
    (K, 1).

    units: unit of each array by its name, "1" where it is dimensionless. Raises OutputError.
    """
    buffer = io.BytesIO()
    savemat(buffer, {**entries, "units": dict(units)}, oned_as="column")
    write_bytes(Path(path), buffer.getvalue())


def read_mat(path: Path | str) -> dict[str, Any]:
    """Read the variables of a .mat file by name; arrays lose their dimensions of length 1, structs become
    dicts.

    Raises InputError for a file that is missing, damaged, or of version 7.3 (HDF5),
    which MATLAB writes with -v7.3.
    """
    path = Path(path)
    with reading("MATLAB file", path, InputError):
        try:
            result = loadmat(io.BytesIO(path.read_bytes()), simplify_cells=True)
        except NotImplementedError:
            raise InputError(
                f"MATLAB file '{path}' is of version 7.3 (HDF5), expected version 5 to 7; load it in MATLAB "
                "and write it again with save('file.mat', '-v7')"
            ) from None
    return {name: _text(value) for name, value in result.items() if not name.startswith("__")}


def _text(value: object) -> object:
    """The value as it is; but an array of characters, as MATLAB stores text, becomes a str."""
    if isinstance(value, np.ndarray) and value.dtype.kind == "U":
        return "".join(value.ravel().tolist())
    return value


_FORMAT = "biped_adrc exchanged gait 1"
"""Entry `format` of a gait file written here; files of other programs need none."""
_SHOWN = 30
"""Most names of entries that an error lists."""


def write_record(record: GaitFile, path: Path | str) -> None:
    """Write a record as .json or .mat: the fields of `GaitFile` by name, a `format`, and the units.

    Fields that are None are left out; in a .mat file the provenance is one text of JSON. Raises InputError for
    another suffix, and OutputError where the file cannot be written.
    """
    path = output_path(path, (".json", ".mat"))
    entries = {key: x for key, x in vars(record).items() if x is not None}
    units = {key: unit for key, (_, unit) in GaitFile.ENTRIES.items()}
    if path.suffix.lower() == ".mat":
        for key, x in entries.items():
            entries[key] = np.atleast_2d(x) if isinstance(x, np.ndarray) else x  # rows stay rows
        entries["provenance"] = json.dumps(dict(record.provenance))
        units = {key: unit for key, unit in units.items() if key in entries}
        write_mat(path, {"format": _FORMAT, **entries}, units)
    else:
        write_json({"format": _FORMAT, **plain(entries), "units": units}, path)


def read_record(
    path: Path | str,
    convention: str | None = None,
    names: Mapping[str, str] | None = None,
    usual: str | None = None,
) -> tuple[GaitFile | Samples, str, str]:
    """Read a gait file; returns (record or samples, name of the convention, name of the source for messages).

    Samples come from a .csv, from a result of FROST, and from a file that has t and q and no coefficients. All
    else is a record.

    convention: of a file that does not state its own. Where neither does, a gait stored by this package and
    samples t, q are in the robot's own coordinates, and all else is in the convention `usual`; for None a
    result of FROST is in "frost", and any other file an error. names: the file's names of its entries where
    they differ from ours, such as {"coefficients": "alpha"}, as `entries` reads them; "step" names one of
    FROST's steps, else the first is taken. Raises InputError and GaitError that name the file.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix == ".csv":
        return read_csv(path), convention or OWN, path.name
    if suffix not in (".json", ".mat"):
        raise InputError(f"gait file '{path}', expected .json, .mat or .csv at its end")
    result = read_mat(path) if suffix == ".mat" else read_json(path, "gait file")
    with reading("gait file", path, GaitError):
        entries, source = all_entries(result), path.name
        known, steps, names = list(entries), frost_steps(entries), dict(names or {})
        # absent: names of what is missing, for one message on all of it; `units` is written last, so a file
        # written here without it is not complete
        cut_off = result.get("format") == _FORMAT and "units" not in result
        absent = ["units, so it is cut off"] if cut_off else []
        # a result of FROST, unless the caller or the file itself names curves or samples
        if steps and not {"coefficients", "q"} & {*names, *entries}:
            step = names.pop("step", next(iter(steps)))
            others = ", ".join(x for x in steps if x != step)
            source += f", {step}" + (f"; left out: {others}" if others else "")
            absent += [] if step in steps else [f"step {step} of {list(steps)}"]
            entries |= steps.get(step, {})
            convention = convention or usual or "frost"
        for ours, theirs in names.items():
            try:
                entries[ours] = entry(entries, theirs)
            except (KeyError, IndexError, ValueError, TypeError):
                absent.append(theirs)
        samples = "coefficients" not in entries and {"t", "q"} <= set(entries)
        absent += [key for key in GaitFile.REQUIRED if not samples and key not in entries]
        if absent:
            more = f" and {len(known) - _SHOWN} more" if len(known) > _SHOWN else ""
            raise GaitError(
                f"the entries {absent} are missing; the file has {sorted(known)[:_SHOWN]}{more}. Say what they "
                'are called there with names={"coefficients": "..."}, or --name coefficients=...'
            )
        stated = entries.get("convention")
        # without a statement these two are in the robot's own coordinates: gaits of this package, and samples
        # FORMAT: of a gait that this package stored
        stored = result.get("format") == FORMAT or samples
        convention_ = stated or convention or (OWN if stored else usual)
        # no convention, or two different ones
        if convention_ is None or (stated and convention not in (None, stated)):
            raise GaitError(
                f"the file says convention '{stated}', and '{convention}' is given; expected one of the two to "
                "be a name: add an entry 'convention', or give convention=..."
            )
        if samples:
            return Samples(entries["t"], entries["q"], entries.get("v")), convention_, source
        record = {f.name: entries[f.name] for f in fields(GaitFile) if f.name in entries}
        for key in ("coefficients", "outputs"):
            if isinstance(record.get(key), np.ndarray):
                record[key] = np.atleast_2d(record[key])  # one row, squeezed by loadmat
        provenance = record.get("provenance", {})
        if isinstance(provenance, str):
            provenance = json.loads(provenance)
        record |= {"convention": str(convention_), "provenance": dict(provenance)}
        return GaitFile(**record), str(convention_), source


RUN_UNITS = {
    name: unit
    for unit, names in {
        "s": "t",
        "1": "step",
        "m": "swing_foot hip foothold foothold_height",
        "rad": "q theta q_d error",
        "rad/s": "v dtheta dq_d",
        "rad/s^2": "a xi xi_estimate xi_external xi_matched xi_nominal",
        "N": "ground_reaction outside",
        "N s": "momentum",
        "N m": "u zeta zeta_estimate",
        "J": "kinetic potential",
    }.items()
    for name in names.split()
}
"""Name of a column of `biped_adrc.analysis.signals.Signals` -> its unit."""


def export_run(columns: Mapping[str, Array], path: Path | str, note: str = "") -> None:
    """Write signals at K instants, (K,) or (K, ...), by name as in `vars(walk.signals)`, as a .mat file.

    columns: in this paper's coordinates and in the units RUN_UNITS. note: free text. Raises InputError for
    another suffix, and OutputError.
    """
    about = {"format": "biped_adrc exchanged run 1", "convention": "paper", "note": note}
    arrays = {name: np.asarray(column, dtype=float) for name, column in columns.items()}
    units = {name: RUN_UNITS[name] for name in columns}
    write_mat(output_path(path, (".mat",)), {**about, **arrays}, units)


RATES = 1e-2
"""Largest difference between the rates before impact that a record states and those of its curve [rad/s]."""
SLOPES = 1e-2
"""Largest jump of dq/dTheta through the impact in a gait whose slopes close [rad/rad]."""


def import_gait(
    gait: GaitFile | Samples | Path | str,
    biped: Biped,
    convention: str | None = None,
    names: Mapping[str, str] | None = None,
    slopes: bool = True,
    degree: int = 6,
    slope: float = 0.0,
) -> Gait:
    """Import a gait from arrays, or from a .json, .mat or .csv file, in any angle convention.

    gait: the record or its file. biped: the robot that walks it. convention: of a file that does not state its
    own; "own" for the coordinates of the robot's record as they are, needed for a robot whose legs and phase
    differ from the paper's. names: the file's names of its entries where they differ from ours, such as
    {"coefficients": "alpha"}, or "R.alpha" in a struct. slopes: also check that the slopes close through the
    impact of this robot; False accepts constraints that are not hybrid-invariant. Without q_minus, v_minus or
    period these come from the zero dynamics.

    To `Samples` of a step over time (t, q, and perhaps v) curves are fitted. degree: of these curves. slope
    [rad]: of their ground, positive downhill.

    The gait is named by the record ("imported" where it has no name) and can be walked and saved as any other.

    Raises GaitError that names the joint, what was found, what was expected and what to try; InputError
    for a file that cannot be read.

    >>> ba.export_gait(gait, folder / "walk.mat", "frost")
    >>> again = ba.import_gait(folder / "walk.mat", biped)
    >>> round(again.period - gait.period, 12)
    0.0
    """
    check_part(biped, "biped", Biped)
    check_part(gait, "gait", GaitFile, Samples, str, Path)
    # for samples: what the provenance says of them, and the gait's name
    source, title = "arrays", "samples"
    if isinstance(gait, str | Path):
        # usual: the convention of a file that states none; None for a robot of the paper: it has to be stated
        title, usual = Path(gait).stem, None if of_the_paper(biped) else OWN
        gait, convention, source = read_record(gait, convention, names, usual)
    # the convention in which the numbers are to be read; OWN: the robot's own coordinates
    own = gait.convention if isinstance(gait, GaitFile) else convention or OWN

    def attempt(convention: str, robot: Biped, slopes: bool) -> Gait:
        """The gait, read in this convention for this robot, and checked; slopes: whether it is also checked
        that dq/dTheta after the impact is that at the start of the curve.
        """
        if isinstance(gait, Samples):
            layout = layout_of(convention, robot)
            return gait_of_samples(gait, robot, layout, degree, slope, title, source)
        result = _gait_of(replace(gait, convention=convention), robot, source)
        if slopes:
            check_slopes(result, robot)
        return result

    def closes(convention: str, robot: Biped, slopes: bool) -> bool:
        """Whether the numbers are a gait in this convention for this robot; slopes: whether they also have to
        close through its impact in dq/dTheta.
        """
        # `attempt` raises one of these where they are no gait
        with suppress(GaitError, InputError):
            return bool(attempt(convention, robot, slopes))  # a Gait counts as True
        return False

    try:
        return attempt(own, biped, slopes)
    except GaitError as error:
        d, hint = biped.description, ""
        # would the same numbers be a gait with another set of masses, or in another convention?
        presets = [x for x in d.presets if closes(own, _with_preset(biped, x), slopes)]
        # right: the poses fit in this convention, so only the masses differ, and no other one is proposed
        right = closes(own, biped, False)
        layouts = [x for x in CONVENTIONS if not right and closes(x, biped, False)]
        for word, others in (("preset", presets), ("convention", layouts)):
            if others:
                hint = f'; it would close in {others}, try {word}="{others[0]}"'
        if isinstance(gait, Samples) and not hint:
            # explained: which change of the robot would give these samples; it raises where already the poses
            # do not fit the legs
            with suppress(GaitError, InputError):
                hint = explained(gait, biped, layout_of(own, biped), degree, slope)
        raise GaitError(f"{error}{hint}") from error


def _with_preset(biped: Biped, name: str) -> Biped:
    """The robot with another of its presets (sets of masses and rotors)."""
    d = biped.description
    return replace(biped, preset=name, tree=d.tree(name), armature=d.presets[name].armature)


def _gait_of(record: GaitFile, biped: Biped, source: str) -> Gait:
    """The gait of a record, completed by the zero dynamics and checked. Raises GaitError.

    source: of the record, for a provenance that states none.
    """
    layout = layout_of(record.convention, biped)
    every, turns = coordinates(record, layout)
    along, remark = onto_ground(every, biped, record.slope)
    # every, along: curves of all coordinates, before and after that; turns: whole turns (n,) that were added
    # dq is dq/ds at s = 1, so dq / span is dq/dTheta before impact
    curve, span = along.curve, along.theta_minus - along.theta_plus
    # the gait's constraint: the curves of the joints with motors, without the last row
    constraint = replace(along, curve=type(curve)(curve.coefficients[:-1]))
    q, dq, _ = curve(1.0)
    provenance = dict(record.provenance) or {
        "method": f"imported from convention '{record.convention}'",
        "source": source,
    }
    if turns.any():
        provenance["whole turns added to q"] = ", ".join(f"{k:g}" for k in turns)
    provenance |= remark
    robot, preset = record.robot or biped.description.name, record.preset or biped.preset
    names = record.name, robot, preset
    # the curve alone gives the state before impact up to its speed: |Theta'| = 1 rad/s, and a period of 1 s
    gait = Gait(*names, constraint, q, dq / abs(span), 1.0, provenance, record.slope).check(biped)
    if record.q_minus is not None and record.v_minus is not None:
        # the record's state, moved as its curves were: by whole turns, and with the foot onto the ground
        q = layout.to_paper.angles(record.q_minus) + 2.0 * np.pi * turns
        q, v = q + foot_down(biped, q, record.slope)[0], layout.to_paper.rates(record.v_minus)
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
        # {}: no provenance, as only state and period of this gait are used
        orbit = Gait.of_cycle(record.name, ZeroDynamics.of(biped, constraint), {})
        gait = replace(gait, period=orbit.period)
        if record.q_minus is None:
            gait = replace(gait, q_minus=orbit.q_minus, v_minus=orbit.v_minus)
    return replace(gait, period=record.period or gait.period).check(biped)


def check_slopes(gait: Gait, biped: Biped) -> None:
    """Raise GaitError unless the gait is hybrid-invariant: dq_b/dTheta after the impact of this robot is the
    slope dh/dTheta at the start, within SLOPES.

    It depends on the masses, so this is the one check that tells robots of equal link lengths apart.
    """
    # how far the rates after impact are from those along the constraint, (p,) [rad/s]
    _, jump = impact_jump(biped, gait.constraint, gait.q_minus, gait.v_minus)
    # rates over Theta'+ are slopes [rad/rad]
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

    gait: the gait to write. path: of the file, .json or .mat. convention: name of the convention of the angles
    in the file. biped: the gait's robot; None loads the package's robot of that name. Raises InputError for
    another suffix, convention or robot, and OutputError where the file cannot be written.

    >>> ba.export_gait(gait, folder / "gait.mat", "frost")
    >>> ba.import_gait(folder / "gait.mat", biped).name
    'v0.8'
    """
    check_part(gait, "gait", Gait)
    biped = Biped.load(gait.robot, gait.preset) if biped is None else biped
    write_record(record_of(gait, biped, convention), path)
