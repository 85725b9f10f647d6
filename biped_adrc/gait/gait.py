"""A gait: a virtual constraint, the periodic orbit it belongs to, and where both come from.

Stored as a small readable JSON file in `gaits/<robot>/<name>-<preset>.json`.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from biped_adrc.errors import GaitError, check_positive
from biped_adrc.files import output_path, reading, write_text
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.curves import CURVES
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.parts import check_part
from biped_adrc.resources import data_folder
from biped_adrc.shown import Shown
from biped_adrc.types import Array

FORMAT = "biped_adrc gait 1"
CLOSES = 1e-3
"""[rad] and [m]: largest gap between the end of a step, relabelled, and its start, in a gait that closes."""


@dataclass(frozen=True)
class Gait(Shown):
    """`q_minus`, `v_minus` (n,): the pre-impact state of the periodic orbit [rad, rad/s]."""

    name: str
    robot: str
    preset: str
    constraint: VirtualConstraint
    q_minus: Array
    v_minus: Array
    period: float
    provenance: Mapping[str, Any]
    slope: float = 0.0
    """Of the ground it walks on [rad], positive downhill."""

    def __repr__(self) -> str:
        about = f"Gait('{self.name}', robot '{self.robot}', preset '{self.preset}', period {self.period:.4g} s"
        return about + (f", slope {self.slope:.4g} rad)" if self.slope else ")")

    def start(self, biped: Biped) -> tuple[Array, Array]:
        """(q+, q'+) after the impact of the periodic orbit on this robot, each (n,)."""
        impact = biped.impact(self.q_minus, self.v_minus)
        return impact.q, impact.v

    @classmethod
    def of_cycle(
        cls, name: str, zero: ZeroDynamics, provenance: Mapping[str, Any], slope: float = 0.0
    ) -> Gait:
        """A constraint with the periodic orbit of its zero dynamics. Raises GaitError when there is none."""
        q, v = zero.end_state(zero.sigma_minus)
        robot, preset, period = zero.biped.description.name, zero.biped.preset, zero.cycle.period
        return cls(name, robot, preset, zero.constraint, q, v, period, provenance, slope)

    def check(self, biped: Biped) -> Gait:
        """The gait itself, when it fits the robot and its curve closes. Raises GaitError."""
        c = self.constraint
        p, n = c.curve.coefficients.shape[0], len(c.phase)
        if (p, n) != (biped.p, biped.n):
            raise GaitError(
                f"gait '{self.name}' has {p} joints and a phase row of {n}, robot "
                f"'{biped.description.name}' has {biped.p} motors and {biped.n} coordinates"
            )
        check_positive(
            self.period, f"gait '{self.name}': the period is {self.period} s", error=GaitError
        )
        if not abs(self.slope) < 0.5 * math.pi:
            raise GaitError(
                f"gait '{self.name}': the slope is {self.slope} rad, expected less than a right angle"
            )
        rate = float(c.phase @ self.v_minus)
        if not rate * (c.theta_minus - c.theta_plus) > 0.0:
            raise GaitError(
                f"gait '{self.name}': Theta' is {rate:.4g} rad/s before impact, but the curve runs from "
                f"{c.theta_plus:.5g} to {c.theta_minus:.5g} rad: v_minus has the wrong sign or is not there"
            )
        x, z = biped.swing_foot(self.q_minus)
        height = float(z + math.tan(self.slope) * x)
        if not abs(height) <= CLOSES:
            raise GaitError(
                f"gait '{self.name}': the swing foot is {height:.3g} m above the ground before impact, "
                f"expected 0 within {CLOSES:g} m"
            )
        after = biped.relabel(self.q_minus)
        begins, ends = float(c.phase @ after), float(c.phase @ self.q_minus)
        if max(abs(begins - c.theta_plus), abs(ends - c.theta_minus)) > CLOSES:
            raise GaitError(
                f"gait '{self.name}': the curve covers Theta from {c.theta_plus:.5g} to {c.theta_minus:.5g} "
                f"rad, the step runs from {begins:.5g} to {ends:.5g} rad; theta_plus has to be c q+ after the "
                "relabelled impact, theta_minus c q- before it"
            )
        end, begin = c.h(c.theta_minus)[0], c.h(c.theta_plus)[0]
        gap = max(
            float(np.max(np.abs(begin - after[: biped.p]))),
            float(np.max(np.abs(end - self.q_minus[: biped.p]))),
        )
        if gap > CLOSES:
            raise GaitError(
                f"gait '{self.name}' does not close: the end of the step, relabelled, misses its start "
                f"by {gap:.3g} rad, expected at most {CLOSES:g} rad; check the order and sign of "
                "the joints"
            )
        return self

    @property
    def file_name(self) -> str:
        """What its file is called. Raises GaitError for a name that would lead into another folder."""
        name = f"{self.name}-{self.preset}.json"
        if name != Path(name).name:
            raise GaitError(
                f"gait '{self.name}', preset '{self.preset}', has a name that is a path; say where to write it"
            )
        return name

    def save(self, path: Path | str) -> None:
        """Write the JSON file. Raises InputError for a name that does not end in .json, and OutputError."""
        path = output_path(path, (".json",))
        c = self.constraint
        record = {
            "format": FORMAT,
            "name": self.name,
            "robot": self.robot,
            "preset": self.preset,
            "units": "rad, rad/s, s",
            "provenance": dict(self.provenance),
            "period": self.period,
            "slope": self.slope,
            "q_minus": self.q_minus.tolist(),
            "v_minus": self.v_minus.tolist(),
            "phase": c.phase.tolist(),
            "theta_plus": c.theta_plus,
            "theta_minus": c.theta_minus,
            "curve": type(c.curve).__name__.lower(),
            "coefficients": c.curve.coefficients.tolist(),
        }
        write_text(path, _readable(record))


def _readable(record: Mapping[str, Any]) -> str:
    """JSON with one line per row of numbers."""
    lines = []
    for key, value in record.items():
        if key == "coefficients":
            rows = ",\n    ".join(json.dumps(row) for row in value)
            lines.append(f'  "{key}": [\n    {rows}\n  ]')
        elif isinstance(value, dict):
            inner = ",\n    ".join(f"{json.dumps(k)}: {json.dumps(v)}" for k, v in value.items())
            lines.append(f'  "{key}": {{\n    {inner}\n  }}')
        else:
            lines.append(f'  "{key}": {json.dumps(value)}')
    return "{\n" + ",\n".join(lines) + "\n}\n"


def gait_names(robot: str, preset: str) -> tuple[str, ...]:
    """Names of the stored gaits of a robot and preset."""
    end = f"-{preset}.json"
    folder = data_folder("gaits") / robot
    found = (f.name.removesuffix(end) for f in folder.glob(f"*{end}"))
    known = {name.removesuffix("-identified") for name in found}
    return tuple(sorted(name for name in known if (folder / f"{name}{end}").is_file()))


def load_gait(gait: str | Path, biped: Biped) -> Gait:
    """A stored gait by name for this robot and preset, or a gait file by its path.

    Raises GaitError that names the file, the key, what was found and what was expected.
    """
    check_part(gait, "gait", str, Path)
    check_part(biped, "biped", Biped)
    path = Path(gait)
    if path.suffix.lower() != ".json":
        robot, preset = biped.description.name, biped.preset
        path = data_folder("gaits") / robot / f"{gait}-{preset}.json"
        if not path.is_file():
            known = list(gait_names(robot, preset))
            choose = f"choose one of {known}" if known else "none is stored: design one"
            raise GaitError(
                f"there is no gait '{gait}' for robot '{robot}', preset '{preset}'; {choose}, or give the path "
                "of a .json file"
            )
    with reading("gait file", path, GaitError):
        return _from_record(json.loads(path.read_text(encoding="utf-8"))).check(biped)


def _from_record(record: Mapping[str, Any]) -> Gait:
    if record["format"] != FORMAT:
        raise GaitError(f"format is '{record['format']}', expected '{FORMAT}'")
    if record["curve"] not in CURVES:
        raise GaitError(f"curve is '{record['curve']}', expected one of {sorted(CURVES)}")
    n = len(record["phase"])
    q, v, phase = (finite_vector(record, key, n) for key in ("q_minus", "v_minus", "phase"))
    return Gait(
        record["name"],
        record["robot"],
        record["preset"],
        VirtualConstraint(
            CURVES[record["curve"]](np.array(record["coefficients"], dtype=float)),
            phase,
            float(record["theta_plus"]),
            float(record["theta_minus"]),
        ),
        q,
        v,
        float(record["period"]),
        record["provenance"],
        float(record.get("slope", 0.0)),
    )


def finite_vector(record: Mapping[str, Any], key: str, length: int) -> Array:
    """The numbers under a key of a record. Raises GaitError unless there are `length` finite ones."""
    value = np.array(record[key], dtype=float)
    if value.shape != (length,) or not np.all(np.isfinite(value)):
        raise GaitError(f"{key} is {record[key]}, expected {length} finite numbers")
    return value
