"""How long the pictures of a walk of 25 impacts take to write, and how large they are.

Scenario: python benchmarks/pictures.py
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from biped_adrc.paper.plan import PAPER_PUSH
from biped_adrc.scenario.recording import Walk
from biped_adrc.scenario.run import walk_scenario
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.viz.export import Clip, export

REPEATS = 3


def quickest(write: Callable[[], None]) -> float:
    """Least wall time of some repeats [s]."""
    times = []
    for _ in range(REPEATS):
        began = time.perf_counter()
        write()
        times.append(time.perf_counter() - began)
    return min(times)


def main() -> None:
    walks: dict[str, Walk] = {
        c: walk_scenario(Scenario(c, pushes=(PAPER_PUSH,))) for c in ("NPD", "ADRC")
    }
    one = {"ADRC": walks["ADRC"]}
    with tempfile.TemporaryDirectory() as folder:
        for title, shown, name, clip in (
            ("page, one walk", one, "one.html", Clip(fps=60.0)),
            ("page, two walks", walks, "two.html", Clip(fps=60.0)),
            ("moving picture, 2 s of two walks", walks, "two.gif", Clip(7.4, 9.4)),
            ("strip", one, "strip.png", Clip()),
        ):
            path = Path(folder) / name
            seconds = quickest(lambda p=path, s=shown, c=clip: export(p, s, c))  # type: ignore[misc]
            print(f"{title:<36}{seconds:6.2f} s {path.stat().st_size / 1e6:6.2f} MB")


if __name__ == "__main__":
    main()
