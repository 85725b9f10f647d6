"""A few of what `make fuzz` draws many of: damaged files, and nonsense on the command line."""

from __future__ import annotations

import pytest

from .fuzz import KINDS, damage, lines


@pytest.mark.parametrize("kind", KINDS)
def test_a_damaged_file_is_read_right_or_refused(kind, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found, wrong = damage(kind, 15, 7, tmp_path)
    assert wrong == []
    assert found["refused"] > 2


def test_nonsense_on_the_command_line_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found, wrong = lines(10, 7)
    assert wrong == []
    assert found["exit code 2"] + found["refused"] > 5
