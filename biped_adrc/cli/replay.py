"""`biped-adrc replay`: a robot's log through any controller and observer of the package.

The scenario says which (`extras.logs.replay`). Its table is printed; signals, table and figure go to a folder.
"""

from __future__ import annotations

from pathlib import Path

from biped_adrc.cli.app import app, inputs, say, say_table, say_written, target
from biped_adrc.cli.options import WALKS, options, scenario_from
from biped_adrc.core.files import check_folder, write_text
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

    s, paths = scenario_from(values, sets, scenario), list[Path]()
    if out is not None:
        check_folder(out)
        read = (log, *inputs(s.robot.name, s.gait.name))
        names = ("replay.csv", "steps.txt", "replay.svg")
        paths = [target(out / name, (Path(name).suffix,), read) for name in names]
    result = replay(log, s, window)
    if paths:
        result.to_csv(paths[0])
        write_text(paths[1], f"{result.text()}\n")
        write_figure(paths[2], result.plot())
    say_table(HEADER, map(cells, result.rows))
    for remark in result.remarks:
        say(f"note: {remark}")
    say_written(*paths)
