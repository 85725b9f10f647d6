"""Makes a scenario of values that a study gives, and its walker; says what else decides the walk's numbers.

    name                          value in SI
    hardware.period               0.0015    [s]
    controller.observer.order     1
    hardware.torque_limit         None      no limit
    start.v5                      0.1       [rad/s]

Values come by dotted name, read and converted already (`scenario.records`). Robots and gaits are loaded once
per process. A study may name files (a robot's TOML and URDF, a gait) and classes of the user: their contents
are hashed into the versions of its results. The registry finds a class by kind and name, such as "controller"
and "ADRC", or by module:Class. A scene is a robot and its gait; a row is the results of one walk.
"""

import hashlib
import inspect
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.closed_loop.stepping import SteppingLoop
from biped_adrc.closed_loop.walker import Mode
from biped_adrc.core.errors import InputError, ModelError
from biped_adrc.core.registry import find, is_own
from biped_adrc.disturbances.base import Disturbance, Windowed, summands
from biped_adrc.engine.batch import Case
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.numbers import numbers_of
from biped_adrc.engine.program import COMPILED
from biped_adrc.engine.structure import structure
from biped_adrc.model.robots.robot_toml import load_description
from biped_adrc.scenario.build import RobotAndGait, build, soft_loop
from biped_adrc.scenario.dotted import tables
from biped_adrc.scenario.integration import methods_of
from biped_adrc.scenario.scenario import GaitRecord, RobotRecord, Scenario

Values = Mapping[str, Any]
"""Values of a scenario by dotted name, in SI units, as JSON has them: what a worker receives of one walk."""

REFUSED, RAISED, CRASHED = "REFUSED", "RAISED", "CRASHED"
"""Statuses that are no result of a walk: values that do not fit, a function that raised, a worker that died."""
NO_WALK = (REFUSED, RAISED, CRASHED)
"""All of them; such rows count neither as a success nor as a fall."""
SEED, PLANT = "run.seed", "ground.plant"
"""Names of values that a study treats apart."""
_SUFFIXES = {"robot.name": ".toml", "gait.name": ".json"}
"""Values that may be a file's name in place of a registered name, and the file's suffix."""


def scenario_of(values: Values) -> Scenario:
    """The scenario of values by name; where they say nothing of sampling, it has the hardware profile "ideal",
    sampled at 1 kHz.

    Errors and torques of a row are taken at sample instants, so each walk needs a period. Raises InputError for
    values that do not fit together.
    """
    return Scenario(**tables({"hardware.profile": "ideal", **values}))


def versions_of(values: Iterable[tuple[str, object]]) -> dict[str, str]:
    """What decides numbers beside these values (name, value): hashes of the files and classes that they name,
    and versions of the engines of their plants, by "file ..", "source .." and "engine of ..".

    Raises InputError for a class that cannot be imported or a plant that there is not.
    """
    result: dict[str, str] = {}
    for name, x in values:
        for path in files_of(name, x):
            result[f"file {path}"] = _hash(path)
        # kind in the registry, for a value that is a name of it; is_own: whether it is module:Class
        kind = Scenario.field_of(name).kind
        if kind and is_own(str(x)):
            result[f"source {x}"] = _source(find(kind, str(x)).load())
        if name == PLANT:
            version = getattr(find(kind, str(x)).load(), "engine_version", None)
            result |= {} if version is None else {f"engine of {x}": str(version())}
    return dict(sorted(result.items()))


def _hash(path: Path) -> str:
    """Hash of a file's content (12 hexadecimal digits); that of an empty text where there is no such file."""
    return _digits(path.read_bytes() if path.is_file() else b"")


def _digits(data: bytes) -> str:
    """The first 12 hexadecimal digits of SHA-256."""
    return hashlib.sha256(data).hexdigest()[:12]


def _source(thing: Callable[..., object]) -> str:
    """Hash of the source text of a class or function; "none" where Python finds no text, as in a console."""
    with suppress(OSError, TypeError):
        return _digits(inspect.getsource(thing).encode())
    return "none"


