"""Write docs/hip_force.md: the force on the hip that stops the walk, simulated and by quadrature.

Run: python docs/write_hip_force.py [--workers N]

It simulates about forty walks of 25 steps, in some ten minutes on two idle cores.
"""

from __future__ import annotations

import argparse
import sys
from typing import Any

from write_results import ROOT, table

from biped_adrc.errors import BipedError, SimulationError
from biped_adrc.files import write_text
from validation.hip_push import HipPush, PushedWalk, hip_push

COMMAND = "python docs/write_hip_force.py"
NEEDS = (
    "peak torque, N m",
    "friction, mean of 5 ms",
    "friction at an instant",
    "outside the cone, % of time",
    "least F_N, N",
    "clearance, mm",
    "outcome",
)

INTRODUCTION = """\
Written by `{command}`.

A rope pulls RABBIT backwards at the hip with a constant force. The force enters the unactuated row of the
dynamics, so no controller that only tracks a virtual constraint rejects it: the walk slows down whatever the
tracking is. Westervelt, Grizzle and Canudas de Wit (IEEE CDC 2003) report that 3 N stop a gait of 0.50 m/s, and
that a PI from step to step, which corrects the constraint, recovers it.

Here the gait is `{gait}`, designed for 0.50 m/s, for {steps} steps from its periodic orbit on; the
force acts from the first instant. NPD is integrated with RK4, ADRC (Table I) with the exponential method, both
at {h:g} ms, with unlimited torque. The PI bounds its correction to {limit:g} rad. A walk is stopped when it
does not make its steps: it falls, a step lasts more than 2 s, or the law meets a singular matrix on the way
down.
"""

SEARCH = """\
Forces are searched to {resolution:g} N; the walk at the force named and the one just below it were both
simulated, and that more force is never better was taken for granted. The other columns are of the walk just
below: the mean speed of its last five steps, that of its slowest step, and what its steps needed. The outcome
is `legal` where ground and motors of the robot's record could have carried every step, and `made` where all
steps were made and not all of them legally ([what legal means](guide/hardware.md)): friction counts in the mean
of 5 ms, and the outermost values at an instant, the share of the time outside the friction cone and the least
normal force stand beside it. Where a walk is `made`, a real robot would have slipped or lacked torque first;
the model, pinned at its foot and with unlimited torque, does not.

The quadratures know no controller. With exact tracking and $\\zeta = \\sigma_-^2 / 2$ a step is

$$\\zeta \\to \\delta^2 \\zeta - V_F(\\Theta_-), \\qquad \\delta^2 \\zeta > \\max V_F, \\qquad
V_F(\\Theta) = \\int_{\\Theta_+}^{\\Theta} (G_N + z_{hip} F_x) \\, I \\, d\\Theta,$$

where the force adds its moment about the foot to that of gravity (`biped_adrc.analysis.forced_steps`)."""

DIRECTION = """\
The PI adds $\\beta \\, b(s) \\, d$ to the constraint, with a bump $b$ that vanishes at both ends of the step.
The static gain $dv/d\\beta$ of the direction $d$ over the largest change of a motor's torque along the orbit,
$\\max |du/d\\beta|$, does not depend on the scale of $d$. Of the directions below, the largest is taken: the
stance knee, which bends further in the middle of the step to quicken the walk. That lowers the swing foot
there, where it is high enough: no walk above scuffs. A lean of the torso leaves both feet where they are, and
costs more torque."""


def page(study: HipPush) -> str:
    """The page."""
    case = study.limits[0].case
    head = INTRODUCTION.format(
        command=COMMAND, gait=case.gait, steps=case.steps, h=1e3 * case.h, limit=case.limit
    )
    parts = [
        "# A force at the hip",
        head.strip(),
        "## What stops the walk",
        finding(study),
        limits_table(study),
        SEARCH.replace("{resolution:g}", f"{case.resolution:g}"),
        "## At the force that stops the tracking, and above it",
        kept_table(study),
        "## Which joint to bend",
        DIRECTION,
        directions_table(study),
    ]
    return "\n\n".join(parts) + "\n"


