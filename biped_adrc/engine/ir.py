"""The operations of a CasADi function, one after the other, written as text in any language.

CasADi lists the instructions of an expression in order, common subexpressions taken out; `straight_line` gives
each value a place of its own, its index in a list, and a language has a pattern for each operation (here and in
`extras.export.c_text`). Every language keeps the order of sums and products, and so computes the same numbers.

    pattern     one line, or several in a row
    {a} {b}     the operands;  {c} the third one, which only CHOICE has: b where a is not 0, else c
    {0} {1}     the values of the lines before it in the pattern

LLVM's language is here, for `void f(double* K, double* inp, double* out)` with the parameters K, the numbers
inp that change from call to call, and the results out: second stage of the compiler, between `engine.symbols`
and `engine.machine`. No operations are fused into multiply-adds, so that the numbers of a function do not
depend on what else is compiled with it.
"""

import struct
from collections.abc import Mapping
from typing import NamedTuple

import casadi as ca

from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.engine.not_compiled import NotCompiled

CHOICE = -1
"""Code of an operation that CasADi has not: b where a is not 0, else c."""
Patterns = Mapping[int, str]
"""Pattern by CasADi's code of the operation."""
OF_C: dict[int, str] = {
    getattr(ca, f"OP_{name.upper()}"): name
    for name in ["sin", "cos", "tan", "exp", "log", "sinh", "cosh", "tanh", "asin", "acos", "atan"]
} | {ca.OP_POW: "pow", ca.OP_CONSTPOW: "pow"}
"""Operations that are functions of the C library, by their names there."""


class Operation(NamedTuple):
    """One value of a function, or one of its outputs."""

    code: int
    """CasADi's code of the operation, or CHOICE."""
    of: tuple[int, ...]
    """Places of its operands, which are operations before it in the list. An input has here 0 for K or 1 for
    inp, and its index there; an output has the place of its value, and its own index in out."""
    number: float = 0.0
    """Value of a constant."""


def straight_line(function: SymbolicFunction) -> list[Operation]:
    """The operations of a function in order, each value computed once (CasADi's cse) and each input read once.

    Raises NotCompiled for an operation without a pattern.
    """
    f = ca.Function("f", [function.K, function.inp], ca.cse([function.out]))
    result, places = list[Operation](), dict[Operation, int]()
    # CasADi's registers -> the place of the value that each has now; CasADi uses a register for many values
    work = dict[int, int]()
    for i in range(f.n_instructions()):
        code, a, o = f.instruction_id(i), f.instruction_input(i), f.instruction_output(i)
        # a: numbers of registers, for an input its vector and index, which are taken as they are; o: register
        # of the result, for an output its vector and index
        of = tuple(a if code == ca.OP_INPUT else map(work.__getitem__, a))
        if code == ca.OP_ASSIGN:
            work[o[0]] = of[0]
        elif code == ca.OP_OUTPUT:
            result.append(Operation(code, (of[0], o[1])))
        elif code in _PATTERNS or code in (ca.OP_INPUT, ca.OP_CONST):
            number = f.instruction_constant(i) if code == ca.OP_CONST else 0.0
            # _choice: CHOICE for a sum that is one, in CasADi's form (b if a, else 0) + (c if not a, else 0)
            one = _choice(result, of) if code == ca.OP_ADD else Operation(code, of, number)
            # an equal operation before it has the same value, and its place serves for both
            work[o[0]] = places.setdefault(one, len(result))
            if work[o[0]] == len(result):
                result.append(one)
        else:
            raise NotCompiled(
                f"CasADi's operation {code} has no line of machine code; use NumPy's basic ones"
            )
    return result


def _choice(line: list[Operation], of: tuple[int, ...]) -> Operation:
    """The operation that adds the values at the two places `of` in the list `line`; a CHOICE where the sum is
    one.

    CasADi writes if_else(c, a, b) as the sum of "a if c, else 0" and "b if not c, else 0"; as one choice it
    costs less.
    """
    one, other = (line[k] for k in of)
    if one.code == other.code == ca.OP_IF_ELSE_ZERO:
        (condition, a), (against, b) = one.of, other.of
        if line[against] == Operation(ca.OP_NOT, (condition,)):
            return Operation(CHOICE, (condition, a, b))
    return Operation(ca.OP_ADD, of)


