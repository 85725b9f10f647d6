"""Random scenarios in both engines: what may be said of each, in one word.

An error on purpose (`BipedError`) refuses a scenario and has to come from both engines; whatever a class of the
user's own raises is the user's. All else that is raised is a traceback. Where states of the two engines differ
by more than EQUAL, or statuses do, the start is moved by 1e-14 of itself in several directions in each engine;
what that moves as much says nothing about the engines. Neither does a gap below what half the step moves: the
engines look inside a step of the exponential method in two ways, which differ by the error of the step.
"""

from __future__ import annotations

import traceback
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

import biped_adrc as ba
from biped_adrc.errors import BipedError
from biped_adrc.scenario.walk import walk_in_parts
from tests.photograph.adapter import own
from tests.photograph.adapter.walks import ENGINES, READY, apart
from tests.robustness.draws import wild

EQUAL = 1e-5
"""Of states and times, in units of max(1, |x|)."""
MOVE, TRIES, FACTOR = 1e-14, 4, 100.0
"""How far the start is moved, how often, and how much more than that the engines may differ."""
SAME, REFUSED, THEIRS, SENSITIVE = "the same", "refused", "own error", "sensitive to 1e-14"
WITHIN = "within the error of the step"
TRACEBACK, NAN, STATUSES, STATES = "TRACEBACK", "NAN", "STATUSES DIFFER", "STATES DIFFER"
FAULTS = (TRACEBACK, NAN, STATUSES, STATES)
Plain = dict[str, Any]
Walks = Callable[..., ba.Walk]
"""A walk by engine, what its start is moved by, and the share of its step; see `walked`."""


def judged(k: int) -> Plain:
    """The word for scenario k, what it is from, and the statuses of its walks."""
    s = wild(k)
    word, why, status = compared(partial(walked, s))
    return {"k": k, "kind": s["kind"], "word": word, "why": why, "status": status}


def compared(walk: Walks) -> tuple[str, str, list[str]]:
    """The word for a walk in both engines, its reason, and its status."""
    ends = [attempt(walk, engine) for engine in ENGINES]
    status = [end["status"] for end in ends if "status" in end]
    return *verdict(walk, ends), status[:1]


def attempt(walk: Walks, *given: Any) -> Plain:
    """The end of one walk as plain values, or its error. given: as to `walked`, from the engine on."""
    try:
        with np.errstate(all="ignore"):
            return end_of(walk(*given))
    except BipedError as error:
        return {"refused": str(error)}
    except Exception as error:  # what the fuzz looks for, but for a class that raises on purpose
        where = traceback.extract_tb(error.__traceback__)[-1].filename
        kind = "theirs" if where == own.__file__ else "traceback"
        return {kind: f"{type(error).__name__}: {error}"}


def walked(s: Plain, engine: str, moved: Any = None, share: float = 1.0) -> ba.Walk:
    """One walk. moved: random numbers, by which the start is moved. share: of steps of fixed length."""
    ready = READY[s["kind"]](s)
    q, v = ready.q, ready.v
    if moved is not None:
        q, v = q * (1.0 + MOVE * moved[: len(q)]), v * (1.0 + MOVE * moved[-len(v) :])
    given = {"start": (q, v), "first_step": ready.first_step, "engine": engine}
    parts = ready.parts(ENGINES[0])  # of both, since the default steps of the engines differ
    if share != 1.0:
        shorter = [getattr(part.method, "h", 0.0) * share for part in parts]
        parts = tuple(
            part._replace(method=replace(part.method, h=h)) if h else part
            for part, h in zip(parts, shorter, strict=True)
        )
    return walk_in_parts(ready.walker, ready.gait, parts, **given)


def end_of(walk: ba.Walk) -> Plain:
    """Status, times and states of a walk, and what of it is not finite."""
    run, n = walk.trajectory, walk.walker.plant.n
    events = run.events("foot_strike")
    states = [e.x_minus[: 2 * n] for e in events]
    return {
        "status": run.status.name,
        "impacts": len(events),
        "times": [e.t for e in events],
        "states": np.concatenate([*states, np.zeros(0)]).tolist(),
        "bad": [name for name, x in stored(walk) if not np.all(np.isfinite(x))],
    }


