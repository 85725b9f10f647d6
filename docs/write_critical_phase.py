"""Write docs/critical_phase.md: in which phase of the step a push throws which controller.

Scenario: python docs/write_critical_phase.py OUT

OUT: folder of `biped-adrc reproduce --full`, or docs/critical_phase, whose summary.json has all the cells.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, NamedTuple

from write_results import table

from biped_adrc.errors import InputError
from biped_adrc.files import write_bytes, write_text
from biped_adrc.paper.pair import CONTROLLERS
from biped_adrc.paper.push_map import WORDS, Fate, PushCell, apart, certain, counts, settings_of
from biped_adrc.viz.figure_numbers import as_text, numbers_of
from biped_adrc.viz.plots.push_map import push_map_figure
from biped_adrc.viz.style import render

PAGE = Path(__file__).resolve().parent / "critical_phase.md"
FOLDER = PAGE.parent / "critical_phase"


NEEDS = ["preset", "outcome", "mean friction", "mean F_N [N]", "peak torque [N m]", "impulse ratio"]
"""Columns of the table of runs that say what a walk needs."""


class Study(NamedTuple):
    """What the page is written from."""

    cells: list[PushCell]
    undisturbed: list[list[Any]]


def presets_of(cells: Sequence[PushCell]) -> list[str]:
    """In their order."""
    return list(dict.fromkeys(cell.preset for cell in cells))


def read(path: Path) -> Study:
    """The cells and the undisturbed walks in a summary. Raises InputError where it has no cells."""
    summary = json.loads(path.read_text(encoding="utf-8"))
    rows = summary["push_map"]
    if not rows:
        raise InputError(f"'{path}' has no map of pushes; run 'biped-adrc reproduce --full' first")
    names = ("preset", "onset", "amplitude", "pattern", "torque_limit")
    cells = [
        PushCell(*(row[n] for n in names), fate(row["npd"]), fate(row["adrc"])) for row in rows
    ]
    return Study(cells, summary.get("undisturbed") or undisturbed(summary))


def fate(row: dict[str, Any]) -> Fate:
    """One walk of a cell."""
    return Fate(**{**row, "reasons": tuple(row["reasons"])})


def undisturbed(summary: dict[str, Any]) -> list[list[Any]]:
    """What the walk without a push needs, a row of `NEEDS` for each preset."""
    runs = summary["tables"]["Runs"]
    at = [runs["columns"].index(name) for name in NEEDS]
    named = (row for row in runs["rows"] if row[0].startswith("nominal") and row[1] == "NPD")
    return [[row[k] for k in at] for row in named]


def onsets(cells: Sequence[PushCell]) -> list[float]:
    """[s], in their order."""
    return sorted({cell.onset for cell in cells})


def by_onset(cells: Sequence[PushCell]) -> list[list[Any]]:
    """Share of walks that go on legally, by onset: a row per setting and controller."""
    rows = []
    for name, here in settings_of(cells):
        for c in CONTROLLERS:
            shares = []
            for onset in onsets(cells):
                words = [getattr(x, c.lower()).word for x in certain(here) if x.onset == onset]
                shares.append(
                    f"{100.0 * words.count('legal') / len(words):.0f} %" if words else "–"
                )
            rows.append([name, c, *shares])
    return rows


def tally(cells: Sequence[PushCell], word: str) -> dict[str, int]:
    """How many walks of each controller are that."""
    return {c: sum(getattr(x, c.lower()).word == word for x in cells) for c in CONTROLLERS}


def sentences(cells: Sequence[PushCell]) -> list[str]:
    """What the cells say of the claim; of those that are not marginal."""
    sure = certain(cells)
    falls, ends, legal, pulled = (tally(sure, w) for w in ("fell", "ended", "legal", "pulled"))
    adrc, npd = (sum(pair[i] for pair in apart(cells).values()) for i in (0, 1))
    return [
        f"**Of {len(sure)} pushes NPD falls in {falls['NPD']} and ADRC in {falls['ADRC']}; {ends['NPD']} "
        f"and {ends['ADRC']} walks end otherwise (singular, diverged, stalled).**",
        f"NPD walks on legally in {legal['NPD']}, ADRC in {legal['ADRC']}: in {adrc} pushes ADRC alone does, "
        f"in {npd} NPD alone. In {pulled['NPD']} walks under NPD and {pulled['ADRC']} under ADRC the ground "
        "would have had to pull: neither controller asks whether it can.",
        f"{len(cells) - len(sure)} of {len(cells)} cells are marginal: at half the step of the method a walk "
        "ends in another way. They carry no claim.",
    ]


INTRODUCTION = """Written by `python docs/write_critical_phase.py OUT`. Section VI of the paper says that a push
in a critical phase of the step makes NPD lose stability, and that ADRC is not at risk. Here
both are pushed for 0.2 s in single support 19, {count} times: {presets} presets, onsets from
{first:g} to {last:g} s, {least:g} to {most:g} N m on {patterns} patterns of joints, with motors
of 150 N m and without a limit. A walk goes on *legally* when it makes its next three steps, and
in every step the ground force averaged over 5 ms stays inside the friction cone, the torque
within 150 N m, and the swing foot off the ground. The constraint is continued smoothly past the
phase range of the gait."""


def page(study: Study) -> str:
    """The text."""
    cells = study.cells
    found = counts(cells)
    rows = [
        [name, c, *(found[name][c][word] for word in WORDS)] for name in found for c in CONTROLLERS
    ]
    headings = ["preset, torque limit", "controller"]
    parts = [
        "# A critical phase?",
        INTRODUCTION.format(
            count=len(cells),
            presets=len(presets_of(cells)),
            first=onsets(cells)[0],
            last=onsets(cells)[-1],
            least=min(cell.amplitude for cell in cells),
            most=max(cell.amplitude for cell in cells),
            patterns=len({cell.pattern for cell in cells}),
        ),
        *sentences(cells),
        "## What the walk needs without a push",
        "The impulse at impact is judged apart: where its ratio is above the ground's friction of 0.6 the gait "
        "itself asks for more than dry ground gives.",
        table(NEEDS, study.undisturbed),
        "## How the walks go on",
        table([*headings, *WORDS], rows),
        "made: all steps, beyond friction, torque or scuffing. pulled: all steps, but the ground would have "
        "had to pull.",
        "## Is there a critical phase?",
        "Share of the pushes that are walked through legally, by their onset in the step:",
        table([*headings, *(f"{o:g} s" for o in onsets(cells))], by_onset(cells)),
        *(picture(preset) for preset in presets_of(cells)),
    ]
    return "\n\n".join(parts) + "\n"


def picture(preset: str) -> str:
    """The map of a preset."""
    name = f"Map of pushes, {preset}"
    return f"## {name}\n\n![{name}](critical_phase/{preset}.svg)\n\nUpper left of a cell NPD, lower right ADRC."


def compact(study: Study) -> str:
    """The study as `read` reads it, a line for each cell."""
    rows = (json.dumps(asdict(cell), separators=(",", ":")) for cell in study.cells)
    head = json.dumps(study.undisturbed)
    return f'{{"undisturbed": {head},\n"push_map": [\n' + ",\n".join(rows) + "\n]}\n"


def main() -> None:
    """Read, write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    study = read(parser.parse_args().out / "summary.json")
    cells = study.cells
    for preset in presets_of(cells):
        figure = push_map_figure([cell.row() for cell in cells if cell.preset == preset])
        write_bytes(FOLDER / f"{preset}.svg", render(figure, "svg"))
        write_text(FOLDER / f"{preset}.json", as_text(numbers_of(figure)))
    write_text(FOLDER / "summary.json", compact(study))
    write_text(PAGE, page(study))


if __name__ == "__main__":
    main()
