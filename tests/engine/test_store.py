"""Generated files on disk: damaged ones are made again, what cannot be written is kept elsewhere."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from biped_adrc.engine import machine
from biped_adrc.engine.machine import (
    VARIABLE,
    ModuleText,
    compiled,
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


@pytest.fixture
def make(monkeypatch):
    """Loads or compiles the text; what its function gives, and how often it was compiled."""
    made = []

    def counted(*text):
        made.append(1)
        return compiled(*text)

    def load():
        made.clear()
        return result(load_or_compile(ModuleText(TEXT), ["f"])), len(made)

    monkeypatch.setattr(machine, "compiled", counted)
    return load


def test_machine_code_is_made_once(make, tmp_path, monkeypatch):
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    assert make() == (42.0, 1)
    assert make() == (42.0, 0)


@pytest.mark.parametrize("damage", [b"", b"broken", None])
def test_damaged_machine_code_is_made_again(make, damage, tmp_path, monkeypatch):
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    make()
    (path,) = tmp_path.glob("code/*.bin")
    data = bytearray(path.read_bytes())
    data[-7] ^= 1
    path.write_bytes(bytes(data) if damage is None else damage)
    assert stored(path.stem) is None
    assert make() == (42.0, 1)
    assert stored(path.stem) is not None


DOUBLED = """
from biped_adrc.engine.machine import load_source, note_checksums
module = load_source("import numba\\n@numba.njit('f8(f8)', cache=True)\\ndef f(x):\\n    return 2.0 * x\\n")
note_checksums(module)
print(module.f(2.0), sum(module.f.stats.cache_hits.values()))
"""


def test_damage_in_what_numba_keeps_is_noticed(cache):
    """numba itself would run a flipped bit; a checksum that is no text heals too."""
    folder = cache / "damaged"

    def walked():
        return python(DOUBLED, folder).communicate(timeout=120)[0].strip()

    cold, warm = walked(), walked()
    assert (cold, warm) == ("4.0 0", "4.0 1")
    for ending in (".nbc", ".sha256"):
        damaged = min(folder.glob(f"*/__pycache__/*{ending}"))
        data = bytearray(damaged.read_bytes())
        data[len(data) // 2] ^= 1
        damaged.write_bytes(b"\xff\xfe\x00" if ending == ".sha256" else bytes(data))
        assert walked() == cold


def python(lines, folder):
    environment = {**os.environ, VARIABLE: str(folder)}
    given = [sys.executable, "-c", lines]
    return subprocess.Popen(given, stdout=subprocess.PIPE, text=True, env=environment)


def test_a_damaged_module_is_written_again(cache):
    source = "answer = 42\n"
    path = Path(str(load_source(source).__file__))
    assert cache in path.parents
    path.write_text("answer = 41\n")
    assert load_source(source).answer == 42
    assert path.read_text() == source


def test_what_cannot_be_written_is_kept_elsewhere(make, tmp_path, monkeypatch):
    """A file in place of the folder, and a folder below the working directory, which may hold planted code."""
    blocked = tmp_path / "file"
    blocked.write_text("no folder")
    monkeypatch.chdir(tmp_path)
    for named in (str(blocked), "relative"):
        monkeypatch.setenv(VARIABLE, named)
        module = load_source("answer = 43\n")
        assert module.answer == 43
        assert tmp_path not in Path(str(module.__file__)).parents
    assert [path.name for path in tmp_path.iterdir()] == ["file"]
    monkeypatch.setenv(VARIABLE, str(blocked))
    assert make() == (42.0, 1)
    assert make() == (42.0, 1)


def test_several_processes_make_the_same_code(cache):
    lines = (
        "import numpy as np, biped_adrc as ba\n"
        "from biped_adrc.engine.compiled_biped import CompiledBiped\n"
        "c = CompiledBiped.of(ba.Biped.load('rabbit'))\n"
        "print(c.acceleration(np.linspace(0.1, 0.5, 5), np.ones(5), np.zeros(5)).tobytes().hex())\n"
    )
    for each in (lines, DOUBLED):
        processes = [python(each, cache / "several") for _ in range(2)]
        found = {process.communicate(timeout=120)[0].split()[0] for process in processes}
        assert len(found) == 1
        assert [process.returncode for process in processes] == [0, 0]
