"""What `python -m tests.deploy` does with one name of the registry, in a process of its own."""

from biped_adrc.deploy.apart import TIMES, PythonController, python_calls, walk
from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.loaded import UNOPTIMISED
from biped_adrc.deploy.rounding import PythonComputer
from biped_adrc.deploy.source import source_of
from biped_adrc.errors import InputError
from biped_adrc.hybrid.simulator import RunOptions
from tests.deploy.fuzz import attack
from tests.deploy.pairs import before_touchdown, gait, pairs, proved, robot, some_pairs

OPTIONS = RunOptions(0.55)
"""A step, its touchdown and what comes after it [s]."""


def row(key):
    """The row of a name, how many were exported, the compiler's time [s], and whether all are proved."""
    begin = gait().start(robot())
    found = [
        proved(pair, begin, OPTIONS, UNOPTIMISED, every=5, walks=1)
        for pair in pairs()
        if pair[:2] == key
    ]
    made = [x for x in found if not x.refused]
    why = [x.refused.split(",")[0] for x in found if x.refused]
    worst = ["", ""]
    if made:
        worst = [f"{max(x.rounding.worst for x in made):.2f}"]
        worst.append(f"{max(x.apart.worst for x in made):.2f}")
    cells = [" ".join(key), len(made), len(why), *worst, why[0] if why else ""]
    good = all(x.rounding.worst <= TIMES and x.apart.proved for x in made)
    return f"| {' | '.join(map(str, cells))} |", len(made), sum(x.compiling for x in made), good


def fuzzed(key):
    """What calls of any numbers did with the first thing of a name, in both types."""
    pair = next(pair for pair in some_pairs() if pair[:2] == key)
    try:
        computer = Computer(pair.walker)
    except InputError as reason:
        return f"{key}: refused, {reason}"
    begin = before_touchdown(0.11 if pair.kind == "touchdown" else 0.03)
    run = walk(computer.walker, PythonController(PythonComputer(computer)), begin, RunOptions(0.06))
    given = computer, source_of(computer), python_calls(computer, run)
    seen = [sorted(attack(*given, 20_000, real=real)) for real in ("float64", "float32")]
    return f"{key}: as the header says, {seen}"
