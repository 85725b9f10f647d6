"""Systems without motors: the hybrid loop alone, and walkers that gravity drives down a slope.

    bouncing ball     dropped from height h, restitution e: t_k = sqrt(2 h / g) (1 + 2 (e + ... + e^(k-1)))
    rimless wheel     after impact cot(2 alpha) sqrt(4 (g / l) sin alpha sin gamma), multiplier cos^2(2 alpha)
    simplest walker   theta, theta' after heel strike in units of sqrt(l / g), in the limit of massless feet
    compass gait      hip 10 kg, legs 5 kg at mid-leg, 1 m long, 3 degrees

Without a controller nothing can hide an error of dynamics, impact or event location, and each of these has a
closed form or digits that were published. McGeer, Int. J. Robotics Research 9(2), 1990; Garcia et al., J.
Biomech. Eng. 120(2), 1998; Goswami et al., Int. J. Robotics Research 17(12), 1998. Called by
`validation.groups`; the published digits are in published.toml.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from biped_adrc.analysis.stability import Cycle, known_cycle
from biped_adrc.analysis.variational import StepDerivative, periodic_orbit
from biped_adrc.closed_loop.walker import Mode
from biped_adrc.core.types import Array
from biped_adrc.hybrid.integrators import RK4, Adaptive, OneStepMethod
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.hybrid.system import Guard, HybridSystem
from biped_adrc.model.biped import Biped
from biped_adrc.model.model_errors import ModelErrors
from validation.row import Row, published

CLOSED = "closed form"
"""Source of the ball's rows."""
MCGEER = "McGeer 1990, closed form"
"""Source of the wheel's rows."""
SCRIPT = "M. Garcia, pointfoot simulation of 1998 that goes with the paper"
"""Source of a multiplier that the paper does not print."""
FEET = 1e-7  # of the hip's mass, of the robot "simplest"


# -- the hybrid loop alone -------------------------------------------------------------------------
class Ball(HybridSystem):
    """A bouncing ball, x = (height [m], velocity [m/s]); the mode counts bounces."""

    e, g = 0.8, 9.81

    def flow(self, t: float, x: Array, mode: int) -> Array:
        """x' = (v, -g)."""
        return np.array([x[1], -self.g])

    def guards(self, mode: int) -> tuple[Guard, ...]:
        """Impact at height 0, with restitution e."""

        def bounce(t: float, x: Array) -> tuple[Array, int]:
            return np.array([0.0, -self.e * x[1]]), mode + 1

        return (Guard("bounce", lambda t, x: float(x[0]), bounce),)


def ball_rows() -> tuple[Row, ...]:
    """Time of the sixth bounce [s] and speed before it [m/s], by a fixed-step and an adaptive method.

    Events are located in time, and their errors add up from bounce to bounce.
    """
    ball, count = Ball(), 6
    first = math.sqrt(2.0 / ball.g)
    time = first * (1.0 + 2.0 * sum(ball.e**j for j in range(1, count)))
    speed = ball.g * first * ball.e ** (count - 1)
    rows = []
    methods: tuple[OneStepMethod, ...] = (RK4(1e-3), Adaptive())
    for method in methods:
        run = simulate(
            ball, np.array([1.0, 0.0]), 0, method, t_end=10.0, stop_after=("bounce", count)
        )
        end, name = run.events("bounce")[-1], f"bouncing ball, {type(method).__name__}"
        rows += [
            Row(name, "time of bounce 6 [s]", time, end.t, 1e-9, CLOSED),
            Row(name, "speed before it [m/s]", speed, -float(end.x_minus[1]), 1e-8, CLOSED),
        ]
    return tuple(rows)


# -- walkers ---------------------------------------------------------------------------------------
def solved(cycle: Cycle) -> tuple[StepDerivative, Array, Array]:
    """The cycle's step by the variational equation, and (q+, q'+), (n,) each, after its impact."""
    orbit, step = periodic_orbit(cycle.P, cycle.guess, 1e-9)
    q, v = np.split(orbit.x_minus, 2)
    after = cycle.P.walker.plant.impact(q, v)
    return step, after.q, after.v


