"""sin and cos of generated code: the same bits on each machine, whatever its C library is.

    k = x 2/pi, rounded to a whole number,   r = x - k P_1 - k P_2 - k P_3,   P_1 + P_2 + P_3 = pi/2
    z = r^2,   s = r + r z S(z),   c = 1 - z/2 + z^2 C(z)
    sin x is s, c, -s, -c and cos x is c, -s, -c, s for k = 0, 1, 2, 3 modulo 4

The reduction is that of W. J. Cody and W. Waite (Software manual for the elementary functions, 1980): P_1 and
P_2 have 33 bits, so that k times them is exact up to |x| of 1.6e6. S and C are the polynomials of fdlibm (Sun
Microsystems, 1993, k_sin.c and k_cos.c) on |r| <= pi/4. For |x| < 1000 the error is below 1.6 units in the
last place; beyond 1e15 the result has no meaning, and for an infinite x it is NaN. There are plain products and
sums alone, in one order: no branch, no table, and nothing that a compiler may fuse.
"""

import struct

TWO_OVER_PI = 6.36619772367581382433e-01
HALF_PI = (1.57079632673412561417e00, 6.07710050630396597660e-11, 2.02226624879595063154e-21)
"""pi/2 in three parts: P_1, P_2, P_3."""
TO_WHOLE = 1.5 * 2.0**52
"""Added and subtracted, it rounds a number to a whole one, whose last bits are those of the sum."""
OF_SIN = (
    -1.66666666666666324348e-01,
    8.33333333332248946124e-03,
    -1.98412698298579493134e-04,
    2.75573137070700676789e-06,
    -2.50507602534068634195e-08,
    1.58969099521155010221e-10,
)
"""Coefficients of S(z), of z^0 first."""
OF_COS = (
    4.16666666666666019037e-02,
    -1.38888888888741095749e-03,
    2.48015872894767294178e-05,
    -2.75573143513906633035e-07,
    2.08757232129817482790e-09,
    -1.13596475577881948265e-11,
)
"""Coefficients of C(z), of z^0 first."""


def number_text(x: float) -> str:
    """A float in LLVM's language, with all its bits."""
    return f"0x{struct.unpack('<Q', struct.pack('<d', x))[0]:016X}"


def pattern(quarters: int) -> str:
    """Pattern of `engine.ir` for sin(a), quarters = 0, or cos(a), quarters = 1, quarter turns ahead."""
    lines = list[str]()

    # append a line; return how a later line of a pattern names its value
    def new(text: str) -> str:
        lines.append(text)
        return f"{{{len(lines) - 1}}}"

    def of(operation: str, a: str, b: str | float) -> str:
        return new(f"{operation} double {a}, {b if isinstance(b, str) else number_text(b)}")

    # the polynomial in z, by Horner's rule
    def polynomial(coefficients: tuple[float, ...]) -> str:
        *rest, last = coefficients
        p = number_text(last)
        for x in reversed(rest):
            p = of("fadd", of("fmul", p, z), x)
        return p

    turned = of("fadd", of("fmul", "{a}", TWO_OVER_PI), TO_WHOLE)
    k, r = of("fsub", turned, TO_WHOLE), "{a}"
    for part in HALF_PI:
        r = of("fsub", r, of("fmul", k, part))
    z = of("fmul", r, r)
    s = of("fadd", r, of("fmul", of("fmul", r, z), polynomial(OF_SIN)))
    c = of("fsub", number_text(1.0), of("fmul", z, 0.5))
    c = of("fadd", c, of("fmul", of("fmul", z, z), polynomial(OF_COS)))
    # the last two bits of the sum are k modulo 4; the second one of k + `quarters` is the sign
    bits = new(f"bitcast double {turned} to i64")
    bits = new(f"add i64 {bits}, {quarters}")
    odd = new(f"trunc i64 {bits} to i1")
    value = new(f"select i1 {odd}, double {c}, double {s}")
    sign = new(f"and i64 {bits}, 2")
    sign = new(f"shl i64 {sign}, 62")
    value = new(f"bitcast double {value} to i64")
    value = new(f"xor i64 {value}, {sign}")
    new(f"bitcast i64 {value} to double")
    return "\n".join(lines)
