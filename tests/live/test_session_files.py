"""Sessions on disk: the run and the scenario with its inputs hold the same, and what is damaged is refused."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.bench.scenario_file import read_scenario
from biped_adrc.cli import app
from biped_adrc.errors import InputError
from biped_adrc.hybrid.storage import load_beside
from biped_adrc.live.hand import Hand
from biped_adrc.live.hand_table import HandRow, from_table, to_table
from biped_adrc.live.record import Change, SessionRecord
from biped_adrc.live.repeated import save_session, save_walked
from biped_adrc.live.session import GHOST, WALK, Session
from biped_adrc.live.session_file import Ended, from_text, to_text, write_session
from biped_adrc.live.stored import walks_of
from biped_adrc.scenario.stored import load_ghost, load_walks

IDEAL = {"hardware": "ideal", "impacts": 2}
QUICK = {"deadline": None, "derandomize": True, "database": None}
QUICK |= {"suppress_health_check": [HealthCheck.function_scoped_fixture, HealthCheck.too_slow]}


# -- what is written is read ---------------------------------------------------------------------
numbers = st.floats(-100.0, 100.0)
points = st.tuples(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0))
hands = st.builds(
    Hand,
    st.tuples(*[numbers] * 5),
    st.sampled_from(["torso", 'my "own", link\'s', "ä'''b\\n"]),
    points,
    st.tuples(numbers, numbers),
)
VALUES = (
    {"controller": "NPD", "K_p": None, "bandwidth": None},
    {"own": {}, "noise": 1e-4 / 3.0},
    {"own": {"gain": 0.1 + 0.2, "kind": "fast", "rows": (1.5, 2.0)}},
    {"plant": "mujoco", "start": {"q1": 0.1}, "counts": None},
    {"poles": [-10.5, -20.0, -30.0], "delay_known": True},
)


@st.composite
def records(draw):
    """Sessions that need not be walkable."""
    samples = draw(st.integers(0, 50))
    ghost = draw(st.sampled_from([None, ba.Scenario("NPD", pushes="q1=3@1:0.1-0.2", **IDEAL)]))
    at = st.integers(0, samples)
    walks = st.integers(0, 0 if ghost is None else 1)
    changes = draw(st.lists(st.builds(Change, at, walks, st.sampled_from(VALUES)), max_size=3))
    rows = draw(st.dictionaries(at, st.none() | hands, max_size=4))
    own = draw(st.sampled_from([{}, {"gain": 1.0 / 3.0}]))
    return SessionRecord(
        ba.Scenario("ADRC", own=own, bandwidth=draw(st.floats(1.0, 500.0)), **IDEAL),
        ghost,
        tuple(sorted(changes, key=lambda change: change.sample)),
        tuple(HandRow(*row) for row in sorted(rows.items())),
        samples,
    )


@given(records())
@settings(max_examples=15, **QUICK)
def test_a_record_is_read_back_to_the_same_bits(record):
    ended = tuple(Ended(0.1 + 0.2, (1.0 / 3.0, -0.0), "ab") for _ in range(len(record.changes)))
    assert from_text(to_text(record, ended)) == (record, ended)
    plain, table = json.loads(json.dumps(record.plain())), to_table(record.hands)
    again = SessionRecord.of(plain, from_table(table))
    assert (again.plain(), again.hands) == (plain, record.hands)


@pytest.mark.parametrize("own", [{"gain": None}, {"gain": {"left": 1.0}}])
def test_a_value_that_has_no_text_is_refused_and_nothing_is_written(tmp_path, own):
    record = SessionRecord(ba.Scenario("NPD", own=own, **IDEAL))
    with pytest.raises(InputError):
        write_session(tmp_path / "me.toml", record, ())
    assert not [*tmp_path.iterdir()]


# -- what was walked is walked again ---------------------------------------------------------------
DO = {
    "go on": lambda s: s.advance(0.007),
    "push": lambda s: s.push({"q1": 12.3}, seconds=0.004),
    "push a link": lambda s: s.push(
        force=(-30.0, 1e-3), link="left_shin", at=(0, np.float64(-0.1))
    ),
    "pull": lambda s: s.pull("torso", (0.0, 0.3), (0.7, 1.1)),
    "let go": lambda s: s.let_go(),
    "other controller": lambda s: s.change(controller="NPD"),
    "observer": lambda s: s.change(controller="ADRC", bandwidth=250.0, order=2),
    "sensors": lambda s: s.change(noise=1e-5, delay=1e-3),
    "soft ground": lambda s: s.change(plant="mujoco"),
    "rigid ground": lambda s: s.change(plant="rigid"),
    "ghost": lambda s: s.change(GHOST, K_p=300.0),
    "back": lambda s: s.back(),
    "reset": lambda s: s.reset(),
}


ON_TWO_PLANTS = ["go on", "push", "go on", "soft ground", "go on", "pull", "go on", "rigid ground"]
BACK = ["observer", "go on", "push a link", "back", "push", "go on", "reset", "ghost", "go on"]


@given(st.lists(st.sampled_from(list(DO)), min_size=3, max_size=7))
@example([*ON_TWO_PLANTS, "ghost", "sensors"])
@example([*BACK, "other controller"])
@settings(max_examples=2, **QUICK)
def test_whatever_was_done_both_files_walk_it_again_bit_for_bit(tmp_path, done):
    session = Session(ba.Scenario("NPD", **IDEAL), {"K_d": 60.0})
    for name in (*done, "go on"):
        DO[name](session)
    walks = walks_of(session.record)
    for name in ("me.npz", "me.toml"):
        found = ba.replay_session(save_walked(session.record, walks, tmp_path / name))
        assert found.same, name
        assert found.record == session.record
        for walk, live in zip(found.walks, session.walking, strict=True):
            last = walk.trajectory.arcs[-1]
            assert last.t[-1] == live.now.t
            assert np.array_equal(last.x[-1, :10], live.now.x[:10])
            assert math.isfinite(walk.legality.least_normal_force)


# -- one session, looked at from all sides ---------------------------------------------------------
@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A session with a ghost, a pull and a change, in both kinds of files."""
    session = Session(ba.Scenario("ADRC", **IDEAL), {"controller": "NPD"})
    session.pull("torso", (0.0, 0.3), (0.7, 1.1))
    session.advance(0.01)
    session.let_go()
    session.change(GHOST, K_p=300.0)
    session.advance(0.01)
    made = tmp_path_factory.mktemp("session")
    save_session(session.record, made / "me.npz", made / "me.toml")
    return made


