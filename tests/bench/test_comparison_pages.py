"""What a comparison shows: figures, page and documentation, read back from what they draw and write."""

import importlib.util
import json
import math
import sys
from pathlib import Path

import numpy as np
import pytest

from biped_adrc.bench.cell import IMPULSE, MEASURES, NEEDS, REASONS
from biped_adrc.bench.compare_study import draw, figures, write
from biped_adrc.bench.comparison import compare
from biped_adrc.bench.run import COLUMNS
from biped_adrc.bench.settings import AS_PUBLISHED, TUNED
from biped_adrc.cli.app import command
from biped_adrc.errors import InputError
from biped_adrc.viz.comparison_text import interval
from biped_adrc.viz.figure_numbers import numbers_of
from biped_adrc.viz.pages import comparison_html
from biped_adrc.viz.plots.comparison_figure import legal_figure, measure_figure, push_figure
from biped_adrc.viz.plots.sweep_maps import Maps, cut, sweep_map_figure

DOCS = Path(__file__).parents[2] / "docs"


def row(r):
    """ADRC tracks ten times closer; with encoders no walk is legal; 100 N m are legal, 200 are made."""
    amplitude = r.get("amplitude", 0.0)
    error = {"NPD": 1e-2, "DOB": 5e-3, "ADRC": 1e-3, "LESO": 2e-3}
    made = amplitude <= 200.0 or r["push"] != "pulse" or r["on"] == "q5"
    legal = made and "counts" not in r and (r.get("on") == "q5" or amplitude <= 100.0)
    known = dict.fromkeys(COLUMNS) | dict.fromkeys((*MEASURES, *NEEDS), 1.0)
    known |= dict.fromkeys((*REASONS, IMPULSE), 0) | {"peak_unmatched": 0.0, "detail": ""}
    error["DOB"] = 2e-4 if "bandwidth" in r else error["DOB"]
    return known | {
        "status": "COMPLETED" if made else "FELL",
        "survived": int(made),
        "legal": int(legal),
        "bad_friction": int(not legal),
        "peak_error": error[r["controller"]],
        "rms_error": error[r["controller"]] * r.get("order", 1),
    }


@pytest.fixture(scope="module")
def tuned(tmp_path_factory):
    """A comparison with tuned settings."""
    found = compare(
        lambda records: [row(dict(r)) for r in records],
        ("NPD", "m = 1", "m = 2", "ADRC, Table I"),
        ("push on joints", "encoders", "RABBIT", "RABBIT pushed"),
        20,
    )
    return write(found, tmp_path_factory.mktemp("tuned"), "biped-adrc compare", 1)


@pytest.fixture(scope="module")
def summary(tmp_path_factory):
    found = compare(
        lambda records: [row(dict(r)) for r in records],
        ("NPD", "ADRC", "DOB"),
        ("nothing", "push on joints", "encoders"),
        20,
        settings=AS_PUBLISHED,
    )
    return write(found, tmp_path_factory.mktemp("compare"), "biped-adrc compare", 1)


@pytest.fixture(scope="module")
def script():
    """docs/write_comparison.py as a module."""
    sys.path.insert(0, str(DOCS))
    try:
        spec = importlib.util.spec_from_file_location(
            "write_comparison", DOCS / "write_comparison.py"
        )
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module
    finally:
        sys.path.remove(str(DOCS))


def test_the_figure_shows_legal_walks_large_and_all_others_small(summary):
    (axes,) = legal_figure(summary["cells"]).axes
    at = (1, 2)  # ADRC with encoders
    texts = {
        t.get_text(): t.get_fontsize()
        for t in axes.texts
        if abs(t.get_position()[0] - at[0]) < 0.1 and abs(t.get_position()[1] - at[1]) < 0.5
    }
    assert texts["0 %"] > 1.5 * texts["all steps: 100 %"]
    assert "0 to 16" in texts


def test_marks_are_hollow_where_no_walk_is_legal(summary):
    (axes,) = measure_figure(summary["cells"], "peak_error", "error").axes
    marks = [c.lines[0] for c in axes.containers]
    filled = [m for m in marks if m.get_markerfacecolor() != "white"]
    hollow = [m for m in marks if m.get_markerfacecolor() == "white"]
    assert [len(m.get_xdata()) for m in filled] == [2, 2, 2]
    assert [len(m.get_xdata()) for m in hollow] == [1, 1, 1]
    assert np.all(np.concatenate([m.get_ydata() for m in hollow]) > 1.5)


def test_pushes_that_pass_the_highest_rung_have_an_arrow(summary):
    panels = push_figure([p for p in summary["pushes"] if p["bandwidth"] is None]).axes
    assert len(panels) == 3
    arrows = [a for a in panels[0].texts if a.arrow_patch is not None]
    assert len(arrows) == 2 * 3  # torso +, all steps and legal, three controllers
    assert all(a.get_position()[0] == 320.0 for a in arrows)
    assert all(320.0 < a.xy[0] < panels[0].get_xlim()[1] for a in arrows)