def files_of(name: str, value: object) -> tuple[Path, ...]:
    """The files that the value called `name` of a scenario names: of a robot its TOML and its URDF; none for a
    registered name, and for values that are no files.
    """
    # _SUFFIXES: name of a value that may be a file -> the file's suffix
    if not isinstance(value, str) or Path(value).suffix != _SUFFIXES.get(name):
        return ()
    path = Path(value)
    # a TOML that cannot be read stands here without its URDF; the error is raised where the robot is loaded
    with suppress(ModelError):
        return (path, load_description(path).urdf) if name == "robot.name" else (path,)
    return (path,)


def scene_of(s: Scenario) -> RobotAndGait:
    """The robot and gait of a scenario, loaded once per process and again when one of their files has changed.

    Raises InputError where there is none.
    """
    paths = (*files_of("robot.name", s.robot.name), *files_of("gait.name", s.gait.name))
    return _scene(s.robot, s.gait, s.hardware.friction, tuple(map(_hash, paths)))


@lru_cache(maxsize=16)
def _scene(
    robot: RobotRecord, gait: GaitRecord, friction: bool, hashes: tuple[str, ...]
) -> RobotAndGait:
    """Load robot and gait for `scene_of`, once for all equal arguments. hashes: of their files; they are not
    read, but load a file again when it has changed.
    """
    return RobotAndGait.of(Scenario(robot=robot, gait=gait, hardware={"friction": friction}))


class Trial(NamedTuple):
    """A walk that is ready to be made: its scenario, robot and gait (`scene`), walker and start (`case`)."""

    scenario: Scenario
    scene: RobotAndGait
    case: Case
    loop: SteppingLoop | None
    """The walker's controller around another plant than the rigid one; else None."""


def acting(disturbance: Disturbance | None) -> tuple[Disturbance, ...]:
    """The parts of a disturbance that act: those without a wave whose amplitude is zero, which changes nothing,
    though a seed may shift the times of its window. Empty for None.

    A wave, of the class `Windowed`, is an amplitude times a shape in time.
    """
    parts = () if disturbance is None else summands(disturbance)
    # a force on a link has its shape in time in `wave`; other pushes are waves themselves
    waves = ((x, getattr(x, "wave", x)) for x in parts)
    return tuple(x for x, w in waves if not isinstance(w, Windowed) or np.any(w.amplitude))


def differ(*trials: Trial) -> bool:
    """Whether the walks of these trials, equal in all values but the seed, may differ.

    All that a seed can change is compared to the last bit. True also where a user's part cannot be compared.
    """
    # both errors are of a part whose content cannot be read: then the last line says that they may differ
    with suppress(NotCompiled, ModelError):
        known = set()
        for c in (t.case for t in trials):
            w = c.walker
            # numbers_of has the numbers of robot, controller and hardware; True: floats count by value
            rest = acting(w.disturbance), w.ground_steps, w.stones, c.q, c.v
            known.add(structure((numbers_of(w), *rest), True))
        return len(known) > 1
    return True


def trial_of(s: Scenario) -> Trial:
    """Build the walk of a scenario, with its start and integration method.

    Raises InputError for values that do not fit together, or that a study cannot use: continuous time, a second
    integration step (`run.fine`), another engine.
    """
    # text -> whether it is so
    wrong = {
        "hardware.period is none, expected a time [s] such as 1 ms": s.hardware.period is None,
        "run.fine is a step besides, expected none": s.run.fine is not None,
        f"run.engine is '{s.run.engine}', expected '{COMPILED}'": s.run.engine != COMPILED,
    }
    if found := "; ".join(text for text, is_so in wrong.items() if is_so):
        raise InputError(f"a study walks in sampled time, with one step, compiled: {found}")
    scene = scene_of(s)
    q, v = scene.start(s)
    walker, mode = build(s, scene), Mode(s.run.first_step)
    # methods_of gives the method and, at [1], a finer step where a push switches: None in sampled time
    curve = scene.walked.constraint
    case = Case(walker, q, v, methods_of(s.run, walker)[0], s.run.impacts, mode, curve)
    return Trial(s, scene, case, soft_loop(s, walker))
