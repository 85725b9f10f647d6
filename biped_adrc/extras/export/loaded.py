"""An exported controller, compiled on this machine and called from Python.

`ExportedController` is a controller of a walker whose every sample instant is one call of the C, so that an
exported controller walks on any plant. `Loaded` calls the three functions of the C: init at the start, step at
a sample instant, touchdown after an impact. Each returns a flag, OK or the reason why it has no result.
"""

import ctypes
import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.lib.recfunctions import structured_to_unstructured, unstructured_to_structured
from numpy.typing import NDArray

from biped_adrc.control.base import Controller, Measurement
from biped_adrc.core.errors import (
    BipedError,
    InputError,
    NotFiniteError,
    OutputError,
    RanAwayError,
    SingularError,
)
from biped_adrc.core.types import Array, Indices, relabelled
from biped_adrc.extras.export.source import Source

FLAGS: tuple[str, ...] = ("-std=c99", "-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Wpedantic")
"""Compiler options for an exported controller."""
COMPILERS = ("cc", "gcc", "clang")
"""Names of C compilers, the first one found is taken; the environment variable CC goes before them."""
NO_COMPILER = f"there is no C compiler, looked for {', '.join(COMPILERS)}"
OK, NOT_MEASURED, NO_RESULT, SINGULAR, RAN_AWAY = range(5)
"""Flags, which the functions of the C return; the header of the C explains them."""
ERRORS: Mapping[int, type[BipedError]] = {
    NOT_MEASURED: NotFiniteError,
    NO_RESULT: NotFiniteError,
    SINGULAR: SingularError,
    RAN_AWAY: RanAwayError,
}
"""Return value of the C -> error that the controller in Python raises in this case, which ends a walk."""

_Record = NDArray[np.void]
"""A struct of C."""


def compiler() -> str | None:
    """Path of a C compiler on this machine; None where there is none."""
    names = (*filter(None, [os.environ.get("CC")]), *COMPILERS)
    return next(filter(None, map(shutil.which, names)), None)


@contextmanager
def build_c(
    files: Mapping[str, str], names: Sequence[str], *flags: str
) -> Iterator[tuple[Path, str]]:
    """Compile C files in a temporary folder; the context gives the path of the binary, which is deleted at its
    end, and the compiler's messages.

    files: name -> text, headers included. names: files to compile. flags: options besides `FLAGS`. Raises
    InputError where there is no compiler or it reports an error, and OutputError where there is no room for
    temporary files.
    """
    program = compiler()
    if program is None:
        raise InputError(f"{NO_COMPILER}; install one, or set CC")
    try:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for file, text in files.items():
                (folder / file).write_text(text, encoding="utf-8")
            arguments = [*FLAGS, *flags, "-o", "out", *names, "-lm"]
            done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True)
            if done.returncode != 0:
                message = f"{Path(program).name} does not compile {names[0]}: {done.stderr[:400]}"
                raise InputError(message)
            yield folder / "out", done.stderr
    except OSError as error:
        raise OutputError(
            f"the C cannot be compiled in the temporary folder: {error.strerror or error}; make room, or "
            "set TMPDIR to another folder"
        ) from error


def tried(source: Source) -> str:
    """Compile a source as a trial; returns a sentence with the compiler's messages, or that there is no
    compiler.
    """
    if (program := compiler()) is None:
        return f"not compiled: {NO_COMPILER}"
    with build_c(source.files, ["main.c", f"{source.prefix}.c"]) as (_, message):
        return f"compiled by {Path(program).name}: {message or 'no warnings'}"


