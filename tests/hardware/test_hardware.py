"""Sensors and motors by closed forms, alone and in walks of both engines.

T = 1 ms is the period of the ticks (sample instants). `ticks(sensors, path, count)` are the readings (q^, v^)
of two coordinates, the first with a motor, along a path t -> (q, v); `steady(rate)` is one of a constant rate.
`Sensors` are encoders: with counts per turn, noise, rates from differences and a low-pass; sampled(n, p, T) is
one of n coordinates, the first p with motors. A `Line` holds the torques on their way to the motors: a queue of
those that wait for whole periods, one that waits for the fraction of a period, and u, which acts.
"""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop import semantics
from biped_adrc.core.tree import flatten
from biped_adrc.engine.run import simulate_by
from biped_adrc.hardware.motors import Line, Motors, TorqueLine
from biped_adrc.hardware.sample_hold import motor_torque
from biped_adrc.hardware.sensors import PitchSensor, Sensors

T = 1e-3
RANDOM = np.random.default_rng(11)


def ticks(sensors, path, count, n=2, p=1, period=T):
    """(q^, v^) at each tick along path(t) -> (q, v): the first numbers of the state w of encoders."""
    sampled = sensors.sampled(n, p, period)
    w = sampled.start(*path(0.0))
    seen = []
    for i in range(count):
        w = sampled.sense(w, *path(i * period))
        seen.append(flatten(w)[: 2 * n])
    return np.array(seen)


def steady(rate):
    return lambda t: (np.array([0.3, -0.2]) + rate * t, np.full(2, rate))


def test_a_count_is_never_further_off_than_half_of_one():
    """With 100 counts a turn, readings are whole counts, at most pi / 100 rad off; without counts a reading is
    the angle itself.
    """
    rounded = Sensors(counts=100.0).sampled(3, 3, T).rounded
    y = RANDOM.uniform(-7.0, 7.0, (1000, 3))
    for row in y:
        assert np.max(np.abs(rounded(row) - row)) <= np.pi / 100 * (1 + 1e-12)
        counts = rounded(row) / (2 * np.pi / 100)
        assert np.allclose(counts, np.round(counts), rtol=0.0, atol=1e-9)
    assert np.array_equal(Sensors(None).sampled(3, 3, T).rounded(y[0]), y[0])


def test_differences_of_a_steady_motion_are_its_rate():
    """With counts each difference is off by at most one count per period, and their mean by far less."""
    exact = ticks(Sensors(), steady(2.0), 50)
    assert np.allclose(exact[:, 2:], 2.0, rtol=0.0, atol=1e-10)
    counted = ticks(Sensors(counts=8192.0), steady(2.0), 500)
    step = 2 * np.pi / 8192
    assert np.max(np.abs(counted[:, 2:] - 2.0)) <= step / T
    # differences add up to the last angle less the first one, at most a count off over 499 periods
    assert abs(counted[1:, 2].mean() - 2.0) < step / (400 * T)


def test_the_low_pass_answers_a_step_of_the_rate_with_an_exponential():
    """The joint rests until 0 and then turns at 1 rad/s."""
    tau = 5e-3

    # T / 2: at the first tick, t = 0, the joint still rests

    def path(t):
        return (np.zeros(2), np.zeros(2)) if t <= T / 2 else (np.full(2, t - 0.0), np.ones(2))

    # column 2 of (q1, q2, v1, v2): the rate of the first joint
    rate = ticks(Sensors(filter_time=tau), path, 30)[:, 2]
    assert np.allclose(rate, 1.0 - np.exp(-np.arange(30) * T / tau), rtol=0.0, atol=1e-12)


