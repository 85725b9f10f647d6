"""Gaits of one robot over speed, stored as one readable file each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from biped_adrc.errors import GaitError, InputError
from biped_adrc.gait.gait import Gait, load_gait
from biped_adrc.model.biped import Biped


@dataclass(frozen=True)
class GaitLibrary:
    """Gaits of one robot by speed [m/s], slowest first."""

    gaits: Mapping[float, Gait]

    def __post_init__(self) -> None:
        if not self.gaits:
            raise GaitError("a gait library needs at least one gait; found none")
        object.__setattr__(self, "gaits", dict(sorted(self.gaits.items())))

    @property
    def speeds(self) -> tuple[float, ...]:
        """[m/s]."""
        return tuple(self.gaits)

    def nearest(self, speed: float) -> Gait:
        """The gait whose speed is nearest."""
        return self.gaits[min(self.gaits, key=lambda known: abs(known - speed))]

    def save(self, folder: Path | str) -> tuple[Path, ...]:
        """One file per gait, named by speed and preset. Raises OutputError."""
        paths = {
            Path(folder) / f"{gait.name}-{gait.preset}.json": gait for gait in self.gaits.values()
        }
        for path, gait in paths.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            gait.save(path)
        return tuple(paths)

    @classmethod
    def load(cls, folder: Path | str, biped: Biped) -> GaitLibrary:
        """The gaits of a folder that are of this robot and preset. Raises GaitError."""
        gaits = {}
        for path in sorted(Path(folder).glob(f"*-{biped.preset}.json")):
            gait = load_gait(path, biped)
            if (gait.robot, gait.preset) == (biped.description.name, biped.preset):
                gaits[speed_of(gait, biped)] = gait
        if not gaits:
            raise GaitError(
                f"folder '{folder}' has no gait of robot '{biped.description.name}', preset "
                f"'{biped.preset}'; 'biped-adrc gait library' writes them"
            )
        return cls(gaits)


def speed_of(gait: Gait, biped: Biped) -> float:
    """Average speed along the ground [m/s]."""
    return float(np.hypot(*biped.swing_foot(gait.q_minus)) / gait.period)


def speeds_named(text: str) -> tuple[float, ...]:
    """Speeds [m/s] from "0.4,0.5" or "0.4:1.1:0.1", both ends counted. Raises InputError."""
    try:
        if ":" in text:
            first, last, by = (float(word) for word in text.split(":"))
            if not (by > 0.0 and last >= first):
                raise ValueError
            return tuple(round(first + k * by, 9) for k in range(round((last - first) / by) + 1))
        return tuple(float(word) for word in text.split(","))
    except ValueError:
        raise InputError(
            f"speeds are '{text}', expected numbers as '0.4,0.5,0.6' or FIRST:LAST:STEP as '0.4:1.1:0.1' [m/s]"
        ) from None
