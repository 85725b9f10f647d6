"""The laws of the impact in the reproduction notice an impact that breaks them."""

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
    found = model_laws(preset, samples=300)
    assert len(found) == 9  # the laws of `paper.physical_laws`, none left out
    assert [name for name, x in found.items() if not x <= 1e-12] == []


def test_another_velocity_after_impact_is_noticed(biped, state):
    q, v = state
    hit = biped.impact(q, v)
    assert np.max(impact_momenta(biped, q, v, hit)) < 1e-10
    for k, law in ((0, [0, 2]), (2, [1, 2])):  # a hip; the knee of the old leg
        v_e = hit.v_e.copy()
        v_e[k] += 1e-3
        broken = impact_momenta(biped, q, v, hit._replace(v_e=v_e))
        assert all(broken[i] > 1e-5 for i in law)


def test_legs_that_do_not_swap_are_noticed(biped, state):
    q, v = state
    hit = biped.impact(q, v)
    unswapped = hit._replace(q=q, v=hit.v_e[: biped.n])
    assert impact_momenta(biped, q, v, unswapped)[2] > 1e-3


def test_momentum_about_the_stance_foot_is_sigma(biped, state):
    """The row of q_N of D_s q', in the pinned model, by the links' own velocities."""
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
    found = largest_gaps(Numberless(biped, name), 4, 1)
    broken = [name for name, x in found.items() if not x <= 1e-12]
    assert broken[0].startswith(law)


@pytest.mark.parametrize(
    ("place", "law"), [(0, "new foot is kept"), (1, "old leg"), (2, "pinned at")]
)
def test_every_momentum_has_its_own_number(monkeypatch, biped, place, law):
    monkeypatch.setattr(laws, "impact_momenta", lambda *_: np.eye(3)[place])
    (broken,) = [name for name, x in largest_gaps(biped, 4, 1).items() if not x <= 1e-12]
    assert law in broken
