"""Machine code of generated functions, kept on disk with a checksum.

Object code is stored under a hash of what it was made from and of what makes it; a damaged file is made again,
and where nothing can be written it is made in memory each time.
"""

from __future__ import annotations

import hashlib
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

from biped_adrc.engine.store import cache_folder
from biped_adrc.errors import OutputError
from biped_adrc.files import write_bytes

CHECK = 32
"""Bytes of the checksum before the object code."""
_LOCK = threading.Lock()


@dataclass(frozen=True)
class Machine:
    """Functions in memory; they live as long as `owner` does."""

    addresses: dict[str, int]
    owner: Any


_LOADED: dict[str, Machine] = {}
"""By key, what is in memory."""


class Text(NamedTuple):
    """A module in LLVM's language."""

    text: str
    vectors: bool = False
    """Whether to look for operations that go together in vectors, which takes its time."""


def machine(key: str, names: Sequence[str], text: Callable[[], Text]) -> Machine:
    """The functions `names` stored under `key`, or compiled from `text()`."""
    with _LOCK:
        code = stored(key)
        if code is None:
            code = compiled(*text())
            keep(key, code)
        return loaded(code, names)


def remembered(key: str, names: Sequence[str], text: Callable[[], Text]) -> Machine:
    """As `machine`, once per process."""
    if key not in _LOADED:
        _LOADED[key] = machine(key, names, text)
    return _LOADED[key]


def processor() -> str:
    """What the code is made for: the processor, its instructions, and LLVM."""
    from llvmlite import binding

    features = binding.get_host_cpu_features().flatten()
    return f"{binding.get_host_cpu_name()} {features} {binding.llvm_version_info}"


@lru_cache(maxsize=1)
def target() -> Any:
    """LLVM's machine for this processor."""
    from llvmlite import binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    return binding.Target.from_default_triple().create_target_machine(
        cpu=binding.get_host_cpu_name(),
        features=binding.get_host_cpu_features().flatten(),
        opt=3,
        jit=True,
    )


def compiled(text: str, vectors: bool = False) -> bytes:
    """Object code of a module in LLVM's language."""
    from llvmlite import binding

    machine = target()
    module = binding.parse_assembly(text)
    module.triple, module.data_layout = machine.triple, str(machine.target_data)
    module.verify()
    tuning = binding.create_pipeline_tuning_options(speed_level=3)
    tuning.slp_vectorization = vectors
    builder = binding.create_pass_builder(machine, tuning)
    builder.getModulePassManager().run(module, builder)
    return bytes(machine.emit_object(module))


def loaded(code: bytes, names: Sequence[str]) -> Machine:
    """Object code in memory."""
    from llvmlite import binding

    target()
    engine = binding.create_mcjit_compiler(binding.parse_assembly(""), _another_target())
    engine.add_object_file(binding.ObjectFileRef.from_data(code))
    engine.finalize_object()
    addresses = {name: int(engine.get_function_address(name)) for name in names}
    return Machine(addresses, engine)


def _another_target() -> Any:
    """MCJIT owns the machine that it is given."""
    from llvmlite import binding

    return binding.Target.from_default_triple().create_target_machine(opt=3, jit=True)


def _path(key: str) -> Path:
    return cache_folder() / "code" / f"{key}.bin"


def stored(key: str) -> bytes | None:
    """Object code from the disk; None when it is not there or damaged."""
    try:
        data = _path(key).read_bytes()
    except OSError:
        return None
    check, code = data[:CHECK], data[CHECK:]
    return code if hashlib.sha256(key.encode() + code).digest() == check else None


def keep(key: str, code: bytes) -> None:
    """Write object code where that is possible."""
    try:
        write_bytes(_path(key), hashlib.sha256(key.encode() + code).digest() + code)
    except (OSError, OutputError):
        return
