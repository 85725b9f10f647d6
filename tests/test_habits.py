"""The version, the citation, the changelog and the hooks say the same as the package and the Makefile."""

from __future__ import annotations

import datetime
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
from biped_adrc.versions import versions

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
    done = CliRunner().invoke(app, [*words, "-h"])
    assert done.exit_code == 0
    assert done.output.startswith("Usage: ")
    assert done.output == CliRunner().invoke(app, [*words, "--help"]).output


def test_the_version_is_said_by_the_module():
    done = subprocess.run(
        [sys.executable, "-m", "biped_adrc", "--version"],
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    assert done.stdout == f"biped-adrc {ba.__version__}\n"


def test_the_version_is_written_once():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    assert "version" not in project["project"]
    assert project["project"]["dynamic"] == ["version"]
    assert project["tool"]["hatch"]["version"]["path"] == "biped_adrc/__init__.py"
    assert versions()["biped-adrc"] == ba.__version__


def test_releases_are_dated_and_the_newest_is_this_one():
    text = (ROOT / "CHANGELOG.md").read_text()
    headings = re.findall(r"^## (.*)$", text, re.M)
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


def test_hooks_are_the_checks_of_the_makefile():
    config = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text())
    hooks = [hook for repo in config["repos"] for hook in repo["hooks"]]
    assert {repo["repo"] for repo in config["repos"]} == {"local"}
    entries = [hook["entry"] for hook in hooks]
    makefile = (ROOT / "Makefile").read_text()
    rules = re.findall(r"^(?:lint|types|imports):.*\n((?:\t.*\n)+)", makefile, re.M)
    checks = [line.strip() for rule in rules for line in rule.splitlines()]
    assert len(checks) == len(entries) == 4
    for check, entry in zip(checks, entries, strict=True):
        tool = check.replace("$(BIN)", ".venv/bin").removesuffix(" .").removesuffix(" --check")
        assert entry.startswith(tool)


@pytest.mark.parametrize(
    "page", sorted((ROOT / "docs" / "extend").glob("*.md")), ids=lambda p: p.stem
)
def test_what_a_page_of_extensions_names_is_public(page):
    text = page.read_text(encoding="utf-8")
    assert re.findall(r"^from biped_adrc.*", text, re.M) == []
    named = set(re.findall(r"\bba\.([A-Za-z_]\w*)", text))
    assert named
    assert named <= {*ba.__all__}
