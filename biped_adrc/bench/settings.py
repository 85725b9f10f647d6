"""With which settings controllers are compared: named sets, tuned alike or as published.

A set gives each contestant its values of a scenario, by the place for which they were tuned; a condition of
the comparison names the place whose settings it takes. Whatever a search could choose (gains, a bandwidth, a
filter, a policy) is a value by name here, and nothing else is known about it.

    contestant           values                              at "RABBIT, 1 ms" besides
    "m = 1"              controller = "LESO", order = 1      K_p = 6919, bandwidth = 272, ...
    "ADRC, Table I"      controller = "ADRC"                 nothing: it walks as published
    "my_law:Mine"        controller = "my_law:Mine"          nothing, or what a file of one's own says

The tuned sets are in tuned.toml, from the searches whose rows are in docs/findings/tuned.csv. A set of one's
own is a file of the same tables `contestants`, `places` and `words`, on top of the first of them.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from biped_adrc.bench.conditions import BASE, CONDITIONS, SAID
from biped_adrc.bench.parameters import Refused, flat, read
from biped_adrc.campaign.chunk import Record
from biped_adrc.errors import InputError
from biped_adrc.files import reading
from biped_adrc.resources import packaged
from biped_adrc.scenario.registry import is_own, names, words

Places = Mapping[str, Mapping[str, Record]]
"""By place and contestant the values that were chosen there."""


class Settings(NamedTuple):
    """A set of settings; see the module's text."""

    name: str
    """By which it is asked for."""
    words: str
    """Where it is from, for a reader."""
    values: Record
    """Values of all walks, such as the gait for which it was tuned."""
    contestants: Mapping[str, Record]
    """By name the values that a contestant has everywhere, in the order of the tables."""
    places: Places
    """Values on top of these; empty in a set as published."""

    @property
    def alike(self) -> bool:
        """Whether its settings are tuned, so that differences are those of laws."""
        return bool(self.places)

    def of(self, contestant: str, place: str | None) -> Record:
        """All values of a contestant at a place. A name that the set has not is that of a controller."""
        known = self.contestants.get(contestant, {"controller.name": contestant})
        chosen = {} if place is None else self.places.get(place, {}).get(contestant, {})
        return {**self.values, **known, **chosen}

    def controller(self, contestant: str) -> str:
        """The name in the registry, or module:Class, of a contestant's controller."""
        return str(self.of(contestant, None)["controller.name"])

    def as_published(self, contestant: str, place: str | None) -> bool:
        """Whether a contestant of a tuned set is not tuned there; a class of one's own is never told so."""
        tuned = place is not None and contestant in self.places.get(place, {})
        return self.alike and not tuned and not is_own(self.controller(contestant))

    def record(self, condition: str, contestant: str, seed: int) -> dict[str, object]:
        """The values of one trial of the table."""
        given = CONDITIONS[condition]
        return {**BASE, **given.values, **self.of(contestant, given.place), "run.seed": seed}

    def described(self, contestant: str) -> str:
        """A contestant in words: those of its controller, or its controller with the values that it has."""
        if contestant not in self.contestants or contestant in names("controller"):
            return words("controller", self.controller(contestant))
        fixed = (
            f"{k} = {x}" for k, x in self.contestants[contestant].items() if k != "controller.name"
        )
        return ", ".join((self.controller(contestant), *fixed))

    def said(self, contestants: Sequence[str], conditions: Sequence[str]) -> str:
        """What a page says first of its settings."""
        if not self.alike:
            return self.words
        untuned: dict[str, list[str]] = {}
        for name in contestants:
            where = [c for c in conditions if self.as_published(name, CONDITIONS[c].place)]
            if where:
                untuned[name] = where
        listed = (
            name if len(where) == len(conditions) else f"{name} (under {', '.join(where)})"
            for name, where in untuned.items()
        )
        told = "; ".join(listed)
        published = SAID["texts"]["untuned"].format(names=told) if told else ""
        return SAID["texts"]["tuned"].format(
            name=self.name, words=self.words.rstrip("."), published=published
        )


def _values(given: Mapping[str, Any], where: str) -> Record:
    """Values of a scenario as it takes them, flat. Raises InputError, with where they are."""
    found = {}
    for name, x in flat(given).items():
        try:
            found[name] = read(name, x)
        except Refused as error:
            raise InputError(f"{where}, '{name}': {error}") from None
    return found


def _places(given: Mapping[str, Any]) -> dict[str, dict[str, Record]]:
    """Values by place and contestant, each read as a scenario takes it. Raises InputError."""
    return {
        place: {name: _values(x, f"{place}, {name}") for name, x in of.items()}
        for place, of in given.items()
    }


def _packaged() -> dict[str, Settings]:
    """The sets of tuned.toml by name."""
    return {
        name: Settings(
            name,
            x["words"],
            flat(x["values"]),
            {each: flat(values) for each, values in x["contestants"].items()},
            _places(x["places"]),
        )
        for name, x in packaged("biped_adrc.bench", "tuned.toml").items()
    }


COMPARED = ("PD", "NPD", "ADRC", "ADRC output", "LESO", "DOB", "CLF-QP")
"""Controllers compared as published, in the order of the tables."""
AS_PUBLISHED = Settings(
    "as-published",
    SAID["texts"]["as_published"],
    {},
    {name: {"controller.name": name} for name in COMPARED},
    {},
)
"""Each controller at its author's or its example's settings."""
SETTINGS: Mapping[str, Settings] = {**_packaged(), AS_PUBLISHED.name: AS_PUBLISHED}
"""The sets that come with the package, by name."""
TUNED = next(iter(SETTINGS.values()))
"""The set of a comparison that is told no other."""


def settings_of(name: str) -> Settings:
    """A set by its name, or from a file of one's own. Raises InputError for neither."""
    if name in SETTINGS:
        return SETTINGS[name]
    if Path(name).suffix == ".toml":
        return read_settings(Path(name))
    raise InputError(
        f"there are no settings '{name}', expected one of {list(SETTINGS)} or a file that ends in .toml"
    )


def read_settings(path: Path) -> Settings:
    """A set of one's own, on top of `TUNED`. Raises InputError for what there is not, or no scenario takes."""
    with reading("file of settings", path, InputError):
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
        given = tables.get("places", {})
        if not given or set(tables) - {"words", "contestants", "places"}:
            raise InputError(
                f"found the tables {sorted(tables)}, expected 'places' and perhaps 'contestants' and 'words'"
            )
        if not set(given) <= set(TUNED.places):
            raise InputError(
                f"found the places {list(given)}, expected some of {list(TUNED.places)}"
            )
        own = {
            n: {"controller.name": n}
            for of in given.values()
            for n in of
            if n not in TUNED.contestants
        }
        own |= {n: _values(x, n) for n, x in tables.get("contestants", {}).items()}
        chosen = _places(given)
        places = {place: {**x, **chosen.get(place, {})} for place, x in TUNED.places.items()}
        said = str(tables.get("words", f"those of {path.name}")).rstrip(".")
        said = f"{said}; on top of {TUNED.name}, {TUNED.words}"
        return Settings(path.stem, said, TUNED.values, {**TUNED.contestants, **own}, places)
