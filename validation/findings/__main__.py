"""All findings again: their walks, their rows, their pictures and the page.

    python -m validation.findings out             walks the stored settings; goes on after a kill
    python -m validation.findings out --search    searches the settings before that

Each finding has a study in examples/studies. Rows are in docs/findings; page.py makes the page of them.
"""

from __future__ import annotations

import argparse
import csv
import math
from collections.abc import Iterable
from itertools import groupby
from pathlib import Path
from typing import Any

import biped_adrc as ba
from biped_adrc.studies.build import scenario_of, scene_of
from biped_adrc.studies.results import Results
from biped_adrc.studies.study import read_study
from validation.findings import comparison, page, searches
from validation.findings.comparison import ROOT

STUDIES = ROOT / "examples" / "studies"
ROWS = ROOT / "docs" / "findings"
COMPARED = {
    comparison.name_of(hardware, tuning): (hardware, tuning)
    for hardware in ("exact", "rabbit")
    for tuning in ("tracking", "ground")
}
SOFT = "comparison_soft"
DIGITS = "last_digits"
DECLARED = ("orders", "held_hip_force", "laws_and_gaits", DIGITS)
"""Studies whose rows are counts of feasible walks and errors."""


def write_rows(path: Path, rows: Iterable[dict[str, Any]]) -> None:
    """Write rows as CSV, with the names of the first row."""
    every = list(rows)
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, every[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(every)


def counts(found: Results) -> Iterable[dict[str, Any]]:
    """A row for each case under each condition and at each level but the seed's: how the walks ended ("1"
    feasible, "i" but for the impulses, "0" not), and rms errors [urad] of those that are feasible.
    """

    def place(x: Any) -> tuple[tuple[str, Any], ...]:
        return tuple((k, v) for k, v in x.at.items() if k != "run.seed")

    for at, some in groupby(found.results(), place):
        rows = [x.row for x in some]
        marks = ("1" if r.get("feasible") else "i" if r.get("but_impact") else "0" for r in rows)
        errors = (f"{1e6 * r['rms_error']:.4g}" if r.get("feasible") else "-" for r in rows)
        short = "" if len(rows) > 60 or len(rows) == 1 else " ".join(errors)
        yield dict(at) | {
            "feasible": sum(r.get("feasible") == 1 for r in rows),
            "walks": len(rows),
            "ends": "".join(marks),
            "errors": short,
        }


def margins(rows: list[dict[str, str]]) -> Iterable[dict[str, Any]]:
    """For each search: delay and disk margin, and the ripple that encoders leave in the torque; for the best of
    each controller at each place H of the ground by `rough_estimate`, too.
    """
    from biped_adrc.analysis.rough_estimate import rough_estimate
    from biped_adrc.scenario.build import build
    from biped_adrc.scenario.cycle import specification_of

    best = comparison.best_of(rows)
    for r in rows:
        if not r["values"]:
            continue
        tables = comparison.tables_of(r["hardware"], r["tuning"], [r])
        # margins and H are those of the nominal robot at the nominal delay
        base = {k: v for k, v in tables["base"].items() if k not in ("errors", "start")}
        (case,) = (x for name, x in tables["cases"].items() if not name.startswith("Table I"))
        values = searches.merge(base, case, {"gait": {"continued": True}})
        s = scenario_of(read_study({"name": "one", "base": values}).base)
        scene = scene_of(s)
        keys = ("hardware", "gait", "tuning", "controller", "search")
        row: dict[str, Any] = {k: r[k] for k in keys}
        spec = specification_of(s, scene)
        for name in ("delay_margin", "disk_margin", "ripple"):
            x = float(getattr(spec, name))
            row[name] = f"{x:.3g}" if math.isfinite(x) else ""
        row["H"] = ""
        if r in best:
            estimate = rough_estimate(build(s, scene), scene.walked, highest=0.05)
            row["H"] = f"{min(estimate.reaches().values()):.3g}"
        yield row


def walk(out: Path, names: Iterable[str], workers: int | None) -> None:
    """Walk the studies of these names, and write their rows."""
    for name in names:
        asked = read_study(STUDIES / f"{name}.toml")
        print(f"{name}: {asked.count} walks", flush=True)
        found = ba.study(asked, out / name, workers)
        if name in COMPARED:
            rows = comparison.rows_of(found, *COMPARED[name])
        elif name == SOFT:
            rows = comparison.rows_of(found, "rabbit", "tracking")
        else:
            rows = iter(counts(found))
        write_rows(ROWS / f"{name}.csv", rows)


def write_studies() -> None:
    """Write the studies of the comparison from the settings."""
    rows = comparison.settings()
    for name, at in COMPARED.items():
        text = comparison.toml(comparison.tables_of(*at, rows), comparison.comment(name))
        (STUDIES / f"{name}.toml").write_text(text)
    for name, tables in ((SOFT, comparison.soft_tables), (DIGITS, comparison.digit_tables)):
        text = comparison.toml(tables(rows), comparison.comment(name))
        (STUDIES / f"{name}.toml").write_text(text)


def main() -> None:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument(
        "--search", action="store_true", help="search the settings before, for hours"
    )
    parser.add_argument("--only", nargs="*", help="studies to walk, in place of all")
    parser.add_argument("--workers", type=int)
    a = parser.parse_args()
    if a.search:
        searches.main(str(a.out / "searches"))
        write_rows(comparison.SETTINGS, searches.every_row(a.out / "searches"))
        write_studies()
    walk(a.out, a.only or (*COMPARED, SOFT, *DECLARED), a.workers)
    if a.only is None:
        write_rows(ROWS / "margins.csv", margins(comparison.settings()))
    page.write()


if __name__ == "__main__":
    main()
