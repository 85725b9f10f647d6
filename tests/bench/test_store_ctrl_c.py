"""Ctrl-C at a results file: raised as what it is, and the file stays whole."""

import json
from contextlib import contextmanager

import pytest
from standin import about, records, results, rows

from biped_adrc.campaign import store_check
from biped_adrc.campaign.execute import run_study
from biped_adrc.campaign.store_open import open_store, read_store
from biped_adrc.campaign.workers import Threads


@pytest.mark.parametrize("call", [1, 2, 9, 30])
def test_ctrl_c_in_a_checksum_is_no_damaged_file(tmp_path, monkeypatch, call):
    """While points and runs are written, and while the file is checked as it is opened."""
    path, calls = tmp_path / "r.sqlite", []

    class Interrupted:
        @staticmethod
        def dumps(*given, **more):
            calls.append(1)
            if len(calls) == call:
                raise KeyboardInterrupt
            return json.dumps(*given, **more)

    def study():
        with open_store(path, about()) as store:
            run_study(rows, records(20), store, Threads(1), chunk=5)

    def interrupted(task):
        calls.clear()
        with monkeypatch.context() as patched:
            patched.setattr(store_check, "json", Interrupted)
            with pytest.raises(KeyboardInterrupt):
                task()

    interrupted(study)
    study()
    interrupted(lambda: read_store(path))
    with read_store(path) as store:
        assert len(results(store)) == 20


@pytest.mark.parametrize("moment", ["before", "after"])
def test_ctrl_c_once_more_while_the_file_is_closed(tmp_path, monkeypatch, moment):
    """The second one comes before it is ignored, or as soon as it is heard again."""
    came = []

    @contextmanager
    def disturbed():
        if moment == "before" and not came:
            came.append(1)
            raise KeyboardInterrupt
        yield
        if not came:
            came.append(1)
            raise KeyboardInterrupt

    monkeypatch.setattr("biped_adrc.campaign.store.undisturbed", disturbed)
    path = tmp_path / "r.sqlite"
    with pytest.raises(KeyboardInterrupt), open_store(path, about()) as store:
        run_study(rows, records(1), store, Threads(1))
    assert [p.name for p in tmp_path.iterdir()] == ["r.sqlite"]
    assert came
    with open_store(path, about()) as store:
        assert len(store) == 1
