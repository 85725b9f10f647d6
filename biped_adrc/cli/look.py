"""`biped-adrc animate` and `plot`: pictures of stored runs; `play`: a page on which a walk is pushed by hand.

`animate` draws the robot (`view.export`), `plot` its signals (`paper.figures`). Runs are read as they
are, without walking again, also runs of a user's own controller that is not at hand. The page of
`play` is that of `extras.play.page`.
"""

from __future__ import annotations

import tempfile
import webbrowser
from pathlib import Path

from biped_adrc.cli.app import FIGURES, app, say, say_written, target
from biped_adrc.cli.options import WALKS, options, scenario_from, with_sets
from biped_adrc.core.types import PlainRecord


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
    out = target(out, SUFFIXES, runs)
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
    out = target(out, FIGURES, runs)
    write_figure(out, draw(figure, load_walks(runs)))
    say_written(out)


@app.command("play")
@options("play", *WALKS)
def play_command(
    values: PlainRecord,
    scenario: Path | None = None,
    sets: list[str] | None = None,
    ghost: str | None = None,
    out: Path | None = None,
) -> None:
    """Push a walk yourself, on a page with a guided tour; sampled at 1 kHz if not said otherwise."""
    from biped_adrc.extras.play.page import OTHERS, play

    out = target(out, (".html",), () if scenario is None else (scenario,))
    s = scenario_from(values, sets, scenario)
    if s.hardware.period is None:
        s = s.replace({"hardware.period": 1e-3})
    ghost = ghost or ("ADRC" if s.controller.name == "NPD" else "NPD")
    others = {ghost: {"controller.name": ghost}, **OTHERS}
    path = Path(tempfile.mkdtemp(prefix="biped-adrc-")) / "walk.html" if out is None else out
    play(path, s, others)
    say_written(path)
    if out is None and not webbrowser.open(path.as_uri()):
        say("no browser could be opened here: open the page in one")
