"""What is asked of every leaf, that is, every class that fills one place of a walker.

Leaves are controllers, observers, references, outputs, disturbances, sensors, motors, curves and methods of
integration. Each has to keep the promises of its base class in continuous and in sampled time, in Python and
as machine code. `conforms(thing)` asks one of them, of the package (rows of test_conformance.py) or of one's
own.
"""

import atexit
import ctypes
import pickle
import shutil
from dataclasses import replace
from functools import cache, partial, singledispatch
from operator import call as called
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.around import Around
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.control.output_npd import OutputNPDController
from biped_adrc.core.tree import Layout, flatten
from biped_adrc.disturbances.base import Windowed
from biped_adrc.engine.equations import SymbolicFunction
from biped_adrc.engine.ir import module_text
from biped_adrc.engine.machine import Code
from biped_adrc.engine.not_compiled import NotCompiled
from biped_adrc.engine.numbers import numbers_of
from biped_adrc.engine.program import Program, push_code
from biped_adrc.engine.structure import floats, structure
from biped_adrc.engine.symbols import Vector, column
from biped_adrc.engine.tracer import Tracer, apply
from biped_adrc.gait.constraint import continued
from biped_adrc.gait.curves import Curve
from biped_adrc.gait.outputs import FunctionOutputs, LinearOutputs, Outputs
from biped_adrc.gait.reference import check_point
from biped_adrc.hardware.motors import Line, Motors, TorqueLine
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.hardware.touchdown import Look, Touchdown
from biped_adrc.hybrid.integrators import OneStepMethod

PERIOD, SWAP = 1e-3, np.array([1, 0, 3, 2])
SLOW = ba.GPIObserver.from_bandwidth(20.0)
"""Its gains do not turn the last bit of an angle into 1e-9 of a rate, as those of Table I do."""


@cache
def robot():
    return ba.Biped.load("rabbit")


@cache
def gait():
    return ba.load_gait("published", robot())


def written(text, name="given.csv"):
    """The path of a file with this text."""
    folder = mkdtemp()
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    (path := Path(folder) / name).write_text(text)
    return path


def outputs(h):
    return LinearOutputs(np.eye(4, 5), h)


# -- what is asked of a thing --------------------------------------------------------------------
@singledispatch
def conforms(thing):
    """Ask one leaf all that its kind has to keep; raises TypeError for what is no leaf."""
    raise TypeError(f"{thing!r} is no leaf")


@conforms.register
def _(controller: ba.Controller):
    """Returns whether its methods could be compiled; what solves by a library of its own runs in Python."""
    worked, compiled = 0, True
    for timing in (ba.ContinuousTime(), ba.SampledTime(PERIOD)):
        build = partial(ba.Walker, robot(), controller, timing=timing, runaway_torque=np.inf)
        walker = unless("Time(", build)
        if walker is None:
            wraps = isinstance(
                controller, Around
            )  # it, or what is inside, works in sampled time only
            assert isinstance(timing, ba.SampledTime) or wraps or controller._writes("predict")
            continue
        worked, law = worked + 1, walker.law
        for m, random in measurements(3):
            contract(law, m, random, walker.sampled)
        compiled = compiled and methods_compile(law, walker.sampled)
        if compiled:
            loop_compiles(replace(walker, plant=heavy(), model=robot(), torque_limit=150.0))
    assert worked
    return compiled


@conforms.register
def _(observer: ba.Observer):
    still = observer.initial_state(*np.zeros((3, 4))), *np.zeros((2, 4))
    if unless("sampled time only", lambda: observer.flow(*still)) is None:
        estimator(observer, ("correct", "predict"))
        return
    estimator(observer, ("flow",))
    discrete = unless("has no discrete form", lambda: observer.sampled(PERIOD))
    if discrete is not None:
        estimator(discrete, ("correct", "predict"))


