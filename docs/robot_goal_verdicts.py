"""What the goal on RABBIT's hardware demands, and whether it was found, for docs/robot_goal.md."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple


class Verdict(NamedTuple):
    """One demand of the goal."""

    words: str
    needed: str
    found: str
    met: bool


def spanned(x: Sequence[float]) -> str:
    """A number with its interval."""
    return f"{x[0]:.3g} ({x[1]:.3g} to {x[2]:.3g})"


def percent(x: Sequence[float]) -> str:
    return f"{100.0 * x[0]:.1f} %"


def counted(cell: Mapping[str, Any], what: str) -> str:
    """How many of the walks are legal, or made."""
    return f"{round(cell[what][0] * cell['walks'])} of {cell['walks']}"


def setting(s: Mapping[str, Any], role: str) -> Any:
    """The setting of a role."""
    return s["settings"][s["roles"][role]]


def verdicts(s: Mapping[str, Any], g: Mapping[str, Any], role: str = "goal") -> list[Verdict]:
    """What the goal demands, and what was found by the setting of a role."""
    goal, cell, one = g["goal"], s["test"][role], setting(s, role)
    ratio, friction, cost = (cell[k] for k in ("ratio", "friction_ratio", "cost_ratio"))
    push, legal = s["push"][role]["ratio"], round(cell["legal"][0] * cell["walks"])
    least = math.ceil(goal["legal"] * cell["walks"] / g["test"]["seeds"]["count"])
    borne = one["delay_margin"] + one["values"]["delay"]
    return [
        Verdict(
            "rms tracking error over the better rival's, upper end",
            f"at most {goal['ratio']:g}",
            spanned(ratio),
            ratio[2] <= goal["ratio"],
        ),
        Verdict(
            "that error over the better of both rivals, walk by walk",
            f"at most {goal['ratio']:g}",
            spanned(cell["ratio_each"]),
            cell["ratio_each"][2] <= goal["ratio"],
        ),
        Verdict(
            "the aim for that error",
            f"at most {goal['aim']:g}",
            spanned(ratio),
            ratio[2] <= goal["aim"],
        ),
        Verdict(
            f"legal of {cell['walks']} walks",
            f"at least {least}",
            f"{legal} ({100 * cell['legal'][1]:.1f} to {100 * cell['legal'][2]:.1f} %)",
            legal >= least,
        ),
        Verdict(
            "hidden delay borne over the inertia set",
            f"at least {1e3 * goal['delay']:g} ms",
            f"{1e3 * borne:.2f} ms",
            borne >= goal["delay"],
        ),
        Verdict(
            "either friction needed, over the better rival's",
            f"at most {goal['friction']:g}",
            spanned(friction),
            friction[2] <= goal["friction"],
        ),
        Verdict(
            "or largest legal push, over the better rival's",
            f"at least {goal['push']:g}",
            spanned(push),
            push[1] >= goal["push"],
        ),
        Verdict(
            "cost of transport, over the better rival's",
            f"at most {goal['cost']:g}",
            spanned(cost),
            cost[2] <= goal["cost"],
        ),
    ]


def reached(found: Sequence[Verdict]) -> bool:
    """Whether the goal is met: all but the aim, and one of friction and push."""
    ratio, each, _, legal, delay, friction, push, cost = (v.met for v in found)
    return ratio and each and legal and delay and (friction or push) and cost


def outcome(s: Mapping[str, Any], g: Mapping[str, Any]) -> str:
    """The sentences at the top."""
    if reached(verdicts(s, g)):
        missed = _missed(verdicts(s, g))
        return "**The goal is met.**" + (
            f" What is not reached beside it: {missed}." if missed else ""
        )
    return (
        f"**The goal is not met.** What the ADRC for the goal misses: {_missed(verdicts(s, g))}. What the "
        f"closest ADRC misses: {_missed(verdicts(s, g, 'closest'))}."
    )


def _missed(found: Sequence[Verdict]) -> str:
    return "; ".join(f"{v.words}: {v.found}, needed {v.needed}" for v in found if not v.met)
