"""`biped-adrc replay`: a robot's log through any controller and observer of the package.

The scenario says which (`extras.logs.replay`). Its table is printed; signals, table and figure go to a folder.
"""

from __future__ import annotations

from pathlib import Path

from rich.table import Table

from biped_adrc.cli.app import app, console, inputs, say, say_written
from biped_adrc.cli.options import WALKS, options, scenario_from
from biped_adrc.core.files import check_folder, keep_inputs, output_path, write_text
from biped_adrc.core.types import PlainRecord


@app.command("replay")
@options("replay", *WALKS)
def replay_command(
    values: PlainRecord,
    log: Path,
    sets: list[str] | None = None,
    scenario: Path | None = None,
    window: float = 0.02,
    out: Path | None = None,
) -> None:
    """Show a robot's log to a controller and its observer, and print what they make of it."""
    from biped_adrc.extras.logs.replay import HEADER, cells, replay
    from biped_adrc.view.style import write_figure

    s = scenario_from(values, sets, scenario)
    paths = _paths(out, (log, *inputs(s.robot.name, s.gait.name)))
    result = replay(log, s, window)
    if paths is not None:
        table, text, figure = paths
        result.to_csv(table)
        write_text(text, f"{result.text()}\n")
        write_figure(figure, result.plot())
    shown = Table(*HEADER)
    for row in result.rows:
        shown.add_row(*cells(row))
    console.print(shown)
    for remark in result.remarks:
        say(f"note: {remark}")
    for path in paths or ():
        say_written(path)


def _paths(out: Path | None, read: tuple[Path, ...]) -> tuple[Path, Path, Path] | None:
    """Where signals, table and figure go, checked before anything is computed; None for nowhere.

    Raises InputError where the log itself is there under one of these names, and OutputError.
    """
    if out is None:
        return None
    check_folder(out)
    names = ("replay.csv", "steps.txt", "replay.svg")
    table, text, figure = (output_path(out / name, (Path(name).suffix,)) for name in names)
    keep_inputs((table, text, figure), read)
    return table, text, figure
