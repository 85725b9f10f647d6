"""A gait: a virtual constraint, the periodic orbit it belongs to, and where both come from.

Stored as a small readable JSON file in `gaits/<robot>/<name>-<preset>.json`, whose keys `Gait.save` lists: the
fields of `Gait` with the constraint taken apart, in rad, rad/s and s. Files are read by people and compared by
version control, so keys and order are fixed and numbers have all digits. `load_gait` finds it by name or path
and checks it against the robot (`Gait.check`): shapes, direction, foot on the ground, and closure, that is,
the relabelled end of the step is its start (relabelled: with the coordinates of the two legs exchanged, as the
impact does).

`published` and `design` make gaits, `exchange` imports them; `scenario` walks them, and controllers use
their constraints as references.
"""

import json
import math
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import numpy as np

from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import GaitError
from biped_adrc.core.files import CONTROL, data_file, output_path, plain, reading, write_json
from biped_adrc.core.shown import Frozen
from biped_adrc.core.types import Array
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.gait.curves import curve_kind
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import ground_axes

FORMAT = "biped_adrc gait 1"
"""First entry of a gait file; the number changes with the keys."""
CLOSES = 1e-3
"""Largest gap between the end of a step, relabelled, and its start, in a gait that closes [rad], [m]."""


@dataclass(frozen=True)
class Gait(Frozen):
    """A gait of one robot: its virtual constraint and the periodic orbit that walks along it.

    The orbit is stored by its state just before impact, from which the impact map gives the start of a step.
    For a hybrid-invariant constraint it is the orbit of the zero dynamics; gait (b) of the paper is not
    hybrid-invariant, and stores the orbit of the closed loop.

    No check is made when a gait is constructed; `check` compares it with a robot.

    >>> gait = ba.load_gait("published", biped)
    >>> round(gait.period, 3)
    0.416
    """

    SUCH_AS = "load_gait('published', biped)"  # an example of such an object, for error messages

    name: str
    """Name by which `load_gait` finds its file."""
    robot: str
    preset: str
    """Name of the preset (set of masses) of the robot it was made for."""
    constraint: VirtualConstraint
    """The virtual constraint q_b = h(Theta)."""
    q_minus: Array
    """Configuration just before impact on the periodic orbit (n,) [rad]."""
    v_minus: Array
    """Rates just before impact (n,) [rad/s]."""
    period: float
    """Duration of the single support on the orbit [s]."""
    provenance: Mapping[str, object]
    """How it was made: method, source, command; free text by name."""
    slope: float = 0.0
    """Slope of the ground it walks on [rad], positive downhill."""

    def __repr__(self) -> str:
        about = f"Gait('{self.name}', robot '{self.robot}', preset '{self.preset}', period {self.period:.4g} s"
        return about + (f", slope {self.slope:.4g} rad)" if self.slope else ")")

    def start(self, biped: Biped) -> tuple[Array, Array]:
        """(q+, q'+) just after the impact of the periodic orbit on this robot, each (n,) [rad, rad/s]."""
        impact = biped.impact(self.q_minus, self.v_minus)  # q, v after it, with the legs relabelled
        return impact.q, impact.v

    def step_length(self, biped: Biped) -> float:
        """Distance between the feet just before impact on the orbit [m]."""
        return float(np.hypot(*biped.swing_foot(self.q_minus)))

    @classmethod
    def of_cycle(
        cls, name: str, zero: ZeroDynamics, provenance: Mapping[str, object], slope: float = 0.0
    ) -> Self:
        """The gait of the constraint of `zero` with the periodic orbit of its zero dynamics.

        name, provenance: as the fields. slope [rad]: of the ground, positive downhill; only stored.
        Raises GaitError when there is no orbit.
        """
        # sigma_minus: angular momentum before impact on the periodic orbit, from which the rates follow
        q, v = zero.end_state(zero.sigma_minus)
        robot, preset, period = zero.biped.description.name, zero.biped.preset, zero.cycle.period
        return cls(name, robot, preset, zero.constraint, q, v, period, provenance, slope)

    def check_robot(self, biped: Biped) -> Self:
        """The gait itself. Raises GaitError if it was made for another robot or preset."""
        ours, this = (self.robot, self.preset), (biped.description.name, biped.preset)
        if ours != this:
            raise GaitError(
                f"gait '{self.name}' was made for robot '{ours[0]}', preset '{ours[1]}', and this is "
                f"'{this[0]}', '{this[1]}'; take that robot (--robot), or say gait.other_robot = true"
            )
        return self

    def check(self, biped: Biped) -> Self:
        """The gait itself, after a check that it fits the robot: shapes, period, slope, both ends of the curve,
        the foot on the ground, and the direction of Theta. Raises GaitError for the first of these that does
        not hold.
        """
        for fits, text in self._laws(biped):
            if not fits:
                raise GaitError(f"gait '{self.name}': {text}")
        return self

    def _laws(self, biped: Biped) -> Iterator[tuple[bool, str]]:
        """Iterate over the conditions on a gait of this robot: (whether it holds, the message if it does not).

        Later ones use the shapes that the first one asks for, so they must not be evaluated after it fails.
        """
        c, q, d = self.constraint, self.q_minus, biped.description
        p, n = c.curve.coefficients.shape[0], len(c.phase)
        expected = f"robot '{d.name}' has {biped.p} motors and {biped.n} coordinates"
        yield (p, n) == (biped.p, biped.n), f"{p} joints and a phase row of {n}, {expected}"
        yield 0.0 < self.period < math.inf, f"the period is {self.period} s, expected above 0"
        below = abs(self.slope) < 0.5 * math.pi
        yield below, f"the slope is {self.slope} rad, a right angle or more"
        ends = ("end", c.theta_minus, q), ("start", c.theta_plus, biped.relabel(q))
        for end, theta, pose in ends:
            # p joint angles and Theta: as the curve has them, and as the pose has them
            angles, goals = np.append(c.h(theta)[0], theta), np.append(pose[:p], c.phase @ pose)
            # the largest gap; rounded, so that of equal gaps a joint is named and not Theta, which is last
            k = int(np.argmax(np.round(np.abs(angles - goals), 9)))
            yield (
                bool(abs(angles[k] - goals[k]) <= CLOSES),
                f"{(*d.joints[:p], 'Theta')[k]} at the {end} of the curve is {angles[k]:.6g} rad, expected "
                f"{goals[k]:.6g} within {CLOSES:g}: the end of the step, relabelled, is not its start; are "
                "there degrees, a time, a sign or an order of joints, another convention, another robot?",
            )
        x, z = biped.swing_foot(q)
        height, rate = z + math.tan(self.slope) * x, float(c.phase @ self.v_minus)
        yield (
            abs(height) <= CLOSES and x > 0.0,
            f"the swing foot ends {height:.3g} m above the ground and {x:.4g} m ahead of the stance foot, "
            f"expected 0 within {CLOSES:g}, and x > 0: other legs, another slope, a time in place of the "
            "phase, or it walks to -x",
        )
        yield (
            rate * (c.theta_minus - c.theta_plus) > 0.0,
            f"Theta' is {rate:.4g} rad/s before impact, but the curve runs from {c.theta_plus:.5g} to "
            f"{c.theta_minus:.5g} rad: v_minus has the wrong sign or is not there",
        )

    @property
    def file_name(self) -> str:
        """Name of its file, without folder. Raises GaitError for a gait's name that no file may have, or that
        is a path.
        """
        name = f"{self.name}-{self.preset}.json"
        # CONTROL: control characters, such as a line break
        if CONTROL.search(name) or name != Path(name).name:
            raise GaitError(f"{name!r} is no name of a file; say where to write the gait")
        return name

    def save(self, path: Path | str) -> None:
        """Write the gait as a JSON file. Raises InputError for a name that does not end
        in .json, and OutputError.
        """
        c, own = self.constraint, ("name", "robot", "preset", "provenance", "period", "slope")
        record = {"format": FORMAT, "units": "rad, rad/s, s"}
        record["curve"] = type(c.curve).__name__.lower()
        record |= {key: plain(getattr(self, key)) for key in (*own, "q_minus", "v_minus")}
        record |= {key: plain(getattr(c, key)) for key in ("phase", "theta_plus", "theta_minus")}
        record["coefficients"] = plain(c.curve.coefficients)
        write_json(record, output_path(path, (".json",)))