@dataclass(frozen=True)
class Loaded:
    """An exported source, compiled and loaded into this process; its methods call the C."""

    source: Source

    @cached_property
    def measurement(self) -> np.dtype[np.void]:
        """NumPy's type of the C struct of a measurement: t, q (n,), v (n,), in its layout in memory."""
        n = self.source.n
        fields: Any = [("t", "f8"), ("q", "f8", (n,)), ("v", self.source.real, (n,))]
        return np.dtype(fields, align=True)

    @cached_property
    def state(self) -> np.dtype[np.void]:
        """NumPy's type of the C struct of the state: x_c, the numbers that the computer keeps between sample
        instants (`export.functions`), and around it

            start, last    time at which this single support began, and of the last sample instant [s]
            sent (p,)      torque that was sent last [N m]
            step, without  number of the single support, and of samples in a row without a result
        """
        real, p = self.source.real, self.source.p
        own = [(f.name, "f8" if f.double else real, (f.size,)) for f in self.source.fields]
        head = [("start", "f8"), ("last", "f8")]
        end = [("sent", real, (p,)), ("step", "i4"), ("without", "i4")]
        fields: Any = [*head, *own, *end]
        return np.dtype(fields, align=True)

    @cached_property
    def functions(self) -> dict[str, Any]:
        """init, step and touchdown as ctypes functions, compiled in a temporary folder at the first use."""
        P = self.source.prefix
        with build_c(self.source.files, [f"{P}.c"], "-shared", "-fPIC") as (out, _):
            library = ctypes.CDLL(str(out))  # stays in memory when its file is deleted
        return {name: getattr(library, f"{P}_{name}") for name in ("init", "step", "touchdown")}

    def measured(self, t: float, q: Array, v: Array) -> _Record:
        """The struct of a measurement, from t [s], q (n,) [rad] and v (n,) [rad/s]."""
        m = np.zeros((), self.measurement)
        m["t"], m["q"], m["v"] = t, q, v
        return m

    def init(self, m: _Record) -> tuple[int, _Record]:
        """Call init with a measurement; returns its flag and the state."""
        x = np.zeros((), self.state)
        # _at: address of a struct
        return self.functions["init"](_at(x), _at(m)), x

    def step(self, x: _Record, m: _Record) -> tuple[int, Array]:
        """Call step with state and measurement; returns its flag and the torque (p,) [N m] for the motors.

        x changes in place.
        """
        # the C writes to u, before the tuple with u is returned; _at: address of a struct or array
        u = np.zeros(self.source.p, self.source.real)
        return self.functions["step"](_at(x), _at(m), _at(u)), u

    def touchdown(self, x: _Record, m: _Record) -> int:
        """Call touchdown with state and measurement; returns its flag. x changes in place."""
        return self.functions["touchdown"](_at(x), _at(m))


def _at(array: NDArray[Any]) -> ctypes.c_void_p:
    """Address of the first number of an array, as an argument of C."""
    return ctypes.c_void_p(array.ctypes.data)


@dataclass(frozen=True)
class ExportedController(Controller):
    """The exported controller, in place of the one that it was made from; source: the result of `export_c`.

    m is the measurement at a sample instant: t [s], q (n,) [rad], v (n,) [rad/s].

    Its state s (size,) is the struct of the C, then the torque u (p,) [N m], all as floats. `initial_state`
    calls init of the C, `correct` step and `jump` touchdown; `output` reads u from s. A sample without a result
    ends the walk with the status that the controller in Python would give it; on a robot the last torque goes
    on.
    """

    source: Source

    @cached_property
    def loaded(self) -> Loaded:
        """The compiled functions of the C."""
        return Loaded(self.source)

    def initial_state(self, m: Measurement) -> Array:
        return self._kept(*self.loaded.init(self._inputs(m)), np.zeros(self.source.p))

    def correct(self, s: Array, m: Measurement) -> Array:
        x = self._state(s)  # a copy of the struct in s, which the C changes
        flag, u = self.loaded.step(x, self._inputs(m))
        return self._kept(flag, x, u)  # the new s, or an error for its flag

    def output(self, s: Array, m: Measurement) -> Array:
        return s[len(s) - self.source.p :]

    def jump(self, s: Array, after: Measurement, swap: Indices) -> Array:
        x = self._state(s)  # a copy of the struct in s, which the C changes
        flag = self.loaded.touchdown(x, self._inputs(after))
        # the new s, or an error for its flag; its torque has the new names of the legs
        return self._kept(flag, x, relabelled(self.output(s, after), swap))

    def continuous(self) -> Controller:
        raise InputError(
            "an exported controller acts at sample instants; give timing=SampledTime(period)"
        )

    def _inputs(self, m: Measurement) -> _Record:
        """The measurement m as C's struct."""
        return self.loaded.measured(m.t, m.q, m.v)

    def _state(self, s: Array) -> _Record:
        """The struct of the C in a state s (size,) of floats."""
        return np.array(unstructured_to_structured(s[: len(s) - self.source.p], self.loaded.state))

    def _kept(self, flag: int, x: _Record, u: Array) -> Array:
        """The state s (size,): the struct x and the torque u (p,) [N m] as one array of floats.

        Raises the error of `ERRORS` for another flag than OK.
        """
        if flag != OK:
            raise ERRORS[flag](f"the exported controller returned {flag}: it has no result")
        return np.concatenate((structured_to_unstructured(x, float), u))
