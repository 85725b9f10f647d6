"""What a tuning study found: all candidates, the choice, and what it is worth on held-out walks."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from biped_adrc.bench.parameters import trial
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.shown import Shown
from biped_adrc.tuning.candidate import Candidate, front
from biped_adrc.tuning.held_out import HeldOut
from biped_adrc.tuning.study import TuningStudy


@dataclass(frozen=True)
class Tuned(Shown):
    """What a tuning study found."""

    study: TuningStudy
    """The study."""
    out: Path
    """Its folder."""
    candidates: tuple[Candidate, ...]
    """All candidates as judged on the training set, by number; the as-published setting first."""
    selected: tuple[Candidate, ...]
    """Those on the selection set, as judged there, best first."""
    held_out: tuple[HeldOut, ...]
    """Each measure on the test set, of the chosen and the as-published setting."""

    @property
    def chosen(self) -> Candidate:
        """The chosen candidate, as judged on the selection set."""
        return self.selected[0]

    @property
    def front(self) -> list[Candidate]:
        """The candidates of which none is better in one objective without being worse in another."""
        return front(self.study, self.candidates)

    @property
    def scenario(self) -> Scenario:
        """The scenario of the chosen candidate, without seed and without the values of a condition."""
        return trial(self.study.values(self.chosen.chosen))
