"""A UR5 under the walkers' controllers: power, the split without unactuated rows, and an unknown payload."""

import math
import runpy
import sys
from pathlib import Path
from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pinocchio as pin
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.arm import ArmSystem
from biped_adrc.errors import InputError, ModelError
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.model import arm as arm_module
from biped_adrc.model.arm import Arm, _strip

Q = np.array([0.0, -1.2, 1.5, -0.5, 0.8, 0.2])  # [rad]
SWING, RATE = np.array([0.6, 0.3, -0.4, 0.5, -0.4, 0.8]), 2.0 * math.pi * 0.4
GAINS = ba.Gains(400.0, 40.0)


def swing(t):
    c, s = math.cos(RATE * t), math.sin(RATE * t)
    return Q + SWING * (1.0 - c), SWING * RATE * s, SWING * RATE**2 * c


REFERENCE = ba.TimeReference(swing)


@pytest.fixture(scope="module")
def arm():
    return Arm.ur5()


@pytest.fixture(scope="module")
def heavy(arm):
    return arm.with_payload(3.0, (0.0, 0.0, 0.1))


def states(count=4):
    random = np.random.default_rng(1)
    for _ in range(count):
        yield random.uniform(-3.0, 3.0, 6), random.normal(size=6), random.normal(0.0, 20.0, 6)


def energy(arm, x):
    return arm.kinetic_energy(x[:6], x[6:12]) + arm.potential_energy(x[:6])


# -- the model -------------------------------------------------------------------------------------
def test_the_power_of_the_motors_is_the_growth_of_the_energy(heavy):
    """d(T + V)/dt = q'. u, by differences along the motion."""
    d = 1e-6
    for q, v, u in states():
        a = heavy.acceleration(q, v, u)
        E = [energy(heavy, np.append(q + s * v, v + s * a)) for s in (-d, d)]
        assert (E[1] - E[0]) / (2.0 * d) == pytest.approx(v @ u, rel=1e-5, abs=1e-5)


def test_the_split_has_every_joint_and_no_more(heavy):
    for q, v, u in states():
        terms = heavy.reduction(q, v)
        assert (terms.A_N.shape, terms.a_N.shape, terms.kappa.shape) == ((0, 6), (0,), (6, 6))
        expected = heavy.acceleration(q, v, u)
        assert terms.kappa @ u + terms.xi == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_the_payload_is_a_ball_at_the_tool(arm):
    """V = m g z and T = m v^2/2 of the tool's own motion, by differences; 2/5 m r^2 for its spin."""
    m, d = 3.0, 1e-6

    def carried(com, radius, of, *state):
        return getattr(arm.with_payload(m, (0.0, 0.0, com), radius), of)(*state) - getattr(arm, of)(
            *state
        )

    for q, v, _ in states():
        tool = (arm.tool_position(q + d * v) - arm.tool_position(q - d * v)) / (2.0 * d)
        V = [carried(com, 1e-6, "potential_energy", q) for com in (0.0, 0.1, 0.2)]
        assert V[0] == pytest.approx(m * 9.81 * arm.tool_position(q)[2], rel=1e-9)
        assert V[2] - V[0] == pytest.approx(2.0 * (V[1] - V[0]), rel=1e-9)
        assert 0.0 < abs(V[1] - V[0]) <= m * 9.81 * 0.1
        T = [carried(0.0, radius, "kinetic_energy", q, v) for radius in (1e-6, 0.1, 0.2)]
        assert T[0] == pytest.approx(0.5 * m * tool @ tool, rel=1e-6)
        assert T[2] - T[0] == pytest.approx(4.0 * (T[1] - T[0]), rel=1e-6)
        spin = 2.0 * (T[1] - T[0]) / (0.4 * m * 0.1**2)  # [rad^2/s^2]
        assert spin == pytest.approx(turning(arm, q, v) ** 2, rel=1e-5)


def turning(arm, q, v, d=1e-5):
    """Speed at which the tool turns [rad/s], by differences of three points of it."""
    rates = []
    for axis in np.eye(3):
        points = [
            placed(arm, q + s * d * v, axis) - placed(arm, q + s * d * v, 0.0 * axis)
            for s in (-1.0, 1.0)
        ]
        rates.append((points[1] - points[0]) / (2.0 * d))
    return math.sqrt(0.5 * sum(rate @ rate for rate in rates))


def placed(arm, q, point):
    """A point of the tool in the world (3,) [m]."""
    pin.framesForwardKinematics(arm.model, (data := arm.model.createData()), q)
    return data.oMf[arm.model.getFrameId(arm.tool)].act(point)


def test_torque_limits_are_those_of_the_urdf(arm):
    assert np.array_equal(arm.effort, [150.0, 150.0, 150.0, 28.0, 28.0, 28.0])


