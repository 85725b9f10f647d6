"""How rough a ground a walk bears: the map of y = sigma^2 / 2 and its limits, against walks and other laws."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.rough_ground import CLIPPED, IMPULSE, WAYS, failing_step, rough_ground
from biped_adrc.analysis.stride_map import Path, StrideMap, poses_on
from biped_adrc.core.errors import InputError
from biped_adrc.gait.constraint import continued
from biped_adrc.model.ground import stepped

MIDDLE = 0.5  # share of the reset, and the phase of y


def walker_on(gait, biped, **more):
    """A walker with the reset around NPD, on the continued curve."""
    reset = ba.ReferenceReset(ba.NPDController(continued(gait.constraint)), share=MIDDLE)
    return ba.Walker(biped, reset, **more)


@pytest.fixture(scope="module")
def gaits(biped):
    return {name: ba.load_gait(name, biped) for name in ("v0.5", "v0.6", "v0.8")}


@pytest.fixture(scope="module")
def found(biped, gaits):
    return {name: rough_ground(walker_on(gait, biped), gait) for name, gait in gaits.items()}


def walked(walker, gait, heights):
    """Whether a walk over these heights [m] is feasible."""
    over = replace(walker, ground_steps=stepped(-np.asarray(heights)))
    walk = ba.walk(over, gait, impacts=len(heights))
    return walk.feasibility.outcome == "feasible"


def zetas(biped, walk):
    """sigma^2 / 2 before the impacts of a walk [kg^2 m^4/s^2]."""
    before = walk.trajectory.before("foot_strike")[:, : 2 * biped.n]
    return np.array([0.5 * biped.angular_momentum(*np.split(x, 2)) ** 2 for x in before])


# -- the map ---------------------------------------------------------------------------------------
@pytest.mark.parametrize("h", [-0.02, -0.004, 0.003, 0.015])
def test_the_map_is_a_simulated_step(biped, gaits, h):
    """From the middle with 2 y*, over h, over the next middle to a level landing, where zeta = y+ - V_2(0).
    1e-6: the quadratures of the map; the walk's own error is below 1e-9."""
    gait = gaits["v0.6"]
    c = continued(gait.constraint)
    m = StrideMap.of(biped, c, MIDDLE, heights=np.array(sorted((0.0, h))))
    k, level = int(np.argmax(np.abs(m.heights))), m.level
    y = 2.0 * m.steady[level]
    at = poses_on(c, np.array(MIDDLE))
    sigma = -np.sqrt(2.0 * y)  # clockwise, towards +x
    start = at.q, at.dq * sigma / biped.angular_momentum(at.q, at.dq)
    walker = walker_on(gait, biped, ground_steps=stepped(np.array([-h])))
    walk = ba.walk(walker, gait, impacts=2, start=start, method=ba.Adaptive(1e-11, 1e-11))
    landing, following = zetas(biped, walk)
    assert landing == pytest.approx(y - m.V_2[k], rel=1e-6)
    y_next = m.delta2[k] * (y - m.V_2[k]) - m.V_1[k]
    assert following == pytest.approx(y_next - m.V_2[level], rel=1e-6)


def test_the_fixed_point_is_the_gait(biped, gaits, found):
    """zeta* = y* - V_2 is that of the gait's stored orbit, and delta^2 the multiplier of its zero dynamics."""
    for name, gait in gaits.items():
        m = found[name].map
        zeta = 0.5 * biped.angular_momentum(gait.q_minus, gait.v_minus) ** 2
        assert m.steady[m.level] - m.V_2[m.level] == pytest.approx(zeta, rel=1e-5)
        zero = ba.ZeroDynamics.of(biped, gait.constraint)
        assert m.delta2[m.level] == pytest.approx(zero.delta**2, rel=1e-6)


def test_forces_on_the_curve_are_those_of_the_model(biped, gaits):
    """Torques and ground force at s' = 3 1/s, with a force on the hip, by Pinocchio: D q'' + Omega = u + J'F,
    q'' from the row without a motor, and F_ground = m (p_com'' - g) - F."""
    force, rate, c = -20.0, 3.0, continued(gaits["v0.6"].constraint)
    s = np.linspace(0.1, 1.1, 9)
    at = poses_on(c, s)
    path = Path.of(biped, s, at, force)
    for k in range(len(s)):
        q, dq, v = at.q[k], at.dq[k], at.dq[k] * rate
        push = force * biped.pinned.jacobian(q, biped.pinned.hip)[0]
        D, rest = biped.inertia(q), biped.bias(q, v) - push
        curved = at.ddq[k] * rate**2
        a = curved - dq * (rest[-1] + D[-1] @ curved) / (D[-1] @ dq)
        u, F = (D @ a + rest)[:-1], biped.ground_reaction(q, v, a) - [force, 0.0]
        assert path.torque[k] @ [1.0, rate**2] == pytest.approx(u, rel=1e-9, abs=1e-9)
        reaction = path.reaction[k] @ [1.0, rate**2]
        assert [reaction.real, reaction.imag] == pytest.approx(F, rel=1e-9, abs=1e-8)


