"""Errors: one base class, and the exit code of the command for each kind; and checks that many share.

A message says what was asked, what was found, what was expected and what to try.
"""

from __future__ import annotations

import math
from numbers import Integral


class BipedError(Exception):
    """Base of every error this package raises on purpose."""

    exit_code = 3


class InputError(BipedError, ValueError):
    """A value given by the user cannot be used (exit code 3)."""


class NotFiniteError(InputError):
    """A state, torque or parameter is NaN or infinite (exit code 3)."""


class ModelError(InputError):
    """A URDF, robot, joint, frame or parameter preset is missing or not physical (exit code 3)."""


class GaitError(InputError):
    """A gait or curve is missing, malformed, or does not close (exit code 3)."""


class SingularError(BipedError, ArithmeticError):
    """A matrix the law must invert is singular at this state (exit code 4)."""

    exit_code = 4


class SimulationError(BipedError, RuntimeError):
    """A run ended without what was asked of it, such as a return to the section (exit code 4)."""

    exit_code = 4


class OutputError(BipedError, OSError):
    """A result cannot be written (exit code 5)."""

    exit_code = 5


def check_count(count: object, what: str) -> None:
    """Raise InputError, beginning with `what`, unless `count` is a whole number from 1 on; True is none."""
    if isinstance(count, bool) or not isinstance(count, Integral) or int(count) < 1:
        raise InputError(f"{what}, expected a whole number, at least 1")


def check_whole(value: object, what: str, least: int = 0) -> None:
    """Raise InputError, beginning with `what`, unless `value` is an int from `least` on; True is none."""
    if isinstance(value, bool) or not isinstance(value, int) or value < least:
        raise InputError(f"{what}, expected a whole number >= {least}")


def check_positive(
    value: float, what: str, hint: str = "", error: type[BipedError] = InputError
) -> None:
    """Raise `error`, beginning with `what` and ending with `hint`, unless `value` is finite and above 0."""
    if not (math.isfinite(value) and value > 0):
        raise error(f"{what}, expected a positive number{hint}")
