"""Studies from files: what they mean and what is refused; samples, units and tables by closed forms.

read_study reads a study from a file, for which `written` writes a text, or from tables. For tables of results a
stand-in `rows` makes up the walks of cases a and b under conditions x and y, and plants.carried runs it.
"""

import csv
import hashlib
import importlib.metadata
import math
import sys
from pathlib import Path

import numpy as np
import plants
import pytest

import biped_adrc as ba
from biped_adrc.analysis.statistics import median, paired, share
from biped_adrc.core.errors import InputError
from biped_adrc.scenario.scenario import read_scenario, write_scenario
from biped_adrc.studies.build import scenario_of, versions_of
from biped_adrc.studies.run import run_trials
from biped_adrc.studies.space import Draw, Levels
from biped_adrc.studies.study import read_study
from biped_adrc.view.plots.study import cut

STUDY = """
name = "robustness"
seeds = 3
[base]
controller.name = "LESO"
hardware.torque_limit = "150 N m"
pushes.0.torque = "30 N m"
[grid]
controller.observer.bandwidth = { from = "100 rad/s", to = 1000, count = 3, scale = "log" }
hardware.period = ["0.5 ms", 1e-3]
start.v5 = [-0.1, "5 deg/s"]
[draw]
count = 4
seed = 1
hardware.encoders.noise = { from = 0, to = "0.1 deg" }
[cases]
plain = {}
first = { controller.observer.order = 1, hardware.torque_limit = "none" }
[conditions]
calm = { pushes.0.onset = 0.05 }
pushed = { pushes.0.onset = 0.1 }
"""


def written(tmp_path, text):
    path = tmp_path / "study.toml"
    path.write_text(text)
    return path


def test_points_are_all_combinations_in_si_units(tmp_path):
    """2 cases x 2 conditions x 3 bandwidths x 2 periods x 2 starts x 4 draws x 3 seeds, each once; the scenario
    of every seventh has the values that its point names.
    """
    study = read_study(written(tmp_path, STUDY))
    points = list(study.points())
    assert len(points) == study.count == 2 * 2 * 3 * 2 * 2 * 4 * 3
    names = [*points[0].at]
    assert names[:5] == ["case", "condition", *study.grid]
    assert names[5:] == ["hardware.encoders.noise", "run.seed"]
    assert [p.place for p in points] == list(range(study.count))
    assert len({tuple(p.at.values()) for p in points}) == study.count
    assert {p.at["start.v5"] for p in points} == {-0.1, math.radians(5.0)}
    bandwidths = sorted({p.at["controller.observer.bandwidth"] for p in points})
    assert bandwidths == pytest.approx([100, 100 * 10**0.5, 1000], rel=1e-14)
    for p in points[::7]:
        s = scenario_of(p.record)
        found = s.hardware.period, s.start.own["v5"], s.hardware.encoders.noise, s.run.seed
        assert found == tuple(p.at[k] for k in names[3:])
        first, pushed = p.at["case"] == "first", p.at["condition"] == "pushed"
        # as STUDY says: its case "first" has no limit, its condition "pushed" a later push
        assert s.hardware.torque_limit == (None if first else 150.0)
        assert s.pushes[0].onset == (0.1 if pushed else 0.05)


def test_the_scenario_of_a_study_lies_beside_it(tmp_path):
    """Paths out of its folder are refused, and so are files of the system, some of which never end."""
    (tmp_path / "below").mkdir()
    (tmp_path / "base.toml").write_text('controller.name = "NPD"')
    for name, why in (
        ("../base.toml", "in its own folder"),
        ("/proc/version", "in its own folder"),
    ):
        with pytest.raises(InputError, match=why):
            read_study(written(tmp_path / "below", f'name = "x"\nscenario = "{name}"'))
    (tmp_path / "below" / "base.toml").write_text('controller.name = "NPD"')
    study = read_study(written(tmp_path / "below", 'name = "x"\nscenario = "base.toml"'))
    assert study.base == {"controller.name": "NPD"}
    with pytest.raises(InputError, match="not a regular file"):
        read_scenario(Path("/proc/version"))


