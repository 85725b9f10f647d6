"""Options of commands, without writing each of them out in every command.

Two decorators change the signature that typer reads:

    texts          puts the help texts of options.toml on the parameters of a command
    of_scenario    puts options in front for fields of `Scenario`, with the field's own type,
    unit and text

A new field of a scenario is an option of `simulate` by one name in a list. `values_of` joins what
was on the command line, pushes and --set NAME=VALUE to the values of a scenario. --set reads values
with units, as in the file of a study.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import reduce, wraps
from inspect import Parameter, signature
from pathlib import Path
from typing import Annotated, Any, get_args

import typer

from biped_adrc.errors import InputError
from biped_adrc.resources import packaged
from biped_adrc.scenario.push import parse_push
from biped_adrc.scenario.scenario import DEFAULTS, FIELDS, UNITS
from biped_adrc.types import PlainRecord

TEXTS = packaged("biped_adrc.cli", "options.toml")
"""The content of options.toml."""
Command = Callable[..., None]


def texts(name: str) -> Callable[[Command], Command]:
    """Options and arguments with the texts that options.toml has under this name, such as "gait.design"."""
    said = dict(TEXTS["every"])
    said |= reduce(lambda table, part: table[part], name.split("."), TEXTS)

    def decorate(command: Command) -> Command:
        """Give typer a signature in which the parameters that have a text are annotated with it."""
        plain = signature(command, eval_str=True)
        told = [
            p.replace(annotation=Annotated[p.annotation, _shown(said[p.name])])
            if p.name in said
            else p
            for p in plain.parameters.values()
        ]
        command.__signature__ = plain.replace(parameters=told)  # type: ignore[attr-defined]
        command.__annotations__ = {}
        return command

    return decorate


def _shown(text: str | PlainRecord) -> object:
    """An option, or an argument, for typer from its entry in options.toml: a text, or a table with flags."""
    entry = {"help": text} if isinstance(text, str) else text
    if "argument" in entry:
        return typer.Argument(help=entry["argument"])
    return typer.Option(*entry.get("flags", ()), help=entry["help"])


def of_scenario(
    *names: str, controller: str = "ADRC", **flags: str
) -> Callable[[Command], Command]:
    """Decorator: options for fields of a scenario, put in front of a command's own.

    names: fields whose option is called as they are. flags: field=flag for others. controller: what
    the command takes by default, for the help.

    The command gets as `given` the values that are on the command line, and no defaults: whether a
    value was asked for decides, for instance, whether it may be given by --set too.
    """
    usual = {"controller": f"{controller}; passive for a robot without motors"}
    shown = {**{name: "--" + name.replace("_", "-") for name in names}, **flags}

    def decorate(command: Command) -> Command:
        """Give typer a signature with the fields of the scenario in front of the command's own parameters."""

        @wraps(command)
        def with_given(context: typer.Context, **values: object) -> None:
            """What typer calls: gathers the options that were on the command line, and calls the command."""
            given = {name: values.pop(name) for name in shown}
            command({name: x for name, x in given.items() if _told(context, name)}, **values)

        own = [
            p for p in signature(command, eval_str=True).parameters.values() if p.name != "given"
        ]
        first = Parameter("context", Parameter.KEYWORD_ONLY, annotation=typer.Context)
        options = [
            first,
            *(_option(*pair, usual.get(pair[0], True)) for pair in shown.items()),
            *own,
        ]
        options = [p.replace(kind=Parameter.KEYWORD_ONLY) for p in options]
        with_given.__signature__ = signature(with_given).replace(parameters=options)  # type: ignore[attr-defined]
        with_given.__annotations__ = {}
        return with_given

    return decorate


def _option(name: str, flag: str, usual: str | bool) -> Parameter:
    """The parameter, for typer, of one field; usual: what the help shows as its default."""
    field, default = FIELDS[name], DEFAULTS[name]
    kinds = [
        kind
        for kind in (*get_args(field.annotation), field.annotation)
        if kind in (bool, int, float)
    ]
    kind: Any = kinds[0] if kinds else str
    unit = "" if UNITS[name] == "1" else f" [{UNITS[name]}]"
    help_text = f"{str(field.description).removesuffix('.')}{unit}."
    kind = kind if default is not None else kind | None
    option = Annotated[kind, typer.Option(flag, help=help_text, show_default=usual)]
    return Parameter(name, Parameter.KEYWORD_ONLY, default=default, annotation=option)


def _told(context: typer.Context, name: str) -> bool:
    """Whether an option was on the command line, and not taken from its default."""
    source = context.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"


def values_of(
    given: PlainRecord,
    push: list[str] | None,
    sets: list[str] | None,
    scenario: Path | None = None,
) -> PlainRecord:
    """The values of a scenario that options, pushes and --set name, as its constructor takes them.

    scenario: a file of values that they go before. A name that is no field goes to the controller's
    own parameters. Raises InputError for a text or a file that cannot be read, and for a value that
    is given twice.
    """
    from biped_adrc.study.parameters import TABLES, Refused, nested, read, read_scenario

    values = dict(given)
    if push:
        values["pushes"] = tuple(parse_push(text) for text in push)
    for text in sets or ():
        name, equals, said = (word.strip() for word in text.partition("="))
        if not equals or not name:
            raise InputError(f"--set is '{text}', expected NAME=VALUE, such as 'delay=2 ms'")
        table = name.partition(".")[0]
        known = table in TABLES or (name in FIELDS and name not in TABLES)
        name = name if known else f"own.{name}"
        if name in values:
            raise InputError(f"'{name}' is given twice, as --set {text} too; leave one of them out")
        try:
            values[name] = read(name, _plain(name, said))
        except Refused as error:
            raise InputError(f"--set {text}: {error}") from None
    return nested(({} if scenario is None else read_scenario(scenario)) | values)


def _plain(name: str, text: str) -> object:
    """The text of --set as a value: a number, truth value or list where it is one, also a list without
    brackets.

    Texts of fields with units stay texts, as `study.parameters.read` reads those.
    """
    if not name.startswith("own.") and DEFAULTS.get(name) not in (True, False):
        return text
    for candidate in (text, f"[{text}]"):
        try:
            return json.loads(candidate)
        except ValueError:
            continue
    return text
