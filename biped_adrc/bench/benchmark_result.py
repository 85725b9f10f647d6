"""The result of a benchmark as one JSON file, for publication: how it is written, read and checked.

All statistics are computed from the walks in the file and from the frozen reference, so that a reader computes
them again: a file whose numbers do not follow from its walks is refused, and so is one of another benchmark.

    schema            "walkbench result 1"
    bench, hash       name and SHA-256 of the frozen file
    controller        name, source (hashes), settings by place
    seeds             with which it walked; fewer than the benchmark has make a partial result
    walks, cells      by condition
    against           by condition, beside NPD with the same seeds
    reference         legal share and rms error of the reference controllers
    machine           whether NPD, walked anew, has the frozen numbers
    publishable, why  and the versions, the command
"""

from __future__ import annotations

import hashlib
import inspect
import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from biped_adrc.bench.benchmark import (
    REFERENCE,
    Benchmark,
    BenchWalks,
    cells,
    held_against,
    load_benchmark,
)
from biped_adrc.campaign.chunk import Record
from biped_adrc.errors import InputError
from biped_adrc.files import read_json, reading
from biped_adrc.scenario.registry import find, is_own, source_hash
from biped_adrc.types import PlainRecord

SCHEMA = "walkbench result 1"
"""Of the files that are written now."""
AGREES = 0.01
"""Largest relative difference of a median of NPD, walked anew, to the frozen one."""
COMPUTED = ("cells", "against", "reference")
"""What follows from the walks and the frozen file."""


class BenchResult(NamedTuple):
    """A result of a benchmark that has been read and checked."""

    bench: str
    """Name of the benchmark."""
    controller: str
    """Name of the controller."""
    settings: Mapping[str, Record]
    """Its values by place; empty for its defaults."""
    cells: Mapping[str, PlainRecord]
    """By condition: shares and medians with their intervals, infinite numbers as the text "inf"."""
    against: Mapping[str, PlainRecord]
    """By condition, beside NPD."""
    walks: BenchWalks
    """By condition, the values of the metrics for each seed."""
    versions: Mapping[str, str]
    """With which it was walked."""
    publishable: bool
    """Whether all seeds were walked on a machine that gives the frozen numbers."""
    why: str
    """Why not; empty where it is."""


def result_of(
    bench: Benchmark,
    controller: str,
    chosen: Mapping[str, Record],
    mine: BenchWalks,
    again: BenchWalks,
    versions: Mapping[str, str],
    command: str,
) -> dict[str, Any]:
    """What is written of a controller's walks `mine`; again: those of NPD on this machine."""
    count = len(next(iter(mine.values())))
    machine = _machine(bench, again, count)
    why = _why_not(bench, count, machine)
    return {
        "schema": SCHEMA,
        "bench": bench.name,
        "hash": bench.hash,
        "publishable": not why,
        "why": why,
        "command": command,
        "controller": {
            "name": controller,
            "source": source_of(controller),
            "settings": dict(chosen),
        },
        "seeds": list(bench.seeds[:count]),
        "metrics": list(bench.metrics),
        "machine": machine,
        "versions": dict(versions),
        **_computed(bench, mine, count),
        "walks": dict(mine),
    }


def _computed(bench: Benchmark, mine: BenchWalks, count: int) -> dict[str, Any]:
    """The parts `COMPUTED` of a result."""
    kept = {
        name: {c: rows[:count] for c, rows in walks.items()} for name, walks in bench.walks.items()
    }
    told = ("legal", "rms_error", "ranked_rms_error")
    reference = {
        name: {c: {k: cell[k] for k in told} for c, cell in cells(bench, walks).items()}
        for name, walks in kept.items()
    }
    against = held_against(bench, mine, kept[REFERENCE])
    return {"cells": cells(bench, mine), "against": against, "reference": reference}


def _machine(bench: Benchmark, again: BenchWalks, count: int) -> dict[str, Any]:
    """Whether NPD walked anew has the frozen numbers: legal walks, and the medians of all metrics."""
    frozen = cells(bench, {c: rows[:count] for c, rows in bench.walks[REFERENCE].items()})
    found, apart, same = cells(bench, again), 0.0, True
    for name, cell in found.items():
        same = same and cell["legal"] == frozen[name]["legal"]
        for metric in bench.metrics[2:]:
            a, b = cell[metric], frozen[name][metric]
            same = same and (a is None) == (b is None)
            if a and b:
                apart = max(apart, abs(a[0] - b[0]) / abs(b[0]))
    return {
        "controller": REFERENCE,
        "same_legal_walks": same,
        "largest_difference": apart,
        "agrees": same and apart <= AGREES,
    }


