"""Studies from files: what they mean, what is refused, and samples by what is known of them."""

import itertools
import math
import tracemalloc

import numpy as np
import pytest

from biped_adrc.bench import parameters
from biped_adrc.bench.parameters import quantity, unit_of
from biped_adrc.bench.run import run_trial
from biped_adrc.bench.study import BLOCK, Draw, Range, Study
from biped_adrc.bench.study_file import load_study, read_study
from biped_adrc.errors import InputError
from biped_adrc.scenario.scenario import DEFAULTS, FIELDS, UNITS, Scenario

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


def test_a_study_without_conditions_has_the_hash_that_it_had(tmp_path):
    study = load_study(written(tmp_path, TWO_SETS.partition("[[conditions]]")[0]))
    assert study.hash == "40bcef94fffe2483b64d374cee8ccada"
    assert study.hash != load_study(written(tmp_path, TWO_SETS)).hash


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (TWO_SETS.replace("onset = 0.1", 'controller = "PD"'), "conditions.2..controller.*cases.1"),
        (TWO_SETS.replace("onset = 0.1", 'gait = "v0.5"'), "conditions.2..gait.*'grid'"),
        (TWO_SETS.replace("onset = 0.1", "onset = -1"), "conditions.2..onset"),
        (TWO_SETS.replace('"paper"', '"none"'), "conditions: have the names"),
        (TWO_SETS.replace("amplitude = 0", ""), "'condition': 'none'.*without a push"),
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


def test_points_are_not_kept(tmp_path):
    many = STUDY.replace("count = 4", "count = 1_000_000").replace("seeds = 3", "seeds = 40")
    study = load_study(written(tmp_path, many))
    assert study.count == 24 * 40 * 10**6
    list(itertools.islice(study.points(), 100))
    tracemalloc.start()
    for _ in itertools.islice(study.points(), 3000):
        pass
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 1_000_000


def changed(old, new):
    assert old in STUDY
    return STUDY.replace(old, new)


