"""The walker: plant, controller, disturbance and timing as one hybrid system.

A single support is a flow; it ends at the impact of the swing foot, which maps the state by (7), (8) of the
paper and begins the next single support. This module holds what is particular to walking: the ground (slope,
steps up and down), the disturbance, and the event functions that end a single support or the run. The flow, the
sample instants and the impact are those of `closed_loop.semantics`.

    x (nx,)           state: q (n,) [rad], q' = v [rad/s], the controller's state; in sampled time also what
                      sensors and motors hold between sample instants
    q_b, u (p,)       the first p coordinates, those with motors, and their torques [N m]
    zeta (n,)         disturbance, a generalised force [N m]
    kappa (p, p)      input gain of the controller's model [1/(kg m^2)]
    -, +              just before and just after an impact
    mode              the single support: its number from 1 (step), and the time [s] at which it began (start)

The exponential method (`hybrid.exponential`) integrates a linear stiff part exactly. For it a walker has
coordinates x -> (w, E) in which what is stiff is linear:

    E' = A E + N_E,   w' = N_w          E (k, p): one column per actuated joint

An observer with poles far to the left makes x' = f(x) stiff: an explicit method would need steps far below
1 ms. In these coordinates the stiff part is the constant matrix A (k, k), k being the number of observer states
per joint; the remainder N is slow. e = S (q_b, q_b') - Z is the observer's error. Z (k, p) is the observer's
state; S (q_b, q_b') (k, p) has q_b in row 0, scale q_b' in row 1, and zeros below; `scale` [s] is the factor of
velocities in Z:

    w = (q, q', rest),   E = e,   N_E = scale xi_total in row 1,   xi_total = q_b'' - kappa u

N_E is zero in all other rows. xi_total (p,) [rad/s^2], the total disturbance, does not depend on u itself;
torque limits, a wrong model and forces from outside are in it. `rest` is what follows the observer in the
controller's state. `Walker.split` hands these coordinates to the method of integration in Python;
`engine.equations` makes machine code of them for the compiled one. `hybrid.simulator` runs a Walker in Python;
`engine` compiles the same Walker. `scenario.build` makes one from plain values.
"""

import math
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from biped_adrc.closed_loop import semantics
from biped_adrc.closed_loop.protocols import Loop
from biped_adrc.closed_loop.protocols import Mode as Mode
from biped_adrc.closed_loop.semantics import Instant as Instant
from biped_adrc.closed_loop.system import ClosedLoop
from biped_adrc.core.errors import InputError
from biped_adrc.core.timing import check_ends
from biped_adrc.core.tree import flatten
from biped_adrc.core.types import Array, read_only
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.system import Guard, Split
from biped_adrc.model.biped import Biped
from biped_adrc.model.ground import GroundSteps, Slope, Stones, drop_of


@dataclass(frozen=True)
class ErrorForm:
    """The change of coordinates x -> (w, E) of the exponential method, for a robot under a controller whose
    state begins with that of a linear observer, order * p numbers."""

    n: int
    """Number of coordinates."""
    p: int
    """Number of actuated joints."""
    order: int
    """Number of observer states per joint, k."""
    scale: float
    """Factor of velocities in the observer's scaled states [s]."""
    A: Array
    """Linear part (k, k) [1/s], the same for every joint; k = order."""

    def to(self, x: Array) -> tuple[Array, Array]:
        """w (2 n + rest,) and E (order, p) of x (nx,): the error E replaces the observer's state Z in x."""
        # z: the rows of Z one after the other. E = (q_b, scale q_b', 0, ..) - Z, row by row
        n, p, end = self.n, self.p, 2 * self.n + self.order * self.p
        z = x[2 * n : end]
        e = np.concatenate((x[:p] - z[:p], self.scale * x[n : n + p] - z[p : 2 * p], -z[2 * p :]))
        return np.concatenate((x[: 2 * n], x[end:])), e.reshape(self.order, p)

    def back(self, w: Array, E: Array) -> Array:
        """x (nx,) of w (2 n + rest,) and E (order, p), the inverse of `to`; both are linear."""
        n, p = self.n, self.p
        z = (w[:p] - E[0], self.scale * w[n : n + p] - E[1], -E[2:].ravel())
        return np.concatenate((w[: 2 * n], *z, w[2 * n :]))


def remainder(
    loop: Loop, form: ErrorForm, t: float, w: Array, E: Array, mode: Mode
) -> tuple[Array, Array]:
    """The remainder of the closed loop at t [s], w (2 n + rest,), E (k, p): N_w, of the size of w, and row 1 of
    N_E (p,), its only row that is not zero. Raises RanAwayError for a torque beyond all bounds (`bounded`)."""
    # i: controller's state s, measurement, torque u and q'' = a
    i = semantics.instant(loop, t, form.back(w, E), mode)
    s, u = flatten(i.s), loop.bounded(i.u)
    # s' is used only for `rest`; without one the slice of `ds` below is empty, and s saves the computation
    ds = flatten(loop.calls.flow(i.s, i.measurement, u)) if len(s) > form.order * form.p else s
    xi_total = i.a[: form.p] - i.measurement.terms.kappa @ i.u
    dw = np.concatenate((w[form.n : 2 * form.n], i.a, ds[form.order * form.p :]))
    return dw, form.scale * xi_total


