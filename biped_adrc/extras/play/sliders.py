"""Sliders of a page: how the numbers of a walk depend on one value of the scenario, so that the page itself can
compute them while the walk goes on.

The numbers of a walk are all cells of the memory block of its run, (N,), at its start. A form is one of

    number = b s^k,  a + b s,  a + b tan s

for each number that changes with the value s of the slider. a, b and k follow from the numbers at three values
of s, of which the middle one only checks. Where the numbers follow no such form, as the gains of an observer in
sampled time over its bandwidth, a table has them at round values of s. Of two sliders that change the same
number the second is left out.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple, Self

import numpy as np

from biped_adrc.control.base import Controller
from biped_adrc.control.footstep import Footstep
from biped_adrc.control.tracking import TABLE_II
from biped_adrc.core.errors import BipedError
from biped_adrc.core.registry import find, takes
from biped_adrc.core.types import Array
from biped_adrc.scenario.controllers import CONTEXT, GAINS
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.units import PLAIN

Form = tuple[float, float, int] | list[float]
"""How a number depends on the value s of a slider: (a, b, k) for a + b s^k, with tan(s) in place of s^k for
k = 0; or a list of its values at the slider's table."""
_Numbers = Callable[[Mapping[str, object]], Array]
"""A function that returns the numbers of a walk (N,) for other values of its scenario, by name. It raises
BipedError for values that the walk cannot have, or that change the structure of its machine code."""
ROUND = np.array((10, 12, 15, 20, 25, 30, 40, 50, 60, 80))
"""First two digits of the values in tables."""
CLOSER = 8
"""Number of values, from the end of a slider's range to its present value, that are tried as another end."""
POWERS = (*range(1, 15), -1, -2)
"""Exponents k of b s^k that are tried; gains of an observer of high order are high powers of its bandwidth."""
_EXACT = 1e-12
"""Largest relative error with which a form counts as exact."""
ELSEWHERE = (*CONTEXT, *GAINS, "bandwidth", "order", "poles", "solve_theta", "reset")
"""Parameters of controllers that get no slider of their own."""


class Slider(NamedTuple):
    """A slider on the page: the value of a scenario that it changes, in SI units, and its range."""

    name: str
    """Dotted name of the value in the scenario."""
    low: float
    high: float
    log: bool
    """Whether the slider is logarithmic."""
    unit: str = ""
    scale: float = 1.0
    """Displayed number divided by the value in SI units."""
    value: float | None = None
    """Value with which the walk begins; None where no value of the slider gives its numbers, such as an
    observer whose poles are a list."""
    shared: bool = False
    """Whether it changes the ghost, the second walk of the page, too: for values of robot and ground."""

    also: Mapping[str, object] = {}
    """Other values of the scenario that are set with it, such as the order with the bandwidth."""

    table: tuple[float, ...] = ()
    """The values that it can have; empty: any between low and high."""

    @property
    def tried(self) -> tuple[float, float, float]:
        """Three values of the slider at which forms are fitted: both ends, and one between them.

        In a linear range this is not the middle: if the range is symmetric to 0, a + b s and a + b tan s are
        equal there.
        """
        middle = np.sqrt(self.low * self.high) if self.log else 0.4 * self.low + 0.6 * self.high
        return self.low, float(middle), self.high

    def tabulated(self) -> Self:
        """A copy of the slider with a table of its values: round ones of a logarithmic range, else 21 even
        ones.
        """
        # ROUND: first two digits of the round values, which are in all decades
        known = np.unique(np.outer(10.0 ** np.arange(-9, 9), ROUND).round(12))
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


def offered(s: Scenario, law: Controller) -> Iterator[Slider]:
    """Iterate over the sliders that a scenario s may have: the usual ones, and those of its controller's own
    parameters.

    law: the controller; the order m of its observer is kept when the bandwidth changes.
    """
    order = getattr(getattr(law, "observer", None), "m", None)
    # also: set with the observer's sliders; poles of a list would override the bandwidth, so they are dropped.
    # Gains that s leaves out are those of Table II of the paper
    also: dict[str, object] = {} if order is None else {OBSERVER + "order": order}
    also |= {OBSERVER + "poles": "none"} if s.controller.observer.poles else {}
    # ELSEWHERE: parameters that have one of the usual sliders, or that no slider can set
    c = s.controller
    values = {f"controller.{k}": getattr(c, k) or float(getattr(TABLE_II, k)) for k in GAINS}
    # _USUAL: the sliders of every walk; OBSERVER: how the observer's names begin
    for one in _USUAL:
        also_here = also if one.name.startswith(OBSERVER) else {}
        yield one._replace(also=also_here, value=values.get(one.name))
    # takes: the parameters of its class; c.own: those that the scenario sets
    for name, parameter in takes(find("controller", c.name).load()).items():
        x = c.own.get(name, parameter.default)
        if isinstance(law, Footstep) and name == "speed":
            low, high = law.family.low[0], law.family.high[0]
            yield Slider("controller.speed", low, high, False, "m/s", value=law.speed)
        elif isinstance(x, float) and np.isfinite(x) and name not in ELSEWHERE:
            # a tenth to ten times the value, sorted, since it may be negative; logarithmic if it is positive
            low, high = sorted((0.1 * x, 10.0 * x)) if x else (-1.0, 1.0)
            yield Slider(f"controller.{name}", low, high, x > 0.0, value=x)


