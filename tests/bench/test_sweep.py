"""From a study file to results: tables, exports and maps by counting, and the command."""

import csv
import json
import math

import numpy as np
import pytest
from matplotlib.figure import Figure
from typer.testing import CliRunner

from biped_adrc.bench.build import scene_of
from biped_adrc.bench.export import export, sweep_map
from biped_adrc.bench.run import run_trials
from biped_adrc.bench.study import rehearse
from biped_adrc.bench.study_file import read_study
from biped_adrc.bench.sweep import load_sweep, sweep
from biped_adrc.campaign.dask_cluster import Cluster
from biped_adrc.campaign.workers import Processes, Threads
from biped_adrc.cli import app
from biped_adrc.cli import sweep as _  # noqa: F401
from biped_adrc.errors import InputError
from biped_adrc.resources import data_folder
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.viz.plots.sweep_maps import MOST_LEVELS, Maps, cell_means, cut, sweep_map_figure

TABLES = {
    "study": {"name": "stand-in", "seeds": 5},
    "grid": {
        "K_p": {"from": 100, "to": 1600, "count": 5, "scale": "log"},
        "period": ["0.5 ms", "1 ms"],
        "controller": ["ADRC", "NPD"],
        "impacts": [3, 4],
    },
}


def stand_in(records):
    """Who survives is known: gains below 500, for NPD at 1 ms."""
    return [_row(record) for record in records]


def _row(record):
    K_p, period = record["K_p"], record.get("period", 1e-3)
    lost = record.get("controller") == "NPD" and period == 1e-3 and K_p > 500
    return {
        "status": "FALLEN" if lost else "COMPLETED",
        "detail": 'a "quoted", text' if lost else "",
        "survived": int(not lost),
        "impacts": 1 if lost else record.get("impacts", 25),
        "rms_error": None if lost else math.sin(K_p) * period + record.get("seed", 0),
        "speed": None if lost else K_p / 3.0,
    }


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    out = tmp_path_factory.mktemp("sweep")
    return sweep(read_study(TABLES), out, Threads(2), function=stand_in)


def test_the_table_has_a_row_for_each_point(done):
    table = done.table()
    assert len(table) == done.study.count == 200
    assert done.names()[:5] == ["K_p", "period", "controller", "parameter.impacts", "seed"]
    lost = (table["controller"] == "NPD") & (table["period"] == 1e-3) & (table["K_p"] > 500)
    assert np.array_equal(table["survived"] == 0, lost)
    assert np.array_equal(np.isnan(table["speed"]), lost)
    assert done.statuses() == {"COMPLETED": 200 - lost.sum(), "FALLEN": lost.sum()}
    few = table.where({"controller": "NPD", "seed": 3})
    few = few.where(few["K_p"] > 500)
    assert (len(few), few["survived"].mean()) == (8, 0.5)
    for wrong in (
        lambda: table["sped"],
        lambda: done.table("sped"),
        lambda: table.where({"sped": 1}),
    ):
        with pytest.raises(InputError, match="no column 'sped'"):
            wrong()


def test_results_are_found_again(done):
    again = load_sweep(done.path.parent)
    assert again.study == done.study
    assert list(again.rows()) == list(done.rows())
    with pytest.raises(InputError, match="no results file"):
        load_sweep(done.path.parent / "elsewhere")


def test_csv_comes_back_to_the_last_bit(done, tmp_path):
    path = tmp_path / "new" / "r.csv"
    export(done, path)
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    names = done.names()
    for row, expected in zip(rows, done.rows(), strict=True):
        assert list(row) == names
        for name, x in expected.items():
            assert row[name] == ("" if x is None else repr(x) if isinstance(x, float) else str(x))
            assert not isinstance(x, float) or float(row[name]) == x


def test_parquet_comes_back_with_its_types(done, tmp_path):
    from pyarrow import parquet

    export(done, tmp_path / "r.parquet")
    table = parquet.read_table(tmp_path / "r.parquet")
    assert table.column_names == done.names()
    assert table.to_pylist() == list(done.rows())
    kinds = {
        name: str(table.schema.field(name).type) for name in ("speed", "impacts", "controller")
    }
    assert kinds == {"speed": "double", "impacts": "int64", "controller": "string"}


def test_a_map_shows_the_share_of_each_cell(done):
    columns = done.table("K_p", "controller", "survived").columns
    x, y = cut(columns["K_p"], False), cut(columns["controller"], False)
    assert (x.texts, y.texts) == (["100", "200", "400", "800", "1600"], ["ADRC", "NPD"])
    share = cell_means(x, y, columns["survived"].astype(float))
    assert np.array_equal(share, [[1, 1, 1, 1, 1], [1, 1, 1, 0.5, 0.5]])
    figure = sweep_map(done, Maps("K_p", "controller", "period"))
    assert isinstance(figure, Figure)
    titles = [axes.get_title(loc="left") for axes in figure.axes if axes.get_title(loc="left")]
    assert titles == ["period = 0.0005", "period = 0.001"]
    meshes = [axes.collections[0].get_array().reshape(2, 5) for axes in figure.axes[:2]]
    assert np.array_equal(np.mean(meshes, axis=0), share)


