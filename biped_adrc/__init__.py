"""biped_adrc: rigid-body dynamics and control research on underactuated walking.

The names below are imported when they are first used, so that `import biped_adrc` is quick.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from biped_adrc.analysis.return_map import ReturnMap
    from biped_adrc.control.adrc import ADRCController
    from biped_adrc.control.base import Controller, Measurement
    from biped_adrc.control.npd import NPDController
    from biped_adrc.control.passive import Passive
    from biped_adrc.control.tracking import TABLE_II, Gains
    from biped_adrc.disturbances.base import Disturbance
    from biped_adrc.disturbances.pulse import TorquePulse
    from biped_adrc.disturbances.sine import TorqueSine
    from biped_adrc.disturbances.step import TorqueStep
    from biped_adrc.errors import BipedError
    from biped_adrc.gait.constraint import VirtualConstraint
    from biped_adrc.gait.conventions import convention
    from biped_adrc.gait.exchange.importing import export_gait, import_gait
    from biped_adrc.gait.exchange.record import GaitRecord
    from biped_adrc.gait.gait import Gait, load_gait
    from biped_adrc.gait.reference import Reference, TimeReference
    from biped_adrc.gait.zero_dynamics import ZeroDynamics
    from biped_adrc.hybrid.exponential import Exponential
    from biped_adrc.hybrid.integrators import RK4, Adaptive, Stiff
    from biped_adrc.hybrid.simulator import simulate
    from biped_adrc.hybrid.status import Status
    from biped_adrc.hybrid.trajectory import Trajectory
    from biped_adrc.model.biped import Biped
    from biped_adrc.observers.base import Observer, ResetPolicy
    from biped_adrc.observers.gpi import TABLE_I, GPIObserver
    from biped_adrc.studies.runs import load_walk
    from biped_adrc.studies.walk import Walk, walk
    from biped_adrc.walker import ContinuousTime, Mode, SampledTime, Walker

__version__ = "0.1.0"

_HOMES = {
    "ADRCController": "control.adrc",
    "Adaptive": "hybrid.integrators",
    "Biped": "model.biped",
    "BipedError": "errors",
    "ContinuousTime": "walker",
    "Controller": "control.base",
    "Disturbance": "disturbances.base",
    "Exponential": "hybrid.exponential",
    "GPIObserver": "observers.gpi",
    "Gains": "control.tracking",
    "Gait": "gait.gait",
    "GaitRecord": "gait.exchange.record",
    "Measurement": "control.base",
    "Mode": "walker",
    "NPDController": "control.npd",
    "Observer": "observers.base",
    "Passive": "control.passive",
    "RK4": "hybrid.integrators",
    "Reference": "gait.reference",
    "ResetPolicy": "observers.base",
    "ReturnMap": "analysis.return_map",
    "SampledTime": "walker",
    "TABLE_I": "observers.gpi",
    "TABLE_II": "control.tracking",
    "Status": "hybrid.status",
    "Stiff": "hybrid.integrators",
    "TimeReference": "gait.reference",
    "TorquePulse": "disturbances.pulse",
    "TorqueSine": "disturbances.sine",
    "TorqueStep": "disturbances.step",
    "Trajectory": "hybrid.trajectory",
    "VirtualConstraint": "gait.constraint",
    "Walk": "studies.walk",
    "Walker": "walker",
    "ZeroDynamics": "gait.zero_dynamics",
    "convention": "gait.conventions",
    "export_gait": "gait.exchange.importing",
    "import_gait": "gait.exchange.importing",
    "load_gait": "gait.gait",
    "load_walk": "studies.runs",
    "simulate": "hybrid.simulator",
    "walk": "studies.walk",
}

__all__ = [  # noqa: RUF022 -- in the order of _HOMES
    "ADRCController",
    "Adaptive",
    "Biped",
    "BipedError",
    "ContinuousTime",
    "Controller",
    "Disturbance",
    "Exponential",
    "GPIObserver",
    "Gains",
    "Gait",
    "GaitRecord",
    "Measurement",
    "Mode",
    "NPDController",
    "Observer",
    "Passive",
    "RK4",
    "Reference",
    "ResetPolicy",
    "ReturnMap",
    "SampledTime",
    "TABLE_I",
    "TABLE_II",
    "Status",
    "Stiff",
    "TimeReference",
    "TorquePulse",
    "TorqueSine",
    "TorqueStep",
    "Trajectory",
    "VirtualConstraint",
    "Walk",
    "Walker",
    "ZeroDynamics",
    "convention",
    "export_gait",
    "import_gait",
    "load_gait",
    "load_walk",
    "simulate",
    "walk",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'biped_adrc' has no attribute '{name}'")
    return getattr(import_module(f"biped_adrc.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *_HOMES])
