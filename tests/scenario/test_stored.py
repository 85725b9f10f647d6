"""Runs on disk: complete in themselves, readable without their author's classes."""

from __future__ import annotations

import json
import re
import shutil
import sys
from contextlib import suppress
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.analysis.signals import Signals
from biped_adrc.cli import app
from biped_adrc.control.delayed import Delayed
from biped_adrc.errors import InputError, OutputError
from biped_adrc.hybrid.storage import load, load_beside, save
from biped_adrc.resources import data_folder
from biped_adrc.scenario import registry
from biped_adrc.scenario.walker_record import Reader, Writer
from biped_adrc.viz.export import Clip, export

FAST = {"engine": "compiled", "impacts": 1}


def same(one: ba.Walk, other: ba.Walk) -> None:
    """Signals to the last bit, limits, certificates."""
    for f in fields(Signals):
        a, b = getattr(one.signals, f.name), getattr(other.signals, f.name)
        np.testing.assert_array_equal(a, b, err_msg=f.name)
    assert repr(one.certificates) == repr(other.certificates)
    assert repr(one.legality) == repr(other.legality)
    assert one.remarks == other.remarks


@pytest.mark.parametrize(
    "values",
    [
        {"controller": "NPD", "pushes": "q1,q2=10@1:0.1-0.2"},
        {"controller": "LESO", "hardware": "rabbit", "noise": 1e-4, "lag": 2e-3},
        {"controller": "ADRC", "continued": True, "mass": {"torso": 1.1}, "slope": 0.01},
        {"controller": "stride PI", "own": {"inner": "DOB"}, "push": "step", "on": "link torso"}
        | {"force": 3.0, "pushed_step": 1, "onset": 0.0},
        {"controller": "NPD", "period": 1e-3, "push": "noise", "amplitude": 5.0, "pushed_step": 1}
        | {"ground_rms": 2e-3, "impact_error": 0.02, "mass_error": 0.1},
        {"controller": "passive", "robot": "compass"},
    ],
)
def test_a_walk_comes_back(values: dict, tmp_path: Path) -> None:
    walk = ba.walk_scenario(ba.Scenario(**{**FAST, **values}))
    path = walk.save(tmp_path / "walk")
    again = ba.load_walk(path)
    same(walk, again)
    assert again.scenario == walk.scenario
    assert again.note == walk.note
    np.testing.assert_array_equal(load_beside(path)["signal.u"], walk.signals.u)


@pytest.mark.filterwarnings("error")
def test_a_walk_without_motors_has_an_outcome() -> None:
    """No joint is driven: no error and no torque, both 0."""
    s = ba.Scenario("passive", robot="compass", **FAST)
    left = ba.walk_scenario(s).outcome
    assert left.walked
    assert left.x_minus.shape == (left.impacts, 4)
    assert left.durations[0] > 0.1
    assert (left.peak_error, left.rms_error, left.peak_torque) == (0.0, 0.0, 0.0)


def test_a_walk_of_python_goes_on_where_it_was_stored(biped, gait, tmp_path: Path) -> None:
    walker = ba.Walker(biped, ba.ADRCController(gait.constraint), torque_limit=120.0)
    again = ba.load_walk(ba.walk(walker, gait, 1, engine="compiled").save(tmp_path / "a.npz"))
    assert again.scenario is None
    assert again.walker.model is None
    ends = [
        ba.walk(w, gait, 2, engine="compiled").trajectory.final_state
        for w in (walker, again.walker)
    ]
    np.testing.assert_array_equal(*ends)


def test_neither_the_folder_nor_the_urdf_matters(tmp_path: Path, monkeypatch) -> None:
    """The robot of a stored run is as it was: from elsewhere, heavier, or gone."""
    monkeypatch.chdir(tmp_path)
    shutil.copytree(data_folder("urdf") / "rabbit", "own")
    shutil.copy(data_folder("gaits") / "rabbit" / "published-identified.json", "gait.json")
    s = ba.Scenario("NPD", robot="own/robot.toml", gait="gait.json", **FAST)
    walk = ba.walk_scenario(s)
    path = walk.save("run.npz").resolve()
    record = Path("own/robot.toml")
    record.write_text(re.sub(r"mass = [0-9.]+", "mass = 25.0", record.read_text()))
    assert ba.Biped.load("own/robot.toml").mass != walk.walker.plant.mass
    same(walk, ba.load_walk(path))
    Path("elsewhere").mkdir()
    monkeypatch.chdir("elsewhere")
    shutil.rmtree(tmp_path / "own")
    (tmp_path / "gait.json").unlink()
    same(walk, ba.load_walk(path))
    done = CliRunner().invoke(app, ["plot", str(path), "-o", "figure.png"], catch_exceptions=False)
    assert done.exit_code == 0


