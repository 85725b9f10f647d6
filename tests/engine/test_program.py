"""A walker's equations in machine code against the Python engine, at random states.

Python's are Pinocchio's. Machine code is compiled from a closed form in absolute angles of a planar tree.
`close` allows 1e-11 of the largest number.
"""

import gc
import math
from dataclasses import replace
from weakref import ref

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.base import Passive
from biped_adrc.core.errors import ModelError
from biped_adrc.core.timing import SampledTime
from biped_adrc.engine.calls import compiled_biped
from biped_adrc.engine.numbers import numbers_of
from biped_adrc.engine.program import Program
from biped_adrc.engine.tracer import Tracer
from biped_adrc.model.planar_robot import robot_of
from biped_adrc.model.robots.robot_toml import robot_names
from tests.control.conforms import call, loop_compiles

EXACT = 1e-11
"""Largest difference, as a share of the largest number."""
COUNT = 1000
TUPLES = ("reduction", "body_terms", "impact")


def close(found, expected):
    gap = np.max(np.abs(found[: len(expected)] - expected))
    assert gap <= EXACT * np.max(np.abs(expected)), gap


@pytest.mark.parametrize("robot", robot_names())
def test_the_terms_of_every_robot_are_pinocchio_s(robot):
    """Inertia, bias and ground force are compared; the acceleration by its residual, D a = torque + friction -
    bias, as a share of the terms: so an ill-conditioned D does not count.
    """
    biped = ba.Biped.load(robot)
    code = compiled_biped(biped)
    random = np.random.default_rng(5)
    for _ in range(500):
        q, v, a = random.normal(0.0, 3.0, (3, biped.n))
        D, free = biped.inertia(q), 10.0 * a + biped.friction_torque(v) - biped.bias(q, v)
        close(code.reduction(q, v).D, D)
        close(code.reduction(q, v).Omega, biped.bias(q, v))
        close(code.ground_reaction(q, v, a), biped.ground_reaction(q, v, a))
        found = code.acceleration(q, v, 10.0 * a)
        assert np.max(np.abs(D @ found - free)) <= EXACT * np.max(np.abs(D) @ np.abs(found))


@pytest.mark.parametrize("robot", ["rabbit", "three_link"])
def test_terms_and_impact_at_a_thousand_states(robot):
    """The terms that a controller gets: q_b'' = kappa u + xi, and q_N'' = A_N q_b'' + a_N of the coordinate
    without a motor; and the state after impact by the program of a walker.
    """
    biped = ba.Biped.load(robot)
    code, n = compiled_biped(biped), biped.n
    walker, still = Walker(biped, Passive()), np.zeros(n)
    program = Program(walker.layout_of(walker.initial_state(still, still)), numbers_of(walker))
    random = np.random.default_rng(12)
    for _ in range(COUNT):
        q, v = random.uniform(-np.pi, np.pi, biped.n), random.normal(0.0, 3.0, biped.n)
        found, expected = code.reduction(q, v), biped.reduction(q, v)
        for name in ("D", "Omega", "kappa", "kappa_inverse", "A_N"):
            close(getattr(found, name), getattr(expected, name))
        for name in ("xi", "a_N"):  # sums that may cancel, compared with their largest terms
            gap = np.max(np.abs(getattr(found, name) - getattr(expected, name)), initial=0.0)
            inverse = np.max(np.abs(np.linalg.inv(expected.D)))
            assert gap <= EXACT * np.max(np.abs(expected.Omega)) * inverse
        after = biped.impact(q, v)
        # the input of the impact: time 0, single support 2, and the state; its output begins with (q, v)
        struck = np.concatenate(([0.0, 2.0], q, v))
        found = call(program.machine, "impact", program.K, struck, 2 * n + 1)
        close(found, np.concatenate((after.q, after.v)))


