"""The gang of six of a walker: six frequency responses that say what its sampled loop does, for any controller.

At a phase of the gait the robot is linearised, and the loop is cut at the torques (`walker_loop`):

    u = K (q, q') + R r + d,   (q, q') = P u,   y = q_b - q_d = (1 - H_b, -H_N) q

    S    = (1 - K P)^-1    d -> u      sensitivity: how a load torque d [N m] acts on the torque at the joints
    T    = 1 - S           d -> d - u  complementary sensitivity: the torque that answers d
    P S  = y P S           d -> y      error that a load torque leaves [rad/(N m)]
    C S  = S K             n -> u      torque that an error n of the measured joint angles asks for [N m/rad]
    y/r  = y P S R         r -> y      how the joints follow a shift r of the reference [1]
    u/r  = S R             r -> u      torque that this costs [N m/rad]

    q              the n coordinates [rad], of which q_b (p,) have motors with the torques u (p,)
    q_d, H         reference of q_b, q_d'' = drift + H q'', H = (H_b, H_N) (p, n): a change q moves q_d by H q
    r, n           come with their rates, i w r and i w n; r changes q_d and q_d', not q_d''

P has the delay of the clock and the lag of the motors in it, K the sensors. The derivative by r is taken of the
tick of the walk itself, by differences of a walker that tracks a shifted reference, so that it holds for an
observer that is told kappa u as well as for a law of the error alone.

Of each response a `Gang` has the largest singular value over the joints, and the largest over the phases, on
the plant without errors of its inertias. Frequencies go from twice the rate at which the robot falls to half
the sampling frequency, as those of the margins (`specification`). Of an unstable loop they are the matrices at
z = exp(i w T), which no walk shows.
"""

from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from biped_adrc.analysis.loops.frozen_gait import (
    SHIFT,
    FrozenGait,
    TickMatrices,
    linear_twin,
    tick_matrices,
)
from biped_adrc.analysis.loops.specification import Specification
from biped_adrc.analysis.loops.walker_loop import WalkerLoops, tick_response
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.outer_loop import own_reference, tracking
from biped_adrc.core.errors import InputError
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, ComplexArray, read_only
from biped_adrc.gait.constraint import CorrectedConstraint
from biped_adrc.gait.reference import ReferencePoint

GANG_COLUMNS = "", "peak or value", "at"
"""Of the table."""
GANG_UNITS = {"S": "", "T": "", "P S": "rad/(N m)", "C S": "N m/rad", "y/r": "", "u/r": "N m/rad"}
"""The six, with their units."""
_FINE = 300
"""Number of frequencies in geometric order, beside those of the loop's modes."""


@dataclass(frozen=True)
class Shifted(CorrectedConstraint):
    """The reference `base` with q_d + r and q_d' + dr; r [rad], dr [rad/s], each (p,).

    To outer loops, which ask for the phase of a constraint, it is a corrected one.
    """

    base: Any  # any reference
    correction: Any = None
    r: Array = field(kw_only=True)
    dr: Array = field(kw_only=True)

    def __call__(self, t: float, q: Array, v: Array) -> ReferencePoint:
        point = self.base(t, q, v)
        return point._replace(q_d=point.q_d + self.r, dq_d=point.dq_d + self.dr)


