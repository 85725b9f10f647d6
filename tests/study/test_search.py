"""The search against an optimum that is known exactly, the same whoever walks, on three sets of walks.

In place of walks, `plants.costs` computes the cost of a linear regulator with gains k1, k2 and observer gains
l1, l2, whose optimum is Riccati's. plants.tables(...) are the tables of a search over them, plants.carried runs
it as a study, found_by(...) runs the search alone. A candidate is one setting of the gains, number 0 the case
itself.
"""

import math
import re
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import plants
import pytest

import biped_adrc as ba
from biped_adrc.core.errors import InputError, SimulationError
from biped_adrc.scenario.cycle import specified
from biped_adrc.scenario.scenario import read_scenario
from biped_adrc.studies import search as search_room
from biped_adrc.studies.build import scenario_of
from biped_adrc.studies.measure import Aim, Limit, numbers_without_walk
from biped_adrc.studies.proposals import last_rounds, searched
from biped_adrc.studies.search import Candidate
from biped_adrc.studies.study import read_study
from tests.commands import command

INF = math.inf


def walked(asked):
    """What a walk of each setting would be: one row, under no condition."""
    return [[("", row)] for row in plants.costs([c.values for c in asked])]


def last(search, base):
    """The last round of a search alone."""
    return last_rounds({"": searched(search, base, walked, lambda c: None)})[""]


def found_by(**search):
    """The search with these settings, and the candidates that it tried, in order."""
    study = read_study(plants.tables(**search))
    return study.search, last(study.search, study.base).candidates


def test_the_optimum_of_riccati_is_reached():
    """The search over the gains of a regulator and its observer comes to 1 % from the optimum of Riccati with
    each of three seeds, 0.05 % in the mean, and never below it. Candidate 0 is the case itself, and 200 are
    walked.
    """
    missed = []
    for seed in (1, 2, 3):
        search, found = found_by(seed=seed)
        assert (len(found), found[0].chosen) == (200, {})
        missed.append(search.ranked(found)[0].objective / plants.optimum() - 1.0)
    assert -1e-9 < min(missed) <= max(missed) < 0.01
    assert np.mean(missed) < 5e-4


def test_an_end_at_which_the_best_stands_is_moved_until_the_optimum_lies_inside():
    """k1 in 1 to 2 excludes its optimum. Without a doubling k1 stands at an end; with doublings the end goes to
    4, 8, .., and the optimum is reached to 2 %. Each round has as many candidates as all before it.
    """
    k1 = {"from": 1.0, "to": 2.0, "scale": "log"}
    tables = plants.tables(budget=50)
    tables["search"]["variables"]["controller.k1"] = k1
    search, base = read_study(tables).search, tables["base"]
    assert last(search, base).ends == ("controller.k1",)
    more = search.model_copy(update={"doublings": 3})
    found, gain, ends = last(more, base)
    best = more.ranked(found)[0]
    assert best.chosen["controller.k1"] > 2.0
    assert best.objective < 1.02 * plants.optimum()
    assert (gain < 0.02, ends) == (True, ())
    assert len(found) in {200 << doubled for doubled in range(4)}


def test_a_search_says_what_stopped_it(tmp_path):
    """With peak_error = k1 at most 0.2 of its optimal value a step up of k1 misses that limit. A gain that the
    cost does not know is flat. A range that ends before the optimum leaves the search not tuned.
    """
    search, found = found_by()
    k1 = search.ranked(found)[0].chosen["controller.k1"]
    limits = [{"column": "peak_error", "most": 0.2 * k1, "over": "worst"}]
    tables = plants.tables(budget=50, limits=limits, doublings=1)
    tables["search"]["variables"]["controller.free"] = {"from": 1.0, "to": 9.0}
    (choice,) = plants.carried(tables, tmp_path / "limit", plants.costs).choices.values()
    assert re.search(r"stopped by worst peak_error at most [\d.]+: controller.k1 up;", choice.stop)
    assert re.search(
        r"nothing, as it is flat: .*controller.free down, controller.free up", choice.stop
    )
    assert re.search(r"stopped by the objective: .*controller.k1 down", choice.stop)
    assert re.search(r"; the last doubling gained [\d.]+%$", choice.stop)
    tables = plants.tables(budget=50)
    tables["search"]["variables"]["controller.k1"] = {"from": 1.0, "to": 2.0, "scale": "log"}
    (choice,) = plants.carried(tables, tmp_path / "end", plants.costs).choices.values()
    assert choice.stop == "not tuned: controller.k1 at an end of its range"


