"""Signals of compiled runs: the compiled columns against those that Python computes from the same states.

Signals are columns over the nodes (stored instants) of a run, such as torques and errors. `walked` is a run of
two steps, `see` its columns by machine code, and `compare` asserts that they are Python's to 1e-10 of each
column's largest number, NaN in the same places.
"""

from dataclasses import fields, replace
from functools import partial

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.signals import compiled_readings, signals, signals_of
from biped_adrc.closed_loop.walker import Mode
from biped_adrc.engine.run import simulate_by
from biped_adrc.gait.reference import TimeReference

simulate = partial(simulate_by, "compiled")

EXACT = 1e-10
"""Largest difference of a column, as a share of its largest number."""
PUSH = ba.TorqueSine((5.0, 0.0, -3.0, 2.0, 1.0), 1, 0.05, 0.3, frequency=7.0) + ba.TorquePulse(
    (30.0, 0.0, -10.0, 5.0, 3.0), 1, 0.1003, 0.1007
)


def walked(walker, gait, impacts=2, every=1):
    x0 = walker.initial_state(*gait.start(walker.nominal))
    method = ba.RK4(2e-3) if walker.sampled or not x0[10:].size else ba.Exponential(2e-3)
    return simulate(walker, x0, Mode(), method, t_end=4.0, impacts=impacts, store_every=every)


def see(walker, trajectory, reference):
    """All columns, from compiled code; None where a part has no compiled form."""
    found = compiled_readings(walker, trajectory, reference)
    if found is None:
        return None
    s = signals_of(walker, trajectory, found)
    return [getattr(s, field.name) for field in fields(s)]


def in_python(walker, trajectory, reference):
    bare = replace(trajectory, settings={**trajectory.settings, "engine": "pinocchio"})
    return signals(walker, bare, reference)


def compare(walker, trajectory, reference):
    assert trajectory.settings["engine"] == "compiled"
    columns = see(walker, trajectory, reference)
    expected = in_python(walker, trajectory, reference)
    assert len(columns) == len(fields(expected))
    for field, found in zip(fields(expected), columns, strict=True):
        column = getattr(expected, field.name)
        assert found.shape == column.shape, field.name
        assert np.array_equal(np.isnan(found), np.isnan(column)), field.name
        # q_b - q_d on the gait is round-off
        sized = expected.q if field.name == "error" else column
        size = np.max(np.abs(sized), initial=0.0, where=~np.isnan(sized))
        gap = np.max(np.abs(found - column), initial=0.0, where=~np.isnan(column))
        assert gap <= EXACT * size, (field.name, gap, size)
    return expected


def controllers(gait):
    adrc = ba.ADRCController(gait.constraint, ba.GPIObserver.from_bandwidth(300.0))
    return {"NPD": ba.NPDController(gait.constraint), "ADRC": adrc}


@pytest.mark.parametrize("name", ["NPD", "ADRC"])
@pytest.mark.parametrize("sampled", [False, True], ids=["continuous", "sampled"])
def test_compiled_signals_are_those_of_python(biped, gait, name, sampled):
    """The signals are compared in both time bases, in a walk of two steps in which pushes and the torque limit
    show; NPD has no estimate, so its columns of xi_estimate are NaN.
    """
    time = ba.SampledTime(1e-3) if sampled else ba.ContinuousTime()
    walker = ba.Walker(biped, controllers(gait)[name], PUSH, time, torque_limit=80.0)
    s = compare(walker, walked(walker, gait), gait.constraint)
    # the columns are those of a walk of two steps in which an observer, pushes and the torque limit show
    assert np.all(np.isnan(s.xi_estimate)) == (name == "NPD")
    assert np.max(np.abs(s.zeta)) >= 30.0
    assert np.max(s.foothold) > 0.3
    assert np.max(np.abs(s.u)) <= 80.0


def test_columns_on_a_slope_with_a_wrong_model_and_friction(biped, gait):
    """The columns are Python's also where nodes are kept at every fifth integration step alone. A step down of
    2 mm on a slope that falls puts the foothold deeper than that.
    """
    rough = ba.ModelErrors(mass={"torso": 0.05}).apply(ba.Biped.load("rabbit", friction=True))
    walker = ba.Walker(rough, controllers(gait)["ADRC"], model=biped, slope=0.02)
    walker = replace(walker, ground_steps=(ba.StepDown(1, 0.002),))
    s = compare(walker, walked(walker, gait, every=5), gait.constraint)
    assert np.min(s.foothold_height) < -0.002


def test_what_has_no_compiled_form_is_left_to_python(biped, gait):
    """A reference that branches on the time has no machine code, so `see` gives None and Python the signals. It
    is zero here, so the error is the angle.
    """
    walker = ba.Walker(biped, controllers(gait)["NPD"])
    run = walked(walker, gait, impacts=1)
    flat = TimeReference(lambda t: (np.zeros(4) if t < 9.0 else np.ones(4),) * 3)
    assert see(walker, run, flat) is None
    assert np.array_equal(signals(walker, run, flat).error, signals(walker, run, flat).q[:, :4])


def test_the_power_of_the_motors_is_the_energy_s_rate(biped, gait):
    """d(T + V)/dt = q_b' u + q' zeta from the columns alone; the trapezoidal rule over 0.25 ms leaves 1e-5.
    PUSH begins at 0.05 s, so it acts over the last third.
    """
    walker = ba.Walker(biped, controllers(gait)["ADRC"], PUSH)
    x0 = walker.initial_state(*gait.start(biped))
    run = simulate(walker, x0, Mode(), ba.RK4(2.5e-4), t_end=0.075)
    s = signals(walker, run, gait.constraint)
    power = np.sum(s.v[:, :4] * s.u, axis=1) + np.sum(s.v * s.zeta, axis=1)
    gained = np.diff(s.kinetic + s.potential)
    work = np.diff(s.t) * 0.5 * (power[1:] + power[:-1])
    assert np.max(np.abs(gained - work)) < 1e-5 * np.max(np.abs(power))
