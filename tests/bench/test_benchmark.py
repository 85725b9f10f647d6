"""The frozen benchmark: its file, a controller walked under it, and what is refused of a published result."""

import json
import math
from importlib.resources import files
from pathlib import Path

import pytest

import biped_adrc as ba
from biped_adrc.bench import benchmark_result, benchmark_run, compare_study
from biped_adrc.bench.benchmark import (
    BENCHMARKS,
    METRICS,
    REFERENCE,
    Benchmark,
    benchmark_of,
    cells,
    held_against,
    load_benchmark,
)
from biped_adrc.bench.benchmark_run import run_benchmark
from biped_adrc.bench.parameters import trial
from biped_adrc.bench.run import run_trial
from biped_adrc.campaign.workers import Threads
from biped_adrc.errors import InputError

ROOT = Path(__file__).resolve().parents[2]
OWN = "standin_controller:StandinController"
DEFINITION = {
    "base": {"impacts": 4},
    "conditions": {
        "calm": {"words": "nothing", "place": "ideal 1 kHz", "values": {}},
        "push": {
            "words": "a push",
            "place": "RABBIT, 1 ms",
            "values": {"push": "pulse", "amplitude": 9.0},
        },
    },
    "seeds": [70, 71, 72, 73],
    "metrics": list(METRICS),
    "free": ["K_p", "filter_time"],
    "contestants": {"NPD": {"controller": "NPD"}},
    "places": {"ideal 1 kHz": {"NPD": {"K_p": 1.0}}, "RABBIT, 1 ms": {"NPD": {"K_p": 2.0}}},
    "versions": {},
}


def made_up(records):
    """Rows whose error is the seed times the gain K_p; the pushed walk of seed 73 is not legal."""
    found = []
    for r in records:
        legal = not ("amplitude" in r and r["seed"] == 73)
        error = 1e-3 * r["seed"] * r.get("K_p", 10.0)
        row = dict.fromkeys(METRICS, 1.0) | {"survived": 1, "legal": int(legal), "rms_error": error}
        found.append(row | {"status": "COMPLETED", "detail": ""})
    return found


def frozen(told=DEFINITION):
    """The bytes of a benchmark whose reference has walked by `made_up`."""
    bare = benchmark_of("walkbench-1", json.dumps(told | {"walks": {}}).encode())
    walks = {
        name: [
            bare.kept(made_up([bare.record(name, bare.reference("NPD", known["place"]), seed)])[0])
            for seed in bare.seeds
        ]
        for name, known in bare.conditions.items()
    }
    return json.dumps(told | {"walks": {"NPD": walks}}).encode()


@pytest.fixture
def bench(monkeypatch) -> Benchmark:
    """A small benchmark in place of the packaged one; walks are made up."""
    found = benchmark_of("walkbench-1", frozen())
    for module in (benchmark_run, benchmark_result):
        monkeypatch.setattr(module, "load_benchmark", lambda name: found)
    monkeypatch.setattr(compare_study, "run_trials", made_up)
    return found


@pytest.fixture
def result(bench, tmp_path):
    """The result of a class with its defaults, all seeds, and its file."""
    found = run_benchmark("walkbench-1", OWN, tmp_path, "typed", workers=Threads(1))
    return found, tmp_path / "walkbench-1.json"


def test_the_hash_of_the_frozen_file_is_that_of_the_guide():
    for name in BENCHMARKS:
        guide = (ROOT / "docs" / "guide" / "walkbench.md").read_text(encoding="utf-8")
        assert f"frozen file of `{name}` has the SHA-256 `{load_benchmark(name).hash}`" in guide


def test_a_changed_condition_changes_the_hash():
    for name in BENCHMARKS:
        data = files("biped_adrc.bench").joinpath(f"{name}.json").read_bytes()
        told = json.loads(data)
        told["conditions"]["RABBIT pushed"]["values"]["amplitude"] += 1e-9
        same, other = (benchmark_of(name, x).hash for x in (data, json.dumps(told).encode()))
        assert same == load_benchmark(name).hash != other


def test_the_frozen_walks_are_those_of_its_settings():
    """A calm walk and one on the robot's hardware, of the controller that is walked with every result."""
    bench = load_benchmark("walkbench-1")
    for condition, seed in (("nothing", 0), ("RABBIT pushed", 3)):
        values = bench.reference(REFERENCE, bench.conditions[condition]["place"])
        row = run_trial(bench.record(condition, values, bench.seeds[seed]))
        assert bench.kept(row) == pytest.approx(bench.walks[REFERENCE][condition][seed], rel=1e-4)