# -- under control ---------------------------------------------------------------------------------
@pytest.mark.parametrize("timing", [ba.ContinuousTime(), ba.SampledTime(2e-3)])
def test_the_work_of_the_motors_is_the_energy_gained(arm, heavy, timing):
    """In sampled time the torque is held, so its work is u . (q_(k+1) - q_k) exactly."""
    observer = ba.GPIObserver.from_bandwidth(80.0, 1)
    controller = ba.ADRCController(REFERENCE, observer, GAINS)
    system = ArmSystem(heavy, controller, timing, model=arm)
    run = system.run(Q, np.zeros(6), 0.4, ba.RK4(1e-3))
    (arc,) = run.arcs
    assert run.status.ok
    if system.sampled:
        held = arc.x[:-1, -6:]
        work = np.sum(held * np.diff(arc.x[:, :6], axis=0))
    else:
        power = [x[6:12] @ system.applied(t, x) for t, x in zip(arc.t, arc.x, strict=True)]
        work = sum(np.diff(arc.t) * (np.array(power[1:]) + np.array(power[:-1])) / 2.0)
    gained = energy(heavy, arc.x[-1]) - energy(heavy, arc.x[0])
    assert abs(gained) > 1.0, "[J]"
    assert work == pytest.approx(gained, abs=1e-3)


def test_the_observer_finds_the_payload_that_model_feedback_does_not(arm, heavy):
    """Errors under 3 kg that the model has not: ADRC's are at least 50 times smaller."""
    rms = {}
    for name, controller in (
        ("NPD", ba.NPDController(REFERENCE, GAINS)),
        (
            "ADRC",
            ba.ADRCController(REFERENCE, ba.GPIObserver.from_bandwidth(200.0, 2), GAINS),
        ),
    ):
        for plant in (arm, heavy):
            system = ArmSystem(plant, controller, ba.SampledTime(1e-3), model=arm)
            run = system.run(Q, np.zeros(6), 2.0, ba.RK4(1e-3), store_every=5)
            assert run.status.ok
            late = run.arcs[0].t > 0.5
            error = system.error(run, REFERENCE)[late]
            rms[name, plant is heavy] = float(np.sqrt(np.mean(error**2)))
    assert rms["ADRC", True] < rms["NPD", True] / 50.0
    assert rms["NPD", True] > 1e-2
    assert rms["NPD", False] < 1e-4


def test_the_estimate_is_the_disturbance_that_the_payload_makes(arm, heavy):
    """xi^ against q'' - kappa u of the run itself."""
    observer = ba.GPIObserver.from_bandwidth(200.0, 2)
    controller = ba.ADRCController(REFERENCE, observer, GAINS)
    system = ArmSystem(heavy, controller, ba.ContinuousTime(), model=arm)
    run = system.run(Q, np.zeros(6), 1.0, ba.RK4(2e-3))
    x, t = run.arcs[0].x[-1], run.t_end
    q, v, s = x[:6], x[6:12], x[12:]
    u, terms = system.applied(t, x), arm.reduction(q, v)
    xi = heavy.acceleration(q, v, u) - terms.kappa @ u
    found = observer.estimate(s).disturbance
    assert np.max(np.abs(xi - terms.xi)) > 2.0, "[rad/s^2], what the model misses"
    assert np.max(np.abs(found - xi)) < 0.05 * np.max(np.abs(xi - terms.xi))


def test_motors_saturate(arm, heavy):
    stiff = ba.NPDController(REFERENCE, ba.Gains(2e4, 50.0))
    system = ArmSystem(heavy, stiff, ba.SampledTime(1e-3), model=arm)
    run = system.run(Q + 0.3, np.zeros(6), 0.02, ba.RK4(1e-3))
    u = run.arcs[0].x[1:, -6:]
    assert np.all(np.abs(u) <= arm.effort)
    assert np.any(np.abs(u) == arm.effort)
    free = ArmSystem(heavy, stiff, ba.SampledTime(1e-3), arm, limited=False)
    u = free.run(Q + 0.3, np.zeros(6), 0.02, ba.RK4(1e-3)).arcs[0].x[1:, -6:]
    assert np.any(np.abs(u) > arm.effort)


def test_runs_converge_at_the_order_of_the_method(arm, heavy):
    controller = ba.ADRCController(REFERENCE, ba.GPIObserver.from_bandwidth(50.0, 1), GAINS)
    system = ArmSystem(heavy, controller, model=arm)
    ends = [system.run(Q, np.zeros(6), 0.2, ba.RK4(h)).final_state[:12] for h in (4e-3, 2e-3, 1e-3)]
    gaps = [np.max(np.abs(ends[i] - ends[i + 1])) for i in (0, 1)]
    assert math.log2(gaps[0] / gaps[1]) == pytest.approx(4.0, abs=0.4)


