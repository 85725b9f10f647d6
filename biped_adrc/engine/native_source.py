"""The text of a law and of all that it reaches: functions, NamedTuples and constants, each under its name."""

from __future__ import annotations

import ast
import builtins
import dis
import linecache
import math
import types
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from biped_adrc import linear
from biped_adrc.engine.native_prelude import ENTRY, GUARD, PRELUDE

SUBSTITUTES: dict[int, str] = {
    id(linear.solve): "_solve",
    id(np.linalg.solve): "_solve",
    id(np.matmul): "_matmul",
    id(np.dot): "_matmul",
}
LOCALS = ("_K", "_inp", "_out", "_k", "_x", "_y", "_i", "entry", "unguarded")
RESERVED = {*LOCALS, *dir(builtins), *compile(PRELUDE, "prelude", "exec").co_names}


class Unfit(Exception):
    """Why a law cannot be compiled."""


def composed(law: Callable[..., Any], arguments: tuple[Any, ...], size: int) -> str:
    """The text of the module: prelude, what the law reaches, and the entry with the shapes."""
    text = _Text()
    name = text.function(law)
    K, inp = _Reader(text, "_K", "_k"), _Reader(text, "_inp", "_x")
    calls = [K.read(arguments[0]), *(inp.read(value) for value in arguments[1:])]
    entry = ENTRY.format(K=K.at, inp=inp.at, out=size, law=name, arguments=", ".join(calls))
    entry += GUARD if text.raises else ""
    return "\n\n".join([PRELUDE, *text.constants.values(), *text.functions.values(), entry])


class _Reader:
    """Expressions that read arguments from a flat vector, from place `at` on."""

    def __init__(self, text: _Text, pointer: str, vector: str) -> None:
        self.text, self.pointer, self.vector, self.at = text, pointer, vector, 0

    def read(self, value: Any) -> str:
        """The expression for an argument such as this example."""
        if isinstance(value, tuple):
            return self.text.tuple_of(value, [self.read(part) for part in value])
        at, kind = self.at, np.asarray(value).dtype.kind
        self.at += np.size(value)
        if isinstance(value, np.ndarray):
            array = f"carray(_at({self.pointer}, {at}), {value.shape})"
            return {"f": array, "b": f"_whole({array}) != 0"}.get(kind, f"_whole({array})")
        number = f"{self.vector}[{at}]"
        return {"f": number, "b": f"({number} != 0.0)"}.get(kind, f"int({number})")


class _Text:
    """The definitions of a module, by the names given to them."""

    def __init__(self) -> None:
        self.constants: dict[str, str] = {}
        self.functions: dict[str, str] = {}
        self.raises = False
        self._keys: dict[str, object] = {}
        self._called_inside: set[str] = set()

    def _name(self, wanted: str, key: object) -> str:
        """The name of what has this key: the one wanted, or with a number where that is another's."""
        count, name = 1, wanted
        while name in RESERVED or self._keys.setdefault(name, key) != key:
            count += 1
            name = f"{wanted}__{count}"
        return name

    def value(self, name: str, value: Any) -> str:
        """The expression for what a law finds under a global name."""
        if id(value) in SUBSTITUTES:
            return SUBSTITUTES[id(value)]
        for library, known in ((np, "np"), (math, "math")):
            its_name = getattr(value, "__name__", "")
            if value is library or getattr(library, its_name, None) is value:
                return known if value is library else f"{known}.{its_name}"
        if isinstance(value, types.FunctionType) or hasattr(value, "py_func"):
            return self.function(value)
        if isinstance(value, type) and issubclass(value, tuple) and hasattr(value, "_fields"):
            return self.named_tuple(value)
        return self.constant(name, self.literal(name, value))

    def constant(self, name: str, definition: str) -> str:
        """A name for the value of this text."""
        name = self._name(name, definition)
        self.constants[name] = f"{name} = {definition}"
        return name

    def named_tuple(self, cls: Any) -> str:
        """A NamedTuple class of the same fields."""
        defaults = [self.literal(name, x) for name, x in cls._field_defaults.items()]
        fields = f"{cls.__name__!r}, {cls._fields!r}, defaults=[{', '.join(defaults)}]"
        return self.constant(cls.__name__, f"namedtuple({fields})")

    def tuple_of(self, value: tuple[Any, ...], parts: list[str]) -> str:
        """A tuple of the class of this one, with these parts."""
        name = self.named_tuple(type(value)) if hasattr(value, "_fields") else ""
        return f"{name}({', '.join(parts)}{',' if parts else ''})"

    def literal(self, name: str, value: Any) -> str:
        """A constant by value; raises Unfit for what is none."""
        if isinstance(value, tuple):
            return self.tuple_of(value, [self.literal(name, part) for part in value])
        if isinstance(value, np.ndarray) and value.dtype.kind in "biuf":
            numbers = ", ".join(self.literal(name, x) for x in value.ravel().tolist())
            return f"np.array([{numbers}], np.{value.dtype.name}).reshape({value.shape})"
        value = value.item() if isinstance(value, np.generic) else value
        if type(value) is float and not math.isfinite(value):
            return f"float('{value}')"
        if type(value) in (bool, int, float, str, type(None)):
            return repr(value)
        raise Unfit(
            f"its global '{name}' is {value!r:.60} ({type(value).__name__}), expected a number, an array, a "
            "NamedTuple, a function with source, numpy or math"
        )

    def function(self, function: Any) -> str:
        """The name under which a function is defined here, with all that it reaches."""
        function = getattr(function, "py_func", function)
        if not isinstance(function, types.FunctionType):
            raise Unfit(f"{function!r:.60} is a {type(function).__name__}, expected a function")
        name = self._name(function.__name__, id(function))
        if name not in self.functions:
            self.functions[name] = ""
            node = _definition(function)
            node.name = name
            a = node.args
            a.defaults = [self._parsed("default", x) for x in function.__defaults__ or ()]
            for i, arg in enumerate(a.kwonlyargs):
                if arg.arg in (given := function.__kwdefaults__ or {}):
                    a.kw_defaults[i] = self._parsed("default", given[arg.arg])
            tree = ast.fix_missing_locations(_Rewrite(self, _reached(function)).visit(node))
            kind = "jit" if name in self._called_inside else "law"
            self.functions[name] = f"@{kind}\n{ast.unparse(tree)}"
        elif not self.functions[name]:
            self._called_inside.add(name)
        return name

    def _parsed(self, name: str, value: Any) -> ast.expr:
        return ast.parse(self.literal(name, value), mode="eval").body