def test_the_frozen_file_is_complete_and_its_seeds_are_new():
    bench = load_benchmark("walkbench-1")
    assert min(bench.seeds) >= 9000
    assert len(set(bench.seeds)) == 20
    for name in bench.contestants:
        assert list(bench.walks[name]) == list(bench.conditions)
        assert {len(rows) for rows in bench.walks[name].values()} == {20}
    for condition, known in bench.conditions.items():
        for name in bench.contestants:
            trial(bench.record(condition, bench.reference(name, known["place"]), 9000))


def test_a_result_is_read_as_it_was_written(result):
    told, path = result
    found = ba.read_bench_result(path)
    assert (found.bench, found.controller, found.settings) == ("walkbench-1", OWN, {})
    assert (found.publishable, found.why) == (True, "")
    assert json.loads(path.read_text()) == json.loads(json.dumps(told))
    assert told["machine"]["agrees"]
    assert told["machine"]["largest_difference"] == 0.0
    assert set(told["controller"]["source"]) == {f"source {OWN}", f"module of {OWN}"}
    assert found.cells["calm"]["rms_error"][0] == pytest.approx(0.715)
    assert found.cells["push"]["legal"][0] == 0.75
    assert found.cells["push"]["rms_error"][0] == pytest.approx(0.71), "over legal walks"
    assert found.cells["push"]["ranked_rms_error"][0] == pytest.approx(0.715)
    assert found.cells["push"]["ranked_rms_error"][2] == "inf"
    assert found.against["push"]["rms_error"]["pairs"] == 3
    assert found.against["push"]["rms_error"]["value"][0] == pytest.approx(5.0)
    assert found.against["calm"]["rms_error"]["value"][0] == pytest.approx(10.0)


def test_settings_by_place_reach_the_walks(bench, tmp_path):
    path = tmp_path / "mine.toml"
    text = f'[places."ideal 1 kHz"]\n"{OWN}" = {{ K_p = 3.0, own.gain = 2.0 }}\n'
    path.write_text(text)
    told = run_benchmark("walkbench-1", OWN, tmp_path / "out", "", path, workers=Threads(1))
    found = ba.read_bench_result(tmp_path / "out" / "walkbench-1.json")
    assert found.settings == {
        "ideal 1 kHz": {"K_p": 3.0, "own.gain": 2.0},
        "RABBIT, 1 ms": {},
    }
    assert told["cells"]["calm"]["rms_error"][0] == pytest.approx(3 * 0.0715)
    assert told["cells"]["push"]["rms_error"][0] == pytest.approx(0.71)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{} = {{ delay = 0.0 }}", "'delay' is not the controller's to choose"),
        ("other = {{ K_p = 1.0 }}", "has no values of 'standin.*'other'"),
        ("{} = {{ K_pp = 1.0 }}", "K_pp"),
    ],
)
def test_settings_that_are_not_the_controllers_are_refused(bench, tmp_path, text, message):
    path = tmp_path / "mine.toml"
    path.write_text('[places."ideal 1 kHz"]\n' + text.format(f'"{OWN}"'))
    with pytest.raises(InputError, match=message):
        run_benchmark("walkbench-1", OWN, tmp_path / "out", "", path, workers=Threads(1))
    assert not (tmp_path / "out").exists()


def test_fewer_seeds_are_a_partial_result(bench, tmp_path):
    told = run_benchmark("walkbench-1", OWN, tmp_path, "", seeds=2, workers=Threads(1))
    found = ba.read_bench_result(tmp_path / "walkbench-1.json")
    assert told["seeds"] == [70, 71]
    assert told["machine"]["agrees"]
    assert (found.publishable, found.why) == (False, "it is partial, with 2 of 4 seeds")
    for seeds in (0, 5):
        with pytest.raises(InputError, match="expected 1 to the 4"):
            run_benchmark("walkbench-1", OWN, tmp_path, "", seeds=seeds, workers=Threads(1))


@pytest.mark.parametrize(
    ("factor", "legal", "agrees"), [(1.005, 1, True), (1.02, 1, False), (1.0, 0, False)]
)
def test_a_machine_that_gives_other_numbers_is_told(
    bench, tmp_path, monkeypatch, factor, legal, agrees
):
    def elsewhere(records):
        rows = [row | {"rms_error": factor * row["rms_error"]} for row in made_up(records)]
        for r, row in zip(records, rows, strict=True):
            row["legal"] *= legal if r["seed"] == 70 else 1
        return rows

    monkeypatch.setattr(compare_study, "run_trials", elsewhere)
    told = run_benchmark("walkbench-1", "NPD", tmp_path, "", workers=Threads(1))
    assert told["machine"]["agrees"] is agrees, told["machine"]
    assert told["publishable"] is agrees
    assert ("walked anew, has other numbers" in told["why"]) == (not agrees)


