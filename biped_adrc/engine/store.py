"""Generated modules on disk: one folder per hash of the source and of what compiles it.

Files are written beside and moved into place, so several processes may make the same one. What cannot be
written is kept in a temporary folder; what is damaged is written again. numba keeps its machine code beside;
`seal` adds a checksum to each of its files, and those without the right one are removed before they are read.
"""

from __future__ import annotations

import atexit
import hashlib
import importlib.util
import os
import platform
import shutil
import sys
import tempfile
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from types import ModuleType

from platformdirs import user_cache_path

from biped_adrc.errors import OutputError
from biped_adrc.files import write_text

VARIABLE = "BIPED_ADRC_CACHE"
"""Environment variable: the folder of generated modules, by default biped_adrc in the user's cache."""

MARK = ".sha256"
"""Ending of the file with the checksum of another."""


def cache_folder() -> Path:
    """Where generated modules are kept; an empty variable counts as none."""
    return Path(os.environ.get(VARIABLE) or user_cache_path("biped_adrc", appauthor=False))


def key_of(source: str) -> str:
    """Hash of the source, of numba, llvmlite, NumPy and Python, and of the processor."""
    import llvmlite
    import numba
    import numpy as np

    parts = (
        source,
        numba.__version__,
        llvmlite.__version__,
        np.__version__,
        platform.python_version(),
        platform.machine(),
        platform.processor(),
    )
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:24]


def load_source(source: str) -> ModuleType:
    """The module with this source, from the disk if it is there and undamaged."""
    key = key_of(source)
    try:
        path = _written(cache_folder() / key / "kernels.py", source)
    except (OSError, OutputError):
        path = _written(_temporary() / key / "kernels.py", source)
    _remove_unsealed(path.parent)
    spec = importlib.util.spec_from_file_location(f"biped_adrc_kernels_{key}", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # numba finds the module of its machine code by name
    spec.loader.exec_module(module)
    return module


def seal(module: ModuleType) -> None:
    """Note the checksums of what numba has written for a module, once it is compiled."""
    for path in _machine_code(Path(str(module.__file__)).parent):
        check = _checksum(path)
        mark = path.with_name(path.name + MARK)
        if not (mark.is_file() and mark.read_text() == check):
            with suppress(OSError, OutputError):
                write_text(mark, check)


def _remove_unsealed(folder: Path) -> None:
    for path in _machine_code(folder):
        mark = path.with_name(path.name + MARK)
        with suppress(OSError):
            if not (mark.is_file() and mark.read_text() == _checksum(path)):
                path.unlink()


def _machine_code(folder: Path) -> list[Path]:
    return [path for path in (folder / "__pycache__").glob("*.nb[ic]") if path.is_file()]


def _checksum(path: Path) -> str:
    return hashlib.sha256(path.name.encode() + path.read_bytes()).hexdigest()


def forget(module: ModuleType) -> None:
    """Remove the machine code numba keeps of a module, where it cannot be used."""
    shutil.rmtree(Path(str(module.__file__)).parent / "__pycache__", ignore_errors=True)


def _written(path: Path, source: str) -> Path:
    """The file with this text; rewritten, without the machine code beside it, when it has another one."""
    found = path.read_text(encoding="utf-8", errors="replace") if path.is_file() else None
    if found != source:
        shutil.rmtree(path.parent / "__pycache__", ignore_errors=True)
        write_text(path, source)
    if not os.access(path.parent, os.W_OK):
        raise OSError(f"'{path.parent}' is read-only")
    return path


@lru_cache(maxsize=1)
def _temporary() -> Path:
    folder = Path(tempfile.mkdtemp(prefix="biped_adrc-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder
