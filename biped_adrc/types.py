"""Array types shared by all modules."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
"""Real array in float64; shapes are stated in the docstrings."""

ComplexArray = NDArray[np.complex128]
"""Complex array, for eigenvalues and transfer functions."""

PlainRecord = Mapping[str, Any]


def read_only(values: ArrayLike) -> Array:
    """A copy as numbers that cannot be changed, for frozen records."""
    array = np.array(values, dtype=float)
    array.setflags(write=False)
    return array
