"""The instructions of a CasADi function, one after the other, written as text in any language.

CasADi lists the instructions of an expression in order, common subexpressions taken out; each
becomes a line or two. Nothing is re-ordered by value, so every language computes the same numbers.
A language is a table of patterns by operation (here and in `extras.export.c_text`) and a `Writer` that
says how values get their names, and how numbers are read and stored.

    pattern     one text, or several lines in a row
    {a} {b}     the operands;  {c} the third one, of CHOICE
    {0} {1}     the values of the lines before, in a pattern of several

LLVM's language is here, for `void f(double* K, double* inp, double* out)`: second stage of the compiler,
between `engine.symbols` and `engine.machine`. No operations are fused into multiply-adds, so the numbers are
the same whatever function is compiled beside.
"""

from __future__ import annotations

import struct
from abc import ABC, abstractmethod
from collections.abc import Callable, Hashable, Mapping

import casadi as ca

from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.engine.machine import LoadedCode, keep, load_or_compile, stored
from biped_adrc.engine.structure import Unchanged, lasting, reaching
from biped_adrc.engine.symbols import NotCompiled

CHOICE = -1
"""Code of an operation that CasADi has not: b where a is not 0, else c."""
Patterns = Mapping[int, str | tuple[str, ...]]
"""Lines by operation; those of a tuple stand one after the other."""
FUNCTIONS: dict[int, str] = {
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
        """Write the lines of an operation. Raises NotCompiled for one without a pattern."""
        if code not in self.patterns:
            raise NotCompiled(
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


COMPARISONS = {ca.OP_LT: "olt", ca.OP_LE: "ole", ca.OP_EQ: "oeq", ca.OP_NE: "une"}
"""Comparisons by LLVM's conditions; a result is 0.0 or 1.0."""
CALLED = {ca.OP_FABS: "llvm.fabs.f64", ca.OP_SQRT: "llvm.sqrt.f64", ca.OP_FLOOR: "llvm.floor.f64"}
CALLED |= {ca.OP_FMIN: "llvm.minimum.f64", ca.OP_FMAX: "llvm.maximum.f64", **FUNCTIONS}
"""LLVM's intrinsics and the C library's functions; minimum and maximum pass NaN on."""
OF_TWO = (ca.OP_FMIN, ca.OP_FMAX, ca.OP_POW, ca.OP_CONSTPOW)
"""Those of two numbers."""
PATTERNS: Patterns = {
    ca.OP_ADD: "fadd double {a}, {b}",
    ca.OP_SUB: "fsub double {a}, {b}",
    ca.OP_MUL: "fmul double {a}, {b}",
    ca.OP_DIV: "fdiv double {a}, {b}",
    ca.OP_NEG: "fneg double {a}",
    ca.OP_TWICE: "fadd double {a}, {a}",
    ca.OP_SQ: "fmul double {a}, {a}",
    ca.OP_INV: "fdiv double 1.0, {a}",
    ca.OP_NOT: ("fcmp oeq double {a}, 0.0", "uitofp i1 {0} to double"),
    ca.OP_IF_ELSE_ZERO: ("fcmp une double {a}, 0.0", "select i1 {0}, double {b}, double 0.0"),
    CHOICE: ("fcmp une double {a}, 0.0", "select i1 {0}, double {b}, double {c}"),
    ca.OP_SIGN: (
        "fcmp ogt double {a}, 0.0",
        "fcmp olt double {a}, 0.0",
        "select i1 {1}, double -1.0, double 0.0",
        "select i1 {0}, double 1.0, double {2}",
    ),
    **{
        code: (f"fcmp {sign} double {{a}}, {{b}}", "uitofp i1 {0} to double")
        for code, sign in COMPARISONS.items()
    },
    **{
        code: f"call double @{name}(double {{a}}{', double {b}' if code in OF_TWO else ''})"
        for code, name in CALLED.items()
    },
}
"""Lines of LLVM by operation."""
DECLARATIONS = "\n".join(
    f"declare double @{name}(double{', double' if code in OF_TWO else ''}) nounwind readnone willreturn"
    for name, code in {name: code for code, name in CALLED.items()}.items()
)
"""Head of every module."""


Functions = Mapping[str, Callable[[], SymbolicFunction]]
"""By name, each to be called for its expression."""
_IN_MEMORY: dict[Hashable, tuple[LoadedCode | str, list[Unchanged]]] = {}
"""Code by structure, or why there is none, with what it reached; a function is a value, so this is no state."""


def generated(key: Hashable, functions: Functions, vectors: bool = False) -> LoadedCode:
    """These functions in memory, by name; traced once per structure.

    - key: the structure of what they are made from (`engine.structure`).
    - vectors: as of `machine.compiled`.

    Raises NotCompiled, each time without tracing anew.
    """
    names = list(functions)
    key = key, *names
    code, reached = _IN_MEMORY.get(key, (None, []))
    if code is None or not all(unchanged() for unchanged in reached):
        with reaching() as reached:
            try:
                code = load_or_compile(_text(key, functions), names, vectors)
            except NotCompiled as error:
                code = str(error)
        _IN_MEMORY[key] = code, reached
    if isinstance(code, str):
        raise NotCompiled(code)
    return code


def _text(key: Hashable, functions: Functions) -> str:
    """The text of these functions; from the disk where another process has made it for the same structure."""
    link = lasting(key)
    there = stored(link) if link else None
    if there is not None:
        return there.decode()
    result = module_text({name: f() for name, f in functions.items()})
    if link:
        keep(link, result.encode())
    return result


def module_text(functions: dict[str, SymbolicFunction]) -> str:
    """A module of functions, by name. Raises InputError for an operation that has no line here."""
    return "\n".join([DECLARATIONS, *(function_text(name, f) for name, f in functions.items())])


def function_text(name: str, function: SymbolicFunction) -> str:
    """The text of one function with arguments K, inp, out, which do not overlap."""
    head = f"define void @{name}(ptr noalias %K, ptr noalias %inp, ptr noalias %out) nounwind {{"
    lines = [*_lines("v", function, function.out), "ret void"]
    if function.acts is not None:
        lines = [
            *_lines("a", function, function.acts),
            "%acts = load double, ptr %out",
            "%some = fcmp ogt double %acts, 0.0",
            "br i1 %some, label %act, label %rest",
            "rest:",
            *_lines("r", function, ca.SX.zeros(function.out.numel())),
            "ret void",
            "act:",
            *lines,
        ]
    return "\n".join([head, *lines, "}"])


def _lines(letter: str, function: SymbolicFunction, out: ca.SX) -> list[str]:
    """The lines that compute and store `out`, in values whose names begin with this letter."""
    return _Writer(letter).written(straight_line(function._replace(out=out)))


class _Writer(Writer):
    """Values are numbered, since LLVM wants each of them to be assigned once."""

    patterns, language = PATTERNS, "machine code"

    def __init__(self, letter: str) -> None:
        """Names are the letter and a number, `count` of the last one."""
        super().__init__()
        self.letter, self.count = letter, 0

    def new(self, text: str, operands: tuple[str, ...]) -> str:
        """Write a line and give its value a new name."""
        return self._named(text, self.lines)

    def _named(self, text: str, lines: list[str]) -> str:
        """As `new`, into these lines."""
        self.count += 1
        name = f"%{self.letter}{self.count}"
        lines.append(f"{name} = {text}")
        return name

    def literal(self, x: float) -> str:
        """A double in LLVM's language with all its bits, so that no digits are lost."""
        return f"0x{struct.unpack('<Q', struct.pack('<d', float(x)))[0]:016X}"

    def read(self, block: int, index: int) -> str:
        """Value of an entry of K or inp."""
        at = self._named(
            f"getelementptr double, ptr {('%K', '%inp')[block]}, i64 {index}", self.lines
        )
        return self._named(f"load double, ptr {at}", self.lines)

    def store(self, index: int, value: str) -> None:
        """Write an entry of out."""
        at = self._named(f"getelementptr double, ptr %out, i64 {index}", self.stores)
        self.stores.append(f"store double {value}, ptr {at}")
