"""The observer that knows the low-pass on an angle, against linear systems written down by hand.

`system(A, ..)` finds the matrix of z' = A z of an observer by its own flow, without a measurement or an input.
"""

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.observers.behind_filter import BehindFilterObserver

TAU, W, T = 3e-3, 160.0, 1.5e-3


@pytest.mark.parametrize("m", [0, 1, 3])
def test_all_poles_are_at_the_bandwidth(m):
    """s^k + a_1 s^(k-1) + .. of the error is (s + w)^k in continuous time, (z - exp(-w T))^k in sampled."""
    o = BehindFilterObserver.from_bandwidth(W, TAU, m)
    k, none = m + 3, np.zeros(1)
    A = np.column_stack([o.flow(z[:, np.newaxis], none, none)[:, 0] for z in np.eye(k)])
    # with the measurement 0 the flow is that of the error, but for the leak of f
    assert np.poly(A / W) == pytest.approx(np.poly(-np.ones(k)), rel=1e-9)
    law = o.sampled(T)
    after = [law.predict(law.correct(z[:, np.newaxis], none), none)[:, 0] for z in np.eye(k)]
    found = np.poly(np.column_stack(after))
    assert found == pytest.approx(np.poly(np.full(k, np.exp(-W * T))), rel=1e-9, abs=1e-12)


def test_behind_the_filter_angle_and_disturbance_have_no_error_in_the_end():
    """A joint under a constant disturbance and a held input, whose angle passes the encoders' low-pass: the
    estimates are the angle before it, its rate and the disturbance; those of GPI lag by about tau q'.
    """
    xi, u, q, v, f, s = 3.0, -2.0, 0.2, 0.5, 0.2, -np.expm1(-T / TAU)
    knows, ignores = (
        o.sampled(T)
        for o in (BehindFilterObserver.from_bandwidth(W, TAU), ba.GPIObserver.from_bandwidth(W))
    )
    z = [o.initial_state(*np.array([[q], [v], [xi]])) for o in (knows, ignores)]
    for _ in range(200):
        q, v = q + T * v + 0.5 * T * T * (xi + u), v + T * (xi + u)
        f += s * (q - f)
        z = [
            o.correct(o.predict(x, np.array([u])), np.array([f]))
            for o, x in zip((knows, ignores), z, strict=True)
        ]
    assert np.ravel(knows.estimate(z[0])) == pytest.approx([q, v, xi], rel=1e-9)
    assert ignores.estimate(z[1]).position[0] - q == pytest.approx(-TAU * v, rel=0.3)


def test_resets_are_those_of_the_chain_before_the_filter():
    """MODEL starts anew; RELABEL exchanges joints and signs; MEASURED takes angle and rate, and the disturbance
    relabelled; NONE keeps all.
    """
    o, swap = BehindFilterObserver.from_bandwidth(W, TAU), np.array([1, 2])
    z = o.initial_state(*np.arange(6.0).reshape(3, 2))
    y, dy, xi = np.array([[0.1, 0.2], [3.0, 4.0], [50.0, 60.0]])
    results = {p.value: o.estimate(o.reset(z, p, swap, y, dy, xi)) for p in ba.ResetPolicy}
    assert np.array(results["model"]) == pytest.approx(np.array([y, dy, xi]))
    # joint 0 takes that of joint 1, joint 1 the negative of joint 0
    assert np.array(results["relabel"]) == pytest.approx(np.array([[1, 0], [3, -2], [5, -4.0]]))
    assert np.array(results["measured"]) == pytest.approx(np.array([y, dy, [5.0, -4.0]]))
    assert np.array(results["none"]) == pytest.approx(np.arange(6.0).reshape(3, 2))


@pytest.mark.parametrize(("name", "remarks"), [("behind filter", 0), ("GPI", 1)])
def test_a_filter_that_the_observer_does_not_know_is_a_remark(name, remarks):
    """The walk says so in one sentence with both time constants."""
    o = {"name": name, "bandwidth": W} | ({"filter_time": TAU} if name != "GPI" else {})
    s = ba.Scenario({"name": "LESO", "observer": o}, gait="v0.5", hardware="rabbit")
    walk = ba.walk_scenario(s.replace({"hardware.encoders.angle_filter": TAU, "run.impacts": 1}))
    found = [
        x
        for x in walk.remarks
        if "low-pass of 0 ms on the angles, and the encoders have one of 3 ms" in x
    ]
    assert len(found) == remarks


def test_a_bandwidth_beyond_the_sampling_is_a_remark():
    """At 1 kHz pi / T is 3142 rad/s: an observer of 4000 rad/s has a remark, one of 3000 rad/s has none."""
    for bandwidth, count in ((4000.0, 1), (3000.0, 0)):
        s = ba.Scenario({"name": "LESO", "observer": {"bandwidth": bandwidth}}, hardware="ideal")
        remarks = ba.walk_scenario(s.replace({"run.impacts": 1})).remarks
        assert sum("beyond the sampling's pi / T = 3142 rad/s" in x for x in remarks) == count
