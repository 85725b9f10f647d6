"""biped_adrc: rigid-body dynamics and control research on underactuated walking.

The names below are imported when they are first used, so that `import biped_adrc` is quick.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from biped_adrc.analysis.return_map import ReturnMap
    from biped_adrc.analysis.stride_gain import stride_response
    from biped_adrc.analysis.to_ss import to_ss
    from biped_adrc.analysis.zero_report import zero_report
    from biped_adrc.arm import ArmSystem
    from biped_adrc.control.adrc import ADRCController
    from biped_adrc.control.base import Controller, ControllerLaws, Measurement
    from biped_adrc.control.finite_time import FiniteTimeController
    from biped_adrc.control.npd import NPDController
    from biped_adrc.control.output_npd import OutputNPDController
    from biped_adrc.control.passive import Passive
    from biped_adrc.control.reference_reset import ReferenceReset
    from biped_adrc.control.stride import StrideGains, StridePI
    from biped_adrc.control.tracking import TABLE_II, Gains
    from biped_adrc.disturbances.base import Disturbance, DisturbanceLaw
    from biped_adrc.disturbances.hip_force import HipForce
    from biped_adrc.disturbances.link import OnLink
    from biped_adrc.disturbances.noise import TorqueNoise
    from biped_adrc.disturbances.pulse import TorquePulse
    from biped_adrc.disturbances.sine import TorqueSine
    from biped_adrc.disturbances.step import TorqueStep
    from biped_adrc.engine.batch import Case, simulate_many
    from biped_adrc.errors import BipedError
    from biped_adrc.gait.constraint import VirtualConstraint, continued
    from biped_adrc.gait.conventions import convention
    from biped_adrc.gait.design.request import StepLimits
    from biped_adrc.gait.exchange.importing import export_gait, import_gait
    from biped_adrc.gait.exchange.record import GaitRecord
    from biped_adrc.gait.gait import Gait, load_gait
    from biped_adrc.gait.outputs import FunctionOutputs, LinearOutputs, Outputs
    from biped_adrc.gait.reference import Reference, TimeReference
    from biped_adrc.gait.zero_dynamics import ZeroDynamics
    from biped_adrc.gait.zero_orbits import ZeroOrbits
    from biped_adrc.ground import StepDown, StepUp, uneven_ground
    from biped_adrc.hardware.motors import Motors
    from biped_adrc.hardware.sensors import Sensors
    from biped_adrc.hybrid.exponential import Exponential
    from biped_adrc.hybrid.integrators import RK4, Adaptive, Stiff
    from biped_adrc.hybrid.simulator import simulate
    from biped_adrc.hybrid.status import Status
    from biped_adrc.hybrid.trajectory import Trajectory
    from biped_adrc.model.arm import Arm
    from biped_adrc.model.biped import Biped
    from biped_adrc.model.errors import ModelErrors
    from biped_adrc.model.limits import Limits
    from biped_adrc.model.own import biped_from_urdf
    from biped_adrc.observers.base import Observer, ResetPolicy
    from biped_adrc.observers.gpi import TABLE_I, GPIObserver
    from biped_adrc.scenario.push import Push
    from biped_adrc.scenario.recording import Walk
    from biped_adrc.scenario.registry import register
    from biped_adrc.scenario.run import passive_walk, walk_scenario
    from biped_adrc.scenario.scenario import Scenario
    from biped_adrc.scenario.stored import load_walk
    from biped_adrc.scenario.walk import walk
    from biped_adrc.studies.cycle_stability import cycle_stability, find_cycle
    from biped_adrc.studies.gait_design import DesignedGait, design_gait
    from biped_adrc.studies.gait_library import GaitLibrary
    from biped_adrc.timing import ContinuousTime, SampledTime
    from biped_adrc.walker import Mode, Walker

__version__ = "0.1.0"

_HOMES = {
    "ADRCController": "control.adrc",
    "Adaptive": "hybrid.integrators",
    "Arm": "model.arm",
    "ArmSystem": "arm",
    "Biped": "model.biped",
    "BipedError": "errors",
    "Case": "engine.batch",
    "ContinuousTime": "timing",
    "Controller": "control.base",
    "ControllerLaws": "control.base",
    "DesignedGait": "studies.gait_design",
    "Disturbance": "disturbances.base",
    "DisturbanceLaw": "disturbances.base",
    "Exponential": "hybrid.exponential",
    "FiniteTimeController": "control.finite_time",
    "FunctionOutputs": "gait.outputs",
    "GPIObserver": "observers.gpi",
    "Gains": "control.tracking",
    "Gait": "gait.gait",
    "GaitLibrary": "studies.gait_library",
    "GaitRecord": "gait.exchange.record",
    "HipForce": "disturbances.hip_force",
    "Limits": "model.limits",
    "LinearOutputs": "gait.outputs",
    "Measurement": "control.base",
    "Mode": "walker",
    "ModelErrors": "model.errors",
    "Motors": "hardware.motors",
    "NPDController": "control.npd",
    "Observer": "observers.base",
    "OnLink": "disturbances.link",
    "OutputNPDController": "control.output_npd",
    "Outputs": "gait.outputs",
    "Passive": "control.passive",
    "Push": "scenario.push",
    "RK4": "hybrid.integrators",
    "Reference": "gait.reference",
    "ReferenceReset": "control.reference_reset",
    "ResetPolicy": "observers.base",
    "ReturnMap": "analysis.return_map",
    "SampledTime": "timing",
    "Scenario": "scenario.scenario",
    "Sensors": "hardware.sensors",
    "Status": "hybrid.status",
    "StepDown": "ground",
    "StepLimits": "gait.design.request",
    "StepUp": "ground",
    "Stiff": "hybrid.integrators",
    "StrideGains": "control.stride",
    "StridePI": "control.stride",
    "TABLE_I": "observers.gpi",
    "TABLE_II": "control.tracking",
    "TimeReference": "gait.reference",
    "TorqueNoise": "disturbances.noise",
    "TorquePulse": "disturbances.pulse",
    "TorqueSine": "disturbances.sine",
    "TorqueStep": "disturbances.step",
    "Trajectory": "hybrid.trajectory",
    "VirtualConstraint": "gait.constraint",
    "Walk": "scenario.recording",
    "Walker": "walker",
    "ZeroDynamics": "gait.zero_dynamics",
    "ZeroOrbits": "gait.zero_orbits",
    "biped_from_urdf": "model.own",
    "continued": "gait.constraint",
    "convention": "gait.conventions",
    "cycle_stability": "studies.cycle_stability",
    "design_gait": "studies.gait_design",
    "export_gait": "gait.exchange.importing",
    "find_cycle": "studies.cycle_stability",
    "import_gait": "gait.exchange.importing",
    "load_gait": "gait.gait",
    "load_walk": "scenario.stored",
    "passive_walk": "scenario.run",
    "register": "scenario.registry",
    "simulate": "hybrid.simulator",
    "simulate_many": "engine.batch",
    "stride_response": "analysis.stride_gain",
    "to_ss": "analysis.to_ss",
    "uneven_ground": "ground",
    "walk": "scenario.walk",
    "walk_scenario": "scenario.run",
    "zero_report": "analysis.zero_report",
}

__all__ = [
    "RK4",
    "TABLE_I",
    "TABLE_II",
    "ADRCController",
    "Adaptive",
    "Arm",
    "ArmSystem",
    "Biped",
    "BipedError",
    "Case",
    "ContinuousTime",
    "Controller",
    "ControllerLaws",
    "DesignedGait",
    "Disturbance",
    "DisturbanceLaw",
    "Exponential",
    "FiniteTimeController",
    "FunctionOutputs",
    "GPIObserver",
    "Gains",
    "Gait",
    "GaitLibrary",
    "GaitRecord",
    "HipForce",
    "Limits",
    "LinearOutputs",
    "Measurement",
    "Mode",
    "ModelErrors",
    "Motors",
    "NPDController",
    "Observer",
    "OnLink",
    "OutputNPDController",
    "Outputs",
    "Passive",
    "Push",
    "Reference",
    "ReferenceReset",
    "ResetPolicy",
    "ReturnMap",
    "SampledTime",
    "Scenario",
    "Sensors",
    "Status",
    "StepDown",
    "StepLimits",
    "StepUp",
    "Stiff",
    "StrideGains",
    "StridePI",
    "TimeReference",
    "TorqueNoise",
    "TorquePulse",
    "TorqueSine",
    "TorqueStep",
    "Trajectory",
    "VirtualConstraint",
    "Walk",
    "Walker",
    "ZeroDynamics",
    "ZeroOrbits",
    "biped_from_urdf",
    "continued",
    "convention",
    "cycle_stability",
    "design_gait",
    "export_gait",
    "find_cycle",
    "import_gait",
    "load_gait",
    "load_walk",
    "passive_walk",
    "register",
    "simulate",
    "simulate_many",
    "stride_response",
    "to_ss",
    "uneven_ground",
    "walk",
    "walk_scenario",
    "zero_report",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'biped_adrc' has no attribute '{name}'")
    return getattr(import_module(f"biped_adrc.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *_HOMES])
