"""Several threads that ask for the loops at once, in a process where nothing is loaded yet."""

import subprocess
import sys

from biped_adrc.engine.kernels.load import kernels

LINES = """
import sys
from concurrent.futures import ThreadPoolExecutor
from biped_adrc.engine.kernels.load import kernels

with ThreadPoolExecutor(8) as pool:
    found = list(pool.map(lambda _: kernels(), range(32)))
print(len(set(map(id, found))), "numba" in sys.modules)
"""


def test_the_loops_are_loaded_once_and_without_numba_where_they_are_on_disk():
    kernels()
    run = subprocess.run(
        [sys.executable, "-c", LINES], capture_output=True, text=True, check=True, timeout=300
    )
    assert run.stdout.split() == ["1", "False"]
