"""Straight-line code for D_s and Omega of one tree, written from its absolute angles a = A q.

With c_i, s_i the cosine and sine of a_i, C_ij = cos(a_j - a_i) = c_i c_j + s_i s_j and
S_ij = sin(a_j - a_i) = c_i s_j - s_i c_j,

    D_ij = Re W_ij C_ij - Im W_ij S_ij,   D_ii = Re W_ii + J_i
    Omega_i = -sum_j (Re W_ij S_ij + Im W_ij C_ij) a_j'^2 + g (Re w_i c_i - Im w_i s_i)

and D_s = A' D A + rotors, Omega_s = A' Omega. A belongs to the structure and is written into the text, as is
where Re and Im vanish; the numbers are arrays at run time.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations

from biped_adrc.model.planar import PlanarTree


def dynamics_source(tree: PlanarTree) -> str:
    """The text of `dynamics(K, q, v, D, Omega)`, which fills D (n, n) and Omega (n,)."""
    n = len(tree.mass)
    lines = ["def dynamics(K, q, v, D, Omega):"]
    lines += [line for i in range(n) for line in _angle(tree, i)]
    lines += [line for i, j in combinations(range(n), 2) for line in _pair(tree, i, j)]
    lines += [f"d{i}{i} = K.inertia[{i}]" for i in range(n)]
    lines += [_bias(tree, i) for i in range(n)]
    lines += [line for i in range(n) for line in _outputs(tree, i)]
    return "\n    ".join(lines) + "\n"


def _angle(tree: PlanarTree, i: int) -> Iterable[str]:
    row = tree.A[i]
    yield f"a{i} = " + _sum((x, f"q[{k}]") for k, x in enumerate(row))
    yield f"r{i} = (" + _sum((x, f"v[{k}]") for k, x in enumerate(row)) + ") ** 2"
    yield f"c{i}, s{i} = math.cos(a{i}), math.sin(a{i})"


def _pair(tree: PlanarTree, i: int, j: int) -> Iterable[str]:
    real, imaginary = tree.W.real[i, j] != 0.0, tree.W.imag[i, j] != 0.0
    yield f"C = c{i} * c{j} + s{i} * s{j}"
    yield f"S = c{i} * s{j} - s{i} * c{j}"
    yield f"d{i}{j} = " + _sum(
        ((real, f"K.W_re[{i}, {j}] * C"), (-float(imaginary), f"K.W_im[{i}, {j}] * S"))
    )
    yield f"h{i}{j} = " + _sum(
        ((real, f"K.W_re[{i}, {j}] * S"), (imaginary, f"K.W_im[{i}, {j}] * C"))
    )


def _bias(tree: PlanarTree, i: int) -> str:
    """h_ji = -h_ij for the real part and for the imaginary part, since W is Hermitian."""
    terms = [
        (-1.0, f"h{i}{j} * r{j}") if j > i else (1.0, f"h{j}{i} * r{j}")
        for j in range(len(tree.mass))
        if j != i
    ]
    real, imaginary = tree.w.real[i] != 0.0, tree.w.imag[i] != 0.0
    terms += [
        (float(real), f"K.gravity * K.w_re[{i}] * c{i}"),
        (-float(imaginary), f"K.gravity * K.w_im[{i}] * s{i}"),
    ]
    return f"o{i} = " + _sum(terms)


def _outputs(tree: PlanarTree, i: int) -> Iterable[str]:
    """Row i of A' D A, by the column D A first."""
    A, n = tree.A, len(tree.mass)
    for j in range(i, n):
        pairs: dict[str, float] = {}
        for k in range(n):
            for l in range(n):  # noqa: E741
                key = f"d{min(k, l)}{max(k, l)}"
                pairs[key] = pairs.get(key, 0.0) + A[k, i] * A[l, j]
        rotor = f" + K.rotor[{i}]" if i == j else ""
        yield f"D[{i}, {j}] = " + _sum((x, key) for key, x in pairs.items()) + rotor
        if i != j:
            yield f"D[{j}, {i}] = D[{i}, {j}]"
    yield f"Omega[{i}] = " + _sum((A[k, i], f"o{k}") for k in range(n))


def _sum(terms: Iterable[tuple[float, str]]) -> str:
    """x_1 t_1 + x_2 t_2 + ..., with factors 0 left out and 1 not written."""
    parts = []
    for x, term in terms:
        x = float(x)
        if x != 0.0:
            size = "" if abs(x) == 1.0 else f"{abs(x)!r} * "
            parts.append(f"{'-' if x < 0 else '+'} {size}{term}")
    text = " ".join(parts).removeprefix("+ ")
    return text or "0.0"
