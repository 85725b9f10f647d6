"""The package's docstrings are plain text with indented equations: render them as that.

Indented blocks become literal blocks, `names` become code, examples stay, and nothing else is markup. An
equation number between 1 and 28 in parentheses becomes a link to the page on the paper's equations.
"""

import re

import biped_adrc.core.types

_SPECIAL = re.compile(r"([\\*|@])|(?<=\w)(_)(?=\W|$)")
_EQUATION = re.compile(r"\(([1-9]|1\d|2[0-8])\)")
_OTHER_PAPERS = ("biped_adrc.hybrid.",)  # number the equations of another paper


def name_array_types():
    """Let signatures say Array where they would spell out numpy.ndarray[tuple[Any, ...], ...]."""
    for name, text in (
        ("Array", "Real array in float64; shapes are stated in the docstrings."),
        ("ComplexArray", "Complex array, for eigenvalues and transfer functions."),
    ):
        stand_in = type(name, (), {"__module__": "biped_adrc.core.types", "__doc__": text})
        setattr(biped_adrc.core.types, name, stand_in)


def plain(app, what, name, obj, options, lines):
    """Rewrite the lines of one docstring in place."""
    if obj.__doc__ and obj.__doc__ is getattr(type(obj), "__doc__", None) and what != "module":
        lines[:] = []  # an instance of tuple or dict shows its class's text
        return
    if lines and lines[0].startswith("Alias for field number"):
        lines[:] = []  # a field without a text of its own
        return
    out: list[str] = []
    literal = example = False
    for line in lines:
        example = line.startswith(">>> ") or (example and bool(line))
        if example:
            out.append(line)
            continue
        indented = line.startswith("    ")
        if indented and not literal:
            out += ["", "::", ""]
        elif literal and line and not indented:
            out.append("")
            indented = False
        literal = indented or (literal and not line)
        out.append(line if literal else _text(line, links=not name.startswith(_OTHER_PAPERS)))
    lines[:] = out


def _text(line: str, links: bool) -> str:
    parts = line.split("`")
    for i, part in enumerate(parts):
        if i % 2:
            parts[i] = f"``{part}``"
        else:
            part = _SPECIAL.sub(lambda m: "\\" + m.group(0), part)
            parts[i] = _EQUATION.sub(r":ref:`(\1) <eq-\1>`", part) if links else part
    return "".join(parts)


def skip(app, what, name, obj, skip, options):
    """Leave out what NamedTuple and Enum bring along without a text of their own."""
    if name in ("count", "index") and what == "class":
        return True
    return None


def signature(app, what, name, obj, options, signature, return_annotation):
    """Python that Sphinx can parse, where a dataclass says <factory>."""
    if signature and "<factory>" in signature:
        return signature.replace("<factory>", "..."), return_annotation
    return None


def bases(app, name, obj, options, found):
    """`object` goes without saying."""
    found[:] = [base for base in found if base is not object]
