"""The words for claims, on made-up outcomes; and the set on which they rest."""

import itertools
import math
from dataclasses import replace
from importlib.resources import files

import numpy as np
import pytest

from biped_adrc.observer_design.observer_loop import observer_loop
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.paper.claims import evidence, rows_gait, rows_push
from biped_adrc.paper.claims.admissible import Member, convergence, declared, members
from biped_adrc.paper.claims.evidence import GaitCycle, Jumps, Needs, Pair, Start
from biped_adrc.paper.claims.orders import Order, bandwidth_with
from biped_adrc.paper.claims.table import rows
from biped_adrc.paper.claims.tally import AtTwoSteps, ClaimCase, Tally, below_limit
from biped_adrc.paper.claims.tasks import Evidence
from biped_adrc.paper.claims.walks import (
    MemberOutcome,
    MemberWalk,
    Prepared,
    Track,
    _ending,
    _undisturbed,
    nominal,
    prepared,
    tried,
)
from biped_adrc.paper.claims.words import MEANINGS, claim_checks
from biped_adrc.paper.push_map import Fate, PushCell
from biped_adrc.viz.pages import CLAIM_COLUMNS

NUMERICS = {
    "tracking error per unit disturbance on a held joint, simulated [s^2]": 2e-5,
    "the same at half the step [s^2]": 2e-5,
    "the same by (23) corrected [s^2]": 2e-5,
    "the same by (23) as printed [s^2]": 1e-5,
}


def figure(value, change=1e-3):
    return AtTwoSteps(value * (1.0 + change), value)


def walk(error, *, made=4, rate=1e-9, change=1e-3, period=0.4, infeasible=None):
    status = "COMPLETED" if made == 4 else "FELL"
    f = figure(error, change)
    return MemberWalk(status, made, 4, f, f, figure(rate), figure(period), infeasible or {})


def outcome(npd=None, adrc=None, member=None):
    npd, adrc = npd or walk(1e-2, rate=1e-3), adrc or walk(1e-6)
    return MemberOutcome(member or members()[0], {"NPD": npd, "ADRC": adrc})


def of(rule, odd, usual=5):
    """The claim of a rule on some usual outcomes and an odd one."""
    return rule([outcome()] * usual + [odd])


# -- the set -------------------------------------------------------------------------------------
def test_the_set_is_in_the_package_and_is_balanced():
    assert files("biped_adrc.paper.claims").joinpath("admissible.toml").is_file()
    found, factors = members(), declared()["factors"]
    assert len(found) == len(set(found)) == 36
    assert found == members()
    for one, other in itertools.combinations(factors, 2):
        count = {}
        for m in found:
            pair = getattr(m, one), getattr(m, other)
            count[pair] = count.get(pair, 0) + 1
        assert len(count) == len(factors[one]) * len(factors[other])
        assert len(set(count.values())) == 1, (one, other)


def test_a_member_carried_out_is_what_it_says():
    member = Member("identified", 30.0, 0.12, ("q3", "q4"), 0.01, "zero", "printed")
    run = member.run("ADRC", 1e-4, 4)
    law = run.controller
    assert (law.solve_theta, law.observer.reset) == (False, "measured")
    assert run.run.first_step == 19
    assert run.pushes[0].rise == 0.01
    assert run.pushes[0].factors == {"q3": 30.0, "q4": 30.0}
    done = tried(member)
    assert done.walked["ADRC"].made
    assert done.walked["NPD"].made
    assert done.rejection.at_half < 1e-4 < 0.05 < done.tracking.at_half
    assert done.rejection.converged(*convergence())
    for one in done.walked.values():  # made at two steps, not twice at one
        assert one.peak.change > 0.0


def test_an_observer_that_starts_at_zero_knows_the_rates_and_no_disturbance():
    run = Member("identified", 30.0, 0.12, ("q3",), 0.0, "zero", "solved").run("ADRC", 1e-4)
    for zero in (True, False):
        made = prepared(run, zero)
        q, v, s = made.walker.split_state(made.x0)
        found = made.walker.controller.observer.estimate(s)
        assert np.array_equal(found.position, q[:4])
        assert found.velocity == pytest.approx(v[:4], rel=1e-12)
        assert np.any(found.disturbance) != zero