@pytest.mark.parametrize("robot", robot_names())
def test_the_closed_form_on_numbers_is_pinocchio_s(robot):
    """The closed form from which machine code is made, run in Python on numbers (`robot_of`), gives Pinocchio's
    results, method by method; those in TUPLES return several terms.
    """
    biped = ba.Biped.load(robot)
    planar, random = robot_of(biped), np.random.default_rng(3)
    for _ in range(50):
        q, v, force = random.normal(size=(3, biped.n))
        for name, arguments in {
            "reduction": (q, v),
            "body_terms": (q, v),
            "acceleration": (q, v, force),
            "ground_reaction": (q, v, force),
            "impact": (q, v),
            "momentum": (q, v),
            "kinetic_energy": (q, v),
            "potential_energy": (q,),
            "swing_foot": (q,),
            "hip": (q,),
            "relabel": (q,),
        }.items():
            found, expected = (getattr(b, name)(*arguments) for b in (planar, biped))
            pairs = zip(found, expected, strict=True) if name in TUPLES else [(found, expected)]
            for one, other in pairs:
                np.testing.assert_allclose(one, other, rtol=1e-8, atol=1e-8, err_msg=name)


@pytest.mark.parametrize("timing", [ba.ContinuousTime(), SampledTime(1e-3)], ids=["all", "ticks"])
def test_a_plant_that_is_not_the_model(gait, timing):
    """`loop_compiles` compares flow, ticks and impacts in machine code with Python's at 200 random states:
    plant, with friction, and model both have numbers of their own in the code.
    """
    biped = ba.Biped.load("rabbit", friction=True)
    heavy = ba.ModelErrors(mass={"torso": 0.2}, inertia={"thigh": 0.15}).apply(biped)
    law = ba.ADRCController(gait.constraint)
    walker = Walker(heavy, law, timing=timing, model=biped, slope=0.05, torque_limit=150.0)
    # at random states the law asks for torques that would end a walk as a runaway
    loop_compiles(replace(walker, runaway_torque=math.inf), 200)


def test_one_compilation_serves_every_number(biped, gait):
    """Other masses, gains and limits change the numbers K alone: the machine code is the same object."""

    def program(walker):
        return Program(
            walker.layout_of(walker.initial_state(*gait.start(biped))), numbers_of(walker)
        )

    first = program(Walker(biped, ba.NPDController(gait.constraint)))
    bare = ba.ModelErrors(mass={"torso": 0.3}).apply(ba.Biped.load("rabbit", "tac2003"))
    other = ba.NPDController(gait.constraint, ba.Gains(100.0, 20.0))
    light = ba.ModelErrors(mass={"shin": -0.1}).apply(biped)
    second = program(Walker(light, other, torque_limit=9.0))
    assert second.machine is first.machine
    assert not np.array_equal(second.K, first.K)
    third = program(Walker(bare, other))  # another preset of the robot has a program too
    assert third.numbers.plant.n == 5


@pytest.mark.parametrize("pose", [0.0, np.pi])
def test_a_tree_that_is_right_in_one_pose_alone_is_refused(biped, pose):
    """One link of the swing leg is too long and another too short: the errors of the swing foot cancel in one
    pose. The check against Pinocchio uses several, so it finds them.
    """
    robot = robot_of(biped)
    wrong = np.zeros(biped.n)
    # errors 0.1 (cos a_1, -cos a_0) of the lengths of links 0 and 1: their sum with cos a_0, cos a_1 is 0 here
    wrong[:2] = 0.1 * np.cos(pose * robot.A.sum(axis=1))[1::-1] * (1.0, -1.0)
    off = replace(robot, K=robot.K._replace(foot_re=robot.K.foot_re + wrong))
    with pytest.raises(ModelError, match="the swing foot in absolute angles differs"):
        off.check(biped)


def test_what_was_traced_is_forgotten_where_it_is_machine_code(biped, gait, monkeypatch):
    """Expressions of a walker take megabytes, and each tracing makes classes of its own. None of its tracers
    may live on in the walker, in the program or in a cache by class. Nothing is found in memory or on disk, so
    all is traced here.
    """
    monkeypatch.setattr("biped_adrc.engine.generated.from_disk", lambda key, make: make())
    monkeypatch.setattr("biped_adrc.engine.generated._IN_MEMORY", {})
    # 1.1 ms: a period of no other test, so that no part remembers a walker with it
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=SampledTime(1.1e-3))
    traced = []
    init = Tracer.__init__
    monkeypatch.setattr(Tracer, "__init__", lambda self: (init(self), traced.append(ref(self)))[0])
    walk = ba.walk(walker, gait, impacts=1, method=ba.RK4(1.1e-3))
    assert walk.signals.t.size
    gc.collect()
    assert traced
    assert not any(tracer() for tracer in traced)