@conforms.register
def _(disturbance: ba.Disturbance):
    random, n = np.random.default_rng(5), 5
    seen = []
    for step in (1, 2, 3):
        edges = disturbance.switching_times(step, 1.0)
        before = [np.nextafter(t, 0.0) for t in edges]
        for t in (1.0, 1.15, 1.3, *edges, *before):
            q, v = random.normal(size=(2, n))
            kept, at = (q.copy(), v.copy()), (float(t), step, 1.0, q, v)
            one = disturbance.zeta(*at)
            assert one.shape == (n,)
            assert np.all(np.isfinite(one))
            seen.append(np.array(one))
            one += 1.0  # what is handed out is the caller's
            assert np.array_equal(seen[-1], disturbance.zeta(*at))
            assert np.array_equal(kept, (q, v))
            assert disturbance.net_force(*at[:3]).shape == (2,)
            torque_compiles(disturbance, at)
    if isinstance(disturbance, Windowed) and len(disturbance.amplitude) > 3:
        wave = replace(disturbance, amplitude=np.array([3.0, -2.0, 1.0]))
        conforms(ba.OnLink(robot(), "right_shin", wave, (0.1, 0.2)))
    assert np.any(seen), "it never does anything in the first three single supports"


@conforms.register
def _(sensor: Sensor):
    """Pure, of the size that it says, at ticks and impacts, in Python, as machine code and in the loop."""
    sampled, random = sensor.sampled(5, 4, PERIOD), np.random.default_rng(6)
    (q, v, dv), law = random.normal(size=(3, 5)), type(sampled)
    w = agree(law.start, sampled, q, v)
    assert same(w, sampled.start(q, v))
    for _ in range(5):
        kept, at = flatten((w, q, v)).copy(), (sampled, w, q, v)
        after = [agree(law.sense, *at), agree(law.impact, *at, v + dv)]
        assert same(after[0], law.sense(*at))
        assert all(Layout.of(x) == Layout.of(w) and np.all(np.isfinite(flatten(x))) for x in after)
        reading = agree(law.reading, *at)
        assert [x.shape for x in reading] == [(5,), (5,)]
        assert np.array_equal(kept, flatten((w, q, v)))
        w, q, v = after[0], q + 0.01 * v, v + 0.1 * dv
    timing = ba.SampledTime(PERIOD)
    walker = ba.Walker(
        heavy(),
        ba.NPDController(gait().constraint),
        timing=timing,
        sensors=sensor,
        runaway_torque=np.inf,
    )
    loop_compiles(replace(walker, model=robot()))
    assert pickle.loads(pickle.dumps(walker)).sensors == sensor


@conforms.register
def _(touchdown: Touchdown):
    """Pure, of the size that it says, at ticks and touchdowns, in Python, machine code and the loop."""
    law, d, fired = type(touchdown), touchdown.start(), 0.0
    for i in range(60):
        foot, kept = np.array([0.3, 0.02 * np.sin(0.5 * i)]), flatten(d).copy()
        force = 80.0 * (np.sin(0.3 * i) > 0.0)
        look = Look(PERIOD * i, 0.2, foot, force, float(i > 45), 1.0, PERIOD * i)
        after, fires = agree(law.notice, touchdown, d, look)
        assert fires in (0.0, 1.0)
        assert np.array_equal(flatten(d), kept)
        assert Layout.of(after) == Layout.of(d)
        d, fired = as_floats(after), fired + fires
        if i == 45:
            d = as_floats(agree(law.touchdown, touchdown, d, 1.0, look.t))
    assert fired
    timing = ba.SampledTime(PERIOD, restart=False)
    law = ba.NPDController(gait().constraint)
    walker = ba.Walker(heavy(), law, timing=timing, touchdown=touchdown, runaway_torque=np.inf)
    loop_compiles(replace(walker, model=robot()))
    assert pickle.loads(pickle.dumps(walker)).touchdown == touchdown


@conforms.register
def _(curve: Curve):
    """Two derivatives, continuous where pieces meet, in both engines; a curve of a gait."""
    p, d = len(curve(0.0)[0]), 1e-5
    for s in np.linspace(-0.2, 1.2, 141):
        h, dh, ddh = curve(float(s))
        assert h.shape == dh.shape == ddh.shape == (p,)
        ahead, behind = curve(float(s + d)), curve(float(s - d))
        scale = 1.0 + np.max(np.abs(ddh))
        for k in (0, 1):
            slope = (ahead[k] - behind[k]) / (2.0 * d)
            assert np.max(np.abs(slope - (dh, ddh)[k])) <= 1e-2 * scale
        assert np.max(np.abs(ahead[2] - behind[2])) <= 1e-2 * scale
    for s in curve.pieces[0]:
        for before, after in zip(curve(float(s - 1e-10)), curve(float(s + 1e-10)), strict=True):
            assert np.max(np.abs(after - before)) <= 1e-6 * scale
    c = gait().constraint
    h = ba.VirtualConstraint(curve, c.phase, c.theta_plus, c.theta_minus)
    for constraint in (h, continued(h)):
        point_is_consistent(constraint)


