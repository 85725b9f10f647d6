"""How rough a ground a walk bears, known beforehand: the largest H such that all heights within it are walked.

The map of `stride_map` takes y = sigma^2 / 2 in the middle of a step to that of the next one, over a foothold
that is higher by h than the stance foot:

    y+ = a(h) y + b(h),   y*(h) = b / (1 - a),   0 < a < 1

It rises in y. So a walk over any heights of a set stays between the least and the largest y*(h) of the set: a
ground that changes by the same h in each step is the worst. A limit leaves an interval of y for each h:

    stall          sigma^2 > 0, or the robot falls back
    normal force   F_N > 0
    friction       |F_T| <= mu F_N
    torque, rate   |u_i| and |q_i'| within the limits of motors and joints

Others depend on h alone: the friction of the impulse, the clearance of the swing foot, and a landing for which
the map holds. H is the largest with the first interval inside of the others. It is computed for each limit by
itself, so H without some of them, such as torques that clip while the robot walks on, is the least of the rest.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from types import NoneType
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from biped_adrc.analysis.stride_map import FAR, SIDE, StrideMap
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.control.outer_loop import OuterLoop, tracked_constraint
from biped_adrc.control.reference_reset import ReferenceReset
from biped_adrc.core.checks import check_part, numbers
from biped_adrc.core.errors import InputError
from biped_adrc.core.shown import Shown, columns
from biped_adrc.core.types import Array, Flags
from biped_adrc.gait.constraint import VirtualConstraint, continued
from biped_adrc.gait.design.rough import HIGHEST
from biped_adrc.gait.gait import Gait
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import KnownLimits, Limits
from biped_adrc.model.planar_robot import robot_of

CLIPPED = ("torque", "rate")
"""Limits at which motors clip, and the robot walks on."""
IMPULSE, CLEARANCE, LANDING, LEG = "impulse", "clearance", "landing", "leg"
"""Names of limits on h: friction of the impulse, swing foot, landing, and the end of the map by its size."""
WAYS = {"up": (1,), "down": (-1,), "both": (1, -1)}
"""Signs of the heights in [0, H], [-H, 0] and [-H, H]."""
FRICTIONS = (0.4, 0.5, 0.6, 0.7, 0.8)
"""Values of mu for which H is printed."""
_NODES = 800
"""Number of values of y, and of heights, in the kernel of `mean_steps`."""


class Reach(NamedTuple):
    """The largest height H of the ground's changes, and the limit that stops it."""

    height: float
    """H [m]; 0 where level ground is not walked."""
    cause: str
    """Name of the limit."""

    def __str__(self) -> str:
        return f"{1e3 * self.height:.2f} mm, {self.cause}"


