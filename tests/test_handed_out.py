"""What a user's code is handed cannot be written to, and what it gives back is checked, in both engines.

`said(walker, gait)` is the sentence with which a walk is refused at its start or ends later. The controller
`NPD` calls `meddle(s, m)` before each torque, with its state s and the measurement m; `still` does nothing.
The engines are Python on Pinocchio and compiled code, and both have to say the same.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import InputError
from biped_adrc.core.types import Array
from biped_adrc.hardware.sensing import Sensor
from biped_adrc.observers.base import Estimate

ENGINES = ("pinocchio", "compiled")
TIMINGS = {"ticks": ba.SampledTime(1e-3), "continuous": ba.ContinuousTime()}
WRITES = "writes into an array that it was handed"


def said(walker, gait, **more):
    """The sentence with which a walk is refused at its start, or ends as RAISED later on."""
    try:
        run = ba.walk(walker, gait, 1, **more).trajectory
    except InputError as error:
        return str(error)
    assert run.status is ba.Status.RAISED
    return run.detail


@dataclass(frozen=True)
class NPD(ba.Controller):
    """NPD in plain Python; `meddle` is called with (s, m) before each torque."""

    reference: ba.Reference
    meddle: Callable[[Array, ba.Measurement], object]

    def initial_state(self, m):
        return np.zeros(2)

    def flow(self, s, m, u):
        return np.zeros(2)

    def sampled(self, period):
        return self

    def correct(self, s, m):
        return s + 0.0

    def predict(self, s, m, u):
        return s + 0.0

    def output(self, s, m):
        self.meddle(s, m)
        r = self.reference(m.t, m.q, m.v)
        a = r.drift - 50.0 * (m.v_b - r.dq_d) - 5000.0 * (m.q_b - r.q_d)
        return m.terms.kappa_inverse @ (a - m.terms.xi)


@dataclass(frozen=True)
class Late:
    """Calls what it holds from the time `after` [s] on, so that the first try at the start does not find it."""

    does: Callable[..., object]
    after: float

    def __call__(self, s, m):
        if m.t >= self.after:
            self.does(s, m)


def damped(s, m):
    v = m.v_b
    v *= 0.999


def heavier(s, m):
    np.multiply(m.terms.D, 2.0, out=m.terms.D)


def wound_up(s, m):
    s += 1.0


@pytest.mark.parametrize(
    ("timing", "does", "after"),
    [("ticks", damped, 0.0), ("continuous", heavier, 0.01), ("ticks", wound_up, 0.01)],
)
@pytest.mark.parametrize("engine", ENGINES)
def test_a_controller_that_writes_into_what_it_is_given(engine, timing, does, after, biped, gait):
    """`does` writes into the rates, the inertia or the state that it was handed, from `after` [s] on:
    written, it would change the plant. The sentence names the function and its file."""
    controller = NPD(gait.constraint, Late(does, after))
    walker = ba.Walker(biped, controller, timing=TIMINGS[timing])
    sentence = said(walker, gait, engine=engine)
    assert WRITES in sentence
    assert sentence.startswith(f"{does.__name__} (test_handed_out.py:")


class LowPass:
    """A low-pass that keeps its last result y in itself, and not in the controller's state."""

    y = None

    def __call__(self, u):
        self.y = u if self.y is None else 0.5 * (self.y + u)
        return self.y


@dataclass(frozen=True)
class Forgetful(NPD):
    """Keeps in objects what belongs into its state, each method in one."""

    where: str = ""
    K: Array = field(default_factory=lambda: np.ones(4))
    last: dict = field(default_factory=dict)
    smooth: LowPass = field(default_factory=LowPass)
    noise: np.random.Generator = field(default_factory=np.random.default_rng)

    def _kept(self, where, x):
        if where != self.where:
            return x
        match where:
            case "an array":
                self.K[:] = 2.0 * self.K
                return x * self.K
            case "a dictionary":
                self.last["x"] = 0.5 * (self.last.get("x", x) + x)
                return self.last["x"]
            case "an object":
                return self.smooth(x)
        return x + self.noise.normal()

    def output(self, s, m):
        u = super().output(s, m)
        for where in ("an array", "a dictionary", "an object"):
            u = self._kept(where, u)
        return u

    def predict(self, s, m, u):
        return self._kept("noise", s)


