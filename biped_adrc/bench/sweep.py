"""A study carried out, from its file to its table of results: `sweep`, `load_sweep` and what they return.

Order of what is done: the study is read and rehearsed, the folder and the workers are checked, the results
file is opened (and locked), and only then the first walk starts. Whatever can fail without a walk fails
before it. Results stay in the SQLite file; `Sweep` reads them when it is asked, a few rows at a time, so that a
study may be larger than memory. `Sweep.table` alone loads columns as arrays.

Calls `campaign.execute.run_study` with `bench.run.run_trials`; called by the command `sweep` and by scripts of
the user, and read by `bench.export`.

In a script, which worker processes import, so that it needs the main guard:

    if __name__ == "__main__":
        found = sweep("study.toml", "out/study", workers=4)
        rows = found.table("delay", "survived", "peak_error").where({"survived": 1})
        print(rows["peak_error"].max())
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from biped_adrc.bench.build import files_of_study, hashes, own_of_study, plants_of_study
from biped_adrc.bench.parameters import reason
from biped_adrc.bench.study import MOST_POINTS, Study, rehearse, too_many
from biped_adrc.bench.study_file import load_study
from biped_adrc.campaign.chunk import Function
from biped_adrc.campaign.execute import Progress, Summary, run_study
from biped_adrc.campaign.store import About, Result, open_store, read_store
from biped_adrc.campaign.workers import Crew, Workers, workers_of
from biped_adrc.errors import InputError
from biped_adrc.files import check_folder
from biped_adrc.scenario.registry import read_from_a_file
from biped_adrc.shown import Shown
from biped_adrc.versions import numerical_versions

RESULTS = "results.sqlite"
"""Name of the results file in the folder of a sweep."""
PARAMETER = "parameter."
"""Put before the name of a varied parameter that a column of results has too, such as "parameter.friction"."""


@dataclass(frozen=True)
class Table(Shown):
    """Columns of results by name, each of shape (N,), one row for each finished point.

    A column of whole numbers is an array of ints; other numbers are floats with NaN for no value; anything else
    (texts, mixtures) is an array of objects with None for no value.
    """

    columns: Mapping[str, NDArray[np.generic]]

    def __getitem__(self, name: str) -> NDArray[np.generic]:
        """One column, (N,). Raises InputError, with the names there are, for an unknown one."""
        if name not in self.columns:
            raise InputError(f"there is no column '{name}'; choose from {list(self.columns)}")
        return self.columns[name]

    def __len__(self) -> int:
        """The number of rows N."""
        return len(next(iter(self.columns.values()), ()))

    def where(self, keep: NDArray[np.bool_] | Mapping[str, object]) -> Table:
        """The rows of a boolean mask (N,), or those with all of these values by column; None asks for "no
        value".

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
    """The results of a study in its file, finished or not; they are read each time they are asked for."""

    path: Path
    """The SQLite file of results."""
    study: Study
    """The study that it holds."""
    summary: Summary | None = None
    """What the call that made this did: points, fresh runs, workers that died; None where it was
    only loaded.
    """

    def results(self) -> Iterator[Result]:
        """Finished points in the order of the study, with their rows; a few at a time in memory."""
        with closing(read_store(self.path)) as store:
            yield from store.results()

    def rows(self) -> Iterator[dict[str, object]]:
        """For each finished point its varied values and its results in one mapping, with the keys
        of `names`.
        """
        taken = set(self._of_rows())
        for result in self.results():
            at = {f"{PARAMETER}{k}" if k in taken else k: x for k, x in result.at.items()}
            yield at | result.row

    def names(self) -> list[str]:
        """All columns: what is varied, then the results. A parameter of the same name as a result gets
        `PARAMETER`.
        """
        found = self._of_rows()
        return [*(f"{PARAMETER}{k}" if k in found else k for k in self.study.varied), *found]

    def table(self, *names: str) -> Table:
        """These columns of the finished points, or all columns, in memory. Raises InputError for an unknown
        one.
        """
        known = self.names()
        for name in names:
            if name not in known:
                raise InputError(f"the results have no column '{name}'; choose from {known}")
        columns: dict[str, list[object]] = {name: [] for name in names or known}
        for row in self.rows():
            for name, column in columns.items():
                column.append(row.get(name))
        return Table({name: _array(column) for name, column in columns.items()})

    def statuses(self) -> dict[str, int]:
        """The number of runs by status: how walks ended, or REFUSED, RAISED, CRASHED."""
        with closing(read_store(self.path)) as store:
            return store.statuses()

    def no_walks(self) -> dict[str, str]:
        """For each status that is no walk, such as REFUSED, the explanation of one such run."""
        with closing(read_store(self.path)) as store:
            return store.no_walks()

    def _of_rows(self) -> list[str]:
        """Names of the columns of results, in the order in which they first appear."""
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
) -> Sweep:
    """Run all points of a study whose results are not yet in the folder `out`; returns all of its results.

    study: a `Study`, or the name of its file. workers: processes (one per core if None), `Threads`, `Cluster`,
    or any executor. function: what makes rows of records, walks if None. chunk: runs handed to a worker at
    once; it changes no number. progress: called now and then. Raises InputError, OutputError, WorkersError.
    After Ctrl-C what is finished is kept, and the same call goes on.
    """
    study = study if isinstance(study, Study) else load_study(study)
    if function is None:
        rehearse(study)
        from biped_adrc.bench.run import run_trials

        function = run_trials
    check_folder(out)
    path, asked = Path(out) / RESULTS, workers_of(workers)
    about = about_study(study, asked)
    with Crew(asked) as crew, open_store(path, about) as store:
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


