"""C99 text of a function without branches: one line of C for each of CasADi's instructions.

`engine.ir` goes through the same instructions for LLVM; here only the text of an operation differs.

Values are of the type `real`, which is double or float. Differences of measured angles or times, such as
an error of tracking, and all values from which they are computed, are in double in either case (`in_double`),
as floats would lose the digits of a small difference.

A function is a list of CasADi's operations (`Operation`); an operation is known by its place in the list, and
so is its value. Its field `of` has

    the places of its operands        of most operations
    (0, index in K) or (1, index)     of an input: a parameter of the vector K, or one of the inputs
    (place of its value, index)       of an output: where in the list its value is, and where it is written

The text needs from the C file around it: `real`, F(f) for the C library's function f of that type, sine(x, 0)
and sine(x, 1) for sin and cos, LEAST and GREATEST, which pass NaN on, and the table k of those parameters K
that are read, as constants in double.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import casadi as ca

from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.engine.ir import CHOICE, OF_C, Operation, Patterns, straight_line

_PATTERNS: Patterns = {
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
    ca.OP_SIN: "{F}(sine)({a}, 0)",
    ca.OP_COS: "{F}(sine)({a}, 1)",
    **{
        code: f"{{F}}({name})({{a}}, {{b}})" if name == "pow" else f"{{F}}({name})({{a}})"
        for code, name in OF_C.items()
    },
}
"""Expression in C of each operation; {a}, {b}, {c} are its operands, and {F} is empty in double."""


class Entry(NamedTuple):
    """A number in a C function: its name or constant in C, and whether it is a double even if `real` is not."""

    name: str
    double: bool = False

    @property
    def real(self) -> str:
        """Text of the number as an operand of type `real`, with a cast where it is a double."""
        return f"(real){self.name}" if self.double else self.name


class CFunction(NamedTuple):
    """A function to write in C: its expression, and the names in C of its inputs and outputs."""

    function: SymbolicFunction
    inputs: Sequence[Entry]
    outputs: Sequence[str]


class Written(NamedTuple):
    """The lines of C in the body of a function, and how many operations they have."""

    lines: tuple[str, ...]
    operations: int
    """Number of arithmetic operations and calls, one for each line that is no copy."""
    doubles: int
    """Number of these operations that are in double also if `real` is float."""


def read_by(function: SymbolicFunction, which: int) -> set[int]:
    """Indices of the parameters K (which = 0) or of the inputs (which = 1) that a function reads."""
    # of an input: (which, index)
    return {x.of[1] for x in straight_line(function) if x.code == ca.OP_INPUT and x.of[0] == which}


def c_text(each: CFunction, numbers: Sequence[int]) -> Written:
    """Write the body of a function in C. Its parameters K are read from the table k in C, whose entry i is
    entry numbers[i] of K. each: the function, with the names in C of its inputs and outputs.

    Values in double are called w1, w2, .., others v1, v2, ..; values that nothing reads are left out. Raises
    InputError for an operation that has no line here.
    """
    # line: the operations in order; places: index in K -> index in the table k. A constant and an entry of k
    # are doubles in C. An output has an empty value, which only keeps the places right: nothing reads it
    line, places = straight_line(each.function), {k: i for i, k in enumerate(numbers)}
    doubles = in_double(line, [entry.double for entry in each.inputs])
    values, stores, texts = list[Entry](), list[str](), dict[int, str]()
    for i, (code, of, number) in enumerate(line):
        value = Entry("")
        if code == ca.OP_CONST:
            value = Entry(decimal(number), double=True)
        elif code == ca.OP_INPUT:
            value = each.inputs[of[1]] if of[0] else Entry(f"k[{places[of[1]]}]", double=True)
        elif code == ca.OP_OUTPUT:
            stores.append(f"{each.outputs[of[1]]} = {values[of[0]].real};")
        else:
            wide = i in doubles
            operands = (values[k].name if wide else values[k].real for k in of)
            named = dict(zip("abc", operands, strict=False))  # one to three operands
            # _PATTERNS: expression in C of each operation
            text = _PATTERNS[code].format(**named, F="" if wide else "F")
            value = Entry(f"{'w' if wide else 'v'}{len(texts) + 1}", wide)
            texts[i] = f"const {'double' if wide else 'real'} {value.name} = {text};"
        values.append(value)
    # a value is written only if an output needs it
    needed = ancestors(line, {x.of[0] for x in line if x.code == ca.OP_OUTPUT}) & texts.keys()
    kept = (text for i, text in texts.items() if i in needed)
    return Written((*kept, *stores), len(needed), len(needed & doubles))


def ancestors(line: Sequence[Operation], places: set[int]) -> set[int]:
    """The places in `line` of these values, and of all values from which they are computed."""
    result = set(places)
    for i in reversed(range(len(line))):
        if i in result and line[i].code != ca.OP_INPUT:
            result.update(line[i].of)
    return result


def in_double(line: Sequence[Operation], angles: Sequence[bool]) -> set[int]:
    """Places in `line` of the values that have to be computed in double, without inputs and constants.

    They are differences, and the values from which these are computed: one side is a linear combination of
    angles and times, and the other side depends on angles, times and constants alone. angles: for each input
    whether it is an angle or a time.
    """
    # kinds: of each value CONSTANT, LINEAR in angles and times, KNOWN (any other function of these), or UNKNOWN
    # (it depends on other inputs too); a parameter of K is a constant
    kinds, differences = list[int](), set[int]()
    for i, (code, of, _) in enumerate(line):
        if code == ca.OP_INPUT:
            kinds.append((LINEAR if angles[of[1]] else UNKNOWN) if of[0] else CONSTANT)
        elif code in (ca.OP_CONST, ca.OP_OUTPUT):
            # nothing reads an output, so its entry only keeps the places right
            kinds.append(CONSTANT)
        else:
            sides = [kinds[k] for k in of]
            kinds.append(_degree(code, sides))
            if code == ca.OP_SUB and LINEAR in sides and UNKNOWN not in sides:
                differences.add(i)
    known = ca.OP_INPUT, ca.OP_CONST
    return {i for i in ancestors(line, differences) if line[i].code not in known}


CONSTANT, LINEAR, KNOWN, UNKNOWN = range(4)
"""Degrees of dependence of a value: on constants alone; linear in angles and times; any function of these; on
other inputs too. A value has at least the greatest one of its operands."""


def _degree(code: int, of: list[int]) -> int:
    """Degree of dependence of an operation's value on angles and times, from those of its operands, `of`:
    CONSTANT < LINEAR < KNOWN (any other function of these) < UNKNOWN (of other inputs too). code: CasADi's.
    """
    most = max(of)
    if most != LINEAR:
        return most
    # a sum of linear values is linear, and so is a product with a constant; any other function is KNOWN
    if code in (ca.OP_ADD, ca.OP_SUB, ca.OP_NEG, ca.OP_TWICE):
        return LINEAR
    return LINEAR if code == ca.OP_MUL and CONSTANT in of else KNOWN


def decimal(x: float) -> str:
    """Text in C of a double: the shortest decimals that are read back as the same bits, a negative one in
    parentheses; HUGE_VAL for infinity.
    """
    text = "HUGE_VAL" if math.isinf(x) else repr(abs(float(x)))
    return text if math.copysign(1.0, x) > 0.0 else f"(-{text})"