FOOT_STRIKE = "foot_strike"
"""Name of the event function, clearance of the swing foot, whose zero is the impact."""
LEAST_STEP = 1e-3
"""Minimum step length [m]; shorter contacts are ignored: legs without knees scuff the ground in mid-swing."""
ON_GROUND = 1e-9
"""Largest depth of a foot below the ground that counts as round-off of a touchdown [m]."""


@dataclass(frozen=True)
class Walker(ClosedLoop[Biped]):
    """A planar biped under a controller on a plane with steps, as a hybrid system.

    - plant: the robot that moves. model: the robot as the controller knows it; None: the plant itself.
    - controller: the law of the torques u (p,) [N m].
    - timing: when the controller acts, in `ContinuousTime()` or in `SampledTime(period)`.
    - disturbance: zeta (n,) [N m] and forces from outside; None: nothing disturbs.
    - torque_limit [N m]: saturates every motor; the observer is fed the torque applied, not the one asked for.
    - sensors: what the controller measures; motors: how torques follow. Sampled time only; None: exactly.
    - touchdown: the detector by which the controller notices one, in sampled time with restart=False; None: at
      once.
    - runaway_speed [1], runaway_torque [1]: the run ends as run away beyond so many times 50 rad/s, or the peak
      torque of the robot's record; infinite for no end. A joint that turns by more than a whole turn ends it,
      too.
    - fall_height [1]: the run ends as a fall when the hip is below this fraction of |p_hip| at q = 0.
    - max_step_time [s]: a longer single support ends as stalled.
    - slope [rad]: of the ground, positive downhill; None: that of the gait that `walk` gets, else level.
    - ground_steps: where the ground falls or rises, as `StepDown` and `StepUp`.
    - impact_gain (n,) [1]: v+ = (1 + gain) v+ of (7), an error of the impact model; empty for none.
    - stones: where feet may land; a finished walk is judged by them (`analysis.certificate`), and a controller
      gets them apart from here, as an argument of its own.

    Raises InputError for values that do not fit together, such as sensors in continuous time.

    >>> walker = ba.Walker(biped, ba.NPDController(gait.constraint), timing=ba.SampledTime(1e-3))
    >>> ba.walk(walker, gait, impacts=2).trajectory.status.name
    'COMPLETED'
    """

    SUCH_AS = "Walker(biped, controller); a Scenario walks with walk_scenario"  # for error messages

    plant: Biped
    model: Biped | None = None
    fall_height: float = 0.35
    max_step_time: float = 2.0
    slope: Slope | None = None
    ground_steps: GroundSteps = ()
    impact_gain: tuple[float, ...] = ()
    stones: Stones | None = None

    def __post_init__(self) -> None:
        """Raise InputError for values that do not fit together; see the class."""
        super().__post_init__()
        if self.disturbance is not None:
            self.disturbance.check_size(self.plant.n)
        check_ends(self.max_step_time, self.fall_height, self.runaway_speed, self.runaway_torque)
        # above -1, so that (1 + gain) v+ keeps the sign of each rate
        gain, n = self.impact_gain, self.plant.n
        if gain and not (len(gain) == n and all(math.isfinite(e) and e > -1.0 for e in gain)):
            raise InputError(f"impact gain {gain}, expected {n} finite numbers above -1, or none")

    # -- parts -------------------------------------------------------------------------------------
    def check_foot(self, q: Array, v: Array, mode: Mode) -> None:
        """Raise InputError for a start q (n,) [rad], v (n,) [rad/s] in the single support `mode` whose
        touchdown is past: the swing foot is below the ground and comes down, ahead of the hip. A foot that is
        not yet ahead may begin below the ground, as one of a leg without knees does in the middle of a walking
        step."""
        depth = -self.clearance(q, mode.step)
        if depth <= ON_GROUND:
            return
        # clearance is z + x tan(slope) + const., so `along` . (x', z') is its rate
        x, along = self.plant.swing_foot(q)[0], np.array([math.tan(self.ground_slope), 1.0])
        falls = self.plant.swing_foot_velocity(q, v) @ along < 0.0
        if falls and x > max(LEAST_STEP, self.plant.hip(q)[0]):
            # the two feet swing in turn, the second one first
            foot = self.plant.description.feet[mode.step % 2]
            raise InputError(
                f"the start has the swing foot '{foot}' {1e3 * depth:.3g} mm below the ground and coming down, "
                f"{x:.3g} m ahead of the stance foot, so its touchdown is past; expected it above the ground: "
                "lift it, or start after the impact, as gait.start(biped) does"
            )

    def check_state(self, t: float, x: Array) -> None:
        """Raise RanAwayError for x (nx,) at t [s] with an angle or a rate beyond the bounds."""
        self.bounds.check(t, x[: self.plant.n], x[self.plant.n : 2 * self.plant.n])

    @property
    def ground_slope(self) -> float:
        """Slope of the ground [rad], positive downhill; 0 for slope=None."""
        return 0.0 if self.slope is None else self.slope

    @cached_property
    def gain(self) -> Array:
        """Relative errors of the impact model in v+ (n,) [1]; empty (0,) for none."""
        return read_only(self.impact_gain)

    # -- from outside ------------------------------------------------------------------------------
    def ground_reaction(self, i: Instant, mode: Mode) -> Array:
        """Force of the ground on the stance foot, tangential and normal (F_T, F_N) (2,) [N], at the instant i.
        By Newton's law it is m (p_com'' - g), which the plant computes from the motion, less the resultant
        force from outside."""
        m = i.measurement
        return self.plant.ground_reaction(m.q, m.v, i.a) - self.resultant(m.t, mode)

    # -- impact and ground -------------------------------------------------------------------------
    def strike(self, t: float, x: Array, mode: Mode) -> tuple[Array, Mode] | None:
        """x+ (nx,) after the impact at t [s], x (nx,) being x-, with the mode that begins. None where the swing
        foot is not more than LEAST_STEP, 1 mm, ahead of the stance foot: its touch of the ground is then
        ignored, as a leg without knees scuffs the ground in mid-swing."""
        if self.plant.swing_foot(x[: self.plant.n])[0] <= LEAST_STEP:
            return None
        return self.impact(t, x, mode)

    def impact(self, t: float, x: Array, mode: Mode) -> tuple[Array, Mode]:
        """x+ (nx,) after impact, relabelling and the controller's jump at t [s], wherever the swing foot is,
        and the mode that begins."""
        after = Mode(mode.step + 1, t)
        return semantics.strike(self, t, x, after, self.gain), after

    def drop(self, step: int) -> float:
        """How much lower [m] than the plane through the stance foot the ground is where single support `step`
        ends, by the steps of the ground; below 0 for a step up."""
        return drop_of(self.ground_steps, step)

    def clearance(self, q: Array, step: int | None = None) -> float:
        """Height of the swing foot above the ground [m] along the vertical, at q (n,) [rad]. With `step`, the
        number of a single support, above the ground where that one ends; without, above the plane through the
        stance foot."""
        drop = 0.0 if step is None else self.drop(step)
        fall = math.tan(self.ground_slope)
        return float(semantics.clearance(fall, drop, self.plant.swing_foot(q)))

    @cached_property
    def lowest_hip(self) -> float:
        """Height of the hip [m] above the stance foot below which the run ends as a fall."""
        straight = np.zeros(self.plant.n)
        return self.fall_height * float(np.linalg.norm(self.plant.hip(straight)))

    def guards(self, mode: Mode) -> tuple[Guard, ...]:
        """Three event functions of the single support `mode`: clearance of the swing foot [m], at whose zero
        the impact is; height of the hip over its limit [m], at whose zero the run ends as FELL; time left [s],
        at whose zero it ends as STALLED. Only a zero where the function falls counts."""
        n = self.plant.n

        def clearance(t: float, x: Array) -> float:
            return self.clearance(x[:n], mode.step)

        def hip(t: float, x: Array) -> float:
            return float(semantics.hip_margin(self.lowest_hip, self.plant.hip(x[:n])))

        def left(t: float, x: Array) -> float:
            return float(semantics.time_left(self.max_step_time, mode.start, t))

        # each with its name, its function of (t, x), and what follows: a state after it, or the end of the run
        strike = Guard(FOOT_STRIKE, clearance, partial(self.strike, mode=mode))
        low = Guard("hip_too_low", hip, terminal=Status.FELL)
        return strike, low, Guard("step_too_long", left, terminal=Status.STALLED)

    def split_form(self) -> ErrorForm | None:
        """The change of coordinates for the exponential method; None in sampled time or without a linear
        observer."""
        error = None if self.sampled else self.law.error_system()
        if error is None:
            return None
        scale = float(error.velocity_scale)
        return ErrorForm(self.plant.n, self.plant.p, len(error.A), scale, error.A)

    def split(self, mode: Mode) -> Split | None:
        """The coordinates of the exponential method, x -> (w, E), with A and the remainder of the closed loop
        in `mode`; None in sampled time or without a linear observer."""
        if (form := self.split_form()) is None:
            return None

        # N_E with all its rows, of which `remainder` computes row 1 alone
        def on_all_rows(t: float, w: Array, E: Array) -> tuple[Array, Array]:
            N_w, forced = remainder(self, form, t, w, E, mode)
            N_E = np.zeros((len(form.A), form.p))
            N_E[1] = forced
            return N_w, N_E

        return Split(form.to, form.back, form.A, on_all_rows)
