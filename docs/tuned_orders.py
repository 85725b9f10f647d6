"""What tuned orders of the observer are worth, from the comparison: parts of observer guide and README.

Each order has its own search, so a difference is that of the orders and not of a bandwidth. Words follow from
the tests of the summary; what no test carries is called open.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from write_results import bullets, table

from biped_adrc.bench.findings import ORDER, ORDERED
from biped_adrc.errors import InputError
from biped_adrc.viz.comparison_text import by_condition, interval, percent

SHOWN = ("push on joints", "RABBIT pushed", "RABBIT late")
"""Conditions that the observer guide shows."""
HARDWARE = "RABBIT pushed"
"""The condition of which the README tells."""
FIRST = "m = 1"
"""The order that others are held against."""
HEADINGS = ("condition", "contestant", "bandwidth [rad/s]", "legal [%]", "rms error [mrad]")


def guide_part(summary: Mapping[str, Any]) -> str:
    """NPD and the orders under the conditions that the guide shows, and whether a higher order pays there."""
    cells = [c for c in summary["cells"] if c["condition"] in SHOWN and _has_order(summary, c)]
    if not summary["set"]["places"] or not cells:
        raise InputError(
            "the comparison has no tuned observers under what the guide shows; expected settings that are "
            f"tuned, and one of the conditions {', '.join(SHOWN)}"
        )
    rows = [
        [
            c["condition"],
            c["controller"],
            _bandwidth(summary, c),
            percent(c["legal"]),
            interval(c["rms_error"], 3, 1e3),
        ]
        for c in by_condition(cells)
    ]
    shown = [name for name in SHOWN if name in summary["conditions"]]
    return "\n\n".join(
        [
            f"By `{summary['command']}` with the settings {summary['set']['name']}, {summary['seeds']} seeds, "
            "medians over legal walks, intervals of 95 %:",
            table(list(HEADINGS), rows),
            bullets([_orders(summary, name) for name in shown]),
        ]
    )


def readme_part(summary: Mapping[str, Any]) -> str:
    """What tuned m = 1 buys over tuned NPD on RABBIT's hardware, and which order pays there."""
    legal = {
        c["controller"]: f"{round(c['legal'][0] * c['walks'])} of {c['walks']}"
        for c in summary["cells"]
        if c["condition"] == HARDWARE
    }
    where = "; ".join(summary["conditions"][name] for name in ("RABBIT", HARDWARE))
    found = _answer(summary, FIRST)
    told = (
        f"leaves {interval(found['value'])} of the rms tracking error of NPD"
        if found
        else "has no pair of legal walks with NPD"
    )
    if found and not found["carried"]:
        told += " (which no test tells from 1)"
    return (
        f"Tuned by the same search, ADRC with m = 1 {told} on RABBIT's hardware ({where}), on gait "
        f"{summary['set']['values']['gait']}, median over pairs of legal walks with 95 %; legal are "
        f"{legal[FIRST]} walks under m = 1 and {legal['NPD']} under NPD. {_orders(summary, HARDWARE)} "
        "By `make comparison`; [all of it](docs/comparison.md)."
    )


def _has_order(summary: Mapping[str, Any], cell: Mapping[str, Any]) -> bool:
    """Whether a cell is of NPD, which all are held against, or of an order of the observer."""
    values = summary["set"]["contestants"].get(cell["controller"], {})
    return cell["controller"] == "NPD" or values.get("controller") == ORDERED


def _bandwidth(summary: Mapping[str, Any], cell: Mapping[str, Any]) -> str:
    """The tuned bandwidth of a cell [rad/s]; a dash without an observer."""
    there = summary["set"]["places"].get(summary["places"][cell["condition"]], {})
    chosen = there.get(cell["controller"], {}).get("bandwidth")
    return "–" if chosen is None else f"{chosen:.3g}"


def _orders(summary: Mapping[str, Any], condition: str) -> str:
    """Whether an order above 1 pays under a condition, in a sentence."""
    asked = [q for q in summary["tests"] if (q["family"], q["condition"]) == (ORDER, condition)]
    kinds: dict[str, list[str]] = {"smaller": [], "larger": [], "open": []}
    for q in asked:
        kind = "open" if not q["carried"] else "smaller" if q["value"][2] < 1.0 else "larger"
        kinds[kind].append(f"{q['controller']} {interval(q['value'])}")
    told = "; ".join(f"{kind} for {', '.join(names)}" for kind, names in kinds.items() if names)
    beside = f"Beside {FIRST} under '{condition}' the rms error is"
    return f"{beside} {told}." if told else f"{beside} not known: no pair of walks is legal."


def _answer(summary: Mapping[str, Any], name: str) -> Mapping[str, Any] | None:
    """The question about a contestant's rms error on RABBIT's hardware, if it could be asked."""
    at = ("rms_error", HARDWARE, name)
    found = (q for q in summary["tests"] if (q["family"], q["condition"], q["controller"]) == at)
    return next(found, None)
