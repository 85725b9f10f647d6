"""The meter's forces: against known forces tick by tick, and against the stored nodes of the same walk."""

from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.certificate import depths, forces
from biped_adrc.analysis.quadrature import integral
from biped_adrc.hardware.loads import Loads, Outside
from biped_adrc.hardware.meter import (
    Hit,
    Meter,
    greater,
    reading,
    size,
)

T = 1e-3
ENGINES = ("pinocchio", "compiled")


class Ground:
    """A meter fed with forces that are known: F (x, z) [N] of the ground as a function of time."""

    def __init__(self, biped, gait, slope=0.0, **limits):
        self.meter = Meter(gait.constraint, ba.Limits(**limits))
        self.k = self.meter.sampled(biped, T, slope)
        self.terms = biped.reduction(*gait.start(biped))
        self.g, self.biped = np.zeros(size(4, self.k.window)), biped
        self.v = np.zeros(5)
        self.gait, self.t = gait, 0.0

    def tick(self, momentum, force, step=1, since=1.0, **more):
        given = {
            "impulse": np.zeros(2),
            "foot": np.array([0.0, 0.05]),
            "drop": 0.0,
            "u": np.zeros(4),
        }
        given |= more
        outside = Outside(np.zeros(2), given["impulse"], given["drop"])
        loads = Loads(momentum, force, given["foot"], outside)
        q, u = np.zeros(5), given["u"]
        told = (np.zeros(5), self.terms, self.t, step, since, loads)
        self.g = self.k.measure(self.g, q, self.v, u, u, *told)
        assert len(self.g) == size(4, self.k.window)

    def walk(self, F, ticks, pushed=None, step=1):
        """Ticks under the ground force F(t), and from outside `pushed`(t); both are linear in each period."""
        p, gravity = np.array([10.0, -3.0]), self.biped.weight * np.array([0.0, 1.0])
        outside = (lambda t: np.zeros(2)) if pushed is None else pushed
        for k in range(ticks):
            t, impulse = k * T, np.zeros(2)
            if k > 0:
                impulse = 0.5 * T * (outside(t) + outside(t - T))
                p = p + 0.5 * T * (F(t) + F(t - T)) + impulse - T * gravity
            self.t, self.p = t, p
            self.tick(p, F(t), step, impulse=impulse)

    def hit(self, t, F=None, step=1, impulse=(0.0, 1.0)):
        """An impact at t [s], up to which the ground gives the force F (2,) since the last tick."""
        F, gravity = np.zeros(2) if F is None else F, self.biped.weight * np.array([0.0, 1.0])
        p = self.p + (t - self.t) * (F - gravity)
        swap = np.array([1, 0, 3, 2])
        made = Hit(t, step, p, np.array(impulse))
        self.g = self.k.impact(self.g, np.zeros(4), np.zeros(4), swap, made)
        assert len(self.g) == size(4, self.k.window)

    @property
    def reading(self):
        return reading(self.g)


def test_the_mean_force_is_that_of_the_last_ticks(biped, gait):
    ground = Ground(biped, gait)

    def F(t):
        return np.array([50.0 * np.sin(40.0 * t), 300.0 + 100.0 * np.cos(60.0 * t)])

    def pushed(t):
        return np.array([200.0 * np.sin(90.0 * t), -500.0 * t])

    ground.walk(F, 40, pushed)
    at = np.array([F(k * T) for k in range(40)])
    mean = [np.mean(0.5 * (at[k - 5 : k] + at[k - 4 : k + 1]), axis=0) for k in range(5, 40)]
    mean = np.array(mean)
    g = ground.reading
    assert g.windows == 35
    assert g.mean_normal_force == pytest.approx(np.min(mean[:, 1]), rel=1e-9)
    assert g.mean_friction == pytest.approx(np.max(np.abs(mean[:, 0]) / mean[:, 1]), rel=1e-9)
    assert g.least_normal_force == np.min(at[:, 1])
    assert g.friction == pytest.approx(np.max(np.abs(at[:, 0]) / at[:, 1]))
    assert (g.outside, g.illegal_step) == (0.0, 0.0)


