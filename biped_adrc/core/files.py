"""Files: names of outputs, JSON and CSV, text for other languages, and writing whole or not at all.

Used by every module that touches the file system, so that all of them refuse the same things with the
same sentences. It has three rules:

    A name is checked before anything is computed (`output_path`, `check_folder`, `keep_inputs`): an
    hour of walking is not lost to a typing error.
    An error while a file is read names the file and what it should be (`reading`); a device or a
    pipe, whose reading may never end, is refused before it is opened (`check_regular`).
    A file is replaced in one step (`replacing`): after a kill or a full disk the old file is
    still there.
"""

import csv
import json
import math
import os
import re
import stat
import tempfile
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import fields, is_dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any, NamedTuple, Self

import numpy as np

from biped_adrc.core.errors import BipedError, InputError, OutputError
from biped_adrc.core.types import Array

_KIND = re.compile(r"\.[A-Za-z]\w*")
"""Suffix of a name that states the kind of a file; '.1' of 'push_0.1' is none."""
CONTROL = re.compile(r"[\x00-\x1f\x7f]")
"""Characters that no name of an output file contains, such as a line break."""
_LONGEST = 240
"""Longest part of a path [bytes]; file systems take 255, and the name of the temporary file is longer."""


def output_path(path: Path | str, suffixes: Sequence[str], default: bool = False) -> Path:
    """Check the path of a file to write; it has to end in one of `suffixes`, such as
    (".png", ".svg"). Returns the path.

    default: a name without a suffix of a kind, such as 'push_0.1', gets the first of `suffixes`. Raises
    InputError for another suffix and for an impossible name, and OutputError where the path is a folder, a
    device, a pipe or a link.
    """
    path = _named(path)  # checked as a name
    check_place(path)
    if path.suffix.lower() in suffixes:
        return path
    # _KIND: a suffix that states a kind of file; .1 of push_0.1 is none
    if default and not _KIND.fullmatch(path.suffix):
        return output_path(path.with_name(path.name + suffixes[0]), suffixes)
    raise InputError(f"cannot write '{path}', expected {' or '.join(suffixes)} at its end")


def check_place(path: Path) -> None:
    """Raise OutputError if the path is a folder, a device, a pipe or a link, which a file would replace."""
    try:
        taken = path.exists() and not path.is_file()
        kind = "a folder" if path.is_dir() else "not a regular file"
        if path.is_symlink():
            taken, kind = True, f"a link to '{path.readlink()}'"
    except OSError as error:
        raise OutputError(f"cannot write '{path}': {error.strerror}; take another name") from error
    if taken:
        raise OutputError(f"'{path}' is {kind}, expected the name of a file to write")


def check_folder(path: Path | str) -> None:
    """Raise InputError where the folder `path` for results is a file, or would lie below one."""
    whole = _named(path).absolute()
    # the path itself, or the nearest folder above it that exists
    there = next(each for each in (whole, *whole.parents) if os.path.lexists(each))
    if not there.is_dir():
        kind = "a file" if there.is_file() else "not a regular file"
        raise InputError(f"'{there}' is {kind}, expected a folder for the results in '{path}'")


def check_regular(path: Path | str, where: str, error: type[BipedError]) -> None:
    """Raise `error`, beginning with `where`, for a device or a pipe.

    A folder and a file that does not exist pass: to open them is an error with a better text.
    """
    try:
        mode = os.stat(path).st_mode
    except (OSError, ValueError):
        return
    system = os.path.realpath(path).startswith(("/proc/", "/sys/"))  # /proc/kmsg never ends
    if system or not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        raise error(f"{where} is not a regular file")


def beside(file: Path, name: object) -> Path:
    """The path of the file to which `file` refers by `name`, a path relative to the folder of `file`.

    Raises InputError for a path out of that folder, also by way of links.
    """
    path = file.parent / str(name)
    # `file` may be a link: its own folder, and that of the file to which it leads
    folders = {file.parent.resolve(), file.resolve().parent}
    if not any(path.resolve().is_relative_to(folder) for folder in folders):
        raise InputError(
            f"'{file}' names '{name}', expected one in its own folder or below; copy it there"
        )
    return path


def _named(path: object) -> Path:
    """Check a path as a name, whether or not it exists, and return it.

    Raises InputError for a name that no file may have, OutputError for one too long.
    """
    if not isinstance(path, str | os.PathLike) or CONTROL.search(str(path)):
        raise InputError(f"cannot write {path!r}, expected a file name without control characters")
    for part in Path(path).parts:
        # _LONGEST bytes, as file systems take 255
        if (size := len(os.fsencode(part))) > _LONGEST:
            raise OutputError(f"'{path}' has a name too long, {size} bytes of at most {_LONGEST}")
    if Path(path).parts[:1] == ("~",):
        raise InputError(f"cannot write '{path}' with its '~'; take Path('{path}').expanduser()")
    return Path(path)


