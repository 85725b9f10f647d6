"""What a tuning study leaves in its folder, beside its walks.

best.toml       the chosen setting, a scenario file that commands and studies take
tuning.html     the page: held-out numbers, path of the search, front, which variable decides
summary.json    the same in plain values
study.journal   all candidates as a study that Optuna's dashboard opens
"""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import Any

from biped_adrc.files import plain, write_bytes, write_text
from biped_adrc.scenario.file import write_scenario
from biped_adrc.tuning.candidate import Candidate
from biped_adrc.tuning.proposals import importances, optuna_quiet, optuna_study
from biped_adrc.tuning.study import SETS, TuningStudy
from biped_adrc.tuning.tuned import Tuned
from biped_adrc.viz.pages import tuning_html
from biped_adrc.viz.plots.tuning import tuning_figures
from biped_adrc.viz.style import render

BEST, PAGE, SUMMARY, JOURNAL = "best.toml", "tuning.html", "summary.json", "study.journal"
"""Names of the files."""


def write(tuned: Tuned, command: str) -> None:
    """Write scenario file, page, summary and journal into the folder of the study. Raises OutputError.

    command: as typed, for the page.
    """
    study, out = tuned.study, tuned.out
    told = summary(tuned, command)
    comment = f"The setting chosen by the study '{study.name}', candidate {tuned.chosen.number}."
    write_scenario(out / BEST, tuned.scenario, comment)
    write_text(out / SUMMARY, json.dumps(told, indent=1) + "\n")
    figures = {n: render(f, "svg").decode("utf-8") for n, f in tuning_figures(told).items()}
    write_text(out / PAGE, tuning_html(told, figures))
    _write_journal(study, tuned.candidates, out / JOURNAL)


def summary(tuned: Tuned, command: str) -> dict[str, Any]:
    """All that the page says, in plain values; numbers that are not finite are the texts "inf" and "-inf"."""
    study = tuned.study
    sets = {kind: study.walks(kind) for kind in SETS}
    trained = [one.model_dump(mode="json") for one in study.training.conditions]
    told = {
        "command": command,
        "study": study.name,
        "description": study.description,
        "objectives": [{"words": m.words, "goal": m.goal} for m in study.objectives],
        "limits": [m.sentence for m in study.limits],
        "variables": list(study.variables),
        "sampler": {"name": study.sampler, "seed": study.seed, "generation": study.generation},
        "sets": {
            kind: {"seeds": len(x.seeds), "conditions": [one.name for one in x.conditions]}
            for kind, x in sets.items()
        },
        "only_in_test": [
            one.name for one in study.test.conditions if one.model_dump(mode="json") not in trained
        ],
        "test_hash": study.test_hash,
        "candidates": [_told(study, c) for c in tuned.candidates],
        "front": [c.number for c in tuned.front],
        "selected": [_told(study, c) for c in tuned.selected],
        "chosen": {"number": tuned.chosen.number, "values": tuned.scenario.record()},
        "importances": importances(study, tuned.candidates),
        "held_out": tuned.held_out,
    }
    return dict(plain(told))


def _told(study: TuningStudy, c: Candidate) -> dict[str, object]:
    """A candidate in plain values, with those of its variables that have an effect."""
    known = study.values(c.chosen)
    values = {name: known[name] for name in study.variables if name in known}
    return {**c._asdict(), "chosen": values, "feasible": c.feasible}


def _write_journal(study: TuningStudy, found: tuple[Candidate, ...], path: Path) -> None:
    """Write all candidates as an Optuna study in a journal file, whole or not at all."""
    with optuna_quiet() as optuna, tempfile.TemporaryDirectory() as folder:
        temporary = Path(folder) / path.name
        backend = optuna.storages.journal.JournalFileBackend(str(temporary))
        optuna_study(optuna, study, found, storage=optuna.storages.JournalStorage(backend))
        write_bytes(path, temporary.read_bytes())
