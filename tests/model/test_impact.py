"""The plastic impact (3)-(9).

any_biped is RABBIT with each preset of its masses; states(n, count) yields random angles and rates of n
coordinates. D_e is the inertia matrix of the robot that is not pinned, and E_2 the Jacobian of its swing foot.
"""

import math

import numpy as np
import pytest

from biped_adrc.gait.published import X_STAR
from biped_adrc.model.contact import LinkMotion

NOTES = {  # impulse ratio and delta^2 at x*, worked out independently of this package
    "identified": (0.52, 0.694),
    "identified-bare": (0.85, 0.694),
    "tac2003": (0.71, 0.707),
}


def states(n, count):
    random = np.random.default_rng(11)
    for _ in range(count):
        yield random.uniform(-math.pi, math.pi, n), random.normal(0.0, 3.0, n)


def test_momentum_equation_and_standing_foot(any_biped):
    """D_e (v_e+ - v-) = E_2' impulse, and the foot that landed stands; rates v_e+ are of the floating robot.
    Then stance and swing, hence entries 0, 1 and 2, 3, change their names.
    """
    b = any_biped
    for q, v in states(b.n, 300):
        hit = b.impact(q, v)
        D_e, E_2 = b.extended_inertia(q), b.E_2(q)
        before = D_e @ np.append(v, [0.0, 0.0])
        gap = D_e @ hit.v_e - before - E_2.T @ hit.impulse
        assert np.max(np.abs(gap)) <= 1e-12 * np.max(np.abs(before))
        assert np.max(np.abs(E_2 @ hit.v_e)) <= 1e-12 * max(1.0, np.max(np.abs(hit.v_e)))
        assert np.array_equal(hit.q, q[[1, 0, 3, 2, 4]])
        assert np.array_equal(hit.v, hit.v_e[[1, 0, 3, 2, 4]])


def test_angular_momentum_about_the_new_contact_is_kept(any_biped):
    """The impulse acts there and has no arm. By the links' own velocities before and after; it is sigma of the
    next step, up to the sign of the pitch axis.
    """
    b = any_biped
    for q, v in states(b.n, 100):
        hit, rates = b.impact(q, v), np.append(v, [0.0, 0.0])
        before, after = (
            LinkMotion(b.floating, q, x).about(b.swing_foot(q)) for x in (rates, hit.v_e)
        )
        assert after == pytest.approx(before, rel=1e-10, abs=1e-10)
        assert abs(b.angular_momentum(hit.q, hit.v)) == pytest.approx(abs(after), rel=1e-9)


def test_impact_at_the_published_state(any_biped):
    """Impulse ratio and delta^2 are as in NOTES, numbers worked out without this package; Theta [rad] after the
    impact follows from the published angles.
    """
    b = any_biped
    q, v = X_STAR[:5], X_STAR[5:]
    hit = b.impact(q, v)
    ratio, delta2 = NOTES[b.preset]
    assert hit.impulse_ratio == pytest.approx(ratio, abs=6e-3)
    found = (b.angular_momentum(hit.q, hit.v) / b.angular_momentum(q, v)) ** 2
    assert found == pytest.approx(delta2, abs=5e-4)
    assert b.phase @ hit.q == pytest.approx(3.3396, abs=1e-12)
