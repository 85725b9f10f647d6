"""The walks of a study: its values made into scenarios at ticks, whose torques and forces are metered."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from biped_adrc.engine.batch import Case
from biped_adrc.engine.choice import COMPILED
from biped_adrc.errors import InputError
from biped_adrc.scenario.build import Scene, build, start
from biped_adrc.scenario.run import method_of
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.studies.bench.named_files import files_of
from biped_adrc.walker import Mode

Stamp = tuple[tuple[str, int, int], ...]
"""Of files: path, time of the last change [ns] and size."""


def scene_of(s: Scenario) -> Scene:
    """Loaded once in a process, and again when a file has changed. Raises InputError where there is none."""
    paths = (*files_of("robot", s.robot), *files_of("gait", s.gait))
    return _scene(s.robot, s.preset, s.gait, s.friction, s.continued, _stamp(paths))


@lru_cache(maxsize=16)
def _scene(
    robot: str, preset: str | None, gait: str, friction: bool, continued: bool, stamp: Stamp
) -> Scene:
    return Scene.of(
        Scenario(robot=robot, preset=preset, gait=gait, friction=friction, continued=continued)
    )


def _stamp(paths: tuple[Path, ...]) -> Stamp:
    there = [(path, path.stat()) for path in paths if path.is_file()]
    return tuple((str(path), found.st_mtime_ns, found.st_size) for path, found in there)


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
