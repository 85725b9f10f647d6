"""Model errors: what they change by the energies they imply, what they leave, and what is refused.

An error is the relative change of a number: 0.2 makes a mass 1.2 times as large. biped is RABBIT, rough() is
RABBIT with friction in its joints.
"""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import InputError, ModelError
from biped_adrc.model.model_errors import ModelErrors, impact_error
from biped_adrc.model.physical import physical_checks
from biped_adrc.scenario.build import plant_of

ERRORS = ModelErrors(
    mass={"torso": 0.2, "shin": -0.1}, com={"thigh": 0.3}, inertia={"shin": 0.5, "torso": -0.2}
)


def test_the_energies_are_those_of_the_bodies_one_by_one(biped):
    """T and V are summed here link by link, with COMs from the links' angles and velocities by differences over
    d, and with the masses, COMs and inertias times the factors 1 + error. Nothing of the wrong model is used.
    """
    wrong, d = ERRORS.apply(biped), 1e-6
    random = np.random.default_rng(1)
    factors = {"torso": (1.2, 1.0, 0.8), "thigh": (1.0, 1.3, 1.0), "shin": (0.9, 1.0, 1.5)}
    bodies = biped.description.presets[biped.preset].bodies
    q, v = random.uniform(-1.0, 1.0, (2, 5))
    T = V = 0.0
    # bodies()[2]: the matrix A of the absolute angles a = A q
    rates = biped.pinned.bodies()[2] @ v
    # links hang from the stance foot: shin, thigh, torso, swing thigh, swing shin. root: (link, length) of
    # those between foot and link s; m, c, J: mass, COM and inertia
    for name, rate, (root, s) in zip(
        ("shin", "thigh", "torso", "thigh", "shin"), rates, ROOTS, strict=True
    ):
        m, c, J = (f * x for f, x in zip(factors[name], vars(bodies[name]).values(), strict=True))

        def com(x, root=root, s=s, c=c):
            a = biped.pinned.bodies()[2] @ x
            ups = np.array([-np.sin(a), np.cos(a)]).T
            return sum(k * ups[i] for i, k in root) + c * ups[s]

        velocity = (com(q + d * v) - com(q - d * v)) / (2.0 * d)
        T += 0.5 * m * velocity @ velocity + 0.5 * J * rate**2
        V += m * biped.description.gravity * com(q)[1]
    T += 0.5 * biped.armature * v[:4] @ v[:4]
    assert wrong.kinetic_energy(q, v) == pytest.approx(T, rel=1e-8)
    assert wrong.potential_energy(q) == pytest.approx(V, rel=1e-12)


def test_python_and_a_scenario_say_one_thing_alike(biped):
    """The same errors by ba.ModelErrors and by a scenario give one plant: 0.2 of the torso's 12 kg more."""
    chosen = ba.ModelErrors(mass={"torso": 0.2}, inertia={"shin": -0.1})
    plants = [
        chosen.apply(biped),
        plant_of(ba.Scenario(errors={"mass": chosen.mass, "inertia": {"shin": "-10 %"}}), biped),
    ]
    for plant in plants:
        assert plant.mass - biped.mass == pytest.approx(0.2 * 12.0, abs=1e-12)
        assert np.array_equal(plant.inertia(np.ones(5)), plants[0].inertia(np.ones(5)))


L = 0.4  # [m], thigh and shin
STANCE = [(0, -L), (1, -L)]  # from the foot to the hip, against the links' own direction
ROOTS = [
    (STANCE[:1], 0),
    (STANCE, 1),
    (STANCE, 2),
    (STANCE, 3),
    ([*STANCE, (3, L)], 4),
]


def test_what_is_gone_names_what_takes_its_place(biped):
    """What is gone is a method of earlier versions: the error names its successor; hasattr is false, as for any
    other name.
    """
    with pytest.raises(AttributeError, match=r"no attribute 'with_errors'; ba\.ModelErrors"):
        _ = biped.with_errors
    assert not hasattr(biped, "with_errors")


@pytest.mark.parametrize("robot", ["rabbit", "rimless_wheel"])
def test_drawn_errors_leave_a_physical_robot_with_the_same_geometry(robot):
    """Drawn errors of 10 % (the usual width) break no law of physics that the robot itself keeps, move no foot,
    are the same for the same seed, and differ for five seeds.
    """
    biped = ba.Biped.load(robot)
    q = np.random.default_rng(2).uniform(-1.0, 1.0, biped.n)
    masses = []
    for seed in range(5):
        errors = ModelErrors.drawn(biped, seed)
        wrong = errors.apply(biped)
        broken = [check.name for check in physical_checks(wrong) if not check.holds]
        assert broken == [check.name for check in physical_checks(biped) if not check.holds], seed
        assert not broken or robot == "rimless_wheel", "whose legs are spokes of one body"
        assert np.array_equal(wrong.swing_foot(q), biped.swing_foot(q))
        assert np.array_equal(
            ModelErrors.drawn(biped, seed).apply(biped).inertia(q), wrong.inertia(q)
        )
        assert 0.9 <= wrong.mass / biped.mass <= 1.1
        masses.append(wrong.mass)
    assert len(set(masses)) == 5