def wheel_rows() -> tuple[Row, ...]:
    """Rate after impact [rad/s] and multiplier on two slopes, by the closed forms above."""
    wheel, alpha, rows = Biped.load("rimless_wheel"), math.pi / 8, []
    for slope in (0.12, 0.2):
        step, _, v = solved(known_cycle(wheel, slope))
        square = 4.0 * wheel.description.gravity * math.sin(alpha) * math.sin(slope)
        rate = math.sqrt(square) / math.tan(2.0 * alpha)
        name = f"rimless wheel, slope {slope:g} rad"
        found = float(step.multipliers[0].real)
        rows += [
            Row(name, "rate after impact [rad/s]", rate, -float(v[0]), 1e-9, MCGEER),
            Row(name, "multiplier", math.cos(2.0 * alpha) ** 2, found, 1e-9, MCGEER),
        ]
    return tuple(rows)


@lru_cache
def simplest(ratio: float = FEET) -> Cycle:
    """The simplest walker with feet of `ratio` of the hip's mass, on its slope of 0.009 rad."""
    heavier = ModelErrors(mass={"leg": ratio / FEET - 1.0})
    return known_cycle(heavier.apply(Biped.load("simplest")))


def started_at(cycle: Cycle, theta: float, rate: float) -> Cycle:
    """The same walker, with the search started from (theta, theta') after heel strike, units of sqrt(l / g)."""
    walker = cycle.P.walker
    unit = math.sqrt(walker.plant.description.gravity)
    q = np.array([-2.0 * theta, math.pi - walker.ground_slope + theta])
    v = np.array([-(1.0 - math.cos(2.0 * theta)) * rate, rate]) * unit
    strike = cycle.P.next_impact(walker, walker.initial_state(q, v), Mode())
    return replace(cycle, guess=strike.x_minus)


def garcia_angles(cycle: Cycle, q: Array, v: Array) -> tuple[float, float]:
    """(theta [rad], theta' in units of sqrt(g / l)) of Garcia et al. after heel strike, from q, v (2,) after
    impact.
    """
    walker = cycle.P.walker
    unit = math.sqrt(walker.plant.description.gravity)
    return float(q[1]) - math.pi + walker.ground_slope, float(v[1]) / unit


def simplest_rows() -> tuple[Row, ...]:
    """The longer of the two steps: fixed point, period and multiplier.

    The published multiplier is that of massless feet; here it is extrapolated from two small masses.
    """
    cycle = simplest()
    step, q, v = solved(cycle)
    theta, rate = garcia_angles(cycle, q, v)
    period = step.duration * math.sqrt(cycle.P.walker.plant.description.gravity)
    heavy, heavier = (abs(solved(simplest(m))[0].multipliers[0]) for m in (1e-6, 1e-5))
    limit = heavy + (heavy - heavier) / 9.0
    script = abs(complex(-0.19120868949940, 0.55633363687106))
    doubt = (
        f"massless feet, extrapolated from 1e-5 and 1e-6 of the hip's mass; a comment in the {SCRIPT} "
        f"gives {script:.6f}, {abs(script / limit - 1.0):.1e} beside both"
    )
    return (
        *published("long_step", theta, rate),
        *published("long_step_recomputed", period),
        *published("long_step_multiplier", float(limit), note=doubt),
    )


def short_step_rows() -> tuple[Row, ...]:
    """The shorter, unstable step: fixed point and multipliers, one of them outside of the unit circle."""
    cycle = started_at(simplest(), 0.19393736960624, -0.20386692731962)
    step, q, v = solved(cycle)
    multipliers = (float(m.real) for m in step.multipliers[:2])
    angles = published("short_step", *garcia_angles(cycle, q, v))
    return (*angles, *published("short_step_multipliers", *multipliers))


def heavy_feet_rows() -> tuple[Row, ...]:
    """Feet of a thousandth of the hip's mass: their inertia changes the fixed point in the printed digits."""
    cycle = simplest(1e-3)
    _, q, v = solved(cycle)
    spread = -float(v[0]) / math.sqrt(cycle.P.walker.plant.description.gravity)
    angles = published("heavy_feet", *garcia_angles(cycle, q, v), -float(q[0]))
    return (*angles, *published("heavy_feet_spread", spread))


def compass_rows() -> tuple[Row, ...]:
    """State after impact, clockwise and absolute as published, and the three multipliers."""
    step, q, v = solved(known_cycle(Biped.load("compass")))
    pair = max(step.multipliers, key=lambda z: z.imag)
    real = min(step.multipliers, key=lambda z: abs(z.imag))
    state = (math.pi - q[1], -v[1], -(v[0] + v[1]))
    return published("compass", *state, pair.real, pair.imag, real.real)