def test_the_low_pass_of_the_angles_answers_a_step_with_an_exponential():
    """After a step of 1 rad q^ = 1 - exp(-k T / tau) at the k-th tick, in joints with motors alone; rates are
    differences of it.
    """
    T, tau, n = 1e-3, 4e-3, 3
    sensors = ba.Sensors(angle_filter=tau).sampled(n, 2, T)
    w, q = sensors.start(np.zeros(n), np.zeros(n)), np.ones(n)
    before = w.angle
    for k in range(1, 6):
        w = sensors.sense(w, q, np.zeros(n))
        left = np.array([np.exp(-k * T / tau)] * 2 + [0.0])
        assert w.angle == pytest.approx(1.0 - left, rel=1e-12)
        if k > 1:  # the first tick after a start has no difference
            assert w.rate == pytest.approx((w.angle - before) / T, rel=1e-9)
        before = w.angle


def test_noise_has_its_deviation_and_its_seed():
    """Over 4000 ticks deviations are right within 5 %, and correlations of different sensors within four
    deviations of zero.
    """
    sensors = Sensors(noise=1e-3, pitch_noise=2e-3, rate_noise=0.1, velocity="measured", seed=4)
    seen = ticks(sensors, steady(0.0), 4000)
    error = seen - np.concatenate(steady(0.0)(0.0))
    assert np.allclose(error.std(axis=0), [1e-3, 2e-3, 0.1, 0.1], rtol=0.05)
    assert np.max(np.abs(np.corrcoef(error.T) - np.eye(4))) < 0.06
    assert np.array_equal(seen[:400], ticks(sensors, steady(0.0), 400))
    assert not np.array_equal(seen[1], ticks(replace(sensors, seed=5), steady(0.0), 2)[1])


def test_at_impact_differences_start_anew():
    """The angles jump at an impact, since legs exchange their labels: the rate then is what the model expects,
    and the first tick after it takes no difference.
    """
    sensors = Sensors(counts=8192.0).sampled(2, 1, T)
    w = sensors.sense(sensors.start(np.zeros(2), np.ones(2)), np.zeros(2), np.ones(2))
    q, v, expected = np.array([5.0, 6.0]), np.array([-3.0, -4.0]), np.array([-2.5, -4.5])
    w = sensors.impact(w, q, v, expected)
    assert np.array_equal(w.rate, expected)
    after = sensors.sense(w, q, v)
    assert np.array_equal(after.rate, expected)  # nothing of the jump from 0 to 5 rad


def test_a_pitch_sensor_is_off_by_a_bias_and_a_drift_and_sees_nothing_else():
    """The rate is off by the drift d, the angle at the k-th tick by b + k d T; an impact changes the rate
    alone."""
    bias, drift, sensor = 0.02, -0.3, PitchSensor(0.02, -0.3).sampled(3, 2, T)
    q, v, hit = np.random.default_rng(5).normal(size=(3, 3))
    off = np.array([0.0, 0.0, 1.0])
    w = sensor.start(q, v)
    for i in range(4):
        seen = sensor.reading(w, q, v)
        # i = 0: at the start, before the first tick; i = 1: at that tick, k = 0
        assert np.allclose(seen, (q + (bias + max(i - 1, 0) * drift * T) * off, v + drift * off))
        w = sensor.sense(w, q, v)
    last, w = sensor.reading(w, q, v)[0], sensor.impact(w, q + 1.0, hit, v)
    assert np.allclose(sensor.reading(w, q, hit), (last, hit + drift * off))
    after = sensor.reading(sensor.sense(w, q, hit), q, hit)[0]
    assert np.allclose(after, q + (bias + 4 * drift * T) * off)


def line(j, waiting):
    return Line(np.zeros((j, 2)), None, np.zeros(2) if waiting else None, np.zeros(2))


