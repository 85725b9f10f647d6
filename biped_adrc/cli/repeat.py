"""`biped-adrc simulate SESSION`: a session walked again, and whether it is the same bit for bit."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from biped_adrc.cli.app import EXIT_CHECK_FAILED, EXIT_FELL, console, run_path, say, say_written
from biped_adrc.cli.steps import print_on_ground, print_supports
from biped_adrc.files import keep_inputs, output_path

if TYPE_CHECKING:
    from biped_adrc.live.repeated import Replayed
    from biped_adrc.scenario.recording import Walk


def repeat(session: Path, out: Path | None) -> None:
    """Walk a session again, print its steps, and write it where it is asked for; the exit where it differs."""
    from biped_adrc.live.repeated import SUFFIXES, replay_session
    from biped_adrc.scenario.build import limits

    path = _written(out, session)
    with console.status("walking the session again"):
        found = replay_session(session)
    if path is not None:
        # first, as printing may fail
        (found.save if path.suffix.lower() in SUFFIXES else found.walk.export)(path)
    print_on_ground(found.walk.soft_steps)
    print_supports(found.walk.legal_within(limits(found.record.scenario)), _ended(found.walk))
    if found.ghost is not None:
        say(f"the ghost: {_ended(found.ghost)}")
    for remark in (remark for walk in found.walks for remark in walk.remarks):
        say(f"note: {remark}")
    say(verdict(found, session))
    say_written(path)
    if found.gap is not None and not found.same:
        raise typer.Exit(EXIT_CHECK_FAILED)
    if not found.walk.trajectory.status.ok:
        raise typer.Exit(EXIT_FELL)


def _written(out: Path | None, session: Path) -> Path | None:
    """The path that the session is written to, checked; None for none."""
    if out is None or out.suffix.lower() != ".toml":
        return run_path(out, (session,))
    path = output_path(out, (".toml",))
    keep_inputs((path,), (session,))
    return path


def _ended(walk: Walk) -> str:
    """What walked and how it ended, in a sentence."""
    run = walk.trajectory
    return f"{walk.note}: {run.t_end:.4f} s, {run.status.name}: {run.status.value} {run.detail}".strip()


def verdict(found: Replayed, session: Path) -> str:
    """Whether the states are those of the file, in a sentence."""
    whose = f"{found.record.samples} samples" + ("" if found.ghost is None else " of both walks")
    if found.gap is None:
        return f"{whose}; '{session}' has no states to compare them with"
    if found.same:
        return f"{whose}, with the times and states of '{session}', bit for bit"
    return (
        f"{whose}, and the states are not those of '{session}': they differ by {found.gap:.3g} [rad, rad/s] at "
        "most (inf: at other times). Bits are the same on a processor of the same kind with the same version"
    )
