"""From a trial's scenario to a walker that is ready to run, and what a study's numbers depend on besides
values.

Walks of a study are sampled and run on the compiled engine. Robots and gaits are loaded once per process and
shared by its trials. A study may name files (a robot's TOML and URDF, a gait) and classes of the user: their
contents are hashed into the versions of the results, so that results of two different robots never end in one
file.

Called by `bench.run` (walks), `bench.study.rehearse` (checks) and `bench.sweep` (hashes).
"""

from __future__ import annotations

import hashlib
import os
import tomllib
from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path

from biped_adrc.bench.study import Study
from biped_adrc.closed_loop.walker import Mode
from biped_adrc.engine.batch import Case
from biped_adrc.engine.run import COMPILED
from biped_adrc.errors import InputError
from biped_adrc.scenario.build import RIGID, RobotAndGait, build, soft_loop, start
from biped_adrc.scenario.registry import find, is_own, source_hash
from biped_adrc.scenario.run import method_of
from biped_adrc.scenario.scenario import GaitRecord, RobotRecord, Scenario

SUFFIXES = {"robot.name": ".toml", "gait.name": ".json"}
"""By parameter the suffix by which a path is told from a registered name."""

OWN = {f"{name}.name": name for name in ("controller", "robot", "gait")}
"""Parameters that may name a class of the user as module:Class, and the registry's kind of it."""
OWN |= {"controller.observer.name": "observer", "controller.inner.name": "controller"}
OWN |= {"pushes.0.shape": "disturbance", "ground.plant": "plant"}
"""Parameters that may name a class of the user's own, and its kind."""


def files_of_study(study: Study) -> tuple[Path, ...]:
    """The files that any of its points names, sorted."""
    return tuple(sorted({path for pair in study.given() for path in files_of(*pair)}))


def own_of_study(study: Study) -> dict[str, str]:
    """Hashes of the source of the user's classes that any point names, by "source name". Raises InputError."""
    named = {(OWN[name], str(x)) for name, x in study.given() if name in OWN and is_own(str(x))}
    return {f"source {x}": source_hash(find(kind, x).load()) for kind, x in sorted(named)}


def plants_of_study(study: Study) -> dict[str, str]:
    """Versions of the engines of the plants that any point names, by "engine of PLANT". Raises InputError."""
    return engines_of({str(x) for name, x in study.given() if name == "ground.plant"})


def engines_of(plants: Iterable[str]) -> dict[str, str]:
    """Versions of the engines of these plants, by "engine of PLANT". Raises InputError."""
    made = {name: find("plant", name).load() for name in sorted(plants)}
    told = {f"engine of {x}": getattr(plant, "engine_version", None) for x, plant in made.items()}
    return {what: str(version()) for what, version in told.items() if version is not None}


def files_of(name: str, value: object) -> tuple[Path, ...]:
    """The files that a parameter's value names: of a robot its TOML and its URDF; empty for a
    registered name.
    """
    if not isinstance(value, str) or Path(value).suffix != SUFFIXES.get(name):
        return ()
    path = Path(value)
    if name != "robot.name" or not os.path.isfile(path):
        return (path,)
    try:
        return path, path.parent / tomllib.loads(path.read_text(encoding="utf-8"))["urdf"]
    except (OSError, ValueError, KeyError, TypeError):
        return (path,)  # who loads it says what is wrong


def hashes(paths: Iterable[Path]) -> dict[str, str]:
    """Twelve digits of the SHA-256 of each file, by "file path"; "none" for a file that is not there."""
    there = {path: path.read_bytes() if os.path.isfile(path) else None for path in paths}
    return {
        f"file {path}": "none" if text is None else hashlib.sha256(text).hexdigest()[:12]
        for path, text in there.items()
    }


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
    return Case(walker, q, v, method_of(s, walker), s.run.impacts, mode, s.ground.plant == RIGID)
