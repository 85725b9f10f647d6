"""Robustness and ripple of a candidate's loop, computed before any walk is simulated: its specification.

    spec = specification(walker, gait)
    spec.stable, spec.delay_margin, spec.disk_margin, spec.ripple

A candidate is a walker: controller with observer and reference, sensors with filter, clock with delay, motors.
Its sampled loop is linearised (`walker_loop`) at several phases of the gait, at each with several robots. By
default (`frozen_gait`) the phases are 15, 40, 65 and 90 % of the time of a step, and the robots are five: the
plant, and four with masses and inertias off by 20 %, in the 2 x 2 combinations of a trunk that is lighter or
heavier and legs that are lighter or heavier. Of all these loops:

- stable [true or false]: every mode of every loop decays.
- delay_margin [s]: the smallest delay in all motors, beside the clock's own and unknown to the controller, with
  which one of the loops is unstable; at most MOST_DELAY, 0.05 s.
- disk_margin [1]: the smallest multiloop disk margin, see below.
- ripple [N m]: rms over a step of the torque that quantisation and noise of the encoders cause, of the motor
  in which it is largest, on the plant alone.

The gait's own modes do not count: a robot on a foot without a motor falls, with growth about sqrt(g / l),
until the next step catches it, and no torque on joints that track a gait changes that. g is gravity, l the
height of the hip. So a mode exp(s t) counts only where |s| exceeds 2 times that rate (_OWN), and margins are
taken at frequencies above this bound. The multipliers of the return map (`analysis.return_map`) describe the
effect of impacts.

The multiloop disk margin bounds errors of all motors at once, in gain and in phase. G is the loop cut at the
torques: torques u on the robot make the controller ask for G u. With the sensitivity S = (1 - G)^-1 the loop is
stable with every diagonal Delta in

    u_i -> (1 + Delta_i / 2) / (1 - Delta_i / 2) u_i,    |Delta_i| < alpha
    alpha = 1 / max_w mu(S(w) - 1/2)

(Seiler, Packard, Gahinet, IEEE Control Systems Magazine 40(5), 2020, skew 0). A margin alpha lets all gains
vary between (2 - alpha) / (2 + alpha) and its inverse, and all phases by +-2 atan(alpha / 2). mu is the
structured singular value of one complex number per motor; as usual its upper bound is taken,

    mu(M) <= min over d > 0 of sigma_max(diag(d) M diag(d)^-1)

which is mu itself for up to three motors, and on the safe side beyond.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from biped_adrc.analysis.loops.frozen_gait import FrozenGait, linear_twin, tick_matrices
from biped_adrc.analysis.loops.walker_loop import WalkerLoops
from biped_adrc.closed_loop.walker import Walker
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, ComplexArray
from biped_adrc.gait.gait import Gait

_OWN = 2.0
"""A mode belongs to the gait itself where |s| is below this many times sqrt(g / l) [1]."""
MOST_DELAY = 0.05
"""Largest unknown delay that is tried [s]."""


class Worst(NamedTuple):
    """The mode that decays least, and its loop."""

    growth: float
    """Growth rate of the mode [1/s], below 0 where it decays."""
    share: float
    """Phase of its loop: time since the step began, over the time of a step [1]."""
    robot: int
    """Index of its robot; 0 for the plant itself."""


@dataclass(frozen=True)
class Specification(Shown):
    """The loops of one candidate with their margins and ripple. Make it by `specification`.

    Each number is computed at its first use, in milliseconds. For an unstable loop the text says "unstable";
    its margins are 0 and its ripple is infinite.
    """

    loops: WalkerLoops
    """The loops by phase and by robot; the first robot is the plant."""
    shares: tuple[float, ...]
    """Phases: times since the step began, over the time of a step [1]."""
    errors: Array
    """Standard deviations (2 n,) [rad, rad/s] of the sensors' errors of (q, q')."""

    @cached_property
    def worst(self) -> Worst:
        """The mode that decays least, over phases and robots."""
        growth = self.loops.growth()
        phase, robot = np.unravel_index(np.argmax(growth), growth.shape)
        return Worst(float(growth[phase, robot]), self.shares[phase], int(robot))

    @property
    def stable(self) -> bool:
        """Whether every mode of every loop decays."""
        return self.worst.growth < 0.0

    @cached_property
    def delay_margin(self) -> float:
        """The smallest unknown delay [s] with which one of the loops is unstable: 0 to MOST_DELAY."""
        return self.loops.delay_margin(MOST_DELAY)

    @cached_property
    def disk_margin(self) -> float:
        """The smallest multiloop disk margin of the loops [1]; above 2 no error of the gains alone,
        without one of the phases, makes one unstable.

        It is 0 for an unstable loop.
        """
        if not self.stable:
            return 0.0
        # all matrices (p, p), of each loop at each frequency, in one row for the module's function
        S = self.loops.sensitivity()
        return disk_margin(S.reshape(-1, *S.shape[-2:]))

    @cached_property
    def ripple(self) -> float:
        """rms over a step of the torque [N m] that the sensors' errors make in the motor with the largest one.

        On the plant itself, not the other robots; infinite for an unstable loop.
        """
        if not self.stable:
            return math.inf
        plant = (self.loops[i, 0] for i in range(len(self.shares)))
        # mean squares (p,) of the torques at each phase
        squares = [np.diag(loop.covariance_of_torque(self.errors)) for loop in plant]
        return float(np.sqrt(np.max(np.mean(squares, axis=0))))

    def columns(self) -> dict[str, float]:
        """All numbers by name, none of them NaN: stable [0 or 1], growth [1/s] of the mode that decays least,
        negative where stable, delay_margin [s], disk_margin [1], ripple [N m].
        """
        margins = {name: getattr(self, name) for name in ("delay_margin", "disk_margin", "ripple")}
        return {"stable": float(self.stable), "growth": self.worst.growth, **margins}

    def __str__(self) -> str:
        growth, share, robot = self.worst
        where = f"at {100.0 * share:.0f} % of the step" + (" with other inertias" if robot else "")
        if not self.stable:
            return f"unstable: a mode grows by {growth:.3g} /s {where}"
        more = "more than " if self.delay_margin >= MOST_DELAY else ""
        return (
            f"stable: bears {more}{1e3 * self.delay_margin:.3g} ms of unknown delay, disk margin "
            f"{self.disk_margin:.3g}, ripple {self.ripple:.3g} N m rms"
        )


def specification(walker: Walker, gait: Gait | FrozenGait) -> Specification:
    """Linearise the sampled loop of a walker on a gait; its margins and ripple follow.

    For many candidates on one robot and gait pass a `FrozenGait`, which is made once. Raises InputError for a
    walker in continuous time or one that detects touchdowns, GaitError for a gait without a periodic orbit,
    NotFiniteError where a method has no finite derivative on the gait.
    """
    # without its parts that have no derivative: limits, counts, noise, pushes; and without motors
    twin = linear_twin(walker)
    if isinstance(gait, Gait):
        gait = FrozenGait.of(walker.plant, gait, walker.nominal)
    # slow: up to this |s| a mode is the gait's own; gait.falling is sqrt(g / l)
    T, delay, slow = twin.clock.period, twin.clock.delay, _OWN * gait.falling
    lag = 0.0 if walker.motors is None else walker.motors.lag
    # tick: the linearised sample instant. The new axis is that of the robots, for which the tick is the same
    tick = tick_matrices(twin, gait.points)
    tick = type(tick)._make(x[:, np.newaxis] for x in tick)
    # of each point its A (robots, 2 n, 2 n) and B (robots, 2 n, p), (q, q')' = A (q, q') + B u
    A, B = (np.array([getattr(at, name) for at in gait.points]) for name in "AB")
    loops = WalkerLoops(tick, A, B, T, delay, lag, slow)
    # sensors add their errors to those of `exact`, which are none
    n, exact = walker.plant.n, np.zeros(2 * walker.plant.n)
    errors = exact if walker.sensors is None else walker.sensors.errors(n, walker.plant.p, exact)
    return Specification(loops, tuple(at.t / gait.period for at in gait.points), errors)


BALANCED = 10
"""Sweeps of Osborne's iteration, whose bounds decide for which frequencies mu is computed."""
TOP = 50
"""Number of matrices of largest norm whose spectral radius excludes frequencies with smaller mu."""
_SMOOTH = (8, 64, 512)
"""Powers p of the norms (sum sigma^p)^(1/p), one after the other, for sigma_max, which is not smooth."""


