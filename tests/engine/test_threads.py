"""Several threads that ask for the loops at once, in a process where nothing is loaded yet."""

import os
import subprocess
import sys

from biped_adrc.engine.machine import VARIABLE

LINES = """
import sys
from concurrent.futures import ThreadPoolExecutor
from biped_adrc.engine.kernels.load import kernels

with ThreadPoolExecutor(8) as pool:
    found = list(pool.map(lambda _: kernels(), range(32)))
print(len(set(map(id, found))), "numba" in sys.modules)
"""


def test_the_loops_are_loaded_once_and_without_numba_in_an_empty_cache(tmp_path):
    """32 calls from 8 threads return one object, and none imports numba, as it would to compile it anew."""
    run = subprocess.run(
        [sys.executable, "-c", LINES],
        env=os.environ | {VARIABLE: str(tmp_path)},
        capture_output=True,
        text=True,
        check=True,
        timeout=300,
    )
    assert run.stdout.split() == ["1", "False"]
