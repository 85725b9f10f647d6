"""Generated files on disk: damaged ones are made again, what cannot be written is kept elsewhere."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from biped_adrc.engine.machine import (
    VARIABLE,
    ModuleText,
    _path,
    cache_folder,
    load_or_compile,
    load_source,
    stored,
)

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