def test_legends_name_each_controller_once(summary):
    for name, figure in figures(summary).items():
        shown = [text.get_text() for legend in figure.legends for text in legend.get_texts()]
        assert shown == ([] if name == "legal" else ["NPD", "ADRC", "DOB"])


def test_the_page_says_first_that_settings_are_not_alike(summary):
    html = comparison_html(summary, {})
    order = [
        html.index(text)
        for text in (
            "not tuned alike",
            "The gait itself",
            "impulse beyond the cone",
            "at least 320",
        )
    ]
    assert order == sorted(order)
    assert html.index('id="equal"') < html.index("the order changes") < html.index('id="table"')
    assert html.index("ADRC 0.1 (0.1 to 0.1) in 20 pairs") < html.index('id="equal"')
    none = comparison_html(summary | {"findings": {}, "equal_bandwidth": [], "pushes": []}, {})
    assert "No difference is carried by its test." in none
    assert "At equal bandwidth" not in none
    assert draw(summary | {"pushes": []}).keys() == draw(summary).keys() - {"pushes"}


def test_the_command_is_text_on_the_page(summary):
    html = comparison_html(summary | {"command": "biped-adrc compare -o '<b>&'"}, {})
    assert "biped-adrc compare -o &#39;&lt;b&gt;&amp;&#39;" in html
    assert "'<b>&'" not in html


def test_the_documentation_is_made_from_the_summary(tuned, script):
    text = script.page(tuned)
    for line in (line for lines in tuned["findings"].values() for line in lines):
        assert line.replace("[", "\\[") in text
    chosen = TUNED.places["RABBIT, 1 ms"]["m = 2"]
    for part in (
        "Settings tuned-v0.5: tuned alike on gait v0.5",
        "As published, in the tables and in no sentence: ADRC, Table I.",
        "m = 1 0.2 (0.2 to 0.2) in 20 pairs",
        "| ADRC, Table I (as published) |",
        "friction 100",
        "at least 320",
        "| RABBIT, 1 ms | m = 2 | K\\_p = " + str(chosen["K_p"]),
        "| push on joints | up to 100 N m on each joint",
    ):
        assert part in text
    assert "not tuned alike" not in text
    assert "RABBIT, 2 ms |" not in text, "no condition has its settings"
    quiet = script.page(tuned | {"findings": {}, "pushes": []})
    assert quiet.count("No difference is carried by its test.") == 1
    assert " in 20 pairs" not in quiet


def test_guide_and_readme_say_which_order_pays(tuned, summary, script):
    page = f"before\n\n{script.BEGIN}\nold\n{script.END}\n\nafter\n"
    text = script.put(page, script.guide_part(tuned))
    assert text.startswith("before")
    assert text.endswith("after\n")
    assert "old" not in text
    bandwidth = TUNED.places["ideal 1 kHz"]["m = 2"]["bandwidth"]
    assert f"| push on joints | m = 2 | {bandwidth:.3g} |" in text
    assert "| push on joints | NPD | – |" in text
    assert "ADRC, Table I" not in text
    larger = "the rms error is larger for m = 2 2 (2 to 2)."
    assert f"Beside m = 1 under 'RABBIT pushed' {larger}" in text
    readme = script.readme_part(tuned)
    assert "ADRC with m = 1 leaves 0.2 (0.2 to 0.2) of the rms tracking error of NPD" in readme
    assert "legal are 20 of 20 walks under m = 1 and 20 of 20 under NPD" in readme
    assert larger in readme
    open_ = [q | {"carried": False} for q in tuned["tests"]]
    undecided = script.readme_part(tuned | {"tests": open_})
    assert "the rms error is open for m = 2" in undecided
    assert "of the rms tracking error of NPD (which no test tells from 1)" in undecided
    assert "no pair of legal walks with NPD" in script.readme_part(tuned | {"tests": []})
    assert script.put(text, script.guide_part(tuned)) == text
    with pytest.raises(InputError, match="put them where"):
        script.put("no marks", "part")
    with pytest.raises(InputError, match="has no tuned observers"):
        script.guide_part(summary)
    for path in (DOCS / "guide" / "observer.md", DOCS.parent / "README.md"):
        assert script.put(path.read_text(), "part") != path.read_text()


