"""The shape of the code in numbers: lines by folder, modules, functions, and places where a type decides.

    python benchmarks/house.py [FOLDER ...]

Lines of code are those that are not blank, no comment and no docstring. A place where a type decides is
`type(x) is`, `type(x) in`, `type(x).name is` or `isinstance` of a class of this package outside of its errors.

The share of docstrings is of all lines, blanks included. A public function with arrays names shapes or units
where its docstring has a shape, such as (n,) or (p, K), or a unit in brackets, such as [rad]; a method without
a docstring has that of the class above, and is not counted. `Any` is counted in the syntax, without imports.
"""

from __future__ import annotations

import ast
import io
import re
import statistics
import sys
import tokenize
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
Function = ast.FunctionDef | ast.AsyncFunctionDef


class Counted(NamedTuple):
    """Of one module: lines of code, of docstrings and of all, lengths of its functions, and deciding types."""

    code: int
    docstrings: int
    all: int
    functions: tuple[int, ...]
    deciding: tuple[int, ...]
    """Numbers of the lines."""
    any: int
    """Places with `Any`."""
    arrays: int
    named: tuple[str, ...]
    """Public functions with arrays: how many, and which of them name neither a shape nor a unit."""


SHAPE = re.compile(r"\([\w +*/-]+,[\w +*/,-]*\)|\b\d x \d\b")
UNIT = re.compile(r"\[[^\]]*\b(rad|m|s|N|kg|W|J|Hz|mm|ms|us|deg|1|%)\b[^\]]*\]")


def array_functions(tree: ast.Module) -> Iterator[tuple[str, bool]]:
    """Public functions and methods with arrays and a docstring, and whether it names a shape or a unit."""
    below: list[tuple[str, ast.AST]] = [("", tree)]
    while below:
        prefix, node = below.pop()
        for x in ast.iter_child_nodes(node):
            if isinstance(x, ast.ClassDef) and not x.name.startswith("_"):
                below.append((f"{prefix}{x.name}.", x))
            if not isinstance(x, Function) or x.name.startswith("_"):
                continue
            text = ast.get_docstring(x)
            notes = [a.annotation for a in (*x.args.args, *x.args.kwonlyargs)] + [x.returns]
            if any("Array" in ast.unparse(note) for note in notes if note) and (text or not prefix):
                yield prefix + x.name, bool(SHAPE.search(text or "") or UNIT.search(text or ""))


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
    arrays = list(array_functions(tree))
    return Counted(
        len(code_lines(text) - texts),
        len(texts),
        len(text.splitlines()),
        lengths,
        tuple(sorted(deciding(tree, own))),
        sum(isinstance(x, ast.Name) and x.id == "Any" for x in ast.walk(tree)),
        len(arrays),
        tuple(name for name, good in arrays if not good),
    )


def classes(paths: list[Path]) -> frozenset[str]:
    """Names of the classes of these modules, but for errors."""
    trees = (ast.parse(path.read_text(encoding="utf-8")) for path in paths)
    found = (x.name for tree in trees for x in ast.walk(tree) if isinstance(x, ast.ClassDef))
    return frozenset(name for name in found if not name.endswith("Error"))


def line(name: object, parts: list[Counted]) -> str:
    """One row of the table."""
    docs, lines = sum(x.docstrings for x in parts), max(1, sum(x.all for x in parts))
    arrays = sum(x.arrays for x in parts)
    named = 1.0 - sum(len(x.named) for x in parts) / max(1, arrays)
    return (
        f"{name!s:32} {len(parts):7} {sum(x.code for x in parts):6} {docs:6} {docs / lines:6.1%} {arrays:6} "
        f"{named:6.0%} {sum(x.any for x in parts):5} {sum(len(x.deciding) for x in parts):8}"
    )


def main(folders: list[str]) -> None:
    """Print the table of these folders, package and validation by default; --list names what names no shape."""
    listed = "--list" in folders
    asked = [Path(folder).resolve() for folder in folders if folder != "--list"]
    roots = asked or [ROOT / "biped_adrc", ROOT / "validation"]
    paths = sorted(path for root in roots for path in root.rglob("*.py"))
    own = classes(paths)
    found = {path: counted(path, own) for path in paths}
    base = roots[0].parent if len(roots) == 1 else ROOT
    heads = (
        f"{'modules':>7} {'code':>6} {'docs':>6} {'share':>6} {'arrays':>6} {'named':>6} {'Any':>5}"
    )
    print(f"{'folder':32} {heads} {'deciding':>8}")
    for folder in sorted({path.parent for path in paths}):
        parts = [x for path, x in found.items() if path.parent == folder]
        print(line(folder.relative_to(base), parts))
    every = list(found.values())
    print(line("all", every))
    lengths = [n for x in every for n in x.functions]
    modules = [x.code for x in every]
    print(
        f"code lines of a module: median {statistics.median(modules):g}, most {max(modules)}; functions: "
        f"{len(lengths)}, lines median {statistics.median(lengths):g}, most {max(lengths)}"
    )
    if listed:
        for path, x in found.items():
            print(
                *(f"{path.relative_to(base)}: {name}" for name in x.named),
                sep="\n",
                end="\n" * bool(x.named),
            )


if __name__ == "__main__":
    main(sys.argv[1:])
