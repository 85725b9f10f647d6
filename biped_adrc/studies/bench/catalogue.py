"""The controllers of the bench by name, each made for a gait from a trial's values.

What a trial leaves open is the controller's own default: Table II for the gains, Table I for the observer of
ADRC.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from biped_adrc.control.adrc import ADRCController
from biped_adrc.control.base import Controller
from biped_adrc.control.clf_qp import CLFQPController
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.control.npd import NPDController
from biped_adrc.control.output_adrc import OutputADRCController
from biped_adrc.control.pd_gravity import JointGains, PDGravityController
from biped_adrc.control.tracking import TABLE_II, Gains
from biped_adrc.errors import InputError
from biped_adrc.gait.constraint import VirtualConstraint
from biped_adrc.model.biped import Biped
from biped_adrc.observers.base import ResetPolicy
from biped_adrc.observers.gpi import TABLE_I, GPIObserver
from biped_adrc.observers.momentum import MomentumObserver
from biped_adrc.studies.bench.trial import Trial

LESO_BANDWIDTH = 500.0
"""[rad/s], of the linear extended state observer; walks with encoders at 1 kHz."""
DOB_BANDWIDTH = 200.0
"""[rad/s], of the momentum observer."""

Make = Callable[[Trial, VirtualConstraint, Biped], Controller]


@dataclass(frozen=True)
class Entry:
    """A controller of the bench: what it is in words, and how it is made."""

    words: str
    make: Make


def gains(trial: Trial, default: Gains = TABLE_II) -> Gains:
    """The trial's gains, and the default's where it has none."""
    K_p = default.K_p if trial.K_p is None else trial.K_p
    return Gains(K_p, default.K_d if trial.K_d is None else trial.K_d)


def observer(trial: Trial, bandwidth: float | None, order: int = 1) -> GPIObserver:
    """The trial's observer, or one of this bandwidth [rad/s] and order, or of Table I for None."""
    w = bandwidth if trial.bandwidth is None else trial.bandwidth
    if w is None:
        if trial.order is not None:
            raise InputError(
                f"the trial gives the order m = {trial.order} and no bandwidth; Table I has m = 7. Give a "
                "bandwidth [rad/s] too"
            )
        return GPIObserver.from_poles(TABLE_I)
    return GPIObserver.from_bandwidth(w, order if trial.order is None else trial.order)


def _pd(trial: Trial, h: VirtualConstraint, biped: Biped) -> Controller:
    usual = JointGains()
    K_p = usual.K_p if trial.K_p is None else trial.K_p
    return PDGravityController(h, JointGains(K_p, usual.K_d if trial.K_d is None else trial.K_d))


def _npd(trial: Trial, h: VirtualConstraint, biped: Biped) -> Controller:
    return NPDController(h, gains(trial))


def _adrc(bandwidth: float | None) -> Make:
    def make(trial: Trial, h: VirtualConstraint, biped: Biped) -> Controller:
        policy = ResetPolicy.named(trial.reset)
        return ADRCController(h, observer(trial, bandwidth), gains(trial), reset=policy)

    return make


def _output_adrc(trial: Trial, h: VirtualConstraint, biped: Biped) -> Controller:
    policy = ResetPolicy.named(trial.reset)
    return OutputADRCController(h, observer(trial, None), gains(trial), policy)


def _dob(trial: Trial, h: VirtualConstraint, biped: Biped) -> Controller:
    w = DOB_BANDWIDTH if trial.bandwidth is None else trial.bandwidth
    policy = ResetPolicy.named(trial.reset)
    observer = MomentumObserver.from_bandwidth(w)
    return MomentumDOBController(h, observer, gains(trial), reset=policy)


def _clf_qp(trial: Trial, h: VirtualConstraint, biped: Biped) -> Controller:
    return CLFQPController(h, torque_limit=trial.torque_limit)


CONTROLLERS: dict[str, Entry] = {
    "PD": Entry("PD with gravity compensation; its gains are in N m/rad and N m s/rad", _pd),
    "NPD": Entry("feedback linearisation with PD action (28)", _npd),
    "ADRC": Entry("ADRC (20) with the GPI observer of Table I, m = 7", _adrc(None)),
    "ADRC output": Entry("ADRC of y = q_b - h(Theta), observer of Table I", _output_adrc),
    "LESO": Entry("ADRC with a linear extended state observer, m = 1", _adrc(LESO_BANDWIDTH)),
    "DOB": Entry("NPD with a momentum-based disturbance observer", _dob),
    "CLF-QP": Entry("a control Lyapunov function, torque and friction limits in a QP", _clf_qp),
}
"""By name, in the order of the tables."""


def controller(trial: Trial, h: VirtualConstraint, biped: Biped) -> Controller:
    """The trial's controller. Raises InputError with the names there are."""
    if trial.controller not in CONTROLLERS:
        raise InputError(
            f"controller '{trial.controller}' is unknown; choose one of {list(CONTROLLERS)}"
        )
    return CONTROLLERS[trial.controller].make(trial, h, biped)
