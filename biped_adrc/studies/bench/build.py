"""A trial made into a walk: robot and its errors, controller, hardware, push, ground and start.

Each thing that is drawn has a generator of its own, from the trial's seed and the thing's place in `DRAWN`, so
that one more of them changes none of the others.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from biped_adrc.disturbances.base import Disturbance, Windowed
from biped_adrc.disturbances.link import OnLink
from biped_adrc.disturbances.noise import TorqueNoise
from biped_adrc.disturbances.pulse import TorquePulse
from biped_adrc.disturbances.sine import TorqueSine
from biped_adrc.disturbances.step import TorqueStep
from biped_adrc.engine.batch import Case
from biped_adrc.errors import InputError
from biped_adrc.gait.gait import Gait, load_gait
from biped_adrc.ground import StepDown, StepUp, uneven_ground
from biped_adrc.hardware.meter import Meter
from biped_adrc.hardware.motors import Motors
from biped_adrc.hardware.sensors import Sensors
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.model.biped import Biped
from biped_adrc.model.errors import ModelErrors, impact_error
from biped_adrc.model.limits import ENDS, Limits
from biped_adrc.studies.bench.catalogue import controller
from biped_adrc.studies.bench.named_files import files_of
from biped_adrc.studies.bench.trial import Trial
from biped_adrc.timing import SampledTime
from biped_adrc.types import Array
from biped_adrc.walker import Walker

DRAWN = ("start", "onset", "joints", "noise", "sensors", "model", "impact", "ground")
"""What is drawn from a trial's seed."""


@dataclass(frozen=True)
class Scene:
    """The nominal robot and the gait of a trial."""

    biped: Biped
    gait: Gait


Stamp = tuple[tuple[str, int, int], ...]
"""Of files: path, time of the last change [ns] and size."""


@lru_cache(maxsize=16)
def scene(robot: str, preset: str | None, gait: str, friction: bool, stamp: Stamp = ()) -> Scene:
    """Loaded once in a process, and again when a file has changed."""
    biped = Biped.load(robot, preset, friction)
    return Scene(biped, load_gait(gait, biped))


def scene_of(trial: Trial) -> Scene:
    """The trial's scene. Raises InputError for a robot or gait that there is not."""
    paths = (*files_of("robot", trial.robot), *files_of("gait", trial.gait))
    return scene(trial.robot, trial.preset, trial.gait, trial.friction, _stamp(paths))


def _stamp(paths: tuple[Path, ...]) -> Stamp:
    there = [(path, path.stat()) for path in paths if path.is_file()]
    return tuple((str(path), found.st_mtime_ns, found.st_size) for path, found in there)


def drawn(trial: Trial, what: str) -> int:
    """A seed for one of the things in `DRAWN`."""
    sequence = np.random.SeedSequence(trial.seed, spawn_key=(DRAWN.index(what),))
    words = sequence.generate_state(1, np.uint64)
    return int(words[0] >> np.uint64(1))


def case(trial: Trial) -> Case:
    """The walk of a trial. Raises InputError for values that do not fit together."""
    s = scene_of(trial)
    q, v = start(trial, s)
    return Case(walker(trial, s), q, v, RK4(trial.h), trial.impacts)


def walker(trial: Trial, s: Scene) -> Walker:
    """The walker of a trial."""
    biped, plant = s.biped, plant_of(trial, s.biped)
    gain = () if trial.impact_error == 0.0 else _gain(trial, biped.n)
    return Walker(
        plant,
        controller(trial, s.gait.constraint, biped),
        push(trial, s, plant),
        SampledTime(trial.period, delay=trial.delay, delay_known=trial.delay_known),
        model=None if plant is biped else biped,
        torque_limit=trial.torque_limit,
        max_step_time=trial.max_step_time,
        slope=s.gait.slope + trial.slope,
        ground_steps=ground(trial),
        sensors=sensors(trial),
        motors=Motors(trial.rate_limit, trial.lag),
        meter=Meter(s.gait.constraint, limits(trial), ENDS * s.gait.period),
        impact_gain=gain,
    )


def limits(trial: Trial) -> Limits:
    """Within which the trial's walk is legal; torque is the robot's own."""
    return Limits(trial.friction_limit, None, trial.force_window)


def _gain(trial: Trial, n: int) -> tuple[float, ...]:
    return tuple(float(e) for e in impact_error(drawn(trial, "impact"), trial.impact_error, n))


