"""A recorded push: the file's lines between rows, its work, and what is said of files that are none."""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.disturbances.recorded import PIECES, RecordedTorque
from biped_adrc.scenario.build import build

from .conforms import written


def test_a_recording_is_interpolated_linearly_and_its_impulse_is_that_of_trapezoids(biped):
    """NumPy's interpolation between the rows, in single support 2 from its start at 1 s plus 0.01 s; zero
    before the first row and from the last on. The sum of widths times values in the middle is that of
    trapezoids.

    Recordings are cut into terms of PIECES pieces: 3 PIECES + 5 rows make more than three.
    """
    random = np.random.default_rng(2)
    times = np.cumsum(random.uniform(0.001, 0.02, 3 * PIECES + 5))
    torques = 20.0 * random.normal(size=(len(times), 5))
    recorded, still = RecordedTorque(times, torques, step=2, start=0.01), np.zeros(5)
    inside = np.linspace(times[0], times[-1] - 1e-9, 400)
    found = [recorded.zeta(1.01 + t, 2, 1.0, still, still) for t in inside]
    expected = np.array([np.interp(inside, times, column) for column in torques.T]).T
    assert np.max(np.abs(found - expected)) < 1e-11
    middles = [
        recorded.zeta(1.01 + t, 2, 1.0, still, still) for t in 0.5 * (times[1:] + times[:-1])
    ]
    impulse = np.diff(times) @ np.array(middles)
    assert impulse == pytest.approx(
        np.diff(times) @ (0.5 * (torques[1:] + torques[:-1])), rel=1e-12
    )
    for t, step in ((1.01 + times[0] - 1e-9, 2), (1.01 + times[-1], 2), (1.1, 1)):
        assert not np.any(recorded.zeta(t, step, 1.0, still, still))


def test_columns_are_joints_by_either_name(biped):
    """The column of q2 has its joint's name, right_hip; values are linear between the rows, an empty line is
    skipped, and the torque is zero from the last row on. It begins 0.2 s after the start of step 3, at 7 s.
    """
    file, still = written("q5,t,right_hip\n1,0,-2\n5,.4,-2\n\n5,.5,6"), np.zeros(5)
    made = RecordedTorque.read(file, biped, 3, 0.2)
    # t = 0.2 + 0 s, 0.1 s and 0.45 s of the file
    for t, expected in ((0.2, (1.0, -2.0)), (0.3, (2.0, -2.0)), (0.65, (5.0, 2.0))):
        zeta = made.zeta(7.0 + t, 3, 7.0, still, still)
        assert zeta[[4, 1]] == pytest.approx(expected)
        assert np.count_nonzero(zeta) == 2
    assert np.array(made.switches) == pytest.approx(np.array([[3, 0.2], [3, 0.7]]))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("q1,q2\n0,1\n1,2", "expected one 't'"),
        ("t,q1\n0,1", r"times of shape \(1,\)"),
        ("t,q1\n0,1\n0,2", "row 2 of the recording has t = 0 s"),
        ("t,q1\n0,nan\n1,2", "line 2, column 'q1': found 'nan'"),
        ("t,q1\n0,1\n1,2,3", "line 3 has 3 entries"),
        ("t,q1,q1\n0,1,1\n1,2,2", "expected one 't'"),
        ("t,q9\n0,1\n1,2", "no joint 'q9'"),
    ],
)
def test_wrong_files_of_recordings_are_refused_by_name(biped, text, message):
    with pytest.raises(ba.BipedError, match=message) as raised:
        RecordedTorque.read(written(text), biped)
    assert "given.csv" in str(raised.value)


def test_a_recording_is_named_in_a_scenario_and_refused_without_its_file():
    """A recording goes on over impacts, so the times of its jumps, at the first row and at the last one, count
    from the start of the walk: (0, seconds). Its onset is 0.05 s.
    """
    file, named = (
        str(written("t,q1\n0,0\n0.1,20\n0.3,0\n")),
        {"shape": "recorded", "step": 1, "onset": 0.05},
    )

    def made(**more):
        return build(ba.Scenario("NPD", pushes=[named | more])).disturbance

    assert made(file=file).switches == ((0, 0.05), (0, 0.35))
    for more, message in (
        ({"file": file, "torque": 3.0}, r"pushes\.0\.torque: the push 'recorded' takes no torque"),
        ({}, "needs file"),
        ({"file": "gone.csv"}, r"gone\.csv' not found"),
    ):
        with pytest.raises(ba.BipedError, match=message):
            made(**more)
