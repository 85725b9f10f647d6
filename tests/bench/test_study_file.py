"""Studies from files: what they mean, what is refused, and samples by what is known of them."""

import math

import numpy as np
import pytest

from biped_adrc.bench.study import BLOCK, Draw, Range, Study
from biped_adrc.bench.study_file import load_study, read_study
from biped_adrc.errors import InputError
from biped_adrc.scenario.scenario import Scenario

STUDY = """
[study]
name = "robustness"
seeds = 3
[fixed]
controller = "LESO"
torque_limit = "150 N m"
[grid]
bandwidth = { from = "100 rad/s", to = 1000, count = 3, scale = "log" }
period = ["0.5 ms", 1e-3]
start.v5 = [-0.1, "5 deg/s"]
[sobol]
count = 4
seed = 1
noise = { from = 0, to = "0.1 deg" }
[[cases]]
name = "calm"
[[cases]]
name = "pushed"
push = "pulse"
amplitude = "30 N m"
torque_limit = "none"
"""


def written(tmp_path, text):
    path = tmp_path / "study.toml"
    path.write_text(text)
    return path


TWO_SETS = """
[study]
name = "pushes"
[fixed]
amplitude = "30 N m"
push = "pulse"
[grid]
gait = ["published", "v0.5"]
[[cases]]
name = "NPD"
controller = "NPD"
[[cases]]
name = "ADRC"
[[conditions]]
name = "none"
push = "none"
amplitude = 0
[[conditions]]
name = "paper"
onset = 0.1
"""


def test_conditions_are_crossed_with_cases(tmp_path):
    study = load_study(written(tmp_path, TWO_SETS))
    points = list(study.points())
    assert study.varied == ("case", "condition", "gait")
    assert [study.levels(name) for name in study.varied] == [2, 2, 2]
    assert len(points) == study.count == 8
    at = {(p.at["case"], p.at["condition"]): p.record for p in points if p.at["gait"] == "v0.5"}
    assert len(at) == 4
    assert "push" not in at["NPD", "none"]
    assert at["NPD", "paper"]["controller"] == "NPD"
    assert at["ADRC", "paper"]["onset"] == 0.1
    assert Study.model_validate(study.configuration()) == study


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (TWO_SETS.replace("onset = 0.1", 'controller = "PD"'), "conditions.2..controller.*cases.1"),
        (TWO_SETS.replace('"paper"', '"none"'), "conditions: have the names"),
    ],
)
def test_a_condition_that_does_not_fit_is_named(tmp_path, text, said):
    with pytest.raises(InputError, match=said):
        load_study(written(tmp_path, text))


def test_points_are_all_combinations_in_si_units(tmp_path):
    study = load_study(written(tmp_path, STUDY))
    points = list(study.points())
    assert len(points) == study.count == 2 * 3 * 2 * 2 * 4 * 3
    names = ("case", "bandwidth", "period", "start.v5", "noise", "seed")
    assert study.varied == names == tuple(points[0].at)
    assert len({tuple(p.at.values()) for p in points}) == study.count
    assert [study.levels(name) for name in names] == [2, 3, 2, 2, 4, 3]
    assert study.levels("impacts") == 1
    assert {p.at["period"] for p in points} == {0.5e-3, 1e-3}
    assert {p.at["start.v5"] for p in points} == {-0.1, math.radians(5.0)}
    assert sorted({p.at["bandwidth"] for p in points}) == pytest.approx(
        [100, 100 * 10**0.5, 1000], rel=1e-14
    )
    for p in points:
        trial = Scenario(**p.record)
        assert (trial.start["v5"], trial.noise, trial.seed) == tuple(p.at[k] for k in names[3:])
        pushed = p.at["case"] == "pushed"
        assert (trial.torque_limit, trial.amplitude) == ((None, 30.0) if pushed else (150.0, 0.0))
        assert trial.record() == p.record


def test_a_study_comes_back_from_its_configuration(tmp_path):
    study = load_study(written(tmp_path, STUDY))
    again = Study.model_validate(study.configuration())
    assert again == study
    assert again.hash == study.hash
    assert load_study(written(tmp_path, STUDY.replace("seed = 1", "seed = 2"))).hash != study.hash
    assert load_study(written(tmp_path, STUDY + "\n# a remark\n")).hash == study.hash
    told = STUDY.replace("seeds = 3", 'seeds = 3\ndescription = "why"')
    assert load_study(written(tmp_path, told)).hash == study.hash