def test_all_cases_go_on_while_one_gains():
    """A search that stands still beside one that does not has as many candidates as that one; the two end
    together.
    """
    study = read_study(plants.tables(budget=20, doublings=4))
    narrow = plants.tables(budget=20, doublings=4)
    narrow["search"]["variables"]["controller.k1"] = {"from": 1.0, "to": 1.2, "scale": "log"}
    cases = {"wide": study.search, "narrow": read_study(narrow).search}
    alone = {name: len(last(s, study.base).candidates) for name, s in cases.items()}
    rounds = {n: searched(s, study.base, walked, lambda c: None) for n, s in cases.items()}
    counts = {name: len(x.candidates) for name, x in last_rounds(rounds).items()}
    assert alone["wide"] < alone["narrow"]
    assert counts["wide"] == counts["narrow"] >= alone["narrow"]


def test_a_search_goes_on_with_more_doublings(tmp_path):
    """With one doubling a folder of none is continued: rows and choice are those of a search that had one from
    the beginning, and the candidates that were walked before are not walked again. With fewer it is refused.
    """
    counts = []

    def counted(asked):
        counts.append(len(asked))
        return plants.costs(asked)

    def carried(doublings, name):
        counts.clear()
        with ThreadPoolExecutor(1) as pool:
            tables = plants.tables(budget=10, doublings=doublings)
            found = ba.study(tables, tmp_path / name, pool, function=counted)
        return list(found.results()), found.choices, sum(counts)

    assert carried(0, "one")[2] > 40
    *again, few = carried(1, "one")
    *whole, every = carried(1, "other")
    assert again == whole
    assert every - few == 40
    with pytest.raises(InputError, match=r"search.doublings 1 there, 0 here"):
        carried(0, "one")


def test_the_next_finalists_are_walked_where_the_first_keep_no_limit(tmp_path):
    """On the walks of choice k1 has to be 0.8 of its best value at most, which the best candidates miss: the
    next ones are walked, three from twice as far each time, until one keeps it, which is chosen.
    """
    search, found = found_by(budget=20)
    k1 = search.ranked(found)[0].chosen["controller.k1"]

    def narrow(asked):
        seeds = (record["run.seed"] for record in asked)
        above = (record["controller.k1"] / k1 > 0.8 for record in asked)
        rows = zip(plants.costs(asked), seeds, above, strict=True)
        return [row | {"peak_error": float(seed == 1 and x)} for row, seed, x in rows]

    limits = [{"column": "peak_error", "most": 0.5, "over": "worst"}]
    with ThreadPoolExecutor(1) as pool:
        tables = plants.tables(budget=20, limits=limits, finalists=3)
        (choice,) = ba.study(tables, tmp_path, pool, function=narrow).choices.values()
    chosen, rank = choice.selected[0], {c.number: i for i, c in enumerate(search.ranked(found))}
    assert chosen.chosen["controller.k1"] <= 0.8 * k1
    # by rank, without the case itself: 0, 1, 2; 3, 4, 5; 6, 8, 10; 12, 16, 20; ..
    walked_ = sorted(rank[c.number] for c in choice.selected if c.number)
    expected = [0, 1, 2, *(3 * 2**i + j * 2**i for i in range(5) for j in range(3))]
    assert walked_ == expected[: len(walked_)]
    assert rank[chosen.number] in walked_[-3:]


def test_equal_cases_are_searches_with_other_seeds(tmp_path):
    """Two cases of the same values have other candidates: the second one's sampler has the seed after."""
    tables = plants.tables(budget=3, generation=4)
    tables["cases"] = {"#1": {}, "#2": {}}
    one, two = plants.carried(tables, tmp_path, plants.costs).choices.values()
    assert [c.chosen for c in one.candidates] != [c.chosen for c in two.candidates]


