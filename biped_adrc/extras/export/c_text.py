"""C99 text of a function without branches: one line of C for each of CasADi's instructions.

`engine.ir` goes through the same instructions for LLVM; here only the text of an operation differs.

Values are of the type `real`, double or float. The operations that decide the digits of a small difference are
in double whatever `real` is: differences of measured angles or times, such as q - q_d, and all operands they
are made of (`in_double`). So a robot with floats alone loses no digits where the errors are formed.

The text needs `real`, F(f) for the C library's function f of that type, LEAST and GREATEST, which pass
NaN on, and the table k of doubles.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import casadi as ca

from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.engine.ir import CHOICE, FUNCTIONS, Patterns, Writer, straight_line

PATTERNS: Patterns = {
    ca.OP_ADD: "{a} + {b}",
    ca.OP_SUB: "{a} - {b}",
    ca.OP_MUL: "{a} * {b}",
    ca.OP_DIV: "{a} / {b}",
    ca.OP_NEG: "-{a}",
    ca.OP_TWICE: "{a} + {a}",
    ca.OP_SQ: "{a} * {a}",
    ca.OP_INV: "1 / {a}",
    ca.OP_LT: "{a} < {b}",
    ca.OP_LE: "{a} <= {b}",
    ca.OP_EQ: "{a} == {b}",
    ca.OP_NE: "{a} != {b}",
    ca.OP_NOT: "{a} == 0",
    ca.OP_IF_ELSE_ZERO: "{a} != 0 ? {b} : 0",
    CHOICE: "{a} != 0 ? {b} : {c}",
    ca.OP_SIGN: "({a} > 0) - ({a} < 0)",
    ca.OP_FMIN: "LEAST({a}, {b})",
    ca.OP_FMAX: "GREATEST({a}, {b})",
    ca.OP_FABS: "{F}(fabs)({a})",
    ca.OP_SQRT: "{F}(sqrt)({a})",
    ca.OP_FLOOR: "{F}(floor)({a})",
    **{
        code: f"{{F}}({name})({{a}}, {{b}})" if name == "pow" else f"{{F}}({name})({{a}})"
        for code, name in FUNCTIONS.items()
    },
}
"""Expression in C of each operation; {a}, {b}, {c} are its operands, and {F} is empty in double."""


@dataclass(frozen=True)
class Entry:
    """A number that a C function reads: its name in C, and whether it is a double whatever `real` is."""

    name: str
    double: bool = False


@dataclass(frozen=True)
class CFunction:
    """A function to write in C: its expression, and the names in C of its inputs and outputs."""

    function: SymbolicFunction
    inputs: Sequence[Entry]
    outputs: Sequence[str]


@dataclass(frozen=True)
class Written:
    """The lines of a function in C, and how many operations they have."""

    lines: tuple[str, ...]
    operations: int
    """Number of arithmetic operations and calls, one for each line that is no copy."""
    doubles: int
    """Number of these that are in double whatever `real` is."""


def used_numbers(functions: Sequence[CFunction]) -> list[int]:
    """Indices, in increasing order, of the parameters K that any of these functions reads."""
    result: set[int] = set()
    for each in functions:
        f = straight_line(each.function)
        for i in range(f.n_instructions()):
            a = f.instruction_input(i)
            if f.instruction_id(i) == ca.OP_INPUT and a[0] == 0:
                result.add(a[1])
    return sorted(result)


def c_text(each: CFunction, numbers: Sequence[int]) -> Written:
    """Write a function in C; its parameters K are read from the table k, which holds
    the entries `numbers` of K.

    Raises InputError for an operation that has no line here.
    """
    f = straight_line(each.function)
    K = {place: Entry(f"k[{i}]", double=True) for i, place in enumerate(numbers)}
    writer = _Writer(each, K, in_double(f, [entry.double for entry in each.inputs]))
    lines = writer.written(f)
    count = len(writer.needed)
    return Written(tuple(lines), count, sum(name.startswith("w") for name in writer.needed))


def in_double(f: ca.Function, angles: Sequence[bool]) -> set[int]:
    """Indices of the instructions of f that have to be computed in double.

    They are the differences one side of which is a linear combination of angles or times, where the other side
    depends on angles, times and constants alone, with all instructions they are made of. angles: for each
    input whether it is an angle or a time.
    """
    made: dict[int, int] = {}
    sources: dict[int, list[int]] = {}
    degree: dict[int, int] = {}
    open_names: list[int] = []
    for i in range(f.n_instructions()):
        code, a = f.instruction_id(i), f.instruction_input(i)
        if code == ca.OP_OUTPUT:
            continue
        leaf = code in (ca.OP_CONST, ca.OP_INPUT)
        sources[i] = [] if leaf else [made[x] for x in a]
        of = [degree[x] for x in sources[i]]
        if leaf:
            given = code == ca.OP_INPUT and a[0] == 1
            degree[i] = (LINEAR if angles[a[1]] else UNKNOWN) if given else CONSTANT
        else:
            degree[i] = _degree(code, of)
        if code == ca.OP_SUB and LINEAR in of and UNKNOWN not in of:
            open_names.append(i)
        made[f.instruction_output(i)[0]] = i
    result: set[int] = set()
    while open_names:
        i = open_names.pop()
        if i not in result:
            result.add(i)
            open_names.extend(sources[i])
    return {i for i in result if sources[i]}


CONSTANT, LINEAR, KNOWN, UNKNOWN = range(4)
"""Dependence of a value: on constants; linear in angles and times; any function of these; on other inputs."""


def _degree(code: int, of: list[int]) -> int:
    """Dependence (CONSTANT to UNKNOWN) of an operation's value, from those of its operands."""
    most = max(of)
    if most != LINEAR:
        return most
    if code in (ca.OP_ADD, ca.OP_SUB, ca.OP_NEG, ca.OP_TWICE, ca.OP_ASSIGN):
        return LINEAR
    return LINEAR if code == ca.OP_MUL and CONSTANT in of else KNOWN