def test_another_study_has_another_hash_and_another_description_has_not(tmp_path):
    """old -> new in the file; same: whether results may go on. Another seed of draws or value of a condition
    changes the hash; the same text, a description and a comment do not.
    """
    study = read_study(written(tmp_path, STUDY))
    for old, new, same in (
        ("seed = 1", "seed = 2", False),
        ("0.1 }", "0.2 }", False),
        ("calm", "calm", True),
        ("seeds = 3", 'seeds = 3\ndescription = "why"  # a remark', True),
    ):
        assert (read_study(written(tmp_path, STUDY.replace(old, new))).hash == study.hash) is same


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("hardware.period", "hardware.perod", "grid: hardware.perod: .*'hardware.period'"),
        ("[grid]", "[gird]", "gird: .*did you mean 'grid'"),
        ('"0.5 ms"', '"0.5 furlongs"', "grid: hardware.period: .*'furlongs' is not known"),
        ('"0.5 ms"', '"500 ms"', r"hardware.period: found 0.5, expected >= 1e-05, <= 0.1 \[s\]"),
        ('"100 rad/s"', "2000", "grid: controller.observer.bandwidth: .*expected from < to"),
        ('controller.name = "LESO"', "run.seed = 4", "run.seed is in 'base' and in 'seeds'"),
        ("pushes.0.onset = 0.1", "controller.observer.order = 2", "in 'cases' and in 'conditions'"),
        ("[grid]", "[grid", "is not valid TOML.*line 8"),
        # 2^63, one above the largest seed
        ("seeds = 3", "seeds = [9223372036854775808]", "seeds.0: found 9223372036854775808"),
        ("seeds = 3", "seeds = [1, 1]", r"seeds: found \[1, 1\], expected how many"),
        ("seeds = 3", 'seeds = 3\ncolumn = "rms_eror"', "did you mean 'rms_error'"),
        ("count = 3", "count = 0", "observer.bandwidth: count: .*greater than or equal to 1"),
        (
            "start.v5 = [-0.1",
            "start.v5 = [0.1, 0.1",
            "found .*, expected a list of different values",
        ),
    ],
)
def test_wrong_lines_of_a_study_file_are_refused_by_name(tmp_path, old, new, message):
    """old -> new in STUDY, one mistake each; the message names the file, the place and, for a misspelt key, the
    right one.
    """
    assert old in STUDY
    with pytest.raises(InputError, match=f"(?s)study.toml'.*{message}"):
        read_study(written(tmp_path, STUDY.replace(old, new)))


def test_all_mistakes_are_in_one_error():
    message = r"(?s)2 problems.*base: run.q: .*; run.z: .*seeds: found 0"
    with pytest.raises(InputError, match=message):
        read_study({"name": "a", "base": {"run.q": 1, "run.z": 2}, "seeds": 0})


SPAN = {"from": 1, "to": 2}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"variables": {"run.impact": SPAN}}, "search.variables: run.impact: .*'run.impacts'"),
        ({"variables": {"run.seed": SPAN}}, "run.seed is in 'seeds' and in 'search.variables'"),
        ({"objective": {"column": "rms_eror"}}, "search.objective.column: .*'rms_error'"),
        ({"limits": [{"column": "feasible"}]}, "search.limits.0: expected one of least and most"),
        ({"limits": [{"column": "feasible", "least": 1, "condition": "x"}]}, "no condition 'x'"),
        ({"budgt": 3}, "search.budgt: unknown key; did you mean 'budget'"),
        ({"variables": {"run.h": 3}}, "search.variables: run.h: found 3, expected a table"),
    ],
)
def test_mistakes_of_a_search_are_named_by_their_place(change, message):
    """change: of the search's tables. Case names that would give one file name, or one too long (89 letters, 88
    are taken), and tables that a search does not have are refused too.
    """
    with pytest.raises(InputError, match=message):
        read_study(plants.tables(**change))
    for more, said in (
        ({"cases": {"m = 1": {}, "m=1": {}}}, "cases: their files would be"),
        ({"cases": {89 * "m": {}}}, "expected different, shorter names"),
        ({"grid": {"run.impacts": [1, 2]}}, "a search has variables and sets of walks; leave"),
        ({"seeds": 3}, "leave out grid, draw and seeds"),
        ({"draw": 5}, "draw: found 5"),
        ({"cases": {"a": 3}}, "cases.a: found 3, expected a table"),
    ):
        with pytest.raises(InputError, match=said):
            read_study(plants.tables() | more)
    read_study((calm := plants.tables()) | {"cases": {88 * "m": {}}})
    calm["search"]["walks"]["test"]["conditions"] = ["calm"]
    with pytest.raises(InputError, match=r"search\.walks\.test: there is no condition 'calm'"):
        read_study(calm)


