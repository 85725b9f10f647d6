"""Every code block of README.md and docs/ runs, and what the pages name exists.

`blocks(text)` are the code blocks of a page, `execute(block, ...)` runs or parses one of them. A helper raises
AssertionError for a block that nothing runs.

Blocks of one document run in order and share a namespace and a temporary folder, in which `tests` and
`examples` are those of the checkout. What a fence says of its block:

    python          executed; a first line `# name.py` writes it to that file instead
    console         `biped-adrc` and `python FILE` are run; those of LARGE by `make check`
    toml, xml, json parsed; a first line that is a comment with a path writes the block to that file
    text            left alone
"""

from __future__ import annotations

import ast
import csv
import json
import re
import runpy
import shlex
import sys
import tomllib
import xml.etree.ElementTree as ET
from collections import Counter
from pathlib import Path
from typing import NamedTuple

import pytest
from markdown_it import MarkdownIt
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.cli import app
from biped_adrc.cli.gait import gait_app
from biped_adrc.cli.robot import robot_app
from biped_adrc.core import registry
from biped_adrc.extras.logs import replay
from biped_adrc.paper.scenarios import Plan, base_runs
from biped_adrc.studies.build import SEED
from biped_adrc.studies.search import Search
from biped_adrc.studies.study import read_study

ROOT = Path(__file__).resolve().parents[1]
PAGES = sorted(
    path for path in (ROOT / "docs").rglob("*.md") if "_build" not in path.relative_to(ROOT).parts
)
DOCUMENTS = [ROOT / "README.md", *PAGES]
EXAMPLES = sorted((ROOT / "examples").rglob("*.py"))
STUDIES = sorted(
    path
    for path in (ROOT / "examples" / "studies").glob("*.toml")
    if not path.read_text().startswith("# Written by ")  # tests/test_findings.py has these
)

LARGE = (
    "make reproduce",
    "make test",
    "make check",
    "make docs",
    "make bench",
    "make dev",
    "pip install .",
)
"""Commands that `make check` runs, in full or in short."""

SHELLS = ("console", "bash", "sh", "shell")
DIRECTIVES = {"{toctree}", "{figure}", "{eval-rst}", "{math}", "{image}", "{raw}", "{csv-table}"}
WRITTEN = re.compile(r"^(?:#|<!--) ([\w./-]+\.\w+)(?: -->)?$")
TEST_NAME = re.compile(r"tests/[\w/]+\.py(?:::\w+)?")


class Block(NamedTuple):
    """A fenced or indented block: what its fence says, its text, and its first line in the document."""

    info: str
    text: str
    line: int


def blocks(text: str) -> list[Block]:
    """All code blocks in order; an indented one is a shell block."""
    found = []
    for token in MarkdownIt().parse(text):
        if token.type in ("fence", "code_block"):
            info = token.info.strip().split() if token.type == "fence" else ["console"]
            found.append(Block(info[0] if info else "", token.content, token.map[0] + 1))
    return found


def commands(text: str) -> list[str]:
    """The commands of a shell block; a prompt, comments and continued lines are understood."""
    lines = text.replace("\\\n", " ").splitlines()
    stripped = (line.strip().removeprefix("$ ") for line in lines)
    return [line for line in stripped if line and not line.startswith("#")]


def run(command: str) -> None:
    """Run one documented command."""
    words = shlex.split(command, comments=True)
    if words[0] == "python" and len(words) > 1 and words[1].endswith(".py"):
        run_script(*words[1:])
    elif words[0] == "biped-adrc":
        done = CliRunner().invoke(app, words[1:])
        assert done.exit_code == 0, f"'{command}': {done.exception!r} {done.output[-2000:]}"
    else:
        plain = shlex.join(words)
        assert plain in LARGE, f"'{plain}' is run by no one: make it run here"


