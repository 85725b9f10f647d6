"""Policies across contact: each is its definition, in both engines; none of them acts where it must not.

A policy is a wrapper around a controller `inner` that acts near a touchdown. `Hold` starts the observer anew at
each tick (sample instant) of a window after it. `ImpactInvariant` removes from the rate error, or from the
observer's innovation, the part that an impulse of the ground on the striking foot can change.

`seen(t_step)` is a measurement at a random state about the gait's orbit, t_step [s] after the last touchdown.
`inside(h)` are the controllers with an observer around the gait's constraint h, and `off(law, m)` a state of
such a controller that differs from its initial state at m.
"""

from dataclasses import replace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.control.around import Hold
from biped_adrc.control.impact_invariant import ImpactInvariant
from biped_adrc.control.momentum_dob import MomentumDOBController
from biped_adrc.control.output_adrc import OutputADRCController
from biped_adrc.control.pd_gravity import PDGravityController
from biped_adrc.core.errors import InputError
from biped_adrc.scenario.build import build

PERIOD, SWAP = 1e-3, np.array([1, 0, 3, 2])
pytestmark = pytest.mark.filterwarnings(
    "ignore:the push from 0.1 to 0.8 s in single support 2 was cut"
)
PUSH = ba.TorquePulse([30.0, 20.0, -10.0, 15.0, 0.0], step=2, start=0.1, stop=0.8)
FAST = ba.GPIObserver.from_bandwidth(500.0)
WINDOWS = (Hold, ImpactInvariant)


@pytest.fixture(scope="module")
def h(gait):
    return gait.constraint


@pytest.fixture
def seen(biped, gait):
    """Measurements about the orbit, with body terms, t_step seconds after a touchdown."""
    random, walker = np.random.default_rng(8), ba.Walker(biped, ba.Passive())
    q, v = gait.start(biped)

    def at(t_step):
        x = q + 0.05 * random.normal(size=5), v + 0.5 * random.normal(size=5)
        m = walker.measure(3.0 + t_step, *x, ba.Mode(4, 3.0))
        return m._replace(body=biped.body_terms(*x))

    return at


def inside(h):
    """The controllers with an observer, and a state of each off its start."""
    return [
        ba.ADRCController(h, FAST),
        ba.ADRCController(h),
        OutputADRCController(h, FAST),
        MomentumDOBController(h),
    ]


def off(law, m, seed=1):
    s = law.initial_state(m)
    return s * (1.0 + 0.1 * np.random.default_rng(seed).normal(size=s.shape)) + 0.01


def walked(biped, gait, controller, impacts=2, engine="compiled", push=PUSH):
    walker = ba.Walker(biped, controller, push, ba.SampledTime(2 * PERIOD))
    walk = ba.walk(walker, gait, impacts, ba.RK4(2 * PERIOD), engine=engine).trajectory
    assert walk.status is ba.Status.COMPLETED
    assert walk.settings["engine"] == engine
    return walk


# -- definitions -------------------------------------------------------------------------------------
def test_held_the_observer_begins_anew_at_each_tick_of_the_window(h, seen):
    """At ticks less than 15 ms after a touchdown `correct` gives the initial state, else that of `inner`;
    `predict` and `jump` are those of `inner`.
    """
    for controller in inside(h):
        inner = controller.sampled(PERIOD)
        law = Hold(controller, 0.015).sampled(PERIOD)
        for t_step, held in ((0.0, True), (0.014, True), (0.015, False), (0.1, False)):
            m = seen(t_step)
            s = off(inner, m)
            expected = inner.initial_state(m) if held else inner.correct(s, m)
            assert np.array_equal(law.correct(s, m), expected)
            # m.v_b stands in for a torque: any four numbers
            assert np.array_equal(law.predict(s, m, m.v_b), inner.predict(s, m, m.v_b))
            assert np.array_equal(law.jump(s, m, SWAP), inner.jump(s, m, SWAP))


# -- what no impulse changes -------------------------------------------------------------------------
def struck(m, F, landed):
    """The rates (n,) after an impulse F (2,) of the ground on the swing foot, or on the stance foot, the
    other one free: D_e (q_e+' - q_e-') = E' F of (2), solved whole."""
    body, D = m.body, m.terms.D
    D_e = np.block([[D, body.F_a.T], [body.F_a, body.mass * np.eye(2)]])
    E = np.hstack((0.0 * body.J_2 if landed else body.J_2, np.eye(2)))
    jump = np.linalg.solve(D_e, E.T @ F)[:5]
    return m.v.reshape(5, *([1] * (F.ndim - 1))) + jump


