"""Machine code of generated functions and modules, kept on disk with checksums.

Last stage of the compiler. Two kinds of code are kept in `cache_folder()`:

Functions (from `engine.ir`): object code is stored under the hash of their text and of what compiles
it; a damaged file is made again, and where nothing can be written it is made in memory
each time.

Modules (the loops of `engine.kernels`, compiled by numba): one folder per hash of the source and of
what compiles it. Files are written beside and moved into place, so several processes may make the
same one. What cannot be written is kept in a temporary folder; what is damaged is written again.
numba keeps its machine code beside the source and does not check it; `note_checksums` adds one to
each of its files, and those without the right one are removed before they are read.
"""

from __future__ import annotations

import atexit
import hashlib
import os
import platform
import shutil
import sys
import tempfile
import threading
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

from llvmlite import binding
from platformdirs import user_cache_path

from biped_adrc.errors import OutputError
from biped_adrc.files import write_bytes, write_text
from biped_adrc.versions import packages

CHECK = 32
"""Bytes of the checksum before the object code."""
_LOCK = threading.Lock()
"""One thread at a time compiles or loads."""


@dataclass(frozen=True)
class LoadedCode:
    """Functions in memory; they live as long as `owner` does."""

    addresses: dict[str, int]
    """By name."""
    owner: object
    """LLVM's engine."""
    text: str = ""
    """What they were made from, in LLVM's language."""


class ModuleText(NamedTuple):
    """A module in LLVM's language."""

    text: str
    """The module itself."""
    vectors: bool = False
    """Whether to look for operations that go together in vectors, which takes its time."""


def load_or_compile(text: ModuleText, names: Sequence[str]) -> LoadedCode:
    """The functions `names` of a module, from the disk where its object code is, or compiled and stored.

    One thread at a time, so that no two of them compile the same; other processes may, and write
    the same file.
    """
    made_from = "\0".join((text.text, str(text.vectors), processor()))
    key = hashlib.sha256(made_from.encode()).hexdigest()[:32]
    with _LOCK:
        code = stored(key)
        if code is None:
            code = compiled(*text)
            keep(key, code)
        return replace(loaded(code, names), text=text.text)


def processor() -> str:
    """What the code is made for: the processor, its instructions, and LLVM's version."""
    features = binding.get_host_cpu_features().flatten()
    return f"{binding.get_host_cpu_name()} {features} {binding.llvm_version_info}"


def target() -> binding.TargetMachine:
    """LLVM's target machine for this processor, a new one each time: MCJIT owns the one that it is given."""
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    return binding.Target.from_default_triple().create_target_machine(
        cpu=binding.get_host_cpu_name(),
        features=binding.get_host_cpu_features().flatten(),
        opt=3,
        jit=True,
    )


def compiled(text: str, vectors: bool = False) -> bytes:
    """Object code of a module in LLVM's language, optimised for this processor at level 3.

    No fast-math flags: sums keep their order. vectors: look for operations that go together (SLP),
    which helps `matvec` and takes its time elsewhere.
    """
    host = target()
    module = binding.parse_assembly(text)
    module.triple, module.data_layout = host.triple, str(host.target_data)
    module.verify()
    tuning = binding.create_pipeline_tuning_options(speed_level=3)
    tuning.slp_vectorization = vectors
    builder = binding.create_pass_builder(host, tuning)
    builder.getModulePassManager().run(module, builder)
    return bytes(host.emit_object(module))


def loaded(code: bytes, names: Sequence[str]) -> LoadedCode:
    """Object code in memory, with the addresses of these functions."""
    engine = binding.create_mcjit_compiler(binding.parse_assembly(""), target())
    engine.add_object_file(binding.ObjectFileRef.from_data(code))
    engine.finalize_object()
    addresses = {name: int(engine.get_function_address(name)) for name in names}
    return LoadedCode(addresses, engine)


def _path(key: str) -> Path:
    """File of the object code stored under `key`."""
    return cache_folder() / "code" / f"{key}.bin"


