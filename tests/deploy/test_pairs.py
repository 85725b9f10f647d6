"""Everything of the registry that runs on a robot's computer: exported and proved, or refused by name."""

import pytest

from biped_adrc.deploy.apart import TIMES
from biped_adrc.deploy.loaded import UNOPTIMISED
from biped_adrc.hybrid.simulator import RunOptions
from tests.deploy.pairs import before_touchdown, proved, some_pairs


@pytest.mark.parametrize("pair", some_pairs(), ids=lambda x: f"{x.kind}-{x.name}-{x.hardware}")
def test_calls_and_a_walk_over_a_touchdown_are_those_of_python(pair):
    """Within ten times what one ulp of its inputs does."""
    before = 0.11 if pair.kind == "touchdown" else 0.03
    begin = before_touchdown(before)
    found = proved(pair, begin, RunOptions(before + 0.02), UNOPTIMISED, every=5, walks=1)
    if found.refused:
        assert type(pair.thing).__name__ in found.refused
        assert pair.thing._obstacle or "in continuous time" in found.refused
    else:
        assert len(found.apart.run.arcs) == 2
        assert found.kinds == {"init", "step", "touchdown"}
        assert found.rounding.worst <= TIMES
        assert found.apart.proved, found.apart
