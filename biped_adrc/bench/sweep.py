"""A study from its file to its results: `sweep`, and what it leaves to look at.

Everything is checked before the first walk: the study, walks of points that stand for all, the workers, the
file that the results go to.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from biped_adrc.bench.build import files_of_study, hashes, own_of_study
from biped_adrc.bench.study import MOST_POINTS, Study, rehearse, too_many
from biped_adrc.bench.study_file import load_study
from biped_adrc.campaign.chunk import Function
from biped_adrc.campaign.execute import Progress, Summary, run_study
from biped_adrc.campaign.store import About, Result
from biped_adrc.campaign.store_open import open_store, read_store
from biped_adrc.campaign.workers import Workers, workers_of
from biped_adrc.errors import InputError
from biped_adrc.scenario.values import reason
from biped_adrc.shown import Shown
from biped_adrc.versions import numerical_versions

RESULTS = "results.sqlite"
"""In the folder of a sweep."""
PARAMETER = "parameter."
"""Put before a parameter whose name a column of results has too."""


@dataclass(frozen=True)
class Table(Shown):
    """Columns (N,) by name: floats, with NaN for none, where all values are numbers; else objects."""

    columns: Mapping[str, NDArray[Any]]

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self.columns:
            raise InputError(f"there is no column '{name}'; choose from {list(self.columns)}")
        return self.columns[name]

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), ()))

    def where(self, keep: NDArray[np.bool_] | Mapping[str, Any]) -> Table:
        """The rows of a mask (N,), or those that have these values, None for no value.

        Raises InputError for an unknown column.
        """
        mask = np.ones(len(self), dtype=bool)
        if isinstance(keep, Mapping):
            for name, x in keep.items():
                mask &= _equal(self[name], x)
        else:
            mask = keep
        return Table({name: column[mask] for name, column in self.columns.items()})


@dataclass(frozen=True)
class Sweep(Shown):
    """The results of a study, in its file; they are read when they are asked for."""

    path: Path
    study: Study
    summary: Summary | None = None

    def results(self) -> Iterator[Result]:
        """Of the points whose runs are finished, in the order of the study, a few at a time in memory."""
        with closing(read_store(self.path)) as store:
            yield from store.results()

    def rows(self) -> Iterator[dict[str, Any]]:
        """What is varied and the results of a point in one, by the names of `names`."""
        taken = set(self._of_rows())
        for result in self.results():
            at = {f"{PARAMETER}{k}" if k in taken else k: x for k, x in result.at.items()}
            yield at | result.row

    def names(self) -> list[str]:
        """Of all columns: what is varied, then the results."""
        found = self._of_rows()
        return [*(f"{PARAMETER}{k}" if k in found else k for k in self.study.varied), *found]

    def table(self, *names: str) -> Table:
        """These columns, or all, of the points that are finished. Raises InputError for an unknown one."""
        known = self.names()
        for name in names:
            if name not in known:
                raise InputError(f"the results have no column '{name}'; choose from {known}")
        columns: dict[str, list[Any]] = {name: [] for name in names or known}
        for row in self.rows():
            for name, column in columns.items():
                column.append(row.get(name))
        return Table({name: _array(column) for name, column in columns.items()})

    def statuses(self) -> dict[str, int]:
        """How many runs ended with each status."""
        with closing(read_store(self.path)) as store:
            return store.statuses()

    def no_walks(self) -> dict[str, str]:
        """What one run says of each status that is no walk, such as REFUSED."""
        with closing(read_store(self.path)) as store:
            return store.no_walks()

    def _of_rows(self) -> list[str]:
        found: dict[str, None] = {}
        for result in self.results():
            found |= dict.fromkeys(result.row)
        return list(found)


def sweep(
    study: Study | Path | str,
    out: Path | str,
    workers: Workers | Executor | int | None = None,
    *,
    function: Function | None = None,
    chunk: int | None = None,
    progress: Callable[[Progress], None] | None = None,
    other_versions: bool = False,
) -> Sweep:
    """Run what is not yet in the folder `out` of a study, from its file or as it is.

    workers: processes (one per core if None), `Threads`, `Cluster`, or any executor. function: what makes rows
    of records; walks if None. other_versions: go on with results of other versions.
    Raises InputError, OutputError, WorkersError; Ctrl-C leaves what is finished, and the same call goes on.
    """
    study = study if isinstance(study, Study) else load_study(study)
    if function is None:
        rehearse(study)
        from biped_adrc.bench.run import run_trials

        function = run_trials
    check_folder(out)
    path, crew = Path(out) / RESULTS, workers_of(workers)
    about = about_study(study, crew)
    crew.prepare()
    with open_store(path, about, other_versions) as store:
        summary = run_study(
            function,
            study.points(),
            store,
            crew,
            chunk=chunk,
            total=study.count,
            progress=progress,
        )
    return Sweep(path, study, summary)


def about_study(study: Study, crew: Workers) -> About:
    """What its results are of and made with, the files that it names included. Raises InputError."""
    if study.count > MOST_POINTS:
        raise InputError(f"study '{study.name}' {too_many(study)}")
    files = files_of_study(study)
    if files and crew.elsewhere:
        raise InputError(
            f"study '{study.name}' names the files {[str(path) for path in files]}, which workers elsewhere "
            "may not have, or have others; run it with processes or threads of this machine"
        )
    versions = {**numerical_versions(), **hashes(files), **own_of_study(study)}
    return About(study.name, study.hash, study.configuration(), versions, study.count)


def check_folder(out: Path | str) -> None:
    """Raises InputError for a file."""
    if Path(out).is_file():
        raise InputError(f"the results are to go to '{out}', which is a file; expected a folder")


def load_sweep(out: Path | str) -> Sweep:
    """The results in a folder, or in a file, finished or not. Raises InputError."""
    path = Path(out) / RESULTS if Path(out).is_dir() else Path(out)
    with closing(read_store(path)) as store:
        configuration = store.about.configuration
    try:
        return Sweep(path, Study.model_validate(configuration))
    except ValidationError as error:
        raise InputError(
            f"the results file '{path}' holds no study of this program: {reason(error)}"
        ) from error


def _equal(column: NDArray[Any], x: Any) -> NDArray[np.bool_]:
    """Rows with this value; NaN in a column of numbers is no value."""
    if x is not None:
        return np.asarray(column == x, dtype=bool)
    if column.dtype == object:
        return np.array([value is None for value in column], dtype=bool)
    return np.asarray(column != column, dtype=bool)


def _array(values: list[Any]) -> NDArray[Any]:
    """Ints where all are, floats where all are numbers or None, else objects."""
    if values and all(type(x) is int for x in values):
        return np.array(values)
    if all(x is None or isinstance(x, (int, float)) for x in values):
        return np.array([np.nan if x is None else float(x) for x in values])
    column = np.empty(len(values), dtype=object)
    column[:] = values
    return column
