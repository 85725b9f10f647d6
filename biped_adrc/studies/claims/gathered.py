"""All that the claims rest on, and the tasks that compute it; each preset in its own processes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from biped_adrc.studies.claims import evidence
from biped_adrc.studies.claims.admissible import members
from biped_adrc.studies.claims.evidence import Cycle, Jumps, Needs, Pair, Start
from biped_adrc.studies.claims.orders import Order, orders
from biped_adrc.studies.claims.walks import MemberOutcome, tried_all
from biped_adrc.studies.pool import Task

PRESET_PARTS = ("cycles", "needs", "unmatched", "uncertainty", "pushed_recipe", "basin", "jumps")


@dataclass(frozen=True)
class Evidence:
    """Outcomes of all runs for the claims, over the presets that were asked for."""

    members: tuple[MemberOutcome, ...]
    cycles: tuple[Cycle, ...]
    needs: tuple[Needs, ...]
    unmatched: tuple[Pair, ...]
    uncertainty: tuple[Pair, ...]
    pushed_recipe: tuple[MemberOutcome, ...]
    basin: tuple[Start, ...]
    jumps: tuple[Jumps, ...]
    orders: tuple[Order, ...]


def preset_evidence(preset: str) -> dict[str, tuple[Any, ...]]:
    """What is computed once for a preset, beside the members of the set."""
    return {part: getattr(evidence, part)(preset) for part in PRESET_PARTS}


def claim_tasks(presets: tuple[str, ...]) -> dict[str, Task]:
    """By name, the longest first."""
    out = {}
    for preset in presets:
        of_preset = tuple(member for member in members() if member.preset == preset)
        out[f"claims members {preset}"] = Task(
            f"claims, {len(of_preset)} pushes, {preset}", tried_all, (of_preset,)
        )
    for preset in presets:
        out[f"claims rest {preset}"] = Task(
            f"claims, cycles and needs, {preset}", preset_evidence, (preset,)
        )
    out["claims orders"] = Task("claims, order of the observer", orders, (presets[0],))
    return out


def gathered(presets: tuple[str, ...], found: Mapping[str, Any]) -> Evidence:
    """The evidence in the results of `claim_tasks`, by their names behind "claims"."""
    rest = [found[f"rest {preset}"] for preset in presets]
    parts = {part: tuple(x for one in rest for x in one[part]) for part in PRESET_PARTS}
    tried = tuple(o for preset in presets for o in found[f"members {preset}"])
    return Evidence(members=tried, orders=found["orders"], **parts)
