"""The page of a study (HTML): its table, and one picture for each question that its rows answer.

A row is the results of one walk by column, such as peak_error. A case is a named set of values that are
compared, a condition one under which they are; a group is the walks of one case under one condition, and a line
of the table says what they are together: how many are feasible (ground and motors could carry them), and the
median of the study's measure, a column of the rows. A search chooses values of its variables for each case: a
candidate is one such choice, with a number, and its `Choice` has all of them, and the best ones in `selected`.
"""

import math
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from biped_adrc.analysis.statistics import Interval
from biped_adrc.core.files import write_text
from biped_adrc.scenario.scenario import Scenario
from biped_adrc.studies.measure import OF_ALL, Row, is_counted
from biped_adrc.studies.results import Results, TableLine
from biped_adrc.studies.run import COLUMNS
from biped_adrc.view.pages import as_text, data_uri, rendered
from biped_adrc.view.plots.study import dots_figure, map_figure, path_figure
from biped_adrc.view.style import render

PAGE = "study.html"
"""Name of the page in the folder of a study."""


def write_page(found: Results) -> Path:
    """Write the page into the folder of the study, and return its path. Raises OutputError."""
    path = found.folder / PAGE
    text = rendered(
        "study",
        s=found.study,
        # status -> number of walks; _ is a text on the first of them
        statuses={status: n for status, (n, _) in found.statuses().items()},
        columns=headings(found),
        lines=[texts(line) for line in found.table()],
        # (heading, text below, picture)
        figures=[(words, "", data_uri(render(x, "svg"))) for words, x in _figures(found)],
        chosen=choices(found),
        notes=(*found.failures, *found.notes),
    )
    write_text(path, text)
    return path


def headings(found: Results) -> tuple[str, ...]:
    """Headings of the columns of `texts`; the ratio is to the case of the table's first line, or to "first"
    where this case has no name.
    """
    middle = f"median {found.study.measure.column}"
    first = next((line.name for line in found.table()), "") or "first"
    return "case", "condition", "feasible", "made", middle, f"ratio to {first}", "p"


def choices(found: Results) -> dict[str, str]:
    """By case, the number of the candidate that a search chose, and its values of the variables, as text; a
    study without cases has the name "chosen". Empty without a search.
    """
    variables = found.study.search.variables if found.study.search else ()
    # selected: candidates that were walked again, best first, so [0] was chosen. x.values: values of its
    # scenario; a variable that has no effect is not among them
    return {
        name or "chosen": f"candidate {x.selected[0].number}, "
        + ", ".join(f"{k} = {as_text(x.values[k])}" for k in variables if k in x.values)
        + (x.stop and f"; {x.stop}")
        for name, x in found.choices.items()
    }


def texts(line: TableLine, short: bool = False) -> tuple[str, ...]:
    """A line of the table as text: "17 of 20 (0.64 to 0.95)", and a dash for a number that does not exist.

    In order: case, condition, feasible walks, walks made to the end, median of the study's measure, ratio to
    the first case, p-value. short: whether to leave out the intervals but that of the ratio.
    """
    count = f"{round(line.feasible.value * line.walks)} of {line.walks}"
    # line.ratio, None for the first case, has a ratio with interval and the p-value of the pairs of walks
    middle, ratio, p = interval(line.median), "–", "–"
    if line.ratio is not None:
        ratio = interval(line.ratio.ratio)
        p = "–" if math.isnan(line.ratio.p) else f"{line.ratio.p:.2g}"
    if short:
        middle = middle.partition(" ")[0]
    else:  # behind the first blank of "0.85 (0.64 to 0.95)" is the interval
        count = f"{count} {interval(line.feasible).partition(' ')[2]}".strip()
    return line.name, line.condition, count, str(line.made), middle, ratio, p


def interval(x: Interval) -> str:
    """ "value (low to high)", without the ends where there are none; a dash for a number that is not finite."""
    if not math.isfinite(x.value):
        return "–"
    value, low, high = (f"{y:.3g}" for y in x)  # an interval is these three numbers
    return value if math.isnan(x.low) else f"{value} ({low} to {high})"