def test_samples_are_cut_into_cells_of_equal_width_or_ratio():
    random = np.random.default_rng(2)
    x = random.uniform(-1.0, 1.0, 20_000)
    cells = cut(x, False)
    assert np.bincount(cells.cell) == pytest.approx(1000, rel=0.15)
    assert np.array_equal(cells.cell, np.clip(np.floor((x - x.min()) / np.ptp(x) * 20), 0, 19))
    ratio = cut(10.0**x, True)
    assert np.mean(ratio.cell != cells.cell) < 1e-3
    assert cell_means(cells, cells, x).diagonal() == pytest.approx(
        np.linspace(-0.95, 0.95, 20), abs=5e-3
    )
    many = np.arange(MOST_LEVELS + 1.0)
    too_many = {"x": many, "y": many, "p": many, "survived": many}
    with pytest.raises(InputError, match="20 panels"):
        sweep_map_figure(too_many, Maps("x", "y", "p"))
    with pytest.raises(InputError, match="no points"):
        sweep_map_figure({"x": many[:0], "y": many[:0], "survived": many[:0]}, Maps("x", "y"))


def test_what_was_no_walk_is_grey_and_no_fall(tmp_path):
    study = read_study(
        {
            "study": {"name": "refused"},
            "fixed": {"push": "pulse", "pushed_step": 1},
            "grid": {"impacts": [1, 2], "on": ["q1", "random joints"]},
        }
    )
    done = sweep(study, tmp_path, Threads(1), function=half_refused)
    table = done.table()
    assert np.array_equal(np.isnan(table["survived"]), table["on"] == "q1")
    assert list(table.where({"survived": None})["on"]) == ["q1"] * 2
    assert list(table.where({"detail": None})["on"]) == ["random joints"] * 2
    assert len(table.where({"parameter.impacts": None})) == 0
    x, y = cut(table["parameter.impacts"], False), cut(table["on"], False)
    means = cell_means(x, y, table["survived"])
    assert np.array_equal(means, [[math.nan] * 2, [1.0] * 2], equal_nan=True)
    assert done.no_walks() == {"REFUSED": "it does not fit"}


def half_refused(records):
    return [
        {"status": "COMPLETED", "survived": 1, "detail": None, "impacts": 1}
        if record.get("on") == "random joints"
        else {"status": "REFUSED", "survived": None, "detail": "it does not fit", "impacts": 0}
        for record in records
    ]


def test_a_file_that_is_named_belongs_to_the_numbers(tmp_path):
    gait, out = tmp_path / "mine.json", tmp_path / "out"
    first = data_folder("gaits") / "rabbit" / "published-identified.json"
    gait.write_text(first.read_text())
    study = read_study({"study": {"name": "a"}, "fixed": {"gait": str(gait), "impacts": 1}})
    sweep(study, out, Threads(1))
    assert sweep(study, out, Threads(1)).summary.fresh == 0
    kept, before = scene_of(Scenario(gait=str(gait))).walked.period, json.loads(gait.read_text())
    gait.write_text(json.dumps(before | {"period": 1.5 * kept}))
    assert scene_of(Scenario(gait=str(gait))).walked.period == 1.5 * kept
    with pytest.raises(InputError, match=r"other versions.*file .*mine.json"):
        sweep(study, out, Threads(1))
    with pytest.raises(InputError, match="workers elsewhere"):
        sweep(study, tmp_path / "there", Cluster("tcp://127.0.0.1:9"))


@pytest.mark.parametrize(
    ("tables", "message"),
    [
        ({"fixed": {"robot": "rabit"}}, "rabit"),
        ({"grid": {"controller": ["ADRC", "ADCR"]}}, "ADCR"),
        ({"fixed": {"start.q9": 0.1}}, "q9"),
    ],
)
def test_names_are_looked_up_before_anything_starts(tmp_path, tables, message):
    study = read_study({"study": {"name": "typo"}, **tables})
    with pytest.raises(InputError, match=message):
        rehearse(study)
    with pytest.raises(InputError, match=message):
        sweep(study, tmp_path / "out", Threads(1))
    assert not (tmp_path / "out").exists()


WALKS = """
[study]
name = "walks"
seeds = 2
[fixed]
impacts = 2
start_rate_spread = 0.05
[grid]
controller = ["ADRC", "NPD"]
period = ["1 ms", "2 ms"]
"""


def test_walks_are_the_same_in_processes_and_threads(tmp_path):
    path = tmp_path / "walks.toml"
    path.write_text(WALKS)
    apart = sweep(path, tmp_path / "apart", Processes(2))
    beside = sweep(path, tmp_path / "beside", Threads(2))
    assert list(apart.rows()) == list(beside.rows())
    records = [point.record for point in apart.study.points()]
    here = json.loads(json.dumps(run_trials(records)))
    assert [{k: row[k] for k in here[0]} for row in apart.rows()] == here
    assert apart.statuses() == {"COMPLETED": 8}


def test_the_command_runs_exports_draws_and_goes_on(tmp_path):
    path, out = tmp_path / "walks.toml", tmp_path / "out"
    path.write_text(WALKS)
    dry = CliRunner().invoke(app, ["sweep", str(path), "--out", str(out), "--dry-run"])
    assert (dry.exit_code, out.exists()) == (0, False)
    assert "8 points" in dry.stdout
    more = ("--export", "csv", "--export", "parquet", "--plot", "period,controller:rms_error")
    done = CliRunner().invoke(app, ["sweep", str(path), "--out", str(out), "--threads", *more])
    assert done.exit_code == 0, done.output
    assert "8 COMPLETED" in done.output
    names = {p.name for p in out.iterdir()}
    assert names == {
        "results.sqlite",
        "results.csv",
        "results.parquet",
        "map-period-controller-rms_error.png",
    }
    assert sweep(path, out, Threads(1)).summary.fresh == 0
    path.write_text(WALKS.replace("0.05", "0.06"))
    before = (out / "results.sqlite").read_bytes()
    with pytest.raises(InputError, match="other in fixed"):
        sweep(path, out, Threads(1))
    assert (out / "results.sqlite").read_bytes() == before
