"""The words for claims, on made-up results; the set on which they rest, and what is walked for them.

A claim of the paper is judged over members: 36 combinations of choices that the paper leaves open. A walk has
each number at the integration step used and at half of it (`at_half`); a number that changes by more than 1 %
is marginal. A claim holds for all members (replicated), for some (depends), or for none (contradicted).

`results(**odd)` are made-up results with which all checks hold, but for the entries `odd`; `judge(name, **odd)`
is the row of one claim on them. `walk(error)` has this tracking error [rad] under the push, and `member(npd,
adrc)` such a walk under each controller: by default 1e-2 rad under NPD, of which ADRC may have 1 %, and 1e-6;
`with_member(m)` are six members of which m is the first. `figure(x)` is x at both steps, `cell(npd, adrc)` a
push with these endings, `outcome(controller, peak)` a run with this largest error.
"""

import itertools
import math
from types import SimpleNamespace

import numpy as np
import pytest

import biped_adrc as ba
from biped_adrc.analysis.half_step import ROUND_OFF, AtTwoSteps
from biped_adrc.analysis.observer.loop import ObserverLoop
from biped_adrc.observers.gpi import GPIObserver
from biped_adrc.paper import pushes as member_runs
from biped_adrc.paper import runs
from biped_adrc.paper.metrics import longest_step
from biped_adrc.paper.scenarios import (
    CONTROLLERS,
    GAITS,
    Member,
    by_rk4,
    declared,
    members,
)
from biped_adrc.paper.table import (
    Probe,
    all_texts,
    checks,
    claim_checks,
    findings,
    limit,
    row_of,
    rows,
    share_text,
    tally,
    word_of_claim,
)
from biped_adrc.paper.values import noise_spectrum, of_members, of_starts
from biped_adrc.view.pages import CLAIM_COLUMNS

from .made_up_results import cell, cycle, figure, member, outcome, results, walk


def judge(name, **odd):
    return row_of(all_texts()[name], results(**odd))


def with_member(odd):
    """The declared choices, one of them with another outcome."""
    return {"members": {"identified": [odd, *(member(of=m) for m in members()[1:6])]}}


# -- the set -------------------------------------------------------------------------------------
def test_the_set_is_balanced():
    """Of any two factors each pair of values is in equally many of the 36 members, and no member is there
    twice."""
    found, factors = members(), declared()["factors"]
    assert len(found) == len(set(found)) == 36
    for one, other in itertools.combinations(factors, 2):
        count = {}
        for m in found:
            pair = getattr(m, one), getattr(m, other)
            count[pair] = count.get(pair, 0) + 1
        assert len(count) == len(factors[one]) * len(factors[other])
        assert len(set(count.values())) == 1, (one, other)


def test_the_walks_of_a_member_have_the_choices_in_its_name():
    """Seven choices become a scenario: 30 N m on q3 and q4 from 0.12 s on with edges of 10 ms, an observer
    that starts at zero, (20) as printed. On its walks the deviation, which leaves out the errors that (20)
    makes without a push, is tiny under ADRC, while the peak, which has them, is not."""
    chosen = Member("identified", 30.0, 0.12, ("q3", "q4"), 0.01, "zero", "printed")
    run = chosen.run("ADRC")
    assert not run.controller.solve_theta
    assert run.controller.observer.reset == "measured"
    assert run.run.first_step == 19
    assert run.pushes[0].rise == 0.01
    assert run.pushes[0].factors == {"q3": 30.0, "q4": 30.0}
    (done,) = member_runs.member_outcomes((chosen,))
    npd, adrc = (done.walked[c] for c in CONTROLLERS)
    # the longest walking step [s], infinite where the walk ends early
    assert npd.longest.at_half == pytest.approx(adrc.longest.at_half, rel=0.1) != math.inf
    ratio = adrc.deviation.over(npd.deviation)
    assert ratio.at_half < 1e-4 < 0.05 < adrc.peak.over(npd.peak).at_half
    assert ratio.converged()
    for one in (npd, adrc):  # made at two steps, not twice at one
        assert one.peak.gap() > 0.0
        assert one.broken == (0.0, 0.0)  # no limit is broken at either


