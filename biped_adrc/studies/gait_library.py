"""Gaits of one robot over speed, stored as one readable file each."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from biped_adrc.errors import GaitError, InputError
from biped_adrc.gait.gait import Gait, load_gait
from biped_adrc.model.biped import Biped

MOST_SPEEDS = 1000


@dataclass(frozen=True)
class GaitLibrary:
    """Gaits of one robot by speed [m/s], slowest first."""

    gaits: Mapping[float, Gait]

    def __post_init__(self) -> None:
        if not self.gaits:
            raise GaitError("a gait library needs at least one gait; found none")
        if not all(speed > 0.0 for speed in self.gaits):
            raise GaitError(f"speeds are {list(self.gaits)} m/s, expected positive numbers")
        object.__setattr__(self, "gaits", dict(sorted(self.gaits.items())))

    @property
    def speeds(self) -> tuple[float, ...]:
        """[m/s]."""
        return tuple(self.gaits)

    def nearest(self, speed: float) -> Gait:
        """The gait whose speed is nearest."""
        return self.gaits[min(self.gaits, key=lambda known: abs(known - speed))]

    def save(self, folder: Path | str) -> tuple[Path, ...]:
        """One file per gait, named by it and its preset. Raises GaitError for two of one name, OutputError."""
        paths = [Path(folder) / g.file_name for g in self.gaits.values()]
        twice = sorted({path.name for path in paths if paths.count(path) > 1})
        if twice:
            raise GaitError(f"several gaits would be written to {twice}; give them different names")
        for path, gait in zip(paths, self.gaits.values(), strict=True):
            gait.save(path)
        return tuple(paths)

    @classmethod
    def load(cls, folder: Path | str, biped: Biped) -> GaitLibrary:
        """The gaits of a folder that are of this robot and preset. Raises GaitError."""
        gaits = {}
        for path in sorted(Path(folder).glob(f"*-{biped.preset}.json")):
            if _robot_of(path) == biped.description.name:
                gait = load_gait(path, biped)
                gaits[speed_of(gait, biped)] = gait
        if not gaits:
            raise GaitError(
                f"folder '{folder}' has no gait of robot '{biped.description.name}', preset "
                f"'{biped.preset}'; 'biped-adrc gait library' writes them"
            )
        return cls(gaits)


def _robot_of(path: Path) -> str:
    """The robot a gait file says it is of; empty where it says none."""
    try:
        return str(json.loads(path.read_text(encoding="utf-8")).get("robot", ""))
    except (OSError, ValueError, AttributeError):
        return ""


def speed_of(gait: Gait, biped: Biped) -> float:
    """Average speed along the ground [m/s]."""
    return float(np.hypot(*biped.swing_foot(gait.q_minus)) / gait.period)


def speeds_named(text: str) -> tuple[float, ...]:
    """Speeds [m/s] from "0.4,0.5" or "0.4:1.1:0.1", the last one counted where it is met. Raises InputError."""
    try:
        if ":" in text:
            first, last, by = (float(word) for word in text.split(":"))
            if not (by > 0.0 and last >= first and (last - first) / by < MOST_SPEEDS):
                raise ValueError
            count = math.floor((last - first) / by + 1e-9) + 1
            return tuple(round(first + k * by, 9) for k in range(count))
        return tuple(float(word) for word in text.split(","))
    except ValueError:
        raise InputError(
            f"speeds are '{text}', expected numbers as '0.4,0.5,0.6' or FIRST:LAST:STEP as '0.4:1.1:0.1' [m/s]"
        ) from None
