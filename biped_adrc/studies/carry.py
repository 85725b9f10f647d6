"""A study carried out: `ba.study`.

Order of what is done: the study is read and rehearsed, the results file is opened, the workers start, and
only then the first walk. What can fail without a walk fails before it. In a script, which worker processes
import:

    if __name__ == "__main__":
        found = ba.study("study.toml", "out/study")
        print(found.table())

A case is a named set of values, a condition another one that is crossed with it (`study`). A search proposes
candidates: the case with other values of some variables, its setting; number 0 is the case itself. They are
walked on three sets of walks: all on "search", the best few of them again on "choice", by which one is chosen
(the next few where none of these keeps the limits there), and this one and the case on "test" (`search`). A
limit is a bound on a number of a candidate's walks.

A point is one walk: its place in the study (a number from 0), what locates it (`at`: case, condition, set,
candidate, seed ..), and the values of its scenario. A row is the results of one walk by column. To rehearse is
to build walkers without walking them.
"""

import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from functools import partial
from pathlib import Path
from typing import Any

from biped_adrc.core.errors import InputError
from biped_adrc.scenario.scenario import write_scenario
from biped_adrc.studies.build import SEED, Values, scenario_of
from biped_adrc.studies.proposals import Round, WalkAll, last_rounds, optuna_library, searched
from biped_adrc.studies.results import Choice, Results, opened
from biped_adrc.studies.run import Function, run_trials
from biped_adrc.studies.runner import Crew, Runner, StudyProgress
from biped_adrc.studies.search import MOST_GROUPS, Candidate, Search, Walks
from biped_adrc.studies.study import Point, Study, Undrawn, chosen_file, read_study, walk_names

Candidates = Sequence[tuple[int, Values, Mapping[str, Any]]]
"""Candidates to be walked: number, values of the scenario, names that locate their walks (case, setting)."""


def study(
    study: Study | Mapping[str, Any] | Path | str,
    out: Path | str,
    workers: Executor | int | None = None,
    *,
    progress: Callable[[StudyProgress], None] | None = None,
    function: Function | None = None,
) -> Results:
    """Make all walks of a study whose rows are not yet in the folder `out`, and hand out its results.

    study: its TOML file, or the tables of one. out: the folder of its rows. workers: processes, one per core if
    None, or an executor, such as that of a Dask client. progress: called now and then.
    function: rows of records, walks if None. Raises InputError, also where no candidate of any case keeps all
    limits, OutputError, WorkersError. After Ctrl-C or a kill what is finished is kept, and the same call goes
    on with the same rows.

    >>> from concurrent.futures import ThreadPoolExecutor
    >>> results = ba.study(
    ...     {
    ...         "name": "gains of NPD",
    ...         "column": "peak_error",
    ...         "base": {"controller.name": "NPD", "run.impacts": 2},
    ...         "grid": {"controller.K_p": [2500.0, 5000.0]},
    ...     },
    ...     folder / "gains",
    ...     ThreadPoolExecutor(1),
    ... )
    >>> [row["peak_error"] < 0.1 for row in results.rows()]
    [True, True]
    """
    crew = Crew(workers)
    study_ = study if isinstance(study, Study) else read_study(study)
    if study_.search is not None:
        optuna_library()
    # pairs (case, condition) in whose walks nothing is drawn from the seed: they are walked once, not per seed
    undrawn = Undrawn()
    if function is None:
        # only walks are rehearsed: what a function of the caller's makes of the values is not known
        undrawn = study_.rehearse()
        # aside: only this column needs a second walk, from a start beside the first one
        function = partial(run_trials, aside="rounding" in study_.columns)
    folder = Path(out)
    with opened(folder, study_) as store, crew:
        # place of each stored row -> whether it fits its checksum
        fits, total = store.mend(), study_.count_of(undrawn)
        there = {place for place, fit in fits.items() if fit}
        runner = Runner(function, store, crew, total, there, progress)
        if wrong := len(fits) - len(there):
            runner.tell(f"Rows that do not fit their checksums, and are walked again: {wrong}.")
        if undrawn:
            runner.tell(study_.walked_once(undrawn))
        if study_.search is None:
            runner.run(study_.points(undrawn))
            return Results(study_, folder)
        # walks the candidates of the search
        walker = _Searched(study_, study_.search, runner, undrawn)
        cases = enumerate(study_.cases or ("",))
        searches = {name: walker.search_of(name, study_.search.seed + i) for i, name in cases}
        # for each case a Choice, or a text that says why there is none
        result = {name: walker.choice(name, x) for name, x in last_rounds(searches).items()}
        choices = {name: x for name, x in result.items() if isinstance(x, Choice)}
        failures = tuple(x for x in result.values() if isinstance(x, str))
        if not choices:
            raise InputError("\n".join(failures))
        walker.test(choices)
    for name, x in choices.items():
        # selected: candidates walked on the set "choice", best first
        comment = f"Chosen by the study '{study_.name}', candidate {x.selected[0].number}."
        write_scenario(folder / chosen_file(name), scenario_of(x.values), comment)
    return Results(study_, folder, choices, failures)


