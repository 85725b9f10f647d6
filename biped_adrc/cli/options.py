"""Options of commands: their texts from options.toml; those that are fields of a scenario from the record."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import reduce, wraps
from inspect import Parameter, signature
from typing import Annotated, Any, get_args

import typer

from biped_adrc.errors import InputError
from biped_adrc.resources import packaged
from biped_adrc.scenario.push import parse_push
from biped_adrc.scenario.scenario import DEFAULTS, FIELDS, UNITS

Pushes = Annotated[
    list[str] | None,
    typer.Option(
        "--push",
        help="Torque [N m] on joints in one single support, JOINTS=TORQUE@STEP:START-STOP [s]; e.g. "
        "'q1,q2=30@19:0.1-0.3'. End with ':sine=5' for a sine of 5 Hz, ':rise=0.01' for edges of 10 ms, or "
        "give 'START-' for one that stays. "
        "Joints are q1..q5 or names of the URDF; q5 is the unactuated torso. May be repeated; "
        "several joints with different torques: 'q1=30,q3=-20@19:0.1-0.3'.",
    ),
]
TEXTS = packaged("biped_adrc.cli", "options.toml")
Command = Callable[..., None]


def texts(name: str) -> Callable[[Command], Command]:
    """Options and arguments with the texts that options.toml has under this name, such as "gait.design"."""
    table: dict[str, Any] = reduce(dict.__getitem__, name.split("."), TEXTS)
    said = TEXTS["every"] | table

    def decorate(command: Command) -> Command:
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


def _shown(text: Any) -> Any:
    """An option, or an argument, as options.toml has it."""
    entry = {"help": text} if isinstance(text, str) else text
    if "argument" in entry:
        return typer.Argument(help=entry["argument"])
    return typer.Option(*entry.get("flags", ()), help=entry["help"])


def of_scenario(
    *names: str, controller: str = "ADRC", **flags: str
) -> Callable[[Command], Command]:
    """Options for fields by name, or by a flag of another name, put in front of a command's own.

    The command gets as `given` those that are on the command line. controller: what it takes by default.
    """
    usual = {"controller": f"{controller}; passive for a robot without motors"}
    shown = {**{name: "--" + name.replace("_", "-") for name in names}, **flags}

    def decorate(command: Command) -> Command:
        @wraps(command)
        def with_given(context: typer.Context, **values: Any) -> None:
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
    """Whether an option was on the command line."""
    source = context.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"


def values_of(
    given: dict[str, Any], push: list[str] | None, sets: list[str] | None
) -> dict[str, Any]:
    """The values of a scenario that options, pushes and --set name. Raises InputError."""
    from biped_adrc.bench.parameters import TABLES, Refused, nested, read

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
    return nested(values)


def _plain(name: str, text: str) -> Any:
    """A number, a truth value or a list where the text is one; lists of numbers without brackets too."""
    if not name.startswith("own.") and DEFAULTS.get(name) not in (True, False):
        return text
    for candidate in (text, f"[{text}]"):
        try:
            return json.loads(candidate)
        except ValueError:
            continue
    return text
