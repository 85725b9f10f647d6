"""The closed loop, written once: flow, sample instant, impact, and the quantities read at one instant.

    q'' = f(q, q') + D_s^-1 (B_s u + zeta)        between impacts   (10) of the paper
    (q, q')+ = R Delta(q-, q'-)                   at an impact      (10)

Symbols (shapes and units in brackets):

    q, v = q'       coordinates (n,) [rad] and rates (n,) [rad/s]; - and + mean just before and after an impact
    q_b             the first p coordinates, those of the joints with motors
    u, B_s          torques of the motors (p,) [N m]; (n, p), the identity over zeros: u acts on q_b
    zeta, xi~       disturbance, and what the nominal model does not know: generalised forces (n,) [N m]
    D_s, Omega      mass matrix (n, n) [kg m^2]; Coriolis and gravity terms (n,) [N m]; f = -D_s^-1 Omega
    kappa, xi       q_b'' = kappa u + xi: input gain (p, p) [1/(kg m^2)], total disturbance (p,) [rad/s^2]
    Delta           impact map, (7) and (8) of the paper, before the legs exchange their names
    R, r            relabelling, which exchanges the legs: q becomes R q + r, q' becomes R q'
    m               the measurement that the controller gets, with the nominal model's terms at (q, q')
    k               `loop.held`: parameters of sensors, motors and touchdown detector; None in continuous time
    mode            the single support: its number from 1 (step), and the time [s] at which it began (start)

A tick is a sample instant. A jump of the controller is its own reset of its state at an impact. The
controller's terms come from the nominal model, the motion from the plant, and the two may differ.

State: x = (q, q', s) in continuous time and x = (q, q', s, tail) in sampled time. s is the state of the
controller (observer included). tail = (own, belief b, sensors w, line) is held between sample instants:

    own     numbers that a plant with an integration of its own, such as MuJoCo, keeps for itself
    b       what a controller that detects touchdowns itself believes of its single support, see below; or None
    w       state of the sensors, such as the angles of the last tick
    line    torques on their way: those sent that wait for a delay to end, and those that act

The tail changes at sample instants and impacts only, with two exceptions: torques of lagging motors flow, and
after a delay of a fraction of a period the commanded torque changes in between.

A walker with a part of `hardware.touchdown` detects touchdowns itself (function `noticed`). Its belief has four
parts, b = (other, step, start, d). other is 1 while the controller's names of the legs differ from the plant's,
else 0; step is the single support that the controller believes in, start the time [s] at which it detected its
beginning, d the memory of the detector.

    true touchdown    other <- 1 - other, and d may change; controller, sensors and motors learn nothing of it
    sample instant    sensors measure (q, q') by the controller's names: (R q + r, R q') while other is 1
                      where the detector fires: other <- 1 - other, step + 1, start <- t, the controller jumps
                      the torque [N m] is computed by these names, then exchanged for the plant's

These pure functions are the only place where the closed loop is defined. `closed_loop.system.ClosedLoop` calls
them on NumPy arrays (`Walker`, `SteppingLoop`), `engine.equations` on symbols, to generate code. A branch on a
symbol cannot be traced, so nothing here branches on a real number: only integers of the structure (sizes,
whether a part exists) decide. What a loop and its plant must offer is in `closed_loop.protocols`.
"""

from typing import Any, NamedTuple

import numpy as np

from biped_adrc.closed_loop.protocols import FootForces, Loop, Mode
from biped_adrc.control.base import Measurement
from biped_adrc.core.linear import solve_positive
from biped_adrc.core.tree import chosen, flatten
from biped_adrc.core.types import Array, frozen, relabelled
from biped_adrc.hardware.motors import Line
from biped_adrc.hardware.sample_hold import HeldParts, Tail, motor_torque
from biped_adrc.hardware.touchdown import Belief, Look
from biped_adrc.model.reduction import Reduction, unknown_force


class Instant(NamedTuple):
    """Measurement, torque, forces and acceleration at one state x: all that leads to its slope x'."""

    measurement: Measurement
    """What the controller was given; in continuous time the true q and v."""
    s: Any
    """State of the controller."""
    u: Array
    """Torque applied (p,) [N m]."""
    zeta: Array
    """Disturbance (n,) [N m]."""
    force: Array
    """Generalised force B_s u + zeta (n,) [N m]."""
    a: Array
    """q'' (n,) [rad/s^2]."""


