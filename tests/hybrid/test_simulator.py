"""The hybrid loop against closed forms: events, resets, clocks, switching times, statuses.

A guard fires where its function of (t, x), the witness, falls through zero, and resets the state. `Ball` falls
from a height onto a floor at 0; `Dropped(e)` has restitution e. `Timer(witness)` has x' = 1 from x = 0 and a
guard on a function of time, whose reset adds 100; `go(system)` simulates it from 0 to 1 s with steps of 0.1 s.
"""

import json
import math
from dataclasses import dataclass, field

import numpy as np
import pytest

from biped_adrc.core.errors import InputError, NotFiniteError, RanAwayError, SingularError
from biped_adrc.hybrid.exponential import Exponential
from biped_adrc.hybrid.integrators import RK4, Adaptive
from biped_adrc.hybrid.simulator import simulate
from biped_adrc.hybrid.status import Status
from biped_adrc.hybrid.storage import load, save
from biped_adrc.hybrid.system import Clock, Guard, HybridSystem, Split

G = 9.81


class Ball(HybridSystem):
    """A bouncing ball of restitution 0.8."""

    e = 0.8

    def flow(self, t, x, mode):
        return np.array([x[1], -G])

    def guards(self, mode):
        return (
            Guard(
                "bounce",
                lambda t, x: x[0],
                lambda t, x: (np.array([0.0, -self.e * x[1]]), mode + 1),
            ),
        )


@pytest.mark.parametrize("method", [RK4(1e-3), RK4(0.03), Adaptive()])
def test_bouncing_ball_in_closed_form(method):
    """Times of six bounces from 1 m with restitution 0.8, and speeds before and after them; each begins a new
    arc. Motion between them is a parabola, exact in every method.
    """
    run = simulate(Ball(), np.array([1.0, 0.0]), 0, method, t_end=10.0, stop_after=("bounce", 6))
    assert run.status is Status.COMPLETED
    first = math.sqrt(2.0 / G)
    expected = [first + 2 * first * sum(0.8**j for j in range(1, k + 1)) for k in range(6)]
    found = [event.t for event in run.events("bounce")]
    assert found == pytest.approx(expected, abs=1e-9)
    for k, event in enumerate(run.events()):
        assert event.x_minus == pytest.approx([0.0, -G * first * 0.8**k], abs=1e-8)
        assert event.x_plus[1] == pytest.approx(-0.8 * event.x_minus[1], rel=1e-15)
    assert [arc.mode for arc in run.arcs] == list(range(6))


class Dropped(Ball):
    """A ball of another restitution, with coordinates for the exponential method: E' = A E + (0, -g)."""

    def __init__(self, e):
        self.e = e

    def split(self, mode):
        A = np.array([[0.0, 1.0], [0.0, 0.0]])
        pull = np.zeros(0), np.array([[0.0], [-G]])
        return Split(
            lambda x: (x[:0], x[:, np.newaxis]), lambda w, E: E[:, 0], A, lambda t, w, E: pull
        )


ALL_METHODS = [RK4(1e-3), RK4(0.05), Exponential(5e-3), Adaptive()]


@pytest.mark.parametrize("method", ALL_METHODS)
@pytest.mark.parametrize("start", [(0.01, 0.0), (0.0, 1e-3)])
def test_bounces_that_accumulate_are_all_found_and_end_the_run(method, start):
    """Hop k lasts T e^k, with T = 2 v / g for a landing at v [m/s] and e = 0.7: they add up to T e / (1 - e)
    after the first landing. Events closer than 1 us are not told apart, so the run ends as EVENT_LIMIT when
    hops are below 2 us.
    """
    e, (z, v) = 0.7, start
    speed = math.sqrt(v**2 + 2.0 * G * z)
    landing, hop = (v + speed) / G, 2.0 * e * speed / G
    run = simulate(Dropped(e), np.array(start), 0, method, t_end=10.0)
    found = np.array([event.t for event in run.events("bounce")])
    expected = landing + hop * (1.0 - e ** np.arange(len(found))) / (1.0 - e)
    assert run.status is Status.EVENT_LIMIT
    assert found == pytest.approx(expected, abs=1e-12)
    assert found[-1] - found[-2] < 2e-6
    assert run.t_end < landing + hop / (1.0 - e)
    assert min(arc.x[:, 0].min() for arc in run.arcs) > -1e-12