class _Writer(Writer):
    """Writer of C: values in double are called w1, w2, .., others v1, v2, ..; values that
    nothing reads are left out.
    """

    patterns, language = PATTERNS, "C"

    def __init__(self, each: CFunction, K: dict[int, Entry], wide: set[int]) -> None:
        super().__init__()
        self.each, self.K, self.wide = each, K, wide
        self.now = -1
        self.double: set[str] = set()
        """Names of values that are doubles."""
        self.made: dict[str, tuple[str, tuple[str, ...]]] = {}
        """By name, the line of a value and the names that it reads."""
        self.stored: list[str] = []
        self.needed: set[str] = set()

    def written(self, f: ca.Function) -> list[str]:
        """Lines of the function f, without those of values that no output needs."""
        super().written(f)
        self.needed, open_names = set(), list(self.stored)
        while open_names:
            name = open_names.pop()
            if name in self.made and name not in self.needed:
                self.needed.add(name)
                open_names.extend(self.made[name][1])
        kept = [line for name, (line, _) in self.made.items() if name in self.needed]
        return [*kept, *self.stores]

    def instruction(self, f: ca.Function, i: int) -> None:
        """Write instruction i of f, as in every language, and note its index for `line` and `new`."""
        self.now = i
        super().instruction(f, i)

    def literal(self, x: float) -> str:
        """A constant as the shortest decimals that give the same bits."""
        name = decimal(x)
        self.double.add(name)
        return name

    def read(self, block: int, index: int) -> str:
        """Name in C of an input: entry `index` of K (block 0) or of the inputs (block 1)."""
        entry = self.each.inputs[index] if block else self.K[index]
        if entry.double:
            self.double.add(entry.name)
        return entry.name

    def store(self, index: int, value: str) -> None:
        """Assign a value to output `index`."""
        self.stores.append(f"{self.each.outputs[index]} = {self.cast(value)};")
        self.stored.append(value)

    def cast(self, name: str) -> str:
        """The value as an operand of type `real`."""
        return f"(real){name}" if name in self.double else name

    def line(self, code: int, a: tuple[str, ...]) -> str:
        """Write an operation, with operands of the type in which it is computed;
        returns the name of its value.
        """
        pattern = self.patterns.get(code)
        if not isinstance(pattern, str):
            return super().line(code, a)
        wide = self.now in self.wide
        shown = a if wide else tuple(map(self.cast, a))
        text = pattern.format(**dict(zip("abc", shown, strict=False)), F="" if wide else "F")
        return self.new(text, a)

    def new(self, text: str, operands: tuple[str, ...]) -> str:
        """Write a constant of C with this expression; returns its name. operands: names
        that the expression reads.
        """
        wide = self.now in self.wide
        name = f"{'w' if wide else 'v'}{len(self.made) + 1}"
        if wide:
            self.double.add(name)
        self.made[name] = f"const {'double' if wide else 'real'} {name} = {text};", operands
        return name


def decimal(x: float) -> str:
    """Text in C of a double: the shortest decimals that are read back as the same bits."""
    if math.isinf(x):
        return "HUGE_VAL" if x > 0.0 else "(-HUGE_VAL)"
    return repr(float(x)) if math.copysign(1.0, x) > 0.0 else f"({float(x)!r})"
