"""Lines of the pages that are filled in from the package, so that they cannot go stale.

<!-- modules of biped_adrc.gait -->      one section for every module of the package
<!-- names of biped_adrc -->             a table of the names at the top of the package
<!-- help of biped-adrc simulate -->     what the command prints for --help
<!-- fields of biped_adrc.scenario.scenario.Scenario -->   a table of what a study may vary
"""

import importlib
import pkgutil
import re

import biped_adrc

_LINE = re.compile(r"^<!-- (modules|names|help|fields) of (.+?) -->$", re.MULTILINE)


def placeholders(app, docname, source):
    """Expand the lines of one page."""
    makers = {"modules": _modules, "names": _names, "help": _help, "fields": _fields}
    source[0] = _LINE.sub(lambda m: makers[m[1]](m[2]), source[0])


def _automodule(name: str, *options: str) -> str:
    text = "\n".join([f".. automodule:: {name}", *(f"   :{option}:" for option in options)])
    return f"```{{eval-rst}}\n{text}\n```\n"


def _modules(package: str) -> str:
    found = importlib.import_module(package)
    out = []
    if not hasattr(found, "__path__"):
        return _automodule(package)
    out.append(_automodule(package, "no-members"))
    for module in pkgutil.walk_packages(found.__path__, f"{package}."):
        out.append(f"## {module.name.removeprefix('biped_adrc.')}\n")
        out.append(_automodule(module.name, *(["no-members"] if module.ispkg else [])))
    return "\n".join(out)


def _names(_: str) -> str:
    rows = ["| name | where | what |", "|---|---|---|"]
    for name, home in sorted(biped_adrc._HOMES.items()):
        module = f"biped_adrc.{home}"
        thing = getattr(importlib.import_module(module), name)
        text = thing.__doc__ if callable(thing) else "A value; see there."
        first = (text or "").strip().partition("\n\n")[0].replace("\n", " ").replace("|", "\\|")
        kind = "class" if isinstance(thing, type) else "func" if callable(thing) else "data"
        rows.append(f"| {{py:{kind}}}`ba.{name} <{module}.{name}>` | `{module}` | {first} |")
    return "\n".join(rows)


def _fields(model: str) -> str:
    module, _, name = model.rpartition(".")
    rows = ["| name | unit | default | range | what |", "|---|---|---|---|---|"]
    home = importlib.import_module(module)
    for field, info in getattr(home, name).__pydantic_fields__.items():
        unit = home.UNITS[field]
        ends = [
            f"{sign} {getattr(part, key):g}"
            for part in info.metadata
            for key, sign in (("ge", "≥"), ("gt", ">"), ("le", "≤"), ("lt", "<"))
            if hasattr(part, key)
        ]
        usual = "none" if info.default is None else info.get_default(call_default_factory=True)
        shown = f"{usual:g}" if isinstance(usual, float) else str(usual)
        rows.append(
            f"| `{field}` | {'' if unit == '1' else unit} | {shown} | {', '.join(ends)} | {info.description} |"
        )
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
