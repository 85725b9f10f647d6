"""What is commanded after a touchdown: each policy is its definition, in both engines and on both plants."""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.across_contact import Hold, filled
from biped_adrc.control.base import controller_laws
from biped_adrc.control.double_support import DampedJoints, LastTorque, RampTorque
from biped_adrc.errors import InputError
from biped_adrc.hardware.touchdown_told import Told
from biped_adrc.scenario.build import build

T, WINDOW = 1e-3, 0.008
POLICIES = (LastTorque, RampTorque, lambda inner, window: DampedJoints(inner, window, 5.0))
SLOW = ba.GPIObserver.from_bandwidth(300.0, m=1)


def walked(biped, gait, law, impacts=2, engine="compiled", **more):
    clock = ba.SampledTime(T, restart="touchdown" not in more)
    walker = ba.Walker(biped, law, timing=clock, torque_limit=150.0, **more)
    walk = ba.walk(walker, gait, impacts, ba.RK4(T), engine=engine)
    assert walk.trajectory.settings["engine"] == engine
    return walk


def torques(arc):
    """Times since the arc began (K,), rates (K, 4) and torque sent (K, 4) at sample instants after that."""
    after = np.flatnonzero(np.diff(arc.t) == 0.0) + 1
    return arc.t[after] - arc.t[0], arc.x[after, 5:9], arc.x[after, -4:]


@pytest.mark.parametrize("engine", ["compiled", "pinocchio"])
def test_every_motor_goes_on_with_the_torque_of_before(biped, gait, engine):
    """At the start of a run, where none was before, with the controller's own."""
    walk = walked(biped, gait, LastTorque(ba.NPDController(gait.constraint), WINDOW), 2, engine)
    first, second = walk.trajectory.arcs
    m = walk.walker.measure(0.0, *gait.start(biped), ba.Mode())
    t, _, u = torques(first)
    expected = np.clip(ba.NPDController(gait.constraint).output(np.zeros(0), m), -150.0, 150.0)
    np.testing.assert_allclose(u[t < WINDOW - 1e-9], np.tile(expected, (7, 1)), rtol=1e-9)
    t, _, u = torques(second)
    before = torques(first)[2][-1][[1, 0, 3, 2]]
    held = np.all(u == before, axis=1)
    assert np.array_equal(held, t < WINDOW - 1e-9)
    assert np.max(np.abs(before)) > 1.0


@pytest.mark.parametrize(("t_step", "w"), [(0.0, 0.0), (0.002, 0.15625), (0.004, 0.5)])
def test_the_ramp_goes_from_the_torque_of_before_to_the_controllers(biped, gait, t_step, w):
    inner = ba.ADRCController(gait.constraint, SLOW).sampled(T)
    law, walker = RampTorque(inner, WINDOW), ba.Walker(biped, ba.Passive())
    m = walker.measure(3.0 + t_step, *gait.start(biped), ba.Mode(4, 3.0))
    z, u_0 = 1.1 * inner.initial_state(m), np.array([10.0, -20.0, 30.0, -5.0])
    s = np.concatenate((z, u_0))
    u = inner.output(z, m)
    np.testing.assert_allclose(law.output(s, m), u_0 + w * (u - u_0), rtol=1e-12)
    late = m._replace(t_step=WINDOW)
    assert np.array_equal(law.output(s, late), inner.output(z, late))
    for moment, kept in ((m, u_0), (late, 2.0 * u)):
        assert np.array_equal(law.predict(s, moment, 2.0 * u)[-4:], kept)


def test_damped_joints_have_a_torque_against_their_rates(biped, gait):
    for damping in (5.0, 0.0):
        law = DampedJoints(ba.NPDController(gait.constraint), WINDOW, damping)
        t, v, u = torques(walked(biped, gait, law).trajectory.arcs[1])
        early = t < WINDOW - 1e-9
        assert np.count_nonzero(early) == 7
        np.testing.assert_allclose(u[early], -damping * v[early], atol=1e-12)
        assert np.all(np.any(u[~early] != -damping * v[~early], axis=1))


