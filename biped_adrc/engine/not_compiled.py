"""Errors of what cannot be compiled, with the user's class, file and line.

They arise where the compiler runs a law, a method of a controller or another part, on symbols in place of
numbers.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from biped_adrc.core import checks
from biped_adrc.core.errors import InputError


class NotCompiled(InputError):
    """A method or part that cannot be compiled, such as one that branches on the value of a number; the text
    names it.
    """


class Located(NotCompiled):
    """A NotCompiled whose text names class, file and line already, so that no outer call adds another place."""


@contextmanager
def located(f: object) -> Iterator[None]:
    """Context that turns each exception, such as NumPy's about objects that are no floats, into a Located that
    names the place where it arose; f: the function that runs, named where no better place is known.
    """
    try:
        yield
    except Located:
        raise
    except Exception as error:
        # NumPy's own words, of casts and of a class of this compiler, would tell the author of a law nothing
        numpys = any(x in str(error) for x in ("ufunc", "'Scalar' object", "unsupported operand"))
        why = "a function or operator there has no compiled form" if numpys else error
        raise Located(f"{_place(error, f)} cannot be compiled: {why}") from error


def _place(error: Exception, f: Any) -> str:
    """The place where an error arose, as text such as PD.output (own.py:12, `x`): the innermost line of the
    user's; without one that of a method of this package, the compiler left out; else the name of f.
    """
    calls = checks.calls_of(error)
    ours = [x for x in calls if x[1].filename.startswith(checks.PACKAGE)]
    methods = [x for x in ours if "." in x[0].co_qualname and not x[1].filename.startswith(_HERE)]
    own = [x for x in calls if checks.is_users(x[1].filename)] or methods or ours
    if not own:
        return str(getattr(f, "__qualname__", f))
    code, frame = own[-1]
    name = code.co_qualname.replace(".<locals>", "")
    return f"{name} ({Path(frame.filename).name}:{frame.lineno}, `{frame.line}`)"


_HERE = str(Path(__file__).parent)
"""Folder of the compiler."""