@pytest.mark.parametrize("where", ["an array", "a dictionary", "an object", "noise"])
@pytest.mark.parametrize("engine", ENGINES)
def test_a_controller_that_keeps_its_state_in_itself_is_refused(engine, where, biped, gait):
    """`where`: in what the controller keeps it. A memory would be lost in machine code, and noise would be one
    number for ever."""
    controller = Forgetful(gait.constraint, still, where)
    method = "predict" if where == "noise" else "output"
    said = rf"^Forgetful\.{method} \(test_handed_out.py:\d+\) gave another result when asked again"
    with pytest.raises(InputError, match=said):
        ba.walk(ba.Walker(biped, controller, timing=TIMINGS["ticks"]), gait, 1, engine=engine)


@dataclass(frozen=True)
class WithoutTorque(ba.Controller):
    """Its `flow` has no argument u."""

    def output(self, s, m):
        return np.zeros(4)

    def initial_state(self, m):
        return np.zeros(4)

    def flow(self, s, m):
        return s


@pytest.mark.parametrize("engine", ENGINES)
def test_a_method_with_other_arguments_is_refused(engine, biped, gait):
    said = r"^WithoutTorque.flow \(test_handed_out.py:\d+\): too many .*, expected flow\(self, s, m, u\)$"
    with pytest.raises(InputError, match=said):
        ba.walk(ba.Walker(biped, WithoutTorque()), gait, 1, engine=engine)


class Counts(ba.Controller):
    """Counts its calls in itself; the count acts from call 50 on alone."""

    calls = 0

    def __init__(self):
        self.calls = 0

    def output(self, s, m):
        self.calls += 1
        return np.full(4, float(self.calls > 50))


class Integrates(Counts):
    """Keeps the integral of an angle in itself."""

    def output(self, s, m):
        self.calls = self.calls + m.q[0] - 0.2
        return np.full(4, self.calls)


@pytest.mark.parametrize("kind", [Counts, Integrates])
@pytest.mark.parametrize("engine", ENGINES)
def test_a_class_that_is_not_frozen_and_changes_itself_is_refused(engine, kind, biped, gait):
    said = r"changed the object; expected no memory in the object: write @dataclass\(frozen=True\)"
    with pytest.raises(InputError, match=said):
        ba.walk(ba.Walker(biped, kind(), timing=TIMINGS["ticks"]), gait, 1, engine=engine)


@dataclass(frozen=True)
class EndsAtTenMs(ba.Controller):
    K: float = 1.0

    def output(self, s, m):
        return self.K * np.sqrt(0.0105 - m.t) * m.q[:4]


@pytest.mark.parametrize("engine", ENGINES)
def test_a_method_without_numbers_is_named_in_compiled_code_too(engine, biped, gait):
    """The root of 0.0105 - t is NaN from the tick at 11 ms on, not yet at the start, where methods are tried:
    the run ends there and names the method."""
    walker = ba.Walker(biped, EndsAtTenMs(), timing=TIMINGS["ticks"])
    run = ba.walk(walker, gait, 1, engine=engine).trajectory
    assert run.settings["engine"] == engine
    assert run.status.name == "NOT_FINITE"
    assert re.search(r"EndsAtTenMs\.output \(.*\) returned \[nan nan nan nan\]", run.detail)
    assert 0.01 <= run.t_end < 0.0115


@dataclass(frozen=True)
class Relabels(NPD):
    """Writes into the relabelling that it is handed at an impact."""

    def jump(self, s, after, swap):
        swap[:] = swap[::-1]
        return s


@dataclass(frozen=True)
class Pushes(ba.Disturbance):
    """A disturbance that writes into the plant's rates, by a method."""

    def torque(self, t, step, t_start, q, v):
        v *= 0.5
        return np.zeros(5)


def still(s, m):
    """Does nothing."""


