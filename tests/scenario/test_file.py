"""A scenario is read back from a file: texts with quotes, numbers to the last bit, pushes, names
with spaces.
"""

import pytest

import biped_adrc as ba
from biped_adrc.scenario.scenario import read_scenario, write_scenario

SCENARIOS = [
    ba.Scenario(
        {"name": "LESO", "observer": {"bandwidth": 1 / 3}},
        hardware={"profile": "rabbit", "torque_limit": None},
        run={"impacts": 8},
    ),
    ba.Scenario(pushes="q1,q2=30@3:0.1-0.3 q5=-10@2:0.1-", start={"q5": 0.1}),
    ba.Scenario(
        {"observer": {"poles": (-1.0, -2.0, -3.0)}, "text": 'x"y\n', "flag": True, "t": (1.0, 2)}
    ),
    ba.Scenario(errors={"mass": {"the torso": 0.1}}, robot="three_link"),
]


@pytest.mark.parametrize("s", SCENARIOS)
def test_a_scenario_file_reads_back_to_the_same_scenario(s, tmp_path):
    """The remark of two lines becomes one comment line, so that it adds nothing to the values."""
    path = tmp_path / "s.toml"
    write_scenario(path, s, "two\nlines")
    assert read_scenario(path) == s
    assert path.read_text().startswith("# two\\nlines\ncontroller.name = ")
