"""Datagrams between a plant and a controller that is a process of its own, as loop.c has them.

The layout is written out at the head of loop.c: little-endian, without gaps, with a magic word, a
version, a kind, a number and the size in front.
"""

from __future__ import annotations

import struct
from typing import NamedTuple

import numpy as np

from biped_adrc.types import Array

MAGIC, VERSION = b"BADR", 1
INIT, STEP, TOUCHDOWN, STOP = 1, 2, 3, 4
"""Kinds: calls of the three functions, and the end."""
HEAD, SAID = struct.Struct("<4sHHII"), struct.Struct("<IIQ")
"""Magic word, version, kind, number, size; of an answer flag, single support, datagrams ignored."""
NUMBERS = 1 << 32
"""Numbers of datagrams are counted modulo this."""


def measurement(kind: int, number: int, t: float, q: Array, v: Array) -> bytes:
    """The datagram of a measurement: t [s], q (n,) [rad], v (n,) [rad/s]."""
    body = np.array([t, *q, *v], dtype="<f8").tobytes()
    return HEAD.pack(MAGIC, VERSION, kind, number % NUMBERS, HEAD.size + len(body)) + body


class Answer(NamedTuple):
    """What the process says of one datagram."""

    kind: int
    number: int
    """Of the datagram that it answers."""
    flag: int
    """What the function of the C returned."""
    support: int
    """Number of the single support, from 1."""
    ignored: int
    """Datagrams that were none, or came again, so far."""
    u: Array
    """Torque (p,) [N m]."""


def answer_of(data: bytes) -> Answer | None:
    """The answer in a datagram; None where it is none."""
    begin = HEAD.size + SAID.size
    if len(data) < begin or (len(data) - begin) % 8 != 0:
        return None
    magic, version, kind, number, size = HEAD.unpack_from(data)
    if (magic, version, size) != (MAGIC, VERSION, len(data)):
        return None
    flag, support, ignored = SAID.unpack_from(data, HEAD.size)
    return Answer(kind, number, flag, support, ignored, np.frombuffer(data, "<f8", offset=begin))
