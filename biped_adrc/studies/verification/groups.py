"""The groups of the verification, each with what it says and the functions that make its rows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from biped_adrc.errors import InputError
from biped_adrc.studies.verification.design import SPEEDS, design_rows, through_rows
from biped_adrc.studies.verification.frost_urdf import sense_rows
from biped_adrc.studies.verification.gaits import (
    PRESETS,
    ROBOTS,
    invariant_gaits,
    multiplier_rows,
    robot_rows,
    work_rows,
)
from biped_adrc.studies.verification.hip import hip_rows, published_force_rows
from biped_adrc.studies.verification.paper import fixed_point_rows, poles_row
from biped_adrc.studies.verification.passive import (
    ball_rows,
    compass_rows,
    heavy_feet_rows,
    short_step_rows,
    simplest_rows,
    wheel_rows,
)
from biped_adrc.studies.verification.rabbit import designed_rows, printed_rows
from biped_adrc.studies.verification.row import Row
from biped_adrc.studies.verification.three_link import three_link_rows

Maker = Callable[[], tuple[Row, ...]]

PASSIVE = """\
The hybrid loop alone on a bouncing ball, then walkers that gravity drives down a slope. Where a source prints
the digits they are its own; the others were recomputed from the published model by a separate derivation. The
simplest walker has feet of 1e-7 of the hip's mass here, and none in the source, which is what is left of the
difference. With heavier feet a simulation by others, in its own coordinates, agrees far closer."""

THREE_LINK = """\
A torso and two legs without knees, two motors, under a feedback of two published outputs."""

TAC = """\
Westervelt, Grizzle and Koditschek give four numbers of the zero dynamics of their gait of 1.05 m/s, but not
its coefficients, so that the gait itself cannot be recomputed. What can be asked is whether their numbers obey
the formulae used here, which they do, and what the design of this package gives for the same robot and speed.

The two gaits differ, and are expected to. Theirs is a minimum of the squared torque per length of the step as
well, but found by another optimiser, over other parameters and under other constraints. Here the friction of
the impulse is limited to that of the ground, 0.6, the swing foot has to clear the ground by 2 % of the leg in
the middle of the step, and 2 % of friction and torque are kept in reserve. With the step length left free the
gait found here takes a long step, which loses much angular momentum at impact, so that its delta^2 is the
smaller one. Asked for a step of 0.4 m at the same speed, delta^2 comes to theirs; V_zero and K, which depend on
the path between the impacts, stay apart. No peak torque and no cost of their gait could be found to put beside
those of the note."""

PAPER = """\
The paper prints x* with three decimals, q5 with four. The published gait of this package is designed to pass
through it: these rows say that the simulated walk comes back to it, with the multiplier that the printed digits
give for any gait through x* that its impact does not leave. The multipliers that the paper prints are no
target, as they come from a regression on a disturbed walk; `tests/test_stability.py` has more on that."""

WORK = """\
On level ground a periodic step ends with the potential energy it began with, so that the joints give what the
impact takes. On every stored gait that its impact does not leave, by quadrature over the zero dynamics;
`tests/test_work.py` asks the same of simulated steps."""

MULTIPLIERS = """\
The largest multiplier of the closed loop in closed form, against the walk simulated under NPD (RK4, 0.5 ms): by
the variational equation, and by two walks beside the cycle. The return map takes zeta = sigma-^2 / 2 to
delta^2 zeta - V, so that the difference quotient of two walks is delta^2 itself, however far they are apart."""

ROBOT = """\
All multipliers of one cycle of every registered robot, by the variational equation and by central differences
of the return map, extrapolated. Round-off of the impact limits the differences of the simplest walker, so that
its feet are heavier here."""

DESIGN = """\
Gaits of least squared torque from a cold start, with no stored gait as a guess. The time is that of the
processor, with the two steps under NPD that certify the gait and the loading of the robot."""

HIP = """\
A gait of 0.50 m/s of the literature stopped at a constant force of 3 N backwards at the hip under any loop that
only tracks, and a PI on the stride recovered it. The same for the gait of 0.50 m/s designed here: alone under
NPD and ADRC, and with the PI. The whole study, with the forces that stop the PI, is in [a force at
the hip](hip_force.md)."""

SENSES = """\
The same robot in URDFs as others write them: D, Omega and the rates after impact at random states, taken to the
coordinates of the registered one."""


@dataclass(frozen=True)
class Group:
    """`text` is Markdown; `makers` give the rows, part by part."""

    name: str
    title: str
    text: str
    makers: tuple[Maker, ...]


def groups() -> tuple[Group, ...]:
    """All of them, in the order of the page."""
    passive = (
        ball_rows,
        wheel_rows,
        simplest_rows,
        short_step_rows,
        heavy_feet_rows,
        compass_rows,
    )
    fixed_points = tuple(partial(fixed_point_rows, preset) for preset in PRESETS)
    works = tuple(partial(work_rows, preset) for preset in PRESETS)
    multipliers = tuple(
        partial(multiplier_rows, preset, gait)
        for preset in PRESETS
        for gait in invariant_gaits(preset)
    )
    robots = tuple(partial(robot_rows, robot) for robot in ROBOTS)
    designed = tuple(
        partial(design_rows, preset, speed)
        for preset in ("identified", "tac2003")
        for speed in SPEEDS
    )
    example = (printed_rows, designed_rows, partial(designed_rows, 0.4))
    pushed = tuple(partial(hip_rows, tracking) for tracking in ("NPD", "ADRC"))
    through = tuple(partial(through_rows, preset) for preset in ("identified", "tac2003"))
    return (
        Group("passive", "Systems without motors", PASSIVE, passive),
        Group("three-link", "The three-link walker", THREE_LINK, (three_link_rows,)),
        Group("tac2003", "RABBIT at 1.05 m/s", TAC, example),
        Group("paper", "The paper", PAPER, (poles_row, *fixed_points)),
        Group("work", "Work of a step", WORK, works),
        Group("multipliers", "The multiplier in closed form", MULTIPLIERS, multipliers),
        Group("robots", "Two ways to every multiplier", ROBOT, robots),
        Group("design", "Gait design", DESIGN, (*designed, *through)),
        Group("hip", "A force at the hip", HIP, (published_force_rows, *pushed)),
        Group("senses", "One robot in other coordinates", SENSES, (sense_rows,)),
    )


def group_named(name: str) -> Group:
    """Raises InputError with the names there are."""
    found = {group.name: group for group in groups()}
    if name not in found:
        raise InputError(f"there is no group '{name}'; choose one of {list(found)}")
    return found[name]
