"""Write docs/critical_phase.md: in which phase of the step a push throws which controller.

Run: python docs/write_critical_phase.py OUT

OUT: folder for critical_phase.json with every cell; a file that is there is used as it is. On two cores the
study takes about five minutes. Pushes of 0.2 s over onset, amplitude up to the motors' limit, joints and
presets, with the motors' limit and without; every walk at two steps.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from write_results import table

from biped_adrc.engine.choice import COMPILED
from biped_adrc.files import write_bytes, write_text
from biped_adrc.studies.bench.statistics import share
from biped_adrc.studies.pool import Task, run_tasks
from biped_adrc.studies.push_map import (
    PATTERNS,
    WORDS,
    Cell,
    Fate,
    apart,
    certain,
    counts,
    push_map,
    pushes,
    settings_of,
)
from biped_adrc.studies.runs import CONTROLLERS, Run, execute
from biped_adrc.viz.figures import push_map_figure
from biped_adrc.viz.style import render

ROOT = Path(__file__).resolve().parents[1]
PRESETS = ("identified", "identified-bare", "tac2003")
ONSETS = tuple(round(0.05 * k, 2) for k in range(8))
"""[s]; a single support takes about 0.4 s."""
AMPLITUDES = (30.0, 60.0, 90.0, 120.0, 150.0)
"""[N m], up to what RABBIT's motors give."""
LIMITS = (None, 150.0)


def study() -> list[Cell]:
    """All cells, a task for every preset, limit and pattern."""
    for c in CONTROLLERS:  # builds the engine once, before the processes
        execute(Run(c, h=1e-3, impacts=1, engine=COMPILED, continued=True))
    tasks = [
        Task(f"{preset}, {limit}, {pattern}", push_map, (Run(preset=preset), tried))
        for preset in PRESETS
        for limit in LIMITS
        for pattern in PATTERNS
        if (tried := pushes(ONSETS, AMPLITUDES, (pattern,), (limit,)))
    ]
    done = run_tasks(tasks, None, lambda k, of, name: print(f"{k} of {of}: {name}", flush=True))
    return [cell for found in done for cell in found.value]


def read(path: Path) -> list[Cell]:
    """The cells of a file."""
    rows = json.loads(path.read_text(encoding="utf-8"))
    names = ("preset", "onset", "amplitude", "pattern", "torque_limit")
    return [Cell(*(row[n] for n in names), Fate(**row["npd"]), Fate(**row["adrc"])) for row in rows]


def by_onset(cells: Sequence[Cell]) -> list[list[Any]]:
    """Share of walks that go on legally, by onset: a row per setting and controller."""
    rows = []
    for name, here in settings_of(cells):
        for c in CONTROLLERS:
            shares = []
            for onset in ONSETS:
                words = [getattr(x, c.lower()).word for x in certain(here) if x.onset == onset]
                shares.append(
                    f"{100.0 * words.count('legal') / len(words):.0f} %" if words else "–"
                )
            rows.append([name, c, *shares])
    return rows


def tally(cells: Sequence[Cell], word: str) -> dict[str, int]:
    """How many walks of each controller are that."""
    return {c: sum(getattr(x, c.lower()).word == word for x in cells) for c in CONTROLLERS}


def sentences(cells: Sequence[Cell]) -> list[str]:
    """What the cells say of the claim."""
    sure = certain(cells)
    falls, ends, legal = (tally(sure, word) for word in ("fell", "ended", "legal"))
    adrc, npd = (sum(pair[i] for pair in apart(cells).values()) for i in (0, 1))
    found = [
        f"Of {len(sure)} pushes in cells that are not marginal NPD falls in {falls['NPD']} and ADRC in "
        f"{falls['ADRC']}; {ends['NPD']} and {ends['ADRC']} walks end otherwise (singular, diverged, "
        "stalled).",
        f"NPD walks on legally in {legal['NPD']}, ADRC in {legal['ADRC']}. In {adrc} pushes ADRC alone "
        f"does, in {npd} NPD alone.",
    ]
    if adrc + npd:
        value, low, high = (100.0 * x for x in share(adrc, adrc + npd))
        found.append(
            "Of the pushes that tell the two apart, ADRC is the one that walks on legally in "
            f"{value:.0f} % ({low:.0f} to {high:.0f} %, Wilson, 95 %)."
        )
    return found