@dataclass(frozen=True)
class Gang(Shown):
    """The six responses over frequency, each the largest singular value; make it by `gang_of_six`."""

    frequencies: Array
    """(F,) [rad/s], increasing."""
    responses: dict[str, Array]
    """By the names of GANG_UNITS, each (F,)."""
    period: float
    """Of the clock [s]."""

    def rows(self, spec: Specification) -> tuple[tuple[str, str, str], ...]:
        """A table of texts: peaks of the six with their frequencies, bandwidth, and the numbers of `spec`."""
        peaks = ((k, unit, *self.peak(k)) for k, unit in GANG_UNITS.items())
        rows = [(f"|{k}|", f"{x:.3g} {unit}", f"{w:.4g} rad/s") for k, unit, x, w in peaks]
        return (
            *rows,
            ("bandwidth, |S| below 0.71", f"{self.bandwidth:.4g} rad/s", ""),
            ("delay margin", f"{1e3 * spec.delay_margin:.3g} ms", ""),
            ("disk margin", f"{spec.disk_margin:.3g}", ""),
            ("ripple", f"{spec.ripple:.3g} N m", ""),
        )

    def peak(self, name: str) -> tuple[float, float]:
        """The largest value of a response, and its frequency [rad/s]."""
        k = int(np.argmax(self.responses[name]))
        return float(self.responses[name][k]), float(self.frequencies[k])

    @property
    def bandwidth(self) -> float:
        """Lowest frequency [rad/s] at which S is 1/sqrt 2 or more: below it load torques are answered."""
        return float(self.frequencies[np.argmax(self.responses["S"] >= np.sqrt(0.5))])


def gang_of_six(walker: Walker, gait: FrozenGait, spec: Specification) -> Gang:
    """The gang of six of a walker on a gait that was linearised at some phases; spec: its specification there.

    Raises InputError for a controller without a field `reference`, and for a law that does not compile;
    NotFiniteError where it has no finite derivative.
    """
    cut = cut_at_torques(walker, gait, spec)
    loops, top = cut.loops, np.pi / cut.loops.period
    own = loops.rates.imag
    grid = np.geomspace(loops.slow, top, _FINE)
    w = np.unique(np.concatenate((grid, own[(own > loops.slow) & (own < top)])))
    found = cut.responses(w).items()
    sizes = {k: np.max(np.linalg.norm(x, 2, axis=(-2, -1)), axis=0) for k, x in found}
    return Gang(read_only(w), {k: read_only(x) for k, x in sizes.items()}, loops.period)


class Cut(NamedTuple):
    """Loops along one axis of phases, cut open at the torques."""

    loops: WalkerLoops
    """(phases,), each with one robot."""
    shift: TickMatrices
    """The tick as it reads (r, r') (2 p,) of the reference."""
    y: Array
    """(phases, p, n): the output per change of q."""

    def responses(self, w: Array) -> dict[str, ComplexArray]:
        """The six at w (F,) [rad/s], each (phases, F, p, p), by the names of GANG_UNITS."""
        (loops, shift, y), (p, n) = self, self.y.shape[-2:]
        s = 1j * w[:, np.newaxis, np.newaxis]
        z = np.exp(s * loops.period)
        K, P = loops.parts(z)
        R = tick_response(z, shift)
        S = np.linalg.inv(np.eye(p) - K @ P)
        by_r, by_n = R[..., :p] + s * R[..., p:], K[..., :p] + s * K[..., n : n + p]
        PS = y[:, np.newaxis] @ P[..., :n, :] @ S
        found = (S, np.eye(p) - S, PS, S @ by_n, PS @ by_r, S @ by_r)
        return dict(zip(GANG_UNITS, found, strict=True))


def cut_at_torques(walker: Walker, gait: FrozenGait, spec: Specification) -> Cut:
    """The loops of a walker on the plant itself, with what the reference does; it raises as `gang_of_six`."""
    twin, n, p = linear_twin(walker), walker.plant.n, walker.plant.p
    h = own_reference(twin.controller)
    if h is None:
        raise InputError(
            f"{type(twin.controller).__name__} has no field `reference`, to which the loop could respond; "
            "expected a controller as NPDController(gait.constraint)"
        )

    def shifted(x: Array) -> Walker:
        """The twin whose reference is shifted by x = (r, r')."""
        return replace(twin, controller=tracking(twin.controller, Shifted(h, r=x[:p], dr=x[p:])))

    pairs = [(shifted(e), shifted(-e)) for e in SHIFT * np.eye(2 * p)]
    tick = tick_matrices(twin, gait.points, pairs)
    loops = replace(spec.loops[:, 0], tick=tick.reading(slice(2 * n)))
    H = np.array([h(at.t, at.q, at.v).H for at in gait.points])
    return Cut(loops, tick.reading(slice(2 * n, None)), np.eye(p, n) - H)