def test_the_script_writes_from_a_folder_what_it_reads_from_its_own(
    tuned, script, tmp_path, monkeypatch
):
    """Page, pictures and numbers are the same to the byte from the summary that is kept."""
    out, docs = tmp_path / "out", tmp_path / "docs"
    out.mkdir()
    docs.mkdir()
    (out / "summary.json").write_text(json.dumps(tuned))
    for page in ("observer.md", "README.md"):
        (docs / page).write_text(f"{script.BEGIN}\n{script.END}\n")
    for name, path in (
        ("FOLDER", "comparison"),
        ("PAGE", "comparison.md"),
        ("GUIDE", "observer.md"),
        ("README", "README.md"),
    ):
        monkeypatch.setattr(script, name, docs / path)
    found = []
    for source in (out, docs / "comparison"):
        monkeypatch.setattr(sys, "argv", ["write_comparison.py", str(source)])
        script.main()
        found.append({p.name: p.read_bytes() for p in docs.rglob("*.*") if p.is_file()})
    assert found[0] == found[1]
    drawn = {f"{name}{suffix}" for name in draw(tuned) for suffix in (".svg", ".json")}
    assert found[0].keys() == drawn | {"summary.json", "comparison.md", "observer.md", "README.md"}
    assert script.read(docs / "comparison" / "summary.json") == json.loads(json.dumps(tuned))
    with pytest.raises(InputError, match="run 'biped-adrc compare'"):
        script.read(docs / "summary.json")


@pytest.mark.parametrize(
    ("value", "label", "limits"),
    [
        ("survived", "share of walks that make all steps", (0.0, 1.0)),
        ("legal", "share of walks that make all steps legally", (0.0, 1.0)),
        ("peak_error", "mean of peak_error", (0.0, 0.5)),
    ],
)
def test_maps_say_which_share_they_show(value, label, limits):
    x = np.array([1.0, 2.0, 1.0, 2.0])
    shown = np.array([0.0, 0.5, 0.5, 0.5])
    figure = sweep_map_figure({"x": x, "y": x, value: shown}, Maps("x", "y", None, value))
    bar = figure.axes[-1]
    assert bar.get_ylabel() == label
    assert bar.get_ylim() == pytest.approx(
        (limits[0], limits[1]) if value in ("survived", "legal") else (0.25, 0.5)
    )


def test_levels_have_as_few_digits_as_tell_them_apart():
    """Within 1 %: a tick such as 534.7 says more than a map can show."""
    assert cut(np.geomspace(100.0, 2000.0, 6), True).texts == [
        "100",
        "182",
        "331",
        "603",
        "1100",
        "2000",
    ]
    assert cut(np.array([1e-3, 1.5e-3, 2e-3]), False).texts == ["0.001", "0.0015", "0.002"]
    assert cut(np.array([0.1, 0.1001]), False).texts == ["0.1", "0.1001"]
    assert cut(np.array([-0.17453, 0.0, math.nan]), False).texts == ["-0.175", "0", "none"]


def test_the_command_can_be_typed_again(monkeypatch):
    """With the quotes that a condition of several words needs."""
    given = ["biped-adrc", "compare", "--conditions", "push on joints,delay"]
    monkeypatch.setattr(sys, "argv", given)
    assert command() == "biped-adrc compare --conditions 'push on joints,delay'"


def test_intervals_are_written_without_powers_where_they_need_none():
    assert interval([184.0, 171.0, 1234.0]) == "180 (170 to 1200)"
    assert interval([1.26e-4, 0.0, -2e-5]) == "0.00013 (0 to -2e-05)"
    assert interval([0.9166, 0.646, 1.0], 3, 100.0) == "91.7 (64.6 to 100)"
    assert interval(None) == "–"


def test_the_numbers_of_the_figures_are_those_of_the_summary(summary):
    """What is drawn is read back from the axes, and not from the summary again."""
    found = {name: numbers_of(f)["panels"] for name, f in figures(summary).items()}
    (legal,) = found["legal"]
    assert legal["maps"] == [[1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0]]
    assert legal["texts"].count("all steps: 100 %") == 9
    (errors,) = found["peak_error"]
    medians = {"NPD": 1e-2, "ADRC": 1e-3, "DOB": 5e-3}
    for name, x in medians.items():
        assert errors["marks"][name]["x"] == [x, x]
        assert errors["marks"][name]["from"] == errors["marks"][name]["to"] == [x, x]
        assert errors["marks"][f"{name}, not legal"]["x"] == [x]
    for panel in found["pushes"]:
        for name in medians:
            legal, made = (panel["marks"][f"{name}, {kind}"] for kind in ("legal", "all steps"))
            assert len(legal["x"]) == len(legal["y"]) == len(made["x"])
            assert all(
                a <= x <= b
                for a, x, b in zip(*(legal[k] for k in ("from", "x", "to")), strict=True)
            )
            limits = {round(x, 6) for x in legal["x"]}
            assert all(x == 320.0 or 90.0 < x <= 100.0 for x in limits)
            assert max(made["x"]) == 320.0
            assert all(x == 320.0 or 190.0 < x <= 200.0 for x in made["x"])
