"""Mistakes with files: each command line ends with one sentence and its exit code, without a traceback."""

import json
import os
import shlex
from pathlib import Path

import pytest
from typer.testing import CliRunner

from biped_adrc.cli import app
from biped_adrc.core.errors import BipedError
from biped_adrc.gait.gait import Gait

LONG = "n" * 300
URDF = Path(__file__).parents[1] / "urdf" / "rabbit" / "floating.urdf"
STUDY = """
name = "a"
[base]
controller.name = "NPD"
run.impacts = 1
[grid]
controller.K_p = [5000.0]
"""
SEARCH = """
name = "s"
base = {controller.name = "LESO"}
[search]
budget = 10
generation = 4
variables = {controller.observer.bandwidth = {from = 50, to = 500}}
objective = {column = "rms_error"}
walks = {search = {seeds = [0]}, choice = {seeds = [10]}, test = {seeds = [20]}}
"""

MISTAKES = [
    (f"simulate --gait {LONG}", 3, "no gait"),
    (f"simulate --gait {LONG}.json", 3, "too long"),
    (f"simulate -o {LONG}", 5, "too long"),
    ("simulate -o 'a\nb.npz'", 3, "control characters"),
    ("simulate -o pipe.npz", 5, "not a regular file"),
    (f"study study.toml -o {LONG}", 5, "too long"),
    ("study study.toml -o afile", 3, "is a file"),
    ("study study.toml -o afile/below", 3, "is a file"),
    ("study /dev/full -o out", 3, "not a regular file"),
    ("study pipe.toml -o out", 3, "not a regular file"),
    (f"study search.toml -o {LONG}", 5, "too long"),
    ("reproduce --out afile", 3, "is a file"),
    (f"gait design --speeds 0.5 -o {LONG}", 5, "too long"),
    ("gait import zero.json", 3, "no name of a file"),
    ("gait import pipe.json", 3, "not a regular file"),
    ("gait import pipe.mat", 3, "not a regular file"),
    ("gait show --robot pipe.toml", 3, "not a regular file"),
    ("animate pipe.npz -o a.gif", 3, "not a regular file"),
    ("replay pipe.csv", 3, "not a regular file"),
    ("robot check nonexistent", 3, "not found"),
    ("robot check pipe.urdf", 3, "not a regular file"),
    (f"robot new URDF -o {LONG}", 5, "too long"),
    ("robot new URDF -o afile", 3, "is a file"),
]
"""Command line, exit code, words of the sentence."""


@pytest.fixture
def here(tmp_path, monkeypatch, gait: Gait) -> None:
    """A folder with a file, a study, a gait whose name has a zero byte, and pipes that nobody writes to."""
    monkeypatch.chdir(tmp_path)
    Path("afile").write_text("kept")
    Path("study.toml").write_text(STUDY)
    Path("search.toml").write_text(SEARCH)
    gait.save("zero.json")
    record = json.loads(Path("zero.json").read_text())
    Path("zero.json").write_text(json.dumps(record | {"name": "a\0b"}))
    for kind in ("npz", "toml", "json", "mat", "csv", "urdf"):
        os.mkfifo(f"pipe.{kind}")


@pytest.mark.parametrize(("line", "code", "words"), MISTAKES, ids=[x[0][:40] for x in MISTAKES])
def test_a_mistake_is_one_sentence(here, line, code, words):
    before = sorted(os.listdir())
    done = CliRunner().invoke(app, shlex.split(line.replace("URDF", str(URDF))))
    assert isinstance(done.exception, BipedError), done.output
    assert done.exception.exit_code == code
    assert words in str(done.exception)
    assert sorted(os.listdir()) == before
    assert Path("afile").read_text() == "kept"