@pytest.mark.parametrize("engine", ENGINES)
def test_a_jump_and_a_disturbance_that_write_into_their_arguments_are_named(engine, biped, gait):
    """`Relabels` writes into the relabelling at an impact, `Pushes` into the plant's rates; the sentence has
    their source line."""
    sampled = TIMINGS["ticks"]
    relabels = ba.Walker(biped, Relabels(gait.constraint, still), timing=sampled)
    assert re.search(r"swap\[::-1\].*" + WRITES, said(relabels, gait, engine=engine))
    pushed = ba.Walker(biped, ba.NPDController(gait.constraint), Pushes())
    assert re.search(r"v \*= 0\.5.*" + WRITES, said(pushed, gait, engine=engine))


def test_what_is_stored_cannot_be_written_to(biped, gait):
    """Arrays of walks, gaits, robots and results are shared, so all are read-only; `final_state` is a copy,
    which may be written to."""
    walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 1)
    arc = walk.trajectory.arcs[0]
    c = gait.constraint
    gains = ba.Gains([5000.0] * 4, 50.0)
    kept = [arc.t, arc.x, arc.dx, arc.event.x_minus, arc.event.x_plus, gait.q_minus, gait.v_minus]
    kept += [c.phase, c.curve.coefficients, c.curve.stacked, gains.K_p]
    kept += [biped.B, biped.phase, biped.R, biped.swap, *biped.friction_coefficients]
    # "faulty": a detector of touchdowns, for a walk that has `touchdowns`
    told = ba.Scenario(
        "NPD", run={"impacts": 1}, hardware={"period": 1e-3, "touchdown": {"name": "faulty"}}
    )
    found = ba.walk_scenario(told)
    kept += [*vars(found.signals).values(), found.outcome.x_minus, found.outcome.durations]
    kept += [found.touchdowns.t, found.touchdowns.late, found.touchdowns.false]
    assert not any(array.flags.writeable for array in kept)
    walk.trajectory.final_state[0] = 0.0  # a copy


def test_an_array_that_is_handed_in_stays_its_owners(biped, gait):
    """The arrays are read-only inside of the calls; afterwards their owner can write to them as before."""
    q, v = (np.array(x) for x in gait.start(biped))
    walker = ba.Walker(biped, ba.NPDController(gait.constraint))
    x = walker.initial_state(q, v)
    walker.flow(0.0, x, ba.Mode())
    walker.measure(0.0, q, v, ba.Mode())
    assert all(array.flags.writeable for array in (x, q, v))


class Typo(ba.Controller):
    def output(self, s, m):
        return m.terms.Omga[:4]


class Misnamed(ba.Controller):
    def ouput(self, s, m):
        return m.terms.Omega[:4]


class Short(ba.Controller):
    def output(self, s, m):
        return m.terms.Omega[:3]


class NotANumber(ba.Controller):
    def output(self, s, m):
        return np.nan * m.terms.Omega[:4]


MISTAKES = {
    Typo: r"Typo\.output \(test_handed_out\.py:\d+, `return m\.terms\.Omga\[:4\]`\) raised Attrib",
    Misnamed: r"Misnamed has no method output\(s, m\); write it",
    Short: r"Short\.output \(test_handed_out\.py:\d+\) returned an array of shape \(3,\), expected \(4,\)",
    NotANumber: r"NotANumber\.output \(test_handed_out\.py:\d+\) returned \[nan nan nan nan\]",
}


@pytest.mark.parametrize("cls", MISTAKES)
@pytest.mark.parametrize("engine", ENGINES)
def test_a_mistake_in_a_controller_is_one_sentence_at_the_start(engine, cls, biped, gait):
    """A misspelt name, a misspelt method, three torques for four joints, NaN: one line with class, method and
    line of the source, before anything walks."""
    with pytest.raises(InputError, match=rf"^{MISTAKES[cls]}[^\n]*$"):
        ba.walk(ba.Walker(biped, cls()), gait, 1, engine=engine)


