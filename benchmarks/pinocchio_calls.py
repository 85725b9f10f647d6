"""Pinocchio's own calls against the number of joints: what one evaluation costs from Python.

Run: python benchmarks/pinocchio_calls.py [OUT] [--quick]

RABBIT pinned and floating, then robots of example-robot-data (the extra `robots`). Microseconds of CPU time
per call at a random configuration, medians of batches; a free base counts as one joint with six velocities.
"""

from __future__ import annotations

import sysconfig
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
from report import Table, arguments, microseconds

import biped_adrc as ba

ROBOTS = {
    "double pendulum": ("double_pendulum_description/urdf/double_pendulum.urdf", False),
    "UR5": ("ur_description/urdf/ur5_robot.urdf", False),
    "Panda": ("panda_description/urdf/panda.urdf", False),
    "ANYmal B": ("anymal_b_simple_description/robots/anymal.urdf", True),
    "TALOS reduced": ("talos_data/robots/talos_reduced.urdf", True),
    "TALOS": ("talos_data/robots/talos_full_v2.urdf", True),
}
"""URDF below the data's folder, and whether its base is free."""


def models() -> Iterator[tuple[str, Any]]:
    """Names and models; None for a robot that is not installed."""
    biped = ba.Biped.load("rabbit")
    yield "RABBIT, pinned", biped.pinned.model
    yield "RABBIT, planar base", biped.floating.model
    folder = data_folder()
    for name, (path, free) in ROBOTS.items():
        urdf = None if folder is None else folder / path
        if urdf is None or not urdf.is_file():
            yield name, None
        elif free:
            yield name, pin.buildModelFromUrdf(str(urdf), pin.JointModelFreeFlyer())
        else:
            yield name, pin.buildModelFromUrdf(str(urdf))


def data_folder() -> Path | None:
    """Where example-robot-data lies: below the prefix that its wheel shares with Pinocchio's."""
    here = (Path(sysconfig.get_path(key)) for key in ("platlib", "purelib"))
    places = [path / "cmeel.prefix" for path in here] + list(Path(pin.__file__).parents)
    found = (place / "share" / "example-robot-data" / "robots" for place in places)
    return next((folder for folder in found if folder.is_dir()), None)


def calls(model: Any) -> dict[str, Callable[[], object]]:
    """The calls at one random configuration."""
    pin.seed(1)
    data, random = model.createData(), np.random.default_rng(1)
    v, a, tau = random.normal(size=(3, model.nv))
    bound = np.full(model.nq, np.pi)
    q = pin.randomConfiguration(model, -bound, bound)
    frame = model.nframes - 1
    return {
        "aba": partial(pin.aba, model, data, q, v, tau),
        "crba": partial(pin.crba, model, data, q),
        "rnea": partial(pin.rnea, model, data, q, v, a),
        "nle": partial(pin.nonLinearEffects, model, data, q, v),
        "frame_Jacobian": partial(
            pin.computeFrameJacobian, model, data, q, frame, pin.LOCAL_WORLD_ALIGNED
        ),
    }


def main() -> None:
    """Print the table, and write it when asked."""
    asked = arguments(__doc__).parse_args()
    table = Table("Pinocchio calls", "us", packages=("example-robot-data",))
    for name, model in models():
        if model is None:
            table.add(name, note="not found: pip install 'biped-adrc[robots]'")
            continue
        sizes = {"joints": model.njoints - 1, "velocities": model.nv}
        repeats = 3 if asked.quick else 15
        times = {call: microseconds(f, 1000, repeats) for call, f in calls(model).items()}
        table.add(name, **sizes, **times)
    table.finish(asked.out)


if __name__ == "__main__":
    main()