def test_a_study_takes_the_values_of_a_scenario_file(tmp_path):
    """Values of base come before those of the file (5 impacts, not 3), and an axis of the grid takes the place
    of the file's bandwidth.
    """
    path, controller = tmp_path / "s.toml", {"name": "LESO", "observer": {"bandwidth": 77.0}}
    write_scenario(path, ba.Scenario(controller=controller, run={"impacts": 3}), "short")
    grid = {"controller.observer.bandwidth": [1.0, 2.0]}
    tables = {"name": "s", "scenario": str(path), "grid": grid}
    base = read_study(tables | {"base": {"run.impacts": 5}}).base
    assert base == {"controller.name": "LESO", "run.impacts": 5}


def test_a_module_beside_the_study_is_found_and_others_there_are_not_run(tmp_path):
    """The study's folder is on the path, at its end, only while the class that the study names is imported:
    files there called like installed modules (optuna) are not run in their place.
    """
    module = "import sys\nimport biped_adrc as ba\nPATH = list(sys.path)\n\n"
    (tmp_path / "beside_it.py").write_text(module + "class Mine(ba.NPDController):\n    pass\n")
    (tmp_path / "optuna.py").write_text("raise SystemExit('planted')")
    (tmp_path / "not_installed.py").write_text("raise SystemExit('planted')")
    before = list(sys.path)
    read_study(written(tmp_path, 'name = "a"\n')).rehearse()
    text = 'name = "a"\nbase = { controller.name = "beside_it:Mine", run.impacts = 1 }\n'
    study = read_study(written(tmp_path, text))
    study.rehearse()
    assert "source beside_it:Mine" in study.versions
    assert [*before, str(tmp_path)] == sys.modules["beside_it"].PATH
    assert sys.path == before
    with pytest.raises(ImportError):
        importlib.import_module("not_installed")
    found = ba.study(study, tmp_path / "out", 1)
    assert found.statuses() == {"COMPLETED": (1, "")}


def test_the_versions_of_a_study_are_those_of_its_files_classes_and_plants():
    """A file that is not there has the hash of no bytes, math:sin no source, the rigid plant no engine."""
    values = [("ground.plant", x) for x in ("mujoco", "rigid")] + [("controller.name", "math:sin")]
    assert versions_of([*values, ("gait.name", "none.json"), ("robot.name", "no/robot.toml")]) == {
        "engine of mujoco": importlib.metadata.version("mujoco-core"),
        "file no/robot.toml": (none := hashlib.sha256(b"").hexdigest()[:12]),
        "file none.json": none,
        "source math:sin": "none",
    }


def test_a_stone_out_of_reach_is_said_in_the_row_of_its_walk_alone():
    """A stone at 0.9 m is known to be out of reach only when the walk comes to it: the rehearsal passes."""
    base = {"controller.name": "footstep", "ground.stones": [0.4, 0.9]}
    read_study({"name": "a", "base": base}).rehearse()
    (row,) = run_trials([base])
    assert (row["status"], row["detail"][:23]) == ("REFUSED", "stone 2 is out of reach")


def test_levels_have_both_ends_and_even_steps():
    """Levels have even differences, or even ratios on a logarithmic scale; one level is the lower end."""
    linear = Levels(low=0.1, high=0.7, count=7).levels()
    assert (linear[0], linear[-1]) == (0.1, 0.7)
    assert np.diff(linear) == pytest.approx(0.1)
    log = Levels(low=1e-3, high=10.0, scale="log", count=5).levels()
    assert (log[0], log[-1]) == (1e-3, 10.0)
    assert np.diff(np.log10(log)) == pytest.approx(1.0)
    assert Levels(low=2.0, high=3.0, count=1).levels() == [2.0]


@pytest.mark.parametrize("kind", ["random", "sobol"])
def test_samples_fill_their_ranges_evenly(kind):
    """Samples are scaled back to [0, 1), on a logarithmic scale too: sorted, they deviate from an even spread
    by less than 2/n (Sobol) or 2/sqrt(n) (random); the four whole numbers are equally frequent, to five
    standard deviations. A longer list begins with the shorter one, and another seed gives another list.
    """
    n = 4096
    log, whole = {"from": 1e-3, "to": 1e3, "scale": "log"}, {"from": 2, "to": 5, "whole": True}
    spans = {"start.q1": {"from": -1.0, "to": 3.0}, "controller.b": log, "controller.c": whole}
    draw = Draw(kind=kind, count=n, seed=5, **spans)
    samples = draw.samples()
    assert samples == draw.samples()
    assert samples[:100] == draw.model_copy(update={"count": 100}).samples()
    assert samples != draw.model_copy(update={"seed": 6}).samples()
    pairs = ((s["start.q1"], s["controller.b"]) for s in samples)
    w = np.array([((q + 1) / 4, (math.log10(b) + 3) / 6) for q, b in pairs])
    assert len(w) == n
    assert np.all((w >= 0) & (w <= 1))
    deviation = np.max(np.abs(np.sort(w, axis=0) - (np.arange(n)[:, None] + 0.5) / n))
    assert deviation < (2.0 / n if kind == "sobol" else 2.0 / math.sqrt(n))
    counts = np.bincount([s["controller.c"] for s in samples])[2:]
    assert len(counts) == 4
    assert np.max(np.abs(counts - n / 4)) < (2 if kind == "sobol" else 5 * math.sqrt(n / 4))


