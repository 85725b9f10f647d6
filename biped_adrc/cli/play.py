"""`biped-adrc play`: a walk live in the browser, to be pushed and changed by hand (`live.page`)."""

from __future__ import annotations

from pathlib import Path

from biped_adrc.cli.app import app, console, say_written
from biped_adrc.cli.options import of_scenario, texts, values_of
from biped_adrc.cli.walk import GROUND, LAW, usual
from biped_adrc.types import PlainRecord

WHO = ("controller", "gait", "robot", "preset", "seed", "hardware", "period")
"""Fields of a scenario that are options: what walks."""


@app.command("play")
@of_scenario(*WHO, *LAW, *GROUND)
@texts("play")
def play_command(
    given: PlainRecord,
    scenario: Path | None = None,
    push: list[str] | None = None,
    sets: list[str] | None = None,
    ghost: str | None = None,
    out: Path = Path(),
    port: int = 0,
    browser: bool = True,
    wait: float = 120.0,
    page: Path | None = None,
) -> None:
    """Push a walk yourself: live in the browser, with a guided tour; 'hardware' is ideal if not given."""
    from biped_adrc.live.page import play
    from biped_adrc.scenario.scenario import Scenario

    values = {"controller": usual(given), **values_of(given, push, sets, scenario)}
    if not {"hardware", "period"} & set(values):
        values["hardware"] = "ideal"
    other = None if ghost is None else {"controller": ghost}
    if page is not None:
        from biped_adrc.live.offline import OTHERS, write_play

        write_play(page, Scenario(**values), {**({f"{ghost}": other} if other else {}), **OTHERS})
        say_written(page)
        return
    said = play(
        Scenario(**values),
        ghost=other,
        out=out,
        port=port,
        open_browser=browser,
        wait=wait,
        say=console.print,
    )
    console.print(said)
