"""The walks of a study: its values made into scenarios at ticks, whose torques and forces are metered.

What is in the files and in the classes of the user's own that trials name belongs to the numbers.
"""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path
from typing import Any

from biped_adrc.bench.study import Study
from biped_adrc.closed_loop.walker import Mode
from biped_adrc.engine.batch import Case
from biped_adrc.engine.run import COMPILED
from biped_adrc.errors import InputError
from biped_adrc.scenario.build import RobotAndGait, build, start
from biped_adrc.scenario.registry import find, is_own, source_hash
from biped_adrc.scenario.run import method_of
from biped_adrc.scenario.scenario import Scenario

SUFFIXES = {"robot": ".toml", "gait": ".json"}
"""By parameter: how a path is told from a name."""

OWN = {name: name for name in ("controller", "observer", "robot", "gait")}
OWN |= {"own.inner": "controller", "push": "disturbance"}
"""Parameters that may name a class of the user's own, and its kind."""


def files_of_study(study: Study) -> tuple[Path, ...]:
    """Those that any of its points names, in a fixed order."""
    return tuple(sorted({path for pair in study.given() for path in files_of(*pair)}))


def own_of_study(study: Study) -> dict[str, str]:
    """What the user's own classes are by their source, those that a point names. Raises InputError."""
    named = {(OWN[name], str(x)) for name, x in study.given() if name in OWN and is_own(str(x))}
    return {f"source {x}": source_hash(find(kind, x).load()) for kind, x in sorted(named)}


def files_of(name: str, value: Any) -> tuple[Path, ...]:
    """The file that a parameter names, and a robot's URDF; none for other values."""
    if not isinstance(value, str) or Path(value).suffix != SUFFIXES.get(name):
        return ()
    path = Path(value)
    if name != "robot":
        return (path,)
    try:
        return path, path.parent / tomllib.loads(path.read_text(encoding="utf-8"))["urdf"]
    except (OSError, ValueError, KeyError, TypeError):
        return (path,)  # who loads it says what is wrong


def hashes(paths: Iterable[Path]) -> dict[str, str]:
    """What is in the files, to be put beside the versions of what the numbers depend on."""
    there = {path: path.read_bytes() if path.is_file() else None for path in paths}
    return {
        f"file {path}": "none" if text is None else hashlib.sha256(text).hexdigest()[:12]
        for path, text in there.items()
    }


Stamp = tuple[tuple[str, int, int], ...]
"""Of files: path, time of the last change [ns] and size."""
OF_SCENE = ("robot", "preset", "gait", "friction", "continued")
"""Values of a scenario that a scene is made of."""


def scene_of(s: Scenario) -> RobotAndGait:
    """Loaded once in a process, and again when a file has changed. Raises InputError where there is none."""
    paths = (*files_of("robot", s.robot), *files_of("gait", s.gait))
    there = [(str(path), path.stat()) for path in paths if path.is_file()]
    stamp = tuple((path, found.st_mtime_ns, found.st_size) for path, found in there)
    return _scene(tuple((name, getattr(s, name)) for name in OF_SCENE), stamp)


@lru_cache(maxsize=16)
def _scene(values: tuple[tuple[str, Any], ...], stamp: Stamp) -> RobotAndGait:
    return RobotAndGait.of(Scenario(**dict(values)))


def case(s: Scenario) -> Case:
    """The walk of a scenario. Raises InputError for values that do not fit together, or not in a study."""
    if s.period is None or s.fine is not None:
        what = "has no period" if s.period is None else f"has fine = {s.fine:g} s"
        raise InputError(
            f"the scenario {what}; a study counts what it reports at ticks, with one step: expected a period "
            "[s], such as 1 ms, and no fine step"
        )
    if s.engine != COMPILED:
        raise InputError(
            f"a study walks on the engine '{COMPILED}'; leave out engine = '{s.engine}'"
        )
    scene = scene_of(s)
    q, v = start(s, scene)
    walker = build(s, scene, metered=True)
    return Case(walker, q, v, method_of(s, walker), s.impacts, Mode(s.first_step))
