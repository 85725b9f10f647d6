"""What `python -m tests.deploy` does with one name of the registry, in a process of its own."""

import resource

import numpy as np

from biped_adrc.deploy.apart import TIMES, PythonController, python_calls, walk
from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.rounding import PythonComputer
from biped_adrc.deploy.source import source_of
from biped_adrc.errors import InputError
from biped_adrc.hybrid.simulator import RunOptions
from tests.deploy.fuzz import attack
from tests.deploy.pairs import gait, pairs, proved, robot, short_walk, some_pairs

WHO = resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN


def row(key, whole):
    """The row of a name, how many were exported, whether all are proved, and times as `times` has them.

    whole: all things of the name, over a step, its touchdown and what comes after it; else as CI has it.
    """
    used = times()
    chosen = [pair for pair in (pairs() if whole else some_pairs()) if pair[:2] == key]
    long = gait().start(robot()), RunOptions(0.55), 5
    found = [proved(pair, *(long if whole else short_walk(pair))) for pair in chosen]
    made = [x for x in found if not x.refused]
    why = [x.refused.split(",")[0] for x in found if x.refused]
    worst = ["", ""]
    if made:
        worst = [f"{max(x.rounding.worst for x in made):.2f}"]
        worst.append(f"{max(x.apart.worst for x in made):.2f}")
    cells = [" ".join(key), len(made), len(why), *worst, why[0] if why else ""]
    good = all(x.rounding.worst <= TIMES and x.apart.proved for x in made)
    return f"| {' | '.join(map(str, cells))} |", len(made), good, times() - used


def times():
    """Time of processor of this process, and of those that it started and that have ended (2,) [s]."""
    return np.array([sum(resource.getrusage(who)[:2]) for who in WHO])


def fuzzed(key):
    """What calls of any numbers did with the first thing of a name, in both types."""
    pair = next(pair for pair in some_pairs() if pair[:2] == key)
    try:
        computer = Computer(pair.walker)
    except InputError as reason:
        return f"{key}: refused, {reason}"
    python = PythonController(PythonComputer(computer))
    run = walk(computer.walker, python, *short_walk(pair))
    given = computer, source_of(computer), python_calls(computer, run)
    seen = [sorted(attack(*given, 20_000, real=real)) for real in ("float64", "float32")]
    return f"{key}: as the header says, {seen}"
