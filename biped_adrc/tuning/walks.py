"""The walks of candidates, carried out as those of a sweep: on any workers, stored run by run, found again.

A walk's row is kept under the hash of its scenario, so that a setting that comes twice is walked once, and a
search that was killed finds its walks when it is repeated.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from biped_adrc.bench.study import CONDITION
from biped_adrc.campaign.chunk import Function, key_of, text_of
from biped_adrc.campaign.execute import LARGEST_CHUNK, Progress, run_study
from biped_adrc.campaign.store import Store
from biped_adrc.campaign.workers import Crew
from biped_adrc.tuning.measure import Walks
from biped_adrc.tuning.study import CANDIDATE, SET, TuningStudy
from biped_adrc.tuning.variables import Values


@dataclass
class StoredWalks:
    """A function from settings to walks, which walks what the store does not have yet."""

    study: TuningStudy
    """Whose sets of walks are walked."""
    function: Function
    """What makes rows of records."""
    store: Store
    """The open file of results."""
    crew: Crew
    """Who walks."""
    progress: Callable[[Progress], None] | None = None
    """Called now and then."""
    done: int = 0
    """Walks asked for in earlier calls."""
    fresh: int = 0
    """Those of them that were walked now."""
    begin: float = field(default_factory=time.monotonic)
    """When the search began [s]."""

    def __call__(self, kind: str, asked: Sequence[tuple[int, Values]]) -> list[Walks]:
        """The walks of each setting on a set; asked: numbers of candidates, values of their scenarios."""
        points = [
            point
            for number, values in asked
            for point in self.study.walks(kind).points(values, {SET: kind, CANDIDATE: number})
        ]
        if not points:
            return []
        keys = [key_of(text_of(point.record)) for point in points]
        chunk = max(1, min(LARGEST_CHUNK, len(points) // 16))
        told = {"chunk": chunk, "total": len(points), "first": self.done}
        done = run_study(self.function, points, self.store, self.crew, progress=self.tell, **told)
        self.done, self.fresh = self.done + len(points), self.fresh + done.fresh
        rows = self.store.rows(keys)
        named = [(str(p.at[CONDITION]), rows[key]) for p, key in zip(points, keys, strict=True)]
        count = self.study.walks(kind).count
        return [named[i : i + count] for i in range(0, len(named), count)]

    @property
    def total(self) -> int:
        """Walks of the whole study; fewer where settings come twice or are not walked."""
        s = self.study
        counts = {"training": s.budget, "selection": s.finalists + 1, "test": 2}
        return sum(s.walks(kind).count * count for kind, count in counts.items())

    def tell(self, p: Progress) -> None:
        """Report how far the whole study is, by what a round says of itself."""
        if self.progress is None:
            return
        done, fresh, total = (
            self.done + p.done,
            self.fresh + p.fresh,
            max(self.total, self.done + p.done),
        )
        left = (time.monotonic() - self.begin) / fresh * (total - done) if fresh else None
        self.progress(Progress(done, total, fresh, left, p.note))

    def note(self, text: str) -> None:
        """Tell the user a sentence between rounds."""
        self.tell(Progress(0, None, 0, None, text))

    def end(self) -> None:
        """Report that nothing is left to walk."""
        if self.progress is not None:
            self.progress(Progress(self.done, self.done, self.fresh, 0.0))