@pytest.mark.parametrize(
    ("text", "messages"),
    [
        (changed("bandwidth", "bandwith"), ["grid.bandwith", "did you mean 'bandwidth'"]),
        (changed("[grid]", "[gird]"), ["gird", "did you mean 'grid'"]),
        (changed("seeds = 3", "seed = 3"), ["study.seed", "did you mean 'seeds'"]),
        (changed("seeds = 3", "seeds = 0"), ["study.seeds", "found 0"]),
        (changed("seeds = 3", "seeds = [1, 1]"), ["study.seeds", "different"]),
        (changed('name = "robustness"', ""), ["study.name", "expected a text"]),
        (changed('"0.5 ms"', '"0.5 mm"'), ["grid.period", "0.5 mm", "such as 's'"]),
        (changed('"0.5 ms"', '"0.5 furlongs"'), ["grid.period", "'furlongs' is not known"]),
        (changed('"0.5 ms"', '"500 ms"'), ["grid.period", "0.5 in SI", "less than or equal to 0.1 [s]"]),
        (changed('"0.5 ms"', "true"), ["grid.period", "found True", "expected a number [s]"]),
        (changed('"0.5 ms"', "1e-3"), ["grid.period", "given twice"]),
        (changed('["0.5 ms", 1e-3]', "[]"), ["grid.period", "expected a list"]),
        (changed('["0.5 ms", 1e-3]', "1e-3"), ["grid.period", "expected a list"]),
        (changed("start.v5", "start.w5"), ["grid.start.w5", "coordinates such as 'q5'"]),
        (changed('"100 rad/s"', '"100 Hz"'), ["grid.bandwidth", "another dimension", "rad/s"]),
        (changed('"100 rad/s"', "2000"), ["grid.bandwidth", "expected from < to"]),
        (changed('"100 rad/s"', "-5"), ["grid.bandwidth", "greater than 0"]),
        (changed('"log"', '"cubic"'), ["grid.bandwidth", "'linear' or 'log'"]),
        (changed("count = 3", "count = 2.5"), ["grid.bandwidth", "found count 2.5"]),
        (changed("count = 3,", ""), ["grid.bandwidth", "found count None"]),
        (changed("count = 4", ""), ["sobol.count", "found None"]),
        (changed("seed = 1", ""), ["sobol.seed", "found None"]),
        (changed("noise = {", "period = {"), ["sobol.period", "found 0"]),
        (changed("[sobol]", "[random]\n[sobol]"), ["there is [random] too"]),
        (changed('"pulse"', '"puls"'), ["cases[2].push", "'puls'", "'pulse'"]),
        (changed('"30 N m"', '"30 N"'), ["cases[2].amplitude", "such as 'N m'"]),
        (changed('name = "calm"', ""), ["cases[1].name"]),
        (changed('"calm"', '"pushed"'), ["cases", "different"]),
        (changed('controller = "LESO"', "period = 1e-3"), ["grid.period", "given in 'fixed' too"]),
        (changed('controller = "LESO"', "seed = 4"), ["seed", "given in 'fixed' too"]),
        (changed('controller = "LESO"', "controller = 5"), ["fixed.controller", "found 5", "string"]),
        (changed("[grid]", "[grid"), ["is not TOML", "line 8"]),
        (changed("count = 4", "count = 1_000_000_000"), ["7.2e+10 points", "at most 1e+09"]),
        (changed("seeds = 3", "seeds = [9223372036854775808]"), ["study.seeds", "expected how many"]),
        (changed('"0.5 ms"', '"1e999 s"'), ["grid.period", "1e999 is too large"]),
        (changed('"0.5 ms"', '"5 km^999"'), ["grid.period", "power 999, expected at most 9"]),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named(tmp_path, text, messages):
    with pytest.raises(InputError) as caught:
        load_study(written(tmp_path, text))
    assert "study.toml" in str(caught.value)
    for message in messages:
        assert message in str(caught.value)


def test_everything_that_is_wrong_is_said_at_once(tmp_path):
    text = (
        STUDY.replace("bandwidth", "bandwith")
        .replace("0.5 ms", "0.5 kg")
        .replace("seed = 1", "seed = -1")
    )
    with pytest.raises(InputError) as caught:
        load_study(written(tmp_path, text))
    lines = str(caught.value).splitlines()
    assert "has 3 problems" in lines[0]
    assert [line.split(":")[0].strip() for line in lines[1:]] == [
        "grid.bandwith",
        "grid.period",
        "sobol.seed",
    ]


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


def test_every_level_of_an_axis_is_looked_at():
    grid = {"impacts": [25] * 1, "seed": {"from": 0, "to": 9999, "count": 10_000}}
    grid |= {"pushed_step": [1, 26]}
    tables = {"study": {"name": "a"}, "grid": grid, "fixed": {"push": "pulse", "amplitude": 1.0}}
    with pytest.raises(InputError, match="pushed_step = 26 of 25 steps"):
        read_study(tables)


def test_points_all_over_a_study_are_looked_at():
    """Both axes fit with the first of the other, and not together."""
    grid = {"push": ["none", "pulse"], "pushed_step": [1, *range(20, 30)]}
    tables = {"study": {"name": "a"}, "grid": grid}
    with pytest.raises(InputError, match=r"pushed_step = 2[6-9] of 25 steps"):
        read_study(tables)


def test_a_byte_order_mark_is_no_part_of_the_file(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(STUDY, encoding="utf-8-sig")
    assert load_study(path) == load_study(written(tmp_path, STUDY))


def test_what_is_wrong_has_no_web_address():
    with pytest.raises(InputError) as caught:
        read_study({"study": {"name": "a"}, "grid": {"controller": [5]}})
    row = run_trial({"K_p": -1.0})
    assert (row["status"], row["detail"]) == (
        "REFUSED",
        "K_p: found -1.0, should be greater than 0",
    )
    assert "http" not in str(caught.value)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(InputError, match="No such file"):
        load_study(tmp_path / "none.toml")


@pytest.mark.parametrize("name", [n for n in FIELDS if n not in parameters.TABLES])
def test_every_parameter_reads_its_own_default(name):
    default = DEFAULTS[name]
    assert parameters.read(name, "none" if default is None else default) == default
    unit_of(UNITS[name])


@pytest.mark.parametrize(
    ("text", "unit", "number"),
    [
        ("1.5 ms", "s", 1.5e-3),
        ("0.1ms", "s", 1e-4),
        ("180 deg", "rad", math.pi),
        ("60 rpm", "rad/s", 2 * math.pi),
        ("30 N m", "N m", 30.0),
        ("30 J", "N m", 30.0),
        ("2 kN*m/s", "N m/s", 2000.0),
        ("5 %", "1", 0.05),
        ("3e2 1/s^2", "1/s^2", 300.0),
        ("7 1/min", "Hz", 7 / 60),
        ("-2.5e-3", "m", -2.5e-3),
        ("9.81 m/s^2", "m/s^2", 9.81),
        ("1 kg m^2/s^2", "N m", 1.0),
        ("2 cm", "m", 0.02),
    ],
)
def test_units(text, unit, number):
    assert quantity(text, unit) == pytest.approx(number, rel=4e-16)


def test_decimal_prefixes_are_exact():
    for k in range(1, 2000):
        assert quantity(f"{k / 100} ms", "s") == float(f"{k / 100}e-3")
        assert quantity(f"{k} us", "s") == float(f"{k}e-6")


@pytest.mark.parametrize(
    "text",
    ["ms", "1,5 ms", "1.5 ms s", "five", "", "1 m/", "nan s", "1 kdeg", "1 s^", "1 s^10/s^9"],
)
def test_texts_that_are_no_times(text):
    with pytest.raises(ValueError, match=r"expected|not known"):
        quantity(text, "s")


@pytest.mark.parametrize(
    "given", [(2.0, 9.0, "linear"), (0.5, 80.0, "log"), (3, 7, "linear", True)]
)
def test_the_share_of_a_value_of_a_range_gives_it_back(given):
    made = Range(**dict(zip(("low", "high", "scale", "whole"), given, strict=False)))
    for w in (0.0, 0.3, 0.77, 0.999):
        assert made.at(made.share(made.at(w))) == pytest.approx(made.at(w), rel=1e-12)
    assert 0.0 <= made.share(made.low) < made.share(made.high) <= 1.0


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


def test_tables_of_python_are_read_alike():
    study = read_study({"study": {"name": "a"}, "grid": {"K_p": [1.0, 2.0], "start.q1": [0.1]}})
    assert [p.record for p in study.points()] == [
        {"K_p": 1.0, "hardware": "ideal", "start": {"q1": 0.1}},
        {"K_p": 2.0, "hardware": "ideal", "start": {"q1": 0.1}},
    ]
    with pytest.raises(InputError, match=r"the study, grid.K_q: unknown parameter"):
        read_study({"study": {"name": "a"}, "grid": {"K_q": [1.0]}})


@pytest.mark.parametrize("text", ["a = " + "[" * 3000 + "]" * 3000, "a = " + "9" * 5000])
def test_what_the_parser_cannot_hold_is_a_sentence(text, tmp_path):
    path = tmp_path / "a.toml"
    path.write_text(text)
    with pytest.raises(InputError, match=r"study file '.*a\.toml' is not TOML"):
        load_study(path)