def start(trial: Trial, s: Scene) -> tuple[Array, Array]:
    """(q, v) after the impact of the gait's orbit, with what the trial adds. Raises InputError."""
    q, v = s.gait.start(s.biped)
    random = np.random.default_rng(drawn(trial, "start"))
    q = q + trial.start_spread * random.standard_normal(len(q))
    v = v + trial.start_rate_spread * random.standard_normal(len(v))
    v = v * (1.0 + trial.start_speed + trial.start_speed_spread * random.standard_normal())
    for name, added in trial.start.items():
        place = int(name[1:]) - 1
        if not 0 <= place < len(q):
            raise InputError(
                f"start names '{name}', but robot '{trial.robot}' has the coordinates 1 to {len(q)}"
            )
        (q if name[0] == "q" else v)[place] += added
    return q, v


def plant_of(trial: Trial, biped: Biped) -> Biped:
    """The robot that walks: the nominal one itself where nothing is wrong with the model."""
    plant = biped
    if trial.trunk_load != 0.0:
        trunk = biped.description.trunk
        plant = ModelErrors(mass={trunk: trial.trunk_load}).apply(plant)
    widths = (trial.mass_error, trial.com_error, trial.inertia_error, trial.friction_error)
    if any(widths):
        plant = ModelErrors.drawn(plant, drawn(trial, "model"), *widths).apply(plant)
    return plant


def sensors(trial: Trial) -> Sensors | None:
    """The trial's sensors, None where all is exact."""
    exact = trial.counts is None and trial.velocity == "measured"
    if exact and trial.noise == trial.pitch_noise == trial.rate_noise == 0.0:
        return None
    return Sensors(
        trial.counts,
        None,
        trial.noise,
        trial.pitch_noise,
        trial.rate_noise,
        trial.velocity,
        trial.filter_time,
        drawn(trial, "sensors"),
    )


def ground(trial: Trial) -> tuple[StepDown | StepUp, ...]:
    """The trial's ground."""
    steps: tuple[StepDown | StepUp, ...] = ()
    if trial.ground_rms > 0.0:
        steps = uneven_ground(drawn(trial, "ground"), trial.ground_rms, trial.impacts)
    if trial.ground_step > 0.0:
        steps = (*steps, StepDown(trial.pushed_step, trial.ground_step))
    elif trial.ground_step < 0.0:
        steps = (*steps, StepUp(trial.pushed_step, -trial.ground_step))
    return steps


def push(trial: Trial, s: Scene, plant: Biped) -> Disturbance | None:
    """The trial's push on joints or on a link; None without."""
    if trial.push == "none":
        return None
    kind, _, link = trial.on.partition(" ")
    if kind == "link":
        if trial.amplitude > 0.0:
            raise InputError(
                f"the push on '{trial.on}' is a force [N], and the trial gives an amplitude"
            )
        along = (math.cos(trial.direction), math.sin(trial.direction), 0.0)
        return OnLink(plant, link, _wave(trial, s, trial.force * np.array(along)))
    if trial.force > 0.0:
        raise InputError(
            f"the push on '{trial.on}' is a torque [N m], and the trial gives a force; write on = 'link NAME'"
        )
    return _wave(trial, s, trial.amplitude * pattern(trial, s.biped))


def pattern(trial: Trial, biped: Biped) -> Array:
    """Factors (n,) of the amplitude on the joints."""
    factors = np.zeros(biped.n)
    if trial.on == "random joints":
        random = np.random.default_rng(drawn(trial, "joints"))
        factors[: biped.p] = random.uniform(-1.0, 1.0, biped.p)
        return factors
    for name in trial.on.split(","):
        joint = name.strip()
        sign = -1.0 if joint.startswith("-") else 1.0
        factors[biped.description.joint_index(joint.lstrip("+-"))] += sign
    if not factors.any():
        raise InputError(f"the torques of the push on '{trial.on}' cancel; leave one of them out")
    return factors


def _wave(trial: Trial, s: Scene, amplitude: Array) -> Windowed:
    """A pulse ends with its step at the latest; sines and noise go on over steps, from the time at which the
    gait would be there."""
    begin = trial.onset
    if begin is None:
        last = max(s.gait.period - trial.duration, 0.0)
        begin = float(np.random.default_rng(drawn(trial, "onset")).uniform(0.0, last))
    step, stop = trial.pushed_step, begin + trial.duration
    late = (step - 1) * s.gait.period
    if trial.push == "step":
        return TorqueStep(amplitude, step, begin)
    if trial.push == "sine":
        return TorqueSine(amplitude, None, late + begin, late + stop, trial.frequency)
    if trial.push == "noise":
        seed = drawn(trial, "noise")
        window = (amplitude, None, late + begin, late + stop)
        return TorqueNoise(*window, bandwidth=trial.frequency, seed=seed)
    return TorquePulse(amplitude, step, begin, stop)
