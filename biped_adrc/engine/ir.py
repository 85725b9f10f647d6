"""LLVM's language for a straight-line function: `void f(double* K, double* inp, double* out)`.

CasADi lists the instructions of an expression in order; each becomes one line. Nothing is re-ordered by value
and no operations are fused, so the numbers are the same whatever runs beside.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping
from typing import Any

import casadi as ca

from biped_adrc.engine.equations import Function
from biped_adrc.engine.machine import Machine, Text, remembered
from biped_adrc.errors import InputError

Line = Callable[[list[str]], str]


def _call(name: str) -> Line:
    arguments = ", ".join
    return lambda a: f"call double @{name}({arguments(f'double {x}' for x in a)})"


def _compare(how: str) -> Line:
    return lambda a: f"fcmp {how} double {a[0]}, {a[1]}"


OPERATIONS: dict[int, Line] = {
    ca.OP_ADD: lambda a: f"fadd double {a[0]}, {a[1]}",
    ca.OP_SUB: lambda a: f"fsub double {a[0]}, {a[1]}",
    ca.OP_MUL: lambda a: f"fmul double {a[0]}, {a[1]}",
    ca.OP_DIV: lambda a: f"fdiv double {a[0]}, {a[1]}",
    ca.OP_NEG: lambda a: f"fneg double {a[0]}",
    ca.OP_TWICE: lambda a: f"fadd double {a[0]}, {a[0]}",
    ca.OP_SQ: lambda a: f"fmul double {a[0]}, {a[0]}",
    ca.OP_INV: lambda a: f"fdiv double 1.0, {a[0]}",
    ca.OP_FABS: _call("llvm.fabs.f64"),
    ca.OP_SQRT: _call("llvm.sqrt.f64"),
    ca.OP_FLOOR: _call("llvm.floor.f64"),
    ca.OP_FMIN: _call("llvm.minimum.f64"),
    ca.OP_FMAX: _call("llvm.maximum.f64"),
    ca.OP_POW: _call("pow"),
    ca.OP_CONSTPOW: _call("pow"),
    **{
        code: _call(name)
        for code, name in (
            *((ca.OP_SIN, "sin"), (ca.OP_COS, "cos"), (ca.OP_TAN, "tan"), (ca.OP_EXP, "exp")),
            *((ca.OP_LOG, "log"), (ca.OP_SINH, "sinh"), (ca.OP_COSH, "cosh"), (ca.OP_TANH, "tanh")),
            *((ca.OP_ASIN, "asin"), (ca.OP_ACOS, "acos"), (ca.OP_ATAN, "atan")),
        )
    },
}
COMPARISONS: dict[int, Line] = {
    ca.OP_LT: _compare("olt"),
    ca.OP_LE: _compare("ole"),
    ca.OP_EQ: _compare("oeq"),
    ca.OP_NE: _compare("une"),
}
ONE: tuple[str, ...] = (
    "llvm.fabs.f64",
    "llvm.sqrt.f64",
    "llvm.floor.f64",
    "sin",
    "cos",
    "tan",
    "exp",
    "log",
)
ONE += ("sinh", "cosh", "tanh", "asin", "acos", "atan")
TWO = ("llvm.minimum.f64", "llvm.maximum.f64", "pow")
DECLARATIONS = "\n".join(
    [f"declare double @{name}(double) #0" for name in ONE]
    + [f"declare double @{name}(double, double) #0" for name in TWO]
    + ["attributes #0 = { nounwind readnone willreturn }"]
)


def generated(
    key: str, functions: Mapping[str, Callable[[], Function]], vectors: bool = False
) -> Machine:
    """These functions in memory, traced where none are stored under `key`; vectors: as of `Text`."""

    def text() -> Text:
        return Text(module_text({name: f() for name, f in functions.items()}), vectors)

    return remembered(key, list(functions), text)


def module_text(functions: dict[str, Function]) -> str:
    """A module of functions. Raises InputError for an operation that has no line here."""
    return "\n".join([DECLARATIONS, *(function_text(name, f) for name, f in functions.items())])


def function_text(name: str, function: Function) -> str:
    """One function."""
    f = ca.Function("f", [function.K, function.inp], ca.cse([function.out]))
    writer = _Writer()
    for i in range(f.n_instructions()):
        writer.instruction(f, i)
    head = f"define void @{name}(ptr noalias %K, ptr noalias %inp, ptr noalias %out) nounwind {{"
    return "\n".join([head, *writer.lines, *writer.stores, "ret void", "}"])


class _Writer:
    """The lines of one function; `work` is what CasADi's registers hold."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.stores: list[str] = []
        self.work: dict[int, str] = {}
        self.loaded: dict[tuple[str, int], str] = {}
        self.count = 0
        self.negated: dict[str, str] = {}
        """By the name of a NOT, what it is of."""
        self.chosen: dict[str, tuple[str, str]] = {}
        """By the name of a choice against zero, its condition and its value."""

    def new(self, text: str, to: list[str] | None = None) -> str:
        self.count += 1
        lines = self.lines if to is None else to
        lines.append(f"%v{self.count} = {text}")
        return f"%v{self.count}"

    def at(self, block: str, index: int, to: list[str] | None = None) -> str:
        return self.new(f"getelementptr double, ptr {block}, i64 {index}", to)

    def load(self, block: str, index: int) -> str:
        if (block, index) not in self.loaded:
            self.loaded[block, index] = self.new(f"load double, ptr {self.at(block, index)}")
        return self.loaded[block, index]

    def instruction(self, f: Any, i: int) -> None:
        code, a, o = f.instruction_id(i), f.instruction_input(i), f.instruction_output(i)
        if code == ca.OP_CONST:
            self.work[o[0]] = literal(f.instruction_constant(i))
        elif code == ca.OP_INPUT:
            self.work[o[0]] = self.load(("%K", "%inp")[a[0]], a[1])
        elif code == ca.OP_OUTPUT:
            at = self.at("%out", o[1], self.stores)
            self.stores.append(f"store double {self.work[a[0]]}, ptr {at}")
        else:
            self.work[o[0]] = self.value(code, [self.work[k] for k in a], f)

    def value(self, code: int, a: list[str], f: Any) -> str:
        if code in COMPARISONS:
            bit = self.new(COMPARISONS[code](a))
            return self.new(f"uitofp i1 {bit} to double")
        if code == ca.OP_NOT:
            bit = self.new(f"fcmp oeq double {a[0]}, 0.0")
            name = self.new(f"uitofp i1 {bit} to double")
            self.negated[name] = a[0]
            return name
        if code == ca.OP_IF_ELSE_ZERO:
            bit = self.new(f"fcmp une double {a[0]}, 0.0")
            name = self.new(f"select i1 {bit}, double {a[1]}, double 0.0")
            self.chosen[name] = a[0], a[1]
            return name
        if code == ca.OP_ADD and (both := self.either(a[0], a[1])) is not None:
            return both
        if code == ca.OP_SIGN:
            high = self.new(f"fcmp ogt double {a[0]}, 0.0")
            low = self.new(f"fcmp olt double {a[0]}, 0.0")
            negative = self.new(f"select i1 {low}, double -1.0, double 0.0")
            return self.new(f"select i1 {high}, double 1.0, double {negative}")
        if code == ca.OP_ASSIGN:
            return a[0]
        if code not in OPERATIONS:
            raise InputError(
                f"CasADi's operation {code} has no line of machine code; use NumPy's basic ones"
            )
        unary = code in (ca.OP_TWICE, ca.OP_SQ, ca.OP_INV, ca.OP_NEG)
        two = code in (ca.OP_ADD, ca.OP_SUB, ca.OP_MUL, ca.OP_DIV, ca.OP_FMIN, ca.OP_FMAX)
        two = two or code in (ca.OP_POW, ca.OP_CONSTPOW)
        return self.new(OPERATIONS[code](a[:1] if unary or not two else a))

    def either(self, one: str, other: str) -> str | None:
        """A sum of two choices of which one is made: CasADi's if_else(condition, a, b), in one choice."""
        if one in self.chosen and other in self.chosen:
            (condition, a), (against, b) = self.chosen[one], self.chosen[other]
            if self.negated.get(against) == condition:
                bit = self.new(f"fcmp une double {condition}, 0.0")
                return self.new(f"select i1 {bit}, double {a}, double {b}")
        return None


def literal(x: float) -> str:
    """A double with all its bits."""
    return f"0x{struct.unpack('<Q', struct.pack('<d', float(x)))[0]:016X}"
