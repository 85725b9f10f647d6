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

import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import NamedTuple

import casadi as ca

from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.sine import number_text, pattern

CHOICE = -1
"""Code of an operation that CasADi has not: b where a is not 0, else c."""
Patterns = Mapping[int, str]
"""Pattern by CasADi's code of the operation."""
OF_C: dict[int, str] = {
    getattr(ca, f"OP_{name.upper()}"): name
    for name in ["tan", "exp", "log", "sinh", "cosh", "tanh", "asin", "acos", "atan"]
} | {ca.OP_POW: "pow", ca.OP_CONSTPOW: "pow"}
"""Operations that are functions of the C library, by their names there; sin and cos are in `engine.sine`."""


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
            raise NotCompiled(f"CasADi's operation {code} is not compiled; use NumPy's basic ones")
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
    ca.OP_SIN: pattern(0),
    ca.OP_COS: pattern(1),
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


def declarations(lanes: int = 1) -> str:
    """Head of every module: the functions that its code may call, each declared once; for several lanes those
    of LLVM for them, too."""
    lines = list[str]()
    for name, code in {name: code for code, name in CALLED.items()}.items():  # `pow` has two codes
        double = f"double @{name}(double{', double' if code in _OF_TWO else ''})"
        kinds = (double, wide(double, lanes)) if lanes > 1 and name[:5] == "llvm." else (double,)
        lines += [f"declare {x} nounwind readnone willreturn" for x in kinds]
    if lanes > 1:
        lines.append(f"declare i1 @llvm.vector.reduce.or.v{lanes}i1(<{lanes} x i1>)")
    return "\n".join(lines)


def module_text(functions: dict[str, SymbolicFunction], lanes: int = 1) -> str:
    """The text of a module with these functions, each under its name. Raises NotCompiled for an operation that
    has no pattern here.
    """
    texts = (function_text(name, f, lanes) for name, f in functions.items())
    return "\n".join([declarations(lanes), *texts])


def function_text(name: str, function: SymbolicFunction, lanes: int = 1) -> str:
    """The text of one function with the arguments K, inp, out, which do not overlap in memory.

    lanes: number of walks that it serves in one call. Each place of K, inp and out then has so many numbers,
    one of each walk. Where `function.acts` is an expression, the code computes it first, and where it is not
    above 0, for no walk of several, writes zeros to out and returns.
    """
    first, zeros, all_of = (Listing(letter, lanes) for letter in "arv")
    results = all_of.values(function, all_of.of_memory)
    if function.acts is None:
        all_of.store_all("%out", results)
        return defined(name, [*all_of.lines, "ret void"])
    (acts,) = first.values(function._replace(out=function.acts), first.of_memory)
    some = first.new(f"fcmp ogt double {acts}, 0.0")
    # of several walks one may act and another not, whose results are zeros then
    if lanes > 1:
        results = [all_of.new(f"select i1 {some}, double {x}, double 0.0") for x in results]
        one = f"%any = call i1 @llvm.vector.reduce.or.v{lanes}i1(<{lanes} x i1> {some})"
        some = "%any"
        first.lines.append(one)
    zeros.store_all("%out", ["0.0"] * len(results))
    all_of.store_all("%out", results)
    head = [*first.lines, f"br i1 {some}, label %act, label %rest"]
    rest, act = ["rest:", *zeros.lines, "ret void"], ["act:", *all_of.lines, "ret void"]
    return defined(name, [*head, *rest, *act])


def defined(name: str, lines: Sequence[str]) -> str:
    """The text of the function `name` with the arguments K, inp, out and these lines."""
    head = f"define void @{name}(ptr noalias %K, ptr noalias %inp, ptr noalias %out) nounwind {{"
    return "\n".join([head, *lines, "}"])


_LITERAL = re.compile(r"(?<=[ ,(])(-?\d+\.\d+|0x[0-9A-F]{16}|\d+)(?=,|$|\))")
"""A number in a line of LLVM."""