def run_script(script: str, *words: str) -> None:
    """A script as __main__, which finds what lies beside it and registers for itself alone."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "argv", [script, *words])
        patch.syspath_prepend(str(Path(script).resolve().parent))
        patch.setattr(registry, "REGISTRY", {k: {**v} for k, v in registry.REGISTRY.items()})
        runpy.run_path(script, run_name="__main__")


def write(text: str, folder: Path) -> Path | None:
    """The file that the first line (or the second, after an XML declaration) names, written."""
    for line in text.splitlines()[:2]:
        match = WRITTEN.match(line.strip())
        if match is not None:
            path = folder / match[1]
            assert folder in path.resolve().parents, f"'{match[1]}' is outside of the folder"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
            return path
    return None


def execute(block: Block, names: dict[str, object], folder: Path, document: Path) -> None:
    """Run or check one block."""
    if block.info in SHELLS:
        for command in commands(block.text):
            run(command)
    elif block.info == "python":
        if write(block.text, folder) is None:
            padded = "\n" * block.line + block.text  # tracebacks point into the document
            exec(compile(padded, str(document), "exec", dont_inherit=True), names)
    elif block.info == "toml":
        tomllib.loads(block.text)
        write(block.text, folder)
    elif block.info == "xml":
        ET.fromstring(block.text.strip())
        write(block.text, folder)
    elif block.info == "json":
        json.loads(block.text)
    else:
        known = block.info in DIRECTIVES | {"text", "math", "bibtex"}
        assert known, (
            f"line {block.line}: a block of '{block.info or 'no language'}' is run by no one"
        )


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_every_block_runs(document, tmp_path, monkeypatch):
    """Blocks run in order in one namespace, and modules that they wrote are forgotten, since the next page
    may write others of the same name."""
    for name in ("tests", "examples"):
        (tmp_path / name).symlink_to(ROOT / name)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("BROWSER", "true")  # a page that is shown is not looked at
    monkeypatch.syspath_prepend(str(tmp_path))
    before = set(sys.modules)
    names: dict[str, object] = {"__name__": "document"}
    try:
        for block in blocks(document.read_text()):
            execute(block, names, tmp_path, document)
    finally:
        for module in set(sys.modules) - before:
            origin = getattr(sys.modules[module], "__file__", None) or ""
            if origin.startswith(str(tmp_path)):  # a file the document wrote
                del sys.modules[module]


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.name)
def test_every_example_runs(example, tmp_path, monkeypatch):
    """Each script below examples/, as a program in an empty folder, which writes into "out"."""
    monkeypatch.chdir(tmp_path)
    run_script(str(example), "out")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("```console\nrm -rf /\n```", "run by no one"),
        ("```console\nbiped-adrc simulate --controller PID\n```", "controller 'PID': unknown name"),
        ("```python\n# ../out.py\n```", "outside of the folder"),
        ("```\n1\n```", "no language"),
    ],
)
def test_a_block_that_cannot_run_fails(text, message, tmp_path):
    """A command that is not run, one that fails, a file outside of the folder, and a block without a
    language: none may pass silently."""
    (block,) = blocks(text)
    with pytest.raises(AssertionError, match=re.escape(message)):
        execute(block, {}, tmp_path, tmp_path / "page.md")


def test_every_equation_of_the_paper_has_its_place():
    """docs/theory.md has a section for each of the equations (1) to (28) in order, with its tag and the code
    that computes it."""
    text = (ROOT / "docs" / "theory.md").read_text()
    sections = re.split(r'^<a id="eq-(\d+)"></a>\n', text, flags=re.MULTILINE)
    assert [int(number) for number in sections[1::2]] == list(range(1, 29))
    for number, section in zip(sections[1::2], sections[2::2], strict=True):
        assert section.startswith(f"### ({number}) ")
        assert f"\\tag{{{number}" in section
        assert "](../biped_adrc/" in section, f"equation ({number}) names no code"


@pytest.mark.parametrize("page", PAGES, ids=lambda path: str(path.relative_to(ROOT)))
def test_tests_that_a_page_names_exist(page):
    """A page may give tests/FILE.py::test_name as evidence: after a test is renamed the page would point to
    nothing."""
    for name in TEST_NAME.findall(page.read_text()):
        path, _, function = name.partition("::")
        assert (ROOT / path).is_file(), name
        if function:
            tree = ast.parse((ROOT / path).read_text())
            assert function in {n.name for n in tree.body if isinstance(n, ast.FunctionDef)}, name


@pytest.mark.parametrize("path", STUDIES, ids=lambda path: path.name)
def test_a_study_is_short_and_has_as_many_walks_as_it_says(path):
    """Examples are read first: at most 25 lines, with the true number of walks in a comment. `rehearse`
    checks each value without a walk; of an axis of seeds two, whose values are no more than numbers."""
    text = path.read_text()
    assert len(text.splitlines()) <= 25
    study = read_study(path)
    assert study.count == int(re.search(r"(\d+) walks\b", text)[1])
    grid = {name: x[:2] if name == SEED else x for name, x in study.grid.items()}
    study.model_copy(update={"grid": grid}).rehearse()


def test_what_a_search_leaves_out_is_as_the_page_of_studies_says():
    """The table of keys has, in brackets, the number of finalists and the seed of a search that names none."""
    page = (ROOT / "docs" / "guide" / "studies.md").read_text(encoding="utf-8")
    row = re.search(r"^\| `finalists`, `seed` \|(.*)$", page, re.MULTILINE)[1]
    usual = [Search.model_fields[name].default for name in ("finalists", "seed")]
    assert [int(x) for x in re.findall(r"\((\d+)\)", row)] == usual


def test_each_line_that_gait_show_prints_is_on_the_page_of_gaits():
    """The command prints NAME  NUMBERS in lines; the page has the names in tables, one sign and one way of the
    heights for all."""
    printed = CliRunner().invoke(app, ["gait", "show", "v0.8"]).output
    lines = printed[printed.index("\nTheta") :].splitlines()
    names = {re.split(r"  +", line)[0] for line in lines if re.search(r"^\S.*?  +\S", line)}
    assert len(names) > 25
    page = (ROOT / "docs" / "guide" / "gaits.md").read_text(encoding="utf-8")
    for name in names:
        said = re.sub(r"^H (up|down|both) (?=w)", "... ", name.replace(" +", " -"))
        assert f"`{said}`" in page, name


def test_each_column_of_a_replay_is_on_its_page():
    """The table that `replay` prints, and the signals of replay.csv, whose names stand without joint and
    unit."""
    page = (ROOT / "docs" / "guide" / "replay.md").read_text(encoding="utf-8")
    signals = [heading.split(" {}")[0] for heading in replay._COLUMNS.values()]
    for name in (*replay.HEADER, *signals):
        assert f"`{name}`" in page, name


def test_the_stored_walks_are_as_long_as_the_plan_asks_for():
    """Each walk of the plan that reproduction.csv says is completed has there as many impacts as it should."""
    path = ROOT / "docs" / "findings" / "reproduction.csv"
    with path.open(encoding="utf-8", newline="") as file:
        cells = {tuple(row.values())[:3]: row["value"] for row in csv.DictReader(file)}
    plan = base_runs(Plan())
    done = [name for name in plan if cells.get(("Runs", name, "status")) == "COMPLETED"]
    assert {"sine NPD", "torso ADRC", "1 kHz NPD"} <= set(done)
    for name in done:
        assert int(cells["Runs", name, "impacts"]) == plan[name].run.impacts, name


def test_results_are_counts_and_numbers_of_the_stored_rows():
    """docs/results.md is compared with reproduction.csv: the counts of checks and of claims by word, and, of
    both walks under the push, impacts and largest errors [mrad], which the page rounds (2 %).
    """
    with (ROOT / "docs" / "findings" / "reproduction.csv").open(
        encoding="utf-8", newline=""
    ) as file:
        rows = list(csv.DictReader(file))
    page = (ROOT / "docs" / "results.md").read_text(encoding="utf-8")
    told = Counter((row["row"], row["word or verdict"]) for row in rows)
    claims = [n for (kind, _), n in told.items() if kind == "claim"]
    checks = [n for (kind, _), n in told.items() if kind == "check"]
    # the first bold words of the page: "N of N checks hold", and the claims by word
    holding, of, all_claims, *words = map(
        int, re.findall(r"\d+", re.search(r"\*\*.+\*\*", page)[0])
    )
    assert (holding, of, all_claims) == (told["check", "holds"], sum(checks), sum(claims))
    assert sorted(words) == sorted(claims)
    cells = {tuple(row.values())[:3]: row["value"] for row in rows}
    names = [("Runs", f"push {name}") for name in ("NPD", "ADRC")]
    made = [cells[*name, "impacts"] for name in names]
    claim = next(row["value"] for row in rows if row["row"] == "claim")
    assert re.findall(r"(\d+) of", claim) == made
    # the first item of a list ends with both errors and the number of steps
    *_, npd, adrc, steps = re.findall(r"[\d.]*\d", re.search(r"^- .+$", page, re.MULTILINE)[0])
    errors = [1e3 * float(cells[*name, "peak error [rad]"]) for name in names]
    assert [float(npd), float(adrc)] == pytest.approx(errors, rel=0.02)
    assert [steps, steps] == made


def test_the_package_claims_the_platforms_it_is_tested_on():
    """Every system and Python version of pyproject.toml is in README's sentence "Tested on", and no page
    speaks of macOS, on which nothing is tested."""
    tested = re.search(r"^Tested on .*?\.\s", (ROOT / "README.md").read_text(), re.MULTILINE)[0]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    for claim in project["classifiers"]:
        if claim.startswith(("Operating System ::", "Programming Language :: Python ::")):
            assert claim.split(" :: ")[-1] in tested, claim
    for page in PAGES:
        assert "macOS" not in page.read_text(), page


def test_every_public_name_is_on_one_page_of_the_reference():
    """Each page lists packages ("rooms") whose public names are inserted: none is on two pages, and every
    package with a public name is on one."""
    text = "".join(page.read_text() for page in (ROOT / "docs" / "api").glob("*.md"))
    rooms = [room for line in re.findall(r"<!-- names of (.+?) -->", text) for room in line.split()]
    homes = {home.partition(".")[0] for home in ba._HOMES.values()}
    assert len(rooms) == len(set(rooms))
    assert homes <= set(rooms)


def test_every_command_is_in_the_reference():
    """The page has a marker for each command, where its help is inserted; a new command without one fails."""
    page = (ROOT / "docs" / "api" / "cli.md").read_text()
    for group, prefix in ((app, ""), (gait_app, "gait "), (robot_app, "robot ")):
        for command in group.registered_commands:
            name = command.name or command.callback.__name__
            assert f"<!-- help of biped-adrc {prefix}{name} -->" in page, name
