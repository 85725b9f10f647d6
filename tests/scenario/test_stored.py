"""Runs on disk: complete in themselves, and readable without their author's classes.

same(one, other) asserts equal signals, verdicts and remarks of two walks. The fixture own is the name of a
module in the working directory with a controller Mine.
"""

from __future__ import annotations

import json
import re
import shutil
import sys
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.signals import Signals
from biped_adrc.core.errors import InputError
from biped_adrc.core.files import data_folder
from biped_adrc.hybrid.storage import load, load_beside, save
from biped_adrc.scenario.stored import load_walks, rebuilt_walk
from tests.commands import command

FAST = {"run.engine": "compiled", "run.impacts": 1}


class Nothing(ba.Disturbance):
    """No torque at all."""

    def torque(self, t, step, t_start, q, v):
        return np.zeros(5)


def same(one: ba.Walk, other: ba.Walk) -> None:
    """Two walks have equal signals, to the last bit, limits, certificates and remarks."""
    for f in fields(Signals):
        a, b = getattr(one.signals, f.name), getattr(other.signals, f.name)
        np.testing.assert_array_equal(a, b, err_msg=f.name)
    assert repr(one.certificates) == repr(other.certificates)
    assert repr(one.feasibility) == repr(other.feasibility)
    assert one.remarks == other.remarks


NOISY = {"profile": "rabbit", "encoders.noise": 1e-4, "lag": 2e-3}
FORCE = {"shape": "step", "link": "torso", "force": 3.0, "step": 1, "onset": 0.0}
NOISE = {"shape": "noise", "torque": 5.0, "step": 1}
WRONG = {"impact_width": 0.02, "mass_width": 0.1}


@pytest.mark.parametrize(
    "values",
    [
        {"controller": "LESO", "hardware": NOISY},
        {"controller": {"name": "stride PI", "inner": "DOB"}, "pushes": [FORCE]},
        {"controller": "NPD", "hardware.period": 1e-3, "pushes": [NOISE], "errors": WRONG}
        | {"ground.rms": 2e-3},
        {"controller": "passive", "robot": "compass"},
    ],
)
def test_a_walk_comes_back(values: dict, tmp_path: Path) -> None:
    """Signals, certificates, verdict, scenario and note of a stored walk are those of the walk, to the last
    bit: with encoders and lag, outer loop and force, noise and model errors, and without motors.
    """
    walk = ba.walk_scenario(ba.Scenario(**{**FAST, **values}))
    path = walk.save(tmp_path / "walk")
    again = ba.load_walk(path)
    same(walk, again)
    assert again.scenario == walk.scenario
    assert again.note == walk.note
    np.testing.assert_array_equal(load_beside(path)["signal.u"], walk.signals.u)


def test_a_walk_without_motors_has_an_outcome() -> None:
    """No joint is driven: no error and no torque, both 0."""
    s = ba.Scenario("passive", robot="compass", **FAST)
    outcome = ba.walk_scenario(s).outcome
    assert outcome.walked
    assert outcome.x_minus.shape == (outcome.impacts, 4)  # two angles and two rates
    assert outcome.durations[0] > 0.1
    assert (outcome.peak_error, outcome.rms_error, outcome.peak_torque) == (0.0, 0.0, 0.0)


def test_a_walk_of_python_goes_on_where_it_was_stored(biped, gait, tmp_path: Path) -> None:
    """A walk of a Walker, without a scenario: the loaded walker walks on to the same final state."""
    walker = ba.Walker(biped, ba.ADRCController(gait.constraint), torque_limit=120.0)
    again = ba.load_walk(ba.walk(walker, gait, 1, engine="compiled").save(tmp_path / "a.npz"))
    assert again.scenario is None
    assert again.walker.model is None  # the controller's model is the plant, as in the walk
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
    command("plot", path, "-o", "figure.png")


def test_factors_of_an_older_file_are_relative_errors(tmp_path: Path) -> None:
    """A file without names of the states has factors of masses where there are errors now: 1.2 is 0.2, and the
    scenario walks the robot of the file.
    """
    asked = ba.Scenario(
        "NPD", errors={"mass": {"torso": 0.2}, "mass_width": 0.0}, run={"impacts": 1}
    )
    path = ba.walk_scenario(asked).save(tmp_path / "x")
    old = load(path, lambda step, start: ba.Mode(int(step), start))
    del old.settings["states"]
    old.settings["scenario"]["errors"]["mass"]["torso"] = 1.2
    walk = ba.load_walk(save(old, tmp_path / "old", old.settings, load_beside(path)))
    plant = ba.walk_scenario(walk.scenario).walker.plant
    assert plant.weight == walk.walker.plant.weight