def gait_names(robot: str, preset: str, *folder: str) -> tuple[str, ...]:
    """Names of the stored gaits of a robot and preset, or of what is in a folder below them, sorted; files are
    called NAME-PRESET.json.
    """
    end = f"-{preset}.json"
    files = data_file("gaits", robot, *folder).glob("*.json")
    return tuple(sorted(x.name.removesuffix(end) for x in files if x.name.endswith(end)))


def stored_file(kind: str, name: str | Path, biped: Biped, *folder: str) -> Path:
    """The file of a stored gait, or of what `kind` names, for this robot and preset, by name; or the path
    itself of a .json file, which need not be there. Raises GaitError with the known names.
    """
    path, robot, preset = Path(name), biped.description.name, biped.preset
    if path.suffix.lower() == ".json":
        return path
    path = data_file("gaits", robot, *folder, f"{name}-{preset}.json")
    if not os.path.isfile(path):
        known = list(gait_names(robot, preset, *folder))
        choose = f"choose one of {known}" if known else "none is stored: design one"
        raise GaitError(
            f"there is no {kind} '{name}' for robot '{robot}', preset '{preset}'; {choose}, or give the path "
            "of a .json file, which 'biped-adrc gait design' writes"
        )
    return path


def load_gait(gait: str | Path, biped: Biped, other_robot: bool = False) -> Gait:
    """Load a stored gait by name for this robot and preset, or a gait file by its path.

    gait: its name, or the path of its file. biped: the robot that walks it. other_robot: accept a file that was
    made for another robot or preset. Raises GaitError that names the file, the key, what was found and what was
    expected.

    >>> ba.load_gait("v0.5", biped).name
    'v0.5'
    """
    check_part(gait, "gait", str, Path)
    check_part(biped, "biped", Biped)
    path = stored_file("gait", gait, biped)
    with reading("gait file", path, GaitError):
        result = _from_record(json.loads(path.read_text(encoding="utf-8"))).check(biped)
        return result if other_robot else result.check_robot(biped)


