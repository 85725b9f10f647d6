"""Generated files on disk: damaged ones are made again, what cannot be written is kept elsewhere."""

import atexit
import importlib.util
import os
import py_compile
import shutil
import subprocess
import sys
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from numba.core import config

from biped_adrc.engine.kernels.load import _kernels
from biped_adrc.engine.machine import (
    VARIABLE,
    ModuleText,
    _path,
    _temporary,
    cache_folder,
    load_or_compile,
    load_source,
    stored,
)
from biped_adrc.errors import ModelError

TEXT = """
define void @f(ptr %K, ptr %inp, ptr %out) {
%x = load double, ptr %K
%y = fadd double %x, 1.0
store double %y, ptr %out
ret void
}
"""


@pytest.fixture(scope="module", autouse=True)
def cache(tmp_path_factory):
    """A folder of these tests' own, as they damage what is in it; all others share one."""
    with pytest.MonkeyPatch.context() as patch:
        folder = tmp_path_factory.mktemp("cache")
        patch.setenv(VARIABLE, str(folder))
        yield folder


def result(code):
    import ctypes

    function = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 3)(code.addresses["f"])
    K, out = np.array([41.0]), np.zeros(1)
    function(K.ctypes.data, K.ctypes.data, out.ctypes.data)
    return out[0]


def make(key="some-key", text=TEXT):
    made = []
    code = load_or_compile(key, ["f"], lambda: (made.append(1), ModuleText(text))[1])
    return result(code), len(made)


def test_machine_code_is_made_once():
    assert make() == (42.0, 1)
    assert make() == (42.0, 0)


@pytest.mark.parametrize("damage", [b"", b"broken", None])
def test_damaged_machine_code_is_made_again(damage):
    make("damaged")
    path = _path("damaged")
    data = bytearray(path.read_bytes())
    data[-7] ^= 1
    path.write_bytes(bytes(data) if damage is None else damage)
    assert stored("damaged") is None
    assert make("damaged") == (42.0, 1)
    assert stored("damaged") is not None


def test_code_under_the_name_of_another_is_not_loaded():
    make("one")
    _path("two").write_bytes(_path("one").read_bytes())
    assert stored("two") is None


def test_a_damaged_module_is_written_again(cache):
    source = "answer = 42\n"
    path = Path(str(load_source(source).__file__))
    assert cache in path.parents
    path.write_text("answer = 41\n")
    assert load_source(source).answer == 42
    assert path.read_text() == source