@dataclass(frozen=True)
class RoughGround(Shown):
    """How rough a ground a walk bears; `text()` has all numbers. Make it by `rough_ground`."""

    plant: Biped
    """The robot that walks."""
    map: StrideMap
    """The map of y from step to step."""
    limits: KnownLimits
    """Limits of ground and motors."""
    gain: float
    """Largest relative amplitude of zeta = sigma-^2 / 2 before impacts per amplitude of h [1/m]."""
    by_force: Mapping[float, Reach]
    """H both ways while a horizontal force F is held on the hip: F [N] -> H."""

    @cached_property
    def within(self) -> dict[str, tuple[Array, Array]]:
        """Bounds of y from below and above at each height, (M,) each, by the name of the limit."""
        return self.map.intervals(self.limits, self.plant)

    @cached_property
    def alone(self) -> dict[str, Array]:
        """Margins (M,) of the limits on h alone, by name: positive where they are kept."""
        impulse = np.maximum(self.limits.friction - self.map.impulse, -FAR)
        return {IMPULSE: impulse, CLEARANCE: self.map.clearance().own}

    def _outward(self, x: Array, way: str) -> Array:
        """The numbers x (M,) from the height 0 on, a row for each sign of the heights of this way."""
        if way not in WAYS:
            raise InputError(f"the way of the heights is {way!r}, expected one of {[*WAYS]}")
        rows = {1: x[self.map.level :], -1: x[self.map.level :: -1]}
        shorter = min(len(rows[sign]) for sign in WAYS[way])
        return np.array([rows[sign][:shorter] for sign in WAYS[way]])

    def reaches(self, way: str = "both") -> dict[str, float]:
        """H [m] of each limit by itself, by name; infinite where nothing within the map breaks it.

        way: "up" for heights in [0, H], "down" for [-H, 0], "both" for [-H, H].
        """

        def least(x: Array) -> Array:
            # over all heights up to each H; least(-x) is minus the largest
            return np.minimum.accumulate(np.min(self._outward(x, way), axis=0))

        y, c = self.map.steady, self.map.clearance()
        margins = {name: least(x) for name, x in self.alone.items()}
        for name, (low, high) in self.within.items():
            margins[name] = np.minimum(least(y) + least(-low), least(high) + least(-y))
        lines = np.minimum(least(c.ahead) + least(-c.rise), least(c.fall) - c.behind)
        margins[CLEARANCE] = np.minimum(margins[CLEARANCE], lines)
        H = np.abs(self._outward(self.map.heights, way)[0])
        # a map that ends before its usual heights has no landing on the next one
        end = {LEG if len(H) > SIDE else LANDING: float(H[-1])}
        # margins x fall with H, so -x rises: the H at which it is 0; infinite where it stays below, and 0 where
        # it is above from H = 0 on
        return {n: float(np.interp(0.0, -x, H, right=np.inf)) for n, x in margins.items()} | end

    def reach(self, way: str = "both", but: Collection[str] = ()) -> Reach:
        """H of one way without the limits named in `but`; way: as in `reaches`.

        Raises InputError for an unknown way or limit.
        """
        heights, known = self.reaches(way), sorted({*self.within, *self.alone})
        if unknown := set(but) - set(known):
            raise InputError(f"there is no limit {min(unknown)!r}, expected some of {known}")
        return Reach(*min((H, name) for name, H in heights.items() if name not in but))

    def interval(self, H: float) -> tuple[float, float]:
        """The least and the largest y [kg^2 m^4/s^2] of a walk over heights in [-H, H] m."""
        m = self.map
        inside = np.linspace(-H, H, 2 * SIDE + 1)
        y = np.interp(inside, m.heights, m.steady)
        return float(np.min(y)), float(np.max(y))

    def at_friction(self, friction: float) -> "RoughGround":
        """The same on ground of another friction mu [1]; `by_force` stays that of the first ground."""
        return replace(self, limits=self.limits._replace(friction=friction))

    def mean_steps(self, H: float) -> float:
        """Mean number of the step that fails, counted from a level walk, over independent heights uniform in
        [-H, H] m; infinite where all of them are walked. Raises InputError for heights beyond those of the map.
        """
        highest = HIGHEST * robot_of(self.plant).leg
        if not 0.0 < H <= highest:
            raise InputError(
                f"the heights are up to {H:g} m, expected above 0 and at most {highest:.3g} m, the share "
                f"{HIGHEST:g} of the leg's length"
            )
        if self.reach().height >= H:
            return float("inf")
        m, n = self.map, _NODES
        h = H * (2.0 * (np.arange(n) + 0.5) / n - 1.0)
        h = h[(h >= m.heights[0]) & (h <= m.heights[-1])]  # a step over another height fails
        # bounds of y from below and above within which the step over each h is walked; FAR: no y is
        lows, highs = zip(*self.within.values(), strict=True)
        alone = np.min([*self.alone.values()], axis=0, initial=FAR)
        bounds = np.max(lows, axis=0), np.min(highs, axis=0), alone
        low, high, margin = (np.interp(h, m.heights, x) for x in bounds)
        low = np.where(margin > 0.0, low, FAR)
        y = np.linspace(max(np.min(low), 0.0), np.max(m.steady), n)  # no y rises above all y*
        walked = (y > low[:, np.newaxis]) & (y < high[:, np.newaxis])
        a, b = (CubicSpline(m.heights, x)(h) for x in (m.delta2, -m.delta2 * m.V_2 - m.V_1))
        N = failing_step(y, np.outer(a, y) + b[:, np.newaxis], walked, np.full(len(h), 1.0 / n))
        return float(np.interp(m.steady[m.level], y, N))

    def text(self) -> str:
        """The numbers as lines of text."""
        H, level = self.reach().height, self.map.steady[self.map.level]
        low, high = (y / level for y in self.interval(H))
        at = (f"{mu:g}: {1e3 * self.at_friction(mu).reach().height:.2f}" for mu in FRICTIONS)
        others = {"without the impulse": (IMPULSE,), "where motors clip": CLIPPED}
        rows = [
            *(
                (f"H {way} {text}", str(self.reach(way, but)))
                for text, but in {"": (), **others}.items()
                for way in WAYS
            ),
            ("H at mu, mm", ", ".join(at)),
            *((f"H at {F:+g} N on the hip", str(reach)) for F, reach in self.by_force.items()),
            ("y at H", f"{low:.3f} to {high:.3f} of y on level ground"),
            ("gain", f"{0.1 * self.gain:.2f} % of zeta per mm"),
        ]
        if 0.0 < 1.3 * H <= HIGHEST * robot_of(self.plant).leg:
            count = f"{self.mean_steps(1.3 * H):.3g}"
            rows.append(("a step fails", f"after {count} in the mean, at 1.3 H"))
        return "\n".join(columns(rows))


