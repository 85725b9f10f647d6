"""`biped-adrc play`: a page on which a walk is pushed by hand (`extras.play.page`)."""

from __future__ import annotations

import tempfile
import webbrowser
from pathlib import Path

from biped_adrc.cli.app import app, say, say_written
from biped_adrc.cli.options import WALKS, options, scenario_from
from biped_adrc.core.files import keep_inputs, output_path
from biped_adrc.core.types import PlainRecord


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

    if out is not None:
        keep_inputs((output_path(out, (".html",)),), () if scenario is None else (scenario,))
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
