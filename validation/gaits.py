"""Laws that any periodic gait obeys, on every stored gait whose constraint the impact preserves.

    int u' q_b' dt = KE- - KE+              net joint work is what the impact takes, on level ground
    lambda_1 = delta^2                      the largest multiplier of the closed loop, in closed form
    zeta+ - zeta+' = delta^2 (zeta - zeta') the map of zeta = sigma-^2 / 2 is affine

The closed forms come from the zero dynamics and are compared with the simulated walk, so that both could be
wrong only together. Work by quadrature over the zero dynamics; multipliers of the walk under NPD, once by the
variational equation and once by two walks that start 1 % faster and slower. Westervelt, Grizzle, Koditschek
2003. Called by `validation.groups`.

A stored gait whose impact leaves the constraint, such as gait (b), has no closed form and is left out.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from biped_adrc.analysis.gait_design import design_gait
from biped_adrc.analysis.return_map import ReturnMap
from biped_adrc.analysis.stability import (
    ABSOLUTE,
    INVARIANCE,
    RELATIVE,
    Cycle,
    invariance_gap,
    known_cycle,
    stability_table,
)
from biped_adrc.analysis.variational import periodic_orbit
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Walker
from biped_adrc.control.npd import NPDController
from biped_adrc.core.errors import SimulationError
from biped_adrc.core.files import data_folder
from biped_adrc.core.types import Array
from biped_adrc.gait.design.request import StepLimits
from biped_adrc.gait.gait import Gait, gait_names, load_gait
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.model.biped import Biped
from biped_adrc.scenario.cycle import cycle_of
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.scenario.walk import walk
from validation.passive import simplest
from validation.published_gait import design_published_gait
from validation.recipe import design_recipe_gait
from validation.row import Row, at_most

FASTER = 0.01  # of the speed before impact, dimensionless
ROBOTS = ("rimless_wheel", "compass", "simplest", "three_link", "rabbit")
ENERGY = "energy lost at impact"
"""Where the expected work comes from."""
CLOSED = "delta^2 of the zero dynamics"
"""Where the expected multiplier comes from."""


def invariant_gaits(preset: str) -> tuple[str, ...]:
    """Names of the stored gaits of RABBIT whose constraint the impact preserves (hybrid invariance)."""
    biped, limit = Biped.load("rabbit", preset), INVARIANCE
    gaits = (load_gait(name, biped) for name in gait_names("rabbit", preset))
    return tuple(g.name for g in gaits if invariance_gap(biped, g.constraint) <= limit)


def work_rows(preset: str) -> tuple[Row, ...]:
    """Net joint work of a step [J], one row for every invariant gait."""
    biped = Biped.load("rabbit", preset)
    return tuple(_work_row(biped, load_gait(n, biped)) for n in invariant_gaits(preset))


def _work_row(biped: Biped, gait: Gait) -> Row:
    """The work of one gait by quadrature over its zero dynamics."""
    q, v = gait.q_minus, gait.v_minus
    after = biped.impact(q, v)
    zero = ZeroDynamics.of(biped, gait.constraint)
    orbit = zero.orbit(biped.angular_momentum(after.q, after.v))
    work = float(orbit.time_weights @ np.sum(orbit.u * orbit.v[:, : biped.p], axis=1))
    lost = biped.kinetic_energy(q, v) - biped.kinetic_energy(after.q, after.v)
    name = f"RABBIT {biped.preset}, {gait.name}"
    return Row(name, "net joint work of a step [J]", lost, work, 1e-8, ENERGY)


def multiplier_rows(preset: str, gait: str) -> tuple[Row, ...]:
    """delta^2 of the zero dynamics against the largest multiplier of the simulated walk.

    Twice: by the variational equation along the walk, and by two walks whose starts differ by 2 % of the speed.
    """
    cycle = cycle_of(Scenario("NPD", robot={"preset": preset}, gait=gait))
    biped = cycle.P.walker.plant
    delta2 = ZeroDynamics.of(biped, load_gait(gait, biped).constraint).delta ** 2
    _, step = periodic_orbit(cycle.P, cycle.guess, 1e-7)
    variational = float(step.multipliers[0].real)
    name, walks = f"RABBIT {preset}, {gait}", f"walks that start {FASTER:.0%} faster and slower"
    return (
        Row(name, "largest multiplier, variational equation", delta2, variational, 1e-6, CLOSED),
        Row(name, f"the same, {walks}", delta2, slope_of_zeta(cycle), 1e-6, CLOSED),
    )


def slope_of_zeta(cycle: Cycle) -> float:
    """d zeta+ / d zeta of the simulated walk, from two walks that start faster and slower by the share
    `FASTER`.

    The map is affine, so that the secant over a finite difference is exact.
    """
    biped, (q, v) = cycle.P.walker.plant, np.split(cycle.guess, 2)

    def zeta(x: Array) -> float:
        return 0.5 * biped.angular_momentum(*np.split(x, 2)) ** 2

    before = [np.concatenate((q, (1.0 + side * FASTER) * v)) for side in (1.0, -1.0)]
    after = [cycle.P.lift(cycle.P(cycle.P.project(x))) for x in before]
    return (zeta(after[0]) - zeta(after[1])) / (zeta(before[0]) - zeta(before[1]))


# -- every robot -----------------------------------------------------------------------------------
def designed_three_link() -> Cycle:
    """The three-link walker on a gait designed for it, its foot allowed to scuff."""
    limits = StepLimits(clearance=None)
    gait = design_gait("three_link", 0.9, 0.6, limits=limits).gait
    walker = Walker(Biped.load("three_link"), NPDController(gait.constraint))
    P = ReturnMap(walker, RK4(5e-4), difference=1e-4, pitch=float(gait.q_minus[-1]))
    return Cycle(P, walker.initial_state(gait.q_minus, gait.v_minus))


def robot_cycle(robot: str) -> Cycle:
    """A walking cycle of a registered robot.

    The simplest walker has heavier feet here: with nearly massless ones finite differences of its map are
    noise.
    """
    if robot == "simplest":
        cycle = simplest(1e-4)
        return replace(cycle, P=replace(cycle.P, difference=2e-4))
    if robot == "rabbit":
        return cycle_of(Scenario("NPD"))
    return designed_three_link() if robot == "three_link" else known_cycle(Biped.load(robot))


def robot_rows(robot: str) -> tuple[Row, ...]:
    """All multipliers of a robot's cycle by the variational equation, against extrapolated central differences.

    The second row is the largest gap in units of the tolerance that the stability table itself uses.
    """
    cycle = robot_cycle(robot)
    _, step = periodic_orbit(cycle.P, cycle.guess, 1e-9)
    table = stability_table(cycle.P, step)
    one, other = (float(np.abs(z[0])) for z in (table.central, step.multipliers))
    count = len(table.central)
    unit = f"max({ABSOLUTE:g}, {RELATIVE:g} |lambda|)"
    by = "central differences of the return map"
    name = "simplest, feet of 1e-4 of the hip's mass" if robot == "simplest" else robot
    return (
        Row(name, "largest |multiplier|, variational equation", one, other, 1e-6, by),
        at_most(name, f"gap of all {count}, in units of {unit}", 1.0, table.gap(), by),
    )


SETTLE = 25
"""Impacts that are walked before Newton's method starts."""


