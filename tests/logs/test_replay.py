"""What a replay shows: the walk's own torques again, and disturbances that are known.

A replay feeds the log of a walk to the controller of a scenario, without a simulation. Fixtures:
walked(**values), a walk of three steps of this scenario, under a pulse of 20 N m on both hips in the second
single support; log, of such a walk with exact sensors at 1 kHz. asked(walk, log) is the replay's signals, where
u is the torque in the log and torque the one that the controller asks for.
"""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import cont2discrete, dlsim

import biped_adrc as ba
from biped_adrc.core.errors import InputError
from biped_adrc.extras.logs.robot_log import logged

LESO = {"controller.name": "LESO", "controller.observer.bandwidth": 160.0}
RABBIT = {"hardware.profile": "rabbit", "hardware.encoders.filter_time": 5e-3}
ROUND_OFF = 1e-9
"""Largest difference of torques [N m]: round-off of walk and replay, amplified by these observers."""


def asked(walk, log=None):
    """The replay of a walk by its own scenario."""
    return ba.replay(logged(walk) if log is None else log, walk.scenario).signals


@pytest.mark.parametrize(
    "values",
    [
        {"controller.name": "NPD", "hardware.period": 1e-3},
        {**LESO, **RABBIT},
        {**LESO, "hardware.period": 1e-3, "hardware.touchdown.name": "kinematics"},
        {"controller.name": "DOB", "hardware.period": 1e-3},
        {**LESO, "hardware.profile": "rabbit", "ground.plant": "mujoco"},
    ],
    ids=lambda values: "-".join(f"{x}" for x in values.values()),
)
def test_the_torque_asked_for_is_the_one_that_the_walk_had(walked, values):
    """x.torque, which the controller asks for when it is fed with the log alone, is x.u, the torque in the log.
    From the second single support on, since the first state of an observer behind encoders was the true one in
    the walk. A replay with other memory, clock or labels would differ.
    """
    x = asked(walked(**values))
    later = x.step > 1
    assert len(np.unique(x.step[later])) == 2
    assert np.max(np.abs(x.torque - x.u)[later]) < ROUND_OFF


def test_a_known_delay_of_one_period_moves_the_torques_by_one_row(walked):
    """The torque asked for in row k acts, and is logged, in row k + 1. In the same row both differ by more than
    1 N m. Rows at an impact, where the clock starts anew, are left out.
    """
    x = asked(
        walked(
            **LESO,
            **{"hardware.period": 1e-3, "hardware.delay": 1e-3, "hardware.delay_known": True},
        )
    )
    same = np.diff(x.step) == 0.0
    assert np.max(np.abs(x.torque[:-1] - x.u[1:])[same]) < ROUND_OFF
    assert np.max(np.abs(x.torque[:-1] - x.u[:-1])[same]) > 1.0


def test_rates_that_the_log_has_not_are_those_of_the_encoders(walked):
    """From the angles alone (v None) the replay finds the filtered rates of the walk, and the same torques.
    Without the walk's filter they are noisier. One measured rate beside four found ones changes no torque.
    """
    walk = walked(**LESO, **RABBIT)
    log = logged(walk)
    x, y = asked(walk), asked(walk, replace(log, v=None, measured=None))
    later = x.step > 1
    assert np.max(np.abs(x.torque - y.torque)[later]) < ROUND_OFF
    assert np.max(np.abs(x.v - y.v)[later]) < ROUND_OFF
    faster = ba.replay(replace(log, v=None, measured=None), walk.scenario, filter_time=0.0).signals
    assert np.std(np.diff(faster.v, axis=0)) > 2.0 * np.std(np.diff(x.v, axis=0))
    mixed = asked(walk, replace(log, measured=[0.0, 0.0, 0.0, 0.0, 1.0]))
    assert np.max(np.abs(x.torque - mixed.torque)[later]) < ROUND_OFF


LEGS = "if the other leg stands"
ANGLES, TORQUES = "all angles have the other sign", "all torques have the other sign"
WRONG = {
    LEGS: lambda log, R: {"q": log.q @ R.T, "u": log.u[:, [1, 0, 3, 2]]},
    f"if {TORQUES}": lambda log, R: {"u": -log.u},
    f"if {ANGLES}:": lambda log, R: {"q": -log.q},
    f"if {ANGLES} and {TORQUES}": lambda log, R: {"q": -log.q, "u": -log.u},
    "if all angles are in degrees": lambda log, R: {"q": np.degrees(log.q)},
    "if all angles are in radians": lambda log, R: {"q": np.radians(log.q)},
}
"""What a log was taken for by mistake, and by which words it is refused."""
OFF = {
    f"errors.{what}.{body}": e
    for what in ("mass", "inertia")
    for body, e in (("torso", -0.3), ("thigh", 0.3), ("shin", 0.3))
}
LOGGED = {
    "exact": {"hardware.period": 1e-3},
    "encoders and a late motor": RABBIT | {"hardware.lag": 2e-3},
    "masses 30 % off": RABBIT | OFF,
    "noise": {**RABBIT, "hardware.encoders.noise": 5e-4},
    "soft ground": {"hardware.period": 1e-3, "ground.plant": "mujoco"},
    "a slow clock": {"controller.name": "PD", "hardware.period": 5e-3},
}


