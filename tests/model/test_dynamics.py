"""Single support: two models agree, and the laws of mechanics hold.

any_biped is RABBIT with each preset of its masses; states(n, count) yields random angles and rates of n
coordinates.
"""

import math

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.gait.published import X_STAR
from biped_adrc.model.reduction import disturbance_parts, reduce
from biped_adrc.model.robots.robot_toml import GRAVITY


def states(n, count, seed=0):
    random = np.random.default_rng(seed)
    for _ in range(count):
        yield random.uniform(-math.pi, math.pi, n), random.normal(0.0, 3.0, n)


def test_inertia_rate_minus_twice_coriolis_is_skew(any_biped):
    """D' - 2 C is skew-symmetric, with D' by central differences over +-h; and C v + G is the bias of
    Pinocchio.
    """
    b, h = any_biped, 1e-6
    for q, v in states(b.n, 50):
        rate = (b.inertia(q + h * v) - b.inertia(q - h * v)) / (2 * h)
        N = rate - 2 * b.coriolis(q, v)
        assert np.max(np.abs(N + N.T)) < 1e-6 * max(1.0, np.max(np.abs(rate)))
        assert np.allclose(b.coriolis(q, v) @ v + b.gravity(q), b.bias(q, v), rtol=0.0, atol=1e-9)


def test_the_energy_grows_by_the_power_of_the_motors(any_biped):
    """dE/dt = q_s'^T B_s u, where dE/dt is by central differences along the motion of the forward dynamics."""
    b, h = any_biped, 1e-5
    random = np.random.default_rng(3)
    for q, v in states(b.n, 30):
        u = random.normal(0.0, 40.0, b.p)
        a = b.acceleration(q, v, b.B @ u)

        def energy(t, q=q, v=v, a=a):
            return b.kinetic_energy(q + t * v + 0.5 * t**2 * a, v + t * a) + b.potential_energy(
                q + t * v + 0.5 * t**2 * a
            )

        power = float(v @ b.B @ u)
        scale = abs(power) + np.linalg.norm(v) * np.linalg.norm(b.bias(q, v))
        assert abs((energy(h) - energy(-h)) / (2 * h) - power) < 1e-6 * scale


def test_angular_momentum_about_the_foot_changes_by_gravity_alone(any_biped):
    """sigma' = -dV/dq5, whatever the motors do: the last entry of G, as q5 turns the whole robot about the
    foot. sigma' is by central differences along the motion.
    """
    b, h = any_biped, 1e-6
    for q, v in states(b.n, 20):
        a = b.acceleration(q, v, b.B @ np.array([50.0, -30.0, 20.0, 10.0]))
        rate = (
            b.angular_momentum(q + h * v, v + h * a) - b.angular_momentum(q - h * v, v - h * a)
        ) / (2 * h)
        assert rate == pytest.approx(-b.gravity(q)[-1], rel=1e-5, abs=1e-3)


def test_reduction_is_the_dynamics_of_the_actuated_joints(any_biped):
    """(13) with (14) and (15) is compared with D_s solved whole, disturbances on all joints included."""
    b = any_biped
    random = np.random.default_rng(5)
    for q, v in states(b.n, 50):
        u, force = random.normal(0, 50, b.p), random.normal(0, 20, b.n)
        terms = b.reduction(q, v)
        a = b.acceleration(q, v, b.B @ u + force)
        xi = terms.xi + sum(disturbance_parts(terms, force))
        assert np.allclose(terms.kappa @ u + xi, a[: b.p], rtol=1e-9, atol=1e-8)
        assert np.allclose(terms.kappa @ terms.kappa_inverse, np.eye(b.p), rtol=0.0, atol=1e-10)
        free = b.acceleration(q, v, b.B @ u)
        assert np.allclose(terms.A_N @ free[: b.p] + terms.a_N, free[b.p :], rtol=1e-9, atol=1e-8)


@pytest.mark.parametrize("p", [0, 2, 4, 5])
def test_the_split_of_any_number_of_motors_is_the_system_solved_whole(p):
    """D a + Omega = (u, 0): a_b = kappa u + xi and a_N = A_N a_b + a_N, for 5 coordinates."""
    random = np.random.default_rng(6)
    root, Omega, u = random.normal(size=(5, 5)), random.normal(size=5), random.normal(size=p)
    D = root @ root.T + np.eye(5)
    a, terms = np.linalg.solve(D, np.append(u, np.zeros(5 - p)) - Omega), reduce(D, Omega, p)
    assert terms.kappa @ u + terms.xi == pytest.approx(a[:p], rel=1e-9)
    assert terms.A_N @ a[:p] + terms.a_N == pytest.approx(a[p:], rel=1e-9)
    assert terms.kappa_inverse @ (a[:p] - terms.xi) == pytest.approx(u, rel=1e-9)


def test_the_velocity_of_the_swing_foot_is_its_slope(biped):
    """The velocity is compared with central differences of the foot's place; that the place is right is shown
    in gait/test_conventions.py.
    """
    h = 1e-6
    for q, v in states(biped.n, 20):
        slope = (biped.swing_foot(q + h * v) - biped.swing_foot(q - h * v)) / (2 * h)
        assert np.allclose(biped.swing_foot_velocity(q, v), slope, rtol=0.0, atol=1e-7)


def test_published_state_stands_on_the_ground(biped):
    """x* is printed to three decimals: the swing foot is on the ground to 0.15 mm. Step length [m], velocities
    of foot and hip [m/s] and rate of Theta [rad/s] are those that follow from the printed numbers.
    """
    q, v = X_STAR[:5], X_STAR[5:]
    assert biped.swing_foot(q) == pytest.approx([0.3125, -0.0001], abs=5e-5)
    assert biped.swing_foot_velocity(q, v) == pytest.approx([1.564, -0.436], abs=5e-4)
    assert biped.hip_velocity(q, v) == pytest.approx([0.894, -0.394], abs=5e-4)
    assert biped.phase @ v == pytest.approx(-1.257, abs=1e-9)


def test_ground_reaction_is_what_holds_the_floating_robot(any_biped):
    """In the unpinned model (2), whose last two coordinates are the foot's, the rate of the linear momentum, by
    central differences along the motion, plus the weight is the force at the stance foot.
    """
    b, h = any_biped, 1e-6
    for q, v in states(b.n, 20):
        u = np.array([30.0, -20.0, 10.0, 5.0])
        a = b.acceleration(q, v, b.B @ u)
        momentum = []
        for s in (h, -h):
            D_e = b.extended_inertia(q + s * v)
            momentum.append(D_e[-2:, : b.n] @ (v + s * a))
        rate = (momentum[0] - momentum[1]) / (2 * h)
        weight = np.array([0.0, b.mass * GRAVITY])
        assert b.ground_reaction(q, v, a) == pytest.approx(rate + weight, rel=1e-5, abs=1e-2)


def test_friction_is_off_by_default_and_takes_energy_when_on(biped):
    """RABBIT's hips have 16.5 N m s/rad and 15 N m, at 1 rad/s here; its torso has no joint that rubs."""
    v = np.array([1.0, -2.0, 0.5, 3.0, 0.7])
    assert not np.any(biped.friction_torque(v))
    rough = ba.Biped.load("rabbit", friction=True)
    assert rough.friction_torque(v) @ v < 0
    assert rough.friction_torque(v)[0] == pytest.approx(-16.5 - 15.0, abs=1e-6)
    assert rough.friction_torque(v)[-1] == 0.0
