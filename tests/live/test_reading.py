"""What is seen of a live walk is what the finished walk's signals say of the same node."""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.recorded_signals import FORCE, recorded
from biped_adrc.live.reading import reading


@pytest.mark.parametrize(
    "values",
    [
        {"controller": "ADRC", "hardware": "rabbit", "bandwidth": 160.0, "order": 1, "lag": 1e-3},
        {"controller": "NPD", "pushes": "q2=10@1:0.01-0.3", "mass": {"torso": 1.1}},
        {"controller": "ADRC", "plant": "mujoco", "bandwidth": 160.0, "order": 1},
    ],
    ids=["hardware", "pushed", "mujoco"],
)
def test_it_is_what_the_signals_of_the_walk_say(values):
    session = ba.Session(ba.Scenario(**{"hardware": "ideal", "impacts": 2} | values))
    session.advance(0.02)
    session.push({"q1": 15.0}, force=(-30.0, 5.0), link="right_thigh", seconds=0.1)
    found = []
    for _ in range(5):
        session.advance(0.007)
        nodes = session.sample()[0]
        found.append(reading(session.walking[0], nodes[-1], session.hand))
    walk = session.walk()
    s, force = walk.signals, recorded(walk.trajectory, FORCE)
    for one in found:
        k = int(np.argmax(s.t == one.t))
        assert s.t[k] == one.t
        assert np.array_equal(one.u, s.u[k])
        for name in ("q", "v", "error", "zeta", "xi_estimate"):
            assert getattr(one, name) == pytest.approx(getattr(s, name)[k], abs=1e-9, nan_ok=True)
        assert one.xi == pytest.approx(s.xi[k], rel=1e-9, abs=1e-7)
        assert one.ground == pytest.approx(s.ground_reaction[k], rel=1e-9, abs=1e-6)
        if force is not None:
            assert one.other == pytest.approx(force[k, 2:], abs=1e-9)
    assert np.max(np.abs(found[-1].zeta)) > 14.0
