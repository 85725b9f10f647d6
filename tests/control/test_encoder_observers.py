"""Observers for encoders: half gains, a cascade, a sine in the model, a bound; by laws that do not define them.

All observe q'' = u + xi(t) from q. `transfer` has what they make of a measurement y = e^(s t), by unit vectors
through `flow` alone: an estimate is exact where that of xi is s^2, since y = xi / s^2 there.
"""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import InputError
from biped_adrc.observers.bounded import BoundedObserver
from biped_adrc.observers.cascade import CascadeObserver
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.observers.half_gain import HalfGainObserver
from biped_adrc.observers.internal_model import InternalModelObserver

W, OMEGA, T, SWAP = 150.0, 8.0, 2e-3, np.array([1, 0, 3, 2])
MADE = {
    "half gain": lambda m: HalfGainObserver.from_bandwidth(W, m),
    "cascade": lambda m: CascadeObserver.from_bandwidth(W, m, levels=3, ratio=1.5),
    "internal model": lambda m: InternalModelObserver.from_bandwidth(W, OMEGA, m),
    "bounded": lambda m: BoundedObserver.from_bandwidth(1e6, W, m),
}
NONE, ONE = np.zeros(1), np.ones(1)


def matrices(observer):
    """A, b and C of z' = A z + b y and (q^, q'^, xi^) = C z, of one joint, column by column."""
    still = observer.initial_state(*np.zeros((3, 1)))
    units = np.eye(still.size).reshape(-1, *still.shape)
    A = np.transpose([observer.flow(z, NONE, NONE).ravel() for z in units])
    C = np.transpose([np.ravel(observer.estimate(z)) for z in units])
    return A, observer.flow(still, ONE, NONE).ravel(), C


def transfer(observer, s):
    """q^, q'^ and xi^ for y = e^(s t)."""
    A, b, C = matrices(observer)
    return C @ np.linalg.solve(s * np.eye(len(A)) - A, b)


def followed(observer, xi, x, ticks=400):
    """The last estimates, and the true ones, of an observer at ticks every T under a random held u and a
    disturbance whose own exact motion is x(t) = (q, q').
    """
    law, random, own = observer.sampled(T), np.random.default_rng(1), np.zeros(2)
    z = law.initial_state(*np.zeros((3, 1)))
    for k in range(ticks + 1):
        q, v = own + x(k * T)
        z, u = law.correct(z, np.array([q])), random.normal()
        found = np.ravel(law.estimate(z))
        z = law.predict(z, np.array([u]))
        own = own + np.array([own[1] * T + u * T * T / 2, u * T])
    return found, np.array([q, v, xi(ticks * T)])


# -- half gains --------------------------------------------------------------------------------
@pytest.mark.parametrize(("m", "gains"), [(0, (1.0, 0.5)), (1, (1.5, 1.5, 0.5))])
def test_half_gains_have_the_polynomial_of_their_closed_form(m, gains):
    """s^2 + w s + w^2 / 2, and s^3 + 1.5 w s^2 + 1.5 w^2 s + 0.5 w^3: gains, poles and error matrix."""
    observer = HalfGainObserver.from_bandwidth(W, m)
    expected = np.array(gains) * W ** np.arange(1, m + 3)
    assert observer.gains == pytest.approx(expected, rel=1e-12)
    A = observer.error_system().A
    for poles in (observer.poles, np.linalg.eigvals(A), np.linalg.eigvals(matrices(observer)[0])):
        assert np.poly(poles)[1:] == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("m", [2, 5])
def test_all_poles_of_half_gains_have_half_the_real_part(m):
    """Re s = -w / 2 for every number of poles: a line across the middle between 0 and -w."""
    A = HalfGainObserver.from_bandwidth(W, m).error_system().A
    assert np.linalg.eigvals(A).real == pytest.approx(np.full(m + 2, -W / 2), rel=1e-9)