def simulate(*words):
    """The command, its exit code and what it prints."""
    done = CliRunner().invoke(app, ["simulate", *map(str, words)], catch_exceptions=False)
    return done.exit_code, done.output


def test_the_file_has_the_ghost_as_a_second_walk_and_the_picture_has_it_behind(folder, monkeypatch):
    path = folder / "me.npz"
    walks, found = load_walks([path]), ba.replay_session(path)
    assert list(walks) == ["ADRC", "NPD"]
    for stored, walk in zip(walks.values(), found.walks, strict=True):
        assert np.array_equal(stored.trajectory.arcs[0].x, walk.trajectory.arcs[0].x)
        assert np.array_equal(stored.signals.u, walk.signals.u)
    drawn = []
    monkeypatch.setattr(
        "biped_adrc.viz.export.export", lambda out, walks, clip: drawn.append(walks)
    )
    words = ["animate", str(path), "--ghost", str(path), "--out", str(folder / "me.gif")]
    assert CliRunner().invoke(app, words, catch_exceptions=False).exit_code == 0
    assert list(drawn[0])[-1] == "ADRC (me) 1"
    assert len(drawn[0]) == 4


def test_simulate_repeats_both_files_and_writes_them(folder, tmp_path):
    for name, out in (("me.npz", "a.toml"), ("me.toml", "a.npz"), ("me.toml", "a.csv")):
        code, said = simulate(folder / name, "--out", tmp_path / out)
        assert code == 0, said
        assert "20 samples of both walks" in said
        assert "bit for bit" in said
    assert (tmp_path / "a.toml").read_bytes() == (folder / "me.toml").read_bytes()
    assert ba.replay_session(tmp_path / "a.npz").same
    assert (tmp_path / "a.csv").read_text().startswith("t [s]")