def alter(told, path, value):
    """The result with another value at a path of keys."""
    *inner, last = path
    part = told
    for key in inner:
        part = part[key]
    part[last] = value
    return told


@pytest.mark.parametrize(
    ("where", "value", "message"),
    [
        (["schema"], "walkbench result 0", "schema 'walkbench result 0', expected"),
        (["hash"], "0" * 64, "is of another 'walkbench-1', 000000000000; the frozen file has"),
        (["seeds"], [70, 71, 72, 74], "found the seeds"),
        (["seeds"], [], "found the seeds"),
        (["metrics"], ["legal"], "found the conditions"),
        (["walks"], {"calm": []}, "found the conditions"),
        (["walks", "push"], [[1, 1, 1.0, 1.0, 1.0, 1.0]], "'push' has 1 walks, expected 4"),
        (["walks", "push", 3, 1], 1, "its 'cells' do not follow from its walks"),
        (["cells", "push", "legal", 0], 1.0, "its 'cells' do not follow"),
        (["against", "calm", "legal"], 0.5, "its 'against' do not follow"),
        (["reference", "NPD", "calm", "legal", 0], 0.1, "its 'reference' do not follow"),
        (["controller", "settings"], {"ideal 1 kHz": {"delay": 0.0}}, "'delay' is not the"),
        (["controller", "settings"], {"moon": {}}, "found the place 'moon'"),
        (["machine", "agrees"], False, "publishable: True, but NPD, walked anew"),
        (["why"], "it was raining", "publishable: True, but nothing is amiss"),
        (["walks", "push", 3, 2], "much", "'push' has a walk with 'much', expected finite numbers"),
        (["walks", "push", 3, 2], math.nan, "'push' has a walk with nan, expected finite numbers"),
        (["walks", "push", 3], [1, 0, 1.0], "'push' has 4 walks, expected 4, each of all metrics"),
        (["machine"], None, "result of a benchmark"),
    ],
)
def test_an_altered_result_is_refused(result, where, value, message):
    told, path = result
    altered = alter(json.loads(path.read_text()), where, value)
    path.write_text(json.dumps(altered))
    with pytest.raises(InputError, match=message):
        ba.read_bench_result(path)
    assert told["schema"] != "walkbench result 0"


def test_a_file_that_is_no_result_is_refused(tmp_path):
    path = tmp_path / "x.json"
    with pytest.raises(InputError, match="not found"):
        ba.read_bench_result(path)
    for text, message in (("{", "not valid JSON"), ("{}", "schema"), ("[]", "result of a bench")):
        path.write_text(text)
        with pytest.raises(InputError, match=message):
            ba.read_bench_result(path)


def test_a_result_under_an_altered_condition_is_refused(result, monkeypatch):
    _, path = result
    told = json.loads(json.dumps(DEFINITION))
    told["conditions"]["push"]["values"]["amplitude"] = 9.5
    other = benchmark_of("walkbench-1", frozen(told))
    monkeypatch.setattr(benchmark_result, "load_benchmark", lambda name: other)
    with pytest.raises(InputError, match="is of another 'walkbench-1'"):
        ba.read_bench_result(path)


def test_walks_that_are_not_legal_rank_as_worst():
    bench = benchmark_of("walkbench-1", frozen())
    rows = [[1, int(i == 0), 0.5, 0.5, 1.0, 1.0] for i in range(4)]
    found = cells(bench, {"calm": rows})["calm"]
    assert found["rms_error"] == [0.5, 0.5, 0.5]
    assert found["ranked_rms_error"][0] == "inf"
    against = held_against(bench, {"calm": rows}, bench.walks["NPD"])["calm"]
    assert against["rms_error"]["pairs"] == 1
    assert against["legal"] == pytest.approx(2.0**-2)
    fallen = {"calm": [[0, 0, None, None, None, None]] * 4}
    assert cells(bench, fallen)["calm"]["rms_error"] is None
    assert held_against(bench, fallen, bench.walks["NPD"])["calm"]["rms_error"] is None
    assert math.isfinite(found["legal"][1])


def test_a_benchmark_that_there_is_not():
    with pytest.raises(InputError, match="no benchmark 'walkbench-0', expected one of"):
        load_benchmark("walkbench-0")