@pytest.mark.parametrize("zero", [True, False])
def test_an_observer_that_starts_at_zero_knows_the_rates_and_no_disturbance(zero):
    """Only the estimate of the disturbance starts at 0 instead of the model's; angles and rates are those
    measured either way."""
    run = Member("identified", 30.0, 0.12, ("q3",), 0.0, "zero", "solved").run("ADRC", pushed=False)
    # 4.0: with 4 times the integration step, as only the start is looked at
    (made,) = member_runs.in_two(run, zero, 4.0)
    q, v, s = made.walker.split_state(made.trajectory.arcs[0].x[0])
    found = made.walker.controller.observer.estimate(s)
    assert np.array_equal(found.position, q[:4])
    assert found.velocity == pytest.approx(v[:4], rel=1e-12)
    assert np.any(found.disturbance) != zero


def test_a_deviation_is_taken_from_the_onset_on_against_the_walk_without_a_push():
    """The error with a push is 3 rad off before 0.505 s, the onset, which does not count, and 0.25 rad off
    after it, which does."""
    t = np.linspace(0.0, 1.0, 101)
    slope = np.tile([1.0, -1.0], (101, 1))
    # times, errors, their rates, and Theta' before the impact (-1.0), which is not used here
    usual = member_runs.Track(t, np.column_stack((t, -t)), slope, -1.0)
    pushed = usual.error + np.where((t > 0.5)[:, np.newaxis], [[0.0, 0.25]], [[3.0, 3.0]])
    assert member_runs.Track(t, pushed, slope, -1.0).away_from(usual, 0.505) == pytest.approx(0.25)


def test_peaks_lie_between_the_nodes():
    """The peak of sin(t) is 1, though no node (stored instant) has more than 0.996; the same for its deviation
    from a walk that has other nodes."""
    t, other = np.linspace(0.0, 3.0, 10), np.linspace(0.0, 3.0, 31)
    # times, errors, their rates, and Theta' before the impact (-1.0), which is not used here
    one = member_runs.Track(t, np.sin(t)[:, None], np.cos(t)[:, None], -1.0)
    assert np.max(np.abs(one.error)) < 0.996
    assert one.peak == pytest.approx(1.0, abs=1e-3)
    usual = member_runs.Track(other, other[:, None] ** 2, 2.0 * other[:, None], -1.0)
    pushed = one._replace(error=one.error + t[:, None] ** 2, derror=one.derror + 2.0 * t[:, None])
    assert pushed.away_from(usual, 0.0) == pytest.approx(1.0, abs=1e-3)


def test_a_sparse_walk_keeps_all_nodes_of_the_push_and_of_the_support_after_it():
    """To save memory, of later supports (arcs) less than a quarter of the nodes is left; the outcome is the
    same. The first two arcs have the push and what it leaves behind."""
    run = Member("identified", 30.0, 0.12, ("q3",), 0.0, "model", "solved").run(
        "NPD", **{"run.h": 1e-4}
    )
    whole = runs.walk_scenario(run)
    found = runs.sparse(whole)
    count = [[len(arc.t) for arc in w.trajectory.arcs] for w in (whole, found)]
    assert count[0][:2] == count[1][:2]
    assert all(b < 0.25 * a for a, b in zip(count[0][2:], count[1][2:], strict=True))
    assert found.outcome.peak_error == whole.outcome.peak_error
    assert found.outcome.peak_torque == pytest.approx(whole.outcome.peak_torque, rel=1e-3)


# -- cases and words -------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("value", "half", "holds", "marginal"),
    [
        (0.00999, 0.01001, False, True),  # another verdict
        (0.00989, 0.0099, True, False),
        (0.002, 0.001, True, True),  # not converged
        (2e-10, 1e-10, True, False),  # round-off
        (math.inf, math.inf, False, False),
        (math.nan, math.nan, False, True),  # a search that failed says nothing
        (math.nan, 0.001, True, True),
    ],
)
def test_a_number_is_judged_at_both_steps(value, half, holds, marginal):
    """The limit is 0.01. A case holds by its value at half the step; it is marginal if the two steps have
    another verdict or differ by more than 1 %, unless by less than round-off, 1e-9."""
    case = Probe.of("a", AtTwoSteps(value, half), limit("<= 0.01"), ROUND_OFF, "a")
    assert (case.holds, case.marginal) == (holds, marginal)


def test_words_count_what_is_firm_and_the_share_has_no_interval():
    """A marginal case counts as not kept; it makes a claim depend, and without a firm case nothing is
    testable. The share is a plain count, as nothing was drawn at random."""
    good, bad, doubtful = (
        Probe(name, figure(1.0), holds, marginal, name)
        for name, holds, marginal in (("g", True, False), ("b", False, False), ("m", True, True))
    )
    assert word_of_claim((good,) * 4) == "replicated"
    assert word_of_claim((good, bad)) == "depends"
    assert word_of_claim((bad, bad)) == "contradicted"
    assert word_of_claim((good, good, doubtful)) == "depends"
    assert word_of_claim((doubtful,)) == word_of_claim(()) == "not testable"
    assert share_text((good, good, bad), apart=True) == "2 of 3: g 2 of 2; b 0 of 1"
    assert share_text((good, doubtful), apart=False) == "1 of 2; marginal: m"


