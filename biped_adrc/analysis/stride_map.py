"""The walk on rough ground as a map of one number from step to step, exact while the joints keep their curve.

`ReferenceReset` bends the curve to the state after each impact, so that the tracking error stays zero. Then one
number says how the walk goes on: y = sigma^2 / 2 at the phase s_e where the bend ends, in the middle of the
step; sigma is the angular momentum about the stance foot. In continuous time, with a perfect inner loop,

    y+ = delta^2(h) (y - V_2(h)) - V_1(h)

    s        phase (Theta - Theta+) / (Theta- - Theta+) [1]
    h        height of the next foothold above the stance foot [m]
    I        sigma / s' = D_N dq/ds [kg m^2], with D_N the row of q_N of D
    V        int (G_N - F dx_hip/dq_N) I ds [kg^2 m^4/s^2]: sigma^2 / 2 + V is constant in a single support
    V_2      V from s_e to the landing
    V_1      V from the start of the next step to its s_e, on the bent curve
    delta    sigma+ / sigma- of the impact

The impact is linear in the rates, so neither delta nor the bend depends on y: the map is affine in y. A
horizontal force F [N] held on the hip is a potential -F x_hip. The map is that of the plant, on the curve that
the controller tracks; a wrong model of the controller acts through the tracking error alone, which counts as 0.

A force or torque on a curve is A + B s'^2, and s'^2 = 2 (y_0 - V) / I^2 with y_0 = sigma^2 / 2 where V is 0. So
a limit A + B s'^2 > 0 is a bound of y_0, from below for B > 0 and from above for B < 0:

    V - A I^2 / (2 B)

The strictest one of all phases counts, with y_0 = y up to the landing and y_0 = delta^2 (y - V_2) after it.
Forces are those at an instant, so the limits are stricter than in `feasibility`, which takes means over 5 ms.

D and Omega are those of `model.planar_robot`, on arrays of phases. With e = exp(i a), E_ij = exp(i (a_j - a_i))
they are D_a = Re(W o E), Omega_a = -Im(W o E) (a')^2 + g Re(w o e). Points and forces (x, z) are x + i z.
"""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import cumulative_simpson
from scipy.interpolate import CubicSpline

from biped_adrc.control.reference_reset import LEAST_REACH, reset_coefficients
from biped_adrc.core.shown import Shown
from biped_adrc.core.types import Array, ComplexArray
from biped_adrc.gait.constraint import VirtualConstraint, past_end
from biped_adrc.gait.design.rough import HIGHEST
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import ENDS, KnownLimits
from biped_adrc.model.planar_robot import robot_of

SIDE = 100
"""Number of heights to either side of 0."""
PHASES, NEAR, LATEST = 241, 1.05, 1.5
"""Number of phases of a part of a step; s [1] up to which they are dense past Theta-, and the last s."""
FAR = 1e12
"""A bound of y, or a margin, in place of an infinite one."""


class Poses(NamedTuple):
    """Configurations on a curve at phases s (...,)."""

    q: Array
    """q (..., n) [rad]."""
    dq: Array
    """dq/ds (..., n) [rad]."""
    ddq: Array
    """d2q/ds2 (..., n) [rad]."""


def curve(h: VirtualConstraint, s: Array) -> tuple[Array, ...]:
    """h, dh/ds and d2h/ds2, each (..., p) [rad], at phases s (...,): `VirtualConstraint.h` on arrays."""
    inside = s if h.fade is None else np.clip(s, 0.0, 1.0)
    a = h.curve.stacked[np.searchsorted(h.curve.breaks, inside, side="right")]
    powers = inside[..., np.newaxis] ** h.curve.powers
    rows = np.split(np.einsum("...ik,...k->...i", a, powers), 3, axis=-1)
    beyond: Any = (s - inside)[..., np.newaxis]
    return tuple(rows) if h.fade is None else past_end(beyond, h.fade, *rows)


def poses_on(h: VirtualConstraint, s: Array, bend: Array | None = None, end: float = 1.0) -> Poses:
    """Configurations at phases s (...,): q_b = h + x^3 (a_0 + a_1 x), x = 1 - s / end before the end, else 0.

    bend (2, M, p) [rad]: a_0, a_1 of M curves, for s (M, K); None for none. q_N follows from Theta = c q.
    """
    rows, span = curve(h, s), h.theta_minus - h.theta_plus
    if bend is not None:
        x, (a_0, a_1) = np.maximum(1.0 - s / end, 0.0)[..., np.newaxis], bend[:, :, np.newaxis]
        c = x**3 * (a_0 + a_1 * x)
        dc, ddc = -(x**2) * (3.0 * a_0 + 4.0 * a_1 * x) / end, x * (6.0 * a_0 + 12.0 * a_1 * x)
        rows = rows[0] + c, rows[1] + dc, rows[2] + ddc / end**2
    theta = h.theta_plus + span * s, np.full(s.shape, span), np.zeros(s.shape)
    q_N = ((t - x @ h.phase[:-1]) / h.phase[-1] for t, x in zip(theta, rows, strict=True))
    pairs = zip(rows, q_N, strict=True)
    return Poses(*(np.concatenate((x, y[..., np.newaxis]), axis=-1) for x, y in pairs))


