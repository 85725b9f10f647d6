"""ADRC told the nominal xi: without an error of the model it is NPD, and what is left is its disturbance."""

import numpy as np
import pytest

import biped_adrc as ba

KIND = {
    "controller.name": "ADRC assisted",
    "gait.name": "v0.5",
    "run.impacts": 2,
    "run.engine": "compiled",
}


@pytest.mark.parametrize("order", [0, 1])
def test_on_the_exact_model_it_walks_as_npd(order):
    """In continuous time nothing is left for the observer, so both walks are one to integration accuracy."""
    steps = {
        "run.method": "rk4",
        "run.h": 5e-4,
        "run.impacts": 2,
        "gait.name": "v0.5",
        "start.speed": 0.02,
    }
    npd = ba.walk_scenario(ba.Scenario("NPD", **steps)).trajectory
    told = ba.walk_scenario(
        ba.Scenario(
            {"name": "ADRC assisted", "observer": {"order": order, "bandwidth": 200.0}}, **steps
        )
    ).trajectory
    n = 10
    assert np.max(np.abs(told.final_state[:n] - npd.final_state[:n])) < 1e-8


def test_the_estimate_is_the_whole_disturbance():
    """Under a torque that stays, xi^ of m = 1 is near xi of the plant, where the model alone is not."""
    s = ba.Scenario(
        {"observer": {"bandwidth": 300.0}},
        pushes="q1,q2,q3,q4=10@1:0-9",
        hardware={"period": 1e-3},
        **KIND,
    )
    found = ba.walk_scenario(s).signals
    settled = (found.t > 0.2) & (found.t < 0.3)
    missed = np.abs(found.xi_estimate - found.xi)[settled]
    unknown = np.abs(found.xi_external)[settled]
    assert np.max(missed) < 0.1 * np.max(unknown)


def test_an_order_takes_the_steady_error_away():
    s = {
        **KIND,
        "pushes": "q1,q2,q3,q4=10@1:0-9",
        "hardware.period": 1e-3,
        "controller.observer.bandwidth": 300.0,
    }

    def settled(order):
        found = ba.walk_scenario(ba.Scenario({"observer": {"order": order}}, **s)).signals
        return np.max(np.abs(found.error[(found.t > 0.2) & (found.t < 0.3)]))

    assert settled(1) < 0.1 * settled(0)
