"""Sets of settings: what a contestant walks with where, files of one's own, and what is said of tuned ones."""

import json

import pytest

from biped_adrc.bench.comparison import compare
from biped_adrc.bench.conditions import BASE, CONDITIONS, conditions_on
from biped_adrc.bench.parameters import trial
from biped_adrc.bench.settings import AS_PUBLISHED, SETTINGS, TUNED, settings_of
from biped_adrc.cli.compare import _names
from biped_adrc.errors import InputError
from tests.bench.test_compare import row


def asked(settings, controllers, conditions):
    """The trials that a comparison asks for."""
    found = []

    def carry(records):
        found.extend(dict(r) for r in records)
        return [row(True) for _ in records]

    compare(carry, controllers, conditions, 1, settings)
    return found


def test_a_condition_gives_each_contestant_the_values_of_its_place():
    _, pushed, plain = asked(TUNED, ["m = 1"], ["RABBIT pushed", "nothing"])
    for found, condition in ((pushed, "RABBIT pushed"), (plain, "nothing")):
        place = CONDITIONS[condition].place
        fixed = {"controller": "LESO", "order": 1, "gait": "v0.5", "seed": 0}
        chosen = TUNED.places[place]["m = 1"]
        assert found == {**BASE, **CONDITIONS[condition].values, **fixed, **chosen}
    assert pushed["filter_time"] > 0.0
    assert "filter_time" not in plain


def test_what_no_search_has_tuned_walks_as_published_and_is_told_so():
    for name, condition in (
        ("ADRC, Table I", "nothing"),
        ("m = 1", "delay"),
        ("CLF-QP", "nothing"),
    ):
        place = CONDITIONS[condition].place
        assert TUNED.as_published(name, place)
        assert {"K_p", "K_d", "filter_time"}.isdisjoint(TUNED.of(name, place))
    assert not TUNED.as_published("my_law:Mine", "ideal 1 kHz")
    assert not AS_PUBLISHED.as_published("NPD", None)
    text = TUNED.said(["NPD", "m = 1", "CLF-QP"], ["nothing", "delay"])
    assert "As published: NPD (under delay); m = 1 (under delay); CLF-QP." in text
    assert "As published" not in TUNED.said(["NPD"], ["nothing"])


def test_conditions_name_places_of_the_tuned_sets():
    for settings in (x for x in SETTINGS.values() if x.alike):
        assert {CONDITIONS[c].place for c in conditions_on("rigid", True)} <= set(settings.places)
        assert settings.name == f"tuned-{settings.values['gait']}"
    assert set(conditions_on("rigid")) - set(conditions_on("rigid", True)) == {"delay"}


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


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "expected 'places'"),
        ("[sets]\n[places.moon]", "found the tables"),
        ("[places.moon]\nNPD = { K_p = 1.0 }", "found the places ..moon"),
        ('[places."RABBIT, 1 ms"]\nNPD = { K_pp = 1.0 }', "RABBIT, 1 ms, NPD, 'K_pp'"),
        ('[places."RABBIT, 1 ms"]\nNPD = { K_p = -1.0 }', "RABBIT, 1 ms, NPD, 'K_p'"),
        ("[places", "is not valid TOML"),
        ("places = 3", "own.toml"),
    ],
)
def test_a_file_that_says_what_there_is_not_is_refused(tmp_path, text, message):
    path = tmp_path / "own.toml"
    path.write_text(text)
    with pytest.raises(InputError, match=message):
        settings_of(str(path))


def test_settings_that_there_are_not():
    with pytest.raises(InputError, match=r"no settings 'tuned', expected one of .*tuned-v0\.5"):
        settings_of("tuned")
    with pytest.raises(InputError, match="not found"):
        settings_of("nowhere.toml")


def test_names_with_commas_are_read_from_a_list():
    every = tuple(TUNED.contestants)
    assert _names("NPD,ADRC, Table I, assisted, m = 1,m = 1", every) == (
        "NPD",
        "ADRC, Table I",
        "assisted, m = 1",
        "m = 1",
    )
    assert _names("ADRC,NPD, x:Y", every) == ("ADRC", "NPD", "x:Y")
    assert _names(None, every) == every


def test_every_tuned_value_is_one_that_its_controller_takes():
    for settings in (x for x in SETTINGS.values() if x.alike):
        json.dumps(settings.places)
        for condition in conditions_on("rigid", True):
            for name in settings.contestants:
                trial(settings.record(condition, name, 0))