@conforms.register
def _(reference: ba.Reference):
    """Its rates are those of its angles, in machine code too, and a controller without a state tracks it."""
    point_is_consistent(reference)
    conforms(ba.NPDController(reference))


@conforms.register
def _(outputs: Outputs):
    """y' and y'' are the rates of y and y'; a controller of outputs drives them."""
    for m, random in measurements(5):
        a, d = random.normal(size=5), 1e-5
        o = pure(outputs, m.t, m.q, m.v)
        assert [np.shape(x) for x in o] == [(4,), (4,), (4, 5), (4,)]
        ahead, behind = (moved(outputs, m, a, s) for s in (d, -d))
        slopes = [(one - other) / (2.0 * d) for one, other in zip(ahead, behind, strict=True)]
        assert np.max(np.abs(slopes[0] - o.dy)) <= 1e-6 * (1.0 + np.max(np.abs(o.dy)))
        # differences over 4e-3 rad divide the round-off of sin, which is not that of NumPy, by 1.6e-5
        within = 1e-10 if isinstance(outputs, FunctionOutputs) else 1e-12
        agree(called, outputs, m.t, m.q, m.v, within=within)
        ddy = o.J @ a + o.drift
        assert np.max(np.abs(slopes[1] - ddy)) <= 1e-5 * (1.0 + np.max(np.abs(ddy)))
    conforms(OutputNPDController(outputs))


@conforms.register
def _(method: OneStepMethod):
    """The same walk in both engines and both time bases, node by node where no step is chosen."""
    linear = isinstance(method, ba.Exponential)
    observer = ba.GPIObserver.from_poles() if linear else ba.GPIObserver.from_bandwidth(300.0)
    controller = ba.ADRCController(gait().constraint, observer)
    for timing in (ba.ContinuousTime(), ba.SampledTime(2 * PERIOD)):
        walker = ba.Walker(robot(), controller, timing=timing, runaway_torque=np.inf)
        if not (walker.sampled and linear):
            walked_alike(walker, method)
    assert pickle.loads(pickle.dumps(method)) == method
    assert method.label


@conforms.register
def _(motors: Motors):
    """The line of torques in machine code, with every delay, and in the loop behind a controller."""
    random = np.random.default_rng(7)
    for delay in (0.0, 1.3 * PERIOD):
        k, rest = motors.sampled(4, delay, PERIOD)
        layout = Layout.of(rest)
        assert len(rest.queue) == int(delay / PERIOD)
        for _ in range(3):
            line, u = layout.tree(20.0 * random.normal(size=layout.size)), random.normal(size=4)
            kept = flatten(line).copy()
            last, change = line.queue[-1] if len(line.queue) else line.u, k.change or np.inf
            limited = agree(TorqueLine.limit, k, line, u)
            assert np.array_equal(limited, np.clip(u, last - change, last + change))
            sent = agree(TorqueLine.send, k, line, limited)
            after = agree(Line.relabelled, sent, SWAP)
            assert Layout.of(sent) == Layout.of(after) == layout
            assert agree(TorqueLine.mean_command, k, sent).shape == (4,)
            assert np.array_equal(kept, flatten(line))
    for delay, known in ((2.0 * PERIOD, False), (1.3 * PERIOD, True)):
        timing = ba.SampledTime(PERIOD, delay=delay, delay_known=known)
        controller = ba.ADRCController(gait().constraint, SLOW)
        walker = ba.Walker(heavy(), controller, timing=timing, motors=motors, runaway_torque=np.inf)
        loop_compiles(replace(walker, model=robot()), 20, ticks=4)
    assert pickle.loads(pickle.dumps(motors)) == motors


def unless(words, call):
    """What a call gives, None where it is refused with this message."""
    try:
        return call()
    except ba.BipedError as error:
        if words not in str(error):
            raise
        return None


