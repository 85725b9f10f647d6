"""The instructions of a CasADi function, one after the other, written as text in any language.

CasADi lists the instructions of an expression in order, common subexpressions taken out; each
becomes a line or two. Nothing is re-ordered by value, so every language computes the same numbers.
A language is a table of patterns by operation (`engine.ir`, `engine.c_text`) and a `Writer` that
says how values get their names, and how numbers are read and stored.

    pattern     one text, or several lines in a row
    {a} {b}     the operands;  {c} the third one, of CHOICE
    {0} {1}     the values of the lines before, in a pattern of several
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping

import casadi as ca

from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.errors import InputError

CHOICE = -1
"""Code of an operation that CasADi has not: b where a is not 0, else c."""
Patterns = Mapping[int, str | tuple[str, ...]]
"""Lines by operation; those of a tuple stand one after the other."""
FUNCTIONS = {
    getattr(ca, f"OP_{name.upper()}"): name
    for name in ["sin", "cos", "tan", "exp", "log", "sinh", "cosh", "tanh", "asin", "acos", "atan"]
} | {ca.OP_POW: "pow", ca.OP_CONSTPOW: "pow"}
"""Operations that are functions of the C library, by their names there."""


def straight_line(function: SymbolicFunction) -> ca.Function:
    """The function as CasADi's list of instructions, each value computed once (CasADi's cse)."""
    return ca.Function("f", [function.K, function.inp], ca.cse([function.out]))


class Writer(ABC):
    """The lines of one function while it is written.

    work: names of the values that CasADi's registers hold. loaded: names of entries of K and inp,
    each read once. Outputs are stored last, since they may lie where an input is.
    """

    patterns: Patterns
    language: str
    """For the message about an operation that has no pattern."""

    def __init__(self) -> None:
        """Nothing written yet."""
        self.lines: list[str] = []
        self.stores: list[str] = []
        self.work: dict[int, str] = {}
        self.loaded: dict[tuple[int, int], str] = {}
        self.negated: dict[str, str] = {}
        """By the name of a NOT, what it is of."""
        self.chosen: dict[str, tuple[str, str]] = {}
        """By the name of a choice against zero, its condition and its value."""

    @abstractmethod
    def literal(self, x: float) -> str:
        """A number with all its bits."""

    @abstractmethod
    def read(self, block: int, index: int) -> str:
        """Name of the value of an entry of K (block 0) or inp (1)."""

    @abstractmethod
    def store(self, index: int, value: str) -> None:
        """Write, into `stores`, that this value is an output."""

    @abstractmethod
    def new(self, text: str, operands: tuple[str, ...]) -> str:
        """Write a line, made from these operands, and give its value a new name."""

    def written(self, f: ca.Function) -> list[str]:
        """The lines of all instructions of a function (K, inp) -> out."""
        for i in range(f.n_instructions()):
            self.instruction(f, i)
        return [*self.lines, *self.stores]

    def instruction(self, f: ca.Function, i: int) -> None:
        """Write CasADi's instruction number i."""
        code, a, o = f.instruction_id(i), f.instruction_input(i), f.instruction_output(i)
        if code == ca.OP_CONST:
            self.work[o[0]] = self.literal(f.instruction_constant(i))
        elif code == ca.OP_INPUT:
            at = a[0], a[1]
            if at not in self.loaded:
                self.loaded[at] = self.read(*at)
            self.work[o[0]] = self.loaded[at]
        elif code == ca.OP_OUTPUT:
            self.store(o[1], self.work[a[0]])
        else:
            self.work[o[0]] = self.value(code, tuple(self.work[k] for k in a))

    def value(self, code: int, a: tuple[str, ...]) -> str:
        """Name of the value of an operation `code` of the values a."""
        if code == ca.OP_ASSIGN:
            return a[0]
        if code == ca.OP_ADD and (both := self.either(*a)) is not None:
            return self.line(CHOICE, both)
        name = self.line(code, a)
        if code == ca.OP_NOT:
            self.negated[name] = a[0]
        if code == ca.OP_IF_ELSE_ZERO:
            self.chosen[name] = a[0], a[1]
        return name

    def line(self, code: int, a: tuple[str, ...]) -> str:
        """Write the lines of an operation. Raises InputError for one without a pattern."""
        if code not in self.patterns:
            raise InputError(
                f"CasADi's operation {code} has no line of {self.language}; use NumPy's basic ones"
            )
        pattern = self.patterns[code]
        operands, names = dict(zip("abc", a, strict=False)), list[str]()
        for text in (pattern,) if isinstance(pattern, str) else pattern:
            names.append(self.new(text.format(*names, **operands), a))
        return names[-1]

    def either(self, one: str, other: str) -> tuple[str, str, str] | None:
        """Condition and values of a sum of two choices of which exactly one is made; None for any other sum.

        CasADi writes if_else(condition, a, b) as such a sum; as one choice it costs less.
        """
        if one in self.chosen and other in self.chosen:
            (condition, a), (against, b) = self.chosen[one], self.chosen[other]
            if self.negated.get(against) == condition:
                return condition, a, b
        return None