def stored(key: str) -> bytes | None:
    """Object code from the disk; None when it is not there or its checksum is wrong.

    The checksum covers the key too, so a file under a wrong name is noticed.
    """
    try:
        data = _path(key).read_bytes()
    except OSError:
        return None
    check, code = data[:CHECK], data[CHECK:]
    return code if hashlib.sha256(key.encode() + code).digest() == check else None


def keep(key: str, code: bytes) -> None:
    """Write object code with its checksum, where that is possible."""
    with suppress(OSError, OutputError):
        write_bytes(_path(key), hashlib.sha256(key.encode() + code).digest() + code)


VARIABLE = "BIPED_ADRC_CACHE"
"""Environment variable: the folder of generated modules, by default biped_adrc in the user's cache."""

MARK = ".sha256"
"""Ending of the file with the checksum of another file."""


def cache_folder() -> Path:
    """Where generated code is kept; an empty variable counts as none.

    What lies there is executed: a folder that is relative, and may have come with other files, is not used.
    """
    named = os.environ.get(VARIABLE, "").strip()
    folder = Path(named or user_cache_path("biped_adrc", appauthor=False))
    return folder if folder.is_absolute() else _temporary()


def key_of(source: str) -> str:
    """Hash of the source, of numba, llvmlite, NumPy and Python, and of the processor.

    What is compiled for one processor may use instructions that another has not.
    """
    made_by = packages(("numba", "llvmlite", "numpy")).values()
    platform_text = platform.python_version(), platform.machine(), platform.processor()
    return hashlib.sha256("\0".join((source, *made_by, *platform_text)).encode()).hexdigest()[:24]


def load_source(source: str) -> ModuleType:
    """The module with this source, from the disk if it is there and undamaged; numba compiles it when asked.

    Where the cache folder cannot be written, a temporary one takes its place.
    """
    key = key_of(source)
    try:
        path = _written(cache_folder() / key / "kernels.py", source)
    except (OSError, OutputError):
        path = _written(_temporary() / key / "kernels.py", source)
    _remove_damaged(path.parent)
    module = ModuleType(f"biped_adrc_kernels_{key}")
    module.__file__ = str(path)
    sys.modules[module.__name__] = module  # numba finds the module of its machine code by name
    exec(compile(source, path, "exec"), vars(module))
    return module


def note_checksums(module: ModuleType) -> None:
    """Write the checksums of what numba keeps of a module, once it is compiled, where that is possible."""
    for path in _machine_code(Path(str(module.__file__)).parent):
        with suppress(OSError, OutputError):  # another process may remove it
            check, mark = _checksum(path), path.with_name(path.name + MARK)
            if not (mark.is_file() and mark.read_bytes() == check):
                write_bytes(mark, check)


def _remove_damaged(folder: Path) -> None:
    """Remove numba's files without the right checksum."""
    for path in _machine_code(folder):
        mark = path.with_name(path.name + MARK)
        with suppress(OSError):
            if not (mark.is_file() and mark.read_bytes() == _checksum(path)):
                path.unlink()


def _machine_code(folder: Path) -> list[Path]:
    """The files that numba keeps beside a module: index (.nbi) and code (.nbc)."""
    return [path for path in (folder / "__pycache__").glob("*.nb[ic]") if path.is_file()]


def _checksum(path: Path) -> bytes:
    """Of name and content, so that exchanged files are noticed too."""
    return hashlib.sha256(path.name.encode() + path.read_bytes()).hexdigest().encode()


def _written(path: Path, source: str) -> Path:
    """The file with this text; where it has another one it is rewritten, without the machine code beside it.

    Raises OSError for a folder that is read-only, where numba could not keep its code.
    """
    found = path.read_text(encoding="utf-8", errors="replace") if path.is_file() else None
    if found != source:
        shutil.rmtree(path.parent / "__pycache__", ignore_errors=True)
        write_text(path, source)
    if not os.access(path.parent, os.W_OK):
        raise OSError(f"'{path.parent}' is read-only")
    return path


@lru_cache(maxsize=1)
def _temporary() -> Path:
    """A folder for this process alone, removed when it ends."""
    folder = Path(tempfile.mkdtemp(prefix="biped_adrc-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder
