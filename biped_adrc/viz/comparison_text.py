"""The tables and sentences of a comparison of controllers as plain text.

`biped-adrc compare` writes a summary (plain values, summary.json); this module turns its entries
into rows of text. `viz.pages` puts them on the HTML page and `docs/write_comparison.py` into the
documentation, so that both say the same.

Shares of walks and medians come as [value, low, high] with a confidence interval of 95 %, and are
None where no walk is left to take them of. Headings and words are in comparison.toml.
"""

from __future__ import annotations

from collections.abc import Sequence

from biped_adrc.resources import packaged
from biped_adrc.types import PlainRecord

TEXTS = packaged("biped_adrc.viz", "comparison.toml")
"""The content of comparison.toml."""
TITLE: str = TEXTS["title"]
"""Title of the page."""
WHAT_COUNTS: str = " ".join(TEXTS["what_counts"].split())
"""When a walk counts as legal, in words."""
MEASURES: dict[str, str] = TEXTS["measures"]
"""Column of a walk's row -> heading; the median over legal walks is shown. matched and unmatched are
the parts of what the model does not know: what a motor could cancel, and the rest.
"""
NEEDS: dict[str, str] = TEXTS["needs"]
"""Column -> heading of what a walk needs of the ground and the motors: medians over the walks that
make all steps, legal or not.
"""
REASONS: dict[str, str] = TEXTS["reasons"]
"""Column -> heading of why a walk that makes all steps is not legal; a walk may have several reasons."""
SHARES: tuple[str, ...] = (*TEXTS["columns"]["shares"], *NEEDS.values())
"""Headings of the first table, by `share_texts`; the needs are its last columns."""
MEDIANS: tuple[str, ...] = (*TEXTS["columns"]["medians"], *MEASURES.values())
"""Headings of the second table, by `median_texts`."""
PUSHES: tuple[str, ...] = tuple(TEXTS["columns"]["pushes"])
"""Headings of the table of largest pushes [N m], by `push_texts`."""
SETTINGS: tuple[str, ...] = tuple(TEXTS["columns"]["settings"])
"""Headings of the table of tuned settings, by `setting_texts`."""
UNDER: tuple[str, ...] = tuple(TEXTS["columns"]["conditions"])
"""Headings of the table of conditions, by `condition_texts`."""
EQUAL: tuple[str, ...] = tuple(TEXTS["columns"]["equal"])
"""Headings of the table of observers at equal bandwidth, by `equal_texts`."""
EQUAL_FAMILY = "equal_bandwidth"
"""Name of the findings about observers at equal bandwidth; the others are about controllers at their
own settings.
"""


def said(summary: PlainRecord, equal: bool) -> list[str]:
    """The sentences of the findings: those about observers at equal bandwidth, or all others.

    summary: of a comparison, with "findings", a list of sentences for each family of questions.
    """
    families = summary["findings"].items()
    return [line for name, lines in families if (name == EQUAL_FAMILY) == equal for line in lines]


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
    """A row of the first table: how many walks are legal, how many make all steps, and why not.

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
        percent(cell["legal"]),
        percent(cell["survived"]),
        ended or "–",
        ", ".join(reasons) or "–",
        percent(cell["impulse"]),
        *(interval(cell["needs"][name]) for name in NEEDS),
    ]


def median_texts(cell: PlainRecord) -> list[str]:
    """A row of the second table: how many walks are legal, and the medians of `MEASURES` over them."""
    count = f"{round(cell['legal'][0] * cell['walks'])} of {cell['walks']}"
    return [cell["condition"], who(cell), count, *(interval(cell[n]) for n in MEASURES)]


def push_texts(push: PlainRecord) -> list[str]:
    """A row of the largest pushes: joints, phase of the step, controller, and four ranges [N m].

    The ranges are of the median and of single seeds, of walks that are legal and of those that make
    all steps.
    """
    spans = [span(push[kind][of]) for kind in ("legal", "survived") for of in ("median", "seeds")]
    at = "" if push["bandwidth"] is None else f", {push['bandwidth']:.0f} rad/s"
    return [push["direction"], push["phase"], push["controller"] + at, *spans]


def by_direction(pushes: Sequence[PlainRecord]) -> list[PlainRecord]:
    """The pushes sorted by joints and phase of the step, so that controllers under the same push are
    together.
    """
    return sorted(pushes, key=lambda p: (p["direction"], p["phase"]))


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


def span(found: Sequence[float | None]) -> str:
    """A range [low, high] found by bisection, as text; `high` is None where even the largest push
    tried was passed.
    """
    low, high = found
    if high is None:
        return f"at least {low:.3g}"
    return f"{low:.3g}" if low == high else f"{low:.3g} to {high:.3g}"


def equal_texts(equal: Sequence[PlainRecord]) -> list[list[str]]:
    """The rows of the observers, each at its own settings and below at equal bandwidth [rad/s].

    equal: pairs of cells {"own": ..., "equal": ...} for each observer and condition.
    """
    order = list(dict.fromkeys(x["own"]["condition"] for x in equal))
    ordered = sorted(equal, key=lambda x: order.index(x["own"]["condition"]))
    return [
        [
            cell["condition"],
            cell["controller"] + ("" if kind == "equal" else ", own settings"),
            f"{cell['bandwidth']:.0f}",
            percent(cell["survived"]),
            percent(cell["legal"]),
            interval(cell["peak_error"]),
        ]
        for x in ordered
        for kind, cell in x.items()
    ]


def nominal_text(nominal: PlainRecord) -> str:
    """What the undisturbed walk needs of ground and motors, in a sentence, and what of it is illegal already.

    nominal: "status", "legal", "broken" (limits that are not kept), "needs" by name of `NEEDS`,
    "limits".
    """
    walk = "The gait itself, walked by NPD from its own start with nothing wrong,"
    if nominal["status"] != "COMPLETED":
        return f"{walk} does not make all steps: {nominal['status'].lower()}."
    verdict = "is legal" if nominal["legal"] else "is not legal"
    broken = ", ".join(nominal["broken"])
    beyond = f"; beyond its limit already: {broken}" if broken else ""
    limits = nominal["limits"]
    needs = [
        words.format(f"{nominal['needs'][name]:.3g}", **limits)
        for name, words in TEXTS["nominal"].items()
        if nominal["needs"][name] is not None
    ]
    return f"{walk} {verdict}{beyond}. It needs {', '.join(needs) or 'what was not measured'}."
