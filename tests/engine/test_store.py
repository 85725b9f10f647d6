"""Machine code on disk: damaged files are made again, what cannot be written is made in memory.

`make()` loads or compiles f(x) = x + 1, and returns f(41) = 42 with the number of compilations; VARIABLE names
the environment variable with the folder of the code.
"""

import os
import subprocess
import sys

import numpy as np
import pytest

from biped_adrc.engine import machine
from biped_adrc.engine.machine import VARIABLE, load_or_compile, object_code

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


def result(addresses):
    import ctypes

    function = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 3)(addresses["f"])
    K, out = np.array([41.0]), np.zeros(1)
    function(K.ctypes.data, K.ctypes.data, out.ctypes.data)
    return out[0]


@pytest.fixture
def make(monkeypatch):
    """A function that loads or compiles TEXT; it returns f(41), which is 42, and how often it was compiled."""
    made = []

    def counted(*text):
        made.append(1)
        return object_code(*text)

    def load():
        made.clear()
        return result(load_or_compile(TEXT, ["f"])), len(made)

    monkeypatch.setattr(machine, "object_code", counted)
    return load


def test_machine_code_is_made_once(make, tmp_path, monkeypatch):
    """There is one compilation in an empty folder, and none the second time."""
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    assert make() == (42.0, 1)
    assert make() == (42.0, 0)


@pytest.mark.parametrize("damage", [b"", b"broken", None])
def test_damaged_machine_code_is_made_again(make, damage, tmp_path, monkeypatch):
    """damage: an empty file, a text, or (None) one bit of the code that is another; it is refused, and the code
    is compiled and stored anew.
    """
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    make()
    (path,) = tmp_path.glob("code/*.bin")
    data = bytearray(path.read_bytes())
    data[-7] ^= 1
    path.write_bytes(bytes(data) if damage is None else damage)
    assert make() == (42.0, 1)
    assert make() == (42.0, 0)


def python(lines, folder):
    environment = {**os.environ, VARIABLE: str(folder)}
    given = [sys.executable, "-c", lines]
    return subprocess.Popen(given, stdout=subprocess.PIPE, text=True, env=environment)


def test_what_cannot_be_written_is_made_in_memory(make, tmp_path, monkeypatch):
    """A file in place of the folder, and a folder below the working directory, which may hold planted code."""
    blocked = tmp_path / "file"
    blocked.write_text("no folder")
    monkeypatch.chdir(tmp_path)
    for named in (str(blocked), "relative"):
        monkeypatch.setenv(VARIABLE, named)
        assert make() == (42.0, 1)
        assert make() == (42.0, 1)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_several_processes_make_the_same_code_and_another_one_traces_nothing(cache):
    """Two processes at once in an empty folder get the same number, and both end well. A third prints no more
    than that: a 1 would follow for each tracing.
    """
    lines = (
        "import numpy as np, biped_adrc as ba\n"
        "from functools import partial\n"
        "from biped_adrc.engine import ir\n"
        "from biped_adrc.engine.calls import compiled_biped\n"
        "made = []\n"
        "ir.module_text = partial(lambda text, *x: made.append(1) or text(*x), ir.module_text)\n"
        "c = compiled_biped(ba.Biped.load('rabbit'))\n"
        "print(c.acceleration(np.linspace(0.1, 0.5, 5), np.ones(5), np.zeros(5)).tobytes().hex(), *made)\n"
    )
    processes = [python(lines, cache / "several") for _ in range(2)]
    found = {process.communicate(timeout=120)[0].split()[0] for process in processes}
    assert len(found) == 1
    assert [process.returncode for process in processes] == [0, 0]
    assert python(lines, cache / "several").communicate(timeout=120)[0].split() == [*found]