# -- single claims ---------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("odd", "word"),
    [
        (member(), "replicated"),
        (member(adrc=walk(1.01e-4)), "depends"),  # a ratio of 0.0101
        (member(adrc=walk(0.99e-4)), "replicated"),
        (member(adrc=walk(math.nan)), "depends"),
        (member(adrc=walk(1e-6, change=0.02)), "depends"),  # marginal
        (member(npd=walk(0.0)), "depends"),  # NPD does not deviate: nothing to be rejected
    ],
)
def test_verdict_on_the_claims_of_rejection_and_tracking(odd, word):
    """One of six members is odd. A ratio ADRC over NPD above 0.01, of no number, not converged or over zero
    makes "depends"; the check that all steps converged, and that of rejection, which is asserted, break
    with it."""
    for name in ("rejection", "tracking"):
        row = judge(name, **with_member(odd))
        assert row.word == word
        converged, *checks = claim_checks([row])
        assert converged.holds == ("marginal" not in row.share)
        assert [check.holds for check in checks] == [word == "replicated"] * (name == "rejection")


def test_figure_5_depends_on_one_choice_alone():
    """A member with Theta'' solved for tracks, one with (20) as printed does not: the share has to name that
    choice."""
    one, other = (next(m for m in members() if m.theta == x) for x in ("solved", "printed"))
    chosen = [member(of=one), member(adrc=walk(1e-2), of=other)]
    row = judge("tracking", members={"identified": chosen})
    assert row.share == "1 of 2: Theta'' solved 1 of 1; (20) as printed 0 of 1"


@pytest.mark.parametrize(
    ("rate", "word"), [(1e-9, "replicated"), (1.1e-5, "depends"), (math.inf, "depends")]
)
def test_the_claim_that_the_cycle_is_unaffected_needs_its_rate_after_the_push(rate, word):
    """Theta' at the impact after the push may differ by 1e-5 rad/s from that of the walk without it."""
    odd = with_member(member(adrc=walk(1e-6, rate=rate)))
    assert judge("unaffected", **odd).word == word


@pytest.mark.parametrize(
    ("fates", "word", "number"),
    [
        ([("fell", "feasible")], "replicated", "lost in 1 of 1"),
        ([("fell", "feasible"), ("ended", "fell")], "depends", "lost in 2 of 2"),
        (
            [("fell", "infeasible")],
            "contradicted",
            "walks on in 1, feasible, the impact aside, in 0",
        ),
        ([("fell", "but_impact")], "replicated", "feasible, the impact aside, in 1"),
        ([("fell", "fell"), ("feasible", "fell")], "contradicted", "alone is lost in 1"),
        ([("feasible", "feasible")], "not testable", "lost in 0 of 1"),
    ],
)
def test_a_critical_phase_is_judged_over_the_map(fates, word, number):
    """`fates`: how the walk under (NPD, ADRC) ends, by push. Only pushes under which NPD is lost count; the
    claim holds for those where ADRC walks on, feasible but perhaps for the impact ("but_impact")."""
    row = judge("critical_phase", map={"": [cell(*x, onset=k) for k, x in enumerate(fates)]})
    assert row.word == word
    assert number in row.number


@pytest.mark.parametrize(
    ("multiplier", "word"),
    [(0.999, "replicated"), (1.001, "depends"), (1.0, "depends"), (math.nan, "depends")],
)
@pytest.mark.parametrize(("name", "gait"), [("stable", "a"), ("recipe_stable", "b")])
def test_verdict_on_the_claims_of_stability(name, gait, multiplier, word):
    """One cycle of the gait has another largest |multiplier|: stable means below 1, and 1 or no number is
    not."""
    row = judge(name, cycles={f"gait ({gait}), identified, odd": cycle(multiplier)})
    assert row.word == word
    # the check after the one of doubtful cases, which is always there
    assert claim_checks([row])[1].holds == (word == "replicated")