def test_paired_ratios_against_a_closed_form():
    """The ratios k/10 of k = 1 .. 20 have the median 1.05, and order statistics 6 and 15 hold 95.9 % by the
    binomial distribution. p is the sign test's: 9 below 1, 10 above, one equal. Infinite numbers are falls; two
    of them have no ratio. 8 of 10 by Wilson's interval.
    """
    y = np.random.default_rng(1).uniform(1.0, 9.0, 20)
    x = y * np.random.default_rng(2).permutation(np.arange(1, 21)) / 10.0
    found = paired(x.tolist(), y.tolist())
    assert found.ratio == pytest.approx((1.05, 0.6, 1.5))
    below, trials = 9, 19  # one ratio is 1
    tail = sum(math.comb(trials, k) for k in range(below + 1)) / 2**trials
    assert found.p == pytest.approx(min(2.0 * tail, 1.0))
    assert found.pairs == 20
    fell = paired([*x[:10], *[math.inf] * 10], y.tolist())
    assert (fell.ratio.high, fell.pairs) == (math.inf, 20)
    assert paired([math.inf], [math.inf]) is None
    assert math.isnan(median([1.0, 2.0]).low)  # too few numbers for an interval
    assert share(8, 10) == pytest.approx((0.8, 0.4902, 0.9433), abs=1e-4)


def test_equal_numbers_have_no_sign_and_one_walk_no_interval():
    """Zeros on both sides are a tie; the next float is none, though its ratio rounds to 1: six pairs on one
    side have p = 2 x 2^-6. One walk has a number without interval or p.
    """
    # [0]: the median ratio, [1:]: p and the number of pairs
    assert paired([0.0, 1.0, 1.0], [0.0, 1.0, 2.0])[0].value == 1.0
    assert paired([0.0, 1.0, 1.0], [0.0, 1.0, 2.0])[1:] == (1.0, 3)
    y = np.array([1.9] * 6)
    x = np.nextafter(y, 2.0)
    assert paired(x.tolist(), y.tolist()).p == 2.0**-5
    assert paired([-1.0] * 6, [-2.0] * 6).p == 2.0**-5
    one = paired([1.0], [2.0])
    assert (one.ratio.value, one.pairs) == (0.5, 1)
    assert np.isnan((one.p, *one.ratio[1:], *share(1, 1)[1:], *median([1.0])[1:])).all()


TABLE = {
    "name": "table",
    "base": {"controller.pause": 0.0},
    "cases": {"a": {"controller.of": 0}, "b": {"controller.of": 1}},
    "conditions": {"x": {"controller.x": 1.0}, "y": {"controller.x": 2.0}},
}


def rows(records):
    """Errors of b are half of those of a at the same seed; under y every fourth walk of b is not feasible."""
    return [_row(record) for record in records]


def _row(record):
    seed, b = record.get("run.seed", record["run.impacts"]), record["controller.of"]
    feasible = int(not (b and record["controller.x"] == 2.0 and seed % 4 == 0))
    error = (0.5 if b else 1.0) * (1.0 + seed)
    row = {"status": "COMPLETED", "survived": 1, "feasible": feasible, "rms_error": error}
    return row | {"impacts": 3, "detail": 'a "quoted", text'}


def test_the_table_pairs_walks_by_seed_and_counts_what_is_feasible(tmp_path):
    """Errors of a are 1 to 20 by seed and those of b half of them; under y the five seeds 0, 4, .. 16 of b are
    not feasible. 20 ratios on one side of 1 have p = 2 x 2^-20 in the sign test.
    """
    tables = TABLE | {"seeds": 20, "base": {"controller.pause": 0.0, "run.impacts": 3}}
    found = plants.carried(tables, tmp_path, rows)
    a_x, a_y, b_x, b_y = found.table()
    assert [(x.name, x.condition) for x in (a_y, b_x)] == [("a", "y"), ("b", "x")]
    assert (a_x.ratio, a_y.ratio) == (None, None)
    assert a_x.median.value == 10.5
    assert b_x.ratio.ratio == (0.5, 0.5, 0.5)
    assert b_x.ratio.p == pytest.approx(2.0**-19)
    assert b_y.ratio.ratio[:2] == (0.5, 0.5)  # the median and its lower end
    assert b_y.feasible == share(15, 20)
    assert (b_y.made, b_y.ratio.pairs) == (20, 20)


