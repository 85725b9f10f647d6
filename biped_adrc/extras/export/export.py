"""A scenario's controller as a folder of C files: `ba.export_c`, and `biped-adrc export`.

    source = ba.export_c(ba.Scenario("ADRC", hardware="rabbit"), "onto-robot")

The folder has a header, a source, an example main.c, a Makefile, a README and the licence. A controller that
cannot be exported is an InputError with the name of the part that stands in the way.

*An FMU* is the controller as a functional mock-up unit of FMI 2.0, `controller.fmu`, whose steps other
simulators call:

    fmu = fmu_of(source)         # of a `Source`
    fmu.data                     # the bytes of the archive

The FMU is the exported C, unchanged, a wrapper with the functions of FMI, the description of its
ports, a page about it and the licence; and a binary, where there is a C compiler. The same
source and compiler give the same bytes.
"""

import hashlib
import io
import platform
import uuid
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import OutputError
from biped_adrc.core.files import write_bytes
from biped_adrc.extras.export.computer import Computer
from biped_adrc.extras.export.loaded import NO_COMPILER, build_c, compiler
from biped_adrc.extras.export.source import Source, rendered_c, source_of
from biped_adrc.scenario.build import build
from biped_adrc.scenario.scenario import Scenario, scenario_lines

MACHINES = {("Linux", "x86_64"): "linux64"}
"""(Operating system, processor) -> name that FMI 2.0 has for the folder of a binary."""
AS_READ = {True: "read at every step", False: "read at the first step only"}
"""Text in the FMU's description about a rate, by whether `step`, the C at a sample instant, reads it."""


class Port(NamedTuple):
    """An input or output of an FMU; its index in the list of `ports` is its value reference."""

    name: str
    """Name as in the header of the C."""
    kind: str
    """What it is; the template ports.j2 has, by kind, what FMI says of it."""
    words: str
    """Description of the port."""


class Fmu(NamedTuple):
    """The files of an FMU, by their path inside."""

    name: str
    """Name of the file."""
    files: Mapping[str, bytes]
    """Path inside the archive -> content."""

    def __repr__(self) -> str:
        return f"Fmu({self.name}: {', '.join(self.files)})"

    @property
    def data(self) -> bytes:
        """Bytes of the zip archive; they depend on the files alone and contain no date."""
        out = io.BytesIO()
        with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
            for path, data in self.files.items():
                entry = zipfile.ZipInfo(path)  # its date is 1980-01-01
                # Unix permissions rw-r--r--, which zip keeps in the upper 16 bits
                entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
                archive.writestr(entry, data)
        return out.getvalue()


def fmu_of(source: Source) -> Fmu:
    """Make the FMU of an exported controller, with a binary where this machine can compile it.

    Its identifier (GUID) is a hash of its text files. Raises InputError where the compiler reports an error,
    and OutputError where there is no room for its files.
    """
    # the hash is of the texts without an identifier; then they are made again with it
    texts = _texts(source, "")
    guid = uuid.UUID(bytes=hashlib.sha256("".join(texts.values()).encode()).digest()[:16])
    texts = _texts(source, f"{{{guid}}}")
    files = {path: text.encode() for path, text in texts.items()}
    if not without_binary():
        files[f"binaries/{_machine()}/{source.prefix}.so"] = _binary(source, texts)
    return Fmu(f"{source.prefix}.fmu", files)


def ports(source: Source) -> list[Port]:
    """The ports of an FMU, in the order of their value references: angles q and rates v of the n joints,
    torques u of the p motors, touchdown, flag.
    """
    # read: indices of the rates that the C reads at each sample instant; AS_READ has the text about that
    read, p = source.words["rates_read"], source.p
    numbered = list(enumerate(source.words["joints"]))  # index and name of each joint
    landed = "becomes true at the first sample after a touchdown, from which on q, v and u have the new labels"
    flag = (
        "0, or why the step has no result: 1 not measured, 2 no number; u is held, and zero later"
    )
    return [
        *(Port(f"q[{i}]", "angle", f"angle of {x}") for i, x in numbered),
        *(Port(f"v[{i}]", "rate", f"rate of {x}, {AS_READ[i in read]}") for i, x in numbered),
        *(Port(f"u[{i}]", "torque", f"torque of the motor of {x}") for i, x in numbered[:p]),
        Port("touchdown", "touchdown", landed),
        Port("flag", "flag", flag),
    ]


