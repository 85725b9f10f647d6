"""Texts for LLVM that come with the package fit the sources; a damaged one is written anew or refused.

The package's loops are compiled from such texts, which numba writes, so that users need no numba. Their first
line is a hash of the sources and the text. `damaged` makes the package read a text in which one instruction is
another.
"""

from ctypes import CFUNCTYPE, c_int64, c_void_p

import numpy as np
import pytest

from biped_adrc.analysis.ground_force import LOOPS
from biped_adrc.core.errors import ModelError
from biped_adrc.engine.kernels import load, write
from biped_adrc.engine.machine import load_or_compile


@pytest.mark.parametrize("files", [load.FILES, LOOPS], ids=["march", "nodes"])
def test_a_text_fits_the_sources(files):
    """`files` are the modules of one text; their first line is made anew from the sources as they are now."""
    first, _, text = load.text_file(files).read_text(encoding="utf-8").partition("\n")
    message = "run python -m validation.texts"
    assert first == load.head(files, text), message


@pytest.fixture
def damaged(tmp_path, monkeypatch):
    """A text in which one instruction of a shipped one is another."""
    data = load.text_file(LOOPS).read_text(encoding="utf-8")
    path = tmp_path / "demands.ll"
    path.write_text(data.replace("fcmp", "fadd", 1), encoding="utf-8")
    monkeypatch.setattr(load, "text_file", lambda files: path)
    return path


def totals_by(text):
    """Results of `totals` on two nodes of one joint, by the code of a text."""
    at = load_or_compile(text, ["totals"])["totals"]
    rows, out = np.arange(24.0).reshape(2, 12), np.zeros(6)
    starts = np.array([0, 1, 2, 4, 5, 6, 7, 8, 10])
    call = CFUNCTYPE(c_int64, c_void_p, c_int64, c_void_p, c_int64, c_int64, c_void_p)(at)
    call(rows.ctypes.data, 12, starts.ctypes.data, 1, 2, out.ctypes.data)
    return out


def test_a_damaged_text_is_written_anew(damaged):
    """numba writes it again, and the loop over nodes gives by hand: the largest |e|; the number of nodes that
    count; of these the sums of e^2, u^2, |u dq| and u dq, dq to the next node.
    """
    # __wrapped__: the function without its cache
    # e = 4, then 16; u = 5; q from 6 to 18: the sums are over the first node
    assert totals_by(load.loops.__wrapped__(LOOPS)).tolist() == [16.0, 1.0, 16.0, 25.0, 60.0, 60.0]


def test_without_numba_a_damaged_text_is_refused(damaged, monkeypatch):
    """`find_spec` says here that numba is not installed."""
    monkeypatch.setattr(load, "find_spec", lambda name: None)
    with pytest.raises(ModelError, match=r"demands.ll is damaged .* reinstall biped-adrc"):
        load.loops.__wrapped__(LOOPS)  # the function without its cache


def test_a_semicolon_between_quotes_is_no_comment():
    """Bytes of a constant of numba's may have one; what follows a semicolon elsewhere is left out."""
    assert write.without_hints('@x = [3 x i8] c"a;b" ; [#uses=1]\n; all\nret void ; "x') == (
        '@x = [3 x i8] c"a;b"\n\nret void'
    )