def changed(old, new):
    assert old in STUDY
    return STUDY.replace(old, new)


@pytest.mark.parametrize(
    ("text", "messages"),
    [
        (changed("bandwidth", "bandwith"), ["grid.bandwith", "did you mean 'bandwidth'"]),
        (changed("[grid]", "[gird]"), ["gird", "did you mean 'grid'"]),
        (changed('"0.5 ms"', '"0.5 mm"'), ["grid.period", "0.5 mm", "such as 's'"]),
        (changed('"0.5 ms"', '"0.5 furlongs"'), ["grid.period", "'furlongs' is not known"]),
        (
            changed('"0.5 ms"', '"500 ms"'),
            ["grid.period", "0.5 in SI", "less than or equal to 0.1 [s]"],
        ),
        (changed('"100 rad/s"', "2000"), ["grid.bandwidth", "expected from < to"]),
        (changed('name = "calm"', ""), ["cases[1].name"]),
        (changed('controller = "LESO"', "seed = 4"), ["seed", "given in 'fixed' too"]),
        (changed("[grid]", "[grid"), ["is not TOML", "line 8"]),
        (
            changed("seeds = 3", "seeds = [9223372036854775808]"),
            ["study.seeds", "expected how many"],
        ),
    ],
)
def test_what_is_wrong_is_named(tmp_path, text, messages):
    with pytest.raises(InputError) as caught:
        load_study(written(tmp_path, text))
    assert "study.toml" in str(caught.value)
    for message in messages:
        assert message in str(caught.value)


def test_values_that_do_not_fit_together_are_named_by_their_point(tmp_path):
    grid = {"push": ["pulse", "none"], "amplitude": ["30 N m"]}
    with pytest.raises(
        InputError, match=r"at \{'push': 'none', 'amplitude': 30.0\}: .*without a push"
    ):
        read_study({"study": {"name": "a"}, "grid": grid})
    late = {
        "study": {"name": "a"},
        "grid": {"seed": {"from": 0, "to": 4999, "count": 5000}, **grid},
    }
    late["grid"]["push"] = ["pulse"]
    study = read_study(late)
    beyond = study.model_copy(update={"fixed": {"friction_error": 0.1}})
    assert (
        next(beyond.points()).record["friction_error"] == 0.1
    )  # a row that is refused, no end of the study


def test_levels_have_both_ends_and_even_steps():
    linear = Range(low=0.1, high=0.7, scale="linear").levels(7)
    assert (linear[0], linear[-1]) == (0.1, 0.7)
    assert np.diff(linear) == pytest.approx(0.1)
    assert Range(low=-0.3, high=0.3).levels(7)[3] == 0.0
    log = Range(low=1e-3, high=10.0, scale="log").levels(5)
    assert (log[0], log[-1]) == (1e-3, 10.0)
    assert np.diff(np.log10(log)) == pytest.approx(1.0)


@pytest.mark.parametrize("kind", ["random", "sobol"])
def test_samples_fill_their_ranges_evenly(kind):
    n = 4 * BLOCK
    ranges = {
        "a": Range(low=-1.0, high=3.0),
        "b": Range(low=1e-3, high=1e3, scale="log"),
        "c": Range(low=2, high=5, whole=True),
    }
    draw = Draw(kind=kind, count=n, seed=5, ranges=ranges)
    samples = list(draw.samples())
    assert samples == list(draw.samples())
    assert samples[:100] == list(draw.model_copy(update={"count": 100}).samples())
    assert samples != list(draw.model_copy(update={"seed": 6}).samples())
    w = np.array([((s["a"] + 1) / 4, (math.log10(s["b"]) + 3) / 6) for s in samples])
    assert len(w) == n
    assert np.all((w >= 0) & (w <= 1))
    deviation = np.max(np.abs(np.sort(w, axis=0) - (np.arange(n)[:, None] + 0.5) / n))
    assert deviation < (2.0 / n if kind == "sobol" else 2.0 / math.sqrt(n))
    counts = np.bincount([s["c"] for s in samples])[2:]
    assert len(counts) == 4
    assert np.max(np.abs(counts - n / 4)) < (2 if kind == "sobol" else 5 * math.sqrt(n / 4))
