"""Forces on links and band-limited noise: by Pinocchio's frames, by virtual work, by spectra, and compiled.

zeta(t, step, t_start, q, v) (n,) is the torque of a disturbance on the coordinates at time t [s], in single
support number `step`, which began at t_start [s]. F is a force (12, -7) N with a moment of 3 N m, PULSE a pulse
of it. `OnLink` puts a force with a moment on a point of a link, at (x, z) [m] from the link's origin.
"""

import re
from dataclasses import dataclass, replace

import numpy as np
import pinocchio as pin
import pytest

import biped_adrc as ba
from biped_adrc.control.base import Passive
from biped_adrc.core.errors import InputError
from biped_adrc.core.registry import find
from biped_adrc.disturbances.base import Sum
from biped_adrc.disturbances.force import HipForce, OnLink
from biped_adrc.disturbances.recorded import RecordedTorque
from biped_adrc.disturbances.waves import TorqueNoise
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.program import push_code
from biped_adrc.engine.structure import structure
from biped_adrc.engine.symbols import expression
from biped_adrc.gait.constraint import continued
from biped_adrc.model.ground import StepDown, StepUp, uneven_ground
from biped_adrc.model.pinned import frame_index
from biped_adrc.scenario.build import RobotAndGait, disturbances, window
from biped_adrc.scenario.scenario import Scenario

F = (12.0, -7.0, 3.0)  # [N, N, N m]
PULSE = ba.TorquePulse(F, step=1, start=0.1, stop=0.2)


def single_push(s):
    """The disturbance of a scenario's own push."""
    scene = RobotAndGait.of(s)
    return disturbances(s, scene.biped, scene.walked.period, scene.biped)


def links(biped):
    """Bodies and massless links, without the base."""
    trunk = biped.description.trunk
    for link in biped.tree.links:
        if trunk in [joint.child for joint in biped.tree.path_to_root(link)]:
            yield link


def placement(biped, q, link):
    """Pinocchio's placement of a link from the stance foot, in the URDF's own frame."""
    f = biped.floating
    pin.framesForwardKinematics(f.model, f.data, f.configuration(q))
    return f.data.oMf[frame_index(f.model, link)].copy()


# -- windows ---------------------------------------------------------------------------------------
def test_a_pulse_acts_from_its_start_to_just_before_its_stop_in_its_single_support_alone():
    """Times count from the touchdown that begins the step; a step function goes on in all later steps. A sum of
    two disturbances has the sum of their torques.
    """
    pulse = ba.TorquePulse([1.0, 2.0, 3.0, 4.0, 5.0], step=2, start=0.1, stop=0.2)
    q = np.zeros(5)
    assert not np.any(pulse.zeta(1.05, 2, 1.0, q, q))
    start, stop = pulse.switching_times(2, 1.0)
    assert np.array_equal(pulse.zeta(start, 2, 1.0, q, q), pulse.amplitude)
    assert not np.any(pulse.zeta(stop, 2, 1.0, q, q))
    assert np.any(pulse.zeta(np.nextafter(stop, 0.0), 2, 1.0, q, q))
    assert not np.any(pulse.zeta(1.15, 1, 1.0, q, q))
    stays = ba.TorqueStep([1.0] * 5, step=2, start=0.1)
    for t, step, t_start, acts in [
        (1.1, 2, 1.0, 1),
        (9.0, 7, 8.9, 1),
        (1.05, 2, 1.0, 0),
        (0.3, 1, 0.0, 0),
    ]:
        assert np.array_equal(stays.zeta(t, step, t_start, q, q), acts * stays.amplitude)
    total = pulse + ba.TorqueSine([1.0] * 5, frequency=2.0)
    assert isinstance(total, Sum)
    expected = pulse.zeta(1.15, 2, 1.0, q, q) + total.parts[1].zeta(1.15, 2, 1.0, q, q)
    assert np.array_equal(total.zeta(1.15, 2, 1.0, q, q), expected)


# -- a pulse with sloping edges ---------------------------------------------------------------------