def swing_foot(biped: Biped, at: Poses) -> tuple[ComplexArray, ComplexArray]:
    """Place x + i z of the swing foot from the stance foot, and its derivative by s, each (...,) [m]."""
    robot = robot_of(biped)
    d = (robot.K.foot_re + 1j * robot.K.foot_im) * np.exp(1j * at.q @ robot.A.T)
    return d.sum(axis=-1), 1j * (d * (at.dq @ robot.A.T)).sum(axis=-1)


@dataclass(frozen=True)
class Path(Shown):
    """The plant at K phases s of one or of M curves; torques and forces have A, B of A + B s'^2 at the end."""

    s: Array
    """Phases (..., K) [1], increasing."""
    at: Poses
    """Configurations, (..., K, n)."""
    foot: ComplexArray
    """Place x + i z of the swing foot from the stance foot (..., K) [m]."""
    inertia: Array
    """I (..., K) [kg m^2]."""
    potential: Array
    """V (..., K) [kg^2 m^4/s^2], 0 at the first phase."""
    torque: Array
    """Torques (..., K, p, 2) [N m]."""
    reaction: ComplexArray
    """Force F_T + i F_N of the ground (..., K, 2) [N]."""

    @classmethod
    def of(cls, biped: Biped, s: Array, at: Poses, force: float = 0.0) -> "Path":
        """Evaluate the plant `biped` at the phases s (..., K), with the force F [N] held on its hip."""
        robot, p, i = robot_of(biped), biped.p, np.arange(biped.n)
        K, A, (q, dq, ddq) = robot.K, robot.A, at
        e, rate = np.exp(1j * q @ A.T), dq @ A.T
        w = (K.w_re + 1j * K.w_im) * e
        E = np.conj(e)[..., :, np.newaxis] * e[..., np.newaxis, :]
        WE = (K.W_re + 1j * K.W_im) * E
        turning = -np.einsum("...ij,...j->...i", WE.imag, rate**2) @ A
        WE[..., i, i] = K.inertia
        D = A.T @ WE.real @ A + np.diag(K.rotor)
        # gravity, less the generalised force of F: dx_hip/da = -Im(d_hip o e)
        G = (K.gravity * w.real + force * ((K.hip_re + 1j * K.hip_im) * e).imag) @ A
        inertia = np.einsum("...j,...j->...", D[..., -1, :], dq)
        # q'' = A + B s'^2: the row of q_N, without a motor, gives s''
        curved = np.einsum("...j,...j->...", D[..., -1, :], ddq) + turning[..., -1]
        bent = ddq - dq * (curved / inertia)[..., np.newaxis]
        a = np.stack((-dq * (G[..., -1] / inertia)[..., np.newaxis], bent), axis=-1)
        u = (D @ a + np.stack((G, turning), axis=-1))[..., :p, :]
        # m p_com'' = i w a'' - w (a')^2; the ground carries the weight and holds against F
        still = np.full(inertia.shape, 1j * K.mass * K.gravity - force)
        rest = np.stack((still, -np.sum(w * rate**2, axis=-1)), axis=-1)
        reaction = np.einsum("...i,...ij->...j", 1j * w, A @ a) + rest
        V = cumulative_simpson(G[..., -1] * inertia, x=s, initial=0.0)
        return cls(s, at, swing_foot(biped, at)[0], inertia, V, u, reaction)

    def limits(self, k: KnownLimits, fastest: Array) -> dict[str, Array]:
        """The limits A + B s'^2 > 0 (..., K, number, 2) by name; fastest (p,) [rad/s]: rates of the joints."""
        F_T, F_N, u = self.reaction.real, self.reaction.imag, self.torque
        rate, one = self.at.dq[..., : len(fastest)] ** 2, np.array([1.0, 0.0])
        return {
            "stall": np.broadcast_to([0.0, 1.0], (*self.s.shape, 1, 2)),
            "normal force": F_N[..., np.newaxis, :],
            "friction": np.stack((k.friction * F_N - F_T, k.friction * F_N + F_T), axis=-2),
            "torque": np.concatenate((k.torque * one - u, k.torque * one + u), axis=-2),
            "rate": np.stack((np.broadcast_to(fastest**2, rate.shape), -rate), axis=-1),
        }

    def bounds(self, limit: Array) -> tuple[Array, Array]:
        """Bounds of y_0 from below and above, up to each phase (..., K), by a limit (..., K, number, 2)."""
        A, B, V = limit[..., 0], limit[..., 1], self.potential[..., np.newaxis]
        I2 = self.inertia[..., np.newaxis] ** 2
        edge = np.clip(V - 0.5 * A * I2 / np.where(B == 0.0, 1.0, B), -FAR, FAR)
        low = np.where(B > 0.0, edge, np.where((B == 0.0) & (A <= 0.0), FAR, -FAR))
        low, high = np.max(low, axis=-1), np.min(np.where(B < 0.0, edge, FAR), axis=-1)
        return np.maximum.accumulate(low, axis=-1), np.minimum.accumulate(high, axis=-1)