def stored(walk: ba.Walk) -> Iterator[tuple[str, Any]]:
    """Everything that a walk keeps or shows, by name; an estimate that there is not is NaN by definition."""
    run = walk.trajectory
    for i, arc in enumerate(run.arcs):
        yield from ((f"arc {i} {name}", getattr(arc, name)) for name in ("t", "x", "dx"))
        yield from ((f"arc {i} {name}", x) for name, x in arc.read.items() if name != "xi_estimate")
    for e in run.events():
        yield f"{e.guard} x_minus", e.x_minus
        if e.x_plus is not None:
            yield f"{e.guard} x_plus", e.x_plus
    yield "final_state", run.final_state
    for name in ("q", "v", "u", "error", "zeta", "kinetic", "potential", "ground_reaction"):
        x = getattr(walk.signals, name, None)
        if x is not None:
            yield f"signal {name}", x
    for name in ("legality", "soft_steps", *(["outcome"] if walk.scenario else [])):
        getattr(walk, name)  # may be infinite, as a friction of no normal force, but raises nothing


def verdict(walk: Walks, ends: list[Plain]) -> tuple[str, str]:
    """A word and its reason, from the ends in both engines."""
    for word, name in ((TRACEBACK, "traceback"), (NAN, "bad")):
        if why := [end[name] for end in ends if end.get(name)]:
            return word, str(why)
    for word, name in ((REFUSED, "refused"), (THEIRS, "theirs")):
        if any(name in end for end in ends):
            both = all(name in end for end in ends)
            return (word, "") if both else (STATUSES, str(ends)[:400])
    alike = same(*ends)
    gap = distance(*ends) if alike else np.inf
    if gap <= EQUAL:
        return SAME, ""
    random = np.random.default_rng(5)
    for _ in range(TRIES):
        for end, engine in zip(ends, ENGINES, strict=True):
            other = attempt(walk, engine, random.standard_normal(20))
            if not same(end, other) or gap <= FACTOR * distance(end, other):
                return SENSITIVE, ""
    told = [(end["status"], end["impacts"]) for end in ends]
    if not alike:
        return STATUSES, str(told)
    half = attempt(walk, ENGINES[0], None, 0.5)
    if same(ends[0], half) and gap <= distance(ends[0], half):
        return WITHIN, ""
    return STATES, f"{gap:.1e} {told[0]}"


def same(a: Plain, b: Plain) -> bool:
    """Whether two walks ended alike."""
    return all(a.get(name) == b.get(name) for name in ("status", "impacts"))


def distance(a: Plain, b: Plain) -> float:
    """How far their impacts are apart."""
    return max(apart(a[name], b[name]) for name in ("times", "states"))


def table(found: list[Plain]) -> str:
    """How many of what, by kind of scenario, and how the walks ended, as Markdown."""
    kinds = sorted({x["kind"] for x in found})
    words = (SAME, SENSITIVE, WITHIN, REFUSED, THEIRS, *FAULTS)
    count = Counter((x["kind"], x["word"]) for x in found)
    lines = [f"| | {' | '.join(kinds)} | all |", "|---" * (len(kinds) + 2) + "|"]
    for word in words:
        row = [count[kind, word] for kind in kinds]
        lines.append(f"| {word} | {' | '.join(map(str, row))} | {sum(row)} |")
    ended = Counter(status for x in found for status in x["status"])
    told = ", ".join(f"{status} {n}" for status, n in ended.most_common())
    return "\n".join([*lines, "", f"How the walks ended: {told}."])


def faults(found: list[Plain]) -> list[str]:
    """A line for each fault."""
    return [f"{x['k']} {x['kind']}: {x['word']} {x['why']}" for x in found if x["word"] in FAULTS]