def finding(study: HipPush) -> str:
    """What the tables say."""
    lines = []
    for x in study.limits:
        if x.case.stride:
            continue
        held = study.limit(x.case.preset, x.case.tracking, True)
        lines.append(
            f"- `{x.case.preset}`, {x.case.tracking}: {x.stops.force:.1f} N stop it, "
            f"{held.stops.force:.1f} N with the PI (by quadrature {x.predicted:.2f} and "
            f"{held.predicted:.2f} N)."
        )
    inside = sum(x.below.force < x.predicted <= x.stops.force for x in study.limits)
    ends = [len(x.stops.speeds) + 1 for x in study.limits if x.case.stride]
    walked = [w for _, w in study.kept if w.walks]
    if any(w.legality is not None and w.legality.scuffing > 0.0 for _, w in study.kept):
        raise SimulationError(
            "a walk with the PI scuffs its swing foot; the page says that none does"
        )
    gap = max(abs(speed - 0.5) for w in walked if (speed := w.speed()) is not None)
    legal = sum(w.outcome == "legal" for w in walked)
    lines += [
        f"- The quadratures are inside the simulated bracket in {inside} of {len(study.limits)} cases.",
        f"- At the force that stops the tracking, and above, {len(walked)} of {len(study.kept)} walks with "
        f"the PI make all steps, {legal} of them legally; the last five of each are on average within "
        f"{1e3 * gap:.1g} mm/s of 0.50 m/s.",
        f"- The force that stops a walk with the PI does so by step {max(ends)}, in all presets. The loop "
        "has to see a slow step before it acts, so the first steps under the full force decide, not what the "
        "correction could hold in the long run.",
    ]
    return "\n".join(lines)


def limits_table(study: HipPush) -> str:
    """The forces that stop a walk."""
    columns = ["preset", "controller", "stops at, N", "by quadrature, N", "how it ends"]
    rows: list[list[Any]] = []
    for x in study.limits:
        end = f"{x.stops.status.name}, step {len(x.stops.speeds) + 1}"
        force = [f"{x.stops.force:.1f}", f"{x.predicted:.2f}", end]
        speed = [number(x.below.speed(), 3), number(min(x.below.speeds, default=None), 3)]
        rows.append([x.case.preset, x.case.name, *force, *speed, *needs(x.below)])
    return table([*columns, "speed below, m/s", "slowest step, m/s", *NEEDS], rows)


def kept_table(study: HipPush) -> str:
    """The PI's walks."""
    rows = [
        [c.preset, c.name, f"{w.force:.1f}", number(w.speed(), 4), *needs(w)] for c, w in study.kept
    ]
    return table(["preset", "controller", "force, N", "settles at, m/s", *NEEDS], rows)


def directions_table(study: HipPush) -> str:
    """The directions of all presets."""
    columns = ["preset", "direction", "static gain, m/s per rad", "torque, N m per rad"]
    rows = [
        [preset, d.name, f"{d.static_gain:.2f}", f"{d.torque:.0f}", f"{1e3 * d.merit:.2f}"]
        for preset, merits in study.directions.items()
        for d in merits
    ]
    return table([*columns, "gain per torque, mm/s per N m"], rows)


def needs(w: PushedWalk) -> list[str]:
    """What its steps needed, and how it ended."""
    if w.legality is None:
        return [*("-" for _ in NEEDS[1:]), w.outcome]
    r = w.legality.record()
    share = None if r["share_outside"] is None else 100.0 * r["share_outside"]
    return [
        number(r["peak_torque"], 0),
        number(r["mean_friction"], 2),
        number(r["friction"], 2),
        number(share, 1),
        number(r["least_normal_force"], 0),
        number(None if w.clearance is None else 1e3 * w.clearance, 0),
        w.outcome,
    ]


def number(x: float | None, digits: int) -> str:
    """A number of a table, or a dash."""
    return "-" if x is None else f"{x:.{digits}f}"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--workers", type=int, default=2, help="processes")
    workers = parser.parse_args().workers
    try:
        study = hip_push(workers=workers)
        write_text(ROOT / "docs" / "hip_force.md", page(study))
    except BipedError as error:
        print(f"error: {error}", file=sys.stderr)
        return error.exit_code
    print(study.text())
    return 0


if __name__ == "__main__":
    sys.exit(main())
