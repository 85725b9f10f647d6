"""The tables and lines of a comparison as plain text, for its page and for the documentation.

They are made from the summary that `biped-adrc compare` writes: shares of walks and medians are
[value, low, high] with intervals of 95 %, None where there is nothing to take them of.
"""

from __future__ import annotations

from collections.abc import Sequence

from biped_adrc.resources import packaged
from biped_adrc.types import PlainRecord

TEXTS = packaged("biped_adrc.viz", "comparison.toml")
TITLE: str = TEXTS["title"]
WHAT_COUNTS: str = " ".join(TEXTS["what_counts"].split())
MEASURES: dict[str, str] = TEXTS["measures"]
"""Columns of a walk's row of which the median over legal walks is shown; matched and unmatched are the parts of
what the model does not know."""
NEEDS: dict[str, str] = TEXTS["needs"]
"""What a walk needs of the ground and the motors: medians over the walks that make all steps."""
REASONS: dict[str, str] = TEXTS["reasons"]
"""Why a walk that makes all steps is not legal; a walk may have several."""
SHARES: tuple[str, ...] = (*TEXTS["columns"]["shares"], *NEEDS.values())
"""Of the first table; the needs are medians over the walks that make all steps."""
MEDIANS: tuple[str, ...] = (*TEXTS["columns"]["medians"], *MEASURES.values())
"""Of the second; medians over legal walks."""
PUSHES: tuple[str, ...] = tuple(TEXTS["columns"]["pushes"])
"""Of the largest pushes [N m]."""
EQUAL: tuple[str, ...] = tuple(TEXTS["columns"]["equal"])
"""Of the observers at equal bandwidth."""
EQUAL_FAMILY = "equal_bandwidth"
"""Of the sentences about them; the others are about controllers at their own settings."""


def said(summary: PlainRecord, equal: bool) -> list[str]:
    """The sentences about observers at equal bandwidth, or all others."""
    families = summary["findings"].items()
    return [line for name, lines in families if (name == EQUAL_FAMILY) == equal for line in lines]


def interval(found: Sequence[float] | None, digits: int = 2, factor: float = 1.0) -> str:
    """A number with its interval: so many digits, and 180 rather than 1.8e+02."""
    if found is None:
        return "–"
    value, low, high = (f"{float(f'{factor * x:.{digits}g}'):g}" for x in found)
    return f"{value} ({low} to {high})"


def percent(found: Sequence[float] | None) -> str:
    """A share with its interval, in per cent."""
    return interval(found, 3, 100.0)


def by_condition(cells: Sequence[PlainRecord]) -> list[PlainRecord]:
    """The cells, those of one condition together."""
    order = list(dict.fromkeys(c["condition"] for c in cells))
    return sorted(cells, key=lambda c: order.index(c["condition"]))


def share_texts(cell: PlainRecord) -> list[str]:
    """A row of the first table."""
    ended = ", ".join(f"{n} {status.lower()}" for status, n in cell["falls"].items())
    reasons = [
        f"{REASONS[name]} {100 * found[0]:.0f}"
        for name, found in cell["reasons"].items()
        if found[0]
    ]
    return [
        cell["condition"],
        cell["controller"],
        percent(cell["legal"]),
        percent(cell["survived"]),
        ended or "–",
        ", ".join(reasons) or "–",
        percent(cell["impulse"]),
        *(interval(cell["needs"][name]) for name in NEEDS),
    ]


def median_texts(cell: PlainRecord) -> list[str]:
    """A row of the second table."""
    count = f"{round(cell['legal'][0] * cell['walks'])} of {cell['walks']}"
    return [cell["condition"], cell["controller"], count, *(interval(cell[n]) for n in MEASURES)]


def push_texts(push: PlainRecord) -> list[str]:
    """A row of the largest pushes."""
    spans = [span(push[kind][of]) for kind in ("legal", "survived") for of in ("median", "seeds")]
    at = "" if push["bandwidth"] is None else f", {push['bandwidth']:.0f} rad/s"
    return [push["direction"], push["phase"], push["controller"] + at, *spans]


def by_direction(pushes: Sequence[PlainRecord]) -> list[PlainRecord]:
    """The pushes, those on the same joints in the same phase together."""
    return sorted(pushes, key=lambda p: (p["direction"], p["phase"]))


def span(found: Sequence[float | None]) -> str:
    """Between what a number lies; None above for "at least"."""
    low, high = found
    if high is None:
        return f"at least {low:.3g}"
    return f"{low:.3g}" if low == high else f"{low:.3g} to {high:.3g}"


def equal_texts(equal: Sequence[PlainRecord]) -> list[list[str]]:
    """The rows of the observers at their own and at equal bandwidth."""
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
    """What the undisturbed walk needs, and what of it is illegal already."""
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