def test_a_flipped_bit_in_numba_s_machine_code_is_noticed(cache):
    """numba itself would run it."""
    lines = (
        "from biped_adrc.engine.machine import load_source, seal\n"
        "source = 'import numba\\n@numba.njit(\"f8(f8)\", cache=True)\\ndef f(x):\\n    return 2.0 * x\\n'\n"
        "module = load_source(source)\n"
        "seal(module)\n"
        "print(module.f(2.0), sum(module.f.stats.cache_hits.values()))\n"
    )
    folder = cache / "flipped"
    environment = {**os.environ, VARIABLE: str(folder)}

    def hits():
        found = subprocess.run(
            [sys.executable, "-c", lines],
            capture_output=True,
            text=True,
            check=True,
            env=environment,
            timeout=120,
        )
        return found.stdout.strip()

    cold, warm = hits(), hits()
    (code,) = folder.glob("*/__pycache__/*.nbc")
    data = bytearray(code.read_bytes())
    data[len(data) // 2] ^= 1
    code.write_bytes(bytes(data))
    assert hits() == cold != warm
    assert hits() == warm


def test_what_cannot_be_written_is_kept_elsewhere(tmp_path, monkeypatch):
    blocked = tmp_path / "file"
    blocked.write_text("no folder")
    monkeypatch.setenv(VARIABLE, str(blocked))
    assert cache_folder() == blocked
    module = load_source("answer = 43\n")
    assert module.answer == 43
    assert blocked not in Path(str(module.__file__)).parents
    assert make("elsewhere") == (42.0, 1)
    assert make("elsewhere") == (42.0, 1)


@pytest.mark.parametrize("gone", [False, True])
def test_a_folder_of_one_process_goes_with_it_and_may_be_gone_before(gone, monkeypatch):
    ends = []
    monkeypatch.setattr(atexit, "register", lambda f, *a, **k: ends.append(partial(f, *a, **k)))
    folder = _temporary.__wrapped__()
    (folder / "code").write_text("")
    if gone:
        shutil.rmtree(folder)
    (end,) = ends
    end()
    assert not folder.exists()


def test_several_processes_make_the_same_code(cache):
    lines = (
        "import numpy as np, biped_adrc as ba\n"
        "from biped_adrc.engine.compiled_biped import CompiledBiped\n"
        "c = CompiledBiped.of(ba.Biped.load('rabbit'))\n"
        "print(c.acceleration(np.linspace(0.1, 0.5, 5), np.ones(5), np.zeros(5)).tobytes().hex())\n"
    )
    environment = {**os.environ, VARIABLE: str(cache / "several")}
    processes = [
        subprocess.Popen(
            [sys.executable, "-c", lines], stdout=subprocess.PIPE, text=True, env=environment
        )
        for _ in range(4)
    ]
    found = {process.communicate(timeout=120)[0].strip() for process in processes}
    assert len(found) == 1
    assert found != {""}


@pytest.mark.parametrize("variable", [VARIABLE, "XDG_CACHE_HOME"])
def test_an_empty_variable_is_none(variable, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    for each in (VARIABLE, "XDG_CACHE_HOME"):
        monkeypatch.delenv(each, raising=False)
    monkeypatch.setenv(variable, "")
    folder = cache_folder()
    assert tmp_path / "home" in folder.parents
    assert folder.stat().st_mode & 0o777 == 0o700


def test_a_cache_that_others_could_write_is_not_used(tmp_path, monkeypatch):
    theirs, relative = tmp_path / "theirs", "cache"
    theirs.mkdir()
    theirs.chmod(0o777)
    monkeypatch.chdir(tmp_path)
    for named, said in ((str(theirs), r"others may write \(mode 777\)"), (relative, "absolute")):
        monkeypatch.setenv(VARIABLE, named)
        with pytest.warns(RuntimeWarning, match=said):
            assert make(f"open {named}") == (42.0, 1)
        assert list(tmp_path.rglob("*")) == [theirs]
    theirs.chmod(0o700)
    monkeypatch.setenv(VARIABLE, str(theirs))
    assert make("open") == (42.0, 1)
    monkeypatch.setattr("biped_adrc.engine.machine.os.geteuid", lambda: 12345)
    with pytest.warns(RuntimeWarning, match=f"belongs to user {theirs.stat().st_uid}"):
        assert theirs not in cache_folder().parents


def test_a_file_of_another_user_in_it_is_not_read(monkeypatch):
    make("theirs")
    monkeypatch.setattr("biped_adrc.engine.machine._ours", lambda _: False)
    assert stored("theirs") is None


def test_neither_a_home_nor_a_user(monkeypatch):
    def unknown(*_: object, **__: object) -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.delenv(VARIABLE)
    monkeypatch.setattr("biped_adrc.engine.machine.user_cache_path", unknown)
    assert make("homeless")[0] == 42.0


def test_no_bytecode_of_a_module_is_read(cache):
    """Planted or damaged, a .pyc is no part of what is checked."""
    path = Path(str(load_source("answer = 44\n").__file__))
    planted = Path(importlib.util.cache_from_source(str(path)))
    planted.parent.mkdir(exist_ok=True)
    other = cache / "other.py"
    other.write_text("answer = 45\n")
    os.utime(other, (path.stat().st_atime, path.stat().st_mtime))
    py_compile.compile(str(other), str(planted), doraise=True)
    assert load_source("answer = 44\n").answer == 44
    planted.write_bytes(planted.read_bytes()[:20])
    assert load_source("answer = 44\n").answer == 44


def test_numba_s_variables_lead_nowhere_else(tmp_path, monkeypatch):
    """Its own folder of code is neither checked nor sealed, so that nothing is unpickled from there."""
    monkeypatch.setattr(config, "CACHE_DIR", str(tmp_path))
    compiled = "import numba\n@numba.njit('f8(f8)', cache=True)\ndef f(x):\n    return x\n"
    source = f"{compiled}def compile_all(): pass\n"
    monkeypatch.setattr("biped_adrc.engine.kernels.load.source", lambda: source)
    module = _kernels.__wrapped__()
    assert module.f(2.0) == 2.0
    assert list(Path(str(module.__file__)).parent.glob("__pycache__/*.nbi"))
    assert list(tmp_path.iterdir()) == []
    assert str(tmp_path) == config.CACHE_DIR
    monkeypatch.setattr(config, "DISABLE_JIT", 1)
    with pytest.raises(ModelError, match="NUMBA_DISABLE_JIT is set"):
        _kernels.__wrapped__()