class State(NamedTuple):
    """The walker's state x (nx,) as a tree; its arrays are read-only, as controllers and sensors get them."""

    q: Array
    """Angles (n,) [rad]."""
    v: Array
    """Rates (n,) [rad/s]."""
    s: Any
    """State of the controller."""
    tail: Any
    """What is held between sample instants, a `Tail`; empty in continuous time."""


def parts(loop: Loop, x: Array) -> State:
    """The state x (nx,) as a `State`, whose arrays are read-only views of it."""
    return loop.layout_of(x).tree(frozen(x))


def measurement(
    loop: Loop, t: float, q: Array, v: Array, mode: Mode, body: bool, terms: Reduction | None = None
) -> Measurement:
    """The measurement that the controller gets at t [s], q (n,) [rad], v (n,) [rad/s].

    The nominal model's `terms` (inertia, Omega, kappa, xi) are computed here, unless the caller has them at q,
    v, and read-only; with `body` also its `BodyTerms` (gravity, force of the ground), for a controller that
    asks for them (`Controller.needs_body`). All of it is read-only: a controller that writes into it would
    change the motion.
    """
    q, v = frozen(q), frozen(v)
    terms = frozen(loop.nominal.reduction(q, v)) if terms is None else terms
    of_body = frozen(loop.nominal.body_terms(q, v)) if body else None

    # for a controller that asks for the model's terms at another state, such as a predicted one
    def elsewhere(q: Array, v: Array) -> Measurement:
        return measurement(loop, t, q, v, mode, body)

    return Measurement(t, mode.step, t - mode.start, q, v, terms, of_body, elsewhere)


def applied(u: Array, zeta: Array) -> Array:
    """Generalised force B_s u + zeta (n,) [N m]: zeta (n,) with u (p,) [N m] added to its first p entries."""
    force = zeta.copy()
    force[: len(u)] = force[: len(u)] + u
    return force


def acceleration(loop: Loop, terms: Reduction, q: Array, v: Array, force: Array) -> Array:
    """q'' of the plant (n,) [rad/s^2] under `force` (n,) [N m], at q (n,) [rad], v (n,) [rad/s]. terms: the
    nominal model's there; where that model is the plant, their D_s and Omega are not computed a second time.
    Raises SingularError for a singular D_s."""
    # whether the model is the plant is structure: the `if` is decided when the code is made. On symbols
    # `solve_positive` is `engine.symbols.solve_positive`, as LAPACK takes no symbols
    if loop.exact:
        return solve_positive(terms.D, force - terms.Omega, "D_s")
    return loop.plant.acceleration(q, v, force)


def instant(loop: Loop, t: float, x: Array, mode: Mode) -> Instant:
    """Measurement, torque, disturbance and acceleration at t [s] in the state x (nx,). In sampled time u is the
    torque that acts since the last sample instant; in continuous time the controller's saturated output."""
    q, v, s, tail = parts(loop, x)
    # in sampled time m is at the true (q, q'), since this is for readers of the walk, not for the controller
    m = loop.measure(t, q, v, mode)
    # `tail` is an empty tuple in continuous time
    u = motor_torque(tail.line) if tail else loop.saturate(loop.calls.output(s, m))
    zeta = loop.external(t, q, v, mode)
    force = applied(u, zeta)
    return Instant(m, s, u, zeta, force, acceleration(loop, m.terms, q, v, force))


