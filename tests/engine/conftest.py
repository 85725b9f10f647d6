"""Generated code in a folder of the tests' own."""

import os

import pytest

from biped_adrc.engine.machine import VARIABLE


@pytest.fixture(scope="package", autouse=True)
def cache(tmp_path_factory):
    folder = tmp_path_factory.mktemp("cache")
    before = os.environ.get(VARIABLE)
    os.environ[VARIABLE] = str(folder)
    yield folder
    os.environ.pop(VARIABLE)
    if before is not None:
        os.environ[VARIABLE] = before