@pytest.mark.parametrize("t_step", [0.01, 0.4])
def test_the_rate_error_that_is_fed_back_is_blind_to_impulses(biped, gait, h, seen, t_step):
    """u of K_d alone is the same at the rates before and after an impulse F on the striking foot; without the
    policy it is not.

    The rates after F are those of the whole robot with free feet (`struck`). t_step: 0.01 s after a touchdown
    the foot that landed strikes; at 0.4 s the phase expects the next touchdown, so it is the swing foot. An
    impulse on the other foot is not removed.
    """
    m, F = at_the_end(seen, gait, t_step), np.array([1.0, -2.0])
    landed = t_step < 0.015
    after = m._replace(v=struck(m, F, landed))
    for controller in (ba.NPDController(h), *inside(h)):
        law = ImpactInvariant(controller, 0.015).sampled(PERIOD)
        # `damping`: the torque that changes with K_d; bare: of the controller inside, without the policy
        fed = [damping(law, x) for x in (m, after)]
        bare = [damping(law.inner, x) for x in (m, after)]
        scale = np.max(np.abs(bare[1] - bare[0]))
        assert np.max(np.abs(fed[1] - fed[0])) < 1e-9 * scale
        other = damping(law, m._replace(v=struck(m, F, not landed)))
        assert np.max(np.abs(other - fed[0])) > 1e-3 * scale


def at_the_end(seen, gait, t_step):
    """A measurement with Theta at the end of the phase range, t_step after a touchdown."""
    m, q = seen(t_step), gait.q_minus
    biped = ba.Biped.load("rabbit")
    return m._replace(q=q, terms=biped.reduction(q, m.v), body=biped.body_terms(q, m.v))


def damping(law, m):
    """kappa times the part of u that K_d makes from the rate error, an observer inside as measured."""
    rates = []
    for K_d in (50.0, 100.0):
        with_gain = replaced(law, K_d)
        rates.append(m.terms.kappa @ with_gain.output(with_gain.initial_state(m), m))
    return rates[1] - rates[0]


def replaced(law, K_d):
    if isinstance(law, ImpactInvariant):
        return replace(law, inner=replaced(law.inner, K_d))
    return replace(law, gains=ba.Gains(5000.0, K_d))


def test_the_innovation_is_blind_to_what_impulses_move(gait, h, seen):
    """The observer's state after a measurement y and after y + N F dt is the same for the policy: N F is what
    an impulse F on the swing foot changes, dt one period.

    N F dt moves the angles; for the observer of the momentum the rates jump instead. Compared with the change
    without the policy. The torque is that of the controller inside.
    """
    F = np.array([1.0, -2.0])
    for controller in inside(h):
        # rates=False: the innovation alone is projected, not the rate error
        law = ImpactInvariant(controller, 0.015, rates=False, innovation=True).sampled(PERIOD)
        m = at_the_end(seen, gait, 0.4)
        s = off(law, m)
        moved = PERIOD * (struck(m, F, landed=False) - m.v)
        if type(controller) is MomentumDOBController:
            after = m._replace(v=m.v + moved)
        else:
            after = m._replace(q=m.q + moved)
        one, other, bare = law.correct(s, m), law.correct(s, after), law.inner.correct(s, after)
        change = np.max(np.abs(bare - law.inner.correct(s, m)))
        # the output form measures q_b - q_d(Theta), which is not linear in q: a little is left
        limit = 2e-2 if type(controller) is OutputADRCController else 1e-9
        assert np.max(np.abs(other - one)) < limit * change
        # a posture from the start of a step, 0.4 s after the last touchdown: outside the window
        away = m._replace(t_step=0.4, q=seen(0.4).q)
        for each in (m, away):
            assert np.array_equal(law.output(s, each), law.inner.output(s, each))


def test_the_innovation_that_no_impulse_makes_is_taken_whole(gait, h, seen):
    """A move of the angles by 1e-4 rad at right angles to all that an impulse (x, z) on the swing foot can
    change is corrected as without the policy: no more is removed than those two directions.
    """
    law = ImpactInvariant(ba.ADRCController(h, FAST), rates=False, innovation=True).sampled(PERIOD)
    m = at_the_end(seen, gait, 0.4)
    s, a = law.initial_state(m), struck(m, np.eye(2), landed=False) - m.v[:, np.newaxis]
    # of the four joints with motors, at right angles to both columns; the torso's angle stays
    across = np.append(np.linalg.svd(a[:4])[0][:, -1], 0.0)
    x = m._replace(q=m.q + 1e-4 * across)
    whole = law.inner.correct(s, x)
    assert np.max(np.abs(law.correct(s, x) - whole)) < 1e-9 * np.max(np.abs(whole - s))


