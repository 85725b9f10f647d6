"""Write docs/comparison.md and its figures from the summary of a comparison.

Run: python docs/write_comparison.py OUT

OUT: folder of `biped-adrc compare` with all controllers and conditions. A sentence of the page that the numbers
do not carry is an error.
"""

from __future__ import annotations

import argparse
import json
import shutil
from pathlib import Path
from typing import Any

from write_results import bullets, table

from biped_adrc.errors import InputError
from biped_adrc.files import write_text
from biped_adrc.viz.comparison_page import CAPTIONS, HEADINGS, cell_texts, interval

ROOT = Path(__file__).resolve().parents[1]
HIGH, LOW = "ADRC", "LESO"
"""The observer of Table I, m = 7, and the linear one, m = 1."""


CANCELLED = ("push on joints", "sine on joints", "noise on joints")
"""What the motors can cancel."""


class Numbers:
    """The cells of a summary."""

    def __init__(self, summary: dict[str, Any]):
        self.cells = {(c["controller"], c["condition"]): c for c in summary["cells"]}

    def share(self, who: str, what: str) -> float:
        """Of walks that survive, in per cent."""
        return 100.0 * float(self.cells[who, what]["survived"][0])

    def median(self, who: str, what: str, measure: str = "peak_error") -> float:
        """Of a measure."""
        found = self.cells[who, what][measure]
        if found is None:
            raise InputError(f"no walk of {who} under '{what}' survived, so it has no {measure}")
        return float(found[0])


def said(holds: bool, sentence: str) -> str:
    """The sentence. Raises InputError when the numbers do not carry it."""
    if not holds:
        raise InputError(f"the numbers of this comparison do not carry: {sentence}")
    return sentence


def where_it_wins(n: Numbers) -> str:
    """Of the high order."""
    gains = [n.median("NPD", c) / n.median(HIGH, c) for c in CANCELLED]
    torque = [n.median(HIGH, c, "rms_torque") / n.median("NPD", c, "rms_torque") for c in CANCELLED]
    over_low = [n.median(LOW, c) / n.median(HIGH, c) for c in CANCELLED]
    return said(
        min(gains) > 5.0 and min(over_low) > 2.0 and max(torque) < 1.05,
        "**Where the high order wins.** With exact sensors and no delay ADRC with m = 7 tracks "
        f"{min(gains):.0f} to "
        f"{max(gains):.0f} times closer than NPD under torques that the motors can cancel (a push, a "
        "sine, noise), and "
        f"{min(over_low):.0f} to {max(over_low):.0f} times closer than the observer with m = 1. It does "
        "not need more "
        f"torque for it.",
    )


def largest_pushes(summary: dict[str, Any]) -> str:
    """On the joints, against NPD, and who stands the largest."""
    found = {(p["controller"], p["direction"], p["phase"]): p["push"][0] for p in summary["pushes"]}
    joints = [key[1:] for key in found if key[0] == HIGH and "torso" not in key[1]]
    ratio = {
        who: sum(found[who, *k] / found["NPD", *k] for k in joints) / len(joints)
        for who in summary["controllers"]
    }
    more = 100.0 * (ratio[HIGH] - 1.0)
    n, others = Numbers(summary), [who for who in summary["controllers"] if who != "PD"]
    loose = all(
        n.share("PD", c) >= max(n.share(who, c) for who in others) for c in summary["conditions"]
    )
    worst = all(n.median("PD", c) > n.median("NPD", c) for c in CANCELLED)
    return said(
        0.0 < more < 20.0 and loose and worst,
        "**How large a push.** With 150 N m the motors set the limit, not the observer: over directions "
        "and phases "
        f"the largest push on the joints that ADRC with m = 7 survives is {more:.0f} % above NPD's in "
        "the mean "
        f"(m = 1: {100 * (ratio[LOW] - 1):+.0f} %, CLF-QP {100 * (ratio['CLF-QP'] - 1):+.0f} %, PD "
        f"{100 * (ratio['PD'] - 1):+.0f} %). PD with gravity compensation tracks worst by far and falls "
        "least of all: "
        "a loose joint forgives what a stiff one has to hold.",
    )


