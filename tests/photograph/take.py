"""Taking a photograph: scenarios, help, calls and reports, each in a process of a pool, written as JSON."""

from __future__ import annotations

import json
import multiprocessing
import sys
import time
from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import Any

from tests.photograph import commands
from tests.photograph.adapter import reports, walks
from tests.photograph.scenarios import NUMBER, SEED, scenario

PARTS = ("commands", "reports", "help", "scenarios")
LONG = ("verification/hip", "verification/multipliers", "verification/design")
"""Reports that are begun first."""
Plain = dict[str, Any]


def scenario_record(drawn: Plain) -> Plain:
    """What is stored of a scenario."""
    with walks.as_before():
        return {"scenario": drawn, "found": walks.record(drawn)}


def report_record(name: str) -> Plain:
    """What is stored of a report, or its error."""
    return walks.attempt(reports.reports()[name])


def drawn(number: int | None, like: Path | None) -> dict[str, Plain]:
    """The scenarios, drawn or as another photograph has them."""
    if like is None:
        return {f"{k:03d}": scenario(k) for k in range(NUMBER if number is None else number)}
    stored = json.loads((like / "scenarios.json").read_text(encoding="utf-8"))
    return {k: x["scenario"] for k, x in list(stored.items())[:number]}


def jobs(part: str, number: int | None, like: Path | None) -> dict[str, tuple[Any, ...]]:
    """What is to be done for a part, by name: a function and its arguments."""
    if part == "scenarios":
        return {k: (scenario_record, s) for k, s in drawn(number, like).items()}
    if part == "reports":
        names = (*LONG, *(name for name in reports.reports() if name not in LONG))
        return {name: (report_record, name) for name in names}
    if part == "commands":
        return {name: (commands.chain, name) for name in commands.CHAINS}
    return {"help": (commands.help_texts,)}


def take(
    out: Path, parts: Iterable[str], number: int | None, like: Path | None, workers: int
) -> None:
    """Record `parts` into the folder `out`."""
    todo = {(part, name): job for part in parts for name, job in jobs(part, number, like).items()}
    found = carried_out(todo, workers)
    out.mkdir(parents=True, exist_ok=True)
    for part in parts:
        results = {name: found[at, name] for at, name in todo if at == part}
        if part == "commands":
            write_commands(out, results)
        elif part == "help":
            write(out / "help.json", results["help"])
        else:
            write(out / f"{part}.json", results)
    write(out / "about.json", {"seed": SEED, "move": walks.MOVE})


def carried_out(todo: dict[tuple[str, str], tuple[Any, ...]], workers: int) -> dict[Any, Plain]:
    """Results by name, with a line on stderr for what takes long."""
    found, begin = {}, time.monotonic()
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, mp_context=context) as pool:
        waiting = {pool.submit(timed, job[0], *job[1:]): key for key, job in todo.items()}
        for done in as_completed(waiting):
            if done.exception() is not None:
                pool.shutdown(wait=False, cancel_futures=True)
            seconds, found[waiting[done]] = done.result()
            if seconds > 8.0 or len(found) % 25 == 0:
                spent = time.monotonic() - begin
                name = " ".join(waiting[done])
                line = f"{spent:5.0f} s  {len(found)}/{len(todo)}  {name}: {seconds:.1f} s"
                print(line, file=sys.stderr, flush=True)
    return found


def timed(function: Callable[..., Plain], *arguments: Any) -> tuple[float, Plain]:
    """How long it took, and the result."""
    begin = time.monotonic()
    result = function(*arguments)
    return time.monotonic() - begin, result


def write_commands(out: Path, chains: dict[str, Plain]) -> None:
    """The calls, and the summary of the reproduction in a file of its own."""
    calls = {name: chain for key in commands.CHAINS for name, chain in chains[key].items()}
    for call in calls.values():
        summary = call.pop(commands.SUMMARY, None)
        if summary is not None:
            write(out / "summary.json", summary)
    write(out / "commands.json", calls)


def compact(tree: Any) -> str:
    """JSON without spaces; floats by their shortest text that reads back as the same number."""
    return json.dumps(tree, separators=(",", ":"), ensure_ascii=False)


def write(path: Path, tree: Plain) -> None:
    """One line for each name at the top, so that versions differ by lines."""
    lines = (f"{json.dumps(k)}: {compact(x)}" for k, x in tree.items())
    path.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")