@pytest.mark.parametrize("period", [1e-3, 2e-2])
def test_half_gains_at_ticks_are_half_of_the_published_ones(period):
    """1 - b^3, 3 (1 - b)^2 (1 + b) / (2 T), (1 - b)^3 / T^2 with b = e^(-w T), of the current form, halved."""
    b = np.exp(-W * period)
    l_2, l_3 = 1.5 / period * (1 - b) ** 2 * (1 + b), (1 - b) ** 3 / period**2
    found = HalfGainObserver.from_bandwidth(W).sampled(period).L / period ** np.arange(3)
    assert found == pytest.approx(np.array([1 - b**3, l_2, l_3]) / 2, rel=1e-12)


@pytest.mark.parametrize("m", [2, 4])
def test_half_gains_at_ticks_are_refused_where_their_error_grows(m):
    """Poles of (I - L C / 2) Phi, with L of GPI: within the unit circle 1 % below the bound in the message, at
    which all is said, and outside 1 % above it.
    """
    bound = -np.log(2 * np.cos(np.pi / (m + 2)) - 1) / T
    for w in (0.99 * bound, 1.01 * bound):
        whole = GPIObserver.from_bandwidth(w, m).sampled(T)
        half = np.eye(m + 2) - 0.5 * np.outer(whole.L, np.eye(m + 2)[0])
        stable = np.max(np.abs(np.linalg.eigvals(half @ whole.Phi))) < 1.0
        assert stable == (w < bound)
        if stable:
            found = HalfGainObserver.from_bandwidth(w, m).sampled(T).L
            assert found == pytest.approx(whole.L / 2, rel=1e-12)
        else:
            with pytest.raises(InputError, match=rf"below {bound:.4g} rad/s; try m = 1"):
                HalfGainObserver.from_bandwidth(w, m).sampled(T)


# -- cascade -----------------------------------------------------------------------------------
def published(levels, ratio, s):
    """q^, q'^ and xi^ for y = e^(s t) of the cascade as it is printed, with left-overs as states (m = 1)."""
    k = 3 * levels
    A, b = np.zeros((k, k)), np.zeros(k)
    for i in range(levels):
        w, at = W * ratio**i, 3 * i
        gains = np.array([3 * w, 3 * w**2, w**3])
        A[at, at + 1] = A[at + 1, at + 2] = 1.0
        A[at + 1, 2:at:3] += 1.0  # the disturbances of the levels before
        A[at : at + 3, at] -= gains
        if i:
            A[at : at + 3, at - 3] += gains
        else:
            b[:3] = gains
    x = np.linalg.solve(s * np.eye(k) - A, b)
    return np.array([x[-3], x[-2], np.sum(x[2::3])])


@pytest.mark.parametrize("levels", [1, 2, 3])
@pytest.mark.parametrize("s", [3.0j, 200.0j, 5e4j, 40.0 + 90.0j])
def test_the_cascade_has_the_transfer_functions_of_the_printed_one(levels, s):
    """From y to all three estimates; the package has sums of disturbances as states, the paper left-overs."""
    observer = CascadeObserver.from_bandwidth(W, 1, levels, 2.5)
    assert transfer(observer, s) == pytest.approx(published(levels, 2.5, s), rel=1e-9)


@pytest.mark.parametrize("levels", [2, 3])
def test_the_cascade_at_ticks_is_the_printed_one_with_left_overs(levels):
    """Each level with published gains of the current form, told u and the disturbances of the levels before."""
    law, random = (
        CascadeObserver.from_bandwidth(W, 1, levels, 1.5).sampled(T),
        np.random.default_rng(3),
    )
    b = np.exp(-W * T * 1.5 ** np.arange(levels))
    L = np.transpose([1 - b**3, 1.5 / T * (1 - b) ** 2 * (1 + b), (1 - b) ** 3 / T**2])
    Phi, Gamma = np.array([[1, T, T * T / 2], [0, 1, T], [0, 0, 1]]), np.array([T * T / 2, T, 0])
    z, x = law.initial_state(*np.zeros((3, 1))), np.zeros((levels, 3))
    for _ in range(30):
        y, u = random.normal(size=(2, 1))
        z, seen = law.correct(z, y), y[0]
        for i in range(levels):
            x[i] += L[i] * (seen - x[i, 0])
            seen = x[i, 0]
        expected = [x[-1, 0], x[-1, 1], np.sum(x[:, 2])]
        assert np.ravel(law.estimate(z)) == pytest.approx(expected, rel=1e-9, abs=1e-9)
        told = u[0] + np.cumsum(x[:, 2]) - x[:, 2]
        z, x = law.predict(z, u), x @ Phi.T + np.outer(told, Gamma)


