"""Observer and linear loop as `control.StateSpace` of the package python-control.

For users who want Bode plots, margins or reductions with the tools they know. Three systems; the
GPI observer (17) in its scaled states z_k = x_k / w^(k-1), with inputs y = q_b and the torques u:

    z' = A z + w l (y - z_1) + b kappa u / w,    x1^ = z_1,  x2^ = w z_2,  xi^ = w^2 z_3

Its error (19), e_k = x_k - x_k^, under the total disturbance xi and with a measurement y = q_b + n:

    E' = A_e E + b xi / w - w l n,               e1 = E_1,  e2 = w E_2,  xi^ = -w^2 E_3

and the loop of one joint (20) where the model's kappa is right, with e_q = q_b - q_d, as in (21) to
(23):

    e_q'' = -K_d (e_q' - e2) - K_p (e_q - e1) + xi - xi^
    kappa u - q_d'' = -K_d (e_q' - e2) - K_p (e_q - e1) - xi^

l, w and A_e are those of `GPIObserver`; in x itself the matrix of Table I has condition number
3e29. python-control is imported only when a system is made, since it is an extra.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

from biped_adrc.control.adrc import ADRCController
from biped_adrc.errors import InputError
from biped_adrc.observer_design.observer_loop import checked_gpi, joint_gains
from biped_adrc.observers.base import Observer
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.types import Array

if TYPE_CHECKING:
    from control import StateSpace


def to_ss(observer: GPIObserver, kappa: Array | float = 1.0) -> StateSpace:
    """The observer (17) for a constant kappa: a number, or (p, p) for p joints [1/(kg m^2)].

    Inputs y_1..y_p [rad], u_1..u_p [N m]; outputs x1_i [rad], x2_i [rad/s], xi_i [rad/s^2] (estimates); states
    z_k_i, scaled. For one joint the names have no index. Raises InputError, also without python-control.
    """
    k = _checked(observer).order
    matrix = np.atleast_2d(np.asarray(kappa, dtype=float))
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or not np.all(np.isfinite(matrix)):
        raise InputError(
            f"kappa has shape {np.shape(kappa)} and values {kappa}, expected a finite number or a finite "
            "square matrix, one row per joint"
        )
    p = len(matrix)
    input_row = np.zeros((k, 1))
    input_row[1] = 1.0 / observer.scale
    joints = [""] if p == 1 else [f"_{i + 1}" for i in range(p)]
    A, B_y, C = (
        np.asarray(np.kron(part, np.eye(p)), dtype=float)
        for part in (observer.error_system().A, _injection(observer), _estimates(observer))
    )
    return _state_space(
        A,
        np.hstack((B_y, np.kron(input_row, matrix))),
        C,
        states=[f"z_{i + 1}{j}" for i in range(k) for j in joints],
        inputs=[f"{name}{j}" for name in ("y", "u") for j in joints],
        outputs=[f"{name}{j}" for name in ("x1", "x2", "xi") for j in joints],
        name="gpi_observer",
    )


def error_to_ss(observer: GPIObserver) -> StateSpace:
    """The observer's error (19) of one joint.

    Inputs xi [rad/s^2], n [rad] (measurement error); outputs e1 [rad], e2 [rad/s], xi_error = xi - xi^
    [rad/s^2]; states E_k, scaled. Raises InputError when python-control is missing.
    """
    A, B = _error(_checked(observer))
    D = np.zeros((3, 2))
    D[2, 0] = 1.0
    return _state_space(
        A,
        B,
        _estimates(observer),
        D,
        states=_error_names(observer),
        inputs=["xi", "n"],
        outputs=["e1", "e2", "xi_error"],
        name="gpi_error",
    )


def loop_to_ss(controller: ADRCController, joint: int = 0) -> StateSpace:
    """The loop of one joint under (20), with a GPI observer in continuous time and the gains of that joint.

    Inputs xi [rad/s^2], n [rad]; outputs e_q [rad], e1 [rad], v = kappa u - q_d'' [rad/s^2]; states e_q, de_q,
    E_k. Raises InputError for another observer, a joint that has no gains, and when python-control is missing.
    """
    observer = _checked(controller.observer)
    K_p, K_d = joint_gains(controller.gains, joint)
    E_A, E_B = _error(observer)
    k = observer.order
    feedback = np.concatenate(([-K_p, -K_d], np.array([K_p, K_d, 1.0]) @ _estimates(observer)))
    A, B = np.zeros((k + 2, k + 2)), np.zeros((k + 2, 2))
    A[0, 1] = 1.0
    A[1] = feedback
    A[2:, 2:], B[2:] = E_A, E_B
    B[1, 0] = 1.0
    C = np.zeros((3, k + 2))
    C[0, 0] = C[1, 2] = 1.0
    C[2] = feedback
    return _state_space(
        A,
        B,
        C,
        states=["e_q", "de_q", *_error_names(observer)],
        inputs=["xi", "n"],
        outputs=["e_q", "e1", "v"],
        name="adrc_loop",
    )


def _checked(observer: Observer) -> GPIObserver:
    """The observer itself. Raises InputError for another kind."""
    return checked_gpi(observer, "state space")


def _injection(observer: GPIObserver) -> Array:
    """w l (m + 2, 1) of the scaled states."""
    return observer.scale * observer.parameters.gains[:, np.newaxis]


def _estimates(observer: GPIObserver) -> Array:
    """(3, m + 2): position, velocity and disturbance from scaled states; the last row is 0 for m = 0."""
    C = np.zeros((3, observer.order))
    for i in range(min(3, observer.order)):
        C[i, i] = observer.scale**i
    return C


def _error(observer: GPIObserver) -> tuple[Array, Array]:
    """A_e (m + 2, m + 2) and the columns of xi and n (m + 2, 2), in scaled states."""
    B = np.hstack((np.zeros((observer.order, 1)), -_injection(observer)))
    system = observer.error_system()
    B[1, 0] = system.velocity_scale
    return system.A, B


def _error_names(observer: GPIObserver) -> list[str]:
    """Names of the states E_k."""
    return [f"E_{i + 1}" for i in range(observer.order)]


def _state_space(
    A: Array, B: Array, C: Array, D: Array | None = None, **names: object
) -> StateSpace:
    """The system of these matrices and names. Raises InputError when python-control is missing."""
    D = np.zeros((len(C), B.shape[1])) if D is None else D
    try:
        control = import_module("control")
    except ImportError as error:
        raise InputError(
            "a control.StateSpace needs the package python-control, which is not installed; run "
            "pip install 'biped-adrc[control]'"
        ) from error
    return control.ss(A, B, C, D, **names)
