"""RABBIT beside what is published: the paper, an example of zero dynamics, a force at the hip, gait design.

x* is met by construction, as the published gait is designed through it; that the walk comes back to it, and
with which multiplier, is not. The angular momentum about the stance foot gives that from the printed digits,

    delta^2 = (sigma+ / sigma-)^2,   sigma+ after the impact of x*, about the new foot

Westervelt, Grizzle, Koditschek, IEEE TAC 48(1), 2003, walk at 1.05 m/s, with

    zeta = sigma-^2 / 2,   zeta+ = delta^2 zeta - V_zero(Theta-),   zeta* = -V_zero(Theta-) / (1 - delta^2)

The force at the hip that stops the gait of 0.50 m/s is predicted by a quadrature on the zero dynamics; walks
are simulated. Every designed gait is walked two steps under NPD, and its certificate is taken from that walk.

Rows beside numbers of another gait or robot have no tolerance: they show the order of magnitude and assert
nothing.
"""

from __future__ import annotations

from time import process_time

import numpy as np

from biped_adrc.analysis.gait_design import DesignedGait, design_gait
from biped_adrc.analysis.return_map import ReturnMap
from biped_adrc.analysis.variational import periodic_orbit
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.npd import NPDController
from biped_adrc.gait.design.request import StepLimits
from biped_adrc.gait.gait import Gait, load_gait, onto_section
from biped_adrc.gait.published import X_STAR
from biped_adrc.gait.zero_dynamics import ZeroDynamics
from biped_adrc.gait.zero_orbits import ZeroOrbits
from biped_adrc.hybrid.integrators import Adaptive
from biped_adrc.model.biped import Biped
from biped_adrc.observers.gpi import TABLE_I
from biped_adrc.paper.reproduction import PRINTED_TABLE_I
from biped_adrc.scenario.cycle import cycle_of
from biped_adrc.scenario.scenario import Scenario
from validation.hip_push import HipCase, PushedWalk
from validation.row import PRESETS, Row, at_most, nothing

PAPER = "the paper, section VI"
"""Source of what the paper prints."""


def poles_row() -> tuple[Row, ...]:
    """Table I, printed in whole rad/s, follows 180 x 1.8^k."""
    gap = np.abs(np.array(PRINTED_TABLE_I, dtype=float) - np.array(TABLE_I))
    quantity = "180 x 1.8^k, k = 0..8: largest gap to Table I [rad/s]"
    return (nothing("observer", quantity, np.max(gap), 0.5, "the paper, Table I"),)


def fixed_point_rows(preset: str) -> tuple[Row, ...]:
    """The published gait under NPD: x* within half a unit of its last printed digits, and its multiplier.

    The multiplier is compared with (sigma+ / sigma-)^2 at the printed x*, for which no simulation is needed.
    The height of the swing foot at x* shows how exact the printed angles are.
    """
    biped, (q, v) = Biped.load("rabbit", preset), np.split(X_STAR, 2)
    cycle = cycle_of(Scenario("NPD", robot={"preset": preset}))
    _, step = periodic_orbit(cycle.P, cycle.guess, 1e-8)
    gap = np.abs(cycle.P.lift(step.image) - X_STAR)
    name = f"RABBIT {preset}, published gait"
    built = "the gait is designed through x*; half a unit of the last printed digit"
    height = abs(float(biped.swing_foot(q)[1]))
    gaps = (
        ("q1..q4 after a simulated step: largest gap to x* [rad]", np.max(gap[:4]), 5e-4),
        ("q5: gap to x* [rad]", gap[4], 5e-5),
        ("rates: largest gap to x* [rad/s]", np.max(gap[5:]), 5e-4),
    )
    after = biped.impact(q, v)
    delta = biped.angular_momentum(after.q, after.v) / biped.angular_momentum(q, v)
    multiplier = float(step.multipliers[0].real)
    momenta = "(sigma+ / sigma-)^2 at the printed x*"
    foot, digits = "height of the swing foot at x* as printed [m]", "the angles have three decimals"
    return (
        nothing(name, foot, height, 5e-4, PAPER, digits),
        *(nothing(name, *gap, PAPER, built) for gap in gaps),
        Row(name, "largest multiplier of the walk", delta**2, multiplier, 1e-3, momenta),
    )


