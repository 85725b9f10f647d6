"""Machine code of modules in LLVM's language, kept on disk with checksums.

Last stage of the compiler that makes machine code of methods, such as a controller's. Object code is stored
under the hash of the text and of what compiles it; other stages store texts in the same way (`from_disk`).
A file is written under another name and then renamed, so several processes may make the same one; a damaged
file is made again, and where nothing can be written code is made in memory each time.
"""

import hashlib
import os
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from llvmlite import binding
from platformdirs import user_cache_path

from biped_adrc.core.errors import OutputError
from biped_adrc.core.files import write_bytes

CHECK = 32
"""Number of bytes of the checksum (SHA-256) with which a file begins."""
LOCK = threading.RLock()
"""Held by the one thread that compiles or loads."""


@dataclass(frozen=True)
class Code:
    """Functions of a module in LLVM's language; machine code is made when the first address is asked for, since
    a page (`extras.play.webassembly`) needs the text alone."""

    text: str
    """The module in LLVM's language."""
    names: tuple[str, ...]
    """Names of its functions that are called from outside."""
    optimised: bool = False
    """Whether LLVM's passes run; see `object_code`."""

    @cached_property
    def addresses(self) -> dict[str, int]:
        """Address of each function, by its name; it stays in memory until the process ends."""
        return load_or_compile(self.text, self.names, self.optimised)


def load_or_compile(text: str, names: Sequence[str], optimised: bool = False) -> dict[str, int]:
    """Addresses of the functions `names` of a module in LLVM's language: loaded from the disk if its object
    code is there, else compiled and stored.

    optimised: whether LLVM's passes run. One thread at a time does it, so no two compile the same module;
    another process may do so, and then writes the same file.
    """

    def code() -> bytes:
        host = _target()
        return object_code(parsed(text, host), host, optimised)

    with LOCK:
        found = from_disk(hash_of(text, str(optimised)), code)
        # the engine wants a module of its own, which is empty; the functions come with the object file
        engine = binding.create_mcjit_compiler(binding.parse_assembly(""), _target())
        engine.add_object_file(binding.ObjectFileRef.from_data(found))
        engine.finalize_object()
        # never freed: runs hold addresses of their functions
        _ENGINES.append(engine)
        return {name: int(engine.get_function_address(name)) for name in names}


def hash_of(*made_from: str) -> str:
    """Hash of these texts, of this processor with its instructions, and of the version of LLVM, by which a file
    is named: 32 hexadecimal digits."""
    parts = (*made_from, *_host(), str(binding.llvm_version_info))
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:32]


def _host() -> tuple[str, str]:
    """Name and instructions of this processor, in LLVM's words."""
    return binding.get_host_cpu_name(), binding.get_host_cpu_features().flatten()


def _target() -> binding.TargetMachine:
    """LLVM's target machine for this processor, a new one each time: LLVM's engine for code in memory (MCJIT)
    owns the one that it is given.
    """
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    cpu, features = _host()
    target = binding.Target.from_default_triple()
    return target.create_target_machine(cpu=cpu, features=features, opt=3, jit=True)


def parsed(text: str, machine: binding.TargetMachine) -> binding.ModuleRef:
    """The module of a text in LLVM's language, checked for syntax, for this target machine."""
    module = binding.parse_assembly(text)
    module.triple, module.data_layout = machine.triple, str(machine.target_data)
    return module


def object_code(
    module: binding.ModuleRef, machine: binding.TargetMachine, optimised: bool = False
) -> bytes:
    """Object code of a module for this target machine.

    optimised: whether `run_passes` runs before, with vectors, as for products with matrices. Other traced
    functions are one straight line in which each expression stands once: passes would take a third of the time
    and change nothing; in the text of the march they are done already (`kernels.write`). No fast-math flags, so
    sums keep their order.
    """
    module.verify()
    if optimised:
        run_passes(module, machine, vectors=True)
    return bytes(machine.emit_object(module))


def run_passes(module: binding.ModuleRef, machine: binding.TargetMachine, vectors: bool) -> None:
    """Run LLVM's passes of level 3 over a module. vectors: whether they join like operations into vector
    instructions and unroll loops, as suits this target machine alone.
    """
    tuning = binding.create_pipeline_tuning_options(speed_level=3)
    tuning.slp_vectorization = tuning.loop_vectorization = tuning.loop_unrolling = vectors
    if not vectors:  # LLVM's own limit, 250, makes the text half as long again, and no walk quicker
        tuning.inlining_threshold = 40
    builder = binding.create_pass_builder(machine, tuning)
    builder.getModulePassManager().run(module, builder)


_ENGINES: list[object] = []
"""LLVM's engines, never freed: runs hold addresses of their functions."""


def _path(key: str) -> Path:
    """The file of what is stored under `key`.

    Code in it is executed, so the folder has to be the user's own: raises OSError for a relative path, which
    could lead into a folder of somebody else's files.
    """
    # VARIABLE: name of the environment variable that states another folder
    named = os.environ.get(VARIABLE, "").strip()
    folder = Path(named or user_cache_path("biped_adrc", appauthor=False))
    if not folder.is_absolute():
        raise OSError(f"'{folder}' is relative")
    return folder / "code" / f"{key}.bin"


def from_disk(key: str, make: Callable[[], bytes]) -> bytes:
    """The object code or text stored on disk under `key`; where it is not there, or its checksum is wrong, what
    make() gives, which is then stored, if that is possible.

    The checksum covers the key too, so a file under a wrong name is noticed.
    """
    with suppress(OSError):
        data = _path(key).read_bytes()
        # CHECK: bytes of the checksum at the beginning of the file
        check, code = data[:CHECK], data[CHECK:]
        if hashlib.sha256(key.encode() + code).digest() == check:
            return code
    code = make()
    with suppress(OSError, OutputError):
        write_bytes(_path(key), hashlib.sha256(key.encode() + code).digest() + code)
    return code


VARIABLE = "BIPED_ADRC_CACHE"
"""Environment variable: the folder of generated code, by default biped_adrc in the user's cache."""
