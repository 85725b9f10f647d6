"""The admissible choices: what the paper leaves open, chosen in a file that was written before the runs.

The paper prints no push amplitude, no masses and no start of the observer. A claim tested at one choice could
be an accident of it; tested at choices picked afterwards it would prove nothing. admissible.toml therefore
declares

    factors      preset, amplitude, onset, joints (three levels each), rise, start, Theta'' (two levels each)
    fraction     36 of the 3^4 2^3 = 648 combinations, an orthogonal array of strength 2: any two factors meet
                 in all pairs of levels equally often, so that no effect hides behind another one
    steps        the integration steps, and by how much a number may change when they are halved
    limits       the numbers from which a claim holds

Read by `claims.walks` and `claims.evidence`, which run the choices, and by the rows, for their limits.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any

from biped_adrc.engine.run import COMPILED
from biped_adrc.resources import packaged
from biped_adrc.scenario.push import Push
from biped_adrc.scenario.scenario import Scenario


def declared() -> dict[str, Any]:
    """The tables of admissible.toml."""
    return packaged("biped_adrc.paper.claims", "admissible.toml")


@dataclass(frozen=True)
class Member:
    """One member of the set: a value for everything that the paper leaves open."""

    preset: str
    """Of RABBIT."""
    amplitude: float
    """Of the push [N m]."""
    onset: float
    """Of the push [s] after the impact."""
    joints: tuple[str, ...]
    """On which the push acts."""
    rise: float
    """Time in which the push rises and falls [s]."""
    start: str
    """How the observer starts: "model" (xi^ from the model) or "zero"."""
    theta: str
    """Theta'' in (20): "solved" from the dynamics, or as "printed"."""
    gait: str = "published"
    """"published" (a) or "recipe" (b)."""

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
        """The push, in the step that the file declares."""
        k = declared()["push"]
        return Push(
            joints=",".join(self.joints),
            torque=self.amplitude,
            step=k["step"],
            onset=self.onset,
            duration=k["duration"],
            rise=self.rise,
        )

    def run(self, controller: str, h: float, impacts: int = 1) -> Scenario:
        """The walk from the pushed step on, on the compiled engine; h: integration step [s]."""
        return Scenario(
            {
                "name": controller,
                "solve_theta": self.theta == "solved",
                "observer": {
                    "reset": "measured"
                    if self.start == "zero" and controller == "ADRC"
                    else "model"
                },
            },
            robot={"preset": self.preset},
            gait=self.gait,
            pushes=(self.push,),
            run={
                "first_step": self.push.step,
                "impacts": impacts,
                "method": "rk4",
                "h": h,
                "engine": COMPILED,
            },
        )


def step_of(controller: str, what: str) -> float:
    """The step [s] that is declared for something; under ADRC never longer than that of its pushed step, since
    the observer is stiff.
    """
    steps = declared()["steps"]
    return float(min(steps[what], steps["ADRC"]) if controller == "ADRC" else steps[what])


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
    """How many cases are declared where each preset has this many."""
    return cases * len(declared()["factors"]["preset"])


def _levels(rule: dict[str, list[int]], i: int, j: int, count: int) -> dict[str, int]:
    """Level of each factor at (i, j): a i + b j modulo the number of levels, a rule that balances
    the fraction.
    """
    return {name: (a * i + b * j) % count for name, (a, b) in rule.items()}


def convergence() -> tuple[float, float]:
    """Largest relative and absolute change of a number at half of the step with which it counts as
    converged.
    """
    steps = declared()["steps"]
    return float(steps["convergence"]), float(steps["round_off"])
