"""`biped-adrc play`: a page on which a walk is pushed by hand (`live.page`)."""

from __future__ import annotations

import tempfile
import webbrowser
from pathlib import Path

from biped_adrc.cli.app import app, say, say_written
from biped_adrc.cli.options import of_scenario, texts, values_of
from biped_adrc.cli.walk import LAW, usual
from biped_adrc.files import keep_inputs, output_path
from biped_adrc.types import PlainRecord

WHO = ("controller", "gait", "robot", "preset", "seed", "hardware", "period")
"""Fields of a scenario that are options: what walks."""
GROUND = ("friction", "slope")
"""Those of joint friction and ground."""


@app.command("play")
@of_scenario(*WHO, *LAW, *GROUND)
@texts("play")
def play_command(
    given: PlainRecord,
    scenario: Path | None = None,
    sets: list[str] | None = None,
    ghost: str | None = None,
    out: Path | None = None,
) -> None:
    """Push a walk yourself, on a page with a guided tour; 'hardware' is ideal if not given."""
    from biped_adrc.live.page import OTHERS, play
    from biped_adrc.scenario.scenario import Scenario

    if out is not None:
        keep_inputs((output_path(out, (".html",)),), () if scenario is None else (scenario,))
    values = {"controller": usual(given), **values_of(given, None, sets, scenario)}
    if not {"hardware", "period"} & set(values):
        values["hardware"] = "ideal"
    ghost = ghost or ("ADRC" if values["controller"] == "NPD" else "NPD")
    others = {ghost: {"controller": ghost}, **OTHERS}
    path = Path(tempfile.mkdtemp(prefix="biped-adrc-")) / "walk.html" if out is None else out
    play(path, Scenario(**values), others)
    say_written(path)
    if out is None and not webbrowser.open(path.as_uri()):
        say("no browser could be opened here: open the page in one")