def where_it_loses(n: Numbers) -> str:
    """Noise, delay, unmatched disturbances."""
    falls = [n.share(HIGH, c) for c in ("encoders", "RABBIT", "delay")]
    stands = [n.share(LOW, c) for c in ("encoders", "RABBIT", "delay")]
    torso = [n.median(who, "push on the torso", "speed_change") for who in ("NPD", HIGH, LOW)]
    pull = [n.median(who, "pull at the torso", "speed_change") for who in ("NPD", HIGH, LOW)]
    ground = [n.share(who, "uneven ground") for who in ("NPD", HIGH, LOW)]
    model = n.median("NPD", "wrong model") / n.median(HIGH, "wrong model")
    spread = max(pull) - min(pull)
    return said(
        max(falls) < 20.0 and min(stands) > 80.0 and spread < 0.02 and model < 5.0,
        "**Where it loses.** With encoders of 8192 counts, with RABBIT's own sampling and encoders, and "
        "with 2 ms of "
        f"delay that it does not know, {falls[0]:.0f}, {falls[1]:.0f} and {falls[2]:.0f} % of its walks "
        "make all steps; "
        f"with m = 1 it is {stands[0]:.0f}, {stands[1]:.0f} and {stands[2]:.0f} %. Its bandwidth is "
        "bought with gains that "
        "turn one count into torques beyond any motor, and with a delay margin of 85 microseconds "
        "([the observer assistant](guide/observer.md)). What is unmatched it cannot reject either: 3 N "
        "at the torso "
        f"changes the speed by {100 * pull[0]:.1f} % under NPD, {100 * pull[1]:.1f} % under ADRC and "
        f"{100 * pull[2]:.1f} % "
        f"with m = 1, a push on the torso by {100 * torso[0]:.1f}, {100 * torso[1]:.1f} and "
        f"{100 * torso[2]:.1f} %, and on "
        f"uneven ground, where impacts throw the state off the constraint, {ground[0]:.0f}, "
        f"{ground[1]:.0f} and "
        f"{ground[2]:.0f} % survive. Against a wrong model it gains {model:.1f} times over NPD: the "
        "reference itself is "
        "computed with the nominal unactuated row. The output form estimates that row's part too, and "
        "tracks closer "
        "under torques on the torso; it changes the speed no less.",
    )


def page(summary: dict[str, Any]) -> str:
    """The text of docs/comparison.md."""
    n = Numbers(summary)
    cells = sorted(
        summary["cells"], key=lambda c: list(summary["conditions"]).index(c["condition"])
    )
    pushes = [
        [p["direction"], p["phase"], p["controller"], _push(p)]
        for p in sorted(summary["pushes"], key=lambda p: (p["direction"], p["phase"]))
    ]
    parts = [
        "# Which controller survives what",
        f"Written by `python docs/write_comparison.py` from `{summary['command']}`: {summary['walks']} "
        "walks of RABBIT, "
        f"{len(summary['controllers'])} controllers, {len(summary['conditions'])} conditions, "
        f"{summary['seeds']} seeds. "
        "Every controller meets the same draws. Shares have Wilson's intervals, medians are over the "
        "walks that make "
        "all steps and have bootstrap intervals, all of 95 %.",
        where_it_wins(n),
        where_it_loses(n),
        *([largest_pushes(summary)] if summary["pushes"] else []),
        *(figure(name) for name in CAPTIONS if name != "pushes" or pushes),
        "## The table",
        table(list(HEADINGS), [cell_texts(cell) for cell in cells]),
        "## What the numbers say",
        bullets(summary["findings"]),
        "## Largest pushes",
        table(["joints", "phase", "controller", "push [N m]"], pushes),
        "## Controllers and conditions",
        table(["controller", "what it is"], [list(x) for x in summary["controllers"].items()]),
        table(["condition", "what it is"], [list(x) for x in summary["conditions"].items()]),
        "## Versions",
        table(["part", "version"], [list(x) for x in summary["versions"].items()]),
    ]
    return "\n\n".join(parts) + "\n"


def _push(p: dict[str, Any]) -> str:
    return ("at least " if p["beyond"] else "") + interval(p["push"], 3)


def figure(name: str) -> str:
    """A figure with its caption."""
    title, caption = CAPTIONS[name]
    return f"## {title}\n\n![{title}](comparison/{name}.svg)\n\n{caption}"


def main() -> None:
    """Read, write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    out = parser.parse_args().out
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    folder = ROOT / "docs" / "comparison"
    folder.mkdir(exist_ok=True)
    for name in CAPTIONS:
        if (out / f"{name}.svg").exists():
            shutil.copyfile(out / f"{name}.svg", folder / f"{name}.svg")
    write_text(ROOT / "docs" / "comparison.md", page(summary))


if __name__ == "__main__":
    main()