@pytest.mark.parametrize(("length", "step"), [(1, 0.0), (9, 3.0)])
def test_a_short_dip_is_legal_and_a_long_one_names_its_step(biped, gait, length, step):
    ground = Ground(biped, gait)

    def F(t):
        return np.array([0.0, -100.0 if 0.0095 < t < 0.0095 + length * T else 300.0])

    ground.walk(F, 40, step=3)
    ground.walk(lambda t: np.array([0.0, -100.0]), 10, step=4)  # later ones change nothing
    first = ground.reading.illegal_step
    assert first == (step or 4.0)
    assert ground.reading.outside == length + 10


def test_friction_on_both_sides_and_along_a_slope(biped, gait):
    for slope in (0.0, 0.2):
        for sign in (-1.0, 1.0):
            ground = Ground(biped, gait, slope)
            along, across = ground.k.along, ground.k.across
            ground.walk(lambda t, F=sign * 70.0 * along + 100.0 * across: F, 12)
            g = ground.reading
            assert (g.friction, g.mean_friction) == pytest.approx((0.7, 0.7))
            assert (g.outside, g.illegal_step) == (12, 1.0)
            ground = Ground(biped, gait, slope, friction=0.8)
            ground.walk(lambda t, F=sign * 70.0 * along + 100.0 * across: F, 12)
            assert ground.reading.illegal_step == 0.0


def test_no_window_reaches_over_an_impact(biped, gait):
    ground = Ground(biped, gait)
    for _ in range(3):
        ground.walk(lambda t: np.array([0.0, 300.0]), 5)
        ground.hit(4 * T, impulse=(-3.0, 10.0))
    g = ground.reading
    assert (g.windows, g.illegal_step) == (3.0, 0.0)  # of each single support as a whole
    assert g.mean_normal_force == pytest.approx(300.0)
    assert g.impulse_ratio == pytest.approx(0.3)


@pytest.mark.parametrize("since", [0.3, 0.7])
@pytest.mark.parametrize("ticks", [3, 9])
def test_the_last_window_ends_at_the_impact(biped, gait, ticks, since):
    """300 N up to the last tick, none after it: over five periods, or all there are."""
    ground = Ground(biped, gait)
    ground.walk(lambda t: np.array([0.0, 300.0]), ticks, step=7)
    end = (ticks - 1 + since) * T
    ground.hit(end, np.array([90.0, 0.0]), step=7)
    periods = min(ticks - 1, 5 - since if ticks > 5 else 4)
    mean = np.array([90.0 * since, 300.0 * periods]) / (periods + since)
    g = ground.reading
    assert g.mean_normal_force == pytest.approx(mean[1])
    assert g.mean_friction == pytest.approx(mean[0] / mean[1])
    assert g.windows == max(ticks - 5, 0) + 1
    ground = Ground(biped, gait)
    ground.walk(lambda t: np.array([0.0, 300.0]), ticks, step=7)
    ground.hit(end, np.array([0.0, -1e4]), step=7)
    assert ground.reading.illegal_step == 7.0


def test_a_force_on_the_cone_is_inside(biped, gait):
    ground = Ground(biped, gait, friction=0.6)
    ground.walk(lambda t: np.array([0.6 * 300.0, 300.0]), 20)
    assert (ground.reading.outside, ground.reading.illegal_step) == (0.0, 0.0)
    ground.walk(lambda t: np.array([0.60001 * 300.0, 300.0]), 20)
    assert ground.reading.illegal_step == 1.0


