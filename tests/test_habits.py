"""Version, citation and changelog say the same as the package; the page on architecture has every room.

A room is a folder of biped_adrc with modules, or validation/.
"""

from __future__ import annotations

import datetime
import importlib
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import typer
import yaml
from typer.testing import CliRunner

import biped_adrc as ba
from biped_adrc.cli import app

ROOT = Path(__file__).resolve().parents[1]


def commands():
    """Words of every command, groups included."""

    def below(found, words):
        yield words
        for name, child in getattr(found, "commands", {}).items():
            yield from below(child, (*words, name))

    return list(below(typer.main.get_command(app), ()))


@pytest.mark.parametrize("words", commands(), ids=" ".join)
def test_every_command_has_a_short_help(words):
    """-h is --help, of every command and group."""
    done = CliRunner().invoke(app, [*words, "-h"])
    assert done.exit_code == 0
    assert done.output.startswith("Usage: ")
    assert done.output == CliRunner().invoke(app, [*words, "--help"]).output


def test_the_version_is_said_by_the_module():
    """`python -m biped_adrc --version` prints the version and nothing else."""
    done = subprocess.run(
        [sys.executable, "-m", "biped_adrc", "--version"],
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    assert done.stdout == f"biped-adrc {ba.__version__}\n"


def test_releases_are_dated_and_the_newest_is_this_one():
    """Headings of CHANGELOG.md: "Unreleased" may be first; then come version and date, the newest first."""
    text = (ROOT / "CHANGELOG.md").read_text()
    headings = re.findall(r"^## (.*)$", text, re.M)
    # from the second one on (True is 1) if the first is "Unreleased"
    headings = headings[headings[0] == "Unreleased" :]
    found = [re.fullmatch(r"(\d+\.\d+\.\d+) \((\d{4}-\d\d-\d\d)\)", h).groups() for h in headings]
    dates = [datetime.date.fromisoformat(date) for _, date in found]
    assert found[0][0] == ba.__version__
    assert dates == sorted(dates, reverse=True)


def test_the_citation_is_of_this_version_and_of_the_paper():
    """What the Citation File Format 1.2.0 requires, and no name that it has not."""
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert cited["cff-version"] == "1.2.0"
    assert {"message", "title", "authors"} <= set(cited)
    assert set(cited) <= {
        *("cff-version", "message", "title", "authors", "type", "abstract", "version", "license"),
        *("date-released", "keywords", "references"),
    }
    assert cited["version"] == ba.__version__
    assert (
        f"## {cited['version']} ({cited['date-released']})" in (ROOT / "CHANGELOG.md").read_text()
    )
    holder = re.search(r"Copyright \(c\) \d+, (.*)", (ROOT / "LICENSE").read_text())[1]
    assert cited["authors"][0]["name"].lower() == holder.lower()
    (paper,) = cited["references"]
    assert paper["type"] == "article"
    assert paper["title"] in " ".join((ROOT / "README.md").read_text().replace("> ", "").split())
    assert [author["family-names"] for author in paper["authors"]] == [
        "Arcos-Legarda",
        "Cortes-Romero",
        "Tovar",
    ]


def test_each_python_that_is_claimed_is_checked():
    """By the workflow and by .ci/run: the versions of the classifiers."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    claimed = [c.split(" :: ")[-1] for c in project["classifiers"] if ":: Python :: 3" in c]
    workflow = yaml.safe_load((ROOT / ".github" / "workflows" / "check.yml").read_text())
    assert workflow["jobs"]["check"]["strategy"]["matrix"]["python"] == claimed
    assert f"for version in {' '.join(claimed)}; do" in (ROOT / ".ci" / "run").read_text()


# -- rooms ------------------------------------------------------------------------------------------
def rooms():
    """Folders with modules."""
    found = {p.parent.name for p in (ROOT / "biped_adrc").glob("*/__init__.py")}
    return found | {"validation"}


def test_every_room_is_in_the_contract_and_in_the_list_of_the_page(monkeypatch):
    """`layers` are those of the contract on imports in pyproject.toml, `WORDS` the list of
    docs/architecture.md: both have each room, and none that is gone."""
    monkeypatch.syspath_prepend(str(ROOT / "docs"))
    drawn = importlib.import_module("draw_architecture")
    layered = {name for row in drawn.layers() for name in row}
    assert layered == rooms() == set(drawn.WORDS)