def test_any_workers_give_the_same_bits(tmp_path):
    """One process, two, and threads have the same rows and choices. Walks: 32 of the search, 8 for each of
    4 gains; those of the second set, with 8 settings beside the choice; and two of the test, the choice and the
    case itself. Another seed gives other candidates.
    """
    tables = plants.tables(budget=8, generation=8)
    with ThreadPoolExecutor(3) as pool:
        one, two, three = (
            ba.study(tables, tmp_path / f"{i}", workers, function=plants.costs)
            for i, workers in enumerate((1, 2, pool))
        )
    assert list(one.results()) == list(two.results()) == list(three.results())
    assert one.choices == two.choices == three.choices
    (choice,) = one.choices.values()
    assert len(list(one.results())) == 32 + len(choice.selected) + 8 + 2
    _, other = found_by(budget=8, generation=8, seed=2)
    assert other != [*choice.candidates]


def test_the_sets_are_disjoint_and_the_test_set_is_walked_once_after_every_choice(tmp_path):
    """Seeds 0, 1 and 2 are those of search, choice and test: 8 candidates, then the finalists, and
    the settings beside the choice, then the choice
    and the case itself (candidate 0). Sets that share a seed are refused.
    """
    seen = []

    def rows(records):
        seen.extend(record["run.seed"] for record in records)
        return plants.costs(records)

    tables = plants.tables(budget=2, generation=3, finalists=2)
    found = plants.carried(tables, tmp_path, rows)
    (choice,) = found.choices.values()
    assert seen == [0] * 8 + [1] * (len(choice.selected) + 8) + [2] * 2
    assert 0 in {c.number for c in choice.selected}
    for seeds in (([0, 1], [1], [2]), ([0], [2], [2]), ([2], [1], {"from": 0, "count": 9})):
        with pytest.raises(InputError, match=r"search\.walks: .* share the seeds \["):
            read_study(plants.tables(seeds=seeds))


def test_a_candidate_is_told_when_it_becomes_the_best_and_not_again(tmp_path):
    """Notes name candidates in the order of their numbers, each once, and the last one is the best."""
    notes, tables = [], plants.tables(budget=3, generation=3)
    found = plants.carried(tables, tmp_path, plants.costs, progress=lambda x: notes.append(x.note))
    (choice,), told = found.choices.values(), [x for x in notes if ": candidate " in x]
    numbers = [int(x.partition(": candidate ")[2].partition(",")[0]) for x in told]
    assert numbers == sorted(set(numbers))
    best = min(choice.candidates, key=lambda c: (not c.feasible, c.objective))
    assert numbers[-1] == best.number


def test_each_case_is_searched_over_the_variables_that_act_there(tmp_path):
    """`when` makes l2 a variable of the case with run.impacts = 3 alone: the other case has no candidate with
    it. Each case has its choice, a line before and after, and a file.
    """
    tables = plants.tables(budget=3, generation=4)
    tables["cases"] = {"narrow": {"run.impacts": 2}, "all": {"run.impacts": 3}}
    tables["search"]["variables"]["controller.l2"] |= {"when": {"run.impacts": 3}}
    found = plants.carried(tables, tmp_path, plants.costs)
    narrow, every = found.choices.values()
    chosen = {name for c in narrow.candidates for name in c.chosen}
    assert chosen == {f"controller.{name}" for name in ("k1", "k2", "l1")}
    assert "controller.l2" in every.candidates[-1].chosen
    names = ["narrow", "all", "narrow, before", "all, before"]
    assert [line.name for line in found.table()] == names
    assert {p.name for p in tmp_path.glob("*.toml")} == {"chosen-narrow.toml", "chosen-all.toml"}


def test_a_variable_acts_with_what_the_profile_fills_in():
    """The profile rabbit takes differences for rates, so their low-pass acts there alone."""
    name = "hardware.encoders.filter_time"
    when = {"hardware.encoders.velocity": "differences"}
    variables = {name: {"from": "1 ms", "to": "9 ms", "when": when}}
    search = read_study(plants.tables(variables=variables)).search
    of_rabbit = {"hardware.profile": "rabbit", name: 3e-3}
    assert [*search.acting(of_rabbit)] == [name]
    assert search.values(of_rabbit, {name: 2e-3})[name] == 2e-3
    assert not search.acting({"hardware.profile": "ideal"})