def test_scuffing_and_torque_are_seen(biped, gait):
    F, p = np.array([0.0, 300.0]), np.zeros(2)
    deep = np.array([-0.1, -0.004])
    for more, depth, step in (
        ({"foot": deep}, 0.004, 2.0),
        ({"foot": deep, "since": 0.011}, 0.0, 0.0),
        ({"foot": deep, "drop": 0.005}, 0.0, 0.0),
        ({"foot": deep, "drop": -0.005}, 0.004, 2.0),
    ):
        ground = Ground(biped, gait)
        ground.tick(p, F, 2, **more)
        assert ground.reading.scuffing == 0.0  # it comes from lower ground
        ground.tick(p, F, 2)
        ground.tick(p, F, 2, **more)
        assert ground.reading.scuffing == pytest.approx(depth)
        assert ground.reading.illegal_step == step
    for torque, step in ((150.0, 0.0), (-151.0, 2.0)):
        ground = Ground(biped, gait)
        ground.tick(p, F, 2, u=np.array([0.0, torque, 0.0, 0.0]))
        assert ground.reading.illegal_step == step
    downhill = Ground(biped, gait, slope=0.1)
    downhill.tick(p, F, 2)
    downhill.tick(p, F, 2, foot=np.array([0.3, -0.3 * np.tan(0.1) - 0.002]))
    assert downhill.reading.scuffing == pytest.approx(0.002)


def walker_of(biped, gait, disturbance, **more):
    heavier = biped.with_errors(mass={"torso": 1.1})
    return ba.Walker(
        heavier,
        ba.NPDController(gait.constraint),
        disturbance,
        ba.SampledTime(T),
        model=biped,
        meter=Meter(gait.constraint),
        **more,
    )


def pushes(biped):
    """Edges between ticks and at them, on joints and on links, of forces that go with time."""
    trunk = biped.description.trunk
    pulse = ba.TorquePulse([-80.0, 40.0, 5.0], step=2, start=0.1004, stop=0.2)
    sine = ba.TorqueSine([60.0, -30.0, 0.0], None, 0.2, 0.9, 9.0)
    joints = ba.TorquePulse([20.0, -20.0, 20.0, 0.0, 0.0], step=1, start=0.1, stop=0.2003)
    hip = ba.HipForce(biped, (-10.0, 5.0), steps=(3, 3))
    return ba.OnLink(biped, trunk, pulse) + ba.OnLink(biped, trunk, sine) + joints + hip


@pytest.mark.parametrize("engine", ENGINES)
def test_the_meter_reads_what_the_stored_nodes_show(biped, gait, engine):
    """Of the same sampled walk: at the ticks and over windows between them exactly, and against certificates,
    which look at every instant, within what the force changes in a period."""
    walker = walker_of(biped, gait, pushes(biped), slope=0.01)
    walk = ba.walk(walker, gait, impacts=3, method=ba.RK4(0.25 * T), engine=engine)
    g = reading(walker.held_at(walk.trajectory.final_state).g)
    least, friction, instants, ratios, outside = [], [], [], [], 0
    for c in walk.certificates:
        s = walk.signals.of_step(c.step)
        t, F = s.t, forces(walker, s)
        ticks = t[0] + T * np.arange(int((t[-1] - t[0]) / T) + 1)
        whole = integral(t, F, ticks)
        means = (whole[5:] - whole[:-5]) / (5.0 * T)
        means = np.vstack((means, last_mean(walker, c.step, t, ticks, F)))
        least.append(np.min(means[:, 1]))
        friction.append(np.max(np.abs(means[:, 0]) / means[:, 1]))
        after = np.append(np.diff(t) > 0.0, False) & np.isin(
            np.round((t - t[0]) / T, 6), np.arange(len(ticks))
        )
        instants.append(np.min(F[after, 1]))
        pushes_up = F[after & (F[:, 1] > 0.0)]
        ratios.append(np.max(np.abs(pushes_up[:, 0]) / pushes_up[:, 1]))
        outside += np.sum(np.abs(F[after, 0]) > 0.6 * F[after, 1])
        # the mean changes by at most the range of the force in a window's share of a period
        slack = T / 5e-3 * np.ptp(F, axis=0) + 1e-6
        assert c.mean_normal_force <= least[-1] + 1e-3
        assert least[-1] <= c.mean_normal_force + slack[1]
        # in the last window P is linear over a period, and the force from outside held after the last tick
        assert friction[-1] <= c.mean_friction + 1e-3
        assert c.mean_friction <= friction[-1] + (slack[0] + slack[1]) / c.mean_normal_force
    assert g.mean_normal_force == pytest.approx(min(least), rel=1e-4)
    assert g.mean_friction == pytest.approx(max(friction), rel=1e-4)
    assert g.least_normal_force == pytest.approx(min(instants), rel=1e-9)
    assert g.friction == pytest.approx(max(ratios), rel=1e-9)
    assert g.outside == outside
    assert g.impulse_ratio == pytest.approx(
        max(c.impulse_ratio for c in walk.certificates), rel=1e-9
    )
    assert g.illegal_step == next((c.step for c in walk.certificates if c.illegal()), 0)


