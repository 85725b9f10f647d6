"""`biped-adrc gait design`: gaits by optimisation, one or a library by speed.

`analysis.gait_design.design_gait` solves the programme with IPOPT and certifies the gait by walking
it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.table import Table

from biped_adrc.cli.app import GAITS, command, console, gait_app, inputs, say_written, target
from biped_adrc.cli.options import options, with_sets
from biped_adrc.core.errors import GaitError, InputError
from biped_adrc.core.files import check_folder

if TYPE_CHECKING:
    from biped_adrc.gait.gait import Gait
    from biped_adrc.model.biped import Biped


MOST_SPEEDS = 1000
"""Largest number of speeds in a range FIRST:LAST:STEP."""


@dataclass(frozen=True)
class Curves:
    """What --set says of a design besides `limits.NAME` (`gait.design.request.StepLimits`)."""

    curve: str = "bezier"
    """Kind of the curves, of the registry: bezier or bspline."""
    degree: int = 6
    """One less than they have coefficients."""
    nodes: int = 24
    """Gauss nodes at which the limits are kept."""
    through: tuple[float, ...] | None = None
    """Pre-impact state q-, q'- (2 n numbers) that the orbit passes, in place of speed and step."""


@gait_app.command("design")
@options("gait.design")
def gait_design(
    speed: float | None = None,
    step: float | None = None,
    speeds: str | None = None,
    robot: str = "rabbit",
    preset: str | None = None,
    slope: float = 0.0,
    minimise: str = "torque",
    sets: list[str] | None = None,
    out: Path | None = None,
) -> None:
    """Design a periodic, feasible, stable gait for a speed, a step, or both, and certify it by walking."""
    from biped_adrc.analysis.gait_design import design_gait
    from biped_adrc.gait.design.request import StepLimits
    from biped_adrc.model.biped import Biped

    of_limits = [text for text in sets or () if text.startswith("limits.")]
    c = with_sets(Curves, [text for text in sets or () if text not in of_limits])
    limits = with_sets(StepLimits, [text.removeprefix("limits.") for text in of_limits])
    if speeds is None:
        out = target(out, GAITS, inputs(robot))
    elif speed is not None or step is not None:
        raise InputError("--speeds is given beside a --speed or a --step; give one of them")
    biped = Biped.load(robot, preset)
    how: dict[str, Any] = {"slope": slope, "objective": minimise, "limits": limits}
    how |= {"curve": c.curve, "degree": c.degree, "nodes": c.nodes}
    if speeds is not None:
        _library(biped, speeds, how, Path("gait-library") if out is None else out)
        return
    through = None if c.through is None else (c.through[: biped.n], c.through[biped.n :])
    with console.status("IPOPT designs the gait"):
        result = design_gait(biped, speed, step, through=through, **how)
    console.print(result.text(), highlight=False)
    path = out or Path(result.gait.file_name)
    _save(result.gait, path)
    say_written(path)


def _library(biped: Biped, speeds: str, how: dict[str, Any], out: Path) -> None:
    """Design a gait for every speed, each from a cold start, and store those that were found in a folder."""
    from biped_adrc.analysis.gait_design import design_gait

    check_folder(out)
    table = Table("m/s", "step [m]", "torque [N m]", "friction", "delta^2", "transport", "s")
    missed = []
    for speed in _speeds(speeds):
        with console.status(f"{speed:g} m/s"):
            try:
                result = design_gait(biped, speed, **how)
            except GaitError as error:
                missed.append(f"{speed:g} m/s: {error}")
                continue
        _save(result.gait, out / result.gait.file_name)
        c = result.certificate
        table.add_row(
            f"{result.speed:.3f}",
            f"{c.step_length:.3f}",
            f"{c.peak_torque:.1f}",
            f"{c.friction:.2f}",
            f"{result.multiplier:.3f}",
            f"{c.cost_of_transport:.3f}",
            f"{result.seconds:.1f}",
        )
    if table.row_count:
        console.print(table)
        console.print(f"written to {out}")
    if missed:
        raise GaitError("; ".join(missed))


def _save(gait: Gait, path: Path) -> None:
    """Write the gait, with this command line in its provenance."""
    replace(gait, provenance={**gait.provenance, "command": command()}).save(path)


def _speeds(text: str) -> tuple[float, ...]:
    """Speeds [m/s] from "0.4,0.5" or "0.4:1.1:0.1", the last one counted where it is met. Raises InputError."""
    try:
        if ":" in text:
            first, last, by = (float(word) for word in text.split(":"))
            if not (by > 0.0 and last >= first and (last - first) / by < MOST_SPEEDS):
                raise ValueError
            count = math.floor((last - first) / by + 1e-9) + 1
            return tuple(round(first + k * by, 9) for k in range(count))
        return tuple(float(word) for word in text.split(","))
    except ValueError:
        raise InputError(
            f"speeds are '{text}', expected numbers as '0.4,0.5,0.6' or FIRST:LAST:STEP as '0.4:1.1:0.1' [m/s]"
        ) from None
