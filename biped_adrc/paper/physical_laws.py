"""Laws of physics and orders of convergence by which every reproduction is checked.

None of them was used to derive the model or to choose the methods, so that each could fail:

    model      pinned and floating-base equations agree; an impact keeps the momenta that an inelastic contact
               has to keep and never adds kinetic energy
    walk       the swing foot is on the ground at located impacts; energy gained = work done
    gait       on a periodic gait, joint work of a step = energy lost at its impact
    numerics   the error (23) on one held joint; order of sampled against continuous control; order of ETD-RK4

    (23)        the paper's transfer function from the total disturbance xi [rad/s^2] of a joint to its tracking
                error [rad] under ADRC; as printed one term lacks a factor, so there is a corrected one
    ETD-RK4     the exponential method, which integrates a linear stiff part of the loop, the observer, exactly
    q, q'       coordinates and rates [rad, rad/s], the first p of them (q_b) with motors
    u, zeta     torques of the motors, and from outside [N m]
    NPD, ADRC   the controllers: PD with decoupling of the inertia; ADRC with the observer's poles of Table I
    preset      a set of masses and inertias of the robot RABBIT

Functions return numbers by name; their limits are in checks.toml.
"""

import math
from dataclasses import dataclass

import numpy as np

from biped_adrc.analysis.observer.loop import ObserverLoop
from biped_adrc.analysis.signals import integrate
from biped_adrc.closed_loop.walker import FOOT_STRIKE, Mode
from biped_adrc.control.adrc import ADRCController
from biped_adrc.control.base import Measurement
from biped_adrc.core.types import Array
from biped_adrc.engine.program import COMPILED
from biped_adrc.engine.run import simulate_by
from biped_adrc.gait.reference import TimeReference
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.hybrid.system import AnyMode, HybridSystem
from biped_adrc.model.biped import Biped
from biped_adrc.model.physical import largest_gaps
from biped_adrc.model.reduction import reduce
from biped_adrc.observers.gpi import TABLE_I, GPIObserver
from biped_adrc.paper.scenarios import pushed_steps, scenario
from biped_adrc.scenario.build import RobotAndGait, build
from biped_adrc.scenario.recording import Outcome, Walk
from biped_adrc.scenario.walk import walk_scenario


def model_laws(preset: str, samples: int = 200, seed: int = 1) -> dict[str, float]:
    """The largest relative violation [1] of each law of the model at `samples` random states, by name.

    seed: of the random states.
    """
    return largest_gaps(Biped.load("rabbit", preset), samples, seed)


def walk_laws(full: Walk) -> dict[str, float]:
    """Violations of two laws in a simulated walk, both 0 but for errors of integration.

    "height" [m]: largest |height of the swing foot| at the impacts that the simulator located. "energy" [J]:
    kinetic and potential energy gained, less the integral of u . q_b' + zeta . q', the power of motors and of
    the disturbance; over the first pushed step, or the first step where there is none.
    """
    b, o = full.walker.plant, full.outcome
    heights = [abs(float(b.swing_foot(x[: b.n])[1])) for x in o.x_minus]
    # single supports are counted from 1; a walk that ends before its push is judged in its first one
    pushed = min(pushed_steps(o.run), default=1)
    s = full.signals.of_step(pushed if pushed in full.signals.step else int(full.signals.step[0]))
    power = np.sum(s.u * s.v[:, : b.p], axis=1) + np.sum(s.zeta * s.v, axis=1)
    gained = s.kinetic[-1] + s.potential[-1] - s.kinetic[0] - s.potential[0]
    return {
        "height": float(np.max(heights or [math.inf])),  # infinite without an impact
        "energy": abs(integrate(s.t, power) - gained),
    }


def work_identity(o: Outcome) -> float:
    """|joint work of the last walking step - energy lost at its impact| over that energy [1]: zero for a
    periodic gait on level ground; infinite without an impact.
    """
    if not o.certificates:
        return math.inf
    last = o.certificates[-1]
    return abs(last.joint_work - last.energy_lost) / last.energy_lost


@dataclass(frozen=True)
class HeldJoint(HybridSystem):
    """One joint held at zero by ADRC under a sine disturbance: the linear loop whose error is the paper's (23).

    J q'' = u + J xi(t),   xi = sin(w t) [rad/s^2]
    """

    controller: ADRCController
    """ADRC with the reference 0."""
    w: float
    """Frequency of the disturbance [rad/s]."""
    J: float = 1.3
    """Inertia [kg m^2]."""

    def flow(self, t: float, x: Array, mode: AnyMode) -> Array:
        """x' (2 + observer states,) for x = (q [rad], q' [rad/s], states of the observer)."""
        q, v, s = x[:1], x[1:2], x[2:, np.newaxis]
        # measured at time t of single support 1; the model is the joint itself: mass matrix J, no force Omega
        m = Measurement(t, 1, t, q, v, reduce(np.array([[self.J]]), np.zeros(1), 1))
        u = self.controller.output(s, m)
        a = u / self.J + np.sin(self.w * t)
        return np.concatenate((v, a, self.controller.flow(s, m, u)[:, 0]))


HELD_STEP = 1e-3
"""Integration step of the held joint [s]."""