def edited(folder, tmp_path, before, after):
    """The scenario file with one place changed."""
    text = (folder / "me.toml").read_text()
    assert before in text
    path = tmp_path / "me.toml"
    path.write_text(text.replace(before, after, 1))
    return path


def test_simulate_says_by_how_much_a_session_differs(folder, tmp_path):
    text = (folder / "me.toml").read_text()
    row = next(line for line in text.splitlines() if line.startswith("3,torso"))
    F_x = row.split(",")[4]
    path = edited(folder, tmp_path, row, row.replace(F_x, repr(float(F_x) - 1e-3)))
    code, said = simulate(path)
    gap = ba.replay_session(path).gap
    assert 0.0 < gap < 1e-3
    assert code == 1
    assert f"they differ by {gap:.3g} " in said.replace("\n", " ")


def test_a_file_without_states_is_walked_and_compared_with_nothing(folder, tmp_path):
    text = (folder / "me.toml").read_text()
    path = tmp_path / "me.toml"
    path.write_text(text[: text.index("[[ended]]")])
    assert ba.replay_session(path).gap is None
    code, said = simulate(path)
    assert code == 0
    assert "no states to compare" in said


def test_states_that_differ_on_the_way_alone_are_not_the_same():
    one = Ended(1.0, (0.0, 1.0), "ab")
    assert one.gap(one) == 0.0
    assert one.gap(one._replace(sha256="cd")) == math.inf
    assert one.gap(one._replace(sha256="cd", t=1.5)) == math.inf
    assert one.gap(one._replace(sha256="cd", x=(0.0, 1.5))) == 0.5


def test_every_state_of_a_walk_is_in_its_hash():
    run = walks_of(SessionRecord(ba.Scenario("NPD", **IDEAL), samples=5))[WALK].trajectory
    found = {Ended.of(run).sha256}
    arc = run.arcs[0]
    for k, i in ((0, 0), (2, 3), (5, 9)):
        x = arc.x.copy()
        x[k, i] = np.nextafter(x[k, i], 9.0)
        found.add(Ended.of(replace(run, arcs=(replace(arc, x=x),))).sha256)
    t = arc.t.copy()
    t[2] = np.nextafter(t[2], 9.0)
    found.add(Ended.of(replace(run, arcs=(replace(arc, t=t),))).sha256)
    assert len(found) == 5


@pytest.mark.parametrize("out", ["me.npz", "me.toml"])
def test_no_output_takes_the_place_of_the_session(folder, out):
    before = (folder / out).read_bytes()
    done = CliRunner().invoke(app, ["simulate", str(folder / out), "--out", str(folder / out)])
    assert isinstance(done.exception, InputError)
    assert (folder / out).read_bytes() == before


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["{toml}", "--K-p", "3"], "repeated as it was"),
        (["{toml}", "--push", "q1=3@1:0-1"], "repeated as it was"),
        (["{toml}", "--log", "a.csv"], "repeated as it was"),
        (["--scenario", "{toml}"], "inputs of a session"),
        (["{plain}"], r"no table \[session\]"),
        (["{run}"], "no session"),
        (["nowhere.npz"], "not found"),
        (["nowhere.toml"], "not found"),
        (["{toml}", "--out", "a.png"], "expected .npz"),
    ],
)
def test_what_is_no_session_is_refused(folder, tmp_path, monkeypatch, words, message):
    monkeypatch.chdir(tmp_path)
    Path("plain.toml").write_text('controller = "NPD"\n')
    if "{run}" in words:
        ba.walk_scenario(ba.Scenario("NPD", impacts=1)).save("run.npz")
    names = {"toml": folder / "me.toml", "plain": "plain.toml", "run": "run.npz"}
    given = [word.format(**names) for word in words]
    done = CliRunner().invoke(app, ["simulate", *given])
    assert isinstance(done.exception, InputError)
    with pytest.raises(InputError, match=message):
        raise done.exception