def test_the_gain_is_that_of_a_walk_on_alternating_ground(biped, gaits, found):
    """Heights of +-0.1 mm by turns: the amplitude of zeta before impacts, once it has settled. 2e-3: the map is
    curved in h, by the continuation that fades over 1 % of the step."""
    d, gait = 1e-4, gaits["v0.6"]
    heights = d * (-1.0) ** np.arange(40)
    walk = ba.walk(walker_on(gait, biped, ground_steps=stepped(-heights)), gait, impacts=40)
    zeta = zetas(biped, walk)[-2:]
    amplitude = 0.5 * abs(zeta[1] - zeta[0]) / np.mean(zeta)
    assert found["v0.6"].gain == pytest.approx(amplitude / d, rel=2e-3)


# -- heights -----------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("name", "H", "cause"),
    [("v0.5", 6.29, "stall"), ("v0.6", 9.15, "stall"), ("v0.8", 11.75, IMPULSE)],
)
def test_worst_grounds_are_walked_below_H_and_not_above(biped, gaits, found, name, H, cause):
    """40 steps: stairs down, stairs up, and one after the other, whichever bound of y is nearest."""
    reach, gait, walker = found[name].reach(), gaits[name], walker_on(gaits[name], biped)
    assert (1e3 * reach.height, reach.cause) == (pytest.approx(H, abs=0.01), cause)
    one = np.ones(20)
    grounds = [np.append(-one, -one), np.append(one, -one), np.append(-one, one)]
    assert all(walked(walker, gait, 0.97 * reach.height * x) for x in grounds)
    assert not all(walked(walker, gait, 1.03 * reach.height * x) for x in grounds)


@pytest.mark.parametrize("change", ["force", "mass"])
def test_a_held_force_and_a_wrong_mass(biped, gaits, found, change):
    """-2 N on the hip, which the controller does not know, or a torso of 20 % less than in its model: the
    tracking error is no longer 0, and H differs by 4 % for the force and 2 % for the mass."""
    gait, walker = gaits["v0.6"], walker_on(gaits["v0.6"], biped)
    if change == "force":
        reach = found["v0.6"].by_force[-2.0]
        walker = replace(walker, disturbance=ba.HipForce(biped, (-2.0, 0.0)))
    else:
        light = ba.ModelErrors(mass={"torso": -0.2}).apply(biped)
        walker = replace(walker, plant=light, model=biped)
        reach = rough_ground(walker, gait, forces=()).reach()
    assert reach.cause == "stall"
    assert reach.height < 0.7 * found["v0.6"].reach().height
    assert walked(walker, gait, np.full(40, -0.94 * reach.height))
    assert not walked(walker, gait, np.full(40, -1.03 * reach.height))


def test_H_grows_with_friction_and_without_limits(found):
    result = found["v0.8"]
    by_friction = [result.at_friction(mu).reach().height for mu in (0.4, 0.5, 0.6, 0.65, 0.8)]
    assert by_friction == sorted(by_friction)
    assert by_friction[0] == 0.0 < by_friction[2] < by_friction[-1]
    for way in WAYS:
        H = [result.reach(way, but).height for but in ((), (IMPULSE,), (IMPULSE, *CLIPPED))]
        assert sorted(H) == H
    both, up, down = (result.reach(way).height for way in ("both", "up", "down"))
    assert both <= min(up, down)


def test_weak_motors_stop_H_where_a_walk_needs_more(biped, gaits, found):
    """With 50 N m torque stops H, on stairs up; without the limits of motors H is that of strong ones."""
    walker, gait = walker_on(gaits["v0.6"], biped), gaits["v0.6"]
    weak = rough_ground(walker, gait, ba.Limits(torque=50.0), ())
    H, cause = weak.reach()
    assert cause == "torque"
    assert weak.reach(but=CLIPPED) == found["v0.6"].reach(but=CLIPPED)
    peaks = [
        ba.walk(replace(walker, ground_steps=stepped(np.full(25, -share * H))), gait).feasibility
        for share in (0.98, 1.02)
    ]
    assert peaks[0].peak_torque < 50.0 < peaks[1].peak_torque