def about_study(study: Study, workers: Workers) -> About:
    """What is stored to recognise a study: its hash, configuration, and the versions of all its numbers depend
    on.

    The contents of robot and gait files and the source of the user's classes count as versions. Raises
    InputError for too many points, or files that workers on other machines may not have.
    """
    if study.count > MOST_POINTS:
        raise InputError(f"study '{study.name}' {too_many(study)}")
    files = files_of_study(study)
    if files and workers.elsewhere:
        raise InputError(
            f"study '{study.name}' names the files {[str(path) for path in files]}, which workers elsewhere "
            "may not have, or have others; run it with processes or threads of this machine"
        )
    of_parts = own_of_study(study) | plants_of_study(study)
    versions = {**numerical_versions(), **hashes(files), **of_parts}
    return About(study.name, study.hash, study.configuration(), versions)


def load_sweep(out: Path | str) -> Sweep:
    """The results in a folder, or in a file, finished or not. Raises InputError where there are none."""
    path = Path(out) / RESULTS if Path(out).is_dir() else Path(out)
    with closing(read_store(path)) as store:
        configuration = store.about.configuration
    try:
        with read_from_a_file():
            return Sweep(path, Study.model_validate(configuration))
    except ValidationError as error:
        raise InputError(
            f"the results file '{path}' holds no study of this program: {reason(error)}"
        ) from error


def _equal(column: NDArray[np.generic], x: object) -> NDArray[np.bool_]:
    """Mask (N,) of the rows with this value; None asks for no value, which is NaN in a column of numbers."""
    if x is not None:
        return np.asarray(column == x, dtype=bool)
    if column.dtype == object:
        return np.array([value is None for value in column], dtype=bool)
    return np.asarray(column != column, dtype=bool)


def _array(values: list[object]) -> NDArray[np.generic]:
    """A column (N,) of the narrowest kind: ints where all are, floats where all are numbers or None, else
    objects.
    """
    if values and all(type(x) is int for x in values):
        return np.array(values)
    if all(x is None or isinstance(x, (int, float)) for x in values):
        return np.array(values, dtype=float)
    column = np.empty(len(values), dtype=object)
    column[:] = values
    return column
