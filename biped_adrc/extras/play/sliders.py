"""Sliders of a page: how the numbers in a walk's block of memory change with one value of the scenario.

    number = b s^k,  a + b s,  a + b tan s

for every number that changes with the value s. a, b and k come from three values of s, of which the middle one
only checks. Where the numbers follow no such form, such as the gains of an observer in sampled time with its
bandwidth, a table has them at round values of s. A slider whose numbers another one moves too is left out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from biped_adrc.control.tracking import TABLE_II
from biped_adrc.core.errors import BipedError
from biped_adrc.core.registry import find, takes
from biped_adrc.core.types import Array
from biped_adrc.scenario.controllers import CONTEXT, GAINS
from biped_adrc.scenario.scenario import Scenario

Form = tuple[float, float, int] | list[float]
"""How a number depends on the value s of a slider: (a, b, k) for a + b s^k, with tan(s) in place of s^k for
k = 0; or a list of its values at the slider's table."""
_Numbers = Callable[[Mapping[str, object]], Array]
"""The numbers of a walk with these values of its scenario; raises BipedError where it has none, or another
structure."""
ROUND = np.array((10, 12, 15, 20, 25, 30, 40, 50, 60, 80))
"""First two digits of the values in tables."""
CLOSER = 8
"""Number of places between a slider's end and its value where another end is tried."""
POWERS = (*range(1, 15), -1, -2)
"""Exponents k of b s^k that are tried; gains of an observer of high order are high powers of its bandwidth."""
_EXACT = 1e-12
"""Largest relative error with which a form fits."""
ELSEWHERE = (*CONTEXT, *GAINS, "bandwidth", "order", "poles", "solve_theta", "reset")
"""Parameters of controllers that get no slider of their own."""


class Slider(NamedTuple):
    """One value of a scenario that a slider on the page changes."""

    name: str
    """Dotted name of the value in the scenario."""
    low: float
    high: float
    log: bool
    """Whether the slider is logarithmic."""
    unit: str = ""
    scale: float = 1.0
    """Displayed number over the value in SI units."""
    value: float | None = None
    """Value with which the walk begins; None for numbers that no value gives, such as poles of a table."""
    shared: bool = False
    """Whether the ghost's value changes too: for values of robot and ground."""

    also: Mapping[str, object] = {}
    """Other values of the scenario that are set with it, such as the order with the bandwidth."""

    table: tuple[float, ...] = ()
    """All values that it takes; any between low and high where empty."""

    @property
    def tried(self) -> tuple[float, float, float]:
        """Three values of the slider: both ends and one between them."""
        middle = np.sqrt(self.low * self.high) if self.log else 0.4 * self.low + 0.6 * self.high
        return self.low, float(middle), self.high

    def tabulated(self) -> Slider:
        """A copy of the slider that offers a table of round values in place of a range."""
        decades = 10.0 ** np.arange(-9, 9)
        known = np.unique((np.outer(decades, ROUND)).ravel().round(12))
        even = np.linspace(self.low, self.high, 21).round(6)
        values = known[(known >= self.low) & (known <= self.high)] if self.log else even
        return self._replace(table=tuple(values.tolist()))


OBSERVER = "controller.observer."
_USUAL = (
    Slider("controller.K_p", 30.0, 30000.0, True),
    Slider("controller.K_d", 3.0, 3000.0, True),
    Slider("controller.observer.bandwidth", 30.0, 3000.0, True),
    Slider("hardware.torque_limit", 10.0, 500.0, True, shared=True),
    Slider("ground.slope", -0.12, 0.12, False, shared=True),
)


def offered(s: Scenario, order: int | None) -> Iterator[Slider]:
    """Iterate over the sliders that a scenario may have: the usual ones, and the numbers of its controller.

    order: m of its observer, which a change of the bandwidth leaves as it is.
    """
    also: dict[str, object] = {} if order is None else {OBSERVER + "order": order}
    also |= {OBSERVER + "poles": "none"} if s.controller.observer.poles else {}
    c = s.controller
    values = {f"controller.{k}": getattr(c, k) or float(getattr(TABLE_II, k)) for k in GAINS}
    for one in _USUAL:
        also_here = also if one.name.startswith(OBSERVER) else {}
        yield one._replace(also=also_here, value=values.get(one.name))
    for name, parameter in takes(find("controller", c.name).load()).items():
        x = c.own.get(name, parameter.default)
        if isinstance(x, float) and np.isfinite(x) and name not in ELSEWHERE:
            low, high = sorted((0.1 * x, 10.0 * x)) if x else (-1.0, 1.0)
            yield Slider(f"controller.{name}", low, high, x > 0.0, value=x)


