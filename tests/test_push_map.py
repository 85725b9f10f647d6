"""The map of pushes: what a walk under a push is called, on made-up walks and on one that is known."""

from __future__ import annotations

import numpy as np

from biped_adrc.gait.constraint import continued
from biped_adrc.paper.figures import push_map_figure
from biped_adrc.paper.pushes import push_map, word_of
from biped_adrc.paper.reproduction import _map
from biped_adrc.paper.scenarios import MapPush
from biped_adrc.scenario.walk import walk_scenario

from .made_up_results import cell


def test_marginal_cells_carry_no_claim():
    words = [("infeasible", "feasible"), ("feasible", "feasible"), ("pulled", "fell")]
    sure = [cell(*pair) for pair in words]
    cells = [*sure, cell("feasible", "feasible", doubtful=True)]
    assert [c for c in cells if c.certain] == sure
    assert _map(cells)["rows"] == [
        ["identified, unlimited", "NPD", 2, 0, 1, 1, 0, 0, 0],
        ["identified, unlimited", "ADRC", 2, 0, 0, 0, 1, 0, 1],
    ]


def test_the_figure_counts_what_walks_on_and_leaves_marginal_cells_empty():
    words = [("but_impact", "feasible"), ("fell", "infeasible"), ("ended", "feasible")]
    cells = [cell(*pair, k == 2, 0.1 * k) for k, pair in enumerate(words)]
    npd, adrc, *_ = push_map_figure([c.row() for c in cells]).axes
    assert (npd.get_title("left"), adrc.get_title("left")) == ("NPD, unlimited", "ADRC, unlimited")
    assert [text.get_text() for text in npd.texts] == ["1", "0", "0"]
    assert [text.get_text() for text in adrc.texts] == ["1", "0.5", ""]


def test_a_fall_of_the_polynomial_is_none_of_the_robot():
    """A late push that throws NPD past the phase range, where the gait's polynomial explodes."""
    push = MapPush("identified-bare", 0.3, 150.0, "swing knee -", None)
    assert not walk_scenario(push.run("NPD").replace(gait={"continued": False})).outcome.walked
    (found,) = push_map([push])
    assert found.npd.status == "COMPLETED"
    assert word_of(found.npd) not in ("feasible", "but_impact")


def test_a_continued_constraint_is_the_same_inside(biped, gait):
    inside = continued(gait.constraint)
    for theta in np.linspace(gait.constraint.theta_minus, gait.constraint.theta_plus, 7):
        for one, other in zip(inside.h(theta), gait.constraint.h(theta), strict=True):
            np.testing.assert_allclose(one, other, rtol=0, atol=1e-12)