@pytest.mark.parametrize("j", [0, 1, 3])
@pytest.mark.parametrize("f", [0.0, 0.4])
def test_a_torque_acts_when_its_delay_is_over(j, f):
    """A delay of (j + f) periods: torque i acts from tick i + j on, after a fraction f of that period, in which
    the torque before still acts. `mean_command` is the mean over the period.
    """
    k, _ = Motors().sampled(2, (j + f) * T, T)
    at = line(j, int(f > 0))
    asked = RANDOM.normal(size=(10, 2))
    nothing = np.zeros(2)
    for i, u in enumerate(asked):
        at = k.send(at, u)
        acts = asked[i - j] if i >= j else nothing
        before = asked[i - j - 1] if i > j else nothing
        now = at.u if f == 0 else at.waiting
        assert np.array_equal(now, acts)
        mean = acts if f == 0 else f * before + (1 - f) * acts
        assert np.allclose(k.mean_command(at), mean)
        if f > 0:
            assert np.array_equal(at.u, before)
            at = at._replace(u=at.waiting)  # what the loop does f T later


def test_the_rate_limit_follows_what_was_sent_last():
    """2000 N m/s are 2 N m per tick of 1 ms, from the last torque sent, also where a queue delays it."""
    # two motors, no delay; j: how many torques wait
    k, _ = Motors(rate_limit=2000.0).sampled(2, 0.0, T)
    for j in (0, 2):
        at, last = line(j, 0), np.zeros(2)
        for _ in range(20):
            u = k.limit(at, RANDOM.normal(0.0, 30.0, 2))
            assert np.max(np.abs(u - last)) <= 2.0 + 1e-12
            at, last = k.send(at, u), u


class Clocked(ba.Controller):
    """Tells the time: u = t on every joint, in the order 1, 2, 3, 4."""

    def output(self, s, m):
        return m.t * np.arange(1.0, 5.0)


@pytest.mark.parametrize("delay", [0.4e-3, 2.7e-3])
def test_in_a_walk_torques_act_late_by_the_delay(biped, gait, delay):
    """The torque that acts at t is that of the last tick before t - delay, and is zero before the first one.

    `Clocked` sends the time of its tick, times 1 to 4. Instants at which the torque changes (`near`) are left
    out.
    """
    walker = ba.Walker(biped, Clocked(), timing=ba.SampledTime(T, delay=delay))
    q, v = gait.start(biped)
    x0 = walker.initial_state(q, v)
    arc = ba.simulate(walker, x0, ba.Mode(), ba.RK4(0.2e-3), t_end=0.02).arcs[0]
    for t, x in zip(arc.t, arc.x, strict=True):
        u = motor_torque(semantics.parts(walker, x).tail.line)
        since = t - delay
        near = abs(since / T - round(since / T)) < 1e-6
        if since > 0 and not near:
            assert np.allclose(
                u, np.floor(since / T) * T * np.arange(1.0, 5.0), rtol=0.0, atol=1e-12
            )
        elif not near:
            assert not np.any(u)


@pytest.mark.parametrize("tau", [1e-7, 3e-3])
@pytest.mark.parametrize("engine", ["pinocchio", "compiled"])
def test_lag_is_an_exponential_between_ticks(biped, gait, engine, tau):
    """A constant command that acts from 1.5 ms on, through a lag of time constant tau, also one far below the
    integration step of 0.25 ms.
    """
    motors = Motors(lag=tau)

    class Step(ba.Controller):
        def output(self, s, m):
            return np.array([10.0, -20.0, 5.0, 0.0])

    walker = ba.Walker(biped, Step(), timing=ba.SampledTime(T, delay=1.5e-3), motors=motors)
    x0 = walker.initial_state(*gait.start(biped))
    run = simulate_by(engine, walker, x0, ba.Mode(), ba.RK4(0.25e-3), t_end=0.05)
    arc = run.arcs[0]
    late = np.maximum(arc.t - 1.5e-3, 0.0)
    expected = (1.0 - np.exp(-late / tau))[:, None] * [10.0, -20.0, 5.0, 0.0]
    found = np.array([motor_torque(semantics.parts(walker, x).tail.line) for x in arc.x])
    assert np.max(np.abs(found - expected)) < 1e-11


