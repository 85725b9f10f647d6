"""Pages of the documentation read offline: mathematics is typeset, and nothing lies on another host."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest
from selenium.webdriver.support.ui import WebDriverWait

from .browser import chromium, console, requested

ROOT = Path(__file__).resolve().parents[2]
MATHEMATICS = "# Page\n\nInline $x^2$ and\n\n$$\\dot\\theta = \\frac{a}{b} \\tag{1}$$\n"


def imported(name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, ROOT / "docs" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One page, built with the configuration of the documentation."""
    pytest.importorskip("sphinx-mathjax-offline", reason="pip install 'biped-adrc[docs]'")
    source, pages = tmp_path_factory.mktemp("source"), tmp_path_factory.mktemp("pages")
    (source / "index.md").write_text(MATHEMATICS)
    build = [sys.executable, "-m", "sphinx", "-W", "-q", "-c", ROOT / "docs", source, pages]
    subprocess.run(build, check=True, timeout=120)
    return pages


def test_mathematics_is_typeset_without_a_network(built: Path) -> None:
    with chromium() as browser:
        browser.set_network_conditions(offline=True, latency=0, throughput=0)
        requested(browser)
        browser.get((built / "index.html").as_uri())
        typeset = "return document.querySelectorAll('mjx-container').length"
        WebDriverWait(browser, 30.0).until(lambda page: page.execute_script(typeset) == 2)
        assert all(address.startswith(built.as_uri()) for address in requested(browser))
        assert console(browser) == []


def test_a_built_page_has_no_fault(built: Path) -> None:
    assert imported("check_pages").faults(built) == []


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ('<script src="https://cdn.example/m.js"></script>', "loads https://cdn.example/m.js"),
        ('<script src="//cdn.example/m.js"></script>', "loads //cdn.example/m.js"),
        ('<link rel="stylesheet" href="http://example/a.css">', "loads http://example/a.css"),
        ('<img src="https://example/a.png">', "loads https://example/a.png"),
        ("<style>@import 'https://example/a.css'</style>", "loads https://example/a.css"),
        ("<script>import('https://example/a.js')</script>", "loads https://example/a.js"),
        ('<img src="gone.png">', "loads gone.png, which is missing"),
        ("<iframe srcdoc='<script src=\"https://e/a.js\"></script>'></iframe>", "https://e/a.js"),
        ('<a href="mailto:TORQUE@STEP">x</a>', "has the link mailto:TORQUE@STEP"),
        ('<a href="https://example">x</a><img src="data:,"><img src="page.html">', None),
    ],
)
def test_what_is_loaded_from_elsewhere_is_found(text: str, fault: str | None, tmp_path) -> None:
    (tmp_path / "page.html").write_text(f"<html>{text}</html>")
    found = imported("check_pages").faults(tmp_path)
    assert len(found) == (fault is not None)
    assert fault is None or fault in found[0]


def test_words_with_an_at_sign_are_no_addresses() -> None:
    lines = ["JOINTS=TORQUE@STEP and `q1@2`"]
    imported("docstrings").plain(None, "function", "biped_adrc.x", plain_object, {}, lines)
    assert lines == ["JOINTS=TORQUE\\@STEP and ``q1@2``"]


def plain_object() -> None:
    """Something with a docstring of its own."""
