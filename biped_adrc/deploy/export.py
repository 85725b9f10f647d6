"""A scenario's controller as a folder of C files: `ba.export_c`, and `biped-adrc export`.

    source = ba.export_c(ba.Scenario("ADRC", hardware="rabbit"), "onto-robot")

The folder has a header, a source, an example main.c, a Makefile, a README and the licence. What
cannot be exported is refused with the part that stands in the way.
"""

from __future__ import annotations

from pathlib import Path

from biped_adrc.bench.scenario_file import scenario_lines
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.fmu import Fmu, fmu_of
from biped_adrc.deploy.source import Source, source_of
from biped_adrc.errors import OutputError
from biped_adrc.files import write_bytes
from biped_adrc.parts import check_part
from biped_adrc.scenario.build import build
from biped_adrc.scenario.scenario import Scenario


def export_c(
    scenario: Scenario | Walker,
    folder: Path | str,
    prefix: str = "controller",
    real: str = "float64",
    fmu: bool = False,
) -> Source:
    """Write the controller of a scenario, or of a walker, as C99 into a folder, and hand out what was written.

    prefix: of all names in C. real: "float64" or "float32". fmu: with a functional mock-up
    unit (FMU) for co-simulation by FMI 2.0 beside it, such as controller.fmu.

    Raises InputError for a scenario that cannot be exported, and OutputError for a folder that holds
    other files or cannot be written.
    """
    check_part(scenario, "what is to be exported", Scenario, Walker)
    if isinstance(scenario, Walker):
        walker, lines = scenario, ["a walker of one's own"]
    else:
        walker, lines = build(scenario), scenario_lines(scenario)
    source = source_of(Computer(walker), prefix, real, lines)
    write_folder(Path(folder), source, fmu_of(source) if fmu else None)
    return source


def write_folder(folder: Path, source: Source, fmu: Fmu | None = None) -> None:
    """Write the files into a folder that is new, empty, or holds the same files alone; an FMU is replaced.

    Raises OutputError for any other, so that a `main.c` that was changed by hand stays as it is.
    """
    if folder.exists() and not folder.is_dir():
        raise OutputError(f"'{folder}' is a file, expected the name of a folder")
    files = {name: text.encode() for name, text in source.files.items()}
    files |= {fmu.name: fmu.data} if fmu else {}
    found = sorted(folder.iterdir()) if folder.exists() else []
    built = fmu.name if fmu else None  # a compiler's result, which nobody changes by hand
    others = [
        x.name
        for x in found
        if x.name != built
        and (x.name not in files or x.is_dir() or x.read_bytes() != files[x.name])
    ]
    if others:
        raise OutputError(
            f"folder '{folder}' holds '{others[0]}', other than it would be written; choose a new or an "
            "empty folder"
        )
    for name, data in files.items():
        write_bytes(folder / name, data)
