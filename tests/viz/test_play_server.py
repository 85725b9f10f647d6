"""The page's server: what pages see and may say, who can reach it, and how it ends."""

import asyncio
import dataclasses
import itertools
import os
import signal
import threading
from pathlib import Path

import psutil
import pytest
from tornado.httpclient import AsyncHTTPClient, HTTPClientError

import biped_adrc as ba
from biped_adrc.errors import InputError
from biped_adrc.ground import ground_axes
from biped_adrc.live import stage as staging
from biped_adrc.live.controls import controls, values
from biped_adrc.live.driver import Driver
from biped_adrc.live.frame import frame
from biped_adrc.live.messages import MOST_AT_ONCE, MOST_BYTES, Allowance, Message
from biped_adrc.live.of_walker import scenario_of
from biped_adrc.live.page import page, play
from biped_adrc.live.stage import MOST_WAITING, Heard, Stage
from biped_adrc.scenario.scenario import FIELDS

from .served import SOON, Page, served


def test_friction_on_a_slope_is_that_along_it():
    s = ba.Scenario("NPD", hardware="ideal", slope=0.2)
    driver = Driver(ba.Session(s))
    driver.take(Message("step", {}))
    seen = frame(driver)["walks"][0]
    force = driver.session.walk().signals.ground_reaction[-1]
    along, out = (abs(force @ axis) for axis in ground_axes(s.slope))
    assert seen["rows"][-1]["friction"] == pytest.approx(along / out, rel=1e-9)
    assert seen["worst"]["friction"] == pytest.approx(along / out, rel=1e-9)
    assert seen["worst"]["normal"] == pytest.approx(out, rel=1e-9)


@pytest.mark.parametrize("contact", [None, "hold"])
def test_on_soft_ground_it_slips_where_the_finished_walk_does(contact):
    pytest.importorskip("mujoco")
    values = {"plant": "mujoco", "bandwidth": 160.0, "order": 1, "contact": contact}
    driver, slipped = Driver(ba.Session(ba.Scenario("ADRC", hardware="ideal", **values))), set()
    while driver.session.t < 0.9:
        step = driver.session.walking[0].now.mode.step
        driver.take(Message("step", {}))
        if frame(driver)["walks"][0]["worst"]["slips"]:
            slipped.add(step)
        driver.shown()
    steps = driver.session.walk().soft_steps
    assert slipped
    assert slipped == {k + 1 for k, one in enumerate(steps) if max(one.slip_time) > 0.0}


def test_controls_are_fields_of_a_scenario_and_lie_in_their_ranges():
    told, start = controls(), ba.Scenario("ADRC", hardware="ideal")
    assert {x["name"] for x in told["sliders"]} == {
        *("bandwidth", "K_p", "K_d", "filter_time", "noise", "delay", "slope", "ground_friction")
    }
    for slider in told["sliders"]:
        assert slider["low"] <= slider.get("usual", slider["given"]) <= slider["high"]
        for end in ("low", "high"):
            given = slider.get("needs", {}) | {slider["name"]: slider[end]}
            ba.Scenario("ADRC", hardware="ideal", torque_limit=150.0, **given)
    assert set(values(start)) <= set(FIELDS)


def test_pages_see_one_session_and_what_each_of_them_does(tmp_path):
    async def visit(url):
        one, two = await Page.open(url), await Page.open(url)
        first = await two.frame()
        later = await two.frame(lambda f: f["t"] > first["t"] + 0.05)
        assert later["walks"][0]["joints"] != first["walks"][0]["joints"]
        await one.say(do="push", force=[40, 0], seconds=30)
        seen = await two.frame(lambda f: f["hand"] is not None)
        assert seen["hand"]["force"] == [40.0, 0.0]
        await two.say(do="change", values={"controller": "ADRC", "bandwidth": 300})
        told = await one.until(lambda m: m.get("values", [{}])[0].get("bandwidth") == 300)
        assert told["values"][0]["controller"] == "ADRC"

    assert served(visit)[0] == "stopped by SIGTERM"


def test_what_is_wrong_is_answered_in_a_sentence_and_the_walk_goes_on():
    async def visit(url):
        page = await Page.open(url)
        await page.say(do="change", values={"bandwidth": -1})
        refused = await page.reply("refused")
        assert refused["names"] == ["bandwidth"]
        assert "bandwidth" in refused["refused"]
        for text in ("{", "[]", '{"do": "__init__"}', b"\xff\x00"):
            await page.socket.write_message(text, binary=isinstance(text, bytes))
            assert "message" in (await page.reply("refused"))["refused"]
        await page.frame()
        loud, huge = await Page.open(url), await Page.open(url)
        await huge.socket.write_message(" " * (MOST_BYTES + 1))
        for _ in range(int(3 * MOST_AT_ONCE)):
            await loud.say(do="go")
        for closed, code in ((huge, 1009), (loud, 1008)):
            while await closed.heard() is not None:
                pass
            assert closed.socket.close_code == code
        now = await page.frame()
        await page.frame(lambda f: f["t"] > now["t"] + 0.05)

    served(visit)