# -- parts of it -----------------------------------------------------------------------------------
@cache
def heavy():
    return ba.ModelErrors(mass={"torso": 0.2}).apply(robot())


def pure(function, *given):
    """What a function gives, twice the same, with its arrays left alone."""
    kept = [np.copy(x) for x in given]
    found = function(*given)
    for one, other in zip(found, function(*given), strict=True):
        assert np.array_equal(one, other)
        assert np.all(np.isfinite(one))
    assert all(np.array_equal(a, b) for a, b in zip(kept, given, strict=True))
    return found


def moved(function, m, a, s):
    """The first two of what the function gives s seconds on, under the acceleration a."""
    return function(m.t + s, m.q + s * m.v + 0.5 * s * s * a, m.v + s * a)[:2]


def point_is_consistent(reference):
    """q_d' and drift + H q'' are the rates of q_d and q_d'; in machine code too."""
    d = 1e-5
    for m, random in measurements(5):
        a = random.normal(size=5)
        r = pure(reference, m.t, m.q, m.v)
        check_point(reference, r, 4, 5)
        ahead, behind = (moved(reference, m, a, s) for s in (d, -d))
        slopes = [(one - other) / (2.0 * d) for one, other in zip(ahead, behind, strict=True)]
        rates = r.dq_d, r.drift + r.H @ a
        for slope, rate in zip(slopes, rates, strict=True):
            assert np.max(np.abs(slope - rate)) <= 1e-3 * (1.0 + np.max(np.abs(rate)))
        agree(called, reference, m.t, m.q, m.v)


def measurements(count):
    """States about the gait's orbit, with what a sensor on the body would measure; and the random generator."""
    walker, random = ba.Walker(robot(), ba.Passive()), np.random.default_rng(3)
    q, v = gait().start(robot())
    for _ in range(count):
        x = q + 0.05 * random.normal(size=5), v + 0.5 * random.normal(size=5)
        m = walker.measure(0.1, *x, ba.Mode())._replace(body=robot().body_terms(*x))
        yield m._replace(elsewhere=elsewhere()), random


@cache
def elsewhere():
    """What measures elsewhere, one for all measurements, as it is a part of the code of what calls it."""
    q, v = gait().start(robot())
    m = ba.Walker(robot(), ba.Passive()).measure(0.1, q, v, ba.Mode())
    return partial(moved_to, m._replace(body=robot().body_terms(q, v)))


def moved_to(m, q, v):
    """What is measured elsewhere, on symbols too: of a model that differs from that of m by a factor."""
    f = 1.0 + 0.1 * np.sin(q[0])
    terms, body = (part._make(f * x for x in part) for part in (m.terms, m.body))
    return m._replace(q=q, v=v, terms=terms, body=body)


def disturbed(s, random):
    """A state with each of its numbers off by some per cent."""
    x = flatten(s)
    return Layout.of(s).tree(x * (1.0 + 0.01 * random.normal(size=len(x))))


def contract(law, m, random, sampled):
    """Pure functions of the right shapes that leave alone what they are given."""
    s = disturbed(law.initial_state(m), random)
    kept = flatten((s, m.q, m.v)).copy()
    u = law.output(s, m)
    assert np.array_equal(u, law.output(s, m))
    assert u.shape == (len(m.q_b),)
    assert np.all(np.isfinite(u))
    after = [law.jump(s, m, SWAP)]
    after += [law.correct(s, m), law.predict(s, m, u)] if sampled else [law.flow(s, m, u)]
    for state in after:
        assert Layout.of(state) == Layout.of(s)
        assert np.all(np.isfinite(flatten(state)))
    assert np.array_equal(kept, flatten((s, m.q, m.v)))


