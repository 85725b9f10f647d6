"""LLVM's language for a straight-line function: `void f(double* K, double* inp, double* out)`.

Second stage of the compiler, between `engine.symbols` and `engine.machine`. CasADi lists the
instructions of an expression in order, common subexpressions taken out; each becomes one line.
Nothing is re-ordered by value and no operations are fused into multiply-adds, so the numbers are
the same whatever function is compiled beside.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping

import casadi as ca

from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.engine.machine import LoadedCode, ModuleText, remembered
from biped_adrc.errors import InputError

BINARY = {ca.OP_ADD: "fadd", ca.OP_SUB: "fsub", ca.OP_MUL: "fmul", ca.OP_DIV: "fdiv"}
"""CasADi's operations of two numbers that are one LLVM instruction."""
UNARY = {
    ca.OP_NEG: "fneg double {0}",
    ca.OP_TWICE: "fadd double {0}, {0}",
    ca.OP_SQ: "fmul double {0}, {0}",
    ca.OP_INV: "fdiv double 1.0, {0}",
}
"""Patterns of operations of one number."""
COMPARISONS = {ca.OP_LT: "olt", ca.OP_LE: "ole", ca.OP_EQ: "oeq", ca.OP_NE: "une"}
"""Comparisons by LLVM's conditions; a result is 0.0 or 1.0."""
ONE = {ca.OP_FABS: "llvm.fabs.f64", ca.OP_SQRT: "llvm.sqrt.f64", ca.OP_FLOOR: "llvm.floor.f64"}
"""Calls of functions of one number: LLVM's intrinsics, or the C library's."""
ONE |= {
    getattr(ca, f"OP_{name.upper()}"): name
    for name in ["sin", "cos", "tan", "exp", "log", "sinh", "cosh", "tanh", "asin", "acos", "atan"]
}
TWO = {ca.OP_FMIN: "llvm.minimum.f64", ca.OP_FMAX: "llvm.maximum.f64"}
"""Calls of functions of two numbers; minimum and maximum pass NaN on."""
TWO |= {ca.OP_POW: "pow", ca.OP_CONSTPOW: "pow"}
DECLARATIONS = "\n".join(
    [f"declare double @{name}(double) #0" for name in ONE.values()]
    + [f"declare double @{name}(double, double) #0" for name in dict.fromkeys(TWO.values())]
    + ["attributes #0 = { nounwind readnone willreturn }"]
)
"""Head of every module."""


def generated(
    key: str, functions: Mapping[str, Callable[[], SymbolicFunction]], vectors: bool = False
) -> LoadedCode:
    """These functions in memory, by name; traced and written only where no object code is stored
    under `key`.

    - key: a hash of all that the functions depend on (`engine.fingerprint`).
    - functions: by name, each to be called for its expression.
    - vectors: as of `ModuleText`.
    """

    def text() -> ModuleText:
        return ModuleText(module_text({name: f() for name, f in functions.items()}), vectors)

    return remembered(key, list(functions), text)


def module_text(functions: dict[str, SymbolicFunction]) -> str:
    """A module of functions, by name. Raises InputError for an operation that has no line here."""
    return "\n".join([DECLARATIONS, *(function_text(name, f) for name, f in functions.items())])


def function_text(name: str, function: SymbolicFunction) -> str:
    """The text of one function with arguments K, inp, out, which do not overlap.

    Common subexpressions are taken out first (CasADi's cse): positions and rates of the links occur
    many times.
    """
    f = ca.Function("f", [function.K, function.inp], ca.cse([function.out]))
    writer = _Writer()
    for i in range(f.n_instructions()):
        writer.instruction(f, i)
    head = f"define void @{name}(ptr noalias %K, ptr noalias %inp, ptr noalias %out) nounwind {{"
    return "\n".join([head, *writer.lines, *writer.stores, "ret void", "}"])


class _Writer:
    """The lines of one function while it is written.

    work: names of the values that CasADi's registers hold. loaded: names of entries of K and inp,
    each loaded once. stores: the lines that write out; they come last.
    """

    def __init__(self) -> None:
        """Nothing written yet; `count` numbers the values, which LLVM wants to be assigned once each."""
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
        """Write a line and give its value a new name."""
        self.count += 1
        lines = self.lines if to is None else to
        lines.append(f"%v{self.count} = {text}")
        return f"%v{self.count}"

    def at(self, block: str, index: int, to: list[str] | None = None) -> str:
        """Address of an entry of K, inp or out."""
        return self.new(f"getelementptr double, ptr {block}, i64 {index}", to)

    def load(self, block: str, index: int) -> str:
        """Value of an entry of K or inp, loaded once."""
        if (block, index) not in self.loaded:
            self.loaded[block, index] = self.new(f"load double, ptr {self.at(block, index)}")
        return self.loaded[block, index]

    def instruction(self, f: ca.Function, i: int) -> None:
        """Write CasADi's instruction number i."""
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

    def value(self, code: int, a: list[str], f: ca.Function) -> str:
        """Name of the value of an operation `code` of the values a; writes the lines that it needs.

        Comparisons and NOT give 0.0 or 1.0, choices select. Raises InputError for an operation
        without a line here.
        """
        if code in COMPARISONS:
            bit = self.new(f"fcmp {COMPARISONS[code]} double {a[0]}, {a[1]}")
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
        if code in BINARY:
            return self.new(f"{BINARY[code]} double {a[0]}, {a[1]}")
        if code in UNARY:
            return self.new(UNARY[code].format(a[0]))
        if code in ONE:
            return self.new(f"call double @{ONE[code]}(double {a[0]})")
        if code in TWO:
            return self.new(f"call double @{TWO[code]}(double {a[0]}, double {a[1]})")
        raise InputError(
            f"CasADi's operation {code} has no line of machine code; use NumPy's basic ones"
        )

    def either(self, one: str, other: str) -> str | None:
        """The sum of two choices of which exactly one is made, as a single choice; None for any other sum.

        CasADi writes if_else(condition, a, b) as such a sum; as one choice it costs less.
        """
        if one in self.chosen and other in self.chosen:
            (condition, a), (against, b) = self.chosen[one], self.chosen[other]
            if self.negated.get(against) == condition:
                bit = self.new(f"fcmp une double {condition}, 0.0")
                return self.new(f"select i1 {bit}, double {a}, double {b}")
        return None


def literal(x: float) -> str:
    """A double in LLVM's language with all its bits, so that no digits are lost."""
    return f"0x{struct.unpack('<Q', struct.pack('<d', float(x)))[0]:016X}"