def test_a_flood_of_changes_is_taken_bit_by_bit_and_no_other_page_waits_for_its_end():
    closed: list[tuple[object, ...]] = []

    class Spoken:
        def close(self, *why):
            closed.append(why)

    stage = Stage(Driver(ba.Session(ba.Scenario("NPD", hardware="ideal"))), Path())
    loud, quiet = Spoken(), Spoken()
    for one in (loud, quiet):
        stage.came(one)
    stage.said(quiet, '{"do": "pause"}')
    for _ in range(MOST_WAITING + 1):
        stage.allowances.get(loud, Allowance()).left = MOST_AT_ONCE
        stage.said(loud, '{"do": "go"}')
    assert closed == [(1008, "too many messages")]
    assert [one.page for one in stage.heard] == [quiet]


def test_a_turn_ends_after_its_time_and_the_rest_is_done_in_the_next_one():
    ticks = itertools.count()
    driver = Driver(ba.Session(ba.Scenario("NPD", hardware="ideal")), lambda: 0.01 * next(ticks))
    stage, one, other = Stage(driver, Path()), object(), object()
    heard = [Heard(one, '{"do": "step"}')] * 20 + [Heard(other, '{"do": "step"}'), Heard(one, None)]
    turn = stage.turn(heard, False)
    assert 0 < driver.session.samples < 20
    assert turn.waits == heard[driver.session.samples :]
    assert [x for x in turn.waits if stage.listens(x)] == [
        Heard(one, None)
    ]  # both have been closed


def test_a_hand_that_goes_away_in_the_middle_of_a_pull_lets_go():
    async def visit(url):
        one, two = await Page.open(url), await Page.open(url)
        await one.say(do="pull", link="torso", at=[0, 0.3], anchor=[0.5, 1.3])
        pulled = await two.frame(lambda f: f["hand"] is not None)
        assert pulled["hand"]["anchor"] == [0.5, 1.3]
        one.socket.close()
        await two.frame(lambda f: f["hand"] is None and not f["walks"][0]["ending"])

    served(visit)


@pytest.mark.parametrize(
    "headers", [{"Origin": "http://attacker.example"}, {"Host": "attacker.example"}]
)
def test_a_page_from_elsewhere_gets_nothing(headers):
    async def visit(url):
        with pytest.raises(HTTPClientError, match="403"):
            await Page.open(url, **headers)
        if "Host" in headers:
            with pytest.raises(HTTPClientError, match="403"):
                await AsyncHTTPClient().fetch(url, headers=headers)

    served(visit)


def test_another_request_than_get_is_refused():
    async def visit(url):
        for address in (url, url + "poses"):
            with pytest.raises(HTTPClientError, match="405"):
                await AsyncHTTPClient().fetch(address, method="POST", body="x")

    served(visit)


@pytest.mark.parametrize("plant", ["rigid", "mujoco"])
def test_what_was_saved_is_walked_again_bit_for_bit_and_nothing_is_overwritten(tmp_path, plant):
    if plant == "mujoco":
        pytest.importorskip("mujoco")
    (tmp_path / "session-1.npz").write_bytes(b"mine")
    paths = []

    async def visit(url):
        page = await Page.open(url)
        await page.say(do="pull", link="torso", at=[0, 0.3], anchor=[0.3, 1.3])
        await page.frame(lambda f: f["t"] > 0.2)
        await page.say(do="let_go")
        await page.say(do="change", values={"controller": "ADRC", "bandwidth": 160.0, "order": 1})
        await page.say(do="change", values={"plant": plant, "torque_limit": 150.0})
        await page.frame(lambda f: f["t"] > 0.3)
        await page.say(do="push", force=[40, 0], seconds=0.05)
        await page.frame(lambda f: f["t"] > 0.4)
        await page.say(do="save")
        paths.extend((await page.reply("saved"))["saved"])
        await page.say(do="reset")
        await page.say(do="pause")
        await page.say(do="save")

    served(visit, out=tmp_path, ghost={"controller": "NPD"})
    assert paths == [str(tmp_path / name) for name in ("session-2.npz", "session-2.toml")]
    found, again = map(ba.replay_session, paths)
    assert found.same
    assert again.same
    assert found.record.ghost.controller == "NPD"
    assert any(row.hand is not None for row in found.record.hands)
    assert found.record.changes[0].values["controller"] == "ADRC"
    assert any(change.values.get("plant") == plant for change in found.record.changes) == (
        plant == "mujoco"
    )
    assert (tmp_path / "session-1.npz").read_bytes() == b"mine"