def wide(line: str, lanes: int) -> str:
    """A line of LLVM for one number, as a line for so many side by side."""
    if lanes == 1:
        return line
    kind = "i64" if "i64" in line and not line.startswith("bitcast") else "double"
    line = re.sub(r"\b(double|i1|i64)\b", rf"<{lanes} x \1>", line).replace(".f64", f".v{lanes}f64")
    return _LITERAL.sub(rf"splat ({kind} \1)", line)


class Listing:
    """Lines of LLVM, written one after the other, for so many walks side by side (`lanes`).

    Names of values are the letter and a number, since LLVM wants each name of a function to be assigned once;
    another block of the same function has another letter.
    """

    def __init__(self, letter: str, lanes: int = 1):
        self.letter, self.lanes, self.lines, self._count = letter, lanes, list[str](), 0

    def raw(self, text: str) -> str:
        """Append a line that assigns `text`, as it is, to a new name; return the name."""
        self._count += 1
        self.lines.append(f"%{self.letter}{self._count} = {text}")
        return f"%{self.letter}{self._count}"

    def new(self, text: str) -> str:
        """Append a line for one number, widened to all lanes, that assigns `text` to a new name; return the
        name."""
        called = re.match(r"call double @(?!llvm)", text)
        return self._each(text) if called and self.lanes > 1 else self.raw(wide(text, self.lanes))

    def _each(self, text: str) -> str:
        """Append a call of a function of the C library for each lane by itself."""
        kind, result = f"<{self.lanes} x double>", "poison"
        for i in range(self.lanes):
            one = re.sub(r"%\w+", partial(self._of_lane, i), text)
            result = self.raw(f"insertelement {kind} {result}, double {self.raw(one)}, i64 {i}")
        return result

    def _of_lane(self, i: int, name: re.Match[str]) -> str:
        """Append the number of lane i of a value; return its name."""
        return self.raw(f"extractelement <{self.lanes} x double> {name[0]}, i64 {i}")

    def at(self, base: str, i: int) -> str:
        """Append the address of place i of the vector `base`."""
        return self.raw(f"getelementptr double, ptr {base}, i64 {i * self.lanes}")

    def load(self, base: str, i: int) -> str:
        """Append the load of place i of the vector at the address `base`; return its name."""
        return self.raw(f"load {wide('double', self.lanes)}, ptr {self.at(base, i)}, align 8")

    def of_memory(self, which: int, i: int) -> str:
        """Append the load of input i, of K (which = 0) or of inp (1)."""
        return self.load(("%K", "%inp")[which], i)

    def store_all(self, base: str, values: Sequence[str], first: int = 0) -> None:
        """Append stores of these values at the address `base`, from place `first` on."""
        for i, x in enumerate(values, first):
            typed = wide(f"double {x}", self.lanes)
            self.lines.append(f"store {typed}, ptr {self.at(base, i)}, align 8")

    def values(self, function: SymbolicFunction, of_input: Callable[[int, int], str]) -> list[str]:
        """Append the lines that compute a function; return the names of its outputs.

        of_input: gives the name of an input, by 0 for K or 1 for inp and its index; it is called once for each.
        """
        names, out = list[str](), dict[int, str]()  # names: of the value of each operation so far
        for code, of, number in straight_line(function):
            # of: for an input (0 for K or 1 for inp, index); for an output (place of its value, index in out)
            name = ""
            if code == ca.OP_CONST:
                name = number_text(number)
            elif code == ca.OP_INPUT:
                name = of_input(*of)
            elif code == ca.OP_OUTPUT:
                out[of[1]] = names[of[0]]
            else:
                values = list[str]()
                operands = dict(zip("abc", (names[k] for k in of), strict=False))
                for text in _PATTERNS[code].splitlines():
                    values.append(self.new(text.format(*values, **operands)))
                name = values[-1]
            names.append(name)
        return [out[i] for i in range(len(out))]
