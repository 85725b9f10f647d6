"""A push as a record, and its short text on the command line, JOINTS=TORQUE@STEP:START-STOP.

    ba.Push(joints="q1,-q2", torque=30.0, step=3, onset=0.1, duration=0.2)
    ba.Push(shape="sine", link="torso", force=60.0, frequency=5.0)

It is a torque on joints, or a force on a link, of a shape in time: a class that the registry finds by its name.
STEP is the number of a single support, START and STOP are times from its beginning; q1, q2, .. are coordinates,
those with motors first. A record is a checked table of plain values (`records`). The texts of a command line:

    q1,q2,q3,q4=30@19:0.1-0.3            30 N m on four joints in single support 19, from 0.1 to 0.3 s
    q1=20,q5=-5@3:0.05-0.2:rise=0.01     two torques, each edge taking 10 ms
    q1=40@19:0.05-0.3:sine=5             a sine of 5 Hz within the window
    q5=10@2:0.1-                         a step of the torque that stays for good
"""

import re
from decimal import Decimal
from typing import Any

from biped_adrc.core.errors import InputError
from biped_adrc.core.registry import find
from biped_adrc.scenario.records import OpenRecord, field
from biped_adrc.scenario.units import quantity

RANDOM = "random"
"""Value of `joints` for a push on all joints with motors, with factors in -1 .. 1 that are drawn."""
_NUMBER = r"[0-9.eE+-]+?\s*[^\s@:,=0-9-]*"
_TORQUE = r"[^@=]+=[^@=,]+"
_PUSH = re.compile(
    rf"(?P<joints>{_TORQUE}(,{_TORQUE})*)@(?P<step>\d+):(?P<start>{_NUMBER})-(?P<stop>({_NUMBER})?)"
    rf"(:sine=(?P<frequency>{_NUMBER})|:rise=(?P<rise>{_NUMBER}))?"
)
_FORM = "expected JOINTS=TORQUE@STEP:START-STOP, such as 'q1,q2=30@19:0.1-0.3'"