def test_the_window_is_that_of_the_phase_and_of_the_touchdown(h, seen):
    """The window has 20 ms before and after the phase of impact, at the rate of now, and 20 ms after a
    touchdown.

    Only in it the policy's torque differs from that of the controller inside.
    """
    law = ImpactInvariant(ba.NPDController(h), 0.02)
    s, m = np.zeros(0), seen(0.3)
    # v: the random rates, with the sign with which the phase runs to its end
    c, v = h.phase, m.v * np.sign(h.theta_minus - h.theta_plus) * np.sign(h.phase @ m.v)
    # seconds: to the next touchdown by the phase, to which q is moved; blind: whether the policy acts
    for seconds, t_step, blind in (
        (0.019, 0.3, True), (0.021, 0.3, False), (-0.019, 0.3, True), (-0.021, 0.3, False),
        (0.1, 0.019, True), (0.1, 0.02, False),
    ):  # fmt: skip
        q = m.q + (h.theta_minus - seconds * (c @ v) - c @ m.q) * c / (c @ c)
        x = m._replace(q=q, v=v, t_step=t_step)
        assert np.array_equal(law.output(s, x), law.inner.output(s, x)) != blind


# -- walks -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("policy", WINDOWS)
def test_a_window_of_zero_length_changes_no_bit_of_the_walk(biped, gait, h, policy):
    """The window is that of `Hold` or `ImpactInvariant` around ADRC, under a push. One of 30 ms does change the
    walk, or else the policy would never act.
    """
    inner = ba.ADRCController(h, FAST)
    one, other = (walked(biped, gait, law) for law in (inner, policy(inner, 0.0)))
    none = walked(biped, gait, policy(inner, 0.03))
    for a, b in zip(one.arcs, other.arcs, strict=True):
        assert np.array_equal(a.x, b.x)
    assert not np.array_equal(one.arcs[-1].x[-1], none.arcs[-1].x[-1])


def test_a_hold_longer_than_a_step_is_the_law_of_the_model(biped, gait, h):
    """A hold of 5 s never ends, so ADRC has the xi of the model at each tick: under a push it walks as NPD, and
    without the hold otherwise. Compared are q and q' at the end.
    """
    npd, held, adrc = (
        walked(biped, gait, law).arcs[-1].x[-1][:10]
        for law in (
            ba.NPDController(h),
            Hold(ba.ADRCController(h, FAST), 5.0),
            ba.ADRCController(h, FAST),
        )
    )
    assert np.max(np.abs(held - npd)) < 1e-9
    assert np.max(np.abs(adrc - npd)) > 1e-4


# -- what is refused, and by name ----------------------------------------------------------------------
def test_wrong_inner_controllers_and_values_are_refused(biped, gait, h):
    """ImpactInvariant needs a rate error of a constraint, and with innovation=True an observer; Hold a window
    from 0 s, a controller inside, and sampled time.
    """
    for make in (
        lambda: ImpactInvariant(ba.Passive()),
        lambda: ImpactInvariant(ba.NPDController(h), innovation=True),
        # a PD law that does not read what an impulse changes
        lambda: ImpactInvariant(PDGravityController(h)),
        lambda: Hold(ba.NPDController(h), -0.01),
        lambda: Hold(h),
        # no period, so continuous time
        lambda: ba.walk_scenario(ba.Scenario({"name": "LESO", "contact": {"name": "hold"}})),
        # a wrong name of the policy
        lambda: build(
            ba.Scenario({"name": "LESO", "contact": {"name": "hodl"}}, hardware={"period": PERIOD})
        ),
    ):
        with pytest.raises(InputError):
            make()
    # a policy, and a controller that is in its discrete form already: both in continuous time
    for law in (Hold(ba.ADRCController(h)), ba.ADRCController(h).sampled(PERIOD)):
        for engine in ("pinocchio", "compiled"):
            with pytest.raises(InputError, match="sampled time only"):
                ba.walk(ba.Walker(biped, law), gait, 1, engine=engine)


def test_what_a_law_reads_of_an_impulse_is_said_by_the_names_of_its_methods(h):
    """A law that does not say so gets the names that it has to write; a name that no method has is refused."""
    for reads, said in (
        ((), "leave m.impulse out of its error in output, and name 'output' in reads_impulse"),
        (("output",), "out of its error in correct, and name 'correct' in reads_impulse"),
        (
            ("output", "corect"),
            r"reads_impulse of Own is \('output', 'corect'\), expected a tuple of",
        ),
    ):
        own = type("Own", (ba.NPDController,), {"reads_impulse": reads})(h)
        with pytest.raises(InputError, match=said):
            ImpactInvariant(own, innovation=True)