def equal(records):
    """As `rows`, but for a under x, where no row depends on the seed, and b under x, where two seeds do."""
    return [
        _row(
            r
            if r["controller.x"] == 2.0
            else r | {"run.seed": r["run.seed"] // (20 - 10 * r["controller.of"])}
        )
        for r in records
    ]


def test_rows_that_are_equal_to_the_last_bit_are_one_walk(tmp_path):
    """`equal` makes rows of which a under x has one and b under x has two that differ, among 20 seeds: they
    count as 1 and 2 walks, so that no interval is made of copies. By a grid over run.seed it is the same.
    """
    tables = TABLE | {"seeds": 20, "base": {"controller.pause": 0.0, "run.impacts": 3}}
    found = plants.carried(tables, tmp_path, equal)
    a_x, a_y, b_x, _ = found.table()
    assert [x.walks for x in (a_x, a_y, b_x)] == [1, 20, 2]
    assert a_x.feasible[:1] == (1.0,)
    assert math.isnan(a_x.feasible.low)
    assert b_x.ratio.pairs == 2
    # its two walks are 0.5 and 1 times those of a; 20 + 20 walks became 1 + 2
    assert (b_x.ratio.ratio.value, b_x.ratio.p) == (0.75, 1.0)
    assert "37 walks are equal" in found.notes[0]
    assert len(list(found.rows())) == 80
    grid = {"grid": {"run.seed": [*range(20)]}}
    grid |= {"base": tables["base"]}
    cells = plants.carried(TABLE | grid, tmp_path / "cells", equal).table()
    assert [x.walks for x in cells[:3]] == [1, 20, 2]


def test_there_is_no_interval_over_declared_walks(tmp_path):
    """Walks of a grid are chosen, not drawn: medians and ratios are stated without interval and p."""
    tables = TABLE | {"grid": {"run.impacts": list(range(1, 21))}}
    found = plants.carried(tables, tmp_path, rows)
    for line in found.table():
        assert math.isnan(line.feasible.low)
        assert math.isnan(line.median.low)
        assert line.ratio is None or (math.isnan(line.ratio.p) and math.isnan(line.ratio.ratio.low))
    assert found.table()[2].ratio.ratio.value == 0.5  # line 2 is of case b under x, line 0 of a


def test_tables_come_back_to_the_last_bit(tmp_path):
    """Each number in the CSV is the same float as in the results; 1/900 has no short decimal form."""
    tables = TABLE | {"grid": {"run.impacts": [1, 2], "hardware.period": [1e-3, 1 / 900]}}
    found = plants.carried(tables, tmp_path, rows)
    expected = list(found.rows())
    assert {row["run.impacts"] for row in expected} == {1, 2}
    found.export(tmp_path / "r.csv")
    with open(tmp_path / "r.csv", newline="", encoding="utf-8") as file:
        for row, known in zip(csv.DictReader(file), expected, strict=True):
            assert {k: str(x) for k, x in known.items()} == row
            assert float(row["rms_error"]) == known["rms_error"]
    with pytest.raises(InputError, match=r"expected .csv"):
        found.export(tmp_path / "r.xlsx")


def test_an_axis_with_many_numbers_is_cut_into_cells_of_equal_width():
    """More than 40 numbers make 20 cells of equal width, of about 1000 of 20 000 uniform numbers each; few
    levels have a cell each, numbers first, then none, then texts.
    """
    x = np.random.default_rng(2).uniform(-1.0, 1.0, 20_000)
    cells, names = cut(x.tolist())
    assert len(names) == 20
    assert np.bincount(cells) == pytest.approx(1000, rel=0.15)
    assert np.array_equal(cells, np.clip(np.floor((x - x.min()) / np.ptp(x) * 20), 0, 19))
    assert cut(["b", "", None])[0].tolist() == [2, 1, 0]
    cells, names = cut([0.3, None, "a", 0.1, 0.3])
    assert (cells.tolist(), names) == ([1, 2, 3, 0, 1], ["0.1", "0.3", "none", "a"])
