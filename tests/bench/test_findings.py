"""Sentences of the comparison on made-up rows: there when their test carries them, absent when it does not."""

import json

import pytest

from biped_adrc.bench.cell import IMPULSE, MEASURES, NEEDS, REASONS
from biped_adrc.bench.comparison import compare
from biped_adrc.bench.conditions import BANDWIDTH, CONDITIONS
from biped_adrc.bench.findings import answers, bandwidth_decides, sentences
from biped_adrc.bench.largest_push import PHASES
from biped_adrc.bench.run import COLUMNS
from biped_adrc.bench.settings import AS_PUBLISHED

SEEDS = 20


def row(**values):
    """A legal walk of made-up numbers."""
    known = dict.fromkeys(COLUMNS) | dict.fromkeys((*MEASURES, *NEEDS), 1.0)
    known |= dict.fromkeys((*REASONS, IMPULSE), 0) | {"peak_unmatched": 0.0}
    return known | {"survived": 1, "legal": 1, "status": "COMPLETED", "detail": ""} | values


def said(
    walk,
    controllers=("NPD", "ADRC"),
    conditions=("push on joints",),
    seeds=SEEDS,
    pushes=False,
    settings=AS_PUBLISHED,
):
    """Sentences of a comparison whose rows `walk` makes up from records."""
    asked = controllers, conditions, seeds, pushes, settings
    found = compare(lambda records: [walk(dict(r)) for r in records], *asked)
    every = answers(found)
    for answer in every:
        json.dumps(answer.row(), allow_nan=False)
    return [line for family in sentences(every).values() for line in family]


def errors(ratio, spread=0.0, flips=0):
    """ADRC's error as a multiple of NPD's, which differs over seeds by decades; inverted in `flips` seeds."""

    def walk(r):
        seed = r.get("seed", 0)
        base = 1e-4 * 10.0 ** (seed % 3)
        if r["controller"] == "NPD":
            return row(peak_error=base)
        turned = 1.0 / ratio if seed < flips else ratio
        return row(peak_error=base * turned * (1.0 + spread * (seed % 2)))

    return walk


def test_an_error_is_said_with_its_pairs_and_its_interval():
    (line,) = said(errors(0.2, 0.5))
    assert line.startswith("push on joints: largest tracking error as a multiple of that of NPD")
    assert "ADRC 0.24 (0.2 to 0.3) in 20 pairs" in line
    (line,) = said(errors(5.0))
    assert "ADRC 5 (5 to 5) in 20 pairs" in line


@pytest.mark.parametrize(
    "walk",
    [errors(1.0), errors(0.95), errors(0.2, flips=10), errors(0.2, flips=8), errors(1.05, 0.04)],
)
def test_an_error_that_is_alike_or_goes_both_ways_is_not_said(walk):
    assert said(walk) == []


def test_few_seeds_carry_nothing():
    assert said(errors(0.01), seeds=5) == []
    assert said(errors(0.01), seeds=1) == []
    assert len(said(errors(0.01), seeds=12)) == 1


def test_only_pairs_of_legal_walks_count():
    """Where ADRC is better only in walks that are not legal nothing is said of errors."""

    def walk(r):
        seed = r.get("seed", 0)
        found = errors(0.01 if seed < 10 else 1.0)(r)
        illegal = r["controller"] == "ADRC" and seed < 10
        return found | {"legal": int(not illegal)}

    lines = said(walk)
    assert not any("tracking error" in line for line in lines)
    assert lines == [
        "push on joints: legal walks, in pairs of the same seed as NPD: ADRC 10, NPD 20 of 20."
    ]


@pytest.mark.parametrize(
    ("lost", "there"), [(0, False), (3, False), (5, False), (7, True), (20, True)]
)
def test_legality_is_said_where_mcnemar_carries_it(lost, there):
    """With n discordant pairs that all go one way p = 2^(1-n): 0.06 for 5, 0.016 for 7."""

    def walk(r):
        legal = r["controller"] == "NPD" or r.get("seed", 0) >= lost
        return row(legal=int(legal), bad_friction=int(not legal))

    lines = [line for line in said(walk) if "legal walks, in pairs" in line]
    assert len(lines) == int(there)
    if there:
        assert f"ADRC {SEEDS - lost}, NPD 20 of 20" in lines[0]