@pytest.mark.parametrize("m", [1, 3])
def test_a_cascade_of_one_level_is_the_gpi_observer(m):
    """The same numbers, bit for bit, of flow, ticks, start, estimates and resets."""
    one, gpi = CascadeObserver.from_bandwidth(W, m, 1), GPIObserver.from_bandwidth(W, m)
    random = np.random.default_rng(2)
    z, (y, dy, xi) = random.normal(size=(m + 2, 4)), random.normal(size=(3, 4))
    assert np.array_equal(one.flow(z[np.newaxis], y, xi)[0], gpi.flow(z, y, xi))
    assert np.array_equal(one.initial_state(y, dy, xi)[0], gpi.initial_state(y, dy, xi))
    assert np.array_equal(one.estimate(z[np.newaxis]), gpi.estimate(z))
    for policy in ba.ResetPolicy:
        rest = policy, SWAP, y, dy, xi
        assert np.array_equal(one.reset(z[np.newaxis], *rest)[0], gpi.reset(z, *rest))
    one, gpi = one.sampled(T), gpi.sampled(T)
    assert np.array_equal(one.correct(z[np.newaxis], y)[0], gpi.correct(z, y))
    assert np.array_equal(one.predict(z[np.newaxis], xi)[0], gpi.predict(z, xi))


def test_the_noise_of_a_cascade_is_that_of_its_first_level():
    """|xi^ / y| s -> l_13 = w^3 at high frequencies, as many times less as GPI with the last bandwidth has."""
    s, last = 1e7j, W * 3.0**2
    found = [
        np.abs(transfer(observer, s)[2] * s)
        for observer in (CascadeObserver.from_bandwidth(W, 1, 3), GPIObserver.from_bandwidth(last))
    ]
    assert found == pytest.approx([W**3, last**3], rel=1e-2)


@pytest.mark.parametrize("levels", [2, 3])
def test_a_cascade_at_ticks_has_the_poles_of_its_levels(levels):
    """From tick to tick the error goes by e^(-w_i T), m + 2 times each; equal ones split by a root of eps."""
    law = CascadeObserver.from_bandwidth(W, 1, levels, 2.0).sampled(T)
    still = law.initial_state(*np.zeros((3, 1)))
    units = np.eye(still.size).reshape(-1, *still.shape)
    A = [law.predict(law.correct(z, NONE), NONE).ravel() for z in units]
    expected = np.repeat(np.exp(-W * T * 2.0 ** np.arange(levels)), 3)
    found = np.sort(np.linalg.eigvals(A).real)[::-1]
    assert found == pytest.approx(expected, abs=1e-4)


# -- what each of them follows -----------------------------------------------------------------
@pytest.mark.parametrize("name", MADE)
def test_a_constant_disturbance_leaves_no_error(name):
    """At ticks to round-off, |xi| = 3; in continuous time xi^ / xi -> 1 as s -> 0, by less than 10 s / w."""
    found, true = followed(MADE[name](1), lambda t: 3.0, lambda t: (1.5 * t * t, 3.0 * t))
    assert found == pytest.approx(true, rel=1e-9)
    s = 1e-3 * W
    assert abs(transfer(MADE[name](1), s)[2] / s**2 - 1.0) < 10 * s / W


@pytest.mark.parametrize("name", ["half gain", "cascade", "internal model", "bounded"])
def test_a_ramp_is_followed_with_two_extended_states(name):
    """xi = t at ticks, where the cascade's last level has to know how the disturbance grows in a period."""
    found, true = followed(MADE[name](2), lambda t: t, lambda t: (t**3 / 6, t * t / 2))
    assert found == pytest.approx(true, rel=1e-8)


