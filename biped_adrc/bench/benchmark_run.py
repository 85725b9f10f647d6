"""A controller walked under a frozen benchmark: `biped-adrc compare --bench walkbench-1 package.module:Class`.

Beside the controller the reference NPD is walked anew. If its numbers are those of the frozen file, this
machine and these versions give the walks by which the other reference controllers were judged, and theirs are
taken from the file. Every walk is stored as it comes, so that an interrupted run goes on.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from contextlib import closing
from pathlib import Path

from biped_adrc.bench.benchmark import REFERENCE, Benchmark, BenchWalks, load_benchmark
from biped_adrc.bench.benchmark_result import check_settings, result_of, source_of, text_of_result
from biped_adrc.bench.compare_study import Stored
from biped_adrc.bench.comparison import walked_rows
from biped_adrc.bench.settings import read_settings
from biped_adrc.campaign.chunk import Record, key_of, text_of
from biped_adrc.campaign.execute import Progress
from biped_adrc.campaign.store import About
from biped_adrc.campaign.store_open import open_store
from biped_adrc.campaign.workers import Kept, Workers, workers_of
from biped_adrc.errors import InputError
from biped_adrc.files import check_folder, write_text
from biped_adrc.scenario.registry import find
from biped_adrc.types import PlainRecord
from biped_adrc.versions import numerical_versions


def run_benchmark(
    name: str,
    controller: str,
    out: Path,
    command: str,
    settings: Path | None = None,
    seeds: int | None = None,
    workers: Workers | Executor | int | None = None,
    progress: Callable[[Progress], None] | None = None,
    other_versions: bool = False,
) -> PlainRecord:
    """Walk a controller under a benchmark and write `out`/NAME.json; returns what is in it.

    controller: module:Class, or a name of the registry. settings: a file of settings (`bench.settings`) with
    lines for this controller; None: its defaults everywhere. seeds: fewer than the benchmark has make a result
    that is marked as partial. Raises InputError for what there is not and for trials that are no walks,
    OutputError.
    """
    bench = load_benchmark(name)
    find("controller", controller).load()
    chosen = {} if settings is None else chosen_in(settings, bench, controller)
    count = len(bench.seeds) if seeds is None else seeds
    if not 1 <= count <= len(bench.seeds):
        raise InputError(f"found {seeds} seeds, expected 1 to the {len(bench.seeds)} of {name}")
    asked = {"bench": bench.hash, "controller": controller, "settings": chosen, "seeds": count}
    versions = {**numerical_versions(), **source_of(controller)}
    check_folder(out)
    crew = workers_of(workers)
    crew.prepare()
    about = About(name, key_of(text_of(asked)), asked, versions)
    with (
        open_store(out / f"{name}.sqlite", about, other_versions) as store,
        closing(Kept(crew)) as kept,
    ):
        carry = Stored(store, kept, progress)
        who = {place: {"controller": controller, **chosen.get(place, {})} for place in bench.places}
        mine = walked(bench, carry, who, count)
        usual = {place: bench.reference(REFERENCE, place) for place in bench.places}
        again = walked(bench, carry, usual, count)
    result = result_of(bench, controller, chosen, mine, again, versions, command)
    write_text(out / f"{name}.json", text_of_result(result))
    return result


def walked(bench: Benchmark, carry: Stored, who: Mapping[str, Record], count: int) -> BenchWalks:
    """The walks of a controller under all conditions, with the first seeds. who: its values by place."""
    seeds = bench.seeds[:count]
    records = [
        bench.record(name, who[known["place"]], seed)
        for name, known in bench.conditions.items()
        for seed in seeds
    ]
    rows = [bench.kept(row) for row in walked_rows(carry(records))]
    return {name: rows[i * count : (i + 1) * count] for i, name in enumerate(bench.conditions)}


def chosen_in(path: Path, bench: Benchmark, controller: str) -> dict[str, Record]:
    """The values of a controller by place, of a file of settings. Raises InputError where it has none."""
    found = read_settings(path)
    fixed = {k: x for k, x in found.contestants.get(controller, {}).items() if k != "controller"}
    there = {place: found.places.get(place, {}).get(controller) for place in bench.places}
    if not any(there.values()):
        named = sorted(
            {n for of in found.places.values() for n in of if n not in bench.contestants}
        )
        raise InputError(
            f"'{path}' has no values of '{controller}' at any place of {bench.name}; it has those of {named}"
        )
    chosen: dict[str, Record] = {
        place: {**fixed, **(values or {})} for place, values in there.items()
    }
    check_settings(bench, chosen)
    return chosen
