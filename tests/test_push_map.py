"""The map of pushes: what a walk under a push is called, on made-up walks and on one that is known.

A cell is one push, with the outcomes of its walks under NPD and ADRC; `cell("fell", "feasible")` is made up.
It is marginal ("doubtful", not "certain") if a walk ends otherwise at half of the integration step.
"""

from __future__ import annotations

import numpy as np

from biped_adrc.gait.constraint import continued
from biped_adrc.paper.pushes import push_map, word_of
from biped_adrc.paper.reproduction import _map, push_map_figure
from biped_adrc.paper.scenarios import MapPush
from biped_adrc.scenario.walk import walk_scenario

from .made_up_results import cell


def test_marginal_cells_carry_no_claim():
    """There are three certain cells, and one whose walk under ADRC is marginal. Columns count feasible,
    feasible but for the impact, infeasible, pulled, fell, ended, marginal: that one stands in the last one,
    under NPD in the first.
    """
    words = [("infeasible", "feasible"), ("feasible", "feasible"), ("pulled", "fell")]
    sure = [cell(*pair) for pair in words]
    cells = [*sure, cell("feasible", "feasible", doubtful=True)]
    assert [c for c in cells if c.certain] == sure
    assert _map(cells)["rows"] == [
        ["identified, unlimited", "NPD", 2, 0, 1, 1, 0, 0, 0],
        ["identified, unlimited", "ADRC", 2, 0, 0, 0, 1, 0, 1],
    ]


def test_the_figure_counts_what_walks_on_and_leaves_marginal_cells_empty():
    """There is one push per onset: 1 stands for a walk that is feasible, perhaps but for the impact, 0.5 for an
    infeasible one, 0 for one that is lost, and no text where the walk (the third one under ADRC) is marginal.
    """
    words = [("but_impact", "feasible"), ("fell", "infeasible"), ("ended", "feasible")]
    # the third one is marginal; onsets 0, 0.1, 0.2
    cells = [cell(*pair, k == 2, 0.1 * k) for k, pair in enumerate(words)]
    npd, adrc, *_ = push_map_figure([c.row() for c in cells]).axes
    assert (npd.get_title("left"), adrc.get_title("left")) == ("NPD, unlimited", "ADRC, unlimited")
    assert [text.get_text() for text in npd.texts] == ["1", "0", "0"]
    assert [text.get_text() for text in adrc.texts] == ["1", "0.5", ""]


def test_a_fall_of_the_polynomial_is_none_of_the_robot():
    """A late push of 150 N m throws NPD past the phase range, where the gait's polynomial explodes and the
    walk ends. The map takes the smoothly continued curve: all steps are made, and infeasible."""
    # 0.3 s after the impact, 150 N m, and no torque limit
    push = MapPush("identified-bare", 0.3, 150.0, "swing knee -", None)
    assert not walk_scenario(push.run("NPD").replace(gait={"continued": False})).outcome.walked
    (found,) = push_map([push])
    assert found.npd.status == "COMPLETED"
    assert word_of(found.npd) not in ("feasible", "but_impact")


def test_a_continued_constraint_is_the_same_inside(biped, gait):
    """Past the ends of its phase Theta a curve is continued smoothly; between them h, h' and h'' are those of
    the gait."""
    inside = continued(gait.constraint)
    for theta in np.linspace(gait.constraint.theta_minus, gait.constraint.theta_plus, 7):
        for one, other in zip(inside.h(theta), gait.constraint.h(theta), strict=True):
            np.testing.assert_allclose(one, other, rtol=0, atol=1e-12)
