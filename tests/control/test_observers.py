"""The GPI observer: its poles, what it estimates exactly, its discrete form, its resets; the Kalman filter.

Both observe q'' = u + xi(t) from q: their states are q, q' and m states for xi and its derivatives.
"""

import numpy as np
import pytest
from scipy.linalg import expm, solve_continuous_are

import biped_adrc as ba
from biped_adrc.core.errors import InputError
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.hybrid.system import HybridSystem
from biped_adrc.observers.gpi import TABLE_I, GPIObserver
from biped_adrc.observers.kalman import KalmanObserver
from biped_adrc.observers.momentum import MomentumObserver

POLES = [(-3.0, -5.0), (-10 + 5j, -10 - 5j, -40.0, -8.0), TABLE_I]


@pytest.mark.parametrize("poles", POLES)
def test_error_matrix_has_the_poles_chosen(poles):
    """The poles are real ones, a complex pair and those of Table I: two more than the order m of the
    disturbance's model.
    """
    observer = GPIObserver.from_poles(poles)
    found = np.sort_complex(np.linalg.eigvals(observer.error_system().A))
    assert np.allclose(found, np.sort_complex(np.array(poles, complex)), rtol=1e-8)
    assert observer.m == len(poles) - 2


def test_table_one_is_what_the_paper_prints():
    """Rounded to whole numbers the nine poles are those printed, and their error matrix is well conditioned.

    The states are scaled by powers of the poles' size: the matrix then has a condition number of 5e6, and
    that of the characteristic polynomial in companion form, with coefficients up to 3e29, one of 3e29.
    """
    printed = [-180, -324, -583, -1050, -1890, -3401, -6122, -11020, -19836]
    assert np.round(TABLE_I) == pytest.approx(printed, abs=0.5)
    observer = GPIObserver.from_poles()
    assert np.linalg.cond(observer.error_system().A) < 1e7


class DoubleIntegrator(HybridSystem):
    """q'' = u + xi(t), observed; u is known."""

    def __init__(self, observer, xi):
        self.observer, self.xi = observer, xi

    def flow(self, t, x, mode):
        u = np.array([np.cos(3 * t)])
        dz = self.observer.flow(x[2:, np.newaxis], x[:1], u)
        return np.concatenate((x[1:2], u + self.xi(t), dz[:, 0]))


@pytest.mark.parametrize("m", [0, 1, 3])
def test_polynomial_disturbances_up_to_degree_m_minus_one_are_found_exactly(m):
    """For xi a polynomial of degree m - 1 no error is left after 3 s, 60 time constants of the poles at -20
    1/s; the start is 0.4 off. m = 0 has no xi.
    """
    observer = GPIObserver.from_bandwidth(20.0, m)
    coefficients = np.array([4.0, -3.0, 2.0][:m])

    def xi(t):
        return float(sum(c * t**k for k, c in enumerate(coefficients)))

    z = observer.initial_state(np.array([0.1]), np.array([0.2]), np.array([0.0]))
    start = np.concatenate(([0.5, -0.3], z[:, 0]))
    run = simulate(DoubleIntegrator(observer, xi), start, None, RK4(1e-3), t_end=3.0)
    x, t = run.final_state, 3.0
    found = observer.estimate(x[2:, np.newaxis])
    assert found.position[0] == pytest.approx(x[0], abs=1e-6)
    assert found.velocity[0] == pytest.approx(x[1], abs=1e-5)
    if m > 0:
        assert found.disturbance[0] == pytest.approx(xi(t), abs=1e-3)


@pytest.mark.parametrize("period", [1e-3, 2e-2])
@pytest.mark.parametrize("poles", [(-10.0, -20.0, -35.0), (-10 + 5j, -10 - 5j, -40.0)])
@pytest.mark.parametrize("kind", [GPIObserver, MomentumObserver])
def test_discrete_form_has_the_poles_exp_sT(kind, poles, period):
    """The error goes from tick to tick by (1 - L C) Phi, C the row (1, 0, ..) of what is measured; its
    eigenvalues are e^(s T) of the continuous poles s.
    """
    k = kind.from_poles(poles).sampled(period)
    closed = (np.eye(len(poles)) - np.outer(k.L, np.eye(len(poles))[0])) @ k.Phi
    expected = np.exp(np.array(poles) * period)
    found = np.linalg.eigvals(closed)
    assert np.allclose(
        np.sort_complex(found), np.sort_complex(expected.astype(complex)), rtol=0.0, atol=1e-7
    )


def test_reset_policies():
    """Each sets the states that it names, of four joints with two states of disturbance each.

    Measured are positions of 100 and velocities of 200; the model's disturbance is 300.
    """
    observer = GPIObserver.from_bandwidth(10.0, 2)
    Z = np.arange(16.0).reshape(4, 4)
    swap = np.array([1, 0, 3, 2])
    y, dy, xi = np.full(4, 100.0), np.full(4, 200.0), np.full(4, 300.0)

    def reset(policy):
        return observer.reset(Z, ba.ResetPolicy(policy), swap, y, dy, xi)

    assert np.array_equal(reset("none"), Z)
    assert np.array_equal(reset("relabel"), Z[:, swap])
    measured = reset("measured")
    assert np.array_equal(measured[2:], Z[2:, swap])
    found = observer.estimate(measured)
    assert found.position == pytest.approx(y)
    assert found.velocity == pytest.approx(dy)
    model = observer.estimate(reset("model"))
    assert model.disturbance == pytest.approx(xi)
    assert not np.any(reset("model")[3])  # xi', which the model does not give