def test_the_edges_of_a_pulse_are_straight_and_its_corners_are_switching_times():
    """rise = 40 ms: it rises linearly from its start at 0.1 s and falls from its stop at 0.2 s, in single
    support 2, which begins at 1 s. Without a rise there are two corners instead of four.
    """
    pulse = ba.TorquePulse(F, step=2, start=0.1, stop=0.2, rise=0.04)
    assert pulse.switching_times(2, 1.0) == pytest.approx([1.1, 1.14, 1.2, 1.24], abs=1e-12)
    assert len(ba.TorquePulse(F, step=2, start=0.1, stop=0.2).switching_times(2, 1.0)) == 2
    still = np.zeros(3)
    for quarter in (0.25, 0.5, 0.75):
        up = pulse.zeta(1.1 + 0.04 * quarter, 2, 1.0, still, still)
        down = pulse.zeta(1.2 + 0.04 * quarter, 2, 1.0, still, still)
        assert up == pytest.approx(quarter * np.array(F), abs=1e-11)
        assert down == pytest.approx((1.0 - quarter) * np.array(F), abs=1e-11)
    for t, level in ((1.0999, 0.0), (1.141, 1.0), (1.1999, 1.0), (1.2401, 0.0)):
        assert pulse.zeta(t, 2, 1.0, still, still) == pytest.approx(level * np.array(F))
    assert not np.any(pulse.zeta(1.15, 3, 1.0, still, still))


# -- a force and a moment on a link ----------------------------------------------------------------
@pytest.mark.parametrize("robot", ["rabbit", "compass"])
def test_the_torque_is_that_of_pinocchios_frame_jacobian(robot):
    """The torque is J' (force, moment), J by Pinocchio, at random points of all links and random angles. In
    Pinocchio's axes y points to the other side, so a positive planar moment is -y there.
    """
    biped = ba.Biped.load(robot)
    f, random, n = biped.floating, np.random.default_rng(3), biped.n
    for link in links(biped):
        at = random.uniform(-0.5, 0.5, 2)
        push = OnLink(biped, link, ba.TorquePulse(F), tuple(at))
        for _ in range(4):
            q, v = random.uniform(-3.0, 3.0, (2, n))
            x, Z = f.configuration(q), f.velocity_map(q)[:, :n]
            J = pin.computeFrameJacobian(
                f.model, f.data, x, frame_index(f.model, link), pin.LOCAL_WORLD_ALIGNED
            )
            arm = placement(biped, q, link).rotation @ np.array([at[0], 0.0, at[1]])
            angular = np.array([0.0, -F[2], 0.0]) + np.cross(arm, [F[0], 0.0, F[1]])
            expected = (J @ Z).T @ np.array([F[0], 0.0, F[1], *angular])
            assert push.zeta(0.0, 1, 0.0, q, v) == pytest.approx(expected, rel=1e-11, abs=1e-11)


@pytest.mark.parametrize("robot", ["rabbit", "compass"])
def test_a_force_is_in_the_balance_with_the_ground_and_a_moment_is_not(robot):
    """F_ground + F = m (p_com'' - g), by differences of Pinocchio's COM along the motion that the push makes: a
    force on a link is in this balance, and a moment is not (F = 0).
    """
    biped = ba.Biped.load(robot)
    random, d, n = np.random.default_rng(6), 1e-4, biped.n
    q, v = random.uniform(-0.5, 0.5, (2, n))
    link = next(links(biped))
    for f in (F, (0.0, 0.0, F[2])):
        push = OnLink(biped, link, ba.TorquePulse(f), (0.0, 0.2))
        walker = ba.Walker(biped, Passive(), push)
        i = walker.instant(0.0, walker.initial_state(q, v), ba.Mode())
        places = (q + s * v + 0.5 * s * s * i.a for s in (-d, 0.0, d))
        coms = [biped.pinned.centre_of_mass(x, v, v)[0] for x in places]
        com = (coms[0] - 2.0 * coms[1] + coms[2]) / d**2
        expected = biped.mass * (com + np.array([0.0, biped.description.gravity])) - f[:2]
        found = walker.ground_reaction(i, ba.Mode())
        assert found == pytest.approx(expected, rel=1e-5, abs=1e-4 * biped.weight)


# -- machine code ----------------------------------------------------------------------------------
@dataclass(frozen=True)
class Gust(ba.Disturbance):
    """A torque on the torso and drag on all coordinates from a single support on, in plain Python."""

    amplitude: float = 5.0
    since: float = 2.0

    def torque(self, t, step, t_start, q, v):
        on_torso = np.array([0.0, 0.0, 0.0, 0.0, 1.0])
        return self.amplitude * on_torso * np.sin(t + q[4]) - 0.1 * v

    def acts(self, t, step, t_start):
        return 1.0 * (step >= self.since)


