"""Robots and gaits shared by the tests; a Biped is loaded once."""

from __future__ import annotations

import pytest

import biped_adrc as ba

PRESETS = ("identified", "identified-bare", "tac2003")


@pytest.fixture(scope="session", params=PRESETS)
def any_biped(request):
    return ba.Biped.load("rabbit", request.param)


@pytest.fixture(scope="session")
def biped():
    return ba.Biped.load("rabbit")


@pytest.fixture(scope="session")
def gait(biped):
    return ba.load_gait("published", biped)


@pytest.fixture(scope="session")
def bare():
    return ba.Biped.load("rabbit", "identified-bare")


@pytest.fixture(scope="session")
def published(bare):
    return ba.load_gait("published", bare)
