"""A study carried out: `ba.study`.

Order of what is done: the study is read and rehearsed, the results file is opened, the workers start, and
only then the first walk. What can fail without a walk fails before it. In a script, which worker processes
import:

    if __name__ == "__main__":
        found = ba.study("study.toml", "out/study")
        print(found.table())
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from pathlib import Path
from typing import Any

from biped_adrc.errors import InputError
from biped_adrc.scenario.file import write_scenario
from biped_adrc.study.parameters import SEED, Values, scenario_of
from biped_adrc.study.proposals import optuna_library, searched
from biped_adrc.study.results import BEFORE, CANDIDATE, CHOSEN, SET, SETTING, Choice, Results
from biped_adrc.study.runner import Crew, Function, Progress, Runner
from biped_adrc.study.search import Candidate, Search, Walks, judged, ranked
from biped_adrc.study.store import opened
from biped_adrc.study.study import CASE, CONDITION, Point, Study, chosen_file, read_study
from biped_adrc.study.without_walk import numbers_without_walk

Asked = Sequence[tuple[int, Values, Mapping[str, Any]]]
"""Candidates to be walked: number, values, and what locates their walks besides."""


class NoneKeepsLimits(InputError):
    """No candidate of a case keeps all limits."""


def study(
    study: Study | Mapping[str, Any] | Path | str,
    out: Path | str,
    workers: Executor | int | None = None,
    *,
    cluster: str | None = None,
    progress: Callable[[Progress], None] | None = None,
    function: Function | None = None,
) -> Results:
    """Make all walks of a study whose rows are not yet in the folder `out`, and hand out its results.

    study: its TOML file, or the tables of one. workers: processes, one per core if None, or an executor.
    cluster: address of a Dask scheduler in their place. progress: called now and then. function: rows of
    records, walks if None. Raises InputError, also where no candidate of any case keeps all limits,
    OutputError, WorkersError. After Ctrl-C or a kill what is finished is kept, and the same call goes on with
    the same rows.
    """
    asked = study if isinstance(study, Study) else read_study(study)
    if asked.search is not None:
        optuna_library()
    if function is None:
        from biped_adrc.study.run import run_trials

        asked.rehearse()
        function = run_trials
    files = [x for x in asked.versions if x.startswith("file ")]
    if cluster is not None and files:
        raise InputError(
            f"study '{asked.name}' names files that workers elsewhere may not have: {files}; run it on this "
            "machine"
        )
    folder = Path(out)
    with opened(folder, asked) as store, Crew(workers, cluster) as crew:
        runner = Runner(function, store, crew, asked.count, progress)
        if asked.search is None:
            runner.run(asked.points())
            return Results(asked, folder)
        walker = _Searched(asked, asked.search, runner)
        choices: dict[str, Choice] = {}
        failures: list[str] = []
        for name in asked.cases or ("",):
            try:
                choices[name] = walker.choice(name)
            except NoneKeepsLimits as error:
                failures.append(str(error))
                runner.tell(failures[-1])
        if not choices:
            raise NoneKeepsLimits("\n".join(failures))
        walker.test(choices)
    for name, found in choices.items():
        comment = f"Chosen by the study '{asked.name}', candidate {found.selected[0].number}."
        write_scenario(folder / chosen_file(name), scenario_of(found.values), comment)
    return Results(asked, folder, choices, tuple(failures))


class _Searched:
    """The walks of candidates, in places one behind the other: the same each time, whatever is in the store."""

    def __init__(self, study: Study, search: Search, runner: Runner) -> None:
        self.study, self.search, self.runner, self.place = study, search, runner, 0

    def choice(self, case: str) -> Choice:
        """Search a case, and choose among the best few. Raises NoneKeepsLimits."""
        search, base = self.search, self.study.values_of(case)
        named = {CASE: case} if case else {}
        best: list[int] = []

        def told(c: Candidate) -> None:
            if best[-1:] != [c.number]:
                best.append(c.number)
                missed = "" if c.feasible else f", missing limits by {100 * sum(c.missed):.3g} %"
                words = f"{search.objective.words} {c.objective:.4g}{missed}"
                self.runner.tell(f"{case or self.study.name}: candidate {c.number}, {words}")

        def walk(asked: Sequence[tuple[int, Values]]) -> list[Walks]:
            return self.walk("search", [(n, values, named) for n, values in asked])

        found = searched(search, base, walk, told)
        self.check(found, case, "search")
        few = _few(search, base, found)
        values = [search.values(base, c.chosen) for c in few]
        walks = self.walk(
            "choice", [(c.number, v, named) for c, v in zip(few, values, strict=True)]
        )
        columns = [m.column for m in search.measures]
        again = [
            judged(search, c.number, c.chosen, w, numbers_without_walk(columns, v))
            for c, v, w in zip(few, values, walks, strict=True)
        ]
        self.check(again, case, "choice")
        selected = ranked(search, again)
        return Choice(tuple(found), tuple(selected), search.values(base, selected[0].chosen))

    def test(self, choices: Mapping[str, Choice]) -> None:
        """Walk the settings on the test set: what was chosen for each case, and each case as it was.

        The first of them is what the others are compared with: without cases the setting as it was.
        """
        settings = [CHOSEN, BEFORE] if self.study.cases else [BEFORE, CHOSEN]
        asked = [
            (choice.selected[0].number, choice.values, named | {SETTING: CHOSEN})
            if setting == CHOSEN
            else (0, self.study.values_of(case), named | {SETTING: BEFORE})
            for setting in settings
            for case, choice in choices.items()
            for named in [{CASE: case} if case else {}]
        ]
        self.walk("test", asked)
        self.runner.total = self.runner.done
        self.runner.tell()

    def walk(self, kind: str, asked: Asked) -> list[Walks]:
        """The walks of each candidate on a set."""
        walks = getattr(self.search.walks, kind)
        conditions = self.study.conditions_of(walks)
        first, places = self.place, itertools.count(self.place)

        def points() -> Iterator[Point]:
            for (number, values, named), c in itertools.product(asked, conditions):
                there = {**values, **self.study.conditions.get(c, {})}
                for seed in walks.seeds:
                    at = {SET: kind, **named, CANDIDATE: number, **({CONDITION: c} if c else {})}
                    yield Point(next(places), {**at, SEED: seed}, {**there, SEED: seed})

        count = len(conditions) * len(walks.seeds)
        self.place += count * len(asked)
        self.runner.run(points(), self.place - first)
        found = [
            (str(at.get(CONDITION, "")), row)
            for at, row in self.runner.store.results(first, self.place - first)
        ]
        return [found[i : i + count] for i in range(0, len(found), count)]

    def check(self, found: Sequence[Candidate], case: str, kind: str) -> None:
        """Raises NoneKeepsLimits, with what excluded how many and the nearest one."""
        if any(c.feasible for c in found):
            return
        counts = [
            f"{m.sentence}: missed by {sum(c.missed[i] > 0.0 for c in found)}"
            for i, m in enumerate(self.search.limits)
        ]
        nearest = min(found, key=lambda c: (not c.walked, sum(c.missed), c.number))
        raise NoneKeepsLimits(
            f"study '{self.study.name}'{case and f', {case}'}: none of {len(found)} candidates keeps all "
            f"limits on the walks of {kind}; {'; '.join(counts)}. The nearest is number {nearest.number}, "
            f"{nearest.chosen or 'the case itself'}; ease a limit, widen a range, or give a larger budget"
        )


def _few(search: Search, base: Values, found: Sequence[Candidate]) -> list[Candidate]:
    """The best few, settings that come twice once, and the case itself."""
    some: dict[str, Candidate] = {}
    for c in ranked(search, found):
        some.setdefault(repr(sorted(search.values(base, c.chosen).items())), c)
    best = list(some.values())[: search.finalists]
    return best if any(c.number == 0 for c in best) else [*best, found[0]]