def test_a_deviation_is_taken_from_the_onset_on_against_the_walk_without_a_push():
    t = np.linspace(0.0, 1.0, 101)
    slope = np.tile([1.0, -1.0], (101, 1))
    usual = Track(t, np.column_stack((t, -t)), slope, -1.0, 1.0)
    pushed = usual.error + np.where((t > 0.5)[:, np.newaxis], [[0.0, 0.25]], [[3.0, 3.0]])
    found = Track(t, pushed, slope, -1.0, 1.0).away_from(usual, 0.505)
    assert found == pytest.approx(0.25, abs=1e-12)


def test_peaks_lie_between_the_nodes():
    """Of sin(t) on nodes around its peak, and of its deviation from a walk on other nodes."""
    t, other = np.linspace(0.0, 3.0, 10), np.linspace(0.0, 3.0, 31)
    one = Track(t, np.sin(t)[:, None], np.cos(t)[:, None], -1.0, 3.0)
    assert np.max(np.abs(one.error)) < 0.996
    assert one.peak == pytest.approx(1.0, abs=1e-3)
    usual = Track(other, other[:, None] ** 2, 2.0 * other[:, None], -1.0, 3.0)
    pushed = one._replace(error=one.error + t[:, None] ** 2, derror=one.derror + 2.0 * t[:, None])
    assert pushed.away_from(usual, 0.0) == pytest.approx(1.0, abs=1e-3)


def test_a_walk_is_taken_from_the_undisturbed_one_at_either_step():
    """Two tracks, each at its own step, that nobody can change for the others."""
    of = ("identified", "NPD", "published", "model", "solved")
    h = declared()["steps"]["NPD"]
    usual, half = (_undisturbed(*of, step) for step in (h, 0.5 * h))
    assert len(half.t) > 1.9 * len(usual.t)
    with pytest.raises(ValueError, match="read-only"):
        usual.error[0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        nominal("identified", "published")[1].q_minus[0] = 1.0


def test_a_walk_that_is_not_finite_is_not_feasible(monkeypatch):
    run = Member("identified", 30.0, 0.12, ("q3",), 0.0, "model", "solved").run("NPD", 1e-3)
    made = prepared(run)
    walk = made.simulate(1e-3, 1)
    arc = walk.arcs[0]
    lost = replace(walk, arcs=(replace(arc, x=np.full_like(arc.x, np.nan)),))
    monkeypatch.setattr(Prepared, "simulate", lambda *_: lost)
    assert _ending(made, 1e-3).infeasible == {"normal_force": "not finite"}


# -- cases and tallies -----------------------------------------------------------------------------
def test_a_number_is_judged_at_both_steps():
    just = below_limit("a", AtTwoSteps(0.0099, 0.0101), 0.01, (0.05, 0.0))
    assert just.marginal
    assert not below_limit("a", AtTwoSteps(0.0098, 0.0099), 0.01, (0.05, 0.0)).marginal
    assert below_limit("a", AtTwoSteps(0.002, 0.001), 0.01, (0.01, 1e-9)).marginal
    assert not below_limit("a", AtTwoSteps(2e-10, 1e-10), 0.01, (0.01, 1e-9)).marginal
    infinite = below_limit("a", AtTwoSteps(math.inf, math.inf), 0.01, (0.01, 1e-9))
    assert (infinite.holds, infinite.marginal) == (False, False)
    nothing = below_limit("a", AtTwoSteps(math.nan, math.nan), 0.01, (0.01, 1e-9))
    assert (nothing.holds, nothing.marginal) == (False, True)  # a search that failed says nothing
    assert below_limit("a", AtTwoSteps(math.nan, 0.001), 0.01, (0.01, 1e-9)).marginal


def test_a_tally_counts_what_is_firm():
    good, bad = ClaimCase("g", figure(1.0), True), ClaimCase("b", figure(1.0), False)
    doubtful = ClaimCase("m", figure(1.0), True, marginal=True)
    assert Tally((good,) * 4).word == "replicated"
    assert Tally((good, bad)).word == "depends"
    assert Tally((bad, bad)).word == "contradicted"
    assert Tally((good, good, doubtful)).word == "depends"
    assert "marginal: m" in Tally((good, good, doubtful)).share
    assert Tally((doubtful,)).word == "not testable"
    assert Tally(()).word == "not testable"


def test_the_interval_is_wilson_s():
    z, n, k = 1.959963984540054, 36, 18
    p = k / n
    middle = (p + z * z / (2 * n)) / (1 + z * z / n)
    half = z * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n)) / (1 + z * z / n)
    tally = Tally(tuple(ClaimCase("c", figure(1.0), i < k) for i in range(n)))
    assert f"between {middle - half:.2f} and {middle + half:.2f}" in tally.share
    assert tally.share.startswith("18 of 36")


