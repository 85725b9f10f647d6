"""What a search may change: values of a scenario with a range or choices, and when they have an effect.

A candidate has a value of every variable. Those that are idle are left out of its scenario: with

    contact = { choices = ["none", "hold"] }
    contact_window = { from = "5 ms", to = "30 ms", when = { contact = "hold" } }

a candidate without `contact` is walked without a window. So every candidate lies in one box, in which a sampler
can compare it with all others.
"""

from __future__ import annotations

from collections.abc import Mapping
from inspect import Parameter, signature

from pydantic import Field

from biped_adrc.bench.parameters import Value
from biped_adrc.bench.study import Part, Range
from biped_adrc.scenario.registry import find
from biped_adrc.scenario.scenario import field_of

Values = Mapping[str, Value]
"""Values of a scenario by name, in SI units; those of tables with a dot, as in "own.gain"."""


class Variable(Part):
    """One thing that the search may change: the numbers of a range, or one of several choices."""

    range: Range | None = None
    """Of a number; None for choices."""
    choices: tuple[Value, ...] = ()
    """Values to choose from; empty for a range."""
    when: dict[str, tuple[Value, ...]] = Field(default_factory=dict)
    """By name of another value: those of its values with which this variable has an effect. Empty: always."""

    @property
    def middle(self) -> Value:
        """A value for where the variable is idle: the first choice, or the middle of the range."""
        return self.choices[0] if self.range is None else self.range.at(0.5)

    def holds(self, x: Value) -> bool:
        """Whether x is among its values."""
        if self.range is None:
            return x in self.choices
        return isinstance(x, float | int) and self.range.low <= x <= self.range.high

    def acts(self, values: Values) -> bool:
        """Whether it has an effect beside these values of a scenario."""
        return all(
            values.get(name, field_of(name).default) in told for name, told in self.when.items()
        )


def scenario_values(
    variables: Mapping[str, Variable], fixed: Values, chosen: Values
) -> dict[str, Value]:
    """The values of a candidate's scenario: `fixed`, and those of `chosen` that have an effect."""
    made = {**fixed, **chosen}
    while idle := [name for name, x in variables.items() if name in made and not x.acts(made)]:
        for name in idle:  # and in the next round those that depend on one of them
            del made[name]
    return made


def published_place(variables: Mapping[str, Variable], fixed: Values) -> dict[str, Value] | None:
    """Where the as-published setting lies among the candidates; None where it lies outside.

    fixed: its values. What they do not name has the default of the scenario, of the registry's entry, or of the
    controller's constructor, in this order; a variable that has none of these has no published value.
    """
    usual = _constructor_defaults(fixed)
    place = {}
    for name, variable in variables.items():
        known = fixed.get(name, field_of(name).default)
        x = usual.get(name.rpartition(".")[2]) if known is None else known
        idle = not variable.acts(fixed)
        if not idle and not variable.holds(x):
            return None
        place[name] = variable.middle if idle else x
    return place


def _constructor_defaults(fixed: Values) -> dict[str, Value]:
    """Numbers that the controller takes where the scenario has none, by name."""
    entry = find("controller", str(fixed.get("controller.name", "ADRC")))
    parameters = signature(entry.load()).parameters.values()
    own = {p.name: p.default for p in parameters if p.default is not Parameter.empty}
    return {**{k: x for k, x in own.items() if isinstance(x, float | int)}, **entry.defaults}