@dataclass(frozen=True)
class Bump(ba.WindowedTorque):
    """Half a sine wave over [start, stop)."""

    def profile(self, s):
        return np.sin(np.pi * s / (self.stop - self.start))


def test_a_disturbance_in_plain_python_is_compiled(biped, gait):
    """A user's `Gust` and `Bump`: both engines walk alike under them, in machine code and in Python, and
    otherwise than without them.
    """
    # 9 N m on the torso in single support 1, from 0.1 to 0.2 s
    own = Gust() + Bump([0.0, 0.0, 0.0, 0.0, 9.0], 1, 0.1, 0.2)
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), own)
    one, other = (
        ba.walk(walker, gait, 2, ba.RK4(2e-3), engine=engine).trajectory
        for engine in ("compiled", "pinocchio")
    )
    assert one.settings["engine"] == "compiled"
    np.testing.assert_allclose(one.final_state, other.final_state, rtol=0.0, atol=1e-9)
    plain = replace(walker, disturbance=None)
    still = ba.walk(plain, gait, 2, ba.RK4(2e-3)).trajectory.final_state
    assert np.max(np.abs(one.final_state - still)) > 1e-4


@pytest.mark.parametrize(
    "make",
    [
        lambda biped: [
            ba.TorquePulse([1.0] * 5),
            ba.TorquePulse([2.0] * 5, step=3, start=1, stop=2, rise=0.1),
        ],
        lambda biped: [ba.TorqueStep([1.0] * 5), ba.TorqueStep([2.0] * 5, step=3, start=0.1)],
        lambda biped: [
            TorqueNoise([1.0] * 5, bandwidth=10, seed=seed, step=seed) for seed in (1, 2)
        ],
        lambda biped: [HipForce(biped, (-3, 1)), HipForce(biped, (2.0, 0.5), steps=(2, 3))],
        lambda biped: [
            OnLink(biped, "torso", PULSE),
            OnLink(biped, "right_shin", replace(PULSE, step=None), (0.1, 0.2)),
        ],
        lambda biped: RecordedTorque(np.arange(40.0), np.zeros((40, 5))).terms,
    ],
)
def test_disturbances_that_differ_in_numbers_share_one_machine_code(biped, make):
    """Each row makes disturbances of one class with other amplitudes, times, seeds or points of force; one
    address says that they have one code. The last row is the terms of one recording.
    """
    assert len({push_code(term, 5).addresses["push"] for term in make(biped)}) == 1


# -- noise -----------------------------------------------------------------------------------------
def sampled(noise, T, h):
    q = np.zeros(len(noise.amplitude))
    return np.array([noise.zeta(h * k, 1, 0.0, q, q) for k in range(int(T / h))])


def test_noise_has_its_power_evenly_below_its_bandwidth_and_none_above():
    """The noise has a bandwidth of 10 Hz, and is taken over 64 s at 64 samples a second: the rms is the
    amplitude, and the halves below 5 Hz and up to 10 Hz have equal shares. The Hann window smears a line by
    less than 0.1 Hz. Different joints are not correlated.
    """
    noise = TorqueNoise([2.0, 0.5], bandwidth=10.0, seed=7)
    h, T = 1.0 / 64.0, 64.0
    x = sampled(noise, T, h)
    np.testing.assert_allclose(np.sqrt(np.mean(x**2, axis=0)), noise.amplitude, rtol=0.05)
    window = np.hanning(len(x))[:, np.newaxis]
    power = np.abs(np.fft.rfft(x * window, axis=0)) ** 2
    f = np.fft.rfftfreq(len(x), h)
    share = [np.sum(power[(f >= a) & (f < b)], axis=0) for a, b in ((0, 5), (5, 10.1), (10.1, 32))]
    np.testing.assert_allclose(share[0], share[1], rtol=0.3)
    assert np.all(share[2] < 1e-6 * share[0])
    assert abs(np.corrcoef(x.T)[0, 1]) < 0.2


def test_noise_repeats_by_its_seed_only():
    """Seed 1 twice gives the same torques, seed 2 others."""
    q = np.zeros(3)
    kept = [
        TorqueNoise([1.0] * 3, bandwidth=5.0, seed=seed).zeta(0.3, 1, 0.0, q, q)
        for seed in (1, 1, 2)
    ]
    assert np.array_equal(kept[0], kept[1])
    assert not np.any(kept[0] == kept[2])