HEADER = "sample,link,x [m],z [m]"


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ("version = 1", "version = 2", "layout 2, expected 1"),
        ("version = 1", "", "'version' is missing"),
        ("samples = 20", "samples = 20.5", "whole number"),
        ("samples = 20", "samples = 4", "change is at sample 10, and the session has 4"),
        ("samples = 20", "samples = 10000000000", "expected 0 to"),
        ("samples = 20", "samples = 0", "sample"),
        ("samples = 20", "samples = 20\nhands = 1", "hands"),
        ("sample = 10, walk = 1", "sample = 21, walk = 1", "change is at sample 21"),
        ("sample = 10, walk = 1", "sample = 10, walk = 2", "walk 2 is changed"),
        ("sample = 10, walk = 1", "sample = 10", "'walk' is missing"),
        ("K_p = 300.0", "K_p = -300.0", "K_p"),
        ("K_p = 300.0", "K_p = nan", "K_p"),
        ("K_p = 300.0", 'robot = "compass"', "at sample 10 of the session: robot cannot change"),
        ("K_p = 300.0", "colour = 1", "colour"),
        ("\n3,torso", "\n3,tail", "at sample 3 of the session.*tail"),
        ("\n3,torso", "\n1,torso", "at sample 1 comes after one at sample 2"),
        ("\n3,torso", "\n2,torso", "at sample 2 comes after one at sample 2"),
        ("\n3,torso", "\n-3,torso", "line 5 .*'-3'"),
        ("\n3,torso,,0.3", "\n3,torso,nan,0.3", r"line 5, column 'x \[m\]': found 'nan'"),
        ("\n3,torso,,0.3", "\n3,torso,,9", "within 3 m"),
        ("\n3,torso,,0.3", "\n3,torso,0.3", "line 5 .* 10 cells, expected 11"),
        ("\n3,torso,,0.3", "\n3,,,0.3", "line 5 .* no link"),
        (HEADER, "sample,link,x [mm],z [m]", "columns"),
        (HEADER, "link,sample,x [m],z [m]", "columns"),
        ("[ghost]", "[ghost]\ncolour = 1", "colour"),
        ("\nx = [", '\nx = ["a", ', "could not convert"),
        ("sha256 = ", "sha = ", "'sha256' is missing"),
        ("'''\n\n[[ended]]", "\n\n[[ended]]", "not valid TOML"),
        ('controller = "ADRC"', 'controller = "ADRC"\nhardware = "none"', "not valid TOML"),
        ('hardware = "ideal"', "", "sample instants"),
    ],
)
def test_a_scenario_file_that_is_damaged_is_refused_by_name(
    folder, tmp_path, before, after, message
):
    path = edited(folder, tmp_path, before, after)
    with pytest.raises(InputError, match=f"(?s)me.toml.*{message}"):
        ba.replay_session(path)


def test_a_hand_of_another_robot_is_refused(folder, tmp_path):
    text = (folder / "me.toml").read_text()
    lines = [x.rpartition(",")[0] if x.count(",") == 10 else x for x in text.splitlines()]
    path = tmp_path / "me.toml"
    path.write_text("\n".join(lines))
    with pytest.raises(InputError, match="has 4 torques, expected 5"):
        ba.replay_session(path)


def rewritten(folder, tmp_path, **arrays):
    """The run with other arrays; None leaves one out."""
    with np.load(folder / "me.npz") as file:
        kept = {**dict(file), **{f"beside.{k}" if k != "meta" else k: x for k, x in arrays.items()}}
    np.savez(tmp_path / "me.npz", **{k: x for k, x in kept.items() if x is not None})
    return tmp_path / "me.npz"


