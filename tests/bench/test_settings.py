"""Sets of settings: what a contestant walks with where, files of one's own, and what is said of tuned ones."""

from biped_adrc.bench.settings import TUNED, settings_of

OWN = """
words = "found by hand"
[contestants]
mine = { controller = "LESO", order = 4 }
[places."RABBIT, 1 ms"]
mine = { bandwidth = "100 rad/s", own.gain = 3.0 }
NPD = { K_p = 500.0 }
"""


def test_a_file_of_ones_own_stands_on_the_tuned_set(tmp_path):
    path = tmp_path / "own.toml"
    path.write_text(OWN)
    found = settings_of(str(path))
    assert list(found.contestants) == [*TUNED.contestants, "mine"]
    given = {"gait": "v0.5", "controller": "LESO", "order": 4}
    assert found.of("mine", "RABBIT, 1 ms") == given | {"bandwidth": 100.0, "own.gain": 3.0}
    assert found.as_published("mine", "ideal 1 kHz")
    assert found.of("NPD", "RABBIT, 1 ms") == {"gait": "v0.5", "controller": "NPD", "K_p": 500.0}
    assert found.of("m = 1", "ideal 1 kHz") == TUNED.of("m = 1", "ideal 1 kHz")
    assert found.words.startswith("found by hand; on top of tuned-v0.5")
