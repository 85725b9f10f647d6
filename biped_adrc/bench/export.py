"""Results of a sweep written for other programs: CSV, Parquet, and maps as PNG.

Rows are read from the results file and written one block at a time, so that a study larger than memory can be
exported. A row has what is varied, then the results (`Sweep.names`). Called by the command `sweep`
(--export, --plot); what a map shows is decided by `viz.plots.sweep_maps`.
"""

from __future__ import annotations

import csv
import itertools
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from biped_adrc.bench.sweep import PARAMETER, Sweep
from biped_adrc.errors import InputError
from biped_adrc.files import replacing, write_bytes

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from biped_adrc.viz.plots.sweep_maps import Maps

KINDS = ("csv", "parquet")
"""Suffixes of the files that can be written."""
BLOCK = 10_000
"""Rows of one row group of Parquet, which are in memory at once."""


def export(results: Sweep, path: Path) -> None:
    """Write the results to a file of the kind that its suffix names. Raises InputError and OutputError."""
    kind = path.suffix.lower().lstrip(".")
    if kind not in KINDS:
        raise InputError(
            f"cannot export results to '{path}': the name ends in '{path.suffix}', expected .csv or .parquet"
        )
    if kind == "csv":
        export_csv(results, path)
    else:
        export_parquet(results, path)


def export_csv(results: Sweep, path: Path) -> None:
    """Write CSV: floats in the shortest form that reads back to the same bits; an empty field is no value.

    The file appears only when it is complete. Raises OutputError.
    """
    names = results.names()
    with replacing(path) as temporary, open(temporary, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(names)
        for row in results.rows():
            found = map(row.get, names)
            writer.writerow([repr(float(x)) if isinstance(x, float) else x for x in found])


def check_kind(kind: str) -> None:
    """Raises InputError for a kind of file that cannot be written, or Parquet without pyarrow installed."""
    if kind not in KINDS:
        raise InputError(f"--export is '{kind}', expected one of {list(KINDS)}")
    if kind == "parquet" and find_spec("pyarrow") is None:
        raise InputError(
            "an export to Parquet needs pyarrow, which is not installed; pip install 'biped-adrc[tables]'"
        )


def export_parquet(results: Sweep, path: Path) -> None:
    """Write Parquet with one type per column: whole numbers, floats, booleans or text.

    The rows are read twice, first for the types. Raises InputError and OutputError.
    """
    check_kind("parquet")
    import pyarrow as pa
    from pyarrow import parquet

    kinds = _kinds(results)
    made = {bool: pa.bool_(), int: pa.int64(), float: pa.float64(), str: pa.string()}
    schema = pa.schema([(name, made[kind]) for name, kind in kinds.items()])
    rows = results.rows()
    with replacing(path) as temporary, parquet.ParquetWriter(temporary, schema) as writer:
        while block := list(itertools.islice(rows, BLOCK)):
            found = {name: [row.get(name) for row in block] for name in kinds}
            columns = [[x if x is None else kinds[n](x) for x in xs] for n, xs in found.items()]
            writer.write_table(pa.table(columns, schema=schema))


def _kinds(results: Sweep) -> dict[str, type]:
    """For each column the type that holds all its values."""
    seen: dict[str, set[type]] = {name: set() for name in results.names()}
    for row in results.rows():
        for name, x in row.items():
            if x is not None:
                seen[name].add(type(x))
    return {name: _kind(types) for name, types in seen.items()}


def _kind(types: set[type]) -> type:
    """The type for these types: the only one, float for ints and floats, otherwise text."""
    if len(types) == 1:
        return next(iter(types))
    return float if types and types <= {int, float} else str


def sweep_map(results: Sweep, maps: Maps) -> Figure:
    """A figure of the finished points over one or two axes. Raises InputError for a column that
    there is not.
    """
    from biped_adrc.viz.plots.sweep_maps import sweep_map_figure

    known = results.names()
    renamed = {n: f"{PARAMETER}{n}" for n in results.study.varied if f"{PARAMETER}{n}" in known}
    shown = {name: x for name in ("x", "y", "panel") if (x := getattr(maps, name)) is not None}
    axes: dict[str, str] = {name: renamed.get(x, x) for name, x in shown.items()}
    names = dict.fromkeys((*axes.values(), maps.value))
    return sweep_map_figure(results.table(*names).columns, replace(maps, **axes))  # type: ignore[arg-type]


def write_map(results: Sweep, maps: Maps, folder: Path) -> Path:
    """The figure as a PNG in `folder`, with the names of axes and value in its name. Raises InputError,
    OutputError.
    """
    from biped_adrc.viz.style import render

    shown = filter(None, (maps.x, maps.y, maps.panel, maps.value))
    path = folder / f"map-{'-'.join(shown)}.png"
    write_bytes(path, render(sweep_map(results, maps), "png"))
    return path