def test_a_finding_beyond_the_paper_names_the_torque_that_stops_the_walk():
    """Of the made-up walks with torques on the torso, from 20 to 120 N m, only those with 120 N m end early,
    under both controllers."""
    odd = {f"120 N m on the torso, identified {c}": outcome(c, impacts=1) for c in CONTROLLERS}
    (said,) = (x for x in findings(results(claim_runs=odd), []) if "torso" in x)
    assert "120 N m (identified); NPD does alike" in said


def test_an_intention_without_a_measure_has_no_verdict_and_a_check_beside_it():
    """The paper gives no limit for heavier plants, so the claim is not testable; a check of its own, ADRC's
    error below NPD's 1e-2 rad, holds at 5e-3 and breaks at 2e-2 rad."""

    def found(peak):
        kinds = ("masses", "masses and inertias")
        made = results(runs={f"heavier, {kind} ADRC": outcome("ADRC", peak) for kind in kinds})
        row = row_of(all_texts()["model_uncertainty"], made)
        assert (row.word, row.limit, row.share) == ("not testable", "", "")
        return row.number, [
            x.holds for x in checks(made, []) if "heavier" in x.name and "ADRC over" in x.name
        ]

    assert found(5e-3) == ("heavier plant: ADRC's largest error is 0.50 of NPD's", [True, True])
    assert found(2e-2)[1] == [False, False]


PAPER = {
    "tends_to_zero": "tend asymptotically to zero if: 1) the estimation errors tend to zero, 2) and",
    "pinned_at_impact": "If the hypothesis that the impact is totally plastic is accepted, it would",
    "critical_phase": "if the system is exposed to external disturbances in a critical phase",
    "model_uncertainty": "intended to keep the tracking error close to zero, reject the external",
}
"""The condition in the paper's own words, by claim."""


@pytest.mark.parametrize("name", PAPER)
def test_a_claim_is_quoted_with_its_condition(name):
    """A quotation without its "if" would claim more than the paper: `PAPER` has, by claim, the words of the
    condition."""
    row = judge(name)
    assert PAPER[name] in row.claim
    assert row.word != "contradicted"


def test_what_is_contradicted_is_smoothness_global_stability_and_the_printed_multipliers():
    """The made-up results, with which every check holds, contradict exactly these three claims, in this
    order: by a jump at impact, a start that is too slow, and a period too long for the printed
    multipliers."""
    found = [row.claim for row in rows(results()) if row.word == "contradicted"]
    named = zip(("smooth in all", "Global stability", "|lambda(Phi)|"), found, strict=True)
    assert all(name in claim for name, claim in named)


# -- the table -------------------------------------------------------------------------------------
def test_every_claim_has_a_row_with_every_column():
    """28 claims, each with its words filled in (no brace of a template is left), and the tally counts all of
    them."""
    table = rows(results())
    assert len(table) == len({row.claim for row in table}) == 28
    assert {row.word for row in table} <= set(all_texts()["words"])
    for row in table:
        assert set(CLAIM_COLUMNS) < set(row._fields)
        assert row.claim
        assert row.where
        assert row.number
        assert row.reason
        assert "{" not in row.number + row.reason + row.finding
    assert all(check.holds for check in claim_checks(table))
    counted = tally(table)
    assert sum(int(x.rpartition(" ")[2]) for x in counted.split(", ")) == 28
    assert counted.startswith(f"replicated {sum(row.word == 'replicated' for row in table)}, ")


def test_one_bad_member_breaks_one_claim_and_its_check():
    """One of six members has a ratio of 0.0101: 5 of 6 are left. Two claims rest on the ratio, of which
    rejection is asserted, that is held by a check; no other claim changes its word.
    """
    good, bad = (rows(results(**with_member(m))) for m in (member(), member(adrc=walk(1.01e-4))))
    changed = [a.claim for a, b in zip(good, bad, strict=True) if a.word != b.word]
    assert len(changed) == 2  # rejection, and what figure 5 shows
    broken = [check for check in claim_checks(bad) if not check.holds]
    assert [check.value for check in broken] == [pytest.approx(5 / 6)]


# -- the runs --------------------------------------------------------------------------------------
def test_the_least_speed_of_the_zero_dynamics_parts_the_starts():
    """The least speed after impact is a quadrature, a share of the gait's speed; simulated starts at 0.97 of
    it make no impact and at 1.03 all 3, under either controller."""
    below, above = runs.starts("identified-bare")
    for c in CONTROLLERS:
        assert (below.outcomes[c].impacts, above.outcomes[c].impacts) == (0, 3)
    assert 0.5 < below.least < 0.65