# -- the push --------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("odd", "word"),
    [
        (outcome(), "replicated"),
        (outcome(adrc=walk(1.01e-4)), "depends"),  # a ratio of 0.0101
        (outcome(adrc=walk(0.99e-4)), "replicated"),
        (outcome(adrc=walk(math.nan)), "depends"),
        (outcome(adrc=walk(1e-6, change=0.02)), "depends"),  # marginal
        (outcome(npd=walk(0.0)), "depends"),  # NPD does not deviate: nothing to be rejected
    ],
)
def test_rejection(odd, word):
    for rule in (rows_push.rejection, rows_push.tracking):
        claim = of(rule, odd)
        assert claim.word == word
        converged, *checks = claim_checks([claim])
        assert converged.holds == ("marginal" not in claim.share)
        if rule is rows_push.rejection:
            assert [check.holds for check in checks] == [word == "replicated"]
        else:
            assert checks == []
    assert of(rows_push.rejection, outcome(adrc=walk(1.0)), usual=0).word == "contradicted"


def test_the_cycle_after_the_push():
    assert of(rows_push.unaffected, outcome()).word == "replicated"
    assert of(rows_push.unaffected, outcome(adrc=walk(1e-6, rate=1.1e-5))).word == "depends"
    assert of(rows_push.unaffected, outcome(adrc=walk(1e-6, rate=-1.1e-5))).word == "depends"


def cell(npd, adrc, doubtful=False):
    fates = (Fate(x, "FELL" if x == "fell" else "COMPLETED", 100.0, 0.4, 0.5) for x in (npd, adrc))
    one, other = fates
    return PushCell("identified", 0.1, 90.0, "all +", None, one, replace(other, marginal=doubtful))


@pytest.mark.parametrize(
    ("cells", "word", "number"),
    [
        ([("fell", "feasible")], "replicated", "lost in 1 of 1"),
        ([("fell", "feasible"), ("ended", "fell")], "depends", "lost in 2 of 2"),
        ([("fell", "infeasible")], "contradicted", "walks on in 1, feasible in 0"),
        ([("fell", "but_impact")], "replicated", "feasible but for the impact in 1"),
        ([("fell", "fell"), ("feasible", "fell")], "contradicted", "ADRC alone is lost in 1"),
        ([("feasible", "feasible")], "not testable", "lost in 0 of 1"),
    ],
)
def test_a_critical_phase_is_judged_over_the_map(cells, word, number):
    claim = rows_push.critical_phase([outcome()], [cell(*fates) for fates in cells])
    assert claim.word == word
    assert number in claim.number
    table = rows(EVIDENCE, NUMERICS, MADE, 1e-5, [cell(*fates) for fates in cells])
    assert [c.word for c in table if "critical phase" in c.claim] == [word]


# -- the controller --------------------------------------------------------------------------------
def pair(ratio=1.0, *, made=True, name="identified, 20 N m on the torso", same=True):
    peaks = {"NPD": figure(1e-2), "ADRC": figure(1e-2 * ratio)}
    return Pair(name, peaks, peaks, {"NPD": made, "ADRC": made}, same)


def order(name, gain, noise, m=1):
    return Order(name, m, 500.0, gain, noise, 1e-3, 1e-6, 1e-5, figure(1e-4))


# -- the gait --------------------------------------------------------------------------------------
def cycle(multiplier=0.7, rate=-1.25, gait="published", controller="NPD"):
    f, r = figure(multiplier, 1e-5), figure(rate, 1e-6)
    return GaitCycle("c", "identified", gait, controller, "solved", f, r, 0.4)


@pytest.mark.parametrize(
    ("multiplier", "word"),
    [(0.999, "replicated"), (1.001, "depends"), (1.0, "depends"), (math.nan, "depends")],
)
def test_stability(multiplier, word):
    odd = cycle()._replace(multiplier=AtTwoSteps(multiplier, multiplier))
    for rule in (rows_gait.stable, rows_gait.recipe_stable):
        claim = rule([cycle(), odd])
        assert claim.word == word
        assert claim_checks([claim])[1].holds == (word == "replicated")


def need(gait="recipe", *, impulse=0.5, cost=1.0, jump=1.0, infeasible=None):
    return Needs(
        f"{gait}",
        "identified",
        gait,
        figure(0.5),
        figure(0.5),
        figure(impulse),
        figure(100.0),
        figure(cost, 1e-5),
        figure(10.0),
        jump,
        infeasible or {},
        figure(100.0),
    )