class _Rewrite(ast.NodeTransformer):
    """A function with the names of the composed text, without annotations, and with loops for products."""

    def __init__(self, text: _Text, scope: dict[str, Any]) -> None:
        self.text, self.scope = text, scope

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        node.returns = None
        if ast.get_docstring(node) is not None:
            node.body = node.body[1:] or [ast.Pass()]
        return self.generic_visit(node)

    def visit_arg(self, node: ast.arg) -> ast.AST:
        return ast.arg(node.arg)

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.AST:
        if node.value is None:
            return ast.Pass()
        return ast.Assign([self.visit(node.target)], self.visit(node.value))

    def visit_Name(self, node: ast.Name) -> ast.AST:
        if node.id not in self.scope:
            return node
        return ast.parse(self.text.value(node.id, self.scope[node.id]), mode="eval").body

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        """An attribute of a module is what is found there."""
        owner = self._found(node.value)
        if not isinstance(owner, types.ModuleType):
            return self.generic_visit(node)
        value = getattr(owner, node.attr)
        self.text.raises |= owner is np.linalg
        if owner.__name__.split(".")[0] in ("numpy", "math") and id(value) not in SUBSTITUTES:
            return self.generic_visit(node)
        return ast.parse(self.text.value(node.attr, value), mode="eval").body

    def _found(self, node: ast.expr) -> Any:
        if isinstance(node, ast.Name):
            return self.scope.get(node.id)
        if isinstance(node, ast.Attribute):
            return getattr(self._found(node.value), node.attr, None)
        return None

    def visit_Raise(self, node: ast.Raise) -> ast.AST:
        self.text.raises = True
        return self.generic_visit(node)

    def visit_Assert(self, node: ast.Assert) -> ast.AST:
        self.text.raises = True
        return self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        self.generic_visit(node)
        return _product(node.left, node.right) if isinstance(node.op, ast.MatMult) else node

    def visit_AugAssign(self, node: ast.AugAssign) -> ast.AST:
        if not isinstance(node.op, ast.MatMult):
            return self.generic_visit(node)
        left = ast.parse(ast.unparse(node.target), mode="eval").body
        return ast.Assign(
            [self.visit(node.target)], _product(self.visit(left), self.visit(node.value))
        )


def _product(left: ast.expr, right: ast.expr) -> ast.Call:
    return ast.Call(ast.Name("_matmul", ast.Load()), [left, right], [])


def _reached(function: types.FunctionType) -> dict[str, Any]:
    """The globals, and the names of enclosing functions, that a function reads."""
    code, cells = function.__code__, function.__closure__ or ()
    scope = {name: function.__globals__[name] for name in _loaded(code) & {*function.__globals__}}
    return scope | {n: c.cell_contents for n, c in zip(code.co_freevars, cells, strict=True)}


def _loaded(code: types.CodeType) -> set[str]:
    instructions = (i for c in _codes(code) for i in dis.get_instructions(c))
    return {i.argval for i in instructions if i.opname == "LOAD_GLOBAL"}


def _definition(function: types.FunctionType) -> ast.FunctionDef:
    """The source of a function, parsed; raises Unfit unless it is that of the code that runs."""
    code, name = function.__code__, function.__name__
    if name == "<lambda>":
        raise Unfit("a lambda has no source of its own; write it with def in a file")
    linecache.checkcache(code.co_filename)
    source = "".join(linecache.getlines(code.co_filename, function.__globals__))
    if not source:
        raise Unfit(f"{name} has no source; write it in a file")
    try:
        lines = [
            c.co_firstlineno for c in _codes(compile(source, "", "exec", 0, True)) if _same(c, code)
        ]
    except SyntaxError:
        lines = []
    for node in ast.walk(ast.parse(source)) if lines else ():
        if isinstance(node, ast.FunctionDef):
            first = min([node.lineno, *(x.lineno for x in node.decorator_list)])
            if first == lines[0]:
                node.decorator_list = []
                return node
    raise Unfit(f"the source of {name} has changed since it was imported; import it again")


def _codes(code: types.CodeType) -> Iterator[types.CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from _codes(constant)


def _same(one: Any, other: Any) -> bool:
    """Code that does the same, wherever it stands in its file."""
    if not isinstance(one, types.CodeType) or not isinstance(other, types.CodeType):
        return repr(one) == repr(other)
    names = ("qualname", "code", "names", "varnames", "freevars", "cellvars")
    return (
        all(getattr(one, f"co_{name}") == getattr(other, f"co_{name}") for name in names)
        and len(one.co_consts) == len(other.co_consts)
        and all(map(_same, one.co_consts, other.co_consts))
    )