def methods_compile(law, sampled):
    """Each method of a controller alone: machine code and Python have the same numbers.

    Returns False where its torque cannot be compiled.
    """
    for m, random in measurements(5):
        s, u = disturbed(law.initial_state(m), random), 20.0 * random.normal(size=4)
        a, kind = 0.1 * random.normal(size=(5, 2)), type(law)
        try:
            agree(kind.output, law, s, m)
        except NotCompiled:
            return False
        calls = {"correct": (s, m), "predict": (s, m, u)} if sampled else {"flow": (s, m, u)}
        calls |= {"initial_state": (m,), "jump": (s, m, SWAP)}
        if law.estimate(s, m) is not None:
            calls["estimate"] = (s, m)
        for name, rest in calls.items():
            agree(getattr(kind, name), law, *rest)
        for name in law.reads_impulse[: 1 + sampled]:
            agree(getattr(kind, name), law, s, m._replace(impulse=a))
    return True


def loop_compiles(walker, states=20, ticks=0):
    """The closed loop of a wrong model, pushed and limited: flow, tick, strike and watch in machine code.

    ticks: taken before each state is compared, so that a line of torques has something in it.
    """
    random, n, mode = np.random.default_rng(11), walker.plant.n, ba.Mode(3, 0.05)
    ends = gait().start(robot()), (gait().q_minus, gait().v_minus)
    program = struck = None
    for i in range(states):
        q, v = ends[i % 2]
        x = walker.initial_state(*(a + 0.3 * random.normal(size=n) for a in (q, v)))
        x[2 * n :] *= 1.0 + 0.1 * random.normal(size=len(x) - 2 * n)
        for _ in range(ticks):
            x = walker.tick(0.1, x, mode)
        if program is None:
            program = Program(walker.layout_of(x), numbers_of(walker))
        zeta = 30.0 * random.normal(size=n)
        pushed = replace(walker, disturbance=ba.TorqueStep(zeta))
        flow = pushed.flow(0.1, x, mode)
        beside = pushed.flow(0.1, x * (1.0 + 4e-16), mode)  # a change of the last bit in the state
        close(
            program, "flow", (0.1, 3.0, 0.05, x, zeta), flow, 10.0 * np.max(np.abs(beside - flow))
        )
        if walker.sampled:
            outside = np.zeros(5)
            close(program, "tick", (0.1, 3.0, 0.05, x, zeta, outside), pushed.tick(0.1, x, mode))
        seen = [guard.witness(0.1, x) for guard in walker.guards(mode)]
        seen.append(walker.plant.swing_foot(x[:n])[0])
        close(program, "events", (0.1, 0.05, walker.drop(3), x[:n]), np.array(seen))
        after = walker.strike(0.1, x, ba.Mode(2, 0.0))
        if after is not None:
            struck = after
            close(program, "impact", (0.1, 3.0, x), after[0])
    assert struck is not None


def estimator(observer, steps):
    """Start, estimates, every reset and what moves it, in Python, in machine code and under a controller."""
    y, dy, xi = np.random.default_rng(4).normal(size=(3, 4))
    z = observer.initial_state(y, dy, xi)
    kept, x = z.copy(), observer.estimate(z)
    assert x.position == pytest.approx(y)
    for found, given in ((x.velocity, dy), (x.disturbance, xi)):
        assert found == pytest.approx(given) or not np.any(found)
    given = {"flow": (y, xi), "correct": (y,), "predict": (xi,)}
    after = [getattr(observer, name)(z, *given[name]) for name in steps]
    after += [observer.reset(z, policy, SWAP, y, dy, xi) for policy in ba.ResetPolicy]
    for state in after:
        assert state.shape == z.shape
        assert np.all(np.isfinite(state))
    assert np.array_equal(z, kept)
    for name in given.keys() - set(steps):
        with pytest.raises(ba.BipedError, match="works in"):
            getattr(observer, name)(z, *given[name])
    other = np.random.default_rng(4).normal(size=z.shape)
    calls = [(name, (other, *given[name])) for name in steps]
    calls += [("reset", (other, policy, SWAP, y, dy, xi)) for policy in ba.ResetPolicy]
    for name, rest in [*calls, ("initial_state", (y, dy, xi)), ("estimate", (other,))]:
        agree(lambda o, *rest: getattr(o, name)(*rest), observer, *rest)  # noqa: B023
    around = MomentumDOBController if observer.lead == 1 else ba.ADRCController
    for policy in ba.ResetPolicy:
        law = around(gait().constraint, observer, reset=policy)
        for m, random in measurements(3):
            contract(law, m, random, "predict" in steps)
            s = random.normal(size=np.shape(law.initial_state(m)))
            agree(around.jump, law, s, m, SWAP)