def test_drawn_errors_fill_their_width_evenly(biped):
    """Uniform on +-0.2 they have the standard deviation 0.2 / sqrt(3); the mean of 300 has 0.0067, so that 0.03
    is more than four of these. Errors of different bodies are not correlated, and a width of 0 draws zeros.
    """
    many = [ModelErrors.drawn(biped, seed, mass=0.2, com=0.0) for seed in range(300)]
    e = np.array([list(errors.mass.values()) for errors in many])
    assert e.shape == (300, 3)
    assert np.max(np.abs(e)) <= 0.2
    np.testing.assert_allclose(e.mean(axis=0), 0.0, atol=0.03)
    np.testing.assert_allclose(e.std(axis=0), 0.2 / np.sqrt(3.0), rtol=0.1)
    assert not any(any(errors.com.values()) for errors in many)
    assert abs(np.corrcoef(e.T)[0, 1]) < 0.2


def test_friction_errors_scale_friction_and_are_the_same_in_both_legs():
    """Each joint's friction is times 1 + error. A robot without friction has no such error; the four numbers
    are the usual widths; -1 takes all friction away, and less than -1 is refused.
    """
    rubbing = ba.Biped.load("rabbit", friction=True)
    errors = ModelErrors.drawn(rubbing, 4)
    assert errors.friction["left_knee"] == errors.friction["right_knee"] != 0.0
    v = np.array([1.0, -2.0, 0.01, 3.0, 1.0])
    scale = [1.0 + errors.friction.get(name, 0.0) for name in rubbing.description.joints]
    expected = np.array(scale) * rubbing.friction_torque(v)
    assert errors.apply(rubbing).friction_torque(v) == pytest.approx(expected, rel=1e-14)
    assert not ModelErrors.drawn(ba.Biped.load("rabbit"), 4).friction
    # seed 4 and the usual widths of mass, COM, inertia and friction
    assert ModelErrors.drawn(rubbing, 4, 0.1, 0.1, 0.1, 0.3) == errors
    for wrong in ({"friction": {"left_knee": -1.01}}, {"mass": {"torso": -1.0}}):
        with pytest.raises(ba.BipedError, match="ModelErrors"):
            ModelErrors(**wrong)
    without = ModelErrors(friction=dict.fromkeys(errors.friction, -1.0)).apply(rubbing)
    assert not np.any(without.friction_torque(v))


def test_impact_errors_are_uniform_and_repeated_by_their_seed():
    """The five errors of the rates after impact, for each of 200 seeds, are within +-0.1, with the standard
    deviation of a uniform distribution.
    """
    e = np.array([impact_error(seed, 0.1, 5) for seed in range(200)])  # 0.1: spread; 5: how many
    assert np.array_equal(e[3], impact_error(3, 0.1, 5))
    assert np.max(np.abs(e)) <= 0.1
    np.testing.assert_allclose(e.std(axis=0), 0.1 / np.sqrt(3.0), rtol=0.15)


@pytest.mark.parametrize("engine", ["pinocchio", "compiled"])
def test_an_impact_error_of_plus_makes_the_rates_larger(bare, published, engine):
    """Each rate after the simulated impact is that of the impact map times 1 + its error (`gain`), in both
    engines.
    """
    gain = (0.1, -0.05, 0.0, 0.02, 0.03)
    walker = ba.Walker(bare, ba.NPDController(published.constraint), impact_gain=gain)
    event = ba.walk(walker, published, 1, ba.RK4(2e-3), engine=engine).trajectory.arcs[0].event
    hit = bare.impact(event.x_minus[:5], event.x_minus[5:10])
    np.testing.assert_allclose(
        event.x_plus[5:10], (1.0 + np.array(gain)) * hit.v, rtol=0.0, atol=1e-9
    )


@pytest.mark.parametrize(
    "make",
    [
        lambda: ModelErrors(mass={"torso": -1.0}),
        lambda: ModelErrors(com={"shin": np.inf}),
        lambda: ModelErrors(mass={"arm": 0.1}).apply(rough()),
        lambda: ModelErrors(mass={"left_foot": 0.1}).apply(rough()),
        lambda: ModelErrors(mass={"left_shin": 0.1}).apply(rough()),
        lambda: ModelErrors(mass={"torso": 1e308}).apply(rough()),
        lambda: ModelErrors(friction={"left_knee": 0.1}).apply(rough()),
        lambda: ModelErrors(friction={"torso_pitch": 0.1}).apply(rough()),
        lambda: ModelErrors.drawn(rough(), 1, mass=9.0),
    ],
)
def test_errors_that_leave_nothing_or_do_not_fit_are_refused(make):
    """No mass left, numbers that are not finite, a body or joint that is not there or has no mass or friction,
    one leg alone, and a width of 900 %.
    """
    with pytest.raises((InputError, ModelError)):
        make()


def rough():
    return ba.Biped.load("rabbit", friction=True)


def test_limits_that_are_not_said_are_those_of_the_robot(biped):
    """(friction, torque limit [N m], window of averaging [s]): RABBIT's own where none is given."""
    assert ba.Limits().of(biped.description) == (0.6, 150.0, 0.005)
    assert ba.Limits(1.0, 3.0, 0.01).of(biped.description) == (1.0, 3.0, 0.01)
    with pytest.raises(ba.BipedError, match=r"1\.01, expected a number above 0 and at most 1"):
        ba.Limits(friction=1.01)
