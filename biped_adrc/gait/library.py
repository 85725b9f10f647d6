"""Gaits of one robot over speed, one readable file each; `biped-adrc gait design --speeds` writes them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from biped_adrc.core.errors import GaitError, InputError
from biped_adrc.core.files import read_json
from biped_adrc.core.shown import Shown
from biped_adrc.gait.gait import Gait, load_gait
from biped_adrc.model.biped import Biped


@dataclass(frozen=True)
class GaitLibrary(Shown):
    """Gaits of one robot and preset over speed.

    Gaits are not interpolated: a mean of two hybrid-invariant constraints is not hybrid-invariant in general,
    so a speed is served by the nearest gait.

    >>> library = ba.GaitLibrary({v: ba.load_gait(f"v{v}", biped) for v in (0.5, 0.8)})
    >>> library.nearest(0.6).name
    'v0.5'
    """

    gaits: Mapping[float, Gait]
    """By average speed [m/s]; sorted, slowest first."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "gaits", dict(sorted(self.gaits.items())))

    @property
    def speeds(self) -> tuple[float, ...]:
        """Average speeds of the gaits [m/s], slowest first."""
        return tuple(self.gaits)

    def nearest(self, speed: float) -> Gait:
        """The gait whose speed is nearest to `speed` [m/s]."""
        return self.gaits[min(self.gaits, key=lambda known: abs(known - speed))]

    @classmethod
    def load(cls, folder: Path | str, biped: Biped) -> GaitLibrary:
        """The gaits of a folder that are of this robot and preset.

        Raises GaitError for none, or a damaged file.
        """
        gaits = {}
        for path in sorted(Path(folder).glob(f"*-{biped.preset}.json")):
            if _robot_of(path) == biped.description.name:
                gait = load_gait(path, biped)
                gaits[speed_of(gait, biped)] = gait
        if not gaits:
            raise GaitError(
                f"folder '{folder}' has no gait of robot '{biped.description.name}', preset "
                f"'{biped.preset}'; 'biped-adrc gait design --speeds' writes them"
            )
        return cls(gaits)


def _robot_of(path: Path) -> str:
    """Name of the robot in a gait file; empty where the file has none or cannot be read."""
    try:
        return str(read_json(path, "gait file").get("robot", ""))
    except (InputError, AttributeError):
        return ""


def speed_of(gait: Gait, biped: Biped) -> float:
    """Average speed of a gait along the ground [m/s]: distance of the feet before impact over the period."""
    return float(np.hypot(*biped.swing_foot(gait.q_minus)) / gait.period)
