"""Results as CSV or Parquet, row by row: what is varied, then the results; and drawn as maps."""

from __future__ import annotations

import csv
import itertools
from dataclasses import replace
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from biped_adrc.errors import InputError
from biped_adrc.files import replacing, write_bytes
from biped_adrc.studies.bench.sweep import PARAMETER, Sweep
from biped_adrc.viz.style import render
from biped_adrc.viz.sweep_maps import Maps, sweep_map_figure

KINDS = ("csv", "parquet")
BLOCK = 10_000
"""Rows of a group of Parquet."""


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
    """Floats come back to the last bit; an empty field is no value. Raises OutputError."""
    names = results.names()
    with replacing(path) as temporary, open(temporary, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(names)
        for row in results.rows():
            writer.writerow([_field(row.get(name)) for name in names])


def _field(x: Any) -> Any:
    return repr(float(x)) if isinstance(x, float) else x


def check_parquet() -> None:
    """Raises InputError where Parquet cannot be written."""
    try:
        import pyarrow  # noqa: F401
    except ImportError as error:
        raise InputError(
            "an export to Parquet needs pyarrow, which is not installed; pip install 'biped-adrc[tables]'"
        ) from error


def export_parquet(results: Sweep, path: Path) -> None:
    """A column has one type: whole numbers, floats, true or false, text. Raises InputError and OutputError."""
    check_parquet()
    import pyarrow as pa
    from pyarrow import parquet

    kinds = _kinds(results)
    made = {bool: pa.bool_(), int: pa.int64(), float: pa.float64(), str: pa.string()}
    schema = pa.schema([(name, made[kind]) for name, kind in kinds.items()])
    rows = results.rows()
    with replacing(path) as temporary, parquet.ParquetWriter(temporary, schema) as writer:
        while block := list(itertools.islice(rows, BLOCK)):
            columns = [[_as(kind, row.get(name)) for row in block] for name, kind in kinds.items()]
            writer.write_table(pa.table(columns, schema=schema))


def _kinds(results: Sweep) -> dict[str, type]:
    """The type of each column that all its values fit in."""
    seen: dict[str, set[type]] = {name: set() for name in results.names()}
    for row in results.rows():
        for name, x in row.items():
            if x is not None:
                seen[name].add(type(x))
    return {name: _kind(types) for name, types in seen.items()}


def _kind(types: set[type]) -> type:
    if len(types) == 1:
        return next(iter(types))
    return float if types and types <= {int, float} else str


def _as(kind: type, x: Any) -> Any:
    return None if x is None else kind(x)


def sweep_map(results: Sweep, maps: Maps) -> Figure:
    """A figure of what is finished. Raises InputError for a column that there is not."""
    known = results.names()
    renamed = {n: f"{PARAMETER}{n}" for n in results.study.varied if f"{PARAMETER}{n}" in known}
    m = replace(
        maps,
        x=renamed.get(maps.x, maps.x),
        y=renamed.get(maps.y, maps.y),
        panel=None if maps.panel is None else renamed.get(maps.panel, maps.panel),
    )
    names = dict.fromkeys((m.x, m.y, m.value, *((m.panel,) if m.panel else ())))
    return sweep_map_figure(results.table(*names).columns, m)


def write_map(results: Sweep, maps: Maps, folder: Path) -> Path:
    """The figure as a PNG in `folder`, named by what it shows. Raises InputError and OutputError."""
    parts = [maps.x, maps.y, *([maps.panel] if maps.panel else []), maps.value]
    path = folder / f"map-{'-'.join(parts)}.png"
    write_bytes(path, render(sweep_map(results, maps), "png"))
    return path