def _texts(source: Source, guid: str) -> dict[str, str]:
    """The text files of an FMU, by their path in the archive; guid: identifier in its modelDescription.xml."""
    P = source.prefix
    values = {**source.words, "guid": guid, "ports": ports(source)}
    return {
        "modelDescription.xml": rendered_c("modelDescription.xml", values),
        "documentation/index.html": rendered_c("index.html", values),
        "documentation/licenses/license.txt": source.files["LICENSE"],
        f"sources/{P}.c": source.files[f"{P}.c"],
        f"sources/{P}.h": source.files[f"{P}.h"],
        f"sources/{P}_fmi2.h": rendered_c("fmi2.h", values),
        f"sources/{P}_fmu.c": rendered_c("fmu.c", values),
    }


def without_binary() -> str:
    """The reason why an FMU that is made on this machine has no binary; empty where it has one."""
    if not _machine():
        return f"FMI 2.0 has no name for {platform.system()} on {platform.machine()}"
    return NO_COMPILER if compiler() is None else ""


def contents() -> str:
    """Text that says whether an FMU that is made on this machine has a binary or sources alone."""
    if why := without_binary():
        return f"sources alone, since {why}"
    return f"sources, and a binary for {_machine()}"


def _machine() -> str:
    """FMI 2.0's name for a folder of binaries of this machine; empty where it has none."""
    # MACHINES: (system, processor) -> FMI's name of the folder of a binary
    return MACHINES.get((platform.system(), platform.machine()), "")


def _binary(source: Source, texts: Mapping[str, str]) -> bytes:
    """Compile the sources of an FMU to a shared library; returns its bytes. texts: its files, by path."""
    files = {Path(path).name: text for path, text in texts.items() if path.startswith("sources/")}
    names = [f"{source.prefix}.c", f"{source.prefix}_fmu.c"]
    with build_c(files, names, "-shared", "-fPIC", "-fvisibility=hidden") as (library, _):
        return library.read_bytes()


def export_c(
    scenario: Scenario | Walker,
    folder: Path | str,
    prefix: str = "controller",
    real: str = "float64",
    fmu: bool = False,
) -> Source:
    """Write the controller of a scenario, or of a walker, as C99 into a folder; returns a `Source` with the
    files.

    scenario: in sampled time. folder: empty, or of an earlier export. prefix: of all names in C. real:
    "float64" or "float32". fmu: with a functional mock-up unit (FMU) for co-simulation by FMI 2.0 beside it,
    such as controller.fmu.

    Raises InputError for a scenario that cannot be exported, and OutputError for a folder that holds
    other files or cannot be written.

    >>> scenario = ba.Scenario("NPD", hardware={"period": 1e-3})
    >>> source = ba.export_c(scenario, folder / "c")
    >>> (folder / "c" / "controller.c").exists()
    True
    """
    check_part(scenario, "what is to be exported", Scenario, Walker)
    if isinstance(scenario, Walker):
        walker, lines = scenario, ["a walker of one's own"]
    else:
        walker, lines = build(scenario), scenario_lines(scenario)
    source, folder = source_of(Computer(walker), prefix, real, lines), Path(folder)
    write_folder(folder, source)
    if fmu:
        archive = fmu_of(source)
        write_bytes(folder / archive.name, archive.data)
    return source


def write_folder(folder: Path, source: Source) -> None:
    """Write the files of a source into a folder.

    The folder has to be new, empty, or have the same files from an earlier export, besides them at most the
    compiled program and the FMU. Raises OutputError for any other, so that a `main.c` that was changed by hand
    is not overwritten.
    """
    files = {name: text.encode() for name, text in source.files.items()}
    # what the Makefile and `export_c` make of the files
    built = ("main", f"{source.prefix}.fmu")
    try:
        result = sorted(folder.iterdir()) if folder.exists() else []
        others = [x.name for x in result if x.name not in built and not _same(x, files)]
    except OSError as error:
        sentence = f"cannot write to '{folder}': {error.strerror}; choose another name"
        raise OutputError(sentence) from error
    if others:
        raise OutputError(
            f"folder '{folder}' holds '{others[0]}', other than it would be written; choose a new or an "
            "empty folder"
        )
    for name, data in files.items():
        write_bytes(folder / name, data)


def _same(path: Path, files: Mapping[str, bytes]) -> bool:
    """Whether the path is a regular file with the name and content of one of `files`."""
    plain = path.is_file() and not path.is_symlink()
    return plain and path.name in files and path.read_bytes() == files[path.name]
