"""Single-line faults that cosmic-ray's operators make of a file: where, and what becomes of the line."""

from __future__ import annotations

import ast
import re
from collections import defaultdict


def places(source: str) -> dict[int, list[tuple[str, int]]]:
    """Where cosmic-ray could change a file: line (from 1) to operators with their occurrence."""
    from cosmic_ray.ast import ast_nodes, get_ast
    from cosmic_ray.plugins import get_operator, operator_names

    nodes, found = list(ast_nodes(get_ast(source))), defaultdict(list)
    for name in filter(_sensible, operator_names()):
        operator = get_operator(name)()
        positions = [at for node in nodes for at in operator.mutation_positions(node)]
        for k, ((line, _), _) in enumerate(positions):
            found[line].append((name, k))
    return found


def changed_line(source: str, name: str, k: int) -> tuple[int, str, str] | None:
    """The one line (from 1) that an operator changes, before and after; None where nothing that runs does."""
    from cosmic_ray.mutating import mutate_code
    from cosmic_ray.plugins import get_operator

    after = mutate_code(source, get_operator(name)(), k) or ""
    pairs = list(zip(source.splitlines(), after.splitlines(), strict=False))
    differ = [i for i, (a, b) in enumerate(pairs) if a != b]
    if (
        len(differ) != 1
        or len(pairs) != len(source.splitlines())
        or len(pairs) != len(after.splitlines())
    ):
        return None
    if _meaning(after) in (_meaning(source), None):
        return None
    return differ[0] + 1, *pairs[differ[0]]


def _sensible(name: str) -> bool:
    """Whether an operator can go unnoticed: a shift of numbers or `is` for `==` is no fault of its kind."""
    bits = r"(LShift|RShift|BitOr|BitAnd|BitXor)"
    if "Variable" in name or re.search(r"(UAdd|Invert|_Not)$", name):
        return False  # needs arguments; no number
    pair = re.search(r"Operator_(\w+)_(\w+)$", name)
    if pair is None or "Unary" in name:
        return True
    return all(
        bool(re.fullmatch(kind, pair[1])) == bool(re.fullmatch(kind, pair[2]))
        for kind in (bits, "Is|IsNot", "Eq|NotEq|Lt|LtE|Gt|GtE|Is|IsNot")
    )


def _meaning(source: str) -> str | None:
    """The file's syntax tree without docstrings and annotations, which nothing evaluates; None: no Python."""
    try:
        tree = ast.parse(source)
    except SyntaxError:
        return None
    for node in ast.walk(tree):
        if isinstance(node, ast.arg):
            node.annotation = None
        elif isinstance(node, ast.FunctionDef):
            node.returns = None
        elif isinstance(node, ast.AnnAssign):
            node.annotation = ast.Constant(None)
    return ast.dump(tree)