def _from_record(record: Mapping[str, Any]) -> Gait:
    """The gait from the content of its file, not yet checked against a robot. Raises GaitError for another
    format or numbers that are not finite, and KeyError or TypeError for damaged entries.
    """
    if record["format"] != FORMAT:
        raise GaitError(f"format is '{record['format']}', expected '{FORMAT}'")
    n = len(record["phase"])
    q, v, phase = (finite_vector(record, key, n) for key in ("q_minus", "v_minus", "phase"))
    curve = curve_kind(record["curve"])(np.array(record["coefficients"], dtype=float))
    ends = float(record["theta_plus"]), float(record["theta_minus"])
    h = VirtualConstraint(curve, phase, *ends)
    period, slope = float(record["period"]), float(record.get("slope", 0.0))
    names = record["name"], record["robot"], record["preset"]
    return Gait(*names, h, q, v, period, record["provenance"], slope)


def onto_section(biped: Biped, q: Array, slope: float = 0.0) -> Array:
    """The configuration (n,) [rad] near q (n,) whose swing foot is on ground of `slope` [rad], positive
    downhill: on the Poincare section.

    Newton's method on the foot's height moves the actuated joints q_b only, by the least change; the last
    coordinate q_N is kept. Raises GaitError when no configuration near q reaches the ground.
    """
    q = np.array(q, dtype=float)
    normal = ground_axes(slope)[1]  # unit vector out of the ground
    for _ in range(30):
        height = float(normal @ biped.swing_foot(q))
        # derivative of the height by the actuated joints; [:-1] leaves out q_N
        row = (normal @ biped.swing_foot_jacobian(q))[:-1]
        # on the ground [m], or no actuated joint moves the height of the foot
        if abs(height) < 1e-15 or not row @ row > 1e-12:
            break
        q[:-1] -= row * height / (row @ row)
    if not abs(height) < 1e-12:
        raise GaitError(
            f"the swing foot stays {height:.3g} m off the ground: no configuration near this one reaches it"
        )
    return q


def finite_vector(record: Mapping[str, object], key: str, length: int) -> Array:
    """The numbers (length,) that a file's content `record` has under a key. Raises GaitError unless there are
    `length` finite ones.
    """
    value = np.array(record[key], dtype=float)
    if value.shape != (length,) or not np.all(np.isfinite(value)):
        raise GaitError(f"{key} is {record[key]}, expected {length} finite numbers")
    return value
