"""The text of a controller in C: header and source, from the traced functions of `export.functions`, which are
init (start), step (a sample instant) and touchdown. Templates of Jinja give the text around them.

The same scenario gives the same bytes: the text contains no date, machine or path.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from biped_adrc.core.checks import spoken
from biped_adrc.core.errors import InputError
from biped_adrc.core.files import c_comment, one_line
from biped_adrc.core.versions import packages
from biped_adrc.engine import sine
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.structure import floats, paths
from biped_adrc.extras.export.c_text import Written, c_text, decimal, read_by
from biped_adrc.extras.export.computer import Computer
from biped_adrc.extras.export.functions import Field, Functions, functions

REALS = {"float64": "double", "float32": "float"}
"""Name of a type in NumPy -> its name in C."""
TAKEN = {x: f"{x.upper()}_OK is a name of POSIX" for x in "frwx"} | {
    "main": "main.c is the example"
}
"""Prefix that is refused, since it would clash with other names of C -> the reason."""
ARGUMENTS = {"init": "", "step": ", real *u, real *lost", "touchdown": ""}
"""Name of a function -> its arguments in C besides x, m and next, the state before it, the measurement, and the
state after it: u is the torque for the motors, lost the least pivot of the matrices that are inverted."""


@dataclass(frozen=True)
class Source:
    """A controller in C: its files, and what the programs that use them need to know."""

    prefix: str
    """Prefix of all names in C."""
    real: str
    """Type of numbers in C, a key of `REALS`."""
    files: Mapping[str, str]
    """Name of file -> text."""
    fields: tuple[Field, ...]
    """Fields of the state's struct, without start, last, sent, step and without, which it always has."""
    written: Mapping[str, Written]
    """Lines of the functions init, step and touchdown, by name."""
    numbers: int
    """Length of the table of constants in the C."""
    n: int
    """Number of coordinates."""
    p: int
    """Number of motors."""
    words: Mapping[str, Any]
    """Values for the templates, such as title and scenario."""

    def __repr__(self) -> str:
        return f"Source({', '.join(self.files)}; {self.written['step'].operations} operations)"


def source_of(
    computer: Computer,
    prefix: str = "controller",
    real: str = "float64",
    scenario: Sequence[str] = (),
) -> Source:
    """Make header, source, main.c, Makefile, README and LICENSE of a computer's functions, as texts in memory.

    prefix: of all names in C, of small letters, digits and _. real: type of numbers, "float64" or "float32";
    the compiler's option -DCONTROLLER_REAL=float overrides it. scenario: lines for the comment at the top.

    Raises InputError for an invalid prefix or type, NaN among the numbers that the functions read, or a method
    that cannot be traced.
    """
    if not re.fullmatch("[a-z][a-z0-9_]{0,40}", prefix) or prefix in TAKEN:
        why = TAKEN.get(prefix, "it has to be of small letters, digits and _, such as 'controller'")
        raise InputError(f"the prefix is {prefix!r}: {why}; choose another one")
    if real not in REALS:
        raise InputError(f"the type of numbers is {real!r}, expected one of {list(REALS)}")
    try:
        functions_, k = functions(computer), computer.robot
    except NotCompiled as error:
        raise InputError(f"there is no C of {spoken(computer.walker.law)}: {error}") from error
    # indices of the parameters K (masses, gains, ..) that a function reads (0: K, 1: inputs); the C has these
    # alone
    used = sorted(set().union(*(read_by(f.function, 0) for f in functions_.all)))
    values, names = list(floats(computer.numbers)), list(paths(computer.numbers))
    bad = [names[i] for i in used if values[i] != values[i]]  # NaN alone differs from itself
    if bad:
        raise InputError(f"the parameter {bad[0]} of the scenario is NaN, expected a number")
    # ARGUMENTS: function -> its arguments in C besides x, m and next
    traced = zip(ARGUMENTS, functions_.all, strict=True)
    written = {name: c_text(f, used) for name, f in traced}
    # calls of sin and cos: those with F are of the type `real`, others in double even where that is float
    calls = [line for f in written.values() for line in f.lines if "(sine)" in line]
    words = {
        **_of_robot(computer, functions_),
        "prefix": prefix,
        "P": prefix.upper(),
        "real": REALS[real],
        "sine": vars(sine),
        "sine_wide": any("F(sine)" not in line for line in calls) if calls else None,
        # the computer's plant is the model that the controller knows
        "numbers": [(names[i].replace("plant", "model", 1), decimal(values[i])) for i in used],
        "laws": [(name, ARGUMENTS[name], written[name].lines) for name in written],
        "scenario": scenario,
        "step": written["step"],
    }
    texts = {"header.h": f"{prefix}.h", "source.c": f"{prefix}.c"}
    texts |= {name: name for name in ("main.c", "Makefile", "README.md", "LICENSE")}
    files = {name: rendered_c(template, words) for template, name in texts.items()}
    return Source(prefix, real, files, functions_.fields, written, len(used), k.n, k.p, words)


def _of_robot(computer: Computer, functions_: Functions) -> dict[str, object]:
    """Values for the templates, by name: robot, controller, clock, and fields of the state's struct."""
    walker, k, robot = computer.walker, computer.robot, computer.walker.plant.description
    return {
        "title": f"Controller of the robot {robot.name}, {type(walker.controller).__name__}",
        "about": _about(computer),
        "joints": robot.joints,
        "n": k.n,
        "p": k.p,
        "period": decimal(walker.clock.period),
        # an index from p on stands for a torque that changes its sign (`types.relabelled`)
        "exchanged": [f"{'-' * (j >= k.p)}u[{j % k.p}]" for j in walker.plant.swap.tolist()],
        "rates_read": functions_.rates,
        "torque_limit": walker.torque_limit,
        "change": computer.held.motors.change,  # the limit of the torque's rate, times the period
        "restart": walker.clock.restart,
        "fields": functions_.fields,
        # fields with torques on their way to the motors
        "line": ("queue", "waiting", "acting"),
        "versions": packages(("biped-adrc", "casadi", "pin", "numpy")),
    }


def _about(computer: Computer) -> list[str]:
    """Lines for the comment at the top of the header: what the controller computes, and the caller's part."""
    walker, k = computer.walker, computer.held
    lines = [
        f"Controller in sampled time, every {1e3 * walker.clock.period:g} ms: laws, gait and the nominal",
        "model's terms, with their numbers as constants.",
    ]
    if k.sensors is not None:
        lines.append("Rates are differences of angles, filtered, and begin anew at a touchdown.")
    if k.known:
        lines.append(f"It knows that torques act {1e3 * walker.clock.delay:g} ms late.")
    if walker.touchdown is not None:
        lines.append("How a touchdown is noticed is left to the caller.")
    return lines


def rendered_c(template: str, words: Mapping[str, object]) -> str:
    """Text of a file: its template, filled in with `words`, the values that it names."""
    return _environment(Path(template).suffix).get_template(f"{template}.j2").render(words)


@cache
def _environment(suffix: str) -> Environment:
    """Jinja's environment for files with this suffix, made once.

    It escapes every value that it inserts: as markup of XML and HTML, for a comment of C, else as one line.
    """
    markup = suffix in (".xml", ".html")
    safe = c_comment if suffix in (".c", ".h") else one_line
    return Environment(
        loader=PackageLoader("biped_adrc.extras.export"),
        autoescape=markup,
        finalize=lambda x: x if isinstance(x, Markup) and markup else safe(str(x)),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