def flow(loop: Loop, t: float, x: Array, mode: Mode) -> Array:
    """x' (nx,) between events, at t [s]. Continuous time: (q', q'', s'). Sampled time: the controller's state
    and the torque are held, and of the tail only the torques of lagging motors move."""
    k = loop.held
    if k is None:
        i = instant(loop, t, x, mode)
        # bounded: returns u, and ends the run where a torque is beyond what motors can give
        ds = loop.calls.flow(i.s, i.measurement, loop.bounded(i.u))
        return np.concatenate((i.measurement.v, i.a, flatten(ds)))
    (q, v, _, tail), n, dx = parts(loop, x), loop.plant.n, np.zeros(len(x))
    line, zeta = tail.line, loop.external(t, q, v, mode)
    dx[:n] = v
    dx[n : 2 * n] = loop.plant.acceleration(q, v, applied(motor_torque(line), zeta))
    # a slice from the names of the fields is the same for arrays and symbols, and follows when a field is added
    if line.u_m is not None:  # tau u_m' = u - u_m
        dx[loop.layout_of(x).place("tail", "line", "u_m")] = k.motors.speed * (line.u - line.u_m)
    return dx


def tick(loop: Loop, t: float, x: Array, mode: Mode) -> Array:
    """x (nx,) after one sample instant at t [s]: sensors, controller and motors act, in this order; q, q' stay.

    With sensors the controller gets the measured (q, q') of the sensors' state w in place of the true ones. A
    controller that has to notice touchdowns acts by its own names of the legs (`noticed`), and so the torques
    on their way are exchanged between the legs before it acts, and back after it.
    """
    (q, v, s, tail), k = parts(loop, x), loop.held
    assert k is not None  # only sampled time has ticks
    if tail.belief is not None:  # structure: whether there is a belief; its content is numbers
        m, s, w, b = noticed(loop, k, t, s, tail, q, v, mode)
    else:
        b, w = None, loop.checked(k.sensors, "sense", tail.sensors, k.sense(tail.sensors, q, v))
        m = loop.measure(t, *sensor_readings(loop, k, w, q, v), mode)
    # the controller acts: correct, output, limits, queue of torques, predict
    s, line = decided(loop, k, s, m, labelled(loop, b, tail.line))
    line = labelled(loop, b, line)
    return flatten(State(q, v, s, tail._replace(belief=b, sensors=w, line=line)))


def on_stance_foot(
    loop: Loop, resultant: Array, t: float, q: Array, v: Array, tail: Tail, mode: Mode
) -> FootForces:
    """Vertical forces of the ground on stance and swing foot [N], the latter 0, of a plant whose stance foot is
    pinned, at t [s], q (n,) [rad], v (n,) [rad/s], under the torque in `tail`.

    resultant (x, z) (2,) [N]: the force from outside on the robot as a whole. `ground_reaction` is the force
    (F_T, F_N) by Newton's law, m (p_com'' - g); what comes from outside is not from the ground.
    """
    force = applied(motor_torque(tail.line), loop.external(t, q, v, mode))
    a = loop.plant.acceleration(q, v, force)
    return loop.plant.ground_reaction(q, v, a)[1] - resultant[1], 0.0


def command(loop: Loop, s: Any, m: Measurement) -> tuple[Any, Array]:
    """The controller's state s corrected by the measurement m, and the torque (p,) [N m] that it asks for then,
    saturated; beyond `bounded` the run ends. loop.calls: the controller's methods in its time base."""
    s = loop.calls.correct(s, m)
    return s, loop.bounded(loop.saturate(loop.calls.output(s, m)))


def decided(loop: Loop, k: HeldParts, s: Any, m: Measurement, line: Line) -> tuple[Any, Line]:
    """State s and torques on their way (`line`, (p,) [N m] each) after the controller has acted on m.

    Order: correct, output, saturation (all in `command`), rate limit, queue, predict. The observer predicts its
    state at the next tick with the torque just sent; if it knows the computation delay (k.known), with the mean
    torque that acts in the coming period.
    """
    s, u = command(loop, s, m)
    u = k.motors.limit(line, u)
    line = k.motors.send(line, u)
    return loop.calls.predict(s, m, k.motors.mean_command(line) if k.known else u), line


def release(loop: Loop, x: Array) -> Array:
    """x (nx,) just after a torque that waited for a fraction of the period has begun to act: `line.waiting`
    replaces `line.u`, both (p,) [N m]. For a computation delay that is no whole number of periods."""
    state = parts(loop, x)
    line = state.tail.line
    return flatten(state._replace(tail=state.tail._replace(line=line._replace(u=line.waiting))))


