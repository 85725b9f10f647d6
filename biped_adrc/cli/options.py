"""Options of commands, without writing each of them out in every command.

A command is a Python function, which typer calls with what was on the command line. A *short option*, such as
--period, stands for one value of a scenario, here hardware.period. `options` puts the help texts of
options.toml on the parameters of a command, and its short options in front, with the scenario's text on that
value. `scenario_from` joins a scenario file, short options, pushes, and --set NAME=VALUE with dotted names such
as hardware.delay. All of them read units: `--period "1 ms"`.
"""

import json
from collections.abc import Callable, Collection
from contextlib import suppress
from functools import reduce, wraps
from inspect import Parameter, Signature, signature
from pathlib import Path
from typing import Annotated, Any, get_type_hints

import typer
from pydantic import TypeAdapter, ValidationError

from biped_adrc.core.errors import InputError, complaint, unknown
from biped_adrc.core.files import packaged
from biped_adrc.core.types import PlainRecord, T
from biped_adrc.scenario.scenario import Scenario, read_scenario

TEXTS = packaged("biped_adrc.cli", "options.toml")
"""The content of options.toml: help texts by command, "every" (those of all commands), and "values" (short
option -> dotted name of the value)."""
WALKS = ("controller", "gait", "preset", "robot")
"""Short options of all commands that take a scenario: what walks."""
Command = Callable[..., None]


def options(place: str, *names: str, **usual: str) -> Callable[[Command], Command]:
    """Decorator that gives a command its options and arguments, for typer.

    place: table of their help texts in options.toml, such as "gait.design". names: short options of the command
    (keys of the table `values` there); the command gets those that were used in its argument `values`, as texts
    by dotted name. usual: short option -> default that the help shows in place of the scenario's.
    """
    words = TEXTS["every"] | reduce(lambda table, part: table[part], place.split("."), TEXTS)

    def decorate(command: Command) -> Command:
        """Wrap the command in a function `run` whose signature has the short options in place of `values`;
        typer reads options, types and help texts from that signature.

        names: of the short options; usual: defaults of some of them; words: help text by name.
        """

        @wraps(command)
        def run(**arguments: Any) -> None:
            # short options that were not used are None
            texts = {TEXTS["values"][name]: arguments.pop(name) for name in names}
            if names:
                arguments["values"] = {name: x for name, x in texts.items() if x is not None}
            command(**arguments)

        # short options first, with the default of `usual` if it has one; then the command's own parameters,
        # each with its help text. `values` is left out: the short options stand in its place
        parameters = [_option(name, usual.get(name)) for name in names]
        for p in signature(command, eval_str=True).parameters.values():
            text = [_shown(words[p.name])] if p.name in words else []
            kind = Annotated[p.annotation, *text] if text else p.annotation
            # by keyword alone, as `run` takes all arguments
            own = p.replace(annotation=kind, kind=Parameter.KEYWORD_ONLY)
            parameters += [own] if p.name != "values" else []
        run.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
        run.__annotations__ = {}  # else typer would take the types of the command's annotations
        return run

    return decorate


def _shown(text: str | PlainRecord) -> object:
    """typer's option, or argument, from its entry in options.toml: a help text, or a table with `argument`, or
    with `help` and perhaps `flags`.
    """
    entry = {"help": text} if isinstance(text, str) else text
    if "argument" in entry:
        return typer.Argument(help=entry["argument"])
    return typer.Option(*entry.get("flags", ()), help=entry["help"])


def _option(name: str, usual: str | None) -> Parameter:
    """The parameter, for typer, of a short option; usual: what the help shows as its default, None for the
    default of the scenario's value.
    """
    # description of the value: text for users, default, and unit in brackets
    what = Scenario.field_of(TEXTS["values"][name])
    text, default = what.text.removesuffix("."), what.default
    if usual is not None:
        # the value's text may state its own default, which is not true here
        text, default = text.partition("; by default")[0], usual
    text = f"{text}{what.in_brackets}."
    flag = "--" + name.replace("_", "-")
    shown = typer.Option(flag, help=text, show_default=False if default is None else str(default))
    annotation = Annotated[str | None, shown]
    return Parameter(name, Parameter.KEYWORD_ONLY, default=None, annotation=annotation)