def balanced_bound(M: ComplexArray) -> Array:
    """Upper bounds of mu (F,) of matrices M (F, p, p), by Osborne's scaling: fast, but not the least ones.

    Each scaling d_i makes the norms of row i and column i equal, diagonal entries left out.
    """
    p = M.shape[-1]
    a = np.moveaxis(np.abs(M) ** 2, 0, -1) * (1.0 - np.eye(p))[..., np.newaxis]  # (p, p, F)
    d = np.ones((p, len(M)))
    # a: squares of the scaled entries; f: norm of column i over that of row i, by which the squares of the row
    # are multiplied and those of the column divided: both norms are then equal. 1e-300: no division by zero
    # BALANCED sweeps over all rows
    for i in [*range(p)] * BALANCED:
        f = np.sqrt((a[:, i].sum(0) + 1e-300) / (a[i].sum(0) + 1e-300))
        a[i] *= f
        a[:, i] /= f
        d[i] *= np.sqrt(f)
    d = d.T
    return np.asarray(np.linalg.norm(d[:, :, np.newaxis] * M / d[:, np.newaxis], 2, axis=(-2, -1)))


def structured_value(M: ComplexArray) -> float:
    """Least upper bound of mu of one matrix M (p, p): the minimum over scalings d of the module's sigma_max."""
    from scipy.optimize import minimize  # here, since loading it takes half a second

    p = len(M)
    if p == 1:
        return float(abs(M[0, 0]))

    # only ratios of d count, so the last of the p numbers log d stays 0
    def scaled(x: Array) -> ComplexArray:
        d = np.exp(np.append(x, 0.0))
        return d[:, np.newaxis] * M / d

    def smooth(x: Array, power: float) -> tuple[float, Array]:
        """log of (sum sigma^power)^(1/power), sigma the singular values of diag(d) M diag(d)^-1 (`scaled`), at
        log d = (x, 0); its gradient (p - 1,) by x.

        A smooth bound of log sigma_max from above, closer the larger the power is.
        """
        U, sigma, V = np.linalg.svd(scaled(x))
        # V is already conjugated and transposed. d log sigma_k / d log d_i = |U_ik|^2 - |V_ki|^2
        weight = (sigma / sigma[0]) ** power
        slope = np.abs(U) ** 2 @ weight - (np.abs(V) ** 2).T @ weight
        value = np.log(sigma[0]) + np.log(weight.sum()) / power
        return float(value), slope[:-1] / weight.sum()

    # from a smooth norm to ones that are nearer to sigma_max, each from the minimum of the one before
    x = np.zeros(p - 1)
    # _SMOOTH: powers of these norms
    for power in _SMOOTH:
        x = minimize(smooth, x, args=(power,), jac=True, method="BFGS").x
    return float(np.linalg.norm(scaled(x), 2))


def disk_margin(S: ComplexArray) -> float:
    """alpha of the module for sensitivities S (F, p, p) at F frequencies: 1 / the largest mu(S - 1/2).

    Infinite where S - 1/2 is zero at all of them. mu is computed in the order of its fast upper bounds, until
    these are below the largest mu found.
    """
    M = S - 0.5 * np.eye(S.shape[1])
    # mu is at most the Frobenius norm and at least the spectral radius: so a matrix whose norm is below the
    # largest radius (of the TOP matrices of largest norm) cannot have the largest mu
    rough = np.linalg.norm(M, axis=(-2, -1))
    radius = np.max(np.abs(np.linalg.eigvals(M[np.argsort(-rough)[:TOP]])))
    M = M[rough >= (1.0 - 1e-9) * radius]  # 1e-9 for round-off
    bounds, largest = balanced_bound(M), 0.0
    for k in np.argsort(-bounds):
        if bounds[k] <= largest:
            break
        largest = max(largest, structured_value(M[k]))
    return 1.0 / largest if largest > 0.0 else np.inf