def _figures(found: Results) -> Iterator[tuple[str, Figure]]:
    """Yield the questions that a study answers, as (question, figure). A question is left out if no number in
    its figure is finite and above 0, as a logarithmic axis needs.
    """
    lines, measure = found.table(), found.study.measure
    if not lines:
        return
    # (case, condition) -> line of the table; below also -> interval, as `dots_figure` draws them
    by = {(x.name, x.condition): x for x in lines}
    medians = {key: x.median for key, x in by.items()}
    ratios = {key: x.ratio.ratio for key, x in by.items() if x.ratio is not None}
    if len({x.condition for x in lines}) > 1:  # under one condition the table says it as well
        shares = {key: x.feasible for key, x in by.items()}
        title = "share of feasible walks"
        yield "Whose walks are feasible?", dots_figure(shares, title, "linear")
    # column: its name with the unit
    # OF_ALL are the columns that every walk has, however it ended, such as impacts: they are no errors, so no
    # question of size or ratio is asked of them
    column, counts = _named(measure.column), measure.column in OF_ALL
    better = f"ratio to {lines[0].name} in {measure.column}"  # a ratio has no unit
    # question, title of the axis, numbers, and where a line is drawn: at the ratio 1, where both are equal
    for question, title, numbers, at in (
        ("How large is the error?", f"median {column}", medians, None),
        ("Who is better on the same walk?", better, ratios, 1.0),
    ):
        if not counts and any(0.0 < x.value < math.inf for x in numbers.values()):
            yield question, dots_figure(numbers, title, "log", at)
    if found.study.axes:  # a grid or draws
        shares_of = _map(found, lambda x: float(is_counted(x)), "share of feasible walks", False)
        yield "Where are walks feasible?", shares_of
        if any(0.0 < measure.number(x.row) < math.inf for g in found.groups for x in g.rows):
            question = f"How large is {measure.column}, and where?"
            yield question, _map(found, measure.number, f"mean {column}", not counts)
    if found.choices:
        paths = {
            name: [(c.number, c.objective, c.feasible) for c in x.candidates if c.walked]
            for name, x in found.choices.items()
        }
        # candidates are judged on the first of a search's three sets of walks
        title = f"{measure.words}, first set of walks"
        # the last argument says whether less is better
        yield "Where did the search lead?", path_figure(paths, title, measure.sign > 0.0)


def _map(found: Results, number: Callable[[Row], float], title: str, log: bool) -> Figure:
    """Draw a map of `number` over the two fields of grid and draws that have the most levels.

    There is a panel for each condition, case and level of a third field; with one field alone the second axis
    is the case. number: from a row to what is drawn. title: of its colours. log: whether these have a
    logarithmic scale.
    """
    study, groups = found.study, found.groups
    # name of a field -> how many different values its walks have; x.at are the values of a walk that vary
    levels = {name: len({repr(x.at[name]) for g in groups for x in g.rows}) for name in study.axes}
    axes = sorted(levels, key=lambda name: -levels[name])
    panels: dict[str, tuple[list[Any], list[Any], list[float]]] = {}
    for g in groups:
        # on a grid, walks that differ by a seed which changed nothing would weigh double in the mean of their
        # cell: `different` keeps one of them
        for x in found.different(g) if study.grid else g.rows:
            # title of the panel: the condition, the case unless that is an axis, the level of a third field
            words = [g.condition, g.name if len(axes) > 1 else ""]
            where = ", ".join(filter(None, (*words, *(f"{k} = {x.at[k]}" for k in axes[2:3]))))
            xs, ys, values = panels.setdefault(where, ([], [], []))
            xs.append(x.at[axes[0]])
            ys.append(x.at[axes[1]] if len(axes) > 1 else g.name)
            values.append(number(x.row))
    shown = {name: (x, y, np.array(v)) for name, (x, y, v) in panels.items()}
    names = [name + Scenario.field_of(name).in_brackets for name in axes[:2]]
    return map_figure(shown, (names[0], names[1] if len(axes) > 1 else "case"), title, log)


def _named(column: str) -> str:
    """The name of a column with its unit in brackets, taken from the text in columns.toml, for a label."""
    return " ".join([column, *re.findall(r"\[[^]]+\]", COLUMNS.get(column, ""))])
