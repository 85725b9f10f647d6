"""The stations of the tour show what they say: each is walked, with its push."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.live.controls import controls, tour
from biped_adrc.live.reading import reading

DOCS = Path(__file__).parents[2] / "docs"


@cache
def walked(k, seconds=1.6):
    """Status, largest tracking error after 0.6 s [rad], and whether a torque was at its limit, of a station."""
    station = tour()[k]
    session = ba.Session(ba.Scenario("ADRC", hardware="ideal"))
    session.reset(**station["values"])
    largest, at_limit, pushed = 0.0, False, "push" not in station
    while session.walks and session.t < seconds:
        if not pushed and session.t >= station["after"]:
            session.push(**station["push"])
            pushed = True
        nodes = session.sample()[0]
        if session.samples % 4 == 0:
            seen = reading(session.walking[0], nodes[-1], session.hand)
            at_limit |= bool(np.max(np.abs(seen.u)) >= 150.0)
            largest = max(largest, float(np.max(np.abs(seen.error)))) if session.t > 0.6 else 0.0
    return session.walking[0].status, largest, at_limit


def station(words):
    """The number of the station whose title has these words."""
    return next(k for k, x in enumerate(tour()) if words in x["title"])


def test_what_an_observer_is_worth():
    npd, adrc = (walked(station(words))[1] for words in ("under NPD", "under ADRC"))
    assert 4e-3 < npd < 16e-3
    assert adrc < npd / 10.0


def test_what_the_order_is_worth():
    one, three = (walked(station(words))[1] for words in ("order 1", "raised to 3"))
    assert 1e-3 < one < 10e-3
    assert three < one / 3.0


def test_encoders_fell_it_and_a_lower_bandwidth_does_not():
    status, _, at_limit = walked(station("encoders"))
    assert at_limit
    assert status in (ba.Status.FELL, ba.Status.RAN_AWAY)
    assert walked(station("lower bandwidth"))[0] is ba.Status.COMPLETED


def test_at_the_end_of_the_slider_order_7_fells_it_and_order_1_does_not():
    found = tour()[station("lower bandwidth")]
    assert all(words in found["text"] for words in ("order 1", "order 7", "right end"))
    (slider,) = (x for x in controls()["sliders"] if x["name"] == "bandwidth")
    for order, walks in ((1, True), (7, False)):
        session = ba.Session(ba.Scenario(**found["values"] | {"hardware": "ideal"}))
        session.advance(0.6)
        session.change(order=order)
        session.advance(0.3)
        session.change(bandwidth=slider["high"])
        assert session.advance(2.0) is walks


def test_holding_the_observer_is_worth_much_on_soft_ground():
    pytest.importorskip("mujoco")
    (soft, error, _), (held, less, _) = walked(station("soft ground")), walked(station("held"))
    assert soft is held is ba.Status.COMPLETED
    assert error > 1e-2
    assert less < 4e-3


def test_every_page_of_the_documentation_is_there():
    for x in tour():
        assert (DOCS / f"{x['page']}.md").is_file()
