"""Freeze the comparison as a benchmark, biped_adrc/bench/NAME.json, with all walks of its reference.

    python benchmarks/walkbench.py walkbench-1 out/walkbench

Conditions, base values and tuned settings are those of `compare` at this moment. The seeds are none that the
comparison or a search has walked, so that nothing was chosen on them. A file that is there is never written
over: what is published stays. The hash of the file is put into the guide, docs/guide/walkbench.md.
"""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Mapping
from contextlib import closing
from pathlib import Path
from typing import Any

from biped_adrc.bench.benchmark import METRICS, Benchmark, benchmark_of
from biped_adrc.bench.benchmark_run import walked
from biped_adrc.bench.compare_study import Stored
from biped_adrc.bench.conditions import BASE, CONDITIONS, conditions_on
from biped_adrc.bench.settings import TUNED
from biped_adrc.campaign.chunk import key_of, text_of
from biped_adrc.campaign.store import About
from biped_adrc.campaign.store_open import open_store
from biped_adrc.campaign.workers import Kept, Processes
from biped_adrc.errors import InputError
from biped_adrc.files import write_text
from biped_adrc.scenario.build import RIGID
from biped_adrc.versions import numerical_versions

ROOT = Path(__file__).resolve().parents[1]
BENCH, GUIDE = ROOT / "biped_adrc" / "bench", ROOT / "docs" / "guide" / "walkbench.md"
SEEDS = tuple(range(9000, 9020))
FREE = (
    *("K_p", "K_d", "observer", "poles", "bandwidth", "order", "reset", "solve_theta"),
    *("contact", "contact_window", "filter_time", "prediction", "feedforward"),
)
"""Values of a scenario that a controller may choose, besides those that the tuned settings have."""


def definition() -> dict[str, Any]:
    """The comparison as it is now, without walks."""
    chosen = {k for of in TUNED.places.values() for x in of.values() for k in x if "." not in k}
    names = conditions_on(RIGID, alike=True)
    asked = {CONDITIONS[name].place for name in names}
    return {
        "base": {**BASE, **TUNED.values},
        "conditions": {name: CONDITIONS[name]._asdict() for name in names},
        "seeds": list(SEEDS),
        "metrics": list(METRICS),
        "free": [*FREE, *sorted(chosen - set(FREE))],
        "contestants": dict(TUNED.contestants),
        "places": {place: dict(of) for place, of in TUNED.places.items() if place in asked},
        "versions": dict(numerical_versions()),
    }


def text(told: Mapping[str, Any]) -> str:
    """The text of the file: a line for each part, and for each condition of the walks."""
    parts = [f"{json.dumps(k)}: {json.dumps(x)}" for k, x in told.items() if k != "walks"]
    walks = (
        f"{json.dumps(name)}: {{\n"
        + ",\n".join(
            f"{json.dumps(c)}: {json.dumps(rows, separators=(',', ':'))}" for c, rows in of.items()
        )
        + "\n}"
        for name, of in told["walks"].items()
    )
    return "{\n" + ",\n".join([*parts, '"walks": {\n' + ",\n".join(walks) + "\n}"]) + "\n}\n"


def walks_of(bench: Benchmark, out: Path) -> dict[str, Any]:
    """All walks of the reference controllers, from the store in `out` where they are there."""
    asked = {"definition": key_of(text_of(definition()))}
    about = About(bench.name, key_of(text_of(asked)), asked, dict(numerical_versions()))
    crew = Processes(None)
    crew.prepare()
    out.mkdir(parents=True, exist_ok=True)
    with (
        open_store(out / f"{bench.name}.sqlite", about, False) as store,
        closing(Kept(crew)) as kept,
    ):
        carry = Stored(store, kept, None)
        return {
            name: walked(
                bench, carry, {p: bench.reference(name, p) for p in bench.places}, len(bench.seeds)
            )
            for name in bench.contestants
        }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("name")
    parser.add_argument("out", type=Path)
    given = parser.parse_args()
    path = BENCH / f"{given.name}.json"
    if path.exists():
        raise InputError(
            f"'{path.name}' is there, and what is published stays; choose another name"
        )
    told = definition()
    bare = benchmark_of(given.name, json.dumps(told | {"walks": {}}).encode())
    data = text(told | {"walks": walks_of(bare, given.out)})
    write_text(path, data)
    found = benchmark_of(given.name, data.encode()).hash
    page = GUIDE.read_text(encoding="utf-8")
    write_text(GUIDE, re.sub(r"[0-9a-f]{64}", found, page))
    print(f"{path.name}: {found}")


if __name__ == "__main__":
    main()
