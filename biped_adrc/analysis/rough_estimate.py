"""How rough a ground any walker bears, estimated from one simulated step per speed and height.

`rough_ground` computes this for a walk that is a map of one number. Under other controllers, with a clock,
encoders or a delay, the state has more numbers; here they count as if they were those of a walk that begins on
the gait's orbit just after impact, with all rates scaled. So it is an estimate, to be tried by `overturn`.

    y          sigma^2 / 2 where Theta is in the middle of its range, sigma about the stance foot
    h          height of the next foothold above the stance foot [m]
    y+(y, h)   y in the middle of the step after, simulated for N values of y and M heights h
    y*(h)      where y+(y, h) = y

Where y+ rises in y, a walk over heights within [-H, H] stays between the least and the largest y* of these
heights. H is the largest one with which each limit of `feasibility` is kept by all steps from this interval,
each judged from one middle to the next, with forces in the mean over the limits' window. Between the values of
the grid, margins are linear. Noise is that of the walker's seed: of several seeds the least H counts.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from numbers import Integral
from types import NoneType
from typing import NamedTuple

import numpy as np
from scipy.interpolate import make_interp_spline

from biped_adrc.analysis.certificate import AT_NODES, IMPULSE, supports
from biped_adrc.analysis.feasibility import Feasibility
from biped_adrc.analysis.ground_force import Nodes, demands, impulse_ratios
from biped_adrc.analysis.rough_ground import FRICTIONS, WAYS, Reach
from biped_adrc.analysis.signals import signals
from biped_adrc.analysis.stride_map import FAR
from biped_adrc.closed_loop.walker import Mode, Walker
from biped_adrc.core.checks import check_part
from biped_adrc.core.errors import InputError, check_positive, check_whole
from biped_adrc.core.shown import Shown, columns
from biped_adrc.core.types import Array
from biped_adrc.engine.batch import BatchWalk, Case, simulate_many
from biped_adrc.gait.gait import Gait
from biped_adrc.hybrid.integrators import RK4, OneStepMethod
from biped_adrc.hybrid.status import Status
from biped_adrc.model.ground import ROUND_OFF, KnownLimits, Limits, stepped

STEADY_RATES = (0.1, 1.9)
"""Least and largest root of y of the grid, as shares of that on level ground [1], which is in the middle."""
LEAST = 9
"""Least number of heights, and of y: with fewer H is off by more than a tenth."""
GRID_END = "grid"
"""Name of what stops H where the grid of y or h ends."""
LIMITS = ("stall", *AT_NODES, IMPULSE)
"""Names of the limits; "stall" is the least s'^2 [1/s^2], negative where the robot falls back."""
_FINEST = 1e-4
"""Least H for which a finer grid is simulated [m]."""
_LEAST = 1e-9
"""Least margin, for numbers that are 0 wherever they are within their limit."""


class Overturned(NamedTuple):
    """How many walks were not feasible."""

    random: int
    """Of the walks over random heights."""
    worst: int
    """Of the 6 worst sequences."""