@pytest.mark.parametrize("method", ALL_METHODS)
@pytest.mark.parametrize(("start", "bounces"), [((0.01, 0.0), 1), ((0.0, 0.0), 0)])
def test_a_ball_at_rest_does_not_fall_through_the_floor(method, start, bounces):
    """Restitution 0: from 1 cm it lands once, and from rest on the floor not at all; a next event would follow
    at once, and the run ends as EVENT_LIMIT with the ball at 0.
    """
    run = simulate(Dropped(0.0), np.array(start), 0, method, t_end=10.0)
    assert (run.status, len(run.events())) == (Status.EVENT_LIMIT, bounces)
    assert run.t_end == pytest.approx(math.sqrt(2.0 * start[0] / G), abs=1e-12)
    assert run.final_state == pytest.approx([0.0, 0.0], abs=1e-15)


def floor(k):
    """The floor of ball k of several, whose state is (z, v) of one after the other."""

    def reset(t, x):
        x = x.copy()
        x[2 * k : 2 * k + 2] = 0.0, -0.8 * x[2 * k + 1]
        return x, None

    return Guard(f"floor {k}", lambda t, x: x[2 * k], reset)


class Balls(HybridSystem):
    """Three balls that know nothing of each other."""

    def flow(self, t, x, mode):
        return np.column_stack([x[1::2], np.full(len(x) // 2, -G)]).ravel()

    def guards(self, mode):
        return tuple(floor(k) for k in range(3))


@pytest.mark.parametrize("method", [RK4(1e-3), RK4(0.03), Adaptive()])
@pytest.mark.parametrize("apart", [0.0, 1.2e-15, 1e-13, 1e-9])
def test_balls_that_land_at_one_instant_all_bounce(method, apart):
    """Each of the balls bounces at the times of a ball alone, and is at its height afterwards. apart [m]: how
    much higher the second one starts, by a round-off and by more.
    """
    start = [1.0, 0.0, 1.0 + apart, 0.0, 1.0, 0.0]
    run = simulate(Balls(), np.array(start), None, method, t_end=1.5)
    alone = simulate(Ball(), np.array([1.0, 0.0]), 0, method, t_end=1.5)
    assert run.status is Status.COMPLETED
    for k in range(3):
        found = [event.t for event in run.events(f"floor {k}")]
        assert found == pytest.approx([event.t for event in alone.events()], abs=1e-8)
    assert run.final_state[::2] == pytest.approx(alone.final_state[:1].repeat(3), abs=1e-8)
    # 0.3 s: before the first landing, all still fall
    assert run(0.3)[::2] == pytest.approx(np.full(3, 1.0 - 0.5 * G * 0.09), abs=1e-8)


@pytest.mark.parametrize("method", ALL_METHODS)
@pytest.mark.parametrize("start", [(0.0, -1.0), (-0.1, -1.0)])
def test_a_ball_that_starts_at_or_below_its_floor_and_falls_bounces_at_once(method, start):
    """The ball bounces at t = 0, from where it is, at 0.8 of its 1 m/s; its reset puts it onto the floor."""
    run = simulate(Dropped(0.8), np.array(start), 0, method, t_end=0.1)
    (event,) = run.events()
    assert (event.t, *event.x_minus) == (0.0, *start)
    assert run(0.1) == pytest.approx([0.08 - 0.005 * G, 0.8 - 0.1 * G], abs=1e-9)
    assert run(0.0) == pytest.approx([0.0, 0.8])


@dataclass(frozen=True)
class Switched(Ball):
    """At 0.2 s, once, the ball is put to another height; its guard stays where `stays`."""

    height: float | None
    stays: bool

    def guards(self, mode):
        def reset(t, x):
            return np.array([x[0] if self.height is None else self.height, x[1]]), mode + 1

        switch = Guard("switch", lambda t, x: 0.2 - t, reset)
        return (*super().guards(mode), switch)[: 2 if self.stays or mode == 0 else 1]


def test_a_jump_below_a_floor_fires_at_once_and_a_time_that_is_over_does_not_again():
    """At 0.2 s a reset puts the ball 0.5 m below its floor: it bounces at that instant, and again 2 0.8 v / g =
    0.32 s later. In the second run the guard of 0.2 s stays after it has fired, with a negative witness, and is
    silent.
    """
    # Switched(height after 0.2 s, None: the same; whether the guard of 0.2 s stays)
    jump = simulate(Switched(-0.5, False), np.array([1.0, 0.0]), 0, RK4(1e-3), t_end=0.7)
    assert [event.guard for event in jump.events()] == ["switch", "bounce", "bounce"]
    times = [0.2, 0.2, 0.2 + 2 * 0.8 * 0.2]
    assert [event.t for event in jump.events()] == pytest.approx(times, abs=1e-12)
    over = simulate(Switched(None, True), np.array([1.0, 0.0]), 0, RK4(1e-3), t_end=1.5)
    assert [event.guard for event in over.events()] == ["switch", "bounce", "bounce"]


def test_events_of_two_guards_in_turn_that_accumulate_end_the_run():
    """x' = +-3 between walls at +-(1 - t): each way takes half the time of the one before."""

    class Walls(HybridSystem):
        def flow(self, t, x, mode):
            return np.array([3.0 * mode])

        def guards(self, mode):
            return (
                Guard("upper", lambda t, x: 1.0 - t - x[0], lambda t, x: (x, -1)),
                Guard("lower", lambda t, x: 1.0 - t + x[0], lambda t, x: (x, 1)),
            )

    run = simulate(Walls(), np.zeros(1), 1, RK4(1e-2), t_end=5.0)
    assert run.status is Status.EVENT_LIMIT
    assert run.t_end == pytest.approx(1.0, abs=1e-6)


def test_dense_output_gives_both_sides_of_an_event():
    """run(t) is the state at t, at an event the one after it, with "left" the one before: the speed changes its
    sign.
    """
    run = simulate(Ball(), np.array([1.0, 0.0]), 0, RK4(1e-2), t_end=1.2)
    t = run.events()[0].t
    assert run(t, "left")[1] < 0 < run(t)[1]
    assert run(0.2)[0] == pytest.approx(1 - 0.5 * G * 0.04, abs=1e-12)
    with pytest.raises(InputError, match="outside"):
        run(5.0)
    with pytest.raises(InputError, match="middle"):
        run(0.1, "middle")


@dataclass(frozen=True)
class Timer(HybridSystem):
    """x' = rate; a guard on a function of time, whatever it is asked to be."""

    witness: object
    terminal: Status | None = None
    accept: bool = True
    clock: Clock | None = None
    switches: tuple[float, ...] = ()
    seen: list = field(default_factory=list)

    def flow(self, t, x, mode):
        self.seen.append(t)
        return np.ones_like(x)

    def guards(self, mode):
        def reset(t, x):
            return (x + 100.0, mode + 1) if self.accept else None

        return (Guard("g", lambda t, x: self.witness(t), reset, self.terminal),)

    def clocks(self):
        return (self.clock,) if self.clock else ()

    def switching_times(self, mode):
        return self.switches


def go(system, method=None, t_end=1.0, **more):
    return simulate(system, np.zeros(1), 0, method or RK4(0.1), t_end=t_end, **more)


def test_a_zero_at_the_start_fires_where_the_witness_falls_and_one_at_the_end_does():
    """Witness t rises from 0 and is no event; -t falls from 0 and is one at 0 s; 1 - t reaches 0 at the end of
    the run, and is one there.
    """
    assert not go(Timer(lambda t: t)).events()
    assert [event.t for event in go(Timer(lambda t: -t)).events()] == [0.0]
    events = go(Timer(lambda t: 1.0 - t), t_end=1.0).events()
    assert [event.t for event in events] == [1.0]


@pytest.mark.parametrize(("sign", "time"), [(1.0, 0.25), (-1.0, 0.75)])
def test_an_event_is_where_a_witness_falls_through_zero(sign, time):
    """cos(2 pi t) falls at 0.25 s and rises at 0.75 s; its negative the other way."""
    events = go(Timer(lambda t: sign * math.cos(2 * math.pi * t))).events()
    assert [event.t for event in events] == pytest.approx([time], abs=1e-12)


def test_a_double_crossing_inside_a_long_step_is_found():
    """The witness dips below zero for 6 ms inside a step of 200 ms."""
    dip = Timer(lambda t: abs(t - 0.5) - 0.003)
    run = go(dip, RK4(0.2), stop_after=("g", 1))
    assert run.events()[0].t == pytest.approx(0.497, abs=1e-9)


def test_a_crossing_that_is_flat_is_found():
    """A triple root takes Brent's method more than SciPy's 100 iterations."""
    root = 1.0998  # in steps of 2 ms from 0.5 ms before it, where 100 iterations are too few
    flat = Timer(lambda t: (root - t) ** 3)
    run = go(flat, RK4(2e-3), t0=root - 5e-4, t_end=2.0)
    assert run.events()[0].t == pytest.approx(root, abs=1e-9)


def test_a_crossing_may_be_let_pass():
    """A reset that returns None refuses its event: the run goes on without one, x = t."""
    run = go(Timer(lambda t: 0.55 - t, accept=False))
    assert not run.events()
    assert run.status is Status.COMPLETED
    assert run.final_state == pytest.approx([1.0])


def test_a_terminal_guard_ends_the_run_with_its_status():
    """A guard with a status ends the run where its witness crosses zero, and resets nothing."""
    run = go(Timer(lambda t: 0.35 - t, terminal=Status.FELL))
    assert run.status is Status.FELL
    assert run.t_end == pytest.approx(0.35)
    assert run.events()[0].x_plus is None


def test_clock_ticks_are_counted_not_accumulated_and_restart_at_events():
    """Ticks are at k times 0.1 s bit for bit, not at steps of the method, 0.03 s; the event at 0.25 s begins
    mode 1, where the count starts anew, and without restart does not.
    """
    ticks = []

    def update(t, x, mode):
        ticks.append((mode, t))
        return x

    clock = Clock("c", 0.1, update)
    go(Timer(lambda t: 0.25 - t, clock=clock), RK4(0.03), t_end=0.5)
    assert ticks[:3] == [(0, 0.0), (0, 0.0 + 1 * 0.1), (0, 0.0 + 2 * 0.1)]
    after = [t - 0.25 for mode, t in ticks if mode == 1]
    assert after == pytest.approx([0.0, 0.1, 0.2], abs=1e-12)
    ticks.clear()
    go(
        Timer(lambda t: 0.25 - t, clock=Clock("c", 0.1, update, restart=False)),
        RK4(0.03),
        t_end=0.75,
    )
    # sums of 0.1 differ from multiples from the sixth on
    assert [t for _, t in ticks] == [0.0 + k * 0.1 for k in range(8)]


def test_order_at_equal_times_is_reset_tick_flow():
    """An impact and a tick at 0.2 s: the one tick there acts on the state after the reset, x = 0.2 + 100, in
    the new mode.
    """
    seen = []

    def update(t, x, mode):
        seen.append((mode, t, float(x[0])))
        return x

    go(Timer(lambda t: 0.2 - t, clock=Clock("c", 0.1, update)), t_end=0.3)
    at = [row for row in seen if row[1] == pytest.approx(0.2)]
    assert len(at) == 1
    assert at[0][0] == 1
    assert at[0][2] == pytest.approx(100.2)


def test_no_step_goes_across_a_switching_time():
    """x' jumps from 0 to 1 at 0.123 s, which no step of 0.05 s meets: x is exact only if a step ends there. The
    flow is asked for its limit from the left there, then again from the right.
    """

    class Switch(Timer):
        def flow(self, t, x, mode):
            return np.array([0.0 if t < 0.123 else 1.0])

    for method in (RK4(0.05), Adaptive()):
        run = go(Switch(lambda t: 1.0, switches=(0.123,)), method)
        assert run.final_state[0] == pytest.approx(1.0 - 0.123, abs=1e-12)
        assert run(0.06)[0] == pytest.approx(0.0, abs=1e-12)


def test_time_out_and_event_limit():
    """A run that is to stop at an event which does not come ends as TIME_OUT; a ball that bounces more often
    than max_events = 20 ends as EVENT_LIMIT.
    """
    assert go(Timer(lambda t: 1.0), stop_after=("g", 1)).status is Status.TIME_OUT
    zeno = simulate(Ball(), np.array([1.0, 0.0]), 0, RK4(0.05), t_end=50.0, max_events=20)
    assert zeno.status is Status.EVENT_LIMIT


def test_a_state_that_is_not_finite_ends_the_run_with_the_last_good_one():
    """The flow raises beyond 0.45 s: the step from 0.4 s is lost, and the run ends there with the status and
    the words of the error.
    """

    class Raises(Timer):
        def flow(self, t, x, mode):
            if t > 0.45:
                raise NotFiniteError("torque is nan")
            return np.ones(1)

    run = go(Raises(lambda t: 1.0), RK4(0.1))
    assert (run.status, run.detail) == (Status.NOT_FINITE, "torque is nan")
    assert run.t_end == pytest.approx(0.4)


@pytest.mark.parametrize("method", [Adaptive()])
@pytest.mark.parametrize(
    ("error", "status"),
    [
        (SingularError("D is singular"), Status.SINGULAR),
        (NotFiniteError("D is nan"), Status.NOT_FINITE),
        (RanAwayError("u is out of reach"), Status.RAN_AWAY),
    ],
)
def test_a_method_with_step_control_stops_where_the_flow_ends_and_says_why(method, error, status):
    """x' = 1 up to x = 0.5: longer steps are rejected, and what the flow said is what the run ends with."""

    class Wall(HybridSystem):
        def flow(self, t, x, mode):
            # a rejected step goes on to its other stages; their words must not replace the first ones
            if np.isnan(x[0]):
                raise NotFiniteError(
                    "the state is nan, as of every stage after the first that was lost"
                )
            if x[0] > 0.5:
                raise error
            return np.ones(1)

    run = go(Wall(), method)
    assert (run.status, run.detail) == (status, str(error))
    assert run.final_state[0] == pytest.approx(0.5, abs=1e-4)


def test_a_run_that_cannot_begin_or_end_is_refused():
    """A start of NaN, an end after the 0th event, no duration, an end at NaN, a negative step: all refused."""
    for wrong in (
        lambda: simulate(Ball(), np.array([math.nan, 0.0]), 0, RK4(), t_end=1.0),
        lambda: go(Timer(lambda t: 1.0), stop_after=("g", 0)),
        lambda: go(Timer(lambda t: 1.0), t_end=0.0),
        lambda: go(Timer(lambda t: 1.0), t_end=math.nan),
        lambda: RK4(-1.0),
    ):
        with pytest.raises(InputError):
            wrong()


def test_runs_are_stored_without_pickle_and_come_back_whole(tmp_path):
    """States come back bit for bit, modes by a function of the user (`int_mode`) from their numbers; a file
    that is cut off, missing or of another kind is refused by name.
    """
    run = simulate(Ball(), np.array([1.0, 0.0]), 0, RK4(1e-2), t_end=3.0, stop_after=("bounce", 3))
    save(run, tmp_path / "run.npz", {"note": "ball"})
    again = load(tmp_path / "run.npz", int_mode)
    assert again.status is run.status
    assert again.settings == {"method": "RK4, h = 0.01 s", "note": "ball"}
    for a, b in zip(run.arcs, again.arcs, strict=True):
        assert a.mode == b.mode
        assert np.array_equal(a.x, b.x)
        assert np.array_equal(a.event.x_plus, b.event.x_plus)
    assert np.array_equal(run.final_state, again.final_state)
    (tmp_path / "run.npz").write_bytes((tmp_path / "run.npz").read_bytes()[:200])
    (tmp_path / "run.json").write_text("{}")
    for name in ("run.npz", "none.npz", "run.json"):
        with pytest.raises(InputError, match=name):
            load(tmp_path / name)


def twice(x):
    return np.concatenate((x, x), axis=-1)


@pytest.mark.parametrize(
    "damage",
    [
        {"x1": lambda x: x[:-1], "dx1": lambda x: x[:-1]},
        {"dx1": twice},
        {"x_plus1": lambda x: x[:-1]},
        {"t1": lambda t: t[::-1]},
        {"t1": lambda t: t - 1.0},
        {"t1": lambda t: t + 1.0},
        {"x0": lambda x: x.astype(int)},
        {"dx0": lambda x: x / 0.0},
    ],
)
@pytest.mark.filterwarnings("ignore:.*divi.*:RuntimeWarning")
def test_a_stored_run_whose_arrays_do_not_fit_is_refused(tmp_path, damage):
    """damage: array of the file, with the number of its arc -> its change. In turn: an arc shorter than its
    times; twice too many rates; a short state after the event; times that fall, and that begin before or after
    the end of the arc before; integers; infinite rates.
    """
    run = simulate(Ball(), np.array([1.0, 0.0]), 0, RK4(0.1), t_end=9.0, stop_after=("bounce", 2))
    arrays = dict(np.load(save(run, tmp_path / "run.npz")))
    for name, change in damage.items():
        arrays[name] = change(arrays[name])
    np.savez(tmp_path / "run.npz", **arrays)
    with pytest.raises(InputError, match="arc"):
        load(tmp_path / "run.npz", int_mode)


def int_mode(*numbers):
    return int(numbers[0])


@pytest.mark.parametrize(
    ("meta", "text"),
    [
        ({"format": "another"}, "it has format 'another', expected '"),
        ({"events": []}, "there are events of 0 arcs"),
        # the second arc has no arrays in the file: their key is missing
        ({"events": [None, None]}, "the key"),
        ({"settings": {"method": 1}}, "its method or engine is not text"),
    ],
)
def test_a_damaged_run_is_refused_with_the_reason(tmp_path, meta, text):
    """meta: entries of the file's record that are replaced: its format, the events of its one arc (none, two),
    and settings that are no text.
    """

    class Still(HybridSystem):
        def flow(self, t, x, mode):
            return np.zeros(1)

    path = save(simulate(Still(), np.ones(1), 0, RK4(0.5), t_end=1.0), tmp_path / "run")
    arrays = dict(np.load(path))
    arrays["meta"] = np.array(json.dumps(json.loads(str(arrays["meta"])) | meta))
    np.savez(path, **arrays)
    with pytest.raises(InputError, match=rf"^run '{path}'.*{text}"):
        load(path)


def test_a_system_without_a_flow_and_a_slope_that_is_nan_are_named():
    """The base class has no motion of its own; step control cannot choose a first step by a slope of NaN, here
    at t = 2 s.
    """
    with pytest.raises(NotImplementedError, match="HybridSystem has neither a flow nor a mover"):
        HybridSystem().flow(0.0, np.zeros(1), 0)
    steps = Adaptive().steps(lambda t, x: np.full(1, np.nan), 2.0, np.zeros(1), 3.0)
    with pytest.raises(NotFiniteError, match="the slope is not finite at t = 2 s"):
        next(steps)
