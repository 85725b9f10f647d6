"""`biped-adrc animate` and `plot`: pictures of runs that were stored by `simulate` or `reproduce`.

`animate` draws the robot (`view.export`), `plot` its signals (`paper.figures`). Runs are read as they
are, without walking again, also runs of a user's own controller that is not at hand.
"""

from __future__ import annotations

from pathlib import Path

from biped_adrc.cli.app import FIGURES, app, say_written
from biped_adrc.cli.options import options, with_sets
from biped_adrc.core.files import keep_inputs, output_path


@app.command()
@options("animate")
def animate(
    run: Path,
    ghost: list[Path] | None = None,
    out: Path = Path("walk.html"),
    start: float | None = None,
    stop: float | None = None,
    sets: list[str] | None = None,
) -> None:
    """Write the walk as a page, a picture or a strip."""
    from biped_adrc.scenario.stored import load_walks
    from biped_adrc.view.export import SUFFIXES, export
    from biped_adrc.view.placement import Clip

    runs, clip = [run, *(ghost or [])], with_sets(Clip, sets, start=start, stop=stop)
    keep_inputs((output_path(out, SUFFIXES),), runs)
    walks = load_walks(runs)
    first, *others = walks
    export(out, {name: walks[name] for name in (*others, first)}, clip)  # the last is drawn solid
    say_written(out)


@app.command()
@options("plot")
def plot(
    run: Path,
    beside: list[Path] | None = None,
    figure: str = "tracking",
    out: Path = Path("figure.png"),
) -> None:
    """Draw the signals of a run."""
    from biped_adrc.paper.figures import draw
    from biped_adrc.scenario.stored import load_walks
    from biped_adrc.view.style import write_figure

    runs = [run, *(beside or [])]
    keep_inputs((output_path(out, FIGURES),), runs)
    walks = load_walks(runs)
    write_figure(out, draw(figure, walks))
    say_written(out)