def stored(own: str, period: float | None = 1e-3) -> ba.Walk:
    """Of a controller of one's own, which is forgotten then."""
    s = ba.Scenario(f"{own}:Mine", own={"gain": 0.8}, period=period, **FAST)
    walk = ba.walk_scenario(s)
    walk.save("mine.npz")
    del sys.modules[own]
    return walk


@pytest.mark.parametrize("period", [1e-3, None])
def test_an_own_controller_is_read_without_it(
    own: str, period: float | None, tmp_path: Path
) -> None:
    walk = stored(own, period)
    again = ba.load_walk("mine.npz")
    assert own not in sys.modules, "reading a file imports nothing"
    same(walk, again)
    assert again.controller_name == "Mine"
    assert again.plot().axes
    again.animate(tmp_path / "walk.html")
    for out in ("again.html", "figure.png"):
        line = ["animate" if out.endswith("html") else "plot", "mine.npz", "-o", out]
        assert CliRunner().invoke(app, line, catch_exceptions=False).exit_code == 0
    assert own not in sys.modules
    with pytest.raises(InputError, match=rf"cannot go on without.*'{own}:Mine'.*load_walk\(path"):
        ba.walk(again.walker, again.gait, 1)


def test_and_walks_on_when_it_is_given(own: str, monkeypatch) -> None:
    walk = stored(own)
    Mine = registry.own("controller", f"{own}:Mine")
    given = ba.load_walk("mine.npz", controller=Mine)
    assert given.walker.controller == Mine(given.gait.constraint, 0.8)
    assert given.remarks == walk.remarks
    again = ba.walk(given.walker, given.gait, 1, engine="compiled")
    np.testing.assert_array_equal(again.trajectory.final_state, walk.trajectory.final_state)
    as_object = ba.load_walk("mine.npz", controller=Mine(given.gait.constraint, 0.8))
    assert isinstance(as_object.walker.controller, Mine)
    monkeypatch.setattr(registry, "REGISTRY", {k: dict(v) for k, v in registry.REGISTRY.items()})
    ba.register("controller", "mine", Mine)
    assert isinstance(ba.load_walk("mine.npz").walker.controller, Mine)
    with pytest.raises(InputError, match="expected a Controller or its class"):
        ba.load_walk("mine.npz", controller=Path)


def test_what_is_missing_is_carried_on(own: str, tmp_path: Path) -> None:
    """Read without its class and saved again, a walk can still be read with it."""
    walk = stored(own)
    again = ba.load_walk("mine.npz").save("again.npz")
    assert own not in sys.modules
    assert json.loads(Path("again.json").read_text())["settings"]["own"] == [f"{own}:Mine"]
    same(walk, ba.load_walk(again))
    Mine = registry.own("controller", f"{own}:Mine")
    given = ba.load_walk(again, controller=Mine)
    assert given.walker.controller == Mine(given.gait.constraint, 0.8)
    assert given.walker.controller.reference is given.gait.constraint
    assert given.remarks == walk.remarks


@pytest.mark.parametrize("name", ["Inner", "Seen"])
def test_a_part_inside_a_part_of_the_package_is_given(own, name, biped, gait, tmp_path) -> None:
    (tmp_path / f"{own}_parts.py").write_text(
        f"import biped_adrc as ba\nfrom {own} import Mine\n"
        "class Inner(Mine):\n    pass\n"
        "class Seen(ba.GPIObserver):\n    pass\n"
    )
    kind = registry.own("controller", f"{own}_parts:{name}")
    if name == "Inner":
        controller = Delayed(kind(gait.constraint), 1e-3)
    else:
        controller = ba.ADRCController(gait.constraint, kind.from_poles(ba.TABLE_I))
    ba.walk(ba.Walker(biped, controller), gait, 1, ba.RK4(1e-3)).save("a.npz")
    absent = ba.load_walk("a.npz")
    with pytest.raises(InputError, match=rf"'{own}_parts:{name}' not of this package; give it"):
        ba.walk(absent.walker, absent.gait, 1)
    for path in ("a.npz", absent.save("b.npz")):
        made = ba.load_walk(path, controller=kind).walker.controller
        assert type(made) is type(controller)
        assert type(made.inner if name == "Inner" else made.observer) is kind


