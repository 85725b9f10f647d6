"""A push by hand, that of a person who drags the walking robot on a page: rows that are held, in both engines,
and what is said of wrong rows.

A row is a time [s] since its single support began, with torques (n,) [N m] on the joints and a force (2,) [N]
on a point of a link.
"""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import InputError
from biped_adrc.disturbances.recorded import PIECES, by_hand


def test_rows_are_held_from_their_times_on_in_one_single_support(biped):
    """From its time on each row acts until the next, in single support 2 alone, which begins at 1 s; its force
    acts as the same force by `OnLink`.

    The rows are cut into terms of PIECES rows; 2 PIECES + 3 rows make two whole ones and a part of a third.
    """
    random = np.random.default_rng(3)
    times = np.cumsum(random.uniform(0.001, 0.01, 2 * PIECES + 3))
    torques, forces = random.normal(size=(len(times), 5)), random.normal(size=(len(times), 2))
    q, v = random.normal(size=(2, 5))
    hand = by_hand(biped, 2, times, torques, "torso", (0.0, 0.3), forces)
    for k, t in enumerate(times):
        for inside in (t, t + 5e-4):
            found = hand.zeta(1.0 + inside, 2, 1.0, q, v)
            force = ba.OnLink(biped, "torso", ba.TorqueStep(np.append(forces[k], 0.0)), (0.0, 0.3))
            assert found == pytest.approx(torques[k] + force.zeta(0.0, 1, 0.0, q, v), abs=1e-12)
            assert hand.net_force(1.0 + inside, 2, 1.0) == pytest.approx(forces[k], abs=1e-12)
    assert not np.any(hand.zeta(1.0 + times[0] - 1e-9, 2, 1.0, q, v))
    assert not np.any(hand.zeta(1.1, 3, 1.0, q, v))
    assert {s for _, s in hand.switches} == {*times}


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ({"times": []}, "times of the hand"),
        ({"times": [0.2, 0.1]}, "increase from 0"),
        (
            {"times": [0.1], "torques": [[1.0, 2.0]]},
            r"torques of the hand have the shape \(1, 2\), expected finite numbers \(1, 5\)",
        ),
        ({"times": [0.1], "on": "torso", "forces": [[1.0, np.inf]]}, "expected finite"),
        ({"times": [0.1], "on": "tail", "forces": [[1.0, 0.0]]}, "tail"),
    ],
)
def test_wrong_rows_are_refused_with_the_reason(biped, rows, said):
    with pytest.raises(ba.BipedError, match=said):
        by_hand(biped, 1, **rows)


def test_a_push_by_hand_takes_no_torque():
    """Its rows have their own `torques`; `torque` is the amplitude of other shapes of pushes."""
    push = {"shape": "hand", "step": 1, "times": [0.1], "torque": 30.0}
    with pytest.raises(InputError, match="takes no torque"):
        ba.walk_scenario(ba.Scenario("NPD", hardware="ideal", pushes=[push]))