class Clearance(NamedTuple):
    """Room of the swing foot over the lines between footholds, for a step that begins or ends with each h."""

    own: Array
    """Least height (M,) [m] above the line to the foothold h before it, and back to the last one after it."""
    rise: Array
    """Slope (M,) of the line to the foothold h."""
    ahead: Array
    """Largest slope (M,) of a line ahead that the foot clears in the first half of the step after h."""
    fall: Array
    """Slope (M,) of the line back to the last foothold, after h."""
    behind: float
    """Least slope of a line back that the foot clears in the second half of a step."""


@dataclass(frozen=True)
class StrideMap(Shown):
    """The map y+ = delta^2(h) (y - V_2(h)) - V_1(h) at M heights h. Make it by `of`."""

    heights: Array
    """h (M,) [m], increasing."""
    delta2: Array
    """delta^2 (M,) [1]."""
    V_2: Array
    """V from the middle of the step to the landing (M,) [kg^2 m^4/s^2]."""
    V_1: Array
    """V from the start to the middle of the next step (M,) [kg^2 m^4/s^2]."""
    impulse: Array
    """|F_T| / F_N of the impulse (M,) [1]; infinite where the ground would have to pull."""
    landing: Array
    """Phase s of the landing (M,) [1]."""
    second: Path
    """The second half of a step, and the curve past all landings (K,)."""
    first: Path
    """The first half of the step after each height (M, K)."""

    @classmethod
    def of(
        cls,
        biped: Biped,
        h: VirtualConstraint,
        share: float,
        force: float = 0.0,
        heights: Array | None = None,
    ) -> "StrideMap":
        """The map of the plant `biped` on the curve h, which is bent until the share [1] of its range.

        force [N]: F. heights [m]: those to take, with 0; None for the usual ones. Of these the map has the
        unbroken row around 0 of those on which the foot lands so that ReferenceReset bends the next step.
        """
        if heights is None:
            heights = HIGHEST * robot_of(biped).leg * np.arange(-SIDE, SIDE + 1) / SIDE
        # dense just past the end, where the curvature of a continued curve fades out
        parts = (share, 1.0), (1.0, NEAR), (NEAR, LATEST)
        s = np.unique(np.concatenate([np.linspace(*ends, PHASES) for ends in parts]))
        second = Path.of(biped, s, poses_on(h, s), force)
        landing = landings(biped, h, second, heights)
        lands = np.isfinite(landing)
        heights, landing = heights[lands], landing[lands]
        at, p = poses_on(h, landing), biped.p
        impacts = [biped.impact(q, v) for q, v in zip(at.q, at.dq, strict=True)]
        widths = enumerate((biped.n, biped.n, 2))
        q, v, F = (np.reshape([x[i] for x in impacts], (-1, width)) for i, width in widths)
        before = [biped.angular_momentum(q, v) for q, v in zip(at.q, at.dq, strict=True)]
        delta = np.array([biped.angular_momentum(x.q, x.v) for x in impacts]) / before
        # phase after the impact and its rate; the bend takes away the error there and its slope
        s, rate = h.rate * (q @ h.phase - h.theta_plus), h.rate * (v @ h.phase)
        x, (h_0, dh, _) = 1.0 - s / share, curve(h, s)
        error, slope = q[:, :p] - h_0, v[:, :p] / rate[:, np.newaxis] - dh
        bend = reset_coefficients(x[:, np.newaxis], -1.0 / share, error, slope).reshape(2, -1, p)
        # LEAST_REACH: nearer to its end nothing is bent
        fine = (x >= LEAST_REACH) & (rate > 0.0) & (delta > 0.0)
        kept = around_zero(heights, fine)
        s = s[kept, np.newaxis] + np.outer(share - s[kept], np.linspace(0.0, 1.0, PHASES))
        first = Path.of(biped, s, poses_on(h, s, bend[:, kept], share), force)
        ratio = np.where(F[:, 1] > 0.0, np.abs(F[:, 0]) / F[:, 1], np.inf)
        V_2 = CubicSpline(second.s, second.potential)(landing)
        V_1, d2 = first.potential[:, -1], delta[kept] ** 2
        one = heights[kept], d2, V_2[kept], V_1, ratio[kept], landing[kept]
        return cls(*one, second, first)

    @property
    def level(self) -> int:
        """Index of the height 0."""
        return int(np.argmin(np.abs(self.heights)))

    @property
    def steady(self) -> Array:
        """Fixed points y*(h) (M,) [kg^2 m^4/s^2]: of ground that changes by h each step; infinite for none."""
        d2 = self.delta2
        with np.errstate(divide="ignore"):
            y = -(d2 * self.V_2 + self.V_1) / (1.0 - d2)
        return np.where(d2 < 1.0, y, np.inf)

    def intervals(self, k: KnownLimits, plant: Biped) -> dict[str, tuple[Array, Array]]:
        """Bounds of y from below and above, each (M,), by the limits of the step over each height, by name."""
        # the legs exchange their names from step to step: a coordinate has the slower of two joints
        fastest = np.min([[j.speed for j in side] for side in plant.motor_joints], axis=0)
        first, second = self.first, self.second
        after, result = first.limits(k, fastest), {}
        for name, limit in second.limits(k, fastest).items():
            low, high = (np.interp(self.landing, second.s, y) for y in second.bounds(limit))
            # delta^2 (y - V_2) is y_0 after the landing
            low_0, high_0 = (y[:, -1] / self.delta2 + self.V_2 for y in first.bounds(after[name]))
            result[name] = np.maximum(low, low_0), np.minimum(high, high_0)
        return result

    def clearance(self) -> Clearance:
        """Room of the swing foot over level pads joined by straight lines, but in the first and last 3 % (ENDS)
        of the time.

        The time is that at a constant sigma, dt ~ I ds. With the sigma of the walk, which is larger at the ends
        of a step than in its middle, the foot may touch longer.
        """
        h, one, two = self.heights, self.first, self.second
        x_1, z_1, x_2, z_2 = one.foot.real, one.foot.imag, two.foot.real, two.foot.imag
        t_1, t_2 = (
            cumulative_simpson(np.abs(path.inertia), x=path.s, initial=0.0) for path in (one, two)
        )
        begin, end = t_1[:, -1], np.interp(self.landing, two.s, t_2)
        late = t_1 > (ENDS * (begin + end[self.level]))[:, np.newaxis]
        early = t_2 < (end - ENDS * (end + begin[self.level]))[:, np.newaxis]
        rise, fall = h / np.interp(self.landing, two.s, x_2), z_1[:, 0] / x_1[:, 0]
        room_1, room_2 = z_1 - np.outer(fall, np.ones(PHASES)) * x_1, z_2 - np.outer(rise, x_2)

        def least(where: Any, room: Array) -> Array:
            return np.min(np.where(where, room, FAR), axis=-1)

        own = np.minimum(least(late & (x_1 < 0.0), room_1), least(early & (x_2 > 0.0), room_2))
        ahead, behind = least(late & (x_1 > 0.0), z_1 / x_1), least(x_2 < 0.0, -z_2 / x_2)
        return Clearance(own, rise, ahead, fall, -float(behind))


