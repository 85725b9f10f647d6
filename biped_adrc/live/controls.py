"""What a page changes while it walks: sliders and choices of controls.toml, and the stations of the tour.

In controls.toml and tour.toml the text "none" stands for no value, as in a scenario file.
"""

from __future__ import annotations

from functools import cache
from typing import Any

from biped_adrc.bench.parameters import NONE
from biped_adrc.resources import packaged
from biped_adrc.scenario.scenario import DEFAULTS, FIELDS, UNITS, Scenario


@cache
def controls() -> dict[str, Any]:
    """As play.js takes them: sliders and choices, each with name, text and unit."""
    told = plain(packaged("biped_adrc.live", "controls.toml"))
    sliders = [_named(name, x) | {"given": DEFAULTS[name]} for name, x in told["slider"].items()]
    return {"sliders": sliders, "choices": [_named(name, x) for name, x in told["choice"].items()]}


def _named(name: str, x: dict[str, Any]) -> dict[str, Any]:
    """A control with the name, text and unit of its field."""
    unit = "" if UNITS[name] == "1" else UNITS[name]
    return {"name": name, "text": FIELDS[name].description, "unit": unit, **x}


@cache
def tour() -> list[dict[str, Any]]:
    """The stations of tour.toml, each with all values that it sets."""
    told = plain(packaged("biped_adrc.live", "tour.toml"))
    return [x | {"values": told["base"] | x["values"]} for x in told["station"]]


def plain(x: Any) -> Any:
    """A table of TOML as JSON has it, with null where it says "none"."""
    if isinstance(x, dict):
        return {name: plain(inner) for name, inner in x.items()}
    if isinstance(x, list):
        return [plain(inner) for inner in x]
    return None if x == NONE else x


def values(s: Scenario) -> dict[str, object]:
    """What a scenario has of the fields that the page shows, or that the tour changes, by name."""
    told = controls()
    names = {x["name"] for x in told["sliders"]}
    for choice in told["choices"]:
        names |= {name for option in choice["options"] for name in option["values"]}
    names |= {name for station in tour() for name in station["values"]}
    return {name: getattr(s, name) for name in sorted(names)}
