"""What passes between a robot and the exported controller in a simulated walk, call by call."""

from functools import cache, cached_property
from typing import NamedTuple

import numpy as np

import biped_adrc as ba
from biped_adrc.extras.export.computer import Computer
from biped_adrc.extras.export.loaded import ExportedController, Loaded
from biped_adrc.extras.export.source import source_of
from biped_adrc.scenario.build import build


class Call(NamedTuple):
    """A call of the C, its measurement, and the torque (p,) [N m] of `step`."""

    kind: str
    t: float
    q: np.ndarray
    v: np.ndarray
    u: np.ndarray | None = None


class Recorder(Loaded):
    """The functions of the C, which keeps the last call of a kind at an instant: at the start it is tried."""

    @cached_property
    def calls(self):
        return {}

    def noted(self, kind, m, u=None):
        call = Call(kind, float(m["t"]), m["q"].copy(), m["v"].astype(float), u)
        self.calls[kind, call.t] = call

    def init(self, m):
        self.noted("init", m)
        return super().init(m)

    def step(self, x, m):
        flag, u = super().step(x, m)
        self.noted("step", m, u)
        return flag, u

    def touchdown(self, x, m):
        self.noted("touchdown", m)
        return super().touchdown(x, m)


PUSH = "q1,q2=20@1:0.1-0.3"
SCENARIOS = {
    "NPD": ba.Scenario("NPD", hardware="ideal", run={"impacts": 2}, pushes=PUSH),
    "on a robot": ba.Scenario(
        {
            "name": "LESO",
            "observer": {"bandwidth": 100.0},
            "contact": {"name": "hold", "window": 0.015},
        },
        hardware={
            "profile": "rabbit",
            "encoders": {"counts": 1e5, "filter_time": 1e-3},
            "delay": 2e-3,
            "delay_known": True,
            "rate_limit": 3e4,
            "touchdown": {"name": "kinematics"},
        },
        pushes=PUSH,
        run={"impacts": 3},
    ),
}


@cache
def recorded(name):
    """The exported controller of a scenario in memory, and its calls in the scenario's walk."""
    scenario = SCENARIOS[name]
    controller = ExportedController(source_of(Computer(build(scenario))))
    vars(controller)["loaded"] = recorder = Recorder(controller.source)
    ba.walk_scenario(scenario, controller=controller)
    return recorder, list(recorder.calls.values())
