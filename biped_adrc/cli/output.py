"""Names of what a command writes, looked at before anything is computed; and writing a run."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from biped_adrc.cli.app import console
from biped_adrc.files import keep_inputs, output_path

FIGURES, GAITS = (".png", ".svg"), (".json",)


def inputs(robot: str, *others: str) -> tuple[Path, ...]:
    """The files that a robot and gaits are read from; none for names. Raises ModelError."""
    from biped_adrc.model.robots import load_description

    files = tuple(path for path in map(Path, (robot, *others)) if path.is_file())
    return (*files, load_description(robot).urdf)


def run_path(out: Path | None, read: Iterable[Path]) -> Path | None:
    """Where a run goes. Raises InputError for a name that is no run's or that is read, and OutputError."""
    from biped_adrc.hybrid.storage import check_beside, run_files

    if out is None:
        return None
    path = output_path(out, (".npz", ".mat"), default=True)
    if path.suffix.lower() == ".mat":
        keep_inputs((path,), read)
        return path
    path, beside = run_files(path)
    keep_inputs((path, beside), read)
    check_beside(beside)
    return path


def say_written(path: Path | None) -> None:
    """The name as it is."""
    if path is not None:
        console.print(f"written to {path}", markup=False, highlight=False, soft_wrap=True)
