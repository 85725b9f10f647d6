"""How well the specification of a candidate agrees with its walks: stability, delay margin, ripple.

Run: python benchmarks/specification.py [--candidates 200] [--seed 1]

1. Random candidates: controller, gains, order, bandwidth, period, rates' filter, delay (hidden or known),
   lag of the motors, and for one in three a robot whose masses and inertias are drawn from +-15 %. "Stable" by
   `ba.specification` against the largest multiplier of the sampled return map. A candidate that does
   not come back to the section counts as unstable there.
2. Delay margins: walks whose hidden delay is 0.9 and 1.1 of the margin.
3. Ripple: rms over one step of the torque with counts less the torque without.

The walks have no torque limit and, in 1 and 2, no counts: neither has a linear loop.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

import biped_adrc as ba
from biped_adrc.analysis.return_map import ReturnMap
from biped_adrc.errors import BipedError
from biped_adrc.observer_design.specification import Specification
from biped_adrc.scenario.build import RobotAndGait, build

SETTLING = 4
"""Steps before Newton's method looks for the cycle, after the first one."""
DELAYED: tuple[dict[str, object], ...] = (
    {"controller": "NPD", "filter_time": 2e-3, "velocity": "differences"},
    {"controller": "LESO", "bandwidth": 300.0},
    {"controller": "LESO", "bandwidth": 160.0, "order": 2},
    {"controller": "DOB", "bandwidth": 100.0, "velocity": "differences", "filter_time": 2e-3},
    {"controller": "ADRC output", "bandwidth": 200.0, "order": 1, "lag": 2e-3},
)
"""Candidates of the second table; the period is 1 ms."""
RIPPLED: tuple[dict[str, object], ...] = (
    {"controller": "NPD"},
    {"controller": "NPD", "filter_time": 5e-3},
    {"controller": "LESO"},
    {"controller": "LESO", "bandwidth": 160.0, "order": 2, "filter_time": 5e-3},
    {"controller": "LESO", "bandwidth": 160.0, "order": 2, "velocity": "measured"},
    {"controller": "DOB", "bandwidth": 92.0, "filter_time": 5e-3},
    {"controller": "NPID", "filter_time": 5e-3},
    {"controller": "ADRC output", "bandwidth": 160.0, "order": 1},
)
"""Candidates of the third table, on RABBIT's hardware: 1.5 ms, 8192 counts, rates from differences."""


def drawn(random: np.random.Generator) -> dict[str, object]:
    """The values of one random candidate."""

    def between(low: float, high: float) -> float:
        return float(np.exp(random.uniform(np.log(low), np.log(high))))

    name = str(random.choice(["NPD", "NPID", "LESO", "ADRC output", "DOB"]))
    K_p = between(1e3, 12e3)
    K_d = float(2.0 * random.uniform(0.3, 1.2) * np.sqrt(K_p))
    values: dict[str, object] = {"controller": name, "K_p": K_p, "K_d": K_d}
    if name == "NPID":
        values["own"] = {"K_i": float(random.uniform(0.05, 0.4)) * K_p * K_d}
    if name in ("LESO", "ADRC output"):
        values |= {"order": int(random.integers(1, 4)), "bandwidth": between(60.0, 800.0)}
    if name == "DOB":
        values["bandwidth"] = between(20.0, 400.0)
    values["period"] = float(random.choice([5e-4, 1e-3, 1.5e-3]))
    if random.integers(2):
        filter_time = float(random.choice([0.0, 2e-3, 5e-3]))
        values |= {"velocity": "differences", "filter_time": filter_time}
    if random.integers(3):
        delay = float(random.uniform(0.0, 8e-3))
        values |= {"delay": delay, "delay_known": bool(random.integers(2))}
    if not random.integers(3):
        values["lag"] = 2e-3
    if not random.integers(3):
        errors = {"mass_error": 0.15, "inertia_error": 0.15}
        values |= {**errors, "seed": int(random.integers(1000))}
    return values


def candidate(values: dict[str, object]) -> tuple[ba.Walker, ba.Gait]:
    """The walker of these values, with its gait."""
    s = ba.Scenario(**values)  # type: ignore[arg-type]
    scene = RobotAndGait.of(s)
    return build(s, scene), scene.walked