def design_recipe_orbit(biped: Biped) -> Gait:
    """Gait (b) with the pre-impact state and the period of its walking cycle under NPD.

    Its impact leaves the constraint, so the closed loop does not walk on the orbit of the zero dynamics. A walk
    settles near the cycle, from where Newton's method on the return map finds it. When there is none the state
    of the zero dynamics is kept, and the provenance says so. Raises GaitError as `design_recipe_gait`.
    """
    gait = design_recipe_gait(biped)
    walker = Walker(biped, NPDController(gait.constraint))
    settled = walk(walker, gait, SETTLE, RK4(1e-3))
    try:
        if not settled.trajectory.status.ok:
            raise SimulationError(settled.trajectory.status.value)
        guess = settled.trajectory.before(FOOT_STRIKE)[-1]
        orbit = ReturnMap(walker, RK4(1e-3)).fixed_point(guess)
    except SimulationError as error:
        return replace(gait, provenance={**gait.provenance, "cycle": f"none found: {error}"})
    q, v = np.split(orbit.x_minus[: 2 * biped.n], 2)
    said = "fixed point of the return map under NPD, Table II, continuous time; largest multiplier"
    told = {**gait.provenance, "cycle": f"{said} {abs(orbit.multipliers[0]):.4f}"}
    found = replace(gait, q_minus=q, v_minus=v, provenance=told)
    step = walk(walker, found, 1, RK4(1e-3))
    return replace(found, period=step.trajectory.t_end)


def write_stored() -> None:
    """Design the paper's gaits (a) and (b) anew in every preset, and write the files in `gaits/`."""
    for preset in ("identified", "identified-bare", "tac2003"):
        biped = Biped.load("rabbit", preset)
        for gait in (design_published_gait(biped), design_recipe_orbit(biped)):
            gait.save(data_folder("gaits") / "rabbit" / gait.file_name)


if __name__ == "__main__":
    write_stored()