class _Searched:
    """Walks the candidates of a search. Its walks get places in the study one after the other, in an order that
    does not depend on what is stored already; so a search that was stopped finds its rows again.

    place: the next free place, from 0. undrawn: pairs (case, condition) in which no part uses the seed, walked
    once each.
    """

    def __init__(self, study: Study, search: Search, runner: Runner, undrawn: Undrawn) -> None:
        self.study, self.search, self.runner, self.place = study, search, runner, 0
        self.undrawn = undrawn

    def search_of(self, case: str, seed: int) -> Iterator[Round]:
        """The rounds of the search of a case ("" for the base alone). seed: of the sampler."""
        # numbers of the candidates that were the best so far, one after the other
        best: list[int] = []

        def report(c: Candidate) -> None:
            # nothing is reported while the same candidate stays the best
            if best[-1:] != [c.number]:
                best.append(c.number)
                missed = "" if c.feasible else f", missing limits by {100 * sum(c.missed):.3g} %"
                words = f"{self.search.objective.words} {c.objective:.4g}{missed}"
                self.runner.tell(f"{case or self.study.name}: candidate {c.number}, {words}")

        base = self.study.values_of(case)
        return searched(self.search, base, partial(self.walk_case, case, "search"), report, seed)

    def walk_case(self, case: str, kind: str, found: Sequence[Candidate]) -> list[Walks]:
        """The walks of candidates of a case on a set of walks; see `walk`."""
        return self.walk(kind, [(c.number, c.values, walk_names(case=case)) for c in found])

    def choice(self, case: str, last: Round) -> Choice | str:
        """Choose among the best few candidates of a search by their walks on the second set; returns a text
        with the reason where no candidate keeps all limits. last: the last round of the search of the case.
        """
        search, base, (result, gain, ends) = self.search, self.study.values_of(case), last
        walk = partial(self.walk_case, case)
        failure = self.failure(result, case, "search")
        if not failure:
            again = self.finalists(base, result, partial(walk, "choice"))
            failure = self.failure(again, case, "choice")
        if not failure:
            again = search.ranked(again)
            stop = self.stop(base, again[0], len(result), partial(walk, "choice"))
            stop = ", ".join(f"not tuned: {n} at an end of its range" for n in ends) or stop
            gained = f"gained {gain:.2%}" if math.isfinite(gain) else "alone came within the limits"
            stop += f"; the last doubling {gained}" if search.doublings else ""
            return Choice(tuple(result), tuple(again), stop)
        self.runner.tell(failure)
        return failure

    def finalists(self, base: Values, found: Sequence[Candidate], walk: WalkAll) -> list[Candidate]:
        """The finalists of a search, judged by their walks on the second set: the best few of the candidates
        found, and the next few while none of them keeps the limits there.

        walk: walks candidates on the second set.
        """
        again = list[Candidate]()
        for few in _finalists(self.search, found):
            pairs = zip(few, walk(few), strict=True)
            again += [self.search.judged(base, c.number, c.chosen, walks) for c, walks in pairs]
            # the case itself, number 0, is none of those that the search found
            if not few or any(c.feasible and c.number for c in again):
                break
        return again

    def stop(self, base: Values, c: Candidate, number: int, walk: WalkAll) -> str:
        """What stopped the search at the chosen candidate, by the walks of the settings beside it.

        number: of the first of them. walk: walks candidates on the second set.
        """
        beside = self.search.beside(base, c)
        numbered = enumerate(beside.values(), number)
        some = [self.search.judged(base, i, chosen) for i, chosen in numbered]
        pairs = zip(some, walk(some), strict=True)
        judged = [self.search.judged(base, x.number, x.chosen, walks) for x, walks in pairs]
        return self.search.stop(c, dict(zip(beside, judged, strict=True)))

    def test(self, choices: Mapping[str, Choice]) -> None:
        """Walk settings on the test set: what was chosen for each case, and each case as it was.

        The table of results compares with what is walked first: the setting chosen for the first case; without
        cases the setting as it was.
        """
        # selected[0] is the best on the set "choice", candidates[0] the case itself, number 0
        chosen = [(x.selected[0], case, "chosen") for case, x in choices.items()]
        before = [(x.candidates[0], case, "before") for case, x in choices.items()]
        every = [*chosen, *before] if self.study.cases else [*before, *chosen]
        named = [(c.number, c.values, walk_names(case=x, setting=s)) for c, x, s in every]
        self.walk("test", named)
        self.runner.total = self.runner.done  # `total` was the most that the search might need
        self.runner.tell()

    def walk(self, kind: str, candidates: Candidates) -> list[Walks]:
        """Walk candidates on a set of walks (kind "search", "choice" or "test"); returns for each candidate its
        walks, (condition, row) each. A walk without a seed, in which nothing is drawn, stands there once for
        each seed.
        """
        walks = getattr(self.search.walks, kind)
        conditions = self.study.conditions_of(walks)
        first, points = self.place, list[Point]()
        for (number, values, named), c in itertools.product(candidates, conditions):
            # there: values of the scenario; at: names that locate the walk; seed: {} if nothing is drawn
            there = {**values, **self.study.conditions.get(c, {})}
            at = walk_names(set=kind, **named, candidate=number, condition=c)
            for seed in self.study.seeded(walks.seeds, at, self.undrawn):
                points.append(Point(first + len(points), at | seed, there | seed))
        self.place += len(points)
        self.runner.run(points, len(points))
        # read from the file, which has rows of earlier calls too; a walk without a seed stands for all seeds
        result = [
            (str(at.get("condition", "")), row)
            for at, row in self.runner.store.results(first, len(points))
            for _ in range(1 if SEED in at else len(walks.seeds))
        ]
        # cut into pieces, one for each candidate
        count = len(conditions) * len(walks.seeds)
        return [result[i : i + count] for i in range(0, len(result), count)]

    def failure(self, found: Sequence[Candidate], case: str, kind: str) -> str:
        """Text for a search of a case in which no candidate keeps all limits on the set of walks `kind`: how
        many missed each limit, and the nearest candidate. Empty where one keeps them.
        """
        if any(c.feasible for c in found):
            return ""
        counts = (
            f"{m.sentence}: missed by {sum(c.missed[i] > 0.0 for c in found)}"
            for i, m in enumerate(self.search.limits)
        )
        # False is less than True: a walked candidate is nearer than one that was not
        nearest = min(found, key=lambda c: (not c.walked, sum(c.missed), c.number))
        return (
            f"study '{self.study.name}'{case and f', {case}'}: none of {len(found)} candidates keeps all "
            f"limits on the walks of {kind}; {'; '.join(counts)}. The nearest is number {nearest.number}, "
            f"{nearest.chosen or 'the case itself'}; ease a limit, widen a range, or give a larger budget"
        )


def _finalists(search: Search, found: Sequence[Candidate]) -> Iterator[list[Candidate]]:
    """Yield the best `search.finalists` of the candidates found, without a second one of the same values, and
    beside them the case itself, found[0]; then as many of those after them that keep the limits: evenly from as
    many as have been passed, so that MOST_GROUPS groups reach deep.
    """
    some: dict[str, Candidate] = {}
    for c in search.ranked(found):
        some.setdefault(repr(sorted(c.values.items())), c)
    best, size = list(some.values()), search.finalists
    few = best[:size]
    yield few if any(c.number == 0 for c in few) else [*few, found[0]]
    fine = [c for c in best[size:] if c.feasible]
    for i in range(MOST_GROUPS - 1):
        yield fine[size * (2**i - 1) : size * (2 ** (i + 1) - 1) : 2**i]