def failing_step(y: Array, after: Array, walked: Flags, p: Array) -> Array:
    """Mean number N (n,) of the step that fails, from each value of y (n,): N = 1 + T N, T of the next y.

    y: evenly spaced. after (m, n): y+ over each of m heights, of the probabilities p (m,). walked (m, n):
    whether that step is. y+ lies between two values, and counts for them by its distances; below all of them
    the next step fails.
    """
    n, place = len(y), (after - y[0]) / (y[1] - y[0])
    k, T = np.floor(place), np.zeros(len(y) ** 2)
    for to, weight in ((k, 1.0 - place + k), (k + 1.0, place - k)):
        counts = walked & (to >= 0) & (to < n)
        cells = (n * np.arange(n) + to)[counts].astype(int)
        T += np.bincount(cells, (weight * p[:, np.newaxis])[counts], n * n)
    return np.asarray(np.linalg.solve(np.eye(n) - T.reshape(n, n), np.ones(n)), float)


def rough_ground(
    walker: Walker, gait: Gait, limits: Limits | None = None, forces: Sequence[float] = (-2.0, 2.0)
) -> RoughGround:
    """How rough a ground a walker bears on a gait, with `ReferenceReset` and a perfect inner loop in continuous
    time. A step may last as long as it takes: near H longer than the walker's `max_step_time`.

    walker: its controller is ReferenceReset, its ground is level but for steps; what disturbs it does not
    count, and the robot is the plant, whatever the controller's model. gait: whose curve it tracks. limits:
    None for those of the robot's record. forces [N]: those of `by_force`. Raises InputError where the map does
    not hold, or level ground is not walked.

    >>> walker = ba.Walker(biped, ba.ReferenceReset(ba.NPDController(gait.constraint)))
    >>> ba.rough_ground(walker, gait).reach().cause
    'friction'
    """
    h, share = _curve(walker, gait)
    check_part(limits, "limits", Limits, NoneType)
    row = numbers(forces, "the forces on the hip")
    if row.ndim != 1 or not np.all(np.isfinite(row)):
        raise InputError(f"forces on the hip are {forces!r}, expected a row of finite numbers [N]")
    plant, k = walker.plant, (limits or Limits()).of(walker.plant.description)
    maps = {F: StrideMap.of(plant, h, share, F) for F in (0.0, *row.tolist())}
    if not len(maps[0.0].heights):
        raise InputError(
            f"the foot does not land on level ground past the share {share:g} of the step, where the reset "
            "ends, or too close to it; expected another share of ReferenceReset"
        )
    result = RoughGround(plant, maps[0.0], k, _gain(plant, h, share), {})
    if broken := [name for name, H in result.reaches().items() if H == 0.0]:
        raise InputError(
            f"gait '{gait.name}' does not walk level ground, where the limits {broken} are broken; expected a "
            "stable gait that keeps them"
        )
    by_force = {F: replace(result, map=maps[F]).reach() for F in row.tolist()}
    return replace(result, by_force=by_force)


def _curve(walker: Walker, gait: Gait) -> tuple[VirtualConstraint, float]:
    """The curve that a walker tracks, and the share [1] of its range after which the reset ends.

    Raises InputError for a walker that the map does not describe.
    """
    check_part(walker, "what is to walk", Walker)
    check_part(gait, "the gait of the walk", Gait)
    reset, plant = walker.controller, walker.plant
    if not isinstance(reset, ReferenceReset) or isinstance(reset.inner, OuterLoop):
        raise InputError(
            f"the controller is {type(reset).__name__}, expected ReferenceReset around a controller that is no "
            "outer loop: only then the walk is a map of one number"
        )
    h, slope = tracked_constraint(reset), gait.slope if walker.slope is None else walker.slope
    own_clock = walker.touchdown is not None or not getattr(walker.timing, "restart", True)
    wrong = {
        "the controller keeps its own clock, expected one that knows each impact at once": own_clock,
        f"the controller does not track the curve of gait '{gait.name}', expected that curve": (
            continued(h) != continued(gait.constraint)
        ),
        f"the ground has a slope of {slope:g} rad, expected 0": slope != 0.0,
        "the plant has joint friction, with which torques have no bound in y; expected none": plant.friction,
        "the walker has an impact_gain, expected none": bool(walker.impact_gain),
    }
    for text, found in wrong.items():
        if found:
            raise InputError(text)
    return h, reset.share


def _gain(plant: Biped, h: VirtualConstraint, share: float) -> float:
    """Largest relative amplitude of zeta = y - V_2(h) per amplitude of h [1/m], if h is a sine of the steps.

    With b = dy+/dh and the shift z it is |b / (z - a) - dV_2/dh| / zeta*, which is largest at z = 1 or -1.
    """
    d = 1e-5  # [m], for central differences
    m = StrideMap.of(plant, h, share, heights=np.array([-d, 0.0, d]))
    a, zeta = m.delta2[1], m.steady[1] - m.V_2[1]
    b, dV_2 = ((x[2] - x[0]) / (2.0 * d) for x in (m.delta2 * (m.steady[1] - m.V_2) - m.V_1, m.V_2))
    return float(max(abs(b / (1.0 - a) - dV_2), abs(b / (1.0 + a) + dV_2)) / zeta)
