"""Reads a number with its unit from text: "1.5 ms", "30 N m", "300 rad/s".

    quantity(text, unit) -> the number in `unit`         own_quantity(text, unit) -> the number, or the text

A unit is a product of powers, "kg m^2/s^2"; each symbol may carry an SI prefix, and a slash divides by all
symbols up to the next slash: "N/m s" is N/(m s). The radian counts as a dimension, so that Hz and rad/s, which
differ by 2 pi, are never confused. units.toml has the units: those that take a prefix ("prefixed", such as m),
those that do not ("whole", such as deg or 1), each as its factor to SI units and its four exponents of m, kg, s
and rad; and the prefixes with their factors.
"""

import math
import re
from contextlib import nullcontext, suppress
from typing import NamedTuple

from biped_adrc.core.files import packaged


class Unit(NamedTuple):
    """A unit as its value in SI units and its dimension."""

    factor: float
    """The unit's value in SI units: 1e-3 for g, since the SI unit of mass is kg."""
    powers: tuple[int, ...]
    """Exponents of (m, kg, s, rad)."""


_TABLES = packaged("biped_adrc.scenario", "units.toml")
"""The tables of units.toml."""
_WHOLE = {name: Unit(k, tuple(powers)) for name, (k, *powers) in _TABLES["whole"].items()}
"""Units by the symbols that take no SI prefix."""
SYMBOLS = _WHOLE | {
    prefix + name: Unit(times * k, tuple(powers))
    for name, (k, *powers) in _TABLES["prefixed"].items()
    for prefix, times in ({"": 1.0} | _TABLES["prefixes"]).items()
}
"""All units by symbol, with prefix and without."""

ANY = "any"
"""Unit of a parameter of the user's own class that states none: any unit is taken."""
PLAIN = ("", "1", ANY)
"""Units that no message and no label shows."""

_QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*")
"""A decimal number, and what follows it."""
_FACTOR = re.compile(r"([^\d\s/*^·+-]+|1)(?:\^?(-?\d))?")
"""A symbol and its exponent of one digit, such as "m", "s2" or "s^-2"."""


def quantity(text: str, unit: str) -> float:
    """The number of a text such as "1.5 ms" in the unit `unit`; a number without a unit is in `unit` already.

    unit: "" takes none, `ANY` takes all and gives the number in SI units. Raises ValueError, which says why,
    for what is no number, another dimension, or out of range.
    """
    match = _QUANTITY.fullmatch(text)
    if match is None:
        with_unit = "" if unit in PLAIN else f" [{unit}] or a number and its unit"
        raise ValueError(f"found '{text}', expected a finite number{with_unit}")
    number, own_unit = float(match[1]), match[2]
    if own_unit:
        result = unit_of(own_unit)
        # `ANY` takes the unit's own dimension, and factor 1.0 is SI; no unit asked for, "", is dimensionless
        expected = result._replace(factor=1.0) if unit == ANY else unit_of(unit or "1")
        if result.powers != expected.powers or not unit:  # with "" even "%" or "1" is refused
            asked = f": '{own_unit}' is another dimension, expected a unit such as '{unit}'"
            plain = ", expected a number without a unit"
            raise ValueError(f"found '{text}'" + (plain if unit in PLAIN else asked))
        number = _scaled(number, result.factor / expected.factor)
    if not math.isfinite(number):
        raise ValueError(f"found '{text}', too large, expected a finite number [{unit}]")
    return number


def own_quantity(text: str, unit: str) -> float | str:
    """Convert a number with its unit, such as "2 mm", to a number in `unit`; any other text stays as it is.

    For parameters of the user's own classes, which may be texts: so "5", without a unit, stays a text too.
    Raises ValueError where the unit does not fit. With `ANY` (the result is then in SI units) nothing is
    raised, and a text such as "3 times", whose last word is no unit, stays as it is.
    """
    match = _QUANTITY.fullmatch(text)  # match[2] is the unit
    with suppress(ValueError) if unit == ANY else nullcontext():
        return quantity(text, unit) if match and match[2] else text
    return text


def unit_of(text: str) -> Unit:
    """The unit that a text such as "kg m^2/s^2" names.

    Raises ValueError for an unknown symbol, and a factor out of range.
    """
    factor, powers = _WHOLE["1"]  # the product begins with 1, without dimension
    # all behind a slash divides, so the brackets of 1/(kg m^2) say nothing more
    over, *under = re.sub(r"/\(([^()]*)\)", r"/\1", text).split("/")
    for sign, part in [(1, over), *((-1, part) for part in under)]:
        for word in re.split(r"[\s*·]+", part.strip()):
            match = _FACTOR.fullmatch(word)
            symbol = match and SYMBOLS.get(match[1])  # its `Unit`, None if unknown
            if match is None or symbol is None:
                known = ", ".join([*_TABLES["prefixed"], *_WHOLE])
                raise ValueError(
                    f"the unit '{text}' is not known; units are products such as 'N m' or 'rad/s', of {known}"
                )
            power = sign * int(match[2] or 1)
            factor *= symbol.factor**power
            powers = tuple(a + power * b for a, b in zip(powers, symbol.powers, strict=True))
    if not 0.0 < factor < math.inf:
        raise ValueError(f"the unit '{text}' is out of range")
    return Unit(factor, powers)


def _scaled(number: float, factor: float) -> float:
    """number * factor. For a factor 10^k the decimal point is shifted in the text of the number: so 1.5 ms is
    the float nearest to 1.5e-3. The product 1.5 * 1e-3 may be the float beside it, which would be another
    scenario. A number whose text has an exponent already, such as 1e-07, is multiplied.
    """
    digits = math.log10(factor)
    shift = round(digits)
    if abs(digits - shift) < 1e-12 and math.isfinite(number):
        return float(f"{number!r}e{shift}") if "e" not in repr(number) else number * 10.0**shift
    return number * factor