def test_variables_that_have_no_effect_are_left_out_of_a_candidate():
    """Bandwidth and order act under LESO alone, run.impacts with order 2 or 3 alone: `values` has only what
    acts, in a chain of two `when`. The objective is the order here, 9 without one, so that the best of 32 has
    order 1.
    """
    when = {"when": {"controller.name": "LESO"}}
    bandwidth, order = "controller.observer.bandwidth", "controller.observer.order"
    variables = {
        "controller.name": {"choices": ["NPD", "LESO"]},
        bandwidth: {"from": 50.0, "to": 200.0, "scale": "log", **when},
        order: {"from": 1, "to": 4, "whole": True, **when},
        "run.impacts": {"from": 1, "to": 3, "whole": True, "when": {order: [2, 3]}},
    }
    search = read_study(plants.tables(variables=variables, budget=3, finalists=5)).search
    chosen = {"controller.name": "LESO", bandwidth: 70.0, order: 2, "run.impacts": 2}
    assert search.values({"a": 1}, chosen) == {"a": 1, **chosen}
    npd = {"controller.name": "NPD"}
    assert search.values({"a": 1}, chosen | npd) == {"a": 1, **npd}
    middle = chosen | {bandwidth: pytest.approx(100.0), order: 3}
    assert [*search.values({}, chosen | {order: 4})] == [*chosen][:3]
    # some: the middle of all variables, then each choice beside it; a study is rehearsed with them
    assert list(search.some({})) == [npd, npd, middle]
    # 3 candidates for each of 4 variables; 8 times 5 finalists, the case, and 8 beside; the choice and the case
    assert search.count({"search": 2, "choice": 3, "test": 5}, {}) == 12 * 2 + 49 * 3 + 2 * 5
    # walks(x): a walk that ended well, with the objective x
    walk = lambda asked: [walks(float(c.values.get(order, 9))) for c in asked]  # noqa: E731
    search = search.model_copy(update={"budget": 8, "generation": 5, "walks": search.walks})
    found = last_rounds({"": searched(search, {}, walk, lambda c: None)})[""].candidates
    assert len(found) == 32
    # [0] is the case itself, for which nothing was chosen
    assert {type(c.chosen[order]) for c in found[1:]} == {int}
    assert {c.chosen[order] for c in found[1:]} == {1, 2, 3, 4}
    assert {c.chosen["controller.name"] for c in found[1:]} == {"NPD", "LESO"}
    assert search.ranked(found)[0].objective == 1.0


def test_a_limit_without_a_walk_excludes_candidates_before_their_walks(monkeypatch):
    """The ripple, known without a walk, is replaced by k1: candidates above 20 are not walked, and the budget
    of 32 counts walks alone. With a limit that none keeps, only the case is walked, and a generation asks 8
    times for each of its 10.
    """
    known = lambda _, values: {"ripple": values["controller.k1"]}  # noqa: E731
    monkeypatch.setattr(search_room, "numbers_without_walk", known)
    limits = [{"column": "ripple", "most": 20.0, "over": "worst"}]
    search, found = found_by(budget=8, generation=10, limits=limits)
    assert sum(c.walked for c in found) == 32
    excluded = [c for c in found if not c.walked]
    assert excluded
    assert all((c.chosen["controller.k1"] > 20.0) is not c.walked for c in found if c.number)
    assert [c.number for c in found] == list(range(len(found)))
    assert all(c.walked for c in search.ranked(found))
    limits[0]["most"] = 0.1  # which none keeps: a generation asks 8 times for each of its 10
    _, found = found_by(budget=8, generation=10, limits=limits)
    assert ([c.number for c in found if c.walked], len(found)) == ([0], 80)