def verdict(cells: Sequence[Cell]) -> str:
    """What section VI's claim is worth here."""
    sure = certain(cells)
    falls, pulled = tally(sure, "fell"), tally(sure, "pulled")
    first = (
        f"**NPD falls in {falls['NPD']} of {len(sure)} pushes, ADRC in {falls['ADRC']}.**"
        if falls["NPD"]
        else "**On this robot there is no phase in which a push up to the motors' limit makes NPD fall.** "
        "What falls in a map without a continued constraint is the polynomial of the gait, outside its "
        "range."
    )
    return (
        f"{first} In {pulled['NPD']} walks under NPD and {pulled['ADRC']} under ADRC the ground would have "
        "had to pull: neither controller asks whether it can."
    )


INTRODUCTION = """Written by `python docs/write_critical_phase.py OUT`. Section VI of the paper says that a push
in a critical phase of the step makes NPD lose stability, and that ADRC is not at risk. Here
both are pushed for 0.2 s in single support 19, {count} times: {presets} presets, onsets from
{first:g} to {last:g} s, {least:g} to {most:g} N m on {patterns} patterns of joints, with motors
of 150 N m and without a limit. A walk goes on *legally* when it makes its next three steps, and
in every step the ground force averaged over 5 ms stays inside the friction cone, the torque
within 150 N m, and the swing foot off the ground. The constraint is continued smoothly past the
phase range of the gait."""


def page(cells: Sequence[Cell]) -> str:
    """The text."""
    marginal, found = len(cells) - len(certain(cells)), counts(cells)
    rows = [
        [name, c, *(found[name][c][word] for word in WORDS)] for name in found for c in CONTROLLERS
    ]
    headings = ["preset, torque limit", "controller"]
    parts = [
        "# A critical phase?",
        INTRODUCTION.format(
            count=len(cells),
            presets=len(PRESETS),
            first=ONSETS[0],
            last=ONSETS[-1],
            least=AMPLITUDES[0],
            most=AMPLITUDES[-1],
            patterns=len(PATTERNS),
        ),
        verdict(cells),
        *sentences(cells),
        f"{marginal} cells are marginal: at half the step of the method a walk ends in another way. They "
        "carry no claim.",
        "## How the walks go on",
        table([*headings, *WORDS], rows),
        "made: all steps, beyond friction or torque. pulled: all steps, but the ground would have had to pull.",
        "## Is there a critical phase?",
        "Share of the pushes that are walked through legally, by their onset in the step:",
        table([*headings, *(f"{o:g} s" for o in ONSETS)], by_onset(cells)),
        *(picture(preset) for preset in PRESETS),
    ]
    return "\n\n".join(parts) + "\n"


def picture(preset: str) -> str:
    """The map of a preset."""
    name = f"Map of pushes, {preset}"
    return f"## {name}\n\n![{name}](critical_phase/{preset}.svg)\n\nUpper left of a cell NPD, lower right ADRC."


def main() -> None:
    """Study, write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    path = parser.parse_args().out / "critical_phase.json"
    if not path.is_file():
        rows = [cell.row() for cell in study()]
        write_text(path, json.dumps(rows) + "\n")
    cells = read(path)
    for preset in PRESETS:
        rows = [cell.row() for cell in cells if cell.preset == preset]
        picture = render(push_map_figure(rows), "svg")
        write_bytes(ROOT / "docs" / "critical_phase" / f"{preset}.svg", picture)
    write_text(ROOT / "docs" / "critical_phase.md", page(cells))


if __name__ == "__main__":
    main()