@pytest.mark.parametrize("policy", POLICIES)
def test_a_window_of_no_time_is_the_controller_itself(biped, gait, policy):
    inner = ba.ADRCController(gait.constraint, SLOW)
    plain, none = (walked(biped, gait, law).trajectory for law in (inner, policy(inner, 0.0)))
    assert np.array_equal(plain.arcs[-1].x[:, :10], none.arcs[-1].x[:, :10])


@pytest.mark.parametrize("policy", POLICIES)
def test_both_engines_walk_alike(biped, gait, policy):
    law = policy(ba.ADRCController(gait.constraint, SLOW), WINDOW)
    one, other = (walked(biped, gait, law, engine=x).trajectory for x in ("compiled", "pinocchio"))
    for a, b in zip(one.arcs, other.arcs, strict=True):
        assert np.max(np.abs(a.x[-1][:10] - b.x[-1][:10])) < 1e-9


def test_the_window_begins_where_the_touchdown_is_noticed(biped, gait):
    """Until then the old law acts in the old labels; held is the torque of the tick before the notice."""
    law = LastTorque(ba.NPDController(gait.constraint), WINDOW)
    walk = walked(biped, gait, law, touchdown=Told(4e-3))
    late = walk.touchdowns.late[0]
    t, _, u = torques(walk.trajectory.arcs[1])
    k = int(np.argmin(np.abs(t - late)))
    assert np.array_equal(np.flatnonzero(np.all(u == u[k - 1], axis=1)), np.arange(k - 1, k + 8))


def test_on_soft_ground_it_is_the_same_law(biped, gait):
    pytest.importorskip("mujoco")
    plant = ba.MuJoCoPlant(biped, integrator="leapfrog")
    law = LastTorque(ba.NPDController(gait.constraint), WINDOW)
    for kind in (ba.SteppingLoop, ba.CompiledLoop):
        loop = kind(plant, law, biped, ba.SampledTime(T), torque_limit=150.0)
        run = loop.run(loop.initial_state(*gait.start(biped)), ba.RunOptions(0.47))
        first, second = (arc.read["u"][np.flatnonzero(np.diff(arc.t) > 0.0)] for arc in run.arcs)
        times = run.arcs[1].t[np.flatnonzero(np.diff(run.arcs[1].t) > 0.0)]
        early = times < times[0] + WINDOW - 1e-9
        assert np.all(second[early] == first[-1][[1, 0, 3, 2]])
        assert not np.any(np.all(second[~early] == first[-1][[1, 0, 3, 2]], axis=1))


def test_by_a_field_of_a_scenario_around_the_policy_of_the_observer():
    s = ba.Scenario(
        "LESO", period=T, contact="hold", double_support="damping", double_support_window=4e-3,
        own={"damping": 3.0},
    )  # fmt: skip
    law = build(s).controller
    assert (type(law), type(law.inner), law.window, law.damping) == (DampedJoints, Hold, 4e-3, 3.0)
    for wrong, words in (
        ({"double_support_window": 4e-3}, "double_support_window without double_support"),
        (
            {"double_support": "damping", "own": {"damping": -1.0}},
            "damping in double support is -1",
        ),
        ({"double_support": "rampp torque"}, "did you mean 'ramp torque'"),
        ({"double_support": "keep torque", "double_support_window": 4e-3}, "double_support_window"),
    ):
        with pytest.raises(InputError, match=words):
            build(ba.Scenario("LESO", period=T, **wrong))
    with pytest.raises(InputError, match="double_support without a period"):
        ba.Scenario("LESO", double_support="damping")


def test_what_has_no_observer_says_nothing(gait):
    npd = LastTorque(ba.NPDController(gait.constraint))
    assert filled(controller_laws(npd)).estimate is None
