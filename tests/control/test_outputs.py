"""Outputs other than q_b: what y'' = J q'' + drift promises, on RABBIT.

OutputNPDController makes y'' + K_d y' + K_p y = 0 with the outputs y(q) in place of the joint errors.
`absolute_outputs` are the gait's constraint in absolute angles, `foot_and_hip` a user's function: hip height,
swing foot, torso. `torques` are those of controllers at (q, v); `state` is off the orbit.
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

import biped_adrc as ba
from biped_adrc.control.output_npd import OutputNPDController
from biped_adrc.core.errors import GaitError, InputError, NotFiniteError, SingularError
from biped_adrc.gait.outputs import (
    FunctionOutputs,
    LinearOutputs,
    OutputPoint,
    Outputs,
    all_coordinates,
)

from .off_orbit import off_orbit

# stance shank, swing thigh, swing shank, torso: all from the vertical
ABSOLUTE = np.array([[1, 0, 1, 0, 1], [0, 1, 0, 0, 1], [0, 1, 0, 1, 1], [0, 0, 0, 0, 1.0]])
K_P, K_D = 400.0, 30.0
GAINS = ba.Gains(K_P, K_D)


@pytest.fixture
def state(gait, biped):
    """Off the orbit."""
    return off_orbit(gait, biped)


def absolute_outputs(constraint):
    """The gait's own constraint, said in absolute angles: c q = Theta makes q5 a row of the curve."""
    a = constraint.curve.coefficients
    theta = np.linspace(constraint.theta_plus, constraint.theta_minus, a.shape[1])
    q = np.vstack((a, (theta - constraint.phase[:4] @ a) / constraint.phase[4]))
    curve = replace(constraint.curve, coefficients=ABSOLUTE @ q)
    return LinearOutputs(ABSOLUTE, replace(constraint, curve=curve))


def foot_and_hip(biped):
    """Hip height, swing foot from the hip (x, z) [m], torso [rad]; zero near the start of a step."""

    def y(q):
        hip = biped.hip(q)
        foot = biped.swing_foot(q) - hip
        return np.array([hip[1] - 0.75, foot[0] + 0.2, foot[1] + 0.7, q[4] + 0.01])

    return FunctionOutputs(y)


def errors(walker, outputs, q, v, times):
    """y and y' at `times`, simulated, and by y'' + K_d y' + K_p y = 0 in closed form."""
    run = ba.simulate(
        walker, walker.initial_state(q, v), ba.Mode(), ba.Adaptive(1e-10, 1e-10), t_end=times[-1]
    )
    assert run.status is ba.Status.COMPLETED
    first = outputs(0.0, q, v)
    A = np.array([[0.0, 1.0], [-K_P, -K_D]])
    for t in times:
        x = run(t)
        o = outputs(t, x[:5], x[5:])
        yield np.array([o.y, o.dy]), expm(A * t) @ np.array([first.y, first.dy])


@pytest.mark.parametrize("kind", ["absolute", "foot_and_hip"])
def test_outputs_decay_as_the_linear_equation_says(biped, gait, state, kind):
    """y and y' of the simulated robot are those of y'' + K_d y' + K_p y = 0 in closed form (`errors`), at three
    times while they are still larger than 1e-2.
    """
    made = {"absolute": absolute_outputs(gait.constraint), "foot_and_hip": foot_and_hip(biped)}[
        kind
    ]
    walker = ba.Walker(biped, OutputNPDController(made, GAINS))
    for found, expected in errors(walker, made, *state, (0.02, 0.05, 0.1)):
        assert np.max(np.abs(expected)) > 1e-2
        assert found == pytest.approx(expected, abs=1e-7)


def torques(biped, controllers, q, v):
    m = ba.Walker(biped, ba.Passive()).measure(0.0, q, v, ba.Mode())
    return [c.output(np.zeros(0), m) for c in controllers]


def test_outputs_that_are_the_joints_give_the_torque_of_npd(biped, gait, state):
    """y = q_b - h(Theta), said as H0 = [I 0], gives the torque of NPD, with other gains for each joint."""
    gains = ba.Gains([5000.0, 4000.0, 3000.0, 2000.0], [50.0, 60.0, 70.0, 80.0])
    joints = LinearOutputs(np.eye(4, 5), gait.constraint)
    pair = (OutputNPDController(joints, gains), ba.NPDController(gait.constraint, gains))
    u, npd = torques(biped, pair, *state)
    assert np.max(np.abs(npd)) > 10.0
    assert u == pytest.approx(npd, rel=1e-9)


