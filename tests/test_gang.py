"""The gang of six of a walker's loop against python-control, a simulation, and laws between the six.

S, T, P S, C S, y/r and u/r are responses of a sampled loop cut at the torques; r is a shift of the reference
with its rate. `gang_of` has the specification and the gang of a scenario.
"""

from __future__ import annotations

from dataclasses import replace

import control
import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.loops.frozen_gait import FrozenGait, TickMatrices, linear_twin
from biped_adrc.analysis.loops.gang import GANG_UNITS, Cut, Shifted, cut_at_torques
from biped_adrc.analysis.loops.specification import specification
from biped_adrc.analysis.loops.walker_loop import WalkerLoops, robot_step
from biped_adrc.control.outer_loop import own_reference, tracking
from biped_adrc.core.errors import InputError
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.cycle import gang_of

T, K_P, K_D = 2e-3, 900.0, 60.0


def gang(controller, **values):
    s = ba.Scenario(controller, **values)
    return gang_of(s, RobotAndGait.of(s))[1]


# -- one joint -------------------------------------------------------------------------------------
@pytest.mark.parametrize("m", [0, 1])
def test_one_joint_is_as_python_control_has_it(m):
    """A double integrator under ADRC, a = w - F Z: the loop is connected by python-control from its parts."""
    o = ba.GPIObserver.from_bandwidth(200.0, m).sampled(T)
    k = o.order
    F = np.array([[K_P, K_D / T, T**-2]])[:, :k]
    corrected = np.eye(k) - np.outer(o.L, np.eye(k)[0])
    A = (o.Phi - np.outer(o.Gamma, F)) @ corrected
    y_in = (o.Phi - np.outer(o.Gamma, F)) @ o.L[:, np.newaxis]
    w_in = o.Gamma[:, np.newaxis]
    C, D = -F @ corrected, -F @ o.L[:, np.newaxis]
    # the tick reads (q, q'), of which q counts, and (r, r') by w = K_p r + K_d r'
    read = np.array([[1.0, 0.0]])
    by = np.array([[K_P, K_D]])
    tick = TickMatrices(*(x[np.newaxis] for x in (A, y_in @ read, C, D @ read)))
    shift = TickMatrices(*(x[np.newaxis] for x in (A, w_in @ by, C, by)))
    double = np.array([[[0.0, 1.0], [0.0, 0.0]]]), np.array([[[0.0], [1.0]]])
    w = np.geomspace(1.0, 0.999 * np.pi / T, 200)
    found = Cut(WalkerLoops(tick, *double, T, 0.0, 0.0, 1.0), shift, np.ones((1, 1, 1))).responses(
        w
    )
    K, V = control.ss(A, -y_in, C, -D, T), control.ss(A, w_in, C, 1.0, T)  # u = V w - K y
    P = control.ss([[1.0, T], [0.0, 1.0]], [[0.5 * T**2], [T]], [[1.0, 0.0]], 0.0, T)
    S = control.feedback(control.ss([], [], [], 1.0, T), K * P)
    n, r = 1.0, K_P + 1j * w * K_D
    expected = {
        "S": (S, n),
        "T": (S * K * P, n),
        "P S": (S * P, n),
        "C S": (S * K, -n),
        "y/r": (S * P * V, r),
        "u/r": (S * V, r),
    }
    for name, (system, factor) in expected.items():
        level = system(np.exp(1j * w * T)) * factor
        np.testing.assert_allclose(found[name].ravel(), level, rtol=1e-6, err_msg=name)