@pytest.mark.parametrize("given_up", [False, True])
def test_it_waits_for_a_session_that_is_being_saved_until_that_is_given_up(
    tmp_path, monkeypatch, given_up
):
    begun, ended, save = threading.Event(), threading.Event(), staging.save_session

    def slow(record, *paths, going):
        begun.set()
        while going() and not ended.wait(0.01):
            pass
        return save(record, *paths, going=going)

    async def visit(url):
        page = await Page.open(url)
        await page.frame(lambda f: f["t"] > 0.1)
        await page.say(do="save")
        await asyncio.to_thread(begun.wait, SOON)

    def heard(text):
        if "being saved" in text and given_up:
            os.kill(os.getpid(), signal.SIGINT)
        elif "being saved" in text:
            ended.set()

    monkeypatch.setattr(staging, "save_session", slow)
    why, said = served(visit, out=tmp_path, heard=heard)
    assert why == "stopped by SIGTERM"
    files = sorted(path.name for path in tmp_path.iterdir())
    assert files == [] if given_up else {"session-1.npz", "session-1.toml"} <= {*files}
    assert said[-1].startswith("the session is not saved" if given_up else "saved as ")
    assert given_up or ba.replay_session(tmp_path / "session-1.toml").same


def test_a_ghost_comes_and_goes_and_both_begin_anew():
    async def visit(url):
        page = await Page.open(url)
        await page.frame(lambda f: f["t"] > 0.1)
        await page.say(do="ghost", values={"controller": "ADRC"})
        both = await page.frame(lambda f: len(f["walks"]) == 2)
        assert both["t"] < 0.11
        await page.say(do="ghost", values={"controller": "no such"})
        assert "no such" in (await page.reply("refused"))["refused"]
        await page.say(do="ghost")
        await page.frame(lambda f: len(f["walks"]) == 1)

    served(visit)


@pytest.mark.parametrize("stop", [None, signal.SIGINT, signal.SIGTERM])
def test_it_ends_with_the_last_page_or_a_signal_and_leaves_no_process(stop):
    before, threads = psutil.Process().children(), threading.active_count()

    async def visit(url):
        one, two = await Page.open(url), await Page.open(url)
        one.socket.close()
        await two.frame()
        if stop is None:
            two.socket.close()

    why = "the browser has closed the page" if stop is None else f"stopped by {stop.name}"
    assert served(visit, stop)[0] == why
    assert psutil.Process().children() == before
    assert threading.active_count() == threads


def test_a_walk_that_cannot_keep_up_is_said_to_have_reached_less():
    async def visit(url):
        page = await Page.open(url)
        await page.say(do="rate", rate=10)
        await page.say(do="change", values={"plant": "mujoco", "torque_limit": 150})
        slow = await page.frame(lambda f: f["rate"] == 10 and f["reached"] < 9.0)
        assert slow["reached"] > 0.0

    pytest.importorskip("mujoco")
    _, said = served(visit)
    assert "did not keep up" in said[-1]


def test_bad_input_is_refused_before_anything_is_served(tmp_path):
    ideal = ba.Scenario("NPD", hardware="ideal")
    with pytest.raises(InputError, match="no folder"):
        play(ideal, out=tmp_path / "none")
    with pytest.raises(InputError, match="sample instants"):
        play(ba.Scenario("NPD"))
    with pytest.raises(InputError, match="port is 'a'"):
        play(ideal, port="a")
    with pytest.raises(InputError, match="wait is -1 s"):
        play(ideal, wait=-1)

    async def inside():
        play(ideal, open_browser=False)

    with pytest.raises(InputError, match="running already"):
        asyncio.run(inside())


def test_the_page_holds_all_that_it_needs():
    html = page(ba.Session(ba.Scenario("NPD", hardware="ideal")))
    assert "connect-src 'self'" in html
    assert 'src="http' not in html


def test_a_walker_plays_where_a_scenario_can_say_all_of_it():
    biped = ba.Biped.load("rabbit")
    gait, clock = ba.load_gait("published", biped), ba.SampledTime(1e-3)
    walker = ba.Walker(
        biped,
        ba.ADRCController(gait.constraint, ba.GPIObserver.from_bandwidth(300.0, 2)),
        timing=clock,
    )
    s = scenario_of(walker, gait)
    assert (s.controller, s.period, s.poles) == ("ADRC", 1e-3, (-300.0,) * 4)
    pushed = dataclasses.replace(walker, disturbance=ba.TorquePulse([9, 0, 0, 0, 0], 3, 0.1, 0.2))
    with pytest.raises(InputError, match="does not say all of this walker: disturbance"):
        scenario_of(pushed, gait)
    with pytest.raises(InputError, match="sample instants"):
        ba.play(dataclasses.replace(walker, timing=ba.ContinuousTime()), gait)
    with pytest.raises(InputError, match="the gait of the walker"):
        ba.play(walker)
    with pytest.raises(InputError, match="has its gait"):
        ba.play(s, gait)