class Push(OpenRecord, defer_build=False):  # `help` shows the values of a finished class alone
    """A torque on joints or a force on a link, of a shape in time.

    values: further ones, those that the class of the shape takes, by name. Raises InputError for a shape that
    there is not, for a value out of its range, and for a force beside a torque.

    >>> push = ba.Push(torque=-60.0, joints="q1,q2", step=2, onset=0.1)
    >>> ba.walk_scenario(ba.Scenario("NPD", pushes=[push], run={"impacts": 2})).impacts
    2
    """

    SHORT = "shape"
    APART = (("force", "torque"), ("torque", "link"))
    shape: str = field("pulse", kind="disturbance")
    """The shape in time is pulse, step, sine, noise, recorded, hip force, or module:Class."""
    torque: float | dict[str, float] = field(0.0, "N m")
    """Each of the joints gets this torque; a table has one by joint."""
    joints: str = field("q1,q2,q3,q4")
    """The push acts on these, as 'q1,-q3' (the other sign); 'random' draws factors for all with motors."""
    force: float = field(0.0, "N", ge=0, le=100000.0)
    """A link, or the hip, gets this force."""
    link: str | None = field(None)
    """The force acts on the origin of this link."""
    direction: float = field(0.0, "rad", ge=-7, le=7)
    """The force has this angle, from forwards to up."""
    step: int = field(3, ge=1, le=100000)
    """The push begins in this single support."""
    onset: float | None = field(None, "s", ge=0, le=100)
    """The push begins at this time in it; by default drawn, to end within it."""
    duration: float = field(0.2, "s", gt=0, le=100.0)
    """A pulse, a sine or noise lasts so long."""
    rise: float = field(0.0, "s", ge=0, le=10.0)
    """Each edge of a pulse takes this time."""
    frequency: float = field(5.0, "Hz", gt=0, le=1000.0)
    """A sine has this frequency, and noise none above it."""
    across_impacts: bool | None = field(None)
    """The push goes on over impacts; by default as its shape does."""

    @property
    def over_impacts(self) -> bool:
        """Whether the push goes on over impacts, by the record or, where it does not say, by its shape."""
        # over_steps of the registry's entry: whether a push of this shape goes on over impacts by default
        by_shape = find("disturbance", self.shape).over_steps
        return by_shape if self.across_impacts is None else self.across_impacts

    @property
    def factors(self) -> dict[str, float]:
        """Torque [N m] by name of the joint, with the signs of `joints`; empty for random joints, whose factors
        are drawn when the walker is built.
        """
        # a table has torques by joint already, and `joints` does not count
        if isinstance(self.torque, dict):
            return dict(self.torque)
        torques: dict[str, float] = {}
        for word in () if self.joints == RANDOM else self.joints.split(","):
            joint, sign = word.strip().lstrip("+-"), -1.0 if word.strip()[0:1] == "-" else 1.0
            # a joint that is named twice gets both
            torques[joint] = torques.get(joint, 0.0) + sign * self.torque
        return torques

    def stop(self, onset: float) -> float:
        """The end [s] of a push that begins at `onset` [s].

        Onset and duration are added as decimal numbers, so that 0.1 and 0.2 make 0.3; an onset that was drawn
        has no short decimal form, and floats are added.
        """
        if self.onset is None:
            return onset + self.duration
        return float(Decimal(repr(onset)) + Decimal(repr(self.duration)))

    def in_words(self) -> str:
        """The push as part of a sentence, such as "30 N m on q1, q2 from 0.1 to 0.3 s in single support 19".

        A force, and a push whose onset or torques are drawn, are written by their values: "Push(force=..)".
        """
        if self.onset is None or self.link is not None or self.force or not self.factors:
            return repr(self)
        groups: dict[float, list[str]] = {}  # torque [N m] -> joints that get it
        for joint, torque in self.factors.items():
            groups.setdefault(torque, []).append(joint)
        what = " and ".join(f"{x:g} N m on {', '.join(on)}" for x, on in groups.items())
        shape = f", a sine of {self.frequency:g} Hz," if self.shape == "sine" else ""
        until = " s on" if self.shape == "step" else f" to {self.stop(self.onset):g} s"
        edges = f", each edge taking {self.rise:g} s" if self.rise else ""
        return f"{what}{shape} from {self.onset:g}{until} in single support {self.step}{edges}"


def parse_push(text: str) -> Push:
    """A push from its text: torques [N m] by joint, step, window [s], and :sine=HERTZ or :rise=SECONDS.

    Joints without a torque of their own take the next one: "q1,q2=30,q5=20@19:0.1-0.3". Without a stop
    ("@19:0.1-") it is a step of the torque that stays. A sine ends with its single support. Raises InputError
    with the form expected.
    """
    match = _PUSH.fullmatch(text.strip())
    if match is None:
        raise InputError(f"push '{text}' is not understood; {_FORM}")
    start, stop = match["start"], match["stop"]
    values: dict[str, Any] = {"step": int(match["step"])}
    values["shape"] = "sine" if match["frequency"] else "pulse" if stop else "step"
    # a sine would else go on over impacts; None: as the shape does
    values["across_impacts"] = False if match["frequency"] else None
    # these two as texts, whose units `Push` reads
    values |= {name: match[name] for name in ("frequency", "rise") if match[name]}
    try:
        values["onset"] = begin = quantity(start, "s")
        if stop:
            # by decimal numbers, so that 0.1 to 0.3 lasts 0.2 and not 0.19999999999999998
            values["duration"] = float(Decimal(repr(quantity(stop, "s"))) - Decimal(repr(begin)))
        torque = {
            joint.strip(): quantity(value, "N m")
            for joints, value in re.findall(r"([^=]+)=([^,]+),?", match["joints"])
            for joint in joints.split(",")
        }
        # one torque for all joints is written as joints and a number, else as a table by joint; after pop() the
        # set is empty if there was one value only
        alike = set(torque.values())
        one = {"joints": ",".join(torque), "torque": alike.pop()}
        return Push(**values, **({"torque": torque} if alike else one))
    except ValueError as error:
        raise InputError(f"push '{text}': {error}; {_FORM}") from error