def test_a_run_that_is_damaged_is_refused_by_name(folder, tmp_path):
    whole = (folder / "me.npz").read_bytes()
    with np.load(folder / "me.npz") as file:
        meta = str(file["meta"])
    table = str(load_beside(folder / "me.npz")["hand"])
    other = np.array(meta.replace('"version": 1', '"version": 7'))
    ghost = load_beside(folder / "me.npz")["ghost"]
    for path, message in (
        ((tmp_path / "cut.npz", whole[: len(whole) // 2]), "damaged"),
        ({"meta": other}, "layout 7"),
        ({"hand": np.array(table.replace("3,torso", "3,tail"))}, "tail"),
        ({"hand": np.array(table[: len(table) // 2])}, "line 6 .*cells"),
        ({"hand": None}, "damaged"),
        ({"ghost": None}, "ghost"),
        ({"ghost": ghost[: len(ghost) // 2]}, "damaged"),
    ):
        if isinstance(path, dict):
            path = rewritten(folder, tmp_path, **path)
        else:
            path[0].write_bytes(path[1])
            path = path[0]
        with pytest.raises(InputError, match=f"(?s){path.name}.*{message}"):
            ba.replay_session(path)


def test_a_scenario_file_of_a_session_is_no_scenario_elsewhere(folder):
    with pytest.raises(InputError, match="biped-adrc simulate"):
        read_scenario(folder / "me.toml")


def test_the_ghost_of_a_run_without_one_is_none(tmp_path):
    path = Session(ba.Scenario("NPD", **IDEAL))
    path.advance(0.003)
    saved = path.save(tmp_path / "me.npz")
    assert load_ghost(saved) is None
    assert len(load_walks([saved])) == 1


def with_record(folder, tmp_path, **values):
    """The run with other entries of its record."""
    with np.load(folder / "me.npz") as data:
        arrays = dict(data)
    meta = json.loads(str(arrays["meta"]))
    meta["settings"]["session"] |= values
    np.savez(tmp_path / "me.npz", **arrays | {"meta": np.array(json.dumps(meta))})
    return tmp_path / "me.npz"


@pytest.mark.parametrize(
    ("home", "said"),
    [
        ("planted:X", "reading a file imports nothing"),
        ("os:system", "reading a file calls nothing else"),
        ("subprocess:Popen", "reading a file calls nothing else"),
        ("biped_adrc.files:write_text", "reading a file calls nothing else"),
    ],
)
@pytest.mark.parametrize("whose", ["scenario", "ghost", "changes"])
def test_walking_a_run_again_imports_and_calls_nothing_that_it_names(
    folder, tmp_path, monkeypatch, home, said, whose
):
    monkeypatch.chdir(tmp_path)
    Path("planted.py").write_text("open('ran', 'w').close()\nclass X: pass\n")
    own = {"command": "touch ran", "args": ["touch", "ran"], "path": "ran", "text": ""}
    values = {"controller": home, "own": own}
    scenario = values | {"hardware": "ideal"}
    path = with_record(
        folder, tmp_path, **{whose: [[3, 0, values]] if whose == "changes" else scenario}
    )
    with pytest.raises(InputError, match=said):
        ba.replay_session(path)
    assert not Path("ran").exists()


def test_a_class_of_a_part_that_is_at_hand_is_walked_again(folder, tmp_path):
    path = with_record(
        folder, tmp_path, ghost={"controller": "biped_adrc.control.npd:NPDController"} | IDEAL
    )
    assert ba.replay_session(path).ghost.controller_name == "NPD"


@pytest.mark.parametrize("name", ["walk", "self"])
def test_a_change_of_what_is_no_field_is_refused(folder, tmp_path, name):
    with pytest.raises(InputError, match=f"at sample 3 of the session: .*{name}"):
        ba.replay_session(with_record(folder, tmp_path, changes=[[3, 0, {name: 1}]]))