# -- uneven ground ---------------------------------------------------------------------------------
@pytest.mark.parametrize(
    "ground", [(StepUp(2, 0.01), StepDown(3, 0.01)), uneven_ground(2, 4e-3, 4)]
)
def test_the_foot_strikes_at_the_height_of_the_ground_below_it(bare, published, ground):
    """At each impact the swing foot is as much below the stance foot as the ground falls in that step (`drop`),
    and at no node after the swing's highest point was it below that ground before. `bare` is RABBIT without
    rotor inertia, `published` its gait.
    """
    # a reference that starts at the state after each impact, and goes on past the end of the step
    law = ba.ReferenceReset(ba.NPDController(continued(published.constraint)))
    walker = ba.Walker(bare, law, ground_steps=ground)
    walk = ba.walk(walker, published, 5, ba.RK4(2e-3))
    assert walk.trajectory.status.ok
    # the stance foot is the origin; a step up has a negative drop
    feet = [bare.swing_foot(e.x_minus[:5]) for e in walk.trajectory.events("foot_strike")]
    expected = [-sum(g.drop for g in ground if g.step == step) for step in range(1, 6)]
    np.testing.assert_allclose([z for _, z in feet], expected, rtol=0.0, atol=1e-11)
    assert min(x for x, _ in feet) > 0.2  # each step goes ahead
    heights = walk.signals.foothold_height
    assert np.max(np.abs(heights)) > 3e-3  # the ground was not level
    for arc, event in zip(walk.trajectory.arcs, walk.trajectory.events("foot_strike"), strict=True):
        swing = np.array([bare.swing_foot(x[:5])[1] for x in arc.x])
        below = arc.t[swing < -walker.drop(arc.mode.step) - 1e-9]
        later = below[below > arc.t[np.argmax(swing)]]
        assert len(later) == 0, event.t


def test_uneven_ground_has_heights_of_mean_zero_and_the_rms():
    """There are 400 seeds with 30 steps of 10 mm rms. Limits are more than three standard deviations: 0.09 mm
    of the mean, 3.5 % of an rms of 400, 0.01 of the correlation.
    """
    drops = np.zeros((400, 30))
    for seed in range(400):
        for g in uneven_ground(seed, 0.01, 30):
            drops[seed, g.step - 1] = g.drop
    heights = -np.cumsum(drops, axis=1)
    assert abs(heights.mean()) < 3e-4
    np.testing.assert_allclose(np.sqrt(np.mean(heights**2, axis=0)), 0.01, rtol=0.15)
    assert abs(np.corrcoef(heights[:, :-1].ravel(), heights[:, 1:].ravel())[0, 1]) < 0.05
    # seed, root mean square [m], number of steps
    assert uneven_ground(1, 0.0, 30) == ()
    assert uneven_ground(3, 0.01, 8) == uneven_ground(3, 0.01, 8)


