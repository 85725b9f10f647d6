"""The torque after a touchdown ramps from that before it: by definition, in both engines, on both plants."""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.across_contact import Hold, filled
from biped_adrc.control.base import controller_laws
from biped_adrc.control.ramp_torque import RampTorque
from biped_adrc.hardware.touchdown_told import Told
from biped_adrc.scenario.build import build

T, WINDOW = 1e-3, 0.008
SLOW = ba.GPIObserver.from_bandwidth(300.0, m=1)


def walked(biped, gait, law, impacts=2, engine="compiled", **more):
    clock = ba.SampledTime(T, restart="touchdown" not in more)
    walker = ba.Walker(biped, law, timing=clock, torque_limit=150.0, **more)
    walk = ba.walk(walker, gait, impacts, ba.RK4(T), engine=engine)
    assert walk.trajectory.settings["engine"] == engine
    return walk


def torques(arc):
    """Times since the arc began (K,) and torque sent (K, 4) at sample instants after that."""
    after = np.flatnonzero(np.diff(arc.t) == 0.0) + 1
    return arc.t[after] - arc.t[0], arc.x[after, -4:]


@pytest.mark.parametrize("engine", ["compiled", "pinocchio"])
def test_the_first_torque_after_a_touchdown_is_the_last_before_it(biped, gait, engine):
    """Its legs swapped; at the start of a run, where none was before, it is the controller's own."""
    walk = walked(biped, gait, RampTorque(ba.NPDController(gait.constraint), WINDOW), 2, engine)
    first, second = walk.trajectory.arcs
    m = walk.walker.measure(0.0, *gait.start(biped), ba.Mode())
    expected = np.clip(ba.NPDController(gait.constraint).output(np.zeros(0), m), -150.0, 150.0)
    np.testing.assert_allclose(first.x[0, -4:], expected, rtol=1e-9)
    before = first.x[-1, -4:][[1, 0, 3, 2]]
    assert np.array_equal(second.x[0, -4:], before)
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


def test_a_window_of_no_time_is_the_controller_itself(biped, gait):
    inner = ba.ADRCController(gait.constraint, SLOW)
    plain, none = (walked(biped, gait, x).trajectory for x in (inner, RampTorque(inner, 0.0)))
    assert np.array_equal(plain.arcs[-1].x[:, :10], none.arcs[-1].x[:, :10])


def test_both_engines_walk_alike(biped, gait):
    law = RampTorque(ba.ADRCController(gait.constraint, SLOW), WINDOW)
    one, other = (walked(biped, gait, law, engine=x).trajectory for x in ("compiled", "pinocchio"))
    for a, b in zip(one.arcs, other.arcs, strict=True):
        assert np.max(np.abs(a.x[-1][:10] - b.x[-1][:10])) < 1e-9


def test_the_window_begins_where_the_touchdown_is_noticed(biped, gait):
    """Until then the old law acts in the old labels; repeated is the torque of the tick before the notice."""
    law = RampTorque(ba.NPDController(gait.constraint), WINDOW)
    walk = walked(biped, gait, law, touchdown=Told(4e-3))
    late = walk.touchdowns.late[0]
    t, u = torques(walk.trajectory.arcs[1])
    k = int(np.argmin(np.abs(t - late)))
    assert np.array_equal(np.flatnonzero(np.all(u == u[k - 1], axis=1)), [k - 1, k])


def test_on_soft_ground_it_is_the_same_law(biped, gait):
    pytest.importorskip("mujoco")
    plant = ba.MuJoCoPlant(biped, integrator="leapfrog")
    law = RampTorque(ba.NPDController(gait.constraint), WINDOW)
    for kind in (ba.SteppingLoop, ba.CompiledLoop):
        loop = kind(plant, law, biped, ba.SampledTime(T), torque_limit=150.0)
        run = loop.run(loop.initial_state(*gait.start(biped)), ba.RunOptions(0.47))
        first, second = (arc.read["u"][np.flatnonzero(np.diff(arc.t) > 0.0)] for arc in run.arcs)
        repeated = np.all(second == first[-1][[1, 0, 3, 2]], axis=1)
        assert np.array_equal(np.flatnonzero(repeated), [0])


def test_a_scenario_names_it(gait):
    s = ba.Scenario("LESO", period=T, contact="ramp torque", contact_window=4e-3)
    law = build(s).controller
    assert (type(law), type(law.inner), law.window) == (RampTorque, ba.ADRCController, 4e-3)
    assert RampTorque(Hold(law.inner)).window == 0.005


def test_what_has_no_observer_says_nothing(gait):
    npd = RampTorque(ba.NPDController(gait.constraint))
    assert filled(controller_laws(npd)).estimate is None
