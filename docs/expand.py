"""Parts of docs/api that are made from the package, so that they cannot go stale: python docs/expand.py

writes what stands between a line such as these and the next `<!-- end -->`, for who reads the repository.

<!-- table of biped_adrc -->            the public names, each with its first sentence
<!-- names of control observers -->     the documentation of the public names of these rooms
<!-- help of biped-adrc simulate -->    what the command prints for --help
<!-- fields of biped_adrc.scenario.scenario -->   a table of the values of a scenario

All pages are Markdown that a repository shows. Sphinx gets autodoc in place of names, roles in place of links
to files of the package, and in place of a text the comment `<!-- built:` before it.
"""

import enum
import importlib
import inspect
import re
from pathlib import Path
from textwrap import fill, indent
from types import FunctionType

import biped_adrc

API = Path(__file__).parent / "api"
_PART = re.compile(
    r"^<!-- (table|names|help|fields) of (.+?) -->\n(?:(?:(?!<!-- ).*\n)*<!-- end -->(?:\n|\Z))?",
    re.MULTILINE,
)
_FOR_SPHINX = {
    r"^<!-- built:\n(.*?)^-->\n.*?^<!-- end -->$": r"\1",
    r'^<a id="([\w-]+)"></a>$': r"(\1)=",
    r"\]\((?:\w+\.md)?#((?:eq|slip|figure)-[\w-]+)\)": r"](#\1)",
    r"^```math\n(.*?)^```$": r"```{math}\n:nowrap:\n\n\\begin{equation}\n\1\\end{equation}\n```",
    r"\[`ba\.(\w+)`\]\(\w+\.md#ba\w+\)": r"{py:obj}`ba.\1 <biped_adrc.\1>`",
}
_METHODS = (FunctionType, property, classmethod, staticmethod)


def for_sphinx(app, docname, source):
    """One page as Sphinx takes it."""
    text = _PART.sub(lambda m: _autodoc(m[2]) if m[1] == "names" else m[0], source[0])
    for pattern, by in _FOR_SPHINX.items():
        text = re.sub(pattern, by, text, flags=re.MULTILINE | re.DOTALL)
    source[0] = re.sub(r"\[`([^`]+)`\]\((?:\.\./)+(biped_adrc/[\w/]+)\.py\)", _role, text)


def _role(match: re.Match) -> str:
    """Of [`Biped.R`](../biped_adrc/model/biped.py); a module has the end of its path as its text."""
    home = match[2].replace("/", ".").removesuffix(".__init__")
    whole = home if home.endswith(match[1]) else f"{home}.{match[1].removesuffix('()')}"
    return f"{{py:obj}}`{match[1]} <{whole}>`"


def _of(rooms: str) -> list[str]:
    """The public names of rooms."""
    homes = biped_adrc._HOMES.items()
    return sorted(name for name, home in homes if home.partition(".")[0] in rooms.split())


def _autodoc(rooms: str) -> str:
    lines = []
    for name in _of(rooms):
        thing = getattr(biped_adrc, name)
        kind = "class" if isinstance(thing, type) else "function" if callable(thing) else "data"
        lines.append(f".. auto{kind}:: biped_adrc.{name}")
    return "```{eval-rst}\n" + "\n\n".join(lines) + "\n```\n"


def written(page: str) -> str:
    """The page with its parts."""
    makers = {"table": _table, "names": _names, "help": _help, "fields": _fields}
    made = lambda m: f"<!-- {m[1]} of {m[2]} -->\n\n{makers[m[1]](m[2])}\n\n<!-- end -->\n"  # noqa: E731
    return _PART.sub(made, page)


def _first(thing) -> str:
    """The first paragraph of a docstring."""
    return (inspect.getdoc(thing) or "").partition("\n\n")[0]


def _table(_: str) -> str:
    rows = {}
    for page in API.glob("*.md"):
        for kind, rooms in _PART.findall(page.read_text(encoding="utf-8")):
            for name in _of(rooms) if kind == "names" else ():
                thing = getattr(biped_adrc, name)
                what = " ".join(_first(thing).split()).replace("|", "\\|") * callable(thing)
                rows[name] = f"| [`ba.{name}`]({page.name}#ba{name.lower()}) | {what} |"
    return "\n".join(["| name | what |", "|---|---|", *(rows[name] for name in sorted(rows))])


def _names(rooms: str) -> str:
    return "\n\n".join(f"## ba.{name}\n\n```text\n{_text(name)}\n```" for name in _of(rooms))


def _text(name: str) -> str:
    """Call, docstring, and of each method its call and first paragraph."""
    thing = getattr(biped_adrc, name)
    if not callable(thing):
        return fill(f"{name} = {thing}", 100)
    parts = [fill(name + _call(thing), 100), inspect.getdoc(thing)]
    for key, method in vars(thing).items() if isinstance(thing, type) else ():
        if isinstance(method, _METHODS) and not key.startswith("_") and method.__doc__:
            parts.append(f".{key}{_call(method)}\n{indent(_first(method), '    ')}")
    return "\n\n".join(parts)


def _call(thing) -> str:
    """The parameters without their types; nothing of a property, an enumeration or an error."""
    if type(thing) in (property, enum.EnumType) or Exception in getattr(thing, "__mro__", ()):
        return ""
    call = inspect.signature(getattr(thing, "__func__", thing))
    bare = [p.replace(annotation=p.empty) for p in call.parameters.values()]
    text = str(call.replace(parameters=bare, return_annotation=call.empty))
    return re.sub(r"<(\w+\.\w+): .*?>|(?<=^\()(self|cls)(, )?", r"\1", text).replace(
        "<factory>", "..."
    )


def _fields(model: str) -> str:
    home = importlib.import_module(model).Scenario
    rows = ["| name | unit | default | range | what |", "|---|---|---|---|---|"]
    for what in map(home.field_of, home.names()):
        unit = "" if what.unit == "1" else what.unit
        usual = "" if what.default in (None, {}) else what.default
        rows.append(f"| `{what.name}` | {unit} | {usual} | {what.range_text} | {what.text} |")
    return "\n".join(rows)


def _help(command: str) -> str:
    from typer.testing import CliRunner

    from biped_adrc.cli import app

    terminal = {"COLUMNS": "96", "TERMINAL_WIDTH": "96", "NO_COLOR": "1"}
    words = [*command.split()[1:], "--help"]
    result = CliRunner().invoke(app, words, prog_name="biped-adrc", env=terminal)
    if result.exit_code != 0:
        raise RuntimeError(f"'{command} --help' ended with exit code {result.exit_code}")
    return f"```text\n{result.output.strip()}\n```"


if __name__ == "__main__":
    for path in sorted(API.glob("*.md")):
        path.write_text(written(path.read_text(encoding="utf-8")), encoding="utf-8")