@pytest.mark.parametrize("tau", [2e-4, 2e-5])
def test_a_lag_shorter_than_the_step_walks_as_at_a_quarter_of_it(biped, gait, tau):
    """Time constants tau of a fifth and a fiftieth of the integration step, which is the tick's 1 ms:
    touchdowns within 10 ns and 1e-6 of those with steps of 0.25 ms.
    """
    timing, motors = ba.SampledTime(T, delay=0.4e-3), Motors(lag=tau)
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=timing, motors=motors)
    quarter = ba.walk(walker, gait, impacts=1, method=ba.RK4(T / 4)).trajectory
    for engine in ("compiled", "pinocchio"):
        run = ba.walk(walker, gait, impacts=1, engine=engine).trajectory
        assert run.status is quarter.status is ba.Status.COMPLETED
        for a, b in zip(run.events(), quarter.events(), strict=True):
            assert abs(a.t - b.t) < 1e-8
            assert np.max(np.abs(a.x_minus - b.x_minus)[:10]) < 1e-6


def test_a_lag_that_goes_to_zero_goes_to_no_lag(biped, gait):
    """The end of a walk differs from that without lag in proportion to the time constant."""
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=ba.SampledTime(T))
    ideal = ba.walk(walker, gait, impacts=2).trajectory.final_state[:10]
    off = []
    for tau in (1e-5, 1e-6, 1e-7):
        lagging = replace(walker, motors=Motors(lag=tau))
        end = ba.walk(lagging, gait, impacts=2).trajectory.final_state[:10]
        off.append(np.max(np.abs(end - ideal)))
    assert off[1] / off[0] == pytest.approx(0.1, rel=0.05)
    assert off[2] / off[1] == pytest.approx(0.1, rel=0.05)
    assert off[2] < 1e-5


def test_bad_hardware_is_refused(biped, gait):
    """Less than one count a turn, NaN, an unknown kind of rates; a rate limit of zero, a negative lag, no
    period, a negative delay; sensors in continuous time; an error of the impact with one number in place of
    five.
    """
    npd = ba.NPDController(gait.constraint)
    for make in (
        lambda: Sensors(counts=0.5),
        lambda: Sensors(rate_noise=float("nan")),
        lambda: Sensors(velocity="guess"),
        lambda: Motors(rate_limit=0.0),
        lambda: Motors(lag=-1.0),
        lambda: ba.SampledTime(0.0),
        lambda: ba.SampledTime(1e-3, delay=-1e-3),
        lambda: ba.Walker(biped, npd, sensors=Sensors()),
        lambda: ba.Walker(biped, npd, impact_gain=(0.1,)),
    ):
        with pytest.raises(ba.BipedError):
            make()


@pytest.mark.parametrize(("known", "share"), [(0, 1.0), (1, 0.7)])
def test_an_observer_that_knows_the_delay_is_fed_the_mean_of_what_acts(known, share):
    """A delay of 0.3 T: the torque before acts for 0.3 of the period, the new one for the rest; with an unknown
    delay (known = 0) the observer gets the new one alone.

    law and loop are stand-ins with just the methods that one sample instant (`decided`) calls.
    """
    old, new = np.array([10.0, -4.0]), np.array([2.0, 6.0])
    fed = []
    law = SimpleNamespace(
        correct=lambda s, m: s, output=lambda s, m: new, predict=lambda s, m, u: fed.append(u) or s
    )
    loop = SimpleNamespace(law=law, calls=law, saturate=lambda u: u, bounded=lambda u: u)
    # no rate limit, no lag, and the fraction 0.3 of a period
    motors = TorqueLine(None, 0.0, 0.3)
    k = SimpleNamespace(known=known, motors=motors)
    # queue, torque of lagging motors, waiting torque, torque that acts now
    line = Line(np.zeros((0, 2)), None, np.zeros(2), old)
    _, line = semantics.decided(loop, k, np.zeros(0), None, line)
    np.testing.assert_allclose(fed[0], share * new + (1.0 - share) * old)
    np.testing.assert_array_equal(line.waiting, new)
    np.testing.assert_array_equal(line.u, old)