def sliders(
    s: Scenario, order: int | None, base: Array, numbers: _Numbers
) -> dict[str, tuple[Slider, dict[int, Form]]]:
    """Find the sliders of a walk: name -> the slider, and the forms of the numbers that it changes, by index.

    order: m of its observer. base: numbers of the walk. numbers: those with other values of its scenario.
    """
    result, moved = dict[str, tuple[Slider, dict[int, Form]]](), set[int]()
    for one in offered(s, order):
        try:
            one, forms = with_forms(one, base, numbers)
        except BipedError:
            continue
        if forms and moved.isdisjoint(forms):
            moved |= forms.keys()
            result[one.name] = at_base(one, base, forms), forms
    return result


def with_forms(one: Slider, base: Array, numbers: _Numbers) -> tuple[Slider, dict[int, Form]]:
    """Fit the forms of one slider's numbers, by index; returns the slider, with its
    range or table, and the forms.

    The range shrinks where the controller refuses its ends. Raises BipedError where the
    walk cannot have the slider.
    """
    try:
        rows = numbers_at(one, numbers)
    except BipedError:  # such as gains of an unstable loop
        one = one._replace(low=end(one, one.low, numbers), high=end(one, one.high, numbers))
        rows = numbers_at(one, numbers)
    if forms := forms_of(one, base, rows):
        return one, forms
    one = one.tabulated()
    rows = numbers_at(one, numbers, one.table)
    return one, {k: rows[:, k].tolist() for k in changing(base, rows)}


def end(one: Slider, x: float, numbers: _Numbers) -> float:
    """The end x of a slider's range, moved towards its present value until the walk accepts it."""
    ways = np.geomspace if one.log else np.linspace
    for y in () if one.value is None else ways(x, one.value, CLOSER):
        try:
            numbers_at(one, numbers, (x := float(f"{y:.2g}"),))
            break
        except BipedError:
            continue
    return x


def numbers_at(one: Slider, numbers: _Numbers, values: Sequence[float] = ()) -> Array:
    """Numbers of the walk, as a row for each of these values of a slider, or of `tried` if there are none.

    Raises BipedError where the walk cannot have a value.
    """
    return np.array([numbers({one.name: x, **one.also}) for x in values or one.tried])


def changing(base: Array, rows: Array) -> list[int]:
    """Indices of the numbers that differ between the rows; empty where `base` differs
    from them in any other number.
    """
    change = np.any(rows != rows[0], axis=0)
    return [] if np.any(base[~change] != rows[0, ~change]) else np.flatnonzero(change).tolist()


def forms_of(one: Slider, base: Array, rows: Array) -> dict[int, Form]:
    """Fit a form to each number that changes over the rows (3, N); index -> form, empty where one has
    no form.
    """
    s = np.array(one.tried)
    result = {k: next(closed(s, rows[:, k]), None) for k in changing(base, rows)}
    return {k: form for k, form in result.items() if form} if all(result.values()) else {}


def closed(s: Array, y: Array) -> Iterator[tuple[float, float, int]]:
    """Iterate over the forms (a, b, k) that pass through three values y (3,) at the slider's values s (3,)."""
    with np.errstate(all="ignore"):
        for k in POWERS if np.all(s > 0.0) else ():
            if np.all(np.abs(y / (y[2] / s[2] ** k * s**k) - 1.0) < _EXACT):
                yield 0.0, float(y[2] / s[2] ** k), k
        for k, f in ((1, s), (0, np.tan(s))):
            b = (y[2] - y[0]) / (f[2] - f[0])
            a = y[0] - b * f[0]
            if abs(a + b * f[1] - y[1]) <= _EXACT * np.max(np.abs(y)):
                yield float(a), float(b), k


def at_base(one: Slider, base: Array, forms: dict[int, Form]) -> Slider:
    """The slider with its unit, and with the value that gives the numbers `base` with which the walk begins."""
    unit = Scenario.field_of(one.name).unit.replace("^2", "²")
    one = one._replace(unit="" if unit == "1" else unit)
    place, form = next(iter(forms.items()))
    if isinstance(form, list):
        rows = np.array([*forms.values()]).T
        same = [x for x, row in zip(one.table, rows, strict=True) if np.all(row == base[[*forms]])]
        return one._replace(value=same[0] if same else None)
    a, b, k = form
    y = (base[place] - a) / b
    x = float(np.arctan(y) if k == 0 else y ** (1.0 / k))
    if not np.isfinite(x):
        return one
    return one._replace(low=min(one.low, x), high=max(one.high, x), value=float(f"{x:.12g}"))