def test_what_gait_b_needs_of_ground_and_motors():
    """Gait (b) needs a friction of 0.57 and 315 N m, which breaks limits that gait (a) keeps; after its
    impact the rates of the joints are off those of the references by more than 1 rad/s, by 1e-9 on gait (a).
    """
    a, b = (
        runs.walk_scenario(by_rk4("NPD", "identified", gait=gait, run={"impacts": 2})).outcome
        for gait in GAITS
    )
    assert (
        member_runs.limits_broken(a.feasibility) == 0.0 < member_runs.limits_broken(b.feasibility)
    )
    assert max(c.friction for c in b.certificates) == pytest.approx(0.57, abs=0.005)
    assert b.peak_torque == pytest.approx(315.0, rel=0.01)
    found = runs.jumps("identified")
    assert found["published"] < 1e-9 < 1.0 < found["recipe"]


def test_a_tracking_error_decays_by_the_gains_of_table_two():
    """K_d = 50, K_p = 5000: the time in which an error falls to 0.138, the least multiplier printed, against
    the roots of the error's polynomial."""
    slowest = np.roots([1.0, 50.0, 5000.0]).real.max()
    assert np.exp(slowest * longest_step(0.138)) == pytest.approx(0.138)


def test_noise_gives_a_spectrum_inside_the_unit_circle():
    """The paper's regression is made on random numbers without dynamics: its "multipliers" are below 1 too, so
    that such a spectrum proves no stability. The seed is fixed: the same twice.
    """
    medians = noise_spectrum()
    assert np.array_equal(medians, noise_spectrum())
    assert np.all(np.diff(medians) < 0)
    assert 0.1 < medians[-1] < medians[0] < 0.8


def test_an_observer_with_a_given_margin():
    """The bandwidth for a delay margin of 1 ms with m = 1, put back into the loop, has that margin."""
    bandwidth = runs.bandwidth_with(1e-3, 1)
    margin = ObserverLoop(GPIObserver.from_bandwidth(bandwidth, 1)).delay_margin().delay
    assert margin == pytest.approx(1e-3, rel=1e-6)


def test_starts_that_fail_are_those_slower_than_the_gait_s():
    """`factor`: of the least speed, 0.9 of the gait's. Below 1 a start counts as failing; of the two above it
    only the one that walks is passing."""
    walks, falls = SimpleNamespace(walked=True), SimpleNamespace(walked=False)
    starts = [
        SimpleNamespace(least=0.9, factor=f, outcomes={"NPD": o})
        for f, o in ((0.95, falls), (1.05, falls), (1.2, walks))
    ]
    found = of_starts(SimpleNamespace(starts={"gait": starts}))
    assert found["failing"] == pytest.approx((0.9 * 0.95,))
    assert found["passing"] == pytest.approx((0.9 * 1.2,))
    assert (found["passed"], found["above"]) == (1, 2)


def test_the_jump_of_the_total_disturbance_is_that_of_a_walk():
    """xi = q_b'' - kappa u on both sides of the impact of a simulated walk, in the labels after it, against
    `jumps`, which uses the stored gait alone. xi does not depend on u, so any u does."""
    biped = ba.Biped.load("rabbit", "identified")
    gait = ba.load_gait("published", biped)
    walk = ba.walk(ba.Walker(biped, ba.NPDController(gait.constraint)), gait, 2, ba.RK4(1e-4))
    first, second = walk.trajectory.arcs[:2]

    def xi(x):
        terms = biped.reduction(x[:5], x[5:10])
        u = np.linspace(1.0, 4.0, 4)
        a = biped.acceleration(x[:5], x[5:10], np.append(u, 0.0))
        return a[:4] - terms.kappa @ u

    expected = np.max(np.abs(xi(second.x[0]) - xi(first.x[-1])[biped.swap]))
    assert runs.jumps("identified")["xi_at_impact"] == pytest.approx(expected, rel=1e-2)


def test_the_reasons_of_the_members_are_those_beside_the_impulse_at_impact():
    """Of four members two break friction and impulse, one the impulse alone: "why" has friction alone, as the
    impulse at impact has a row of its own in the table; "apart" counts the one that is feasible but for it."""
    broken = {"friction": "friction 0.9 > 0.6", "impulse": "the impulse asks for 0.8"}
    alone = {"impulse": "the impulse asks for 0.8"}
    walks = (walk(1e-6)._replace(infeasible=x) for x in (broken, broken, alone, {}))
    found = results(members={"identified": [member(adrc=w) for w in walks]})
    assert of_members(found)["why"] == "friction 0.9 > 0.6"
    assert (of_members(found)["apart"], of_members(found)["count"]) == (1, 4)