def test_walks_of_one_controller_are_named_by_their_files(tmp_path: Path) -> None:
    """The walk of one file is named by its controller; two of the same controller have their paths too. A walk
    made again of its scenario and trajectory is the same; a file that does not have the walker is refused.
    """
    walk = ba.walk_scenario(ba.Scenario("NPD", hardware="ideal", **FAST))
    a, b = (walk.save(tmp_path / name) for name in ("a.npz", "b.npz"))
    assert list(load_walks([a])) == ["NPD"]
    assert list(load_walks([a, b])) == [f"NPD ({a})", f"NPD ({b})"]
    same(rebuilt_walk(walk.scenario, walk.trajectory), walk)
    beside = {name: x for name, x in load_beside(a).items() if name != "walker"}
    with pytest.raises(InputError, match=r"a\.npz'.* it names no walker, as runs of Walk\.save"):
        ba.load_walk(save(load(a), a, None, beside))


def test_a_disturbance_of_ones_own_is_absent_when_it_is_read_again(biped, gait, tmp_path) -> None:
    """`Nothing` is a class of this file, which a reader does not have: signals come back from the file, and
    only walking on, which would need the class, is refused.
    """
    walker = ba.Walker(biped, ba.NPDController(gait.constraint), Nothing())
    with pytest.warns(ba.WalkWarning, match="Nothing did not act: it was zero"):
        walk = ba.walk(walker, gait, 1)
    with pytest.raises(InputError, match="an outcome is of a scenario's walk"):
        walk.outcome  # noqa: B018
    again = ba.load_walk(walk.save(tmp_path / "a.npz"))
    same(walk, again)
    with pytest.raises(InputError, match=r"cannot go on without '.*:Nothing'; walk it again"):
        ba.walk(again.walker, gait, 1)


def stored(own: str, period: float | None = 1e-3) -> ba.Walk:
    """A walk, saved as mine.npz, of a controller of one's own, whose module is forgotten then.

    own: the module's name. period [s] of the clock; None for continuous time.
    """
    s = ba.Scenario({"name": f"{own}:Mine", "gain": 0.8}, hardware={"period": period}, **FAST)
    walk = ba.walk_scenario(s)
    walk.save("mine.npz")
    del sys.modules[own]
    return walk


@pytest.mark.parametrize("period", [1e-3, None])
def test_an_own_controller_is_read_without_it(
    own: str, period: float | None, tmp_path: Path
) -> None:
    """The module of the stored walk's controller is forgotten (`stored`): reading, plotting and animating
    import nothing; only walking on needs the class and is refused.
    """
    walk = stored(own, period)
    again = ba.load_walk("mine.npz")
    assert own not in sys.modules, "reading a file imports nothing"
    same(walk, again)
    assert again.controller_name == "Mine"
    assert again.plot().axes
    again.animate(tmp_path / "walk.html")
    for out in ("again.html", "figure.png"):
        command("animate" if out.endswith("html") else "plot", "mine.npz", "-o", out)
    assert own not in sys.modules
    with pytest.raises(InputError, match=rf"cannot go on without '{own}:Mine'; walk it again"):
        ba.walk(again.walker, again.gait, 1)


def test_a_stored_walk_of_an_own_controller_is_walked_again_by_its_scenario(own: str) -> None:
    """The module lies in the working directory still, and is imported again."""
    walk = stored(own)
    again = ba.walk_scenario(ba.load_walk("mine.npz").scenario)
    np.testing.assert_array_equal(again.trajectory.final_state, walk.trajectory.final_state)


@pytest.mark.parametrize(
    "change",
    [
        {"class": "os:system"},
        {"class": "biped_adrc.__main__:main"},
        {"class": "biped_adrc.model.biped:Path"},
        {"values": {}},
    ],
)
def test_a_file_makes_nothing_but_parts_of_a_walker(change, biped, gait, tmp_path) -> None:
    """A record that names another callable in the plant's place, or has no values, is refused."""
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


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("q", lambda x: x[:1]),
        ("u", lambda x: x.astype(str)),
        ("t", lambda x: x.astype(str)),
        ("xi", lambda x: x[:, :3]),
        ("kinetic", lambda x: x[0]),
        ("hip", lambda x: x[:, :1]),
    ],
)
def test_signals_are_numbers_of_each_stored_time(name, change, biped, gait, tmp_path) -> None:
    """name: a signal of a sound file, which is read; change: what is done to it (rows or columns lost, texts).
    Then the file is refused by the name of the signal.
    """
    path = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 1).save(
        tmp_path / "a.npz"
    )
    beside = load_beside(path)
    assert ba.load_walk(save(load(path), path, None, beside)).impacts == 1
    save(load(path), path, None, {**beside, f"signal.{name}": change(beside[f"signal.{name}"])})
    with pytest.raises(InputError, match=f"signal {name} is .*expected numbers"):
        ba.load_walk(path)
