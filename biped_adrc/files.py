"""Files: their names, JSON that is read, plain values for JSON, and writing whole or not at all."""

from __future__ import annotations

import json
import math
import os
import re
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import fields, is_dataclass
from json import JSONDecodeError
from pathlib import Path
from tomllib import TOMLDecodeError
from typing import Any

import numpy as np

from biped_adrc.errors import BipedError, InputError, OutputError

_KIND = re.compile(r"\.[A-Za-z]\w*")
"""The end of a name that says what is in a file; '.1' of 'push_0.1' does not."""


def output_path(path: Path | str, suffixes: Sequence[str], default: bool = False) -> Path:
    """The file that a name asks for: as it is given where it ends in one of `suffixes`.

    default: a name that says no kind, such as 'push_0.1', has the first of `suffixes` put behind it. Raises
    InputError for another kind or what is no name, and OutputError for a folder or a device.
    """
    path = _named(path)
    try:
        taken = path.exists() and not path.is_file()
    except OSError as error:
        raise OutputError(
            f"cannot write '{path}': {error.strerror}; choose another name"
        ) from error
    if taken:
        raise OutputError(f"'{path}' is a folder or a device, expected the name of a file to write")
    if path.suffix.lower() in suffixes:
        return path
    if default and not _KIND.fullmatch(path.suffix):
        return output_path(path.with_name(path.name + suffixes[0]), suffixes)
    raise InputError(
        f"cannot write '{path}': the name ends in '{path.suffix}', expected {' or '.join(suffixes)}"
    )


def _named(path: object) -> Path:
    """The path that is given. Raises InputError for what no file may be called."""
    if not isinstance(path, str | os.PathLike) or "\0" in str(path):
        raise InputError(f"cannot write {path!r}, expected the name of a file, text without '\\0'")
    if Path(path).parts[:1] == ("~",):
        raise InputError(
            f"cannot write '{path}': '~' would be a folder of that name; give Path('{path}').expanduser()"
        )
    return Path(path)


def keep_inputs(outputs: Iterable[Path], inputs: Iterable[Path]) -> None:
    """Raises InputError where a file that is to be written is one of those that are read."""
    outputs, inputs = tuple(outputs), tuple(inputs)
    for read in inputs:
        if any(_same(read, written) for written in outputs):
            written = " and ".join(f"'{path}'" for path in outputs)
            raise InputError(
                f"this would write {written}, and '{read}' is what it reads; choose another name for the output"
            )


def _same(a: Path, b: Path) -> bool:
    """Whether two names are of one file, or would be."""
    try:
        return os.path.samefile(a, b)
    except OSError:
        return os.path.realpath(a) == os.path.realpath(b)


@contextmanager
def reading(what: str, path: Path | str, error: type[BipedError]) -> Iterator[None]:
    """Raises `error`, which names the file and what it is, for whatever goes wrong while it is read.

    Errors that are raised on purpose keep their text behind the name of the file.
    """
    where, kind = f"{what} '{path}'", Path(path).suffix[1:].upper()
    try:
        yield
    except FileNotFoundError:
        raise error(f"{where} not found") from None
    except OSError as found:
        raise error(f"{where} cannot be read: {found.strerror}") from found
    except (JSONDecodeError, TOMLDecodeError, UnicodeDecodeError) as found:
        raise error(f"{where} is not valid {kind}: {found}") from found
    except KeyError as found:
        raise error(f"{where}: the key {found} is missing") from found
    except (TypeError, ValueError, AttributeError, IndexError) as found:
        raise error(f"{where}: {found}") from found


def read_json(path: Path, what: str, error: type[BipedError] = InputError) -> Any:
    """What a file holds. Raises `error`, which says `what` the file should be, where it cannot be read."""
    with reading(what, path, error):
        return json.loads(path.read_text(encoding="utf-8"))


def plain(value: object) -> Any:
    """As JSON has it: records by their fields, arrays as lists, a number that is not finite as text."""
    if is_dataclass(value):
        value = {field.name: getattr(value, field.name) for field in fields(value)}
    elif hasattr(value, "_asdict"):
        value = value._asdict()
    if isinstance(value, Mapping):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [plain(v) for v in value]
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def write_text(path: Path, text: str) -> None:
    """Write a file whole or not at all: temporary file, fsync, rename. Raises OutputError."""
    write_bytes(path, text.encode("utf-8"))


def write_bytes(path: Path, data: bytes) -> None:
    """As `write_text`, for bytes."""
    with replacing(path) as temporary:
        temporary.write_bytes(data)


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A temporary file beside `path`, which takes its place when all is in it. Raises OutputError."""
    temporary = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        os.close(handle)
        temporary = Path(name)
        yield temporary
        with open(temporary, "rb") as file:
            os.fsync(file.fileno())
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(temporary, 0o666 & ~umask)
        os.replace(temporary, path)
    except OSError as error:
        raise OutputError(
            f"cannot write '{path}': {error.strerror or error}; choose a folder you may write to"
        ) from error
    finally:
        if temporary is not None:
            temporary.unlink(missing_ok=True)