COMPARISONS = {ca.OP_LT: "olt", ca.OP_LE: "ole", ca.OP_EQ: "oeq", ca.OP_NE: "une"}
"""Comparisons by LLVM's conditions; a result is 0.0 or 1.0."""
CALLED = {ca.OP_FABS: "llvm.fabs.f64", ca.OP_SQRT: "llvm.sqrt.f64", ca.OP_FLOOR: "llvm.floor.f64"}
CALLED |= {ca.OP_FMIN: "llvm.minimum.f64", ca.OP_FMAX: "llvm.maximum.f64", **OF_C}
"""LLVM's intrinsics and the C library's functions; minimum and maximum pass NaN on."""
_OF_TWO = (ca.OP_FMIN, ca.OP_FMAX, ca.OP_POW, ca.OP_CONSTPOW)
"""Functions in CALLED that take two numbers; all others take one."""
_PATTERNS: Patterns = {
    ca.OP_ADD: "fadd double {a}, {b}",
    ca.OP_SUB: "fsub double {a}, {b}",
    ca.OP_MUL: "fmul double {a}, {b}",
    ca.OP_DIV: "fdiv double {a}, {b}",
    ca.OP_NEG: "fneg double {a}",
    ca.OP_TWICE: "fadd double {a}, {a}",
    ca.OP_SQ: "fmul double {a}, {a}",
    ca.OP_INV: "fdiv double 1.0, {a}",
    ca.OP_NOT: "fcmp oeq double {a}, 0.0\nuitofp i1 {0} to double",
    ca.OP_IF_ELSE_ZERO: "fcmp une double {a}, 0.0\nselect i1 {0}, double {b}, double 0.0",
    CHOICE: "fcmp une double {a}, 0.0\nselect i1 {0}, double {b}, double {c}",
    ca.OP_SIGN: (
        "fcmp ogt double {a}, 0.0\nfcmp olt double {a}, 0.0\n"
        "select i1 {1}, double -1.0, double 0.0\nselect i1 {0}, double 1.0, double {2}"
    ),
    **{
        code: f"fcmp {sign} double {{a}}, {{b}}\nuitofp i1 {{0}} to double"
        for code, sign in COMPARISONS.items()
    },
    **{
        code: f"call double @{name}(double {{a}}{', double {b}' if code in _OF_TWO else ''})"
        for code, name in CALLED.items()
    },
}
"""Lines of LLVM by operation."""
DECLARATIONS = "\n".join(
    f"declare double @{name}(double{', double' if code in _OF_TWO else ''}) nounwind readnone willreturn"
    for name, code in {name: code for code, name in CALLED.items()}.items()  # `pow` has two codes
)
"""Head of every module: the functions that its code may call, each declared once."""


def module_text(functions: dict[str, SymbolicFunction]) -> str:
    """The text of a module with these functions, each under its name. Raises NotCompiled for an operation that
    has no pattern here.
    """
    return "\n".join([DECLARATIONS, *(function_text(name, f) for name, f in functions.items())])


def function_text(name: str, function: SymbolicFunction) -> str:
    """The text of one function with the arguments K, inp, out, which do not overlap in memory.

    Where `function.acts` is an expression, the code computes it first, into out[0], and where it is not above 0
    writes zeros to out and returns.
    """
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
    """The lines of LLVM that compute the expressions `out` of a function's K and inp and store them in its out.

    Names of values are the letter and a number, since LLVM wants each name of a function to be assigned once;
    another block of the same function has another letter. Outputs are stored last, after all inputs are read.
    """
    # names: of the value of each operation so far; stores: the lines that write to out
    lines, stores, names, count = list[str](), list[str](), list[str](), 0

    # append a line that assigns `text` to a new name; return the name
    def new(text: str, into: list[str] = lines) -> str:
        nonlocal count
        count += 1
        into.append(f"%{letter}{count} = {text}")
        return f"%{letter}{count}"

    for code, of, number in straight_line(function._replace(out=out)):
        # of: for an input (0 for K or 1 for inp, index); for an output (place of its value, index in out)
        name = ""
        if code == ca.OP_CONST:  # with all its bits
            name = f"0x{struct.unpack('<Q', struct.pack('<d', number))[0]:016X}"
        elif code == ca.OP_INPUT:
            at = new(f"getelementptr double, ptr {('%K', '%inp')[of[0]]}, i64 {of[1]}")
            name = new(f"load double, ptr {at}")
        elif code == ca.OP_OUTPUT:
            at = new(f"getelementptr double, ptr %out, i64 {of[1]}", stores)
            stores.append(f"store double {names[of[0]]}, ptr {at}")
        else:
            operands, values = dict(zip("abc", (names[k] for k in of), strict=False)), list[str]()
            for text in _PATTERNS[code].splitlines():
                values.append(new(text.format(*values, **operands)))
            name = values[-1]
        names.append(name)
    return [*lines, *stores]