@pytest.mark.parametrize("missing", ["correct", "predict"])
def test_an_observer_that_does_not_correct_and_predict_is_refused_at_a_tick(biped, gait, missing):
    """A user's observer that says it is its own discrete form (`sampled` returns self) but lacks one of the two
    methods; in continuous time it needs neither.
    """

    class Same(GPIObserver):
        def sampled(self, period):
            return self

    other = {"correct": "predict", "predict": "correct"}[missing]
    setattr(Same, other, lambda self, z, *more: z)
    controller = ba.ADRCController(gait.constraint, Same.from_bandwidth(500.0))
    with pytest.raises(InputError, match=f"Same has no method {missing}"):
        ba.Walker(biped, controller, timing=ba.SampledTime(1e-3))
    assert ba.Walker(biped, controller).law is controller


@pytest.mark.parametrize(
    "call",
    [
        lambda: GPIObserver.from_poles((-1.0, 2.0)),
        lambda: GPIObserver.from_poles((-1.0, float("nan"))),
        lambda: GPIObserver.from_poles((-1.0,)),
        lambda: GPIObserver.from_poles((-1.0, -2.0, -3.0), m=2),
        lambda: GPIObserver.from_poles((-1 + 1j, -2.0)),
        lambda: GPIObserver.from_bandwidth(-5.0),
        lambda: GPIObserver.from_bandwidth(500.0, 1.5),
        lambda: GPIObserver.from_poles().sampled(0.0),
        lambda: MomentumObserver.from_poles([-3.0]),
        lambda: MomentumObserver.from_poles([-3.0, 1.0]),
        lambda: MomentumObserver.from_bandwidth(-3.0),
        lambda: MomentumObserver.from_bandwidth(3.0, 1),
        lambda: MomentumObserver.from_bandwidth(3.0).sampled(0.0),
        lambda: MomentumObserver.from_bandwidth(3.0).predict(np.zeros(0), np.zeros(0)),
    ],
)
def test_wrong_values_of_observers_are_refused(call):
    """Refused are an unstable pole; NaN; fewer than two poles; not m + 2; a complex pole without its conjugate;
    a negative bandwidth; m that is no whole number; no period. The momentum observer has two poles or more, and
    in continuous time no `predict`.
    """
    with pytest.raises(InputError):
        call()


# -- the Kalman filter -------------------------------------------------------------------------
def noisy_chain(m):
    """A, W e_k e_k' and C of the chain of the module with m + 2 states, for W = 4."""
    k = m + 2
    return np.eye(k, k=1), 4.0 * np.diag(np.arange(k) == k - 1), np.eye(1, k)


@pytest.mark.parametrize("m", [1, 2])
def test_the_gains_of_the_kalman_filter_solve_the_riccati_equation(m):
    """Gains L = P C' / R by SciPy's solution P. from_noise takes standard deviations, 2 of the drift and 0.1 of
    the measurement: so W = 4 and R = 0.01.
    """
    A, Q, C = noisy_chain(m)
    observer = KalmanObserver.from_noise(2.0, 0.1, m)
    assert (observer.intensity, observer.measurement) == pytest.approx((4.0, 0.01), rel=1e-12)
    P = solve_continuous_are(A.T, C.T, Q, [[0.01]])
    assert observer.gains == pytest.approx(P[:, 0] / 0.01, rel=1e-8)
    assert np.poly(observer.poles) == pytest.approx([1.0, *observer.gains], rel=1e-8)


@pytest.mark.parametrize("m", [1, 2])
def test_a_tick_of_the_kalman_filter_is_where_its_covariance_ends(m):
    """P <- Phi (I - L C) P Phi' + Q_T, L = P C' / (P_11 + R / T), a thousand ticks; Q_T by Van Loan. `correct`
    at an innovation of 1 gives L, `predict` then Phi L; an input of 1 from rest gives (T^2 / 2, T, 0).
    """
    (A, Q, _), T, k = noisy_chain(m), 0.2, m + 2
    both = expm(np.block([[-A, Q], [np.zeros((k, k)), A.T]]) * T)
    Phi, P = both[k:, k:].T, np.eye(k)
    for _ in range(1000):
        L = P[:, 0] / (P[0, 0] + 0.01 / T)
        P = Phi @ (P - np.outer(L, P[0])) @ Phi.T + Phi @ both[:k, k:]
    observer = KalmanObserver.from_noise(2.0, 0.1, m).sampled(T)
    z, one, nothing = observer.initial_state(*np.zeros((3, 1))), np.ones(1), np.zeros(1)
    seen = observer.correct(z, one)
    assert np.ravel(observer.estimate(seen)) == pytest.approx(L[:3], rel=1e-8)
    later = observer.estimate(observer.predict(seen, nothing))
    assert np.ravel(later) == pytest.approx((Phi @ L)[:3], rel=1e-8)
    pushed = observer.estimate(observer.predict(z, one))
    assert np.ravel(pushed) == pytest.approx((T * T / 2, T, 0.0), abs=1e-12)


@pytest.mark.parametrize(("drift", "measurement"), [(-2.0, 0.1), (0.0, 0.1), (2.0, -0.1)])
def test_noises_that_are_not_positive_are_refused(drift, measurement):
    with pytest.raises(InputError, match="positive"):
        KalmanObserver.from_noise(drift, measurement)