# -- a walker --------------------------------------------------------------------------------------
@pytest.mark.parametrize("name", ["PD", "LESO"])
def test_responses_to_the_reference_are_those_of_a_simulation(name):
    """The tick of the walk as it is, with the linearised robot between ticks, while the reference of one joint
    moves as eps sin(w t): output and torque are the columns of y/r and u/r for that joint, in size and phase.

    Sine, cosine and the gait's own slow modes are fitted to the second half.
    """
    joint, w, eps = 1, 60.0, 1e-6
    s = ba.Scenario(name, hardware={"period": T, "delay": 1e-3})
    scene = RobotAndGait.of(s)
    walker = build(s, scene)
    frozen = FrozenGait.of(walker.plant, scene.walked, phases=(0.4,), spread=0.0)
    spec, (at,) = specification(walker, frozen), frozen.points
    found = cut_at_torques(walker, frozen, spec).responses(np.array([w]))

    twin, n, p = linear_twin(walker), walker.plant.n, walker.plant.p
    h, e = own_reference(twin.controller), np.eye(p)[joint]
    Phi, G_1, G_2 = (x[0] for x in robot_step(at.A, at.B, T, 0.5, 0.0))
    x0, mode = twin.initial_state(at.q - 2.0 * T * at.v, at.v, ba.Mode()), ba.Mode()
    layout = twin.layout_of(x0)
    for k in (2.0, 1.0, 0.0):  # as the analysis does: two ticks fill the memory of the sensors
        x0[: 2 * n] = np.concatenate((at.q - k * T * at.v, at.v))
        x0 = twin.tick(at.t - k * T, x0, mode) if k else x0

    def ticked(law, d):
        """The torque that is sent, and x half a period later, when it has begun to act."""
        x = law.tick(at.t, x0 + d, mode)
        return layout.tree(x).tail.line.sent, law._release(at.t, x, mode)

    d, before, us, ys = np.zeros(layout.size), np.zeros(p), [], []
    y, count, (u0, x_after) = np.eye(p, n) - h(at.t, at.q, at.v).H, 600, ticked(twin, 0.0)
    for t in T * np.arange(count):
        r, dr = eps * np.sin(w * t) * e, eps * w * np.cos(w * t) * e
        law = replace(twin, controller=tracking(twin.controller, Shifted(h, r=r, dr=dr)))
        ys.append(y @ d[:n])
        u, x = ticked(law, d)
        us.append(u - u0)
        dx = Phi @ d[: 2 * n] + G_1 @ before + G_2 @ us[-1]
        d, before = np.concatenate((dx, (x - x_after)[2 * n :])), us[-1]
    last = np.arange(count // 2, count) * T
    own = spec.loops.rates[0, 0]
    own = own[(np.abs(own) <= spec.loops.slow) & (own.imag >= 0.0)]
    modes = [f(np.exp(rate * (last - last[0]))) for rate in own for f in (np.real, np.imag)]
    # of a real mode the imaginary part is 0, and a constant is among the rest
    basis = np.array([np.cos(w * last), np.sin(w * last), np.ones_like(last), *modes]).T
    for name_, rows in (("y/r", ys), ("u/r", us)):
        c, s_, *_ = np.linalg.lstsq(basis, np.array(rows)[count // 2 :], rcond=None)[0]
        # the sine is the imaginary part of exp(i w t)
        expected = found[name_][0, 0, :, joint]
        np.testing.assert_allclose(
            (s_ + 1j * c) / eps, expected, rtol=0.0, atol=1e-5 * np.max(np.abs(expected))
        )


def test_s_and_t_add_to_one_and_s_is_that_of_the_margins():
    """|S| + |T| >= 1 everywhere, and the largest S of the margins' grid is found here too."""
    s = ba.Scenario("NPD", hardware="rabbit")
    spec, found = gang_of(s, RobotAndGait.of(s))
    assert np.min(found.responses["S"] + found.responses["T"]) >= 1.0 - 1e-12
    largest = np.max(np.linalg.norm(spec.loops[:, 0].sensitivity(), 2, axis=(-2, -1)))
    assert found.peak("S")[0] == pytest.approx(largest, rel=5e-3)
    # bandwidth: S is below 1 / sqrt 2 up to it
    below = found.frequencies < found.bandwidth
    assert np.all(found.responses["S"][below] < np.sqrt(0.5))
    assert 0 < np.sum(below) < len(below)


def test_an_outer_loop_has_the_gang_of_the_controller_inside():
    """The PI from step to step changes nothing within a step; with Table I the loop is too ill-conditioned."""
    outer = {"name": "stride PI", "inner": "LESO"}
    alone, inside = (gang(law, hardware="rabbit") for law in ("LESO", outer))
    for name in GANG_UNITS:
        np.testing.assert_allclose(inside.responses[name], alone.responses[name], rtol=1e-9)


@pytest.mark.parametrize(
    ("controller", "hardware", "words"),
    [
        ("CLF-QP", "rabbit", "the loop of CLFQPController was asked for, which runs in Python"),
        ("output NPD", "rabbit", "OutputNPDController has no field `reference`"),
        ("NPD", {"period": None}, "the sampled loop of a walker was asked for"),
    ],
)
def test_a_loop_that_is_not_linear_gets_one_sentence(controller, hardware, words):
    """A law in Python, one without a reference of the joints, and continuous time."""
    with pytest.raises(InputError, match=words):
        gang(controller, hardware=hardware)
