"""A live walk on a page that needs no server: `ba.write_play`, `biped-adrc play --page walk.html`.

    ba.write_play("walk.html", ba.Scenario("ADRC", hardware="ideal"))

The page has laws and loops as WebAssembly (`engine.web_walker`), and a script (viz/play/offline.js) does what
`session` and `driver` do: samples, pushes and springs, steps back, a ghost. It walks what it was made with, on
the rigid plant: the scenario, OTHERS, and the stations of the tour. Sliders, saving and MuJoCo need `ba.play`.

A walk that is chosen begins anew from the start.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from biped_adrc.errors import InputError
from biped_adrc.files import output_path, write_text
from biped_adrc.live.controls import tour
from biped_adrc.live.live_walk import LiveWalk, revised
from biped_adrc.live.offline_numbers import numbers
from biped_adrc.live.page import laid_out, settings
from biped_adrc.parts import check_part
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.viz.meshcat.view import captions
from biped_adrc.viz.pages import with_viewer

FIRST = Scenario("ADRC", hardware="ideal", torque_limit=150.0)
"""What walks on a page that was given nothing: as in the tour."""
OTHERS: Mapping[str, Mapping[str, object]] = {
    "NPD": {"controller": "NPD"},
    "NPID": {"controller": "NPID"},
    "ADRC": {"controller": "ADRC"},
    **{
        f"ADRC, m = {m}, 300 rad/s": {"controller": "ADRC", "order": m, "bandwidth": 300.0}
        for m in (1, 2, 3, 7)
    },
}
"""Walks to choose from on a page: values by which they differ from its scenario, by name."""


def write_play(
    path: Path | str,
    scenario: Scenario | None = None,
    others: Mapping[str, Mapping[str, object]] | None = None,
) -> Path:
    """Write the page of a live walk, one file that needs neither server nor network; returns its path.

    scenario: in sampled time on the rigid plant; FIRST if None. others: the walks to choose from, values of a
    scenario by a name for each; OTHERS if None. The first of them is the ghost.
    Raises InputError for what an offline page cannot walk, and OutputError.
    """
    scenario = FIRST if scenario is None else scenario
    check_part(scenario, "what is to walk on a page", Scenario)
    check_part(others, "the walks to choose from", Mapping, type(None))
    path, others = output_path(Path(path), (".html",)), OTHERS if others is None else others
    for name, values in others.items():
        if not isinstance(values, Mapping):
            raise InputError(
                f"the walk '{name}' is {values!r:.60}, expected values of a scenario by name"
            )
    write_text(path, page(scenario, others))
    return path


def page(scenario: Scenario, others: Mapping[str, Mapping[str, object]]) -> str:
    """The text of the page. Raises InputError."""
    live = LiveWalk.begun(scenario)
    scenarios = {name: revised(scenario, x) for name, x in others.items()}
    own = (name for name, x in scenarios.items() if x == scenario)
    first = next(own, f"{scenario.controller}, as given")
    scenarios[first] = scenario
    stations = guided(scenario, scenarios)
    options = [{"text": name, "values": {"walk": name}} for name in scenarios]
    choice = {"name": "walk", "text": "What walks; another one begins anew.", "options": options}
    scenes = {"walk": laid_out(live), "ghost": laid_out(live)}
    told = settings(scenario, scenes) | {
        "live": False,
        "controls": {"sliders": [], "choices": [choice]},
        "ghosts": [*scenarios],
        "tour": stations,
        "offline": numbers({name: LiveWalk.begun(s) for name, s in scenarios.items()})
        | {"first": first, "ghost": next(iter(others), None)},
    }
    legend = captions({"walk": scenes["walk"]})[1:]
    title = f"{scenario.robot}, live"
    return with_viewer("play", told, title=title, captions=legend, style="play/play.css")


def guided(scenario: Scenario, scenarios: dict[str, Scenario]) -> list[dict[str, Any]]:
    """The stations of the tour on the rigid plant, each with the name of its walk, which joins the scenarios.

    One that the scenario cannot be given is left out.
    """
    stations = []
    for station in tour():
        try:
            s = revised(scenario, station["values"])
        except InputError:
            continue
        if s.plant == "rigid":
            name = next((name for name, x in scenarios.items() if x == s), station["title"])
            scenarios[name] = s
            stations.append(station | {"values": {"walk": name}})
    return stations