@dataclass(frozen=True)
class RoughEstimate(Shown):
    """An estimate of how rough a ground a walker bears. Make it by `rough_estimate`."""

    walker: Walker
    """The walker."""
    gait: Gait
    """The gait from whose orbit steps begin."""
    method: OneStepMethod
    """Method of integration."""
    limits: KnownLimits
    """Limits of ground and motors."""
    heights: Array
    """h (M,) [m], from -highest to highest."""
    y: Array
    """y (N,) [kg^2 m^4/s^2], increasing."""
    following: Array
    """y+ (N, M); NaN for a step that does not come to the next middle."""
    numbers: Array
    """The worst number of each of the LIMITS (L, N, M)."""

    @cached_property
    def steady(self) -> Array:
        """Fixed points y* (M,), beyond the grid on a line; infinite for none."""
        result = np.full(len(self.heights), np.inf)
        for j, following in enumerate(self.following.T):
            finite = np.isfinite(following)
            y, gain = self.y[finite], (following - self.y)[finite]
            if len(y) > 1:
                k = min(max(int(np.sum(gain > 0.0)), 1), len(y) - 1)
                if (falls := gain[k - 1] - gain[k]) > 0.0:
                    result[j] = y[k - 1] + (y[k] - y[k - 1]) * gain[k - 1] / falls
        return result

    @cached_property
    def margins(self) -> Array:
        """Margins of the LIMITS (L, N, M), negative where one is broken; a stall breaks that one alone."""
        k, stalled, y = self.limits, np.isnan(self.following), self.y
        cone = (1.0 + ROUND_OFF) * k.friction
        most = np.array([0.0, 0.0, cone, 0.0, k.torque, 1.0, 0.0, cone])[:, np.newaxis, np.newaxis]
        result = _LEAST + most - self.numbers
        result[:2] = self.numbers[:2]  # the least s'^2 and F_N, which have to be positive
        result = np.where(stalled, FAR, np.clip(result, -FAR, FAR))
        pace = np.where(stalled, -FAR, result[0])
        for i in range(len(y) - 3, -1, -1):
            # where the robot falls back, s'^2 is on the line through the next two y
            slope = (pace[i + 2] - pace[i + 1]) / (y[i + 2] - y[i + 1])
            line = np.minimum(pace[i + 1] - slope * (y[i + 1] - y[i]), -_LEAST)
            pace[i] = np.where(stalled[i], line, pace[i])
        result[0] = pace
        return result

    def reaches(self, way: str = "both") -> dict[str, float]:
        """H [m] of each limit by itself, by name; infinite where no height of the grid breaks it.

        way: "up" for heights in [0, H], "down" for [-H, 0], "both" for [-H, H].
        """
        if way not in WAYS:
            raise InputError(f"the way of the heights is {way!r}, expected one of {[*WAYS]}")
        side, y, rows = len(self.heights) // 2, self.y, list[Array]()
        on_lines, H = make_interp_spline(y, self.margins, k=1, axis=1), self.heights[side:]
        for k in range(side + 1):
            down, up = (k if sign in WAYS[way] else 0 for sign in (-1, 1))
            inside = slice(side - down, side + up + 1)
            ends = np.min(self.steady[inside]), np.max(self.steady[inside])
            at = np.clip(y, *np.clip(ends, y[0], y[-1]))
            room = max(min(ends[0] - y[0], y[-1] - ends[1]), -FAR)
            rows.append(np.append(room, np.min(on_lines(at)[..., inside], axis=(1, 2))))
        margins = np.minimum.accumulate(rows).T
        found = [float(np.interp(0.0, -margin, H, right=np.inf)) for margin in margins]
        heights = min(found[0], float(H[-1])), *found[1:]
        return dict(zip((GRID_END, *LIMITS), heights, strict=True))

    def reach(self, way: str = "both") -> Reach:
        """H of one way and what stops it: GRID_END or one of LIMITS."""
        return min((Reach(H, name) for name, H in self.reaches(way).items()), key=lambda x: x[0])

    def interval(self, H: float) -> tuple[float, float]:
        """The least and the largest y [kg^2 m^4/s^2] of a walk over heights in [-H, H] m."""
        y = np.interp(np.linspace(-H, H, 201), self.heights, self.steady)
        return float(np.min(y)), float(np.max(y))

    def at_friction(self, friction: float) -> "RoughEstimate":
        """The same on ground of another friction mu [1]."""
        return replace(self, limits=self.limits._replace(friction=friction))

    def case(self, heights: Array, scale: float = 1.0) -> Case:
        """The walk over these heights [m] from the gait's orbit, with rates times `scale` [1]."""
        walker = replace(self.walker, ground_steps=stepped(-heights))
        q, v = self.gait.start(walker.nominal)
        return Case(walker, q, scale * v, self.method, len(heights), Mode(), self.gait.constraint)

    def overturn(
        self, walks: int = 200, share: float = 0.95, steps: int = 50, seed: int = 0
    ) -> Overturned:
        """Walk over heights within `share` of H both ways, and count the walks that are not feasible.

        walks: number of walks over independent heights, uniform, of so many steps each; seed: of the heights.
        The worst sequences are stairs to the least and to the largest y* with a last step up or down, and steps
        up and down by turns.
        """
        check_positive(share, f"the share of H is {share!r}")
        for name, count in {"walks": walks, "steps": steps, "seed": seed}.items():
            check_whole(count, f"{name} is {count!r}", int(name == "steps"))
        H = share * self.reach().height
        h = np.linspace(-H, H, 201)
        y = np.interp(h, self.heights, self.steady)
        stairs = h[np.argmin(y)], h[np.argmax(y)]
        worst = [np.append(np.full(steps - 1, h), last) for h in stairs for last in (-H, H)]
        worst += [sign * H * (-1.0) ** np.arange(steps) for sign in (1, -1)]
        random = np.random.default_rng(seed).uniform(-H, H, (walks, steps))
        cases = (self.case(h) for h in (*worst, *random))
        fails = [not _feasible(*walked, self.limits) for walked in _walks(cases)]
        return Overturned(sum(fails[len(worst) :]), sum(fails[: len(worst)]))

    def text(self) -> str:
        """The numbers as lines of text."""
        level = self.steady[len(self.heights) // 2]
        low, high = (y / level for y in self.interval(self.reach().height))
        at = (f"{mu:g}: {1e3 * self.at_friction(mu).reach().height:.1f}" for mu in FRICTIONS)
        rows = [(f"H {way}, estimated", str(self.reach(way))) for way in WAYS]
        rows += [("H at mu, mm", ", ".join(at))]
        rows += [("y at H", f"{low:.3f} to {high:.3f} of y on level ground")]
        return "\n".join(columns(rows))


def _walks(cases: Iterable[Case]) -> Iterator[tuple[Case, BatchWalk, Nodes]]:
    """The cases with their walks and the nodes of these, in order."""
    cases = list(cases)
    for case, walk in zip(cases, simulate_many(cases), strict=True):
        walker, run = case.walker, walk.trajectory
        if walk.table is not None:
            yield case, walk, Nodes(walk.table, walker.plant.n, walker.plant.p)
        elif run is not None and case.curve is not None:
            yield case, walk, Nodes.of(signals(walker, run, case.curve))
        else:
            raise InputError(f"a step cannot be simulated: {walk.status.name} {walk.detail}")


def _feasible(case: Case, walk: BatchWalk, n: Nodes, k: KnownLimits) -> bool:
    """Whether a walk was made within the limits."""
    plant, after = case.walker.plant, None
    if walk.status is Status.COMPLETED:
        after = plant.momentum(*np.split(walk.final_state[: 2 * plant.n], 2))
    judged = supports(case.walker, n, k, walk.impacts, after)
    return Feasibility(walk.status, judged, walk.impacts).outcome == "feasible"


def _step(case: Case, walk: BatchWalk, n: Nodes, gait: Gait, window: float) -> Array:
    """y, y+ and the numbers of the LIMITS (L + 2,) of the step from the middle of single support 1 to that of
    2; y is NaN where none is reached. window [s]: of the mean force."""
    h, at, step = gait.constraint, n.at.reading, n.at.step
    s = h.rate * (at.q @ h.phase - h.theta_plus)
    first, last = (np.flatnonzero((step == number) & (s >= 0.5))[:1] for number in (1, 2))
    y = [_y(case.walker, n, s, int(k[0])) if len(k) else np.nan for k in (first, last)]
    if not len(first):
        return np.full(len(LIMITS) + 2, np.nan)
    inside = slice(int(first[0]), int(last[0]) + 1 if len(last) else None)
    dt, ds = np.diff(n.at.t[inside]), np.diff(s[inside])
    along = (dt > 0.0) & (np.diff(step[inside]) == 0.0)
    pace = ds[along] / dt[along]
    found = demands(case.walker, n, window, walk.impacts)[0][: len(AT_NODES), inside]
    impulse = impulse_ratios(case.walker, n, min(walk.impacts, 1), None)[0]
    worst = np.min(found[0]), *np.max(found[1:], axis=1), impulse
    return np.array([*y, np.min(pace * np.abs(pace)), *worst])


def _y(walker: Walker, n: Nodes, s: Array, k: int) -> float:
    """sigma^2 / 2 where the phase s (K,) is 1/2, between the nodes k - 1 and k."""
    at, plant, pair = n.at.reading, walker.plant, [max(k - 1, 0), k]
    values = list[float]()
    for i in pair:
        # q_N' is that with which m v_com, linear in the rates, is that of the node
        q, v = at.q[i], np.append(at.v_b[i], 0.0)
        one = plant.momentum(q, np.eye(plant.n)[-1])
        v[-1] = one @ (at.momentum[i] - plant.momentum(q, v)) / (one @ one)
        values.append(0.5 * plant.angular_momentum(q, v) ** 2)
    return float(np.interp(0.5, s[pair], values))


def rough_estimate(
    walker: Walker,
    gait: Gait,
    limits: Limits | None = None,
    method: OneStepMethod = RK4(1e-3),  # noqa: B008
    highest: float = 0.02,
    grid: tuple[int, int] = (25, 41),
) -> RoughEstimate:
    """Estimate how rough a ground a walker bears on a gait, from one simulated step per y and h.

    Its ground is level but for steps. limits: None for those of the robot's record. method: of integration.
    highest [m]: largest height of the grid, at which H ends; where H is less than 0.22 of it, a finer grid
    follows. grid: odd numbers N of y and M of heights; a coarse grid is off to either side. Raises InputError
    where the walker does not come to the middle of the second step on level ground.

    >>> from biped_adrc.analysis.rough_estimate import rough_estimate
    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=ba.SampledTime(1e-3))
    >>> rough_estimate(walker, gait, grid=(17, 21)).reach().cause
    'friction'
    """
    check_part(walker, "what is to walk", Walker)
    check_part(gait, "the gait of the walk", Gait)
    check_part(limits, "limits", Limits, NoneType)
    check_positive(highest, f"the largest height is {highest!r} m")
    whole = grid if isinstance(grid, tuple) else ()
    odd = [isinstance(x, Integral) and x >= LEAST and x % 2 == 1 for x in whole]
    if odd != [True, True]:
        what = f"two odd numbers, of y and of heights, at least {LEAST}"
        raise InputError(f"the grid is {grid!r}, expected {what}")
    slope = gait.slope if walker.slope is None else walker.slope
    if slope != 0.0:
        raise InputError(f"the ground has a slope of {slope:g} rad, expected 0")
    walker = replace(walker, slope=slope)
    k, none = (limits or Limits()).of(walker.plant.description), np.zeros(0)
    heights = highest * np.linspace(-1.0, 1.0, grid[1])
    empty = RoughEstimate(walker, gait, method, k, heights, none, none, none)

    def steps(cases: Iterable[Case]) -> Array:
        return np.array([_step(*walked, gait, k.window) for walked in _walks(cases)])

    level = steps([empty.case(np.zeros(2))])[0]
    if np.any(np.isnan(level[:2])):
        raise InputError(
            f"the walker does not walk gait '{gait.name}' on level ground, expected one that does"
        )
    # y is linear in the square of the rates just after impact
    y, start = level[0] * np.linspace(*STEADY_RATES, grid[0]) ** 2, gait.start(walker.nominal)
    scale = np.sqrt(1.0 + (y - level[0]) / (0.5 * walker.plant.angular_momentum(*start) ** 2))
    cases = (empty.case(np.array([h, 0.0]), x) for x in scale for h in heights)
    found = np.moveaxis(np.reshape(steps(cases), (*grid, -1)), -1, 0)
    reached = found[0][:, grid[1] // 2]
    y = np.where(np.isnan(reached), y, reached)
    # y has to rise: a step that comes to no middle stands at the y that its rates would give with an exact
    # model, which a late controller can put above that of a faster step
    rises = np.append(y[:-1] < np.minimum.accumulate(y[::-1])[-2::-1], True)
    result = replace(empty, y=y[rises], following=found[1][rises], numbers=found[2:, rises])
    # twice the distance of two heights, as H may lie anywhere between the first two of them
    finer = max(4.0 * (H := result.reach().height), 4.0 * highest / (grid[1] - 1))
    if H > _FINEST and finer < 0.9 * highest:
        return rough_estimate(walker, gait, limits, method, finer, grid)
    return result
