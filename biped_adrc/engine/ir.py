"""LLVM's language for a straight-line function: `void f(double* K, double* inp, double* out)`.

Second stage of the compiler, between `engine.symbols` and `engine.machine`: the table by which
`engine.instructions` writes. No operations are fused into multiply-adds, so the numbers are the
same whatever function is compiled beside.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Hashable, Mapping, Sequence

import casadi as ca

from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.engine.instructions import CHOICE, FUNCTIONS, Patterns, Writer, straight_line
from biped_adrc.engine.machine import LoadedCode, ModuleText, load_or_compile
from biped_adrc.engine.structure import Unchanged, reaching
from biped_adrc.engine.symbols import Untraceable

COMPARISONS = {ca.OP_LT: "olt", ca.OP_LE: "ole", ca.OP_EQ: "oeq", ca.OP_NE: "une"}
"""Comparisons by LLVM's conditions; a result is 0.0 or 1.0."""
ONE = {ca.OP_FABS: "llvm.fabs.f64", ca.OP_SQRT: "llvm.sqrt.f64", ca.OP_FLOOR: "llvm.floor.f64"}
"""Calls of functions of one number: LLVM's intrinsics, or the C library's."""
ONE |= {code: name for code, name in FUNCTIONS.items() if name != "pow"}
TWO = {ca.OP_FMIN: "llvm.minimum.f64", ca.OP_FMAX: "llvm.maximum.f64"}
"""Calls of functions of two numbers; minimum and maximum pass NaN on."""
TWO |= {code: name for code, name in FUNCTIONS.items() if name == "pow"}
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
    **{code: f"call double @{name}(double {{a}})" for code, name in ONE.items()},
    **{code: f"call double @{name}(double {{a}}, double {{b}})" for code, name in TWO.items()},
}
"""Lines of LLVM by operation."""
DECLARATIONS = "\n".join(
    [f"declare double @{name}(double) #0" for name in ONE.values()]
    + [f"declare double @{name}(double, double) #0" for name in dict.fromkeys(TWO.values())]
    + ["attributes #0 = { nounwind readnone willreturn }"]
)
"""Head of every module."""


def generated(
    key: Hashable, functions: Mapping[str, Callable[[], SymbolicFunction]], vectors: bool = False
) -> LoadedCode:
    """These functions in memory, by name; traced once per process and structure.

    - key: the structure of what they are made from (`engine.structure`).
    - functions: by name, each to be called for its expression.
    - vectors: as of `ModuleText`.
    """

    def text() -> ModuleText:
        return ModuleText(module_text({name: f() for name, f in functions.items()}), vectors)

    return in_memory((key, vectors), list(functions), text)


_IN_MEMORY: dict[Hashable, tuple[LoadedCode | str, list[Unchanged]]] = {}
"""Code by structure, or why there is none, with what it reached; a function is a value, so this is no state."""


def in_memory(key: Hashable, names: Sequence[str], text: Callable[[], ModuleText]) -> LoadedCode:
    """The functions `names` of a module; its text is asked for where this structure is not in memory.

    Raises Untraceable, each time without tracing anew.
    """
    code, reached = _IN_MEMORY.get(key, (None, []))
    if code is None or not all(unchanged() for unchanged in reached):
        with reaching() as reached:
            try:
                code = load_or_compile(text(), names)
            except Untraceable as error:
                code = str(error)
        _IN_MEMORY[key] = code, reached
    if isinstance(code, str):
        raise Untraceable(code)
    return code


def module_text(functions: dict[str, SymbolicFunction]) -> str:
    """A module of functions, by name. Raises InputError for an operation that has no line here."""
    return "\n".join([DECLARATIONS, *(function_text(name, f) for name, f in functions.items())])


def function_text(name: str, function: SymbolicFunction) -> str:
    """The text of one function with arguments K, inp, out, which do not overlap."""
    head = f"define void @{name}(ptr noalias %K, ptr noalias %inp, ptr noalias %out) nounwind {{"
    return "\n".join([head, *_Writer().written(straight_line(function)), "ret void", "}"])


class _Writer(Writer):
    """Values are numbered, since LLVM wants each of them to be assigned once."""

    patterns, language = PATTERNS, "machine code"

    def __init__(self) -> None:
        """`count` numbers the values."""
        super().__init__()
        self.count = 0

    def new(self, text: str, operands: tuple[str, ...]) -> str:
        """Write a line and give its value a new name."""
        return self._named(text, self.lines)

    def _named(self, text: str, lines: list[str]) -> str:
        """As `new`, into these lines."""
        self.count += 1
        lines.append(f"%v{self.count} = {text}")
        return f"%v{self.count}"

    def literal(self, x: float) -> str:
        """A double in LLVM's language."""
        return literal(x)

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


def literal(x: float) -> str:
    """A double in LLVM's language with all its bits, so that no digits are lost."""
    return f"0x{struct.unpack('<Q', struct.pack('<d', float(x)))[0]:016X}"