def specified(walker: ba.Walker, gait: ba.Gait) -> Specification:
    """Of this robot alone, since the walks are of one robot."""
    frozen = ba.FrozenGait.of(walker.plant, gait, walker.nominal, spread=0.0)
    return ba.specification(walker, frozen)


def multiplier(walker: ba.Walker, gait: ba.Gait) -> float:
    """The largest |multiplier| of the walk, infinite for a walker that does not come back to the section."""
    step = 2.5e-4 if walker.motors is not None and walker.motors.lag else 5e-4
    P = ReturnMap(walker, ba.RK4(step))
    try:
        x = walker.initial_state(*gait.start(walker.plant))
        run = ba.simulate(walker, x, ba.Mode(), P.method, t_end=2.0, stop_after=("foot_strike", 1))
        if not run.status.ok:
            return np.inf
        s = P.project(run.events("foot_strike")[-1].x_minus)
        for _ in range(SETTLING):
            s = P(s)
        return float(abs(P.fixed_point(P.lift(s), tolerance=1e-7).multipliers[0]))
    except BipedError:
        return np.inf


def torques(walker: ba.Walker, gait: ba.Gait, end: float) -> np.ndarray:
    """The torque held after each sample instant from 50 ms to `end` [s] of the first step (K, p) [N m]."""
    assert isinstance(walker.timing, ba.SampledTime)
    x, T = walker.initial_state(*gait.start(walker.plant)), walker.timing.period
    arc = ba.simulate(walker, x, ba.Mode(), ba.RK4(0.5 * T), t_end=end).arcs[0]
    middle = np.arange(round(0.05 / T), int(end / T) - 1) * T + 0.5 * T
    return np.asarray(arc.x[np.searchsorted(arc.t, middle - 1e-9), -walker.plant.p :])


def rippled(values: dict[str, object]) -> tuple[float, float]:
    """Ripple [N m] of the motor with most, by the specification and in a walk."""
    walker, gait = candidate(
        {"hardware": "rabbit", "friction": False, "torque_limit": 1e6, "impacts": 2, **values}
    )
    assert walker.sensors is not None
    spec = specified(walker, gait)
    exact = replace(walker, sensors=walker.sensors.smooth())
    end = 0.9 * spec.period
    difference = torques(walker, gait, end) - torques(exact, gait, end)
    return spec.ripple, float(np.max(np.std(difference, axis=0)))


def agreement(count: int, seed: int) -> Iterator[tuple[dict[str, object], float, float]]:
    """Values, growth [1/s] and largest |multiplier| of random candidates."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        values = drawn(random)
        walker, gait = candidate({"impacts": 2, **values})
        yield values, specified(walker, gait).worst.growth, multiplier(walker, gait)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--candidates", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    table = np.zeros((2, 2), dtype=int)
    for values, growth, largest in agreement(given.candidates, given.seed):
        table[int(growth < 0.0), int(largest < 1.0)] += 1
        if (growth < 0.0) != (largest < 1.0):
            print(
                f"differs: growth {growth:.2f} /s, multiplier {largest:.3g}, {values}", flush=True
            )
    (both_unstable, walks_only), (spec_only, both_stable) = table
    print(
        f"{given.candidates} candidates: {both_stable} stable by both, {both_unstable} unstable by both, "
        f"{spec_only} stable by the specification alone, {walks_only} by the return map alone; agreement "
        f"{100.0 * np.trace(table) / given.candidates:.1f} %"
    )
    for values in DELAYED:
        walker, gait = candidate({"impacts": 2, "period": 1e-3, **values})
        margin, time = specified(walker, gait).delay_margin, walker.timing
        assert isinstance(time, ba.SampledTime)
        late = (replace(time, delay=time.delay + r * margin) for r in (0.9, 1.1))
        found = [multiplier(replace(walker, timing=one), gait) for one in late]
        print(f"{values}: margin {1e3 * margin:.3f} ms, multipliers {found[0]:.3g}, {found[1]:.3g}")
    for values in RIPPLED:
        by_spec, by_walk = rippled(values)
        print(f"{values}: ripple {by_spec:.1f} N m, in a walk {by_walk:.1f} N m")


if __name__ == "__main__":
    main()
