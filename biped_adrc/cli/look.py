"""`biped-adrc animate` and `plot`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from biped_adrc.cli.app import app, console
from biped_adrc.cli.output import FIGURES, say_written
from biped_adrc.files import keep_inputs, output_path

if TYPE_CHECKING:
    from biped_adrc.scenario.recording import Walk
    from biped_adrc.viz.export import Clip


RunFile = Annotated[Path, typer.Argument(help="A run written by 'simulate' or 'reproduce' (.npz).")]
Ghost = Annotated[
    list[Path] | None,
    typer.Option(help="Another run, drawn translucent beside the first. May be repeated."),
]
Page = Annotated[
    Path,
    typer.Option(
        "--out", "-o", help="What to write: .html (offline page), .gif, or .png or .svg (strip)."
    ),
]
View = Annotated[str, typer.Option(help="side (orthographic) or perspective; of the page.")]
Start = Annotated[float | None, typer.Option("--from", help="Start of a .gif or strip [s].")]
Stop = Annotated[float | None, typer.Option("--to", help="End of a .gif or strip [s].")]
Fps = Annotated[float | None, typer.Option(help="Frames per second; 60, or 25 for a .gif.")]
Apart = Annotated[
    bool, typer.Option("--apart", help="The walks of a .gif side by side, their errors below.")
]
Magnify = Annotated[
    float | None,
    typer.Option(help="With --apart: draw deviations from the reference so many times."),
]
Slower = Annotated[float, typer.Option(help="How many times slower than the walk a .gif plays.")]
Live = Annotated[
    bool,
    typer.Option("--live", help="Show it in the browser from a server on 127.0.0.1 instead."),
]
Port = Annotated[int, typer.Option(help="Port of --live; 0 takes a free one.")]
Browser = Annotated[
    bool, typer.Option(help="Open the browser with --live, or only print the address.")
]
Wait = Annotated[float, typer.Option(help="How long --live waits for the first page [s].")]


@app.command()
def animate(
    run: RunFile,
    ghost: Ghost = None,
    out: Page = Path("walk.html"),
    view: View = "side",
    start: Start = None,
    stop: Stop = None,
    fps: Fps = None,
    apart: Apart = False,
    magnify: Magnify = None,
    slower: Slower = 1.0,
    live: Live = False,
    port: Port = 0,
    browser: Browser = True,
    wait: Wait = 120.0,
) -> None:
    """Write the walk as a page, a picture or a strip; or show it live."""
    from biped_adrc.errors import InputError
    from biped_adrc.scenario.stored import load_walks
    from biped_adrc.viz.export import SUFFIXES, Clip, check_suffix, export

    runs, clip = [*(ghost or []), run], Clip(start, stop, fps, view, apart, magnify, slower)
    if not live:
        check_suffix(out)
        keep_inputs((output_path(out, SUFFIXES),), runs)
        export(out, load_walks(runs), clip)
        say_written(out)
    elif clip.moving:
        raise InputError(
            "--apart, --magnify and --slower are of a .gif; leave them out with --live"
        )
    else:
        _show(load_walks(runs), clip, port, browser, wait)


def _show(walks: dict[str, Walk], clip: Clip, port: int, browser: bool, wait: float) -> None:
    """In a browser, until it is closed."""
    from biped_adrc.viz.live import play
    from biped_adrc.viz.meshcat import Look

    look = Look(fps=60.0 if clip.fps is None else clip.fps, view=clip.view)
    console.print(play(walks, look, port=port, open_browser=browser, wait=wait, say=console.print))


@app.command()
def plot(
    run: RunFile,
    beside: Annotated[
        list[Path] | None, typer.Option("--with", help="Another run to compare. May be repeated.")
    ] = None,
    figure: Annotated[
        str,
        typer.Option(
            help="tracking, disturbance, ground, energy; phase or comparison of all runs."
        ),
    ] = "tracking",
    out: Annotated[Path, typer.Option("--out", "-o", help="What to write: .png or .svg.")] = Path(
        "figure.png"
    ),
) -> None:
    """Draw the signals of a run."""
    from biped_adrc.files import write_bytes
    from biped_adrc.scenario.stored import load_walks
    from biped_adrc.studies.figures import draw
    from biped_adrc.viz.style import render

    runs = [run, *(beside or [])]
    keep_inputs((output_path(out, FIGURES),), runs)
    walks = load_walks(runs)
    write_bytes(out, render(draw(figure, walks), out.suffix.lower().removeprefix(".")))
    say_written(out)