def test_a_sine_is_its_amplitude_after_a_quarter_of_its_period(biped):
    """f = 2 Hz from 0.1 s on: amplitude at 0.225 s, 0 at 0.35 s, minus the amplitude at 0.475 s."""
    amplitude, rest = np.array([3.0, 0.0, 0.0, 0.0, 0.0]), np.zeros(5)
    push = {
        "shape": "sine",
        "joints": "q1",
        "torque": 3.0,
        "frequency": 2.0,
        "onset": 0.1,
        "step": 1,
    }
    # in single support 4, from 0.1 to 0.9 s, of 2 Hz
    made = ba.TorqueSine(amplitude, 4, 0.1, 0.9, 2.0), single_push(Scenario(pushes=[push]))
    for one, (step, begin) in zip(made, ((4, 0.0), (1, 0.0)), strict=True):
        # share: of the amplitude; 1e-12 s before 0.35 s the sine is 0 to 1e-9 as well
        for s, share in ((0.1, 0.0), (0.225, 1.0), (0.35 - 1e-12, 0.0), (0.475, -1.0)):
            zeta = one.zeta(begin + s, step, begin, rest, rest)
            if s <= one.stop:  # the scenario's push ends at 0.3 s, after the usual 0.2 s
                np.testing.assert_allclose(zeta, share * amplitude, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("kind", ["sine", "noise"])
def test_a_push_that_goes_on_over_impacts_begins_with_its_single_support(gait, kind):
    """A push in step 4 of a walk whose first step is number 2 begins 0.1 s into the third step, after two
    periods of the gait if it counts from the start of the walk (`over_steps`), and lasts 0.2 s by default.
    """
    s = Scenario(
        pushes=[{"shape": kind, "torque": 3.0, "joints": "q1", "onset": 0.1, "step": 4}],
        run={"first_step": 2},
    )
    when = window(s, 0, gait.period)
    begin = 2.0 * gait.period if find("disturbance", kind).over_steps else 0.0
    assert (when["start"], when["stop"]) == pytest.approx((begin + 0.1, begin + 0.3))


def test_a_torque_for_another_robot_is_refused_before_it_acts(biped, gait):
    """Two torques for five coordinates are refused, also as part of a sum, though they would act from step 9
    on.
    """
    late = ba.TorqueStep([1.0, 2.0], step=9)
    for disturbance in (late, ba.TorqueStep(np.ones(5)) + late):
        with pytest.raises(InputError, match="2 amplitudes, expected 5"):
            ba.Walker(biped, ba.NPDController(gait.constraint), disturbance)


@pytest.mark.parametrize(
    "make",
    [
        lambda biped: ba.TorquePulse([np.nan] * 5),
        lambda biped: ba.TorquePulse([1.0] * 5, start=0.3, stop=0.1),
        lambda biped: ba.TorquePulse([1.0] * 5, step=0),
        lambda biped: ba.TorquePulse(F, rise=-0.01),
        lambda biped: ba.TorqueSine([1.0] * 5, frequency=-1.0),
        lambda biped: OnLink(biped, "arm", PULSE),
        lambda biped: OnLink(biped, "torso", ba.TorquePulse([1.0] * 5)),
        lambda biped: OnLink(biped, "torso", PULSE, (np.nan, 0.0)),
        lambda biped: TorqueNoise([1.0, 2.0], bandwidth=0.0, seed=1),
        lambda biped: TorqueNoise([1.0, 2.0], bandwidth=1.0, seed=1.5),
        lambda biped: StepUp(1, -0.01),
        lambda biped: StepDown(0, 0.01),
    ],
)
def test_wrong_values_of_disturbances_are_refused(biped, make):
    """Refused are in turn: NaN; an end before the start; step 0, as they count from 1; a negative rise and
    frequency; no such link; a wave of five numbers for a force of three; a place of NaN; no bandwidth; a seed
    that is no whole number; a negative height; step 0.
    """
    with pytest.raises(ba.BipedError):
        make(biped)


def test_a_sum_has_the_torques_and_the_forces_of_its_parts(biped):
    """A recorded torque that rises by 10 N m in 1 s, and a force (3, 4) N on the torso until 0.6 s: at 0.7 s 7
    N m are left alone. The resultant is the force from outside.
    """
    q, v = np.full(5, 0.1), np.full(5, 0.2)
    record = RecordedTorque([0.0, 1.0], np.array([[0.0] * 5, [10.0] * 5]), 1)
    whole = record + OnLink(biped, "torso", ba.TorquePulse([3.0, 4.0, 0.0], stop=0.6))
    at, late = (0.5, 1, 0.0), (0.7, 1, 0.0)
    assert whole.resultant(*at).tolist() == [3.0, 4.0]
    assert whole.resultant(*late).tolist() == [0.0, 0.0]
    assert record.torque(*late, q, v) == pytest.approx([7.0] * 5)
    assert whole.torque(*late, q, v) == pytest.approx([7.0] * 5)
    pushed = whole.torque(*at, q, v) - record.torque(*at, q, v)
    assert pushed == pytest.approx(OnLink.torque(whole.parts[1], *at, q, v))


def test_what_has_no_machine_code_says_why(biped):
    """Each call that makes code raises NotCompiled with the reason, here for a method that machine code does
    not ask, a set, and a text in place of a number.
    """

    @dataclass(frozen=True)
    class Switching(ba.Disturbance):
        def torque(self, t, step, t_start, q, v):
            return np.zeros(5)

        def switching_times(self, step, t_start):
            return (0.1,)

    for text, call, *arguments in (
        ("Switching writes switching_times in place of switches", push_code, Switching(), 5),
        ("a part holds {1}, a set whose content cannot be compared", structure, {1}),
        ("a law gives 'a', expected a real number", expression, "a"),
    ):
        with pytest.raises(NotCompiled, match=re.escape(text)):
            call(*arguments)
