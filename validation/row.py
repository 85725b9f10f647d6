"""One line of the verification: an expected value, the value found here, and how far apart they may be.

    relative    |found - expected| / |expected| <= tolerance
    absolute    |found - expected| <= tolerance
    at most     found <= expected

A row without a tolerance shows the two numbers beside each other and asserts nothing. NaN never holds. Made by
all modules of `validation`; tests assert `holds`, and docs/verification.csv has `cells`.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from biped_adrc.core import verdict
from biped_adrc.core.errors import InputError
from biped_adrc.core.files import packaged
from biped_adrc.core.verdict import Check

PRESETS = ("identified", "identified-bare", "tac2003")
"""Of RABBIT."""


class Measure(Enum):
    """How found and expected are compared; the values are the words in the table."""

    RELATIVE = "relative"
    ABSOLUTE = "absolute"
    AT_MOST = "at most"


COLUMNS = (
    *("system", "quantity", "expected", "found", "difference"),
    *("tolerance", "source", "note", "verdict"),
)
"""Of the table."""


@dataclass(frozen=True)
class Row:
    """One comparison. Raises InputError for a negative tolerance, or a relative one of an expected 0."""

    system: str
    """What was computed."""
    quantity: str
    """With its unit in brackets."""
    expected: float
    """The published value, or the limit."""
    found: float
    """Here."""
    tolerance: float | None
    """In the measure's terms; None for a row without a target."""
    source: str
    """Where the expected value comes from."""
    measure: Measure = Measure.RELATIVE
    """How the two are compared."""
    note: str = ""
    """For a reader."""

    def __post_init__(self) -> None:
        if self.tolerance is not None and not self.tolerance >= 0.0:
            raise InputError(
                f"the tolerance of '{self.quantity}' is {self.tolerance}, expected a number >= 0 or None"
            )
        if self.measure is Measure.RELATIVE and self.expected == 0.0:
            raise InputError(
                f"'{self.quantity}' is expected to be 0, of which nothing is a share; take Measure.ABSOLUTE"
            )

    @property
    def difference(self) -> float:
        """In the units of the tolerance; of `at most`, by how much the limit is passed (negative below it)."""
        gap = float(self.found - self.expected)
        if self.measure is Measure.AT_MOST:
            return gap
        return abs(gap / self.expected) if self.measure is Measure.RELATIVE else abs(gap)

    @property
    def has_target(self) -> bool:
        """Whether the row asserts anything."""
        return self.tolerance is not None

    @property
    def holds(self) -> bool:
        """Whether it is within its tolerance; False for a row without one."""
        return self.check is not None and self.check.holds

    @property
    def check(self) -> Check | None:
        """The assertion; None for a row without a tolerance."""
        if self.tolerance is None:
            return None
        return verdict.at_most(self.quantity, "law", self.difference, self.tolerance)

    @property
    def verdict(self) -> str:
        """In words."""
        if not self.has_target:
            return "no target"
        return "holds" if self.holds else "DOES NOT HOLD"

    def cells(self) -> list[str]:
        """One text for each of COLUMNS."""
        limit = self.measure is Measure.AT_MOST
        return [
            self.system,
            self.quantity,
            f"at most {self.expected:g}" if limit else f"{self.expected:.9g}",
            f"{self.found:.9g}",
            "" if limit else f"{self.difference:.1e}",
            f"{self.tolerance:g} {self.measure.value}" if self.has_target and not limit else "",
            self.source,
            self.note,
            self.verdict,
        ]


def at_most(system: str, quantity: str, limit: float, found: float, source: str) -> Row:
    """A row that holds where found <= limit."""
    return Row(system, quantity, limit, found, 0.0, source, Measure.AT_MOST)


def nothing(
    system: str, quantity: str, found: float, tolerance: float, source: str, note: str = ""
) -> Row:
    """A row that expects 0, and holds where |found| <= tolerance: for gaps that have no other scale."""
    return Row(system, quantity, 0.0, float(found), tolerance, source, Measure.ABSOLUTE, note)


def published(name: str, *found: float, note: str = "") -> tuple[Row, ...]:
    """Rows of published.toml by name, one for each number found, in its order.

    Expected values, tolerance, source and note come from the file; a note given here replaces that of the file.
    """
    said = packaged("validation", "published.toml")[name]
    note = note or said.get("note", "")
    return tuple(
        Row(said["system"], q, x, float(here), said.get("tolerance"), said["source"], note=note)
        for (q, x), here in zip(said["expected"].items(), found, strict=True)
    )
