"""Whatever is drawn: walks end with a status and finite numbers, damaged files are read or refused.

Hypothesis draws scenarios and damages, always the same ones (`FIXED`); only errors of the package may be
raised.
"""

from __future__ import annotations

import contextlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import biped_adrc as ba
from biped_adrc.analysis.feasibility import OUTCOMES
from biped_adrc.extras.logs.log_file import write_log
from biped_adrc.extras.logs.robot_log import logged
from biped_adrc.studies.study import read_study

FIXED = settings(deadline=None, derandomize=True, database=None)
STUDY = """
name = "walks"
seeds = 2
[grid]
controller = ["ADRC", "NPD"]
period = ["1 ms", "2 ms"]
"""
SCENARIOS = st.fixed_dictionaries(
    {
        "controller.name": st.sampled_from(["NPD", "ADRC"]),
        "controller.K_p": st.floats(1.0, 1e7),
        "controller.K_d": st.floats(0.1, 1e4),
        "pushes.0.torque": st.floats(0.1, 1e4),
        "start.speed": st.floats(-0.9, 2.0),
        "ground.slope": st.floats(-0.3, 0.3),
    }
)


def ends_with_finite_numbers(values, engine):
    s = ba.Scenario(
        pushes=[{"shape": "pulse", "step": 1}], run={"impacts": 1, "engine": engine}, **values
    )
    try:
        walk = ba.walk_scenario(s)
    except ba.BipedError:
        return
    run = walk.trajectory
    assert isinstance(run.status, ba.Status)
    for arc in run.arcs:
        assert all(np.all(np.isfinite(x)) for x in (arc.t, arc.x, arc.dx))
    assert np.all(np.isfinite(run.final_state))
    assert walk.feasibility.outcome in OUTCOMES


@settings(FIXED, max_examples=20)
@given(SCENARIOS)
def test_a_compiled_walk_ends_with_a_status_and_finite_numbers(values):
    """Gains, push, start and slope far outside of what walks: refused by a BipedError, or an outcome and
    numbers that are stored finite."""
    ends_with_finite_numbers(values, "compiled")


@settings(FIXED, max_examples=3)
@given(SCENARIOS)
def test_a_walk_on_pinocchio_ends_with_a_status_and_finite_numbers(values):
    """Drawn scenarios are walked by Pinocchio, fewer than by the compiled engine, since that is slow."""
    ends_with_finite_numbers(values, "pinocchio")


@pytest.fixture(scope="module")
def files(tmp_path_factory, biped, gait):
    """By kind: the bytes of a whole file, where changed ones go, and what reads them."""
    folder = tmp_path_factory.mktemp("files")
    walk = ba.walk_scenario(ba.Scenario("NPD", run={"impacts": 1}, hardware={"period": 1e-3}))
    paths = {
        "run": walk.save(folder / "run.npz"),
        "gait": folder / "gait.json",
        "study": folder / "study.toml",
        "log": write_log(logged(walk), folder / "log.csv", biped),
    }
    gait.save(paths["gait"])
    paths["study"].write_text(STUDY)
    read = {
        "run": ba.load_walk,
        "gait": lambda path: ba.load_gait(path, biped),
        "study": read_study,
        "log": lambda path: ba.read_log(path, biped),
    }
    return {kind: (path.read_bytes(), path, read[kind]) for kind, path in paths.items()}


@settings(FIXED, max_examples=100)
@given(
    kind=st.sampled_from(["run", "gait", "study", "log"]),
    at=st.floats(0.0, 1.0, exclude_max=True),
    cut=st.integers(0, 400),
    added=st.binary(max_size=40),
)
def test_damaged_bytes_are_read_or_refused(files, kind, at, cut, added):
    """`cut` bytes from the share `at` of a file on are replaced by others: it is read, or a BipedError says
    why not. Any other exception fails the test."""
    whole, path, read = files[kind]
    first = int(at * len(whole))
    path.write_bytes(whole[:first] + added + whole[first + cut :])
    with contextlib.suppress(ba.BipedError):
        read(path)