def xi_unknown(loop: Loop, terms: Reduction, a: Array, u: Array, zeta: Array) -> Array:
    """xi~ of (11) (n,) [N m], the generalised force that the nominal model does not know. It is the disturbance
    zeta (n,) [N m] where the model is the plant; otherwise D a + Omega - B_s u with the model's terms, the
    plant's q'' = a (n,) [rad/s^2] and the torque u (p,) [N m], so that errors of the model count too."""
    return zeta if loop.exact else unknown_force(terms, a, u)


def strike(loop: Loop, t: float, x: Array, after: Mode, gain: Array) -> Array:
    """x+ (nx,) after impact, relabelling and the controller's jump, for x- = x (nx,) at t [s]. after: the
    single support that begins. gain (n,) [1], empty for none: relative error of the impact map, v+ becomes
    (1 + gain) v+."""
    q, v, _, _ = parts(loop, x)
    impact = loop.plant.impact(q, v)
    v_plus = impact.v * (1.0 + gain) if len(gain) > 0 else impact.v
    return after_contact(loop, t, x, impact.q, v_plus, after)


def after_contact(
    loop: Loop, t: float, x: Array, q_plus: Array, v_plus: Array, after: Mode
) -> Array:
    """x+ (nx,) after an impact at t [s], before which the state was x, and which left the plant at q_plus (n,)
    [rad], v_plus (n,) [rad/s], relabelled. after: the single support that begins.

    Shared by plants with an impact map and by those that compute their own contacts. The torques on their way
    are relabelled, and the controller jumps. A rate that the sensors derive from differences is reset to what
    the nominal model's impact predicts, since no difference across an impact is a rate.
    A controller that has to notice touchdowns, and its sensors, learn nothing here: its names of the legs are
    then wrong until its detector fires.
    """
    (q, v, s, tail), k = parts(loop, x), loop.held
    # the (q, q') that the controller gets: the true ones, unless it has sensors
    reading = q_plus, v_plus
    if k is not None:
        tail = tail._replace(line=tail.line.relabelled(loop.plant.swap))
        if k.touchdown is not None:
            # the plant's legs exchange their names and the controller keeps its own: `other` changes, and the
            # detector's memory d may
            b, other = tail.belief, 1.0 - tail.belief.other
            d = k.touchdown.touchdown(b.d, other, t)
            b = b._replace(other=other, d=loop.checked(k.touchdown, "touchdown", b.d, d))
            return flatten(State(q_plus, v_plus, s, tail._replace(belief=b)))
        if k.sensors is not None:
            # the last measured rates, mapped by the nominal model's impact
            expected = loop.nominal.impact(*sensor_readings(loop, k, tail.sensors, q, v)).v
            w = k.sensors.impact(tail.sensors, q_plus, v_plus, expected)
            tail = tail._replace(sensors=loop.checked(k.sensors, "impact", tail.sensors, w))
        reading = sensor_readings(loop, k, tail.sensors, q_plus, v_plus)
    s = loop.calls.jump(s, loop.measure(t, *reading, after), loop.plant.swap)
    return flatten(State(q_plus, v_plus, s, tail))


def clearance(tan_slope: float, drop: float, foot: Array) -> float:
    """Height of the swing foot (x, z) (2,) [m] above the ground, along the vertical [m]; 0 at touchdown.

    foot: relative to the stance foot. The ground is a plane through the stance foot, which falls in the
    direction of walking by tan_slope [1], and is `drop` [m] lower where this single support ends.
    """
    return foot[1] + tan_slope * foot[0] + drop


def hip_margin(lowest: float, hip: Array) -> float:
    """Height [m] of the hip (x, z) (2,) [m] above the height `lowest` [m], both from the stance foot; the run
    ends as a fall where it falls through 0."""
    return hip[1] - lowest


def time_left(longest: float, start: float, t: float) -> float:
    """Time [s] until a single support that began at `start` [s] is as long as `longest` [s]; the run ends as
    STALLED where it falls through 0."""
    return start + longest - t


