"""Lines of the pages that are filled in from the package, so that they cannot go stale.

<!-- table of biped_adrc -->            the public names, each with its first sentence
<!-- names of control observers -->     the documentation of the public names of these rooms
<!-- help of biped-adrc simulate -->    what the command prints for --help
<!-- fields of biped_adrc.scenario.scenario -->   a table of the values of a scenario
"""

import importlib
import re

import biped_adrc

_LINE = re.compile(r"^<!-- (table|names|help|fields) of (.+?) -->$", re.MULTILINE)


def placeholders(app, docname, source):
    """Expand the lines of one page."""
    makers = {"table": _table, "names": _names, "help": _help, "fields": _fields}
    source[0] = _LINE.sub(lambda m: makers[m[1]](m[2]), source[0])


def _kind(name: str) -> str:
    thing = getattr(biped_adrc, name)
    return "class" if isinstance(thing, type) else "function" if callable(thing) else "data"


def _table(_: str) -> str:
    rows = ["| name | what |", "|---|---|"]
    for name in sorted(biped_adrc._HOMES):
        thing = getattr(biped_adrc, name)
        text = (thing.__doc__ if callable(thing) else "") or ""
        first = text.strip().partition("\n\n")[0].replace("\n", " ").replace("|", "\\|")
        role = _kind(name).replace("function", "func")
        rows.append(f"| {{py:{role}}}`ba.{name} <biped_adrc.{name}>` | {first} |")
    return "\n".join(rows)


def _names(rooms: str) -> str:
    below = rooms.split()
    found = [n for n, home in biped_adrc._HOMES.items() if home.partition(".")[0] in below]
    lines = [f".. auto{_kind(name)}:: biped_adrc.{name}" for name in sorted(found)]
    return "```{eval-rst}\n" + "\n\n".join(lines) + "\n```\n"


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

    words = [word for word in command.split()[1:] if word]
    result = CliRunner().invoke(
        app,
        [*words, "--help"],
        prog_name="biped-adrc",
        env={"COLUMNS": "96", "TERMINAL_WIDTH": "96", "NO_COLOR": "1"},
    )
    if result.exit_code != 0:
        raise RuntimeError(f"'{command} --help' ended with exit code {result.exit_code}")
    return f"```text\n{result.output.strip()}\n```"