def walked_alike(walker, method):
    """One step and its impact in both engines; times, states and slopes on the way, unless chosen by error."""
    by_nodes = walker.sampled or hasattr(method, "h")
    landing = isinstance(method, ba.Exponential) or not by_nodes
    tolerance = 1e-6 if landing else 1e-10 if walker.sampled else 1e-11
    python, code = (
        ba.walk(walker, gait(), 1, method, engine=engine).trajectory
        for engine in ("pinocchio", "compiled")
    )
    assert python.status is code.status is ba.Status.COMPLETED
    assert code.settings["engine"] in ("compiled", "compiled plant")
    assert code.settings["method"] == python.settings["method"]
    (one,), (other,) = python.arcs, code.arcs
    assert one.event.guard == other.event.guard
    assert abs(one.event.t - other.event.t) <= tolerance
    pairs = [(getattr(x.event, side) for x in (one, other)) for side in ("x_minus", "x_plus")]
    if by_nodes:
        assert one.t.shape == other.t.shape
        pairs += [(getattr(x, name) for x in (one, other)) for name in ("t", "x", "dx")]
    for expected, found in pairs:
        scale = np.maximum(1.0, np.max(np.abs(expected), axis=0, initial=0.0))
        assert np.all(np.abs(found - expected) <= tolerance * scale)


def torque_compiles(disturbance, at):
    """Torque and force of a disturbance as machine code."""
    inp, n = np.concatenate([np.ravel(x) for x in at]), len(at[3])
    zeta, force = np.zeros(n), np.zeros(2)
    for term in disturbance.terms:
        load = call(push_code(term, n), "push", np.array([*floats(term), 0.0]), inp, n + 2)
        zeta, force = zeta + load[:n], force + load[n:]
    assert np.max(np.abs(zeta - disturbance.zeta(*at))) <= 1e-13
    assert np.max(np.abs(force - disturbance.net_force(*at[:3]))) <= 1e-14


# -- machine code ----------------------------------------------------------------------------------
DOUBLES = ctypes.POINTER(ctypes.c_double)
FUNCTION = ctypes.CFUNCTYPE(None, DOUBLES, DOUBLES, DOUBLES)


def call(code, name, K, inp, size):
    """What a function of machine code writes."""
    out = np.full(size, np.nan)
    pointers = (np.ascontiguousarray(x).ctypes.data_as(DOUBLES) for x in (K, inp, out))
    FUNCTION(code.addresses[name])(*pointers)
    return out


def close(program, name, given, expected, bits=0.0):
    """A function of a walker's program has these numbers first; bits: what round-off does to them."""
    inp = np.concatenate([np.atleast_1d(x) for x in given])
    found = call(program.machine, name, program.K, inp, 2 * len(inp))[: len(expected)]
    assert np.max(np.abs(found - expected)) <= max(1e-11 * np.max(np.abs(expected)), bits)


def same(one, other):
    """Whether two trees have the same numbers."""
    return np.array_equal(flatten(one), flatten(other))


def as_floats(tree):
    """The tree with its numbers as floats, as the closed loop has them."""
    return Layout.of(tree).tree(flatten(tree).astype(float))


TRACED = {}
"""A law and the structure of its arguments -> its machine code, which serves all their numbers."""


def agree(law, *arguments, within=1e-12):
    """The result in Python, equal to that of the machine code within this part of its largest number.

    The code solves linear systems by an elimination of its own, so round-off differs from LAPACK's.
    """
    expected = law(*arguments)
    numbers = np.array([x for argument in arguments for x in floats(argument)] + [0.0])
    key = law, structure(arguments)
    if key not in TRACED:
        K = Vector("K", len(numbers))
        found = apply(Tracer(), law, *(K.like(argument) for argument in arguments))
        out = column(flatten(found))
        text = module_text({"law": SymbolicFunction(K.symbol, Vector("inp", 1).symbol, out)})
        TRACED[key] = Code(text, ("law",))
    code, one = TRACED[key], flatten(expected)
    other = call(code, "law", numbers, np.zeros(1), len(one))
    assert np.max(np.abs(one - other), initial=0.0) <= within * np.max(np.abs(one), initial=1.0)
    return expected