@pytest.mark.parametrize("values", LOGGED.values(), ids=LOGGED)
def test_a_log_in_another_reading_is_refused_by_the_one_that_fits(walked, values):
    """The log as it is has no remark under any of LOGGED, also where sensors, masses or ground differ from the
    model. Each mistake of WRONG in its numbers is refused, and the message names the correction that undoes it.
    """
    walk = walked(**values, **{"run.impacts": 2})
    log = replace(logged(walk), v=None, measured=None)
    assert ba.replay(log, ba.Scenario("NPD")).remarks == ()
    for said, change in WRONG.items():
        wrong = replace(log, **change(log, walk.walker.nominal.R))
        with pytest.raises(InputError, match=f"off {re.escape(said)}"):
            ba.replay(wrong, ba.Scenario("NPD"))


def test_a_log_that_fits_in_no_reading_has_a_remark(log):
    """With the torques in the wrong order no reading fits, and nothing can be proposed."""
    (said,) = ba.replay(replace(log, u=log.u[:, ::-1]), ba.Scenario("NPD")).remarks
    assert "look at the order, signs and units of its columns" in said


def test_rates_that_the_log_has_not_begin_as_its_first_difference(log):
    """Without a filter a rate is the difference of each two rows of a single support, and in the first row that
    of the first two. Measured rates (1 in `measured`) are kept as they are.
    """
    bare = replace(log, v=None, measured=None)
    x = ba.replay(bare, ba.Scenario("NPD"), filter_time=0.0).signals
    rows = np.flatnonzero(np.diff(log.step) == 0.0)
    slopes = np.diff(log.q, axis=0) / np.diff(log.t)[:, np.newaxis]
    np.testing.assert_allclose(x.v[rows + 1], slopes[rows], rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(x.v[0], slopes[0], rtol=0.0, atol=1e-9)
    some = replace(log, measured=[1.0, 0.0, 1.0, 0.0, 1.0])
    y = ba.replay(some, ba.Scenario("NPD"), filter_time=0.0).signals
    np.testing.assert_array_equal(y.v[:, ::2], log.v[:, ::2])
    np.testing.assert_allclose(y.v[0, 1::2], slopes[0, 1::2], rtol=0.0, atol=1e-9)


# -- disturbances that are known ---------------------------------------------------------------------
def pulse(x):
    """zeta (K, p) [N m] of `conftest.PULSE` that acts from each row of a replay to the next."""
    on = (x.step == 2) & (x.t_step >= 0.1 - 1e-9) & (x.t_step < 0.3 - 1e-9)
    return np.where(on[:, np.newaxis], [20.0, 20.0, 0.0, 0.0], 0.0)


def lagged(x, period, bandwidth, order):
    """x (K, p) behind (bandwidth / (s + bandwidth))^order, from rest."""
    A = bandwidth * (np.eye(order, k=-1) - np.eye(order))
    B, C = bandwidth * np.eye(order)[:, :1], np.eye(order)[-1:]
    *system, _ = cont2discrete((A, B, C, np.zeros((1, 1))), period)
    return np.column_stack([dlsim((*system, period), y)[1][:, 0] for y in x.T])


def missed(walk, controller, order, bandwidth, unit):
    """Of the second single support the rms by which the estimate is off the lagged pulse, and off the pulse.

    unit: "N m", or "rad/s^2" for an observer that filters kappa zeta.
    """
    period = walk.scenario.hardware.period
    x = ba.replay(
        logged(walk), ba.Scenario({"name": controller, "observer": {"bandwidth": bandwidth}})
    ).signals
    found, true = x.zeta_estimate, pulse(x)
    if unit == "rad/s^2":
        model = walk.walker.nominal
        kappa = [model.reduction(q, v).kappa for q, v in zip(x.q, x.v, strict=True)]
        found, true = (np.einsum("kij,kj->ki", kappa, y) for y in (found, true))
    rows = x.step == 2
    found, true = found[rows], true[rows]
    expected = lagged(true, period, bandwidth, order)
    return [float(np.sqrt(np.mean((found - y) ** 2))) for y in (expected, true)]


@pytest.mark.parametrize(
    ("controller", "order", "unit"), [("DOB", 2, "N m"), ("ADRC assisted", 3, "rad/s^2")]
)
def test_the_estimate_is_the_pulse_behind_the_observers_own_lag(walked, controller, order, unit):
    """The estimate of a known pulse is the pulse behind (w / (s + w))^order, w = 100 rad/s: order 2 with the
    two poles of the momentum observer, 3 with m = 1. It is off this by less than a tenth of what it is off the
    pulse itself, and half the period halves that (first order in T).
    """
    walks = [walked(**{"hardware.period": T, "run.impacts": 2}) for T in (4e-3, 2e-3, 1e-3)]
    errors = [missed(walk, controller, order, 100.0, unit) for walk in walks]
    off, late = np.array(errors).T
    assert np.all(off < 0.1 * late)
    assert np.all((off[:-1] / off[1:] > 1.6) & (off[:-1] / off[1:] < 2.5))


def test_in_mujoco_the_pulse_is_found_beside_the_contact(walked):
    """The estimate is 20 N m on both hips within 1 N m, from 50 ms after the pulse's onset on. Right after the
    touchdown it has more than 100 N m of contact on soft ground alone, whose forces the rigid model does not
    know.
    """
    soft, rigid = (
        walked(**{"hardware.period": 1e-3, "run.impacts": 2, "ground.plant": x})
        for x in ("mujoco", "rigid")
    )
    found = ba.replay(logged(soft), ba.Scenario("DOB"))
    x = found.signals
    rows = (x.step == 2) & (x.t_step > 0.15) & (x.t_step < 0.3)
    assert np.allclose(
        np.mean(x.zeta_estimate[rows], axis=0), [20.0, 20.0, 0.0, 0.0], rtol=0.0, atol=1.0
    )
    assert found.rows[1].contact > 100.0  # the rigid model knows no force of contact
    assert ba.replay(logged(rigid), ba.Scenario("DOB")).rows[1].contact < 1.0


def test_the_parts_of_the_estimate_make_the_whole(log):
    """The estimate is nominal model + contact (in the window of 0.03 s after a touchdown) + model error
    (outside of it); a row's numbers are rms values and maxima over the second single support, computed here
    again.
    """
    found = ba.replay(log, ba.Scenario(**LESO), window=0.03)
    x = found.signals
    assert np.allclose(x.xi_nominal + x.xi_model_error + x.xi_contact, x.xi_estimate)
    inside = (x.step > 1) & (x.t_step < 0.03)
    assert np.any(x.xi_contact[inside])
    assert not np.any(x.xi_contact[~inside])
    assert not np.any(x.xi_model_error[inside])
    # the second panel of the figure has the residual in mrad, with gaps (NaN) at impacts
    residual = [line.get_ydata() for line in found.plot().axes[1].lines]
    for y, known in zip(residual, 1e3 * x.residual.T, strict=True):
        np.testing.assert_array_equal(y[np.isfinite(y)], known)
    row = found.rows[1]
    rows = (x.step == 2) & ~inside
    assert row.beyond == pytest.approx(np.sqrt(np.mean(x.zeta_estimate[rows] ** 2, axis=0)).max())
    assert row.contact == np.abs(x.zeta_estimate[inside & (x.step == 2)]).max()
    assert row.residual == pytest.approx(
        np.sqrt(np.mean(x.residual[x.step == 2] ** 2, axis=0)).max()
    )
    assert row.most_apart == np.abs(x.torque - x.u)[x.step == 2].max()


def test_the_plot_has_the_torque_of_the_log_beside_the_one_asked_for(log):
    """The third panel has a line of both for each motor; the legend has "in the log" once."""
    found = ba.replay(log, ba.Scenario(**LESO))
    panel, x = found.plot().axes[2], found.signals
    lines = [line.get_ydata() for line in panel.lines]
    for torque in (x.u, x.torque):
        for joint in torque.T:
            assert any(np.array_equal(y[np.isfinite(y)], joint) for y in lines)
    assert [text.get_text() for text in panel.get_legend().get_texts()].count("in the log") == 1


def test_without_an_observer_nothing_is_estimated(log):
    """NPD has none: the estimate is NaN, its column of the table a dash, and torques are there all the same."""
    found = ba.replay(log, ba.Scenario("NPD"))
    assert np.isnan(found.signals.xi_estimate).all()
    assert np.isfinite(found.signals.torque).all()
    assert found.text().splitlines()[1].split()[2] == "-"
    found.plot()


def test_another_period_is_resampled_and_said(log):
    """From 1 ms to 2 ms each second row stays, and a torque is the mean of the two that were held in its
    period.
    """
    plain = replace(log, t=log.t, remarks=())
    found = ba.replay(plain, ba.Scenario(hardware={"period": 2e-3}, **LESO))
    first = found.log.step == 1
    rows = np.flatnonzero(log.step == 1)[::2]
    assert np.allclose(found.log.q[first], log.q[rows], rtol=0.0, atol=1e-12)
    pairs = 0.5 * (log.u[rows] + log.u[rows + 1])
    # without the last pair, which may reach into the next single support
    assert np.allclose(found.log.u[first][:-1], pairs[:-1], rtol=0.0, atol=1e-9)
    assert "resampled from 0.001 s to 0.002 s" in found.remarks[0]
    assert ba.replay(plain, ba.Scenario(hardware={"period": 1e-3}, **LESO)).remarks == ()


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda log: ba.replay(log, ba.Scenario("passive", robot="compass")), "0 motors"),
        (lambda log: ba.replay(log, ba.Scenario(robot="three_link", gait="x")), "gait"),
        (
            lambda log: ba.replay(
                replace(log, q=log.q[:, :3], v=None, measured=None), ba.Scenario()
            ),
            "3 angles",
        ),
    ],
)
def test_what_cannot_be_replayed_is_refused(log, call, said):
    """A robot without motors, a gait that does not exist, and a log with three angles of five."""
    with pytest.raises(InputError, match=said):
        call(log)