def sliders(
    s: Scenario, law: Controller, base: Array, numbers: _Numbers
) -> dict[str, tuple[Slider, dict[int, Form]]]:
    """Find the sliders of a walk: name -> (slider, index of each number that it changes -> form).

    s: the walk's scenario. law: its controller. base (N,): numbers of the walk. numbers: function that returns
    them for other values of s.
    """
    # moved: indices of the numbers that a slider changes already
    result, moved = dict[str, tuple[Slider, dict[int, Form]]](), set[int]()
    # offered: candidates for this scenario; with_forms: one of them, and the forms of the numbers it changes
    for one in offered(s, law):
        try:
            one, forms = with_forms(one, base, numbers)
        except BipedError:  # the walk cannot have this slider, so the page goes without it
            continue
        # at_base: its value at the start is the one whose forms give the numbers of the walk
        if forms and moved.isdisjoint(forms):
            moved |= forms.keys()
            result[one.name] = at_base(one, base, forms), forms
    return result


def with_forms(one: Slider, base: Array, numbers: _Numbers) -> tuple[Slider, dict[int, Form]]:
    """Fit the numbers that one slider changes; returns the slider, with another range or a table where needed,
    and index -> form.

    base (N,): numbers of the walk. The range shrinks where the walk refuses its ends. Raises BipedError where
    the walk cannot have the slider. Without a number that changes the forms are empty.
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
    """The end x of a slider's range, moved towards its present value until the walk accepts it.

    It is rounded to two digits. A slider without a present value keeps its end.
    """
    # x becomes the value tried last: the first one that the walk accepts, or else the present value
    ways = np.geomspace if one.log else np.linspace
    # CLOSER values are tried as another end
    for y in () if one.value is None else ways(x, one.value, CLOSER):
        try:
            numbers_at(one, numbers, (x := float(f"{y:.2g}"),))
            break
        except BipedError:
            continue
    return x


def numbers_at(one: Slider, numbers: _Numbers, values: Sequence[float] = ()) -> Array:
    """Numbers of the walk as rows (.., N), one for each of these values of a slider, or of `tried` if empty.

    Raises BipedError where the walk cannot have a value.
    """
    return np.array([numbers({one.name: x, **one.also}) for x in values or one.tried])


def changing(base: Array, rows: Array) -> list[int]:
    """Indices of the numbers that differ between the rows (.., N).

    Empty where `base` (N,) differs from the rows in any other number: then the slider alone cannot reach the
    walk as it begins.
    """
    change = np.any(rows != rows[0], axis=0)  # (N,), whether a number depends on the slider
    return [] if np.any(base[~change] != rows[0, ~change]) else np.flatnonzero(change).tolist()


def forms_of(one: Slider, base: Array, rows: Array) -> dict[int, Form]:
    """Fit a form (a, b, k) to each number that changes over the rows (3, N), those of the slider's `tried`.

    Returns index -> form; empty where any of them follows no form.
    """
    s = np.array(one.tried)
    result = {k: next(closed(s, rows[:, k]), None) for k in changing(base, rows)}
    return {k: form for k, form in result.items() if form} if all(result.values()) else {}


def closed(s: Array, y: Array) -> Iterator[tuple[float, float, int]]:
    """Iterate over the forms (a, b, k) of `Form` that pass through three numbers y (3,) at the slider's values
    s (3,): powers first, then a + b s and, with k = 0, a + b tan s.
    """
    with np.errstate(all="ignore"):
        # POWERS: exponents k that are tried
        for k in POWERS if np.all(s > 0.0) else ():
            # b follows from the last value, the other two have to agree
            # _EXACT: largest relative error of a form
            if np.all(np.abs(y / (y[2] / s[2] ** k * s**k) - 1.0) < _EXACT):
                yield 0.0, float(y[2] / s[2] ** k), k
        for k, f in ((1, s), (0, np.tan(s))):
            b = (y[2] - y[0]) / (f[2] - f[0])
            a = y[0] - b * f[0]
            if abs(a + b * f[1] - y[1]) <= _EXACT * np.max(np.abs(y)):
                yield float(a), float(b), k


def at_base(one: Slider, base: Array, forms: dict[int, Form]) -> Slider:
    """The slider with its unit, and with the value at which its forms give the numbers `base` (N,) of the walk.

    The range is extended to this value. A table without it gives the value None; where the form has no inverse,
    the slider stays as it is.
    """
    # the first form is solved for s: all of them give the same
    unit = one.unit or Scenario.field_of(one.name).unit.replace("^2", "²")
    one = one._replace(unit="" if unit in PLAIN else unit)
    place, form = next(iter(forms.items()))
    if isinstance(form, list):  # the numbers at the values of the slider's table
        rows = np.array([*forms.values()]).T
        same = [x for x, row in zip(one.table, rows, strict=True) if np.all(row == base[[*forms]])]
        return one._replace(value=same[0] if same else None)
    # number = a + b s^k, with tan s in place of s^k for k = 0
    a, b, k = form
    y = (base[place] - a) / b
    x = float(np.arctan(y) if k == 0 else y ** (1.0 / k))
    if not np.isfinite(x):
        return one
    return one._replace(low=min(one.low, x), high=max(one.high, x), value=float(f"{x:.12g}"))
