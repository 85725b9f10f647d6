"""A tuning study carried out: searched, selected, and reported once on walks that no choice has touched.

    training    generations of candidates (`tuning.search`)
    selection   the best few and the as-published setting; the best of them that keeps all limits is chosen
    test        the chosen and the as-published setting

Order of what is done: the study is read and rehearsed, the folder and the workers are checked, the results file
is opened, the hash of the test set is written, and only then the first walk starts. A study that is killed and
repeated finds its walks in the store, proposes the same candidates, and goes on.

In a script, which worker processes import, so that it needs the main guard:

    if __name__ == "__main__":
        found = ba.tune("study.toml", "out/study", workers=4)
        print(found.scenario, found.held_out)
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from pathlib import Path

from biped_adrc.bench.build import case, files_of, hashes, own_of_study, plants_of_study
from biped_adrc.bench.parameters import trial
from biped_adrc.bench.study import SEED, Named, Study
from biped_adrc.bench.sweep import RESULTS
from biped_adrc.campaign.chunk import Function
from biped_adrc.campaign.execute import Progress
from biped_adrc.campaign.store import About, open_store
from biped_adrc.campaign.workers import Crew, Workers, workers_of
from biped_adrc.errors import BipedError, InputError
from biped_adrc.files import check_folder, write_text
from biped_adrc.tuning.candidate import (
    Candidate,
    NoneKeepsLimits,
    finalists,
    judged,
    ranked,
    why_none,
)
from biped_adrc.tuning.held_out import held_out
from biped_adrc.tuning.page import write
from biped_adrc.tuning.proposals import optuna_quiet
from biped_adrc.tuning.refinement import cma_library
from biped_adrc.tuning.search import search
from biped_adrc.tuning.study import SETS, TuningStudy
from biped_adrc.tuning.study_file import load_tuning
from biped_adrc.tuning.tuned import Tuned
from biped_adrc.tuning.variables import Values
from biped_adrc.tuning.walks import StoredWalks
from biped_adrc.tuning.without_walk import numbers_without_walk
from biped_adrc.versions import numerical_versions, packages

TEST_SET = "test_set.json"
"""Name of the file with the hash of the test set, in the folder of the study."""


def tune(
    study: TuningStudy | Path | str,
    out: Path | str,
    workers: Workers | Executor | int | None = None,
    *,
    function: Function | None = None,
    progress: Callable[[Progress], None] | None = None,
    command: str = "ba.tune",
) -> Tuned:
    """The best setting that a study finds, and what it is worth on walks that no choice has touched.

    study: a `TuningStudy`, or the name of its file. out: folder of results, scenario file and page; an
    interrupted study goes on there. workers: processes (one per core if None), `Threads`, `Cluster`, or any
    executor. function: what makes rows of records, walks if None. progress: called now and then.
    command: as typed, for the page. Raises InputError, where no candidate keeps all limits too, OutputError,
    WorkersError.
    """
    study = study if isinstance(study, TuningStudy) else load_tuning(study)
    with optuna_quiet():
        cma_library()  # both are there
    if function is None:
        rehearse(study)
        from biped_adrc.bench.run import run_trials

        function = run_trials
    check_folder(out)
    out, asked = Path(out), workers_of(workers)
    about = about_tuning(study, asked)
    with Crew(asked) as crew, open_store(out / RESULTS, about) as store:
        _write_test_set(study, out)
        tuned = _carried_out(study, out, StoredWalks(study, function, store, crew, progress))
    write(tuned, command)
    return tuned


def _carried_out(study: TuningStudy, out: Path, walks: StoredWalks) -> Tuned:
    """Search, selection and test, one after the other."""
    best: list[int] = []

    def told(found: Sequence[Candidate]) -> None:
        first = ranked(study, found)[0]
        if best[-1:] != [first.number]:
            best.append(first.number)
            walks.note(best_so_far(study, first, found[0]))

    candidates = search(study, lambda asked: walks("training", asked), told)
    if not any(c.feasible for c in candidates):
        raise NoneKeepsLimits(why_none(study, candidates, "on the training set"))
    selected = _on(study, walks, "selection", finalists(study, candidates))
    if not any(c.feasible for c in selected):
        raise NoneKeepsLimits(why_none(study, selected, "on the selection set"))
    selected = ranked(study, selected)
    sides = [(c.number, study.values(c.chosen)) for c in (selected[0], candidates[0])]
    columns = [m.column for m in study.measures]
    tested = walks("test", sides)
    walks.end()
    numbers = [numbers_without_walk(columns, values) for _, values in sides]
    a, b = zip(tested, numbers, strict=True)
    return Tuned(study, out, candidates, tuple(selected), held_out(study, a, b))


def _on(
    study: TuningStudy, walks: StoredWalks, kind: str, asked: Sequence[Candidate]
) -> list[Candidate]:
    """These candidates as judged on another set."""
    settings = [(c.number, study.values(c.chosen)) for c in asked]
    found: list[Candidate] = []
    for c, (_, values), walked in zip(asked, settings, walks(kind, settings), strict=True):
        known = numbers_without_walk([m.column for m in study.measures], values)
        found.append(judged(study, c.number, c.generation, c.chosen, walked, known))
    return found


def best_so_far(study: TuningStudy, best: Candidate, published: Candidate) -> str:
    """The sentence for the best candidate so far, beside the as-published setting."""
    missed = "" if best.feasible else f", missing limits by {100 * best.total_excess:.3g} %"
    numbers = [
        f"{m.words} {x:.4g} (as published {y:.4g})"
        for m, x, y in zip(study.objectives, best.objectives, published.objectives, strict=True)
    ]
    return f"candidate {best.number}: {', '.join(numbers)}{missed}"


def about_tuning(study: TuningStudy, workers: Workers) -> About:
    """What is stored to recognise a study: its hash, configuration, and the versions its numbers depend on.

    Raises InputError for files that workers on other machines may not have.
    """
    given = as_sweep(study)
    files = tuple(sorted({path for pair in given.given() for path in files_of(*pair)}))
    if files and workers.elsewhere:
        raise InputError(
            f"study '{study.name}' names the files {[str(path) for path in files]}, which workers elsewhere "
            "may not have, or have others; run it with processes or threads of this machine"
        )
    of_parts = own_of_study(given) | plants_of_study(given)
    versions = {
        **numerical_versions(),
        **packages(["optuna", "cmaes"]),
        **hashes(files),
        **of_parts,
    }
    return About(study.name, study.hash, study.configuration, versions)


def as_sweep(study: TuningStudy) -> Study:
    """A study of a sweep that names all values that candidates may have: fixed, choices, conditions."""
    sets = (study.walks(kind) for kind in SETS)
    conditions = [one.values for walked in sets for one in walked.conditions]
    choices = [{name: x} for name, v in study.variables.items() for x in v.choices]
    cases = [Named(name=f"{i}", values=values) for i, values in enumerate([*conditions, *choices])]
    return Study(name=study.name, fixed=study.fixed, cases=tuple(cases))


def rehearse(study: TuningStudy) -> None:
    """Build the walkers of settings that stand for all, without walking them.

    These are the as-published setting under each condition, and under the first condition of the training set
    the middle of all variables, and each choice with the others in the middle. Corners of ranges may be
    refused, as gains that do not go together are: their walks rank worst. Raises InputError with the place.
    """
    for kind in SETS:
        for one in study.walks(kind).named:
            _build(study, {**study.values({}), **one.values}, f"{kind} set, condition '{one.name}'")
    condition = study.training.named[0].values
    middle = {name: v.middle for name, v in study.variables.items()}
    _build(study, {**study.values(middle), **condition}, "all variables in the middle")
    for name, variable in study.variables.items():
        for x in variable.choices:
            values = study.values(middle | {name: x})
            _build(study, {**values, **condition}, f"variable {name} = {x}")


def _build(study: TuningStudy, values: Values, where: str) -> None:
    """Build one walker. Raises InputError, with where it belongs."""
    seed = {SEED: study.training.seeds[0]}
    try:
        case(trial({**values, **seed}))
    except BipedError as error:
        raise InputError(f"study '{study.name}', {where}: {error}") from error


def _write_test_set(study: TuningStudy, out: Path) -> None:
    """Write the test set with its hash, before the first walk. Raises OutputError."""
    told: Mapping[str, object] = {
        "hash": study.test_hash,
        **study.test.model_dump(mode="json"),
    }
    write_text(out / TEST_SET, json.dumps(told, indent=1) + "\n")