def test_what_is_given_has_the_name_that_is_stored(own: str, biped, gait) -> None:
    stored(own)
    Needy = registry.own("controller", f"{own}:Needy")
    for given in (Needy, ba.NPDController, f"{own}:Mine"):
        with pytest.raises(InputError, match=rf"expected a Controller.*'{own}:Mine'"):
            ba.load_walk("mine.npz", controller=given)
    ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 1).save("npd.npz")
    Mine = registry.own("controller", f"{own}:Mine")
    with pytest.raises(InputError, match="nothing, so leave it out"):
        ba.load_walk("npd.npz", controller=Mine)


def test_a_class_may_have_moved_to_another_module(own: str, tmp_path: Path) -> None:
    """As one of a script, which is of __main__ there."""
    stored(own)
    shutil.copy(tmp_path / f"{own}.py", tmp_path / f"{own}_moved.py")
    Mine = registry.own("controller", f"{own}_moved:Mine")
    assert isinstance(ba.load_walk("mine.npz", controller=Mine).walker.controller, Mine)


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("a" * 300, "too long"),
        ("a" * 300 + ".npz", "too long"),
        (None, "expected the name of a file"),
        (5, "expected the name of a file"),
        (b"a.npz", "expected the name of a file"),
        ("x\0y", "expected the name of a file"),
        ("~/x.npz", "expanduser"),
    ],
)
def test_a_name_that_cannot_be_written(sound, path, message: str, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    walk = ba.load_walk(sound)
    with pytest.raises((InputError, OutputError), match=message):
        walk.save(path)
    assert not list(tmp_path.iterdir())


def test_settings_that_json_has_not(sound: Path, tmp_path: Path) -> None:
    walk = ba.load_walk(sound)
    with pytest.raises(InputError, match=r"ndarray.*expected settings of numbers, text, lists"):
        walk.save(tmp_path / "a.npz", {"a": np.array([1.0])})


def test_a_source_that_changed_is_named(own: str, tmp_path: Path) -> None:
    stored(own)
    path = tmp_path / f"{own}.py"
    path.write_text(path.read_text().replace("5000.0", "4000.0"))
    changed = ba.load_walk("mine.npz", controller=registry.own("controller", f"{own}:Mine"))
    assert changed.remarks == (f"the source of {own}:Mine has changed since this walk",)


def test_what_is_in_the_file(own: str) -> None:
    stored(own)
    settings = json.loads(Path("mine.json").read_text())["settings"]
    assert settings["own"] == [f"{own}:Mine"]
    assert settings["scenario"]["own"] == {"gain": 0.8}
    parts = json.loads(str(load_beside("mine.npz")["walker"]))["parts"]
    (mine,) = [part for part in parts if part["class"] == f"{own}:Mine"]
    assert mine["values"]["gain"] == 0.8
    assert len(mine["source"]) == 12
    assert any(part["class"] == "biped_adrc.robots.urdf:Tree" for part in parts)


@pytest.mark.parametrize(
    "change",
    [
        {"class": "os:system"},
        {"class": "biped_adrc.cli.__main__:main"},
        {"class": "biped_adrc.control.npd:nothing"},
        {"class": "biped_adrc.model.biped:Path"},
        {"values": {"colour": 3}},
        {"values": {}},
    ],
)
def test_a_file_makes_nothing_but_parts_of_a_walker(change, biped, gait, tmp_path) -> None:
    path = ba.walk(
        ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 1, engine="compiled"
    ).save(tmp_path / "a.npz")
    beside = load_beside(path)
    record = json.loads(str(beside["walker"]))
    walker = record["parts"][record["walker"]]["values"]
    record["parts"][walker["plant"]["part"]] |= change
    save(load(path), path, None, {**beside, "walker": json.dumps(record)})
    with pytest.raises(InputError, match=r"a\.npz"):
        ba.load_walk(path)


# -- damaged files -----------------------------------------------------------------------------------
@pytest.fixture(scope="module")
def sound(tmp_path_factory) -> Path:
    """A run of two steps, whole."""
    s = ba.Scenario("NPD", engine="compiled", impacts=2)
    return ba.walk_scenario(s).save(tmp_path_factory.mktemp("sound") / "a.npz")


def refused(path: Path) -> None:
    """In one error that names the file, when the run is read and not later."""
    with pytest.raises(InputError, match=re.escape(f"run '{path}'")):
        ba.load_walk(path)


def test_damaged_bytes_are_refused(sound: Path, tmp_path: Path) -> None:
    """A compressed file has checksums: a byte changed is seen, or of no matter."""
    random, whole, path = np.random.default_rng(3), sound.read_bytes(), tmp_path / "a.npz"
    walk = ba.load_walk(sound)
    for _ in range(60):
        data = bytearray(whole)
        for place in random.integers(len(data), size=random.choice([1, 3, 30])):
            data[place] = random.integers(256)
        path.write_bytes(data)
        with suppress(InputError):
            same(walk, ba.load_walk(path))
    for cut in random.integers(len(whole), size=10):
        path.write_bytes(whole[:cut])
        refused(path)


@pytest.mark.parametrize("name", ["t0", "x0", "dx0", "x_minus0", "t1", "x1"])
@pytest.mark.parametrize(
    "damage", [None, lambda a: a[:-1], lambda a: np.zeros(0), lambda a: np.array(3)]
)
def test_damaged_arrays_are_refused(sound: Path, tmp_path: Path, name, damage) -> None:
    arrays = dict(np.load(sound))
    whole = arrays.pop(name)
    if damage is not None:
        arrays[name] = damage(whole)
    np.savez(tmp_path / "a.npz", **arrays)
    refused(tmp_path / "a.npz")


@pytest.fixture(scope="module")
def soft(tmp_path_factory) -> Path:
    pytest.importorskip("mujoco")
    walk = ba.walk_scenario(ba.Scenario("NPD", plant="mujoco", period=1e-3, impacts=1))
    return walk.save(tmp_path_factory.mktemp("soft") / "walk.npz")


@pytest.mark.parametrize("name", ["u", "zeta", "foot_force", "foot_place", "foot_speed"])
@pytest.mark.parametrize(
    "damage", [None, lambda a: a[:, :1], lambda a: a[..., None], lambda a: a * np.nan]
)
def test_damaged_readings_of_the_feet_are_refused(soft: Path, tmp_path: Path, name, damage) -> None:
    arrays = dict(np.load(soft))
    whole = arrays.pop(f"read0_{name}")
    if damage is not None:
        arrays[f"read0_{name}"] = damage(whole)
    np.savez(tmp_path / "a.npz", **arrays)
    refused(tmp_path / "a.npz")


WRONG = {
    "meta": {"status": ("x", None, -1, []), "settings": ("x", None, -1), "detail": ()}
    | {"events": ("x", None, -1, []), "format": ("x", None)},
    "beside.walker": {key: ("x", None, []) for key in ("parts", "walker", "gait")},
}
"""By array and key of its record."""


@pytest.mark.parametrize(
    ("array", "key", "values"), [(a, key, x) for a, of in WRONG.items() for key, x in of.items()]
)
def test_damaged_records_are_refused(sound: Path, tmp_path: Path, array, key, values) -> None:
    arrays, path = dict(np.load(sound)), tmp_path / "a.npz"
    whole = json.loads(str(arrays[array]))
    left = {name: x for name, x in whole.items() if name != key}
    for record in (left, *({**whole, key: x} for x in values)):
        np.savez(path, **{**arrays, array: np.array(json.dumps(record))})
        refused(path)


@pytest.mark.parametrize("signal", ["t", "u"])
def test_damaged_signals_are_refused(own: str, tmp_path: Path, signal: str) -> None:
    stored(own)
    arrays = dict(np.load("mine.npz"))
    name = f"beside.signal.{signal}"
    np.savez("mine.npz", **{**arrays, name: arrays[name][1:]})
    refused(Path("mine.npz"))


def test_states_of_another_size_are_refused(sound: Path, tmp_path: Path) -> None:
    arrays = dict(np.load(sound))
    for name in [key for key in arrays if re.fullmatch(r"(x|dx|x_minus|x_plus)\d", key)]:
        arrays[name] = np.concatenate((arrays[name], arrays[name][..., :2]), axis=-1)
    np.savez(tmp_path / "a.npz", **arrays)
    with pytest.raises(InputError, match=r"its states have 12 numbers, its walker's 10"):
        ba.load_walk(tmp_path / "a.npz")


def test_a_run_without_its_walker_is_refused(sound: Path, tmp_path: Path) -> None:
    path = save(load(sound), tmp_path / "a.npz")
    with pytest.raises(InputError, match="does not say which robot"):
        ba.load_walk(path)


def test_what_is_no_name_is_not_read() -> None:
    for path in (None, 5, b"a.npz", "a" * 300, "x\0y"):
        with pytest.raises(InputError, match=r"^(a run is read from|run '[ax])"):
            ba.load_walk(path)


def test_plain_values_come_back() -> None:
    values = {
        "a": (1, [2.5, None]),
        "b": np.arange(6.0).reshape(2, 3),
        "c": 1 + 2j,
        "d": Path("x/y"),
    }
    values |= {"e": ba.ResetPolicy.MODEL, "f": np.float64(0.1), "g": np.zeros((0, 4)), "h": ba.RK4}
    del values["h"]
    writer = Writer()
    record = json.loads(json.dumps(writer.plain(values)))
    again = Reader(writer.records, {}).made(record)
    assert again.keys() == values.keys()
    for name, x in values.items():
        np.testing.assert_array_equal(again[name], x) if isinstance(x, np.ndarray) else None
        assert isinstance(x, np.ndarray) or again[name] == x
    assert again["g"].shape == (0, 4)


def test_a_walk_of_python_keeps_the_name_of_its_controller(own: str, gait, biped) -> None:
    Mine = registry.own("controller", f"{own}:Mine")
    ba.walk(ba.Walker(biped, Mine(gait.constraint, 0.8)), gait, 1).save("named.npz")
    del sys.modules[own]
    assert ba.load_walk("named.npz").controller_name == "Mine"


@pytest.mark.parametrize(
    ("name", "change", "said"),
    [
        (
            "x0",
            lambda x: np.where(np.arange(x.size).reshape(x.shape) == 7, np.nan, x),
            "x with NaN",
        ),
        ("dx1", lambda x: x * np.inf, "x' with NaN or infinity"),
        ("x1", lambda x: x.astype(complex), "x of type complex128"),
        ("t0", lambda t: t.astype(str), "t of type <U32"),
        ("t0", lambda t: (1e6 * t).astype(int), "t of type int64"),
        ("x_minus0", lambda x: x * np.nan, "x- with NaN"),
        ("t1", lambda t: t - 0.2, "arc 1 begins at"),
        ("t0", lambda t: t[::-1], "no times"),
        ("t1", lambda t: np.append(t[:-1], 1e12), "its event is at"),
    ],
)
def test_what_is_no_number_and_goes_back_in_time_is_refused(sound, tmp_path, name, change, said):
    with np.load(sound) as data:
        arrays = dict(data)
    arrays[name] = change(arrays[name])
    np.savez(tmp_path / "a.npz", **arrays)
    with pytest.raises(InputError, match=re.escape(said)):
        ba.load_walk(tmp_path / "a.npz")


def test_a_small_file_that_unpacks_to_too_much_is_refused(sound, tmp_path, monkeypatch):
    monkeypatch.setattr("biped_adrc.hybrid.storage.MOST_BYTES", 1000)
    with pytest.raises(InputError, match=r"unpacked it has \d+ bytes, expected at most 1000"):
        ba.load_walk(sound)


def test_a_picture_of_too_many_frames_is_refused(sound):
    """Times of 1e12 s asked for 182 TiB."""
    walk = ba.load_walk(sound)
    *arcs, last = walk.trajectory.arcs
    late = replace(last, t=np.append(last.t[:-1], 1e12), event=None)
    walk = replace(walk, trajectory=replace(walk.trajectory, arcs=(*arcs, late)))
    for name in ("a.html", "a.gif", "apart.gif"):
        with pytest.raises(InputError, match=r"\d frames, expected at most 200000"):
            export(Path(name), {"NPD": walk}, Clip(apart=name == "apart.gif"))
