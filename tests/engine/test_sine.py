"""sin and cos of generated code beside those of 80 bits, and beside C's."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

from biped_adrc.engine.calls import FUNCTION
from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.engine.ir import module_text
from biped_adrc.engine.machine import load_or_compile


@pytest.fixture(scope="module")
def of_code():
    """Function x -> (sin x, cos x) in machine code."""
    x = ca.SX.sym("x")
    f = SymbolicFunction(ca.SX.sym("K", 0), x, ca.vertcat(ca.sin(x), ca.cos(x)))
    call, out = FUNCTION(load_or_compile(module_text({"f": f}), ["f"])["f"]), np.zeros(2)

    def value(x):
        given = np.array([x])
        call(given.ctypes.data, given.ctypes.data, out.ctypes.data)
        return tuple(out.tolist())

    return value


def samples():
    """Numbers up to 1000, beside multiples of pi/2 too, and small ones."""
    r = np.random.default_rng(1)
    near = np.arange(-600, 600) * (np.pi / 2) + r.normal(0.0, 1e-9, 1200)
    wide = [*r.uniform(-4.0, 4.0, 4000), *r.uniform(-1000.0, 1000.0, 4000)]
    return np.array(
        [*wide, *near[np.abs(near) < 1000.0], *10.0 ** r.uniform(-300.0, 0.0, 200), 0.0]
    )


def test_the_error_is_below_1_6_units_in_the_last_place(of_code):
    """The extended precision of NumPy has 11 bits more, whose reduction of x is exact here."""
    x = samples()
    found, wide = np.array([of_code(one) for one in x]), x.astype(np.longdouble)
    for column, exact in zip(found.T, (np.sin(wide), np.cos(wide)), strict=True):
        unit = np.spacing(np.abs(exact.astype(float)))
        assert float(np.max(np.abs(column - exact) / unit)) < 1.6


def test_identities_and_ends(of_code):
    """sin is odd and cos even, bit for bit; of 0 they are 0 and 1, and of what is not finite NaN."""
    for x in samples()[::50]:
        (s, c), (minus, same) = of_code(x), of_code(-x)
        assert (s, c) == (-minus, same)
    assert of_code(0.0) == (0.0, 1.0)
    assert all(np.isnan(of_code(x)).all() for x in (np.nan, np.inf, -np.inf))
