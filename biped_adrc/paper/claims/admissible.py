"""The admissible choices, read from the file in which they were declared before the run."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any

from biped_adrc.engine.run import COMPILED
from biped_adrc.resources import packaged
from biped_adrc.scenario.push import Push
from biped_adrc.scenario.scenario import Scenario


def declared() -> dict[str, Any]:
    """The file admissible.toml."""
    return packaged("biped_adrc.paper.claims", "admissible.toml")


@dataclass(frozen=True)
class Member:
    """One member of the set: what the paper leaves open, chosen."""

    preset: str
    amplitude: float
    """[N m]."""
    onset: float
    """[s] after the impact."""
    joints: tuple[str, ...]
    rise: float
    """[s]."""
    start: str
    """model or zero."""
    theta: str
    """solved or printed."""
    gait: str = "published"

    @property
    def name(self) -> str:
        """For a reader."""
        gait = "" if self.gait == "published" else f"gait '{self.gait}', "
        return (
            f"{gait}{self.preset}, {self.amplitude:g} N m on {'+'.join(self.joints)} from "
            f"{self.onset:g} s, rise {1e3 * self.rise:g} ms, xi^ {self.start}, Theta'' {self.theta}"
        )

    @property
    def push(self) -> Push:
        """The push."""
        k = declared()["push"]
        stop = round(self.onset + k["duration"], 9)
        torque = dict.fromkeys(self.joints, self.amplitude)
        return Push(torque, k["step"], self.onset, stop, rise=self.rise)

    def run(self, controller: str, h: float, impacts: int = 1) -> Scenario:
        """From the pushed step on, compiled."""
        return Scenario(
            controller,
            preset=self.preset,
            gait=self.gait,
            pushes=(self.push,),
            first_step=self.push.step,
            impacts=impacts,
            solve_theta=self.theta == "solved",
            reset="measured" if self.start == "zero" and controller == "ADRC" else "model",
            method=method(controller),
            h=h,
            engine=COMPILED,
        )


def method(controller: str) -> str:
    """By which the walks of the claims are integrated."""
    return "feedback" if controller == "ADRC" else "rk4"


def members() -> tuple[Member, ...]:
    """The fraction of the full product that the file declares, always in the same order."""
    factors, fraction = declared()["factors"], declared()["fraction"]
    found = []
    for i, j, k, m in itertools.product(range(3), range(3), range(2), range(2)):
        at = _levels(fraction["three_levels"], i, j, 3) | _levels(fraction["two_levels"], k, m, 2)
        chosen = {name: factors[name][level] for name, level in at.items()}
        found.append(Member(**(chosen | {"joints": tuple(chosen["joints"])})))
    return tuple(found)


def in_all(cases: int) -> int:
    """How many cases are declared where each preset has so many."""
    return cases * len(declared()["factors"]["preset"])


def _levels(rule: dict[str, list[int]], i: int, j: int, count: int) -> dict[str, int]:
    return {name: (a * i + b * j) % count for name, (a, b) in rule.items()}


def convergence() -> tuple[float, float]:
    """Share and round-off by which a number may move when the step is halved."""
    steps = declared()["steps"]
    return float(steps["convergence"]), float(steps["round_off"])
