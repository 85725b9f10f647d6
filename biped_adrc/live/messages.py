"""What a page may say to a session, as one JSON object a message; all else is refused.

    {"do": "push", "torque": {"q1": 30}, "force": [0, 0], "link": "torso", "seconds": 0.2}
    {"do": "pull", "link": "torso", "at": [0, 0.3], "anchor": [1.2, 1.3]}
    {"do": "change", "walk": 0, "values": {"bandwidth": 300}}
    {"do": "ghost", "values": {"controller": "NPD"}}
    {"do": "rate", "rate": 0.5}
    {"do": "reset", "values": {"controller": "NPD"}}
    {"do": "pause"}, "go", "step", "back", "let_go", "save"

A message is short, has these keys and no others, and holds finite numbers, short texts, and lists and
mappings of them. The value of a field is no path and no `package.module:Class`: a page opens no file and runs
no code. Names of links and fields, and ranges, are checked by the session, which says what is wrong.
`Allowance` counts how many messages a page may still send.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, NoReturn

from biped_adrc.errors import InputError

MOST_BYTES = 2000
"""Of a message."""
MOST_TEXT = 80
"""Characters of a text in a message."""
MOST_SIZE = 1e300
"""Of a number in a message, also of a whole one, which JSON does not limit."""
MOST_ENTRIES = 20
"""Of a mapping in a message."""
MOST_RATE, MOST_AT_ONCE = 150.0, 300.0
"""Messages of one page: a second, and at once. A mouse is read at most 120 times a second."""


def _number(x: object) -> bool:
    return isinstance(x, int | float) and not isinstance(x, bool) and abs(x) <= MOST_SIZE


def _text(x: object) -> bool:
    return isinstance(x, str) and len(x) <= MOST_TEXT and x.isprintable()


def _name(x: object) -> bool:
    return isinstance(x, str) and _text(x) and not set(x) & set(":/\\")


def _pair(x: object) -> bool:
    return isinstance(x, list) and len(x) == 2 and all(map(_number, x))


def _entries(x: object, fits: Callable[[object], bool]) -> bool:
    return (
        isinstance(x, dict)
        and len(x) <= MOST_ENTRIES
        and all(_text(name) and fits(value) for name, value in x.items())
    )


def _numbers(x: object) -> bool:
    return _entries(x, _number)


def _values(x: object) -> bool:
    return _entries(x, lambda y: y is None or isinstance(y, bool) or _number(y) or _name(y))


class Kind(NamedTuple):
    """What a value of a message has to be."""

    fits: Callable[[object], bool]
    words: str


NUMBER = Kind(_number, "a finite number")
TEXT = Kind(_text, f"a text of at most {MOST_TEXT} characters")
PAIR = Kind(_pair, "two finite numbers")
NUMBERS = Kind(_numbers, f"at most {MOST_ENTRIES} finite numbers by name")
VALUES = Kind(
    _values,
    f"at most {MOST_ENTRIES} numbers up to {MOST_SIZE:g}, names or null by name; a page gives no path and no "
    "class of your own",
)
NEEDED: dict[str, dict[str, Kind]] = {
    "pull": {"link": TEXT, "at": PAIR, "anchor": PAIR},
    "change": {"values": VALUES},
    "rate": {"rate": NUMBER},
    **{name: {} for name in ("push", "ghost", "pause", "go", "step", "back", "reset", "let_go")},
    "save": {},
}
"""What may be done, and the keys that it needs."""
OPTIONAL: dict[str, dict[str, Kind]] = {
    "push": {"torque": NUMBERS, "force": PAIR, "link": TEXT, "at": PAIR, "seconds": NUMBER},
    "change": {"walk": NUMBER},
    "ghost": {"values": VALUES},
    "reset": {"values": VALUES},
}
"""Keys that it may have besides."""


class Message(NamedTuple):
    """A message of the right form."""

    do: str
    """A name of NEEDED."""
    given: Mapping[str, Any]
    """The rest, by key; pairs as tuples."""


def message_of(text: str | bytes) -> Message:
    """A message from its text. Raises InputError that says what is wrong with its form."""
    if len(text) > MOST_BYTES:
        raise InputError(f"a message has {len(text)} bytes, expected at most {MOST_BYTES}")
    try:
        found = json.loads(text, parse_constant=_no_number)
    except (ValueError, RecursionError) as error:
        raise InputError(f"a message is no JSON: {error!r:.80}") from error
    do = found.pop("do", None) if isinstance(found, dict) else None
    if not isinstance(do, str) or do not in NEEDED:
        raise InputError(
            f'a message does {do!r:.40}, expected {{"do": one of {", ".join(NEEDED)}}}'
        )
    needed, kinds = NEEDED[do], NEEDED[do] | OPTIONAL.get(do, {})
    if wrong := [*(set(needed) - set(found)), *(set(found) - set(kinds))]:
        raise InputError(
            f"the message '{do}' has or lacks {sorted(wrong)!r:.80}, expected {list(needed)} and maybe "
            f"{list(OPTIONAL.get(do, {}))}"
        )
    for key, x in found.items():
        if not kinds[key].fits(x):
            raise InputError(f"{key} of '{do}' is {x!r:.60}, expected {kinds[key].words}")
    return Message(do, {key: tuple(x) if isinstance(x, list) else x for key, x in found.items()})


def _no_number(text: str) -> NoReturn:
    raise ValueError(f"{text} is no number")


class Allowance:
    """How many messages a page may still send: MOST_AT_ONCE, and MOST_RATE more every second."""

    def __init__(self) -> None:
        self.left, self.last = MOST_AT_ONCE, -math.inf

    def taken(self, now: float) -> bool:
        """Whether a message at `now` [s] is within it; then it is counted."""
        self.left = min(MOST_AT_ONCE, self.left + MOST_RATE * (now - self.last))
        self.last = now
        if self.left < 1.0:
            return False
        self.left -= 1.0
        return True