def test_limits_that_nothing_keeps_are_named_with_the_nearest_candidate(tmp_path):
    """peak_error is k1 - bonus, and k1 is at least 1: a median of at most 0.5 is kept with the bonus alone.
    Without any case that keeps it the study fails; beside one that does, it is a failure among the results.
    """
    limits = [{"column": "peak_error", "most": 0.5, "over": "median"}]
    tables = plants.tables(budget=2, generation=4, limits=limits)
    message = r"median peak_error at most 0.5: missed by 8.*nearest is"  # by all 8 candidates
    with pytest.raises(InputError, match=message):
        plants.carried(tables, tmp_path / "none", plants.costs)
    tables["cases"] = {"none": {}, "some": {"controller.bonus": 100.0}}
    found = plants.carried(tables, tmp_path / "some", plants.costs)
    assert list(found.choices) == ["some"]
    assert re.search(f"none: none of .*{message}", found.failures[0])
    assert [line.name for line in found.table()] == ["some", "some, before"]


def walks(*numbers, feasible=1, column="rms_error"):
    """Walks that ended well, with these numbers in the column."""
    return [("", {"survived": 1, "feasible": feasible, column: x}) for x in numbers]


FELL = ("", {"survived": 0, "feasible": 0, "rms_error": 0.001})
REFUSED = ("", {"survived": None, "feasible": None, "rms_error": None})


def of(found, kind=Aim, column="rms_error", **more):
    """The number that an aim or a limit makes of these walks."""
    return kind(column=column, **more).of(found, {})


def test_falls_and_infeasible_walks_rank_worst_and_are_not_dropped():
    """The number of an aim is a median or mean over walks, in which a bad walk counts as infinite, the worst
    way: so a fall with a tiny error makes a candidate no better. counts="made" takes infeasible walks by their
    error, and falls as before.
    """
    most = {"goal": "maximise"}
    assert of(walks(3.0, 1.0, 2.0)) == 2.0
    assert of(walks(1.0, 2.0)) == 1.5
    for bad in (FELL, REFUSED, *walks(0.001, feasible=0), *walks(None)):
        assert (of([*walks(3.0, 1.0), bad]), of([*walks(3.0, 1.0), bad], **most)) == (3.0, 1.0)
        assert (of([*walks(3.0), bad]), of([*walks(3.0), bad], **most)) == (INF, -INF)
        assert of([*walks(3.0), bad], over="mean") == INF
    assert of([*walks(3.0, 1.0), *walks(0.5, feasible=0)], counts="made") == 1.0
    assert of([*walks(3.0, 1.0), FELL], counts="made") == 3.0


def test_quantiles_are_numbers_of_walks_in_the_order_of_the_goal():
    """The walks have the numbers 1 to 10. A quantile is the least number that a share p of the walks does not
    exceed, always that of one walk; "worst" is the largest. To be maximised, they count from above.
    """
    x = walks(*range(1, 11))
    assert [of(x, over=p) for p in (0.5, 0.9, 0.91, "worst")] == [5, 9, 10, 10]
    assert [of(x, over=p, goal="maximise") for p in (0.5, 0.9, 0.91, "worst")] == [6, 2, 1, 1]


def test_every_walk_counts_in_a_share():
    """Of four walks two are feasible: the share is 0.5, which misses at least 0.9 by 0.4, as a share of the
    limit. The worst torque of 165 N m misses 150 by a tenth; a limit of 0 is missed by the number itself.
    """
    feasible, torque = Limit(column="feasible", least=0.9), {"most": 150.0, "over": "worst"}
    x = feasible.of([*walks(1.0, 1.0), FELL, REFUSED], {})
    assert (x, feasible.excess(x)) == (0.5, pytest.approx(0.4 / 0.9))
    x = of(walks(100.0, 165.0, column="peak_torque"), Limit, "peak_torque", **torque)
    assert x == 165.0
    assert Limit(column="peak_torque", **torque).excess(x) == pytest.approx(0.1)
    assert Limit(column="bad_friction", most=0.0).excess(0.5) == 0.5


def test_candidates_are_ranked_by_limits_then_objective():
    """known: (objective, by how much limits are missed). Candidates without a miss come first, by objective,
    equal ones by number, an infinite one last; then those with a miss. Candidate 6, which was not walked, has
    no rank.
    """
    search = read_study(plants.tables()).search
    known = [(3.0, 0.0), (1.0, 0.0), (0.1, 0.2), (2.0, 0.0), (INF, 0.0), (1.0, 0.0)]
    found = [Candidate(i, {}, {}, x, (m,), True) for i, (x, m) in enumerate(known)]
    found.append(Candidate(6, {}, {}, INF, (0.1,), False))
    assert [c.number for c in search.ranked(found)] == [1, 5, 3, 0, 4, 2]