def noticed(
    loop: Loop, k: HeldParts, t: float, s: Any, tail: Tail, q: Array, v: Array, mode: Mode
) -> tuple[Measurement, Any, Any, Belief]:
    """The measurement m at a sample instant t [s] of a controller that detects touchdowns itself, and after it
    the controller's state s, the sensors' state w and the belief. mode: the plant's true single support.

    The sensors measure q (n,) [rad], v (n,) [rad/s] by the controller's names of the legs. Where the detector
    fires, these names are exchanged, the sensors continue their rate as after an impact, the controller jumps,
    and the belief counts one more single support, which starts now.
    """
    assert k.touchdown is not None
    assert tail.belief is not None
    old, force = tail.belief, 0.0  # a detector that needs no force gets 0
    # q_c, v_c: (q, q') by the controller's names
    q_c, v_c = in_other_names(loop, old.other, q, v)
    # while other is 1, the foot that the controller takes for the swing foot is the stance foot
    if k.touchdown.needs_force:
        force = chosen(old.other, *loop.foot_forces(t, q, v, tail, mode))
    w = loop.checked(k.sensors, "sense", tail.sensors, k.sense(tail.sensors, q_c, v_c))
    q_seen, v_seen = sensor_readings(loop, k, w, q_c, v_c)
    # `foot` is what a real detector may use; the plant's own `other`, step and time are for simulated faults
    foot, since = loop.nominal.swing_foot(q_seen), t - mode.start
    look = Look(t, t - old.start, foot, force, old.other, mode.step, since)
    after = k.touchdown.notice(old.d, look)
    d, fires = loop.checked(k.touchdown, "notice", (old.d, 0.0), after)
    # fires is 1.0 or 0.0, on symbols an expression: arithmetic in place of `if fires: other = 1 - other`
    other = old.other + fires * (1.0 - 2.0 * old.other)
    step: Any = old.step + fires
    start = chosen(fires, t, old.start)
    q_c, v_c = in_other_names(loop, other, q, v)
    # by the new names the rates just measured are R v_seen: what the sensors expect after this exchange
    if k.sensors is not None:
        after = k.sensors.impact(w, q_c, v_c, loop.nominal.R @ v_seen)
        w = chosen(fires, loop.checked(k.sensors, "impact", w, after), w)
    read = sensor_readings(loop, k, w, q_c, v_c)
    m = loop.measure(t, *read, mode._replace(step=step, start=start))
    return m, loop.jumped(fires, s, m), w, Belief(other, step, start, d)


def sensor_readings(loop: Loop, k: HeldParts, w: Any, q: Array, v: Array) -> tuple[Array, Array]:
    """The readings (n,) [rad], (n,) [rad/s] of the sensors in the state w at q (n,) [rad], v (n,) [rad/s]."""
    return loop.checked(k.sensors, "reading", (q, v), k.reading(w, q, v))


def in_other_names(loop: Loop, other: float, q: Array, v: Array) -> tuple[Array, Array]:
    """q (n,) [rad] and v (n,) [rad/s] with the legs exchanged where `other` is 1, else unchanged."""
    model = loop.nominal
    return chosen(other, model.relabel(q), q), chosen(other, model.R @ v, v)


def labelled(loop: Loop, b: Belief | None, line: Line) -> Line:
    """The torques on their way (`line`), with the legs exchanged where the controller's names are not the
    plant's (b.other is 1): from the plant's to the controller's, or back. b is None for a controller that knows
    touchdowns at once."""
    # both are computed and one is chosen: on symbols b.other has no value that an `if` could ask
    return line if b is None else chosen(b.other, line.relabelled(loop.plant.swap), line)


def estimated(loop: Loop, s: Any, tail: Any, m: Measurement, mode: Mode) -> Array | None:
    """The observer's estimate of xi (p,) [rad/s^2] for the plant's joints; None without an observer.

    tail: empty in continuous time. m: the measurement by the plant's names of the legs; a controller with a
    belief gets it by its own names, and its estimate is exchanged back.
    """
    b = tail.belief if tail else None
    if b is not None:
        believed = mode._replace(step=b.step, start=b.start)
        m = loop.measure(m.t, *in_other_names(loop, b.other, m.q, m.v), believed)
    estimate = loop.calls.estimate(s, m)
    if estimate is None:
        return None
    xi = estimate.disturbance
    return xi if b is None else chosen(b.other, relabelled(xi, loop.plant.swap), xi)