def around_zero(heights: Array, fine: Array) -> slice:
    """The unbroken row of fine heights (M,) around 0; empty where 0 is not fine or not there."""
    level = np.flatnonzero(heights == 0.0)
    if not np.any(fine[level]):
        return slice(0, 0)
    not_fine = np.flatnonzero(np.logical_not(fine))
    below, above = not_fine[not_fine < level[0]], not_fine[not_fine > level[0]]
    return slice(max(below, default=-1) + 1, min(above, default=len(heights)))


def landings(biped: Biped, h: VirtualConstraint, second: Path, heights: Array) -> Array:
    """Phase s (M,) at which the swing foot comes down to each height (M,) [m], from its apex on; else NaN."""
    z = second.foot.imag
    top = int(np.argmax(z[second.s <= 1.0]))
    rises = np.flatnonzero(np.diff(z[top:]) >= 0.0)
    # the foot falls until it rises again, or I changes its sign and Theta is no phase any more
    turns = np.flatnonzero(second.inertia * second.inertia[0] <= 0.0)
    fall = slice(top, min([*(top + rises[:1] + 1), *turns[:1], len(z)]))
    s = np.interp(-heights, -z[fall], second.s[fall], left=np.nan, right=np.nan)
    for _ in range(4):  # Newton's method, from an interpolation
        place, slope = swing_foot(biped, poses_on(h, s))
        s = s - (place.imag - heights) / slope.imag
    ahead = swing_foot(biped, poses_on(h, s))[0].real > 0.0
    return np.where((s > second.s[0]) & ahead, s, np.nan)
