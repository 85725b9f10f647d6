"""Modules beside the tests can be imported by worker processes."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from concurrent.futures import ThreadPoolExecutor

import pytest


@pytest.fixture
def executor():
    """A thread of this process."""
    with ThreadPoolExecutor(1) as pool:
        yield pool
