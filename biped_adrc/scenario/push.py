"""Pushes described by plain values, and by the text of the command line."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from itertools import groupby
from typing import TYPE_CHECKING, Any

from pydantic import ConfigDict
from pydantic.dataclasses import dataclass

from biped_adrc.errors import InputError
from biped_adrc.scenario.registry import find
from biped_adrc.scenario.values import clear
from biped_adrc.shown import Shown

if TYPE_CHECKING:
    from biped_adrc.disturbances.base import Disturbance
    from biped_adrc.model.biped import Biped

_PUSH = re.compile(
    r"(?P<joints>[^@]+)@(?P<step>\d+):(?P<start>[0-9.eE+]+)-(?P<stop>[0-9.eE+]*)"
    r"(:sine=(?P<f>[0-9.eE+]+)|:rise=(?P<rise>[0-9.eE+-]+))?"
)


@clear()
@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Push(Shown):
    """A disturbance by name: torques [N m] on joints in single support `step`, [start, stop) s.

    kind: of the registry, such as pulse (with edges of `rise` [s]), sine (with `frequency` [Hz]) or step (from
    `start` on, for good).
    """

    torque: dict[str, float]
    step: int = 19
    start: float = 0.1
    stop: float = 0.3
    kind: str = "pulse"
    frequency: float = 5.0
    rise: float = 0.0

    def __post_init__(self) -> None:
        find("disturbance", self.kind)
        if self.kind == "step":
            object.__setattr__(self, "stop", math.inf)

    def disturbance(self, biped: Biped) -> Disturbance:
        """The disturbance for this robot. Raises InputError for an unknown kind or joint."""
        from biped_adrc.scenario.disturbances import on_joints

        values = {"step": self.step, "start": self.start, "stop": self.stop, "rise": self.rise}
        values["frequency"] = self.frequency
        return on_joints(self.kind, biped, self.torque, values)

    def in_words(self) -> str:
        """For a reader."""
        parts = [
            f"{torque:g} N m on {', '.join(joint for joint, _ in group)}"
            for torque, group in groupby(self.torque.items(), lambda item: item[1])
        ]
        sine = f", a sine of {self.frequency:g} Hz," if self.kind == "sine" else ""
        edges = f", each edge taking {self.rise:g} s" if self.rise else ""
        until = " s on" if self.kind == "step" else f" to {self.stop:g} s"
        return f"{' and '.join(parts)}{sine} from {self.start:g}{until} in single support {self.step}{edges}"

    def text(self) -> str:
        """As on the command line, JOINTS=TORQUE@STEP:START-STOP [N m], [s]; `parse_push` reads it.

        A sine ends in :sine=HERTZ, a pulse with sloping edges in :rise=SECONDS.
        """
        groups = [
            f"{','.join(joint for joint, _ in group)}={torque:g}"
            for torque, group in groupby(self.torque.items(), lambda item: item[1])
        ]
        stop = "" if self.kind == "step" else f"{self.stop:g}"
        sine = f":sine={self.frequency:g}" if self.kind == "sine" else ""
        rise = f":rise={self.rise:g}" if self.rise else ""
        return f"{','.join(groups)}@{self.step}:{self.start:g}-{stop}{sine}{rise}"


def parse_push(text: str) -> Push:
    """A push from its text. Raises InputError with the form expected."""
    match = _PUSH.fullmatch(text.strip())
    if match is None:
        raise InputError(
            f"push '{text}' is not understood; expected JOINTS=TORQUE@STEP:START-STOP, such as "
            "'q1,q2=30@19:0.1-0.3'"
        )
    try:
        torque: dict[str, float] = {}
        waiting: list[str] = []
        for part in match["joints"].split(","):
            joint, equals, value = part.partition("=")
            waiting.append(joint.strip())
            if equals:
                torque |= dict.fromkeys(waiting, float(value))
                waiting = []
        if waiting:
            raise ValueError(f"no torque for {waiting}")
        start = float(match["start"])
        stop = float(match["stop"]) if match["stop"] else math.inf
        frequency = float(match["f"]) if match["f"] else 5.0
        rise = float(match["rise"]) if match["rise"] else 0.0
        if rise and not match["stop"]:
            raise ValueError("only a pulse, which has a stop, has a rise")
    except ValueError as error:
        raise InputError(f"push '{text}': {error}") from error
    kind = "sine" if match["f"] else "pulse" if match["stop"] else "step"
    return Push(torque, int(match["step"]), start, stop, kind, frequency, rise)


def joints_push(torque: float, joints: Sequence[str], **window: Any) -> Push:
    """The same torque [N m] on several joints."""
    return Push(dict.fromkeys(joints, torque), **window)