def test_columns_without_a_walk_are_those_of_the_specification():
    """They are numbers of the linear loop at its ticks, and there are none in continuous time; the ground
    changes none. With a delay of 12 ms the loop is unstable: its margins are 0, and it has no ripple.
    """
    names = ("stable", "delay_margin", "disk_margin", "ripple")
    values = {"controller.name": "NPD", "run.impacts": 2}
    values |= {"hardware.period": 1e-3, "hardware.delay": 1e-3}
    told = specified(scenario_of(values))
    assert numbers_without_walk(names, values) == {name: told[name] for name in names}
    late = numbers_without_walk(names, values | {"hardware.delay": 0.012})
    assert late == {"stable": 0.0, "delay_margin": 0.0, "disk_margin": 0.0, "ripple": None}
    soft = values | {"ground.plant": "mujoco", "ground.friction": 0.8, "ground.time_constant": 5e-3}
    assert numbers_without_walk(names, soft) == {name: told[name] for name in names}
    assert numbers_without_walk(names, values | {"hardware.period": None}) == dict.fromkeys(names)


WALKS = """
name = "walks"
base = { controller.name = "NPD", run.impacts = 1 }
[search]
budget = 3
generation = 3
finalists = 1
objective = { column = "rms_error" }
variables = { controller.K_p = { from = 2000.0, to = 9000.0, scale = "log" } }
walks = { search = { seeds = [0] }, choice = { seeds = [1] }, test = { seeds = [2] } }
"""


def test_the_command_searches_and_simulate_takes_what_it_wrote(tmp_path):
    """The search makes at most 16 walks: 3 candidates; on the second set 8 finalists, the case itself
    and two beside the choice; two on the third.

    The objectives are those of a plain study of the same gains.
    """
    path, out = tmp_path / "walks.toml", tmp_path / "out"
    path.write_text(WALKS)

    line = ["study", path, "--out", out, "--workers", "1"]
    dry = command(*line, "--dry-run").splitlines()
    assert dry[0] == "walks: at most 16 walks"
    assert dry[1] == "Walked once, as nothing that acts is drawn from the seed: walks."
    command(*line)
    # errors, their ratio, and the path of the search
    assert (out / "study.html").read_text().count("<figure>") == 3
    best = command("simulate", "--scenario", out / "chosen.toml", "--impacts", "2")
    assert "2 impacts" in best
    with ThreadPoolExecutor(1) as pool:
        found = ba.study(path, out, pool)
        K_p = [c.chosen["controller.K_p"] for c in found.choices[""].candidates[1:]]
        swept = {"name": "x", "seeds": [0], "base": found.study.base}
        rows = ba.study(swept | {"grid": {"controller.K_p": K_p}}, tmp_path / "swept", pool).rows()
    assert scenario_of(read_scenario(out / "chosen.toml").dotted()) == scenario_of(
        found.choices[""].values
    )
    expected = [row["rms_error"] if row["feasible"] else INF for row in rows]
    assert [c.objective for c in found.choices[""].candidates[1:]] == expected


def test_a_study_without_any_walk_ends_with_an_exit_code(tmp_path, monkeypatch):
    """The controller's output is no function, so that each walk raises: the command ends with an error, from
    which its exit code comes, and not with an empty page.
    """
    text = "import biped_adrc as ba\n\n\nclass Bad(ba.Controller):\n    output = 3\n"
    (tmp_path / "without.py").write_text(text)
    (tmp_path / "s.toml").write_text('name = "s"\nbase = {controller.name = "without:Bad"}\n')
    monkeypatch.syspath_prepend(tmp_path)
    line = ["study", str(tmp_path / "s.toml"), "--out", str(tmp_path / "out"), "--workers", "1"]
    with pytest.raises(SimulationError, match="no walk of this study"):
        command(*line)