TAC = "Westervelt, Grizzle, Koditschek 2003, example at 1.05 m/s"
"""Source of the printed digits of the example."""
ZETA, DELTA2, V_END, K = 979.0, 0.638, -354.4, 260.4
"""zeta*, delta^2, V_zero(Theta-) and K as printed, zeta, V and K in [kg^2 m^4/s^2]."""
UNIT = "[kg^2 m^4/s^2]"
"""Of zeta."""


def printed_rows() -> tuple[Row, ...]:
    """The printed digits among themselves: do they satisfy the formulae of the zero dynamics?"""
    existence = DELTA2 / (1.0 - DELTA2) * V_END + K
    name = "RABBIT tac2003, 1.05 m/s, as printed"
    return (
        Row(name, f"zeta* = -V / (1 - delta^2) {UNIT}", ZETA, -V_END / (1.0 - DELTA2), 1e-3, TAC),
        at_most(name, f"delta^2 / (1 - delta^2) V + K, orbit exists {UNIT}", 0.0, existence, TAC),
    )


def designed_rows(step: float | None = None) -> tuple[Row, ...]:
    """The gait found at 1.05 m/s beside the example of the literature; step length [m], None leaves it free.

    zeta*, delta^2 and V_zero of another gait of the same speed have no target: the rows show them side by side.
    """
    found = design_gait("rabbit", 1.05, step, preset="tac2003")
    biped = Biped.load("rabbit", "tac2003")
    orbits = ZeroOrbits.of(ZeroDynamics.of(biped, found.gait.constraint))
    asked = "" if step is None else f", step {step:g} m"
    name = f"RABBIT tac2003, 1.05 m/s{asked}, designed here"
    beside = (
        ("delta^2", DELTA2, orbits.delta**2),
        (f"V_zero(Theta-) {UNIT}", V_END, orbits.v_end),
        (f"K = max V_zero {UNIT}", K, orbits.v_max),
        (f"zeta* {UNIT}", ZETA, orbits.zeta_star),
    )
    shown = tuple(Row(name, label, printed, value, None, TAC) for label, printed, value in beside)
    return (*shown, *_own_rows(name, found, orbits))


def _own_rows(name: str, found: DesignedGait, orbits: ZeroOrbits) -> tuple[Row, ...]:
    """Of the designed gait alone: its speed, and zeta* of its zero dynamics against a simulated step.

    Torques, step length and friction of the gait are in the note.
    """
    gait, biped = found.gait, orbits.zero.biped
    P = ReturnMap(Walker(biped, NPDController(gait.constraint)), Adaptive(1e-10, 1e-10))
    s = P.project(np.concatenate((gait.q_minus, gait.v_minus)))
    sigma = biped.angular_momentum(*np.split(P.lift(P(s)), 2))
    c = found.certificate
    torques = (
        f"peak torque {c.peak_torque:.1f} N m, int u'u dt / step {found.objective:.0f} N^2 m s, step "
        f"{c.step_length:.3f} m, friction {c.friction:.2f}, of the impulse {c.impulse_ratio:.2f}"
    )
    walked, law = f"zeta after a simulated step {UNIT}", "zeta* of its zero dynamics"
    return (
        Row(name, "speed [m/s]", 1.05, found.speed, 1e-6, "as asked", note=torques),
        Row(name, walked, orbits.zeta_star, 0.5 * sigma**2, 1e-6, law),
    )


ANOTHER = "Westervelt, Grizzle, Canudas de Wit 2003, another gait"
"""Source of the published force."""
PREDICTED = "quadrature on the zero dynamics"
"""Source of the predicted force."""
BESIDE = 0.05
"""How far below and above the predicted force the walks are, relative to it."""


def published_force_rows() -> tuple[Row, ...]:
    """The force that stops the gait [N], beside the published 3 N, in every preset; of another gait, so no
    target.
    """
    forces = {p: HipCase("NPD", stride=False, preset=p).predicted() for p in PRESETS}
    said = "rearward force that stops it, by quadrature [N]"
    return tuple(Row(f"RABBIT {p}, v0.5", said, 3.0, F, None, ANOTHER) for p, F in forces.items())