def sine(omega):
    """xi = 2 + 5 sin(omega t + 0.3) and its motion."""

    def x(t):
        a = omega * t + 0.3
        return t * t - 5.0 / omega**2 * np.sin(a), 2.0 * t - 5.0 / omega * np.cos(a)

    return lambda t: 2.0 + 5.0 * np.sin(omega * t + 0.3), x


@pytest.mark.parametrize("omega", [OMEGA, 60.0, 1200.0])
@pytest.mark.parametrize("m", [0, 1])
def test_a_sine_of_the_known_frequency_leaves_no_error(omega, m):
    """q^, q'^, xi^ = 1, s, s^2 at s = i omega, for omega below and above the bandwidth; GPI with as many states
    misses xi by about (omega / w)^(m + 2) of it.
    """
    s = 1j * omega
    expected = np.array([1.0, s, s * s])
    found = transfer(InternalModelObserver.from_bandwidth(W, omega, m), s)
    assert np.abs(found / expected - 1.0) == pytest.approx(np.zeros(3), abs=1e-10)
    other = transfer(GPIObserver.from_bandwidth(W, m + 2), s)
    assert abs(other[2] / expected[2] - 1.0) > 1e-1 * min(1.0, omega / W) ** (m + 2)


@pytest.mark.parametrize("omega", [OMEGA, 60.0, 1200.0])
def test_at_ticks_too_a_sine_of_the_known_frequency_leaves_no_error(omega):
    """xi = 2 + 5 sin(omega t + 0.3), which is not held between ticks, with omega T up to 2.4; of GPI, with as
    many states, the error is a million times larger.
    """
    xi, x = sine(omega)
    found, true = followed(InternalModelObserver.from_bandwidth(W, omega), xi, x)
    assert found == pytest.approx(true, abs=1e-9)
    found, _ = followed(GPIObserver.from_bandwidth(W, 3), xi, x)
    assert abs(found[2] - true[2]) > 1e-3


@pytest.mark.parametrize("omega", [OMEGA, 400.0])
def test_the_gains_with_a_sine_place_all_poles_at_the_bandwidth(omega):
    """(s + w)^5 of the error matrix; the observer's own flow with y = x1 = 0 has the same one."""
    observer = InternalModelObserver.from_bandwidth(W, omega)
    expected = np.poly(np.full(5, -1.0))
    for A in (observer.error_system().A, matrices(observer)[0]):
        assert np.poly(A / W) == pytest.approx(expected, rel=1e-9)
    law = observer.sampled(T)
    closed = (np.eye(5) - np.outer(law.L, np.eye(5)[0])) @ law.Phi
    assert np.poly(closed) == pytest.approx(np.poly(np.full(5, np.exp(-W * T))), rel=1e-9)


# -- bound -------------------------------------------------------------------------------------
def test_a_bound_changes_the_estimate_alone():
    """xi^ of each joint within +-4; all else, states and estimates, is the inner observer's."""
    inner, given = GPIObserver.from_bandwidth(W), np.full(4, 0.5)
    outer = BoundedObserver(inner, 4.0)
    xi = np.array([0.5, -1.5, 30.0, -40.0])
    for one, other in ((outer, inner), (outer.sampled(T), inner.sampled(T))):
        z = one.initial_state(given, given, xi)
        assert np.array_equal(z, other.initial_state(given, given, xi))
        found = one.estimate(z)
        assert found.disturbance == pytest.approx([0.5, -1.5, 4.0, -4.0], rel=1e-12)
        assert np.array_equal(found[:2], other.estimate(z)[:2])
        assert np.array_equal(one.estimate(z).disturbance[:2], other.estimate(z).disturbance[:2])
        for policy in ba.ResetPolicy:
            rest = z, policy, SWAP, given, given, xi
            assert np.array_equal(one.reset(*rest), other.reset(*rest))
    assert np.array_equal(outer.flow(z, xi, xi), inner.flow(z, xi, xi))
    assert np.array_equal(
        one.predict(one.correct(z, xi), xi), other.predict(other.correct(z, xi), xi)
    )