def hip_height(biped, q, v):
    """-(l cos(thigh) + l cos(shank)), its row of J and its drift, by hand."""
    rows = np.array([[1, 0, 0, 0, 1], [1, 0, 1, 0, 1.0]])
    angle, rate = rows @ q, rows @ v
    return -0.4 * np.sum(np.cos(angle)), 0.4 * np.sin(angle) @ rows, 0.4 * np.cos(angle) @ rate**2


def test_derivatives_of_a_function_of_ones_own_are_those_by_hand(biped, state):
    """The function is the height of the hip. Checked are its rate, its Jacobian, and the drift, which is
    quadratic in the rates.
    """
    q, v = state
    y, J, drift = hip_height(biped, q, v)
    made = FunctionOutputs(lambda q: biped.hip(q)[1:])
    o = made(0.0, q, v)
    assert o.y[0] == pytest.approx(y, abs=1e-14)
    assert o.J[0] == pytest.approx(J, abs=1e-11)
    assert o.dy[0] == pytest.approx(J @ v, abs=1e-10)
    assert o.drift[0] == pytest.approx(drift, abs=1e-10 * (v @ v))
    assert made(0.0, q, np.zeros(5)).drift[0] == 0.0


def test_outputs_that_the_motors_cannot_move_apart(biped, gait, state):
    """A straight swing leg cannot push its foot along itself; one output twice; a row of zeros and a constant,
    which nothing moves. In each case J D^-1 B, from torques to y'', is singular.
    """
    q, v = state
    straight = q * [1, 1, 1, 0, 1]  # the swing knee at 0
    same = LinearOutputs(np.eye(4, 5)[[0, 1, 2, 2]], gait.constraint)
    # desired values that are 0: else they would tell the output that is there twice apart
    flat = replace(
        gait.constraint, curve=replace(gait.constraint.curve, coefficients=np.zeros((4, 7)))
    )
    rows = np.vstack((np.eye(3, 5), np.zeros(5)))
    stuck = FunctionOutputs(lambda q: np.append(q[:3], 1.0))
    for y, at in (
        (foot_and_hip(biped), straight),
        (replace(same, desired=flat), q),
        (LinearOutputs(rows, flat), q),
        (stuck, q),
    ):
        with pytest.raises(SingularError, match=r"decoupling matrix J D\^-1 B"):
            torques(biped, [OutputNPDController(y)], at, v)


def test_outputs_that_do_not_fit_are_refused(biped, gait, state):
    """Refused are three outputs for four motors, four with the phase among them, a function that returns one
    number, or three, and one that returns NaN.
    """
    q, v = state
    phase_itself = np.vstack((np.eye(3, 5), gait.constraint.phase))
    for wrong in (
        lambda: LinearOutputs(np.eye(3, 5), gait.constraint),
        lambda: all_coordinates(gait.constraint.curve, phase_itself, phase_itself[-1], (0.0, 1.0)),
        lambda: torques(biped, [OutputNPDController(FunctionOutputs(lambda q: q[0]))], q, v),
        lambda: torques(biped, [OutputNPDController(FunctionOutputs(lambda q: q[:3]))], q, v),
    ):
        with pytest.raises((GaitError, InputError)):
            wrong()
    with pytest.raises(NotFiniteError):
        torques(biped, [OutputNPDController(FunctionOutputs(lambda q: q * np.nan))], q, v)


def test_what_outputs_of_ones_own_return_is_checked_at_every_call(state):
    """The check is not at the first call alone: `Mine` returns numbers before 1 s, and NaN from then on, which
    is refused with the name of the class.
    """

    class Mine(Outputs):
        def __call__(self, t, q, v):
            return OutputPoint(
                q[:4], v[:4] * (1.0 if t < 1.0 else np.nan), np.eye(4, 5), np.zeros(4)
            )

    assert np.array_equal(Mine()(0.0, *state).y, state[0][:4])
    with pytest.raises(NotFiniteError, match="Mine"):
        Mine()(1.0, *state)
