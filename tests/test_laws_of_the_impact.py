"""The laws of the impact in the reproduction notice an impact that breaks them.

`impact_momenta` are the changes of three quantities that an impact keeps: [0] the angular momentum of all
links about the new foot, [1] that of the old leg about its hip and knee, [2] the linear momentum, floating
against pinned. `largest_gaps` and `model_laws` are the violations of all laws of the model by name, at random
states.
"""

import math

import numpy as np
import pytest

from biped_adrc.model import physical as laws
from biped_adrc.model.contact import LinkMotion
from biped_adrc.model.physical import impact_momenta, largest_gaps
from biped_adrc.paper.physical_laws import model_laws


@pytest.fixture
def state(biped):
    random = np.random.default_rng(4)
    return random.uniform(-math.pi, math.pi, biped.n), random.normal(0.0, 3.0, biped.n)


@pytest.mark.parametrize("preset", ["identified", "identified-bare", "tac2003"])
def test_the_laws_of_the_impact_hold_to_round_off(preset):
    """At 300 random states, in all presets (sets of RABBIT's masses), no relative violation is above 1e-12."""
    found = model_laws(preset, samples=300)
    assert len(found) == 9  # the laws of `paper.physical_laws`, none left out
    assert [name for name, x in found.items() if not x <= 1e-12] == []  # NaN is broken too


def test_another_velocity_after_impact_is_noticed(biped, state):
    """1e-3 rad/s added to one joint after impact breaks the laws that `law` lists: an impulse at a joint that
    a motor did not give."""
    q, v = state
    hit = biped.impact(q, v)
    assert np.max(impact_momenta(biped, q, v, hit)) < 1e-10
    for k, law in ((0, [0, 2]), (2, [1, 2])):  # a hip; the knee of the old leg
        v_e = hit.v_e.copy()
        v_e[k] += 1e-3
        broken = impact_momenta(biped, q, v, hit._replace(v_e=v_e))
        assert all(broken[i] > 1e-5 for i in law)


def test_legs_that_do_not_swap_are_noticed(biped, state):
    """The state after impact has the labels from before it: the linear momentum pinned at the new foot is
    another one then.
    """
    q, v = state
    hit = biped.impact(q, v)
    unswapped = hit._replace(q=q, v=hit.v_e[: biped.n])
    assert impact_momenta(biped, q, v, unswapped)[2] > 1e-3


def test_momentum_about_the_stance_foot_is_sigma(biped, state):
    """sigma, the row of q_N of D_s q' in the pinned model, is compared with the sum by the links' own
    velocities.
    """
    q, v = state
    motion = LinkMotion(biped.floating, q, np.append(v, [0.0, 0.0]))
    assert motion.about(np.zeros(2)) == pytest.approx(biped.angular_momentum(q, v), rel=1e-11)


class Numberless:
    """A robot of which one function gives no number."""

    def __init__(self, biped, name):
        self._biped, self._name = biped, name

    def __getattr__(self, name):
        return (lambda *_: math.nan) if name == self._name else getattr(self._biped, name)


@pytest.mark.parametrize(
    ("name", "law"),
    [
        ("inertia", "D_s of the pinned model"),
        ("bias", "Omega of the pinned model"),
        ("kinetic_energy", "impact: kinetic energy"),
    ],
)
def test_a_model_without_numbers_is_noticed(biped, name, law):
    """One function of the robot gives NaN; the maximum over states must keep it, so that the law counts as
    broken. The laws are listed in order, the first broken one is that of the function."""
    found = largest_gaps(Numberless(biped, name), 4, 1)  # 4 states, seed 1
    broken = [name for name, x in found.items() if not x <= 1e-12]
    assert broken[0].startswith(law)


@pytest.mark.parametrize(
    ("place", "law"), [(0, "new foot is kept"), (1, "old leg"), (2, "pinned at")]
)
def test_every_momentum_has_its_own_number(monkeypatch, biped, place, law):
    """Of three momenta one alone is off (by 1): exactly the law of that one is broken, none is lost in a sum
    or named by another. largest_gaps(biped, 4, 1): at 4 random states, seed 1."""
    monkeypatch.setattr(laws, "impact_momenta", lambda *_: np.eye(3)[place])
    (broken,) = [name for name, x in largest_gaps(biped, 4, 1).items() if not x <= 1e-12]
    assert law in broken
