"""What it costs to know whether a walk is legal: walks with the meter and the same walks without it.

Run: python benchmarks/bench/metering.py [OUT] [--quick]

200 walks of 25 impacts at 1 kHz, every one with a push of its own, in one thread: in a batch, and as in a study
where each is made ready and gives a row (of the metered walk in both). Ratios are of CPU times of the same run.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from report import Table, arguments, rounds

from biped_adrc.bench.build import case
from biped_adrc.bench.parameters import trial
from biped_adrc.bench.run import measured
from biped_adrc.engine.batch import BatchWalk, Case, run_case, simulate_many
from biped_adrc.scenario.scenario import Scenario


def trials(controller: str, walks: int, impacts: int) -> list[Scenario]:
    """Pushes drawn by seed."""
    push: dict[str, Any] = {"push": "pulse", "on": "random joints", "amplitude": 40.0}
    return [
        trial({"controller": controller, "impacts": impacts, "seed": seed, **push})
        for seed in range(walks)
    ]


def without(metered: Case) -> Case:
    """The same walk, counting nothing."""
    return replace(metered, walker=replace(metered.walker, meter=None))


def walk(cases: Sequence[Case]) -> list[BatchWalk]:
    """All of them, one after the other."""
    return list(simulate_many(cases, threads=1))


def study(given: Sequence[Scenario], known: Sequence[BatchWalk], metered: bool) -> None:
    """Each made ready and walked; the rows are those of the walks `known`, which were metered."""
    for s, walked in zip(given, known, strict=True):
        made = case(s)
        run_case(made if metered else without(made))()
        measured(s, made, walked)


def check(one: Sequence[BatchWalk], other: Sequence[BatchWalk]) -> None:
    """That the meter reads and does not act. Raises RuntimeError."""
    for a, b in zip(one, other, strict=True):
        if not (a.status is b.status and np.allclose(a.times, b.times, rtol=0.0, atol=1e-9)):
            raise RuntimeError(
                f"with the meter a walk ends {a.status.name}, without {b.status.name}"
            )


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    walks, count = (40, 3) if asked.quick else (200, 3)
    table = Table("Metering", f"CPU s, medians of {count} rounds", f"{walks} walks of 25 impacts")
    for name in ("NPD", "ADRC"):
        given = trials(name, walks, 25)
        metered = [case(s) for s in given]
        plain = [without(one) for one in metered]
        known = walk(metered)
        check(known, walk(plain))
        runs: dict[str, Callable[[], object]] = {
            "with": partial(walk, metered),
            "without": partial(walk, plain),
            "study with": partial(study, given, known, True),
            "study without": partial(study, given, known, False),
        }
        found = {key: seconds.cpu for key, seconds in rounds(runs, count).items()}
        for kind, way in (("batch", ""), ("study", "study ")):
            one, other = found[f"{way}with"], found[f"{way}without"]
            table.add(f"{name}, {kind}", with_meter=one, without=other, ratio=one / other)
    table.finish(asked.out)


if __name__ == "__main__":
    main()
