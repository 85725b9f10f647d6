"""All that the claims rest on, and the tasks that compute it in parts.

`paper.plan` runs `claim_tasks`; `claims.table` reads the `Evidence`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields

from biped_adrc.paper.claims.admissible import members
from biped_adrc.paper.claims.evidence import (
    GaitCycle,
    Jumps,
    Needs,
    Pair,
    Start,
    basin,
    cycles,
    jumps,
    needs,
    pushed_recipe,
    uncertainty,
    unmatched,
)
from biped_adrc.paper.claims.orders import Order, orders
from biped_adrc.paper.claims.walks import (
    MemberOutcome,
    tried,
)
from biped_adrc.processes import Task


@dataclass(frozen=True)
class Evidence:
    """All that the claims rest on, for the presets asked for; also a part of it, with the other
    fields empty.
    """

    members: tuple[MemberOutcome, ...] = ()
    """The push on the joints at all admissible choices."""
    cycles: tuple[GaitCycle, ...] = ()
    """As of `cycles`."""
    needs: tuple[Needs, ...] = ()
    """As of `needs`."""
    unmatched: tuple[Pair, ...] = ()
    """As of `unmatched`."""
    uncertainty: tuple[Pair, ...] = ()
    """As of `uncertainty`."""
    pushed_recipe: tuple[MemberOutcome, ...] = ()
    """As of `pushed_recipe`."""
    basin: tuple[Start, ...] = ()
    """As of `basin`."""
    jumps: tuple[Jumps, ...] = ()
    """As of `jumps`."""
    orders: tuple[Order, ...] = ()
    """Observers of different order, as of `claims.orders`."""


def member_evidence(preset: str) -> Evidence:
    """The push on the joints at the choices with this preset."""
    return Evidence(members=tuple(tried(m) for m in members() if m.preset == preset))


def preset_evidence(preset: str) -> Evidence:
    """What is computed once for a preset, beside the members of the set."""
    return Evidence(
        cycles=cycles(preset),
        needs=needs(preset),
        unmatched=unmatched(preset),
        uncertainty=uncertainty(preset),
        pushed_recipe=pushed_recipe(preset),
        basin=basin(preset),
        jumps=jumps(preset),
    )


def order_evidence(preset: str) -> Evidence:
    """Observers of different order in this preset."""
    return Evidence(orders=orders(preset))


def claim_tasks(presets: tuple[str, ...]) -> dict[str, Task[Evidence]]:
    """The tasks by name, the longest first; each returns a part of the evidence.

    Per preset one task for the members of the set and one for all else; one for the observers of different
    order.
    """
    out = {}
    for preset in presets:
        count = sum(member.preset == preset for member in members())
        out[f"claims members {preset}"] = Task(
            f"claims, {count} pushes, {preset}", member_evidence, (preset,)
        )
    for preset in presets:
        out[f"claims rest {preset}"] = Task(
            f"claims, cycles and needs, {preset}", preset_evidence, (preset,)
        )
    out["claims orders"] = Task("claims, order of the observer", order_evidence, (presets[0],))
    return out


def gathered(parts: Iterable[Evidence]) -> Evidence:
    """The whole evidence of its parts, field by field in the order of the parts."""
    found = tuple(parts)
    names = (field.name for field in fields(Evidence))
    return Evidence(**{x: tuple(y for part in found for y in getattr(part, x)) for x in names})