# -- what comes back -------------------------------------------------------------------------------
BAD = {
    "complex": (lambda u: u + 1j, r"expected \(4,\), real numbers"),
    "None": (lambda u: None, r"None, expected \(4,\).*return"),
    "too many": (lambda u: np.append(u, 0.0), r"shape \(5,\), expected \(4,\)"),
}


@dataclass(frozen=True)
class Gives(NPD):
    """A torque of another kind from the time `after` [s] on."""

    bad: Callable[[Array], object] = field(default=lambda u: u)
    after: float = 0.0

    def output(self, s, m):
        u = super().output(s, m)
        return u if m.t < self.after else self.bad(u)


@pytest.mark.parametrize(
    ("case", "timing"), [("complex", "ticks"), ("None", "continuous"), ("too many", "ticks")]
)
@pytest.mark.parametrize("engine", ENGINES)
def test_a_torque_of_a_wrong_kind_is_refused_by_class_and_method(engine, timing, case, biped, gait):
    """From 10 ms on, after the methods were tried at the start, the torque is complex, None or of five
    numbers."""
    bad, expected = BAD[case]
    walker = ba.Walker(biped, Gives(gait.constraint, still, bad, 0.01), timing=TIMINGS[timing])
    sentence = said(walker, gait, engine=engine)
    assert re.match(rf"Gives\.output .*returned .*{expected}", sentence)


class Calm(ba.Disturbance):
    def torque(self, t, step, t_start, q, v):
        return np.zeros(5)


class Watching(ba.Observer):
    """An observer written as methods."""

    def initial_state(self, y, dy, xi):
        return np.concatenate((y, dy, xi))

    def estimate(self, z):
        return Estimate(z[:4], z[4:8], z[8:])

    def reset(self, z, policy, swap, y, dy, xi):
        return z

    def flow(self, z, y, input):
        return 0.0 * z


class Blind(Sensor):
    def start(self, q, v):
        return np.zeros(1)

    def sense(self, w, q, v):
        return w

    def reading(self, w, q, v):
        return q, v


def spoilt(part, method, bad):
    """The part, with a method that gives something else."""
    made = object.__new__(type("Spoilt", (type(part),), {method: lambda self, *_: bad}))
    vars(made).update(vars(part))
    return made


SPOILT = [
    ("controller", "initial_state", None),
    ("controller", "flow", np.zeros(3)),
    ("controller", "correct", 1j * np.zeros(2)),
    ("controller", "predict", None),
    ("controller", "jump", "a"),
    ("disturbance", "torque", np.zeros(4)),
    ("disturbance", "torque", None),
    ("observer", "initial_state", None),
    ("observer", "flow", 1j * np.ones(12)),
    ("observer", "estimate", np.zeros(11)),
    ("sensors", "start", None),
    ("sensors", "sense", 1j * np.ones(5)),
    ("sensors", "reading", (np.zeros(4), np.zeros(5))),
]


@pytest.mark.parametrize(("what", "method", "bad"), SPOILT)
@pytest.mark.parametrize("engine", ENGINES)
def test_a_method_that_gives_something_else_is_refused_by_its_name(
    engine, what, method, bad, biped, gait
):
    """`what`: the part whose `method` gives `bad` instead: nothing, another shape, complex numbers. `mode`:
    the integration method with which the engine calls it; sensors, correct and predict belong to ticks."""
    # Watching, Calm and Blind: an observer, a push and sensors without a mistake
    npd = NPD(gait.constraint, still)
    if what == "observer":
        parts = {"controller": ba.ADRCController(gait.constraint, spoilt(Watching(), method, bad))}
    else:
        usual = {"controller": npd, "disturbance": Calm(), "sensors": Blind()}[what]
        parts = {"controller": npd, what: spoilt(usual, method, bad)}
    ticks = what == "sensors" or method in ("correct", "predict")
    parts["timing"] = TIMINGS["ticks" if ticks else "continuous"]
    mode = {"jump": ba.Adaptive(1e-2), "flow": None}.get(method, ba.RK4(1e-3))
    sentence = said(ba.Walker(biped, **parts), gait, engine=engine, method=mode)
    assert re.search(rf"Spoilt\)?\.{method} .*returned .*expected", sentence)
