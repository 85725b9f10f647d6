"""A controller, an observer and a disturbance of one's own, in a module that lies in the working directory."""

from __future__ import annotations

import sys
import uuid
from pathlib import Path

import pytest

MODULE = '''
"""A controller of one's own."""

from dataclasses import dataclass

import numpy as np

import biped_adrc as ba


@dataclass(frozen=True)
class Mine(ba.Controller):
    """NPD of one page, with a gain of its own."""

    reference: ba.Reference
    gain: float = 1.0

    def output(self, s, m):
        r, p = self.reference(m.t, m.q, m.v), len(m.terms.kappa)
        f = -self.gain * (5000.0 * (m.q_b - r.q_d) + 50.0 * (m.v_b - r.dq_d))
        H_b, H_N = r.H[:, :p], r.H[:, p:]
        a = np.linalg.solve(
            np.eye(p) - H_b - H_N @ m.terms.A_N, r.drift + f + H_N @ m.terms.a_N
        )
        return m.terms.kappa_inverse @ (a - m.terms.xi)


@dataclass(frozen=True)
class Needy(Mine):
    """Wants something that no scenario has."""

    stiffness: float = None

    def __init__(self, reference, stiffness):
        object.__setattr__(self, "reference", reference)
        object.__setattr__(self, "stiffness", stiffness)
        object.__setattr__(self, "gain", 1.0)


class Lawless(ba.Controller):
    """Has no output."""


@dataclass(frozen=True)
class Shove(ba.TorquePulse):
    """A pulse by another name."""

'''


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """The name of the module, in the working directory, and no longer known afterwards."""
    name = f"own_{uuid.uuid4().hex[:6]}"
    (tmp_path / f"{name}.py").write_text(MODULE)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    return name
