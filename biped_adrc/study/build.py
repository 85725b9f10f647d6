"""From a scenario to a walker that is ready to run, and what the numbers of a study depend on besides values.

Robots and gaits are loaded once per process. A study may name files (a robot's TOML and URDF, a gait) and
classes of the user: their contents are hashed into the versions of its results.
"""

from __future__ import annotations

import hashlib
import os
import tomllib
from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path

from biped_adrc.closed_loop.walker import Mode
from biped_adrc.engine.batch import Case
from biped_adrc.engine.run import COMPILED
from biped_adrc.errors import InputError
from biped_adrc.scenario.build import RIGID, RobotAndGait, build, soft_loop, start
from biped_adrc.scenario.registry import find, is_own, source_hash
from biped_adrc.scenario.run import method_of
from biped_adrc.scenario.scenario import GaitRecord, RobotRecord, Scenario
from biped_adrc.study.parameters import PLANT, SUFFIXES, field_of


def versions_of(values: Iterable[tuple[str, object]]) -> dict[str, str]:
    """Hashes of the files and classes that these values name, and versions of their plants.

    Raises InputError for a class that cannot be imported or a plant that there is not.
    """
    found: dict[str, str] = {}
    for name, x in values:
        for path in files_of(name, x):
            text = path.read_bytes() if os.path.isfile(path) else b""
            found[f"file {path}"] = hashlib.sha256(text).hexdigest()[:12]
        kind = field_of(name).kind
        if kind and is_own(str(x)):
            found[f"source {x}"] = source_hash(find(kind, str(x)).load())
        if name == PLANT:
            version = getattr(find(kind, str(x)).load(), "engine_version", None)
            found |= {} if version is None else {f"engine of {x}": str(version())}
    return dict(sorted(found.items()))


def files_of(name: str, value: object) -> tuple[Path, ...]:
    """The files that a value names: of a robot its TOML and its URDF; empty for a registered name."""
    if not isinstance(value, str) or Path(value).suffix != SUFFIXES.get(name):
        return ()
    path = Path(value)
    if name != "robot.name" or not os.path.isfile(path):
        return (path,)
    try:
        return path, path.parent / tomllib.loads(path.read_text(encoding="utf-8"))["urdf"]
    except (OSError, ValueError, KeyError, TypeError):
        return (path,)  # who loads it says what is wrong


Stamp = tuple[tuple[str, int, int], ...]
"""Of each file: path, time of the last change [ns] and size [bytes]; another stamp means to load it again."""


def scene_of(s: Scenario) -> RobotAndGait:
    """The robot and gait of a scenario, loaded once per process and again when one of their files has changed.

    Raises InputError where there is none.
    """
    paths = (*files_of("robot.name", s.robot.name), *files_of("gait.name", s.gait.name))
    there = [(str(path), path.stat()) for path in paths if os.path.isfile(path)]
    stamp = tuple((path, found.st_mtime_ns, found.st_size) for path, found in there)
    return _scene(s.robot, s.gait, s.hardware.friction, stamp)


@lru_cache(maxsize=16)
def _scene(robot: RobotRecord, gait: GaitRecord, friction: bool, stamp: Stamp) -> RobotAndGait:
    """The cached part of `scene_of`: the values that robot and gait depend on, and the stamp of their files."""
    return RobotAndGait.of(Scenario(robot=robot, gait=gait, hardware={"friction": friction}))


def case(s: Scenario) -> Case:
    """The walk of a scenario with its start and method, recorded on the rigid plant.

    Raises InputError for values that do not fit together, or that a study cannot use: continuous time, fine
    steps besides, another engine.
    """
    if s.hardware.period is None or s.run.fine is not None:
        what = "has no period" if s.run.fine is None else f"has run.fine = {s.run.fine:g} s"
        raise InputError(
            f"the scenario {what}; a study walks in sampled time, with one step: expected a period [s], "
            "such as 1 ms, and no fine step"
        )
    if s.run.engine != COMPILED:
        raise InputError(
            f"a study walks on the engine '{COMPILED}'; leave out run.engine = '{s.run.engine}'"
        )
    scene = scene_of(s)
    q, v = start(s, scene)
    walker = build(s, scene)
    if s.ground.plant != RIGID:
        soft_loop(s, walker)
    mode = Mode(s.run.first_step)
    curve = scene.walked.constraint if s.ground.plant == RIGID else None
    return Case(walker, q, v, method_of(s, walker), s.run.impacts, mode, curve)
