"""Sensors and a touchdown detector of one's own, in plain Python: compiled, they walk as in Python.

`walked` walks two steps with this hardware by the engine "compiled" (machine code) or "pinocchio" (Python).
`Slow` is a user's low-pass, `Tilted` one with a bias of the pitch, and `Undecided` is that with a branch on an
angle.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import InputError
from biped_adrc.engine.program import numbers_of
from biped_adrc.engine.structure import structure
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hardware.sensors import PitchSensor
from biped_adrc.hardware.touchdown import ByKinematics, FaultyTouchdown

CLOCK = ba.SampledTime(1e-3, restart=False)


@dataclass(frozen=True)
class Slow(Sensor):
    """Angles through a low-pass of time constant 1 / rate [s]; the rates are true."""

    rate: float = 500.0

    def start(self, q, v):
        return q

    def sense(self, w, q, v):
        share = min(1.0, self.rate * CLOCK.period)
        return w + share * (q - w)

    def impact(self, w, q, v, v_model):
        return q

    def reading(self, w, q, v):
        return w, v


@dataclass(frozen=True)
class Tilted(Sensor):
    """A sensor without memory whose pitch has a bias [rad]."""

    bias: float = 1e-3

    def reading(self, w, q, v):
        off = np.zeros(len(q))
        off[-1] = self.bias
        return q + off, v


@dataclass(frozen=True)
class Twice(ba.Touchdown):
    """A detector that fires when the foot is below `height` [m] at two ticks in a row, 0.1 s after a
    touchdown."""

    height: float = 2e-3

    def start(self):
        return np.zeros(1)

    def notice(self, d, look):
        low = np.where((look.foot[1] < self.height) * (look.t_step > 0.1), 1.0, 0.0)
        fires = low * d[0]
        return np.array([low - fires]), fires


@dataclass(frozen=True)
class Undecided(Tilted):
    """A sensor that branches on an angle, so that it has no machine code."""

    def reading(self, w, q, v):
        if q[0] > 10.0:
            return q, v
        return super().reading(w, q, v)


def walked(biped, gait, engine, **hardware):
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=CLOCK, **hardware)
    run = ba.walk(walker, gait, impacts=2, engine=engine).trajectory
    assert run.status is ba.Status.COMPLETED
    return run


@pytest.mark.parametrize(
    "hardware",
    [
        {"sensors": ba.Sensors(2e5, noise=1e-6) + Slow() + Tilted()},
        {"touchdown": Twice()},
    ],
    ids=["sensors", "touchdown"],
)
def test_one_s_own_hardware_is_compiled_as_it_is(biped, gait, hardware):
    """The hardware is a sum of encoders and two sensors of the user, and a detector of his: machine code walks
    as Python, touchdowns within 1 ns.
    """
    code, python = (walked(biped, gait, each, **hardware) for each in ("compiled", "pinocchio"))
    assert code.settings["engine"] == "compiled"
    assert abs(code.t_end - python.t_end) < 1e-9
    np.testing.assert_allclose(code.final_state, python.final_state, rtol=1e-7, atol=1e-7)


def test_a_sensor_that_decides_by_a_number_runs_in_python_and_its_line_is_named(biped, gait):
    """A branch on an angle has no machine code, so the sensor is called in Python beside a compiled plant; its
    branch is never taken, so the walk is that of `Tilted`.
    """
    run = walked(biped, gait, "compiled", sensors=Undecided())
    assert run.settings["engine"] == "compiled plant"
    assert "Undecided.reading (test_own.py" in run.settings["why"]
    expected = walked(biped, gait, "compiled", sensors=Tilted())
    np.testing.assert_allclose(run.final_state, expected.final_state, rtol=1e-7, atol=1e-7)


def test_other_numbers_compile_nothing(biped, gait):
    """Seeds, errors and times are data of the machine code: walkers that differ in them have one `structure`,
    by which code is found; another class of detector has another.
    """

    def key(sensors, touchdown):
        law = ba.NPDController(gait.constraint)
        walker = ba.Walker(biped, law, timing=CLOCK, sensors=sensors, touchdown=touchdown)
        return structure(numbers_of(walker))

    noisy, told = ba.Sensors(8192, noise=1e-4, seed=1) + Slow(), FaultyTouchdown(missed=0.1, seed=1)
    other = ba.Sensors(4096.5, noise=1e-3, filter_time=1e-3, seed=2) + Slow(100.0)
    usual = key(noisy, told)
    # late by 10 ms, 20 % missed, a false one 0.2 s after the start of single support 3, seed 5
    assert usual == key(other, FaultyTouchdown(0.01, 0.2, (3, 0.2), 5))
    assert usual == key(noisy, replace(told, seed=4))
    assert usual != key(noisy, ByKinematics())


@dataclass(frozen=True)
class Lost(Tilted):
    """A sensor whose angles are NaN once a joint turns faster than 1.9 rad/s, as none does at the start."""

    def reading(self, w, q, v):
        if np.max(np.abs(v)) > 1.9:
            return q * np.nan, v
        return q, v


@pytest.mark.parametrize("engine", ["compiled", "pinocchio"])
def test_a_sensor_that_loses_its_numbers_on_the_way_is_named(biped, gait, engine):
    """NaN from the first instant at which a joint turns faster than 1.9 rad/s, as none does at the start: the
    walk ends and names the method that gave it.
    """
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=CLOCK, sensors=Lost())
    assert np.max(np.abs(gait.start(biped)[1])) < 1.9
    run = ba.walk(walker, gait, impacts=2, engine=engine).trajectory
    assert not run.status.ok
    assert "Lost.reading" in run.detail


def test_a_sensor_before_the_encoders_is_refused():
    """They read the state itself, and lost what stood before them."""
    for first in (Slow(), Slow() + Tilted()):
        with pytest.raises(InputError, match="Sensors reads the state itself, so it comes first"):
            first + ba.Sensors(8192)


def test_a_sensor_of_one_s_own_has_no_noise_and_its_computer_is_that_of_the_others():
    """Defaults of the base class: no noise, itself without noise, errors as before it. `on_computer` is the
    software part: encoders with another sensor for the rates need no differences, and a pitch sensor has none.
    """
    tilted, before = Tilted(), np.ones(4)
    assert (tilted.noisy, tilted.smooth(), tilted.errors(2, 1, before) is before) == (
        False,
        tilted,
        True,
    )
    # argument of on_computer: the software of the sensors before it, None where there is none
    pitch = PitchSensor(noise=1e-3)
    both = ba.Sensors(velocity="differences") + pitch
    assert both.on_computer(None) == ba.Sensors(velocity="gyro")
    assert pitch.on_computer(before) is before
    with pytest.raises(InputError, match="a low-pass on angles needs rates by differences"):
        ba.Sensors(velocity="measured", angle_filter=1e-3).on_computer(None)
    # deviations of (q1, q2, v1, v2): q2 is the pitch, whose rate this sensor measures without noise
    assert pitch.errors(2, 1, before).tolist() == [1.0, 1e-3, 1.0, 0.0]