def test_one_family_is_corrected_for_all_that_it_asks():
    """What is enough for one condition alone is too little among many."""

    def walk(r):
        lost = r["controller"] == "ADRC" and r.get("seed", 0) < 7 and r.get("push") == "pulse"
        return row(legal=int(not lost))

    assert said(walk, conditions=("push on joints",)) != []
    assert (
        said(walk, conditions=("push on joints", "nothing", "sine on joints", "wrong impact")) == []
    )


@pytest.mark.parametrize("values", [{"legal": 0}, {"survived": 0, "status": "FELL"}])
def test_nothing_is_said_where_no_walk_is_legal(values):
    assert said(lambda r: row(**values), conditions=tuple(CONDITIONS), pushes=True) == []


@pytest.mark.parametrize("missing", [None, float("nan"), 0.0])
def test_rows_without_numbers_make_no_pairs(missing):
    assert said(lambda r: row(**dict.fromkeys(MEASURES, missing))) == []


@pytest.mark.parametrize("missing", [None, float("nan"), float("inf")])
def test_speeds_without_numbers_are_not_alike(missing):
    assert said(lambda r: row(speed_change=missing, peak_unmatched=8.5)) == []


def test_one_controller_or_no_reference_says_nothing():
    better = errors(0.1)
    assert said(better, controllers=("NPD",), pushes=True) == []
    assert said(better, controllers=("ADRC",), pushes=True) == []


def test_where_sensors_or_a_delay_limit_the_bandwidth_nothing_is_concluded():
    """Another bandwidth or a filter turns the order of controllers there."""
    limited = ("delay", "encoders", "RABBIT", "RABBIT pushed", "RABBIT late")
    assert [c for c in CONDITIONS if bandwidth_decides(c)] == list(limited)
    assert said(errors(0.1), conditions=limited) == []


@pytest.mark.parametrize(
    ("difference", "unmatched", "there"),
    [(0.001, 8.5, True), (0.02, 8.5, False), (-0.02, 8.5, False), (0.001, 0.0, False)],
)
def test_speeds_are_called_alike_only_by_a_test_of_that(difference, unmatched, there):
    def walk(r):
        change = -0.04 + 1e-4 * r.get("seed", 0)
        change += difference if r["controller"] == "ADRC" else 0.0
        return row(speed_change=change, peak_unmatched=unmatched)

    lines = [
        line for line in said(walk, conditions=("push on the torso",)) if "speed changes as" in line
    ]
    assert len(lines) == int(there)


@pytest.mark.parametrize(
    ("own", "equal", "said_so", "turned"),
    [
        (6.0, 2.0, True, False),
        (6.0, 0.5, True, True),
        (2.0, 2.0, False, False),
        (1.0, 1.05, False, False),
    ],
)
def test_the_order_of_observers_at_equal_bandwidth(own, equal, said_so, turned):
    """Errors of LESO as multiples of ADRC's, at their own settings and at one bandwidth."""

    def walk(r):
        if r["controller"] == "ADRC":
            return row(peak_error=1e-3)
        return row(peak_error=1e-3 * (equal if r.get("bandwidth") == BANDWIDTH else own))

    lines = said(walk, controllers=("ADRC", "LESO"))
    assert len(lines) == int(said_so)
    if said_so:
        assert f"ADRC to LESO {1 / own:.2g}" in lines[0]
        assert ("the order changes" in lines[0]) == turned


@pytest.mark.parametrize(
    ("equal", "there"), [(0.3, True), (0.95, False), (1.2, False), (None, False)]
)
def test_an_error_has_to_hold_at_equal_bandwidth_too(equal, there):
    """At its own settings LESO has a fifth of NPD's error."""

    def walk(r):
        found = row(peak_error=0.2 if r["controller"] == "LESO" else 1.0)
        if "bandwidth" in r:
            found |= {"peak_error": equal or 0.3, "legal": int(equal is not None)}
        return found

    lines = [line for line in said(walk, ("NPD", "LESO")) if "largest tracking error" in line]
    assert len(lines) == int(there)
    if there:
        assert "LESO 0.2 (0.2 to 0.2)" in lines[0]


