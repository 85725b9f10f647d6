"""What rounding does to the torque of a walk, and which controllers floats can hold.

    ripple = rms of u_k - u'_k over the sample instants k of two walks from the same start

One walk is by the exported controller in double, the other by the same in float, or by Python. The
prediction runs the double code with a random error within half an ulp of float, times 2^-10, at every
operation that is rounded to it (Parker, Monte Carlo arithmetic, 1997), and scales the ripple back, as
it is linear in the ulp there. For double what stays in double otherwise has such errors too.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from biped_adrc.closed_loop.protocols import Mode
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Walker
from biped_adrc.control.base import Controller
from biped_adrc.deploy.computer import Computer
from biped_adrc.deploy.loaded import FLAGS, ExportedController, Loaded
from biped_adrc.deploy.records import recorded
from biped_adrc.deploy.source import source_of
from biped_adrc.engine.simulate import run_compiled
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.hybrid.simulator import RunOptions
from biped_adrc.hybrid.trajectory import Trajectory
from biped_adrc.types import Array

SCALE = 2.0**-10
"""Of the random errors, in half ulps of float: far above those of double, and small beside all else."""
DOUBLE = 2.0**-29
"""An ulp of double, in ulps of float."""


class Ripple(NamedTuple):
    """Root mean square of the torque [N m] that rounding makes in a walk."""

    predicted_double: float
    double: float
    """Exported - Python."""
    predicted_single: float
    single: float
    """Exported in float - exported in double."""
    same_status: bool
    """Whether the walk in float ends as that in double."""
    torque: float
    """Root mean square of the torque itself."""


def ripple(
    walker: Walker,
    begin: tuple[Array, Array],
    impacts: int = 2,
    h: float = 5e-4,
    flags: tuple[str, ...] = FLAGS,
) -> Ripple:
    """The ripple of a walker from (q, v), each (n,), for some impacts.

    h: step of the method [s]. flags: of the compiler. Raises InputError for what cannot be exported.
    """
    computer = Computer(walker)
    source = source_of(computer)

    def walked(controller: Controller) -> Trajectory:
        w = replace(walker, controller=controller)
        options = RunOptions(
            impacts * walker.max_step_time, stop_after=(FOOT_STRIKE, impacts), store_every=1
        )
        return run_compiled(w, w.initial_state(*begin), Mode(), RK4(h), options)

    double = walked(ExportedController(Loaded(source, flags=flags)))
    single = walked(ExportedController(Loaded(source, "float32", flags)))
    shaken, predicted = source_of(computer, shaken=True), dict[str, float]()
    for wide in ("(x)", "shaken(x)"):
        given = (*flags, f"-DSCALE={SCALE!r}", f"-DWIDE(x)={wide}")
        run = walked(ExportedController(Loaded(shaken, flags=given)))
        predicted[wide] = rms(walker, run, double) / SCALE
    return Ripple(
        predicted["shaken(x)"] * DOUBLE,
        rms(walker, walked(walker.controller), double),
        predicted["(x)"],
        rms(walker, single, double),
        single.status is double.status and len(single.arcs) == len(double.arcs),
        float(np.sqrt(np.mean(np.concatenate(list(_torques(walker, double))) ** 2))),
    )


def rms(walker: Walker, one: Trajectory, other: Trajectory) -> float:
    """Root mean square [N m] of the difference of two walks' torques, sample by sample of each support."""
    pairs = zip(_torques(walker, one), _torques(walker, other), strict=False)
    rows = [a[: len(b)] - b[: len(a)] for a, b in pairs]
    return float(np.sqrt(np.mean(np.concatenate(rows) ** 2)))


def _torques(walker: Walker, run: Trajectory) -> Iterator[Array]:
    """The torque at the motors (K, p) [N m] at the sample instants of every single support."""
    for arc in run.arcs:
        alone = replace(run, arcs=(replace(arc, event=None),))
        calls = recorded(walker, alone)
        yield np.array([call.u for call in calls if call.kind == "step"])