def _why_not(bench: Benchmark, count: int, machine: Mapping[str, Any]) -> str:
    """Why a result may not be published; empty where it may."""
    found = []
    if count < len(bench.seeds):
        found.append(f"it is partial, with {count} of {len(bench.seeds)} seeds")
    if not machine["agrees"]:
        found.append(
            f"{REFERENCE}, walked anew, has other numbers than the frozen ones (its medians by up to "
            f"{100 * machine['largest_difference']:.2g} %)"
        )
    return "; ".join(found)


def source_of(controller: str) -> dict[str, str]:
    """Hashes of the source of a class of one's own and of its module; empty for one of this package."""
    if not is_own(controller):
        return {}
    thing = find("controller", controller).load()
    file = inspect.getsourcefile(thing)
    text = b"" if file is None else Path(file).read_bytes()
    module = hashlib.sha256(text).hexdigest()[:12]
    return {f"source {controller}": source_hash(thing), f"module of {controller}": module}


def check_settings(bench: Benchmark, chosen: Mapping[str, Record]) -> None:
    """Raises InputError for places and values that no controller of the benchmark may choose."""
    for place, values in chosen.items():
        if place not in bench.places:
            raise InputError(f"found the place '{place}', expected those of {list(bench.places)}")
        for name in values:
            if name not in bench.free and not name.startswith("own."):
                raise InputError(
                    f"{place}: '{name}' is not the controller's to choose in {bench.name}; free are "
                    f"{list(bench.free)}, and parameters of its own as own.NAME"
                )


def text_of_result(result: Mapping[str, Any]) -> str:
    """The text of a result's file: a line for each part, and for each condition of the walks."""
    parts = []
    for name, part in result.items():
        if name in ("walks", *COMPUTED):
            lines = (f"{json.dumps(k)}: {json.dumps(x, allow_nan=False)}" for k, x in part.items())
            parts.append(f'"{name}": {{\n' + ",\n".join(lines) + "\n}")
        else:
            parts.append(f"{json.dumps(name)}: {json.dumps(part, allow_nan=False)}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def read_bench_result(path: Path | str) -> BenchResult:
    """A published result, checked. Raises InputError for a file of another schema or benchmark, conditions or
    seeds that are not the benchmark's, and numbers that do not follow from its walks.
    """
    path = Path(path)
    told = read_json(path, "result of a benchmark")
    with reading("result of a benchmark", path, InputError):
        if told["schema"] != SCHEMA:
            raise InputError(f"found the schema '{told['schema']}', expected '{SCHEMA}'")
        bench = load_benchmark(told["bench"])
        if told["hash"] != bench.hash:
            raise InputError(
                f"it is of another '{bench.name}', {told['hash'][:12]}; the frozen file has "
                f"{bench.hash[:12]}. Walk it again with the benchmark as it is published"
            )
        mine, who = told["walks"], told["controller"]
        count = len(told["seeds"])
        _check_walks(bench, told)
        check_settings(bench, who["settings"])
        for name, part in _computed(bench, mine, count).items():
            if json.loads(json.dumps(part)) != told[name]:
                raise InputError(
                    f"its '{name}' do not follow from its walks; expected what they give"
                )
        why = _why_not(bench, count, told["machine"])
        if told["publishable"] is not (not why) or told["why"] != why:
            raise InputError(
                f"it says publishable: {told['publishable']}, but {why or 'nothing is amiss'}"
            )
        return BenchResult(
            bench.name,
            who["name"],
            who["settings"],
            told["cells"],
            told["against"],
            mine,
            told["versions"],
            not why,
            why,
        )


def _check_walks(bench: Benchmark, told: Mapping[str, Any]) -> None:
    """Raises InputError for walks that are not those of the benchmark's conditions, seeds and metrics."""
    seeds, count = told["seeds"], len(told["seeds"])
    if not seeds or seeds != list(bench.seeds[:count]):
        raise InputError(f"found the seeds {seeds}, expected the first of {list(bench.seeds)}")
    if list(told["walks"]) != list(bench.conditions) or told["metrics"] != list(bench.metrics):
        raise InputError(
            f"found the conditions {list(told['walks'])} with {told['metrics']}, expected "
            f"{list(bench.conditions)} with {list(bench.metrics)}"
        )
    for name, rows in told["walks"].items():
        if len(rows) != count or any(len(row) != len(bench.metrics) for row in rows):
            raise InputError(
                f"'{name}' has {len(rows)} walks, expected {count}, each of all metrics"
            )
        for x in (x for row in rows for x in row if x is not None):
            if type(x) not in (int, float) or not math.isfinite(x):
                raise InputError(f"'{name}' has a walk with {x!r}, expected finite numbers or null")