def keep_inputs(outputs: Iterable[Path], inputs: Iterable[Path]) -> None:
    """Raise InputError if one of the files to write is also one that is read.

    Links are followed: another name of the same file is refused too.
    """
    outputs, inputs = tuple(outputs), tuple(inputs)
    for read in inputs:
        if any(_same(read, written) for written in outputs):
            written = " and ".join(f"'{path}'" for path in outputs)
            raise InputError(f"{written} would overwrite the input '{read}'; choose another name")


def _same(a: Path, b: Path) -> bool:
    """Whether two paths are one file; for files that do not exist yet, whether they would be."""
    try:
        return os.path.samefile(a, b)
    except OSError:
        return os.path.realpath(a) == os.path.realpath(b)


@contextmanager
def reading(what: str, path: Path | str, error: type[BipedError]) -> Iterator[None]:
    """Context in which a file is read: any exception is raised as `error`, with the name of the file.

    what: what the file is, such as "gait file". Missing files, wrong JSON or TOML, missing keys and values
    of a wrong type or shape are covered. An InputError raised inside keeps its text, behind the name of the
    file; a SingularError and a SimulationError pass unchanged.
    """
    where, kind = f"{what} '{path}'", Path(path).suffix[1:].upper()
    check_regular(path, where, error)
    try:
        yield
    except Exception as found:  # whatever damaged bytes may raise in a parser
        match found:
            case FileNotFoundError():
                why = " not found"
            case OSError():
                why = f" cannot be read: {found.strerror}"
            case json.JSONDecodeError() | tomllib.TOMLDecodeError() | UnicodeDecodeError():
                why = f" is not valid {kind}: {found}"
            case KeyError():
                why = f": the key {found} is missing"
            case TypeError() | ValueError() | AttributeError() | IndexError():
                why = f": {found}"
            case RecursionError():
                why = " is nested too deeply"
            case BipedError():  # SingularError, SimulationError; an InputError is also a ValueError, above
                raise
            case _:
                why = f" cannot be used, {type(found).__name__}: {found}"
        raise error(where + why) from found


class CsvTable(NamedTuple):
    """Content of a CSV file, as text; entries are without the blanks around them."""

    head: list[str]
    """Entries of the first line."""
    rows: list[tuple[int, list[str]]]
    """Each line below: its number in the file, and as many entries as the first line has."""

    @classmethod
    def read(cls, file: Path | str) -> Self:
        """Read a file; empty lines are left out. Raises InputError, with the number of the line, for one that
        has not as many entries as the first.
        """
        # utf-8-sig: spreadsheets put a mark of the byte order first
        with Path(file).open(newline="", encoding="utf-8-sig") as text:
            lines = csv.reader(text)
            rows = [(lines.line_num, [x.strip() for x in row]) for row in lines if row]
        head = rows[0][1] if rows else []
        for line, row in rows:
            if len(row) != len(head):
                raise InputError(f"line {line} has {len(row)} entries, not {len(head)}: {head}")
        return cls(head, rows[1:])

    def numbers(self, at: int) -> Array:
        """Numbers (K,) in the K rows of column `at`, which counts from 0.

        Raises InputError for one that is not finite, with line and column.
        """
        result = np.full(len(self.rows), math.nan)
        for k, (line, row) in enumerate(self.rows):
            with suppress(ValueError):
                result[k] = float(row[at])
            if not math.isfinite(result[k]):
                raise InputError(
                    f"line {line}, column '{self.head[at]}': found '{row[at]}', expected a finite number"
                )
        return result


def joint_columns(of: object, names: Mapping[str, str]) -> dict[str, Array]:
    """Split arrays (K, n), attributes of `of`, into a column (K,) for each of n joints, by the column's name.

    names: attribute -> name of its columns, such as "q{} [rad]", with {} for the joint's number from 1.
    """
    arrays = ((name, getattr(of, attribute)) for attribute, name in names.items())
    return {name.format(i): x for name, array in arrays for i, x in enumerate(array.T, 1)}


def write_csv(columns: Mapping[str, Any], path: Path | str) -> Path:
    """Write a CSV file of columns, name -> list or array of one length; returns the path.

    Floats have all their digits, so that they are read back to the last bit. A path without a suffix gets
    .csv. Raises InputError for another suffix, and OutputError where the file cannot be written.
    """
    target = output_path(path, (".csv",), default=True)
    lists = [x if isinstance(x, list) else x.tolist() for x in columns.values()]
    with replacing(target) as temporary, open(temporary, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*lists, strict=True))
    return target


def read_json(path: Path, what: str, error: type[BipedError] = InputError) -> Any:
    """Read the content of a JSON file, as dict, list, text, number or None.

    what: what the file should be, for the message. Raises `error` where it cannot be read or is no JSON.
    """
    with reading(what, path, error):
        return json.loads(path.read_text(encoding="utf-8"))


