"""The files of robots and gaits that trials name by their paths: what is in them belongs to the numbers."""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from biped_adrc.scenario.registry import find, is_own, source_hash
from biped_adrc.studies.bench.study import Study

SUFFIXES = {"robot": ".toml", "gait": ".json"}
"""By parameter: how a path is told from a name."""

OWN = {
    "controller": "controller",
    "own.inner": "controller",
    "observer": "observer",
    "push": "disturbance",
    "robot": "robot",
    "gait": "gait",
}
"""Parameters that may name a class of the user's own, and its kind."""


def files_of_study(study: Study) -> tuple[Path, ...]:
    """Those that any of its points names, in a fixed order."""
    values: list[tuple[str, Any]] = [*study.fixed.items()]
    values += [pair for case in study.cases for pair in case.values.items()]
    values += [(name, x) for name in SUFFIXES for x in study.grid.get(name, ())]
    return tuple(sorted({path for pair in values for path in files_of(*pair)}))


def own_of_study(study: Study) -> dict[str, str]:
    """What the user's own classes are by their source, those that a point names. Raises InputError."""
    values = [*study.fixed.items(), *(x for case in study.cases for x in case.values.items())]
    values += [(name, x) for name, levels in study.grid.items() for x in levels]
    named = {(OWN[name], x) for name, x in values if name in OWN and is_own(str(x))}
    return {
        f"source {x}": source_hash(find(kind, str(x)).load()) for kind, x in sorted(named, key=str)
    }


def files_of(name: str, value: Any) -> tuple[Path, ...]:
    """The file that a parameter names, and a robot's URDF; none for other values."""
    if not isinstance(value, str) or Path(value).suffix != SUFFIXES.get(name):
        return ()
    path = Path(value)
    return (path, *_urdf(path)) if name == "robot" else (path,)


def _urdf(path: Path) -> tuple[Path, ...]:
    try:
        return (path.parent / tomllib.loads(path.read_text(encoding="utf-8"))["urdf"],)
    except (OSError, ValueError, KeyError, TypeError):
        return ()  # who loads it says what is wrong


def hashes(paths: Iterable[Path]) -> dict[str, str]:
    """What is in the files, to be put beside the versions of what the numbers depend on."""
    return {f"file {path}": _hash(path) for path in paths}


def _hash(path: Path) -> str:
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()[:12]
    except OSError:
        return "none"
