"""Array types shared by all modules."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
"""Real array in float64; shapes are stated in the docstrings."""

ComplexArray = NDArray[np.complex128]
"""Complex array, for eigenvalues and transfer functions."""