def test_the_error_is_taken_from_a_reference_of_time_angles_and_rates(arm):
    system = ArmSystem(arm, ba.ADRCController(REFERENCE, ba.GPIObserver.from_bandwidth(50.0, 1)))
    run = system.run(Q, np.ones(6), 2e-3, ba.RK4(1e-3))
    t, x = run.arcs[0].t[:, np.newaxis], run.arcs[0].x
    error = system.error(run, lambda t, q, v: SimpleNamespace(q_d=t + 0.5 * q - 2.0 * v))
    np.testing.assert_allclose(error, 0.5 * x[:, :6] + 2.0 * x[:, 6:12] - t)


# -- what is refused -------------------------------------------------------------------------------
def test_a_robot_that_is_not_installed_is_named(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(arm_module, "_data_folders", lambda: iter([tmp_path]))
    with pytest.raises(ModelError, match=r"pip install 'biped-adrc\[robots\]'"):
        Arm.ur5()
    example = Path(__file__).parents[1] / "examples" / "arm_payload.py"
    monkeypatch.setattr(sys, "argv", [str(example), str(tmp_path)])
    with pytest.raises(SystemExit) as left:
        runpy.run_path(str(example))
    assert left.value.code == 0
    assert "biped-adrc[robots]" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('<mass value="8.393"/>', '<mass value="-8.393"/>', "link 'upper_arm_link': mass -8.393"),
        ('<mass value="8.393"/>', '<mass value="8.393kg"/>', "8.393kg"),
        ('<mass value="0"/>', '<mass value="nan"/>', "nan"),
        ('iyy="0.22689067591"', 'iyy="2.2"', "triangle inequality"),
        (
            'name="elbow_joint" type="revolute"',
            'name="elbow_joint" type="continuous"',
            "wide limits",
        ),
        ('name="elbow_joint" type="revolute"', 'name="elbow_joint" type="floating"', "'floating'"),
        ('effort="28.0"', 'effort="-28.0"', "effort is -28"),
        ('<axis xyz="0 0 1"/>', '<axis xyz="0 0 2"/>', "length 2"),
        ('<link name="tool0">', '<link name="tool1">', "tool0"),
    ],
)
def test_bad_urdfs(arm, tmp_path, old, new, message):
    text = Path(arm.source).read_text()
    assert old in text
    path = tmp_path / "arm.urdf"
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(ModelError, match=message):
        Arm.load(path, "tool0")


def test_what_does_not_fit(arm):
    npd = ba.NPDController(REFERENCE, GAINS)
    for make, message in (
        (lambda: arm.with_payload(-1.0), "payload is -1"),
        (lambda: arm.with_payload(math.nan), "payload is nan"),
        (lambda: arm.with_payload(1.0, radius=0.0), "radius 0"),
        (lambda: ArmSystem(arm, npd, ba.SampledTime(1e-3, delay=1e-3)), "delay is 0.001 s"),
        (lambda: arm.inertia(np.zeros(5)), r"shape \(6,\)"),
        (lambda: arm.inertia(np.full(6, np.nan)), "nan"),
        (lambda: Arm.load(arm.source, "hand"), "no frame 'hand'"),
    ):
        with pytest.raises(InputError, match=message):
            make()

    class Short(ba.Controller):
        """Too few torques."""

        def output(self, s, m):
            return np.zeros(3)

    with pytest.raises(InputError, match=r"Short.output returned an array of shape \(3,\)"):
        ArmSystem(arm, Short()).run(Q, np.zeros(6), 0.1, ba.RK4(1e-3))


def test_a_torque_that_is_no_number_ends_the_run(arm):
    class Breaks(ba.Controller):
        """NaN after a while."""

        def output(self, s, m):
            return np.full(6, np.nan if m.t > 0.05 else 0.0)

    for timing in (ba.ContinuousTime(), ba.SampledTime(1e-2)):
        system = ArmSystem(arm, Breaks(), timing)
        run = simulate(system, system.initial_state(Q, np.zeros(6)), None, ba.RK4(1e-2), t_end=0.1)
        assert run.status is ba.Status.NOT_FINITE
        assert "Breaks" in run.detail
        assert np.all(np.isfinite(run.final_state))


@pytest.mark.parametrize(
    ("mass", "moments", "stays"),
    [(0, 0, False), (0, 1e-3, True), (1.0, 0, True), (0, None, False), (1.0, None, True)],
)
def test_a_frame_without_mass_and_moments_loses_its_inertia_alone(mass, moments, stays):
    said = "" if moments is None else f'<inertia ixx="0" iyy="{moments}" izz="0"/>'
    text = f'<robot><link name="a"><inertial><mass value="{mass}"/>{said}</inertial></link></robot>'
    root = ElementTree.fromstring(text)
    _strip(root, "own.urdf")
    assert (root.find("link/inertial") is not None) is stays