def test_the_foot_is_as_far_above_the_ground_as_in_a_walk(biped, gaits, found):
    """Stairs of 8 mm up: least height above the lines between the footholds, but for 3 % of the time at either
    end. The map leaves out less than the walk, so that its room is the smaller one."""
    h, gait, m = 8e-3, gaits["v0.6"], found["v0.6"].map
    walker = walker_on(gait, biped, ground_steps=stepped(np.full(12, -h)))
    s = ba.walk(walker, gait, impacts=12).signals
    last = s.step == 12.0
    t, (x, z) = s.t[last] - s.t[last][0], np.array([biped.swing_foot(q) for q in s.q[last]]).T
    room = np.where(x > 0.0, z - h * x / x[-1], z - z[0] * x / x[0])
    inner = (t > 0.03 * t[-1]) & (t < 0.97 * t[-1])
    own = float(np.interp(h, m.heights, m.clearance().own))
    assert 0.0 < own <= np.min(room[inner])
    assert own == pytest.approx(np.min(room[inner]), abs=5e-3)


# -- chance ------------------------------------------------------------------------------------------
def test_mean_steps_are_those_of_random_walks_of_the_map(found):
    """4000 walks of the map at 1.3 H. 6 %: four standard deviations of their mean, as the number of steps is
    spread like its mean."""
    result, random = found["v0.5"], np.random.default_rng(3)
    H = 1.3 * result.reach().height
    m, y = result.map, np.full(4000, result.map.steady[result.map.level])
    alive, steps = np.ones(4000, dtype=bool), np.zeros(4000)
    while np.any(alive):
        h, steps = random.uniform(-H, H, 4000), steps + alive
        for low, high in result.within.values():
            alive &= (y > np.interp(h, m.heights, low)) & (y < np.interp(h, m.heights, high))
        alive &= np.interp(h, m.heights, m.impulse) < result.limits.friction
        a, V_2, V_1 = (np.interp(h, m.heights, x) for x in (m.delta2, m.V_2, m.V_1))
        y = a * (y - V_2) - V_1
    assert result.mean_steps(H) == pytest.approx(np.mean(steps), rel=0.06)
    assert result.mean_steps(0.99 * result.reach().height) == np.inf
    assert result.mean_steps(1.5 * result.reach().height) < result.mean_steps(H)


# -- bad input ---------------------------------------------------------------------------------------
def test_what_the_map_does_not_describe_is_refused(biped, gaits, found):
    gait, walker = gaits["v0.6"], walker_on(gaits["v0.6"], biped)
    npd, clock = ba.NPDController(gait.constraint), ba.SampledTime(1e-3, restart=False)
    cases = {
        "expected ReferenceReset": replace(walker, controller=npd),
        "keeps its own clock": replace(walker, timing=clock),
        "slope": replace(walker, slope=0.01),
        "another share": replace(walker, controller=ba.ReferenceReset(npd, share=1.0)),
        "does not track the curve": walker_on(gaits["v0.5"], biped),
    }
    for text, wrong in cases.items():
        with pytest.raises(InputError, match=text):
            rough_ground(wrong, gait)
    with pytest.raises(InputError, match=r"does not walk level ground.*impulse"):
        rough_ground(walker, gait, ba.Limits(friction=0.3))
    result = found["v0.6"]
    for wrong_call, text in (
        (lambda: result.mean_steps(0.2), "0.08 m"),
        (lambda: result.reach("sideways"), "sideways"),
        (lambda: result.reach(but=("wind",)), "wind"),
    ):
        with pytest.raises(InputError, match=text):
            wrong_call()


def test_the_text_has_the_numbers(found):
    text = found["v0.8"].text()
    assert "11.75 mm, impulse" in text
    assert "14.70 mm, stall" in text
    assert "1.65 % of zeta per mm" in text


def test_the_wheel_on_random_slopes_fails_as_published():
    """A rimless wheel of 8 spokes, each segment's slope from N(8 deg, 2 deg) (Byl, Tedrake, Int. J. Robotics
    Research 28(8), 2009): e' = c (e - G cos(g + a)) + G cos(g - a), which fails below G, 4326.19 steps from the
    cycle by Nystrom quadrature.
    """
    a, G, mu, sd = np.pi / 8.0, 2.0 * 9.8, np.radians(8.0), np.radians(2.0)
    c, found = np.cos(2.0 * a) ** 2, []
    for nodes in (2000, 4000):
        g = np.linspace(mu - 7.0 * sd, mu + 7.0 * sd, nodes + 1)
        p = np.exp(-0.5 * ((g - mu) / sd) ** 2)
        highest = G * np.max(np.cos(g - a) - c * np.cos(g + a)) / (1.0 - c)  # no e rises above
        e = np.linspace(G, highest, 500)
        after = c * (e - G * np.cos(g + a)[:, np.newaxis]) + G * np.cos(g - a)[:, np.newaxis]
        N = failing_step(e, after, after >= G, p / np.sum(p))
        cycle = G * (np.cos(mu - a) - c * np.cos(mu + a)) / (1.0 - c)
        found.append(np.interp(cycle, e, N))
    assert found[1] == pytest.approx(4326.19, rel=5e-4)
    assert abs(found[1] - 4326.19) < abs(found[0] - 4326.19)
