"""Return maps on the compiled engine against those on Pinocchio.

A return map P takes the section coordinates s just before an impact to those before the next: the state without
the coordinate that the ground fixes. `maps(walker, method)` are the compiled P and Pinocchio's, `section` a
state near the gait's own before impact, and `has_compiled_form(P)` says which engine runs it.
"""

from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.return_map import ReturnMap


def has_compiled_form(P):
    q = np.zeros(P.walker.plant.n)
    return P.compiled(P.walker.initial_state(q, q)) is not None


def maps(walker, method, **more):
    """The compiled map and Pinocchio's."""
    return [ReturnMap(walker, method, engine=e, **more) for e in ("compiled", "pinocchio")]


def section(gait, walker, seed=2, size=1e-3):
    """A point near the gait's own passage; controller's states as they start there."""
    random = np.random.default_rng(seed)
    q, v = gait.q_minus, gait.v_minus
    x = walker.initial_state(q, v)
    x[: len(q) * 2] += size * random.normal(size=2 * len(q))
    return x


@pytest.fixture(scope="module")
def npd(biped, gait):
    return ba.Walker(biped, ba.NPDController(gait.constraint))


@pytest.fixture(scope="module")
def adrc(biped, gait):
    observer = ba.GPIObserver.from_bandwidth(300.0)
    policy = ba.ResetPolicy.RELABEL
    return ba.Walker(biped, ba.ADRCController(gait.constraint, observer, reset=policy))


def test_value_jacobian_and_fixed_point(gait, npd):
    """P(s), three of nine columns of dP/ds (an angle, two rates) by differences, and the fixed point, which
    Pinocchio's map leaves where it is.
    """
    compiled, python = maps(npd, ba.RK4(5e-3))
    assert has_compiled_form(compiled)
    assert not has_compiled_form(python)
    s = compiled.project(section(gait, npd))
    assert np.max(np.abs(compiled(s) - python(s))) < 1e-10
    J, d = compiled.jacobian(s), python.difference
    for column, e in zip((0, 5, 8), np.eye(9)[[0, 5, 8]], strict=True):
        expected = (python(s + d * e) - python(s - d * e)) / (2.0 * d)
        assert np.max(np.abs(J[:, column] - expected)) < 1e-6 * max(1.0, np.max(np.abs(expected)))
    orbit = compiled.fixed_point(section(gait, npd, size=1e-4))
    assert orbit.residual < 1e-9
    assert orbit.stable
    again = python(python.project(orbit.x_minus))
    assert np.max(np.abs(again - python.project(orbit.x_minus))) < 1e-8


def test_an_observer_s_states_are_coordinates(gait, adrc):
    """RELABEL keeps the observer's states over the impact, so P depends on them: 9 + 3 states of 4 joints.

    With controller_states=False the observer is started anew at each impact, and P has 9 coordinates.
    """
    compiled, python = maps(adrc, ba.Exponential(2e-3))
    assert has_compiled_form(compiled)
    x = section(gait, adrc)
    s = compiled.project(x)
    assert s.shape == (9 + 12,)
    value = compiled(s)
    assert np.max(np.abs(value - python(s)) / np.maximum(1.0, np.abs(value))) < 1e-6
    moved = s.copy()
    moved[9:13] += 1e-3
    assert np.max(np.abs(compiled(moved) - value)) > 1e-9
    J = compiled.jacobian(s)
    assert J.shape == (21, 21)
    column = 10  # of one of the observer's states
    d = compiled.difference * np.eye(21)[column]
    difference = (python(s + d) - python(s - d)) / (2.0 * compiled.difference)
    # the maps agree to 1e-6 or better, and a difference divides by 2e-5
    assert np.max(np.abs(J[:, column] - difference)) < 1e-2 * max(1.0, np.max(np.abs(difference)))
    bare, bare_python = maps(adrc, ba.Exponential(2e-3), controller_states=False)
    s = bare.project(x)
    assert s.shape == (9,)
    assert np.max(np.abs(bare(s) - bare_python(s))) < 1e-6


def test_sampled_control_with_its_held_torque(gait, npd):
    """A clock that does not restart at impacts holds a torque over them, so P has four coordinates more."""
    walker = replace(npd, timing=ba.SampledTime(2e-3, restart=False))
    compiled, python = maps(walker, ba.RK4(2e-3))
    assert has_compiled_form(compiled)
    s = compiled.project(section(gait, walker))
    assert s.shape == (9 + 4,)
    assert np.max(np.abs(compiled(s) - python(s))) < 1e-9


def test_bits_do_not_depend_on_how_many_points_there_are(gait, npd):
    """Five images at once, in threads, are those of one point at a time."""
    P = ReturnMap(npd, ba.RK4(5e-3))
    points = [P.project(section(gait, npd, seed)) for seed in range(5)]
    together = P.images(points)
    for s, image in zip(points, together, strict=True):
        assert np.array_equal(P(s), image)
