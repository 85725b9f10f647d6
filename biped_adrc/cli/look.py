"""`biped-adrc animate` and `plot`: pictures of runs that were stored by `simulate` or `reproduce`.

`animate` draws the robot (`viz.export` for files, `viz.meshcat.live` with --live), `plot` its
signals (`paper.figures`). Runs are read as they are, without walking again, also runs of a user's
own controller that is not at hand.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from biped_adrc.cli.app import FIGURES, app, console, say_written
from biped_adrc.cli.options import texts
from biped_adrc.files import keep_inputs, output_path

if TYPE_CHECKING:
    from biped_adrc.scenario.recording import Walk
    from biped_adrc.viz.export import Clip


@app.command()
@texts("animate")
def animate(
    run: Path,
    ghost: list[Path] | None = None,
    out: Path | None = None,
    view: str = "side",
    start: float | None = None,
    stop: float | None = None,
    fps: float | None = None,
    apart: bool = False,
    magnify: float | None = None,
    slower: float = 1.0,
    live: bool = False,
    port: int = 0,
    browser: bool = True,
    wait: float = 120.0,
) -> None:
    """Write the walk as a page, a picture or a strip; or show it live."""
    from biped_adrc.errors import InputError
    from biped_adrc.scenario.stored import load_walks
    from biped_adrc.viz.export import SUFFIXES, Clip, check_suffix, export

    runs, clip = [run, *(ghost or [])], Clip(start, stop, fps, view, apart, magnify, slower)
    if not live:
        out = Path("walk.html") if out is None else out
        check_suffix(out)
        keep_inputs((output_path(out, SUFFIXES),), runs)
        export(out, _solid_last(load_walks(runs)), clip)
        say_written(out)
    elif clip.moving or out is not None:
        raise InputError(
            "--out, --apart, --magnify and --slower are of a file; leave them out with --live"
        )
    else:
        _show(_solid_last(load_walks(runs)), clip, port, browser, wait)


def _solid_last(walks: dict[str, Walk]) -> dict[str, Walk]:
    """The first of the walks behind the others: the last one is drawn solid."""
    first, *others = walks
    return {name: walks[name] for name in (*others, first)}


def _show(walks: dict[str, Walk], clip: Clip, port: int, browser: bool, wait: float) -> None:
    """In a browser, until it is closed."""
    from biped_adrc.viz.meshcat.live import play

    said = play(walks, clip.look(), port=port, open_browser=browser, wait=wait, say=console.print)
    console.print(said)


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