def scenario_from(
    values: PlainRecord,
    sets: list[str] | None,
    file: Path | None = None,
    push: list[str] | None = None,
    usual: str = "ADRC",
) -> Scenario:
    """The scenario of a file, with the values of options, pushes and --set in place of the file's.

    values: texts by dotted name, from short options. sets: texts NAME=VALUE; a value of a class of the user's
    has no declared type, so its text is read by `_own`. file: None for a scenario of defaults. push: texts of
    pushes, in place of all of the file's. usual: the controller where none of them names one; a robot without
    motors has "passive". Raises InputError for a text or a file that cannot be read, and for a value that is
    set twice.
    """
    values = {**values, **({"pushes": list(push)} if push else {})}
    for name, x in assignments(sets, taken=values).items():
        # types: those that the scenario declares for the value; empty for one of a user's class
        values[name] = x if Scenario.field_of(name).types else _own(x)
    base = Scenario() if file is None else read_scenario(file)
    # _passive: the controller where neither options nor file choose one
    if not any(name.startswith("controller.name") for name in values):
        values = {**_passive(base, values, usual), **values}
    return base.replace(values)


def _passive(base: Scenario, values: PlainRecord, usual: str) -> PlainRecord:
    """{"controller.name": name} with the controller if none is chosen: `usual`, or "passive" for a robot
    without motors. Empty if the scenario file chose one.

    base: the scenario of the file. values: those in place of the file's.
    """
    from biped_adrc.core.registry import is_own
    from biped_adrc.model.robots.robot_toml import load_description

    # a file that names no controller has the default one; a file that names `usual` gets it again below
    if base.controller.name != usual and base.controller != Scenario().controller:
        return {}
    robot = str(values.get("robot.name", base.robot.name))
    # a robot of the user's own class is taken to have motors
    motors = is_own(robot) or load_description(robot).actuated
    return {"controller.name": usual if motors else "passive"}


def assignments(
    sets: list[str] | None,
    option: str = "--set",
    form: str = "NAME=VALUE, such as 'hardware.delay=2 ms'",
    taken: Collection[str] = (),
) -> dict[str, str]:
    """The texts VALUE by NAME of an option NAME=VALUE. Raises InputError for another form, or a name that comes
    twice.

    sets: what the option had, each time that it was used. option, form: its name and its form, for messages.
    taken: names whose values other options have set already.
    """
    result: dict[str, str] = {}
    for text in sets or ():
        name, equals, x = (word.strip() for word in text.partition("="))
        if not (name and equals and x):
            raise InputError(f"{option} is '{text}', expected {form}")
        if name in result or name in taken:
            raise InputError(f"'{name}' is given twice, as {option} {text} too; leave one out")
        result[name] = x
    return result


def _own(text: str) -> object:
    """The value in a text for a field of a user's own class, whose type is not known: a number, truth value or
    list if it reads as JSON, as 1,2 does for [1, 2]; else the text itself.
    """
    for candidate in (text, f"[{text}]"):
        with suppress(ValueError):
            return json.loads(candidate)
    return text


def with_sets(
    make: type[T], sets: list[str] | None, usual: PlainRecord | None = None, **fixed: object
) -> T:
    """An object of the dataclass `make`, with values from --set NAME=VALUE, read by the types of its fields.

    The text "none" is None, and a tuple is written with commas. usual: values for fields that --set does not
    name; fixed: values of fields that --set may not name. Raises InputError for an unknown name, and a text of
    another type.
    """
    hints, values = get_type_hints(make), dict(usual or {})
    known = [name for name in signature(make).parameters if name not in fixed]
    for name, text in assignments(sets).items():
        if name not in known:
            raise InputError(f"--set {name}: {unknown(name, known)}")
        # a list for a field of type tuple, None for "none", else the text, which pydantic converts
        x = text.split(",") if "tuple" in str(hints[name]) else None if text == "none" else text
        try:
            values[name] = TypeAdapter(hints[name]).validate_python(x)
        except ValidationError as error:
            raise InputError(f"--set {name}: {complaint(error.errors()[0])}") from None
    return make(**values, **fixed)