@pytest.mark.parametrize(("equal", "there"), [(10, True), (15, False), (17, False), (20, False)])
def test_legality_and_alike_speeds_have_to_hold_at_equal_bandwidth_too(equal, there):
    """At its own settings LESO walks legally in 5 of 20 seeds; at equal bandwidth in `equal`."""

    def walk(r):
        most = SEEDS if r["controller"] == "NPD" else equal if "bandwidth" in r else 5
        return row(legal=int(r.get("seed", 0) < most))

    assert len([x for x in said(walk, ("NPD", "LESO")) if "legal walks, in" in x]) == int(there)

    def push(r):
        changed = 0.0 if there or "bandwidth" not in r else 0.02
        return row(speed_change=changed, peak_unmatched=8.5)

    lines = said(push, ("NPD", "LESO"), ("push on the torso",))
    assert len(lines) == int(there)


def test_legality_that_turns_round_at_equal_bandwidth_is_not_said():
    """Fewer legal walks than NPD at its own settings, more at equal bandwidth, both by McNemar's test."""

    def walk(r):
        most = 10 if r["controller"] == "NPD" else SEEDS if "bandwidth" in r else 0
        return row(legal=int(r.get("seed", 0) < most))

    assert not any("legal walks, in" in line for line in said(walk, ("NPD", "LESO")))


def test_an_order_that_is_not_certain_does_not_change():
    """LESO's error at its own settings is half of ADRC's or twice it, at equal bandwidth a sixth."""

    def walk(r):
        if r["controller"] == "ADRC":
            return row(peak_error=1.0)
        own = 0.5 if r.get("seed", 0) % 2 else 2.0
        return row(peak_error=1.0 / 6.0 if "bandwidth" in r else own)

    (line,) = said(walk, ("ADRC", "LESO"))
    assert "ADRC to LESO 1 (0.5 to 2) and 6 (6 to 6) in 20 pairs" in line
    assert "the order changes" not in line


def limits(joints, torso=50.0):
    """Largest legal push of ADRC on joints and on the torso; 60 N m of NPD; all survive twice as much."""

    def walk(r):
        if r["controller"] == "NPD" or "pushed_step" not in r or r["push"] != "pulse":
            limit = 60.0
        else:
            limit = torso if "q5" in r["on"] else joints(r)
        amplitude = r.get("amplitude", 0.0)
        legal, made = amplitude <= limit, amplitude <= 2.0 * limit
        return row(survived=int(made), legal=int(legal), status="COMPLETED" if made else "FELL")

    return walk


def pushed(walk):
    return [line for line in said(walk, conditions=("nothing",), pushes=True) if "push" in line]


def test_larger_pushes_are_said_where_the_sign_test_carries_them():
    (line,) = pushed(limits(lambda r: 100.0))
    assert "ADRC larger in 12, smaller in 0 of 12 combinations of joints and phase" in line
    (line,) = pushed(limits(lambda r: 30.0))
    assert "ADRC larger in 0, smaller in 12 of 12" in line
    (line,) = pushed(limits(lambda r: 1e9))
    assert "larger in 12" in line


def test_larger_pushes_have_to_hold_at_equal_bandwidth_too():
    for equal, there in ((90.0, True), (60.0, False), (30.0, False)):
        lines = pushed(limits(lambda r, x=equal: x if "bandwidth" in r else 100.0))
        assert len(lines) == int(there)
    early = limits(
        lambda r: 100.0 if "bandwidth" not in r or r["onset"] == PHASES["early"] else 60.0
    )
    assert pushed(early) == []


def test_pushes_that_are_alike_go_both_ways_or_are_open_are_not_said():
    assert pushed(limits(lambda r: 60.0)) == []
    assert pushed(limits(lambda r: 61.0)) == []
    assert pushed(limits(lambda r: 100.0 if r["onset"] == PHASES["early"] else 30.0)) == []
    beyond = limits(lambda r: 1e9, 1e9)
    assert pushed(lambda r: beyond(r | {"controller": "ADRC"})) == []
