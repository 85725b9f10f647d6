"""Does a gait that comes from elsewhere close, and if not, in which angle convention would it?

The end of a step, relabelled, is the start of the next: q(0) = R q(1), every coordinate of it, and with a
robot dq/dTheta after the impact is the slope at s = 0 (the constraint is hybrid-invariant). Every failure is
a GaitError that names the joint, what was found, what was expected, the likely cause and what to try.
"""

from __future__ import annotations

from dataclasses import replace

from biped_adrc.errors import GaitError
from biped_adrc.gait.conventions import CONVENTIONS
from biped_adrc.gait.exchange.convert import Coordinates, coordinates
from biped_adrc.gait.exchange.misfits import Misfit, first_misfit
from biped_adrc.gait.exchange.record import GaitRecord
from biped_adrc.model.biped import Biped


def check(record: GaitRecord, biped: Biped | None = None, slopes: bool = True) -> Coordinates:
    """The gait in this paper's coordinates, once it is known to close. Raises GaitError.

    biped: also its feet, and with `slopes` the impact. slopes=False accepts constraints that are not
    hybrid-invariant, such as those of the recipe of section IV.
    """
    try:
        along = coordinates(record)
    except GaitError as error:
        raise GaitError(f"{error}{_hint(record, biped)}") from error
    misfit = first_misfit(record, along, biped, slopes)
    if misfit is not None:
        raise _error(record, misfit, biped)
    return along


def closing_conventions(record: GaitRecord, biped: Biped | None = None) -> tuple[str, ...]:
    """The conventions in which these numbers would be a gait that closes, slopes not considered."""
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
    text = f"{m.where}: found {m.found}, expected {m.expected}. Likely cause: "
    hint = _hint(record, biped) if m.geometric else ""
    if hint:
        return record.error(f"{text}the angles are in another convention{hint}. If not: {m.cause}")
    none = f" (it closes in none of the conventions {list(CONVENTIONS)})" if m.geometric else ""
    return record.error(f"{text}{m.cause}{none}")


def _hint(record: GaitRecord, biped: Biped | None) -> str:
    """Which conventions would close, as the end of a message; empty where none would."""
    others = [name for name in closing_conventions(record, biped) if name != record.convention]
    if not others:
        return ""
    names = " or ".join(f"'{name}'" for name in others)
    return f'; it would close in {names}. Try convention="{others[0]}"'
