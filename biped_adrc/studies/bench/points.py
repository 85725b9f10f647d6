"""A point of a study: the record of its run, and where it lies. Two points may share one run."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from typing import Any, NamedTuple


class Point(NamedTuple):
    """A record in plain values, and the values by which the study tells the point from others."""

    record: Mapping[str, Any]
    at: Mapping[str, Any]


def point(of: Mapping[str, Any] | Point) -> Point:
    """A point as it is; a plain record lies at its own values."""
    return of if isinstance(of, Point) else Point(of, of)


def text_of(values: Mapping[str, Any]) -> str:
    """As JSON, from which floats come back to the last bit; the same values give the same text."""
    return json.dumps(values, sort_keys=True)


def key_of(record: str) -> str:
    """A name for a run, from the text of its record."""
    return hashlib.sha256(record.encode()).hexdigest()[:32]
