"""A scenario's controller as a folder of C files: `ba.export_c`, and `biped-adrc export`.

    source = ba.export_c(ba.Scenario("ADRC", hardware="rabbit"), "onto-robot")

The folder has a header, a source, an example main.c, a Makefile, a README and the licence. What
cannot be exported is refused with the part that stands in the way.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import OutputError
from biped_adrc.core.files import write_bytes
from biped_adrc.extras.export.computer import Computer
from biped_adrc.extras.export.fmu import fmu_of
from biped_adrc.extras.export.source import Source, source_of
from biped_adrc.scenario.build import build
from biped_adrc.scenario.scenario import Scenario, scenario_lines


def export_c(
    scenario: Scenario | Walker,
    folder: Path | str,
    prefix: str = "controller",
    real: str = "float64",
    fmu: bool = False,
) -> Source:
    """Write the controller of a scenario, or of a walker, as C99 into a folder; returns the files written.

    prefix: of all names in C. real: "float64" or "float32". fmu: with a functional mock-up unit (FMU) for
    co-simulation by FMI 2.0 beside it, such as controller.fmu.

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

    The folder is new, empty, or holds the same files and what is built from them. Raises OutputError for any
    other, so that a `main.c` that was changed by hand stays as it is.
    """
    files = {name: text.encode() for name, text in source.files.items()}
    built = ("main", f"{source.prefix}.fmu")
    try:
        result = sorted(folder.iterdir()) if folder.exists() else []
        others = [x.name for x in result if x.name not in built and not _same(x, files)]
    except NotADirectoryError:
        raise OutputError(f"'{folder}' is a file, expected the name of a folder") from None
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
