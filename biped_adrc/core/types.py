"""Types that all modules share: arrays, and records of plain values."""

from collections.abc import Iterable, Mapping
from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

T = TypeVar("T")
"""Some type, in the signature of a function."""

Array = NDArray[np.float64]
"""Real array in float64; shapes are stated in the docstrings."""

Indices = NDArray[np.int_]
"""Array of int: row numbers, and the relabelling of joints at an impact (see `relabelled`)."""

Flags = NDArray[np.bool_]
"""Array of truth values."""

ComplexArray = NDArray[np.complex128]
"""Complex array, for eigenvalues and transfer functions."""

PlainRecord = Mapping[str, Any]
"""Values by name as JSON and TOML have them: text, numbers, truth values, None, lists, records."""

MuJoCoModel: TypeAlias = Any
"""`mujoco.MjModel`, a compiled robot: MuJoCo is optional."""
MuJoCoData: TypeAlias = Any
"""`mujoco.MjData`, the state and work space of a model."""


def read_only(values: ArrayLike) -> Array:
    """A copy in float64 that cannot be written to, of the shape of `values`; for frozen records."""
    array = np.array(values, dtype=float)
    array.setflags(write=False)
    return array


def frozen(value: T) -> T:
    """A read-only view of an array, or a tuple with its arrays so; other values are returned as they are.

    For arrays handed to a user's code, or stored: the array itself stays writable for its owner.
    """
    if isinstance(value, np.ndarray):
        if not value.flags.writeable:
            return value
        view = value.view()
        view.setflags(write=False)
        return view
    if isinstance(value, tuple):
        return of_kind(type(value), map(frozen, value))
    return value


def of_kind(kind: Any, parts: Iterable[object]) -> Any:
    """A tuple, NamedTuple or list of the class `kind` with these members."""
    return kind._make(parts) if hasattr(kind, "_make") else kind(parts)


def relabelled(rows: Array, swap: Indices) -> Array:
    """Numbers `rows` (.., p) of the p joints, in the order of the joints after an impact, where the legs swap.

    Joint i gets entry swap[i] of (rows, -rows), (.., 2 p), so a joint between the legs may change its sign.
    """
    return np.concatenate((rows, -rows), axis=-1)[..., swap]


def freeze(record: object, *names: str) -> None:
    """Replace the arrays in these fields of a frozen dataclass by read-only views."""
    for name in names:
        object.__setattr__(record, name, frozen(getattr(record, name)))
