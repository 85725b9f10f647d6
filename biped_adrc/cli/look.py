"""`biped-adrc animate` and `plot`: pictures of runs that were stored by `simulate` or `reproduce`.

`animate` draws the robot (`viz.export`), `plot` its signals (`paper.figures`). Runs are read as they
are, without walking again, also runs of a user's own controller that is not at hand.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from biped_adrc.cli.app import FIGURES, app, say_written
from biped_adrc.cli.options import texts, with_sets
from biped_adrc.files import keep_inputs, output_path

if TYPE_CHECKING:
    from biped_adrc.scenario.recording import Walk


@app.command()
@texts("animate")
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
    from biped_adrc.viz.export import SUFFIXES, Clip, check_suffix, export

    runs, clip = [run, *(ghost or [])], with_sets(Clip, sets, start=start, stop=stop)
    check_suffix(out)
    keep_inputs((output_path(out, SUFFIXES),), runs)
    export(out, _solid_last(load_walks(runs)), clip)
    say_written(out)


def _solid_last(walks: dict[str, Walk]) -> dict[str, Walk]:
    """The first of the walks behind the others: the last one is drawn solid."""
    first, *others = walks
    return {name: walks[name] for name in (*others, first)}


@app.command()
@texts("plot")
def plot(
    run: Path,
    beside: list[Path] | None = None,
    figure: str = "tracking",
    out: Path = Path("figure.png"),
) -> None:
    """Draw the signals of a run."""
    from biped_adrc.paper.figures import draw
    from biped_adrc.scenario.stored import load_walks
    from biped_adrc.viz.style import write_figure

    runs = [run, *(beside or [])]
    keep_inputs((output_path(out, FIGURES),), runs)
    walks = load_walks(runs)
    write_figure(out, draw(figure, walks))
    say_written(out)