def held_joint(t_end: float = 2.0, h: float = HELD_STEP) -> tuple[float, float, float]:
    """Steady amplitude of the tracking error per unit of disturbance at 5 Hz [s^2]: simulated, by (23) of the
    paper corrected, and by (23) as printed.

    t_end, h [s]: duration and integration step. The observer's poles are those of Table I times 0.05: slow
    enough for the error to stand clear of round-off. The simulated amplitude is that of the sine which fits the
    last two periods best; the reference is 0, so the error is q.
    """
    observer = GPIObserver.from_poles([0.05 * pole for pole in TABLE_I])
    zero = np.zeros(1)  # q_d, q_d', q_d'' of the one joint
    controller = ADRCController(TimeReference(lambda t: (zero, zero, zero)), observer)
    frequency = 5.0  # of the disturbance [Hz]
    w = 2.0 * math.pi * frequency
    start = np.concatenate((np.zeros(2), observer.initial_state(zero, zero, zero)[:, 0]))
    # None: the system has one mode only
    run = simulate(HeldJoint(controller, w), start, None, RK4(h), t_end=t_end)
    t, e = run.arcs[0].t, run.arcs[0].x[:, 0]
    last = t >= t_end - 2.0 / frequency - 1e-9  # two periods; 1e-9 s for round-off of the times
    basis = np.column_stack((np.cos(w * t[last]), np.sin(w * t[last])))
    amplitude = float(np.linalg.norm(np.linalg.lstsq(basis, e[last], rcond=None)[0]))
    loop, at = ObserverLoop(observer), np.array([w])
    # the second argument of `tracking_error`: whether (23) is taken as printed
    corrected, printed = (float(abs(loop.tracking_error(at, p)[0])) for p in (False, True))
    return amplitude, corrected, printed


def sampling_order(preset: str, periods: tuple[float, ...] = (2e-3, 1e-3, 5e-4)) -> float:
    """Order k [1] in the sampling period T with which sampled control approaches continuous control.

    The differences of (q, q') before the first impact under NPD, for these periods [s], are fitted by C T^k; a
    zero-order hold has k near 1.
    """

    # (q, q') (10,) before the first impact, with integration step h [s] and sampling period [s]
    def end(h: float, period: float | None = None) -> Array:
        run = scenario("NPD", preset, hardware={"period": period}, run={"impacts": 1, "h": h})
        return walk_scenario(run).trajectory.before(FOOT_STRIKE)[-1][:10]

    exact = end(2.5e-4)  # no period: continuous control
    # the integration step is not longer than the period
    gaps = [float(np.linalg.norm(end(min(T, 5e-4), T) - exact)) for T in periods]
    # the slope of the straight line through the logarithms
    return float(np.polyfit(np.log(periods), np.log(gaps), 1)[0])


def exponential_order(preset: str, factor: float) -> tuple[float, float]:
    """Observed order [1] of ETD-RK4 when its integration step is halved from 0.25 to 0.125 ms, and the error of
    the angles with a step of 0.5 ms [rad].

    The errors are those of the state after 0.1 s of walking under ADRC, with the poles of Table I times
    `factor`, against a step of 1/32 ms. For the order, steps longer than 0.25 ms do not resolve the fast joints
    of a robot without the inertia of the motors' rotors.
    """
    poles = {"controller.observer.poles": tuple(factor * pole for pole in TABLE_I)}
    run = scenario("ADRC", preset, **poles)
    # `walked` is the gait, its start (q, q') after the impact of its orbit
    scene = RobotAndGait.of(run)
    walker = build(run, scene)
    x0 = walker.initial_state(*scene.walked.start(scene.biped))

    # (q, q') (10,) after 0.1 s with integration step h [s]; Mode(): single support 1, from t = 0 on
    def end(h: float) -> Array:
        return simulate_by(COMPILED, walker, x0, Mode(), Exponential(h), t_end=0.1).final_state[:10]

    exact = end(3.125e-5)
    coarse, fine = (float(np.max(np.abs(end(h) - exact))) for h in (2.5e-4, 1.25e-4))
    error = float(np.max(np.abs(end(5e-4) - exact)[:5]))  # of q1 to q5
    return math.log2(coarse / fine), error  # halving the step divides the error by 2^order


def numerics_laws(preset: str) -> dict[str, float]:
    """Numbers for the accuracy of the methods, by name: the held joint [s^2], orders [1], and an error [rad].

    checks.toml and `paper.values` take them by their place, so their order counts.
    """
    # of the run at half the integration step the simulated amplitude alone
    (simulated, corrected, printed), (half, *_) = held_joint(), held_joint(h=0.5 * HELD_STEP)
    # exponential_order: (order, error) for the poles of Table I times a factor
    etd_table, error = exponential_order(preset, 1.0)
    return {
        "tracking error per unit disturbance on a held joint, simulated [s^2]": simulated,
        "the same at half the step [s^2]": half,
        "the same by (23) corrected [s^2]": corrected,
        "the same by (23) as printed [s^2]": printed,
        "order of continuous against sampled control in the period": sampling_order(preset),
        "order of the exponential method, Table I times 0.05": exponential_order(preset, 0.05)[0],
        "order of the exponential method with Table I, whose poles these steps do not resolve": etd_table,
        "error of the exponential method with Table I at 0.5 ms over 0.1 s [rad]": error,
    }
