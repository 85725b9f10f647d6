"""A push on joints in plain values, and its short text on the command line, JOINTS=TORQUE@STEP:START-STOP.

The paper's pushes are of this form: torques on the driven joints in one single support, for a window of time.
`Push` is checked when it is made; `Push.disturbance` gives the object that the closed loop evaluates.

    q1,q2,q3,q4=30@19:0.1-0.3            30 N m on four joints in single support 19, from 0.1 to 0.3 s
    q1=20,q5=-5@3:0.05-0.2:rise=0.01     two torques, each edge taking 10 ms
    q1=40@19:0.05-0.3:sine=5             a sine of 5 Hz within the window
    q5=10@2:0.1-                         a step of the torque that stays for good
"""

from __future__ import annotations

import math
import re
from itertools import groupby
from typing import TYPE_CHECKING

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
    r"(:sine=(?P<frequency>[0-9.eE+]+)|:rise=(?P<rise>[0-9.eE+-]+))?"
)


@clear()
@dataclass(frozen=True, config=ConfigDict(extra="forbid"))
class Push(Shown):
    """Torques on joints during the window [start, stop) of one single support.

    Raises InputError for a kind that is not in the registry or a value of the wrong type.
    """

    torque: dict[str, float]
    """[N m] by joint."""
    step: int = 19
    """Number of the single support, the first one being 1."""
    start: float = 0.1
    """From the start of that single support [s]."""
    stop: float = 0.3
    """From the start of that single support [s]; infinite for the kind "step", which stays for good."""
    kind: str = "pulse"
    """Of the registry: pulse, sine, step, or one of the user's own."""
    frequency: float = 5.0
    """Of a sine [Hz]."""
    rise: float = 0.0
    """Duration of each edge of a pulse [s]."""

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

    def _groups(self) -> list[tuple[float, list[str]]]:
        """Torques [N m], each with the joints in a row that have it."""
        alike = groupby(self.torque.items(), lambda item: item[1])
        return [(torque, [joint for joint, _ in group]) for torque, group in alike]

    def in_words(self) -> str:
        """The push as part of a sentence, such as "30 N m on q1, q2 from 0.1 to 0.3 s in single support 19"."""
        parts = [f"{torque:g} N m on {', '.join(joints)}" for torque, joints in self._groups()]
        sine = f", a sine of {self.frequency:g} Hz," if self.kind == "sine" else ""
        edges = f", each edge taking {self.rise:g} s" if self.rise else ""
        until = " s on" if self.kind == "step" else f" to {self.stop:g} s"
        return f"{' and '.join(parts)}{sine} from {self.start:g}{until} in single support {self.step}{edges}"

    def text(self) -> str:
        """The text for the command line, JOINTS=TORQUE@STEP:START-STOP [N m], [s]; `parse_push` reads it.

        A sine ends in :sine=HERTZ, a pulse with sloping edges in :rise=SECONDS.
        """
        groups = [f"{','.join(joints)}={torque:g}" for torque, joints in self._groups()]
        stop = "" if self.kind == "step" else f"{self.stop:g}"
        sine = f":sine={self.frequency:g}" if self.kind == "sine" else ""
        rise = f":rise={self.rise:g}" if self.rise else ""
        return f"{','.join(groups)}@{self.step}:{self.start:g}-{stop}{sine}{rise}"


def parse_push(text: str) -> Push:
    """A push from its text: torques [N m] by joint, step, window [s], and :sine=HERTZ or :rise=SECONDS.

    Joints without a torque of their own take the next one given: "q1,q2=30,q5=20@19:0.1-0.3". Without a stop
    ("@19:0.1-") it is a step that stays. Raises InputError with the form expected.
    """
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
        names = [name for name in ("start", "stop", "frequency", "rise") if match[name]]
        numbers = {"stop": math.inf} | {name: float(match[name]) for name in names}
        if numbers.get("rise") and not match["stop"]:
            raise ValueError("only a pulse, which has a stop, has a rise")
    except ValueError as error:
        raise InputError(f"push '{text}': {error}") from error
    kind = "sine" if match["frequency"] else "pulse" if match["stop"] else "step"
    return Push(torque, int(match["step"]), kind=kind, **numbers)
