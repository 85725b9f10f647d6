"""Generated code against Pinocchio, and its store on disk."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from biped_adrc.engine.dynamics import CompiledDynamics
from biped_adrc.engine.generate import dynamics_source
from biped_adrc.engine.plant import plant_arrays
from biped_adrc.engine.store import VARIABLE, cache_folder, load_source
from biped_adrc.errors import ModelError
from biped_adrc.model.biped import Biped
from biped_adrc.model.planar import PlanarTree
from biped_adrc.model.robots import robot_names


@pytest.fixture(scope="module", autouse=True)
def cache(tmp_path_factory):
    folder = tmp_path_factory.mktemp("cache")
    before = os.environ.get(VARIABLE)
    os.environ[VARIABLE] = str(folder)
    yield folder
    if before is None:
        del os.environ[VARIABLE]
    else:
        os.environ[VARIABLE] = before


@pytest.mark.parametrize("robot", robot_names())
def test_the_text_itself_is_pinocchio_s(robot):
    """Before any compiler: the generated lines run as Python."""
    biped = Biped.load(robot)
    names = {"math": math}
    exec(dynamics_source(PlanarTree.of(biped)), names)
    K, n = plant_arrays(biped), biped.n
    random = np.random.default_rng(7)
    for _ in range(20):
        q, v = random.normal(size=(2, n))
        D, Omega = np.zeros((n, n)), np.zeros(n)
        names["dynamics"](K, q, v, D, Omega)
        np.testing.assert_allclose(D, biped.inertia(q), rtol=0, atol=1e-11 * np.max(np.abs(D)))
        bias = biped.bias(q, v)
        np.testing.assert_allclose(Omega, bias, rtol=0, atol=1e-11 * np.max(np.abs(bias)))


def test_compiled_code_serves_every_preset_and_error():
    """One structure, one compilation; ten thousand states of three parameter sets and a heavier plant."""
    rabbit = Biped.load("rabbit", "identified")
    compiled = CompiledDynamics.of(rabbit)
    random = np.random.default_rng(8)
    robots = [Biped.load("rabbit", p) for p in ("identified", "identified-bare", "tac2003")]
    robots.append(rabbit.with_errors(mass={"torso": 1.2}, inertia={"thigh": 0.9}))
    for robot in robots:
        again = CompiledDynamics(compiled.fill, plant_arrays(robot))
        for _ in range(2500):
            q, v = random.uniform(-4.0, 4.0, 5), random.normal(0.0, 5.0, 5)
            D, Omega = again.inertia_and_bias(q, v)
            assert np.max(np.abs(D - robot.inertia(q))) <= 1e-11 * np.max(np.abs(D))
            assert np.max(np.abs(Omega - robot.bias(q, v))) <= 1e-11 * np.max(np.abs(Omega))
    assert len(compiled.fill.signatures) == 1


def test_code_of_another_robot_is_refused():
    rabbit = Biped.load("rabbit", "identified")
    compiled = CompiledDynamics.of(rabbit)
    with pytest.raises(ModelError, match="differs from Pinocchio's"):
        compiled.check(Biped.load("rabbit", "tac2003"))


def test_a_second_process_takes_it_from_the_disk(cache):
    CompiledDynamics.of(Biped.load("rabbit"))
    lines = (
        "from biped_adrc.engine.dynamics import CompiledDynamics as C; from biped_adrc import Biped; "
        "c = C.of(Biped.load('rabbit')); print(sum(c.fill.stats.cache_hits.values()))"
    )
    out = subprocess.run(
        [sys.executable, "-c", lines], capture_output=True, text=True, check=True, timeout=120
    )
    assert out.stdout.strip() == "1"


def test_a_damaged_module_is_written_again(cache):
    source = "answer = 42\n"
    path = Path(str(load_source(source).__file__))
    assert cache in path.parents
    path.write_text("answer = 41\n")
    assert load_source(source).answer == 42
    assert path.read_text() == source


def test_damaged_machine_code_is_compiled_again():
    rabbit = Biped.load("rabbit")
    first = CompiledDynamics.of(rabbit)
    folder = Path(first.fill.py_func.__code__.co_filename).parent / "__pycache__"
    broken = [*folder.glob("*.nbc"), *folder.glob("*.nbi")]
    assert broken
    for path in broken:
        path.write_bytes(b"broken")
    again = CompiledDynamics.of(rabbit)
    q, v = np.linspace(0.1, 0.5, 5), np.ones(5)
    np.testing.assert_array_equal(again.inertia_and_bias(q, v)[1], first.inertia_and_bias(q, v)[1])


def test_what_cannot_be_written_is_kept_elsewhere(tmp_path, monkeypatch):
    blocked = tmp_path / "file"
    blocked.write_text("no folder")
    monkeypatch.setenv(VARIABLE, str(blocked))
    assert cache_folder() == blocked
    module = load_source("answer = 43\n")
    assert module.answer == 43
    assert blocked not in Path(str(module.__file__)).parents
