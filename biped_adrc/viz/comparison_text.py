"""The tables of a comparison of controllers as plain text.

`biped-adrc compare` writes a summary (plain values, summary.json); this module turns its entries
into rows of text, which `viz.pages` puts on the HTML page.

Shares of walks and medians come as [value, low, high] with a confidence interval of 95 %, and are
None where no walk is left to take them of. Headings and words are in comparison.toml.
"""

from __future__ import annotations

from collections.abc import Sequence

from biped_adrc.analysis.feasibility import VERDICTS
from biped_adrc.resources import packaged
from biped_adrc.types import PlainRecord

TEXTS = packaged("biped_adrc.viz", "comparison.toml")
"""The content of comparison.toml."""
TITLE: str = TEXTS["title"]
"""Title of the page."""
WHAT_COUNTS: str = " ".join(TEXTS["what_counts"].split())
"""When a walk counts as feasible, in words."""
MEASURES: dict[str, str] = TEXTS["measures"]
"""Column of a walk's row -> heading; the median over walks that count is shown. matched and unmatched are
the parts of what the model does not know: what a motor could cancel, and the rest.
"""
NEEDS: dict[str, str] = TEXTS["needs"]
"""Column -> heading of what a walk needs of the ground and the motors: medians over the walks that
make all steps, feasible or not.
"""
REASONS: dict[str, str] = TEXTS["reasons"]
"""Column -> heading of why a walk that makes all steps is not feasible; a walk may have several reasons."""
SHARES: tuple[str, ...] = (*TEXTS["columns"]["shares"], *NEEDS.values())
"""Headings of the first table, by `share_texts`; the needs are its last columns."""
MEDIANS: tuple[str, ...] = (*TEXTS["columns"]["medians"], *MEASURES.values())
"""Headings of the second table, by `median_texts`."""
SETTINGS: tuple[str, ...] = tuple(TEXTS["columns"]["settings"])
"""Headings of the table of tuned settings, by `setting_texts`."""
UNDER: tuple[str, ...] = tuple(TEXTS["columns"]["conditions"])
"""Headings of the table of conditions, by `condition_texts`."""


def interval(found: Sequence[float] | None, digits: int = 2, factor: float = 1.0) -> str:
    """ "value (low to high)" with so many significant digits, never in powers of ten; a dash for None.

    found: [value, low, high]; factor: by which all three are multiplied, such as 100 for per cent.
    """
    if found is None:
        return "–"
    value, low, high = (f"{float(f'{factor * x:.{digits}g}'):g}" for x in found)
    return f"{value} ({low} to {high})"


def percent(found: Sequence[float] | None) -> str:
    """A share [1] with its interval, in per cent with three digits."""
    return interval(found, 3, 100.0)


def who(cell: PlainRecord) -> str:
    """The controller of a cell, and that it walks as published where the others are tuned."""
    return (
        f"{cell['controller']} (as published)" if cell["as_published"] else str(cell["controller"])
    )


def by_condition(cells: Sequence[PlainRecord]) -> list[PlainRecord]:
    """The cells in the order of their conditions' first appearance, so that those of one condition are
    together.
    """
    order = list(dict.fromkeys(c["condition"] for c in cells))
    return sorted(cells, key=lambda c: order.index(c["condition"]))


def share_texts(cell: PlainRecord) -> list[str]:
    """A row of the first table: how many walks are feasible, how many make all steps, and why not.

    cell: one controller under one condition, as `bench.cell.Cell.row` gives it.
    """
    ended = ", ".join(f"{n} {status.lower()}" for status, n in cell["falls"].items())
    reasons = [
        f"{REASONS[name]} {100 * found[0]:.0f}"
        for name, found in cell["reasons"].items()
        if found[0]
    ]
    return [
        cell["condition"],
        who(cell),
        percent(cell["feasible"]),
        percent(cell["but_impact"]),
        percent(cell["survived"]),
        ended or "–",
        ", ".join(reasons) or "–",
        percent(cell["impulse"]),
        *(interval(cell["needs"][name]) for name in NEEDS),
    ]


def median_texts(cell: PlainRecord) -> list[str]:
    """A row of the second table: how many walks count, and the medians of `MEASURES` over them."""
    share = cell["feasible"][0] + cell["but_impact"][0]
    count = f"{round(share * cell['walks'])} of {cell['walks']}"
    return [cell["condition"], who(cell), count, *(interval(cell[n]) for n in MEASURES)]


def setting_texts(told: PlainRecord, places: PlainRecord) -> list[list[str]]:
    """The rows of the tuned settings: place, contestant, and its values there [SI].

    told: `bench.settings.Settings` in plain values. places: of each condition; one without a condition is left
    out.
    """
    return [
        [place, name, ", ".join(f"{key.removeprefix('own.')} = {x}" for key, x in values.items())]
        for place, there in told["places"].items()
        for name, values in there.items()
        if place in places.values()
    ]


def condition_texts(summary: PlainRecord) -> list[list[str]]:
    """The rows of the conditions: name, what it is, and whose settings controllers have there."""
    places = summary["places"] if summary["set"]["places"] else {}
    return [
        [name, words, places.get(name) or "as published"]
        for name, words in summary["conditions"].items()
    ]


def nominal_text(nominal: PlainRecord) -> str:
    """What the undisturbed walk needs of ground and motors, in a sentence, and which limits it breaks.

    nominal: "status", "outcome", "broken" (limits that are not kept), "needs" by name of `NEEDS`,
    "limits".
    """
    walk = "The gait itself, walked by NPD from its own start with nothing wrong,"
    if nominal["status"] != "COMPLETED":
        return f"{walk} does not make all steps: {nominal['status'].lower()}."
    verdict = f"is {VERDICTS[nominal['outcome']]}"
    broken = ", ".join(nominal["broken"])
    beyond = f"; beyond its limit already: {broken}" if broken else ""
    limits = nominal["limits"]
    needs = [
        words.format(f"{nominal['needs'][name]:.3g}", **limits)
        for name, words in TEXTS["nominal"].items()
        if nominal["needs"][name] is not None
    ]
    return f"{walk} {verdict}{beyond}. It needs {', '.join(needs) or 'what was not measured'}."
