"""Maps of a sweep, drawn from its results."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from matplotlib.figure import Figure

from biped_adrc.files import write_bytes
from biped_adrc.studies.bench.sweep import PARAMETER, Sweep
from biped_adrc.viz.style import render
from biped_adrc.viz.sweep_maps import Maps, sweep_map_figure


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
