"""Everything of the registry that runs on a robot's computer: exported and proved, or refused by name."""

import pytest

from biped_adrc.deploy.apart import TIMES
from tests.deploy.pairs import proved, short_walk, some_pairs


@pytest.mark.parametrize("pair", some_pairs(), ids=lambda x: f"{x.kind}-{x.name}-{x.hardware}")
def test_calls_and_a_walk_over_a_touchdown_are_those_of_python(pair):
    """Within ten times what one ulp of its inputs does."""
    found = proved(pair, *short_walk(pair))
    if found.refused:
        assert type(pair.thing).__name__ in found.refused
        assert pair.thing._obstacle or "in continuous time" in found.refused
    else:
        assert len(found.apart.run.arcs) == 2
        assert found.kinds == {"init", "step", "touchdown"}
        assert found.rounding.worst <= TIMES
        assert found.apart.proved, found.apart