# -- the table -------------------------------------------------------------------------------------
EVIDENCE = Evidence(
    members=(outcome(),) * 3,
    cycles=(cycle(), cycle(gait="recipe"), cycle(gait="recipe", controller="ADRC")),
    needs=(need(cost=1.1), need("published")),
    unmatched=(pair(), pair(name="identified, 120 N m on the torso", made=False)),
    uncertainty=(pair(0.5),),
    pushed_recipe=(outcome(),),
    basin=(
        Start("b", 0.58, 0.97, {"NPD": 0, "ADRC": 0}, 3),
        Start("a", 0.58, 1.03, {"NPD": 3, "ADRC": 3}, 3),
    ),
    jumps=(Jumps("identified", 20.0, 30.0),),
    orders=(
        order("Table I", 2.0, 0.5, 7),
        order("m = 1, equal bandwidth", 1.0, 1.0),
        order("m = 1, equal delay margin", 1.0, 1.0),
    ),
)
MADE = {"NPD": (25, 25), "ADRC": (25, 25)}


def test_every_claim_has_a_row_with_every_column():
    table = rows(EVIDENCE, NUMERICS, MADE, 1e-5)
    assert len(table) == len({claim.claim for claim in table}) > 30
    assert {claim.word for claim in table} == set(MEANINGS)
    for claim in table:
        assert tuple(claim.record()) == CLAIM_COLUMNS
        assert claim.claim
        assert claim.where
        assert claim.number
        assert claim.reason
    assert all(check.holds for check in claim_checks(table))
    assert {check.kind for check in claim_checks(table)[1:]} == {"reproduced"}


def test_one_bad_member_breaks_one_claim_and_its_check():
    bad = replace(EVIDENCE, members=(*EVIDENCE.members, outcome(adrc=walk(1.01e-4))))
    words = {
        name: {claim.claim: claim.word for claim in rows(e, NUMERICS, MADE, 1e-5)}
        for name, e in (("good", EVIDENCE), ("bad", bad))
    }
    changed = [c for c, word in words["good"].items() if words["bad"][c] != word]
    assert len(changed) == 2  # rejection, and what figure 5 shows
    broken = [c for c in claim_checks(rows(bad, NUMERICS, MADE, 1e-5)) if not c.holds]
    assert len(broken) == 1
    assert broken[0].value == 0.75


# -- the runs --------------------------------------------------------------------------------------
def test_the_least_speed_of_the_zero_dynamics_parts_the_starts():
    below, above = evidence.basin("identified-bare")
    assert below.impacts == {"NPD": 0, "ADRC": 0}
    assert above.impacts == {"NPD": 3, "ADRC": 3}
    assert 0.5 < below.least < 0.65


def test_the_needs_of_the_recipe():
    a, b = evidence.needs("identified")
    assert not a.infeasible
    assert b.infeasible
    assert b.friction_at_an_instant.at_half == pytest.approx(0.57, abs=0.005)
    assert b.friction.at_half <= b.friction_at_an_instant.at_half
    assert b.torque.at_half == pytest.approx(315.0, rel=0.01)
    assert a.rate_jump < 1e-9 < 1.0 < b.rate_jump


def test_a_torque_on_the_torso_and_a_heavier_plant():
    *slow, fatal = evidence.unmatched("tac2003")
    assert [p.made for p in slow] == [{"NPD": True, "ADRC": True}] * 2
    assert fatal.made == {"NPD": False, "ADRC": False}
    for p in slow:
        assert p.delay["ADRC"].at_half == pytest.approx(p.delay["NPD"].at_half, rel=0.02)
        assert p.peak["ADRC"].at_half < 0.5 * p.peak["NPD"].at_half


def test_a_tracking_error_decays_by_the_gains_of_table_two():
    poles = np.roots([1.0, 50.0, 5000.0])
    assert evidence.fastest_decay(0.4) == pytest.approx(np.exp(0.4 * poles.real.max()))
    assert evidence.fastest_decay(evidence.longest_step(0.138)) == pytest.approx(0.138)


def test_noise_gives_a_spectrum_inside_the_unit_circle():
    medians = evidence.noise_spectrum()
    assert np.array_equal(medians, evidence.noise_spectrum())
    assert np.all(np.diff(medians) < 0)
    assert 0.1 < medians[-1] < medians[0] < 0.8


def test_an_observer_with_a_given_margin():
    bandwidth = bandwidth_with(1e-3, 1)
    margin = observer_loop(GPIObserver.from_bandwidth(bandwidth, 1)).delay_margin().delay
    assert margin == pytest.approx(1e-3, rel=1e-6)
