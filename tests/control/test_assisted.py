"""ADRC told the nominal xi: without an error of the model it is NPD, and what is left is its disturbance."""

import numpy as np
import pytest

import biped_adrc as ba

KIND = {"controller.name": "ADRC assisted", "gait.name": "v0.5", "run.impacts": 2}
PUSHED = {"pushes": "q1,q2,q3,q4=10@1:0-9", "hardware.period": 1e-3, "run.engine": "compiled"}


def settled(**more):
    found = ba.walk_scenario(ba.Scenario(**KIND, **PUSHED, **more)).signals
    return found, (found.t > 0.2) & (found.t < 0.3)


@pytest.mark.parametrize("order", [0, 1])
def test_on_the_exact_model_it_walks_as_npd(order):
    """In continuous time nothing is left for the observer, so both walks are one to integration accuracy."""
    law = {"name": "ADRC assisted", "observer": {"order": order, "bandwidth": 200.0}}
    npd, told = (
        ba.walk_scenario(
            ba.Scenario(
                controller,
                gait="v0.5",
                start={"speed": 0.02},
                run={"method": "rk4", "h": 5e-4, "impacts": 2},
            )
        ).trajectory
        for controller in ("NPD", law)
    )
    n = 10
    assert np.max(np.abs(told.final_state[:n] - npd.final_state[:n])) < 1e-8


def test_the_estimate_is_the_whole_disturbance():
    """Under a torque that stays, xi^ of m = 1 is near xi of the plant, where the model alone is not."""
    found, late = settled(**{"controller.observer.bandwidth": 300.0})
    missed = np.abs(found.xi_estimate - found.xi)[late]
    assert np.max(missed) < 0.1 * np.max(np.abs(found.xi_external)[late])


def test_an_order_takes_the_steady_error_away():
    errors = []
    for order in (1, 0):
        found, late = settled(
            **{"controller.observer.order": order, "controller.observer.bandwidth": 300.0}
        )
        errors.append(np.max(np.abs(found.error[late])))
    assert errors[0] < 0.1 * errors[1]
