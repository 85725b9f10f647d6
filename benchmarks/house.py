"""The shape of the code in numbers: lines by folder, modules, functions, and places where a type decides.

    python benchmarks/house.py [FOLDER ...]

Lines of code are those that are not blank, no comment and no docstring. A place where a type decides is
`type(x) is`, `type(x) in`, `type(x).name is` or `isinstance` of a class of this package outside of its errors.
"""

from __future__ import annotations

import ast
import io
import statistics
import sys
import tokenize
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
Function = ast.FunctionDef | ast.AsyncFunctionDef


class Counted(NamedTuple):
    """Of one module: lines of code, lines of docstrings, lengths of its functions, and deciding types."""

    code: int
    docstrings: int
    functions: tuple[int, ...]
    deciding: tuple[int, ...]
    """Numbers of the lines."""


def docstring_lines(tree: ast.Module) -> set[int]:
    """Numbers of the lines that docstrings and other bare texts take."""
    return {
        line
        for node in ast.walk(tree)
        if isinstance(node, ast.Expr)
        and isinstance(node.value, ast.Constant)
        and isinstance(node.value.value, str)
        for line in range(node.lineno, (node.end_lineno or node.lineno) + 1)
    }


def code_lines(text: str) -> set[int]:
    """Numbers of the lines with a token that is neither a comment nor the end of a line."""
    idle = (tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT)
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    return {
        line
        for token in tokens
        if token.type not in (*idle, tokenize.ENDMARKER)
        for line in range(token.start[0], token.end[0] + 1)
    }


def deciding(tree: ast.Module, own: frozenset[str]) -> Iterator[int]:
    """Lines where what is done depends on which class of this package something is of."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare) and isinstance(
            node.ops[0], ast.Is | ast.IsNot | ast.In | ast.NotIn
        ):
            called = [x for x in ast.walk(node.left) if isinstance(x, ast.Call)]
            if any(isinstance(x.func, ast.Name) and x.func.id == "type" for x in called):
                yield node.lineno
        if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Name)):
            continue
        if node.func.id == "isinstance" and len(node.args) == 2:
            named = {x.id for x in ast.walk(node.args[1]) if isinstance(x, ast.Name)}
            if named & own:
                yield node.lineno


def counted(path: Path, own: frozenset[str]) -> Counted:
    """The numbers of one module."""
    text = path.read_text(encoding="utf-8")
    tree = ast.parse(text)
    texts = docstring_lines(tree)
    functions = [x for x in ast.walk(tree) if isinstance(x, Function)]
    lengths = tuple((x.end_lineno or x.lineno) - x.lineno + 1 for x in functions)
    return Counted(
        len(code_lines(text) - texts), len(texts), lengths, tuple(sorted(deciding(tree, own)))
    )


def classes(paths: list[Path]) -> frozenset[str]:
    """Names of the classes of these modules, but for errors."""
    trees = (ast.parse(path.read_text(encoding="utf-8")) for path in paths)
    found = (x.name for tree in trees for x in ast.walk(tree) if isinstance(x, ast.ClassDef))
    return frozenset(name for name in found if not name.endswith("Error"))


def main(folders: list[str]) -> None:
    """Print the table of these folders, the package by default."""
    roots = [Path(folder).resolve() for folder in folders] or [ROOT / "biped_adrc"]
    paths = sorted(path for root in roots for path in root.rglob("*.py"))
    own = classes(paths)
    found = {path: counted(path, own) for path in paths}
    base = roots[0].parent if len(roots) == 1 else ROOT
    print(f"{'folder':32} {'modules':>7} {'code':>6} {'docs':>6} {'deciding':>8}")
    for folder in sorted({path.parent for path in paths}):
        parts = [x for path, x in found.items() if path.parent == folder]
        code, docs = sum(x.code for x in parts), sum(x.docstrings for x in parts)
        types = sum(len(x.deciding) for x in parts)
        print(f"{folder.relative_to(base)!s:32} {len(parts):7} {code:6} {docs:6} {types:8}")
    every = list(found.values())
    lengths = [n for x in every for n in x.functions]
    modules = [x.code for x in every]
    print(
        f"{'all':32} {len(every):7} {sum(modules):6} {sum(x.docstrings for x in every):6} "
        f"{sum(len(x.deciding) for x in every):8}"
    )
    print(
        f"code lines of a module: median {statistics.median(modules):g}, most {max(modules)}; functions: "
        f"{len(lengths)}, lines median {statistics.median(lengths):g}, most {max(lengths)}"
    )


if __name__ == "__main__":
    main(sys.argv[1:])