def test_a_bound_at_the_start_of_a_wrong_observer_keeps_the_peak_away():
    """GPI that starts 1 rad off peaks at about (2 - sqrt 2) (sqrt 2 / 2) e^(sqrt 2 - 2) w^2 = 5200 rad/s^2, of
    xi^ = w^2 (w t - (w t)^2 / 2) e^(-w t); with the bound 50 it is 50, and it goes to zero.
    """
    outer = BoundedObserver.from_bandwidth(50.0, W)
    law, z = outer.sampled(T), outer.sampled(T).initial_state(ONE, NONE, NONE)
    peaks = []
    for _ in range(200):
        z = law.correct(z, NONE)
        peaks.append([law.inner.estimate(z).disturbance[0], law.estimate(z).disturbance[0]])
        z = law.predict(z, NONE)
    inner, bounded = np.max(np.abs(peaks), axis=0)
    assert inner > 5e3
    assert bounded == 50.0
    assert abs(peaks[-1][1]) < 1e-9


# -- by name, and what is refused -------------------------------------------------------------
OWN = {
    "half gain": {},
    "cascade": {"levels": 2, "ratio": 2.0},
    "internal model": {"omega": "8 rad/s"},
    "bounded": {"bound": "500 rad/s^2"},
}


@pytest.mark.parametrize("name", OWN)
def test_a_scenario_walks_with_each_on_encoders(name):
    """Five impacts with RABBIT's sensors and motors, at a bandwidth of 150 rad/s."""
    observer = {"name": name, "bandwidth": W, **OWN[name]}
    scenario = ba.Scenario(
        {"name": "LESO", "observer": observer}, hardware={"profile": "rabbit"}, run={"impacts": 5}
    )
    walk = ba.walk_scenario(scenario)
    assert walk.trajectory.status is ba.Status.COMPLETED
    assert walk.impacts == 5


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: HalfGainObserver.from_bandwidth(-5.0), "bandwidth is -5"),
        (lambda: HalfGainObserver.from_bandwidth(W, 1.5), "order m is 1.5"),
        (lambda: CascadeObserver.from_bandwidth(W, 0), "order m of a cascade is 0"),
        (lambda: CascadeObserver.from_bandwidth(W, levels=0), "number of levels of a cascade is 0"),
        (lambda: CascadeObserver.from_bandwidth(W, ratio=-1.0), "ratio of a cascade"),
        (lambda: CascadeObserver.from_bandwidth(W, levels=9), "a cascade has 27 poles"),
        (lambda: CascadeObserver(()), "levels of a cascade are"),
        (
            lambda: CascadeObserver((3.0,)),
            "a level of a cascade is 3.0 .*, expected a ChainObserver",
        ),
        (
            lambda: CascadeObserver(tuple(GPIObserver.from_bandwidth(W * i) for i in (1, 2))),
            "with one m and one scale",
        ),
        (lambda: InternalModelObserver.from_bandwidth(W, -1.0), "omega of InternalModelObserver"),
        (lambda: InternalModelObserver.from_bandwidth(W, 8.0, -1), "order m is -1"),
        (lambda: InternalModelObserver(1, W, 8.0), "m = 1 extended states"),
        (
            lambda: InternalModelObserver.from_bandwidth(W, 1600.0).sampled(T),
            "1600 rad/s is sampled every 0.002 s, expected less than pi / T = 1571 rad/s",
        ),
        (
            lambda: BoundedObserver.from_bandwidth(0.0, W),
            "bound of BoundedObserver is 0.0, expected a positive",
        ),
        (lambda: BoundedObserver.from_bandwidth([1.0, 2.0], W), "expected a number"),
        (lambda: BoundedObserver(3.0, 5.0), "inner of BoundedObserver is 3.0"),
    ],
)
def test_wrong_values_are_refused_in_one_sentence(call, words):
    """Each names what was found; a sine faster than half of the ticks would look like a slow one."""
    with pytest.raises(InputError, match=words) as found:
        call()
    assert "\n" not in str(found.value)