def hip_rows(tracking: str, steps: int = 25) -> tuple[Row, ...]:
    """The predicted force against walks 5 % below and above it.

    Below all steps are made, above they are not; with the PI from step to step the walk keeps its speed above
    too.
    """
    case = HipCase(tracking, stride=False, steps=steps)
    force, name = case.predicted(), f"RABBIT identified-bare, v0.5, {tracking}"
    below, above = (1.0 - BESIDE) * force, (1.0 + BESIDE) * force
    walked, stopped = PushedWalk.of(case, below), PushedWalk.of(case, above)
    held = PushedWalk.of(HipCase(tracking, stride=True, steps=steps), above)
    made, on = f"steps of {steps} at {below:.2f} N", f"walks on at {above:.2f} N (1 or 0)"
    speed, kept = f"speed at {above:.2f} N, mean of the last five steps [m/s]", held.speed() or 0.0
    after, asked = f"it stops after {len(stopped.speeds)}", "the speed the PI is asked for"
    return (
        Row(name, made, steps, len(walked.speeds), 0.0, PREDICTED),
        nothing(name, on, stopped.walks, 0.0, PREDICTED, after),
        Row(f"{name} with PI", speed, 0.5, kept, 1e-3, asked),
    )


SPEEDS = tuple(round(0.4 + 0.1 * k, 1) for k in range(8))
"""For which gaits are designed [m/s]."""
SECONDS = 10.0
"""Limit of the processor time of a design [s]."""
ASKED, CERTIFICATE = "as asked", "certificate of the walk"
"""Sources of the rows of designed gaits."""
OWN = "this package's own limit"


def design_rows(preset: str, speed: float) -> tuple[Row, ...]:
    """The gait of least torque at this speed [m/s], as any user gets it: speed, certificate,
    periodicity, time.
    """
    begin = process_time()
    found = design_gait("rabbit", speed, preset=preset)
    spent, name = process_time() - begin, f"RABBIT {preset}, {speed:g} m/s"
    reached = Row(name, "speed [m/s]", speed, found.speed, 1e-6, ASKED)
    return (reached, *_common(name, found, spent))


def through_rows(preset: str) -> tuple[Row, ...]:
    """The gait through x* of the paper, beside the stored one, which another optimiser found.

    x* determines its impulse, so that the impulse has no limit here.
    """
    biped = Biped.load("rabbit", preset)
    q, v = onto_section(biped, X_STAR[: biped.n]), np.array(X_STAR[biped.n :])
    begin, limits = process_time(), StepLimits(impulse_friction=float("inf"))
    found = design_gait(biped, through=(q, v), limits=limits)
    spent, name = process_time() - begin, f"RABBIT {preset}, through x*"
    gap = float(np.max(np.abs(found.gait.v_minus - v)))
    rates = "rates of the orbit: gap to x* [rad/s]"
    least = torque_squared(biped, load_gait("published", biped))
    flat = "the minimum is flat"
    other = "stored gait, found by another optimiser"
    return (
        nothing(name, rates, gap, 1e-6, ASKED),
        Row(name, "int u'u dt / step [N^2 m s]", least, found.objective, 1e-3, other, note=flat),
        *_common(name, found, spent),
    )


def torque_squared(biped: Biped, gait: Gait) -> float:
    """int u'u dt / step length [N^2 m s] on the zero dynamics."""
    zero = ZeroDynamics.of(biped, gait.constraint)
    orbit = zero.orbit(zero.sigma_minus * zero.delta)
    length = float(np.hypot(*biped.swing_foot(gait.q_minus)))
    return float(orbit.time_weights @ np.sum(orbit.u**2, axis=1)) / length


def _common(name: str, found: DesignedGait, spent: float) -> tuple[Row, ...]:
    """What every designed gait has to show: its certificate, periodicity of the walk, processor time [s]."""
    broken = float(len(found.certificate.violations(but=("impulse",))))
    return (
        at_most(
            name, "broken limits of its certificate, the impulse aside", 0.0, broken, CERTIFICATE
        ),
        at_most(name, "left after two steps [rad, rad/s]", 1e-6, found.gap, "periodicity"),
        at_most(name, "processor time from a cold start [s]", SECONDS, spent, OWN),
    )