def last_mean(walker, step, t, ticks, F):
    """The mean up to the impact as the meter takes it: the force from outside is held since the last tick."""
    length, since = 5.0 * T, t[-1] - ticks[-1]
    before, after, end = integral(t, F, np.array([ticks[-6], ticks[-5], t[-1]]))
    whole = before + since / T * (after - before), end
    push = walker.disturbance
    held = since * push.net_force(ticks[-1], step, t[0])
    given = push.impulse(ticks[-1], t[-1], step, t[0])
    return (whole[1] - whole[0] + given - held) / length


def test_the_plant_is_judged_and_not_the_model(biped, gait):
    """Half the mass on the ground is half the force, whatever the controller believes."""
    walker = walker_of(biped, gait, None)
    light = replace(walker, plant=biped.with_errors(mass={"torso": 0.5}))
    found = [
        reading(w.held_at(ba.walk(w, gait, 1, engine="compiled").trajectory.final_state).g)
        for w in (walker, light)
    ]
    lighter = walker.plant.weight - light.plant.weight
    assert found[0].mean_normal_force - found[1].mean_normal_force > 0.5 * lighter


def test_steps_shorter_than_the_window_are_judged_as_a_whole(biped, gait):
    """By the change of momentum over a step of the gait, T F = m (v-) - m (v+) + T m g e_z."""
    q, v = gait.start(biped)
    change = biped.momentum(gait.q_minus, gait.v_minus) - biped.momentum(q, v)
    F = change / gait.period + biped.weight * np.array([0.0, 1.0])
    needed = abs(F[0]) / F[1]
    for share, step in ((1.02, 0.0), (0.98, 1.0)):
        limits = ba.Limits(friction=share * needed, window=2.0 * gait.period)
        walker = ba.Walker(
            biped,
            ba.NPDController(gait.constraint),
            timing=ba.SampledTime(2.0 * T),
            meter=Meter(gait.constraint, limits),
        )
        run = ba.walk(walker, gait, impacts=3, engine="compiled").trajectory
        g = reading(walker.held_at(run.final_state).g)
        assert (g.windows, g.illegal_step) == (3.0, step)
        assert g.mean_normal_force == pytest.approx(F[1], rel=1e-3)
        assert g.mean_friction == pytest.approx(needed, rel=1e-2)


def test_a_foot_that_comes_from_lower_ground_does_not_scuff(biped, gait):
    """After a step up the old foothold lies below both of the next single support."""
    up = ba.Walker(
        biped,
        ba.NPDController(ba.continued(gait.constraint)),
        timing=ba.SampledTime(T),
        meter=Meter(gait.constraint),
        ground_steps=(ba.StepUp(1, 0.01),),
    )
    walk = ba.walk(up, gait, 2, ba.RK4(T), engine="compiled")
    assert [c.scuffing for c in walk.certificates] == [0.0, 0.0]
    assert reading(up.held_at(walk.trajectory.final_state).g).scuffing == 0.0
    s = walk.signals.of_step(2)
    deep = s.swing_foot[:, 1].copy()
    assert np.min(deep[s.t - s.t[0] > 0.013]) < 0.0  # it is below, and rises
    middle = np.abs(s.t - s.t[0] - 0.2) < 0.01
    deep[middle] = -0.002
    dipped = replace(s, swing_foot=np.column_stack((s.swing_foot[:, 0], deep)))
    assert np.max(depths(up, dipped, True)) == pytest.approx(0.002)


@pytest.mark.parametrize(("a", "b"), [(1.0, np.nan), (np.nan, 1.0), (np.nan, np.nan)])
def test_a_peak_that_is_no_number_stays_none(a, b):
    assert np.isnan(greater(a, b))
    assert np.isnan(greater(greater(1.0, a), greater(b, 2.0)))