def write_json(record: Mapping[str, Any], path: Path) -> None:
    """Write a record as a JSON file, with a line for each key, so that two files are compared easily."""
    lines = (f'  "{key}": {json.dumps(value)}' for key, value in record.items())
    write_text(path, "{\n" + ",\n".join(lines) + "\n}\n")


def plain(value: object) -> Any:
    """Convert a value to types that JSON has, recursively.

    Dataclasses and NamedTuples become dicts by field, arrays and tuples become lists. JSON has no infinity and
    no NaN: such a number becomes the text "inf", "-inf" or "nan". Other values stay as they are.
    """
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


def one_line(text: str, keep: str = "") -> str:
    """The text on one line: characters that are not printable, such as line breaks, are escaped.

    keep: characters that stay as they are.
    """
    return "".join(x if x.isprintable() or x in keep else ascii(x)[1:-1] for x in text)


def c_comment(text: str) -> str:
    """The text as one line of ASCII for a comment of C: a blank parts "*/", "/*" and trigraphs ("??"), and a
    backslash, which would continue the line, is written as its code.
    """
    plain = one_line(text.replace("\\", "\\x5c")).encode("ascii", "backslashreplace").decode()
    return re.sub(r"(?<=\*)(?=/)|(?<=/)(?=\*)|(?<=\?)(?=\?)", " ", plain)


def xml_comment(text: str) -> str:
    """The text for a comment of XML: one line without two hyphens in a row, which XML forbids there."""
    return re.sub("(?<=-)(?=-)", " ", one_line(text))


def toml_key(name: str) -> str:
    """The name as a key of TOML, in quotes where it has other characters than letters, digits, _ and -."""
    return name if re.fullmatch("[A-Za-z0-9_-]+", name) else toml_value(name)


def toml_value(x: object) -> str:
    """The text of a plain value (`plain`) in TOML: floats are read back to the same bits; None is "none"."""
    if x is None:
        return toml_value("none")
    if isinstance(x, Mapping):
        inside = (f"{toml_key(key)} = {toml_value(value)}" for key, value in x.items())
        return "{ " + ", ".join(inside) + " }"
    if isinstance(x, list | tuple):
        return "[" + ", ".join(map(toml_value, x)) + "]"
    if isinstance(x, str | bool | int):  # TOML is stricter than JSON in one character
        return json.dumps(x, ensure_ascii=False).replace("\x7f", "\\u007f")
    return repr(float(x)) if isinstance(x, float) else repr(x)


def write_text(path: Path, text: str) -> None:
    """Write a text file (UTF-8) whole or not at all. Raises OutputError."""
    write_bytes(path, text.encode("utf-8"))


def write_bytes(path: Path, data: bytes) -> None:
    """Write a binary file whole or not at all. Raises OutputError."""
    with replacing(path) as temporary:
        temporary.write_bytes(data)


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Context with a temporary file beside `path` to write to, which replaces `path` at the end.

    The content is flushed to the disk (fsync) before the rename, and a rename within one folder is atomic, so
    `path` is at any time either the old file or the new one. Missing folders are made. Permissions are those
    of a new file under the user's umask, not the private ones of mkstemp. Raises OutputError; after any error
    the temporary file is removed and `path` is as it was.
    """
    temporary = None
    check_place(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        os.close(handle)
        temporary = Path(name)
        yield temporary
        with open(temporary, "rb") as file:
            os.fsync(file.fileno())
        umask = os.umask(0)  # the system tells it only to one who sets it
        os.umask(umask)
        os.chmod(temporary, 0o666 & ~umask)
        os.replace(temporary, path)
    except OSError as error:
        why = error.strerror or error
        raise OutputError(f"cannot write '{path}': {why}; choose another folder") from error
    finally:
        if temporary is not None:
            temporary.unlink(missing_ok=True)


_PACKAGE = Path(__file__).resolve().parents[1]


def data_folder(kind: str) -> Path:
    """Folder of the package's data of this kind, "urdf" or "gaits".

    Raises FileNotFoundError when neither the wheel nor the checkout has it.
    """
    # in a wheel, then in a checkout; _PACKAGE: folder of this package
    for candidate in (_PACKAGE / "_data" / kind, _PACKAGE.parent / kind):
        if candidate.is_dir():
            return candidate
    raise FileNotFoundError(f"no data folder '{kind}' is installed; reinstall with 'pip install .'")


def data_file(kind: str, *names: str) -> Path:
    """The path of a file in the package's data: names of folders, then of the file.

    Slashes, and dots alone, become "_": a name from a user leads to no file outside.
    """
    return data_folder(kind).joinpath(*(re.sub(r"[/\\]|^\.+$", "_", name) for name in names))


@cache
def packaged(package: str, name: str) -> dict[str, Any]:
    """Read the TOML file `name` in the folder of `package`, such as "biped_adrc.view"; it is read once.

    The dict is shared by all callers and must not be changed.
    """
    return tomllib.loads(files(package).joinpath(name).read_text("utf-8"))
